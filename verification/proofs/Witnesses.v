(* No theorem is empty: pairs that the traced code culls, computed in Coq with Flocq's binary numbers. *)
From Coq Require Import Reals ZArith Lra Lia Bool List.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Arithmetic Expressions Filter Permanent Magnitudes Nearest.
From Selvedge Require Orders Boxes.
Import ListNotations.
Open Scope R_scope.

(* Corners a, b, c of a slanted triangle and a point p above it by h, all at rest, as whole numbers. *)
Section Pairs.
Variables n h : Z.
Definition corner (role : nat) (axis_ : axis) : Z := match role, axis_ with
  | 1%nat, X | 1%nat, Z_ => n
  | 2%nat, Y | 2%nat, Z_ => n
  | 3%nat, X | 3%nat, Y => n
  | 3%nat, Z_ => 2 * n + h
  | _, _ => 0 end%Z.
(* Roles of the points 0 to 3: VF p a b c, EE b c a p. *)
Definition in_vertex_face point := match point with 0%nat => 3%nat | 1%nat => 0%nat | 2%nat => 1%nat | _ => 2%nat end.
Definition in_edge_edge point := match point with 0%nat => 1%nat | 1%nat => 2%nat | 2%nat => 0%nat | _ => 3%nat end.
Definition whole roles (c : coordinate) := let '(Coordinate point _ axis_) := c in corner (roles point) axis_.
End Pairs.

Section InAFormat.
Variables prec emax underflow_ largest_ : Z.
Context (p0 : Prec_gt_0 prec) (pe : Prec_lt_emax prec emax).
Notation f := (format_of prec emax underflow_ largest_).
Hypothesis ok : reasonable f.
Context {component : Type}.
Definition binary n h roles c : binary_float prec emax := binary_normalize prec emax _ _ mode_NE (whole n h roles c) 0
  false.
Definition placed n h roles c := B2R (binary n h roles c).
Definition holds_of n h roles (of : component -> coordinate * coordinate) :=
  holds prec emax p0 pe underflow_ largest_ (fun c => binary n h roles (snd (of c))) (fun c => binary n h roles (fst (of
    c))).
Definition all_finite n h roles (of : component -> coordinate * coordinate) := forall c,
  is_finite (binary n h roles (fst (of c))) = true /\ is_finite (binary n h roles (snd (of c))) = true.
(* To nearest with nothing flushed; so products take their operands as they are. *)
Theorem witness_alike n h roles (of : component -> coordinate * coordinate) m : all_finite n h roles of -> holds_of n h
  roles of m = true ->
  exists value_of, execution f (fun c => placed n h roles (snd (of c))) (fun c => placed n h roles (fst (of c)))
    value_of /\
  (forall a b x y, value_of a = Number x -> value_of b = Number y -> result f (x * y) (value_of (Product a b))) /\
    says f value_of m.
Proof.
  intros fin h_. exists (nearest prec emax underflow_ largest_ (fun c => placed n h roles (snd (of c))) (fun c => placed
    n h roles (fst (of c)))).
  split; [|split].
  - apply an_execution_exists; assumption.
  - intros a b x y va vb. cbn [nearest]. rewrite va, vb. cbn [lifted]. apply settled_result; assumption.
  - eapply what_holds_is_said; [exact ok|reflexivity|reflexivity|apply fin|apply fin|exact h_].
Qed.
Theorem witness n h roles of m : all_finite n h roles of -> holds_of n h roles of m = true ->
  exists value_of, execution f (fun c => placed n h roles (snd (of c))) (fun c => placed n h roles (fst (of c)))
    value_of /\
  says f value_of m.
Proof. intros fin h_. destruct (witness_alike n h roles of m fin h_) as (value_of & run & _ & culled). exists value_of.
  auto. Qed.
End InAFormat.

#[global] Instance gt24 : Prec_gt_0 24. Proof. reflexivity. Qed.
#[global] Instance lt24 : Prec_lt_emax 24 128. Proof. reflexivity. Qed.
#[global] Instance gt53 : Prec_gt_0 53. Proof. reflexivity. Qed.
#[global] Instance lt53 : Prec_lt_emax 53 1024. Proof. reflexivity. Qed.
Definition single {component : Type} := holds_of (component := component) 24 128 (-117) 30 gt24 lt24.
Definition double {component : Type} := holds_of (component := component) 53 1024 (-1000) 250 gt53 lt53.

(* All tiers cull a pair at rest far above, in both formats; close above, only the permanent, the last part of the
   decision, culls it. *)
Definition decisions := [culled_by_permanent_alone; culled_by_permanent].
Lemma all_tiers_cull_what_is_far : forall m, In m decisions ->
  single 4 4 in_vertex_face vertex_face m = true /\ single 4 4 in_edge_edge edge_edge m = true /\
  double 4 4 in_vertex_face vertex_face m = true /\ double 4 4 in_edge_edge edge_edge m = true.
Proof. intros m [<-|[<-|[]]]; repeat split; vm_compute; reflexivity. Qed.
Lemma the_permanent_culls_what_is_close :
  single 1048576 32 in_vertex_face vertex_face first_part = false /\ single 1048576 32 in_vertex_face vertex_face
    last_part = true /\
  single 1048576 32 in_edge_edge edge_edge first_part = false /\ single 1048576 32 in_edge_edge edge_edge last_part =
    true.
Proof. repeat split; vm_compute; reflexivity. Qed.

Definition culls_some {component : Type} f (of : component -> coordinate * coordinate) m := exists (place : coordinate
  -> R) value_of, (forall c, representable f (place (fst (of c))) /\
  representable f (place (snd (of c)))) /\
  execution f (fun c => place (snd (of c))) (fun c => place (fst (of c))) value_of /\ says f value_of m.
Lemma binary_is_representable prec emax (p0 : Prec_gt_0 prec) (x : binary_float prec emax) :
  generic_format radix2 (FLT_exp (3 - emax - prec) prec) (B2R x).
Proof. apply generic_format_B2R. Qed.
Ltac culls_by prec emax underflow_ largest_ ok n h roles of proof :=
  destruct (witness prec emax underflow_ largest_ _ _ ok n h roles of _ ltac:(intros [[| |] [|] [| |]]; split;
    vm_compute; reflexivity) proof)
    as (value_of & run & culled); clear - run culled; exists (placed prec emax _ _ n h roles), value_of;
  split; [intro c; split; apply binary_is_representable; exact _|split; assumption].
Lemma single_is_reasonable : reasonable (format_of 24 128 (-117) 30). Proof. constructor; cbn; lia. Qed.
Lemma double_is_reasonable : reasonable (format_of 53 1024 (-1000) 250). Proof. constructor; cbn; lia. Qed.
Theorem every_decision_culls_some m f : In m decisions -> f = binary32 \/ f = binary64 ->
  culls_some f vertex_face m /\ culls_some f edge_edge m.
Proof.
  intros which [-> | ->]; destruct (all_tiers_cull_what_is_far m which) as (a & b & c & d); split.
  - culls_by 24%Z 128%Z (-117)%Z 30%Z single_is_reasonable 4%Z 4%Z in_vertex_face vertex_face a.
  - culls_by 24%Z 128%Z (-117)%Z 30%Z single_is_reasonable 4%Z 4%Z in_edge_edge edge_edge b.
  - culls_by 53%Z 1024%Z (-1000)%Z 250%Z double_is_reasonable 4%Z 4%Z in_vertex_face vertex_face c.
  - culls_by 53%Z 1024%Z (-1000)%Z 250%Z double_is_reasonable 4%Z 4%Z in_edge_edge edge_edge d.
Qed.
Theorem the_last_part_culls_some : culls_some binary32 vertex_face last_part /\ culls_some binary32 edge_edge last_part.
Proof.
  destruct the_permanent_culls_what_is_close as (_ & a & _ & b). split.
  - culls_by 24%Z 128%Z (-117)%Z 30%Z single_is_reasonable 1048576%Z 32%Z in_vertex_face vertex_face a.
  - culls_by 24%Z 128%Z (-117)%Z 30%Z single_is_reasonable 1048576%Z 32%Z in_edge_edge edge_edge b.
Qed.

(* Boxes: one set at x = 2 and the other at 0, with nothing flushed. *)
Definition beside first (c : coordinate) : R := let '(Coordinate point _ axis_) := c in
  if Nat.ltb point first then match axis_ with X => 2 | _ => 0 end else 0.
Definition plain := Orders.Environment false.
Section Boxes_.
Variable f : format.
Variable place : coordinate -> R.
Notation sight := (Orders.sight f plain place).
Lemma sight_is_an_execution : Orders.execution f plain place sight.
Proof.
  intros [c|a b|a b]; cbn; try reflexivity.
  - unfold Orders.chosen, Rmax. destruct (Rle_dec (sight a) (sight b)); [right|left]; cbn; split; auto; lra.
  - unfold Orders.chosen, Rmin. destruct (Rle_dec (sight a) (sight b)); [left|right]; cbn; split; auto; lra.
Qed.
End Boxes_.
Theorem every_box_test_culls_some f : exists value_of value_of',
  Orders.execution f plain (beside 1) value_of /\ Orders.execution f plain (beside 2) value_of' /\
  Orders.says f plain value_of Boxes.a_vertex_and_a_face.culled_by_swept_boxes /\
  Orders.says f plain value_of Boxes.a_vertex_and_a_face.culled_by_three_axes /\
  Orders.says f plain value_of' Boxes.two_edges.culled_by_swept_boxes /\
  Orders.says f plain value_of' Boxes.two_edges.culled_by_three_axes.
Proof.
  exists (Orders.sight f plain (beside 1)), (Orders.sight f plain (beside 2)).
  assert (max : forall x : R, Rmax x x = x) by (intro x; apply Rmax_left; lra).
  assert (min : forall x : R, Rmin x x = x) by (intro x; apply Rmin_left; lra).
  split; [apply sight_is_an_execution|]. split; [apply sight_is_an_execution|].
  repeat split; cbn; repeat left; rewrite ?max, ?min; repeat split; lra.
Qed.
