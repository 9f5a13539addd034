(* Tests that only compare coordinates: what they cull does not touch. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Geometry Orders.
From Selvedge Require Boxes.
Open Scope R_scope.

(* A direction along which one set stays ahead at both ends of the step excludes contact in between. *)
Lemma ahead_throughout w p x t : 0 <= t <= 1 -> 0 < dot w (minus (start p) (start x)) -> 0 < dot w (minus (finish p)
  (finish x)) ->
  0 < dot w (minus (at_ p t) (at_ x t)).
Proof.
  intros time a b. replace (dot w (minus (at_ p t) (at_ x t))) with
    ((1 - t) * dot w (minus (start p) (start x)) + t * dot w (minus (finish p) (finish x))).
  - destruct (Rle_lt_dec t (1 / 2)); [assert (0 < (1 - t) * dot w (minus (start p) (start x))) by (apply
    Rmult_lt_0_compat; lra);
      assert (0 <= t * dot w (minus (finish p) (finish x))) by (apply Rmult_le_pos; lra)|
      assert (0 <= (1 - t) * dot w (minus (start p) (start x))) by (apply Rmult_le_pos; lra);
      assert (0 < t * dot w (minus (finish p) (finish x))) by (apply Rmult_lt_0_compat; lra)]; lra.
  - unfold dot, minus, at_, plus, scaled; simpl; ring.
Qed.
Lemma some_positive a b c : 0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 -> 0 < a \/ 0 < b \/ 0 < c.
Proof. intros. destruct (Rle_lt_dec a 0); [|auto]. destruct (Rle_lt_dec b 0); [|auto]. right. right. lra. Qed.
Lemma sum_positive u v w a b c : 0 <= u -> 0 <= v -> 0 <= w -> u + v + w = 1 -> 0 < a -> 0 < b -> 0 < c -> 0 < u * a + v
  * b + w * c.
Proof.
  intros u0 v0 w0 one a0 b0 c0. assert (0 <= u * a) by (apply Rmult_le_pos; lra).
    assert (0 <= v * b) by (apply Rmult_le_pos; lra).
  assert (0 <= w * c) by (apply Rmult_le_pos; lra).
  destruct (some_positive u v w u0 v0 w0 one) as [h|[h|h]]; [assert (0 < u * a) by (now apply Rmult_lt_0_compat)|
    assert (0 < v * b) by (now apply Rmult_lt_0_compat)|assert (0 < w * c) by (now apply Rmult_lt_0_compat)]; lra.
Qed.
Theorem ahead_of_a_triangle w p a b c : 0 < dot w (minus p a) -> 0 < dot w (minus p b) -> 0 < dot w (minus p c) -> ~
  vertex_in_triangle p a b c.
Proof.
  intros A B C (u & v & r & u0 & v0 & r0 & one & E). pose proof (sum_positive u v r _ _ _ u0 v0 r0 one A B C) as S.
  assert (Z : u * dot w (minus p a) + v * dot w (minus p b) + r * dot w (minus p c) = 0); [|lra].
  replace r with (1 - u - v) in * by lra. rewrite E. unfold dot, minus, plus, scaled; simpl; ring.
Qed.
Theorem ahead_of_a_segment w u v k l : 0 < dot w (minus u k) -> 0 < dot w (minus u l) -> 0 < dot w (minus v k) -> 0 <
  dot w (minus v l) ->
  ~ segments_meet u v k l.
Proof.
  intros A B C D (r & s & r01 & s01 & E).
  assert (P : 0 < (1 - s) * dot w (minus u k) + s * dot w (minus u l)) by (pose proof (sum_positive (1 - s) s 0 _ _ _
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) A B A); lra).
  assert (Q : 0 < (1 - s) * dot w (minus v k) + s * dot w (minus v l)) by (pose proof (sum_positive (1 - s) s 0 _ _ _
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) C D C); lra).
  pose proof (sum_positive (1 - r) r 0 _ _ _ ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) P Q P) as S.
  assert (Z : dot w (minus (plus (scaled (1 - r) u) (scaled r v)) (plus (scaled (1 - s) k) (scaled s l))) = 0).
  { rewrite E. unfold dot, minus, plus, scaled; simpl; ring. }
  assert (dot w (minus (plus (scaled (1 - r) u) (scaled r v)) (plus (scaled (1 - s) k) (scaled s l))) =
    (1 - r) * ((1 - s) * dot w (minus u k) + s * dot w (minus u l)) + r * ((1 - s) * dot w (minus v k) + s * dot w
      (minus v l)))
    by (unfold dot, minus, plus, scaled; simpl; ring). lra.
