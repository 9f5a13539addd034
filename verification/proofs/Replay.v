(* An interpreter of the record that the time of impact's loop keeps (core/src/elementary/advance/witness.rs). It computes
   each round's proof again, by the traced terms in Flocq's binary numbers, to nearest, and gives the time that the
   record proves, or nothing. Up to a time that it gives the pair is apart. *)
From Coq Require Import Reals ZArith Lra Lia Bool List FMapPositive.
From Flocq Require Import Core BinarySingleNaN Operations.
From Selvedge Require Import Arithmetic Machine.
From Selvedge Require Expressions Nearest Corners Errors Least DirectionsBeyond Advancing AdvancingBeyond Chains.
Import ListNotations.
Open Scope R_scope.

(* A program: a mask and a number, and the numbers before them, each computed once. *)
Record program := Program { steps : list number; accepts : mask; gives : number }.
(* The terms that its places stand for. *)
Fixpoint in_places {A} k (l : list A) (places : PositiveMap.t A) := match l with
  | [] => places
  | x :: rest => in_places (Pos.succ k) rest (PositiveMap.add k x places) end.
Definition at_place (places : PositiveMap.t number) i := match i with
  | Saved k => match PositiveMap.find k places with Some e => e | None => Input i end
  | _ => Input i end.
(* Each step is the term of its place. *)
Fixpoint terms_from places k (l : list number) := match l with
  | [] => []
  | _ :: rest => at_place places (Saved k) :: terms_from places (Pos.succ k) rest end.
Definition is_program places p m e := let at_ := at_place places in
  map (Chains.filled at_) (steps p) = terms_from places 1 (steps p) /\
  Chains.filled_mask at_ (accepts p) = m /\ Chains.filled at_ (gives p) = e.

(* The programs of the proofs of one round. *)
Record programs := Programs { range : mask; held : program; turning : program; curving : program; volume : program }.

(* A part of a record: the time at which it ends, and its proof. Numbers have digits and an exponent. *)
Definition vector := (Z * Z * (Z * Z) * (Z * Z))%type.
Inductive proof := Volume | HeldAlong (w : vector) | TurningTo (v w : vector) | CurvingTo (v m w : vector).
Definition part := (Z * Z * proof)%type.
(* A run: the coordinates of a pair, a separation, or zero, the time that the code answers, and its record. The four points
   come one after the other, each at the start and at the end. *)
Record of_run := Run { coordinates : list (Z * Z); separated_by : Z * Z; answered : Z * Z; recorded : list part }.
Definition coordinate_of run c := let '(Expressions.Coordinate n t a) := c in
  nth (6 * n + match t with Expressions.Start => 0 | Expressions.End => 3 end +
    match a with Expressions.X => 0 | Expressions.Y => 1 | Expressions.Z_ => 2 end) (coordinates run) (0, 0)%Z.

Section Replay.
Load "Format.section".
Notation run := (in_format Chains.run p0 pe).
Notation holds := (in_format Chains.holds p0 pe).
Notation power_of_two := (Nearest.power_of_two prec emax p0 pe).

(* A number of the format, from its digits and its exponent. *)
Definition number_of '(m, e) : binary := binary_normalize prec emax _ _ mode_NE m e false.
Definition zero : binary := B754_zero false.
Definition one := power_of_two 0.

(* A program runs with inputs: it saves what its steps give. *)
Definition with_saved (input_ : input -> binary) (saved : PositiveMap.t binary) i := match i with
  | Saved k => match PositiveMap.find k saved with Some x => x | None => B754_nan end
  | _ => input_ i end.
Fixpoint saved_by input_ k l saved := match l with
  | [] => saved
  | e :: rest => saved_by input_ (Pos.succ k) rest (match run (with_saved input_ saved) e with
      | Some x => PositiveMap.add k x saved
      | None => saved end) end.
Definition result_of p input_ := let all := with_saved input_ (saved_by input_ 1 (steps p) (PositiveMap.empty _)) in
  (holds all (accepts p), run all (gives p)).

Definition component (w : vector) a := let '(x, y, z) := w in number_of (match a with
  | Expressions.X => x | Expressions.Y => y | Expressions.Z_ => z end).
Section OfAPair.
Variable code : programs.
Variable place_ : Expressions.coordinate -> binary.
Variable separation : binary.
Definition inputs directions from until i := match i with
  | Place c => place_ c
  | Along k a => component (nth k directions (0, 0, (0, 0), (0, 0))%Z) a
  | Moment 0 => from
  | Moment _ => until
  | Length _ => separation
  | Saved _ => B754_nan end.

