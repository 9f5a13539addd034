(* Whole numbers in words, in two's complement, the lowest word first: the functions of core/src/kernels/exact/integer
  on
   lists of words, under their names and in their shape. A word has `bits` bits, which are 64 in the code.
     `Sampled.v` has
   what the code returns, and `Samples.v` computes the same with the functions of this file. *)
From Coq Require Import ZArith Lia List Bool.
Import ListNotations.
Open Scope Z_scope.

Section Words.
Variable bits : Z.
Hypothesis some_bits : 1 <= bits.
Definition word := 2 ^ bits.
Definition half := 2 ^ (bits - 1).
Definition is_word w := 0 <= w < word.
Lemma half_pos : 1 <= half. Proof. unfold half. pose proof (Z.pow_pos_nonneg 2 (bits - 1)). lia. Qed.
Lemma two_halves : word = 2 * half.
Proof. unfold word, half. replace bits with (1 + (bits - 1)) at 1 by ring. rewrite Z.pow_add_r by lia. reflexivity. Qed.

(* The number that words are: without a sign, and with one. *)
Fixpoint natural ws := match ws with [] => 0 | w :: rest => w + word * natural rest end.
Definition modulus (ws : list Z) := word ^ Z.of_nat (length ws).
Definition is_negative ws := half <=? last ws 0.
Definition signed ws := natural ws - if is_negative ws then modulus ws else 0.
Definition words_of n ws := length ws = n /\ Forall is_word ws.
Definition fits n x := - word ^ Z.of_nat n <= 2 * x < word ^ Z.of_nat n.

(* limbs.rs. *)
(* z mod word and z / word mod word, as `halves_are` says; Coq computes these faster. *)
Definition low_word z := Z.land z (Z.ones bits).
Definition halves z := (low_word z, low_word (Z.shiftr z bits)).
Definition overflowing_add x y := (low_word (x + y), word <=? x + y).
Definition overflowing_sub x y := (low_word (x - y), x <? y).
Definition add_with_carry x y carry :=
  let '(partial, first) := overflowing_add x y in
  let '(whole, second) := overflowing_add partial (Z.b2z carry) in (whole, first || second).
Definition subtract_with_borrow x y borrow :=
  let '(partial, first) := overflowing_sub x y in
  let '(whole, second) := overflowing_sub partial (Z.b2z borrow) in (whole, first || second).
Definition sign_word ws := if half <=? last ws 0 then word - 1 else 0.
Fixpoint add_words a b carry := match a, b with
  | x :: a, y :: b => let '(w, carry) := add_with_carry x y carry in
      let '(ws, carry) := add_words a b carry in (w :: ws, carry)
  | _, _ => ([], carry) end.
Fixpoint subtract_words from other (mask : bool) borrow := match other, from with
  | y :: other, x :: from => let '(w, borrow) := subtract_with_borrow x (if mask then y else 0) borrow in
      w :: subtract_words from other mask borrow
  | _, _ => from end.
Definition subtract from other mask := subtract_words from other mask false.
Definition write_shifted n significand shift :=
  let first := shift / bits in let '(low, high) := halves (significand * 2 ^ (shift mod bits)) in
  map (fun i => let i := Z.of_nat i in if i <? first then 0 else if i =? first then low else if i =? first + 1 then high
    else if significand <? 0 then word - 1 else 0) (seq 0 n).
(* Groups of eight first. `n` is at least the count of words, which the loops use up. *)
Fixpoint without_eights n ws := match n with O => ws | S n =>
  if (length ws <? 8)%nat then ws else
  let below := firstn (length ws - 8) ws in let eight := skipn (length ws - 8) ws in
  if forallb (Z.eqb (sign_word below)) eight then without_eights n below else ws end.
Fixpoint without_ones n ws := match n, ws with O, _ | _, [] => ws | S n, _ =>
  let below := removelast ws in if last ws 0 =? sign_word below then without_ones n below else ws end.
Definition without_repeated_sign ws := without_ones (length ws) (without_eights (length ws) ws).
Fixpoint without_zeros_below ws := match ws with
  | [] => (0%nat, [])
  | w :: rest => if w =? 0 then let '(zeros, above) := without_zeros_below rest in (S zeros, above) else (0%nat, ws)
    end.
(* A row of a product: the first one, and one on what the rows before have left. *)
Fixpoint first_row x b carry := match b with
  | [] => ([], carry)
  | y :: b => let '(w, carry) := halves (x * y + carry) in let '(ws, carry) := first_row x b carry in (w :: ws, carry)
    end.
Fixpoint row x b before carry := match b, before with
  | y :: b, w :: before => let '(w, carry) := halves (x * y + w + carry) in
      let '(ws, carry) := row x b before carry in (w :: ws, carry)
  | _, _ => ([], carry) end.
(* `product` is the code's from the row's lowest word on. *)
Definition with_carry '((ws, carry) : list Z * Z) (above : list Z) := ws ++ match above with [] => [] | _ :: above =>
  carry :: above end.
Fixpoint rows a b product := match a with
  | [] => product
  | x :: a => match with_carry (row x b (firstn (length b) product) 0) (skipn (length b) product) with
      | [] => [] | low :: rest => low :: rows a b rest end end.
Definition multiply a b product := match a with
  | [] => product
  | x :: a => match with_carry (first_row x b 0) (skipn (length b) product) with
      | [] => [] | low :: rest => low :: rows a b rest end end.
Definition subtract_at k product other mask := firstn k product ++ subtract (skipn k product) other mask.
Definition product_with_signs a b product :=
  let product := multiply a b product in
  let product := subtract_at (length a) product b (is_negative a) in
  subtract_at (length b) product a (is_negative b).
Definition is_empty (ws : list Z) := match ws with [] => true | _ => false end.
Definition multiply_significant_words a b product :=
  let '(zeros_of_a, a) := without_zeros_below (without_repeated_sign a) in
  let '(zeros_of_b, b) := without_zeros_below (without_repeated_sign b) in
  if is_empty a || is_empty b then map (fun _ => 0) product else
  let zeros := (zeros_of_a + zeros_of_b)%nat in
  let below := map (fun _ => 0) (firstn zeros product) in
  let rest := skipn zeros product in
  let above := skipn (length a + length b) rest in
  let product := product_with_signs a b (firstn (length a + length b) rest) in
  below ++ product ++ map (fun _ => sign_word product) above.

(* mod.rs: numbers of a fixed width. *)
Definition cast_signed w := if half <=? w then w - word else w.
Definition integer_shifted n significand shift := if (n =? 1)%nat then [(significand * 2 ^ (shift mod bits)) mod word]
  else write_shifted n significand shift.
Definition integer_plus a b := fst (add_words a b false).
Definition integer_minus a b := subtract a b true.
Definition integer_times a b := match a, b with
  | [a], [b] => let '(low, high) := halves (cast_signed a * cast_signed b) in [low; high]
  | [a], [b0; b1] => let a := cast_signed a in let below := a * b0 in
      let above := a * cast_signed b1 + Z.shiftr below bits in let '(middle, high) := halves above in [low_word below;
        middle; high]
  | _, _ => let product := repeat 0 (length a + length b) in
      if (2 <? length a)%nat then multiply_significant_words a b product else product_with_signs a b product end.
Definition integer_sign ws := if is_negative ws then Lt else if forallb (Z.eqb 0) ws then Eq else Gt.

(* words.rs and space.rs: numbers of as many words as they need. *)
Definition words_sign ws := match ws with [] => Eq | _ => if is_negative ws then Lt else Gt end.
Definition single ws := match ws with [] => Some 0 | [w] => Some (cast_signed w) | _ => None end.
Definition small ws := match ws with
  | [low; high] => let z := high * word + low in Some (if half * word <=? z then z - word * word else z)
  | _ => single ws end.
Definition in_double z := (- (half * word) <=? z) && (z <? half * word).
Definition shifted significand shift := if significand =? 0 then [] else
  let '(low, high) := halves (significand * 2 ^ (shift mod bits)) in
  without_repeated_sign (repeat 0 (Z.to_nat (shift / bits)) ++ [low; high]).
Definition double z := let '(low, high) := halves z in
  firstn (if z =? 0 then 0 else if z =? cast_signed low then 1 else 2) [low; high].
Definition complement (mask : bool) w := if mask then word - 1 - w else w.
Definition sum a b mask :=
  let '(long, long_mask, short, short_mask) := if (length b <=? length a)%nat then (a, false, b, mask) else
    (b, mask, a, false) in
  let n := length short in
  let long := (map (complement long_mask) long, complement long_mask (sign_word long)) in
  let short := (map (complement short_mask) short, complement short_mask (sign_word short)) in
  let '(below, carry) := add_words (firstn n (fst long)) (fst short) mask in
  let '(above, carry) := add_words (skipn n (fst long)) (map (fun _ => snd short) (skipn n (fst long))) carry in
  without_repeated_sign (below ++ above ++ [fst (add_with_carry (snd long) (snd short) carry)]).
Definition plus a b := match small a, small b with
  | Some x, Some y => if in_double (x + y) then double (x + y) else sum a b false
  | _, _ => sum a b false end.
Definition minus a b := match small a, small b with
  | Some x, Some y => if in_double (x - y) then double (x - y) else sum a b true
  | _, _ => sum a b true end.
Definition negated a := minus [] a.
Definition doubled a := plus a a.
Definition tripled a := plus (doubled a) a.
Definition times a b := match a, b with
  | [], _ | _, [] => []
  | [x], [y] => double (cast_signed x * cast_signed y)
  | _, _ => without_repeated_sign (multiply_significant_words a b (repeat 0 (length a + length b))) end.
