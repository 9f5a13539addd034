(* Whole numbers in words of 64 bits: the carries, borrows, rows and signs of core/src/kernels/exact/integer, and the
   control values of kernel.rs, for which there is room. Written after that code by hand, not traced from it. *)
From Coq Require Import ZArith Lia List.
Import ListNotations.
Open Scope Z_scope.

Definition word := 2 ^ 64.
Definition is_word w := 0 <= w < word.
(* Without a sign; the lowest word first. *)
Fixpoint natural ws := match ws with [] => 0 | w :: rest => w + word * natural rest end.
Definition modulus (ws : list Z) := word ^ Z.of_nat (length ws).

(* Addition with carry, word by word: the sum modulo 2^(64 words). *)
Fixpoint plus_words a b carry := match a, b with
  | x :: a, y :: b => let s := x + y + carry in (s mod word) :: plus_words a b (s / word)
  | _, _ => [] end.
Lemma modulus_cons w ws : modulus (w :: ws) = word * modulus ws.
Proof. unfold modulus. cbn [length]. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. reflexivity. Qed.
Lemma natural_range ws : Forall is_word ws -> 0 <= natural ws < modulus ws.
Proof.
  induction 1 as [|w ws hw _ IH]; [cbn; unfold modulus; cbn; lia|]. rewrite modulus_cons. cbn [natural].
    unfold is_word in hw.
  assert (0 < word) by reflexivity. nia.
Qed.
Theorem carries_are_right a b carry : length a = length b -> exists over,
  natural (plus_words a b carry) + modulus a * over = natural a + natural b + carry.
Proof.
  revert b carry. induction a as [|x a IH]; intros [|y b] carry len; try discriminate.
  - exists carry. unfold modulus. cbn [length plus_words natural Z.of_nat]. rewrite Z.pow_0_r. ring.
  - injection len as len. cbn [plus_words natural]. destruct (IH b ((x + y + carry) / word) len) as [over E].
    exists over.
    rewrite modulus_cons. pose proof (Z.div_mod (x + y + carry) word ltac:(discriminate)). nia.
Qed.

(* Two's complement: a number in [-M/2, M/2), M the modulus, is the only one with its remainder; so a result that fits
   is exact. *)
Theorem what_fits_is_exact M a b : 0 < M -> - M <= 2 * a < M -> - M <= 2 * b < M -> a mod M = b mod M -> a = b.
Proof.
  intros pos ha hb same. pose proof (Z.div_mod a M ltac:(lia)) as da. pose proof (Z.div_mod b M ltac:(lia)) as db.
  rewrite same in da. assert (a - b = M * (a / M - b / M)) by lia.
  assert (-1 < a / M - b / M < 1) by nia. assert (a / M - b / M = 0) as z by lia. rewrite z in H. lia.
Qed.

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
  unfold word. rewrite <- Z.pow_mul_r, <- Z.pow_add_r by lia. transitivity (2 ^ 4 * 2 ^ (m + m));
    [|change (2 ^ 6) with 64; change (2 ^ 4) with 16; reflexivity].
  rewrite <- Z.pow_add_r by lia. f_equal. ring.
Qed.
Theorem three_words_suffice x : Z.abs x <= 18 * (2 ^ m * square) -> - (word ^ (3 * n)) <= 2 * x < word ^ (3 * n).
Proof.
  intro h. assert (word ^ (3 * n) = 64 * (2 ^ m * square)) as ->; [|pose proof (Z.pow_pos_nonneg 2 m ltac:(lia)
    ltac:(lia)); nia].
  unfold word. rewrite <- Z.pow_mul_r, <- !Z.pow_add_r by lia. transitivity (2 ^ 6 * 2 ^ (m + (m + m)));
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

