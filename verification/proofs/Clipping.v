(* Clipping a cubic with given control values: where its lower hull first comes to zero, rounded, and how far to look
   ahead. core/src/kernels/advance/volume.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Directions Held Hull Volume.
From Selvedge Require Expressions Errors Bounds Certificates.
Import ListNotations.
Open Scope R_scope.

(* The code's terms. *)
Notation small n := (Constant (Small n)).
Definition is_positive b := Greater b (small 0).
Definition zero_0 dividend b0 b := Quotient dividend (Product (small 3) (Minus b0 b)).
Definition ratio bi bj := Quotient bi (Minus bi bj).
Definition until_zero where_ before zero := Select where_ (Smaller before zero) before.
Definition first_zero b0 b1 b2 b3 :=
  let f1 := until_zero (Not (is_positive b1)) (small 2) (zero_0 b0 b0 b1) in
  let f2 := until_zero (Not (is_positive b2)) f1 (zero_0 (Product b0 (small 2)) b0 b2) in
  let f3 := until_zero (Not (is_positive b3)) f2 (zero_0 (Product b0 (small 3)) b0 b3) in
  let f4 := until_zero (Both (is_positive b1) (Not (is_positive b2))) f3 (Product (Sum one (ratio b1 b2)) third) in
  let f5 := until_zero (Both (is_positive b1) (Not (is_positive b3))) f4 (Product (Sum one (Product (small 2) (ratio b1
    b3))) third) in
  until_zero (Both (Both (is_positive b1) (is_positive b2)) (Not (is_positive b3))) f5 (Product (Sum (small 2) (ratio b2
    b3)) third).

Definition part_before b0 b1 b2 b3 t := let a0 := between_ t b0 b1 in let a1 := between_ t b1 b2 in let a2 := between_ t
  b2 b3 in
  let c0 := between_ t a0 a1 in let c1 := between_ t a1 a2 in (a0, c0, between_ t c0 c1).
Definition is_positive_before b0 b1 b2 b3 t := let '(a0, c0, last) := part_before b0 b1 b2 b3 t in
  Both (Both (Both (is_positive (Minus one t)) (is_positive a0)) (is_positive c0)) (is_positive last).
Definition looking_ahead b0 b1 b2 b3 first := let sixteen := Product (small 16) first in let four := Product (small 4)
  first in
  Select (is_positive_before b0 b1 b2 b3 sixteen) sixteen (Select (is_positive_before b0 b1 b2 b3 four) four first).
Definition next_time t part := Product (Sum t (Product (Product part (Minus one t)) (less_roundoffs 32)))
  (less_roundoffs 8).

Section Clipping.
Load "Setting.section".
Notation constant := (constant f env given value_of run).

(* Four control values, as they are seen, at most w. *)
Variable w : R.
Hypothesis w_small : 0 <= w <= 10 * (G * G * G).
Definition kappa := 1 - 10.8 * e1.
Definition slack_ := 400 * (l * w) + 15 * l.
Definition control b x := value_of b = Number x /\ representable f x /\ Rd x = x /\ Rabs (seen x) <= w.
(* Up to a computed zero, but for what follows, a line is not below zero by more than the slack. *)
Definition late (i j mi mj c : R) := forall s, 0 <= s <= 1 -> s <= kappa * c + 30 * l -> - slack_ <= line i j mi mj s.
Definition zero_is_late v (i j mi mj : R) := (v = Infinite true /\ forall c, late i j mi mj c) \/ exists c,
  v = Number c /\ 0 <= c /\ late i j mi mj c.

Lemma w_omega : w <= 0.00001 * omega f.
Proof. pose proof (G_3 f fine). pose proof (G_4 f fine). assert (0 <= G * G * G) by (apply Rmult_le_pos;
  [apply Rmult_le_pos|]; lra). lra. Qed.
Lemma seen_above x y : 0 < seen x -> x <= y -> seen y = y.
Proof. intros pos le. apply seen_positive. pose proof (seen_monotone f env x y le). lra. Qed.
Lemma small_number n : value_of (small n) = Number (IZR n). Proof. exact (constant (Small n)). Qed.
Lemma seen_small n : (1 <= n)%Z -> seen (IZR n) = IZR n.
Proof. intro h. apply IZR_le in h. apply seen_of_normal. rewrite Rabs_pos_eq by lra. pose proof (l_small f ok). lra.
  Qed.

(* The difference of a positive control value and another. *)
Section Line.
Variables bi bj : number.
Variables xi xj : R.
Hypothesis ci : control bi xi.
Hypothesis cj : control bj xj.
Hypothesis positive : 0 < seen xi.
Hypothesis other : seen xj <= 0.
Notation mi := (seen xi).
Notation mj := (seen xj).
Notation d := (mi - mj).
Lemma d_bounds : 0 < mi <= d /\ d <= 2 * w /\ mi <= w /\ seen xi = xi.
Proof.
  destruct ci as (_ & _ & _ & a). destruct cj as (_ & _ & _ & b). pose proof (Rle_abs mi). pose proof (Rle_abs (- mj)).
    rewrite Rabs_Ropp in *.
  pose proof (seen_positive f env xi positive). lra.
Qed.
Lemma minus_value : exists D, value_of (Minus bi bj) = Number D /\ mi <= D /\ 0 < D /\ seen D = D /\
  (1 - e1) * d <= D <= (1 + e1) * d /\ Rd D = D.
Proof.
  pose proof d_bounds as (mpos & dw & mw & sx). pose proof w_omega. pose proof (e_pos f).
    destruct ci as (Ei & ri & fixed & _). destruct cj as (Ej & rj & _ & _).
  pose proof (run (Minus bi bj)) as h. cbn in h. rewrite Ei, Ej in h. cbn in h.
    apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra].
  assert (ge : mi <= Rd d). { apply Rle_trans with (Rd xi); [rewrite fixed; lra|apply (monotone env); lra]. }
  exists (Rd d). split; [exact h|]. split; [exact ge|]. split; [lra|]. split; [apply (seen_above xi);
    [exact positive|lra]|].
  split; [|apply settled].
  destruct (difference_error f ok env mi mj (representable_seen f env _ ri) (representable_seen f env _ rj)) as [[E
    _]|E]; [lra|].
  rewrite (Rabs_pos_eq d) in E by lra. apply Rabs_le_inv in E. lra.
Qed.
Lemma line_is_late (i j c : R) : 0 <= i -> i + 1 <= j -> j <= 3 -> (forall s,
  0 <= s <= 1 -> s <= kappa * c + 30 * l -> (3 * s - i) * d <= (j - i) * mi + slack_) ->
  late i j mi mj c.
Proof. intros i0 ij j3 h s s01 sc. specialize (h s s01 sc). unfold line. lra. Qed.
Lemma tiny_is_late (i j c : R) : 0 <= i -> i + 1 <= j -> j <= 3 -> d <= 2 * l -> late i j mi mj c.
Proof.
  intros i0 ij j3 tiny. apply line_is_late; auto. intros s s01 _. pose proof d_bounds as (mpos & dw & _).
    pose proof (l_pos f).
  assert ((3 * s - i) * d <= 3 * d) by (apply Rmult_le_compat_r; lra). assert (0 <= (j - i) * mi) by (apply
    Rmult_le_pos; lra).
  assert (0 <= l * w) by (apply Rmult_le_pos; lra). unfold slack_. lra.
Qed.
(* A quotient of the first and the difference. *)
Lemma ratio_value : exists c, value_of (ratio bi bj) = Number c /\ 0 <= seen c <= 1.01 /\
  seen c * d <= (1 + 2.2 * e1) * mi + l * (2 * w).
Proof.
  pose proof d_bounds as (mpos & dw & mw & sx). destruct minus_value as (D & ED & mD & D0 & sD & [Dlow Dhigh] & _).
    pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (omega_large f ok). destruct ci as (Ei & _).
  pose proof (run (ratio bi bj)) as h. unfold ratio in h. cbn -[is_positive_unrounded] in h. rewrite Ei, ED in h.
    cbn -[is_positive_unrounded] in h.
  destruct h as [h _]. rewrite sD in h. specialize (h ltac:(lra)). set (z := mi / D) in *.
    assert (zD : z * D = mi) by (unfold z; field; lra).
  assert (z0 : 0 < z) by (unfold z, Rdiv; apply Rmult_lt_0_compat; [lra|now apply Rinv_0_lt_compat]).
  assert (z1 : z <= 1). { apply Rmult_le_reg_r with D; [exact D0|]. lra. }
  apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra]. exists (Rd z). split; [exact h|].
  pose proof (error f ok env z) as E. rewrite (Rabs_pos_eq z) in E by lra. apply Rabs_le_inv in E.
    pose proof (rounded_positive f env z ltac:(lra)) as r0.
  pose proof (seen_smaller f env (Rd z)) as ss. rewrite (Rabs_pos_eq (Rd z)) in ss by exact r0.
    pose proof (Rle_abs (seen (Rd z))).
  pose proof (seen_monotone f env 0 _ r0) as s0. rewrite seen_0 in s0. assert (e1 * z <= / 8388608 * 1) by (apply
    Rmult_le_compat; lra).
  split; [lra|]. assert (zd : z * ((1 - e1) * d) <= z * D) by (apply Rmult_le_compat_l; lra). rewrite zD in zd.
  assert (z * d <= (1 + 1.01 * e1) * mi).
  { apply Rmult_le_reg_l with (1 - e1); [lra|]. assert (0 <= e1 * mi) by (apply Rmult_le_pos; lra).
    assert (e1 * (e1 * mi) <= 0.0001 * (e1 * mi)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (seen (Rd z) * d <= ((1 + e1) * z + l) * d) by (apply Rmult_le_compat_r; lra).
  assert (l * d <= l * (2 * w)) by (apply Rmult_le_compat_l; lra).
  assert ((1 + e1) * (z * d) <= (1 + e1) * ((1 + 1.01 * e1) * mi)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * mi) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * mi) <= 0.0001 * (e1 * mi)) by (apply
    Rmult_le_compat_r; lra). lra.
