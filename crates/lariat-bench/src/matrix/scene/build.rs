//! The world that a drawing becomes.

use super::{Fault, Scene};
use crate::matrix::draft::{CUT, Draft, Hold, Kind, LENGTH, RADIUS, Thing, Wound};
use crate::single::convert::to_rapier;
use lariat_ancf::{
    At, Cable, CableBuilder, CablePoint, Contact, Damping, Fidelity, ForceDensity, Motion, Reel, Support, Vector3,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::water::{BodiesInWater, Immersed};
use lariat_rapier::{AttachmentKind, CableHandle, Drum, SheaveOptions};
use std::sync::Arc;

/// Spin of a scene that floats, in rad/s.
const SPIN: f64 = 3.0;
/// Radius of a drum in m.
const DRUM: f64 = 0.1;
/// Mass of a body in kg.
const MASS: Real = 0.25;
/// Half side of a body in m.
const HALF: f64 = 0.04;
/// Damping in s by which what hangs beside the rope comes to rest.
const CALM: Damping = Damping { axial: 0.03, bending: 0.03 };
/// Friction of a sheave, and inertia of its wheel over the square of its radius in kg.
const WHEEL: [f64; 2] = [0.2, 0.05];
/// Where a cable has a kink, and where another is tied to it, as shares of its last part: not in an
/// element at an eye.
const KINK: f64 = 0.6;
/// See [`KINK`].
const TIE: f64 = 0.45;

/// A body that turns on a path: from rest, along a curve and about an axis that is none of its own.
#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// The body.
    pub body: RigidBodyHandle,
    /// Where it begins, in m.
    pub centre: Vector3<f64>,
    /// When it begins, in s.
    pub from: f64,
}

impl Turning {
    /// Leads the body to where it is at a time in s.
    pub fn lead(&self, physics: &mut PhysicsWorld, time: f64) {
        let since = time - self.from;
        // a body that is led to where it is does not wake up its cable
        let Some(body) = physics.bodies.get_mut(self.body).filter(|_| since > 0.0) else { return };
        let along = |rate: f64| 1.0 - (rate * since).cos();
        let place = self.centre + Vector3::new(0.02 * along(5.0), 0.1 * along(3.0), 0.08 * along(2.0));
        let turn = Vector3::new(0.3, 0.2, 0.8) * along(3.0);
        body.set_next_kinematic_position(Pose::new(to_rapier(place.into()), to_rapier(turn.into())));
    }
}

/// A force per length of a program, in N/m: a push that swings in time and grows with height.
#[derive(Debug)]
pub(super) struct Swing {
    /// When it begins, in s.
    pub from: f64,
}

impl ForceDensity for Swing {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        let time = (at.time - self.from).max(0.0);
        Vector3::new(0.2 * (5.0 * time).sin(), 0.0, 0.3 * at.position.y * (5.0 * time).min(1.0))
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }
}

/// Returns a cable of the section of all through some points, by the fidelity of a drawing.
fn drawn(draft: &Draft, points: Vec<Vector3<f64>>, elements: usize) -> CableBuilder {
    let cable = Cable::builder().points(points).section(Draft::section()).elements(elements);
    match draft.fidelity {
        Some(fidelity) => cable.fidelity(fidelity),
        None => cable,
    }
}

impl Scene {
    /// Adds what a drawing shows.
    ///
    /// # Errors
    /// Those of the crates, for what they refuse.
    pub fn add(&mut self, draft: &Draft) -> Result<(), Fault> {
        self.add_meshed(draft, draft.elements, None)
    }

