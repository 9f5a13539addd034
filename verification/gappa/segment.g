# The vertex's path against a box: core/src/boxes/segment.rs, separates.
#
# 1. A product of two rounded differences is T = that / (1 + d)(1 + e)(1 + g): off by at most 6.1u of the computed one. The least
#    of two products, and the largest, move by no more than the larger of their errors; the last subtraction is compared.
# 2. The bound's product, two sums of sizes, and its last sum.
# 3. Underflow: a difference loses 3 lambda, a product 6M + 1 (and 9 lambda), two of them and the last subtraction 12M + 3. The
#    bound loses 8u times four products' lambda and one of its own. Together less than 13, of 1 + M.

of_sizes = 8; #! core/src/boxes/segment.rs: let roundoff = constant(L::Scalar::small(8)) * constant(L::Scalar::UNIT_ROUNDOFF);
#~ core/src/boxes/segment.rs: let underflow = (reach + constant(L::Scalar::ONE)) * constant(L::Scalar::UNDERFLOW);
#~ core/src/boxes/segment.rs: let bound = roundoff * sizes + underflow;
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f5 = f4 * f;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@] /\ g in [-2b@u@, 2b@u@]
->  (1 - 1 / ((1 + d) * (1 + e) * (1 + g))) / 1b@u@ in [-6.1, 6.1]
/\ of_sizes * f5 - 6.1 >= 0
/\ eta / lambda * f4 - 13 >= 0 }
