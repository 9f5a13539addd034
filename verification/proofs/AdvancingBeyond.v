(* The time of impact with a separation: each round keeps the pair farther apart than the separation
   from its moment to the time that it gives, and so does a chain of rounds. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Geometry Machine Nearness Corners Least Directions Held DirectionsBeyond.
From Selvedge Require Expressions Errors Bounds Apart Advancing AdvanceBeyond Certificates Volume VolumeSteps VolumeBeyond
  Separated.
Import ListNotations.
Open Scope R_scope.

(* The code's masks, with the bars of a separation. *)
Definition barred pairs := bar_beyond pairs.
Definition turning_mask pairs := let b := barred pairs in fold_left (fun m pair => Both (Both (Both m (is_ahead 0 (b
  0%nat)
  0 pair)) (is_ahead 1 (b 1%nat) 1 pair)) (Greater (middle 0 1 1 0 pair) (Sum (b 0%nat) (b 1%nat)))) pairs
    Advancing.everywhere.
Definition curving_mask pairs := let b := barred pairs in fold_left (fun m pair => Both (Both (Both (Both m (is_ahead
  0 (b
  0%nat) 0 pair)) (is_ahead 2 (b 2%nat) 1 pair)) (Greater (middle 0 1 1 0 pair) (Sum (b 0%nat) (b 1%nat)))) (Greater
    (middle 1 1 2 0 pair) (Sum (b 1%nat) (b 2%nat)))) pairs Advancing.everywhere.
Definition held_until_the_end pairs := held_until 0 (barred pairs 0) pairs (Constant (Small 2)).
Definition held_for_the_pair pairs := held_mask 0 (barred pairs 0) 0 pairs (are_in_range pairs).
Definition margins pairs := VolumeBeyond.margins_beyond pairs (Input (Moment 0)).
Definition volume_throughout pairs := VolumeSteps.all_positive (VolumeBeyond.margins_beyond pairs (Constant (Small 0))).
Definition volume_to_the_end pairs := VolumeSteps.all_positive (margins pairs).
Definition volume_until pairs := VolumeSteps.clipped_until (Input (Moment 0)) (margins pairs).
(* The proofs of one round, for one kind of pairs. *)
Record proofs := Proofs { is_in_range : mask; by_held : mask; until_held : number; by_turning : mask; by_curving :
  mask; by_volume_throughout : mask; by_volume_to_the_end : mask; until_volume : number }.
Definition for_corners pairs := Proofs (are_in_range pairs) (held_for_the_pair pairs) (held_until_the_end pairs)
  (turning_mask pairs) (curving_mask pairs) (volume_throughout pairs) (volume_to_the_end pairs) (volume_until pairs).
Module VF := AdvanceBeyond.a_vertex_and_a_face.
Module EE := AdvanceBeyond.two_edges.
Definition of_a_vertex_and_a_face := Proofs VF.in_range VF.held VF.until_held VF.turning VF.curving VF.volume_throughout
  VF.volume_to_the_end VF.until_volume.
Definition of_two_edges := Proofs EE.in_range EE.held EE.until_held EE.turning EE.curving EE.volume_throughout
  EE.volume_to_the_end EE.until_volume.
(* The traced terms are these. The margins of the volume have names, which the terms after them have not to unfold. *)
Lemma margins_of_a_vertex_and_a_face : (VF.margin_0, VF.margin_1, VF.margin_2, VF.margin_3) = margins vertex_face.
Proof. vm_compute. reflexivity. Qed.
Lemma margins_of_two_edges : (EE.margin_0, EE.margin_1, EE.margin_2, EE.margin_3) = margins edge_edge.
Proof. vm_compute. reflexivity. Qed.
Opaque VF.margin_0 VF.margin_1 VF.margin_2 VF.margin_3 EE.margin_0 EE.margin_1 EE.margin_2 EE.margin_3.
Lemma same_proofs a b c d e g h i a' b' c' d' e' g' h' i' : a = a' -> b = b' -> c = c' -> d = d' -> e = e' -> g = g' ->
  h = h' -> i = i' -> Proofs a b c d e g h i = Proofs a' b' c' d' e' g' h' i'.
Proof. now intros -> -> -> -> -> -> -> ->. Qed.
Theorem traced_terms : of_a_vertex_and_a_face = for_corners vertex_face /\ of_two_edges = for_corners edge_edge.
Proof.
  split; apply same_proofs; try (unfold volume_to_the_end, volume_until; first [rewrite <- margins_of_a_vertex_and_a_face |
    rewrite <- margins_of_two_edges]; lazy; reflexivity); vm_compute; reflexivity.
Qed.

(* Some direction is ahead of all corners at a time, by more than s times its length. *)
Definition ahead s pairs given t := exists w : Expressions.axis -> R, forall pair,
  In pair pairs -> s * norm w < sum3 (fun a => w a * exactly_at given pair a t).
Definition point_of (w : Expressions.axis -> R) := Point (w Expressions.X) (w Expressions.Y) (w Expressions.Z_).
Section Step.
Load "Setting.section".
Load "InRange.section".
Notation T n := (seen (given (Moment n))).
Notation is_short := (is_short f env given).
Notation exact_product := (exact_product f env given).
Notation along := (along f env given).
Notation s := (given (Length Separation)).
Hypothesis separation : lam f <= s <= power (largest_extent f).
Notation bar_of := (here bar_beyond_is_bar separation pairs in_range).
Lemma s_pos : 0 < s. Proof. pose proof (lam_pos f). lra. Qed.
Theorem held_is_ahead u : is_short 0 -> 0 <= T 0 <= 1 -> says f env value_of (held_for_the_pair pairs) ->
  value_of (held_until_the_end pairs) = Number u -> forall t, T 0 <= t <= 1 -> t <= u -> ahead s pairs given t.
Proof.
  intros short time masks E t between tu.
  assert (two : value_of (Constant (Small 2)) = Number 2) by exact (run (Constant (Small 2))).
  assert (s2 : seen 2 = 2). { apply seen_of_normal. rewrite Rabs_pos_eq by lra. pose proof (l_small f ok). lra. }
  destruct (within held_corners 0 (barred pairs 0) 0 _ _ _ 2 short time (bar_of
    0%nat
    short) masks two ltac:(lra) s2)
    as (u' & E' & _ & _ & all). unfold held_until_the_end in E. rewrite E' in E. injection E as ->.
  exists (along 0). intros pair inside. apply (all pair t inside between tu).
Qed.
Theorem turning_is_ahead : is_short 0 -> is_short 1 -> 0 <= T 0 -> T 0 < T 1 -> T 1 <= 1 -> says f env value_of
  (turning_mask pairs) ->
  forall t, T 0 <= t <= T 1 -> ahead s pairs given t.
Proof.
  intros short0 short1 t0 later t1 masks t between. pose proof s_pos as s0.
  destruct (Advancing.between_moments f env given t later between) as (r & r01 & ->).
  destruct (fold_of_masks f env value_of (fun pair m => Both (Both (Both m (is_ahead 0 (barred pairs 0) 0 pair))
    (is_ahead
    1 (barred pairs 1) 1 pair))
    (Greater (middle 0 1 1 0 pair) (Sum (barred pairs 0) (barred pairs 1))))
    (fun pair => says f env value_of (is_ahead 0 (barred pairs 0) 0 pair) /\ says f env value_of (is_ahead 1 (barred
      pairs 1) 1 pair) /\
      greater f env (value_of (middle 0 1 1 0 pair)) (value_of (Sum (barred pairs 0) (barred pairs 1))))
    ltac:(cbn -[is_ahead middle barred]; tauto) pairs _ masks) as [_ all].
  exists (fun a => (1 - r) * along 0 a + r * along 1 a). intros pair inside. destruct (all pair inside) as (A & C & B).
  apply (within ahead_at 0 _ 0 pair _ inside short0 ltac:(lra) (bar_of 0%nat
    short0)) in A.
  apply (within ahead_at 1 _ 1 pair _ inside short1 ltac:(lra) (bar_of 1%nat
    short1)) in C.
  apply (within middle_coefficient 0 _ _ 1 1 _ _ 0 pair inside short0 short1
    ltac:(lra) ltac:(lra) (bar_of 0%nat short0) (bar_of 1%nat short1)) in B.
  pose proof (norm_sum (fun a => (1 - r) * along 0 a) (fun a => r * along 1 a)) as tri. cbv beta in tri.
  rewrite !norm_scaled in tri by lra. apply (Rmult_le_compat_l s) in tri; [|lra].
  eapply Rle_lt_trans; [exact tri|]. set (n0 := norm (along 0)) in *. set (n1 := norm (along 1)) in *.
  replace (sum3 _) with ((1 - r) ^ 2 * exact_product 0 pair (T 0) + (1 - r) * r * (exact_product 0 pair (T 1) +
    exact_product 1 pair (T 0))
    + r ^ 2 * exact_product 1 pair (T 1)).
  2: { unfold Directions.exact_product, sum3, exactly_at. ring. }
  replace (s * ((1 - r) * n0 + r * n1)) with ((1 - r) ^ 2 * (s * n0) + (1 - r) * r * (s * n0 + s * n1) + r ^ 2 * (s *
    n1)) by ring.
  assert (0 <= (1 - r) * r) by (apply Rmult_le_pos; lra).
  assert ((1 - r) * r * (s * n0 + s * n1) <= (1 - r) * r * (exact_product 0 pair (T 1) + exact_product 1 pair (T 0))) by
    (apply Rmult_le_compat_l; lra).
  destruct (Rle_lt_dec r (1 / 2)).
  - assert ((1 - r) ^ 2 * (s * n0) < (1 - r) ^ 2 * exact_product 0 pair (T 0)) by (apply Rmult_lt_compat_l; [apply
      pow_lt|]; lra).
    assert (r ^ 2 * (s * n1) <= r ^ 2 * exact_product 1 pair (T 1)) by (apply Rmult_le_compat_l; [apply pow_le|]; lra).
    lra.
  - assert ((1 - r) ^ 2 * (s * n0) <= (1 - r) ^ 2 * exact_product 0 pair (T 0)) by (apply Rmult_le_compat_l; [apply
      pow_le|]; lra).
    assert (r ^ 2 * (s * n1) < r ^ 2 * exact_product 1 pair (T 1)) by (apply Rmult_lt_compat_l; [apply pow_lt|]; lra).
    lra.
Qed.
Theorem curving_is_ahead : is_short 0 -> is_short 1 -> is_short 2 -> 0 <= T 0 -> T 0 < T 1 -> T 1 <= 1 -> says f env
  value_of (curving_mask pairs) ->
  forall t, T 0 <= t <= T 1 -> ahead s pairs given t.
Proof.
  intros short0 short1 short2 t0 later t1 masks t between. pose proof s_pos as s0.
  destruct (Advancing.between_moments f env given t later between) as (r & r01 & ->).
  destruct (fold_of_masks f env value_of (fun pair m => Both (Both (Both (Both m (is_ahead 0 (barred pairs 0) 0 pair))
    (is_ahead 2 (barred pairs 2) 1 pair))
    (Greater (middle 0 1 1 0 pair) (Sum (barred pairs 0) (barred pairs 1)))) (Greater (middle 1 1 2 0 pair) (Sum (barred
      pairs 1) (barred pairs 2))))
    (fun pair => says f env value_of (is_ahead 0 (barred pairs 0) 0 pair) /\ says f env value_of (is_ahead 2 (barred
      pairs 2) 1 pair) /\
      greater f env (value_of (middle 0 1 1 0 pair)) (value_of (Sum (barred pairs 0) (barred pairs 1))) /\
      greater f env (value_of (middle 1 1 2 0 pair)) (value_of (Sum (barred pairs 1) (barred pairs 2))))
    ltac:(cbn -[is_ahead middle barred]; tauto) pairs _ masks) as [_ all].
  exists (fun a => (1 - r) ^ 2 * along 0 a + ((1 - r) * r * along 1 a + r ^ 2 * along 2 a)). intros pair inside.
  destruct (all pair inside) as (A & D & B & C).
  apply (within ahead_at 0 _ 0 pair _ inside short0 ltac:(lra) (bar_of 0%nat
    short0)) in A.
  apply (within ahead_at 2 _ 1 pair _ inside short2 ltac:(lra) (bar_of 2%nat
    short2)) in D.
  apply (within middle_coefficient 0 _ _ 1 1 _ _ 0 pair inside short0 short1
    ltac:(lra) ltac:(lra) (bar_of 0%nat short0) (bar_of 1%nat short1)) in B.
  apply (within middle_coefficient 1 _ _ 1 2 _ _ 0 pair inside short1 short2
    ltac:(lra) ltac:(lra) (bar_of 1%nat short1) (bar_of 2%nat short2)) in C.
  assert (q0 : 0 <= (1 - r) ^ 2) by (apply pow_le; lra). assert (q1 : 0 <= (1 - r) * r) by (apply Rmult_le_pos; lra).
  assert (q2 : 0 <= r ^ 2) by (apply pow_le; lra).
  pose proof (norm_sum (fun a => (1 - r) ^ 2 * along 0 a) (fun a => (1 - r) * r * along 1 a + r ^ 2 * along 2 a)) as
    tri.
  pose proof (norm_sum (fun a => (1 - r) * r * along 1 a) (fun a => r ^ 2 * along 2 a)) as tri'.
  cbv beta in tri, tri'. rewrite (norm_scaled _ _ q0) in tri. rewrite (norm_scaled _ _ q1), (norm_scaled _ _ q2) in
    tri'.
  set (n0 := norm (along 0)) in *. set (n1 := norm (along 1)) in *. set (n2 := norm (along 2)) in *.
  apply Rle_lt_trans with (s * ((1 - r) ^ 2 * n0 + ((1 - r) * r * n1 + r ^ 2 * n2))); [apply Rmult_le_compat_l; lra|].
  replace (sum3 _) with (exact_product 0 pair (T 0) * (1 - r) ^ 3 + (exact_product 0 pair (T 1) + exact_product 1 pair
    (T 0)) * (1 - r) ^ 2 * r
    + (exact_product 1 pair (T 1) + exact_product 2 pair (T 0)) * (1 - r) * r ^ 2 + exact_product 2 pair (T 1) * r ^ 3).
  2: { unfold Directions.exact_product, sum3, exactly_at. ring. }
  pose proof (hull (exact_product 0 pair (T 0) - s * n0) (exact_product 0 pair (T 1) + exact_product 1 pair (T 0) - (s *
    n0 + s * n1)) (exact_product 1 pair (T 1) + exact_product 2 pair (T 0) - (s * n1 + s * n2)) (exact_product 2 pair (T
      1) - s * n2) r ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) r01) as h.
  apply Rminus_gt_0_lt, Rlt_gt. eapply Rlt_le_trans; [exact h|]. right. ring.
Qed.
End Step.

(* Geometry: a pair that a direction is ahead of by more than s times its length is more than s apart. *)
Section OfAPair.
Variable place : Expressions.coordinate -> R.
Definition of_place given := forall c, given (Place c) = place c.
Notation path := (Apart.path_of place).
Lemma dot_of_a_corner given w n k t : of_place given -> sum3 (fun a => w a * exactly_at given (n, k) a t) =
  dot (point_of w) (minus (at_ (path n) t) (at_ (path k) t)).
Proof.
  intro same. unfold sum3, exactly_at, exactly, exact_difference, point_of, dot, minus, at_, plus, scaled; cbn.
  rewrite !same. ring.
Qed.
Lemma beyond_is_farther w s M D : 0 <= s -> s * norm w < M -> M <= dot (point_of w) D -> s ^ 2 <
  Certificates.length_squared D.
Proof.
  intros s0 big far. unfold Certificates.length_squared. set (W := point_of w) in *.
  assert (schwarz : dot W D ^ 2 <= dot W W * dot D D).
  { unfold dot. pose proof (pow2_ge_0 (x W * y D - y W * x D)). pose proof (pow2_ge_0 (y W * z D - z W * y D)).
    pose proof (pow2_ge_0 (z W * x D - x W * z D)). lra. }
  assert (ww : dot W W = squared w) by (unfold dot, squared, sum3, W, point_of; cbn; ring).
  pose proof (squared_pos w) as sq. pose proof (norm_pos w) as n0. assert (nn : norm w * norm w = squared w) by (apply
    sqrt_sqrt; exact sq). rewrite ww in schwarz.
  assert (sn : 0 <= s * norm w) by (apply Rmult_le_pos; lra).
  assert (less : (s * norm w) * (s * norm w) < dot W D * dot W D) by (apply Rmult_le_0_lt_compat; lra).
  replace ((s * norm w) * (s * norm w)) with (squared w * s ^ 2) in less by (rewrite <- nn; ring).
  destruct (Req_dec (squared w) 0) as [none|some]; [rewrite none in *; lra|].
  apply Rmult_lt_reg_l with (squared w); lra.
Qed.
Theorem a_vertex_and_a_face_ahead given s t i j r : of_place given -> 0 <= s -> ahead s vertex_face given t ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> s ^ 2 < Certificates.length_squared (minus (at_ (path 0) t) (plus
    (scaled i (at_ (path 1) t)) (plus (scaled j (at_ (path 2) t)) (scaled r (at_ (path 3) t))))).
Proof.
  intros same s0 (w & all) i0 j0 r0 one_.
  set (b k := dot (point_of w) (minus (at_ (path 0) t) (at_ (path k) t))).
  assert (each_ : forall k, In (0%nat, k) vertex_face -> s * norm w < b k).
  { intros k inside. unfold b. rewrite <- (dot_of_a_corner given w 0 k t same). now apply all. }
  set (M := Rmin (b 1%nat) (Rmin (b 2%nat) (b 3%nat))).
  assert (bM : s * norm w < M) by (unfold M; repeat apply Rmin_glb_lt; apply each_; cbn; auto).
  apply (beyond_is_farther w s M _ s0 bM). apply Certificates.ahead_of_the_triangle; auto; unfold Certificates.ahead_by.
  - apply Rmin_l.
  - eapply Rle_trans; [apply Rmin_r|apply Rmin_l].
  - eapply Rle_trans; [apply Rmin_r|apply Rmin_r].
Qed.
Theorem two_edges_ahead given s t i r : of_place given -> 0 <= s -> ahead s edge_edge given t -> 0 <= i <= 1 -> 0 <= r
  <=
  1 -> s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_ (path 0) t)) (scaled i (at_ (path 1) t)))
    (plus (scaled (1 - r) (at_ (path 2) t)) (scaled r (at_ (path 3) t)))).
