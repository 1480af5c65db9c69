//! Output on the standard streams.

use crate::failure::Failure;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{ErrorKind, Write};

/// Writes to the standard output. A reader that has gone away is not a failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format_args!("standard output: {e}")))
        }
        _ => Ok(()),
    }
}

/// Writes to the error stream. A failure is ignored: there is no other place to report it.
pub(crate) fn print_error(text: &str) {
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// A bar on the error stream, which is shown only on a terminal. Without a size
/// it counts bytes.
pub(crate) fn progress_bar(size: impl Into<Option<u64>>) -> ProgressBar {
    let (bar, template) = match size.into() {
        Some(size) => (
            ProgressBar::new(size),
            "{bar:40} {percent:>3} %  {eta} left",
        ),
        None => (
            ProgressBar::no_length(),
            "{spinner} {decimal_bytes} read, {decimal_bytes_per_sec}",
        ),
    };
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}
