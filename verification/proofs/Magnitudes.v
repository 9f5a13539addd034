(* The decision of the certified filter by three magnitudes, its first alternative, proves that exact control values
   have one sign. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Filter Permanent.
Open Scope R_scope.
Implicit Types e : expr.

Section Leaves.
Variables leaf leaf' : component -> R.
Hypothesis smaller : forall c, Rabs (leaf c) <= Rabs (leaf' c).
Lemma permanent_monotone e : permanent leaf e <= permanent leaf' e.
Proof.
  induction e; cbn [permanent]; try apply smaller; try lra.
  apply Rmult_le_compat; auto using permanent_pos.
Qed.
End Leaves.

Section Magnitudes.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> Expressions.value.
Hypothesis run : execution f from to value_of.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation val := (val value_of).
Notation d := (computed value_of).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).
(* M, the largest of all, is made of the three magnitudes x, y, z. *)
Variable M : expr.
Hypothesis M_maxima : maxima M = true.
Hypothesis M_all : forall c, occurs c M = true.
Hypothesis M_fits : fits M = true.
Notation m := (m value_of M).
Notation margin := (margin M).
Let m_1 : 1 <= m := m1 f ok from to value_of run in_range M M_maxima M_fits.
Let number e : fits e = true -> value_of e = Number (val e) := number f ok from to value_of run in_range e.
Let step_of e : fits e = true -> node f value_of e := step_of f ok from to value_of run in_range e.
Let pos e : maxima e = true -> fits e = true -> 0 <= val e := maxima_pos f ok from to value_of run in_range e.

Lemma part_of_larger a b : maxima (Larger a b) = true -> fits (Larger a b) = true ->
  val a <= Rmax (val (Larger a b)) l /\ val b <= Rmax (val (Larger a b)) l.
Proof.
  intros mx fit. destruct (fits_parts a b _ ltac:(auto) fit) as [fa fb]. pose proof (run (Larger a b)) as v. simpl in v.
  destruct (larger_at_most f _ _ _ (Rmax (val (Larger a b)) l) v) as [A B]; rewrite ?(number _ fa), ?(number _ fb);
    try discriminate.
  - apply Rmax_r.
  - rewrite (number _ fit). simpl. apply Rmax_l.
  - rewrite (number _ fa) in A. rewrite (number _ fb) in B. auto.
Qed.
Lemma below_m v : v <= Rmax (val M) l -> v <= m.
Proof.
  intro h. eapply Rle_trans; [exact h|]. pose proof (l1 f ok). pose proof (pos M M_maxima M_fits). unfold Decisions.m.
    apply Rmax_lub; lra.
Qed.

Variables x y z : expr.
Hypothesis whole : M = Larger (Larger x y) z.
Definition three := Product (Product x y) z.
Definition outer := Sum (roundoffs 96 three) margin.
Definition inner := Product outer (Constant (Small 4)).
Hypothesis fi : fits inner = true.
Let fo : fits outer = true. Proof. exact (proj1 (fits_product _ _ fi)). Qed.
Let t := val x * val y * val z.
Lemma all_maxima : maxima x = true /\ maxima y = true /\ maxima z = true /\ maxima (Larger x y) = true.
Proof.
  pose proof M_maxima as h. rewrite whole in h. cbn [maxima] in h. apply andb_prop in h as [h hz]. pose proof h as xy.
  apply andb_prop in h as [hx hy]. auto.
Qed.
Lemma all_fit : fits x = true /\ fits y = true /\ fits z = true /\ fits (Larger x y) = true.
Proof.
  pose proof M_fits as h. rewrite whole in h. destruct (fits_parts (Larger x y) z _ ltac:(auto) h) as [hxy hz].
  destruct (fits_parts x y _ ltac:(auto) hxy). auto.
Qed.
Lemma all_below : (0 <= val x <= m) /\ (0 <= val y <= m) /\ (0 <= val z <= m).
Proof.
  destruct all_maxima as (mx & my & mz & mxy). destruct all_fit as (fx & fy & fz & fxy). pose proof M_maxima as mM.
    pose proof M_fits as fM.
  rewrite whole in mM, fM. pose proof (part_of_larger _ _ mM fM) as [A B]. pose proof (part_of_larger _ _ mxy fxy) as [C
    D].
  rewrite <- whole in A, B. assert (X : Rmax (val (Larger x y)) l <= Rmax (val M) l) by (apply Rmax_lub;
    [assumption|apply Rmax_r]).
  repeat split; try (apply pos; assumption); apply below_m; try assumption; eapply Rle_trans; eassumption.
Qed.
Lemma t_pos : 0 <= t.
Proof. destruct all_below as ([? ?] & [? ?] & [? ?]). unfold t. repeat apply Rmult_le_pos; assumption. Qed.
Lemma counts_pos' a a' : 0 <= a -> counts_as f a a' -> 0 <= a' /\ (a' = a \/ (a < l /\ a' = 0)).
Proof. intros p [->|[s ->]]; [auto|]. rewrite Rabs_pos_eq in s by assumption. split; [lra|auto]. Qed.
Lemma m2_facts : m * m = m ^ 2 /\ 1 <= m ^ 2 /\ l * m <= l * m ^ 2 /\ l <= l * m ^ 2.
Proof.
  pose proof (lam_pos f). assert (m * m = m ^ 2) by ring. assert (m <= m ^ 2) by (rewrite <- H0; nra).
  repeat split; try assumption; try lra; [apply Rmult_le_compat_l; lra|]. rewrite <- (Rmult_1_r l) at 1.
    apply Rmult_le_compat_l; lra.