Proof.
  intros same s0 (w & all) i01 r01.
  set (b n k := dot (point_of w) (minus (at_ (path n) t) (at_ (path k) t))).
  assert (each_ : forall n k, In (n, k) edge_edge -> s * norm w < b n k).
  { intros n k inside. unfold b. rewrite <- (dot_of_a_corner given w n k t same). now apply all. }
  set (M := Rmin (Rmin (b 0%nat 2%nat) (b 0%nat 3%nat)) (Rmin (b 1%nat 2%nat) (b 1%nat 3%nat))).
  assert (bM : s * norm w < M) by (unfold M; repeat apply Rmin_glb_lt; apply each_; cbn; auto 6).
  apply (beyond_is_farther w s M _ s0 bM). apply Certificates.between_two_ahead; auto; unfold Certificates.ahead_by.
  - eapply Rle_trans; [apply Rmin_l|apply Rmin_l].
  - eapply Rle_trans; [apply Rmin_r|apply Rmin_l].
  - eapply Rle_trans; [apply Rmin_l|apply Rmin_r].
  - eapply Rle_trans; [apply Rmin_r|apply Rmin_r].
Qed.
(* So is a pair whose volume exceeds s times the length of the normal. *)
Definition normal pairs given t := let '(p, b, c) := VolumeSteps.corners_of pairs in VolumeBeyond.normal_at given p b c t.
Definition volume pairs given t := let '(p, b, c) := VolumeSteps.corners_of pairs in VolumeSteps.exact_volume given p b c
  t.