Qed.
(* Lines from the first control value. *)
Lemma zero_0_is_late (j : Z) dividend n0 : (1 <= j <= 3)%Z -> value_of dividend = Number n0 -> 0 <= seen n0 <= (1 + e1)
  * (IZR j * mi) + l ->
  zero_is_late (value_of (zero_0 dividend bi bj)) 0 (IZR j) mi mj.
Proof.
  intros [j1 j3] En [n00 nb]. apply IZR_le in j1, j3. pose proof d_bounds as (mpos & dw & mw & sx).
  destruct minus_value as (D1 & ED & mD & D10 & sD & [Dlow Dhigh] & fixed). pose proof (e_pos f).
    pose proof (e_small f ok).
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (omega_large f ok). pose proof w_omega.
  pose proof (run (Product (small 3) (Minus bi bj))) as hp. cbn in hp. rewrite small_number, ED in hp. cbn in hp.
    rewrite sD, (seen_small 3) in hp by lia.
  assert (D1w : D1 <= 3 * w). { assert (e1 * d <= / 8388608 * d) by (apply Rmult_le_compat_r; lra). lra. }
  apply (result_number f ok env) in hp; [|rewrite Rabs_pos_eq; lra]. set (D := Rd (3 * D1)) in *.
  assert (DD : D1 <= D) by (rewrite <- fixed; apply (monotone env); lra).
  assert (sDD : seen D = D) by (apply (seen_above D1); [rewrite sD|]; lra).
  pose proof (run (zero_0 dividend bi bj)) as h. unfold zero_0 in h. cbn -[is_positive_unrounded] in h.
    rewrite En, hp in h. cbn -[is_positive_unrounded] in h.
  destruct h as [h _]. rewrite sDD in h. specialize (h ltac:(lra)). set (z := seen n0 / D) in *.
    assert (zD : z * D = seen n0) by (unfold z; field; lra).
  assert (z0 : 0 <= z) by (unfold z, Rdiv; apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
  pose proof (rounded_positive f env z z0) as r0. pose proof (error f ok env z) as E. rewrite (Rabs_pos_eq z z0) in E.
    apply Rabs_le_inv in E.
  assert (all : forall c, 0 <= c <= Rd z -> late 0 (IZR j) mi mj c).
  { intros c [c0 cz]. destruct (Rlt_le_dec (3 * D1) l) as [tiny|normal].
    - apply tiny_is_late; try lra. assert (e1 * d <= / 8388608 * d) by (apply Rmult_le_compat_r; lra). lra.
    - apply line_is_late; try lra. intros s s01 sc.
      pose proof (error_of_normal f ok env (3 * D1) ltac:(rewrite Rabs_pos_eq; lra)) as En'.
        rewrite (Rabs_pos_eq (3 * D1)) in En' by lra. fold D in En'. apply Rabs_le_inv in En'.
      assert (k0 : 0 <= kappa <= 1) by (unfold kappa; lra).
      assert (A : z * ((1 - e1) * (3 * D1)) <= z * D) by (apply Rmult_le_compat_l; lra).
      assert (B : z * ((1 - e1) * d) <= z * D1) by (apply Rmult_le_compat_l; lra).
      assert (C : (1 - e1) * (1 - e1) * (3 * (z * d)) <= (1 + e1) * (IZR j * mi) + l).
      { assert ((1 - e1) * (z * ((1 - e1) * d)) <= (1 - e1) * (z * D1)) by (apply Rmult_le_compat_l; lra). lra. }
      assert (zd0 : 0 <= z * d) by (apply Rmult_le_pos; lra).
      assert (kc : kappa * c * d <= kappa * ((1 + e1) * z + l) * d). { apply Rmult_le_compat_r; [lra|].
        apply Rmult_le_compat_l; lra. }
      assert (ks : (3 * s - 0) * d <= (3 * (kappa * c) + 90 * l) * d) by (apply Rmult_le_compat_r; lra).
      assert (jm : 0 <= IZR j * mi) by (apply Rmult_le_pos; lra).
      assert (kap : kappa * (1 + e1) <= (1 - e1) * (1 - e1) * (1 - 5 * e1)).
      { unfold kappa. assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra). assert (e1 * e1 <= 0.0001 * e1) by (apply
        Rmult_le_compat_r; lra).
        assert (0 <= e1 * (e1 * e1)) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * e1) <= 0.0001 * (e1 * e1)) by
          (apply Rmult_le_compat_r; lra). lra. }
      assert (F : kappa * (1 + e1) * (3 * (z * d)) <= (1 - e1) * (1 - e1) * (1 - 5 * e1) * (3 * (z * d))) by (apply
        Rmult_le_compat_r; lra).
      assert (Gg : (1 - 5 * e1) * ((1 - e1) * (1 - e1) * (3 * (z * d))) <= (1 - 5 * e1) * ((1 + e1) * (IZR j * mi) + l))
        by (apply Rmult_le_compat_l; lra).
      assert (0 <= e1 * (IZR j * mi)) by (apply Rmult_le_pos; lra).
      assert (0 <= e1 * (e1 * (IZR j * mi))) by (apply Rmult_le_pos; lra).
      assert (0 <= l * d) by (apply Rmult_le_pos; lra). assert (l * d <= l * (2 * w)) by (apply Rmult_le_compat_l; lra).
      assert (kappa * (l * d) <= 1 * (l * d)) by (apply Rmult_le_compat_r; lra).
        assert (0 <= e1 * l) by (apply Rmult_le_pos; lra).
      unfold slack_. lra. }
  destruct h as [[_ h]|[[over [h|h]]|[under _]]]; [| | |lra].
  - right. exists (Rd z). split; [exact h|]. split; [lra|]. apply all. lra.
  - left. split; [exact h|]. intros c s s01 _. apply (all (Rd z) ltac:(lra) s s01).
    assert (/ 2 * omega f <= kappa * Rd z) by (unfold kappa; apply Rmult_le_compat; lra). lra.
  - right. exists (omega f). split; [exact h|]. split; [lra|]. apply all. lra.
