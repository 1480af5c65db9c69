//! Files that are there whole or not at all.

use crate::failure::Failure;
use std::fs::Permissions;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// A file under a temporary name beside its own until it is finished; dropped
/// before that, it leaves nothing and an older file of its name untouched.
pub(crate) struct WholeFile {
    path: PathBuf,
    out: BufWriter<NamedTempFile>,
}

impl WholeFile {
    /// Begins the file.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        // A rename would put a plain file in a device's or directory's place.
        if path.metadata().is_ok_and(|m| !m.is_file()) {
            return Err(Failure::in_file(
                path,
                "not a plain file; cannot be replaced",
            ));
        }
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let file = builder()
            .tempfile_in(folder)
            .map_err(|e| Failure::in_file(path, format_args!("cannot be written: {e}")))?;
        Ok(Self {
            path: path.to_owned(),
            out: BufWriter::with_capacity(1 << 18, file),
        })
    }

    /// Appends bytes.
    pub(crate) fn write(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.out.write_all(bytes).map_err(|e| self.failure(e))
    }

    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        self.out.flush().map_err(|e| self.failure(e))?;
        let Self { path, out } = self;
        let file = out.into_inner().map_err(|e| failure(&path, e))?;
        file.persist(&path).map_err(|e| failure(&path, e.error))?;
        Ok(())
    }

    fn failure(&self, why: impl std::fmt::Display) -> Failure {
        failure(&self.path, why)
    }
}

fn failure(path: &Path, why: impl std::fmt::Display) -> Failure {
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
