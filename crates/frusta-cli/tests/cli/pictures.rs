//! Pictures: `-o x.svg`, `-o x.png` and what they look like.

use super::{Folder, WIDE, clip, fixture, random_segments, statistics, text};
use frusta::Segment;

/// Clips to a picture; gives its text.
fn svg(folder: &Folder, args: &[&str]) -> String {
    let out = folder.name("picture.svg");
    let run = clip(args.iter().copied().chain(["-o", &out]));
    assert!(run.status.success(), "{args:?}: {}", text(&run.stderr));
    let svg = folder.read("picture.svg");
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    svg
}

/// Clips to a PNG; gives width, height and pixels of four bytes.
fn pixels(folder: &Folder, args: &[&str]) -> (u32, u32, Vec<u8>) {
    let out = folder.name("picture.png");
    let run = clip(args.iter().copied().chain(["-o", &out]));
    assert!(run.status.success(), "{args:?}: {}", text(&run.stderr));
    let file = std::fs::File::open(folder.path("picture.png")).unwrap();
    let mut reader = png::Decoder::new(std::io::BufReader::new(file))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgba);
    (info.width, info.height, pixels)
}

fn rows(segments: &[Segment<f64>]) -> String {
    let row = |Segment { start: a, end: b }: &Segment<f64>| {
        format!("{},{},{},{},{},{}\n", a.x, a.y, a.z, b.x, b.y, b.z)
    };
    segments.iter().map(row).collect()
}

/// How many different colours there are.
fn colours(pixels: &[u8]) -> usize {
    let mut colours: Vec<&[u8]> = pixels.chunks(4).collect();
    colours.sort_unstable();
    colours.dedup();
    colours.len()
}

const CAMERA: [&str; 2] = ["--picture", "camera"];
const OUTSIDE: [&str; 2] = ["--picture", "outside"];

#[test]
fn few_strokes_are_vectors_by_class_with_marks_where_they_are_clipped() {
    let folder = Folder::new();
    let (six, pair) = (fixture("six.csv"), fixture("pair.json"));
    let svg = svg(&folder, &[&six, "--frustum", &pair]);
    // 1144 pixels in tenths; seen along -z: x to the right, y upwards.
    assert!(svg.contains("<path class=\"cross\" stroke=\"#d55e00\""));
    assert!(svg.contains("d=\"M0 5720l11440 0M5720 5720l0 0\""), "{svg}");
    assert!(svg.contains("class=\"touch\""));
    assert!(
        svg.contains("M11440 0l0 0"),
        "touches at the upper right: {svg}"
    );
    for class in ["inside", "boundary", "cross", "touch"] {
        assert_eq!(svg.matches(&format!("<path class=\"{class}\"")).count(), 1);
    }
    let marks = svg.split("<g class=\"cut\"").nth(1).unwrap();
    let marks = marks.split("</g>").next().unwrap();
    assert_eq!(marks.matches("<circle").count(), 4);
    assert!(svg.contains(">outside</tspan> 1<"));
    assert!(!svg.contains("<image"));
}

#[test]
fn the_view_from_outside_marks_each_clipped_end_and_shows_what_is_cut_away() {
    let folder = Folder::new();
    let (six, pair) = (fixture("six.csv"), fixture("pair.json"));
    let args = [&six, "--frustum", &pair, OUTSIDE[0], OUTSIDE[1]];
    let svg = svg(&folder, &args);
    for class in [
        "outside", "cut-away", "inside", "boundary", "cross", "touch",
    ] {
        assert_eq!(
            svg.matches(&format!("<path class=\"{class}\"")).count(),
            1,
            "{class}"
        );
    }
    let (cut, _) = svg
        .split("<g class=\"cut\"")
        .nth(1)
        .unwrap()
        .split_once("</g>")
        .unwrap();
    // All but the touch's two.
    let ends = statistics(&[&six, "--frustum", &pair])["clipped_ends"].as_u64();
    assert_eq!(ends, Some(6));
    assert_eq!(cut.matches("<circle").count(), 4);
    assert!(svg.contains("class=\"frustum\"") && svg.contains("class=\"eye\""));
    assert!(svg.contains(">near</text>") && svg.contains(">far</text>"));
    // Without a far face the frustum is drawn open.
    let infinite = fixture("infinite.json");
    let svg = self::svg(
        &folder,
        &[&six, "--frustum", &infinite, OUTSIDE[0], OUTSIDE[1]],
    );
    assert!(svg.contains(">near</text>") && !svg.contains(">far</text>"));
}

