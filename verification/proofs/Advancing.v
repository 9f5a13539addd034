(* One step of the time of impact keeps the pair apart from its moment to the time that it gives; and so does a chain of
   steps. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Geometry Machine Nearness Corners Directions Held VolumeSteps.
From Selvedge Require Expressions Errors Bounds Volume Apart Advance.
Import ListNotations.
Open Scope R_scope.

(* The code's masks: a direction that turns from 0 to 1, or moves on the curve 0, 1, 2, between the moments 0 and 1. *)
Definition everywhere := Greater one (Constant (Small 0)).
Definition turning_mask pairs := fold_left (fun m pair => Both (Both (Both m (is_ahead 0 (bar pairs 0) 0 pair))
  (is_ahead 1 (bar pairs 1) 1 pair))
  (Greater (middle 0 1 1 0 pair) (Sum (bar pairs 0) (bar pairs 1)))) pairs everywhere.
Definition curving_mask pairs := fold_left (fun m pair => Both (Both (Both (Both m (is_ahead 0 (bar pairs 0) 0 pair))
  (is_ahead 2 (bar pairs 2) 1 pair))
  (Greater (middle 0 1 1 0 pair) (Sum (bar pairs 0) (bar pairs 1)))) (Greater (middle 1 1 2 0 pair) (Sum (bar pairs 1)
    (bar pairs 2)))) pairs everywhere.
Definition held_until_the_end pairs := held_until 0 (bar pairs 0) pairs (Constant (Small 2)).
Definition held_for_the_pair pairs := held_mask 0 (bar pairs 0) 0 pairs (are_in_range pairs).

Module VF := Advance.a_vertex_and_a_face.
Module EE := Advance.two_edges.
(* The traced terms are these. The margins of the volume have names, which the terms after them have not to unfold. *)
Lemma margins_of_a_vertex_and_a_face :
  (VF.margin_0, VF.margin_1, VF.margin_2, VF.margin_3) = margins vertex_face (Input (Moment 0)).
Proof. vm_compute. reflexivity. Qed.
Opaque VF.margin_0 VF.margin_1 VF.margin_2 VF.margin_3.
Theorem traced_terms_of_a_vertex_and_a_face : VF.in_range = are_in_range vertex_face /\
  VF.held = held_for_the_pair vertex_face /\ VF.until_held = held_until_the_end vertex_face /\
  VF.turning = turning_mask vertex_face /\ VF.curving = curving_mask vertex_face /\
  VF.volume_throughout = volume_throughout vertex_face /\
  VF.volume_to_the_end = volume_to_the_end vertex_face (Input (Moment 0)) /\
  VF.until_volume = volume_until vertex_face (Input (Moment 0)).
Proof.
  pose proof margins_of_a_vertex_and_a_face as same. unfold volume_to_the_end, volume_until. rewrite <- same.
  do 6 (split; [vm_compute; reflexivity|]). split; lazy; reflexivity.
Qed.
Lemma margins_of_two_edges :
  (EE.margin_0, EE.margin_1, EE.margin_2, EE.margin_3) = margins edge_edge (Input (Moment 0)).
Proof. vm_compute. reflexivity. Qed.
Opaque EE.margin_0 EE.margin_1 EE.margin_2 EE.margin_3.
Theorem traced_terms_of_two_edges : EE.in_range = are_in_range edge_edge /\
  EE.held = held_for_the_pair edge_edge /\ EE.until_held = held_until_the_end edge_edge /\
  EE.turning = turning_mask edge_edge /\ EE.curving = curving_mask edge_edge /\
  EE.volume_throughout = volume_throughout edge_edge /\
  EE.volume_to_the_end = volume_to_the_end edge_edge (Input (Moment 0)) /\
  EE.until_volume = volume_until edge_edge (Input (Moment 0)).
Proof.
  pose proof margins_of_two_edges as same. unfold volume_to_the_end, volume_until. rewrite <- same.
  do 6 (split; [vm_compute; reflexivity|]). split; lazy; reflexivity.
Qed.

(* Some direction is ahead of all corners at a time. *)
Definition ahead pairs given t := exists w : Expressions.axis -> R, forall pair,
  In pair pairs -> 0 < sum3 (fun a => w a * exactly_at given pair a t).
Section Step.
Load "Setting.section".
Load "InRange.section".
Notation T n := (seen (given (Moment n))).
Notation is_short := (is_short f env given).
Notation exact_product := (exact_product f env given).
Notation along := (along f env given).

Lemma bar_of k : is_short k -> is_bar f env given value_of pairs k (bar pairs k) 0.
Proof.
  intro short. destruct (within bar_is_large k short) as (B & E & rep & big &
    small).
  pose proof (G_4 f fine). assert (0 <= Errors.reach f * Errors.reach f) by (apply Rmult_le_pos; lra).
  pose proof (within size_bounds k short) as (_ & _ & e0). pose proof (l_pos f).
  exists B. split; [exact E|]. split; [exact rep|]. lra.
Qed.
Theorem held_is_ahead u : is_short 0 -> 0 <= T 0 <= 1 -> says f env value_of (held_for_the_pair pairs) ->
  value_of (held_until_the_end pairs) = Number u -> forall t, T 0 <= t <= 1 -> t <= u -> ahead pairs given t.
Proof.
  intros short time masks E t between tu.
  assert (two : value_of (Constant (Small 2)) = Number 2) by exact (run (Constant (Small 2))).
  assert (s2 : seen 2 = 2). { apply seen_of_normal. rewrite Rabs_pos_eq by lra. pose proof (l_small f ok). lra. }
  destruct (within held_corners 0 (bar pairs 0) 0 0 _ _ 2 short time (bar_of 0
    short) masks two ltac:(lra) s2)
    as (u' & E' & _ & _ & all). unfold held_until_the_end in E. rewrite E' in E. injection E as ->.
  exists (along 0). intros pair inside. apply (all pair t inside between tu).
Qed.
(* A time between two moments is a part s of the way from one to the other. *)
Lemma between_moments t : T 0 < T 1 -> T 0 <= t <= T 1 -> exists s, 0 <= s <= 1 /\ t = (1 - s) * T 0 + s * T 1.
Proof.
  intros later between. exists ((t - T 0) / (T 1 - T 0)). split; [|field; lra]. split.
  - apply Rle_mult_inv_pos; lra.
  - apply Rmult_le_reg_r with (T 1 - T 0); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.
Theorem turning_is_ahead : is_short 0 -> is_short 1 -> 0 <= T 0 -> T 0 < T 1 -> T 1 <= 1 -> says f env value_of
  (turning_mask pairs) ->
  forall t, T 0 <= t <= T 1 -> ahead pairs given t.
Proof.
  intros short0 short1 t0 later t1 masks t between. destruct (between_moments t later between) as (s & s01 & ->).
  destruct (fold_of_masks f env value_of (fun pair m => Both (Both (Both m (is_ahead 0 (bar pairs 0) 0 pair)) (is_ahead
    1 (bar pairs 1) 1 pair))
    (Greater (middle 0 1 1 0 pair) (Sum (bar pairs 0) (bar pairs 1))))
    (fun pair => says f env value_of (is_ahead 0 (bar pairs 0) 0 pair) /\ says f env value_of (is_ahead 1 (bar pairs 1)
      1 pair) /\
      greater f env (value_of (middle 0 1 1 0 pair)) (value_of (Sum (bar pairs 0) (bar pairs 1))))
    ltac:(cbn -[is_ahead middle bar]; tauto) pairs _ masks) as [_ all].
  exists (fun a => (1 - s) * along 0 a + s * along 1 a). intros pair inside. destruct (all pair inside) as (A & C & B).
  apply (within ahead_at 0 _ 0 pair 0 inside short0 ltac:(lra) (bar_of 0 short0))
    in A.
  apply (within ahead_at 1 _ 1 pair 0 inside short1 ltac:(lra) (bar_of 1 short1))
    in C.
  apply (within middle_coefficient 0 _ 0 1 1 _ 0 0 pair inside short0 short1
    ltac:(lra) ltac:(lra)
    (bar_of 0 short0) (bar_of 1 short1)) in B.
  replace (sum3 _) with ((1 - s) ^ 2 * exact_product 0 pair (T 0) + (1 - s) * s * (exact_product 0 pair (T 1) +
    exact_product 1 pair (T 0))
    + s ^ 2 * exact_product 1 pair (T 1)).
  2: { unfold Directions.exact_product, sum3, exactly_at. ring. }
  assert (0 <= (1 - s) * s) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - s) * s * (exact_product 0 pair (T 1) + exact_product 1 pair (T 0))) by (apply Rmult_le_pos; lra).
  destruct (Rle_lt_dec s (1 / 2)).
  - assert (0 < (1 - s) ^ 2 * exact_product 0 pair (T 0)) by (apply Rmult_lt_0_compat; [apply pow_lt; lra|lra]).
    assert (0 <= s ^ 2 * exact_product 1 pair (T 1)) by (apply Rmult_le_pos; [apply pow_le; lra|lra]). lra.
  - assert (0 <= (1 - s) ^ 2 * exact_product 0 pair (T 0)) by (apply Rmult_le_pos; [apply pow_le; lra|lra]).
    assert (0 < s ^ 2 * exact_product 1 pair (T 1)) by (apply Rmult_lt_0_compat; [apply pow_lt; lra|lra]). lra.
