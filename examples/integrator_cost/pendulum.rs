//! The paper's pendulum, three others, their reference solutions, and the mesh.

use crate::Outcome;
use crate::measure::{Reading, Row, readings, run, table};
use lariat::{At, Cable, Integrator, Method, NewtonMode, Rule, Section, StepControl, Vector3};
use std::fmt;
use std::fmt::Write as _;

/// Host step in s and host steps: 2 s.
const HOST: f64 = 0.01;
const STEPS: usize = 200;
/// Runs for the clock; of the default integrator, which the targets are about, more.
const REPEATS: usize = 7;
const REPEATS_DEFAULT: usize = 25;
/// Tolerances in m per host step, coarse to fine.
const LADDER: [f64; 9] = [1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9];

/// A pendulum of square section: released from horizontal at rest, its first end held, slope free.
#[derive(Clone, Copy)]
pub struct Pendulum {
    pub length: f64,
    pub side: f64,
    pub modulus: f64,
}

/// The pendulum of Bulin & Hajzman.
pub const PAPER: Pendulum = Pendulum { length: 2.0, side: 0.01, modulus: 1.0e8 };

/// What a tolerance is carried to unchanged.
const OTHERS: [(&str, Pendulum); 4] = [
    ("the paper's", PAPER),
    ("E x 10", Pendulum { modulus: 1.0e9, ..PAPER }),
    ("side 5 mm", Pendulum { side: 0.005, ..PAPER }),
    ("3 m, E x 3", Pendulum { length: 3.0, modulus: 3.0e8, ..PAPER }),
];

impl fmt::Display for Pendulum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} m, square of {} m, E = {:.0e} Pa, 4000 kg/m^3", self.length, self.side, self.modulus)
    }
}

impl Pendulum {
    pub fn cable(&self, elements: usize, rule: Rule, integrator: Integrator) -> Outcome<Cable> {
        let section = Section::square(self.side, self.modulus, 4000.0)?;
        let points = [Vector3::zeros(), Vector3::new(self.length, 0.0, 0.0)];
        let builder = Cable::builder().points(points).section(section).elements(elements).fix(At::Start);
        Ok(builder.rule(rule).integrator(integrator).build()?)
    }
}

fn stable(share: f64) -> Integrator {
    Integrator { method: Method::Rkn6, control: StepControl::Stable(share) }
}

/// The solution that is exact in time: Runge-Kutta-Nystrom of order 6 at a share of its stable step.
pub fn exact(pendulum: &Pendulum, share: f64) -> Outcome<Vec<Reading>> {
    readings(&mut pendulum.cable(10, Rule::default(), stable(share))?, HOST, STEPS)
}

fn distance<'a>(a: impl IntoIterator<Item = &'a Reading>, b: impl IntoIterator<Item = Vector3<f64>>) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a.tip - b).norm()).fold(0.0, f64::max)
}

/// Three columns of a reference file, by time, the start left out.
fn column(file: &str, names: [&str; 3]) -> Outcome<Vec<Vector3<f64>>> {
    let text = std::fs::read_to_string(format!("{}/assets/reference/{file}", env!("CARGO_MANIFEST_DIR")))?;
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().ok_or("empty file")?.split(',').collect();
    let index = |name| header.iter().position(|h| *h == name).ok_or(format!("{file}: no column {name}"));
    let [x, y, z] = [index(names[0])?, index(names[1])?, index(names[2])?];
    let rows = lines.skip(1).map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        Ok(Vector3::new(fields[x].parse()?, fields[y].parse()?, fields[z].parse()?))
    });
    let rows: Vec<Vector3<f64>> = rows.collect::<Outcome<_>>()?;
    if rows.len() == STEPS { Ok(rows) } else { Err(format!("{file}: {} rows, expected {STEPS}", rows.len()).into()) }
}

/// How good the solution is that is taken as exact in time.
pub fn proof(fine: &[Reading]) -> Outcome<String> {
    let own = distance(&exact(&PAPER, 0.5)?, fine.iter().map(|r| r.tip));
    let outside = column("pendulum_G10-10_10el.csv", ["tip_x", "tip_y", "tip_z"])?;
    let mut far = Vec::new();
    for rule in ["G10-10", "G5-5"] {
        let readings = readings(&mut PAPER.cable(10, rule.parse()?, stable(0.25))?, HOST, STEPS)?;
        far.push(distance(&readings, outside.iter().copied()));
    }
    Ok(format!(
        "Exact in time: rkn6 at 0.25 of its stable step. At twice that step it differs from itself by {own:.1e} m; with rule G10-10 \
         it is within {:.1e} m of `assets/reference/pendulum_G10-10_10el.csv`, which an independent solver made, and with G5-5 \
         within {:.1e} m.\n",
        far[0], far[1]
    ))
}

