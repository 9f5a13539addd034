//! Plots as SVG pictures with a light background of their own. `accuracy`, `elementary`, `scaling` and `truths` choose the
//! content; `picture` draws it.

mod accuracy;
mod axis;
mod elementary;
mod look;
mod picture;
mod scaling;
mod svg;
#[cfg(test)]
mod texts;
mod truths;

pub use accuracy::accuracy_svg;
pub use elementary::elementary_svg;
pub use scaling::scaling_svg;
pub use truths::{convergence_svg, cost_of_accuracy_svg, cost_of_law_svg, truth_svg};