Qed.
Theorem curving_is_ahead : is_short 0 -> is_short 1 -> is_short 2 -> 0 <= T 0 -> T 0 < T 1 -> T 1 <= 1 -> says f env
  value_of (curving_mask pairs) ->
  forall t, T 0 <= t <= T 1 -> ahead pairs given t.
Proof.
  intros short0 short1 short2 t0 later t1 masks t between. destruct (between_moments t later between) as (s & s01 & ->).
  destruct (fold_of_masks f env value_of (fun pair m => Both (Both (Both (Both m (is_ahead 0 (bar pairs 0) 0 pair))
    (is_ahead 2 (bar pairs 2) 1 pair))
    (Greater (middle 0 1 1 0 pair) (Sum (bar pairs 0) (bar pairs 1)))) (Greater (middle 1 1 2 0 pair) (Sum (bar pairs 1)
      (bar pairs 2))))
    (fun pair => says f env value_of (is_ahead 0 (bar pairs 0) 0 pair) /\ says f env value_of (is_ahead 2 (bar pairs 2)
      1 pair) /\
      greater f env (value_of (middle 0 1 1 0 pair)) (value_of (Sum (bar pairs 0) (bar pairs 1))) /\
      greater f env (value_of (middle 1 1 2 0 pair)) (value_of (Sum (bar pairs 1) (bar pairs 2))))
    ltac:(cbn -[is_ahead middle bar]; tauto) pairs _ masks) as [_ all].
  exists (fun a => (1 - s) ^ 2 * along 0 a + (1 - s) * s * along 1 a + s ^ 2 * along 2 a). intros pair inside.
  destruct (all pair inside) as (A & D & B & C).
  apply (within ahead_at 0 _ 0 pair 0 inside short0 ltac:(lra) (bar_of 0 short0))
    in A.
  apply (within ahead_at 2 _ 1 pair 0 inside short2 ltac:(lra) (bar_of 2 short2))
    in D.
  apply (within middle_coefficient 0 _ 0 1 1 _ 0 0 pair inside short0 short1
    ltac:(lra) ltac:(lra)
    (bar_of 0 short0) (bar_of 1 short1)) in B.
  apply (within middle_coefficient 1 _ 0 1 2 _ 0 0 pair inside short1 short2
    ltac:(lra) ltac:(lra)
    (bar_of 1 short1) (bar_of 2 short2)) in C.
  replace (sum3 _) with (exact_product 0 pair (T 0) * (1 - s) ^ 3 + (exact_product 0 pair (T 1) + exact_product 1 pair
    (T 0)) * (1 - s) ^ 2 * s
    + (exact_product 1 pair (T 1) + exact_product 2 pair (T 0)) * (1 - s) * s ^ 2 + exact_product 2 pair (T 1) * s ^ 3).
  2: { unfold Directions.exact_product, sum3, exactly_at. ring. }
  apply hull; lra.
