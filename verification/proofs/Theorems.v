(* The theorems, for a reader who reads no other file. In words:

     (5, 6)   A pair that the certified filter culls does not touch at any time of the step.
     (7)      Nor does one that swept or relative boxes cull.
     (14)     A pair that the filter culls with a separation stays farther apart than that throughout the step.
     (9)      Control values in words of 64 bits are exact, and their top word has the sign.
     (10)     A pair does not touch before the time that the time of impact answers, nor at it.
     (15)     With a separation, it stays farther apart than that up to the time that the time of impact answers.
     (16)     The loop: if the interpreter of its records accepts one, the pair is so up to the time that the code answered.
              It accepts the records of the runs that the code writes down for each check.
     (11)     What the checker of witnesses accepts does not touch before the claimed time.
     (12)     From `f64` to `f32`, times become no later and lengths no smaller.
     (13)     A pair whose direction has a gap beyond the threshold at both ends of a step stays farther apart than the
              separation throughout. A gap that was stored when the last step ended serves at the start. An accepted step
              has no contact, and keeps its separation (15).
     (1 to 4) What these rest on: the formats, an operation, the volume of four moving points, its sign.
     (8)      None is empty: each decision holds for some pair.

   All hold in every environment of a thread: rounding to nearest or in any direction, subnormal numbers kept or flushed.

   Words are defined in Geometry.v (contact, volume), Arithmetic.v (one operation), Expressions.v (an execution), and
   Filter.v (what the code of the certified filter computes); for boxes in Orders.v (an execution) and Boxes.v; for the
   time of impact, gaps and all separations in Machine.v (an environment, an execution); Advancing.v and
   AdvancingBeyond.v (a round, a chain), Separated.v (what the filter culls with a separation), and Replay.v and
   Replayed.v (a record, a run). *)
From Coq Require Import Reals ZArith Lra Lia.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent
  Magnitudes.
From Selvedge Require Orders Boxes Apart Certificates Nearest Witnesses Words Integers Samples Verdicts.
From Selvedge Require Machine Nearness Corners Advance Advancing Checker Chains Narrowing Gap Gaps Kept Least Normals
  Beyond
  Separated DirectionsBeyond AdvanceBeyond AdvancingBeyond.
From Selvedge Require Replay Replayed.
From Coq Require QArith_base List.
Import List.ListNotations.
Open Scope R_scope.

(* 1. Both formats are ones that the theorems below hold for. *)
Theorem formats_are_reasonable : reasonable binary32 /\ reasonable binary64.
Proof. split; constructor; cbn; lia. Qed.

(* 2. An operation of Flocq's formats, rounded in any direction, subnormal results kept or flushed, is off by at most 2u
      of its result and the smallest normal number. *)
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

(* 3. Apart from rounding, the code computes the control values of the moving volume: VF, EE. *)
Theorem the_code_computes_control_values_of_a_vertex_and_a_face : let e := exact (differences vertex_face) in
  (e control_value_0, e control_value_1, e control_value_2, e control_value_3) = control (path_of 1) (path_of 2)
    (path_of 3) (path_of 0).
Proof.
  cbv beta zeta. unfold control. repeat apply f_equal2; cbv -[Rplus Rminus Rmult Ropp]; ring.
Qed.
Theorem the_code_computes_control_values_of_two_edges : let e := exact (differences edge_edge) in
  (e control_value_0, e control_value_1, e control_value_2, e control_value_3) = control (path_of 2) (path_of 0)
    (path_of 1) (path_of 3).
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
  pose proof the_code_computes_control_values_of_a_vertex_and_a_face as same. cbv beta zeta in same, sign.
    rewrite same in sign. exact sign.
Qed.
Theorem one_sign_excludes_contact_of_two_edges t : have_one_sign edge_edge -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros sign time contact. apply segments_that_meet_are_flat in contact. revert contact.
  apply one_sign_is_never_flat; [exact time|]. unfold have_one_sign in sign.
  pose proof the_code_computes_control_values_of_two_edges as same. cbv beta zeta in same, sign. rewrite same in sign.
    exact sign.
Qed.

(* 5. **From the bits to the geometry**: what a tier of the filter culls has no contact in the step. `place` are the
      coordinates, any finite numbers; `value_of` any execution of the code's operations, in any rounding direction,
      with subnormal numbers kept or flushed, operands and results; `says` that the comparisons may come out so. *)
Inductive decision := PermanentOfNoLane | PermanentOfSomeLane.
(* The code's decisions, term by term, from Filter.v. The permanent's tier leaves out its second half if no lane needs
   it. *)
Definition culled_by decision := match decision with
  | PermanentOfNoLane => culled_by_permanent_alone
  | PermanentOfSomeLane => culled_by_permanent end.
Definition executed {component : Type} f (of : component -> coordinate * coordinate) := execution f (fun c => place (snd
  (of c))) (fun c => place (fst (of c))).
Lemma culled_has_one_sign f of tier value_of : reasonable f -> executed f of value_of -> says f value_of (culled_by
  tier) -> have_one_sign of.
Proof.
  intros ok run culled. destruct tier.
  - exact (alone_proves_one_sign f ok _ _ value_of run culled).
  - exact (by_permanent_proves_one_sign f ok _ _ value_of run culled).
Qed.
Theorem a_culled_vertex_and_face_do_not_touch f tier value_of t : reasonable f -> executed f vertex_face value_of ->
  says f value_of (culled_by tier) -> 0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof. intros ok run culled. apply one_sign_excludes_contact_of_a_vertex_and_a_face.
  eapply culled_has_one_sign; eassumption. Qed.
Theorem culled_edges_do_not_touch f tier value_of t : reasonable f -> executed f edge_edge value_of ->
  says f value_of (culled_by tier) -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof. intros ok run culled. apply one_sign_excludes_contact_of_two_edges. eapply culled_has_one_sign; eassumption. Qed.

(* 6. The widened tier computes in binary64 if binary32 does not decide: the same coordinates, the same code. *)
Definition culled_widened of := exists f value_of, (f = binary32 \/ f = binary64) /\ executed f of value_of /\
  says f value_of (culled_by PermanentOfSomeLane).
