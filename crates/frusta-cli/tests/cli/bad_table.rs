//! `docs/bad-input.md`: the messages about bad files, flags and outputs.
//!
//! Each row is run here: exit code 2, one line, nothing written or left, in
//! little memory (200 MB of address space in all) and processor time. The page is what
//! was printed; with `FRUSTA_BLESS=1` it is written anew.

use super::{Folder, fixture, text};
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// What is at the file's name.
enum Content {
    Bytes(Vec<u8>),
    /// These bytes, then nothing but holes up to 10 GB.
    Huge(Vec<u8>),
    Folder,
    Nothing,
}

use Content::{Bytes, Huge, Nothing};

struct Case {
    what: &'static str,
    file: &'static str,
    content: Content,
    args: &'static [&'static str],
}

fn case(what: &'static str, file: &'static str, content: impl Into<Content>) -> Case {
    Case {
        what,
        file,
        content: content.into(),
        args: &[],
    }
}

impl From<&str> for Content {
    fn from(text: &str) -> Self {
        Bytes(text.as_bytes().to_vec())
    }
}

impl From<Vec<u8>> for Content {
    fn from(bytes: Vec<u8>) -> Self {
        Bytes(bytes)
    }
}

impl From<String> for Content {
    fn from(text: String) -> Self {
        Bytes(text.into_bytes())
    }
}

/// Bytes without sense, always the same.
fn random() -> Vec<u8> {
    let mut state = 0x9e37_79b9_u32;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as u8
    };
    (0..4096).map(|_| next()).collect()
}

fn rows() -> Vec<Case> {
    vec![
        case("an empty file", "a.csv", ""),
        case("random bytes", "a.csv", random()),
        case("a picture's header", "a.csv", b"\x89PNG\r\n\x1a\n".to_vec()),
        case("a row too short", "a.csv", "1,2,3,4,5,6\n1,2,3,4,5\n"),
        case("a row too long", "a.csv", "1,2,3,4,5,6\n1,2,3,4,5,6,7\n"),
        case("semicolons", "a.csv", "1;2;3;4;5;6\n"),
        case("NaN", "a.csv", "1,2,nan,4,5,6\n"),
        case("an infinity", "a.csv", "1,2,3,4,5,-inf\n"),
        case("beyond the range of doubles", "a.csv", "1,2,3,4,1e999,6\n"),
        case(
            "a word",
            "a.csv",
            "x0,y0,z0,x1,y1,z1\n\n# why\n1,2,3,4,five,6\n",
        ),
        case(
            "a header without a column",
            "a.csv",
            "x0,y0,z0,x1,y1\n1,2,3,4,5\n",
        ),
        case(
            "a quote that does not end",
            "a.csv",
            "1,2,3,4,5,6\n1,2,3,4,5,\"6\n1,2,3,4,5,6\n",
        ),
        case(
            "lines that end with carriage returns",
            "a.csv",
            "x0,y0,z0,x1,y1,z1\r1,2,3,4,5,6\r",
        ),
        case("10 GB of nothing", "a.csv", Huge(Vec::new())),
    ]
}

fn objs() -> Vec<Case> {
    vec![
        case("no faces", "a.obj", "v 0 0 0\nv 1 1 1\n"),
        case("a vertex of two numbers", "a.obj", "v 0 0\nl 1 1\n"),
        case(
            "an index beyond the vertices",
            "a.obj",
            "v 0 0 0\nv 1 1 1\nl 1 3\n",
        ),
        case("index 0", "a.obj", "v 0 0 0\nl 0 1\n"),
        case(
            "back before the first vertex",
            "a.obj",
            "v 0 0 0\nv 1 1 1\nl -3 1\n",
        ),
        case(
            "an index beyond 32 bits",
            "a.obj",
            "v 0 0 0\nf 1 1 4294967297\n",
        ),
        case(
            "lines that end with carriage returns",
            "a.obj",
            "v 0 0 0\rv 1 1 1\rl 1 2\r",
        ),
        case("UTF-16", "a.obj", b"\xff\xfev\x00 \x001\x00".to_vec()),
        case("10 GB of nothing", "a.obj", Huge(b"v 0 0 0\n".to_vec())),
    ]
}

