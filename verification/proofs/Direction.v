(* A direction along which one set stays ahead of the other at both ends of the step: its signs, computed from a rounded direction. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Geometry Corners.
From Selvedge Require Orders Apart.
Open Scope R_scope.

(* The code in words: core/src/kernels/vector.rs, core/src/boxes/direction.rs. *)
Record vector := Vector { along_x : number; along_y : number; along_z : number }.
Definition leaf s t := Vector (Difference (Span s t X)) (Difference (Span s t Y)) (Difference (Span s t Z_)).
Definition by_components (op : number -> number -> number) a b :=
  Vector (op (along_x a) (along_x b)) (op (along_y a) (along_y b)) (op (along_z a) (along_z b)).
Definition magnitudes a := Vector (Magnitude (along_x a)) (Magnitude (along_y a)) (Magnitude (along_z a)).
Definition largest a := Larger (Larger (along_x a) (along_y a)) (along_z a).
Definition product a b := Sum (Sum (Product (along_x a) (along_x b)) (Product (along_y a) (along_y b))) (Product (along_z a) (along_z b)).
Definition crossed a b := Vector
  (Minus (Product (along_y a) (along_z b)) (Product (along_z a) (along_y b)))
  (Minus (Product (along_z a) (along_x b)) (Product (along_x a) (along_z b)))
  (Minus (Product (along_x a) (along_y b)) (Product (along_y a) (along_x b))).
Definition of_four {T} (op : T -> T -> T) (of : span -> T) (corner : nat -> span) :=
  op (op (of (corner 0%nat)) (of (corner 1%nat))) (op (of (corner 2%nat)) (of (corner 3%nat))).
Definition of_eight {T} (op : T -> T -> T) (of : span -> time -> T) corner :=
  op (of_four op (fun s => of s Start) corner) (of_four op (fun s => of s End) corner).
Definition zero_of a : number := Minus a a.

Section Words.
Variable corner : nat -> span.
Variable w : vector.
Definition extents := of_eight (by_components Larger) (fun s t => magnitudes (leaf s t)) corner.
Definition ahead s t := product (leaf s t) w.
Definition sizes_ := product extents (magnitudes w).
Definition least := of_eight Smaller ahead corner.
Definition greatest := of_eight Larger ahead corner.
Definition zero := Sum (zero_of (of_four Sum (fun s => ahead s Start) corner)) (zero_of (of_four Sum (fun s => ahead s End) corner)).
Definition of_rounding := Product (Product (Constant (Small 8)) (Constant UnitRoundoff)) sizes_.
Definition of_underflow := Product (Sum (largest (magnitudes w)) (Constant (Small 1))) (Constant Underflow).
Definition bound := Sum (Sum of_rounding of_underflow) zero.
Definition apart_along := Both (Either (Greater least bound) (Greater (Negative bound) greatest))
  (Greater (Constant LargestEdge) (largest extents)).
End Words.

Definition corners_of_a_vertex_and_a_face n := match n with 0%nat | 1%nat => S0 | 2%nat => S3 | _ => S4 end.
Definition corners_of_two_edges n := match n with 0%nat => S0 | 1%nat => S3 | 2%nat => S1 | _ => S4 end.
Definition normal_of_a_face := by_components Sum (crossed (leaf S1 Start) (leaf S2 Start)) (crossed (leaf S1 End) (leaf S2 End)).
Definition normal_of_two_edges := by_components Sum
  (crossed (by_components Minus (leaf S1 Start) (leaf S0 Start)) (leaf S2 Start))
  (crossed (by_components Minus (leaf S1 End) (leaf S0 End)) (leaf S2 End)).
Lemma the_code_of_a_vertex_and_a_face : a_vertex_and_a_face.culled_by_normal = apart_along corners_of_a_vertex_and_a_face normal_of_a_face.
Proof. reflexivity. Qed.
Lemma the_code_of_two_edges : two_edges.culled_by_normal = apart_along corners_of_two_edges normal_of_two_edges.
Proof. reflexivity. Qed.

(* One environment for all of a pair's products: an operand below the normal numbers counts as zero in all of them, or in none. Were w to
   count as zero beside one point and not beside another, there would be no direction that the signs are of. *)
Definition seen_as f (flushes : bool) x := if flushes then Orders.flushed f x else x.
Definition products_alike f flushes (value_of : number -> value) := forall a b x y, value_of a = Number x -> value_of b = Number y ->
  result f (seen_as f flushes x * seen_as f flushes y) (value_of (Product a b)).

Section Signs.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : span_component -> R.
Variable value_of : number -> value.
Hypothesis run : execution f from to value_of.
Variable flushes : bool.
Hypothesis alike : products_alike f flushes value_of.
Notation val := (val value_of).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).
Notation D := (exactly from to).
Notation seen := (seen_as f flushes).
Notation l_pos := (l0 f). Notation l_small := (l1 f ok). Notation e_pos := (e0 f). Notation e_small := (e_le f ok).
Implicit Types a b e : number.

Lemma seen_counts x : counts_as f x (seen x).
Proof.
  unfold seen_as, Orders.flushed. destruct flushes; [|now left]. destruct (Rlt_dec _ _); [right|left]; auto.
Qed.
Lemma seen_magnitude x : seen (Rabs x) = Rabs (seen x).
Proof.
  unfold seen_as, Orders.flushed. destruct flushes; [|reflexivity]. rewrite Rabs_Rabsolu. destruct (Rlt_dec _ _); [|reflexivity].
  now rewrite Rabs_R0.
Qed.
Lemma seen_large x : 0 <= x -> Rmax x l <= seen x + l.
Proof.
  pose proof l_pos. intro p. unfold seen_as, Orders.flushed. destruct flushes; [destruct (Rlt_dec _ _) as [small|]|].
  - rewrite Rabs_pos_eq in small by assumption. rewrite Rmax_right; lra.
  - unfold Rmax. destruct (Rle_dec _ _); lra.
  - unfold Rmax. destruct (Rle_dec _ _); lra.
