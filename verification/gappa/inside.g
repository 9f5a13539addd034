# Inside functions: core/src/filter/inside.rs.
#
# 1. The lemma of coplanarity.g. A control value's monomials sum up to at most 4, 16, 24, 16 and 4 times A.A, with exact differences at
#    most 1/(1 - 2u) larger than computed ones: four of them in each monomial. Roundings of a control value but for its last addition,
#    and of its bound, are counted on the code, for both kinds of pair:
#= first 12 9
#= second 14 10
#= third 15 10
#    The fourth is as the second, the fifth as the first.
# 2. Underflow, in units of lambda, for M = 1. A product of two components, each off by 3, of a turn's and the sum's; a turn is a
#    difference of two products, in the middle a sum of two of those; the sum adds up four turns (for VF three); a term of a control
#    value is a dot product of a turn, at most 2 (4 in the middle), and the sum, at most 8 (16). Each step loses 1 more.
# 3. What underflow adds is a polynomial in M of degree 3 without negative coefficients, p(M) with p(0) = 17: at most 17 + p(1) M for
#    M <= 1, where (1 + M)^4 >= 1 + 4M; and p(1) M^3 for M >= 1, where M^3 <= 27/256 (1 + M)^4. The bound itself loses at most 12.

once = 160; #! core/src/filter/inside.rs: let once = constant(160) * extent.x.splat(L::Scalar::UNIT_ROUNDOFF) * areas.dot(areas)
four = 4;   #! core/src/filter/inside.rs: four: -(constant(4) * once),
six = 6;    #! core/src/filter/inside.rs: six: -(constant(6) * once),
eta = 1b@eta@; #~ core/src/filter/inside.rs: + extent.x.splat(L::Scalar::UNDERFLOW) * (squared * squared);
lambda = 1b@lambda@;
#~ core/src/filter/inside.rs: middle: from_0.cross(to_1) + from_1.cross(to_0),
#~ core/src/filter/inside.rs: let all = first.plus(&second).plus(&third.plus(&fourth));
#~ core/src/filter/inside.rs: let second = self.start.dot(all.middle) + self.middle.dot(all.start);
#~ core/src/filter/inside.rs: (self.start.dot(all.end) + self.end.dot(all.start)) + self.middle.dot(all.middle);

f = 1 + d;
f2 = f * f;
f4 = f2 * f2;
f8 = f4 * f4;
f10 = f8 * f2;
f12 = f8 * f4;
f14 = f12 * f2;
f15 = f14 * f;
g = 1 + e;

# A product of components, a turn, one in the middle, their sums.
P = (a * Y + X * b + L * (a * b)) * g + l;
T = (p + p) * g + 1;
M = (t + t) * g + 1;
S = ((t + t) * g + 1 + (t + t) * g + 1) * g + 1;
N = ((m + m) * g + 1 + (m + m) * g + 1) * g + 1;
# Products of a turn and a sum, and their dot products.
OO = (2 * s + 8 * t + L * (s * t)) * g + 1;
OM = (2 * n + 16 * t + L * (n * t)) * g + 1;
MO = (4 * s + 8 * m + L * (s * m)) * g + 1;
MM = (4 * n + 16 * m + L * (n * m)) * g + 1;
First = ((oo + oo) * g + 1 + oo) * g + 1;
Second = (((om + om) * g + 1 + om) * g + 1 + ((mo + mo) * g + 1 + mo) * g + 1) * g + 1;
Third = ((first + first) * g + 1 + ((mm + mm) * g + 1 + mm) * g + 1) * g + 1;

{ d in [-2b@u@, 2b@u@] /\ e in [0, 2b@u@] /\ L in [0, 1b@lambda@] /\ l in [-1, 1]
/\ X in [-1, 1] /\ Y in [-1, 1] /\ a in [-3, 3] /\ b in [-3, 3]
/\ p in [0, 7.01] /\ t in [0, 15.03] /\ m in [0, 31.1] /\ s in [0, 63.2] /\ n in [0, 127.5]
/\ oo in [0, 249] /\ om in [0, 499] /\ mo in [0, 505] /\ mm in [0, 1013] /\ first in [0, 750]
->  (4 * (f12 - 1) / f4) / 1b@u@ in [-100, 100]
/\ once * f10 - 100 >= 0
/\ (16 * (f14 - 1) / f4) / 1b@u@ in [-460, 460]
/\ once * four * f10 - 460 >= 0
/\ (24 * (f15 - 1) / f4) / 1b@u@ in [-740, 740]
/\ once * six * f10 - 740 >= 0
/\ P in [-7.01, 7.01]
/\ T <= 15.03
/\ M <= 31.1
/\ S <= 63.2
/\ N <= 127.5
/\ OO <= 249
/\ OM <= 499
/\ MO <= 505
/\ MM <= 1013
/\ First <= 750
/\ Second <= 3020
/\ Third <= 4550
/\ (eta / lambda) * f10 - (17 + 12) >= 0
/\ 4 * (eta / lambda) * f10 - 750 >= 0
/\ 4 * (eta / lambda) * four * f10 - 3020 >= 0
/\ 4 * (eta / lambda) * six * f10 - 4550 >= 0
/\ (eta / lambda) * f10 - 12 - 750 * 27 / 256 >= 0
/\ (eta / lambda) * four * f10 - 12 - 3020 * 27 / 256 >= 0
/\ (eta / lambda) * six * f10 - 12 - 4550 * 27 / 256 >= 0 }
