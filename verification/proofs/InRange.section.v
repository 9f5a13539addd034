(* The corners of a pair in range, after Setting.section.v. *)
Variable pairs : list (nat * nat).
Hypothesis in_range : says f env value_of (are_in_range pairs).
(* A theorem of such a section, in this one. *)
Notation within theorem := (theorem f fine env given value_of run pairs in_range).
Notation m := (m f env value_of pairs).
Notation p := (p f env value_of pairs).
Notation M a := (Rd (m a + mu)).
Notation at_ := (exactly_at given).
Notation exactly := (exactly given).
