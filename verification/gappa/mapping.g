# Boxes of moving points, widened: core/src/boxes/mapping.rs. In f64, and f32 in the end: the same for both formats.
#
# What is to be shown: the lower bound as computed is at most x - s/2, x the exact position (relative to the origin); for the upper one
# signs change. Everything scales with v = |x0 - o| + |x1 - o| + s/2, so v = 1. A rounding is off by at most 2^-52, the last by 2^-23.
# 1. A position within the step: a difference, 1 - t, a product, a sum.
# 2. The widening exceeds s/2 by this much: sizes pass through a difference and two sums; the product with a power of two is exact.
# 3. The last two roundings, of a number of 1.001 at most.
# 4. Together: the lower bound is x - s/2 minus (2) plus (1) and (3).
# 5. Flushed: 2^-126 in the end; 20 times 2^-1022 before.

#~ core/src/boxes/mapping.rs: const WIDENING: f64 = 1.0 / 4_194_304.0;
#~ core/src/boxes/mapping.rs: const FLUSHED: f64 = f64::from_bits((1023 - 100) << 52);
#~ core/src/boxes/mapping.rs: let sizes = from.abs() + to.abs() + self.half;
#~ core/src/boxes/mapping.rs: let widening = self.half + (WIDENING * sizes + FLUSHED);
#~ core/src/boxes/mapping.rs: let until = (1.0 - self.until) * from + self.until * to;
widening = 1b-22;
flushed = 1b-100;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
# h + (widening f^3) f, all times f: without h.
More = widening * f4 * f + h * (f - 1);

{ d in [-1b-52, 1b-52] /\ h in [0, 1] /\ c in [-1b-23, 1b-23] /\ bound in [-1.001, 1.001]
->  f4 - 1 in [-5b-52, 5b-52]
/\ More / 1b-22 >= 0.9999
/\ 1 + widening * f4 * f + (f - 1) <= 1.001
/\ (f * (1 + c) - 1) * bound / 1b-23 in [-1.002, 1.002]
/\ 0.9999 * 1b-22 - 5b-52 - 1.002 * 1b-23 - 1b-24 >= 0
/\ flushed * f4 - 1b-126 - 20b-1022 >= 0 }
