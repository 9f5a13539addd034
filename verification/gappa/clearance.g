# The distance that a pair keeps although its points stray: core/src/separation/clearance.rs. The code is in f32 (u = 2^-24); the
# steps are proven with the u of either format.
#
# Everything scales with B, the largest coordinate as given: B = 1; and along a direction with |d| = 1, so that |d_1| + |d_2| +
# |d_3| is at most root 3, R below.
# 1. Along an axis: each of two coordinates is rounded, and their difference, at most 2 (1 + 2u), once.
# 2. Along a direction: a coordinate's rounding changes a product with d by 2u R; three roundings of its own make 3 * 2u R of at
#    most R. Two of them, and their difference, at most 2 R (1 + 8u), once.
# 3. The required distance: the distance and 64u B in f64 (the same factors, far smaller errors), rounded to f32 once: 1, and the
#    number subtracted from it along an axis. Along a direction: 1 + margin (no part of the proof) is at least one, its product;
#    the square's product and two sums, under the root: 2 of them; the root; the product: 6, of at most 7 below.
# 4. Underflow along a direction: 6 coordinates and 6 components flushed, 10 results, twice, and the required distance as often:
#    less than 40 (1 + |d|) lambda, of 2^-80 |d| with |d| above 2^-30. Here |d| = 2^-30, the worst case.
# 5. The largest stray: the required distance is covered as above. Its difference from the gap, the quotient, and the last product
#    are three roundings; the sum of components, by which it is divided, two. The number compared with it takes two more (the mean
#    of two strays, or its own rounding).

of_coordinates = 64; #! core/src/separation/clearance.rs: f64::small(64) * f64::from(f32::UNIT_ROUNDOFF)
of_distances = 64; #~ core/src/separation/clearance.rs: let along_axis = narrowed(distance * (1.0 + rounding()) + largest * rounding() + FLUSHED);
#~ core/src/separation/clearance.rs: const FLUSHED: f64 = 1.0 / (1_u128 << 80) as f64;
#~ core/src/separation/clearance.rs: const SHORTEST: f32 = 1e-18;
taken_off = 128; #~ core/src/separation/clearance.rs: by_axis.larger(by_direction) * gap.splat(1.0 - 1.0 / 131_072.0)
#~ core/src/separation/clearance.rs: let left = gap - along_direction * squared.sqrt();
#~ core/src/separation/clearance.rs: let by_direction = left / ((sizes.x + sizes.y) + sizes.z);
#~ std-adapter/detector/src/coherent/sieve.rs: keeps_apart = stray >= enough
R = 1.7321;

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f5 = f3 * f2;
f7 = f5 * f2;
g = 1 + e;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@]
->  (2 * (f - 1) + 2 * f * (f - 1)) / 1b@u@ in [-8.1, 8.1]
/\ (2 * R * (f * f3 - 1) * f + 2 * R * (f - 1)) / 1b@u@ in [-34.9, 34.9]
/\ of_coordinates * f7 - 34.9 >= 0
/\ (1 + of_distances * 1b@u@) * f7 * f >= 1
/\ f3 * f2 * (1 - taken_off * 1b@u@) - g * g <= 0
/\ 1b-80 * 1b-30 * f7 - 41 * 1b-126 >= 0 }
