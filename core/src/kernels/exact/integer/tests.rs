use super::limbs::multiply_significant_words;
use super::{Integer, Space, Whole, Words};

/// Numbers at which carries and signs fail most easily.
const NUMBERS: [i128; 13] = [
    0,
    1,
    -1,
    2,
    -2,
    u64::MAX as i128,
    -(u64::MAX as i128),
    1 << 64,
    -(1 << 64),
    i64::MIN as i128,
    i128::MAX,
    i128::MIN,
    0x0123_4567_89ab_cdef_fedc_ba98_7654_3210,
];

fn integer(number: i128) -> Integer<2> {
    Integer([number as u64, (number >> 64) as u64])
}

fn shifted<const N: usize>(significand: i64, shift: u32) -> Integer<N> {
    Integer::shifted(significand, shift)
}

/// Returns the same number in more words, or the lowest of its words.
fn resized<const R: usize>(number: Words<'_>) -> Integer<R> {
    let sign = if number.sign().is_lt() { u64::MAX } else { 0 };
    let mut words = [sign; R];
    for (word, &own) in words.iter_mut().zip(number.0) {
        *word = own;
    }
    Integer(words)
}

fn in_space<const R: usize>(compute: impl for<'a> Fn(&mut Space<'a>) -> Words<'a>) -> Integer<R> {
    // The words are not zero, so that none is left to chance.
    resized(compute(&mut Space::new(&mut [0x5555; 100])))
}

#[test]
fn sums_differences_and_signs_are_those_of_the_built_in_type() {
    for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
        let (x, y) = (integer(a), integer(b));
        let (p, q) = (x.words(), y.words());
        let (sum, difference) = (integer(a.wrapping_add(b)), integer(a.wrapping_sub(b)));
        assert_eq!(x.plus(&y), sum, "{a} + {b}");
        assert_eq!(x.minus(&y), difference, "{a} - {b}");
        assert_eq!(in_space::<2>(|space| space.plus(p, q)), sum, "{a} + {b}");
        assert_eq!(in_space::<2>(|space| space.minus(p, q)), difference, "{a} - {b}");
        assert_eq!(x.sign(), a.cmp(&0), "{a}");
        assert_eq!(p.sign(), a.cmp(&0), "{a}");
        assert_eq!(p.is_zero(), a == 0, "{a}");
        assert_eq!(in_space::<2>(|space| space.negated(p)), integer(a.wrapping_neg()), "{a}");
        assert_eq!(in_space::<2>(|space| space.doubled(p)), integer(a.wrapping_mul(2)), "{a}");
        assert_eq!(in_space::<2>(|space| space.tripled(p)), integer(a.wrapping_mul(3)), "{a}");
    }
}

#[test]
fn sums_of_many_words_are_those_of_fixed_width() {
    for_each_number(&|a| {
        for_each_number(&|b| {
            let (p, q): (Integer<7>, Integer<7>) = (resized(a.words()), resized(b.words()));
            let sum = in_space::<7>(|space| space.plus(a.words(), b.words()));
            let difference = in_space::<7>(|space| space.minus(a.words(), b.words()));
            assert_eq!((sum, difference), (p.plus(&q), p.minus(&q)), "{a:?}, {b:?}");
        });
    });
}

#[test]
fn products_are_those_of_the_built_in_type() {
    for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
        let product: Integer<4> = integer(a).times(&integer(b));
        let Integer([low, high, ..]) = product;
        assert_eq!(Integer([low, high]), integer(a.wrapping_mul(b)), "{a} · {b}");
        // For smaller numbers all of it is compared below.
        let sign = a.signum() * b.signum();
        assert_eq!(product.sign(), sign.cmp(&0), "{a} · {b}");
        assert_eq!(
            in_space::<4>(|space| space.times(integer(a).words(), integer(b).words())),
            product
        );
        // One word is multiplied by one, and by two.
        let short = Integer([a as u64]);
        let of_short = i128::from((a as u64).cast_signed()) * i128::from((b as u64).cast_signed());
        assert_eq!(short.times::<1, 2>(&Integer([b as u64])), integer(of_short));
        let (expected, product): (Integer<4>, Integer<3>) =
            (resized::<2>(short.words()).times(&integer(b)), short.times(&integer(b)));
        assert_eq!(resized::<4>(product.words()), expected, "{short:?} · {b}");
    }
    // The product is (2⁶⁴ − 1)·2¹⁰⁰ times −2¹²⁶, word by word.
    let a: Integer<3> = shifted::<3>(1, 164).minus(&shifted(1, 100));
    let product: Integer<5> = a.times(&shifted::<2>(-1, 126));
    assert_eq!(product, shifted::<5>(1, 226).minus(&shifted(1, 290)));
}

#[test]
fn wide_products_of_shifted_numbers_are_shifted_products() {
    for (a, b) in [(3, 5), (-3, 5), (3, -5), (-3, -5), (i64::MAX, i64::MIN)] {
        for (i, j) in [(0, 0), (1, 63), (64, 65), (190, 120)] {
            let product: Integer<9> = shifted::<4>(a, i).times(&shifted::<5>(b, j));
            let Integer([low, high]) = integer(i128::from(a) * i128::from(b));
            let mut expected = Integer([0; 9]);
            for (word, part) in [(0, low & 0xffff_ffff), (32, low >> 32)] {
                expected = expected.plus(&shifted(part.cast_signed(), i + j + word));
            }
            expected = expected.plus(&shifted(high.cast_signed(), i + j + 64));
            assert_eq!(product, expected, "{a} · 2^{i} times {b} · 2^{j}");
        }
    }
}

