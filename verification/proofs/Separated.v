(* The certified filter with a separation: a pair that it culls stays farther apart than the separation throughout the
   step. core/src/filter/certified.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Geometry Least Normals.
From Selvedge Require Expressions Errors Bounds Culling Decisions Permanent Magnitudes Filter Beyond Certificates Apart.
Open Scope R_scope.

(* The code's masks. *)
Definition outer kind := Product (Input (Length Separation)) (largest_normal kind).
Definition inner kind := Product (outer kind) (Constant (Small 3)).
Definition raised kind bound clearance := Sum (term_of kind bound) clearance.
Definition of_one_sign kind := Greater (term_of kind (Expressions.Larger Magnitudes.least (Expressions.Negative
  Magnitudes.greatest))) (raised kind Magnitudes.one_bound (inner kind)).
Definition within kind := Greater (Constant LargestEdge) (term_of kind Magnitudes.by_axis).
Definition above kind value bound clearance := Greater (term_of kind value) (raised kind bound (clearance kind)).
Definition below kind value bound clearance := Greater (Negative (raised kind bound (clearance kind)))
  (term_of kind value).
Definition all_four (compare : kind -> expr -> expr -> (kind -> Machine.number) -> mask) kind :=
  Both (Both (compare kind Filter.control_value_0 Filter.error_bound_0 outer)
    (compare kind Filter.control_value_1 Filter.error_bound_1 inner))
  (Both (compare kind Filter.control_value_2 Filter.error_bound_2 inner)
    (compare kind Filter.control_value_3 Filter.error_bound_3 outer)).
Definition alone kind := Both (of_one_sign kind) (within kind).
Definition by_permanent kind := Either (alone kind) (Both (Either (all_four above kind) (all_four below kind))
  (within kind)).
Theorem traced_decisions : Beyond.a_vertex_and_a_face.culled_by_permanent_alone = alone VertexFace /\
  Beyond.a_vertex_and_a_face.culled_by_permanent = by_permanent VertexFace /\
  Beyond.two_edges.culled_by_permanent_alone = alone EdgeEdge /\
  Beyond.two_edges.culled_by_permanent = by_permanent EdgeEdge.
Proof. repeat split; vm_compute; reflexivity. Qed.

(* The largest number is one of the format. *)
Lemma omega_is_fixed (f : constants) (fine : reasonable_constants f) (env : environment f) : rounded env (omega f) =
  omega f.
Proof.
  pose proof (reasonable_base f fine) as ok. pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine) as om. destruct (nearly env (omega f)) as [[tiny _]|[direction [v ->]]].
  - rewrite Rabs_pos_eq in tiny by lra. lra.
  - apply round_generic; [exact v|]. apply generic_format_FLT.
    exists (Float radix2 (2 ^ precision f - 1) (greatest_exponent f - precision f)).
    + unfold F2R, omega, power. cbn [Fnum Fexp]. rewrite minus_IZR. change (IZR (2 ^ precision f)) with (IZR (radix2 ^
        precision f)). rewrite IZR_Zpower by (destruct ok; lia).
      replace (greatest_exponent f) with (precision f + (greatest_exponent f - precision f))%Z at 1 by ring.
      rewrite bpow_plus. ring.
    + cbn [Fnum]. assert (0 < 2 ^ precision f)%Z by (apply Z.pow_pos_nonneg; destruct ok; lia).
      rewrite Z.abs_eq by lia. change (radix_val radix2) with 2%Z. lia.
    + cbn [Fexp]. destruct ok. lia.
Qed.
Section Separated.
Load "Setting.section".
Variable k : kind.
Notation L := (power (largest_edge f)).
Notation s := (given (Length Separation)).
(* A subnormal separation is raised to the smallest normal number. *)
Hypothesis normal_separation : l <= s.
Notation from := (from given k).
Notation to := (to given k).
Notation told_of := (told_of value_of k).
Notation val := (Errors.val told_of).
Notation D := (Culling.exactly from to).
Notation ran := (executed f env given value_of run k).
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).

(* A clearance that covers r, but for a few λ; or that is too large for any value. *)
Definition covers v r := v = Infinite true \/ exists x, v = Number x /\ 0 <= x /\ (r <= seen x + 5 * l \/ omega f <= x).
(* The product of a number with one that is positive. *)
Lemma product_covers x y out r : product f env (Number x) (Number y) out -> 0 <= x -> l <= y ->
  r <= (1 - e1) * (seen x * y) + 3.9 * l \/ omega f <= seen x * y -> covers out r.
