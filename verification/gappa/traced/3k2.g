# The control value 3k2: core/src/kernels/coplanarity.rs, MovingTetrahedron::control_values.
# Written from the code by verification/src/proofs.rs; a test demands that it is what the code gives.
#
# Each difference of points (b0x, …) is at most 1 as computed: errors scale with each of the three edges, or axes. Its relative
# error is at most 2u. A lower-case name is the result of one rounded step, the same in capitals is exact. The last addition
# does not count: the value is compared with a floating-point number.
#
# What underflow adds, in units of L, which is at most lambda: q… by a step that loses up to 1 (its own) and passes on what it
# was given, x… by differences that are off by up to 3. Both are of degree 2 at most in the components, hence in 1 + M.
T27 = B0Y * C1Z;
T28 = B0Z * C1Y;
T29 = T27 - T28;
T36 = B1Y * C0Z;
T37 = B1Z * C0Y;
T38 = T36 - T37;
T45 = T29 + T38;
T73 = P1X * T45;
T30 = B0Z * C1X;
T31 = B0X * C1Z;
T32 = T30 - T31;
T39 = B1Z * C0X;
T40 = B1X * C0Z;
T41 = T39 - T40;
T46 = T32 + T41;
T74 = P1Y * T46;
T75 = T73 + T74;
T33 = B0X * C1Y;
T34 = B0Y * C1X;
T35 = T33 - T34;
T42 = B1X * C0Y;
T43 = B1Y * C0X;
T44 = T42 - T43;
T47 = T35 + T44;
T76 = P1Z * T47;
T77 = T75 + T76;
T48 = B1Y * C1Z;
T49 = B1Z * C1Y;
T50 = T48 - T49;
T78 = P0X * T50;
T51 = B1Z * C1X;
T52 = B1X * C1Z;
T53 = T51 - T52;
T79 = P0Y * T53;
T80 = T78 + T79;
T54 = B1X * C1Y;
T55 = B1Y * C1X;
T56 = T54 - T55;
T81 = P0Z * T56;
T82 = T80 + T81;
q27 = (0) * (1 + eq27) + lq27;
x27 = (xb0y * C1Z + B0Y * xc1z) + L * (xb0y * xc1z);
q28 = (0) * (1 + eq28) + lq28;
x28 = (xb0z * C1Y + B0Z * xc1y) + L * (xb0z * xc1y);
q29 = (q27 - q28) * (1 + eq29) + lq29;
x29 = x27 - x28;
q36 = (0) * (1 + eq36) + lq36;
x36 = (xb1y * C0Z + B1Y * xc0z) + L * (xb1y * xc0z);
q37 = (0) * (1 + eq37) + lq37;
x37 = (xb1z * C0Y + B1Z * xc0y) + L * (xb1z * xc0y);
q38 = (q36 - q37) * (1 + eq38) + lq38;
x38 = x36 - x37;
q45 = (q29 + q38) * (1 + eq45) + lq45;
x45 = x29 + x38;
q73 = (p1x * q45) * (1 + eq73) + lq73;
x73 = (xp1x * T45 + P1X * x45) + L * (xp1x * x45);
q30 = (0) * (1 + eq30) + lq30;
x30 = (xb0z * C1X + B0Z * xc1x) + L * (xb0z * xc1x);
q31 = (0) * (1 + eq31) + lq31;
x31 = (xb0x * C1Z + B0X * xc1z) + L * (xb0x * xc1z);
q32 = (q30 - q31) * (1 + eq32) + lq32;
x32 = x30 - x31;
q39 = (0) * (1 + eq39) + lq39;
x39 = (xb1z * C0X + B1Z * xc0x) + L * (xb1z * xc0x);
q40 = (0) * (1 + eq40) + lq40;
x40 = (xb1x * C0Z + B1X * xc0z) + L * (xb1x * xc0z);
q41 = (q39 - q40) * (1 + eq41) + lq41;
x41 = x39 - x40;
q46 = (q32 + q41) * (1 + eq46) + lq46;
x46 = x32 + x41;
q74 = (p1y * q46) * (1 + eq74) + lq74;
x74 = (xp1y * T46 + P1Y * x46) + L * (xp1y * x46);
q75 = (q73 + q74) * (1 + eq75) + lq75;
x75 = x73 + x74;
q33 = (0) * (1 + eq33) + lq33;
x33 = (xb0x * C1Y + B0X * xc1y) + L * (xb0x * xc1y);
q34 = (0) * (1 + eq34) + lq34;
x34 = (xb0y * C1X + B0Y * xc1x) + L * (xb0y * xc1x);
q35 = (q33 - q34) * (1 + eq35) + lq35;
x35 = x33 - x34;
q42 = (0) * (1 + eq42) + lq42;
x42 = (xb1x * C0Y + B1X * xc0y) + L * (xb1x * xc0y);
q43 = (0) * (1 + eq43) + lq43;
x43 = (xb1y * C0X + B1Y * xc0x) + L * (xb1y * xc0x);
q44 = (q42 - q43) * (1 + eq44) + lq44;
x44 = x42 - x43;
q47 = (q35 + q44) * (1 + eq47) + lq47;
x47 = x35 + x44;
q76 = (p1z * q47) * (1 + eq76) + lq76;
x76 = (xp1z * T47 + P1Z * x47) + L * (xp1z * x47);
q77 = (q75 + q76) * (1 + eq77) + lq77;
x77 = x75 + x76;
q48 = (0) * (1 + eq48) + lq48;
x48 = (xb1y * C1Z + B1Y * xc1z) + L * (xb1y * xc1z);
q49 = (0) * (1 + eq49) + lq49;
x49 = (xb1z * C1Y + B1Z * xc1y) + L * (xb1z * xc1y);
q50 = (q48 - q49) * (1 + eq50) + lq50;
x50 = x48 - x49;
q78 = (p0x * q50) * (1 + eq78) + lq78;
x78 = (xp0x * T50 + P0X * x50) + L * (xp0x * x50);
q51 = (0) * (1 + eq51) + lq51;
x51 = (xb1z * C1X + B1Z * xc1x) + L * (xb1z * xc1x);
q52 = (0) * (1 + eq52) + lq52;
x52 = (xb1x * C1Z + B1X * xc1z) + L * (xb1x * xc1z);
q53 = (q51 - q52) * (1 + eq53) + lq53;
x53 = x51 - x52;
q79 = (p0y * q53) * (1 + eq79) + lq79;
x79 = (xp0y * T53 + P0Y * x53) + L * (xp0y * x53);
q80 = (q78 + q79) * (1 + eq80) + lq80;
x80 = x78 + x79;
q54 = (0) * (1 + eq54) + lq54;
x54 = (xb1x * C1Y + B1X * xc1y) + L * (xb1x * xc1y);
q55 = (0) * (1 + eq55) + lq55;
x55 = (xb1y * C1X + B1Y * xc1x) + L * (xb1y * xc1x);
q56 = (q54 - q55) * (1 + eq56) + lq56;
x56 = x54 - x55;
q81 = (p0z * q56) * (1 + eq81) + lq81;
x81 = (xp0z * T56 + P0Z * x56) + L * (xp0z * x56);
q82 = (q80 + q81) * (1 + eq82) + lq82;
x82 = x80 + x81;

