//! PNG from SVG.

use crate::failure::Failure;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};
use std::sync::Arc;

/// Rasterises an SVG at one pixel a unit; the answer is a PNG file's bytes.
///
/// Text is set in DejaVu Sans, which comes with the program: a picture does not
/// depend on the fonts of the machine.
pub(crate) fn png(svg: &str) -> Result<Vec<u8>, Failure> {
    let fail = |why: &dyn std::fmt::Display| Failure::new(format_args!("drawing a PNG: {why}"));
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(dejavu::sans::regular().to_vec());
    fonts.load_font_data(dejavu::sans::bold().to_vec());
    fonts.set_sans_serif_family("DejaVu Sans");
    let options = Options {
        font_family: "DejaVu Sans".to_owned(),
        fontdb: Arc::new(fonts),
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|e| fail(&e))?;
    let size = tree.size().to_int_size();
    let mut pixels = Pixmap::new(size.width(), size.height())
        .ok_or_else(|| fail(&"the picture is too large"))?;
    resvg::render(&tree, Transform::identity(), &mut pixels.as_mut());
    pixels.encode_png().map_err(|e| fail(&e))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_shapes_leave_ink() {
        let draw = |body: &str| {
            let svg = format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"60\" height=\"30\">{body}</svg>"
            );
            Pixmap::decode_png(&png(&svg).unwrap()).unwrap()
        };
        let inked = |p: &Pixmap| p.pixels().iter().filter(|c| c.alpha() > 0).count();
        assert_eq!(inked(&draw("")), 0);
        let text = "<text x=\"2\" y=\"20\" font-family=\"sans-serif\">frusta</text>";
        assert!(inked(&draw(text)) > 100);
        assert_eq!(draw("").width(), 60);
    }
}
