(* Chains of rounds exist: an execution of the time of impact's terms, to nearest, for any inputs; and where nothing
   overflows Flocq's binary numbers compute it. So Coq runs the traced code for two pairs, and its proofs hold for
     them. *)
From Coq Require Import Reals ZArith Lra Lia Bool List.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Arithmetic Machine.
From Selvedge Require Expressions Nearest Nearness Corners Advance Advancing Witnesses Errors.
Open Scope R_scope.

Scheme number_mask := Induction for number Sort Prop with mask_number := Induction for mask Sort Prop.
Combined Scheme numbers_and_masks from number_mask, mask_number.

Section Chains.
Variables prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ : Z.
Context (prec_gt_0_ : Prec_gt_0 prec) (prec_lt_emax_ : Prec_lt_emax prec emax).
Definition constants_of := Constants (Nearest.format_of prec emax underflow_ largest_) extent_ reach_ safe_ vanishing_.
Notation f := constants_of.
Hypothesis fine : Corners.reasonable_constants f.
Definition ok : reasonable f := Corners.reasonable_base f fine.
Definition env : environment f := Nearness.to_nearest f ok.
Notation near z := (rounded env z).
Notation binary := (binary_float prec emax).
Notation facts := (Nearest.facts prec emax prec_lt_emax_ underflow_ largest_ ok).

(* An execution in real numbers. *)
Variable given : input -> R.
Definition settled r := if Rle_dec (Rabs r) (omega f) then Number r else Infinite (if Rlt_dec 0 r then true else false).
Definition added (op : R -> R -> R) (sign_of_second : bool -> bool) v w := match v, w with
  | Number x, Number y => settled (near (op x y))
  | Infinite s, Number _ => Infinite s | Number _, Infinite s => Infinite (sign_of_second s) | _, _ => NaN end.
Definition multiplied v w := match v, w with
  | Number x, Number y => settled (near (x * y))
  | Infinite s, Number _ | Number _, Infinite s => Infinite s | _, _ => NaN end.
Definition divided v w := match v, w with
  | Number x, Number y => if Req_EM_T y 0 then if Req_EM_T x 0 then NaN else Infinite (if Rlt_dec 0 x then true else
    false)
    else settled (near (x / y))
  | _, _ => NaN end.
Definition rooted v := match v with
  | Number x => if Rlt_dec x 0 then NaN else settled (near (sqrt x))
  | Infinite true => Infinite true | _ => NaN end.
Definition is_greater v w := match v, w with
  | NaN, _ | _, NaN => false
  | Number x, Number y => if Rlt_dec y x then true else false
  | Infinite false, _ | _, Infinite true => false
  | _, _ => true end.
Fixpoint nearest (e : number) : value := match e with
  | Input i => Number (given i)
  | Constant c => Number (constant_value f c)
  | Sum a b => added Rplus (fun s => s) (nearest a) (nearest b)
  | Minus a b => added Rminus negb (nearest a) (nearest b)
  | Product a b => multiplied (nearest a) (nearest b)
  | Quotient a b => divided (nearest a) (nearest b)
  | Negative a => negative (nearest a)
  | Magnitude a => magnitude (nearest a)
  | Larger a b => if is_greater (nearest b) (nearest a) then nearest b else nearest a
  | Smaller a b => if is_greater (nearest a) (nearest b) then nearest b else nearest a
  | Select m a b => if is_said m then nearest a else nearest b
  | Root a => rooted (nearest a) end
with is_said (m : mask) : bool := match m with
  | Always => true
  | Greater a b => is_greater (nearest a) (nearest b)
  | Both a b => is_said a && is_said b
  | Either a b => is_said a || is_said b
  | Not a => negb (is_said a) end.

Lemma seen_same v : seen_value f env v = v. Proof. now destruct v. Qed.
Lemma settled_result z : result f env z (settled (near z)).
Proof.
  unfold result, settled. cbv zeta. destruct (Rle_dec _ _) as [le|gt]; [left; auto|right]. apply Rnot_le_lt in gt.
  assert (0 < omega f). { unfold omega, power. apply Rlt_Rminus, bpow_lt. cbn. pose proof facts. lia. }
  destruct (Rlt_dec 0 (near z)) as [p|n].
  - left. rewrite Rabs_pos_eq in gt by lra. auto.
  - right. rewrite Rabs_left1 in gt by lra. split; [lra|auto].
