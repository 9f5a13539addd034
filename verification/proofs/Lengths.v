(* The lengths of vectors that the time of impact computes by a root without more: what they may lose to underflow is
   less than LENGTH_UNDERFLOW. With them, the normal of a pair on a part of the step, and how far the volume must be
   from zero there with a separation. core/src/kernels/advance/volume.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Least Directions Held DirectionsBeyond Hull Volume.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

(* The code's terms: the two edges at the first corner, rounded, at a time t; the control points of their cross product
   from t to the end; their lengths, raised to the third degree; and the bars of the four control values. *)
Definition side p b t := each (fun a => Minus (component (difference p t) a) (component (difference b t) a)).
Definition side_at p b t := each (fun a => Sum (Product (component (side p b Expressions.Start) a) (Minus one t))
  (Product (component (side p b Expressions.End) a) t)).
Definition half := Constant Half.
Definition normals p b c t := let b0 := side_at p b t in let c0 := side_at p c t in
  let b1 := side p b Expressions.End in let c1 := side p c Expressions.End in
  (cross_ b0 c0, each (fun a => Product (Sum (component (cross_ b0 c1) a) (component (cross_ b1 c0) a)) half),
    cross_ b1 c1).
Definition length_of v := Root (dot_ v v).
Definition two := Constant (Small 2).
Definition raised l0 l1 l2 := (l0, Product (Sum l0 (Product two l1)) third, Product (Sum (Product two l1) l2) third, l2).
Definition areas m := Sum (Sum (Product (vx m) (vy m)) (Product (vy m) (vz m))) (Product (vz m) (vx m)).
Definition length_error pairs := Sum (Product (Product (Constant (Small 8)) (roundoffs 64)) (areas (extent pairs)))
  (Constant LengthUnderflow).
Definition wide_separation := Product (Input (Length Separation)) (more_roundoffs 64).
Definition bar_of_length pairs length := Sum (error_of_volume pairs) (Product wide_separation (Sum length (length_error
  pairs))).

Section Lengths.
Load "Setting.section".
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).
Notation run_root := (run_root f env given value_of run).
Notation run_constant := (run_constant f env given value_of run).
Notation run_input := (run_input f env given value_of run).
Notation vanishing := (power (length_underflow f)).

(* Results that count as they are, and sums of such: they lose nothing to underflow. *)
Definition whole x := 0 <= x /\ representable f x /\ Rd x = x /\ seen x = x.
Lemma whole_of_result z : 0 <= z -> whole (seen (Rd z)) /\ (1 - e1) * (z - l) <= seen (Rd z) /\
  seen (Rd z) <= (1 + e1) * z + l.
Proof.
  intro z0. pose proof (l_pos f). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (rounded_positive f env z z0) as r0. destruct (seen_low f env _ r0) as [s0 _].
  pose proof (seen_smaller f env (Rd z)) as sm. rewrite !Rabs_pos_eq in sm by assumption.
  pose proof (error f ok env z) as E. rewrite (Rabs_pos_eq z z0) in E. apply Rabs_le_inv in E.
  pose proof (result_is_representable f ok _ _ (nearly env z)) as rep.
  split; [split; [exact s0|split; [now apply representable_seen|split; [|apply seen_twice]]]|split; [|lra]].
  - unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec _ _)|]; try apply settled.
    apply rounded_0.
  - destruct (Rle_lt_dec l z) as [large|tiny].
    + destruct (normal_error f fine env z large) as [low _].
      assert (lr : l <= Rd z). { assert (fixed : Rd l = l).
        { destruct (nearly env l) as [[small _]|[direction [v ->]]]; [rewrite Rabs_pos_eq in small; lra|].
          apply round_generic; [exact v|]. apply generic_format_bpow. unfold FLT_exp. destruct ok; lia. }
        rewrite <- fixed. now apply (monotone env). }
      rewrite (seen_large f env _ lr). assert (0 <= e1 * l) by (apply Rmult_le_pos; lra).
      assert (e1 * l <= / 8388608 * l) by (apply Rmult_le_compat_r; lra). lra.
    + assert ((1 - e1) * (l - z) >= 0) by (apply Rle_ge, Rmult_le_pos; lra). lra.
