//! `lariat report`, `lariat stability`, `lariat matrix` and `lariat table1`, which the program
//! `lariat-bench` runs.
//!
//! They belong to the unpublished package `lariat-bench`, which is not linked into this command.
//! `lariat report ...` starts the program `lariat-bench` in the folder of this one. Under `cargo
//! run --bin lariat -- report ...` cargo builds and runs it.

use clap::{Args, Subcommand};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The subcommands of `lariat-bench`.
#[derive(Subcommand)]
pub enum Bench {
    /// Measure what a cable on a Rapier body costs (program lariat-bench)
    #[command(disable_help_flag = true)]
    Coupling(Arguments),
    /// Run every pair of features on a small scene (program lariat-bench)
    #[command(disable_help_flag = true)]
    Matrix(Arguments),
    /// Measure accuracy against cost (program lariat-bench)
    #[command(disable_help_flag = true)]
    Report(Arguments),
    /// Run the hard cases on all hosts (program lariat-bench)
    #[command(disable_help_flag = true)]
    Stability(Arguments),
    /// Measure Table 1 of the paper (program lariat-bench)
    #[command(disable_help_flag = true)]
    Table1(Arguments),
}

#[derive(Args)]
pub struct Arguments {
    /// Arguments of the subcommand; --help lists them
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

/// Runs a subcommand with its arguments.
pub fn run(bench: &Bench) -> u8 {
    let (name, Arguments { arguments }) = match bench {
        Bench::Coupling(arguments) => ("coupling", arguments),
        Bench::Matrix(arguments) => ("matrix", arguments),
        Bench::Report(arguments) => ("report", arguments),
        Bench::Stability(arguments) => ("stability", arguments),
        Bench::Table1(arguments) => ("table1", arguments),
    };
    let Some(mut command) = command() else {
        eprintln!(
            "error: lariat {name} needs the program lariat-bench in the folder of lariat; in the workspace of Lariat, \
             `cargo build --release -p lariat-bench` builds it"
        );
        return 2;
    };
    match command.arg(name).args(arguments).status() {
        Ok(status) => status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1),
        Err(error) => {
            eprintln!("error: cannot start lariat-bench: {error}");
            2
        }
    }
}

/// Returns the command that starts `lariat-bench`: through cargo if cargo started this program, so
/// that it is up to date.
fn command() -> Option<Command> {
    // from the workspace, whose build is shared, and not from the package, which would be built
    // with features of its own
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../Cargo.toml");
    if let Some(cargo) = std::env::var_os("CARGO").filter(|_| manifest.is_file()) {
        let mut command = Command::new(cargo);
        command.args(["run", "--quiet", "--bin", "lariat-bench", "--manifest-path"]).arg(manifest);
        if !cfg!(debug_assertions) {
            command.arg("--release");
        }
        command.arg("--");
        return Some(command);
    }
    neighbour().map(Command::new)
}

/// Returns the program `lariat-bench` in the folder of this one.
fn neighbour() -> Option<PathBuf> {
    let program = std::env::current_exe().ok()?.with_file_name(format!("lariat-bench{}", std::env::consts::EXE_SUFFIX));
    program.is_file().then_some(program)
}
