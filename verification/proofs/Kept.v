(* The certificates of separation, the filter and the time of impact with a separation are not empty: Coq runs the
  traced
   code for a pair of each kind, to nearest. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Arithmetic Machine.
From Selvedge Require Expressions Nearest Nearness Corners Errors Witnesses Advance Chains Gap Gaps Beyond Separated
  Advancing AdvancingBeyond.
Open Scope R_scope.

(* An execution of a pair in range with a separation of one half, with short directions, from moment 0 to moment 1, the ends
   of the step. *)
Definition computes code (f : constants) env place given value_of :=
  AdvancingBeyond.computed f env place (1 / 2) given value_of code /\
  (forall k, Advancing.is_direction f given k) /\ (forall n, Advancing.is_moment given n) /\
  given (Moment 0) = 0 /\ given (Moment 1) = 1.
(* All proofs of a round hold for a pair in one execution, each until the end of the step. *)
Definition every_proof_holds code (f : constants) := exists env place given value_of,
  computes code f env place given value_of /\
  says f env value_of (Greater (Input (Moment 1)) (Input (Moment 0))) /\
  says f env value_of (AdvancingBeyond.by_held code) /\
  (exists u, value_of (AdvancingBeyond.until_held code) = Number u /\ 1 < u) /\
  says f env value_of (AdvancingBeyond.by_turning code) /\ says f env value_of (AdvancingBeyond.by_curving code) /\
  says f env value_of (AdvancingBeyond.by_volume_throughout code) /\
  says f env value_of (AdvancingBeyond.by_volume_to_the_end code).
(* Clipping gives a later time. *)
Definition clipping_advances code (f : constants) := exists env place given value_of,
  computes code f env place given value_of /\
  exists u, value_of (AdvancingBeyond.until_volume code) = Number u /\ 0 < u.
(* From such a pair a chain reaches the end of the step. *)
Theorem a_chain_exists code f : Corners.reasonable_constants f -> every_proof_holds code f ->
  exists place, AdvancingBeyond.reaches code place (1 / 2) 0 1.
Proof.
  intros fine (env_ & place & given & value_of & (computed_ & short & moments & m0 & m1) & later & held & (u & Eu & u1)
    & _).
  exists place. apply AdvancingBeyond.RoundedDown with u; [|lra]. apply AdvancingBeyond.First with f env_; [exact fine|].
  rewrite <- m0. apply (AdvancingBeyond.HeldBeyond code place _ f env_ given value_of u); auto.
Qed.

Section OfAPair.
Load "Format.section".
Hypothesis fine : Corners.reasonable_constants f.
Notation facts := (Nearest.facts prec emax pe underflow_ largest_ (Corners.reasonable_base f fine)).
Hypothesis roomy : (2 <= largest_)%Z.
Variable place_ : nat -> Expressions.time -> Expressions.axis -> Z.
Hypothesis small : Chains.is_small place_.
Hypothesis near_zero : forall n t a, (Z.abs (place_ n t a) <= 8)%Z.
Notation whole := (Chains.whole prec emax p0 pe).

Hypothesis wide : (102 <= emax)%Z.
Variable gap_ : binary_float prec emax.
Notation power_of_two := (Nearest.power_of_two prec emax p0 pe).

(* σ, coordinates of at most 4, a separation of one half, a stored gap and the limits of such. *)
Definition slack := binary_normalize prec emax _ _ mode_NE 1048577 (-20) false.
Definition input_ i := match i with
  | Length Slack => slack | Length LargestCoordinate => whole 8 (-1) | Length Separation => whole 1 (-1)
  | Length StoredGap => gap_ | Length LeastGap => power_of_two (-100) | Length LargestGap => power_of_two 100
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
  intro h. destruct (in_format Chains.whole_is p0 pe fine n (-1))
    as [E fin]; [exact
    h|lia|]. split; [|exact fin]. rewrite E. unfold F2R; cbn [Fnum Fexp bpow radix_val radix2]. cbn. lra.
Qed.
Lemma limit_is e : (-100 <= e <= 100)%Z -> B2R (power_of_two e) = power e /\ is_finite (power_of_two e) = true.
Proof.
  intro h. pose proof facts.
  apply (in_format Chains.exact_power p0 pe fine). lia.
Qed.
Definition computed m := match in_format Chains.holds p0 pe input_
  m with
  | Some b => b | None => false end.
Notation given := (fun i => B2R (input_ i)).
Notation env_ := (in_format Chains.env fine).
Notation nearest_ := (in_format Chains.nearest fine given).
Notation place := (fun c => given (Place c)).
Lemma truth m : computed m = true -> says f env_ nearest_ m.
Proof.
  intro h. apply (in_format Chains.what_holds_is_said p0 pe
    fine given input_ (fun i => eq_refl)). unfold computed in h. destruct (Chains.holds _ _ _ _ _ _ _ _ _) as
      [[|]|]; congruence.
Qed.
Lemma an_execution : execution f env_ nearest_ given. Proof. apply Chains.an_execution_exists; assumption. Qed.
Lemma one_half : given (Length Separation) = 1 / 2. Proof. apply (whole_is 1); reflexivity. Qed.
Lemma limit : 4 <= power (largest_edge f).
Proof.
  change (power (largest_edge f)) with (power largest_). change 4 with (bpow radix2 2). apply bpow_le. exact roomy.
Qed.
Lemma asked : Gaps.asks f env_ given nearest_ place.
Proof.
  assert (four : given (Length LargestCoordinate) = 4). { cbn [input_]. destruct (whole_is 8) as [-> _]; [reflexivity|lra]. }
  split; [reflexivity|]. split; [exact an_execution|]. split; [apply slack_is|]. rewrite four.
  split; [|exact limit]. intros [n t a]. cbn [input_ Chains.halves]. destruct (whole_is (place_ n t a)) as [-> _].
  - pose proof (near_zero n t a). lia.
  - pose proof (near_zero n t a) as h. apply IZR_le in h. rewrite abs_IZR in h. unfold Rdiv. rewrite Rabs_mult.
    rewrite (Rabs_pos_eq (/ 2)) by lra. lra.
Qed.
Lemma tested : computed Gap.a_vertex_and_a_face.short = true -> Gaps.is_tested given.
Proof.
  intro short_. exists f, env_, given, nearest_. split; [exact fine|]. split; [exact an_execution|]. split; [apply
    slack_is|]. split; [reflexivity|]. split; [|apply truth; exact short_]. intro a. pose proof (Corners.G_4 f fine).
  destruct a; cbn [input_ Chains.halves]; match goal with |- context [whole ?n (-1)] => destruct (whole_is n) as [->
    _]; [reflexivity|] end; rewrite Rabs_pos_eq; lra.
Qed.
Theorem kept_if_computed code : computed code = true -> computed Gap.a_vertex_and_a_face.short = true ->
  Gaps.is_kept f code place (1 / 2).
Proof.
  intros kept short_. exists env_, given, nearest_. split; [exact asked|]. split; [exact one_half|].
  split; [pose proof limit; lra|]. split; [now apply tested|now apply truth].
Qed.
(* The gap that is stored of this pair, computed; and a pair that lasts since that. *)
Notation running := (in_format Chains.run p0 pe input_).
Theorem stored_if_computed code x : running code = Some x -> computed Gap.a_vertex_and_a_face.short = true ->
  (extent_ <= -100)%Z -> Gaps.is_stored f code place (fun a => given (Along 0 a)) (B2R x).
Proof.
  intros stored short_ deep. exists env_, given, nearest_, f, env_, (B2R x).
  destruct (limit_is (-100)) as [E _]; [lia|].
  assert (least : power (extent_underflow f) <= given (Length LeastGap) <= 1).
  { cbn [input_]. rewrite E. split; [apply bpow_le; exact deep|]. change 1 with (bpow radix2 0). apply bpow_le. lia. }
  split; [exact asked|]. split; [now apply tested|]. split; [reflexivity|]. split; [exact fine|]. split; [exact least|].
  split; [apply least|].
  destruct (in_format Chains.run_is_nearest p0 pe fine given input_
    (fun i => eq_refl)) as [numbers _]. destruct (numbers code x stored) as [Vx _].
  split; [exact Vx|]. symmetry. change (Machine.seen f env_ (B2R x)) with (B2R x).
  apply round_generic; [apply valid_rnd_N|]. exact (generic_format_B2R prec emax x).
Qed.
Theorem culled_if_computed code : computed code = true -> exists place, Separated.is_culled f code place (1 / 2).
Proof.
  intro culled. exists place, env_, given, nearest_. split; [reflexivity|]. split; [exact an_execution|].
  split; [exact one_half|now apply truth].
Qed.
Definition is_beyond n e := computed (Greater e (Constant (Small n))) &&
  match running e with Some _ => true | None => false end.
Lemma what_is_computed code : computed (AdvancingBeyond.is_in_range code) = true ->
  computes code f env_ place given nearest_ /\ (forall m, computed m = true -> says f env_ nearest_ m) /\
  (forall n e, is_beyond n e = true -> exists u, nearest_ e = Number u /\ IZR n < u).
Proof.
  intro range. pose proof (in_format Chains.run_is_nearest p0 pe fine
    given input_ (fun i => eq_refl)) as [numbers _].
  assert (halves_ : forall i, (forall l, i <> Length l) -> given i = IZR (Chains.halves place_ i) / 2).
  { intros i no. destruct i as [l| | | |]; try (now destruct (no _ eq_refl)); apply whole_is; apply small. }
  pose proof (Corners.G_4 f fine) as G4. pose proof (Nearness.l_small f (Corners.reasonable_base f fine)).
  pose proof (Corners.L_1 f fine).
  split; [|split; [exact truth|]].
  - split; [split; [intro; reflexivity|]; split; [exact an_execution|]; split; [exact one_half|]; split; [|now apply
      truth]; unfold Arithmetic.lam in *; lra|].
    split; [intros k a; rewrite halves_ by discriminate; apply Rle_trans with 4; [destruct a; cbn; unfold Rabs; destruct
      (Rcase_abs _); lra|exact G4]|].
    split; [intros [|[|n]]; unfold Advancing.is_moment; rewrite halves_ by discriminate; cbn; lra|].
    split; rewrite halves_ by discriminate; cbn; lra.
  - intros n e h. apply andb_prop in h as [h number_]. apply truth in h.
    destruct (running e) as [u|] eqn:Eu; [|discriminate]. destruct (numbers _ u Eu) as [Vu _].
    exists (B2R u). split; [exact Vu|]. cbn [says] in h. rewrite Vu in h. exact h.
Qed.
Definition every_proof code := computed (AdvancingBeyond.is_in_range code) &&
  computed (Greater (Input (Moment 1)) (Input (Moment 0))) && computed (AdvancingBeyond.by_held code) &&
  is_beyond 1 (AdvancingBeyond.until_held code) && computed (AdvancingBeyond.by_turning code) &&
  computed (AdvancingBeyond.by_curving code) && computed (AdvancingBeyond.by_volume_throughout code) &&
  computed (AdvancingBeyond.by_volume_to_the_end code).
Theorem every_proof_holds_if_computed code : every_proof code = true -> every_proof_holds code f.
Proof.
  unfold every_proof. intro all. repeat (apply andb_prop in all as [all ?]).
  destruct (what_is_computed code all) as (c & truth & numbers). exists env_, place, given, nearest_. auto 12.
Qed.
End OfAPair.
Lemma near_vertex_and_face n t a : (Z.abs (Chains.place_of_a_vertex_and_a_face 2 n t a) <= 8)%Z.
Proof. destruct n as [|[|[|[|n]]]], t, a; cbn; lia. Qed.
Lemma near_edges n t a : (Z.abs (Chains.place_of_two_edges 2 n t a) <= 8)%Z.
Proof. destruct n as [|[|[|[|n]]]], t, a; cbn; lia. Qed.
Notation no_gap := (B754_zero false).
Theorem some_are_kept f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Gaps.is_kept f Gap.a_vertex_and_a_face.keeps place (1 / 2)) /\
  (exists place, Gaps.is_kept f Gap.two_edges.keeps place (1 / 2)).
