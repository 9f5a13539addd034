(* A checker of witnesses (docs/witnesses.md) without a separation, in rational numbers: what it accepts does not touch.
   *)
From Coq Require Import QArith Qreals Reals Lra List Bool.
From Selvedge Require Import Expressions Geometry.
From Selvedge Require Machine Corners Volume VolumeSteps Advancing.
Import ListNotations.

(* Rational numbers are not reduced. Numbers with one denominator keep it in sums, so that denominators stay short. *)
Definition sum (x y : Q) : Q :=
  if (Z.pos (Qden x) =? Z.pos (Qden y))%Z then Qmake (Qnum x + Qnum y) (Qden x) else (x + y)%Q.
Definition less (x y : Q) : Q := sum x (- y).
Definition middle (x y : Q) : Q := let s := sum x y in Qmake (Qnum s) (2 * Qden s).
Definition doubled (x : Q) : Q := Qmake (2 * Qnum x) (2 * Qden x).
Lemma Q2R_sum x y : Q2R (sum x y) = (Q2R x + Q2R y)%R.
Proof.
  unfold sum. destruct (Z.eqb_spec (Z.pos (Qden x)) (Z.pos (Qden y))) as [[= E]|_]; [|apply Q2R_plus].
  unfold Q2R; cbn [Qnum Qden]. rewrite plus_IZR, <- E. ring.
Qed.
Lemma Q2R_less x y : Q2R (less x y) = (Q2R x - Q2R y)%R.
Proof. unfold less. rewrite Q2R_sum, Q2R_opp. reflexivity. Qed.
Lemma Q2R_doubled x : Q2R (doubled x) = Q2R x.
Proof.
  unfold Q2R; cbn [Qnum Qden doubled]. rewrite Pos2Z.inj_mul, !mult_IZR. field. apply not_0_IZR. discriminate.
Qed.

