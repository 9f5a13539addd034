# No decision about a pair overflows: core/src/kernels/lanes.rs, Rounding::LARGEST_EDGE; core/src/kernels/advance/corners.rs.
#
# Rounding towards zero turns an overflow into the largest finite number, which no comparison notices. Sizes, with 1.01 for all
# roundings:
# 1. Four control values and their bounds: 18 monomials, and a sum of four of them.
# 2. The normal of EE: components of c - b at most 2M, of n0 4M^2, of h 8M^2; the largest square is h.h.
# 3. Time of impact: edges of 2M, normals of 8M^2 and their squares; a separation up to the extent; products of four numbers.

#~ core/src/kernels/coplanarity.rs: largest.splat(L::Scalar::LARGEST_EDGE).greater(largest)
#~ core/src/kernels/advance/corners.rs: !largest.greater(largest.splat(L::Scalar::LARGEST_EXTENT))
{ m in [0, 1b@edge@] /\ x in [0, 1b@extent@] /\ r in [1, 1.01]
->  4 * 20 * m * m * m * r <= 1b@max@
/\ 3 * (8 * m * m) * (8 * m * m) * r <= 1b@max@
/\ 3 * (8 * x * x) * (8 * x * x) * r <= 1b@max@
/\ 3 * x * (8 * x * x) * 4 * r <= 1b@max@ }