Lemma far_along_a_normal n D K s : 0 < s -> dot (point_of n) D = K -> s * norm n < Rabs K -> s ^ 2 <
  Certificates.length_squared D.
Proof.
  intros s0 E far. pose proof (norm_pos n) as n0. set (N := norm n + (Rabs K - s * norm n) / (2 * s)).
  assert (part : 0 < (Rabs K - s * norm n) / (2 * s)) by (apply Rdiv_lt_0_compat; lra).
  assert (sN : s * N = (s * norm n + Rabs K) / 2) by (unfold N; field; lra).
  apply (Separated.far_from_a_plane (point_of n) D K s N); [lra|unfold N; lra|exact E|lra|].
  replace (dot (point_of n) (point_of n)) with (squared n) by (unfold dot, squared, sum3, point_of; cbn; ring).
  pose proof (sqrt_sqrt (squared n) (squared_pos n)) as nn. fold (norm n) in nn. rewrite <- nn.
  replace (N ^ 2) with (N * N) by ring. apply Rmult_le_compat; unfold N; lra.
Qed.
Theorem a_vertex_and_a_face_far given s t i j r : of_place given -> 0 < s ->
  s * norm (normal vertex_face given t) < Rabs (volume vertex_face given t) -> i + j + r = 1 -> s ^ 2 <
  Certificates.length_squared (minus (at_ (path 0) t) (plus (scaled i (at_ (path 1) t)) (plus (scaled j (at_ (path 2) t))
    (scaled r (at_ (path 3) t))))).
