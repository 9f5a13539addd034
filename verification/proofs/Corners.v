(* The corners of a pair, and how near computed products with them are to exact ones:
   core/src/kernels/advance/corners.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

(* What is assumed of a format's constants; `Theorems.v` shows it of both formats. *)
Record reasonable_constants (c : constants) : Prop := {
  reasonable_base : reasonable c;
  enough_underflow : (extent_underflow c - precision c >= least_exponent c + precision c - 1 + 2)%Z;
  small_underflow : (extent_underflow c <= 0)%Z;
  extents : (0 <= largest_extent c <= largest_edge c)%Z;
  squares : (4 * largest_edge c + 8 <= greatest_exponent c)%Z;
  safe : (least_exponent c + precision c - 1 + 2 + precision c <= safe_square c <= 0)%Z;
  vanishing : (least_exponent c + precision c - 1 + 2 <= 2 * length_underflow c <= 0)%Z;
  squared_normals : (4 * largest_extent c + 12 <= greatest_exponent c)%Z }.

(* The code's vectors. *)
Record vector := Vector { vx : number; vy : number; vz : number }.
Definition component v a := match a with Expressions.X => vx v | Expressions.Y => vy v | Expressions.Z_ => vz v end.
Definition each g := Vector (g Expressions.X) (g Expressions.Y) (g Expressions.Z_).
Lemma component_each g a : component (each g) a = g a. Proof. now destruct a. Qed.
Definition dot_ a b := Sum (Sum (Product (vx a) (vx b)) (Product (vy a) (vy b))) (Product (vz a) (vz b)).
Definition magnitudes v := each (fun a => Magnitude (component v a)).

(* A corner is the difference of a point of the first set and one of the second, at the start and at the end. *)
Definition difference pair t := let '(n, k) := pair in
  each (fun a => Minus (Input (Place (Expressions.Coordinate n t a))) (Input (Place (Expressions.Coordinate k t a)))).
Definition at_start pair := difference pair Expressions.Start.
Definition at_end pair := difference pair Expressions.End.
(* Points 0 to 3 are vertex, a, b, c, and u, v, k, l. *)
Definition vertex_face := [(0, 1); (0, 2); (0, 3)]%nat.
Definition edge_edge := [(0, 2); (0, 3); (1, 2); (1, 3)]%nat.
Definition one := Constant (Small 1).
(* The corner at a moment. *)
Definition corner_at n pair := each (fun a => Sum (Product (component (at_start pair) a) (Minus one (Input (Moment n))))
  (Product (component (at_end pair) a) (Input (Moment n)))).
(* M: the largest magnitudes along each axis, and μ. *)
Definition ends pair a := Larger (Magnitude (component (at_start pair) a)) (Magnitude (component (at_end pair) a)).
Definition most pairs a := match pairs with
  | [] => one
  | first :: others => fold_left (fun m pair => Larger (ends pair a) m) others (ends first a) end.
Definition extent pairs := each (fun a => Sum (most pairs a) (Constant ExtentUnderflow)).
Definition largest v := Larger (Larger (vx v) (vy v)) (vz v).
Definition are_in_range pairs := Not (Greater (largest (extent pairs)) (Constant LargestExtent)).
(* A direction that is tried, and T, the error of a product with it. *)
Definition direction k := each (fun a => Input (Along k a)).
Definition roundoffs count := Product (Constant (Small count)) (Constant UnitRoundoff).
Definition product_error pairs w := Sum (Product (roundoffs 20) (dot_ (magnitudes w) (extent pairs))) (Constant
  Underflow).

Section Corners.
Load "Setting.section".
Notation L := (power (largest_extent f)).

Lemma G_4 : 4 <= G.
Proof.
  unfold Errors.reach, power. assert (bpow radix2 0 <= bpow radix2 (largest_edge f)) by (apply bpow_le; destruct ok;
    lia). simpl in H. lra.
Qed.
Lemma G_3 : 1073741824 * (G * G * G) <= omega f.
Proof. pose proof (Errors.omega_large f ok) as h. simpl in h. rewrite Rmult_1_r in h. rewrite Rmult_assoc. exact h. Qed.
Lemma G_2 : 1073741824 * (G * G) <= omega f.
Proof. pose proof G_3. pose proof G_4. assert (1 * (G * G) <= G * (G * G)) by (apply Rmult_le_compat_r; nra). lra. Qed.
Lemma G_1 : 1073741824 * G <= omega f.
Proof. pose proof G_2. pose proof G_4. assert (1 * G <= G * G) by (apply Rmult_le_compat_r; lra). lra. Qed.
Lemma L_1 : 1 <= L. Proof. change 1 with (bpow radix2 0). apply bpow_le. destruct fine; lia. Qed.
Lemma L_G : L <= / 4 * G.
Proof. unfold Errors.reach. assert (L <= power (largest_edge f)) by (apply bpow_le; destruct fine; lia). lra. Qed.
Lemma mu_pos : 0 < mu. Proof. apply bpow_gt_0. Qed.
Lemma mu_1 : mu <= 1. Proof. change 1 with (bpow radix2 0). apply bpow_le. destruct fine; lia. Qed.
Lemma mu_large : 8 * l <= e1 * mu.
Proof.
  rewrite eps_twice. unfold unit_roundoff, lam, power. rewrite Rmult_assoc, <- bpow_plus.
  assert (4 * bpow radix2 (least_exponent f + precision f - 1) <= bpow radix2 (- precision f + extent_underflow f));
    [|lra].
  change 4 with (bpow radix2 2). rewrite <- bpow_plus. apply bpow_le. destruct fine; lia.
Qed.
Lemma mu_l : 67108864 * l <= mu.
Proof.
  pose proof mu_large. pose proof (e_small f ok). pose proof mu_pos.
  assert (e1 * mu <= / 8388608 * mu) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma l_e : 1099511627776 * l <= e1.
Proof.
  unfold lam, eps, power. change 1099511627776 with (bpow radix2 40). rewrite <- bpow_plus. apply bpow_le.
    destruct ok; lia.
Qed.
Lemma eta_large : 512 * l <= power (underflow f).
Proof. unfold lam, power. change 512 with (bpow radix2 9). rewrite <- bpow_plus. apply bpow_le. destruct ok; lia. Qed.
Lemma eta_1 : power (underflow f) <= 1. Proof. change 1 with (bpow radix2 0). apply bpow_le. destruct ok; lia. Qed.

Lemma constant c : value_of (Constant c) = Number (constant_value f c). Proof. exact (run (Constant c)). Qed.
Lemma seen_1 : seen 1 = 1.
Proof. apply seen_of_normal. rewrite Rabs_R1. pose proof (l_small f ok). lra. Qed.

(* One difference: a number, or infinite. *)
Definition exact_difference p p' := given (Place p) - given (Place p').
Notation minus_of p p' := (Minus (Input (Place p)) (Input (Place p'))).
Lemma difference_result p p' : exists z, Rabs (z - exact_difference p p') <= 2 * l /\
  result f env z (value_of (minus_of p p')).
Proof.
  pose proof (run (minus_of p p')) as h. cbn in h. rewrite (run (Input (Place p))), (run (Input (Place p'))) in h.
    cbn in h.
  eexists. split; [|exact h]. pose proof (seen_off f env (given (Place p))) as a.
    pose proof (seen_off f env (given (Place p'))) as b.
  unfold exact_difference. apply Rabs_le_inv in a. apply Rabs_le_inv in b. apply Rabs_le. lra.
Qed.
Definition is_magnitude v := (exists x, v = Number x /\ 0 <= x) \/ v = Infinite true.
Lemma difference_magnitude p p' : is_magnitude (value_of (Magnitude (minus_of p p'))).
Proof.
  rewrite (run (Magnitude _)). destruct (difference_result p p') as (z & _ & [[_ ->]|[[_ [-> | ->]]|[_ [-> | ->]]]]);
    cbn;
    unfold is_magnitude; eauto using Rabs_pos.
Qed.
Lemma difference_near p p' x : value_of (minus_of p p') = Number x -> Rabs x <= G ->
  representable f x /\ Rabs (x - exact_difference p p') <= e1 * Rabs x + 3 * l.
Proof.
  intros E small. destruct (difference_result p p') as (z & off & r). rewrite E in r. pose proof G_1. pose proof G_4.
  destruct r as [[_ r]|[[_ [r|r]]|[_ [r|r]]]]; try discriminate; injection r as ->.
  - split; [exact (result_is_representable f ok _ _ (nearly env z))|].
    pose proof (rounding_error_by_result f ok _ _ (nearly env z)) as e.
    replace (Rd z - exact_difference p p') with ((Rd z - z) + (z - exact_difference p p')) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra.
  - rewrite Rabs_pos_eq in small by lra. lra.
  - rewrite Rabs_Ropp, Rabs_pos_eq in small by lra. lra.
Qed.

(* The larger of two magnitudes. *)
Lemma larger_magnitude v w out : is_magnitude v -> is_magnitude w -> larger f env v w out -> is_magnitude out /\
  forall x, out = Number x -> (exists y, v = Number y /\ 0 <= y /\ seen y <= seen x) /\ (exists y, w = Number y /\
    0 <= y /\ seen y <= seen x).
Proof.
  assert (pos : forall x, 0 <= x -> 0 <= seen x). { intros x h. rewrite <- (seen_0 f env). now apply seen_monotone. }
  intros [(x & -> & x0)| ->] [(y & -> & y0)| ->] [[g [-> | ->]]|[g [-> | ->]]]; cbn in *; try tauto;
    unfold is_magnitude; split;
    try (left; eexists; split; [reflexivity|]; auto; fail); try (right; reflexivity);
    intros s E; try discriminate; injection E as <-; rewrite ?seen_twice;
    try (split; eexists; repeat split; try reflexivity; try assumption; lra); exfalso; tauto.
Qed.
Lemma ends_magnitude pair a : is_magnitude (value_of (ends pair a)).
Proof.
  destruct pair as [n k]. pose proof (run (ends (n, k) a)) as h. cbn in h.
  eapply larger_magnitude; [| |exact h]; destruct a; apply difference_magnitude.
Qed.
Lemma ends_bound pair a x : value_of (ends pair a) = Number x -> forall t, exists y,
  value_of (component (difference pair t) a) = Number y /\ Rabs (seen y) <= seen x.
Proof.
  destruct pair as [n k]. intros E t. pose proof (run (ends (n, k) a)) as h. cbn in h. rewrite !component_each in h.
  destruct (larger_magnitude _ _ _ (difference_magnitude _ _) (difference_magnitude _ _) h) as [_ both].
  destruct (both x E) as [(y & Y & _ & le) (y' & Y' & _ & le')].
  assert (of : forall e y, value_of (Magnitude e) = Number y -> seen y <= seen x -> exists z, value_of e = Number z /\
    Rabs (seen z) <= seen x).
  { intros e z Z Zle. rewrite (run (Magnitude e)) in Z. destruct (value_of e); try discriminate. injection Z as <-.
    eexists. split; [reflexivity|]. now rewrite seen_magnitude in Zle. }
  unfold difference. rewrite component_each. destruct t; eapply of; eassumption.
Qed.
Lemma most_bound a others : forall first, is_magnitude (value_of first) ->
  let m := fold_left (fun m pair => Larger (ends pair a) m) others first in is_magnitude (value_of m) /\
  forall x, value_of m = Number x -> (exists y, value_of first = Number y /\ seen y <= seen x) /\
    forall pair, In pair others -> exists y, value_of (ends pair a) = Number y /\ seen y <= seen x.
Proof.
  induction others as [|pair others IH]; intros first fm; cbn.
  - split; [exact fm|]. intros x E. split; [exists x; split; [exact E|lra]|tauto].
  - pose proof (run (Larger (ends pair a) first)) as h. cbn in h.
    destruct (larger_magnitude _ _ _ (ends_magnitude pair a) fm h) as [mm both].
    destruct (IH _ mm) as [mm' all]. split; [exact mm'|]. intros x E. destruct (all x E) as [(y & Y & le) rest].
    destruct (both y Y) as [(z & Z & _ & zle) (z' & Z' & _ & zle')]. split; [exists z'; split; [exact Z'|lra]|].
    intros p [<-|inside]; [exists z; split; [exact Z|lra]|now apply rest].
Qed.
Lemma most_magnitude pairs a : is_magnitude (value_of (most pairs a)).
Proof.
  destruct pairs as [|first others].
  - left. exists 1. split; [exact (constant (Small 1))|lra].
  - apply most_bound, ends_magnitude.
Qed.
Lemma largest_extent_bounds v B : (forall a, is_magnitude (value_of (component v a))) -> l <= B ->
  ~ greater f env (value_of (largest v)) (Number B) -> forall a, exists x, value_of (component v a) = Number x /\
    0 <= x <= B.
Proof.
  intros mag lB small. pose proof (run (largest v)) as h. pose proof (run (Larger (vx v) (vy v))) as h'. cbn in h, h'.
  destruct (larger_magnitude _ _ _ (mag Expressions.X) (mag Expressions.Y) h') as [m' both'].
  destruct (larger_magnitude _ _ _ m' (mag Expressions.Z_) h) as [m both].
  destruct m as [(x & E & x0)|E]; rewrite E in small; cbn in small; [|tauto].
  assert (le : seen x <= B). { apply Rnot_lt_le. rewrite <- (seen_of_normal f env B) at 1; [exact small|].
    pose proof (Rle_abs B). lra. }
  destruct (both x E) as [(y & Y & y0 & yle) (z & Z & z0 & zle)]. destruct (both' y Y) as [(y1 & Y1 & y10 & y1le) (y2 &
    Y2 & y20 & y2le)].
  assert (last : forall t, 0 <= t -> seen t <= B -> t <= B).
  { intros t t0 tle. unfold Machine.seen in tle. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs t) l)|];
    try assumption.
    rewrite Rabs_pos_eq in * by assumption. lra. }
  intros [| |]; cbn; eexists; (split; [eassumption|]); split; try assumption; apply last; try assumption; lra.
Qed.

(* Of a pair in range: its extent, and its differences, are numbers. *)
Section InRange.
Variable pairs : list (nat * nat).
Hypothesis in_range : says f env value_of (are_in_range pairs).
(* The largest magnitude along an axis, as it is seen. *)
Definition m a := match value_of (most pairs a) with Number x => seen x | _ => 0 end.
Lemma extent_and_differences a : value_of (component (extent pairs) a) = Number (Rd (m a + mu)) /\ 0 <= m a /\
  Rd (m a + mu) <= L /\
  forall pair t, In pair pairs -> exists y, value_of (component (difference pair t) a) = Number y /\ Rabs y <= m a + l.
Proof.
  pose proof (l_pos f) as l0. pose proof (l_small f ok). pose proof L_1. pose proof G_1. pose proof G_4.
    pose proof L_G. pose proof mu_pos.
  pose proof (mu_l) as ml.
  assert (mag : forall b, is_magnitude (value_of (component (extent pairs) b))).
  { intro b. assert (e : component (extent pairs) b = Sum (most pairs b) (Constant ExtentUnderflow)) by now destruct b.
    rewrite e. pose proof (run (Sum (most pairs b) (Constant ExtentUnderflow))) as h. cbn in h. rewrite constant in h.
      cbn in h.
    destruct (most_magnitude pairs b) as [(x & E & x0)|E]; rewrite E in h; cbn in h; [|right; exact h].
    assert (0 <= seen x) by (rewrite <- (seen_0 f env); now apply seen_monotone).
    rewrite (seen_of_normal f env mu) in h by (rewrite Rabs_pos_eq; lra).
    pose proof (rounded_positive f env (seen x + mu) ltac:(lra)) as p. unfold is_magnitude.
    destruct h as [[_ ->]|[[_ [-> | ->]]|[neg _]]]; [left|right|left|lra]; eauto. exists (omega f).
      split; [reflexivity|lra]. }
  cbn in in_range. rewrite constant in in_range. cbn [constant_value] in in_range.
  destruct (largest_extent_bounds _ L mag ltac:(lra) in_range a) as (M & E & M0 & ML).
  assert (e : component (extent pairs) a = Sum (most pairs a) (Constant ExtentUnderflow)) by now destruct a.
  rewrite e in *. pose proof (run (Sum (most pairs a) (Constant ExtentUnderflow))) as h. cbn in h.
    rewrite constant in h. cbn in h.
  destruct (most_magnitude pairs a) as [(x & X & x0)|X]; rewrite X, E in h; cbn in h; [|discriminate].
  assert (sx : 0 <= seen x) by (rewrite <- (seen_0 f env); now apply seen_monotone).
  rewrite (seen_of_normal f env mu) in h by (rewrite Rabs_pos_eq; lra).
  pose proof (rounded_positive f env (seen x + mu) ltac:(lra)) as p.
  assert (m a = seen x) as -> by (unfold m; now rewrite X).
  assert (M = Rd (seen x + mu)) as <-.
  { destruct h as [[_ h]|[[_ [h|h]]|[neg _]]]; try discriminate; try lra; injection h as ->;
    first [reflexivity|exfalso; lra]. }
  split; [exact E|]. split; [exact sx|]. split; [exact ML|]. intros pair t inside.
  assert (of_ends : exists y, value_of (ends pair a) = Number y /\ seen y <= seen x).
  { destruct pairs as [|first others]; [destruct inside|]. destruct (most_bound a others _ (ends_magnitude first a)) as
    [_ all].
    destruct (all x X) as [of_first of_others]. destruct inside as [<-|inside]; [exact of_first|now apply of_others]. }
  destruct of_ends as (y & Y & yle). destruct (ends_bound pair a y Y t) as (z & Z & zle). exists z. split; [exact Z|].
  pose proof (seen_off f env z) as off. replace z with ((z - seen z) + seen z) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite <- (Rabs_Ropp (z - seen z)).
    replace (- (z - seen z)) with (seen z - z) by ring. lra.
Qed.
Notation M a := (Rd (m a + mu)).
Lemma m_pos a : 0 <= m a. Proof. apply extent_and_differences. Qed.
Lemma extent_value a : value_of (component (extent pairs) a) = Number (M a). Proof. apply extent_and_differences. Qed.
Lemma M_low a : (1 - e1) * (m a + mu) - l <= M a.
Proof.
  pose proof (m_pos a). pose proof mu_pos. pose proof (error f ok env (m a + mu)) as E.
    rewrite (Rabs_pos_eq (m a + mu)) in E by lra.
  apply Rabs_le_inv in E. lra.
Qed.
Lemma m_small a : m a <= 0.26 * G.
Proof.
  pose proof (M_low a). pose proof (extent_and_differences a) as (_ & m0 & ML & _). pose proof L_G.
    pose proof (e_small f ok).
  pose proof (l_small f ok). pose proof mu_pos. pose proof G_4. pose proof (e_pos f).
  assert (e1 * (m a + mu) <= / 8388608 * (m a + mu)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
(* What a difference is at most, without rounding. *)
Definition p a := (1 + e1) * (m a + l) + 3 * l.
Lemma p_pos a : 0 < p a.
Proof. unfold p. pose proof (m_pos a). pose proof (l_pos f). pose proof (e_pos f).
  assert (0 <= e1 * (m a + l)) by (apply Rmult_le_pos; lra). lra. Qed.
Lemma p_small a : p a <= 0.27 * G.
Proof.
  pose proof (m_small a). pose proof (m_pos a). pose proof G_4. pose proof (e_small f ok). pose proof (l_small f ok).
    pose proof (l_pos f).
  assert (e1 * (m a + l) <= / 8388608 * (m a + l)) by (apply Rmult_le_compat_r; lra). unfold p. lra.
Qed.
Definition exactly (pair : nat * nat) t a := let '(n, k) := pair in exact_difference (Expressions.Coordinate n t a)
  (Expressions.Coordinate k t a).
Lemma difference_holds pair t a : In pair pairs -> holds (value_of (component (difference pair t) a)) (exactly pair t a)
  (p a) 1 3.
Proof.
  intro inside. destruct (extent_and_differences a) as (_ & m0 & _ & all). destruct (all pair t inside) as (y & Y &
    small).
  pose proof (m_small a). pose proof G_4. pose proof (l_small f ok). pose proof (l_pos f). pose proof (e_pos f).
  exists y. split; [exact Y|]. destruct pair as [n k]. unfold difference in Y. rewrite component_each in Y.
  destruct (difference_near _ _ y Y ltac:(lra)) as [rep off]. split; [exact rep|]. cbn [exactly].
  set (D := exact_difference _ _) in *. unfold near, Bounds.q. assert (e1 * Rabs y <= e1 * (m a + l)) by (apply
    Rmult_le_compat_l; lra).
  assert (0 <= e1 * (m a + l)) by (apply Rmult_le_pos; lra). assert (0 <= e1 * (e1 * (m a + l) + 3 * l)) by (apply
    Rmult_le_pos; lra).
  assert (pe : (1 + e1) ^ 1 - 1 = e1) by ring. rewrite pe. unfold p.
  replace (e1 * ((1 + e1) * (m a + l) + 3 * l)) with (e1 * (m a + l) + e1 * (e1 * (m a + l) + 3 * l)) by ring.
  split; [lra|]. split; [|lra]. replace D with (y + - (y - D)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp. lra.
Qed.

(* The dot product of two vectors. *)
Definition sum3 (g : Expressions.axis -> R) := g Expressions.X + g Expressions.Y + g Expressions.Z_.
Lemma dot_holds u v U V pu pv au av n k : (forall a, operand (value_of (component u a)) (U a) (pu a) n (au a)) ->
  (forall a, operand (value_of (component v a)) (V a) (pv a) k (av a)) -> (n + k <= 12)%nat ->
  let x := sum3 (fun a => pu a * av a + au a * pv a + l * (au a * av a)) in
  sum3 (fun a => pu a * pv a) <= omega f / 4 -> x <= omega f / 4 ->
  holds (value_of (dot_ u v)) (sum3 (fun a => U a * V a)) (sum3 (fun a => pu a * pv a)) (3 + n + k) (1.04 * x + 9.2).
Proof.
  intros hu hv nk. cbv zeta. unfold sum3. set (x a := pu a * av a + au a * pv a + l * (au a * av a)). intros P A.
  pose proof (l_pos f) as l0. pose proof (omega_large f ok).
  assert (parts : forall a, 0 <= pu a /\ 0 <= pv a /\ 0 <= au a /\ 0 <= av a /\ 0 <= pu a * pv a /\ 0 <= x a).
  { intro a. destruct (hu a) as (y & _ & _ & s & a0). destruct (hv a) as (z & _ & _ & s' & a0').
    pose proof (Rabs_pos (U a)).
    pose proof (Rabs_pos (V a)). assert (0 <= pu a) by lra. assert (0 <= pv a) by lra. unfold x.
    repeat split; try assumption; repeat apply Rplus_le_le_0_compat; repeat apply Rmult_le_pos; assumption || lra. }
  change (x Expressions.X + x Expressions.Y + x Expressions.Z_ <= omega f / 4) in A.
  change (holds (value_of (dot_ u v)) (U Expressions.X * V Expressions.X + U Expressions.Y * V Expressions.Y + U
    Expressions.Z_ * V Expressions.Z_)
    (pu Expressions.X * pv Expressions.X + pu Expressions.Y * pv Expressions.Y + pu Expressions.Z_ * pv Expressions.Z_)
      (3 + n + k)
    (1.04 * (x Expressions.X + x Expressions.Y + x Expressions.Z_) + 9.2)).
  pose proof (parts Expressions.X) as (_ & _ & _ & _ & ? & ?). pose proof (parts Expressions.Y) as (_ & _ & _ & _ & ? &
    ?).
  pose proof (parts Expressions.Z_) as (_ & _ & _ & _ & ? & ?).
  assert (products : forall a, pu a * pv a <= omega f / 4 -> x a <= omega f ->
    operand (value_of (Product (component u a) (component v a))) (U a * V a) (pu a * pv a) (S (n + k)) (1.01 * x a +
      2)).
  { intros a small small'. pose proof (run (Product (component u a) (component v a))) as h. cbn in h.
    pose proof (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _ h (hu a) (hv a) ltac:(lia) small small') as r.
    apply (seen_operand f env) in r. apply (operand_weaker f env _ _ _ _ _ _ _ _ r); lra || lia || (unfold x; lra). }
  pose proof (products Expressions.X ltac:(lra) ltac:(lra)) as px. pose proof (products Expressions.Y ltac:(lra)
    ltac:(lra)) as py.
  pose proof (products Expressions.Z_ ltac:(lra) ltac:(lra)) as pz. cbn [component] in px, py, pz.
  pose proof (run (Sum (Product (vx u) (vx v)) (Product (vy u) (vy v)))) as h. cbn in h.
  pose proof (holds_sum f ok env Rplus _ _ _ _ _ _ _ _ _ _ _ (S (n + k)) ltac:(auto) h px py ltac:(lia) ltac:(lia)
    ltac:(lia) ltac:(lra) ltac:(lra)) as s.
  apply (seen_operand f env) in s. pose proof (run (dot_ u v)) as h'. unfold dot_ in *. cbn in h'.
  pose proof (holds_sum f ok env Rplus _ _ _ _ _ _ _ _ _ _ _ (S (S (n + k))) ltac:(auto) h' s pz ltac:(lia) ltac:(lia)
    ltac:(lia) ltac:(lra) ltac:(lra)) as r.
  apply (holds_weaker f _ _ _ _ _ _ _ _ r); [lra|lia|lra].
Qed.

(* The corner at a moment. *)
Section AtAMoment.
Variable n : nat.
Notation T := (seen (given (Moment n))).
Hypothesis in_step : 0 <= T <= 1.
Definition exactly_at pair a t := (1 - t) * exactly pair Expressions.Start a + t * exactly pair Expressions.End a.
Lemma rest_holds : holds (value_of (Minus one (Input (Moment n)))) (1 - T) (1 - T) 1 1.
Proof.
  pose proof (run (Minus one (Input (Moment n)))) as h. cbn in h. rewrite (run (Input (Moment n))) in h.
    unfold one in h.
  rewrite (constant (Small 1)) in h. cbn in h. rewrite seen_1 in h. pose proof (omega_large f ok).
    pose proof (error f ok env (1 - T)) as E.
  rewrite (Rabs_pos_eq (1 - T)) in E by lra.
  apply (result_holds f ok env _ _ _ _ _ _ h); [|lia|lra|lra]. split; [|rewrite Rabs_pos_eq; lra].
  unfold Bounds.q. replace ((1 + e1) ^ 1 - 1) with e1 by ring. lra.
Qed.
Lemma moment_operand : operand (value_of (Input (Moment n))) T T 0 0.
Proof. rewrite (run (Input (Moment n))). rewrite <- (Rabs_pos_eq T) at 2 by lra. apply operand_exact. Qed.
Lemma corner_holds pair a : In pair pairs ->
  holds (value_of (component (corner_at n pair) a)) (exactly_at pair a T) (p a) 4 (2.1 * p a + 10).
Proof.
  intro inside. pose proof (p_pos a). pose proof (p_small a). pose proof G_1. pose proof G_4. pose proof (l_pos f).
    pose proof (l_small f ok).
  unfold corner_at. rewrite component_each.
  set (s := component (at_start pair) a). set (e := component (at_end pair) a).
  pose proof (seen_operand f env _ _ _ _ _ (difference_holds pair Expressions.Start a inside)) as os.
    fold (at_start pair) s in os.
  pose proof (seen_operand f env _ _ _ _ _ (difference_holds pair Expressions.End a inside)) as oe.
    fold (at_end pair) e in oe.
  pose proof (run (Product s (Minus one (Input (Moment n))))) as h. cbn -[one] in h.
  assert (t0 : 0 <= p a * (1 - T) <= p a) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_r (p a)) at 2;
    apply Rmult_le_compat_l; lra).
  assert (t1 : 0 <= p a * T <= p a) by (split; [apply Rmult_le_pos; lra|]; rewrite <- (Rmult_1_r (p a)) at 2;
    apply Rmult_le_compat_l; lra).
  pose proof (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _ h os (seen_operand f env _ _ _ _ _ rest_holds) ltac:(lia)
    ltac:(lra) ltac:(lra)) as r0.
  pose proof (run (Product e (Input (Moment n)))) as h'. cbn in h'.
  pose proof (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _ h' oe moment_operand ltac:(lia) ltac:(lra) ltac:(lra)) as r1.
  apply (seen_operand f env) in r0. apply (seen_operand f env) in r1.
  pose proof (run (Sum (Product s (Minus one (Input (Moment n)))) (Product e (Input (Moment n))))) as h''.
    cbn -[one] in h''.
  pose proof (holds_sum f ok env Rplus _ _ _ _ _ _ _ _ _ _ _ 3 ltac:(auto) h'' r0 r1 ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra) ltac:(lra)) as r.
  destruct r as (x & X & rep & N). exists x. split; [exact X|]. split; [exact rep|].
  replace (exactly_at pair a T) with (exactly pair Expressions.Start a * (1 - T) + exactly pair Expressions.End a * T)
    by (unfold exactly_at; ring).
  apply (near_weaker f _ _ _ _ _ _ _ _ N); [lra|lia|lra].
Qed.
End AtAMoment.
End InRange.
End Corners.
