//! `lariat stability`: the hard cases, side by side on all cores.

use indicatif::ProgressBar;
use lariat_bench::Error;
use lariat_bench::stability::outcome::Row;
use lariat_bench::stability::{Family, Job, jobs, names, quick_jobs, report, run_all};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

/// What to run.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for stability.md and stability.csv; made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// One host per case, as the tests do
    #[arg(long)]
    quick: bool,
    /// No run is begun after so many minutes; the report says how many are missing
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
    /// Whether a run is asked for.
    fn wants(&self, names: &BTreeMap<Family, Vec<String>>, job: &Job) -> bool {
        let name = names.get(&job.family).and_then(|names| names.get(job.case));
        self.case.is_empty() || name.is_some_and(|name| self.case.iter().any(|text| name.contains(text)))
    }
}

/// Runs them and writes the tables.
pub fn measure(arguments: &Arguments) -> Result<String, Error> {
    let out = &arguments.out;
    let failed = |source| Error::Output { path: out.clone(), source };
    std::fs::create_dir_all(out).map_err(failed)?;
    let families = if arguments.family.is_empty() { Family::ALL.to_vec() } else { arguments.family.clone() };
    let pick = if arguments.quick { quick_jobs } else { jobs };
    let names: BTreeMap<_, _> = families.iter().map(|family| (*family, names(*family))).collect();
    let jobs: Vec<_> =
        families.iter().flat_map(|family| pick(*family)).filter(|job| arguments.wants(&names, job)).collect();
    let first: Vec<_> = families.iter().flat_map(|family| quick_jobs(*family)).collect();
    let bar = ProgressBar::new(jobs.len() as u64);
    let done = |row: &Row| {
        if !row.outcome.is_kept() && row.make == lariat_bench::stability::host::Make::Lariat {
            bar.suspend(|| eprintln!("{}: {}: {}", report::key(row), row.outcome.word(), row.outcome.reason()));
        }
        bar.inc(1);
    };
    // a panic is an outcome, and is printed as one
    std::panic::set_hook(Box::new(|_| {}));
    let begun = std::time::Instant::now();
    let limit = Duration::from_secs_f64(60.0 * arguments.minutes.clamp(0.0, 1e6));
    let rows = run_all(&jobs, &first, limit, &done);
    bar.finish_and_clear();
    let _ = std::panic::take_hook();
    let mut command = "cargo run --release -p lariat-scene -- stability --out DIR".to_string();
    if arguments.quick {
        command += " --quick";
    }
    if rows.len() < jobs.len() {
        command += &format!(" --minutes {}", arguments.minutes);
    }
    for family in &arguments.family {
        command += &format!(" --family {}", family.name());
    }
    for case in &arguments.case {
        command += &format!(" --case {case:?}");
    }
    let cpu: f64 = rows.iter().map(|r| r.seconds).sum();
    let machine = format!(
        "{} {} of {} runs were begun in time, and took {:.0} s, {cpu:.0} s of CPU time.",
        lariat_bench::machine::line(),
        rows.len(),
        jobs.len(),
        begun.elapsed().as_secs_f64()
    );
    let markdown = report::markdown(&rows, &machine, &command);
    std::fs::write(out.join("stability.md"), markdown).map_err(failed)?;
    std::fs::write(out.join("stability.csv"), report::csv(&rows)).map_err(failed)?;
    let kept = rows.iter().filter(|r| r.outcome.is_kept()).count();
    Ok(format!("{kept} of {} runs held or were refused as they should\nresults in {}\n", rows.len(), out.display()))
}
