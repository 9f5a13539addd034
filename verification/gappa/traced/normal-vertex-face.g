# The control points of the normal: core/src/kernels/coplanarity.rs, MovingTetrahedron::largest_normal.
# Written from the code by verification/src/proofs.rs; a test demands that it is what the code gives.
#
# Names and scale as in k0.g. Three components each of n0, h (twice the middle one) and n1: a component is off by at most 60u,
# the vector by sqrt(3) times that.
T18 = B0Y * C0Z;
T19 = B0Z * C0Y;
T20 = T18 - T19;
T21 = B0Z * C0X;
T22 = B0X * C0Z;
T23 = T21 - T22;
T24 = B0X * C0Y;
T25 = B0Y * C0X;
T26 = T24 - T25;
T27 = B0Y * C1Z;
T28 = B0Z * C1Y;
T29 = T27 - T28;
T36 = B1Y * C0Z;
T37 = B1Z * C0Y;
T38 = T36 - T37;
T45 = T29 + T38;
T30 = B0Z * C1X;
T31 = B0X * C1Z;
T32 = T30 - T31;
T39 = B1Z * C0X;
T40 = B1X * C0Z;
T41 = T39 - T40;
T46 = T32 + T41;
T33 = B0X * C1Y;
T34 = B0Y * C1X;
T35 = T33 - T34;
T42 = B1X * C0Y;
T43 = B1Y * C0X;
T44 = T42 - T43;
T47 = T35 + T44;
T48 = B1Y * C1Z;
T49 = B1Z * C1Y;
T50 = T48 - T49;
T51 = B1Z * C1X;
T52 = B1X * C1Z;
T53 = T51 - T52;
T54 = B1X * C1Y;
T55 = B1Y * C1X;
T56 = T54 - T55;

{ b0y in [-1, 1] /\ b0y -/ B0Y in [-2b@u@, 2b@u@]
/\ c0z in [-1, 1] /\ c0z -/ C0Z in [-2b@u@, 2b@u@]
/\ t18 -/ (b0y * c0z) in [-2b@u@, 2b@u@]
/\ b0z in [-1, 1] /\ b0z -/ B0Z in [-2b@u@, 2b@u@]
/\ c0y in [-1, 1] /\ c0y -/ C0Y in [-2b@u@, 2b@u@]
/\ t19 -/ (b0z * c0y) in [-2b@u@, 2b@u@]
/\ t20 -/ (t18 - t19) in [-2b@u@, 2b@u@]
/\ c0x in [-1, 1] /\ c0x -/ C0X in [-2b@u@, 2b@u@]
/\ t21 -/ (b0z * c0x) in [-2b@u@, 2b@u@]
/\ b0x in [-1, 1] /\ b0x -/ B0X in [-2b@u@, 2b@u@]
/\ t22 -/ (b0x * c0z) in [-2b@u@, 2b@u@]
/\ t23 -/ (t21 - t22) in [-2b@u@, 2b@u@]
/\ t24 -/ (b0x * c0y) in [-2b@u@, 2b@u@]
/\ t25 -/ (b0y * c0x) in [-2b@u@, 2b@u@]
/\ t26 -/ (t24 - t25) in [-2b@u@, 2b@u@]
/\ c1z in [-1, 1] /\ c1z -/ C1Z in [-2b@u@, 2b@u@]
/\ t27 -/ (b0y * c1z) in [-2b@u@, 2b@u@]
/\ c1y in [-1, 1] /\ c1y -/ C1Y in [-2b@u@, 2b@u@]
/\ t28 -/ (b0z * c1y) in [-2b@u@, 2b@u@]
/\ t29 -/ (t27 - t28) in [-2b@u@, 2b@u@]
/\ b1y in [-1, 1] /\ b1y -/ B1Y in [-2b@u@, 2b@u@]
/\ t36 -/ (b1y * c0z) in [-2b@u@, 2b@u@]
/\ b1z in [-1, 1] /\ b1z -/ B1Z in [-2b@u@, 2b@u@]
/\ t37 -/ (b1z * c0y) in [-2b@u@, 2b@u@]
/\ t38 -/ (t36 - t37) in [-2b@u@, 2b@u@]
/\ t45 -/ (t29 + t38) in [-2b@u@, 2b@u@]
/\ c1x in [-1, 1] /\ c1x -/ C1X in [-2b@u@, 2b@u@]
/\ t30 -/ (b0z * c1x) in [-2b@u@, 2b@u@]
/\ t31 -/ (b0x * c1z) in [-2b@u@, 2b@u@]
/\ t32 -/ (t30 - t31) in [-2b@u@, 2b@u@]
/\ t39 -/ (b1z * c0x) in [-2b@u@, 2b@u@]
/\ b1x in [-1, 1] /\ b1x -/ B1X in [-2b@u@, 2b@u@]
/\ t40 -/ (b1x * c0z) in [-2b@u@, 2b@u@]
/\ t41 -/ (t39 - t40) in [-2b@u@, 2b@u@]
/\ t46 -/ (t32 + t41) in [-2b@u@, 2b@u@]
/\ t33 -/ (b0x * c1y) in [-2b@u@, 2b@u@]
/\ t34 -/ (b0y * c1x) in [-2b@u@, 2b@u@]
/\ t35 -/ (t33 - t34) in [-2b@u@, 2b@u@]
/\ t42 -/ (b1x * c0y) in [-2b@u@, 2b@u@]
/\ t43 -/ (b1y * c0x) in [-2b@u@, 2b@u@]
/\ t44 -/ (t42 - t43) in [-2b@u@, 2b@u@]
/\ t47 -/ (t35 + t44) in [-2b@u@, 2b@u@]
/\ t48 -/ (b1y * c1z) in [-2b@u@, 2b@u@]
/\ t49 -/ (b1z * c1y) in [-2b@u@, 2b@u@]
/\ t50 -/ (t48 - t49) in [-2b@u@, 2b@u@]
/\ t51 -/ (b1z * c1x) in [-2b@u@, 2b@u@]
/\ t52 -/ (b1x * c1z) in [-2b@u@, 2b@u@]
/\ t53 -/ (t51 - t52) in [-2b@u@, 2b@u@]
/\ t54 -/ (b1x * c1y) in [-2b@u@, 2b@u@]
/\ t55 -/ (b1y * c1x) in [-2b@u@, 2b@u@]
/\ t56 -/ (t54 - t55) in [-2b@u@, 2b@u@]
->  t20 - T20 in [-60b@u@, 60b@u@]
/\ t23 - T23 in [-60b@u@, 60b@u@]
/\ t26 - T26 in [-60b@u@, 60b@u@]
/\ t45 - T45 in [-120b@u@, 120b@u@]
/\ t46 - T46 in [-120b@u@, 120b@u@]
/\ t47 - T47 in [-120b@u@, 120b@u@]
/\ t50 - T50 in [-60b@u@, 60b@u@]
/\ t53 - T53 in [-60b@u@, 60b@u@]
/\ t56 - T56 in [-60b@u@, 60b@u@] }
