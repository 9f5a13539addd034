(* What the files that run terms in Flocq's binary numbers assume in their sections, each by `Load`: a binary format, and the
   exponents of the constants that the code adds in it. *)
Variables prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_ : Z.
Context (p0 : Prec_gt_0 prec) (pe : Prec_lt_emax prec emax).
(* A theorem or a function of Chains.v in this format. *)
Notation in_format theorem := (theorem prec emax underflow_ largest_ extent_ reach_ safe_ vanishing_).
Notation f := (in_format Chains.constants_of).
Notation binary := (binary_float prec emax).
