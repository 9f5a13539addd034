# Evaluation on boxes of time and parameters: std-adapter/laboratory/src/baselines/tight_inclusion.rs.
#
# 1. A monomial passes through 1 - t, a product and a sum; 1 - u - v (2), a product and two sums; and a difference: 9 roundings.
#    Magnitudes add up to at most 4m.
# 2. The bound: its product, its sum with the separation, and the product with 1 + 8u; of the separation the last two, and it is
#    rounded into the bound.
# 3. Underflow: at most 60 operations lose lambda each, weighted by at most 3; the bound is of max(1, m).

error = 80; #! std-adapter/laboratory/src/baselines/tight_inclusion.rs: let error = largest.scaled(S::small(80) * S::UNIT_ROUNDOFF);
of_room = 8; #~ std-adapter/laboratory/src/baselines/tight_inclusion.rs: let room = (error + apart).scaled(S::ONE + S::small(8) * S::UNIT_ROUNDOFF);
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f9 = f3 * f3 * f3;

{ d in [-2b@u@, 2b@u@]
->  (4 * (f9 - 1)) / 1b@u@ in [-72.5, 72.5]
/\ error * f3 - 73 >= 0
/\ (1 + of_room * 1b@u@) * f2 * f >= 1
/\ 0.5 * 1b@u@ - 180 * lambda >= 0 }
