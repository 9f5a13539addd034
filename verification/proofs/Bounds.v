(* The error theorem: a computed polynomial is near the exact one, by its permanent and by what underflow adds. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Selvedge Require Import Arithmetic Expressions Errors.
Open Scope R_scope.

Section Polynomials.
Variable f : format.
Context {component : Type}.
Notation expr := (expr_of component).
Implicit Types e : expr.
Hypothesis ok : reasonable f.
Let e1 := eps f.
Let l := lam f.
Variable m : R.
Hypothesis m1 : 1 <= m.

Definition q n := (1 + e1) ^ n.
Definition slack := / 262144.

Lemma e_pos : 0 < e1. Proof. apply eps_pos. Qed.
Lemma l_pos : 0 < l. Proof. apply lam_pos. Qed.
Lemma q_ge n : 1 <= q n. Proof. apply pow_R1_Rle. pose proof e_pos. lra. Qed.
Lemma q_mono a b : (a <= b)%nat -> q a <= q b. Proof. intro. apply Rle_pow; [pose proof e_pos; lra|assumption]. Qed.
Lemma q_small n : (n <= 16)%nat -> q n <= 1 + slack.
Proof.
  intro. eapply Rle_trans; [apply (q_mono n 16); assumption|]. unfold q, slack, e1.
  eapply Rle_trans; [apply pow_incr with (y := 1 + / 8388608); pose proof (eps_pos f); pose proof (eps_small f ok);
    lra|].
  assert (square : forall x, 0 <= x <= / 1000 -> (1 + x) * (1 + x) <= 1 + (2 + / 1000) * x) by (intros; nra).
  assert (two : (1 + / 8388608) ^ 2 <= 1 + 2.001 * / 8388608) by (simpl; lra).
  assert (p2 : 0 <= (1 + / 8388608) ^ 2) by (apply pow_le; lra).
  assert (four : (1 + / 8388608) ^ 4 <= 1 + 4.01 * / 8388608).
  { replace ((1 + / 8388608) ^ 4) with ((1 + / 8388608) ^ 2 * (1 + / 8388608) ^ 2) by ring. nra. }
  assert (p4 : 0 <= (1 + / 8388608) ^ 4) by (apply pow_le; lra).
  assert (eight : (1 + / 8388608) ^ 8 <= 1 + 8.1 * / 8388608).
  { replace ((1 + / 8388608) ^ 8) with ((1 + / 8388608) ^ 4 * (1 + / 8388608) ^ 4) by ring. nra. }
  assert (p8 : 0 <= (1 + / 8388608) ^ 8) by (apply pow_le; lra).
  replace ((1 + / 8388608) ^ 16) with ((1 + / 8388608) ^ 8 * (1 + / 8388608) ^ 8) by ring. nra.
Qed.
Lemma M_ge n : 1 <= m ^ n. Proof. now apply pow_R1_Rle. Qed.
Lemma M_mono a b : (a <= b)%nat -> m ^ a <= m ^ b. Proof. intro. now apply Rle_pow. Qed.

(* The algebra of a product of two numbers that are off. *)
Lemma product_error x y ex ey qa qb pa pb aa ab Ma Mb ca cb :
  1 <= qa <= 1 + slack -> 1 <= qb <= 1 + slack -> Rabs ex <= pa -> Rabs ey <= pb -> 0 <= aa -> 0 <= ab -> 1 <= Ma -> 1
    <= Mb ->
  pa <= ca * (m * Ma) -> pb <= cb * (m * Mb) -> 0 <= ca -> 0 <= cb ->
  ca * ab + aa * cb <= 16384 -> aa * ab <= 33554432 ->
  Rabs (x - ex) <= (qa - 1) * pa + l * aa * Ma -> Rabs (y - ey) <= (qb - 1) * pb + l * ab * Mb ->
  Rabs (x * y - ex * ey) <= (qa * qb - 1) * (pa * pb) + l * (ca * ab + aa * cb + / 4) * (m * Ma * Mb).
Proof.
  intros Qa Qb Pa Pb Aa Ab MA MB Ca Cb ca0 cb0 X1 X2 Dx Dy.
  pose proof l_pos. assert (l <= / 1152921504606846976) by (apply lam_small; exact ok).
  assert (pa0 : 0 <= pa) by (pose proof (Rabs_pos ex); lra). assert (pb0 : 0 <= pb) by (pose proof (Rabs_pos ey); lra).
  assert (Sx : Rabs x <= qa * pa + l * aa * Ma).
  { replace x with ((x - ex) + ex) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (x * y - ex * ey) with (x * (y - ey) + (x - ex) * ey) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  assert (T1 : Rabs x * Rabs (y - ey) <= (qa * pa + l * aa * Ma) * ((qb - 1) * pb + l * ab * Mb))
    by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (T2 : Rabs (x - ex) * Rabs ey <= ((qa - 1) * pa + l * aa * Ma) * pb) by (apply Rmult_le_compat;
    auto using Rabs_pos).
  set (N := m * Ma * Mb).
  assert (N1 : pa * Mb <= ca * N) by (replace (ca * N) with (ca * (m * Ma) * Mb) by (unfold N; ring);
    apply Rmult_le_compat_r; lra).
  assert (N2 : pb * Ma <= cb * N) by (replace (cb * N) with (cb * (m * Mb) * Ma) by (unfold N; ring);
    apply Rmult_le_compat_r; lra).
  assert (MaMb : 1 <= Ma * Mb) by (rewrite <- (Rmult_1_l 1); apply Rmult_le_compat; lra).
  assert (N3 : Ma * Mb <= N). { unfold N. rewrite Rmult_assoc. rewrite <- (Rmult_1_l (Ma * Mb)) at 1.
    apply Rmult_le_compat_r; lra. }
  assert (N0 : 0 <= N) by lra.
  assert (B : qa * ab * (pa * Mb) + qb * aa * (pb * Ma) + l * (aa * ab) * (Ma * Mb) <= (ca * ab + aa * cb + / 4) * N).
  { assert (0 <= aa * ab) by (apply Rmult_le_pos; assumption).
    assert (qa * ab * (pa * Mb) <= (1 + slack) * ab * (ca * N))
      by (apply Rmult_le_compat; [apply Rmult_le_pos; lra|apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
        lra|assumption]).
    assert (qb * aa * (pb * Ma) <= (1 + slack) * aa * (cb * N))
      by (apply Rmult_le_compat; [apply Rmult_le_pos; lra|apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
        lra|assumption]).
    assert (l * (aa * ab) <= / 8).
    { assert (l * (aa * ab) <= / 1152921504606846976 * 33554432) by (apply Rmult_le_compat; lra). lra. }
    assert (l * (aa * ab) * (Ma * Mb) <= / 8 * N) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
    assert (slack * (ca * ab + aa * cb) <= / 8) by (unfold slack; lra).
    assert (slack * (ca * ab + aa * cb) * N <= / 8 * N) by (apply Rmult_le_compat_r; lra).
    replace ((1 + slack) * ab * (ca * N)) with ((ca * ab) * N + slack * (ca * ab) * N) in * by ring.
    replace ((1 + slack) * aa * (cb * N)) with ((aa * cb) * N + slack * (aa * cb) * N) in * by ring. lra. }
  apply Rmult_le_compat_l with (r := l) in B; [|lra].
  replace (l * (ca * ab + aa * cb + / 4) * N) with (l * ((ca * ab + aa * cb + / 4) * N)) by ring.
  replace ((qa * pa + l * aa * Ma) * ((qb - 1) * pb + l * ab * Mb)) with
    (qa * (qb - 1) * (pa * pb) + l * (qa * ab * (pa * Mb) + (qb - 1) * aa * (pb * Ma) + l * (aa * ab) * (Ma * Mb))) in
      T1 by ring.
  replace (((qa - 1) * pa + l * aa * Ma) * pb) with ((qa - 1) * (pa * pb) + l * (aa * (pb * Ma))) in T2 by ring.
  lra.
Qed.

(* The last rounding of a step. *)
Lemma step_error z r ex n p a N : rounds f z r -> (n <= 15)%nat -> Rabs ex <= p -> 0 <= a <= 16400 -> 1 <= N ->
  Rabs (z - ex) <= (q n - 1) * p + l * (a * N) -> Rabs (r - ex) <= (q (S n) - 1) * p + l * ((a + 1 + / 4) * N).
Proof.
  intros R_ n_le pe a_le N1 D. pose proof (rounding_error f ok _ _ R_) as E. fold e1 l in E.
  pose proof l_pos. pose proof e_pos. assert (e1 <= / 8388608) by (apply eps_small; exact ok).
  assert (Z1 : Rabs z <= q n * p + l * (a * N)).
  { replace z with ((z - ex) + ex) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (e1 * Rabs z <= e1 * (q n * p) + e1 * (l * (a * N))).
  { rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; lra. }
  assert (0 <= a * N) by (apply Rmult_le_pos; lra).
  assert (small : e1 * a <= / 4). { assert (e1 * a <= / 8388608 * 16400) by (apply Rmult_le_compat; lra). lra. }
  assert (e1 * (l * (a * N)) <= l * (/ 4 * N)).
  { replace (e1 * (l * (a * N))) with (l * ((e1 * a) * N)) by ring. apply Rmult_le_compat_l; [lra|].
    apply Rmult_le_compat_r; lra. }
  assert (l * 1 <= l * N) by (apply Rmult_le_compat_l; lra).
  replace (r - ex) with ((r - z) + (z - ex)) by ring. eapply Rle_trans; [apply Rabs_triang|].
  replace (q (S n)) with ((1 + e1) * q n) by reflexivity.
  lra.
Qed.

Ltac parts h := cbn [polynomial] in h; apply andb_prop in h; destruct h as [h ?below];
  apply andb_prop in h; destruct h as [h ?depth_le]; apply andb_prop in h; destruct h as [h ?mono_le];
  apply andb_prop in h; destruct h as [?steps_le ?diff_le];
  repeat match goal with H : (_ <=? _)%Z = true |- _ => apply Z.leb_le in H end;
  repeat match goal with H : (_ <=? _)%nat = true |- _ => apply Nat.leb_le in H end.

Lemma counts_pos e : (1 <= monomials e)%Z /\ (0 <= of_steps e)%Z /\ (0 <= of_differences e)%Z.
Proof. induction e; cbn [monomials of_steps of_differences]; try lia; nia. Qed.
Lemma degree_pos e : polynomial e = true -> (1 <= degree e)%nat.
Proof.
  induction e; intro h; parts h; try discriminate; cbn [degree]; try lia;
    try (apply andb_prop in below as [? ?]; specialize (IHe1 H); specialize (IHe2 H0); lia).
  destruct e; try discriminate. simpl. lia.
Qed.

Section Exactly.
Variable leaf : component -> R.
Hypothesis leaf_m : forall c, Rabs (leaf c) <= m.
Lemma permanent_pos e : 0 <= permanent leaf e.
Proof. induction e; cbn [permanent]; try apply Rabs_pos; try lra. now apply Rmult_le_pos. Qed.
Lemma exact_permanent e : Rabs (exact leaf e) <= permanent leaf e.
Proof.
  induction e; cbn [exact permanent]; try lra; try (rewrite Rabs_R0; lra).
  - eapply Rle_trans; [apply Rabs_triang|]. lra.
  - eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
  - rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
  - now rewrite Rabs_Ropp.
  - now rewrite Rabs_Rabsolu.
Qed.
Lemma permanent_monomials e : permanent leaf e <= IZR (monomials e) * m ^ degree e.
Proof.
  pose proof m1. induction e; cbn [permanent monomials degree]; rewrite ?plus_IZR, ?mult_IZR; try lra.
  - rewrite pow_1, Rmult_1_l. apply leaf_m.
  - pose proof (M_mono (degree e2) (Nat.max (degree e2) (degree e3)) ltac:(lia)).
    pose proof (M_mono (degree e3) (Nat.max (degree e2) (degree e3)) ltac:(lia)).
    assert (0 <= IZR (monomials e2)) by (apply IZR_le; pose proof (counts_pos e2); lia).
    assert (0 <= IZR (monomials e3)) by (apply IZR_le; pose proof (counts_pos e3); lia). nra.
  - pose proof (M_mono (degree e2) (Nat.max (degree e2) (degree e3)) ltac:(lia)).
    pose proof (M_mono (degree e3) (Nat.max (degree e2) (degree e3)) ltac:(lia)).
    assert (0 <= IZR (monomials e2)) by (apply IZR_le; pose proof (counts_pos e2); lia).
    assert (0 <= IZR (monomials e3)) by (apply IZR_le; pose proof (counts_pos e3); lia). nra.
  - rewrite pow_add. replace (IZR (monomials e2) * IZR (monomials e3) * (m ^ degree e2 * m ^ degree e3)) with
      ((IZR (monomials e2) * m ^ degree e2) * (IZR (monomials e3) * m ^ degree e3)) by ring.
    apply Rmult_le_compat; auto using permanent_pos.
  - rewrite Rmult_1_l. apply (M_ge (Nat.max (degree e2) (degree e3))) || (pose proof (M_ge (Nat.max (degree e2) (degree
    e3))); lra).
  - pose proof (M_ge (Nat.max (degree e2) (degree e3))); lra.
Qed.
End Exactly.


Lemma counts_real e : 1 <= IZR (monomials e) /\ 0 <= IZR (of_steps e) /\ 0 <= IZR (of_differences e).
Proof. pose proof (counts_pos e). repeat split; apply IZR_le; lia. Qed.

Lemma steps_bounded (a : expr) : polynomial a = true ->
  (of_steps a <= 4096)%Z /\ (monomials a <= 64)%Z /\ (depth a <= 16)%nat /\ (of_differences a <= 4096)%Z.
Proof. intro h. destruct a; parts h; auto. Qed.

(* The loss by the errors of differences. *)
Fixpoint signed e : bool := match e with
  | Difference _ => true
  | Sum a b | Minus a b | Product a b => signed a && signed b
  | _ => false end.
Theorem error_of_differences computed exactly :
  (forall c, Rabs (computed c) <= m) -> (forall c, Rabs (exactly c - computed c) <= e1 * Rabs (computed c) + l * 3) ->
  forall e, polynomial e = true -> signed e = true -> (degree e <= 16)%nat ->
  Rabs (exact exactly e - exact computed e) <=
    (q (degree e) - 1) * permanent computed e + l * IZR (of_differences e) * m ^ pred (degree e).
Proof.
  intros small off e. pose proof l_pos as l0. pose proof m1.
  assert (sums : forall (a b : expr) (op : R -> R -> R), (op = Rplus \/ op = Rminus) -> (Nat.max (degree a) (degree b)
    <= 16)%nat ->
    Rabs (exact exactly a - exact computed a) <= (q (degree a) - 1) * permanent computed a + l * IZR (of_differences a)
      * m ^ pred (degree a) ->
    Rabs (exact exactly b - exact computed b) <= (q (degree b) - 1) * permanent computed b + l * IZR (of_differences b)
      * m ^ pred (degree b) ->
    Rabs (op (exact exactly a) (exact exactly b) - op (exact computed a) (exact computed b)) <=
    (q (Nat.max (degree a) (degree b)) - 1) * (permanent computed a + permanent computed b)
    + l * (IZR (of_differences a) + IZR (of_differences b)) * m ^ pred (Nat.max (degree a) (degree b))).
  { intros a b op which _ Da Db. set (d := Nat.max (degree a) (degree b)).
    assert (Rabs (op (exact exactly a) (exact exactly b) - op (exact computed a) (exact computed b)) <=
      Rabs (exact exactly a - exact computed a) + Rabs (exact exactly b - exact computed b)).
    { destruct which as [-> | ->].
      - replace (exact exactly a + exact exactly b - (exact computed a + exact computed b)) with
          ((exact exactly a - exact computed a) + (exact exactly b - exact computed b)) by ring. apply Rabs_triang.
      - replace (exact exactly a - exact exactly b - (exact computed a - exact computed b)) with
          ((exact exactly a - exact computed a) + - (exact exactly b - exact computed b)) by ring.
        eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    pose proof (q_mono (degree a) d ltac:(lia)). pose proof (q_mono (degree b) d ltac:(lia)).
    pose proof (permanent_pos computed a). pose proof (permanent_pos computed b).
    assert ((q (degree a) - 1) * permanent computed a <= (q d - 1) * permanent computed a) by (apply Rmult_le_compat_r;
      lra).
    assert ((q (degree b) - 1) * permanent computed b <= (q d - 1) * permanent computed b) by (apply Rmult_le_compat_r;
      lra).
    pose proof (counts_real a). pose proof (counts_real b).
    assert (l * IZR (of_differences a) * m ^ pred (degree a) <= l * IZR (of_differences a) * m ^ pred d)
      by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|apply M_mono; lia]).
    assert (l * IZR (of_differences b) * m ^ pred (degree b) <= l * IZR (of_differences b) * m ^ pred d)
      by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|apply M_mono; lia]).
    lra. }
  induction e as [c|c|a IHa b IHb|a IHa b IHb|a IHa b IHb| | | |]; intros poly sign deg; try discriminate;
    pose proof poly as h; parts h; cbn [exact permanent degree of_differences signed] in *.
  - unfold q. simpl. eapply Rle_trans; [apply off|]. lra.
  - apply andb_prop in below as [pa pb]. apply andb_prop in sign as [sa sb]. rewrite plus_IZR.
    apply (sums a b Rplus); auto; [apply IHa|apply IHb]; auto; lia.
  - apply andb_prop in below as [pa pb]. apply andb_prop in sign as [sa sb]. rewrite plus_IZR.
    apply (sums a b Rminus); auto; [apply IHa|apply IHb]; auto; lia.
  - apply andb_prop in below as [pa pb]. apply andb_prop in sign as [sa sb].
    specialize (IHa pa sa ltac:(lia)). specialize (IHb pb sb ltac:(lia)).
    pose proof (degree_pos a pa) as da. pose proof (degree_pos b pb) as db.
    pose proof (counts_pos a) as ca. pose proof (counts_pos b) as cb. pose proof (counts_real a).
      pose proof (counts_real b).
    pose proof (permanent_monomials computed small a) as ma. pose proof (permanent_monomials computed small b) as mb.
    assert (factor : forall k, (1 <= k)%nat -> m ^ k = m * m ^ pred k) by (intros [|k] hk; [lia|reflexivity]).
    rewrite (factor _ da) in ma. rewrite (factor _ db) in mb.
    assert (X : IZR (monomials a) * IZR (of_differences b) + IZR (of_differences a) * IZR (monomials b) <= 16384).
    { rewrite <- !mult_IZR, <- plus_IZR. apply IZR_le. lia. }
    assert (below_ : (of_differences a <= 4096)%Z /\ (of_differences b <= 4096)%Z).
    { split; apply steps_bounded; assumption. }
    assert (Y : IZR (of_differences a) * IZR (of_differences b) <= 33554432).
    { rewrite <- mult_IZR. apply IZR_le. nia. }
    pose proof (product_error (exact exactly a) (exact exactly b) (exact computed a) (exact computed b) (q (degree a))
      (q (degree b))
      (permanent computed a) (permanent computed b) (IZR (of_differences a)) (IZR (of_differences b))
      (m ^ pred (degree a)) (m ^ pred (degree b)) (IZR (monomials a)) (IZR (monomials b))
      (conj (q_ge _) (q_small (degree a) ltac:(lia))) (conj (q_ge _) (q_small (degree b) ltac:(lia)))
      (exact_permanent _ a) (exact_permanent _ b) (proj2 (proj2 (counts_real a))) (proj2 (proj2 (counts_real b))) (M_ge
        _) (M_ge _) ma mb (Rle_trans _ _ _ Rle_0_1 (proj1 (counts_real a))) (Rle_trans _ _ _ Rle_0_1 (proj1 (counts_real
        b)))
      X Y IHa IHb) as E.
    replace (q (degree a) * q (degree b)) with (q (degree a + degree b)) in E by (unfold q; apply pow_add).
    eapply Rle_trans; [exact E|]. rewrite !plus_IZR, !mult_IZR.
    replace (pred (degree a + degree b)) with (S (pred (degree a) + pred (degree b))) by lia.
    cbn [pow]. rewrite pow_add. set (N := m * m ^ pred (degree a) * m ^ pred (degree b)).
    replace (m * (m ^ pred (degree a) * m ^ pred (degree b))) with N by (unfold N; ring).
    assert (0 <= N). { unfold N. pose proof (M_ge (pred (degree a))). pose proof (M_ge (pred (degree b))).
      repeat apply Rmult_le_pos; lra. }
    apply Rplus_le_compat_l. rewrite !Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; lra.
