//! The time of impact advances only by proofs of its kernels: its record, proven again part by part, lasts until exactly the
//! answered time.
//!
//! `verification/proofs/Replay.v` has the same interpreter of records, with the theorem that it is right about the traced terms.

use crate::support::prelude::*;
use selvedge_core::elementary::advance::{Proof, WitnessPart, witness};
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::advance::directions::{Direction, are_apart_curving, are_apart_turning};
use selvedge_core::kernels::advance::volume::SignedVolume;
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::PairPoints;
use selvedge_core::kernels::separation_lanes::SeparationLanes;

/// The largest number of times that the volume is clipped in one round.
const CLIPS: u32 = 8;

/// A pair and its limits.
#[derive(Clone, Debug)]
struct Question<S: Format> {
    pair: PairCase<S>,
    limits: Limits<S>,
}

impl<S: Format> Simplify for Question<S> {
    fn attempts(&self) -> usize {
        1 + self.pair.attempts()
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = self.clone();
        match attempt {
            0 if self.limits.separation != S::ZERO => simpler.limits.separation = S::ZERO,
            0 => return None,
            _ => simpler.pair = self.pair.simpler(attempt - 1)?,
        }
        Some(simpler)
    }
}

/// Chooses any pair, or one that slides and takes many rounds, without a separation or with one of about the size of its
/// distance.
fn questions<S: Format>() -> impl Strategy<Value = Question<S>> + Clone {
    from_choices(|choices| {
        let kind = choices.pick(&PairKind::ALL);
        let slides = choices.once_in(2);
        let pair = if slides {
            PairCase::choose_sliding(kind, choices)
        } else {
            PairCase::choose(kind, choices)
        };
        let nearly = S::exact(1, -choices.pick(&[1, 3, 10, 17, 23]));
        let limits = Limits {
            tolerance: choices.pick(&[S::ZERO, S::exact(1, -30), S::exact(1, -10)]),
            separation: choices.pick(&[S::ZERO, S::ZERO, nearly]),
        };
        Question { pair, limits }
    })
}

/// What the kernels prove of one pair.
struct Kernels<S, const N: usize> {
    corners: Corners<S, N>,
    separation: SeparationLanes<S>,
    volume: SignedVolume<S>,
    /// The pair's boxes are beyond the separation along an axis.
    has_boxes_apart: bool,
}

impl<S: Format, const N: usize> Kernels<S, N> {
    fn new(corners: Corners<S, N>, points: &PairPoints<S>, kind: PairKind, separation: S) -> Self {
        let has_boxes_apart = if separation > S::ZERO {
            corners.are_beyond_along_an_axis(separation)
        } else {
            of_kind!(kind, P => points.are_apart_along_three_axes::<P>())
        };
        let separation = SeparationLanes::new(separation, separation);
        Self {
            volume: SignedVolume::beyond(&corners, &separation),
            corners,
            separation,
            has_boxes_apart,
        }
    }

    /// Returns the time until which a record proves that the pair is apart, if each of its parts is proven until exactly its end.
    fn proven(&self, record: &[WitnessPart<S>]) -> Option<S> {
        if let [part] = record
            && self.has_boxes_apart
        {
            return (part.until == S::ONE && is_axis(part.proof)).then_some(S::ONE);
        }
        record.iter().try_fold(S::ZERO, |from, part| {
            let until = self.part(from, part)?;
            (until == part.until).then_some(until)
        })
    }

    fn part(&self, from: S, part: &WitnessPart<S>) -> Option<S> {
        let [now, then] = [from, part.until].map(|time| self.corners.at(time));
        match part.proof {
            Proof::Volume => self.clipped(from, part.until),
            Proof::Held(w) => {
                let proven = self.corners.apart_along(&self.direction(w)?, &now, true);
                proven.is_apart.then(|| proven.until.smaller(S::ONE))
            }
            Proof::Turning([v, w]) => {
                let (before, after) = (self.direction(v)?, self.direction(w)?);
                (from < part.until && are_apart_turning(&before, &now, &after, &then)).then_some(part.until)
            }
            Proof::Curving([v, m, w]) => {
                let curve = [self.direction(v)?, self.direction(m)?, self.direction(w)?];
                (from < part.until && are_apart_curving(&curve, &now, &then)).then_some(part.until)
            }
        }
    }

