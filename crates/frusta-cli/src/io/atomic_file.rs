//! Files that are written whole or not at all, and the standard output.

use crate::failure::Failure;
use crate::terminal::print_error;
use std::fs::{File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, PoisonError};
use tempfile::{Builder, NamedTempFile};

/// Bytes between two writes.
const BUFFER: usize = 1 << 18;

/// The exit code of an interrupted run, as in shells.
const INTERRUPTED: i32 = 130;

/// The temporary names of the files that are being written.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file under a temporary name beside its own until it is finished; dropped
/// before that, or when the run is interrupted, it leaves nothing and an older
/// file of its name untouched. A symbolic link stays one: its target is written. The
/// standard output (`-`), devices and named pipes are written directly.
pub(crate) struct AtomicFile {
    /// The name for messages, and the path after all links.
    path: PathBuf,
    place: PathBuf,
    out: BufWriter<Target>,
}

enum Target {
    File(NamedTempFile),
    Stream(Box<dyn Write + Send>),
}

impl Write for Target {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.as_file_mut().write(bytes),
            Self::Stream(stream) => stream.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::File(file) => file.as_file_mut().flush(),
            Self::Stream(stream) => stream.flush(),
        }
    }
}

/// Whether a name stands for the standard output.
pub(crate) fn is_stream(path: &Path) -> bool {
    let names = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    names.iter().any(|name| path == Path::new(name))
}

/// The path after all symbolic links, whether there is a file or not. An open file's link
/// in `/proc` is not followed: whoever has the file open would not see a new one.
fn followed(path: &Path) -> Result<PathBuf, Failure> {
    const MOST: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MOST {
        match std::fs::read_link(&place) {
            Ok(target) if !place.starts_with("/proc") => {
                place = place.parent().unwrap_or(Path::new("")).join(target);
            }
            _ => return Ok(place),
        }
    }
    let why = "cannot be written: it is a cycle of links";
    Err(Failure::in_file(path, why))
}

impl AtomicFile {
    /// Begins the file.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        let place = followed(path)?;
        let is_stream = is_stream(path);
        let is_device = place.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir());
        let (path, target) = if is_stream {
            let name = Path::new("standard output");
            (name, Target::Stream(Box::new(io::stdout())))
        } else if is_device || place.starts_with("/proc") {
            // A rename would replace the device by a regular file.
            let device = File::options().append(true).open(&place);
            let device = device.map_err(|e| failure(path, &e))?;
            (path, Target::Stream(Box::new(device)))
        } else {
            (path, Target::File(temporary(path, &place)?))
        };
        Ok(Self {
            path: path.to_owned(),
            place,
            out: BufWriter::with_capacity(BUFFER, target),
        })
    }

    /// Appends bytes.
    pub(crate) fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        let written = self.out.write_all(bytes);
        written.map_err(|e| failure(&self.path, &e))
    }

    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        let fail = |e: &io::Error| failure(&self.path, e);
        self.out.flush().map_err(|e| fail(&e))?;
        match self.out.into_inner() {
            Ok(Target::File(file)) => {
                let mut unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
                let temporary = file.path().to_owned();
                file.persist(&self.place).map_err(|e| fail(&e.error))?;
                unfinished.retain(|path| *path != temporary);
                Ok(())
            }
            Ok(Target::Stream(_)) => Ok(()),
            Err(e) => Err(fail(e.error())),
        }
    }
}

/// Makes an interruption (SIGINT, SIGTERM, SIGHUP) remove unfinished files. A
/// killed process cannot: it leaves a hidden file `.frusta-...` in the same folder.
pub(crate) fn watch_for_interruption() {
    let set = ctrlc::set_handler(|| {
        // Locked until the process ends: no file gets its name after this.
        let unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
        for path in unfinished.iter() {
            let _ = std::fs::remove_file(path);
        }
        print_error("frusta: interrupted; no unfinished file is left\n");
        process::exit(INTERRUPTED);
    });
    // Without a handler an interruption ends the process as usual.
    drop(set);
}

/// The temporary file for `place`; messages name `path`.
fn temporary(path: &Path, place: &Path) -> Result<NamedTempFile, Failure> {
    if place.is_dir() {
        return Err(Failure::in_file(path, "cannot be written: it is a folder"));
    }
    let folder = match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    // Locked while the file is created: an interruption must know its name.
    let mut unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
    let file = builder().tempfile_in(folder).map_err(|e| {
        // The error's own text names the temporary file.
        let why = match e.kind() {
            ErrorKind::NotFound => "its folder does not exist".to_owned(),
            ErrorKind::NotADirectory => "its folder is a file".to_owned(),
            kind => kind.to_string(),
        };
        Failure::in_file(path, format_args!("cannot be written: {why}"))
    })?;
    unfinished.push(file.path().to_owned());
    Ok(file)
}

fn failure(path: &Path, why: &io::Error) -> Failure {
    if why.kind() == ErrorKind::BrokenPipe {
        // The reader of the standard output has gone.
        process::exit(0);
    }
    Failure::in_file(path, format_args!("cannot be written: {why}"))
}

/// With the usual permissions, which temporary files do not have; the process's mask applies.
#[cfg(unix)]
fn builder() -> Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = Builder::new();
    builder
        .prefix(".frusta-")
        .permissions(Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn builder() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".frusta-");
    builder
}
