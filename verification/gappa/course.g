# The distance by which points may stray from their course: core/src/separation/course.rs.
#
# Everything scales with B, the largest coordinate of origins and ends: B = 1. The way drift * span is at most 2 (1 + 8u), as
# computed. L is the exact straight way with the drift through the point where the course was joined (at its origin, or later).
# 1. The ends of the course are off L by 2 roundings of a part of the way and one of a position; the end by one more, of span - t.
# 2. The origin is off L as well, and so is the place expected from there: 2 roundings of the way, 1 of a position.
# 3. Together, times the allowance's own 3 roundings; 20 flushed numbers.
# 4. The room: the root, the quotient, the sum, two products, all of terms of one sign: 6. The real room is 1/128 more, with the
#    last difference's rounding and the two of the product with 128.

of_coordinates = 64; #! core/src/separation/course.rs: let rounding = S::small(64) * S::UNIT_ROUNDOFF * largest + S::UNDERFLOW;
#~ core/src/separation/course.rs: largest <= S::LARGEST_EDGE && S::small(128) * rounding <= room
#~ core/src/separation/course.rs: S::from_f64(0.99) * (S::HALF * (stray + spare / S::from_f64(3.0).sqrt()))
#~ core/src/separation/course.rs: let spare = if spare < S::ZERO { spare * more_roundoffs(spare, 16) } else { spare };
eta = 1b@eta@;
lambda = 1b@lambda@;
Way = 2 * (1 + 16b@u@);

f = 1 + d;
f2 = f * f;
f3 = f2 * f;
f6 = f3 * f3;

{ d in [-2b@u@, 2b@u@] /\ e in [-2b@u@, 2b@u@]
->  (Way * (f3 - 1) + 1.01 * (f - 1) + Way * (f2 - 1) + 1.01 * (f - 1) + Way * (f2 - 1) + 1.01 * (f - 1)) / 1b@u@ in [-34.5, 34.5]
/\ of_coordinates * f3 - 34.5 >= 0
/\ eta * f3 - 20 * lambda >= 0
/\ 0.99 * f6 * (1 + e) * (1 + 1b-7 * f) - 1 <= 0
/\ (1 + 16b@u@) * f3 >= 1 }