(* The number that words are, in two's complement; and what it takes to know it. *)
Definition signed ws := if modulus ws <=? 2 * natural ws then natural ws - modulus ws else natural ws.
Definition words_of n ws := length ws = n /\ Forall is_word ws.
Definition fits n x := - word ^ Z.of_nat n <= 2 * x < word ^ Z.of_nat n.
Lemma modulus_of n ws : words_of n ws -> modulus ws = word ^ Z.of_nat n.
Proof. intros [<- _]. reflexivity. Qed.
Lemma word_pos n : 0 < word ^ Z.of_nat n. Proof. apply Z.pow_pos_nonneg; [reflexivity|lia]. Qed.
Lemma signed_fits n ws : words_of n ws -> fits n (signed ws).
Proof.
  intros h. pose proof (natural_range ws (proj2 h)) as r. rewrite (modulus_of n ws h) in r. unfold signed, fits.
    rewrite (modulus_of n ws h).
  destruct (Z.leb_spec (word ^ Z.of_nat n) (2 * natural ws)); lia.
Qed.
Lemma signed_same n ws : words_of n ws -> exists k, natural ws = signed ws + word ^ Z.of_nat n * k.
Proof.
  intro h. unfold signed. rewrite (modulus_of n ws h). destruct (_ <=? _); [exists 1|exists 0]; ring.
Qed.
(* A number that is right up to multiples of the modulus, and fits, is right. *)
Theorem right_if_it_fits n ws x k : words_of n ws -> fits n x -> natural ws = x + word ^ Z.of_nat n * k -> signed ws =
  x.
Proof.
  intros h fx E. destruct (signed_same n ws h) as [j E']. apply (what_fits_is_exact (word ^ Z.of_nat n));
    [apply word_pos|exact (signed_fits n ws h)|exact fx|].
  replace (signed ws) with (x + (k - j) * word ^ Z.of_nat n) by lia. apply Z_mod_plus_full.
Qed.
Lemma natural_app a b : natural (a ++ b) = natural a + word ^ Z.of_nat (length a) * natural b.
Proof.
  induction a as [|w a IH]; [cbn [app natural length Z.of_nat]; rewrite Z.pow_0_r; ring|].
  cbn [app natural length]. rewrite IH, Nat2Z.inj_succ, Z.pow_succ_r by lia. ring.
Qed.
Lemma a_remainder_is_a_word x : is_word (x mod word). Proof. apply Z.mod_pos_bound. reflexivity. Qed.

(* Sums: `plus`. *)
Lemma plus_is_words n a b carry : words_of n a -> words_of n b -> words_of n (plus_words a b carry).
Proof.
  revert a b carry. induction n as [|n IH]; intros a b carry [la wa] [lb wb]; destruct a as [|x a], b as [|y b];
    try discriminate; [split; [reflexivity|constructor]|].
  cbn [plus_words]. destruct (IH a b ((x + y + carry) / word)) as [l w]; [split;
    [now injection la|now inversion wa]|split; [now injection lb|now inversion wb]|].
  split; [cbn [length]; now rewrite l|]. constructor; [apply a_remainder_is_a_word|exact w].
Qed.
Theorem sums_are_exact n a b : words_of n a -> words_of n b -> fits n (signed a + signed b) ->
  words_of n (plus_words a b 0) /\ signed (plus_words a b 0) = signed a + signed b.
Proof.
  intros ha hb f. pose proof (plus_is_words n a b 0 ha hb) as h. split; [exact h|].
    destruct (signed_same n a ha) as [j ea]. destruct (signed_same n b hb) as [k eb].
  destruct (carries_are_right a b 0 ltac:(destruct ha, hb; congruence)) as [over E]. rewrite (modulus_of n a ha) in E.
  apply (right_if_it_fits n _ _ (j + k - over) h f). lia.
Qed.

(* Differences: `subtract`, with `subtract_with_borrow`. *)
Fixpoint minus_words a b borrow := match a, b with
  | x :: a, y :: b => let d := x - y - borrow in (d mod word) :: minus_words a b (if d <? 0 then 1 else 0)
  | _, _ => [] end.
Lemma borrow_is d : - word <= d < word -> d = d mod word - word * (if d <? 0 then 1 else 0).
Proof.
  intro h. pose proof (Z.div_mod d word ltac:(discriminate)) as E. destruct (Z.ltb_spec d 0).
  - assert (d / word = -1) as q; [|rewrite q in E; lia]. apply Z.le_antisymm; [apply Z.lt_succ_r, Z.div_lt_upper_bound;
    [reflexivity|lia]|].
    apply Z.div_le_lower_bound; [reflexivity|lia].
  - rewrite Z.mod_small by lia. ring.
Qed.
Theorem borrows_are_right n a b borrow : words_of n a -> words_of n b -> 0 <= borrow <= 1 ->
  words_of n (minus_words a b borrow) /\ exists under, natural (minus_words a b borrow) = natural a - natural b - borrow
    + word ^ Z.of_nat n * under.
Proof.
  revert a b borrow. induction n as [|n IH]; intros a b borrow [la wa] [lb wb] one; destruct a as [|x a], b as [|y b];
    try discriminate.
  - split; [split; [reflexivity|constructor]|]. exists borrow. cbn [natural minus_words Z.of_nat]. rewrite Z.pow_0_r.
    ring.
  - inversion wa as [|? ? wx wa']; subst. inversion wb as [|? ? wy wb']; subst. unfold is_word in wx, wy.
    cbn [minus_words natural].
    destruct (IH a b (if x - y - borrow <? 0 then 1 else 0)) as [h [under E]]; [split;
      [now injection la|assumption]|split; [now injection lb|assumption]|destruct (_ <? _); lia|].
    split; [destruct h as [l w]; split; [cbn [length]; now rewrite l|constructor;
      [apply a_remainder_is_a_word|exact w]]|].
    exists under. rewrite E, Nat2Z.inj_succ, Z.pow_succ_r by lia. pose proof (borrow_is (x - y - borrow) ltac:(lia)).
      lia.
Qed.
Theorem differences_are_exact n a b : words_of n a -> words_of n b -> fits n (signed a - signed b) ->
  words_of n (minus_words a b 0) /\ signed (minus_words a b 0) = signed a - signed b.
Proof.
  intros ha hb f. destruct (borrows_are_right n a b 0 ha hb ltac:(lia)) as [h [under E]]. split; [exact h|].
  destruct (signed_same n a ha) as [j ea]. destruct (signed_same n b hb) as [k eb].
    apply (right_if_it_fits n _ _ (j - k + under) h f). lia.
Qed.

(* Products: `multiply`, a row for each word of a on what the rows before have left above. No sum of a row needs more
   than 128 bits. *)
Theorem a_row_fits_128_bits x y w carry : is_word x -> is_word y -> is_word w -> is_word carry -> 0 <= x * y + w + carry
  < 2 ^ 128.
Proof. change (2 ^ 128) with (word * word). unfold is_word. nia. Qed.
Fixpoint row x b above carry := match b, above with
  | y :: b, w :: above => let s := x * y + w + carry in let '(ws, last) := row x b above (s / word) in (s mod word ::
    ws, last)
  | _, _ => ([], carry) end.
Fixpoint multiply a b above := match a with
  | [] => above
  | x :: a => let '(ws, carry) := row x b above 0 in match ws ++ [carry] with low :: rest => low :: multiply a b rest |
    [] => [] end end.
Lemma row_is_right n x b above carry : is_word x -> words_of n b -> words_of n above -> is_word carry -> let '(ws,
  last) := row x b above carry in
  words_of n ws /\ is_word last /\ natural ws + word ^ Z.of_nat n * last = x * natural b + natural above + carry.
