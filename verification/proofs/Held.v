(* A direction that is held, turns or moves on a curve: where the code's comparisons say that it keeps a pair apart, all
   exact products of the direction with the pair's corners exceed the separation.
   core/src/kernels/advance/directions.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Directions.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

Section Held.
Load "Setting.section".
Load "InRange.section".

Notation constant := (constant f env given value_of run).
Notation along := (along f env given).
Notation is_short := (is_short f env given).
Notation sizes := (sizes f env given value_of pairs).
Notation lengths := (lengths f env given).
Notation err := (err f env given value_of pairs).
Notation exact_product := (exact_product f env given).
Notation size_bounds := (within size_bounds).
Notation end_holds := (within product_holds_at_end).
Notation moment_holds := (within product_holds_at).
Notation err_covers := (within err_covers).
Notation q_error := (q_error f fine).
Notation greater_holds := (greater_holds f env).
Notation greater_than := (greater_than f env).
Notation T n := (seen (given (Moment n))).

(* A bar B that is large enough for products that must exceed r. *)
Definition is_bar k b r := exists B, value_of b = Number B /\ representable f B /\
  1.1 * err k + 100 * l + (1 + 2 * e1) * r <= B <= 4 * (G * G) /\ 0 <= r.
Lemma bar_normal k B r : is_short k -> 1.1 * err k + 100 * l + r <= B -> 0 <= r -> l <= B /\ seen B = B.
Proof.
  intros short big r0. pose proof (size_bounds k short) as (_ & _ & e0). pose proof (l_pos f). split; [lra|].
  apply seen_of_normal. rewrite Rabs_pos_eq; lra.
Qed.
Lemma bar_weaker k B r : 1.1 * err k + 100 * l + (1 + 2 * e1) * r <= B -> 0 <= r -> 1.1 * err k + 100 * l + r <= B.
Proof. intros big r0. pose proof (e_pos f). assert (0 <= e1 * r) by (apply Rmult_le_pos; lra). lra. Qed.
(* A product at a moment. *)
Lemma ahead_at k b n pair r : In pair pairs -> is_short k -> 0 <= T n <= 1 -> is_bar k b r -> says f env value_of
  (is_ahead k b n pair) ->
  r < exact_product k pair (T n).
Proof.
  intros inside short time (B & E & rep & big & r0) ahead. cbn in ahead. rewrite E in ahead. destruct big as [big _].
  apply bar_weaker in big; [|exact r0].
  destruct (bar_normal k B r short big r0) as [lB _]. pose proof (size_bounds k short) as (_ & _ & e0).
    pose proof (l_pos f).
  destruct (greater_holds _ _ _ _ _ _ (moment_holds k pair n inside short time) lB ahead) as (x & _ & _ & beyond & _ &
    near_).
  pose proof (err_covers k _ _ _ short near_ ltac:(lra)) as off. apply Rabs_le_inv in off. lra.
Qed.

Lemma linear_between k pair s e t r : s <= t <= e -> r < exact_product k pair s -> r < exact_product k pair e -> r <
  exact_product k pair t.
Proof.
  intros [st te] a b. destruct (Req_dec s t) as [->|n]; [exact a|].
  assert (E : (e - s) * (exact_product k pair t - r) = (e - t) * (exact_product k pair s - r) + (t - s) * (exact_product
    k pair e - r)).
  { unfold exact_product, sum3, exactly_at. ring. }
  assert (0 <= (e - t) * (exact_product k pair s - r)) by (apply Rmult_le_pos; lra).
  assert (0 < (t - s) * (exact_product k pair e - r)) by (apply Rmult_lt_0_compat; lra).
  assert (0 < exact_product k pair t - r); [|lra]. apply Rmult_lt_reg_l with (e - s); lra.
Qed.

(* The line through the computed products at the ends is near the exact one, and falls to the bar at the quotient. *)
Lemma line_is_near k pair fs fe B r : In pair pairs -> is_short k ->
  near f fs (exact_product k pair 0) (sizes k) 4 (4.2 * lengths k + 9.2) ->
  near f fe (exact_product k pair 1) (sizes k) 4 (4.2 * lengths k + 9.2 + 1) ->
  1.1 * err k + 100 * l + r <= B -> forall t, 0 <= t <= 1 -> (t - 3 * l) * (fs - fe) <= fs - B -> r < exact_product k
    pair t.
Proof.
  intros inside short ns ne big t t01 below_. pose proof (size_bounds k short) as (S & V & _). pose proof (l_pos f).
    pose proof (e_pos f).
  pose proof (l_small f ok). pose proof (l_e f fine) as le. pose proof (q_error 4 ltac:(lia)) as q4.
    replace (INR 4) with 4 in q4 by (simpl; ring).
  pose proof (near_size f _ _ _ _ _ ns) as ss. pose proof (near_size f _ _ _ _ _ ne) as se. pose proof (e_small f ok).
  destruct ns as (ds & _ & _), ne as (de & _ & _).
  assert ((q 4 - 1) * sizes k <= 4.004 * e1 * sizes k) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * sizes k <= / 8388608 * sizes k) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (q 4 * sizes k <= 1.001 * sizes k) by lra.
  assert (lS : 0 <= l * sizes k <= / 1000000 * (e1 * sizes k)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1000000 * (e1 * sizes k)) with (/ 1000000 * e1 * sizes k) by ring. apply Rmult_le_compat_r; lra. }
  assert (lV : 0 <= l * lengths k) by (apply Rmult_le_pos; lra).
  assert (llV : l * (l * lengths k) <= / 1000 * (l * lengths k)) by (apply Rmult_le_compat_r; lra).
  assert (ll : l * l <= / 1000 * l) by (apply Rmult_le_compat_r; lra).
  apply Rabs_le_inv in ds. apply Rabs_le_inv in de. apply Rabs_le_inv in ss. apply Rabs_le_inv in se.
  assert (slope : fs - fe <= 2.002 * sizes k + l * (8.4 * lengths k + 20)) by lra.
  assert (l * (fs - fe) <= l * (2.002 * sizes k + l * (8.4 * lengths k + 20))) by (apply Rmult_le_compat_l; lra).
  set (E := 4.004 * e1 * sizes k + l * (4.2 * lengths k + 10.2)).
  assert (low_s : fs - E <= exact_product k pair 0) by (unfold E; lra).
  assert (low_e : fe - E <= exact_product k pair 1) by (unfold E; lra).
  rewrite exact_product_linear.
  assert ((1 - t) * (fs - E) <= (1 - t) * exact_product k pair 0) by (apply Rmult_le_compat_l; lra).
  assert (t * (fe - E) <= t * exact_product k pair 1) by (apply Rmult_le_compat_l; lra).
  unfold Directions.err in big. unfold E in *. lra.
