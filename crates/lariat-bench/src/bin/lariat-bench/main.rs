//! `lariat report`, `lariat stability`, `lariat matrix`, `lariat coupling` and `lariat table1`: the
//! `lariat` command of lariat-scene starts this program.

mod matrix;
mod stability;

use clap::{Parser, Subcommand};
use lariat_bench::report::{self, Progress};
use lariat_bench::{Error, coupling, page, table1};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
#[command(
    name = "lariat",
    version,
    about = "Measures accuracy against cost, hard cases, pairs of features, the coupling, and the paper's Table 1"
)]
#[command(
    after_help = "Exit codes: 0 done; 2 bad input, nothing written; 3 a measurement failed, what was measured is written"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run the hard cases on all hosts, beside the ropes of Rapier: stability.md, stability.svg and
    /// two CSV files in DIR
    Stability(stability::Arguments),
    /// Run every pair of features on a small scene: matrix.md and CSV files in DIR; some minutes
    Matrix(matrix::Arguments),
    /// Measure the cost of a cable on a body, beside the ropes of Rapier; some minutes
    Coupling {
        /// The page; a CSV file of all runs is written beside it
        #[arg(long, value_name = "FILE")]
        out: PathBuf,
    },
    /// Measure Table 1 of the paper: accuracy and cost of the force strategies
    Table1 {
        /// Write the table as CSV too
        #[arg(long, value_name = "FILE")]
        csv: Option<PathBuf>,
    },
    /// Measure accuracy against cost: README.md, *.csv and *.svg in DIR; some minutes
    Report {
        /// Folder for the report; created if it does not exist
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// Measure the coarsest settings with few runs: below a minute
        #[arg(long)]
        quick: bool,
        /// Measure the errors of the scenes alone, which are counts, and replace that section of a page made before
        #[arg(long, conflicts_with_all = ["quick", "readme"])]
        claims: bool,
        /// Measure cables that touch alone, and replace that section of a page made before
        #[arg(long, conflicts_with_all = ["quick", "readme", "claims"])]
        contact: bool,
        /// Measure moments that are asked for, and kinks, alone, and replace that section of a page made before
        #[arg(long, conflicts_with_all = ["quick", "readme", "claims", "contact"])]
        forces: bool,
        /// Put the tables of a README between their marks in this file too
        #[arg(long, value_name = "FILE")]
        readme: Option<PathBuf>,
    },
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        Command::Stability(arguments) => stability::measure(&arguments),
        Command::Matrix(arguments) => matrix::measure(&arguments),
        Command::Coupling { out } => measure_coupling(&out),
        Command::Table1 { csv } => measure_table1(csv.as_deref()),
        Command::Report { out, claims: true, .. } => {
            report::renew(&out, || report::claims::section(&report::Options::full())).map(|()| String::new())
        }
        Command::Report { out, contact: true, .. } => {
            report::renew(&out, || report::contact::section(&report::Options::full())).map(|()| String::new())
        }
        Command::Report { out, forces: true, .. } => {
            report::renew(&out, || report::forces::section(&report::Options::full())).map(|()| String::new())
        }
        Command::Report { out, quick, readme, .. } => make_report(&out, quick, readme.as_deref()),
    };
    match outcome {
        Ok(text) => {
            // a closed pipe is no failure of the measurement
            let _ = io::stdout().write_all(text.as_bytes());
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn make_report(out: &Path, quick: bool, readme: Option<&Path>) -> Result<String, Error> {
    let options = if quick { report::Options::quick() } else { report::Options::full() };
    let report = report::run(out, &options, &mut |progress| match progress {
        Progress::Begun(title) => eprint!("{title} ... "),
        Progress::Done(seconds) => eprintln!("{seconds:.1} s"),
        Progress::Failed(reason) => eprintln!("failed: {reason}"),
    })?;
    if let Some(readme) = readme {
        report::readme::update(&report, readme)?;
    }
    report.check()?;
    Ok(format!("{:.0} s; open {}\n", report.seconds, out.join("README.md").display()))
}

fn measure_coupling(out: &Path) -> Result<String, Error> {
    // a file that cannot be written is known before the measurement
    let table = out.with_extension("csv");
    if !page::has_title(out, "The cost of a cable on a body")? && table.exists() {
        return Err(lariat_scene::Error::InTheWay { path: table }.into());
    }
    page::write(out, "")?;
    let (text, table) = coupling::measure(&mut |line| eprintln!("{line}"))?;
    page::write(out, &text)?;
    page::write(&out.with_extension("csv"), &table.csv())?;
    Ok(format!("results in {}\n", out.display()))
}

fn measure_table1(csv: Option<&Path>) -> Result<String, Error> {
    if let Some(path) = csv {
        if path.exists() {
            return Err(lariat_scene::Error::InTheWay { path: path.to_path_buf() }.into());
        }
        page::write(path, "")?;
    }
    let table = table1::measure(3)?;
    if let Some(path) = csv {
        page::write(path, &table.table().csv())?;
    }
    Ok(table.text())
}