#[test]
fn the_number_of_threads_does_not_show_in_pictures() {
    let folder = Folder::new();
    let many = folder.write("many.csv", rows(&random_segments(60_000)));
    let few = fixture("6814_ice_tunnelator.glb");
    for view in [CAMERA, OUTSIDE] {
        for (file, is_image) in [(&many, true), (&few, false)] {
            let files = ["1", "2", "5"].map(|threads| {
                let mut args = vec![file.as_str(), "--threads", threads];
                args.extend(view);
                svg(&folder, &args)
            });
            assert!(files.iter().all(|f| *f == files[0]), "{file} {view:?}");
            assert_eq!(files[0].contains("<image"), is_image);
        }
    }
}

#[test]
fn many_strokes_are_an_image_between_vectors() {
    let folder = Folder::new();
    let file = folder.write("many.csv", rows(&random_segments(120_000)));
    let mut args = vec![file.as_str()];
    args.extend(WIDE);
    let svg = svg(&folder, &args);
    assert_eq!(svg.matches("<image ").count(), 1);
    assert!(svg.contains("href=\"data:image/png;base64,"));
    assert!(svg.contains("density: darker = more edges"));
    assert!(!svg.contains("class=\"inside\""));
    // As large as the picture, not as the number of strokes.
    assert!(svg.len() < 6_000_000, "{}", svg.len());
}

#[test]
fn a_png_has_the_width_asked_for_and_is_not_blank() {
    let folder = Folder::new();
    let (six, pair) = (fixture("six.csv"), fixture("pair.json"));
    let many = folder.write("many.csv", rows(&random_segments(30_000)));
    let glb = fixture("6814_ice_tunnelator.glb");
    for view in [CAMERA, OUTSIDE] {
        for (theme, brightness) in [("light", 0xf4), ("dark", 0x10)] {
            for width in ["200", "701"] {
                for file in [&six, &glb, &many] {
                    let mut args = vec![file.as_str(), "--theme", theme, "--width", width];
                    args.extend(view);
                    if *file == six {
                        args.extend(["--frustum", &pair]);
                    }
                    let (w, h, pixels) = pixels(&folder, &args);
                    assert_eq!(w.to_string(), width);
                    assert!((w / 4..2 * w).contains(&h), "{w} x {h}");
                    assert_eq!(pixels[0], brightness);
                    assert!(colours(&pixels) > 30, "{args:?}: {}", colours(&pixels));
                }
            }
        }
    }
    // Of a tall picture the height, without the caption.
    let tall = [&glb, "--aspect", "0.25", "--width", "800"];
    let (w, h, _) = pixels(&folder, &tall.map(|s: &str| s));
    assert!(w < 400 && (800..1000).contains(&h), "{w} x {h}");
}

/// A frustum file: near and far rectangles, or the near one and slopes.
fn frustum(near: [f64; 5], far: [f64; 5], infinite: bool) -> String {
    let rect = |[_, left, right, bottom, top]: [f64; 5]| {
        format!("\"left\":{left:e},\"right\":{right:e},\"bottom\":{bottom:e},\"top\":{top:e}")
    };
    let z = |r: [f64; 5]| format!("\"z\":{:e}", r[0]);
    let other = if infinite {
        format!("\"slopes\":{{{}}},\"direction\":-1", rect(far))
    } else {
        format!("\"far\":{{{},{}}}", z(far), rect(far))
    };
    format!(
        "{{\"origin\":[0,0,0],\"axes\":[[1,0,0],[0,1,0],[0,0,1]],\"near\":{{{},{}}},{other}}}",
        z(near),
        rect(near)
    )
}

