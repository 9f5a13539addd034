(* The functions of `Words.v` and `Integers.v` compute what the code returned (`Sampled.v`): every loop over words, for
  all
   numbers of a few tiny words and for words of 64 bits at which carries, borrows and signs change, and the signs of all
   pairs that fuzzing keeps. *)
From Coq Require Import ZArith List Bool.
From Selvedge Require Import Words Integers.
From Selvedge Require Sampled.
Import ListNotations.
Open Scope Z_scope.

Fixpoint same a b := match a, b with
  | [], [] => true | x :: a, y :: b => (x =? y) && same a b | _, _ => false end.
Definition is_sign (a b : comparison) := match a, b with Lt, Lt | Eq, Eq | Gt, Gt => true | _, _ => false end.
(* Words whose contents must not matter. *)
Definition unwritten (w : Z) (ws : list Z) := map (fun _ => w) ws.

Definition agrees_tiny '(a, b, total, rest, product) := same (Words.sum 2 a b false) total && same (Words.sum 2 a b
  true) rest &&
  same (multiply_significant_words 2 a b (unwritten 3 product)) product.
Definition agrees_significant '(ws, significant, above, zeros) := same (without_repeated_sign 1 ws) significant &&
  let '(found, rest) := without_zeros_below ws in (found =? zeros)%nat && same rest above.
Theorem tiny_numbers_are_the_same : forallb agrees_tiny Sampled.tiny = true /\
  forallb agrees_significant Sampled.significant = true.
Proof. split; vm_cast_no_check (eq_refl true). Qed.

Definition agrees_fixed '(a, b, total, rest, sign) := same (integer_plus 64 a b) total && same (integer_minus 64 a b)
  rest &&
  is_sign (integer_sign 64 a) sign.
Definition agrees_product '(a, b, product) := same (integer_times 64 a b) product.
Theorem numbers_of_a_fixed_width_are_the_same :
  forallb agrees_fixed Sampled.fixed_sums = true /\ forallb agrees_product Sampled.fixed_products = true.
Proof. split; vm_cast_no_check (eq_refl true). Qed.

Definition agrees_in_space '(a, b, total, rest, product) := same (plus 64 a b) total && same (minus 64 a b) rest &&
  same (times 64 a b) product.
Definition agrees_minor '(a, b, c, d, one, three, triple, negative) := same (minor 64 a b c d) one &&
  same (sum_of_products 64 a d b c c d) three && same (tripled 64 a) triple && same (negated 64 d) negative.
Definition agrees_part '(a, sign, size, above) := is_sign (words_sign 64 a) sign && (count_bits 64 a =? size) &&
  same (map (word_above 64 a) [0; 1; 63; 64; 100]) above.
Theorem numbers_in_a_space_are_the_same : forallb agrees_in_space Sampled.in_space = true /\
  forallb agrees_minor Sampled.in_space_minors = true /\ forallb agrees_part Sampled.in_space_parts = true.
Proof. split; [|split]; vm_cast_no_check (eq_refl true). Qed.

Definition agrees_shifted '(significand, shift, one, two, five, in_space) := same (integer_shifted 64 1 significand
  shift) one &&
  same (integer_shifted 64 2 significand shift) two && same (integer_shifted 64 5 significand shift) five &&
  same (shifted 64 significand shift) in_space.
Theorem shifted_numbers_are_the_same : forallb agrees_shifted Sampled.shifted = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(* A pair's format and kind, its encodings along each axis, and its signs. *)
Definition agrees_signs (row : bool * bool * list Z * list Z * list Z * option (list comparison) * option bool) :=
  let '(is_double, is_edges, x, y, z, signs, _) := row in
  match control_value_signs (if is_double then double else single) (if is_edges then EdgeEdge else VertexFace)
    (Triple x y z), signs with
  | None, None => true
  | Some found, Some signs => (length found =? length signs)%nat && forallb (fun '(a, b) => is_sign a b) (combine found
    signs)
  | _, _ => false end.
Theorem signs_of_kept_pairs_are_the_same : forallb agrees_signs Sampled.kept = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
