//! CSV rows `x0,y0,z0,x1,y1,z1`: one segment a row, read as a stream.
//!
//! With a header the six columns are found by name, in any order and among
//! others, so that the command's own output can be read again; without one a
//! row has six fields. Lines that begin with `#` are comments.

use super::Bounds;
use crate::failure::{Failure, quote};
use crate::number::{self, Scalar};
use csv::{ByteRecord, ReaderBuilder, Trim};
use frusta::{Segment, Vec3};
use std::fs::File;
use std::path::{Path, PathBuf};

/// The columns, in the order of a segment's coordinates.
const COLUMNS: [&str; 6] = ["x0", "y0", "z0", "x1", "y1", "z1"];

/// A file's rows, one after the other.
pub(crate) struct Rows {
    file: PathBuf,
    reader: csv::Reader<File>,
    record: ByteRecord,
    columns: Option<[usize; 6]>,
    /// How many fields each row has, once the first has been read.
    width: usize,
}

impl Rows {
    /// Opens a file.
    pub(crate) fn open(file: &Path) -> Result<Self, Failure> {
        let input = File::open(file).map_err(|e| Failure::in_file(file, e))?;
        let reader = ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(Trim::All)
            .comment(Some(b'#'))
            .buffer_capacity(1 << 16)
            .from_reader(input);
        Ok(Self {
            file: file.to_owned(),
            reader,
            record: ByteRecord::new(),
            columns: None,
            width: 0,
        })
    }

    /// How many bytes have been read.
    pub(crate) fn position(&self) -> u64 {
        self.reader.position().byte()
    }

    /// The next row's segment; `None` at the end.
    pub(crate) fn next<T: Scalar>(&mut self) -> Result<Option<Segment<T>>, Failure> {
        loop {
            let more = self.reader.read_byte_record(&mut self.record);
            if !more.map_err(|e| Failure::in_file(&self.file, e))? {
                return Ok(None);
            }
            let line = self.record.position().map_or(0, csv::Position::line);
            let found = match self.columns {
                Some(columns) => self.segment(columns).map(Some),
                None => self.first_row(),
            };
            match found {
                Ok(Some(segment)) => return Ok(Some(segment)),
                Ok(None) => {}
                Err(why) => {
                    return Err(Failure::at(&self.file, format_args!("line {line}"), why));
                }
            }
        }
    }

    /// A header or the first segment: a row with no number in it is a header.
    fn first_row<T: Scalar>(&mut self) -> Result<Option<Segment<T>>, String> {
        let fields = || self.record.iter().map(String::from_utf8_lossy);
        self.width = self.record.len();
        if fields().any(|field| number::parse::<f64>(&field).is_ok()) {
            if self.width != 6 {
                return Err(format!(
                    "{} fields; without a header a row has six: {}",
                    self.width,
                    COLUMNS.join(",")
                ));
            }
            let columns = [0, 1, 2, 3, 4, 5];
            self.columns = Some(columns);
            return self.segment(columns).map(Some);
        }
        let mut columns = [0; 6];
        for (column, name) in columns.iter_mut().zip(COLUMNS) {
            *column = fields().position(|field| field == name).ok_or_else(|| {
                format!("neither six numbers nor a header with the column {name}")
            })?;
        }
        self.columns = Some(columns);
        Ok(None)
    }

    fn segment<T: Scalar>(&self, columns: [usize; 6]) -> Result<Segment<T>, String> {
        if self.record.len() != self.width {
            return Err(format!(
                "{} fields; the rows before have {}",
                self.record.len(),
                self.width
            ));
        }
        let mut values = [T::ZERO; 6];
        for ((value, column), name) in values.iter_mut().zip(columns).zip(COLUMNS) {
            let field = self.record.get(column).unwrap_or_default();
            let text = std::str::from_utf8(field).map_err(|_| {
                format!(
                    "{name}: {} is no number",
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

/// A box around all of a file's segments: one pass over it.
pub(crate) fn bounds(file: &Path) -> Result<Bounds, Failure> {
    let mut rows = Rows::open(file)?;
    let mut bounds = Bounds::EMPTY;
    while let Some(segment) = rows.next::<f64>()? {
        bounds.add(segment.start);
        bounds.add(segment.end);
    }
    Ok(bounds)
}
