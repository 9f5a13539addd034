# Confirmed contacts: core/src/elementary/advance/confirm.rs.
#
# 1. A monomial of a doubled coefficient passes through 4 roundings in each of two corners, product, difference and sum: 11, and
#    there are 4 of them, each at most MxMy (computed: 1/(1 - 2u)^2 more): 88u and second order.
# 2. The bound: Mx * My, its product with 160u, the sum.
# 3. Underflow: 6 lambda in a corner's component, with a factor of M four times, products and sums 7: 24M + 7, of (1 + M)^2; twice.

doubled = 160; #! core/src/elementary/advance/confirm.rs: let bound = |x: S, y: S| S::small(160) * S::UNIT_ROUNDOFF * (x * y) + S::small(2) * underflow;
#~ core/src/elementary/advance/confirm.rs: let underflow = S::UNDERFLOW * (size * size);
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f11 = f4 * f4 * f2 * f;

{ d in [-2b@u@, 2b@u@]
->  (4 * (f11 - 1) / f2) / 1b@u@ in [-89, 89]
/\ doubled * f4 - 89 >= 0
/\ 2 * eta / lambda * f4 - 2 * 24 >= 0 }
