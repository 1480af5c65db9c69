//! The source of bytes: a file, the standard input, or memory.

use super::Format;
use crate::Failure;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Bytes that are read at a time.
const BUFFER: usize = 1 << 18;

/// Bytes that a file's kind is recognised by. A pipe may give fewer at first; the first read waits
/// for as many.
const HEAD: usize = 512;

/// The UTF-8 byte order mark, which editors write before a text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// A source of bytes and the format that they are in.
#[derive(Clone, Debug)]
pub struct Input {
    /// For messages; a file's is its path.
    name: PathBuf,
    source: Source,
    /// Whether it can be read only once.
    piped: bool,
    format: &'static dyn Format,
    /// Number of bytes read since it was last opened.
    read: Arc<AtomicU64>,
}

/// Where bytes come from.
#[derive(Clone, Debug)]
enum Source {
    /// The file whose path is the name.
    File,
    StandardInput,
    Bytes(Arc<[u8]>),
}

/// A buffered reader.
pub(super) type Reader = BufReader<Counted>;

impl Input {
    /// A file, or the standard input for `-`. Without a format the file's extension decides.
    ///
    /// # Errors
    /// There is no format, and the extension is unknown.
    pub fn new(file: &Path, format: Option<&'static dyn Format>) -> Result<Self, Failure> {
        let standard = file == Path::new("-");
        let format = match format {
            Some(format) => format,
            None if standard => {
                let why = "give its format with --from";
                return Err(Failure::in_file(Path::new("standard input"), why));
            }
            None => <dyn Format>::of(file)?,
        };
        Ok(Self {
            name: if standard {
                PathBuf::from("standard input")
            } else {
                file.to_owned()
            },
            source: if standard {
                Source::StandardInput
            } else {
                Source::File
            },
            // A named pipe or a device, such as a shell's `<(...)`.
            piped: standard || file.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir()),
            format,
            read: Arc::default(),
        })
    }

    /// Bytes in memory. The extension of their name decides the format; if they are `piped`, they
    /// are read as a pipe is: once, and without knowing their length.
    ///
    /// # Errors
    /// The extension is unknown.
    pub fn from_bytes(name: &str, bytes: &[u8], piped: bool) -> Result<Self, Failure> {
        Ok(Self {
            name: PathBuf::from(name),
            source: Source::Bytes(bytes.into()),
            piped,
            format: <dyn Format>::of(Path::new(name))?,
            read: Arc::default(),
        })
    }

    /// The name for messages.
    #[must_use]
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// The format.
    #[must_use]
    pub fn format(&self) -> &'static dyn Format {
        self.format
    }

    /// Whether it can be read only once.
    #[must_use]
    pub fn is_piped(&self) -> bool {
        self.piped
    }

    /// Number of bytes; `None` for a pipe.
    #[must_use]
    pub fn size(&self) -> Option<u64> {
        match &self.source {
            Source::Bytes(bytes) => (!self.piped).then_some(bytes.len() as u64),
            Source::StandardInput => None,
            Source::File => {
                let data = self.name.metadata().ok()?;
                data.is_file().then_some(data.len())
            }
        }
    }

    /// Number of bytes read since it was last opened.
    #[must_use]
    pub fn position(&self) -> u64 {
        self.read.load(Ordering::Relaxed)
    }

    /// Opens it from its beginning, after a byte order mark. An empty file is an error.
    pub(super) fn open(&self) -> Result<Reader, Failure> {
        self.read.store(0, Ordering::Relaxed);
        let counted = Counted {
            source: self.source()?,
            read: Arc::clone(&self.read),
            begun: false,
        };
        let mut reader = BufReader::with_capacity(BUFFER, counted);
        let start = reader.fill_buf().map_err(|e| self.failure(e))?;
        if self.format.begins_as_text() {
            if matches!(start, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) {
                let why = "the text is UTF-16; expected UTF-8".to_owned();
                return Err(self.failure_in_line((1, why)));
            }
            if start.starts_with(MARK) {
                reader.consume(MARK.len());
            }
        }
        let start = reader.fill_buf().map_err(|e| self.failure(e))?;
        if start.is_empty() {
            return Err(self.failure("the file is empty"));
        }
        Ok(reader)
    }

    fn source(&self) -> Result<Box<dyn Read + Send>, Failure> {
        match &self.source {
            Source::Bytes(bytes) => Ok(Box::new(io::Cursor::new(Arc::clone(bytes)))),
            Source::StandardInput => Ok(Box::new(io::stdin())),
            Source::File => {
                let file = File::open(&self.name).map_err(|e| self.failure(e))?;
                if file.metadata().is_ok_and(|data| data.is_dir()) {
                    return Err(self.failure("a folder, not a file"));
                }
                Ok(Box::new(file))
            }
        }
    }

    /// A failure of the whole.
    pub(crate) fn failure(&self, why: impl std::fmt::Display) -> Failure {
        Failure::in_file(&self.name, why)
    }

    /// A failure at a place.
    pub(super) fn failure_at(
        &self,
        place: impl std::fmt::Display,
        why: impl std::fmt::Display,
    ) -> Failure {
        Failure::at(&self.name, place, why)
    }

    /// A failure at a line.
    pub(crate) fn failure_in_line(&self, (line, why): (u64, String)) -> Failure {
        self.failure_at(format_args!("line {line}"), why)
    }
}

/// Counts the bytes that are read.
pub(super) struct Counted {
    source: Box<dyn Read + Send>,
    read: Arc<AtomicU64>,
    /// Whether the first bytes have been read.
    begun: bool,
}

impl Read for Counted {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut count = self.source.read(buffer)?;
        if !std::mem::replace(&mut self.begun, true) {
            let least = HEAD.min(buffer.len());
            while 0 < count && count < least {
                match self.source.read(&mut buffer[count..]) {
                    Ok(0) => break,
                    Ok(more) => count += more,
                    Err(e) if e.kind() == ErrorKind::Interrupted => {}
                    Err(e) => return Err(e),
                }
            }
        }
        self.read.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time, as a slow pipe may.
    struct OneByOne(io::Cursor<Vec<u8>>);

    impl Read for OneByOne {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let length = buffer.len().min(1);
            self.0.read(&mut buffer[..length])
        }
    }

    #[test]
    fn the_first_bytes_come_together() {
        for length in [1, 100, HEAD, 3 * HEAD] {
            let bytes: Vec<u8> = (0..length).map(|i| i as u8).collect();
            let counted = Counted {
                source: Box::new(OneByOne(io::Cursor::new(bytes.clone()))),
                read: Arc::default(),
                begun: false,
            };
            let mut reader = BufReader::with_capacity(BUFFER, counted);
            assert_eq!(reader.fill_buf().unwrap(), &bytes[..length.min(HEAD)]);
            let mut all = Vec::new();
            reader.read_to_end(&mut all).unwrap();
            assert_eq!(all, bytes);
        }
    }
}
