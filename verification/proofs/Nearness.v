(* How far the numbers of an execution can be from exact ones, operation by operation. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core Relative Plus_error.
From Selvedge Require Import Arithmetic Machine.
From Selvedge Require Bounds.
Open Scope R_scope.

Section Nearness.
Variable f : constants.
Hypothesis ok : reasonable f.
Variable env : environment f.
Notation l := (lam f).
Notation e1 := (eps f).
Notation q := (Bounds.q f).
Notation Rd := (rounded env).
Notation seen := (seen f env).
Notation seen_value := (seen_value f env).
Notation slack := (/ 100000).

Lemma l_pos : 0 < l. Proof. apply lam_pos. Qed.
Lemma l_small : l <= / 1152921504606846976. Proof. now apply lam_small. Qed.
Lemma e_pos : 0 < e1. Proof. apply eps_pos. Qed.
Lemma e_small : e1 <= / 8388608. Proof. now apply eps_small. Qed.
Lemma q_ge n : 1 <= q n. Proof. apply Bounds.q_ge. Qed.
Lemma q_mono n k : (n <= k)%nat -> q n <= q k. Proof. apply Bounds.q_mono. Qed.
Lemma q_step n : q (S n) = (1 + e1) * q n. Proof. reflexivity. Qed.
Lemma q_sum n k : q (n + k) = q n * q k. Proof. apply pow_add. Qed.
Lemma q_linear n : (n <= 40)%nat -> q n <= 1 + 1.001 * INR n * e1.
Proof.
  pose proof e_pos. pose proof e_small. induction n as [|n IH]; intro h; [unfold Bounds.q; simpl; lra|].
    specialize (IH ltac:(lia)).
  rewrite q_step, S_INR. assert (0 <= INR n <= 40) by (split; [apply pos_INR|replace 40 with (INR 40) by (simpl; ring);
    apply le_INR; lia]).
  assert ((1 + e1) * q n <= (1 + e1) * (1 + 1.001 * INR n * e1)) by (apply Rmult_le_compat_l; lra).
  assert (1.001 * INR n * e1 <= 0.001) by nra. assert (e1 * (1.001 * INR n * e1) <= e1 * 0.001) by (apply
    Rmult_le_compat_l; lra). lra.
Qed.
Lemma q_small n : (n <= 40)%nat -> q n <= 1 + slack.
Proof.
  intro h. pose proof e_pos. pose proof e_small. eapply Rle_trans; [apply (q_mono n 40 h)|].
    eapply Rle_trans; [apply (q_linear 40); lia|].
  replace (INR 40) with 40 by (simpl; ring). lra.
Qed.
Lemma error z : Rabs (Rd z - z) <= e1 * Rabs z + l.
Proof. exact (rounding_error f ok z _ (nearly env z)). Qed.

Lemma error_of_normal z : l <= Rabs z -> Rabs (Rd z - z) <= e1 * Rabs z.
Proof.
  intro large. destruct (nearly env z) as [[small _]|[direction [v ->]]]; [lra|].
  pose proof (relative_error_FLT radix2 (least_exponent f) (precision f) (gt_0 f ok) direction z large) as E.
  replace (- precision f + 1)%Z with (1 - precision f)%Z in E by ring. fold (power (1 - precision f)) (eps f) in E. lra.
Qed.
Lemma seen_off x : Rabs (seen x - x) <= l.
Proof.
  pose proof l_pos. unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l)|].
  - replace (0 - x) with (- x) by ring. rewrite Rabs_Ropp. lra.
  - replace (x - x) with 0 by ring. rewrite Rabs_R0. lra.
  - replace (x - x) with 0 by ring. rewrite Rabs_R0. lra.
Qed.
Lemma seen_of_normal x : l <= Rabs x -> seen x = x.
Proof. intro h. unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l); [lra|]|];
  reflexivity. Qed.
Lemma seen_0 : seen 0 = 0.
Proof. unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec _ _)|]; reflexivity. Qed.
Lemma seen_twice x : seen (seen x) = seen x.
Proof.
  unfold Machine.seen. destruct (flushes_operands env); [|reflexivity].
  destruct (Rlt_dec (Rabs x) l) as [h|h]; [destruct (Rlt_dec _ _); reflexivity|].
    destruct (Rlt_dec _ _); [contradiction|reflexivity].
