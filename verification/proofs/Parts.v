(* The filter in parts of the step: each part's control values have one sign, or an axis lies between the sets at both its ends. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core Mult_error.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent Corners Direction.
From Selvedge Require Apart.
Open Scope R_scope.

(* The filter's terms over other names of the same differences. *)
Fixpoint renamed (g : component -> span_component) (e : expr) : number := match e with
  | Difference c => Difference (g c)
  | Constant c => Constant c
  | Sum a b => Sum (renamed g a) (renamed g b)
  | Minus a b => Minus (renamed g a) (renamed g b)
  | Product a b => Product (renamed g a) (renamed g b)
  | Negative a => Negative (renamed g a)
  | Magnitude a => Magnitude (renamed g a)
  | Larger a b => Larger (renamed g a) (renamed g b)
  | Smaller a b => Smaller (renamed g a) (renamed g b) end.
Lemma renamed_execution f from to value_of g : execution f from to value_of ->
  execution f (fun c => from (g c)) (fun c => to (g c)) (fun e => value_of (renamed g e)).
Proof. intros run e. pose proof (run (renamed g e)) as v. destruct e; exact v. Qed.

(* The code in words: core/src/filter/subdivided.rs. *)
Record part_values := Values { b0 : number; b1 : number; b2 : number; b3 : number }.
Definition mean a b : number := Product (Constant Half) (Sum a b).
Definition first_half v :=
  let c0 := mean (b0 v) (b1 v) in let c1 := mean (b1 v) (b2 v) in let c2 := mean (b2 v) (b3 v) in
  let d0 := mean c0 c1 in let d1 := mean c1 c2 in Values (b0 v) c0 d0 (mean d0 d1).
Definition second_half v :=
  let c0 := mean (b0 v) (b1 v) in let c1 := mean (b1 v) (b2 v) in let c2 := mean (b2 v) (b3 v) in
  let d0 := mean c0 c1 in let d1 := mean c1 c2 in Values (mean d0 d1) d1 c2 (b3 v).
Definition flat_nowhere B v : test :=
  Either (Both (Both (Greater (b0 v) B) (Greater (b1 v) B)) (Both (Greater (b2 v) B) (Greater (b3 v) B)))
    (Both (Both (Greater (Negative B) (b0 v)) (Greater (Negative B) (b1 v))) (Both (Greater (Negative B) (b2 v)) (Greater (Negative B) (b3 v)))).
Definition at_time (t : number) s k : number :=
  Sum (Product (Minus (Constant (Small 1)) t) (Difference (Span s Start k))) (Product t (Difference (Span s End k))).
Definition side_bound s k : number :=
  Sum (Product (Product (Constant (Small 12)) (Constant UnitRoundoff))
    (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k))))) (Constant Underflow).
Definition is_ahead t0 t1 k s := Both (Greater (at_time t0 s k) (side_bound s k)) (Greater (at_time t1 s k) (side_bound s k)).
Definition is_behind t0 t1 k s := Both (Greater (Negative (side_bound s k)) (at_time t0 s k)) (Greater (Negative (side_bound s k)) (at_time t1 s k)).
Section Words.
Variable corner : nat -> span.
Definition separates t0 t1 k := Either (of_four Both (is_ahead t0 t1 k) corner) (of_four Both (is_behind t0 t1 k) corner).
Definition an_axis_separates t0 t1 := Either (Either (separates t0 t1 X) (separates t0 t1 Y)) (separates t0 t1 Z_).
Variable B : number.
Fixpoint is_clear halvings v t0 t1 := let here := Either (flat_nowhere B v) (an_axis_separates t0 t1) in match halvings with
  | O => here
  | S n => Either here (Both (is_clear n (first_half v) t0 (mean t0 t1)) (is_clear n (second_half v) (mean t0 t1) t1)) end.
End Words.
Section OfNames.
Variable g : component -> span_component.
Definition three a : number := Product (Constant (Small 3)) a.
Definition k_ e := renamed g e.
Definition volumes := Values (three (k_ control_value_0)) (k_ control_value_1) (k_ control_value_2) (three (k_ control_value_3)).
Definition error_ := Larger (three (Larger (k_ error_bound_0) (k_ error_bound_3))) (Larger (k_ error_bound_1) (k_ error_bound_2)).
Definition size_of_all := Larger (Larger (Magnitude (b0 volumes)) (Magnitude (b1 volumes))) (Larger (Magnitude (b2 volumes)) (Magnitude (b3 volumes))).
Definition volume_bound := Sum (Sum error_ (Product (Product (Constant (Small 32)) (Constant UnitRoundoff)) size_of_all)) (Constant Underflow).
Definition clear_in_parts corner halvings := Both (Both (Greater (Constant LargestEdge) (k_ Permanent.largest)) (Both (Both Finite Finite) (Both Finite Finite)))
  (is_clear corner volume_bound halvings volumes (Constant (Small 0)) (Constant (Small 1))).
End OfNames.
Definition names_of_a_vertex_and_a_face c := match c with Component B t k => Span S1 t k | Component C t k => Span S2 t k | Component P t k => Span S0 t k end.
Definition names_of_two_edges c := match c with Component B t k => Span S0 t k | Component C t k => Span S1 t k | Component P t k => Span S2 t k end.
Lemma the_code_of_a_vertex_and_a_face :
  let clear n := clear_in_parts names_of_a_vertex_and_a_face corners_of_a_vertex_and_a_face n in
  a_vertex_and_a_face.culled_in_2_parts = clear 1%nat /\ a_vertex_and_a_face.culled_in_4_parts = clear 2%nat /\
  a_vertex_and_a_face.culled_in_8_parts = clear 3%nat /\ a_vertex_and_a_face.culled_in_16_parts = clear 4%nat.
Proof. repeat split; reflexivity. Qed.
Lemma the_code_of_two_edges :
  let clear n := clear_in_parts names_of_two_edges corners_of_two_edges n in
  two_edges.culled_in_2_parts = clear 1%nat /\ two_edges.culled_in_4_parts = clear 2%nat /\
  two_edges.culled_in_8_parts = clear 3%nat /\ two_edges.culled_in_16_parts = clear 4%nat.
Proof. repeat split; reflexivity. Qed.
