//! A table of a scene file, read key by key. Every complaint names the place.

use super::error::{SceneError, suggestion};
use super::quantity::Quantity;
use selvedge_core::glam::DVec3;
use selvedge_files::excerpt::excerpt;
use std::ops::{Range, RangeInclusive};
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text that positions in messages refer to.
#[derive(Debug)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) text: &'a str,
}

/// One table, and its name as messages write it.
#[derive(Debug)]
pub(crate) struct Table<'a> {
    source: &'a Source<'a>,
    name: String,
    span: Range<usize>,
    entries: &'a DeTable<'a>,
}

type Value<'a> = Spanned<DeValue<'a>>;

impl<'a> Table<'a> {
    /// The whole file.
    pub(crate) fn root(source: &'a Source<'a>, entries: &'a DeTable<'a>) -> Self {
        Self {
            source,
            name: String::new(),
            span: 0..0,
            entries,
        }
    }

    /// Refuses every key that is not one of `known`.
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

    /// The keys in the order of the file, with their places.
    pub(crate) fn keys(&self) -> Vec<(&str, Range<usize>)> {
        let mut keys: Vec<_> = self.entries.keys().map(|key| (key.get_ref().as_ref(), key.span())).collect();
        keys.sort_by_key(|(_, span)| span.start);
        keys
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// A number in SI units, if the key is there.
    pub(crate) fn number(&self, key: &str, quantity: Quantity, range: RangeInclusive<f64>) -> Result<Option<f64>, SceneError> {
        self.get(key)
            .map(|value| self.quantity(key, value, quantity, range))
            .transpose()
    }

    /// A number in SI units.
    pub(crate) fn required_number(&self, key: &str, quantity: Quantity, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
        self.number(key, quantity, range)?
            .ok_or_else(|| self.missing(key, &quantity.example()))
    }

    /// A whole number, if the key is there.
    pub(crate) fn count(&self, key: &str, range: RangeInclusive<u64>) -> Result<Option<u64>, SceneError> {
        self.get(key).map(|value| self.whole(key, value, &range)).transpose()
    }

    /// Two whole numbers.
    pub(crate) fn two_counts(&self, key: &str, range: RangeInclusive<u64>) -> Result<[u64; 2], SceneError> {
        let example = "[20, 20]";
        let value = self.get(key).ok_or_else(|| self.missing(key, example))?;
        match value.get_ref() {
            DeValue::Array(array) if array.len() == 2 => {
                Ok([self.whole(key, &array[0], &range)?, self.whole(key, &array[1], &range)?])
            }
            _ => Err(self.wrong(key, value, &format!("two whole numbers, such as {example}"))),
        }
    }

    /// Any number of whole numbers, if the key is there.
    pub(crate) fn counts(&self, key: &str, range: RangeInclusive<u64>) -> Result<Option<Vec<u64>>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        let DeValue::Array(array) = value.get_ref() else {
            return Err(self.wrong(key, value, "a list of whole numbers"));
        };
        let whole = |value| self.whole(key, value, &range);
        array.iter().map(whole).collect::<Result<_, _>>().map(Some)
    }

    /// A vector of three quantities, none larger than `largest`, if the key is there.
    pub(crate) fn vector(&self, key: &str, quantity: Quantity, largest: f64) -> Result<Option<DVec3>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        match value.get_ref() {
            DeValue::Array(array) if array.len() == 3 => {
                let component = |k: usize| self.quantity(key, &array[k], quantity, -largest..=largest);
                Ok(Some(DVec3::new(component(0)?, component(1)?, component(2)?)))
            }
            _ => Err(self.wrong(key, value, "a list of three numbers, such as [0, 0, 1]")),
        }
    }

    pub(crate) fn required_vector(&self, key: &str, quantity: Quantity, largest: f64) -> Result<DVec3, SceneError> {
        self.vector(key, quantity, largest)?
            .ok_or_else(|| self.missing(key, "[0, 0, 1]"))
    }

    /// Text in one line, if the key is there. It may be shown on a terminal, over which it must not be able to write.
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

    /// One of several names, if the key is there.
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

    /// The table of this name, if there is one.
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

    /// The tables of this name (`[[key]]`), none if it is not there.
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

    /// A complaint about the value of `key`; about the table if the key is not there.
    pub(crate) fn error(&self, key: &str, message: String) -> SceneError {
        let span = self.get(key).map_or(self.span.clone(), Spanned::span);
        self.complain(span, message)
    }

    /// A complaint about a place.
    pub(crate) fn complain(&self, span: Range<usize>, message: String) -> SceneError {
        SceneError::at(self.source.path, self.source.text, &span, message)
    }

    /// The folder that paths in the file are relative to.
    pub(crate) fn folder(&self) -> &Path {
        self.source.path.parent().unwrap_or(Path::new("."))
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

    fn quantity(&self, key: &str, value: &Value<'_>, quantity: Quantity, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
        let complain = |message| self.complain(value.span(), message);
        let number = match value.get_ref() {
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .map(|integer| integer as f64)
                .map_err(|_| complain(format!("`{key}` is too large a number")))?,
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            DeValue::String(text) => quantity
                .parse(text)
                .map_err(|problem| complain(format!("`{key}` {problem}")))?,
            _ => return Err(self.wrong(key, value, &quantity.example())),
        };
        if range.contains(&number) {
            return Ok(number);
        }
        Err(complain(format!(
            "`{key}` is {}, but must be from {} to {}",
            quantity.written(number),
            quantity.written(*range.start()),
            quantity.written(*range.end())
        )))
    }

    fn whole(&self, key: &str, value: &Value<'_>, range: &RangeInclusive<u64>) -> Result<u64, SceneError> {
        let DeValue::Integer(integer) = value.get_ref() else {
            return Err(self.wrong(key, value, "a whole number"));
        };
        let number = u64::from_str_radix(integer.as_str(), integer.radix()).ok();
        number.filter(|number| range.contains(number)).ok_or_else(|| {
            let message = format!(
                "`{key}` is {}, but must be from {} to {}",
                shortened(integer.as_str()),
                range.start(),
                range.end()
            );
            self.complain(value.span(), message)
        })
    }
}

fn shortened(text: &str) -> String {
    excerpt(text, 40)
}
