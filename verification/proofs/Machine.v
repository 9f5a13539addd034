(* What the time of impact computes: numbers and masks, in one floating-point environment of a thread. *)
From Coq Require Import Reals ZArith Lra Lia Bool.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic.
From Selvedge Require Expressions.
Open Scope R_scope.

(* The format's constants that the time of impact adds: the exponents of μ, of the largest extent and of two limits of
   lengths. *)
Record constants := Constants { base :> format; extent_underflow : Z; largest_extent : Z; safe_square : Z;
  length_underflow : Z }.

(* A coordinate of one of the four points, a component of one of the directions that are tried, a time, a length or the
   slack of a gap. A gap may be stored, none less than the least and none more than the largest. A program (Replay.v) computes
   each of its numbers once, and refers to it by its place. *)
Inductive length := Separation | LargestCoordinate | Slack | StoredGap | LeastGap | LargestGap.
Inductive input :=
| Length (l : length)
| Place (c : Expressions.coordinate)
| Along (direction : nat) (a : Expressions.axis)
| Moment (n : nat)
| Saved (place : positive).
Inductive constant := UnitRoundoff | Underflow | ExtentUnderflow | LargestExtent | Half | Small (count : Z) |
  LargestEdge
  | SafeSquare | LengthUnderflow.
Inductive number :=
| Input (i : input) | Constant (c : constant)
| Sum (a b : number) | Minus (a b : number) | Product (a b : number) | Quotient (a b : number)
| Negative (a : number) | Magnitude (a : number)
| Larger (a b : number) | Smaller (a b : number) | Select (m : mask) (a b : number) | Root (a : number)
with mask := Always | Greater (a b : number) | Both (a b : mask) | Either (a b : mask) | Not (m : mask).

Inductive value := Number (x : R) | Infinite (positive : bool) | NaN.

(* An environment: how results are rounded, and whether subnormal operands count as zero. Both stay the same for all of
   a pair. *)
Record environment f := Environment {
  rounded : R -> R;
  flushes_operands : bool;
  monotone : forall x y, x <= y -> rounded x <= rounded y;
  settled : forall z, rounded (rounded z) = rounded z;
  nearly : forall z, rounds f z (rounded z) }.
Arguments rounded {f}. Arguments flushes_operands {f}. Arguments monotone {f}. Arguments settled {f}.
  Arguments nearly {f}.

Section Machine.
Variable f : constants.
Variable env : environment f.

(* What an operand counts as. *)
Definition seen x := if flushes_operands env then if Rlt_dec (Rabs x) (lam f) then 0 else x else x.
Definition seen_value v := match v with Number x => Number (seen x) | _ => v end.

(* The result of an operation whose exact result is z: rounded, or overflow, which is infinite or the largest finite
   number. *)
Definition result z out := let r := rounded env z in
  (Rabs r <= omega f /\ out = Number r) \/
  (omega f < r /\ (out = Infinite true \/ out = Number (omega f))) \/
  (r < - omega f /\ (out = Infinite false \/ out = Number (- omega f))).
Definition sum (op : R -> R -> R) (sign_of_second : bool -> bool) v w out := match seen_value v, seen_value w with
  | Number x, Number y => result (op x y) out
  | NaN, _ | _, NaN => out = NaN
  | Infinite s, Number _ => out = Infinite s
  | Number _, Infinite s => out = Infinite (sign_of_second s)
  | _, _ => True end.
Definition product v w out := match seen_value v, seen_value w with
  | Number x, Number y => result (x * y) out
  | NaN, _ | _, NaN => out = NaN
  | Infinite s, Number y | Number y, Infinite s => 0 < y -> out = Infinite s
  | _, _ => True end.
(* By zero: 0/0 is NaN, and other quotients are infinite. They have the dividend's sign if the zero is what is left of a
   positive number. *)
Definition quotient v w (divisor_is_positive : Prop) out := match seen_value v, seen_value w with
  | Number x, Number y => (y <> 0 -> result (x / y) out) /\ (y = 0 -> x = 0 -> out = NaN) /\
    (y = 0 -> 0 < x -> divisor_is_positive -> out = Infinite true) /\
    (y = 0 -> x < 0 -> divisor_is_positive -> out = Infinite false)
  | NaN, _ | _, NaN => out = NaN
  | _, _ => True end.

(* The root of a negative number is NaN. *)
Definition root v out := match seen_value v with
  | Number x => (0 <= x -> result (sqrt x) out) /\ (x < 0 -> out = NaN)
  | Infinite true => out = Infinite true
  | _ => out = NaN end.

(* A comparison is false with NaN. *)
Definition greater v w := match seen_value v, seen_value w with
  | NaN, _ | _, NaN => False
  | Number x, Number y => y < x
  | Infinite false, _ | _, Infinite true => False
  | _, _ => True end.
Definition as_it_is v out := out = v \/ out = seen_value v.
Definition larger v w out := (~ greater w v /\ as_it_is v out) \/ (~ greater v w /\ as_it_is w out).
Definition smaller v w out := (~ greater v w /\ as_it_is v out) \/ (~ greater w v /\ as_it_is w out).
Definition negative v := match v with Number x => Number (- x) | Infinite s => Infinite (negb s) | NaN => NaN end.
Definition magnitude v := match v with Number x => Number (Rabs x) | Infinite _ => Infinite true | NaN => NaN end.
Definition constant_value c := match c with
  | UnitRoundoff => unit_roundoff f
  | Underflow => power (underflow f)
  | ExtentUnderflow => power (extent_underflow f)
  | LargestExtent => power (largest_extent f)
  | Half => / 2
  | Small count => IZR count
  | LargestEdge => power (largest_edge f)
  | SafeSquare => power (safe_square f)
  | LengthUnderflow => power (length_underflow f) end.

Section Values.
Variable value_of : number -> value.
Fixpoint says m : Prop := match m with
  | Always => True
  | Greater a b => greater (value_of a) (value_of b)
  | Both a b => says a /\ says b
  | Either a b => says a \/ says b
  | Not a => ~ says a end.
(* What a number is the rounded result of, positive. *)
Fixpoint is_positive_unrounded e : Prop := match e with
  | Minus a b => greater (value_of a) (value_of b)
  | Product (Constant (Small count)) b => (0 < count)%Z /\ is_positive_unrounded b
  | _ => False end.
(* An execution gives each number the value that its operation gives. *)
Definition execution (given : input -> R) := forall e, match e with
  | Input i => value_of e = Number (given i)
  | Constant c => value_of e = Number (constant_value c)
  | Sum a b => sum Rplus (fun s => s) (value_of a) (value_of b) (value_of e)
  | Minus a b => sum Rminus negb (value_of a) (value_of b) (value_of e)
  | Product a b => product (value_of a) (value_of b) (value_of e)
  | Quotient a b => quotient (value_of a) (value_of b) (is_positive_unrounded b) (value_of e)
  | Negative a => value_of e = negative (value_of a)
  | Magnitude a => value_of e = magnitude (value_of a)
  | Larger a b => larger (value_of a) (value_of b) (value_of e)
  | Smaller a b => smaller (value_of a) (value_of b) (value_of e)
  | Select m a b => (says m /\ value_of e = value_of a) \/ (~ says m /\ value_of e = value_of b)
  | Root a => root (value_of a) (value_of e) end.
End Values.
End Machine.