Qed.
Lemma whole_sum x y : whole x -> whole y -> whole (seen (Rd (x + y))) /\ (1 - e1) * (x + y) <= seen (Rd (x + y)) /\
  seen (Rd (x + y)) <= (1 + e1) * (x + y) + l.
Proof.
  intros (x0 & rx & fx & sx) (y0 & ry & fy & sy). destruct (whole_of_result (x + y) ltac:(lra)) as (w & low & high).
  split; [exact w|]. split; [|exact high]. pose proof (l_pos f). pose proof (e_pos f). pose proof (e_small f ok).
  destruct (Rle_lt_dec l (x + y)) as [large|tiny].
  - destruct (normal_error f fine env (x + y) large) as [n1 _].
    destruct (Req_dec (seen (Rd (x + y))) (Rd (x + y))) as [->|flushed]; [exact n1|].
    assert (lr : l <= Rd (x + y)). { assert (fixed : Rd l = l).
      { destruct (nearly env l) as [[small _]|[direction [v ->]]]; [rewrite Rabs_pos_eq in small; lra|].
        apply round_generic; [exact v|]. apply generic_format_bpow. unfold FLT_exp. destruct ok; lia. }
      rewrite <- fixed. now apply (monotone env). }
    now rewrite (seen_large f env _ lr) in flushed.
  - pose proof (difference_error f ok env x (- y) rx ltac:(now apply generic_format_opp)) as D.
    replace (x - - y) with (x + y) in D by ring. rewrite (Rabs_pos_eq (x + y)) in D by lra.
    assert (kept : Rd (x + y) = 0 -> x = 0 /\ y = 0).
    { intro none. pose proof (monotone env x (x + y) ltac:(lra)). pose proof (monotone env y (x + y) ltac:(lra)). lra. }
    unfold Machine.seen in *. destruct (flushes_operands env).
    + assert (z : forall t, 0 <= t -> t < l -> (if Rlt_dec (Rabs t) l then 0 else t) = t -> t = 0).
      { intros t t0 tl E. destruct (Rlt_dec (Rabs t) l) as [_|n]; [now symmetry|]. rewrite Rabs_pos_eq in n; lra. }
      assert (x = 0) as -> by (apply z; [assumption|lra|exact sx]).
      assert (y = 0) as -> by (apply z; [assumption|lra|exact sy]).
      rewrite Rplus_0_r, rounded_0. rewrite Rmult_0_r. destruct (Rlt_dec _ _); apply Rle_refl.
    + destruct D as [[none _]|D].
      * destruct (kept none) as [-> ->]. rewrite Rplus_0_r, rounded_0. lra.
      * apply Rabs_le_inv in D. lra.
