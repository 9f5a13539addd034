(* What the files about the time of impact, gaps and separations assume in their sections, each by `Load`: a format, an
   environment, and an execution in it of what the code computes from given inputs. *)
Variable f : constants.
Hypothesis fine : reasonable_constants f.
Let ok : reasonable f := reasonable_base f fine.
Variable env : environment f.
Variable given : input -> R.
Variable value_of : Machine.number -> value.
Hypothesis run : execution f env value_of given.
(* A theorem of such a section, in this one. *)
Notation here theorem := (theorem f fine env given value_of run).
Notation l := (lam f).
Notation e1 := (eps f).
Notation q := (Bounds.q f).
Notation u := (unit_roundoff f).
Notation Rd := (rounded env).
Notation seen := (seen f env).
Notation holds := (holds f).
Notation operand := (operand f env).
Notation G := (Errors.reach f).
Notation mu := (power (extent_underflow f)).
Notation eta := (power (underflow f)).
(* The errors of operands, products and sums. *)
Notation seen_holds := (seen_operand f env _ _ _ _ _).
Notation product_holds := (holds_product f ok env _ _ _ _ _ _ _ _ _ _ _).
Notation sum_holds op := (holds_sum f ok env op _ _ _ _ _ _ _ _ _ _ _).
