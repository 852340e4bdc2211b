//! The cost of an element and of each effect: force, force with exact tangent, a whole implicit
//! step.
//!
//! One cable of 64 elements, bent and moving, one thread; the trapezoidal rule at a step so short
//! that Newton ends after one iteration with a new tangent, or a second with the same factors.
//! Times are of bursts of calls from the same state; counts are the same on every machine. A flow
//! that a program samples is sampled before each step, and its time is included.

use super::effect_cases::{self, COLUMNS};
use super::options::Options;
use crate::clock::Timing;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Format, Table, hidden, shown};
use cpu_time::ProcessTime;
use fearless_simd::Level;
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{
    At, Cable, Effects, Fidelity, Integrator, Level as Told, Method, Rule, Section as CrossSection, Vector3,
};
use std::hint::black_box;

/// Step in s.
const STEP: f64 = 1e-7;
const ELEMENTS: usize = 64;
/// Calls from one reading of the clock to the next.
const CALLS: usize = 64;

/// Rules that are measured without effects; effects are measured with the default one.
const RULES: [(&str, &str); 5] = [
    ("no bending", "projected-none"),
    ("no effects", "projected-3"),
    ("no effects, G5-3", "G5-3"),
    ("no effects, ST2", "ST2"),
    ("no effects, L2T2", "L2T2"),
];

/// Builds a soft cable, bent and moving.
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

/// Returns the time in ns per element of many readings, each from the same state.
fn time(
    options: &Options,
    cable: &mut Cable,
    mut call: impl FnMut(&mut Cable) -> Result<(), Error>,
) -> Result<Option<Timing>, Error> {
    let state = cable.snapshot().clone();
    let mut times = Vec::new();
    for _ in 0..options.readings {
        cable.restore(state.clone())?;
        let clock = ProcessTime::now();
        for _ in 0..CALLS {
            call(cable)?;
        }
        times.push(clock.elapsed().as_secs_f64() * 1e9 / (CALLS * ELEMENTS) as f64);
    }
    Ok(Timing::of(times))
}

/// Measures force, force with tangent and step, and the counts of one step.
fn row(options: &Options, name: &str, cable: &mut Cable, sampled: bool) -> Result<Vec<Cell>, Error> {
    let mut f = vec![0.0; cable.positions().len()];
    let force = time(options, cable, |cable| {
        cable.evaluate(black_box(&mut f));
        Ok(())
    })?;
    let tangent = time(options, cable, |cable| {
        black_box(cable.evaluate_with_stiffness(black_box(&mut f)));
        Ok(())
    })?;
    cable.diagnostics_mut().reset();
    let step = time(options, cable, |cable| {
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
    ]);
    row.extend(d.effects.by_key().map(|(_, n)| per_step(n)).take(COLUMNS.len()));
    Ok(row)
}

fn table(name: &'static str, first: &'static str, rows: Vec<Vec<Cell>>) -> Table {
    let one = Format::Fixed(1);
    let mut columns = vec![
        shown("case", first, Format::Plain),
        hidden("rule"),
        shown("force_ns", "force", one),
        hidden("force_least_ns"),
        hidden("force_most_ns"),
        shown("tangent_ns", "force + tangent", one),
        hidden("tangent_least_ns"),
        hidden("tangent_most_ns"),
        shown("step_ns", "implicit step", one),
        hidden("step_least_ns"),
        hidden("step_most_ns"),
        hidden("newton_per_step"),
        hidden("factorisations_per_step"),
        hidden("element_evaluations_per_step"),
        hidden("bending_evaluations_per_step"),
    ];
    columns.extend(COLUMNS.iter().map(|name| hidden(name)));
    Table { name, columns, rows }
}

/// Measures a host step of 1/60 s in fidelity game, of a cable that nobody watches and of one that [`CableSet`](lariat_rapier::CableSet)
/// watches, without and with what is coarse.
fn watching(options: &Options) -> Result<Table, Error> {
    let mut rows = Vec::new();
    let levels = [("not watched", None), ("watched", Some(Told::Wrong)), ("watched, coarse", Some(Told::Coarse))];
    for (name, level) in levels {
        let mut cable = cable("projected-3", Effects::default())?;
        cable.set_integrator(cable.integrator_for(Fidelity::Game))?;
        cable.set_watched(level.is_some());
        level.into_iter().for_each(|level| cable.watch_up_to(level));
        cable.step(1.0 / 60.0)?;
        let timing = time(options, &mut cable, |cable| {
            cable.step(black_box(1.0 / 60.0))?;
            cable.note_host_step(true, |warning| drop(black_box(warning)));
            Ok(())
        })?;
        let part = |part: fn(&Timing) -> f64| Cell::from(timing.as_ref().map(part));
        rows.push(vec![Cell::from(name), part(|t| t.median), part(|t| t.least), part(|t| t.most)]);
    }
    let columns = vec![
        shown("case", "a host step in fidelity game", Format::Plain),
        shown("host_step_ns", "ns per element", Format::Fixed(1)),
        hidden("host_step_least_ns"),
        hidden("host_step_most_ns"),
    ];
    Ok(Table { name: "watching", columns, rows })
}

/// Returns the instruction sets of this machine, the widest first.
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

/// Title of the section.
pub const TITLE: &str = "Cost of an element and of each effect";

/// Measures the section.
///
/// # Errors
/// [`Error::Mechanics`] if a cable cannot be stepped.
pub fn section(options: &Options) -> Result<Section, Error> {
    let mut section = Section::new(TITLE);
    section.text(format!(
        "ns per element, CPU time on one thread, the median of {} readings of {CALLS} calls from the same state; {ELEMENTS} elements. \
         *Implicit step* is one step of the trapezoidal rule: force, tangent, factorisation, solution, update and step control. The file \
         also has the counts per step. An effect that is absent counts nothing.",
        options.readings
    ));
    let mut rows = Vec::new();
    for (name, rule) in RULES {
        rows.push(row(options, name, &mut cable(rule, Effects::default())?, false)?);
    }
    for case in effect_cases::cases() {
        rows.push(row(options, &case.name, &mut cable("projected-3", case.effects)?, case.sampled)?);
    }
    section.table(table("effects", "effects", rows));
    section.text("The default rule without effects by instruction set, which is selected at run time:");
    let mut rows = Vec::new();
    for (name, level) in levels() {
        let mut cable = cable("projected-3", Effects::default())?;
        cable.set_simd_level(level)?;
        rows.push(row(options, name, &mut cable, false)?);
    }
    section.table(table("kernels", "instructions", rows));
    section.text(
        "What warnings cost: a cable of a `CableSet` reads its mesh indicator, strain and steps at the end of each host step \
         (`Settings::watch`, on by default).",
    );
    section.table(watching(options)?);
    Ok(section)
}
