//! `lariat sweep`: runs of a scene over a grid of values.

use crate::Error;
use crate::sweep::{self, Row, Source, Store};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;

#[derive(Args)]
pub struct SweepArguments {
    /// Scene file (TOML)
    scene: PathBuf,
    /// Folder for the results; what is done there is not run again
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Values of a key, such as cable.sling.elements=10,20; may be repeated: all combinations are
    /// run
    #[arg(long, value_name = "KEY=A,B,C", required = true)]
    vary: Vec<String>,
    /// Override a key in all runs
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// Runs the sweep, and returns what to print.
pub fn run(arguments: &SweepArguments) -> Result<String, Error> {
    let file = arguments.scene.display().to_string();
    let text = crate::read_text(&arguments.scene)?;
    let source = Source { file: &file, text: &text };
    let points = sweep::grid(&arguments.vary)?;
    let points: Vec<Vec<String>> = points.into_iter().map(|point| [&arguments.set[..], &point].concat()).collect();
    source.check(&points)?;
    let store = Store::open(&arguments.out, &source)?;
    let stop = super::stopped_by_ctrl_c();
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg} (ETA {eta})");
    let bar = ProgressBar::new(points.len() as u64);
    if let Ok(style) = style {
        bar.set_style(style);
    }
    let each = |row: &Row, _: bool| {
        if let Some(error) = &row.error {
            bar.println(format!("failed: {}: {error}", row.settings.join(" ")));
        }
        bar.inc(1);
    };
    let rows = sweep::sweep(&source, &points, Some(&store), &stop, &each)?;
    bar.finish_and_clear();
    let failed = rows.iter().filter(|row| row.error.is_some()).count();
    let known = points.iter().filter(|point| store.done(point).is_some()).count();
    drop(store);
    let table = sweep::write_table(&arguments.out, &rows)?;
    let missing = points.len() - rows.len();
    let mut text =
        format!("{} runs: {failed} failed, {known} were done before\ntable: {}\n", rows.len(), table.display());
    if missing > 0 {
        text += &format!("interrupted: {missing} runs are missing; run the same command to continue\n");
    }
    Ok(text)
}
