# Two triangles with a common edge that are wide open: core/src/separation/hinge.rs.
#
# Everything scales with (a.a + b.b)(e.e) = 1, without rounding, which bounds the sum of all monomials' magnitudes.
# 1. A monomial passes through 4 differences, 3 roundings in each of two dot products, their product and the difference: 12.
# 2. In the computed bound each square is of 2 differences and passes through 3 roundings of its dot product; a.a + b.b through
#    another; the product; that with 32u, and the sum: 14.
# 3. Underflow: 256 lambda of (1 + M^2)^2, which the squares exceed apart from their roundings, 6 of each factor; their product,
#    that with eta and the sum.

once = 32; #! core/src/separation/hinge.rs: P::Scalar::small(32) * P::Scalar::UNIT_ROUNDOFF * (squares * ee)
#~ core/src/separation/hinge.rs: + P::Scalar::UNDERFLOW * (size * size);
#~ core/src/separation/hinge.rs: let across = a.dot(b) * ee - a.dot(e) * b.dot(e);
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f8 = f4 * f4;
f12 = f8 * f4;
f14 = f12 * f2;
f15 = f14 * f;

{ d in [-2b@u@, 2b@u@]
->  (f12 - 1) / 1b@u@ in [-24.2, 24.2]
/\ once * f14 - 24.2 >= 0
/\ eta * f15 - 256 * lambda >= 0 }
