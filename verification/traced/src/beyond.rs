//! Terms of Coq for what the certified filter and the time of impact compute with a separation.

use crate::Text;
use crate::coq::{Terms, coordinates, direction, machine_input};
use crate::symbols::{Traced, if_any, trace};
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::advance::directions::{are_apart_curving, are_apart_turning};
use selvedge_core::kernels::advance::volume::SignedVolume;
use selvedge_core::kernels::points::{EdgeEdge, PairPoints, PairShape, VertexFace};
use selvedge_core::kernels::separation_lanes::SeparationLanes;
use std::fmt::Write;

const FILTER_HEAD: &str = "\
(* What the certified filter computes with a separation: core/src/filter/certified.rs, core/src/kernels/coplanarity.rs.
   Written from the code by verification/traced/src/beyond.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Expressions Machine.

";

const ADVANCE_HEAD: &str = "\
(* What the time of impact computes with a separation: core/src/kernels/advance/directions.rs, volume.rs.
   Written from the code by verification/traced/src/beyond.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Expressions Machine.

";

/// The files that `verification/proofs` builds on, beside those of [`coq`](crate::coq).
pub(crate) fn files() -> Vec<Text> {
    [("Beyond.v", filter()), ("AdvanceBeyond.v", advance())]
        .map(|(name, text)| (name.to_owned(), text))
        .into()
}

/// Writes the decision of the filter with a separation: without a lane that needs the permanent, and with one.
fn filter() -> String {
    let mut text = String::from(FILTER_HEAD);
    filter_beyond::<VertexFace>("a_vertex_and_a_face", &mut text);
    filter_beyond::<EdgeEdge>("two_edges", &mut text);
    text
}

fn filter_beyond<P: PairShape>(of: &str, text: &mut String) {
    let ((normal, masks), steps) = trace(|| {
        let points = coordinates().tetrahedron::<P>();
        let separation = Traced::input("Length Separation");
        let separation = SeparationLanes::new(separation, separation);
        let masks = [
            ("by_permanent_alone", points.decide::<P>(separation).culled),
            ("by_permanent", if_any(|| points.decide::<P>(separation).culled)),
        ];
        (points.largest_normal(P::KIND), masks)
    });
    let mut terms = Terms::new("number", &steps);
    terms.input = machine_input;
    terms.define_for_use("largest_normal", normal);
    let formulas = masks.map(|(name, mask)| (name, terms.mask(mask)));
    writeln!(text, "Module {of}.\n{}", terms.text.trim_end()).expect("a string");
    for (name, formula) in formulas {
        writeln!(text, "Definition culled_{name} : mask := {formula}.").expect("a string");
    }
    writeln!(text, "End {of}.\n").expect("a string");
}

/// Writes the proofs of a round.
pub(crate) fn advance() -> String {
    let mut text = String::from(ADVANCE_HEAD);
    proofs_beyond("a_vertex_and_a_face", Corners::of_vertex_face, &mut text);
    proofs_beyond("two_edges", Corners::of_edge_edge, &mut text);
    text
}

/// Writes the assumptions and results of each proof of one round with a separation, for corners in range.
fn proofs_beyond<const N: usize>(of: &str, corners: fn(&PairPoints<Traced>) -> Corners<Traced, N>, text: &mut String) {
    let ((margins, masks, times), steps) = trace(|| {
        let corners = corners(&coordinates());
        let in_range = corners.are_in_range();
        let separation = Traced::input("Length Separation");
        let separation = SeparationLanes::new(separation, separation);
        let moments = [0, 1].map(|number| Traced::input(format!("Moment {number}")));
        let [now, later] = moments.map(|moment| corners.at(moment));
        let curve = [0, 1, 2].map(|number| corners.direction_beyond(direction(number), &separation));
        let [first, second, _] = &curve;
        let held = corners.apart_along(first, &now, in_range);
        let volume = SignedVolume::beyond(&corners, &separation);
        let margins = volume.margins_from(moments[0]);
        let clipped = volume.clipped(moments[0]);
        let masks = [
            ("in_range", in_range),
            ("held", held.is_apart),
            ("turning", are_apart_turning(first, &now, second, &later)),
            ("curving", are_apart_curving(&curve, &now, &later)),
            ("volume_throughout", volume.proves_apart_throughout()),
            ("volume_to_the_end", clipped.to_the_end),
        ];
        (margins, masks, [("held", held.until), ("volume", clipped.until)])
    });
    let mut terms = Terms::new("number", &steps);
    terms.input = machine_input;
    for (index, margin) in margins.into_iter().enumerate() {
        terms.define_for_use(&format!("margin_{index}"), margin);
    }
    for (name, mask) in masks {
        let formula = terms.mask(mask);
        writeln!(terms.text, "Definition {name} : mask := {formula}.").expect("a string");
    }
    for (name, time) in times {
        terms.define(&format!("until_{name}"), time);
    }
    writeln!(text, "Module {of}.\n{}End {of}.\n", terms.text).expect("a string");
}
