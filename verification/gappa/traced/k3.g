# The control value k3: core/src/kernels/coplanarity.rs, MovingTetrahedron::control_values.
# Written from the code by verification/src/proofs.rs; a test demands that it is what the code gives.
#
# Each difference of points (b0x, …) is at most 1 as computed: errors scale with each of the three edges, or axes. Its relative
# error is at most 2u. A lower-case name is the result of one rounded step, the same in capitals is exact. The last addition
# does not count: the value is compared with a floating-point number.
#
# What underflow adds, in units of L, which is at most lambda: q… by a step that loses up to 1 (its own) and passes on what it
# was given, x… by differences that are off by up to 3. Both are of degree 2 at most in the components, hence in 1 + M.
T48 = B1Y * C1Z;
T49 = B1Z * C1Y;
T50 = T48 - T49;
T84 = P1X * T50;
T51 = B1Z * C1X;
T52 = B1X * C1Z;
T53 = T51 - T52;
T85 = P1Y * T53;
T86 = T84 + T85;
T54 = B1X * C1Y;
T55 = B1Y * C1X;
T56 = T54 - T55;
T87 = P1Z * T56;
q48 = (0) * (1 + eq48) + lq48;
x48 = (xb1y * C1Z + B1Y * xc1z) + L * (xb1y * xc1z);
q49 = (0) * (1 + eq49) + lq49;
x49 = (xb1z * C1Y + B1Z * xc1y) + L * (xb1z * xc1y);
q50 = (q48 - q49) * (1 + eq50) + lq50;
x50 = x48 - x49;
q84 = (p1x * q50) * (1 + eq84) + lq84;
x84 = (xp1x * T50 + P1X * x50) + L * (xp1x * x50);
q51 = (0) * (1 + eq51) + lq51;
x51 = (xb1z * C1X + B1Z * xc1x) + L * (xb1z * xc1x);
q52 = (0) * (1 + eq52) + lq52;
x52 = (xb1x * C1Z + B1X * xc1z) + L * (xb1x * xc1z);
q53 = (q51 - q52) * (1 + eq53) + lq53;
x53 = x51 - x52;
q85 = (p1y * q53) * (1 + eq85) + lq85;
x85 = (xp1y * T53 + P1Y * x53) + L * (xp1y * x53);
q86 = (q84 + q85) * (1 + eq86) + lq86;
x86 = x84 + x85;
q54 = (0) * (1 + eq54) + lq54;
x54 = (xb1x * C1Y + B1X * xc1y) + L * (xb1x * xc1y);
q55 = (0) * (1 + eq55) + lq55;
x55 = (xb1y * C1X + B1Y * xc1x) + L * (xb1y * xc1x);
q56 = (q54 - q55) * (1 + eq56) + lq56;
x56 = x54 - x55;
q87 = (p1z * q56) * (1 + eq87) + lq87;
x87 = (xp1z * T56 + P1Z * x56) + L * (xp1z * x56);

{ p1x in [-1, 1] /\ p1x -/ P1X in [-2b@u@, 2b@u@]
/\ b1y in [-1, 1] /\ b1y -/ B1Y in [-2b@u@, 2b@u@]
/\ c1z in [-1, 1] /\ c1z -/ C1Z in [-2b@u@, 2b@u@]
/\ t48 -/ (b1y * c1z) in [-2b@u@, 2b@u@]
/\ b1z in [-1, 1] /\ b1z -/ B1Z in [-2b@u@, 2b@u@]
/\ c1y in [-1, 1] /\ c1y -/ C1Y in [-2b@u@, 2b@u@]
/\ t49 -/ (b1z * c1y) in [-2b@u@, 2b@u@]
/\ t50 -/ (t48 - t49) in [-2b@u@, 2b@u@]
/\ t84 -/ (p1x * t50) in [-2b@u@, 2b@u@]
/\ p1y in [-1, 1] /\ p1y -/ P1Y in [-2b@u@, 2b@u@]
/\ c1x in [-1, 1] /\ c1x -/ C1X in [-2b@u@, 2b@u@]
/\ t51 -/ (b1z * c1x) in [-2b@u@, 2b@u@]
/\ b1x in [-1, 1] /\ b1x -/ B1X in [-2b@u@, 2b@u@]
/\ t52 -/ (b1x * c1z) in [-2b@u@, 2b@u@]
/\ t53 -/ (t51 - t52) in [-2b@u@, 2b@u@]
/\ t85 -/ (p1y * t53) in [-2b@u@, 2b@u@]
/\ t86 -/ (t84 + t85) in [-2b@u@, 2b@u@]
/\ p1z in [-1, 1] /\ p1z -/ P1Z in [-2b@u@, 2b@u@]
/\ t54 -/ (b1x * c1y) in [-2b@u@, 2b@u@]
/\ t55 -/ (b1y * c1x) in [-2b@u@, 2b@u@]
/\ t56 -/ (t54 - t55) in [-2b@u@, 2b@u@]
/\ t87 -/ (p1z * t56) in [-2b@u@, 2b@u@]
/\ xp1x in [-3, 3]
/\ xb1y in [-3, 3]
/\ xc1z in [-3, 3]
/\ eq48 in [-2b@u@, 2b@u@] /\ lq48 in [-1, 1]
/\ xb1z in [-3, 3]
/\ xc1y in [-3, 3]
/\ eq49 in [-2b@u@, 2b@u@] /\ lq49 in [-1, 1]
/\ eq50 in [-2b@u@, 2b@u@] /\ lq50 in [-1, 1]
/\ eq84 in [-2b@u@, 2b@u@] /\ lq84 in [-1, 1]
/\ xp1y in [-3, 3]
/\ xc1x in [-3, 3]
/\ eq51 in [-2b@u@, 2b@u@] /\ lq51 in [-1, 1]
/\ xb1x in [-3, 3]
/\ eq52 in [-2b@u@, 2b@u@] /\ lq52 in [-1, 1]
/\ eq53 in [-2b@u@, 2b@u@] /\ lq53 in [-1, 1]
/\ eq85 in [-2b@u@, 2b@u@] /\ lq85 in [-1, 1]
/\ eq86 in [-2b@u@, 2b@u@] /\ lq86 in [-1, 1]
/\ xp1z in [-3, 3]
/\ eq54 in [-2b@u@, 2b@u@] /\ lq54 in [-1, 1]
/\ eq55 in [-2b@u@, 2b@u@] /\ lq55 in [-1, 1]
/\ eq56 in [-2b@u@, 2b@u@] /\ lq56 in [-1, 1]
/\ eq87 in [-2b@u@, 2b@u@] /\ lq87 in [-1, 1]
/\ L in [0, 1b@lambda@]
->  (t86 + t87) - (T86 + T87) in [-95b@u@, 95b@u@]
/\ q86 + q87 in [-17, 17]
/\ x86 + x87 in [-55, 55] }
