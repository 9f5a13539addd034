//! Tables as text, made to be read in a terminal of 80 columns.

#[cfg(feature = "accuracy")]
mod accuracy;
mod comparison;
#[cfg(all(feature = "accuracy", feature = "files"))]
mod elementary;
#[cfg(feature = "files")]
mod hard_cases;
#[cfg(feature = "files")]
mod queries;
mod scaling;
#[cfg(feature = "simulation")]
mod simulation;
mod step;

#[cfg(feature = "accuracy")]
pub use accuracy::accuracy;
pub use comparison::comparison;
#[cfg(all(feature = "accuracy", feature = "files"))]
pub use elementary::elementary;
#[cfg(feature = "files")]
pub use hard_cases::hard_cases;
#[cfg(feature = "files")]
pub use queries::queries;
pub use scaling::scaling;
#[cfg(feature = "simulation")]
pub use simulation::{effects_one_by_one, simulation};
pub use step::step;

use comfy_table::{CellAlignment, LineStyle, Row, Table, TableStyle};

/// A table with a line under its header; the first column to the left, numbers to the right.
fn table<R: Into<Row>>(header: impl Into<Row>, rows: impl IntoIterator<Item = R>) -> String {
    let mut table = Table::new();
    let line = LineStyle::none().fill('─').junction('─');
    table.load_style(TableStyle::new().header_separator(line));
    table.set_header(header);
    for row in rows {
        table.add_row(row);
    }
    for (index, column) in table.column_iter_mut().enumerate() {
        if index > 0 {
            column.set_cell_alignment(CellAlignment::Right);
            column.set_padding((1, 0));
        } else {
            column.set_padding((0, 0));
        }
    }
    table.trim_fmt() + "\n"
}
