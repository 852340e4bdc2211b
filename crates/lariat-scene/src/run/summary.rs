//! `summary.json`: the results and costs of a run, in one object.

use super::{BodyStatics, CableStatics, EnergyBalance, ErrorClaim, Parted, World};
use crate::error::Error;
use crate::warning::Warning;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::time::Duration;

/// The summary of a run; keys as docs/scene.md lists them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Summary {
    /// Name of the scene.
    pub name: String,
    /// Time simulated in s.
    pub simulated_s: f64,
    /// CPU time of the process during the run in s, without the time for [`view.html`](crate::view).
    pub cpu_s: f64,
    /// Wall time of the run in s, also without it.
    pub wall_s: f64,
    /// Simulated time over wall time: above 1 is faster than the clock.
    pub real_time_factor: f64,
    /// Integration steps, all cables together.
    pub steps: u64,
    /// Rejected integration steps.
    pub rejected_steps: u64,
    /// Newton iterations, including those of statics.
    pub newton_iterations: u64,
    /// Factorisations of step matrices.
    pub factorisations: u64,
    /// Solutions with their factors.
    #[serde(default)]
    pub solves: u64,
    /// Steps that were divided.
    #[serde(default)]
    pub divided_steps: u64,
    /// Tests of whether pieces of cables are near each other, obstacles and their edges.
    #[serde(default)]
    pub search_tests: u64,
    /// Newton iterations beyond the first one of a step, by the reason for them; of
    /// `discrete-gradient`.
    #[serde(default)]
    pub iterations_for: BTreeMap<String, u64>,
    /// Divisions of its steps, by the reason for them.
    #[serde(default)]
    pub divisions_for: BTreeMap<String, u64>,
    /// Elements evaluated, with or without tangent.
    pub element_evaluations: u64,
    /// Elements evaluated by effect, for the effects that are on.
    pub effect_evaluations: BTreeMap<String, u64>,
    /// Largest distance between an attachment's two sides at the ends of all steps, in m.
    pub max_gap_m: f64,
    /// Total energy at t = 0 in J; null if it is not finite.
    pub energy_start_j: Option<f64>,
    /// Total energy at the end in J; null if it is not finite.
    pub energy_end_j: Option<f64>,
    /// The energy balance; only of a run in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub energy_balance: Option<EnergyBalance>,
    /// What is told of the warnings, a line for each kind, by level.
    #[serde(default)]
    pub told: Vec<String>,
    /// All warnings, by level.
    #[serde(serialize_with = "crate::warning::with_texts")]
    pub warnings: Vec<Warning>,
    /// Cables that broke or were cut, in their order; only if there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub breaks: Vec<Parted>,
    /// Why the run failed; null if it did not.
    pub failed: Option<String>,
    /// What is claimed about the error that was asked for; only with `--error`. Counts and times above are those of the last run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorClaim>,
    /// The equilibrium of each cable; only for `lariat static`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statics: Option<Vec<CableStatics>>,
    /// What statics did with the bodies; only for `lariat static` of a scene with bodies or junctions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub static_bodies: Option<BodyStatics>,
}

impl Summary {
    pub(super) fn of(world: &World, cpu: Duration, wall: Duration, failed: Option<&Error>) -> Self {
        let count = |read: fn(&lariat_ancf::Diagnostics) -> u64| -> u64 {
            world.cables().iter().map(|cable| read(cable.diagnostics())).sum()
        };
        let finite = |x: f64| Some(x).filter(|x| x.is_finite());
        let simulated = world.time();
        let [iterations_for, divisions_for] = world.reasons();
        Summary {
            name: world.scene.name.clone(),
            simulated_s: simulated,
            cpu_s: cpu.as_secs_f64(),
            wall_s: wall.as_secs_f64(),
            real_time_factor: simulated / wall.as_secs_f64().max(1e-9),
            steps: count(|d| d.steps),
            rejected_steps: count(|d| d.rejected_steps),
            newton_iterations: count(|d| d.newton_iterations) + world.static_iterations,
            factorisations: count(|d| d.factorisations),
            solves: count(|d| d.solves),
            divided_steps: count(|d| d.split_steps),
            search_tests: count(|d| d.search_tests),
            iterations_for,
            divisions_for,
            element_evaluations: count(|d| d.element_evaluations()),
            effect_evaluations: world.effect_evaluations(),
            max_gap_m: world.max_gap(),
            energy_start_j: finite(world.energy_start),
            energy_end_j: finite(world.energy(None).total()),
            energy_balance: None,
            told: Vec::new(),
            warnings: world.warnings.clone(),
            breaks: world.breaks.clone(),
            failed: failed.map(ToString::to_string),
            error: None,
            statics: world.statics.clone(),
            static_bodies: world.static_bodies.clone(),
        }
    }

    /// Returns the summary as JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_else(|error| format!("{{\"failed\": \"{error}\"}}"))
    }
}
