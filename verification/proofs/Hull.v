(* A cubic in Bernstein form, in exact numbers: where its control polygon's lower hull is positive, it is. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Definition cubic b0 b1 b2 b3 s := b0 * (1 - s) ^ 3 + 3 * b1 * (1 - s) ^ 2 * s + 3 * b2 * (1 - s) * s ^ 2 + b3 * s ^ 3.
(* The line through the control points i/3 and j/3 at s, times j - i. *)
Definition line (i j bi bj s : R) := (j - 3 * s) * bi + (3 * s - i) * bj.
Definition lines_positive b0 b1 b2 b3 s := (3 * s <= 1 -> 0 < line 0 1 b0 b1 s) /\
  (3 * s <= 2 -> 0 < line 0 2 b0 b2 s) /\
  0 < line 0 3 b0 b3 s /\ (1 <= 3 * s <= 2 -> 0 < line 1 2 b1 b2 s) /\ (1 <= 3 * s -> 0 < line 1 3 b1 b3 s) /\
  (2 <= 3 * s -> 0 < line 2 3 b2 b3 s).
Theorem hull_of_lines b0 b1 b2 b3 s : 0 <= s <= 1 -> 0 < b0 -> lines_positive b0 b1 b2 b3 s -> 0 < cubic b0 b1 b2 b3 s.
Proof.
  intros s01 pos (l01 & l02 & l03 & l12 & l13 & l23). unfold cubic, line in *.
  pose (B0 := (1 - s) ^ 3). pose (B1 := 3 * (1 - s) ^ 2 * s). pose (B2 := 3 * (1 - s) * s ^ 2). pose (B3 := s ^ 3).
  assert (p2 : 0 <= (1 - s) ^ 2) by (apply pow_le; lra). assert (q2 : 0 <= s ^ 2) by (apply pow_le; lra).
  assert (P0 : 0 <= B0) by (apply pow_le; lra). assert (P3 : 0 <= B3) by (apply pow_le; lra).
  assert (P1 : 0 <= B1) by (unfold B1; repeat apply Rmult_le_pos; lra). assert (P2 : 0 <= B2) by (unfold B2;
    repeat apply Rmult_le_pos; lra).
  assert (K : b0 * (1 - s) ^ 3 + 3 * b1 * (1 - s) ^ 2 * s + 3 * b2 * (1 - s) * s ^ 2 + b3 * s ^ 3 = B0 * b0 + B1 * b1 +
    B2 * b2 + B3 * b3)
    by (unfold B0, B1, B2, B3; ring).
  rewrite K. destruct (Rle_lt_dec (3 * s) 1) as [one|one]; [|destruct (Rle_lt_dec (3 * s) 2) as [two|two]].
  - destruct (Req_dec s 0) as [->|n]; [unfold B0, B1, B2, B3; lra|]. specialize (l01 one). specialize (l02 ltac:(lra)).
    assert (S1 : 0 < B1) by (unfold B1; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; [|apply pow_lt]|]; lra).
    apply Rmult_lt_reg_l with (3 * s); [lra|]. rewrite Rmult_0_r.
    replace (3 * s * (B0 * b0 + B1 * b1 + B2 * b2 + B3 * b3)) with (B1 * ((1 - 3 * s) * b0 + (3 * s - 0) * b1) +
      B2 * ((2 - 3 * s) * b0 + (3 * s - 0) * b2) + B3 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3)) by (unfold B0, B1, B2,
        B3; ring).
    assert (0 < B1 * ((1 - 3 * s) * b0 + (3 * s - 0) * b1)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= B2 * ((2 - 3 * s) * b0 + (3 * s - 0) * b2)) by (apply Rmult_le_pos; lra).
    assert (0 <= B3 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3)) by (apply Rmult_le_pos; lra). lra.
  - specialize (l02 ltac:(lra)). specialize (l12 ltac:(lra)). specialize (l13 ltac:(lra)).
    assert (S0 : 0 < B0) by (apply pow_lt; lra). assert (S3 : 0 < B3) by (apply pow_lt; lra).
    assert (M0 : 0 < B0 * (3 * s)) by (apply Rmult_lt_0_compat; lra). assert (M1 : 0 <= B1 * (3 * s - 1)) by (apply
      Rmult_le_pos; lra).
    apply Rmult_lt_reg_l with (B0 * (3 * s) + B1 * (3 * s - 1)); [lra|]. rewrite Rmult_0_r.
    replace ((B0 * (3 * s) + B1 * (3 * s - 1)) * (B0 * b0 + B1 * b1 + B2 * b2 + B3 * b3)) with
      (B0 * B2 * ((2 - 3 * s) * b0 + (3 * s - 0) * b2) + B0 * B3 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3) +
       B1 * B2 * ((2 - 3 * s) * b1 + (3 * s - 1) * b2) + B1 * B3 * ((3 - 3 * s) * b1 + (3 * s - 1) * b3)) by (unfold B0,
         B1, B2, B3; ring).
    assert (0 <= B0 * B2) by now apply Rmult_le_pos. assert (0 < B0 * B3) by now apply Rmult_lt_0_compat.
    assert (0 <= B1 * B2) by now apply Rmult_le_pos. assert (0 <= B1 * B3) by now apply Rmult_le_pos.
    assert (0 <= B0 * B2 * ((2 - 3 * s) * b0 + (3 * s - 0) * b2)) by (apply Rmult_le_pos; lra).
    assert (0 < B0 * B3 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= B1 * B2 * ((2 - 3 * s) * b1 + (3 * s - 1) * b2)) by (apply Rmult_le_pos; lra).
    assert (0 <= B1 * B3 * ((3 - 3 * s) * b1 + (3 * s - 1) * b3)) by (apply Rmult_le_pos; lra). lra.
  - specialize (l13 ltac:(lra)). specialize (l23 ltac:(lra)).
    destruct (Req_dec s 1) as [->|n]; [unfold B0, B1, B2, B3; lra|].
    assert (S2 : 0 < B2) by (unfold B2; apply Rmult_lt_0_compat; [|apply pow_lt]; lra).
    apply Rmult_lt_reg_l with (3 - 3 * s); [lra|]. rewrite Rmult_0_r.
    replace ((3 - 3 * s) * (B0 * b0 + B1 * b1 + B2 * b2 + B3 * b3)) with (B0 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3) +
      B1 * ((3 - 3 * s) * b1 + (3 * s - 1) * b3) + B2 * ((3 - 3 * s) * b2 + (3 * s - 2) * b3)) by (unfold B0, B1, B2,
        B3; ring).
    assert (0 <= B0 * ((3 - 3 * s) * b0 + (3 * s - 0) * b3)) by (apply Rmult_le_pos; lra).
    assert (0 <= B1 * ((3 - 3 * s) * b1 + (3 * s - 1) * b3)) by (apply Rmult_le_pos; lra).
    assert (0 < B2 * ((3 - 3 * s) * b2 + (3 * s - 2) * b3)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* The code's lines: from positive points to others. Each is above -e at s; then all control values, raised by more than
   four times e, have positive lines there. *)
