# The gap along a direction: core/src/separation/gap.rs, core/src/kernels/gap.rs.
#
# Everything scales with B, the largest coordinate: B = 1; components of d are at most 1.01.
# 1. A term of a dot product passes through a product and two additions: 3 roundings, of three terms of 1.01. Two of them, and
#    their difference, which is at most 2 * 3.03 (1 + 3u) and rounded once.
# 2. 64u B passes through its product, that with B and the sum with eta: 3.
# 3. A length of d that is accepted: d.d, three terms of 3 roundings each, is at most sigma as computed; so the square of the
#    length is at most sigma / (1 - 2u)^3. With two more roundings of a length (the quotient and the difference) it is less than
#    the square of sigma; so it is in f64 with another one, to f32, in which it is stored.
# 4. A threshold passes through sigma's square, the product and the sum: 3; m sigma^2 then exceeds m |d|, and the stored threshold
#    exceeds it.
# 5. Underflow: 3 components of B and 3 of d flushed, 5 results, all twice; the difference, and three operations of the bound. 64u
#    B covers the losses times B: lambda / u is far below u.

of_coordinates = 64; #! core/src/kernels/gap.rs: roundoffs(largest, 64) * largest + largest.splat(L::Scalar::UNDERFLOW)
#~ core/src/separation/gap.rs: S::from_f64(1.0 + 1.0 / 1_048_576.0)
#~ core/src/kernels/gap.rs: separation * (slack * slack) + error
#~ core/src/kernels/gap.rs: gap / slack - error
#~ core/src/kernels/gap.rs: slack.greater(direction.dot(direction))
#~ core/src/kernels/gap.rs: let gap = gap / slack;
#~ core/src/separation/gap.rs: const LARGEST_GAP: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;
sigma = 1 + 1b-20;
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
g = 1 + e;
# The largest square of a length that is accepted; and in f64.
Square = sigma / (g * g * g);
p = 1 + x;
p4 = p * p * p * p;
q = 1 + y;
Double = sigma / (q * q * q);
narrowed = 1 + c;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@] /\ c in [-1b-23, 1b-23]
/\ x in [-1b-52, 1b-52] /\ y in [-1b-52, 1b-52]
->  (6 * 1.01 * (f3 - 1) * f + 6 * 1.01 * (f - 1)) / 1b@u@ in [-48.9, 48.9]
/\ of_coordinates * f3 - 48.9 * sigma >= 0
/\ Square * f2 * f2 - sigma * sigma <= 0
/\ Double * p4 * narrowed * narrowed - sigma * sigma <= 0
/\ (sigma * sigma * f3) * (sigma * sigma * f3) - Square >= 0
/\ eta * f2 - 40 * lambda >= 0
/\ 64b@u@ * f2 - 40 * lambda >= 0 }