#[test]
fn no_shape_nor_scale_gives_a_number_that_is_none() {
    let folder = Folder::new();
    let unit = [
        // Inside, across, outside, of no length, a touch, far beyond.
        [0.0, 0.0, -2.0, 0.5, 0.5, -2.0],
        [-8.0, 0.0, -2.0, 8.0, 0.0, -2.0],
        [0.0, 0.0, 0.0, 0.0, 0.5, 0.0],
        [0.1, 0.1, -1.5, 0.1, 0.1, -1.5],
        [1.0, 3.0, -2.0, 3.0, 1.0, -2.0],
        [-1e3, -1e2, 5.0, 1e3, 1e2, -1e3],
    ];
    let square = |z: f64, s: f64| [z, -s, s, -s, s];
    let shapes = [
        ("pair", square(-1.0, 1.0), square(-3.0, 3.0), false),
        ("pyramid", square(0.0, 0.0), square(-3.0, 3.0), false),
        ("turned", square(-1.0, 3.0), square(-3.0, 0.0), false),
        (
            "wedge",
            [-1.0, -1.0, 1.0, 0.0, 0.0],
            square(-3.0, 2.0),
            false,
        ),
        ("box", square(-1.0, 2.0), square(-3.0, 2.0), false),
        (
            "sheared",
            square(-1.0, 1.0),
            [-3.0, 0.0, 5.0, -1.0, 1.0],
            false,
        ),
        (
            "endless",
            square(-1.0, 1.0),
            [0.0, -1.0, 1.0, -1.0, 1.0],
            true,
        ),
        (
            "endless pyramid",
            square(0.0, 0.0),
            [0.0, -1.0, 1.0, -1.0, 1.0],
            true,
        ),
        ("endless box", square(-1.0, 1.0), [0.0; 5], true),
        ("deep", square(-1.0, 1.0), square(-1e9, 1e9), false),
    ];
    for scale in [1.0, 1e15, 1e-160, 1e300] {
        let mut csv = String::new();
        for row in unit {
            csv += &row.map(|c| format!("{:e}", c * scale)).join(",");
            csv += "\n";
        }
        let file = folder.write("scene.csv", csv);
        for (name, near, far, endless) in shapes {
            let (near, far) = (
                near.map(|c| c * scale),
                if endless { far } else { far.map(|c| c * scale) },
            );
            if !far.iter().all(|c| c.is_finite()) {
                continue;
            }
            let frustum = folder.write("view.json", frustum(near, far, endless));
            for view in [CAMERA, OUTSIDE] {
                let svg = svg(&folder, &[&file, "--frustum", &frustum, view[0], view[1]]);
                for wrong in ["NaN", "inf ", "inf\"", "-inf"] {
                    assert!(!svg.contains(wrong), "{name} {scale:e} {view:?}: {svg}");
                }
                assert!(
                    svg.matches("class=\"").count() > 1,
                    "{name} {scale:e} {view:?}: {svg}"
                );
            }
        }
    }
}

#[test]
fn a_title_is_escaped() {
    let folder = Folder::new();
    let file = folder.write("a<b>&c.csv", "0,0,0,1,1,1\n");
    assert!(svg(&folder, &[&file]).contains("a&lt;b&gt;&amp;c.csv"));
}

#[test]
fn flags_for_pictures_want_a_picture() {
    let folder = Folder::new();
    let (six, csv) = (fixture("six.csv"), folder.name("out.csv"));
    for flags in [
        ["--picture", "outside"],
        ["--theme", "dark"],
        ["--width", "300"],
    ] {
        for output in [vec![], vec!["-o", csv.as_str()]] {
            let run = clip([six.as_str()].into_iter().chain(flags).chain(output));
            let message = text(&run.stderr);
            assert_eq!(run.status.code(), Some(2), "{flags:?}");
            assert_eq!(message.lines().count(), 1, "{message}");
            assert!(message.contains(flags[0]), "{message}");
        }
    }
    let picture = folder.name("out.svg");
    for flags in [
        ["--picture", "inside"],
        ["--theme", "red"],
        ["--width", "199"],
        ["--width", "8001"],
    ] {
        let run = clip([six.as_str(), "-o", &picture].into_iter().chain(flags));
        assert_eq!(run.status.code(), Some(2), "{flags:?}");
    }
    assert!(folder.files().is_empty());
}
