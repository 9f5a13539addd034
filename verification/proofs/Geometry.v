(* Contact, coplanarity and the signed volume of four points that move linearly, in exact arithmetic. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Record point := Point { x : R; y : R; z : R }.
Definition minus a b := Point (x a - x b) (y a - y b) (z a - z b).
Definition plus a b := Point (x a + x b) (y a + y b) (z a + z b).
Definition scaled s a := Point (s * x a) (s * y a) (s * z a).
Definition dot a b := x a * x b + y a * y b + z a * z b.
Definition cross a b := Point (y a * z b - z a * y b) (z a * x b - x a * z b) (x a * y b - y a * x b).

(* A point's path: where it is at the start and at the end of the step, and in between. *)
Record path := Path { start : point; finish : point }.
Definition at_ p t := plus (scaled (1 - t) (start p)) (scaled t (finish p)).

(* The vertex lies in the closed triangle; the two closed segments have a point in common. *)
Definition vertex_in_triangle p a b c := exists u v w, 0 <= u /\ 0 <= v /\ 0 <= w /\ u + v + w = 1 /\
  p = plus (scaled u a) (plus (scaled v b) (scaled w c)).
Definition segments_meet u v k l := exists r s, 0 <= r <= 1 /\ 0 <= s <= 1 /\
  plus (scaled (1 - r) u) (scaled r v) = plus (scaled (1 - s) k) (scaled s l).

(* Six times the volume of a tetrahedron; zero if its points are coplanar. *)
Definition volume a b c p := dot (minus p a) (cross (minus b a) (minus c a)).

Theorem vertex_in_triangle_is_flat p a b c : vertex_in_triangle p a b c -> volume a b c p = 0.
Proof.
  intros (u & v & w & _ & _ & _ & one & ->). replace u with (1 - v - w) by lra.
  unfold volume, dot, cross, minus, plus, scaled; simpl; ring.
Qed.
(* Edges (u, v) and (k, l) as the tetrahedron k u v l. *)
Theorem segments_that_meet_are_flat u v k l : segments_meet u v k l -> volume k u v l = 0.
Proof.
  intros (r & s & _ & s01 & same). destruct (Req_dec s 0) as [->|s0].
  - assert (k = plus (scaled (1 - r) u) (scaled r v)) as ->.
    { rewrite same. destruct k, l. unfold plus, scaled; simpl. f_equal; ring. }
    unfold volume, dot, cross, minus, plus, scaled; simpl; ring.
  - apply (Rmult_eq_reg_l s); [|exact s0]. rewrite Rmult_0_r.
    replace (s * volume k u v l) with (dot (minus (plus (scaled (1 - s) k) (scaled s l)) k) (cross (minus u k) (minus v
      k))).
    + rewrite <- same. unfold dot, cross, minus, plus, scaled; simpl; ring.
    + unfold volume, dot, cross, minus, plus, scaled; simpl; ring.
Qed.

(* The control values of the volume of four paths, the middle ones tripled. *)
Section Control.
Variables b0 b1 c0 c1 p0 p1 : point.
Definition k0 := dot p0 (cross b0 c0).
Definition h := plus (cross b0 c1) (cross b1 c0).
Definition k1 := dot p0 h + dot p1 (cross b0 c0).
Definition k2 := dot p1 h + dot p0 (cross b1 c1).
Definition k3 := dot p1 (cross b1 c1).
End Control.
Definition of_control k a b c p := k (minus (start b) (start a)) (minus (finish b) (finish a))
  (minus (start c) (start a)) (minus (finish c) (finish a)) (minus (start p) (start a)) (minus (finish p) (finish a)) :
    R.

Theorem bernstein_form a b c p t : volume (at_ a t) (at_ b t) (at_ c t) (at_ p t) =
  of_control (fun b0 _ c0 _ p0 _ => k0 b0 c0 p0) a b c p * (1 - t) ^ 3 + of_control k1 a b c p * (1 - t) ^ 2 * t
  + of_control k2 a b c p * (1 - t) * t ^ 2 + of_control (fun _ b1 _ c1 _ p1 => k3 b1 c1 p1) a b c p * t ^ 3.
Proof. unfold volume, of_control, k0, k1, k2, k3, h, dot, cross, minus, plus, scaled, at_; simpl; ring. Qed.

Theorem hull a b c d t : 0 < a -> 0 < b -> 0 < c -> 0 < d -> 0 <= t <= 1 ->
  0 < a * (1 - t) ^ 3 + b * (1 - t) ^ 2 * t + c * (1 - t) * t ^ 2 + d * t ^ 3.
Proof.
  intros. assert (0 <= a * (1 - t) ^ 3) by (apply Rmult_le_pos; [lra|apply pow_le; lra]).
  assert (0 <= b * (1 - t) ^ 2 * t) by (repeat apply Rmult_le_pos; try lra; apply pow_le; lra).
  assert (0 <= c * (1 - t) * t ^ 2) by (repeat apply Rmult_le_pos; try lra; apply pow_le; lra).
  assert (0 <= d * t ^ 3) by (apply Rmult_le_pos; [lra|apply pow_le; lra]).
  destruct (Rle_lt_dec t (1 / 2)).
  - assert (0 < a * (1 - t) ^ 3) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]). lra.
  - assert (0 < d * t ^ 3) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]). lra.
Qed.

(* Control values of one sign: never coplanar. *)
Definition one_sign a b c d := (0 < a /\ 0 < b /\ 0 < c /\ 0 < d) \/ (a < 0 /\ b < 0 /\ c < 0 /\ d < 0).
Theorem one_sign_is_never_flat a b c p t : 0 <= t <= 1 ->
  one_sign (of_control (fun b0 _ c0 _ p0 _ => k0 b0 c0 p0) a b c p) (of_control k1 a b c p) (of_control k2 a b c p)
    (of_control (fun _ b1 _ c1 _ p1 => k3 b1 c1 p1) a b c p) ->
  volume (at_ a t) (at_ b t) (at_ c t) (at_ p t) <> 0.
Proof.
  rewrite bernstein_form. intros time [(A & B & C & D)|(A & B & C & D)].
  - pose proof (hull _ _ _ _ t A B C D time). lra.
  - pose proof (hull _ _ _ _ t (Ropp_0_gt_lt_contravar _ A) (Ropp_0_gt_lt_contravar _ B) (Ropp_0_gt_lt_contravar _ C)
      (Ropp_0_gt_lt_contravar _ D) time). lra.
Qed.
