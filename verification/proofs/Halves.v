(* What is computed of a part of the step, against exact numbers: means of control values, times, corners; and what a clear part proves. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core Mult_error.
From Selvedge Require Import Arithmetic Expressions Errors Bounds Culling Decisions Geometry Filter Permanent Corners Direction Parts.
From Selvedge Require Apart.
Open Scope R_scope.

(* Numbers of the machine. *)
Section Machine.
Variable f : format.
Hypothesis ok : reasonable f.
Variables from to : span_component -> R.
Variable value_of : number -> Expressions.value.
Hypothesis run : execution f from to value_of.
Notation val := (val value_of).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).
Notation D := (exactly from to).
Notation l_pos := (l0 f). Notation l_small := (l1 f ok). Notation e_pos := (e0 f). Notation e_small := (e_le f ok).
Implicit Types a b e : number.

Lemma of_constant c : value_of (Constant c) = Number (constant_value f c).
Proof. exact (run (Constant c)). Qed.
Lemma sum_step a b x y K : value_of a = Number x -> value_of b = Number y -> Rabs x + Rabs y <= K -> 2 * K + 1 <= omega f ->
  exists x' y' r, counts_as f x x' /\ counts_as f y y' /\ value_of (Sum a b) = Number r /\ rounds f (x' + y') r.
Proof.
  intros vx vy small room_. destruct (run (Sum a b) x y vx vy) as (x' & y' & cx & cy & r). exists x', y'.
  pose proof (counts_smaller f _ _ cx). pose proof (counts_smaller f _ _ cy). pose proof (Rabs_triang x' y').
  destruct (result_is_number f ok _ _ K r ltac:(lra) room_) as (z & vz & rounded & _). exists z. auto.
Qed.
Lemma minus_step a b x y K : value_of a = Number x -> value_of b = Number y -> Rabs x + Rabs y <= K -> 2 * K + 1 <= omega f ->
  exists x' y' r, counts_as f x x' /\ counts_as f y y' /\ value_of (Minus a b) = Number r /\ rounds f (x' - y') r.
Proof.
  intros vx vy small room_. destruct (run (Minus a b) x y vx vy) as (x' & y' & cx & cy & r). exists x', y'.
  pose proof (counts_smaller f _ _ cx). pose proof (counts_smaller f _ _ cy). pose proof (Rabs_triang x' (- y')). rewrite Rabs_Ropp in *.
  destruct (result_is_number f ok _ _ K r ltac:(unfold Rminus; lra) room_) as (z & vz & rounded & _). exists z. auto.
Qed.
Lemma times_step a b x y K : value_of a = Number x -> value_of b = Number y -> Rabs x * Rabs y <= K -> 2 * K + 1 <= omega f ->
  exists x' y' r, counts_as f x x' /\ counts_as f y y' /\ value_of (Product a b) = Number r /\ rounds f (x' * y') r.
Proof.
  intros vx vy small room_. destruct (run (Product a b) x y vx vy) as (x' & y' & cx & cy & r). exists x', y'.
  pose proof (counts_smaller f _ _ cx). pose proof (counts_smaller f _ _ cy).
  assert (Rabs (x' * y') <= K). { rewrite Rabs_mult. eapply Rle_trans; [apply Rmult_le_compat; try apply Rabs_pos; eassumption|exact small]. }
  destruct (result_is_number f ok _ _ K r H1 room_) as (z & vz & rounded & _). exists z. auto.
Qed.
Lemma exactly_ z r : rounds f z r -> representable f z -> z = 0 \/ l <= Rabs z -> r = z.
Proof.
  intros [[small ->]|(direction & valid_ & ->)] rep large.
  - destruct large as [->|large]; [reflexivity|lra].
  - apply round_generic; [exact valid_|exact rep].
Qed.

(* Halving a number of the format rounds nothing but what underflows. *)
Lemma half_is_representable x : representable f x -> l <= Rabs (/ 2 * x) -> representable f (/ 2 * x).
Proof.
  intros rep large. apply generic_format_FLT_FLX; [exact large|]. apply generic_format_FLX_FLT in rep.
  replace (/ 2 * x) with (x * bpow radix2 (-1)) by (simpl; lra). now apply mult_bpow_exact_FLX.