Qed.
End Step.

(* Geometry: what a direction is ahead of does not touch. *)
Section OfAPair.
Variable place : Expressions.coordinate -> R.
Definition of_place given := forall c, given (Place c) = place c.
Definition touch_vertex_and_face t := vertex_in_triangle (at_ (Apart.path_of place 0) t) (at_ (Apart.path_of place 1) t)
  (at_ (Apart.path_of place 2) t) (at_ (Apart.path_of place 3) t).
Definition touch_edges t := segments_meet (at_ (Apart.path_of place 0) t) (at_ (Apart.path_of place 1) t)
  (at_ (Apart.path_of place 2) t) (at_ (Apart.path_of place 3) t).
Lemma ahead_of_a_corner given w n k t : of_place given -> 0 < sum3 (fun a => w a * exactly_at given (n, k) a t) ->
  0 < dot (Point (w Expressions.X) (w Expressions.Y) (w Expressions.Z_)) (minus (at_ (Apart.path_of place n) t) (at_
    (Apart.path_of place k) t)).
Proof.
  intros same h. replace (dot _ _) with (sum3 (fun a => w a * exactly_at given (n, k) a t)); [exact h|].
  unfold sum3, exactly_at, exactly, exact_difference, dot, minus, at_, plus, scaled; cbn. rewrite !same. ring.