Definition sum_of_products a b c d e f := plus (plus (times a b) (times c d)) (times e f).
Definition minor a b c d := match single a, single b, single c, single d with
  | Some a, Some b, Some c, Some d => double (a * d - b * c)
  | _, _, _, _ => minus (times a d) (times b c) end.
Definition width z := if z =? 0 then 0 else Z.log2 z + 1.
Definition count_bits ws := match ws with [] => 0 | _ =>
  bits * Z.of_nat (length ws) - (bits - width (complement (is_negative ws) (last ws 0))) end.
Definition word_above ws dropped := let first := Z.to_nat (dropped / bits) in
  (nth (S first) ws (sign_word ws) * word + nth first ws (sign_word ws)) / 2 ^ (dropped mod bits) mod word.

(* What words are. *)
Lemma low_word_is z : low_word z = z mod word.
Proof. apply Z.land_ones. lia. Qed.
Lemma halves_are z : halves z = (z mod word, (z / word) mod word).
Proof. unfold halves. rewrite !low_word_is, Z.shiftr_div_pow2 by lia. reflexivity. Qed.
Lemma word_pos n : 0 < word ^ Z.of_nat n.
Proof. pose proof half_pos. pose proof two_halves. apply Z.pow_pos_nonneg; lia. Qed.
Lemma word_succ n : word ^ Z.of_nat (S n) = word * word ^ Z.of_nat n.
Proof. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. reflexivity. Qed.
Lemma word_sum n m : word ^ Z.of_nat (n + m) = word ^ Z.of_nat n * word ^ Z.of_nat m.
Proof. rewrite Nat2Z.inj_add, Z.pow_add_r by lia. reflexivity. Qed.
Lemma modulus_of n ws : words_of n ws -> modulus ws = word ^ Z.of_nat n.
Proof. intros [<- _]. reflexivity. Qed.
Lemma modulus_cons w ws : modulus (w :: ws) = word * modulus ws.
Proof. apply word_succ. Qed.
Lemma modulus_app a b : modulus (a ++ b) = modulus a * modulus b.
Proof. unfold modulus. rewrite app_length. apply word_sum. Qed.
Lemma modulus_one w : modulus [w] = word. Proof. unfold modulus. cbn [length]. change (Z.of_nat 1) with 1. ring. Qed.
Lemma modulus_pos ws : 0 < modulus ws. Proof. apply word_pos. Qed.
Lemma a_remainder_is_a_word x : is_word (x mod word).
Proof. apply Z.mod_pos_bound. pose proof half_pos. pose proof two_halves. lia. Qed.
Lemma natural_range ws : Forall is_word ws -> 0 <= natural ws < modulus ws.
Proof.
  induction 1 as [|w ws hw _ IH]; [cbn; unfold modulus; cbn; lia|]. rewrite modulus_cons. cbn [natural].
  unfold is_word in hw. nia.
Qed.
Lemma natural_app a b : natural (a ++ b) = natural a + modulus a * natural b.
Proof.
  induction a as [|w a IH]; [unfold modulus; cbn [app natural length Z.of_nat]; rewrite Z.pow_0_r; ring|].
  rewrite modulus_cons. cbn [app natural]. rewrite IH. ring.
Qed.
Lemma words_cons n w ws : words_of (S n) (w :: ws) <-> is_word w /\ words_of n ws.
Proof.
  split.
  - intros [l h]. inversion h; subst. injection l as l. repeat split; assumption || apply H1.
  - intros [hw [l h]]. split; [cbn [length]; now rewrite l|now constructor].
Qed.
Lemma words_app n m a b : words_of n a -> words_of m b -> words_of (n + m) (a ++ b).
Proof. intros [la ha] [lb hb]. split; [rewrite app_length; lia|now apply Forall_app]. Qed.
Lemma words_split n m ws : words_of (n + m) ws -> words_of n (firstn n ws) /\ words_of m (skipn n ws).
Proof.
  intros [l h]. rewrite <- (firstn_skipn n ws) in h. apply Forall_app in h as [h1 h2].
  split; split; try assumption; [rewrite firstn_length|rewrite skipn_length]; lia.
Qed.
Lemma words_top ws : ws <> [] -> Forall is_word ws -> exists below top, ws = below ++ [top] /\ Forall is_word below /\
  is_word top.
Proof.
  intros some h. destruct (exists_last some) as (below & top & ->). apply Forall_app in h as [a b].
  exists below, top. inversion b; auto.
Qed.
Lemma last_app (a b : list Z) d : b <> [] -> last (a ++ b) d = last b d.
Proof.
  intro some. destruct (exists_last some) as (below & top & ->). rewrite app_assoc, !last_last. reflexivity.
Qed.
Theorem signed_app a b : b <> [] -> signed (a ++ b) = natural a + modulus a * signed b.
Proof.
  intro some. unfold signed, is_negative. rewrite last_app by assumption. rewrite natural_app, modulus_app.
  destruct (_ <=? _); ring.
Qed.
Lemma signed_one w : signed [w] = cast_signed w.
Proof.
  unfold signed, is_negative, cast_signed, modulus. cbn [last natural length]. change (Z.of_nat 1) with 1.
  rewrite Z.pow_1_r. destruct (_ <=? _); ring.
Qed.
Lemma cast_range w : is_word w -> - half <= cast_signed w < half.
Proof. pose proof two_halves. unfold is_word, cast_signed. destruct (Z.leb_spec half w); lia. Qed.
Lemma signed_nil : signed [] = 0.
Proof. unfold signed, is_negative, modulus. cbn [last natural length]. pose proof half_pos.
  destruct (Z.leb_spec half 0); lia. Qed.
Theorem signed_fits n ws : words_of n ws -> fits n (signed ws).
Proof.
  intros h. unfold fits. rewrite <- (modulus_of n ws h). destruct h as [_ h]. destruct ws as [|w ws].
  { rewrite signed_nil. unfold modulus. cbn. lia. }
  destruct (words_top (w :: ws) ltac:(discriminate) h) as (below & top & -> & hb & ht).
  rewrite signed_app, signed_one, modulus_app by discriminate. rewrite modulus_one.
  pose proof (natural_range below hb).
  pose proof (cast_range top ht). pose proof two_halves. pose proof half_pos. nia.
Qed.
Lemma signed_same n ws : words_of n ws -> exists k, natural ws = signed ws + word ^ Z.of_nat n * k.
Proof.
  intro h. unfold signed. rewrite (modulus_of n ws h). destruct (is_negative ws); [exists 1|exists 0]; ring.
Qed.
(* A number that fits is the only one with its remainder, so a result that is right up to multiples of the modulus, and
   fits, is right. *)
Theorem what_fits_is_exact M a b : 0 < M -> - M <= 2 * a < M -> - M <= 2 * b < M -> a mod M = b mod M -> a = b.
Proof.
  intros pos ha hb same. pose proof (Z.div_mod a M ltac:(lia)) as da. pose proof (Z.div_mod b M ltac:(lia)) as db.
  rewrite same in da. assert (a - b = M * (a / M - b / M)) by lia.
  assert (-1 < a / M - b / M < 1) by nia. assert (a / M - b / M = 0) as z by lia. rewrite z in H. lia.
Qed.
Theorem right_if_it_fits n ws x k : words_of n ws -> fits n x -> natural ws = x + word ^ Z.of_nat n * k ->
  signed ws = x.