Proof.
  intros same s0 far one_. apply (far_along_a_normal (normal vertex_face given t) _ (volume vertex_face given t) s s0);
    [|exact far]. replace i with (1 - j - r) by lra.
  unfold normal, volume, VolumeSteps.corners_of, vertex_face, VolumeBeyond.normal_at, VolumeSteps.exact_volume,
    Volume.cross_at, sum3, exactly_at, exactly, exact_difference, point_of, dot, minus, at_, plus, scaled; cbn.
  rewrite !same. ring.
Qed.
Theorem two_edges_far given s t i r : of_place given -> 0 < s ->
  s * norm (normal edge_edge given t) < Rabs (volume edge_edge given t) -> s ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (path 0) t)) (scaled i (at_ (path 1) t))) (plus (scaled (1 - r) (at_ (path 2) t)) (scaled r
      (at_ (path 3) t)))).
Proof.
  intros same s0 far. apply (far_along_a_normal (normal edge_edge given t) _ (volume edge_edge given t) s s0); [|exact
    far].
  unfold normal, volume, VolumeSteps.corners_of, edge_edge, VolumeBeyond.normal_at, VolumeSteps.exact_volume,
    Volume.cross_at, sum3, exactly_at, exactly, exact_difference, point_of, dot, minus, at_, plus, scaled; cbn.
  rewrite !same. ring.
