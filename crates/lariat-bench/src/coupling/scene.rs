//! Boxes on cables: the same scene for every model of a cable.

use lariat_rapier::lariat_ancf::{At, Cable, CableBuilder, Error, Section, Vector3};
use lariat_rapier::rapier::prelude::*;

/// Length of a cable in m.
pub const LENGTH: f64 = 2.0;
/// Elements, edges or capsules of a cable.
pub const ELEMENTS: usize = 10;
/// Side of the square section in m.
const SIDE: f64 = 0.01;
/// Half side of the boxes in m.
pub const HALF: Real = 0.1;
/// Host steps per second.
pub const RATE: usize = 60;
const GRAVITY: f64 = 9.81;

/// The material of a cable.
#[derive(Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus in Pa.
    pub young: f64,
    /// Density in kg/m^3.
    pub density: f64,
}

pub const SOFT: Material = Material { young: 1e9, density: 4000.0 };
pub const STEEL: Material = Material { young: 2e11, density: 7850.0 };

impl Material {
    /// Returns the mass of a cable in kg.
    pub fn mass(&self) -> f64 {
        self.density * SIDE * SIDE * LENGTH
    }
}

/// Boxes side by side, each attached by its top face to a cable from a fixed point at height zero.
#[derive(Clone, Copy)]
pub struct Scene {
    /// Name in the CSV file.
    pub name: &'static str,
    pub material: Material,
    /// Number of boxes, each on its cable.
    pub count: usize,
    /// Mass of a box in kg.
    pub mass: f64,
    /// Whether it is released from horizontal; otherwise it hangs, with a linear damping of 5 /s.
    pub swings: bool,
}

impl Scene {
    /// Returns the steps before the measurement, in which a hanging box comes to rest.
    pub fn settling(&self) -> usize {
        if self.swings { 0 } else { 4 * RATE }
    }

    /// Returns the start of cable `i`.
    pub fn start(&self, i: usize) -> Vector {
        Vector::new(0.0, 0.0, 0.5 * i as Real)
    }

    /// Returns the point at a share of the length of cable `i`.
    pub fn along(&self, i: usize, share: f64) -> Vector {
        let reach = (LENGTH * (1.0 + self.static_stretch()) * share) as Real;
        self.start(i) + if self.swings { Vector::X * reach } else { -Vector::Y * reach }
    }

    /// Returns the stretch under the load at rest by Green's law, `m g + mu g L/2 = EA (f^2 - 1)/2
    /// f`; 0 for a box that swings.
    pub fn static_stretch(&self) -> f64 {
        if self.swings {
            return 0.0;
        }
        let load = GRAVITY * (self.mass + 0.5 * self.material.mass()) / (self.material.young * SIDE * SIDE);
        let mut f = 1.0f64;
        for _ in 0..50 {
            f -= (0.5 * (f * f - 1.0) * f - load) / (1.5 * f * f - 0.5);
        }
        f - 1.0
    }

    /// Begins cable `i`, not yet attached to its box.
    ///
    /// # Errors
    /// As [`Section::square`].
    pub fn cable(&self, i: usize) -> Result<CableBuilder, Error> {
        let vector = |x: Vector| Vector3::new(x.x, x.y, x.z).map(f64::from);
        Ok(Cable::builder()
            .points([vector(self.start(i)), vector(self.along(i, 1.0))])
            .length(LENGTH)
            .section(Section::square(SIDE, self.material.young, self.material.density)?)
            .elements(ELEMENTS)
            .fix(At::Start))
    }

    /// Creates a world with the boxes, with the default settings of Rapier except the time step and
    /// the iterations.
    pub fn world(&self, steps: u32, iterations: usize) -> (PhysicsWorld, Vec<RigidBodyHandle>) {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / (RATE as Real * steps as Real);
        world.integration_parameters.num_solver_iterations = iterations;
        let boxes = (0..self.count)
            .map(|i| {
                let body = RigidBodyBuilder::dynamic()
                    .translation(self.along(i, 1.0) - Vector::Y * HALF)
                    .linear_damping(if self.swings { 0.0 } else { 5.0 })
                    .can_sleep(false);
                world.insert(body, ColliderBuilder::cuboid(HALF, HALF, HALF).mass(self.mass as Real)).0
            })
            .collect();
        (world, boxes)
    }
}
