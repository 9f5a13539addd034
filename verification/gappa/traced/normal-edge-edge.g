# The control points of the normal: core/src/kernels/coplanarity.rs, MovingTetrahedron::largest_normal.
# Written from the code by verification/src/proofs.rs; a test demands that it is what the code gives.
#
# Names and scale as in k0.g. Three components each of n0, h (twice the middle one) and n1: a component is off by at most 60u,
# the vector by sqrt(3) times that.
T19 = C0Y - B0Y;
T24 = T19 * P0Z;
T20 = C0Z - B0Z;
T25 = T20 * P0Y;
T26 = T24 - T25;
T27 = T20 * P0X;
T18 = C0X - B0X;
T28 = T18 * P0Z;
T29 = T27 - T28;
T30 = T18 * P0Y;
T31 = T19 * P0X;
T32 = T30 - T31;
T33 = T19 * P1Z;
T34 = T20 * P1Y;
T35 = T33 - T34;
T22 = C1Y - B1Y;
T42 = T22 * P0Z;
T23 = C1Z - B1Z;
T43 = T23 * P0Y;
T44 = T42 - T43;
T51 = T35 + T44;
T36 = T20 * P1X;
T37 = T18 * P1Z;
T38 = T36 - T37;
T45 = T23 * P0X;
T21 = C1X - B1X;
T46 = T21 * P0Z;
T47 = T45 - T46;
T52 = T38 + T47;
T39 = T18 * P1Y;
T40 = T19 * P1X;
T41 = T39 - T40;
T48 = T21 * P0Y;
T49 = T22 * P0X;
T50 = T48 - T49;
T53 = T41 + T50;
T54 = T22 * P1Z;
T55 = T23 * P1Y;
T56 = T54 - T55;
T57 = T23 * P1X;
T58 = T21 * P1Z;
T59 = T57 - T58;
T60 = T21 * P1Y;
T61 = T22 * P1X;
T62 = T60 - T61;

