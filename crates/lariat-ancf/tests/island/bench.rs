//! Scenes and tools shared by several files.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinAccount, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Integrator, Section, Vector3};
use nalgebra::Matrix3;

/// E = 1e9 Pa, 4000 kg/m^3, square of 1 cm.
pub fn soft() -> Section {
    Section::square(0.01, 1e9, 4000.0).unwrap()
}

/// Steel, square of 1 cm.
pub fn steel() -> Section {
    Section::square(0.01, 2e11, 7850.0).unwrap()
}

/// Inertia of a homogeneous cube in kg m^2.
pub fn cube(mass: f64, side: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(mass * side * side / 6.0)
}

/// Cables, bodies and pins that step together.
pub struct Scene {
    pub cables: Vec<Cable>,
    pub bodies: Vec<RigidBody>,
    pub pins: Vec<PinConstraint>,
    pub integrator: Integrator,
    pub island: Island,
}

impl Scene {
    pub fn new(cables: Vec<Cable>, bodies: Vec<RigidBody>, integrator: Integrator) -> Self {
        Scene { cables, bodies, pins: Vec::new(), integrator, island: Island::default() }
    }

    /// Holds a node of a cable to a point of a body.
    pub fn pin(mut self, cable: usize, at: impl Into<At>, body: usize, anchor: Vector3<f64>) -> Self {
        let at = at.into();
        self.lay_back(cable, at, body, &anchor);
        let node = self.cables[cable].attach(at).unwrap();
        self.pins.push(PinConstraint { cable, node, body, anchor, direction: None });
        self
    }

    /// Clamps a node of a cable, in its present direction, to a point of a body.
    pub fn clamp(mut self, cable: usize, at: impl Into<At>, body: usize, anchor: Vector3<f64>) -> Self {
        let at = at.into();
        self.lay_back(cable, at, body, &anchor);
        let node = self.cables[cable].attach_clamped(at, None).unwrap();
        let slope = Vector3::from_column_slice(&self.cables[cable].positions()[6 * node + 3..6 * node + 6]);
        let direction = Some(self.bodies[body].rotation.inverse() * slope.normalize());
        self.pins.push(PinConstraint { cable, node, body, anchor, direction });
        self
    }

    /// Lays an end that turned with a clamp back where it was drawn, if a body is there.
    fn lay_back(&mut self, cable: usize, at: At, body: usize, anchor: &Vector3<f64>) {
        let (cable, body) = (&mut self.cables[cable], &self.bodies[body]);
        let target = body.position + body.rotation * anchor;
        if cable.drawn_position(at).is_some_and(|drawn| (drawn - target).norm() < 1e-6) {
            cable.lay_as_drawn(at).unwrap();
        }
    }

    pub fn try_step(&mut self, dt: f64) -> Result<(), lariat_ancf::Error> {
        let mut cables: Vec<&mut Cable> = self.cables.iter_mut().collect();
        self.island.step(&mut cables, &mut self.bodies, &self.pins, self.integrator, dt)
    }

    /// `steps` host steps of `dt` (s).
    pub fn run(&mut self, dt: f64, steps: usize) {
        for _ in 0..steps {
            self.try_step(dt).unwrap();
        }
    }

    /// Force of each cable on its body in N, by pin.
    pub fn pin_forces(&self) -> Vec<Vector3<f64>> {
        self.island.accounts().iter().map(|a| a.force).collect()
    }

    /// Forces, impulses and work at each pin during the last step.
    pub fn accounts(&self) -> &[PinAccount] {
        self.island.accounts()
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m^2/s) of the system.
    pub fn momentum(&self) -> (Vector3<f64>, Vector3<f64>) {
        let cables = self.cables.iter().map(|c| (c.momentum().linear, c.momentum().angular));
        let sum = |a: (Vector3<f64>, Vector3<f64>), b: (Vector3<f64>, Vector3<f64>)| (a.0 + b.0, a.1 + b.1);
        cables.chain(self.bodies.iter().map(RigidBody::momentum)).fold((Vector3::zeros(), Vector3::zeros()), sum)
    }

    /// Energy of the system in J, with the potential of the bodies' constant forces.
    pub fn energy(&self) -> f64 {
        let bodies = self.bodies.iter().map(|b| b.kinetic_energy() - b.force.dot(&b.position));
        self.cables.iter().map(|c| c.energy().total()).chain(bodies).sum()
    }

    /// Largest distance of a node from the anchor it is pinned to, in m.
    pub fn gap(&self) -> f64 {
        let gap = |p: &PinConstraint| {
            (self.cables[p.cable].node_position(p.node) - self.bodies[p.body].point(&p.anchor)).norm()
        };
        self.pins.iter().map(gap).fold(0.0, f64::max)
    }
}

/// A cube of `mass` (kg) and 0.2 m, hung by its top face on a 2 m cable that is pinned at the
/// origin, at rest and horizontal.
pub fn payload(section: Section, mass: f64, integrator: Integrator) -> Scene {
    let cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(section)
        .rule("G5-3".parse().unwrap())
        .fix(At::Start)
        .build()
        .unwrap();
    let mut body = RigidBody::new(mass, cube(mass, 0.2), Vector3::new(2.0, -0.1, 0.0)).unwrap();
    body.force = Vector3::new(0.0, -9.81 * mass, 0.0);
    Scene::new(vec![cable], vec![body], integrator).pin(0, At::End, 0, Vector3::new(0.0, 0.1, 0.0))
}
