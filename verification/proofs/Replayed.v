(* Programs.v has the traced terms, so the interpreter (Replay.v) is right about the code's rounds. It accepts the records
   of the runs in Runs.v, each until exactly the time that the code answered. *)
From Coq Require Import Reals ZArith List Bool Lra FMapPositive.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Geometry Machine Replay.
From Selvedge Require Expressions Apart Certificates Chains Witnesses Corners Advance AdvanceBeyond Advancing
  AdvancingBeyond Kept Programs Runs.
Import ListNotations.
Open Scope R_scope.

Ltac by_steps := split; [|split]; match goal with |- ?x = _ => exact_no_check (eq_refl x) end.
Theorem programs_of_a_vertex_and_a_face : are_programs Programs.a_vertex_and_a_face.all Advancing.of_a_vertex_and_a_face.
Proof.
  constructor; [reflexivity|exists Programs.a_vertex_and_a_face.held_places|exists Programs.a_vertex_and_a_face.turning_places|
    exists Programs.a_vertex_and_a_face.curving_places|exists Programs.a_vertex_and_a_face.volume_places]; by_steps.
Qed.
Theorem programs_of_two_edges : are_programs Programs.two_edges.all Advancing.of_two_edges.
Proof.
  constructor; [reflexivity|exists Programs.two_edges.held_places|exists Programs.two_edges.turning_places|
    exists Programs.two_edges.curving_places|exists Programs.two_edges.volume_places]; by_steps.
Qed.
Theorem programs_of_a_vertex_and_a_face_beyond : are_programs Programs.a_vertex_and_a_face_beyond.all
  (without AdvancingBeyond.of_a_vertex_and_a_face).
Proof.
  constructor; [reflexivity|exists Programs.a_vertex_and_a_face_beyond.held_places|
    exists Programs.a_vertex_and_a_face_beyond.turning_places|exists Programs.a_vertex_and_a_face_beyond.curving_places|
    exists Programs.a_vertex_and_a_face_beyond.volume_places]; by_steps.
Qed.
Theorem programs_of_two_edges_beyond : are_programs Programs.two_edges_beyond.all (without AdvancingBeyond.of_two_edges).
Proof.
  constructor; [reflexivity|exists Programs.two_edges_beyond.held_places|
    exists Programs.two_edges_beyond.turning_places|exists Programs.two_edges_beyond.curving_places|
    exists Programs.two_edges_beyond.volume_places]; by_steps.
Qed.

(* Both formats. *)
Variant width := Single | Double.
Definition pick {A} (x y : A) w := match w with Single => x | Double => y end.
Definition prec := pick 24%Z 53%Z.
Definition emax := pick 128%Z 1024%Z.
Definition p0 w : Prec_gt_0 (prec w) := match w with Single => Witnesses.gt24 | Double => Witnesses.gt53 end.
Definition pe w : Prec_lt_emax (prec w) (emax w) := match w with Single => Witnesses.lt24 | Double => Witnesses.lt53 end.
Definition largest_extent := pick 29%Z 250%Z.
Notation in_format theorem w := (theorem (prec w) (emax w) (pick (-117) (-1000) w) (pick 30 250 w) (pick (-100) (-960) w)
  (largest_extent w) (pick (-100) (-900) w) (pick (-62) (-510) w))%Z.
Definition proves w := in_format Replay.proves w (p0 w) (pe w).
Definition is_separation w := Replay.is_separation (prec w) (emax w) (largest_extent w) (p0 w) (pe w).
Definition number_of w := Replay.number_of (prec w) (emax w) (p0 w) (pe w).
Lemma is_fine w : Corners.reasonable_constants (in_format Chains.constants_of w).
Proof. destruct w; [exact Chains.single_is_fine|exact Chains.double_is_fine]. Qed.

(* What a run claims, in a format. *)
Definition place_of w run (c : Expressions.coordinate) := B2R (number_of w (coordinate_of run c)).
Definition separation_of w run := B2R (number_of w (separated_by run)).
Definition time_of w run := B2R (number_of w (answered run)).
Definition is_separated run := negb (Z.eqb (fst (separated_by run)) 0).
(* The interpreter accepts its record until exactly the time that it claims. *)
Definition is_replayed w pairs (plain beyond : programs) run := let place_ c := number_of w (coordinate_of run c) in
  let answer := number_of w (answered run) in
  if is_separated run then let s := number_of w (separated_by run) in
    is_separation w s && proves w beyond place_ s pairs (recorded run) answer
  else proves w plain place_ (zero _ _) pairs (recorded run) answer.