Qed.

(* The loss by the steps. *)
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation val := (val value_of).
Definition computed c := val (Difference c).
Hypothesis computed_m : forall c, Rabs (computed c) <= m.
Notation E := (exact computed).
Notation p := (permanent computed).

Lemma operand (a : expr) x a_exact n w M : counts_as f (val a) x -> 1 <= M -> Rabs (val a - a_exact) <= (q n - 1) * p a
  + l * w * M ->
  Rabs (x - a_exact) <= (q n - 1) * p a + l * (w + 1) * M.
Proof.
  intros c M1 d. apply counts_error in c. fold l in c. pose proof l_pos.
  replace (x - a_exact) with ((x - val a) + (val a - a_exact)) by ring. eapply Rle_trans; [apply Rabs_triang|].
  assert (l * 1 <= l * M) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Definition within e := Rabs (val e - E e) <= (q (depth e) - 1) * p e + l * IZR (of_steps e) * m ^ pred (degree e).

(* A sum before its rounding. *)
Lemma sum_before_rounding (a : expr) b x y (op : R -> R -> R) : op = Rplus \/ op = Rminus ->
  counts_as f (val a) x -> counts_as f (val b) y -> within a -> within b ->
  Rabs (op x y - op (E a) (E b)) <= (q (Nat.max (depth a) (depth b)) - 1) * (p a + p b)
    + l * ((IZR (of_steps a) + 1 + (IZR (of_steps b) + 1)) * m ^ pred (Nat.max (degree a) (degree b))).
