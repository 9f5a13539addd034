(* One floating-point operation, in every environment that core's `Rounding` names, from Flocq's definition of the
   formats. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core Relative FTZ.
Open Scope R_scope.

(* A binary format, and core's two constants for it: η = 2^underflow and the largest edge 2^largest_edge. *)
Record format := Format { precision : Z; least_exponent : Z; greatest_exponent : Z; underflow : Z; largest_edge : Z }.

Definition power (e : Z) := bpow radix2 e.
(* u, the unit roundoff; 2u; λ, the smallest normal number; Ω, the largest finite number. *)
Definition unit_roundoff f := power (- precision f).
Definition eps f := power (1 - precision f).
Definition lam f := power (least_exponent f + precision f - 1).
Definition omega f := power (greatest_exponent f) - power (greatest_exponent f - precision f).

Definition representable f := generic_format radix2 (FLT_exp (least_exponent f) (precision f)).

(* r is what an operation with the exact result z may give: z rounded in any direction, subnormal numbers kept; or zero
   if z lies below the normal numbers. *)
Definition rounds f z r :=
  (Rabs z < lam f /\ r = 0) \/
  exists direction, Valid_rnd direction /\ r = round radix2 (FLT_exp (least_exponent f) (precision f)) direction z.

(* An operand below the normal numbers may count as zero. *)
Definition counts_as f x x' := x' = x \/ (Rabs x < lam f /\ x' = 0).

(* The assumptions on a format in the following proofs; `Theorems.v` shows them for both formats. *)
Record reasonable f : Prop := {
  precise : (24 <= precision f)%Z;
  deep : (least_exponent f + precision f - 1 <= -60)%Z;
  wide : (underflow f - (least_exponent f + precision f - 1) >= 9)%Z;
  tiny : (underflow f <= -60)%Z;
  apart : (least_exponent f + precision f - 1 + 40 <= - precision f)%Z;
  edges : (0 <= largest_edge f)%Z;
  room : (3 * largest_edge f + 38 <= greatest_exponent f)%Z }.

Section Operations.
Variable f : format.
Hypothesis ok : reasonable f.

Let fexp := FLT_exp (least_exponent f) (precision f).
Lemma valid : Valid_exp fexp.
Proof. apply FLT_exp_valid. unfold Prec_gt_0. destruct ok; lia. Qed.
Local Existing Instance valid.
Lemma gt_0 : Prec_gt_0 (precision f). Proof. unfold Prec_gt_0; destruct ok; lia. Qed.
Local Existing Instance gt_0.

Lemma lam_pos : 0 < lam f. Proof. apply bpow_gt_0. Qed.
Lemma eps_pos : 0 < eps f. Proof. apply bpow_gt_0. Qed.
Lemma eps_small : eps f <= / 8388608.
Proof.
  unfold eps, power. replace (/ 8388608) with (bpow radix2 (-23)) by (simpl; lra).
  apply bpow_le. destruct ok; lia.
Qed.
Lemma lam_small : lam f <= / 1152921504606846976.
Proof.
  unfold lam, power. replace (/ 1152921504606846976) with (bpow radix2 (-60)) by (simpl; lra).
  apply bpow_le. destruct ok; lia.
Qed.
Lemma eps_twice : eps f = 2 * unit_roundoff f.
Proof. unfold eps, unit_roundoff, power. replace (1 - precision f)%Z with (1 + - precision f)%Z by ring.
  rewrite bpow_plus. simpl. lra. Qed.

(* A subnormal number that is rounded is off by less than λ. *)
Lemma ulp_small x : Rabs x < lam f -> ulp radix2 fexp x <= lam f.
Proof.
  intro small. unfold fexp. rewrite ulp_FLT_small.
  - apply bpow_le. destruct ok; lia.
  - apply gt_0.
  - eapply Rlt_trans; [exact small|]. apply bpow_lt. lia.
Qed.

(* The relative and absolute error, by the exact result and by the rounded one. *)
Theorem rounding_error z r : rounds f z r -> Rabs (r - z) <= eps f * Rabs z + lam f.
Proof.
  pose proof lam_pos. pose proof eps_pos. intros [[small ->]|[direction [v ->]]].
  - replace (0 - z) with (- z) by ring. rewrite Rabs_Ropp. pose proof (Rabs_pos z). nra.
  - destruct (Rlt_le_dec (Rabs z) (lam f)) as [small|large].
    + pose proof (error_le_ulp radix2 fexp direction z). pose proof (ulp_small z small). pose proof (Rabs_pos z).
      fold fexp. nra.
    + pose proof (relative_error_FLT radix2 (least_exponent f) (precision f) gt_0 direction z large).
      replace (- precision f + 1)%Z with (1 - precision f)%Z in H1 by ring. fold (power (1 - precision f)) (eps f) in
        H1. lra.
Qed.

Theorem rounding_error_by_result z r : rounds f z r -> Rabs (r - z) <= eps f * Rabs r + lam f.
Proof.
  pose proof lam_pos. pose proof eps_pos. intros [[small ->]|[direction [v ->]]].
  - replace (0 - z) with (- z) by ring. rewrite Rabs_Ropp, Rabs_R0. lra.
  - fold fexp. set (r := round radix2 fexp direction z).
    pose proof (error_le_ulp_round radix2 fexp direction z) as E. fold r in E.
    destruct (Rlt_le_dec (Rabs r) (lam f)) as [small|large].
    + pose proof (ulp_small r small). pose proof (Rabs_pos r). nra.
    + pose proof (ulp_FLT_le radix2 (least_exponent f) (precision f) r large) as U. fold fexp in U.
      fold (power (1 - precision f)) (eps f) in U. lra.
Qed.

Theorem result_is_representable z r : rounds f z r -> representable f r.
Proof.
  intros [[_ ->]|[direction [v ->]]].
  - apply generic_format_0.
  - apply generic_format_round; auto using valid.
Qed.

(* Rounding is monotone: a result beyond a representable number proves that the exact one is. *)
Theorem above_before_rounding z r e : rounds f z r -> representable f e -> 0 <= e -> e < r -> e < z.
Proof.
  intros [[_ ->]|[direction [v ->]]] rep pos beyond; [lra|].
  apply Rnot_le_lt. intro le. apply (Rlt_not_le _ _ beyond).
  rewrite <- (round_generic radix2 fexp direction e rep). apply (round_le radix2 fexp direction), le.
Qed.
Theorem below_before_rounding z r e : rounds f z r -> representable f e -> 0 <= e -> r < - e -> z < - e.
Proof.
  intros [[_ ->]|[direction [v ->]]] rep pos beyond; [lra|].
  apply Rnot_le_lt. intro le. apply (Rlt_not_le _ _ beyond).
  apply generic_format_opp in rep. rewrite <- (round_generic radix2 fexp direction (- e) rep).
    apply (round_le radix2 fexp direction). lra.
Qed.

(* Flocq's formats that flush are covered. *)
Theorem keeping_is_covered direction z : Valid_rnd direction -> rounds f z (round radix2 fexp direction z).
Proof. intro v. right. exists direction. auto. Qed.
Theorem flushing_is_covered direction z : Valid_rnd direction ->
  rounds f z (round radix2 (FTZ_exp (least_exponent f) (precision f)) (Zrnd_FTZ direction) z).
Proof.
  intro v. destruct (Rlt_le_dec (Rabs z) (lam f)) as [small|large].
  - left. split; [exact small|]. apply round_FTZ_small; auto using gt_0.
  - right. exists direction. split; [exact v|]. rewrite round_FLT_FLX by exact large.
    apply round_FTZ_FLX; auto using gt_0.
Qed.

Lemma counts_error x x' : counts_as f x x' -> Rabs (x' - x) <= lam f.
Proof.
  pose proof lam_pos. intros [->|[small ->]].
  - replace (x - x) with 0 by ring. rewrite Rabs_R0. lra.
  - replace (0 - x) with (- x) by ring. rewrite Rabs_Ropp. lra.
Qed.
Lemma counts_smaller x x' : counts_as f x x' -> Rabs x' <= Rabs x.
Proof. intros [->|[_ ->]]; [lra|]. rewrite Rabs_R0. apply Rabs_pos. Qed.

End Operations.