Proof.
  intros wx. revert b above carry. induction n as [|n IH]; intros b above carry [lb wb] [la wa] wc;
    destruct b as [|y b], above as [|w above]; try discriminate.
  - cbn [row natural Z.of_nat]. rewrite Z.pow_0_r. split; [split; [reflexivity|constructor]|]. split; [exact wc|ring].
  - inversion wb as [|? ? wy wb']; subst. inversion wa as [|? ? ww wa']; subst. cbn [row].
    pose proof (a_row_fits_128_bits x y w carry wx wy ww wc) as small. set (s := x * y + w + carry) in *.
    assert (ws : is_word (s / word)). { split; [apply Z.div_pos; [lia|reflexivity]|].
      apply Z.div_lt_upper_bound; [reflexivity|]. exact (proj2 small). }
    specialize (IH b above (s / word) ltac:(split; [now injection lb|assumption]) ltac:(split;
      [now injection la|assumption]) ws).
    destruct (row x b above (s / word)) as [rest last]. destruct IH as (h & wl & E). split; [|split; [exact wl|]].
    + destruct h as [l wr]. split; [cbn [length]; now rewrite l|constructor; [apply a_remainder_is_a_word|exact wr]].
    + cbn [natural]. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. pose proof (Z.div_mod s word ltac:(discriminate)).
      unfold s in *. lia.
Qed.
Theorem products_are_right n m a b above : words_of n a -> words_of m b -> words_of m above -> (0 < m)%nat ->
  words_of (n + m) (multiply a b above) /\ natural (multiply a b above) = natural a * natural b + natural above.
