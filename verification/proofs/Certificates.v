(* The lemmas behind the certificates of the time of impact, of a separation and of truncation, in exact numbers. Their
   roundings are not proven here. *)
From Coq Require Import Reals Lra Psatz.
From Selvedge Require Import Geometry.
From Selvedge Require Apart.
Open Scope R_scope.

(* A direction no longer than one along which two points are m apart: so is their distance. *)
Definition length_squared a := dot a a.
Theorem a_product_bounds_the_distance w d m : length_squared w <= 1 -> 0 <= m -> m <= dot w d -> m ^ 2 <= length_squared
  d.
Proof.
  intros unit m0 far. unfold length_squared in *. assert (schwarz : dot w d ^ 2 <= dot w w * dot d d).
  { unfold dot. pose proof (pow2_ge_0 (x w * y d - y w * x d)). pose proof (pow2_ge_0 (y w * z d - z w * y d)).
    pose proof (pow2_ge_0 (z w * x d - x w * z d)). nra. }
  assert (0 <= dot d d) by (unfold dot; nra). assert (m ^ 2 <= dot w d ^ 2) by (apply pow_incr; lra). nra.
Qed.
(* Ahead by m along w of each corner of the other set: of each of its points; and so is each point between two that are.
   *)
Definition ahead_by m w p q := m <= dot w (minus p q).
Theorem ahead_of_the_triangle m w p a b c u v r : 0 <= u -> 0 <= v -> 0 <= r -> u + v + r = 1 -> ahead_by m w p a ->
  ahead_by m w p b -> ahead_by m w p c ->
  ahead_by m w p (plus (scaled u a) (plus (scaled v b) (scaled r c))).
Proof.
  intros u0 v0 r0 one A B C. unfold ahead_by in *. assert (u * m <= u * dot w (minus p a)) by (apply Rmult_le_compat_l;
    lra).
  assert (v * m <= v * dot w (minus p b)) by (apply Rmult_le_compat_l; lra). assert (r * m <= r * dot w (minus p c)) by
    (apply Rmult_le_compat_l; lra).
  replace (dot w (minus p (plus (scaled u a) (plus (scaled v b) (scaled r c))))) with
    (u * dot w (minus p a) + v * dot w (minus p b) + r * dot w (minus p c)); [replace m with (u * m + v * m + r * m) by
      nra; lra|].
  replace r with (1 - u - v) by lra. unfold dot, minus, plus, scaled; simpl; ring.
Qed.
Theorem between_two_ahead m w p q a b s : 0 <= s <= 1 -> ahead_by m w p a -> ahead_by m w q a -> ahead_by m w p b ->
  ahead_by m w q b ->
  forall r, 0 <= r <= 1 -> ahead_by m w (plus (scaled (1 - s) p) (scaled s q)) (plus (scaled (1 - r) a) (scaled r b)).
Proof.
  intros s01 A B C D r r01. unfold ahead_by in *.
  assert (P : m <= (1 - s) * dot w (minus p a) + s * dot w (minus q a)) by nra.
    assert (Q : m <= (1 - s) * dot w (minus p b) + s * dot w (minus q b)) by nra.
  replace (dot w _) with ((1 - r) * ((1 - s) * dot w (minus p a) + s * dot w (minus q a)) + r * ((1 - s) * dot w (minus
    p b) + s * dot w (minus q b)))
    by (unfold dot, minus, plus, scaled; simpl; ring). nra.
Qed.

(* A direction held from one time to a later one: ahead at both, ahead in between. *)
Theorem held_direction m w p q t0 t1 t : t0 <= t <= t1 -> ahead_by m w (at_ p t0) (at_ q t0) -> ahead_by m w (at_ p t1)
  (at_ q t1) -> ahead_by m w (at_ p t) (at_ q t).
Proof.
  intros between A B. unfold ahead_by in *. set (f s := dot w (minus (at_ p s) (at_ q s))) in *. change (m <= f t).
    change (m <= f t0) in A. change (m <= f t1) in B.
  destruct (Req_dec t0 t1) as [same|ne]; [replace t with t0 by lra; exact A|].
  assert (E : (t1 - t0) * f t = (t1 - t) * f t0 + (t - t0) * f t1) by (unfold f, dot, minus, at_, plus, scaled; simpl;
    ring).
  assert ((t1 - t) * m <= (t1 - t) * f t0) by (apply Rmult_le_compat_l; lra).
    assert ((t - t0) * m <= (t - t0) * f t1) by (apply Rmult_le_compat_l; lra).
  apply (Rmult_le_reg_l (t1 - t0)); lra.
Qed.
(* A direction that turns from v to w in a part of the step, for a corner that moves from a to b in it: three control
   values above m. *)
Theorem turning_direction m v w a b s : 0 <= s <= 1 -> m <= dot v a -> 2 * m <= dot v b + dot w a -> m <= dot w b ->
  m <= dot (plus (scaled (1 - s) v) (scaled s w)) (plus (scaled (1 - s) a) (scaled s b)).
