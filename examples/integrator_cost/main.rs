//! What accuracy costs: whole runs of falling cables with every integrator, error against time, as Markdown.
//!
//! `cargo run --release --example integrator_cost -- --out docs/cost.md --readme README.md`
//!
//! The measure of error is the largest 3D distance of the tip, at the host's steps, from the solution of the same elements that
//! is exact in time. Times are CPU time, the least of several runs, on one thread; what is timed is `Cable::step` and nothing else.

mod kernels;
#[path = "../common/machine.rs"]
mod machine;
mod measure;
mod pendulum;
mod readme;
mod steel;

use measure::Row;
use std::error::Error;
use std::fmt::Write as _;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The command that makes the report, printed in it.
const COMMAND: &str = "cargo run --release --example integrator_cost -- --out docs/cost.md --readme README.md";

/// Targets for the default integrator on the paper's pendulum: error in m, time in ms, and the time it is a share of.
const TARGETS: [(f64, f64, &str); 3] = [(5.4e-4, 107.0, "1/25"), (4.0e-5, 349.0, "1/40"), (8.0e-6, 603.0, "1/50")];
const SHARES: [f64; 3] = [25.0, 40.0, 50.0];

/// Time at which a ladder of settings reaches an error: log-log between neighbours in the order given.
fn time_at(rows: &[Row], error: f64) -> Option<f64> {
    let good = |r: &&Row| r.outcome.is_none();
    let direct = rows.iter().filter(good).filter(|r| r.error <= error).map(|r| r.milliseconds);
    let between = rows.windows(2).filter_map(|pair| {
        let [coarse, fine] = pair else { return None };
        if coarse.outcome.is_some() || fine.outcome.is_some() || coarse.error < error || fine.error > error {
            return None;
        }
        let share = (coarse.error / error).ln() / (coarse.error / fine.error).ln();
        Some((coarse.milliseconds.ln() + share * (fine.milliseconds / coarse.milliseconds).ln()).exp())
    });
    direct.chain(between).min_by(f64::total_cmp)
}

fn milliseconds(time: Option<f64>) -> String {
    time.map_or("not reached".to_string(), |t| format!("{t:.2} ms"))
}

fn summary(ladders: &[(String, bool, Vec<Row>)], mesh: &[pendulum::Mesh], kernels: &kernels::Costs) -> Outcome<String> {
    let rows_of = |name: &str| ladders.iter().find(|(n, ..)| n == name).map(|(.., rows)| rows.as_slice());
    let default = lariat::Integrator::default().method.to_string();
    let rows = rows_of(&default).ok_or("the default integrator is in the table")?;
    let mut out = String::from("| question | target | measured | |\n|---|---|---|---|\n");
    for ((error, peer, share), divisor) in TARGETS.into_iter().zip(SHARES) {
        let (limit, time) = (peer / divisor, time_at(rows, error));
        let verdict = if time.is_some_and(|t| t <= limit) { "met" } else { "missed" };
        writeln!(
            out,
            "| {default} to {error:.1e} m | {limit:.2} ms ({share} of {peer:.0}) | {} | {verdict} |",
            milliseconds(time)
        )?;
    }
    let implicit = time_at(rows, TARGETS[2].0);
    let explicit = ladders.iter().filter(|(_, implicit, _)| !implicit);
    let explicit = explicit.filter_map(|(name, _, rows)| Some((name, time_at(rows, TARGETS[2].0)?)));
    let best = explicit.min_by(|a, b| a.1.total_cmp(&b.1));
    writeln!(
        out,
        "| an explicit one to 8.0e-6 m | faster than {default}, {} | {} | {} |",
        milliseconds(implicit),
        best.map_or("none".to_string(), |(name, t)| format!("{name} {t:.2} ms")),
        if best.map(|b| b.1) < implicit && best.is_some() { "met" } else { "missed" },
    )?;
    let enough = mesh.iter().find(|m| m.default_rule <= 1e-3);
    writeln!(
        out,
        "| elements to 1e-3 m of the real beam, default rule | at most 16 | {} | {} |",
        enough.map_or("not reached".to_string(), |m| format!("{} ({:.1e} m)", m.elements, m.default_rule)),
        if enough.is_some_and(|m| m.elements <= 16) { "met" } else { "missed" },
    )?;
    for (what, limit, time) in
        [("force + exact tangent", 120.0, kernels.tangent), ("whole implicit step", 250.0, kernels.step)]
    {
        let verdict = if time <= limit { "met" } else { "missed" };
        writeln!(out, "| {what}, per element | {limit:.0} ns | {time:.0} ns | {verdict} |")?;
    }
    Ok(out)
}

fn main() -> Outcome<()> {
    let (mut file, mut readme) = (None, None);
    let mut arguments = std::env::args().skip(1);
    while let Some(flag) = arguments.next() {
        match (flag.as_str(), arguments.next()) {
            ("--out", Some(value)) => file = Some(value),
            ("--readme", Some(value)) => readme = Some(value),
            _ => return Err("usage: integrator_cost [--out FILE] [--readme FILE]".into()),
        }
    }
    let machine = machine::line();
    let paper = pendulum::PAPER;
    let exact = pendulum::exact(&paper, 0.25)?;
    let proof = pendulum::proof(&exact)?;
    let ladders = pendulum::every_integrator(&exact)?;
    let mesh = pendulum::mesh()?;
    let mut out = format!(
        "# What accuracy costs\n\nMade by `{COMMAND}`; do not edit. {machine}\n\n\
         *Time* is the CPU time of a whole run on one thread, the least of 7 runs or more (steel: 5). *Tip error* is the largest 3D distance of the tip, at \
         the host's steps, from the solution of the same elements that is exact in time. *Tolerance* is the position error in m \
         that the integrator allows itself per host step. *Newton* counts every iteration: with a fresh tangent (force, tangent, \
         factor, solve: as many as *factorisations*) or with kept factors (force and solve only; its forces are among *forces*). \
         *Forces* and *tangents* count elements. *Energy* is the change of the total over the run, which ought to be zero.\n\n\
         ## Summary\n\nThe pendulum of the paper, 10 elements; times are interpolated log-log in the ladders below. The targets are \
         shares of what Exudyn took for the same errors, with its best settings, on the machine where they were set (107, 349, 603 ms); \
         it was not run again here. Kernels: default rule, 64 elements.\n\n"
    );
    let levels = kernels::by_level()?;
    out += &summary(&ladders, &mesh, &levels.best)?;
    write!(out, "\n## Every integrator on the paper's pendulum\n\n{paper}, host step 0.01 s, 2 s.\n\n{proof}\n")?;
    out += &measure::table(ladders.iter().flat_map(|(.., rows)| rows));
    out += &kernels::report(&levels)?;
    out += &pendulum::mesh_table(&mesh)?;
    out += &pendulum::others()?;
    out += &steel::report()?;
    print!("{out}");
    if let Some(readme) = readme {
        readme::update(
            &readme,
            &machine,
            &levels.table,
            &ladders.iter().flat_map(|(.., rows)| rows).collect::<Vec<_>>(),
        )?;
    }
    if let Some(file) = file {
        std::fs::write(file, out)?;
    }
    Ok(())
}
