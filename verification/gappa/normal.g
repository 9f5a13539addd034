# The largest length of the normal: core/src/kernels/coplanarity.rs, MovingTetrahedron::largest_normal.
#
# traced/normal-*.g prove that a component of a control point, for M = 1, is off by at most 60u, its length by sqrt(3) * 60u <
# 104u; in general that times M^2. So |n| <= |n as computed| + 104u M^2 + underflow.
#
# 1. Factors: a square and two sums, and eta added, are rounded under the root (which halves the exponent: 2 of 4); the
#    root, the sum with 128u M^2, the slack, the separation, three times that and the sum with the error bound: 6 more.
# 2. The number added for the components: M * M, its product with 128u, and the last four of those.
# 3. Underflow of components: no more than 20 lambda (1 + M). For medium and large M, 24u M^2 of the added number remains.
#    For small M all lengths are at most 8 M^2, less than the root of eta. (For f64 the root of 2^-1000 is 2^-500.)
# 4. Three squares and two halvings that underflow lose at most 7 lambda of the squared length, to which eta is added.

slack = 32;  #! core/src/kernels/coplanarity.rs: let slack = constant(L::Scalar::ONE) + constant(L::Scalar::small(32)) * roundoff;
added = 128; #! core/src/kernels/coplanarity.rs: let rounding = constant(L::Scalar::small(128)) * roundoff;
#~ core/src/kernels/coplanarity.rs: let length = (squared + constant(L::Scalar::UNDERFLOW)).sqrt();
#~ core/src/kernels/coplanarity.rs: (length + rounding * (largest * largest)) * slack
lambda = 1b@lambda@;
eta = 1b@eta@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f8 = f4 * f4;

{ d in [-2b@u@, 2b@u@] /\ large in [1b@middling@, 1b@edge@] /\ small in [0, 1b@middling@]
->  (1 + slack * 1b@u@) * f8 >= 1
/\ added * f8 - 104 - 16 >= 0
/\ 8b@u@ * large - 40 * lambda / 1b@middling@ >= 0
/\ 8b@u@ * large * large / (1 + large) - 20 * lambda >= 0
/\ eta * f4 - (9 * small * small) * (9 * small * small) >= 0
/\ eta * f4 - 7 * lambda >= 0 }
