(* Why a gap between sums suffices where operands count as zero: sums of two numbers, each rounded once in one direction. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions Orders.
Open Scope R_scope.

Section Gaps.
Variable f : format.
Hypothesis ok : reasonable f.
Variable of : environment.
(* The gap is 2^g; in units of it sums are large from θ on, and then multiples of 2^(g - 8). *)
Variable g : Z.
Notation gap := (power g).
Notation l := (lam f).
Notation e1 := (eps f).
Notation lowest := (least_exponent f + precision f - 1)%Z.
Hypothesis wide_ : (lowest + precision f + 9 <= g)%Z.
Notation seen := (seen f of).
Notation rounded := (rounded f of).
Notation theta := (power (g + precision f - 4)).

Lemma bp_le a b : (a <= b)%Z -> power a <= power b. Proof. intro. now apply bpow_le. Qed.
Lemma bp_pos a : 0 < power a. Proof. apply bpow_gt_0. Qed.
Lemma bp_plus a b : power (a + b) = power a * power b. Proof. apply bpow_plus. Qed.
Lemma gap_wide : 1024 * l <= gap.
Proof. unfold lam. replace 1024 with (power 10) by (unfold power; simpl; lra). rewrite <- bp_plus. apply bp_le. destruct ok; lia. Qed.
Lemma e_theta : e1 * theta = gap / 8.
Proof. unfold eps. rewrite <- bp_plus. replace (1 - precision f + (g + precision f - 4))%Z with (g + -3)%Z by ring. rewrite bp_plus. unfold power at 2. simpl. lra. Qed.
Lemma theta_wide : 1024 * l <= theta.
Proof. eapply Rle_trans; [apply gap_wide|]. apply bp_le. destruct ok; lia. Qed.

(* A number that is not flushed: zero, or not below the normal numbers. *)
Definition solid x := representable f x /\ (x = 0 \/ l <= Rabs x).
Lemma multiple x n : representable f x -> (least_exponent f <= n + 1 - precision f)%Z -> power n <= Rabs x ->
  exists k, x = IZR k * power (n + 1 - precision f).
Proof.
  intros rep low big. unfold representable, generic_format, F2R in rep. cbn [Fnum Fexp] in rep.
  set (m := Ztrunc _) in rep. set (c := cexp radix2 (FLT_exp (least_exponent f) (precision f)) x) in rep.
  assert (mag_ : (n + 1 <= mag radix2 x)%Z).
  { apply mag_ge_bpow. replace (n + 1 - 1)%Z with n by ring. exact big. }
  assert (up : (n + 1 - precision f <= c)%Z).
  { unfold c, cexp, FLT_exp. lia. }
  exists (m * 2 ^ (c - (n + 1 - precision f)))%Z. rewrite mult_IZR. change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia.
  rewrite rep at 1. rewrite Rmult_assoc. unfold power. rewrite <- bpow_plus. f_equal. f_equal. ring.
Qed.
Lemma multiple_scaled x n k : x = IZR k * power n -> forall n', (n' <= n)%Z -> exists k', x = IZR k' * power n'.
Proof.
  intros -> n' le. exists (k * 2 ^ (n - n'))%Z. rewrite mult_IZR. change 2%Z with (radix_val radix2). rewrite IZR_Zpower by lia.
  rewrite Rmult_assoc. unfold power. rewrite <- bpow_plus. f_equal. f_equal. ring.
Qed.
Lemma positive_multiple k n : 0 < IZR k * power n -> power n <= IZR k * power n.
Proof.
  intro p. pose proof (bp_pos n). assert (0 < IZR k) by (apply (Rmult_lt_reg_r (power n)); lra). apply (lt_IZR 0) in H0.
  assert (1 <= IZR k) by (apply IZR_le; lia). rewrite <- (Rmult_1_l (power n)) at 1. apply Rmult_le_compat_r; lra.
Qed.
Notation big x := (power (g + precision f - 7) <= Rabs x).
Notation V := (power (g - 6)).
Lemma big_multiple x : representable f x -> big x -> exists k, x = IZR k * V.
Proof.
  intros rep h. destruct (multiple x (g + precision f - 7) rep) as [k E]; [destruct ok; lia|exact h|]. exists k.
  rewrite E. f_equal. f_equal. ring.