Qed.
End OfAPair.

(* One step, as in Advancing.v, with a separation of normal size that is at most the largest extent. *)
Definition computed (f : constants) (env : environment f) place s given value_of code := of_place place given /\
  execution f env value_of given /\ given (Length Separation) = s /\ lam f <= s <= power (largest_extent f) /\
  says f env value_of (is_in_range code).
Inductive step (code : proofs) (place : Expressions.coordinate -> R) s (f : constants) (env : environment f) : R -> R ->
  Prop :=
| HeldBeyond given value_of u : computed f env place s given value_of code -> Advancing.is_direction f given 0 ->
    Advancing.is_moment given 0 -> says f env value_of (by_held code) -> value_of (until_held code) = Number u ->
    step code place s f env (given (Moment 0)) u
| TurningBeyond given value_of : computed f env place s given value_of code -> Advancing.is_direction f given 0 ->
    Advancing.is_direction f given 1 -> Advancing.is_moment given 0 -> Advancing.is_moment given 1 -> says f env
      value_of
      (Greater (Input (Moment 1)) (Input (Moment 0))) ->
    says f env value_of (by_turning code) -> step code place s f env (given (Moment 0)) (given (Moment 1))
| CurvingBeyond given value_of : computed f env place s given value_of code -> Advancing.is_direction f given 0 ->
    Advancing.is_direction f given 1 -> Advancing.is_direction f given 2 -> Advancing.is_moment given 0 ->
    Advancing.is_moment given 1 -> says f env value_of (Greater (Input (Moment 1)) (Input (Moment 0))) ->
    says f env value_of (by_curving code) -> step code place s f env (given (Moment 0)) (given (Moment 1))
