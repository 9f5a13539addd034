//! Marks of points, by colour and by shape.

use super::svg::{PAPER_WHITE, line, px};
use maud::{Markup, html};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Look {
    /// Okabe and Ito's colours, which colour-blind people can distinguish; some are darkened.
    pub(super) colour: &'static str,
    pub(super) shape: MarkShape,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MarkShape {
    Disc,
    Ring,
    Diamond,
    Triangle,
    Cross,
    /// No mark, for points that only a line passes.
    None,
}

impl Look {
    /// Methods that decide by rounded arithmetic and a bound.
    pub(super) const CERTIFIED: Self = Self::new("#0072b2", MarkShape::Disc);
    /// Methods that decide by rounded arithmetic and a bound, one pair at a time.
    pub(super) const ONE_AT_A_TIME: Self = Self::new("#0072b2", MarkShape::Ring);
    /// Methods that decide by exact arithmetic.
    pub(super) const EXACT: Self = Self::new("#007a58", MarkShape::Diamond);
    /// Methods that decide by bisection of time and parameters.
    pub(super) const BISECTION: Self = Self::new("#a8508a", MarkShape::Triangle);
    /// Methods that decide without proof.
    pub(super) const UNSAFE: Self = Self::new("#d55e00", MarkShape::Cross);

    pub(super) const fn new(colour: &'static str, shape: MarkShape) -> Self {
        Self { colour, shape }
    }

    /// Draws the mark, with its middle at (`x`, `y`).
    pub(super) fn mark(self, [x, y]: [f64; 2]) -> Markup {
        const R: f64 = 5.0;
        let Self { colour, shape } = self;
        let polygon = |points: &[[f64; 2]]| {
            let points = points.iter().map(|[dx, dy]| format!("{},{} ", px(x + dx), px(y + dy)));
            html! { polygon points=(points.collect::<String>().trim_end()) fill=(colour) {} }
        };
        match shape {
            MarkShape::Disc => html! { circle cx=(px(x)) cy=(px(y)) r=(R) fill=(colour) {} },
            MarkShape::Ring => {
                html! { circle cx=(px(x)) cy=(px(y)) r=(R) fill=(PAPER_WHITE) stroke=(colour) stroke-width="2" {} }
            }
            MarkShape::Diamond => polygon(&[[0.0, -1.35 * R], [1.35 * R, 0.0], [0.0, 1.35 * R], [-1.35 * R, 0.0]]),
            MarkShape::Triangle => polygon(&[[0.0, -1.25 * R], [1.2 * R, 0.9 * R], [-1.2 * R, 0.9 * R]]),
            MarkShape::Cross => html! { g stroke=(colour) stroke-width="3" {
                (line("", [x - R, y - R], [x + R, y + R]))
                (line("", [x - R, y + R], [x + R, y - R]))
            } },
            MarkShape::None => html! {},
        }
    }
}