Theorem widened_culls_no_vertex_and_face_that_touch t : culled_widened vertex_face ->
  0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros (f & value_of & which & run & culled). destruct formats_are_reasonable.
  apply (a_culled_vertex_and_face_do_not_touch f PermanentOfSomeLane value_of); try assumption.
    destruct which as [-> | ->]; assumption.
Qed.
Theorem widened_culls_no_edges_that_touch t : culled_widened edge_edge -> 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros (f & value_of & which & run & culled). destruct formats_are_reasonable.
  apply (culled_edges_do_not_touch f PermanentOfSomeLane value_of); try assumption.
    destruct which as [-> | ->]; assumption.
Qed.

(* 7. Swept boxes, and relative boxes along three axes: they compare coordinates. `environment` says whether subnormal
      operands count as zero, the same for all of a pair. *)
Inductive box_test := SweptBoxes | ThreeAxes.
Definition of_a_vertex_and_a_face test := match test with
  | SweptBoxes => Boxes.a_vertex_and_a_face.culled_by_swept_boxes
  | ThreeAxes => Boxes.a_vertex_and_a_face.culled_by_three_axes end.
Definition of_two_edges test := match test with
  | SweptBoxes => Boxes.two_edges.culled_by_swept_boxes
  | ThreeAxes => Boxes.two_edges.culled_by_three_axes end.
Theorem boxes_apart_exclude_contact_of_a_vertex_and_a_face f environment test value_of t :
  Orders.execution f environment place value_of -> Orders.says f environment value_of (of_a_vertex_and_a_face test) -> 0
    <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros run culled. revert t. destruct test.
  - exact (Apart.swept_boxes_of_a_vertex_and_a_face place f environment value_of run culled).
  - exact (Apart.three_axes_of_a_vertex_and_a_face place f environment value_of run culled).
Qed.
Theorem boxes_apart_exclude_contact_of_two_edges f environment test value_of t :
  Orders.execution f environment place value_of -> Orders.says f environment value_of (of_two_edges test) -> 0 <= t <= 1
    ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Proof.
  intros run culled. revert t. destruct test.
  - exact (Apart.swept_boxes_of_two_edges place f environment value_of run culled).
  - exact (Apart.three_axes_of_two_edges place f environment value_of run culled).
Qed.
End OfAPair.

(* 8. None of this is empty. Executions exist, whatever the coordinates (to nearest is one); and there are coordinates
      that each decision culls in one, vertex and face or two edges, in both formats: computed in Coq with Flocq's
      binary numbers. *)
Theorem executions_exist place (of : component -> coordinate * coordinate) : (exists value_of,
  executed place binary32 of value_of) /\ (exists value_of, executed place binary64 of value_of).
Proof.
  destruct formats_are_reasonable as [a b]. split; eexists.
  - exact (Nearest.an_execution_exists 24 128 Witnesses.gt24 (-117) 30 a _ _).
  - exact (Nearest.an_execution_exists 53 1024 Witnesses.gt53 (-1000) 250 b _ _).
Qed.
Definition culls_some_pair {component : Type} f (of : component -> coordinate * coordinate) culled := exists place
  value_of, (forall c, representable f (place (fst (of c))) /\
  representable f (place (snd (of c)))) /\ executed place f of value_of /\ says f value_of culled.
Theorem every_decision_culls_some_pair tier f : f = binary32 \/ f = binary64 ->
  culls_some_pair f vertex_face (culled_by tier) /\ culls_some_pair f edge_edge (culled_by tier).
Proof. intro which. apply (Witnesses.every_decision_culls_some (culled_by tier) f); [destruct tier; cbn;
  tauto|exact which]. Qed.
(* The permanent alone, which the code tests last, culls some pair. *)
Theorem the_permanent_culls_some_pair : culls_some_pair binary32 vertex_face last_part /\
  culls_some_pair binary32 edge_edge last_part.
Proof. exact Witnesses.the_last_part_culls_some. Qed.
Theorem every_box_test_culls_some_pair f test : exists environment place place' value_of value_of',
  Orders.execution f environment place value_of /\ Orders.says f environment value_of (of_a_vertex_and_a_face test) /\
  Orders.execution f environment place' value_of' /\ Orders.says f environment value_of' (of_two_edges test).