| VolumeThroughoutBeyond given value_of from : computed f env place s given value_of code -> 0 <= from ->
    says f env value_of (by_volume_throughout code) -> step code place s f env from 1
| VolumeToTheEndBeyond given value_of : computed f env place s given value_of code -> Advancing.is_moment given 0 ->
    says f env value_of (by_volume_to_the_end code) -> step code place s f env (given (Moment 0)) 1
| VolumeUntilBeyond given value_of u : computed f env place s given value_of code -> Advancing.is_moment given 0 ->
    given (Moment 0) < u -> value_of (until_volume code) = Number u -> step code place s f env (given (Moment 0)) u.
Inductive reaches code place s (begin : R) : R -> Prop :=
| First (f : constants) env until : reasonable_constants f -> step code place s f env begin until -> reaches code
  place s
    begin until
| Next (f : constants) env from until : reasonable_constants f -> reaches code place s begin from -> step code place s f
    env from until -> reaches code place s begin until
| RoundedDown from until : reaches code place s begin from -> until <= from -> reaches code place s begin until.

Section Sound.
Variables p b c : nat * nat.
Variable others : list (nat * nat).
Notation pairs := (p :: b :: c :: others).
Variable place : Expressions.coordinate -> R.
Variable s : R.
Definition is_far given t := s * norm (normal pairs given t) < Rabs (volume pairs given t).
Definition apart t := 0 < s /\ exists given, of_place place given /\ (ahead s pairs given t \/ is_far given t).
Theorem a_step_keeps_apart (f : constants) env from until : reasonable_constants f -> step (for_corners pairs) place s f
  env from until -> forall t, from <= t <= until -> t <= 1 -> apart t.