Proof.
  intros h fx E. destruct (signed_same n ws h) as [j E'].
  apply (what_fits_is_exact (word ^ Z.of_nat n)); [apply word_pos|exact (signed_fits n ws h)|exact fx|].
  replace (signed ws) with (x + (k - j) * word ^ Z.of_nat n) by lia. apply Z_mod_plus_full.
Qed.
Lemma is_negative_iff ws : Forall is_word ws -> is_negative ws = (signed ws <? 0).
Proof.
  intro h. destruct ws as [|w ws].
  { rewrite signed_nil. unfold is_negative. cbn [last]. pose proof half_pos. apply Z.leb_gt. lia. }
  destruct (words_top (w :: ws) ltac:(discriminate) h) as (below & top & -> & hb & ht).
  rewrite signed_app, signed_one by discriminate. unfold is_negative. rewrite last_last.
  pose proof (natural_range below hb). pose proof (modulus_pos below). unfold cast_signed, is_word in *.
  pose proof two_halves. symmetry. destruct (Z.leb_spec half top); [apply Z.ltb_lt|apply Z.ltb_ge]; nia.
Qed.

(* Words above that repeat the sign, and zeros below. *)
Lemma zeros_are_words n : words_of n (repeat 0 n) /\ natural (repeat 0 n) = 0.
Proof.
  induction n as [|n [h E]]; [split; [split; [reflexivity|constructor]|reflexivity]|]. cbn [repeat natural]. rewrite E.
  split; [|ring]. apply words_cons. split; [|exact h]. unfold is_word. pose proof half_pos. pose proof two_halves. lia.
Qed.
Lemma ones_are_words n : words_of n (repeat (word - 1) n) /\ natural (repeat (word - 1) n) = word ^ Z.of_nat n - 1.
Proof.
  induction n as [|n [h E]]; [split; [split; [reflexivity|constructor]|reflexivity]|]. cbn [repeat natural].
  rewrite E, word_succ. split; [|ring]. apply words_cons. split; [|exact h].
  unfold is_word. pose proof half_pos. pose proof two_halves. lia.
Qed.
Lemma last_repeat (w : Z) n d : last (repeat w (S n)) d = w.
Proof. replace (S n) with (n + 1)%nat by lia. rewrite repeat_app. apply last_last. Qed.
Lemma signs_are_words ws n : words_of n (repeat (sign_word ws) n).
Proof. unfold sign_word. destruct (_ <=? _); [apply ones_are_words|apply zeros_are_words]. Qed.
Theorem a_repeated_sign_changes_nothing ws n : signed (ws ++ repeat (sign_word ws) n) = signed ws.
Proof.
  destruct n as [|n]; [now rewrite app_nil_r|]. rewrite signed_app by discriminate.
  assert (E : signed (repeat (sign_word ws) (S n)) = if is_negative ws then -1 else 0).
  { pose proof half_pos. pose proof two_halves. unfold signed, is_negative, modulus. rewrite last_repeat, repeat_length.
    unfold sign_word. destruct (half <=? last ws 0).
    - rewrite (proj2 (ones_are_words (S n))). replace (half <=? word - 1) with true by (symmetry; apply Z.leb_le;
      lia). ring.
    - rewrite (proj2 (zeros_are_words (S n))). replace (half <=? 0) with false by (symmetry; apply Z.leb_gt; lia).
      ring. }
  rewrite E. unfold signed. destruct (is_negative ws); ring.
Qed.
Definition is_minimal ws := ws = [] \/ last ws 0 <> sign_word (removelast ws).
Lemma all_same (s : Z) ws : forallb (Z.eqb s) ws = true -> ws = repeat s (length ws).
Proof.
  induction ws as [|w ws IH]; [reflexivity|]. cbn [forallb length repeat]. intro h. apply andb_true_iff in h as [a b].
  apply Z.eqb_eq in a as <-. now rewrite <- IH.
Qed.
Lemma without_eights_is n ws : Forall is_word ws -> Forall is_word (without_eights n ws) /\
  signed (without_eights n ws) = signed ws /\ (length (without_eights n ws) <= length ws)%nat.
Proof.
  revert ws. induction n as [|n IH]; intros ws h; [auto|]. cbn [without_eights].
  destruct (length ws <? 8)%nat; [auto|]. set (k := (length ws - 8)%nat).
  destruct (forallb _ _) eqn:same; [|auto]. apply all_same in same. pose proof (firstn_skipn k ws) as E.
  rewrite <- E in h. apply Forall_app in h as [h _]. destruct (IH _ h) as (a & b & c). split; [exact a|].
  split; [|rewrite firstn_length in c; lia]. rewrite b. rewrite <- E at 2. rewrite same. symmetry.
  apply a_repeated_sign_changes_nothing.
Qed.
Lemma without_ones_is n ws : Forall is_word ws -> Forall is_word (without_ones n ws) /\
  signed (without_ones n ws) = signed ws /\ ((length ws <= n)%nat -> is_minimal (without_ones n ws)).
Proof.
  revert ws. induction n as [|n IH]; intros ws h; destruct ws as [|w ws];
    try (split; [exact h|split; [reflexivity|intro l; now left]]).
  cbn [without_ones]. destruct (words_top (w :: ws) ltac:(discriminate) h) as (below & top & E & hb & _).
  rewrite E, removelast_last, last_last. destruct (Z.eqb_spec top (sign_word below)) as [same|other].
  - destruct (IH below hb) as (a & b & c). split; [exact a|]. split.
    + rewrite b, same. symmetry. exact (a_repeated_sign_changes_nothing below 1).
    + intro l. apply c. rewrite app_length in l. cbn in l. lia.
  - rewrite <- E. split; [exact h|]. split; [reflexivity|]. intros _. right. now rewrite E, removelast_last, last_last.
Qed.
Theorem without_repeated_sign_is ws : Forall is_word ws -> Forall is_word (without_repeated_sign ws) /\
  signed (without_repeated_sign ws) = signed ws /\ is_minimal (without_repeated_sign ws).
Proof.
  intro h. unfold without_repeated_sign. destruct (without_eights_is (length ws) ws h) as (a & b & c).
  destruct (without_ones_is (length ws) _ a) as (d & e & f). split; [exact d|]. split; [now rewrite e|exact (f c)].
Qed.
Lemma without_zeros_below_is ws : let '(zeros, above) := without_zeros_below ws in ws = repeat 0 zeros ++ above.
Proof.
  induction ws as [|w ws IH]; [reflexivity|]. cbn [without_zeros_below]. destruct (Z.eqb_spec w 0) as [->|];
    [|reflexivity].
  destruct (without_zeros_below ws) as [zeros above]. cbn [repeat app]. now rewrite <- IH.
Qed.
Lemma signed_zeros n : signed (repeat 0 n) = 0.
Proof.
  unfold signed. rewrite (proj2 (zeros_are_words n)). replace (is_negative (repeat 0 n)) with false; [ring|].
  symmetry. unfold is_negative. pose proof half_pos. destruct n; [apply Z.leb_gt; cbn; lia|]. rewrite last_repeat.
  apply Z.leb_gt. lia.
Qed.
(* Whether all words are zero, or none above the sign's is another. *)
Theorem words_sign_is ws : Forall is_word ws -> is_minimal ws -> words_sign ws = (signed ws ?= 0).
Proof.
  intros h m. destruct ws as [|w ws]; [now rewrite signed_nil|]. unfold words_sign.
  rewrite (is_negative_iff _ h). symmetry. destruct (Z.ltb_spec (signed (w :: ws)) 0) as [n|n]; [exact n|].
  apply Z.compare_gt_iff. destruct m as [m|m]; [discriminate|].
  destruct (words_top (w :: ws) ltac:(discriminate) h) as (below & top & E & hb & ht). rewrite E in *.
  rewrite removelast_last, last_last in m. rewrite signed_app, signed_one in * by discriminate.
  pose proof (natural_range below hb) as r. pose proof (modulus_pos below). pose proof (is_negative_iff below hb) as s.
  unfold sign_word in m. fold (is_negative below) in m. unfold is_word in ht. pose proof two_halves.
  unfold cast_signed in *. destruct (Z.leb_spec half top); [nia|]. assert (top = 0 \/ 0 < top) as [->|] by lia; [|nia].
  destruct (is_negative below) eqn:E2; [|lia]. unfold signed in s. rewrite E2 in s.
  assert (natural below <> 0); [|lia]. intro z. symmetry in s. apply Z.ltb_lt in s.
  unfold is_negative in E2. apply Z.leb_le in E2. destruct below as [|x below]; [cbn in E2; pose proof half_pos; lia|].
  destruct (words_top (x :: below) ltac:(discriminate) hb) as (b2 & t2 & E3 & hb2 & ht2). rewrite E3 in *.
  rewrite last_last in E2. rewrite natural_app in z. cbn [natural] in z. pose proof (natural_range b2 hb2).
  pose proof (modulus_pos b2). pose proof half_pos. nia.
Qed.
Theorem integer_sign_is ws : Forall is_word ws -> integer_sign ws = (signed ws ?= 0).
Proof.
  intro h. unfold integer_sign. rewrite (is_negative_iff _ h). symmetry. destruct (Z.ltb_spec (signed ws) 0) as [n|n];
    [exact n|].
  destruct (forallb _ ws) eqn:E.
  - rewrite (all_same 0 ws E), signed_zeros. reflexivity.
  - apply Z.compare_gt_iff. enough (0 < natural ws) as p.
    { pose proof (is_negative_iff ws h) as s. unfold signed in *. destruct (is_negative ws); [|lia].
      symmetry in s. apply Z.ltb_lt in s. lia. }
    clear n. induction ws as [|w ws IH]; [discriminate|]. inversion h as [|? ? hw hws]; subst.
      cbn [forallb natural] in *.
    pose proof (natural_range ws hws). pose proof two_halves. pose proof half_pos. unfold is_word in hw.
    destruct (Z.eqb_spec 0 w); [|nia]. specialize (IH hws E). nia.
Qed.

(* Sums and differences. *)
Lemma halves_of_small s : 0 <= s < word * word -> is_word (fst (halves s)) /\ is_word (snd (halves s)) /\
  fst (halves s) + word * snd (halves s) = s.
Proof.
  intro r. pose proof half_pos. pose proof two_halves. rewrite halves_are; cbn [fst snd].
  split; [apply a_remainder_is_a_word|]. split; [apply a_remainder_is_a_word|].
  rewrite (Z.mod_small (s / word)).
  - pose proof (Z.div_mod s word ltac:(lia)). lia.
  - split; [apply Z.div_pos; lia|]. apply Z.div_lt_upper_bound; lia.
Qed.
Theorem add_with_carry_is x y carry : is_word x -> is_word y -> let '(w, over) := add_with_carry x y carry in
  is_word w /\ w + word * Z.b2z over = x + y + Z.b2z carry.
Proof.
  unfold is_word, add_with_carry, overflowing_add. rewrite !low_word_is. intros hx hy. pose proof half_pos.
    pose proof two_halves.
  assert (0 <= Z.b2z carry <= 1) by (destruct carry; cbn; lia). set (c := Z.b2z carry) in *. clearbody c.
  assert (P : (x + y) mod word = x + y - word * Z.b2z (word <=? x + y)).
  { destruct (Z.leb_spec word (x + y)); cbn [Z.b2z].
    - symmetry. apply Z.mod_unique with 1; lia.
    - rewrite Z.mod_small; lia. }
  rewrite P. destruct (Z.leb_spec word (x + y)); cbn [Z.b2z orb].
  - replace (x + y - word * 1 + c) with (x + y + c - word) by ring. rewrite Z.mod_small by lia.
    destruct (Z.leb_spec word (x + y + c - word)); cbn [Z.b2z orb]; lia.
  - replace (x + y - word * 0 + c) with (x + y + c) by ring. destruct (Z.leb_spec word (x + y + c)); cbn [Z.b2z orb].
    + assert (x + y + c = word) as -> by lia. rewrite Z_mod_same_full. lia.
    + rewrite Z.mod_small by lia. lia.
Qed.
Theorem subtract_with_borrow_is x y borrow : is_word x -> is_word y ->
  let '(w, under) := subtract_with_borrow x y borrow in
  is_word w /\ w - word * Z.b2z under = x - y - Z.b2z borrow.
Proof.
  unfold is_word, subtract_with_borrow, overflowing_sub. rewrite !low_word_is. intros hx hy. pose proof half_pos.
    pose proof two_halves.
  assert (0 <= Z.b2z borrow <= 1) by (destruct borrow; cbn; lia). set (c := Z.b2z borrow) in *. clearbody c.
  assert (P : (x - y) mod word = x - y + word * Z.b2z (x <? y)).
  { destruct (Z.ltb_spec x y); cbn [Z.b2z].
    - symmetry. apply Z.mod_unique with (-1); lia.
    - rewrite Z.mod_small; lia. }
  rewrite P. destruct (Z.ltb_spec x y); cbn [Z.b2z orb].
  - replace (x - y + word * 1) with (x - y + word) by ring. rewrite Z.mod_small by lia.
    destruct (Z.ltb_spec (x - y + word) c); cbn [Z.b2z orb]; lia.
  - replace (x - y + word * 0) with (x - y) by ring. destruct (Z.ltb_spec (x - y) c); cbn [Z.b2z orb].
    + assert (x - y - c = -1) as E by lia. replace ((x - y - c) mod word) with (word - 1); [lia|].
      rewrite E. apply Z.mod_unique with (-1); lia.
    + rewrite Z.mod_small by lia. lia.
Qed.
Theorem add_words_is n a b carry : words_of n a -> words_of n b -> let '(ws, over) := add_words a b carry in
  words_of n ws /\ natural ws + word ^ Z.of_nat n * Z.b2z over = natural a + natural b + Z.b2z carry.
Proof.
  revert a b carry. induction n as [|n IH]; intros [|x a] [|y b] carry; try (intros [? _] [? _]; discriminate).
  - intros _ _. cbn [add_words natural Z.of_nat]. rewrite Z.pow_0_r. split; [split; [reflexivity|constructor]|ring].
  - intros ha hb. apply words_cons in ha as [hx ha]. apply words_cons in hb as [hy hb]. cbn [add_words].
    pose proof (add_with_carry_is x y carry hx hy) as E. destruct (add_with_carry x y carry) as [w over].
      destruct E as [hw E].
    specialize (IH a b over ha hb). destruct (add_words a b over) as [ws last]. destruct IH as [h E2].
    split; [now apply words_cons|]. cbn [natural]. rewrite word_succ. lia.
Qed.
(* Words of `from` beyond `other` do not count: a borrow is lost where `other` ends. *)
Theorem subtract_is n from other mask : words_of n from -> words_of n other -> words_of n (subtract from other mask) /\
  exists k, natural (subtract from other mask) = natural from - (if mask then natural other else 0) + word ^ Z.of_nat n
    * k.
Proof.
  intros hf ho. assert (general : forall borrow, words_of n (subtract_words from other mask borrow) /\ exists k,
    natural (subtract_words from other mask borrow) = natural from - (if mask then natural other else 0) - Z.b2z borrow
      + word ^ Z.of_nat n * k).
  { revert from other hf ho. induction n as [|n IH]; intros [|x from] [|y other]; try (intros [? _] [? _];
    discriminate).
    - intros _ _ borrow. cbn [subtract_words natural Z.of_nat]. split; [split; [reflexivity|constructor]|].
      exists (Z.b2z borrow). rewrite Z.pow_0_r. destruct mask; ring.
    - intros ha hb borrow. apply words_cons in ha as [hx ha]. apply words_cons in hb as [hy hb]. cbn [subtract_words].
      assert (hy' : is_word (if mask then y else 0)) by (destruct mask; [exact hy|unfold is_word in *; lia]).
      pose proof (subtract_with_borrow_is x _ borrow hx hy') as E.
        destruct (subtract_with_borrow _ _ borrow) as [w under].
      destruct E as [hw E]. destruct (IH from other ha hb under) as [h [k E2]]. split; [now apply words_cons|].
      exists k. cbn [natural]. rewrite word_succ, E2. destruct mask; lia. }
  destruct (general false) as [h [k E]]. split; [exact h|]. exists k. unfold subtract. rewrite E. cbn [Z.b2z]. ring.
Qed.
Definition is n ws x := words_of n ws /\ signed ws = x.
Theorem integer_plus_is n a b x y : is n a x -> is n b y -> fits n (x + y) -> is n (integer_plus a b) (x + y).
Proof.
  intros [ha <-] [hb <-] f. pose proof (add_words_is n a b false ha hb) as E. unfold integer_plus.
  destruct (add_words a b false) as [ws over]. destruct E as [h E]. split; [exact h|].
  destruct (signed_same n a ha) as [j ea]. destruct (signed_same n b hb) as [k eb]. cbn [fst Z.b2z] in *.
  apply (right_if_it_fits n _ _ (j + k - Z.b2z over) h f). lia.
Qed.
Theorem integer_minus_is n a b x y : is n a x -> is n b y -> fits n (x - y) -> is n (integer_minus a b) (x - y).
Proof.
  intros [ha <-] [hb <-] f. destruct (subtract_is n a b true ha hb) as [h [under E]]. split; [exact h|].
  destruct (signed_same n a ha) as [j ea]. destruct (signed_same n b hb) as [k eb].
  apply (right_if_it_fits n _ _ (j - k + under) h f). unfold integer_minus. lia.
Qed.

(* Products: no sum of a row needs more than two words. *)
Theorem a_row_fits_two_words x y w carry : is_word x -> is_word y -> is_word w -> is_word carry ->
  0 <= x * y + w + carry < word * word.
Proof. unfold is_word. nia. Qed.
Lemma zero_is_a_word : is_word 0. Proof. unfold is_word. pose proof half_pos. pose proof two_halves. lia. Qed.
Lemma first_row_is x b carry : first_row x b carry = row x b (repeat 0 (length b)) carry.
Proof.
  revert carry. induction b as [|y b IH]; intro carry; [reflexivity|]. cbn [first_row row length repeat].
  rewrite Z.add_0_r. destruct (halves (x * y + carry)) as [w over]. now rewrite IH.
Qed.
Theorem row_is n x b before carry : is_word x -> words_of n b -> words_of n before -> is_word carry ->
  let '(ws, over) := row x b before carry in
  words_of n ws /\ is_word over /\ natural ws + word ^ Z.of_nat n * over = x * natural b + natural before + carry.
Proof.
  intros hx. revert b before carry. induction n as [|n IH]; intros [|y b] [|w before] carry;
    try (intros [? _] [? _]; discriminate).
  - intros _ _ hc. cbn [row natural Z.of_nat]. rewrite Z.pow_0_r. split; [split; [reflexivity|constructor]|]. split;
    [exact hc|ring].
  - intros hb ha hc. apply words_cons in hb as [hy hb]. apply words_cons in ha as [hw ha]. cbn [row].
    pose proof (halves_of_small _ (a_row_fits_two_words x y w carry hx hy hw hc)) as E.
    destruct (halves (x * y + w + carry)) as [low high]. cbn [fst snd] in E. destruct E as (hl & hh & E).
    specialize (IH b before high hb ha hh). destruct (row x b before high) as [ws over]. destruct IH as (h & ho & E2).
    split; [now apply words_cons|]. split; [exact ho|]. cbn [natural]. rewrite word_succ. lia.
Qed.
Lemma with_carry_is n m ws over product : words_of m ws -> is_word over -> length product = (S n + m)%nat ->
  exists low rest, with_carry (ws, over) (skipn m product) = low :: rest /\ is_word low /\ length rest = (n + m)%nat /\
    words_of m (firstn m rest) /\ low + word * natural (firstn m rest) = natural ws + word ^ Z.of_nat m * over.
Proof.
  intros [lw hw] ho l. cbn [with_carry]. destruct (skipn m product) as [|x above] eqn:E.
  { pose proof (skipn_length m product) as s. rewrite E in s. cbn in s. lia. }
  pose proof (skipn_length m product) as s. rewrite E in s. cbn [length] in s.
  assert (same : natural (ws ++ [over]) = natural ws + word ^ Z.of_nat m * over).
  { rewrite natural_app. unfold modulus. rewrite lw. cbn [natural]. ring. }
  assert (all : Forall is_word (ws ++ [over])) by (apply Forall_app; split; [exact hw|constructor;
    [exact ho|constructor]]).
  assert (lall : length (ws ++ [over]) = S m) by (rewrite app_length, lw; cbn; lia).
  replace (ws ++ over :: above) with ((ws ++ [over]) ++ above) by now rewrite <- app_assoc.
  destruct (ws ++ [over]) as [|low rest]; [discriminate|]. inversion all; subst. injection lall as lall.
  exists low, (rest ++ above). split; [reflexivity|]. split; [assumption|]. split; [rewrite app_length; lia|].
  rewrite firstn_app, <- lall, firstn_all, Nat.sub_diag. cbn [firstn]. rewrite app_nil_r.
  split; [split; [reflexivity|assumption]|]. rewrite lall. exact same.
Qed.
Lemma rows_are n m a b product : words_of n a -> words_of m b -> length product = (n + m)%nat ->
  words_of m (firstn m product) ->
  words_of (n + m) (rows a b product) /\ natural (rows a b product) = natural a * natural b + natural (firstn m
    product).
Proof.
  intros ha hb. revert a product ha. induction n as [|n IH]; intros [|x a] product ha; try (destruct ha; discriminate);
    intros l first.
  - cbn [rows natural]. rewrite firstn_all2 in * by (cbn in l; lia). split; [exact first|ring].
  - apply words_cons in ha as [hx ha]. cbn [rows natural]. rewrite (proj1 hb).
    pose proof (row_is m x b (firstn m product) 0 hx hb first zero_is_a_word) as R.
    destruct (row x b (firstn m product) 0) as [ws over]. destruct R as (hw & ho & E).
    destruct (with_carry_is n m ws over product hw ho l) as (low & rest & -> & hl & lr & fr & E2).
    destruct (IH a rest ha lr fr) as [h E3]. split; [now apply words_cons|]. cbn [natural]. rewrite E3. lia.
Qed.
(* The words that `product` had do not matter. *)
Theorem multiply_is n m a b product : (0 < n)%nat -> words_of n a -> words_of m b -> length product = (n + m)%nat ->
  words_of (n + m) (multiply a b product) /\ natural (multiply a b product) = natural a * natural b.
Proof.
  intros n0 ha hb l. destruct a as [|x a]; [destruct ha; cbn in *; lia|]. destruct n as [|n]; [lia|].
  apply words_cons in ha as [hx ha]. cbn [multiply natural]. rewrite first_row_is, (proj1 hb).
  destruct (zeros_are_words m) as [hz ez].
  pose proof (row_is m x b (repeat 0 m) 0 hx hb hz zero_is_a_word) as R.
  destruct (row x b (repeat 0 m) 0) as [ws over]. destruct R as (hw & ho & E).
  destruct (with_carry_is n m ws over product hw ho l) as (low & rest & -> & hl & lr & fr & E2).
  destruct (rows_are n m a b rest ha hb lr fr) as [h E3]. split; [now apply words_cons|]. cbn [natural]. rewrite E3.
    lia.
Qed.
Lemma subtract_at_is k n product other mask : words_of (k + n) product -> words_of n other ->
  words_of (k + n) (subtract_at k product other mask) /\ exists under, natural (subtract_at k product other mask) =
    natural product - word ^ Z.of_nat k * (if mask then natural other else 0) + word ^ Z.of_nat (k + n) * under.
Proof.
  intros hp ho. destruct (words_split k n product hp) as [h1 h2].
  destruct (subtract_is n _ other mask h2 ho) as [h [under E]]. unfold subtract_at. split; [now apply words_app|].
  exists under. rewrite natural_app, E, (modulus_of k _ h1), word_sum. rewrite <- (firstn_skipn k product) at 3.
  rewrite natural_app, (modulus_of k _ h1). ring.
Qed.
(* A negative factor is read as word^length more, which adds the other factor times that. *)
Theorem product_with_signs_is n m a b product : (0 < n)%nat -> (0 < m)%nat -> words_of n a -> words_of m b ->
  length product = (n + m)%nat -> is (n + m) (product_with_signs a b product) (signed a * signed b).
Proof.
  intros n0 m0 ha hb l. destruct (multiply_is n m a b product n0 ha hb l) as [hp ep].
  unfold product_with_signs. rewrite (proj1 ha), (proj1 hb).
  destruct (subtract_at_is n m _ b (is_negative a) hp hb) as [h1 [u1 e1]]. rewrite Nat.add_comm in h1.
  destruct (subtract_at_is m n _ a (is_negative b) h1 ha) as [h2 [u2 e2]]. rewrite (Nat.add_comm m n) in h2, e2.
  split; [exact h2|]. pose proof (signed_fits n a ha) as fa. pose proof (signed_fits m b hb) as fb. unfold fits in *.
  pose proof (word_pos n). pose proof (word_pos m).
  assert (sa : natural a = signed a + word ^ Z.of_nat n * Z.b2z (is_negative a)).
  { unfold signed. rewrite (modulus_of n a ha). destruct (is_negative a); cbn [Z.b2z]; ring. }
  assert (sb : natural b = signed b + word ^ Z.of_nat m * Z.b2z (is_negative b)).
  { unfold signed. rewrite (modulus_of m b hb). destruct (is_negative b); cbn [Z.b2z]; ring. }
  apply (right_if_it_fits (n + m) _ _ (u1 + u2 - Z.b2z (is_negative a) * Z.b2z (is_negative b)) h2).
  - unfold fits. rewrite word_sum. set (A := word ^ Z.of_nat n) in *. set (B := word ^ Z.of_nat m) in *.
    set (x := signed a) in *. set (y := signed b) in *.
    assert (Z.abs (2 * x) <= A) by lia. assert (Z.abs (2 * y) <= B) by lia.
    assert (H3 : Z.abs (2 * x) * Z.abs (2 * y) <= A * B) by (apply Z.mul_le_mono_nonneg; lia).
      rewrite <- Z.abs_mul in H3.
    assert (0 < A * B) by (apply Z.mul_pos_pos; assumption). lia.
  - rewrite e2, e1, ep, word_sum. rewrite sa, sb. destruct (is_negative a), (is_negative b); cbn [Z.b2z]; ring.
Qed.
Lemma zeros_map (ws : list Z) : map (fun _ => 0) ws = repeat 0 (length ws).
Proof. induction ws as [|w ws IH]; [reflexivity|]. cbn. now rewrite IH. Qed.
Lemma signs_map (s : Z) (ws : list Z) : map (fun _ => s) ws = repeat s (length ws).
Proof. induction ws as [|w ws IH]; [reflexivity|]. cbn. now rewrite IH. Qed.
Lemma significant ws : Forall is_word ws -> let '(zeros, above) := without_zeros_below (without_repeated_sign ws) in
  Forall is_word above /\ (above = [] -> signed ws = 0) /\ (above <> [] ->
    signed ws = word ^ Z.of_nat zeros * signed above) /\
  (zeros + length above <= length ws)%nat.
Proof.
  intro h. destruct (without_repeated_sign_is ws h) as (a & b & _).
  assert (short : (length (without_repeated_sign ws) <= length ws)%nat).
  { unfold without_repeated_sign. destruct (without_eights_is (length ws) ws h) as (_ & _ & c).
    enough (forall n v, (length (without_ones n v) <= length v)%nat) as d by (eapply Nat.le_trans; [apply d|exact c]).
    clear. induction n as [|n IH]; intros [|w v]; try apply Nat.le_refl. cbn [without_ones].
    destruct (_ =? _); [|apply Nat.le_refl]. eapply Nat.le_trans; [apply IH|].
    destruct (exists_last (l := w :: v) ltac:(discriminate)) as (below & top & ->).
      rewrite removelast_last, app_length. lia. }
  pose proof (without_zeros_below_is (without_repeated_sign ws)) as E.
    destruct (without_zeros_below _) as [zeros above].
  rewrite E in a. apply Forall_app in a as [_ a]. split; [exact a|]. split; [|split].
  - intros ->. rewrite <- b, E, app_nil_r. apply signed_zeros.
  - intro some. rewrite <- b, E, signed_app by exact some. rewrite (proj2 (zeros_are_words zeros)).
    rewrite (modulus_of zeros _ (proj1 (zeros_are_words zeros))). ring.
  - rewrite E, app_length, repeat_length in short. exact short.
Qed.
Theorem multiply_significant_words_is n m a b product : words_of n a -> words_of m b -> length product = (n + m)%nat ->
  is (n + m) (multiply_significant_words a b product) (signed a * signed b).
Proof.
  intros ha hb l. unfold multiply_significant_words.
  pose proof (significant a (proj2 ha)) as Sa. destruct (without_zeros_below (without_repeated_sign a)) as [za a'].
  pose proof (significant b (proj2 hb)) as Sb. destruct (without_zeros_below (without_repeated_sign b)) as [zb b'].
  destruct Sa as (fa & na & va & la). destruct Sb as (fb & nb & vb & lb).
  assert (zero : is (n + m) (map (fun _ => 0) product) 0).
  { rewrite zeros_map, l. split; [apply zeros_are_words|apply signed_zeros]. }
  destruct a' as [|xa a']; [rewrite na by reflexivity; rewrite Z.mul_0_l; exact zero|].
  destruct b' as [|xb b']; [rewrite nb by reflexivity; rewrite Z.mul_0_r; exact zero|].
  cbn [is_empty orb]. clear na nb zero. set (a2 := xa :: a') in *. set (b2 := xb :: b') in *.
  rewrite (va ltac:(discriminate)), (vb ltac:(discriminate)).
  assert (ha2 : words_of (length a2) a2) by (split; [reflexivity|exact fa]).
  assert (hb2 : words_of (length b2) b2) by (split; [reflexivity|exact fb]).
  rewrite (proj1 ha) in la. rewrite (proj1 hb) in lb. set (na := length a2) in *. set (nb := length b2) in *.
  assert (l2 : length (firstn (na + nb) (skipn (za + zb) product)) = (na + nb)%nat).
  { rewrite firstn_length, skipn_length. lia. }
  assert (na0 : (0 < na)%nat) by (unfold na, a2; cbn; lia). assert (nb0 : (0 < nb)%nat) by (unfold nb, b2; cbn; lia).
  destruct (product_with_signs_is na nb a2 b2 _ na0 nb0 ha2 hb2 l2) as [hp ep].
  set (p := product_with_signs _ _ _) in *. rewrite zeros_map, signs_map, firstn_length, !skipn_length.
  replace (Nat.min (za + zb) (length product)) with (za + zb)%nat by lia.
  set (k := (length product - (za + zb) - (na + nb))%nat). split.
  - replace (n + m)%nat with ((za + zb) + ((na + nb) + k))%nat by lia. apply words_app; [apply zeros_are_words|].
    apply words_app; [exact hp|]. apply signs_are_words.
  - rewrite signed_app by (destruct hp; destruct p; cbn in *; [lia|discriminate]).
    rewrite a_repeated_sign_changes_nothing, ep, (proj2 (zeros_are_words _)), (modulus_of (za + zb) _ (proj1
      (zeros_are_words _))), word_sum.
    ring.
Qed.
Lemma in_two_words z : - (half * word) <= z < half * word -> is 2 (let '(low, high) := halves z in [low; high]) z.
Proof.
  intro r. pose proof half_pos. pose proof two_halves. rewrite halves_are.
  assert (h : words_of 2 [z mod word; (z / word) mod word]).
  { split; [reflexivity|]. repeat (constructor; [apply a_remainder_is_a_word|]). constructor. }
  split; [exact h|]. change [z mod word; (z / word) mod word] with ([z mod word] ++ [(z / word) mod word]).
  rewrite signed_app, signed_one, modulus_one by discriminate. cbn [natural].
  pose proof (Z.div_mod z word ltac:(lia)) as E. set (q := z / word) in *.
    pose proof (Z.mod_pos_bound z word ltac:(lia)).
  assert (- half <= q < half) by nia. enough (cast_signed (q mod word) = q) as -> by lia. unfold cast_signed.
  destruct (Z_lt_le_dec q 0) as [n|n].
  - replace (q mod word) with (q + word) by (apply Z.mod_unique with (-1); lia).
    destruct (Z.leb_spec half (q + word)); lia.
  - rewrite Z.mod_small by lia. destruct (Z.leb_spec half q); lia.
Qed.
Theorem integer_times_is n m a b x y : (0 < n)%nat -> (0 < m)%nat -> is n a x -> is m b y ->
  is (n + m) (integer_times a b) (x * y).
Proof.
  intros n0 m0 [ha <-] [hb <-].
  assert (general : is (n + m) (let product := repeat 0 (length a + length b) in
      if (2 <? length a)%nat then multiply_significant_words a b product else product_with_signs a b product) (signed a
        * signed b)).
  { cbv zeta. destruct (2 <? length a)%nat; [apply multiply_significant_words_is|apply product_with_signs_is];
      try assumption; now rewrite repeat_length, (proj1 ha), (proj1 hb). }
  pose proof half_pos. pose proof two_halves.
  destruct a as [|a [|a1 a']]; [exact general| |exact general]. destruct b as [|b [|b1 [|b2 b']]]; try exact general.
  - destruct ha as [<- ha], hb as [<- hb]. inversion ha; inversion hb; subst. rewrite !signed_one.
    cbn [integer_times length Nat.add].
    pose proof (cast_range a ltac:(assumption)). pose proof (cast_range b ltac:(assumption)).
    set (x := cast_signed a) in *. set (y := cast_signed b) in *.
    apply in_two_words. assert (half * half < half * word) by nia. assert (Z.abs (x * y) <= half * half); [|lia].
    rewrite Z.abs_mul. apply Z.mul_le_mono_nonneg; lia.
  - destruct ha as [<- ha], hb as [<- hb]. inversion ha as [|? ? wa _]; inversion hb as [|? ? w0 hb']; subst.
    inversion hb' as [|? ? w1 _]; subst.
    change [b; b1] with ([b] ++ [b1]). rewrite signed_app, !signed_one, modulus_one by discriminate. cbn [natural].
      rewrite Z.mul_0_r, Z.add_0_r.
    pose proof (cast_range a wa). pose proof (cast_range b1 w1). set (x := cast_signed a) in *.
      set (y := cast_signed b1) in *.
    unfold is_word in w0.
    assert (R : - (half * word) <= x * y + x * b / word < half * word).
    { assert (Z.abs (x * y) <= half * half) by (rewrite Z.abs_mul; apply Z.mul_le_mono_nonneg; lia).
      assert (- half <= x * b / word < half).
      { split; [apply Z.div_le_lower_bound; nia|apply Z.div_lt_upper_bound; nia]. }
      assert (half * half + half <= half * word) by nia. lia. }
    change (is 3 (let '(middle, high) := halves (x * y + Z.shiftr (x * b) bits) in [low_word (x * b); middle;
      high]) (x * (b + word * y))).
    rewrite low_word_is, Z.shiftr_div_pow2 by lia. change (2 ^ bits) with word.
    pose proof (in_two_words _ R) as [h E]. destruct (halves (x * y + x * b / word)) as [middle high].
    split; [apply (proj2 (words_cons 2 _ _)); split; [apply a_remainder_is_a_word|exact h]|].
    change [x * b mod word; middle; high] with ([x * b mod word] ++ [middle; high]).
      rewrite signed_app, modulus_one, E by discriminate.
    cbn [natural]. pose proof (Z.div_mod (x * b) word ltac:(lia)). lia.
Qed.

(* A coordinate in its axis' unit: a significand of one word, with its sign, times a power of two. *)
Lemma digits n x : natural (map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 0 n)) = x mod word ^ Z.of_nat n.
Proof.
  pose proof half_pos. pose proof two_halves. revert x. induction n as [|n IH]; intro x; [cbn; now rewrite Z.mod_1_r|].
  assert (rest : map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 1 n) =
    map (fun i => ((x / word) / word ^ Z.of_nat i) mod word) (seq 0 n)).
  { rewrite <- seq_shift, map_map. apply map_ext. intro i. rewrite word_succ.
    rewrite Z.div_div; [reflexivity|lia|apply word_pos]. }
  cbn [seq map natural]. rewrite rest, IH, word_succ. change (Z.of_nat 0) with 0. rewrite Z.pow_0_r, Z.div_1_r.
  pose proof (word_pos n). rewrite Z.rem_mul_r by lia. reflexivity.
Qed.
Lemma wide_is_small significand shift : - half <= significand < half -> 0 <= shift ->
  - (half * word) <= significand * 2 ^ (shift mod bits) < half * word.
Proof.
  intros s64 s0. pose proof half_pos. pose proof two_halves. pose proof (Z.mod_pos_bound shift bits ltac:(lia)).
  assert (1 <= 2 ^ (shift mod bits) <= half).
  { split; [pose proof (Z.pow_pos_nonneg 2 (shift mod bits)); lia|apply Z.pow_le_mono_r; lia]. }
  set (p := 2 ^ (shift mod bits)) in *. assert (half * half < half * word) by nia. nia.
Qed.
Lemma wide_times significand shift : 0 <= shift ->
  significand * 2 ^ shift = significand * 2 ^ (shift mod bits) * word ^ (shift / bits).
Proof.
  intro s0. pose proof (Z.div_mod shift bits ltac:(lia)). pose proof (Z.mod_pos_bound shift bits ltac:(lia)).
  assert (0 <= shift / bits) by (apply Z.div_pos; lia). unfold word.
  rewrite <- Z.pow_mul_r, <- Z.mul_assoc, <- Z.pow_add_r by lia. do 2 f_equal. lia.
Qed.
Theorem write_shifted_is n significand shift : - half <= significand < half -> 0 <= shift ->
  fits n (significand * 2 ^ shift) ->
  is n (write_shifted n significand shift) (significand * 2 ^ shift).
Proof.
  intros s64 s0 f. pose proof half_pos. pose proof two_halves. set (x := significand * 2 ^ shift).
  pose proof (wide_is_small significand shift s64 s0) as W. pose proof (wide_times significand shift s0) as X.
    fold x in X.
  set (first := shift / bits) in *. set (within := shift mod bits) in *. set (wide := significand * 2 ^ within) in *.
  assert (f0 : 0 <= first) by (apply Z.div_pos; lia).
  assert (same : write_shifted n significand shift = map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 0 n)).
  { unfold write_shifted. rewrite halves_are. fold first within wide. apply map_ext. intro i.
    destruct (Z.ltb_spec (Z.of_nat i) first) as [low|high].
    - rewrite X. replace first with ((first - Z.of_nat i - 1) + 1 + Z.of_nat i) by ring. rewrite !Z.pow_add_r by lia.
      rewrite Z.mul_assoc, Z.div_mul by (pose proof (word_pos i); lia).
      rewrite Z.pow_1_r, Z.mul_assoc. symmetry. apply Z.mod_mul. lia.
    - assert (D : x / word ^ Z.of_nat i = wide / word ^ (Z.of_nat i - first)).
      { assert (forall k, 0 <= k -> 0 < word ^ k) as pos by (intros; apply Z.pow_pos_nonneg; lia).
        rewrite X. replace (Z.of_nat i) with (first + (Z.of_nat i - first)) at 1 by ring. rewrite Z.pow_add_r by lia.
        pose proof (pos first ltac:(lia)). pose proof (pos (Z.of_nat i - first) ltac:(lia)).
        rewrite <- Z.div_div by lia. now rewrite Z.div_mul by lia. }
      rewrite D. destruct (Z.eqb_spec (Z.of_nat i) first) as [e|ne]; [rewrite e, Z.sub_diag, Z.pow_0_r, Z.div_1_r;
        reflexivity|].
      destruct (Z.eqb_spec (Z.of_nat i) (first + 1)) as [e|ne1]; [rewrite e; replace (first + 1 - first) with 1 by ring;
        now rewrite Z.pow_1_r|].
      assert (big : word * word <= word ^ (Z.of_nat i - first)).
      { replace (word * word) with (word ^ 2) by ring. apply Z.pow_le_mono_r; lia. }
      assert (half * word < word * word) by nia.
      assert (signs : (significand <? 0) = (wide <? 0)).
      { unfold wide. assert (0 < 2 ^ within) by (apply Z.pow_pos_nonneg; [lia|apply Z.mod_pos_bound; lia]).
        destruct (Z.ltb_spec significand 0), (Z.ltb_spec (significand * 2 ^ within) 0); try reflexivity; nia. }
      rewrite signs. destruct (Z.ltb_spec wide 0).
      + assert (wide / word ^ (Z.of_nat i - first) = -1) as ->; [|apply Z.mod_unique with (-1); lia].
        apply Z.le_antisymm; [apply Z.lt_succ_r, Z.div_lt_upper_bound; lia|apply Z.div_le_lower_bound; lia].
      + rewrite Z.div_small by lia. rewrite Z.mod_0_l by lia. reflexivity. }
  assert (h : words_of n (write_shifted n significand shift)).
  { rewrite same. split; [now rewrite map_length, seq_length|]. apply Forall_forall. intros v i.
    apply in_map_iff in i as (k & <- & _). apply a_remainder_is_a_word. }
  split; [exact h|]. apply (right_if_it_fits n _ _ (- (x / word ^ Z.of_nat n)) h f). rewrite same, digits.
  pose proof (Z.div_mod x (word ^ Z.of_nat n) ltac:(pose proof (word_pos n); lia)). lia.
Qed.
Theorem integer_shifted_is n significand shift : - half <= significand < half -> 0 <= shift ->
  fits n (significand * 2 ^ shift) ->
  is n (integer_shifted n significand shift) (significand * 2 ^ shift).
Proof.
  intros s64 s0 f. unfold integer_shifted. destruct (Nat.eqb_spec n 1) as [->|]; [|now apply write_shifted_is].
  pose proof half_pos. pose proof two_halves.
  assert (h : words_of 1 [(significand * 2 ^ (shift mod bits)) mod word]).
  { split; [reflexivity|]. constructor; [apply a_remainder_is_a_word|constructor]. }
  split; [exact h|]. pose proof (Z.div_mod (significand * 2 ^ (shift mod bits)) word ltac:(lia)) as E.
  apply (right_if_it_fits 1 _ _ (- (significand * 2 ^ (shift mod bits) / word)) h f). change (Z.of_nat 1) with 1.
    rewrite Z.pow_1_r.
  cbn [natural]. destruct (Z.eq_dec significand 0) as [->|ne]; [rewrite !Z.mul_0_l in *;
    rewrite Z.mod_0_l, Z.div_0_l by lia; ring|].
  assert (shift < bits).
  { destruct (Z_lt_le_dec shift bits) as [l|g]; [exact l|]. exfalso. unfold fits in f.
    change (Z.of_nat 1) with 1 in f. rewrite Z.pow_1_r in f.
    assert (word <= 2 ^ shift) by (apply Z.pow_le_mono_r; lia). nia. }
  rewrite (Z.mod_small shift) in * by lia. lia.
Qed.

(* Numbers of as many words as they need: minimal ones, whose words are the number. *)
Definition holds ws x := Forall is_word ws /\ is_minimal ws /\ signed ws = x.
Lemma holds_words ws : Forall is_word ws -> holds (without_repeated_sign ws) (signed ws).
Proof. intro h. destruct (without_repeated_sign_is ws h) as (a & b & c). repeat split; assumption. Qed.
Lemma cast_of_remainder z : - half <= z < half -> cast_signed (z mod word) = z.
Proof.
  intro r. pose proof half_pos. pose proof two_halves. unfold cast_signed. destruct (Z_lt_le_dec z 0) as [n|n].
  - replace (z mod word) with (z + word) by (apply Z.mod_unique with (-1); lia).
    destruct (Z.leb_spec half (z + word)); lia.
  - rewrite Z.mod_small by lia. destruct (Z.leb_spec half z); lia.
Qed.
Theorem double_is z : - (half * word) <= z < half * word -> holds (double z) z.
Proof.
  intro r. destruct (in_two_words z r) as [[_ h] E]. pose proof half_pos. pose proof two_halves. unfold double.
  rewrite halves_are in *. destruct (Z.eqb_spec z 0) as [->|n0].
  { cbn [firstn]. repeat split; [constructor|now left|apply signed_nil]. }
  destruct (Z.eqb_spec z (cast_signed (z mod word))) as [one|two]; cbn [firstn].
  - inversion h; subst. split; [constructor; [assumption|constructor]|]. split; [|now rewrite signed_one].
    right. cbn [last removelast]. unfold sign_word. cbn [last]. replace (half <=? 0) with false by (symmetry;
      apply Z.leb_gt; lia).
    intro z0. rewrite z0 in one. unfold cast_signed in one. replace (half <=? 0) with false in one by (symmetry;
      apply Z.leb_gt; lia). lia.
  - split; [exact h|]. split; [|exact E]. right. cbn [last removelast]. intro same. apply two. rewrite <- signed_one.
    rewrite <- (a_repeated_sign_changes_nothing [z mod word] 1). cbn [repeat app]. rewrite <- same. symmetry. exact E.
Qed.
Lemma single_is ws z : Forall is_word ws -> single ws = Some z -> signed ws = z /\ - half <= z < half.
Proof.
  intros h E. pose proof half_pos. destruct ws as [|w [|]]; cbn in E; try discriminate; injection E as <-.
  - rewrite signed_nil. lia.
  - inversion h; subst. rewrite signed_one. split; [reflexivity|now apply cast_range].
Qed.
Lemma small_is ws z : Forall is_word ws -> small ws = Some z -> signed ws = z.
Proof.
  intros h E. destruct ws as [|w [|v [|]]]; try (now apply single_is).
  cbn [small] in E. injection E as <-. inversion h as [|? ? hw h']; subst. inversion h' as [|? ? hv _]; subst.
  pose proof half_pos. pose proof two_halves. change [w; v] with ([w] ++ [v]).
    rewrite signed_app, signed_one, modulus_one by discriminate.
  cbn [natural]. unfold cast_signed, is_word in *. destruct (Z.leb_spec half v), (Z.leb_spec (half * word) (v * word +
    w)); nia.
Qed.
Lemma add_words_app a a' b b' carry : length a = length b -> add_words (a ++ a') (b ++ b') carry =
  let '(x, carry) := add_words a b carry in let '(y, carry) := add_words a' b' carry in (x ++ y, carry).
Proof.
  revert b carry. induction a as [|w a IH]; intros [|v b] carry l; try discriminate.
  - cbn [app add_words]. destruct (add_words a' b' carry). reflexivity.
  - cbn [app add_words]. destruct (add_with_carry w v carry) as [s over]. rewrite IH by now injection l.
    destruct (add_words a b over) as [x c1]. destruct (add_words a' b' c1). reflexivity.
Qed.
Lemma complement_is n mask ws : words_of n ws -> words_of n (map (complement mask) ws) /\
  natural (map (complement mask) ws) = if mask then word ^ Z.of_nat n - 1 - natural ws else natural ws.
Proof.
  revert ws. induction n as [|n IH]; intros [|w ws]; try (intros [? _]; discriminate).
  - intros _. split; [split; [reflexivity|constructor]|]. destruct mask; reflexivity.
  - intro h. apply words_cons in h as [hw h]. destruct (IH ws h) as [a E]. cbn [map natural]. rewrite E.
    split; [apply words_cons; split; [|exact a]|].
    + unfold complement, is_word in *. destruct mask; lia.
    + rewrite word_succ. unfold complement. destruct mask; ring.
Qed.
Lemma extended n k mask ws : words_of n ws -> let all := map (complement mask) (ws ++ repeat (sign_word ws) k) in
  words_of (n + k) all /\ exists j, natural all = (if mask then - 1 - signed ws else signed ws) + word ^ Z.of_nat (n +
    k) * j.
Proof.
  intro h. cbv zeta. pose proof (words_app n k _ _ h (signs_are_words ws k)) as all.
  destruct (complement_is (n + k) mask _ all) as [a E]. split; [exact a|]. rewrite E.
  destruct (signed_same (n + k) _ all) as [j E2]. rewrite a_repeated_sign_changes_nothing in E2. rewrite E2.
  destruct mask; [exists (1 - j)|exists j]; ring.
Qed.
Lemma fits_wider n m x : (n <= m)%nat -> fits n x -> Z.abs (2 * x) <= word ^ Z.of_nat m /\ 2 * x < word ^ Z.of_nat m.
Proof.
  intros le f. unfold fits in f. pose proof half_pos. pose proof two_halves.
  assert (word ^ Z.of_nat n <= word ^ Z.of_nat m) by (apply Z.pow_le_mono_r; lia). lia.
Qed.
Lemma aligned_sum long short (long_mask short_mask carry : bool) x y : Forall is_word long -> Forall is_word short ->
  (length short <= length long)%nat -> signed long = x -> signed short = y ->
  let total := (if long_mask then - 1 - x else x) + (if short_mask then - 1 - y else y) + Z.b2z carry in
  (total = x + y \/ total = x - y \/ total = y - x) ->
  let n := length short in
  let long := (map (complement long_mask) long, complement long_mask (sign_word long)) in
  let short := (map (complement short_mask) short, complement short_mask (sign_word short)) in
  holds (let '(below, carry) := add_words (firstn n (fst long)) (fst short) carry in
    let '(above, carry) := add_words (skipn n (fst long)) (map (fun _ => snd short) (skipn n (fst long))) carry in
    without_repeated_sign (below ++ above ++ [fst (add_with_carry (snd long) (snd short) carry)])) total.
Proof.
  intros hl hs le <- <- total which. cbv zeta. cbn [fst snd]. set (k := (length long - length short)%nat).
  destruct (extended (length long) 1 long_mask long (conj eq_refl hl)) as [wl [jl el]].
  destruct (extended (length short) (k + 1) short_mask short (conj eq_refl hs)) as [ws [js es]].
  replace (length short + (k + 1))%nat with (length long + 1)%nat in ws, es by (unfold k; lia).
  rewrite map_app in wl, el. rewrite repeat_app, !map_app in ws, es. cbn [repeat map] in wl, el, ws, es.
  rewrite <- (firstn_skipn (length short) (map (complement long_mask) long)), <- app_assoc in wl, el.
  pose proof (add_words_is _ _ _ carry wl ws) as sum_.
  rewrite add_words_app in sum_ by (rewrite firstn_length, !map_length; lia).
  destruct (add_words (firstn _ _) _ carry) as [below c1].
  rewrite add_words_app in sum_ by (rewrite skipn_length, !map_length, repeat_length; unfold k; lia).
  rewrite signs_map, skipn_length, map_length. fold k.
  assert (R : map (complement short_mask) (repeat (sign_word short) k) = repeat (complement short_mask (sign_word
    short)) k).
  { clear. induction k as [|k IH]; [reflexivity|]. cbn [repeat map]. now rewrite IH. }
  rewrite R in *. destruct (add_words (skipn _ _) _ c1) as [above c2]. cbn [add_words] in sum_.
  destruct (add_with_carry _ _ c2) as [top c3]. cbn [fst] in *. destruct sum_ as [h E].
  assert (fit : fits (length long + 1) total).
  { destruct (fits_wider _ (length long) _ (Nat.le_refl _) (signed_fits _ long (conj eq_refl hl))) as [l1 l2].
    destruct (fits_wider _ (length long) _ le (signed_fits _ short (conj eq_refl hs))) as [s1 s2].
    unfold fits. rewrite Nat.add_1_r, word_succ. pose proof half_pos. pose proof two_halves.
      pose proof (word_pos (length long)).
    set (P := word ^ Z.of_nat (length long)) in *. assert (2 * P <= word * P) by nia. lia. }
  assert (E2 : signed (below ++ above ++ [top]) = total).
  { apply (right_if_it_fits _ _ _ (jl + js - Z.b2z c3) h fit). unfold total. rewrite el, es in E.
    destruct long_mask, short_mask; lia. }
  rewrite <- E2. apply holds_words. apply h.
Qed.
Theorem sum_is a b mask x y : holds a x -> holds b y -> holds (sum a b mask) (if mask then x - y else x + y).
Proof.
  intros (ha & _ & ea) (hb & _ & eb). unfold sum. destruct (Nat.leb_spec (length b) (length a)) as [le|lt].
  - pose proof (aligned_sum a b false mask mask x y ha hb le ea eb) as S. cbv zeta in S.
    replace (if mask then x - y else x + y) with (x + (if mask then - 1 - y else y) + Z.b2z mask) by (destruct mask;
      cbn [Z.b2z]; ring).
    apply S. destruct mask; cbn [Z.b2z]; lia.
  - pose proof (aligned_sum b a mask false mask y x hb ha ltac:(lia) eb ea) as S. cbv zeta in S.
    replace (if mask then x - y else x + y) with ((if mask then - 1 - y else y) + x + Z.b2z mask) by (destruct mask;
      cbn [Z.b2z]; ring).
    apply S. destruct mask; cbn [Z.b2z]; lia.
Qed.
Lemma in_double_is z : in_double z = true -> - (half * word) <= z < half * word.
Proof. intro h. apply andb_true_iff in h as [a b]. apply Z.leb_le in a. apply Z.ltb_lt in b. lia. Qed.
Theorem plus_is a b x y : holds a x -> holds b y -> holds (plus a b) (x + y).
Proof.
  intros ha hb. pose proof (sum_is a b false x y ha hb) as general. unfold plus.
  destruct (small a) as [u|] eqn:ea, (small b) as [v|] eqn:eb; try exact general.
  destruct (in_double (u + v)) eqn:r; [|exact general]. apply small_is in ea; [|apply ha]. apply small_is in eb;
    [|apply hb].
  destruct ha as (_ & _ & <-), hb as (_ & _ & <-). rewrite ea, eb. now apply double_is, in_double_is.
Qed.
Theorem minus_is a b x y : holds a x -> holds b y -> holds (minus a b) (x - y).
Proof.
  intros ha hb. pose proof (sum_is a b true x y ha hb) as general. unfold minus.
  destruct (small a) as [u|] eqn:ea, (small b) as [v|] eqn:eb; try exact general.
  destruct (in_double (u - v)) eqn:r; [|exact general]. apply small_is in ea; [|apply ha]. apply small_is in eb;
    [|apply hb].
  destruct ha as (_ & _ & <-), hb as (_ & _ & <-). rewrite ea, eb. now apply double_is, in_double_is.
Qed.
Lemma zero_is : holds [] 0.
Proof. split; [constructor|]. split; [now left|apply signed_nil]. Qed.
Theorem negated_is a x : holds a x -> holds (negated a) (- x).
Proof. intro h. exact (minus_is [] a 0 x zero_is h). Qed.
Theorem doubled_is a x : holds a x -> holds (doubled a) (2 * x).
Proof. intro h. replace (2 * x) with (x + x) by ring. now apply plus_is. Qed.
Theorem tripled_is a x : holds a x -> holds (tripled a) (3 * x).
Proof. intro h. replace (3 * x) with (2 * x + x) by ring. apply plus_is; [now apply doubled_is|exact h]. Qed.
Theorem times_is a b x y : holds a x -> holds b y -> holds (times a b) (x * y).
Proof.
  intros (ha & _ & <-) (hb & _ & <-). pose proof half_pos. pose proof two_halves.
  assert (general : holds (without_repeated_sign (multiply_significant_words a b (repeat 0 (length a + length b))))
    (signed a * signed b)).
  { destruct (multiply_significant_words_is (length a) (length b) a b (repeat 0 (length a + length b)) (conj eq_refl ha)
      (conj eq_refl hb) (repeat_length _ _)) as [[_ h] <-]. now apply holds_words. }
  destruct a as [|u a]; [rewrite signed_nil; apply zero_is|].
  destruct b as [|v b]; [rewrite signed_nil, Z.mul_0_r; destruct a; apply zero_is|].
  destruct a as [|u2 a]; [|exact general]. destruct b as [|v2 b]; [|exact general]. clear general.
  inversion ha; inversion hb; subst. rewrite !signed_one. cbn [times]. apply double_is.
  pose proof (cast_range u ltac:(assumption)). pose proof (cast_range v ltac:(assumption)).
  assert (half * half < half * word) by nia. assert (Z.abs (cast_signed u * cast_signed v) <= half * half); [|lia].
  rewrite Z.abs_mul. apply Z.mul_le_mono_nonneg; lia.
Qed.
Theorem minor_is a b c d x y z w : holds a x -> holds b y -> holds c z -> holds d w ->
  holds (minor a b c d) (x * w - y * z).
Proof.
  intros ha hb hc hd. pose proof (minus_is _ _ _ _ (times_is _ _ _ _ ha hd) (times_is _ _ _ _ hb hc)) as general.
  unfold minor. destruct (single a) as [a1|] eqn:ea; [|exact general]. destruct (single b) as [b1|] eqn:eb;
    [|exact general].
  destruct (single c) as [c1|] eqn:ec; [|exact general]. destruct (single d) as [d1|] eqn:ed; [|exact general].
    clear general.
  apply single_is in ea as [ea ra]; [|apply ha]. apply single_is in eb as [eb rb]; [|apply hb].
  apply single_is in ec as [ec rc]; [|apply hc]. apply single_is in ed as [ed rd]; [|apply hd].
  destruct ha as (_ & _ & <-), hb as (_ & _ & <-), hc as (_ & _ & <-), hd as (_ & _ & <-). rewrite ea, eb, ec, ed.
  apply double_is. pose proof half_pos. pose proof two_halves.
  assert (forall p q, - half <= p < half -> - half <= q < half -> - (half * (half - 1)) <= p * q <= half * half) as P.
  { intros p q hp hq. split.
    - assert (0 <= (p + half) * (q + half)) by (apply Z.mul_nonneg_nonneg; lia).
      assert (0 <= (half - 1 - p) * (half - 1 - q)) by (apply Z.mul_nonneg_nonneg; lia).
      assert (0 <= (2 * half - 1) * (p * q + half * (half - 1))); [|nia].
      replace ((2 * half - 1) * (p * q + half * (half - 1))) with
        ((half - 1) * ((p + half) * (q + half)) + half * ((half - 1 - p) * (half - 1 - q))) by ring.
      apply Z.add_nonneg_nonneg; apply Z.mul_nonneg_nonneg; lia.
    - assert (Z.abs p * Z.abs q <= half * half) by (apply Z.mul_le_mono_nonneg; lia). rewrite <- Z.abs_mul in *. lia. }
  pose proof (P a1 d1 ra rd). pose proof (P b1 c1 rb rc). nia.
Qed.
Theorem sum_of_products_is a b c d e f u v w x y z : holds a u -> holds b v -> holds c w -> holds d x -> holds e y ->
  holds f z ->
  holds (sum_of_products a b c d e f) (u * v + w * x + y * z).
Proof. intros. unfold sum_of_products. repeat (apply plus_is || apply times_is); assumption. Qed.
Theorem shifted_is significand shift : - half <= significand < half -> 0 <= shift ->
  holds (shifted significand shift) (significand * 2 ^ shift).
Proof.
  intros s64 s0. unfold shifted. destruct (Z.eqb_spec significand 0) as [->|_]; [rewrite Z.mul_0_l; exact zero_is|].
  destruct (in_two_words _ (wide_is_small significand shift s64 s0)) as [h E].
  rewrite (wide_times significand shift s0). assert (0 <= shift / bits) by (apply Z.div_pos; lia).
  destruct (halves _) as [low high]. destruct (zeros_are_words (Z.to_nat (shift / bits))) as [hz ez].
  assert (V : signed (repeat 0 (Z.to_nat (shift / bits)) ++ [low;
    high]) = significand * 2 ^ (shift mod bits) * word ^ (shift / bits)).
  { rewrite signed_app by discriminate. rewrite ez, E, (modulus_of _ _ hz), Z2Nat.id by assumption. ring. }
  rewrite <- V. apply holds_words. apply Forall_app. split; [apply hz|apply h].
Qed.
End Words.