Proof.
  destruct (Witnesses.every_box_test_culls_some f) as (v & v' & run & run' & a & b & c & d).
  exists Witnesses.plain, (Witnesses.beside 1), (Witnesses.beside 2), v, v'.
  split; [exact run|]. split; [destruct test; assumption|]. split; [exact run'|]. destruct test; assumption.
Qed.

(* 9. Exact signs. `Words.v` has the code's integers as functions on lists of words, for words of any size; `Samples.v`
      compares them with what the code returns. Sums, differences and products of a fixed width are exact where they fit;
      those of as many words as they need always are. Their signs are those of the numbers. *)
Theorem integers_of_a_fixed_width_are_exact bits n m a b x y : (1 <= bits)%Z -> (0 < n)%nat -> (0 < m)%nat ->
  Words.is bits n a x -> Words.is bits m b y ->
  Words.integer_sign bits a = Z.compare x 0 /\ Words.is bits (n + m) (Words.integer_times bits a b) (x * y)%Z /\
  (n = m -> Words.fits bits n (x + y)%Z -> Words.is bits n (Words.integer_plus bits a b) (x + y)%Z) /\
  (n = m -> Words.fits bits n (x - y)%Z -> Words.is bits n (Words.integer_minus bits a b) (x - y)%Z).
Proof.
  intros r n0 m0 ha hb. split; [destruct ha as [[_ h] <-]; now apply Words.integer_sign_is|].
  split; [now apply Words.integer_times_is|]. split; intros <- f; [now apply Words.integer_plus_is|now apply
    Words.integer_minus_is].
Qed.
Theorem integers_in_a_space_are_exact bits a b c d x y z w : (1 <= bits)%Z ->
  Words.holds bits a x -> Words.holds bits b y -> Words.holds bits c z -> Words.holds bits d w ->
  Words.words_sign bits a = Z.compare x 0 /\ Words.holds bits (Words.plus bits a b) (x + y)%Z /\
  Words.holds bits (Words.minus bits a b) (x - y)%Z /\ Words.holds bits (Words.times bits a b) (x * y)%Z /\
  Words.holds bits (Words.minor bits a b c d) (x * w - y * z)%Z.
Proof.
  intros r ha hb hc hd. split; [destruct ha as (h & m & <-); now apply Words.words_sign_is|].
  split; [now apply Words.plus_is|]. split; [now apply Words.minus_is|]. split; [now apply Words.times_is|now apply
    Words.minor_is].
Qed.
(* `Integers.v` has the way from 24 encodings to the signs, in the code's shape: coordinates taken apart and shifted to
   their axis' unit, and the control values in the narrowest width that suffices. The signs are those of the real control
   values, for any encodings that are finite. *)
Theorem exact_signs_are_right s kind encodings found : s = Integers.single \/ s = Integers.double ->
  Integers.each_is (Integers.eight_are (Integers.is_encoding s)) encodings ->
  Integers.control_value_signs s kind encodings = Some found ->
  List.Forall2 Integers.says (Integers.control_values Integers.real kind (Integers.reals s encodings)) found.
Proof.
  intros which. apply Integers.control_value_signs_are. unfold Integers.reasonable. destruct which as [-> | ->]; cbn; lia.
Qed.
(* These are the control values of the volume of the four moving points. *)
Definition moving (v : Integers.triple (nat -> R)) n := Path (Point (Integers.x_ v n) (Integers.y_ v n) (Integers.z_ v n))
  (Point (Integers.x_ v (4 + n)%nat) (Integers.y_ v (4 + n)%nat) (Integers.z_ v (4 + n)%nat)).
Theorem control_values_are_those_of_the_volume v :
  (let '(k0, k1, k2, k3) := control (moving v 1) (moving v 2) (moving v 3) (moving v 0) in [k0; k1; k2; k3]%list) =
    Integers.control_values Integers.real Integers.VertexFace v /\
  (let '(k0, k1, k2, k3) := control (moving v 2) (moving v 0) (moving v 1) (moving v 3) in [k0; k1; k2; k3]%list) =
    Integers.control_values Integers.real Integers.EdgeEdge v.
Proof. split; apply Integers.four_equal; cbv -[Rplus Rminus Rmult Ropp]; ring. Qed.

(* 10. **The time of impact**, without a separation, from the operations to the geometry. Its constants: both formats
       are ones that the following theorems hold for. *)
Theorem constants_of_the_time_of_impact : Corners.reasonable_constants Advance.binary32 /\
  Corners.reasonable_constants Advance.binary64.
Proof. destruct formats_are_reasonable. split; constructor; try assumption; cbn; lia. Qed.
(* An environment of a thread rounds to nearest or in another direction, and flushes or keeps subnormal numbers. To
   nearest is one. *)
Theorem environments_exist : inhabited (Machine.environment binary32) /\ inhabited (Machine.environment binary64).
Proof. destruct formats_are_reasonable as [a b]. split; constructor; now apply Nearness.to_nearest. Qed.
(* The code goes in rounds from a time up to which the pair is proven to be apart to a later one. `Advancing.step` says
   what a round has: coordinates, directions and moments of any origin; an execution of the traced terms (Advance.v) in
   any environment (Machine.v); and the comparisons of one proof, which come out true. The proofs are a direction that
   is held, turns or moves on a curve, and the signed volume, throughout the step, from a moment to its end, or up to a
   time that clipping gives. `Advancing.reaches` is a chain of rounds, in either format, whose times may be rounded
   down. If the code answers a time, a chain reaches it; if it answers `Never`, one reaches 1 or the end of the
   requested time. *)
Theorem no_contact_of_a_vertex_and_a_face_before place begin until t : Advancing.reaches
  Advancing.of_a_vertex_and_a_face place begin until ->
  begin <= t <= until -> t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of place 0) t) (at_ (path_of place 1) t) (at_ (path_of place 2) t) (at_ (path_of place
    3) t).
Proof.
  rewrite Advancing.vertex_and_face_corners. intros chain between t1.
  destruct (Advancing.rounds_keep_apart _ _ _ _ _ _ _ chain t between t1) as (given & same & [ahead|volume]).
  - exact (Advancing.ahead_excludes_contact_of_a_vertex_and_a_face place given t same ahead).
  - exact (Advancing.volume_excludes_contact_of_a_vertex_and_a_face place given t same volume).
Qed.
Theorem no_contact_of_two_edges_before place begin until t : Advancing.reaches Advancing.of_two_edges place begin until
  ->
  begin <= t <= until -> t <= 1 ->
  ~ segments_meet (at_ (path_of place 0) t) (at_ (path_of place 1) t) (at_ (path_of place 2) t) (at_ (path_of place 3)
    t).
Proof.
  rewrite Advancing.two_edges_corners. intros chain between t1.
  destruct (Advancing.rounds_keep_apart _ _ _ _ _ _ _ chain t between t1) as (given & same & [ahead|volume]).
  - exact (Advancing.ahead_excludes_contact_of_two_edges place given t same ahead).
  - exact (Advancing.volume_excludes_contact_of_two_edges place given t same volume).
Qed.
(* None of it is empty. Coq runs the traced code with Flocq's binary numbers: for a pair of each kind, a chain reaches
the
   end of the step, and each proof of a round holds; for another pair, clipping gives a later time. *)
Theorem chains_reach_the_end f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Advancing.reaches Advancing.of_a_vertex_and_a_face place 0 1) /\
  (exists place, Advancing.reaches Advancing.of_two_edges place 0 1).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  destruct (Chains.every_proof_holds_for_some f which) as [a b]. split; eapply Chains.a_chain_exists; eassumption.
Qed.
Theorem each_proof_of_a_round_holds_for_some_pair f : f = Advance.binary32 \/ f = Advance.binary64 ->
  Chains.every_proof_holds Advancing.of_a_vertex_and_a_face f /\ Chains.every_proof_holds Advancing.of_two_edges f.
Proof. exact (Chains.every_proof_holds_for_some f). Qed.
Theorem clipping_advances_for_some_pair : Chains.clipping_advances Advancing.of_a_vertex_and_a_face Advance.binary32 /\
  Chains.clipping_advances Advancing.of_two_edges Advance.binary32.