Proof.
  intros ha hb habove some_. revert a above ha habove. induction n as [|n IH]; intros a above [la wa] habove;
    destruct a as [|x a]; try discriminate.
  - split; [exact habove|]. cbn [multiply natural]. ring.
  - inversion wa as [|? ? wx wa']; subst. cbn [multiply natural]. pose proof (row_is_right m x b above 0 wx hb habove
    ltac:(split; [lia|reflexivity])) as R.
    destruct (row x b above 0) as [ws carry]. destruct R as ([lw ww] & wc & E).
    assert (all : words_of (S m) (ws ++ [carry])).
    { split; [rewrite app_length, lw; cbn [length]; lia|apply Forall_app; split; [exact ww|constructor;
      [exact wc|constructor]]]. }
    assert (sum : natural (ws ++ [carry]) = x * natural b + natural above) by (rewrite natural_app, lw; cbn [natural];
      lia).
    destruct (ws ++ [carry]) as [|low rest]; [destruct all; discriminate|]. destruct all as [lr wr].
      inversion wr as [|? ? wlow wrest]; subst.
    destruct (IH a rest ltac:(split; [now injection la|assumption]) ltac:(split;
      [now injection lr|assumption])) as [[l w] E2].
    split; [split; [cbn [length]; now rewrite l|constructor; assumption]|]. cbn [natural] in *. lia.
Qed.
(* Signs: a negative factor is 2^(64 words) too much, times the other one, which is taken off above: `times`. *)
Definition is_negative ws := modulus ws <=? 2 * natural ws.
Definition masked (sign : bool) ws := if sign then ws else map (fun _ => 0) ws.
Definition minus_at k p b := firstn k p ++ minus_words (skipn k p) b 0.
Definition times a b :=
  let p := multiply a b (map (fun _ => 0) b) in
  let p := minus_at (length a) p (masked (is_negative a) b) in
  minus_at (length b) p (masked (is_negative b) a).
Lemma zeros_are_words n (ws : list Z) : length ws = n -> words_of n (map (fun _ : Z => 0) ws) /\
  natural (map (fun _ : Z => 0) ws) = 0.
Proof.
  revert n. induction ws as [|w ws IH]; intros n <-; [split; [split; [reflexivity|constructor]|reflexivity]|].
    destruct (IH _ eq_refl) as [[l h] E].
  split; [split; [now rewrite map_length|constructor; [split; [lia|reflexivity]|exact h]]|]. cbn [map natural].
    rewrite E. ring.
Qed.
Lemma masked_is sign n ws : words_of n ws -> words_of n (masked sign ws) /\ natural (masked sign ws) = if sign then
  natural ws else 0.
Proof. intro h. destruct sign; [auto|]. apply zeros_are_words. apply h. Qed.
Lemma minus_at_is k n p b : words_of (k + n) p -> words_of n b ->
  words_of (k + n) (minus_at k p b) /\ exists under, natural (minus_at k p b) = natural p - word ^ Z.of_nat k * natural
    b + word ^ Z.of_nat (k + n) * under.
Proof.
  intros [lp wp] hb. rewrite <- (firstn_skipn k p) in wp. apply Forall_app in wp as [w1 w2].
  assert (l1 : length (firstn k p) = k) by (rewrite firstn_length; lia). assert (l2 : length (skipn k p) = n) by
    (rewrite skipn_length; lia).
  destruct (borrows_are_right n (skipn k p) b 0 (conj l2 w2) hb ltac:(lia)) as [[l w] [under E]]. unfold minus_at.
  split; [split; [rewrite app_length; lia|now apply Forall_app]|]. exists under. rewrite natural_app, l1, E.
    rewrite <- (firstn_skipn k p) at 3.
  rewrite natural_app, l1, Nat2Z.inj_add, Z.pow_add_r by lia. ring.
Qed.
Theorem products_are_exact n m a b : words_of n a -> words_of m b -> (0 < n)%nat -> (0 < m)%nat ->
  words_of (n + m) (times a b) /\ signed (times a b) = signed a * signed b.
