"""Small input files of CONTACT, written for these tests."""

#: Steady rolling of an ellipse under a load, then the same with another creepage, then a shift of a new contact.
CONTACT = """\
% two cases of one contact
 3  MODULE
  203100     P-B-T-N-F-S
  022020     L-D-C-M-Z-E
 0001341   H-G-I-A-O-W-R
   999   100    30      1     1e-6      MAXGS , MAXIN , MAXNR , MAXOUT, EPS
   82000.  -.001   0.0   .2-03          FN, CKSI, CETA, CPHI
   0.300   0.300                        FSTAT, FKIN
   0.0     0.5   30d3                   CHI, DQ, VELOC
   0.28,0.28     82000. 82000.
   1                                    IPOTCN
  20 12  -8.0 = -4.8  0.8  0.8          MX,MY,XL,YL,DX,DY
   1  1
  0.0040 0.0 0.0105   0.0
  0.0 0.0                               B1 ... B6
 3  MODULE
  203100
  100000
 0101341
   82000.  -.002   0.0   0.0    1.5 2.5 FN, CKSI, CETA, CPHI, SPINXO, SPINYO

 0 MODULE
 never read
"""

#: A wheel on a rail, left and right, on given profiles.
PAIR = """\
 1 MODULE
 0203100    C-P-B-T-N-F-S
 0022033    V-L-D-C-M-Z-E
 0001321    H-G-I-A-O-W-R
    999     100    30    1     1e-5
  0.300   0.300
  0.280   0.280   82000.  82000.
  0.400   0.400   1.000   90d   8.0   4.0
   14.0     0    1435.0   0.020
  'profiles/rail.prr'     0   1.0   0.0   -1
     0.0    0.0   0.000   0.0   0.0   0.000
  1360.0  -70.0   460.0
  'profiles/wheel.prw'   0   1.0   0.0
  0.0  2.0  125000. 0.000  -0.1d   0.0
 2000. 0.0  0.0    0.0    0.0    -4.34
 1 MODULE
 1203100
 0111002
 0101321
  0.0  2.5  125000. 0.000  0.000   -26.0d
 2000. 0.0  0.0    0.0    0.0    -4.08190679
 0 MODULE
"""

#: Friction over the inclination, points below the surface, rail on springs, flexible wheel, solver constants of G = 4.
PAIR_WITH_ALL = """\
 1 7 MODULE, REID
 1203133
 1222035
 00400320
   999 100 30 1 1e-5 20000
   1 0.5
   2    NVF
  -20d  0.2 0.05 100. 0.0 0.0
   5d   0.4 0.05 100. 0.0 0.0
   10.  1.0   MEMDST, MEM_S0
  0.28 0.28 82000. 82000.
  0.4 0.4 1.0 90d 8.0 4.0 12.0
   0.0 750. 0.0 0.025 1e-6
  'a.ban' 1 1.0 5.0 1 2
   1 150d 30d 6d 2.0
   1 0.5
   0. 0.1 0.01 0 0 0
   0.0 0.0 1000. 0.0 1.0
  1360. -70. 460. -1.0
  'b.whl' 0 1.0 0.0 -1
  0.0 1.0 80000. 0.0 0.0 0.0
  2000. 0 0 0 0 -4.3
  0.1 0.2 0.3 0.001 0.002 0.003
  1. 2. 3. 4d 5d 6d
  1 1
  1
  3 0.1 0.5
  7
  2 1
  3 4
  5
  2
  0.5 1.5
  9
  1 2 1
  0.0
  0.0 1.0
  0.5
  0
 1203130
 1111003
 0101341
  1360. -70. 460.
  'b.whl' 0 1.0 0.0 -1
  0.0 1.5 80000. 0.0 0.0 0.0
  2000. 0 0 0 0 -4.3
 0
"""