Qed.

(* What is positive is infinite, or a number that is seen as it is; the smaller of it and such a number is no larger
   than either. *)
Lemma positive_value v : greater f env v (value_of (Constant (Small 0))) -> v = Infinite true \/ exists y,
  v = Number y /\ 0 < y /\ seen y = y.
Proof.
  rewrite constant. cbn [constant_value]. unfold greater, seen_value. destruct v as [x|[|]|]; try tauto.
    rewrite seen_0. intro h.
  right. exists x. split; [reflexivity|]. rewrite (seen_positive f env x) in * by exact h. auto.
Qed.
Lemma smaller_value v t out : (v = Infinite true \/ exists y, v = Number y /\ 0 < y /\
  seen y = y) -> 0 < t -> seen t = t ->
  smaller f env v (Number t) out -> exists t', out = Number t' /\ 0 < t' <= t /\ seen t' = t' /\
    forall y, v = Number y -> t' <= y.
Proof.
  intros [->|(y & -> & y0 & ys)] t0 ts [[g [-> | ->]]|[g [-> | ->]]]; cbn in *; try tauto; rewrite ?ts, ?ys in *;
    eexists; (split; [reflexivity|]); (split; [lra|]); (split; [assumption|]); intros z E; try discriminate;
      injection E as <-; lra.
