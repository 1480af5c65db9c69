//! Lines of a text, with their numbers.
//!
//! Lines have a greatest length: a file with a longer one is not text, and reading
//! on would fill the memory. Lines end with a line feed, with or without
//! a carriage return before it; a text whose lines end with the latter alone is
//! refused, since it would be one line with most of it passed over.

use memchr::memchr;
use std::io::{BufRead, Read};

/// The longest line that is read, in bytes.
pub(super) const LONGEST: usize = 1 << 20;

/// Why there is no next line: its number and the reason.
pub type LineError = (u64, String);

/// A text's lines, one after the other.
pub(crate) struct Lines<R> {
    reader: R,
    line: Vec<u8>,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    /// The lines of a reader.
    pub(crate) fn new(reader: R) -> Self {
        Self {
            reader,
            line: Vec::new(),
            number: 0,
        }
    }

    /// The next line, without the white space at its end, and its number from
    /// 1; `None` at the end.
    pub(crate) fn next(&mut self) -> Result<Option<(u64, &[u8])>, LineError> {
        self.line.clear();
        Ok(self
            .append()?
            .then(|| (self.number, self.line.trim_ascii_end())))
    }

    /// The same, where a backslash at a line's end joins the next; the number is
    /// the first one's. A comment ends with its line: it may hold a folder's name.
    pub(super) fn next_joined(&mut self) -> Result<Option<(u64, &[u8])>, LineError> {
        self.line.clear();
        if !self.append()? {
            return Ok(None);
        }
        let number = self.number;
        let mut start = 0;
        while let Some(head) = self.line.trim_ascii_end().strip_suffix(b"\\") {
            if memchr(b'#', head.get(start..).unwrap_or_default()).is_some() {
                break;
            }
            start = head.len();
            self.line.truncate(start);
            self.line.push(b' ');
            if !self.append()? {
                break;
            }
        }
        Ok(Some((number, self.line.trim_ascii_end())))
    }

    /// Appends a line to the buffer; `false` at the end.
    fn append(&mut self) -> Result<bool, LineError> {
        self.number += 1;
        let start = self.line.len();
        let room = (LONGEST - start.min(LONGEST)) as u64 + 1;
        let count = (&mut self.reader)
            .take(room)
            .read_until(b'\n', &mut self.line)
            .map_err(|e| (self.number, e.to_string()))?;
        if memchr(b'\r', self.line[start..].trim_ascii_end()).is_some() {
            let why = "a carriage return without a line feed after it";
            return Err((self.number, why.to_owned()));
        }
        if self.line.len() > LONGEST && !self.line.ends_with(b"\n") {
            let why = format!("the line is longer than {LONGEST} bytes; is this text?");
            return Err((self.number, why));
        }
        Ok(count > 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &[u8], joined: bool) -> Vec<(u64, String)> {
        let mut lines = Lines::new(text);
        let mut out = Vec::new();
        loop {
            let next = if joined {
                lines.next_joined()
            } else {
                lines.next()
            };
            match next.unwrap() {
                Some((number, line)) => {
                    out.push((number, String::from_utf8(line.to_vec()).unwrap()));
                }
                None => return out,
            }
        }
    }

    #[test]
    fn lines_have_numbers_and_backslashes_join_them() {
        let text = b"a\r\n\nb \\\n c\nd\\";
        let own = |list: &[(u64, &str)]| -> Vec<(u64, String)> {
            list.iter().map(|&(n, l)| (n, l.to_owned())).collect()
        };
        assert_eq!(
            all(text, false),
            own(&[(1, "a"), (2, ""), (3, "b \\"), (4, " c"), (5, "d\\")])
        );
        assert_eq!(
            all(text, true),
            own(&[(1, "a"), (2, ""), (3, "b   c"), (5, "d")])
        );
        // Not in a comment.
        let text = b"# C:\\a\\\nv 0\nl 1 \\\n2 # \\\n3\n";
        let lines = [(1, "# C:\\a\\"), (2, "v 0"), (3, "l 1  2 # \\"), (5, "3")];
        assert_eq!(all(text, true), own(&lines));
    }

    #[test]
    fn carriage_returns_alone_are_refused() {
        for text in ["a\rb\n", "a\n\rb", "# a\rb \\\r\nc\n", "a \\\nb\rc"] {
            let mut lines = Lines::new(text.as_bytes());
            let error = loop {
                match lines.next_joined() {
                    Ok(line) => assert!(line.is_some(), "{text:?}"),
                    Err((_, why)) => break why,
                }
            };
            let why = "a carriage return without a line feed after it";
            assert_eq!(error, why, "{text:?}");
        }
        assert_eq!(all(b"a\r\r\nb\r", false).len(), 2);
    }

    #[test]
    fn an_endless_line_is_refused() {
        let text = [b"a\n".to_vec(), vec![b' '; LONGEST + 1]].concat();
        let mut lines = Lines::new(&text[..]);
        assert_eq!(lines.next().unwrap(), Some((1, &b"a"[..])));
        assert_eq!(lines.next().unwrap_err().0, 2);
        let joined = b"x\\\n".repeat(LONGEST);
        assert_eq!(
            Lines::new(&joined[..]).next_joined().unwrap_err().0,
            524_289
        );
    }
}