Qed.
(* Other lines: n + y thirds. *)
Lemma third_value : exists x, value_of third = Number x /\ 0.33 <= seen x /\ 3 * seen x <= (1 + e1) + 6 * l.
Proof.
  pose proof (run third) as h. unfold third in h. cbn in h. unfold one in h. rewrite !small_number in h. cbn in h.
  rewrite (seen_small 1), (seen_small 3) in h by lia. destruct h as [h _]. specialize (h ltac:(lra)).
    replace (1 / 3) with (/ 3) in h by field.
  pose proof (omega_large f ok). pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_small f ok).
    pose proof (e_pos f).
  apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra]. exists (Rd (/ 3)). split; [exact h|].
  pose proof (error f ok env (/ 3)) as E. rewrite (Rabs_pos_eq (/ 3)) in E by lra. apply Rabs_le_inv in E.
  rewrite seen_of_normal; [lra|]. rewrite Rabs_pos_eq; lra.
Qed.
Lemma thirds_are_late (i j : Z) y y' : (1 <= i)%Z -> (i + 1 <= j <= 3)%Z -> value_of y = Number y' -> 0 <= seen y' <=
  2.1 ->
  seen y' * d <= (1 + 3.3 * e1) * ((IZR j - IZR i) * mi) + 7 * (l * w) ->
  zero_is_late (value_of (Product (Sum (small i) y) third)) (IZR i) (IZR j) mi mj.
