//! The rope of these tests, and how it is run.

use lariat_ancf::contact::Obstacle;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Cable, CableBuilder, Contact, Damping, Integrator, Method, Section, StepControl, Vector3};

/// Radius of the rope in m.
pub const RADIUS: f64 = 5e-3;
/// Its mass per length in kg/m.
pub const MASS: f64 = 0.14;
pub const GRAVITY: f64 = 9.81;

pub fn up() -> Vector3<f64> {
    Vector3::y()
}

/// A rope of radius 5 mm, EA 1e6 N, 0.14 kg/m, with 1 ms of internal damping, in steps of 1/240 s.
pub fn rope(ei: f64, points: &[Vector3<f64>], elements: usize) -> CableBuilder {
    Cable::builder()
        .points(points.iter().copied())
        .section(Section::from_stiffness(1e6, ei, MASS).unwrap())
        .elements(elements)
        .rule("projected-T1".parse().unwrap())
        .damping(Damping { axial: 1e-3, bending: 1e-3 })
        .gravity(Vector3::new(0.0, -GRAVITY, 0.0))
        .integrator(steps(240.0))
}

pub fn steps(rate: f64) -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / rate) }
}

/// Gives it contact with obstacles.
pub fn with(mut cable: Cable, obstacles: Vec<Obstacle>) -> Cable {
    cable.set_contact(Contact::default().with_radius(RADIUS)).unwrap();
    cable.set_obstacles(obstacles).unwrap();
    cable
}

/// Mechanical energy, store and that of contacts; and that of motion, strain and contacts.
pub fn energies(cable: &Cable) -> [f64; 2] {
    let (energy, contact) = (cable.energy(), cable.contact_energy());
    let held = energy.kinetic + energy.axial + energy.bending + contact;
    [energy.total() + cable.energy_in_store() + contact, held]
}

/// Takes host steps of 1/60 s, and returns the largest growth of energy beyond the work of supports and obstacles, as a share of the largest
/// energy of motion, strain and contacts.
pub fn run(cable: &mut Cable, hosts: usize, mut each: impl FnMut(&Cable)) -> f64 {
    let (mut worst, mut largest) = (0.0f64, 1e-12f64);
    let work = |cable: &Cable| cable.energy_law().supports + cable.energy_law().obstacles;
    for _ in 0..hosts {
        let ([before, held], done) = (energies(cable), work(cable));
        largest = largest.max(held);
        cable.step(1.0 / 60.0).unwrap();
        let [after, held] = energies(cable);
        largest = largest.max(held);
        worst = worst.max(after - before - (work(cable) - done));
        each(cable);
    }
    worst / largest
}

/// Largest depth in m by which the rope is in anything.
pub fn deepest(cable: &Cable) -> f64 {
    cable.contacts().fold(0.0, |most, touch| most.max(touch.depth))
}

/// The tension at an arc length.
pub fn tension(cable: &Cable, s: f64) -> f64 {
    cable.sample(s).unwrap().tension
}