Qed.
Lemma is_greater_spec v w : is_greater v w = true <-> greater f env v w.
Proof.
  unfold greater. rewrite !seen_same. destruct v as [x|[|]|], w as [y|[|]|]; cbn; try (split; (discriminate || tauto)).
  destruct (Rlt_dec y x); split; (discriminate || tauto).
Qed.
Lemma not_both v w : greater f env v w -> ~ greater f env w v.
Proof. unfold greater. rewrite !seen_same. destruct v as [x|[|]|], w as [y|[|]|]; cbn; try tauto. lra. Qed.
Lemma said m : is_said m = true <-> says f env nearest m.
Proof.
  induction m as [|a b|m IH m' IH'|m IH m' IH'|m IH]; cbn.
  - tauto.
  - apply is_greater_spec.
  - rewrite andb_true_iff. tauto.
  - rewrite orb_true_iff. tauto.
  - rewrite <- IH. destruct (is_said m); split; cbn; congruence.
Qed.
Theorem an_execution_exists : execution f env nearest given.
Proof.
  intros [i|c|a b|a b|a b|a b|a|a|a b|a b|m a b|a]; cbn [nearest]; try reflexivity.
  1, 2: unfold sum; rewrite !seen_same; destruct (nearest a) as [x| |], (nearest b) as [y| |]; cbn; try reflexivity;
    try exact I; apply settled_result.
  - unfold product. rewrite !seen_same. destruct (nearest a) as [x| |], (nearest b) as [y| |]; cbn; try reflexivity;
      try exact I; try (intros; reflexivity). apply settled_result.
  - unfold quotient. rewrite !seen_same. destruct (nearest a) as [x| |], (nearest b) as [y| |]; cbn; try reflexivity;
      try exact I. destruct (Req_EM_T y 0) as [->|n].
    + repeat split; try tauto; destruct (Req_EM_T x 0); try lra; try reflexivity; destruct (Rlt_dec 0 x); lra ||
      reflexivity.
    + repeat split; try tauto. intros _. apply settled_result.
  - unfold larger, as_it_is. destruct (is_greater _ _) eqn:g.
    + apply is_greater_spec, not_both in g. auto.
    + left. split; [|auto]. intro h. apply is_greater_spec in h. congruence.
  - unfold smaller, as_it_is. destruct (is_greater _ _) eqn:g.
    + apply is_greater_spec, not_both in g. auto.
    + left. split; [|auto]. intro h. apply is_greater_spec in h. congruence.
  - pose proof (said m) as s. destruct (is_said m); [left; tauto|right]. split; [|reflexivity].
    intro h. apply s in h. discriminate.
  - unfold root. rewrite seen_same. destruct (nearest a) as [x|[|]|]; cbn; try reflexivity.
    destruct (Rlt_dec x 0); split; intro; try lra; try reflexivity. apply settled_result.
Qed.

(* What a term says with a number in the place of each input. *)
Fixpoint filled (at_ : input -> number) (e : number) : number := match e with
  | Input i => at_ i
  | Constant c => Constant c
  | Sum a b => Sum (filled at_ a) (filled at_ b)
  | Minus a b => Minus (filled at_ a) (filled at_ b)
  | Product a b => Product (filled at_ a) (filled at_ b)
  | Quotient a b => Quotient (filled at_ a) (filled at_ b)
  | Negative a => Negative (filled at_ a)
  | Magnitude a => Magnitude (filled at_ a)
  | Larger a b => Larger (filled at_ a) (filled at_ b)
  | Smaller a b => Smaller (filled at_ a) (filled at_ b)
  | Select m a b => Select (filled_mask at_ m) (filled at_ a) (filled at_ b)
  | Root a => Root (filled at_ a) end
