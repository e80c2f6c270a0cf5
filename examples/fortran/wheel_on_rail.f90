! Forces of a wheel on a rail from two profile arrays and a pose, called with iso_c_binding.
! gcc -c wheelrail_simple.c; gfortran wheel_on_rail.f90 wheelrail_simple.o -lwheelrail
! The C file beside this one keeps the large structs out of Fortran: it takes numbers and arrays only.
program wheel_on_rail
  use iso_c_binding
  implicit none
  interface
    integer(c_int) function pair_bytes(n_wheel, n_rail, bytes) bind(c, name="simple_pair_bytes")
      import :: c_int, c_int64_t, c_size_t
      integer(c_int64_t), value :: n_wheel, n_rail
      integer(c_size_t), intent(out) :: bytes
    end function
    integer(c_int) function pair_init(n_wheel, wheel_y, wheel_z, n_rail, rail_y, rail_z, memory, bytes) &
        bind(c, name="simple_pair_init")
      import :: c_int, c_int64_t, c_double, c_size_t
      integer(c_int64_t), value :: n_wheel, n_rail
      real(c_double), intent(in) :: wheel_y(*), wheel_z(*), rail_y(*), rail_z(*)
      real(c_double), intent(inout) :: memory(*)
      integer(c_size_t), value :: bytes
    end function
    integer(c_int) function pair_solve(memory, mu, speed, load, pose, force) bind(c, name="simple_pair_solve")
      import :: c_int, c_double
      real(c_double), intent(inout) :: memory(*)
      real(c_double), value :: mu, speed, load
      real(c_double), intent(in) :: pose(4)    ! y, z [m], roll, yaw [rad]
      real(c_double), intent(out) :: force(6)  ! Fx, Fy, Fz [N], Mx, My, Mz [N m]
    end function
    integer(c_int) function pair_accept(memory) bind(c, name="wr_pair_accept")
      import :: c_int, c_double
      real(c_double), intent(inout) :: memory(*)
    end function
  end interface
  integer, parameter :: n = 61
  integer(c_int64_t), parameter :: m = n
  real(c_double) :: wheel_y(n), wheel_z(n), rail_y(n), rail_z(n), angle, force(6)
  real(c_double), allocatable :: memory(:)
  integer(c_size_t) :: bytes
  integer(c_int) :: code
  integer :: i
  do i = 1, n  ! a cone 1:20 on an arc with a radius of 30 mm
    wheel_y(i) = -0.030d0 + 0.001d0*(i - 1)
    wheel_z(i) = -0.05d0*wheel_y(i)
    angle = (i - 31)/30.0d0*1.3d0
    rail_y(i) = 0.03d0*sin(angle)
    rail_z(i) = 0.03d0*(1.0d0 - cos(angle))
  end do
  code = pair_bytes(m, m, bytes)
  allocate (memory(bytes/8))
  if (code >= 0) code = pair_init(m, wheel_y, wheel_z, m, rail_y, rail_z, memory, bytes)
  if (code >= 0) code = pair_solve(memory, 0.3d0, 20.0d0, 80d3, [0.002d0, 0.0d0, 0.0d0, 0.003d0], force)
  if (code < 0) stop 1
  print '(a,f0.3,a,f0.3,a,f0.3,a)', "Fx ", force(1), " Fy ", force(2), " Fz ", force(3), " N"
  code = pair_accept(memory)
end program