Proof.
  intros s01 A B C. replace (dot _ _) with ((1 - s) * (1 - s) * dot v a + (1 - s) * s * (dot v b + dot w a) + s * s *
    dot w b)
    by (unfold dot, plus, scaled; simpl; ring).
  assert (0 <= (1 - s) * (1 - s)) by (apply Rmult_le_pos; lra). assert (0 <= (1 - s) * s) by (apply Rmult_le_pos; lra).
    assert (0 <= s * s) by (apply Rmult_le_pos; lra).
  assert ((1 - s) * (1 - s) * m <= (1 - s) * (1 - s) * dot v a) by (apply Rmult_le_compat_l; assumption).
  assert ((1 - s) * s * (2 * m) <= (1 - s) * s * (dot v b + dot w a)) by (apply Rmult_le_compat_l; assumption).
  assert (s * s * m <= s * s * dot w b) by (apply Rmult_le_compat_l; assumption).
  replace m with ((1 - s) * (1 - s) * m + (1 - s) * s * (2 * m) + s * s * m) by ring. lra.
Qed.
(* The volume in a part of the step, from t to r: its control values there are blossoms of those of the whole, and of
   one sign exclude a root. *)
Definition blossom k0 k1 k2 k3 a b c :=
  (1 - a) * ((1 - b) * ((1 - c) * k0 + c * k1) + b * ((1 - c) * k1 + c * k2)) + a * ((1 - b) * ((1 - c) * k1 + c * k2) +
    b * ((1 - c) * k2 + c * k3)).
Theorem volume_on_a_part k0 k1 k2 k3 t r s : let f := blossom k0 k1 k2 k3 in let at_time := (1 - s) * t + s * r in f
  at_time at_time at_time =
  f t t t * (1 - s) ^ 3 + 3 * f t t r * (1 - s) ^ 2 * s + 3 * f t r r * (1 - s) * s ^ 2 + f r r r * s ^ 3.
Proof. unfold blossom. cbv zeta. ring. Qed.
Theorem one_sign_on_a_part k0 k1 k2 k3 t r s : let f := blossom k0 k1 k2 k3 in 0 <= s <= 1 -> 0 < f t t t -> 0 < f t t r
  -> 0 < f t r r -> 0 < f r r r ->
  let at_time := (1 - s) * t + s * r in 0 < f at_time at_time at_time.
Proof.
  cbv zeta. intros s01 A B C D. rewrite volume_on_a_part.
  apply (hull (blossom k0 k1 k2 k3 t t t) (3 * blossom k0 k1 k2 k3 t t r) (3 * blossom k0 k1 k2 k3 t r r) (blossom k0 k1
    k2 k3 r r r) s); lra.
Qed.

(* Truncation (core/src/separation/truncation.rs): along a direction d there is room for a gap m at a base; each point
   may go towards where it is wanted as long as it stays on its side of the offset o, or any part of that; and the gap
   lasts from wherever it was m before. *)
Definition towards from_ to s := plus from_ (scaled s (minus to from_)).
Theorem a_share_keeps_its_side d o from_ to s s' : 0 <= s' <= s -> o <= dot d from_ -> o <= dot d (towards from_ to s)
  -> o <= dot d (towards from_ to s').
Proof.
  intros less A B. destruct (Req_dec s 0) as [->|n]; [now replace s' with 0 by lra|].
  assert (E : s * dot d (towards from_ to s') = (s - s') * dot d from_ + s' * dot d (towards from_ to s)) by (unfold
    towards, dot, plus, minus, scaled; simpl; ring).
  assert ((s - s') * o <= (s - s') * dot d from_) by (apply Rmult_le_compat_l; lra).
    assert (s' * o <= s' * dot d (towards from_ to s)) by (apply Rmult_le_compat_l; lra).
  apply (Rmult_le_reg_l s); lra.
Qed.
Theorem truncated_ways_keep_the_gap d o m p q start_p start_q wanted_p wanted_q s r s' r' t :
  ahead_by m d start_p start_q -> o + m <= dot d p -> dot d q <= o -> o + m <= dot d (towards p wanted_p s) -> dot d
    (towards q wanted_q r) <= o ->
  0 <= s' <= s -> 0 <= r' <= r -> 0 <= t <= 1 ->
  ahead_by m d (at_ (Path start_p (towards p wanted_p s')) t) (at_ (Path start_q (towards q wanted_q r')) t).
Proof.
  intros before P Q P' Q' less_p less_q time_. pose proof (a_share_keeps_its_side d (o + m) p wanted_p s s' less_p P P')
    as A.
  assert (opposite : forall v, dot (scaled (-1) d) v = - dot d v) by (intro v; unfold dot, scaled; simpl; ring).
  pose proof (a_share_keeps_its_side (scaled (-1) d) (- o) q wanted_q r r' less_q) as B. rewrite !opposite in B.
    specialize (B ltac:(lra) ltac:(lra)).
  apply (held_direction m d _ _ 0 1 t time_).
  - unfold ahead_by, at_ in *. cbn [start finish]. replace (dot d _) with (dot d (minus start_p start_q));
    [exact before|]. unfold dot, minus, plus, scaled; simpl; ring.
  - unfold ahead_by, at_. cbn [start finish]. replace (dot d _) with (dot d (towards p wanted_p s') - dot d (towards q
    wanted_q r')); [lra|]. unfold dot, minus, plus, scaled; simpl; ring.
Qed.