Proof.
  intros h x0 yl cov. pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f).
  pose proof (l_small f ok). pose proof (omega_pos f fine) as om.
  unfold product in h. cbn in h. rewrite (seen_large f env y yl) in h. destruct (seen_low f env x x0) as [sx _].
  set (z := seen x * y) in *. assert (z0 : 0 <= z) by (apply Rmult_le_pos; lra).
  pose proof (rounded_positive f env z z0) as P. destruct h as [[small ->]|[[over [-> | ->]]|[neg _]]].
  - right. exists (Rd z). split; [reflexivity|]. split; [exact P|].
    destruct cov as [cov|over].
    + left. destruct (Rle_lt_dec l z) as [large|tiny].
      * pose proof (normal_error f fine env z large). destruct (Rle_lt_dec l (Rd z)).
        -- rewrite (seen_large f env (Rd z)) by lra. lra.
        -- destruct (seen_low f env (Rd z) P). lra.
      * destruct (seen_low f env (Rd z) P). assert ((1 - e1) * z <= 1 * z) by (apply Rmult_le_compat_r; lra). lra.
    + right. assert (l <= z) by lra. pose proof (monotone env _ _ over) as m.
      rewrite (omega_is_fixed f fine env) in m. exact m.
  - left. reflexivity.
  - right. exists (omega f). repeat split; lra.
  - lra.
Qed.

Section InRange.
Hypothesis in_range : forall c, exists x, told_of (Expressions.Difference c) = Expressions.Number x /\ Rabs x <=
  Errors.reach f.
Hypothesis small : forall c, Rabs (Bounds.computed told_of c) <= L.
Hypothesis M_L : val Magnitudes.by_axis <= L.
Notation number := (here Normals.number k in_range).

(* What a positive bound of the normal's length, times the separation, covers. *)
Definition are_clear n outer_ inner_ := 0 < n /\ (forall i, exact_squared given k i <= n ^ 2) /\
  exists ro ri, covers outer_ ro /\ covers inner_ ri /\ s * n <= (1 - e1) * ro /\ 3 * (s * n) <= (1 - e1) * ri.
Theorem clearances : (value_of (outer k) = Infinite true /\ value_of (inner k) = Infinite true) \/
  exists n, are_clear n (value_of (outer k)) (value_of (inner k)).
Proof.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine) as om.
  pose proof (run_product (Input (Length Separation)) (largest_normal k)) as h. rewrite (run (Input _)) in h.
  pose proof (run_product (outer k) (Constant (Small 3))) as g. rewrite (run (Constant _)) in g.
  cbn [constant_value] in g. fold (outer k) in h. fold (inner k) in g.
  destruct (here largest_normal_is_large k in_range small M_L) as [inf|(n & En & ln & all)].
  - left. rewrite inf in h. unfold product in h. cbn in h. rewrite (seen_large f env s) in h by lra.
    specialize (h ltac:(lra)). split; [exact h|]. rewrite h in g. unfold product in g. cbn in g.
    rewrite (seen_large f env 3) in g by lra. apply g. lra.
  - rewrite En in h. pose proof h as h0. apply (product_covers s n _ ((1 - e1) * (s * n))) in h; [|lra|exact ln|].
    2: { left. rewrite (seen_large f env s) by lra. lra. }
    assert (sn : 0 <= s * n) by (apply Rmult_le_pos; lra).
    assert (t : 0 <= e1 * (s * n) <= / 8388608 * (s * n)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
      lra]).
    assert (tt : 0 <= e1 * (e1 * (s * n)) <= / 8388608 * (e1 * (s * n))) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]).
    assert (ttt : 0 <= e1 * (e1 * (e1 * (s * n))) <= / 8388608 * (e1 * (e1 * (s * n)))) by (split; [apply Rmult_le_pos;
      lra|apply Rmult_le_compat_r; lra]).
    destruct h as [inf|(x & Ex & x0 & cov)].
    + left. split; [exact inf|]. rewrite inf in g. unfold product in g. cbn in g.
      rewrite (seen_large f env 3) in g by lra. apply g. lra.
    + right. exists ((1 - 3 * e1) * n). split; [apply Rmult_lt_0_compat; lra|]. split; [exact all|].
      exists ((1 - e1) * (s * n)), (3 * ((1 - e1) * ((1 - e1) * (s * n)))).
      split; [right; exists x; repeat split; auto|]. split; [|split; [lra|lra]].
      rewrite Ex in g. apply (product_covers x 3 _ _ g); [exact x0|lra|].
      destruct (seen_low f env x x0) as [sx0 sx].
      (* Only a subnormal product loses more than its rounding. *)
      assert (sharp : (1 - e1) * (s * n) <= seen x + 1.2 * l \/ omega f <= x).
      { unfold product in h0. cbn in h0. rewrite (seen_large f env s), (seen_large f env n) in h0 by lra.
        rewrite Ex in h0. destruct h0 as [[_ E]|[[over [E|E]]|[neg [E|E]]]]; try discriminate; injection E as ->.
        - left. destruct (Rle_lt_dec l (s * n)) as [large|tiny]; [|lra].
          pose proof (normal_error f fine env _ large). destruct (Rle_lt_dec l (Rd (s * n))) as [big|little].
          + rewrite (seen_large f env (Rd (s * n)) big). lra.
          + lra.
        - right. lra.
        - lra. }
      destruct sharp as [sharp|over].
      * left. assert ((1 - e1) * ((1 - e1) * (s * n)) <= (1 - e1) * (seen x + 1.2 * l)) by (apply Rmult_le_compat_l;
          lra).
        assert (0 <= e1 * l) by (apply Rmult_le_pos; lra). lra.
      * right. rewrite (seen_large f env x) by lra. lra.
Qed.

