(* A direction whose gap exceeds the threshold at both ends of a step keeps a pair more than the separation apart
   throughout. So does one whose stored gap does at the start: a stored gap is at most the exact one. A distance that a
   gap proves is at most the exact one. core/src/kernels/gap.rs, core/src/separation/gap.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Geometry.
From Selvedge Require Expressions Errors Bounds Certificates Apart Directions Gap.
Import ListNotations.
Open Scope R_scope.

(* The code's terms: products of the direction with a point, at the start or at the end; the lowest of the first set and
   the highest of the second; the gap, its error and the threshold; whether the direction is short. *)
Definition point n t := each (fun a => Input (Place (Expressions.Coordinate n t a))).
Definition product n t := dot_ (direction 0) (point n t).
Definition lowest first t := match first with
  | [] => one | n :: others => fold_left (fun m n => Smaller m (product n t)) others (product n t) end.
Definition highest second t := match second with
  | [] => one | n :: others => fold_left (fun m n => Larger m (product n t)) others (product n t) end.
Definition gap first second t := Minus (lowest first t) (highest second t).
Definition slack := Input (Length Slack).
Definition error_of_gap := Sum (Product (roundoffs 64) (Input (Length LargestCoordinate))) (Constant Underflow).
Definition threshold := Sum (Product (Input (Length Separation)) (Product slack slack)) error_of_gap.
(* The gap at the end less its error; what is stored of it; what lasts from a stored gap; the distance. *)
Definition less_error first second := Minus (gap first second Expressions.End) error_of_gap.
Definition stored first second := let part := Quotient (less_error first second) slack in
  Select (Greater part (Input (Length LeastGap))) (Smaller part (Input (Length LargestGap))) (Smaller part (Constant (Small
    0))).
Definition lasts first second := Both (Greater (Input (Length StoredGap)) threshold) (Greater (less_error first second)
  threshold).
Definition distance first second := Minus (Quotient (gap first second Expressions.End) slack) error_of_gap.
Definition keeps first second := Both (Greater (gap first second Expressions.End) threshold)
  (Greater (gap first second Expressions.Start) threshold).
Definition short := Greater slack (dot_ (direction 0) (direction 0)).
Definition sigma := 1 + / 1048576.

(* The traced terms are these. *)
Theorem traced_terms : Gap.a_vertex_and_a_face.keeps = keeps [0%nat] [1%nat; 2%nat; 3%nat] /\
  Gap.two_edges.keeps = keeps [0%nat; 1%nat] [2%nat; 3%nat] /\
  Gap.a_vertex_and_a_face.short = short /\ Gap.two_edges.short = short /\
  Gap.a_vertex_and_a_face.lasts = lasts [0%nat] [1%nat; 2%nat; 3%nat] /\
  Gap.two_edges.lasts = lasts [0%nat; 1%nat] [2%nat; 3%nat] /\
  Gap.a_vertex_and_a_face.stored_by_keeps = stored [0%nat] [1%nat; 2%nat; 3%nat] /\
  Gap.two_edges.stored_by_keeps = stored [0%nat; 1%nat] [2%nat; 3%nat] /\
  Gap.a_vertex_and_a_face.stored_by_lasts = stored [0%nat] [1%nat; 2%nat; 3%nat] /\
  Gap.two_edges.stored_by_lasts = stored [0%nat; 1%nat] [2%nat; 3%nat] /\
  Gap.a_vertex_and_a_face.distance = distance [0%nat] [1%nat; 2%nat; 3%nat] /\
  Gap.two_edges.distance = distance [0%nat; 1%nat] [2%nat; 3%nat].
Proof. repeat split; vm_compute; reflexivity. Qed.

Section Gaps.
Load "Setting.section".
Notation m := (given (Length Separation)).
Notation B := (given (Length LargestCoordinate)).
Hypothesis the_slack : given (Length Slack) = sigma.
Definition along a := seen (given (Along 0 a)).
Definition squared := sum3 (fun a => along a * along a).
Notation dot_holds := (here dot_holds).
Notation constant := (constant f env given value_of run).

Lemma input_operand i X p n a : value_of (Input i) = Number X -> near f (seen X) X p n a ->
  operand (value_of (Input i)) X p n a.
Proof. intros -> h. exists (seen X). split; [reflexivity|exact h]. Qed.
Lemma along_operand a : operand (value_of (component (direction 0) a)) (along a) (Rabs (along a)) 0 0.
Proof. unfold direction. rewrite component_each, (run (Input (Along 0 a))). apply operand_exact. Qed.
Lemma sigma_normal : seen sigma = sigma.
Proof. unfold sigma. apply seen_of_normal. rewrite Rabs_pos_eq by lra. pose proof (l_small f ok). lra. Qed.
Lemma slack_operand : operand (value_of slack) sigma sigma 0 0.
Proof.
  unfold slack. rewrite (run (Input _)), the_slack. replace sigma with (seen sigma) at 2 by apply sigma_normal.
  rewrite <- (Rabs_pos_eq sigma) at 3 by (unfold sigma; lra). rewrite <- sigma_normal at 3. apply operand_exact.
Qed.
Lemma q_error n : (n <= 8)%nat -> 0 <= q n - 1 <= 1.001 * INR n * e1.
Proof. intro h. pose proof (q_linear f ok n ltac:(lia)). pose proof (q_ge f n). lra. Qed.

(* A short direction. *)
Lemma squares a : 0 <= along a * along a. Proof. apply Rle_0_sqr. Qed.
Lemma short_is_short : (forall a, Rabs (along a) <= G) -> says f env value_of short -> squared <= 1 + 1.5 * / 1048576.
Proof.
  intros bounded h. cbn -[dot_ direction] in h.
  pose proof (G_2 f fine) as G2. pose proof (G_4 f fine) as G4. pose proof (l_pos f). pose proof (l_small f ok) as ls.
  pose proof (e_pos f). pose proof (e_small f ok).
  assert (each_ : forall a, 0 <= Rabs (along a) * Rabs (along a) <= G * G).
  { intro a. pose proof (Rabs_pos (along a)). split; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; auto. }
  assert (GG : 16 <= G * G) by (replace 16 with (4 * 4) by ring; apply Rmult_le_compat; lra).
  assert (small : sum3 (fun a => Rabs (along a) * Rabs (along a)) <= omega f / 4).
  { unfold sum3. pose proof (each_ Expressions.X). pose proof (each_ Expressions.Y). pose proof (each_
    Expressions.Z_). lra. }
  assert (none : sum3 (fun a => Rabs (along a) * 0 + 0 * Rabs (along a) + l * (0 * 0)) <= omega f / 4) by (unfold
    sum3; lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 0 along_operand along_operand ltac:(lia) small none) as (x & Ex & _ & d & _
    & _).
  assert (same : sum3 (fun a => Rabs (along a) * Rabs (along a)) = squared).
  { unfold squared, sum3. rewrite <- !Rabs_mult, !Rabs_pos_eq by apply squares. reflexivity. }
  rewrite same in d. fold squared in d. rewrite Ex in h. unfold slack in h. rewrite (run (Input _)), the_slack in h.
  cbn in h. rewrite sigma_normal in h.
  assert (x1 : x <= sigma). { unfold sigma in *. destruct (Rle_lt_dec x (1 / 2)); [lra|].
    rewrite (seen_of_normal f env x) in h by (rewrite Rabs_pos_eq; lra). lra. }
  apply Rabs_le_inv in d. pose proof (q_error 3 ltac:(lia)) as q3. replace (INR (3 + 0 + 0)) with 3 in * by (simpl;
    ring).
  change (3 + 0 + 0)%nat with 3%nat in d. replace (INR 3) with 3 in q3 by (simpl; ring).
  assert (s0 : 0 <= squared) by (unfold squared, sum3; pose proof squares; repeat apply Rplus_le_le_0_compat; auto).
  assert ((q 3 - 1) * squared <= 3.003 * e1 * squared) by (apply Rmult_le_compat_r; lra).
  assert (e1 * squared <= / 8388608 * squared) by (apply Rmult_le_compat_r; lra).
  unfold sum3 in d. unfold sigma in x1. lra.
Qed.

(* The pair: coordinates no larger than B, a direction no longer than the slack allows, a separation. *)
Hypothesis short_ : squared <= 1 + 1.6 * / 1048576.
Hypothesis coordinates : forall c, Rabs (given (Place c)) <= B.
Hypothesis within : B <= power (largest_edge f).
Hypothesis separation : 0 <= m <= power (largest_edge f).

Lemma B_bounds : 0 <= B <= / 4 * G.
Proof.
  pose proof (coordinates (Expressions.Coordinate 0 Expressions.Start Expressions.X)).
  pose proof (Rabs_pos (given (Place (Expressions.Coordinate 0 Expressions.Start Expressions.X)))).
  unfold Errors.reach. lra.
Qed.
Lemma component_bound a : Rabs (along a) <= 1.01.
Proof.
  apply Rnot_lt_le. intro h. assert (1.01 * 1.01 < Rabs (along a) * Rabs (along a)) by (apply Rmult_le_0_lt_compat;
    lra).
  rewrite <- Rabs_mult, Rabs_pos_eq in H by apply squares. unfold squared, sum3 in short_.
  pose proof (squares Expressions.X). pose proof (squares Expressions.Y). pose proof (squares Expressions.Z_).
  destruct a; lra.
Qed.
Definition exact n t := sum3 (fun a => along a * given (Place (Expressions.Coordinate n t a))).
Definition E1 := 9.2 * e1 * B + 14 * l.
Lemma product_near n t : exists x, value_of (product n t) = Number x /\ Rabs (seen x - exact n t) <= E1 /\
  Rabs (seen x) <= 2 * G.
Proof.
  pose proof B_bounds as [B0 BG]. pose proof (G_2 f fine) as G2. pose proof (G_4 f fine) as G4. pose proof (l_pos f)
    as l0.
  pose proof (l_small f ok) as ls. pose proof (e_pos f). pose proof (e_small f ok).
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  assert (places : forall a, operand (value_of (component (point n t) a)) (given (Place (Expressions.Coordinate n t
    a))) B 0 1).
  { intro a. unfold point. rewrite component_each. apply (input_operand _ _ _ _ _ (run (Input _))).
    split; [|split; [apply coordinates|lra]]. unfold Bounds.q. simpl. pose proof (seen_off f env (given (Place
      (Expressions.Coordinate n t a)))). lra. }
  assert (x1 : forall a, 0 <= Rabs (along a) * B <= 1.01 * B).
  { intro a. pose proof (Rabs_pos (along a)). pose proof (component_bound a). split; [apply Rmult_le_pos; lra|].
    apply Rmult_le_compat_r; lra. }
  pose proof (x1 Expressions.X). pose proof (x1 Expressions.Y). pose proof (x1 Expressions.Z_).
  pose proof (component_bound Expressions.X). pose proof (component_bound Expressions.Y).
  pose proof (component_bound Expressions.Z_).
  assert (small : sum3 (fun a => Rabs (along a) * B) <= omega f / 4) by (unfold sum3; lra).
  assert (x : sum3 (fun a => Rabs (along a) * 1 + 0 * B + l * (0 * 1)) <= 3.03) by (unfold sum3; lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 0 along_operand places ltac:(lia) small ltac:(lra)) as (y & Ey & _ & d & _ &
    _).
  exists y. split; [exact Ey|]. fold (exact n t) in d. change (3 + 0 + 0)%nat with 3%nat in d.
  pose proof (q_error 3 ltac:(lia)) as q3. replace (INR 3) with 3 in q3 by (simpl; ring).
  pose proof (seen_off f env y) as off.
  assert (sum3 (fun a => Rabs (along a) * B) <= 3.03 * B) by (unfold sum3; lra).
  assert (0 <= sum3 (fun a => Rabs (along a) * B)) by (unfold sum3; lra).
  assert ((q 3 - 1) * sum3 (fun a => Rabs (along a) * B) <= 3.003 * e1 * (3.03 * B)) by (apply Rmult_le_compat; lra).
  assert (0 <= e1 * B) by (apply Rmult_le_pos; lra).
  assert (l * (1.04 * sum3 (fun a => Rabs (along a) * 1 + 0 * B + l * (0 * 1)) + 9.2) <= l * 12.5) by (apply
    Rmult_le_compat_l; lra).
  assert (A : Rabs (seen y - exact n t) <= E1).
  { replace (seen y - exact n t) with ((seen y - y) + (y - exact n t)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. unfold E1. lra. }
  split; [exact A|]. assert (X : Rabs (exact n t) <= 3.03 * B).
  { eapply Rle_trans; [|exact H7]. unfold exact, sum3. eapply Rle_trans; [apply Rabs_triang|].
    assert (each_ : forall a, Rabs (along a * given (Place (Expressions.Coordinate n t a))) <= Rabs (along a) * B).
    { intro a. rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|apply coordinates]. }
    pose proof (Rabs_triang (along Expressions.X * given (Place (Expressions.Coordinate n t Expressions.X)))
      (along Expressions.Y * given (Place (Expressions.Coordinate n t Expressions.Y)))).
    pose proof (each_ Expressions.X). pose proof (each_ Expressions.Y). pose proof (each_ Expressions.Z_). lra. }
  replace (seen y) with ((seen y - exact n t) + exact n t) by ring. eapply Rle_trans; [apply Rabs_triang|].
  assert (e1 * B <= / 8388608 * B) by (apply Rmult_le_compat_r; lra). unfold E1 in A. lra.
Qed.

(* The lowest and the highest of numbers, as they are seen. *)
Lemma lowest_below t others : forall e x, value_of e = Number x ->
  Rabs (seen x) <= 2 * G ->
  exists y, value_of (fold_left (fun m n => Smaller m (product n t)) others e) = Number y /\ seen y <= seen x /\
    Rabs (seen y) <= 2 * G /\ forall n, In n others -> seen y <= exact n t + E1.
Proof.
  induction others as [|n others IH]; intros e x Ex sx; cbn [fold_left].
  - exists x. split; [exact Ex|]. split; [lra|]. split; [exact sx|intros n []].
  - destruct (product_near n t) as (z & Ez & near_ & sz). apply Rabs_le_inv in near_.
    pose proof (run (Smaller e (product n t))) as h. cbn -[product] in h. rewrite Ex, Ez in h.
    assert (step : exists y, value_of (Smaller e (product n t)) = Number y /\ seen y <= seen x /\ seen y <= seen z /\
      Rabs (seen y) <= 2 * G).
    { unfold smaller, greater, as_it_is in h. cbn in h.
      destruct h as [[g [-> | ->]]|[g [-> | ->]]]; eexists; (split; [reflexivity|]); rewrite ?seen_twice; repeat
        split; lra. }
    destruct step as (y & Ey & yx & yz & sy). destruct (IH _ _ Ey sy) as (w & Ew & wy & sw & all). exists w.
    split; [exact Ew|]. split; [lra|]. split; [exact sw|]. intros k [<-|inside]; [lra|exact (all k inside)].
Qed.
Lemma highest_above t others : forall e x, value_of e = Number x ->
  Rabs (seen x) <= 2 * G ->
  exists y, value_of (fold_left (fun m n => Larger m (product n t)) others e) = Number y /\ seen x <= seen y /\
    Rabs (seen y) <= 2 * G /\ forall n, In n others -> exact n t - E1 <= seen y.
Proof.
  induction others as [|n others IH]; intros e x Ex sx; cbn [fold_left].
  - exists x. split; [exact Ex|]. split; [lra|]. split; [exact sx|intros n []].
  - destruct (product_near n t) as (z & Ez & near_ & sz). apply Rabs_le_inv in near_.
    pose proof (run (Larger e (product n t))) as h. cbn -[product] in h. rewrite Ex, Ez in h.
    assert (step : exists y, value_of (Larger e (product n t)) = Number y /\ seen x <= seen y /\ seen z <= seen y /\
      Rabs (seen y) <= 2 * G).
    { unfold larger, greater, as_it_is in h. cbn in h.
      destruct h as [[g [-> | ->]]|[g [-> | ->]]]; eexists; (split; [reflexivity|]); rewrite ?seen_twice; repeat
        split; lra. }
    destruct step as (y & Ey & yx & yz & sy). destruct (IH _ _ Ey sy) as (w & Ew & wy & sw & all). exists w.
    split; [exact Ew|]. split; [lra|]. split; [exact sw|]. intros k [<-|inside]; [lra|exact (all k inside)].
Qed.

(* The gap as it is computed is at most every exact one, but for twice that error. *)
Lemma gap_parts first second t : first <> [] -> second <> [] -> exists low high,
  value_of (gap first second t) = Number (Rd (low - high)) /\ Rabs low <= 2 * G /\ Rabs high <= 2 * G /\ forall n k,
  In n first -> In k second -> low - high <= exact n t - exact k t + 2 * E1.
Proof.
  pose proof (G_2 f fine). pose proof (G_4 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct first as [|n0 ns]; [intro some; now destruct some|]. destruct second as [|k0 ks]; [intros _ some; now destruct
    some|]. intros _ _.
  destruct (product_near n0 t) as (x & Ex & near_ & sx), (product_near k0 t) as (y & Ey & near_' & sy).
  destruct (lowest_below t ns _ x Ex sx) as (low & El & lx & sl & all).
  destruct (highest_above t ks _ y Ey sy) as (high & Eh & hy & sh & all').
  exists (seen low), (seen high). apply Rabs_le_inv in near_. apply Rabs_le_inv in near_'. split; [|split; [exact
    sl|split; [exact sh|]]].
  - pose proof (run (gap (n0 :: ns) (k0 :: ks) t)) as h. unfold gap, lowest, highest in h |- *.
    cbn -[product fold_left] in h. unfold sum in h.
    change (fold_left (fun m n => Smaller m (product n t)) ns (product n0 t)) with
      (fold_left (fun m n => Smaller m (product n t)) ns (product n0 t)) in h.
    rewrite El, Eh in h. cbn [seen_value] in h. apply (result_number f ok env) in h; [exact h|].
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
  - intros n k inside inside'.
    assert (seen low <= exact n t + E1) by (destruct inside as [<-|inside]; [lra|exact (all n inside)]).
    assert (exact k t - E1 <= seen high) by (destruct inside' as [<-|inside']; [lra|exact (all' k inside')]). lra.
Qed.
Lemma gap_value first second n k t : In n first -> In k second -> exists low high,
  value_of (gap first second t) = Number (Rd (low - high)) /\ low - high <= exact n t - exact k t + 2 * E1.
Proof.
  intros inside inside'. destruct (gap_parts first second t) as (low & high & E & _ & _ & all).
  - intros ->. destruct inside.
  - intros ->. destruct inside'.
  - exists low, high. split; [exact E|exact (all n k inside inside')].
Qed.
(* The exact gap, without what a thread may flush of the direction. *)
Definition truly n t := sum3 (fun a => given (Along 0 a) * given (Place (Expressions.Coordinate n t a))).
Lemma exact_is_near_truly n t : Rabs (exact n t - truly n t) <= 3 * (l * B).
Proof.
  pose proof (l_pos f). assert (one_ : forall a, Rabs (along a * given (Place (Expressions.Coordinate n t a)) - given
    (Along 0 a) * given (Place (Expressions.Coordinate n t a))) <= l * B).
  { intro a. rewrite <- Rmult_minus_distr_r, Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos.
    - apply seen_off.
    - apply coordinates. }
  unfold exact, truly, sum3. pose proof (one_ Expressions.X) as x. pose proof (one_ Expressions.Y) as y.
  pose proof (one_ Expressions.Z_) as z. apply Rabs_le_inv in x, y, z. apply Rabs_le. lra.
Qed.
Lemma error_value : exists E, value_of error_of_gap = Number E /\ seen E = E /\ 31.99 * (e1 * B) + 0.99 * eta <= E <=
  32.01 * (e1 * B) + 1.01 * eta.
Proof.
  pose proof B_bounds as [B0 BG]. pose proof (G_2 f fine) as G2. pose proof (G_4 f fine) as G4. pose proof (l_pos f)
    as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  pose proof (eps_twice f) as eu. pose proof (eta_1 f fine). pose proof (eta_large f fine). pose proof (l_e f fine).
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  assert (oB : operand (value_of (Input (Length LargestCoordinate))) B B 0 1).
  { apply (input_operand _ _ _ _ _ (run (Input _))). unfold near, Bounds.q. simpl.
    pose proof (seen_off f env B). rewrite (Rabs_pos_eq B) by exact B0. lra. }
  pose proof (run (Product (roundoffs 64) (Input (Length LargestCoordinate)))) as h1. cbn -[roundoffs] in h1.
  assert (uB : 0 <= 64 * u * B <= 0.001 * G) by (split; [repeat apply Rmult_le_pos; lra|]; assert (64 * u * B <= 64 *
    u * (/ 4 * G)) by (apply Rmult_le_compat_l; lra); assert (u * G <= / 16777216 * G) by (apply Rmult_le_compat_r;
      lra); lra).
  pose proof (product_holds h1 (seen_holds (here Directions.roundoffs_holds 64%Z ltac:(lia)))
    oB ltac:(lia) ltac:(lra) ltac:(lra)) as r1.
  assert (on : operand (value_of (Constant Underflow)) eta eta 0 0).
  { rewrite constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq eta) at 3 by lra. apply operand_normal.
    rewrite Rabs_pos_eq; lra. }
  pose proof (run error_of_gap) as h2. unfold error_of_gap in h2. cbn -[roundoffs] in h2.
  pose proof (sum_holds Rplus 2 ltac:(auto) h2 (seen_holds r1) on ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra)
    ltac:(lra)) as (E & EE & _ & d & _ & _). fold error_of_gap in EE. exists E. split; [exact EE|].
  pose proof (q_error 3 ltac:(lia)) as q3. replace (INR 3) with 3 in q3 by (simpl; ring).
  replace (64 * u * B) with (32 * (e1 * B)) in * by (rewrite eu; ring).
  assert ((q 3 - 1) * (32 * (e1 * B) + eta) <= 0.00001 * (32 * (e1 * B) + eta)) by (apply Rmult_le_compat_r; lra).
  assert (lB : 0 <= l * B <= / 1099511627776 * (e1 * B)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * B)) with (/ 1099511627776 * e1 * B) by ring. apply Rmult_le_compat_r; lra. }
  match type of d with _ <= _ + _ * ?a => assert (la : l * a <= l * (2.2 * B + 4)) by (apply Rmult_le_compat_l; lra)
    end.
  apply Rabs_le_inv in d. assert (b : 31.99 * (e1 * B) + 0.99 * eta <= E <= 32.01 * (e1 * B) + 1.01 * eta) by lra.
  split; [|exact b]. apply seen_of_normal. rewrite Rabs_pos_eq; lra.
