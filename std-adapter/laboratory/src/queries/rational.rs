//! Ratios of integers of any length, correctly rounded to `f64`.

use dashu_int::IBig;
use dashu_ratio::RBig;

/// A ratio in double precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rounded {
    /// The nearest `f64`, ties to even; infinite if the ratio is too large.
    pub(super) value: f64,
    /// Whether `value` equals the ratio.
    pub(super) exact: bool,
}

/// Why two fields are no ratio.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RatioError {
    NumeratorNotAnInteger,
    DenominatorNotAnInteger,
    ZeroDenominator,
}

/// Rounds `numerator / denominator`, two decimal integers, to the nearest `f64`, ties to even.
///
/// Subnormal results are rounded once, like all others. Zero is always +0, as an integer has no
/// negative zero.
pub(super) fn round(numerator: &[u8], denominator: &[u8]) -> Result<Rounded, RatioError> {
    let num = decimal(numerator).ok_or(RatioError::NumeratorNotAnInteger)?;
    let den = decimal(denominator).ok_or(RatioError::DenominatorNotAnInteger)?;
    Ok(match quick(num, den) {
        Some(value) => Rounded { value, exact: true },
        None => {
            let num = num.parse::<IBig>().map_err(|_| RatioError::NumeratorNotAnInteger)?;
            let den = den.parse::<IBig>().map_err(|_| RatioError::DenominatorNotAnInteger)?;
            if den.is_zero() {
                return Err(RatioError::ZeroDenominator);
            }
            // `to_f64`, unlike `to_f64_fast`, promises correct rounding.
            let (value, exact) = RBig::from_parts_signed(num, den).to_f64().value_with_exact();
            // A negative ratio that underflows would become -0.
            Rounded {
                value: value + 0.0,
                exact,
            }
        }
    })
}

/// The text, if it is an optional sign and decimal digits. The library's own parser takes digit
/// separators too, which the format does not have.
fn decimal(field: &[u8]) -> Option<&str> {
    let digits = field.strip_prefix(b"-").or(field.strip_prefix(b"+")).unwrap_or(field);
    let valid = !digits.is_empty() && digits.iter().all(u8::is_ascii_digit);
    if valid { str::from_utf8(field).ok() } else { None }
}

