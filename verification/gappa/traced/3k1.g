# The control value 3k1: core/src/kernels/coplanarity.rs, MovingTetrahedron::control_values.
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
T62 = P0X * T45;
T30 = B0Z * C1X;
T31 = B0X * C1Z;
T32 = T30 - T31;
T39 = B1Z * C0X;
T40 = B1X * C0Z;
T41 = T39 - T40;
T46 = T32 + T41;
T63 = P0Y * T46;
T64 = T62 + T63;
T33 = B0X * C1Y;
T34 = B0Y * C1X;
T35 = T33 - T34;
T42 = B1X * C0Y;
T43 = B1Y * C0X;
T44 = T42 - T43;
T47 = T35 + T44;
T65 = P0Z * T47;
T66 = T64 + T65;
T18 = B0Y * C0Z;
T19 = B0Z * C0Y;
T20 = T18 - T19;
T67 = P1X * T20;
T21 = B0Z * C0X;
T22 = B0X * C0Z;
T23 = T21 - T22;
T68 = P1Y * T23;
T69 = T67 + T68;
T24 = B0X * C0Y;
T25 = B0Y * C0X;
T26 = T24 - T25;
T70 = P1Z * T26;
T71 = T69 + T70;
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
q62 = (p0x * q45) * (1 + eq62) + lq62;
x62 = (xp0x * T45 + P0X * x45) + L * (xp0x * x45);
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
q63 = (p0y * q46) * (1 + eq63) + lq63;
x63 = (xp0y * T46 + P0Y * x46) + L * (xp0y * x46);
q64 = (q62 + q63) * (1 + eq64) + lq64;
x64 = x62 + x63;
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
q65 = (p0z * q47) * (1 + eq65) + lq65;
x65 = (xp0z * T47 + P0Z * x47) + L * (xp0z * x47);
q66 = (q64 + q65) * (1 + eq66) + lq66;
x66 = x64 + x65;
q18 = (0) * (1 + eq18) + lq18;
x18 = (xb0y * C0Z + B0Y * xc0z) + L * (xb0y * xc0z);
q19 = (0) * (1 + eq19) + lq19;
x19 = (xb0z * C0Y + B0Z * xc0y) + L * (xb0z * xc0y);
q20 = (q18 - q19) * (1 + eq20) + lq20;
x20 = x18 - x19;
q67 = (p1x * q20) * (1 + eq67) + lq67;
x67 = (xp1x * T20 + P1X * x20) + L * (xp1x * x20);
q21 = (0) * (1 + eq21) + lq21;
x21 = (xb0z * C0X + B0Z * xc0x) + L * (xb0z * xc0x);
q22 = (0) * (1 + eq22) + lq22;
x22 = (xb0x * C0Z + B0X * xc0z) + L * (xb0x * xc0z);
q23 = (q21 - q22) * (1 + eq23) + lq23;
x23 = x21 - x22;
q68 = (p1y * q23) * (1 + eq68) + lq68;
x68 = (xp1y * T23 + P1Y * x23) + L * (xp1y * x23);
q69 = (q67 + q68) * (1 + eq69) + lq69;
x69 = x67 + x68;
q24 = (0) * (1 + eq24) + lq24;
x24 = (xb0x * C0Y + B0X * xc0y) + L * (xb0x * xc0y);
q25 = (0) * (1 + eq25) + lq25;
x25 = (xb0y * C0X + B0Y * xc0x) + L * (xb0y * xc0x);
q26 = (q24 - q25) * (1 + eq26) + lq26;
x26 = x24 - x25;
q70 = (p1z * q26) * (1 + eq70) + lq70;
x70 = (xp1z * T26 + P1Z * x26) + L * (xp1z * x26);
q71 = (q69 + q70) * (1 + eq71) + lq71;
x71 = x69 + x70;

