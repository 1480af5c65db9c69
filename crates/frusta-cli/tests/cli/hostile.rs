//! Files that are odd rather than bad: byte order marks, line ends, pipes with
//! names, links, and names that hold anything.

use super::{Folder, WIDE, clip, fixture, started, text};
use std::io::Write;
use std::process::{Command, Output};

/// One small file of each text format.
fn texts() -> [(&'static str, String); 6] {
    let points = "0 0 0\n1 0 0\n0 1 0\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nl 1 2 3 1\n";
    let vertices = points.replace('\n', "\nvertex ");
    let vertices = vertices.trim_end_matches("vertex ");
    [
        (
            "a.csv",
            "x0,y0,z0,x1,y1,z1\n0,0,0,1,0,0\n1,0,0,0,1,0\n0,1,0,0,0,0\n".to_owned(),
        ),
        ("a.obj", obj.to_owned()),
        (
            "a.stl",
            format!(
                "solid a\nfacet normal 0 0 1\nouter loop\nvertex {vertices}endloop\nendfacet\n\
                 endsolid a\n"
            ),
        ),
        (
            "a.ply",
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                 end_header\n{points}3 0 1 2\n"
            ),
        ),
        (
            "a.geojson",
            "{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 0], [1, 0], [0, 1]]]}\n".to_owned(),
        ),
        (
            "a.geojsonl",
            "{\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [1, 0], [0, 1]]]}\n".to_owned(),
        ),
    ]
}

#[test]
fn a_byte_order_mark_and_line_ends_change_nothing() {
    let folder = Folder::new();
    for (name, text) in texts() {
        let file = folder.write(name, &text);
        let rows = folder.rows(&[&[file.as_str()], &WIDE[..]].concat());
        assert_eq!(rows.len(), 3, "{name}");
        for other in [
            format!("\u{feff}{text}"),
            text.replace('\n', "\r\n"),
            text.trim_end().to_owned(),
        ] {
            folder.write(name, &other);
            let found = folder.rows(&[&[file.as_str()], &WIDE[..]].concat());
            assert_eq!(found, rows, "{other:?}");
        }
        // A mark alone is nothing.
        folder.write(name, "\u{feff}");
        let run = clip([&[file.as_str()], &WIDE[..]].concat());
        assert_eq!(run.status.code(), Some(2), "{name}");
    }
    let mut camera = b"\xef\xbb\xbf".to_vec();
    camera.extend(std::fs::read(fixture("camera.json")).unwrap());
    let camera = folder.write("camera.json", camera);
    assert!(
        clip([&fixture("six.csv"), "--frustum", &camera])
            .status
            .success()
    );
}

/// Read as one line, most of such a text would be passed over in silence.
#[test]
fn lines_that_end_with_carriage_returns_alone_are_refused() {
    let folder = Folder::new();
    for (name, content) in &texts()[..4] {
        for other in [
            content.replace('\n', "\r"),
            content.replacen('\n', "\r", 1),
            content.replacen("0\n", "0\r", 1),
        ] {
            let file = folder.write(name, &other);
            let run = clip([&[file.as_str()], &WIDE[..]].concat());
            let message = text(&run.stderr);
            assert_eq!(run.status.code(), Some(2), "{other:?}");
            assert!(
                message.contains("a carriage return without a line feed after it")
                    || message.contains("carriage returns without line feeds"),
                "{other:?}: {message}"
            );
        }
    }
}

#[test]
fn a_pipe_may_give_its_first_bytes_one_by_one() {
    let glb = std::fs::read(fixture("6814_ice_tunnelator.glb")).unwrap();
    let stl = texts()[2]
        .1
        .replace("solid a", "solid Geh\u{e4}use")
        .into_bytes();
    for (format, bytes) in [("stl", stl), ("gltf", glb)] {
        let mut child = started(&["-", "--from", format]);
        let mut stdin = child.stdin.take().unwrap();
        for byte in &bytes[..3] {
            stdin.write_all(&[*byte]).unwrap();
        }
        let rest = bytes[3..].to_vec();
        let feeder = std::thread::spawn(move || drop(stdin.write_all(&rest)));
        let output = child.wait_with_output().unwrap();
        feeder.join().unwrap();
        assert!(
            output.status.success(),
            "{format}: {}",
            text(&output.stderr)
        );
    }
}

