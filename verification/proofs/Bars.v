(* The normal of a pair on a part of the step, and the bars of the volume with a separation: each is at least the error
   of a control value and the separation times the length of the normal there. core/src/kernels/advance/volume.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Least Directions Held DirectionsBeyond Hull Volume
  Lengths.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

Section Bars.
Load "Setting.section".
Load "InRange.section".
Notation L := (power (largest_extent f)).
Notation vanishing := (power (length_underflow f)).
Notation X_ := Expressions.X. Notation Y_ := Expressions.Y. Notation Z_ := Expressions.Z_.

Notation constant := (constant f env given value_of run).
Notation M_bounds := (within M_bounds).
Notation p_pos := (within p_pos).
Notation p_small := (within p_small).
Notation p_M := (within p_M).
Notation p_product := (within p_product).
Notation beside := (beside f env value_of pairs).
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).
Notation run_constant := (run_constant f env given value_of run).
Notation run_input := (run_input f env given value_of run).

(* The moment from which the part leads to the end. *)
Variable t : number.
Variable T : R.
Hypothesis moment : seen_value f env (value_of t) = Number T.
Hypothesis in_step : 0 <= T <= 1.
Variables pp pb pc : nat * nat.
Hypothesis inside : In pp pairs /\ In pb pairs /\ In pc pairs.

(* The exact edges and their cross product. *)
Definition exact_side b t a := exactly pp t a - exactly b t a.
Definition exact_side_at b a := (1 - T) * exact_side b Expressions.Start a + T * exact_side b Expressions.End a.
Definition exact_normal i : Expressions.axis -> R := match i with
  | 0%nat => cross_at (exact_side_at pb) (exact_side_at pc)
  | 1%nat => fun a => (cross_at (exact_side_at pb) (exact_side pc Expressions.End) a + cross_at (exact_side pb
      Expressions.End) (exact_side_at pc) a) * / 2
  | _ => cross_at (exact_side pb Expressions.End) (exact_side pc Expressions.End) end.

Lemma side_holds b time a : In b pairs -> holds (value_of (component (side pp b time) a)) (exact_side b time a)
  (2 * p a) 2 9.1.
Proof.
  intro hb. destruct inside as (hp & _). unfold side. rewrite component_each.
  pose proof (within corner_operand pp time a hp) as o.
  pose proof (within corner_operand b time a hb) as o'.
  pose proof (p_pos a). pose proof (p_small a). pose proof (G_1 f fine). pose proof (G_4 f fine).
  pose proof (run (Minus (component (difference pp time) a) (component (difference b time) a))) as h. cbn in h.
  pose proof (sum_holds Rminus 1 ltac:(auto) h o o' ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
Lemma side_at_holds b a : In b pairs -> holds (value_of (component (side_at pp b t) a)) (exact_side_at b a)
  (2 * p a) 5 (4.1 * p a + 17).
Proof.
  intro hb. unfold side_at. rewrite component_each. pose proof (p_pos a). pose proof (p_small a).
  pose proof (G_1 f fine). pose proof (G_4 f fine). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (seen_holds (side_holds b Expressions.Start a hb)) as o.
  pose proof (seen_holds (side_holds b Expressions.End a hb)) as o'.
  set (x := component (side pp b Expressions.Start) a) in *. set (y := component (side pp b Expressions.End) a) in *.
  pose proof (here rest_operand t T moment in_step) as ro.
  pose proof (moment_operand_ f env value_of t T moment in_step) as mo.
  assert (t0 : 0 <= p a * (1 - T) <= p a) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_r (p a)) at 2;
    apply Rmult_le_compat_l; lra).
  assert (t1 : 0 <= p a * T <= p a) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_r (p a)) at 2;
    apply Rmult_le_compat_l; lra).
  pose proof (run (Product x (Minus one t))) as h. cbn -[one x] in h.
  pose proof (product_holds h o ro ltac:(lia) ltac:(lra) ltac:(lra)) as r0.
  pose proof (run (Product y t)) as h'. cbn -[y] in h'.
  pose proof (product_holds h' o' mo ltac:(lia) ltac:(lra) ltac:(lra)) as r1.
  pose proof (run (Sum (Product x (Minus one t)) (Product y t))) as h''. cbn -[one x y] in h''.
  pose proof (sum_holds Rplus 4 ltac:(auto) h'' (seen_holds r0) (seen_holds r1) ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  replace (exact_side_at b a) with (exact_side b Expressions.Start a * (1 - T) + exact_side b Expressions.End a * T) by
    (unfold exact_side_at; ring).
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
(* Both as operands. *)
Definition is_edge v (V : Expressions.axis -> R) := forall a, operand (value_of (component v a)) (V a) (2 * p a) 5 (4.1 *
  p a + 18).
Lemma side_is_edge b : In b pairs -> is_edge (side pp b Expressions.End) (exact_side b Expressions.End).
Proof.
  intros hb a. pose proof (p_pos a). apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds (side_holds b _ a hb)));
    lra || lia.
