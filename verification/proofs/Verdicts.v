(* The polynomial steps of the exact verdict: core/src/kernels/exact/contact, in its shape. Numbers are of any ring that
   computes with whole numbers, as a space of words does (`Words.v`). A polynomial is the list of its coefficients, the
   constant first. *)
From Coq Require Import Reals ZArith Lia Lra Psatz List Bool.
From Selvedge Require Import Words Integers.
Import ListNotations.
Open Scope Z_scope.

(* remainder.rs. *)
Record ring T := Ring { zero : T; plus_ : T -> T -> T; minus_ : T -> T -> T; times_ : T -> T -> T;
  minor_ : T -> T -> T -> T -> T; sign_ : T -> comparison }.
Arguments zero {T}. Arguments plus_ {T}. Arguments minus_ {T}. Arguments times_ {T}. Arguments minor_ {T}.
  Arguments sign_ {T}.
Section Remainder.
Context {T : Type} (r : ring T).
Fixpoint quotient_steps a b (coefficients : list T) value power first := match coefficients with
  | [] => value
  | coefficient :: rest => let power := if first : bool then power else times_ r power b in
      quotient_steps a b rest (minor_ r coefficient value a power) power false end.
Definition value_at_quotient a b polynomial := match rev polynomial with
  | [] => zero r
  | value :: coefficients => quotient_steps a b coefficients value b true end.
Fixpoint remainder_steps a b c (coefficients : list T) l0 l1 power first := match coefficients with
  | [] => (l0, l1)
  | coefficient :: rest => let power := if first : bool then power else times_ r power c in
      remainder_steps a b c rest (minor_ r coefficient l1 a power) (minor_ r l0 l1 b c) power false end.
Definition remainder a b c polynomial := match rev polynomial with
  | [] => (zero r, zero r)
  | [l1] => (zero r, l1)
  | l1 :: l0 :: coefficients => remainder_steps a b c coefficients l0 l1 c true end.
Definition terms a b c polynomial := let '(l0, l1) := remainder a b c polynomial in
  let from_l0 := times_ r l0 c in let of_b := times_ r l1 b in
  let half := minus_ r from_l0 of_b in
  let of_half := times_ r l0 half in let squared := times_ r l1 l1 in
  let of_a := times_ r squared a in
  (l1, plus_ r half from_l0, plus_ r of_half of_a).

(* moment.rs: `Root`, without the first attempt by rounded numbers. *)
Inductive side := Lower | Upper.
Record root := Root { constant : T; linear : T; square : T; at_side : side }.
Definition is_zero x := match sign_ r x with Eq => true | _ => false end.
Definition of_root side l1 := match side with Lower => CompOpp l1 | Upper => l1 end.
Definition equal_signs (a b : comparison) := match a, b with Lt, Lt | Eq, Eq | Gt, Gt => true | _, _ => false end.
Definition sign_at_root root polynomial :=
  if forallb is_zero polynomial then Eq else
  if is_zero (square root) then sign_ r (value_at_quotient (constant root) (linear root) polynomial) else
  let '(l1, first, last) := terms (constant root) (linear root) (square root) polynomial in
  let of_root := of_root (at_side root) (sign_ r l1) in
  let first := sign_ r first in
  if equal_signs of_root Eq || equal_signs of_root first then first else
  match sign_ r last with Lt => of_root | Eq => Eq | Gt => first end.
End Remainder.

(* What polynomials and roots are in real numbers. *)
Definition whole := Ring Z 0 Z.add Z.sub Z.mul (fun a b c d => a * d - b * c) (fun x => x ?= 0).
Definition at_ polynomial s := fold_right (fun k v => (IZR k + v * s)%R) 0%R polynomial.
Open Scope R_scope.
Definition discriminant (q : root) : R := IZR (linear q) ^ 2 - 4 * IZR (constant q) * IZR (square q).
Definition root_value (q : root) : R := if Z.eqb (square q) 0 then - IZR (constant q) / IZR (linear q) else
  (- IZR (linear q) + (match at_side q with Lower => -1 | Upper => 1 end) * sqrt (discriminant q)) / (2 * IZR (square
    q)).
(* The last coefficient that is not zero is positive, and there is a root. *)
Definition is_root (q : root) := (square q = 0%Z /\ (0 < linear q)%Z) \/ ((0 < square q)%Z /\ 0 <= discriminant q).

Lemma from_the_top p s : at_ p s = fold_left (fun v k => v * s + IZR k) (rev p) 0.
Proof.
  unfold at_. rewrite <- (rev_involutive p) at 1. rewrite fold_left_rev_right.
  generalize 0 as v. induction (rev p) as [|k l IH]; intro v; [reflexivity|]. cbn [fold_left].
  rewrite (Rplus_comm (IZR k)). apply IH.