Proof. exact Replayed.clipping_advances_for_some. Qed.

(* 11. A checker of witnesses without a separation, in rational numbers (Checker.v): for whoever distrusts the code and
       the model of its arithmetic. A witness is a list of parts of the step, each with its proof (docs/witnesses.md).
       What the checker accepts, from time zero to a claimed time, does not touch before that. *)
Theorem an_accepted_witness_of_a_vertex_and_a_face_is_right depth points_ parts until t :
  Checker.accepts depth points_ Corners.vertex_face (QArith_base.Qmake 0 1) parts until = true -> 0 <= t < Q2R until ->
  let path := path_of (Checker.place points_) in
  ~ vertex_in_triangle (at_ (path 0%nat) t) (at_ (path 1%nat) t) (at_ (path 2%nat) t) (at_ (path 3%nat) t).
Proof. exact (Checker.an_accepted_vertex_and_face_do_not_touch depth points_ parts until t). Qed.
Theorem an_accepted_witness_of_two_edges_is_right depth points_ parts until t :
  Checker.accepts depth points_ Corners.edge_edge (QArith_base.Qmake 0 1) parts until = true -> 0 <= t < Q2R until ->
  let path := path_of (Checker.place points_) in
  ~ segments_meet (at_ (path 0%nat) t) (at_ (path 1%nat) t) (at_ (path 2%nat) t) (at_ (path 3%nat) t).
Proof. exact (Checker.accepted_edges_do_not_touch depth points_ parts until t). Qed.
(* It accepts some: a vertex that falls from 2 to 1 above a resting triangle, by a direction upwards and by the volume.
   *)
Definition falling c : QArith_base.Q := match c with
  | Coordinate 0 Start Z_ => QArith_base.Qmake 2 1 | Coordinate 0 End Z_ => QArith_base.Qmake 1 1
  | Coordinate 2 _ X | Coordinate 3 _ Y => QArith_base.Qmake 1 1 | _ => QArith_base.Qmake 0 1 end.
Definition upwards a : QArith_base.Q := match a with Z_ => QArith_base.Qmake 1 1 | _ => QArith_base.Qmake 0 1 end.
Theorem the_checker_accepts_some : let one := QArith_base.Qmake 1 1 in
  Checker.accepts 0 falling Corners.vertex_face (QArith_base.Qmake 0 1) [(one, Checker.Held upwards)] one = true /\
  Checker.accepts 0 falling Corners.vertex_face (QArith_base.Qmake 0 1) [(one, Checker.Volume)] one = true.
Proof. split; vm_compute; reflexivity. Qed.

(* 12. Between the formats (core/src/narrowing.rs), times become no later and lengths no smaller; a time keeps its place
       among others. Numbers are not negative, and stand as encodings. The functions are written after the code, on
         bits;
       they return what the code does for numbers at and beside all boundaries of the formats. *)
Theorem times_are_rounded_down a b : (0 <= a <= b)%Z -> (b < Narrowing.infinity Narrowing.double)%Z ->
  (0 <= Narrowing.rounded_down a <= Narrowing.rounded_down b)%Z /\
  (Narrowing.rounded_down b < Narrowing.infinity Narrowing.single)%Z /\
  Narrowing.value Narrowing.single (Narrowing.rounded_down b) <= Narrowing.value Narrowing.double b.
Proof.
  intros between finite. pose proof (Narrowing.rounding_down_keeps_the_order a b between finite).
  destruct (Narrowing.rounded_down_is_no_later a ltac:(lia)), (Narrowing.rounded_down_is_no_later b ltac:(lia)).
  repeat split; lia || assumption.
Qed.
Theorem lengths_are_rounded_up b : (0 <= b < Narrowing.infinity Narrowing.double)%Z ->
  Narrowing.rounded_up b = Narrowing.infinity Narrowing.single \/
  Narrowing.value Narrowing.double b <= Narrowing.value Narrowing.single (Narrowing.rounded_up b).
Proof. exact (Narrowing.rounded_up_is_no_smaller b). Qed.
Theorem widening_is_exact c : (0 <= c < Narrowing.infinity Narrowing.single)%Z ->
  Narrowing.value Narrowing.double (Narrowing.widened c) = Narrowing.value Narrowing.single c.
Proof. exact (Narrowing.widened_value c). Qed.

(* 13. **Certificates of separation** (core/src/kernels/gap.rs), by which a simulation and truncation accept a step. A
       direction keeps a pair if its gap exceeds the threshold at both ends of the step, as the traced terms (Gap.v)
       compute them in any environment, and its length passed the test in any format. At the start, a gap serves that was
       stored at the end of an earlier step, in any format and environment, and converted to another. `Gaps.is_kept` and
       `Gaps.lasts_since` say what is assumed of the inputs: the largest coordinate and the separation are at most 2^30
       (binary64: 2^250), and no component of the direction exceeds 2^32 (2^252). Then the sets stay farther apart than the
       separation s throughout the step: the squared distance of any of their points exceeds that of s. *)
Definition keeps_a_vertex_and_a_face f place s := Gaps.is_kept f Gap.a_vertex_and_a_face.keeps place s \/
  Gaps.lasts_since f Gap.a_vertex_and_a_face.lasts Gap.a_vertex_and_a_face.stored_by_keeps place s.
Definition keeps_two_edges f place s := Gaps.is_kept f Gap.two_edges.keeps place s \/
  Gaps.lasts_since f Gap.two_edges.lasts Gap.two_edges.stored_by_keeps place s.
Theorem a_kept_vertex_and_face_stay_apart f place s t i j r : f = Advance.binary32 \/ f = Advance.binary64 ->
  keeps_a_vertex_and_a_face f place s -> 0 <= t <= 1 ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (at_time 0%nat) (plus (scaled i (at_time 1%nat)) (plus (scaled j (at_time
    2%nat)) (scaled r (at_time 3%nat))))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  exact (Gaps.a_kept_vertex_and_face_stay_apart f place s t i j r fine).
Qed.
Theorem kept_edges_stay_apart f place s t i r : f = Advance.binary32 \/ f = Advance.binary64 ->
  keeps_two_edges f place s -> 0 <= t <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_time 0%nat)) (scaled i (at_time 1%nat)))
    (plus (scaled (1 - r) (at_time 2%nat)) (scaled r (at_time 3%nat)))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  exact (Gaps.kept_edges_stay_apart f place s t i r fine).
