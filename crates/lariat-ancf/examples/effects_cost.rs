//! What effects cost, as a table: ns per element of force, force with tangent, and a whole implicit step; bare, each effect alone, all.
//!
//! `cargo run --release -p lariat-ancf --example effects_cost -- docs/effects.md` writes the table to a file; without an argument it is
//! printed. One cable of 64 elements, one thread, the trapezoidal rule. For instructions instead of time see `bare_steps`.

use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Flow, GravityScale, Integrator, LineLoad, Method, RestShape, Rule,
    Section, Vector3,
};
use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Step in s: so short that Newton ends after one iteration with a fresh tangent, or a second with the same factors.
const STEP: f64 = 1e-7;
const ELEMENTS: usize = 64;
/// Calls from one reading of the clock to the next, and readings, of which the least counts.
const CALLS: usize = 64;
const READINGS: usize = 300;

fn cases() -> Vec<(&'static str, &'static str, Effects)> {
    let flow = Flow::uniform(Vector3::new(1.0, 0.0, 0.2));
    let wind = Flow::power_law(Vector3::new(1.0, 0.0, 0.2), Vector3::y(), 10.0, 0.14, 100.0);
    let damping = |axial, bending| Effects { damping: Some(Damping { axial, bending }), ..Effects::default() };
    let drag = |flow| Effects { drag: Some(Drag::new(1000.0, 1.2, 0.01, flow)), ..Effects::default() };
    let rest = |rest| Effects { rest_shape: Some(rest), ..Effects::default() };
    let buoyancy = Effects { buoyancy: Some(Buoyancy::new(1000.0, 1.0)), ..Effects::default() };
    let constant = Effects {
        line_loads: vec![LineLoad::uniform(Vector3::x())],
        gravity_scale: GravityScale(0.5),
        ..Effects::default()
    };
    let all = Effects {
        damping: Some(Damping { axial: 1e-3, bending: 1e-3 }),
        drag: Some(Drag::new(1000.0, 1.2, 0.01, flow.clone())),
        rest_shape: Some(RestShape::curved(0.1)),
        buoyancy: Some(Buoyancy::new(1000.0, 1.0)),
        ..constant.clone()
    };
    vec![
        ("limp: no bending", "projected-none", Effects::default()),
        ("bare", "projected-3", Effects::default()),
        ("damping, axial", "projected-3", damping(1e-3, 0.0)),
        ("damping, axial and bending", "projected-3", damping(1e-3, 1e-3)),
        ("drag", "projected-3", drag(flow)),
        ("drag, power-law wind", "projected-3", drag(wind)),
        ("buoyancy", "projected-3", buoyancy),
        ("rest shape: stretch", "projected-3", rest(RestShape::stretched(0.999))),
        ("rest shape: curvature", "projected-3", rest(RestShape::curved(0.1))),
        ("line load, gravity scale", "projected-3", constant),
        ("all", "projected-3", all),
    ]
}

/// A soft cable, bent and moving.
fn cable(rule: &str, effects: Effects) -> Outcome<Cable> {
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let builder = Cable::builder().points(points).section(Section::round(0.01, 1.0e8, 4000.0)?).elements(ELEMENTS);
    let mut cable = builder.fix(At::Start).rule(rule.parse::<Rule>()?).build()?;
    cable.step(0.05)?;
    cable.set_effects(effects)?;
    cable.set_integrator(Integrator::substeps(Method::Trapezoid, 1)?)?;
    cable.step(STEP)?;
    Ok(cable)
}

/// The least ns per element of many readings, each from the same state.
fn least(cable: &mut Cable, mut call: impl FnMut(&mut Cable) -> Outcome<()>) -> Outcome<f64> {
    let state = cable.state().clone();
    let mut best = f64::INFINITY;
    for _ in 0..READINGS {
        cable.restore(state.clone())?;
        let clock = Instant::now();
        for _ in 0..CALLS {
            call(cable)?;
        }
        best = best.min(clock.elapsed().as_secs_f64() * 1e9);
    }
    Ok(best / (CALLS * ELEMENTS) as f64)
}

fn main() -> Outcome<()> {
    let mut table = String::from(
        "# What effects cost\n\nMade by `cargo run --release -p lariat-ancf --example effects_cost -- docs/effects.md`; do not edit. \
         ns per element, one thread, the least of many readings; 64 elements, trapezoidal rule; *Newton* is iterations per step, of \
         which one has a fresh tangent.\n\n| effects | force | force + tangent | implicit step | Newton |\n|---|---:|---:|---:|---:|\n",
    );
    for (name, rule, effects) in cases() {
        let mut cable = cable(rule, effects)?;
        let mut f = vec![0.0; cable.positions().len()];
        let force = least(&mut cable, |cable| {
            cable.evaluate(black_box(&mut f));
            Ok(())
        })?;
        let tangent = least(&mut cable, |cable| {
            black_box(cable.evaluate_with_stiffness(black_box(&mut f)));
            Ok(())
        })?;
        cable.diagnostics_mut().reset();
        let step = least(&mut cable, |cable| Ok(cable.step(black_box(STEP))?))?;
        let d = cable.diagnostics();
        let newton = d.newton_iterations as f64 / d.steps as f64;
        writeln!(table, "| {name} | {force:.0} | {tangent:.0} | {step:.0} | {newton:.1} |")?;
    }
    match std::env::args().nth(1) {
        None => print!("{table}"),
        Some(path) => std::fs::write(path, table)?,
    }
    Ok(())
}
