//! A table of a scene file, read key by key. Every error names its place.

use super::context::{NamedMesh, SceneContext};
use super::error::{SceneError, suggestion};
use super::field::{Count, Field, ValueError};
use selvedge_core::glam::DVec3;
use selvedge_files::FileSource;
use selvedge_files::excerpt::excerpt;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text to which the positions in messages refer.
#[derive(Debug)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) context: &'a SceneContext,
    pub(crate) text: &'a str,
}

/// One table, with its name for messages.
#[derive(Debug)]
pub(crate) struct Table<'a> {
    source: &'a Source<'a>,
    name: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
}

type Value<'a> = Spanned<DeValue<'a>>;

impl<'a> Table<'a> {
    pub(crate) fn root(source: &'a Source<'a>, entries: &'a DeTable<'a>) -> Self {
        Self {
            source,
            name: String::new(),
            span: 0..0,
            entries,
        }
    }

    /// Refuses every key that is not in `known`.
    pub(crate) fn expect_keys(&self, known: &[&str]) -> Result<(), SceneError> {
        for key in self.entries.keys() {
            let name = key.get_ref();
            if !known.contains(&name.as_ref()) {
                let message = format!(
                    "{} has no key '{}'{}",
                    self.described(),
                    shortened(name),
                    suggestion(name, known.iter().copied())
                );
                return Err(self.complain(key.span(), message));
            }
        }
        Ok(())
    }

    /// Returns the keys in the order of the file, with their places.
    pub(crate) fn keys(&self) -> Vec<(&str, Range<usize>)> {
        let mut keys: Vec<_> = self.entries.keys().map(|key| (key.get_ref().as_ref(), key.span())).collect();
        keys.sort_by_key(|(_, span)| span.start);
        keys
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// Reads a number in SI units, or returns `None` if the key is missing.
    pub(crate) fn number(&self, field: &Field) -> Result<Option<f64>, SceneError> {
        self.get(field.name).map(|value| self.quantity(field, value)).transpose()
    }

    pub(crate) fn required_number(&self, field: &Field) -> Result<f64, SceneError> {
        self.number(field)?
            .ok_or_else(|| self.missing(field.name, &field.quantity.example()))
    }

    /// Reads a number in SI units and maps it by `of`. Returns `otherwise` if the key is missing, and an error if `otherwise` is
    /// missing too.
    pub(crate) fn number_or<T>(&self, field: &Field, of: impl Fn(f64) -> T, otherwise: Option<T>) -> Result<T, SceneError> {
        match (self.number(field)?, otherwise) {
            (Some(number), _) => Ok(of(number)),
            (None, Some(otherwise)) => Ok(otherwise),
            (None, None) => self.required_number(field).map(of),
        }
    }

    pub(crate) fn count(&self, count: &Count) -> Result<Option<u32>, SceneError> {
        self.get(count.name).map(|value| self.whole(count, value)).transpose()
    }

    pub(crate) fn required_count(&self, count: &Count) -> Result<u32, SceneError> {
        self.count(count)?.ok_or_else(|| self.missing(count.name, "20"))
    }

    pub(crate) fn two_counts(&self, count: &Count) -> Result<[u32; 2], SceneError> {
        let example = "[20, 20]";
        let value = self.get(count.name).ok_or_else(|| self.missing(count.name, example))?;
        match value.get_ref() {
            DeValue::Array(array) if array.len() == 2 => Ok([self.whole(count, &array[0])?, self.whole(count, &array[1])?]),
            _ => Err(self.wrong(count.name, value, &format!("two whole numbers, such as {example}"))),
        }
    }

    pub(crate) fn counts(&self, count: &Count) -> Result<Option<Vec<u32>>, SceneError> {
        let Some(value) = self.get(count.name) else {
            return Ok(None);
        };
        let DeValue::Array(array) = value.get_ref() else {
            return Err(self.wrong(count.name, value, "a list of whole numbers"));
        };
        let whole = |value| self.whole(count, value);
        array.iter().map(whole).collect::<Result<_, _>>().map(Some)
    }

    pub(crate) fn numbers(&self, field: &Field) -> Result<Option<Vec<f64>>, SceneError> {
        let Some(value) = self.get(field.name) else {
            return Ok(None);
        };
        let DeValue::Array(array) = value.get_ref() else {
            return Err(self.wrong(field.name, value, "a list of numbers"));
        };
        let number = |value| self.quantity(field, value);
        array.iter().map(number).collect::<Result<_, _>>().map(Some)
    }

    pub(crate) fn vector(&self, field: &Field) -> Result<Option<DVec3>, SceneError> {
        self.get(field.name).map(|value| self.three(field, value)).transpose()
    }

    pub(crate) fn required_vector(&self, field: &Field) -> Result<DVec3, SceneError> {
        self.vector(field)?.ok_or_else(|| self.missing(field.name, "[0, 0, 1]"))
    }

    pub(crate) fn required_vectors(&self, field: &Field) -> Result<Vec<DVec3>, SceneError> {
        let example = "[[0, 0, 0], [1, 0, 0]]";
        let value = self.get(field.name).ok_or_else(|| self.missing(field.name, example))?;
        match value.get_ref() {
            DeValue::Array(array) => array.iter().map(|value| self.three(field, value)).collect(),
            _ => Err(self.wrong(field.name, value, &format!("a list of points, such as {example}"))),
        }
    }

    /// Reads `true` or `false`; false if the key is missing.
    pub(crate) fn flag(&self, key: &str) -> Result<bool, SceneError> {
        match self.get(key) {
            None => Ok(false),
            Some(value) => match value.get_ref() {
                DeValue::Boolean(flag) => Ok(*flag),
                _ => Err(self.wrong(key, value, "true or false")),
            },
        }
    }

    /// Reads one line of text, if the key is present. Control characters are refused, since the text may be shown on a terminal.
    pub(crate) fn text(&self, key: &str) -> Result<Option<&'a str>, SceneError> {
        match self.get(key) {
            None => Ok(None),
            Some(value) => match value.get_ref() {
                DeValue::String(text) if text.chars().any(char::is_control) => {
                    Err(self.wrong(key, value, "text without control characters, line breaks included"))
                }
                DeValue::String(text) => Ok(Some(text.as_ref())),
                _ => Err(self.wrong(key, value, "text in quotation marks")),
            },
        }
    }