Proof.
  intros which cx cy wa wb. pose proof l_pos.
  apply (operand a x _ _ _ _ cx (M_ge _)) in wa. apply (operand b y _ _ _ _ cy (M_ge _)) in wb.
  set (d := Nat.max (degree a) (degree b)). set (n := Nat.max (depth a) (depth b)).
  assert (Rabs (op x y - op (E a) (E b)) <= Rabs (x - E a) + Rabs (y - E b)).
  { destruct which as [-> | ->].
    - replace (x + y - (E a + E b)) with ((x - E a) + (y - E b)) by ring. apply Rabs_triang.
    - replace (x - y - (E a - E b)) with ((x - E a) + - (y - E b)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  pose proof (q_mono (depth a) n ltac:(lia)). pose proof (q_mono (depth b) n ltac:(lia)).
  pose proof (permanent_pos computed a). pose proof (permanent_pos computed b).
  assert ((q (depth a) - 1) * p a <= (q n - 1) * p a) by (apply Rmult_le_compat_r; lra).
  assert ((q (depth b) - 1) * p b <= (q n - 1) * p b) by (apply Rmult_le_compat_r; lra).
  pose proof (counts_real a). pose proof (counts_real b).
  assert (l * (IZR (of_steps a) + 1) * m ^ pred (degree a) <= l * (IZR (of_steps a) + 1) * m ^ pred d)
    by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|apply M_mono; lia]).
  assert (l * (IZR (of_steps b) + 1) * m ^ pred (degree b) <= l * (IZR (of_steps b) + 1) * m ^ pred d)
    by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|apply M_mono; lia]).
  lra.
