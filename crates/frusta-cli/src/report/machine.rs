//! The machine that times were taken on.

use serde::Serialize;

/// The machine and the compiler, as far as a program can know them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Machine {
    /// The processor's own name.
    pub(crate) cpu: String,
    /// How many threads this process may run at once.
    pub(crate) cores: usize,
    /// The operating system.
    pub(crate) os: &'static str,
    /// The instruction set.
    pub(crate) arch: &'static str,
    /// The compiler's version.
    pub(crate) rustc: String,
    /// The vector instructions available at run time.
    pub(crate) simd: String,
}

impl Machine {
    /// This one.
    pub(crate) fn this() -> Self {
        Self {
            cpu: cpu().unwrap_or_else(|| "unknown".to_owned()),
            cores: crate::cores(),
            os: std::env::consts::OS,
            arch: std::env::consts::ARCH,
            rustc: rustc_version_runtime::version().to_string(),
            simd: simd(),
        }
    }
}

/// The processor's name, where Linux gives it.
fn cpu() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let mut fields = text.lines().filter_map(|line| line.split_once(':'));
    let (_, name) = fields.find(|(key, _)| key.trim() == "model name")?;
    Some(name.trim().to_owned())
}

/// The SIMD level's name in lower case: `avx2`, `neon`.
fn simd() -> String {
    let level = format!("{:?}", fearless_simd::Level::new());
    let name = level.split(['(', ' ']).next().unwrap_or_default();
    name.to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_is_a_word_and_the_compiler_a_version() {
        let machine = Machine::this();
        assert!(!machine.simd.is_empty());
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(machine.simd.chars().all(plain), "{}", machine.simd);
        assert!(machine.rustc.starts_with("1."), "{}", machine.rustc);
        assert!(machine.cores > 0 && !machine.cpu.is_empty());
    }
}