/// What a shell's `<(...)` is: it can be read only once.
#[cfg(unix)]
#[test]
fn a_pipe_with_a_name_is_read_once() {
    let folder = Folder::new();
    let obj = "v 0 0 0\nv 1 0 0\nl 1 2\n";
    let wide = |args: &[&'static str]| [args, &WIDE[..]].concat();
    for (name, content, args, code) in [
        ("a.csv", "0,0,0,1,0,0\n", vec![], 2),
        ("b.csv", "0,0,0,1,0,0\n", wide(&[]), 0),
        ("a.obj", obj, wide(&["--edges", "lines"]), 0),
        ("b.obj", obj, vec![], 0),
        (
            "c.obj",
            "l 1 2\nv 0 0 0\nv 1 0 0\n",
            wide(&["--edges", "lines"]),
            2,
        ),
    ] {
        let file = folder.name(name);
        assert!(
            Command::new("mkfifo")
                .arg(&file)
                .status()
                .unwrap()
                .success()
        );
        let pipe = file.clone();
        let feeder = std::thread::spawn(move || {
            let mut pipe = std::fs::File::options().write(true).open(pipe).unwrap();
            drop(pipe.write_all(content.as_bytes()));
        });
        let run = clip([&[file.as_str()], &args[..]].concat());
        let message = text(&run.stderr);
        assert_eq!(run.status.code(), Some(code), "{name}: {message}");
        // The writer of a pipe that was refused unread may still wait for a reader, or may not
        // have begun to: there is one until it is done.
        let reader = std::fs::File::options().read(true).write(true).open(&file);
        feeder.join().unwrap();
        drop(reader);
    }
}

#[test]
fn an_output_may_be_the_input() {
    let folder = Folder::new();
    let file = folder.write("a.csv", "0,0,0,1,0,0\n".repeat(30_000));
    let rows = folder.rows(&[&[file.as_str()], &WIDE[..]].concat());
    let args = [&[file.as_str(), "-o", &file], &WIDE[..]].concat();
    assert!(clip(args).status.success());
    assert_eq!(folder.read("a.csv"), folder.read("rows.csv"));
    assert_eq!(rows.len(), 30_000);
    // A run that fails leaves it as it was.
    let bad = "0,0,0,1,0,0\n".repeat(30_000) + "x\n";
    folder.write("a.csv", &bad);
    let args = [&[file.as_str(), "-o", &file], &WIDE[..]].concat();
    assert_eq!(clip(args).status.code(), Some(2));
    assert_eq!(folder.read("a.csv"), bad);
}

#[cfg(unix)]
#[test]
fn an_output_that_is_a_link_stays_one() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new();
    std::fs::create_dir(folder.path("b")).unwrap();
    folder.write("b/old.csv", "older\n");
    symlink("b/old.csv", folder.path("one.csv")).unwrap();
    symlink("one.csv", folder.path("two.csv")).unwrap();
    symlink("b/new.csv", folder.path("none.csv")).unwrap();
    symlink("ring.csv", folder.path("ring.csv")).unwrap();
    let run = |out: &str| clip([&fixture("six.csv"), "-o", &folder.name(out)]);
    assert!(run("two.csv").status.success());
    assert!(run("none.csv").status.success());
    assert!(folder.read("b/old.csv").starts_with("index,"));
    assert_eq!(folder.read("b/old.csv"), folder.read("b/new.csv"));
    for name in ["one.csv", "two.csv", "none.csv"] {
        assert!(folder.path(name).symlink_metadata().unwrap().is_symlink());
    }
    let output = run("ring.csv");
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("a cycle of links"));
    let before = ["b", "none.csv", "one.csv", "ring.csv", "two.csv"];
    assert_eq!(folder.files(), before);
}

/// `-o /dev/stdout > FILE` must put no file in the device's place, and lose
/// nothing of what a shell appends to.
#[cfg(target_os = "linux")]
#[test]
fn an_open_file_as_output_is_appended_to() {
    let folder = Folder::new();
    let out = folder.write("out.txt", "older\n");
    for (descriptor, redirection) in [("/proc/self/fd/1", ">>"), ("/proc/self/fd/3", "3>>")] {
        let link = folder.name("link.csv");
        std::os::unix::fs::symlink(descriptor, &link).unwrap();
        for name in [descriptor, &link] {
            folder.write("out.txt", "older\n");
            let script = format!("\"$0\" clip \"$@\" 4>&1 {redirection} \"{out}\" 2>/dev/null");
            let run = Command::new("sh")
                .args(["-c", &script, env!("CARGO_BIN_EXE_frusta")])
                .args([&fixture("six.csv"), "-o", name, "--to", "csv"])
                .output()
                .unwrap();
            assert!(run.status.success(), "{name}");
            assert!(folder.read("out.txt").starts_with("older\nindex,class,"));
        }
        assert!(
            folder
                .path("link.csv")
                .symlink_metadata()
                .unwrap()
                .is_symlink()
        );
        std::fs::remove_file(&link).unwrap();
    }
}

#[test]
fn chunks_that_are_just_full() {
    let folder = Folder::new();
    for count in [1, 4095, 4096, 4097, 8192] {
        let line = |i| format!("{{\"type\":\"LineString\",\"coordinates\":[[0,{i}],[1,{i}]]}}\n");
        let obj = "v 0 0 0\nv 1 1 1\n".to_owned() + &"l 1 2\n".repeat(count);
        let obj = folder.write("a.obj", obj);
        let csv = folder.write("a.csv", "0,0,0,1,1,1\n".repeat(count));
        let lines: String = (0..count).map(|i| line(i % 9)).collect();
        let lines = folder.write("a.geojsonl", lines);
        for args in [
            vec![&obj[..], "--edges", "lines"],
            vec![&obj],
            vec![&csv],
            vec![&lines],
        ] {
            for threads in ["1", "5"] {
                let flags = [&args[..], &["--threads", threads], &WIDE].concat();
                let rows = folder.rows(&flags);
                assert_eq!(rows.len(), count, "{args:?}");
                assert!(rows[count - 1].starts_with(&format!("{},inside,", count - 1)));
            }
        }
    }
}

