//! The `lariat` command: run scenes, find equilibria, print what can be chosen.
//!
//! `lariat coupling`, `lariat report`, `lariat stability` and `lariat table1` are of the unpublished package `lariat-bench`: see [`bench`].

mod bench;
mod progress;
mod tables;

use clap::{Args, Parser, Subcommand};
use lariat_scene::run::{self, Options, Summary};
use lariat_scene::{Error, Purpose, Scene};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Parser)]
#[command(version, about = "Cables that obey real materials: run scenes, find equilibria, compare force strategies")]
#[command(
    after_help = "Exit codes: 0 done; 2 bad input, nothing written; 3 the run failed, samples so far are kept; 130 interrupted"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene: writes DIR/summary.json, DIR/probes/*.csv and DIR/view.html, in place of all that are there
    Run(SceneArguments),
    /// Find the static equilibrium of a scene: the same files, at t = 0
    Static(SceneArguments),
    /// What can be chosen as `rule`
    Rules,
    /// What can be chosen as `integrator`
    Integrators,
    /// Measurements of the workspace: `coupling`, `report`, `stability`, `table1`
    #[command(external_subcommand)]
    Bench(Vec<OsString>),
}

#[derive(Args)]
struct SceneArguments {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Folder for the results; made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Override a key, such as cable.sling.elements=20; may be given many times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        Command::Run(arguments) => run_scene(&arguments).map(|summary| describe(&summary, &arguments)),
        Command::Static(arguments) => find_static(&arguments).map(|summary| describe(&summary, &arguments)),
        Command::Rules => Ok(tables::rules()),
        Command::Integrators => Ok(tables::integrators()),
        Command::Bench(arguments) => return bench::run(&arguments),
    };
    match outcome {
        Ok(text) => {
            // a closed pipe is no failure of the run
            let _ = io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn run_scene(arguments: &SceneArguments) -> Result<Summary, Error> {
    let scene = Scene::read(&arguments.scene, &arguments.set, Purpose::Run)?;
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    let handler = ctrlc::set_handler(move || {
        // the second Ctrl-C does not wait for the host step to end
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    if let Err(error) = handler {
        let _ = writeln!(io::stderr(), "warning: Ctrl-C will not write a summary: {error}");
    }
    let mut bar = progress::Bar::new(scene.duration);
    let mut report = |time: f64| bar.advance(time);
    let mut options = Options { stop, progress: Some(&mut report) };
    let outcome = run::run(&scene, &arguments.out, &mut options);
    bar.finish();
    outcome
}

fn find_static(arguments: &SceneArguments) -> Result<Summary, Error> {
    let scene = Scene::read(&arguments.scene, &arguments.set, Purpose::Static)?;
    run::statics(&scene, &arguments.out)
}

fn describe(summary: &Summary, arguments: &SceneArguments) -> String {
    let warnings: String = summary.warnings.iter().map(|warning| format!("warning: {warning}\n")).collect();
    let energy = |x: Option<f64>| x.map_or("not finite".to_string(), |x| format!("{x:.6} J"));
    format!(
        "{warnings}{}: {} s in {:.3} s ({:.1} times real time), {} steps, {} rejected, {} Newton iterations, \
         energy {} -> {}\nresults in {}\n",
        summary.name,
        summary.simulated_s,
        summary.wall_s,
        summary.real_time_factor,
        summary.steps,
        summary.rejected_steps,
        summary.newton_iterations,
        energy(summary.energy_start_j),
        energy(summary.energy_end_j),
        arguments.out.display()
    )
}