Qed.
(* What `keeps` and `lasts` store is the same, and at most the exact gap along the direction, which does not depend on the
   environment. *)
Theorem what_is_stored_is_the_same : Gap.a_vertex_and_a_face.stored_by_lasts = Gap.a_vertex_and_a_face.stored_by_keeps /\
  Gap.two_edges.stored_by_lasts = Gap.two_edges.stored_by_keeps.
Proof. split; reflexivity. Qed.
Definition gap_at_the_end place (direction : axis -> R) n k := let at_end n := Corners.sum3 (fun a => direction a * place
  (Coordinate n End a)) in at_end n - at_end k.
Theorem a_stored_gap_is_at_most_the_exact_one f place direction gap_ : f = Advance.binary32 \/ f = Advance.binary64 ->
  0 < gap_ ->
  (Gaps.is_stored f Gap.a_vertex_and_a_face.stored_by_keeps place direction gap_ -> forall k, List.In k [1%nat; 2%nat;
    3%nat]%list ->
    gap_ <= gap_at_the_end place direction 0 k) /\
  (Gaps.is_stored f Gap.two_edges.stored_by_keeps place direction gap_ -> forall n k, List.In n [0%nat; 1%nat]%list -> List.In k
    [2%nat; 3%nat]%list -> gap_ <= gap_at_the_end place direction n k).
Proof.
  intros which pos. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  destruct Gaps.traced_terms as (_ & _ & _ & _ & _ & _ & same & same' & _). rewrite same, same'. split.
  - intros stored k inside. apply (Gaps.a_stored_gap_is_below f Gaps.of_a_vertex_and_a_face place direction gap_ fine);
      try assumption; try discriminate. cbn. auto.
  - intros stored n k inside inside'. now apply (Gaps.a_stored_gap_is_below f Gaps.of_two_edges place direction gap_ fine).
Qed.
(* A distance that the code proves by a direction (distance_from_below) is at most that of any points of the sets. *)
Theorem a_computed_distance_of_a_vertex_and_a_face_is_right f place x i j r : f = Advance.binary32 \/ f = Advance.binary64 ->
  Gaps.is_computed_distance f Gap.a_vertex_and_a_face.distance place x -> 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 ->
  let at_the_end n := at_ (path_of place n) 1 in x ^ 2 <= Certificates.length_squared (minus (at_the_end 0%nat) (plus
    (scaled i (at_the_end 1%nat)) (plus (scaled j (at_the_end 2%nat)) (scaled r (at_the_end 3%nat))))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  exact (Gaps.a_distance_of_a_vertex_and_a_face f place x i j r fine).
Qed.
Theorem a_computed_distance_of_two_edges_is_right f place x i r : f = Advance.binary32 \/ f = Advance.binary64 ->
  Gaps.is_computed_distance f Gap.two_edges.distance place x -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  let at_the_end n := at_ (path_of place n) 1 in x ^ 2 <= Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_the_end 0%nat)) (scaled i (at_the_end 1%nat)))
    (plus (scaled (1 - r) (at_the_end 2%nat)) (scaled r (at_the_end 3%nat)))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  exact (Gaps.a_distance_of_two_edges f place x i r fine).
Qed.
(* Coq runs the traced gaps: some pairs of both kinds are kept, and some last since a gap was stored. *)
Theorem some_pairs_are_kept f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Gaps.is_kept f Gap.a_vertex_and_a_face.keeps place (1 / 2)) /\
  (exists place, Gaps.is_kept f Gap.two_edges.keeps place (1 / 2)).
Proof. exact (Kept.some_are_kept f). Qed.
Theorem some_pairs_last : (exists place, Gaps.lasts_since Advance.binary32 Gap.a_vertex_and_a_face.lasts
    Gap.a_vertex_and_a_face.stored_by_keeps place (1 / 2)) /\
  (exists place, Gaps.lasts_since Advance.binary32 Gap.two_edges.lasts Gap.two_edges.stored_by_keeps place (1 / 2)).
Proof. exact Kept.some_last. Qed.
(* An accepted step: each pair that can touch in it is kept by a direction, or a chain of rounds reaches its end. Then
no
   pair touches during it. That all pairs that can touch are asked about is assumed here, and tested as a property. *)
Definition all_are_apart (vertices_and_faces edges : list (coordinate -> R)) :=
  (forall place, List.In place vertices_and_faces -> Advancing.reaches Advancing.of_a_vertex_and_a_face place 0 1 \/
    exists f s, (f = Advance.binary32 \/ f = Advance.binary64) /\ keeps_a_vertex_and_a_face f place s) /\
  (forall place, List.In place edges -> Advancing.reaches Advancing.of_two_edges place 0 1 \/
    exists f s, (f = Advance.binary32 \/ f = Advance.binary64) /\ keeps_two_edges f place s).
Lemma apart_is_not_zero s p q : s ^ 2 < Certificates.length_squared (minus p q) -> p <> q.
Proof.
  intros far ->. replace (Certificates.length_squared _) with 0 in far; [pose proof (pow2_ge_0 s); lra|].
  unfold Certificates.length_squared, dot, minus. cbn. ring.
Qed.
Theorem an_accepted_step_has_no_contact vertices_and_faces edges t : all_are_apart vertices_and_faces edges -> 0 <= t
  <= 1 ->
  (forall place, List.In place vertices_and_faces -> ~ vertex_in_triangle (at_ (path_of place 0) t) (at_ (path_of
    place 1)
    t) (at_ (path_of place 2) t) (at_ (path_of place 3) t)) /\
  (forall place, List.In place edges -> ~ segments_meet (at_ (path_of place 0) t) (at_ (path_of place 1) t) (at_
    (path_of
    place 2) t) (at_ (path_of place 3) t)).