Qed.
Lemma half_error x x' r : representable f x -> counts_as f x x' -> rounds f (/ 2 * x') r -> Rabs (r - / 2 * x) <= 2 * l.
Proof.
  intros rep c rounded. pose proof l_pos. pose proof e_pos. pose proof e_small. destruct (Rlt_le_dec (Rabs (/ 2 * x)) l) as [small|large].
  - pose proof (counts_error f _ _ c) as near_. pose proof (rounding_error f ok _ _ rounded) as E. pose proof (counts_smaller f _ _ c) as less.
    rewrite !Rabs_mult, (Rabs_pos_eq (/ 2)) in * by lra.
    assert (e1 * (/ 2 * Rabs x') <= / 8388608 * l) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; try lra; apply Rabs_pos).
    assert (half : Rabs (/ 2 * (x' - x)) <= / 2 * l) by (rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra; lra).
    apply Rabs_le_inv in half. apply Rabs_le_inv in E. apply Rabs_le. lra.
  - assert (x' = x) as ->.
    { destruct c as [->|[small _]]; [reflexivity|]. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) in large by lra. lra. }
    rewrite (exactly_ _ _ rounded (half_is_representable x rep large) (or_intror large)). replace (_ - _) with 0 by ring. rewrite Rabs_R0. lra.
Qed.
Lemma mean_step a b x y K : value_of a = Number x -> value_of b = Number y -> Rabs x <= K -> Rabs y <= K -> 6 * K + 3 <= omega f ->
  exists r, value_of (mean a b) = Number r /\ Rabs (r - / 2 * (x + y)) <= e1 * K + 4 * l.
Proof.
  intros vx vy xK yK room_. pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof (Rabs_pos x) as K0.
  destruct (sum_step a b x y (2 * K) vx vy ltac:(lra) ltac:(lra)) as (x' & y' & s & cx & cy & vs & rs).
  pose proof (counts_error f _ _ cx) as ex. pose proof (counts_error f _ _ cy) as ey. pose proof (counts_smaller f _ _ cx). pose proof (counts_smaller f _ _ cy).
  pose proof (rounding_error f ok _ _ rs) as E. pose proof (Rabs_triang x' y').
  assert (e1 * Rabs (x' + y') <= e1 * (2 * K)) by (apply Rmult_le_compat_l; lra). assert (e1 * (2 * K) <= / 8388608 * (2 * K)) by (apply Rmult_le_compat_r; lra).
  apply Rabs_le_inv in ex. apply Rabs_le_inv in ey. apply Rabs_le_inv in E.
  assert (s_le : Rabs s <= 2.1 * K + 1).
  { pose proof (Rle_abs (x' + y')). pose proof (Rle_abs (- (x' + y'))). rewrite Rabs_Ropp in *. apply Rabs_le. lra. }
  destruct (times_step (Constant Half) (Sum a b) (/ 2) s (1.1 * K + 1) (of_constant Half) vs) as (h & s' & r & ch & cs & vr & rr).
  - rewrite (Rabs_pos_eq (/ 2)) by lra. lra.
  - lra.
  - apply (unflushed f) in ch; [|lra]. subst h. exists r. split; [exact vr|].
    pose proof (half_error s s' r (result_is_representable f ok _ _ rs) cs rr) as H9. apply Rabs_le_inv in H9. apply Rabs_le. lra.
Qed.

(* Control values of a part, after j means: how large, and how far from exact ones. *)
Section Volumes.
Variables K A : R.
Hypothesis K_pos : 0 <= K.
Hypothesis K_fits : 8 * K + 8 <= omega f.
Definition size_after j := (1 + 2 * j * e1) * K + 5 * j * l.
Definition error_after j := A + j * (1.01 * e1 * K + 5 * l).
Definition within j e x := exists v, value_of e = Number v /\ Rabs v <= size_after j /\ Rabs (v - x) <= error_after j.
Lemma later i j e x : i <= j -> within i e x -> within j e x.
Proof.
  intros le (v & E & s & a). pose proof l_pos. pose proof e_pos. assert (0 <= e1 * K) by (apply Rmult_le_pos; lra).
  exists v. split; [exact E|]. unfold size_after, error_after in *.
  assert (i * (e1 * K) <= j * (e1 * K)) by (apply Rmult_le_compat_r; lra). assert (i * l <= j * l) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma mean_within j a b x y : 0 <= j <= 12 -> within j a x -> within j b y -> within (j + 1) (mean a b) (/ 2 * (x + y)).
Proof.
  intros j12 (v & va & sv & av) (w & vb & sw & aw). pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small.
  assert (eK : 0 <= e1 * K) by (apply Rmult_le_pos; lra). assert (e1 * K <= / 8388608 * K) by (apply Rmult_le_compat_r; lra).
  assert (jl : 0 <= j * l <= 12 * l) by (split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra).
  assert (jeK : 0 <= j * (e1 * K) <= 12 * (e1 * K)) by (split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra).
  assert (room_ : 6 * size_after j + 3 <= omega f) by (unfold size_after; lra).
  destruct (mean_step a b v w (size_after j) va vb sv sw room_) as (r & vr & near_). exists r. split; [exact vr|].
  assert (e1 * size_after j <= 1.01 * (e1 * K) + / 1000 * l).
  { unfold size_after. assert (e1 * (j * (e1 * K)) <= / 8388608 * (12 * (e1 * K))) by (apply Rmult_le_compat; lra).
    assert (e1 * (j * l) <= / 8388608 * (12 * l)) by (apply Rmult_le_compat; lra). lra. }
  apply Rabs_le_inv in near_. apply Rabs_le_inv in sv. apply Rabs_le_inv in sw. apply Rabs_le_inv in av. apply Rabs_le_inv in aw.
  unfold size_after, error_after in *. split; apply Rabs_le; lra.
Qed.

(* Exact halves, and what they are of. *)
Record exact_values := Exact { x0 : R; x1 : R; x2 : R; x3 : R }.
Definition bernstein x s := x0 x * (1 - s) ^ 3 + 3 * x1 x * (1 - s) ^ 2 * s + 3 * x2 x * (1 - s) * s ^ 2 + x3 x * s ^ 3.
Definition middle (a b : R) := / 2 * (a + b).
Definition exact_first x := Exact (x0 x) (middle (x0 x) (x1 x)) (middle (middle (x0 x) (x1 x)) (middle (x1 x) (x2 x)))
  (middle (middle (middle (x0 x) (x1 x)) (middle (x1 x) (x2 x))) (middle (middle (x1 x) (x2 x)) (middle (x2 x) (x3 x)))).
Definition exact_second x := Exact (middle (middle (middle (x0 x) (x1 x)) (middle (x1 x) (x2 x))) (middle (middle (x1 x) (x2 x)) (middle (x2 x) (x3 x))))
  (middle (middle (x1 x) (x2 x)) (middle (x2 x) (x3 x))) (middle (x2 x) (x3 x)) (x3 x).
Lemma first_is_half x s : bernstein (exact_first x) s = bernstein x (/ 2 * s).
Proof. unfold bernstein, exact_first, middle; simpl. field. Qed.
Lemma second_is_half x s : bernstein (exact_second x) s = bernstein x (/ 2 + / 2 * s).
Proof. unfold bernstein, exact_second, middle; simpl. field. Qed.
Definition all_within j v x := within j (b0 v) (x0 x) /\ within j (b1 v) (x1 x) /\ within j (b2 v) (x2 x) /\ within j (b3 v) (x3 x).
Lemma halves_within j v x : 0 <= j <= 9 -> all_within j v x -> all_within (j + 3) (first_half v) (exact_first x) /\ all_within (j + 3) (second_half v) (exact_second x).
Proof.
  intros j9 (W0 & W1 & W2 & W3).
  pose proof (mean_within j _ _ _ _ ltac:(lra) W0 W1) as C0. pose proof (mean_within j _ _ _ _ ltac:(lra) W1 W2) as C1.
  pose proof (mean_within j _ _ _ _ ltac:(lra) W2 W3) as C2.
  pose proof (mean_within (j + 1) _ _ _ _ ltac:(lra) C0 C1) as D0. pose proof (mean_within (j + 1) _ _ _ _ ltac:(lra) C1 C2) as D1.
  pose proof (mean_within (j + 1 + 1) _ _ _ _ ltac:(lra) D0 D1) as M.
  split; (split; [|split; [|split]]); first [eapply later; [|exact W0]; lra | eapply later; [|exact W3]; lra | eapply later; [|exact C0]; lra
    | eapply later; [|exact C2]; lra | eapply later; [|exact D0]; lra | eapply later; [|exact D1]; lra | eapply later; [|exact M]; lra].
Qed.
Variable B : number.
Variable beta : R.
Hypothesis B_value : value_of B = Number beta.
Hypothesis B_large : l <= beta.
Hypothesis B_enough : error_after 12 <= beta.
Lemma beyond_is_positive j e x : 0 <= j <= 12 -> within j e x -> greater f (value_of e) (value_of B) -> 0 < x.
Proof.
  intros j12 w g. destruct (later j 12 e x ltac:(lra) w) as (v & E & _ & a). rewrite E, B_value in g. apply (greater_above f) in g; [|exact B_large].
  apply Rabs_le_inv in a. lra.
Qed.
Lemma beyond_is_negative j e x : 0 <= j <= 12 -> within j e x -> greater f (value_of (Negative B)) (value_of e) -> x < 0.
Proof.
  intros j12 w g. destruct (later j 12 e x ltac:(lra) w) as (v & E & _ & a). pose proof (run (Negative B)) as n. simpl in n. rewrite B_value in n. simpl in n.
  rewrite E, n in g. apply (greater_below f) in g; [|exact B_large]. apply Rabs_le_inv in a. lra.
Qed.
Theorem flat_nowhere_is_never_zero j v x s : 0 <= j <= 12 -> all_within j v x -> says f value_of (flat_nowhere B v) -> 0 <= s <= 1 -> bernstein x s <> 0.
Proof.
  intros j12 (W0 & W1 & W2 & W3) sign_ time_. unfold bernstein. cbn [says flat_nowhere] in sign_.
  destruct sign_ as [[[S0 S1] [S2 S3]]|[[S0 S1] [S2 S3]]].
  - pose proof (beyond_is_positive j _ _ j12 W0 S0). pose proof (beyond_is_positive j _ _ j12 W1 S1). pose proof (beyond_is_positive j _ _ j12 W2 S2).
    pose proof (beyond_is_positive j _ _ j12 W3 S3). pose proof (hull (x0 x) (3 * x1 x) (3 * x2 x) (x3 x) s). lra.
  - pose proof (beyond_is_negative j _ _ j12 W0 S0). pose proof (beyond_is_negative j _ _ j12 W1 S1). pose proof (beyond_is_negative j _ _ j12 W2 S2).
    pose proof (beyond_is_negative j _ _ j12 W3 S3). pose proof (hull (- x0 x) (- (3 * x1 x)) (- (3 * x2 x)) (- x3 x) s). lra.
Qed.
End Volumes.

(* Times: i parts of 2^m, computed exactly. *)
Definition moment (m : Z) (i : Z) := IZR i * power (- m).
Lemma power_one m : power (- (m + 1)) = / 2 * power (- m).
Proof. unfold power. replace (- (m + 1))%Z with (-1 + - m)%Z by ring. rewrite bpow_plus. simpl. lra. Qed.
Lemma moment_of_one m : (0 <= m)%Z -> moment m (2 ^ m) = 1.
Proof. intro m0. unfold moment, power. change 2%Z with (radix_val radix2) at 1. rewrite IZR_Zpower by exact m0. rewrite <- bpow_plus. replace (m + - m)%Z with 0%Z by ring. reflexivity. Qed.
Lemma power_small m : (0 <= m <= 5)%Z -> / 32 <= power (- m) <= 1.
Proof.
  intro m5. unfold power. replace (/ 32) with (bpow radix2 (-5)) by (simpl; lra). change 1 with (bpow radix2 0). split; apply bpow_le; lia.
Qed.
Lemma moment_is_representable m i : (0 <= m <= 5)%Z -> (0 <= i <= 64)%Z -> representable f (moment m i) /\ (moment m i = 0 \/ l <= Rabs (moment m i)).
Proof.
  intros m5 i64. split.
  - apply generic_format_FLT. exists (Float radix2 i (- m)).
    + unfold moment, F2R; reflexivity.
    + cbn [Fnum]. rewrite Z.abs_eq by lia. apply Z.le_lt_trans with 64%Z; [lia|]. apply Z.lt_le_trans with (2 ^ 24)%Z; [reflexivity|].
      change (radix_val radix2) with 2%Z. apply Z.pow_le_mono_r; destruct ok; lia.
    + cbn [Fexp]. destruct ok; lia.
  - destruct (Z.eq_dec i 0) as [->|n]; [left; unfold moment; ring|right]. pose proof (power_small m m5). pose proof l_small.
    unfold moment. assert (1 <= IZR i) by (apply IZR_le; lia). rewrite Rabs_pos_eq by (apply Rmult_le_pos; lra).
    assert (1 * power (- m) <= IZR i * power (- m)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma omega_is_large : 1000000 <= omega f.
Proof.
  pose proof (omega_large f ok) as big. pose proof (pow_pos_L f ok 3) as one. change (IZR (2 ^ 30)) with 1073741824 in big. lra.
Qed.
Lemma counted_moment m i x : (0 <= m <= 5)%Z -> (0 <= i <= 64)%Z -> counts_as f (moment m i) x -> x = moment m i.
Proof.
  intros m5 i64 [->|[small ->]]; [reflexivity|]. destruct (moment_is_representable m i m5 i64) as [_ [->|large]]; [reflexivity|lra].
Qed.
Definition is_time m i e := (0 <= m <= 4)%Z /\ (0 <= i <= 2 ^ m)%Z /\ value_of e = Number (moment m i).
Lemma moment_in m i : (0 <= m <= 4)%Z -> (0 <= i <= 2 ^ m)%Z -> 0 <= moment m i <= 1 /\ (2 ^ m <= 16)%Z.
Proof.
  intros m4 i_le. pose proof (power_small m ltac:(lia)) as [p0 p1]. split.
  - rewrite <- (moment_of_one m) by lia. unfold moment. split; [apply Rmult_le_pos; [apply IZR_le; lia|lra]|].
    apply Rmult_le_compat_r; [lra|apply IZR_le; lia].
  - change 16%Z with (2 ^ 4)%Z. apply Z.pow_le_mono_r; lia.
Qed.
Lemma mean_of_times m i a b : (m < 4)%Z -> is_time m i a -> is_time m (i + 1) b ->
  is_time (m + 1) (2 * i) a /\ is_time (m + 1) (2 * i + 1) (mean a b) /\ is_time (m + 1) (2 * i + 2) b.
Proof.
  intros m_lt (m4 & i_le & va) (_ & i1_le & vb). destruct (moment_in m i m4 i_le) as [ta two]. destruct (moment_in m _ m4 i1_le) as [tb _].
  assert (double : (2 ^ (m + 1) = 2 * 2 ^ m)%Z) by (rewrite Z.pow_add_r by lia; ring).
  assert (same : forall k, moment (m + 1) (2 * k) = moment m k).
  { intro k. unfold moment. rewrite power_one, mult_IZR. lra. }
  pose proof omega_is_large. split; [|split].
  - split; [lia|]. split; [lia|]. now rewrite same.
  - split; [lia|]. split; [lia|].
    destruct (sum_step a b _ _ 2 va vb ltac:(rewrite !Rabs_pos_eq by lra; lra) ltac:(lra)) as (x & y & s & cx & cy & vs & rs).
    apply counted_moment in cx; [|lia..]. apply counted_moment in cy; [|lia..]. subst x y.
    assert (E : moment m i + moment m (i + 1) = moment m (2 * i + 1)) by (unfold moment; rewrite !plus_IZR, mult_IZR; ring).
    rewrite E in rs. destruct (moment_is_representable m (2 * i + 1) ltac:(lia) ltac:(lia)) as [rep tame].
    apply (exactly_ _ _ rs rep) in tame. subst s.
    destruct (times_step (Constant Half) (Sum a b) (/ 2) _ 2 (of_constant Half) vs) as (h & s & r & ch & cs & vr & rr).
    { rewrite <- E. rewrite !Rabs_pos_eq by lra. lra. }
    { lra. }
    pose proof l_small. apply (unflushed f) in ch; [|lra]. apply counted_moment in cs; [|lia..]. subst h s.
    assert (E2 : / 2 * moment m (2 * i + 1) = moment (m + 1) (2 * i + 1)) by (unfold moment; rewrite power_one; ring).
    rewrite E2 in rr. destruct (moment_is_representable (m + 1) (2 * i + 1) ltac:(lia) ltac:(lia)) as [rep2 tame2].
    apply (exactly_ _ _ rr rep2) in tame2. subst r. exact vr.
  - split; [lia|]. split; [lia|]. replace (2 * i + 2)%Z with (2 * (i + 1))%Z by ring. now rewrite same.
Qed.

(* A corner's component at a time. *)
Hypothesis in_range : forall c, exists x, value_of (Difference c) = Number x /\ Rabs x <= reach f.
Notation d := (computed value_of).
Definition exact_at tau s k := (1 - tau) * D (Span s Start k) + tau * D (Span s End k).
Lemma part_of tau a c : 0 <= tau <= 1 -> value_of a = Number tau -> (forall t', counts_as f tau t' -> t' = tau) ->
  exists r, value_of (Product a (Difference c)) = Number r /\ Rabs r <= 2 * reach f + 1 /\ Rabs (r - tau * D c) <= 2 * e1 * (tau * Rabs (d c)) + 6 * l /\
    Rabs r <= (1 + e1) * (tau * Rabs (d c)) + 2 * l.
Proof.
  intros t01 va same. destruct (in_range c) as (y & vy & small). assert (dy : d c = y) by (unfold computed, Errors.val; now rewrite vy).
  pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof (L_ge_1 f ok) as L1_. pose proof (omega_large f ok) as big. change (IZR (2 ^ 30)) with 1073741824 in big.
  assert (L3 : reach f <= reach f ^ 3) by (simpl; nra).
  destruct (times_step a (Difference c) tau y (reach f) va vy) as (t' & y' & r & ct & cy & vr & rr).
  - rewrite (Rabs_pos_eq tau) by lra. pose proof (Rabs_pos y). assert (tau * Rabs y <= 1 * Rabs y) by (apply Rmult_le_compat_r; lra). lra.
  - lra.
  - apply same in ct. subst t'. exists r. split; [exact vr|]. rewrite dy.
    pose proof (counts_error f _ _ cy) as near_. pose proof (counts_smaller f _ _ cy) as less. pose proof (rounding_error f ok _ _ rr) as E.
    pose proof (off f ok from to value_of run in_range c) as of_d. rewrite dy in of_d. 
    rewrite Rabs_mult, (Rabs_pos_eq tau) in E by lra.
    assert (ty : tau * Rabs y' <= tau * Rabs y) by (apply Rmult_le_compat_l; lra). pose proof (Rabs_pos y) as y0. pose proof (Rabs_pos y') as y0'.
    assert (ty1 : tau * Rabs y <= 1 * Rabs y) by (apply Rmult_le_compat_r; lra). assert (ty0 : 0 <= tau * Rabs y) by (apply Rmult_le_pos; lra).
    assert (e1 * (tau * Rabs y') <= e1 * (tau * Rabs y)) by (apply Rmult_le_compat_l; lra).
    assert (e1 * (tau * Rabs y) <= / 8388608 * (tau * Rabs y)) by (apply Rmult_le_compat_r; lra).
    assert (size : Rabs (tau * y') <= tau * Rabs y) by (rewrite Rabs_mult, (Rabs_pos_eq tau) by lra; exact ty).
    assert (move1 : Rabs (tau * (y' - y)) <= l).
    { rewrite Rabs_mult, (Rabs_pos_eq tau) by lra. assert (tau * Rabs (y' - y) <= 1 * Rabs (y' - y)) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]). lra. }
    assert (move2 : Rabs (tau * (D c - y)) <= e1 * (tau * Rabs y) + 3 * l).
    { rewrite Rabs_mult, (Rabs_pos_eq tau) by lra. assert (tau * Rabs (D c - y) <= tau * (e1 * Rabs y + l * 3)) by (apply Rmult_le_compat_l; lra).
      assert (tau * (l * 3) <= 1 * (l * 3)) by (apply Rmult_le_compat_r; lra). lra. }
    apply Rabs_le_inv in E. apply Rabs_le_inv in size. apply Rabs_le_inv in move1. apply Rabs_le_inv in move2.
    split; [apply Rabs_le; lra|]. split; apply Rabs_le; lra.
Qed.
Lemma at_time_near m i e s k M : is_time m i e -> Rabs (d (Span s Start k)) <= M -> Rabs (d (Span s End k)) <= M ->
  exists z r, value_of (at_time e s k) = Number r /\ rounds f z r /\ Rabs (z - exact_at (moment m i) s k) <= 2.01 * e1 * M + 20 * l.
Proof.
  intros (m4 & i_le & ve) M0 M1. destruct (moment_in m i m4 i_le) as [t01 two]. set (tau := moment m i) in *.
  pose proof l_pos. pose proof l_small. pose proof e_pos. pose proof e_small. pose proof omega_is_large.
  pose proof (L_ge_1 f ok) as L1_. pose proof (omega_large f ok) as big. change (IZR (2 ^ 30)) with 1073741824 in big.
  assert (L3 : reach f <= reach f ^ 3) by (simpl; nra).
  destruct (minus_step (Constant (Small 1)) e 1 tau 2 (of_constant (Small 1)) ve) as (o & t' & q & co & ct & vq & rq).
  { rewrite !Rabs_pos_eq by lra. lra. }
  { lra. }
  apply (unflushed f) in co; [|lra]. unfold tau in ct. apply counted_moment in ct; [|lia..]. subst o t'.
  assert (rest : 1 - moment m i = moment m (2 ^ m - i)).
  { rewrite <- (moment_of_one m) by lia. unfold moment. rewrite minus_IZR. ring. }
  rewrite rest in rq. destruct (moment_is_representable m (2 ^ m - i) ltac:(lia) ltac:(lia)) as [rep tame]. apply (exactly_ _ _ rq rep) in tame.
  subst q. rewrite <- rest in vq. fold tau in vq.
  destruct (part_of (1 - tau) _ (Span s Start k) ltac:(lra) vq) as (p & vp & bp & ep & sp).
  { intros t' c. unfold tau in *. rewrite rest in *. apply counted_moment in c; [exact c|lia..]. }
  destruct (part_of tau e (Span s End k) ltac:(lra) ve) as (p' & vp' & bp' & ep' & sp').
  { intros t' c. apply counted_moment in c; [exact c|lia..]. }
  destruct (sum_step _ _ p p' (4 * reach f + 2) vp vp' ltac:(lra) ltac:(lra)) as (x & y & r & cx & cy & vr & rr).
  exists (x + y), r. split; [exact vr|]. split; [exact rr|]. apply counts_error in cx. apply counts_error in cy.
  assert (t0 : (1 - tau) * Rabs (d (Span s Start k)) <= (1 - tau) * M) by (apply Rmult_le_compat_l; lra).
  assert (t1 : tau * Rabs (d (Span s End k)) <= tau * M) by (apply Rmult_le_compat_l; lra).
  assert (e1 * ((1 - tau) * Rabs (d (Span s Start k)) + tau * Rabs (d (Span s End k))) <= e1 * M) by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * M) by (apply Rmult_le_pos; [lra|pose proof (Rabs_pos (d (Span s Start k))); lra]).
  unfold exact_at. apply Rabs_le_inv in cx. apply Rabs_le_inv in cy. apply Rabs_le_inv in ep. apply Rabs_le_inv in ep'. apply Rabs_le. lra.
Qed.

Notation number_ := (is_number f ok from to value_of run in_range).
Notation step_of := (step_of f ok from to value_of run in_range).
(* A whole number of roundoffs. *)
Lemma some_roundoffs n : (1 <= n <= 100)%Z -> fits (Product (Constant (Small n)) (Constant UnitRoundoff) : number) = true ->
  (1 - / 1000000) * (IZR n * u) <= val (Product (Constant (Small n)) (Constant UnitRoundoff)) <= (1 + / 1000000) * (IZR n * u).
Proof.
  intros n_le fit. destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof (u_large f ok). pose proof (u_small f ok). pose proof l_pos. pose proof l_small.
  pose proof e_pos. pose proof e_small. unfold Errors.val in cx, cy. rewrite !of_constant in cx, cy. cbn [constant_value] in cx, cy.
  assert (n1 : 1 <= IZR n <= 100) by (split; apply IZR_le; lia).
  apply (unflushed f) in cx; [|lra]. apply (unflushed f) in cy; [|lra]. subst x y.
  assert (nu : 1 * u <= IZR n * u) by (apply Rmult_le_compat_r; lra).
  pose proof (rounding_error f ok _ _ r) as E. rewrite (Rabs_pos_eq (IZR n * u)) in E by lra. apply Rabs_le_inv in E.
  assert (e1 * (IZR n * u) <= / 8388608 * (IZR n * u)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma roundoffs_of n a t : (1 <= n <= 100)%Z -> fits (Product (Product (Constant (Small n)) (Constant UnitRoundoff)) a) = true -> 0 <= t -> t - 2 * l <= val a ->
  0.999 * (IZR n * u) * t - 3 * l <= val (Product (Product (Constant (Small n)) (Constant UnitRoundoff)) a).
Proof.
  intros n_le fit t0 large. destruct (fits_product _ _ fit) as [fc _]. pose proof (some_roundoffs n n_le fc) as C. pose proof l_pos. pose proof l_small.
  pose proof e_pos. pose proof e_small. pose proof (u_large f ok). pose proof (u_small f ok). assert (n1 : 1 <= IZR n <= 100) by (split; apply IZR_le; lia).
  destruct (step_of _ fit) as (x & y & cx & cy & r). assert (nu : 1 * u <= IZR n * u <= 100 * u) by (split; apply Rmult_le_compat_r; lra).
  apply (unflushed f) in cx; [|lra]. subst x. apply counts_error in cy. apply Rabs_le_inv in cy. set (c := val (Product (Constant _) _)) in *.
  assert (ct : (1 - / 1000000) * (IZR n * u) * t <= c * t) by (apply Rmult_le_compat_r; lra).
  assert (cy2 : c * (t - 3 * l) <= c * y) by (apply Rmult_le_compat_l; lra).
  assert (cl : c * (3 * l) <= / 1000 * (3 * l)) by (apply Rmult_le_compat_r; lra). assert (0 <= IZR n * u * t) by (repeat apply Rmult_le_pos; lra).
  pose proof (rounding_error f ok _ _ r) as E. apply Rabs_le_inv in E. match type of E with _ <= ?v - _ <= _ => set (out := v) in * end.
  change (0.999 * (IZR n * u) * t - 3 * l <= out). destruct (Rle_lt_dec 0 (c * y)) as [pos|neg].
  - rewrite (Rabs_pos_eq (c * y)) in E by assumption. assert (e1 * (c * y) <= / 8388608 * (c * y)) by (apply Rmult_le_compat_r; lra). lra.
  - rewrite (Rabs_left (c * y)) in E by assumption. assert (e1 * - (c * y) <= / 8388608 * - (c * y)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma with_underflow a t : fits (Sum a (Constant Underflow)) = true -> 0 <= t -> t - 10 * l <= val a -> (1 - e1) * t + 490 * l <= val (Sum a (Constant Underflow)).
Proof.
  intros fit t0 large. destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof l_pos. pose proof e_pos. pose proof e_small. pose proof (eta_large f ok).
  unfold Errors.val in cy. rewrite of_constant in cy. cbn [constant_value] in cy. apply (unflushed f) in cy; [|lra]. subst y.
  apply counts_error in cx. apply Rabs_le_inv in cx. pose proof (rounds_below f ok _ _ r ltac:(lra)) as low.
  assert (0 <= (1 - e1) * (x + power (Arithmetic.underflow f) - (t + 501 * l))) by (apply Rmult_le_pos; lra).
  assert (e1 * l <= / 8388608 * l) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Definition extent_of s k := Rmax (val (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k))))) l.
Lemma extent_bounds s k : Rabs (d (Span s Start k)) <= extent_of s k /\ Rabs (d (Span s End k)) <= extent_of s k.
Proof.
  split; apply (maxima_bound f ok from to value_of run in_range); try reflexivity; cbn [occurs]; 
    match goal with |- context [difference_dec ?c ?c] => destruct (difference_dec c c); [|congruence] end; now rewrite ?orb_true_r.
Qed.
Lemma side_bound_large s k : 5.9 * e1 * extent_of s k + 400 * l <= val (side_bound s k).
Proof.
  pose proof l_pos. pose proof e_pos. pose proof e_small. assert (fit : fits (side_bound s k) = true) by (vm_compute; reflexivity).
  destruct (fits_sum _ _ fit) as [fa _]. pose proof (Rmax_r (val (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k))))) l) as big.
  fold (extent_of s k) in big.
  pose proof (maxima_pos f ok from to value_of run in_range (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k)))) eq_refl ltac:(vm_compute; reflexivity)) as x0.
  assert (large : extent_of s k - 2 * l <= val (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k))))).
  { assert (extent_of s k <= val (Larger (Magnitude (Difference (Span s Start k))) (Magnitude (Difference (Span s End k)))) + l) by (apply Rmax_lub; lra). lra. }
  pose proof (roundoffs_of 12 _ (extent_of s k) ltac:(lia) fa ltac:(lra) large) as P. assert (half_ : u = / 2 * e1) by (pose proof (eps_twice f); lra). rewrite half_ in P.
  assert (eM : 0 <= e1 * extent_of s k) by (apply Rmult_le_pos; lra).
  assert (e1 * (e1 * extent_of s k) <= / 8388608 * (e1 * extent_of s k)) by (apply Rmult_le_compat_r; lra).
  pose proof (with_underflow _ (5.99 * (e1 * extent_of s k)) fit ltac:(lra) ltac:(lra)) as U.
  match type of U with ?a <= _ => change (a <= val (side_bound s k)) in U end. lra.
Qed.
Lemma side_bound_value s k : value_of (side_bound s k) = Number (val (side_bound s k)) /\ representable f (val (side_bound s k)).
Proof.
  assert (fit : fits (side_bound s k) = true) by (vm_compute; reflexivity). split; [exact (number_ _ fit)|].
  destruct (step_of _ fit) as (x & y & _ & _ & r). exact (result_is_representable f ok _ _ r).
Qed.
Lemma ahead_at m i e s k : is_time m i e ->
  (greater f (value_of (at_time e s k)) (value_of (side_bound s k)) -> 0 < exact_at (moment m i) s k) /\
  (greater f (value_of (Negative (side_bound s k))) (value_of (at_time e s k)) -> exact_at (moment m i) s k < 0).
Proof.
  intros time_. destruct (extent_bounds s k) as [M0 M1]. destruct (at_time_near m i e s k _ time_ M0 M1) as (z & r & vr & rr & near_).
  pose proof (side_bound_large s k) as large. destruct (side_bound_value s k) as [vb rep]. pose proof l_pos. pose proof e_pos.
  assert (0 <= e1 * extent_of s k) by (apply Rmult_le_pos; [lra|]; eapply Rle_trans; [apply Rabs_pos|exact M0]).
  destruct (sign_of f ok z r (exact_at (moment m i) s k) (val (side_bound s k)) rr ltac:(lra) rep) as [up down]. split; intro g.
  - rewrite vr, vb in g. apply (greater_above f) in g; [|lra]. now apply up.
  - pose proof (run (Negative (side_bound s k))) as n. simpl in n. rewrite vb in n. simpl in n. rewrite n, vr in g.
    apply (greater_below f) in g; [|lra]. now apply down.
Qed.
Lemma all_four g corner : says f value_of (of_four Both g corner) -> forall i, (i < 4)%nat -> says f value_of (g (corner i)).
Proof. intros [[a b] [c e]] i small. destruct i as [|[|[|[|]]]]; try assumption; lia. Qed.
Lemma in_between (t0 t1 t : R) s k : t0 <= t <= t1 -> 0 < exact_at t0 s k -> 0 < exact_at t1 s k -> 0 < exact_at t s k.
Proof.
  intros between a b. unfold exact_at in *. set (p := D (Span s Start k)) in *. set (q := D (Span s End k)) in *.
  destruct (Rle_lt_dec q p); [assert (t * (p - q) <= t1 * (p - q)) by (apply Rmult_le_compat_r; lra)|
    assert (t0 * (q - p) <= t * (q - p)) by (apply Rmult_le_compat_r; lra)]; lra.
Qed.
Lemma in_between_below (t0 t1 t : R) s k : t0 <= t <= t1 -> exact_at t0 s k < 0 -> exact_at t1 s k < 0 -> exact_at t s k < 0.
Proof.
  intros between a b. unfold exact_at in *. set (p := D (Span s Start k)) in *. set (q := D (Span s End k)) in *.
  destruct (Rle_lt_dec q p); [assert (t0 * (p - q) <= t * (p - q)) by (apply Rmult_le_compat_r; lra)|
    assert (t * (q - p) <= t1 * (q - p)) by (apply Rmult_le_compat_r; lra)]; lra.
Qed.
Section Parts.
Variable corner : nat -> span.
Definition an_axis_lies_between t := exists k, (forall i, (i < 4)%nat -> 0 < exact_at t (corner i) k) \/ (forall i, (i < 4)%nat -> exact_at t (corner i) k < 0).
Theorem separated m i j e e' t : is_time m i e -> is_time m j e' -> moment m i <= t <= moment m j -> says f value_of (an_axis_separates corner e e') ->
  an_axis_lies_between t.
Proof.
  intros t0 t1 between.
  assert (along : forall k, says f value_of (separates corner e e' k) -> an_axis_lies_between t).
  { intros k [all_|all_]; exists k; [left|right]; intros c small; destruct (all_four _ _ all_ c small) as [A B].
    - apply (in_between (moment m i) (moment m j)); [exact between| |]; eapply ahead_at; eassumption.
    - apply (in_between_below (moment m i) (moment m j)); [exact between| |]; eapply ahead_at; eassumption. }
  intros [[h|h]|h]; exact (along _ h).
Qed.

Variables K A : R.
Hypothesis K_pos : 0 <= K.
Hypothesis K_fits : 8 * K + 8 <= omega f.
Variable B : number.
Variable beta : R.
Hypothesis B_value : value_of B = Number beta.
Hypothesis B_large : l <= beta.
Hypothesis B_enough : error_after K A 12 <= beta.
Variable volume_at : R -> R.
Lemma one_part v x m i e e' j : (0 <= m)%Z -> 0 <= j <= 12 -> all_within K A j v x ->
  is_time m i e -> is_time m (i + 1) e' -> (forall s, 0 <= s <= 1 -> volume_at (moment m i + s * power (- m)) = bernstein x s) ->
  says f value_of (Either (flat_nowhere B v) (an_axis_separates corner e e')) -> forall t, moment m i <= t <= moment m (i + 1) ->
  volume_at t <> 0 \/ an_axis_lies_between t.
Proof.
  intros m0 j12 w time0 time1 of_part [flat|axes] t between; [left|right; exact (separated m i (i + 1) e e' t time0 time1 between axes)].
  assert (p0 : 0 < power (- m)) by apply bpow_gt_0. set (s := (t - moment m i) / power (- m)).
  assert (back : s * power (- m) = t - moment m i) by (unfold s; field; lra).
  assert (s_in : 0 <= s <= 1).
  { unfold moment in *. rewrite plus_IZR in between. split.
    - unfold s. apply Rmult_le_pos; [lra|left; now apply Rinv_0_lt_compat].
    - apply (Rmult_le_reg_r (power (- m))); [exact p0|]. rewrite back. lra. }
  replace t with (moment m i + s * power (- m)) by lra. rewrite of_part by exact s_in.
  exact (flat_nowhere_is_never_zero K A K_pos B beta B_value B_large B_enough j v x s j12 w flat s_in).
Qed.
Theorem clear_is_clear n : forall v x m i e e' j, (0 <= m)%Z -> (Z.of_nat n + m <= 4)%Z -> 0 <= j -> j + 3 * INR n <= 12 -> all_within K A j v x ->
  is_time m i e -> is_time m (i + 1) e' -> (forall s, 0 <= s <= 1 -> volume_at (moment m i + s * power (- m)) = bernstein x s) ->
  says f value_of (is_clear corner B n v e e') -> forall t, moment m i <= t <= moment m (i + 1) -> volume_at t <> 0 \/ an_axis_lies_between t.
Proof.
  induction n as [|n IH]; intros v x m i e e' j m0 nm j0 j12 w time0 time1 of_part clear t between.
  - exact (one_part v x m i e e' j m0 ltac:(simpl in j12; lra) w time0 time1 of_part clear t between).
  - rewrite S_INR in j12. pose proof (pos_INR n).
    destruct clear as [clear|[first second]]; [exact (one_part v x m i e e' j m0 ltac:(lra) w time0 time1 of_part clear t between)|].
    destruct (mean_of_times m i e e' ltac:(lia) time0 time1) as (h0 & h1 & h2).
    destruct (halves_within K A K_pos K_fits j v x ltac:(lra) w) as [w0 w1]. pose proof (power_one m) as half.
    assert (twice : forall k, moment (m + 1) (2 * k) = moment m k) by (intro k; unfold moment; rewrite half, mult_IZR; lra).
    destruct (Rle_lt_dec t (moment (m + 1) (2 * i + 1))) as [early|late].
    + apply (IH (first_half v) (exact_first x) (m + 1)%Z (2 * i)%Z e (mean e e') (j + 3)); try assumption; try lia; try lra.
      * intros s s_in. rewrite twice, half, first_is_half. rewrite <- of_part by lra. f_equal. ring.
      * rewrite twice. lra.
    + apply (IH (second_half v) (exact_second x) (m + 1)%Z (2 * i + 1)%Z (mean e e') e' (j + 3)); try assumption; try lia; try lra.
      * now replace (2 * i + 1 + 1)%Z with (2 * i + 2)%Z by ring.
      * intros s s_in. rewrite half, second_is_half. rewrite <- of_part by lra. f_equal. unfold moment. rewrite half, plus_IZR, mult_IZR. field.
      * replace (2 * i + 1 + 1)%Z with (2 * (i + 1))%Z by ring. rewrite twice. lra.
Qed.
End Parts.
End Machine.

(* From the code's terms to the geometry. *)
Section OfAPair.
Variable place : coordinate -> R.
Variable f : format.
Hypothesis ok : reasonable f.
Variable value_of : number -> Expressions.value.
Notation val := (val value_of).
Notation l := (lam f).
Notation e1 := (eps f).
Notation u := (unit_roundoff f).
Notation L := (power (largest_edge f)).

Section OfAKind.
Variable ends : span -> nat * nat.
Variable names : component -> span_component.
Variable corner : nat -> span.
Variables a_ b_ c_ p_ : nat.
Notation from := (from_of place ends).
Notation to := (to_of place ends).
Hypothesis run : execution f from to value_of.
Notation from' := (fun c => from (names c)).
Notation to' := (fun c => to (names c)).
Notation value_of' := (fun e => value_of (renamed names e)).
Let run' : execution f from' to' value_of' := renamed_execution f from to value_of names run.
Notation E := (exact (exactly from' to')).
Notation path n := (Apart.path_of place n).
Definition three_volumes t := 3 * volume (at_ (path a_) t) (at_ (path b_) t) (at_ (path c_) t) (at_ (path p_) t).
Definition exact_controls := Exact (3 * E control_value_0) (E control_value_1) (E control_value_2) (3 * E control_value_3).
Hypothesis in_range : forall c, is_at_most value_of (reach f) c.
Let in_range' : forall c, exists x, value_of' (Difference c) = Number x /\ Rabs x <= reach f := fun c => in_range (names c).
Notation step_of := (step_of f ok from to value_of run in_range).
Notation number_ := (is_number f ok from to value_of run in_range).
Hypothesis bound_fits : fits (volume_bound names) = true.
Hypothesis size_fits : fits (size_of_all names) = true /\ (size (size_of_all names) <= 2 ^ 20)%Z /\ degree (size_of_all names) = 3%nat.

Definition K := Rmax (val (size_of_all names)) l.
Notation er := (val (error_ names)).
Definition A := 0.98501 * er + 2.001 * e1 * K + 19 * l.
Lemma K_large : l <= K. Proof. apply Rmax_r. Qed.
Lemma K_has_room : 8 * K + 8 <= omega f.
Proof.
  destruct size_fits as (fit & small & deg). destruct (sizes f ok from to value_of run in_range _ fit) as (x & vx & bx & _).
  rewrite deg in bx. pose proof (omega_large f ok) as big. change (IZR (2 ^ 30)) with 1073741824 in big. pose proof (pow_pos_L f ok 3) as one.
  apply IZR_le in small. change (IZR (2 ^ 20)) with 1048576 in small.
  assert (IZR (size (size_of_all names)) * reach f ^ 3 <= 1048576 * reach f ^ 3) by (apply Rmult_le_compat_r; lra).
  assert (val (size_of_all names) = x) as E_ by (unfold Errors.val; now rewrite vx). pose proof (Rle_abs x). pose proof (l1 f ok).
  assert (K <= 1048576 * reach f ^ 3) by (unfold K; apply Rmax_lub; lra). lra.
Qed.
(* Each volume is at most K. *)
Lemma parts_of_bound : fits (error_ names) = true /\ fits (Product (Product (Constant (Small 32)) (Constant UnitRoundoff)) (size_of_all names)) = true.
Proof. destruct (fits_sum _ _ bound_fits) as [a _]. exact (fits_sum _ _ a). Qed.
Lemma volumes_fit : (fits (b0 (volumes names)) = true /\ fits (b1 (volumes names)) = true) /\ (fits (b2 (volumes names)) = true /\ fits (b3 (volumes names)) = true).
Proof.
  destruct size_fits as (fit & _). destruct (fits_larger _ _ fit) as [a b]. destruct (fits_larger _ _ a). destruct (fits_larger _ _ b).
  repeat split; apply (of_magnitude _); assumption.
Qed.
Lemma volumes_small : (Rabs (val (b0 (volumes names))) <= K /\ Rabs (val (b1 (volumes names))) <= K) /\ (Rabs (val (b2 (volumes names))) <= K /\ Rabs (val (b3 (volumes names))) <= K).
Proof.
  destruct size_fits as (fit & _). destruct (fits_larger _ _ fit) as [a b]. destruct volumes_fit as [[f0 f1] [f2 f3]].
  destruct (larger_bounds f ok from to value_of run in_range _ _ K fit (Rmax_r _ _) (Rmax_l _ _)) as [A_ B_].
  destruct (larger_bounds f ok from to value_of run in_range _ _ K a (Rmax_r _ _) A_) as [V0 V1].
  destruct (larger_bounds f ok from to value_of run in_range _ _ K b (Rmax_r _ _) B_) as [V2 V3].
  assert (m : forall e, fits e = true -> val (Magnitude e) = Rabs (val e)).
  { intros e fe. unfold Errors.val at 1. now rewrite (magnitude_value f ok from to value_of run in_range e fe). }
  rewrite m in V0, V1, V2, V3 by assumption. auto.
Qed.
Lemma near_exact k b : is_near f from' to' value_of' k b -> Rabs (val (renamed names k) - E k) <= 0.985 * b + e1 * Rabs (val (renamed names k)) + l.
Proof.
  intros (z & rounded & close). pose proof (rounding_error_by_result f ok _ _ rounded) as R_.
  change (Rabs (val (renamed names k) - z) <= e1 * Rabs (val (renamed names k)) + l) in R_.
  replace (val (renamed names k) - E k) with ((val (renamed names k) - z) + (z - E k)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.
(* Three times a number. *)
Lemma three_times e : fits (three e) = true -> exists r y, val (three e) = r /\ counts_as f (val e) y /\ Rabs (r - 3 * y) <= e1 * Rabs r + l /\ rounds f (3 * y) r.
Proof.
  intro fit. destruct (step_of _ fit) as (x & y & cx & cy & r). pose proof (l0 f). pose proof (l1 f ok).
  unfold Errors.val in cx. rewrite (of_constant f from to value_of run) in cx. cbn [constant_value] in cx. apply (unflushed f) in cx; [|lra]. subst x.
  exists (val (three e)), y. split; [reflexivity|]. split; [exact cy|]. split; [exact (rounding_error_by_result f ok _ _ r)|exact r].
Qed.
Lemma outer k b : is_near f from' to' value_of' k b -> fits (three (k_ names k)) = true -> Rabs (val (three (k_ names k))) <= K ->
  Rabs (val (three (k_ names k)) - 3 * E k) <= 0.985 * (3 * b) + 2.001 * e1 * K + 10 * l.
Proof.
  intros near_ fit small. destruct (three_times _ fit) as (r & y & E_ & cy & R_ & _). apply counts_error in cy. pose proof (near_exact k b near_) as N.
  change (renamed names k) with (k_ names k) in N. set (v := val (k_ names k)) in *. rewrite E_ in *. pose proof (l0 f). pose proof (e0 f). pose proof (e_le f ok).
  pose proof K_large. assert (er_ : e1 * Rabs r <= e1 * K) by (apply Rmult_le_compat_l; lra). assert (eK : e1 * K <= / 8388608 * K) by (apply Rmult_le_compat_r; lra).
  assert (v3 : 3 * Rabs v <= K + e1 * K + 4 * l).
  { rewrite <- (Rabs_pos_eq 3) by lra. rewrite <- Rabs_mult.
    apply Rabs_le_inv in cy. apply Rabs_le_inv in R_. apply Rabs_le_inv in small. apply Rabs_le. lra. }
  assert (e1 * (3 * Rabs v) <= e1 * (K + e1 * K + 4 * l)) by (apply Rmult_le_compat_l; lra).
  assert (e1 * (e1 * K + 4 * l) <= / 8388608 * (e1 * K + 4 * l)) by (apply Rmult_le_compat_r; [assert (0 <= e1 * K) by (apply Rmult_le_pos; lra)|]; lra).
  apply Rabs_le_inv in cy. apply Rabs_le_inv in R_. apply Rabs_le_inv in N. apply Rabs_le. lra.
Qed.
Lemma inner k b : is_near f from' to' value_of' k b -> Rabs (val (k_ names k)) <= K -> Rabs (val (k_ names k) - E k) <= 0.985 * b + 2.001 * e1 * K + 10 * l.
Proof.
  intros near_ small. pose proof (near_exact k b near_) as N. change (renamed names k) with (k_ names k) in N. pose proof (l0 f). pose proof (e0 f). pose proof K_large.
  assert (e1 * Rabs (val (k_ names k)) <= e1 * K) by (apply Rmult_le_compat_l; lra). assert (0 <= e1 * K) by (apply Rmult_le_pos; lra). lra.
Qed.
(* Their errors' largest. *)
Notation bound_of e := (val (k_ names e)).
Lemma errors_small : l <= bound_of error_bound_0 -> l <= bound_of error_bound_1 -> l <= bound_of error_bound_2 -> l <= bound_of error_bound_3 ->
  0 <= er /\ (3 * bound_of error_bound_0 <= (1 + / 1000000) * er + 9 * l /\ 3 * bound_of error_bound_3 <= (1 + / 1000000) * er + 9 * l) /\
  (bound_of error_bound_1 <= (1 + / 1000000) * er + 9 * l /\ bound_of error_bound_2 <= (1 + / 1000000) * er + 9 * l).
Proof.
  intros p0 p1 p2 p3. destruct parts_of_bound as [fit _]. destruct (fits_larger _ _ fit) as [f03 f12]. pose proof (l0 f). pose proof (e0 f). pose proof (e_le f ok).
  destruct (fits_product _ _ f03) as [_ fm]. destruct (fits_larger _ _ fm) as [fe0 fe3]. destruct (fits_larger _ _ f12) as [fe1 fe2].
  assert (m_pos : 0 <= val (Larger (k_ names error_bound_0) (k_ names error_bound_3))) by (apply (larger_pos f ok from to value_of run in_range); [exact fm|lra|lra]).
  assert (n_pos : 0 <= val (Larger (k_ names error_bound_1) (k_ names error_bound_2))) by (apply (larger_pos f ok from to value_of run in_range); [exact f12|lra|lra]).
  destruct (larger_bounds f ok from to value_of run in_range _ _ _ fm (Rmax_r _ l) (Rmax_l _ l)) as [A0 A3].
  destruct (larger_bounds f ok from to value_of run in_range _ _ _ f12 (Rmax_r _ l) (Rmax_l _ l)) as [A1 A2].
  set (m := val (Larger (k_ names error_bound_0) (k_ names error_bound_3))) in *. set (n := val (Larger (k_ names error_bound_1) (k_ names error_bound_2))) in *.
  assert (m_max : Rmax m l <= m + l) by (apply Rmax_lub; lra). assert (n_max : Rmax n l <= n + l) by (apply Rmax_lub; lra).
  destruct (three_times _ f03) as (r & y & E_ & cy & _ & rounded). change (counts_as f m y) in cy.
  assert (y0 : 0 <= y) by (destruct cy as [->|[_ ->]]; lra). apply counts_error in cy. apply Rabs_le_inv in cy.
  pose proof (rounds_below f ok _ _ rounded ltac:(lra)) as low.
  assert (r0 : 0 <= r).
  { destruct rounded as [[_ ->]|(direction & valid_ & ->)]; [lra|]. pose proof (Arithmetic.valid f ok). apply round_ge_generic; [assumption|exact valid_|apply generic_format_0|lra]. }
  assert (er0 : 0 <= er) by (apply (larger_pos f ok from to value_of run in_range); [exact fit|rewrite E_; exact r0|exact n_pos]).
  destruct (larger_bounds f ok from to value_of run in_range _ _ _ fit (Rmax_r _ l) (Rmax_l _ l)) as [R_ N_]. rewrite E_ in R_.
  change (val (Larger (k_ names error_bound_1) (k_ names error_bound_2))) with n in N_. fold (error_ names) in R_, N_.
  assert (er_max : Rmax er l <= er + l) by (apply Rmax_lub; lra).
  assert (m1 : e1 * (3 * y) <= / 8388608 * (3 * y)) by (apply Rmult_le_compat_r; lra).
  split; [exact er0|]. repeat split; lra.
Qed.
Lemma bound_is_large : 0 <= er -> (1 - / 100000) * er + 15.9 * e1 * K + 400 * l <= val (volume_bound names).
Proof.
  intro er0. pose proof (l0 f). pose proof (e0 f). pose proof (e_le f ok). pose proof K_large. destruct parts_of_bound as [fe fs].
  destruct (fits_sum _ _ bound_fits) as [fit _]. destruct size_fits as (fz & _).
  destruct (fits_larger _ _ fz) as [za zb]. destruct (fits_larger _ _ za) as [z0 z1]. destruct (fits_larger _ _ zb) as [z2 z3].
  assert (m : forall e, fits (Magnitude e) = true -> 0 <= val (Magnitude e)).
  { intros e fe_. unfold Errors.val. rewrite (magnitude_value f ok from to value_of run in_range e (of_magnitude _ fe_)). apply Rabs_pos. }
  assert (size0 : 0 <= val (size_of_all names)).
  { apply (larger_pos f ok from to value_of run in_range); [exact fz| |]; apply (larger_pos f ok from to value_of run in_range); auto. }
  assert (K - 2 * l <= val (size_of_all names)) by (assert (K <= val (size_of_all names) + l) by (apply Rmax_lub; lra); lra).
  pose proof (roundoffs_of f ok from to value_of run in_range 32 _ K ltac:(lia) fs ltac:(lra) H3) as P.
  assert (half_ : u = / 2 * e1) by (pose proof (eps_twice f); lra). rewrite half_ in P.
  assert (eK : 0 <= e1 * K) by (apply Rmult_le_pos; lra).
  pose proof (sum_from_below f ok from to value_of run in_range _ _ er (15.98 * (e1 * K)) fit er0 ltac:(lra) 0 3 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as S_.
  assert (t0 : 0 <= (1 - e1) * (er + 15.98 * (e1 * K))) by (apply Rmult_le_pos; lra).
  pose proof (with_underflow f ok from to value_of run in_range _ _ bound_fits t0 ltac:(lra)) as U. fold (volume_bound names) in U.
  match type of U with ?a <= _ => change (a <= val (volume_bound names)) in U end.
  assert (e1 * er <= / 8388608 * er) by (apply Rmult_le_compat_r; lra). assert (e1 * (e1 * K) <= / 8388608 * (e1 * K)) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * (e1 * (er + 15.98 * (e1 * K)))) by (repeat apply Rmult_le_pos; lra). lra.
Qed.

Theorem parts_are_clear halvings : (halvings <= 4)%nat -> (forall t, bernstein exact_controls t = three_volumes t) ->
  says f value_of (clear_in_parts names corner halvings) -> forall t, 0 <= t <= 1 -> three_volumes t <> 0 \/ an_axis_lies_between from to corner t.
Proof.
  intros few same [_ clear] t time_.
  destruct (bound_0 f ok from' to' value_of' run' in_range') as [(p0 & _) n0]. destruct (bound_1 f ok from' to' value_of' run' in_range') as [(p1 & _) n1].
  destruct (bound_2 f ok from' to' value_of' run' in_range') as [(p2 & _) n2]. destruct (bound_3 f ok from' to' value_of' run' in_range') as [(p3 & _) n3].
  change (l <= bound_of error_bound_0) in p0. change (l <= bound_of error_bound_1) in p1. change (l <= bound_of error_bound_2) in p2. change (l <= bound_of error_bound_3) in p3.
  destruct (errors_small p0 p1 p2 p3) as (er0 & (E0 & E3) & (E1 & E2)). pose proof (bound_is_large er0) as large.
  destruct volumes_fit as [[f0 f1] [f2 f3]]. destruct volumes_small as [[s0 s1] [s2 s3]]. cbn [b0 b1 b2 b3 volumes] in f0, f1, f2, f3, s0, s1, s2, s3.
  pose proof (outer _ _ n0 f0 s0) as O0. pose proof (inner _ _ n1 s1) as I1. pose proof (inner _ _ n2 s2) as I2. pose proof (outer _ _ n3 f3 s3) as O3.
  change (Errors.val value_of' error_bound_0) with (bound_of error_bound_0) in O0. change (Errors.val value_of' error_bound_1) with (bound_of error_bound_1) in I1.
  change (Errors.val value_of' error_bound_2) with (bound_of error_bound_2) in I2. change (Errors.val value_of' error_bound_3) with (bound_of error_bound_3) in O3.
  pose proof (l0 f). pose proof (e0 f). pose proof (e_le f ok). pose proof K_large. assert (eK : 0 <= e1 * K) by (apply Rmult_le_pos; lra).
  assert (w : all_within f value_of K A 0 (volumes names) exact_controls).
  { unfold all_within, within, size_after, error_after, A. cbn [b0 b1 b2 b3 volumes x0 x1 x2 x3 exact_controls].
    split; [|split; [|split]]; eexists; (split; [apply number_; assumption|]; split; lra). }
  assert (t0 : is_time value_of 0 0 (Constant (Small 0))).
  { split; [lia|]. split; [lia|]. rewrite (of_constant f from to value_of run). unfold moment; simpl. f_equal. ring. }
  assert (t1 : is_time value_of 0 (0 + 1) (Constant (Small 1))).
  { split; [lia|]. split; [lia|]. rewrite (of_constant f from to value_of run). unfold moment, power; simpl. f_equal. ring. }
  apply (clear_is_clear f ok from to value_of run in_range corner K A ltac:(lra) K_has_room (volume_bound names) (val (volume_bound names))
    (number_ _ bound_fits) ltac:(lra)) with (n := halvings) (v := volumes names) (x := exact_controls) (m := 0%Z) (i := 0%Z)
    (e := Constant (Small 0)) (e' := Constant (Small 1)) (j := 0); try assumption; try lia; try lra.
  - unfold error_after, A. lra.
  - assert (INR halvings <= 4) by (replace 4 with (INR 4) by (simpl; lra); now apply le_INR). lra.
  - intros s s_in. rewrite same. f_equal. unfold moment, power; simpl. ring.
  - unfold moment, power; simpl. lra.
Qed.
End OfAKind.

(* What lies between the sets keeps them apart. *)
Definition unit k s := match k with X => Point s 0 0 | Y => Point 0 s 0 | Z_ => Point 0 0 s end.
Lemma along_axis ends s n m t k sign_ : ends s = (n, m) ->
  dot (unit k sign_) (minus (at_ (Apart.path_of place n) t) (at_ (Apart.path_of place m) t)) = sign_ * exact_at (from_of place ends) (to_of place ends) t s k.
Proof.
  intro E_. unfold exact_at, exactly, from_of, to_of, difference_of. rewrite E_.
  destruct k; unfold dot, minus, at_, plus, scaled, unit, Apart.path_of, Apart.position; simpl; ring.
Qed.
Lemma side_of_axis ends corner t : an_axis_lies_between (from_of place ends) (to_of place ends) corner t ->
  exists w, forall i n m, (i < 4)%nat -> ends (corner i) = (n, m) -> 0 < dot w (minus (at_ (Apart.path_of place n) t) (at_ (Apart.path_of place m) t)).
Proof.
  intros [k [all_|all_]]; [exists (unit k 1)|exists (unit k (-1))]; intros i n m small E_; rewrite (along_axis _ _ _ _ _ _ _ E_);
    pose proof (all_ i small); lra.
Qed.
Ltac in_range_of names run culled := let small := fresh in destruct culled as [[small _] _]; intros c;
  exact (range_of f ok _ _ _ (renamed_execution f _ _ value_of names run) Permanent.largest c eq_refl (all_occur c) small).
Theorem parts_of_a_vertex_and_a_face halvings : (halvings <= 4)%nat ->
  execution f (from_of place a_vertex_and_a_face.ends) (to_of place a_vertex_and_a_face.ends) value_of ->
  says f value_of (clear_in_parts names_of_a_vertex_and_a_face corners_of_a_vertex_and_a_face halvings) -> Apart.never_touch_vertex_and_face place.
Proof.
  intros few run culled t time_ contact.
  assert (edge_is : forall c, is_at_most value_of L (names_of_a_vertex_and_a_face c)) by (in_range_of names_of_a_vertex_and_a_face run culled).
  assert (in_range : forall c, is_at_most value_of (reach f) c).
  { intros [s i k]. destruct s.
    - apply (less_than_reach f ok), (edge_is (Component P i k)).
    - apply (less_than_reach f ok), (edge_is (Component B i k)).
    - apply (less_than_reach f ok), (edge_is (Component C i k)).
    - apply (third_side f ok _ _ value_of run (Span S3 i k) (Span S0 i k) (Span S1 i k)); [|exact (edge_is (Component P i k))|exact (edge_is (Component B i k))].
      unfold exactly, from_of, to_of; simpl; ring.
    - apply (third_side f ok _ _ value_of run (Span S4 i k) (Span S0 i k) (Span S2 i k)); [|exact (edge_is (Component P i k))|exact (edge_is (Component C i k))].
      unfold exactly, from_of, to_of; simpl; ring. }
  destruct (parts_are_clear a_vertex_and_a_face.ends names_of_a_vertex_and_a_face corners_of_a_vertex_and_a_face 1 2 3 0 run in_range
    ltac:(vm_compute; reflexivity) ltac:(repeat split; vm_compute; congruence) halvings few) with (t := t) as [volume_|axis_]; try assumption.
  - intro s. unfold bernstein, three_volumes, exact_controls. rewrite bernstein_form. cbn [x0 x1 x2 x3].
    cbv -[Rplus Rminus Rmult Ropp pow IZR]. ring.
  - apply volume_. unfold three_volumes. rewrite (vertex_in_triangle_is_flat _ _ _ _ contact). ring.
  - destruct (side_of_axis _ _ _ axis_) as (w & ahead_). revert contact.
    apply (Apart.ahead_of_a_triangle w); [apply (ahead_ 0%nat)|apply (ahead_ 2%nat)|apply (ahead_ 3%nat)]; (lia || reflexivity).
Qed.
Theorem parts_of_two_edges halvings : (halvings <= 4)%nat ->
  execution f (from_of place two_edges.ends) (to_of place two_edges.ends) value_of ->
  says f value_of (clear_in_parts names_of_two_edges corners_of_two_edges halvings) -> Apart.never_touch_edges place.
Proof.
  intros few run culled t time_ contact.
  assert (edge_is : forall c, is_at_most value_of L (names_of_two_edges c)) by (in_range_of names_of_two_edges run culled).
  assert (in_range : forall c, is_at_most value_of (reach f) c).
  { intros [s i k]. destruct s.
    - apply (less_than_reach f ok), (edge_is (Component B i k)).
    - apply (less_than_reach f ok), (edge_is (Component C i k)).
    - apply (less_than_reach f ok), (edge_is (Component P i k)).
    - apply (third_side f ok _ _ value_of run (Span S3 i k) (Span S0 i k) (Span S2 i k)); [|exact (edge_is (Component B i k))|exact (edge_is (Component P i k))].
      unfold exactly, from_of, to_of; simpl; ring.
    - apply (third_side f ok _ _ value_of run (Span S4 i k) (Span S1 i k) (Span S2 i k)); [|exact (edge_is (Component C i k))|exact (edge_is (Component P i k))].
      unfold exactly, from_of, to_of; simpl; ring. }
  destruct (parts_are_clear two_edges.ends names_of_two_edges corners_of_two_edges 2 0 1 3 run in_range
    ltac:(vm_compute; reflexivity) ltac:(repeat split; vm_compute; congruence) halvings few) with (t := t) as [volume_|axis_]; try assumption.
  - intro s. unfold bernstein, three_volumes, exact_controls. rewrite bernstein_form. cbn [x0 x1 x2 x3].
    cbv -[Rplus Rminus Rmult Ropp pow IZR]. ring.
  - apply volume_. unfold three_volumes. rewrite (segments_that_meet_are_flat _ _ _ _ contact). ring.
  - destruct (side_of_axis _ _ _ axis_) as (w & ahead_). revert contact.
    apply (Apart.ahead_of_a_segment w); [apply (ahead_ 0%nat)|apply (ahead_ 1%nat)|apply (ahead_ 2%nat)|apply (ahead_ 3%nat)]; (lia || reflexivity).
Qed.
End OfAPair.