    /// Adds what a drawing shows with a number of elements, and an integrator in place of its own.
    ///
    /// # Errors
    /// As [`add`](Self::add).
    pub fn add_meshed(&mut self, draft: &Draft, elements: usize, integrator: Option<Fidelity>) -> Result<(), Fault> {
        let mut draft = draft.clone();
        draft.fidelity = integrator.or(draft.fidelity);
        for thing in &draft.things {
            self.add_thing(&draft, *thing)?;
        }
        let (first, last) =
            if draft.sheave { self.add_over_sheave(&draft, elements)? } else { self.add_one(&draft, elements)? };
        let ends = [(first, At::Start, 0.0), (last, At::End, 1.0)];
        for (k, hold) in [draft.start, draft.end].into_iter().enumerate() {
            let (cable, at, share) = ends[k];
            self.hold(&draft, cable, (at, share), (hold, draft.clamps[k]))?;
        }
        if let Some(kind) = draft.middle {
            let body = self.add_body(&draft, kind, 0.75)?;
            let along = if draft.sheave { 0.5 } else { 0.75 };
            let at = along * self.set.get(last)?.length();
            self.set.attach_here(&self.physics, last, At::ArcLength(at), body, AttachmentKind::Ball)?;
        }
        for ((cable, at, _), wound) in ends.into_iter().zip(&draft.wound) {
            match wound {
                None => {}
                Some(Wound::Reel(reel)) => self.set.get_mut(cable)?.add_reel(at, reel.clone())?,
                Some(Wound::Drum) => self.add_drum(&draft, cable, at)?,
            }
        }
        if draft.cut {
            self.cuts.push((last, draft.from + CUT));
        }
        if draft.sheave {
            let none = SheaveOptions::default();
            let heavy = SheaveOptions { friction: WHEEL[0], inertia: WHEEL[1], ..none };
            self.set.add_sheave((first, At::End), (last, At::Start), if draft.heavy { heavy } else { none })?;
        }
        if draft.tied {
            self.tie(&draft, last, elements)?;
        }
        if draft.kink {
            let at = KINK * self.set.get(last)?.length();
            self.set.add_kink(last, At::ArcLength(at))?;
        }
        Ok(())
    }

    /// Ties another cable to a point of one, which hangs from it.
    fn tie(&mut self, draft: &Draft, cable: CableHandle, elements: usize) -> Result<(), Fault> {
        let own = self.set.get(cable)?;
        let at = TIE * own.length();
        let from = own.sample(at)?.position;
        // what is to sleep may not swing
        let aside = if draft.hangs { 0.0 } else { 0.1 };
        let points = vec![from, from + Vector3::new(aside, -0.3, 0.0)];
        let mut tail = drawn(draft, points, elements.div_ceil(2));
        if draft.floats {
            let spin = Vector3::z() * SPIN;
            tail = tail.angular_velocity(spin).velocity(spin.cross(&(from - draft.point(0.0))));
        }
        if draft.hangs {
            tail = tail.damping(CALM);
        }
        let tail = self.insert(tail, "tail")?;
        self.set.join((cable, At::ArcLength(at)), (tail, At::Start))?;
        Ok(())
    }

    fn add_one(&mut self, draft: &Draft, elements: usize) -> Result<(CableHandle, CableHandle), Fault> {
        let rope = self.add_rope(draft, draft.points(), elements)?;
        for load in draft.loads.clone() {
            self.set.get_mut(rope)?.add_load(load)?;
        }
        Ok((rope, rope))
    }

    /// Adds two cables that meet on a fixed body.
    fn add_over_sheave(&mut self, draft: &Draft, elements: usize) -> Result<(CableHandle, CableHandle), Fault> {
        let points = draft.points();
        let parts = match points.as_slice() {
            [a, b] => [vec![*a, (a + b) * 0.5], vec![(a + b) * 0.5, *b]],
            many => [many[..=many.len() / 2].to_vec(), many[many.len() / 2..].to_vec()],
        };
        let block = self.physics.insert_body(RigidBodyBuilder::fixed().translation(to_rapier(parts[1][0].into())));
        let [first, last] = parts;
        let first = self.add_rope(draft, first, elements.div_ceil(2).max(3))?;
        let last = self.add_rope(draft, last, elements.div_ceil(2).max(3))?;
        self.set.attach_here(&self.physics, first, At::End, block, AttachmentKind::Ball)?;
        self.set.attach_here(&self.physics, last, At::Start, block, AttachmentKind::Ball)?;
        for load in draft.loads.clone() {
            let length = self.set.get(last)?.length();
            let load = lariat_ancf::PointLoad { arc_length: load.arc_length / LENGTH * length, ..load };
            self.set.get_mut(last)?.add_load(load)?;
        }
        Ok((first, last))
    }