Proof.
  intros [vf ee] time. split; intros place inside.
  - destruct (vf place inside) as [chain|(f & s & which & kept)].
    + apply (no_contact_of_a_vertex_and_a_face_before place 0 1 t chain time); lra.
    + intros (i & j & r & i0 & j0 & r0 & one & meet). revert meet. apply (apart_is_not_zero s).
      exact (a_kept_vertex_and_face_stay_apart f place s t i j r which kept time i0 j0 r0 one).
  - destruct (ee place inside) as [chain|(f & s & which & kept)].
    + apply (no_contact_of_two_edges_before place 0 1 t chain time); lra.
    + intros (i & r & i01 & r01 & meet). revert meet. apply (apart_is_not_zero s).
      exact (kept_edges_stay_apart f place s t i r which kept time i01 r01).
Qed.

(* 14. **The filter with a separation**, from the bits to the geometry. `Separated.is_culled` has an execution of the
       traced decision (Beyond.v), without a lane that needs the permanent or with one, in any environment, which comes
       out true for a separation s. A subnormal one is raised to the smallest normal number, as
       `Filter::with_separation` does. Then the sets stay farther apart than s throughout the step: the squared distance
       of any of their points exceeds that of s. It holds in either format, so that the widened tier culls no more. *)
Theorem a_culled_vertex_and_face_stay_apart f place s t i j r code : f = Advance.binary32 \/ f = Advance.binary64 ->
  lam (Machine.base f) <= s ->
  code = Beyond.a_vertex_and_a_face.culled_by_permanent_alone \/ code = Beyond.a_vertex_and_a_face.culled_by_permanent
    -> Separated.is_culled f code place s -> 0 <= t <= 1 ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (at_time 0%nat) (plus (scaled i (at_time 1%nat)) (plus (scaled j (at_time
    2%nat)) (scaled r (at_time 3%nat))))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  intros. eapply Separated.a_culled_vertex_and_face_stay_apart; eassumption.
Qed.
Theorem culled_edges_stay_apart f place s t i r code : f = Advance.binary32 \/ f = Advance.binary64 ->
  lam (Machine.base f) <= s ->
  code = Beyond.two_edges.culled_by_permanent_alone \/ code = Beyond.two_edges.culled_by_permanent ->
  Separated.is_culled f code place s -> 0 <= t <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_time 0%nat)) (scaled i (at_time 1%nat)))
    (plus (scaled (1 - r) (at_time 2%nat)) (scaled r (at_time 3%nat)))).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f).
  { destruct constants_of_the_time_of_impact. destruct which as [-> | ->]; assumption. }
  intros. eapply Separated.culled_edges_stay_apart; eassumption.
Qed.
(* Coq runs the traced decisions: some pairs of both kinds are culled. *)
Theorem the_filter_with_a_separation_culls_some f alone : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Separated.is_culled f (if alone : bool then Beyond.a_vertex_and_a_face.culled_by_permanent_alone else
    Beyond.a_vertex_and_a_face.culled_by_permanent) place (1 / 2)) /\
  (exists place, Separated.is_culled f (if alone then Beyond.two_edges.culled_by_permanent_alone else
    Beyond.two_edges.culled_by_permanent) place (1 / 2)).
Proof. exact (Kept.some_are_culled f alone). Qed.

(* 15. **The time of impact with a separation**. A chain of rounds as in (10), with the bars of a separation s
       (AdvanceBeyond.v): a direction that is held, turns or moves on a curve, or the signed volume, which exceeds s times
       the length of the normal. `AdvancingBeyond.computed` says what is assumed: s is no subnormal number, and at most
       the largest extent, as the code requires. Up to the time that the chain reaches, and at it, the sets are farther
       apart than s, whatever is flushed. *)
Theorem a_vertex_and_a_face_stay_beyond place s begin until t i j r : AdvancingBeyond.reaches
  AdvancingBeyond.of_a_vertex_and_a_face place s begin until -> begin <= t <= until -> t <= 1 ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (at_time 0%nat) (plus (scaled i (at_time 1%nat)) (plus (scaled j (at_time
    2%nat)) (scaled r (at_time 3%nat))))).
Proof. exact (AdvancingBeyond.a_vertex_and_a_face_stay_apart place s begin until t i j r). Qed.
Theorem two_edges_stay_beyond place s begin until t i r : AdvancingBeyond.reaches AdvancingBeyond.of_two_edges place s
  begin until -> begin <= t <= until -> t <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  let at_time n := at_ (path_of place n) t in
  s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_time 0%nat)) (scaled i (at_time 1%nat)))
    (plus (scaled (1 - r) (at_time 2%nat)) (scaled r (at_time 3%nat)))).
Proof. exact (AdvancingBeyond.two_edges_stay_apart place s begin until t i r). Qed.
Theorem chains_with_a_separation_reach_the_end f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_a_vertex_and_a_face place (1 / 2) 0 1) /\
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_two_edges place (1 / 2) 0 1).
Proof. exact (Kept.chains_with_a_separation_reach_the_end f). Qed.
Theorem each_proof_with_a_separation_holds_for_some_pair f : f = Advance.binary32 \/ f = Advance.binary64 ->
  Kept.every_proof_holds AdvancingBeyond.of_a_vertex_and_a_face f /\ Kept.every_proof_holds AdvancingBeyond.of_two_edges f.
Proof. exact (Kept.every_proof_with_a_separation_holds_for_some f). Qed.
Theorem clipping_with_a_separation_advances_for_some_pair :
  Kept.clipping_advances AdvancingBeyond.of_a_vertex_and_a_face Advance.binary32 /\
  Kept.clipping_advances AdvancingBeyond.of_two_edges Advance.binary32.
Proof. exact Replayed.clipping_with_a_separation_advances_for_some. Qed.
(* An accepted step with a separation s: each pair that can touch in it is kept by a direction, or a chain of rounds
  with
   s reaches its end. Then each pair stays farther apart than s during it. *)
