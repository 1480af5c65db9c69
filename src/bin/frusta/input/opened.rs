//! Files and the standard input, opened.

use super::Format;
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Bytes between two looks at the file.
const BUFFER: usize = 1 << 18;

/// What to read, and as what.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    /// The file's name, or what messages call the standard input.
    name: PathBuf,
    /// Whether it is the standard input.
    piped: bool,
    /// The format.
    pub(crate) format: Format,
    /// How many bytes have been read.
    read: Arc<AtomicU64>,
}

/// A buffered reader.
pub(super) type Reader = BufReader<Counted>;

impl Input {
    /// A file, or the standard input for `-`; without a format the file's name
    /// tells it.
    pub(crate) fn new(file: &Path, format: Option<Format>) -> Result<Self, Failure> {
        let piped = file == Path::new("-");
        let format = match format {
            Some(format) => format,
            None if piped => {
                let why = "give its format with --from";
                return Err(Failure::in_file(Path::new("standard input"), why));
            }
            None => Format::of(file)?,
        };
        Ok(Self {
            name: if piped {
                PathBuf::from("standard input")
            } else {
                file.to_owned()
            },
            piped,
            format,
            read: Arc::default(),
        })
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
        let data = self.name.metadata().ok().filter(|_| !self.piped)?;
        data.is_file().then_some(data.len())
    }

    /// How many bytes have been read since it was last opened.
    pub(crate) fn position(&self) -> u64 {
        self.read.load(Ordering::Relaxed)
    }

    /// Opens it from its beginning.
    pub(super) fn open(&self) -> Result<Reader, Failure> {
        self.read.store(0, Ordering::Relaxed);
        let source: Box<dyn Read + Send> = if self.piped {
            Box::new(io::stdin())
        } else {
            let file = File::open(&self.name).map_err(|e| self.failure(e))?;
            if let Ok(data) = file.metadata() {
                if data.is_dir() {
                    return Err(self.failure("a folder, not a file"));
                }
                if data.is_file() && data.len() == 0 {
                    return Err(self.failure("the file is empty"));
                }
            }
            Box::new(file)
        };
        let counted = Counted {
            source,
            read: Arc::clone(&self.read),
        };
        Ok(BufReader::with_capacity(BUFFER, counted))
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
}

impl Read for Counted {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        self.read.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }
}
