//! `frusta completions` and `frusta man`: what a shell and a reader need to
//! know of the command line, from the command line's own definition.

mod manual;

use crate::EXIT_CODES;
use crate::failure::{Failure, quote};
use crate::io::atomic_file::AtomicFile;
use crate::terminal::print;
use clap::{Args, Command, CommandFactory};
use clap_complete::Shell;
use std::path::PathBuf;

/// Write a script that completes frusta's commands and options in a shell
#[derive(Args, Debug)]
#[command(after_long_help = format!("{COMPLETIONS}\n{EXIT_CODES}"))]
pub(crate) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Write manual pages, as roff
#[derive(Args, Debug)]
#[command(after_long_help = format!("{MAN}\n{EXIT_CODES}"))]
pub(crate) struct ManArgs {
    /// The command that the page is about, such as `samples show` [default: the whole program]
    #[arg(value_name = "COMMAND")]
    path: Vec<String>,
    /// Write the pages of all commands to this folder instead; which is created if need be
    #[arg(short, long, value_name = "DIR", conflicts_with = "path")]
    output: Option<PathBuf>,
}

/// Runs `frusta completions`.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(
        args.shell,
        &mut crate::Cli::command(),
        "frusta",
        &mut script,
    );
    print(&String::from_utf8_lossy(&script))
}

/// Runs `frusta man`.
pub(crate) fn man(args: &ManArgs) -> Result<(), Failure> {
    let program = program();
    let Some(folder) = &args.output else {
        return print(&manual::page(find(&program, &args.path)?)?);
    };
    let mut pages = Vec::new();
    collect(&program, &mut pages)?;
    std::fs::create_dir_all(folder).map_err(|e| Failure::in_file(folder, e))?;
    for (name, page) in &pages {
        let mut file = AtomicFile::create(&folder.join(name))?;
        file.write(page.as_bytes())?;
        file.finish()?;
    }
    print(&format!("{} pages in {}\n", pages.len(), folder.display()))
}

/// The whole command line, its commands named in full; `help` needs no page.
fn program() -> Command {
    let mut program = crate::Cli::command().disable_help_subcommand(true);
    program.build();
    program
}

fn find<'a>(program: &'a Command, path: &[String]) -> Result<&'a Command, Failure> {
    path.iter().try_fold(program, |command, name| {
        command.find_subcommand(name).ok_or_else(|| {
            let known = command.get_subcommands().map(Command::get_name);
            let known = known.collect::<Vec<_>>().join(", ");
            let of = command.get_bin_name().unwrap_or("frusta");
            Failure::new(if known.is_empty() {
                format!("{of} has no command {}, nor any other", quote(name))
            } else {
                format!("{of} has no command {}; it has {known}", quote(name))
            })
        })
    })
}

/// The pages of a command and of all below it, with their files' names.
fn collect(command: &Command, pages: &mut Vec<(String, String)>) -> Result<(), Failure> {
    pages.push((manual::file_name(command), manual::page(command)?));
    let mut below = command.get_subcommands();
    below.try_for_each(|command| collect(command, pages))
}

const COMPLETIONS: &str = "\
Examples
  frusta completions bash > ~/.local/share/bash-completion/completions/frusta
  frusta completions zsh > \"${fpath[1]}/_frusta\"
  frusta completions fish > ~/.config/fish/completions/frusta.fish
  frusta completions powershell >> $PROFILE
  frusta completions elvish > ~/.config/elvish/lib/frusta.elv
      and `use frusta` in rc.elv
";

const MAN: &str = "\
Examples
  frusta man clip | man -l -
      read a page
  frusta man samples show > frusta-samples-show.1
  frusta man --output ~/.local/share/man/man1
      frusta.1, frusta-clip.1 and all others; then `man frusta-clip`
";
