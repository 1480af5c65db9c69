//! The command `frusta`.

use std::process::ExitCode;

fn main() -> ExitCode {
    frusta_cli::main()
}