    fn add_rope(&mut self, draft: &Draft, points: Vec<Vector3<f64>>, elements: usize) -> Result<CableHandle, Fault> {
        let mut rope = drawn(draft, points, elements);
        if draft.floats {
            rope = rope.angular_velocity(Vector3::z() * SPIN);
        }
        let rope = self.insert(rope.effects(draft.effects.clone()), "rope")?;
        if draft.force_density {
            self.set.get_mut(rope)?.add_force_density(Arc::new(Swing { from: draft.from }))?;
            self.forced = Some(draft.from);
        }
        if let Some(strength) = draft.strength {
            self.set.set_strength(rope, strength)?;
        }
        Ok(rope)
    }

    fn insert(&mut self, builder: CableBuilder, name: &str) -> Result<CableHandle, Fault> {
        let count = self.set.iter().count();
        Ok(self.set.insert(builder.name(format!("{name} {count}")).build()?))
    }

    /// Holds an end of a cable, and its direction if it is clamped.
    fn hold(
        &mut self,
        draft: &Draft,
        cable: CableHandle,
        (at, share): (At, f64),
        (hold, clamps): (Hold, bool),
    ) -> Result<(), Fault> {
        match hold {
            Hold::Free => {}
            Hold::World if !clamps => self.set.get_mut(cable)?.fix(at)?,
            Hold::World | Hold::Clamp => self.set.get_mut(cable)?.clamp(at)?,
            Hold::Motion => {
                let x = draft.point(share);
                let to = x + Vector3::new(0.02, 0.1, 0.05);
                let motion = Motion::hermite(self.time, 0.5, (x, Vector3::zeros()), (to, Vector3::zeros()));
                let cable = self.set.get_mut(cable)?;
                let support = Support { position: Some(motion), ..cable.support(at)? };
                cable.set_support(at, support)?;
            }
            Hold::Body(kind) => {
                let body = self.add_body(draft, kind, share)?;
                let kind = if clamps { AttachmentKind::Clamp } else { AttachmentKind::Ball };
                self.set.attach_here(&self.physics, cable, at, body, kind)?;
            }
        }
        Ok(())
    }

    /// Adds a body at a share of the drawing, beside the rope, so that the rope is on its face.
    ///
    /// # Errors
    /// Those of the water.
    fn add_body(&mut self, draft: &Draft, kind: Kind, share: f64) -> Result<RigidBodyHandle, Fault> {
        let point = draft.point(share);
        let aside = if share < 1.0 { Vector3::new(0.0, 0.0, HALF) } else { Vector3::new(HALF, 0.0, 0.0) };
        let aside = if share == 0.0 { Vector3::new(-HALF, 0.0, 0.0) } else { aside };
        let aside = if draft.hangs && share == 1.0 { Vector3::new(0.0, -HALF, 0.0) } else { aside };
        let aside = if draft.hangs && share == 0.0 { Vector3::new(0.0, HALF, 0.0) } else { aside };
        let centre = point + aside;
        let builder = match kind {
            Kind::Fixed => RigidBodyBuilder::fixed(),
            Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based().linvel(to_rapier([0.0, 0.1, 0.1])),
            Kind::Turning => RigidBodyBuilder::kinematic_position_based(),
            _ => RigidBodyBuilder::dynamic(),
        };
        let mut builder = builder.translation(to_rapier(centre.into())).can_sleep(draft.hangs);
        if draft.floats {
            let spin = Vector3::z() * SPIN;
            let velocity = spin.cross(&(centre - draft.point(0.0)));
            builder = builder.linvel(to_rapier(velocity.into())).angvel(to_rapier(spin.into()));
        }
        let half = HALF as Real;
        let body = self.physics.insert(builder, ColliderBuilder::cuboid(half, half, half).mass(MASS)).0;
        if kind == Kind::Turning {
            self.turning.push(Turning { body, centre, from: draft.from });
        }
        if let Some(water) = draft.water.clone().filter(|_| self.physics.bodies[body].is_dynamic()) {
            if self.set.water().is_none() {
                self.set.set_water(BodiesInWater::new(water)?);
            }
            let immersed = Immersed::with_drag_area([0.01; 3]).with_added_mass_along(draft.added_mass);
            let bodies = self.set.water_mut().ok_or("no water")?;
            bodies.insert(&mut self.physics, body, immersed)?;
        }
        if matches!(kind, Kind::Impulse | Kind::Multibody) {
            // an arm of 0.2 m on a hinge beyond it
            let hinge = centre + Vector3::new(0.2, 0.0, 0.0);
            let post = self.physics.insert_body(RigidBodyBuilder::fixed().translation(to_rapier(hinge.into())));
            let joint = RevoluteJointBuilder::new(Vector::Z).local_anchor2(to_rapier([0.2, 0.0, 0.0]));
            if kind == Kind::Impulse {
                self.physics.insert_impulse_joint(post, body, joint);
            } else {
                self.physics.insert_multibody_joint(post, body, joint);
            }
        }
        Ok(body)
    }

