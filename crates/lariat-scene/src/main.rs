//! The `lariat` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(lariat_scene::command::run(std::env::args_os()))
}
