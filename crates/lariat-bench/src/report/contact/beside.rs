//! The same ropes over a drum as Rapier itself offers them: a soft rope, and chains of capsules.
//!
//! # Measures
//!
//! Two loads hang on a rope over a fixed drum. Without friction the heavier one moves by `x = (m1 - m2)/(2 w) (cosh(k t) - 1)`, `k^2 = 2 w g/(m1 + m2 + m_rope)` (Atwood, with the mass w per length of
//! the rope that changes sides). With friction
//! 0.3 on half a turn the rope holds 3 kg against 2 kg, because `3/2 < exp(0.3 pi)` (Euler, Eytelwein). And 2 kg on both sides must not draw the rope into
//! the drum.

use crate::error::Error;
use crate::numbers::largest;
use crate::single::peers::{End, Joints, PeerRope, Skin};
use crate::table::{Cell, Format, Table, shown};
use cpu_time::ProcessTime;
use lariat_ancf::{At, Cable, Contact, Damping, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::f64::consts::{FRAC_PI_2, PI};

/// Gravity in m/s^2; radius of the rope in m, its mass in kg/m, and how far it hangs down on both sides in m.
const G: f64 = 9.81;
const ROPE: f64 = 0.005;
const MASS: f64 = 0.05;
const HANGS: f64 = 1.0;
/// Gap in radii from which on a rope no longer hangs over the drum.
const THROUGH: f64 = 20.0;

/// A rope over a drum.
struct Setup {
    /// Radius of the drum in m.
    drum: f64,
    /// Loads in kg.
    loads: [f64; 2],
    friction: f64,
    elements: usize,
}

#[derive(Clone, Copy)]
enum Kind {
    Lariat,
    Soft,
    Capsules(Joints),
}

struct Stage {
    world: PhysicsWorld,
    cables: CableSet,
    rope: Option<CableHandle>,
    peer: Option<PeerRope>,
    heavy: RigidBodyHandle,
    drum: f64,
    steps: u32,
    seconds: f64,
}

impl Setup {
    /// Returns the rope, its axis on a circle of a radius in m over the drum.
    fn cable(&self, arm: f64) -> Result<Cable, Error> {
        let mut points = vec![Vector3::new(-arm, -HANGS, 0.0)];
        points.extend((0..=24).map(|i| PI * f64::from(i) / 24.0).map(|a| Vector3::new(-a.cos(), a.sin(), 0.0) * arm));
        points.push(Vector3::new(arm, -HANGS, 0.0));
        let section = Section::from_stiffness(1e6, 1e-3, MASS)?;
        let damping = Damping { axial: 1e-3, bending: 1e-3 };
        Ok(Cable::builder().points(points).section(section).elements(self.elements).damping(damping).build()?)
    }

    /// Returns the speed in m/s of the loads at a time in s, without friction.
    fn speed(&self, time: f64) -> f64 {
        let [one, other] = self.loads;
        let total = one + other + MASS * (2.0 * HANGS + PI * (self.drum + ROPE));
        let rate = (2.0 * MASS * G / total).sqrt();
        (one - other) * rate / (2.0 * MASS) * (rate * time).sinh()
    }

    fn build(&self, kind: Kind) -> Result<Stage, Error> {
        let mut world = PhysicsWorld::new();
        let lying = Vector::new(FRAC_PI_2 as Real, 0.0, 0.0);
        let drum = ColliderBuilder::cylinder(0.2, self.drum as Real).rotation(lying);
        world.insert_collider(drum.friction(self.friction as Real), None);
        let touches = self.drum + ROPE;
        let turn = (2.0 * HANGS + PI * touches) / self.elements as f64 / touches;
        // straight parts lie on the drum with their middles, so that none begins in it
        let arm = if matches!(kind, Kind::Lariat) { touches } else { touches / (0.5 * turn).cos() };
        let cable = self.cable(arm)?;
        let loads = [-arm, arm].into_iter().zip(self.loads).map(|(x, mass)| {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, -HANGS as Real, 0.0));
            let inertia = Vector::splat(0.004 * mass as Real);
            let mass = MassProperties::new(Vector::ZERO, mass as Real, inertia);
            world.insert_body(body.additional_mass_properties(mass).can_sleep(false))
        });
        let loads: Vec<RigidBodyHandle> = loads.collect();
        let (mut cables, mut rope, mut peer) = (CableSet::new(), None, None);
        let ends = [0, 1].map(|k| End::On(loads[k], [0.0; 3]));
        let skin = Some(Skin { radius: ROPE, friction: self.friction });
        match kind {
            Kind::Lariat => {
                let handle = cables.insert(cable);
                cables.set_contact(handle, Contact::with_friction(self.friction).with_radius(ROPE))?;
                for (load, end) in loads.iter().zip([At::Start, At::End]) {
                    cables.attach(&world, handle, end, *load, Vector::ZERO, AttachmentKind::Ball)?;
                }
                rope = Some(handle);
            }
            Kind::Soft => peer = Some(PeerRope::soft(&mut world, &cable, ends, 1e6, skin)),
            Kind::Capsules(joints) => peer = Some(PeerRope::capsules(&mut world, &cable, ends, joints, skin)),
        }
        Ok(Stage { world, cables, rope, peer, heavy: loads[0], drum: self.drum, steps: 0, seconds: 0.0 })
    }
}

