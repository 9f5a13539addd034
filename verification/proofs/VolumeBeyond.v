(* The volume with a separation: where its margins prove something, it exceeds the separation times the length of the
   normal, to the end of the step or up to the time that clipping gives. core/src/kernels/advance/volume.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Least Directions Held DirectionsBeyond Hull Volume
  Clipping VolumeSteps Lengths Bars.
From Selvedge Require Expressions Errors Bounds Certificates.
Import ListNotations.
Open Scope R_scope.

(* The code's terms. *)
Definition margins_beyond pairs t := let '(p, b, c) := corners_of pairs in let '(n0, n1, n2) := normals p b c t in
  let '(l0, l1, l2, l3) := raised (length_of n0) (length_of n1) (length_of n2) in
  let '(b0, b1, b2, b3) := values_from t (outer p b c Expressions.Start) (inner p b c Expressions.Start) (inner p b c
    Expressions.End) (outer p b c Expressions.End) in
  (margin b0 b0 (bar_of_length pairs l0), margin b0 b1 (bar_of_length pairs l1), margin b0 b2 (bar_of_length pairs l2),
    margin b0 b3 (bar_of_length pairs l3)).

Section VolumeBeyond.
Load "Setting.section".
Notation L := (power (largest_extent f)).
Notation v := (power (length_underflow f)).
Notation s := (given (Length Separation)).
Hypothesis separation : l <= s <= L.
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).
Notation run_constant := (run_constant f env given value_of run).
Notation run_input := (run_input f env given value_of run).
Notation number_if_small := (number_if_small f fine env).

Variable t : number.
Variable tau : R.
Notation T := (seen tau).
Hypothesis moment : value_of t = Number tau.
Hypothesis in_step : 0 <= T <= 1.
Variables pp pb pc : nat * nat.
Variable rest_ : list (nat * nat).
Notation pairs := (pp :: pb :: pc :: rest_).
Hypothesis in_range : says f env value_of (are_in_range pairs).
Notation M a := (Rd (m f env value_of pairs a + mu)).
Notation A := (area f env value_of pairs).
Notation PM := (permanent f env value_of pairs).
Notation Q := (more f env value_of pairs).
Notation normal i := (exact_normal given T pp pb pc i).
Notation vector_of i := (normal_vector t pp pb pc i).
Let time_ : seen_value f env (value_of t) = Number T := VolumeSteps.time_ f env value_of t tau moment.
Let inside : In pp pairs /\ In pb pairs /\ In pc pairs. Proof. cbn; tauto. Qed.

(* The lengths, raised to the third degree. *)
Definition length_ i := let '(l0, l1, l2, l3) := raised (length_of (vector_of 0)) (length_of (vector_of 1)) (length_of
  (vector_of 2)) in match i with 0%nat => l0 | 1%nat => l1 | 2%nat => l2 | _ => l3 end.
Definition exact_length i := let n k := norm (normal k) in match i with
  | 0%nat => n 0%nat | 1%nat => (n 0%nat + 2 * n 1%nat) / 3 | 2%nat => (2 * n 1%nat + n 2%nat) / 3 | _ => n 2%nat end.
Lemma sizes_ : 0 < A <= 0.19 * (G * G) /\ 0 < v <= 1 /\ 1000000 * l <= 0.5 * v /\ 4 <= G /\ 4 * G <= G * G /\
  1073741824 * (G * G) <= omega f /\ 0 <= l * A <= / 1099511627776 * (e1 * A) /\ 0 <= e1 * A <= / 8388608 * A /\
  0 <= e1 * v <= / 8388608 * v /\ 0 <= e1 * l <= / 8388608 * l.
