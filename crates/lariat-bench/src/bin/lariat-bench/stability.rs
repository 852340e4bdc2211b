//! `lariat stability`: the hard cases, in parallel on all cores.

use indicatif::ProgressBar;
use lariat_bench::stability::family::Family;
use lariat_bench::stability::host::CableModel;
use lariat_bench::stability::job::{Job, Selection, jobs, names, run_all};
use lariat_bench::stability::misses::run_name;
use lariat_bench::stability::outcome::Row;
use lariat_bench::stability::page;
use lariat_bench::{Error, machine};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What to run.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for the results; created if it does not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// One host per case, as `cargo test` does
    #[arg(long)]
    quick: bool,
    /// Begin no run after this time; the page says how many are missing
    #[arg(long, value_name = "MINUTES", default_value_t = 60.0)]
    minutes: f64,
    /// Only this family; may be given many times
    #[arg(long, value_name = "NAME")]
    family: Vec<Family>,
    /// Only cases whose name contains this text; may be given many times
    #[arg(long, value_name = "TEXT")]
    case: Vec<String>,
}

impl Arguments {
    /// Returns the command that asks for the same, as the page prints it.
    fn command(&self, complete: bool) -> String {
        let mut command = "cargo run --release --bin lariat -- stability --out DIR".to_string();
        if self.quick {
            command += " --quick";
        }
        if !complete {
            command += &format!(" --minutes {}", self.minutes);
        }
        self.family.iter().for_each(|family| command += &format!(" --family {}", family.name()));
        self.case.iter().for_each(|case| command += &format!(" --case {case:?}"));
        command
    }
}

/// Runs the cases and writes the page and its files.
pub fn measure(arguments: &Arguments) -> Result<String, Error> {
    let out = &arguments.out;
    lariat_bench::page::create_folder(out, "stability.md", "Hard cases")?;
    let families = if arguments.family.is_empty() { Family::ALL.to_vec() } else { arguments.family.clone() };
    let selected = |selection| families.iter().flat_map(move |family| jobs(*family, selection));
    let names: BTreeMap<_, _> = families.iter().map(|family| (*family, names(*family))).collect();
    let wanted = |job: &Job| {
        let name = names.get(&job.family).and_then(|names| names.get(job.case));
        arguments.case.is_empty() || name.is_some_and(|name| arguments.case.iter().any(|text| name.contains(text)))
    };
    let first: Vec<Job> = selected(Selection::Quick).collect();
    let selection = if arguments.quick { Selection::Quick } else { Selection::Full };
    let jobs: Vec<Job> = selected(selection).filter(wanted).collect();
    let bar = ProgressBar::new(jobs.len() as u64);
    let done = |row: &Row| {
        if !row.outcome.is_good() && row.model == CableModel::Lariat {
            let (name, outcome) = (run_name(row), &row.outcome);
            let share = 100.0 * row.completed;
            bar.suspend(|| eprintln!("{name}: {}, {share:.0} % done: {}", outcome.name(), outcome.details()));
        }
        bar.inc(1);
    };
    // a panic is an outcome, and the page tells it
    std::panic::set_hook(Box::new(|_| {}));
    let begun = Instant::now();
    let limit = Duration::from_secs_f64(60.0 * arguments.minutes.clamp(0.0, 1e6));
    let rows = run_all(&jobs, &first, limit, &done);
    bar.finish_and_clear();
    let _ = std::panic::take_hook();
    let cpu: f64 = rows.iter().map(|r| r.seconds).sum();
    let machine = format!(
        "{} {} of {} runs were begun in time, and took {:.0} s, {cpu:.0} s of CPU time.",
        machine::line(),
        rows.len(),
        jobs.len(),
        begun.elapsed().as_secs_f64()
    );
    let (markdown, sections) = page::page(&rows, &machine, &arguments.command(rows.len() == jobs.len()))?;
    // `.ci/judge` writes its table into the page
    let judged = ["<!-- judged -->", "<!-- /judged -->"];
    lariat_bench::page::write_around(&out.join("stability.md"), &markdown, judged)?;
    sections.iter().try_for_each(|section| section.save(out))?;
    let good = rows.iter().filter(|r| r.outcome.is_good()).count();
    Ok(format!("{good} of {} runs passed or ended in an allowed error\nresults in {}\n", rows.len(), out.display()))
}
