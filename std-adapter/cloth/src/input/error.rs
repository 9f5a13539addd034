//! Errors in scenes, with their place in the file.

use selvedge_files::excerpt::excerpt;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::de::{DeTable, DeValue};

/// An error in a scene. `Display` writes `FILE:LINE:COLUMN:`, the error and its remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// The scene's file.
    pub path: PathBuf,
    /// Line and column, from 1, the column in characters. `None` if the error concerns the file as a whole.
    pub place: Option<(usize, usize)>,
    /// The error and its remedy.
    pub message: String,
}

/// The largest number of characters in a message, however long the quoted names are.
const LONGEST: usize = 600;

/// Replaces control characters and shortens endless lists.
fn printable(message: String) -> String {
    if message.len() <= LONGEST && !message.chars().any(char::is_control) {
        message
    } else {
        excerpt(&message, LONGEST)
    }
}

impl SceneError {
    /// Returns an error about the bytes `span` of `text`.
    pub(crate) fn at(path: &Path, text: &str, span: &Range<usize>, message: String) -> Self {
        let before = text.get(..span.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = 1 + before.bytes().filter(|&byte| byte == b'\n').count();
        let column = 1 + before[line_start..].chars().count();
        Self {
            path: path.to_owned(),
            place: Some((line, column)),
            message: printable(message),
        }
    }

    pub(crate) fn whole(path: &Path, message: String) -> Self {
        Self {
            path: path.to_owned(),
            place: None,
            message: printable(message),
        }
    }
}

impl SceneError {
    /// Returns the path of the field that the error is about, such as `effects.friction.coefficient` or `cloth[1].density`;
    /// `None` if it is about the scene as a whole. `text` is that of the scene. This suits scenes that code writes, whose lines
    /// nobody sees.
    #[must_use]
    pub fn field(&self, text: &str) -> Option<String> {
        let (line, column) = self.place?;
        let before: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        let in_line = text[before..].char_indices().nth(column - 1).map_or(0, |(byte, _)| byte);
        let root = DeTable::parse(text).ok()?;
        let mut path = String::new();
        follow(root.get_ref(), before + in_line, &mut path);
        (!path.is_empty()).then_some(path)
    }
}

/// Appends the path of the deepest key or value at a byte of the text.
fn follow(table: &DeTable<'_>, place: usize, path: &mut String) {
    let is_at = |span: Range<usize>| span.contains(&place);
    let Some((key, mut value)) = table.iter().find(|(key, value)| is_at(key.span()) || is_at(value.span())) else {
        // A table of a file begins with its header, and may have its keys after those of others.
        return;
    };
    if !path.is_empty() {
        path.push('.');
    }
    path.push_str(key.get_ref());
    loop {
        match value.get_ref() {
            DeValue::Table(table) => return follow(table, place, path),
            DeValue::Array(array) => {
                let Some((index, entry)) = array.iter().enumerate().find(|(_, entry)| is_at(entry.span())) else {
                    return;
                };
                path.push_str(&format!("[{index}]"));
                value = entry;
            }
            _ => return,
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some((line, column)) = self.place {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for SceneError {}

/// Returns the candidate that `name` probably means: at most a third of its letters differ, or both begin alike.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    let likeness = |candidate: &'a str| {
        let lower = candidate.to_lowercase();
        let distance = strsim::damerau_levenshtein(&name, &lower);
        let longer = lower.chars().count().max(name.chars().count());
        let is_like = 3 * distance <= longer || strsim::jaro_winkler(&name, &lower) >= 0.87;
        is_like.then_some((distance, candidate))
    };
    let alike = candidates.into_iter().filter_map(likeness);
    alike.min_by_key(|&(distance, _)| distance).map(|(_, candidate)| candidate)
}

/// Returns `; did you mean 'a'?`, or `; choose one of a, b`.
pub(crate) fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    let candidates: Vec<_> = candidates.into_iter().collect();
    match nearest(name, candidates.iter().copied()) {
        Some(nearest) => format!("; did you mean '{nearest}'?"),
        None if candidates.is_empty() => "; there are none".to_owned(),
        None => format!("; choose from {}", candidates.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_begin_at_one() {
        let text = "a = 1\nöö = 2\n";
        let at = text.find("= 2").unwrap();
        let error = SceneError::at(Path::new("s.toml"), text, &(at..at + 1), "no".into());
        assert_eq!(error.to_string(), "s.toml:2:4: no");
    }

    #[test]
    fn the_field_of_an_error_is_its_path_in_a_scene_that_code_wrote() {
        let text = "cloth = [{a = 1}, {b = {c = [0, 7]}}]\nname = \"ö\"\neffects = {friction = {coefficient = 30}}\n";
        let field = |part: &str| {
            let at = text.find(part).unwrap();
            SceneError::at(Path::new("s.toml"), text, &(at..at + 1), "no".into()).field(text)
        };
        assert_eq!(field("30").as_deref(), Some("effects.friction.coefficient"));
        assert_eq!(field("7").as_deref(), Some("cloth[1].b.c[1]"));
        assert_eq!(field("{b").as_deref(), Some("cloth[1]"));
        assert_eq!(field("friction").as_deref(), Some("effects.friction"));
        assert_eq!(field("cloth =").as_deref(), Some("cloth"));
        assert_eq!(SceneError::whole(Path::new("s.toml"), "no".into()).field(text), None);
    }

    #[test]
    fn only_a_similar_name_is_suggested() {
        assert_eq!(nearest("gravty", ["wind", "gravity"]), Some("gravity"));
        assert_eq!(nearest("gravitation", ["wind", "gravity"]), Some("gravity"));
        assert_eq!(nearest("Thickness", ["thickness"]), Some("thickness"));
        assert_eq!(nearest("colour", ["wind", "gravity"]), None);
    }
}
