# Times and lengths in f32: core/src/narrowing.rs. From f64 to f32: the same for both formats.
#
# A product with 1 - 2^-22 or 1 + 2^-22 in f64, rounded by at most 2^-52, and to f32, by at most 2^-23.

#~ core/src/narrowing.rs: S::from_f64(time * (1.0 - power_of_two_f64(-22)))
#~ core/src/narrowing.rs: let more = value * (1.0 + power_of_two_f64(-22));
less = 1 - 1b-22;
more = 1 + 1b-22;

{ d in [-1b-52, 1b-52] /\ c in [-1b-23, 1b-23]
->  less * (1 + d) * (1 + c) <= 1
/\ less * (1 + d) * (1 + c) - 1 + 1b-21 >= 0
/\ more * (1 + d) * (1 + c) >= 1
/\ more * (1 + d) * (1 + c) - 1 - 1b-21 <= 0 }
