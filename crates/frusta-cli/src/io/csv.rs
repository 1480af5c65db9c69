//! CSV rows `x0,y0,z0,x1,y1,z1`: one segment a row, read as a stream.
//!
//! With a header the six columns are found by name, in any order and among
//! others; without one a row has six fields. Lines that begin with `#` are
//! comments, and empty ones are passed over.
//!
//! A row is a line: a quoted field may hold commas, but no line break. So the
//! text can be cut into blocks at any line break, and the blocks parsed by
//! several threads; only lines are counted before that.

use super::input::Input;
use super::lines::{LONGEST, LineError};
use super::{Contents, Format, ReadOptions};
use crate::failure::{Failure, quote};
use crate::io::number::{self, Scalar};
use csv::{ByteRecord, ReaderBuilder};
use frusta::{Segment, Vec3};
use memchr::{memchr, memchr_iter, memrchr};
use std::io::Read;

/// The columns, in the order of a segment's coordinates.
const COLUMNS: [&str; 6] = ["x0", "y0", "z0", "x1", "y1", "z1"];

/// Bytes in a block: a few thousand rows.
const BLOCK: usize = 1 << 18;

/// The format.
pub(super) struct Csv;

impl Format for Csv {
    fn name(&self) -> &'static str {
        "csv"
    }

    fn description(&self) -> &'static str {
        "Rows x0,y0,z0,x1,y1,z1"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["csv"]
    }

    fn open(&self, input: &Input, _: ReadOptions) -> Result<Contents, Failure> {
        Ok(Contents::Rows(Rows(input.clone())))
    }
}

/// The rows of a file, in blocks.
#[derive(Clone, Debug)]
pub struct Rows(Input);

impl Rows {
    /// Reads the file's blocks in order.
    ///
    /// # Errors
    /// The file cannot be read, its first row has neither six numbers nor six columns, or `emit`
    /// failed.
    pub fn blocks(&self, emit: impl FnMut(Block) -> Result<(), Failure>) -> Result<(), Failure> {
        blocks(&self.0, emit)
    }
}

/// Some rows of a file: whole lines, not parsed yet.
#[derive(Debug)]
pub struct Block {
    text: Vec<u8>,
    /// The first line's number, from 1.
    line: u64,
    rows: u64,
    layout: Layout,
}

/// Where in a row the coordinates are.
#[derive(Clone, Copy, Debug)]
struct Layout {
    columns: [usize; 6],
    /// Number of fields in each row.
    width: usize,
}

fn blocks(
    input: &Input,
    mut emit: impl FnMut(Block) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut reader = input.open()?;
    let (mut rest, mut line, mut layout) = (Vec::new(), 1, None);
    loop {
        let mut text = rest;
        let more = read_some(&mut reader, &mut text).map_err(|e| input.failure(e))?;
        // Whole lines stay; at the end the last needs no line break.
        let end = match memrchr(b'\n', &text) {
            Some(at) if more => at + 1,
            _ if more => 0,
            _ => text.len(),
        };
        rest = text.split_off(end);
        if rest.len() > LONGEST {
            let number = line + count_lines(&text);
            let why = format!("the row is longer than {LONGEST} bytes; is this text?");
            return Err(input.failure_in_line((number, why)));
        }
        let skipped = match layout {
            Some(_) => 0,
            None => match head(&text).map_err(|(n, why)| input.failure_in_line((line + n, why)))? {
                Some((found, skipped)) => {
                    layout = Some(found);
                    skipped
                }
                // Nothing but comments so far.
                None => text.len(),
            },
        };
        line += count_lines(&text[..skipped]);
        text.drain(..skipped);
        if let Some(layout) = layout.filter(|_| !text.is_empty()) {
            let lines = count_lines(&text);
            let rows = text.split(|&b| b == b'\n').filter(|l| is_row(l)).count() as u64;
            emit(Block {
                text,
                line,
                rows,
                layout,
            })?;
            line += lines;
        }
        if !more {
            return Ok(());
        }
    }
}

/// Appends about a block; whether there may be more.
fn read_some(reader: &mut impl Read, text: &mut Vec<u8>) -> std::io::Result<bool> {
    let count = reader.take(BLOCK as u64).read_to_end(text)?;
    Ok(count == BLOCK)
}

/// Number of lines in a text.
fn count_lines(text: &[u8]) -> u64 {
    let whole = memchr_iter(b'\n', text).count() as u64;
    whole + u64::from(!text.is_empty() && !text.ends_with(b"\n"))
}

/// Whether a line holds a row: it is neither empty nor a comment.
fn is_row(line: &[u8]) -> bool {
    !matches!(line.strip_suffix(b"\r").unwrap_or(line), [] | [b'#', ..])
}