    /// Reads a list of some of several names.
    pub(crate) fn choices<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<Vec<T>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(Vec::new());
        };
        let names = || choices.iter().map(|(choice, _)| *choice);
        let example = || format!("a list of some of \"{}\"", names().collect::<Vec<_>>().join("\", \""));
        let DeValue::Array(array) = value.get_ref() else {
            return Err(self.wrong(key, value, &example()));
        };
        let choice = |value: &Spanned<DeValue<'_>>| {
            let name = value.get_ref().as_str();
            let found = choices.iter().find(|(choice, _)| Some(*choice) == name);
            found.map(|(_, choice)| *choice).ok_or_else(|| {
                let meant = name.map_or_else(String::new, |name| suggestion(name, names()));
                self.complain(value.span(), format!("`{key}` is {}{meant}", example()))
            })
        };
        array.iter().map(choice).collect()
    }

    /// Reads one line of text. Messages show `example`.
    pub(crate) fn required_text(&self, key: &str, example: &str) -> Result<&'a str, SceneError> {
        self.text(key)?.ok_or_else(|| self.missing(key, example))
    }

    /// Reads one of several names.
    pub(crate) fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<Option<T>, SceneError> {
        let Some(name) = self.text(key)? else {
            return Ok(None);
        };
        match choices.iter().find(|(choice, _)| *choice == name) {
            Some(&(_, value)) => Ok(Some(value)),
            None => {
                let names = choices.iter().map(|(choice, _)| *choice);
                Err(self.error(
                    key,
                    format!("`{key}` cannot be '{}'{}", shortened(name), suggestion(name, names)),
                ))
            }
        }
    }

    pub(crate) fn required_choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<T, SceneError> {
        let names = || {
            let names: Vec<_> = choices.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            names.join(" or ")
        };
        self.choice(key, choices)?.ok_or_else(|| self.missing(key, &names()))
    }

    pub(crate) fn table(&self, key: &str) -> Result<Option<Table<'a>>, SceneError> {
        match self.get(key) {
            None => Ok(None),
            Some(value) => match value.get_ref() {
                DeValue::Table(entries) => Ok(Some(self.below(self.path_of(key), value.span(), entries))),
                _ => {
                    let header = format!("a table; begin it with [{}]", self.path_of(key));
                    Err(self.wrong(key, value, &header))
                }
            },
        }
    }

    pub(crate) fn required_table(&self, key: &str) -> Result<Table<'a>, SceneError> {
        self.table(key)?.ok_or_else(|| {
            let message = format!("the scene has no [{}]", self.path_of(key));
            self.complain(self.span.clone(), message)
        })
    }

    /// Returns the table of this name (`[key]`), or the tables (`[[key]]`); at least one is required.
    pub(crate) fn one_or_more_tables(&self, key: &str) -> Result<Vec<Table<'a>>, SceneError> {
        let tables = self.any_tables(key)?;
        if tables.is_empty() {
            return Ok(vec![self.required_table(key)?]);
        }
        Ok(tables)
    }

    /// Returns the table of this name (`[key]`), or the tables (`[[key]]`); empty if the key is missing.
    pub(crate) fn any_tables(&self, key: &str) -> Result<Vec<Table<'a>>, SceneError> {
        match self.get(key).map(Spanned::get_ref) {
            Some(DeValue::Table(_)) => Ok(vec![self.required_table(key)?]),
            _ => self.tables(key),
        }
    }

    /// Returns the tables of this name (`[[key]]`); empty if the key is missing.
    pub(crate) fn tables(&self, key: &str) -> Result<Vec<Table<'a>>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(Vec::new());
        };
        let header = format!("a list of tables; begin each with [[{}]]", self.path_of(key));
        let DeValue::Array(array) = value.get_ref() else {
            return Err(self.wrong(key, value, &header));
        };
        array
            .iter()
            .map(|element| match element.get_ref() {
                DeValue::Table(entries) => Ok(self.below(self.path_of(key), element.span(), entries)),
                _ => Err(self.wrong(key, element, &header)),
            })
            .collect()
    }

    /// Returns an error about the value of `key`, or about the table if the key is missing.
    pub(crate) fn error(&self, key: &str, message: String) -> SceneError {
        let span = self.get(key).map_or(self.span.clone(), Spanned::span);
        self.complain(span, message)
    }

    pub(crate) fn placed(&self, error: &ValueError) -> SceneError {
        self.error(error.field, error.message.clone())
    }

    pub(crate) fn complain(&self, span: Range<usize>, message: String) -> SceneError {
        SceneError::at(self.source.path, self.source.text, &span, message)
    }

    /// Returns the folder to which paths in the file are relative.
    pub(crate) fn folder(&self) -> &Path {
        self.source.path.parent().unwrap_or(Path::new("."))
    }

    /// Returns the source of the files that the scene names.
    pub(crate) fn files(&self) -> &FileSource {
        &self.source.context.files
    }

    /// Returns the mesh from code that the value of `mesh` names.
    pub(crate) fn named_mesh(&self) -> Result<&'a NamedMesh, SceneError> {
        let name = self.required_text("mesh", "\"shirt\"")?;
        let meshes = &self.source.context.meshes;
        meshes.iter().find(|mesh| mesh.name == name).ok_or_else(|| {
            let remedy = if meshes.is_empty() {
                "; meshes come from code, and files have the shape \"file\"".to_owned()
            } else {
                suggestion(name, meshes.iter().map(|mesh| mesh.name.as_str()))
            };
            self.error("mesh", format!("there is no mesh '{}'{remedy}", shortened(name)))
        })
    }

    fn get(&self, key: &str) -> Option<&'a Value<'a>> {
        self.entries.get(key)
    }

    fn below(&self, name: String, span: Range<usize>, entries: &'a DeTable<'a>) -> Table<'a> {
        Table {
            source: self.source,
            name,
            span,
            entries,
        }
    }

    fn path_of(&self, key: &str) -> String {
        if self.name.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.name)
        }
    }

    fn described(&self) -> String {
        if self.name.is_empty() {
            "a scene".to_owned()
        } else {
            format!("[{}]", self.name)
        }
    }

    fn missing(&self, key: &str, example: &str) -> SceneError {
        let message = format!("{} needs `{key}`, such as {example}", self.described());
        self.complain(self.span.clone(), message)
    }

    fn wrong(&self, key: &str, value: &Value<'_>, expected: &str) -> SceneError {
        let found = match value.get_ref() {
            DeValue::String(text) => format!("the text '{}'", shortened(text)),
            DeValue::Array(array) => format!("a list of {}", array.len()),
            other => format!("of type {}", other.type_str()),
        };
        self.complain(value.span(), format!("`{key}` must be {expected}, but is {found}"))
    }

    fn quantity(&self, field: &Field, value: &Value<'_>) -> Result<f64, SceneError> {
        let Field { name, quantity, .. } = field;
        let complain = |message| self.complain(value.span(), message);
        let number = match value.get_ref() {
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .map(|integer| integer as f64)
                .map_err(|_| complain(format!("`{name}` is too large a number")))?,
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            DeValue::String(text) => quantity
                .parse(text)
                .map_err(|problem| complain(format!("`{name}` {problem}")))?,
            _ => return Err(self.wrong(name, value, &quantity.example())),
        };
        field.check(number).map_err(|error| complain(error.message))?;
        Ok(number)
    }

    fn three(&self, field: &Field, value: &Value<'_>) -> Result<DVec3, SceneError> {
        match value.get_ref() {
            DeValue::Array(array) if array.len() == 3 => {
                let component = |k: usize| self.quantity(field, &array[k]);
                Ok(DVec3::new(component(0)?, component(1)?, component(2)?))
            }
            _ => Err(self.wrong(field.name, value, "a list of three numbers, such as [0, 0, 1]")),
        }
    }

    fn whole(&self, count: &Count, value: &Value<'_>) -> Result<u32, SceneError> {
        let DeValue::Integer(integer) = value.get_ref() else {
            return Err(self.wrong(count.name, value, "a whole number"));
        };
        let number = u32::from_str_radix(integer.as_str(), integer.radix()).ok();
        number.filter(|&number| count.check(number).is_ok()).ok_or_else(|| {
            let message = count.complaint(&shortened(integer.as_str()));
            self.complain(value.span(), message)
        })
    }
}

fn shortened(text: &str) -> String {
    excerpt(text, 40)
}