Qed.
(* Horner's rule at a quotient: the value times a power of b. *)
Lemma quotient_steps_are a b coefficients value power first v n : IZR b <> 0 -> IZR value = v * IZR b ^ n ->
  (if first : bool then n = 0%nat /\ power = b else IZR power = IZR b ^ n) ->
  exists k, IZR (quotient_steps whole a b coefficients value power first) =
    fold_left (fun v k => v * (- IZR a / IZR b) + IZR k) coefficients v * IZR b ^ k.
Proof.
  intro b0. revert value power first v n. induction coefficients as [|k rest IH]; intros value power first v n E P.
  - exists n. exact E.
  - cbn [quotient_steps fold_left]. apply (IH _ _ _ _ (S n)).
    + cbn [whole minor_]. rewrite minus_IZR, !mult_IZR, E.
      assert (IZR (if first then power else times_ whole power b) = IZR b ^ S n) as ->.
      { destruct first; [destruct P as [-> ->]; ring|]. cbn [whole times_]. rewrite mult_IZR, P. cbn [pow]. ring. }
      cbn [pow]. field. exact b0.
    + destruct first; [destruct P as [-> ->]; ring|]. cbn [whole times_]. rewrite mult_IZR, P. cbn [pow]. ring.
Qed.
Theorem value_at_quotient_is a b p : (0 < b)%Z -> exists k, IZR (value_at_quotient whole a b p) = at_ p (- IZR a / IZR
  b) * IZR b ^ k.
Proof.
  intro b0. apply IZR_lt in b0. unfold value_at_quotient. rewrite from_the_top. destruct (rev p) as [|v l].
  - exists 0%nat. cbn. ring.
  - cbn [fold_left]. apply (quotient_steps_are a b l v b true _ 0); [lra| |auto]. cbn. ring.
Qed.
(* The remainder is a positive multiple of the polynomial at both roots of the quadratic. *)
Lemma remainder_steps_are a b c coefficients l0 l1 power first v n s : IZR a + IZR b * s + IZR c * s ^ 2 = 0 ->
  v * IZR c ^ n = IZR l0 + IZR l1 * s ->
  (if first : bool then n = 0%nat /\ power = c else IZR power = IZR c ^ n) ->
  exists k, let '(l0, l1) := remainder_steps whole a b c coefficients l0 l1 power first in
    fold_left (fun v k => v * s + IZR k) coefficients v * IZR c ^ k = IZR l0 + IZR l1 * s.
Proof.
  intro root. revert l0 l1 power first v n. induction coefficients as [|k rest IH]; intros l0 l1 power first v n E P.
  - exists n. exact E.
  - cbn [remainder_steps fold_left].
    assert (Q : IZR (if first then power else times_ whole power c) = IZR c ^ S n).
    { destruct first; [destruct P as [-> ->]; ring|]. cbn [whole times_]. rewrite mult_IZR, P. cbn [pow]. ring. }
    apply (IH _ _ _ _ _ (S n)).
    + cbn [whole minor_]. rewrite !minus_IZR, !mult_IZR. rewrite Q.
      replace ((v * s + IZR k) * IZR c ^ S n) with ((v * IZR c ^ n) * IZR c * s + IZR k * IZR c ^ S n) by (cbn [pow];
        ring).
      rewrite E. replace ((IZR l0 + IZR l1 * s) * IZR c * s + IZR k * IZR c ^ S n) with
        (IZR l0 * IZR c * s + IZR l1 * (IZR c * s ^ 2) + IZR k * IZR c ^ S n) by ring.
      replace (IZR c * s ^ 2) with (- IZR a - IZR b * s) by lra. ring.
    + exact Q.
Qed.
Theorem remainder_is a b c p s : (2 <= length p)%nat -> IZR a + IZR b * s + IZR c * s ^ 2 = 0 ->
  exists k, let '(l0, l1) := remainder whole a b c p in at_ p s * IZR c ^ k = IZR l0 + IZR l1 * s.
Proof.
  intros two root. unfold remainder. rewrite from_the_top. rewrite <- rev_length in two.
  destruct (rev p) as [|l1 [|l0 l]]; try (cbn in two; lia). cbn [fold_left].
  apply (remainder_steps_are a b c l l0 l1 c true _ 0 s root); [cbn; ring|auto].
Qed.
Theorem terms_are a b c p : let '(l0, l1) := remainder whole a b c p in let '(l1', first, last) := terms whole a b c p
  in
  l1' = l1 /\ first = (2 * c * l0 - b * l1)%Z /\ last = (c * l0 * l0 - b * l0 * l1 + a * l1 * l1)%Z.
Proof.
  unfold terms. destruct (remainder whole a b c p) as [l0 l1]. cbn [whole times_ minus_ plus_].
  split; [reflexivity|]. split; ring.
Qed.
(* The sign of first + of_root, given the sign of first^2 - of_root^2. *)
Lemma says_iff x : says x Lt <-> x < 0. Proof. reflexivity. Qed.
Lemma says_compare k : says (IZR k) (Z.compare k 0).
Proof. unfold says. destruct (Z.compare_spec k 0) as [->|h|h]; [reflexivity|apply IZR_lt in h|apply IZR_lt in h];
  assumption. Qed.
Lemma says_times x y sign : 0 < y -> says (x * y) sign -> says x sign.
Proof. intros pos. unfold says. destruct sign; intro h; nra. Qed.
Lemma says_scaled x y sign : 0 < y -> says x sign -> says (x * y) sign.
Proof. intros pos. unfold says. destruct sign; intro h; nra. Qed.
Lemma says_opposite x sign : says x sign -> says (- x) (CompOpp sign).
Proof. unfold says. destruct sign; cbn; lra. Qed.
Lemma says_one x a b : says x a -> says x b -> a = b.
Proof. unfold says. destruct a, b; try reflexivity; lra. Qed.
Lemma sign_of_sum x y sx sy sl : says x sx -> says y sy -> says (x ^ 2 - y ^ 2) sl ->
  says (x + y) (if equal_signs sy Eq || equal_signs sy sx then sx else match sl with Lt => sy | Eq => Eq | Gt => sx
    end).
Proof.
  unfold says. intros hx hy hl. destruct sx, sy; cbn [equal_signs orb]; try (subst; lra); try lra; destruct sl; try nra.
Qed.
Lemma pow_pos_of c k : 0 < c -> 0 < c ^ k. Proof. apply pow_lt. Qed.
Lemma root_value_is_root (q : root) : is_root q -> IZR (constant q) + IZR (linear q) * root_value q + IZR (square q) *
  root_value q ^ 2 = 0.
Proof.
  intros [[c0 b0]|[c0 d0]]; unfold root_value.
  - rewrite c0. cbn [Z.eqb]. apply IZR_lt in b0. field. lra.
  - destruct (Z.eqb_spec (square q) 0); [lia|]. apply IZR_lt in c0. pose proof (sqrt_sqrt _ d0) as S.
    set (w := sqrt (discriminant q)) in *. unfold discriminant in S.
      set (e := match at_side q with Lower => -1 | Upper => 1 end).
    assert (e * e = 1) as ee by (unfold e; destruct (at_side q); ring).
    apply (Rmult_eq_reg_r (4 * IZR (square q))); [|lra].
    replace (_ * (4 * IZR (square q))) with (4 * IZR (constant q) * IZR (square q) - IZR (linear q) ^ 2 + (e * e) * (w
      * w)) by (field; lra).
    rewrite ee, S. ring.
Qed.
(* **The sign at a root** is that of the polynomial there, for linear ones and any of higher degree. *)
Theorem sign_at_root_is (q : root) p : is_root q -> (2 <= length p)%nat ->
  says (at_ p (root_value q)) (sign_at_root whole q p).
Proof.
  intros hq two. unfold sign_at_root. destruct (forallb (is_zero whole) p) eqn:zeros.
  { cbn [says]. clear two. induction p as [|k p IH]; [reflexivity|]. cbn [forallb] in zeros.
    apply andb_true_iff in zeros as [z zs].
    unfold is_zero in z. cbn [whole sign_] in z. destruct (Z.compare_spec k 0) as [->| |]; try discriminate.
    cbn [at_ fold_right]. fold (at_ p (root_value q)). rewrite (IH zs). ring. }
  pose proof (root_value_is_root q hq) as R. unfold is_zero. cbn [whole sign_].
  destruct hq as [[c0 b0]|[c0 d0]].
  - rewrite c0. cbn [Z.compare]. destruct (value_at_quotient_is (constant q) (linear q) p b0) as [k E].
    apply IZR_lt in b0. unfold root_value. rewrite c0. cbn [Z.eqb].
    apply (says_times _ (IZR (linear q) ^ k)); [apply pow_pos_of; exact b0|]. rewrite <- E. apply says_compare.
  - assert (IZR (square q) <> 0) as ne by (apply IZR_lt in c0; lra).
    destruct (Z.compare_spec (square q) 0) as [e|e|_]; try lia.
    destruct (remainder_is (constant q) (linear q) (square q) p (root_value q) two R) as [k E].
    pose proof (terms_are (constant q) (linear q) (square q) p) as T.
    destruct (remainder whole (constant q) (linear q) (square q) p) as [l0 l1].
    destruct (terms whole (constant q) (linear q) (square q) p) as [[l1' first] last]. destruct T as (-> & -> & ->).
    apply IZR_lt in c0. apply (says_times _ (IZR (square q) ^ k)); [apply pow_pos_of; exact c0|]. rewrite E.
    apply (says_times _ (2 * IZR (square q))); [lra|].
    pose proof (sqrt_sqrt _ d0) as S. pose proof (sqrt_pos (discriminant q)) as S0.
    set (e := match at_side q with Lower => -1 | Upper => 1 end).
    replace ((IZR l0 + IZR l1 * root_value q) * (2 * IZR (square q))) with
      (IZR (2 * square q * l0 - linear q * l1) + e * IZR l1 * sqrt (discriminant q)).
    2:{ unfold root_value. destruct (Z.eqb_spec (square q) 0) as [z|_]; [rewrite z in c0; lra|]. fold e.
      rewrite minus_IZR, !mult_IZR. field. exact ne. }
    set (w := sqrt (discriminant q)) in *.
    assert (Y : says (e * IZR l1 * w) (if Req_EM_T w 0 then Eq else of_root (at_side q) (l1 ?= 0)%Z)).
    { destruct (Req_EM_T w 0) as [->|n]; [cbn; ring|]. rewrite Rmult_comm, <- Rmult_assoc. rewrite (Rmult_comm (w * e)).
      replace (IZR l1 * (w * e)) with (IZR l1 * e * w) by ring. apply says_scaled; [lra|]. unfold e.
      destruct (at_side q); cbn [of_root]; [replace (IZR l1 * -1) with (- IZR l1) by ring;
        apply says_opposite|rewrite Rmult_1_r]; apply says_compare. }
    pose proof (says_compare (2 * square q * l0 - linear q * l1)) as X.
    assert (L : says (IZR (2 * square q * l0 - linear q * l1) ^ 2 - (e * IZR l1 * w) ^ 2)
      (Z.compare (square q * l0 * l0 - linear q * l0 * l1 + constant q * l1 * l1) 0)).
    { replace (_ - _) with (IZR (square q * l0 * l0 - linear q * l0 * l1 + constant q * l1 * l1) * (4 * IZR (square
      q)));
        [apply says_scaled; [lra|apply says_compare]|].
      replace ((e * IZR l1 * w) ^ 2) with ((e * e) * IZR l1 ^ 2 * (w * w)) by ring.
      replace (e * e) with 1 by (unfold e; destruct (at_side q); ring). rewrite S. unfold discriminant.
      rewrite plus_IZR, !minus_IZR, !mult_IZR. ring. }
    pose proof (sign_of_sum _ _ _ _ _ X Y L) as D. destruct (Req_EM_T w 0) as [w0|_]; [|exact D].
    cbn [equal_signs orb] in D. set (of_ := of_root (at_side q) (l1 ?= 0)%Z).
    destruct (equal_signs of_ Eq || equal_signs of_ _); [exact D|].
    rewrite w0 in *. clear -X L D. set (f := IZR (2 * square q * l0 - linear q * l1)) in *. set (sl := Z.compare _ 0).
    replace (f ^ 2 - (e * IZR l1 * 0) ^ 2) with (f ^ 2) in L by ring.
    replace (f + e * IZR l1 * 0) with f in * by ring. clearbody f. change (says (f ^ 2) sl) in L. revert X L D.
      generalize sl. clear.
    intros sl X L D. destruct sl; unfold says in L; [|nra|exact D]. unfold says. nra.
Qed.

(* moment.rs: `Root::positive`, its comparison with another root, and a sign between roots. *)
Open Scope Z_scope.
Section Moment.
Context {T : Type} (r : ring T).
Definition negated_ x := minus_ r (zero r) x.
Definition doubled_ x := plus_ r x x.
Definition tripled_ x := plus_ r (doubled_ x) x.
Fixpoint first_of_signs (polynomial : list T) := match polynomial with
  | [] => Eq | k :: rest => match sign_ r k with Eq => first_of_signs rest | sign => sign end end.
Definition sign_after_start polynomial := first_of_signs polynomial.
Definition sign_before_end polynomial := first_of_signs (rev polynomial).
Definition discriminant_sign a b c := sign_ r (minus_ r (times_ r b b) (doubled_ (doubled_ (times_ r a c)))).
Definition nth_ n polynomial := nth n polynomial (zero r).
Definition positive polynomial :=
  let quadratic := [nth_ 0 polynomial; nth_ 1 polynomial; nth_ 2 polynomial] in
  let quadratic := match sign_before_end quadratic with Lt => map negated_ quadratic | _ => quadratic end in
  let a := nth_ 0 quadratic in let b := nth_ 1 quadratic in let c := nth_ 2 quadratic in
  match sign_ r a, sign_ r b, sign_ r c with
  | Lt, _, _ | Eq, Lt, _ => [Root a b c Upper]
  | Gt, Lt, Gt => match discriminant_sign a b c with Lt => [] | _ => [Root a b c Lower; Root a b c Upper] end
  | _, _, _ => [] end.
Definition compare (q other : root) :=
  let place := sign_at_root r q [constant other; linear other; square other] in
  if is_zero r (square other) then place else
  match place with
  | Lt => match at_side other with Lower => Gt | Upper => Lt end
  | _ => let slope := sign_at_root r q [linear other; doubled_ (square other)] in
      match place, at_side other, slope with
      | Eq, Lower, Lt | Eq, Lower, Eq | Eq, Upper, Gt | Eq, Upper, Eq => Eq
      | _, _, _ => slope end end.
(* `Crossing`: the sign at the end, turned at each root that is still to come. *)
Fixpoint turned (compare : root -> comparison) (roots : list (@root T)) sign := match roots with
  | [] => sign
  | q :: rest => match compare q with Lt => turned compare rest (CompOpp sign) | Eq => Eq | Gt => turned compare rest
    sign end end.
Record crossing := Crossing { cubic : list T; after : option (@root T); before : option (@root T);
  sign_before : comparison }.
Definition compare_crossing x (q : @root T) :=
  if match after x with Some from => match compare q from with Gt => false | _ => true end | None => false end then Gt
    else
  if match before x with Some until => match compare q until with Lt => false | _ => true end | None => false end then
    Lt else
  match sign_at_root r q (cubic x) with
  | Eq => Eq
  | sign => if equal_signs sign (sign_before x) then Gt else Lt end.
Definition sign_at_crossing x polynomial := turned (compare_crossing x) (positive polynomial) (sign_before_end
  polynomial).
End Moment.
Open Scope R_scope.

(* A quadratic is its last coefficient times the distances from its roots. *)
Notation of_quadratic q := [constant q; linear q; square q].
Lemma at_quadratic (a b c : Z) s : at_ [a; b; c] s = IZR a + IZR b * s + IZR c * s ^ 2.
Proof. unfold at_. cbn [fold_right]. ring. Qed.
Lemma at_linear (a b : Z) s : at_ [a; b] s = IZR a + IZR b * s.
Proof. unfold at_. cbn [fold_right]. ring. Qed.
Notation lower a b c := (Root (a : Z) b c Lower).
Notation upper a b c := (Root (a : Z) b c Upper).
Lemma factors a b c s : (0 < c)%Z -> 0 <= discriminant (upper a b c) ->
  at_ [a; b; c] s = IZR c * ((s - root_value (lower a b c)) * (s - root_value (upper a b c))) /\
  root_value (lower a b c) <= root_value (upper a b c) /\
  root_value (lower a b c) + root_value (upper a b c) = - IZR b / IZR c /\
  root_value (lower a b c) * root_value (upper a b c) = IZR a / IZR c.
Proof.
  intros c0 d0. rewrite at_quadratic. unfold root_value. cbn [constant linear square at_side].
  destruct (Z.eqb_spec c 0); [lia|]. apply IZR_lt in c0. change (discriminant (lower a b c)) with (discriminant (upper
    a b c)).
  pose proof (sqrt_sqrt _ d0) as S. pose proof (sqrt_pos (discriminant (upper a b c))) as P.
  set (w := sqrt _) in *. unfold discriminant in S. cbn [constant linear square] in S.
  assert (prod : (- IZR b + -1 * w) / (2 * IZR c) * ((- IZR b + 1 * w) / (2 * IZR c)) = IZR a / IZR c).
  { apply (Rmult_eq_reg_r (4 * IZR c * IZR c)); [|nra].
    replace (_ * (4 * IZR c * IZR c)) with (IZR b ^ 2 - w * w) by (field; lra). rewrite S. field. lra. }
  assert (total : (- IZR b + -1 * w) / (2 * IZR c) + (- IZR b + 1 * w) / (2 * IZR c) = - IZR b / IZR c) by (field; lra).
  split; [|split; [|split; assumption]].
  - replace ((s - _) * (s - _)) with (s ^ 2 - ((- IZR b + -1 * w) / (2 * IZR c) + (- IZR b + 1 * w) / (2 * IZR c)) * s +
      (- IZR b + -1 * w) / (2 * IZR c) * ((- IZR b + 1 * w) / (2 * IZR c))) by ring.
    rewrite prod, total. field. lra.
  - apply (Rmult_le_reg_r (2 * IZR c)); [lra|].
    replace ((- IZR b + -1 * w) / (2 * IZR c) * (2 * IZR c)) with (- IZR b - w) by (field; lra).
    replace ((- IZR b + 1 * w) / (2 * IZR c) * (2 * IZR c)) with (- IZR b + w) by (field; lra). lra.
Qed.
Definition compares x y order := says (x - y) order.
Lemma says_product x y sx sy : says x sx -> says y sy ->
  says (x * y) (match sx with Lt => CompOpp sy | Eq => Eq | Gt => sy end).
Proof. unfold says. destruct sx, sy; cbn; intros; subst; nra. Qed.
(* The positive roots of [a; b; c] with a positive last coefficient, or of zero. *)
Definition roots_of a b c := match Z.compare a 0, Z.compare b 0, Z.compare c 0 with
  | Lt, _, _ | Eq, Lt, _ => [upper a b c]
  | Gt, Lt, Gt => match discriminant_sign whole a b c with Lt => [] | _ => [lower a b c; upper a b c] end
  | _, _, _ => [] end.
Lemma discriminant_sign_is a b c : says (discriminant (upper a b c)) (discriminant_sign whole a b c).
Proof.
  unfold discriminant_sign, doubled_. cbn [whole sign_ minus_ times_ plus_]. unfold discriminant.
    cbn [constant linear square].
  replace (_ - _) with (IZR (b * b - (a * c + a * c + (a * c + a * c)))) by (rewrite minus_IZR, !plus_IZR, !mult_IZR;
    ring).
  apply says_compare.
Qed.
Definition is_positive_root q := is_root q /\ 0 < root_value q.
Lemma roots_are a b c s cmp : (sign_before_end whole [a; b; c] <> Lt) -> 0 < s ->
  Forall (fun q => is_positive_root q /\ of_quadratic q = [a; b; c]) (roots_of a b c) /\
  ((forall q, In q (roots_of a b c) -> compares s (root_value q) (cmp q)) ->
    says (at_ [a; b; c] s) (turned cmp (roots_of a b c) (sign_before_end whole [a; b; c]))).
Proof.
  intros top s0. unfold roots_of, sign_before_end in *. cbn [rev app first_of_signs whole sign_] in *.
  pose proof (discriminant_sign_is a b c) as D. pose proof (factors a b c s) as F.
  pose proof (says_compare a) as A. pose proof (says_compare b) as B. pose proof (says_compare c) as C.
  destruct (Z.compare_spec c 0) as [c0|c0|c0]; cbn [says] in C; [|contradiction|].
  - (* Linear, or constant. *)
    subst c. destruct (Z.compare_spec b 0) as [b0|b0|b0]; cbn [says] in B; [|contradiction|].
    + subst b. destruct (Z.compare_spec a 0) as [a0|a0|a0]; cbn [says] in A; [|contradiction|].
      * subst a. split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic. ring.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic. lra.
    + assert (E : at_ [a; b; 0%Z] s = IZR b * (s - root_value (upper a b 0%Z))).
      { rewrite at_quadratic. unfold root_value. cbn [constant linear square Z.eqb]. field. lra. }
      destruct (Z.compare_spec a 0) as [a0|a0|a0]; cbn [says] in A.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic, A. nra.
      * split.
        { constructor; [|constructor]. split; [|reflexivity]. split; [left; cbn; auto|]. unfold root_value.
          cbn [constant linear square Z.eqb].
          apply Rdiv_lt_0_compat; lra. }
        intro h. specialize (h _ (or_introl eq_refl)). rewrite E. unfold compares in h. cbn [turned].
        pose proof (says_product _ _ Gt _ B h) as P. destruct (cmp (upper a b 0%Z)); exact P.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic. nra.
  - assert (S2 : 0 < IZR c * s ^ 2) by (apply Rmult_lt_0_compat; [exact C|apply pow_lt; exact s0]).
    assert (one_upper : (a < 0 \/ a = 0 /\ b < 0)%Z -> Forall (fun q => is_positive_root q /\ of_quadratic q = [a; b;
      c]) [upper a b c] /\
      ((forall q, In q [upper a b c] -> compares s (root_value q) (cmp q)) -> says (at_ [a; b;
        c] s) (turned cmp [upper a b c] Gt))).
    { intro ab. assert (d0 : 0 <= discriminant (upper a b c)).
      { unfold discriminant. cbn [constant linear square]. destruct ab as [a0|[-> _]]; [apply IZR_lt in a0|]; nra. }
      destruct (F c0 d0) as (E & order & total & product).
      set (lo := root_value (lower a b c)) in *. set (up := root_value (upper a b c)) in *.
      assert (signs_ : lo <= 0 /\ 0 < up).
      { assert (T : (lo + up) * IZR c = - IZR b) by (rewrite total; field; lra).
        assert (P : lo * up * IZR c = IZR a) by (rewrite product; field; lra).
        destruct ab as [a0|[-> b0]]; [apply IZR_lt in a0|apply IZR_lt in b0].
        - assert (lo * up < 0) by nra. nra.
        - assert (lo * up = 0) by nra. assert (0 < lo + up) by nra. nra. }
      split.
      { constructor; [|constructor]. split; [|reflexivity]. split; [right; cbn; auto|]. apply signs_. }
      intro h. specialize (h _ (or_introl eq_refl)). unfold compares in h. fold up in h. rewrite E.
      replace (IZR c * ((s - lo) * (s - up))) with ((IZR c * (s - lo)) * (s - up)) by ring. cbn [turned].
      pose proof (says_product (IZR c * (s - lo)) _ Gt _ ltac:(cbn; nra) h) as P. destruct (cmp (upper a b c));
        exact P. }
    destruct (Z.compare_spec a 0) as [a0|a0|a0]; cbn [says] in A.
    + destruct (Z.compare_spec b 0) as [b0|b0|b0]; cbn [says] in B; [| |].
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic, A, B. lra.
      * apply one_upper. right. auto.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic, A. nra.
    + apply one_upper. now left.
    + destruct (Z.compare_spec b 0) as [b0|b0|b0]; cbn [says] in B.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic, B. nra.
      * assert (two : 0 <= discriminant (upper a b c) -> Forall (fun q => is_positive_root q /\ of_quadratic q = [a;
        b; c]) [lower a b c; upper a b c] /\
          ((forall q, In q [lower a b c; upper a b c] -> compares s (root_value q) (cmp q)) ->
            says (at_ [a; b; c] s) (turned cmp [lower a b c; upper a b c] Gt))).
        { intro d0. destruct (F c0 d0) as (E & order & total & product).
          set (lo := root_value (lower a b c)) in *. set (up := root_value (upper a b c)) in *.
          assert (signs_ : 0 < lo /\ 0 < up).
          { assert (T : (lo + up) * IZR c = - IZR b) by (rewrite total; field; lra).
            assert (P : lo * up * IZR c = IZR a) by (rewrite product; field; lra).
            assert (0 < lo * up) by nra. assert (0 < lo + up) by nra. nra. }
          split.
          { constructor; [|constructor; [|constructor]]; (split; [|reflexivity]); (split; [right; split;
            [exact c0|exact d0]|apply signs_]). }
          intro h. pose proof (h _ (or_introl eq_refl)) as hl. pose proof (h _ (or_intror (or_introl eq_refl))) as hu.
          unfold compares in hl, hu. fold lo in hl. fold up in hu. rewrite E. rewrite Rmult_comm. apply says_scaled;
            [exact C|].
          pose proof (says_product _ _ _ _ hl hu) as P. cbn [turned].
          destruct (cmp (lower a b c)), (cmp (upper a b c)); exact P. }
        destruct (discriminant_sign whole a b c); cbn [says] in D; [apply two; lra| |apply two; lra].
        split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic. unfold discriminant in D.
        cbn [constant linear square] in D. apply (Rmult_lt_reg_l (4 * IZR c)); [lra|]. rewrite Rmult_0_r.
        replace (4 * IZR c * _) with ((2 * IZR c * s + IZR b) ^ 2 - (IZR b ^ 2 - 4 * IZR a * IZR c)) by ring.
        pose proof (pow2_ge_0 (2 * IZR c * s + IZR b)). lra.
      * split; [constructor|]. intros _. cbn [turned says]. rewrite at_quadratic. nra.
Qed.
Lemma turned_opposite {T} cmp (roots : list (@root T)) sign : turned cmp roots (CompOpp sign) = CompOpp (turned cmp
  roots sign).
Proof. revert sign. induction roots as [|q rest IH]; intro sign; [reflexivity|]. cbn [turned]. destruct (cmp q); auto.
  Qed.
Definition padded (p : list Z) := [nth 0 p 0%Z; nth 1 p 0%Z; nth 2 p 0%Z].
Lemma padded_is p s : (length p <= 3)%nat -> at_ p s = at_ (padded p) s /\
  sign_before_end whole p = sign_before_end whole (padded p).
Proof.
  intro l. destruct p as [|a [|b [|c [|d p]]]]; cbn in l; try lia; unfold padded, sign_before_end;
    cbn [nth rev app first_of_signs whole sign_ Z.compare];
    (split; [unfold at_; cbn [fold_right]; ring|reflexivity]).
Qed.
Lemma positive_is p : positive whole p = let '(a, b, c) := (nth 0 p 0, nth 1 p 0, nth 2 p 0)%Z in
  match sign_before_end whole [a; b; c] with Lt => roots_of (0 - a) (0 - b) (0 - c) | _ => roots_of a b c end.
Proof. unfold positive, nth_. cbn [whole zero]. destruct (sign_before_end whole _); reflexivity. Qed.
Lemma at_negated a b c s : at_ [0 - a; 0 - b; 0 - c]%Z s = - at_ [a; b; c] s.
Proof. rewrite !at_quadratic, !minus_IZR. ring. Qed.
Lemma end_negated a b c : sign_before_end whole [0 - a; 0 - b; 0 - c]%Z = CompOpp (sign_before_end whole [a; b; c]).
Proof.
  unfold sign_before_end. cbn [rev app first_of_signs whole sign_].
  assert (E : forall k, Z.compare (0 - k) 0 = CompOpp (Z.compare k 0)) by (intros [|k|k]; reflexivity). rewrite !E.
  destruct (c ?= 0)%Z, (b ?= 0)%Z, (a ?= 0)%Z; reflexivity.
Qed.
(* **The positive roots** are roots, and there are no others: the polynomial has one sign between them. *)
Theorem positive_roots_are p s cmp : (length p <= 3)%nat -> 0 < s ->
  Forall (fun q => is_positive_root q /\ at_ p (root_value q) = 0) (positive whole p) /\
  ((forall q, In q (positive whole p) -> compares s (root_value q) (cmp q)) ->
    says (at_ p s) (turned cmp (positive whole p) (sign_before_end whole p))).
Proof.
  intros l s0. assert (P : forall v, at_ p v = at_ (padded p) v) by (intro v; apply padded_is, l).
  rewrite positive_is, (proj2 (padded_is p s l)), P. unfold padded. cbn zeta.
  set (a := nth 0 p 0%Z) in *. set (b := nth 1 p 0%Z) in *. set (c := nth 2 p 0%Z) in *.
  assert (R : forall q, is_positive_root q -> at_ (of_quadratic q) (root_value q) = 0).
  { intros q [h _]. rewrite at_quadratic. now apply root_value_is_root. }
  assert (G : forall a' b' c', sign_before_end whole [a'; b'; c'] <> Lt ->
    Forall (fun q => is_positive_root q /\ at_ [a'; b'; c'] (root_value q) = 0) (roots_of a' b' c') /\
    ((forall q, In q (roots_of a' b' c') -> compares s (root_value q) (cmp q)) ->
      says (at_ [a'; b'; c'] s) (turned cmp (roots_of a' b' c') (sign_before_end whole [a'; b'; c'])))).
  { intros a' b' c' top. destruct (roots_are a' b' c' s cmp top s0) as [F S]. split; [|exact S].
    eapply Forall_impl; [|exact F]. intros q [h E]. split; [exact h|]. rewrite <- E. now apply R. }
  destruct (sign_before_end whole [a; b; c]) eqn:E.
  1, 3: rewrite <- E; destruct (G a b c ltac:(congruence)) as [F S]; (split; [|exact S]); eapply Forall_impl;
    [|exact F];
    intros q [h z]; split; [exact h|now rewrite P].
  destruct (G (0 - a) (0 - b) (0 - c))%Z as [F S]; [rewrite end_negated, E; discriminate|]. split.
  - eapply Forall_impl; [|exact F]. intros q [h z]. split; [exact h|]. rewrite P. change (at_ [a; b;
    c] (root_value q) = 0). rewrite at_negated in z. lra.
  - intro h. specialize (S h). rewrite at_negated, end_negated, turned_opposite, E in S. apply says_opposite in S.
    rewrite Ropp_involutive in S. destruct (turned cmp _ Lt); exact S.
Qed.
Definition order x y := if Rlt_dec x y then Lt else if Req_EM_T x y then Eq else Gt.
Lemma order_is x y : compares x y (order x y).
Proof. unfold compares, order. destruct (Rlt_dec x y); [cbn; lra|]. destruct (Req_EM_T x y); cbn; lra. Qed.
Lemma turned_at_a_root {T} cmp (roots : list (@root T)) sign : turned cmp roots sign = Eq ->
  sign = Eq \/ exists q, In q roots /\ cmp q = Eq.
Proof.
  revert sign. induction roots as [|q rest IH]; intros sign E; [now left|]. cbn [turned] in E. destruct (cmp q) eqn:C.
  - right. exists q. split; [now left|exact C].
  - destruct (IH _ E) as [z|(o & i & z)]; [left; destruct sign; (discriminate || reflexivity)|right; exists o; split;
    [now right|exact z]].
  - destruct (IH _ E) as [z|(o & i & z)]; [now left|right; exists o; split; [now right|exact z]].
Qed.
Lemma first_of_signs_zero p : first_of_signs whole p = Eq -> Forall (fun k => k = 0%Z) p.
Proof.
  induction p as [|k p IH]; [constructor|]. cbn [first_of_signs whole sign_].
    destruct (Z.compare_spec k 0) as [->|h|h]; try discriminate.
  intro E. constructor; [reflexivity|now apply IH].
Qed.
Theorem no_other_positive_roots p s : (length p <= 3)%nat -> 0 < s -> at_ p s = 0 -> Forall (fun k => k = 0%Z) p \/
  exists q, In q (positive whole p) /\ root_value q = s.
Proof.
  intros l s0 z. destruct (positive_roots_are p s (fun q => order s (root_value q)) l s0) as [_ S].
  specialize (S (fun q _ => order_is s (root_value q))). rewrite z in S. set (found := turned _ _ _) in S.
  assert (E : found = Eq) by (unfold says in S; destruct found; [reflexivity|lra|lra]).
    apply turned_at_a_root in E as [E|(q & i & E)].
  - left. apply first_of_signs_zero in E. apply Forall_rev in E. now rewrite rev_involutive in E.
  - right. exists q. split; [exact i|]. pose proof (order_is s (root_value q)) as C. rewrite E in C.
    unfold compares, says in C. lra.
Qed.
(* **Two roots compare** as the numbers that they are. *)
Theorem compare_is q other : is_root q -> is_root other -> compares (root_value q) (root_value other) (compare whole q
  other).
Proof.
  intros hq ho. pose proof (sign_at_root_is q (of_quadratic other) hq ltac:(cbn; lia)) as P. unfold compare, compares.
    cbv zeta.
  set (place := sign_at_root whole q (of_quadratic other)) in *. set (x := root_value q) in *.
  unfold is_zero. cbn [whole sign_]. destruct ho as [[c0 b0]|[c0 d0]].
  - rewrite c0. cbn [Z.compare]. rewrite at_quadratic, c0 in P. apply IZR_lt in b0. unfold root_value. rewrite c0.
    cbn [Z.eqb].
    apply (says_times _ (IZR (linear other))); [lra|]. replace (_ * _) with (IZR (constant other) + IZR (linear other)
      * x + 0 * x ^ 2) by (field; lra).
    exact P.
  - destruct (Z.compare_spec (square other) 0) as [e|e|_]; try lia.
    pose proof (sign_at_root_is q [linear other; doubled_ whole (square other)] hq ltac:(cbn; lia)) as L.
    set (slope := sign_at_root whole q [_; _]) in *. fold x in L. rewrite at_linear in L. unfold doubled_ in L.
      cbn [whole plus_] in L.
    rewrite plus_IZR in L. destruct other as [a b c side_]. cbn [constant linear square at_side] in *.
    destruct (factors a b c x c0 d0) as (E & order_ & total & _). rewrite E in P. clear E.
    change (discriminant (upper a b c)) with (discriminant (Root a b c side_)) in *.
    set (lo := root_value (lower a b c)) in *. set (up := root_value (upper a b c)) in *. apply IZR_lt in c0.
    assert (slope_is : says ((x - lo) + (x - up)) slope).
    { apply (says_times _ (IZR c)); [exact c0|]. replace (_ * IZR c) with (IZR b + (IZR c + IZR c) * x); [exact L|].
      replace (x - lo + (x - up)) with (2 * x - (lo + up)) by ring. rewrite total. field. lra. }
    assert (place_is : says ((x - lo) * (x - up)) place).
    { apply (says_times _ (IZR c)); [exact c0|]. rewrite Rmult_comm. exact P. }
    assert (v : root_value (Root a b c side_) = match side_ with Lower => lo | Upper => up end) by (destruct side_;
      reflexivity).
    rewrite v. clear -order_ slope_is place_is. clearbody place slope x lo up. unfold says in *.
    destruct place, side_, slope; nra.
Qed.

(* **A crossing**: the only root of a cubic between two roots of others, or the ends, where it changes its sign. *)
Definition beyond (from : option (@root Z)) s := match from with Some q => root_value q < s | None => 0 < s end.
Definition ahead (until : option (@root Z)) s := match until with Some q => s < root_value q | None => True end.
Definition known (q : option (@root Z)) := match q with Some q => is_root q | None => True end.
Record is_crossing (x : @crossing Z) k : Prop := { crossing_positive : 0 < k;
  crossing_cubic : (2 <= length (cubic x))%nat;
  crossing_roots : known (after x) /\ known (before x); crossing_inside : beyond (after x) k /\ ahead (before x) k;
  crossing_root : at_ (cubic x) k = 0; crossing_sign : sign_before x <> Eq;
  crossing_earlier : forall s, 0 < s -> beyond (after x) s -> s < k -> says (at_ (cubic x) s) (sign_before x);
  crossing_later : forall s, k < s -> ahead (before x) s -> says (at_ (cubic x) s) (CompOpp (sign_before x)) }.
Theorem compare_crossing_is x k q : is_crossing x k -> is_positive_root q ->
  compares k (root_value q) (compare_crossing whole x q).
Proof.
  intros [k0 two [ka kb] [ia ib] root sign0 earlier later] [hq q0]. unfold compare_crossing, compares.
  destruct (match after x with Some from => _ | None => _ end) eqn:A.
  { destruct (after x) as [from|]; [|discriminate]. pose proof (compare_is q from hq ka) as C. unfold beyond in ia.
    unfold compares, says in *. destruct (compare whole q from); try discriminate; lra. }
  assert (qa : beyond (after x) (root_value q)).
  { destruct (after x) as [from|]; [|exact q0]. pose proof (compare_is q from hq ka) as C.
    unfold compares, says, beyond in *.
    destruct (compare whole q from); try discriminate; lra. }
  destruct (match before x with Some until => _ | None => _ end) eqn:B.
  { destruct (before x) as [until|]; [|discriminate]. pose proof (compare_is q until hq kb) as C. unfold ahead in ib.
    unfold compares, says in *. destruct (compare whole q until); try discriminate; lra. }
  assert (qb : ahead (before x) (root_value q)).
  { destruct (before x) as [until|]; [|exact I]. pose proof (compare_is q until hq kb) as C.
    unfold compares, says, ahead in *.
    destruct (compare whole q until); try discriminate; lra. }
  pose proof (sign_at_root_is q (cubic x) hq two) as S. set (sign := sign_at_root whole q (cubic x)) in *.
  destruct (Rtotal_order (root_value q) k) as [less|[same|more]].
  - pose proof (says_one _ _ _ S (earlier _ q0 qa less)) as E. rewrite E. destruct (sign_before x); cbn;
    [contradiction|lra|lra].
  - rewrite same, root in S. assert (sign = Eq) as -> by (unfold says in S; destruct sign; [reflexivity|lra|lra]).
    cbn. lra.
  - pose proof (says_one _ _ _ S (later _ more qb)) as E. rewrite E. destruct (sign_before x); cbn;
    [contradiction|lra|lra].
Qed.
Theorem sign_at_crossing_is x k p : is_crossing x k -> (length p <= 3)%nat ->
  says (at_ p k) (sign_at_crossing whole x p).
Proof.
  intros hx l. unfold sign_at_crossing. destruct (positive_roots_are p k (compare_crossing whole x) l
    (crossing_positive x k hx)) as [F S].
  apply S. intros q i. apply compare_crossing_is; [exact hx|]. rewrite Forall_forall in F. apply (F q i).
Qed.

(* Continuity, slopes, and signs just after the start and just before the end. *)
Lemma at_continuous p : continuity (at_ p).
Proof.
  induction p as [|k p IH]; [apply (continuity_const (fun _ => 0)); now intros ? ?|]. cbn [at_ fold_right].
    fold (at_ p).
  change (continuity (plus_fct (fct_cte (IZR k)) (mult_fct (at_ p) id))). apply continuity_plus;
    [apply continuity_const; now intros ? ?|].
  apply continuity_mult; [exact IH|]. apply derivable_continuous, derivable_id.
Qed.
Lemma bounded p : exists b, 0 < b /\ forall s, 0 <= s <= 1 -> Rabs (at_ p s) <= b.
Proof.
  induction p as [|k p (b & b0 & h)]; [exists 1; split; [lra|]; intros; cbn; rewrite Rabs_R0; lra|].
  exists (Rabs (IZR k) + b). pose proof (Rabs_pos (IZR k)). split; [lra|]. intros s r. cbn [at_ fold_right].
    fold (at_ p s).
  specialize (h s r). eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, (Rabs_pos_eq s) by lra.
  pose proof (Rabs_pos (at_ p s)). nra.
Qed.
Lemma just_after_start p : exists e, 0 < e /\ forall s, 0 < s < e -> says (at_ p s) (sign_after_start whole p).
Proof.
  unfold sign_after_start. induction p as [|k p (e & e0 & h)]; [exists 1; split; [lra|]; reflexivity|].
  cbn [first_of_signs whole sign_]. destruct (Z.compare_spec k 0) as [->|neg|pos].
  - exists e. split; [exact e0|]. intros s r. cbn [at_ fold_right]. fold (at_ p s). rewrite Rplus_0_l.
    apply says_scaled; [lra|]. now apply h.
  - apply IZR_lt in neg. destruct (bounded p) as (b & b0 & hb). exists (Rmin 1 (- IZR k / (2 * b))).
    assert (0 < - IZR k / (2 * b)) by (apply Rdiv_lt_0_compat; lra). split; [apply Rmin_pos; lra|]. intros s [s0 s1].
    apply Rmin_Rgt_l in s1 as [s1 s2]. cbn [at_ fold_right says]. fold (at_ p s). specialize (hb s ltac:(lra)).
      apply Flocq.Core.Raux.Rabs_le_inv in hb.
    assert (s * (2 * b) < - IZR k) by (apply (Rmult_lt_compat_r (2 * b)) in s2; [|lra];
      replace (- IZR k / (2 * b) * (2 * b)) with (- IZR k) in s2 by (field; lra); lra).
    nra.
  - apply IZR_lt in pos. destruct (bounded p) as (b & b0 & hb). exists (Rmin 1 (IZR k / (2 * b))).
    assert (0 < IZR k / (2 * b)) by (apply Rdiv_lt_0_compat; lra). split; [apply Rmin_pos; lra|]. intros s [s0 s1].
    apply Rmin_Rgt_l in s1 as [s1 s2]. cbn [at_ fold_right says]. fold (at_ p s). specialize (hb s ltac:(lra)).
      apply Flocq.Core.Raux.Rabs_le_inv in hb.
    assert (s * (2 * b) < IZR k) by (apply (Rmult_lt_compat_r (2 * b)) in s2; [|lra];
      replace (IZR k / (2 * b) * (2 * b)) with (IZR k) in s2 by (field; lra); lra).
    nra.
Qed.
Lemma at_app p k s : at_ (p ++ [k]) s = at_ p s + IZR k * s ^ length p.
Proof. induction p as [|h p IH]; cbn [app at_ fold_right length pow]; [ring|]. fold (at_ (p ++ [k]) s) (at_ p s).
  rewrite IH. ring. Qed.
Lemma at_reversed p s : 0 < s -> at_ (rev p) (/ s) * s ^ length p = at_ p s * s.
Proof.
  intro s0. induction p as [|k p IH]; [cbn; ring|]. change (rev (k :: p)) with (rev p ++ [k]).
  rewrite at_app, rev_length. cbn [length pow]. replace (at_ (k :: p) s) with (IZR k + at_ p s * s) by reflexivity.
  rewrite Rmult_plus_distr_r. replace (at_ (rev p) (/ s) * (s * s ^ length p)) with (at_ (rev p) (/ s) * s ^ length p *
    s) by ring.
  rewrite IH. replace (IZR k * (/ s) ^ length p * (s * s ^ length p)) with (IZR k * s * ((/ s) ^ length p * s ^ length
    p)) by ring.
  rewrite <- Rpow_mult_distr, Rinv_l, pow1 by lra. ring.
Qed.
Lemma just_before_end p : exists e, 0 < e /\ forall s, e < s -> says (at_ p s) (sign_before_end whole p).
Proof.
  destruct (just_after_start (rev p)) as (e & e0 & h). exists (/ e). split; [now apply Rinv_0_lt_compat|].
    intros s more.
  assert (0 < / e) by now apply Rinv_0_lt_compat. assert (s0 : 0 < s) by lra.
  apply (says_times _ s); [exact s0|]. rewrite <- at_reversed by exact s0. apply says_scaled; [now apply pow_lt|].
  apply h. split; [now apply Rinv_0_lt_compat|]. rewrite <- (Rinv_inv e). apply Rinv_lt_contravar; [|exact more].
    now apply Rmult_lt_0_compat.
Qed.
(* A part of the step from u to v, or without an end, in which a continuous function is monotone.
  Just after u it has the
   sign `first`, just before v `last`. *)
Section Part.
Variable f : R -> R.
Hypothesis continuous : continuity f.
Variable u : R.
Variable v : option R.
Definition inside s := u < s /\ match v with Some v => s < v | None => True end.
Definition not_after s := match v with Some v => s <= v | None => True end.
Hypothesis some_part : exists s, inside s.
Variables first last : comparison.
Hypothesis at_first : forall d, 0 < d -> exists s, u <= s < u + d /\ says (f s) first.
Hypothesis at_last : forall s, inside s -> exists t, s < t /\ not_after t /\ says (f t) last.
Lemma increasing_part : (forall a b, u <= a -> a < b -> not_after b -> f a < f b) ->
  if equal_signs last (CompOpp first) && negb (equal_signs first Eq) then
    exists k, inside k /\ f k = 0 /\ (forall s, u <= s -> s < k -> says (f s) first) /\ (forall s, k < s ->
      not_after s -> says (f s) last)
  else forall s, inside s -> f s <> 0.
Proof.
  intro up. destruct some_part as (m & um & mv).
  destruct (at_first (m - u) ltac:(lra)) as (a & (ua & am) & sa).
    destruct (at_last m (conj um mv)) as (b & mb & bv & sb).
  pose proof (up a b ua ltac:(lra) bv) as ab.
  assert (none : (first <> Lt \/ last <> Gt) -> forall s, inside s -> f s <> 0).
  { intros which s [us sv] z. destruct (at_first (s - u) ltac:(lra)) as (a' & (ua' & as') & sa').
    destruct (at_last s (conj us sv)) as (b' & sb' & bv' & sl').
    assert (not_after s) by (unfold not_after; destruct v; [lra|exact I]).
    pose proof (up a' s ua' ltac:(lra) ltac:(assumption)). pose proof (up s b' ltac:(lra) sb' bv').
    unfold says in sa', sl'. destruct which as [w|w]; [destruct first|destruct last]; try (now apply w); lra. }
  destruct first, last; cbn [equal_signs CompOpp andb negb]; try (apply none; (left; discriminate) || (right;
    discriminate)); [|].
  all: cbn [says] in sa, sb; try lra.
  destruct (IVT_cor f a b continuous ltac:(lra) ltac:(nra)) as (k & [ak kb] & z).
  assert (ak' : a < k) by (destruct (Req_dec a k) as [e|n]; [rewrite e in sa; lra|lra]).
  assert (kb' : k < b) by (destruct (Req_dec k b) as [e|n]; [rewrite <- e in sb; lra|lra]).
  assert (kv : not_after k) by (unfold not_after in *; destruct v; [lra|exact I]).
  exists k. split; [split; [lra|unfold not_after in bv; destruct v; [lra|exact I]]|]. split; [exact z|]. split.
  - intros s us sk. cbn [says]. rewrite <- z. now apply up.
  - intros s ks sv. cbn [says]. rewrite <- z. apply up; [lra|exact ks|exact sv].
Qed.
End Part.
Definition monotone f u v := (forall a b, u <= a -> a < b -> not_after v b -> f a < f b) \/ (forall a b, u <= a ->
  a < b -> not_after v b -> f b < f a).
Lemma part_is f u v first last : continuity f -> (exists s, inside u v s) ->
  (forall d, 0 < d -> exists s, u <= s < u + d /\ says (f s) first) ->
  (forall s, inside u v s -> exists t, s < t /\ not_after v t /\ says (f t) last) -> monotone f u v ->
  if equal_signs last (CompOpp first) && negb (equal_signs first Eq) then
    exists k, inside u v k /\ f k = 0 /\ (forall s, u <= s -> s < k -> says (f s) first) /\ (forall s, k < s ->
      not_after v s -> says (f s) last)
  else forall s, inside u v s -> f s <> 0.
Proof.
  intros continuous some at_first at_last [up|down]; [now apply increasing_part|].
  assert (C : continuity (fun s => - f s)) by exact (continuity_opp f continuous).
  pose proof (increasing_part (fun s => - f s) C u v some (CompOpp first) (CompOpp last)) as P.
  assert (back : forall x sign, says (- x) (CompOpp sign) -> says x sign).
  { intros x sign h. apply says_opposite in h. rewrite Ropp_involutive in h. destruct sign; exact h. }
  replace (equal_signs (CompOpp last) (CompOpp (CompOpp first)) && negb (equal_signs (CompOpp first) Eq)) with
    (equal_signs last (CompOpp first) && negb (equal_signs first Eq)) in P by (destruct first, last; reflexivity).
  assert (Q : forall d, 0 < d -> exists s, u <= s < u + d /\ says (- f s) (CompOpp first)).
  { intros d d0. destruct (at_first d d0) as (s & r & h). exists s. split; [exact r|now apply says_opposite]. }
  assert (L : forall s, inside u v s -> exists t, s < t /\ not_after v t /\ says (- f t) (CompOpp last)).
  { intros s i. destruct (at_last s i) as (t & a & b & h). exists t. split; [exact a|]. split;
    [exact b|now apply says_opposite]. }
  assert (U : forall a b, u <= a -> a < b -> not_after v b -> - f a < - f b).
  { intros a b ua ab bv. pose proof (down a b ua ab bv). lra. }
  specialize (P Q L U). destruct (_ && _).
  - destruct P as (k & i & z & before_ & after_). exists k. split; [exact i|]. split; [lra|]. split; intros;
    apply back; auto.
  - intros s i z. apply (P s i). lra.
Qed.
(* The slope of a polynomial; where it is not zero, the polynomial is monotone. *)
Fixpoint slope p s := match p with [] => 0 | _ :: p => 0 + (slope p s * s + at_ p s * 1) end.
Lemma slope_is p s : derivable_pt_lim (at_ p) s (slope p s).
Proof.
  induction p as [|k p IH]; [apply derivable_pt_lim_const|]. cbn [slope].
  change (derivable_pt_lim (plus_fct (fct_cte (IZR k)) (mult_fct (at_ p) id)) s (0 + (slope p s * id s + at_ p s * 1))).
  apply derivable_pt_lim_plus; [apply derivable_pt_lim_const|]. apply derivable_pt_lim_mult;
    [exact IH|apply derivable_pt_lim_id].
Qed.
Lemma monotone_without_turning p d u v : (forall s, slope p s = at_ d s) -> (exists s, inside u v s) ->
  (forall s, inside u v s -> at_ d s <> 0) -> monotone (at_ p) u v.
Proof.
  intros is_slope (m & im) none.
  assert (same : forall s, inside u v s -> 0 < at_ d m * at_ d s).
  { intros s i. pose proof (none m im). pose proof (none s i).
    destruct (Rlt_dec 0 (at_ d m * at_ d s)) as [|neg]; [assumption|exfalso].
    assert (P : at_ d (Rmin m s) * at_ d (Rmax m s) <= 0).
    { unfold Rmin, Rmax. destruct (Rle_dec m s); [lra|]. rewrite Rmult_comm. lra. }
    destruct (IVT_cor (at_ d) (Rmin m s) (Rmax m s) (at_continuous d) ltac:(unfold Rmin, Rmax; destruct (Rle_dec m s);
      lra) P) as (z & r & zero_).
    apply (none z); [|exact zero_]. unfold inside in *. unfold Rmin, Rmax in r. destruct (Rle_dec m s), v; lra. }
  assert (mean : forall a b, u <= a -> a < b -> not_after v b -> exists c, inside u v c /\
    at_ p b - at_ p a = at_ d c * (b - a)).
  { intros a b ua ab bv. destruct (MVT_cor2 (at_ p) (at_ d) a b ab) as (c & E & ac & cb).
    - intros c _. rewrite <- is_slope. apply slope_is.
    - exists c. split; [|exact E]. unfold inside, not_after in *. destruct v; lra. }
  destruct (Rlt_dec 0 (at_ d m)) as [pos|neg]; [left|right]; intros a b ua ab bv;
    destruct (mean a b ua ab bv) as (c & i & E); pose proof (same c i) as S; pose proof (none m im);
      assert (0 < b - a) by lra.
  - assert (0 < at_ d c) by nra. assert (0 < at_ d c * (b - a)) by (apply Rmult_lt_0_compat; assumption). lra.
  - assert (at_ d c < 0) by nra. assert (0 < - at_ d c * (b - a)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* mod.rs: the times that a step is tested at, if the volume is not zero throughout. *)
Section Times.
Context {T : Type} (r : ring T).
Inductive moment := AtRoot (q : @root T) | AtCrossing (x : @crossing T).
Definition sign_at m polynomial := match m with
  | AtRoot q => sign_at_root r q polynomial | AtCrossing x => sign_at_crossing r x polynomial end.
Definition between_ends volume := Crossing volume None None (sign_after_start r volume).
Fixpoint times_from volume rest turning_points (x : @crossing T) := match turning_points with
  | [] => if equal_signs (sign_before_end r volume) (CompOpp (sign_before x)) then [AtCrossing x] else []
  | q :: more => let sign := sign_at_root r q rest in
      match sign with
      | Eq => [AtRoot q]
      | _ => if equal_signs sign (CompOpp (sign_before x)) then [AtCrossing (Crossing (cubic x) (after x) (Some q)
        (sign_before x))] else []
      end ++ times_from volume rest more (Crossing volume (Some q) None sign) end.
Fixpoint changes_of_sign last signs := match signs with
  | [] => 0%nat
  | Eq :: rest => changes_of_sign last rest
  | sign :: rest => ((if equal_signs sign (CompOpp last) then 1 else 0) + changes_of_sign sign rest)%nat end.
Definition times_of k0 k1 k2 k3 :=
  let volume := [k0; k1; k2; k3] in
  match changes_of_sign Eq (map (sign_ r) volume) with
  | 0%nat => []
  | 1%nat => [AtCrossing (between_ends volume)]
  | _ => let derivative := [k1; doubled_ r k2; tripled_ r k3] in
      let rest := [tripled_ r k0; doubled_ r k1; k2] in
      times_from volume rest (positive r derivative) (between_ends volume) end.
End Times.
(* A moment is a time if it gives the signs of the polynomials that it is asked for there. *)
Definition is_time m k := 0 < k /\ forall p, (2 <= length p <= 3)%nat -> says (at_ p k) (sign_at whole m p).
Fixpoint ascending u (roots : list (@root Z)) := match roots with [] => True | q :: more => u <= root_value q /\
  ascending (root_value q) more end.
Lemma ascending_from u roots q : ascending u roots -> In q roots -> u <= root_value q.
Proof.
  revert u. induction roots as [|o more IH]; intros u h i; [contradiction|]. destruct h as [le h], i as [->|i];
    [exact le|].
  eapply Rle_trans; [exact le|now apply IH].
Qed.
Lemma equal_signs_is a b : equal_signs a b = true <-> a = b.
Proof. destruct a, b; cbn; split; (reflexivity || discriminate). Qed.
Section Many.
Variables k0 k1 k2 k3 : Z.
Notation volume := [k0; k1; k2; k3].
Notation derivative := [k1; doubled_ whole k2; tripled_ whole k3].
Notation rest := [tripled_ whole k0; doubled_ whole k1; k2].
Hypothesis some_sign : sign_before_end whole volume <> Eq.
Lemma slope_of_volume s : slope volume s = at_ derivative s.
Proof. unfold doubled_, tripled_, doubled_. cbn [whole plus_ slope at_ fold_right]. rewrite !plus_IZR. ring. Qed.
Lemma rest_at_turning s : at_ derivative s = 0 -> at_ rest s = at_ volume s * 3.
Proof.
  intro z. replace (at_ volume s * 3) with (s * at_ derivative s + at_ rest s); [rewrite z; ring|].
  unfold doubled_, tripled_, doubled_. cbn [whole plus_ at_ fold_right]. rewrite !plus_IZR. ring.
Qed.
Lemma a_crossing_is_a_time x k : is_crossing x k -> is_time (AtCrossing x) k.
Proof. intro h. split; [exact (crossing_positive x k h)|]. intros p [_ l]. now apply sign_at_crossing_is. Qed.
Definition start_of (x : @crossing Z) := match after x with Some q => root_value q | None => 0 end.
Theorem times_from_are turning x : cubic x = volume -> before x = None -> known (after x) -> 0 <= start_of x ->
  (forall d, 0 < d -> exists s, start_of x <= s < start_of x + d /\ says (at_ volume s) (sign_before x)) ->
  (after x <> None -> says (at_ volume (start_of x)) (sign_before x)) ->
  Forall (fun q => is_positive_root q /\ at_ derivative (root_value q) = 0) turning -> ascending (start_of x) turning ->
  (forall s, start_of x < s -> at_ derivative s = 0 -> exists q, In q turning /\ root_value q = s) ->
  (forall m, In m (times_from whole volume rest turning x) -> exists k, is_time m k /\ at_ volume k = 0) /\
  (forall k, start_of x < k -> at_ volume k = 0 -> exists m, In m (times_from whole volume rest turning x) /\
    is_time m k).
Proof.
  revert x. induction turning as [|q more IH]; intros x cubic_ before_ known_ u0 at_first at_start turning_are up only.
  - (* The last part has no end. *)
    set (u := start_of x) in *. cbn [times_from].
    pose proof (part_is (at_ volume) u None (sign_before x) (sign_before_end whole volume) (at_continuous _)) as P.
    assert (some : exists s, inside u None s) by (exists (u + 1); split; [lra|exact I]). specialize (P some at_first).
    destruct (just_before_end volume) as (e & e0 & last_is).
    assert (L : forall s, inside u None s -> exists t, s < t /\ not_after None t /\
      says (at_ volume t) (sign_before_end whole volume)).
    { intros s _. exists (Rmax s e + 1). pose proof (Rmax_l s e). pose proof (Rmax_r s e). split; [lra|]. split;
      [exact I|]. apply last_is. lra. }
    specialize (P L (monotone_without_turning volume derivative u None slope_of_volume some
      (fun s i z => match only s (proj1 i) z with ex_intro _ _ (conj i _) => i end))).
    destruct (equal_signs (sign_before_end whole volume) (CompOpp (sign_before x))) eqn:E; cbn [andb] in P.
    + apply equal_signs_is in E. assert (first0 : sign_before x <> Eq) by (intro z; rewrite z in E;
      exact (some_sign E)).
      replace (equal_signs (sign_before x) Eq) with false in P by (destruct (sign_before x);
        [contradiction|reflexivity..]).
      cbn [negb] in P. destruct P as (k & [uk _] & z & earlier & later).
      assert (C : is_crossing x k).
      { constructor; rewrite ?cubic_, ?before_; try assumption.
        - lra.
        - cbn; lia.
        - split; [exact known_|exact I].
        - split; [unfold u, start_of in uk; unfold beyond; destruct (after x); exact uk|exact I].
        - intros s s0 b sk. apply earlier; [|exact sk]. unfold u, start_of. unfold beyond in b. destruct (after x); lra.
        - intros s ks _. rewrite <- E. now apply later. }
      split; [intros m [<-|[]]; exists k; split; [now apply a_crossing_is_a_time|exact z]|].
      intros k' uk' z'. exists (AtCrossing x). split; [now left|]. destruct (Rtotal_order k' k) as [less|[->|more]].
      * specialize (earlier k' ltac:(lra) less). rewrite z' in earlier. unfold says in earlier.
        destruct (sign_before x); [contradiction|lra|lra].
      * now apply a_crossing_is_a_time.
      * specialize (later k' more I). rewrite z', E in later. unfold says in later. destruct (sign_before x);
        [contradiction|cbn in later; lra|cbn in later; lra].
    + split; [intros m []|]. intros k uk z. exfalso. exact (P k (conj uk I) z).
  - inversion turning_are as [|? ? [[hq q0] dq] turning_more]; subst. destruct up as [uq up].
    set (u := start_of x) in *. set (v := root_value q) in *.
    cbn [times_from]. set (sign := sign_at_root whole q rest).
    assert (S : says (at_ volume v) sign).
    { apply (says_times _ 3); [lra|]. rewrite <- rest_at_turning by exact dq. apply sign_at_root_is; [exact hq|cbn;
      lia]. }
    set (next := Crossing volume (Some q) None sign).
    destruct (IH next eq_refl eq_refl hq ltac:(unfold start_of; cbn; fold v; lra)) as [sound complete].
    + intros d d0. exists v. split; [cbn [start_of next after]; fold v; lra|exact S].
    + intros _. exact S.
    + exact turning_more.
    + exact up.
    + intros s vs z. change (start_of next) with v in vs. destruct (only s ltac:(lra) z) as (o & [<-|i] & E);
      [fold v in E; lra|now exists o].
    + change (start_of next) with v in complete.
      assert (here : forall m, is_time m v -> at_ volume v = 0 -> exists k, is_time m k /\
        at_ volume k = 0) by (intros; now exists v).
      assert (head : (forall m, In m (match sign with Eq => [AtRoot q] | _ => if equal_signs sign (CompOpp (sign_before
        x)) then
            [AtCrossing (Crossing (cubic x) (after x) (Some q) (sign_before x))] else [] end) ->
              exists k, is_time m k /\ at_ volume k = 0) /\
          (forall k, u < k -> k <= v -> at_ volume k = 0 -> exists m, In m (match sign with Eq => [AtRoot q] | _ => if
            equal_signs sign (CompOpp (sign_before x)) then
            [AtCrossing (Crossing (cubic x) (after x) (Some q) (sign_before x))] else [] end) /\ is_time m k)).
      { destruct (Req_dec u v) as [same|differ].
        - (* A double turning point: no part in between. *)
          assert (E : sign = sign_before x).
          { apply (says_one (at_ volume v)); [exact S|]. rewrite <- same. apply at_start. intro none.
            unfold u, start_of in same. rewrite none in same. fold v in q0. lra. }
          split; [|intros; lra]. rewrite <- E. destruct sign; cbn [equal_signs CompOpp]; [|intros m []|intros m []].
          intros m [<-|[]]. apply here; [|exact S]. split; [exact q0|]. intros p [two _]. now apply sign_at_root_is.
        - assert (less : u < v) by lra.
          pose proof (part_is (at_ volume) u (Some v) (sign_before x) sign (at_continuous _)) as P.
          assert (some : exists s, inside u (Some v) s) by (exists ((u + v) / 2); split; lra).
            specialize (P some at_first).
          assert (L : forall s, inside u (Some v) s -> exists t, s < t /\ not_after (Some v) t /\
            says (at_ volume t) sign).
          { intros s [_ sv]. exists v. split; [exact sv|]. split; [cbn; lra|exact S]. }
          specialize (P L). assert (M : monotone (at_ volume) u (Some v)).
          { apply (monotone_without_turning volume derivative); [exact slope_of_volume|exact some|]. intros s [us sv] z.
            destruct (only s us z) as (o & i & E). pose proof (ascending_from v (q :: more) o ltac:(cbn; fold v;
              split; [lra|exact up]) i). lra. }
          specialize (P M). destruct (equal_signs sign (CompOpp (sign_before x)) && negb (equal_signs (sign_before x)
            Eq)) eqn:E.
          + apply andb_true_iff in E as [E first0]. rewrite E. apply equal_signs_is in E.
            assert (first1 : sign_before x <> Eq) by (intro z; rewrite z in first0; discriminate).
            destruct P as (k & [uk kv] & z & earlier & later).
            set (y := Crossing (cubic x) (after x) (Some q) (sign_before x)).
            assert (C : is_crossing y k).
            { constructor; unfold y; cbn [cubic after before sign_before]; rewrite ?cubic_; try assumption.
              - lra.
              - cbn; lia.
              - split; [exact known_|exact hq].
              - split; [unfold u, start_of in uk; unfold beyond; destruct (after x); exact uk|exact kv].
              - intros s s0 b sk. apply earlier; [|exact sk]. unfold u, start_of. unfold beyond in b.
                destruct (after x); lra.
              - intros s ks sv. rewrite <- E. apply later; [exact ks|]. cbn. cbn in sv. fold v in sv. lra. }
            assert (nonzero : sign <> Eq) by (rewrite E; destruct (sign_before x); [contradiction|discriminate..]).
            assert (list_is : match sign with Eq => [AtRoot q] | _ => [AtCrossing y] end = [AtCrossing y]) by (destruct
              sign; [contradiction|reflexivity..]).
            rewrite list_is. split; [intros m [<-|[]]; exists k; split; [now apply a_crossing_is_a_time|exact z]|].
            intros k' uk' kv' z'. exists (AtCrossing y). split; [now left|]. destruct (Rtotal_order k' k) as [l|[->|g]].
            * specialize (earlier k' ltac:(lra) l). rewrite z' in earlier. unfold says in earlier.
              destruct (sign_before x); [contradiction|lra|lra].
            * now apply a_crossing_is_a_time.
            * specialize (later k' g kv'). rewrite z' in later. unfold says in later. destruct sign;
              [contradiction|lra|lra].
          + assert (list_is : match sign with Eq => [AtRoot q] | _ => if equal_signs sign (CompOpp (sign_before x))
            then [AtCrossing (Crossing (cubic x) (after x) (Some q) (sign_before x))] else [] end =
              match sign with Eq => [AtRoot q] | _ => [] end) by (destruct sign, (sign_before x);
                (reflexivity || discriminate)).
            rewrite list_is. assert (at_q : is_time (AtRoot q) v).
            { split; [exact q0|]. intros p [two _]. now apply sign_at_root_is. }
            split.
            * destruct sign; [|intros m []|intros m []]. intros m [<-|[]]. now apply here.
            * intros k uk kv z. destruct (Req_dec k v) as [->|ne]; [|exfalso; apply (P k); [split; lra|exact z]].
              rewrite z in S. destruct sign; [exists (AtRoot q); split; [now left|exact at_q]|cbn in S; lra|cbn in S;
                lra]. }
      destruct head as [sound_here complete_here]. split.
      * intros m i. apply in_app_or in i as [i|i]; [now apply sound_here|now apply sound].
      * intros k uk z. destruct (Rle_dec k v) as [le|g].
        -- destruct (complete_here k uk le z) as (m & i & h). exists m. split; [apply in_or_app; now left|exact h].
        -- destruct (complete k ltac:(lra) z) as (m & i & h). exists m. split; [apply in_or_app; now right|exact h].
Qed.
End Many.

(* Descartes' rule for a cubic, as far as it is used: no change of sign, no positive root; one change, one root. *)
Lemma rises c0 c1 c2 c3 x y : 0 < x < y ->
  (c0 <= 0 /\ 0 <= c1 /\ 0 <= c2 /\ 0 <= c3 /\ (c0 < 0 \/ 0 < c1 + c2 + c3)) \/
  (c0 <= 0 /\ c1 <= 0 /\ 0 <= c2 /\ 0 <= c3 /\ (c0 + c1 < 0 \/ 0 < c2 + c3)) \/
  (c0 <= 0 /\ c1 <= 0 /\ c2 <= 0 /\ 0 <= c3 /\ (c0 + c1 + c2 < 0 \/ 0 < c3)) ->
  0 <= c0 + c1 * x + c2 * x ^ 2 + c3 * x ^ 3 -> 0 < c0 + c1 * y + c2 * y ^ 2 + c3 * y ^ 3.
Proof.
  intros [x0 xy] cases at_x. set (f := c0 + c1 * x + c2 * x ^ 2 + c3 * x ^ 3) in *.
  assert (y0 : 0 < y) by lra. assert (x1 : 0 < x ^ 1) by (apply pow_lt; lra).
    assert (x2 : 0 < x ^ 2) by (apply pow_lt; lra).
  assert (x3 : 0 < x ^ 3) by (apply pow_lt; lra).
  assert (y1 : 0 < y ^ 1) by (apply pow_lt; lra). assert (y2 : 0 < y ^ 2) by (apply pow_lt; lra).
    assert (y3 : 0 < y ^ 3) by (apply pow_lt; lra).
  assert (d1 : 0 < y - x) by lra. assert (d2 : 0 < y ^ 2 - x ^ 2) by (replace (y ^ 2 - x ^ 2) with ((y - x) * (y + x))
    by ring; apply Rmult_lt_0_compat; lra).
  assert (d3 : 0 < y ^ 3 - x ^ 3) by (replace (y ^ 3 - x ^ 3) with ((y - x) * (y ^ 2 + x * y + x ^ 2)) by ring;
    apply Rmult_lt_0_compat; nra).
  assert (P : forall a b c, a <= 0 -> 0 < b -> 0 < c -> 0 <= - a * (b * c)) by (intros a b c ha hb hc;
    apply Rmult_le_pos; [lra|]; apply Rlt_le, Rmult_lt_0_compat; assumption).
  assert (Q : forall a b c, 0 <= a -> 0 < b -> 0 < c -> 0 <= a * (b * c)) by (intros a b c ha hb hc;
    apply Rmult_le_pos; [lra|]; apply Rlt_le, Rmult_lt_0_compat; assumption).
  assert (PS : forall a b c, a < 0 -> 0 < b -> 0 < c -> 0 < - a * (b * c)) by (intros a b c ha hb hc;
    apply Rmult_lt_0_compat; [lra|]; apply Rmult_lt_0_compat; assumption).
  assert (QS : forall a b c, 0 < a -> 0 < b -> 0 < c -> 0 < a * (b * c)) by (intros a b c ha hb hc;
    apply Rmult_lt_0_compat; [lra|]; apply Rmult_lt_0_compat; assumption).
  destruct cases as [(h0 & h1 & h2 & h3 & s)|[(h0 & h1 & h2 & h3 & s)|(h0 & h1 & h2 & h3 & s)]].
  - (* From f(x) on. *)
    assert (c1 * (y - x) + c2 * (y ^ 2 - x ^ 2) + c3 * (y ^ 3 - x ^ 3) + f = c0 + c1 * y + c2 * y ^ 2 + c3 * y ^ 3) as
      <- by (unfold f; ring).
    pose proof (Q c1 (y - x) 1 h1 d1 Rlt_0_1). pose proof (Q c2 (y ^ 2 - x ^ 2) 1 h2 d2 Rlt_0_1).
      pose proof (Q c3 (y ^ 3 - x ^ 3) 1 h3 d3 Rlt_0_1).
    destruct (Rlt_dec 0 c1) as [p|n1]; [pose proof (QS c1 (y - x) 1 p d1 Rlt_0_1); lra|].
    destruct (Rlt_dec 0 c2) as [p|n2]; [pose proof (QS c2 (y ^ 2 - x ^ 2) 1 p d2 Rlt_0_1); lra|].
    destruct (Rlt_dec 0 c3) as [p|n3]; [pose proof (QS c3 (y ^ 3 - x ^ 3) 1 p d3 Rlt_0_1); lra|].
    exfalso. assert (c1 = 0) as e1 by lra. assert (c2 = 0) as e2 by lra. assert (c3 = 0) as e3 by lra.
      unfold f in at_x. rewrite e1, e2, e3 in at_x. destruct s; lra.
  - (* From f(x) y on, over x. *)
    apply (Rmult_lt_reg_r x); [exact x0|]. rewrite Rmult_0_l.
    assert (- c0 * (1 * (y - x)) + c2 * (x * y * (y - x)) + c3 * (x * y * (y ^ 2 - x ^ 2)) + f * y = (c0 + c1 * y + c2
      * y ^ 2 + c3 * y ^ 3) * x) as <- by (unfold f; ring).
    assert (xy0 : 0 < x * y) by (apply Rmult_lt_0_compat; assumption). assert (0 <= f * y) by (apply Rmult_le_pos; lra).
    pose proof (P c0 1 (y - x) h0 Rlt_0_1 d1). pose proof (Q c2 (x * y) (y - x) h2 xy0 d1).
      pose proof (Q c3 (x * y) (y ^ 2 - x ^ 2) h3 xy0 d2).
    destruct (Rlt_dec c0 0) as [p|n1]; [pose proof (PS c0 1 (y - x) p Rlt_0_1 d1); lra|].
    destruct (Rlt_dec 0 c2) as [p|n2]; [pose proof (QS c2 (x * y) (y - x) p xy0 d1); lra|].
    destruct (Rlt_dec 0 c3) as [p|n3]; [pose proof (QS c3 (x * y) (y ^ 2 - x ^ 2) p xy0 d2); lra|].
    exfalso. assert (c0 = 0) as e1 by lra. assert (c2 = 0) as e2 by lra. assert (c3 = 0) as e3 by lra.
      unfold f in at_x. rewrite e1, e2, e3 in at_x. destruct s; nra.
  - (* From f(x) y^2 on, over x^2. *)
    apply (Rmult_lt_reg_r (x ^ 2)); [exact x2|]. rewrite Rmult_0_l.
    assert (- c0 * (1 * (y ^ 2 - x ^ 2)) + - c1 * (x * y * (y - x)) + c3 * (x ^ 2 * y ^ 2 * (y - x)) + f * y ^ 2 = (c0
      + c1 * y + c2 * y ^ 2 + c3 * y ^ 3) * x ^ 2) as <- by (unfold f; ring).
    assert (xy0 : 0 < x * y) by (apply Rmult_lt_0_compat; assumption).
      assert (xxyy : 0 < x ^ 2 * y ^ 2) by (apply Rmult_lt_0_compat; assumption).
    assert (0 <= f * y ^ 2) by (apply Rmult_le_pos; lra).
    pose proof (P c0 1 (y ^ 2 - x ^ 2) h0 Rlt_0_1 d2). pose proof (P c1 (x * y) (y - x) h1 xy0 d1).
      pose proof (Q c3 (x ^ 2 * y ^ 2) (y - x) h3 xxyy d1).
    destruct (Rlt_dec c0 0) as [p|n1]; [pose proof (PS c0 1 (y ^ 2 - x ^ 2) p Rlt_0_1 d2); lra|].
    destruct (Rlt_dec c1 0) as [p|n2]; [pose proof (PS c1 (x * y) (y - x) p xy0 d1); lra|].
    destruct (Rlt_dec 0 c3) as [p|n3]; [pose proof (QS c3 (x ^ 2 * y ^ 2) (y - x) p xxyy d1); lra|].
    exfalso. assert (c0 = 0) as e1 by lra. assert (c1 = 0) as e2 by lra. assert (c3 = 0) as e3 by lra.
      unfold f in at_x. rewrite e1, e2, e3 in at_x. destruct s; nra.
Qed.
Lemma at_cubic (a b c d : Z) s : at_ [a; b; c; d] s = IZR a + IZR b * s + IZR c * s ^ 2 + IZR d * s ^ 3.
Proof. unfold at_. cbn [fold_right]. ring. Qed.
Section Descartes.
Variables k0 k1 k2 k3 : Z.
Notation volume := [k0; k1; k2; k3].
Notation signs := (map (sign_ whole) volume).
Lemma no_change s : 0 < s -> sign_before_end whole volume <> Eq -> changes_of_sign Eq signs = 0%nat ->
  at_ volume s <> 0.
Proof.
  intros s0 some. rewrite at_cubic. unfold sign_before_end in some. cbn [rev app map first_of_signs whole sign_] in *.
  assert (s2 : 0 < s ^ 2) by (apply pow_lt; lra). assert (s3 : 0 < s ^ 3) by (apply pow_lt; lra).
  pose proof (says_compare k0) as T0. pose proof (says_scaled _ s _ s0 (says_compare k1)) as T1.
  pose proof (says_scaled _ _ _ s2 (says_compare k2)) as T2. pose proof (says_scaled _ _ _ s3 (says_compare k3)) as T3.
  set (t1 := IZR k1 * s) in *. set (t2 := IZR k2 * s ^ 2) in *. set (t3 := IZR k3 * s ^ 3) in *. clearbody t1 t2 t3.
  revert some T0 T1 T2 T3. destruct (k0 ?= 0)%Z, (k1 ?= 0)%Z, (k2 ?= 0)%Z, (k3 ?= 0)%Z;
    cbn [changes_of_sign equal_signs CompOpp Nat.add says first_of_signs]; intros;
    try discriminate; try congruence; lra.
Qed.
Lemma one_change x y : 0 < x < y -> changes_of_sign Eq signs = 1%nat ->
  let first := sign_after_start whole volume in
  (at_ volume x = 0 \/ says (at_ volume x) (CompOpp first)) -> says (at_ volume y) (CompOpp first).
Proof.
  intros xy. cbv zeta. rewrite !at_cubic. unfold sign_after_start. cbn [map first_of_signs whole sign_].
  pose proof (says_compare k0) as T0. pose proof (says_compare k1) as T1. pose proof (says_compare k2) as T2.
    pose proof (says_compare k3) as T3.
  pose proof (rises (IZR k0) (IZR k1) (IZR k2) (IZR k3) x y xy) as U.
  pose proof (rises (- IZR k0) (- IZR k1) (- IZR k2) (- IZR k3) x y xy) as D.
  replace (- IZR k0 + - IZR k1 * x + - IZR k2 * x ^ 2 + - IZR k3 * x ^ 3) with (- (IZR k0 + IZR k1 * x + IZR k2 * x ^ 2
    + IZR k3 * x ^ 3)) in D by ring.
  replace (- IZR k0 + - IZR k1 * y + - IZR k2 * y ^ 2 + - IZR k3 * y ^ 3) with (- (IZR k0 + IZR k1 * y + IZR k2 * y ^ 2
    + IZR k3 * y ^ 3)) in D by ring.
  set (fx := IZR k0 + IZR k1 * x + IZR k2 * x ^ 2 + IZR k3 * x ^ 3) in *.
    set (fy := IZR k0 + IZR k1 * y + IZR k2 * y ^ 2 + IZR k3 * y ^ 3) in *.
  set (r0 := IZR k0) in *. set (r1 := IZR k1) in *. set (r2 := IZR k2) in *. set (r3 := IZR k3) in *.
    clearbody fx fy r0 r1 r2 r3.
  revert T0 T1 T2 T3. destruct (k0 ?= 0)%Z, (k1 ?= 0)%Z, (k2 ?= 0)%Z, (k3 ?= 0)%Z;
    cbn [changes_of_sign equal_signs CompOpp Nat.add says first_of_signs]; intros T0 T1 T2 T3 one at_x;
    try discriminate one;
    first [refine (U _ _) | apply Ropp_lt_cancel; rewrite Ropp_0; refine (D _ _)]; clear U D;
    first [lra | left; lra | right; left; lra | right; right; lra].
Qed.
End Descartes.

(* **The times that are tested are those at which the volume is zero**: each is one, and no other is left out. *)
Theorem times_are_the_roots k0 k1 k2 k3 : ~ Forall (fun k => k = 0%Z) [k0; k1; k2; k3] ->
  (forall m, In m (times_of whole k0 k1 k2 k3) -> exists s, is_time m s /\ at_ [k0; k1; k2; k3] s = 0) /\
  (forall s, 0 < s -> at_ [k0; k1; k2; k3] s = 0 -> exists m, In m (times_of whole k0 k1 k2 k3) /\ is_time m s).
Proof.
  intro some. set (volume := [k0; k1; k2; k3]) in *.
  assert (ends : sign_before_end whole volume <> Eq).
  { intro E. apply some. apply first_of_signs_zero in E. apply Forall_rev in E. now rewrite rev_involutive in E. }
  assert (starts : sign_after_start whole volume <> Eq) by (intro E; apply some; now apply first_of_signs_zero).
  destruct (just_after_start volume) as (e & e0 & near). destruct (just_before_end volume) as (z & z0 & far).
  unfold times_of. fold volume. destruct (changes_of_sign Eq (map (sign_ whole) volume)) as [|[|n]] eqn:C.
  - split; [intros m []|]. intros s s0 z'. exfalso. exact (no_change k0 k1 k2 k3 s s0 ends C z').
  - (* One change of sign. *)
    set (first := sign_after_start whole volume) in *.
    assert (last : sign_before_end whole volume = CompOpp first).
    { unfold first. revert C ends starts. unfold sign_before_end, sign_after_start, volume.
      cbn [rev app map first_of_signs whole sign_].
      destruct (k0 ?= 0)%Z, (k1 ?= 0)%Z, (k2 ?= 0)%Z, (k3 ?= 0)%Z; cbn [changes_of_sign equal_signs CompOpp Nat.add];
        intros; (reflexivity || discriminate || congruence). }
    assert (later : forall x y, 0 < x < y -> at_ volume x = 0 \/ says (at_ volume x) (CompOpp first) ->
      says (at_ volume y) (CompOpp first)).
    { intros x y r h. exact (one_change k0 k1 k2 k3 x y r C h). }
    assert (root : exists k, 0 < k /\ at_ volume k = 0).
    { set (a := e / 2). set (b := Rmax a z + 1). pose proof (Rmax_l a z). pose proof (Rmax_r a z).
      assert (a0 : 0 < a < e) by (unfold a; lra).
      pose proof (near a a0) as A. pose proof (far b ltac:(unfold b; lra)) as B. rewrite last in B.
      destruct (IVT_cor (at_ volume) a b (at_continuous volume) ltac:(unfold b; lra)) as (k & r & zero_).
      - unfold says in A, B. destruct first; cbn [CompOpp] in B; [contradiction|nra|nra].
      - exists k. split; [lra|exact zero_]. }
    destruct root as (k & kpos & kz).
    assert (X : is_crossing (between_ends whole volume) k).
    { constructor; cbn [between_ends cubic after before sign_before]; try assumption; fold first.
      - cbn; lia.
      - split; exact I.
      - split; [exact kpos|exact I].
      - intros s s0 _ sk. destruct (Rtotal_order (at_ volume s) 0) as [neg|[zero_|pos]].
        + destruct first; [contradiction|exact neg|exfalso]. pose proof (later s k ltac:(lra) (or_intror neg)) as L.
          rewrite kz in L. cbn in L. lra.
        + exfalso. pose proof (later s k ltac:(lra) (or_introl zero_)) as L. rewrite kz in L. unfold says in L.
          destruct first; cbn in L; [contradiction|lra|lra].
        + destruct first; [contradiction|exfalso|exact pos]. pose proof (later s k ltac:(lra) (or_intror pos)) as L.
          rewrite kz in L. cbn in L. lra.
      - intros s ks _. apply (later k s); [lra|now left]. }
    pose proof (a_crossing_is_a_time _ k X) as M. split.
    + intros m [<-|[]]. exists k. split; assumption.
    + intros s s0 sz. exists (AtCrossing (between_ends whole volume)). split; [now left|].
      destruct (Rtotal_order s k) as [less|[->|more]]; [|exact M|].
      * pose proof (later s k ltac:(lra) (or_introl sz)) as L. rewrite kz in L. unfold says in L. destruct first;
        cbn in L; [contradiction|lra|lra].
      * pose proof (later k s ltac:(lra) (or_introl kz)) as L. rewrite sz in L. unfold says in L. destruct first;
        cbn in L; [contradiction|lra|lra].
  - (* Several. *)
    set (derivative := [k1; doubled_ whole k2; tripled_ whole k3]).
    destruct (positive_roots_are derivative 1 (fun _ => Eq) ltac:(cbn; lia) Rlt_0_1) as [roots_ _].
    apply times_from_are; try exact I; try reflexivity.
    + exact ends.
    + cbn. lra.
    + intros d d0. exists (Rmin e d / 2). cbn [start_of between_ends after]. pose proof (Rmin_l e d).
      pose proof (Rmin_r e d).
      assert (0 < Rmin e d) by (apply Rmin_pos; assumption). split; [lra|]. apply near. lra.
    + intro none. exfalso. now apply none.
    + exact roots_.
    + cbn [start_of between_ends after]. rewrite positive_is.
      assert (A : forall roots, Forall (fun q => is_positive_root q /\ at_ derivative (root_value q) = 0) roots ->
        match roots with [p; q] => root_value p <= root_value q | [] | [_] => True | _ => False end ->
          ascending 0 roots).
      { intros [|p [|q [|o roots]]] F; cbn; try tauto.
        - intros _. inversion F as [|? ? [[_ h] _] _]. split; [lra|exact I].
        - intro le. inversion F as [|? ? [[_ h] _] _]. repeat split; lra. }
      rewrite positive_is in roots_. apply A; [exact roots_|].
      assert (B : forall a b c, match roots_of a b c with [p;
        q] => root_value p <= root_value q | [] | [_] => True | _ => False end).
      { intros a b c. unfold roots_of. pose proof (discriminant_sign_is a b c) as D. destruct (a ?= 0)%Z, (b ?= 0)%Z;
        try exact I.
        destruct (Z.compare_spec c 0) as [|?|c0]; try exact I. destruct (discriminant_sign whole a b c); try exact I;
          unfold says in D;
          apply (factors a b c 0 c0); lra. }
      destruct (sign_before_end whole [nth 0 derivative 0%Z; nth 1 derivative 0%Z; nth 2 derivative 0%Z]); apply B.
    + intros s s0 sz. cbn [start_of between_ends after] in s0.
      destruct (no_other_positive_roots derivative s ltac:(cbn; lia) s0 sz) as [zeros|(q & i & E)]; [|now exists q].
      exfalso. unfold derivative, doubled_, tripled_, doubled_ in zeros. cbn [whole plus_] in zeros.
      inversion zeros as [|? ? e1 zs1]; subst. inversion zs1 as [|? ? e2 zs2]; subst. inversion zs2 as [|? ? e3 _];
        subst.
      assert (k2 = 0%Z) as -> by lia. assert (k3 = 0%Z) as -> by lia. revert C. unfold volume.
        cbn [map whole sign_ Z.compare].
      destruct (k0 ?= 0)%Z; cbn; discriminate.
Qed.

(* Numbers of any ring that stands for whole numbers, such as words, give the same signs, times and roots. *)
Section Transfer.
Context {T : Type} (r : ring T) (stands : T -> Z -> Prop).
Hypothesis zero_stands : stands (zero r) 0%Z.
Hypothesis plus_stands : forall a b x y, stands a x -> stands b y -> stands (plus_ r a b) (x + y)%Z.
Hypothesis minus_stands : forall a b x y, stands a x -> stands b y -> stands (minus_ r a b) (x - y)%Z.
Hypothesis times_stands : forall a b x y, stands a x -> stands b y -> stands (times_ r a b) (x * y)%Z.
Hypothesis minor_stands : forall a b c d x y z w, stands a x -> stands b y -> stands c z -> stands d w ->
  stands (minor_ r a b c d) (x * w - y * z)%Z.
Hypothesis sign_stands : forall a x, stands a x -> sign_ r a = Z.compare x 0.
Notation all_stand := (Forall2 stands).
Lemma quotient_stands a b l v p first x y xs n q : stands a x -> stands b y -> all_stand l xs -> stands v n ->
  stands p q ->
  stands (quotient_steps r a b l v p first) (quotient_steps whole x y xs n q first).
Proof.
  intros ha hb hl. revert v n p q first. induction hl as [|k h l' xs' hk _ IH]; intros v n p q first hv hp; [exact hv|].
  cbn [quotient_steps whole minor_ times_]. destruct first; (apply IH; [apply minor_stands|]); auto.
Qed.
Lemma reversed_stand l xs : all_stand l xs -> all_stand (rev l) (rev xs).
Proof. induction 1; [constructor|]. cbn [rev]. apply Forall2_app; [assumption|]. constructor;
  [assumption|constructor]. Qed.
Lemma value_stands a b l x y xs : stands a x -> stands b y -> all_stand l xs ->
  stands (value_at_quotient r a b l) (value_at_quotient whole x y xs).
Proof.
  intros ha hb hl. apply reversed_stand in hl. unfold value_at_quotient. inversion hl as [|? ? ? ? hv hr];
    [exact zero_stands|].
  now apply quotient_stands.
Qed.
Lemma steps_stand a b c l l0 l1 p first x y z xs n0 n1 q : stands a x -> stands b y -> stands c z -> all_stand l xs ->
  stands l0 n0 -> stands l1 n1 -> stands p q ->
  let '(u0, u1) := remainder_steps r a b c l l0 l1 p first in let '(w0, w1) := remainder_steps whole x y z xs n0 n1 q
    first in
  stands u0 w0 /\ stands u1 w1.
Proof.
  intros ha hb hc hl. revert l0 l1 p first n0 n1 q. induction hl as [|k h l' xs' hk _ IH];
    intros l0 l1 p first n0 n1 q h0 h1 hp; [split; assumption|].
  cbn [remainder_steps]. apply IH; [apply minor_stands|apply minor_stands|]; auto; destruct first; auto;
    now apply times_stands.
Qed.
Definition root_stands (q : @root T) (o : @root Z) := stands (constant q) (constant o) /\
  stands (linear q) (linear o) /\
  stands (square q) (square o) /\ at_side q = at_side o.
Lemma zeros_stand l xs : all_stand l xs -> forallb (is_zero r) l = forallb (is_zero whole) xs.
Proof.
  induction 1 as [|k h l xs hk _ IH]; [reflexivity|]. cbn [forallb]. rewrite IH. unfold is_zero.
    now rewrite (sign_stands k h hk).
Qed.
Theorem sign_at_root_stands q o l xs : root_stands q o -> all_stand l xs ->
  sign_at_root r q l = sign_at_root whole o xs.
Proof.
  intros (ha & hb & hc & same) hl. unfold sign_at_root. rewrite (zeros_stand l xs hl). destruct (forallb _ xs);
    [reflexivity|].
  unfold is_zero. rewrite (sign_stands _ _ hc). cbn [whole sign_].
  destruct (square o ?= 0)%Z; [exact (sign_stands _ _ (value_stands _ _ _ _ _ _ ha hb hl))| |];
    unfold terms, remainder; pose proof (reversed_stand l xs hl) as hr;
    (assert (R : let '(u0, u1) := remainder r (constant q) (linear q) (square q) l in
       let '(w0, w1) := remainder whole (constant o) (linear o) (square o) xs in stands u0 w0 /\ stands u1 w1);
     [unfold remainder; inversion hr as [|k1 h1 t1 s1 e1 [|k0 h0 t0 s0 e0 er]]; [split; exact zero_stands|split;
       [exact zero_stands|exact e1]|
        now apply steps_stand]|]);
    unfold remainder in R; destruct (match rev l with [] => _ | _ => _ end) as [u0 u1];
      destruct (match rev xs with [] => _ | _ => _ end) as [w0 w1];
    destruct R as [R0 R1]; cbn [whole times_ minus_ plus_];
    rewrite (sign_stands _ _ R1), (sign_stands _ _ (plus_stands _ _ _ _ (minus_stands _ _ _ _ (times_stands _ _ _ _ R0
      hc) (times_stands _ _ _ _ R1 hb)) (times_stands _ _ _ _ R0 hc))),
      (sign_stands _ _ (plus_stands _ _ _ _ (times_stands _ _ _ _ R0 (minus_stands _ _ _ _ (times_stands _ _ _ _ R0 hc)
        (times_stands _ _ _ _ R1 hb)))
        (times_stands _ _ _ _ (times_stands _ _ _ _ R1 R1) ha))), same; reflexivity.
Qed.
Notation roots_stand := (Forall2 root_stands).
Lemma first_sign_stands l xs : all_stand l xs -> first_of_signs r l = first_of_signs whole xs.
Proof. induction 1 as [|k h l xs hk _ IH]; [reflexivity|]. cbn [first_of_signs]. now rewrite (sign_stands k h hk), IH.
  Qed.
Lemma end_stands l xs : all_stand l xs -> sign_before_end r l = sign_before_end whole xs.
Proof. intro h. apply first_sign_stands, reversed_stand, h. Qed.
Lemma nth_stands n l xs : all_stand l xs -> stands (nth_ r n l) (nth_ whole n xs).
Proof.
  intro h. unfold nth_. revert n. induction h as [|k h l xs hk _ IH]; intros [|n]; cbn [nth]; try exact zero_stands;
    [exact hk|apply IH].
Qed.
Lemma negated_stands a x : stands a x -> stands (negated_ r a) (negated_ whole x).
Proof. intro h. apply minus_stands; [exact zero_stands|exact h]. Qed.
Lemma doubled_stands a x : stands a x -> stands (doubled_ r a) (doubled_ whole x).
Proof. intro h. now apply plus_stands. Qed.
Lemma tripled_stands a x : stands a x -> stands (tripled_ r a) (tripled_ whole x).
Proof. intro h. apply plus_stands; [now apply doubled_stands|exact h]. Qed.
Lemma discriminant_stands a b c x y z : stands a x -> stands b y -> stands c z ->
  discriminant_sign r a b c = discriminant_sign whole x y z.
Proof.
  intros ha hb hc. apply sign_stands. apply minus_stands; [now apply times_stands|]. do 2 apply doubled_stands.
    now apply times_stands.
Qed.
Lemma positive_stands l xs : all_stand l xs -> roots_stand (positive r l) (positive whole xs).
Proof.
  intro h. unfold positive. cbv zeta.
  assert (Q : all_stand [nth_ r 0 l; nth_ r 1 l; nth_ r 2 l] [nth_ whole 0 xs; nth_ whole 1 xs; nth_ whole 2 xs]) by
    (repeat constructor; now apply nth_stands).
  rewrite (end_stands _ _ Q). set (A := [nth_ r 0 l; nth_ r 1 l; nth_ r 2 l]) in *. set (B := [nth_ whole 0 xs;
    nth_ whole 1 xs; nth_ whole 2 xs]) in *.
  assert (N : all_stand (match sign_before_end whole B with Lt => map (negated_ r) A | _ => A end)
    (match sign_before_end whole B with Lt => map (negated_ whole) B | _ => B end)).
  { destruct (sign_before_end whole B); try exact Q. clear -Q zero_stands minus_stands. induction Q; [constructor|].
    cbn [map]. constructor; [now apply negated_stands|assumption]. }
  set (C := match sign_before_end whole B with Lt => map (negated_ r) A | _ => A end) in *.
  set (D := match sign_before_end whole B with Lt => map (negated_ whole) B | _ => B end) in *. clearbody C D.
  pose proof (nth_stands 0 _ _ N) as a. pose proof (nth_stands 1 _ _ N) as b. pose proof (nth_stands 2 _ _ N) as c.
  rewrite (sign_stands _ _ a), (sign_stands _ _ b), (sign_stands _ _ c), (discriminant_stands _ _ _ _ _ _ a b c).
    cbn [whole sign_].
  assert (R : forall side, root_stands (Root (nth_ r 0 C) (nth_ r 1 C) (nth_ r 2 C) side) (Root (nth_ whole 0 D) (nth_
    whole 1 D) (nth_ whole 2 D) side)).
  { intro side. repeat split; assumption. }
  destruct (nth_ whole 0 D ?= 0)%Z, (nth_ whole 1 D ?= 0)%Z, (nth_ whole 2 D ?= 0)%Z, (discriminant_sign whole (nth_
    whole 0 D) (nth_ whole 1 D) (nth_ whole 2 D)); repeat constructor; apply R.
Qed.
Lemma compare_stands q q' o o' : root_stands q q' -> root_stands o o' -> compare r q o = compare whole q' o'.
Proof.
  intros hq (ha & hb & hc & same). unfold compare. cbv zeta. unfold is_zero. rewrite (sign_stands _ _ hc), same.
    cbn [whole sign_].
  rewrite (sign_at_root_stands q q' _ [constant o'; linear o'; square o'] hq) by (repeat constructor; assumption).
  rewrite (sign_at_root_stands q q' _ [linear o'; doubled_ whole (square o')] hq) by (repeat constructor;
    try assumption; now apply doubled_stands).
  reflexivity.
Qed.
Definition option_stands (a : option (@root T)) (b : option (@root Z)) := match a, b with
  | Some q, Some o => root_stands q o | None, None => True | _, _ => False end.
Definition crossing_stands (x : @crossing T) (y : @crossing Z) := all_stand (cubic x) (cubic y) /\
  option_stands (after x) (after y) /\
  option_stands (before x) (before y) /\ sign_before x = sign_before y.
Lemma compare_crossing_stands x y q o : crossing_stands x y -> root_stands q o ->
  compare_crossing r x q = compare_crossing whole y o.
Proof.
  intros (hc & ha & hb & hs) hq. unfold compare_crossing. rewrite (sign_at_root_stands q o _ _ hq hc), hs.
  unfold option_stands in *. destruct (after x), (after y); try contradiction; destruct (before x), (before y);
    try contradiction;
    repeat match goal with h : root_stands ?a ?b |- context [compare r q ?a] => rewrite (compare_stands q o a b hq h)
      end; reflexivity.
Qed.
Theorem sign_at_crossing_stands x y l xs : crossing_stands x y -> all_stand l xs ->
  sign_at_crossing r x l = sign_at_crossing whole y xs.
Proof.
  intros hx hl. unfold sign_at_crossing. rewrite (end_stands l xs hl). generalize (sign_before_end whole xs).
  induction (positive_stands l xs hl) as [|q o qs os h _ IH]; intro sign; [reflexivity|]. cbn [turned].
  rewrite (compare_crossing_stands x y q o hx h). destruct (compare_crossing whole y o); auto.
Qed.
Definition moment_stands (m : @moment T) (n : @moment Z) := match m, n with
  | AtRoot q, AtRoot o => root_stands q o | AtCrossing x, AtCrossing y => crossing_stands x y | _, _ => False end.
Theorem sign_at_stands m n l xs : moment_stands m n -> all_stand l xs -> sign_at r m l = sign_at whole n xs.
Proof. destruct m, n; try contradiction; [apply sign_at_root_stands|apply sign_at_crossing_stands]. Qed.
Lemma times_from_stands volume volume' rest rest' roots roots' x y : all_stand volume volume' ->
  all_stand rest rest' -> roots_stand roots roots' ->
  crossing_stands x y -> Forall2 moment_stands (times_from r volume rest roots x) (times_from whole volume' rest'
    roots' y).
Proof.
  intros hv hr hq. revert x y. induction hq as [|q o qs os h _ IH]; intros x y hx; cbn [times_from];
    destruct hx as (hc & ha & hb & hs).
  - rewrite (end_stands _ _ hv), hs. destruct (equal_signs _ _); [|constructor]. constructor; [|constructor].
    split; [exact hc|]. split; [exact ha|]. split; [exact hb|exact hs].
  - rewrite (sign_at_root_stands q o _ _ h hr), hs. apply Forall2_app.
    + assert (C : crossing_stands (Crossing (cubic x) (after x) (Some q) (sign_before y)) (Crossing (cubic y) (after y)
      (Some o) (sign_before y)))
        by (split; [exact hc|split; [exact ha|split; [exact h|reflexivity]]]).
      destruct (sign_at_root whole o rest'); [constructor; [exact h|constructor]|
        destruct (equal_signs _ _); [constructor; [exact C|constructor]|constructor]..].
    + apply IH. split; [exact hv|]. split; [exact h|]. split; [exact I|reflexivity].
Qed.
Theorem times_of_stand a b c d x y z w : stands a x -> stands b y -> stands c z -> stands d w ->
  Forall2 moment_stands (times_of r a b c d) (times_of whole x y z w).
Proof.
  intros ha hb hc hd. assert (V : all_stand [a; b; c; d] [x; y; z; w]) by (repeat constructor; assumption).
    unfold times_of. cbv zeta.
  assert (S : map (sign_ r) [a; b; c; d] = map (sign_ whole) [x; y; z; w]).
  { cbn [map]. rewrite (sign_stands _ _ ha), (sign_stands _ _ hb), (sign_stands _ _ hc), (sign_stands _ _ hd).
    reflexivity. }
  rewrite S. assert (B : crossing_stands (between_ends r [a; b; c; d]) (between_ends whole [x; y; z; w])).
  { split; [exact V|]. split; [exact I|]. split; [exact I|]. exact (first_sign_stands _ _ V). }
  destruct (changes_of_sign Eq _) as [|[|n]]; [constructor|constructor; [exact B|constructor]|].
  apply times_from_stands; [exact V| | |exact B].
  - repeat constructor; [now apply tripled_stands|now apply doubled_stands|exact hc].
  - apply positive_stands. repeat constructor; [exact hb|now apply doubled_stands|now apply tripled_stands].
Qed.
End Transfer.
(* In words: the times that are tested are the roots, and the signs there are right. *)
Definition in_words := Ring (list Z) [] (plus 64) (minus 64) (times 64) (minor 64) (words_sign 64).
Definition is_time_in_words m s := 0 < s /\ forall l p, Forall2 holds l p -> (2 <= length p <= 3)%nat ->
  says (at_ p s) (sign_at in_words m l).
Theorem times_in_words w0 w1 w2 w3 k0 k1 k2 k3 : holds w0 k0 -> holds w1 k1 -> holds w2 k2 -> holds w3 k3 ->
  ~ Forall (fun k => k = 0%Z) [k0; k1; k2; k3] ->
  (forall m, In m (times_of in_words w0 w1 w2 w3) -> exists s, is_time_in_words m s /\ at_ [k0; k1; k2; k3] s = 0) /\
  (forall s, 0 < s -> at_ [k0; k1; k2; k3] s = 0 -> exists m, In m (times_of in_words w0 w1 w2 w3) /\
    is_time_in_words m s).
Proof.
  intros h0 h1 h2 h3 some. destruct (times_are_the_roots k0 k1 k2 k3 some) as [sound complete].
  assert (r64 : (1 <= 64)%Z) by lia. assert (Z_ : holds [] 0%Z) by now apply zero_is.
  pose proof (fun a b x y => plus_is 64 r64 a b x y) as P. pose proof (fun a b x y => minus_is 64 r64 a b x y) as M.
  pose proof (fun a b x y => times_is 64 r64 a b x y) as X. pose proof (fun a b c d x y z w => minor_is 64 r64 a b c d
    x y z w) as N.
  assert (S : forall a x, holds a x -> words_sign 64 a = Z.compare x 0).
  { intros a x (u & v & <-). now apply words_sign_is. }
  pose proof (times_of_stand in_words holds Z_ P M X N S _ _ _ _ _ _ _ _ h0 h1 h2 h3) as F.
  assert (T : forall m n s, moment_stands holds m n -> is_time n s -> is_time_in_words m s).
  { intros m n s h [s0 signs_]. split; [exact s0|]. intros l p hl two.
    rewrite (sign_at_stands in_words holds Z_ P M X N S m n l p h hl). now apply signs_. }
  clear P M X N S. split.
  - intros m i. assert (exists n, In n (times_of whole k0 k1 k2 k3) /\ moment_stands holds m n) as (n & j & h).
    { clear -F i. induction F as [|m' n ms ns h _ IH]; [contradiction|]. destruct i as [->|i]; [exists n; split;
      [now left|exact h]|].
      destruct (IH i) as (o & j & g). exists o. split; [now right|exact g]. }
    destruct (sound n j) as (s & t & z). exists s. split; [now apply (T m n)|exact z].
  - intros s s0 z. destruct (complete s s0 z) as (n & j & t).
    assert (exists m, In m (times_of in_words w0 w1 w2 w3) /\ moment_stands holds m n) as (m & i & h).
    { clear -F j. induction F as [|m n' ms ns h _ IH]; [contradiction|]. destruct j as [->|j]; [exists m; split;
      [now left|exact h]|].
      destruct (IH j) as (o & i & g). exists o. split; [now right|exact g]. }
    exists m. split; [exact i|now apply (T m n)].
Qed.
