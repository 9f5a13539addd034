//! Another revision's errors against laws, from its `selvedge truths --json`.

use serde_json::Value;

/// The runs of another revision.
#[derive(Clone, Debug, Default)]
pub struct PriorRuns(Vec<PriorRun>);

/// One run of another revision.
#[derive(Clone, Debug)]
pub(super) struct PriorRun {
    law: String,
    mesh: u64,
    is_irregular: bool,
    pub(super) accuracy: String,
    pub(super) pace: String,
    /// The largest error; NaN if the run failed.
    pub(super) error: f64,
    pub(super) seconds: f64,
}

/// A document is not that of `selvedge truths --json`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PriorError {
    /// The text is not JSON.
    #[error("not a JSON document: {0}")]
    Json(String),
    /// There is no list of rows.
    #[error("the document has no `rows`: give the output of `selvedge truths --json`")]
    NoRows,
    /// A row lacks a field, or the field has another type.
    #[error("row {row} has no `{field}`: give the output of `selvedge truths --json` of a revision whose rows have a pace")]
    Field {
        /// The number of the row, from zero.
        row: usize,
        /// The field.
        field: &'static str,
    },
}

impl PriorRuns {
    /// Reads the document of `selvedge truths --json`.
    ///
    /// # Errors
    /// Returns an error that names the row and the field, if the document is another one.
    pub fn parse(text: &str) -> Result<Self, PriorError> {
        let document: Value = serde_json::from_str(text).map_err(|error| PriorError::Json(error.to_string()))?;
        let rows = document["rows"].as_array().ok_or(PriorError::NoRows)?;
        rows.iter()
            .enumerate()
            .map(PriorRun::read)
            .collect::<Result<_, _>>()
            .map(Self)
    }

    /// Returns the runs of a law on one mesh.
    pub(super) fn on(&self, law: &str, mesh: u32, is_irregular: bool) -> impl Iterator<Item = &PriorRun> {
        let is_meant = move |run: &&PriorRun| run.law == law && run.mesh == u64::from(mesh) && run.is_irregular == is_irregular;
        self.0.iter().filter(is_meant)
    }
}

impl PriorRun {
    fn read((row, value): (usize, &Value)) -> Result<Self, PriorError> {
        let missing = |field| move || PriorError::Field { row, field };
        let text = |field| value[field].as_str().map(str::to_owned).ok_or_else(missing(field));
        Ok(Self {
            law: text("law")?,
            mesh: value["mesh"].as_u64().ok_or_else(missing("mesh"))?,
            is_irregular: value["irregular"].as_bool().ok_or_else(missing("irregular"))?,
            accuracy: text("accuracy")?,
            pace: text("pace")?,
            error: value["error"].as_f64().unwrap_or(f64::NAN),
            seconds: value["seconds"].as_f64().ok_or_else(missing("seconds"))?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_row_and_the_field() {
        let row = r#"{"law": "sail", "mesh": 16, "irregular": false, "accuracy": "default", "error": null, "seconds": 1}"#;
        let wrong = PriorRuns::parse(&format!(r#"{{"rows": [{row}]}}"#)).unwrap_err();
        assert_eq!(wrong, PriorError::Field { row: 0, field: "pace" });
        assert_eq!(PriorRuns::parse("{}").unwrap_err(), PriorError::NoRows);
    }
}