Theorem an_accepted_step_keeps_the_separation s (vertices_and_faces edges : list (coordinate -> R)) t :
  (forall place, List.In place vertices_and_faces -> AdvancingBeyond.reaches AdvancingBeyond.of_a_vertex_and_a_face
    place
    s 0 1 \/ exists f, (f = Advance.binary32 \/ f = Advance.binary64) /\ keeps_a_vertex_and_a_face f place s) ->
  (forall place, List.In place edges -> AdvancingBeyond.reaches AdvancingBeyond.of_two_edges place s 0 1 \/
    exists f, (f = Advance.binary32 \/ f = Advance.binary64) /\ keeps_two_edges f place s) ->
  0 <= t <= 1 ->
  (forall place i j r, List.In place vertices_and_faces -> 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 ->
    let at_time n := at_ (path_of place n) t in s ^ 2 < Certificates.length_squared (minus (at_time 0%nat) (plus (scaled
      i (at_time 1%nat)) (plus (scaled j (at_time 2%nat)) (scaled r (at_time 3%nat)))))) /\
  (forall place i r, List.In place edges -> 0 <= i <= 1 -> 0 <= r <= 1 -> let at_time n := at_ (path_of place n) t in
    s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_time 0%nat)) (scaled i (at_time 1%nat)))
      (plus (scaled (1 - r) (at_time 2%nat)) (scaled r (at_time 3%nat))))).
Proof.
  intros vf ee time. split.
  - intros place i j r inside i0 j0 r0 one. destruct (vf place inside) as [chain|(f & which & kept)].
    + apply (a_vertex_and_a_face_stay_beyond place s 0 1 t i j r chain time); lra.
    + exact (a_kept_vertex_and_face_stay_apart f place s t i j r which kept time i0 j0 r0 one).
  - intros place i r inside i01 r01. destruct (ee place inside) as [chain|(f & which & kept)].
    + apply (two_edges_stay_beyond place s 0 1 t i r chain time); lra.
    + exact (kept_edges_stay_apart f place s t i r which kept time i01 r01).
Qed.

(* 16. **The loop**. It keeps a record of its rounds (core/src/elementary/advance/witness.rs): for each part of the step its
       end and its proof, which are a direction that is held, turns or moves on a curve, or the signed volume. The
       interpreter of Replay.v computes each proof again: the traced terms, as programs that compute each step once, in
       Flocq's binary numbers, to nearest. `Replayed.is_replayed_...` says that each part is proven until exactly the end
       that it has, by directions no longer than (10) requires, and the last part until exactly the time that was
       answered; or that exact boxes prove the whole step. Then chains of rounds as in (10) and (15) reach that time, and
       the pair is apart up to it. *)
Theorem a_replayed_vertex_and_face_do_not_touch w run t : Replayed.is_replayed_vertex_and_face w run = true ->
  Replayed.is_separated run = false -> 0 <= t <= Replayed.time_of w run /\ 0 < Replayed.time_of w run /\ t <= 1 ->
  let at_time n := at_ (path_of (Replayed.place_of w run) n) t in
  ~ vertex_in_triangle (at_time 0%nat) (at_time 1%nat) (at_time 2%nat) (at_time 3%nat).
Proof. intros h plain before. exact (Replayed.a_replayed_vertex_and_face_do_not_touch w run t before h plain). Qed.
Theorem replayed_edges_do_not_touch w run t : Replayed.are_replayed_edges w run = true ->
  Replayed.is_separated run = false -> 0 <= t <= Replayed.time_of w run /\ 0 < Replayed.time_of w run /\ t <= 1 ->
  let at_time n := at_ (path_of (Replayed.place_of w run) n) t in
  ~ segments_meet (at_time 0%nat) (at_time 1%nat) (at_time 2%nat) (at_time 3%nat).
Proof. intros h plain before. exact (Replayed.replayed_edges_do_not_touch w run t before h plain). Qed.
Theorem a_replayed_vertex_and_face_stay_apart w run t i j r : Replayed.is_replayed_vertex_and_face w run = true ->
  Replayed.is_separated run = true -> 0 <= t <= Replayed.time_of w run /\ 0 < Replayed.time_of w run /\ t <= 1 ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> let at_time n := at_ (path_of (Replayed.place_of w run) n) t in
  Replayed.separation_of w run ^ 2 < Certificates.length_squared (minus (at_time 0%nat) (plus (scaled i (at_time 1%nat))
    (plus (scaled j (at_time 2%nat)) (scaled r (at_time 3%nat))))).
Proof.
  intros h separated before. exact (Replayed.a_replayed_vertex_and_face_stay_apart w run t before i j r h separated).
Qed.
Theorem replayed_edges_stay_apart w run t i r : Replayed.are_replayed_edges w run = true ->
  Replayed.is_separated run = true -> 0 <= t <= Replayed.time_of w run /\ 0 < Replayed.time_of w run /\ t <= 1 ->
  0 <= i <= 1 -> 0 <= r <= 1 -> let at_time n := at_ (path_of (Replayed.place_of w run) n) t in
  Replayed.separation_of w run ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_time 0%nat)) (scaled i (at_time 1%nat)))
    (plus (scaled (1 - r) (at_time 2%nat)) (scaled r (at_time 3%nat)))).
Proof. intros h separated before. exact (Replayed.replayed_edges_stay_apart w run t before i r h separated). Qed.
(* The code's runs (Runs.v): pairs of both kinds in both formats, with a separation and without, with all proofs, in few
   rounds and in many. The interpreter accepts each until exactly the time that the code answered. *)
Theorem the_runs_of_the_code_are_replayed w :
  List.forallb (Replayed.is_replayed_vertex_and_face w) (fst (Replayed.runs_of w)) = true /\
  List.forallb (Replayed.are_replayed_edges w) (snd (Replayed.runs_of w)) = true.
Proof. exact (Replayed.the_runs_of_the_code_are_replayed w). Qed.

(* 17. Certificates.v has the lemmas about exact numbers that they and truncation rest on: a direction held or turning
       over a part of the step, the volume there, shares of ways. *)