with filled_mask at_ (m : mask) : mask := match m with
  | Always => Always
  | Greater a b => Greater (filled at_ a) (filled at_ b)
  | Both a b => Both (filled_mask at_ a) (filled_mask at_ b)
  | Either a b => Either (filled_mask at_ a) (filled_mask at_ b)
  | Not a => Not (filled_mask at_ a) end.
Lemma filled_with_itself : (forall e, filled Input e = e) /\ (forall m, filled_mask Input m = m).
Proof. apply numbers_and_masks; cbn; congruence. Qed.

(* An execution in binary numbers, as long as all that it needs are finite. *)
Variable given_ : input -> binary.
Notation finite := (Nearest.finite prec emax).
Notation both := (Nearest.both prec emax).
Notation power_of_two := (Nearest.power_of_two prec emax prec_gt_0_ prec_lt_emax_).
Definition constant_number c := match c with
  | UnitRoundoff => Some (power_of_two (- prec))
  | Underflow => Some (power_of_two underflow_)
  | ExtentUnderflow => Some (power_of_two extent_)
  | LargestExtent => Some (power_of_two reach_)
  | Half => Some (power_of_two (-1))
  | Small n => if ((0 <=? n) && (n <? 256))%Z then Some (binary_normalize prec emax _ _ mode_NE n 0 false) else None
  | LargestEdge => Some (power_of_two largest_)
  | SafeSquare => Some (power_of_two safe_)
  | LengthUnderflow => Some (power_of_two vanishing_) end.
Fixpoint run (e : number) : option binary := match e with
  | Input i => finite (given_ i)
  | Constant c => constant_number c
  | Sum a b => both (Bplus mode_NE) (run a) (run b)
  | Minus a b => both (Bminus mode_NE) (run a) (run b)
  | Product a b => both (Bmult mode_NE) (run a) (run b)
  | Quotient a b => match run b with
    | Some y => if is_finite_strict y then both (Bdiv mode_NE) (run a) (Some y) else None
    | None => None end
  | Negative a => option_map (@Bopp prec emax) (run a)
  | Magnitude a => option_map (@Babs prec emax) (run a)
  | Larger a b => match run a, run b with Some x, Some y => Some (if Bltb x y then y else x) | _, _ => None end
  | Smaller a b => match run a, run b with Some x, Some y => Some (if Bltb y x then y else x) | _, _ => None end
  | Select m a b => match holds m with Some true => run a | Some false => run b | None => None end
  | Root a => match run a with
    | Some x => if Bltb x (B754_zero false) then None else finite (Bsqrt mode_NE x)
    | None => None end end
with holds (m : mask) : option bool := match m with
  | Always => Some true
  | Greater a b => match run a, run b with Some x, Some y => Some (Bltb y x) | _, _ => None end
  | Both a b => match holds a with Some true => holds b | other => other end
  | Either a b => match holds a with Some false => holds b | other => other end
  | Not a => option_map negb (holds a) end.

Lemma of_settled z (x : binary) : B2R x = near z -> settled (near z) = Number (B2R x).
Proof.
  intro E. unfold settled. rewrite <- E. destruct (Rle_dec _ _) as [|n]; [reflexivity|]. destruct n.
  exact (Nearest.finite_is_small prec emax prec_gt_0_ underflow_ largest_ x).
Qed.
Lemma exact_power e : (3 - emax - prec + prec - 1 <= e < emax)%Z -> B2R (power_of_two e) = power e /\
  is_finite (power_of_two e) = true.
Proof. exact (Nearest.exact_power prec emax prec_gt_0_ prec_lt_emax_ underflow_ largest_ ok e). Qed.
Lemma less (x y : binary) : is_finite x = true -> is_finite y = true ->
  Bltb x y = if Rlt_dec (B2R x) (B2R y) then true else false.
Proof.
  intros fx fy. rewrite (Bltb_correct _ _ x y fx fy). unfold Rlt_bool.
  destruct (Rcompare_spec (B2R x) (B2R y)), (Rlt_dec (B2R x) (B2R y)); try reflexivity; lra.
Qed.
(* A small whole number, halved or not. *)
Definition whole n e : binary := binary_normalize prec emax _ _ mode_NE n e false.
Lemma whole_is n e : (Z.abs n < 256)%Z -> (-1 <= e <= 0)%Z -> B2R (whole n e) = F2R (Float radix2 n e) /\
  is_finite (whole n e) = true.