Proof.
  intros i1 [ij j3] Ey [y0 y2] yd. pose proof d_bounds as (mpos & dw & mw & sx). pose proof (e_pos f).
    pose proof (e_small f ok).
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (omega_large f ok). pose proof w_omega.
  assert (i2 : 1 <= IZR i <= 2) by (split; apply IZR_le; lia). assert (ij' : IZR i + 1 <= IZR j) by (rewrite <-
    plus_IZR; apply IZR_le; lia).
  assert (j3' : IZR j <= 3) by (apply IZR_le; lia).
  pose proof (run (Sum (small i) y)) as hs. cbn in hs. rewrite small_number, Ey in hs. cbn in hs.
    rewrite (seen_small i i1) in hs.
  apply (result_number f ok env) in hs; [|rewrite Rabs_pos_eq; lra]. set (r := Rd (IZR i + seen y')) in *.
  pose proof (error f ok env (IZR i + seen y')) as Er. rewrite (Rabs_pos_eq (IZR i + seen y')) in Er by lra.
    fold r in Er. apply Rabs_le_inv in Er.
  assert (e1 * (IZR i + seen y') <= / 8388608 * 5) by (apply Rmult_le_compat; lra).
  assert (sr : seen r = r) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
  destruct third_value as (x & Ex & x0 & x3).
  pose proof (run (Product (Sum (small i) y) third)) as h. cbn -[third] in h. rewrite hs, Ex in h. cbn in h.
    rewrite sr in h.
  assert (rx : 0 <= r * seen x <= 5). { split; [apply Rmult_le_pos; lra|]. assert (r * seen x <= 5 * 1) by (apply
    Rmult_le_compat; lra). lra. }
  apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra]. right. exists (Rd (r * seen x)). split; [exact h|].
  pose proof (rounded_positive f env _ (proj1 rx)) as c0. split; [exact c0|].
  pose proof (error f ok env (r * seen x)) as Ec. rewrite (Rabs_pos_eq (r * seen x)) in Ec by lra.
    apply Rabs_le_inv in Ec.
  apply line_is_late; try lra. intros s s01 sc. set (c := Rd (r * seen x)) in *. set (Y := IZR i + seen y') in *.
  assert (k0 : 0 <= kappa <= 1) by (unfold kappa; lra).
  assert (c3 : 3 * c <= (1 + e1) * (1 + e1) * (1 + e1) * Y + 50 * l).
  { assert (Y1 : 1 <= Y <= 4.2) by (unfold Y; lra). assert (A : r * (3 * seen x) <= ((1 + e1) * Y + l) * ((1 + e1) + 6 *
    l)) by (apply Rmult_le_compat; lra).
    assert (B : (1 + e1) * (r * (3 * seen x)) <= (1 + e1) * (((1 + e1) * Y + l) * ((1 + e1) + 6 * l))) by (apply
      Rmult_le_compat_l; lra).
    assert (Y5 : 0 <= Y <= 4.2) by (unfold Y; lra). assert (q0 : 0 <= l * Y <= l * 4.2) by (split; [apply Rmult_le_pos;
      lra|apply Rmult_le_compat_l; lra]).
    assert (eq2 : 0 <= e1 * (l * Y) <= 0.001 * (l * Y)) by (split; [apply Rmult_le_pos; lra|]; apply Rmult_le_compat_r;
      lra).
    assert (eeq2 : 0 <= e1 * (e1 * (l * Y)) <= 0.001 * (l * Y)). { split; [apply Rmult_le_pos; lra|].
      assert (e1 * (e1 * (l * Y)) <= 1 * (e1 * (l * Y))) by (apply Rmult_le_compat_r; lra). lra. }
    assert (el : 0 <= e1 * l <= l) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_l l) at 2;
      apply Rmult_le_compat_r; lra).
    assert (eel : 0 <= e1 * (e1 * l) <= l). { split; [apply Rmult_le_pos; lra|].
      assert (e1 * (e1 * l) <= 1 * (e1 * l)) by (apply Rmult_le_compat_r; lra). lra. }
    assert (ll : 0 <= l * l <= l) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_l l) at 3;
      apply Rmult_le_compat_r; lra).
    assert (ell : 0 <= e1 * (l * l) <= l). { split; [apply Rmult_le_pos; lra|].
      assert (e1 * (l * l) <= 1 * (l * l)) by (apply Rmult_le_compat_r; lra). lra. }
    lra. }
  assert (kap : kappa * ((1 + e1) * (1 + e1) * (1 + e1)) <= 1 - 7 * e1).
  { unfold kappa. assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra). assert (e1 * e1 <= 0.0001 * e1) by (apply
    Rmult_le_compat_r; lra).
    assert (0 <= e1 * (e1 * e1)) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * e1) <= 0.0001 * (e1 * e1)) by (apply
      Rmult_le_compat_r; lra).
    assert (0 <= e1 * (e1 * (e1 * e1))) by (apply Rmult_le_pos; lra). lra. }
  assert (kc : kappa * (3 * c) <= (1 - 7 * e1) * Y + 50 * l).
  { assert (kappa * (3 * c) <= kappa * ((1 + e1) * (1 + e1) * (1 + e1) * Y + 50 * l)) by (apply Rmult_le_compat_l; lra).
    assert (kappa * ((1 + e1) * (1 + e1) * (1 + e1)) * Y <= (1 - 7 * e1) * Y) by (apply Rmult_le_compat_r; unfold Y;
      lra).
    assert (kappa * (50 * l) <= 1 * (50 * l)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (ks : (3 * s - IZR i) * d <= ((1 - 7 * e1) * seen y' + 140 * l) * d).
  { apply Rmult_le_compat_r; [lra|]. assert (0 <= e1 * IZR i) by (apply Rmult_le_pos; lra). unfold Y in kc. lra. }
  assert (jm : 0 <= (IZR j - IZR i) * mi) by (apply Rmult_le_pos; lra).
  assert (yk : (1 - 7 * e1) * (seen y' * d) <= (1 - 7 * e1) * ((1 + 3.3 * e1) * ((IZR j - IZR i) * mi) + 7 * (l * w)))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * ((IZR j - IZR i) * mi)) by (apply Rmult_le_pos; lra).
  assert (0 <= e1 * (e1 * ((IZR j - IZR i) * mi))) by (apply Rmult_le_pos; lra).
  assert (l * d <= l * (2 * w)) by (apply Rmult_le_compat_l; lra). assert (0 <= l * w) by (apply Rmult_le_pos; lra).
  assert (0 <= e1 * (l * w)) by (apply Rmult_le_pos; lra). unfold slack_. lra.
Qed.
End Line.

(* The first zero of the hull. *)
Lemma smaller_of_two x v out : 0 <= x -> (v = Infinite true \/ exists c, v = Number c /\
  0 <= c) -> smaller f env (Number x) v out ->
  exists y, out = Number y /\ 0 <= y <= x + l /\ forall c, v = Number c -> y <= c + l.
Proof.
  intros x0 positive h. pose proof (l_pos f). pose proof (seen_off f env x) as sx.
    pose proof (seen_monotone f env 0 x x0) as x1. rewrite seen_0 in x1. apply Rabs_le_inv in sx.
  destruct positive as [->|(c & -> & c0)].
  - destruct h as [[g [-> | ->]]|[g _]]; cbn in g; try tauto; eexists; (split; [reflexivity|]); (split; [lra|]);
    discriminate.
  - pose proof (seen_off f env c) as sc. pose proof (seen_monotone f env 0 c c0) as c1. rewrite seen_0 in c1.
    apply Rabs_le_inv in sc.
    pose proof (seen_smaller f env x) as sx'. rewrite (Rabs_pos_eq x), (Rabs_pos_eq (seen x)) in sx' by lra.
    pose proof (seen_smaller f env c) as sc'. rewrite (Rabs_pos_eq c), (Rabs_pos_eq (seen c)) in sc' by lra.
    destruct h as [[g [-> | ->]]|[g [-> | ->]]]; cbn in g; eexists; (split; [reflexivity|]);
      (split; [lra|]); intros y E; injection E as <-; lra.
Qed.
Lemma late_earlier i j mi mj c c' : late i j mi mj c -> c' <= c -> late i j mi mj c'.
Proof.
  intros h le s s01 sc. apply h; [exact s01|]. pose proof (e_pos f). pose proof (e_small f ok).
  assert (kappa * c' <= kappa * c) by (apply Rmult_le_compat_l; [unfold kappa|]; lra). lra.
Qed.
Lemma until_zero_value where_ before zero (i j mi mj x : R) : value_of before = Number x -> 0 <= x ->
  (says f env value_of where_ \/ ~ says f env value_of where_) ->
  (says f env value_of where_ -> zero_is_late (value_of zero) i j mi mj) ->
  exists y, value_of (until_zero where_ before zero) = Number y /\ 0 <= y <= x + l /\
    (says f env value_of where_ -> late i j mi mj (y - l)).
Proof.
  intros E x0 either h. pose proof (run (until_zero where_ before zero)) as hs. unfold until_zero in hs.
    cbn -[says] in hs. pose proof (l_pos f).
  pose proof (run (Smaller before zero)) as hm. cbn in hm. rewrite E in hm.
  destruct hs as [[yes hs]|[no hs]].
  - destruct (h yes) as [[inf all]|(c & Ec & c0 & lc)].
    + destruct (smaller_of_two x _ _ x0 (or_introl inf) hm) as (y & Ey & yb & _). exists y.
      split; [exact (eq_trans hs Ey)|]. split; [exact yb|].
      intros _. apply all.
    + destruct (smaller_of_two x _ _ x0 (or_intror (ex_intro _ c (conj Ec c0))) hm) as (y & Ey & yb & yc). exists y.
      split; [exact (eq_trans hs Ey)|].
      split; [exact yb|]. intros _. apply (late_earlier _ _ _ _ c _ lc). pose proof (yc c Ec). lra.
  - exists x. split; [exact (eq_trans hs E)|]. split; [lra|]. tauto.
Qed.
Variables b0 b1 b2 b3 : number.
Variables x0 x1 x2 x3 : R.
Hypothesis c0 : control b0 x0.
Hypothesis c1 : control b1 x1.
Hypothesis c2 : control b2 x2.
Hypothesis c3 : control b3 x3.
Hypothesis first_is_positive : 0 < seen x0.
Notation m0 := (seen x0).
Notation m1 := (seen x1).
Notation m2 := (seen x2).
Notation m3 := (seen x3).
Lemma positive_says b x : control b x -> says f env value_of (is_positive b) <-> 0 < seen x.
Proof. intros (E & _). cbn. rewrite E, small_number. cbn. now rewrite seen_0. Qed.
Lemma positive_decided b x : control b x -> says f env value_of (is_positive b) \/ ~ says f env value_of (is_positive
  b).
Proof. intro h. rewrite (positive_says b x h). destruct (Rlt_dec 0 (seen x)); auto. Qed.
Lemma scaled_first (j : Z) : (1 <= j <= 3)%Z -> exists n0, value_of (Product b0 (small j)) = Number n0 /\
  0 <= seen n0 <= (1 + e1) * (IZR j * m0) + l.
Proof.
  intros [j1 j3]. pose proof (IZR_le _ _ j1). pose proof (IZR_le _ _ j3). destruct c0 as (E & _ & _ & b).
    pose proof w_omega. pose proof (e_pos f).
  pose proof (run (Product b0 (small j))) as h. cbn in h. rewrite E, small_number in h. cbn in h.
    rewrite (seen_small j j1) in h. rewrite (Rabs_pos_eq m0) in b by lra.
  assert (s0 : 0 <= m0 * IZR j <= 3 * w). { split; [apply Rmult_le_pos; lra|].
    assert (m0 * IZR j <= w * 3) by (apply Rmult_le_compat; lra). lra. }
  pose proof (omega_large f ok). apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra].
    exists (Rd (m0 * IZR j)). split; [exact h|].
  pose proof (rounded_positive f env _ (proj1 s0)) as r0. pose proof (error f ok env (m0 * IZR j)) as er.
    rewrite (Rabs_pos_eq (m0 * IZR j)) in er by lra. apply Rabs_le_inv in er.
  pose proof (seen_smaller f env (Rd (m0 * IZR j))) as ss. rewrite (Rabs_pos_eq (Rd _)) in ss by lra.
    pose proof (Rle_abs (seen (Rd (m0 * IZR j)))).
  pose proof (seen_monotone f env 0 _ r0) as p0. rewrite seen_0 in p0. lra.
Qed.
Theorem first_zero_value : exists x, value_of (first_zero b0 b1 b2 b3) = Number x /\ 0 <= x <= 2 + 6 * l /\
  forall s, 0 <= s <= 1 -> s <= kappa * x + 24 * l -> let e := slack_ in
    (m1 <= 0 -> - e <= line 0 1 m0 m1 s) /\ (m2 <= 0 -> - e <= line 0 2 m0 m2 s) /\
      (m3 <= 0 -> - e <= line 0 3 m0 m3 s) /\
    (0 < m1 -> m2 <= 0 -> - e <= line 1 2 m1 m2 s) /\ (0 < m1 -> m3 <= 0 -> - e <= line 1 3 m1 m3 s) /\
    (0 < m1 -> 0 < m2 -> m3 <= 0 -> - e <= line 2 3 m2 m3 s).
Proof.
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (positive_says b1 x1 c1) as p1. pose proof (positive_says b2 x2 c2) as p2.
    pose proof (positive_says b3 x3 c3) as p3.
  assert (neg : forall x, ~ 0 < x <-> x <= 0) by (intros; split; intros; lra).
  assert (by1 : 0 <= seen x0 <= (1 + e1) * (1 * m0) + l) by (assert (0 <= e1 * m0) by (apply Rmult_le_pos; lra); lra).
  destruct (until_zero_value (Not (is_positive b1)) (small 2) (zero_0 b0 b0 b1) 0 1 m0 m1 2 (small_number 2) ltac:(lra))
    as (f1 & E1 & g1 & l1).
  { cbn [says]. rewrite p1. destruct (Rlt_dec 0 m1); tauto. }
  { cbn [says]. rewrite p1, neg. intro le. apply (zero_0_is_late b0 b1 x0 x1 c0 c1 first_is_positive le 1 b0 x0
    ltac:(lia) (proj1 c0) by1). }
  destruct (scaled_first 2 ltac:(lia)) as (n2 & En2 & by2). destruct (scaled_first 3 ltac:(lia)) as (n3 & En3 & by3).
  destruct (until_zero_value (Not (is_positive b2)) _ (zero_0 (Product b0 (small 2)) b0 b2) 0 2 m0 m2 f1 E1 ltac:(lra))
    as (f2 & E2 & g2 & l2).
  { cbn [says]. rewrite p2. destruct (Rlt_dec 0 m2); tauto. }
  { cbn [says]. rewrite p2, neg. intro le. apply (zero_0_is_late b0 b2 x0 x2 c0 c2 first_is_positive le 2 _ n2
    ltac:(lia) En2 by2). }
  destruct (until_zero_value (Not (is_positive b3)) _ (zero_0 (Product b0 (small 3)) b0 b3) 0 3 m0 m3 f2 E2 ltac:(lra))
    as (f3 & E3 & g3 & l3).
  { cbn [says]. rewrite p3. destruct (Rlt_dec 0 m3); tauto. }
  { cbn [says]. rewrite p3, neg. intro le. apply (zero_0_is_late b0 b3 x0 x3 c0 c3 first_is_positive le 3 _ n3
    ltac:(lia) En3 by3). }
  assert (lw : 0 <= l * w) by (apply Rmult_le_pos; lra).
  destruct (until_zero_value (Both (is_positive b1) (Not (is_positive b2))) _ (Product (Sum one (ratio b1 b2)) third) 1
    2 m1 m2 f3 E3 ltac:(lra)) as (f4 & E4 & g4 & l4).
  { cbn [says]. rewrite p1, p2. destruct (Rlt_dec 0 m1), (Rlt_dec 0 m2); tauto. }
  { cbn [says]. rewrite p1, p2, neg. intros [pos le]. destruct (ratio_value b1 b2 x1 x2 c1 c2 pos le) as (c & Ec & cb &
    cd).
    apply (thirds_are_late b1 b2 x1 x2 c1 c2 pos le 1 2 _ c ltac:(lia) ltac:(lia) Ec ltac:(lra)).
    assert (0 <= e1 * m1) by (apply Rmult_le_pos; lra). lra. }
  destruct (until_zero_value (Both (is_positive b1) (Not (is_positive b3))) _ (Product (Sum one (Product (small 2)
    (ratio b1 b3))) third) 1 3 m1 m3 f4 E4 ltac:(lra)) as (f5 & E5 & g5 & l5).
  { cbn [says]. rewrite p1, p3. destruct (Rlt_dec 0 m1), (Rlt_dec 0 m3); tauto. }
  { cbn [says]. rewrite p1, p3, neg. intros [pos le]. destruct (ratio_value b1 b3 x1 x3 c1 c3 pos le) as (c & Ec & cb &
    cd).
    destruct (d_bounds b1 b3 x1 x3 c1 c3 pos le) as (dpos & dw & _).
    pose proof (run (Product (small 2) (ratio b1 b3))) as h. cbn -[ratio] in h. rewrite small_number, Ec in h.
      cbn in h. rewrite (seen_small 2) in h by lia.
    pose proof (omega_large f ok). apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra].
    pose proof (error f ok env (2 * seen c)) as er. rewrite (Rabs_pos_eq (2 * seen c)) in er by lra.
      apply Rabs_le_inv in er.
    pose proof (rounded_positive f env (2 * seen c) ltac:(lra)) as r0. set (y := Rd (2 * seen c)) in *.
    pose proof (seen_smaller f env y) as ss. rewrite (Rabs_pos_eq y) in ss by lra. pose proof (Rle_abs (seen y)).
      pose proof (seen_monotone f env 0 _ r0) as y0. rewrite seen_0 in y0.
    assert (e1 * (2 * seen c) <= / 8388608 * 3) by (apply Rmult_le_compat; lra).
    apply (thirds_are_late b1 b3 x1 x3 c1 c3 pos le 1 3 _ y ltac:(lia) ltac:(lia) h ltac:(lra)).
    assert (seen y * (m1 - m3) <= ((1 + e1) * (2 * seen c) + l) * (m1 - m3)) by (apply Rmult_le_compat_r; lra).
    assert ((1 + e1) * (2 * (seen c * (m1 - m3))) <= (1 + e1) * (2 * ((1 + 2.2 * e1) * m1 + l * (2 * w)))) by (apply
      Rmult_le_compat_l; lra).
    assert (l * (m1 - m3) <= l * (2 * w)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= e1 * m1) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * m1) <= 0.001 * (e1 * m1)) by (apply
      Rmult_le_compat_r; lra).
    assert (e1 * (l * w) <= 0.001 * (l * w)) by (apply Rmult_le_compat_r; lra). lra. }
  destruct (until_zero_value (Both (Both (is_positive b1) (is_positive b2)) (Not (is_positive b3))) _ (Product (Sum
    (small 2) (ratio b2 b3)) third) 2 3 m2 m3 f5 E5 ltac:(lra)) as (f6 & E6 & g6 & l6).
  { cbn [says]. rewrite p1, p2, p3. destruct (Rlt_dec 0 m1), (Rlt_dec 0 m2), (Rlt_dec 0 m3); tauto. }
  { cbn [says]. rewrite p1, p2, p3, neg. intros [[_ pos] le]. destruct (ratio_value b2 b3 x2 x3 c2 c3 pos le) as (c & Ec
    & cb & cd).
    apply (thirds_are_late b2 b3 x2 x3 c2 c3 pos le 2 3 _ c ltac:(lia) ltac:(lia) Ec ltac:(lra)).
    assert (0 <= e1 * m2) by (apply Rmult_le_pos; lra). lra. }
  exists f6. split; [exact E6|]. split; [lra|]. intros s s01 sb. cbv zeta. cbn [says] in *.
    rewrite ?p1, ?p2, ?p3, ?neg in *.
  assert (within : forall x, f6 - 6 * l <= x -> s <= kappa * x + 30 * l).
  { intros x le. assert (kappa * (f6 - 6 * l) <= kappa * x) by (unfold kappa; apply Rmult_le_compat_l; lra).
    assert (kappa * (6 * l) <= 1 * (6 * l)) by (unfold kappa; apply Rmult_le_compat_r; lra). lra. }
  repeat split; intros; [apply l1|apply l2|apply l3|apply l4|apply l5|apply l6]; auto; try tauto; apply within; lra.
Qed.

(* Blossoms of the control values at a time, computed, and exact ones of the values as they are seen. *)
Definition mix (t a b : R) := (1 - t) * a + t * b.
Definition part_at t := let a0 := mix t m0 m1 in let a1 := mix t m1 m2 in let a2 := mix t m2 m3 in
  (a0, mix t a0 a1, mix t (mix t a0 a1) (mix t a1 a2)).
Section Ahead.
Variable t : number.
Variable T : R.
Hypothesis time_ : seen_value f env (value_of t) = Number T.
Hypothesis in_step : 0 <= T <= 1.
Lemma mix_holds x y X Y n a : operand (value_of x) X w n a -> operand (value_of y) Y w n a -> (n <= 20)%nat -> a <= 100
  * (w + 1) ->
  holds (value_of (between_ t x y)) (mix T X Y) w (3 + n) (1.03 * a + 2.1 * w + 5.1).
Proof.
  intros hx hy n20 a100. pose proof w_omega. pose proof (l_pos f). pose proof (l_small f ok).
    pose proof (omega_large f ok).
  assert (a0 : 0 <= a) by (destruct hx as (v & _ & _ & _ & h); exact h).
  assert (part : forall s z, 0 <= s <= 1 -> 0 <= z -> 0 <= s * z <= z). { intros s z s01 z0.
    split; [now apply Rmult_le_pos|]. rewrite <- (Rmult_1_l z) at 2. now apply Rmult_le_compat_r. }
  pose proof (part (1 - T) w ltac:(lra) ltac:(lra)). pose proof (part T w ltac:(lra) ltac:(lra)).
  pose proof (part (1 - T) a ltac:(lra) ltac:(lra)). pose proof (part T a ltac:(lra) ltac:(lra)).
  assert (l * (2 * a) <= 0.001 * a) by (assert (l * (2 * a) <= / 1152921504606846976 * (2 * a)) by (apply
    Rmult_le_compat_r; lra); lra).
  pose proof (run (Product (Minus one t) x)) as h. cbn -[one] in h.
  pose proof (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _ h (here rest_operand t T time_
    in_step) hx ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  pose proof (run (Product t y)) as h'. cbn in h'.
  pose proof (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _ h' (moment_operand_ f env value_of t T time_ in_step) hy
    ltac:(lia) ltac:(lra) ltac:(lra)) as r'.
  pose proof (run (between_ t x y)) as h''. unfold between_ in h''. cbn -[one] in h''.
  pose proof (holds_sum f ok env Rplus _ _ _ _ _ _ _ _ _ _ _ (2 + n) ltac:(auto) h'' (seen_operand f env _ _ _ _ _ r)
    (seen_operand f env _ _ _ _ _ r')
    ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
Lemma control_operand b x : control b x -> operand (value_of b) (seen x) w 0 0.
Proof.
  intros (E & _ & _ & small_). rewrite E. apply (operand_weaker f env _ _ _ _ _ _ _ _ (operand_exact f env x));
    lra || lia.
Qed.
Definition ahead_error := 9.02 * e1 * w + l * (7 * w + 18).
Lemma positive_holds e X n a : holds (value_of e) X w n a -> (n <= 9)%nat -> a <= 7 * w + 18 -> says f env value_of
  (is_positive e) -> - ahead_error < X.
Proof.
  intros (x & E & _ & d & _ & a0) n9 A pos. cbn in pos. rewrite E, small_number in pos. cbn in pos.
    rewrite seen_0 in pos.
  pose proof (seen_positive f env x pos). pose proof (q_linear f ok n ltac:(lia)) as qn. pose proof (q_ge f n).
    pose proof (e_pos f). pose proof (l_pos f).
  assert (n9' : 0 <= INR n <= 9) by (split; [apply pos_INR|replace 9 with (INR 9) by (simpl; ring); now apply le_INR]).
  assert (1.001 * INR n * e1 <= 9.02 * e1) by (apply Rmult_le_compat_r; lra).
  assert ((q n - 1) * w <= 9.02 * e1 * w) by (apply Rmult_le_compat_r; lra).
  assert (l * a <= l * (7 * w + 18)) by (apply Rmult_le_compat_l; lra). apply Rabs_le_inv in d. unfold ahead_error. lra.
Qed.
Lemma positive_before : says f env value_of (is_positive_before b0 b1 b2 b3 t) -> let '(a, c, last) := part_at T in
  T < 1 /\ - ahead_error < a /\ - ahead_error < c /\ - ahead_error < last.
Proof.
  intros [[[rest pa] pc] pl]. pose proof (l_pos f). pose proof (w_small) as [w0 _].
  pose proof (mix_holds b0 b1 _ _ 0 0 (control_operand b0 x0 c0) (control_operand b1 x1 c1) ltac:(lia) ltac:(lra)) as
    a0.
  pose proof (mix_holds b1 b2 _ _ 0 0 (control_operand b1 x1 c1) (control_operand b2 x2 c2) ltac:(lia) ltac:(lra)) as
    a1.
  pose proof (mix_holds b2 b3 _ _ 0 0 (control_operand b2 x2 c2) (control_operand b3 x3 c3) ltac:(lia) ltac:(lra)) as
    a2.
  pose proof (mix_holds _ _ _ _ _ _ (seen_operand f env _ _ _ _ _ a0) (seen_operand f env _ _ _ _ _ a1) ltac:(lia)
    ltac:(lra)) as d0.
  pose proof (mix_holds _ _ _ _ _ _ (seen_operand f env _ _ _ _ _ a1) (seen_operand f env _ _ _ _ _ a2) ltac:(lia)
    ltac:(lra)) as d1.
  pose proof (mix_holds _ _ _ _ _ _ (seen_operand f env _ _ _ _ _ d0) (seen_operand f env _ _ _ _ _ d1) ltac:(lia)
    ltac:(lra)) as last.
  cbn [part_at]. split.
  - apply Rnot_le_lt. intro T1. assert (T = 1) by lra. subst T. cbn -[one] in rest.
    pose proof (run (Minus one t)) as h. cbn in h. unfold sum in h. rewrite time_ in h. unfold one in h.
      rewrite small_number in h. cbn in h.
    rewrite (seen_1 f fine env) in h. replace (1 - 1) with 0 in h by ring. pose proof (omega_large f ok).
    apply (result_number f ok env) in h; [|rewrite Rabs_R0; lra]. rewrite rounded_0 in h. unfold one in rest.
      rewrite h, small_number in rest. cbn in rest. lra.
  - split; [exact (positive_holds _ _ _ _ a0 ltac:(lia) ltac:(lra) pa)|]. split;
    [exact (positive_holds _ _ _ _ d0 ltac:(lia) ltac:(lra) pc)|].
    exact (positive_holds _ _ _ _ last ltac:(lia) ltac:(lra) pl).
Qed.
End Ahead.

(* Raised by a reserve, the cubic is positive up to there, and a little further. *)
Variable r : R.
Hypothesis reserve_ : 4 * slack_ < r /\ ahead_error + 200 * (l * w) <= r.
Notation raised s := (cubic (m0 + r) (m1 + r) (m2 + r) (m3 + r) s).
Lemma part_is_positive T s : 0 <= T <= 1 -> let '(a, c, last) := part_at T in - r < a -> - r < c -> - r < last -> 0 <= s
  <= T -> 0 < raised s.
Proof.
  intros T01. cbn [part_at]. intros a c last sT. pose proof (l_pos f). destruct w_small as [w0 _]. assert (r0 : 0 < r).
  { destruct reserve_ as [h _]. assert (0 <= l * w) by (apply Rmult_le_pos; lra). unfold slack_ in h. lra. }
  destruct (Req_dec T 0) as [->|n].
  - replace s with 0 by lra. unfold cubic. lra.
  - pose proof (Certificates.one_sign_on_a_part (m0 + r) (m1 + r) (m2 + r) (m3 + r) 0 T (s / T)) as P. cbv zeta in P.
    assert (sT' : 0 <= s / T <= 1). { split; [apply Rle_mult_inv_pos; lra|]. apply Rmult_le_reg_r with T; [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
    specialize (P sT'). replace ((1 - s / T) * 0 + s / T * T) with s in P by (field; lra).
    replace (raised s) with (Certificates.blossom (m0 + r) (m1 + r) (m2 + r) (m3 + r) s s s) by (unfold
      Certificates.blossom, cubic; ring).
    apply P; unfold Certificates.blossom, mix in *; lra.
Qed.
Lemma positive_a_little_further T s : 0 <= T <= 1 -> (let '(a, c, last) := part_at T in - ahead_error < a /\
  - ahead_error < c /\ - ahead_error < last) ->
  0 <= s <= 1 -> s <= T + 30 * l -> 0 < raised s.
Proof.
  intros T01. cbn [part_at]. intros (a & c & last) s01 near_. pose proof (l_pos f). pose proof (l_small f ok).
    destruct w_small as [w0 _]. destruct reserve_ as [_ enough].
  assert (lw : 0 <= l * w) by (apply Rmult_le_pos; lra).
  destruct (Rle_lt_dec s T) as [le|lt].
  - apply (part_is_positive T s T01); lra.
  - pose proof (part_is_positive s s s01) as P. cbn [part_at] in P. set (h := s - T) in *.
    assert (hb : 0 < h <= 30 * l) by (unfold h; lra).
    destruct c0 as (_ & _ & _ & w0'). destruct c1 as (_ & _ & _ & w1'). destruct c2 as (_ & _ & _ & w2').
      destruct c3 as (_ & _ & _ & w3').
    apply Rabs_le_inv in w0', w1', w2', w3'.
    assert (step : forall z, - (2 * w) <= z -> - (60 * (l * w)) <= h * z).
    { intros z zb. assert (h * - (2 * w) <= h * z) by (apply Rmult_le_compat_l; lra).
      assert (h * (2 * w) <= 30 * l * (2 * w)) by (apply Rmult_le_compat_r; lra). lra. }
    assert (mixed : forall t x y, 0 <= t <= 1 -> - w <= x <= w -> - w <= y <= w -> - w <= mix t x y <= w).
    { intros t x y t01 xb yb. unfold mix. assert ((1 - t) * - w <= (1 - t) * x <= (1 - t) * w) by (split;
      apply Rmult_le_compat_l; lra).
      assert (t * - w <= t * y <= t * w) by (split; apply Rmult_le_compat_l; lra). lra. }
    assert (move : forall x y, mix s x y = mix T x y + h * (y - x)) by (intros; unfold mix, h; ring).
    assert (t01 := mixed T m0 m1 T01 w0' w1'). assert (t12 := mixed T m1 m2 T01 w1' w2').
      assert (t23 := mixed T m2 m3 T01 w2' w3').
    assert (s01_ := mixed s m0 m1 s01 w0' w1'). assert (s12 := mixed s m1 m2 s01 w1' w2').
      assert (s23 := mixed s m2 m3 s01 w2' w3').
    assert (t012 := mixed T _ _ T01 t01 t12). assert (t123 := mixed T _ _ T01 t12 t23).
    assert (s012 := mixed s _ _ s01 s01_ s12). assert (s123 := mixed s _ _ s01 s12 s23).
    assert (lower : forall t x y x' y' e, 0 <= t <= 1 -> x - e <= x' -> y - e <= y' -> mix t x y - e <= mix t x' y').
    { intros t x y x' y' e t01' hx hy. unfold mix. assert ((1 - t) * (x - e) <= (1 - t) * x') by (apply
      Rmult_le_compat_l; lra).
      assert (t * (y - e) <= t * y') by (apply Rmult_le_compat_l; lra). lra. }
    set (d := 60 * (l * w)) in *.
    assert (A0 : mix T m0 m1 - d <= mix s m0 m1) by (rewrite move; pose proof (step (m1 - m0) ltac:(lra)); lra).
    assert (A1 : mix T m1 m2 - d <= mix s m1 m2) by (rewrite move; pose proof (step (m2 - m1) ltac:(lra)); lra).
    assert (A2 : mix T m2 m3 - d <= mix s m2 m3) by (rewrite move; pose proof (step (m3 - m2) ltac:(lra)); lra).
    assert (C0 : mix T (mix T m0 m1) (mix T m1 m2) - 2 * d <= mix s (mix s m0 m1) (mix s m1 m2)).
    { pose proof (lower T _ _ _ _ d T01 A0 A1) as lo. rewrite (move (mix s m0 m1)).
      pose proof (step (mix s m1 m2 - mix s m0 m1) ltac:(lra)). lra. }
    assert (C1 : mix T (mix T m1 m2) (mix T m2 m3) - 2 * d <= mix s (mix s m1 m2) (mix s m2 m3)).
    { pose proof (lower T _ _ _ _ d T01 A1 A2) as lo. rewrite (move (mix s m1 m2)).
      pose proof (step (mix s m2 m3 - mix s m1 m2) ltac:(lra)). lra. }
    pose proof (lower T _ _ _ _ (2 * d) T01 C0 C1) as lo.
    pose proof (move (mix s (mix s m0 m1) (mix s m1 m2)) (mix s (mix s m1 m2) (mix s m2 m3))) as mv.
    pose proof (step (mix s (mix s m1 m2) (mix s m2 m3) - mix s (mix s m0 m1) (mix s m1 m2)) ltac:(lra)) as st.
    apply P; unfold d in *; lra.
Qed.

(* How far to look ahead: up to the part that results, but for what follows, the raised cubic is positive. *)
Definition is_part y := 0 <= y <= 4 /\ forall s, 0 <= s <= 1 -> s <= kappa * y + 24 * l -> 0 < raised s.
Lemma multiple_value (j : Z) first x : (1 <= j <= 16)%Z -> value_of first = Number x -> 0 <= x <= 3 ->
  exists y, value_of (Product (small j) first) = Number y /\ 0 <= y.
Proof.
  intros [j1 j16] E xb. apply IZR_le in j1 as j1', j16 as j16'. pose proof (run (Product (small j) first)) as h.
    cbn in h. rewrite small_number, E in h. cbn in h.
  rewrite (seen_small j j1) in h. pose proof (seen_smaller f env x) as ss. rewrite (Rabs_pos_eq x) in ss by lra.
    pose proof (Rle_abs (seen x)).
  pose proof (seen_monotone f env 0 x ltac:(lra)) as s0. rewrite seen_0 in s0. pose proof (omega_large f ok).
  assert (b : 0 <= IZR j * seen x <= 48). { split; [apply Rmult_le_pos; lra|].
    assert (IZR j * seen x <= 16 * 3) by (apply Rmult_le_compat; lra). lra. }
  apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra]. eexists. split; [exact h|]. apply rounded_positive.
    lra.
Qed.
Lemma ahead_is_part t y : value_of t = Number y -> 0 <= y -> says f env value_of (is_positive_before b0 b1 b2 b3 t) ->
  is_part y.
Proof.
  intros E y0 before. pose proof (l_pos f). pose proof (l_small f ok). pose proof (seen_off f env y) as so.
    apply Rabs_le_inv in so. pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (seen_monotone f env 0 y y0) as s0. rewrite seen_0 in s0.
  assert (T1 : seen y <= 1).
  { apply Rnot_lt_le. intro over. destruct before as [[[rest _] _] _]. cbn -[one] in rest.
    pose proof (run (Minus one t)) as h. cbn in h. rewrite E in h.
    unfold one in h. rewrite small_number in h. cbn in h. rewrite (seen_1 f fine env) in h.
    unfold result in h. destruct h as [[_ h']|[[o _]|[_ [h'|h']]]]; unfold one in rest.
    - rewrite h', small_number in rest. cbn in rest. rewrite seen_0 in rest. pose proof (monotone env (1 - seen y) 0
      ltac:(lra)) as r0. rewrite rounded_0 in r0.
      pose proof (seen_monotone f env _ _ r0) as s1. rewrite seen_0 in s1. lra.
    - pose proof (monotone env (1 - seen y) 0 ltac:(lra)) as r0. rewrite rounded_0 in r0.
      pose proof (omega_large f ok). lra.
    - rewrite h', small_number in rest. destruct rest.
    - rewrite h', small_number in rest. cbn in rest. rewrite seen_0 in rest. pose proof (omega_large f ok).
      pose proof (seen_monotone f env (- omega f) 0 ltac:(lra)) as s1. rewrite seen_0 in s1. lra. }
  assert (T01 : 0 <= seen y <= 1) by lra.
  assert (time_ : seen_value f env (value_of t) = Number (seen y)) by (rewrite E; reflexivity).
  pose proof (positive_before t (seen y) time_ T01 before) as P. cbn [part_at] in P. destruct P as (_ & P).
  split; [lra|]. intros s s01 sb. apply (positive_a_little_further (seen y) s T01 P s01).
  assert (kappa * y <= 1 * y) by (unfold kappa; apply Rmult_le_compat_r; lra). lra.
Qed.
Theorem looking_ahead_value : exists y, value_of (looking_ahead b0 b1 b2 b3 (first_zero b0 b1 b2 b3)) = Number y /\
  is_part y.
Proof.
  destruct first_zero_value as (x & E & xb & lines). pose proof (l_pos f). pose proof (l_small f ok).
    set (first := first_zero b0 b1 b2 b3) in *.
  assert (itself : is_part x).
  { split; [lra|]. intros s s01 sb. destruct reserve_ as [enough _]. destruct (lines s s01 sb) as (l01 & l02 & l03 & l12
    & l13 & l23).
    destruct w_small as [w0 _]. assert (0 <= l * w) by (apply Rmult_le_pos; lra).
    apply hull_of_lines; [exact s01|unfold slack_ in enough; lra|].
    apply (lines_of_the_code m0 m1 m2 m3 s slack_ r s01 first_is_positive ltac:(unfold slack_;
      lra) enough l01 l02 l03 l12 l13 l23). }
  destruct (multiple_value 16 first x ltac:(lia) E ltac:(lra)) as (y16 & E16 & p16).
    destruct (multiple_value 4 first x ltac:(lia) E ltac:(lra)) as (y4 & E4 & p4).
  pose proof (run (looking_ahead b0 b1 b2 b3 first)) as h. unfold looking_ahead in h.
    cbn -[says is_positive_before] in h.
  match type of h with _ \/ (_ /\ _ = value_of ?e) => pose proof (run e) as h' end.
    cbn -[says is_positive_before] in h'.
  destruct h as [[yes h]|[_ h]].
  - exists y16. split; [exact (eq_trans h E16)|]. exact (ahead_is_part _ y16 E16 p16 yes).
  - destruct h' as [[yes h']|[_ h']].
    + exists y4. split; [exact (eq_trans h (eq_trans h' E4))|]. exact (ahead_is_part _ y4 E4 p4 yes).
    + exists x. split; [exact (eq_trans h (eq_trans h' E))|exact itself].
Qed.
End Clipping.
