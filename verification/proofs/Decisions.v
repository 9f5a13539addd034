(* When a control value beyond its bound proves the sign of the exact one. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling.
Open Scope R_scope.

Section Decisions.
Variable f : format.
Context {component : Type} {known : Distinguished component}.
Notation expr := (expr_of component).
Implicit Types e a b : expr.
Hypothesis ok : reasonable f.
Variables from to : component -> R.
Variable value_of : expr -> value.
Hypothesis run : execution f from to value_of.
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation val := (val value_of).
Notation d := (computed value_of).
Notation D := (exactly from to).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).
Notation l_pos := (l0 f). Notation l_small := (l1 f ok). Notation e_pos := (e0 f). Notation e_small := (e_le f ok).
Notation step_of := (step_of f ok from to value_of run in_range).
Notation number := (number f ok from to value_of run in_range).

(* M, the largest magnitude, and m = 1 + M. *)
Variable M : expr.
Hypothesis M_maxima : maxima M = true.
Hypothesis M_all : forall c, occurs c M = true.
Hypothesis M_fits : fits M = true.
Definition m := 1 + val M.
Lemma M_pos : 0 <= val M. Proof. exact (maxima_pos f ok from to value_of run in_range M M_maxima M_fits). Qed.
Lemma m1 : 1 <= m. Proof. unfold m. pose proof M_pos. lra. Qed.
Lemma d_m c : Rabs (d c) <= m.
Proof.
  eapply Rle_trans; [exact (maxima_bound f ok from to value_of run in_range M c M_maxima M_fits (M_all c))|].
  pose proof l_small. pose proof M_pos. unfold m. apply Rmax_lub; lra.
Qed.

Lemma fits_product a b : fits (Product a b) = true -> fits a = true /\ fits b = true.
Proof. apply fits_parts. auto. Qed.
Lemma fits_sum a b : fits (Sum a b) = true -> fits a = true /\ fits b = true.
Proof. apply fits_parts. auto. Qed.
Lemma fits_larger a b : fits (Larger a b) = true -> fits a = true /\ fits b = true.
Proof. apply fits_parts. auto. Qed.
Lemma fits_smaller a b : fits (Smaller a b) = true -> fits a = true /\ fits b = true.
Proof. apply fits_parts. auto. Qed.
Lemma constant c : val (Constant c) = constant_value f c.
Proof. unfold Errors.val. pose proof (run (Constant c)) as v. simpl in v. now rewrite v. Qed.
Lemma eta_large : 512 * l <= power (Arithmetic.underflow f).
Proof.
  unfold lam, power. change 512 with (bpow radix2 9). rewrite <- bpow_plus. apply bpow_le. destruct ok; lia.
Qed.
Lemma u_large : 1099511627776 * l <= u.
Proof.
  unfold lam, unit_roundoff, power. change 1099511627776 with (bpow radix2 40). rewrite <- bpow_plus. apply bpow_le.
    destruct ok; lia.
Qed.
Lemma u_small : u <= / 16777216. Proof. pose proof e_small. pose proof (eps_twice f). lra. Qed.

