//! Failures, each in one line.

use std::fmt::{self, Display, Write};
use std::path::Path;

/// Why something failed: one line that names the file, the place in it and the
/// reason.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure(String);

impl Failure {
    /// A failure that concerns no file.
    #[must_use]
    pub fn new(reason: impl Display) -> Self {
        Self(one_line(&reason.to_string()))
    }

    /// A failure of a whole file.
    #[must_use]
    pub fn in_file(file: &Path, reason: impl Display) -> Self {
        Self::new(format_args!("{}: {reason}", file.display()))
    }

    /// A failure at a place in a file.
    #[must_use]
    pub fn at(file: &Path, place: impl Display, reason: impl Display) -> Self {
        Self::new(format_args!("{}: {place}: {reason}", file.display()))
    }
}

impl std::error::Error for Failure {}

impl Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A piece of a file for a message: quoted, and short whatever the file holds.
pub(crate) fn quote(text: &str) -> String {
    const LONGEST: usize = 40;
    // Escaped before it is measured, as below.
    let text = one_line(&text.chars().take(LONGEST + 1).collect::<String>());
    if text.chars().nth(LONGEST).is_some() {
        let head: String = text.chars().take(LONGEST).collect();
        format!("\"{head}...\"")
    } else {
        format!("\"{text}\"")
    }
}

/// A parser's message, in which a piece of the file may stand whole: short, too.
/// Its end has the place.
pub(crate) fn shorten(why: impl Display) -> String {
    const HEAD: usize = 80;
    const TAIL: usize = 200;
    // Escaped before it is measured: a control character becomes six.
    let why = one_line(&why.to_string());
    let count = why.chars().count();
    if count <= HEAD + TAIL {
        return why;
    }
    let head: String = why.chars().take(HEAD).collect();
    let tail: String = why.chars().skip(count - TAIL).collect();
    format!("{head}...{tail}")
}

/// Control characters become escapes: a message stays one line, and a file
/// cannot drive the terminal.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() {
            let _ = write!(line, "{}", c.escape_debug());
        } else {
            line.push(c);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Found by fuzzing: forty characters that a terminal must not get, six for each.
    #[test]
    fn a_quoted_text_of_control_characters_is_short() {
        assert_eq!(quote("near"), "\"near\"");
        assert_eq!(quote("a\nb"), "\"a\\nb\"");
        let deleted = quote(&format!("z{}rig", "\u{7f}".repeat(36)));
        assert!(deleted.starts_with("\"z\\u{7f}\\u{7f}"), "{deleted}");
        assert!(deleted.ends_with("...\""), "{deleted}");
        assert_eq!(deleted.chars().count(), 45);
        assert_eq!(quote(&"x".repeat(40)).len(), 42);
        assert_eq!(quote(&"x".repeat(41)).len(), 45);
    }
}
