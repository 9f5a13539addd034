# Powers of two of f64, for the scripts: see f32.sed.
s/@u@/-53/g
s/@lambda@/-1022/g
s/@eta@/-1000/g
s/@edge@/250/g
s/@max@/1024/g
s/@mu@/-960/g
s/@extent@/250/g
s/@length@/-510/g
s/@squares@/-900/g
s/@middling@/-300/g