(* A bound to which a clearance is added. *)
Notation is_near := (Permanent.is_near f from to told_of).
Lemma value_small e : Expressions.fits e = true -> Rabs (val e) <= omega f.
Proof.
  intro fit. destruct (Errors.sizes f ok from to told_of ran in_range e fit) as (x & E & b & _).
  unfold Errors.val. rewrite E. eapply Rle_trans; [exact b|].
  assert (fit' := fit). destruct e; cbn [Expressions.fits] in fit'; apply andb_prop in fit' as [h _];
    apply andb_prop in h as [le_ deg_]; apply Z.leb_le in le_; apply Nat.leb_le in deg_;
    apply (Errors.fits_bound f ok _ _ (Z.le_refl _)); assumption.
Qed.
Lemma raised_value bound c r : Expressions.fits bound = true -> 490 * l <= val bound -> covers (value_of c) r ->
  value_of (raised k bound c) = Infinite true \/ exists b, value_of (raised k bound c) = Number b /\
  representable f b /\ l <= b /\ ((1 - e1) * (val bound + r - 5 * l) <= b \/ omega f <= b).
Proof.
  intros fit big cov. pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine) as om.
  pose proof (run_sum (term_of k bound) c) as h. fold (raised k bound c) in h. rewrite (number _ fit) in h.
  destruct cov as [inf|(x & Ex & x0 & cov)]; unfold sum in h.
  - rewrite inf in h. cbn in h. left. exact h.
  - rewrite Ex in h. cbn in h. rewrite (seen_large f env (val bound)) in h by lra.
    destruct (seen_low f env x x0) as [sx0 sx]. set (z := val bound + seen x) in *.
    assert (lz : l <= z) by (unfold z; lra). pose proof (normal_error f fine env z lz) as [n1 n2].
    assert (ez : e1 * z <= / 8388608 * z) by (apply Rmult_le_compat_r; lra).
    destruct h as [[_ E]|[[over [E|E]]|[neg _]]].
    + right. exists (Rd z). split; [exact E|]. split; [exact (result_is_representable f ok _ _ (nearly env z))|].
      split; [unfold z in *; lra|]. destruct cov as [cov|over].
      * left. assert ((1 - e1) * (val bound + r - 5 * l) <= (1 - e1) * z) by (apply Rmult_le_compat_l; unfold z; lra).
        lra.
      * right. (* The sum of the largest number and more. *)
        assert (oz : omega f <= z) by (unfold z; rewrite (seen_large f env x); lra). rewrite <- (omega_is_fixed f fine
          env). now apply (monotone env).
    + left. exact E.
    + right. exists (omega f). split; [exact E|]. split; [|split; [lra|right; lra]].
      rewrite <- (omega_is_fixed f fine env). exact (result_is_representable f ok _ _ (nearly env _)).
    + pose proof (rounded_positive f env z ltac:(lra)). lra.
Qed.
(* What a computed value past such a bound says of the exact one. *)
Definition is_raised_bound bound r b := representable f b /\ l <= b /\ ((1 - e1) * (val bound + r - 5 * l) <= b \/
  omega f <= b).
Lemma past_above value bound r b : Expressions.fits value = true -> is_near value (val bound) -> is_raised_bound bound r
  b -> b < val value -> (1 - e1) * r < Expressions.exact D value.
Proof.
  intros fv (big & z & rounded_ & near_) (rep & lb & low) g. pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (l_pos f). pose proof (value_small value fv) as vs. pose proof (Rle_abs (val value)).
  pose proof (above_before_rounding f ok _ _ _ rounded_ rep ltac:(lra) g) as bz. apply Rabs_le_inv in near_.
  assert (e1 * val bound <= / 8388608 * val bound) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * l) by (apply Rmult_le_pos; lra). destruct low as [low|over]; lra.
Qed.
Lemma past_below value bound r b : Expressions.fits value = true -> is_near value (val bound) -> is_raised_bound bound r
  b -> val value < - b -> Expressions.exact D value < - ((1 - e1) * r).
Proof.
  intros fv (big & z & rounded_ & near_) (rep & lb & low) g. pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (l_pos f). pose proof (value_small value fv) as vs. pose proof (Rle_abs (- val value)) as neg.
  rewrite Rabs_Ropp in neg. pose proof (below_before_rounding f ok _ _ _ rounded_ rep ltac:(lra) g) as bz.
  apply Rabs_le_inv in near_.
  assert (e1 * val bound <= / 8388608 * val bound) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * l) by (apply Rmult_le_pos; lra). destruct low as [low|over]; lra.
Qed.
Lemma above_bound value bound c r : Expressions.fits value = true -> Expressions.fits bound = true -> 490 * l <= val
  bound -> covers (value_of c) r -> says f env value_of (Greater (term_of k value) (raised k bound c)) ->
  exists b, is_raised_bound bound r b /\ b < val value.
Proof.
  intros fv fb big cov g. pose proof (l_pos f). cbn -[term raised] in g. rewrite (number value fv) in g.
  destruct (raised_value bound c r fb big cov) as [inf|(b & Eb & rep & lb & low)].
  - rewrite inf in g. cbn in g. tauto.
  - rewrite Eb in g. cbn in g. rewrite (seen_large f env b lb) in g.
    rewrite (seen_positive f env (val value)) in g by lra. exists b. split; [split; auto|exact g].