{ p1x in [-1, 1] /\ p1x -/ P1X in [-2b@u@, 2b@u@]
/\ b0y in [-1, 1] /\ b0y -/ B0Y in [-2b@u@, 2b@u@]
/\ c1z in [-1, 1] /\ c1z -/ C1Z in [-2b@u@, 2b@u@]
/\ t27 -/ (b0y * c1z) in [-2b@u@, 2b@u@]
/\ b0z in [-1, 1] /\ b0z -/ B0Z in [-2b@u@, 2b@u@]
/\ c1y in [-1, 1] /\ c1y -/ C1Y in [-2b@u@, 2b@u@]
/\ t28 -/ (b0z * c1y) in [-2b@u@, 2b@u@]
/\ t29 -/ (t27 - t28) in [-2b@u@, 2b@u@]
/\ b1y in [-1, 1] /\ b1y -/ B1Y in [-2b@u@, 2b@u@]
/\ c0z in [-1, 1] /\ c0z -/ C0Z in [-2b@u@, 2b@u@]
/\ t36 -/ (b1y * c0z) in [-2b@u@, 2b@u@]
/\ b1z in [-1, 1] /\ b1z -/ B1Z in [-2b@u@, 2b@u@]
/\ c0y in [-1, 1] /\ c0y -/ C0Y in [-2b@u@, 2b@u@]
/\ t37 -/ (b1z * c0y) in [-2b@u@, 2b@u@]
/\ t38 -/ (t36 - t37) in [-2b@u@, 2b@u@]
/\ t45 -/ (t29 + t38) in [-2b@u@, 2b@u@]
/\ t73 -/ (p1x * t45) in [-2b@u@, 2b@u@]
/\ p1y in [-1, 1] /\ p1y -/ P1Y in [-2b@u@, 2b@u@]
/\ c1x in [-1, 1] /\ c1x -/ C1X in [-2b@u@, 2b@u@]
/\ t30 -/ (b0z * c1x) in [-2b@u@, 2b@u@]
/\ b0x in [-1, 1] /\ b0x -/ B0X in [-2b@u@, 2b@u@]
/\ t31 -/ (b0x * c1z) in [-2b@u@, 2b@u@]
/\ t32 -/ (t30 - t31) in [-2b@u@, 2b@u@]
/\ c0x in [-1, 1] /\ c0x -/ C0X in [-2b@u@, 2b@u@]
/\ t39 -/ (b1z * c0x) in [-2b@u@, 2b@u@]
/\ b1x in [-1, 1] /\ b1x -/ B1X in [-2b@u@, 2b@u@]
/\ t40 -/ (b1x * c0z) in [-2b@u@, 2b@u@]
/\ t41 -/ (t39 - t40) in [-2b@u@, 2b@u@]
/\ t46 -/ (t32 + t41) in [-2b@u@, 2b@u@]
/\ t74 -/ (p1y * t46) in [-2b@u@, 2b@u@]
/\ t75 -/ (t73 + t74) in [-2b@u@, 2b@u@]
/\ p1z in [-1, 1] /\ p1z -/ P1Z in [-2b@u@, 2b@u@]
/\ t33 -/ (b0x * c1y) in [-2b@u@, 2b@u@]
/\ t34 -/ (b0y * c1x) in [-2b@u@, 2b@u@]
/\ t35 -/ (t33 - t34) in [-2b@u@, 2b@u@]
/\ t42 -/ (b1x * c0y) in [-2b@u@, 2b@u@]
/\ t43 -/ (b1y * c0x) in [-2b@u@, 2b@u@]
/\ t44 -/ (t42 - t43) in [-2b@u@, 2b@u@]
/\ t47 -/ (t35 + t44) in [-2b@u@, 2b@u@]
/\ t76 -/ (p1z * t47) in [-2b@u@, 2b@u@]
/\ t77 -/ (t75 + t76) in [-2b@u@, 2b@u@]
/\ p0x in [-1, 1] /\ p0x -/ P0X in [-2b@u@, 2b@u@]
/\ t48 -/ (b1y * c1z) in [-2b@u@, 2b@u@]
/\ t49 -/ (b1z * c1y) in [-2b@u@, 2b@u@]
/\ t50 -/ (t48 - t49) in [-2b@u@, 2b@u@]
/\ t78 -/ (p0x * t50) in [-2b@u@, 2b@u@]
/\ p0y in [-1, 1] /\ p0y -/ P0Y in [-2b@u@, 2b@u@]
/\ t51 -/ (b1z * c1x) in [-2b@u@, 2b@u@]
/\ t52 -/ (b1x * c1z) in [-2b@u@, 2b@u@]
/\ t53 -/ (t51 - t52) in [-2b@u@, 2b@u@]
/\ t79 -/ (p0y * t53) in [-2b@u@, 2b@u@]
/\ t80 -/ (t78 + t79) in [-2b@u@, 2b@u@]
/\ p0z in [-1, 1] /\ p0z -/ P0Z in [-2b@u@, 2b@u@]
/\ t54 -/ (b1x * c1y) in [-2b@u@, 2b@u@]
/\ t55 -/ (b1y * c1x) in [-2b@u@, 2b@u@]
/\ t56 -/ (t54 - t55) in [-2b@u@, 2b@u@]
/\ t81 -/ (p0z * t56) in [-2b@u@, 2b@u@]
/\ t82 -/ (t80 + t81) in [-2b@u@, 2b@u@]
/\ xp1x in [-3, 3]
/\ xb0y in [-3, 3]
/\ xc1z in [-3, 3]
/\ eq27 in [-2b@u@, 2b@u@] /\ lq27 in [-1, 1]
/\ xb0z in [-3, 3]
/\ xc1y in [-3, 3]
/\ eq28 in [-2b@u@, 2b@u@] /\ lq28 in [-1, 1]
/\ eq29 in [-2b@u@, 2b@u@] /\ lq29 in [-1, 1]
/\ xb1y in [-3, 3]
/\ xc0z in [-3, 3]
/\ eq36 in [-2b@u@, 2b@u@] /\ lq36 in [-1, 1]
/\ xb1z in [-3, 3]
/\ xc0y in [-3, 3]
/\ eq37 in [-2b@u@, 2b@u@] /\ lq37 in [-1, 1]
/\ eq38 in [-2b@u@, 2b@u@] /\ lq38 in [-1, 1]
/\ eq45 in [-2b@u@, 2b@u@] /\ lq45 in [-1, 1]
/\ eq73 in [-2b@u@, 2b@u@] /\ lq73 in [-1, 1]
/\ xp1y in [-3, 3]
/\ xc1x in [-3, 3]
/\ eq30 in [-2b@u@, 2b@u@] /\ lq30 in [-1, 1]
/\ xb0x in [-3, 3]
/\ eq31 in [-2b@u@, 2b@u@] /\ lq31 in [-1, 1]
/\ eq32 in [-2b@u@, 2b@u@] /\ lq32 in [-1, 1]
/\ xc0x in [-3, 3]
/\ eq39 in [-2b@u@, 2b@u@] /\ lq39 in [-1, 1]
/\ xb1x in [-3, 3]
/\ eq40 in [-2b@u@, 2b@u@] /\ lq40 in [-1, 1]
/\ eq41 in [-2b@u@, 2b@u@] /\ lq41 in [-1, 1]
/\ eq46 in [-2b@u@, 2b@u@] /\ lq46 in [-1, 1]
/\ eq74 in [-2b@u@, 2b@u@] /\ lq74 in [-1, 1]
/\ eq75 in [-2b@u@, 2b@u@] /\ lq75 in [-1, 1]
/\ xp1z in [-3, 3]
/\ eq33 in [-2b@u@, 2b@u@] /\ lq33 in [-1, 1]
/\ eq34 in [-2b@u@, 2b@u@] /\ lq34 in [-1, 1]
/\ eq35 in [-2b@u@, 2b@u@] /\ lq35 in [-1, 1]
/\ eq42 in [-2b@u@, 2b@u@] /\ lq42 in [-1, 1]
/\ eq43 in [-2b@u@, 2b@u@] /\ lq43 in [-1, 1]
/\ eq44 in [-2b@u@, 2b@u@] /\ lq44 in [-1, 1]
/\ eq47 in [-2b@u@, 2b@u@] /\ lq47 in [-1, 1]
/\ eq76 in [-2b@u@, 2b@u@] /\ lq76 in [-1, 1]
/\ eq77 in [-2b@u@, 2b@u@] /\ lq77 in [-1, 1]
/\ xp0x in [-3, 3]
/\ eq48 in [-2b@u@, 2b@u@] /\ lq48 in [-1, 1]
/\ eq49 in [-2b@u@, 2b@u@] /\ lq49 in [-1, 1]
/\ eq50 in [-2b@u@, 2b@u@] /\ lq50 in [-1, 1]
/\ eq78 in [-2b@u@, 2b@u@] /\ lq78 in [-1, 1]
/\ xp0y in [-3, 3]
/\ eq51 in [-2b@u@, 2b@u@] /\ lq51 in [-1, 1]
/\ eq52 in [-2b@u@, 2b@u@] /\ lq52 in [-1, 1]
/\ eq53 in [-2b@u@, 2b@u@] /\ lq53 in [-1, 1]
/\ eq79 in [-2b@u@, 2b@u@] /\ lq79 in [-1, 1]
/\ eq80 in [-2b@u@, 2b@u@] /\ lq80 in [-1, 1]
/\ xp0z in [-3, 3]
/\ eq54 in [-2b@u@, 2b@u@] /\ lq54 in [-1, 1]
/\ eq55 in [-2b@u@, 2b@u@] /\ lq55 in [-1, 1]
/\ eq56 in [-2b@u@, 2b@u@] /\ lq56 in [-1, 1]
/\ eq81 in [-2b@u@, 2b@u@] /\ lq81 in [-1, 1]
/\ eq82 in [-2b@u@, 2b@u@] /\ lq82 in [-1, 1]
/\ L in [0, 1b@lambda@]
->  (t77 + t82) - (T77 + T82) in [-380b@u@, 380b@u@]
/\ q77 + q82 in [-41, 41]
/\ x77 + x82 in [-163, 163] }
