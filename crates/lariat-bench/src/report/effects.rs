//! What an element costs, and what each effect adds: force, force with exact tangent, a whole implicit step.
//!
//! One cable of 64 elements, bent and moving, one thread; the trapezoidal rule at a step so short that Newton ends after one iteration
//! with a fresh tangent, or a second with the same factors. Times are of bursts of calls from the same state; counts are exact and the
//! same on every machine. A flow of a program is sampled before each step, within its time.

use super::section::{Cell, Format, Section, Table, both, raw};
use super::{Bench, clock::Timing};
use crate::error::Error;
use cpu_time::ProcessTime;
use fearless_simd::Level;
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Effects, Flow, GravityScale, Integrator, LineLoad, Method, RestShape, Rule,
    Section as CrossSection, Vector3,
};
use std::hint::black_box;

/// Step in s.
const STEP: f64 = 1e-7;
const ELEMENTS: usize = 64;
/// Calls from one reading of the clock to the next.
const CALLS: usize = 64;

/// The case whose flow is read from a program at every node before the step.
const SAMPLED: &str = "drag, flow of a program";

/// Name, rule and effects of the cases.
fn cases() -> Vec<(&'static str, &'static str, Effects)> {
    let flow = Flow::uniform(Vector3::new(1.0, 0.0, 0.2));
    let wind = Flow::power_law(Vector3::new(1.0, 0.0, 0.2), Vector3::y(), 10.0, 0.14, 100.0);
    let damping = |axial, bending| Effects { damping: Some(Damping { axial, bending }), ..Effects::default() };
    let drag = |flow| Effects { drag: Some(Drag::new(1000.0, 1.2, 0.01, flow)), ..Effects::default() };
    let rest = |rest| Effects { rest_shape: Some(rest), ..Effects::default() };
    let buoyancy = Effects { buoyancy: Some(Buoyancy::new(1000.0, 1.0)), ..Effects::default() };
    let constant = Effects {
        line_loads: Some(LineLoad::uniform(Vector3::x()).into()),
        gravity_scale: Some(GravityScale(0.5)),
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
        ("bare, G5-3", "G5-3", Effects::default()),
        ("bare, ST2", "ST2", Effects::default()),
        ("bare, L2T2", "L2T2", Effects::default()),
        ("damping, axial", "projected-3", damping(1e-3, 0.0)),
        ("damping, axial and bending", "projected-3", damping(1e-3, 1e-3)),
        ("drag", "projected-3", drag(flow)),
        ("drag, power-law wind", "projected-3", drag(wind)),
        (SAMPLED, "projected-3", drag(Flow::default())),
        ("buoyancy", "projected-3", buoyancy),
        ("rest shape: stretch", "projected-3", rest(RestShape::stretched(0.999))),
        ("rest shape: curvature", "projected-3", rest(RestShape::curved(0.1))),
        ("line load, gravity scale", "projected-3", constant),
        ("all", "projected-3", all),
    ]
}

/// A soft cable, bent and moving.
fn cable(rule: &str, effects: Effects) -> Result<Cable, Error> {
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let builder = Cable::builder().points(points).section(CrossSection::round(0.01, 1.0e8, 4000.0)?).elements(ELEMENTS);
    let mut cable = builder.fix(At::Start).rule(rule.parse::<Rule>()?).build()?;
    cable.step(0.05)?;
    cable.set_effects(effects)?;
    cable.set_integrator(Integrator::substeps(Method::Trapezoid, 1)?)?;
    cable.step(STEP)?;
    Ok(cable)
}

/// ns per element of many readings, each from the same state.
fn time(
    bench: &Bench<'_>,
    cable: &mut Cable,
    mut call: impl FnMut(&mut Cable) -> Result<(), Error>,
) -> Result<Option<Timing>, Error> {
    let state = cable.snapshot().clone();
    let mut times = Vec::new();
    for _ in 0..bench.options.readings {
        cable.restore(state.clone())?;
        let clock = ProcessTime::now();
        for _ in 0..CALLS {
            call(cable)?;
        }
        times.push(clock.elapsed().as_secs_f64() * 1e9 / (CALLS * ELEMENTS) as f64);
    }
    Ok(Timing::of(times))
}