/// Visits numbers with zeros below, or with repeated signs above, or with neither.
fn for_each_number(visit: &dyn Fn(&Integer<6>)) {
    visit(&Integer::ZERO);
    for significand in [1, -1, 3, -3, i64::MAX, i64::MIN] {
        for shift in [0, 1, 63, 64, 127, 128, 200, 256, 319, 320] {
            let number = shifted(significand, shift);
            visit(&number);
            visit(&number.minus(&shifted(1, 0)));
            visit(&number.plus(&shifted(significand, 7)));
        }
    }
}

/// Multiplies magnitudes by rows of 32 bits.
fn slow_product(a: &Integer<6>, b: &Integer<6>) -> Integer<12> {
    let magnitude = |x: &Integer<6>| if x.sign().is_lt() { Integer::ZERO.minus(x) } else { *x };
    let halves = |x: Integer<6>| x.0.into_iter().flat_map(|word| [word & 0xffff_ffff, word >> 32]);
    let mut product = Integer::<12>::ZERO;
    for (i, x) in halves(magnitude(a)).enumerate() {
        for (j, y) in halves(magnitude(b)).enumerate() {
            for (k, half) in [(x * y) & 0xffff_ffff, (x * y) >> 32].into_iter().enumerate() {
                let place = 32 * (i + j + k) as u32;
                // Nothing is above: a magnitude has a bit less than its words.
                if half != 0 {
                    product = product.plus(&shifted(half.cast_signed(), place));
                }
            }
        }
    }
    if a.sign() == b.sign() {
        product
    } else {
        Integer::ZERO.minus(&product)
    }
}

#[test]
fn the_product_of_significant_words_is_the_product() {
    for_each_number(&|a| {
        for_each_number(&|b| {
            let expected = slow_product(a, b);
            let mut product = [0x5555; 12];
            multiply_significant_words(&a.0, &b.0, &mut product);
            assert_eq!(Integer(product), expected, "{a:?} · {b:?}");
            assert_eq!(a.times::<6, 12>(b), expected, "{a:?} · {b:?}");
            assert_eq!(
                in_space::<12>(|space| space.times(a.words(), b.words())),
                expected,
                "{a:?} · {b:?}"
            );
        });
    });
}

#[test]
fn minors_and_sums_of_products_are_those_of_products() {
    let numbers = [0, 1, -1, i64::MAX, i64::MIN].map(|x| shifted::<6>(x, 0));
    let others = [shifted(3, 70), shifted(-5, 130), shifted(i64::MIN, 0), Integer::ZERO];
    for (a, b) in numbers.iter().flat_map(|a| numbers.map(|b| (a, b))) {
        for (c, d) in numbers
            .iter()
            .chain(&others)
            .flat_map(|c| others.iter().chain(&numbers).map(move |d| (c, d)))
        {
            let [ad, bc]: [Integer<12>; 2] = [a.times(d), b.times(c)];
            let [p, q, r, s] = [a, &b, c, d].map(|x| x.words());
            assert_eq!(
                in_space::<12>(|space| space.minor(p, q, r, s)),
                ad.minus(&bc),
                "{a:?} {b:?} {c:?} {d:?}"
            );
            let sum = in_space::<12>(|space| space.sum_of_products([[p, s], [q, r], [r, s]]));
            assert_eq!(sum, ad.plus(&bc).plus(&c.times(d)), "{a:?} {b:?} {c:?} {d:?}");
        }
    }
}

#[test]
fn a_shifted_number_is_the_same_in_a_space() {
    for significand in [0, 1, -1, i64::MAX, i64::MIN] {
        for shift in [0, 1, 63, 64, 100, 200] {
            let expected: Integer<5> = shifted(significand, shift);
            assert_eq!(
                in_space::<5>(|space| space.shifted(significand, shift)),
                expected,
                "{significand} · 2^{shift}"
            );
        }
    }
}

#[test]
fn zero_takes_no_space_however_far_it_is_shifted() {
    let mut words = [0; 2];
    let mut space = Space::new(&mut words);
    assert!(space.shifted(0, u32::MAX).is_zero());
    assert_eq!(resized::<1>(space.shifted(5, 0)), Integer([5]));
}

#[test]
fn bits_are_those_beside_the_sign_and_zeros_those_below() {
    for number in NUMBERS {
        let repeated = if number < 0 {
            number.leading_ones()
        } else {
            number.leading_zeros()
        };
        let wide: Integer<5> = resized(integer(number).words());
        for words in [integer(number).words(), wide.words()] {
            assert_eq!(words.bits(), 128 - repeated, "{number}");
            assert_eq!(
                words.trailing_zeros(),
                if number == 0 { 0 } else { number.trailing_zeros() },
                "{number}"
            );
        }
    }
}

#[test]
fn the_word_above_some_bits_is_that_of_the_number_rounded_down() {
    for number in NUMBERS {
        let number_in_words = integer(number);
        for dropped in 0..128 {
            let expected = (number >> dropped) as u64;
            assert_eq!(number_in_words.words().word_above(dropped), expected, "{number}, {dropped}");
        }
        assert_eq!(number_in_words.words().word_above(300), (number >> 127) as u64, "{number}");
    }
}
