(* Directions with a separation: the bar that the code computes is at least the error of a product and the separation
  times
   the direction's length. core/src/kernels/advance/directions.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Least Directions Held.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

(* The code's terms. *)
Definition length_above v := Select (Greater (dot_ v v) (Constant SafeSquare)) (Root (dot_ v v))
  (Sum (Sum (Magnitude (vx v)) (Magnitude (vy v))) (Sum (Magnitude (vz v)) (Constant ExtentUnderflow))).
Definition more_roundoffs n := Sum one (roundoffs n).
Definition clearance k := Product (Input (Length Separation)) (Product (length_above (direction k)) (more_roundoffs
  32)).
Definition bar_beyond pairs k := Sum (bar pairs k) (clearance k).

(* The length of a vector. That of a sum is at most that of its parts. *)
Definition norm (w : Expressions.axis -> R) := sqrt (squared w).
Lemma norm_pos w : 0 <= norm w. Proof. apply sqrt_pos. Qed.
Lemma norm_below_sum w : norm w <= sum3 (fun a => Rabs (w a)).
Proof.
  unfold norm. assert (P : 0 <= sum3 (fun a => Rabs (w a))).
  { unfold sum3. pose proof (Rabs_pos (w Expressions.X)). pose proof (Rabs_pos (w Expressions.Y)).
    pose proof (Rabs_pos (w Expressions.Z_)). lra. }
  rewrite <- (sqrt_square _ P). apply sqrt_le_1_alt. unfold squared, sum3 in *.
  assert (sq : forall a, w a * w a = Rabs (w a) * Rabs (w a)).
  { intro a. rewrite <- Rabs_mult, Rabs_pos_eq; [reflexivity|apply Rle_0_sqr]. }
  rewrite !sq. pose proof (Rabs_pos (w Expressions.X)) as X. pose proof (Rabs_pos (w Expressions.Y)) as Y.
  pose proof (Rabs_pos (w Expressions.Z_)) as Z. pose proof (Rmult_le_pos _ _ X Y). pose proof (Rmult_le_pos _ _ Y Z).
  pose proof (Rmult_le_pos _ _ X Z). lra.
Qed.
Lemma norm_sum v w : norm (fun a => v a + w a) <= norm v + norm w.
Proof.
  pose proof (norm_pos v) as V0. pose proof (norm_pos w) as W0. pose proof (squared_pos v) as sv.
  pose proof (squared_pos w) as sw.
  assert (vv : norm v * norm v = squared v) by (apply sqrt_sqrt; exact sv).
  assert (ww : norm w * norm w = squared w) by (apply sqrt_sqrt; exact sw).
  unfold norm at 1. rewrite <- (sqrt_square (norm v + norm w)) by lra. apply sqrt_le_1_alt.
  set (d := sum3 (fun a => v a * w a)).
  assert (E : squared (fun a => v a + w a) = squared v + 2 * d + squared w) by (unfold squared, d, sum3; ring).
  assert (schwarz : d * d <= squared v * squared w).
  { unfold d, squared, sum3. set (a := v Expressions.X). set (b := v Expressions.Y). set (c := v Expressions.Z_).
    set (p := w Expressions.X). set (q := w Expressions.Y). set (r := w Expressions.Z_).
    pose proof (pow2_ge_0 (a * q - b * p)). pose proof (pow2_ge_0 (b * r - c * q)). pose proof (pow2_ge_0 (a * r - c *
      p)). lra. }
  assert (dn : d <= norm v * norm w).
  { apply Rnot_lt_le. intro h. assert (p0 : 0 <= norm v * norm w) by (apply Rmult_le_pos; lra).
    assert (norm v * norm w * (norm v * norm w) < d * d) by (apply Rmult_le_0_lt_compat; lra).
    replace (norm v * norm w * (norm v * norm w)) with ((norm v * norm v) * (norm w * norm w)) in H by ring.
    rewrite vv, ww in H. lra. }
  rewrite E. replace ((norm v + norm w) * (norm v + norm w)) with (norm v * norm v + 2 * (norm v * norm w) + norm w *
    norm w) by ring. lra.
Qed.
Lemma norm_scaled c w : 0 <= c -> norm (fun a => c * w a) = c * norm w.
Proof.
  intro c0. unfold norm. replace (squared (fun a => c * w a)) with ((c * c) * squared w) by (unfold squared, sum3;
    ring).
  rewrite sqrt_mult by (try apply Rle_0_sqr; apply squared_pos). now rewrite sqrt_square.
Qed.

Section Beyond.
Load "Setting.section".
Notation safe := (power (safe_square f)).
Notation along := (along f env given).
Notation is_short := (is_short f env given).
Notation s := (given (Length Separation)).
(* A subnormal separation is raised, and a large one proves nothing. *)
Hypothesis separation : l <= s <= power (largest_extent f).
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).
Notation run_root := (run_root f env given value_of run).
Notation run_constant := (run_constant f env given value_of run).
Notation run_input := (run_input f env given value_of run).

Lemma safe_large : 4 * l <= u * safe.
Proof.
  unfold lam, unit_roundoff, power. rewrite <- bpow_plus. change 4 with (bpow radix2 2). rewrite <- bpow_plus.
  apply bpow_le. pose proof (Corners.safe f fine). lia.
Qed.
Lemma safe_1 : 0 < safe <= 1.
Proof.
  split; [apply bpow_gt_0|]. change 1 with (bpow radix2 0). apply bpow_le. pose proof (Corners.safe f fine). lia.
Qed.
Lemma roundoffs_value n : (1 <= n <= 255)%Z -> exists x, value_of (roundoffs n) = Number x /\
  (1 - e1) * (IZR n * u) <= x <= (1 + e1) * (IZR n * u).
Proof.
  intro n255. destruct (here roundoffs_holds n n255) as (x & E & _ & d & _ & _).
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_e f fine).
  pose proof (eps_twice f) as eu. destruct n255 as [n1 n2]. apply IZR_le in n1. apply IZR_le in n2.
  pose proof (run_product (Constant (Small n)) (Constant UnitRoundoff)) as h. rewrite !run_constant in h.
  unfold product in h. cbn in h. assert (lu : l <= u) by lra.
  rewrite (seen_large f env (IZR n)), (seen_large f env u) in h by (try exact lu; pose proof (l_small f ok); lra).
  assert (nu : u <= IZR n * u <= 255 * u) by (split; [rewrite <- (Rmult_1_l u) at 1|]; apply Rmult_le_compat_r; lra).
  pose proof (omega_pos f fine). apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
  exists (Rd (IZR n * u)). split; [exact h|]. apply (normal_error f fine env). lra.
