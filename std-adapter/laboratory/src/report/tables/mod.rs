//! Tables as text, for a terminal of 80 columns.

mod accuracy;
mod comparison;
mod elementary;
mod hard_cases;
mod queries;
mod scaling;
mod simulation;
mod step;
mod truths;

pub use accuracy::accuracy;
pub use comparison::comparison;
pub use elementary::elementary;
pub use hard_cases::hard_cases;
pub use queries::queries;
pub use scaling::scaling;
pub use simulation::{effects_one_by_one, simulation};
pub use step::step;
pub use truths::truths;

use comfy_table::{CellAlignment, LineStyle, Row, Table, TableStyle};

/// Returns a table with a line under its header. The first column is aligned left, the others right.
pub(super) fn table<R: Into<Row>>(header: impl Into<Row>, rows: impl IntoIterator<Item = R>) -> String {
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