(* Coordinates of a pair's four points, and vectors. *)
Definition points := coordinate -> Q.
Definition vector := axis -> Q.
Definition corner (at_ : points) (pair : nat * nat) t : vector :=
  fun a => less (at_ (Coordinate (fst pair) t a)) (at_ (Coordinate (snd pair) t a)).
Definition corner_at at_ pair t : vector := fun a =>
  sum (less 1 t * corner at_ pair Start a)%Q (t * corner at_ pair End a)%Q.
Definition dot_ (u v : vector) : Q := sum (sum (u X * v X)%Q (u Y * v Y)%Q) (u Z_ * v Z_)%Q.
Definition cross_ (u v : vector) : vector := fun a => match a with
  | X => less (u Y * v Z_)%Q (u Z_ * v Y)%Q | Y => less (u Z_ * v X)%Q (u X * v Z_)%Q
  | Z_ => less (u X * v Y)%Q (u Y * v X)%Q end.
Definition det (u v w : vector) : Q := dot_ u (cross_ v w).
Definition positive (x : Q) := (0 <? Qnum x)%Z.

(* Why a pair is apart in a part of the step. *)
Inductive proof := Volume | Held (w : vector) | Turning (v w : vector) | Curving (v m w : vector).
Definition held at_ from until w pair := positive (dot_ w (corner_at at_ pair from)) && positive (dot_ w (corner_at at_
  pair until)).
Definition turning at_ from until v w pair := let e0 := corner_at at_ pair from in let e1 := corner_at at_ pair until in
  positive (dot_ v e0) && positive (sum (dot_ v e1) (dot_ w e0)) && positive (dot_ w e1).
Definition curving at_ from until v m w pair := let e0 := corner_at at_ pair from in let e1 := corner_at at_ pair until
  in
  positive (dot_ v e0) && positive (sum (dot_ v e1) (dot_ m e0)) && positive (sum (dot_ m e1) (dot_ w e0)) &&
  positive (dot_ w e1).
(* The volume's Bernstein coefficients, those in the middle tripled; then those of halves, at most 2^depth of them. *)
Fixpoint volume depth at_ p b c from until := let at_time pair t := corner_at at_ pair t in
  let d t0 t1 t2 := det (at_time p t0) (at_time b t1) (at_time c t2) in
  let k0 := d from from from in let k1 := sum (sum (d until from from) (d from until from)) (d from from until) in
  let k2 := sum (sum (d until until from) (d until from until)) (d from until until) in let k3 := d until until until in
  (positive k0 && positive k1 && positive k2 && positive k3) ||
  (positive (- k0) && positive (- k1) && positive (- k2) && positive (- k3)) ||
  match depth with
  | O => false
  | S fewer => volume fewer at_ p b c (doubled from) (middle from until) &&
    volume fewer at_ p b c (middle from until) (doubled until) end.
(* `depth` says how often parts are halved. *)
Definition proves depth at_ pairs from until why := match why with
  | Volume => match pairs with p :: b :: c :: _ => volume depth at_ p b c from until | _ => false end
  | Held w => forallb (held at_ from until w) pairs
  | Turning v w => forallb (turning at_ from until v w) pairs
  | Curving v m w => forallb (curving at_ from until v m w) pairs end.
(* Parts from a time on reach another. *)
Fixpoint accepts depth at_ pairs from (parts : list (Q * proof)) until := match parts with
  | [] => Qle_bool until from
  | (next, why) :: rest => proves depth at_ pairs from next why && accepts depth at_ pairs next rest until end.

Open Scope R_scope.
Section Sound.
Variable at_ : points.
Variable p b c : nat * nat.
Variable others : list (nat * nat).
Notation pairs := (p :: b :: c :: others).
Definition given i := match i with Machine.Place c => Q2R (at_ c) | _ => 0 end.
Definition place c := Q2R (at_ c).
Lemma of_place : Advancing.of_place place given. Proof. intro; reflexivity. Qed.
Lemma positive_real x : positive x = true -> 0 < Q2R x.
Proof.
  intro h. apply Z.ltb_lt in h. unfold Q2R. apply Rmult_lt_0_compat; [now apply IZR_lt|].
    apply Rinv_0_lt_compat, IZR_lt. reflexivity.
Qed.
Lemma corner_real pair t a : Q2R (corner_at at_ pair t a) = Corners.exactly_at given pair a (Q2R t).
Proof.
  destruct pair as [n k]. unfold corner_at, corner, Corners.exactly_at, Corners.exactly, Corners.exact_difference.
    cbn [fst snd given].
  rewrite Q2R_sum, !Q2R_mult, !Q2R_less. replace (Q2R 1) with 1 by (unfold Q2R; cbn; lra). reflexivity.
Qed.
Definition real (v : vector) a := Q2R (v a).
Definition product v pair t := Corners.sum3 (fun a => v a * Corners.exactly_at given pair a t).
Lemma dot_real v pair t : Q2R (dot_ v (corner_at at_ pair t)) = product (real v) pair (Q2R t).
Proof. unfold dot_, product, Corners.sum3, real. rewrite !Q2R_sum, !Q2R_mult, !corner_real. reflexivity. Qed.

(* A time between two is a part s of the way. *)
Lemma part_of t0 t1 t : t0 <= t <= t1 -> exists s, 0 <= s <= 1 /\ t = (1 - s) * t0 + s * t1.
Proof.
  intro between. destruct (Req_dec t0 t1); [exists 0; lra|]. exists ((t - t0) / (t1 - t0)). split; [|field; lra]. split.
  - apply Rle_mult_inv_pos; lra.
  - apply Rmult_le_reg_r with (t1 - t0); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.
Ltac bools := repeat match goal with
  | h : (_ && _)%bool = true |- _ => apply andb_prop in h as [? ?] | h : positive _ = true |- _ => apply positive_real
    in h end.
Lemma hull_2 a d e s : 0 < a -> 0 < d -> 0 < e -> 0 <= s <= 1 -> 0 < a * (1 - s) ^ 2 + d * ((1 - s) * s) + e * s ^ 2.
Proof.
  intros a0 d0 e0 s01. assert (0 <= a * (1 - s) ^ 2) by (apply Rmult_le_pos; [lra|apply pow_le; lra]).
  assert (0 <= d * ((1 - s) * s)) by (repeat apply Rmult_le_pos; lra). assert (0 <= e * s ^ 2) by (apply Rmult_le_pos;
    [lra|apply pow_le; lra]).
  destruct (Rle_lt_dec s (1 / 2)).
  - assert (0 < a * (1 - s) ^ 2) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]). lra.
  - assert (0 < e * s ^ 2) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]). lra.