fn stls() -> Vec<Case> {
    let solid = |body: &str| format!("solid a\n{body}");
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
                 endloop\nendfacet\n";
    let mut claim = vec![0; 80];
    claim.extend(200_000_000_u32.to_le_bytes());
    claim.extend([0; 500]);
    let mut nan = vec![0; 84];
    nan[80] = 1;
    nan.extend([0; 50]);
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    vec![
        case("random bytes", "a.stl", random()),
        case("a header cut off", "a.stl", vec![0; 50]),
        case("a header that claims 10 GB of triangles", "a.stl", claim),
        case("NaN in a binary file", "a.stl", nan),
        case("a text cut off", "a.stl", solid(facet)),
        case(
            "a text with two corners",
            "a.stl",
            solid(&facet.replacen("vertex 0 0 0\n", "", 1)),
        ),
        case(
            "a text with a word",
            "a.stl",
            solid(&facet.replace("1 0 0", "1 O 0")),
        ),
        case(
            "lines asked of triangles",
            "a.stl",
            solid(facet) + "endsolid\n",
        )
        .with(&["--edges", "lines"]),
        case("10 GB of nothing", "a.stl", Huge(b"solid".to_vec())),
    ]
}

fn plys() -> Vec<Case> {
    let head = |format: &str, vertices: u64, faces: u64| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\n\
             property float y\nproperty float z\nelement face {faces}\n\
             property list uint int vertex_indices\nend_header\n"
        )
    };
    let points = "0 0 0\n1 0 0\n0 1 0\n";
    let claim = head("binary_little_endian", 10_000_000_000, 1).into_bytes();
    let mut list = head("binary_little_endian", 1, 1).into_bytes();
    list.extend([0; 12]);
    list.extend(u32::MAX.to_le_bytes());
    vec![
        case("not PLY", "a.ply", random()),
        case(
            "a header without an end",
            "a.ply",
            "ply\nformat ascii 1.0\n",
        ),
        case(
            "an unknown encoding",
            "a.ply",
            "ply\nformat binary_middle_endian 1.0\nend_header\n",
        ),
        case("a header that claims 10^10 vertices", "a.ply", claim),
        case("a face that claims 2^32 vertices", "a.ply", list),
        case("a text cut off", "a.ply", head("ascii", 3, 1) + points),
        case(
            "an index beyond the vertices",
            "a.ply",
            head("ascii", 3, 1) + points + "3 0 1 3\n",
        ),
        case(
            "an index below 0",
            "a.ply",
            head("ascii", 3, 1) + points + "3 0 1 -1\n",
        ),
        case(
            "a face of two vertices",
            "a.ply",
            head("ascii", 3, 1) + points + "2 0 1\n",
        ),
        case(
            "NaN",
            "a.ply",
            head("ascii", 3, 1) + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n",
        ),
        case(
            "no z",
            "a.ply",
            head("ascii", 1, 0).replace("property float z\n", "") + "0 0\n",
        ),
        case(
            "a number too many",
            "a.ply",
            head("ascii", 3, 1) + points + "3 0 1 2 5\n",
        ),
        case(
            "a property twice",
            "a.ply",
            head("ascii", 3, 1).replace("float y", "float x") + points + "3 0 1 2\n",
        ),
        case(
            "no format",
            "a.ply",
            head("ascii", 3, 1).replace("format ascii 1.0\n", "") + points + "3 0 1 2\n",
        ),
        case("10 GB of nothing", "a.ply", Huge(b"ply\n".to_vec())),
    ]
}

/// An accessor of zeros but for one point.
fn bare_accessor() -> serde_json::Value {
    serde_json::json!({
        "componentType": 5126, "type": "VEC3", "count": 1_000_000_000_u64,
        "min": [0, 0, 0], "max": [0, 0, 0],
        "sparse": {
            "count": 1,
            "indices": {"bufferView": 1, "componentType": 5123},
            "values": {"bufferView": 0}
        }
    })
}