Qed.
Lemma below_bound value bound c r : Expressions.fits value = true -> Expressions.fits bound = true -> 490 * l <= val
  bound -> covers (value_of c) r -> says f env value_of (Greater (Negative (raised k bound c)) (term_of k value)) ->
  exists b, is_raised_bound bound r b /\ val value < - b.
Proof.
  intros fv fb big cov g. pose proof (l_pos f). cbn -[term raised] in g. rewrite (number value fv) in g.
  rewrite (run (Negative (raised k bound c))) in g.
  destruct (raised_value bound c r fb big cov) as [inf|(b & Eb & rep & lb & low)].
  - rewrite inf in g. cbn in g. tauto.
  - rewrite Eb in g. cbn in g. rewrite seen_opposite, (seen_large f env b lb) in g. exists b. split; [split; auto|].
    assert (neg : 0 < seen (- val value)) by (rewrite seen_opposite; lra).
    pose proof (seen_positive f env _ neg) as same. rewrite seen_opposite in same. lra.
Qed.
Lemma infinite_clearance c : value_of c = Infinite true -> covers (value_of c) 0.
Proof. intro h. left. exact h. Qed.
Lemma none_above value bound c : Expressions.fits value = true -> Expressions.fits bound = true -> value_of c = Infinite
  true -> ~ says f env value_of (Greater (term_of k value) (raised k bound c)) /\
  ~ says f env value_of (Greater (Negative (raised k bound c)) (term_of k value)).
Proof.
  intros fv fb inf. pose proof (run_sum (term_of k bound) c) as h. rewrite inf, (number bound fb) in h.
  unfold sum in h. cbn in h. cbn -[term raised]. unfold raised. rewrite (run (Negative _)), h, (number value fv).
  cbn. tauto.
Qed.

(* All control values are beyond the clearance, with one sign. *)
Definition beyond r sign := let x e := sign * Expressions.exact D e in
  r < x Filter.control_value_0 /\ 3 * r < x Filter.control_value_1 /\ 3 * r < x Filter.control_value_2 /\
  r < x Filter.control_value_3.
Definition are_beyond := exists n, 0 < n /\ (forall i, exact_squared given k i <= n ^ 2) /\
  (beyond (s * n) 1 \/ beyond (s * n) (-1)).
Notation K0 := Filter.control_value_0. Notation K1 := Filter.control_value_1.
Notation K2 := Filter.control_value_2. Notation K3 := Filter.control_value_3.
Notation E0 := Filter.error_bound_0. Notation E1 := Filter.error_bound_1.
Notation E2 := Filter.error_bound_2. Notation E3 := Filter.error_bound_3.
Notation O := Magnitudes.one_bound.
Lemma all_near : (is_near K0 (val E0) /\ is_near K1 (val E1) /\ is_near K2 (val E2) /\ is_near K3 (val E3)) /\
  is_near K0 (val O) /\ is_near K1 (val O) /\ is_near K2 (val O) /\ is_near K3 (val O).
Proof.
  destruct (Permanent.bound_0 f ok from to told_of ran in_range) as [_ b0].
  destruct (Permanent.bound_1 f ok from to told_of ran in_range) as [_ b1].
  destruct (Permanent.bound_2 f ok from to told_of ran in_range) as [_ b2].
  destruct (Permanent.bound_3 f ok from to told_of ran in_range) as [_ b3].
  destruct (Magnitudes.proven_by_one f ok from to told_of ran in_range) as ([_ o0] & [_ o1] & [_ o2] & [_ o3]).
  auto 10.
Qed.
Lemma four_above : says f env value_of (all_four above k) -> are_beyond.
Proof.
  intros [[g0 g1] [g2 g3]]. destruct clearances as [[io _]|(n & n0 & all & ro & ri & co & ci & po & pi)].
  - destruct (none_above K0 E0 (outer k) eq_refl eq_refl io) as [no _]. now destruct no.
  - destruct all_near as [(b0 & b1 & b2 & b3) _].
    exists n. split; [exact n0|]. split; [exact all|]. left. unfold beyond. rewrite !Rmult_1_l.
    destruct (above_bound K0 E0 _ ro eq_refl eq_refl (proj1 b0) co g0) as (c0 & r0 & p0).
    destruct (above_bound K1 E1 _ ri eq_refl eq_refl (proj1 b1) ci g1) as (c1 & r1 & p1).
    destruct (above_bound K2 E2 _ ri eq_refl eq_refl (proj1 b2) ci g2) as (c2 & r2 & p2).
    destruct (above_bound K3 E3 _ ro eq_refl eq_refl (proj1 b3) co g3) as (c3 & r3 & p3).
    pose proof (past_above K0 _ _ _ eq_refl b0 r0 p0). pose proof (past_above K1 _ _ _ eq_refl b1 r1 p1).
    pose proof (past_above K2 _ _ _ eq_refl b2 r2 p2). pose proof (past_above K3 _ _ _ eq_refl b3 r3 p3).
    repeat split; lra.
