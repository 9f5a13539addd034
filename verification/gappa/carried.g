# The separation of a pair that is carried along: core/src/separation/carried.rs.
#
# Everything scales with B, the largest coordinate at both ends: B = 1; components of d are at most 1.01.
# 1. A translation rounds three coordinates of both sets once: the exact gap changes by 2 * 3 * 1.01 of one rounding. Each
#    computed gap is off by 49u (gap.g), so the gap at the end is at least that at the start without Lost.
# 2. A bound is fl(fl(gap / sigma) - E). From d at the start follows gap / sigma >= (d / (1 + 2u) + E) / (1 + 2u), and the bound
#    at the end is at least Bound; errors E are at least 64u (1 - 2u)^3. The share of d that Bound lacks, and the errors, both
#    times E: Bound >= d - share * d - errors * E.
# 3. What is kept passes through 3 roundings of c d, one of them of c, and 2 of 3E: at most c (1 + 2u)^3 d - 3 (1 - 2u)^2 E.
# Underflow: eta in E exceeds 40 lambda (gap.g), and 3 more operations flush at most 4 lambda each.

errors = 3; #! core/src/separation/carried.rs: S::small(3) * error.length()
#~ core/src/separation/carried.rs: const KEPT: f64 = 1.0 - 1e-4;
#~ core/src/separation/carried.rs: let kept = S::from_f64(KEPT) * distance - lost(error);
#~ core/src/separation/carried.rs: separation.smaller(kept.larger(S::ZERO))
c = 1 - 1e-4;
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
g = 1 + e;
g2 = g * g;
# In units of u.
Moved = 6 * 1.01 * (f - 1) / 1b@u@;
Lost = 12.2 + 2 * 49;
least = 64 * (1 - 2b@u@) * (1 - 2b@u@) * (1 - 2b@u@);

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@]
->  Moved in [-12.2, 12.2]
/\ f2 / g2 - c * (1 + 2b@u@) * (1 + 2b@u@) * (1 + 2b@u@) >= 0
/\ errors * (1 - 2b@u@) * (1 - 2b@u@) * least - Lost * f - (1 - f / g * f) * least >= 0
/\ 3 * eta * f3 - 2 * (40 + 12) * lambda >= 0 }
