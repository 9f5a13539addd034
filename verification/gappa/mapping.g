# Boxes of moving points, widened: core/src/boxes/mapping.rs. The code is in f64, and f32 in the end, for both formats.
#
# The claim: the lower bound as computed is at most x - s/2, with x the exact position (relative to the origin); for the upper one
# signs change. Everything scales with v = |x0 - o| + |x1 - o| + s/2, so v = 1. A rounding is off by at most 2^-52, the last by
# 2^-23.
# 1. A position within the step: a difference, 1 - t, a product, a sum.
# 2. The widening exceeds s/2 by this much: sizes pass through a difference and two sums; the product with a power of two is
#    exact.
# 3. The last two roundings, of a number of 1.001 at most.
# 4. Together: the lower bound is x - s/2 minus (2) plus (1) and (3).
# 5. Flushed: 2^-126 in the end; 20 times 2^-1022 before.
# 6. Drawn in: everything scales with the largest bound and the difference of separations together, which is 1; of it D is the
#    difference. In f32 for both formats. The difference is rounded to f32, then the sum, of which the product with a power of two
#    is exact; the inset and the moved bound, of at most 1.001. The sum must be less than the number subtracted. 4 numbers
#    flushed, of a difference of 2^-60 at least.

#~ core/src/boxes/mapping.rs: const WIDENING: f64 = 1.0 / 4_194_304.0;
#~ core/src/boxes/mapping.rs: const FLUSHED: f64 = f64::from_bits((1023 - 100) << 52);
#~ core/src/boxes/mapping.rs: let sizes = from.abs() + to.abs() + self.half;
#~ core/src/boxes/mapping.rs: let widening = self.half + (WIDENING * sizes + FLUSHED);
#~ core/src/boxes/mapping.rs: let until = (1.0 - self.until) * from + self.until * to;
taken_off = 8; #! core/src/boxes/mapping.rs: self.by - f32::small(8) * f32::UNIT_ROUNDOFF * sum
#~ core/src/boxes/mapping.rs: const SHORTEST: f64 = 1.0 / (1_u64 << 60) as f64;
widening = 1b-22;
flushed = 1b-100;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
# The inset, without D.
Off = D * ((1 + c) * (1 + 1b-50) * (1 + k) - 1) - taken_off * 1b-24 * (1 + e) * (1 + k);
# h + (widening f^3) f, all times f: without h.
More = widening * f4 * f + h * (f - 1);

{ d in [-1b-52, 1b-52] /\ h in [0, 1] /\ c in [-1b-23, 1b-23] /\ bound in [-1.001, 1.001]
/\ D in [0, 1] /\ e in [-1b-23, 1b-23] /\ k in [-1b-23, 1b-23] /\ m in [-1b-23, 1b-23]
->  f4 - 1 in [-5b-52, 5b-52]
/\ More / 1b-22 >= 0.9999
/\ 1 + widening * f4 * f + (f - 1) <= 1.001
/\ (f * (1 + c) - 1) * bound / 1b-23 in [-1.002, 1.002]
/\ 0.9999 * 1b-22 - 5b-52 - 1.002 * 1b-23 - 1b-24 >= 0
/\ flushed * f4 - 1b-126 - 20b-1022 >= 0
/\ Off + bound * m + 1b-24 <= 0
/\ 1b-24 * 1b-60 - 4b-126 >= 0 }