Proof.
  intros ha hb n0 m0. pose proof (zeros_are_words m b (proj1 hb)) as [hz ez].
    destruct (products_are_right n m a b _ ha hb hz m0) as [hp ep].
  destruct (masked_is (is_negative a) m b hb) as [hmb emb]. destruct (masked_is (is_negative b) n a ha) as [hma ema].
  unfold times. rewrite (proj1 ha), (proj1 hb). destruct (minus_at_is n m _ _ hp hmb) as [h1 [u1 e1]].
    rewrite Nat.add_comm in h1.
  destruct (minus_at_is m n _ _ h1 hma) as [h2 [u2 e2]]. rewrite (Nat.add_comm m n) in h2, e2. split; [exact h2|].
  pose proof (signed_fits n a ha) as fa. pose proof (signed_fits m b hb) as fb. unfold fits in *.
    pose proof (word_pos n). pose proof (word_pos m).
  assert (pow : word ^ Z.of_nat (n + m) = word ^ Z.of_nat n * word ^ Z.of_nat m) by (rewrite Nat2Z.inj_add,
    Z.pow_add_r by lia; reflexivity).
  assert (sa : natural a = signed a + word ^ Z.of_nat n * (if is_negative a then 1 else 0)).
  { unfold signed, is_negative. rewrite (modulus_of n a ha). destruct (_ <=? _); ring. }
  assert (sb : natural b = signed b + word ^ Z.of_nat m * (if is_negative b then 1 else 0)).
  { unfold signed, is_negative. rewrite (modulus_of m b hb). destruct (_ <=? _); ring. }
  apply (right_if_it_fits (n + m) _ _ (u1 + u2 - (if is_negative a then 1 else 0) * (if is_negative b then 1 else 0))
    h2).
  - unfold fits. rewrite pow. set (A := word ^ Z.of_nat n) in *. set (B := word ^ Z.of_nat m) in *.
    set (x := signed a) in *. set (y := signed b) in *.
    assert (Z.abs (2 * x) <= A) by lia. assert (Z.abs (2 * y) <= B) by lia.
    assert (Z.abs (2 * x) * Z.abs (2 * y) <= A * B) by (apply Z.mul_le_mono_nonneg; lia). rewrite <- Z.abs_mul in H3.
    assert (0 < A * B) by (apply Z.mul_pos_pos; assumption). lia.
  - rewrite e2, e1, ep, ez, emb, ema, pow. rewrite sa, sb. destruct (is_negative a), (is_negative b); ring.
Qed.
(* One word by one or by two, which the code multiplies in 128 bits: the same number. *)
Theorem words_of_a_product z : natural [z mod word; (z / word) mod word] = z mod (word * word).
Proof.
  cbn [natural]. rewrite Z.rem_mul_r by (reflexivity || discriminate). ring.
Qed.
Theorem words_of_one_by_two a b0 b1 : let below := a * b0 in let above := a * b1 + below / word in
  below mod word + word * above = a * (b0 + word * b1).
Proof. cbv zeta. pose proof (Z.div_mod (a * b0) word ltac:(discriminate)). lia. Qed.

(* The sign is that of the top word: `sign`, `sign_word`. *)
Theorem the_top_word_has_the_sign n ws top : words_of n (ws ++ [top]) -> (signed (ws ++ [top]) < 0 <-> word <= 2 * top).
Proof.
  intros [l w]. apply Forall_app in w as [w wt]. inversion wt as [|? ? wtop _]; subst.
    pose proof (natural_range ws w) as r. unfold modulus in r.
  unfold signed, modulus. rewrite natural_app, app_length. cbn [natural length].
    rewrite Nat.add_1_r, Nat2Z.inj_succ, Z.pow_succ_r by lia.
  pose proof (word_pos (length ws)). set (M := word ^ Z.of_nat (length ws)) in *. unfold is_word in wtop.
  assert (E : word = 2 * 2 ^ 63) by reflexivity. destruct (Z.leb_spec (word * M) (2 * (natural ws + M * (top + word *
    0)))); split; nia.
Qed.

(* A coordinate in its axis' unit: `write_shifted`, a significand of 64 bits times a power of two, in n words. *)
Definition shifted_word significand shift i :=
  let first := shift / 64 in let wide := significand * 2 ^ (shift mod 64) in
  if i <? first then 0 else if i =? first then wide mod word else if i =? first + 1 then (wide / word) mod word else if
    significand <? 0 then word - 1 else 0.
Definition shifted n significand shift := map (fun i => shifted_word significand shift (Z.of_nat i)) (seq 0 n).
Lemma digits n x : natural (map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 0 n)) = x mod word ^ Z.of_nat n.
Proof.
  revert x. induction n as [|n IH]; intro x; [cbn; now rewrite Z.mod_1_r|].
  assert (rest : map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 1 n) = map (fun i => ((x / word) / word ^ Z.of_nat
    i) mod word) (seq 0 n)).
  { rewrite <- seq_shift, map_map. apply map_ext. intro i. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia.
    rewrite Z.div_div; [reflexivity|discriminate|apply word_pos]. }
  cbn [seq map natural]. rewrite rest, IH. change (Z.of_nat 0) with 0. rewrite Z.pow_0_r, Z.div_1_r, Nat2Z.inj_succ,
    Z.pow_succ_r by lia.
  rewrite Z.rem_mul_r; [reflexivity|discriminate|apply word_pos].