Definition is_replayed_vertex_and_face w := is_replayed w Corners.vertex_face Programs.a_vertex_and_a_face.all
  Programs.a_vertex_and_a_face_beyond.all.
Definition are_replayed_edges w := is_replayed w Corners.edge_edge Programs.two_edges.all Programs.two_edges_beyond.all.
Section OfARun.
Variable w : width.
Variable run : of_run.
Variable t : R.
Hypothesis before : 0 <= t <= time_of w run /\ 0 < time_of w run /\ t <= 1.
Notation position n := (at_ (Apart.path_of (place_of w run) n) t).
Theorem a_replayed_vertex_and_face_do_not_touch : is_replayed_vertex_and_face w run = true -> is_separated run = false ->
  ~ vertex_in_triangle (position 0) (position 1) (position 2) (position 3).
Proof.
  intros h plain. unfold is_replayed_vertex_and_face, is_replayed in h. rewrite plain in h.
  pose proof programs_of_a_vertex_and_a_face as right_. rewrite Advancing.vertex_and_face_corners in right_.
  destruct before as (between & some & t1).
  destruct (a_record_proves_apart _ _ _ _ _ _ _ _ (p0 w) (pe w) (is_fine w) _ _ _ _ _ _ _ _ t right_ h some between t1)
    as (given & same & [ahead|volume]).
  - exact (Advancing.ahead_excludes_contact_of_a_vertex_and_a_face _ given t same ahead).
  - exact (Advancing.volume_excludes_contact_of_a_vertex_and_a_face _ given t same volume).
Qed.
Theorem replayed_edges_do_not_touch : are_replayed_edges w run = true -> is_separated run = false ->
  ~ segments_meet (position 0) (position 1) (position 2) (position 3).
Proof.
  intros h plain. unfold are_replayed_edges, is_replayed in h. rewrite plain in h.
  pose proof programs_of_two_edges as right_. rewrite Advancing.two_edges_corners in right_.
  destruct before as (between & some & t1).
  destruct (a_record_proves_apart _ _ _ _ _ _ _ _ (p0 w) (pe w) (is_fine w) _ _ _ _ _ _ _ _ t right_ h some between t1)
    as (given & same & [ahead|volume]).
  - exact (Advancing.ahead_excludes_contact_of_two_edges _ given t same ahead).
  - exact (Advancing.volume_excludes_contact_of_two_edges _ given t same volume).
Qed.
Theorem a_replayed_vertex_and_face_stay_apart i j r : is_replayed_vertex_and_face w run = true -> is_separated run = true ->
  0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> separation_of w run ^ 2 < Certificates.length_squared (minus (position 0)
  (plus (scaled i (position 1)) (plus (scaled j (position 2)) (scaled r (position 3))))).
Proof.
  intros h separated i0 j0 r0 one_. unfold is_replayed_vertex_and_face, is_replayed in h. rewrite separated in h.
  apply andb_prop in h as [sep h].
  pose proof programs_of_a_vertex_and_a_face_beyond as right_. rewrite (proj1 AdvancingBeyond.traced_terms) in right_.
  destruct before as (between & some & t1).
  destruct (a_record_proves_a_separation _ _ _ _ _ _ _ _ (p0 w) (pe w) (is_fine w) _ _ _ _ _ _ sep _ _ _ t right_ h some
    between t1) as (s0 & given & same & [far|far]).
  - apply (AdvancingBeyond.a_vertex_and_a_face_ahead _ given); auto. apply Rlt_le. exact s0.
  - apply (AdvancingBeyond.a_vertex_and_a_face_far _ given); auto.
Qed.
Theorem replayed_edges_stay_apart i r : are_replayed_edges w run = true -> is_separated run = true -> 0 <= i <= 1 ->
  0 <= r <= 1 -> separation_of w run ^ 2 < Certificates.length_squared (minus
  (plus (scaled (1 - i) (position 0)) (scaled i (position 1))) (plus (scaled (1 - r) (position 2)) (scaled r (position 3)))).
Proof.
  intros h separated i01 r01. unfold are_replayed_edges, is_replayed in h. rewrite separated in h.
  apply andb_prop in h as [sep h].
  pose proof programs_of_two_edges_beyond as right_. rewrite (proj2 AdvancingBeyond.traced_terms) in right_.
  destruct before as (between & some & t1).
  destruct (a_record_proves_a_separation _ _ _ _ _ _ _ _ (p0 w) (pe w) (is_fine w) _ _ _ _ _ _ sep _ _ _ t right_ h some
    between t1) as (s0 & given & same & [far|far]).
  - apply (AdvancingBeyond.two_edges_ahead _ given); auto. apply Rlt_le. exact s0.
  - apply (AdvancingBeyond.two_edges_far _ given); auto.
