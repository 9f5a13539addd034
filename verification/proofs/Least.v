(* What an execution's numbers are at least, operation by operation, roots included; and executions of the filter's
   expressions in an environment, which are those of Expressions.v. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners.
From Selvedge Require Expressions.
Open Scope R_scope.

Section Least.
Variable f : constants.
Hypothesis fine : reasonable_constants f.
Let ok : reasonable f := reasonable_base f fine.
Variable env : environment f.
Notation l := (lam f).
Notation e1 := (eps f).
Notation Rd := (rounded env).
Notation seen := (seen f env).
Notation seen_value := (seen_value f env).

(* A number that is not negative and at least b, or positive infinity. *)
Definition at_least v b := v = Infinite true \/ exists x, v = Number x /\ 0 <= x /\ b <= x.
Lemma at_least_weaker v b c : at_least v b -> c <= b -> at_least v c.
Proof. intros [h|(x & h & x0 & bx)] cb; [left; exact h|right; exists x; repeat split; auto; lra]. Qed.
Lemma seen_low x : 0 <= x -> 0 <= seen x /\ x - l <= seen x.
Proof.
  intro h. pose proof (seen_off f env x) as o. apply Rabs_le_inv in o. split; [|lra].
  rewrite <- (seen_0 f env). now apply seen_monotone.
Qed.
Lemma seen_large x : l <= x -> seen x = x.
Proof. intro h. apply seen_of_normal. pose proof (l_pos f). rewrite Rabs_pos_eq; lra. Qed.
(* Squares of what is seen. *)
Lemma seen_square x : x * x - l / 1000 <= seen x * seen x <= x * x.
Proof.
  pose proof (l_pos f). pose proof (l_small f ok). unfold Machine.seen. assert (0 <= x * x) by apply Rle_0_sqr.
  destruct (flushes_operands env); [destruct (Rlt_dec (Rabs x) l) as [h|]|]; try lra.
  assert (Rabs x * Rabs x <= l * l) by (pose proof (Rabs_pos x); apply Rmult_le_compat; lra).
  rewrite <- Rabs_mult, Rabs_pos_eq in H2 by assumption. assert (l * l <= l * / 1000) by (apply Rmult_le_compat_l;
    lra). lra.
Qed.
Lemma omega_pos : 1048576 <= omega f. Proof. exact (omega_large f ok). Qed.

Lemma result_least z out b : result f env z out -> 0 <= z -> b <= omega f -> b <= (1 - e1) * z - l -> at_least out b.
Proof.
  intros r z0 bo bz. pose proof omega_pos. pose proof (error f ok env z) as E. rewrite (Rabs_pos_eq z z0) in E.
  apply Rabs_le_inv in E. pose proof (rounded_positive f env z z0) as P. unfold result in r.
  destruct r as [[_ ->]|[[_ [-> | ->]]|[neg _]]].
  - right. exists (Rd z). repeat split; lra.
  - left. reflexivity.
  - right. exists (omega f). repeat split; lra.
  - lra.
Qed.
Lemma normal_error z : l <= z -> (1 - e1) * z <= Rd z <= (1 + e1) * z.
Proof.
  intro h. pose proof (l_pos f). pose proof (error_of_normal f ok env z) as E. rewrite (Rabs_pos_eq z) in E by lra.
  specialize (E h). apply Rabs_le_inv in E. lra.
Qed.
Lemma result_least_normal z out b : result f env z out -> l <= z -> b <= omega f -> b <= (1 - e1) * z -> at_least out b.
Proof.
  intros r z0 bo bz. pose proof omega_pos. pose proof (l_pos f). pose proof (normal_error z z0).
  pose proof (rounded_positive f env z ltac:(lra)) as P. unfold result in r.
  destruct r as [[_ ->]|[[_ [-> | ->]]|[neg _]]].
  - right. exists (Rd z). repeat split; lra.
  - left. reflexivity.
  - right. exists (omega f). repeat split; lra.
  - lra.
Qed.
Lemma product_turned v w out : product f env v w out -> product f env w v out.
Proof.
  unfold product. destruct (seen_value v) as [x| |], (seen_value w) as [y| |]; auto. now rewrite Rmult_comm.
Qed.
Lemma number_seen x : seen_value (Number x) = Number (seen x). Proof. reflexivity. Qed.

(* A sum with a number that is not negative. *)
Lemma sum_least v y out a c : sum f env Rplus (fun s => s) v (Number y) out -> at_least v a -> 0 <= y -> 0 <= a + y ->
  c <= omega f -> c <= (1 - e1) * (a + y - 2 * l) - l -> at_least out c.
Proof.
  intros s h y0 _ co cz. unfold sum in s. rewrite number_seen in s. pose proof (e_pos f). pose proof (e_small f ok).
  destruct (seen_low y y0) as [sy0 sy].
  destruct h as [-> |(x & -> & x0 & ax)]; cbn in s; [left; exact s|]. destruct (seen_low x x0) as [sx0 sx].
  apply (result_least _ _ _ s); [lra|exact co|].
  assert ((1 - e1) * (a + y - 2 * l) <= (1 - e1) * (seen x + seen y)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
(* The same where the result is a normal number. *)
Lemma sum_least_normal v y out a b c : sum f env Rplus (fun s => s) v (Number y) out -> at_least v a -> 0 <= y ->
  (forall x, 0 <= x -> a <= x -> b <= seen x + seen y) -> l <= b ->
  c <= omega f -> c <= (1 - e1) * b -> at_least out c.
Proof.
  intros s h y0 big lb co cz. unfold sum in s. rewrite number_seen in s. pose proof (e_pos f). pose proof (e_small f
    ok).
  destruct h as [-> |(x & -> & x0 & ax)]; cbn in s; [left; exact s|]. specialize (big x x0 ax).
  apply (result_least_normal _ _ _ s); [lra|exact co|].
  assert ((1 - e1) * b <= (1 - e1) * (seen x + seen y)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
(* A product with a normal number. *)
Lemma product_least v y out a c : product f env v (Number y) out -> at_least v a -> l <= y -> c <= omega f ->
  c <= (1 - e1) * ((a - l) * y) - l -> at_least out c.
Proof.
  intros s h y0 co cz. unfold product in s. rewrite number_seen, (seen_large y y0) in s. pose proof (e_pos f).
  pose proof (e_small f ok). pose proof (l_pos f).
  destruct h as [-> |(x & -> & x0 & ax)]; cbn in s; [left; apply s; lra|]. destruct (seen_low x x0) as [sx0 sx].
  apply (result_least _ _ _ s); [apply Rmult_le_pos; lra|exact co|].
  assert ((a - l) * y <= seen x * y) by (apply Rmult_le_compat_r; lra).
  assert ((1 - e1) * ((a - l) * y) <= (1 - e1) * (seen x * y)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma product_least_normal v y out a c : product f env v (Number y) out -> at_least v a -> l <= y -> l <= a ->
  l <= a * y -> c <= omega f -> c <= (1 - e1) * (a * y) -> at_least out c.
Proof.
  intros s h y0 a0 ay co cz. unfold product in s. rewrite number_seen, (seen_large y y0) in s. pose proof (e_pos f).
  pose proof (e_small f ok). pose proof (l_pos f).
  destruct h as [-> |(x & -> & x0 & ax)]; cbn in s; [left; apply s; lra|]. rewrite (seen_large x) in s by lra.
  assert (a * y <= x * y) by (apply Rmult_le_compat_r; lra).
  apply (result_least_normal _ _ _ s); [lra|exact co|].
  assert ((1 - e1) * (a * y) <= (1 - e1) * (x * y)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma larger_least v w out a b : larger f env v w out -> at_least v a -> at_least w b ->
  at_least out (a - l) /\ at_least out (b - l).
Proof.
  intros h hv hw. pose proof (l_pos f).
  assert (one : forall p q a b, ~ greater f env q p -> at_least p a -> at_least q b -> forall o, as_it_is f env p o ->
    at_least o (a - l) /\ at_least o (b - l)).
  { intros p q a' b' no hp hq o io.
    destruct hp as [-> |(x & -> & x0 & ax)].
    - destruct io as [-> | ->]; split; left; reflexivity.
    - destruct hq as [-> |(y & -> & y0 & ay)]; [cbn in no; tauto|]. cbn in no. apply Rnot_lt_le in no.
      destruct (seen_low x x0) as [sx0 sx]. destruct (seen_low y y0) as [sy0 sy].
      pose proof (seen_smaller f env x) as sm. rewrite !Rabs_pos_eq in sm by assumption.
      destruct io as [-> | ->]; split; right; eexists; (split; [reflexivity|]); split; lra. }
  destruct h as [[no io]|[no io]].
  - exact (one v w a b no hv hw out io).
  - destruct (one w v b a no hw hv out io). split; assumption.
Qed.
Lemma root_least v out a c : root f env v out -> at_least v a -> l <= a -> c <= omega f -> c <= (1 - e1) * sqrt a ->
  at_least out c.
Proof.
  intros r h la co ca. unfold root in r. pose proof (l_pos f). pose proof (l_small f ok). pose proof (e_pos f).
  pose proof (e_small f ok).
  destruct h as [-> |(x & -> & x0 & ax)]; cbn in r; [left; exact r|]. rewrite (seen_large x) in r by lra.
  destruct r as [r _]. assert (sqrt a <= sqrt x) by (apply sqrt_le_1_alt; exact ax).
  assert (l <= sqrt a). { rewrite <- (sqrt_square l) by lra. apply sqrt_le_1_alt.
    apply Rle_trans with (1 * l); [apply Rmult_le_compat_r; lra|lra]. }
  apply (result_least_normal _ _ _ (r x0)); [lra|exact co|].
  assert ((1 - e1) * sqrt a <= (1 - e1) * sqrt x) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Variable given : input -> R.
Variable value_of : number -> value.
Hypothesis run : execution f env value_of given.
Definition run_sum a b : sum f env Rplus (fun s => s) (value_of a) (value_of b) (value_of (Sum a b)) := run (Sum a b).
Definition run_minus a b : sum f env Rminus negb (value_of a) (value_of b) (value_of (Minus a b)) := run (Minus a b).
Definition run_product a b : product f env (value_of a) (value_of b) (value_of (Product a b)) := run (Product a b).
Definition run_larger a b : larger f env (value_of a) (value_of b) (value_of (Larger a b)) := run (Larger a b).
Definition run_root a : root f env (value_of a) (value_of (Root a)) := run (Root a).
Definition run_constant c : value_of (Constant c) = Number (constant_value f c) := run (Constant c).
Definition run_input i : value_of (Input i) = Number (given i) := run (Input i).
(* The sum of the squares of three numbers, each small enough not to overflow. *)
Lemma number_if_small z out : result f env z out -> Rabs z <= omega f / 2 -> out = Number (Rd z).
Proof.
  intros r small. pose proof (error f ok env z) as E. pose proof (e_small f ok). pose proof (e_pos f).
  pose proof (l_small f ok). pose proof omega_pos. pose proof (Rabs_pos z).
  assert (e1 * Rabs z <= / 8388608 * (omega f / 2)) by (apply Rmult_le_compat; lra).
  assert (Rabs (Rd z) <= 0.6 * omega f).
  { replace (Rd z) with ((Rd z - z) + z) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  destruct r as [[_ ->]|[[over _]|[over _]]]; [reflexivity| |].
  - pose proof (Rle_abs (Rd z)). lra.
  - pose proof (Rle_abs (- Rd z)). rewrite Rabs_Ropp in *. lra.
Qed.
Lemma square_least e x : value_of e = Number x -> x * x <= omega f / 2 -> exists y,
  value_of (Product e e) = Number y /\ 0 <= y /\ (1 - e1) * (x * x) - 1.001 * l <= y.
Proof.
  intros E small. pose proof (run (Product e e)) as h. cbn in h. unfold product in h. rewrite E, number_seen in h.
  pose proof (seen_square x) as [low high]. pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f).
  assert (s0 : 0 <= seen x * seen x) by apply Rle_0_sqr.
  apply number_if_small in h; [|rewrite Rabs_pos_eq; lra]. eexists. split; [exact h|].
  pose proof (rounded_positive f env _ s0). split; [assumption|].
  pose proof (error f ok env (seen x * seen x)) as er. rewrite (Rabs_pos_eq _ s0) in er. apply Rabs_le_inv in er.
  assert ((1 - e1) * (x * x - l / 1000) <= (1 - e1) * (seen x * seen x)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= e1 * l) by (apply Rmult_le_pos; lra). lra.
Qed.
Definition squared (x : Expressions.axis -> R) := sum3 (fun a => x a * x a).
Lemma squared_pos x : 0 <= squared x.
Proof. unfold squared, sum3. pose proof (Rle_0_sqr (x Expressions.X)). pose proof (Rle_0_sqr (x Expressions.Y)).
  pose proof (Rle_0_sqr (x Expressions.Z_)). unfold Rsqr in *. lra. Qed.
Lemma dot_least v x : (forall a, value_of (component v a) = Number (x a)) -> (forall a, x a * x a <= omega f / 2) ->
  squared x <= omega f -> at_least (value_of (dot_ v v)) ((1 - 3 * e1) * squared x - 9.2 * l).
Proof.
  intros E small all. unfold squared, sum3 in *.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  destruct (square_least (vx v) (x Expressions.X) (E Expressions.X) (small _)) as (px & Px & px0 & lx).
  destruct (square_least (vy v) (x Expressions.Y) (E Expressions.Y) (small _)) as (py & Py & py0 & ly).
  destruct (square_least (vz v) (x Expressions.Z_) (E Expressions.Z_) (small _)) as (pz & Pz & pz0 & lz).
  pose proof (Rle_0_sqr (x Expressions.X)) as sx. pose proof (Rle_0_sqr (x Expressions.Y)) as sy.
  pose proof (Rle_0_sqr (x Expressions.Z_)) as sz. unfold Rsqr in sx, sy, sz.
  set (X := x Expressions.X * x Expressions.X) in *. set (Y := x Expressions.Y * x Expressions.Y) in *.
  set (Z := x Expressions.Z_ * x Expressions.Z_) in *.
  pose proof (run (Sum (Product (vx v) (vx v)) (Product (vy v) (vy v)))) as h. cbn in h. rewrite Py in h.
  set (A := (1 - e1) * X - 1.001 * l) in *.
  assert (A1 : at_least (value_of (Product (vx v) (vx v))) px) by (right; exists px; repeat split; auto; lra).
  assert (ee : 0 <= e1 * e1 <= / 1000 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eX : 0 <= e1 * X) by (apply Rmult_le_pos; lra). assert (eY : 0 <= e1 * Y) by (apply Rmult_le_pos; lra).
  assert (eZ : 0 <= e1 * Z) by (apply Rmult_le_pos; lra). assert (el : 0 <= e1 * l) by (apply Rmult_le_pos; lra).
  assert (eeX : 0 <= e1 * (e1 * X)) by (apply Rmult_le_pos; lra).
  assert (eeY : 0 <= e1 * (e1 * Y)) by (apply Rmult_le_pos; lra).
  set (B := (1 - 2 * e1) * (X + Y) - 5.003 * l).
  assert (s1 : at_least (value_of (Sum (Product (vx v) (vx v)) (Product (vy v) (vy v)))) B).
  { apply (sum_least _ _ _ _ B h A1 py0); [lra|unfold B; lra|].
    assert ((1 - e1) * ((1 - e1) * (X + Y) - 4.002 * l) <= (1 - e1) * (px + py - 2 * l)) by (apply Rmult_le_compat_l;
      unfold A in lx; lra). unfold B. lra. }
  pose proof (run (dot_ v v)) as h'. unfold dot_ in h' |- *. cbn in h'. rewrite Pz in h'.
  set (C := (1 - 3 * e1) * (X + Y + Z) - 9.2 * l).
  assert (CO : C <= omega f) by (unfold C; lra).
  destruct s1 as [s1|(s & s1 & s0 & sB)].
  - rewrite s1 in h'. cbn in h'. left. exact h'.
  - rewrite s1 in h'. apply (sum_least _ _ _ s C h'); try lra; [right; exists s; repeat split; auto; lra|].
    assert ((1 - e1) * ((1 - 2 * e1) * (X + Y) + (1 - e1) * Z - 8.01 * l) <= (1 - e1) * (s + pz - 2 * l)) by (apply
      Rmult_le_compat_l; unfold B in sB; lra).
    assert (0 <= e1 * (e1 * Z)) by (apply Rmult_le_pos; lra). unfold C. lra.
Qed.
End Least.

(* Expressions of the filter in an environment. *)
Section Terms.
Variable of : Expressions.component -> Expressions.coordinate * Expressions.coordinate.
Definition constant_of c := match c with
  | Expressions.UnitRoundoff => UnitRoundoff | Expressions.Underflow => Underflow
  | Expressions.LargestEdge => LargestEdge | Expressions.Half => Half | Expressions.Small n => Small n end.
Fixpoint term (e : Expressions.expr_of Expressions.component) := match e with
  | Expressions.Difference c => Minus (Input (Place (fst (of c)))) (Input (Place (snd (of c))))
  | Expressions.Constant c => Constant (constant_of c)
  | Expressions.Sum a b => Sum (term a) (term b)
  | Expressions.Minus a b => Minus (term a) (term b)
  | Expressions.Product a b => Product (term a) (term b)
  | Expressions.Negative a => Negative (term a)
  | Expressions.Magnitude a => Magnitude (term a)
  | Expressions.Larger a b => Larger (term a) (term b)
  | Expressions.Smaller a b => Smaller (term a) (term b) end.
Definition told v := match v with
  | Number x => Expressions.Number x | Infinite s => Expressions.Infinite s | NaN => Expressions.NaN end.

Variable f : constants.
Variable env : environment f.
Variable given : input -> R.
Variable value_of : number -> value.
Hypothesis run : execution f env value_of given.
Notation seen := (seen f env).
Lemma seen_counts x : counts_as f x (seen x).
Proof.
  unfold Machine.seen. destruct (flushes_operands env); [destruct (Rlt_dec _ _)|]; [right|left|left]; auto.
Qed.
Lemma told_seen v : Expressions.counts f (told v) (told (seen_value f env v)).
Proof.
  destruct v as [x| |]; cbn; try (left; reflexivity). destruct (seen_counts x) as [->|[small ->]]; [left; reflexivity|].
  right. exists x. auto.
Qed.
Lemma told_result z out : result f env z out -> Expressions.result f z (told out).
Proof.
  intro r. exists (rounded env z). split; [apply nearly|].
  destruct r as [[a ->]|[[a [-> | ->]]|[a [-> | ->]]]]; cbn; auto.
Qed.
Lemma told_sum op signs v w out : sum f env op signs v w out -> Expressions.operation f op (told v) (told w) (told out).
Proof.
  intros s x y X Y. destruct v as [v| |]; try discriminate. destruct w as [w| |]; try discriminate.
  injection X as <-. injection Y as <-. exists (seen v), (seen w). repeat split; try apply seen_counts.
  now apply told_result.
Qed.
Lemma told_product v w out : product f env v w out -> Expressions.operation f Rmult (told v) (told w) (told out).
Proof.
  intros s x y X Y. destruct v as [v| |]; try discriminate. destruct w as [w| |]; try discriminate.
  injection X as <-. injection Y as <-. exists (seen v), (seen w). repeat split; try apply seen_counts.
  now apply told_result.
Qed.
Lemma told_greater v w : greater f env v w -> Expressions.greater f (told v) (told w).
Proof.
  intro g. exists (told (seen_value f env v)), (told (seen_value f env w)). split; [apply told_seen|].
  split; [apply told_seen|]. unfold greater in g.
  destruct (seen_value f env v) as [x|[|]|], (seen_value f env w) as [y|[|]|]; cbn in *; try tauto. lra.
Qed.
Lemma not_greater v w : v <> NaN -> w <> NaN -> ~ greater f env v w ->
  Expressions.below (told (seen_value f env v)) (told (seen_value f env w)).
Proof.
  intros nv nw g. unfold greater in g. destruct v as [x|[|]|], w as [y|[|]|]; cbn in *; try tauto; try congruence. lra.
Qed.
Lemma told_as_it_is v out : as_it_is f env v out -> Expressions.counts f (told v) (told out).
Proof. intros [-> | ->]; [left; reflexivity|apply told_seen]. Qed.
Lemma not_nan v : told v <> Expressions.NaN -> v <> NaN. Proof. intros h ->. now apply h. Qed.
Lemma told_larger v w out : larger f env v w out -> Expressions.larger f (told v) (told w) (told out).
Proof.
  intros h nv nw. apply not_nan in nv. apply not_nan in nw.
  exists (told (seen_value f env v)), (told (seen_value f env w)). split; [apply told_seen|]. split; [apply told_seen|].
  destruct h as [[no io]|[no io]]; [left|right]; (split; [now apply not_greater|now apply told_as_it_is]).
Qed.
Lemma told_smaller v w out : smaller f env v w out -> Expressions.smaller f (told v) (told w) (told out).
Proof.
  intros h nv nw. apply not_nan in nv. apply not_nan in nw.
  exists (told (seen_value f env v)), (told (seen_value f env w)). split; [apply told_seen|]. split; [apply told_seen|].
  destruct h as [[no io]|[no io]]; [left|right]; (split; [now apply not_greater|now apply told_as_it_is]).
Qed.
(* An execution in an environment is one of those that Expressions.v allows. *)
Theorem terms_are_executed : Expressions.execution f (fun c => given (Place (snd (of c))))
  (fun c => given (Place (fst (of c)))) (fun e => told (value_of (term e))).
Proof.
  intro e. pose proof (run (term e)) as h. destruct e; cbn [term] in h |- *.
  - rewrite (run (Input (Place (fst (of c))))), (run (Input (Place (snd (of c))))) in h.
    exact (told_sum _ _ _ _ _ h).
  - rewrite h. destruct c; reflexivity.
  - exact (told_sum _ _ _ _ _ h).
  - exact (told_sum _ _ _ _ _ h).
  - exact (told_product _ _ _ h).
  - rewrite h. now destruct (value_of (term e)).
  - rewrite h. now destruct (value_of (term e)).
  - exact (told_larger _ _ _ h).
  - exact (told_smaller _ _ _ h).
Qed.
End Terms.
