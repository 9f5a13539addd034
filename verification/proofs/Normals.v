(* The filter's bound of the length of a normal is at least the length of each of its exact control points, for both
   kinds of pairs: MovingTetrahedron::largest_normal in core/src/kernels/coplanarity.rs. *)
From Coq Require Import Reals ZArith Lra Lia Bool Psatz.
From Flocq Require Import Core.
From Selvedge Require Import Arithmetic Machine Nearness Corners Least.
From Selvedge Require Expressions Errors Bounds Culling Decisions Permanent Magnitudes Filter Beyond.
Open Scope R_scope.

Section Vectors.
(* A vector that is off by d along each axis is at most sqrt 3 times d longer. *)
Lemma longer (x y : Expressions.axis -> R) X d : 0 <= X -> 0 <= d -> squared x <= X ^ 2 ->
  (forall a, Rabs (y a - x a) <= d) -> squared y <= (X + 1.7321 * d) ^ 2.
Proof.
  intros X0 d0 xX near_. unfold squared, sum3 in *.
  pose proof (near_ Expressions.X) as nx. pose proof (near_ Expressions.Y) as ny. pose proof (near_ Expressions.Z_) as
    nz.
  set (x0 := x Expressions.X) in *. set (x1 := x Expressions.Y) in *. set (x2 := x Expressions.Z_) in *.
  set (u := y Expressions.X - x0) in *. set (v := y Expressions.Y - x1) in *. set (w := y Expressions.Z_ - x2) in *.
  replace (y Expressions.X) with (x0 + u) by (unfold u; ring). replace (y Expressions.Y) with (x1 + v) by (unfold v;
    ring). replace (y Expressions.Z_) with (x2 + w) by (unfold w; ring). clearbody u v w.
  assert (sq : forall t, Rabs t <= d -> t * t <= d * d).
  { intros t h. rewrite <- (Rabs_pos_eq (t * t)) by apply Rle_0_sqr. rewrite Rabs_mult.
    apply Rmult_le_compat; auto using Rabs_pos. }
  pose proof (sq u nx). pose proof (sq v ny). pose proof (sq w nz).
  assert (schwarz : (x0 * u + x1 * v + x2 * w) ^ 2 <= (x0 * x0 + x1 * x1 + x2 * x2) * (u * u + v * v + w * w)).
  { pose proof (pow2_ge_0 (x0 * v - x1 * u)). pose proof (pow2_ge_0 (x1 * w - x2 * v)).
    pose proof (pow2_ge_0 (x2 * u - x0 * w)). lra. }
  assert (S0 : 0 <= x0 * x0 + x1 * x1 + x2 * x2).
  { pose proof (Rle_0_sqr x0). pose proof (Rle_0_sqr x1). pose proof (Rle_0_sqr x2). unfold Rsqr in *. lra. }
  assert (D0 : 0 <= u * u + v * v + w * w).
  { pose proof (Rle_0_sqr u). pose proof (Rle_0_sqr v). pose proof (Rle_0_sqr w). unfold Rsqr in *. lra. }
  assert (big : (x0 * u + x1 * v + x2 * w) ^ 2 <= X ^ 2 * (3 * (d * d))).
  { eapply Rle_trans; [exact schwarz|]. apply Rmult_le_compat; lra. }
  assert (t : x0 * u + x1 * v + x2 * w <= 1.7321 * (X * d)).
  { apply Rnot_lt_le. intro h. assert (0 <= X * d) by (apply Rmult_le_pos; lra).
    assert ((1.7321 * (X * d)) * (1.7321 * (X * d)) < (x0 * u + x1 * v + x2 * w) * (x0 * u + x1 * v + x2 * w)).
    { apply Rmult_le_0_lt_compat; lra. }
    replace ((1.7321 * (X * d)) * (1.7321 * (X * d))) with ((1.7321 * 1.7321) * (X ^ 2 * (d * d))) in H3 by ring.
    assert (0 <= X ^ 2 * (d * d)) by (apply Rmult_le_pos; [apply pow_le; lra|apply Rle_0_sqr]). lra. }
  replace ((X + 1.7321 * d) ^ 2) with (X ^ 2 + 2 * (1.7321 * (X * d)) + 1.7321 * 1.7321 * (d * d)) by ring.
  assert (0 <= d * d) by apply Rle_0_sqr. lra.
Qed.
(* The root of a square that is too large by as much as η outgrows a loss by flushing. *)
Lemma root_covers e l X s : 0 < l -> 1099511627776 * l <= e -> e <= / 8388608 -> 0 <= X -> 0 <= s <= 190 * l ->
  X + s <= (1 + 8.7 * e) * sqrt ((1 - 6 * e) * X ^ 2 + 499 * l).