    /// Puts the end of a cable, which is held by the world or a body, on a drum of 0.4 kg m^2/R^2.
    fn add_drum(&mut self, draft: &Draft, cable: CableHandle, at: At) -> Result<(), Fault> {
        let own = self.set.get(cable)?;
        let eye = own.sample(own.arc_length(at)?)?.position;
        let inertia = (0.4 * DRUM * DRUM) as Real;
        let own = MassProperties::new(Vector::ZERO, 2.0, Vector::splat(inertia));
        let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
        let beside = eye + Vector3::new(0.0, DRUM, 0.0);
        // one that hangs is let go when it changes; one that can turn has no equilibrium
        let axes = if draft.hangs || draft.rests { axes | LockedAxes::ROTATION_LOCKED } else { axes };
        let wheel =
            RigidBodyBuilder::dynamic().additional_mass_properties(own).locked_axes(axes).can_sleep(draft.hangs);
        let wheel = self.physics.insert_body(wheel.translation(to_rapier(beside.into())));
        let drum = Drum { body: wheel, axis: Vector::Z, radius: DRUM as Real };
        let wound = Reel { stock: Some(9.0), ..Reel::default() };
        Ok(self.set.add_drum(&self.physics.bodies, (cable, at), drum, wound)?)
    }

    /// Adds what the rope can touch.
    fn add_thing(&mut self, draft: &Draft, thing: Thing) -> Result<(), Fault> {
        let middle = draft.point(0.5);
        let at = |x: f64, y: f64, z: f64| to_rapier((middle + Vector3::new(x, y, z)).into());
        let hangs = draft.hangs;
        match thing {
            Thing::Floor => {
                let below = if hangs { -0.6 - 2.0 * HALF - 0.1 } else { -0.08 };
                let body = RigidBodyBuilder::fixed().translation(at(0.0, below - 0.5, 0.0));
                self.physics.insert(body, ColliderBuilder::cuboid(3.0, 0.5, 3.0));
            }
            Thing::Moving => {
                let velocity = if hangs { [0.0; 3] } else { [0.0, 0.3, 0.0] };
                let place = if hangs { at(-0.13, 0.0, 0.0) } else { at(-0.2, -0.2, 0.0) };
                let body = RigidBodyBuilder::kinematic_velocity_based().linvel(to_rapier(velocity)).translation(place);
                self.physics.insert(body, ColliderBuilder::cuboid(0.1, 0.05, 0.3));
            }
            Thing::Loose => {
                let place = if hangs { at(-0.2, 0.0, 0.0) } else { at(-0.1, 0.12, 0.0) };
                let velocity = if hangs { [0.0; 3] } else { [0.0, -1.0, 0.0] };
                let body = RigidBodyBuilder::dynamic().translation(place).can_sleep(hangs);
                let body = body.linvel(to_rapier(velocity)).gravity_scale(if hangs { 0.0 } else { 1.0 });
                self.physics.insert(body, ColliderBuilder::ball(0.08).mass(0.2));
            }
            Thing::Cable => {
                let place = if hangs { Vector3::new(-0.06, 0.0, 0.0) } else { Vector3::new(-0.17, -0.06, 0.0) };
                // on no node of either cable
                let ends = [-0.43, 0.37].map(|z| middle + place + Vector3::z() * z);
                let contact = Contact::with_friction(0.3).with_radius(RADIUS).with_cables();
                let contact = Contact { itself: false, ..contact };
                let mut across = drawn(draft, ends.to_vec(), 4);
                if !draft.floats {
                    across = across.fix(At::Start).fix(At::End);
                } else {
                    across = across.velocity(Vector3::new(0.0, 1.5, 0.0));
                }
                let across = if hangs { across.gravity(Vector3::zeros()).damping(CALM) } else { across };
                let across = self.insert(across, "across")?;
                self.set.set_contact(across, contact)?;
            }
        }
        Ok(())
    }
}
