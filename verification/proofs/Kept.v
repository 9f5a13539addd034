(* The certificates of separation, the filter and the time of impact with a separation are not empty: Coq runs the
  traced
   code for a pair of each kind, to nearest. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Arithmetic Machine.
From Selvedge Require Expressions Nearest Nearness Corners Errors Witnesses Advance Chains Gap Gaps Beyond Separated
  Advancing AdvancingBeyond.
Open Scope R_scope.

Section OfAPair.
Variables prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ : Z.
Context (p0 : Prec_gt_0 prec) (pe : Prec_lt_emax prec emax).
Notation f := (Chains.constants_of prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_).
Hypothesis fine : Corners.reasonable_constants f.
Notation facts := (Nearest.facts prec emax pe underflow_ largest_ (Corners.reasonable_base f fine)).
Hypothesis roomy : (2 <= largest_)%Z.
Variable place_ : nat -> Expressions.time -> Expressions.axis -> Z.
Hypothesis small : Chains.is_small place_.
Hypothesis near_zero : forall n t a, (Z.abs (place_ n t a) <= 8)%Z.
Notation whole := (Chains.whole prec emax p0 pe).

(* σ, coordinates of at most 4, a separation of one half. *)
Definition slack := binary_normalize prec emax _ _ mode_NE 1048577 (-20) false.
Definition input_ i := match i with
  | Length Slack => slack | Length LargestCoordinate => whole 8 (-1) | Length Separation => whole 1 (-1)
  | _ => whole (Chains.halves place_ i) (-1) end.
Lemma slack_is : B2R slack = Gaps.sigma /\ is_finite slack = true.
Proof.
  pose proof facts. destruct (Nearest.exact_constant prec emax p0 pe underflow_ largest_ 1048577 (-20)) as [E fin].
  - apply generic_format_FLT. exists (Float radix2 1048577 (-20)); [reflexivity| |].
    + unfold Nearest.format_of; cbn [precision Fnum]. change (radix_val radix2) with 2%Z.
      assert (2 ^ 24 <= 2 ^ prec)%Z by (apply Z.pow_le_mono_r; lia). lia.
    + change (3 - emax - prec <= -20)%Z. lia.
  - unfold F2R; cbn [Fnum Fexp]. apply Rlt_le_trans with (bpow radix2 1).
    + cbn. rewrite Rabs_pos_eq; lra.
    + apply bpow_le. lia.
  - unfold slack. rewrite E. split; [|exact fin]. unfold F2R, Gaps.sigma; cbn. lra.
Qed.
Lemma whole_is n : (Z.abs n < 256)%Z -> B2R (whole n (-1)) = IZR n / 2 /\ is_finite (whole n (-1)) = true.
Proof.
  intro h. destruct (Chains.whole_is prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe fine n (-1))
    as [E fin]; [exact
    h|lia|]. split; [|exact fin]. rewrite E. unfold F2R; cbn [Fnum Fexp bpow radix_val radix2]. cbn. lra.
Qed.
Lemma all_finite i : is_finite (input_ i) = true.
Proof.
  destruct i as [[| |]| | |]; cbn [input_]; try (apply whole_is; apply small || reflexivity). apply slack_is.
Qed.
Definition computed m := match Chains.holds prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe input_
  m with
  | Some b => b | None => false end.
Theorem kept_if_computed code : computed code = true -> computed Gap.a_vertex_and_a_face.short = true ->
  exists place, Gaps.is_kept f code place (1 / 2).
Proof.
  intros kept short_. set (given i := B2R (input_ i)).
  set (env_ := Chains.env prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine).
  set (nearest_ := Chains.nearest prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine given).
  assert (E : execution f env_ nearest_ given) by (apply Chains.an_execution_exists; assumption).
  assert (truth : forall m, computed m = true -> says f env_ nearest_ m).
  { intros m h. apply (Chains.what_holds_is_said prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe
    fine given input_
      (fun i => eq_refl) all_finite). unfold computed in h. destruct (Chains.holds _ _ _ _ _ _ _ _ _) as [[|]|];
        congruence. }
  assert (limit : 4 <= power (largest_edge f)).
  { change (power (largest_edge f)) with (power largest_). change 4 with (bpow radix2 2). apply bpow_le.
    exact roomy. }
  exists (fun c => given (Place c)), env_, given, nearest_.
  assert (one_half : given (Length Separation) = 1 / 2) by (apply (whole_is 1); reflexivity).
  assert (four : given (Length LargestCoordinate) = 4).
  { unfold given, input_. destruct (whole_is 8) as [-> _]; [reflexivity|lra]. }
  assert (slack_ : given (Length Slack) = Gaps.sigma) by apply slack_is.
  split; [reflexivity|]. split; [exact E|]. split; [exact slack_|]. split; [exact one_half|]. split; [lra|].
  split; [|split; [lra|split; [|apply truth; exact kept]]].
  - intros [n t a]. rewrite four. unfold given. cbn [input_ Chains.halves]. destruct (whole_is (place_ n t a)) as [->
    _].
    + pose proof (near_zero n t a). lia.
    + pose proof (near_zero n t a) as h. apply IZR_le in h. rewrite abs_IZR in h. unfold Rdiv. rewrite Rabs_mult.
      rewrite (Rabs_pos_eq (/ 2)) by lra. lra.
  - exists f, env_, given, nearest_. split; [exact fine|]. split; [exact E|]. split; [exact slack_|]. split;
    [reflexivity|].
    split; [|apply truth; exact short_]. intro a. pose proof (Corners.G_4 f fine). unfold given.
    destruct a; cbn [input_ Chains.halves]; match goal with |- context [whole ?n (-1)] => destruct (whole_is n) as [->
      _];
      [reflexivity|] end; rewrite Rabs_pos_eq; lra.
Qed.
Theorem culled_if_computed code : computed code = true -> exists place, Separated.is_culled f code place (1 / 2).
Proof.
  intro culled. set (given i := B2R (input_ i)).
  set (env_ := Chains.env prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine).
  set (nearest_ := Chains.nearest prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine given).
  exists (fun c => given (Place c)), env_, given, nearest_. split; [reflexivity|].
  split; [apply Chains.an_execution_exists; assumption|]. split; [apply (whole_is 1); reflexivity|].
  apply (Chains.what_holds_is_said prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe fine given input_
    (fun i => eq_refl) all_finite). unfold computed in culled.
  destruct (Chains.holds _ _ _ _ _ _ _ _ _ _ _ _) as [[|]|]; congruence.
Qed.
Notation running := (Chains.run prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe input_).
Definition chain code := computed (AdvancingBeyond.is_in_range code) && computed (AdvancingBeyond.by_held code) &&
  computed (Greater (AdvancingBeyond.until_held code) (Constant (Small 1))) &&
  match running (AdvancingBeyond.until_held code) with Some _ => true | None => false end.
Theorem reaches_if_computed code : chain code = true -> exists place, AdvancingBeyond.reaches code place (1 / 2) 0 1.
Proof.
  unfold chain. intro all. repeat (apply andb_prop in all as [all ?]). set (given i := B2R (input_ i)).
  set (env_ := Chains.env prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine).
  set (nearest_ := Chains.nearest prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ fine given).
  assert (E : execution f env_ nearest_ given) by (apply Chains.an_execution_exists; assumption).
  pose proof (Chains.run_is_nearest prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe fine given
    input_
    (fun i => eq_refl) all_finite) as [numbers _].
  assert (truth : forall m, computed m = true -> says f env_ nearest_ m).
  { intros m h. apply (Chains.what_holds_is_said prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ p0 pe
    fine
      given input_ (fun i => eq_refl) all_finite). unfold computed in h.
    destruct (Chains.holds _ _ _ _ _ _ _ _ _ _ _ _) as [[|]|]; congruence. }
  assert (halves_ : forall i, (forall l, i <> Length l) -> given i = IZR (Chains.halves place_ i) / 2).
  { intros i no. destruct i as [[| |]| | |]; try (now destruct (no _ eq_refl)); apply whole_is; apply small. }
  assert (one_half : given (Length Separation) = 1 / 2) by (apply (whole_is 1); reflexivity).
  destruct (running (AdvancingBeyond.until_held code)) as [u|] eqn:Eu; [|discriminate].
  destruct (numbers _ u Eu) as [Vu _]. change (nearest_ (AdvancingBeyond.until_held code) = Number (B2R u)) in Vu.
  match goal with h : computed (Greater _ _) = true |- _ => apply truth in h; cbn [says] in h; rewrite Vu in h;
    rename h into later end.
  change (1 < B2R u) in later. exists (fun c => given (Place c)). apply AdvancingBeyond.RoundedDown with (B2R u);
    [|lra].
  apply AdvancingBeyond.First with f env_; [exact fine|].
  assert (start_ : given (Moment 0) = 0) by (rewrite halves_ by discriminate; cbn; lra). rewrite <- start_.
  pose proof (Corners.G_4 f fine) as G4. pose proof (Nearness.l_small f (Corners.reasonable_base f fine)).
  pose proof (Corners.L_1 f fine).
  apply (AdvancingBeyond.HeldBeyond code _ _ f env_ given nearest_ (B2R u)); auto.
  - split; [intro; reflexivity|]. split; [exact E|]. split; [exact one_half|]. split; [|now apply truth].
    unfold Arithmetic.lam in *. lra.
  - intro a. rewrite halves_ by discriminate. apply Rle_trans with 4; [|exact G4].
    destruct a; cbn; unfold Rabs; destruct (Rcase_abs _); lra.
  - unfold Advancing.is_moment. rewrite start_. lra.
Qed.
End OfAPair.
Lemma near_vertex_and_face n t a : (Z.abs (Chains.place_of_a_vertex_and_a_face 2 n t a) <= 8)%Z.
Proof. destruct n as [|[|[|[|n]]]], t, a; cbn; lia. Qed.
Lemma near_edges n t a : (Z.abs (Chains.place_of_two_edges 2 n t a) <= 8)%Z.
Proof. destruct n as [|[|[|[|n]]]], t, a; cbn; lia. Qed.
Theorem some_are_kept f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Gaps.is_kept f Gap.a_vertex_and_a_face.keeps place (1 / 2)) /\
  (exists place, Gaps.is_kept f Gap.two_edges.keeps place (1 / 2)).
