//! The machine that the times are from.

use serde::Serialize;

/// Processor, system and compiler; unknown texts are empty.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The processor's own name.
    pub cpu: String,
    /// Threads that it runs at once.
    pub threads: usize,
    /// Operating system.
    pub os: &'static str,
    /// Instruction set.
    pub arch: &'static str,
    /// The compiler.
    pub rustc: &'static str,
}

impl Machine {
    /// This one.
    pub fn this() -> Self {
        Self {
            cpu: cpu().unwrap_or_default(),
            threads: std::thread::available_parallelism().map_or(0, usize::from),
            os: std::env::consts::OS,
            arch: std::env::consts::ARCH,
            rustc: env!("BUILT_BY"),
        }
    }
}

/// The processor's name, where Linux gives it.
fn cpu() -> Option<String> {
    let info = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = info.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