Qed.
Lemma four_below : says f env value_of (all_four below k) -> are_beyond.
Proof.
  intros [[g0 g1] [g2 g3]]. destruct clearances as [[io _]|(n & n0 & all & ro & ri & co & ci & po & pi)].
  - destruct (none_above K0 E0 (outer k) eq_refl eq_refl io) as [_ no]. now destruct no.
  - destruct all_near as [(b0 & b1 & b2 & b3) _].
    exists n. split; [exact n0|]. split; [exact all|]. right. unfold beyond.
    destruct (below_bound K0 E0 _ ro eq_refl eq_refl (proj1 b0) co g0) as (c0 & r0 & p0).
    destruct (below_bound K1 E1 _ ri eq_refl eq_refl (proj1 b1) ci g1) as (c1 & r1 & p1).
    destruct (below_bound K2 E2 _ ri eq_refl eq_refl (proj1 b2) ci g2) as (c2 & r2 & p2).
    destruct (below_bound K3 E3 _ ro eq_refl eq_refl (proj1 b3) co g3) as (c3 & r3 & p3).
    pose proof (past_below K0 _ _ _ eq_refl b0 r0 p0). pose proof (past_below K1 _ _ _ eq_refl b1 r1 p1).
    pose proof (past_below K2 _ _ _ eq_refl b2 r2 p2). pose proof (past_below K3 _ _ _ eq_refl b3 r3 p3).
    repeat split; lra.
Qed.
Lemma one_for_all : says f env value_of (of_one_sign k) -> are_beyond.
Proof.
  intro g. unfold of_one_sign in g. pose proof (l_pos f) as l0.
  destruct clearances as [[_ ii]|(n & n0 & all & ro & ri & co & ci & po & pi)].
  - destruct (none_above (Expressions.Larger Magnitudes.least (Expressions.Negative Magnitudes.greatest)) O (inner k)
      eq_refl eq_refl ii) as [no _]. now destruct no.
  - destruct all_near as [_ (b0 & b1 & b2 & b3)]. pose proof (e_pos f). pose proof (e_small f ok).
    assert (sn : 0 <= s * n) by (apply Rmult_le_pos; lra).
    exists n. split; [exact n0|]. split; [exact all|].
    destruct (above_bound (Expressions.Larger Magnitudes.least (Expressions.Negative Magnitudes.greatest)) O _ ri
      eq_refl eq_refl (proj1 b0) ci g) as (c & r & p).
    pose proof r as (_ & lc & _).
    pose proof (Culling.number f ok from to told_of ran in_range) as told_number.
    destruct (Magnitudes.larger_is_one f ok from to told_of ran in_range Magnitudes.least (Expressions.Negative
      Magnitudes.greatest) c eq_refl lc p) as [A|A]; [left|right]; unfold beyond.
    + pose proof (Decisions.smaller_both f ok from to told_of ran in_range) as S.
      destruct (S (Expressions.Smaller K0 K1) (Expressions.Smaller K2 K3) eq_refl ltac:(change (Expressions.Smaller
        (Expressions.Smaller _ _) _) with Magnitudes.least; lra)) as [u v].
      change (Expressions.Smaller (Expressions.Smaller _ _) _) with Magnitudes.least in u, v.
      destruct (S K0 K1 eq_refl ltac:(lra)) as [k0_ k1_]. destruct (S K2 K3 eq_refl ltac:(lra)) as [k2_ k3_].
      pose proof (past_above K0 _ _ _ eq_refl b0 r ltac:(lra)). pose proof (past_above K1 _ _ _ eq_refl b1 r
        ltac:(lra)).
      pose proof (past_above K2 _ _ _ eq_refl b2 r ltac:(lra)). pose proof (past_above K3 _ _ _ eq_refl b3 r
        ltac:(lra)).
      repeat split; lra.
    + rewrite (Magnitudes.negative_val f ok from to told_of ran in_range Magnitudes.greatest eq_refl) in A.
      pose proof (Decisions.larger_both f ok from to told_of ran in_range) as S.
      destruct (S (Expressions.Larger K0 K1) (Expressions.Larger K2 K3) eq_refl ltac:(change (Expressions.Larger
        (Expressions.Larger _ _) _) with Magnitudes.greatest; lra)) as [u v].
      change (Expressions.Larger (Expressions.Larger _ _) _) with Magnitudes.greatest in u, v.
      destruct (S K0 K1 eq_refl ltac:(lra)) as [k0_ k1_]. destruct (S K2 K3 eq_refl ltac:(lra)) as [k2_ k3_].
      pose proof (past_below K0 _ _ _ eq_refl b0 r ltac:(lra)). pose proof (past_below K1 _ _ _ eq_refl b1 r
        ltac:(lra)).
      pose proof (past_below K2 _ _ _ eq_refl b2 r ltac:(lra)). pose proof (past_below K3 _ _ _ eq_refl b3 r
        ltac:(lra)).
      repeat split; lra.
Qed.
End InRange.

(* The masks. *)
Lemma what_range_says : says f env value_of (within k) -> (forall c, exists x, told_of (Expressions.Difference c) =
  Expressions.Number x /\ Rabs x <= L) /\ val Magnitudes.by_axis <= L.
