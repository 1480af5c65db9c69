//! Files and the standard input, opened.

use super::Format;
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Bytes between two looks at the file.
const BUFFER: usize = 1 << 18;

/// Bytes that tell a file's kind. A pipe may give fewer at first; the first look
/// waits for as many.
const HEAD: usize = 512;

/// The UTF-8 byte order mark, which editors write before a text.
pub(crate) const MARK: &[u8] = b"\xef\xbb\xbf";

/// What to read, and as what.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    /// The file's name, or what messages call the standard input.
    name: PathBuf,
    /// Whether it is the standard input.
    standard: bool,
    /// Whether it can be read only once.
    piped: bool,
    /// The format.
    pub(crate) format: Format,
    /// How many bytes have been read.
    read: Arc<AtomicU64>,
    /// Bytes of a test or a fuzz target.
    #[cfg(any(test, fuzzing))]
    content: Option<Arc<[u8]>>,
}

/// A buffered reader.
pub(super) type Reader = BufReader<Counted>;

impl Input {
    /// A file, or the standard input for `-`; without a format the file's name
    /// tells it.
    pub(crate) fn new(file: &Path, format: Option<Format>) -> Result<Self, Failure> {
        let standard = file == Path::new("-");
        let format = match format {
            Some(format) => format,
            None if standard => {
                let why = "give its format with --from";
                return Err(Failure::in_file(Path::new("standard input"), why));
            }
            None => Format::of(file)?,
        };
        Ok(Self {
            name: if standard {
                PathBuf::from("standard input")
            } else {
                file.to_owned()
            },
            standard,
            // A named pipe or a device, such as a shell's `<(...)`.
            piped: standard || file.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir()),
            format,
            read: Arc::default(),
            #[cfg(any(test, fuzzing))]
            content: None,
        })
    }

    /// These bytes instead of a file.
    #[cfg(any(test, fuzzing))]
    pub(crate) fn of_bytes(name: &str, content: &[u8], piped: bool) -> Self {
        Self {
            content: Some(content.into()),
            piped,
            ..Self::new(Path::new(name), None).unwrap()
        }
    }

    /// The name for messages.
    pub(crate) fn name(&self) -> &Path {
        &self.name
    }

    /// Whether it can be read only once.
    pub(crate) fn is_piped(&self) -> bool {
        self.piped
    }

    /// How many bytes there are, of a file.
    pub(crate) fn size(&self) -> Option<u64> {
        #[cfg(any(test, fuzzing))]
        if let Some(content) = self.content.as_ref().filter(|_| !self.piped) {
            return Some(content.len() as u64);
        }
        let data = self.name.metadata().ok().filter(|_| !self.standard)?;
        data.is_file().then_some(data.len())
    }

    /// How many bytes have been read since it was last opened.
    pub(crate) fn position(&self) -> u64 {
        self.read.load(Ordering::Relaxed)
    }

    /// Opens it from its beginning, after a byte order mark. Nothing is an error.
    pub(super) fn open(&self) -> Result<Reader, Failure> {
        self.read.store(0, Ordering::Relaxed);
        let counted = Counted {
            source: self.source()?,
            read: Arc::clone(&self.read),
            begun: false,
        };
        let mut reader = BufReader::with_capacity(BUFFER, counted);
        let start = reader.fill_buf().map_err(|e| self.failure(e))?;
        // A binary STL file may begin with anything.
        if self.format != Format::Stl {
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
        #[cfg(any(test, fuzzing))]
        if let Some(content) = &self.content {
            return Ok(Box::new(io::Cursor::new(Arc::clone(content))));
        }
        if self.standard {
            return Ok(Box::new(io::stdin()));
        }
        let file = File::open(&self.name).map_err(|e| self.failure(e))?;
        if file.metadata().is_ok_and(|data| data.is_dir()) {
            return Err(self.failure("a folder, not a file"));
        }
        Ok(Box::new(file))
    }

    /// A failure of the whole.
    pub(super) fn failure(&self, why: impl std::fmt::Display) -> Failure {
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
    pub(super) fn failure_in_line(&self, (line, why): (u64, String)) -> Failure {
        self.failure_at(format_args!("line {line}"), why)
    }
}

/// Counts what is read.
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