Proof.
  intros fine [given value_of u (same & run & es & sep & in_range) short time masks E|given value_of (same & run & es &
    sep & in_range) short0 short1 time0 time1 later masks|given value_of (same & run & es & sep & in_range) short0
      short1 short2 time0 time1 later masks|given value_of from' (same & run & es & sep & in_range) from0 masks
    |given value_of (same & run & es & sep & in_range) time masks|given value_of u (same & run & es & sep & in_range) time
      later E] t between t1; (split; [pose proof (lam_pos f); lra|]); exists given; (split; [exact same|]); unfold
    is_far; rewrite <- es in *.
  1, 2, 3: left. 4, 5, 6: right.
  - pose proof (Advancing.seen_moment f env given 0 time). unfold Advancing.is_moment in time.
    apply (held_is_ahead f fine env given value_of run pairs in_range sep u (Advancing.short_direction f env given 0
      short)); auto; lra.
  - pose proof (Advancing.seen_moment f env given 0 time0). pose proof (Advancing.seen_moment f env given 1 time1).
    unfold Advancing.is_moment in *.
    cbn in later. rewrite (run (Input (Moment 0))), (run (Input (Moment 1))) in later. cbn in later.
    assert (s1 : seen f env (given (Moment 1)) = given (Moment 1)) by (apply seen_positive; lra).
    apply (turning_is_ahead f fine env given value_of run pairs in_range sep); auto using Advancing.short_direction;
      lra.
  - pose proof (Advancing.seen_moment f env given 0 time0). pose proof (Advancing.seen_moment f env given 1 time1).
    unfold Advancing.is_moment in *.
    cbn in later. rewrite (run (Input (Moment 0))), (run (Input (Moment 1))) in later. cbn in later.
    assert (s1 : seen f env (given (Moment 1)) = given (Moment 1)) by (apply seen_positive; lra).
    apply (curving_is_ahead f fine env given value_of run pairs in_range sep); auto using Advancing.short_direction;
      lra.
  - apply (VolumeBeyond.margins_keep_beyond f fine env given value_of run sep (Constant (Small 0)) 0 (run (Constant (Small
    0))) ltac:(rewrite seen_0; lra) p b c others in_range masks). rewrite seen_0. lra.
  - pose proof (Advancing.seen_moment f env given 0 time). unfold Advancing.is_moment in time.
    apply (VolumeBeyond.margins_keep_beyond f fine env given value_of run sep (Input (Moment 0)) (given (Moment 0)) (run
      (Input (Moment 0))) ltac:(lra) p b c others in_range masks). lra.
  - pose proof (Advancing.seen_moment f env given 0 time). unfold Advancing.is_moment in time.
    apply (VolumeBeyond.clipping_keeps_beyond f fine env given value_of run sep (Input (Moment 0)) (given (Moment 0)) (run
      (Input (Moment 0))) ltac:(lra) p b c others in_range u E later); lra.