Proof.
  pose proof (here area_bounds pairs in_range) as (a & _ & _ & la). pose proof (e_pos f).
  pose proof (e_small f ok). pose proof (vanishing_large f fine) as (v2 & v1 & vl & r0). pose proof (l_pos f).
  pose proof (G_4 f fine). pose proof (G_2 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  repeat split; try lra; try (apply Rmult_le_pos; lra); apply Rmult_le_compat_r; lra.
Qed.
Lemma twice_value e y : value_of e = Number y -> 0 <= seen y <= 2 * (G * G) -> exists x, value_of (Product two e) = Number x /\
  2 * seen y <= (1 + 1.1 * e1) * seen x + 2.1 * l /\ 0 <= seen x <= 2.001 * seen y + l.
Proof.
  intros E y0. pose proof sizes_ as (_ & _ & _ & G4 & GG & G2 & _). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (run_product two e) as h. unfold two in h at 1. rewrite run_constant, E in h. unfold product in h. cbn in h.
  rewrite (seen_large f env 2) in h by lra. apply number_if_small in h; [|rewrite Rabs_pos_eq; lra].
  eexists. split; [exact h|]. destruct (whole_of_result f fine env (2 * seen y) ltac:(lra)) as ((w & _) & low & high).
  set (x := seen (Rd (2 * seen y))) in *. assert (0 <= e1 * seen y <= / 8388608 * seen y) by (split; [apply
    Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  split; [|split; lra]. apply (Rmult_le_compat_l (1 + 1.1 * e1)) in low; [|lra].
  assert (0 <= e1 * (e1 * seen y) <= / 8388608 * (e1 * seen y)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (0 <= e1 * (e1 * l) <= / 8388608 * (e1 * l)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]). lra.
Qed.
Lemma third_of_sum e e' y y' : value_of e = Number y -> value_of e' = Number y' -> 0 <= seen y <= 4 * (G * G) ->
  0 <= seen y' <= 4 * (G * G) -> exists x, value_of (Product (Sum e e') third) = Number x /\
  (seen y + seen y') / 3 <= (1 + 3.4 * e1) * seen x + 2 * l /\ 0 <= seen x <= 1.001 * (seen y + seen y') / 3 + 3 * l.
Proof.
  intros E E' y0 y1. pose proof sizes_ as (_ & _ & _ & G4 & GG & G2 & _). pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_e f fine).
  destruct (here third_operand) as (c & Ec & dc & _). apply Rabs_le_inv in dc.
  unfold Bounds.q in dc. replace ((1 + e1) ^ 1 - 1) with e1 in dc by ring.
  pose proof (run_sum e e') as h. rewrite E, E' in h. unfold sum in h. cbn in h.
  apply number_if_small in h; [|rewrite Rabs_pos_eq; lra].
  set (z := seen y + seen y') in *. assert (z0 : 0 <= z <= 8 * (G * G)) by (unfold z; lra).
  destruct (whole_of_result f fine env z ltac:(lra)) as ((w & _) & low & high).
  assert (ez : 0 <= e1 * z <= / 8388608 * z) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (run_product (Sum e e') third) as h'. rewrite h in h'. unfold product in h'. rewrite Ec in h'. cbn in h'.
  set (y2 := seen (Rd z)) in *.
  assert (c01 : 0 <= y2 * c <= 0.334 * y2) by (split; [apply Rmult_le_pos; lra|rewrite Rmult_comm; apply
    Rmult_le_compat_r; lra]).
  apply number_if_small in h'; [|rewrite Rabs_pos_eq; lra]. eexists. split; [exact h'|].
  destruct (whole_of_result f fine env (y2 * c) ltac:(lra)) as ((w' & _) & low' & high').
  set (x := seen (Rd (y2 * c))) in *.
  assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (ey : 0 <= e1 * y2 <= / 8388608 * y2) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (yc : (/ 3 - 0.34 * e1) * y2 <= y2 * c <= (/ 3 + 0.34 * e1) * y2).
  { rewrite (Rmult_comm y2). split; apply Rmult_le_compat_r; lra. }
  assert (eyc : e1 * (y2 * c) <= / 8388608 * (y2 * c)) by (apply Rmult_le_compat_r; lra).
  split; [|split; lra].
  assert (eez : 0 <= e1 * (e1 * z) <= / 8388608 * (e1 * z)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  assert (A1 : (1 - e1) * ((/ 3 - 0.34 * e1) * ((1 - e1) * (z - l)) - l) <= x).
  { eapply Rle_trans; [|exact low']. apply Rmult_le_compat_l; [lra|].
    assert ((/ 3 - 0.34 * e1) * ((1 - e1) * (z - l)) <= (/ 3 - 0.34 * e1) * y2) by (apply Rmult_le_compat_l; lra). lra. }
  assert (e2 : 0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (A2 : (/ 3 - 1.05 * e1) * (z - l) - l <= x \/ z <= l).
  { destruct (Rle_lt_dec z l); [right; assumption|left]. eapply Rle_trans; [|exact A1].
    assert ((/ 3 - 1.05 * e1) * (z - l) <= (1 - e1) * ((/ 3 - 0.34 * e1) * (1 - e1)) * (z - l)).
    { apply Rmult_le_compat_r; [lra|]. assert (0 <= e1 * (e1 * e1) <= / 8388608 * (e1 * e1)) by (split; [apply
        Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]). lra. } lra. }
  destruct A2 as [A2|tiny].
  - apply (Rmult_le_compat_l (1 + 3.4 * e1)) in A2; [|lra].
    assert (0 <= e1 * (e1 * l) <= / 8388608 * (e1 * l)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
      lra]). lra.
  - assert (0 <= e1 * x) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma lengths_raised i : exists x, value_of (length_ i) = Number x /\
  exact_length i <= (1 + 7.5 * e1) * seen x + 0.872 * v + 131.8 * (e1 * A) /\ 0 <= seen x <= 8.2 * A + 1.5 * v.
Proof.
  pose proof sizes_ as (A0 & v0 & vl & G4 & GG & G2 & lA & eA & ev & el). pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (here lengths_hold pairs in_range t T time_ in_step pp pb pc inside) as lh.
  destruct (lh 0%nat) as (y0 & E0 & n0 & b0). destruct (lh 1%nat) as (y1 & E1 & n1 & b1).
  destruct (lh 2%nat) as (y2 & E2 & n2 & b2). clear lh.
  assert (e_ : forall x, 0 <= x -> 0 <= e1 * x <= / 8388608 * x) by (intros x x0; split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  pose proof (e_ _ (proj1 b0)) as e0_. pose proof (e_ _ (proj1 b1)) as e1_. pose proof (e_ _ (proj1 b2)) as e2_.
  destruct (twice_value _ y1 E1 ltac:(lra)) as (d & Ed & d1 & d2). pose proof (e_ _ (proj1 d2)) as ed_.
  (* From a sum z of lengths to its third x. *)
  assert (up : forall z x, 0 <= x -> z / 3 <= (1 + 3.4 * e1) * x + 2 * l -> (1 + 4 * e1) * z / 3 <= (1 + 7.45 * e1) * x +
    3 * l).
  { intros z x x0 h. apply (Rmult_le_compat_l (1 + 4 * e1)) in h; [|lra]. pose proof (e_ x x0). pose proof (e_ (e1 * x)
      ltac:(lra)). lra. }
  unfold length_, raised, exact_length. destruct i as [|[|[|i]]].
  - exists y0. split; [exact E0|]. split; lra.
  - destruct (third_of_sum _ _ y0 d E0 Ed ltac:(lra) ltac:(lra)) as (x & Ex & x1 & x2). exists x. split; [exact Ex|].
    split; [|lra]. pose proof (up _ _ (proj1 x2) x1). pose proof (e_ _ (proj1 x2)).
    assert (2 * (1 + 2.7 * e1) * seen y1 <= (1 + 4 * e1) * seen d + 2.2 * l).
    { apply (Rmult_le_compat_l (1 + 2.7 * e1)) in d1; [|lra]. pose proof (e_ (e1 * seen d) ltac:(lra)). lra. } lra.
  - destruct (third_of_sum _ _ d y2 Ed E2 ltac:(lra) ltac:(lra)) as (x & Ex & x1 & x2). exists x. split; [exact Ex|].
    split; [|lra]. pose proof (up _ _ (proj1 x2) x1). pose proof (e_ _ (proj1 x2)).
    assert (2 * (1 + 2.7 * e1) * seen y1 <= (1 + 4 * e1) * seen d + 2.2 * l).
    { apply (Rmult_le_compat_l (1 + 2.7 * e1)) in d1; [|lra]. pose proof (e_ (e1 * seen d) ltac:(lra)). lra. } lra.
  - exists y2. split; [exact E2|]. split; lra.
Qed.
(* The error of a length, and the separation, a little more. *)
Lemma length_error_value : exists x, value_of (length_error pairs) = Number x /\ seen x = x /\
  255.9 * (e1 * A) + 0.9999 * v <= x <= 256.1 * (e1 * A) + 1.0001 * v.
Proof.
  pose proof sizes_ as (A0 & v0 & vl & G4 & GG & G2 & lA & eA & ev & el). pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (e_pos f). pose proof (e_small f ok). pose proof (eps_twice f) as eu.
  pose proof (here extent_operand pairs in_range) as oe.
  pose proof (here M_bounds pairs in_range) as Mb.
  assert (pair : forall a b x y, operand (value_of x) (M a) (M a) 0 0 -> operand (value_of y) (M b) (M b) 0
    0 -> operand (value_of (Product x y)) (M a * M b) (M a * M b) 1 2 /\ 0 <= M a * M b <= G * G).
  { intros a b x y ox oy. pose proof (Mb a). pose proof (Mb b).
    assert (0 <= M a * M b <= G * G) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
    pose proof (run (Product x y)) as h. cbn in h. pose proof (product_holds h ox oy ltac:(lia) ltac:(lra) ltac:(lra)) as
      r. split; [|assumption]. apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds r)); lra || lia. }
  set (E := extent pairs) in *.
  destruct (pair Expressions.X Expressions.Y (vx E) (vy E) (oe Expressions.X) (oe Expressions.Y)) as [xy xyb].
  destruct (pair Expressions.Y Expressions.Z_ (vy E) (vz E) (oe Expressions.Y) (oe Expressions.Z_)) as [yz yzb].
  destruct (pair Expressions.Z_ Expressions.X (vz E) (vx E) (oe Expressions.Z_) (oe Expressions.X)) as [zx zxb].
  pose proof (run (Sum (Product (vx E) (vy E)) (Product (vy E) (vz E)))) as h1. cbn -[E] in h1.
  pose proof (sum_holds Rplus 1 ltac:(auto) h1 xy yz ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra)) as s1.
  pose proof (run (areas E)) as h2. unfold areas in h2. cbn -[E] in h2. fold (areas E) in h2.
  pose proof (sum_holds Rplus 2 ltac:(auto) h2 (seen_holds s1) zx ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra)
    ltac:(lra)) as s2. change (M Expressions.X * M Expressions.Y + M Expressions.Y * M Expressions.Z_ + M Expressions.Z_
      * M Expressions.X) with A in s2.
  assert (uA : 0 <= u * A <= 0.0001 * A) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (run (Product (Constant (Small 8)) (roundoffs 64))) as h3. cbn -[roundoffs] in h3.
  pose proof (product_holds h3 (here count_operand 8%Z ltac:(lia)) (seen_holds (here roundoffs_holds 64%Z ltac:(lia)))
    ltac:(lia) ltac:(lra) ltac:(lra)) as s3.
  pose proof (run (Product (Product (Constant (Small 8)) (roundoffs 64)) (areas E))) as h4. cbn -[roundoffs areas E] in
    h4.
  assert (s3' : operand (value_of (Product (Constant (Small 8)) (roundoffs 64))) (512 * u) (512 * u) 2 18.2).
  { replace (512 * u) with (8 * (64 * u)) at 1 by ring. apply (operand_weaker f env _ _ _ _ _ _ _ _ (seen_holds s3));
      lra || lia. }
  pose proof (product_holds h4 s3' (seen_holds s2) ltac:(lia) ltac:(lra) ltac:(lra)) as s4.
  pose proof (run (length_error pairs)) as h5. unfold length_error in h5. cbn -[roundoffs areas extent] in h5. fold E in
    h5.
  assert (ov : operand (value_of (Constant LengthUnderflow)) v v 0 0).
  { rewrite run_constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq v) at 3 by lra. apply operand_normal.
    rewrite Rabs_pos_eq; lra. }
  pose proof (sum_holds Rplus 6 ltac:(auto) h5 (seen_holds s4) ov ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra))
    as (x & Ex & _ & d & _ & _). exists x. split; [exact Ex|].
  pose proof (q_linear f ok 7 ltac:(lia)) as q7. replace (INR 7) with 7 in q7 by (simpl; ring). pose proof (q_ge f 7).
  replace (512 * u * A) with (256 * (e1 * A)) in * by (rewrite eu; ring).
  assert ((q 7 - 1) * (256 * (e1 * A) + v) <= 0.000001 * (256 * (e1 * A) + v)) by (apply Rmult_le_compat_r; lra).
  match type of d with _ <= _ + _ * ?a => assert (la : l * a <= l * (20 * A + 4)) by (apply Rmult_le_compat_l; lra) end.
  apply Rabs_le_inv in d. assert (b : 255.9 * (e1 * A) + 0.9999 * v <= x <= 256.1 * (e1 * A) + 1.0001 * v) by lra.
  split; [|exact b]. apply (seen_large f env). lra.
Qed.
Lemma wide_separation_value : exists x, value_of wide_separation = Number x /\ seen x = x /\
  (1 + 29.8 * e1) * s <= x <= 1.001 * s.
Proof.
  pose proof sizes_ as (_ & _ & _ & G4 & GG & G2 & _). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (L_G f fine).
  destruct (here more_value 64 ltac:(lia)) as (c & Ec & c1 & c2).
  pose proof (run_product (Input (Length Separation)) (more_roundoffs 64)) as h. rewrite run_input, Ec in h.
  unfold product in h. cbn in h. rewrite (seen_large f env s), (seen_large f env c) in h by lra.
  assert (es : 0 <= e1 * s <= / 8388608 * s) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (sc : (1 + 30.9 * e1) * s <= s * c <= 1.0001 * s) by (rewrite (Rmult_comm s); split; apply Rmult_le_compat_r;
    lra).
  apply number_if_small in h; [|rewrite Rabs_pos_eq; lra]. destruct (normal_error f fine env (s * c) ltac:(lra)) as [n1
    n2]. exists (Rd (s * c)). split; [exact h|].
  assert ((1 - e1) * ((1 + 30.9 * e1) * s) <= (1 - e1) * (s * c)) by (apply Rmult_le_compat_l; lra).
  assert (e1 * (s * c) <= / 8388608 * (s * c)) by (apply Rmult_le_compat_r; lra).
  assert (e1 * (e1 * s) <= / 8388608 * (e1 * s)) by (apply Rmult_le_compat_r; lra).
  assert (b : (1 + 29.8 * e1) * s <= Rd (s * c) <= 1.001 * s) by lra. split; [|exact b]. apply (seen_large f env). lra.
Qed.
(* The bar of a control value. *)
Notation E0 := (31.9 * e1 * PM + 0.98 * (eta * (Q * Q))).
Theorem bar_value i : exists B, value_of (bar_of_length pairs (length_ i)) = Number B /\ seen B = B /\
  (1 - e1) * (E0 + ((1 + 15 * e1) * (s * exact_length i) + 122 * (e1 * (s * A)) + 0.12 * (s * v) - 2.1 * l)) <= B /\
  0 <= B <= 33 * (e1 * PM) + 1.03 * (eta * (Q * Q)) + 8.25 * (s * A) + 3 * (s * v).
Proof.
  pose proof sizes_ as (A0 & v0 & vl & G4 & GG & G2 & lA & eA & ev & el). pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (e_pos f). pose proof (e_small f ok). pose proof (L_G f fine) as LG. pose proof (G_3 f fine) as G3.
  destruct (lengths_raised i) as (x & Ex & low & x0 & high). revert Ex. generalize (length_ i) as len. intros len Ex.
  destruct length_error_value as (d & Ed & sd & d1 & d2).
  destruct wide_separation_value as (S & ES & sS & S1 & S2). set (N := exact_length i) in *.
  destruct (here error_value pairs in_range) as (E & EE & _ & lE & Elow & Ehigh).
  pose proof (here volume_bounds pairs in_range) as (_ & PMG & _).
  pose proof (here QQ pairs in_range) as QQ_. pose proof (eta_1 f fine) as et1.
  assert (et0 : 0 < eta) by apply bpow_gt_0.
  assert (eQ : 0 <= eta * (Q * Q) <= G * G). { split; [apply Rmult_le_pos; lra|].
    assert (eta * (Q * Q) <= 1 * (Q * Q)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (ePM : 0 <= e1 * PM <= / 8388608 * PM) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (GGG : 4 * (G * G) <= G * (G * G)) by (apply Rmult_le_compat_r; lra).
  assert (lN : 512 * l <= eta * (Q * Q)). { pose proof (eta_large f fine). rewrite <- (Rmult_1_r (512 * l)).
    apply Rmult_le_compat; lra. }
  set (N_ := eta * (Q * Q)) in *. set (P_ := PM) in *.
  (* The length and its error. *)
  pose proof (run_sum len (length_error pairs)) as h1. rewrite Ex, Ed in h1. unfold sum in h1. cbn in h1.
  rewrite sd in h1. set (z := seen x + d) in *. assert (zb : 0.99 * v <= z <= 8.24 * A + 2.6 * v) by (unfold z; lra).
  apply number_if_small in h1; [|rewrite Rabs_pos_eq; lra]. destruct (normal_error f fine env z ltac:(lra)) as [z1 z2].
  set (Z := Rd z) in *. assert (ez : 0 <= e1 * z <= / 8388608 * z) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (sZ : seen Z = Z) by (apply (seen_large f env); lra).
  (* Times the separation. *)
  pose proof (run_product wide_separation (Sum len (length_error pairs))) as h2. rewrite ES, h1 in h2.
  unfold product in h2. cbn in h2. rewrite sS, sZ in h2.
  assert (sA : 0 <= s * A <= 0.05 * (G * (G * G))). { split; [apply Rmult_le_pos; lra|].
    apply Rle_trans with (/ 4 * G * (0.19 * (G * G))); [apply Rmult_le_compat; lra|lra]. }
  assert (sv : 0 <= s * v <= / 4 * G). { split; [apply Rmult_le_pos; lra|].
    apply Rle_trans with (/ 4 * G * 1); [apply Rmult_le_compat; lra|lra]. }
  assert (sz : 0 <= s * z <= 8.24 * (s * A) + 2.6 * (s * v)). { split; [apply Rmult_le_pos; lra|].
    replace (8.24 * (s * A) + 2.6 * (s * v)) with (s * (8.24 * A + 2.6 * v)) by ring. apply Rmult_le_compat_l; lra. }
  assert (esz : 0 <= e1 * (s * z) <= / 8388608 * (s * z)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  assert (eesz : 0 <= e1 * (e1 * (s * z)) <= / 8388608 * (e1 * (s * z))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (es : 0 <= e1 * s) by (apply Rmult_le_pos; lra).
  assert (SZ : (1 + 28.7 * e1) * (s * z) <= S * Z <= 1.0011 * (s * z)).
  { split.
    - apply Rle_trans with ((1 + 29.8 * e1) * s * ((1 - e1) * z)); [|apply Rmult_le_compat; try apply Rmult_le_pos; lra].
      lra.
    - apply Rle_trans with (1.001 * s * ((1 + e1) * z)); [apply Rmult_le_compat; lra|lra]. }
  apply number_if_small in h2; [|rewrite Rabs_pos_eq; lra].
  destruct (whole_of_result f fine env (S * Z) ltac:(lra)) as ((w & _) & low2 & high2).
  set (Y := seen (Rd (S * Z))) in *.
  assert (eSZ : e1 * (S * Z) <= / 8388608 * (S * Z)) by (apply Rmult_le_compat_r; lra).
  (* And the error of the volume. *)
  pose proof (run_sum (error_of_volume pairs) (Product wide_separation (Sum len (length_error pairs)))) as h3.
  rewrite EE, h2 in h3. unfold sum in h3. cbn in h3. rewrite (seen_large f env E lE) in h3. fold Y in h3.
  fold (bar_of_length pairs len) in h3.
  apply number_if_small in h3; [|rewrite Rabs_pos_eq; lra]. destruct (normal_error f fine env (E + Y) ltac:(lra)) as [n1
    n2]. exists (Rd (E + Y)). split; [exact h3|].
  assert (eEY : 0 <= e1 * (E + Y) <= / 8388608 * (E + Y)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  split; [apply (seen_large f env); lra|]. split; [|lra].
  eapply Rle_trans; [|exact n1]. apply Rmult_le_compat_l; [lra|].
  assert (Ylow : (1 + 27.6 * e1) * (s * z) - l <= Y).
  { eapply Rle_trans; [|exact low2]. apply Rle_trans with ((1 - e1) * ((1 + 28.7 * e1) * (s * z) - l)); [lra|].
    apply Rmult_le_compat_l; lra. }
  (* z is at least the exact length and more. *)
  assert (exz : 0 <= e1 * seen x <= e1 * z) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; unfold z; lra]).
  assert (zN : N + 124 * (e1 * A) + 0.127 * v <= (1 + 7.5 * e1) * z) by (unfold z in *; lra).
  apply (Rmult_le_compat_l s) in zN; [|lra].
  assert (N0 : 0 <= s * N). { apply Rmult_le_pos; [lra|]. unfold N, exact_length. pose proof (norm_pos (normal 0)).
    pose proof (norm_pos (normal 1)). pose proof (norm_pos (normal 2)). destruct i as [|[|[|i]]]; lra. }
  assert (esA : 0 <= e1 * (s * A)) by (apply Rmult_le_pos; lra).
  assert (eN : 15 * (e1 * (s * N)) <= 15.001 * (e1 * (s * z))).
  { assert (e1 * (s * N) <= e1 * ((1 + 7.5 * e1) * (s * z))) by (apply Rmult_le_compat_l; lra). lra. }
  lra.
Qed.

(* Margins: each, as it is seen, and a reserve are at most the control value less the separation times the length. *)
Definition reserve_beyond := 9.6 * e1 * PM + 0.6 * (eta * (Q * Q)) + 75 * (e1 * (s * A)) + 0.1 * (s * v).
Definition width_beyond := 1.01 * PM + 1.4 * (eta * (Q * Q)) + 8.3 * (s * A) + 3.1 * (s * v).
Notation value_holds := (value_holds f env value_of pairs).
Lemma products_ : 0 <= s * A <= 0.05 * (G * G * G) /\ 0 <= s * v <= / 4 * G /\ 0 <= e1 * (s * A) <= / 8388608 * (s * A) /\
  0 <= e1 * (s * v) <= / 8388608 * (s * v) /\ 0 <= l * (s * A) <= / 1099511627776 * (e1 * (s * A)) /\
  0 <= l * (s * v) <= / 1152921504606846976 * (s * v) /\ 0 <= e1 * PM <= / 8388608 * PM /\
  0 <= l * PM <= / 1099511627776 * (e1 * PM) /\ 512 * l <= eta * (Q * Q) <= G * G /\
  0 <= l * (Q * Q) <= / 512 * (eta * (Q * Q)) /\ 0 <= PM <= 6 * (G * G * G) /\ 4 * (G * G) <= G * G * G.
Proof.
  pose proof sizes_ as (A0 & v0 & vl & G4 & GG & G2 & lA & eA & ev & el). pose proof (l_pos f). pose proof (l_small f
    ok). pose proof (e_pos f). pose proof (e_small f ok). pose proof (L_G f fine). pose proof (l_e f fine) as le.
  pose proof (here volume_bounds pairs in_range) as (_ & PMG & _).
  pose proof (here QQ pairs in_range) as QQ_. pose proof (eta_1 f fine).
  pose proof (eta_large f fine). assert (sA : 0 <= s * A) by (apply Rmult_le_pos; lra).
  assert (sv : 0 <= s * v) by (apply Rmult_le_pos; lra).
  assert (le_ : forall x, 0 <= x -> 0 <= l * x <= / 1099511627776 * (e1 * x)).
  { intros x x0. split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * x)) with (/ 1099511627776 * e1 * x) by ring. apply Rmult_le_compat_r; lra. }
  assert (e_ : forall x, 0 <= x -> 0 <= e1 * x <= / 8388608 * x) by (intros x x0; split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  split; [split; [exact sA|]|].
  { apply Rle_trans with (/ 4 * G * (0.19 * (G * G))); [apply Rmult_le_compat; lra|].
    assert (0 <= G * G * G) by (apply Rmult_le_pos; [apply Rmult_le_pos|]; lra). lra. }
  split; [split; [exact sv|apply Rle_trans with (/ 4 * G * 1); [apply Rmult_le_compat; lra|lra]]|].
  split; [now apply e_|]. split; [now apply e_|]. split; [now apply le_|].
  split; [split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra|]. split; [apply e_; lra|]. split; [apply le_; lra|].
  split; [split|].
  - rewrite <- (Rmult_1_r (512 * l)). apply Rmult_le_compat; lra.
  - apply Rle_trans with (1 * (Q * Q)); [apply Rmult_le_compat_r; lra|lra].
  - split; [split; [apply Rmult_le_pos; lra|]|].
    + replace (/ 512 * (eta * (Q * Q))) with (/ 512 * eta * (Q * Q)) by ring. apply Rmult_le_compat_r; lra.
    + split; [exact PMG|]. assert (4 * (G * G) <= G * (G * G)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma margin_value i b0 b sign X : sign_of f env value_of b0 sign -> value_holds b X 21 13.2 135 -> exists x,
  control f env value_of width_beyond (margin b0 b (bar_of_length pairs (length_ i))) x /\
  seen x + reserve_beyond <= sign * X - s * exact_length i.
Proof.
  intros signs (y & Ey & ry & near_). destruct (bar_value i) as (B & EB & sB & Blow & B0 & Bhigh).
  pose proof products_ as (sA & sv & esA & esv & lsA & lsv & eP & lP & N_ & lQQ & PMG & GGG).
  pose proof sizes_ as (_ & _ & _ & G4 & GG & G2 & _). pose proof (G_3 f fine) as G3.
  pose proof (here volume_bounds pairs in_range) as (S3b & _ & _ & S3PM).
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  set (PMv := PM) in *. set (N := eta * (Q * Q)) in *. set (sAv := s * A) in *. set (svv := s * v) in *.
  assert (sN0 : 0 <= s * exact_length i). { apply Rmult_le_pos; [lra|]. unfold exact_length. pose proof (norm_pos (normal
    0)). pose proof (norm_pos (normal 1)). pose proof (norm_pos (normal 2)). destruct i as [|[|[|i]]]; lra. }
  set (sN := s * exact_length i) in *.
  assert (eN : 0 <= e1 * N <= / 8388608 * N) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eeP : e1 * (e1 * PMv) <= / 8388608 * (e1 * PMv)) by (apply Rmult_le_compat_r; lra).
  pose proof (q_linear f ok 21 ltac:(lia)) as q21. replace (INR 21) with 21 in q21 by (simpl; ring).
    pose proof (q_ge f 21).
  set (S3 := 6 * (p f env value_of pairs Expressions.X * p f env value_of pairs Expressions.Y * p f env value_of pairs
    Expressions.Z_)) in *.
  assert (lb : l * (13.2 * S3 + 135 * (Q * Q)) <= 13.3 * (l * PMv) + 135 * (l * (Q * Q))).
  { replace (13.3 * (l * PMv) + 135 * (l * (Q * Q))) with (l * (13.3 * PMv + 135 * (Q * Q))) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (err_ : Rabs (y - X) <= 21.03 * (e1 * PMv) + 0.27 * N).
  { destruct near_ as (d & _ & _). assert ((q 21 - 1) * S3 <= 21.021 * e1 * S3) by (apply Rmult_le_compat_r; lra).
    assert (e1 * S3 <= e1 * ((1 + 10 * e1) * PMv)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (size : Rabs y <= 1.0011 * PMv + 0.28 * N).
  { pose proof (near_size f _ _ _ _ _ near_) as h. assert (q 21 * S3 <= 1.00001 * S3) by (apply Rmult_le_compat_r; lra).
    lra. }
  set (chosen := Select (Greater (Constant (Small 0)) b0) (Negative b) b).
  assert (Ec : value_of chosen = Number (sign * y) /\ Rabs (sign * y) = Rabs y).
  { pose proof (run chosen) as h. unfold chosen in h. cbn -[says] in h. fold chosen in h.
    pose proof (run (Negative b)) as hn. cbn in hn. rewrite Ey in hn. cbn in hn.
    destruct signs as [[is ->]|[not ->]], h as [[is' h]|[not' h]]; try tauto.
    - rewrite h, hn. replace (-1 * y) with (- y) by ring. split; [reflexivity|apply Rabs_Ropp].
    - rewrite h, Ey. replace (1 * y) with y by ring. auto. }
  destruct Ec as [Ec Ea]. generalize dependent (length_ i). intros len EB.
  pose proof (run (margin b0 b (bar_of_length pairs len))) as h. unfold margin in h.
  fold chosen in h. cbn -[chosen bar_of_length] in h. rewrite Ec, EB in h. cbn in h. rewrite sB in h.
  pose proof (seen_smaller f env (sign * y)) as ss. pose proof (seen_off f env (sign * y)) as so.
  set (z := seen (sign * y) - B) in *.
  assert (zb : Rabs z <= 1.0012 * PMv + 1.32 * N + 8.25 * sAv + 3 * svv).
  { unfold z. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq B) by lra. lra. }
  assert (zb' : Rabs z <= Rabs y + B). { unfold z. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp,
    (Rabs_pos_eq B) by lra. lra. }
  apply (result_number f ok env) in h; [|lra]. exists (Rd z).
  pose proof (error f ok env z) as er. pose proof (seen_off f env (Rd z)) as sr. pose proof (seen_smaller f env (Rd z))
    as sr'.
  assert (ez : e1 * Rabs z <= / 8388608 * Rabs z) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (ez' : e1 * Rabs z <= e1 * (Rabs y + B)) by (apply Rmult_le_compat_l; lra).
  assert (ey : e1 * Rabs y <= e1 * (1.0011 * PMv + 0.28 * N)) by (apply Rmult_le_compat_l; lra).
  assert (Rabs (Rd z) <= Rabs z + (e1 * Rabs z + l)).
  { replace (Rd z) with (z + (Rd z - z)) at 1 by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (signed : Rabs (sign * y - sign * X) <= 21.03 * (e1 * PMv) + 0.27 * N).
  { destruct signs as [[_ ->]|[_ ->]]; [replace (-1 * y - -1 * X) with (- (y - X)) by ring;
    rewrite Rabs_Ropp|replace (1 * y - 1 * X) with (y - X) by ring]; assumption. }
  split.
  - split; [exact h|]. split; [exact (result_is_representable f ok _ _ (nearly env _))|]. split; [apply settled|].
    unfold width_beyond. fold PMv N sAv svv. lra.
  - apply Rabs_le_inv in er, sr, so, signed. unfold reserve_beyond. fold PMv N sAv svv.
    assert (esN : 0 <= e1 * sN) by (apply Rmult_le_pos; lra).
    set (low := 31.9 * (e1 * PMv) + 0.98 * N + ((1 + 15 * e1) * sN + 122 * (e1 * sAv) + 0.12 * svv - 2.1 * l)).
    assert (Blow' : (1 - e1) * low <= B). { eapply Rle_trans; [|exact Blow]. unfold low. right. ring. }
    assert (B1 : (1 - e1) * ((1 - e1) * low) <= (1 - e1) * B) by (apply Rmult_le_compat_l; lra).
    assert (low1 : low - 2 * (e1 * low) <= (1 - e1) * ((1 - e1) * low) \/ low <= 0).
    { destruct (Rle_lt_dec low 0); [right; assumption|left].
      assert (0 <= e1 * (e1 * low)) by (repeat apply Rmult_le_pos; lra). lra. }
    assert (el : 0 <= e1 * l) by (apply Rmult_le_pos; lra).
    assert (low2 : e1 * low <= e1 * (31.9 * (e1 * PMv) + 0.98 * N + 122 * (e1 * sAv) + 0.12 * svv) + 1.00001 * (e1 *
      sN)).
    { assert (e1 * (15 * e1 * sN) <= 0.00001 * (e1 * sN)) by (assert (e1 * (e1 * sN) <= / 8388608 * (e1 * sN)) by (apply
        Rmult_le_compat_r; lra); lra). unfold low. lra. }
    assert (e1 * (e1 * sAv) <= / 8388608 * (e1 * sAv)) by (apply Rmult_le_compat_r; lra).
    assert (lowpos : 0 < low) by (unfold low; lra). destruct low1 as [low1|]; [|lra].
    assert (E : low = 31.9 * (e1 * PMv) + 0.98 * N + ((1 + 15 * e1) * sN + 122 * (e1 * sAv) + 0.12 * svv - 2.1 * l)) by
      reflexivity. clearbody low. unfold z in *. lra.
Qed.
Notation exact_values := (exact_from T (outer_at given pp pb pc Expressions.Start) (inner_at given pp pb pc
  Expressions.Start) (inner_at given pp pb pc Expressions.End) (outer_at given pp pb pc Expressions.End)).
Lemma margins_beyond_values : let '(g0, g1, g2, g3) := margins_beyond pairs t in let '(X0, X1, X2, X3) := exact_values in
  exists sign x0 x1 x2 x3, (sign = 1 \/ sign = -1) /\
  control f env value_of width_beyond g0 x0 /\ control f env value_of width_beyond g1 x1 /\
  control f env value_of width_beyond g2 x2 /\ control f env value_of width_beyond g3 x3 /\
  seen x0 + reserve_beyond <= sign * X0 - s * exact_length 0 /\ seen x1 + reserve_beyond <= sign * X1 - s * exact_length
  1 /\
  seen x2 + reserve_beyond <= sign * X2 - s * exact_length 2 /\ seen x3 + reserve_beyond <= sign * X3 - s * exact_length
  3.
Proof.
  pose proof (here outer_holds pairs in_range pp pb pc inside) as oh.
  pose proof (here inner_holds pairs in_range pp pb pc inside) as ih.
  pose proof (here values_hold pairs in_range pp pb pc inside t T time_ in_step _ _ _ _ _ _ _ _
    (conj (oh Expressions.Start) (conj (ih Expressions.Start) (conj (ih Expressions.End) (oh Expressions.End))))) as vh.
  pose proof margin_value as mv. unfold length_, normal_vector in mv. unfold margins_beyond. cbn [corners_of].
  destruct (normals pp pb pc t) as [[n0 n1] n2]. destruct (raised _ _ _) as [[[l0 l1] l2] l3].
  destruct (values_from _ _ _ _ _) as [[[b0 b1] b2] b3]. destruct exact_values as [[[X0 X1] X2] X3].
  destruct vh as (h0 & h1 & h2 & h3).
  assert (signs : exists sign, (sign = 1 \/ sign = -1) /\ sign_of f env value_of b0 sign).
  { destruct h0 as (y & Ey & _). unfold sign_of. cbn. rewrite run_constant, Ey. cbn.
    destruct (Rlt_dec (seen y) (seen 0)); [exists (-1)|exists 1]; tauto. }
  destruct signs as (sign & one_ & signs).
  destruct (mv 0%nat b0 b0 sign X0 signs h0) as (x0 & A0 & B0). destruct (mv 1%nat b0 b1 sign X1 signs h1) as (x1 & A1 &
    B1).
  destruct (mv 2%nat b0 b2 sign X2 signs h2) as (x2 & A2 & B2). destruct (mv 3%nat b0 b3 sign X3 signs h3) as (x3 & A3 &
    B3). exists sign, x0, x1, x2, x3. tauto.
Qed.
Lemma reserve_is_enough : 0 <= width_beyond <= 10 * (G * G * G) /\ 0 < reserve_beyond /\
  4 * slack_ f width_beyond < reserve_beyond /\ ahead_error f width_beyond + 200 * (l * width_beyond) <= reserve_beyond.
Proof.
  pose proof products_ as (sA & sv & esA & esv & lsA & lsv & eP & lP & N_ & lQQ & PMG & GGG).
  pose proof sizes_ as (_ & _ & _ & G4 & GG & G2 & _).
  pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f). pose proof (e_small f ok).
  unfold reserve_beyond, width_beyond, slack_, ahead_error.
  set (P_ := PM) in *. set (N := eta * (Q * Q)) in *. set (sAv := s * A) in *. set (svv := s * v) in *.
  assert (eN : 0 <= e1 * N <= 0.000001 * N) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lN : 0 <= l * N <= 0.000001 * N) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  repeat split; lra.
Qed.
(* The normal at a time, and the lengths that bound it. *)
Definition normal_at t' := cross_at (fun a => exactly_at given pp a t' - exactly_at given pb a t') (fun a => exactly_at
  given pp a t' - exactly_at given pc a t').
Lemma normal_is_short q_ : 0 <= q_ <= 1 -> norm (normal_at ((1 - q_) * T + q_ * 1)) <= cubic (exact_length 0) (exact_length
  1) (exact_length 2) (exact_length 3) q_.
Proof.
  intro q01. set (a := (1 - q_) ^ 2). set (b := 2 * ((1 - q_) * q_)). set (c := q_ ^ 2).
  assert (a0 : 0 <= a) by (apply pow_le; lra). assert (c0 : 0 <= c) by (apply pow_le; lra).
  assert (b0 : 0 <= b) by (unfold b; assert (0 <= (1 - q_) * q_) by (apply Rmult_le_pos; lra); lra).
  replace (norm (normal_at _)) with (norm (fun i => a * normal 0 i + (b * normal 1 i + c * normal 2 i))).
  2: { unfold norm. f_equal. unfold squared, sum3, normal_at, exact_normal, cross_at, exact_side_at, exact_side,
    exactly_at, a, b, c. field. }
  pose proof (norm_sum (fun i => a * normal 0 i) (fun i => b * normal 1 i + c * normal 2 i)) as t1.
  pose proof (norm_sum (fun i => b * normal 1 i) (fun i => c * normal 2 i)) as t2. cbv beta in t1, t2.
  rewrite (norm_scaled _ _ a0) in t1. rewrite (norm_scaled _ _ b0), (norm_scaled _ _ c0) in t2.
  eapply Rle_trans; [exact t1|]. eapply Rle_trans; [apply Rplus_le_compat_l; exact t2|].
  right. unfold cubic, exact_length, a, b, c. field.
Qed.
Notation is_beyond t' := (s * norm (normal_at t') < Rabs (exact_volume given pp pb pc t')).
Lemma positive_is_beyond sign X0 X1 X2 X3 q_ : (sign = 1 \/ sign = -1) -> 0 <= q_ <= 1 ->
  exact_volume given pp pb pc ((1 - q_) * T + q_ * 1) = cubic X0 X1 X2 X3 q_ ->
  0 < cubic (sign * X0 - s * exact_length 0) (sign * X1 - s * exact_length 1) (sign * X2 - s * exact_length 2) (sign * X3
    - s * exact_length 3) q_ -> is_beyond ((1 - q_) * T + q_ * 1).
Proof.
  intros one_ q01 E pos. pose proof (l_pos f). pose proof (normal_is_short q_ q01) as short.
  apply (Rmult_le_compat_l s) in short; [|lra]. rewrite E. eapply Rle_lt_trans; [exact short|].
  assert (split_ : cubic (sign * X0 - s * exact_length 0) (sign * X1 - s * exact_length 1) (sign * X2 - s * exact_length
    2) (sign * X3 - s * exact_length 3) q_ = sign * cubic X0 X1 X2 X3 q_ - s * cubic (exact_length 0) (exact_length 1)
    (exact_length 2) (exact_length 3) q_) by (unfold cubic; ring).
  rewrite split_ in pos. pose proof (Rle_abs (cubic X0 X1 X2 X3 q_)). pose proof (Rle_abs (- cubic X0 X1 X2 X3 q_)).
  rewrite Rabs_Ropp in *. destruct one_ as [-> | ->]; lra.
Qed.
Theorem margins_keep_beyond : says f env value_of (all_positive (margins_beyond pairs t)) -> forall t', T <= t' <= 1 ->
  is_beyond t'.
Proof.
  intros all t' between. pose proof margins_beyond_values as mv. destruct (margins_beyond pairs t) as [[[g0 g1] g2] g3].
  pose proof (cubic_from f env tau (outer_at given pp pb pc Expressions.Start) (inner_at given pp pb
    pc Expressions.Start) (inner_at given pp pb pc Expressions.End) (outer_at given pp pb pc Expressions.End)) as cf.
  destruct exact_values as [[[X0 X1] X2] X3].
  destruct mv as (sign & x0 & x1 & x2 & x3 & one_ & c0 & c1 & c2 & c3 & below).
  destruct reserve_is_enough as (_ & enough).
  destruct (positive_to_the_end f env given value_of run tau in_step width_beyond reserve_beyond enough g0 g1 g2 g3 x0 x1 x2 x3 _
    _ _ _ c0 c1 c2 c3 below all t' between) as (q_ & q01 & -> & pos).
  apply (positive_is_beyond sign X0 X1 X2 X3 q_ one_ q01); [|exact pos]. rewrite volume_is_cubic. apply cf.
Qed.
Theorem clipping_keeps_beyond until : value_of (clipped_until t (margins_beyond pairs t)) = Number until -> tau < until ->
  forall t', T <= t' <= until -> t' <= 1 -> is_beyond t'.
Proof.
  intros Eu later t' between t1. pose proof margins_beyond_values as mv. destruct (margins_beyond pairs t) as [[[g0 g1]
    g2] g3].
  pose proof (cubic_from f env tau (outer_at given pp pb pc Expressions.Start) (inner_at given pp pb
    pc Expressions.Start) (inner_at given pp pb pc Expressions.End) (outer_at given pp pb pc Expressions.End)) as cf.
  destruct exact_values as [[[X0 X1] X2] X3].
  destruct mv as (sign & x0 & x1 & x2 & x3 & one_ & c0 & c1 & c2 & c3 & below).
  destruct reserve_is_enough as (w0 & enough).
  destruct (here positive_until t tau moment in_step width_beyond reserve_beyond w0 enough g0 g1
    g2 g3 x0 x1 x2 x3 _ _ _ _ c0 c1 c2 c3 below until Eu later t' between t1) as (q_ & q01 & -> & pos).
  apply (positive_is_beyond sign X0 X1 X2 X3 q_ one_ q01); [|exact pos]. rewrite volume_is_cubic. apply cf.
Qed.
End VolumeBeyond.
