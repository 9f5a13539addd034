(* The meaning of the parts of the filter's decision: range, underflow, bounds, comparisons. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds.
Open Scope R_scope.

Class Distinguished (difference : Type) := difference_dec : forall c d : difference, {c = d} + {c <> d}.
#[global] Instance component_dec : Distinguished component.
Proof. intros c d. repeat decide equality. Defined.

(* Trees of maxima over magnitudes of differences. *)
Section Maxima.
Context {component : Type} {known : Distinguished component}.
Notation expr := (expr_of component).
Implicit Types e : expr.
Fixpoint maxima (e : expr) : bool := match e with
  | Larger a b => maxima a && maxima b
  | Magnitude (Difference _) => true
  | _ => false end.
Fixpoint occurs c (e : expr) : bool := match e with
  | Larger a b => occurs c a || occurs c b
  | Magnitude (Difference d) => if difference_dec c d then true else false
  | _ => false end.
End Maxima.

Section Culling.
Variable f : format.
Context {component : Type} {known : Distinguished component}.
Notation expr := (expr_of component).
Implicit Types e : expr.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.
Notation val := (val value_of).
Let l := lam f.
Let e1 := eps f.
Let L := power (largest_edge f).
Definition sigma := / 65536.

Lemma l0 : 0 < l. Proof. apply lam_pos. Qed.
Lemma l1 : l <= / 1152921504606846976. Proof. now apply lam_small. Qed.
Lemma e0 : 0 < e1. Proof. apply eps_pos. Qed.
Lemma e_le : e1 <= / 8388608. Proof. now apply eps_small. Qed.
Lemma L1 : 1 <= L.
Proof. unfold L, power. change 1 with (bpow radix2 0). apply bpow_le. destruct ok; lia. Qed.
Lemma L_reach : 4 * L = reach f. Proof. reflexivity. Qed.

Definition at_most v B := match v with Number x => x <= B | Infinite false => True | _ => False end.

Lemma difference_not_nan c : value_of (Difference c) <> NaN.
Proof.
  pose proof (run (Difference c)) as v. simpl in v.
  destruct (v _ _ eq_refl eq_refl) as (x & y & _ & _ & r & _ & [[_ ->]|[[_ [-> | ->]]|[_ [-> | ->]]]]); discriminate.
Qed.
Lemma counts_not_nan v w : v <> NaN -> counts f v w -> w <> NaN.
Proof. intros n [->|(x & _ & _ & ->)]; [assumption|discriminate]. Qed.
Lemma maxima_not_nan e : maxima e = true -> value_of e <> NaN.
Proof.
  induction e; intro h; try discriminate.
  - destruct e; try discriminate. pose proof (run (Magnitude (Difference c))) as v. simpl in v. rewrite v.
    pose proof (difference_not_nan c). now destruct (value_of (Difference c)).
  - simpl in h. apply andb_prop in h as [ha hb]. pose proof (run (Larger e2 e3)) as v. simpl in v.
    destruct (v (IHe1 ha) (IHe2 hb)) as (v' & w' & _ & _ & [[_ c]|[_ c]]);
      [exact (counts_not_nan _ _ (IHe1 ha) c)|exact (counts_not_nan _ _ (IHe2 hb) c)].
Qed.
Lemma counts_at_most v w B : l <= B -> counts f v w -> at_most w B -> at_most v B.
Proof.
  intros lB [->|(x & -> & small & ->)] h; [assumption|]. simpl. pose proof (Rle_abs x). fold l in small. lra.
Qed.
Lemma at_most_counts v w B : l <= B -> counts f v w -> at_most v B -> at_most w B.
Proof. pose proof l0. intros lB [->|(x & -> & small & ->)] h; [assumption|]. simpl. lra. Qed.
Lemma below_at_most v w B : below v w -> at_most w B -> at_most v B.
Proof. destruct v as [x|[|]|], w as [y|[|]|]; simpl; try tauto. lra. Qed.
Lemma larger_at_most v w out B : larger f v w out -> v <> NaN -> w <> NaN -> l <= B -> at_most out B -> at_most v B /\
  at_most w B.
Proof.
  intros h nv nw lB most. destruct (h nv nw) as (v' & w' & cv & cw & [[b c]|[b c]]).
  - assert (at_most v B) by (eapply counts_at_most; eauto). split; [assumption|].
    apply (counts_at_most _ _ _ lB cw), (below_at_most _ _ _ b), (at_most_counts _ _ _ lB cv). assumption.
  - assert (at_most w B) by (eapply counts_at_most; eauto). split; [|assumption].
    apply (counts_at_most _ _ _ lB cv), (below_at_most _ _ _ b), (at_most_counts _ _ _ lB cw). assumption.
Qed.
Lemma maxima_at_most e c B : maxima e = true -> occurs c e = true -> l <= B -> at_most (value_of e) B ->
  at_most (value_of (Magnitude (Difference c))) B.
Proof.
  induction e; intros h o lB most; try discriminate.
  - destruct e; try discriminate. simpl in o. destruct (difference_dec c c0) as [<-|]; [assumption|discriminate].
  - simpl in h, o. apply andb_prop in h as [ha hb]. pose proof (run (Larger e2 e3)) as v. simpl in v.
    destruct (larger_at_most _ _ _ _ v (maxima_not_nan _ ha) (maxima_not_nan _ hb) lB most).
    apply orb_prop in o as [o|o]; [apply IHe1|apply IHe2]; assumption.
Qed.

(* If the pair is in range, every difference is a number. *)
Theorem range_of e c : maxima e = true -> occurs c e = true -> greater f (value_of (Constant LargestEdge)) (value_of e)
  ->
  exists x, value_of (Difference c) = Number x /\ Rabs x <= L.
Proof.
  intros h there (v' & w' & cv & cw & b). pose proof L1. pose proof l1.
  pose proof (run (Constant LargestEdge)) as E. simpl in E. fold L in E. rewrite E in cv.
  assert (v' = Number L) as ->.
  { destruct cv as [->|(x & X & small & _)]; [reflexivity|]. injection X as <-.
    rewrite Rabs_pos_eq in small; fold l in small; lra. }
  assert (most : at_most (value_of e) L).
  { eapply counts_at_most; [lra|exact cw|]. destruct w' as [y|[|]|]; simpl in *; try tauto. lra. }
  pose proof (maxima_at_most e c L h there ltac:(lra) most) as m. pose proof (run (Magnitude (Difference c))) as v.
    simpl in v.
  rewrite v in m. destruct (value_of (Difference c)) as [x| |]; simpl in m; try contradiction. exists x. auto.
Qed.
Theorem range e : maxima e = true -> (forall c, occurs c e = true) -> greater f (value_of (Constant LargestEdge))
  (value_of e) ->
  forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Proof.
  intros h all in_range_ c. destruct (range_of e c h (all c) in_range_) as (x & E & small). exists x. split; [exact E|].
  pose proof L1. rewrite <- L_reach. lra.
Qed.

Definition exactly c := to c - from c.
Theorem off_of c x : value_of (Difference c) = Number x -> Rabs x <= reach f -> Rabs (exactly c - x) <= e1 * Rabs x + l
  * 3.
Proof.
  intros E small. pose proof (run (Difference c)) as v. simpl in v. destruct (v _ _ eq_refl eq_refl) as (y & z & cy & cz
    & r & rounded & cases).
  assert (rd : rounds f (y - z) x).
  { pose proof (omega_large f ok) as big. pose proof (L_ge_1 f ok) as one. simpl in big. rewrite Rmult_1_r in big.
    set (R_ := reach f) in *. assert (R_ * 1 <= R_ * (R_ * R_)) by (apply Rmult_le_compat_l; nra).
    assert (R_ < omega f) by (replace (IZR (Z.pow_pos 2 30)) with 1073741824 in big by reflexivity; lra).
    rewrite E in cases. destruct cases as [[_ X]|[[_ [X| X]]|[_ [X| X]]]]; try discriminate; injection X as ->.
    - exact rounded.
    - pose proof (Rle_abs (omega f)). lra.
    - rewrite Rabs_Ropp in small. pose proof (Rle_abs (omega f)). lra. }
  pose proof (rounding_error_by_result f ok _ _ rd) as B. apply counts_error in cy. apply counts_error in cz.
    fold l e1 in B. fold l in cy, cz.
  unfold exactly. replace (to c - from c - x) with ((z - from c) + (- (y - to c) + - (x - (y - z)))) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. eapply Rle_trans; [apply Rplus_le_compat_l, Rabs_triang|].
    rewrite !Rabs_Ropp. lra.
Qed.

Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation d := (computed value_of).

Lemma number e : fits e = true -> value_of e = Number (val e).
Proof. intro h. exact (is_number f ok from to value_of run in_range e h). Qed.
Lemma d_value c : value_of (Difference c) = Number (d c).
Proof. unfold computed, Errors.val. destruct (in_range c) as (x & -> & _). reflexivity. Qed.

Theorem off c : Rabs (exactly c - d c) <= e1 * Rabs (d c) + l * 3.
Proof. destruct (in_range c) as (x & E & small). unfold computed, Errors.val. rewrite E. now apply off_of. Qed.

(* The largest magnitudes, as numbers. *)
Lemma maxima_pos e : maxima e = true -> fits e = true -> 0 <= val e.
Proof.
  induction e; intros h fit; try discriminate.
  - destruct e; try discriminate. unfold Errors.val. pose proof (run (Magnitude (Difference c))) as v. simpl in v.
    rewrite v, d_value.
    apply Rabs_pos.
  - simpl in h. apply andb_prop in h as [ha hb]. destruct (fits_parts e2 e3 (Larger e2 e3) ltac:(auto) fit) as [fa fb].
    specialize (IHe1 ha fa). specialize (IHe2 hb fb).
    pose proof (run (Larger e2 e3)) as v. simpl in v. rewrite (number _ fa), (number _ fb) in v.
    destruct v as (v' & w' & _ & _ & [[_ c]|[_ c]]); try discriminate; unfold Errors.val at 1;
      destruct (counts_val f _ _ _ eq_refl c) as (x & -> & [-> |[_ ->]]); lra.
Qed.
Lemma maxima_bound e c : maxima e = true -> fits e = true -> occurs c e = true -> Rabs (d c) <= Rmax (val e) l.
Proof.
  intros h fit o. assert (most : at_most (value_of e) (Rmax (val e) l)) by (rewrite (number e fit); apply Rmax_l).
  pose proof (maxima_at_most e c _ h o (Rmax_r _ _) most) as m. pose proof (run (Magnitude (Difference c))) as v.
    simpl in v.
  rewrite v, d_value in m. exact m.
Qed.

(* A lower bound of the result of a step: operands that are not subnormal count unchanged. *)
Lemma unflushed x x' : l <= x -> counts_as f x x' -> x' = x.
Proof. pose proof l0. intros big [->|[small ->]]; [reflexivity|]. fold l in small. rewrite Rabs_pos_eq in small; lra.
  Qed.
Lemma rounds_below z r : rounds f z r -> 0 <= z -> (1 - e1) * z - l <= r.
Proof.
  intros R_ pos. pose proof (rounding_error f ok _ _ R_) as E. rewrite (Rabs_pos_eq z pos) in E.
  apply Rabs_le_inv in E. fold e1 l in E. lra.
Qed.
Lemma step_of e : fits e = true -> Errors.node f value_of e.
Proof. intro h. destruct (sizes f ok from to value_of run in_range e h) as (_ & _ & _ & n). exact n. Qed.
End Culling.