/// The layout by the first row, and the number of bytes to pass over: all before that
/// row, and the row, too, if it is a header. An error comes with the number of lines
/// before it.
fn head(text: &[u8]) -> Result<Option<(Layout, usize)>, LineError> {
    let mut start = 0;
    for (n, line) in (0..).zip(text.split_inclusive(|&b| b == b'\n')) {
        if is_row(line.strip_suffix(b"\n").unwrap_or(line)) {
            let mut record = ByteRecord::new();
            reader(line)
                .read_byte_record(&mut record)
                .map_err(|e| (n, e.to_string()))?;
            let (layout, is_header) = layout(&record).map_err(|why| (n, why))?;
            // What follows it in the line would be passed over.
            if memchr(b'\r', line.trim_ascii_end()).is_some() {
                let why = "a carriage return without a line feed after it";
                return Err((n, why.to_owned()));
            }
            let skipped = start + if is_header { line.len() } else { 0 };
            return Ok(Some((layout, skipped)));
        }
        start += line.len();
    }
    Ok(None)
}

/// The layout by the first row; a row without a number is a header.
fn layout(record: &ByteRecord) -> Result<(Layout, bool), String> {
    let fields = || {
        record
            .iter()
            .map(|f| String::from_utf8_lossy(f.trim_ascii()))
    };
    let width = record.len();
    if fields().any(|field| number::parse::<f64>(&field).is_ok()) {
        let columns = [0, 1, 2, 3, 4, 5];
        return match width {
            6 => Ok((Layout { columns, width }, false)),
            _ => Err(format!(
                "{width} fields; without a header a row has six: {}",
                COLUMNS.join(",")
            )),
        };
    }
    let mut columns = [0; 6];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        let found = fields().position(|field| field == name);
        *column = found
            .ok_or_else(|| format!("neither six numbers nor a header with the column {name}"))?;
    }
    Ok((Layout { columns, width }, true))
}

fn reader(text: &[u8]) -> csv::Reader<&[u8]> {
    ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .buffer_capacity(1 << 14)
        .from_reader(text)
}

impl Block {
    /// Number of rows, if they are well formed.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Appends the rows' segments.
    ///
    /// # Errors
    /// A row is malformed: its line, from 1, and the reason.
    pub fn parse<T: Scalar>(&self, out: &mut Vec<Segment<T>>) -> Result<(), LineError> {
        let mut reader = reader(&self.text);
        let mut record = ByteRecord::new();
        let quoted = memchr(b'"', &self.text).is_some();
        let before = out.len();
        loop {
            let more = reader.read_byte_record(&mut record);
            if !more.map_err(|e| (self.line, e.to_string()))? {
                break;
            }
            if quoted && memchr(b'\n', record.as_slice()).is_some() {
                let why = "a quoted field goes on over the line's end".to_owned();
                return Err((self.line_of(&record), why));
            }
            let segment = self.layout.segment(&record);
            out.push(segment.map_err(|why| (self.line_of(&record), why))?);
        }
        if (out.len() - before) as u64 == self.rows {
            Ok(())
        } else {
            let why = "carriage returns without line feeds end rows below".to_owned();
            Err((self.line, why))
        }
    }

    /// The record's line. Its position is from before the empty lines and the
    /// comments above it.
    fn line_of(&self, record: &ByteRecord) -> u64 {
        let start = record.position().map_or(0, |p| p.byte() as usize);
        let start = start.min(self.text.len());
        let passed = self.text[start..]
            .split(|&b| b == b'\n')
            .take_while(|line| !is_row(line))
            .count() as u64;
        self.line + count_lines(&self.text[..start]) + passed
    }
}

