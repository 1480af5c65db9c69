//! Files that are there whole or not at all, and the standard output.

use crate::failure::Failure;
use crate::terminal::say;
use std::fs::{File, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::{Mutex, PoisonError};
use tempfile::{Builder, NamedTempFile};

/// Bytes between two writes.
const BUFFER: usize = 1 << 18;

/// The exit code of an interrupted run, as shells have it.
const INTERRUPTED: i32 = 130;

/// The temporary names of the files that are being written.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A file under a temporary name beside its own until it is finished; dropped
/// before that, or when the run is interrupted, it leaves nothing and an older
/// file of its name untouched. A link stays one: the file is what it leads to. The
/// standard output (`-`), devices and named pipes are written as they are: they have
/// nothing to be left.
pub(crate) struct AtomicFile {
    /// What messages call it, and where it is.
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

/// Where links lead, whether there is a file or not. An open file's link in `/proc`
/// is not followed: what has it open would not see another file of its name.
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
    let why = "cannot be written: it is a link in a ring";
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
            // A rename would put a plain file in a device's place.
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

/// Makes an interruption (SIGINT, SIGTERM, SIGHUP) remove what is unfinished. A
/// killed process cannot: it leaves a hidden file `.frusta-...` beside.
pub(crate) fn watch_for_interruption() {
    let set = ctrlc::set_handler(|| {
        // Held to the end: no file gets its name after this.
        let unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
        for path in unfinished.iter() {
            let _ = std::fs::remove_file(path);
        }
        say("frusta: interrupted; no unfinished file is left\n");
        process::exit(INTERRUPTED);
    });
    // Without a handler an interruption ends the process as usual.
    drop(set);
}

/// The file for `place`, which messages call `path`.
fn temporary(path: &Path, place: &Path) -> Result<NamedTempFile, Failure> {
    if place.is_dir() {
        return Err(Failure::in_file(path, "cannot be written: it is a folder"));
    }
    let folder = match place.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    // Held while the file comes to be: an interruption must know its name.
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
        // Who reads the standard output has seen enough.
        process::exit(0);
    }
    Failure::in_file(path, format_args!("cannot be written: {why}"))
}

/// The usual permissions (temporary files are private otherwise); the process's
/// mask still applies.
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
