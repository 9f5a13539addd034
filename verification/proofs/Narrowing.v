(* Times and lengths from one format to another (core/src/narrowing.rs), on encodings of numbers that are not negative:
   times become no later, lengths no smaller, and their order stays. `Narrowed.v` has what the code returns for numbers
   at and beside each boundary of the formats, and Coq computes the same with the functions of this file. *)
From Coq Require Import Reals ZArith Lra Lia Bool List.
From Flocq Require Import Core.
From Selvedge Require Narrowed.
Open Scope Z_scope.

(* The bits of a fraction; zero's exponent field counts from 2^(1 - bias - bits). *)
Record encoding := Encoding { bits : Z; offset : Z; infinity : Z }.
Definition single := Encoding 23 150 0x7f800000.
Definition double := Encoding 52 1075 0x7ff0000000000000.
Definition value f b : R := if b / 2 ^ bits f =? 0 then (IZR b * bpow radix2 (1 - offset f))%R
  else (IZR (2 ^ bits f + b mod 2 ^ bits f) * bpow radix2 (b / 2 ^ bits f - offset f))%R.

(* The code: `truncated`, `to_f64`, `raised_to_normal` and `next_up` of core/src/scalar.rs, on encodings. *)
Definition dropped := 2 ^ 29.
Definition biases := 896 * 2 ^ 23.
Definition smallest := 897 * 2 ^ 52.
Definition largest := infinity single - 1.
Definition nan f := infinity f + 2 ^ (bits f - 1).
Definition truncated b := if b <? smallest then 0 else if b <=? (largest + biases) * dropped then b / dropped - biases
  else
  if b <? infinity double then largest else if b =? infinity double then infinity single else nan single.
Definition widened c := if c =? 0 then 0
  else if c <? 2 ^ 23 then (Z.log2 c + 874) * 2 ^ 52 + (c - 2 ^ Z.log2 c) * 2 ^ (52 - Z.log2 c)
  else if c <? infinity single then (c + biases) * dropped else if c =? infinity single then infinity double
  else nan double.
Definition raised f b := if (0 <? b) && (b <? 2 ^ bits f) then 2 ^ bits f else b.
Definition rounded_down b := truncated b.
Definition rounded_up b := let b := raised double b in let c := truncated b in
  if (widened c <? b) && (b <=? infinity double) then raised single (c + 1) else c.

(* What the code returned: a time in binary64, rounded down and up, in binary32 and in binary64; a length in binary32 as
   a tolerance and as a separation in binary64. *)
Definition agrees_narrowed '(b, down, up, same, raised_) := (down =? rounded_down b) && (up =? rounded_up b) &&
  (same =? b) && (raised_ =? raised double b).
Definition agrees_widened '(c, tolerance, separation) := (tolerance =? widened c) && (separation =? widened (raised
  single c)).
Theorem the_code_returns_the_same :
  forallb agrees_narrowed Narrowed.narrowed = true /\ forallb agrees_widened Narrowed.widened = true.
Proof. split; vm_compute; reflexivity. Qed.