Qed.
Lemma sizes : 0 <= e1 * B <= / 8388608 * B /\ 0 <= e1 * (e1 * B) <= / 8388608 * (e1 * B) /\
  0 <= l * B <= / 1099511627776 * (e1 * B) /\ 512 * l <= eta <= 1 /\ 0 <= e1 * eta <= / 8388608 * eta /\ 0 <= e1 * l <=
  / 8388608 * l.
Proof.
  pose proof B_bounds as [B0 BG]. pose proof (l_pos f). pose proof (e_pos f). pose proof (e_small f ok).
  pose proof (eta_large f fine). pose proof (eta_1 f fine). pose proof (l_e f fine) as le.
  assert (e_ : forall x, 0 <= x -> 0 <= e1 * x <= / 8388608 * x) by (intros x x0; split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  repeat split; try apply e_; try lra; try apply (e_ _ B0); try (apply Rmult_le_pos; lra).
  replace (/ 1099511627776 * (e1 * B)) with (/ 1099511627776 * e1 * B) by ring. apply Rmult_le_compat_r; lra.
Qed.
(* A positive gap less its error is at most every exact one, but for a rounding. *)
Lemma less_error_value first second : first <> [] -> second <> [] -> exists g, value_of (less_error first second) = Number g
  /\ Rabs (seen g) <= 10 * G /\ (0 < seen g -> forall n k, In n first -> In k second -> seen g <= (1 + 2.1 * e1) * (truly n
    Expressions.End - truly k Expressions.End)).
Proof.
  intros some some'. pose proof sizes as (eB & eeB & lB & et & ee & el). pose proof B_bounds as [B0 BG].
  pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  pose proof (G_2 f fine). pose proof (G_4 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct error_value as (E & EE & sE & E1_ & E2_).
  destruct (gap_parts first second Expressions.End some some') as (low & high & Eg & lowb & highb & bound).
  set (z := low - high) in *. assert (zb : Rabs z <= 4 * G).
  { unfold z. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  pose proof (run (less_error first second)) as h. unfold less_error in h. cbn -[gap error_of_gap] in h.
  rewrite Eg, EE in h. cbn in h. rewrite sE in h. fold (less_error first second) in h.
  pose proof (error f ok env z) as er. pose proof (seen_smaller f env (Rd z)) as sz. pose proof (seen_off f env (Rd z)) as
    so.
  assert (ez : e1 * Rabs z <= / 8388608 * Rabs z) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (Rabs (Rd z) <= 4.1 * G).
  { replace (Rd z) with (z + (Rd z - z)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  set (y := seen (Rd z) - E) in *. assert (yb : Rabs y <= 5 * G).
  { unfold y. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq E) by lra. lra. }
  apply (result_number f ok env) in h; [|lra]. exists (Rd y). split; [exact h|].
  pose proof (error f ok env y) as ey. pose proof (seen_smaller f env (Rd y)) as sy.
  assert (eyb : e1 * Rabs y <= / 8388608 * Rabs y) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  split.
  { eapply Rle_trans; [exact sy|]. replace (Rd y) with (y + (Rd y - y)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    lra. }
  intros pos n k inside inside'. pose proof (bound n k inside inside') as b.
  pose proof (exact_is_near_truly n Expressions.End) as tn. pose proof (exact_is_near_truly k Expressions.End) as tk.
  apply Rabs_le_inv in tn, tk. set (D := truly n Expressions.End - truly k Expressions.End).
  assert (y0 : 0 < y). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r.
    pose proof (seen_monotone f env _ _ r) as s0. rewrite seen_0 in s0. lra. }
  assert (z0 : 0 < z). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r.
    pose proof (seen_monotone f env _ _ r) as s0. rewrite seen_0 in s0. unfold y in y0. lra. }
  rewrite (Rabs_pos_eq z) in * by lra. rewrite (Rabs_pos_eq y) in * by lra. apply Rabs_le_inv in er, ey, so.
  assert (zD : z <= D + 18.5 * (e1 * B) + 30 * l) by (unfold D, E1 in *; lra).
  assert (e1 * z <= e1 * (D + 18.5 * (e1 * B) + 30 * l)) by (apply Rmult_le_compat_l; lra).
  assert (yD : y <= (1 + e1) * D - 10 * l) by (unfold y; lra).
  assert (e1 * y <= e1 * ((1 + e1) * D - 10 * l)) by (apply Rmult_le_compat_l; lra).
  assert (D0 : 0 <= D). { apply Rnot_lt_le. intro neg. assert (e1 * D <= 0) by (assert (0 <= e1 * - D) by (apply
    Rmult_le_pos; lra); lra). lra. }
  assert (0 <= e1 * (e1 * D) <= / 8388608 * (e1 * D)). { assert (0 <= e1 * D) by (apply Rmult_le_pos; lra).
    split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]. }
  pose proof (seen_positive f env (Rd y) pos) as same_. rewrite same_. lra.
Qed.
(* The threshold. *)
Lemma threshold_value : exists T, value_of threshold = Number T /\
  (1 - 4.01 * e1) * (m * (sigma * sigma) + 32 * e1 * B + eta) - l * (2.1 * m + 2.2 * B + 11) <= T.
Proof.
  pose proof B_bounds as [B0 BG]. pose proof (G_2 f fine) as G2. pose proof (G_4 f fine) as G4. pose proof (l_pos f)
    as l0.
  pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  pose proof (eps_twice f) as eu. pose proof (eta_1 f fine). pose proof (eta_large f fine).
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra). destruct separation as [m0 m1].
  assert (mG : m <= / 4 * G) by (unfold Errors.reach; lra).
  assert (length_ : forall i, 0 <= given (Length i) -> operand (value_of (Input (Length i))) (given (Length i)) (given
    (Length i)) 0 1).
  { intros i pos. apply (input_operand _ _ _ _ _ (run (Input _))). unfold near, Bounds.q. simpl.
    pose proof (seen_off f env (given (Length i))). rewrite (Rabs_pos_eq (given _)) by exact pos. lra. }
  assert (ss : 1 <= sigma * sigma <= 1.00001) by (unfold sigma; lra).
  (* The error. *)
  pose proof (run (Product (roundoffs 64) (Input (Length LargestCoordinate)))) as h1. cbn -[roundoffs] in h1.
  assert (uB : 0 <= 64 * u * B <= 0.001 * G) by (split; [repeat apply Rmult_le_pos; lra|]; assert (64 * u * B <= 64 *
    u * (/ 4 * G)) by (apply Rmult_le_compat_l; lra); assert (u * G <= / 16777216 * G) by (apply Rmult_le_compat_r;
      lra); lra).
  pose proof (product_holds h1 (seen_holds (here Directions.roundoffs_holds 64%Z ltac:(lia)))
    (length_ LargestCoordinate B0) ltac:(lia) ltac:(lra) ltac:(lra)) as r1.
  assert (on : operand (value_of (Constant Underflow)) eta eta 0 0).
  { rewrite constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq eta) at 3 by lra. apply operand_normal.
    rewrite Rabs_pos_eq; lra. }
  pose proof (run error_of_gap) as h2. unfold error_of_gap in h2. cbn -[roundoffs] in h2.
  pose proof (sum_holds Rplus 2 ltac:(auto) h2 (seen_holds r1) on ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra)
    ltac:(lra)) as r2. fold error_of_gap in r2.
  (* The separation. *)
  pose proof (run (Product slack slack)) as h3. cbn -[slack] in h3.
  pose proof (product_holds h3 slack_operand slack_operand ltac:(lia) ltac:(lra) ltac:(lra)) as r3.
  pose proof (run (Product (Input (Length Separation)) (Product slack slack))) as h4. cbn -[slack] in h4.
  assert (mss : 0 <= m * (sigma * sigma) <= 1.00001 * (/ 4 * G)) by (split; [apply Rmult_le_pos; lra|];
    rewrite (Rmult_comm m); apply Rmult_le_compat; lra).
  pose proof (product_holds h4 (length_ Separation m0) (seen_holds r3) ltac:(lia) ltac:(lra) ltac:(lra)) as r4.
  pose proof (run threshold) as h5. unfold threshold in h5. cbn -[slack error_of_gap] in h5.
  pose proof (sum_holds Rplus 3 ltac:(auto) h5 (seen_holds r4) (seen_holds r2) ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lra)
    ltac:(lra)) as (T & ET & _ & d & _ & _).
  exists T. split; [exact ET|]. apply Rabs_le_inv in d. destruct d as [d _].
  replace (64 * u * B) with (32 * e1 * B) in * by (rewrite eu; ring).
  set (X := m * (sigma * sigma) + (32 * e1 * B + eta)) in *.
  pose proof (q_error 4 ltac:(lia)) as q4. replace (INR 4) with 4 in q4 by (simpl; ring).
  assert (X0 : 0 <= X) by (unfold X; lra). assert ((q 4 - 1) * X <= 4.01 * e1 * X) by (apply Rmult_le_compat_r; lra).
  change (S 3) with 4%nat in d.
  lazymatch type of d with - (_ + _ * ?a) <= _ => assert (la : l * a <= l * (2.1 * m + 2.2 * B + 11)) end.
  { apply Rmult_le_compat_l; [lra|]. assert (l * 2 <= 0.001) by lra. lra. }
  unfold X in *. lra.