Proof.
  intros [-> | ->]; split; eexists.
  - apply (kept_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine ltac:(lia) _
      near_vertex_and_face ltac:(lia) no_gap); vm_compute; reflexivity.
  - apply (kept_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine ltac:(lia) _
      near_edges ltac:(lia) no_gap); vm_compute; reflexivity.
  - apply (kept_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine ltac:(lia) _
      near_vertex_and_face ltac:(lia) no_gap); vm_compute; reflexivity.
  - apply (kept_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine ltac:(lia) _
      near_edges ltac:(lia) no_gap); vm_compute; reflexivity.
Qed.
(* A pair at rest lasts since the gap that was stored of it: in single precision, where its conversion changes nothing. *)
Notation in_single theorem := (theorem 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _)%Z.
Definition lasts_when_computed place_ lasts stored := match in_single Chains.run (input_ 24 128 _ _ place_ no_gap) stored with
  | Some x => is_finite x && in_single computed place_ no_gap Gap.a_vertex_and_a_face.short && in_single computed place_ x
      Gap.a_vertex_and_a_face.short && in_single computed place_ x lasts
  | None => false end.
Theorem lasts_if_computed place_ lasts stored : Chains.is_small place_ -> (forall n t a, (Z.abs (place_ n t a) <= 8)%Z) ->
  (forall n a, place_ n Expressions.End a = place_ n Expressions.Start a) -> lasts_when_computed place_ lasts stored = true ->
  exists place, Gaps.lasts_since Advance.binary32 lasts stored place (1 / 2).