Proof.
  intros l0 le es X0 sl. assert (X2 : 0 <= X ^ 2) by (apply pow_le; lra).
  assert (0 <= (1 - 6 * e) * X ^ 2) by (apply Rmult_le_pos; lra).
  assert (eX : 0 <= e * X ^ 2) by (apply Rmult_le_pos; lra).
  assert (eeX : 0 <= e * (e * X ^ 2) <= / 8388608 * (e * X ^ 2)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (eeeX : 0 <= e * (e * (e * X ^ 2)) <= / 8388608 * (e * (e * X ^ 2))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (el : 0 <= e * l) by (apply Rmult_le_pos; lra).
  assert (eel : 0 <= e * (e * l)) by (apply Rmult_le_pos; lra).
  rewrite <- (sqrt_square (1 + 8.7 * e)) by lra. rewrite <- sqrt_mult by (try apply Rle_0_sqr; lra).
  rewrite <- (sqrt_square (X + s)) by lra. apply sqrt_le_1_alt.
  replace ((X + s) * (X + s)) with (X ^ 2 + 2 * (X * s) + s * s) by ring.
  assert (ss : s * s <= 190 * l * (190 * l)) by (apply Rmult_le_compat; lra).
  assert (ll : l * l <= / 1000000 * l) by (apply Rmult_le_compat_r; lra).
  assert (Xs : X * s <= 190 * l + 190 * l * X ^ 2).
  { assert (X * s <= X * (190 * l)) by (apply Rmult_le_compat_l; lra). destruct (Rle_lt_dec X 1).
    - assert (X * (190 * l) <= 1 * (190 * l)) by (apply Rmult_le_compat_r; lra).
      assert (0 <= l * X ^ 2) by (apply Rmult_le_pos; lra). lra.
    - assert (X * (190 * l) <= X ^ 2 * (190 * l)).
      { apply Rmult_le_compat_r; [lra|]. replace (X ^ 2) with (X * X) by ring.
        apply Rle_trans with (1 * X); [lra|apply Rmult_le_compat_r; lra]. } lra. }
  assert (lX : l * X ^ 2 <= / 1099511627776 * (e * X ^ 2)).
  { replace (/ 1099511627776 * (e * X ^ 2)) with (/ 1099511627776 * e * X ^ 2) by ring. apply Rmult_le_compat_r; lra. }
  lra.
Qed.
End Vectors.

(* The code's terms, as expressions of the filter. *)
Notation expr := (Expressions.expr_of Expressions.component).
Definition edge e t a : expr := Expressions.Difference (Expressions.Component e t a).
Definition less (u v : Expressions.axis -> expr) a := Expressions.Minus (u a) (v a).
Definition cross_ (u v : Expressions.axis -> expr) a := let part b c := Expressions.Minus (Expressions.Product (u b) (v
  c)) (Expressions.Product (u c) (v b)) in match a with
  | Expressions.X => part Expressions.Y Expressions.Z_
  | Expressions.Y => part Expressions.Z_ Expressions.X
  | Expressions.Z_ => part Expressions.X Expressions.Y end.
Inductive kind := VertexFace | EdgeEdge.
Definition first kind t := match kind with
  | VertexFace => edge Expressions.B t | EdgeEdge => less (edge Expressions.C t) (edge Expressions.B t) end.
Definition second kind t := match kind with VertexFace => edge Expressions.C t | EdgeEdge => edge Expressions.P t end.
(* n₀, h and n₁. *)
Inductive place := Early | Middle | Late.
Definition normal kind i a := match i with
  | Early => cross_ (first kind Expressions.Start) (second kind Expressions.Start) a
  | Middle => Expressions.Sum (cross_ (first kind Expressions.Start) (second kind Expressions.End) a)
      (cross_ (first kind Expressions.End) (second kind Expressions.Start) a)
  | Late => cross_ (first kind Expressions.End) (second kind Expressions.End) a end.
Definition of_kind kind := match kind with VertexFace => Filter.vertex_face | EdgeEdge => Filter.edge_edge end.
Notation term_of kind := (term (of_kind kind)).
Definition normal_term kind i := each (fun a => term_of kind (normal kind i a)).
Definition half := Constant Half.
Definition squares kind := Larger (Larger (dot_ (normal_term kind Early) (normal_term kind Early))
  (Product half (Product half (dot_ (normal_term kind Middle) (normal_term kind Middle)))))
  (dot_ (normal_term kind Late) (normal_term kind Late)).
Definition length kind := Root (Sum (squares kind) (Constant Underflow)).
Definition largest_ := Magnitudes.by_axis.
Definition rounding : expr := Expressions.Product (Expressions.Product (Expressions.Constant (Expressions.Small 128))
  (Expressions.Constant Expressions.UnitRoundoff)) (Expressions.Product largest_ largest_).
Definition slack_ : expr := Expressions.Sum (Expressions.Constant (Expressions.Small 1)) (Expressions.Product
  (Expressions.Constant (Expressions.Small 32)) (Expressions.Constant Expressions.UnitRoundoff)).
Definition largest_normal kind := Product (Sum (length kind) (term_of kind rounding)) (term_of kind slack_).
Theorem traced_normals : Beyond.a_vertex_and_a_face.largest_normal = largest_normal VertexFace /\
  Beyond.two_edges.largest_normal = largest_normal EdgeEdge.
Proof. split; vm_compute; reflexivity. Qed.

Section Normals.
Load "Setting.section".
Variable k : kind.
Notation L := (power (largest_edge f)).
Notation at_least := at_least.
Definition from c := given (Place (snd (of_kind k c))).
Definition to c := given (Place (fst (of_kind k c))).
Definition told_of e := told (value_of (term_of k e)).
Definition executed : Expressions.execution f from to told_of := terms_are_executed (of_kind k) f env given value_of
  run.
Hypothesis in_range : forall c, exists x, told_of (Expressions.Difference c) = Expressions.Number x /\ Rabs x <=
  Errors.reach f.
(* The same, and the largest magnitude is below the limit. *)
Notation val := (Errors.val told_of).
Notation d := (Bounds.computed told_of).
Notation D := (Culling.exactly from to).
Notation M := (val largest_).
Hypothesis small : forall c, Rabs (d c) <= L.
Notation run_sum := (run_sum f env given value_of run).
Notation run_product := (run_product f env given value_of run).
Notation run_larger := (run_larger f env given value_of run).
Notation run_root := (run_root f env given value_of run).
Notation run_constant := (run_constant f env given value_of run).
Lemma number e : Expressions.fits e = true -> value_of (term_of k e) = Number (val e).
Proof.
  intro h. pose proof (Errors.is_number f ok from to told_of executed in_range e h) as E. unfold told_of in E at 1.
  destruct (value_of (term_of k e)) as [x| |]; try discriminate. cbn in E. now injection E as ->.
Qed.
Lemma L_1 : 1 <= L. Proof. change 1 with (bpow radix2 0). apply bpow_le. destruct ok; lia. Qed.
Lemma L_4 : 256 * (L * L * (L * L)) <= 1.0000002 * omega f.
Proof.
  assert (A : 256 * (L * L * (L * L)) <= power (greatest_exponent f)).
  { unfold power. rewrite <- !bpow_plus. change 256 with (bpow radix2 8). rewrite <- bpow_plus. apply bpow_le.
    pose proof (squares_ok := Corners.squares f fine). lia. }
  pose proof (bpow_gt_0 radix2 (greatest_exponent f)) as P0.
  assert (B : 16777216 * power (greatest_exponent f - precision f) <= power (greatest_exponent f)).
  { unfold power. change 16777216 with (bpow radix2 24). rewrite <- bpow_plus. apply bpow_le. destruct ok; lia. }
  unfold omega, power in *. lra.
Qed.
Lemma largest_pos : 0 <= M.
Proof. exact (Culling.maxima_pos f ok from to told_of executed in_range largest_ eq_refl eq_refl). Qed.
Definition Mx := Rmax M l.
Lemma d_small c : Rabs (d c) <= Mx.
Proof.
  exact (Culling.maxima_bound f ok from to told_of executed in_range largest_ c eq_refl eq_refl
    (Magnitudes.all_occur_by_axis c)).
Qed.
Lemma Mx_facts : 0 <= Mx /\ M <= Mx /\ Mx * Mx <= M * M + l * l /\ Mx <= 1 + M.
Proof.
  pose proof largest_pos. pose proof (l_pos f). pose proof (l_small f ok). unfold Mx, Rmax.
  assert (0 <= M * M) by (apply Rmult_le_pos; lra). assert (0 <= l * l) by (apply Rmult_le_pos; lra).
  destruct (Rle_dec M l); repeat split; lra.
Qed.

(* A component of a control point is near the exact one. *)
Definition weight i := match i with Middle => / 2 | _ => 1 end.
Lemma by_constant x e n : 0 <= x -> (forall c, Rabs (d c) <= x) ->
  (forall y, 0 <= y -> Expressions.permanent (fun _ => y) e = n * (y * y)) -> Expressions.permanent d e <= n * (x * x).
Proof.
  intros x0 all count. rewrite <- (count x x0). apply Magnitudes.permanent_monotone. intro c. rewrite (Rabs_pos_eq x
    x0).
  apply all.
Qed.
Definition count i := match i with Middle => 8 | _ => 4 end.
Lemma permanent_of i a x : 0 <= x -> (forall c, Rabs (d c) <= x) ->
  Expressions.permanent d (normal k i a) <= count i * (x * x).
Proof.
  intros x0 all. assert (0 <= x * x) by (apply Rmult_le_pos; lra).
  destruct k; [apply Rle_trans with (count i / 2 * (x * x)); [|destruct i; cbn; lra]|];
    (apply by_constant; [exact x0|exact all|]); intros y y0; destruct i, a;
    cbv -[Rplus Rminus Rmult Ropp Rabs IZR Rdiv Rinv]; rewrite ?(Rabs_pos_eq y) by exact y0; field.
Qed.
Lemma normal_is_near i a : Rabs (val (normal k i a) - Expressions.exact D (normal k i a)) <=
  (match i with Middle => 48.2 | _ => 24.1 end * e1 * (Mx * Mx) + match i with Middle => 104 | _ => 52
    end * (l * (1 + M))).
Proof.
  pose proof Mx_facts as (Mx0 & MMx & _ & Mx1). pose proof largest_pos as M0.
  set (e := normal k i a). set (m := 1 + M).
  assert (poly : Expressions.polynomial e = true) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (fit : Expressions.fits e = true) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (sig : Bounds.signed e = true) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (deg : Expressions.degree e = 2%nat) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (dep : (Expressions.depth e <= match i with Middle => 4 | _ => 3 end)%nat) by (unfold e; destruct k, i, a;
    vm_compute; lia).
  assert (steps : (Expressions.of_steps e + Expressions.of_differences e <= match i with Middle => 104 | _ => 52
    end)%Z) by (unfold e; destruct k, i, a; vm_compute; discriminate).
  assert (m1 : 1 <= m) by (unfold m; lra). assert (dm : forall c, Rabs (d c) <= m).
  { intro c. pose proof (d_small c). unfold m. lra. }
  pose proof (Bounds.error_of_steps f ok m m1 from to told_of executed in_range dm e poly fit) as S.
  pose proof (Bounds.error_of_differences f ok m m1 d D dm (Culling.off f ok from to told_of executed in_range) e poly
    sig ltac:(lia)) as X. unfold Bounds.within in S. rewrite deg in S, X. cbn [Init.Nat.pred] in S, X. rewrite pow_1 in
      S, X.
  pose proof (permanent_of i a Mx Mx0 d_small) as P. pose proof (Bounds.permanent_pos d e) as P0. fold e in P.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f).
  pose proof (Bounds.q_mono f _ _ dep) as qm. pose proof (Bounds.q_ge f (Expressions.depth e)).
  pose proof (q_linear f ok 2 ltac:(lia)) as q2. replace (INR 2) with 2 in q2 by (simpl; ring).
  pose proof (Bounds.q_ge f 2).
  set (pp := Expressions.permanent d e) in *.
  assert (mm : 0 <= Mx * Mx) by (apply Rmult_le_pos; lra). assert (em : 0 <= e1 * (Mx * Mx)) by (apply Rmult_le_pos;
    lra).
  assert (lm : 0 <= l * m) by (apply Rmult_le_pos; lra).
  assert (st : l * m * (IZR (Expressions.of_steps e) + IZR (Expressions.of_differences e)) <= l * m * match i with
    Middle => 104 | _ => 52 end).
  { apply Rmult_le_compat_l; [lra|]. rewrite <- plus_IZR. destruct i; apply IZR_le; exact steps. }
  assert (N : (Bounds.q f (Expressions.depth e) - 1) * pp + (Bounds.q f 2 - 1) * pp <= match i with Middle => 48.2 | _
    => 24.1 end * (e1 * (Mx * Mx))).
  { rewrite <- Rmult_plus_distr_r. destruct i; cbn [count] in P.
    1, 3: pose proof (q_linear f ok 3 ltac:(lia)) as q3; replace (INR 3) with 3 in q3 by (simpl; ring);
      apply Rle_trans with ((5.01 * e1) * (4 * (Mx * Mx))); [apply Rmult_le_compat; lra|lra].
    pose proof (q_linear f ok 4 ltac:(lia)) as q4; replace (INR 4) with 4 in q4 by (simpl; ring).
    apply Rle_trans with ((6.01 * e1) * (8 * (Mx * Mx))); [apply Rmult_le_compat; lra|lra]. }
  apply Rabs_le_inv in S. apply Rabs_le_inv in X. fold m.
  apply Rabs_le. destruct i; lra.
Qed.

(* Nothing overflows in its square. *)
Hypothesis M_L : M <= L.
Lemma L_2 : 1073741824 * (L * L) <= omega f.
Proof. pose proof (G_2 f fine) as h. unfold Errors.reach in h. pose proof L_1. assert (0 <= L * L) by (apply
  Rmult_le_pos; lra). lra. Qed.
Lemma normal_size i a : Rabs (val (normal k i a)) <= 8.001 * (L * L).
Proof.
  pose proof largest_pos as M0. pose proof L_1 as L1. set (e := normal k i a).
  assert (poly : Expressions.polynomial e = true) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (fit : Expressions.fits e = true) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (deg : Expressions.degree e = 2%nat) by (unfold e; destruct k, i, a; vm_compute; reflexivity).
  assert (dep : (Expressions.depth e <= 4)%nat) by (unfold e; destruct k, i, a; vm_compute; lia).
  assert (steps : (Expressions.of_steps e <= 104)%Z) by (unfold e; destruct k, i, a; vm_compute; discriminate).
  assert (m1 : 1 <= L) by lra.
  pose proof (Bounds.error_of_steps f ok L m1 from to told_of executed in_range small e poly fit) as S.
  unfold Bounds.within in S. rewrite deg in S. cbn [Init.Nat.pred] in S. rewrite pow_1 in S.
  pose proof (permanent_of i a L ltac:(lra) small) as P. pose proof (Bounds.permanent_pos d e) as P0. fold e in P.
  pose proof (Bounds.exact_permanent d e) as E. pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (q_small f ok (Expressions.depth e) ltac:(lia)) as Q. pose proof (Bounds.q_ge f (Expressions.depth e)).
  set (pp := Expressions.permanent d e) in *. assert (LL : 1 * L <= L * L) by (apply Rmult_le_compat_r; lra).
  assert (P8 : pp <= 8 * (L * L)) by (destruct i; cbn [count] in P; lra).
  assert ((Bounds.q f (Expressions.depth e) - 1) * pp <= / 100000 * (8 * (L * L))) by (apply Rmult_le_compat; lra).
  assert (st : IZR (Expressions.of_steps e) <= 104) by (apply IZR_le; exact steps).
  assert (l * IZR (Expressions.of_steps e) * L <= / 1000000 * L).
  { apply Rmult_le_compat_r; [lra|]. apply Rle_trans with (l * 104); [apply Rmult_le_compat_l; lra|lra]. }
  apply Rabs_le_inv in S. apply Rabs_le_inv in E. apply Rabs_le. lra.
Qed.
Lemma square_size i a : val (normal k i a) * val (normal k i a) <= 64.02 * (L * L * (L * L)).
Proof.
  pose proof (normal_size i a) as h. pose proof L_1. rewrite <- (Rabs_pos_eq (_ * _)) by apply Rle_0_sqr.
  rewrite Rabs_mult. assert (0 <= L * L) by (apply Rmult_le_pos; lra).
  assert (0 <= L * L * (L * L)) by (apply Rmult_le_pos; lra).
  apply Rle_trans with (8.001 * (L * L) * (8.001 * (L * L))); [apply Rmult_le_compat; auto using Rabs_pos|lra].
Qed.
(* The square of a control point, as it is computed. *)
Definition X2 i := squared (fun a => weight i * val (normal k i a)).
Lemma X2_is i : X2 i = match i with Middle => / 4 | _ => 1 end * squared (fun a => val (normal k i a)).
Proof. unfold X2, squared, sum3. destruct i; cbn [weight]; field. Qed.
Lemma X2_size i : 0 <= X2 i <= 0.76 * omega f.
Proof.
  split; [apply squared_pos|]. rewrite X2_is. pose proof (squared_pos (fun a => val (normal k i a))).
  assert (squared (fun a => val (normal k i a)) <= 0.76 * omega f); [|destruct i; lra].
  unfold squared, sum3. cbv beta. pose proof (square_size i Expressions.X). pose proof (square_size i Expressions.Y).
  pose proof (square_size i Expressions.Z_). pose proof L_4. pose proof (omega_pos f fine). lra.
Qed.
Lemma dot_of i : at_least (value_of (dot_ (normal_term k i) (normal_term k i)))
  ((1 - 3 * e1) * squared (fun a => val (normal k i a)) - 9.2 * l).
Proof.
  pose proof L_4 as L4. pose proof (omega_pos f fine).
  apply (here dot_least).
  - intro a. unfold normal_term. rewrite component_each. apply number. destruct k, i, a; vm_compute; reflexivity.
  - intro a. pose proof (square_size i a). lra.
  - unfold squared, sum3. cbv beta. pose proof (square_size i Expressions.X). pose proof (square_size i Expressions.Y).
    pose proof (square_size i Expressions.Z_). lra.
Qed.
Lemma halved e b : at_least (value_of e) b -> b <= omega f ->
  at_least (value_of (Product half e)) ((1 - e1) * ((b - l) * / 2) - l).
Proof.
  intros h bo. pose proof (run_product half e) as r. unfold half in r at 1. rewrite run_constant in r.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine). apply product_turned in r.
  apply (product_least f fine env _ _ _ b _ r h); cbn [constant_value]; [lra| |lra]. destruct (Rle_lt_dec 0 ((b - l) *
    / 2)).
  - assert ((1 - e1) * ((b - l) * / 2) <= 1 * ((b - l) * / 2)) by (apply Rmult_le_compat_r; lra). lra.
  - assert (0 <= (1 - e1) * - ((b - l) * / 2)) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma squares_least i : at_least (value_of (squares k)) ((1 - 5 * e1) * X2 i - 11.3 * l).
Proof.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f).
  pose proof (X2_size Early) as [a0 a1]. pose proof (X2_size Middle) as [b0 b1]. pose proof (X2_size Late) as [c0 c1].
  pose proof (omega_pos f fine).
  pose proof (dot_of Early) as de. pose proof (dot_of Middle) as dm. pose proof (dot_of Late) as dl.
  pose proof (X2_is Early) as xe. pose proof (X2_is Middle) as xm. pose proof (X2_is Late) as xl. cbn iota in xe, xm,
    xl.
  pose proof (squared_pos (fun a => val (normal k Early a))). pose proof (squared_pos (fun a => val (normal k Middle
    a))).
  pose proof (squared_pos (fun a => val (normal k Late a))).
  assert (Ho : squared (fun a => val (normal k Middle a)) <= 0.76 * omega f).
  { unfold squared, sum3. cbv beta. pose proof (square_size Middle Expressions.X). pose proof (square_size Middle
      Expressions.Y). pose proof (square_size Middle Expressions.Z_). pose proof L_4. lra. }
  set (E := squared (fun a => val (normal k Early a))) in *. set (H_ := squared (fun a => val (normal k Middle a))) in
    *.
  set (T := squared (fun a => val (normal k Late a))) in *.
  assert (e_ : forall x, 0 <= x -> 0 <= e1 * x <= / 8388608 * x) by (intros; split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  pose proof (e_ E ltac:(lra)). pose proof (e_ H_ ltac:(lra)) as eH. pose proof (e_ T ltac:(lra)).
  pose proof (e_ (e1 * H_) ltac:(lra)) as eeH. pose proof (e_ (e1 * (e1 * H_)) ltac:(lra)) as eeeH.
  pose proof (e_ l ltac:(lra)) as el. pose proof (e_ (e1 * l) ltac:(lra)) as eel.
  assert (dm' : at_least (value_of (Product half (Product half (dot_ (normal_term k Middle) (normal_term k Middle)))))
    ((1 - 5 * e1) * (/ 4 * H_) - 5 * l)).
  { eapply at_least_weaker; [apply halved; [apply halved; [exact dm|]|]|]; lra. }
  pose proof (run_larger (dot_ (normal_term k Early) (normal_term k Early)) (Product half (Product half (dot_
    (normal_term k Middle) (normal_term k Middle))))) as h1.
  destruct (larger_least f env _ _ _ _ _ h1 de dm') as [le lm].
  pose proof (run_larger (Larger (dot_ (normal_term k Early) (normal_term k Early)) (Product half (Product half (dot_
    (normal_term k Middle) (normal_term k Middle))))) (dot_ (normal_term k Late) (normal_term k Late))) as h2.
  destruct (larger_least f env _ _ _ _ _ h2 le dl) as [e2 l2].
  destruct (larger_least f env _ _ _ _ _ h2 lm dl) as [m2 _].
  fold (squares k) in e2, l2, m2. unfold squares.
  destruct i; [apply (at_least_weaker _ _ _ e2)|apply (at_least_weaker _ _ _ m2)|apply (at_least_weaker _ _ _ l2)];
    rewrite ?xe, ?xm, ?xl; lra.
Qed.
Lemma root_size i : let r := (1 - 6 * e1) * X2 i + 499 * l in 499 * l <= r /\ 0 <= sqrt r <= 0.8 * omega f /\
  l <= sqrt r.
Proof.
  cbv zeta. pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine). pose proof (X2_size i) as [x0 x1].
  assert (0 <= (1 - 6 * e1) * X2 i <= 1 * X2 i) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  set (r := (1 - 6 * e1) * X2 i + 499 * l) in *. pose proof (sqrt_pos r) as r0. pose proof (sqrt_sqrt r ltac:(unfold r;
    lra)) as rr. split; [unfold r; lra|].
  split; [split; [exact r0|]|].
  - destruct (Rle_lt_dec (sqrt r) 1); [lra|]. assert (up : 1 * sqrt r <= sqrt r * sqrt r) by (apply Rmult_le_compat_r;
    lra).
    rewrite rr in up. unfold r in up at 2. lra.
  - rewrite <- (sqrt_square l) by lra. apply sqrt_le_1_alt. apply Rle_trans with (1 * l); [apply Rmult_le_compat_r;
      lra|unfold r; lra].
Qed.
Lemma length_least i : at_least (value_of (length k)) ((1 - e1) * sqrt ((1 - 6 * e1) * X2 i + 499 * l)).
Proof.
  pose proof (e_pos f). pose proof (e_small f ok). pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (omega_pos f fine). pose proof (X2_size i) as [x0 x1]. pose proof (eta_large f fine).
  pose proof (eta_1 f fine). destruct (root_size i) as (r1 & [r2 r3] & r4).
  pose proof (run_sum (squares k) (Constant Underflow)) as h. rewrite run_constant in h. cbn [constant_value] in h.
  set (eta := power (underflow f)) in *.
  assert (ex : 0 <= e1 * X2 i) by (apply Rmult_le_pos; lra).
  assert (eex : 0 <= e1 * (e1 * X2 i)) by (apply Rmult_le_pos; lra).
  assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (s : at_least (value_of (Sum (squares k) (Constant Underflow))) ((1 - 6 * e1) * X2 i + 499 * l)).
  { apply (sum_least_normal f fine env _ _ _ ((1 - 5 * e1) * X2 i - 11.3 * l) ((1 - 5 * e1) * X2 i + 499.5 * l) _ h);
      [apply squares_least|lra| |lra|lra|lra].
    intros x xp ax. destruct (seen_low f env x xp). rewrite (seen_large f env eta) by lra. lra. }
  pose proof (run_root (Sum (squares k) (Constant Underflow))) as g. fold (length k) in g.
  apply (root_least f fine env _ _ _ _ g s); [lra| |lra].
  assert ((1 - e1) * sqrt ((1 - 6 * e1) * X2 i + 499 * l) <= 1 * sqrt ((1 - 6 * e1) * X2 i + 499 * l)) by (apply
    Rmult_le_compat_r; lra). lra.
Qed.
(* What is added for rounding, and the slack. *)
Lemma constants_value : exists c r s, value_of (term_of k slack_) = Number c /\ 1 + 14.9 * e1 <= c <= 2 /\
  value_of (term_of k rounding) = Number r /\ 0 <= r <= L * L /\ 63.9 * e1 * (M * M) - 1.2 * l <= r /\ s = 0.
Proof.
  pose proof (e_pos f). pose proof (e_small f ok) as es. pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (l_e f fine) as le. pose proof (eps_twice f) as eu. pose proof L_1 as L1. pose proof L_2.
  pose proof largest_pos as M0. pose proof (omega_pos f fine) as om.
  assert (su : seen u = u) by (apply seen_large; lra).
  assert (roundoffs_ : forall n, (1 <= n <= 255)%Z -> exists x, value_of (Product (Constant (Small n)) (Constant
    UnitRoundoff)) = Number x /\ (1 - e1) * (IZR n * u) <= x <= (1 + e1) * (IZR n * u)).
  { intros n [n1 n2]. apply IZR_le in n1. apply IZR_le in n2.
    pose proof (run_product (Constant (Small n)) (Constant UnitRoundoff)) as h. rewrite !run_constant in h.
    unfold product in h. cbn in h. rewrite su, (seen_large f env (IZR n)) in h by lra.
    assert (nu : u <= IZR n * u <= 255 * u) by (split; [rewrite <- (Rmult_1_l u) at 1|]; apply Rmult_le_compat_r; lra).
    apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
    eexists. split; [exact h|]. apply (normal_error f fine env). lra. }
  destruct (roundoffs_ 32%Z ltac:(lia)) as (x & Ex & x1 & x2). destruct (roundoffs_ 128%Z ltac:(lia)) as (y & Ey & y1 &
    y2).
  assert (ee : 0 <= e1 * e1 <= / 8388608 * e1) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eee : 0 <= e1 * (e1 * e1) <= / 8388608 * (e1 * e1)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (eu2 : 0 <= e1 * u <= / 8388608 * u) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (xs : 15.99 * e1 <= x <= 16.01 * e1) by lra. assert (ys : 63.95 * e1 <= y <= 64.01 * e1) by lra.
  (* The slack. *)
  pose proof (run_sum (Constant (Small 1)) (Product (Constant (Small 32)) (Constant UnitRoundoff))) as h.
  rewrite run_constant, Ex in h. unfold sum in h. cbn in h. rewrite (seen_large f env 1), (seen_large f env x) in h by
    lra.
  apply (number_if_small f fine env) in h; [|rewrite Rabs_pos_eq; lra].
  destruct (normal_error f fine env (1 + x) ltac:(lra)) as [c1 c2].
  (* The square of M. *)
  pose proof (number largest_ eq_refl) as EM.
  assert (MM : 0 <= M * M <= L * L) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  destruct (here square_least (term_of k largest_) M EM ltac:(lra)) as (z & Ez & z0 & z1).
  pose proof (number rounding eq_refl) as Er. set (r := val rounding) in *.
  pose proof (run_product (Product (Constant (Small 128)) (Constant UnitRoundoff)) (Product (term_of k largest_)
    (term_of k largest_))) as g. rewrite Ey, Ez in g.
  change (product f env (Number y) (Number z) (value_of (term_of k rounding))) in g. rewrite Er in g.
  assert (yn : seen y = y) by (apply seen_large; lra).
  assert (g' : product f env (Number z) (Number y) (Number r)) by (apply product_turned; exact g).
  assert (eM : 0 <= e1 * (M * M)) by (apply Rmult_le_pos; lra). assert (el : 0 <= e1 * l <= / 8388608 * l) by (split;
    [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (eeM : 0 <= e1 * (e1 * (M * M)) <= / 8388608 * (e1 * (M * M))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (eeeM : 0 <= e1 * (e1 * (e1 * (M * M))) <= / 8388608 * (e1 * (e1 * (M * M)))) by (split; [apply Rmult_le_pos;
    lra|apply Rmult_le_compat_r; lra]).
  assert (eel : 0 <= e1 * (e1 * l) <= / 8388608 * (e1 * l)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  assert (zy : (63.95 * e1) * ((1 - e1) * (M * M) - 2.1 * l) <= (z - l) * y).
  { assert (z * (63.95 * e1) <= z * y) by (apply Rmult_le_compat_l; lra).
    assert (e1 * ((1 - e1) * (M * M) - 1.001 * l) <= e1 * z) by (apply Rmult_le_compat_l; lra).
    assert (l * y <= l * (64.01 * e1)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (low : at_least (Number r) (63.9 * e1 * (M * M) - 1.2 * l)).
  { apply (product_least f fine env _ y _ z _ g'); [right; exists z; repeat split; auto; lra|lra| |].
    - assert (e1 * (M * M) <= / 8388608 * (M * M)) by (apply Rmult_le_compat_r; lra). lra.
    - assert ((1 - e1) * (63.95 * e1 * ((1 - e1) * (M * M) - 2.1 * l)) <= (1 - e1) * ((z - l) * y)) by (apply
        Rmult_le_compat_l; lra). lra. }
  assert (ex : 0 <= e1 * x <= e1 * (16.01 * e1)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra]).
  exists (rounded env (1 + x)), r, 0. split; [exact h|]. split; [lra|]. split; [exact Er|].
  destruct low as [low|(r' & E' & r0 & rl)]; [discriminate|]. injection E' as <-.
  split; [split; [exact r0|]|split; [exact rl|reflexivity]].
  (* It is small. *)
  destruct (Errors.sizes f ok from to told_of executed in_range rounding eq_refl) as (_ & _ & _ & _).
  assert (zL : z <= 1.01 * (L * L)).
  { pose proof (run_product (term_of k largest_) (term_of k largest_)) as w. rewrite EM, Ez in w. unfold product in w.
    cbn in w. pose proof (seen_square f fine env M) as [_ sm].
    assert (sp : 0 <= seen M * seen M) by apply Rle_0_sqr.
    apply (number_if_small f fine env) in w; [|rewrite Rabs_pos_eq; lra]. injection w as ->.
    pose proof (error f ok env (seen M * seen M)) as er. rewrite (Rabs_pos_eq _ sp) in er.
    apply Rabs_le_inv in er.
    assert (e1 * (seen M * seen M) <= / 8388608 * (L * L)) by (apply Rmult_le_compat; lra).
    assert (1 * 1 <= L * L) by (apply Rmult_le_compat; lra). lra. }
  unfold product in g'. cbn in g'. rewrite yn in g'. destruct (seen_low f env z z0) as [sz0 _].
  pose proof (seen_smaller f env z) as sz. rewrite !Rabs_pos_eq in sz by lra.
  assert (zs : 0 <= seen z * y <= 1.01 * (L * L) * (64.01 * e1)) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat; lra]).
  assert (eL : 0 <= e1 * (L * L) <= / 8388608 * (L * L)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  apply (number_if_small f fine env) in g'; [|rewrite Rabs_pos_eq; lra]. injection g' as ->.
  pose proof (error f ok env (seen z * y)) as er. rewrite (Rabs_pos_eq (seen z * y)) in er by lra.
  apply Rabs_le_inv in er.
  assert (e1 * (seen z * y) <= / 8388608 * (seen z * y)) by (apply Rmult_le_compat_r; lra).
  assert (1 * 1 <= L * L) by (apply Rmult_le_compat; lra). lra.
Qed.
Definition exact_squared i := squared (fun a => weight i * Expressions.exact D (normal k i a)).
(* The bound, less three more roundings. *)
Theorem largest_normal_is_large : value_of (largest_normal k) = Infinite true \/ exists n,
  value_of (largest_normal k) = Number n /\ l <= n /\ forall i, exact_squared i <= ((1 - 3 * e1) * n) ^ 2.
Proof.
  pose proof (e_pos f). pose proof (e_small f ok) as es. pose proof (l_pos f). pose proof (l_small f ok).
  pose proof (l_e f fine) as le. pose proof L_1 as L1. pose proof L_2. pose proof largest_pos as M0.
  pose proof (omega_pos f fine) as om.
  destruct constants_value as (c & r & _ & Ec & [c1 c2] & Er & [r0 rL] & rl & _).
  assert (MM : 0 <= M * M <= L * L) by (split; [apply Rmult_le_pos|apply Rmult_le_compat]; lra).
  assert (eM : 0 <= e1 * (M * M) <= / 8388608 * (M * M)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
    lra]).
  assert (eeM : 0 <= e1 * (e1 * (M * M)) <= / 8388608 * (e1 * (M * M))) by (split; [apply Rmult_le_pos; lra|apply
    Rmult_le_compat_r; lra]).
  assert (el : 0 <= e1 * l <= / 8388608 * l) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (lM : 0 <= l * (M * M) <= / 1099511627776 * (e1 * (M * M))).
  { split; [apply Rmult_le_pos; lra|]. replace (/ 1099511627776 * (e1 * (M * M))) with (/ 1099511627776 * e1 * (M * M))
      by ring. apply Rmult_le_compat_r; lra. }
  (* Each control point. *)
  set (low i := (1 + 11.8 * e1) * sqrt ((1 - 6 * e1) * X2 i + 499 * l) + 63.8 * (e1 * (M * M)) - 2.3 * l).
  assert (each_ : forall i, at_least (value_of (largest_normal k)) (low i) /\ l <= low i /\
    exact_squared i <= ((1 - 3 * e1) * low i) ^ 2).
  { intro i. pose proof (length_least i) as len. destruct (root_size i) as (r1 & [r2 r3] & r4).
    pose proof (X2_size i) as [x0 x1].
    assert (big : 20 * l <= sqrt ((1 - 6 * e1) * X2 i + 499 * l)).
    { rewrite <- (sqrt_square (20 * l)) by lra. apply sqrt_le_1_alt.
      replace (20 * l * (20 * l)) with (400 * (l * l)) by ring.
      assert (l * l <= / 1000 * l) by (apply Rmult_le_compat_r; lra). lra. }
    set (R_ := sqrt ((1 - 6 * e1) * X2 i + 499 * l)) in *.
    assert (eR : 0 <= e1 * R_ <= / 8388608 * R_) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
    assert (eeR : 0 <= e1 * (e1 * R_) <= / 8388608 * (e1 * R_)) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]).
    assert (eeeR : 0 <= e1 * (e1 * (e1 * R_)) <= / 8388608 * (e1 * (e1 * R_))) by (split; [apply Rmult_le_pos; lra|apply
      Rmult_le_compat_r; lra]).
    pose proof (run_sum (length k) (term_of k rounding)) as h. rewrite Er in h.
    set (A := (1 - 2 * e1) * R_ + 63.85 * (e1 * (M * M)) - 2.25 * l).
    assert (s : at_least (value_of (Sum (length k) (term_of k rounding))) A).
    { apply (sum_least_normal f fine env _ _ _ ((1 - e1) * R_) ((1 - e1) * R_ + 63.9 * e1 * (M * M) - 2.2 * l) _ h len);
        unfold A; try lra.
      intros x xp ax. rewrite (seen_large f env x) by lra. destruct (seen_low f env r r0). lra. }
    pose proof (run_product (Sum (length k) (term_of k rounding)) (term_of k slack_)) as g. fold (largest_normal k) in
      g.
    rewrite Ec in g.
    assert (Apos : l <= A) by (unfold A; lra).
    assert (step1 : A * (1 + 14.9 * e1) <= A * c) by (apply Rmult_le_compat_l; lra).
    assert (step2 : (1 - e1) * (A * (1 + 14.9 * e1)) <= (1 - e1) * (A * c)) by (apply Rmult_le_compat_l; lra).
    assert (lowA : low i <= (1 - e1) * (A * (1 + 14.9 * e1))).
    { unfold low, A. fold R_. assert (0 <= e1 * (e1 * (e1 * (M * M))) <= / 8388608 * (e1 * (e1 * (M * M)))) by (split;
        [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
      assert (0 <= e1 * (e1 * l) <= / 8388608 * (e1 * l)) by (split; [apply Rmult_le_pos; lra|apply
        Rmult_le_compat_r; lra]). lra. }
    assert (low_l : l <= low i) by (unfold low; fold R_; lra).
    split; [|split; [exact low_l|]].
    - apply (product_least_normal f fine env _ c _ A _ g s); try lra.
      + assert (A * 1 <= A * c) by (apply Rmult_le_compat_l; lra). lra.
      + unfold low. fold R_. lra.
    - pose proof Mx_facts as (Mx0 & MMx & MxMx & Mx1).
      set (w := match i with Middle => / 2 | _ => 1 end).
      set (dd := 24.1 * e1 * (Mx * Mx) + 52 * (l * (1 + M))).
      assert (Mxe : 0 <= e1 * (Mx * Mx)) by (repeat apply Rmult_le_pos; lra).
      assert (lm : 0 <= l * (1 + M)) by (apply Rmult_le_pos; lra).
      assert (near_ : forall a, Rabs (weight i * Expressions.exact D (normal k i a) - weight i * val (normal k i a)) <=
        dd).
      { intro a. rewrite <- Rmult_minus_distr_l, Rabs_mult, Rabs_minus_sym. pose proof (normal_is_near i a) as n.
        unfold dd. destruct i; cbn [weight]; rewrite (Rabs_pos_eq) by lra; lra. }
      pose proof (longer (fun a => weight i * val (normal k i a)) (fun a => weight i * Expressions.exact D (normal k i
        a)) (sqrt (X2 i)) dd (sqrt_pos _) ltac:(unfold dd; lra)) as grow.
      rewrite <- Rsqr_pow2, (Rsqr_sqrt (X2 i) x0) in grow. specialize (grow (Rle_refl _) near_).
      eapply Rle_trans; [exact grow|]. pose proof (sqrt_pos (X2 i)) as S0. apply pow_incr. split; [unfold dd; lra|].
      pose proof (root_covers e1 l (sqrt (X2 i)) (190 * l) ltac:(lra) le es S0 ltac:(lra)) as cov.
      rewrite <- Rsqr_pow2, (Rsqr_sqrt (X2 i) x0) in cov. fold R_ in cov.
      assert (lMM : l * M <= l + l * (M * M)).
      { destruct (Rle_lt_dec M 1).
        - assert (l * M <= l * 1) by (apply Rmult_le_compat_l; lra). lra.
        - assert (M * 1 <= M * M) by (apply Rmult_le_compat_l; lra).
          assert (l * M <= l * (M * M)) by (apply Rmult_le_compat_l; lra). lra. }
      assert (ll : l * l <= / 1000000 * l) by (apply Rmult_le_compat_r; lra).
      assert (ell : 0 <= e1 * (l * l) <= / 8388608 * (l * l)).
      { assert (0 <= l * l) by (apply Rmult_le_pos; lra). split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r;
        lra]. }
      assert (eMx : e1 * (Mx * Mx) <= e1 * (M * M + l * l)) by (apply Rmult_le_compat_l; lra).
      unfold dd, low. fold R_.
      assert (0 <= e1 * (e1 * (e1 * (M * M)))) by (repeat apply Rmult_le_pos; lra).
      assert (0 <= e1 * (e1 * l)) by (apply Rmult_le_pos; lra). lra. }
  destruct (each_ Early) as ([inf|(n & En & _ & n1)] & l1 & q1); [left; exact inf|right].
  exists n. split; [exact En|]. split; [lra|]. intro i.
  destruct (each_ i) as ([inf|(n' & En' & _ & n2)] & l2 & q2); [rewrite En in inf; discriminate|].
  rewrite En in En'. injection En' as <-. eapply Rle_trans; [exact q2|]. apply pow_incr. split.
  - apply Rmult_le_pos; lra.
  - apply Rmult_le_compat_l; lra.
Qed.
End Normals.