Qed.
Notation length_ := (sqrt squared).
Theorem beyond_the_threshold first second n k t : says f env value_of (Greater (gap first second t) threshold) ->
  In n first -> In k second -> m * length_ < exact n t - exact k t.
Proof.
  intros h inside inside'. destruct (gap_value first second n k t inside inside') as (low & high & Eg & bound).
  destruct threshold_value as (T & ET & big). cbn in h. rewrite Eg, ET in h. cbn in h.
  pose proof B_bounds as [B0 BG]. pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as
    e0.
  pose proof (e_small f ok) as es. pose proof (eta_large f fine). pose proof (eta_1 f fine). pose proof (l_e f fine)
    as le.
  destruct separation as [m0 m1]. set (z := low - high) in *.
  assert (eB : 0 <= e1 * B <= / 8388608 * B) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eeB : 0 <= e1 * (e1 * B) <= / 8388608 * (e1 * B)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (em : 0 <= e1 * m <= / 8388608 * m) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (ee : e1 * eta <= / 8388608 * eta) by (apply Rmult_le_compat_r; lra).
  assert (lB : 0 <= l * B <= / 1099511627776 * (e1 * B)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * B)) with (/ 1099511627776 * e1 * B) by ring. apply Rmult_le_compat_r; lra. }
  assert (lm : 0 <= l * m <= / 1099511627776 * m) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  unfold sigma in big.
  assert (Tl : l <= T) by lra. rewrite (seen_of_normal f env T) in h by (rewrite Rabs_pos_eq; lra).
  rewrite (seen_positive f env (Rd z)) in h by lra.
  assert (z0 : 0 < z). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r.
    lra. }
  pose proof (error f ok env z) as er. rewrite (Rabs_pos_eq z) in er by lra. apply Rabs_le_inv in er.
  assert (L1 : length_ <= 1 + 0.8 * / 1048576).
  { rewrite <- (sqrt_square (1 + 0.8 * / 1048576)) by lra. apply sqrt_le_1_alt. lra. }
  assert (mL : m * length_ <= m * (1 + 0.8 * / 1048576)) by (apply Rmult_le_compat_l; lra).
  apply Rnot_le_lt. intro less. set (D := exact n t - exact k t) in *.
  assert (zz : z <= m * (1 + 0.8 * / 1048576) + 2 * E1) by lra.
  assert (e1 * z <= e1 * (m * (1 + 0.8 * / 1048576) + 2 * E1)) by (apply Rmult_le_compat_l; lra).
  unfold E1 in *. lra.
