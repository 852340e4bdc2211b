//! A scene: the world that a drawing becomes, its steps, and what is read from it.

use super::draft::{CUT, Draft, Hold, Kind, LENGTH, RADIUS, Thing, Wound};
use super::feature::Feature;
use crate::single::convert::{from_rapier, to_rapier};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, Cable, CableBuilder, CablePoint, Contact, Damping, Fidelity, ForceDensity, Motion, Reel, Support, Vector3,
    Warning,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Drum, Event, SheaveOptions};
use std::sync::Arc;

/// An error of a scene.
pub type Fault = Box<dyn std::error::Error + Send + Sync>;

/// Spin of a scene that floats, in rad/s.
const SPIN: f64 = 3.0;
/// Radius of a drum in m.
const DRUM: f64 = 0.1;
/// Mass of a body in kg.
const MASS: Real = 0.25;
/// Half side of a body in m.
const HALF: f64 = 0.04;
/// Bodies that the coupling adds are heavier than this, in kg, and belong to no scene.
const HEAVIEST_BODY: f64 = 1e8;

/// A force per length of a program, in N/m: a push that swings in time and grows with height.
#[derive(Debug)]
struct Swing {
    /// When it begins, in s.
    from: f64,
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

/// A world with cables.
#[derive(Default)]
pub struct Scene {
    /// The bodies.
    pub physics: PhysicsWorld,
    /// The cables.
    pub set: CableSet,
    /// Time in s.
    pub time: f64,
    /// Events so far, as far as they tell of energy that was made.
    pub made: Vec<String>,
    /// Cables that are cut, and when in s.
    cuts: Vec<(CableHandle, f64)>,
    /// When the force density of the ropes begins, in s, if they have one.
    forced: Option<f64>,
}

/// Energies and works up to now, in J.
#[derive(Clone, Copy, Debug)]
pub struct Ledger {
    /// Kinetic, strain and gravity energy of all, less all work on it but that of contacts; `None`
    /// where that is not known: of a drum, the energy of what it winds up.
    pub kept: Option<f64>,
    /// Kinetic and strain energy.
    pub scale: f64,
}

impl Scene {
    /// Returns an empty world whose host steps have a length in s.
    pub fn new(dt: f64, floats: bool) -> Scene {
        let mut scene = Scene { physics: PhysicsWorld::new(), set: CableSet::new(), ..Scene::default() };
        scene.physics.integration_parameters.dt = dt as Real;
        if floats {
            scene.physics.gravity = Vector::ZERO;
        }
        scene
    }

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
        for ((cable, at, share), hold) in ends.into_iter().zip([draft.start, draft.end]) {
            self.hold(&draft, cable, (at, share), hold)?;
        }
        if let Some(kind) = draft.middle {
            let body = self.add_body(&draft, kind, 0.75);
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
            self.set.add_sheave((first, At::End), (last, At::Start), SheaveOptions::default())?;
        }
        Ok(())
    }