Proof.
  intros small e01. pose proof facts.
  apply (Nearest.exact_constant prec emax prec_gt_0_ prec_lt_emax_ underflow_ largest_ n e).
  - apply generic_format_FLT. exists (Float radix2 n e); [reflexivity| |].
    + cbn [Fnum]. assert (256 <= 2 ^ prec)%Z by (change 256%Z with (2 ^ 8)%Z; apply Z.pow_le_mono_r; lia).
      unfold Nearest.format_of; cbn [precision]. change (radix_val radix2) with 2%Z. lia.
    + change (3 - emax - prec <= e)%Z. lia.
  - rewrite <- F2R_Zabs. unfold F2R; cbn [Fnum Fexp]. apply Rlt_le_trans with (bpow radix2 8).
    + assert (bpow radix2 e <= 1) by (change 1 with (bpow radix2 0); apply bpow_le; lia).
      pose proof (bpow_gt_0 radix2 e). assert (0 <= IZR (Z.abs n)) by (apply IZR_le; lia).
      apply IZR_lt in small. change (bpow radix2 8) with 256. apply Rle_lt_trans with (IZR (Z.abs n) * 1); [|lra].
      apply Rmult_le_compat_l; lra.
    + apply bpow_le. lia.
Qed.
(* Inputs may stand for numbers that were computed before. *)
Section Filled.
Variable at_ : input -> number.
Hypothesis same : forall i, is_finite (given_ i) = true -> nearest (at_ i) = Number (B2R (given_ i)).
Definition is_right e := forall x, run e = Some x -> nearest (filled at_ e) = Number (B2R x) /\ is_finite x = true.
Theorem run_is_right : (forall e, is_right e) /\ (forall m b, holds m = Some b -> is_said (filled_mask at_ m) = b).
Proof.
  assert (op_is : forall (op : binary -> binary -> binary) opR a b, (forall x y, is_finite x = true ->
    is_finite y = true -> is_finite (op x y) = true -> B2R (op x y) = near (opR (B2R x) (B2R y))) ->
    is_right a -> is_right b -> forall out, both op (run a) (run b) = Some out -> exists x y,
    nearest (filled at_ a) = Number x /\ nearest (filled at_ b) = Number y /\
    settled (near (opR x y)) = Number (B2R out) /\ is_finite out = true).
  { intros op opR a b E ra rb out h. unfold Nearest.both, Nearest.finite in h.
    destruct (run a) as [x|] eqn:Ex; [|discriminate]. destruct (run b) as [y|] eqn:Ey; [|discriminate].
    destruct (is_finite (op x y)) eqn:fin; [|discriminate]. injection h as <-.
    destruct (ra x Ex) as [va fx], (rb y Ey) as [vb fy]. exists (B2R x), (B2R y).
    split; [exact va|]. split; [exact vb|]. split; [apply of_settled, E; assumption|exact fin]. }
  apply numbers_and_masks; unfold is_right; cbn [run holds filled filled_mask nearest is_said].
  - intros i x h. unfold Nearest.finite in h. destruct (is_finite (given_ i)) eqn:fin; [|discriminate].
    injection h as <-. auto.
  - intros c x h. pose proof facts. pose proof (Corners.enough_underflow f fine) as A.
    pose proof (Corners.small_underflow f fine) as B. pose proof (Corners.extents f fine) as C.
    change (extent_ - prec >= 3 - emax - prec + prec - 1 + 2)%Z in A. change (extent_ <= 0)%Z in B.
    change (0 <= reach_ <= largest_)%Z in C.
    pose proof (Corners.safe f fine) as D.
    pose proof (Corners.vanishing f fine) as E_. pose proof (edges f ok) as F.
    change (3 - emax - prec + prec - 1 + 2 + prec <= safe_ <= 0)%Z in D.
    change (3 - emax - prec + prec - 1 + 2 <= 2 * vanishing_ <= 0)%Z in E_. change (0 <= largest_)%Z in F.
    pose proof (room f ok) as G_. change (3 * largest_ + 38 <= emax)%Z in G_.
    destruct c as [| | | | |n| | |]; cbn [constant_number constant_value] in h |- *; try injection h as <-.
    1, 2, 3, 4, 7, 8, 9: match goal with |- context [power_of_two ?e] => destruct (exact_power e) as [-> fin]; [lia|];
      auto end.
    + destruct (exact_power (-1)) as [-> fin]; [lia|]. split; [reflexivity|exact fin].
    + destruct (_ && _)%bool eqn:range; [|discriminate]. injection h as <-. apply andb_prop in range as [lo hi].
      apply Z.leb_le in lo. apply Z.ltb_lt in hi. destruct (whole_is n 0) as [E fin]; [lia|lia|].
      unfold whole in E, fin. rewrite E, fin. unfold F2R; cbn [Fnum Fexp bpow]. now rewrite Rmult_1_r.
  - intros a ra b rb out h. destruct (op_is (Bplus mode_NE) Rplus a b) with (out := out) as (x & y & va & vb & E & fin);
      auto; [|rewrite va, vb; cbn [added multiplied]; rewrite E; auto]. intros u v fu fv fin. pose proof
        (Bplus_correct prec emax _ _ mode_NE u v fu fv) as c.
    destruct (Rlt_bool _ _); [apply c|]. destruct c as [c _]. destruct (Bplus mode_NE u v); discriminate.
  - intros a ra b rb out h. destruct (op_is (Bminus mode_NE) Rminus a b) with (out := out) as (x & y & va & vb & E &
    fin);
      auto; [|rewrite va, vb; cbn [added multiplied]; rewrite E; auto]. intros u v fu fv fin. pose proof
        (Bminus_correct prec emax _ _ mode_NE u v fu fv) as c.
    destruct (Rlt_bool _ _); [apply c|]. destruct c as [c _]. destruct (Bminus mode_NE u v); discriminate.
  - intros a ra b rb out h. destruct (op_is (Bmult mode_NE) Rmult a b) with (out := out) as (x & y & va & vb & E & fin);
      auto; [|rewrite va, vb; cbn [added multiplied]; rewrite E; auto]. intros u v fu fv fin. pose proof
        (Bmult_correct prec emax _ _ mode_NE u v) as c.
    destruct (Rlt_bool _ _); [apply c|]. destruct (Bmult mode_NE u v); discriminate.
  - intros a ra b rb out h. destruct (run b) as [y|] eqn:Ey; [|discriminate].
    destruct (is_finite_strict y) eqn:strict; [|discriminate]. rewrite <- Ey in h.
    assert (nonzero : B2R y <> 0) by (destruct y; try discriminate; apply F2R_neq_0; cbn; destruct s; discriminate).
    unfold Nearest.both, Nearest.finite in h. rewrite Ey in h. destruct (run a) as [x|] eqn:Ex; [|discriminate].
    destruct (is_finite (Bdiv mode_NE x y)) eqn:fin; [|discriminate]. injection h as <-.
    destruct (ra x eq_refl) as [-> fx], (rb y eq_refl) as [-> fy]. cbn [divided].
    destruct (Req_EM_T (B2R y) 0) as [z|_]; [contradiction|]. split; [|exact fin]. apply of_settled.
    pose proof (Bdiv_correct prec emax _ _ mode_NE x y nonzero) as c. destruct (Rlt_bool _ _); [apply c|].
    destruct (Bdiv mode_NE x y); discriminate.
  - intros a ra out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. injection h as <-.
    destruct (ra x eq_refl) as [-> fx]. cbn. rewrite B2R_Bopp, is_finite_Bopp. auto.
  - intros a ra out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. injection h as <-.
    destruct (ra x eq_refl) as [-> fx]. cbn. rewrite B2R_Babs, is_finite_Babs. auto.
  - intros a ra b rb out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. destruct (run b) as [y|] eqn:Ey;
    [|discriminate].
    injection h as <-. destruct (ra x eq_refl) as [-> fx], (rb y eq_refl) as [-> fy]. cbn [is_greater].
    rewrite (less x y fx fy). destruct (Rlt_dec (B2R x) (B2R y)); auto.
  - intros a ra b rb out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. destruct (run b) as [y|] eqn:Ey;
    [|discriminate].
    injection h as <-. destruct (ra x eq_refl) as [-> fx], (rb y eq_refl) as [-> fy]. cbn [is_greater].
    rewrite (less y x fy fx). destruct (Rlt_dec (B2R y) (B2R x)); auto.
  - intros m rm a ra b rb out h. destruct (holds m) as [[|]|]; [| |discriminate]; rewrite (rm _ eq_refl); auto.
  - intros a ra out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. destruct (ra x eq_refl) as [-> fx].
    destruct (Bltb x (B754_zero false)) eqn:less_; [discriminate|].
    rewrite (less x (B754_zero false) fx eq_refl) in less_. cbn [B2R] in less_.
    destruct (Rlt_dec (B2R x) 0) as [|positive]; [discriminate|]. cbn [rooted]. destruct (Rlt_dec (B2R x) 0); [lra|]. unfold
      Nearest.finite in h.
    destruct (is_finite (Bsqrt mode_NE x)) eqn:finite_; [|discriminate]. injection h as <-.
    split; [|exact finite_]. apply of_settled. apply (Bsqrt_correct prec emax _ _ mode_NE x).
  - intros b h. injection h as <-. reflexivity.
  - intros a ra b rb out h. destruct (run a) as [x|] eqn:Ex; [|discriminate]. destruct (run b) as [y|] eqn:Ey;
    [|discriminate].
    injection h as <-. destruct (ra x eq_refl) as [-> fx], (rb y eq_refl) as [-> fy]. cbn [is_greater].
    now rewrite (less y x fy fx).
  - intros a ra b rb out h. destruct (holds a) as [[|]|]; [| |discriminate]; rewrite (ra _ eq_refl).
    + exact (rb _ h).
    + now injection h as <-.
  - intros a ra b rb out h. destruct (holds a) as [[|]|]; [| |discriminate]; rewrite (ra _ eq_refl).
    + now injection h as <-.
    + exact (rb _ h).
  - intros a ra out h. destruct (holds a) as [x|]; [|discriminate]. injection h as <-. now rewrite (ra _ eq_refl).