Qed.
Theorem ahead_excludes_contact_of_a_vertex_and_a_face given t : of_place given -> ahead vertex_face given t -> ~
  touch_vertex_and_face t.
Proof.
  intros same (w & all). apply (Apart.ahead_of_a_triangle (Point (w Expressions.X) (w Expressions.Y) (w
    Expressions.Z_)));
    apply (ahead_of_a_corner given); auto; apply all; cbn; tauto.
Qed.
Theorem ahead_excludes_contact_of_two_edges given t : of_place given -> ahead edge_edge given t -> ~ touch_edges t.
Proof.
  intros same (w & all). apply (Apart.ahead_of_a_segment (Point (w Expressions.X) (w Expressions.Y) (w
    Expressions.Z_)));
    apply (ahead_of_a_corner given); auto; apply all; cbn; tauto.
Qed.
(* Points that are not coplanar do not touch. *)
Definition volume_of pairs given t := let '(p, b, c) := corners_of pairs in exact_volume given p b c t.
Theorem volume_excludes_contact_of_a_vertex_and_a_face given t : of_place given -> volume_of vertex_face given t <> 0 ->
  ~ touch_vertex_and_face t.
Proof.
  intros same nonzero contact. apply nonzero. apply vertex_in_triangle_is_flat in contact. rewrite <- contact.
  unfold volume_of, corners_of, vertex_face, exact_volume, Volume.cross_at, sum3, exactly_at, exactly,
    exact_difference, volume, dot, cross, minus, at_, plus, scaled;
    cbn. rewrite !same. ring.
Qed.
Theorem volume_excludes_contact_of_two_edges given t : of_place given -> volume_of edge_edge given t <> 0 -> ~
  touch_edges t.
Proof.
  intros same nonzero contact. apply nonzero. apply segments_that_meet_are_flat in contact.
  assert (E : volume_of edge_edge given t = volume (at_ (Apart.path_of place 2) t) (at_ (Apart.path_of place 0) t) (at_
    (Apart.path_of place 1) t) (at_ (Apart.path_of place 3) t)).
  { unfold volume_of, corners_of, edge_edge, exact_volume, Volume.cross_at, sum3, exactly_at, exactly,
    exact_difference, volume, dot, cross, minus, at_, plus, scaled;
    cbn. rewrite !same. ring. }
  rewrite E. exact contact.
Qed.
End OfAPair.

(* The proofs of one round that the code has, for one kind of pairs. *)
Record proofs := Proofs { is_in_range : mask; by_held : mask; until_held : number; by_turning : mask; by_curving : mask;
  by_volume_throughout : mask; by_volume_to_the_end : mask; until_volume : number }.
