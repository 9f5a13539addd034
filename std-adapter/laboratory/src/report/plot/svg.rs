//! Elements and colours of a picture.

use crate::report::printable;
use maud::{Markup, html};

pub(super) const PAPER_WHITE: &str = "#fdfdfc";
pub(super) const INK: &str = "#1f2328";
pub(super) const FAINT_INK: &str = "#656d76";

/// Rounds to a hundredth of a pixel, to keep the file short.
pub(super) fn px(length: f64) -> f64 {
    (100.0 * length).round() / 100.0
}

pub(super) fn line(class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) -> Markup {
    let class = Some(class).filter(|class| !class.is_empty());
    html! { line class=[class] x1=(px(x1)) y1=(px(y1)) x2=(px(x2)) y2=(px(y2)) {} }
}

pub(super) fn text(class: &str, [x, y]: [f64; 2], content: &str) -> Markup {
    let class = Some(class).filter(|class| !class.is_empty());
    html! { text class=[class] x=(px(x)) y=(px(y)) { (printable(content)) } }
}