Qed.

(* The same of any number that exceeds the threshold and is, but for a rounding, at most the exact gap. *)
Theorem a_number_beyond_the_threshold e x n k t : value_of e = Number x -> says f env value_of (Greater e threshold) ->
  (0 < seen x -> seen x <= (1 + 2.1 * e1) * (truly n t - truly k t)) -> m * length_ < exact n t - exact k t.
Proof.
  intros Ex h below. destruct threshold_value as (T & ET & big). cbn in h. rewrite Ex, ET in h. cbn in h.
  pose proof sizes as (eB & eeB & lB & et & ee & el). pose proof B_bounds as [B0 BG].
  pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  destruct separation as [m0 m1].
  assert (em : 0 <= e1 * m <= / 8388608 * m) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lm : 0 <= l * m <= / 1099511627776 * m) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  unfold sigma in big. assert (Tl : (1 + 1.4 * / 1048576) * m + 31 * (e1 * B) + 400 * l <= T) by lra.
  rewrite (seen_of_normal f env T) in h by (rewrite Rabs_pos_eq; lra). specialize (below ltac:(lra)).
  pose proof (exact_is_near_truly n t) as tn. pose proof (exact_is_near_truly k t) as tk. apply Rabs_le_inv in tn, tk.
  assert (L1 : length_ <= 1 + 0.8 * / 1048576).
  { rewrite <- (sqrt_square (1 + 0.8 * / 1048576)) by lra. apply sqrt_le_1_alt. lra. }
  assert (mL : m * length_ <= m * (1 + 0.8 * / 1048576)) by (apply Rmult_le_compat_l; lra).
  apply Rnot_le_lt. intro less. set (D := truly n t - truly k t) in *.
  assert (DD : D <= m * (1 + 0.8 * / 1048576) + 6 * (l * B)) by (unfold D; lra).
  apply (Rmult_le_compat_l (1 + 2.1 * e1)) in DD; [|lra].
  assert (e1 * (l * B) <= 1 * (l * B)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
(* What is stored, and then converted to another format g: if it is positive, it is at most every exact gap. *)
Theorem stored_is_below first second (g : constants) (env' : environment g) : reasonable_constants g ->
  power (extent_underflow f) <= given (Length LeastGap) <= 1 -> power (extent_underflow g) <= given (Length LeastGap) ->
  first <> [] -> second <> [] -> exists x, value_of (stored first second) = Number x /\ (0 < rounded env' (seen x) ->
    forall n k, In n first -> In k second -> rounded env' (seen x) <= truly n Expressions.End - truly k Expressions.End).
Proof.
  intros fine' [least_f least_1] least_g some some'. set (least := given (Length LeastGap)) in *.
  pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  pose proof (l_pos g). pose proof (e_pos g). pose proof (e_small g (reasonable_base g fine')) as es'.
  pose proof (mu_l f fine) as ml. pose proof (mu_l g fine') as ml'. pose proof (G_2 f fine). pose proof (G_4 f fine).
  assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct (less_error_value first second some some') as (v & Ev & vb & below).
  set (part := Quotient (less_error first second) slack). pose proof (run part) as hq. unfold part in hq.
  cbn -[less_error slack is_positive_unrounded] in hq. fold part in hq. rewrite Ev in hq. unfold slack in hq at 1.
  rewrite (run (Input _)), the_slack in hq. cbn -[is_positive_unrounded] in hq. rewrite sigma_normal in hq.
  destruct hq as [hq _]. specialize (hq ltac:(unfold sigma; lra)). set (z := seen v / sigma) in *.
  assert (zs : z * sigma = seen v) by (unfold z; field; unfold sigma; lra).
  assert (zb : Rabs z <= 10 * G).
  { replace z with (seen v * / sigma) by reflexivity. rewrite Rabs_mult.
    assert (i1 : 0 < / sigma <= 1). { split; [apply Rinv_0_lt_compat; unfold sigma; lra|].
      rewrite <- Rinv_1. apply Rinv_le; unfold sigma; lra. }
    rewrite (Rabs_pos_eq (/ sigma)) by lra. rewrite <- (Rmult_1_r (10 * G)).
    apply Rmult_le_compat; try apply Rabs_pos; lra. }
  apply (result_number f ok env) in hq; [|lra]. set (q_ := Rd z) in *.
  pose proof (run (stored first second)) as h. unfold stored in h. fold part in h. cbn -[says part] in h.
  assert (least_ : seen least = least) by (apply seen_of_normal; rewrite Rabs_pos_eq; lra).
  destruct h as [[big h]|[_ h]].
  - cbn -[part] in big. rewrite hq, (run (Input _)) in big. cbn in big. fold least in big. rewrite least_ in big.
    pose proof (run (Smaller part (Input (Length LargestGap)))) as hs. cbn -[part] in hs.
    rewrite hq, (run (Input (Length LargestGap))) in hs.
    assert (kept : exists x, value_of (Smaller part (Input (Length LargestGap))) = Number x /\ seen x <= seen q_).
    { unfold smaller, greater, as_it_is in hs. cbn in hs.
      destruct hs as [[less [-> | ->]]|[less [-> | ->]]]; eexists; (split; [reflexivity|]); rewrite ?seen_twice; lra. }
    destruct kept as (x & Ex & xq). exists x. split; [exact (eq_trans h Ex)|]. intros _ n k inside inside'.
    eapply Rle_trans; [apply (monotone env'), xq|]. rewrite (seen_positive f env q_) in * by lra.
    assert (z0 : 0 < z). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r.
      unfold q_ in *. lra. }
    assert (v0 : 0 < seen v) by (rewrite <- zs; apply Rmult_lt_0_compat; unfold sigma; lra).
    specialize (below v0 n k inside inside'). set (D := truly n Expressions.End - truly k Expressions.End) in *.
    assert (D0 : 0 <= D). { apply Rnot_lt_le. intro neg. assert (0 <= (1 + 2.1 * e1) * - D) by (apply Rmult_le_pos; lra).
      lra. }
    pose proof (error f ok env z) as er. rewrite (Rabs_pos_eq z) in er by lra. apply Rabs_le_inv in er. fold q_ in er.
    pose proof (error g (reasonable_base g fine') env' q_) as er'. rewrite (Rabs_pos_eq q_) in er' by lra.
    apply Rabs_le_inv in er'.
    assert (e1 * z <= / 8388608 * z) by (apply Rmult_le_compat_r; lra).
    assert (eps g * q_ <= / 8388608 * q_) by (apply Rmult_le_compat_r; lra).
    assert (e1 * D <= / 8388608 * D) by (apply Rmult_le_compat_r; lra). unfold sigma in zs. lra.
  - pose proof (run (Smaller part (Constant (Small 0)))) as hs. cbn -[part] in hs. rewrite hq, constant in hs.
    assert (kept : exists x, value_of (Smaller part (Constant (Small 0))) = Number x /\ seen x <= 0).
    { unfold smaller, greater, as_it_is in hs. cbn in hs. rewrite seen_0 in hs.
      destruct hs as [[less [-> | ->]]|[less [-> | ->]]]; eexists; (split; [reflexivity|]); rewrite ?seen_twice,
        ?seen_0; lra. }
    destruct kept as (x & Ex & x0). exists x. split; [exact (eq_trans h Ex)|]. intro pos.
    pose proof (monotone env' _ _ x0) as r. rewrite (rounded_0 g env') in r. lra.
Qed.
(* A positive distance, times σ, is at most every exact gap at the end: no gap is more than 3.5 B, so that its roundings are
   a part of the error. *)
Lemma exact_bound n t : Rabs (exact n t) <= 1.74 * B.
Proof.
  pose proof B_bounds as [B0 _]. set (x := Rabs (along Expressions.X)). set (y := Rabs (along Expressions.Y)).
  set (z := Rabs (along Expressions.Z_)).
  assert (S : x + y + z <= 1.74).
  { assert (sq : x * x + y * y + z * z <= 1.00001).
    { unfold squared, sum3 in short_. unfold x, y, z. rewrite <- !Rabs_mult, !Rabs_pos_eq by apply squares. lra. }
    pose proof (pow2_ge_0 (x - y)). pose proof (pow2_ge_0 (y - z)). pose proof (pow2_ge_0 (x - z)).
    apply Rnot_lt_le. intro h. assert (1.74 * 1.74 < (x + y + z) * (x + y + z)) by (apply Rmult_le_0_lt_compat; lra).
    lra. }
  assert (one_ : forall a, Rabs (along a * given (Place (Expressions.Coordinate n t a))) <= Rabs (along a) * B).
  { intro a. rewrite Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|apply coordinates]. }
  unfold exact, sum3. eapply Rle_trans; [apply Rabs_triang|]. pose proof (one_ Expressions.Z_).
  pose proof (Rabs_triang (along Expressions.X * given (Place (Expressions.Coordinate n t Expressions.X)))
    (along Expressions.Y * given (Place (Expressions.Coordinate n t Expressions.Y)))).
  pose proof (one_ Expressions.X). pose proof (one_ Expressions.Y).
  apply Rle_trans with ((x + y + z) * B); [unfold x, y, z; lra|apply Rmult_le_compat_r; lra].
Qed.
Theorem distance_is_below first second : first <> [] -> second <> [] -> exists x, value_of (distance first second) = Number x
  /\ (0 < x -> forall n k, In n first -> In k second -> x * sigma <= exact n Expressions.End - exact k Expressions.End).
Proof.
  intros some some'. pose proof sizes as (eB & eeB & lB & et & ee & el). pose proof B_bounds as [B0 BG].
  pose proof (l_pos f) as l0. pose proof (l_small f ok) as ls. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
  pose proof (G_2 f fine). pose proof (G_4 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  destruct error_value as (E & EE & sE & E1_ & E2_).
  destruct (gap_parts first second Expressions.End some some') as (low & high & Eg & lowb & highb & bound).
  set (z := low - high) in *. assert (zb : Rabs z <= 4 * G).
  { unfold z. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  pose proof (error f ok env z) as er. pose proof (seen_smaller f env (Rd z)) as sz.
  assert (ez : e1 * Rabs z <= / 8388608 * Rabs z) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (gb : Rabs (Rd z) <= 4.1 * G).
  { replace (Rd z) with (z + (Rd z - z)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  set (g := seen (Rd z)) in *. set (part := Quotient (gap first second Expressions.End) slack).
  pose proof (run part) as hq. unfold part in hq. cbn -[gap slack is_positive_unrounded] in hq. fold part in hq.
  rewrite Eg in hq. unfold slack in hq at 1. rewrite (run (Input _)), the_slack in hq. cbn -[is_positive_unrounded] in hq.
  rewrite sigma_normal in hq. destruct hq as [hq _]. specialize (hq ltac:(unfold sigma; lra)). fold g in hq.
  set (y := g / sigma) in *. assert (ys : y * sigma = g) by (unfold y; field; unfold sigma; lra).
  assert (i1 : 0 < / sigma <= 1). { split; [apply Rinv_0_lt_compat; unfold sigma; lra|].
    rewrite <- Rinv_1. apply Rinv_le; unfold sigma; lra. }
  assert (yb : Rabs y <= 4.1 * G).
  { replace y with (g * / sigma) by reflexivity. rewrite Rabs_mult. rewrite (Rabs_pos_eq (/ sigma)) by lra.
    rewrite <- (Rmult_1_r (4.1 * G)). apply Rmult_le_compat; try apply Rabs_pos; lra. }
  apply (result_number f ok env) in hq; [|lra]. set (q_ := Rd y) in *.
  pose proof (error f ok env y) as ey. fold q_ in ey. pose proof (seen_smaller f env q_) as sq.
  assert (ey' : e1 * Rabs y <= / 8388608 * Rabs y) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (qb : Rabs q_ <= 4.2 * G).
  { replace q_ with (y + (q_ - y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  pose proof (run (distance first second)) as h. unfold distance in h. fold part in h. cbn -[part error_of_gap] in h.
  rewrite hq, EE in h. cbn in h. rewrite sE in h. set (d := seen q_ - E) in *.
  assert (db : Rabs d <= 5 * G).
  { unfold d. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq E) by lra. lra. }
  apply (result_number f ok env) in h; [|lra]. exists (Rd d). split; [exact h|]. intros pos n k inside inside'.
  pose proof (error f ok env d) as ed. pose proof (bound n k inside inside') as b.
  pose proof (exact_bound n Expressions.End) as bn. pose proof (exact_bound k Expressions.End) as bk.
  apply Rabs_le_inv in bn, bk. set (X := exact n Expressions.End - exact k Expressions.End) in *.
  assert (XB : X <= 3.48 * B) by (unfold X; lra).
  assert (d0 : 0 < d). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r. lra. }
  assert (sq0 : 0 < seen q_) by (unfold d in d0; lra). pose proof (seen_positive f env q_ sq0) as same_q.
  assert (y0 : 0 < y). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r.
    unfold q_ in *. lra. }
  assert (g0 : 0 < g) by (rewrite <- ys; apply Rmult_lt_0_compat; unfold sigma; lra).
  pose proof (seen_positive f env (Rd z) g0) as same_g. fold g in same_g.
  assert (z0 : 0 < z). { apply Rnot_le_lt. intro neg. pose proof (monotone env _ _ neg) as r. rewrite rounded_0 in r. lra. }
  rewrite (Rabs_pos_eq z) in * by lra. rewrite (Rabs_pos_eq y) in * by lra. rewrite (Rabs_pos_eq d) in * by lra.
  apply Rabs_le_inv in er, ey, ed.
  assert (zX : z <= X + 18.5 * (e1 * B) + 28 * l) by (unfold E1 in *; lra).
  assert (e1 * z <= e1 * (3.48 * B + 18.5 * (e1 * B) + 28 * l)) by (apply Rmult_le_compat_l; lra).
  assert (gX : g <= X + 22.1 * (e1 * B) + 30 * l) by lra.
  assert (yg : y <= g). { rewrite <- ys. rewrite <- (Rmult_1_r y) at 1. apply Rmult_le_compat_l; unfold sigma; lra. }
  assert (e1 * y <= e1 * (3.49 * B + 31 * l)) by (apply Rmult_le_compat_l; lra).
  assert (dy : d <= y + 3.5 * (e1 * B) + 2 * l - E) by (unfold d; lra).
  assert (e1 * d <= e1 * (3.5 * B + 40 * l)) by (apply Rmult_le_compat_l; lra).
  assert (x1 : Rd d <= y - 24.8 * (e1 * B) - 400 * l) by lra.
  apply (Rmult_le_compat_r sigma) in x1; [|unfold sigma; lra]. unfold sigma in *. lra.
Qed.
(* Geometry: sets that are ahead by more than that of each other stay more than the separation apart. *)
Definition w := Point (along Expressions.X) (along Expressions.Y) (along Expressions.Z_).
Lemma beyond_is_farther D M : m * length_ < M -> M <= dot w D -> m ^ 2 < Certificates.length_squared D.
Proof.
  intros big ahead. destruct separation as [m0 _]. unfold Certificates.length_squared.
  assert (schwarz : dot w D ^ 2 <= dot w w * dot D D).
  { unfold dot. pose proof (pow2_ge_0 (x w * y D - y w * x D)). pose proof (pow2_ge_0 (y w * z D - z w * y D)).
    pose proof (pow2_ge_0 (z w * x D - x w * z D)). nra. }
  assert (ww : dot w w = squared) by (unfold dot, squared, sum3, w; cbn; ring).
  assert (s0 : 0 <= squared) by (unfold squared, sum3; pose proof squares; repeat apply Rplus_le_le_0_compat; auto).
  pose proof (sqrt_pos squared) as L0. pose proof (sqrt_sqrt squared s0) as LL. rewrite ww in schwarz.
  assert (mL : 0 <= m * length_) by (apply Rmult_le_pos; lra).
  assert (less : (m * length_) * (m * length_) < dot w D * dot w D) by (apply Rmult_le_0_lt_compat; lra).
  replace ((m * length_) * (m * length_)) with (squared * m ^ 2) in less by (rewrite <- LL at 1; ring).
  destruct (Req_dec squared 0) as [none|some]; [rewrite none in *; lra|].
  apply Rmult_lt_reg_l with squared; lra.
Qed.
Lemma as_far x D : 0 < x -> x * sigma <= dot w D -> x ^ 2 <= Certificates.length_squared D.
Proof.
  intros x0 ahead. unfold Certificates.length_squared.
  assert (schwarz : dot w D ^ 2 <= dot w w * dot D D).
  { unfold dot. pose proof (pow2_ge_0 (Geometry.x w * Geometry.y D - Geometry.y w * Geometry.x D)). pose proof
    (pow2_ge_0 (Geometry.y w * Geometry.z D - Geometry.z w * Geometry.y D)).
    pose proof (pow2_ge_0 (Geometry.z w * Geometry.x D - Geometry.x w * Geometry.z D)). lra. }
  assert (ww : dot w w = squared) by (unfold dot, squared, sum3, w; cbn; ring). rewrite ww in schwarz.
  assert (s2 : squared <= sigma * sigma) by (unfold sigma; lra).
  assert (D0 : 0 <= dot D D). { unfold dot. pose proof (Rle_0_sqr (Geometry.x D)). pose proof (Rle_0_sqr (Geometry.y D)).
    pose proof (Rle_0_sqr (Geometry.z D)). unfold Rsqr in *. lra. }
  assert (less : (x * sigma) * (x * sigma) <= dot w D * dot w D) by (apply Rmult_le_compat; try apply Rmult_le_pos;
    unfold sigma in *; lra).
  assert (squared * dot D D <= sigma * sigma * dot D D) by (apply Rmult_le_compat_r; lra).
  apply Rmult_le_reg_l with (sigma * sigma); [unfold sigma; lra|]. lra.
Qed.
Lemma common_bound b xs : (forall x, In x xs -> b < x) -> exists M, b < M /\ forall x, In x xs -> M <= x.
Proof.
  induction xs as [|x xs IH]; intro all; [exists (b + 1); split; [lra|intros x []]|].
  destruct IH as (M & bM & below); [intros; apply all; now right|]. exists (Rmin M x). split.
  - apply Rmin_glb_lt; [exact bM|apply all; now left].
  - intros y [<-|inside]; [apply Rmin_r|]. eapply Rle_trans; [apply Rmin_l|exact (below y inside)].
Qed.
Variable place : Expressions.coordinate -> R.
Hypothesis same : forall c, given (Place c) = place c.
Notation path := (Apart.path_of place).
Lemma ahead_of_each first second : (forall n k t, In n first -> In k second -> m * length_ < exact n t - exact k t) ->
  exists M, m * length_ < M /\
  forall n k t, In n first -> In k second -> 0 <= t <= 1 -> Certificates.ahead_by M w (at_ (path n) t) (at_ (path k) t).
Proof.
  intro beyond.
  set (pairs := list_prod first second). set (difference t (p : nat * nat) := exact (fst p) t - exact (snd p) t).
  destruct (common_bound (m * length_) (map (difference Expressions.Start) pairs ++ map (difference Expressions.End)
    pairs)) as (M & bM & below).
  { intros d inside. apply in_app_or in inside as [inside|inside]; apply in_map_iff in inside as ((n & k) & <- &
    inside);
      apply in_prod_iff in inside as [? ?].
    - now apply beyond.
    - now apply beyond. }
  exists M. split; [exact bM|]. intros n k t inn ink time.
  assert (inside : In (n, k) pairs) by (apply in_prod; assumption).
  apply (Certificates.held_direction M w (path n) (path k) 0 1 t time).
  - pose proof (below (difference Expressions.Start (n, k)) ltac:(apply in_or_app; left; now apply in_map)) as h.
    unfold Certificates.ahead_by. replace (dot w _) with (difference Expressions.Start (n, k)); [exact h|].
    unfold difference, exact, sum3, dot, minus, at_, plus, scaled, w; cbn. rewrite !same. ring.
  - pose proof (below (difference Expressions.End (n, k)) ltac:(apply in_or_app; right; now apply in_map)) as h.
    unfold Certificates.ahead_by. replace (dot w _) with (difference Expressions.End (n, k)); [exact h|].
    unfold difference, exact, sum3, dot, minus, at_, plus, scaled, w; cbn. rewrite !same. ring.
Qed.
(* By the gaps at both ends; or by a stored gap, which is at most the exact one at the start, and the gap at the end. *)
Lemma kept_is_beyond first second : says f env value_of (keeps first second) -> forall n k t, In n first -> In k second ->
  m * length_ < exact n t - exact k t.
Proof. intros [late early] n k [|] inside inside'; eapply beyond_the_threshold; eassumption. Qed.
Definition is_below first second gap_ t := 0 < gap_ -> forall n k, In n first -> In k second -> gap_ <= truly n t - truly k
  t.
Lemma lasting_is_beyond first second : is_below first second (given (Length StoredGap)) Expressions.Start ->
  says f env value_of (lasts first second) -> forall n k t, In n first -> In k second -> m * length_ < exact n t - exact k
  t.
Proof.
  intros below [early late] n k t inside inside'. pose proof (e_pos f).
  assert (some : first <> []) by (intros ->; destruct inside). assert (some' : second <> []) by (intros ->; destruct
    inside').
  destruct t.
  - apply (a_number_beyond_the_threshold _ _ n k _ (run (Input (Length StoredGap))) early). intro pos.
    pose proof (seen_positive f env _ pos) as same_. rewrite same_ in pos |- *. specialize (below pos n k inside inside').
    assert (0 <= e1 * (truly n Expressions.Start - truly k Expressions.Start)) by (apply Rmult_le_pos; lra). lra.
  - destruct (less_error_value first second some some') as (g & Eg & _ & below_).
    apply (a_number_beyond_the_threshold _ _ n k _ Eg late). intro pos. now apply below_.
Qed.
Lemma exact_at_the_end n k : exact n Expressions.End - exact k Expressions.End = dot w (minus (at_ (path n) 1) (at_ (path k)
  1)).
Proof. unfold exact, sum3, dot, minus, at_, plus, scaled, w; cbn. rewrite !same. ring. Qed.
Theorem distance_of_a_vertex_and_a_face x : value_of (distance [0%nat] [1%nat; 2%nat; 3%nat]) = Number x -> 0 < x ->
  forall i j r, 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> x ^ 2 <= Certificates.length_squared (minus (at_ (path 0) 1)
    (plus (scaled i (at_ (path 1) 1)) (plus (scaled j (at_ (path 2) 1)) (scaled r (at_ (path 3) 1))))).
Proof.
  intros Ex x0 i j r i0 j0 r0 one_.
  destruct (distance_is_below [0%nat] [1%nat; 2%nat; 3%nat]) as (y & Ey & below); try discriminate.
  rewrite Ex in Ey. injection Ey as <-. apply (as_far x _ x0). apply Certificates.ahead_of_the_triangle; auto;
    unfold Certificates.ahead_by; rewrite <- exact_at_the_end; apply below; cbn; auto.
Qed.
Theorem distance_of_two_edges x : value_of (distance [0%nat; 1%nat] [2%nat; 3%nat]) = Number x -> 0 < x ->
  forall i r, 0 <= i <= 1 -> 0 <= r <= 1 -> x ^ 2 <= Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (path 0) 1)) (scaled i (at_ (path 1) 1)))
    (plus (scaled (1 - r) (at_ (path 2) 1)) (scaled r (at_ (path 3) 1)))).
Proof.
  intros Ex x0 i r i01 r01. destruct (distance_is_below [0%nat; 1%nat] [2%nat; 3%nat]) as (y & Ey & below); try
    discriminate.
  rewrite Ex in Ey. injection Ey as <-. apply (as_far x _ x0). apply Certificates.between_two_ahead; auto;
    unfold Certificates.ahead_by; rewrite <- exact_at_the_end; apply below; cbn; auto.
Qed.
Theorem beyond_vertex_and_face : (forall n k t, In n [0%nat] -> In k [1%nat; 2%nat; 3%nat] -> m * length_ < exact n t -
  exact k t) -> forall t, 0 <= t <= 1 ->
  forall i j r, 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 -> m ^ 2 < Certificates.length_squared (minus (at_ (path
    0) t)
    (plus (scaled i (at_ (path 1) t)) (plus (scaled j (at_ (path 2) t)) (scaled r (at_ (path 3) t))))).
Proof.
  intros beyond t time i j r i0 j0 r0 one_. destruct (ahead_of_each _ _ beyond) as (M & bM & ahead).
  apply (beyond_is_farther _ M bM). apply Certificates.ahead_of_the_triangle; auto; apply ahead; cbn; auto.
Qed.
Theorem beyond_edges : (forall n k t, In n [0%nat; 1%nat] -> In k [2%nat; 3%nat] -> m * length_ < exact n t - exact k t) ->
  forall t, 0 <= t <= 1 ->
  forall i r, 0 <= i <= 1 -> 0 <= r <= 1 -> m ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (path 0) t)) (scaled i (at_ (path 1) t)))
    (plus (scaled (1 - r) (at_ (path 2) t)) (scaled r (at_ (path 3) t)))).
Proof.
  intros beyond t time i r i01 r01. destruct (ahead_of_each _ _ beyond) as (M & bM & ahead).
  apply (beyond_is_farther _ M bM). apply Certificates.between_two_ahead; auto; apply ahead; cbn; auto.
Qed.
End Gaps.

(* A direction that was tested for its length in any format and environment is short in each. *)
Lemma short_in_each (f g : constants) env env' given given' value_of : reasonable_constants f -> reasonable_constants
  g ->
  execution g env' value_of given' -> given' (Length Slack) = sigma -> (forall a, given' (Along 0 a) = given (Along 0
    a)) ->
  (forall a, Rabs (given' (Along 0 a)) <= Errors.reach g) -> says g env' value_of short ->
  squared f env given <= 1 + 1.6 * / 1048576.
Proof.
  intros fine fine' run slack_ same bounded h.
  assert (bounded' : forall a, Rabs (along g env' given' a) <= Errors.reach g).
  { intro a. eapply Rle_trans; [apply seen_smaller|apply bounded]. }
  pose proof (short_is_short g fine' env' given' value_of run slack_ bounded' h) as short_.
  pose proof (l_pos g). pose proof (l_small g (reasonable_base g fine')).
  assert (each_ : forall a, along f env given a * along f env given a <=
    along g env' given' a * along g env' given' a + / 1000000000000).
  { intro a. unfold along. rewrite same. set (x := given (Along 0 a)).
    pose proof (seen_smaller f env x) as s. apply Rsqr_le_abs_1 in s. unfold Rsqr in s.
    unfold Machine.seen at 3 4. destruct (flushes_operands env'); [destruct (Rlt_dec (Rabs x) (lam g)) as [small|]|];
      try lra.
    assert (Rabs x * Rabs x <= / 1152921504606846976 * / 1152921504606846976) by (apply Rmult_le_compat; try apply
      Rabs_pos;
      lra). rewrite <- Rabs_mult, Rabs_pos_eq in H1 by apply Rle_0_sqr. lra. }
  unfold squared, sum3 in *. pose proof (each_ Expressions.X). pose proof (each_ Expressions.Y).
  pose proof (each_ Expressions.Z_). lra.
Qed.

(* The sets of both kinds of pairs. *)
Definition sets := (list nat * list nat)%type.
Definition of_a_vertex_and_a_face : sets := ([0%nat], [1%nat; 2%nat; 3%nat]).
Definition of_two_edges : sets := ([0%nat; 1%nat], [2%nat; 3%nat]).
(* An execution of the traced terms with coordinates, a largest one, and a direction. *)
Definition asks (f : constants) env given value_of place := (forall c, given (Place c) = place c) /\
  execution f env value_of given /\ given (Length Slack) = sigma /\
  (forall c, Rabs (place c) <= given (Length LargestCoordinate)) /\
  given (Length LargestCoordinate) <= power (largest_edge f).
(* The code tested the direction's length in some format and environment. *)
Definition is_tested given := exists (g : constants) env' given' value_of', reasonable_constants g /\ execution g env'
  value_of' given' /\ given' (Length Slack) = sigma /\ (forall a, given' (Along 0 a) = given (Along 0 a)) /\
  (forall a, Rabs (given' (Along 0 a)) <= Errors.reach g) /\ says g env' value_of' Gap.a_vertex_and_a_face.short.
Lemma tested_is_short (f : constants) env given : reasonable_constants f -> is_tested given -> squared f env given <= 1 +
  1.6 * / 1048576.
Proof.
  intros fine (g & env' & given' & value_of' & fine' & run' & slack' & along' & bounded & short_).
  destruct traced_terms as (_ & _ & same_short & _). rewrite same_short in short_.
  exact (short_in_each f g env env' given given' value_of' fine fine' run' slack' along' bounded short_).
Qed.
(* A pair that the code keeps by the gaps at both ends. *)
Definition is_kept (f : constants) (code : mask) place separation := exists env given value_of,
  asks f env given value_of place /\ given (Length Separation) = separation /\ 0 <= separation <= power (largest_edge f)
  /\ is_tested given /\ says f env value_of code.
(* A gap that the code stored: of a direction at the end of a step, converted to any format whose least extent is no more
   than the least gap. *)
Definition is_stored (f : constants) (code : number) (place : Expressions.coordinate -> R) (direction : Expressions.axis ->
  R) gap_ := exists env given value_of (g : constants) (env' : environment g) x, asks f env given value_of place /\
  is_tested given /\ (forall a, given (Along 0 a) = direction a) /\ reasonable_constants g /\
  power (extent_underflow f) <= given (Length LeastGap) <= 1 /\ power (extent_underflow g) <= given (Length LeastGap) /\
  value_of code = Number x /\ gap_ = rounded env' (seen f env x).
(* A pair that the code keeps by a gap that it stored at the end of an earlier step, where this one starts, of the same
   direction. *)
Definition follows (earlier place : Expressions.coordinate -> R) := forall n a, earlier (Expressions.Coordinate n
  Expressions.End a) = place (Expressions.Coordinate n Expressions.Start a).
Definition lasts_since (f : constants) (code : mask) (before : number) place separation := exists env given value_of
  (e : constants) earlier gap_, asks f env given value_of place /\ given (Length Separation) = separation /\
  0 <= separation <= power (largest_edge f) /\ is_tested given /\ reasonable_constants e /\
  is_stored e before earlier (fun a => given (Along 0 a)) gap_ /\ follows earlier place /\
  given (Length StoredGap) = gap_ /\ says f env value_of code.
Theorem a_stored_gap_is_below (f : constants) of place direction gap_ : reasonable_constants f -> fst of <> [] -> snd of <>
  [] -> is_stored f (stored (fst of) (snd of)) place direction gap_ -> 0 < gap_ -> forall n k, In n (fst of) -> In k (snd
    of) -> let at_end n := sum3 (fun a => direction a * place (Expressions.Coordinate n Expressions.End a)) in
  gap_ <= at_end n - at_end k.
Proof.
  intros fine some some' (env & given & value_of & g & env' & x & (places & run & slack_ & inside & within) & tested & along_
    & fine' & least & least' & Ex & ->) pos n k inn ink.
  assert (coordinates_ : forall c, Rabs (given (Place c)) <= given (Length LargestCoordinate)) by (intro c; rewrite
    places; apply inside).
  destruct (stored_is_below f fine env given value_of run slack_ (tested_is_short f env given fine tested) coordinates_
    within (fst of) (snd of) g env' fine' least least' some some') as (y & Ey & below).
  rewrite Ex in Ey. injection Ey as <-. specialize (below pos n k inn ink). cbv zeta. unfold truly, sum3 in *.
  now rewrite !along_, !places in below.
Qed.
Section Kept.
Variable f : constants.
Variable place : Expressions.coordinate -> R.
Variable s : R.
Hypothesis fine : reasonable_constants f.
Definition holds_at of := exists env given value_of, asks f env given value_of place /\ given (Length Separation) = s /\
  0 <= s <= power (largest_edge f) /\ is_tested given /\ forall n k t, In n (fst of) -> In k (snd of) ->
  s * sqrt (squared f env given) < exact f env given n t - exact f env given k t.
Lemma kept_holds of : is_kept f (keeps (fst of) (snd of)) place s -> holds_at of.
Proof.
  unfold holds_at. intros (env & given & value_of & asked & <- & sep & tested & kept). pose proof asked as (places &
    run & slack_ & inside &
    within). exists env, given, value_of. do 4 (split; [assumption || reflexivity|]).
  assert (coordinates_ : forall c, Rabs (given (Place c)) <= given (Length LargestCoordinate)) by (intro c; rewrite
    places; apply inside).
  exact (kept_is_beyond f fine env given value_of run slack_ (tested_is_short f env given fine tested) coordinates_ within
    sep (fst of) (snd of) kept).
Qed.
Lemma lasting_holds of : fst of <> [] -> snd of <> [] -> lasts_since f (lasts (fst of) (snd of)) (stored (fst of) (snd of))
  place s -> holds_at of.
Proof.
  unfold holds_at. intros some some' (env & given & value_of & e & earlier & gap_ & asked & <- & sep & tested & fine'
    & was & same & now_ &
    kept). pose proof asked as (places & run & slack_ & inside & within). exists env, given, value_of.
  do 4 (split; [assumption || reflexivity|]).
  assert (coordinates_ : forall c, Rabs (given (Place c)) <= given (Length LargestCoordinate)) by (intro c; rewrite
    places; apply inside).
  apply (lasting_is_beyond f fine env given value_of run slack_ (tested_is_short f env given fine tested) coordinates_
    within sep (fst of) (snd of)); [|exact kept].
  intros pos n k inn ink. rewrite now_ in *.
  pose proof (a_stored_gap_is_below e of earlier _ gap_ fine' some some' was pos n k inn ink) as below. cbv zeta in below.
  unfold truly, sum3 in *. rewrite !places. now rewrite !same in below.
Qed.
Notation path := (Apart.path_of place).
Theorem a_vertex_and_a_face_stay_apart t i j r : holds_at of_a_vertex_and_a_face -> 0 <= t <= 1 -> 0 <= i -> 0 <= j -> 0 <=
  r -> i + j + r = 1 ->
  s ^ 2 < Certificates.length_squared (minus (at_ (path 0) t) (plus (scaled i (at_ (path 1) t)) (plus (scaled j (at_ (path
    2) t)) (scaled r (at_ (path 3) t))))).
Proof.
  unfold holds_at. intros (env & given & value_of & (places & run & slack_ & inside & within) & <- & sep & tested & beyond).
  pose proof (tested_is_short f env given fine tested).
  intros. eapply beyond_vertex_and_face; try eassumption; exact beyond.
Qed.
Theorem two_edges_stay_apart t i r : holds_at of_two_edges -> 0 <= t <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  s ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (path 0) t)) (scaled i (at_ (path 1) t)))
    (plus (scaled (1 - r) (at_ (path 2) t)) (scaled r (at_ (path 3) t)))).
Proof.
  unfold holds_at. intros (env & given & value_of & (places & run & slack_ & inside & within) & <- & sep & tested & beyond).
  pose proof (tested_is_short f env given fine tested).
  intros. eapply beyond_edges; try eassumption; exact beyond.
Qed.
End Kept.
Theorem a_kept_vertex_and_face_stay_apart f place s t i j r : reasonable_constants f ->
  is_kept f Gap.a_vertex_and_a_face.keeps place s \/ lasts_since f Gap.a_vertex_and_a_face.lasts
    Gap.a_vertex_and_a_face.stored_by_keeps place s -> 0 <= t <= 1 -> 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 ->
  s ^ 2 < Certificates.length_squared (minus (at_ (Apart.path_of place 0) t) (plus (scaled i (at_ (Apart.path_of place
    1)
    t)) (plus (scaled j (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t))))).
Proof.
  destruct traced_terms as (same & _ & _ & _ & same_lasts & _ & same_stored & _). intros fine kept.
  apply (a_vertex_and_a_face_stay_apart f place s fine). rewrite same, same_lasts, same_stored in kept. destruct kept.
  - now apply kept_holds.
  - now apply lasting_holds.
Qed.
Theorem kept_edges_stay_apart f place s t i r : reasonable_constants f ->
  is_kept f Gap.two_edges.keeps place s \/ lasts_since f Gap.two_edges.lasts Gap.two_edges.stored_by_keeps place s -> 0 <= t
  <= 1 -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  s ^ 2 < Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (Apart.path_of place 0) t)) (scaled i (at_ (Apart.path_of place 1) t)))
    (plus (scaled (1 - r) (at_ (Apart.path_of place 2) t)) (scaled r (at_ (Apart.path_of place 3) t)))).
Proof.
  destruct traced_terms as (_ & same & _ & _ & _ & same_lasts & _ & same_stored & _). intros fine kept.
  apply (two_edges_stay_apart f place s fine). rewrite same, same_lasts, same_stored in kept. destruct kept.
  - now apply kept_holds.
  - now apply lasting_holds.
Qed.
(* A distance that the code computes from a direction whose length it tested is at most the distance of any of the points at
   the end. *)
Definition is_computed_distance (f : constants) (code : number) place x := exists env given value_of, asks f env given value_of
  place /\ is_tested given /\ value_of code = Number x /\ 0 < x.
Theorem a_distance_of_a_vertex_and_a_face f place x i j r : reasonable_constants f ->
  is_computed_distance f Gap.a_vertex_and_a_face.distance place x -> 0 <= i -> 0 <= j -> 0 <= r -> i + j + r = 1 ->
  x ^ 2 <= Certificates.length_squared (minus (at_ (Apart.path_of place 0) 1) (plus (scaled i (at_ (Apart.path_of place 1)
    1)) (plus (scaled j (at_ (Apart.path_of place 2) 1)) (scaled r (at_ (Apart.path_of place 3) 1))))).
Proof.
  destruct traced_terms as (_ & _ & _ & _ & _ & _ & _ & _ & _ & _ & same & _).
  intros fine (env & given & value_of & (places & run & slack_ & inside & within) & tested & Ex & x0).
  assert (coordinates_ : forall c, Rabs (given (Place c)) <= given (Length LargestCoordinate)) by (intro c; rewrite
    places; apply inside). rewrite same in Ex.
  exact (distance_of_a_vertex_and_a_face f fine env given value_of run slack_ (tested_is_short f env given fine tested)
    coordinates_ within place places x Ex x0 i j r).
Qed.
Theorem a_distance_of_two_edges f place x i r : reasonable_constants f ->
  is_computed_distance f Gap.two_edges.distance place x -> 0 <= i <= 1 -> 0 <= r <= 1 ->
  x ^ 2 <= Certificates.length_squared (minus
    (plus (scaled (1 - i) (at_ (Apart.path_of place 0) 1)) (scaled i (at_ (Apart.path_of place 1) 1)))
    (plus (scaled (1 - r) (at_ (Apart.path_of place 2) 1)) (scaled r (at_ (Apart.path_of place 3) 1)))).
Proof.
  destruct traced_terms as (_ & _ & _ & _ & _ & _ & _ & _ & _ & _ & _ & same).
  intros fine (env & given & value_of & (places & run & slack_ & inside & within) & tested & Ex & x0).
  assert (coordinates_ : forall c, Rabs (given (Place c)) <= given (Length LargestCoordinate)) by (intro c; rewrite
    places; apply inside). rewrite same in Ex.
  exact (distance_of_two_edges f fine env given value_of run slack_ (tested_is_short f env given fine tested)
    coordinates_ within place places x Ex x0 i r).
Qed.
