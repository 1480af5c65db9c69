//! A command's manual page, as roff.
//!
//! `clap_mangen` writes all but the end of the help text, which it would fill
//! and justify: tables and examples must keep their lines.

use crate::failure::Failure;
use clap::Command;
use clap_mangen::Man;

/// The page's file name, such as `frusta-clip.1`.
pub(crate) fn file_name(command: &Command) -> String {
    format!("{}.1", title(command))
}

/// The page of a command that is built.
pub(crate) fn page(command: &Command) -> Result<String, Failure> {
    let man = Man::new(command.clone());
    let (title, version) = (title(command), env!("CARGO_PKG_VERSION"));
    // `clap_mangen` leaves the date out if there is none, and the version
    // would be taken for it.
    let mut roff = format!(".TH \"{title}\" 1 \"\" \"frusta {version}\" \"frusta\"\n").into_bytes();
    let mut render = || {
        man.render_name_section(&mut roff)?;
        man.render_synopsis_section(&mut roff)?;
        man.render_description_section(&mut roff)?;
        man.render_options_section(&mut roff)?;
        if command.has_subcommands() {
            man.render_subcommands_section(&mut roff)?;
        }
        std::io::Result::Ok(())
    };
    render().map_err(Failure::new)?;
    let mut page = String::from_utf8(roff).map_err(Failure::new)?;
    let end = command
        .get_after_long_help()
        .or_else(|| command.get_after_help());
    if let Some(end) = end {
        sections(&end.to_string(), &mut page);
    }
    Ok(page)
}

fn title(command: &Command) -> &str {
    command
        .get_display_name()
        .unwrap_or_else(|| command.get_name())
}

/// A line at the margin, with a blank one above and an indented one below it,
/// is a section's heading; all others are printed as they are.
fn sections(help: &str, page: &mut String) {
    let mut lines = help.lines().peekable();
    let (mut open, mut after_blank) = (false, true);
    while let Some(line) = lines.next() {
        let is_heading = after_blank
            && !line.is_empty()
            && !line.starts_with(' ')
            && lines.peek().is_some_and(|next| next.starts_with(' '));
        if is_heading || !open {
            page.push_str(if open { ".fi\n" } else { "" });
            let heading = if is_heading { line } else { "Remarks" };
            let mut heading = heading.trim_end_matches(':').to_owned();
            // Not a sentence, in which an option may be named.
            if heading.chars().all(|c| c.is_alphabetic() || c == ' ') {
                heading = heading.to_uppercase();
            }
            page.push_str(&format!(".SH \"{}\"\n.nf\n", escaped(&heading)));
            open = true;
        }
        after_blank = line.is_empty();
        if !is_heading {
            page.push_str(&escaped(line));
            page.push('\n');
        }
    }
    page.push_str(if open { ".fi\n" } else { "" });
}

/// Text of which roff takes no letter for its own.
fn escaped(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    if line.starts_with(['.', '\'']) {
        out.push_str("\\&");
    }
    for c in line.chars() {
        match c {
            '\\' => out.push_str("\\e"),
            '-' => out.push_str("\\-"),
            '\'' => out.push_str("\\(aq"),
            '"' => out.push_str("\\(dq"),
            '`' => out.push_str("\\(ga"),
            '^' => out.push_str("\\(ha"),
            '~' => out.push_str("\\(ti"),
            _ => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_and_lines() {
        let mut page = String::new();
        sections(
            "Files (--x)\n  a.b\n  \\c\nand\n  d\n\nThe rest.\n.dot\n\nExit codes:\n  0  done",
            &mut page,
        );
        assert_eq!(
            page,
            ".SH \"Files (\\-\\-x)\"\n.nf\n  a.b\n  \\ec\nand\n  d\n\nThe rest.\n\\&.dot\n\n.fi\n\
             .SH \"EXIT CODES\"\n.nf\n  0  done\n.fi\n"
        );
        let mut page = String::new();
        sections("More.", &mut page);
        assert_eq!(page, ".SH \"REMARKS\"\n.nf\nMore.\n.fi\n");
    }
}
