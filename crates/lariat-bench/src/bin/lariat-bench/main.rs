//! `lariat report`, `lariat stability` and `lariat table1`; the `lariat` command of lariat-scene starts this program for them.

mod progress;
mod stability;

use clap::{Parser, Subcommand};
use lariat_bench::{Error, report, table1};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "lariat", version, about = "Accuracy against cost, hard cases, and the paper's Table 1, measured")]
#[command(after_help = "Exit codes: 0 done; 2 bad input, nothing written; 3 the measurement failed")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run the hard cases on all hosts, beside what Rapier offers: DIR/stability.md and DIR/stability.csv
    Stability(stability::Arguments),
    /// Measure Table 1 of the paper: accuracy and cost of the force strategies
    Table1 {
        /// Write the table as CSV too
        #[arg(long, value_name = "FILE")]
        csv: Option<PathBuf>,
    },
    /// Measure accuracy against cost: README.md, index.html, *.csv and *.svg in DIR; some minutes
    Report {
        /// Folder for the report; made if it is not there
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// Coarse settings and few runs: below a minute
        #[arg(long)]
        quick: bool,
        /// Put the tables that a README shows between their marks in this file too
        #[arg(long, value_name = "FILE")]
        readme: Option<PathBuf>,
    },
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        Command::Stability(arguments) => stability::measure(&arguments),
        Command::Table1 { csv } => measure_table1(csv),
        Command::Report { out, quick, readme } => make_report(&out, quick, readme),
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

fn make_report(out: &Path, quick: bool, readme: Option<PathBuf>) -> Result<String, Error> {
    let options = if quick { report::Options::quick() } else { report::Options::full() };
    let spinner = progress::Spinner::new();
    let outcome = report::run(out, options, &mut |what| spinner.tell(what));
    spinner.finish();
    let report = outcome?;
    if let Some(readme) = readme {
        report::update_readme(&report, &readme)?;
    }
    Ok(format!("{:.0} s; open {}\n", report.seconds, out.join("index.html").display()))
}

fn measure_table1(csv: Option<PathBuf>) -> Result<String, Error> {
    // a file that cannot be written is known before the measurement, not after
    let failed = |path: &PathBuf, source| Error::Output { path: path.clone(), source };
    let file =
        csv.as_ref().map(|path| std::fs::File::create(path).map_err(|source| failed(path, source))).transpose()?;
    let table = table1::measure(3)?;
    if let (Some(path), Some(mut file)) = (&csv, file) {
        file.write_all(table.to_csv().as_bytes()).map_err(|source| failed(path, source))?;
    }
    Ok(table.to_text())
}