impl Layout {
    fn segment<T: Scalar>(&self, record: &ByteRecord) -> Result<Segment<T>, String> {
        if record.len() != self.width {
            return Err(format!(
                "{} fields; the rows before have {}",
                record.len(),
                self.width
            ));
        }
        let mut values = [T::ZERO; 6];
        for ((value, column), name) in values.iter_mut().zip(self.columns).zip(COLUMNS) {
            let field = record.get(column).unwrap_or_default().trim_ascii();
            let text = std::str::from_utf8(field).map_err(|_| {
                format!(
                    "{name}: {} is not a number",
                    quote(&String::from_utf8_lossy(field))
                )
            })?;
            *value = number::parse_finite(text).map_err(|why| format!("{name}: {why}"))?;
        }
        let [x0, y0, z0, x1, y1, z1] = values;
        Ok(Segment {
            start: Vec3::new(x0, y0, z0),
            end: Vec3::new(x1, y1, z1),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::corruption;
    use std::path::Path;

    /// All segments, or the message.
    fn read(text: &str) -> Result<Vec<Segment<f64>>, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.csv");
        std::fs::write(&file, text).unwrap();
        let input = Input::new(&file, None).unwrap();
        let mut out = Vec::new();
        let mut rows = 0;
        let read = blocks(&input, |block| {
            rows += block.rows();
            block
                .parse(&mut out)
                .map_err(|(line, why)| Failure::at(Path::new("a"), line, why))
        });
        read.map_err(|e| {
            e.to_string()
                .rsplit_once(folder.path().to_str().unwrap())
                .map_or(e.to_string(), |(_, end)| end.to_owned())
        })?;
        assert_eq!(rows, out.len() as u64);
        Ok(out)
    }

    #[test]
    fn blocks_are_cut_between_rows() {
        let mut text = String::from("\u{feff}# made by hand\r\n\r\nx0,y0,z0,x1,y1,z1,\"a, b\"\r\n");
        let count = 40_000;
        for i in 0..count {
            text += &format!("{i},0,0,1,1,{i}.5,\"x, {}\"\r\n", "y".repeat(i % 50));
            if i % 1000 == 0 {
                text += "\n#,,\n";
            }
        }
        assert!(text.len() > 5 * BLOCK);
        let segments = read(&text).unwrap();
        assert_eq!(segments.len(), count);
        for (i, segment) in segments.iter().enumerate() {
            assert_eq!(segment.start.x, i as f64);
            assert_eq!(segment.end.z, i as f64 + 0.5);
        }
        // The last row without a line break, and one in a later block that is bad.
        text += "1,2,3,4,5,6,z";
        assert_eq!(read(&text).unwrap().len(), count + 1);
        text += "\n1,2,3,4,5,x,z\n";
        let lines = text.lines().count();
        assert_eq!(
            read(&text).unwrap_err(),
            format!("a: {lines}: z1: \"x\" is not a number")
        );
    }

    #[test]
    fn a_block_may_end_anywhere_in_a_row() {
        let rows = "1,2,3,4,5,6\r\n\r\n#\r\n\"7\",8,9,10,11,12\r\n";
        for shift in 0..=rows.len() {
            let comment = "x".repeat(BLOCK - 3 - shift);
            let text = format!("#{comment}\r\n{rows}");
            let segments = read(&text).unwrap();
            let expected = [
                Segment::new([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]),
                Segment::new([7.0, 8.0, 9.0], [10.0, 11.0, 12.0]),
            ];
            assert_eq!(segments, expected, "{shift}");
        }
    }

    #[test]
    fn rows_are_lines() {
        let row = "1,2,3,4,5,6\n";
        for bad in [
            "1,2,3,4,5,\"6\n\"\n",
            "1,2,3,4,5,\"6\n",
            "1,2,3,4,\"5,6\n1,2,3,4,5,\"6\n",
        ] {
            let error = read(&format!("{row}{bad}{row}")).unwrap_err();
            assert_eq!(
                error, "a: 2: a quoted field goes on over the line's end",
                "{bad:?}"
            );
        }
        assert_eq!(
            read("1,2,3,4,5,6\n1,2,3,4,5,6\r1,2,3,4,5,6\r").unwrap_err(),
            "a: 1: carriage returns without line feeds end rows below"
        );
        for text in [
            "1,2,3,4,5,6\r1,2,3,4,5,6\r",
            "x0,y0,z0,x1,y1,z1\r1,2,3,4,5,6\r\n",
        ] {
            let error = read(text).unwrap_err();
            let why = "/a.csv: line 1: a carriage return without a line feed after it";
            assert_eq!(error, why, "{text:?}");
        }
    }

    #[test]
    fn corrupted_files_are_read_or_refused_and_never_panic() {
        let samples = [
            "\u{feff}# c\r\n\r\nx0,y0,z0,x1,y1,z1,\"a, b\"\r\n1,2,3,4,5,6,\"x, y\"\r\n\r\n-1,0x1p-3,\
             1e5,4.25,50,6,z\r\n#,\r\n9,8,7,6,5,4,\r\n",
            "1,2,3,4,5,6\n10, 20,30 ,40,50,60\n# c\n.5,5.,+1,1e-5,-0,\"7\"",
        ];
        let samples = samples.map(|text| text.as_bytes().to_vec());
        corruption::check("a.csv", &samples, 20_000, |input| {
            let mut out = Vec::new();
            let mut rows = 0;
            blocks(input, |block| {
                rows += block.rows();
                let parsed = block.parse(&mut out);
                parsed.map_err(|e| input.failure_in_line(e))
            })?;
            assert_eq!(rows, out.len() as u64);
            Ok(out)
        });
    }
}
