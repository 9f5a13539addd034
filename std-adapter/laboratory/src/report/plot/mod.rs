//! Plots as SVG pictures with a light background of their own. `accuracy`, `elementary` and `scaling` choose the content;
//! `picture` draws it.

mod accuracy;
mod axis;
mod elementary;
mod look;
mod picture;
mod scaling;
mod svg;
#[cfg(test)]
mod texts;

pub use accuracy::accuracy_svg;
pub use elementary::elementary_svg;
pub use scaling::scaling_svg;