Qed.
Lemma three_large : (1 - sigma) * t - 400 * l * m ^ 2 <= val three.
Proof.
  destruct (fits_sum _ _ fo) as [fr _]. destruct (fits_product _ _ fr) as [_ ft].
    destruct (fits_product _ _ ft) as [fxy _].
  destruct (step_of _ fxy) as (a & b & ca & cb & r1). destruct (step_of _ ft) as (c & e & cc & ce & r2).
  destruct all_below as ([X0 x_m] & [Y0 y_m] & [Z0 z_m]).
  pose proof (lam_pos f). pose proof (l1 f ok). pose proof (eps_pos f). pose proof (e_le f ok).
  apply (counts_pos' _ _ X0) in ca as [a0 ca]. apply (counts_pos' _ _ Y0) in cb as [b0 cb].
    apply (counts_pos' _ _ Z0) in ce as [e0 ce].
  destruct m2_facts as (mm & m2 & lm & lN). set (N := l * m ^ 2) in *.
  assert (ab : val x * val y - l * m <= a * b).
  { destruct ca as [->|[? ->]], cb as [->|[? ->]].
    - nra.
    - assert (val x * val y <= m * l) by (apply Rmult_le_compat; lra). lra.
    - assert (val x * val y <= l * m) by (apply Rmult_le_compat; lra). lra.
    - assert (val x * val y <= l * m) by (apply Rmult_le_compat; lra). lra. }
  assert (ab0 : 0 <= a * b) by (now apply Rmult_le_pos). assert (xy0 : 0 <= val x * val y) by (now apply Rmult_le_pos).
  pose proof (rounds_below f ok _ _ r1 ab0) as low1. set (w := val (Product x y)) in *.
  assert (l <= l * m) by nra.
  assert (ww : (1 - / 8388608) * (val x * val y) - 2 * (l * m) <= w).
  { assert (e1 * (a * b) <= / 8388608 * (a * b)) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (counts_error _ _ _ cc) as ec. apply Rabs_le_inv in ec.
  assert (cl : (1 - / 8388608) * (val x * val y) - 3 * (l * m) <= c) by lra.
  assert (xyz0 : 0 <= val x * val y * val z) by (now apply Rmult_le_pos).
  assert (xym : val x * val y <= m ^ 2) by (rewrite <- mm; apply Rmult_le_compat; lra).
  assert (em : e <= m) by (destruct ce as [->|[? ->]]; lra).
  assert (zz : (1 - / 8388608) * t - 4 * N <= c * e).
  { assert (A : ((1 - / 8388608) * (val x * val y) - 3 * (l * m)) * e <= c * e) by (apply Rmult_le_compat_r;
    assumption).
    assert (B : l * m * e <= N). { unfold N. rewrite <- mm, <- Rmult_assoc. apply Rmult_le_compat_l; [nra|assumption]. }
    assert (C : val x * val y * val z - N <= val x * val y * e).
    { destruct ce as [->|[? ->]]; [lra|]. assert (val x * val y * val z <= m ^ 2 * l) by (apply Rmult_le_compat; lra).
      unfold N. lra. }
    unfold t. lra. }
  pose proof (rounding_error f ok _ _ r2) as E. apply Rabs_le_inv in E. fold three in E.
  pose proof t_pos as t0. replace (400 * l * m ^ 2) with (400 * N) by (unfold N; ring).
  destruct (Rle_lt_dec 0 (c * e)) as [p|n].
  - rewrite (Rabs_pos_eq _ p) in E. assert (e1 * (c * e) <= / 8388608 * (c * e)) by (apply Rmult_le_compat_r; lra).
    unfold sigma. lra.
  - rewrite Rabs_left in E by assumption. assert (e1 * - (c * e) <= / 8388608 * - (c * e)) by (apply Rmult_le_compat_r;
    lra).
    unfold sigma. lra.
Qed.
Lemma outer_large : (1 - 3 * sigma) * (96 * u) * t + 500 * l * m ^ 2 <= val outer.
Proof.
  apply (bound_large f ok from to value_of run in_range M M_maxima M_fits 96 three t fo ltac:(lia) t_pos three_large).
Qed.
Lemma ut_pos : 0 <= u * t.
Proof. pose proof (u_pos f). apply Rmult_le_pos; [lra|apply t_pos]. Qed.
Lemma inner_large : (1 - 4 * sigma) * (384 * u) * t + 1900 * l * m ^ 2 <= val inner.
Proof.
  pose proof outer_large as O. destruct (step_of _ fi) as (a & b & ca & cb & r).
    rewrite (constant f from to value_of run) in cb.
  cbn [constant_value] in cb. pose proof (lam_pos f). pose proof (l1 f ok). pose proof (eps_pos f).
    pose proof (e_le f ok).
  destruct m2_facts as (mm & m2 & lm & lN). pose proof ut_pos.
  apply (unflushed f) in cb; [|lra]. apply (unflushed f) in ca; [|unfold sigma in O; lra]. subst a b.
  assert (0 <= val outer * 4) by (unfold sigma in O; lra).
  pose proof (rounds_below f ok _ _ r ltac:(assumption)) as low. fold inner in low.
  assert (e1 * (val outer * 4) <= / 8388608 * (val outer * 4)) by (apply Rmult_le_compat_r; assumption).
  unfold sigma in *. lra.
Qed.
(* A number minus itself, which only flushing can keep from being zero, does not make it much smaller. *)
Lemma inner_with_zero_large v : fits (Sum inner (Minus v v)) = true ->
  (1 - 4 * sigma) * (380 * u) * t + 1800 * l * m ^ 2 <= val (Sum inner (Minus v v)).
Proof.
  intro fit. destruct (fits_sum _ _ fit) as [_ fz]. destruct (fits_parts v v (Minus v v) ltac:(auto) fz) as [fv _].
  destruct (step_of _ fz) as (a & b & ca & cb & r1). destruct (step_of _ fit) as (c & e & cc & ce & r2).
  pose proof inner_large as I. pose proof (lam_pos f). pose proof (l1 f ok). pose proof (eps_pos f).
    pose proof (e_le f ok).
  destruct m2_facts as (mm & m2 & lm & lN). pose proof ut_pos.
  assert (small : Rabs (a - b) <= l).
  { destruct ca as [->|[? ->]], cb as [->|[? ->]]; rewrite ?Rminus_diag_eq, ?Rminus_0_r, ?Rminus_0_l, ?Rabs_R0,
    ?Rabs_Ropp by reflexivity; lra. }
  pose proof (rounding_error f ok _ _ r1) as E1. assert (e1 * Rabs (a - b) <= 1 * Rabs (a - b)) by (apply
    Rmult_le_compat_r; [apply Rabs_pos|lra]).
  pose proof (counts_error _ _ _ ce) as E2. apply Rabs_le_inv in E1. apply Rabs_le_inv in E2.
    apply Rabs_le_inv in small as small'.
  apply (unflushed f) in cc; [|unfold sigma in I; lra]. subst c.
  assert (0 <= val inner + e) by (unfold sigma in I; lra).
  pose proof (rounds_below f ok _ _ r2 ltac:(assumption)) as low.
  assert (e1 * (val inner + e) <= / 8388608 * (val inner + e)) by (apply Rmult_le_compat_r; assumption).
  unfold sigma in *. lra.
Qed.

(* The product of the magnitudes, those that are subnormal raised to l. *)
Definition raised v := Rmax (val v) l.
Lemma raised_product : raised x * raised y * raised z <= t + l * m ^ 2.
Proof.
  destruct all_below as ([X0 x_m] & [Y0 y_m] & [Z0 z_m]). pose proof (lam_pos f). pose proof (l1 f ok).
  assert (R_ : forall v, 0 <= val v -> val v <= m -> 0 <= raised v <= m).
  { intros v ? ?. unfold raised. split; [eapply Rle_trans; [|apply Rmax_r]; lra|apply Rmax_lub; lra]. }
  destruct (R_ _ X0 x_m) as [xa xb]. destruct (R_ _ Y0 y_m) as [ya yb]. destruct (R_ _ Z0 z_m) as [za zb].
    unfold raised in *.
  pose proof t_pos as t0. replace (l * m ^ 2) with (l * m * m) by ring.
  assert (S : forall p q r, 0 <= p <= l -> 0 <= q <= m -> 0 <= r <= m -> p * q * r <= l * m * m).
  { intros p q_ r ? ? ?. apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; lra. }
  destruct (Rle_lt_dec l (val x)) as [hx|hx]; [|rewrite (Rmax_right (val x)) in * by lra;
    assert (l * Rmax (val y) l * Rmax (val z) l <= l * m * m) by (apply S; lra); lra].
  destruct (Rle_lt_dec l (val y)) as [hy|hy].
  2: { rewrite (Rmax_right (val y)) in * by lra. replace (Rmax (val x) l * l * Rmax (val z) l) with (l * Rmax (val x) l
    * Rmax (val z) l) by ring.
    assert (l * Rmax (val x) l * Rmax (val z) l <= l * m * m) by (apply S; lra). lra. }
  destruct (Rle_lt_dec l (val z)) as [hz|hz].
  2: { rewrite (Rmax_right (val z)) in * by lra. replace (Rmax (val x) l * Rmax (val y) l * l) with (l * Rmax (val x) l
    * Rmax (val y) l) by ring.
    assert (l * Rmax (val x) l * Rmax (val y) l <= l * m * m) by (apply S; lra). lra. }
  rewrite !Rmax_left by assumption. assert (0 <= l * m * m) by nra. unfold t. lra.
Qed.

(* The bound, one of three, that applies to a difference, and the number of monomials of a control value. *)
Inductive which := First | Second | Third.
Variable part : component -> which.
Definition of_which w := match w with First => x | Second => y | Third => z end.
Hypothesis occurs_there : forall c, occurs c (of_which (part c)) = true.
Section Sizes.
Variables X_ Y_ Z_ : R.
Definition size_of w := match w with First => X_ | Second => Y_ | Third => Z_ end.
Definition count_is e n := (0 <= X_ -> 0 <= Y_ -> 0 <= Z_ -> permanent (fun c => size_of (part c)) e = n * (X_ * Y_ *
  Z_)).
End Sizes.
Lemma raised_pos v : 0 <= raised v. Proof. unfold raised. eapply Rle_trans; [|apply Rmax_r]. pose proof (lam_pos f).
  lra. Qed.
Lemma permanent_by_magnitudes e n : 0 <= n -> (forall X_ Y_ Z_, count_is X_ Y_ Z_ e n) -> permanent d e <= n * (t + l *
  m ^ 2).
Proof.
  intros n0 count. destruct all_maxima as (mx & my & mz & _). destruct all_fit as (fx & fy & fz & _).
  specialize (count (raised x) (raised y) (raised z) (raised_pos _) (raised_pos _) (raised_pos _)).
  eapply Rle_trans; [apply (permanent_monotone _ (fun c => size_of (raised x) (raised y) (raised z) (part c)))|].
  - intro c. assert (B : Rabs (d c) <= raised (of_which (part c))).
    { apply (maxima_bound f ok from to value_of run in_range); [| |apply occurs_there]; now destruct (part c). }
    eapply Rle_trans; [exact B|]. destruct (part c); apply Rle_abs.
  - rewrite count. apply Rmult_le_compat_l; [assumption|apply raised_product].
Qed.

Theorem by_three a b n count bound : fine a b n = true -> representable f bound ->
  (forall X_ Y_ Z_, count_is X_ Y_ Z_ (Sum a b) count) ->
  (n = 4%nat /\ count = 6 /\ (1 - 4 * sigma) * (95 * u) * t + 499 * l * m ^ 2 <= bound) \/
  (n = 6%nat /\ count = 18 /\ (1 - 4 * sigma) * (380 * u) * t + 499 * l * m ^ 2 <= bound) ->
  proves f from to value_of (Sum a b) bound /\ is_near f from to value_of (Sum a b) bound.
Proof.
  intros h rep counted bounds.
  assert (P : permanent d (Sum a b) <= count * (t + l * m ^ 2)) by (apply permanent_by_magnitudes;
    [destruct bounds as [(_ & -> & _)|(_ & -> & _)]; lra|assumption]).
  pose proof (permanent_pos d (Sum a b)) as P0. pose proof ut_pos. pose proof (lam_pos f). pose proof t_pos.
    destruct m2_facts as (mm & m2 & lm & lN).
  pose proof (u_small f ok). pose proof (u_pos f). set (N := l * m ^ 2) in *.
    replace (499 * l * m ^ 2) with (499 * N) in bounds by (unfold N; ring).
  assert (uN : u * N <= / 16777216 * N) by (apply Rmult_le_compat_r; lra).
  assert (big : l <= bound) by (destruct bounds as [(_ & _ & B)|(_ & _ & B)]; unfold sigma in B; lra).
  apply (sign' f ok from to value_of run in_range M M_maxima M_all M_fits a b bound n h rep big). fold N.
  destruct bounds as [(-> & -> & B)|(-> & -> & B)].
  - pose proof (coefficient4 f ok) as C. assert (C0 : (q f 4 + q f 3 - 2) * permanent d (Sum a b) <= (15 * u) *
    permanent d (Sum a b)).
    { apply Rmult_le_compat_r; [assumption|]. unfold sigma in C. lra. }
    assert (u * permanent d (Sum a b) <= u * (6 * (t + N))) by (apply Rmult_le_compat_l; lra). unfold sigma in *. lra.
  - pose proof (coefficient6 f ok) as C. assert (C0 : (q f 6 + q f 3 - 2) * permanent d (Sum a b) <= (19 * u) *
    permanent d (Sum a b)).
    { apply Rmult_le_compat_r; [assumption|]. unfold sigma in C. lra. }
    assert (u * permanent d (Sum a b) <= u * (18 * (t + N))) by (apply Rmult_le_compat_l; lra). unfold sigma in *. lra.
Qed.
Lemma outer_enough : (1 - 4 * sigma) * (95 * u) * t + 499 * l * m ^ 2 <= val outer.
Proof. pose proof outer_large. pose proof ut_pos. destruct m2_facts as (_ & _ & _ & ?). unfold sigma in *.
  pose proof (lam_pos f). lra. Qed.
Lemma inner_enough : (1 - 4 * sigma) * (380 * u) * t + 499 * l * m ^ 2 <= val inner.
Proof. pose proof inner_large. pose proof ut_pos. destruct m2_facts as (_ & _ & _ & ?). unfold sigma in *.
  pose proof (lam_pos f). lra. Qed.
Lemma one_enough v : fits (Sum inner (Minus v v)) = true ->
  (1 - 4 * sigma) * (380 * u) * t + 499 * l * m ^ 2 <= val (Sum inner (Minus v v)).
Proof. intro fit. pose proof (inner_with_zero_large v fit). pose proof (lam_pos f).
  destruct m2_facts as (_ & _ & _ & ?). lra. Qed.
Lemma one_enough_outside v : fits (Sum inner (Minus v v)) = true ->
  (1 - 4 * sigma) * (95 * u) * t + 499 * l * m ^ 2 <= val (Sum inner (Minus v v)).
Proof. intro fit. pose proof (one_enough v fit). pose proof ut_pos. unfold sigma in *. lra. Qed.
Lemma outer_representable : representable f (val outer). Proof. now apply (representable_sum f ok from to value_of run
  in_range). Qed.
Lemma inner_representable : representable f (val inner). Proof. now apply (representable_product f ok from to value_of
  run in_range). Qed.
End Magnitudes.

(* The bounds in the code. *)
Definition part_by_axis c := match c with Component _ _ X => First | Component _ _ Y => Second | Component _ _ Z_ =>
  Third end.
(* The largest along an axis of all differences. *)
Definition by_axis := Larger (Larger s121 s129) s138.
Definition inner_by_axis := inner by_axis s121 s129 s138.
(* The decision of the permanent's tier if no lane needs the permanent; this is its first alternative. *)
Definition least := Smaller (Smaller control_value_0 control_value_1) (Smaller control_value_2 control_value_3).
Definition greatest := Larger (Larger control_value_0 control_value_1) (Larger control_value_2 control_value_3).
Definition sum_of_all := Sum (Sum control_value_0 control_value_1) (Sum control_value_2 control_value_3).
Definition first_part := Both (Greater (Larger least (Negative greatest)) (Sum inner_by_axis (Minus sum_of_all
  sum_of_all)))
  (Greater (Constant LargestEdge) by_axis).
Theorem the_code_decides_alone_so : culled_by_permanent_alone = first_part.
Proof. reflexivity. Qed.
Theorem the_code_decides_by_permanent_so : culled_by_permanent = Either first_part last_part.
Proof. reflexivity. Qed.

Section OfTheCode.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> Expressions.value.
Hypothesis run : execution f from to value_of.
Notation val := (val value_of).
Definition shows k bound := proves f from to value_of k bound /\ is_near f from to value_of k bound.
Notation l := (lam f).
Definition exactly_one_sign := let e := exact (exactly from to) in
  (0 < e control_value_0 /\ 0 < e control_value_1 /\ 0 < e control_value_2 /\ 0 < e control_value_3) \/
  (e control_value_0 < 0 /\ e control_value_1 < 0 /\ e control_value_2 < 0 /\ e control_value_3 < 0).

Lemma all_occur_by_axis c : occurs c by_axis = true.
Proof. destruct c as [[| |] [|] [| |]]; vm_compute; reflexivity. Qed.
Lemma occurs_by_axis c : occurs c (of_which s121 s129 s138 (part_by_axis c)) = true.
Proof. destruct c as [[| |] [|] [| |]]; vm_compute; reflexivity. Qed.
Ltac count := intros X_ Y_ Z_ ? ? ?; cbv -[Rplus Rminus Rmult Ropp Rabs IZR]; rewrite !Rabs_pos_eq by assumption; ring.
Lemma counts_by_axis X_ Y_ Z_ :
  count_is part_by_axis X_ Y_ Z_ control_value_0 6 /\ count_is part_by_axis X_ Y_ Z_ control_value_1 18 /\
  count_is part_by_axis X_ Y_ Z_ control_value_2 18 /\ count_is part_by_axis X_ Y_ Z_ control_value_3 6.
Proof. revert X_ Y_ Z_. intros X_ Y_ Z_. repeat split; revert X_ Y_ Z_; count. Qed.

Section InRange.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Ltac three_by M all part occ counts x y z k n which_count :=
  apply (by_three f ok from to value_of run in_range M eq_refl all eq_refl x y z eq_refl part occ (first_of k)
    (second_of k) n which_count);
  [vm_compute; reflexivity | | intros; apply counts | ].
Ltac axis k n c := three_by by_axis all_occur_by_axis part_by_axis occurs_by_axis counts_by_axis s121 s129 s138 k n c.

Definition one_bound := Sum inner_by_axis (Minus sum_of_all sum_of_all).
Lemma proven_by_one : shows control_value_0 (val one_bound) /\ shows control_value_1 (val one_bound) /\
  shows control_value_2 (val one_bound) /\ shows control_value_3 (val one_bound).
Proof.
  split; [|split; [|split]]; [axis control_value_0 4%nat 6|axis control_value_1 6%nat 18|axis control_value_2 6%nat
    18|axis control_value_3 4%nat 6].
  all: try (apply (representable_sum f ok from to value_of run in_range); reflexivity).
  1, 4: left; repeat split; apply (one_enough_outside f ok from to value_of run in_range); reflexivity.
  all: right; repeat split; apply (one_enough f ok from to value_of run in_range); reflexivity.
Qed.

Notation number := (Culling.number f ok from to value_of run in_range).
Lemma larger_is_one a b B : fits (Larger a b) = true -> l <= B -> B < val (Larger a b) -> B < val a \/ B < val b.
Proof.
  intros fit big h. destruct (fits_parts a b _ ltac:(auto) fit) as [fa fb]. pose proof (run (Larger a b)) as v.
    simpl in v.
  rewrite (number _ fit), (number _ fa), (number _ fb) in v. pose proof (lam_pos f).
  destruct v as (v & w & cv & cw & which_); try discriminate.
  destruct which_ as [[_ c]|[_ c]].
  - left. destruct (counts_val f _ _ _ eq_refl cv) as (p & -> & cp). destruct (counts_val f _ _ _ eq_refl c) as (r & E &
    cr).
    injection E as <-. destruct cp as [cp|[_ cp]], cr as [cr|[_ cr]]; lra.
  - right. destruct (counts_val f _ _ _ eq_refl cw) as (p & -> & cp). destruct (counts_val f _ _ _ eq_refl c) as (r & E
    & cr).
    injection E as <-. destruct cp as [cp|[_ cp]], cr as [cr|[_ cr]]; lra.
Qed.
Lemma negative_val a : fits a = true -> val (Negative a) = - val a.
Proof. intro h. unfold Errors.val at 1. pose proof (run (Negative a)) as n. simpl in n. rewrite n, (number _ h).
  reflexivity. Qed.
Lemma one_proves : greater f (value_of (Larger least (Negative greatest))) (value_of one_bound) -> exactly_one_sign.
Proof.
  rewrite (number (Larger least (Negative greatest)) eq_refl), (number one_bound eq_refl). intro g.
  destruct proven_by_one as (((big & u0 & d0) & _) & ((_ & u1 & d1) & _) & ((_ & u2 & d2) & _) & ((_ & u3 & d3) & _)).
  apply (greater_above f _ _) in g; [|assumption].
  destruct (larger_is_one least (Negative greatest) _ eq_refl big g) as [A|A]; [left|right]; cbv zeta.
  - pose proof (smaller_both f ok from to value_of run in_range) as S.
    destruct (S (Smaller control_value_0 control_value_1) (Smaller control_value_2 control_value_3) eq_refl ltac:(change
      (Smaller _ _) with least; lra)) as [a b]. change (Smaller (Smaller _ _) _) with least in a, b.
    destruct (S control_value_0 control_value_1 eq_refl ltac:(lra)) as [k0_ k1_].
    destruct (S control_value_2 control_value_3 eq_refl ltac:(lra)) as [k2_ k3_].
    repeat apply conj; [apply u0|apply u1|apply u2|apply u3]; lra.
  - rewrite (negative_val greatest eq_refl) in A. pose proof (larger_both f ok from to value_of run in_range) as S.
    destruct (S (Larger control_value_0 control_value_1) (Larger control_value_2 control_value_3) eq_refl ltac:(change
      (Larger _ _) with greatest; lra)) as [a b]. change (Larger (Larger _ _) _) with greatest in a, b.
    destruct (S control_value_0 control_value_1 eq_refl ltac:(lra)) as [k0_ k1_].
    destruct (S control_value_2 control_value_3 eq_refl ltac:(lra)) as [k2_ k3_].
    repeat apply conj; [apply d0|apply d1|apply d2|apply d3]; lra.
Qed.
End InRange.

(* The decision proves one sign. *)
Theorem alone_proves_one_sign : says f value_of culled_by_permanent_alone -> exactly_one_sign.
Proof.
  rewrite the_code_decides_alone_so. intros [signs small].
  assert (in_range := range f ok from to value_of run by_axis eq_refl all_occur_by_axis small).
  exact (one_proves in_range signs).
Qed.
Theorem by_permanent_proves_one_sign : says f value_of culled_by_permanent -> exactly_one_sign.
Proof.
  rewrite the_code_decides_by_permanent_so. intros [alone|last].
  - apply alone_proves_one_sign. now rewrite the_code_decides_alone_so.
  - exact (the_last_part_proves_one_sign f ok from to value_of run last).
Qed.
End OfTheCode.
