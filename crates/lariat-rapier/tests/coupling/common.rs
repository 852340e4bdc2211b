//! Scenes and tools that several files share.

use lariat_rapier::lariat_ancf::{Cable, CableBuilder, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{CableHandle, CableSet};

/// Returns E = 1e9 Pa, 4000 kg/m^3, a square of 1 cm: EA = 1e5 N, 0.4 kg/m.
pub fn soft() -> Section {
    Section::square(0.01, 1e9, 4000.0).unwrap()
}

/// Returns a steel bar, a square of 1 cm: EA = 2e7 N.
pub fn steel() -> Section {
    Section::square(0.01, 2e11, 7850.0).unwrap()
}

/// Returns a steel wire of 3 mm: EA = 1.41e6 N, 0.055 kg/m.
pub fn wire() -> Section {
    Section::round(0.003, 2e11, 7850.0).unwrap()
}

/// Returns generalised-alpha of spectral radius 0 at 1/480 s, which damps what the step does not
/// resolve.
pub fn l_stable_integrator() -> Integrator {
    Integrator { method: "generalised-alpha-0".parse().unwrap(), control: StepControl::MaxStep(1.0 / 480.0) }
}

/// Returns a cable along a straight line.
pub fn cable(from: [f64; 3], to: [f64; 3], section: Section) -> CableBuilder {
    Cable::builder().points([Vector3::from(from), Vector3::from(to)]).section(section)
}

/// Returns a world without gravity.
pub fn weightless() -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::ZERO;
    world
}

/// Adds a dynamic cube of half side `half` (m).
pub fn add_cube(world: &mut PhysicsWorld, mass: Real, half: Real, at: [Real; 3]) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic().translation(Vector::from(at));
    world.insert(body, ColliderBuilder::cuboid(half, half, half).mass(mass)).0
}

/// Runs a number of host steps.
pub fn run(world: &mut PhysicsWorld, set: &mut CableSet, steps: usize) {
    for _ in 0..steps {
        set.step(world).unwrap();
    }
}

/// Returns the largest gap of all attachments in m.
pub fn gap(set: &CableSet) -> f64 {
    set.attachments().map(|(_, a)| a.gap()).fold(0.0, f64::max)
}

/// Returns the tension in N at an arc length.
pub fn tension(set: &CableSet, cable: CableHandle, s: f64) -> f64 {
    set.get(cable).unwrap().sample(s).unwrap().tension
}

/// Returns the state of all bodies and cables, to the bit.
pub fn bits(world: &PhysicsWorld, set: &CableSet) -> Vec<u64> {
    let bodies = world.bodies.iter().flat_map(|(_, b)| {
        let (x, q) = (b.translation(), b.rotation());
        [
            x.x,
            x.y,
            x.z,
            q.x,
            q.y,
            q.z,
            q.w,
            b.linvel().x,
            b.linvel().y,
            b.linvel().z,
            b.angvel().x,
            b.angvel().y,
            b.angvel().z,
        ]
    });
    let cables = set.iter().flat_map(|(_, c)| c.positions().iter().chain(c.velocities()).copied());
    bodies.map(|x| u64::from(x.to_bits())).chain(cables.map(f64::to_bits)).collect()
}

/// Returns whether this is the build in double precision, without `LARIAT_LONG_TESTS=1`: it leaves out tests of many seconds that do not
/// depend on the precision.
pub fn is_left_out_in_double() -> bool {
    size_of::<Real>() == 8 && std::env::var_os("LARIAT_LONG_TESTS").is_none_or(|value| value != "1")
}
