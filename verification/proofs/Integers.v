(* The exact signs: kernel.rs and aligned.rs of core/src/kernels/exact, in their shape, on the integers of `Words.v`.
  The
   code's control values are the exact ones of the coordinates as encodings have them, up to a positive factor. *)
From Coq Require Import Reals ZArith Lia Lra List Bool.
From Flocq Require Import Core.
From Selvedge Require Import Words.
From Selvedge Require Narrowing Geometry.
Import ListNotations.
Open Scope Z_scope.

Notation word := (word 64).
Notation fits := (fits 64).
Notation is := (is 64).
Notation holds := (holds 64).

(* Room: coordinates of 64 N - 3 bits; products of two fit 2 N words, control values fit 3 N words, with a sign. *)
Section Room.
Variable n : Z.
Hypothesis some : 1 <= n.
Notation m := (64 * n - 2).
Notation coordinate c := (Z.abs c < 2 ^ (64 * n - 3)).
Theorem differences_have_room c d : coordinate c -> coordinate d -> Z.abs (c - d) < 2 ^ m.
Proof.
  intros. replace m with (1 + (64 * n - 3)) by ring. rewrite Z.pow_add_r by lia. change (2 ^ 1) with 2. lia.
Qed.
Notation small x := (Z.abs x <= 2 ^ m).
Lemma product_below x y a b : Z.abs x <= a -> Z.abs y <= b -> Z.abs (x * y) <= a * b.
Proof. intros. rewrite Z.abs_mul. pose proof (Z.abs_nonneg x). pose proof (Z.abs_nonneg y). nia. Qed.
Notation square := (2 ^ m * 2 ^ m).
Theorem crosses_have_room a b c d : small a -> small b -> small c -> small d -> Z.abs (a * b - c * d) <= 2 * square.
Proof. intros ha hb hc hd. pose proof (product_below a b _ _ ha hb). pose proof (product_below c d _ _ hc hd). lia. Qed.
Theorem two_words_suffice x : Z.abs x <= 6 * square -> - (word ^ (2 * n)) <= 2 * x < word ^ (2 * n).
Proof.
  intro h. assert (word ^ (2 * n) = 16 * square) as ->; [|pose proof (Z.pow_pos_nonneg 2 m ltac:(lia) ltac:(lia)); nia].
  change word with (2 ^ 64). rewrite <- Z.pow_mul_r, <- Z.pow_add_r by lia. transitivity (2 ^ 4 * 2 ^ (m + m));
    [|change (2 ^ 6) with 64; change (2 ^ 4) with 16; reflexivity].
  rewrite <- Z.pow_add_r by lia. f_equal. ring.
Qed.
Theorem three_words_suffice x : Z.abs x <= 18 * (2 ^ m * square) -> - (word ^ (3 * n)) <= 2 * x < word ^ (3 * n).
Proof.
  intro h. assert (word ^ (3 * n) = 64 * (2 ^ m * square)) as ->; [|pose proof (Z.pow_pos_nonneg 2 m ltac:(lia)
    ltac:(lia)); nia].
  change word with (2 ^ 64). rewrite <- Z.pow_mul_r, <- !Z.pow_add_r by lia. transitivity (2 ^ 6 * 2 ^ (m + (m + m)));
    [|change (2 ^ 6) with 64; change (2 ^ 4) with 16; reflexivity].
  rewrite <- Z.pow_add_r by lia. f_equal. ring.
Qed.
Lemma dot_below k px py pz nx ny nz : small px -> small py -> small pz -> Z.abs nx <= k -> Z.abs ny <= k -> Z.abs nz <=
  k ->
  Z.abs (px * nx + py * ny + pz * nz) <= 3 * (2 ^ m * k).
Proof.
  intros x y z a b c. pose proof (product_below _ _ _ _ x a). pose proof (product_below _ _ _ _ y b).
    pose proof (product_below _ _ _ _ z c). lia.
Qed.
(* p0 . h + p1 . n0: components of h at most 4, of n0 at most 2 such squares. *)
Theorem control_values_have_room p0x p0y p0z p1x p1y p1z hx hy hz nx ny nz :
  small p0x -> small p0y -> small p0z -> small p1x -> small p1y -> small p1z ->
  Z.abs hx <= 4 * square -> Z.abs hy <= 4 * square -> Z.abs hz <= 4 * square ->
  Z.abs nx <= 2 * square -> Z.abs ny <= 2 * square -> Z.abs nz <= 2 * square ->
  Z.abs ((p0x * hx + p0y * hy + p0z * hz) + (p1x * nx + p1y * ny + p1z * nz)) <= 18 * (2 ^ m * square).
Proof.
  intros a b c d e g h1 h2 h3 n1 n2 n3. eapply Z.le_trans; [apply Z.abs_triangle|].
  replace (18 * (2 ^ m * square)) with (3 * (2 ^ m * (4 * square)) + 3 * (2 ^ m * (2 * square))) by ring.
  apply Z.add_le_mono; apply dot_below; assumption.
Qed.
End Room.

(* kernel.rs: `Arithmetic`, for numbers of any type. *)
Record triple T := Triple { x_ : T; y_ : T; z_ : T }.
Arguments Triple {T}. Arguments x_ {T}. Arguments y_ {T}. Arguments z_ {T}.
Record arithmetic T := Arithmetic { difference : T -> T -> T; cross : triple T -> triple T -> triple T;
  sum : triple T -> triple T -> triple T; dot : triple T -> triple T -> T; sum_of_three : T -> T -> T }.
Arguments difference {T}. Arguments cross {T}. Arguments sum {T}. Arguments dot {T}. Arguments sum_of_three {T}.
Definition by_operations {T} (plus minus times : T -> T -> T) := Arithmetic T minus
  (fun a b => Triple (minus (times (y_ a) (z_ b)) (times (z_ a) (y_ b))) (minus (times (z_ a) (x_ b)) (times (x_ a) (z_
    b)))
    (minus (times (x_ a) (y_ b)) (times (y_ a) (x_ b))))
  (fun a b => Triple (plus (x_ a) (x_ b)) (plus (y_ a) (y_ b)) (plus (z_ a) (z_ b)))
  (fun a b => plus (plus (times (x_ a) (x_ b)) (times (y_ a) (y_ b))) (times (z_ a) (z_ b))) plus.
(* Numbers of a fixed width, of as many words as they need, and exact ones. *)
Definition fixed := by_operations (integer_plus 64) (integer_minus 64) (integer_times 64).
Definition space := Arithmetic (list Z) (minus 64)
  (fun a b => Triple (minor 64 (y_ a) (z_ a) (y_ b) (z_ b)) (minor 64 (z_ a) (x_ a) (z_ b) (x_ b))
    (minor 64 (x_ a) (y_ a) (x_ b) (y_ b)))
  (fun a b => Triple (plus 64 (x_ a) (x_ b)) (plus 64 (y_ a) (y_ b)) (plus 64 (z_ a) (z_ b)))
  (fun a b => sum_of_products 64 (x_ a) (x_ b) (y_ a) (y_ b) (z_ a) (z_ b)) (plus 64).
Definition exact := by_operations Z.add Z.sub Z.mul.
Inductive pair_kind := VertexFace | EdgeEdge.
(* The eight coordinates along each axis: four points at the start, then at the end. *)
Section Control.
Context {T : Type} (A : arithmetic T) (kind : pair_kind) (coordinates : triple (nat -> T)).
Definition point n := Triple (x_ coordinates n) (y_ coordinates n) (z_ coordinates n).
Definition differences a b := Triple (difference A (x_ a) (x_ b)) (difference A (y_ a) (y_ b)) (difference A (z_ a) (z_
  b)).
Definition edges at_ := match kind with
  | VertexFace => (differences (point (2 + at_)) (point (1 + at_)), differences (point (3 + at_)) (point (1 + at_)),
      differences (point (0 + at_)) (point (1 + at_)))
  | EdgeEdge => (differences (point (1 + at_)) (point (0 + at_)), differences (point (3 + at_)) (point (2 + at_)),
      differences (point (0 + at_)) (point (2 + at_))) end.
Definition control_values :=
  let '(b0, c0, p0) := edges 0 in let '(b1, c1, p1) := edges 4 in
  let n0 := cross A b0 c0 in let n1 := cross A b1 c1 in
  let h := sum A (cross A b0 c1) (cross A b1 c0) in
  [dot A p0 n0; sum_of_three A (dot A p0 h) (dot A p1 n0); sum_of_three A (dot A p1 h) (dot A p0 n1); dot A p1 n1].
End Control.

(* What the words of an arithmetic stand for, with the squares and cubes of 2^m that bound them. *)
Section Widths.
Variable A : arithmetic (list Z).
Variables coordinate one : list Z -> Z -> Prop.
Variables two three : Z -> list Z -> Z -> Prop.
Definition all (p : list Z -> Z -> Prop) ws v := p (x_ ws) (x_ v) /\ p (y_ ws) (y_ v) /\ p (z_ ws) (z_ v).
Hypothesis differences_are : forall a b x y, coordinate a x -> coordinate b y -> one (difference A a b) (x - y).
Hypothesis crosses_are : forall a b x y, all one a x -> all one b y -> all (two 2) (cross A a b) (cross exact x y).
Hypothesis sums_are : forall a b x y, all (two 2) a x -> all (two 2) b y -> all (two 4) (sum A a b) (sum exact x y).
Hypothesis dots_are : forall k a b x y, k = 2 \/ k = 4 -> all one a x -> all (two k) b y ->
  three (3 * k) (dot A a b) (dot exact x y).
Hypothesis last_sums_are : forall a b x y, three 12 a x -> three 6 b y -> three 18 (sum_of_three A a b) (x + y).
Theorem control_values_are kind words numbers :
  (forall n, (n < 8)%nat -> all coordinate (point words n) (point numbers n)) ->
  Forall2 (fun ws x => exists k, three k ws x) (control_values A kind words) (control_values exact kind numbers).
Proof.
  intro h.
  assert (e : forall at_, (at_ <= 4)%nat -> let '(b, c, p) := edges A kind words at_ in let '(vb, vc, vp) := edges
    exact kind numbers at_ in
    all one b vb /\ all one c vc /\ all one p vp).
  { assert (d : forall i j, (i < 8)%nat -> (j < 8)%nat -> all one (differences A (point words i) (point words j))
    (differences exact (point numbers i) (point numbers j))).
    { intros i j hi hj. destruct (h i hi) as (a & b & c). destruct (h j hj) as (a' & b' & c').
      split; [|split]; apply differences_are; assumption. }
    intros at_ le. destruct kind; (split; [|split]); apply d; lia. }
  unfold control_values. pose proof (e 0%nat ltac:(lia)) as e0. pose proof (e 4%nat ltac:(lia)) as e1.
  destruct (edges A kind words 0) as [[b0 c0] p0]. destruct (edges A kind words 4) as [[b1 c1] p1].
  destruct (edges exact kind numbers 0) as [[vb0 vc0] vp0]. destruct (edges exact kind numbers 4) as [[vb1 vc1] vp1].
  destruct e0 as (hb0 & hc0 & hp0). destruct e1 as (hb1 & hc1 & hp1).
  pose proof (crosses_are _ _ _ _ hb0 hc0) as n0. pose proof (crosses_are _ _ _ _ hb1 hc1) as n1.
  pose proof (sums_are _ _ _ _ (crosses_are _ _ _ _ hb0 hc1) (crosses_are _ _ _ _ hb1 hc0)) as hh.
  repeat constructor; eexists.
  - apply (dots_are 2); auto.
  - apply last_sums_are; [apply (dots_are 4)|apply (dots_are 2)]; auto.
  - apply last_sums_are; [apply (dots_are 4)|apply (dots_are 2)]; auto.
  - apply (dots_are 2); auto.
Qed.
End Widths.

(* Numbers of as many words as they need have no bounds. *)
Theorem space_is_exact kind words numbers : (forall n, (n < 8)%nat -> all holds (point words n) (point numbers n)) ->
  Forall2 holds (control_values space kind words) (control_values exact kind numbers).
Proof.
  intro h. assert (r : 1 <= 64) by lia.
  pose proof (control_values_are space holds holds (fun _ => holds) (fun _ => holds)) as C.
  assert (F : Forall2 (fun ws x => exists _ : Z, holds ws x) (control_values space kind words) (control_values exact
    kind numbers)).
  { apply C; try exact h.
    - intros a b x y ha hb. now apply minus_is.
    - intros a b x y (ax & ay & az) (bx & by_ & bz).
      split; [|split]; cbn [space cross exact by_operations x_ y_ z_]; now apply minor_is.
    - intros a b x y (ax & ay & az) (bx & by_ & bz). split; [|split]; now apply plus_is.
    - intros k a b x y _ (ax & ay & az) (bx & by_ & bz). now apply sum_of_products_is.
    - intros a b x y ha hb. now apply plus_is. }
  clear -F. induction F as [|ws x l l' [_ w] _ IH]; constructor; assumption.
Qed.

Section Fixed.
Variable n : nat.
Hypothesis some : (0 < n)%nat.
Notation m := (64 * Z.of_nat n - 2).
Notation square := (2 ^ m * 2 ^ m).
Let r64 : 1 <= 64. Proof. lia. Qed.
Lemma fits_one x : Z.abs x < 2 ^ m -> fits n x.
Proof.
  intro h. unfold Words.fits. assert (word ^ Z.of_nat n = 4 * 2 ^ m) as ->; [|lia].
  change word with (2 ^ 64). rewrite <- Z.pow_mul_r by lia. change 4 with (2 ^ 2). rewrite <- Z.pow_add_r by lia.
    f_equal. lia.
Qed.
Lemma fits_two x : Z.abs x <= 6 * square -> fits (n + n) x.
Proof. intro h. unfold Words.fits. pose proof (two_words_suffice (Z.of_nat n) ltac:(lia) x h) as w.
  replace (Z.of_nat (n + n)) with (2 * Z.of_nat n) by lia. exact w. Qed.
Lemma fits_three x : Z.abs x <= 18 * (2 ^ m * square) -> fits (n + (n + n)) x.
Proof. intro h. unfold Words.fits. pose proof (three_words_suffice (Z.of_nat n) ltac:(lia) x h) as w.
  replace (Z.of_nat (n + (n + n))) with (3 * Z.of_nat n) by lia. exact w. Qed.
Lemma square_pos : 0 < square. Proof. assert (0 < 2 ^ m) by (apply Z.pow_pos_nonneg; lia). now apply Z.mul_pos_pos. Qed.
Definition coordinate ws x := is n ws x /\ Z.abs x < 2 ^ (64 * Z.of_nat n - 3).
Definition one ws x := is n ws x /\ Z.abs x <= 2 ^ m.
Definition two k ws x := is (n + n) ws x /\ Z.abs x <= k * square.
Definition three k ws x := is (n + (n + n)) ws x /\ Z.abs x <= k * (2 ^ m * square).
Lemma room_for_dots k u v w : k = 2 \/ k = 4 -> Z.abs u <= 2 ^ m * (k * square) -> Z.abs v <= 2 ^ m * (k * square) ->
  Z.abs w <= 2 ^ m * (k * square) -> fits (n + (n + n)) u /\ fits (n + (n + n)) v /\ fits (n + (n + n)) w /\
  fits (n + (n + n)) (u + v) /\ fits (n + (n + n)) (u + v + w) /\ Z.abs (u + v + w) <= 3 * k * (2 ^ m * square).
Proof.
  intro k24. assert (c : 0 < 2 ^ m * square) by (apply Z.mul_pos_pos; [apply Z.pow_pos_nonneg; lia|apply square_pos]).
  replace (2 ^ m * (k * square)) with (k * (2 ^ m * square)) by ring. pose proof fits_three as F. revert F.
  set (S := 2 ^ m * square) in *. clearbody S. intros F a b d. destruct k24 as [-> | ->]; repeat split; try apply F;
    lia.
Qed.
Theorem fixed_is_exact kind words numbers : (forall i, (i < 8)%nat ->
  all coordinate (point words i) (point numbers i)) ->
  Forall2 (is (n + (n + n))) (control_values fixed kind words) (control_values exact kind numbers).
Proof.
  intro h. pose proof square_pos as sp. assert (p : 0 < 2 ^ m) by (apply Z.pow_pos_nonneg; lia).
  assert (cp : 0 < 2 ^ m * square) by (now apply Z.mul_pos_pos).
  pose proof (control_values_are fixed coordinate one two three) as C.
  assert (F : Forall2 (fun ws x => exists k, three k ws x) (control_values fixed kind words) (control_values exact kind
    numbers)).
  { apply C; try exact h.
    - intros a b x y [ha la] [hb lb]. pose proof (differences_have_room (Z.of_nat n) ltac:(lia) x y la lb).
      split; [|lia]. apply integer_minus_is; try assumption. now apply fits_one.
    - intros a b x y ([ax lax] & [ay lay] & [az laz]) ([bx lbx] & [by_ lby] & [bz lbz]).
      pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (y_ x) (z_ y) (z_ x) (y_ y) lay lbz laz lby).
      pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (z_ x) (x_ y) (x_ x) (z_ y) laz lbx lax lbz).
      pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (x_ x) (y_ y) (y_ x) (x_ y) lax lby lay lbx).
      pose proof (fun u v => product_below u v (2 ^ m) (2 ^ m)) as P.
      split; [|split]; (split; [|assumption]); cbn [cross fixed exact by_operations x_ y_ z_];
        apply integer_minus_is; try assumption; try (apply integer_times_is; assumption); apply fits_two; lia.
    - intros a b x y ([ax lax] & [ay lay] & [az laz]) ([bx lbx] & [by_ lby] & [bz lbz]).
      split; [|split]; cbn [sum fixed exact by_operations x_ y_ z_]; (split; [|lia]); apply integer_plus_is;
        try assumption;
        apply fits_two; lia.
    - intros k a b x y k24 ([ax lax] & [ay lay] & [az laz]) ([bx lbx] & [by_ lby] & [bz lbz]).
      pose proof (product_below _ _ _ _ lax lbx). pose proof (product_below _ _ _ _ lay lby).
        pose proof (product_below _ _ _ _ laz lbz).
      destruct (room_for_dots k _ _ _ k24 H H0 H1) as (f1 & f2 & f3 & f4 & f5 & bound).
      cbn [dot fixed exact by_operations]. split; [|exact bound].
      assert (T : forall u v i j, is n u i -> is (n + n) v j -> is (n + (n + n)) (integer_times 64 u v) (i * j)).
      { intros u v i j hu hv. exact (integer_times_is 64 r64 n (n + n) u v i j some ltac:(lia) hu hv). }
      exact (integer_plus_is 64 r64 _ _ _ _ _ (integer_plus_is 64 r64 _ _ _ _ _ (T _ _ _ _ ax bx) (T _ _ _ _ ay by_) f4)
        (T _ _ _ _ az bz) f5).
    - intros a b x y [ha la] [hb lb]. split; [|lia]. apply integer_plus_is; try assumption. apply fits_three. lia. }
  clear -F. induction F as [|ws x l l' [_ [w _]] _ IH]; constructor; assumption.
Qed.
End Fixed.

(* aligned.rs: a number apart, by its encoding alone. *)
Record scalar := Scalar { fraction_bits : Z; exponent_bits : Z }.
Definition single := Scalar 23 8.
Definition double := Scalar 52 11.
Definition bias s := 2 ^ (exponent_bits s - 1) - 1 + fraction_bits s.
Definition largest_field s := 2 ^ exponent_bits s - 1.
Definition largest_u32 := 2 ^ 32 - 1.
Record parts := Parts { significand : Z; exponent : Z; top : Z; is_finite : bool }.
Fixpoint trailing_zeros p := match p with xO p => 1 + trailing_zeros p | _ => 0 end.
Fixpoint odd_part p := match p with xO p => odd_part p | _ => p end.
Definition take_apart s encoding :=
  let field := encoding / 2 ^ fraction_bits s mod 2 ^ exponent_bits s in
  let is_negative := negb (encoding / 2 ^ (fraction_bits s + exponent_bits s) =? 0) in
  let is_normal := negb (field =? 0) in
  let exponent := Z.max field 1 in
  let fraction := encoding mod 2 ^ fraction_bits s in
  let magnitude := fraction + if is_normal then 2 ^ fraction_bits s else 0 in
  let '(odd, zeros) := match magnitude with Zpos p => (Zpos (odd_part p), trailing_zeros p) | _ => (0, 64) end in
  Parts (if is_negative then - odd else odd) (if magnitude =? 0 then largest_u32 else exponent + zeros)
    (exponent + fraction_bits s + 1) (negb (field =? largest_field s)).
(* `Axis`: the smallest exponent is the unit. *)
Definition unit terms := fold_right Z.min largest_u32 (map exponent terms).
Definition bits_of terms := Z.max 0 (fold_right Z.max 0 (map top terms) - unit terms).
Definition wrapping_sub x y := (x - y) mod 2 ^ 32.
Definition integers {T} (shifted : Z -> Z -> T) terms :=
  map (fun term => shifted (significand term) (wrapping_sub (exponent term) (unit terms))) terms.
Definition each {T U} (f : T -> U) v := Triple (f (x_ v)) (f (y_ v)) (f (z_ v)).
(* mod.rs and `Width`: the narrowest width that suffices; none if a coordinate is not finite. *)
Definition coordinates (shifted : Z -> Z -> list Z) axes := each (fun terms n => nth n (integers shifted terms) [])
  axes.
Definition signs kind axes :=
  let bits := Z.max (Z.max (bits_of (x_ axes)) (bits_of (y_ axes))) (bits_of (z_ axes)) in
  let by_fixed n := map (integer_sign 64) (control_values fixed kind (coordinates (integer_shifted 64 n) axes)) in
  if bits <=? 61 then by_fixed 1%nat else if bits <=? 125 then by_fixed 2%nat else if bits <=? 317 then by_fixed 5%nat
    else
  map (words_sign 64) (control_values space kind (coordinates (shifted 64) axes)).
Definition all_finite axes := forallb is_finite (x_ axes) && forallb is_finite (y_ axes) && forallb is_finite (z_ axes).
Definition control_value_signs s kind encodings :=
  let axes := each (map (take_apart s)) encodings in if all_finite axes then Some (signs kind axes) else None.

(* What encodings are, after `Narrowing.v`; the sign is the top bit. *)
Definition encoding_of s := Narrowing.Encoding (fraction_bits s) (bias s) (largest_field s * 2 ^ fraction_bits s).
Definition value s e : R := ((if e <? 2 ^ (fraction_bits s + exponent_bits s) then 1 else -1) *
  Narrowing.value (encoding_of s) (e mod 2 ^ (fraction_bits s + exponent_bits s)))%R.
Definition is_encoding s e := 0 <= e < 2 ^ (fraction_bits s + exponent_bits s + 1).
Definition reasonable s := 1 <= fraction_bits s <= 62 /\ 1 <= exponent_bits s <= 30.
Lemma odd_times p : Zpos p = Zpos (odd_part p) * 2 ^ trailing_zeros p /\ 0 <= trailing_zeros p.
Proof.
  induction p as [p _|p [IH pos]|]; try (cbn; lia). cbn [odd_part trailing_zeros]. rewrite Z.pow_add_r by lia.
  change (2 ^ 1) with 2. lia.
Qed.
(* A finite number is its significand times 2^exponent, less the bias; and it is below 2^top. *)
Theorem take_apart_is s e : reasonable s -> is_encoding s e -> let term := take_apart s e in is_finite term = true ->
  (value s e = IZR (significand term) * bpow radix2 (exponent term - bias s))%R /\
  Z.abs (significand term) < 2 ^ (fraction_bits s + 1) /\ 0 <= exponent term <= largest_u32 /\
  (significand term <> 0 -> Z.abs (significand term) * 2 ^ exponent term < 2 ^ top term).
Proof.
  intros [rf re] he term. unfold is_encoding in he. subst term. unfold take_apart.
  set (fb := fraction_bits s) in *. set (eb := exponent_bits s) in *.
  assert (F : 0 < 2 ^ fb) by (apply Z.pow_pos_nonneg; lia). assert (E : 0 < 2 ^ eb) by (apply Z.pow_pos_nonneg; lia).
  assert (FE : 2 ^ (fb + eb) = 2 ^ fb * 2 ^ eb) by (apply Z.pow_add_r; lia).
  set (field := e / 2 ^ fb mod 2 ^ eb). set (fraction := e mod 2 ^ fb).
  pose proof (Z.mod_pos_bound (e / 2 ^ fb) (2 ^ eb) E) as hf. fold field in hf.
  pose proof (Z.mod_pos_bound e (2 ^ fb) F) as hr. fold fraction in hr.
  assert (B : e mod 2 ^ (fb + eb) = fraction + 2 ^ fb * field) by (rewrite FE; apply Z.rem_mul_r; lia).
  assert (neg : negb (e / 2 ^ (fb + eb) =? 0) = negb (e <? 2 ^ (fb + eb))).
  { f_equal. apply eq_true_iff_eq. rewrite Z.eqb_eq, Z.ltb_lt. split; intro h.
    - pose proof (Z.div_mod e (2 ^ (fb + eb)) ltac:(lia)). pose proof (Z.mod_pos_bound e (2 ^ (fb + eb)) ltac:(lia)).
      nia.
    - apply Z.div_small. lia. }
  rewrite neg. set (m := fraction + _). assert (m0 : 0 <= m < 2 ^ (fb + 1)).
  { unfold m. rewrite Z.pow_add_r by lia. change (2 ^ 1) with 2. destruct (field =? 0); cbn [negb]; lia. }
  assert (V : Narrowing.value (encoding_of s) (e mod 2 ^ (fb + eb)) = (IZR m * bpow radix2 (Z.max field 1 - bias s))%R).
  { unfold Narrowing.value, encoding_of. cbn [Narrowing.bits Narrowing.offset]. fold fb. rewrite B.
    replace ((fraction + 2 ^ fb * field) / 2 ^ fb) with field by (symmetry;
      rewrite Z.mul_comm, Z.div_add, Z.div_small by lia; ring).
    replace ((fraction + 2 ^ fb * field) mod 2 ^ fb) with fraction by (rewrite Z.mul_comm, Z_mod_plus_full; symmetry;
      apply Z.mod_small; lia).
    unfold m. destruct (Z.eqb_spec field 0) as [->|n]; cbn [negb].
    - replace (fraction + 2 ^ fb * 0) with (fraction + 0) by ring. reflexivity.
    - rewrite Z.max_l by lia. now rewrite Z.add_comm. }
  intros _. unfold value. fold fb eb. rewrite V. clear V B. clearbody m.
  assert (big : 2 ^ eb <= 2 ^ 30) by (apply Z.pow_le_mono_r; lia).
  assert (out : forall z, (if negb (e <? 2 ^ (fb + eb)) then - z else z) = (if e <? 2 ^ (fb + eb) then 1 else -1) * z).
  { intro z. destruct (e <? _); cbn [negb]; ring. }
  destruct m as [|p|p]; [| |lia].
  - cbn [significand exponent top]. rewrite out, Z.mul_0_r. split; [rewrite !Rmult_0_l, Rmult_0_r; reflexivity|].
    split; [cbn; lia|]. cbn. split; [unfold largest_u32; lia|lia].
  - cbn [significand exponent top]. rewrite out. change (Zpos p =? 0) with false. cbn [exponent top].
    destruct (odd_times p) as [O Z0]. set (o := Zpos (odd_part p)) in *. assert (o0 : 0 < o) by reflexivity.
    set (z := trailing_zeros p) in *. assert (pz : 0 < 2 ^ z) by (apply Z.pow_pos_nonneg; lia).
    set (sign := if e <? _ then 1 else -1). assert (sg : Z.abs sign = 1) by (unfold sign; destruct (e <? _);
      reflexivity).
    assert (zb : z < fb + 1).
    { destruct (Z_lt_le_dec z (fb + 1)) as [l|g]; [exact l|].
      assert (2 ^ (fb + 1) <= 2 ^ z) by (apply Z.pow_le_mono_r; lia). nia. }
    split; [|split; [|split]].
    + rewrite O, !mult_IZR. unfold Z.sub. rewrite (Z.add_comm (Z.max field 1) z), <- Z.add_assoc, (bpow_plus radix2 z).
      rewrite <- (IZR_Zpower radix2 z) by lia. change (Z.pow radix2 z) with (2 ^ z).
      unfold sign. destruct (e <? _); ring.
    + rewrite Z.abs_mul, sg. nia.
    + unfold largest_u32. change (2 ^ 30) with 1073741824 in big. lia.
    + intros _. rewrite Z.abs_mul, sg, Z.mul_1_l, Z.abs_eq by lia.
      rewrite Z.add_comm, Z.pow_add_r, Z.mul_assoc, <- O by lia.
      replace (Z.max field 1 + fb + 1) with ((fb + 1) + Z.max field 1) by ring. rewrite (Z.pow_add_r 2 (fb + 1)) by lia.
      apply Z.mul_lt_mono_pos_r; [apply Z.pow_pos_nonneg; lia|lia].
Qed.

Definition numbers axes := each (fun terms n => nth n (integers (fun significand shift => significand * 2 ^ shift)
  terms) 0) axes.
Notation part terms n := (nth n terms (Parts 0 0 0 true)).
Notation shift_of terms n := (wrapping_sub (exponent (part terms n)) (unit terms)).
Notation number_of terms n := (significand (part terms n) * 2 ^ shift_of terms n).
Lemma nth_integers T (f : Z -> Z -> T) terms n d : (n < length terms)%nat ->
  nth n (integers f terms) d = f (significand (part terms n)) (shift_of terms n).
Proof.
  intro l. unfold integers. rewrite (nth_indep _ d (f 0 (wrapping_sub 0 (unit terms)))) by now rewrite map_length.
  exact (map_nth (fun term => f (significand term) (wrapping_sub (exponent term) (unit terms))) terms (Parts 0 0 0
    true) n).
Qed.
Definition fine term := Z.abs (significand term) < 2 ^ 63 /\ 0 <= exponent term <= largest_u32 /\
  (significand term <> 0 -> Z.abs (significand term) * 2 ^ exponent term < 2 ^ top term).
Lemma unit_is_least terms n : Forall fine terms -> (n < length terms)%nat -> 0 <= unit terms <= exponent (part terms n).
Proof.
  intro h. revert n. assert (low : forall terms, Forall fine terms -> 0 <= unit terms).
  { induction 1 as [|t ts ht _ IH]; unfold unit in *; cbn [map fold_right]; [unfold largest_u32; lia|].
    destruct ht as (_ & r & _). lia. }
  induction h as [|t ts ht hts IH]; intros n l; [cbn in l; lia|]. split; [now apply low; constructor|].
  destruct n as [|n]; unfold unit in *; cbn [nth map fold_right length] in *; [lia|]. specialize (IH n ltac:(lia)). lia.
Qed.
Lemma top_is_largest terms n : (n < length terms)%nat -> top (part terms n) <= fold_right Z.max 0 (map top terms).
Proof.
  revert n. induction terms as [|t ts IH]; intros n l; [cbn in l; lia|]. destruct n as [|n];
    cbn [nth map fold_right length] in *; [lia|].
  specialize (IH n ltac:(lia)). lia.
Qed.
Lemma number_is terms n : Forall fine terms -> (n < length terms)%nat ->
  Z.abs (number_of terms n) < 2 ^ bits_of terms /\
  - half 64 <= significand (part terms n) < half 64 /\ 0 <= shift_of terms n /\
  forall b, (IZR (significand (part terms n)) * bpow radix2 (exponent (part terms n) - b) = IZR (number_of terms n) *
    bpow radix2 (unit terms - b))%R.
Proof.
  intros h l. pose proof (unit_is_least terms n h l) as least. pose proof (top_is_largest terms n l) as largest.
  assert (ht : fine (part terms n)) by (rewrite Forall_forall in h; apply h, nth_In, l).
    destruct ht as (small & re & below).
  assert (shift : shift_of terms n = exponent (part terms n) - unit terms).
  { unfold wrapping_sub. apply Z.mod_small. unfold largest_u32 in re. lia. }
  rewrite shift. set (t := part terms n) in *. clearbody t. change (half 64) with (2 ^ 63).
  split; [|split; [lia|split; [lia|]]].
  - assert (0 < 2 ^ bits_of terms) by (apply Z.pow_pos_nonneg; [lia|unfold bits_of; lia]).
    destruct (Z.eq_dec (significand t) 0) as [->|n0]; [lia|]. specialize (below n0).
    set (highest := fold_right Z.max 0 (map top terms)) in *. rewrite Z.abs_mul.
    assert (p : 0 < 2 ^ (exponent t - unit terms)) by (apply Z.pow_pos_nonneg; lia). rewrite (Z.abs_eq (2 ^ _)) by lia.
    assert (E : 2 ^ exponent t = 2 ^ (exponent t - unit terms) * 2 ^ unit terms) by (rewrite <- Z.pow_add_r by lia;
      f_equal; lia).
    rewrite E, Z.mul_assoc in below. assert (U : 0 < 2 ^ unit terms) by (apply Z.pow_pos_nonneg; lia).
    set (v := Z.abs (significand t) * 2 ^ (exponent t - unit terms)) in *. assert (1 <= v) by (unfold v; nia).
    assert (T : 2 ^ top t <= 2 ^ highest).
    { destruct (Z_lt_le_dec (top t) 0) as [neg|]; [rewrite (Z.pow_neg_r 2 (top t) neg) in below;
      nia|apply Z.pow_le_mono_r; lia]. }
    assert (unit terms < highest).
    { destruct (Z_lt_le_dec (unit terms) highest) as [|g]; [assumption|]. exfalso.
      assert (2 ^ highest <= 2 ^ unit terms) by (apply Z.pow_le_mono_r; lia). nia. }
    unfold bits_of. fold highest. rewrite Z.max_r by lia.
    assert (H2 : 2 ^ highest = 2 ^ (highest - unit terms) * 2 ^ unit terms) by (rewrite <- Z.pow_add_r by lia;
      f_equal; lia).
    nia.
  - intro b. rewrite mult_IZR, Rmult_assoc. f_equal. change (2 ^ (exponent t - unit terms)) with (Z.pow radix2
    (exponent t - unit terms)).
    rewrite IZR_Zpower by lia. rewrite <- bpow_plus. f_equal. lia.
Qed.

(* The real control values, and what a sign says of one. *)
Definition real := by_operations Rplus Rminus Rmult.
Definition says x sign := match sign with Lt => (x < 0)%R | Eq => (x = 0)%R | Gt => (0 < x)%R end.
Definition reals s encodings := each (fun es n => value s (nth n es 0)) encodings.
Lemma difference_in_units a b u : (IZR a * u - IZR b * u = IZR (a - b) * u)%R.
Proof. rewrite minus_IZR. ring. Qed.
Lemma four_equal {T} (a b c d a' b' c' d' : T) : a = a' -> b = b' -> c = c' -> d = d' -> [a; b; c; d] = [a'; b'; c';
  d'].
Proof. now intros -> -> -> ->. Qed.
Lemma control_values_in_units kind v w ux uy uz : (forall n, (n < 8)%nat -> x_ v n = IZR (x_ w n) * ux /\
  y_ v n = IZR (y_ w n) * uy /\
  z_ v n = IZR (z_ w n) * uz)%R ->
  control_values real kind v = map (fun k => IZR k * (ux * uy * uz))%R (control_values exact kind w).
Proof.
  intro h. pose proof (h 0%nat ltac:(lia)) as (a0 & b0 & c0). pose proof (h 1%nat ltac:(lia)) as (a1 & b1 & c1).
  pose proof (h 2%nat ltac:(lia)) as (a2 & b2 & c2). pose proof (h 3%nat ltac:(lia)) as (a3 & b3 & c3).
  pose proof (h 4%nat ltac:(lia)) as (a4 & b4 & c4). pose proof (h 5%nat ltac:(lia)) as (a5 & b5 & c5).
  pose proof (h 6%nat ltac:(lia)) as (a6 & b6 & c6). pose proof (h 7%nat ltac:(lia)) as (a7 & b7 & c7). clear h.
  destruct kind; unfold control_values, edges, differences, point;
    cbn [Nat.add real exact by_operations difference cross sum dot sum_of_three x_ y_ z_];
    rewrite ?a0, ?b0, ?c0, ?a1, ?b1, ?c1, ?a2, ?b2, ?c2, ?a3, ?b3, ?c3, ?a4, ?b4, ?c4, ?a5, ?b5, ?c5, ?a6, ?b6, ?c6,
      ?a7, ?b7, ?c7;
    clear; cbn [map]; rewrite !difference_in_units;
    repeat match goal with |- context [?f w ?i - ?f w ?j] => generalize (f w i - f w j); intro end;
    apply four_equal; repeat rewrite ?plus_IZR, ?mult_IZR, ?minus_IZR; ring.
Qed.
Lemma says_in_units k u : (0 < u)%R -> says (IZR k * u) (k ?= 0).
Proof.
  intro pos. unfold says. destruct (Z.compare_spec k 0) as [->|n|n]; [ring|apply IZR_lt in n|apply IZR_lt in n]; nra.
Qed.
Lemma words_say words numbers (sign : list Z -> comparison) (good : list Z -> Z -> Prop) : (forall ws x, good ws x ->
  sign ws = (x ?= 0)) ->
  Forall2 good words numbers -> map sign words = map (fun x => x ?= 0) numbers.
Proof. intros h F. induction F as [|ws x l l' w _ IH]; [reflexivity|]. cbn [map]. now rewrite IH, (h ws x w). Qed.
Definition eight_are {T} (good : T -> Prop) axis := length axis = 8%nat /\ Forall good axis.
Definition each_is {T} (good : T -> Prop) v := good (x_ v) /\ good (y_ v) /\ good (z_ v).
Lemma signs_are kind axes : each_is (eight_are fine) axes ->
  signs kind axes = map (fun x => x ?= 0) (control_values exact kind (numbers axes)).
Proof.
  intros (hx & hy & hz). assert (r64 : 1 <= 64) by lia. unfold signs.
  set (bits := Z.max (Z.max (bits_of (x_ axes)) (bits_of (y_ axes))) (bits_of (z_ axes))).
  assert (F : forall n, (0 < n)%nat -> bits <= 64 * Z.of_nat n - 3 ->
    map (integer_sign 64) (control_values fixed kind (coordinates (integer_shifted 64 n) axes)) =
      map (fun x => x ?= 0) (control_values exact kind (numbers axes))).
  { intros n n0 le. apply words_say with (good := is (n + (n + n))).
    - intros ws x [[_ w] <-]. now apply integer_sign_is.
    - apply fixed_is_exact; [exact n0|]. intros i i8.
      assert (C : forall terms, eight_are fine terms -> bits_of terms <= bits ->
        coordinate n (nth i (integers (integer_shifted 64 n) terms) []) (nth i (integers (fun s k => s * 2 ^ k) terms)
          0)).
      { intros terms [l h] b. rewrite !nth_integers by lia. destruct (number_is terms i h ltac:(lia)) as (small & s64 &
        s0 & _).
        assert (less : Z.abs (number_of terms i) < 2 ^ (64 * Z.of_nat n - 3)).
        { eapply Z.lt_le_trans; [exact small|]. apply Z.pow_le_mono_r; lia. }
        split; [|exact less]. apply integer_shifted_is; try assumption. apply (fits_one n n0).
        eapply Z.lt_le_trans; [exact less|]. apply Z.pow_le_mono_r; lia. }
      split; [|split]; apply C; try assumption; unfold bits; lia. }
  assert (S : map (words_sign 64) (control_values space kind (coordinates (shifted 64) axes)) =
    map (fun x => x ?= 0) (control_values exact kind (numbers axes))).
  { apply words_say with (good := holds).
    - intros ws x (a & b & <-). now apply words_sign_is.
    - apply space_is_exact. intros i i8.
      assert (C : forall terms, eight_are fine terms -> holds (nth i (integers (shifted 64) terms) []) (nth i (integers
        (fun s k => s * 2 ^ k) terms) 0)).
      { intros terms [l h]. rewrite !nth_integers by lia. destruct (number_is terms i h ltac:(lia)) as (_ & s64 & s0 &
        _).
        now apply shifted_is. }
      split; [|split]; apply C; assumption. }
  destruct (Z.leb_spec bits 61); [apply F; lia|]. destruct (Z.leb_spec bits 125); [apply F; lia|].
  destruct (Z.leb_spec bits 317); [apply F; lia|]. exact S.
Qed.
(* The signs are those of the real control values of any encodings that are finite; there are some for such. *)
Theorem control_value_signs_are s kind encodings found : reasonable s ->
  each_is (eight_are (is_encoding s)) encodings ->
  control_value_signs s kind encodings = Some found -> Forall2 says (control_values real kind (reals s encodings))
    found.
Proof.
  intros hs he. unfold control_value_signs. destruct (all_finite _) eqn:finite; [|discriminate]. intro E.
    injection E as <-.
  unfold all_finite in finite. apply andb_true_iff in finite as [finite fz]. apply andb_true_iff in finite as [fx fy].
  set (axes := each (map (take_apart s)) encodings) in *.
  assert (G : forall es, eight_are (is_encoding s) es -> forallb is_finite (map (take_apart s) es) = true ->
    eight_are fine (map (take_apart s) es) /\ forall n, (n < 8)%nat -> value s (nth n es 0) =
      (IZR (nth n (integers (fun s k => (s * 2 ^ k)%Z) (map (take_apart s) es)) 0%Z) * bpow radix2 (unit (map
        (take_apart s) es) - bias s))%R).
  { intros es [l h] f. rewrite forallb_forall in f. rewrite Forall_forall in h.
    assert (A : forall e, List.In e es -> let term := take_apart s e in (value s e = IZR (significand term) * bpow
      radix2 (exponent term - bias s))%R /\ fine term).
    { intros e i. destruct (take_apart_is s e hs (h e i) (f _ (in_map _ _ _ i))) as (a & b & c & d). split; [exact a|].
      split; [|split; assumption]. eapply Z.lt_le_trans; [exact b|]. destruct hs. apply Z.pow_le_mono_r; lia. }
    assert (F : Forall fine (map (take_apart s) es)).
    { apply Forall_forall. intros t i. apply in_map_iff in i as (e & <- & i). apply (A e i). }
    split; [split; [now rewrite map_length|exact F]|]. intros n n8.
    rewrite nth_integers by (rewrite map_length; lia).
    destruct (number_is (map (take_apart s) es) n F ltac:(rewrite map_length; lia)) as (_ & _ & _ & same).
      rewrite <- same.
    rewrite (nth_indep _ (Parts 0 0 0 true) (take_apart s 0)) by (rewrite map_length; lia). rewrite map_nth.
    apply A, nth_In. lia. }
  destruct he as (ex & ey & ez). destruct (G _ ex fx) as [gx vx]. destruct (G _ ey fy) as [gy vy].
    destruct (G _ ez fz) as [gz vz].
  rewrite signs_are by (split; [exact gx|split; [exact gy|exact gz]]).
  rewrite (control_values_in_units kind (reals s encodings) (numbers axes) (bpow radix2 (unit (x_ axes) - bias s))
    (bpow radix2 (unit (y_ axes) - bias s)) (bpow radix2 (unit (z_ axes) - bias s))).
  2:{ intros n n8. split; [|split]; [exact (vx n n8)|exact (vy n n8)|exact (vz n n8)]. }
  set (u := (_ * _ * _)%R). assert (pos : (0 < u)%R) by (unfold u; repeat apply Rmult_lt_0_compat; apply bpow_gt_0).
  clearbody u. generalize (control_values exact kind (numbers axes)). intro l. induction l as [|k l IH]; constructor;
    [|exact IH].
  now apply says_in_units.
Qed.