Qed.
Lemma more_value n : (1 <= n <= 64)%Z -> exists c, value_of (more_roundoffs n) = Number c /\
  1 + (IZR n / 2 - 1.1) * e1 <= c <= 1.0001.
Proof.
  intros [n1 n2]. destruct (roundoffs_value n ltac:(lia)) as (x & Ex & x1 & x2). apply IZR_le in n1, n2.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (l_e f fine). pose proof (eps_twice f) as eu. pose proof (omega_pos f fine).
  assert (eu2 : 0 <= e1 * u <= / 8388608 * u) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  set (k := IZR n) in *. assert (ke : e1 <= k * e1 <= 64 * e1) by (split; [rewrite <- (Rmult_1_l e1) at 1|];
    apply Rmult_le_compat_r; lra).
  assert (ku : k * e1 = 2 * (k * u)) by (rewrite eu; ring).
  assert (kee : 0 <= e1 * (k * u) <= e1 * (32 * e1)). { split; [repeat apply Rmult_le_pos; lra|].
    apply Rmult_le_compat_l; lra. }
  assert (e2 : 0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (xs : k / 2 * e1 - 0.0001 * e1 <= x <= 32.01 * e1) by lra.
  pose proof (run_sum one (roundoffs n)) as h. fold (more_roundoffs n) in h. unfold one in h at 1.
  rewrite run_constant, Ex in h. unfold sum in h. cbn in h. rewrite (seen_large f env 1), (seen_large f env x) in h by
    lra. apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
  destruct (normal_error f fine env (1 + x) ltac:(lra)) as [c1 c2].
  assert (ex : 0 <= e1 * x <= e1 * (32.01 * e1)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra]).
  assert (ee : 0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  exists (Rd (1 + x)). split; [exact h|]. lra.
Qed.

(* The computed length, before its slack. *)
Theorem length_value k : is_short k -> exists len, value_of (length_above (direction k)) = Number len /\ l <= len /\
  len <= 3.3 * G /\ norm (along k) <= (1 + 3.4 * e1) * len.
Proof.
  intro short. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (l_e f fine) as le. pose proof (eps_twice f) as eu. pose proof (omega_pos f fine).
  pose proof (G_4 f fine) as G4. pose proof (G_2 f fine) as G2. pose proof safe_large as sl. pose proof safe_1 as s1.
  pose proof (mu_l f fine) as mul. pose proof (mu_1 f fine) as mu1. pose proof (mu_pos f) as mu0.
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  set (X := Rabs (along k Expressions.X)). set (Y := Rabs (along k Expressions.Y)).
  set (Z := Rabs (along k Expressions.Z_)).
  assert (X0 : 0 <= X <= G) by (split; [apply Rabs_pos|apply short]).
  assert (Y0 : 0 <= Y <= G) by (split; [apply Rabs_pos|apply short]).
  assert (Z0 : 0 <= Z <= G) by (split; [apply Rabs_pos|apply short]).
  (* The sum of squares. *)
  assert (XX : 0 <= X * X <= G * G) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  assert (YY : 0 <= Y * Y <= G * G) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  assert (ZZ : 0 <= Z * Z <= G * G) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  set (W := squared (along k)).
  assert (WX : W = X * X + Y * Y + Z * Z).
  { unfold W, squared, sum3, X, Y, Z. rewrite <- !Rabs_mult, !Rabs_pos_eq by apply Rle_0_sqr. reflexivity. }
  assert (D : exists Q, value_of (dot_ (direction k) (direction k)) = Number Q /\ Rabs (Q - W) <= 3.01 * e1 * W + 9.2 *
    l).
  { pose proof (here dot_holds (direction k) (direction k) (along k) (along k) (fun a => Rabs
      (along k a)) (fun a => Rabs (along k a)) (fun _ => 0) (fun _ => 0) 0 0 (along_operand f env given value_of run k)
        (along_operand f env given value_of run k) ltac:(lia)) as d.
    cbv zeta in d. unfold sum3 in d. fold X Y Z in d.
    destruct d as (Q & EQ & _ & dq & _ & _); [lra|lra|]. exists Q. split; [exact EQ|].
    replace (along k Expressions.X * along k Expressions.X + along k Expressions.Y * along k Expressions.Y + along k
      Expressions.Z_ * along k Expressions.Z_) with W in dq by (unfold W, squared, sum3; reflexivity).
    rewrite <- WX in dq. change (3 + 0 + 0)%nat with 3%nat in dq.
    pose proof (q_linear f ok 3 ltac:(lia)) as q3. replace (INR 3) with 3 in q3 by (simpl; ring).
    assert ((Bounds.q f 3 - 1) * W <= 3.01 * e1 * W) by (apply Rmult_le_compat_r; lra). lra. }
  destruct D as (Q & EQ & dQ). apply Rabs_le_inv in dQ.
  assert (W0 : 0 <= W <= 3 * (G * G)) by lra.
  assert (eW : 0 <= e1 * W <= / 8388608 * W) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lsafe : l <= safe).
  { assert (u * safe <= 1 * safe) by (apply Rmult_le_compat_r; lra). lra. }
  set (m := Greater (dot_ (direction k) (direction k)) (Constant SafeSquare)).
  set (plain := Sum (Sum (Magnitude (vx (direction k))) (Magnitude (vy (direction k)))) (Sum (Magnitude (vz (direction
    k))) (Constant ExtentUnderflow))).
  pose proof (run (length_above (direction k))) as h. unfold length_above in h. fold m plain in h.
  cbn -[m plain dot_ direction] in h. fold (length_above (direction k)) in h. fold m plain in h.
  change (Select m (Root (dot_ (direction k) (direction k))) plain) with (length_above (direction k)) in h.
  destruct h as [[big E]|[_ E]].
  - (* The root. *)
    unfold m in big. cbn -[dot_ direction] in big. rewrite EQ, run_constant in big. cbn in big.
    rewrite (seen_large f env safe lsafe) in big.
    assert (sQ : seen Q = Q) by (apply seen_positive; lra). rewrite sQ in big.
    pose proof (run_root (dot_ (direction k) (direction k))) as r. rewrite EQ in r. unfold root in r. cbn in r.
    rewrite sQ in r. destruct r as [r _]. specialize (r ltac:(lra)).
    assert (roots : l <= sqrt Q <= 1.75 * G).
    { split.
      - rewrite <- (sqrt_square l) by lra. apply sqrt_le_1_alt. apply Rle_trans with (1 * l); [apply Rmult_le_compat_r;
          lra|lra].
      - rewrite <- (sqrt_square (1.75 * G)) by lra. apply sqrt_le_1_alt.
        assert (Q <= 3.05 * (G * G)) by lra. lra. }
    assert (rq : 0 <= sqrt Q) by apply sqrt_pos.
    apply (number_if_small f fine env) in r; [|rewrite Rabs_pos_eq by exact rq; lra].
    exists (Rd (sqrt Q)). split; [rewrite E; exact r|]. destruct (normal_error f fine env (sqrt Q) ltac:(lra)) as [n1
      n2].
    assert (root_l : 2 * l <= sqrt Q).
    { rewrite <- (sqrt_square (2 * l)) by lra. apply sqrt_le_1_alt.
      assert (l * l <= / 1000 * l) by (apply Rmult_le_compat_r; lra). lra. }
    assert (er : 0 <= e1 * sqrt Q <= / 8388608 * sqrt Q) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
      lra]).
    split; [lra|]. split; [lra|].
    assert (WQ : W <= (1 + 1.2 * e1) * (1 + 1.2 * e1) * (1 + 2 * e1) * Q).
    { assert (u * safe <= u * Q) by (apply Rmult_le_compat_l; lra).
      assert (eQ : e1 * Q = 2 * (u * Q)) by (rewrite eu; ring). assert (e1Q : 0 <= e1 * Q <= / 8388608 * Q) by
        (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
      assert (WQ1 : W <= 1.01 * Q) by lra.
      assert (e1 * W <= e1 * (1.01 * Q)) by (apply Rmult_le_compat_l; lra).
      assert (0 <= e1 * (e1 * Q)) by (apply Rmult_le_pos; lra).
      assert (0 <= e1 * (e1 * (e1 * Q))) by (repeat apply Rmult_le_pos; lra). lra. }
    unfold norm. fold W.
    apply Rle_trans with (sqrt (((1 + 1.2 * e1) * (1 + e1)) * ((1 + 1.2 * e1) * (1 + e1)) * Q)).
    + apply sqrt_le_1_alt. eapply Rle_trans; [exact WQ|]. apply Rmult_le_compat_r; [lra|].
      assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra).
      replace ((1 + 1.2 * e1) * (1 + e1) * ((1 + 1.2 * e1) * (1 + e1))) with ((1 + 1.2 * e1) * (1 + 1.2 * e1) * ((1 +
        e1) * (1 + e1))) by ring. apply Rmult_le_compat_l; [apply Rle_0_sqr|lra].
    + rewrite sqrt_mult by (try apply Rle_0_sqr; lra). rewrite sqrt_square by (apply Rmult_le_pos; lra).
      assert (e1 * e1 <= / 8388608 * e1) by (apply Rmult_le_compat_r; lra).
      apply Rle_trans with ((1 + 3.4 * e1) * ((1 - e1) * sqrt Q)); [|apply Rmult_le_compat_l; lra].
      rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [exact rq|]. lra.
  - (* The sum of magnitudes. *)
    assert (mags : forall a, value_of (Magnitude (Input (Along k a))) = Number (Rabs (given (Along k a)))).
    { intro a. rewrite (run (Magnitude _)), run_input. reflexivity. }
    assert (seen_mag : forall a, seen (Rabs (given (Along k a))) = Rabs (along k a)).
    { intro a. rewrite (seen_magnitude f env). reflexivity. }
    pose proof (run_sum (Magnitude (Input (Along k Expressions.X))) (Magnitude (Input (Along k Expressions.Y)))) as h1.
    rewrite !mags in h1. unfold sum in h1. cbn in h1. rewrite !seen_mag in h1. fold X Y in h1.
    apply (number_if_small f fine env) in h1; [|rewrite Rabs_pos_eq; lra].
    pose proof (run_sum (Magnitude (Input (Along k Expressions.Z_))) (Constant ExtentUnderflow)) as h2.
    rewrite mags, run_constant in h2. unfold sum in h2. cbn in h2. rewrite seen_mag in h2. fold Z in h2.
    rewrite (seen_large f env mu) in h2 by lra.
    apply (number_if_small f fine env) in h2; [|rewrite Rabs_pos_eq; lra].
    pose proof (error f ok env (X + Y)) as r1. rewrite (Rabs_pos_eq (X + Y)) in r1 by lra. apply Rabs_le_inv in r1.
    pose proof (normal_error f fine env (Z + mu) ltac:(lra)) as [r2 r2'].
    assert (eX : 0 <= e1 * (X + Y) <= / 8388608 * (X + Y)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
      lra]).
    assert (eZ : 0 <= e1 * (Z + mu) <= / 8388608 * (Z + mu)) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]).
    assert (s1p : 0 <= Rd (X + Y)) by (apply rounded_positive; lra).
    pose proof (run_sum (Sum (Magnitude (Input (Along k Expressions.X))) (Magnitude (Input (Along k Expressions.Y))))
      (Sum (Magnitude (Input (Along k Expressions.Z_))) (Constant ExtentUnderflow))) as h3.
    rewrite h1, h2 in h3. unfold sum in h3. cbn in h3. destruct (seen_low f env _ s1p) as [a1 a2].
    pose proof (seen_smaller f env (Rd (X + Y))) as a3. rewrite !Rabs_pos_eq in a3 by lra.
    rewrite (seen_large f env (Rd (Z + mu))) in h3 by lra.
    set (t := seen (Rd (X + Y)) + Rd (Z + mu)) in *.
    apply (number_if_small f fine env) in h3; [|rewrite Rabs_pos_eq; unfold t; lra].
    pose proof (normal_error f fine env t ltac:(unfold t; lra)) as [r3 r3'].
    assert (et : 0 <= e1 * t <= / 8388608 * t) by (split; [apply Rmult_le_pos; unfold t; lra|apply Rmult_le_compat_r;
      unfold t; lra]).
    exists (Rd t). split; [rewrite E; exact h3|]. split; [unfold t in *; lra|]. split; [unfold t in *; lra|].
    eapply Rle_trans; [apply norm_below_sum|]. unfold sum3. fold X Y Z.
    assert (em : 0 <= e1 * mu <= / 8388608 * mu) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]).
    assert (tl : (1 - e1) * (X + Y + Z) + / 2 * mu <= t) by (unfold t; lra).
    assert (eS : 0 <= e1 * (X + Y + Z)) by (apply Rmult_le_pos; lra).
    assert (low : (1 - e1) * ((1 - e1) * (X + Y + Z) + / 2 * mu) <= Rd t).
    { eapply Rle_trans; [|exact r3]. apply Rmult_le_compat_l; lra. }
    assert (up : (1 + 3.4 * e1) * ((1 - e1) * ((1 - e1) * (X + Y + Z) + / 2 * mu)) <= (1 + 3.4 * e1) * Rd t) by (apply
      Rmult_le_compat_l; lra).
    eapply Rle_trans; [|exact up].
    assert (eeS : 0 <= e1 * (e1 * (X + Y + Z)) <= / 8388608 * (e1 * (X + Y + Z))) by (split; [apply Rmult_le_pos; lra|
      apply Rmult_le_compat_r; lra]).
    assert (eeeS : 0 <= e1 * (e1 * (e1 * (X + Y + Z)))) by (apply Rmult_le_pos; lra).
    assert (eem : 0 <= e1 * (e1 * mu) <= / 8388608 * (e1 * mu)) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]). lra.