Proof.
  intros [-> | ->]; split.
  - apply (kept_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine ltac:(lia) _
      (Chains.small_vertex_and_face 2 eq_refl) near_vertex_and_face); vm_compute; reflexivity.
  - apply (kept_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine ltac:(lia) _
      (Chains.small_edges 2 eq_refl) near_edges); vm_compute; reflexivity.
  - apply (kept_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine ltac:(lia) _
      (Chains.small_vertex_and_face 2 eq_refl) near_vertex_and_face); vm_compute; reflexivity.
  - apply (kept_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine ltac:(lia) _
      (Chains.small_edges 2 eq_refl) near_edges); vm_compute; reflexivity.
Qed.
Theorem some_are_culled f alone : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Separated.is_culled f (if alone : bool then Beyond.a_vertex_and_a_face.culled_by_permanent_alone else
    Beyond.a_vertex_and_a_face.culled_by_permanent) place (1 / 2)) /\
  (exists place, Separated.is_culled f (if alone then Beyond.two_edges.culled_by_permanent_alone else
    Beyond.two_edges.culled_by_permanent) place (1 / 2)).
Proof.
  intros [-> | ->]; split.
  - apply (culled_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine _
      (Chains.small_vertex_and_face (if alone then 4 else 2) ltac:(now destruct alone))); destruct alone; vm_compute;
      reflexivity.
  - apply (culled_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine _
      (Chains.small_edges (if alone then 4 else 2) ltac:(now destruct alone))); destruct alone; vm_compute; reflexivity.
  - apply (culled_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine _
      (Chains.small_vertex_and_face (if alone then 4 else 2) ltac:(now destruct alone))); destruct alone; vm_compute;
      reflexivity.
  - apply (culled_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine _
      (Chains.small_edges (if alone then 4 else 2) ltac:(now destruct alone))); destruct alone; vm_compute; reflexivity.
Qed.
Theorem chains_with_a_separation_reach_the_end f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_a_vertex_and_a_face place (1 / 2) 0 1) /\
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_two_edges place (1 / 2) 0 1).
Proof.
  intros [-> | ->]; split.
  - apply (reaches_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine _
      (Chains.small_vertex_and_face 2 eq_refl)); vm_compute; reflexivity.
  - apply (reaches_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine _
      (Chains.small_edges 2 eq_refl)); vm_compute; reflexivity.
  - apply (reaches_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine _
      (Chains.small_vertex_and_face 2 eq_refl)); vm_compute; reflexivity.
  - apply (reaches_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine _
      (Chains.small_edges 2 eq_refl)); vm_compute; reflexivity.
Qed.