/// A file's name cannot drive the terminal.
#[cfg(unix)]
#[test]
fn names_that_hold_anything() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    for name in [&b"a\nb.csv"[..], b"\x1b[31m.csv", b"\xff\xfe.csv", b"-.csv"] {
        let file = folder.path("").join(OsStr::from_bytes(name));
        std::fs::copy(fixture("six.csv"), &file).unwrap();
        let run = |args: &[&str]| -> Output {
            let mut command = Command::new(env!("CARGO_BIN_EXE_frusta"));
            command.arg("clip").arg(&file).args(args).output().unwrap()
        };
        let plain = run(&[]);
        assert!(plain.status.success());
        let table = text(&plain.stdout);
        assert!(
            table.lines().nth(1).unwrap().starts_with("view "),
            "{table}"
        );
        assert!(!table.contains('\x1b'));
        let json: serde_json::Value = serde_json::from_slice(&run(&["--json"]).stdout).unwrap();
        assert!(json["file"].is_string());
        assert!(run(&["-o", &folder.name("out.svg")]).status.success());
        assert!(!folder.read("out.svg").contains('\x1b'));
    }
}

/// A buffer's name may not lead to what has no end.
#[cfg(unix)]
#[test]
fn buffers_are_plain_files() {
    let folder = Folder::new();
    let cubes = std::fs::read_to_string(fixture("cubes.gltf")).unwrap();
    let mut document: serde_json::Value = serde_json::from_str(&cubes).unwrap();
    for (uri, length, part) in [
        ("/dev/zero", 1_u64 << 40, "/dev/zero: not a regular file"),
        (".", 1, "not a regular file"),
        ("none.bin", 1, "No such file"),
        ("a.gltf", 1 << 40, "byteLength is 1099511627776"),
    ] {
        document["buffers"][0]["uri"] = uri.into();
        document["buffers"][0]["byteLength"] = length.into();
        let file = folder.write("a.gltf", document.to_string());
        let run = clip([file.as_str()]);
        assert_eq!(run.status.code(), Some(2));
        assert!(text(&run.stderr).contains(part), "{}", text(&run.stderr));
    }
}

#[test]
fn a_frustum_has_an_end() {
    let folder = Folder::new();
    let file = folder.write("view.json", " ".repeat(2_000_000));
    let run = clip([&fixture("six.csv"), "--frustum", &file]);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("longer than 1048576 bytes"));
}

/// Where the system has no thread left, or no room for its stack.
#[cfg(target_os = "linux")]
#[test]
fn too_many_threads_are_refused() {
    let folder = Folder::new();
    let (mut done, mut refused) = (0, 0);
    // Few fit by far, many never do; how many exactly depends on the program's own size.
    for threads in [1, 8, 24].into_iter().chain((60..=180).step_by(8)) {
        let run = Command::new("sh")
            .args(["-c", "ulimit -v 300000; exec \"$0\" \"$@\""])
            .arg(env!("CARGO_BIN_EXE_frusta"))
            .args(["clip", &fixture("six.csv"), "-o", &folder.name("out.csv")])
            .args(["--threads", &threads.to_string()])
            .env("MALLOC_ARENA_MAX", "1")
            .output()
            .unwrap();
        let message = text(&run.stderr);
        assert!(!message.contains("panicked"), "{threads}: {message}");
        match run.status.code() {
            Some(0) => done += 1,
            Some(2) => {
                refused += 1;
                assert!(message.starts_with("frusta: threads: "), "{message}");
                assert!(folder.files().iter().all(|name| name == "out.csv"));
            }
            // The last thread may have left no room for a buffer.
            code => assert!(message.contains("memory allocation"), "{code:?}: {message}"),
        }
    }
    assert!(done > 0 && refused > 0, "{done} {refused}");
}

/// Found by the fuzz target `read_geojson`: a message was cut to a length before
/// its control characters became escapes of six characters each.
#[test]
fn escapes_do_not_make_a_message_long() {
    let folder = Folder::new();
    let kind = "\u{7f}".repeat(200);
    let content = format!("{{\"type\": \"{kind}\", \"coordinates\": []}}\n");
    let file = folder.write("a.geojson", content);
    let output = clip([file.as_str()]);
    assert_eq!(output.status.code(), Some(2));
    let message = text(&output.stderr);
    assert!(message.contains("not GeoJSON"), "{message}");
    assert!(message.len() <= 350 + file.len(), "{}", message.len());
}
