//! The time of impact of many pairs.

use super::prelude::*;
use selvedge_core::batch::{Round, RoundQuestion, advance_from_rows};

/// Answers pairs of one kind side by side: rounds in lanes, then each open pair alone from the time reached.
pub(crate) fn side_by_side<S: Format>(level: Level, kind: PairKind, pairs: &[PairCase<S>], limits: &Limits<S>) -> Vec<Impact<S>> {
    let rows: Vec<_> = pairs.iter().flat_map(PairCase::motions).map(VertexRow::new).collect();
    let mut impacts = vec![Impact::Never; pairs.len()];
    let mut open: Vec<(usize, S)> = (0..pairs.len()).map(|index| (index, S::ZERO)).collect();
    for sweep in 0..6 {
        let question = RoundQuestion {
            limits: *limits,
            until: S::ONE,
            with_volume: sweep > 1,
        };
        let indices: Vec<_> = open
            .iter()
            .map(|&(index, _)| [0, 1, 2, 3].map(|point| 4 * index as u32 + point))
            .collect();
        let mut times: Vec<S> = open.iter().map(|&(_, time)| time).collect();
        let mut rounds = vec![Round::default(); open.len().div_ceil(LANES)];
        advance_from_rows(level, kind, &question, &rows, &indices, &mut times, &mut rounds);
        for (place, Round { apart, near, stuck }) in rounds.iter().enumerate() {
            assert_eq!(apart & near | apart & stuck | near & stuck, 0);
            let lanes = (open.len() - place * LANES).min(LANES);
            assert_eq!(u64::from(apart | near | stuck) >> lanes, 0, "lanes without a pair");
        }
        let mut remaining = Vec::new();
        for (place, &(index, _)) in open.iter().enumerate() {
            let (round, bit, time) = (rounds[place / LANES], 1 << (place % LANES), times[place]);
            if round.near & bit != 0 {
                impacts[index] = Impact::Possible {
                    time,
                    reason: Reason::WithinTolerance,
                };
            } else if round.stuck & bit != 0 {
                impacts[index] = time_of_impact_within(&pairs[index].pair(), limits, time, S::ONE);
            } else if round.apart & bit == 0 {
                remaining.push((index, time));
            }
        }
        open = remaining;
    }
    for (index, time) in open {
        impacts[index] = time_of_impact_within(&pairs[index].pair(), limits, time, S::ONE);
    }
    impacts
}