impl Stage {
    fn advance(&mut self, time: f64) -> Result<(), Error> {
        while f64::from(self.steps) < 60.0 * time - 0.5 {
            let clock = ProcessTime::now();
            if self.rope.is_some() {
                self.cables.step(&mut self.world)?;
            } else {
                self.world.step();
            }
            self.seconds += clock.elapsed().as_secs_f64();
            self.steps += 1;
        }
        Ok(())
    }

    /// Returns the height of the heavier load in m, and its speed downwards in m/s.
    fn load(&self) -> [f64; 2] {
        let body = &self.world.bodies[self.heavy];
        [f64::from(body.translation().y), -f64::from(body.linvel().y)]
    }

    /// Returns the largest depth of the axis of the rope below where it touches, in its radii.
    fn depth(&self) -> f64 {
        let points: Vec<Vector3<f64>> = match (self.rope.and_then(|rope| self.cables.get(rope).ok()), &self.peer) {
            (Some(rope), _) => (0..=4000)
                .filter_map(|k| rope.sample(rope.length() * f64::from(k) / 4000.0).ok())
                .map(|p| p.position)
                .collect(),
            (None, Some(peer)) => peer.points(&self.world),
            (None, None) => Vec::new(),
        };
        let nearest = |pair: &[Vector3<f64>]| {
            let (a, way) = (pair[0].xy(), (pair[1] - pair[0]).xy());
            let share = (-a.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (self.drum + ROPE - (a + way * share).norm()) / ROPE
        };
        points.windows(2).map(nearest).fold(f64::NEG_INFINITY, largest)
    }
}

/// Measures the table.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Coupling`] if a run fails.
pub fn table() -> Result<Table, Error> {
    let columns = vec![
        shown("rope", "rope", Format::Plain),
        shown("acceleration_m_s2", "acceleration, m/s^2", Format::Short),
        shown("exact_m_s2", "exact", Format::Short),
        shown("creep_m", "slips in 2 s though it holds, m", Format::Scientific(1)),
        shown("depth", "2 kg over 20 mm: depth, radii", Format::Scientific(1)),
        shown("mean_us", "us per host step", Format::Short),
    ];
    let kinds = [
        ("Lariat, game", Kind::Lariat),
        ("soft rope, 1e6 Hz", Kind::Soft),
        ("capsules, impulse joints", Kind::Capsules(Joints::Impulse)),
        ("capsules, multibody joints", Kind::Capsules(Joints::Multibody)),
    ];
    let atwood = Setup { drum: 0.1, loads: [3.0, 2.0], friction: 0.0, elements: 42 };
    let grip = Setup { friction: 0.3, ..atwood };
    let thin = Setup { drum: 0.02, loads: [2.0, 2.0], friction: 0.3, elements: 60 };
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for (name, kind) in kinds {
        let mut stage = atwood.build(kind)?;
        stage.advance(0.25)?;
        let before = stage.load()[1];
        stage.advance(0.75)?;
        let acceleration = (stage.load()[1] - before) / 0.5;
        let mut stage = grip.build(kind)?;
        stage.advance(1.0)?;
        let before = stage.load()[0];
        stage.advance(3.0)?;
        let (slips, mean) = ((stage.load()[0] - before).abs(), stage.seconds / f64::from(stage.steps));
        let mut stage = thin.build(kind)?;
        stage.advance(2.0)?;
        let exact = (atwood.speed(0.75) - atwood.speed(0.25)) / 0.5;
        let depth = stage.depth();
        rows.push(vec![
            name.into(),
            acceleration.into(),
            exact.into(),
            slips.into(),
            if depth < -THROUGH { "fell through".into() } else { depth.into() },
            (1e6 * mean).into(),
        ]);
    }
    Ok(Table { name: "contact_beside", columns, rows })
}