Qed.

Section OfAPair.
Variable place : coordinate -> R.
Definition position n t := Point (place (Coordinate n t X)) (place (Coordinate n t Y)) (place (Coordinate n t Z_)).
Definition path_of n := Path (position n Start) (position n End).
Definition ahead w n k := 0 < dot w (minus (start (path_of n)) (start (path_of k))) /\
  0 < dot w (minus (finish (path_of n)) (finish (path_of k))).
Definition never_touch_vertex_and_face := forall t, 0 <= t <= 1 ->
  ~ vertex_in_triangle (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Definition never_touch_edges := forall t, 0 <= t <= 1 ->
  ~ segments_meet (at_ (path_of 0) t) (at_ (path_of 1) t) (at_ (path_of 2) t) (at_ (path_of 3) t).
Theorem a_fixed_direction_excludes_contact_of_a_vertex_and_a_face w :
  ahead w 0 1 /\ ahead w 0 2 /\ ahead w 0 3 -> never_touch_vertex_and_face.
Proof. intros ([? ?] & [? ?] & [? ?]) t time. apply (ahead_of_a_triangle w); now apply ahead_throughout. Qed.
Theorem a_fixed_direction_excludes_contact_of_two_edges w :
  ahead w 0 2 /\ ahead w 0 3 /\ ahead w 1 2 /\ ahead w 1 3 -> never_touch_edges.
Proof. intros ([? ?] & [? ?] & [? ?] & [? ?]) t time. apply (ahead_of_a_segment w); now apply ahead_throughout. Qed.

Variable f : format.
Variable of : environment.
Variable value_of : number -> R.
Hypothesis run : execution f of place value_of.

Ltac split_orders h := repeat match type of h with _ \/ _ => destruct h as [h|h] | _ /\ _ => destruct h as [h ?O] end.
Ltac spread := repeat match goal with
  | H : Rmax _ _ < _ |- _ => apply Rmax_Rlt in H as [? ?]
  | H : _ < Rmin _ _ |- _ => apply Rmin_Rgt in H as [? ?]
  | H : Rmin _ _ > _ |- _ => apply Rmin_Rgt in H as [? ?]
  | H : _ /\ _ |- _ => destruct H
  | H : _ > _ |- _ => apply Rgt_lt in H
  | H : seen _ _ _ < seen _ _ _ |- _ => apply seen_order in H end.
Ltac along w := (apply (a_fixed_direction_excludes_contact_of_a_vertex_and_a_face w) || apply
  (a_fixed_direction_excludes_contact_of_two_edges w));
  unfold ahead; repeat split; unfold dot, minus; simpl; lra.
Ltac along_an_axis := first [along (Point 1 0 0) | along (Point (-1) 0 0) | along (Point 0 1 0) | along (Point 0 (-1) 0)
  | along (Point 0 0 1) | along (Point 0 0 (-1))].
Ltac ends_of_swept := intros culled; apply (says_what_is_ordered _ _ _ _ run) in culled; cbn in culled;
  destruct culled as [culled _];
  split_orders culled; spread; along_an_axis.

Theorem swept_boxes_of_a_vertex_and_a_face : says f of value_of Boxes.a_vertex_and_a_face.culled_by_swept_boxes ->
  never_touch_vertex_and_face.
Proof. ends_of_swept. Qed.
Theorem swept_boxes_of_two_edges : says f of value_of Boxes.two_edges.culled_by_swept_boxes -> never_touch_edges.
Proof. ends_of_swept. Qed.
Theorem three_axes_of_a_vertex_and_a_face : says f of value_of Boxes.a_vertex_and_a_face.culled_by_three_axes ->
  never_touch_vertex_and_face.
Proof. ends_of_swept. Qed.
Theorem three_axes_of_two_edges : says f of value_of Boxes.two_edges.culled_by_three_axes -> never_touch_edges.
Proof. ends_of_swept. Qed.
End OfAPair.
