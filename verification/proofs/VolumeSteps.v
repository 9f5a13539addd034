(* The volume keeps a pair apart: throughout, from a moment to the end, or from a moment to the time that clipping
   gives. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Directions Held Hull Volume Clipping.
From Selvedge Require Expressions Errors Bounds Certificates.
Import ListNotations.
Open Scope R_scope.

(* The code's terms. *)
Definition corners_of pairs := match pairs with p :: b :: c :: _ => (p, b, c) | _ => ((0, 0), (0, 0), (0, 0))%nat end.
Definition margins pairs t := let '(p, b, c) := corners_of pairs in let e := error_of_volume pairs in
  let '(b0, b1, b2, b3) := values_from t (outer p b c Expressions.Start) (inner p b c Expressions.Start) (inner p b c
    Expressions.End)
    (outer p b c Expressions.End) in (margin b0 b0 e, margin b0 b1 e, margin b0 b2 e, margin b0 b3 e).
Definition all_positive '(m0, m1, m2, m3) := Both (Both (Both (is_positive m0) (is_positive m1)) (is_positive m2))
  (is_positive m3).
Definition clipped_until t '(m0, m1, m2, m3) := let next := next_time t (looking_ahead m0 m1 m2 m3 (first_zero m0 m1 m2
  m3)) in Select (Both (is_positive m0) (Greater next t)) next t.
Definition volume_to_the_end pairs t := all_positive (margins pairs t).
Definition volume_throughout pairs := volume_to_the_end pairs (Constant (Small 0)).
Definition volume_until pairs t := clipped_until t (margins pairs t).

Section VolumeSteps.
Load "Setting.section".
Notation kappa := (kappa f).
Notation constant := (constant f env given value_of run).
Variable t : number.
Variable tau : R.
Notation T := (seen tau).
Hypothesis moment : value_of t = Number tau.
Hypothesis in_step : 0 <= T <= 1.
Lemma time_ : seen_value f env (value_of t) = Number T. Proof. now rewrite moment. Qed.

(* The next time is a part s of the way from T to the end, and s no more than the computed part allows. *)
Lemma next_time_value part y : value_of part = Number y -> 0 <= y <= 4 -> exists N,
  value_of (next_time t part) = Number N /\
  forall t', T <= t' <= N -> t' <= 1 -> exists s, 0 <= s <= 1 /\ t' = (1 - s) * T + s * 1 /\ s <= kappa * y + 24 * l.