Proof.
  intro g. pose proof (told_greater f env _ _ g) as t.
  change (Expressions.greater f (told_of (Expressions.Constant Expressions.LargestEdge)) (told_of Magnitudes.by_axis))
    in t.
  assert (all : forall c, exists x, told_of (Expressions.Difference c) = Expressions.Number x /\ Rabs x <= L).
  { intro c. exact (Culling.range_of f ok from to told_of ran Magnitudes.by_axis c eq_refl
    (Magnitudes.all_occur_by_axis c) t). }
  split; [exact all|]. pose proof (L_1 f fine) as L1. pose proof (l_pos f). pose proof (l_small f ok).
  assert (in_range : forall c, exists x, told_of (Expressions.Difference c) = Expressions.Number x /\ Rabs x <=
    Errors.reach f).
  { intro c. destruct (all c) as (x & E & b). exists x. split; [exact E|]. unfold Errors.reach. lra. }
  cbn -[term] in g. rewrite (run (Constant _)), (here Normals.number k in_range
    Magnitudes.by_axis eq_refl) in g.
  cbn in g. rewrite (seen_large f env L) in g by lra. pose proof (seen_off f env (val Magnitudes.by_axis)) as off.
  unfold Machine.seen in g, off.
  destruct (flushes_operands env); [destruct (Rlt_dec (Rabs (val Magnitudes.by_axis)) l) as [tiny|]|]; try lra.
  pose proof (Rle_abs (val Magnitudes.by_axis)). lra.
Qed.
Theorem culled_are_beyond : says f env value_of (alone k) \/ says f env value_of (by_permanent k) -> are_beyond.
Proof.
  assert (ready : says f env value_of (within k) -> (forall c, exists x, told_of (Expressions.Difference c) =
    Expressions.Number x /\ Rabs x <= Errors.reach f) /\ (forall c, Rabs (Bounds.computed told_of c) <= L) /\ val
      Magnitudes.by_axis <= L).
  { intro g. destruct (what_range_says g) as [all ML]. pose proof (L_1 f fine). split; [|split; [|exact ML]].
    - intro c. destruct (all c) as (x & E & b). exists x. split; [exact E|]. unfold Errors.reach. lra.
    - intro c. destruct (all c) as (x & E & b). unfold Bounds.computed, Errors.val. rewrite E. exact b. }
  assert (first : says f env value_of (alone k) -> are_beyond).
  { intros [one_ in_]. destruct (ready in_) as (a & b & c). now apply one_for_all. }
  intros [h|[h|[signs in_]]]; [now apply first|now apply first|]. destruct (ready in_) as (a & b & c).
  destruct signs as [h|h]; [now apply four_above|now apply four_below].
Qed.
End Separated.

(* Geometry, in exact numbers. *)
Lemma far_from_a_plane n d K s N : 0 <= s -> 0 < N -> dot n d = K -> s * N < Rabs K -> dot n n <= N ^ 2 ->
  s ^ 2 < Certificates.length_squared d.
Proof.
  intros s0 N0 <- big small. unfold Certificates.length_squared.
  assert (schwarz : dot n d ^ 2 <= dot n n * dot d d).
  { unfold dot. pose proof (pow2_ge_0 (x n * y d - y n * x d)). pose proof (pow2_ge_0 (y n * z d - z n * y d)).
    pose proof (pow2_ge_0 (z n * x d - x n * z d)). lra. }
  assert (dd : 0 <= dot d d). { unfold dot. pose proof (Rle_0_sqr (x d)). pose proof (Rle_0_sqr (y d)).
    pose proof (Rle_0_sqr (z d)). unfold Rsqr in *. lra. }
  assert (sN : 0 <= s * N) by (apply Rmult_le_pos; lra).
  assert (less_ : (s * N) * (s * N) < Rabs (dot n d) * Rabs (dot n d)) by (apply Rmult_le_0_lt_compat; lra).
  rewrite <- Rabs_mult, Rabs_pos_eq in less_ by apply Rle_0_sqr.
  assert (dot n n * dot d d <= N ^ 2 * dot d d) by (apply Rmult_le_compat_r; lra).
  apply Rmult_lt_reg_l with (N ^ 2); [apply pow_lt; lra|]. lra.
Qed.
Lemma between_normals u v w N t : 0 <= t <= 1 -> dot u u <= N ^ 2 -> dot v v <= N ^ 2 -> dot w w <= N ^ 2 ->
  let n := plus (scaled ((1 - t) ^ 2) u) (plus (scaled (2 * (1 - t) * t) v) (scaled (t ^ 2) w)) in dot n n <= N ^ 2.