Qed.
Lemma V_wide : 2 * power (lowest + precision f) <= V.
Proof. replace 2 with (power 1) by reflexivity. rewrite <- bp_plus. apply bp_le. lia. Qed.
Lemma V_l : 4 * l <= V.
Proof. replace 4 with (power 2) by (unfold power; simpl; lra). unfold lam. rewrite <- bp_plus. apply bp_le. destruct ok; lia. Qed.

(* Two large numbers, and one that is not flushed, are at least λ above zero if they are above it. *)
Lemma three_above p q r : representable f p -> representable f q -> big p -> big q -> solid r -> 0 < p + q + r -> l <= p + q + r.
Proof.
  intros rp rq bp bq [rr hr] pos. destruct (big_multiple p rp bp) as [i ->]. destruct (big_multiple q rq bq) as [j ->].
  destruct (Rlt_le_dec (Rabs r) (power (lowest + precision f))) as [small|large].
  - pose proof V_wide as w. replace (IZR i * V + IZR j * V) with (IZR (i + j) * V) in * by (rewrite plus_IZR; ring).
    pose proof V_l. destruct (Z_lt_le_dec 0 (i + j)) as [up|down].
    + assert (0 < IZR (i + j) * V) by (apply Rmult_lt_0_compat; [now apply IZR_lt|apply bp_pos]).
      apply positive_multiple in H0. apply Rabs_lt_inv in small. pose proof (bp_pos (g - 6)). pose proof (lam_pos f). lra.
    + assert (IZR (i + j) * V <= 0).
      { apply IZR_le in down. pose proof (bp_pos (g - 6)). nra. }
      assert (0 < r) by lra. destruct hr as [->|h]; [lra|]. rewrite Rabs_pos_eq in h by lra.
      destruct (Z.eq_dec (i + j) 0) as [->|n]; [lra|]. exfalso.
      assert (IZR (i + j) <= -1) by (apply IZR_le; lia). apply Rabs_lt_inv in small. pose proof (bp_pos (g - 6)). nra.
  - destruct (multiple r (lowest + precision f) rr) as [k E]; [destruct ok; lia|exact large|].
    replace (lowest + precision f + 1 - precision f)%Z with (lowest + 1)%Z in E by ring.
    destruct (multiple_scaled r _ k E lowest ltac:(lia)) as [k' E'].
    destruct (multiple_scaled (IZR i * V) _ i eq_refl lowest) as [i' Ei]; [destruct ok; lia|].
    destruct (multiple_scaled (IZR j * V) _ j eq_refl lowest) as [j' Ej]; [destruct ok; lia|].
    rewrite E', Ei, Ej in *. replace (IZR i' * power lowest + IZR j' * power lowest + IZR k' * power lowest) with
      (IZR (i' + j' + k') * power lowest) in * by (rewrite !plus_IZR; ring). apply positive_multiple in pos. exact pos.
Qed.

(* a stands for the coordinate a as it is seen. *)
Definition sees a a' := solid a' /\ (a' = a \/ (a' = 0 /\ Rabs a < l)).
Lemma seen_solid a : representable f a -> flushes_operands of = true -> sees a (seen a).
Proof.
  intros rep daz. unfold Orders.seen. rewrite daz. unfold flushed. destruct (Rlt_dec (Rabs a) l) as [s|n].
  - split; [split; [apply generic_format_0|auto]|auto].
  - split; [split; [assumption|right; lra]|auto].
Qed.
Lemma opposite_sees a a' : sees a a' -> sees (- a) (- a').
Proof.
  intros [[r h] w]. repeat split.
  - now apply generic_format_opp.
  - destruct h as [->|h]; [left; ring|right; now rewrite Rabs_Ropp].
  - destruct w as [->|[-> w]]; [auto|right; rewrite Rabs_Ropp; split; [ring|assumption]].
Qed.
Lemma sees_off a a' : sees a a' -> Rabs (a - a') < l.
Proof.
  pose proof (lam_pos f). intros [_ [->|[-> h]]]; [replace (a - a) with 0 by ring; rewrite Rabs_R0; lra|now rewrite Rminus_0_r].
Qed.

(* Large sums in strict order, of which something was flushed. *)
Lemma large_sums a b c d a' b' c' d' : sees a a' -> sees b b' -> sees c c' -> sees d d' ->
  theta / 2 <= Rabs (c' + d') -> c' + d' < a' + b' -> c + d < a + b.
Proof.
  intros sa sb sc sd large order. pose proof (lam_pos f) as l0. pose proof theta_wide as tw.
  pose proof (sees_off _ _ sa) as oa. pose proof (sees_off _ _ sb) as ob. pose proof (sees_off _ _ sc) as oc. pose proof (sees_off _ _ sd) as od.
  apply Rabs_lt_inv in oa. apply Rabs_lt_inv in ob. apply Rabs_lt_inv in oc. apply Rabs_lt_inv in od.
  destruct (Rle_lt_dec (4 * l) (a' + b' - (c' + d'))) as [far|near]; [lra|].
  assert (theta8 : power (g + precision f - 7) = theta / 8).
  { replace (g + precision f - 7)%Z with (g + precision f - 4 + -3)%Z by ring. rewrite bp_plus. unfold power at 2. simpl. lra. }
  assert (one_big : forall x y, theta / 2 - 4 * l <= Rabs (x + y) -> big x \/ big y).
  { intros x y h. rewrite theta8. destruct (Rle_lt_dec (theta / 8) (Rabs x)); [auto|]. destruct (Rle_lt_dec (theta / 8) (Rabs y)); [auto|].
    pose proof (Rabs_triang x y). lra. }
  assert (s_large : theta / 2 - 4 * l <= Rabs (a' + b')).
  { replace (a' + b') with ((c' + d') - - (a' + b' - (c' + d'))) by ring. eapply Rle_trans; [|apply Rabs_triang_inv].
    rewrite Rabs_Ropp, (Rabs_pos_eq (a' + b' - (c' + d'))) by lra. lra. }
  assert (t_large : theta / 2 - 4 * l <= Rabs (c' + d')) by lra.
  pose proof (one_big _ _ s_large) as bs. pose proof (one_big _ _ t_large) as bt.
  (* By symmetry the first of each is the large one. *)
  assert (core_ : forall a b c d a' b' c' d', sees a a' -> sees b b' -> sees c c' -> sees d d' -> big a' -> big c' -> c' + d' < a' + b' -> c + d < a + b).
  { clear - ok wide_. intros a b c d a' b' c' d' [[ra ha] wa] [sb wb] [[rc hc] wc] [sd wd] ba bc order. pose proof (lam_pos f) as l0.
    assert (V8 : 1024 * l <= power (g + precision f - 7)).
    { unfold lam. replace 1024 with (power 10) by (unfold power; simpl; lra). rewrite <- bp_plus. apply bp_le. destruct ok; lia. }
    assert (a' = a) as ->. { destruct wa as [|[-> _]]; [assumption|rewrite Rabs_R0 in ba; lra]. }
    assert (c' = c) as ->. { destruct wc as [|[-> _]]; [assumption|rewrite Rabs_R0 in bc; lra]. }
    assert (rc' : representable f (- c)) by (now apply generic_format_opp). assert (bc' : big (- c)) by (now rewrite Rabs_Ropp).
    destruct wb as [->|[-> hb]], wd as [->|[-> hd]].
    - lra.
    - pose proof (three_above a (- c) b ra rc' ba bc' sb ltac:(lra)). apply Rabs_lt_inv in hd. lra.
    - assert (sd' : solid (- d)). { destruct sd as [r [->|h]]; split; try (now apply generic_format_opp); [left; ring|right; now rewrite Rabs_Ropp]. }
      pose proof (three_above a (- c) (- d) ra rc' ba bc' sd' ltac:(lra)). apply Rabs_lt_inv in hb. lra.
    - destruct (big_multiple a ra ba) as [i E]. destruct (big_multiple c rc bc) as [j E'].
      assert (0 < IZR (i - j) * V) by (rewrite minus_IZR; lra). apply positive_multiple in H. rewrite minus_IZR in H.
      pose proof V_l. apply Rabs_lt_inv in hb. apply Rabs_lt_inv in hd. lra. }
  destruct bs as [ba|bb], bt as [bc|bd].
  - exact (core_ a b c d a' b' c' d' sa sb sc sd ba bc order).
  - assert (d + c < a + b); [|lra]. apply (core_ a b d c a' b' d' c'); auto; lra.
  - assert (c + d < b + a); [|lra]. apply (core_ b a c d b' a' c' d'); auto; lra.
  - assert (d + c < b + a); [|lra]. apply (core_ b a d c b' a' d' c'); auto; lra.
Qed.

(* From what is compared. *)
Hypothesis daz : flushes_operands of = true.
Lemma seen_same x : l <= Rabs x -> seen x = x.
Proof. intro h. unfold Orders.seen. rewrite daz. unfold flushed. destruct (Rlt_dec _ _); [lra|reflexivity]. Qed.
Lemma seen_near x : Rabs (seen x - x) <= l /\ Rabs (seen x) <= Rabs x.
Proof.
  pose proof (lam_pos f). unfold Orders.seen. rewrite daz. unfold flushed. destruct (Rlt_dec (Rabs x) l).
  - rewrite Rabs_R0. replace (0 - x) with (- x) by ring. rewrite Rabs_Ropp. pose proof (Rabs_pos x). lra.
  - replace (x - x) with 0 by ring. rewrite Rabs_R0. lra.
Qed.
Lemma seen_zero : seen 0 = 0. Proof. unfold Orders.seen. rewrite daz. unfold flushed. now destruct (Rlt_dec _ _). Qed.
Lemma solid_same z : solid z -> seen z = z /\ rounded z = z.
Proof.
  intros [rep [->|h]].
  - split; [apply seen_zero|]. unfold Orders.rounded. rewrite round_0 by exact (Orders.valid of). destruct (flushes_results of); [|reflexivity].
    unfold flushed. now destruct (Rlt_dec _ _).
  - split; [now apply seen_same|now apply (rounded_exactly f of)].
Qed.
Lemma rounded_rounds z : rounds f z (rounded z).
Proof.
  pose proof (Orders.valid of). unfold Orders.rounded. destruct (flushes_results of); [|right; exists (direction of); auto].
  unfold flushed. destruct (Rlt_dec _ _) as [s|n]; [|right; exists (direction of); auto]. left. split; [|reflexivity].
  apply Rnot_le_lt. intro big_. apply (Rlt_not_le _ _ s). pose proof (Arithmetic.valid f ok).
  apply abs_round_ge_generic; auto with typeclass_instances. apply (lam_representable f ok).
Qed.
Lemma gap_seen : seen gap = gap.
Proof. apply seen_same. pose proof gap_wide. pose proof (lam_pos f). rewrite Rabs_pos_eq by apply bpow_ge_0. lra. Qed.
Lemma over_gap z : solid z -> z <= seen (rounded (z + gap)).
Proof.
  intro h. destruct (solid_same z h) as [a b]. rewrite <- a at 1. apply seen_monotone. rewrite <- b at 1. apply (rounded_monotone f of ok).
  pose proof (bp_pos g). lra.
Qed.
Lemma one_gap u v x : seen (rounded (Rmax u v + gap)) < x -> seen (rounded (u + gap)) < x /\ seen (rounded (v + gap)) < x.
Proof.
  intro h. split; (eapply Rle_lt_trans; [|exact h]); apply seen_monotone, (rounded_monotone f of ok), Rplus_le_compat_r; [apply Rmax_l|apply Rmax_r].
Qed.
Lemma coordinates_in_order a c : representable f c -> seen (rounded (seen c + gap)) < seen a -> c < a.
Proof.
  intros rc h. apply (seen_order f of). eapply Rle_lt_trans; [|exact h]. apply over_gap. exact (proj1 (seen_solid c rc daz)).
Qed.
Lemma result_solid z : solid (seen (rounded z)).
Proof. exact (proj1 (seen_solid _ (rounded_representable f of ok z) daz)). Qed.
Theorem sums_in_order a b c d : representable f a -> representable f b -> representable f c -> representable f d ->
  seen (rounded (seen (rounded (seen c + seen d)) + gap)) < seen (rounded (seen a + seen b)) -> c + d < a + b.
Proof.
  intros ra rb rc rd h. pose proof (seen_solid a ra daz) as sa. pose proof (seen_solid b rb daz) as sb.
  pose proof (seen_solid c rc daz) as sc. pose proof (seen_solid d rd daz) as sd.
  set (s := seen a + seen b) in *. set (t := seen c + seen d) in *. set (z := seen (rounded t)) in *. set (x := seen (rounded s)) in *.
  pose proof (lam_pos f) as l0. pose proof gap_wide as gw. pose proof theta_wide as tw. pose proof e_theta as et.
  pose proof (eps_pos f) as ep. pose proof (eps_small f ok) as es. pose proof (bp_pos g) as g0.
  assert (zx : z < x) by (eapply Rle_lt_trans; [apply over_gap, result_solid|exact h]).
  pose proof (rounding_error_by_result f ok _ _ (rounded_rounds t)) as Et. pose proof (rounding_error_by_result f ok _ _ (rounded_rounds s)) as Es.
  destruct (Rlt_le_dec theta (Rabs z)) as [large|small].
  - assert (same : rounded t = z).
    { unfold z in *. unfold Orders.seen in *. rewrite daz in *. unfold flushed in *. destruct (Rlt_dec (Rabs (rounded t)) l); [rewrite Rabs_R0 in large; lra|reflexivity]. }
    apply (large_sums a b c d (seen a) (seen b) (seen c) (seen d) sa sb sc sd).
    + fold t. rewrite same in Et. pose proof (Rabs_triang (z - t) t) as T. replace (z - t + t) with z in T by ring.
      assert (e1 * Rabs z <= / 8388608 * Rabs z) by (apply Rmult_le_compat_r; lra). lra.
    + fold s t. apply (rounded_order f of ok). apply (seen_order f of). exact zx.
  - pose proof (sees_off _ _ sa) as oa. pose proof (sees_off _ _ sb) as ob. pose proof (sees_off _ _ sc) as oc. pose proof (sees_off _ _ sd) as od.
    apply Rabs_lt_inv in oa. apply Rabs_lt_inv in ob. apply Rabs_lt_inv in oc. apply Rabs_lt_inv in od.
    pose proof (rounding_error f ok _ _ (rounded_rounds (z + gap))) as Ey. pose proof (seen_near (rounded (z + gap))) as [Ny _].
    pose proof (seen_near (rounded t)) as [Nt _]. pose proof (seen_near (rounded s)) as [Ns _]. fold z in Nt. fold x in Ns.
    set (y := seen (rounded (z + gap))) in *.
    assert (ez : e1 * Rabs z <= gap / 8) by (rewrite <- et; apply Rmult_le_compat_l; lra).
    assert (eg : e1 * gap <= / 8388608 * gap) by (apply Rmult_le_compat_r; lra).
    assert (el : e1 * l <= l) by (rewrite <- (Rmult_1_l l) at 2; apply Rmult_le_compat_r; lra).
    assert (Ez : e1 * Rabs (z + gap) <= e1 * Rabs z + e1 * gap).
    { rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq gap); lra. }
    assert (Et' : e1 * Rabs (rounded t) <= e1 * Rabs z + e1 * l).
    { rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; [lra|]. replace (rounded t) with (z + - (z - rounded t)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    assert (Es' : e1 * Rabs (rounded s) <= e1 * Rabs x + e1 * l).
    { rewrite <- Rmult_plus_distr_l. apply Rmult_le_compat_l; [lra|]. replace (rounded s) with (x + - (x - rounded s)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    apply Rabs_le_inv in Et. apply Rabs_le_inv in Es. apply Rabs_le_inv in Ey. apply Rabs_le_inv in Ny. apply Rabs_le_inv in Nt. apply Rabs_le_inv in Ns.
    assert (apart_ : z + 3 / 4 * gap < x) by lra.
    unfold s, t in *. apply Rabs_le_inv in small.
    destruct (Rle_lt_dec (Rabs x) (2 * (theta + gap))) as [near|far].
    + assert (e1 * Rabs x <= e1 * (2 * (theta + gap))) by (apply Rmult_le_compat_l; lra). lra.
    + assert (0 < x). { apply Rnot_le_lt. intro n. rewrite Rabs_left1 in far by exact n. lra. }
      rewrite (Rabs_pos_eq x) in far, Es' by lra. assert (e1 * x <= / 8388608 * x) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Theorem differences_in_order a b c d : representable f a -> representable f b -> representable f c -> representable f d ->
  seen (rounded (seen (rounded (seen c - seen d)) + gap)) < seen (rounded (seen a - seen b)) -> c - d < a - b.
Proof.
  intros ra rb rc rd h. unfold Rminus in *. rewrite <- !(seen_opposite f of) in h.
  apply (sums_in_order a (- b) c (- d)); auto; now apply generic_format_opp.
Qed.
End Gaps.