Qed.
Lemma seen_smaller x : Rabs (seen x) <= Rabs x.
Proof.
  unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l)|]; try lra. rewrite Rabs_R0.
    apply Rabs_pos.
Qed.
Lemma seen_opposite x : seen (- x) = - seen x.
Proof.
  unfold Machine.seen. rewrite Rabs_Ropp. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l)|]; lra.
Qed.
Lemma seen_magnitude x : seen (Rabs x) = Rabs (seen x).
Proof.
  unfold Machine.seen. rewrite Rabs_Rabsolu. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l)|]; try lra.
  now rewrite Rabs_R0.
Qed.
Lemma seen_positive x : 0 < seen x -> seen x = x.
Proof. unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l)|]; lra. Qed.
Lemma seen_monotone x y : x <= y -> seen x <= seen y.
Proof.
  intro h. pose proof l_pos. unfold Machine.seen. destruct (flushes_operands env); [|exact h].
  destruct (Rlt_dec (Rabs x) l), (Rlt_dec (Rabs y) l); try lra; unfold Rabs in *;
    destruct (Rcase_abs x), (Rcase_abs y); lra.
Qed.

Lemma rounded_0 : Rd 0 = 0.
Proof.
  destruct (nearly env 0) as [[_ ->]|[direction [v ->]]]; [reflexivity|]. apply round_0, v.
Qed.
Lemma rounded_positive z : 0 <= z -> 0 <= Rd z.
Proof. intro h. rewrite <- rounded_0. now apply (monotone env). Qed.
(* The difference of two numbers of the format has a relative error alone, where it is not flushed. *)
Lemma difference_error x y : representable f x -> representable f y ->
  Rd (x - y) = 0 /\ Rabs (x - y) < l \/ Rabs (Rd (x - y) - (x - y)) <= e1 * Rabs (x - y).
Proof.
  intros rx ry. destruct (Rlt_le_dec (Rabs (x - y)) l) as [small|large].
  - destruct (nearly env (x - y)) as [[_ E]|[direction [v E]]]; [left; auto|right].
    rewrite E, round_generic; [|exact v|].
    + replace (x - y - (x - y)) with 0 by ring. rewrite Rabs_R0. apply Rmult_le_pos;
      [apply Rlt_le, e_pos|apply Rabs_pos].
    + apply (@FLT_format_plus_small radix2 (least_exponent f) (precision f) (gt_0 f ok)).
      * exact rx.
      * apply generic_format_opp, ry.
      * unfold lam, power in small. apply Rlt_le, Rlt_le_trans with (1 := small). apply bpow_le. lia.
  - right. destruct (nearly env (x - y)) as [[small _]|[direction [v ->]]]; [lra|].
    pose proof (relative_error_FLT radix2 (least_exponent f) (precision f) (gt_0 f ok) direction (x - y) large) as E.
    replace (- precision f + 1)%Z with (1 - precision f)%Z in E by ring. fold (power (1 - precision f)) (eps f) in E.
      lra.
Qed.
Lemma representable_seen x : representable f x -> representable f (seen x).
Proof.
  intro h. unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec _ _)|]; try exact h.
    apply generic_format_0.
Qed.