Qed.
End Filled.
Hypothesis given_is : forall i, given i = B2R (given_ i).
Theorem run_is_nearest : (forall e x, run e = Some x -> nearest e = Number (B2R x) /\ is_finite x = true) /\
  (forall m b, holds m = Some b -> is_said m = b).
Proof.
  destruct (run_is_right Input (fun i _ => f_equal Number (given_is i))) as [numbers masks].
  destruct filled_with_itself as [whole_number whole_mask]. split.
  - intros e x h. pose proof (numbers e x h) as right_. now rewrite whole_number in right_.
  - intros m b h. pose proof (masks m b h) as right_. now rewrite whole_mask in right_.
Qed.
Theorem what_holds_is_said m : holds m = Some true -> says f env nearest m.
Proof. intro h. apply said. exact (proj2 run_is_nearest m true h). Qed.
End Chains.

(* Two pairs, in halves of a unit: one set falls from 2 to a height above the other or below it, which rests. Directions
   point upwards; the moments are the ends of the step. *)
Section Places.
Variable height : Z.
Definition falling t := match t with Expressions.Start => 4 | Expressions.End => height end%Z.
Definition place_of_a_vertex_and_a_face n t a := match n, a with
  | 0%nat, Expressions.Z_ => falling t | 0%nat, _ => 2
  | 2%nat, Expressions.X | 3%nat, Expressions.Y => 8 | _, _ => 0 end%Z.