Qed.
Notation volume_at := (VolumeSteps.exact_volume given p b c).
Definition real_det t0 t1 t2 := Corners.sum3 (fun a => Corners.exactly_at given p a t0 *
  Volume.cross_at (fun a => Corners.exactly_at given b a t1) (fun a => Corners.exactly_at given c a t2) a).
Lemma det_real t0 t1 t2 : Q2R (det (corner_at at_ p t0) (corner_at at_ b t1) (corner_at at_ c t2)) = real_det (Q2R t0)
  (Q2R t1) (Q2R t2).
Proof.
  unfold real_det, det, dot_, cross_, Corners.sum3, Volume.cross_at. rewrite !Q2R_sum, !Q2R_mult, !Q2R_less,
    !Q2R_mult, !corner_real. reflexivity.
Qed.
Lemma volume_on_the_part x y s : volume_at ((1 - s) * x + s * y) = real_det x x x * (1 - s) ^ 3 +
  (real_det y x x + real_det x y x + real_det x x y) * (1 - s) ^ 2 * s + (real_det y y x + real_det y x y + real_det x y
    y) * (1 - s) * s ^ 2 +
  real_det y y y * s ^ 3.
Proof.
  assert (E : forall pair a, Corners.exactly_at given pair a ((1 - s) * x + s * y) =
    (1 - s) * Corners.exactly_at given pair a x + s * Corners.exactly_at given pair a y) by (intros;
      unfold Corners.exactly_at; ring).
  unfold VolumeSteps.exact_volume, real_det, Corners.sum3, Volume.cross_at. rewrite !E.
  repeat match goal with |- context [Corners.exactly_at given ?q ?a ?t] => generalize (Corners.exactly_at given q a t);
    intro end. ring.
Qed.
Lemma volume_sound depth : forall from until, volume depth at_ p b c from until = true ->
  forall t, Q2R from <= t <= Q2R until -> volume_at t <> 0.
