//! Subcommands of the package `lariat-bench`, which is not published and is not linked into this command.
//!
//! `lariat report ...` runs the program `lariat-bench` beside this one. Where there is none and cargo started this command (`cargo run -p
//! lariat-scene -- report ...`), cargo builds and runs it.

use clap::CommandFactory;
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The subcommands of `lariat-bench`.
const NAMES: [&str; 4] = ["coupling", "report", "stability", "table1"];

/// Runs a subcommand of `lariat-bench` with its arguments; anything else is a usage error.
pub fn run(arguments: &[OsString]) -> ExitCode {
    let name = arguments.first().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if !NAMES.contains(&name.as_str()) {
        crate::Cli::command().error(ErrorKind::InvalidSubcommand, format!("unrecognized subcommand '{name}'")).exit();
    }
    let Some(mut command) = command() else {
        eprintln!(
            "error: lariat {name} needs the program lariat-bench beside lariat: cargo build --release -p lariat-bench"
        );
        return ExitCode::from(2);
    };
    match command.args(arguments).status() {
        Ok(status) => ExitCode::from(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1)),
        Err(error) => {
            eprintln!("error: cannot start lariat-bench: {error}");
            ExitCode::from(2)
        }
    }
}

/// The command that starts `lariat-bench`: through cargo if cargo started this program, so that it is never an old build.
fn command() -> Option<Command> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lariat-bench/Cargo.toml");
    if let Some(cargo) = std::env::var_os("CARGO").filter(|_| manifest.is_file()) {
        let mut command = Command::new(cargo);
        command.args(["run", "--quiet", "--manifest-path"]).arg(manifest);
        if !cfg!(debug_assertions) {
            command.arg("--release");
        }
        command.arg("--");
        return Some(command);
    }
    beside().map(Command::new)
}

/// The program `lariat-bench` in the folder of this one.
fn beside() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?.with_file_name(format!("lariat-bench{}", std::env::consts::EXE_SUFFIX));
    program.is_file().then_some(program)
}