Qed.
Theorem rounds_keep_apart begin until : reaches (for_corners pairs) place s begin until ->
  forall t, begin <= t <= until -> t <= 1 -> apart t.
Proof.
  induction 1 as [f env until fine h|f env from until fine _ IH h|from until _ IH less]; intros t between t1.
  - exact (a_step_keeps_apart f env begin until fine h t between t1).
  - destruct (Rle_lt_dec t from); [apply IH; lra|]. apply (a_step_keeps_apart f env from until fine h t); lra.
  - apply IH; lra.
Qed.
End Sound.
Theorem a_vertex_and_a_face_stay_apart place s begin until t i j r : reaches of_a_vertex_and_a_face place s begin
  until ->
  begin <= t <= until -> t <= 1 -> 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 ->
  s ^ 2 < Certificates.length_squared (minus (at_ (Apart.path_of place 0) t) (plus (scaled i (at_ (Apart.path_of place
    1) t)) (plus (scaled j (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t))))).
Proof.
  rewrite (proj1 traced_terms). intros chain between t1.
  destruct (rounds_keep_apart _ _ _ _ _ _ _ _ chain t between t1) as (s0 & given & same & [far|far]); intros.
  - eapply a_vertex_and_a_face_ahead; eassumption || lra.
  - eapply a_vertex_and_a_face_far; eassumption.
Qed.
Theorem two_edges_stay_apart place s begin until t i r : reaches of_two_edges place s begin until ->
  begin <= t <= until -> t <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  s ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (Apart.path_of place 0) t)) (scaled i (at_ (Apart.path_of place 1) t)))
    (plus (scaled (1 - r) (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t)))).
Proof.
  rewrite (proj2 traced_terms). intros chain between t1.
  destruct (rounds_keep_apart _ _ _ _ _ _ _ _ chain t between t1) as (s0 & given & same & [far|far]); intros.
  - eapply two_edges_ahead; eassumption || lra.
  - eapply two_edges_far; eassumption.
Qed.
