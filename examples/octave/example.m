% mkoctfile --mex -I../../contact/include wheel_on_rail.c -lwheelrail   (MATLAB: mex)
y = (-0.030:0.001:0.030)';
angle = (-30:30)' / 30 * 1.3;
wheel = [y, -0.05 * y];                                % a cone 1:20
rail = [0.03 * sin(angle), 0.03 * (1 - cos(angle))];   % an arc with a radius of 30 mm
force = wheel_on_rail(wheel, rail, [0.002 0 0 0.003], 0.3, 20, 80e3);
printf("Fx %.3f Fy %.3f Fz %.3f N\n", force(1), force(2), force(3));