    fn add_one(&mut self, draft: &Draft, elements: usize) -> Result<(CableHandle, CableHandle), Fault> {
        let rope = self.add_rope(draft, draft.points(), elements)?;
        if let Some(load) = draft.load {
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
        if let Some(load) = draft.load {
            let length = self.set.get(last)?.length();
            let load = lariat_ancf::PointLoad { arc_length: load.arc_length / LENGTH * length, ..load };
            self.set.get_mut(last)?.add_load(load)?;
        }
        Ok((first, last))
    }

    fn add_rope(&mut self, draft: &Draft, points: Vec<Vector3<f64>>, elements: usize) -> Result<CableHandle, Fault> {
        let mut rope = Cable::builder().points(points).section(Draft::section()).elements(elements);
        if let Some(fidelity) = draft.fidelity {
            rope = rope.fidelity(fidelity);
        }
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

    /// Holds an end of a cable.
    fn hold(&mut self, draft: &Draft, cable: CableHandle, (at, share): (At, f64), hold: Hold) -> Result<(), Fault> {
        match hold {
            Hold::Free => {}
            Hold::World if draft.clamps => self.set.get_mut(cable)?.clamp(at)?,
            Hold::World => self.set.get_mut(cable)?.fix(at)?,
            Hold::Clamp => self.set.get_mut(cable)?.clamp(at)?,
            Hold::Motion => {
                let x = draft.point(share);
                let to = x + Vector3::new(0.02, 0.1, 0.05);
                let motion = Motion::hermite(self.time, 0.5, (x, Vector3::zeros()), (to, Vector3::zeros()));
                let cable = self.set.get_mut(cable)?;
                let support = Support { position: Some(motion), ..cable.support(at)? };
                cable.set_support(at, support)?;
            }
            Hold::Body(kind) => {
                let body = self.add_body(draft, kind, share);
                let kind = if draft.clamps { AttachmentKind::Clamp } else { AttachmentKind::Ball };
                self.set.attach_here(&self.physics, cable, at, body, kind)?;
            }
        }
        Ok(())
    }

    /// Adds a body at a share of the drawing, beside the rope, so that the rope is on its face.
    fn add_body(&mut self, draft: &Draft, kind: Kind, share: f64) -> RigidBodyHandle {
        let point = draft.point(share);
        let aside = if share < 1.0 { Vector3::new(0.0, 0.0, HALF) } else { Vector3::new(HALF, 0.0, 0.0) };
        let aside = if share == 0.0 { Vector3::new(-HALF, 0.0, 0.0) } else { aside };
        let aside = if draft.hangs && share == 1.0 { Vector3::new(0.0, -HALF, 0.0) } else { aside };
        let aside = if draft.hangs && share == 0.0 { Vector3::new(0.0, HALF, 0.0) } else { aside };
        let centre = point + aside;
        let builder = match kind {
            Kind::Fixed => RigidBodyBuilder::fixed(),
            Kind::Kinematic => RigidBodyBuilder::kinematic_velocity_based().linvel(to_rapier([0.0, 0.1, 0.1])),
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
        body
    }

    /// Puts the end of a cable, which is held by the world or a body, on a drum of 0.4 kg m^2/R^2.
    fn add_drum(&mut self, draft: &Draft, cable: CableHandle, at: At) -> Result<(), Fault> {
        let own = self.set.get(cable)?;
        let eye = own.sample(own.arc_length(at)?)?.position;
        let inertia = (0.4 * DRUM * DRUM) as Real;
        let own = MassProperties::new(Vector::ZERO, 2.0, Vector::splat(inertia));
        let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
        let beside = eye + Vector3::new(0.0, DRUM, 0.0);
        // one that hangs is let go when it changes
        let axes = if draft.hangs { axes | LockedAxes::ROTATION_LOCKED } else { axes };
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
                let mut across = Cable::builder().points(ends).section(Draft::section()).elements(4);
                if !draft.floats {
                    across = across.fix(At::Start).fix(At::End);
                } else {
                    across = across.velocity(Vector3::new(0.0, 1.5, 0.0));
                }
                if let Some(fidelity) = draft.fidelity {
                    across = across.fidelity(fidelity);
                }
                let damping = Damping { axial: 0.03, bending: 0.03 };
                let across = if hangs { across.gravity(Vector3::zeros()).damping(damping) } else { across };
                let across = self.insert(across, "across")?;
                self.set.set_contact(across, contact)?;
            }
        }
        Ok(())
    }

    /// Advances by one host step, after the cuts that are due.
    ///
    /// # Errors
    /// Those of the crates.
    pub fn step(&mut self) -> Result<(), Fault> {
        let due = self.cuts.extract_if(.., |(_, time)| *time < self.time + 1e-4).collect::<Vec<_>>();
        for (cable, _) in due {
            let half = 0.5 * self.set.get(cable)?.length();
            self.set.cut(cable, half)?;
        }
        self.set.step(&mut self.physics)?;
        self.time += f64::from(self.physics.integration_parameters.dt);
        for event in self.set.take_events() {
            if let Event::Warning { warning, .. } = &event
                && matches!(warning, Warning::EnergyMade { .. })
            {
                self.made.push(warning.to_string());
            }
        }
        Ok(())
    }

    /// Returns the first cable that is no other one across it.
    ///
    /// # Errors
    /// None for a scene with one.
    pub fn rope(&self) -> Result<CableHandle, Fault> {
        let rope = self.set.iter().find(|(_, cable)| cable.name().starts_with("rope"));
        rope.map(|(handle, _)| handle).ok_or_else(|| "no rope".into())
    }

    /// Moves, pushes or turns the bodies and the cable that a feature brought to a scene that hangs.
    pub fn disturb(&mut self, feature: Feature) {
        let bodies: Vec<RigidBodyHandle> = self.physics.bodies.iter().map(|(handle, _)| handle).collect();
        for handle in bodies {
            let body = &mut self.physics.bodies[handle];
            let loose = body.gravity_scale() == 0.0;
            if f64::from(body.mass()) > HEAVIEST_BODY {
                continue;
            }
            match feature {
                Feature::KinematicBody | Feature::TouchesMoving if body.is_kinematic() => {
                    body.set_linvel(to_rapier([0.2, 0.0, 0.0]), true);
                }
                Feature::FixedBody if body.is_fixed() => {
                    let to = body.translation() + to_rapier([0.02, 0.0, 0.01]);
                    body.set_translation(to, true);
                }
                Feature::DynamicBody | Feature::ImpulseJoint | Feature::MultibodyJoint if body.is_dynamic() => {
                    body.add_force(to_rapier([0.5, 5.0, 0.0]), true);
                }
                Feature::TouchesLoose if body.is_dynamic() && loose => {
                    body.set_linvel(to_rapier([1.0, 0.0, 0.0]), true);
                }
                Feature::Drum if body.locked_axes().contains(LockedAxes::ROTATION_LOCKED) => {
                    let free = LockedAxes::all() & !LockedAxes::ROTATION_LOCKED_Z;
                    body.set_locked_axes(free, true);
                }
                _ => {}
            }
        }
        let across = self.set.iter().find(|(_, cable)| cable.name().starts_with("across")).map(|(handle, _)| handle);
        if feature == Feature::TouchesCable
            && let Some(cable) = across.and_then(|handle| self.set.get_mut(handle).ok())
        {
            for node in [0, cable.nodes() - 1] {
                let motion = Motion::uniform(self.time, cable.node_position(node), Vector3::x() * 0.3);
                // the ends are held: they take a motion
                let _ = cable.set_motion(node, motion);
            }
        }
    }

    /// Steps to a time in s.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn run_to(&mut self, time: f64) -> Result<(), Fault> {
        let dt = f64::from(self.physics.integration_parameters.dt);
        while self.time < time - 0.5 * dt {
            self.step()?;
        }
        Ok(())
    }

