# Sums of two coordinates: core/src/boxes/mod.rs, "Why sums may round".
#
# A > fl(Z + gap), A = fl(a + b), Z = fl(c + d), in threads that take subnormal operands for zero, is to prove a + b > c + d. Here for
# |Z| at most gap/16u; beyond it, neighbouring floating-point numbers are far apart and the argument is in the module.
#
# 1. fl(Z + gap) is off by less than 0.2 gap: A is above Z by more than 0.8 gap.
# 2. If A is at most gap/8u too, its rounding and that of Z, and four flushed operands and two results, are less than that.
# 3. If A is more, a + b is more than gap/8u but for its rounding, and c + d less than gap/16u but for its.
#
# gap * u = eta is what core defines: a test demands it.

#~ core/src/boxes/relative.rs: let gap = low_0.splat(L::Scalar::SUM_GAP);
#~ core/src/boxes/relative.rs: (low_0.greater(other_high_0 + gap) & low_1.greater(other_high_1 + gap))
gap = 1b@gap@;
lambda = 1b@lambda@;

{ Z in [-1b@gap16@, 1b@gap16@] /\ z -/ (Z + gap) in [-2b@u@, 2b@u@]
/\ A in [-2b@gap16@, 2b@gap16@] /\ A -/ ab in [-2b@u@, 2b@u@] /\ Z -/ cd in [-2b@u@, 2b@u@]
/\ large in [2b@gap16@, 1b@max@] /\ d in [-2b@u@, 2b@u@]
->  (z - (Z + gap)) / gap in [-0.2, 0.2]
/\ (A - ab) / gap in [-0.3, 0.3]
/\ (Z - cd) / gap in [-0.2, 0.2]
/\ 6 * lambda / gap <= 0.1
/\ large * (1 + d) - 6 * lambda - 1b@gap16@ / (1 + d) >= 0 }
