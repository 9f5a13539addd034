(* The signed volume of a pair's first three corners, on a part of the step: core/src/kernels/advance/volume.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Directions Held Hull.
From Selvedge Require Expressions Errors Bounds Certificates.
Import ListNotations.
Open Scope R_scope.

(* The code's terms. *)
Definition cross_ u v := Vector (Minus (Product (vy u) (vz v)) (Product (vz u) (vy v))) (Minus (Product (vz u) (vx v))
  (Product (vx u) (vz v)))
  (Minus (Product (vx u) (vy v)) (Product (vy u) (vx v))).
Definition cross_permanent u v := Vector (Sum (Product (vy u) (vz v)) (Product (vz u) (vy v)))
  (Sum (Product (vz u) (vx v)) (Product (vx u) (vz v))) (Sum (Product (vx u) (vy v)) (Product (vy u) (vx v))).
Definition sum_ u v := each (fun a => Sum (component u a) (component v a)).
Definition third := Quotient one (Constant (Small 3)).
(* Its control values, for the corners p, b, c; those in the middle are not tripled. *)
Definition outer p b c t := dot_ (difference p t) (cross_ (difference b t) (difference c t)).
Definition inner p b c t := let other := match t with Expressions.Start => Expressions.End | Expressions.End =>
  Expressions.Start end in
  Product (Sum (dot_ (difference p t) (sum_ (cross_ (at_start b) (at_end c)) (cross_ (at_end b) (at_start c))))
    (dot_ (difference p other) (cross_ (difference b t) (difference c t)))) third.
(* E, the error of all that follows. *)
Definition error_of_volume pairs := let m := extent pairs in let size := Sum one (largest m) in
  Sum (Product (roundoffs 64) (dot_ m (cross_permanent m m))) (Product (Constant Underflow) (Product size size)).
(* Blossoms: between two values, and the control values from a moment to the end. *)
Definition between_ t a b := Sum (Product (Minus one t) a) (Product t b).
Definition values_from t k0 k1 k2 k3 := let a0 := between_ t k0 k1 in let a1 := between_ t k1 k2 in let b2 := between_ t
  k2 k3 in
  let c0 := between_ t a0 a1 in let b1 := between_ t a1 b2 in (between_ t c0 b1, b1, b2, k3).
Definition margin b0 b e := Minus (Select (Greater (Constant (Small 0)) b0) (Negative b) b) e.

Section Volume.
Load "Setting.section".
Load "InRange.section".

Notation constant := (constant f env given value_of run).
Notation dot_holds := (here dot_holds).
Notation difference_holds := (within difference_holds).
Notation M_bounds := (within M_bounds).
Notation p_pos := (within p_pos).
Notation p_small := (within p_small).
Notation m_pos := (within m_pos).
Notation M_low := (within M_low).
Notation X_ := Expressions.X. Notation Y_ := Expressions.Y. Notation Z_ := Expressions.Z_.

(* Sizes: PM, what a monomial's sum is at most, and Q, one more than the largest extent. *)
Definition permanent := 6 * (M X_ * M Y_ * M Z_).
Definition more := 1 + Rmax (Rmax (M X_) (M Y_)) (M Z_).
Notation PM := permanent.
Notation Q := more.
Lemma p_M a : p a <= (1 + 3 * e1) * M a.
Proof.
  pose proof (M_low a). pose proof (m_pos a). pose proof (mu_l f fine). pose proof (l_pos f). pose proof (e_pos f).
    pose proof (e_small f ok).
  assert ((1 + 3 * e1) * ((1 - e1) * (m a + mu) - l) <= (1 + 3 * e1) * M a) by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * m a) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * m a) <= / 8388608 * (e1 * m a)) by (apply
    Rmult_le_compat_r; lra).
  assert (0 <= e1 * mu) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * mu) <= / 8388608 * (e1 * mu)) by (apply
    Rmult_le_compat_r; lra).
  assert (e1 * l <= / 8388608 * l) by (apply Rmult_le_compat_r; lra). unfold Corners.p. lra.
Qed.
Lemma M_Q a : 0 <= M a <= Q - 1.
Proof.
  pose proof (M_bounds a). pose proof (l_pos f). unfold more. split; [lra|].
  pose proof (Rmax_l (Rmax (M X_) (M Y_)) (M Z_)). pose proof (Rmax_r (Rmax (M X_) (M Y_)) (M Z_)).
  pose proof (Rmax_l (M X_) (M Y_)). pose proof (Rmax_r (M X_) (M Y_)). destruct a; lra.
Qed.
Lemma Q_bounds : 1 <= Q <= G.
Proof.
  pose proof (M_bounds X_). pose proof (M_bounds Y_). pose proof (M_bounds Z_). pose proof (l_pos f).
    pose proof (G_4 f fine).
  pose proof (M_Q X_). split; [lra|]. unfold more. repeat apply Rmax_lub_lt || idtac.
  assert (Rmax (Rmax (M X_) (M Y_)) (M Z_) <= / 4 * G) by (repeat apply Rmax_lub; lra). lra.
Qed.
Lemma p_Q a : 0 < p a <= 1.00001 * (Q - 1).
Proof.
  pose proof (p_pos a). pose proof (p_M a). pose proof (M_Q a). pose proof (e_pos f). pose proof (e_small f ok).
    split; [lra|].
  assert (3 * e1 * M a <= 0.00001 * M a) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Notation V3 := (p X_ * p Y_ * p Z_).
Lemma volume_bounds : 0 <= 6 * V3 <= 1.001 * PM /\ 0 <= PM <= 6 * (G * G * G) /\ PM <= 6 * (Q * Q * Q) /\
  6 * V3 <= (1 + 10 * e1) * PM.