Qed.
Theorem clearance_value k : is_short k -> exists x, value_of (clearance k) = Number x /\ 0 <= x <= 1.8 * (G * G) /\
  (1 + 9 * e1) * (s * norm (along k)) - 1.1 * l <= seen x.
Proof.
  intro short. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (omega_pos f fine). pose proof (L_G f fine) as LG.
  pose proof (G_4 f fine) as G4. pose proof (G_2 f fine) as G2.
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct (length_value k short) as (len & El & ll & lG & ln). destruct (more_value 32 ltac:(lia)) as (c & Ec & c1 & c2).
  pose proof (run_product (length_above (direction k)) (more_roundoffs 32)) as h. rewrite El, Ec in h.
  unfold product in h. cbn in h. rewrite (seen_large f env len ll), (seen_large f env c) in h by lra.
  assert (lc : (1 + 14.9 * e1) * len <= len * c <= 6.6 * G).
  { split; [rewrite Rmult_comm; apply Rmult_le_compat_l; lra|].
    apply Rle_trans with (3.3 * G * 2); [apply Rmult_le_compat; lra|lra]. }
  assert (elen : 0 <= e1 * len) by (apply Rmult_le_pos; lra).
  apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
  pose proof (normal_error f fine env (len * c) ltac:(lra)) as [p1 p2].
  set (P := Rd (len * c)) in *. assert (Pl : (1 + 13.8 * e1) * len <= P).
  { eapply Rle_trans; [|exact p1]. apply Rle_trans with ((1 - e1) * ((1 + 14.9 * e1) * len)); [|apply
      Rmult_le_compat_l; lra].
    assert (0 <= e1 * (e1 * len) <= / 8388608 * (e1 * len)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
      lra]). lra. }
  assert (PG : P <= 6.7 * G).
  { assert (e1 * (len * c) <= / 8388608 * (len * c)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (NormP : (1 + 10.3 * e1) * norm (along k) <= P).
  { eapply Rle_trans; [|exact Pl]. apply Rle_trans with ((1 + 10.3 * e1) * ((1 + 3.4 * e1) * len)).
    - apply Rmult_le_compat_l; lra.
    - assert (0 <= e1 * (e1 * len) <= / 8388608 * (e1 * len)) by (split; [apply Rmult_le_pos; lra|apply
        Rmult_le_compat_r; lra]). lra. }
  pose proof (run_product (Input (Length Separation)) (Product (length_above (direction k)) (more_roundoffs 32))) as g.
  fold (clearance k) in g. rewrite run_input, h in g. unfold product in g. cbn in g.
  rewrite (seen_large f env s), (seen_large f env P) in g by lra.
  assert (sP : 0 <= s * P <= / 4 * G * (6.7 * G)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  apply (number_if_small f fine env) in g; [|rewrite Rabs_pos_eq; lra].
  exists (Rd (s * P)). split; [exact g|]. pose proof (rounded_positive f env _ (proj1 sP)) as R0.
  pose proof (error f ok env (s * P)) as er. rewrite (Rabs_pos_eq (s * P)) in er by lra. apply Rabs_le_inv in er.
  assert (esP : 0 <= e1 * (s * P) <= / 8388608 * (s * P)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  split; [split; [exact R0|lra]|].
  pose proof (norm_pos (along k)) as N0. set (N := norm (along k)) in *.
  assert (sN0 : 0 <= s * N) by (apply Rmult_le_pos; lra).
  assert (sNormP : (1 + 10.3 * e1) * (s * N) <= s * P).
  { replace ((1 + 10.3 * e1) * (s * N)) with (s * ((1 + 10.3 * e1) * N)) by ring. apply Rmult_le_compat_l; lra. }
  assert (esN : 0 <= e1 * (s * N)) by (apply Rmult_le_pos; lra).
  assert (eesN : 0 <= e1 * (e1 * (s * N)) <= / 8388608 * (e1 * (s * N))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  destruct (Rle_lt_dec l (s * P)) as [large|tiny].
  - pose proof (normal_error f fine env _ large) as [n1 _].
    assert (low : (1 + 9 * e1) * (s * N) <= Rd (s * P)).
    { eapply Rle_trans; [|exact n1]. apply Rle_trans with ((1 - e1) * ((1 + 10.3 * e1) * (s * N))); [lra|].
      apply Rmult_le_compat_l; lra. }
    destruct (seen_low f env _ R0). lra.
  - destruct (seen_low f env _ R0). lra.
Qed.

Variable pairs : list (nat * nat).
Hypothesis in_range : says f env value_of (are_in_range pairs).
Theorem bar_beyond_is_bar k : is_short k -> is_bar f env given value_of pairs k (bar_beyond pairs k) (s * norm (along
  k)).
Proof.
  intro short. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (omega_pos f fine). pose proof (G_4 f fine) as G4. pose proof (G_2 f fine) as G2.
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct (here bar_is_large pairs in_range k short) as (T & ET & _ & [t1 t2]).
  pose proof (here size_bounds pairs in_range k short) as (_ & _ & er0).
  destruct (clearance_value k short) as (x & Ex & [x0 xG] & xl).
  pose proof (run_sum (bar pairs k) (clearance k)) as h. fold (bar_beyond pairs k) in h. rewrite ET, Ex in h.
  unfold sum in h. cbn in h. rewrite (seen_large f env T) in h by lra. destruct (seen_low f env x x0) as [s0 _].
  pose proof (seen_smaller f env x) as sm. rewrite !Rabs_pos_eq in sm by lra.
  apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
  pose proof (normal_error f fine env (T + seen x) ltac:(lra)) as [n1 n2].
  pose proof (norm_pos (along k)) as N0. set (N := norm (along k)) in *.
  assert (sN0 : 0 <= s * N) by (apply Rmult_le_pos; lra).
  assert (esN : 0 <= e1 * (s * N)) by (apply Rmult_le_pos; lra).
  assert (eesN : 0 <= e1 * (e1 * (s * N)) <= / 8388608 * (e1 * (s * N))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (eT : e1 * (T + seen x) <= / 8388608 * (T + seen x)) by (apply Rmult_le_compat_r; lra).
  unfold is_bar. set (err_ := err f env given value_of pairs k) in *.
  assert (ee : 0 <= e1 * err_ <= / 8388608 * err_) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  exists (Rd (T + seen x)). split; [exact h|]. split; [exact (result_is_representable f ok _ _ (nearly env _))|].
  split; [|exact sN0]. split; [|lra].
  eapply Rle_trans; [|exact n1].
  apply Rle_trans with ((1 - e1) * (1.2 * err_ + 400 * l + ((1 + 9 * e1) * (s * N) - 1.1 * l))); [lra|].
  apply Rmult_le_compat_l; lra.
Qed.
End Beyond.