Definition place_of_two_edges n t a := match n, a with
  | 0%nat, Expressions.X => -4 | 1%nat, Expressions.X => 4
  | 0%nat, Expressions.Z_ | 1%nat, Expressions.Z_ => falling t
  | 2%nat, Expressions.Y => -4 | 3%nat, Expressions.Y => 4 | _, _ => 0 end%Z.
Definition halves (place_ : nat -> Expressions.time -> Expressions.axis -> Z) i := match i with
  | Place (Expressions.Coordinate n t a) => place_ n t a
  | Along _ Expressions.Z_ | Moment 1 => 2
  | _ => 0 end%Z.
Definition is_small place_ := forall i, (Z.abs (halves place_ i) < 256)%Z.
Hypothesis small_height : (Z.abs height < 256)%Z.
Lemma small_vertex_and_face : is_small place_of_a_vertex_and_a_face.
Proof. intros [l|[[|[|[|[|n]]]] [|] [| |]]|k [| |]|[|[|n]]|k]; try exact small_height; reflexivity. Qed.
Lemma small_edges : is_small place_of_two_edges.
Proof. intros [l|[[|[|[|[|n]]]] [|] [| |]]|k [| |]|[|[|n]]|k]; try exact small_height; reflexivity. Qed.
End Places.

(* An execution of a pair in range, with short directions, from moment 0 to moment 1, the ends of the step. *)
Definition computes code (f : constants) env place given value_of :=
  Advancing.computed f env place given value_of code /\
  (forall k, Advancing.is_direction f given k) /\ (forall n, Advancing.is_moment given n) /\
  given (Moment 0) = 0 /\ given (Moment 1) = 1.