(* x is off X by as much as n roundings make of p, and by a times λ; p is at least X's magnitude. *)
Definition near x X p n a := Rabs (x - X) <= (q n - 1) * p + l * a /\ Rabs X <= p /\ 0 <= a.
Lemma near_exact X : near X X (Rabs X) 0 0.
Proof.
  unfold near, Bounds.q. replace (X - X) with 0 by ring. rewrite Rabs_R0. simpl. lra.
Qed.
Lemma near_weaker x X p n a p' n' a' : near x X p n a -> p <= p' -> (n <= n')%nat -> a <= a' -> near x X p' n' a'.
Proof.
  intros (d & m & a0) P N A. pose proof (Rabs_pos X). pose proof l_pos. pose proof (q_mono n n' N). pose proof (q_ge n).
  assert ((q n - 1) * p <= (q n' - 1) * p') by (apply Rmult_le_compat; lra).
  assert (l * a <= l * a') by (apply Rmult_le_compat_l; lra). unfold near. lra.
Qed.
Lemma near_seen x X p n a : near x X p n a -> near (seen x) X p n (a + 1).
Proof.
  intros (d & m & a0). pose proof (seen_off x) as s. split; [|lra].
  replace (seen x - X) with ((seen x - x) + (x - X)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.
Lemma near_opposite x X p n a : near x X p n a -> near (- x) (- X) p n a.
Proof.
  intros (d & m & a0). replace (- x - - X) with (- (x - X)) by ring. unfold near. rewrite !Rabs_Ropp.
  replace (- x - - X) with (- (x - X)) by ring. rewrite Rabs_Ropp. auto.
Qed.
Lemma near_size x X p n a : near x X p n a -> Rabs x <= q n * p + l * a.
Proof. intros (d & m & _). replace x with ((x - X) + X) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. Qed.
Lemma last_rounding z Z P N A : Rabs (z - Z) <= (q N - 1) * P + l * A -> Rabs Z <= P -> 0 <= A ->
  near (Rd z) Z P (S N) ((1 + e1) * A + 1).
Proof.
  intros D m A0. pose proof (error z) as E. pose proof l_pos. pose proof e_pos. pose proof (q_ge N).
    pose proof (Rabs_pos Z).
  assert (size : Rabs z <= q N * P + l * A).
  { replace z with ((z - Z) + Z) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (e1 * Rabs z <= e1 * (q N * P + l * A)) by (apply Rmult_le_compat_l; lra).
  split; [|split; [lra|]].
  - rewrite q_step. replace (Rd z - Z) with ((Rd z - z) + (z - Z)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
  - assert (0 <= (1 + e1) * A) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma near_sum (op : R -> R -> R) x X p n a y Y p' k b N : op = Rplus \/ op = Rminus -> near x X p n a -> near y Y p' k
  b ->
  (n <= N)%nat -> (k <= N)%nat -> near (Rd (op x y)) (op X Y) (p + p') (S N) (1.01 * (a + b) + 1).
Proof.
  intros which A B nN kN. apply (fun h => near_weaker x X p n a p N a h (Rle_refl _) nN (Rle_refl _)) in A.
  apply (fun h => near_weaker y Y p' k b p' N b h (Rle_refl _) kN (Rle_refl _)) in B.
  destruct A as (dx & mx & a0), B as (dy & my & b0).
  assert (D : Rabs (op x y - op X Y) <= (q N - 1) * (p + p') + l * (a + b)).
  { destruct which as [-> | ->].
    - replace (x + y - (X + Y)) with ((x - X) + (y - Y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
    - replace (x - y - (X - Y)) with ((x - X) + - (y - Y)) by ring. eapply Rle_trans; [apply Rabs_triang|].
      rewrite Rabs_Ropp. lra. }
  assert (M : Rabs (op X Y) <= p + p').
  { destruct which as [-> | ->]; (eapply Rle_trans; [apply Rabs_triang|]); rewrite ?Rabs_Ropp; lra. }
  pose proof (last_rounding _ _ _ _ _ D M ltac:(lra)) as L. pose proof e_small. pose proof e_pos.
  apply (near_weaker _ _ _ _ _ _ _ _ L); [lra|lia|].
  assert (e1 * (a + b) <= / 8388608 * (a + b)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma near_product x X p n a y Y p' k b : near x X p n a -> near y Y p' k b -> (n <= 40)%nat -> (k <= 40)%nat ->
  near (Rd (x * y)) (X * Y) (p * p') (S (n + k)) (1.01 * (p * b + a * p' + l * (a * b)) + 1).
Proof.
  intros A B nN kN. pose proof (near_size _ _ _ _ _ A) as sx. destruct A as (dx & mx & a0), B as (dy & my & b0).
  pose proof (Rabs_pos X). pose proof (Rabs_pos Y). pose proof l_pos. pose proof (q_ge n). pose proof (q_ge k).
  pose proof (q_small n nN). pose proof (q_small k kN). pose proof e_pos. pose proof e_small.
  assert (D : Rabs (x * y - X * Y) <= (q (n + k) - 1) * (p * p') + l * (q n * (p * b) + q k * (a * p') + l * (a * b))).
  { replace (x * y - X * Y) with (x * (y - Y) + (x - X) * Y) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite !Rabs_mult.
    assert (Rabs x * Rabs (y - Y) <= (q n * p + l * a) * ((q k - 1) * p' + l * b)) by (apply Rmult_le_compat;
      auto using Rabs_pos).
    assert (Rabs (x - X) * Rabs Y <= ((q n - 1) * p + l * a) * p') by (apply Rmult_le_compat; auto using Rabs_pos).
    rewrite q_sum. lra. }
  assert (M : Rabs (X * Y) <= p * p') by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  assert (0 <= p * b) by (apply Rmult_le_pos; lra). assert (0 <= a * p') by (apply Rmult_le_pos; lra).
  assert (0 <= l * (a * b)) by (repeat apply Rmult_le_pos; lra).
  assert (q n * (p * b) <= (1 + slack) * (p * b)) by (apply Rmult_le_compat_r; lra).
  assert (q k * (a * p') <= (1 + slack) * (a * p')) by (apply Rmult_le_compat_r; lra).
  set (A_ := q n * (p * b) + q k * (a * p') + l * (a * b)) in *.
  assert (0 <= A_). { unfold A_. assert (0 <= q n * (p * b)) by (apply Rmult_le_pos; lra).
    assert (0 <= q k * (a * p')) by (apply Rmult_le_pos; lra). lra. }
  pose proof (last_rounding _ _ _ _ _ D M ltac:(assumption)) as L.
  apply (near_weaker _ _ _ _ _ _ _ _ L); [lra|lia|].
  assert (e1 * A_ <= / 8388608 * A_) by (apply Rmult_le_compat_r; lra). unfold A_ in *. lra.
Qed.

(* The same of values: a result that is a number, and an operand as it is seen. *)
Definition holds v X p n a := exists x, v = Number x /\ representable f x /\ near x X p n a.
Definition operand v X p n a := exists x, seen_value v = Number x /\ near x X p n a.
Lemma seen_operand v X p n a : holds v X p n a -> operand v X p n (a + 1).
Proof. intros (x & -> & _ & h). exists (seen x). split; [reflexivity|]. now apply near_seen. Qed.
Lemma holds_weaker v X p n a p' n' a' : holds v X p n a -> p <= p' -> (n <= n')%nat -> a <= a' -> holds v X p' n' a'.
Proof. intros (x & e & r & h) P N A. exists x. repeat (split; [assumption|]).
  now apply (near_weaker _ _ _ _ _ _ _ _ h). Qed.
Lemma operand_weaker v X p n a p' n' a' : operand v X p n a -> p <= p' -> (n <= n')%nat -> a <= a' -> operand v X p' n'
  a'.
Proof. intros (x & e & h) P N A. exists x. split; [exact e|]. now apply (near_weaker _ _ _ _ _ _ _ _ h). Qed.
Lemma operand_exact x : operand (Number x) (seen x) (Rabs (seen x)) 0 0.
Proof. exists (seen x). split; [reflexivity|apply near_exact]. Qed.
Lemma operand_normal x : l <= Rabs x -> operand (Number x) x (Rabs x) 0 0.
Proof. intro h. rewrite <- (seen_of_normal x h) at 2 3. apply operand_exact. Qed.

Lemma omega_1 : 1 <= omega f.
Proof.
  unfold omega, power. assert (E : bpow radix2 (greatest_exponent f) = 2 * bpow radix2 (greatest_exponent f - 1)).
  { replace (greatest_exponent f) with (1 + (greatest_exponent f - 1))%Z at 1 by ring. rewrite bpow_plus. reflexivity. }
  assert (bpow radix2 (greatest_exponent f - precision f) <= bpow radix2 (greatest_exponent f - 1)) by (apply bpow_le;
    destruct ok; lia).
  assert (1 <= bpow radix2 (greatest_exponent f - 1)) by (change 1 with (bpow radix2 0); apply bpow_le; destruct ok;
    lia). lra.
Qed.
(* Nothing overflows where p is at most a quarter of the largest number and a at most that. *)
Lemma result_holds z out X p n a : result f env z out -> near (Rd z) X p n a -> (n <= 40)%nat -> p <= omega f / 4 ->
  a <= 2 * omega f + 4 -> holds out X p n a.
Proof.
  intros r h nN P A. pose proof (near_size _ _ _ _ _ h) as s. pose proof (q_small n nN). pose proof omega_1.
    pose proof l_pos.
  pose proof l_small. destruct h as (d & m & a0). pose proof (Rabs_pos X).
  assert (q n * p <= (1 + slack) * (omega f / 4)) by (apply Rmult_le_compat; lra || (pose proof (q_ge n); lra)).
  assert (l * a <= / 1152921504606846976 * (2 * omega f + 4)) by (apply Rmult_le_compat; lra).
  assert (fits : Rabs (Rd z) <= omega f) by lra.
  destruct r as [[_ ->]|[[over _]|[over _]]].
  - exists (Rd z). split; [reflexivity|]. split; [exact (result_is_representable f ok _ _ (nearly env z))|].
    split; auto.
  - pose proof (Rle_abs (Rd z)). lra.
  - pose proof (Rle_abs (- Rd z)). rewrite Rabs_Ropp in *. lra.
Qed.
Lemma holds_sum (op : R -> R -> R) {signs} v w out X p n a Y p' k b N : op = Rplus \/ op = Rminus -> sum f env op signs
  v w out ->
  operand v X p n a -> operand w Y p' k b -> (n <= N)%nat -> (k <= N)%nat -> (N <= 38)%nat ->
  p + p' <= omega f / 4 -> a + b <= omega f -> holds out (op X Y) (p + p') (S N) (1.01 * (a + b) + 1).
Proof.
  intros which s (x & vx & hx) (y & wy & hy) nN kN N15 P A. unfold sum in s. rewrite vx, wy in s. pose proof omega_1.
  apply (result_holds _ _ _ _ _ _ s); [|lia|assumption|lra]. exact (near_sum op _ _ _ _ _ _ _ _ _ _ N which hx hy nN
    kN).
Qed.
Lemma holds_product v w out X p n a Y p' k b : product f env v w out ->
  operand v X p n a -> operand w Y p' k b -> (n + k <= 38)%nat ->
  p * p' <= omega f / 4 -> p * b + a * p' + l * (a * b) <= omega f ->
  holds out (X * Y) (p * p') (S (n + k)) (1.01 * (p * b + a * p' + l * (a * b)) + 1).
Proof.
  intros s (x & vx & hx) (y & wy & hy) N15 P A. unfold product in s. rewrite vx, wy in s. pose proof omega_1.
  apply (result_holds _ _ _ _ _ _ s); [|lia|assumption|lra]. apply near_product; auto; lia.
Qed.
Lemma omega_large : 1048576 <= omega f.
Proof.
  unfold omega, power. assert (E : bpow radix2 (greatest_exponent f) = 2 * bpow radix2 (greatest_exponent f - 1)).
  { replace (greatest_exponent f) with (1 + (greatest_exponent f - 1))%Z at 1 by ring. rewrite bpow_plus. reflexivity. }
  assert (bpow radix2 (greatest_exponent f - precision f) <= bpow radix2 (greatest_exponent f - 1)) by (apply bpow_le;
    destruct ok; lia).
  assert (1048576 <= bpow radix2 (greatest_exponent f - 1)).
  { change 1048576 with (bpow radix2 20). apply bpow_le; destruct ok; lia. }
  lra.
Qed.
Lemma result_number z out : result f env z out -> Rabs z <= omega f / 4 -> out = Number (Rd z).
Proof.
  intros r small. pose proof (error z) as E. pose proof e_small. pose proof e_pos. pose proof l_small.
    pose proof omega_large.
  pose proof (Rabs_pos z). assert (e1 * Rabs z <= / 8388608 * (omega f / 4)) by (apply Rmult_le_compat; lra).
  assert (Rabs (Rd z) <= omega f / 2).
  { replace (Rd z) with ((Rd z - z) + z) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  destruct r as [[_ ->]|[[over _]|[over _]]]; [reflexivity| |].
  - pose proof (Rle_abs (Rd z)). lra.
  - pose proof (Rle_abs (- Rd z)). rewrite Rabs_Ropp in *. lra.
Qed.
Lemma greater_numbers x y : greater f env (Number x) (Number y) <-> seen y < seen x.
Proof. reflexivity. Qed.
End Nearness.

(* An environment that rounds to nearest and keeps subnormal numbers. *)
Theorem to_nearest f : reasonable f -> environment f.
Proof.
  intro ok. pose proof (valid f ok) as v. set (near_ := round radix2 (FLT_exp (least_exponent f) (precision f))
    ZnearestE).
  refine (Environment f near_ false _ _ _).
  - intros x y le. apply round_le; [exact v|apply valid_rnd_N|exact le].
  - intro z. apply round_generic; [apply valid_rnd_N|]. apply generic_format_round; [exact v|apply valid_rnd_N].
  - intro z. right. exists ZnearestE. split; [apply valid_rnd_N|reflexivity].
Defined.