fn gltfs() -> Vec<Case> {
    let ice = std::fs::read(fixture("6814_ice_tunnelator.glb")).unwrap();
    let mut claim = ice.clone();
    claim[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    let mut version = ice.clone();
    version[4] = 1;
    let cubes = std::fs::read_to_string(fixture("cubes.gltf")).unwrap();
    let changed = |pointer: &str, value: serde_json::Value| {
        let mut document: serde_json::Value = serde_json::from_str(&cubes).unwrap();
        *document.pointer_mut(pointer).unwrap() = value;
        document.to_string()
    };
    let json = |text: &str| serde_json::from_str(text).unwrap();
    vec![
        case("random bytes", "a.glb", random()),
        case("a file cut off", "a.glb", ice[..100_000].to_vec()),
        case("a header that claims 4 GB", "a.glb", claim),
        case("version 1", "a.glb", version),
        case("JSON cut off", "a.gltf", cubes[..500].to_owned()),
        case(
            "a buffer that claims 10 GB",
            "a.gltf",
            changed("/buffers/0/byteLength", json("10000000000")),
        ),
        case(
            "an accessor that claims 10^10 points",
            "a.gltf",
            changed("/accessors/0/count", json("10000000000")),
        ),
        case(
            "a buffer that is a device",
            "a.gltf",
            changed("/buffers/0/uri", json("\"/dev/zero\"")),
        ),
        case(
            "10^9 points without bytes",
            "a.gltf",
            changed("/accessors/0", bare_accessor()),
        ),
        case(
            "nodes in a ring",
            "a.gltf",
            changed("/nodes/1", json("{\"children\": [0]}")),
        ),
        case(
            "10 GB of nothing",
            "a.glb",
            Huge(b"glTF\x02\0\0\0\xff\xff\xff\xff".to_vec()),
        ),
        case("10 GB of nothing", "a.gltf", Huge(b"{".to_vec())),
    ]
}

fn geojsons() -> Vec<Case> {
    let line =
        |positions: &str| format!("{{\"type\": \"LineString\", \"coordinates\": {positions}}}");
    let feature = |geometry: &str| {
        format!(
            "{{\"type\": \"FeatureCollection\", \"features\": [\n{{\"type\": \"Feature\", \
             \"properties\": null, \"geometry\": {geometry}}}]}}"
        )
    };
    vec![
        case("random bytes", "a.geojson", random()),
        case(
            "JSON of another kind",
            "a.geojson",
            "{\"type\": \"Topology\", \"arcs\": []}",
        ),
        case("a list", "a.geojson", "[1, 2, 3]"),
        case(
            "a file cut off",
            "a.geojson",
            feature(&line("[[0, 0], [1, 1]]"))[..150].to_owned(),
        ),
        case(
            "a position of one number",
            "a.geojson",
            feature(&line("[[0, 0], [1]]")),
        ),
        case(
            "a position that is a text",
            "a.geojson",
            feature(&line("[[0, 0], [\"1\", 1]]")),
        ),
        case(
            "beyond the range of doubles",
            "a.geojson",
            feature(&line("[[0, 0], [1e999, 1]]")),
        ),
        case(
            "points only",
            "a.geojson",
            "{\"type\": \"Point\", \"coordinates\": [1, 2]}",
        ),
        case(
            "metres for degrees",
            "a.geojson",
            feature(&line("[[565000, 5930000], [1, 1]]")),
        )
        .with(&["--ecef"]),
        case("nested too deep", "a.geojson", "{\"type\":".repeat(100_000)),
        case(
            "a bad line in a sequence",
            "a.geojsonl",
            line("[[0, 0], [1, 1]]") + "\n{\"type\": 5}\n",
        ),
        case("10 GB of nothing", "a.geojson", Huge(b"{".to_vec())),
        case("10 GB of nothing", "a.geojsonl", Huge(Vec::new())),
    ]
}

/// A good row of segments, for bad flags, frusta and outputs.
fn others() -> Vec<Case> {
    let good = || Bytes(b"1,2,3,4,5,6\n".to_vec());
    let frustum = |what, content: &str| Case {
        what,
        file: "view.json",
        content: content.into(),
        args: &["six.csv", "--frustum", "view.json"],
    };
    let flags = |what, args| Case {
        what,
        file: "a.csv",
        content: good(),
        args,
    };
    vec![
        case("no such file", "none.csv", Nothing),
        case("a folder", "a.csv", Content::Folder),
        case("an unknown kind", "a.step", good()),
        case("the earth without degrees", "a.csv", good()).with(&["--ecef"]),
        flags("edges of rows", &["--edges", "all"]),
        flags(
            "a near face that is not before the far",
            &["--near", "5", "--far", "5"],
        ),
        flags(
            "an eye in its target",
            &["--eye", "1,1,1", "--target", "1,1,1"],
        ),
        flags(
            "up along the view",
            &["--eye", "0,9,0", "--target", "0,0,0"],
        ),
        flags("an output without a folder", &["-o", "no/such/out.csv"]),
        flags("an output of an unknown kind", &["-o", "out.gif"]),
        flags("an output that is a folder", &["-o", "taken.csv"]),
        flags("a full disk", &["-o", "/dev/full", "--to", "csv"]),
        frustum("a frustum cut off", "{\"origin\": [0, 0"),
        Case {
            what: "a frustum of 10 GB",
            file: "view.json",
            content: Huge(b"{".to_vec()),
            args: &["six.csv", "--frustum", "view.json"],
        },
        frustum("a frustum of nothing known", "{\"left\": 1}"),
        frustum(
            "a frustum that is inverted",
            "{\"origin\": [0,0,0], \"axes\": [[1,0,0],[0,1,0],[0,0,1]], \
             \"near\": {\"z\":1,\"left\":1,\"right\":-1,\"bottom\":-1,\"top\":1}, \
             \"far\": {\"z\":9,\"left\":9,\"right\":-9,\"bottom\":-9,\"top\":9}}",
        ),
        frustum(
            "a frustum of flat axes",
            "{\"origin\": [0,0,0], \"axes\": [[1,0,0],[0,1,0],[1,1,0]], \
             \"near\": {\"z\":1,\"left\":-1,\"right\":1,\"bottom\":-1,\"top\":1}, \
             \"far\": {\"z\":9,\"left\":-9,\"right\":9,\"bottom\":-9,\"top\":9}}",
        ),
        frustum(
            "a camera with a word",
            "{\"eye\": [0,0,1], \"target\": [0,0,0], \"up\": \"y\"}",
        ),
    ]
}

impl Case {
    fn with(mut self, args: &'static [&'static str]) -> Self {
        self.args = args;
        self
    }

    /// The command's arguments.
    fn command(&self) -> Vec<&str> {
        let mut args = vec!["clip"];
        if !self.args.contains(&"six.csv") {
            args.push(self.file);
        }
        args.extend(self.args);
        args
    }

    /// Makes the files.
    fn prepare(&self, folder: &Folder) {
        folder.write("six.csv", std::fs::read(fixture("six.csv")).unwrap());
        std::fs::create_dir(folder.path("taken.csv")).unwrap();
        match &self.content {
            Bytes(bytes) => {
                folder.write(self.file, bytes);
            }
            Huge(head) => {
                folder.write(self.file, head);
                let file = std::fs::OpenOptions::new()
                    .write(true)
                    .open(folder.path(self.file));
                file.unwrap().set_len(10_000_000_000).unwrap();
            }
            Content::Folder => std::fs::create_dir(folder.path(self.file)).unwrap_or(()),
            Nothing => {}
        }
    }

    /// Runs it; what it prints.
    fn run(&self) -> String {
        let folder = Folder::new();
        self.prepare(&folder);
        let before = folder.files();
        let mut args = self.command();
        if !args.contains(&"-o") {
            args.extend(["-o", "out.csv"]);
        }
        let output = limited(&folder, &args);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{}: {message}", self.what);
        assert_eq!(message.lines().count(), 1, "{}: {message}", self.what);
        assert!(output.stdout.is_empty());
        assert_eq!(folder.files(), before, "{}", self.what);
        message.trim_end().to_owned()
    }
}

