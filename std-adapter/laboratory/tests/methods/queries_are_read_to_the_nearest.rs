//! Each coordinate of a query is the double nearest to its ratio, by rug's arithmetic, which is independent of the reader's.

use proptest::prelude::*;
use rug::{Integer, Rational};
use selvedge::PairKind;
use selvedge_laboratory::queries::read_from;
use std::path::Path;

fn digits() -> impl Strategy<Value = Integer> {
    "-?[1-9][0-9]{0,320}".prop_map(|digits| digits.parse().expect("digits"))
}

/// Generates ratios of all sizes, and ratios at or beside the middle of two neighbouring doubles.
fn ratios() -> impl Strategy<Value = Rational> {
    let of_any_size = (digits(), digits()).prop_map(Rational::from);
    let ties = (any::<f64>(), -1..=1, 1..400_u32).prop_filter_map("a finite number", |(x, side, bits)| {
        let [x, next] = [x, x.next_up()].map(Rational::from_f64);
        let beside = Rational::from(side) >> bits;
        let middle = (x? + next?) / 2;
        Some(&middle * beside + middle)
    });
    prop_oneof![of_any_size, ties]
}

/// Returns the distance, or `None` if `x` is infinite.
fn distance(x: f64, ratio: &Rational) -> Option<Rational> {
    Some((Rational::from_f64(x)? - ratio).abs())
}

proptest! {
    #![proptest_config(selvedge_verification::generator::config(256))]

    #[test]
    fn queries_are_read_to_the_nearest(ratios in prop::collection::vec(ratios(), 24)) {
        let rows = ratios.chunks(3).map(|point| {
            let fields = point.iter().map(|ratio| format!("{},{},", ratio.numer(), ratio.denom()));
            format!("{}1\n", fields.collect::<String>())
        });
        let Ok(file) = read_from(rows.collect::<String>().as_bytes(), Path::new("queries.csv"), PairKind::VertexFace) else {
            // Only a ratio beyond the largest double is refused.
            let limit = Rational::from_f64(f64::MAX).expect("finite");
            prop_assert!(ratios.iter().any(|ratio| *ratio.as_abs() > limit));
            return Ok(());
        };
        let motions = file.queries[0].pair.motions;
        let starts = motions.iter().map(|motion| motion.start);
        let read = starts.chain(motions.iter().map(|motion| motion.end)).flat_map(|point| point.to_array());
        let mut inexact = 0;
        for (value, ratio) in read.zip(&ratios) {
            let own = distance(value, ratio).expect("coordinates are finite");
            inexact += usize::from(own != 0);
            for other in [value.next_down(), value.next_up()].iter().filter_map(|&x| distance(x, ratio)) {
                prop_assert!(own < other || own == other && value.to_bits() & 1 == 0, "{value:e} for {ratio}");
            }
        }
        prop_assert_eq!(file.inexact, inexact);
    }
}
