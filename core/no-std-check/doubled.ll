define void @doubled(i1 %some, float %x, ptr %out) {
start:
  br i1 %some, label %a, label %b
a:
  br label %b
b:
  %separation = phi float [ undef, %start ], [ %x, %a ]
  %moved = call float @llvm.fabs.f32(float %separation)
  %product = fmul float %moved, 3.000000e+00
  %fine = fmul noundef float %x, 3.000000e+00
  %lanes = fmul <2 x float> %pair, <float 2.000000e+00, float poison>
  store float %product, ptr %out
  ret void
}
