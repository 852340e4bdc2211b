//! The `lariat` command: runs scenes, finds equilibria, lists keys, rules and integrators. The program of
//! this package is it, and so is that of the wheel for Python.

mod bench;
mod describe;
mod keys;
mod progress;
mod sweep;
mod tables;

pub use keys::print as keys;
pub use tables::rules;

use crate::run::{self, Options, State, Summary};
use crate::signed::Comment;
use crate::{Error, Purpose, Scene};
use clap::{Args, Parser, Subcommand};
use lariat_ancf::Level;
use lariat_ancf::study::{Resolution, Target};
use std::cell::RefCell;
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Parser)]
#[command(
    name = "lariat",
    version,
    about = "Cables with real materials: runs scenes, finds equilibria, compares force strategies"
)]
#[command(
    after_help = "Exit codes: 0 done; 2 invalid input, nothing written; 3 the run failed, samples so far are kept; 130 interrupted\n\
                  report, stability, matrix and table1 are measurements of the workspace: see lariat report --help"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene: writes DIR/summary.json, DIR/probes/*.csv and DIR/view.html, and removes what the last run wrote there
    Run(RunArguments),
    /// Find the static equilibrium of a scene: prints it, and writes the same files, at t = 0, and DIR/state, which a run can start from
    Static(SceneArguments),
    /// Run a scene over a grid of values, on all threads: writes DIR/rows.jsonl and DIR/table.csv
    Sweep(sweep::SweepArguments),
    /// Read the cables of a MuJoCo model (composite cable, flexcomp of dim 1) and print them as a scene
    Import {
        /// Model (MJCF, .xml)
        model: PathBuf,
        /// Write the scene to this file instead; one that an import wrote, and nobody changed, is replaced
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// List the keys of a scene file, with unit, range and default
    Keys {
        /// A table or key, such as cable.drag
        key: Option<String>,
        /// Replace the tables in this page (docs/scene.md) instead of printing them
        #[arg(long, value_name = "FILE", conflicts_with = "key")]
        into: Option<PathBuf>,
    },
    /// List the values of `rule`
    Rules,
    /// List the values of `integrator`
    Integrators,
    #[command(flatten)]
    Bench(bench::Bench),
}

#[derive(Args)]
struct SceneArguments {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Folder for the results; created if it does not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Override a key, such as cable.sling.elements=20; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Choose elements and integrator so that no position is off by more than this, in m, and prove it by runs with several meshes;
    /// or no tension or moment at ends and held and loaded points (tension=1%, tension=50N, moment=5%, moment=2Nm)
    #[arg(long, value_name = "METRES|QUANTITY=AMOUNT")]
    error: Option<Target>,
    /// Tell warnings up to this level: setup (not what is meant), wrong (a result that is off) or coarse (mesh and steps). Default:
    /// coarse, of cables with fidelity game wrong
    #[arg(long, value_name = "LEVEL")]
    warn: Option<Level>,
    /// Write DIR/run.svg, the motion as an animated picture for a page or a README, too
    #[arg(long)]
    svg: bool,
    /// Write DIR/run.usda, the motion as OpenUSD, too
    #[arg(long)]
    usd: bool,
}

#[derive(Args)]
struct RunArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Start from the equilibrium that `lariat static` of the same scene wrote to this folder
    #[arg(long, value_name = "DIR", conflicts_with = "error")]
    from: Option<PathBuf>,
}

/// Runs the command with its arguments, of which the first is the name of the program, and returns
/// its exit code; it writes to the standard output and the standard error, and handles Ctrl-C.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    let outcome = match cli.command {
        Command::Run(arguments) => run_scene(&arguments).map(|summary| describe::run(&summary, &arguments.scene.out)),
        Command::Static(arguments) => {
            find_static(&arguments).map(|summary| describe::statics(&summary, &arguments.out))
        }
        Command::Import { model, out } => import(&model, out.as_deref()),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Keys { into: Some(file), .. } => keys::update(&file),
        Command::Keys { key, into: None } => keys::print(key.as_deref()),
        Command::Rules => Ok(tables::rules()),
        Command::Integrators => Ok(tables::integrators()),
        Command::Bench(bench) => return bench::run(&bench),
    };
    match outcome {
        Ok(text) => {
            // a closed pipe is not a failure of the run
            let _ = io::stdout().write_all(text.as_bytes());
            0
        }
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            error.exit_code()
        }
    }
}

/// Returns a flag that Ctrl-C sets; the second one ends the process at once.
fn stopped_by_ctrl_c() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    let handler = ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    if let Err(error) = handler {
        let _ = writeln!(io::stderr(), "warning: Ctrl-C will leave no summary: {error}");
    }
    stop
}

fn run_scene(RunArguments { scene: arguments, from }: &RunArguments) -> Result<Summary, Error> {
    let purpose = if from.is_some() { Purpose::Resume } else { Purpose::Run };
    let scene = Scene::read(&arguments.scene, &arguments.set, purpose)?;
    // a run removes what the last one wrote to its folder
    let same = |folder: &PathBuf| folder.canonicalize().ok() == arguments.out.canonicalize().ok();
    if from.as_ref().is_some_and(same) {
        let source =
            io::Error::new(io::ErrorKind::InvalidInput, "it holds the state to start from: give another folder");
        return Err(Error::Output { path: arguments.out.clone(), source });
    }
    let from = from.as_deref().map(State::read).transpose()?;
    let stop = stopped_by_ctrl_c();
    let bar = RefCell::new(progress::Bar::new(scene.duration));
    let mut report = |time: f64| bar.borrow_mut().advance(time);
    let mut pilot = |resolution: &Resolution| bar.borrow_mut().begin_run(resolution);
    let mut options = Options {
        stop,
        progress: Some(&mut report),
        warn: Some(&mut warn),
        warn_level: arguments.warn,
        error: arguments.error,
        pilot: Some(&mut pilot),
        svg: arguments.svg,
        usd: arguments.usd,
        from,
    };
    let outcome = run::run(&scene, &arguments.out, &mut options);
    bar.borrow().finish();
    outcome
}

fn find_static(arguments: &SceneArguments) -> Result<Summary, Error> {
    let scene = Scene::read(&arguments.scene, &arguments.set, Purpose::Static)?;
    let mut bar = progress::Bar::new(0.0);
    let mut pilot = |resolution: &Resolution| bar.begin_run(resolution);
    let mut options = Options {
        warn: Some(&mut warn),
        warn_level: arguments.warn,
        error: arguments.error,
        pilot: Some(&mut pilot),
        svg: arguments.svg,
        usd: arguments.usd,
        ..Options::default()
    };
    run::statics(&scene, &arguments.out, &mut options)
}

fn import(model: &Path, out: Option<&Path>) -> Result<String, Error> {
    let text = crate::read_text(model)?;
    let import = crate::mjcf::read(&model.display().to_string(), &text)?;
    for note in &import.notes {
        warn(&note.to_string());
    }
    let Some(out) = out else { return Ok(import.scene) };
    crate::signed::write(out, &import.scene, Comment::HASH)?;
    Ok(format!("scene: {}\n", out.display()))
}

fn warn(warning: &str) {
    let _ = writeln!(io::stderr(), "warning: {warning}");
}