Qed.
Lemma side_at_is_edge b : In b pairs -> is_edge (side_at pp b t) (exact_side_at b).
Proof.
  intros hb a. apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds (side_at_holds b a hb))); lra || lia.
Qed.
Definition others a := match a with X_ => p Y_ + p Z_ | Y_ => p Z_ + p X_ | Z_ => p X_ + p Y_ end.
Lemma edge_products x y z w a b X1 Y1 Z1 W1 : operand (value_of x) X1 (2 * p a) 5 (4.1 * p a + 18) ->
  operand (value_of y) Y1 (2 * p b) 5 (4.1 * p b + 18) -> operand (value_of z) Z1 (2 * p b) 5 (4.1 * p b + 18) ->
  operand (value_of w) W1 (2 * p a) 5 (4.1 * p a + 18) ->
  holds (value_of (Minus (Product x y) (Product z w))) (X1 * Y1 - Z1 * W1) (8 * (p a * p b)) 12 (34 * (p a * p b) + 74 *
    (p a + p b) + 6).
Proof.
  intros hx hy hz hw. pose proof (p_pos a). pose proof (p_pos b). pose proof (p_product a b).
  pose proof (p_small a). pose proof (p_small b). pose proof (G_bounds f fine). pose proof (l_small f ok).
  pose proof (l_pos f).
  assert (lab : 0 <= l * ((4.1 * p a + 18) * (4.1 * p b + 18)) <= 0.001 * (p a * p b) + 0.001 * (p a + p b) + 0.001).
  { split; [repeat apply Rmult_le_pos; lra|].
    assert (l * ((4.1 * p a + 18) * (4.1 * p b + 18)) <= / 1152921504606846976 * ((4.1 * p a + 18) * (4.1 * p b + 18)))
      by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra). lra. }
  pose proof (run (Product x y)) as h. cbn in h. pose proof (run (Product z w)) as h'. cbn in h'.
  pose proof (product_holds h hx hy ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  pose proof (product_holds h' hz hw ltac:(lia) ltac:(lra) ltac:(lra)) as r'.
  pose proof (run (Minus (Product x y) (Product z w))) as h''. cbn in h''.
  pose proof (sum_holds Rminus 11 ltac:(auto) h'' (seen_holds r) (seen_holds r') ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
Lemma cross_of_edges v w V W a : is_edge v V -> is_edge w W -> holds (value_of (component (cross_ v w) a)) (cross_at V W
  a) (8 * beside a) 12 (34 * beside a + 74 * others a + 6).
Proof.
  intros hv hw. destruct a; cbn [component cross_ cross_at Volume.beside others vx vy vz]; apply edge_products;
    first [exact (hv X_) | exact (hv Y_) | exact (hv Z_) | exact (hw X_) | exact (hw Y_) | exact (hw Z_)].
Qed.
Definition normal_vector i := let '(n0, n1, n2) := normals pp pb pc t in match i with
  | 0%nat => n0 | 1%nat => n1 | _ => n2 end.
Lemma beside_small a : 0 < beside a <= 0.08 * (G * G) /\ 0 < others a <= 0.54 * G.
Proof.
  pose proof (p_pos X_). pose proof (p_pos Y_). pose proof (p_pos Z_). pose proof (p_small X_). pose proof (p_small Y_).
  pose proof (p_small Z_). split; [destruct a; apply p_product|destruct a; cbn; lra].
Qed.
Lemma normals_hold i a : holds (value_of (component (normal_vector i) a)) (exact_normal i a) (8 * beside a) 14 (35 *
  beside a + 76 * others a + 10).
Proof.
  destruct inside as (_ & hb & hc). pose proof (side_at_is_edge pb hb) as b0. pose proof (side_at_is_edge pc hc) as c0.
  pose proof (side_is_edge pb hb) as b1. pose proof (side_is_edge pc hc) as c1. pose proof (beside_small a).
  pose proof (G_bounds f fine). pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f).
  destruct i as [|[|i]]; cbn [normal_vector normals exact_normal].
  - apply (holds_weaker f _ _ _ _ _ _ _ _ (cross_of_edges _ _ _ _ a b0 c0)); lra || lia.
  - rewrite component_each.
    pose proof (seen_holds (cross_of_edges _ _ _ _ a b0 c1)) as o.
    pose proof (seen_holds (cross_of_edges _ _ _ _ a b1 c0)) as o'.
    set (x := component (cross_ (side_at pp pb t) (side pp pc Expressions.End)) a) in *.
    set (y := component (cross_ (side pp pb Expressions.End) (side_at pp pc t)) a) in *.
    pose proof (run (Sum x y)) as h. cbn -[x y] in h.
    pose proof (sum_holds Rplus 12 ltac:(auto) h o o' ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s.
    assert (oh : operand (value_of half) (/ 2) (/ 2) 0 0).
    { unfold half. rewrite run_constant. cbn. rewrite <- (Rabs_pos_eq (/ 2)) at 3 by lra. apply operand_normal.
      rewrite Rabs_pos_eq; lra. }
    pose proof (run (Product (Sum x y) half)) as h'. cbn -[x y half] in h'.
    pose proof (product_holds h' (seen_holds s) oh ltac:(lia) ltac:(lra) ltac:(lra)) as r.
    apply (holds_weaker f _ _ _ _ _ _ _ _ r); [lra|lia|lra].
  - apply (holds_weaker f _ _ _ _ _ _ _ _ (cross_of_edges _ _ _ _ a b1 c1)); lra || lia.
Qed.

(* How large the normal can be: A bounds it eight times. *)
Definition area := M X_ * M Y_ + M Y_ * M Z_ + M Z_ * M X_.
Notation A := area.
Lemma area_bounds : 0 < A <= 0.19 * (G * G) /\ beside X_ + beside Y_ + beside Z_ <= (1 + 7 * e1) * A /\
  152 * l * (p X_ + p Y_ + p Z_) <= 19.3 * (e1 * A) /\ 0 <= l * A <= / 1099511627776 * (e1 * A).
Proof.
  pose proof (M_bounds X_) as x. pose proof (M_bounds Y_) as y. pose proof (M_bounds Z_) as z. pose proof (l_pos f) as l0.
  pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_small f ok). pose proof (G_4 f fine).
  pose proof (p_M X_) as px. pose proof (p_M Y_) as py. pose proof (p_M Z_) as pz. pose proof (l_e f fine) as le.
  pose proof (p_pos X_). pose proof (p_pos Y_). pose proof (p_pos Z_).
  assert (e2 : 0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (up : forall a, 7.99 * l <= e1 * M a).
  { intro a. pose proof (within M_low a) as low.
    pose proof (within m_pos a) as m0. pose proof (mu_large f fine) as ml.
    pose proof (mu_pos f). pose proof (mu_1 f fine).
    apply (Rmult_le_compat_l e1) in low; [|lra]. assert (0 <= e1 * m a) by (apply Rmult_le_pos; lra).
    assert (e1 * (e1 * m a) <= / 8388608 * (e1 * m a)) by (apply Rmult_le_compat_r; lra).
    assert (e1 * (e1 * mu) <= / 8388608 * (e1 * mu)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra).
    assert (e1 * l <= / 8388608 * l) by (apply Rmult_le_compat_r; lra). lra. }
  assert (pair : forall a b, 0 < M a * M b <= / 16 * (G * G) /\ p a * p b <= (1 + 7 * e1) * (M a * M b) /\
    7.99 * (l * M a) <= e1 * (M a * M b)).
  { intros a b. pose proof (M_bounds a). pose proof (M_bounds b). pose proof (p_M a). pose proof (p_M b).
    pose proof (p_pos a). pose proof (p_pos b). pose proof (up b) as ub. split; [split|split].
    - apply Rmult_lt_0_compat; lra.
    - replace (/ 16 * (G * G)) with (/ 4 * G * (/ 4 * G)) by field. apply Rmult_le_compat; lra.
    - apply Rle_trans with ((1 + 3 * e1) * M a * ((1 + 3 * e1) * M b)); [apply Rmult_le_compat; lra|].
      replace ((1 + 3 * e1) * M a * ((1 + 3 * e1) * M b)) with ((1 + 3 * e1) * (1 + 3 * e1) * (M a * M b)) by ring.
      apply Rmult_le_compat_r; [apply Rmult_le_pos; lra|lra].
    - apply (Rmult_le_compat_r (M a)) in ub; [|lra]. lra. }
  destruct (pair X_ Y_) as (a1 & a2 & a3). destruct (pair Y_ Z_) as (b1 & b2 & b3). destruct (pair Z_ X_) as (c1 & c2 &
    c3).
  unfold area. cbn [Volume.beside]. split; [lra|]. split; [lra|]. split.
  - assert (pM : forall a, 0 <= l * M a /\ l * p a <= 1.00001 * (l * M a)).
    { intro a. pose proof (p_M a) as h. pose proof (M_bounds a). apply (Rmult_le_compat_l l) in h; [|lra].
      assert (0 <= l * M a) by (apply Rmult_le_pos; lra).
      assert (e1 * (l * M a) <= / 8388608 * (l * M a)) by (apply Rmult_le_compat_r; lra). lra. }
    pose proof (pM X_). pose proof (pM Y_). pose proof (pM Z_). lra.
  - split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * (M X_ * M Y_ + M Y_ * M Z_ + M Z_ * M X_))) with (/ 1099511627776 * e1 * (M X_ * M
      Y_ + M Y_ * M Z_ + M Z_ * M X_)) by ring. apply Rmult_le_compat_r; lra.
Qed.
Lemma extents_squared : forall a, 0 <= p a <= 1.00001 * L.
Proof.
  intro a. pose proof (within extent_and_differences a) as (_ & _ & ML & _).
  pose proof (p_M a). pose proof (p_pos a). pose proof (M_bounds a). pose proof (l_pos f). pose proof (e_small f ok).
  pose proof (e_pos f). assert (3 * e1 * M a <= 0.00001 * M a) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma room_for_normals : 4000 * (L * L * (L * L)) <= omega f.
Proof.
  assert (A4 : 4096 * (L * L * (L * L)) <= power (greatest_exponent f)).
  { unfold power. rewrite <- !bpow_plus. change 4096 with (bpow radix2 12). rewrite <- bpow_plus. apply bpow_le.
    pose proof (squared_normals f fine). lia. }
  pose proof (bpow_gt_0 radix2 (greatest_exponent f)) as P0.
  assert (B : 16777216 * power (greatest_exponent f - precision f) <= power (greatest_exponent f)).
  { unfold power. change 16777216 with (bpow radix2 24). rewrite <- bpow_plus. apply bpow_le. destruct ok; lia. }
  unfold omega, power in *. lra.
Qed.
Theorem lengths_hold i : exists y, value_of (length_of (normal_vector i)) = Number y /\
  norm (exact_normal i) <= (1 + 2.7 * e1) * seen y + 0.871 * vanishing + 131.8 * (e1 * A) /\
  0 <= seen y <= 8.1 * A + 1.4 * vanishing.
Proof.
  pose proof area_bounds as (A0 & besides & others_ & lA). pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls.
  pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (vanishing_large f fine) as (v2 & v1 & vl & r0).
  pose proof (q_linear f ok 14 ltac:(lia)) as q14. replace (INR 14) with 14 in q14 by (simpl; ring).
  pose proof (q_ge f 14) as q1.
  assert (all : forall a, exists x, value_of (component (normal_vector i) a) = Number x /\ Rabs (x - exact_normal i a) <=
    112.2 * (e1 * beside a) + l * (35 * beside a + 76 * others a + 10) /\ Rabs x <= 8.001 * beside a + l * (35 * beside a
      + 76 * others a + 10)).
  { intro a. destruct (normals_hold i a) as (x & Ex & _ & N). pose proof (near_size f _ _ _ _ _ N) as size.
    destruct N as (d & _ & _). pose proof (beside_small a) as [[b0 _] _]. exists x. split; [exact Ex|].
    assert (0 <= e1 * beside a) by (apply Rmult_le_pos; lra).
    assert ((q 14 - 1) * (8 * beside a) <= 14.02 * e1 * (8 * beside a)) by (apply Rmult_le_compat_r; lra).
    assert (q 14 * (8 * beside a) <= 1.0001 * (8 * beside a)) by (apply Rmult_le_compat_r; lra). lra. }
  destruct (all X_) as (x & Ex & dx & sx). destruct (all Y_) as (y & Ey & dy & sy). destruct (all Z_) as (z & Ez & dz &
    sz). clear all.
  set (v a := match a with X_ => x | Y_ => y | Z_ => z end).
  assert (Ev : forall a, value_of (component (normal_vector i) a) = Number (v a)) by (intros [| |]; assumption).
  assert (total : l * (35 * beside X_ + 76 * others X_ + 10) + l * (35 * beside Y_ + 76 * others Y_ + 10) + l * (35 *
    beside Z_ + 76 * others Z_ + 10) <= 19.4 * (e1 * A) + 0.0001 * vanishing).
  { assert (l * (35 * (beside X_ + beside Y_ + beside Z_)) <= l * (35 * ((1 + 7 * e1) * A))) by (apply Rmult_le_compat_l;
      lra). assert (e1 * (l * A) <= 1 * (l * A)) by (apply Rmult_le_compat_r; lra).
    assert (0 <= e1 * A) by (apply Rmult_le_pos; lra). unfold others. lra. }
  assert (squares : squared v <= omega f / 4).
  { pose proof room_for_normals as room. pose proof (L_1 f fine) as L1.
    assert (LL : L <= L * L) by (rewrite <- (Rmult_1_l L) at 1; apply Rmult_le_compat_r; lra).
    assert (one_ : forall a, Rabs (v a) <= 8.01 * (L * L)).
    { assert (pp_ : forall a b, 0 <= p a * p b <= 1.0001 * (L * L)).
      { intros a b. pose proof (extents_squared a). pose proof (extents_squared b). split; [apply Rmult_le_pos; lra|].
        assert (p a * p b <= 1.00001 * L * (1.00001 * L)) by (apply Rmult_le_compat; lra).
        assert (0 <= L * L) by (apply Rmult_le_pos; lra). lra. }
      assert (each_ : forall a, 0 <= beside a <= 1.0001 * (L * L) /\ l * (35 * beside a + 76 * others a + 10) <= 0.001 *
        (L * L)).
      { intro a. assert (b : 0 <= beside a <= 1.0001 * (L * L)) by (destruct a; apply pp_). split; [exact b|].
        pose proof (extents_squared X_). pose proof (extents_squared Y_). pose proof (extents_squared Z_).
        assert (o : 0 <= others a <= 2.1 * L) by (destruct a; cbn; lra).
        assert (l * (35 * beside a + 76 * others a + 10) <= / 1152921504606846976 * (300 * (L * L))) by (apply
          Rmult_le_compat; lra). lra. }
      intros [| |]; cbn [v]; [pose proof (each_ X_)|pose proof (each_ Y_)|pose proof (each_ Z_)]; lra. }
    assert (sq : forall a, v a * v a <= 8.01 * (L * L) * (8.01 * (L * L))).
    { intro a. rewrite <- (Rabs_pos_eq (v a * v a)) by apply Rle_0_sqr. rewrite Rabs_mult.
      pose proof (Rabs_pos (v a)). apply Rmult_le_compat; auto. }
    assert (0 <= L * L * (L * L)) by (repeat apply Rmult_le_pos; lra).
    pose proof (sq X_). pose proof (sq Y_). pose proof (sq Z_). unfold squared, sum3. lra. }
  destruct (here length_value (normal_vector i) v Ev squares) as (r & Er & low & high).
  exists r. split; [exact Er|].
  assert (eb : e1 * (beside X_ + beside Y_ + beside Z_) <= e1 * ((1 + 7 * e1) * A)) by (apply Rmult_le_compat_l; lra).
  assert (eA : 0 <= e1 * A <= / 8388608 * A) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eeA : e1 * (e1 * A) <= / 8388608 * (e1 * A)) by (apply Rmult_le_compat_r; lra).
  assert (nv : norm v <= 8.01 * A + 0.0001 * vanishing).
  { eapply Rle_trans; [apply norm_below_sum|]. unfold sum3; cbn [v]. lra. }
  split; [|split; [apply high|lra]].
  pose proof (norm_sum v (fun a => exact_normal i a - v a)) as tri. cbv beta in tri.
  replace (norm (fun a => v a + (exact_normal i a - v a))) with (norm (exact_normal i)) in tri.
  2: { unfold norm. f_equal. unfold squared, sum3. ring. }
  pose proof (norm_below_sum (fun a => exact_normal i a - v a)) as off. unfold sum3 in off. cbn [v] in off.
  rewrite (Rabs_minus_sym (exact_normal i X_)), (Rabs_minus_sym (exact_normal i Y_)), (Rabs_minus_sym (exact_normal i
    Z_)) in off. lra.
Qed.
End Bars.
