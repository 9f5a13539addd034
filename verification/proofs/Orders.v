(* Tests that only compare: what they compute, in an environment that treats a pair's numbers all alike. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Expressions.
Open Scope R_scope.

Inductive number :=
| Value (c : coordinate)
| Larger (a b : number) | Smaller (a b : number).
(* `Finite` asks whether the coordinates are, which the theorems assume. *)
Inductive mask := Greater (a b : number) | Both (a b : mask) | Either (a b : mask) | Finite.

(* An environment: whether subnormal operands count as zero. Comparisons round nothing. *)
Record environment := Environment { flushes_operands : bool }.

Section Machine.
Variable f : format.
Variable of : environment.
Definition flushed (x : R) := if Rlt_dec (Rabs x) (lam f) then 0 else x.
(* The number that an operand counts as. *)
Definition seen x := if flushes_operands of then flushed x else x.
Variable place : coordinate -> R.
(* One of the two, as a comparison has it, and perhaps as it is seen. *)
Definition chosen x y out := (seen y <= seen x /\ (out = x \/ out = seen x)) \/ (seen x <= seen y /\
  (out = y \/ out = seen y)).
Definition execution (value_of : number -> R) := forall e, match e with
  | Value c => value_of e = place c
  | Larger a b => chosen (value_of a) (value_of b) (value_of e)
  | Smaller a b => chosen (- value_of a) (- value_of b) (- value_of e) end.
Fixpoint says (value_of : number -> R) m := match m with
  | Greater a b => seen (value_of b) < seen (value_of a)
  | Both a b => says value_of a /\ says value_of b
  | Either a b => says value_of a \/ says value_of b
  | Finite => True end.

Lemma flushed_monotone x y : x <= y -> flushed x <= flushed y.
Proof.
  intro h. unfold flushed. assert (0 < lam f) by apply bpow_gt_0.
  destruct (Rlt_dec (Rabs x) (lam f)), (Rlt_dec (Rabs y) (lam f)); try lra.
  - unfold Rabs in *. destruct (Rcase_abs x), (Rcase_abs y); lra.
  - unfold Rabs in *. destruct (Rcase_abs x), (Rcase_abs y); lra.
Qed.
Lemma flushed_twice x : flushed (flushed x) = flushed x.
Proof. unfold flushed. destruct (Rlt_dec (Rabs x) (lam f)); [|destruct (Rlt_dec (Rabs x) (lam f)); tauto].
  destruct (Rlt_dec (Rabs 0) (lam f)); reflexivity. Qed.
Lemma flushed_opposite x : flushed (- x) = - flushed x.
Proof. unfold flushed. rewrite Rabs_Ropp. destruct (Rlt_dec (Rabs x) (lam f)); [ring|reflexivity]. Qed.
Lemma seen_monotone x y : x <= y -> seen x <= seen y.
Proof. unfold seen. destruct (flushes_operands of); [apply flushed_monotone|auto]. Qed.
Lemma seen_twice x : seen (seen x) = seen x.
Proof. unfold seen. destruct (flushes_operands of); [apply flushed_twice|reflexivity]. Qed.
Lemma seen_opposite x : seen (- x) = - seen x.
Proof. unfold seen. destruct (flushes_operands of); [apply flushed_opposite|reflexivity]. Qed.
Lemma seen_order x y : seen x < seen y -> x < y.
Proof. intro h. apply Rnot_le_lt. intro le. apply seen_monotone in le. lra. Qed.

Section Run.
Variable value_of : number -> R.
Hypothesis run : execution value_of.
Lemma seen_larger a b : seen (value_of (Larger a b)) = Rmax (seen (value_of a)) (seen (value_of b)).
Proof.
  pose proof (run (Larger a b)) as c. simpl in c.
  destruct c as [[le [-> | ->]]|[le [-> | ->]]]; rewrite ?seen_twice; [rewrite Rmax_left|rewrite Rmax_left|rewrite
    Rmax_right|rewrite Rmax_right]; auto.
Qed.
Lemma seen_smaller a b : seen (value_of (Smaller a b)) = Rmin (seen (value_of a)) (seen (value_of b)).
Proof.
  pose proof (run (Smaller a b)) as c. simpl in c.
  assert (E : value_of (Smaller a b) = - - value_of (Smaller a b)) by ring. rewrite E.
  destruct c as [[le [-> | ->]]|[le [-> | ->]]]; rewrite ?seen_opposite, ?seen_twice, ?seen_opposite,
    ?Ropp_involutive in *;
    [rewrite Rmin_left|rewrite Rmin_left|rewrite Rmin_right|rewrite Rmin_right]; lra.
Qed.
(* The number that operations see, whichever of two equal ones a maximum is. *)
Fixpoint sight e := match e with
  | Value c => seen (place c)
  | Larger a b => Rmax (sight a) (sight b)
  | Smaller a b => Rmin (sight a) (sight b) end.
Lemma is_seen e : seen (value_of e) = sight e.
Proof.
  induction e; cbn [sight].
  - now rewrite (run (Value c)).
  - now rewrite seen_larger, IHe1, IHe2.
  - now rewrite seen_smaller, IHe1, IHe2.
Qed.
Fixpoint orders m := match m with
  | Greater a b => sight b < sight a
  | Both a b => orders a /\ orders b
  | Either a b => orders a \/ orders b
  | Finite => True end.
Theorem says_what_is_ordered m : says value_of m -> orders m.
Proof. induction m; cbn [says orders]; rewrite ?is_seen; tauto. Qed.
End Run.
End Machine.