Definition is_at_most (x y : binary) := is_finite x && is_finite y && negb (Bltb y x).
Definition is_moment t := is_at_most zero t && is_at_most t one.
(* No direction is longer than the loop's limit along an axis. *)
Definition is_short w := forallb (fun a => is_at_most (Babs (component w a)) (power_of_two (largest_ + 2)))
  [Expressions.X; Expressions.Y; Expressions.Z_].
(* What a program gives for a pair in range. *)
Definition is_in_range input_ := match holds input_ (range code) with Some b => b | None => false end.
Definition checked p input_ := if is_in_range input_ then result_of p input_ else (None, None).
Definition are_both r := match r with (Some true, Some u) => Some u | _ => @None binary end.
(* The volume's part is clipped several times in a round. *)
Fixpoint clipped n from until := match n with
  | O => None
  | S n => if is_moment from then match checked (volume code) (inputs [] from until) with
    | (Some true, _) => Some one
    | (_, Some u) => if Bltb from u then if Beqb u until then Some u else clipped n u until else None
    | _ => None end else None end.
Definition clips := 8%nat.
(* The time until which a part is proven, from a time until the one that it names. *)
Definition proven from until p := if is_moment from && is_moment until then match p with
  | HeldAlong w => if is_short w then match are_both (checked (held code) (inputs [w] from until)) with
    | Some u => Some (if Bltb one u then one else u)
    | None => None end else None
  | TurningTo v w => if Bltb from until && is_short v && is_short w then
    are_both (checked (turning code) (inputs [v; w] from until)) else None
  | CurvingTo v m w => if Bltb from until && is_short v && is_short m && is_short w then
    are_both (checked (curving code) (inputs [v; m; w] from until)) else None
  | Volume => clipped clips from until end else None.
(* Each part is proven until exactly the time that it names. *)
Fixpoint replayed from (record : list part) := match record with
  | [] => Some from
  | (until, p) :: rest => match proven from (number_of until) p with
    | Some u => if Beqb u (number_of until) then replayed u rest else None
    | None => None end end.

Variable is_fine : Corners.reasonable_constants f.
Notation env_ := (in_format Chains.env is_fine).
Notation given input_ := (fun i : input => B2R (input_ i : binary)).
Notation nearest input_ := (in_format Chains.nearest is_fine
  (given input_)).
Definition is_saved (at_ : input -> number) input_ (saved : PositiveMap.t binary) := forall k x, PositiveMap.find k saved =
  Some x ->
  is_finite x = true -> nearest input_ (at_ (Saved k)) = Number (B2R x).
Lemma with_saved_is_right places input_ saved : is_saved (at_place places) input_ saved ->
  forall i, is_finite (with_saved input_ saved i) = true ->
  nearest input_ (at_place places i) = Number (B2R (with_saved input_ saved i)).
Proof.
  intros right_ i fin. destruct i as [l|c|k a|n|k]; try reflexivity. cbn [with_saved] in fin |- *.
  destruct (PositiveMap.find k saved) as [x|] eqn:E; [now apply right_|discriminate].
Qed.
Lemma saved_by_is_right places input_ l : forall k saved, map (Chains.filled (at_place places)) l = terms_from places k l ->
  is_saved (at_place places) input_ saved -> is_saved (at_place places) input_ (saved_by input_ k l saved).
Proof.
  induction l as [|e rest IH]; intros k saved all right_; [exact right_|]. injection all as here all.
  cbn [saved_by]. apply (IH _ _ all). destruct (run (with_saved input_ saved) e) as [x|] eqn:E; [|exact right_].
  intros k' x' found fin. destruct (Pos.eq_dec k' k) as [->|other].
  - rewrite PositiveMap.gss in found. injection found as <-. cbn [at_place]. rewrite <- here.
    apply (proj1 (in_format Chains.run_is_right p0 pe is_fine
      (given input_) (with_saved input_ saved) (at_place places) (with_saved_is_right places input_ saved right_)) e x E).
  - rewrite PositiveMap.gso in found by exact other. now apply right_.
Qed.
Lemma result_is_right places p m e input_ : is_program places p m e ->
  (fst (result_of p input_) = Some true -> says f env_ (nearest input_) m) /\
  (forall u, snd (result_of p input_) = Some u -> nearest input_ e = Number (B2R u) /\ is_finite u = true).
Proof.
  intros (all & <- & <-). set (saved := saved_by input_ 1 (steps p) (PositiveMap.empty _)).
  assert (right_ : is_saved (at_place places) input_ saved).
  { apply saved_by_is_right; [exact all|]. intros k x found. now rewrite PositiveMap.gempty in found. }
  destruct (in_format Chains.run_is_right p0 pe is_fine
    (given input_) (with_saved input_ saved) (at_place places) (with_saved_is_right places input_ saved right_))
    as [numbers masks].
  split; cbn [fst snd result_of]; fold saved.
  - intro h. apply Chains.said. exact (masks _ _ h).
  - intros u h. exact (numbers _ u h).
Qed.

Notation exact_power := (in_format Chains.exact_power p0 pe is_fine).
Notation facts := (Nearest.facts prec emax pe underflow_ largest_ (Corners.reasonable_base f is_fine)).
Lemma one_is : B2R one = 1 /\ is_finite one = true.
Proof. destruct (exact_power 0) as [E fin]; [pose proof facts; lia|]. split; [exact E|exact fin]. Qed.
Lemma less (x y : binary) : is_finite x = true -> is_finite y = true -> Bltb x y = true -> B2R x < B2R y.
Proof.
  intros fx fy h. rewrite (Chains.less prec emax x y fx fy) in h. destruct (Rlt_dec _ _); [assumption|discriminate].
Qed.
Lemma at_most x y : is_at_most x y = true -> B2R x <= B2R y /\ is_finite x = true /\ is_finite y = true.
Proof.
  intro h. apply andb_prop in h as [h le]. apply andb_prop in h as [fx fy]. split; [|auto].
  rewrite (Chains.less prec emax y x fy fx) in le. destruct (Rlt_dec _ _); [discriminate|lra].
Qed.
Lemma moment_is t : is_moment t = true -> 0 <= B2R t <= 1 /\ is_finite t = true.
Proof.
  intro h. apply andb_prop in h as [low high]. apply at_most in low as (low & _). apply at_most in high as (high & fin & _).
  rewrite (proj1 one_is) in high. cbn in low. auto.
Qed.
Lemma short_is w a : is_short w = true -> Rabs (B2R (component w a)) <= Errors.reach f.
Proof.
  intro h. unfold is_short in h. rewrite forallb_forall in h.
  destruct (at_most _ _ (h a ltac:(destruct a; cbn; tauto))) as (le & _). rewrite B2R_Babs in le.
  destruct (exact_power (largest_ + 2)) as [E _]; [pose proof facts; lia|]. rewrite E in le.
  unfold power in le. rewrite bpow_plus in le. change (bpow radix2 2) with 4 in le.
  unfold Errors.reach, power. change (largest_edge f) with largest_. lra.
Qed.

(* What a round's proofs need, with a separation and without; and the steps that they allow. *)
Variable place : Expressions.coordinate -> R.
Hypothesis places : forall c, place c = B2R (place_ c).
Record allowed (step : R -> R -> Prop) (all : Advancing.proofs) := Allowed {
  held_ : forall w from until u, let i := inputs [w] from until in
    says f env_ (nearest i) (Advancing.is_in_range all) -> Advancing.is_direction f (given i) 0 ->
    Advancing.is_moment (given i) 0 -> says f env_ (nearest i) (Advancing.by_held all) ->
    nearest i (Advancing.until_held all) = Number u -> step (B2R from) u;
  turning_ : forall v w from until, let i := inputs [v; w] from until in
    says f env_ (nearest i) (Advancing.is_in_range all) -> Advancing.is_direction f (given i) 0 ->
    Advancing.is_direction f (given i) 1 -> Advancing.is_moment (given i) 0 -> Advancing.is_moment (given i) 1 ->
    says f env_ (nearest i) (Greater (Input (Moment 1)) (Input (Moment 0))) ->
    says f env_ (nearest i) (Advancing.by_turning all) -> step (B2R from) (B2R until);
  curving_ : forall v m w from until, let i := inputs [v; m; w] from until in
    says f env_ (nearest i) (Advancing.is_in_range all) -> Advancing.is_direction f (given i) 0 ->
    Advancing.is_direction f (given i) 1 -> Advancing.is_direction f (given i) 2 ->
    Advancing.is_moment (given i) 0 -> Advancing.is_moment (given i) 1 ->
    says f env_ (nearest i) (Greater (Input (Moment 1)) (Input (Moment 0))) ->
    says f env_ (nearest i) (Advancing.by_curving all) -> step (B2R from) (B2R until);
  to_the_end_ : forall from until, let i := inputs [] from until in
    says f env_ (nearest i) (Advancing.is_in_range all) -> Advancing.is_moment (given i) 0 ->
    says f env_ (nearest i) (Advancing.by_volume_to_the_end all) -> step (B2R from) 1;
  clipped_ : forall from until u, let i := inputs [] from until in
    says f env_ (nearest i) (Advancing.is_in_range all) -> Advancing.is_moment (given i) 0 -> B2R from < u ->
    nearest i (Advancing.until_volume all) = Number u -> step (B2R from) u }.

(* A chain of steps from time zero. *)
Inductive chain (step : R -> R -> Prop) : R -> Prop :=
| Nothing : chain step 0
| More from until : 0 <= from -> chain step from -> step from until -> chain step until
| Down from until : chain step from -> until <= from -> chain step until.

(* The programs are of the terms that the chains of rounds are about. *)
Record are_programs (all : Advancing.proofs) := ArePrograms {
  range_is : range code = Advancing.is_in_range all;
  held_is : exists places, is_program places (held code) (Advancing.by_held all) (Advancing.until_held all);
  turning_is : exists places, is_program places (turning code) (Advancing.by_turning all) (Input (Moment 1));
  curving_is : exists places, is_program places (curving code) (Advancing.by_curving all) (Input (Moment 1));
  volume_is : exists places, is_program places (volume code) (Advancing.by_volume_to_the_end all)
    (Advancing.until_volume all) }.

Variable step : R -> R -> Prop.
Variable all : Advancing.proofs.
Hypothesis allows : allowed step all.
Hypothesis right_programs : are_programs all.
Lemma checked_is_right p m e input_ : (exists places, is_program places p m e) ->
  (fst (checked p input_) = Some true -> says f env_ (nearest input_) (Advancing.is_in_range all) /\
    says f env_ (nearest input_) m) /\
  (forall u, snd (checked p input_) = Some u -> says f env_ (nearest input_) (Advancing.is_in_range all) /\
    nearest input_ e = Number (B2R u) /\ is_finite u = true).
Proof.
  intros (places_of & valid). destruct (result_is_right places_of p m e input_ valid) as [masks numbers]. unfold checked,
    is_in_range.
  destruct (holds input_ (range code)) as [[|]|] eqn:E; try (split; intros; discriminate).
  assert (in_range : says f env_ (nearest input_) (Advancing.is_in_range all)).
  { rewrite <- (range_is all right_programs). apply (in_format Chains.what_holds_is_said p0 pe is_fine _ input_);
    [reflexivity|exact E]. }
  auto.
Qed.
Lemma both_are r u : are_both r = Some u -> fst r = Some true /\ snd r = Some u.
Proof. destruct r as [[[|]|] [x|]]; try discriminate. now intros [= ->]. Qed.
Lemma short_direction directions from until k : is_short (nth k directions (0, 0, (0, 0), (0, 0))%Z) = true ->
  Advancing.is_direction f (given (inputs directions from until)) k.
Proof. intros h a. exact (short_is _ a h). Qed.
Lemma later from until directions : is_finite from = true -> is_finite until = true -> Bltb from until = true ->
  says f env_ (nearest (inputs directions from until)) (Greater (Input (Moment 1)) (Input (Moment 0))).
Proof. intros ff fu h. cbn. exact (less _ _ ff fu h). Qed.
Lemma same_time (x y : binary) : is_finite x = true -> is_finite y = true -> Beqb x y = true -> B2R x = B2R y.
Proof.
  intros fx fy h. rewrite (Beqb_correct _ _ x y fx fy) in h. unfold Req_bool in h.
  destruct (Rcompare_spec (B2R x) (B2R y)); (discriminate || assumption).
Qed.
Lemma clipped_is_right n : forall from until u, chain step (B2R from) -> clipped n from until = Some u -> chain step (B2R u).
Proof.
  induction n as [|n IH]; intros from until u reached h; [discriminate|]. cbn [clipped] in h.
  destruct (is_moment from) eqn:time; [|discriminate]. apply moment_is in time as [time_ fin].
  destruct (checked_is_right (volume code) _ _ (inputs [] from until) (volume_is all right_programs)) as [masks numbers].
  assert (moment : Advancing.is_moment (given (inputs [] from until)) 0) by exact time_.
  destruct (checked (volume code) (inputs [] from until)) as [ended next]. cbn [fst snd] in masks, numbers.
  destruct (match ended with Some true => true | _ => false end) eqn:which.
  - destruct ended as [[|]|]; try discriminate. injection h as <-. rewrite (proj1 one_is).
    destruct (masks eq_refl) as [in_range said]. apply More with (B2R from); [apply time_|exact reached|].
    exact (to_the_end_ step all allows from until in_range moment said).
  - destruct next as [v|]; [|destruct ended as [[|]|]; discriminate].
    assert (h' : (if Bltb from v then if Beqb v until then Some v else clipped n v until else None) = Some u)
      by (destruct ended as [[|]|]; (discriminate || exact h)).
    destruct (Bltb from v) eqn:less_; [|discriminate]. destruct (numbers v eq_refl) as (in_range & E & fv).
    pose proof (less _ _ fin fv less_) as lt.
    assert (reached' : chain step (B2R v)).
    { apply More with (B2R from); [apply time_|exact reached|].
      exact (clipped_ step all allows from until (B2R v) in_range moment lt E). }
    destruct (Beqb v until); [now injection h' as <-|]. exact (IH _ _ _ reached' h').
Qed.
Lemma proven_is_right from until p u : chain step (B2R from) -> proven from until p = Some u -> chain step (B2R u).
Proof.
  intros reached h. unfold proven in h. destruct (is_moment from && is_moment until) eqn:times; [|discriminate].
  apply andb_prop in times as [t0 t1]. apply moment_is in t0 as [time_ fin]. apply moment_is in t1 as [t1 fin'].
  destruct p as [|w|v w|v m w].
  - exact (clipped_is_right _ _ _ _ reached h).
  - destruct (is_short w) eqn:short; [|discriminate].
    destruct (are_both _) as [x|] eqn:E; [|discriminate]. injection h as <-. apply both_are in E as [masks number].
    destruct (checked_is_right (held code) _ _ (inputs [w] from until) (held_is all right_programs)) as [of_masks of_numbers].
    destruct (of_masks masks) as [in_range said]. destruct (of_numbers x number) as (_ & E & fx).
    assert (now_ : chain step (B2R x)).
    { apply More with (B2R from); [apply time_|exact reached|].
      exact (held_ step all allows w from until _ in_range (short_direction [w] from until 0 short) time_ said E). }
    destruct (Bltb one x) eqn:large; [|exact now_]. apply Down with (B2R x); [exact now_|].
    apply Rlt_le, less; [apply one_is|exact fx|exact large].
  - destruct (Bltb from until && is_short v && is_short w) eqn:short; [|discriminate].
    apply andb_prop in short as [short sw]. apply andb_prop in short as [less_ sv]. apply both_are in h as [masks number].
    destruct (checked_is_right (turning code) _ _ (inputs [v; w] from until) (turning_is all right_programs)) as [of_masks
      of_numbers].
    destruct (of_masks masks) as [in_range said]. destruct (of_numbers u number) as (_ & E & _).
    injection E as E. rewrite <- E. apply More with (B2R from); [apply time_|exact reached|].
    exact (turning_ step all allows v w from until in_range (short_direction [v; w] from until 0 sv)
      (short_direction [v; w] from until 1 sw) time_ t1 (later from until [v; w] fin fin' less_) said).
  - destruct (Bltb from until && is_short v && is_short m && is_short w) eqn:short; [|discriminate].
    apply andb_prop in short as [short sw]. apply andb_prop in short as [short sm]. apply andb_prop in short as [less_ sv].
    apply both_are in h as [masks number].
    destruct (checked_is_right (curving code) _ _ (inputs [v; m; w] from until) (curving_is all right_programs)) as [of_masks
      of_numbers].
    destruct (of_masks masks) as [in_range said]. destruct (of_numbers u number) as (_ & E & _).
    injection E as E. rewrite <- E. apply More with (B2R from); [apply time_|exact reached|].
    exact (curving_ step all allows v m w from until in_range (short_direction [v; m; w] from until 0 sv)
      (short_direction [v; m; w] from until 1 sm) (short_direction [v; m; w] from until 2 sw) time_ t1
      (later from until [v; m; w] fin fin' less_) said).
Qed.
Theorem replayed_is_a_chain record : forall from u, chain step (B2R from) -> replayed from record = Some u ->
  chain step (B2R u).
Proof.
  induction record as [|[until p] rest IH]; intros from u reached h; cbn [replayed] in h.
  - now injection h as <-.
  - destruct (proven from (number_of until) p) as [v|] eqn:E; [|discriminate].
    destruct (Beqb v (number_of until)); [|discriminate]. exact (IH v u (proven_is_right _ _ _ _ reached E) h).
Qed.

(* The sets of a pair are beyond the separation along an axis, in exact numbers: their boxes, which the code tests first. *)
Definition exact (x : binary) := match x with
  | B754_finite s m e _ => Float radix2 (cond_Zopp s (Zpos m)) e
  | _ => Float radix2 0 0 end.
Definition exceeds x y s := (0 <? Fnum (Fminus (Fminus (exact x) (exact y)) (exact s)))%Z.
Lemma exceeds_is x y s : exceeds x y s = true -> B2R s < B2R x - B2R y.
Proof.
  intro h. apply Z.ltb_lt, F2R_gt_0 in h. rewrite !F2R_minus in h.
  assert (same : forall z, F2R (exact z) = B2R z). { intros [|[|]| |]; cbn; try reflexivity; apply F2R_0. }
  rewrite !same in h. lra.
Qed.
Definition is_axis (a b : Expressions.axis) := match a, b with
  | Expressions.X, Expressions.X | Expressions.Y, Expressions.Y | Expressions.Z_, Expressions.Z_ => true | _, _ => false end.
Definition unit_ a (up : bool) b := if is_axis a b then if up then 1 else -1 else 0.
Definition names_axis a (up : bool) (w : vector) := let '(x, y, z) := w in
  forallb (fun '(b, (m, e)) => Z.eqb m (if is_axis a b then if up then 1 else -1 else 0) && Z.eqb e 0)
    [(Expressions.X, x); (Expressions.Y, y); (Expressions.Z_, z)].
Definition are_beyond a (up : bool) (pairs : list (nat * nat)) := forallb (fun '(n, k) => forallb (fun t =>
  let x := place_ (Expressions.Coordinate n t a) in let y := place_ (Expressions.Coordinate k t a) in
  if up then exceeds x y separation else exceeds y x separation) [Expressions.Start; Expressions.End]) pairs.
Definition by_axis pairs (record : list part) := match record with
  | [(1, 0, HeldAlong w)] => existsb (fun '(a, up) => names_axis a up w && are_beyond a up pairs)
      (list_prod [Expressions.X; Expressions.Y; Expressions.Z_] [true; false])
  | _ => false end%Z.
Lemma by_axis_is_ahead pairs record given_ t : by_axis pairs record = true -> (forall c, given_ (Place c) = place c) ->
  0 <= t <= 1 -> AdvancingBeyond.ahead (B2R separation) pairs given_ t.
Proof.
  intros h same time. destruct record as [|[[[|[]|] [|[]|]] [|w|v w|v m w]] [|? ?]]; try discriminate.
  cbn [by_axis] in h. apply existsb_exists in h as ([a up] & _ & h). apply andb_prop in h as [_ h].
  unfold are_beyond in h. rewrite forallb_forall in h. exists (unit_ a up). intros [n k] inside.
  specialize (h (n, k) inside). cbv beta iota in h. rewrite forallb_forall in h.
  pose proof (h Expressions.Start ltac:(cbn; tauto)) as h0. pose proof (h Expressions.End ltac:(cbn; tauto)) as h1.
  assert (n1 : DirectionsBeyond.norm (unit_ a up) = 1).
  { unfold DirectionsBeyond.norm. replace (Least.squared (unit_ a up)) with 1 by (destruct a, up; cbv -[Rplus Rmult Ropp
    IZR]; ring).
    exact sqrt_1. }
  rewrite n1, Rmult_1_r. cbv zeta in h0, h1.
  assert (E : Corners.sum3 (fun b => unit_ a up b * Corners.exactly_at given_ (n, k) b t) =
    (1 - t) * (unit_ a up a * (place (Expressions.Coordinate n Expressions.Start a) - place (Expressions.Coordinate k
      Expressions.Start a))) +
    t * (unit_ a up a * (place (Expressions.Coordinate n Expressions.End a) - place (Expressions.Coordinate k Expressions.End
      a)))).
  { unfold Corners.sum3, Corners.exactly_at, Corners.exactly, Corners.exact_difference. rewrite !same.
    destruct a; cbn [unit_ is_axis]; destruct up; ring. }
  rewrite E, !places.
  assert (both : forall x y, (if up then exceeds x y separation else exceeds y x separation) = true ->
    B2R separation < unit_ a up a * (B2R x - B2R y)).
  { intros x y e. destruct up; apply exceeds_is in e; destruct a; cbn [unit_ is_axis]; lra. }
  apply both in h0, h1. set (u0 := unit_ a up a * _) in *. set (u1 := unit_ a up a * (B2R (place_ (Expressions.Coordinate n
    Expressions.End a)) - _)) in *.
  destruct (Rle_lt_dec t (1 / 2)).
  - assert ((1 - t) * B2R separation < (1 - t) * u0) by (apply Rmult_lt_compat_l; lra).
    assert (t * B2R separation <= t * u1) by (apply Rmult_le_compat_l; lra). lra.
  - assert ((1 - t) * B2R separation <= (1 - t) * u0) by (apply Rmult_le_compat_l; lra).
    assert (t * B2R separation < t * u1) by (apply Rmult_lt_compat_l; lra). lra.
Qed.
(* A record proves a pair apart until a time. *)
Definition proves pairs record (answer : binary) := by_axis pairs record && Beqb answer one ||
  match replayed zero record with Some u => is_finite u && is_finite answer && Beqb u answer | None => false end.
Lemma proves_by pairs record answer : proves pairs record answer = true -> by_axis pairs record = true \/
  chain step (B2R answer).
Proof.
  intro h. apply orb_prop in h as [h|h]; [left; now apply andb_prop in h|right].
  destruct (replayed zero record) as [u|] eqn:E; [|discriminate]. apply andb_prop in h as [h same].
  apply andb_prop in h as [fu fa]. rewrite <- (same_time _ _ fu fa same).
  exact (replayed_is_a_chain record zero u (Nothing step) E).
Qed.
End OfAPair.

(* The theorems: without a separation and with one. *)
Variable is_fine : Corners.reasonable_constants f.
Notation env_ := (in_format Chains.env is_fine).
Variable place_ : Expressions.coordinate -> binary.
Definition place c := B2R (place_ c).
Variables p b c : nat * nat.
Variable others : list (nat * nat).
Notation pairs := (p :: b :: c :: others).
Lemma execution_of (input_ : input -> binary) : execution f env_ (in_format Chains.nearest is_fine (fun i => B2R (input_ i)))
  (fun i => B2R (input_ i)).
Proof. apply Chains.an_execution_exists; assumption. Qed.

Notation given i := (fun j : input => B2R (i j : binary)).
Notation nearest i := (in_format Chains.nearest is_fine (given i)).
Lemma rounds_are_allowed all : allowed place_ zero is_fine (Advancing.step all place f env_) all.
Proof.
  assert (C : forall i : input -> binary, (forall c, i (Place c) = place_ c) -> says f env_ (nearest i)
    (Advancing.is_in_range all) -> Advancing.computed f env_ place (given i) (nearest i) all).
  { intros i same range_. split; [intro; unfold place; now rewrite same|]. split; [apply execution_of|exact range_]. }
  split.
  - intros w from until u i range_ short time said E. exact (Advancing.Held all place f env_ (given i) (nearest i) u
      (C i (fun c => eq_refl) range_) short time said E).
  - intros v w from until i range_ s0 s1 t0 t1 later_ said. exact (Advancing.Turning all place f env_ (given i) (nearest i)
      (C i (fun c => eq_refl) range_) s0 s1 t0 t1 later_ said).
  - intros v m w from until i range_ s0 s1 s2 t0 t1 later_ said. exact (Advancing.Curving all place f env_ (given i)
      (nearest i) (C i (fun c => eq_refl) range_) s0 s1 s2 t0 t1 later_ said).
  - intros from until i range_ time said. exact (Advancing.VolumeToTheEnd all place f env_ (given i) (nearest i)
      (C i (fun c => eq_refl) range_) time said).
  - intros from until u i range_ time less_ E. exact (Advancing.VolumeUntil all place f env_ (given i) (nearest i) u
      (C i (fun c => eq_refl) range_) time less_ E).
Qed.
Lemma chain_reaches all u : chain (Advancing.step all place f env_) u -> u <= 0 \/ Advancing.reaches all place 0 u.
Proof.
  induction 1 as [|from until from0 _ [low|IH] h|from until _ [low|IH] less_].
  - left; lra.
  - replace from with 0 in h by lra. right. exact (Advancing.First all place 0 f env_ until is_fine h).
  - right. exact (Advancing.Next all place 0 f env_ from until is_fine IH h).
  - left; lra.
  - right. exact (Advancing.RoundedDown all place 0 from until IH less_).
Qed.
Definition with_places i := match i with Place c => place c | _ => 0 end.
Theorem a_record_proves_apart code record answer t : are_programs code (Advancing.for_corners pairs) ->
  proves code place_ zero pairs record answer = true -> 0 < B2R answer -> 0 <= t <= B2R answer -> t <= 1 ->
  Advancing.apart pairs place t.
Proof.
  intros right_ h some between t1.
  destruct (proves_by code place_ zero is_fine (Advancing.step (Advancing.for_corners pairs) place f env_) _
    (rounds_are_allowed _) right_ pairs record answer h) as [axis|reached].
  - destruct (by_axis_is_ahead place_ zero place (fun c => eq_refl) pairs record with_places t axis
      (fun c => eq_refl) ltac:(lra)) as [w ahead]. exists with_places. split; [intro; reflexivity|]. left. exists w.
    intros pair inside. specialize (ahead pair inside). cbn in ahead. rewrite Rmult_0_l in ahead. exact ahead.
  - destruct (chain_reaches _ _ reached) as [low|chain_]; [lra|].
    exact (Advancing.rounds_keep_apart p b c others place 0 (B2R answer) chain_ t between t1).
Qed.

Variable separation : binary.
Definition is_separation := is_at_most (power_of_two (2 - emax)) separation && is_at_most separation (power_of_two reach_).
Definition without (all : AdvancingBeyond.proofs) := Advancing.Proofs (AdvancingBeyond.is_in_range all)
  (AdvancingBeyond.by_held all) (AdvancingBeyond.until_held all) (AdvancingBeyond.by_turning all)
  (AdvancingBeyond.by_curving all) (AdvancingBeyond.by_volume_throughout all) (AdvancingBeyond.by_volume_to_the_end all)
  (AdvancingBeyond.until_volume all).
Hypothesis separation_ : is_separation = true.
Lemma separation_is : lam f <= B2R separation <= power (largest_extent f).
Proof.
  apply andb_prop in separation_ as [low high]. apply at_most in low as (low & _). apply at_most in high as (high & _).
  pose proof (Nearest.facts prec emax pe underflow_ largest_ (Corners.reasonable_base f is_fine)).
  pose proof (Corners.extents f is_fine) as e. change (0 <= reach_ <= largest_)%Z in e.
  destruct (in_format Chains.exact_power p0 pe is_fine (2 - emax))
    as [E _]; [lia|].
  destruct (in_format Chains.exact_power p0 pe is_fine reach_)
    as [E' _]; [lia|]. rewrite E in low. rewrite E' in high. split; [|exact high].
  unfold lam. replace (least_exponent f + precision f - 1)%Z with (2 - emax)%Z; [exact low|].
  change (2 - emax = 3 - emax - prec + prec - 1)%Z. lia.
Qed.
Lemma rounds_beyond_are_allowed all : allowed place_ separation is_fine
  (AdvancingBeyond.step all place (B2R separation) f env_) (without all).
Proof.
  assert (C : forall i : input -> binary, (forall c, i (Place c) = place_ c) -> i (Length Separation) = separation ->
    says f env_ (nearest i) (AdvancingBeyond.is_in_range all) ->
    AdvancingBeyond.computed f env_ place (B2R separation) (given i) (nearest i) all).
  { intros i same same' range_. split; [intro; unfold place; now rewrite same|]. split; [apply execution_of|].
    split; [now rewrite same'|]. split; [exact separation_is|exact range_]. }
  split.
  - intros w from until u i range_ short time said E. exact (AdvancingBeyond.HeldBeyond all place _ f env_ (given i)
      (nearest i) u (C i (fun c => eq_refl) eq_refl range_) short time said E).
  - intros v w from until i range_ s0 s1 t0 t1 later_ said. exact (AdvancingBeyond.TurningBeyond all place _ f env_ (given i)
      (nearest i) (C i (fun c => eq_refl) eq_refl range_) s0 s1 t0 t1 later_ said).
  - intros v m w from until i range_ s0 s1 s2 t0 t1 later_ said. exact (AdvancingBeyond.CurvingBeyond all place _ f env_
      (given i) (nearest i) (C i (fun c => eq_refl) eq_refl range_) s0 s1 s2 t0 t1 later_ said).
  - intros from until i range_ time said. exact (AdvancingBeyond.VolumeToTheEndBeyond all place _ f env_ (given i)
      (nearest i) (C i (fun c => eq_refl) eq_refl range_) time said).
  - intros from until u i range_ time less_ E. exact (AdvancingBeyond.VolumeUntilBeyond all place _ f env_ (given i)
      (nearest i) u (C i (fun c => eq_refl) eq_refl range_) time less_ E).
Qed.
Lemma chain_reaches_beyond all u : chain (AdvancingBeyond.step all place (B2R separation) f env_) u ->
  u <= 0 \/ AdvancingBeyond.reaches all place (B2R separation) 0 u.
Proof.
  induction 1 as [|from until from0 _ [low|IH] h|from until _ [low|IH] less_].
  - left; lra.
  - replace from with 0 in h by lra. right. exact (AdvancingBeyond.First all place _ 0 f env_ until is_fine h).
  - right. exact (AdvancingBeyond.Next all place _ 0 f env_ from until is_fine IH h).
  - left; lra.
  - right. exact (AdvancingBeyond.RoundedDown all place _ 0 from until IH less_).
Qed.
Theorem a_record_proves_a_separation code record answer t :
  are_programs code (without (AdvancingBeyond.for_corners pairs)) ->
  proves code place_ separation pairs record answer = true -> 0 < B2R answer -> 0 <= t <= B2R answer -> t <= 1 ->
  AdvancingBeyond.apart p b c others place (B2R separation) t.
Proof.
  intros right_ h some between t1.
  destruct (proves_by code place_ separation is_fine (AdvancingBeyond.step (AdvancingBeyond.for_corners pairs) place
    (B2R separation) f env_) _ (rounds_beyond_are_allowed _) right_ pairs record answer h) as [axis|reached].
  - pose proof separation_is. pose proof (lam_pos f).
    pose proof (by_axis_is_ahead place_ separation place (fun c => eq_refl) pairs record with_places t axis
      (fun c => eq_refl) ltac:(lra)) as ahead. split; [lra|]. exists with_places. split; [intro; reflexivity|]. left. exact ahead.
  - destruct (chain_reaches_beyond _ _ reached) as [low|chain_]; [lra|].
    exact (AdvancingBeyond.rounds_keep_apart p b c others place _ 0 (B2R answer) chain_ t between t1).
Qed.
End Replay.
