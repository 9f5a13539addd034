# Points of a rotating body: core/src/paths/rigid.rs. The code is in f64; the steps are proven with the u of either format.
#
# Everything scales with H, the largest coordinate of the way from the centre: H = 1, of length at most root 3, R. In units of u.
# 1. The axis of length one: a quotient; three operations of a square, half of which are left under the root; root and quotient:
#    6. Its product with the way: 6, the way's own, and 3, of at most R; the part along it: that, and 7 of at most R; across: a
#       difference, and the
#    way's own. Sideways: 6, the way's own, a product and a difference, of at most R.
# 2. A place: the three parts; sine and cosine, each off by k; two products, of at most R; two sums, of at most 3 R.
#    The last sum: of R. Centre and translation: a product and two sums.
# 3. Sine and cosine: a term with the power 2k passes through 4k + 7 operations: 2 x sinh x + 7 cosh x of x = 3.2 is less than
#    164. The remainder of the angle is off by 17. The omitted rest is 3.2^30 / 30!.
# 4. The radius: R times the error of the part sideways.
# 5. A piece's deviation passes through 8 operations.
# 6. A velocity: theta times the parts of a place, with the errors of 2 without centre and translation, and a product and a sum;
#    the translation, T = 1, through that sum. Its error passes through 4 operations.

#~ core/src/paths/rigid.rs: u() * ((4096.0 + 32.0 * angle.abs()) * size + 16.0 * (largest(centre) + largest(translation)))
#~ core/src/paths/rigid.rs: radius: length_above(sideways) + 64.0 * u() * size,
#~ core/src/paths/rigid.rs: deviation: (self.radius * bent + self.rounding) * (1.0 + 32.0 * u()),
#~ core/src/paths/rigid.rs: for k in (1..=14).rev() {
#~ core/src/paths/rigid.rs: let of_translation = 16.0 * u() * largest(self.translation) + <f64 as Rounding>::UNDERFLOW;
#~ core/src/paths/rigid.rs: velocity_error: (self.angle.abs() * self.rounding + of_translation) * (1.0 + 16.0 * u()),
R = 1.7321;
Cosh = 12.29;
Sinh = 12.25;
Of = 2 * (3.2 * Sinh * 2 + 7 * Cosh);

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f8 = f4 * f4;
Along = R * (f8 * f2 - 1) + R * (f4 * f2 * f - 1);
Across = Along + (f2 - 1) * 3;
Sideways = R * (f8 * f - 1);
# The constant part of sine's and cosine's error, and that of the angle.
Constant = 512;
Angle = 4;

{ d in [-2b@u@, 2b@u@]
->  Of + 17 + 1 - Constant <= 0
/\ R * (2 * (Along / 1b@u@ + Across / 1b@u@ + Sideways / 1b@u@) + 2.01 * R * Constant + (2 * R + 6.1 * R + 1.1 * R) * 2) - 4096 <= 0
/\ R * 2.01 * R * Angle - 32 <= 0
/\ R * (4 + 4.1) - 16 <= 0
/\ R * (2 * (Along / 1b@u@ + Across / 1b@u@ + Sideways / 1b@u@) + 2.01 * R * Constant + (2 * R + 6.1 * R) * 2) + R * 2 * R * (f2 - 1) / 1b@u@ - 4096 <= 0
/\ R * (f - 1) / 1b@u@ - 16 <= 0
/\ f4 * (1 + 16b@u@) >= 1
/\ R * Sideways / 1b@u@ - 64 <= 0
/\ R * Sideways / 1b@u@ + 64 >= 0
/\ f8 * (1 + 32b@u@) >= 1 }