/// Runs the command in a folder with 200 MB of address space and a minute of processor time,
/// which, unlike a minute by the clock, does not depend on what else the machine does.
pub(crate) fn limited(folder: &Folder, args: &[&str]) -> Output {
    Command::new("sh")
        .args(["-c", "ulimit -v 200000; ulimit -t 60; exec \"$0\" \"$@\""])
        .arg(env!("CARGO_BIN_EXE_frusta"))
        .args(args)
        .args(["--threads", "1"])
        .current_dir(folder.path(""))
        // One heap for all threads: glibc reserves 64 MB for each further one.
        .env("MALLOC_ARENA_MAX", "1")
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn the_table_of_bad_inputs() {
    let mut page = String::from(
        "# Bad input\n\n\
         What `frusta clip` prints for it, one line on the error stream, with exit code 2. In each case no\n\
         file is written or left behind, and the run fits into 200 MB of address space, also where a file has\n\
         10 GB or claims to. `crates/frusta-cli/tests/cli/bad_table.rs` makes these files and compares this page with what is\n\
         printed.\n",
    );
    let groups = [
        ("CSV", rows()),
        ("OBJ", objs()),
        ("STL", stls()),
        ("PLY", plys()),
        ("glTF", gltfs()),
        ("GeoJSON", geojsons()),
        ("Frusta, flags and outputs", others()),
    ];
    for (title, cases) in groups {
        page += &format!("\n## {title}\n\n| input | arguments | printed |\n|---|---|---|\n");
        for case in cases {
            let message = case.run().replace('|', "\\|");
            let args = case.command()[1..].join(" ");
            page += &format!("| {} | `{args}` | `{message}` |\n", case.what);
        }
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/bad-input.md");
    if std::env::var_os("FRUSTA_BLESS").is_some() {
        std::fs::write(&file, &page).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    for (kept, found) in kept.lines().zip(page.lines()) {
        assert_eq!(
            kept, found,
            "docs/bad-input.md; FRUSTA_BLESS=1 writes it anew"
        );
    }
    assert_eq!(kept, page);
}
