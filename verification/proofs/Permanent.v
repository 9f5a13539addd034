(* The decision of the certified filter by the permanent, in the code's terms, proves that exact control values have one
   sign. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Filter.
Open Scope R_scope.
Implicit Types a b e : expr.

Section Proof.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.
Notation val := (val value_of).
Notation d := (computed value_of).
Notation D := (exactly from to).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).

Definition proves (k : expr) bound := l <= bound /\ (bound < val k -> 0 < exact D k) /\
  (val k < - bound -> exact D k < 0).
(* And some of the bound is left over, for what is computed from the value. *)
Definition is_near (k : expr) bound := 490 * l <= bound /\ exists z, rounds f z (val k) /\
  Rabs (z - exact D k) <= 0.985 * bound.

Section InRange.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Variable M : expr.
Hypothesis M_maxima : maxima M = true.
Hypothesis M_all : forall c, occurs c M = true.
Hypothesis M_fits : fits M = true.
Notation m := (m value_of M).
Notation margin := (margin M).
Let m_1 : 1 <= m := m1 f ok from to value_of run in_range M M_maxima M_fits.
Let number e : fits e = true -> value_of e = Number (val e) := number f ok from to value_of run in_range e.
Let step_of e : fits e = true -> node f value_of e := step_of f ok from to value_of run in_range e.
Let small c : Rabs (d c) <= m := d_m f ok from to value_of run in_range M M_maxima M_all M_fits c.

Definition fine a b n := (polynomial (Sum a b) && signed (Sum a b) && fits (Sum a b) && (degree (Sum a b) =? 3)%nat
  && (depth a <=? n)%nat && (depth b <=? n)%nat && (losses a b <=? 490)%Z)%bool.
Lemma sign' a b bound n : fine a b n = true -> representable f bound -> l <= bound ->
  (q f n + q f 3 - 2) * permanent d (Sum a b) + 490 * (l * m ^ 2) <= 0.985 * bound -> proves (Sum a b) bound /\
    is_near (Sum a b) bound.
Proof.
  unfold fine. intros h rep big enough.
  apply andb_prop in h as [h lo]. apply andb_prop in h as [h db]. apply andb_prop in h as [h da].
  apply andb_prop in h as [h dg]. apply andb_prop in h as [h fi]. apply andb_prop in h as [po si].
  apply Z.leb_le in lo. apply Nat.leb_le in da. apply Nat.leb_le in db. apply Nat.eqb_eq in dg.
  pose proof (lam_pos f). assert (1 <= m ^ 2) by (simpl; nra).
  destruct (near f ok from to value_of run in_range M M_maxima M_all M_fits a b n) as (z & rounded & close); auto.
  assert (IZR (losses a b) <= 490) by (now apply IZR_le).
  assert (l * m ^ 2 * IZR (losses a b) <= l * m ^ 2 * 490) by (apply Rmult_le_compat_l; [apply Rmult_le_pos;
    lra|assumption]).
  assert (l * 1 <= l * m ^ 2) by (apply Rmult_le_compat_l; lra).
  assert (0 <= (q f n + q f 3 - 2) * permanent d (Sum a b)).
  { apply Rmult_le_pos; [pose proof (q_ge f n); pose proof (q_ge f 3); lra|apply permanent_pos]. }
  split; [split; [exact big|]|split; [lra|exists z; split; [exact rounded|lra]]]. apply (sign_of f ok z _ _ bound
    rounded);
    [lra|exact rep].
Qed.

Lemma coefficient4 : q f 4 + q f 3 - 2 <= (1 - 4 * sigma) * (15 * u).
Proof. pose proof (q3 f ok). pose proof (q4 f ok). pose proof (eps_twice f). pose proof (eps_pos f). unfold sigma. lra.
  Qed.
Lemma coefficient6 : q f 6 + q f 3 - 2 <= (1 - 4 * sigma) * (19 * u).
Proof. pose proof (q3 f ok). pose proof (q6 f ok). pose proof (eps_twice f). pose proof (eps_pos f). unfold sigma. lra.
  Qed.
Lemma u_pos : 0 < u. Proof. pose proof (eps_twice f). pose proof (eps_pos f). lra. Qed.
Lemma representable_sum a b : fits (Sum a b) = true -> representable f (val (Sum a b)).
Proof. intro h. destruct (step_of _ h) as (x & y & _ & _ & r). exact (result_is_representable f ok _ _ r). Qed.
Lemma representable_product a b : fits (Product a b) = true -> representable f (val (Product a b)).
Proof. intro h. destruct (step_of _ h) as (x & y & _ & _ & r). exact (result_is_representable f ok _ _ r). Qed.

