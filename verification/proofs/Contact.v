(* The exact verdict: core/src/kernels/exact/contact/mod.rs, in its shape, with the steps of `Verdicts.v`.
  Coq computes the
   code's verdicts for the pairs that fuzzing keeps (`Sampled.v`). *)
From Coq Require Import Reals ZArith List Bool.
From Selvedge Require Import Integers Verdicts.
From Selvedge Require Sampled.
Import ListNotations.
Open Scope Z_scope.

Section Contact.
Context {T : Type} (r : ring T).
(* `Polygon`: each corner's coordinates at the start and at the end, around it, along an axis; and how many there are.
  *)
Definition between (a b : T * T) := (minus_ r (fst a) (fst b), minus_ r (snd a) (snd b)).
Definition corners kind (axis : nat -> T) :=
  let ends n := (axis n, axis (4 + n)%nat) in
  let a := ends 0%nat in let b := ends 1%nat in let c := ends 2%nat in let d := ends 3%nat in
  match kind with
  | VertexFace => let first := between a b in [first; between a c; between a d; first; first]
  | EdgeEdge => let first := between a c in [first; between a d; between b d; between b c; first] end.
Definition count kind := match kind with VertexFace => 3%nat | EdgeEdge => 4%nat end.
(* One component of the cross product of neighbours: a quadratic. *)
Definition cross_of '((y0, z0), (y1, z1)) := let '(a0, a1) := y0 in let '(b0, b1) := z0 in let '(c0, c1) := y1 in
  let '(d0, d1) := z1 in [minor_ r a0 b0 c0 d0; plus_ r (minor_ r a0 b0 c1 d1) (minor_ r a1 b1 c0 d0);
    minor_ r a1 b1 c1 d1] : list T.
Definition projection n (y z : list (T * T)) := let points := combine y z in
  map cross_of (firstn n (combine points (tl points))).
Definition projections n '(x, y, z) := [projection n y z; projection n z x; projection n x y].
Definition coordinates n '(x, y, z) : list (list (list T)) :=
  map (fun axis => map (fun '(a, b) => [a; b]) (firstn n axis)) [x; y; z].
Definition is_less sign := match sign with Lt => true | _ => false end.
Definition is_greater sign := match sign with Gt => true | _ => false end.
(* `contains_origin`: at a time that gives signs, when the corners are coplanar with the origin. *)
Fixpoint turns (sign : list T -> comparison) projections (otherwise : bool) := match projections with
  | [] => otherwise
  | crosses :: rest => let found := map sign crosses in
      let left := existsb is_greater found in let right := existsb is_less found in
      if left && right then false else if left || right then true else turns sign rest otherwise end.
Definition contains_origin n polygon sign := turns sign (projections n polygon)
  (forallb (fun axis => match map sign axis with
    | [] => true
    | first :: rest => equal_signs first Eq || existsb (fun other => negb (equal_signs other first)) rest end)
    (coordinates n polygon)).
Definition at_start (polynomial : list T) := sign_ r (hd (zero r) polynomial).
Definition at_end (polynomial : list T) := sign_ r (last polynomial (zero r)).
Definition touches_in_plane n polygon := existsb (fun polynomial =>
  existsb (fun q => contains_origin n polygon (sign_at_root r q)) (positive r polynomial))
  (concat (coordinates n polygon) ++ concat (projections n polygon)).
Definition touches n polygon k0 k1 k2 k3 :=
  if is_zero r k0 && contains_origin n polygon at_start || is_zero r k3 && contains_origin n polygon at_end then true
    else
  if forallb (is_zero r) [k0; k1; k2; k3] then touches_in_plane n polygon else
  existsb (fun moment => contains_origin n polygon (sign_at r moment)) (times_of r k0 k1 k2 k3).
End Contact.

(* Of encodings, in whole numbers; words give the same (`Verdicts.times_in_words`). *)
Definition verdict s kind encodings :=
  let axes := each (map (take_apart s)) encodings in if all_finite axes then
  (* Zero has no exponent of its own, and is not shifted. *)
  let number significand shift := if significand =? 0 then 0 else significand * 2 ^ shift in
  let v := each (fun terms n => nth n (integers number terms) 0) axes in
  let polygon := (corners whole kind (x_ v), corners whole kind (y_ v), corners whole kind (z_ v)) in
  match control_values exact kind v with
  | [k0; k1; k2; k3] => Some (touches whole (count kind) polygon k0 k1 k2 k3)
  | _ => None end else None.
(* Pairs in one of the fixed widths: the others' whole numbers have thousands of bits, and would take minutes. *)
Definition is_narrow s encodings := let axes := each (map (take_apart s)) encodings in
  Z.max (Z.max (bits_of (x_ axes)) (bits_of (y_ axes))) (bits_of (z_ axes)) <=? 317.
Definition agrees (row : bool * bool * list Z * list Z * list Z * option (list comparison) * option bool) :=
  let '(is_double, is_edges, x, y, z, _, touches) := row in
  let s := if is_double then double else single in if negb (is_narrow s (Triple x y z)) then true else
  match verdict s (if is_edges then EdgeEdge else VertexFace) (Triple x y z), touches with
  | None, None => true | Some found, Some touches => Bool.eqb found touches | _, _ => false end.
Theorem verdicts_of_kept_pairs_are_the_same : forallb agrees Sampled.kept = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
(* Some touch, and some do not. *)
Theorem verdicts_differ : existsb (fun row => match snd row with Some true => true | _ => false end) Sampled.kept =
  true /\
  existsb (fun row => match snd row with Some false => true | _ => false end) Sampled.kept = true.
Proof. split; reflexivity. Qed.