Definition more := Sum M (Constant (Small 1)).
Definition margin : expr := Product (Product more more) (Constant Underflow).
Lemma rounds_below' z r : rounds f z r -> 0 <= z -> (1 - e1) * z - l <= r.
Proof. exact (rounds_below f ok z r). Qed.
Lemma margin_large : fits margin = true -> 510 * l * m ^ 2 <= val margin.
Proof.
  intro fit. destruct (fits_product _ _ fit) as [fit2 _]. destruct (fits_product _ _ fit2) as [fit1 _].
  pose proof (step_of _ fit1) as S1. pose proof (step_of _ fit2) as S2. pose proof (step_of _ fit) as S3.
  destruct S1 as (x & y & cx & cy & r1). destruct S2 as (a & b & ca & cb & r2). destruct S3 as (v & w & cv & cw & r3).
  pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof M_pos as M0.
    pose proof m1 as M1.
  pose proof eta_large as eta. rewrite constant in cy, cw. cbn [constant_value] in *.
  apply (unflushed f) in cy; [|lra]. subst y. pose proof (counts_error _ _ _ cx) as ex. apply Rabs_le_inv in ex.
  assert (more_large : (1 - / 1000000) * m <= val more).
  { pose proof (rounds_below' _ _ r1 ltac:(lra)) as low. unfold m in *.
    assert (e1 * (x + 1) <= / 8388608 * (x + 1)) by (apply Rmult_le_compat_r; lra). lra. }
  apply (unflushed f) in ca; [|lra]. apply (unflushed f) in cb; [|lra]. subst a b.
  assert (squared : (1 - / 100000) * m ^ 2 <= val (Product more more)).
  { pose proof (rounds_below' _ _ r2 ltac:(nra)) as low.
    assert ((1 - / 1000000) * m * ((1 - / 1000000) * m) <= val more * val more) by (apply Rmult_le_compat; lra).
    assert (e1 * (val more * val more) <= / 8388608 * (val more * val more)) by (apply Rmult_le_compat_r; nra).
    assert (1 <= m ^ 2) by (simpl; nra). replace (m ^ 2) with (m * m) in * by ring. lra. }
  assert (1 <= m ^ 2) by (simpl; nra).
  apply (unflushed f) in cv; [|lra]. apply (unflushed f) in cw; [|lra]. subst v w.
  assert (z_large : (1 - / 100000) * m ^ 2 * (512 * l) <= val (Product more more) * power (Arithmetic.underflow f))
    by (apply Rmult_le_compat; lra).
  assert (0 <= m ^ 2 * l) by nra.
  pose proof (rounds_below' _ _ r3 ltac:(lra)) as low. fold margin in low.
  set (z := val (Product more more) * power (Arithmetic.underflow f)) in *.
  assert (e1 * z <= / 8388608 * z) by (apply Rmult_le_compat_r; lra).
  assert (l * 1 <= l * m ^ 2) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* A bound: a constant number of roundoffs times a size, and the margin. *)
Definition roundoffs n (size_ : expr) := Product (Product (Constant UnitRoundoff) (Constant (Small n))) size_.
Lemma roundoffs_large n size_ t : fits (roundoffs n size_) = true -> (1 <= n <= 100)%Z -> 0 <= t ->
  (1 - sigma) * t - 400 * l * m ^ 2 <= val size_ ->
  (1 - 2 * sigma) * (IZR n * u) * t - 3 * l * m ^ 2 <= val (roundoffs n size_).
Proof.
  intros fit n_le t0 large. destruct (fits_product _ _ fit) as [fit1 _].
  pose proof (step_of _ fit1) as S1. pose proof (step_of _ fit) as S2.
  destruct S1 as (x & y & cx & cy & r1). destruct S2 as (a & b & ca & cb & r2). rewrite !constant in *.
    cbn [constant_value] in *.
  pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof u_large. pose proof u_small. 
  assert (n1 : 1 <= IZR n <= 100) by (split; apply IZR_le; lia).
  apply (unflushed f) in cx; [|lra]. apply (unflushed f) in cy; [|lra]. subst x y. 
  set (C := val (Product (Constant UnitRoundoff) (Constant (Small n)))) in *.
  assert (nu : u * 1 <= u * IZR n) by (apply Rmult_le_compat_l; lra).
  assert (nu2 : u * IZR n <= / 16777216 * 100) by (apply Rmult_le_compat; lra).
  assert (C_large : (1 - / 1000000) * (u * IZR n) <= C).
  { pose proof (rounds_below' _ _ r1 ltac:(lra)) as low.
    assert (e1 * (u * IZR n) <= / 8388608 * (u * IZR n)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (C_small : C <= / 10000).
  { pose proof (rounding_error f ok _ _ r1) as E. rewrite (Rabs_pos_eq (u * IZR n)) in E by lra. apply Rabs_le_inv in E.
    assert (e1 * (u * IZR n) <= / 8388608 * (u * IZR n)) by (apply Rmult_le_compat_r; lra). lra. }
  apply (unflushed f) in ca; [|lra]. subst a. pose proof (counts_error _ _ _ cb) as eb. apply Rabs_le_inv in eb.
  assert (1 <= m ^ 2) by (pose proof m1; simpl; nra). assert (L2 : l * 1 <= l * m ^ 2) by (apply Rmult_le_compat_l;
    lra).
  assert (b_large : (1 - sigma) * t - 401 * (l * m ^ 2) <= b) by lra.
  set (N := l * m ^ 2) in *. assert (0 <= N) by lra.
  assert (z_large : C * ((1 - sigma) * t) - N <= C * b).
  { assert (C * ((1 - sigma) * t - 401 * N) <= C * b) by (apply Rmult_le_compat_l; lra).
    assert (C * (401 * N) <= / 10000 * (401 * N)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (s01 : 0 <= 1 - sigma <= 1) by (unfold sigma; lra).
  assert (st0 : 0 <= (1 - sigma) * t) by (apply Rmult_le_pos; lra).
  assert (Ct : (1 - / 1000000) * (u * IZR n) * ((1 - sigma) * t) <= C * ((1 - sigma) * t)) by (apply Rmult_le_compat_r;
    lra).
  assert (Ct0 : 0 <= C * ((1 - sigma) * t)) by (apply Rmult_le_pos; lra).
  pose proof (rounding_error f ok _ _ r2) as E. apply Rabs_le_inv in E.
  fold (roundoffs n size_) in E.
  assert (low : (1 - / 8388608) * (C * ((1 - sigma) * t)) - 3 * N <= val (roundoffs n size_)).
  { destruct (Rle_lt_dec 0 (C * b)) as [pos|neg].
    - rewrite (Rabs_pos_eq _ pos) in E. assert (e1 * (C * b) <= / 8388608 * (C * b)) by (apply Rmult_le_compat_r; lra).
      lra.
    - rewrite Rabs_left in E by assumption.
      assert (e1 * - (C * b) <= / 8388608 * - (C * b)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (0 <= u * IZR n * t) by (apply Rmult_le_pos; lra).
  assert ((1 - 2 * sigma) * (IZR n * u) * t <= (1 - / 8388608) * ((1 - / 1000000) * (u * IZR n) * ((1 - sigma) * t))).
  { replace ((1 - 2 * sigma) * (IZR n * u) * t) with ((1 - 2 * sigma) * (u * IZR n * t)) by ring.
    replace ((1 - / 8388608) * ((1 - / 1000000) * (u * IZR n) * ((1 - sigma) * t))) with
      (((1 - / 8388608) * (1 - / 1000000) * (1 - sigma)) * (u * IZR n * t)) by ring.
    apply Rmult_le_compat_r; [assumption|]. unfold sigma; lra. }
  replace (3 * l * m ^ 2) with (3 * N) by (unfold N; ring). lra.
Qed.
Lemma bound_large n size_ t : fits (Sum (roundoffs n size_) margin) = true -> (1 <= n <= 100)%Z -> 0 <= t ->
  (1 - sigma) * t - 400 * l * m ^ 2 <= val size_ ->
  (1 - 3 * sigma) * (IZR n * u) * t + 500 * l * m ^ 2 <= val (Sum (roundoffs n size_) margin).
Proof.
  intros fit n_le t0 large. destruct (fits_sum _ _ fit) as [fa fb].
  pose proof (roundoffs_large n size_ t fa n_le t0 large) as A. pose proof (margin_large fb) as B.
  destruct (step_of _ fit) as (x & y & cx & cy & r).
  pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof u_large. 
  assert (1 <= m ^ 2) by (pose proof m1; simpl; nra). assert (L2 : l * 1 <= l * m ^ 2) by (apply Rmult_le_compat_l;
    lra).
  apply (unflushed f) in cy; [|lra]. subst y. pose proof (counts_error _ _ _ cx) as ex. apply Rabs_le_inv in ex.
  assert (n1 : 1 <= IZR n) by (apply IZR_le; lia).
  assert (nut : 0 <= IZR n * u * t) by (repeat apply Rmult_le_pos; lra).
  assert (z : (1 - 2 * sigma) * (IZR n * u) * t + 506 * (l * m ^ 2) <= x + val margin) by lra.
  assert (zp : 0 <= (1 - 2 * sigma) * (IZR n * u) * t) by (rewrite Rmult_assoc; apply Rmult_le_pos; [unfold sigma;
    lra|assumption]).
  pose proof (rounds_below' _ _ r ltac:(lra)) as low.
  assert (e1 * (x + val margin) <= / 8388608 * (x + val margin)) by (apply Rmult_le_compat_r; lra).
  assert ((1 - 3 * sigma) * (IZR n * u) * t <= (1 - / 8388608) * ((1 - 2 * sigma) * (IZR n * u) * t)).
  { replace ((1 - 3 * sigma) * (IZR n * u) * t) with ((1 - 3 * sigma) * (IZR n * u * t)) by ring.
    replace ((1 - / 8388608) * ((1 - 2 * sigma) * (IZR n * u) * t)) with ((1 - / 8388608) * (1 - 2 * sigma) * (IZR n * u
      * t)) by ring.
    apply Rmult_le_compat_r; [assumption|]. unfold sigma; lra. }
  lra.
Qed.

(* The distance of a control value, a sum, from the exact one before its last rounding; and its sign, from a bound. *)
Definition losses a b := (of_steps a + 1 + (of_steps b + 1) + of_differences (Sum a b))%Z.
Theorem near a b n : polynomial (Sum a b) = true -> signed (Sum a b) = true -> fits (Sum a b) = true ->
  degree (Sum a b) = 3%nat -> (depth a <= n)%nat -> (depth b <= n)%nat ->
  exists z, rounds f z (val (Sum a b)) /\
    Rabs (z - exact D (Sum a b)) <= (q f n + q f 3 - 2) * permanent d (Sum a b) + l * IZR (losses a b) * m ^ 2.
Proof.
  intros poly sig fit deg da db.
  destruct (fits_parts a b (Sum a b) ltac:(auto) fit) as [fa fb]. pose proof poly as h. cbn [polynomial] in h.
  apply andb_prop in h as [_ h]. apply andb_prop in h as [pa pb].
  destruct (step_of _ fit) as (x & y & cx & cy & rounded). exists (x + y). split; [exact rounded|].
  pose proof (error_of_steps f ok m m1 from to value_of run in_range d_m a pa fa) as wa.
  pose proof (error_of_steps f ok m m1 from to value_of run in_range d_m b pb fb) as wb.
  pose proof (sum_before_rounding f m m1 value_of a b x y Rplus ltac:(auto) cx cy wa wb) as S_.
  pose proof (error_of_differences f ok m m1 d D d_m (off f ok from to value_of run in_range) (Sum a b) poly sig
    ltac:(lia)) as X_.
  rewrite deg in X_. cbn [degree] in deg. rewrite deg in S_. cbn [exact permanent pred] in *. 
  pose proof (permanent_pos d (Sum a b)) as pp. cbn [permanent] in pp.
  pose proof (q_mono f (Nat.max (depth a) (depth b)) n ltac:(lia)) as qn.
  assert ((q f (Nat.max (depth a) (depth b)) - 1) * (permanent d a + permanent d b) <= (q f n - 1) * (permanent d a +
    permanent d b))
    by (apply Rmult_le_compat_r; lra).
  unfold losses. rewrite !plus_IZR. apply Rabs_le_inv in S_. apply Rabs_le_inv in X_.
  change (Init.Nat.pred 3) with 2%nat in *. apply Rabs_le. lra.
Qed.
Theorem sign_of (z k e b : R) : rounds f z k -> Rabs (z - e) <= b -> representable f b -> (b < k -> 0 < e) /\
  (k < - b -> e < 0).
Proof.
  intros rounded close rep. pose proof (Rabs_pos (z - e)). apply Rabs_le_inv in close. split; intro beyond_.
  - pose proof (above_before_rounding f ok _ _ _ rounded rep ltac:(lra) beyond_). lra.
  - pose proof (below_before_rounding f ok _ _ _ rounded rep ltac:(lra) beyond_). lra.
Qed.

Lemma q3 : q f 3 <= 1 + 3.001 * e1.
Proof. unfold q. pose proof e_pos. pose proof e_small. simpl. assert (e1 * e1 <= / 8388608 * e1) by (apply
  Rmult_le_compat_r; lra).
  assert (e1 * e1 * e1 <= / 8388608 * e1) by (apply Rmult_le_compat_r; lra). lra. Qed.
Lemma q6 : q f 6 <= 1 + 6.01 * e1.
Proof.
  pose proof q3 as Q. pose proof (q_ge f 3). pose proof e_pos. pose proof e_small. 
  replace (q f 6) with (q f 3 * q f 3) by (unfold q; ring).
  assert (q f 3 * q f 3 <= (1 + 3.001 * e1) * (1 + 3.001 * e1)) by (apply Rmult_le_compat; lra).
  assert (e1 * e1 <= / 8388608 * e1) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma q4 : q f 4 <= 1 + 4.01 * e1.
Proof.
  pose proof q3 as Q. pose proof (q_ge f 3). pose proof e_pos. pose proof e_small. 
  replace (q f 4) with (q f 3 * (1 + e1)) by (unfold q; ring).
  assert (q f 3 * (1 + e1) <= (1 + 3.001 * e1) * (1 + e1)) by (apply Rmult_le_compat_r; lra).
  assert (e1 * e1 <= / 8388608 * e1) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* Comparisons. *)
Lemma greater_above x y : greater f (Number x) (Number y) -> l <= y -> y < x.
Proof.
  pose proof l_pos. intros (v & w & cv & cw & b) big. destruct (counts_val f _ _ _ eq_refl cv) as (x' & -> & cx).
  destruct (counts_val f _ _ _ eq_refl cw) as (y' & -> & cy). apply (unflushed f) in cy; [|assumption]. subst y'.
  simpl in b. destruct cx as [->|[_ ->]]; lra.
Qed.
Lemma greater_below x y : greater f (Number (- y)) (Number x) -> l <= y -> x < - y.
Proof.
  pose proof l_pos. intros (v & w & cv & cw & b) big. destruct (counts_val f _ _ _ eq_refl cv) as (y' & -> & cy).
  destruct (counts_val f _ _ _ eq_refl cw) as (x' & -> & cx).
  assert (y' = - y) as ->. { destruct cy as [->|[small ->]]; [reflexivity|]. rewrite Rabs_Ropp, Rabs_pos_eq in small;
    lra. }
  simpl in b. destruct cx as [->|[_ ->]]; lra.
Qed.
Lemma smaller_both a b : fits (Smaller a b) = true -> l <= val (Smaller a b) -> val (Smaller a b) <= val a /\
  val (Smaller a b) <= val b.
Proof.
  intros fit big. destruct (fits_parts a b _ ltac:(auto) fit) as [fa fb]. pose proof (run (Smaller a b)) as v.
    simpl in v.
  rewrite (number _ fit), (number _ fa), (number _ fb) in v. pose proof l_pos.
  destruct v as (v & w & cv & cw & which); try discriminate.
  destruct (counts_val f _ _ _ eq_refl cv) as (x & -> & cx). destruct (counts_val f _ _ _ eq_refl cw) as (y & -> & cy).
  destruct which as [[b_ c]|[b_ c]]; simpl in b_; destruct (counts_val f _ _ _ eq_refl c) as (r & E & cr);
    injection E as <-; 
    destruct cr as [cr|[_ cr]]; destruct cx as [cx|[? cx]]; destruct cy as [cy|[? cy]]; try lra; 
    try (rewrite Rabs_pos_eq in * by lra); lra.
Qed.
Lemma larger_both a b : fits (Larger a b) = true -> val (Larger a b) <= - l -> val a <= val (Larger a b) /\
  val b <= val (Larger a b).
Proof.
  intros fit big. destruct (fits_parts a b _ ltac:(auto) fit) as [fa fb]. pose proof (run (Larger a b)) as v.
    simpl in v.
  rewrite (number _ fit), (number _ fa), (number _ fb) in v. pose proof l_pos.
  destruct v as (v & w & cv & cw & which); try discriminate.
  destruct (counts_val f _ _ _ eq_refl cv) as (x & -> & cx). destruct (counts_val f _ _ _ eq_refl cw) as (y & -> & cy).
  destruct which as [[b_ c]|[b_ c]]; simpl in b_; destruct (counts_val f _ _ _ eq_refl c) as (r & E & cr);
    injection E as <-; 
    destruct cr as [cr|[_ cr]]; destruct cx as [cx|[? cx]]; destruct cy as [cy|[? cy]]; try lra; 
    try (rewrite Rabs_left1 in * by lra); lra.
Qed.
End Decisions.