Qed.

(* A quotient that the code takes: up to there the line is above the bar, but for 3λ; and if it is infinite, all along
   the step. *)
Lemma quotient_value k b pair fs fe B : value_of (dot_ (direction k) (at_start pair)) = Number fs ->
  value_of (dot_ (direction k) (at_end pair)) = Number fe -> value_of b = Number B ->
  representable f fs -> representable f fe -> representable f B -> 0 < B -> seen B = B ->
  Rabs fs <= 2 * (G * G) -> Rabs fe <= 2 * (G * G) -> B <= 4 * (G * G) -> seen fe <= B -> says f env value_of (falls k b
    pair) ->
  let q2 := value_of (quotient_of k b pair) in let below_ t := (t - 3 * l) * (fs - seen fe) <= fs - B in
  seen fs = fs /\ (forall y t, q2 = Number y -> t <= y -> t <= 1 -> below_ t) /\
    (q2 = Infinite true -> forall t, t <= 1 -> below_ t).
Proof.
  intros Es Ee EB rs re rB B0 sB small_s small_e small_B not_stays [g positive]. cbv zeta.
  pose proof (e_pos f) as e0. pose proof (e_small f ok). pose proof (l_pos f) as l0. pose proof (l_small f ok).
    pose proof (l_e f fine).
  pose proof (G_2 f fine). pose proof (G_4 f fine). pose proof (omega_large f ok).
    assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  cbn -[dot_ at_start at_end] in g. rewrite Es, Ee in g. cbn in g. set (FE := seen fe) in *.
  pose proof (seen_smaller f env fs) as ss. pose proof (seen_smaller f env fe) as se. fold FE in se.
  assert (Rabs (seen fs) <= 2 * (G * G)) by lra. assert (Rabs FE <= 2 * (G * G)) by lra.
  assert (num : value_of (Minus (dot_ (direction k) (at_start pair)) b) = Number (Rd (seen fs - B))).
  { pose proof (run (Minus (dot_ (direction k) (at_start pair)) b)) as h. cbn -[dot_ at_start at_end] in h.
    rewrite Es, EB in h. cbn in h. rewrite sB in h.
    apply (result_number f ok env) in h; [exact h|]. eapply Rle_trans; [apply Rabs_triang|].
      rewrite Rabs_Ropp, (Rabs_pos_eq B); lra. }
  assert (den : value_of (Minus (dot_ (direction k) (at_start pair)) (dot_ (direction k) (at_end pair))) = Number (Rd
    (seen fs - FE))).
  { pose proof (run (Minus (dot_ (direction k) (at_start pair)) (dot_ (direction k) (at_end pair)))) as h.
    cbn -[dot_ at_start at_end] in h.
    rewrite Es, Ee in h. cbn in h. fold FE in h.
    apply (result_number f ok env) in h; [exact h|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  set (N := Rd (seen fs - B)) in *. set (Dn := Rd (seen fs - FE)) in *.
  assert (D0 : 0 <= Dn) by (apply rounded_positive; lra). assert (ND : N <= Dn) by (apply (monotone env); lra).
  destruct (here less_roundoffs_value) as (c & Ec & c0 & c1).
  assert (sc : seen c = c) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
  set (numerator := Minus (dot_ (direction k) (at_start pair)) b) in *.
  set (divisor := Minus (dot_ (direction k) (at_start pair)) (dot_ (direction k) (at_end pair))) in *.
  pose proof (run (Quotient numerator divisor)) as hq. cbn -[numerator divisor is_positive_unrounded] in hq.
    rewrite num, den in hq. cbn -[divisor is_positive_unrounded] in hq.
  assert (divisor_positive : is_positive_unrounded f env value_of divisor).
  { unfold divisor. cbn -[dot_ at_start at_end]. rewrite Es, Ee. exact g. }
  pose proof (run (quotient_of k b pair)) as hp. unfold quotient_of in hp. fold numerator divisor in hp.
  cbn -[numerator divisor less_roundoffs] in hp. rewrite Ec in hp. unfold product in hp. cbn [seen_value] in hp.
    rewrite sc in hp.
  change (greater f env (value_of (quotient_of k b pair)) (value_of (Constant (Small 0)))) in positive.
  unfold quotient_of in positive |- *. fold numerator divisor in positive |- *.
  set (q1 := value_of (Quotient numerator divisor)) in *. set (q2 := value_of (Product (Quotient numerator divisor)
    (less_roundoffs 32))) in *.
  assert (not_positive : forall x, x <= 0 -> q1 = Number x -> False).
  { intros x x0 E. rewrite E in hp. cbn in hp. pose proof (seen_monotone f env x 0 x0) as sx. rewrite seen_0 in sx.
    assert (sc0 : seen x * c <= 0). { assert (0 <= - seen x * c) by (apply Rmult_le_pos; lra). lra. }
    pose proof (monotone env _ _ sc0) as r0. rewrite rounded_0 in r0. apply positive_value in positive.
    destruct hp as [[_ hp]|[[over _]|[_ [hp|hp]]]]; try lra; rewrite hp in positive;
      destruct positive as [E'|(y & E' & y0 & _)];
      try discriminate; injection E' as <-; lra. }
  assert (not_infinite : q1 = Infinite false -> False).
  { intro E. rewrite E in hp. cbn in hp. rewrite hp in positive by lra. apply positive_value in positive.
    destruct positive as [E'|(y & E' & _)]; discriminate. }
  destruct (Req_dec (seen Dn) 0) as [zero|nonzero].
  - destruct hq as (_ & nan & _ & neg). pose proof (seen_monotone f env N Dn ND).
    destruct (Req_dec (seen N) 0) as [nz|nn].
    + rewrite (nan zero nz) in hp. cbn in hp. rewrite hp in positive. destruct positive.
    + destruct (not_infinite (neg zero ltac:(lra) divisor_positive)).
  - destruct hq as (hq & _). specialize (hq nonzero).
    assert (sD : 0 < seen Dn). { pose proof (seen_monotone f env 0 Dn D0) as h. rewrite seen_0 in h. lra. }
    assert (D1 := sD). rewrite (seen_positive f env Dn sD) in D1, hq. set (z := seen N / Dn) in *.
    assert (z0 : 0 < z).
    { apply Rnot_le_lt. intro z0. pose proof (monotone env _ _ z0) as r0. rewrite rounded_0 in r0.
      destruct hq as [[_ hq]|[[over _]|[_ [hq|hq]]]]; [exact (not_positive _ r0 hq)|lra|exact (not_infinite hq)|].
      apply (not_positive (- omega f)); [lra|exact hq]. }
    assert (sN : 0 < seen N). { unfold z, Rdiv in z0. apply Rmult_lt_reg_r with (/ Dn); [now apply Rinv_0_lt_compat|].
      lra. }
    assert (N0 := sN). rewrite (seen_positive f env N sN) in N0.
    assert (A0 : 0 < seen fs - B).
    { apply Rnot_le_lt. intro h. pose proof (monotone env _ _ h) as r0. rewrite rounded_0 in r0. fold N in r0. lra. }
    assert (sfs : seen fs = fs) by (apply seen_positive; lra).
    assert (EN : Rd (fs - B) = N) by (unfold N; now rewrite sfs). assert (ED : Rd (fs - FE) = Dn) by (unfold Dn;
      now rewrite sfs).
    rewrite sfs in A0, g.
    assert (HN : N <= (1 + e1) * (fs - B)).
    { destruct (difference_error f ok env fs B rs rB) as [[E _]|E]; rewrite EN in E; [lra|].
      rewrite (Rabs_pos_eq (fs - B)) in E by lra.
      apply Rabs_le_inv in E. lra. }
    assert (HD : (1 - e1) * (fs - FE) <= Dn).
    { destruct (difference_error f ok env fs FE rs (representable_seen f env fe re)) as [[E _]|E]; rewrite ED in E;
      [lra|].
      rewrite (Rabs_pos_eq (fs - FE)) in E by lra. apply Rabs_le_inv in E. lra. }
    assert (zN : z = N / Dn) by (unfold z; now rewrite (seen_positive f env N sN)).
    assert (zD : z * Dn = N) by (rewrite zN; field; lra).
    pose proof (error f ok env z) as ez. rewrite (Rabs_pos_eq z) in ez by lra. apply Rabs_le_inv in ez.
    assert (far : omega f < Rd z -> forall t, t <= 1 -> (t - 3 * l) * (fs - FE) <= fs - B).
    { intros over t t1. assert (e1 * z <= / 8388608 * z) by (apply Rmult_le_compat_r; lra).
      assert (1000 * Dn <= z * Dn) by (apply Rmult_le_compat_r; lra).
      assert (e1 * (fs - B) <= / 8388608 * (fs - B)) by (apply Rmult_le_compat_r; lra).
      assert (e1 * (fs - FE) <= / 8388608 * (fs - FE)) by (apply Rmult_le_compat_r; lra).
      assert ((t - 3 * l) * (fs - FE) <= 1 * (fs - FE)) by (apply Rmult_le_compat_r; lra). lra. }
    split; [exact sfs|].
    destruct hq as [[fits hq]|[[over _]|[under _]]].
    + rewrite hq in hp. cbn in hp. pose proof (seen_smaller f env (Rd z)) as sz.
      pose proof (rounded_positive f env z ltac:(lra)) as rz.
      rewrite (Rabs_pos_eq (Rd z)) in sz by lra. pose proof (Rle_abs (seen (Rd z))).
      assert (s0 : 0 <= seen (Rd z)). { pose proof (seen_monotone f env 0 (Rd z) rz) as h. now rewrite seen_0 in h. }
      assert (p0 : 0 <= seen (Rd z) * c) by (apply Rmult_le_pos; lra).
      pose proof (error f ok env (seen (Rd z) * c)) as ep. rewrite (Rabs_pos_eq _ p0) in ep. apply Rabs_le_inv in ep.
      assert (fits' : Rd (seen (Rd z) * c) <= omega f).
      { assert (seen (Rd z) * c <= omega f * (1 - 14 * e1)) by (rewrite Rabs_pos_eq in fits by lra;
        apply Rmult_le_compat; lra).
        assert (e1 * (seen (Rd z) * c) <= e1 * (omega f * (1 - 14 * e1))) by (apply Rmult_le_compat_l; lra).
        assert (e1 * 1 <= e1 * omega f) by (apply Rmult_le_compat_l; lra).
        assert (0 <= e1 * (e1 * omega f)) by (repeat apply Rmult_le_pos; lra). lra. }
      pose proof (rounded_positive f env _ p0) as rp0.
      destruct hp as [[_ hp]|[[over _]|[under _]]]; try lra. rewrite hp. split; [|discriminate].
      intros y t E ty _. injection E as <-.
      pose proof (quotient_arithmetic f fine (fs - B) (fs - FE) N Dn z (Rd (seen (Rd z) * c)) (seen (Rd z)) c ltac:(lra)
        ltac:(lra) ltac:(lra) z0 HN HD
        zN ltac:(lra) ltac:(lra) ltac:(lra)) as last.
      assert ((t - 3 * l) * (fs - FE) <= (Rd (seen (Rd z) * c) - 3 * l) * (fs - FE)) by (apply Rmult_le_compat_r; lra).
        lra.
    + split; [intros y t _ _ t1|intros _ t t1]; now apply far.
    + pose proof (rounded_positive f env z ltac:(lra)). lra.
Qed.

(* One corner of a pair along a direction that is held: from the moment up to the time that the code returns, all exact
   products exceed r. *)
Lemma seen_value_of_number v x : v = Number x -> seen_value f env v = Number (seen x).
Proof. intros ->. reflexivity. Qed.
Theorem held_corner k b n pair r before u_ : In pair pairs -> is_short k -> 0 <= T n <= 1 -> is_bar k b r ->
  says f env value_of (is_ahead k b n pair) -> says f env value_of (Either (stays k b pair) (falls k b pair)) ->
  value_of before = Number u_ -> 0 < u_ -> seen u_ = u_ ->
  exists u', value_of (until_of k b pair before) = Number u' /\ 0 < u' <= u_ /\ seen u' = u' /\
    forall t, T n <= t <= 1 -> t <= u' -> r < exact_product k pair t.
Proof.
  intros inside short time is_b ahead stays_or_falls Eu u0 su.
  pose proof (ahead_at k b n pair r inside short time is_b ahead) as now_.
  destruct is_b as (B & EB & rB & [big small_B] & r0). apply bar_weaker in big; [|exact r0].
    destruct (bar_normal k B r short big r0) as [lB sB].
  pose proof (size_bounds k short) as (S & V & er). pose proof (l_pos f). pose proof (l_small f ok).
    pose proof (G_4 f fine).
  assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct (end_holds k pair Expressions.Start inside short) as (fs & Es & rs & ns).
    destruct (end_holds k pair Expressions.End inside short) as (fe & Ee & re & ne).
  fold (at_start pair) in Es. fold (at_end pair) in Ee.
  assert (size : forall x X, near f x X (sizes k) 4 (4.2 * lengths k + 9.2) -> Rabs x <= 2 * (G * G)).
  { intros x X N. pose proof (near_size f _ _ _ _ _ N). pose proof (q_error 4 ltac:(lia)) as q4.
    replace (INR 4) with 4 in q4 by (simpl; ring).
    pose proof (e_small f ok). pose proof (e_pos f). assert (q 4 * sizes k <= 1.001 * sizes k) by (apply
      Rmult_le_compat_r; lra).
    assert (l * (4.2 * lengths k + 9.2) <= / 1000 * (4.2 * lengths k + 9.2)) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (run (until_of k b pair before)) as h. cbn [until_of] in h. unfold until_of in h.
    cbn -[dot_ at_start at_end stays quotient_of] in h.
  change (says f env value_of (stays k b pair) \/ says f env value_of (falls k b pair)) in stays_or_falls.
  assert (either : says f env value_of (stays k b pair) \/ ~ says f env value_of (stays k b pair)).
  { unfold stays. cbn -[dot_ at_end]. rewrite Ee, EB. cbn. destruct (Rlt_dec (seen B) (seen fe)); tauto. }
  destruct either as [stays_|falls_].
  - destruct h as [[_ h]|[no _]]; [|tauto]. exists u_. split; [exact (eq_trans h Eu)|]. split; [lra|].
    split; [exact su|].
    intros t between _. unfold stays in stays_. cbn -[dot_ at_end] in stays_. rewrite EB in stays_.
    destruct (greater_holds _ _ _ _ _ _ (end_holds k pair Expressions.End inside short) lB stays_) as (x & _ & _ &
      beyond & _ & near_).
    assert (near7 := near_weaker f _ _ _ _ _ (sizes k) 7%nat (4.2 * lengths k + 9.2) near_ (Rle_refl _) ltac:(lia)
      (Rle_refl _)).
    pose proof (err_covers k _ _ _ short near7 ltac:(lra)) as off. apply Rabs_le_inv in off.
    apply (linear_between k pair (T n) 1 t r); [exact between|exact now_|lra].
  - destruct h as [[yes _]|[_ h]]; [tauto|]. destruct stays_or_falls as [yes|falls__]; [tauto|].
    assert (not_stays : seen fe <= B).
    { apply Rnot_lt_le. intro h'. apply falls_. unfold stays. cbn -[dot_ at_end]. rewrite Ee, EB. cbn. now rewrite sB. }
    assert (positive := proj2 falls__). apply positive_value in positive.
    pose proof (run (Smaller (quotient_of k b pair) before)) as hs. cbn -[quotient_of] in hs. rewrite Eu in hs.
    destruct (smaller_value _ u_ _ positive u0 su hs) as (u' & E' & u'0 & su' & least).
    destruct (quotient_value k b pair fs fe B Es Ee EB rs re rB ltac:(lra) sB (size _ _ ns) (size _ _ ne) small_B
      not_stays falls__) as (sfs & number_ & infinite_).
    exists u'. split; [exact (eq_trans h E')|]. split; [exact u'0|]. split; [exact su'|]. intros t between tu.
    apply (line_is_near k pair fs (seen fe) B r inside short ns (near_seen f env _ _ _ _ _ ne) big t ltac:(lra)).
    destruct positive as [inf|(y & Ey & _)]; [apply (infinite_ inf); lra|]. apply (number_ y t Ey); [|lra].
      pose proof (least y Ey). lra.
Qed.

(* All corners. *)
Definition held_mask k b n := fold_left (fun m pair => Both (Both m (is_ahead k b n pair)) (Either (stays k b pair)
  (falls k b pair))).
Definition held_until k b := fold_left (fun t pair => until_of k b pair t).
Lemma fold_of_masks (g : (nat * nat) -> mask -> mask) (A : (nat * nat) -> Prop) :
  (forall pair m, says f env value_of (g pair m) -> says f env value_of m /\ A pair) ->
  forall some m, says f env value_of (fold_left (fun m pair => g pair m) some m) -> says f env value_of m /\
    forall pair, In pair some -> A pair.
Proof.
  intros step some. induction some as [|pair some IH]; intros m h; [split; [exact h|intros pair []]|].
  destruct (IH _ h) as [h' all]. destruct (step _ _ h') as [hm here]. split; [exact hm|]. intros p [<-|inside]; auto.
Qed.
Theorem held_corners k b n r mask_ before u_ : is_short k -> 0 <= T n <= 1 -> is_bar k b r ->
  says f env value_of (held_mask k b n pairs mask_) -> value_of before = Number u_ -> 0 < u_ -> seen u_ = u_ ->
  exists u', value_of (held_until k b pairs before) = Number u' /\ 0 < u' <= u_ /\ seen u' = u' /\
    forall pair t, In pair pairs -> T n <= t <= 1 -> t <= u' -> r < exact_product k pair t.
Proof.
  intros short time is_b masks Eu u0 su.
  destruct (fold_of_masks (fun pair m => Both (Both m (is_ahead k b n pair)) (Either (stays k b pair) (falls k b pair)))
    (fun pair => says f env value_of (is_ahead k b n pair) /\ says f env value_of (Either (stays k b pair) (falls k b
      pair)))
    ltac:(cbn -[is_ahead stays falls]; tauto) pairs mask_ masks) as [_ all]. clear masks.
  assert (inside : forall pair, In pair pairs -> In pair pairs) by auto. revert all inside. revert before u_ Eu u0 su.
    unfold held_until.
  generalize pairs at 1 2 4 5. intro some. induction some as [|pair some IH]; intros before u_ Eu u0 su all inside.
  - exists u_. split; [exact Eu|]. split; [lra|]. split; [exact su|]. intros pair t [].
  - destruct (all pair (or_introl eq_refl)) as [ahead either].
    destruct (held_corner k b n pair r before u_ (inside pair (or_introl eq_refl)) short time is_b ahead either Eu u0
      su) as (u1 & E1 & u10 & s1 & here).
    destruct (IH (until_of k b pair before) u1 E1 ltac:(lra) s1 ltac:(intros; apply all; now right) ltac:(intros;
      apply inside; now right)) as (u2 & E2 & u20 & s2 & rest).
    exists u2. split; [exact E2|]. split; [lra|]. split; [exact s2|]. intros p t [<-|there] between tu; [apply here;
      lra|now apply rest].
Qed.

(* A direction that turns, or moves on a curve: the coefficients in the middle are sums of two products. *)
Definition middle k n' k' n pair := Sum (dot_ (direction k) (corner_at n' pair)) (dot_ (direction k') (corner_at n
  pair)).
Theorem middle_coefficient k b r n' k' b' r' n pair : In pair pairs -> is_short k -> is_short k' -> 0 <= T n <= 1 -> 0
  <= T n' <= 1 ->
  is_bar k b r -> is_bar k' b' r' -> greater f env (value_of (middle k n' k' n pair)) (value_of (Sum b b')) ->
  r + r' < exact_product k pair (T n') + exact_product k' pair (T n).