Qed.
End OfARun.

(* The code's runs. *)
Definition runs_of w := (pick Runs.single_a_vertex_and_a_face Runs.double_a_vertex_and_a_face w,
  pick Runs.single_two_edges Runs.double_two_edges w).
Theorem the_runs_of_the_code_are_replayed w : forallb (is_replayed_vertex_and_face w) (fst (runs_of w)) = true /\
  forallb (are_replayed_edges w) (snd (runs_of w)) = true.
Proof. destruct w; split; vm_cast_no_check (eq_refl true). Qed.

(* Clipping gives a later time for some pairs: those of Chains.v and Kept.v that fall through each other. *)
Notation in_single theorem := (theorem 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _)%Z.
Definition advances code input_ := match snd (in_single result_of (volume code) input_) with
  | Some u => Bltb (zero 24 128) u
  | None => false end.
Lemma clipping_gives code all input_ : are_programs code all -> advances code input_ = true -> exists u,
  Chains.nearest 24 128 (-117) 30 (-100) 29 (-100) (-62) Chains.single_is_fine (fun i => B2R (input_ i))
    (Advancing.until_volume all) = Number u /\ 0 < u.
Proof.
  intros right_ h. destruct (volume_is _ _ right_) as (places & valid).
  destruct (in_single result_is_right Chains.single_is_fine places _ _ _ input_ valid) as [_ numbers].
  unfold advances in h. destruct (snd _) as [u|]; [|discriminate]. destruct (numbers u eq_refl) as [E fin].
  exists (B2R u). split; [exact E|]. apply (less 24 128 (zero 24 128) u); [reflexivity|exact fin|exact h].
Qed.
Theorem clipping_advances_for_some : Chains.clipping_advances Advancing.of_a_vertex_and_a_face Advance.binary32 /\
  Chains.clipping_advances Advancing.of_two_edges Advance.binary32.
Proof.
  assert (all_ : forall code all place_, Chains.is_small place_ -> are_programs code all ->
    in_single Chains.is_true place_ (Advancing.is_in_range all) = true ->
    advances code (fun i => Chains.whole 24 128 _ _ (Chains.halves place_ i) (-1)) = true ->
    Chains.clipping_advances all Advance.binary32).
  { intros code all place_ small right_ range_ h.
    destruct (in_single Chains.what_is_computed Chains.single_is_fine place_ small all range_) as (c & _).
    eexists. eexists. eexists. eexists. split; [exact c|]. exact (clipping_gives _ _ _ right_ h). }
  split.
  - apply (all_ _ _ _ (Chains.small_vertex_and_face (-2) eq_refl) programs_of_a_vertex_and_a_face);
      vm_cast_no_check (eq_refl true).
  - apply (all_ _ _ _ (Chains.small_edges (-2) eq_refl) programs_of_two_edges); vm_cast_no_check (eq_refl true).
Qed.
Theorem clipping_with_a_separation_advances_for_some :
  Kept.clipping_advances AdvancingBeyond.of_a_vertex_and_a_face Advance.binary32 /\
  Kept.clipping_advances AdvancingBeyond.of_two_edges Advance.binary32.
Proof.
  assert (all_ : forall code all place_, Chains.is_small place_ -> are_programs code (without all) ->
    in_single Kept.computed place_ (B754_zero false) (AdvancingBeyond.is_in_range all) = true ->
    advances code (Kept.input_ 24 128 _ _ place_ (B754_zero false)) = true -> Kept.clipping_advances all Advance.binary32).
  { intros code all place_ small right_ range_ h.
    destruct (in_single Kept.what_is_computed Chains.single_is_fine place_ small (B754_zero false) all range_) as (c & _).
    eexists. eexists. eexists. eexists. split; [exact c|]. exact (clipping_gives _ _ _ right_ h). }
  split.
  - apply (all_ _ _ _ (Chains.small_vertex_and_face (-2) eq_refl) programs_of_a_vertex_and_a_face_beyond);
      vm_cast_no_check (eq_refl true).
  - apply (all_ _ _ _ (Chains.small_edges (-2) eq_refl) programs_of_two_edges_beyond); vm_cast_no_check (eq_refl true).
Qed.
