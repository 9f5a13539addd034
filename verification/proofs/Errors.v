(* The distance of an execution from exact arithmetic: no number overflows, and errors have bounds. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions.
Open Scope R_scope.

(* The largest magnitude of differences: four times the largest edge, as for corners in range. *)
Definition reach f := 4 * power (largest_edge f).

Section Errors.
Variable f : format.
Context {component : Type}.
Notation expr := (expr_of component).
Implicit Types e : expr.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.

Definition val e := match value_of e with Number x => x | _ => 0 end.
Let L := reach f.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= L.

Lemma L_ge_1 : 1 <= L.
Proof.
  unfold L, reach, power. assert (bpow radix2 0 <= bpow radix2 (largest_edge f)) by (apply bpow_le; destruct ok; lia).
    simpl in H. lra.
Qed.
Lemma omega_large : IZR (2 ^ 30) * L ^ 3 <= omega f.
Proof.
  unfold omega, L, reach, power. replace (IZR (2 ^ 30) * (4 * bpow radix2 (largest_edge f)) ^ 3) with
    (bpow radix2 36 * bpow radix2 (largest_edge f) ^ 3) by (change (IZR (2 ^ 30)) with 1073741824; simpl; lra).
  replace (bpow radix2 (largest_edge f) ^ 3) with (bpow radix2 (3 * largest_edge f)).
  2: { replace (3 * largest_edge f)%Z with (largest_edge f + (largest_edge f + largest_edge f))%Z by ring.
    rewrite !bpow_plus. ring. }
  rewrite <- bpow_plus.
  assert (bpow radix2 (36 + 3 * largest_edge f) <= bpow radix2 (greatest_exponent f - 1)) by (apply bpow_le;
    destruct ok; lia).
  assert (bpow radix2 (greatest_exponent f - precision f) <= bpow radix2 (greatest_exponent f - 1)) by (apply bpow_le;
    destruct ok; lia).
  assert (bpow radix2 (greatest_exponent f) = 2 * bpow radix2 (greatest_exponent f - 1)).
  { replace (greatest_exponent f) with (1 + (greatest_exponent f - 1))%Z at 1 by ring. rewrite bpow_plus. reflexivity. }
  lra.
Qed.

Lemma result_is_number z v bound : result f z v -> Rabs z <= bound -> 2 * bound + 1 <= omega f ->
  exists r, v = Number r /\ rounds f z r /\ Rabs r <= 2 * bound + 1.
Proof.
  intros (r & rounded & cases) z_small room.
  pose proof (rounding_error f ok z r rounded) as err. pose proof (eps_small f ok). pose proof (eps_pos f).
  pose proof (lam_small f ok). pose proof (Rabs_pos z).
  assert (Rabs r <= 2 * bound + 1).
  { replace r with ((r - z) + z) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (eps f * Rabs z <= 1 * Rabs z) by (apply Rmult_le_compat_r; lra). lra. }
  destruct cases as [[_ ->]|[[over _]|[over _]]].
  - exists r. auto.
  - pose proof (Rle_abs r). lra.
  - pose proof (Rle_abs (- r)). rewrite Rabs_Ropp in *. lra.
Qed.

Lemma size_pos e : (1 <= size e)%Z.
Proof. induction e as [|c| | | | | | |]; cbn [size]; try lia. destruct c; lia. Qed.

Lemma fits_bound e n : (size e <= n)%Z -> (n <= 2 ^ 30)%Z -> (degree e <= 3)%nat -> IZR (size e) * L ^ degree e <= omega
  f.
Proof.
  intros. pose proof omega_large. pose proof L_ge_1. eapply Rle_trans; [|exact H2].
  apply Rmult_le_compat; [apply IZR_le; pose proof (size_pos e); lia|apply pow_le; lra|apply IZR_le; lia|apply Rle_pow;
    assumption].
Qed.
Lemma pow_pos_L n : 1 <= L ^ n. Proof. apply pow_R1_Rle, L_ge_1. Qed.
Lemma widen s n s' n' : (1 <= s <= s')%Z -> (n <= n')%nat -> IZR s * L ^ n <= IZR s' * L ^ n'.
Proof.
  intros. pose proof L_ge_1. apply Rmult_le_compat; [apply IZR_le; lia|apply pow_le; lra|apply IZR_le;
    lia|apply Rle_pow; assumption].
Qed.

Lemma counts_val v x v' : v = Number x -> counts f v v' -> exists x', v' = Number x' /\ counts_as f x x'.
Proof.
  intros -> [->|(y & e & small & ->)].
  - exists x. split; [reflexivity|now left].
  - injection e as <-. exists 0. split; [reflexivity|right; auto].
Qed.

(* The result of each step, with operands that may count as zero. *)
Definition step (op : R -> R -> R) a b e := exists x y, counts_as f (val a) x /\ counts_as f (val b) y /\
  rounds f (op x y) (val e).
Definition node e := match e with
  | Sum a b => step Rplus a b e
  | Minus a b => step Rminus a b e
  | Product a b => step Rmult a b e
  | _ => True end.

(* Nothing overflows. *)
Theorem sizes e : fits e = true -> exists x, value_of e = Number x /\ Rabs x <= IZR (size e) * L ^ degree e /\ node e.
Proof.
  pose proof L_ge_1 as L1. pose proof omega_large as big.
  induction e as [c|c|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa b IHb|a IHa b IHb]; intro fit;
    pose proof fit as whole; cbn [fits] in fit; apply andb_prop in fit; destruct fit as [here below_];
    apply andb_prop in here; destruct here as [s_le d_le]; apply Z.leb_le in s_le; apply Nat.leb_le in d_le.
  - destruct (in_range c) as (x & -> & small). exists x. split; [reflexivity|]. simpl. split; [lra|exact I].
  - pose proof (run (Constant c)) as v. simpl in v. rewrite v. eexists. split; [reflexivity|]. split; [|exact I]. simpl.
    assert (one : forall e : Z, (e <= 0)%Z -> Rabs (power e) <= 1).
    { intros e neg. rewrite Rabs_pos_eq by apply bpow_ge_0. change 1 with (bpow radix2 0). now apply bpow_le. }
    destruct c as [| | | |n]; simpl.
    + assert (Rabs (unit_roundoff f) <= 1) by (apply one; destruct ok; lia). lra.
    + assert (Rabs (power (Arithmetic.underflow f)) <= 1) by (apply one; destruct ok; lia). lra.
    + discriminate.
    + rewrite Rabs_pos_eq; lra.
    + apply Z.leb_le in below_. rewrite Rabs_pos_eq by (now apply IZR_le). rewrite Rmult_1_r. apply IZR_le. lia.
  - apply andb_prop in below_ as [fa fb]. destruct (IHa fa) as (x & vx & bx & _).
    destruct (IHb fb) as (y & vy & by_ & _).
    destruct (run (Sum a b) x y vx vy) as (x' & y' & cx & cy & res).
    pose proof (counts_smaller _ _ _ cx). pose proof (counts_smaller _ _ _ cy).
    pose proof (size_pos a); pose proof (size_pos b). set (d := Nat.max (degree a) (degree b)) in *.
    assert (IZR (size a) * L ^ degree a <= IZR (size a) * L ^ d) by (apply widen; lia).
    assert (IZR (size b) * L ^ degree b <= IZR (size b) * L ^ d) by (apply widen; lia).
    pose proof (pow_pos_L d).
    assert (target : 2 * ((IZR (size a) + IZR (size b)) * L ^ d) + 1 <= IZR (size (Sum a b)) * L ^ degree (Sum a b)).
    { cbn [size degree]. fold d. rewrite plus_IZR, mult_IZR, plus_IZR. nra. }
    destruct (result_is_number _ _ ((IZR (size a) + IZR (size b)) * L ^ d) res) as (r & vr & rounded & small).
    + eapply Rle_trans; [apply Rabs_triang|]. lra.
    + eapply Rle_trans; [exact target|]. eapply fits_bound; eauto. apply Z.le_refl. 
    + exists r. split; [exact vr|]. split; [lra|]. exists x', y'. unfold val. rewrite vx, vy, vr. auto.
  - apply andb_prop in below_ as [fa fb]. destruct (IHa fa) as (x & vx & bx & _).
    destruct (IHb fb) as (y & vy & by_ & _).
    destruct (run (Minus a b) x y vx vy) as (x' & y' & cx & cy & res).
    pose proof (counts_smaller _ _ _ cx). pose proof (counts_smaller _ _ _ cy).
    pose proof (size_pos a); pose proof (size_pos b). set (d := Nat.max (degree a) (degree b)) in *.
    assert (IZR (size a) * L ^ degree a <= IZR (size a) * L ^ d) by (apply widen; lia).
    assert (IZR (size b) * L ^ degree b <= IZR (size b) * L ^ d) by (apply widen; lia).
    pose proof (pow_pos_L d).
    assert (target : 2 * ((IZR (size a) + IZR (size b)) * L ^ d) + 1 <= IZR (size (Minus a b)) * L ^ degree (Minus a
      b)).
    { cbn [size degree]. fold d. rewrite plus_IZR, mult_IZR, plus_IZR. nra. }
    destruct (result_is_number _ _ ((IZR (size a) + IZR (size b)) * L ^ d) res) as (r & vr & rounded & small).
    + eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
    + eapply Rle_trans; [exact target|]. eapply fits_bound; eauto. apply Z.le_refl.
    + exists r. split; [exact vr|]. split; [lra|]. exists x', y'. unfold val. rewrite vx, vy, vr. auto.
  - apply andb_prop in below_ as [fa fb]. destruct (IHa fa) as (x & vx & bx & _).
    destruct (IHb fb) as (y & vy & by_ & _).
    destruct (run (Product a b) x y vx vy) as (x' & y' & cx & cy & res).
    pose proof (counts_smaller _ _ _ cx). pose proof (counts_smaller _ _ _ cy).
    pose proof (size_pos a); pose proof (size_pos b).
    pose proof (pow_pos_L (degree a + degree b)).
    assert (target : 2 * ((IZR (size a) * L ^ degree a) * (IZR (size b) * L ^ degree b)) + 1
      <= IZR (size (Product a b)) * L ^ degree (Product a b)).
    { cbn [size degree]. rewrite plus_IZR, !mult_IZR. rewrite pow_add in *. nra. }
    destruct (result_is_number _ _ ((IZR (size a) * L ^ degree a) * (IZR (size b) * L ^ degree b)) res) as (r & vr &
      rounded & small).
    + rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; lra.
    + eapply Rle_trans; [exact target|]. eapply fits_bound; eauto. apply Z.le_refl.
    + exists r. split; [exact vr|]. split; [lra|]. exists x', y'. unfold val. rewrite vx, vy, vr. auto.
  - destruct (IHa below_) as (x & vx & bx & _). pose proof (run (Negative a)) as v. simpl in v. rewrite v, vx. simpl.
    exists (- x). rewrite Rabs_Ropp. simpl. auto.
  - destruct (IHa below_) as (x & vx & bx & _). pose proof (run (Magnitude a)) as v. simpl in v. rewrite v, vx. simpl.
    exists (Rabs x). rewrite Rabs_Rabsolu. simpl. auto.
  - apply andb_prop in below_ as [fa fb]. destruct (IHa fa) as (x & vx & bx & _).
    destruct (IHb fb) as (y & vy & by_ & _).
    pose proof (run (Larger a b)) as v. simpl in v. unfold larger in v. rewrite vx, vy in v.
    destruct v as (v' & w' & _ & _ & which); try discriminate.
    pose proof (size_pos a); pose proof (size_pos b).
    assert (IZR (size a) * L ^ degree a <= IZR (size (Larger a b)) * L ^ degree (Larger a b)) by (apply widen; simpl;
      lia).
    assert (IZR (size b) * L ^ degree b <= IZR (size (Larger a b)) * L ^ degree (Larger a b)) by (apply widen; simpl;
      lia).
    destruct which as [[_ c]|[_ c]]; destruct (counts_val _ _ _ eq_refl c) as (r & -> & small);
      apply counts_smaller in small;
      exists r; (split; [reflexivity|split; [lra|exact I]]).
  - apply andb_prop in below_ as [fa fb]. destruct (IHa fa) as (x & vx & bx & _).
    destruct (IHb fb) as (y & vy & by_ & _).
    pose proof (run (Smaller a b)) as v. simpl in v. unfold smaller in v. rewrite vx, vy in v.
    destruct v as (v' & w' & _ & _ & which); try discriminate.
    pose proof (size_pos a); pose proof (size_pos b).
    assert (IZR (size a) * L ^ degree a <= IZR (size (Smaller a b)) * L ^ degree (Smaller a b)) by (apply widen; simpl;
      lia).
    assert (IZR (size b) * L ^ degree b <= IZR (size (Smaller a b)) * L ^ degree (Smaller a b)) by (apply widen; simpl;
      lia).
    destruct which as [[_ c]|[_ c]]; destruct (counts_val _ _ _ eq_refl c) as (r & -> & small);
      apply counts_smaller in small;
      exists r; (split; [reflexivity|split; [lra|exact I]]).
Qed.

Lemma is_number e : fits e = true -> value_of e = Number (val e).
Proof. intro fit. destruct (sizes e fit) as (x & vx & _). unfold val. now rewrite vx. Qed.

Lemma fits_parts (a : expr) b e : e = Sum a b \/ e = Minus a b \/ e = Product a b \/ e = Larger a b \/ e = Smaller a b
  ->
  fits e = true -> fits a = true /\ fits b = true.
Proof. intros [->|[->|[->|[->| ->]]]] fit; cbn [fits] in fit; apply andb_prop in fit as [_ fit];
  now apply andb_prop in fit. Qed.

End Errors.
