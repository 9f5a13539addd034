# Confirmed contacts: core/src/kernels/advance/confirm.rs.
#
# 1. A monomial of a doubled coefficient passes through 4 roundings in each of two corners, product, difference and sum: 11, and
#    there are 4 of them, each at most MxMy (computed: 1/(1 - 2u)^2 more): 88u and second order.
#    Counted on the code, like the roundings of the bound and its constant:
#= confirm 11 5 160
# 2. The bound: Mx * My, each with its sum with mu, its product with 160u, the sum.
# 3. Underflow: 6 lambda in a corner's component, with a factor of M four times, products and sums 7: 24M + 7, of (1 + M)^2;
#    twice.

doubled = 160; #! core/src/kernels/advance/confirm.rs: let bound = |x: L, y: L| roundoffs(x, 160) * (x * y) + constant(L::Scalar::small(2)) * underflow;
#~ core/src/kernels/advance/confirm.rs: let underflow = constant(L::Scalar::UNDERFLOW) * (size * size);
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f5 = f4 * f;
f11 = f4 * f4 * f2 * f;

{ d in [-2b@u@, 2b@u@]
->  (4 * (f11 - 1) / f2) / 1b@u@ in [-89, 89]
/\ doubled * f5 - 89 >= 0
/\ 2 * eta / lambda * f4 - 2 * 24 >= 0 }
