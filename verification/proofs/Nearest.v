(* Executions exist: rounding to nearest is one for any coordinates, and where nothing overflows Flocq's own binary
   numbers compute it. So Coq can run the traced code, and what it culls shows that the theorems are about something. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core BinarySingleNaN.
From Selvedge Require Import Arithmetic Expressions.
Open Scope R_scope.

Section Nearest.
Context {component : Type}.
Notation expr := (expr_of component).
Notation mask := (mask_of component).

Implicit Types m : mask.
Variables prec emax : Z.
Context (prec_gt_0_ : Prec_gt_0 prec) (prec_lt_emax_ : Prec_lt_emax prec emax).
Variables underflow_ largest_ : Z.
Definition format_of := Format prec (3 - emax - prec) emax underflow_ largest_.
Notation f := format_of.
Hypothesis ok : reasonable f.
Lemma facts : (24 <= prec /\ prec < emax /\ 2 - emax <= -60 /\ 2 - emax + 9 <= underflow_ /\ underflow_ <= -60 /\
  2 - emax + 40 <= - prec /\
  0 <= largest_ /\ 3 * largest_ + 38 <= emax)%Z.
Proof.
  destruct ok as [a b c d e g h]. unfold format_of in *. cbn [precision least_exponent greatest_exponent underflow
    largest_edge] in *.
  assert (prec < emax)%Z by exact prec_lt_emax_. lia.
Qed.
Notation number := (binary_float prec emax).
Notation fexp := (FLT_exp (3 - emax - prec) prec).
Definition to_nearest z := round radix2 fexp (round_mode mode_NE) z.
Lemma nearest_rounds z : rounds f z (to_nearest z).
Proof. right. exists (round_mode mode_NE). split; [apply valid_rnd_round_mode|reflexivity]. Qed.

(* An execution in real numbers, for any coordinates. *)
Variables from to : component -> R.
Definition settled r := if Rle_dec (Rabs r) (omega f) then Number r else Infinite (if Rlt_dec 0 r then true else false).
Definition lifted (op : R -> R -> R) v w := match v, w with Number x, Number y => settled (to_nearest (op x y)) | _,
  _ => NaN end.
Definition is_below v w : bool := match v, w with
  | NaN, _ | _, NaN => false
  | Number x, Number y => if Rle_dec x y then true else false
  | Infinite false, _ | _, Infinite true => true
  | _, _ => false end.
Fixpoint nearest (e : expr) : value := match e with
  | Difference c => lifted Rminus (Number (to c)) (Number (from c))
  | Constant c => Number (constant_value f c)
  | Sum a b => lifted Rplus (nearest a) (nearest b)
  | Minus a b => lifted Rminus (nearest a) (nearest b)
  | Product a b => lifted Rmult (nearest a) (nearest b)
  | Negative a => negative (nearest a)
  | Magnitude a => magnitude (nearest a)
  | Larger a b => if is_below (nearest b) (nearest a) then nearest a else nearest b
  | Smaller a b => if is_below (nearest a) (nearest b) then nearest a else nearest b end.

Lemma settled_result z : result f z (settled (to_nearest z)).
Proof.
  exists (to_nearest z). split; [apply nearest_rounds|]. unfold settled. destruct (Rle_dec _ _) as [le|gt]; [left;
    auto|right].
  apply Rnot_le_lt in gt. assert (0 < omega f).
  { unfold omega, power. apply Rlt_Rminus, bpow_lt. cbn; pose proof facts; lia. }
  destruct (Rlt_dec 0 (to_nearest z)) as [p|n].
  - left. rewrite Rabs_pos_eq in gt by lra. auto.
  - right. rewrite Rabs_left1 in gt by lra. split; [lra|auto].
Qed.
Lemma lifted_operation op v w : operation f op v w (lifted op v w).
Proof.
  intros x y -> ->. exists x, y. split; [now left|]. split; [now left|]. apply settled_result.
Qed.
Lemma is_below_spec v w : v <> NaN -> w <> NaN -> if is_below v w then below v w else below w v.
Proof. destruct v as [x|[|]|], w as [y|[|]|]; cbn; try congruence; auto. intros _ _. destruct (Rle_dec x y); lra. Qed.
Theorem an_execution_exists : execution f from to nearest.
Proof.
  intros [c|c|a b|a b|a b|a|a|a b|a b]; cbn [nearest]; try apply lifted_operation; try reflexivity.
  - intros nv nw. exists (nearest a), (nearest b). split; [now left|]. split; [now left|].
    pose proof (is_below_spec _ _ nw nv) as s. destruct (is_below _ _); [left|right]; split; auto; now left.
  - intros nv nw. exists (nearest a), (nearest b). split; [now left|]. split; [now left|].
    pose proof (is_below_spec _ _ nv nw) as s. destruct (is_below _ _); [left|right]; split; auto; now left.
Qed.

(* An execution in binary numbers, as long as all are finite. *)
Variables from_ to_ : component -> number.
Hypothesis same_from : forall c, from c = B2R (from_ c).
Hypothesis same_to : forall c, to c = B2R (to_ c).
Hypothesis finite_from : forall c, is_finite (from_ c) = true.
Hypothesis finite_to : forall c, is_finite (to_ c) = true.
Definition finite (x : number) := if is_finite x then Some x else None.
Definition both (op : number -> number -> number) x y := match x, y with Some x, Some y => finite (op x y) | _,
  _ => None end.
Definition power_of_two e := binary_normalize prec emax _ _ mode_NE 1 e false.
Definition constant_number c := match c with
  | UnitRoundoff => Some (power_of_two (- prec))
  | Underflow => Some (power_of_two underflow_)
  | LargestEdge => Some (power_of_two largest_)
  | Half => Some (power_of_two (-1))
  | Small n => if ((0 <=? n) && (n <? 256))%Z then Some (binary_normalize prec emax _ _ mode_NE n 0 false) else None
    end.
Fixpoint run (e : expr) : option number := match e with
  | Difference c => finite (Bminus mode_NE (to_ c) (from_ c))
  | Constant c => constant_number c
  | Sum a b => both (Bplus mode_NE) (run a) (run b)
  | Minus a b => both (Bminus mode_NE) (run a) (run b)
  | Product a b => both (Bmult mode_NE) (run a) (run b)
  | Negative a => option_map (@Bopp prec emax) (run a)
  | Magnitude a => option_map (@Babs prec emax) (run a)
  | Larger a b => match run a, run b with Some x, Some y => Some (if Bltb x y then y else x) | _, _ => None end
  | Smaller a b => match run a, run b with Some x, Some y => Some (if Bltb y x then y else x) | _, _ => None end end.
Fixpoint holds (m : mask) : bool := match m with
  | Greater a b => match run a, run b with Some x, Some y => Bltb y x | _, _ => false end
  | Both a b => holds a && holds b
  | Either a b => holds a || holds b
  | Finite => true end.

Lemma finite_is_small (x : number) : Rabs (B2R x) <= omega f.
Proof. exact (abs_B2R_le_emax_minus_prec prec emax _ x). Qed.
Lemma of_settled z (x : number) : is_finite x = true -> B2R x = to_nearest z -> settled (to_nearest z) = Number (B2R x).
Proof. intros _ E. unfold settled. rewrite <- E. destruct (Rle_dec _ _) as [|n]; [reflexivity|]. destruct n.
  apply finite_is_small. Qed.
Lemma sum_is z (x y out : number) s (test : bool) :
  (if test then B2R out = to_nearest z /\ is_finite out = true /\ s else B2SF out = binary_overflow prec emax mode_NE
    (Bsign x) /\ Bsign x = Bsign y) ->
  is_finite out = true -> B2R out = to_nearest z.
Proof. destruct test; [tauto|]. intros [E _] fin. exfalso. destruct out; cbn in E, fin; discriminate. Qed.
Lemma exact_constant n e : representable f (F2R (Float radix2 n e)) -> Rabs (F2R (Float radix2 n e)) < bpow radix2 emax
  ->
  let x := binary_normalize prec emax _ _ mode_NE n e false in B2R x = F2R (Float radix2 n e) /\ is_finite x = true.
Proof.
  intros rep small x. pose proof (binary_normalize_correct prec emax _ _ mode_NE n e false) as c. cbv zeta in c.
    fold x in c.
  change (SpecFloat.fexp prec emax) with fexp in c.
  rewrite (round_generic radix2 fexp (round_mode mode_NE) _ rep) in c.
  rewrite Rlt_bool_true in c by assumption. tauto.
Qed.
Lemma exact_power e : (3 - emax - prec + prec - 1 <= e < emax)%Z -> B2R (power_of_two e) = power e /\
  is_finite (power_of_two e) = true.
Proof.
  intro range. replace (power e) with (F2R (Float radix2 1 e)) by (unfold F2R, power; simpl; ring).
  apply exact_constant.
  - unfold F2R; simpl. rewrite Rmult_1_l. apply generic_format_bpow. change (Z.max (e + 1 - prec) (3 - emax - prec) <=
    e)%Z. assert (24 <= prec)%Z by (destruct ok; assumption). lia.
  - unfold F2R; simpl. rewrite Rmult_1_l, Rabs_pos_eq by apply bpow_ge_0. apply bpow_lt. lia.
Qed.
Lemma run_is_nearest (e : expr) : forall x, run e = Some x -> nearest e = Number (B2R x) /\ is_finite x = true.
Proof.
  assert (op_is : forall (op : number -> number -> number) opR x y, (is_finite x = true -> is_finite y = true -> forall
    out, finite (op x y) = Some out ->
      B2R out = to_nearest (opR (B2R x) (B2R y))) -> is_finite x = true -> is_finite y = true -> forall out,
        finite (op x y) = Some out ->
      lifted opR (Number (B2R x)) (Number (B2R y)) = Number (B2R out) /\ is_finite out = true).
  { intros op opR x y E fx fy out h. specialize (E fx fy out h). unfold finite in h.
    destruct (is_finite (op x y)) eqn:fin; [|discriminate].
    injection h as <-. cbn [lifted]. split; [apply of_settled; assumption|assumption]. }
  assert (plus : forall x y, is_finite x = true -> is_finite y = true -> forall out,
    finite (Bplus mode_NE x y) = Some out -> B2R out = to_nearest (B2R x + B2R y)).
  { intros x y fx fy out h. unfold finite in h. destruct (is_finite (Bplus mode_NE x y)) eqn:fin; [|discriminate].
    injection h as <-.
    pose proof (Bplus_correct prec emax _ _ mode_NE x y fx fy) as c. destruct (Rlt_bool _ _); [tauto|].
      destruct c as [c _].
    exfalso. destruct (Bplus mode_NE x y); cbn in c, fin; discriminate. }
  assert (minus_ : forall x y, is_finite x = true -> is_finite y = true -> forall out,
    finite (Bminus mode_NE x y) = Some out -> B2R out = to_nearest (B2R x - B2R y)).
  { intros x y fx fy out h. unfold finite in h. destruct (is_finite (Bminus mode_NE x y)) eqn:fin; [|discriminate].
    injection h as <-.
    pose proof (Bminus_correct prec emax _ _ mode_NE x y fx fy) as c. destruct (Rlt_bool _ _); [tauto|].
      destruct c as [c _].
    exfalso. destruct (Bminus mode_NE x y); cbn in c, fin; discriminate. }
  assert (mult : forall x y, is_finite x = true -> is_finite y = true -> forall out,
    finite (Bmult mode_NE x y) = Some out -> B2R out = to_nearest (B2R x * B2R y)).
  { intros x y fx fy out h. unfold finite in h. destruct (is_finite (Bmult mode_NE x y)) eqn:fin; [|discriminate].
    injection h as <-.
    pose proof (Bmult_correct prec emax _ _ mode_NE x y) as c. destruct (Rlt_bool _ _); [tauto|].
    exfalso. destruct (Bmult mode_NE x y); cbn in c, fin; discriminate. }
  assert (less : forall x y : number, is_finite x = true -> is_finite y = true -> Bltb x y = if Rlt_dec (B2R x) (B2R y)
    then true else false).
  { intros x y fx fy. rewrite (Bltb_correct _ _ x y fx fy). unfold Rlt_bool. destruct (Rcompare_spec (B2R x) (B2R y)),
    (Rlt_dec (B2R x) (B2R y)); try reflexivity; lra. }
  induction e as [c|c|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa b IHb|a IHa b IHb]; cbn [run nearest];
    intros out h;
    try (unfold both in h; destruct (run a) as [x|]; [|discriminate]; destruct (IHa x eq_refl) as [va fx]; rewrite va);
    try (destruct (run b) as [y|]; [|discriminate]; destruct (IHb y eq_refl) as [vb fy]; rewrite vb).
  - rewrite same_from, same_to. apply (op_is (Bminus mode_NE) Rminus); auto.
  - destruct c as [| | | |n]; cbn [constant_number] in h; try injection h as <-.
    + destruct (exact_power (- prec)) as [-> fin]; [pose proof facts; lia|]. now rewrite fin.
    + destruct (exact_power underflow_) as [-> fin]; [pose proof facts; lia|]. now rewrite fin.
    + destruct (exact_power largest_) as [-> fin]; [pose proof facts; lia|]. now rewrite fin.
    + destruct (exact_power (-1)) as [-> fin]; [pose proof facts; lia|]. rewrite fin. split; reflexivity.
    + destruct (_ && _)%bool eqn:range; [|discriminate]. injection h as <-. apply andb_prop in range as [lo hi].
      apply Z.leb_le in lo. apply Z.ltb_lt in hi.
      destruct (exact_constant n 0) as [E fin].
      * apply generic_format_FLT. exists (Float radix2 n 0); [reflexivity| |].
        -- cbn [Fnum]. assert (256 <= 2 ^ prec)%Z by (change 256%Z with (2 ^ 8)%Z; apply Z.pow_le_mono_r;
          pose proof facts; lia).
           change (radix_val radix2) with 2%Z. change (precision f) with prec. lia.
        -- change (3 - emax - prec <= 0)%Z. pose proof facts; lia.
      * unfold F2R; cbn [Fnum Fexp bpow]. rewrite Rmult_1_r, Rabs_pos_eq by (now apply IZR_le).
        apply Rlt_le_trans with (IZR 256); [now apply IZR_lt|]. change (IZR 256) with (bpow radix2 8). apply bpow_le.
          pose proof facts; lia.
      * rewrite E, fin. unfold F2R; cbn [Fnum Fexp bpow constant_value]. now rewrite Rmult_1_r.
  - apply (op_is (Bplus mode_NE) Rplus); auto.
  - apply (op_is (Bminus mode_NE) Rminus); auto.
  - apply (op_is (Bmult mode_NE) Rmult); auto.
  - injection h as <-. cbn. rewrite B2R_Bopp, is_finite_Bopp. auto.
  - injection h as <-. cbn. rewrite B2R_Babs, is_finite_Babs. auto.
  - injection h as <-. cbn [is_below]. rewrite (less x y fx fy). destruct (Rlt_dec (B2R x) (B2R y)),
    (Rle_dec (B2R y) (B2R x)); auto; lra.
  - injection h as <-. cbn [is_below]. rewrite (less y x fy fx). destruct (Rlt_dec (B2R y) (B2R x)),
    (Rle_dec (B2R x) (B2R y)); auto; lra.
Qed.
Theorem what_holds_is_said m : holds m = true -> says f nearest m.
Proof.
  induction m; cbn [holds says]; intro h.
  - destruct (run a) as [x|] eqn:ra; [|discriminate]. destruct (run b) as [y|] eqn:rb; [|discriminate].
    destruct (run_is_nearest _ _ ra) as [va fx]. destruct (run_is_nearest _ _ rb) as [vb fy].
    exists (nearest a), (nearest b). split; [now left|]. split; [now left|]. rewrite va, vb. cbn.
    rewrite (Bltb_correct _ _ y x fy fx) in h. revert h. case Rlt_bool_spec; [lra|discriminate].
  - apply andb_prop in h as [? ?]. auto.
  - apply orb_prop in h as [?|?]; auto.
  - exact I.
Qed.
End Nearest.
