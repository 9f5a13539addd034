(* Whole numbers in words of 64 bits: what core/src/kernels/exact/integer.rs does with carries, and that kernel.rs has room. Written from
   its documentation by hand, not traced. *)
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
  induction 1 as [|w ws hw _ IH]; [cbn; unfold modulus; cbn; lia|]. rewrite modulus_cons. cbn [natural]. unfold is_word in hw.
  assert (0 < word) by reflexivity. nia.
Qed.
Theorem carries_are_right a b carry : length a = length b -> exists over,
  natural (plus_words a b carry) + modulus a * over = natural a + natural b + carry.
Proof.
  revert b carry. induction a as [|x a IH]; intros [|y b] carry len; try discriminate.
  - exists carry. unfold modulus. cbn [length plus_words natural Z.of_nat]. rewrite Z.pow_0_r. ring.
  - injection len as len. cbn [plus_words natural]. destruct (IH b ((x + y + carry) / word) len) as [over E]. exists over.
    rewrite modulus_cons. pose proof (Z.div_mod (x + y + carry) word ltac:(discriminate)). nia.
Qed.

(* Two's complement: a number in [-M/2, M/2), M the modulus, is the only one with its remainder; so a result that fits is exact. *)
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
  unfold word. rewrite <- Z.pow_mul_r, <- Z.pow_add_r by lia. transitivity (2 ^ 4 * 2 ^ (m + m)); [|change (2 ^ 6) with 64; change (2 ^ 4) with 16; reflexivity].
  rewrite <- Z.pow_add_r by lia. f_equal. ring.
Qed.
Theorem three_words_suffice x : Z.abs x <= 18 * (2 ^ m * square) -> - (word ^ (3 * n)) <= 2 * x < word ^ (3 * n).
Proof.
  intro h. assert (word ^ (3 * n) = 64 * (2 ^ m * square)) as ->; [|pose proof (Z.pow_pos_nonneg 2 m ltac:(lia) ltac:(lia)); nia].
  unfold word. rewrite <- Z.pow_mul_r, <- !Z.pow_add_r by lia. transitivity (2 ^ 6 * 2 ^ (m + (m + m))); [|change (2 ^ 6) with 64; change (2 ^ 4) with 16; reflexivity].
  rewrite <- Z.pow_add_r by lia. f_equal. ring.
Qed.
Lemma dot_below k px py pz nx ny nz : small px -> small py -> small pz -> Z.abs nx <= k -> Z.abs ny <= k -> Z.abs nz <= k ->
  Z.abs (px * nx + py * ny + pz * nz) <= 3 * (2 ^ m * k).
Proof.
  intros x y z a b c. pose proof (product_below _ _ _ _ x a). pose proof (product_below _ _ _ _ y b). pose proof (product_below _ _ _ _ z c). lia.
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