(* The decision by the permanent. *)
Theorem by_permanent a b n p count : fine a b n = true -> polynomial p = true -> fits p = true ->
  fits (Sum (roundoffs count p) margin) = true -> degree p = 3%nat -> (of_steps p <= 400)%Z ->
  exact d p = permanent d (Sum a b) -> permanent d p = permanent d (Sum a b) ->
  (n = 4%nat /\ count = 16%Z) \/ (n = 6%nat /\ count = 20%Z) ->
  proves (Sum a b) (val (Sum (roundoffs count p) margin)) /\ is_near (Sum a b) (val (Sum (roundoffs count p) margin)).
Proof.
  intros h poly fit fit_b deg steps ex pe which. pose proof (permanent_pos d (Sum a b)) as t0.
    set (t := permanent d (Sum a b)) in *.
  pose proof (error_of_steps f ok m m_1 from to value_of run in_range small p poly fit) as E. unfold within in E.
  rewrite deg in E. change (Init.Nat.pred 3) with 2%nat in E. fold d in E. rewrite ex, pe in E.
  destruct (steps_bounded p poly) as (_ & _ & dp & _). pose proof (q_small f ok _ dp) as Q. apply Rabs_le_inv in E.
  pose proof (lam_pos f). assert (m2 : 1 <= m ^ 2) by (simpl; nra).
  assert (IZR (of_steps p) <= 400) by (now apply IZR_le).
  assert (l * m ^ 2 * IZR (of_steps p) <= l * m ^ 2 * 400) by (apply Rmult_le_compat_l; [apply Rmult_le_pos;
    lra|assumption]).
  assert ((q f (depth p) - 1) * t <= slack * t) by (apply Rmult_le_compat_r; lra).
  assert (large : (1 - sigma) * t - 400 * l * m ^ 2 <= val p) by (unfold slack, sigma in *; lra).
  pose proof u_pos.
  pose proof (bound_large f ok from to value_of run in_range M M_maxima M_fits count p t fit_b ltac:(lia) t0 large) as
    B.
  assert (0 <= (1 - 3 * sigma) * (IZR count * u) * t).
  { repeat apply Rmult_le_pos; try lra; [unfold sigma; lra|apply IZR_le; lia]. }
  assert (l * 1 <= l * m ^ 2) by (apply Rmult_le_compat_l; lra).
  apply (sign' a b _ n h); [apply representable_sum; assumption|lra|]. fold t.
  assert (0 <= u * t) by (apply Rmult_le_pos; lra).
  destruct which as [[-> ->]|[-> ->]].
  - pose proof coefficient4. assert ((q f 4 + q f 3 - 2) * t <= (1 - 4 * sigma) * (15 * u) * t) by (apply
    Rmult_le_compat_r; lra).
    unfold sigma in *. lra.
  - pose proof coefficient6. assert ((q f 6 + q f 3 - 2) * t <= (1 - 4 * sigma) * (19 * u) * t) by (apply
    Rmult_le_compat_r; lra).
    unfold sigma in *. lra.
Qed.

End InRange.
End Proof.

(* The code's M, the largest magnitude, and the parts of its bounds. *)
Definition largest := s139.
Definition first_of e := match e with Sum a _ => a | _ => e end.
Definition second_of e := match e with Sum _ b => b | _ => e end.
(* From (16u P) + margin. *)
Definition permanent_of (bound : expr) := match bound with Sum (Product _ p) _ => p | _ => bound end.

(* The comparisons in the last part of the filter, by the permanent. *)
Definition last_part := Both
  (Either
    (Both (Both (Greater control_value_0 error_bound_0) (Greater control_value_1 error_bound_1))
      (Both (Greater control_value_2 error_bound_2) (Greater control_value_3 error_bound_3)))
    (Both (Both (Greater (Negative error_bound_0) control_value_0) (Greater (Negative error_bound_1) control_value_1))
      (Both (Greater (Negative error_bound_2) control_value_2) (Greater (Negative error_bound_3) control_value_3))))
  (Greater (Constant LargestEdge) largest).
(* It is what the code has: the second of the two alternatives of its decision. *)
Theorem the_code_decides_so : exists first, culled_by_permanent = Either first last_part.
Proof. eexists. reflexivity. Qed.

Section OfTheCode.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.

Lemma all_occur c : occurs c largest = true.
Proof. destruct c as [[| |] [|] [| |]]; vm_compute; reflexivity. Qed.

Section InRange.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Ltac prove_bound k b n count :=
  apply (by_permanent f ok from to value_of run in_range largest eq_refl all_occur eq_refl
    (first_of k) (second_of k) n (permanent_of b) count);
  [vm_compute; reflexivity | vm_compute; reflexivity | vm_compute; reflexivity | vm_compute; reflexivity | vm_compute;
    reflexivity
  | vm_compute; discriminate | cbv -[Rplus Rminus Rmult Ropp Rabs computed]; ring | cbv -[Rplus Rminus Rmult Ropp Rabs
    computed]; ring | auto].
Lemma bound_0 : proves f from to value_of control_value_0 (val value_of error_bound_0) /\
  is_near f from to value_of control_value_0 (val value_of error_bound_0).
Proof. prove_bound control_value_0 error_bound_0 4%nat 16%Z. Qed.
Lemma bound_1 : proves f from to value_of control_value_1 (val value_of error_bound_1) /\
  is_near f from to value_of control_value_1 (val value_of error_bound_1).
Proof. prove_bound control_value_1 error_bound_1 6%nat 20%Z. Qed.
Lemma bound_2 : proves f from to value_of control_value_2 (val value_of error_bound_2) /\
  is_near f from to value_of control_value_2 (val value_of error_bound_2).
Proof. prove_bound control_value_2 error_bound_2 6%nat 20%Z. Qed.
Lemma bound_3 : proves f from to value_of control_value_3 (val value_of error_bound_3) /\
  is_near f from to value_of control_value_3 (val value_of error_bound_3).
Proof. prove_bound control_value_3 error_bound_3 4%nat 16%Z. Qed.
Notation val := (val value_of).
Lemma value e : fits e = true -> value_of e = Number (val e).
Proof. exact (number f ok from to value_of run in_range e). Qed.
Lemma above k b : fits k = true -> fits b = true -> proves f from to value_of k (val b) ->
  greater f (value_of k) (value_of b) -> 0 < exact (exactly from to) k.
Proof.
  intros fk fb (big & up & _) g. rewrite (value k fk), (value b fb) in g. apply up. exact (greater_above f _ _ g big).
Qed.
Lemma below_ k b : fits k = true -> fits b = true -> proves f from to value_of k (val b) ->
  greater f (value_of (Negative b)) (value_of k) -> exact (exactly from to) k < 0.
Proof.
  intros fk fb (big & _ & down) g. pose proof (run (Negative b)) as n. simpl in n. rewrite (value b fb) in n.
    simpl in n.
  rewrite n, (value k fk) in g. apply down. exact (greater_below f _ _ g big).
Qed.
End InRange.

(* A pair that the last part culls has exact control values of one sign. *)
Theorem the_last_part_proves_one_sign : says f value_of last_part ->
  let e := exact (exactly from to) in
  (0 < e control_value_0 /\ 0 < e control_value_1 /\ 0 < e control_value_2 /\ 0 < e control_value_3) \/
  (e control_value_0 < 0 /\ e control_value_1 < 0 /\ e control_value_2 < 0 /\ e control_value_3 < 0).
Proof.
  intros [signs small]. assert (in_range := range f ok from to value_of run largest eq_refl all_occur small).
  destruct signs as [[[A B] [C D]]|[[A B] [C D]]]; [left|right].
  - repeat split; [eapply (above in_range _ error_bound_0)|eapply (above in_range _ error_bound_1)|
      eapply (above in_range _ error_bound_2)|eapply (above in_range _ error_bound_3)];
    first [assumption | apply bound_0; assumption | apply bound_1; assumption | apply bound_2;
      assumption | apply bound_3; assumption | vm_compute; reflexivity].
  - repeat split; [eapply (below_ in_range _ error_bound_0)|eapply (below_ in_range _ error_bound_1)|
      eapply (below_ in_range _ error_bound_2)|eapply (below_ in_range _ error_bound_3)];
    first [assumption | apply bound_0; assumption | apply bound_1; assumption | apply bound_2;
      assumption | apply bound_3; assumption | vm_compute; reflexivity].
Qed.
End OfTheCode.