Proof.
  cbv zeta. intros t01 U V W. set (a := (1 - t) ^ 2). set (b := 2 * (1 - t) * t). set (c := t ^ 2).
  assert (a0 : 0 <= a) by (unfold a; apply pow_le; lra). assert (c0 : 0 <= c) by (unfold c; apply pow_le; lra).
  assert (b0 : 0 <= b) by (unfold b; repeat apply Rmult_le_pos; lra).
  assert (one_ : a + b + c = 1) by (unfold a, b, c; ring). clearbody a b c.
  assert (sq : forall p q, 0 <= dot (minus p q) (minus p q)).
  { intros p q. unfold dot, minus; cbn. pose proof (Rle_0_sqr (x p - x q)). pose proof (Rle_0_sqr (y p - y q)).
    pose proof (Rle_0_sqr (z p - z q)). unfold Rsqr in *. lra. }
  assert (E : dot (plus (scaled a u) (plus (scaled b v) (scaled c w))) (plus (scaled a u) (plus (scaled b v) (scaled c
    w))) = (a + b + c) * (a * dot u u + b * dot v v + c * dot w w) - a * b * dot (minus u v) (minus u v) - b * c * dot
      (minus v w) (minus v w) - a * c * dot (minus u w) (minus u w)) by (unfold dot, plus, scaled, minus; cbn; ring).
  rewrite E, one_, Rmult_1_l.
  assert (0 <= a * b * dot (minus u v) (minus u v)) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra|apply sq]).
  assert (0 <= b * c * dot (minus v w) (minus v w)) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra|apply sq]).
  assert (0 <= a * c * dot (minus u w) (minus u w)) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra|apply sq]).
  assert (a * dot u u <= a * N ^ 2) by (apply Rmult_le_compat_l; lra).
  assert (b * dot v v <= b * N ^ 2) by (apply Rmult_le_compat_l; lra).
  assert (c * dot w w <= c * N ^ 2) by (apply Rmult_le_compat_l; lra).
  replace (N ^ 2) with (a * N ^ 2 + b * N ^ 2 + c * N ^ 2) by (rewrite <- !Rmult_plus_distr_r, one_; ring). lra.
Qed.
Lemma cubic_beyond k0 k1 k2 k3 r t : 0 <= t <= 1 -> r < k0 -> 3 * r < k1 -> 3 * r < k2 -> r < k3 ->
  r < k0 * (1 - t) ^ 3 + k1 * (1 - t) ^ 2 * t + k2 * (1 - t) * t ^ 2 + k3 * t ^ 3.
Proof.
  intros t01 a b c d. pose proof (hull (k0 - r) (k1 - 3 * r) (k2 - 3 * r) (k3 - r) t ltac:(lra) ltac:(lra) ltac:(lra)
    ltac:(lra) t01) as h.
  replace ((k0 - r) * (1 - t) ^ 3 + (k1 - 3 * r) * (1 - t) ^ 2 * t + (k2 - 3 * r) * (1 - t) * t ^ 2 + (k3 - r) * t ^ 3)
    with (k0 * (1 - t) ^ 3 + k1 * (1 - t) ^ 2 * t + k2 * (1 - t) * t ^ 2 + k3 * t ^ 3 - r) in h by ring. lra.
Qed.

(* A pair that is beyond the clearance: a point of one set and one of the other, or of the lines through two edges. *)
Section OfAPair.
Variable given : input -> R.
Variable place : Expressions.coordinate -> R.
Hypothesis same : forall c, given (Place c) = place c.
Notation path := (Apart.path_of place).
Notation s := (given (Length Separation)).
Hypothesis s0 : 0 <= s.
Definition normal_at kind t := match kind with
  | VertexFace => cross (minus (at_ (path 2%nat) t) (at_ (path 1%nat) t)) (minus (at_ (path 3%nat) t) (at_ (path 1%nat)
      t))
  | EdgeEdge => cross (minus (at_ (path 1%nat) t) (at_ (path 0%nat) t)) (minus (at_ (path 3%nat) t) (at_ (path 2%nat)
      t)) end.
Definition volume_at kind t := match kind with
  | VertexFace => volume (at_ (path 1%nat) t) (at_ (path 2%nat) t) (at_ (path 3%nat) t) (at_ (path 0%nat) t)
  | EdgeEdge => volume (at_ (path 2%nat) t) (at_ (path 0%nat) t) (at_ (path 1%nat) t) (at_ (path 3%nat) t) end.
Lemma beyond_is_far kind t : are_beyond given kind -> 0 <= t <= 1 -> exists N, 0 < N /\ s * N < Rabs (volume_at kind t)
  /\ dot (normal_at kind t) (normal_at kind t) <= N ^ 2.