Qed.
Theorem shifted_is_exact n significand shift : - 2 ^ 63 <= significand < 2 ^ 63 -> 0 <= shift -> fits n (significand * 2
  ^ shift) ->
  words_of n (shifted n significand shift) /\ signed (shifted n significand shift) = significand * 2 ^ shift.
Proof.
  intros s64 s0 f. set (x := significand * 2 ^ shift).
  assert (same : shifted n significand shift = map (fun i => (x / word ^ Z.of_nat i) mod word) (seq 0 n)).
  { apply map_ext. intro i. unfold shifted_word. set (first := shift / 64). set (within := shift mod 64).
    set (wide := significand * 2 ^ within).
    pose proof (Z.div_mod shift 64 ltac:(discriminate)) as E. fold first within in E.
      pose proof (Z.mod_pos_bound shift 64 ltac:(reflexivity)) as w. fold within in w.
    assert (f0 : 0 <= first) by (apply Z.div_pos; lia).
    assert (X : x = wide * word ^ first).
    { unfold x, wide, word. rewrite <- Z.pow_mul_r, <- Z.mul_assoc, <- Z.pow_add_r by lia. do 2 f_equal. lia. }
    assert (W : - (word * word) <= 2 * wide < word * word).
    { unfold wide. assert (1 <= 2 ^ within <= 2 ^ 63) by (split; [apply Z.lt_pred_le, Z.pow_pos_nonneg;
      lia|apply Z.pow_le_mono_r; lia]).
      change (word * word) with (4 * (2 ^ 63 * 2 ^ 63)). nia. }
    destruct (Z.ltb_spec (Z.of_nat i) first) as [low|high].
    - rewrite X. replace first with ((first - Z.of_nat i - 1) + 1 + Z.of_nat i) by ring. rewrite !Z.pow_add_r by lia.
      rewrite Z.mul_assoc, Z.div_mul by (apply Z.pow_nonzero; [discriminate|lia]).
      rewrite Z.pow_1_r, Z.mul_assoc. symmetry. apply Z.mod_mul. discriminate.
    - assert (D : x / word ^ Z.of_nat i = wide / word ^ (Z.of_nat i - first)).
      { rewrite X. replace (Z.of_nat i) with (first + (Z.of_nat i - first)) at 1 by ring. rewrite Z.pow_add_r by lia.
        rewrite <- Z.div_div by (try apply Z.pow_nonzero; try apply Z.pow_pos_nonneg; try discriminate;
          try reflexivity; lia).
        now rewrite Z.div_mul by (apply Z.pow_nonzero; [discriminate|lia]). }
      rewrite D. destruct (Z.eqb_spec (Z.of_nat i) first) as [e|ne]; [rewrite e, Z.sub_diag, Z.pow_0_r, Z.div_1_r;
        reflexivity|].
      destruct (Z.eqb_spec (Z.of_nat i) (first + 1)) as [e|ne1]; [rewrite e; replace (first + 1 - first) with 1 by ring;
        now rewrite Z.pow_1_r|].
      assert (big : word * word <= word ^ (Z.of_nat i - first)).
      { replace (word * word) with (word ^ 2) by reflexivity. apply Z.pow_le_mono_r; [reflexivity|lia]. }
      assert (signs : (significand <? 0) = (wide <? 0)).
      { unfold wide. assert (0 < 2 ^ within) by (apply Z.pow_pos_nonneg; lia).
        destruct (Z.ltb_spec significand 0), (Z.ltb_spec (significand * 2 ^ within) 0); try reflexivity; nia. }
      rewrite signs. destruct (Z.ltb_spec wide 0).
      + assert (wide / word ^ (Z.of_nat i - first) = -1) as ->; [|reflexivity].
        apply Z.le_antisymm; [apply Z.lt_succ_r, Z.div_lt_upper_bound; lia|apply Z.div_le_lower_bound; lia].
      + rewrite Z.div_small by lia. reflexivity. }
  assert (h : words_of n (shifted n significand shift)).
  { rewrite same. split; [now rewrite map_length, seq_length|]. apply Forall_forall. intros v i.
    apply in_map_iff in i as (k & <- & _). apply a_remainder_is_a_word. }
  split; [exact h|]. apply (right_if_it_fits n _ _ (- (x / word ^ Z.of_nat n)) h f). rewrite same, digits.
  pose proof (Z.div_mod x (word ^ Z.of_nat n) ltac:(pose proof (word_pos n); lia)). fold x. lia.
Qed.

