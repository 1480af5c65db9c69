//! `frusta completions` and `frusta man`.

use crate::{Folder, frusta, text};

fn succeed(args: &[&str]) -> String {
    let output = frusta(args);
    assert!(
        output.status.success(),
        "{args:?}: {}",
        text(&output.stderr)
    );
    text(&output.stdout)
}

#[test]
fn each_shell_completes_the_commands() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = succeed(&["completions", shell]);
        for word in ["samples", "export", "near-misses", "clip", "accuracy"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(frusta(["completions", "sh"]).status.code(), Some(2));
}

/// What a page shows, but for fonts: roff's names of letters undone.
fn plain(page: &str) -> String {
    let mut plain = page.replace("\\&", "");
    for (name, letter) in [
        ("\\-", "-"),
        ("\\(aq", "'"),
        ("\\(dq", "\""),
        ("\\(ga", "`"),
        ("\\(ha", "^"),
        ("\\(ti", "~"),
        ("\\e", "\\"),
    ] {
        plain = plain.replace(name, letter);
    }
    plain
}

#[test]
fn a_page_holds_the_help_line_by_line() {
    for command in [
        &["clip"][..],
        &["report"],
        &["verify"],
        &["samples"],
        &["samples", "list"],
        &["samples", "show"],
        &["samples", "sheet"],
        &["samples", "export"],
        &["completions"],
        &["man"],
    ] {
        let page = succeed(&[&["man"], command].concat());
        let name = command.join("-");
        assert!(
            page.starts_with(&format!(".TH \"frusta-{name}\" 1 ")),
            "{page}"
        );
        let plain = plain(&page);
        let help = succeed(&[command, &["--help"]].concat());
        // Before the examples the help is wrapped to the terminal.
        let (_, end) = help
            .split_once("\nExamples\n")
            .or(help.split_once("\nExit codes:\n"))
            .unwrap();
        assert!(plain.contains(".SH \"EXIT CODES\"\n"), "{name}");
        for line in end.lines().filter(|line| line.starts_with(' ')) {
            assert!(plain.lines().any(|found| found == line), "{name}: {line:?}");
        }
    }
    let page = succeed(&["man"]);
    assert!(page.starts_with(".TH \"frusta\" 1 ") && page.contains("samples"));
}

#[test]
fn no_line_of_a_help_is_taken_for_a_request() {
    let page = succeed(&["man", "clip"]);
    let (_, end) = page.split_once(".SH \"INPUT\"").unwrap();
    assert!(end.contains("\n.SH \"OUTPUT\"\n"), "{end}");
    for line in end.lines().filter(|line| line.starts_with(['.', '\''])) {
        let known = [".nf", ".fi"].contains(&line) || line.starts_with(".SH \"");
        assert!(known, "{line:?}");
    }
}

#[test]
fn all_pages_at_once() {
    let folder = Folder::new();
    let said = succeed(&["man", "--output", &folder.name("man1")]);
    let mut names: Vec<String> = std::fs::read_dir(folder.path("man1"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert!(
        said.starts_with(&format!("{} pages", names.len())),
        "{said}"
    );
    for name in ["frusta.1", "frusta-clip.1", "frusta-samples-show.1"] {
        assert!(names.iter().any(|n| n == name), "{names:?}");
    }
    for name in names {
        assert!(folder.read(&format!("man1/{name}")).starts_with(".TH \""));
    }
}

#[test]
fn an_unknown_command_has_no_page() {
    for args in [
        &["man", "clop"][..],
        &["man", "clip", "more"],
        &["man", "samples", "x"],
    ] {
        let output = frusta(args);
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(text(&output.stderr).lines().count(), 1);
    }
}