    /// Saves the state and reads it back; the functions of a program are attached anew.
    ///
    /// # Errors
    /// Those of the format.
    pub fn save_and_restore(&mut self) -> Result<(), Fault> {
        let saved = bincode::serialize(&(&self.physics, &self.set))?;
        (self.physics, self.set) = bincode::deserialize(&saved)?;
        // parts that were cut off have the function, too
        let ropes: Vec<CableHandle> =
            self.set.iter().filter(|(_, cable)| cable.name().starts_with("rope")).map(|(handle, _)| handle).collect();
        if let Some(from) = self.forced {
            for cable in ropes {
                self.set.get_mut(cable)?.add_force_density(Arc::new(Swing { from }))?;
            }
        }
        Ok(())
    }

    /// Returns the positions of nine points of each cable, and of each dynamic body.
    pub fn positions(&self) -> Vec<Vector3<f64>> {
        let of = |cable: &Cable| {
            let at = |k: usize| cable.length() * k as f64 / 8.0;
            (0..=8).map(|k| cable.sample(at(k)).map_or(Vector3::repeat(f64::NAN), |s| s.position)).collect::<Vec<_>>()
        };
        let bodies = self.bodies().map(|(_, body)| from_rapier(body.translation()));
        self.set.iter().flat_map(|(_, cable)| of(cable)).chain(bodies).collect()
    }