Proof.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (Q_bounds).
  pose proof (M_Q X_). pose proof (M_Q Y_). pose proof (M_Q Z_). pose proof (p_M X_). pose proof (p_M Y_).
    pose proof (p_M Z_).
  pose proof (p_pos X_). pose proof (p_pos Y_). pose proof (p_pos Z_).
  set (c := 1 + 3 * e1) in *.
  assert (V3 <= c * M X_ * (c * M Y_) * (c * M Z_)).
  { apply Rmult_le_compat; [apply Rmult_le_pos; lra|lra| |lra]. apply Rmult_le_compat; lra. }
  assert (c3 : c * c * c <= 1 + 10 * e1).
  { unfold c. assert (e1 * e1 <= / 1000 * e1) by (apply Rmult_le_compat_r; lra).
    assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra).
    assert (e1 * (e1 * e1) <= / 1000 * (e1 * e1)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (M3 : 0 <= M X_ * M Y_ * M Z_) by (repeat apply Rmult_le_pos; lra).
  assert (c * c * c * (M X_ * M Y_ * M Z_) <= (1 + 10 * e1) * (M X_ * M Y_ * M Z_)) by (apply Rmult_le_compat_r; lra).
  assert (MG : forall g, Q <= g -> M X_ * M Y_ * M Z_ <= g * g * g) by (intros; repeat apply Rmult_le_compat;
    try apply Rmult_le_pos; lra).
  assert (0 <= V3) by (repeat apply Rmult_le_pos; lra).
  pose proof (MG G ltac:(lra)). pose proof (MG Q ltac:(lra)). unfold permanent.
  assert (10 * e1 * (M X_ * M Y_ * M Z_) <= 0.0001 * (M X_ * M Y_ * M Z_)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* Exact cross products, along an axis, and sizes of theirs. *)
Definition cross_at U V a : R := match a with
  | X_ => U Y_ * V Z_ - U Z_ * V Y_ | Y_ => U Z_ * V X_ - U X_ * V Z_ | Z_ => U X_ * V Y_ - U Y_ * V X_ end.
Definition beside a := match a with X_ => p Y_ * p Z_ | Y_ => p Z_ * p X_ | Z_ => p X_ * p Y_ end.
Lemma G_bounds : 4 <= G /\ 4 * G <= G * G /\ 4 * (G * G) <= G * G * G /\ 1073741824 * (G * G * G) <= omega f.
Proof.
  pose proof (G_4 f fine). pose proof (G_3 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  assert (4 * (G * G) <= G * (G * G)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma p_product a b : 0 < p a * p b <= 0.08 * (G * G).
Proof.
  pose proof (p_pos a). pose proof (p_pos b). pose proof (p_small a). pose proof (p_small b).
    split; [now apply Rmult_lt_0_compat|].
  assert (p a * p b <= 0.27 * G * (0.27 * G)) by (apply Rmult_le_compat; lra). pose proof G_bounds. lra.
Qed.
Lemma difference_of_products x y z w a b X1 Y1 Z1 W1 : operand (value_of x) X1 (p a) 1 4 -> operand (value_of y) Y1 (p
  b) 1 4 ->
  operand (value_of z) Z1 (p b) 1 4 -> operand (value_of w) W1 (p a) 1 4 ->
  holds (value_of (Minus (Product x y) (Product z w))) (X1 * Y1 - Z1 * W1) (2 * (p a * p b)) 4 (16.5 * Q).
Proof.
  intros hx hy hz hw. pose proof (p_Q a). pose proof (p_Q b). pose proof (p_product a b). pose proof G_bounds.
    pose proof Q_bounds.
  pose proof (l_small f ok). pose proof (l_pos f).
  pose proof (run (Product x y)) as h. cbn in h. pose proof (run (Product z w)) as h'. cbn in h'.
  pose proof (product_holds h hx hy ltac:(lia) ltac:(lra) ltac:(lra)) as r. pose proof (product_holds h' hz hw
    ltac:(lia) ltac:(lra) ltac:(lra)) as r'.
  pose proof (run (Minus (Product x y) (Product z w))) as h''. cbn in h''.
  pose proof (sum_holds Rminus 3 ltac:(auto) h'' (seen_holds r) (seen_holds r') ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
Section Corners.
Variables pp pb pc : nat * nat.
Hypothesis inside : In pp pairs /\ In pb pairs /\ In pc pairs.
Lemma corner_operand pair t a : In pair pairs -> operand (value_of (component (difference pair t) a)) (exactly pair t a)
  (p a) 1 4.
Proof. intro h. apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds (difference_holds pair t a h))); lra || lia.
  Qed.
Lemma cross_holds b c t t' a : In b pairs -> In c pairs ->
  holds (value_of (component (cross_ (difference b t) (difference c t')) a)) (cross_at (exactly b t) (exactly c t') a)
    (2 * beside a) 4 (16.5 * Q).
Proof.
  intros hb hc. pose proof (fun a => corner_operand b t a hb) as ob. pose proof (fun a => corner_operand c t' a hc) as
    oc.
  destruct a; cbn [component cross_ cross_at beside vx vy vz]; apply difference_of_products;
    first [exact (ob X_) | exact (ob Y_) | exact (ob Z_) | exact (oc X_) | exact (oc Y_) | exact (oc Z_)].
Qed.
Lemma beside_bounds a : 0 < beside a <= 0.08 * (G * G) /\ beside a <= 1.001 * ((Q - 1) * Q).
Proof.
  pose proof Q_bounds as [Q1 _]. assert (sq : forall a b, p a * p b <= 1.001 * ((Q - 1) * Q)).
  { intros a0 b0. pose proof (p_Q a0). pose proof (p_Q b0).
    assert (p a0 * p b0 <= 1.00001 * (Q - 1) * (1.00001 * (Q - 1))) by (apply Rmult_le_compat; lra).
    assert ((Q - 1) * (Q - 1) <= (Q - 1) * Q) by (apply Rmult_le_compat_l; lra).
    assert (0 <= (Q - 1) * Q) by (apply Rmult_le_pos; lra). lra. }
  split; destruct a; cbn [beside]; apply p_product || apply sq.
Qed.
Lemma beside_p a : p a * beside a = V3. Proof. destruct a; cbn [beside]; ring. Qed.
Lemma QQ : Q <= Q * Q <= G * G /\ 1 <= Q * Q /\ (Q - 1) * Q <= Q * Q.
Proof.
  pose proof Q_bounds. assert (1 * Q <= Q * Q) by (apply Rmult_le_compat_r; lra).
    assert (Q * Q <= G * G) by (apply Rmult_le_compat; lra).
  assert ((Q - 1) * Q <= Q * Q) by (apply Rmult_le_compat_r; lra). lra.
Qed.
(* A corner times a sum of n cross products. *)
Lemma triple_holds pair t v V n k a_ c : In pair pairs -> 1 <= c <= 2 -> (k <= 6)%nat -> 16.5 <= a_ <= 40 ->
  (forall a, holds (value_of (component v a)) (V a) (2 * c * beside a) k (a_ * Q)) -> n = (4 + k)%nat ->
  holds (value_of (dot_ (difference pair t) v)) (sum3 (fun a => exactly pair t a * V a)) (c * (6 * V3)) n ((3.13 * a_ +
    42 * c) * (Q * Q)).
Proof.
  intros hp c12 k6 a40 hv ->. pose proof G_bounds. pose proof Q_bounds. pose proof QQ. pose proof (l_pos f).
    pose proof (l_small f ok).
  pose proof (volume_bounds) as (V3b & PMb & _).
  assert (bounds : forall a, 0 <= p a * (a_ * Q + 1) <= 1.00001 * (a_ * (Q * Q)) - p a * 0 /\
    0 <= 4 * (2 * c * beside a) <= 8.01 * (c * (Q * Q)) /\
    0 <= l * (4 * (a_ * Q + 1)) <= 0.001 * (Q * Q)).
  { intro a. pose proof (p_Q a). pose proof (beside_bounds a) as [b1 b2].
    assert (0 <= a_ * Q) by (apply Rmult_le_pos; lra). assert (a_ * Q <= 40 * Q) by (apply Rmult_le_compat_r; lra).
    split; [|split].
    - split; [apply Rmult_le_pos; lra|]. assert (p a * (a_ * Q + 1) <= 1.00001 * (Q - 1) * (a_ * Q + 1)) by (apply
      Rmult_le_compat_r; lra).
      assert (Q * 1 <= Q * a_) by (apply Rmult_le_compat_l; lra). replace (a_ * (Q * Q)) with (a_ * Q * Q) by ring. lra.
    - split; [repeat apply Rmult_le_pos; lra|]. assert (b3 : beside a <= 1.001 * (Q * Q)) by lra.
      apply (Rmult_le_compat_l c) in b3; [|lra]. assert (1 * (Q * Q) <= c * (Q * Q)) by (apply Rmult_le_compat_r; lra).
        lra.
    - split; [apply Rmult_le_pos; lra|]. assert (l * (4 * (a_ * Q + 1)) <= / 1152921504606846976 * (4 * (40 * Q + 1)))
      by (apply Rmult_le_compat; lra). lra. }
  pose proof (fun a => corner_operand pair t a hp) as oc. pose proof (fun a => seen_holds (hv a)) as ov.
  assert (P : sum3 (fun a => p a * (2 * c * beside a)) = c * (6 * V3)).
  { unfold sum3. pose proof (beside_p X_) as bx. pose proof (beside_p Y_) as by_. pose proof (beside_p Z_) as bz.
    replace (p X_ * (2 * c * beside X_)) with (2 * c * (p X_ * beside X_)) by ring.
      replace (p Y_ * (2 * c * beside Y_)) with (2 * c * (p Y_ * beside Y_)) by ring.
    replace (p Z_ * (2 * c * beside Z_)) with (2 * c * (p Z_ * beside Z_)) by ring. rewrite bx, by_, bz. ring. }
  set (x := sum3 (fun a => p a * (a_ * Q + 1) + 4 * (2 * c * beside a) + l * (4 * (a_ * Q + 1)))).
  assert (X : x <= (3.001 * a_ + 24.1 * c) * (Q * Q)).
  { unfold x, sum3. pose proof (bounds X_). pose proof (bounds Y_). pose proof (bounds Z_).
    assert (1 * (Q * Q) <= c * (Q * Q)) by (apply Rmult_le_compat_r; lra).
    assert (16.5 * (Q * Q) <= a_ * (Q * Q)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (a_ * (Q * Q) <= 40 * (Q * Q)) by (apply Rmult_le_compat_r; lra). assert (c * (Q * Q) <= 2 * (Q * Q)) by (apply
    Rmult_le_compat_r; lra).
  assert (c * (6 * V3) <= 2 * (6 * V3)) by (apply Rmult_le_compat_r; lra).
  assert (small : sum3 (fun a => p a * (2 * c * beside a)) <= omega f / 4) by (rewrite P; lra).
  assert (none : x <= omega f / 4) by lra.
  pose proof (dot_holds _ _ _ _ _ _ _ _ 1 k oc ov ltac:(lia) small none) as d. fold x in d.
  apply (holds_weaker f _ _ _ _ _ _ _ _ d); [rewrite P; lra|lia|].
  assert (1 * (Q * Q) <= c * (Q * Q)) by (apply Rmult_le_compat_r; lra). assert (0 <= a_ * (Q * Q)) by (apply
    Rmult_le_pos; lra). fold x. lra.
Qed.

Notation S3 := (6 * V3).
(* The bound of all values: as many roundings of S3 as n says, and λ times a S3 + b Q². *)
Definition value_holds e X n a b := holds (value_of e) X S3 n (a * S3 + b * (Q * Q)).
Lemma third_operand : operand (value_of third) (/ 3) (/ 3) 1 2.
Proof.
  pose proof (run third) as h. cbn in h. unfold one in h. rewrite (constant (Small 1)), (constant (Small 3)) in h.
    cbn in h.
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
    pose proof (omega_large f ok).
  rewrite (seen_of_normal f env 1), (seen_of_normal f env 3) in h by (rewrite Rabs_pos_eq; lra). destruct h as [h _].
    specialize (h ltac:(lra)).
  replace (1 / 3) with (/ 3) in h by field. pose proof (error f ok env (/ 3)) as E.
    rewrite (Rabs_pos_eq (/ 3)) in E by lra.
  assert (N : near f (Rd (/ 3)) (/ 3) (/ 3) 1 1).
  { split; [|rewrite Rabs_pos_eq; lra]. unfold Bounds.q. replace ((1 + e1) ^ 1 - 1) with e1 by ring. lra. }
  pose proof (result_holds f ok env _ _ _ _ _ _ h N ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds r)); lra || lia.
Qed.
(* The exact control values. *)
Definition outer_at t := sum3 (fun a => exactly pp t a * cross_at (exactly pb t) (exactly pc t) a).
Definition inner_at t := let other := match t with Expressions.Start => Expressions.End | Expressions.End =>
  Expressions.Start end in
  (sum3 (fun a => exactly pp t a * (cross_at (exactly pb Expressions.Start) (exactly pc Expressions.End) a + cross_at
    (exactly pb Expressions.End) (exactly pc Expressions.Start) a))
  + sum3 (fun a => exactly pp other a * cross_at (exactly pb t) (exactly pc t) a)) * / 3.
Lemma outer_holds_ pair t : In pair pairs -> holds (value_of (dot_ (difference pair t) (cross_ (difference pb t)
  (difference pc t))))
  (sum3 (fun a => exactly pair t a * cross_at (exactly pb t) (exactly pc t) a)) S3 8 (94 * (Q * Q)).
Proof.
  intro hp. destruct inside as (_ & hb & hc).
  assert (hv : forall a, holds (value_of (component (cross_ (difference pb t) (difference pc t)) a)) (cross_at (exactly
    pb t) (exactly pc t) a) (2 * 1 * beside a) 4 (16.5 * Q)).
  { intro a. replace (2 * 1) with 2 by ring. now apply cross_holds. }
  pose proof (triple_holds pair t _ _ 8 4 16.5 1 hp ltac:(lra) ltac:(lia) ltac:(lra) hv ltac:(lia)) as d. pose proof QQ.
  apply (holds_weaker f _ _ _ _ _ _ _ _ d); lra || lia.
Qed.
Lemma h_holds a : holds (value_of (component (sum_ (cross_ (at_start pb) (at_end pc)) (cross_ (at_end pb) (at_start
  pc))) a))
  (cross_at (exactly pb Expressions.Start) (exactly pc Expressions.End) a + cross_at (exactly pb Expressions.End)
    (exactly pc Expressions.Start) a)
  (2 * 2 * beside a) 5 (36.5 * Q).
Proof.
  destruct inside as (_ & hb & hc). unfold sum_. rewrite component_each. unfold at_start, at_end.
  set (u := component (cross_ (difference pb Expressions.Start) (difference pc Expressions.End)) a).
  set (w := component (cross_ (difference pb Expressions.End) (difference pc Expressions.Start)) a).
  pose proof (seen_holds (cross_holds pb pc Expressions.Start Expressions.End a hb hc)) as hu. fold u in hu.
  pose proof (seen_holds (cross_holds pb pc Expressions.End Expressions.Start a hb hc)) as hw. fold w in hw.
  pose proof (run (Sum u w)) as h. cbn in h. pose proof (beside_bounds a). pose proof Q_bounds. pose proof G_bounds.
  pose proof (sum_holds Rplus 4 ltac:(auto) h hu hw ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); lra || lia.
Qed.
Lemma inner_holds t : value_holds (inner pp pb pc t) (inner_at t) 12 6.1 105.
Proof.
  destruct inside as (hp & hb & hc). pose proof G_bounds. pose proof Q_bounds. pose proof QQ. pose proof volume_bounds.
    pose proof (l_pos f). pose proof (l_small f ok).
  set (other := match t with Expressions.Start => Expressions.End | Expressions.End => Expressions.Start end).
  set (x := dot_ (difference pp t) (sum_ (cross_ (at_start pb) (at_end pc)) (cross_ (at_end pb) (at_start pc)))).
  set (y := dot_ (difference pp other) (cross_ (difference pb t) (difference pc t))).
  pose proof (triple_holds pp t _ _ 9 5 36.5 2 hp ltac:(lra) ltac:(lia) ltac:(lra) h_holds ltac:(lia)) as hx.
    fold x in hx.
  pose proof (outer_holds_ pp t hp) as hy0. clear hy0.
  assert (hy : holds (value_of y) (sum3 (fun a => exactly pp other a * cross_at (exactly pb t) (exactly pc t) a)) S3 8
    (94 * (Q * Q))).
  { pose proof (triple_holds pp other _ _ 8 4 16.5 1 hp ltac:(lra) ltac:(lia) ltac:(lra)
      (fun a => holds_weaker f _ _ _ _ _ (2 * 1 * beside a) 4 (16.5 * Q) (cross_holds pb pc t t a hb hc) ltac:(pose
        proof (beside_bounds a); lra) ltac:(lia) ltac:(lra)) ltac:(lia)) as d.
    apply (holds_weaker f _ _ _ _ _ _ _ _ d); lra || lia. }
  pose proof (run (Sum x y)) as h. cbn -[x y] in h.
  pose proof (sum_holds Rplus 9 ltac:(auto) h (seen_holds hx) (seen_holds hy) ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  pose proof (run (Product (Sum x y) third)) as h'. cbn -[x y third] in h'.
  assert (0 <= l * (Q * Q) <= 0.001 * (Q * Q)) by (split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra).
  pose proof (product_holds h' (seen_holds s) third_operand ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  apply (holds_weaker f _ _ _ _ _ _ _ _ r); [lra|lia|lra].
Qed.
Lemma outer_holds t : value_holds (outer pp pb pc t) (outer_at t) 12 6.1 105.
Proof.
  destruct inside as (hp & _). pose proof (outer_holds_ pp t hp) as d. pose proof QQ. pose proof volume_bounds.
  apply (holds_weaker f _ _ _ _ _ _ _ _ d); lra || lia.
Qed.

(* Blossoms at a moment T. *)
Section AtAMoment.
Variable t : number.
Variable T : R.
Hypothesis moment : seen_value f env (value_of t) = Number T.
Hypothesis in_step : 0 <= T <= 1.
Definition between_at a b := (1 - T) * a + T * b.
Lemma moment_operand_ : operand (value_of t) T T 0 0.
Proof. exists T. split; [exact moment|]. pose proof (near_exact f T) as N. now rewrite (Rabs_pos_eq T) in N by lra. Qed.
Lemma rest_operand : operand (value_of (Minus one t)) (1 - T) (1 - T) 1 2.
Proof.
  pose proof (run (Minus one t)) as h. cbn in h. unfold sum in h. rewrite moment in h. unfold one in h.
  rewrite (constant (Small 1)) in h. cbn in h. rewrite (seen_1 f fine env) in h. pose proof (omega_large f ok).
    pose proof (error f ok env (1 - T)) as E.
  rewrite (Rabs_pos_eq (1 - T)) in E by lra.
  assert (N : near f (Rd (1 - T)) (1 - T) (1 - T) 1 1).
  { split; [|rewrite Rabs_pos_eq; lra]. unfold Bounds.q. replace ((1 + e1) ^ 1 - 1) with e1 by ring. lra. }
  pose proof (result_holds f ok env _ _ _ _ _ _ h N ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds r)); lra || lia.
Qed.
Lemma between_holds x y X Y n a b : value_holds x X n a b -> value_holds y Y n a b -> (n <= 30)%nat -> 0 <= a <= 100 ->
  0 <= b <= 1000 ->
  value_holds (between_ t x y) (between_at X Y) (3 + n) (1.03 * a + 2.1) (1.03 * b + 6.3).
Proof.
  intros hx hy n30 a100 b1000. pose proof G_bounds. pose proof Q_bounds. pose proof QQ. pose proof volume_bounds.
    pose proof (l_pos f). pose proof (l_small f ok).
  assert (0 <= a * S3 <= 100 * S3) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (0 <= b * (Q * Q) <= 1000 * (Q * Q)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  set (A := a * S3 + b * (Q * Q)) in *.
  assert (part : forall s z, 0 <= s <= 1 -> 0 <= z -> 0 <= s * z <= z). { intros s z s01 z0.
    split; [now apply Rmult_le_pos|]. rewrite <- (Rmult_1_l z) at 2. now apply Rmult_le_compat_r. }
  pose proof (part (1 - T) S3 ltac:(lra) ltac:(lra)). pose proof (part T S3 ltac:(lra) ltac:(lra)).
  pose proof (part (1 - T) (A + 1) ltac:(lra) ltac:(unfold A; lra)). pose proof (part T (A + 1) ltac:(lra) ltac:(unfold
    A; lra)).
  assert (A <= 100 * S3 + 1000 * (Q * Q)) by (unfold A; lra).
  assert (l * (2 * (A + 1)) <= 0.001 * (A + 1)) by (assert (l * (2 * (A + 1)) <= / 1152921504606846976 * (2 * (A + 1)))
    by (apply Rmult_le_compat_r; unfold A; lra); unfold A in *; lra).
  pose proof (run (Product (Minus one t) x)) as h. cbn -[one] in h.
  pose proof (product_holds h rest_operand (seen_holds hx) ltac:(lia) ltac:(lra) ltac:(fold A; lra)) as r.
  pose proof (run (Product t y)) as h'. cbn in h'.
  pose proof (product_holds h' moment_operand_ (seen_holds hy) ltac:(lia) ltac:(lra) ltac:(fold A; lra)) as r'.
  pose proof (run (between_ t x y)) as h''. unfold between_ in h''. cbn -[one] in h''.
  fold A in r, r'.
  pose proof (sum_holds Rplus (2 + n) ltac:(auto) h'' (seen_holds r) (seen_holds r') ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|]. unfold A in *. lra.
Qed.
Notation B_ := between_at.
(* The control values from T to the end, exact and computed. *)
Variables k0 k1 k2 k3 : number.
Variables K0 K1 K2 K3 : R.
Hypothesis controls : value_holds k0 K0 12 6.1 105 /\ value_holds k1 K1 12 6.1 105 /\ value_holds k2 K2 12 6.1 105 /\
  value_holds k3 K3 12 6.1 105.
Definition exact_from := let a0 := B_ K0 K1 in let a1 := B_ K1 K2 in let b2 := B_ K2 K3 in let c0 := B_ a0 a1 in let b1
  := B_ a1 b2 in
  (B_ c0 b1, b1, b2, K3).
Lemma value_weaker e X n a b : value_holds e X n a b -> (n <= 21)%nat -> a <= 13.2 -> b <= 135 -> value_holds e X 21
  13.2 135.
Proof.
  intros h n21 aa bb. pose proof QQ. pose proof volume_bounds. apply (holds_weaker f _ _ _ _ _ _ _ _ h); [lra|lia|].
  assert (a * S3 <= 13.2 * S3) by (apply Rmult_le_compat_r; lra). assert (b * (Q * Q) <= 135 * (Q * Q)) by (apply
    Rmult_le_compat_r; lra). lra.
Qed.
Lemma values_hold : let '(b0, b1, b2, b3) := values_from t k0 k1 k2 k3 in let '(X0, X1, X2, X3) := exact_from in
  value_holds b0 X0 21 13.2 135 /\ value_holds b1 X1 21 13.2 135 /\ value_holds b2 X2 21 13.2 135 /\
    value_holds b3 X3 21 13.2 135.
Proof.
  destruct controls as (h0 & h1 & h2 & h3). cbn -[between_ between_at].
  pose proof (between_holds _ _ _ _ _ _ _ h0 h1 ltac:(lia) ltac:(lra) ltac:(lra)) as a0.
  pose proof (between_holds _ _ _ _ _ _ _ h1 h2 ltac:(lia) ltac:(lra) ltac:(lra)) as a1.
  pose proof (between_holds _ _ _ _ _ _ _ h2 h3 ltac:(lia) ltac:(lra) ltac:(lra)) as b2.
  pose proof (between_holds _ _ _ _ _ _ _ a0 a1 ltac:(lia) ltac:(lra) ltac:(lra)) as c0.
  pose proof (between_holds _ _ _ _ _ _ _ a1 b2 ltac:(lia) ltac:(lra) ltac:(lra)) as b1.
  pose proof (between_holds _ _ _ _ _ _ _ c0 b1 ltac:(lia) ltac:(lra) ltac:(lra)) as b0.
  repeat split; eapply value_weaker; try eassumption; lia || lra.
Qed.
End AtAMoment.
End Corners.

Notation S3 := (6 * V3).
(* The error E. *)
Lemma larger_numbers v w x y out : v = Number x -> w = Number y -> seen x = x -> seen y = y -> larger f env v w out ->
  out = Number (Rmax x y).
Proof.
  intros -> -> sx sy [[g [-> | ->]]|[g [-> | ->]]]; cbn in *; rewrite ?sx, ?sy in *.
  1, 2: now rewrite Rmax_left by lra. 1, 2: now rewrite Rmax_right by lra.
Qed.
Lemma largest_value : value_of (largest (extent pairs)) = Number (Q - 1) /\ seen (Q - 1) = Q - 1.
Proof.
  pose proof (M_bounds X_). pose proof (M_bounds Y_). pose proof (M_bounds Z_).
  assert (s : forall a, seen (M a) = M a). { intro a. pose proof (M_bounds a). apply seen_of_normal.
    rewrite Rabs_pos_eq; pose proof (l_pos f); lra. }
  assert (sm : seen (Rmax (M X_) (M Y_)) = Rmax (M X_) (M Y_)) by (destruct (Rle_lt_dec (M X_) (M Y_));
    [rewrite Rmax_right|rewrite Rmax_left]; auto; lra).
  assert (E : Q - 1 = Rmax (Rmax (M X_) (M Y_)) (M Z_)) by (unfold more; ring). rewrite E. split.
  - pose proof (run (Larger (vx (extent pairs)) (vy (extent pairs)))) as h. cbn -[extent] in h.
    pose proof (within extent_value) as ev.
    apply (larger_numbers _ _ _ _ _ (ev X_) (ev Y_) (s X_) (s Y_)) in h.
    pose proof (run (largest (extent pairs))) as h'. unfold largest in h'. cbn -[extent] in h'.
    exact (larger_numbers _ _ _ _ _ h (ev Z_) sm (s Z_) h').
  - destruct (Rle_lt_dec (Rmax (M X_) (M Y_)) (M Z_)); [rewrite Rmax_right|rewrite Rmax_left]; auto; lra.
Qed.
Lemma extent_operand a : operand (value_of (component (extent pairs) a)) (M a) (M a) 0 0.
Proof.
  rewrite (within extent_value a). pose proof (M_bounds a). pose proof (l_pos f).
  rewrite <- (Rabs_pos_eq (M a)) at 3 by lra. apply operand_normal. rewrite Rabs_pos_eq; lra.
Qed.
Lemma permanent_pair x y z w a b : operand (value_of x) (M a) (M a) 0 0 -> operand (value_of y) (M b) (M b) 0 0 ->
  operand (value_of z) (M b) (M b) 0 0 -> operand (value_of w) (M a) (M a) 0 0 ->
  holds (value_of (Sum (Product x y) (Product z w))) (M a * M b + M b * M a) (2 * (M a * M b)) 2 5.1.
Proof.
  intros hx hy hz hw. pose proof (M_bounds a). pose proof (M_bounds b). pose proof G_bounds. pose proof (l_pos f).
  assert (0 <= M a * M b <= G * G). { split; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; lra. }
  pose proof (run (Product x y)) as h. cbn in h. pose proof (run (Product z w)) as h'. cbn in h'.
  pose proof (product_holds h hx hy ltac:(lia) ltac:(lra) ltac:(lra)) as r. pose proof (product_holds h' hz hw
    ltac:(lia) ltac:(lra) ltac:(lra)) as r'.
  pose proof (run (Sum (Product x y) (Product z w))) as h''. cbn in h''.
  pose proof (sum_holds Rplus 1 ltac:(auto) h'' (seen_holds r) (seen_holds r') ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as s.
  apply (holds_weaker f _ _ _ _ _ _ _ _ s); [lra|lia|lra].
Qed.
Definition beside_M a := match a with X_ => M Y_ * M Z_ | Y_ => M Z_ * M X_ | Z_ => M X_ * M Y_ end.
Theorem error_value : exists E, value_of (error_of_volume pairs) = Number E /\ representable f E /\ l <= E /\
  31.9 * e1 * PM + 0.98 * (eta * (Q * Q)) <= E <= 32.1 * e1 * PM + 1.02 * (eta * (Q * Q)).
Proof.
  pose proof G_bounds. pose proof Q_bounds. pose proof QQ. pose proof volume_bounds. pose proof (l_pos f).
    pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (eta_large f fine). pose proof (eta_1 f fine). pose proof (eps_twice f) as eu. pose proof (l_e f fine).
  assert (hc : forall a, holds (value_of (component (cross_permanent (extent pairs) (extent pairs)) a)) (2 * beside_M a)
    (2 * beside_M a) 2 5.1).
  { intro a. pose proof extent_operand as oe.
    destruct a; cbn [component cross_permanent beside_M vx vy vz];
      [replace (2 * (M Y_ * M Z_)) with (M Y_ * M Z_ + M Z_ * M Y_) at 1 by ring|replace (2 * (M Z_ * M X_)) with (M Z_
        * M X_ + M X_ * M Z_) at 1 by ring|
       replace (2 * (M X_ * M Y_)) with (M X_ * M Y_ + M Y_ * M X_) at 1 by ring];
      apply permanent_pair; first [exact (oe X_) | exact (oe Y_) | exact (oe Z_)]. }
  set (size := Sum one (largest (extent pairs))). destruct largest_value as [El sl].
  pose proof (M_Q X_). pose proof (M_Q Y_). pose proof (M_Q Z_).
  assert (small : sum3 (fun a => M a * (2 * beside_M a)) <= omega f / 4) by (unfold sum3, beside_M;
    unfold permanent in *; lra).
  assert (none : sum3 (fun a => M a * (5.1 + 1) + 0 * (2 * beside_M a) + l * (0 * (5.1 + 1))) <= omega f / 4) by (unfold
    sum3; lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 2 extent_operand (fun a => seen_holds (hc a)) ltac:(lia) small none) as d'.
  assert (d : holds (value_of (dot_ (extent pairs) (cross_permanent (extent pairs) (extent pairs)))) PM PM 5 (28.3 *
    Q)).
  { replace PM with (sum3 (fun a => M a * (2 * beside_M a))) at 1 by (unfold sum3, beside_M, permanent; ring).
    apply (holds_weaker f _ _ _ _ _ _ _ _ d'); [unfold sum3, beside_M, permanent; lra|lia|unfold sum3; lra]. }
  clear d'. set (triple := dot_ (extent pairs) (cross_permanent (extent pairs) (extent pairs))) in *.
  assert (uP : 0 <= 64 * u * PM <= 0.0001 * PM). { assert (0 <= u * PM <= / 16777216 * PM) by (split;
    [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]). lra. }
  assert (uQ : 0 <= u * Q <= / 16777216 * Q) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lQ : 0 <= l * Q <= 0.0001 * Q) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (run (Product (roundoffs 64) triple)) as h. cbn -[roundoffs triple] in h.
  pose proof (product_holds h (seen_holds (here roundoffs_holds 64%Z ltac:(lia))) (seen_holds
    d) ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  assert (o1 : operand (value_of one) 1 1 0 0) by exact (here count_operand 1%Z ltac:(lia)).
  assert (ol : operand (value_of (largest (extent pairs))) (Q - 1) (Q - 1) 0 0).
  { rewrite El. pose proof (operand_exact f env (Q - 1)) as o. now rewrite sl, (Rabs_pos_eq (Q - 1)) in o by lra. }
  pose proof (run size) as hs. unfold size in hs. cbn -[one largest extent] in hs.
  pose proof (sum_holds Rplus 0 ltac:(auto) hs o1 ol ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s.
    fold size in s.
  replace (1 + (Q - 1)) with Q in s by ring.
  pose proof (run (Product size size)) as hss. cbn -[size] in hss.
  pose proof (product_holds hss (seen_holds s) (seen_holds s) ltac:(lia) ltac:(lra) ltac:(lra)) as ss.
  assert (on : operand (value_of (Constant Underflow)) eta eta 0 0).
  { rewrite constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq eta) at 3 by lra. apply operand_normal.
    rewrite Rabs_pos_eq; lra. }
  assert (nQ : 0 <= eta * (Q * Q) <= Q * Q) by (split; [apply Rmult_le_pos; lra|rewrite <- (Rmult_1_l (Q * Q)) at 2;
    apply Rmult_le_compat_r; lra]).
  assert (nQ1 : 0 <= eta * Q <= Q) by (split; [apply Rmult_le_pos; lra|rewrite <- (Rmult_1_l Q) at 2;
    apply Rmult_le_compat_r; lra]).
  pose proof (run (Product (Constant Underflow) (Product size size))) as hn. cbn -[size] in hn.
  assert (ss' : operand (value_of (Product size size)) (Q * Q) (Q * Q) 3 (8 * (Q * Q))).
  { apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds ss)); lra || lia. }
  pose proof (product_holds hn on ss' ltac:(lia) ltac:(lra) ltac:(lra)) as rn.
  pose proof (run (error_of_volume pairs)) as he. unfold error_of_volume in he.
    cbn -[roundoffs largest extent one cross_permanent dot_] in he. fold triple size in he.
  pose proof (sum_holds Rplus 7 ltac:(auto) he (seen_holds r) (seen_holds rn) ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as (E & EE & rep & near_ & _ & _).
  exists E. split; [exact EE|]. split; [exact rep|].
  pose proof (q_error f fine 8 ltac:(lia)) as q8. replace (INR 8) with 8 in q8 by (simpl; ring).
  set (P := 64 * u * PM + eta * (Q * Q)) in *.
  assert ((q 8 - 1) * P <= 0.000001 * P) by (apply Rmult_le_compat_r; unfold P; lra).
  assert (lP : 0 <= l * PM <= / 1099511627776 * (e1 * PM)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * PM)) with (/ 1099511627776 * e1 * PM) by ring. apply Rmult_le_compat_r; lra. }
  assert (lQQ : 0 <= l * (Q * Q) <= / 512 * (eta * (Q * Q))). { split; [apply Rmult_le_pos; lra|].
    replace (/ 512 * (eta * (Q * Q))) with (/ 512 * eta * (Q * Q)) by ring. apply Rmult_le_compat_r; lra. }
  assert (a_ : forall a, a <= 2.1 * PM + 7 * (Q * Q) + 9 * (eta * (Q * Q)) -> l * a <= 2.1 * (l * PM) + 7 * (l * (Q *
    Q)) + 0.001 * (eta * (Q * Q))).
  { intros a ha. apply (Rmult_le_compat_l l) in ha; [|lra].
    assert (l * (eta * (Q * Q)) <= 0.0001 * (eta * (Q * Q))) by (apply Rmult_le_compat_r; lra). lra. }
  match type of near_ with _ <= _ + _ * ?a => assert (la := a_ a) end. specialize (la ltac:(lra)).
  apply Rabs_le_inv in near_. unfold P in *. replace (64 * u * PM) with (32 * (e1 * PM)) in * by (rewrite eu; ring).
  assert (0 <= e1 * PM) by (apply Rmult_le_pos; lra). assert (eta * 1 <= eta * (Q * Q)) by (apply Rmult_le_compat_l;
    lra). lra.
Qed.

(* Margins. A margin, as it is seen, and a reserve are at most the exact control value, with the sign that the first
   has. *)
Definition reserve := 9.6 * e1 * PM + 0.65 * (eta * (Q * Q)).
Definition width := 1.01 * PM + 1.4 * (eta * (Q * Q)).
Definition sign_of b0 (s : R) := (says f env value_of (Greater (Constant (Small 0)) b0) /\
  s = -1) \/ (~ says f env value_of (Greater (Constant (Small 0)) b0) /\ s = 1).
Lemma margin_facts b0 b s X : sign_of b0 s -> value_holds b X 21 13.2 135 ->
  exists x, value_of (margin b0 b (error_of_volume pairs)) = Number x /\ representable f x /\ Rd x = x /\
    seen x + reserve <= s * X /\ Rabs (seen x) <= width.
Proof.
  intros sign (y & Ey & ry & near_). destruct error_value as (E & EE & rE & lE & low & high).
  pose proof G_bounds. pose proof Q_bounds. pose proof QQ. pose proof volume_bounds as (S3b & PMG & _ & S3PM).
    pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (eta_large f fine). pose proof (eta_1 f fine). pose proof (l_e f fine).
  set (PMv := PM) in *. set (N := eta * (Q * Q)) in *.
  assert (N0 : eta <= N). { unfold N. rewrite <- (Rmult_1_r eta) at 1. apply Rmult_le_compat_l; lra. }
  assert (NG : N <= G * G). { unfold N. assert (eta * (Q * Q) <= 1 * (Q * Q)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (lP : 0 <= l * PMv <= / 1099511627776 * (e1 * PMv)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * PMv)) with (/ 1099511627776 * e1 * PMv) by ring. apply Rmult_le_compat_r; lra. }
  assert (lQQ : 0 <= l * (Q * Q) <= / 512 * N). { split; [apply Rmult_le_pos; lra|]. unfold N.
    replace (/ 512 * (eta * (Q * Q))) with (/ 512 * eta * (Q * Q)) by ring. apply Rmult_le_compat_r; lra. }
  assert (eN : 0 <= e1 * N <= / 8388608 * N) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eP : 0 <= e1 * PMv <= / 8388608 * PMv) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eeP : e1 * (e1 * PMv) <= / 8388608 * (e1 * PMv)) by (apply Rmult_le_compat_r; lra).
  pose proof (q_linear f ok 21 ltac:(lia)) as q21. replace (INR 21) with 21 in q21 by (simpl; ring).
    pose proof (q_ge f 21).
  assert (err_ : Rabs (y - X) <= 21.03 * (e1 * PMv) + 0.27 * N).
  { destruct near_ as (d & _ & _). assert ((q 21 - 1) * S3 <= 21.021 * e1 * S3) by (apply Rmult_le_compat_r; lra).
    assert (e1 * S3 <= e1 * ((1 + 10 * e1) * PMv)) by (apply Rmult_le_compat_l; lra).
    assert (l * (13.2 * S3 + 135 * (Q * Q)) <= l * (13.3 * PMv + 135 * (Q * Q))) by (apply Rmult_le_compat_l; lra).
      lra. }
  assert (size : Rabs y <= 1.0011 * PMv + 0.28 * N).
  { pose proof (near_size f _ _ _ _ _ near_) as h. assert (q 21 * S3 <= 1.00001 * S3) by (apply Rmult_le_compat_r; lra).
    assert (l * (13.2 * S3 + 135 * (Q * Q)) <= l * (13.3 * PMv + 135 * (Q * Q))) by (apply Rmult_le_compat_l; lra).
      lra. }
  assert (sE : seen E = E) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
  set (chosen := Select (Greater (Constant (Small 0)) b0) (Negative b) b).
  assert (Ec : value_of chosen = Number (s * y) /\ Rabs (s * y) = Rabs y).
  { pose proof (run chosen) as h. unfold chosen in h. cbn -[says] in h. fold chosen in h.
    pose proof (run (Negative b)) as hn. cbn in hn. rewrite Ey in hn. cbn in hn.
    destruct sign as [[is ->]|[not ->]], h as [[is' h]|[not' h]]; try tauto.
    - rewrite h, hn. replace (-1 * y) with (- y) by ring. split; [reflexivity|apply Rabs_Ropp].
    - rewrite h, Ey. replace (1 * y) with y by ring. auto. }
  destruct Ec as [Ec Ea]. pose proof (run (margin b0 b (error_of_volume pairs))) as h. unfold margin in h.
    fold chosen in h. cbn -[chosen error_of_volume] in h.
  rewrite Ec, EE in h. cbn in h. rewrite sE in h. pose proof (seen_smaller f env (s * y)) as ss.
    pose proof (seen_off f env (s * y)) as so.
  assert (zb : Rabs (seen (s * y) - E) <= 1.0012 * PMv + 1.31 * N).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq E) by lra. lra. }
  apply (result_number f ok env) in h; [|lra]. exists (Rd (seen (s * y) - E)).
  split; [exact h|]. split; [exact (result_is_representable f ok _ _ (nearly env _))|]. split; [apply settled|].
  pose proof (error f ok env (seen (s * y) - E)) as er. assert (e1 * Rabs (seen (s * y) - E) <= e1 * (1.0012 * PMv +
    1.31 * N)) by (apply Rmult_le_compat_l; lra).
  set (z := seen (s * y) - E) in *. pose proof (seen_off f env (Rd z)) as sr.
    pose proof (seen_smaller f env (Rd z)) as sr'.
  assert (Rabs (Rd z) <= Rabs z + (e1 * (1.0012 * PMv + 1.31 * N) + l)).
  { replace (Rd z) with (z + (Rd z - z)) at 1 by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (signed : Rabs (s * y - s * X) <= 21.03 * (e1 * PMv) + 0.27 * N).
  { destruct sign as [[_ ->]|[_ ->]]; [replace (-1 * y - -1 * X) with (- (y - X)) by ring;
    rewrite Rabs_Ropp|replace (1 * y - 1 * X) with (y - X) by ring]; assumption. }
  apply Rabs_le_inv in er. apply Rabs_le_inv in sr. apply Rabs_le_inv in so. apply Rabs_le_inv in signed.
  unfold reserve, width. fold PMv N. split; [unfold z in *; lra|]. lra.
Qed.
End Volume.
