//! Problems with reference, tolerance and source, and small tools, shared by the integration tests.
#![allow(dead_code)] // each test binary uses a part

pub mod beam;
pub mod rod;

use lariat_ancf::linalg::BlockTridiagonal;
use lariat_ancf::{At, Cable, CableBuilder, Integrator, Method, Rule, Section, StepControl, Vector3};
use nalgebra::DMatrix;

/// A problem with what it is compared with.
pub struct Model<P, R> {
    /// What is run.
    pub problem: P,
    /// The outside value.
    pub reference: R,
    /// Largest accepted difference, in the unit of the reference.
    pub tolerance: f64,
    /// Where the outside value comes from.
    pub source: &'static str,
}

/// The rows of a CSV file of the workspace's `assets/reference`, without its heading.
pub fn reference(name: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/../../assets/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    text.lines().skip(1).map(|row| row.split(',').map(|x| x.parse().unwrap()).collect()).collect()
}

/// A JSON file of the workspace's `assets/reference`.
pub fn reference_json(name: &str) -> serde_json::Value {
    let path = format!("{}/../../assets/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))).unwrap()
}

/// Symplectic Runge-Kutta-Nystrom of order 6 at half its stability limit: its time error is below 1e-11 m in 2 s of the
/// pendulum.
pub const EXACT_IN_TIME: Integrator = Integrator { method: Method::Rkn6, control: StepControl::Stable(0.5) };

/// A rule by name.
pub fn rule(name: &str) -> Rule {
    name.parse().unwrap()
}

/// The falling pendulum of Bulin & Hajzman: 2 m, square of 1 cm, E = 1e8 Pa, 4000 kg/m^3, pinned, released from
/// horizontal.
pub fn pendulum(elements: usize) -> CableBuilder {
    Cable::builder()
        .name("pendulum")
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
        .elements(elements)
        .fix(At::Start)
}

/// A soft cable in space whose frequencies stay below about 150 rad/s, so that every method resolves it: 1 m, 3
/// elements, bent start shape, with a velocity.
pub fn soft_cable() -> CableBuilder {
    Cable::builder()
        .name("soft")
        .points([Vector3::zeros(), Vector3::new(0.5, 0.1, 0.0), Vector3::new(0.9, 0.2, 0.1)])
        .length(1.0)
        .section(Section::from_stiffness(40.0, 0.05, 1.0).unwrap())
        .elements(3)
        .gravity(Vector3::new(0.0, -9.81, 0.0))
}

/// Runs a cable by `dt` (s) to each of `samples` further times and reads it, the start included.
pub fn history<T>(cable: &mut Cable, dt: f64, samples: usize, mut read: impl FnMut(&mut Cable) -> T) -> Vec<T> {
    let mut rows = vec![read(cable)];
    for i in 1..=samples {
        cable.step(dt * i as f64 - cable.time()).unwrap();
        rows.push(read(cable));
    }
    rows
}

/// All implicit methods.
pub fn implicit() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|m| m.properties().implicit)
}

/// Position of the last node in m.
pub fn tip(cable: &Cable) -> Vector3<f64> {
    cable.node_position(cable.nodes() - 1)
}

/// A block-tridiagonal matrix as a dense one.
pub fn dense(a: &BlockTridiagonal) -> DMatrix<f64> {
    let n = a.nodes();
    let mut m = DMatrix::zeros(6 * n, 6 * n);
    for (i, block) in a.diag.iter().enumerate() {
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            m[(6 * i + r, 6 * i + c)] = block.0[c][r];
        }
    }
    for (i, block) in a.lower.iter().enumerate() {
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            m[(6 * i + 6 + r, 6 * i + c)] = block.0[c][r];
            m[(6 * i + c, 6 * i + 6 + r)] = block.0[c][r];
        }
    }
    m
}

/// The same numbers on every machine: a 64-bit linear congruential generator (Knuth 1997, MMIX), in [-1, 1).
pub struct Random(u64);

impl Random {
    /// Starts from a seed.
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(1))
    }

    /// The next number in [-1, 1).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A number between two, evenly distributed.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (1.0 + self.next())
    }

    /// A number between two, evenly distributed by its logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.between(0.0, 1.0))
    }

    /// A vector with components in [-1, 1).
    pub fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    /// A rotation.
    pub fn rotation(&mut self) -> nalgebra::Rotation3<f64> {
        nalgebra::Rotation3::new(self.vector() * 2.0)
    }
}

/// Applies a linear map to every 3-vector of a flat array.
pub fn map3(x: &[f64], f: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Vec<f64> {
    x.chunks_exact(3).flat_map(|c| f(Vector3::new(c[0], c[1], c[2])).iter().copied().collect::<Vec<_>>()).collect()
}

/// Largest absolute difference of two slices.
pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |m: f64, (a, b)| if (a - b).is_nan() { f64::NAN } else { m.max((a - b).abs()) })
}