Proof.
  intros (n & n0 & all & signs) t01. exists n. split; [exact n0|].
  set (D := Culling.exactly (from given kind) (to given kind)) in *.
  assert (cubic : volume_at kind t = Expressions.exact D Filter.control_value_0 * (1 - t) ^ 3 + Expressions.exact D
    Filter.control_value_1 * (1 - t) ^ 2 * t + Expressions.exact D Filter.control_value_2 * (1 - t) * t ^ 2 +
      Expressions.exact D Filter.control_value_3 * t ^ 3).
  { unfold D, Culling.exactly, from, to. destruct kind; cbv -[Rplus Rminus Rmult Ropp IZR pow]; rewrite !same; ring. }
  split.
  - rewrite cubic. destruct signs as [(a & b & c & d)|(a & b & c & d)]; fold D in a, b, c, d.
    + rewrite !Rmult_1_l in *. pose proof (cubic_beyond _ _ _ _ _ t t01 a b c d) as h.
      eapply Rlt_le_trans; [exact h|apply Rle_abs].
    + pose proof (cubic_beyond _ _ _ _ _ t t01 a b c d) as h. rewrite <- Rabs_Ropp.
      eapply Rlt_le_trans; [exact h|]. eapply Rle_trans; [|apply Rle_abs]. lra.
  - set (point i := let e a := weight i * Expressions.exact D (normal kind i a) in Point (e Expressions.X) (e
      Expressions.Y) (e Expressions.Z_)).
    assert (small : forall i, dot (point i) (point i) <= n ^ 2).
    { intro i. eapply Rle_trans; [|exact (all i)]. unfold exact_squared, squared, sum3, dot, point. cbn. apply
      Rle_refl. }
    pose proof (between_normals (point Early) (point Middle) (point Late) n t t01 (small _) (small _) (small _)) as h.
    cbv zeta in h. replace (normal_at kind t) with (plus (scaled ((1 - t) ^ 2) (point Early)) (plus (scaled (2 * (1 - t)
      * t) (point Middle)) (scaled (t ^ 2) (point Late)))); [exact h|].
    unfold point, D, Culling.exactly, from, to. destruct kind;
      cbv -[Rplus Rminus Rmult Ropp IZR Rinv pow]; rewrite !same; f_equal; field.
Qed.
Theorem a_vertex_and_a_face_beyond t i j r : are_beyond given VertexFace -> 0 <= t <= 1 -> i + j + r = 1 ->
  s ^ 2 < Certificates.length_squared (minus (at_ (path 0%nat) t) (plus (scaled i (at_ (path 1%nat) t)) (plus (scaled j
    (at_ (path 2%nat) t)) (scaled r (at_ (path 3%nat) t))))).
Proof.
  intros far t01 one_. destruct (beyond_is_far VertexFace t far t01) as (N & N0 & big & small).
  apply (far_from_a_plane (normal_at VertexFace t) _ (volume_at VertexFace t) s N s0 N0); [|exact big|exact small].
  replace i with (1 - j - r) by lra. unfold normal_at, volume_at, volume, dot, cross, minus, plus, scaled. cbn -[at_].
  ring.
Qed.
Theorem two_edges_beyond t i r : are_beyond given EdgeEdge -> 0 <= t <= 1 ->
  s ^ 2 < Certificates.length_squared (minus (plus (scaled (1 - i) (at_ (path 0%nat) t)) (scaled i (at_ (path 1%nat)
    t))) (plus (scaled (1 - r) (at_ (path 2%nat) t)) (scaled r (at_ (path 3%nat) t)))).
Proof.
  intros far t01. destruct (beyond_is_far EdgeEdge t far t01) as (N & N0 & big & small).
  apply (far_from_a_plane (normal_at EdgeEdge t) _ (volume_at EdgeEdge t) s N s0 N0); [|exact big|exact small].
  unfold normal_at, volume_at, volume, dot, cross, minus, plus, scaled. cbn -[at_]. ring.
Qed.
End OfAPair.

(* A pair that the code culls: an execution of the traced terms in any environment. *)
Definition is_culled (f : constants) (code : mask) place separation := exists (env : environment f) given value_of,
  (forall c, given (Place c) = place c) /\ execution f env value_of given /\ given (Length Separation) = separation /\
  says f env value_of code.
Theorem a_culled_vertex_and_face_stay_apart f place s t i j r code : reasonable_constants f -> lam f <= s ->
  code = Beyond.a_vertex_and_a_face.culled_by_permanent_alone \/ code = Beyond.a_vertex_and_a_face.culled_by_permanent
    ->
  is_culled f code place s -> 0 <= t <= 1 -> i + j + r = 1 ->
  s ^ 2 < Certificates.length_squared (minus (at_ (Apart.path_of place 0) t) (plus (scaled i (at_ (Apart.path_of place
    1) t)) (plus (scaled j (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t))))).
Proof.
  destruct traced_decisions as (a & b & _ & _). intros fine ls which (env & given & value_of & places & run & <- & said)
    t01 one_. pose proof (lam_pos f). apply (a_vertex_and_a_face_beyond given place places ltac:(lra) t i j r); auto.
  apply (culled_are_beyond f fine env given value_of run VertexFace ls).
  rewrite a, b in which. destruct which as [-> | ->]; auto.
Qed.
Theorem culled_edges_stay_apart f place s t i r code : reasonable_constants f -> lam f <= s ->
  code = Beyond.two_edges.culled_by_permanent_alone \/ code = Beyond.two_edges.culled_by_permanent ->
  is_culled f code place s -> 0 <= t <= 1 ->
  s ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (Apart.path_of place 0) t)) (scaled i (at_ (Apart.path_of place 1) t)))
    (plus (scaled (1 - r) (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t)))).
Proof.
  destruct traced_decisions as (_ & _ & a & b). intros fine ls which (env & given & value_of & places & run & <- & said)
    t01. pose proof (lam_pos f). apply (two_edges_beyond given place places ltac:(lra) t i r); auto.
  apply (culled_are_beyond f fine env given value_of run EdgeEdge ls).
  rewrite a, b in which. destruct which as [-> | ->]; auto.
Qed.