    /// Returns the centre of mass of cables and dynamic bodies, in m.
    pub fn centre(&self) -> Vector3<f64> {
        let (mut sum, mut mass) = (Vector3::zeros(), 0.0);
        for (_, cable) in self.set.iter() {
            let mut s = 0.0;
            for element in cable.elements() {
                let own = element.length * element.section.mass_per_length;
                // Simpson's rule
                for (share, weight) in [(0.0, 1.0 / 6.0), (0.5, 4.0 / 6.0), (1.0, 1.0 / 6.0)] {
                    let at = cable.sample((s + share * element.length).min(cable.length()));
                    sum += at.map_or(Vector3::repeat(f64::NAN), |sample| sample.position) * (own * weight);
                }
                (s, mass) = (s + element.length, mass + own);
            }
        }
        for (_, body) in self.bodies() {
            sum += from_rapier(body.center_of_mass()) * f64::from(body.mass());
            mass += f64::from(body.mass());
        }
        sum / mass
    }

    /// Returns the dynamic bodies of the scene.
    fn bodies(&self) -> impl Iterator<Item = (RigidBodyHandle, &RigidBody)> {
        let own = |body: &RigidBody| body.is_dynamic() && f64::from(body.mass()) < HEAVIEST_BODY;
        self.physics.bodies.iter().filter(move |(_, body)| own(body))
    }

    /// Returns cables and bodies, to the bit.
    pub fn bits(&self) -> Vec<u64> {
        let cables = self.set.iter().flat_map(|(_, cable)| cable.positions().iter().chain(cable.velocities()).copied());
        let state = |b: &RigidBody| {
            let (x, r, v, w) = (b.translation(), b.rotation(), b.linvel(), b.angvel());
            [x.x, x.y, x.z, r.x, r.y, r.z, r.w, v.x, v.y, v.z, w.x, w.y, w.z].map(f64::from)
        };
        let bodies = self.bodies().flat_map(|(_, body)| state(body));
        cables.chain(bodies).map(f64::to_bits).collect()
    }

    /// Returns energies and works.
    ///
    /// # Errors
    /// Those of the coupling.
    pub fn ledger(&self) -> Result<Ledger, Fault> {
        let energy = self.set.energy(&self.physics)?;
        let cables = &energy.cables;
        let mut work = 0.0;
        for (_, cable) in self.set.iter() {
            let law = cable.energy_law();
            work += cable.effect_work().total() + law.supports + law.obstacles;
            // loads are constant: their work is independent of the run's account, which counts all forces on bodies, too
            for load in cable.loads() {
                work += load.force.dot(&cable.sample(load.arc_length)?.position);
            }
            work += cable.inserted_energy() + cable.reels().map(|reel| reel.work + reel.remeshed).sum::<f64>();
        }
        for (_, attachment) in self.set.attachments() {
            let moves = self.physics.bodies.get(attachment.body()).is_some_and(RigidBody::is_dynamic);
            // what a body that does not give way received from its cable
            work -= if moves { 0.0 } else { attachment.work() };
        }
        let scale = cables.kinetic + cables.axial + cables.bending + energy.bodies_kinetic;
        let known = self.set.drums().next().is_none();
        Ok(Ledger { kept: known.then_some(energy.total() - work), scale })
    }

    /// Returns linear and angular momentum, in kg m/s and kg m^2/s.
    ///
    /// # Errors
    /// Those of the coupling.
    pub fn momentum(&self) -> Result<[Vector3<f64>; 2], Fault> {
        let momentum = self.set.momentum(&self.physics)?;
        Ok([momentum.linear, momentum.angular])
    }

    /// Returns what the weight of all does over a distance of 1 cm, in J: the smallest energy that
    /// others are compared with.
    pub fn least_energy(&self) -> f64 {
        let cable = |c: &Cable| c.elements().iter().map(|e| e.length * e.section.mass_per_length).sum::<f64>();
        let cables: f64 = self.set.iter().map(|(_, c)| cable(c)).sum();
        let bodies: f64 = self.bodies().map(|(_, body)| f64::from(body.mass())).sum();
        0.0981 * (cables + bodies)
    }
}
