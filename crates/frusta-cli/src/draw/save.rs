//! A picture to a file, by its extension.

use super::png;
use crate::failure::Failure;
use crate::io::atomic_file::AtomicFile;
use std::path::Path;

/// Writes an SVG to an `.svg` file, or rasterised to a `.png` file; whole or
/// not at all.
pub(crate) fn save(file: &Path, svg: &str) -> Result<(), Failure> {
    let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("");
    let rasterised;
    let bytes = match extension.to_ascii_lowercase().as_str() {
        "svg" => svg.as_bytes(),
        "png" => {
            rasterised = png(svg)?;
            &rasterised
        }
        _ => {
            return Err(Failure::in_file(
                file,
                "unknown kind of picture; expected .svg or .png",
            ));
        }
    };
    let mut out = AtomicFile::create(file)?;
    out.write(bytes)?;
    out.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_extension_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"4\"></svg>";
        for (name, begins) in [("a.svg", &b"<svg"[..]), ("b.PNG", b"\x89PNG")] {
            let file = folder.path().join(name);
            save(&file, svg).unwrap();
            assert!(std::fs::read(&file).unwrap().starts_with(begins), "{name}");
        }
        assert!(save(&folder.path().join("c.jpg"), svg).is_err());
        assert!(save(&folder.path().join("d"), svg).is_err());
        assert!(save(&folder.path().join("e.png"), "no picture").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}
