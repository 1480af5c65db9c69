//! The header of a PLY file.
//!
//! The `ply-rs-bw` crate reads it. It is cut out here first, within a length, and
//! its names must differ, since the crate keeps the last of equal ones.

use crate::failure::quote;
use crate::io::input::Reader;
use crate::io::lines::{LONGEST, Lines};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Header};
use std::collections::HashSet;
use std::io::BufRead;

/// The longest name in a header, in bytes; names are part of messages.
const LONGEST_NAME: usize = 100;

/// The place of an error and the reason.
pub(super) type Fault = (String, String);

/// The header and the number of its lines.
///
/// The crate gets line feeds alone, and a comment for each line that does not belong to
/// the format: old writers forgot that word.
pub(super) fn read(reader: &mut Reader) -> Result<(Header, u64), Fault> {
    let fail = |(number, why)| (format!("line {number}"), why);
    let not_ply = || fail((1, "not PLY: the first line must be ply".to_owned()));
    let start = reader.fill_buf().map_err(|e| fail((1, e.to_string())))?;
    if !start.trim_ascii_start().starts_with(b"ply") {
        return Err(not_ply());
    }
    let mut lines = Lines::new(reader);
    let (mut text, mut last) = (Vec::new(), 0);
    let mut names = Names::default();
    while let Some((number, line)) = lines.next().map_err(fail)? {
        last = number;
        let line = line.trim_ascii();
        if number == 1 && line != b"ply" {
            return Err(not_ply());
        }
        if names.add(line).map_err(|why| fail((number, why)))? {
            text.extend(line);
        } else {
            text.extend(b"comment");
        }
        text.push(b'\n');
        if line == b"end_header" {
            return Ok((parsed(&text)?, number));
        }
        if text.len() > LONGEST {
            break;
        }
    }
    Err(fail((last + 1, "the header has no end_header".to_owned())))
}

fn parsed(text: &[u8]) -> Result<Header, Fault> {
    let lines = || text.split(|&b| b == b'\n');
    let format = lines().position(|line| line.starts_with(b"format"));
    let Some(format) = format else {
        let why = "the header has no line that begins with format".to_owned();
        return Err(("line 2".to_owned(), why));
    };
    let parsed = Parser::<DefaultElement>::new().read_ply_header(&mut &text[..]);
    parsed.map_err(|e| {
        // The line is clearer than the crate's own messages. The crate gives no line if the
        // format is at fault, or if a line is not UTF-8.
        let torn = || lines().position(|line| std::str::from_utf8(line).is_err());
        let index = e.line().map(|n| n - 1).or_else(torn).unwrap_or(format);
        let line = String::from_utf8_lossy(lines().nth(index).unwrap_or_default());
        let why = format!("{} is not valid in the header", quote(&line));
        (format!("line {}", index + 1), why)
    })
}

/// The names of elements and of the last one's properties.
#[derive(Default)]
struct Names {
    elements: HashSet<Vec<u8>>,
    properties: HashSet<Vec<u8>>,
}

impl Names {
    /// Takes in a line; whether it is one of the format's.
    fn add(&mut self, line: &[u8]) -> Result<bool, String> {
        let words = || {
            line.split(u8::is_ascii_whitespace)
                .filter(|w| !w.is_empty())
        };
        let (names, name) = match words().next() {
            Some(b"element") => {
                self.properties.clear();
                (&mut self.elements, words().nth(1))
            }
            Some(b"property") => (&mut self.properties, words().next_back()),
            word => return Ok(matches!(word, Some(b"ply" | b"format" | b"end_header"))),
        };
        match name {
            Some(name) if name.len() > LONGEST_NAME => {
                let name = String::from_utf8_lossy(name);
                Err(format!("the name {} is too long", quote(&name)))
            }
            Some(name) if !names.insert(name.to_vec()) => {
                let name = String::from_utf8_lossy(name);
                Err(format!("the name {} is used twice", quote(&name)))
            }
            _ => Ok(true),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::Input;

    fn message(text: &str) -> String {
        let input = Input::from_bytes("a.ply", text.as_bytes(), false).unwrap();
        let (place, why) = read(&mut input.open().unwrap()).unwrap_err();
        format!("{place}: {why}")
    }

    #[test]
    fn headers_that_make_no_sense() {
        let head = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n";
        for (old, new, why) in [
            (
                "ply\n",
                "ply \u{b}x\n",
                "line 1: not PLY: the first line must be ply",
            ),
            (
                "format ascii 1.0\n",
                "",
                "line 2: the header has no line that begins with format",
            ),
            (
                "1.0",
                "1.256",
                "line 2: \"format ascii 1.256\" is not valid in the header",
            ),
            (
                "float",
                "real",
                "line 4: \"property real x\" is not valid in the header",
            ),
            (
                "end_header",
                "element vertex 1",
                "line 5: the name \"vertex\" is used twice",
            ),
            (
                "end_header",
                "property int x",
                "line 5: the name \"x\" is used twice",
            ),
            ("end_header", "", "line 6: the header has no end_header"),
        ] {
            let text = head.replacen(old, new, 1);
            assert_eq!(message(&text), why, "{text}");
        }
    }
}
