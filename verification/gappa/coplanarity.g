# The error bounds of the control values: core/src/kernels/coplanarity.rs.
#
# Lemma (not Gappa's, a line of algebra): a computed value is the sum of its monomials m, each times a product of as many
# factors 1 + d, |d| <= 2u, as it passes through roundings; so it is off by at most the sum of |m| times the largest
# |product - 1|. The bound computed from the same monomials is at least that sum times a power of 1 - 2u. The test
# traced/tests/proofs_are_about_the_code.rs counts the roundings on the code:
#= k0 7 11
#= 3k1 9 13
# (monomials of k0 and k3, without the last addition, which is compared; of the bound, one more for a separation).
#
# By magnitudes: traced/k0.g and traced/3k1.g prove 95u and 380u for components of at most 1.
# Underflow: traced/k0.g and traced/3k1.g prove 41 + 163 times lambda (1 + M)^2 at most. The bound itself loses at most lambda in
# its product with u, 41 * 20u lambda in the permanent, and 4 lambda in a separation's product and three times that.

outer = 16;      #! core/src/kernels/coplanarity.rs: let outer = roundoff * p0.x.splat(L::Scalar::small(16));
inner = 20;      #! core/src/kernels/coplanarity.rs: let inner = roundoff * p0.x.splat(L::Scalar::small(20));
magnitudes = 96; #! core/src/kernels/coplanarity.rs: let constant = L::Scalar::small(96);
four = 4;        #! core/src/filter/certified.rs: let inner = error_bound_by_magnitudes(largest) * largest.x.splat(L::Scalar::small(4));
eta = 1b@eta@;   #~ core/src/kernels/coplanarity.rs: more * more * more.splat(L::Scalar::UNDERFLOW)
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f6 = f4 * f2;
f7 = f6 * f;
f9 = f7 * f2;
f11 = f9 * f2;
f13 = f11 * f2;

{ d in [-2b@u@, 2b@u@]
->  f7 - 1 in [-15b@u@, 15b@u@]
/\ outer * f11 - 15 >= 0
/\ f9 - 1 in [-19b@u@, 19b@u@]
/\ inner * f13 - 19 >= 0
/\ magnitudes * f6 - 95 >= 0
/\ magnitudes * f6 * four - 380 >= 0
/\ (eta / lambda) * f6 - (1 + 41 * 20b@u@ + 4) - (41 + 163) >= 0 }