Definition for_corners pairs := Proofs (are_in_range pairs) (held_for_the_pair pairs) (held_until_the_end pairs)
  (turning_mask pairs)
  (curving_mask pairs) (volume_throughout pairs) (volume_to_the_end pairs (Input (Moment 0))) (volume_until pairs (Input
    (Moment 0))).
Definition of_a_vertex_and_a_face := Proofs VF.in_range VF.held VF.until_held VF.turning VF.curving VF.volume_throughout
  VF.volume_to_the_end
  VF.until_volume.
Definition of_two_edges := Proofs EE.in_range EE.held EE.until_held EE.turning EE.curving EE.volume_throughout
  EE.volume_to_the_end
  EE.until_volume.
Lemma vertex_and_face_corners : of_a_vertex_and_a_face = for_corners vertex_face.
Proof.
  destruct traced_terms_of_a_vertex_and_a_face as (a & b & c & d & e & g & h & i). unfold of_a_vertex_and_a_face.
    now rewrite a, b, c, d, e, g, h, i.
Qed.
Lemma two_edges_corners : of_two_edges = for_corners edge_edge.
Proof. destruct traced_terms_of_two_edges as (a & b & c & d & e & g & h & i). unfold of_two_edges.
  now rewrite a, b, c, d, e, g, h, i. Qed.

(* One step, from a time to another. `given` are the pair's coordinates and any moments and directions, and `value_of`
   what the code computes from them in an environment. Directions are no longer than 2^32 (binary64: 2^252) along an
   axis. *)
Definition is_direction (f : constants) given k := forall a, Rabs (given (Along k a)) <= Errors.reach f.
Definition is_moment given n := 0 <= given (Moment n) <= 1.
Definition computed (f : constants) (env : environment f) place given value_of code := of_place place given /\
  execution f env value_of given /\
  says f env value_of (is_in_range code).
Inductive step (code : proofs) (place : Expressions.coordinate -> R) (f : constants) (env : environment f) : R -> R ->
  Prop :=
| Held given value_of u : computed f env place given value_of code -> is_direction f given 0 -> is_moment given 0 ->
    says f env value_of (by_held code) -> value_of (until_held code) = Number u -> step code place f env (given (Moment
      0)) u
| Turning given value_of : computed f env place given value_of code -> is_direction f given 0 -> is_direction f given 1
  ->
    is_moment given 0 -> is_moment given 1 -> says f env value_of (Greater (Input (Moment 1)) (Input (Moment 0))) ->
    says f env value_of (by_turning code) -> step code place f env (given (Moment 0)) (given (Moment 1))
| Curving given value_of : computed f env place given value_of code -> is_direction f given 0 -> is_direction f given 1
  ->
    is_direction f given 2 -> is_moment given 0 -> is_moment given 1 -> says f env value_of (Greater (Input (Moment 1))
      (Input (Moment 0))) ->
    says f env value_of (by_curving code) -> step code place f env (given (Moment 0)) (given (Moment 1))
| VolumeThroughout given value_of from : computed f env place given value_of code -> 0 <= from ->
    says f env value_of (by_volume_throughout code) -> step code place f env from 1
| VolumeToTheEnd given value_of : computed f env place given value_of code -> is_moment given 0 ->
    says f env value_of (by_volume_to_the_end code) -> step code place f env (given (Moment 0)) 1
| VolumeUntil given value_of u : computed f env place given value_of code -> is_moment given 0 -> given (Moment 0) < u
  ->
    value_of (until_volume code) = Number u -> step code place f env (given (Moment 0)) u.
(* The loop: from `begin`, rounds of one step each, in either format, whose times may be rounded down. *)
Inductive reaches code place (begin : R) : R -> Prop :=
| First (f : constants) env until : reasonable_constants f -> step code place f env begin until -> reaches code place
  begin until
| Next (f : constants) env from until : reasonable_constants f -> reaches code place begin from -> step code place f env
  from until ->
    reaches code place begin until
| RoundedDown from until : reaches code place begin from -> until <= from -> reaches code place begin until.

(* A direction is ahead of all corners, or the points are not coplanar. *)
Definition apart pairs place t := exists given, of_place place given /\ (ahead pairs given t \/ volume_of pairs given t
  <> 0).
