//! `frusta samples map`: the pictures of the documentation are what it draws, and
//! the exact half of each is what the oracle says.

use crate::{Folder, frusta, text};
use std::path::Path;

const PLACES: [&str; 3] = ["face", "edge", "vertex"];

/// `FRUSTA_BLESS=1` writes the pictures anew.
#[test]
fn the_documentation_has_these_maps() {
    for place in PLACES {
        let name = format!("map-{place}.svg");
        let folder = Folder::new();
        let made = folder.path(&name);
        let output = frusta(["samples", "map", place, "-o", made.to_str().unwrap()]);
        let said = text(&output.stdout);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let wrong: u32 = said.split(' ').nth(2).unwrap().parse().unwrap();
        assert!(said.starts_with("9216 inputs, ") && wrong > 500, "{said}");
        let made = std::fs::read_to_string(made).unwrap();
        let kept = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../docs")
            .join(&name);
        if std::env::var_os("FRUSTA_BLESS").is_some() {
            std::fs::write(&kept, &made).unwrap();
        }
        let kept = std::fs::read_to_string(kept).unwrap();
        assert!(
            made == kept,
            "docs/{name} is not what `frusta samples map {place}` draws"
        );
        // One line and no blank one: else it would not pass through Markdown.
        assert_eq!(kept.trim_end().lines().count(), 1);
    }
}