(* Control values, as kernel.rs computes them: cross products in 2n words, products with them in 3n. *)
Definition plus a b := plus_words a b 0.
Definition minus a b := minus_words a b 0.
Definition is n ws x := words_of n ws /\ signed ws = x.
Lemma is_sum n a b x y : is n a x -> is n b y -> fits n (x + y) -> is n (plus a b) (x + y).
Proof. intros [ha <-] [hb <-] f. exact (sums_are_exact n a b ha hb f). Qed.
Lemma is_difference n a b x y : is n a x -> is n b y -> fits n (x - y) -> is n (minus a b) (x - y).
Proof. intros [ha <-] [hb <-] f. exact (differences_are_exact n a b ha hb f). Qed.
Lemma is_product n m a b x y : (0 < n)%nat -> (0 < m)%nat -> is n a x -> is m b y -> is (n + m) (times a b) (x * y).
Proof. intros n0 m0 [ha <-] [hb <-]. exact (products_are_exact n m a b ha hb n0 m0). Qed.
Record triple T := Triple { x_ : T; y_ : T; z_ : T }.
Arguments Triple {T}. Arguments x_ {T}. Arguments y_ {T}. Arguments z_ {T}.
Section Polynomials.
Context {T : Type} (plus_ minus_ times_ : T -> T -> T).
Definition cross_of a b := Triple (minus_ (times_ (y_ a) (z_ b)) (times_ (z_ a) (y_ b)))
  (minus_ (times_ (z_ a) (x_ b)) (times_ (x_ a) (z_ b))) (minus_ (times_ (x_ a) (y_ b)) (times_ (y_ a) (x_ b))).
Definition sum_of a b := Triple (plus_ (x_ a) (x_ b)) (plus_ (y_ a) (y_ b)) (plus_ (z_ a) (z_ b)).
Definition dot_of a b := plus_ (plus_ (times_ (x_ a) (x_ b)) (times_ (y_ a) (y_ b))) (times_ (z_ a) (z_ b)).
(* k0 and k3; 3 k1 and 3 k2. *)
Definition outer_of p b c := dot_of p (cross_of b c).
Definition inner_of p b b' c c' p' b'' c'' := plus_ (dot_of p (sum_of (cross_of b c) (cross_of b' c'))) (dot_of p'
  (cross_of b'' c'')).
End Polynomials.
Section Widths.
Variable n : nat.
Hypothesis some : (0 < n)%nat.
Notation m := (64 * Z.of_nat n - 2).
Notation square := (2 ^ m * 2 ^ m).
Definition all_are k ws v := is k (x_ ws) (x_ v) /\ is k (y_ ws) (y_ v) /\ is k (z_ ws) (z_ v).
Definition all_below b v := Z.abs (x_ v) <= b /\ Z.abs (y_ v) <= b /\ Z.abs (z_ v) <= b.
Lemma fits_two x : Z.abs x <= 6 * square -> fits (n + n) x.
Proof. intro h. unfold fits. pose proof (two_words_suffice (Z.of_nat n) ltac:(lia) x h) as w.
  replace (Z.of_nat (n + n)) with (2 * Z.of_nat n) by lia. exact w. Qed.
Lemma fits_three x : Z.abs x <= 18 * (2 ^ m * square) -> fits (n + (n + n)) x.
Proof. intro h. unfold fits. pose proof (three_words_suffice (Z.of_nat n) ltac:(lia) x h) as w.
  replace (Z.of_nat (n + (n + n))) with (3 * Z.of_nat n) by lia. exact w. Qed.
Lemma square_pos : 0 < square. Proof. assert (0 < 2 ^ m) by (apply Z.pow_pos_nonneg; lia). now apply Z.mul_pos_pos. Qed.
Theorem crosses_are_exact a b v w : all_are n a v -> all_are n b w -> all_below (2 ^ m) v -> all_below (2 ^ m) w ->
  all_are (n + n) (cross_of minus times a b) (cross_of Z.sub Z.mul v w) /\ all_below (2 * square) (cross_of Z.sub Z.mul
    v w).
Proof.
  intros (ax & ay & az) (bx & by_ & bz) (vx & vy & vz) (wx & wy & wz). pose proof square_pos.
  pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (y_ v) (z_ w) (z_ v) (y_ w) vy wz vz wy) as X.
  pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (z_ v) (x_ w) (x_ v) (z_ w) vz wx vx wz) as Y.
  pose proof (crosses_have_room (Z.of_nat n) ltac:(lia) (x_ v) (y_ w) (y_ v) (x_ w) vx wy vy wx) as Z_.
  split; [|exact (conj X (conj Y Z_))].
  split; [|split]; cbn [cross_of x_ y_ z_]; apply is_difference; try (apply is_product; assumption); apply fits_two;
    lia.
