//! The falling pendulum of Bulin & Hajzman, and its reference solution.
//!
//! A square cable of side 0.01 m, 2 m long, E = 1e8 Pa, 4000 kg/m^3, is pinned at one end with its
//! slope free and released from horizontal.
//!
//! # References
//! The motion of the real beam is Richardson-extrapolated from runs with 80 and 160 elements of an
//! independent solver in double precision, with a time error below 1e-12 m:
//! `assets/reference/pendulum_converged_tip.csv`.

use lariat_ancf::{At, Cable, Error, Integrator, Rule, Section, Vector3};

/// Length in m.
pub const LENGTH: f64 = 2.0;
/// Interval of the reference and of [`Trace::run`] in s.
pub const INTERVAL: f64 = 0.01;
/// Number of samples from 0 to 2 s.
pub const SAMPLES: usize = 201;

const BEAM: &str = include_str!("../reference/pendulum_converged_tip.csv");

/// Builds the pendulum, at rest and horizontal.
///
/// # Errors
/// As [`CableBuilder::build`](lariat_ancf::CableBuilder::build), for zero elements or an
/// unsupported step control.
pub fn cable(rule: Rule, elements: usize, integrator: Integrator) -> Result<Cable, Error> {
    Cable::builder()
        .name(format!("pendulum {rule}"))
        .points([Vector3::zeros(), Vector3::new(LENGTH, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0)?)
        .elements(elements)
        .rule(rule)
        .allow_rank_deficient()
        .integrator(integrator)
        .fix(At::Start)
        .build()
}

/// Returns the tip of the real beam at multiples of [`INTERVAL`], in m.
pub fn beam() -> Vec<Vector3<f64>> {
    let number = |cell: Option<&str>| cell.and_then(|x| x.parse().ok()).unwrap_or(f64::NAN);
    let position = |line: &str| {
        let mut cells = line.split(',').skip(4);
        Vector3::from_fn(|_, _| number(cells.next()))
    };
    BEAM.lines().skip(1).map(position).collect()
}

/// Tip positions of a run at multiples of [`INTERVAL`], from 0 to 2 s.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Tip in m.
    pub tip: Vec<Vector3<f64>>,
    /// The cable at 2 s.
    pub cable: Cable,
}

impl Trace {
    /// Runs a cable from 0 to 2 s.
    ///
    /// # Errors
    /// As [`Cable::step`].
    pub fn run(mut cable: Cable) -> Result<Self, Error> {
        let mut tip = Vec::with_capacity(SAMPLES);
        for k in 0..SAMPLES {
            cable.step((k as f64 / 100.0 - cable.time()).max(0.0))?;
            tip.push(cable.node_position(cable.nodes() - 1));
        }
        Ok(Trace { tip, cable })
    }

    /// Returns the largest distance of the tip from another history, in m.
    pub fn distance(&self, other: &[Vector3<f64>]) -> f64 {
        self.tip.iter().zip(other).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    /// Returns the largest vertical distance of the tip from another history, in m.
    pub fn vertical_distance(&self, other: &[Vector3<f64>]) -> f64 {
        self.tip.iter().zip(other).map(|(a, b)| (a.y - b.y).abs()).fold(0.0, f64::max)
    }
}
