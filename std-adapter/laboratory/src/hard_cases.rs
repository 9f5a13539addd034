//! Hard cases of the literature by name, with exact answers: degenerate pairs, and Erleben's shapes rebuilt from their geometry.
//! Each case stands at several sizes and places.
//!
//! They are the file `named.jsonl` of the conformance suite, which is part of the program. Its answers come from exact arithmetic
//! on the very numbers that it holds. The project's tests repeat that computation.

use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, PrimitivePair};
use serde_json::Value;
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
pub fn hard_cases() -> &'static [HardCase] {
    static CASES: OnceLock<Vec<HardCase>> = OnceLock::new();
    CASES.get_or_init(|| {
        let rows = include_str!("../data/named.jsonl")
            .lines()
            .map(|line| serde_json::from_str(line).ok());
        let cases = rows.map(|row| row.as_ref().and_then(case));
        cases.map(|case| case.expect("the built-in file is well-formed")).collect()
    })
}

/// Reads a line as the suite's `schema.json` describes it.
fn case(row: &Value) -> Option<HardCase> {
    let name = |key: &str| row[key].as_str().map(str::to_owned);
    let points = |end: &str| -> Option<[DVec3; 4]> {
        let points = row[end].as_array()?.iter().map(|point| numbers(point).map(DVec3::from_array));
        points.collect::<Option<Vec<_>>>()?.try_into().ok()
    };
    let (start, end) = (points("start")?, points("end")?);
    Some(HardCase {
        name: name("kind")?,
        placement: name("place")?,
        pair: PrimitivePair::new(
            row["question"].as_str()?.parse().ok()?,
            [0, 1, 2, 3].map(|point| Motion::new(start[point], end[point])),
        ),
        contact: match row["touches"].as_bool() {
            None => ExactContact::Undefined,
            Some(false) => ExactContact::Never,
            Some(true) => {
                let [from, to] = numbers(&row["first"])?;
                let exact = name("exact").unwrap_or_else(|| format!("about {from:.6}"));
                ExactContact::First { exact, from, to }
            }
        },
    })
}

/// Reads an array of hexadecimal floats.
fn numbers<const N: usize>(array: &Value) -> Option<[f64; N]> {
    let number = |text: &Value| match text.as_str()? {
        not_finite @ ("nan" | "inf" | "-inf") => not_finite.parse().ok(),
        number => hexf_parse::parse_hexf64(number, false).ok(),
    };
    array
        .as_array()?
        .iter()
        .map(number)
        .collect::<Option<Vec<_>>>()?
        .try_into()
        .ok()
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
