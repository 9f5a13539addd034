//! A file's text in a message.

/// Returns the beginning of `text`: at most `limit` characters, and an ellipsis if it is cut. Control characters are escaped,
/// since a file must not overwrite the terminal that shows the message.
#[must_use]
pub fn excerpt(text: &str, limit: usize) -> String {
    let mut excerpt = String::new();
    let mut characters = text.chars();
    for character in characters.by_ref().take(limit) {
        if character.is_control() {
            excerpt.extend(character.escape_default());
        } else {
            excerpt.push(character);
        }
    }
    if characters.next().is_some() {
        excerpt.push('…');
    }
    excerpt
}

#[cfg(test)]
mod tests {
    use super::excerpt;

    #[test]
    fn text_is_cut_with_an_ellipsis_only_where_it_is_longer() {
        assert_eq!(excerpt("zwölf", 5), "zwölf");
        assert_eq!(excerpt("zwölf", 4), "zwöl…");
    }

    #[test]
    fn control_characters_are_written_as_escapes() {
        assert_eq!(excerpt("\u{1b}[2Jgone\n", 40), "\\u{1b}[2Jgone\\n");
    }
}
