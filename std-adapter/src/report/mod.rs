//! Pictures of what studies found. Everything is returned as text or bytes; nothing here writes a file.
//! The same data gives the same bytes, on every machine.

mod figure;
mod number;
mod paper;
mod plot;
mod table_svg;

pub use figure::{FIGURE_SIZE, FigureError, FigurePairs, figure_3};
pub use paper::{PaperRow, paper_row};
pub use plot::scaling_svg;
pub use table_svg::comparison_svg;
