//! `lariat matrix`: every pair of features, in parallel on all cores.

use indicatif::ProgressBar;
use lariat_bench::matrix::feature::{Feature, Pair};
use lariat_bench::matrix::page;
use lariat_bench::matrix::run::{Row, run};
use lariat_bench::{Error, machine};
use rayon::prelude::*;
use std::path::PathBuf;

/// What to run.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder for matrix.md and its CSV files; created if it does not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only pairs with this feature; given twice, that pair
    #[arg(long, value_name = "NAME")]
    feature: Vec<Feature>,
}

/// Runs the pairs and writes the page and its files.
pub fn measure(arguments: &Arguments) -> Result<String, Error> {
    let Arguments { out, feature } = arguments;
    lariat_bench::page::create_folder(out, "matrix.md", "Every pair of features")?;
    let pairs: Vec<Pair> = Pair::all().into_iter().filter(|pair| feature.iter().all(|f| pair.has(*f))).collect();
    let bar = ProgressBar::new(pairs.len() as u64);
    // a panic is an outcome, and the page tells it
    std::panic::set_hook(Box::new(|_| {}));
    let one = |pair: &Pair| {
        let row = run(*pair);
        if !row.outcome.is_good() {
            bar.suspend(|| eprintln!("{pair}: {}: {}", row.outcome.name(), row.outcome.details()));
        }
        bar.inc(1);
        row
    };
    let rows: Vec<Row> = pairs.par_iter().map(one).collect();
    bar.finish_and_clear();
    let _ = std::panic::take_hook();
    let mut command = "cargo run --release --bin lariat -- matrix --out DIR".to_string();
    feature.iter().for_each(|feature| command += &format!(" --feature {:?}", feature.name()));
    let (markdown, sections) = page::page(&rows, &machine::line(), &command);
    lariat_bench::page::write(&out.join("matrix.md"), &markdown)?;
    sections.iter().try_for_each(|section| section.save(out))?;
    let good = rows.iter().filter(|row| row.outcome.is_good()).count();
    Ok(format!(
        "{good} of {} pairs are right, excluded for a reason, or tell what they miss\nresults in {}\n",
        rows.len(),
        out.display()
    ))
}