Qed.
Theorem sums_of_crosses_are_exact a b v w : all_are (n + n) a v -> all_are (n + n) b w -> all_below (2 * square) v ->
  all_below (2 * square) w ->
  all_are (n + n) (sum_of plus a b) (sum_of Z.add v w) /\ all_below (4 * square) (sum_of Z.add v w).
Proof.
  intros (ax & ay & az) (bx & by_ & bz) (vx & vy & vz) (wx & wy & wz). pose proof square_pos. split.
  - split; [|split]; cbn [sum_of x_ y_ z_]; apply is_sum; try assumption; apply fits_two; lia.
  - split; [|split]; cbn [sum_of x_ y_ z_]; lia.
Qed.
Theorem dots_are_exact k a b v w : 0 <= k <= 4 -> all_are n a v -> all_are (n + n) b w -> all_below (2 ^ m) v ->
  all_below (k * square) w ->
  is (n + (n + n)) (dot_of plus times a b) (dot_of Z.add Z.mul v w) /\ Z.abs (dot_of Z.add Z.mul v w) <= 3 * (2 ^ m * (k
    * square)).
Proof.
  intros k4 (ax & ay & az) (bx & by_ & bz) (vx & vy & vz) (wx & wy & wz). pose proof square_pos.
    assert (0 < 2 ^ m) by (apply Z.pow_pos_nonneg; lia).
  pose proof (product_below _ _ _ _ vx wx). pose proof (product_below _ _ _ _ vy wy).
    pose proof (product_below _ _ _ _ vz wz).
  assert (0 < 2 ^ m * square) by (now apply Z.mul_pos_pos). assert (2 ^ m * (k * square) <= 4 * (2 ^ m * square)) by
    nia. unfold dot_of. split.
  - apply is_sum; [apply is_sum|apply is_product; try assumption; lia|]; [apply is_product; try assumption; lia..| |];
    apply fits_three; lia.
  - lia.
Qed.
Theorem outer_control_values_are_exact p b c vp vb vc : all_are n p vp -> all_are n b vb -> all_are n c vc ->
  all_below (2 ^ m) vp -> all_below (2 ^ m) vb -> all_below (2 ^ m) vc -> is (n + (n + n)) (outer_of plus minus times p
    b c) (outer_of Z.add Z.sub Z.mul vp vb vc).
Proof.
  intros hp hb hc sp sb sc. destruct (crosses_are_exact b c vb vc hb hc sb sc) as [h s].
    exact (proj1 (dots_are_exact 2 _ _ _ _ ltac:(lia) hp h sp s)).
Qed.
Theorem inner_control_values_are_exact p b b' c c' p' b'' c'' vp vb vb' vc vc' vp' vb'' vc'' :
  all_are n p vp -> all_are n b vb -> all_are n b' vb' -> all_are n c vc -> all_are n c' vc' -> all_are n p' vp' ->
    all_are n b'' vb'' -> all_are n c'' vc'' ->
  all_below (2 ^ m) vp -> all_below (2 ^ m) vb -> all_below (2 ^ m) vb' -> all_below (2 ^ m) vc -> all_below (2 ^ m) vc'
    -> all_below (2 ^ m) vp' ->
  all_below (2 ^ m) vb'' -> all_below (2 ^ m) vc'' ->
  is (n + (n + n)) (inner_of plus minus times p b b' c c' p' b'' c'') (inner_of Z.add Z.sub Z.mul vp vb vb' vc vc' vp'
    vb'' vc'').
Proof.
  intros hp hb hb' hc hc' hp' hb'' hc'' sp sb sb' sc sc' sp' sb'' sc''.
  destruct (crosses_are_exact b c vb vc hb hc sb sc) as [h1 s1]. destruct (crosses_are_exact b' c' vb' vc' hb' hc' sb'
    sc') as [h2 s2].
  destruct (crosses_are_exact b'' c'' vb'' vc'' hb'' hc'' sb'' sc'') as [h3 s3].
    destruct (sums_of_crosses_are_exact _ _ _ _ h1 h2 s1 s2) as [h s].
  destruct (dots_are_exact 4 _ _ _ _ ltac:(lia) hp h sp s) as [hd sd]. destruct (dots_are_exact 2 _ _ _ _ ltac:(lia) hp'
    h3 sp' s3) as [he se].
  apply is_sum; [exact hd|exact he|]. apply fits_three. lia.
Qed.
End Widths.
