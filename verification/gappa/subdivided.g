# The step in parts: core/src/filter/subdivided.rs.
#
# 1. One mean of de Casteljau's rule, of values up to 1.001: rounding adds 2.01u to the mean of the errors; two of a value at the
#    start (the last addition of a control value, and three times it): 4.02u. Four halvings have three levels each: 12.
# 2. The bound's factor 32u loses its product and three sums; and what is left covers it.
# 3. E, the error bound of coplanarity.g, passes through three times, and three sums, more: 16.
# 4. Underflow: 2 lambda a level, and 4 before.
# 5. Coordinates: fl(1 - t) is exact, t being a multiple of 1/16. Differences and products round, the last sum is compared. It is
#    bisected in t, since Gappa takes t and 1 - t for independent. The bound's two sums lose 4u of the separation, which is
#    less than what it is compared with, so at most 1.001 of the larger.

levels = 12;
of_size = 32; #! core/src/filter/subdivided.rs: let bound = error + roundoffs(size, 32) * size + constant(L::Scalar::UNDERFLOW);
outer = 16;
of_coordinates = 12; #~ core/src/filter/subdivided.rs: let roundoff = roundoffs(start, 12) * start.abs().larger(end.abs());
#~ core/src/filter/subdivided.rs: Some(separation) => bound + three * (separation * tetrahedron.largest_normal(P::KIND)),
#~ core/src/filter/subdivided.rs: let mean = |a: L, b: L| a.splat(L::Scalar::HALF) * (a + b);
#~ core/src/filter/subdivided.rs: let at = |time: L| (time.splat(L::Scalar::ONE) - time) * start + time * end;
#~ core/src/filter/subdivided.rs: Some(separation) => roundoff + separation,
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f8 = f4 * f4;
f16 = f8 * f8;
f12 = f8 * f4;

exact = (1 - t) * A + t * B;

{ d in [-2b@u@, 2b@u@]
/\ v in [-1.001, 1.001] /\ w in [-1.001, 1.001] /\ mean -/ ((v + w) * 0.5) in [-2b@u@, 2b@u@]
/\ t in [0, 1]
/\ a in [-1, 1] /\ a -/ A in [-2b@u@, 2b@u@] /\ b in [-1, 1] /\ b -/ B in [-2b@u@, 2b@u@]
/\ from -/ ((1 - t) * a) in [-2b@u@, 2b@u@] /\ to -/ (t * b) in [-2b@u@, 2b@u@]
->  (mean - (v + w) * 0.5) / 1b@u@ in [-2.01, 2.01]
/\ (f2 - 1) / 1b@u@ in [-4.02, 4.02]
/\ f12 <= 1.001
/\ of_size * f4 - (levels * 2.01 + 4.02) >= 0
/\ outer * f16 - 15 >= 0
/\ eta / lambda * f4 - (levels * 2 + 4) >= 0
/\ (from + to) - exact in [-5b@u@, 5b@u@]
/\ of_coordinates * f4 - (5 + 4 * 1.001) >= 0 }

$ t in 64;
