//! In fewer digits, a length does not become less, a time does not become later, and both keep their order, in every
//! floating-point environment.

use crate::support::prelude::*;
use selvedge_core::narrowing::{rounded_down, rounded_up};

fn narrowing_makes_nothing_less_or_later_and_hardly_more_or_earlier<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let exact = rational::<f64>;
    let near = Rational::from((1, 1 << 22));
    let least_normal = exact(f32::MIN_POSITIVE.into());
    for value in pair.coordinates().map(|x| x.to_f64().abs()) {
        // The value is used unchanged, and as a time of the step.
        for value in [value, value / (1.0 + value), value * 1e-200] {
            for environment in Environment::all() {
                let (up, down, same) = environment.run(&value, |&value| {
                    (
                        rounded_up::<f32>(value),
                        rounded_down::<f32>(value),
                        rounded_down::<f64>(value),
                    )
                });
                prop_assert!(up >= 0.0 && down >= 0.0);
                let most = exact(value) * (Rational::from(1) + &near) + &least_normal;
                if up.is_finite() {
                    let up = exact(f64::from(up));
                    prop_assert!(up >= exact(value) && up <= most, "{environment:?}: {value} up to {up}");
                } else {
                    prop_assert!(value > f64::from(f32::MAX), "{environment:?}: {value}");
                }
                if value <= f64::from(f32::MAX) {
                    let least = exact(value) * (Rational::from(1) - &near) - &least_normal;
                    let down = exact(f64::from(down));
                    prop_assert!(
                        down <= exact(value) && down >= least,
                        "{environment:?}: {value} down to {down}"
                    );
                }
                prop_assert_eq!(same.to_bits(), value.to_bits());
            }
        }
    }
    Ok(())
}

formats!(narrowing_makes_nothing_less_or_later_and_hardly_more_or_earlier(
    400,
    pairs_of_any_kind()
));

fn narrowing_exchanges_no_two_numbers_in_any_environment<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let value = pair
        .coordinates()
        .map(|x| x.to_f64().abs())
        .next()
        .expect("there are coordinates");
    let nearest = f64::from(value as f32);
    // The numbers are near a number of `f32` and half-way to the next, where rounding to nearest changes direction.
    let about = [
        value,
        value / (1.0 + value),
        value * 1e-30,
        nearest,
        nearest * (1.0 + 0.5_f64.powi(24)),
    ];
    for value in about {
        let neighbours = [value.next_down().max(0.0), value, value.next_up()];
        for environment in Environment::all() {
            let narrowed = environment.run(&neighbours, |neighbours| {
                (neighbours.map(rounded_up::<f32>), neighbours.map(rounded_down::<f32>))
            });
            prop_assert!(narrowed.0.is_sorted() && narrowed.1.is_sorted(), "{environment:?}: {value:e}");
        }
    }
    Ok(())
}

formats!(narrowing_exchanges_no_two_numbers_in_any_environment(
    400,
    pairs_of_any_kind()
));