Proof.
  intros Ey y4. pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
    pose proof (omega_large f ok). pose proof (l_e f fine).
  assert (positive_seen : forall x, 0 <= x -> 0 <= seen x <= x).
  { intros x x0. pose proof (seen_smaller f env x) as h. rewrite (Rabs_pos_eq x x0) in h. pose proof (Rle_abs (seen x)).
    pose proof (seen_monotone f env 0 x x0) as h0. rewrite seen_0 in h0. lra. }
  assert (rounds_ : forall z, 0 <= z <= 100 -> 0 <= Rd z <= (1 + e1) * z + l).
  { intros z zb. pose proof (error f ok env z) as E. rewrite (Rabs_pos_eq z) in E by lra. apply Rabs_le_inv in E.
    pose proof (rounded_positive f env z ltac:(lra)). lra. }
  pose proof (run (Minus one t)) as h1. cbn in h1. unfold sum in h1. rewrite time_ in h1. unfold one in h1.
    rewrite (constant (Small 1)) in h1. cbn in h1.
  rewrite (seen_1 f fine env) in h1. apply (result_number f ok env) in h1; [|rewrite Rabs_pos_eq; lra].
    pose proof (rounds_ (1 - T) ltac:(lra)) as r1.
  set (R1 := Rd (1 - T)) in *. fold one in h1. assert (e1 * (1 - T) <= / 8388608 * 1) by (apply Rmult_le_compat; lra).
  pose proof (positive_seen y ltac:(lra)) as sy. pose proof (positive_seen R1 ltac:(lra)) as s1.
  pose proof (run (Product part (Minus one t))) as h2. cbn -[one] in h2. rewrite Ey, h1 in h2. cbn in h2.
  assert (b2 : 0 <= seen y * seen R1 <= y * R1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (y * R1 <= 4 * 1.1) by (apply Rmult_le_compat; lra).
  apply (result_number f ok env) in h2; [|rewrite Rabs_pos_eq; lra]. pose proof (rounds_ _ ltac:(split;
    [apply b2|lra])) as r2.
  set (R2 := Rd (seen y * seen R1)) in *. pose proof (positive_seen R2 ltac:(lra)) as s2.
  destruct (here less_roundoffs_bounds 32 ltac:(lia)) as (c & Ec & c0 & c1).
    destruct (here less_roundoffs_bounds 8 ltac:(lia)) as (d & Ed & d0 & d1).
  assert (sc : seen c = c) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
    assert (sd : seen d = d) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
  pose proof (run (Product (Product part (Minus one t)) (less_roundoffs 32))) as h3. cbn -[one less_roundoffs] in h3.
    rewrite h2, Ec in h3. cbn in h3. rewrite sc in h3.
  assert (e1 * (seen y * seen R1) <= / 8388608 * 5) by (apply Rmult_le_compat; lra).
  assert (b3 : 0 <= seen R2 * c <= R2 * c) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
    assert (R2 * c <= 5 * 1) by (apply Rmult_le_compat; lra).
  apply (result_number f ok env) in h3; [|rewrite Rabs_pos_eq; lra]. pose proof (rounds_ _ ltac:(split;
    [apply b3|lra])) as r3.
  set (R3 := Rd (seen R2 * c)) in *. pose proof (positive_seen R3 ltac:(lra)) as s3.
    assert (e1 * (seen R2 * c) <= / 8388608 * 5) by (apply Rmult_le_compat; lra).
  pose proof (run (Sum t (Product (Product part (Minus one t)) (less_roundoffs 32)))) as h4.
    cbn -[one less_roundoffs] in h4. rewrite moment, h3 in h4. cbn in h4.
  apply (result_number f ok env) in h4; [|rewrite Rabs_pos_eq; lra]. pose proof (rounds_ (T + seen R3) ltac:(lra)) as
    r4.
  set (R4 := Rd (T + seen R3)) in *. pose proof (positive_seen R4 ltac:(lra)) as s4.
    assert (e1 * (T + seen R3) <= / 8388608 * 7) by (apply Rmult_le_compat; lra).
  pose proof (run (next_time t part)) as h5. unfold next_time in h5. cbn -[one less_roundoffs] in h5.
    rewrite h4, Ed in h5. cbn in h5. rewrite sd in h5.
  assert (b5 : 0 <= seen R4 * d <= R4 * d) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
    assert (R4 * d <= 8 * 1) by (apply Rmult_le_compat; lra).
  apply (result_number f ok env) in h5; [|rewrite Rabs_pos_eq; lra]. pose proof (rounds_ _ ltac:(split;
    [apply b5|lra])) as r5.
  exists (Rd (seen R4 * d)). split; [exact h5|]. set (N := Rd (seen R4 * d)) in *.
  (* How large the next time is. *)
  assert (y1 : 0 <= y * (1 - T) <= 4 * 1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (A : R2 <= (1 + e1) * ((1 + e1) * (y * (1 - T)) + 4 * l) + l).
  { assert (y * R1 <= y * ((1 + e1) * (1 - T) + l)) by (apply Rmult_le_compat_l; lra).
    assert (y * l <= 4 * l) by (apply Rmult_le_compat_r; lra).
    assert ((1 + e1) * (seen y * seen R1) <= (1 + e1) * ((1 + e1) * (y * (1 - T)) + 4 * l)) by (apply Rmult_le_compat_l;
      lra). lra. }
  set (Y := y * (1 - T)) in *. assert (el : 0 <= e1 * l <= 0.001 * l) by (split; [apply Rmult_le_pos;
    lra|apply Rmult_le_compat_r; lra]).
  assert (eY : 0 <= e1 * Y) by (apply Rmult_le_pos; lra). assert (eeY : 0 <= e1 * (e1 * Y) <= 0.001 * (e1 * Y)) by
    (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eel : 0 <= e1 * (e1 * l) <= 0.001 * l). { split; [apply Rmult_le_pos; lra|].
    assert (e1 * (e1 * l) <= 1 * (e1 * l)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (B : R3 <= kappa * Y + 7 * l).
  { assert (cc : R2 * c <= ((1 + e1) * ((1 + e1) * Y + 4 * l) + l) * (1 - 14.8 * e1)) by (apply Rmult_le_compat; lra).
    assert (C : (1 + e1) * (seen R2 * c) <= (1 + e1) * (((1 + e1) * ((1 + e1) * Y + 4 * l) + l) * (1 - 14.8 * e1))) by
      (apply Rmult_le_compat_l; lra).
    assert (F : (1 + e1) * ((1 + e1) * (1 + e1)) * (1 - 14.8 * e1) <= 1 - 11.5 * e1).
    { assert (0 <= e1 * e1 <= 0.001 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
      assert (0 <= e1 * (e1 * e1) <= 0.001 * (e1 * e1)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
        lra]).
      assert (0 <= e1 * (e1 * (e1 * e1))) by (apply Rmult_le_pos; lra). lra. }
    apply (Rmult_le_compat_r Y) in F; [|lra].
    assert (Gl : (1 + e1) * ((1 + e1) * (4 * l) + l) * (1 - 14.8 * e1) <= 5.1 * l).
    { assert ((1 + e1) * ((1 + e1) * (4 * l) + l) * (1 - 14.8 * e1) <= (1 + e1) * ((1 + e1) * (4 * l) + l) * 1) by
      (apply Rmult_le_compat_l; lra). lra. }
    unfold Clipping.kappa. lra. }
  assert (k1 : 0 <= kappa <= 1) by (unfold Clipping.kappa; lra).
  assert (kY : 0 <= kappa * Y <= Y) by (split; [apply Rmult_le_pos; lra|rewrite <- (Rmult_1_l Y) at 2;
    apply Rmult_le_compat_r; lra]).
  assert (D : N <= (1 - 0.7 * e1) * (T + kappa * Y) + 10 * l).
  { assert (R4' : R4 <= (1 + e1) * (T + (kappa * Y + 7 * l)) + l).
    { assert ((1 + e1) * (T + seen R3) <= (1 + e1) * (T + (kappa * Y + 7 * l))) by (apply Rmult_le_compat_l; lra). lra.
      }
    assert (dd : R4 * d <= ((1 + e1) * (T + (kappa * Y + 7 * l)) + l) * (1 - 2.8 * e1)) by (apply Rmult_le_compat; lra).
    assert (C : (1 + e1) * (seen R4 * d) <= (1 + e1) * (((1 + e1) * (T + (kappa * Y + 7 * l)) + l) * (1 - 2.8 * e1))) by
      (apply Rmult_le_compat_l; lra).
    assert (F : (1 + e1) * (1 + e1) * (1 - 2.8 * e1) <= 1 - 0.7 * e1).
    { assert (0 <= e1 * e1 <= 0.001 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
      assert (0 <= e1 * (e1 * e1)) by (apply Rmult_le_pos; lra). lra. }
    apply (Rmult_le_compat_r (T + kappa * Y)) in F; [|lra].
    assert (Gl : (1 + e1) * ((1 + e1) * (7 * l) + l) * (1 - 2.8 * e1) <= 8.1 * l).
    { assert ((1 + e1) * ((1 + e1) * (7 * l) + l) * (1 - 2.8 * e1) <= (1 + e1) * ((1 + e1) * (7 * l) + l) * 1) by (apply
      Rmult_le_compat_l; lra). lra. }
    lra. }
  intros t' between t1. destruct (Req_dec T 1) as [T1|T1].
  - exists 0. split; [lra|]. split; [lra|]. assert (0 <= kappa * y) by (apply Rmult_le_pos; lra). lra.
  - assert (T2 : 0 < 1 - T) by lra. exists ((t' - T) / (1 - T)).
    assert (sb : 0 <= (t' - T) / (1 - T) <= 1).
    { split; [apply Rle_mult_inv_pos; lra|]. apply Rmult_le_reg_r with (1 - T); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l; lra. }
    split; [exact sb|]. split; [field; lra|]. apply Rmult_le_reg_r with (1 - T); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    replace ((kappa * y + 24 * l) * (1 - T)) with (kappa * Y + 24 * l * (1 - T)) by (unfold Y; ring).
    assert (0 <= e1 * T) by (apply Rmult_le_pos; lra). assert (0 <= e1 * (kappa * Y)) by (apply Rmult_le_pos; lra).
    assert (0 <= l * (1 - T)) by (apply Rmult_le_pos; lra).
    destruct (Rle_lt_dec T (1 / 2)).
    + assert (l * (1 / 2) <= l * (1 - T)) by (apply Rmult_le_compat_l; lra). lra.
    + assert (e1 * (1 / 2) <= e1 * T) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* The exact volume of the first three corners at a time. *)
Definition exact_volume p b c t' := sum3 (fun a => exactly_at given p a t' *
  cross_at (fun a => exactly_at given b a t') (fun a => exactly_at given c a t') a).
Lemma volume_is_cubic p b c t' : exact_volume p b c t' =
  Certificates.blossom (outer_at given p b c Expressions.Start) (inner_at given p b c Expressions.Start) (inner_at given
    p b c Expressions.End)
    (outer_at given p b c Expressions.End) t' t' t'.
Proof. unfold exact_volume, Certificates.blossom, outer_at, inner_at, sum3, cross_at, exactly_at. field. Qed.
(* From T to the end, the cubic has these control values. *)
Lemma cubic_from K0 K1 K2 K3 s : let '(X0, X1, X2, X3) := exact_from T K0 K1 K2 K3 in let t' := (1 - s) * T + s * 1 in
  Certificates.blossom K0 K1 K2 K3 t' t' t' = cubic X0 X1 X2 X3 s.
Proof. unfold exact_from, between_at, Certificates.blossom, cubic. ring. Qed.
Lemma cubic_monotone a0 a1 a2 a3 c0 c1 c2 c3 s : 0 <= s <= 1 -> a0 <= c0 -> a1 <= c1 -> a2 <= c2 -> a3 <= c3 -> cubic a0
  a1 a2 a3 s <= cubic c0 c1 c2 c3 s.
Proof.
  intros s01 h0 h1 h2 h3. unfold cubic. assert (p0 : 0 <= (1 - s) ^ 3) by (apply pow_le; lra).
    assert (p3 : 0 <= s ^ 3) by (apply pow_le; lra).
  assert (p1 : 0 <= (1 - s) ^ 2 * s) by (apply Rmult_le_pos; [apply pow_le|]; lra).
    assert (p2 : 0 <= (1 - s) * s ^ 2) by (apply Rmult_le_pos; [|apply pow_le]; lra).
  assert (a0 * (1 - s) ^ 3 <= c0 * (1 - s) ^ 3) by (apply Rmult_le_compat_r; lra).
    assert (a3 * s ^ 3 <= c3 * s ^ 3) by (apply Rmult_le_compat_r; lra).
  assert (a1 * ((1 - s) ^ 2 * s) <= c1 * ((1 - s) ^ 2 * s)) by (apply Rmult_le_compat_r; lra).
  assert (a2 * ((1 - s) * s ^ 2) <= c2 * ((1 - s) * s ^ 2)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma cubic_scaled x a0 a1 a2 a3 s : cubic (x * a0) (x * a1) (x * a2) (x * a3) s = x * cubic a0 a1 a2 a3 s.
Proof. unfold cubic. ring. Qed.

(* Margins that are below the control values Y of a cubic by a reserve r: where they prove something, it is positive. *)
Section Margins.
Variables w r : R.
Hypothesis w_small : 0 <= w <= 10 * (G * G * G).
Hypothesis reserve_ : 0 < r /\ 4 * slack_ f w < r /\ ahead_error f w + 200 * (l * w) <= r.
Variables g0 g1 g2 g3 : number.
Variables x0 x1 x2 x3 Y0 Y1 Y2 Y3 : R.
Hypothesis c0 : control f env value_of w g0 x0.
Hypothesis c1 : control f env value_of w g1 x1.
Hypothesis c2 : control f env value_of w g2 x2.
Hypothesis c3 : control f env value_of w g3 x3.
Hypothesis below : seen x0 + r <= Y0 /\ seen x1 + r <= Y1 /\ seen x2 + r <= Y2 /\ seen x3 + r <= Y3.
Notation is_positive_at t' := (exists q_, 0 <= q_ <= 1 /\ t' = (1 - q_) * T + q_ * 1 /\ 0 < cubic Y0 Y1 Y2 Y3 q_).
Theorem positive_to_the_end : says f env value_of (all_positive (g0, g1, g2, g3)) -> forall t', T <= t' <= 1 ->
  is_positive_at t'.
Proof.
  intros [[[p0 p1] p2] p3] t' between. destruct reserve_ as (r0 & _). destruct below as (h0 & h1 & h2 & h3).
  apply (positive_says f env given value_of run w g0 x0 c0) in p0. apply (positive_says f env given value_of run w g1 x1
    c1) in p1.
  apply (positive_says f env given value_of run w g2 x2 c2) in p2. apply (positive_says f env given value_of run w g3 x3
    c3) in p3.
  assert (part : exists q_, 0 <= q_ <= 1 /\ t' = (1 - q_) * T + q_ * 1).
  { destruct (Req_dec T 1); [exists 0; lra|]. exists ((t' - T) / (1 - T)). split; [|field; lra]. split.
    - apply Rle_mult_inv_pos; lra.
    - apply Rmult_le_reg_r with (1 - T); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra. }
  destruct part as (q_ & q01 & E). exists q_. split; [exact q01|]. split; [exact E|].
  pose proof (Geometry.hull Y0 (3 * Y1) (3 * Y2) Y3 q_ ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) q01) as pos.
  unfold cubic. lra.
Qed.
Theorem positive_until u : value_of (clipped_until t (g0, g1, g2, g3)) = Number u -> tau < u -> forall t',
  T <= t' <= u -> t' <= 1 -> is_positive_at t'.
Proof.
  intros Eu later t' between t1. destruct reserve_ as (r0 & re). destruct below as (h0 & h1 & h2 & h3).
  unfold clipped_until in Eu. set (part := looking_ahead g0 g1 g2 g3 (first_zero g0 g1 g2 g3)) in *. cbv zeta in Eu.
  pose proof (run (Select (Both (is_positive g0) (Greater (next_time t part) t)) (next_time t part) t)) as h.
    cbn -[says is_positive next_time] in h.
  destruct h as [[[p0 _] h]|[_ h]].
  2: { rewrite Eu, moment in h. injection h as ->. lra. }
  apply (positive_says f env given value_of run w g0 x0 c0) in p0.
  destruct (here looking_ahead_value w w_small g0 g1 g2 g3 x0 x1 x2 x3 c0 c1 c2 c3 p0 r re) as
    (y & Ey & yb & positive).
  destruct (next_time_value part y Ey yb) as (N & EN & times). rewrite Eu, EN in h. injection h as ->.
  destruct (times t' between t1) as (q_ & q01 & E & qy). exists q_. split; [exact q01|]. split; [exact E|].
  pose proof (positive q_ q01 qy) as pos. pose proof (cubic_monotone _ _ _ _ _ _ _ _ q_ q01 h0 h1 h2 h3). lra.
Qed.
End Margins.

Variables p b c : nat * nat.
Variable others : list (nat * nat).
Notation pairs := (p :: b :: c :: others).
Hypothesis in_range : says f env value_of (are_in_range pairs).
Notation w := (width f env value_of pairs).
Notation r := (reserve f env value_of pairs).
Notation X := (exact_from T (outer_at given p b c Expressions.Start) (inner_at given p b c Expressions.Start) (inner_at
  given p b c Expressions.End)
    (outer_at given p b c Expressions.End)).
(* The four margins: numbers below the exact control values, which have a common sign, by a reserve. *)
Theorem margins_values : let '(g0, g1, g2, g3) := margins pairs t in let '(X0, X1, X2,
  X3) := X in exists s x0 x1 x2 x3, (s = 1 \/ s = -1) /\
  control f env value_of w g0 x0 /\ control f env value_of w g1 x1 /\ control f env value_of w g2 x2 /\
    control f env value_of w g3 x3 /\
  seen x0 + r <= s * X0 /\ seen x1 + r <= s * X1 /\ seen x2 + r <= s * X2 /\ seen x3 + r <= s * X3.
Proof.
  assert (inside : In p pairs /\ In b pairs /\ In c pairs) by (cbn; tauto).
  pose proof (here outer_holds pairs in_range p b c inside) as oh.
    pose proof (here inner_holds pairs in_range p b c inside) as ih.
  pose proof (here values_hold pairs in_range p b c inside t T time_ in_step _ _ _ _ _ _ _ _
    (conj (oh Expressions.Start) (conj (ih Expressions.Start) (conj (ih Expressions.End) (oh Expressions.End))))) as vh.
  unfold margins. cbn [corners_of]. destruct (values_from _ _ _ _ _) as [[[b0 b1] b2] b3].
    destruct X as [[[X0 X1] X2] X3]. destruct vh as (h0 & h1 & h2 & h3).
  assert (sign : exists s, (s = 1 \/ s = -1) /\ sign_of f env value_of b0 s).
  { destruct h0 as (y & Ey & _). unfold sign_of. cbn. rewrite (constant (Small 0)), Ey. cbn.
    destruct (Rlt_dec (seen y) (seen 0)); [exists (-1)|exists 1]; tauto. }
  destruct sign as (s & s1 & sign). pose proof (here margin_facts pairs in_range b0) as mf.
  destruct (mf b0 s X0 sign h0) as (x0 & A0). destruct (mf b1 s X1 sign h1) as (x1 & A1).
    destruct (mf b2 s X2 sign h2) as (x2 & A2). destruct (mf b3 s X3 sign h3) as (x3 & A3).
  exists s, x0, x1, x2, x3. unfold control. tauto.
Qed.
Lemma reserve_positive : 0 < r /\ 0 <= w <= 10 * (G * G * G) /\ 4 * slack_ f w < r /\
  ahead_error f w + 200 * (l * w) <= r.
Proof.
  pose proof (here volume_bounds pairs in_range) as (_ & P & _).
    pose proof (here QQ pairs in_range) as (Q1 & Q2 & _).
  pose proof (G_bounds f fine) as (G4 & G2 & G3 & _). pose proof (l_pos f). pose proof (l_small f ok).
    pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_e f fine).
  pose proof (eta_large f fine) as el. pose proof (eta_1 f fine) as e1_. unfold reserve, width, slack_, ahead_error.
  set (P_ := permanent f env value_of pairs) in *. set (QQ_ := more f env value_of pairs * more f env value_of pairs) in
    *. set (eta := power (underflow f)) in *.
  assert (N : eta <= eta * QQ_ <= QQ_). { split; [rewrite <- (Rmult_1_r eta) at 1; apply Rmult_le_compat_l;
    lra|rewrite <- (Rmult_1_l QQ_) at 2; apply Rmult_le_compat_r; lra]. }
  set (N_ := eta * QQ_) in *.
  assert (eP : 0 <= e1 * P_) by (apply Rmult_le_pos; lra). assert (eN : 0 <= e1 * N_ <= 0.000001 * N_) by (split;
    [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lP : 0 <= l * P_ <= / 1099511627776 * (e1 * P_)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * P_)) with (/ 1099511627776 * e1 * P_) by ring. apply Rmult_le_compat_r; lra. }
  assert (lN : 0 <= l * N_ <= 0.000001 * N_) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  repeat split; lra.
Qed.

(* Where the margins prove something, the volume is not zero. *)
Lemma positive_is_not_zero s X0 X1 X2 X3 q_ : 0 < cubic (s * X0) (s * X1) (s * X2) (s * X3) q_ -> cubic X0 X1 X2 X3 q_ <>
  0.
Proof. rewrite cubic_scaled. intros pos zero. rewrite zero in pos. lra. Qed.
Theorem positive_margins : says f env value_of (volume_to_the_end pairs t) -> forall t',
  T <= t' <= 1 -> exact_volume p b c t' <> 0.
Proof.
  intros all t' between. pose proof margins_values as mv. unfold volume_to_the_end in all.
    destruct (margins pairs t) as [[[g0 g1] g2] g3].
  pose proof (cubic_from (outer_at given p b c Expressions.Start) (inner_at given p b c Expressions.Start) (inner_at
    given p b c Expressions.End)
    (outer_at given p b c Expressions.End)) as cf.
  destruct X as [[[X0 X1] X2] X3]. destruct mv as (s & x0 & x1 & x2 & x3 & s1 & c0 & c1 & c2 & c3 & below).
  pose proof reserve_positive as (r0 & w0 & re).
  destruct (positive_to_the_end w r (conj r0 re) g0 g1 g2 g3 x0 x1 x2 x3 _ _ _ _ c0 c1 c2 c3 below all t' between) as
    (q_ & q01 & -> & pos). rewrite volume_is_cubic, (cf q_). exact (positive_is_not_zero _ _ _ _ _ _ pos).
Qed.
(* Nor is it up to the time that clipping gives. *)
Theorem clipped_volume u : value_of (volume_until pairs t) = Number u -> tau < u -> forall t',
  T <= t' <= u -> t' <= 1 -> exact_volume p b c t' <> 0.
Proof.
  intros Eu later t' between t1. pose proof margins_values as mv. unfold volume_until in Eu.
    destruct (margins pairs t) as [[[g0 g1] g2] g3].
  pose proof (cubic_from (outer_at given p b c Expressions.Start) (inner_at given p b c Expressions.Start) (inner_at
    given p b c Expressions.End)
    (outer_at given p b c Expressions.End)) as cf.
  destruct X as [[[X0 X1] X2] X3]. destruct mv as (s & x0 & x1 & x2 & x3 & s1 & c0 & c1 & c2 & c3 & below).
  pose proof reserve_positive as (r0 & w0 & re).
  destruct (positive_until w r w0 (conj r0 re) g0 g1 g2 g3 x0 x1 x2 x3 _ _ _ _ c0 c1 c2 c3 below u Eu later t' between
    t1) as (q_ & q01 & -> & pos). rewrite volume_is_cubic, (cf q_). exact (positive_is_not_zero _ _ _ _ _ _ pos).
Qed.
End VolumeSteps.