Theorem lines_of_the_code m0 m1 m2 m3 s e r : 0 <= s <= 1 -> 0 < m0 -> 0 < e -> 4 * e < r ->
  (m1 <= 0 -> - e <= line 0 1 m0 m1 s) -> (m2 <= 0 -> - e <= line 0 2 m0 m2 s) -> (m3 <= 0 -> - e <= line 0 3 m0 m3 s)
    ->
  (0 < m1 -> m2 <= 0 -> - e <= line 1 2 m1 m2 s) -> (0 < m1 -> m3 <= 0 -> - e <= line 1 3 m1 m3 s) ->
  (0 < m1 -> 0 < m2 -> m3 <= 0 -> - e <= line 2 3 m2 m3 s) ->
  lines_positive (m0 + r) (m1 + r) (m2 + r) (m3 + r) s.
Proof.
  intros s01 pos e0 er l01 l02 l03 l12 l13 l23. unfold lines_positive, line in *.
  (* A line from the first point, whether the other is positive or not. *)
  assert (from_0 : forall j m, 1 <= j -> 3 * s <= j -> (m <= 0 -> - e <= (j - 3 * s) * m0 + (3 * s - 0) * m) ->
    0 < (j - 3 * s) * (m0 + r) + (3 * s - 0) * (m + r)).
  { intros j m j1 sj h. assert (0 <= (j - 3 * s) * m0) by (apply Rmult_le_pos; lra).
    assert (1 * r <= j * r) by (apply Rmult_le_compat_r; lra).
    destruct (Rle_lt_dec m 0) as [neg|p]; [specialize (h neg); lra|]. assert (0 <= (3 * s - 0) * m) by (apply
      Rmult_le_pos; lra). lra. }
  (* Points that the line from the first leads to are not far below zero, left of s. *)
  assert (left : forall i m, 1 <= i <= 3 * s -> (m <= 0 -> - e <= (i - 3 * s) * m0 + (3 * s - 0) * m) -> m <= 0 -> - e
    <= 3 * s * m /\ (3 * s - i) * m0 <= e).
  { intros i m is_ h neg. specialize (h neg). assert (0 <= (3 * s - i) * m0) by (apply Rmult_le_pos; lra).
    assert (3 * s * m <= 0) by (assert (0 <= 3 * s * - m) by (apply Rmult_le_pos; lra); lra). lra. }
  assert (low : forall i m, 1 <= i <= 3 * s -> - e <= 3 * s * m -> m <= 0 -> - e <= m).
  { intros i m is_ h neg. assert (0 <= (3 * s - 1) * - m) by (apply Rmult_le_pos; lra). lra. }
  (* From a point that is not positive. *)
  assert (from_low : forall i j mi mj, 1 <= i <= 3 * s -> 3 * s <= j -> i + 1 <= j <= 3 -> mi <= 0 -> - e <= 3 * s * mi
    -> (3 * s - i) * m0 <= e ->
    (mj <= 0 -> - e <= (j - 3 * s) * m0 + (3 * s - 0) * mj) -> 0 < (j - 3 * s) * (mi + r) + (3 * s - i) * (mj + r)).
  { intros i j mi mj is_ sj ij neg h h' hj. pose proof (low i mi is_ h neg) as lo.
    assert ((j - 3 * s) * (3 * e) <= (j - 3 * s) * (mi + r)) by (apply Rmult_le_compat_l; lra).
    assert ((3 * s - i) * (4 * e) <= (3 * s - i) * r) by (apply Rmult_le_compat_l; lra).
    assert (e <= (j - i) * e). { replace e with (1 * e) at 1 by ring. apply Rmult_le_compat_r; lra. }
    assert (0 <= (j - 3 * s) * e) by (apply Rmult_le_pos; lra). assert (0 <= (3 * s - i) * e) by (apply Rmult_le_pos;
      lra).
    destruct (Rle_lt_dec mj 0) as [neg'|p].
    - specialize (hj neg'). (* 3 s m_j is at least -e - (j - 3s) m_0; times (3s - i)/(3s). *)
      assert (A : (3 * s - i) * (- e - (j - 3 * s) * m0) <= (3 * s - i) * (3 * s * mj)) by (apply Rmult_le_compat_l;
        lra).
      assert (B : (j - 3 * s) * ((3 * s - i) * m0) <= (j - 3 * s) * e) by (apply Rmult_le_compat_l; lra).
      assert (C : - ((3 * s - i) * e) - (j - 3 * s) * e <= 3 * s * ((3 * s - i) * mj)) by lra.
      assert (D : - ((j - i) * e) <= (3 * s - i) * mj).
      { apply Rnot_lt_le. intro lt. assert (3 * s * ((3 * s - i) * mj) < 3 * s * (- ((j - i) * e))) by (apply
        Rmult_lt_compat_l; lra).
        assert (1 * ((j - i) * e) <= 3 * s * ((j - i) * e)) by (apply Rmult_le_compat_r; lra). lra. }
      lra.
    - assert (0 <= (3 * s - i) * mj) by (apply Rmult_le_pos; lra). lra. }
  split; [intro h; apply (from_0 1 m1); lra || auto|]. split; [intro h; apply (from_0 2 m2); lra || auto|].
    split; [apply (from_0 3 m3); lra || auto|].
  assert (up : forall i j mi mj, i <= 3 * s <= j -> i + 1 <= j -> 0 < mi -> (mj <= 0 -> - e <= (j - 3 * s) * mi + (3 * s
    - i) * mj) ->
    0 < (j - 3 * s) * (mi + r) + (3 * s - i) * (mj + r)).
  { intros i j mi mj is_ ij p h. assert (0 <= (j - 3 * s) * mi) by (apply Rmult_le_pos; lra).
    assert (1 * r <= (j - i) * r) by (apply Rmult_le_compat_r; lra).
    destruct (Rle_lt_dec mj 0) as [neg|pj]; [specialize (h neg); lra|]. assert (0 <= (3 * s - i) * mj) by (apply
      Rmult_le_pos; lra). lra. }
  split; [|split].
  - intro h. destruct (Rle_lt_dec m1 0) as [neg|p1].
    + destruct (left 1 m1 ltac:(lra) l01 neg). apply from_low; try lra; auto.
    + apply up; try lra; auto.
  - intro h. destruct (Rle_lt_dec m1 0) as [neg|p1].
    + destruct (left 1 m1 ltac:(lra) l01 neg). apply from_low; try lra; auto.
    + apply up; try lra; auto.
  - intro h. destruct (Rle_lt_dec m2 0) as [neg|p2].
    + destruct (left 2 m2 ltac:(lra) l02 neg). apply from_low; try lra; auto.
    + destruct (Rle_lt_dec m1 0) as [neg|p1]; [|apply up; try lra; auto].
      destruct (left 1 m1 ltac:(lra) l01 neg) as [_ small0]. assert (m0e : m0 <= e).
        { assert (1 * m0 <= (3 * s - 1) * m0) by (apply Rmult_le_compat_r; lra). lra. }
      assert (0 <= (3 - 3 * s) * m2) by (apply Rmult_le_pos; lra).
      destruct (Rle_lt_dec m3 0) as [neg3|p3]; [|assert (0 <= (3 * s - 2) * m3) by (apply Rmult_le_pos; lra); lra].
      specialize (l03 neg3). assert ((3 - 3 * s) * m0 <= (3 - 3 * s) * e) by (apply Rmult_le_compat_l; lra).
      assert (m3e : - e <= m3).
      { assert (- (2 * e) <= 3 * s * m3) by (assert ((3 - 3 * s) * e <= 1 * e) by (apply Rmult_le_compat_r; lra); lra).
        assert (0 <= (3 * s - 2) * - m3) by (apply Rmult_le_pos; lra). lra. }
      assert ((3 * s - 2) * - e <= (3 * s - 2) * m3) by (apply Rmult_le_compat_l; lra).
      assert ((3 * s - 2) * e <= 1 * e) by (apply Rmult_le_compat_r; lra). lra.
Qed.
