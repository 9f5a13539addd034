# Products with corners, and the proofs that use them: corners.rs and directions.rs in core/src/kernels/advance.
#
# M_k is the largest |e_k| as computed, at both ends; S the sum of |w_k| M_k. An exact e_k is at most M_k / (1 - 2u).
# 1. w.e(t), e(t) = fl((1 - t) e(0) + t e(1)): the difference, 1 - t, a product, a sum, a product, two additions: 7 roundings. Two
#    such products, added (a direction that turns, or moves on a curve): 8. The test traced/tests/proofs_are_about_the_code.rs
#    counts them on the code, and the roundings of the bound that they must exceed, and its constant:
#= product 7 6 20
#= turning 8 7 20
#= curving 8 7 20
#= line 4 6 20
# 2. The threshold T: a product and two sums in S, its product with 20u, the sum with eta; M's own sum with mu: 6. Where a
#    direction turns, two of them are added. On a curve the middle direction is twice the control point, so that no product is
#    doubled.
# 3. A constant direction. Its values at the ends of the step pass through 4 roundings: the line through them is within 8.1u S of
#    the exact one. At the quotient q, where that line is T, it is positive. The quotient as computed, with its factor, is below
#    q: numerator, denominator, quotient and product are rounded.
# 4. Underflow: a component of e(t) loses 6 lambda, which mu covers; products and sums 5, T 8.
# 5. A separation: s |w| has its square's product and two sums (under the root: 2 of 4, with the loss of 3 flushed squares),
#    the root, its product with 1 + 32u, with s, and the sum with T: 7. Along an axis: the difference, 1 + 8u's product, the sum.

threshold = 20; #! core/src/kernels/advance/corners.rs: roundoffs(w.x, 20) * w.abs().dot(self.extent) + w.x.splat(L::Scalar::UNDERFLOW)
of_quotient = 32; #~ core/src/kernels/advance/directions.rs: let quotient = (at_start - bar) / (at_start - at_end) * less_roundoffs(bar, 32);
of_length = 32; #! core/src/kernels/advance/directions.rs: bar = bar + separation * (length_above(w) * more_roundoffs(separation, 32));
along_axis = 8; #! core/src/kernels/advance/directions.rs: separation * more_roundoffs(separation, 8) + separation.splat(L::Scalar::UNDERFLOW)
#~ core/src/kernels/advance/directions.rs: let is_safe = squared.greater(squared.splat(L::Scalar::SAFE_SQUARE));
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f4 = f2 * f2;
f6 = f3 * f3;
f7 = f4 * f3;
f8 = f4 * f4;
g = 1 + e;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@]
->  ((f7 - 1) / (1 - 2b@u@)) / 1b@u@ in [-14.5, 14.5]
/\ ((f8 - 1) / (1 - 2b@u@)) / 1b@u@ in [-16.5, 16.5]
/\ threshold * f7 - 16.5 >= 0
/\ ((f4 - 1) / (1 - 2b@u@)) / 1b@u@ in [-8.3, 8.3]
/\ threshold * f6 - 8.3 >= 0
/\ (1 - of_quotient * 1b@u@) * (f3 / g) <= 1
/\ threshold * 1b@u@ * 1b@mu@ * f6 - 7 * lambda >= 0
/\ eta * f2 - 13 * lambda >= 0
/\ 3 * lambda / 1b@squares@ <= 1b@u@
/\ (1 + of_length * 1b@u@) * f7 * f >= 1
/\ (1 + along_axis * 1b@u@) * f3 >= 1
/\ eta * f2 - 3 * lambda >= 0 }