Section Order.
Variable f : encoding.
Hypothesis some_bits : 0 < bits f.
Notation one := (2 ^ bits f).
Let some : 0 < one. Proof. apply Z.pow_pos_nonneg; lia. Qed.
Lemma value_next b : 0 <= b -> (value f b < value f (b + 1))%R.
Proof.
  intro h. pose proof (Z.div_mod b one ltac:(lia)) as E. pose proof (Z.mod_pos_bound b one some) as M.
  assert (D : 0 <= b / one) by (apply Z.div_pos; lia). set (q := b / one) in *. set (r := b mod one) in *.
  unfold value. fold q r. destruct (Z_lt_le_dec (r + 1) one) as [inside|carry].
  - replace ((b + 1) / one) with q by (apply Z.div_unique with (r + 1); lia).
    replace ((b + 1) mod one) with (r + 1) by (apply Z.mod_unique with q; lia).
    destruct (q =? 0); (apply Rmult_lt_compat_r; [apply bpow_gt_0|apply IZR_lt; lia]).
  - replace ((b + 1) / one) with (q + 1) by (apply Z.div_unique with 0; lia).
    replace ((b + 1) mod one) with 0 by (apply Z.mod_unique with (q + 1); lia).
    replace (q + 1 =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    destruct (Z.eqb_spec q 0) as [->|n].
    + apply Rmult_lt_compat_r; [apply bpow_gt_0|]. apply IZR_lt. lia.
    + replace (q + 1 - offset f) with (1 + (q - offset f)) by ring. rewrite bpow_plus, <- Rmult_assoc.
      apply Rmult_lt_compat_r; [apply bpow_gt_0|]. change (bpow radix2 1) with 2%R. rewrite <- mult_IZR. apply IZR_lt.
        lia.
Qed.
(* Larger encodings are larger numbers. *)
Lemma value_monotone a b : 0 <= a -> a <= b -> (value f a <= value f b)%R.
Proof.
  intros a0 less. replace b with (a + (b - a)) by ring. generalize (b - a), (Zle_minus_le_0 _ _ less). clear b less.
  apply (natlike_ind (fun n => value f a <= value f (a + n))%R).
  - rewrite Z.add_0_r. lra.
  - intros n n0 IH. eapply Rle_trans; [exact IH|]. replace (a + Z.succ n) with (a + n + 1) by ring.
    apply Rlt_le, value_next. lia.
Qed.
Lemma raised_is_no_smaller b : 0 <= b -> b <= raised f b.
Proof. intro h. unfold raised. destruct (Z.ltb_spec 0 b), (Z.ltb_spec b one); cbn; lia. Qed.
End Order.

(* Widening is exact. *)
Lemma widened_value c : 0 <= c < infinity single -> value double (widened c) = value single c.
Proof.
  intros [c0 c1]. unfold widened. destruct (Z.eqb_spec c 0) as [->|n].
  { unfold value; cbn -[bpow]. rewrite !Rmult_0_l. reflexivity. }
  destruct (Z.ltb_spec c (2 ^ 23)) as [small|large].
  - destruct (Z.log2_spec c ltac:(lia)) as [lo hi]. pose proof (Z.log2_nonneg c) as k0.
    assert (k1 : Z.log2 c < 23) by (apply Z.log2_lt_pow2; lia). set (k := Z.log2 c) in *.
    assert (P : 2 ^ k * 2 ^ (52 - k) = 2 ^ 52) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
    assert (P1 : 2 ^ Z.succ k = 2 * 2 ^ k) by (apply Z.pow_succ_r; lia).
    assert (p0 : 0 < 2 ^ (52 - k)) by (apply Z.pow_pos_nonneg; lia).
    set (u := 2 ^ (52 - k)) in *. assert (F : 0 <= (c - 2 ^ k) * u < 2 ^ 52) by nia.
    unfold value; cbn [bits offset double single].
    replace (((k + 874) * 2 ^ 52 + (c - 2 ^ k) * u) / 2 ^ 52) with (k + 874)
      by (apply Z.div_unique with ((c - 2 ^ k) * u); lia).
    replace (((k + 874) * 2 ^ 52 + (c - 2 ^ k) * u) mod 2 ^ 52) with ((c - 2 ^ k) * u)
      by (apply Z.mod_unique with (k + 874); lia).
    replace (k + 874 =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    rewrite (Z.div_small c) by lia. cbn [Z.eqb].
    replace (2 ^ 52 + (c - 2 ^ k) * u) with (c * u) by (rewrite <- P; ring). rewrite mult_IZR, Rmult_assoc. f_equal.
    unfold u. change (IZR (2 ^ (52 - k))) with (IZR (radix2 ^ (52 - k))). rewrite IZR_Zpower by lia.
    rewrite <- bpow_plus. f_equal. lia.
  - replace (c <? infinity single) with true by (symmetry; apply Z.ltb_lt; lia).
    pose proof (Z.div_mod c (2 ^ 23) ltac:(lia)) as E. pose proof (Z.mod_pos_bound c (2 ^ 23) ltac:(lia)) as M.
    assert (q1 : 1 <= c / 2 ^ 23) by (apply Z.div_le_lower_bound; lia).
    set (q := c / 2 ^ 23) in *. set (r := c mod 2 ^ 23) in *. unfold value, biases, dropped; cbn [bits offset double
      single].
    fold q r. replace ((c + 896 * 2 ^ 23) * 2 ^ 29 / 2 ^ 52) with (q + 896) by (apply Z.div_unique with (r * 2 ^ 29);
      lia).
    replace (((c + 896 * 2 ^ 23) * 2 ^ 29) mod 2 ^ 52) with (r * 2 ^ 29) by (apply Z.mod_unique with (q + 896); lia).
    replace (q + 896 =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    replace (q =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    replace (2 ^ 52 + r * 2 ^ 29) with ((2 ^ 23 + r) * 2 ^ 29) by ring. rewrite mult_IZR, Rmult_assoc. f_equal.
    change (IZR (2 ^ 29)) with (bpow radix2 29). rewrite <- bpow_plus. f_equal. lia.
Qed.
(* Where truncating does not give zero, it cuts digits off. *)
Lemma truncated_cases b : 0 <= b < infinity double -> (b < smallest /\ truncated b = 0) \/
  (smallest <= b /\ 2 ^ 23 <= truncated b <= largest /\ widened (truncated b) <= b /\
    (truncated b < largest -> b < widened (truncated b + 1))).
Proof.
  intros [b0 b1]. unfold truncated. destruct (Z.ltb_spec b smallest); [left; auto|right; split; [lia|]].
  destruct (Z.leb_spec b ((largest + biases) * dropped)) as [inside|beyond].
  - pose proof (Z.div_mod b dropped ltac:(discriminate)) as E. pose proof (Z.mod_pos_bound b dropped
    ltac:(reflexivity)) as M.
    set (q := b / dropped) in *. set (r := b mod dropped) in *.
    unfold smallest, largest, biases, dropped, single in *; cbn [infinity] in *.
    assert (A : 2 ^ 23 <= q - 896 * 2 ^ 23 <= 0x7f800000 - 1) by lia. split; [exact A|].
    unfold widened, biases, dropped, single; cbn [infinity].
    replace (q - 896 * 2 ^ 23 =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    replace (q - 896 * 2 ^ 23 <? 2 ^ 23) with false by (symmetry; apply Z.ltb_ge; lia).
    replace (q - 896 * 2 ^ 23 <? 0x7f800000) with true by (symmetry; apply Z.ltb_lt; lia). split; [lia|]. intro less.
    replace (q - 896 * 2 ^ 23 + 1 =? 0) with false by (symmetry; apply Z.eqb_neq; lia).
    replace (q - 896 * 2 ^ 23 + 1 <? 2 ^ 23) with false by (symmetry; apply Z.ltb_ge; lia).
    replace (q - 896 * 2 ^ 23 + 1 <? 0x7f800000) with true by (symmetry; apply Z.ltb_lt; lia). lia.
  - replace (b <? infinity double) with true by (symmetry; apply Z.ltb_lt; lia).
    split; [split; [discriminate|lia]|]. split; [|lia]. change (widened largest) with ((largest + biases) * dropped).
      lia.
Qed.

(* A time that is rounded down is finite and no later. *)
Theorem rounded_down_is_no_later b : 0 <= b < infinity double ->
  0 <= rounded_down b < infinity single /\ (value single (rounded_down b) <= value double b)%R.
Proof.
  intro h. unfold rounded_down. destruct (truncated_cases b h) as [[_ ->]|(_ & range & below & _)].
  - split; [split; [lia|reflexivity]|]. replace (value single 0) with (value double 0).
    + apply value_monotone; [reflexivity|lia|lia].
    + unfold value; cbn -[bpow]. rewrite !Rmult_0_l. reflexivity.
  - split; [unfold largest in range; lia|]. rewrite <- widened_value by (unfold largest in range; lia).
    apply value_monotone; [reflexivity| |exact below]. unfold widened.
    destruct (_ =? 0); [lia|]. destruct (Z.ltb_spec (truncated b) (2 ^ 23)); [lia|].
    replace (truncated b <? infinity single) with true by (symmetry; apply Z.ltb_lt; unfold largest in range; lia).
    unfold biases, dropped. lia.
Qed.
(* A length that is rounded up is no smaller, or infinite. *)
Theorem rounded_up_is_no_smaller b : 0 <= b < infinity double ->
  rounded_up b = infinity single \/ (value double b <= value single (rounded_up b))%R.
Proof.
  intro h. pose proof (raised_is_no_smaller double b (proj1 h)) as R.
  assert (h' : 0 <= raised double b < infinity double).
  { split; [lia|]. unfold raised. destruct (_ && _); [reflexivity|lia]. }
  assert (A : (value double b <= value double (raised double b))%R) by (apply value_monotone; [reflexivity|lia|exact
    R]).
  unfold rounded_up. cbv zeta. set (v := raised double b) in *. clearbody v.
  replace (v <=? infinity double) with true by (symmetry; apply Z.leb_le; lia). rewrite andb_true_r.
  destruct (truncated_cases v h') as [[small E]|(_ & range & below & above)].
  - rewrite E. cbn [widened Z.eqb]. destruct (Z.ltb_spec 0 v).
    + right. change (raised single (0 + 1)) with (2 ^ 23). rewrite <- widened_value by (split; [lia|reflexivity]).
      change (widened (2 ^ 23)) with smallest. eapply Rle_trans; [exact A|]. apply value_monotone;
        [reflexivity|lia|lia].
    + right. replace v with 0 in A by lia. eapply Rle_trans; [exact A|]. unfold value; cbn -[bpow]. rewrite
      !Rmult_0_l. lra.
  - destruct (Z.ltb_spec (widened (truncated v)) v) as [less|same].
    + unfold raised at 1. replace (truncated v + 1 <? 2 ^ bits single) with false
        by (symmetry; apply Z.ltb_ge; cbn [bits single]; lia). rewrite andb_false_r.
      unfold raised. replace (truncated v + 1 <? 2 ^ bits single) with false
        by (symmetry; apply Z.ltb_ge; cbn [bits single]; lia). rewrite andb_false_r.
      destruct (Z.eq_dec (truncated v) largest) as [->|n]; [left; reflexivity|right].
      rewrite <- widened_value by (unfold largest in *; lia). eapply Rle_trans; [exact A|].
      apply value_monotone; [reflexivity|lia|]. apply Z.lt_le_incl, above. lia.
    + right. rewrite <- widened_value by (unfold largest in range; lia). eapply Rle_trans; [exact A|].
      apply value_monotone; [reflexivity|lia|exact same].
Qed.
(* Of two times the earlier never becomes the later. *)
Theorem rounding_down_keeps_the_order a b : 0 <= a <= b -> b < infinity double -> rounded_down a <= rounded_down b.
Proof.
  intros [a0 less] b1. unfold rounded_down, truncated. destruct (Z.ltb_spec a smallest), (Z.ltb_spec b smallest); try
    lia.
  - replace (b <? infinity double) with true by (symmetry; apply Z.ltb_lt; lia). destruct (b <=? _); [|discriminate].
    unfold smallest in *. assert (896 * 2 ^ 23 <= b / dropped); [|unfold biases; lia].
    apply Z.div_le_lower_bound; [reflexivity|unfold dropped; lia].
  - pose proof (Z.div_le_mono a b dropped ltac:(reflexivity) less).
    destruct (Z.leb_spec a ((largest + biases) * dropped)), (Z.leb_spec b ((largest + biases) * dropped)); try lia.
    all: replace (b <? infinity double) with true by (symmetry; apply Z.ltb_lt; lia).
    + enough (a / dropped <= largest + biases) by lia. apply Z.div_le_upper_bound; [reflexivity|lia].
    + replace (a <? infinity double) with true by (symmetry; apply Z.ltb_lt; lia). lia.
Qed.
