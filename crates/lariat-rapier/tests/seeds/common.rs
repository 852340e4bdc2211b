//! Random numbers and what the families share.

use lariat_rapier::lariat_ancf::{Cable, CableBuilder, Level, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableSet, Warning};
use std::ops::Range;

/// SplitMix64.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Returns a number between two.
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number between two, its logarithm evenly spread.
    pub fn log(&mut self, from: f64, to: f64) -> f64 {
        self.between(from.ln(), to.ln()).exp()
    }

    /// Returns one of a list.
    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.next() % of.len() as u64) as usize]
    }
}

/// Returns a cable along a straight line.
pub fn cable(from: Vector3<f64>, to: Vector3<f64>, section: Section) -> CableBuilder {
    Cable::builder().points([from, to]).section(section)
}

/// Returns by level and name what is told of the accuracy of a run, whatever the fidelity. What is
/// told of meshes is left out: what they are compared with has the same.
pub fn told(set: &CableSet, world: &PhysicsWorld) -> Vec<String> {
    let mut set = set.clone();
    set.settings.warn_level = Some(Level::Coarse);
    let named = |warning: &Warning| (warning.level(), warning.name());
    let of_mesh = [
        "CoarseMesh",
        "CoarseMoment",
        "CoarseKink",
        "CoarseMotion",
        "CoarseElement",
        "GreenStrain",
        "LargeStrain",
        "Stubby",
        "SoftMaterial",
    ];
    let mut names: Vec<(Level, String)> = set.warnings(world).iter().map(named).collect();
    // sections and slack are drawn at random, of materials that carry waves faster than any does
    let drawn = ["FastWaves", "MuchSlack"];
    names.retain(|(_, name)| !of_mesh.contains(&name.as_str()) && !drawn.contains(&name.as_str()));
    names.into_iter().map(|(level, name)| format!("{} {name}", level.name())).collect()
}

/// Runs the scenes of seeds, those of the test or those that the user asks for in `LARIAT_SEEDS`, of which it prints each: `run` returns whether a scene
/// is off, what was told, and what to say of it.
///
/// # Panics
/// If a scene is off with nothing told of it, or, of the seeds of the test, if more of the scenes that are right than the share `false_alarms` are told of.
pub fn judge(of_test: Range<u64>, false_alarms: f64, run: impl Fn(u64) -> (bool, Vec<String>, String)) {
    let asked = std::env::var("LARIAT_SEEDS").ok();
    let range = asked
        .as_deref()
        .and_then(|range| range.split_once(".."))
        .and_then(|(from, to)| Some(from.parse().ok()?..to.parse().ok()?));
    let mut wrong = Vec::new();
    let (mut right, mut alarms) = (0, Vec::new());
    // of right and of wrong scenes those that are told of as setup or wrong, as coarse alone, and
    // not at all
    let mut counts = [[0; 3]; 2];
    for seed in range.unwrap_or(of_test) {
        let (off, told, case) = run(seed);
        let verdict = match (off, told.is_empty()) {
            (true, true) => "wrong ",
            (true, false) => "told ",
            (false, false) => "right but told ",
            (false, true) => "",
        };
        if asked.is_some() {
            println!("{verdict}{case}");
        }
        let coarse = told.iter().all(|name| name.starts_with(Level::Coarse.name()));
        counts[usize::from(off)][if told.is_empty() { 2 } else { usize::from(coarse) }] += 1;
        if off {
            wrong.extend(told.is_empty().then_some(case));
            continue;
        }
        right += 1;
        alarms.extend((!told.is_empty()).then(|| format!("{seed}: {told:?}")));
    }
    // a row of the table of docs/stability.md, which `.ci/judge` makes
    let [[serious, coarse, nothing], [told, also_told, silent]] = counts;
    let family = std::thread::current().name().unwrap_or("").replace("::", ": ").replace('_', " ");
    println!("judged | {family} | {nothing} | {coarse} | {serious} | {told} | {also_told} | {silent} |");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let most = false_alarms * f64::from(right);
    assert!(asked.is_some() || alarms.len() as f64 <= most, "of {right} that are right:\n{}", alarms.join("\n"));
}

/// Returns where a body is, in double precision.
pub fn place(world: &PhysicsWorld, body: RigidBodyHandle) -> Vector3<f64> {
    lariat_rapier::convert::vector(world.bodies[body].translation())
}