{ c0y in [-1, 1] /\ c0y -/ C0Y in [-2b@u@, 2b@u@]
/\ b0y in [-1, 1] /\ b0y -/ B0Y in [-2b@u@, 2b@u@]
/\ t19 -/ (c0y - b0y) in [-2b@u@, 2b@u@]
/\ p0z in [-1, 1] /\ p0z -/ P0Z in [-2b@u@, 2b@u@]
/\ t24 -/ (t19 * p0z) in [-2b@u@, 2b@u@]
/\ c0z in [-1, 1] /\ c0z -/ C0Z in [-2b@u@, 2b@u@]
/\ b0z in [-1, 1] /\ b0z -/ B0Z in [-2b@u@, 2b@u@]
/\ t20 -/ (c0z - b0z) in [-2b@u@, 2b@u@]
/\ p0y in [-1, 1] /\ p0y -/ P0Y in [-2b@u@, 2b@u@]
/\ t25 -/ (t20 * p0y) in [-2b@u@, 2b@u@]
/\ t26 -/ (t24 - t25) in [-2b@u@, 2b@u@]
/\ p0x in [-1, 1] /\ p0x -/ P0X in [-2b@u@, 2b@u@]
/\ t27 -/ (t20 * p0x) in [-2b@u@, 2b@u@]
/\ c0x in [-1, 1] /\ c0x -/ C0X in [-2b@u@, 2b@u@]
/\ b0x in [-1, 1] /\ b0x -/ B0X in [-2b@u@, 2b@u@]
/\ t18 -/ (c0x - b0x) in [-2b@u@, 2b@u@]
/\ t28 -/ (t18 * p0z) in [-2b@u@, 2b@u@]
/\ t29 -/ (t27 - t28) in [-2b@u@, 2b@u@]
/\ t30 -/ (t18 * p0y) in [-2b@u@, 2b@u@]
/\ t31 -/ (t19 * p0x) in [-2b@u@, 2b@u@]
/\ t32 -/ (t30 - t31) in [-2b@u@, 2b@u@]
/\ p1z in [-1, 1] /\ p1z -/ P1Z in [-2b@u@, 2b@u@]
/\ t33 -/ (t19 * p1z) in [-2b@u@, 2b@u@]
/\ p1y in [-1, 1] /\ p1y -/ P1Y in [-2b@u@, 2b@u@]
/\ t34 -/ (t20 * p1y) in [-2b@u@, 2b@u@]
/\ t35 -/ (t33 - t34) in [-2b@u@, 2b@u@]
/\ c1y in [-1, 1] /\ c1y -/ C1Y in [-2b@u@, 2b@u@]
/\ b1y in [-1, 1] /\ b1y -/ B1Y in [-2b@u@, 2b@u@]
/\ t22 -/ (c1y - b1y) in [-2b@u@, 2b@u@]
/\ t42 -/ (t22 * p0z) in [-2b@u@, 2b@u@]
/\ c1z in [-1, 1] /\ c1z -/ C1Z in [-2b@u@, 2b@u@]
/\ b1z in [-1, 1] /\ b1z -/ B1Z in [-2b@u@, 2b@u@]
/\ t23 -/ (c1z - b1z) in [-2b@u@, 2b@u@]
/\ t43 -/ (t23 * p0y) in [-2b@u@, 2b@u@]
/\ t44 -/ (t42 - t43) in [-2b@u@, 2b@u@]
/\ t51 -/ (t35 + t44) in [-2b@u@, 2b@u@]
/\ p1x in [-1, 1] /\ p1x -/ P1X in [-2b@u@, 2b@u@]
/\ t36 -/ (t20 * p1x) in [-2b@u@, 2b@u@]
/\ t37 -/ (t18 * p1z) in [-2b@u@, 2b@u@]
/\ t38 -/ (t36 - t37) in [-2b@u@, 2b@u@]
/\ t45 -/ (t23 * p0x) in [-2b@u@, 2b@u@]
/\ c1x in [-1, 1] /\ c1x -/ C1X in [-2b@u@, 2b@u@]
/\ b1x in [-1, 1] /\ b1x -/ B1X in [-2b@u@, 2b@u@]
/\ t21 -/ (c1x - b1x) in [-2b@u@, 2b@u@]
/\ t46 -/ (t21 * p0z) in [-2b@u@, 2b@u@]
/\ t47 -/ (t45 - t46) in [-2b@u@, 2b@u@]
/\ t52 -/ (t38 + t47) in [-2b@u@, 2b@u@]
/\ t39 -/ (t18 * p1y) in [-2b@u@, 2b@u@]
/\ t40 -/ (t19 * p1x) in [-2b@u@, 2b@u@]
/\ t41 -/ (t39 - t40) in [-2b@u@, 2b@u@]
/\ t48 -/ (t21 * p0y) in [-2b@u@, 2b@u@]
/\ t49 -/ (t22 * p0x) in [-2b@u@, 2b@u@]
/\ t50 -/ (t48 - t49) in [-2b@u@, 2b@u@]
/\ t53 -/ (t41 + t50) in [-2b@u@, 2b@u@]
/\ t54 -/ (t22 * p1z) in [-2b@u@, 2b@u@]
/\ t55 -/ (t23 * p1y) in [-2b@u@, 2b@u@]
/\ t56 -/ (t54 - t55) in [-2b@u@, 2b@u@]
/\ t57 -/ (t23 * p1x) in [-2b@u@, 2b@u@]
/\ t58 -/ (t21 * p1z) in [-2b@u@, 2b@u@]
/\ t59 -/ (t57 - t58) in [-2b@u@, 2b@u@]
/\ t60 -/ (t21 * p1y) in [-2b@u@, 2b@u@]
/\ t61 -/ (t22 * p1x) in [-2b@u@, 2b@u@]
/\ t62 -/ (t60 - t61) in [-2b@u@, 2b@u@]
->  t26 - T26 in [-60b@u@, 60b@u@]
/\ t29 - T29 in [-60b@u@, 60b@u@]
/\ t32 - T32 in [-60b@u@, 60b@u@]
/\ t51 - T51 in [-120b@u@, 120b@u@]
/\ t52 - T52 in [-120b@u@, 120b@u@]
/\ t53 - T53 in [-120b@u@, 120b@u@]
/\ t56 - T56 in [-60b@u@, 60b@u@]
/\ t59 - T59 in [-60b@u@, 60b@u@]
/\ t62 - T62 in [-60b@u@, 60b@u@] }
