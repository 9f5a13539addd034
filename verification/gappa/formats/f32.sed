# Powers of two of f32, for the scripts. A test demands that they are core's.
# u: unit roundoff. lambda: smallest normal number. eta: UNDERFLOW. edge: LARGEST_EDGE. max: beyond all finite numbers.
# Of the time of impact, mu: EXTENT_UNDERFLOW. extent: LARGEST_EXTENT. length: LENGTH_UNDERFLOW. squares: SAFE_SQUARE.
# middling: a size far from both ends.
s/@u@/-24/g
s/@lambda@/-126/g
s/@eta@/-117/g
s/@edge@/30/g
s/@max@/128/g
s/@mu@/-100/g
s/@extent@/29/g
s/@length@/-62/g
s/@squares@/-100/g
s/@middling@/-40/g