(* All proofs of a round hold for a pair in one execution, each until the end of the step. *)
Definition every_proof_holds code (f : constants) := exists env place given value_of,
  computes code f env place given value_of /\
  says f env value_of (Greater (Input (Moment 1)) (Input (Moment 0))) /\
  says f env value_of (Advancing.by_held code) /\
  (exists u, value_of (Advancing.until_held code) = Number u /\ 1 < u) /\
  says f env value_of (Advancing.by_turning code) /\ says f env value_of (Advancing.by_curving code) /\
  says f env value_of (Advancing.by_volume_throughout code) /\
  says f env value_of (Advancing.by_volume_to_the_end code).
(* Clipping gives a later time. *)
Definition clipping_advances code (f : constants) := exists env place given value_of,
  computes code f env place given value_of /\
  exists u, value_of (Advancing.until_volume code) = Number u /\ 0 < u.

Section OfAPair.
Load "Format.section".
Hypothesis fine : Corners.reasonable_constants f.
Variable place_ : nat -> Expressions.time -> Expressions.axis -> Z.
Hypothesis small : is_small place_.
Variable code : Advancing.proofs.
Notation input_ := (fun i => whole prec emax p0 pe (halves place_ i) (-1)).
Definition is_true m := match in_format holds p0 pe input_ m with
  Some b => b | None => false
  end.
Definition is_beyond n e := is_true (Greater e (Constant (Small n))) &&
  match in_format run p0 pe input_ e with Some _ => true | None =>
    false end.
Lemma input_is i : B2R (input_ i) = IZR (halves place_ i) / 2 /\ is_finite (input_ i) = true.
Proof.
  destruct (in_format whole_is p0 pe fine (halves place_ i) (-1))
    as [E fin];
    [apply small|lia|]. split; [|exact fin]. rewrite E. unfold F2R; cbn [Fnum Fexp bpow radix_val radix2]. cbn. lra.
Qed.
Notation given := (fun i => B2R (input_ i)).
Notation env_ := (in_format env fine).
Notation nearest_ := (in_format nearest fine given).
Lemma what_is_computed : is_true (Advancing.is_in_range code) = true ->
  computes code f env_ (fun c => given (Place c)) given nearest_ /\ (forall m, is_true m = true -> says f env_ nearest_ m) /\
  (forall n e, is_beyond n e = true -> exists u, nearest_ e = Number u /\ IZR n < u).
