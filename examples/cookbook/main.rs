//! The recipes of docs/cookbook.md: runs each, checks it, and measures its cost per host step.
//!
//! `cargo run --release --example cookbook` prints results and the table; with `-- --only lamps` those of one; with
//! `-- --out docs/cookbook.md` code and table go between their marks on the page.

mod recipes;

use cpu_time::ProcessTime;
use lariat_bench::machine;
use recipes::{ALL, Outcome, Recipe};
use std::fmt::Write as _;

/// Runs whose fastest counts.
const RUNS: usize = 3;

/// CPU time per host step in us: the mean, and that of the slowest of a hundred, over a run; the least of several runs.
fn cost(recipe: &Recipe) -> Outcome<(f64, f64, String)> {
    let (mut mean, mut slow, mut result) = (f64::INFINITY, f64::INFINITY, String::new());
    for _ in 0..RUNS {
        let mut stage = (recipe.build)()?;
        let mut times = Vec::new();
        for _ in 0..recipe.steps {
            let clock = ProcessTime::now();
            stage.step()?;
            times.push(clock.elapsed().as_secs_f64() * 1e6);
        }
        result = stage.check()?;
        mean = mean.min(times.iter().sum::<f64>() / times.len() as f64);
        times.sort_by(f64::total_cmp);
        slow = slow.min(times[times.len() - 1 - times.len() / 100]);
    }
    Ok((mean, slow, result))
}

/// Replaces what stands between `<!-- name -->` and `<!-- /name -->`.
fn replace(page: &str, name: &str, new: &str) -> Outcome<String> {
    let (open, close) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let parts = page.split_once(&open).and_then(|(before, rest)| Some((before, rest.split_once(&close)?.1)));
    let (before, after) = parts.ok_or_else(|| format!("no <!-- {name} --> ... <!-- /{name} --> on the page"))?;
    Ok(format!("{before}{open}{new}{close}{after}"))
}

fn main() -> Outcome<()> {
    let (mut file, mut only) = (None, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(flag) = arguments.next() {
        match (flag.as_str(), arguments.next()) {
            ("--out", Some(value)) => file = Some(value),
            ("--only", Some(value)) => only = Some(value),
            _ => return Err("usage: cookbook [--out docs/cookbook.md | --only RECIPE]".into()),
        }
    }
    let machine = machine::line();
    let mut table = String::from(
        "| recipe | cables x elements | bodies | integrator | budget us | us per host step | slowest 1 % |\n|---|---|---:|---|---:|---:|---:|\n",
    );
    for recipe in ALL.iter().filter(|recipe| only.as_deref().is_none_or(|name| name == recipe.name)) {
        let (mean, slow, result) = cost(recipe)?;
        println!("{:<9} {mean:8.1} us, slowest 1 % {slow:8.1} us; {result}", recipe.name);
        writeln!(table, "{} {mean:.0} | {slow:.0} |", recipe.row())?;
    }
    let (Some(file), None) = (file, only) else { return Ok(()) };
    let mut page = replace(&std::fs::read_to_string(&file)?, "cost", &format!("{table}\n{machine}\n"))?;
    for recipe in &ALL {
        page = replace(&page, recipe.name, &format!("```rust,ignore\n{}\n```\n", recipe.shown()))?;
    }
    Ok(std::fs::write(file, page)?)
}