    fn clipped(&self, from: S, until: S) -> Option<S> {
        let mut time = from;
        for _ in 0..CLIPS {
            let next = self.volume.clipped(time);
            if next.to_the_end {
                return Some(S::ONE);
            }
            if next.until <= time {
                return None;
            }
            time = next.until;
            if time == until {
                return Some(time);
            }
        }
        None
    }

    /// Returns a direction. None may be longer along an axis than the kernels' proofs allow.
    fn direction(&self, w: [S; 3]) -> Option<Direction<S>> {
        let longest = S::LARGEST_EDGE * S::small(4);
        let is_short = w.iter().all(|x| x.abs() <= longest);
        is_short.then(|| self.corners.direction_beyond(Vector::from(w), &self.separation))
    }
}

fn is_axis<S: Format>(proof: Proof<S>) -> bool {
    matches!(proof, Proof::Held(w) if {
        let mut sizes = w.map(|x| x.abs().to_f64());
        sizes.sort_by(f64::total_cmp);
        sizes == [0.0, 0.0, 1.0]
    })
}

/// Returns the time until which a record proves the pair of a question apart.
fn proven<S: Format>(question: &Question<S>, record: &[WitnessPart<S>]) -> Option<S> {
    let pair = question.pair.pair();
    let points = PairPoints::from(&pair);
    let separation = question.limits.separation.raised_to_normal();
    match pair.kind {
        PairKind::VertexFace => Kernels::new(Corners::of_vertex_face(&points), &points, pair.kind, separation).proven(record),
        PairKind::EdgeEdge => Kernels::new(Corners::of_edge_edge(&points), &points, pair.kind, separation).proven(record),
    }
}

/// The numbers of parts with each proof, and of records with more than three rounds.
#[derive(Default)]
struct Seen {
    held: Cell<u32>,
    turning: Cell<u32>,
    curving: Cell<u32>,
    volume: Cell<u32>,
    hard: Cell<u32>,
}

fn count(cell: &Cell<u32>) {
    cell.set(cell.get() + 1);
}

fn record_is_proven_again<S: Format>(question: &Question<S>, seen: &Seen) -> TestCaseResult {
    let (impact, witness) = witness(&question.pair.pair(), &question.limits);
    let record = witness.parts();
    for part in record {
        count(match part.proof {
            Proof::Volume => &seen.volume,
            Proof::Held(_) => &seen.held,
            Proof::Turning(_) => &seen.turning,
            Proof::Curving(_) => &seen.curving,
        });
    }
    if record.len() > 3 {
        count(&seen.hard);
    }
    let answered = impact.time().unwrap_or(S::ONE);
    prop_assert_eq!(proven(question, record), Some(answered), "{:?} {:?}", impact, record);

    // A held direction proves until one time only, so a later end is refused.
    for (index, part) in record.iter().enumerate() {
        if part.until < S::ONE && matches!(part.proof, Proof::Held(_)) {
            let mut altered = record.to_vec();
            altered[index].until = part.until.next_up();
            prop_assert_eq!(proven(question, &altered), None, "part {} of {:?}", index, record);
        }
    }
    Ok(())
}

fn every_record_is_proven_again<S: Format>() {
    let seen = Seen::default();
    check(20_000, questions::<S>(), |question| record_is_proven_again(question, &seen));
    for (name, cell, least) in [
        ("held", &seen.held, 10_000),
        ("turning", &seen.turning, 1_000),
        ("curving", &seen.curving, 100),
        ("volume", &seen.volume, 1_000),
        ("hard", &seen.hard, 1_000),
    ] {
        assert!(cell.get() >= least, "{name}: {}", cell.get());
    }
}

formats!(every_record_is_proven_again);