Proof.
  intro range. assert (E : execution f env_ nearest_ given) by (apply an_execution_exists; assumption).
  pose proof (in_format run_is_nearest p0 pe fine given input_
    (fun i => eq_refl)) as [numbers _].
  assert (truth : forall m, is_true m = true -> says f env_ nearest_ m).
  { intros m h. apply (in_format what_holds_is_said p0 pe fine
    given input_ (fun i => eq_refl)). unfold is_true in h. destruct (holds _ _ _ _ _ _ _ _ _) as [[|]|]; congruence. }
  assert (value_ : forall i, given i = IZR (halves place_ i) / 2) by (intro i; apply input_is).
  split; [|split; [exact truth|]].
  - split; [split; [intro; reflexivity|split; [exact E|apply truth; assumption]]|].
    assert (G4 : 4 <= Errors.reach f) by (apply (Corners.G_4 f fine)).
    split; [intros k a; apply Rle_trans with 4; [rewrite value_; destruct a; cbn; unfold Rabs; destruct (Rcase_abs _);
      lra|exact G4]|].
    split; [intros [|[|n]]; unfold Advancing.is_moment; rewrite value_; cbn; lra|].
    split; rewrite value_; cbn; lra.
  - intros n e h. apply andb_prop in h as [h number_]. apply truth in h.
    destruct (run _ _ _ _ _ _ _ _ _) as [u|] eqn:Eu; [|discriminate]. destruct (numbers _ u Eu) as [Vu _].
    change (nearest_ e = Number (B2R u)) in Vu. exists (B2R u). split; [exact Vu|].
    cbn [says] in h. rewrite Vu in h. exact h.
Qed.
Definition every_proof := is_true (Advancing.is_in_range code) &&
  is_true (Greater (Input (Moment 1)) (Input (Moment 0))) && is_true (Advancing.by_held code) &&
  is_beyond 1 (Advancing.until_held code) && is_true (Advancing.by_turning code) &&
  is_true (Advancing.by_curving code) && is_true (Advancing.by_volume_throughout code) &&
  is_true (Advancing.by_volume_to_the_end code).
Theorem every_proof_holds_if_computed : every_proof = true -> every_proof_holds code f.
Proof.
  unfold every_proof. intro all. repeat (apply andb_prop in all as [all ?]).
  destruct (what_is_computed all) as (c & truth & numbers).
  exists env_, (fun c => given (Place c)), given, nearest_. auto 12.
Qed.
End OfAPair.

(* From such a pair a chain reaches the end of the step. *)
Theorem a_chain_exists code f : Corners.reasonable_constants f -> every_proof_holds code f ->
  exists place, Advancing.reaches code place 0 1.
Proof.
  intros fine (env_ & place & given & value_of & (computed_ & short & moments & m0 & m1) & later & held & (u & Eu & u1)
    & _).
  exists place. apply Advancing.RoundedDown with u; [|lra]. apply Advancing.First with f env_; [exact fine|].
  rewrite <- m0. apply (Advancing.Held code place f env_ given value_of u); auto.
Qed.
Lemma single_is_fine : Corners.reasonable_constants Advance.binary32.
Proof. constructor; [exact Witnesses.single_is_reasonable| | | | | | |]; cbn; lia. Qed.
Lemma double_is_fine : Corners.reasonable_constants Advance.binary64.
Proof. constructor; [exact Witnesses.double_is_reasonable| | | | | | |]; cbn; lia. Qed.
Notation in_single theorem := (theorem 24 128 (-117) 30 (-100) 29 (-100) (-62) _ _ single_is_fine _)%Z.
Notation in_double theorem := (theorem 53 1024 (-1000) 250 (-960) 250 (-900) (-510) _ _ double_is_fine _)%Z.
Theorem every_proof_holds_for_some f : f = Advance.binary32 \/ f = Advance.binary64 ->
  every_proof_holds Advancing.of_a_vertex_and_a_face f /\ every_proof_holds Advancing.of_two_edges f.
Proof.
  intros [-> | ->]; split.
  - apply (in_single every_proof_holds_if_computed (small_vertex_and_face 2 eq_refl)); vm_cast_no_check (eq_refl true).
  - apply (in_single every_proof_holds_if_computed (small_edges 2 eq_refl)); vm_cast_no_check (eq_refl true).
  - apply (in_double every_proof_holds_if_computed (small_vertex_and_face 2 eq_refl)); vm_cast_no_check (eq_refl true).
  - apply (in_double every_proof_holds_if_computed (small_edges 2 eq_refl)); vm_cast_no_check (eq_refl true).
Qed.
