(* The expressions of a kernel, their executions, and the distance of an execution from exact arithmetic. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Selvedge Require Import Arithmetic.
Open Scope R_scope.

(* The six differences of points: b - a, c - a, p - a, at the start and at the end of the step. *)
Inductive edge := B | C | P.
Inductive time := Start | End.
Inductive axis := X | Y | Z_.
Inductive component := Component (e : edge) (t : time) (a : axis).
(* A coordinate of one of a pair's four points, 0 to 3. *)
Inductive coordinate := Coordinate (point : nat) (t : time) (a : axis).
Inductive constant := UnitRoundoff | Underflow | LargestEdge | Half | Small (count : Z).
(* An expression over differences that are named by a type of their own: here by `component`. *)
Inductive expr_of (difference : Type) :=
| Difference (c : difference)
| Constant (c : constant)
| Sum (a b : expr_of difference) | Minus (a b : expr_of difference) | Product (a b : expr_of difference)
| Negative (a : expr_of difference) | Magnitude (a : expr_of difference)
| Larger (a b : expr_of difference) | Smaller (a b : expr_of difference).
(* A mask, without negations. `Finite` asks whether the coordinates are, which the theorems assume. *)
Inductive mask_of (difference : Type) :=
  Greater (a b : expr_of difference) | Both (a b : mask_of difference) | Either (a b : mask_of difference) | Finite.
Arguments Difference {difference}. Arguments Constant {difference}. Arguments Sum {difference}.
  Arguments Minus {difference}.
Arguments Product {difference}. Arguments Negative {difference}. Arguments Magnitude {difference}.
  Arguments Larger {difference}.
Arguments Smaller {difference}. Arguments Greater {difference}. Arguments Both {difference}.
  Arguments Either {difference}.
Arguments Finite {difference}.
Notation expr := (expr_of component).
Notation mask := (mask_of component).

Inductive value := Number (x : R) | Infinite (positive : bool) | NaN.

Section Machine.
Variable f : format.
Context {component : Type}.
Notation expr := (expr_of component).
Notation mask := (mask_of component).

(* The result of an operation whose exact result is z: rounded, or overflow, which is infinite or the largest finite
   number. *)
Definition result z v := exists r, rounds f z r /\
  ((Rabs r <= omega f /\ v = Number r) \/
   (omega f < r /\ (v = Infinite true \/ v = Number (omega f))) \/
   (r < - omega f /\ (v = Infinite false \/ v = Number (- omega f)))).
(* An operation with an operand that is no finite number may give anything. *)
Definition operation (op : R -> R -> R) v w out := forall x y, v = Number x -> w = Number y ->
  exists x' y', counts_as f x x' /\ counts_as f y y' /\ result (op x' y') out.

Definition counts v v' := v' = v \/ exists x, v = Number x /\ Rabs x < lam f /\ v' = Number 0.
Definition below v w := match v, w with
  | NaN, _ | _, NaN => False
  | Number x, Number y => x <= y
  | Infinite false, _ | _, Infinite true => True
  | _, _ => False end.
Definition beyond v w := match v, w with
  | NaN, _ | _, NaN => False
  | _, _ => ~ below v w end.
(* One of the two, as a comparison has it; anything where one is NaN. *)
Definition larger v w out := v <> NaN -> w <> NaN -> exists v' w', counts v v' /\ counts w w' /\
  ((below w' v' /\ counts v out) \/ (below v' w' /\ counts w out)).
Definition smaller v w out := v <> NaN -> w <> NaN -> exists v' w', counts v v' /\ counts w w' /\
  ((below v' w' /\ counts v out) \/ (below w' v' /\ counts w out)).
Definition greater v w := exists v' w', counts v v' /\ counts w w' /\ beyond v' w'.
Definition negative v := match v with Number x => Number (- x) | Infinite s => Infinite (negb s) | NaN => NaN end.
Definition magnitude v := match v with Number x => Number (Rabs x) | Infinite _ => Infinite true | NaN => NaN end.
Definition constant_value c := match c with
  | UnitRoundoff => unit_roundoff f
  | Underflow => power (underflow f)
  | LargestEdge => power (largest_edge f)
  | Half => / 2
  | Small count => IZR count end.

(* An execution gives each expression a value that its operation allows; `from` and `to` are the coordinates of the
   points. *)
Definition execution (from to : component -> R) (value_of : expr -> value) := forall e : expr, match e with
  | Difference c => operation Rminus (Number (to c)) (Number (from c)) (value_of e)
  | Constant c => value_of e = Number (constant_value c)
  | Sum a b => operation Rplus (value_of a) (value_of b) (value_of e)
  | Minus a b => operation Rminus (value_of a) (value_of b) (value_of e)
  | Product a b => operation Rmult (value_of a) (value_of b) (value_of e)
  | Negative a => value_of e = negative (value_of a)
  | Magnitude a => value_of e = magnitude (value_of a)
  | Larger a b => larger (value_of a) (value_of b) (value_of e)
  | Smaller a b => smaller (value_of a) (value_of b) (value_of e) end.
(* The condition that a mask may be true. *)
Fixpoint says (value_of : expr -> value) (m : mask) := match m with
  | Greater a b => greater (value_of a) (value_of b)
  | Both a b => says value_of a /\ says value_of b
  | Either a b => says value_of a \/ says value_of b
  | Finite => True end.

End Machine.

Section Measures.
Context {component : Type}.
Notation expr := (expr_of component).

(* Size: with differences at most m >= 1, an expression is at most `size` times m^degree, if nothing overflows. *)
Fixpoint degree (e : expr) : nat := match e with
  | Difference _ => 1
  | Constant _ => 0
  | Sum a b | Minus a b | Larger a b | Smaller a b => Nat.max (degree a) (degree b)
  | Product a b => degree a + degree b
  | Negative a | Magnitude a => degree a end.
Fixpoint size (e : expr) : Z := match e with
  | Difference _ => 1
  | Constant (Small count) => Z.max 1 count
  | Constant _ => 1
  | Sum a b | Minus a b => 2 * (size a + size b) + 1
  | Larger a b | Smaller a b => Z.max (size a) (size b)
  | Product a b => 2 * (size a * size b) + 1
  | Negative a | Magnitude a => size a end%Z.
(* Nothing overflows with differences up to 2^edge: all sizes are below 2^30 times three such factors. *)
Fixpoint fits (e : expr) : bool := ((size e <=? 2 ^ 30)%Z && (degree e <=? 3)%nat && match e with
  | Difference _ => true
  | Constant LargestEdge => false
  | Constant (Small count) => (0 <=? count)%Z
  | Constant _ => true
  | Sum a b | Minus a b | Larger a b | Smaller a b | Product a b => fits a && fits b
  | Negative a | Magnitude a => fits a end)%bool.

(* The polynomial that an expression stands for, given its leaves, and its permanent. *)
Section Exact.
Variable leaf : component -> R.
Fixpoint exact (e : expr) : R := match e with
  | Difference c => leaf c
  | Sum a b => exact a + exact b
  | Minus a b => exact a - exact b
  | Product a b => exact a * exact b
  | Magnitude a => Rabs (exact a)
  | Negative a => - exact a
  | _ => 0 end.
Fixpoint permanent (e : expr) : R := match e with
  | Difference c => Rabs (leaf c)
  | Sum a b | Minus a b => permanent a + permanent b
  | Product a b => permanent a * permanent b
  | Magnitude a | Negative a => permanent a
  | _ => 0 end.
End Exact.

(* Counts that bound the error, and a check that they are small enough for their second order not to matter. *)
Fixpoint monomials (e : expr) : Z := match e with
  | Sum a b | Minus a b => monomials a + monomials b
  | Product a b => monomials a * monomials b
  | Magnitude a | Negative a => monomials a
  | _ => 1 end%Z.
Fixpoint depth (e : expr) : nat := match e with
  | Sum a b | Minus a b => S (Nat.max (depth a) (depth b))
  | Product a b => S (depth a + depth b)
  | Magnitude a | Negative a => depth a
  | _ => 0 end.
(* The loss by underflow, in units of lambda: by the steps of an expression, and by its differences, each off by 3. *)
Fixpoint of_steps (e : expr) : Z := match e with
  | Sum a b | Minus a b => (of_steps a + 1) + (of_steps b + 1) + 2
  | Product a b => monomials a * (of_steps b + 1) + (of_steps a + 1) * monomials b + 3
  | Magnitude a | Negative a => of_steps a
  | _ => 0 end%Z.
Fixpoint of_differences (e : expr) : Z := match e with
  | Difference _ => 3
  | Sum a b | Minus a b => of_differences a + of_differences b
  | Product a b => monomials a * of_differences b + of_differences a * monomials b + 1
  | _ => 0 end%Z.
Fixpoint polynomial (e : expr) : bool := ((of_steps e <=? 4096)%Z && (of_differences e <=? 4096)%Z && (monomials e <=?
  64)%Z
  && (depth e <=? 16)%nat && match e with
  | Difference _ => true
  | Sum a b | Minus a b | Product a b => polynomial a && polynomial b
  | Magnitude (Difference _) => true
  | _ => false end)%bool.
End Measures.