Qed.
Lemma vanishing_large : 2 * sqrt l <= vanishing /\ 0 < vanishing <= 1 /\ 1000000 * l <= sqrt l /\ 0 < sqrt l.
Proof.
  pose proof (l_pos f). pose proof (l_small f ok) as ls. pose proof (Corners.vanishing f fine) as v.
  assert (v0 : 0 < vanishing) by apply bpow_gt_0.
  assert (E : 4 * l <= vanishing * vanishing).
  { unfold lam, power. rewrite <- bpow_plus. change 4 with (bpow radix2 2). rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (r0 : 0 < sqrt l) by now apply sqrt_lt_R0. pose proof (sqrt_sqrt l ltac:(lra)) as ss. repeat split; try lra.
  - rewrite <- (sqrt_square vanishing) by lra. rewrite <- (sqrt_square 2) by lra. rewrite <- sqrt_mult by lra.
    apply sqrt_le_1_alt. lra.
  - change 1 with (bpow radix2 0). apply bpow_le. lia.
  - apply Rmult_le_reg_r with (sqrt l); [exact r0|]. rewrite ss.
    assert (small : sqrt l <= / 1073741824).
    { rewrite <- (sqrt_square (/ 1073741824)) by lra. apply sqrt_le_1_alt. lra. }
    assert (l * (1000000 * sqrt l) <= l * 1) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma root_of_sum a b : 0 <= a -> 0 <= b -> sqrt (a + b) <= sqrt a + sqrt b.
Proof.
  intros a0 b0. pose proof (sqrt_pos a). pose proof (sqrt_pos b). rewrite <- (sqrt_square (sqrt a + sqrt b)) by lra.
  apply sqrt_le_1_alt. pose proof (sqrt_sqrt a a0). pose proof (sqrt_sqrt b b0).
  assert (0 <= sqrt a * sqrt b) by (apply Rmult_le_pos; lra). lra.
Qed.
(* A vector's length is at most the computed one, but for what may vanish. *)
Theorem length_value v x : (forall a, value_of (component v a) = Number (x a)) -> squared x <= omega f / 4 ->
  exists y, value_of (length_of v) = Number y /\ norm x <= (1 + 2.7 * e1) * seen y + 0.87 * vanishing /\
    0 <= seen y <= 1.001 * norm x + 1.3 * vanishing.
Proof.
  intros E small. pose proof (l_pos f) as l0. pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (omega_large f ok) as o.
  assert (sq : forall a, 0 <= x a * x a) by (intro; apply Rle_0_sqr).
  pose proof (sq Expressions.X) as sx. pose proof (sq Expressions.Y) as sy. pose proof (sq Expressions.Z_) as sz.
  assert (Q0 : 0 <= squared x) by apply squared_pos.
  assert (parts : forall a, x a * x a <= squared x) by (intro a; unfold squared, sum3; destruct a; lra).
  assert (one_ : forall a, exists P, value_of (Product (component v a) (component v a)) = Number P /\ whole (seen P) /\
    (1 - e1) * (x a * x a - 1.001 * l) <= seen P /\ seen P <= (1 + e1) * (x a * x a) + l).
  { intro a. pose proof (run_product (component v a) (component v a)) as h. rewrite E in h. unfold product in h. cbn in h.
    pose proof (seen_square f fine env (x a)) as [low high]. pose proof (parts a).
    assert (z0 : 0 <= seen (x a) * seen (x a)) by apply Rle_0_sqr.
    apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra]. eexists. split; [exact h|].
    destruct (whole_of_result _ z0) as (w & lo & hi). split; [exact w|].
    assert ((1 - e1) * (x a * x a - 1.001 * l) <= (1 - e1) * (seen (x a) * seen (x a) - l)) by (apply
      Rmult_le_compat_l; lra).
    assert ((1 + e1) * (seen (x a) * seen (x a)) <= (1 + e1) * (x a * x a)) by (apply Rmult_le_compat_l; lra). lra. }
  destruct (one_ Expressions.X) as (px & Ex & wx & lx & hx). destruct (one_ Expressions.Y) as (py & Ey & wy & ly & hy).
  destruct (one_ Expressions.Z_) as (pz & Ez & wz & lz & hz). cbn [component] in Ex, Ey, Ez. clear one_.
  set (X := x Expressions.X * x Expressions.X) in *. set (Y := x Expressions.Y * x Expressions.Y) in *.
  set (Z := x Expressions.Z_ * x Expressions.Z_) in *. assert (Qx : squared x = X + Y + Z) by reflexivity.
  assert (eX : 0 <= e1 * X <= / 8388608 * X) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eY : 0 <= e1 * Y <= / 8388608 * Y) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eZ : 0 <= e1 * Z <= / 8388608 * Z) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  destruct (whole_sum _ _ wx wy) as (w1 & l1 & h1). pose proof (run_sum (Product (vx v) (vx v)) (Product (vy v) (vy v)))
    as r1. rewrite Ex, Ey in r1. unfold sum in r1. cbn in r1.
  pose proof (proj1 wx) as px0. pose proof (proj1 wy) as py0. pose proof (proj1 wz) as pz0.
  apply (number_if_small f fine env) in r1; [|rewrite Rabs_pos_eq; lra].
  set (S1 := seen (Rd (seen px + seen py))) in *. pose proof (proj1 w1) as S10.
  assert (e1 * (seen px + seen py) <= / 8388608 * (seen px + seen py)) by (apply Rmult_le_compat_r; lra).
  destruct (whole_sum _ _ w1 wz) as (w2 & l2 & h2). pose proof (run_sum (Sum (Product (vx v) (vx v)) (Product (vy v) (vy
    v))) (Product (vz v) (vz v))) as r2. rewrite r1, Ez in r2. unfold sum in r2. cbn in r2. fold S1 in r2.
  apply (number_if_small f fine env) in r2; [|rewrite Rabs_pos_eq; lra].
  set (D := seen (Rd (S1 + seen pz))) in *. pose proof (proj1 w2) as D0. fold (dot_ v v) in r2.
  pose proof (run_root (dot_ v v)) as h. rewrite r2 in h. unfold root in h. cbn in h. fold D in h.
  destruct h as [h _]. specialize (h D0). pose proof (sqrt_pos D) as rD.
  (* The root's operand, from both sides. *)
  set (k := 1 - e1) in *. set (P := seen px + seen py + seen pz).
  assert (low : squared x <= (1 + 3.1 * e1) * D + 3.01 * l).
  { set (W := squared x - 3.003 * l). assert (kW : k * W <= P) by (unfold W, P; rewrite Qx; lra).
    assert (kP : k * (k * P) <= D).
    { eapply Rle_trans; [|exact l2]. apply Rmult_le_compat_l; [unfold k; lra|].
      assert (k * seen pz <= 1 * seen pz) by (apply Rmult_le_compat_r; unfold k; lra). unfold P. lra. }
    assert (kkW : k * (k * (k * W)) <= D).
    { eapply Rle_trans; [|exact kP]. repeat (apply Rmult_le_compat_l; [unfold k; lra|]). exact kW. }
    destruct (Rle_lt_dec W 0) as [none|some].
    - assert (0 <= e1 * D) by (apply Rmult_le_pos; lra). unfold W in none. lra.
    - assert (big : 1 <= (1 + 3.1 * e1) * (k * (k * k))).
      { assert (0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
        assert (0 <= e1 * (e1 * e1) <= / 8388608 * (e1 * e1)) by (split; [apply Rmult_le_pos; lra|apply
          Rmult_le_compat_r; lra]).
        assert (0 <= e1 * (e1 * (e1 * e1)) <= / 8388608 * (e1 * (e1 * e1))) by (split; [apply Rmult_le_pos; lra|apply
          Rmult_le_compat_r; lra]). unfold k. lra. }
      apply (Rmult_le_compat_r W) in big; [|lra]. apply (Rmult_le_compat_l (1 + 3.1 * e1)) in kkW; [|lra].
      unfold W in *. lra. }
  assert (high : D <= (1 + 3.1 * e1) * squared x + 6 * l).
  { assert (A : S1 <= (1 + e1) * ((1 + e1) * (X + Y) + 2 * l) + l).
    { eapply Rle_trans; [exact h1|]. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
    assert (B : D <= (1 + e1) * ((1 + e1) * ((1 + e1) * (X + Y) + 2 * l) + l + ((1 + e1) * Z + l)) + l).
    { eapply Rle_trans; [exact h2|]. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
    assert (forall t, 0 <= e1 * t <= / 8388608 * t -> 0 <= e1 * (e1 * t) <= / 8388608 * (e1 * t) /\
      0 <= e1 * (e1 * (e1 * t)) <= / 8388608 * (e1 * t)) as twice.
    { intros t t1. assert (0 <= e1 * (e1 * t) <= / 8388608 * (e1 * t)) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]). split; [assumption|]. split; [apply Rmult_le_pos; lra|].
      assert (e1 * (e1 * (e1 * t)) <= / 8388608 * (e1 * (e1 * t))) by (apply Rmult_le_compat_r; lra). lra. }
    pose proof (twice X eX). pose proof (twice Y eY). pose proof (twice Z eZ).
    assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
    pose proof (twice l el). rewrite Qx. lra. }
  assert (DO : D <= omega f / 2). { assert (e1 * squared x <= / 8388608 * squared x) by (apply Rmult_le_compat_r; lra).
    lra. }
  assert (rO : sqrt D <= omega f / 2). { destruct (Rle_lt_dec D 1) as [le|gt].
    - assert (sqrt D <= sqrt 1) by now apply sqrt_le_1_alt. rewrite sqrt_1 in *. lra.
    - apply Rle_trans with D; [|exact DO]. rewrite <- (sqrt_square D) at 2 by lra. apply sqrt_le_1_alt.
      rewrite <- (Rmult_1_l D) at 1. apply Rmult_le_compat_r; lra. }
  apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra]. exists (Rd (sqrt D)). split; [exact h|].
  pose proof vanishing_large as (v2 & v1 & vl & r0).
  pose proof (error f ok env (sqrt D)) as er. rewrite (Rabs_pos_eq _ rD) in er. apply Rabs_le_inv in er.
  pose proof (rounded_positive f env _ rD) as R0. destruct (seen_low f env _ R0) as [s0 s1].
  pose proof (seen_smaller f env (Rd (sqrt D))) as sm. rewrite !Rabs_pos_eq in sm by assumption.
  assert (er1 : 0 <= e1 * sqrt D <= / 8388608 * sqrt D) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  assert (eer : 0 <= e1 * (e1 * sqrt D) <= / 8388608 * (e1 * sqrt D)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (factor : forall t, 0 <= t -> sqrt ((1 + 3.1 * e1) * t) <= (1 + 1.6 * e1) * sqrt t).
  { intros t t0. rewrite <- (sqrt_square (1 + 1.6 * e1)) by lra. rewrite <- sqrt_mult by (try apply Rle_0_sqr; lra).
    apply sqrt_le_1_alt, Rmult_le_compat_r; [exact t0|]. assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra). lra. }
  assert (eD : 0 <= e1 * D) by (apply Rmult_le_pos; lra).
  assert (eQ : 0 <= e1 * squared x) by (apply Rmult_le_pos; lra).
  assert (root_of : forall c d, 0 <= d -> c <= d * d -> sqrt (c * l) <= d * sqrt l).
  { intros c d d0 cd. rewrite <- (sqrt_square d) by lra. rewrite <- sqrt_mult by (try apply Rle_0_sqr; lra).
    apply sqrt_le_1_alt, Rmult_le_compat_r; lra. }
  assert (up : norm x <= (1 + 1.6 * e1) * sqrt D + 1.735 * sqrt l).
  { unfold norm. eapply Rle_trans; [apply sqrt_le_1_alt; exact low|].
    eapply Rle_trans; [apply root_of_sum; lra|]. pose proof (factor D D0).
    pose proof (root_of 3.01 1.735 ltac:(lra) ltac:(lra)). lra. }
  assert (down : sqrt D <= (1 + 1.6 * e1) * norm x + 2.45 * sqrt l).
  { unfold norm. eapply Rle_trans; [apply sqrt_le_1_alt; exact high|].
    eapply Rle_trans; [apply root_of_sum; lra|]. pose proof (factor (squared x) Q0).
    pose proof (root_of 6 2.45 ltac:(lra) ltac:(lra)). lra. }
  assert (N0 : 0 <= norm x) by apply norm_pos.
  assert (eN : 0 <= e1 * norm x <= / 8388608 * norm x) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  split; [|split; [exact s0|lra]]. eapply Rle_trans; [exact up|].
  assert (sy_ : (1 - e1) * sqrt D - 2 * l <= seen (Rd (sqrt D))) by lra.
  apply (Rmult_le_compat_l (1 + 2.7 * e1)) in sy_; [|lra].
  assert (0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]). lra.
Qed.
End Lengths.
