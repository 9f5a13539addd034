(* What is proven, for a reader who reads nothing else. Words are defined in Geometry.v (contact, volume), Arithmetic.v (one operation),
   Expressions.v (an execution), and generated/Filter.v (what the code of the certified filter computes); for boxes in Orders.v (an
   execution) and generated/Boxes.v. *)
From Coq Require Import Reals ZArith Lra Lia.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent Magnitudes.
From Selvedge Require Orders Boxes Apart Nearest Witnesses Integers.
Open Scope R_scope.

(* 1. Both formats are ones that the theorems below hold for. *)
Theorem formats_are_reasonable : reasonable binary32 /\ reasonable binary64.
Proof. split; constructor; cbn; lia. Qed.

(* 2. An operation of Flocq's formats, rounded in any direction, subnormal results kept or flushed, is off by at most 2u of its result and
      the smallest normal number. *)
Theorem an_operation_is_nearly_exact f z r : reasonable f -> rounds f z r -> Rabs (r - z) <= eps f * Rabs z + lam f.
Proof. intros ok. exact (rounding_error f ok z r). Qed.

Section OfAPair.
(* The coordinates of a pair's four points. *)
Variable place : coordinate -> R.
Definition position n t := Point (place (Coordinate n t X)) (place (Coordinate n t Y)) (place (Coordinate n t Z_)).
Definition path_of n := Path (position n Start) (position n End).
(* The six differences that the code takes, without rounding. *)
Definition differences (of : component -> coordinate * coordinate) c := place (fst (of c)) - place (snd (of c)).

(* The control values of the volume of four paths. *)
Definition control a b c p := (of_control (fun b0 _ c0 _ p0 _ => k0 b0 c0 p0) a b c p, of_control k1 a b c p,
  of_control k2 a b c p, of_control (fun _ b1 _ c1 _ p1 => k3 b1 c1 p1) a b c p).

(* 3. What the code computes are, but for rounding, the control values of the moving volume: VF, EE. *)
Theorem the_code_computes_control_values_of_a_vertex_and_a_face : let e := exact (differences vertex_face) in
  (e control_value_0, e control_value_1, e control_value_2, e control_value_3) = control (path_of 1) (path_of 2) (path_of 3) (path_of 0).
Proof.
  cbv beta zeta. unfold control. repeat apply f_equal2; cbv -[Rplus Rminus Rmult Ropp]; ring.
Qed.
Theorem the_code_computes_control_values_of_two_edges : let e := exact (differences edge_edge) in
  (e control_value_0, e control_value_1, e control_value_2, e control_value_3) = control (path_of 2) (path_of 0) (path_of 1) (path_of 3).
Proof.
  cbv beta zeta. unfold control. repeat apply f_equal2; cbv -[Rplus Rminus Rmult Ropp]; ring.
Qed.

Definition are_of_one_sign values := let '(a, b, c, d) := values in one_sign a b c d.
Definition have_one_sign of := let e := exact (differences of) in
  are_of_one_sign (e control_value_0, e control_value_1, e control_value_2, e control_value_3).

(* 4. If the exact values of what the code computes have one sign, no time of the step has contact. *)
Theorem one_sign_excludes_contact_of_a_vertex_and_a_face t : have_one_sign vertex_face -> 0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros sign time contact. apply vertex_in_triangle_is_flat in contact. revert contact.
  apply one_sign_is_never_flat; [exact time|]. unfold have_one_sign in sign.
  pose proof the_code_computes_control_values_of_a_vertex_and_a_face as same. cbv beta zeta in same, sign. rewrite same in sign. exact sign.
Qed.
Theorem one_sign_excludes_contact_of_two_edges t : have_one_sign edge_edge -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros sign time contact. apply segments_that_meet_are_flat in contact. revert contact.
  apply one_sign_is_never_flat; [exact time|]. unfold have_one_sign in sign.
  pose proof the_code_computes_control_values_of_two_edges as same. cbv beta zeta in same, sign. rewrite same in sign. exact sign.
Qed.

(* 5. **From the bits to the geometry**: what a tier of the filter culls has no contact in the step. `place` are the coordinates, any
      finite numbers; `value_of` any execution of the code's operations, in any rounding direction, with subnormal numbers kept or
      flushed, operands and results; `says` that the comparisons may come out so. *)
Inductive decision := MagnitudesByEdge | MagnitudesByAxis | PermanentOfNoLane | PermanentOfSomeLane.
(* What the code decides, word by word: generated/Filter.v. The permanent's tier leaves out its second half where no lane needs it. *)
Definition culled_by decision := match decision with
  | MagnitudesByEdge => culled_by_edge
  | MagnitudesByAxis => culled_by_axis
  | PermanentOfNoLane => culled_by_permanent_alone
  | PermanentOfSomeLane => culled_by_permanent end.
Definition executed f of := execution f (fun c => place (snd (of c))) (fun c => place (fst (of c))).
Lemma culled_has_one_sign f of tier value_of : reasonable f -> executed f of value_of -> says f value_of (culled_by tier) -> have_one_sign of.
Proof.
  intros ok run culled. destruct tier.
  - exact (by_edge_proves_one_sign f ok _ _ value_of run culled).
  - exact (by_axis_proves_one_sign f ok _ _ value_of run culled).
  - exact (alone_proves_one_sign f ok _ _ value_of run culled).
  - exact (by_permanent_proves_one_sign f ok _ _ value_of run culled).
Qed.
Theorem a_culled_vertex_and_face_do_not_touch f tier value_of t : reasonable f -> executed f vertex_face value_of ->
  says f value_of (culled_by tier) -> 0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof. intros ok run culled. apply one_sign_excludes_contact_of_a_vertex_and_a_face. eapply culled_has_one_sign; eassumption. Qed.
Theorem culled_edges_do_not_touch f tier value_of t : reasonable f -> executed f edge_edge value_of ->
  says f value_of (culled_by tier) -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof. intros ok run culled. apply one_sign_excludes_contact_of_two_edges. eapply culled_has_one_sign; eassumption. Qed.

(* 6. The widened tier asks binary64 where binary32 does not decide: the same coordinates, the same code. *)
Definition culled_widened of := exists f value_of, (f = binary32 \/ f = binary64) /\ executed f of value_of /\
  says f value_of (culled_by PermanentOfSomeLane).
Theorem widened_culls_no_vertex_and_face_that_touch t : culled_widened vertex_face ->
  0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros (f & value_of & which & run & culled). destruct formats_are_reasonable.
  apply (a_culled_vertex_and_face_do_not_touch f PermanentOfSomeLane value_of); try assumption. destruct which as [-> | ->]; assumption.
Qed.
Theorem widened_culls_no_edges_that_touch t : culled_widened edge_edge -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros (f & value_of & which & run & culled). destruct formats_are_reasonable.
  apply (culled_edges_do_not_touch f PermanentOfSomeLane value_of); try assumption. destruct which as [-> | ->]; assumption.
Qed.

(* 7. Swept boxes, relative boxes along three axes, and along nine directions: they compare coordinates, or sums of two that are rounded
      once. `environment` is one direction of rounding for all, and whether subnormal results and operands count as zero. The gap that
      one sum must exceed another by is a power of two, not too small for the format; core's constants are not. *)
Definition wide_gap f g := (least_exponent f + precision f - 1 + precision f + 9 <= g)%Z.
Theorem gaps_are_wide : wide_gap binary32 Boxes.gap_of_binary32 /\ wide_gap binary64 Boxes.gap_of_binary64.
Proof. split; vm_compute; discriminate. Qed.
Inductive box_test := SweptBoxes | ThreeAxes | NineDirections.
Definition of_a_vertex_and_a_face test := match test with
  | SweptBoxes => Boxes.a_vertex_and_a_face.culled_by_swept_boxes
  | ThreeAxes => Boxes.a_vertex_and_a_face.culled_by_three_axes
  | NineDirections => Boxes.a_vertex_and_a_face.culled_by_nine_directions end.
Definition of_two_edges test := match test with
  | SweptBoxes => Boxes.two_edges.culled_by_swept_boxes
  | ThreeAxes => Boxes.two_edges.culled_by_three_axes
  | NineDirections => Boxes.two_edges.culled_by_nine_directions end.
Theorem boxes_apart_exclude_contact_of_a_vertex_and_a_face f environment g test value_of t : reasonable f -> wide_gap f g ->
  (forall c, representable f (place c)) -> Orders.execution f environment (power g) place value_of ->
  Orders.says f environment value_of (of_a_vertex_and_a_face test) -> 0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros ok wide_ numbers run culled. revert t. destruct test.
  - exact (Apart.swept_boxes_of_a_vertex_and_a_face place f environment (power g) value_of run culled).
  - exact (Apart.three_axes_of_a_vertex_and_a_face place f environment (power g) value_of run culled).
  - exact (Apart.nine_directions_of_a_vertex_and_a_face place f environment (power g) value_of run ok numbers g eq_refl wide_ culled).
Qed.
Theorem boxes_apart_exclude_contact_of_two_edges f environment g test value_of t : reasonable f -> wide_gap f g ->
  (forall c, representable f (place c)) -> Orders.execution f environment (power g) place value_of ->
  Orders.says f environment value_of (of_two_edges test) -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros ok wide_ numbers run culled. revert t. destruct test.
  - exact (Apart.swept_boxes_of_two_edges place f environment (power g) value_of run culled).
  - exact (Apart.three_axes_of_two_edges place f environment (power g) value_of run culled).
  - exact (Apart.nine_directions_of_two_edges place f environment (power g) value_of run ok numbers g eq_refl wide_ culled).
Qed.
End OfAPair.

(* 8. None of this is empty. Executions exist, whatever the coordinates (to nearest is one); and there are coordinates that each decision
      culls in one, vertex and face or two edges, in both formats: computed in Coq with Flocq's binary numbers. *)
Theorem executions_exist place of : (exists value_of, executed place binary32 of value_of) /\ (exists value_of, executed place binary64 of value_of).
Proof.
  destruct formats_are_reasonable as [a b]. split; eexists.
  - exact (Nearest.an_execution_exists 24 128 Witnesses.gt24 (-117) 30 a _ _).
  - exact (Nearest.an_execution_exists 53 1024 Witnesses.gt53 (-1000) 250 b _ _).
Qed.
Definition culls_some_pair f of culled := exists place value_of, (forall c, representable f (place (fst (of c))) /\
  representable f (place (snd (of c)))) /\ executed place f of value_of /\ says f value_of culled.
Theorem every_decision_culls_some_pair tier f : f = binary32 \/ f = binary64 ->
  culls_some_pair f vertex_face (culled_by tier) /\ culls_some_pair f edge_edge (culled_by tier).
Proof. intro which. apply (Witnesses.every_decision_culls_some (culled_by tier) f); [destruct tier; cbn; tauto|exact which]. Qed.
(* By the permanent itself: what the code asks last. *)
Theorem the_permanent_culls_some_pair : culls_some_pair binary32 vertex_face last_part /\ culls_some_pair binary32 edge_edge last_part.
Proof. exact Witnesses.the_last_part_culls_some. Qed.
Theorem every_box_test_culls_some_pair f gap test : reasonable f -> 0 <= gap <= 1 -> exists environment place place' value_of value_of',
  Orders.execution f environment gap place value_of /\ Orders.says f environment value_of (of_a_vertex_and_a_face test) /\
  Orders.execution f environment gap place' value_of' /\ Orders.says f environment value_of' (of_two_edges test).
Proof.
  intros ok fits_. destruct (Witnesses.every_box_test_culls_some f gap ok fits_) as (v & v' & run & run' & a & b & c & d & e & g).
  exists Witnesses.plain, (Witnesses.beside 1), (Witnesses.beside 2), v, v'.
  split; [exact run|]. split; [destruct test; assumption|]. split; [exact run'|]. destruct test; assumption.
Qed.

(* 9. Whole numbers of the exact signs, in words of 64 bits: from what the code documents, not from the code. *)
Theorem control_values_fit_three_times_the_words n x : (1 <= n)%Z -> (Z.abs x <= 18 * (2 ^ (64 * n - 2) * (2 ^ (64 * n - 2) * 2 ^ (64 * n - 2))))%Z ->
  (- Integers.word ^ (3 * n) <= 2 * x < Integers.word ^ (3 * n))%Z.
Proof. intro h. exact (Integers.three_words_suffice n h x). Qed.

Print Assumptions formats_are_reasonable.
Print Assumptions an_operation_is_nearly_exact.
Print Assumptions one_sign_excludes_contact_of_a_vertex_and_a_face.
Print Assumptions one_sign_excludes_contact_of_two_edges.
Print Assumptions a_culled_vertex_and_face_do_not_touch.
Print Assumptions culled_edges_do_not_touch.
Print Assumptions widened_culls_no_vertex_and_face_that_touch.
Print Assumptions widened_culls_no_edges_that_touch.
Print Assumptions gaps_are_wide.
Print Assumptions boxes_apart_exclude_contact_of_a_vertex_and_a_face.
Print Assumptions boxes_apart_exclude_contact_of_two_edges.
Print Assumptions executions_exist.
Print Assumptions every_decision_culls_some_pair.
Print Assumptions the_permanent_culls_some_pair.
Print Assumptions every_box_test_culls_some_pair.
Print Assumptions control_values_fit_three_times_the_words.
Print Assumptions Integers.carries_are_right.
Print Assumptions Integers.what_fits_is_exact.
Print Assumptions Integers.control_values_have_room.