/// The common case without big integers: a numerator that `f64` holds exactly, over a power of two
/// of at most 2^63. Dividing by a power of two only lowers the exponent, and 2^-63 is nowhere near
/// the subnormal range, so the quotient is exact.
fn quick(numerator: &str, denominator: &str) -> Option<f64> {
    const LIMIT: u64 = 1 << f64::MANTISSA_DIGITS;
    let num: i64 = numerator.parse().ok()?;
    let den: u64 = denominator.parse().ok()?;
    (num.unsigned_abs() <= LIMIT && den.is_power_of_two()).then(|| num as f64 / den as f64)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn round_text(numerator: &impl ToString, denominator: &impl ToString) -> Rounded {
        round(numerator.to_string().as_bytes(), denominator.to_string().as_bytes()).unwrap()
    }

    fn ratio(value: f64) -> RBig {
        RBig::try_from(value).unwrap()
    }

    fn round_ratio(ratio: &RBig) -> Rounded {
        round_text(ratio.numerator(), ratio.denominator())
    }

    /// Any finite number, subnormal and huge ones as often as ordinary ones.
    fn finite() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()),
            // Subnormal numbers and the first binades above them.
            (any::<bool>(), 0..3_u64 << 52).prop_map(|(negative, bits)| {
                let magnitude = f64::from_bits(bits);
                if negative { -magnitude } else { magnitude }
            }),
            -1e3..1e3,
        ]
    }

    /// An integer of up to 1,400 bits, so that ratios reach past both ends of `f64`'s range.
    fn integer() -> impl Strategy<Value = IBig> {
        (any::<i128>(), 0..1_300_usize, any::<i64>()).prop_map(|(head, shift, tail)| (IBig::from(head) << shift) + tail)
    }

    proptest! {
        #[test]
        fn every_double_comes_back_from_its_own_ratio(value in finite(), scale in 1..u64::MAX) {
            let exact = ratio(value);
            prop_assert_eq!(round_ratio(&exact), Rounded { value, exact: true });

            // Neither a common factor nor a sign below the line changes it.
            let scale = -IBig::from(scale);
            let (num, den) = (exact.numerator() * &scale, IBig::from(exact.denominator().clone()) * &scale);
            prop_assert_eq!(round_text(&num, &den), Rounded { value, exact: true });
        }

        #[test]
        fn no_other_double_is_nearer(num in integer(), den in integer()) {
            prop_assume!(!den.is_zero());
            let target = RBig::from_parts_signed(num.clone(), den.clone());
            let Rounded { value, exact } = round_text(&num, &den);
            if value.is_infinite() {
                // The tie between the largest double and what would be the next one, 2^1024.
                let limit = RBig::from((IBig::ONE << 1024) - (IBig::ONE << 970));
                let overflows = if value > 0.0 { target >= limit } else { target <= -limit };
                prop_assert!(overflows);
                return Ok(());
            }
            let distance = |x: f64| {
                let difference = ratio(x) - &target;
                if difference < RBig::ZERO { -difference } else { difference }
            };
            prop_assert_eq!(exact, distance(value) == RBig::ZERO);
            for neighbour in [value.next_down(), value.next_up()] {
                if neighbour.is_finite() {
                    prop_assert!(distance(value) <= distance(neighbour));
                }
            }
        }

        #[test]
        fn a_tie_goes_to_the_even_neighbour_and_a_hair_decides(value in finite(), hair in 1..200_usize) {
            let (low, high) = (value, value.next_up());
            prop_assume!(high.is_finite());
            let midpoint = (ratio(low) + ratio(high)) / RBig::from(2);
            let even = if low.to_bits() & 1 == 0 { low } else { high };
            prop_assert_eq!(round_ratio(&midpoint), Rounded { value: even, exact: false });

            let hair = (ratio(high) - ratio(low)) / RBig::from(IBig::ONE << (1 + hair));
            prop_assert_eq!(round_ratio(&(&midpoint + &hair)).value, high);
            prop_assert_eq!(round_ratio(&(&midpoint - &hair)).value, low);
        }
    }

    #[test]
    fn only_a_sign_and_decimal_digits_are_an_integer() {
        assert_eq!(
            round(b"+6", b"-4"),
            Ok(Rounded {
                value: -1.5,
                exact: true
            })
        );
        for text in ["", "-", "--1", "1.5", "1e3", "0x10", "1_000", "1 0", "nan", "\u{0663}"] {
            let text = text.as_bytes();
            assert_eq!(round(text, b"1"), Err(RatioError::NumeratorNotAnInteger), "{text:?}");
            assert_eq!(round(b"1", text), Err(RatioError::DenominatorNotAnInteger), "{text:?}");
        }
    }

    #[test]
    fn zero_is_positive_even_where_a_negative_ratio_underflows() {
        let tiny = format!("1{}", "0".repeat(400));
        for (numerator, denominator) in [("-1", tiny.as_str()), ("0", "-1"), ("-0", &tiny)] {
            let zero = round(numerator.as_bytes(), denominator.as_bytes()).unwrap();
            assert_eq!(zero.value.to_bits(), 0);
            assert_eq!(zero.exact, numerator != "-1");
        }
    }

    #[test]
    fn nothing_is_divided_by_zero() {
        for denominator in ["0", "-0", "+000"] {
            assert_eq!(round(b"1", denominator.as_bytes()), Err(RatioError::ZeroDenominator));
            assert_eq!(round(b"0", denominator.as_bytes()), Err(RatioError::ZeroDenominator));
        }
    }
}
