(* A direction that is held, turns or moves on a curve: if the code's comparisons say that it keeps a pair apart, it
   does. core/src/kernels/advance/directions.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool List Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners.
From Selvedge Require Expressions Errors Bounds.
Import ListNotations.
Open Scope R_scope.

Section Directions.
Load "Setting.section".
Load "InRange.section".

Notation p_pos := (within p_pos).
Notation p_small := (within p_small).
Notation m_pos := (within m_pos).
Notation m_small := (within m_small).
Notation M_low := (within M_low).
Notation dot_holds := (here dot_holds).
Notation constant := (constant f env given value_of run).
Notation normal := (operand_normal f env).
Notation corner_holds := (within corner_holds).
Notation difference_holds := (within difference_holds).

Lemma M_bounds a : l <= M a <= / 4 * G.
Proof.
  pose proof (M_low a). pose proof (within extent_and_differences a) as (_ & m0 &
    ML & _).
  pose proof (L_G f fine). pose proof (e_small f ok). pose proof (mu_l f fine). pose proof (l_pos f).
    pose proof (e_pos f).
  assert (e1 * (m a + mu) <= / 8388608 * (m a + mu)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma u_normal : l <= u.
Proof. pose proof (l_e f fine). pose proof (eps_twice f). pose proof (l_pos f). lra. Qed.
Lemma count_operand n : (1 <= n)%Z -> operand (value_of (Constant (Small n))) (IZR n) (IZR n) 0 0.
Proof.
  intro h. apply IZR_le in h. pose proof (l_small f ok). rewrite constant. cbn [constant_value].
    rewrite <- (Rabs_pos_eq (IZR n)) at 3 by lra.
  apply normal. rewrite Rabs_pos_eq; lra.
Qed.
Lemma roundoffs_holds n : (1 <= n <= 255)%Z -> holds (value_of (roundoffs n)) (IZR n * u) (IZR n * u) 1 1.
Proof.
  intros [h h']. pose proof (run (Product (Constant (Small n)) (Constant UnitRoundoff))) as r. cbn in r.
  apply IZR_le in h'. pose proof u_normal. pose proof (l_pos f). pose proof (e_small f ok). pose proof (eps_twice f).
  pose proof (omega_large f ok). pose proof (IZR_le _ _ h).
  assert (ou : operand (value_of (Constant UnitRoundoff)) u u 0 0).
  { rewrite constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq u) at 3 by lra. apply normal.
    rewrite Rabs_pos_eq; lra. }
  assert (IZR n * u <= 255 * / 8388608) by (apply Rmult_le_compat; lra).
  pose proof (product_holds r (count_operand n h) ou ltac:(lia) ltac:(lra) ltac:(lra)) as x.
  apply (holds_weaker f _ _ _ _ _ _ _ _ x); [lra|lia|lra].
Qed.

(* A direction, as it is seen. *)
Definition along k a := seen (given (Along k a)).
Definition is_short k := forall a, Rabs (along k a) <= G.
Lemma along_operand k a : operand (value_of (component (direction k) a)) (along k a) (Rabs (along k a)) 0 0.
Proof. unfold direction. rewrite component_each, (run (Input (Along k a))). apply operand_exact. Qed.

(* What the products of a direction are at most, and how far they may be off. *)
Definition sizes k := sum3 (fun a => Rabs (along k a) * p a).
Definition lengths k := sum3 (fun a => Rabs (along k a)).
Definition err k := 8.01 * e1 * sizes k + l * (2.3 * sizes k + 12 * lengths k + 11).
Lemma term_bounds k a : is_short k -> 0 <= Rabs (along k a) * p a <= 0.27 * (G * G).
Proof.
  intro short. pose proof (p_pos a). pose proof (p_small a). pose proof (Rabs_pos (along k a)).
  pose proof (G_4 f fine). pose proof (short a). split; [apply Rmult_le_pos; lra|].
  replace (0.27 * (G * G)) with (G * (0.27 * G)) by ring. apply Rmult_le_compat; lra.
Qed.
Lemma size_bounds k : is_short k -> 0 <= sizes k <= G * G /\ 0 <= lengths k <= 3 * G /\ 0 <= err k.
Proof.
  intro short. pose proof (G_4 f fine). assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  assert (S : 0 <= sizes k <= G * G).
  { unfold sizes, sum3. pose proof (term_bounds k Expressions.X short). pose proof (term_bounds k Expressions.Y short).
    pose proof (term_bounds k Expressions.Z_ short). lra. }
  assert (V : 0 <= lengths k <= 3 * G).
  { unfold lengths, sum3. pose proof (short Expressions.X). pose proof (short Expressions.Y).
    pose proof (short Expressions.Z_).
    pose proof (Rabs_pos (along k Expressions.X)). pose proof (Rabs_pos (along k Expressions.Y)).
      pose proof (Rabs_pos (along k Expressions.Z_)). lra. }
  split; [exact S|]. split; [exact V|]. unfold err. pose proof (e_pos f). pose proof (l_pos f).
  assert (0 <= e1 * sizes k) by (apply Rmult_le_pos; lra). assert (0 <= l * (2.3 * sizes k + 12 * lengths k + 11)) by
    (apply Rmult_le_pos; lra). lra.
Qed.

(* The bar T is large enough, and no overflow. *)
Definition bar k := product_error pairs (direction k).
Theorem bar_is_large k : is_short k -> exists B, value_of (bar k) = Number B /\ representable f B /\
  1.2 * err k + 400 * l <= B <= G * G.
Proof.
  intro short. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_pos f) as l0.
    pose proof (l_small f ok) as ls.
  pose proof (G_4 f fine) as G4. pose proof (G_2 f fine) as G2. pose proof (eta_large f fine) as eta_l.
    pose proof (eta_1 f fine) as eta1.
  pose proof (l_e f fine) as le. pose proof (eps_twice f) as eu. pose proof (mu_large f fine) as mul.
    pose proof (mu_pos f) as mu0. pose proof (mu_1 f fine) as mu1.
  assert (GG : 4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  set (S := sum3 (fun a => Rabs (along k a) * M a)).
  set (Y := sum3 (fun a => Rabs (along k a) * m a)). set (V := lengths k).
  assert (each_ : forall a, 0 <= Rabs (along k a) <= G /\ 0 <= Rabs (along k a) * M a <= / 4 * (G * G) /\
    0 <= Rabs (along k a) * m a <= 0.26 * (G * G) /\
    (1 - e1) * (Rabs (along k a) * m a) + (1 - e1) * mu * Rabs (along k a) - l * Rabs (along k a) <= Rabs (along k a) *
      M a /\
    Rabs (along k a) * p a = (1 + e1) * (Rabs (along k a) * m a) + (4 + e1) * (l * Rabs (along k a))).
  { intro a. pose proof (Rabs_pos (along k a)). pose proof (short a). pose proof (M_bounds a). pose proof (m_pos a).
    pose proof (m_small a).
    pose proof (M_low a) as low. split; [lra|]. split; [split; [apply Rmult_le_pos; lra|]|split; [split;
      [apply Rmult_le_pos; lra|]|split]].
    - replace (/ 4 * (G * G)) with (G * (/ 4 * G)) by ring. apply Rmult_le_compat; lra.
    - replace (0.26 * (G * G)) with (G * (0.26 * G)) by ring. apply Rmult_le_compat; lra.
    - apply (Rmult_le_compat_l (Rabs (along k a))) in low; [|lra]. lra.
    - unfold Corners.p. ring. }
  pose proof (each_ Expressions.X) as (? & ? & ? & ? & px). pose proof (each_ Expressions.Y) as (? & ? & ? & ? & py).
  pose proof (each_ Expressions.Z_) as (? & ? & ? & ? & pz).
  assert (Sb : 0 <= S <= 0.75 * (G * G)) by (unfold S, sum3; lra).
  assert (Yb : 0 <= Y <= G * G) by (unfold Y, sum3; lra). assert (Vb : 0 <= V <= 3 * G) by (unfold V, lengths, sum3;
    lra).
  assert (S_low : (1 - e1) * Y + (1 - e1) * mu * V - l * V <= S) by (unfold S, Y, V, lengths, sum3; lra).
  assert (size : sizes k = (1 + e1) * Y + (4 + e1) * (l * V)) by (unfold sizes, Y, V, lengths, sum3;
    rewrite px, py, pz; ring).
  (* The computed value. *)
  assert (om : forall a, operand (value_of (component (magnitudes (direction k)) a)) (Rabs (along k a)) (Rabs (along k
    a)) 0 0).
  { intro a. unfold magnitudes, direction. rewrite !component_each, (run (Magnitude _)), (run (Input _)).
    cbn [magnitude].
    unfold along. rewrite <- (seen_magnitude f env). rewrite <- (Rabs_pos_eq (seen (Rabs _))) at 2;
      [apply operand_exact|].
    rewrite seen_magnitude. apply Rabs_pos. }
  assert (oe : forall a, operand (value_of (component (extent pairs) a)) (M a) (M a) 0 0).
  { intro a. rewrite (within extent_value a). pose proof (M_bounds a).
    rewrite <- (Rabs_pos_eq (M a)) at 3 by lra. apply normal. rewrite Rabs_pos_eq; lra. }
  assert (small : sum3 (fun a => Rabs (along k a) * M a) <= omega f / 4) by (fold S; lra).
  assert (none : sum3 (fun a => Rabs (along k a) * 0 + 0 * M a + l * (0 * 0)) <= omega f / 4) by (unfold sum3; lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 0 om oe ltac:(lia) small none) as d'.
  assert (d : holds (value_of (dot_ (magnitudes (direction k)) (extent pairs))) S S 3 9.2).
  { apply (holds_weaker f _ _ _ _ _ _ _ _ d'); [unfold S, sum3; lra|lia|unfold sum3; lra]. }
  pose proof (run (Product (roundoffs 20) (dot_ (magnitudes (direction k)) (extent pairs)))) as h.
    cbn -[roundoffs dot_ magnitudes extent] in h.
  assert (uS : 0 <= 20 * u * S <= / 10000 * (G * G)). { split; [repeat apply Rmult_le_pos; lra|].
    assert (20 * u * S <= 20 * / 16777216 * (0.75 * (G * G))) by (apply Rmult_le_compat; lra). lra. }
  assert (lS : 0 <= l * S <= / 1099511627776 * (e1 * S)). { split; [apply Rmult_le_pos; lra|].
    replace (/ 1099511627776 * (e1 * S)) with (/ 1099511627776 * e1 * S) by ring. apply Rmult_le_compat_r; lra. }
  pose proof (product_holds h (seen_holds (roundoffs_holds 20%Z ltac:(lia))) (seen_holds d) ltac:(lia) ltac:(lra)
    ltac:(lra)) as r.
  pose proof (run (bar k)) as h'. unfold bar, product_error in h'. cbn -[roundoffs dot_ magnitudes extent] in h'.
  assert (on : operand (value_of (Constant Underflow)) eta eta 0 0).
  { rewrite constant. cbn [constant_value]. rewrite <- (Rabs_pos_eq eta) at 3 by lra. apply normal.
    rewrite Rabs_pos_eq; lra. }
  pose proof (sum_holds Rplus 5 ltac:(auto) h' (seen_holds r) on ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lra) ltac:(lra))
    as t.
  destruct t as (B & E & rep & near_ & _ & _). exists B. split; [exact E|]. split; [exact rep|].
  pose proof (q_linear f ok 6 ltac:(lia)) as q6. replace (INR 6) with 6 in q6 by (simpl; ring). pose proof (q_ge f 6).
  assert (z0 : 0 <= 20 * u * S + eta) by lra.
  assert ((q 6 - 1) * (20 * u * S + eta) <= 6.006 * e1 * (20 * u * S + eta)) by (apply Rmult_le_compat_r; lra).
  assert (6.006 * e1 * (20 * u * S + eta) <= / 1000000 * (20 * u * S + eta)) by (apply Rmult_le_compat_r; lra).
  assert (l * (1.01 * (1.01 * (20 * u * (9.2 + 1) + (1 + 1) * S + l * ((1 + 1) * (9.2 + 1))) + 1 + 1 + 0) + 1) <= 2.1 *
    (l * S) + 4 * l).
  { assert (20 * u * 10.2 <= / 1000) by lra. assert (l * 20.4 <= / 1000) by lra.
    replace (2.1 * (l * S) + 4 * l) with (l * (2.1 * S + 4)) by ring. apply Rmult_le_compat_l; lra. }
  apply Rabs_le_inv in near_. split.
  - replace (20 * u * S) with (10 * (e1 * S)) in * by (rewrite eu; ring).
    assert (low : 9.99 * (e1 * S) + 500 * l <= B) by lra.
    assert (eS : e1 * ((1 - e1) * Y + (1 - e1) * mu * V - l * V) <= e1 * S) by (apply Rmult_le_compat_l; lra).
    assert (eY : 0 <= e1 * Y) by (apply Rmult_le_pos; lra).
    assert (eeY : e1 * (e1 * Y) <= / 8388608 * (e1 * Y)) by (apply Rmult_le_compat_r; lra).
    assert (lY : 0 <= l * Y <= / 1099511627776 * (e1 * Y)). { split; [apply Rmult_le_pos; lra|].
      replace (/ 1099511627776 * (e1 * Y)) with (/ 1099511627776 * e1 * Y) by ring. apply Rmult_le_compat_r; lra. }
    assert (lV : 0 <= l * V) by (apply Rmult_le_pos; lra).
    assert (elV : 0 <= e1 * (l * V) <= / 8388608 * (l * V)) by (split; [apply Rmult_le_pos;
      lra|apply Rmult_le_compat_r; lra]).
    assert (emV : 8 * (l * V) <= e1 * mu * V). { replace (8 * (l * V)) with (8 * l * V) by ring.
      apply Rmult_le_compat_r; lra. }
    assert (eemV : e1 * (e1 * mu * V) <= / 8388608 * (e1 * mu * V)) by (apply Rmult_le_compat_r; [apply Rmult_le_pos;
      [apply Rmult_le_pos|]|]; lra).
    assert (elY : e1 * (l * Y) <= / 8388608 * (l * Y)) by (apply Rmult_le_compat_r; lra).
    assert (llV : l * (l * V) <= / 1000 * (l * V)) by (apply Rmult_le_compat_r; lra).
    assert (ellV : e1 * (l * (l * V)) <= / 1000 * (l * V)). { assert (e1 * (l * (l * V)) <= 1 * (l * (l * V))) by (apply
      Rmult_le_compat_r; [apply Rmult_le_pos; lra|lra]). lra. }
    assert (eelV : e1 * (e1 * (l * V)) <= / 1000 * (l * V)). { assert (e1 * (e1 * (l * V)) <= 1 * (e1 * (l * V))) by
      (apply Rmult_le_compat_r; lra). lra. }
    unfold err. rewrite size. fold V. lra.
  - assert (G * 4 <= G * G) by (apply Rmult_le_compat_l; lra).
    assert (l * S <= / 1000 * S) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* Exact products of a direction with a corner, at a time; linear in it. *)
Definition exact_product k pair t := sum3 (fun a => along k a * at_ pair a t).
Lemma exact_product_linear k pair t :
  exact_product k pair t = (1 - t) * exact_product k pair 0 + t * exact_product k pair 1.
Proof. unfold exact_product, sum3, exactly_at. ring. Qed.

(* Computed ones, at a moment of the step and at its ends. *)
Lemma product_holds_at k pair n : In pair pairs -> is_short k -> 0 <= seen (given (Moment n)) <= 1 ->
  holds (value_of (dot_ (direction k) (corner_at n pair))) (exact_product k pair (seen (given (Moment n)))) (sizes k) 7
    (2.19 * sizes k + 11.5 * lengths k + 9.2).
Proof.
  intros inside short time. pose proof (size_bounds k short) as (S & V & _). pose proof (G_2 f fine).
    pose proof (G_4 f fine).
  assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  pose proof (fun a => seen_holds (corner_holds n time pair a inside)) as hc.
  assert (x : sum3 (fun a => Rabs (along k a) * (2.1 * p a + 10 + 1) + 0 * p a + l * (0 * (2.1 * p a + 10 + 1))) =
    2.1 * sizes k + 11 * lengths k) by (unfold sizes, lengths, sum3; ring).
  assert (small : sum3 (fun a => Rabs (along k a) * p a) <= omega f / 4) by (fold (sizes k); lra).
  assert (none : sum3 (fun a => Rabs (along k a) * (2.1 * p a + 10 + 1) + 0 * p a + l * (0 * (2.1 * p a + 10 + 1))) <=
    omega f / 4)
    by (rewrite x; lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 4 (along_operand k) hc ltac:(lia) small none) as d.
  apply (holds_weaker f _ _ _ _ _ _ _ _ d); [apply Rle_refl|lia|]. rewrite x. lra.
Qed.
Lemma product_holds_at_end k pair t : In pair pairs -> is_short k ->
  holds (value_of (dot_ (direction k) (difference pair t)))
    (exact_product k pair (match t with Expressions.Start => 0 | Expressions.End => 1 end)) (sizes k) 4 (4.2 * lengths k
      + 9.2).
Proof.
  intros inside short. pose proof (size_bounds k short) as (S & V & _). pose proof (G_2 f fine).
    pose proof (G_4 f fine).
  assert (4 * G <= G * G) by (apply Rmult_le_compat_r; lra).
  pose proof (fun a => seen_holds (difference_holds pair t a inside)) as hc.
  assert (x : sum3 (fun a => Rabs (along k a) * (3 + 1) + 0 * p a + l * (0 * (3 + 1))) = 4 * lengths k) by (unfold
    lengths, sum3; ring).
  assert (small : sum3 (fun a => Rabs (along k a) * p a) <= omega f / 4) by (fold (sizes k); lra).
  assert (none : sum3 (fun a => Rabs (along k a) * (3 + 1) + 0 * p a + l * (0 * (3 + 1))) <= omega f / 4) by (rewrite x;
    lra).
  pose proof (dot_holds _ _ _ _ _ _ _ _ 0 1 (along_operand k) hc ltac:(lia) small none) as d.
  replace (exact_product k pair _) with (sum3 (fun a => along k a * exactly pair t a))
    by (unfold exact_product, sum3, exactly_at; destruct t; ring).
  apply (holds_weaker f _ _ _ _ _ _ _ _ d); [apply Rle_refl|lia|]. rewrite x. lra.
Qed.
Lemma q_error n : (n <= 8)%nat -> 0 <= q n - 1 <= 1.001 * INR n * e1.
Proof. intro h. pose proof (q_linear f ok n ltac:(lia)). pose proof (q_ge f n). lra. Qed.
Lemma err_covers k x X a : is_short k -> near f x X (sizes k) 7 a -> a <= 2.19 * sizes k + 11.5 * lengths k + 9.2 ->
  Rabs (x - X) <= err k.
Proof.
  intros short (d & _ & a0) A. pose proof (size_bounds k short) as (S & V & _). pose proof (l_pos f).
    pose proof (e_pos f).
  pose proof (q_error 7 ltac:(lia)) as q7. replace (INR 7) with 7 in q7 by (simpl; ring).
  assert ((q 7 - 1) * sizes k <= 7.007 * e1 * sizes k) by (apply Rmult_le_compat_r; lra).
  assert (0 <= e1 * sizes k) by (apply Rmult_le_pos; lra).
  assert (l * a <= l * (2.3 * sizes k + 12 * lengths k + 11)) by (apply Rmult_le_compat_l; lra). unfold err. lra.
Qed.

(* A computed number that is greater than a positive one of normal size. *)
Lemma greater_than v B : l <= B -> greater f env v (Number B) -> (exists x, v = Number x /\ seen x = x /\
  B < x) \/ v = Infinite true.
Proof.
  intros big g. pose proof (l_pos f). unfold greater, seen_value in g.
  destruct v as [x|[|]|]; try tauto. rewrite (seen_of_normal f env B) in g by (rewrite Rabs_pos_eq; lra). left.
    exists x. split; [reflexivity|]. rewrite (seen_positive f env x) in * by lra. auto.
Qed.
Lemma greater_holds v X P n a B : holds v X P n a -> l <= B -> greater f env v (Number B) ->
  exists x, v = Number x /\ seen x = x /\ B < x /\ representable f x /\ near f x X P n a.
Proof.
  intros (x & -> & rep & h) big g. destruct (greater_than _ _ big g) as [(y & E & s & b)|E]; [|discriminate].
    injection E as <-.
  exists x. auto.
Qed.

(* A direction k with the bar b that is held. The code's steps for one corner. *)
Definition less_roundoffs count := Minus one (roundoffs count).
Definition quotient_of k b pair := Product (Quotient (Minus (dot_ (direction k) (at_start pair)) b)
  (Minus (dot_ (direction k) (at_start pair)) (dot_ (direction k) (at_end pair)))) (less_roundoffs 32).
Definition stays k b pair := Greater (dot_ (direction k) (at_end pair)) b.
Definition falls k b pair := Both (Greater (dot_ (direction k) (at_start pair)) (dot_ (direction k) (at_end pair)))
  (Greater (quotient_of k b pair) (Constant (Small 0))).
Definition until_of k b pair before := Select (stays k b pair) before (Smaller (quotient_of k b pair) before).
Definition is_ahead k b n pair := Greater (dot_ (direction k) (corner_at n pair)) b.

(* The factor 1 - 32u as it is computed. *)
Lemma less_roundoffs_bounds n : (1 <= n <= 255)%Z -> exists c, value_of (less_roundoffs n) = Number c /\
  / 2 <= c <= 1 - (IZR n * 0.499 - 1.1) * e1.
Proof.
  intro n255. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es. pose proof (l_pos f) as l0.
    pose proof (l_small f ok). pose proof (l_e f fine).
  pose proof (eps_twice f) as eu. pose proof (omega_large f ok).
  assert (nb : 1 <= IZR n <= 255) by (split; apply IZR_le; lia).
  destruct (seen_holds (roundoffs_holds n n255)) as (x & E & near_ & _ & _). unfold Bounds.q in near_.
  replace ((1 + e1) ^ 1 - 1) with e1 in near_ by ring. replace (IZR n * u) with (/ 2 * (IZR n * e1)) in near_ by
    (rewrite eu; field). apply Rabs_le_inv in near_.
  assert (ne : e1 <= IZR n * e1 <= 255 * e1) by (split; [rewrite <- (Rmult_1_l e1) at 1|]; apply Rmult_le_compat_r;
    lra).
  assert (e1 * (/ 2 * (IZR n * e1)) <= 0.0001 * (IZR n * e1)) by (replace (e1 * (/ 2 * (IZR n * e1))) with (/ 2 * e1 *
    (IZR n * e1)) by ring; apply Rmult_le_compat_r; lra).
  pose proof (run (less_roundoffs n)) as h. cbn -[roundoffs] in h. unfold sum in h. rewrite E in h. unfold one in h.
  rewrite (constant (Small 1)) in h. cbn in h. rewrite (seen_1 f fine env) in h.
  apply (result_number f ok env) in h; [|rewrite Rabs_pos_eq; lra]. eexists. split; [exact h|].
  pose proof (error f ok env (1 - x)) as er. rewrite (Rabs_pos_eq (1 - x)) in er by lra. apply Rabs_le_inv in er.
  assert (e1 * (1 - x) <= e1 * 1) by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * (1 - x)) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma less_roundoffs_value : exists c, value_of (less_roundoffs 32) = Number c /\ / 2 <= c <= 1 - 14 * e1.
Proof. destruct (less_roundoffs_bounds 32 ltac:(lia)) as (c & E & b). exists c. split; [exact E|].
  pose proof (e_pos f). lra. Qed.

(* A quotient is at most the exact one and 3λ. *)
Lemma quotient_arithmetic A D N Dn z y q1 c : 0 < A -> 0 < D -> 0 < Dn -> 0 < z -> N <= (1 + e1) * A -> (1 - e1) * D <=
  Dn -> z = N / Dn ->
  q1 <= (1 + e1) * z + l -> 0 <= c <= 1 - 14 * e1 -> y <= (1 + e1) * (q1 * c) + l -> (y - 3 * l) * D <= A.
Proof.
  intros A0 D0 Dn0 z0 HN HD E H1 Hc Hy. pose proof (e_pos f) as e0. pose proof (e_small f ok) as es.
    pose proof (l_pos f) as l0.
  assert (zD : z * Dn = N) by (rewrite E; field; lra).
  assert (q1 * c <= ((1 + e1) * z + l) * c) by (apply Rmult_le_compat_r; lra).
  assert (((1 + e1) * z + l) * c <= ((1 + e1) * z + l) * (1 - 14 * e1)).
  { apply Rmult_le_compat_l; [|lra]. assert (0 <= e1 * z) by (apply Rmult_le_pos; lra). lra. }
  assert ((1 + e1) * (q1 * c) <= (1 + e1) * (((1 + e1) * z + l) * (1 - 14 * e1))) by (apply Rmult_le_compat_l; lra).
  set (K := (1 + e1) * (1 + e1) * (1 - 14 * e1)).
  assert (K1 : K * (1 + e1) <= 1 - e1).
  { unfold K. assert (e1 * e1 <= / 1000 * e1) by (apply Rmult_le_compat_r; lra).
    assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra).
    assert (0 <= e1 * (e1 * e1)) by (apply Rmult_le_pos; lra). assert (e1 * (e1 * e1) <= / 1000 * (e1 * e1)) by (apply
      Rmult_le_compat_r; lra).
    assert (0 <= e1 * (e1 * (e1 * e1))) by (apply Rmult_le_pos; lra). lra. }
  assert (K0 : 0 <= K) by (unfold K; repeat apply Rmult_le_pos; lra).
  assert (last : (1 + e1) * ((1 + e1) * z + l) * (1 - 14 * e1) + l <= K * z + 3 * l).
  { unfold K. assert ((1 + e1) * (1 - 14 * e1) <= 1.5) by (assert (0 <= e1 * e1) by (apply Rmult_le_pos; lra); lra).
    assert ((1 + e1) * (1 - 14 * e1) * l <= 1.5 * l) by (apply Rmult_le_compat_r; lra). lra. }
  assert (y - 3 * l <= K * z) by lra.
  assert (step1 : (y - 3 * l) * D <= K * z * D) by (apply Rmult_le_compat_r; lra).
  assert (step2 : K * z * ((1 - e1) * D) <= K * z * Dn) by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|lra]).
  assert (step3 : K * z * Dn = K * N) by (rewrite <- zD; ring).
  assert (step4 : K * N <= K * ((1 + e1) * A)) by (apply Rmult_le_compat_l; lra).
  assert (step5 : K * ((1 + e1) * A) <= (1 - e1) * A) by (rewrite <- Rmult_assoc; apply Rmult_le_compat_r; lra).
  apply (Rmult_le_reg_l (1 - e1)); [lra|].
  assert (((1 - e1) * ((y - 3 * l) * D)) <= (1 - e1) * (K * z * D)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
End Directions.
