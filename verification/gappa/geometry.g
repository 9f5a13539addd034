# The geometry of a contact: core/src/separation/geometry.rs. The code is in f64; the steps are proven with the u of either
# format.
#
# Everything scales with D, the largest difference from the first point: D = 1, as computed, so that an exact one is at most 1 /
# (1 - 2u). Differences of the points' coordinates are at most 2B; B = 1 where these matter. R is root 3.
# 1. A point at a time: the difference from the first point, 1 - t, its product, and the sum: 4 roundings. Weighed: a product and
#    two sums, 3 more. Weights add up to no more than 1 + 4u: two roundings.
# 2. A point: on the way from the first point, which is at that time within 3 roundings of B; the error of the sum of weights,
#    times B; and the last sum.
# 3. A distance from above: both sides, with the error of the sum of their weights; and of the length, as computed: the
#    difference, a quotient, its square (a product, two sums) under the root, the root and a product: less than 11 half roundings
#    of it; the product with 1 + 16u and the last sum: 15. 96u D passes through a product and two sums: 3.
# 4. A gap: positions are off by 4 roundings, along a direction no longer than 1.01, on both sides; and the gap's own error, as in
#    gap.g.
# 5. A normal's length: the square as computed passes through 3 roundings, 2 of which are left under the root, the root, its
#    reciprocal and a product: 9 half roundings of it, so 9 of its square.
# 6. A speed: two differences, the way between them, weighed; the difference of both sides, each at most 2; its product with the
#    normal, of which components add up to no more than R of its length.
# 7. On paths (core/src/paths/geometry.rs) the sides have a further error: a distance from above is a sum and a product, one from
#    below a difference and a product.
# 8. Underflow: each operation above flushes at most lambda, and weights are at most 1: less than 200 of them in all.

of_distance = 96; #! core/src/separation/geometry.rs: (96.0 * u() * largest + <f64 as Rounding>::UNDERFLOW)
#~ core/src/separation/geometry.rs: (apart + now.error) * (1.0 + 8.0 * u())
#~ core/src/separation/geometry.rs: (computed - self.error) * (1.0 - 8.0 * u())
of_error = 8;
of_length = 16; #! core/src/separation/geometry.rs: length(met[0] - met[1]) * (1.0 + 16.0 * u())
doubled = 2; #! core/src/separation/geometry.rs: let error = GapError::from_largest_coordinate(2.0 * self.largest);
# Promised beyond: 96u B of a point, 16u of a normal's length, 256u D of a speed.
R = 1.7321;
eta = 1b@eta@;
lambda = 1b@lambda@;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f4 = f2 * f2;
f7 = f4 * f3;
f9 = f7 * f2;
f15 = f9 * f3 * f3;
# Weights, and an exact difference.
Sum = 1 + 4b@u@;
Exact = 1.01;
# The error of a weighed way.
Weighed = Sum * (f7 - 1) * Exact;

{ d in [-2b@u@, 2b@u@]
->  R * (2 * Weighed + (f3 - 1) + 4 * f * 1b@u@ + (f - 1) * 1.01) / 1b@u@ in [-96, 96]
/\ of_distance * f3 - 2 * R * (14.3 + 4.1) >= 0
/\ Weighed / 1b@u@ in [-14.3, 14.3]
/\ (1 + of_length * 1b@u@) * (1 + of_length * 1b@u@) * f15 >= 1
/\ 64 * doubled - 49 - 2 * R * 1.01 * 8.2 >= 0
/\ Exact * (f4 - 1) / 1b@u@ in [-8.2, 8.2]
/\ (f9 - 1) / 1b@u@ in [-31.9, 31.9]
/\ R * 1.01 * (2 * Sum * (2 * Exact * (f2 - 1) * f3 + 2 * Exact * (f3 - 1)) * f + 4 * Exact * (f - 1)) * f3 / 1b@u@ in [-150, 150]
/\ R * 1.01 * 4 * Exact * 1.01 * (f3 - 1) / 1b@u@ in [-50, 50]
/\ (1 + of_error * 1b@u@) * f2 >= 1
/\ (1 - of_error * 1b@u@) * f2 <= 1
/\ eta * f2 - 200 * lambda >= 0 }