Section Sound.
Variables p b c : nat * nat.
Variable others : list (nat * nat).
Notation pairs := (p :: b :: c :: others).
Variable place : Expressions.coordinate -> R.
Lemma seen_moment (f : constants) (env : environment f) given n : is_moment given n -> 0 <= seen f env (given (Moment
  n)) <= given (Moment n).
Proof.
  intros [t0 _]. pose proof (seen_smaller f env (given (Moment n))) as s. rewrite (Rabs_pos_eq _ t0) in s.
  pose proof (Rle_abs (seen f env (given (Moment n)))). pose proof (seen_monotone f env 0 _ t0) as m0.
    rewrite seen_0 in m0. lra.
Qed.
Lemma short_direction (f : constants) (env : environment f) given k : is_direction f given k -> Directions.is_short f
  env given k.
Proof. intros h a. unfold along. pose proof (seen_smaller f env (given (Along k a))). pose proof (h a). lra. Qed.
Theorem a_step_keeps_apart (f : constants) env from until : reasonable_constants f -> step (for_corners pairs) place f
  env from until ->
  forall t, from <= t <= until -> t <= 1 -> apart pairs place t.
Proof.
  intros fine [given value_of u (same & run & in_range) short time masks E|given value_of (same & run & in_range) short0
    short1 time0 time1 later masks
    |given value_of (same & run & in_range) short0 short1 short2 time0 time1 later masks|given value_of from' (same &
      run & in_range) from0 masks
    |given value_of (same & run & in_range) time masks|given value_of u (same & run & in_range) time later E] t between
      t1; exists given; (split; [exact same|]).
  - left. pose proof (seen_moment f env given 0 time). unfold is_moment in time.
    apply (held_is_ahead f fine env given value_of run pairs in_range u (short_direction f env given 0 short)); auto;
      lra.
  - left. pose proof (seen_moment f env given 0 time0). pose proof (seen_moment f env given 1 time1).
    unfold is_moment in *.
    cbn in later. rewrite (run (Input (Moment 0))), (run (Input (Moment 1))) in later. cbn in later.
    assert (s1 : seen f env (given (Moment 1)) = given (Moment 1)) by (apply seen_positive; lra).
    apply (turning_is_ahead f fine env given value_of run pairs in_range); auto using short_direction; lra.
  - left. pose proof (seen_moment f env given 0 time0). pose proof (seen_moment f env given 1 time1).
    unfold is_moment in *.
    cbn in later. rewrite (run (Input (Moment 0))), (run (Input (Moment 1))) in later. cbn in later.
    assert (s1 : seen f env (given (Moment 1)) = given (Moment 1)) by (apply seen_positive; lra).
    apply (curving_is_ahead f fine env given value_of run pairs in_range); auto using short_direction; lra.
  - right. apply (positive_margins f fine env given value_of run (Constant (Small 0)) 0 (run (Constant (Small 0)))
    ltac:(rewrite seen_0; lra) p b c others in_range masks).
    rewrite seen_0. lra.
  - right. pose proof (seen_moment f env given 0 time). unfold is_moment in time.
    apply (positive_margins f fine env given value_of run (Input (Moment 0)) (given (Moment 0)) (run (Input (Moment 0)))
      ltac:(lra) p b c others in_range masks). lra.
  - right. pose proof (seen_moment f env given 0 time). unfold is_moment in time.
    apply (clipped_volume f fine env given value_of run (Input (Moment 0)) (given (Moment 0)) (run (Input (Moment 0)))
      ltac:(lra) p b c others in_range u E later); lra.
Qed.
Theorem rounds_keep_apart begin until : reaches (for_corners pairs) place begin until ->
  forall t, begin <= t <= until -> t <= 1 -> apart pairs place t.
Proof.
  induction 1 as [f env until fine s|f env from until fine _ IH s|from until _ IH less]; intros t between t1.
  - exact (a_step_keeps_apart f env begin until fine s t between t1).
  - destruct (Rle_lt_dec t from); [apply IH; lra|]. apply (a_step_keeps_apart f env from until fine s t); lra.
  - apply IH; lra.
Qed.
End Sound.
