# The control value k0: core/src/kernels/coplanarity.rs, MovingTetrahedron::control_values.
# Written from the code by verification/src/proofs.rs; a test demands that it is what the code gives.
#
# Each difference of points (b0x, …) is at most 1 as computed: errors scale with each of the three edges, or axes. Its relative
# error is at most 2u. A lower-case name is the result of one rounded step, the same in capitals is exact. The last addition
# does not count: the value is compared with a floating-point number.
#
# What underflow adds, in units of L, which is at most lambda: q… by a step that loses up to 1 (its own) and passes on what it
# was given, x… by differences that are off by up to 3. Both are of degree 2 at most in the components, hence in 1 + M.
T18 = B0Y * C0Z;
T19 = B0Z * C0Y;
T20 = T18 - T19;
T57 = P0X * T20;
T21 = B0Z * C0X;
T22 = B0X * C0Z;
T23 = T21 - T22;
T58 = P0Y * T23;
T59 = T57 + T58;
T24 = B0X * C0Y;
T25 = B0Y * C0X;
T26 = T24 - T25;
T60 = P0Z * T26;
q18 = (0) * (1 + eq18) + lq18;
x18 = (xb0y * C0Z + B0Y * xc0z) + L * (xb0y * xc0z);
q19 = (0) * (1 + eq19) + lq19;
x19 = (xb0z * C0Y + B0Z * xc0y) + L * (xb0z * xc0y);
q20 = (q18 - q19) * (1 + eq20) + lq20;
x20 = x18 - x19;
q57 = (p0x * q20) * (1 + eq57) + lq57;
x57 = (xp0x * T20 + P0X * x20) + L * (xp0x * x20);
q21 = (0) * (1 + eq21) + lq21;
x21 = (xb0z * C0X + B0Z * xc0x) + L * (xb0z * xc0x);
q22 = (0) * (1 + eq22) + lq22;
x22 = (xb0x * C0Z + B0X * xc0z) + L * (xb0x * xc0z);
q23 = (q21 - q22) * (1 + eq23) + lq23;
x23 = x21 - x22;
q58 = (p0y * q23) * (1 + eq58) + lq58;
x58 = (xp0y * T23 + P0Y * x23) + L * (xp0y * x23);
q59 = (q57 + q58) * (1 + eq59) + lq59;
x59 = x57 + x58;
q24 = (0) * (1 + eq24) + lq24;
x24 = (xb0x * C0Y + B0X * xc0y) + L * (xb0x * xc0y);
q25 = (0) * (1 + eq25) + lq25;
x25 = (xb0y * C0X + B0Y * xc0x) + L * (xb0y * xc0x);
q26 = (q24 - q25) * (1 + eq26) + lq26;
x26 = x24 - x25;
q60 = (p0z * q26) * (1 + eq60) + lq60;
x60 = (xp0z * T26 + P0Z * x26) + L * (xp0z * x26);

{ p0x in [-1, 1] /\ p0x -/ P0X in [-2b@u@, 2b@u@]
/\ b0y in [-1, 1] /\ b0y -/ B0Y in [-2b@u@, 2b@u@]
/\ c0z in [-1, 1] /\ c0z -/ C0Z in [-2b@u@, 2b@u@]
/\ t18 -/ (b0y * c0z) in [-2b@u@, 2b@u@]
/\ b0z in [-1, 1] /\ b0z -/ B0Z in [-2b@u@, 2b@u@]
/\ c0y in [-1, 1] /\ c0y -/ C0Y in [-2b@u@, 2b@u@]
/\ t19 -/ (b0z * c0y) in [-2b@u@, 2b@u@]
/\ t20 -/ (t18 - t19) in [-2b@u@, 2b@u@]
/\ t57 -/ (p0x * t20) in [-2b@u@, 2b@u@]
/\ p0y in [-1, 1] /\ p0y -/ P0Y in [-2b@u@, 2b@u@]
/\ c0x in [-1, 1] /\ c0x -/ C0X in [-2b@u@, 2b@u@]
/\ t21 -/ (b0z * c0x) in [-2b@u@, 2b@u@]
/\ b0x in [-1, 1] /\ b0x -/ B0X in [-2b@u@, 2b@u@]
/\ t22 -/ (b0x * c0z) in [-2b@u@, 2b@u@]
/\ t23 -/ (t21 - t22) in [-2b@u@, 2b@u@]
/\ t58 -/ (p0y * t23) in [-2b@u@, 2b@u@]
/\ t59 -/ (t57 + t58) in [-2b@u@, 2b@u@]
/\ p0z in [-1, 1] /\ p0z -/ P0Z in [-2b@u@, 2b@u@]
/\ t24 -/ (b0x * c0y) in [-2b@u@, 2b@u@]
/\ t25 -/ (b0y * c0x) in [-2b@u@, 2b@u@]
/\ t26 -/ (t24 - t25) in [-2b@u@, 2b@u@]
/\ t60 -/ (p0z * t26) in [-2b@u@, 2b@u@]
/\ xp0x in [-3, 3]
/\ xb0y in [-3, 3]
/\ xc0z in [-3, 3]
/\ eq18 in [-2b@u@, 2b@u@] /\ lq18 in [-1, 1]
/\ xb0z in [-3, 3]
/\ xc0y in [-3, 3]
/\ eq19 in [-2b@u@, 2b@u@] /\ lq19 in [-1, 1]
/\ eq20 in [-2b@u@, 2b@u@] /\ lq20 in [-1, 1]
/\ eq57 in [-2b@u@, 2b@u@] /\ lq57 in [-1, 1]
/\ xp0y in [-3, 3]
/\ xc0x in [-3, 3]
/\ eq21 in [-2b@u@, 2b@u@] /\ lq21 in [-1, 1]
/\ xb0x in [-3, 3]
/\ eq22 in [-2b@u@, 2b@u@] /\ lq22 in [-1, 1]
/\ eq23 in [-2b@u@, 2b@u@] /\ lq23 in [-1, 1]
/\ eq58 in [-2b@u@, 2b@u@] /\ lq58 in [-1, 1]
/\ eq59 in [-2b@u@, 2b@u@] /\ lq59 in [-1, 1]
/\ xp0z in [-3, 3]
/\ eq24 in [-2b@u@, 2b@u@] /\ lq24 in [-1, 1]
/\ eq25 in [-2b@u@, 2b@u@] /\ lq25 in [-1, 1]
/\ eq26 in [-2b@u@, 2b@u@] /\ lq26 in [-1, 1]
/\ eq60 in [-2b@u@, 2b@u@] /\ lq60 in [-1, 1]
/\ L in [0, 1b@lambda@]
->  (t59 + t60) - (T59 + T60) in [-95b@u@, 95b@u@]
/\ q59 + q60 in [-17, 17]
/\ x59 + x60 in [-55, 55] }