(* 17. The exact verdict (`Verdicts.v`, after contact/remainder.rs, moment.rs and mod.rs). A time t is s = t / (1 - t); the
       control values are the coefficients of a polynomial in s that has the volume's sign. *)
Theorem the_volume_in_s k0 k1 k2 k3 t : 0 <= t < 1 ->
  IZR k0 * (1 - t) ^ 3 + IZR k1 * (1 - t) ^ 2 * t + IZR k2 * (1 - t) * t ^ 2 + IZR k3 * t ^ 3 =
    (1 - t) ^ 3 * Verdicts.at_ [k0; k1; k2; k3]%list (t / (1 - t)).
Proof. intro time. rewrite Verdicts.at_cubic. field. lra. Qed.
(* The sign of a polynomial at a root of a quadratic or of a linear polynomial, and the order of two roots, are right. *)
Theorem signs_at_roots_are_right q p : Verdicts.is_root q -> (2 <= List.length p)%nat ->
  Integers.says (Verdicts.at_ p (Verdicts.root_value q)) (Verdicts.sign_at_root Verdicts.whole q p).
Proof. exact (Verdicts.sign_at_root_is q p). Qed.
Theorem roots_compare_as_numbers q o : Verdicts.is_root q -> Verdicts.is_root o ->
  Integers.says (Verdicts.root_value q - Verdicts.root_value o) (Verdicts.compare Verdicts.whole q o).
Proof. exact (Verdicts.compare_is q o). Qed.
(* Computed in words, the times inside the step that the code tests are those at which the volume is zero, if it is not
   zero throughout; and the signs of linear and quadratic polynomials that it computes at each of them are right. *)
Theorem the_times_that_are_tested_are_the_roots w0 w1 w2 w3 k0 k1 k2 k3 : Integers.holds w0 k0 -> Integers.holds w1 k1 ->
  Integers.holds w2 k2 -> Integers.holds w3 k3 -> ~ List.Forall (fun k => k = 0%Z) [k0; k1; k2; k3]%list ->
  (forall m, List.In m (Verdicts.times_of Verdicts.in_words w0 w1 w2 w3) ->
    exists s, Verdicts.is_time_in_words m s /\ Verdicts.at_ [k0; k1; k2; k3]%list s = 0) /\
  (forall s, 0 < s -> Verdicts.at_ [k0; k1; k2; k3]%list s = 0 ->
    exists m, List.In m (Verdicts.times_of Verdicts.in_words w0 w1 w2 w3) /\ Verdicts.is_time_in_words m s).
Proof. exact (Verdicts.times_in_words w0 w1 w2 w3 k0 k1 k2 k3). Qed.

Print Assumptions formats_are_reasonable.
Print Assumptions an_operation_is_nearly_exact.
Print Assumptions one_sign_excludes_contact_of_a_vertex_and_a_face.
Print Assumptions one_sign_excludes_contact_of_two_edges.
Print Assumptions a_culled_vertex_and_face_do_not_touch.
Print Assumptions culled_edges_do_not_touch.
Print Assumptions widened_culls_no_vertex_and_face_that_touch.
Print Assumptions widened_culls_no_edges_that_touch.
Print Assumptions boxes_apart_exclude_contact_of_a_vertex_and_a_face.
Print Assumptions boxes_apart_exclude_contact_of_two_edges.
Print Assumptions executions_exist.
Print Assumptions every_decision_culls_some_pair.
Print Assumptions the_permanent_culls_some_pair.
Print Assumptions every_box_test_culls_some_pair.
Print Assumptions integers_of_a_fixed_width_are_exact.
Print Assumptions integers_in_a_space_are_exact.
Print Assumptions exact_signs_are_right.
Print Assumptions control_values_are_those_of_the_volume.
Print Assumptions constants_of_the_time_of_impact.
Print Assumptions environments_exist.
Print Assumptions no_contact_of_a_vertex_and_a_face_before.
Print Assumptions no_contact_of_two_edges_before.
Print Assumptions chains_reach_the_end.
Print Assumptions each_proof_of_a_round_holds_for_some_pair.
Print Assumptions clipping_advances_for_some_pair.
Print Assumptions an_accepted_witness_of_a_vertex_and_a_face_is_right.
Print Assumptions an_accepted_witness_of_two_edges_is_right.
Print Assumptions the_checker_accepts_some.
Print Assumptions times_are_rounded_down.
Print Assumptions lengths_are_rounded_up.
Print Assumptions widening_is_exact.
Print Assumptions Narrowing.the_code_returns_the_same.
Print Assumptions a_kept_vertex_and_face_stay_apart.
Print Assumptions kept_edges_stay_apart.
Print Assumptions some_pairs_are_kept.
Print Assumptions what_is_stored_is_the_same.
Print Assumptions a_stored_gap_is_at_most_the_exact_one.
Print Assumptions some_pairs_last.
Print Assumptions a_computed_distance_of_a_vertex_and_a_face_is_right.
Print Assumptions a_computed_distance_of_two_edges_is_right.
Print Assumptions an_accepted_step_has_no_contact.
Print Assumptions a_culled_vertex_and_face_stay_apart.
Print Assumptions culled_edges_stay_apart.
Print Assumptions the_filter_with_a_separation_culls_some.
Print Assumptions a_vertex_and_a_face_stay_beyond.
Print Assumptions two_edges_stay_beyond.
Print Assumptions chains_with_a_separation_reach_the_end.
Print Assumptions each_proof_with_a_separation_holds_for_some_pair.
Print Assumptions clipping_with_a_separation_advances_for_some_pair.
Print Assumptions an_accepted_step_keeps_the_separation.
Print Assumptions a_replayed_vertex_and_face_do_not_touch.
Print Assumptions replayed_edges_do_not_touch.
Print Assumptions a_replayed_vertex_and_face_stay_apart.
Print Assumptions replayed_edges_stay_apart.
Print Assumptions the_runs_of_the_code_are_replayed.
Print Assumptions Certificates.a_product_bounds_the_distance.
Print Assumptions Certificates.ahead_of_the_triangle.
Print Assumptions Certificates.between_two_ahead.
Print Assumptions Certificates.held_direction.
Print Assumptions Certificates.turning_direction.
Print Assumptions Certificates.one_sign_on_a_part.
Print Assumptions Certificates.truncated_ways_keep_the_gap.
Print Assumptions the_volume_in_s.
Print Assumptions signs_at_roots_are_right.
Print Assumptions roots_compare_as_numbers.
Print Assumptions the_times_that_are_tested_are_the_roots.
Print Assumptions Samples.tiny_numbers_are_the_same.
Print Assumptions Samples.numbers_of_a_fixed_width_are_the_same.
Print Assumptions Samples.numbers_in_a_space_are_the_same.
Print Assumptions Samples.shifted_numbers_are_the_same.
Print Assumptions Samples.signs_of_kept_pairs_are_the_same.
