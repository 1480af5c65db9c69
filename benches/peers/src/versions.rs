//! Versions of the libraries, as this build's `Cargo.lock` has them.

const LOCK: &str = include_str!("../Cargo.lock");

/// The version of a crate that this program was built with.
pub fn version(library: &str) -> Option<&'static str> {
    let name = format!("name = \"{library}\"");
    let mut lines = LOCK.lines().skip_while(|line| *line != name);
    let version = lines.nth(1)?.strip_prefix("version = \"")?;
    version.strip_suffix('"')
}

#[cfg(test)]
mod tests {
    use super::version;

    #[test]
    fn versions_are_the_lock_files() {
        for library in ["parry3d", "parry3d-f64", "retrofire-core", "frusta"] {
            let version = version(library).expect(library);
            assert_eq!(version.split('.').count(), 3, "{library} {version}");
        }
        assert_eq!(version("frusta"), Some(frusta_version()));
        assert_eq!(version("no such crate"), None);
    }

    /// From the manifest of frusta's workspace, whose packages have one version.
    fn frusta_version() -> &'static str {
        let manifest = include_str!("../../../Cargo.toml");
        let lines = manifest.lines();
        let mut package = lines.skip_while(|line| *line != "[workspace.package]");
        let line = package.find(|line| line.starts_with("version = "));
        line.and_then(|line| line.split('"').nth(1)).expect("one")
    }
}
