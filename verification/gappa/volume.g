# The signed volume of an advancing pair: core/src/kernels/advance/volume.rs.
#
# The monomials of a control value sum up to at most S = 6 MxMyMz (3k1: a third of 18), the number `permanent`; exact differences
# are at most 1/(1 - 2u) larger than computed ones.
# 1. 10 roundings to 3k1 (traced/tests/proofs_are_about_the_code.rs counts them), 2 by a rounded third, 9 by blossoming (three
#    times 1 - t, product, sum), 1 by subtracting the bound, 9 by looking ahead: 31. The count on the code is one less;
#    the roundings of the bound and its constant are counted as well:
#= volume 30 10 64
# 2. The bound: three sums with mu, product, sum, product, two sums in the permanent, its product with 64u, the sum with eta
#    (1 + M)^2: 10; and the sum with a separation.
# 3. Underflow: 202 lambda (1 + M)^2 for 3k1 and its last addition (traced/3k1.g), of which a third counts and 3 more, 40 for the
#    rest: the module has 54 + 63 + 36; both are less than 128.
# 4. Time: a quotient of the hull, at most 6 roundings; 1 - t; two products; these are below their exact values by the factor 1 -
#    32u. The sum with the time and the last product: by 1 - 8u.
# 5. Normal, for M = 1: a component of an edge is a difference of two rounded differences, 4u + 4u; interpolated, which is
#    bisected in t (Gappa takes t and 1 - t for independent), 22u. Each control point has two products and a difference; the
#    middle one two of those, halved. Its length is at most the sum of its components' errors, each at most 510u M_j M_k.
# 6. Lengths: under the root a square and two sums (2 of 4), the root, the sum of lengths, a third (2), the sum with the error,
#    the products with s (2), the sum with the bound: 10 at most. Three squares that underflow.

error = 64;  #! core/src/kernels/advance/volume.rs: let sixty_four = roundoffs(m.x, 64);
of_normal = 512; #~ core/src/kernels/advance/volume.rs: length_error: eight * roundoffs(m.x, 64) * areas + vanishing,
of_lengths = 64; #~ core/src/kernels/advance/volume.rs: separation: separation * more_roundoffs(separation, 64),
of_part = 32; #~ core/src/kernels/advance/volume.rs: let next = (time + part * rest * less_roundoffs(time, 32)) * less_roundoffs(time, 8);
of_time = 8;
#~ core/src/kernels/advance/volume.rs: let error = sixty_four * permanent + m.x.splat(L::Scalar::UNDERFLOW) * (size * size);
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f4 = f2 * f2;
f8 = f4 * f4;
f9 = f8 * f;
f10 = f8 * f2;
f11 = f10 * f;
f16 = f8 * f8;
f31 = f16 * f8 * f4 * f3;
g = 1 + e;

D0 = A0 - C0;
D1 = A1 - C1;
D = (1 - t) * D0 + t * D1;

# A component of an edge, and of the normal, from components with that error.
N = X * Y - Z * W;
H = (N1 + N2) * 0.5;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@] /\ t in [0, 1]
/\ a0 in [-1, 1] /\ a0 -/ A0 in [-2b@u@, 2b@u@] /\ a1 in [-1, 1] /\ a1 -/ A1 in [-2b@u@, 2b@u@]
/\ c0 in [-1, 1] /\ c0 -/ C0 in [-2b@u@, 2b@u@] /\ c1 in [-1, 1] /\ c1 -/ C1 in [-2b@u@, 2b@u@]
/\ d0 -/ (a0 - c0) in [-2b@u@, 2b@u@] /\ d1 -/ (a1 - c1) in [-2b@u@, 2b@u@]
/\ rest -/ (1 - t) in [-2b@u@, 2b@u@]
/\ r0 -/ (rest * d0) in [-2b@u@, 2b@u@] /\ r1 -/ (t * d1) in [-2b@u@, 2b@u@] /\ r -/ (r0 + r1) in [-2b@u@, 2b@u@]
/\ x in [-2.1, 2.1] /\ (x - X) / 1b@u@ in [-22, 22] /\ y in [-2.1, 2.1] /\ (y - Y) / 1b@u@ in [-22, 22]
/\ z in [-2.1, 2.1] /\ (z - Z) / 1b@u@ in [-22, 22] /\ w in [-2.1, 2.1] /\ (w - W) / 1b@u@ in [-22, 22]
/\ xy -/ (x * y) in [-2b@u@, 2b@u@] /\ zw -/ (z * w) in [-2b@u@, 2b@u@] /\ n -/ (xy - zw) in [-2b@u@, 2b@u@]
/\ n1 in [-9, 9] /\ (n1 - N1) / 1b@u@ in [-230, 230] /\ n2 in [-9, 9] /\ (n2 - N2) / 1b@u@ in [-230, 230]
/\ h -/ ((n1 + n2) * 0.5) in [-2b@u@, 2b@u@]
->  ((f31 - 1) / f3) / 1b@u@ in [-62.5, 62.5]
/\ error * f11 - 62.5 >= 0
/\ (eta / lambda) * f4 - 128 >= 0
/\ (1 - of_part * 1b@u@) * f9 <= 1
/\ (1 - of_time * 1b@u@) * f2 <= 1
/\ (1 + of_lengths * 1b@u@) * f10 >= 1
/\ r - D in [-22b@u@, 22b@u@]
/\ r in [-2.1, 2.1]
/\ n - N in [-230b@u@, 230b@u@]
/\ n in [-9, 9]
/\ h - H in [-260b@u@, 260b@u@]
/\ of_normal * f4 - 260 >= 0
/\ 1b@length@ * 1b@length@ - 3 * lambda >= 0 }

$ t in 64;