Proof.
  induction depth as [|depth IH]; intros from until h t between; cbn [volume] in h; apply orb_prop in h as [h|h];
    try (apply orb_prop in h as [h|h]); try discriminate.
  1, 3: bools; rewrite ?Q2R_sum, ?det_real in *; destruct (part_of _ _ t between) as (s & s01 & ->);
    rewrite volume_on_the_part;
    match goal with |- ?v <> 0 => assert (0 < v); [|lra] end; apply hull; assumption.
  1, 2: bools; rewrite ?Q2R_opp, ?Q2R_sum, ?det_real in *; destruct (part_of _ _ t between) as (s & s01 & ->);
    rewrite volume_on_the_part;
    match goal with |- ?v <> 0 => assert (0 < - v); [|lra] end;
    match goal with h0 : 0 < - ?a, h1 : 0 < - ?d, h2 : 0 < - ?e, h3 : 0 < - ?g |- _ => pose proof (hull (- a) (- d) (-
      e) (- g) s h0 h1 h2 h3 s01) end; lra.
  apply andb_prop in h as [h h']. destruct (Rle_lt_dec t (Q2R (middle from until))).
  - apply (IH _ _ h). rewrite Q2R_doubled. lra.
  - apply (IH _ _ h'). rewrite Q2R_doubled. lra.
Qed.
Lemma part_at x y s pair a : Corners.exactly_at given pair a ((1 - s) * x + s * y) =
  (1 - s) * Corners.exactly_at given pair a x + s * Corners.exactly_at given pair a y.
Proof. unfold Corners.exactly_at. ring. Qed.
Lemma proof_sound depth from until why : proves depth at_ pairs from until why = true -> forall t,
  Q2R from <= t <= Q2R until -> Advancing.apart pairs place t.
Proof.
  intros h t between. exists given. split; [exact of_place|]. destruct why as [|w|v w|v m w]; cbn [proves] in h.
  - right. exact (volume_sound depth from until h t between).
  - left. destruct (part_of _ _ t between) as (s & s01 & ->). exists (real w). intros pair inside.
    rewrite forallb_forall in h. specialize (h pair inside).
    unfold held in h. bools. rewrite !dot_real in *. change (0 < product (real w) pair ((1 - s) * Q2R from + s * Q2R
      until)).
    replace (product _ _ _) with ((1 - s) * product (real w) pair (Q2R from) + s * product (real w) pair (Q2R until))
      by (unfold product, Corners.sum3, Corners.exactly_at; ring).
    destruct (Req_dec s 0) as [->|n]; [lra|]. assert (0 <= (1 - s) * product (real w) pair (Q2R from)) by (apply
      Rmult_le_pos; lra).
    assert (0 < s * product (real w) pair (Q2R until)) by (apply Rmult_lt_0_compat; lra). lra.
  - left. destruct (part_of _ _ t between) as (s & s01 & ->). exists (fun a => (1 - s) * real v a + s * real w a).
    intros pair inside.
    rewrite forallb_forall in h. specialize (h pair inside). unfold turning in h. bools.
      rewrite ?Q2R_sum, !dot_real in *.
    match goal with A : 0 < product (real v) pair (Q2R from), B : 0 < _ + _, C : 0 < product (real w) pair (Q2R until)
      |- _ => pose proof (hull_2 _ _ _ s A B C s01) as pos end.
    eapply Rlt_le_trans; [exact pos|]. apply Req_le. unfold product, Corners.sum3. rewrite !part_at.
    repeat match goal with |- context [Corners.exactly_at given ?q ?a ?t] => generalize (Corners.exactly_at given q a
      t); intro end. ring.
  - left. destruct (part_of _ _ t between) as (s & s01 & ->). exists (fun a => (1 - s) ^ 2 * real v a + (1 - s) * s *
    real m a + s ^ 2 * real w a). intros pair inside.
    rewrite forallb_forall in h. specialize (h pair inside). unfold curving in h. bools.
      rewrite ?Q2R_sum, !dot_real in *.
    match goal with A : 0 < product (real v) pair (Q2R from), B : 0 < product (real v) _ _ + _,
      C : 0 < product (real m) _ _ + _, D : 0 < product (real w) pair (Q2R until) |- _ =>
      pose proof (hull _ _ _ _ s A B C D s01) as pos end.
    eapply Rlt_le_trans; [exact pos|]. apply Req_le. unfold product, Corners.sum3. rewrite !part_at.
    repeat match goal with |- context [Corners.exactly_at given ?q ?a ?t] => generalize (Corners.exactly_at given q a
      t); intro end. ring.
Qed.
(* Accepted parts keep the pair apart, from the first to the claimed time. *)
Theorem accepted_parts_keep_apart depth parts : forall from until, accepts depth at_ pairs from parts until = true ->
  forall t, Q2R from <= t < Q2R until -> Advancing.apart pairs place t.
Proof.
  induction parts as [|[next why] parts IH]; intros from until h t between; cbn [accepts] in h.
  - apply Qle_bool_iff, Qle_Rle in h. lra.
  - apply andb_prop in h as [h rest]. destruct (Rle_lt_dec t (Q2R next)).
    + apply (proof_sound depth from next why h). lra.
    + apply (IH next until rest). lra.
Qed.
End Sound.
(* What the checker accepts does not touch from time zero to before the claimed time. *)
Theorem an_accepted_vertex_and_face_do_not_touch depth at_ parts until t : accepts depth at_ Corners.vertex_face 0 parts
  until = true -> 0 <= t < Q2R until ->
  ~ Advancing.touch_vertex_and_face (place at_) t.
Proof.
  intros h between. replace 0 with (Q2R 0) in between by (unfold Q2R; cbn; lra).
  destruct (accepted_parts_keep_apart at_ _ _ _ _ depth parts 0%Q until h t between) as (given & same &
    [ahead|volume_]).
  - exact (Advancing.ahead_excludes_contact_of_a_vertex_and_a_face _ _ t same ahead).
  - exact (Advancing.volume_excludes_contact_of_a_vertex_and_a_face _ _ t same volume_).
Qed.
Theorem accepted_edges_do_not_touch depth at_ parts until t : accepts depth at_ Corners.edge_edge 0 parts until = true
  -> 0 <= t < Q2R until ->
  ~ Advancing.touch_edges (place at_) t.
Proof.
  intros h between. replace 0 with (Q2R 0) in between by (unfold Q2R; cbn; lra).
  destruct (accepted_parts_keep_apart at_ _ _ _ _ depth parts 0%Q until h t between) as (given & same &
    [ahead|volume_]).
  - exact (Advancing.ahead_excludes_contact_of_two_edges _ _ t same ahead).
  - exact (Advancing.volume_excludes_contact_of_two_edges _ _ t same volume_).
Qed.