Proof.
  intros small near_ rests all. unfold lasts_when_computed in all.
  destruct (in_single Chains.run _ stored) as [x|] eqn:Ex; [|discriminate].
  apply andb_prop in all as [all now_]. apply andb_prop in all as [all short_]. apply andb_prop in all as [fin short'].
  pose proof (in_single stored_if_computed Chains.single_is_fine ltac:(lia) place_ near_ ltac:(lia) no_gap
    stored x Ex short' ltac:(lia)) as was.
  eexists. eexists. eexists. eexists. exists Advance.binary32, (fun c => B2R (input_ 24 128 _ _ place_ no_gap (Place c))),
    (B2R x).
  split; [exact (in_single asked Chains.single_is_fine ltac:(lia) place_ near_ ltac:(lia) x)|].
  split; [exact (in_single one_half Chains.single_is_fine place_ x)|].
  split; [pose proof (limit 24 128 (-117) 30 (-100) 29 (-100) (-62) ltac:(lia))%Z as h; change (4 <= power
    (largest_edge Advance.binary32)) in h; lra|].
  split; [exact (in_single tested Chains.single_is_fine place_ ltac:(lia) x short_)|].
  split; [exact Chains.single_is_fine|]. split; [exact was|]. split; [|split; [reflexivity|]].
  - intros n a. cbn [input_ Chains.halves]. now rewrite rests.
  - exact (in_single truth Chains.single_is_fine place_ x lasts now_).
Qed.
Lemma rests_vertex_and_face n a : Chains.place_of_a_vertex_and_a_face 4 n Expressions.End a =
  Chains.place_of_a_vertex_and_a_face 4 n Expressions.Start a.
Proof. destruct n as [|[|[|[|n]]]], a; reflexivity. Qed.
Lemma rests_edges n a : Chains.place_of_two_edges 4 n Expressions.End a = Chains.place_of_two_edges 4 n Expressions.Start a.
Proof. destruct n as [|[|[|[|n]]]], a; reflexivity. Qed.
Theorem some_last : (exists place, Gaps.lasts_since Advance.binary32 Gap.a_vertex_and_a_face.lasts
    Gap.a_vertex_and_a_face.stored_by_keeps place (1 / 2)) /\
  (exists place, Gaps.lasts_since Advance.binary32 Gap.two_edges.lasts Gap.two_edges.stored_by_keeps place (1 / 2)).
Proof.
  split.
  - apply (lasts_if_computed (Chains.place_of_a_vertex_and_a_face 4) _ _ (Chains.small_vertex_and_face 4 eq_refl)).
    + intros [|[|[|[|n]]]] [|] [| |]; cbn; lia.
    + exact rests_vertex_and_face.
    + vm_compute. reflexivity.
  - apply (lasts_if_computed (Chains.place_of_two_edges 4) _ _ (Chains.small_edges 4 eq_refl)).
    + intros [|[|[|[|n]]]] [|] [| |]; cbn; lia.
    + exact rests_edges.
    + vm_compute. reflexivity.
Qed.
Theorem some_are_culled f alone : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, Separated.is_culled f (if alone : bool then Beyond.a_vertex_and_a_face.culled_by_permanent_alone else
    Beyond.a_vertex_and_a_face.culled_by_permanent) place (1 / 2)) /\
  (exists place, Separated.is_culled f (if alone then Beyond.two_edges.culled_by_permanent_alone else
    Beyond.two_edges.culled_by_permanent) place (1 / 2)).
Proof.
  intros [-> | ->]; split.
  - apply (culled_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine
      (Chains.place_of_a_vertex_and_a_face (if alone then 4 else 2)) no_gap);
        destruct alone; vm_compute;
      reflexivity.
  - apply (culled_if_computed 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine
      (Chains.place_of_two_edges (if alone then 4 else 2)) no_gap); destruct
        alone; vm_compute; reflexivity.
  - apply (culled_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine
      (Chains.place_of_a_vertex_and_a_face (if alone then 4 else 2)) no_gap);
        destruct alone; vm_compute;
      reflexivity.
  - apply (culled_if_computed 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine
      (Chains.place_of_two_edges (if alone then 4 else 2)) no_gap); destruct
        alone; vm_compute; reflexivity.
Qed.
Notation of_single theorem := (theorem 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ Chains.single_is_fine _)%Z.
Notation of_double theorem := (theorem 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ Chains.double_is_fine _)%Z.
Theorem every_proof_with_a_separation_holds_for_some f : f = Advance.binary32 \/ f = Advance.binary64 ->
  every_proof_holds AdvancingBeyond.of_a_vertex_and_a_face f /\ every_proof_holds AdvancingBeyond.of_two_edges f.
Proof.
  intros [-> | ->]; split.
  - apply (of_single every_proof_holds_if_computed (Chains.small_vertex_and_face 2 eq_refl) no_gap); vm_cast_no_check (eq_refl
      true).
  - apply (of_single every_proof_holds_if_computed (Chains.small_edges 2 eq_refl) no_gap);
    vm_cast_no_check (eq_refl true).
  - apply (of_double every_proof_holds_if_computed (Chains.small_vertex_and_face 2 eq_refl) no_gap); vm_cast_no_check (eq_refl
      true).
  - apply (of_double every_proof_holds_if_computed (Chains.small_edges 2 eq_refl) no_gap);
    vm_cast_no_check (eq_refl true).
Qed.
Theorem chains_with_a_separation_reach_the_end f : f = Advance.binary32 \/ f = Advance.binary64 ->
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_a_vertex_and_a_face place (1 / 2) 0 1) /\
  (exists place, AdvancingBeyond.reaches AdvancingBeyond.of_two_edges place (1 / 2) 0 1).
Proof.
  intro which. assert (fine : Corners.reasonable_constants f) by (destruct which as [-> | ->]; [exact Chains.single_is_fine|
    exact Chains.double_is_fine]).
  destruct (every_proof_with_a_separation_holds_for_some f which). split; now apply (a_chain_exists _ f fine).
Qed.
