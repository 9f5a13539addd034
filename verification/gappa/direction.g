# A fixed direction w: core/src/boxes/direction.rs.
#
# S is the sum of |w_k| M_k, M_k the largest |e_k| as computed.
# 1. A term of w.e passes through the difference, the product and one addition (the last is compared): 3 roundings; and what is
#    bounded by M_k, as computed, is one rounding larger: 6.1u S.
# 2. The bound: a product and two sums in S, the product with 8u, and two sums.
# 3. Underflow: 3 lambda in each of three differences, times W; five operations, and six of the bound: 9W + 11, of 1 + W.

of_sizes = 8; #! core/src/boxes/direction.rs: let roundoff = constant(L::Scalar::small(8)) * constant(L::Scalar::UNIT_ROUNDOFF);
#~ core/src/boxes/direction.rs: let bound = roundoff * sizes + underflow + zero;
#~ core/src/boxes/direction.rs: (along.abs().largest() + constant(L::Scalar::ONE)) * constant(L::Scalar::UNDERFLOW);
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f6 = f3 * f3;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@]
->  (((1 + d) * (1 + d) * (1 + d) - 1) / (1 - 2b@u@)) / 1b@u@ in [-6.1, 6.1]
/\ of_sizes * f6 - 6.1 >= 0
/\ eta / lambda * f3 - 11 >= 0 }
