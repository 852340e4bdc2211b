//! Chains of ropes and bodies drawn by chance: balls and bricks, pinned off their centres, some clamped, slack or taut, thrown and disturbed.

use crate::common::Random;
use crate::law::{HEIGHT, energies};
use crate::recipe::{choose, power};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Integrator, Method, Rule, Section, StepControl, Vector3};
use nalgebra::Matrix3;

/// Cables and bodies with their pins.
pub struct Chain {
    pub cables: Vec<Cable>,
    pub bodies: Vec<RigidBody>,
    pub pins: Vec<PinConstraint>,
    pub island: Island,
    pub integrator: Integrator,
    pub gravity: Vector3<f64>,
}

impl Chain {
    /// The chain of a seed.
    pub fn new(seed: u64, rule: Rule, longest: f64) -> Self {
        let random = &mut Random::new(1000 + seed);
        let weightless = choose(random, 3) == 0;
        let gravity = if weightless { Vector3::zeros() } else { Vector3::new(0.0, -9.81, 0.0) };
        let held = choose(random, 3) > 0;
        let count = 1 + choose(random, 4);
        let bricks = choose(random, 2) == 0;
        let clamped = choose(random, 4) == 0;
        let bending = if choose(random, 4) == 0 { 0.0 } else { power(random, -6.0, 1.0) };
        let section = Section::from_stiffness(power(random, 3.0, 7.0), bending, power(random, -2.0, 0.5)).unwrap();
        let elements = 2 + choose(random, 4);
        let speed = if choose(random, 2) == 0 { 0.0 } else { 5.0 };
        let velocity = random.vector() * speed;
        let length = 0.95 + 0.175 * (1.0 + random.next());
        let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(longest) };
        let mut chain = Chain {
            cables: Vec::new(),
            bodies: Vec::new(),
            pins: Vec::new(),
            island: Island::default(),
            integrator,
            gravity,
        };
        let mut at = Vector3::zeros();
        for k in 0..count {
            let mass = power(random, -2.0, 3.0);
            let angle = std::f64::consts::PI * random.next();
            let next = at + Vector3::new(angle.cos(), 0.4 * angle.sin(), 0.5 * angle.sin()) * 0.8;
            let inertia = if bricks { Vector3::new(0.003, 0.005, 0.007) } else { Vector3::repeat(0.00144) } * mass;
            let mut body = RigidBody::new(mass, Matrix3::from_diagonal(&inertia), next).unwrap();
            body.velocity = velocity;
            if bricks {
                body.angular_velocity = random.vector() * 10.0;
            }
            body.force = gravity * mass;
            let mut cable = Cable::builder()
                .name(format!("rope {k}"))
                .points([at, next])
                .length((next - at).norm() * length)
                .section(section)
                .elements(elements)
                .gravity(gravity)
                .rule(rule)
                .build()
                .unwrap();
            if k == 0 && held {
                cable.fix(At::Start).unwrap();
            } else if k > 0 {
                let (node, anchor) = (cable.attach(At::Start).unwrap(), chain.anchor(k - 1));
                chain.pins.push(PinConstraint { cable: k, node, body: k - 1, anchor, direction: None });
            }
            let direction = (next - at).normalize();
            let anchor = if bricks { random.vector() * 0.05 } else { Vector3::zeros() };
            let node = if clamped { cable.attach_clamped(At::End, None) } else { cable.attach(At::End) }.unwrap();
            let direction = clamped.then_some(direction);
            chain.pins.push(PinConstraint { cable: k, node, body: k, anchor, direction });
            chain.cables.push(cable);
            chain.bodies.push(body);
            at = next;
        }
        chain
    }

    fn anchor(&self, body: usize) -> Vector3<f64> {
        self.pins.iter().find(|pin| pin.body == body).map_or_else(Vector3::zeros, |pin| -pin.anchor)
    }

    /// Takes a host step.
    pub fn step(&mut self, dt: f64) -> Result<(), lariat_ancf::Error> {
        let mut cables: Vec<&mut Cable> = self.cables.iter_mut().collect();
        self.island.step(&mut cables, &mut self.bodies, &self.pins, self.integrator, dt)
    }

    /// Mechanical energy and store, and kinetic and strain energy with the weight times 1 mm.
    pub fn energies(&self) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for cable in &self.cables {
            let [energy, scale] = energies(cable);
            sum[0] += energy;
            sum[1] += scale;
        }
        for body in &self.bodies {
            sum[0] += body.kinetic_energy() + body.energy_in_store() - body.force.dot(&body.position);
            sum[1] += body.kinetic_energy() + 9.81 * HEIGHT * body.mass;
        }
        sum
    }

    /// Does something to it.
    pub fn disturb(&mut self, seed: u64) {
        let random = &mut Random::new(5000 + seed);
        let target = choose(random, self.bodies.len());
        match choose(random, 4) {
            0 => {
                self.gravity = -self.gravity;
                for cable in &mut self.cables {
                    cable.set_gravity(self.gravity).unwrap();
                }
                for body in &mut self.bodies {
                    body.force = self.gravity * body.mass;
                }
            }
            1 => self.bodies[target].velocity = random.vector() * 10.0,
            2 => self.bodies[target].angular_velocity = random.vector() * 20.0,
            _ => {}
        }
    }
}