Qed.

Theorem error_of_steps e : polynomial e = true -> fits e = true -> within e.
Proof.
  unfold within. pose proof l_pos as l0. pose proof m1.
  induction e as [c|c|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa b IHb|a IHa b IHb]; intros poly fit;
    pose proof poly as h; parts h; try discriminate.
  - cbn. unfold computed. replace (val (Difference c) - val (Difference c)) with 0 by ring. rewrite Rabs_R0. unfold q.
    simpl. lra.
  - destruct (fits_parts a b (Sum a b) ltac:(auto) fit) as [fa fb]. apply andb_prop in below as [pa pb].
    destruct (sizes f ok from to value_of run in_range _ fit) as (_ & _ & _ & x & y & cx & cy & rounded).
    specialize (IHa pa fa). specialize (IHb pb fb).
    pose proof (sum_before_rounding a b x y Rplus ltac:(auto) cx cy IHa IHb) as D.
    pose proof (counts_real a). pose proof (counts_real b).
    pose proof (exact_permanent computed (Sum a b)) as ep. cbn [exact permanent] in ep. cbn [depth degree] in *.
    assert (IZR (of_steps a) <= 4096) by (apply IZR_le, steps_bounded, pa).
    assert (IZR (of_steps b) <= 4096) by (apply IZR_le, steps_bounded, pb).
    pose proof (fun u v w => step_error _ _ _ _ _ _ _ rounded u ep v w D) as S_.
    specialize (S_ ltac:(lia) ltac:(lra) (M_ge _)).
    cbn [exact permanent of_steps]. rewrite !plus_IZR. eapply Rle_trans; [exact S_|].
    apply Rplus_le_compat_l. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; [|lra].
    pose proof (M_ge (pred (Nat.max (degree a) (degree b)))). lra.
  - destruct (fits_parts a b (Minus a b) ltac:(auto) fit) as [fa fb]. apply andb_prop in below as [pa pb].
    destruct (sizes f ok from to value_of run in_range _ fit) as (_ & _ & _ & x & y & cx & cy & rounded).
    specialize (IHa pa fa). specialize (IHb pb fb).
    pose proof (sum_before_rounding a b x y Rminus ltac:(auto) cx cy IHa IHb) as D.
    pose proof (counts_real a). pose proof (counts_real b).
    pose proof (exact_permanent computed (Minus a b)) as ep. cbn [exact permanent] in ep. cbn [depth degree] in *.
    assert (IZR (of_steps a) <= 4096) by (apply IZR_le, steps_bounded, pa).
    assert (IZR (of_steps b) <= 4096) by (apply IZR_le, steps_bounded, pb).
    pose proof (fun u v w => step_error _ _ _ _ _ _ _ rounded u ep v w D) as S_.
    specialize (S_ ltac:(lia) ltac:(lra) (M_ge _)).
    cbn [exact permanent of_steps]. rewrite !plus_IZR. eapply Rle_trans; [exact S_|].
    apply Rplus_le_compat_l. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; [|lra].
    pose proof (M_ge (pred (Nat.max (degree a) (degree b)))). lra.
  - destruct (fits_parts a b (Product a b) ltac:(auto) fit) as [fa fb]. apply andb_prop in below as [pa pb].
    destruct (sizes f ok from to value_of run in_range _ fit) as (_ & _ & _ & x & y & cx & cy & rounded).
    specialize (IHa pa fa). specialize (IHb pb fb).
    apply (operand a x _ _ _ _ cx (M_ge _)) in IHa. apply (operand b y _ _ _ _ cy (M_ge _)) in IHb.
    pose proof (degree_pos a pa) as da. pose proof (degree_pos b pb) as db.
    pose proof (counts_pos a) as ca. pose proof (counts_pos b) as cb. pose proof (counts_real a).
      pose proof (counts_real b).
    destruct (steps_bounded a pa) as (sa & na & ta & _). destruct (steps_bounded b pb) as (sb & nb & tb & _).
    pose proof (permanent_monomials computed computed_m a) as ma. pose proof (permanent_monomials computed computed_m b)
      as mb.
    assert (factor : forall k, (1 <= k)%nat -> m ^ k = m * m ^ pred k) by (intros [|k] hk; [lia|reflexivity]).
    rewrite (factor _ da) in ma. rewrite (factor _ db) in mb. cbn [of_steps depth] in steps_le, depth_le.
    assert (X : IZR (monomials a) * (IZR (of_steps b) + 1) + (IZR (of_steps a) + 1) * IZR (monomials b) <= 4096).
    { rewrite <- !(plus_IZR _ 1), <- !mult_IZR, <- plus_IZR. apply IZR_le. lia. }
    assert (X0 : 0 <= IZR (monomials a) * (IZR (of_steps b) + 1) + (IZR (of_steps a) + 1) * IZR (monomials b)).
    { rewrite <- !(plus_IZR _ 1), <- !mult_IZR, <- plus_IZR. apply IZR_le. nia. }
    assert (wa0 : 0 <= IZR (of_steps a) + 1) by lra. assert (wb0 : 0 <= IZR (of_steps b) + 1) by lra.
    assert (X16 : IZR (monomials a) * (IZR (of_steps b) + 1) + (IZR (of_steps a) + 1) * IZR (monomials b) <= 16384) by
      lra.
    assert (Y : (IZR (of_steps a) + 1) * (IZR (of_steps b) + 1) <= 33554432).
    { rewrite <- !(plus_IZR _ 1), <- mult_IZR. apply IZR_le. nia. }
    pose proof (product_error x y (E a) (E b) (q (depth a)) (q (depth b))
      (p a) (p b) (IZR (of_steps a) + 1) (IZR (of_steps b) + 1)
      (m ^ pred (degree a)) (m ^ pred (degree b)) (IZR (monomials a)) (IZR (monomials b))
      (conj (q_ge _) (q_small (depth a) ltac:(lia))) (conj (q_ge _) (q_small (depth b) ltac:(lia)))
      (exact_permanent _ a) (exact_permanent _ b) wa0 wb0 (M_ge _) (M_ge _) ma mb (Rle_trans _ _ _ Rle_0_1 (proj1
        (counts_real a))) (Rle_trans _ _ _ Rle_0_1 (proj1 (counts_real b)))
      X16 Y IHa IHb) as D.
    replace (q (depth a) * q (depth b)) with (q (depth a + depth b)) in D by (unfold q; apply pow_add).
    rewrite (Rmult_assoc l) in D. pose proof (exact_permanent computed (Product a b)) as ep.
      cbn [exact permanent] in ep.
    assert (N1 : 1 <= m * m ^ pred (degree a) * m ^ pred (degree b)).
    { rewrite Rmult_assoc, <- pow_add. change (1 <= m ^ S (pred (degree a) + pred (degree b))). apply M_ge. }
    pose proof (fun u v w => step_error _ _ _ _ _ _ _ rounded u ep v w D) as S_.
    specialize (S_ ltac:(lia) ltac:(lra) N1).
    cbn [exact permanent of_steps depth degree]. rewrite !plus_IZR, !mult_IZR, !plus_IZR. eapply Rle_trans; [exact S_|].
    replace (pred (degree a + degree b)) with (S (pred (degree a) + pred (degree b))) by lia.
    cbn [pow]. rewrite pow_add. set (N := m * m ^ pred (degree a) * m ^ pred (degree b)) in *.
    replace (m * (m ^ pred (degree a) * m ^ pred (degree b))) with N by (unfold N; ring).
    apply Rplus_le_compat_l. rewrite (Rmult_assoc l _ N). apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; lra.
  - destruct a; try discriminate. cbn [exact permanent of_steps depth degree]. unfold Errors.val.
    pose proof (run (Magnitude (Difference c))) as v. simpl in v. rewrite v. unfold computed, Errors.val.
    destruct (in_range c) as (x & -> & _). simpl. replace (Rabs x - Rabs x) with 0 by ring. rewrite Rabs_R0. unfold q.
      simpl. lra.
Qed.

End Polynomials.
