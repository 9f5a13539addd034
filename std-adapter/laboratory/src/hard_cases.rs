//! Hard cases of the literature by name, with exact answers: degenerate pairs, and Erleben's shapes rebuilt from their geometry.
//! Each case stands at several sizes and places.
//!
//! The file `data/hard-cases.csv` is part of the program. Its answers come from exact rational arithmetic on the very numbers
//! that it holds. The project's tests repeat that computation.

use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, PrimitivePair};
use std::sync::OnceLock;

/// A primitive pair with its exact answer.
#[derive(Clone, Debug, PartialEq)]
pub struct HardCase {
    /// The case's name.
    pub name: String,
    /// The size and place, in metres. `far` is 1e7 from the origin along each axis.
    pub placement: String,
    /// The pair.
    pub pair: PrimitivePair<f64>,
    /// The exact answer.
    pub contact: ExactContact,
}

/// The exact answer.
#[derive(Clone, Debug, PartialEq)]
pub enum ExactContact {
    /// The pair does not touch at any time in [0, 1].
    Never,
    /// It touches.
    First {
        /// The time for readers: a ratio of small numbers, or the beginning of a decimal.
        exact: String,
        /// A lower bound of the time.
        from: f64,
        /// An upper bound: the next number, or the same.
        to: f64,
    },
    /// A coordinate is NaN or infinite: a method must exclude nothing.
    Undefined,
}

/// Returns all cases, in the order of the file.
///
/// # Panics
/// Panics if the file, which is part of the program, is not well-formed. A test reads it.
#[must_use]
pub fn hard_cases() -> &'static [HardCase] {
    static CASES: OnceLock<Vec<HardCase>> = OnceLock::new();
    CASES.get_or_init(|| {
        let text = include_str!("../data/hard-cases.csv");
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let rows = reader.records().map(|row| row.ok().as_ref().and_then(case));
        rows.map(|case| case.expect("the built-in file is well-formed")).collect()
    })
}

/// Reads a row: name, placement, kind, first, from, to, and 24 coordinates.
fn case(row: &csv::StringRecord) -> Option<HardCase> {
    let fields: Vec<&str> = row.iter().collect();
    let [name, placement, kind, first, from, to, coordinates @ ..] = fields.as_slice() else {
        return None;
    };
    let coordinates: Result<Vec<f64>, _> = coordinates.iter().map(|number| number.parse()).collect();
    let coordinates = coordinates.ok()?;
    let points: Vec<DVec3> = coordinates.chunks_exact(3).map(DVec3::from_slice).collect();
    let (start, end) = points.split_at_checked(4)?;
    let [start, end]: [[DVec3; 4]; 2] = [start.try_into().ok()?, end.try_into().ok()?];
    Some(HardCase {
        name: (*name).to_owned(),
        placement: (*placement).to_owned(),
        pair: PrimitivePair {
            kind: kind.parse().ok()?,
            motions: [0, 1, 2, 3].map(|point| Motion::new(start[point], end[point])),
        },
        contact: match *first {
            "never" => ExactContact::Never,
            "undefined" => ExactContact::Undefined,
            exact => ExactContact::First {
                exact: exact.to_owned(),
                from: from.parse().ok()?,
                to: to.parse().ok()?,
            },
        },
    })
}

#[cfg(test)]
mod tests {
    use super::{ExactContact, hard_cases};
    use std::collections::HashSet;

    #[test]
    fn the_built_in_file_is_read_and_each_case_has_a_name_of_its_own() {
        let cases = hard_cases();
        assert!(cases.len() > 300, "only {}", cases.len());
        let names: HashSet<_> = cases
            .iter()
            .map(|case| (&case.name, &case.placement, case.pair.kind))
            .collect();
        assert_eq!(names.len(), cases.len());
        for contact in [ExactContact::Never, ExactContact::Undefined] {
            assert!(cases.iter().any(|case| case.contact == contact));
        }
    }
}