/// Times of force, force with tangent and step, and the counts of one step.
fn row(bench: &Bench<'_>, name: &str, cable: &mut Cable) -> Result<Vec<Cell>, Error> {
    let mut f = vec![0.0; cable.positions().len()];
    let force = time(bench, cable, |cable| {
        cable.evaluate(black_box(&mut f));
        Ok(())
    })?;
    let tangent = time(bench, cable, |cable| {
        black_box(cable.evaluate_with_stiffness(black_box(&mut f)));
        Ok(())
    })?;
    cable.diagnostics_mut().reset();
    let sampled = name == SAMPLED;
    let step = time(bench, cable, |cable| {
        if sampled {
            cable.sample_flow(|place| Vector3::new(1.0, 0.1 * place.x, 0.2))?;
        }
        Ok(cable.step(black_box(STEP))?)
    })?;
    let d = *cable.diagnostics();
    let per_step = |n: u64| Cell::from(n as f64 / d.steps.max(1) as f64);
    let mut row = vec![Cell::from(name), cable.rule().to_string().into()];
    for timing in [force, tangent, step] {
        let part = |part: fn(&Timing) -> f64| Cell::from(timing.as_ref().map(part));
        row.extend([part(|t| t.median), part(|t| t.least), part(|t| t.most)]);
    }
    row.extend([
        per_step(d.newton_iterations),
        per_step(d.factorisations),
        per_step(d.element_evaluations()),
        per_step(d.bending_evaluations),
        per_step(d.effects.damping),
        per_step(d.effects.drag),
        per_step(d.effects.rest_shape),
    ]);
    Ok(row)
}

fn table(name: &'static str, first: &'static str, rows: Vec<Vec<Cell>>) -> Table {
    let one = Format::Fixed(1);
    let columns = vec![
        both("case", first, Format::Plain),
        raw("rule"),
        both("force_ns", "force", one),
        raw("force_least_ns"),
        raw("force_most_ns"),
        both("tangent_ns", "force + tangent", one),
        raw("tangent_least_ns"),
        raw("tangent_most_ns"),
        both("step_ns", "implicit step", one),
        both("step_least_ns", "least", one),
        raw("step_most_ns"),
        both("newton_per_step", "Newton", one),
        both("factorisations_per_step", "factorisations", one),
        both("element_evaluations_per_step", "elements", one),
        both("bending_evaluations_per_step", "bending", one),
        both("damping_evaluations_per_step", "damping", one),
        both("drag_evaluations_per_step", "drag", one),
        both("rest_shape_evaluations_per_step", "rest shape", one),
    ];
    Table { name, columns, rows, folded: false }
}

/// Instruction sets of this machine, the best first.
fn levels() -> Vec<(&'static str, Level)> {
    #[cfg(target_arch = "x86_64")]
    {
        let best = Level::new();
        let avx512 = best.as_avx512().map(|t| ("AVX-512", Level::Avx512(t)));
        let avx2 = best.as_avx2().map(|t| ("AVX2", Level::Avx2(t)));
        let sse2 = best.as_sse2().map(|t| ("SSE2 (x86-64 baseline)", Level::Sse2(t)));
        [avx512, avx2, sse2].into_iter().flatten().collect()
    }
    #[cfg(not(target_arch = "x86_64"))]
    vec![("baseline", Level::baseline())]
}

/// The section.
///
/// # Errors
/// [`Error::Mechanics`] if a cable cannot be stepped.
pub fn section(bench: &mut Bench<'_>) -> Result<Section, Error> {
    let mut section = Section::new("What an element costs, and each effect");
    section.text(format!(
        "ns per element, CPU time on one thread, the median of {} readings of {CALLS} calls from the same state; {ELEMENTS} elements. \
         *Implicit step* is one step of the trapezoidal rule: force, tangent, factor, solve, update, and the step control around them. \
         Right of it are counts per step: Newton iterations and factorisations of the cable, the rest in elements evaluated. An effect \
         that is absent counts nothing.",
        bench.options.readings
    ));
    let mut rows = Vec::new();
    for (name, rule, effects) in cases() {
        bench.tell(&format!("effects, {name}"));
        rows.push(row(bench, name, &mut cable(rule, effects)?)?);
    }
    section.table(table("effects", "effects", rows));
    section.text("The default rule without effects, by instruction set; which of them runs is decided at run time:");
    let mut rows = Vec::new();
    for (name, level) in levels() {
        bench.tell(&format!("kernels, {name}"));
        let mut cable = cable("projected-3", Effects::default())?;
        cable.set_simd_level(level)?;
        rows.push(row(bench, name, &mut cable)?);
    }
    section.table(table("kernels", "instructions", rows));
    Ok(section)
}