Qed.

Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation number_ := (is_number f ok from to value_of run in_range).
Notation step_of := (step_of f ok from to value_of run in_range).
Notation d := (computed value_of).
(* What a product gives. *)
Lemma product_step a b : fits (Product a b) = true -> rounds f (seen (val a) * seen (val b)) (val (Product a b)).
Proof.
  intro fit. destruct (fits_product a b fit) as [fa fb].
  pose proof (alike a b _ _ (number_ a fa) (number_ b fb)) as r.
  destruct (sizes f ok from to value_of run in_range a fa) as (x & vx & bx & _).
  destruct (sizes f ok from to value_of run in_range b fb) as (y & vy & by_ & _).
  assert (val a = x) as E by (unfold Errors.val; now rewrite vx). assert (val b = y) as E' by (unfold Errors.val; now rewrite vy).
  rewrite <- E in bx. rewrite <- E' in by_.
  pose proof (counts_smaller f _ _ (seen_counts (val a))). pose proof (counts_smaller f _ _ (seen_counts (val b))).
  pose proof (size_pos a); pose proof (size_pos b). pose proof (pow_pos_L f ok (degree a + degree b)).
  assert (target : 2 * ((IZR (size a) * reach f ^ degree a) * (IZR (size b) * reach f ^ degree b)) + 1
    <= IZR (size (Product a b)) * reach f ^ degree (Product a b)).
  { cbn [size degree]. rewrite plus_IZR, !mult_IZR. rewrite pow_add in *. nra. }
  cbn [fits] in fit. apply andb_prop in fit as [here _]. apply andb_prop in here as [s_le d_le]. apply Z.leb_le in s_le. apply Nat.leb_le in d_le.
  destruct (result_is_number f ok _ _ ((IZR (size a) * reach f ^ degree a) * (IZR (size b) * reach f ^ degree b)) r) as (z & vz & rounded & _).
  - rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; lra.
  - eapply Rle_trans; [exact target|]. eapply (fits_bound f ok); eauto. apply Z.le_refl.
  - unfold Errors.val at 3. rewrite vz. exact rounded.
Qed.

(* The largest of some, whose magnitudes it bounds. *)
Lemma magnitude_value a : fits a = true -> value_of (Magnitude a) = Number (Rabs (val a)).
Proof. intro fit. pose proof (run (Magnitude a)) as v. simpl in v. now rewrite v, (number_ a fit). Qed.
Lemma larger_bounds a b B : fits (Larger a b) = true -> l <= B -> val (Larger a b) <= B -> val a <= B /\ val b <= B.
Proof.
  intros fit lB most. destruct (fits_larger a b fit) as [fa fb]. pose proof (run (Larger a b)) as v. simpl in v.
  rewrite (number_ a fa), (number_ b fb), (number_ _ fit) in v.
  apply (larger_at_most f) with (B := B) in v; [|discriminate|discriminate|assumption|exact most]. exact v.
Qed.
Lemma larger_pos a b : fits (Larger a b) = true -> 0 <= val a -> 0 <= val b -> 0 <= val (Larger a b).
Proof.
  intros fit pa pb. destruct (fits_larger a b fit) as [fa fb]. pose proof (run (Larger a b)) as v. simpl in v.
  rewrite (number_ a fa), (number_ b fb) in v. unfold Errors.val at 1.
  destruct v as (v' & w' & _ & _ & [[_ c]|[_ c]]); try discriminate; destruct (counts_val f _ _ _ eq_refl c) as (r & -> & [-> |[_ ->]]); lra.
Qed.

(* A sum of values that are not negative, but for underflow. *)
Lemma sum_from_below a b p q : fits (Sum a b) = true -> 0 <= p -> 0 <= q -> forall c k, 0 <= c <= 10000 -> 0 <= k <= 10000 ->
  p - c * l <= val a -> q - k * l <= val b -> (1 - e1) * (p + q) - (c + k + 4) * l <= val (Sum a b).
Proof.
  intros fit p0 q0 c k c0 k0 A B. destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof l_pos. pose proof e_pos. pose proof e_small.
  apply counts_error in cx. apply counts_error in cy. apply Rabs_le_inv in cx. apply Rabs_le_inv in cy.
  pose proof (rounding_error f ok _ _ r) as E. apply Rabs_le_inv in E.
  assert (z : p + q - (c + k + 2) * l <= x + y) by lra.
  assert (cl : 0 <= (c + k + 2) * l) by (apply Rmult_le_pos; lra).
  assert (e1 * ((c + k + 2) * l) <= / 8388608 * ((c + k + 2) * l)) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * ((c + k + 2) * l)) by (apply Rmult_le_pos; lra).
  assert ((c + k + 2) * l <= 20002 * l) by (apply Rmult_le_compat_r; lra).
  destruct (Rle_lt_dec 0 (x + y)) as [pos|neg].
  - rewrite Rabs_pos_eq in E by assumption. assert (0 <= (1 - e1) * (x + y - (p + q - (c + k + 2) * l))) by (apply Rmult_le_pos; lra). lra.
  - rewrite Rabs_left in E by assumption. assert (e1 * - (x + y) <= e1 * ((c + k + 2) * l)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= e1 * (p + q)) by (apply Rmult_le_pos; lra). lra.
Qed.