fn controls(method: Method) -> Vec<StepControl> {
    let properties = method.properties();
    let once = matches!(method, Method::GeneralisedAlpha { newton: NewtonMode::Once, .. });
    if !properties.implicit {
        [0.95, 0.5, 0.25].map(StepControl::Stable).to_vec()
    } else if once || properties.estimate_order.is_none() {
        [4, 8, 16, 32, 64, 128].map(StepControl::Substeps).to_vec()
    } else {
        LADDER.map(StepControl::Tolerance).to_vec()
    }
}

/// Every method down its ladder: name, whether implicit, runs.
pub fn every_integrator(exact: &[Reading]) -> Outcome<Vec<(String, bool, Vec<Row>)>> {
    let cable = PAPER.cable(10, Rule::default(), Integrator::default())?;
    let ladder = |method: Method| {
        let repeats = if method == Integrator::default().method { REPEATS_DEFAULT } else { REPEATS };
        let rows = controls(method).into_iter();
        let rows = rows.map(|control| run(&cable, Integrator { method, control }, HOST, exact, repeats));
        Ok((method.to_string(), method.properties().implicit, rows.collect::<Outcome<_>>()?))
    };
    Method::ALL.into_iter().map(ladder).collect()
}

/// Errors against the real beam with a number of elements.
pub struct Mesh {
    pub elements: usize,
    pub default_rule: f64,
    paper_rule: f64,
    milliseconds: f64,
}

/// The default rule and the paper's G5-5 against the real beam, both exact in time; and the time of the default integrator.
pub fn mesh() -> Outcome<Vec<Mesh>> {
    let beam = column("pendulum_converged_tip.csv", ["x_rich", "y_rich", "z_rich"])?;
    let one = |elements: usize| {
        let error = |rule: Rule| -> Outcome<f64> {
            let readings = readings(&mut PAPER.cable(elements, rule, stable(0.5))?, HOST, STEPS)?;
            Ok(distance(&readings, beam.iter().copied()))
        };
        let cable = PAPER.cable(elements, Rule::default(), Integrator::default())?;
        let nowhere = vec![Reading { tip: Vector3::zeros(), tension: 0.0, kinetic: 0.0 }; STEPS];
        let milliseconds = run(&cable, Integrator::default(), HOST, &nowhere, REPEATS)?.milliseconds;
        let (default_rule, paper_rule) = (error(Rule::default())?, error("G5-5".parse()?)?);
        Ok(Mesh { elements, default_rule, paper_rule, milliseconds })
    };
    [10, 12, 14, 15, 16, 20, 40].into_iter().map(one).collect()
}

/// The mesh as a section of the report.
pub fn mesh_table(mesh: &[Mesh]) -> Outcome<String> {
    let mut out = format!(
        "\n## The mesh\n\nThe paper's pendulum against the real beam (`assets/reference/pendulum_converged_tip.csv`), rules exact in \
         time; time of the default integrator at its default tolerance, {} rule.\n\n\
         | elements | {} m | G5-5 m | time ms |\n|---:|---:|---:|---:|\n",
        Rule::default(),
        Rule::default()
    );
    for m in mesh {
        writeln!(out, "| {} | {:.1e} | {:.1e} | {:.2} |", m.elements, m.default_rule, m.paper_rule, m.milliseconds)?;
    }
    Ok(out)
}

/// The default integrator on pendulums it was not chosen on.
pub fn others() -> Outcome<String> {
    let method = Integrator::default().method;
    let mut out = format!(
        "\n## Tolerances carried to other pendulums\n\n{method}, 10 elements, host step 0.01 s, 2 s, each against its own solution \
         exact in time (rkn6 at 0.25 of the stable step). *Per tolerance* is the tip error over the tolerance: {STEPS} \
         steps each allow themselves the tolerance once, and the motion stretches or shrinks what came before.\n\n"
    );
    for (name, pendulum) in OTHERS {
        let exact = exact(&pendulum, 0.25)?;
        let cable = pendulum.cable(10, Rule::default(), Integrator::default())?;
        let settings = [1e-5, 1e-6, 1e-7, 1e-8];
        let rows = settings.map(|tolerance| {
            run(&cable, Integrator { method, control: StepControl::Tolerance(tolerance) }, HOST, &exact, REPEATS)
        });
        let rows = rows.into_iter().collect::<Outcome<Vec<Row>>>()?;
        let ratios = rows.iter().zip(settings).map(|(r, t)| format!("{:.0}", r.error / t)).collect::<Vec<_>>();
        write!(out, "**{name}** ({pendulum}). Per tolerance: {}.\n\n{}\n", ratios.join(", "), table(&rows))?;
    }
    Ok(out)
}
