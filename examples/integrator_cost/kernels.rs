//! What one element costs: force, force with its exact tangent, the whole implicit step.

use crate::Outcome;
use fearless_simd::Level;
use lariat::{At, Cable, Integrator, Method, Rule, Section, Vector3};
use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

const RULES: [&str; 5] = ["projected-3", "G5-3", "ST2", "L2T2", "G5-none"];
/// Step in s: so short that Newton ends after one iteration with a fresh tangent (checked).
const STEP: f64 = 1e-7;
/// Calls from one reading of the clock to the next, and readings, of which the least counts.
const CALLS: usize = 64;
const READINGS: usize = 600;

/// ns per element.
#[derive(Clone, Copy)]
pub struct Costs {
    pub force: f64,
    pub tangent: f64,
    pub step: f64,
}

/// A soft cable, bent and moving.
fn cable(rule: &str, elements: usize) -> Outcome<Cable> {
    let points = [Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0), Vector3::new(2.0, 1.0, 0.3)];
    let builder = Cable::builder().points(points).section(Section::square(0.01, 1.0e8, 4000.0)?);
    let mut cable = builder.elements(elements).fix(At::Start).rule(rule.parse::<Rule>()?).build()?;
    cable.step(0.05)?;
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
    Ok(best / (CALLS * cable.elements().len()) as f64)
}

fn costs(cable: &mut Cable) -> Outcome<Costs> {
    let mut f = vec![0.0; cable.positions().len()];
    let force = least(cable, |cable| {
        cable.evaluate(black_box(&mut f));
        Ok(())
    })?;
    let tangent = least(cable, |cable| {
        black_box(cable.evaluate_with_stiffness(&mut f));
        Ok(())
    })?;
    cable.diagnostics_mut().reset();
    let step = least(cable, |cable| Ok(cable.step(black_box(STEP))?))?;
    let d = cable.diagnostics();
    let once = d.newton_iterations == d.steps && d.factorisations == d.steps;
    if once { Ok(Costs { force, tangent, step }) } else { Err("a step took more than one Newton iteration".into()) }
}

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

/// The default rule with 64 elements at every level, measured once for all that show it.
pub struct Levels {
    /// As a table.
    pub table: String,
    /// At the level that runs by itself.
    pub best: Costs,
}

/// Measures the default rule at every level, the best first.
pub fn by_level() -> Outcome<Levels> {
    let mut table =
        String::from("| instructions | force | force + tangent | whole implicit step |\n|---|---:|---:|---:|\n");
    let mut first = None;
    for (name, level) in levels() {
        let mut cable = cable(RULES[0], 64)?;
        cable.set_simd_level(level)?;
        let costs = costs(&mut cable)?;
        let Costs { force, tangent, step } = costs;
        writeln!(table, "| {name} | {force:.0} | {tangent:.0} | {step:.0} |")?;
        first.get_or_insert(costs);
    }
    Ok(Levels { table, best: first.ok_or("no instruction set")? })
}

/// The kernels as a section of the report.
pub fn report(levels: &Levels) -> Outcome<String> {
    let mut out = format!(
        "\n## One element\n\nns per element, the least of {READINGS} readings of {CALLS} calls. *Implicit step* is a step of the \
         trapezoidal rule with one Newton iteration: force, tangent, factor, solve, update, and the step control around them. The same \
         with statistics: `cargo bench -p lariat-ancf --bench kernels`.\n\n\
         | rule | elements | force | force + tangent | implicit step |\n|---|---:|---:|---:|---:|\n"
    );
    for elements in [16, 64] {
        for rule in RULES {
            let Costs { force, tangent, step } = costs(&mut cable(rule, elements)?)?;
            writeln!(out, "| {rule} | {elements} | {force:.0} | {tangent:.0} | {step:.0} |")?;
        }
    }
    write!(out, "\nThe default rule, 64 elements, by instruction set:\n\n{}", levels.table)?;
    Ok(out)
}