Proof.
  intros inside short short' time time' (B & EB & rB & [big small] & r0) (B' & EB' & rB' & [big' small'] & r0') g.
  pose proof (size_bounds k short) as (S & V & er). pose proof (size_bounds k' short') as (S' & V' & er').
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
    pose proof (G_2 f fine). pose proof (G_4 f fine).
  assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra). assert (0 <= e1 * r) by (apply Rmult_le_pos; lra).
    assert (0 <= e1 * r') by (apply Rmult_le_pos; lra).
  pose proof (run (Sum b b')) as hb. cbn in hb. rewrite EB, EB' in hb. cbn in hb.
  rewrite (seen_of_normal f env B), (seen_of_normal f env B') in hb by (rewrite Rabs_pos_eq; lra).
  apply (result_number f ok env) in hb; [|rewrite Rabs_pos_eq; lra].
  pose proof (error f ok env (B + B')) as e. rewrite (Rabs_pos_eq (B + B')) in e by lra. apply Rabs_le_inv in e.
  assert (eB : e1 * (B + B') <= / 8388608 * (B + B')) by (apply Rmult_le_compat_r; lra).
  assert (low : err k + err k' + r + r' < Rd (B + B')).
  { assert ((1 - e1) * ((1.1 * err k + 100 * l + (1 + 2 * e1) * r) + (1.1 * err k' + 100 * l + (1 + 2 * e1) * r')) <= (1
    - e1) * (B + B')) by (apply Rmult_le_compat_l; lra).
    assert (e1 * (1.1 * err k + 100 * l + (1.1 * err k' + 100 * l)) <= / 8388608 * (1.1 * err k + 100 * l + (1.1 * err
      k' + 100 * l))) by (apply Rmult_le_compat_r; lra).
    assert (e1 * (e1 * (r + r')) <= / 8388608 * (e1 * (r + r'))) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (run (middle k n' k' n pair)) as hm. unfold middle in hm. cbn -[dot_ corner_at] in hm.
    fold (middle k n' k' n pair) in hm.
  pose proof (holds_sum f ok env Rplus _ _ _ _ _ _ _ _ _ _ _ 7 ltac:(auto) hm (seen_operand f env _ _ _ _ _
    (moment_holds k pair n' inside short time'))
    (seen_operand f env _ _ _ _ _ (moment_holds k' pair n inside short' time)) ltac:(lia) ltac:(lia) ltac:(lia)
      ltac:(lra) ltac:(lra)) as (x & Ex & _ & d & _ & _).
  rewrite hb, Ex in g. unfold greater, seen_value in g. rewrite (seen_of_normal f env (Rd (B + B'))) in g by (rewrite
    Rabs_pos_eq; lra).
  rewrite (seen_positive f env x) in g by lra.
  pose proof (q_error 8 ltac:(lia)) as q8. replace (INR 8) with 8 in q8 by (simpl; ring).
  assert ((q 8 - 1) * (sizes k + sizes k') <= 8.008 * e1 * (sizes k + sizes k')) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * (sizes k + sizes k')) by (apply Rmult_le_pos; lra).
  set (a := 1.01 * (2.19 * sizes k + 11.5 * lengths k + 9.2 + 1 + (2.19 * sizes k' + 11.5 * lengths k' + 9.2 + 1)) + 1)
    in *.
  assert (l * a <= l * ((2.3 * sizes k + 12 * lengths k + 11) + (2.3 * sizes k' + 12 * lengths k' + 11))) by (apply
    Rmult_le_compat_l; unfold a; lra).
  apply Rabs_le_inv in d. unfold Directions.err in low. lra.
Qed.
End Held.
