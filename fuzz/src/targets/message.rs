use std::fmt::Display;

/// Checks that an error message is one readable line for any input. It is not empty, not endless, and free of control characters,
/// with which a file could overwrite a terminal.
pub(super) fn check(error: &impl Display) {
    let message = error.to_string();
    assert!(!message.trim().is_empty(), "an empty message");
    assert!(message.chars().count() < 1000, "endless: {message:?}");
    assert!(!message.chars().any(char::is_control), "control characters: {message:?}");
}