(* One corner's product with w, before its last rounding, against the exact one with what w counts as. *)
Section OfADirection.
Variable corner : nat -> span.
Variable w : vector.
Definition W_ := Rmax (val (largest (magnitudes w))) l.
Definition counted a := seen (val a).
Definition component_of a b c (g : R) := Rabs (counted a) * g + Rabs (counted b) * g + Rabs (counted c) * g.
(* The exact product. *)
Definition exact_ahead s t := counted (along_x w) * D (Span s t X) + counted (along_y w) * D (Span s t Y) + counted (along_z w) * D (Span s t Z_).
Hypothesis bound_fits : fits (bound corner w) = true.
Hypothesis least_fits : fits (least corner w) = true.
Hypothesis greatest_fits : fits (greatest corner w) = true.

Lemma W_large : l <= W_. Proof. apply Rmax_r. Qed.
(* w's components, at most W_. *)
Lemma underflow_fits : fits (of_underflow w) = true /\ fits (of_rounding corner w) = true /\ fits (zero corner w) = true.
Proof.
  destruct (fits_sum _ _ bound_fits) as [a c]. destruct (fits_sum _ _ a) as [b e]. auto.
Qed.
Lemma widths : fits (largest (magnitudes w)) = true.
Proof.
  destruct underflow_fits as [a _]. destruct (fits_product _ _ a) as [b _]. now destruct (fits_sum _ _ b).
Qed.
Lemma magnitudes_fit : (fits (Larger (Magnitude (along_x w)) (Magnitude (along_y w))) = true /\ fits (Magnitude (along_z w)) = true) /\
  (fits (Magnitude (along_x w)) = true /\ fits (Magnitude (along_y w)) = true).
Proof.
  pose proof (fits_larger _ _ widths) as P. split; [exact P|]. destruct P as [P _]. exact (fits_larger _ _ P).
Qed.
Lemma of_magnitude a : fits (Magnitude a) = true -> fits a = true.
Proof. cbn [fits]. intro h. apply andb_prop in h as [_ h]. exact h. Qed.
Lemma magnitude_val a : fits (Magnitude a) = true -> val (Magnitude a) = Rabs (val a).
Proof. intro fit. unfold Errors.val at 1. now rewrite (magnitude_value a (of_magnitude a fit)). Qed.
Lemma w_small : Rabs (val (along_x w)) <= W_ /\ Rabs (val (along_y w)) <= W_ /\ Rabs (val (along_z w)) <= W_.
Proof.
  destruct magnitudes_fit as [[xy z] [x y]].
  destruct (larger_bounds _ _ W_ widths (Rmax_r _ _) (Rmax_l _ _)) as [A B]. destruct (larger_bounds _ _ W_ xy (Rmax_r _ _) A) as [E F].
  cbn [magnitudes along_x along_y along_z] in *. rewrite magnitude_val in B, E, F by assumption. auto.
Qed.
Lemma W_pos : 0 <= val (largest (magnitudes w)).
Proof.
  destruct magnitudes_fit as [[xy z] [x y]]. apply larger_pos; [exact widths|apply larger_pos; [exact xy| |]|];
    cbn [magnitudes along_x along_y along_z]; rewrite magnitude_val by assumption; apply Rabs_pos.
Qed.
Lemma counted_small a : Rabs (counted a) <= Rabs (val a).
Proof. exact (counts_smaller f _ _ (seen_counts _)). Qed.

(* The bound. *)
Lemma constant_ c : val (Constant c) = constant_value f c.
Proof. exact (constant f from to value_of run c). Qed.
Lemma large_underflow : 510 * l * (W_ + 1) <= val (of_underflow w).
Proof.
  destruct underflow_fits as [fit _]. destruct (fits_product _ _ fit) as [fs _]. pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small.
  destruct (step_of _ fs) as (x & y & cx & cy & r). destruct (step_of _ fit) as (a & b & ca & cb & r2).
  rewrite constant_ in cy, cb. cbn [constant_value] in cy, cb. pose proof (eta_large f ok) as eta. pose proof W_pos as W0.
  apply (unflushed f) in cy; [|lra]. apply (unflushed f) in cb; [|lra]. subst y b.
  apply counts_error in cx. apply Rabs_le_inv in cx.
  assert (W_ <= val (largest (magnitudes w)) + l) by (unfold W_; apply Rmax_lub; lra).
  pose proof (rounds_below f ok _ _ r ltac:(lra)) as low. set (Wr := val (largest (magnitudes w))) in *.
  assert (e1 * (x + 1) <= / 8388608 * (x + 1)) by (apply Rmult_le_compat_r; lra).
  apply (unflushed f) in ca; [|lra]. subst a. set (s := val (Sum _ _)) in *.
  assert (large : (1 - / 1000000) * (W_ + 1) <= s) by lra.
  pose proof W_large.
  assert (z : (1 - / 1000000) * (W_ + 1) * (512 * l) <= s * power (Arithmetic.underflow f)) by (apply Rmult_le_compat; lra).
  assert (0 <= W_ * l) by (apply Rmult_le_pos; lra).
  pose proof (rounds_below f ok _ _ r2 ltac:(lra)) as low2. fold (of_underflow w) in low2. set (Z_ := s * power (Arithmetic.underflow f)) in *.
  assert (e1 * Z_ <= / 8388608 * Z_) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma small_zero_of a : fits (zero_of a) = true -> Rabs (val (zero_of a)) <= 4 * l.
Proof.
  intro fit. destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof l_pos. pose proof e_pos. pose proof e_small.
  apply counts_error in cx. apply counts_error in cy. pose proof (rounding_error f ok _ _ r) as E.
  assert (small : Rabs (x - y) <= 2 * l).
  { replace (x - y) with ((x - val a) - (y - val a)) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (e1 * Rabs (x - y) <= e1 * (2 * l)) by (apply Rmult_le_compat_l; lra). assert (e1 * (2 * l) <= / 8388608 * (2 * l)) by (apply Rmult_le_compat_r; lra).
  fold (zero_of a) in E. replace (val (zero_of a)) with ((val (zero_of a) - (x - y)) + (x - y)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.
Lemma small_zero : - (12 * l) <= val (zero corner w).
Proof.
  destruct underflow_fits as (_ & _ & fit). destruct (fits_sum _ _ fit) as [fa fb].
  destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof l_pos. pose proof e_pos. pose proof e_small.
  pose proof (small_zero_of _ fa) as A. pose proof (small_zero_of _ fb) as B.
  apply counts_error in cx. apply counts_error in cy. apply Rabs_le_inv in cx. apply Rabs_le_inv in cy. apply Rabs_le_inv in A. apply Rabs_le_inv in B.
  pose proof (rounding_error f ok _ _ r) as E.
  assert (small : Rabs (x + y) <= 10 * l) by (apply Rabs_le; lra).
  assert (e1 * Rabs (x + y) <= e1 * (10 * l)) by (apply Rmult_le_compat_l; lra). assert (e1 * (10 * l) <= / 8388608 * (10 * l)) by (apply Rmult_le_compat_r; lra).
  apply Rabs_le_inv in E. apply Rabs_le_inv in small. fold (zero corner w) in E. lra.
Qed.

(* Sizes: the extents as they count, times w as it counts. *)
Notation extent_x := (val (along_x (extents corner))).
Notation extent_y := (val (along_y (extents corner))).
Notation extent_z := (val (along_z (extents corner))).
Definition size_seen := Rabs (counted (along_x w)) * seen extent_x + Rabs (counted (along_y w)) * seen extent_y + Rabs (counted (along_z w)) * seen extent_z.
Lemma sizes_fits : fits (sizes_ corner w) = true.
Proof. destruct underflow_fits as (_ & fit & _). now destruct (fits_product _ _ fit). Qed.
Lemma extents_fit : fits (along_x (extents corner)) = true /\ fits (along_y (extents corner)) = true /\ fits (along_z (extents corner)) = true.
Proof.
  destruct (fits_sum _ _ sizes_fits) as [a b]. destruct (fits_sum _ _ a) as [a1 a2].
  split; [exact (proj1 (fits_product _ _ a1))|]. split; [exact (proj1 (fits_product _ _ a2))|exact (proj1 (fits_product _ _ b))].
Qed.
Lemma extents_are_maxima : maxima (along_x (extents corner)) = true /\ maxima (along_y (extents corner)) = true /\ maxima (along_z (extents corner)) = true.
Proof. repeat split; reflexivity. Qed.
Lemma extents_pos : 0 <= extent_x /\ 0 <= extent_y /\ 0 <= extent_z.
Proof.
  destruct extents_are_maxima as (a & b & c). destruct extents_fit as (a' & b' & c').
  repeat split; apply (maxima_pos f ok from to value_of run in_range); assumption.
Qed.
Lemma seen_pos x : 0 <= x -> 0 <= seen x.
Proof. intro p. unfold seen_as, Orders.flushed. destruct flushes; [|exact p]. destruct (Rlt_dec _ _); lra. Qed.
Lemma one_size a b : fits (Product a (Magnitude b)) = true -> 0 <= val a ->
  0 <= Rabs (counted b) * seen (val a) /\ Rabs (counted b) * seen (val a) * (1 - e1) - 1 * l <= val (Product a (Magnitude b)).
Proof.
  intros fit p. destruct (fits_product _ _ fit) as [_ fb]. pose proof (product_step a (Magnitude b) fit) as r. rewrite magnitude_val in r by exact fb.
  rewrite seen_magnitude in r. fold (counted b) in r. pose proof (seen_pos _ p). pose proof (Rabs_pos (counted b)).
  assert (z : 0 <= seen (val a) * Rabs (counted b)) by (now apply Rmult_le_pos).
  pose proof (rounds_below f ok _ _ r z). split; lra.
Qed.
Lemma size_seen_pos : 0 <= size_seen.
Proof.
  destruct extents_pos as (X0 & Y0 & Z0). unfold size_seen. pose proof (seen_pos _ X0). pose proof (seen_pos _ Y0). pose proof (seen_pos _ Z0).
  repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; auto using Rabs_pos.
Qed.
Lemma large_sizes : (1 - 4 * e1) * size_seen - 20 * l <= val (sizes_ corner w).
Proof.
  pose proof sizes_fits as fit. destruct (fits_sum _ _ fit) as [fa fb]. destruct (fits_sum _ _ fa) as [f1 f2].
  destruct extents_pos as (X0 & Y0 & Z0). pose proof l_pos. pose proof e_pos. pose proof e_small.
  destruct (one_size _ _ f1 X0) as [x0 X1]. destruct (one_size _ _ f2 Y0) as [y0 Y1]. destruct (one_size _ _ fb Z0) as [z0 Z1].
  unfold size_seen. set (x := Rabs (counted (along_x w)) * seen extent_x) in *. set (y := Rabs (counted (along_y w)) * seen extent_y) in *.
  set (z := Rabs (counted (along_z w)) * seen extent_z) in *.
  assert (0 <= 1 - e1) by lra.
  assert (xp : 0 <= x * (1 - e1)) by (apply Rmult_le_pos; lra). assert (yp : 0 <= y * (1 - e1)) by (apply Rmult_le_pos; lra).
  assert (zp : 0 <= z * (1 - e1)) by (apply Rmult_le_pos; lra).
  pose proof (sum_from_below _ _ _ _ fa xp yp 1 1 ltac:(lra) ltac:(lra) X1 Y1) as S1.
  assert (sp : 0 <= (1 - e1) * (x * (1 - e1) + y * (1 - e1))) by (apply Rmult_le_pos; lra).
  pose proof (sum_from_below _ _ _ _ fit sp zp (1 + 1 + 4) 1 ltac:(lra) ltac:(lra) S1 Z1) as S2.
  match type of S2 with ?a <= _ => change (a <= val (sizes_ corner w)) in S2 end.
  assert (e2 : 0 <= e1 * e1) by (apply Rmult_le_pos; lra). assert (e3 : 0 <= e1 * e1 * (3 - e1)) by (apply Rmult_le_pos; lra).
  assert (sq : 1 - 3 * e1 <= (1 - e1) * (1 - e1) * (1 - e1)) by lra. assert (sq2 : 1 - 3 * e1 <= (1 - e1) * (1 - e1)) by lra.
  assert ((1 - 3 * e1) * (x + y) <= (1 - e1) * (1 - e1) * (1 - e1) * (x + y)) by (apply Rmult_le_compat_r; lra).
  assert ((1 - 3 * e1) * z <= (1 - e1) * (1 - e1) * z) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * (x + y + z)) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma large_rounding : 3.999 * e1 * size_seen - 3 * l <= val (of_rounding corner w).
Proof.
  destruct underflow_fits as (_ & fit & _). destruct (fits_product _ _ fit) as [fc _]. pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small.
  destruct (step_of _ fc) as (x & y & cx & cy & r). destruct (step_of _ fit) as (a & b & ca & cb & r2).
  rewrite !constant_ in *. cbn [constant_value] in cx, cy. pose proof (u_large f ok). pose proof (u_small f ok). pose proof (eps_twice f) as twice.
  apply (unflushed f) in cx; [|lra]. apply (unflushed f) in cy; [|lra]. subst x y.
  pose proof (rounding_error f ok _ _ r) as E. rewrite (Rabs_pos_eq (8 * u)) in E by lra. apply Rabs_le_inv in E.
  assert (e1 * (8 * u) <= / 8388608 * (8 * u)) by (apply Rmult_le_compat_r; lra).
  set (C := val (Product (Constant (Small 8)) (Constant UnitRoundoff))) in *.
  assert (C1 : 7.9999 * u <= C <= 9 * u) by lra.
  apply (unflushed f) in ca; [|lra]. subst a. apply counts_error in cb. apply Rabs_le_inv in cb.
  pose proof large_sizes as S_. pose proof size_seen_pos as S0. pose proof (rounding_error f ok _ _ r2) as E2. apply Rabs_le_inv in E2.
  fold (of_rounding corner w) in E2. set (t := size_seen) in *.
  assert (b_low : (1 - 4 * e1) * t - 21 * l <= b) by lra.
  assert (C * ((1 - 4 * e1) * t - 21 * l) <= C * b) by (apply Rmult_le_compat_l; lra).
  assert (C * (21 * l) <= / 1000 * (21 * l)) by (apply Rmult_le_compat_r; lra).
  assert (t4 : (1 - / 1000000) * t <= (1 - 4 * e1) * t) by (apply Rmult_le_compat_r; lra).
  assert (t5 : 0 <= (1 - / 1000000) * t) by (apply Rmult_le_pos; lra).
  assert (7.9999 * u * ((1 - / 1000000) * t) <= C * ((1 - 4 * e1) * t)) by (apply Rmult_le_compat; lra).
  assert (0 <= u * t) by (apply Rmult_le_pos; lra).
  assert (z : 7.999 * (u * t) - / 10 * l <= C * b) by lra.
  rewrite twice. destruct (Rle_lt_dec 0 (C * b)) as [pos|neg].
  - rewrite (Rabs_pos_eq (C * b)) in E2 by assumption. assert (e1 * (C * b) <= / 8388608 * (C * b)) by (apply Rmult_le_compat_r; lra). lra.
  - rewrite Rabs_left in E2 by assumption. assert (e1 * - (C * b) <= / 8388608 * - (C * b)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma large_bound : 3.99 * e1 * size_seen + 400 * l * (W_ + 1) <= val (bound corner w).
Proof.
  destruct (fits_sum _ _ bound_fits) as [fa _]. destruct (step_of _ fa) as (x & y & cx & cy & r). destruct (step_of _ bound_fits) as (a & b & ca & cb & r2).
  pose proof l_pos. pose proof e_pos. pose proof e_small. pose proof large_rounding as A. pose proof large_underflow as B. pose proof small_zero as C.
  pose proof size_seen_pos as S0. pose proof W_large.
  apply counts_error in cx. apply counts_error in cy. apply counts_error in ca. apply counts_error in cb.
  apply Rabs_le_inv in cx. apply Rabs_le_inv in cy. apply Rabs_le_inv in ca. apply Rabs_le_inv in cb.
  assert (lw : 0 <= l * W_) by (apply Rmult_le_pos; lra). assert (et : 0 <= e1 * size_seen) by (apply Rmult_le_pos; lra).
  pose proof (rounds_below f ok _ _ r ltac:(lra)) as low. assert (e1 * (x + y) <= / 8388608 * (x + y)) by (apply Rmult_le_compat_r; lra).
  pose proof (rounds_below f ok _ _ r2 ltac:(lra)) as low2. fold (bound corner w) in low2.
  assert (e1 * (a + b) <= / 8388608 * (a + b)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* One corner. *)
Lemma one_product c b M : fits (Product (Difference c) b) = true -> 0 <= M -> Rabs (d c) <= Rmax M l -> Rabs (val b) <= W_ ->
  0 <= Rabs (counted b) * seen M /\
  Rabs (val (Product (Difference c) b) - counted b * D c) <= 2 * e1 * (Rabs (counted b) * seen M) + 5 * l * W_ + l /\
  Rabs (val (Product (Difference c) b)) <= (1 + e1) * (Rabs (counted b) * seen M) + 2 * l * W_ + l.
Proof.
  intros fit M0 small bW. pose proof (product_step (Difference c) b fit) as r. fold (counted b) in r. fold (d c) in r.
  pose proof l_pos. pose proof e_pos. pose proof e_small. pose proof W_large. pose proof (seen_pos M M0) as m0. pose proof (seen_large M M0) as mM.
  pose proof (counts_error f _ _ (seen_counts (d c))) as near. pose proof (counts_smaller f _ _ (seen_counts (d c))) as less.
  pose proof (off f ok from to value_of run in_range c) as of_d. pose proof (counted_small b) as cb. pose proof (Rabs_pos (counted b)) as b0.
  set (p := val (Product (Difference c) b)) in *. set (e := seen (d c)) in *. set (k := counted b) in *. set (m := seen M) in *.
  assert (e_le : Rabs e <= m + l) by lra. assert (d_le : Rabs (d c) <= m + l) by lra.
  assert (km : 0 <= Rabs k * m) by (apply Rmult_le_pos; lra). assert (kl : Rabs k * l <= W_ * l) by (apply Rmult_le_compat_r; lra).
  assert (kl0 : 0 <= Rabs k * l) by (apply Rmult_le_pos; lra). assert (lW : e1 * (W_ * l) <= / 8388608 * (W_ * l)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos|]; lra).
  assert (ekl : e1 * (Rabs k * l) <= e1 * (W_ * l)) by (apply Rmult_le_compat_l; lra).
  assert (far : Rabs (e - D c) <= e1 * m + 4 * l + e1 * l).
  { replace (e - D c) with ((e - d c) + - (D c - d c)) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
    assert (e1 * Rabs (d c) <= e1 * (m + l)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (ek : Rabs (e * k) <= Rabs k * m + Rabs k * l).
  { rewrite Rabs_mult. assert (Rabs e * Rabs k <= (m + l) * Rabs k) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (rounding_error f ok _ _ r) as E. assert (e1 * Rabs (e * k) <= e1 * (Rabs k * m + Rabs k * l)) by (apply Rmult_le_compat_l; lra).
  split; [exact km|]. split.
  - replace (p - k * D c) with ((p - e * k) + k * (e - D c)) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_mult k).
    assert (Rabs k * Rabs (e - D c) <= Rabs k * (e1 * m + 4 * l + e1 * l)) by (apply Rmult_le_compat_l; lra). lra.
  - replace p with ((p - e * k) + e * k) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.
Lemma near s t : fits (ahead w s t) = true -> Rabs (d (Span s t X)) <= Rmax extent_x l -> Rabs (d (Span s t Y)) <= Rmax extent_y l ->
  Rabs (d (Span s t Z_)) <= Rmax extent_z l ->
  exists z, rounds f z (val (ahead w s t)) /\ Rabs (z - exact_ahead s t) <= 3.01 * e1 * size_seen + 100 * l * (W_ + 1).
Proof.
  intros fit x_le y_le z_le. destruct (fits_sum _ _ fit) as [fa fz]. destruct (fits_sum _ _ fa) as [fx fy].
  destruct (step_of _ fa) as (x & y & cx & cy & r). destruct (step_of _ fit) as (a & b & ca & cb & r2).
  exists (a + b). split; [exact r2|]. destruct extents_pos as (X0 & Y0 & Z0). destruct w_small as (wx & wy & wz).
  destruct (one_product _ _ _ fx X0 x_le wx) as (px & ex & bx). destruct (one_product _ _ _ fy Y0 y_le wy) as (py & ey & by_).
  destruct (one_product _ _ _ fz Z0 z_le wz) as (pz & ez & bz). pose proof l_pos. pose proof e_pos. pose proof e_small. pose proof W_large.
  apply counts_error in cx. apply counts_error in cy. apply counts_error in ca. apply counts_error in cb.
  pose proof (rounding_error f ok _ _ r) as E. unfold size_seen, exact_ahead.
  set (tx := Rabs (counted (along_x w)) * seen extent_x) in *. set (ty := Rabs (counted (along_y w)) * seen extent_y) in *.
  set (tz := Rabs (counted (along_z w)) * seen extent_z) in *.
  set (dx := counted (along_x w) * D (Span s t X)) in *. set (dy := counted (along_y w) * D (Span s t Y)) in *.
  set (dz := counted (along_z w) * D (Span s t Z_)) in *.
  set (vx := val (Product (Difference (Span s t X)) (along_x w))) in *. set (vy := val (Product (Difference (Span s t Y)) (along_y w))) in *.
  set (vz := val (Product (Difference (Span s t Z_)) (along_z w))) in *.
  match type of E with Rabs (?v - _) <= _ => set (sum := v) in * end.
  change (Rabs (a - sum) <= l) in ca. change (Rabs (b - vz) <= l) in cb. change (Rabs (x - vx) <= l) in cx. change (Rabs (y - vy) <= l) in cy.
  assert (xy : Rabs (x + y) <= Rabs vx + Rabs vy + 2 * l).
  { replace (x + y) with (((x - vx) + (y - vy)) + (vx + vy)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    eapply Rle_trans; [apply Rplus_le_compat; apply Rabs_triang|]. lra. }
  assert (exy : e1 * Rabs (x + y) <= e1 * (Rabs vx + Rabs vy + 2 * l)) by (apply Rmult_le_compat_l; lra).
  assert (lW : 0 <= l * W_) by (apply Rmult_le_pos; lra).
  assert (e1 * (Rabs vx + Rabs vy + 2 * l) <= e1 * ((1 + e1) * (tx + ty) + 4 * l * W_ + 4 * l)) by (apply Rmult_le_compat_l; lra).
  assert (e1 * (4 * l * W_ + 4 * l) <= / 8388608 * (4 * l * W_ + 4 * l)) by (apply Rmult_le_compat_r; lra).
  assert (et : 0 <= e1 * (tx + ty)) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * (tx + ty)) <= / 8388608 * (e1 * (tx + ty))) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * tz) by (apply Rmult_le_pos; lra).
  apply Rabs_le_inv in ca, cb, cx, cy, ex, ey, ez, E. apply Rabs_le. lra.
Qed.

Definition component_along k (v : vector) := match k with X => along_x v | Y => along_y v | Z_ => along_z v end.
Hypothesis corners_occur : forall i t k, (i < 4)%nat -> occurs (Span (corner i) t k) (component_along k (extents corner)) = true.
Lemma sign i t : (i < 4)%nat -> fits (ahead w (corner i) t) = true ->
  (val (bound corner w) < val (ahead w (corner i) t) -> 0 < exact_ahead (corner i) t) /\
  (val (ahead w (corner i) t) < - val (bound corner w) -> exact_ahead (corner i) t < 0).
Proof.
  intros small fit. destruct extents_are_maxima as (mx & my & mz). destruct extents_fit as (fx & fy & fz).
  assert (at_most_ : forall k, maxima (component_along k (extents corner)) = true -> fits (component_along k (extents corner)) = true ->
    Rabs (d (Span (corner i) t k)) <= Rmax (val (component_along k (extents corner))) l).
  { intros k M F. apply (maxima_bound f ok from to value_of run in_range); auto. }
  destruct (near (corner i) t fit (at_most_ X mx fx) (at_most_ Y my fy) (at_most_ Z_ mz fz)) as (z & r & E).
  pose proof large_bound as B. pose proof l_pos. pose proof e_pos. pose proof size_seen_pos as S0. pose proof W_large.
  assert (0 <= e1 * size_seen) by (apply Rmult_le_pos; lra). assert (0 <= l * W_) by (apply Rmult_le_pos; lra).
  assert (rep : representable f (val (bound corner w))).
  { destruct (step_of _ bound_fits) as (x & y & _ & _ & rounded). exact (result_is_representable f ok _ _ rounded). }
  apply Rabs_le_inv in E. split; intro beyond_.
  - pose proof (above_before_rounding f ok _ _ _ r rep ltac:(lra) beyond_). lra.
  - pose proof (below_before_rounding f ok _ _ _ r rep ltac:(lra) beyond_). lra.
Qed.

(* The decision. *)
(* What a least value exceeds, all do; and what a greatest one stays below. *)
Definition exceeds B a := fits a = true /\ B <= val a.
Definition stays_below B a := fits a = true /\ val a <= - B.
Lemma both_exceed B a b : l <= B -> exceeds B (Smaller a b) -> exceeds B a /\ exceeds B b.
Proof.
  intros big [fit e]. destruct (fits_smaller a b fit). destruct (smaller_both f ok from to value_of run in_range a b fit ltac:(lra)).
  split; split; auto; lra.
Qed.
Lemma both_stay_below B a b : l <= B -> stays_below B (Larger a b) -> stays_below B a /\ stays_below B b.
Proof.
  intros big [fit e]. destruct (fits_larger a b fit). destruct (larger_both f ok from to value_of run in_range a b fit ltac:(lra)).
  split; split; auto; lra.
Qed.
Lemma all_eight (op : number -> number -> number) (P : number -> Prop) of : (forall a b, P (op a b) -> P a /\ P b) -> P (of_eight op of corner) ->
  forall i t, (i < 4)%nat -> P (of (corner i) t).
Proof.
  intros both all i t small. destruct (both _ _ all) as [start finish_]. destruct (both _ _ start) as [a b]. destruct (both _ _ finish_) as [a' b'].
  destruct (both _ _ a), (both _ _ b), (both _ _ a'), (both _ _ b').
  destruct i as [|[|[|[|i]]]]; destruct t; try assumption; lia.
Qed.
Theorem one_side : says f value_of (Either (Greater (least corner w) (bound corner w)) (Greater (Negative (bound corner w)) (greatest corner w))) ->
  (forall i t, (i < 4)%nat -> 0 < exact_ahead (corner i) t) \/ (forall i t, (i < 4)%nat -> exact_ahead (corner i) t < 0).
Proof.
  pose proof large_bound as B. pose proof l_pos. pose proof e_pos. pose proof size_seen_pos as S0. pose proof W_large.
  assert (0 <= e1 * size_seen) by (apply Rmult_le_pos; lra). assert (0 <= l * W_) by (apply Rmult_le_pos; lra).
  cbn [says]. intros [above | below_].
  - left. intros i t small. rewrite (number_ _ least_fits), (number_ _ bound_fits) in above. apply greater_above in above; [|lra].
    assert (e : exceeds (val (least corner w)) (least corner w)) by (split; [exact least_fits|lra]).
    destruct (all_eight Smaller (exceeds (val (least corner w))) (ahead w) (fun a b => both_exceed (val (least corner w)) a b ltac:(lra)) e i t small) as [fit more].
    apply (proj1 (sign i t small fit)). lra.
  - right. intros i t small. pose proof (run (Negative (bound corner w))) as v. simpl in v. rewrite (number_ _ bound_fits) in v. simpl in v.
    rewrite v, (number_ _ greatest_fits) in below_. apply greater_below in below_; [|lra].
    assert (e : stays_below (- val (greatest corner w)) (greatest corner w)) by (split; [exact greatest_fits|lra]).
    destruct (all_eight Larger (stays_below (- val (greatest corner w))) (ahead w) (fun a b => both_stay_below (- val (greatest corner w)) a b ltac:(lra)) e i t small) as [fit less].
    apply (proj2 (sign i t small fit)). lra.
Qed.
End OfADirection.
End Signs.

(* Range: the corners' differences are asked; another is the difference of two of them. *)
Section Range.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : span_component -> R.
Variable value_of : number -> value.
Hypothesis run : execution f from to value_of.
Notation D := (exactly from to).
Notation L := (power (largest_edge f)).
Notation l := (lam f).
Definition is_at_most B c := exists x, value_of (Difference c) = Number x /\ Rabs x <= B.
Lemma third_side c c1 c2 : D c = D c1 - D c2 -> is_at_most L c1 -> is_at_most L c2 -> is_at_most (reach f) c.
Proof.
  intros third (x1 & E1 & s1) (x2 & E2 & s2). pose proof (l0 f). pose proof (l1 f ok). pose proof (e0 f). pose proof (e_le f ok). pose proof (L1 f ok).
  pose proof (off_of f ok from to value_of run c1 x1 E1 ltac:(unfold reach; lra)) as o1.
  pose proof (off_of f ok from to value_of run c2 x2 E2 ltac:(unfold reach; lra)) as o2.
  assert (eL : eps f * L <= / 8388608 * L) by (apply Rmult_le_compat_r; lra).
  assert (eps f * Rabs x1 <= eps f * L) by (apply Rmult_le_compat_l; lra). assert (eps f * Rabs x2 <= eps f * L) by (apply Rmult_le_compat_l; lra).
  pose proof (run (Difference c)) as v. simpl in v. destruct (v _ _ eq_refl eq_refl) as (y & z & cy & cz & r).
  apply counts_error in cy. apply counts_error in cz.
  assert (small : Rabs (y - z) <= 2.001 * L).
  { unfold exactly in third, o1, o2. apply Rabs_le_inv in cy, cz, o1, o2, s1, s2. apply Rabs_le. lra. }
  pose proof (omega_large f ok) as big. unfold reach in big. change (IZR (2 ^ 30)) with 1073741824 in big.
  replace ((4 * L) ^ 3) with (64 * L ^ 3) in big by ring. assert (L <= L ^ 3) by (simpl; nra).
  destruct (result_is_number f ok _ _ (2.001 * L) r small ltac:(lra)) as (w & E & rounded & _).
  exists w. split; [exact E|]. pose proof (rounding_error f ok _ _ rounded) as R_. unfold reach.
  assert (eps f * Rabs (y - z) <= / 8388608 * (2.001 * L)) by (apply Rmult_le_compat; try lra; apply Rabs_pos).
  apply Rabs_le_inv in R_, small. apply Rabs_le. lra.
Qed.
End Range.

(* From the code's terms to the geometry. *)
Definition difference_of (ends : span -> nat * nat) c := let '(Span s t k) := c in (Coordinate (fst (ends s)) t k, Coordinate (snd (ends s)) t k).
Section OfAPair.
Variable place : coordinate -> R.
Variable f : format.
Hypothesis ok : reasonable f.
Variable value_of : number -> value.
Variable flushes : bool.
Hypothesis alike : products_alike f flushes value_of.
Definition from_of ends c := place (snd (difference_of ends c)).
Definition to_of ends c := place (fst (difference_of ends c)).
Notation L := (power (largest_edge f)).

Section OfAKind.
Variable ends : span -> nat * nat.
Variable corner : nat -> span.
Variable w : vector.
Hypothesis run : execution f (from_of ends) (to_of ends) value_of.
Definition covered := forall i t k, (i < 4)%nat -> occurs (Span (corner i) t k) (largest (extents corner)) = true.
Hypothesis all_covered : covered.
Hypothesis culled : says f value_of (apart_along corner w).
Lemma corner_in_range i t k : (i < 4)%nat -> is_at_most value_of L (Span (corner i) t k).
Proof.
  intro small. destruct culled as [_ range_]. exact (range_of f ok _ _ value_of run (largest (extents corner)) _ eq_refl (all_covered i t k small) range_).
Qed.
Definition as_counted s := Point (s * counted f value_of flushes (along_x w)) (s * counted f value_of flushes (along_y w))
  (s * counted f value_of flushes (along_z w)).
Notation path n := (Apart.path_of place n).
Lemma exact_is_geometry s t n k : ends s = (n, k) -> forall sign_, dot (as_counted sign_) (minus (Apart.position place n t) (Apart.position place k t)) =
  sign_ * exact_ahead f (from_of ends) (to_of ends) value_of flushes w s t.
Proof. intros E sign_. unfold exact_ahead, exactly, from_of, to_of, difference_of. rewrite E. unfold dot, minus, as_counted, Apart.position; simpl. ring. Qed.
Lemma all_ahead : (forall c, is_at_most value_of (reach f) c) -> fits (bound corner w) = true -> fits (least corner w) = true ->
  fits (greatest corner w) = true ->
  (forall i t k, (i < 4)%nat -> occurs (Span (corner i) t k) (component_along k (extents corner)) = true) ->
  exists direction_, forall i n k, (i < 4)%nat -> ends (corner i) = (n, k) -> Apart.ahead place direction_ n k.
Proof.
  intros in_range fb fl fg occur. destruct culled as [sides _].
  destruct (one_side f ok _ _ value_of run flushes alike in_range corner w fb fl fg occur sides) as [positive|negative].
  - exists (as_counted 1). intros i n k small E. split.
    + change (0 < dot (as_counted 1) (minus (Apart.position place n Start) (Apart.position place k Start))).
      rewrite (exact_is_geometry _ Start n k E). pose proof (positive i Start small). lra.
    + change (0 < dot (as_counted 1) (minus (Apart.position place n End) (Apart.position place k End))).
      rewrite (exact_is_geometry _ End n k E). pose proof (positive i End small). lra.
  - exists (as_counted (-1)). intros i n k small E. split.
    + change (0 < dot (as_counted (-1)) (minus (Apart.position place n Start) (Apart.position place k Start))).
      rewrite (exact_is_geometry _ Start n k E). pose proof (negative i Start small). lra.
    + change (0 < dot (as_counted (-1)) (minus (Apart.position place n End) (Apart.position place k End))).
      rewrite (exact_is_geometry _ End n k E). pose proof (negative i End small). lra.
Qed.
End OfAKind.

Ltac is_one_of_four := let i := fresh in let t := fresh in let k := fresh in
  intros i t k ?; destruct i as [|[|[|[|]]]]; [| | | |lia]; destruct t, k; reflexivity.
Lemma less_than_reach c : is_at_most value_of L c -> is_at_most value_of (reach f) c.
Proof. intros (x & E & small). exists x. split; [exact E|]. pose proof (L1 f ok). unfold reach. lra. Qed.

Theorem a_direction_between_a_vertex_and_a_face : execution f (from_of a_vertex_and_a_face.ends) (to_of a_vertex_and_a_face.ends) value_of ->
  says f value_of a_vertex_and_a_face.culled_by_normal -> Apart.never_touch_vertex_and_face place.
Proof.
  intros run culled. rewrite the_code_of_a_vertex_and_a_face in culled.
  assert (corner_is : forall i t k, (i < 4)%nat -> is_at_most value_of L (Span (corners_of_a_vertex_and_a_face i) t k)).
  { intros i t k. apply (corner_in_range _ _ normal_of_a_face run); [unfold covered; is_one_of_four|exact culled]. }
  destruct (all_ahead a_vertex_and_a_face.ends corners_of_a_vertex_and_a_face normal_of_a_face run culled) as (direction_ & ahead_).
  - intros [s t k]. destruct s.
    + apply less_than_reach, (corner_is 0%nat); lia.
    + apply (third_side f ok _ _ value_of run (Span S1 t k) (Span S0 t k) (Span S3 t k)); [|apply (corner_is 0%nat)|apply (corner_is 2%nat)]; [|lia..].
      unfold exactly, from_of, to_of; simpl; ring.
    + apply (third_side f ok _ _ value_of run (Span S2 t k) (Span S0 t k) (Span S4 t k)); [|apply (corner_is 0%nat)|apply (corner_is 3%nat)]; [|lia..].
      unfold exactly, from_of, to_of; simpl; ring.
    + apply less_than_reach, (corner_is 2%nat); lia.
    + apply less_than_reach, (corner_is 3%nat); lia.
  - vm_compute; reflexivity.
  - vm_compute; reflexivity.
  - vm_compute; reflexivity.
  - is_one_of_four.
  - apply (Apart.a_fixed_direction_excludes_contact_of_a_vertex_and_a_face place direction_).
    split; [|split]; [apply (ahead_ 0%nat)|apply (ahead_ 2%nat)|apply (ahead_ 3%nat)]; (lia || reflexivity).
Qed.
Theorem a_direction_between_two_edges : execution f (from_of two_edges.ends) (to_of two_edges.ends) value_of ->
  says f value_of two_edges.culled_by_normal -> Apart.never_touch_edges place.
Proof.
  intros run culled. rewrite the_code_of_two_edges in culled.
  assert (corner_is : forall i t k, (i < 4)%nat -> is_at_most value_of L (Span (corners_of_two_edges i) t k)).
  { intros i t k. apply (corner_in_range _ _ normal_of_two_edges run); [unfold covered; is_one_of_four|exact culled]. }
  destruct (all_ahead two_edges.ends corners_of_two_edges normal_of_two_edges run culled) as (direction_ & ahead_).
  - intros [s t k]. destruct s.
    + apply less_than_reach, (corner_is 0%nat); lia.
    + apply less_than_reach, (corner_is 2%nat); lia.
    + apply (third_side f ok _ _ value_of run (Span S2 t k) (Span S0 t k) (Span S3 t k)); [|apply (corner_is 0%nat)|apply (corner_is 1%nat)]; [|lia..].
      unfold exactly, from_of, to_of; simpl; ring.
    + apply less_than_reach, (corner_is 1%nat); lia.
    + apply less_than_reach, (corner_is 3%nat); lia.
  - vm_compute; reflexivity.
  - vm_compute; reflexivity.
  - vm_compute; reflexivity.
  - is_one_of_four.
  - apply (Apart.a_fixed_direction_excludes_contact_of_two_edges place direction_).
    split; [|split; [|split]]; [apply (ahead_ 0%nat)|apply (ahead_ 1%nat)|apply (ahead_ 2%nat)|apply (ahead_ 3%nat)]; (lia || reflexivity).
Qed.
End OfAPair.