{ p0x in [-1, 1] /\ p0x -/ P0X in [-2b@u@, 2b@u@]
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
/\ t62 -/ (p0x * t45) in [-2b@u@, 2b@u@]
/\ p0y in [-1, 1] /\ p0y -/ P0Y in [-2b@u@, 2b@u@]
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
/\ t63 -/ (p0y * t46) in [-2b@u@, 2b@u@]
/\ t64 -/ (t62 + t63) in [-2b@u@, 2b@u@]
/\ p0z in [-1, 1] /\ p0z -/ P0Z in [-2b@u@, 2b@u@]
/\ t33 -/ (b0x * c1y) in [-2b@u@, 2b@u@]
/\ t34 -/ (b0y * c1x) in [-2b@u@, 2b@u@]
/\ t35 -/ (t33 - t34) in [-2b@u@, 2b@u@]
/\ t42 -/ (b1x * c0y) in [-2b@u@, 2b@u@]
/\ t43 -/ (b1y * c0x) in [-2b@u@, 2b@u@]
/\ t44 -/ (t42 - t43) in [-2b@u@, 2b@u@]
/\ t47 -/ (t35 + t44) in [-2b@u@, 2b@u@]
/\ t65 -/ (p0z * t47) in [-2b@u@, 2b@u@]
/\ t66 -/ (t64 + t65) in [-2b@u@, 2b@u@]
/\ p1x in [-1, 1] /\ p1x -/ P1X in [-2b@u@, 2b@u@]
/\ t18 -/ (b0y * c0z) in [-2b@u@, 2b@u@]
/\ t19 -/ (b0z * c0y) in [-2b@u@, 2b@u@]
/\ t20 -/ (t18 - t19) in [-2b@u@, 2b@u@]
/\ t67 -/ (p1x * t20) in [-2b@u@, 2b@u@]
/\ p1y in [-1, 1] /\ p1y -/ P1Y in [-2b@u@, 2b@u@]
/\ t21 -/ (b0z * c0x) in [-2b@u@, 2b@u@]
/\ t22 -/ (b0x * c0z) in [-2b@u@, 2b@u@]
/\ t23 -/ (t21 - t22) in [-2b@u@, 2b@u@]
/\ t68 -/ (p1y * t23) in [-2b@u@, 2b@u@]
/\ t69 -/ (t67 + t68) in [-2b@u@, 2b@u@]
/\ p1z in [-1, 1] /\ p1z -/ P1Z in [-2b@u@, 2b@u@]
/\ t24 -/ (b0x * c0y) in [-2b@u@, 2b@u@]
/\ t25 -/ (b0y * c0x) in [-2b@u@, 2b@u@]
/\ t26 -/ (t24 - t25) in [-2b@u@, 2b@u@]
/\ t70 -/ (p1z * t26) in [-2b@u@, 2b@u@]
/\ t71 -/ (t69 + t70) in [-2b@u@, 2b@u@]
/\ xp0x in [-3, 3]
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
/\ eq62 in [-2b@u@, 2b@u@] /\ lq62 in [-1, 1]
/\ xp0y in [-3, 3]
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
/\ eq63 in [-2b@u@, 2b@u@] /\ lq63 in [-1, 1]
/\ eq64 in [-2b@u@, 2b@u@] /\ lq64 in [-1, 1]
/\ xp0z in [-3, 3]
/\ eq33 in [-2b@u@, 2b@u@] /\ lq33 in [-1, 1]
/\ eq34 in [-2b@u@, 2b@u@] /\ lq34 in [-1, 1]
/\ eq35 in [-2b@u@, 2b@u@] /\ lq35 in [-1, 1]
/\ eq42 in [-2b@u@, 2b@u@] /\ lq42 in [-1, 1]
/\ eq43 in [-2b@u@, 2b@u@] /\ lq43 in [-1, 1]
/\ eq44 in [-2b@u@, 2b@u@] /\ lq44 in [-1, 1]
/\ eq47 in [-2b@u@, 2b@u@] /\ lq47 in [-1, 1]
/\ eq65 in [-2b@u@, 2b@u@] /\ lq65 in [-1, 1]
/\ eq66 in [-2b@u@, 2b@u@] /\ lq66 in [-1, 1]
/\ xp1x in [-3, 3]
/\ eq18 in [-2b@u@, 2b@u@] /\ lq18 in [-1, 1]
/\ eq19 in [-2b@u@, 2b@u@] /\ lq19 in [-1, 1]
/\ eq20 in [-2b@u@, 2b@u@] /\ lq20 in [-1, 1]
/\ eq67 in [-2b@u@, 2b@u@] /\ lq67 in [-1, 1]
/\ xp1y in [-3, 3]
/\ eq21 in [-2b@u@, 2b@u@] /\ lq21 in [-1, 1]
/\ eq22 in [-2b@u@, 2b@u@] /\ lq22 in [-1, 1]
/\ eq23 in [-2b@u@, 2b@u@] /\ lq23 in [-1, 1]
/\ eq68 in [-2b@u@, 2b@u@] /\ lq68 in [-1, 1]
/\ eq69 in [-2b@u@, 2b@u@] /\ lq69 in [-1, 1]
/\ xp1z in [-3, 3]
/\ eq24 in [-2b@u@, 2b@u@] /\ lq24 in [-1, 1]
/\ eq25 in [-2b@u@, 2b@u@] /\ lq25 in [-1, 1]
/\ eq26 in [-2b@u@, 2b@u@] /\ lq26 in [-1, 1]
/\ eq70 in [-2b@u@, 2b@u@] /\ lq70 in [-1, 1]
/\ eq71 in [-2b@u@, 2b@u@] /\ lq71 in [-1, 1]
/\ L in [0, 1b@lambda@]
->  (t66 + t71) - (T66 + T71) in [-380b@u@, 380b@u@]
/\ q66 + q71 in [-41, 41]
/\ x66 + x71 in [-163, 163] }
