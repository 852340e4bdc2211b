//! The ropes that Rapier itself offers: a soft rope, and a chain of capsules on spherical joints.
//!
//! Both are laid along the nodes of a cable, with its mass and with as many parts as it has
//! elements, so that they can be compared with it. Without a [`Skin`] they collide with nothing.

use super::convert::{from_rapier, to_rapier};
use super::engine::rapier::prelude::*;
use lariat_ancf::{Cable, Vector3};

/// What an end of a rope is attached to.
#[derive(Clone, Copy, Debug)]
pub enum End {
    /// Nothing.
    Free,
    /// Its present position.
    Fixed,
    /// Its present position and tangent.
    Clamped,
    /// A point of a body, in body axes in m, by a ball joint.
    On(RigidBodyHandle, [f64; 3]),
    /// A point of a body, in body axes in m, by a clamp.
    ClampedOn(RigidBodyHandle, [f64; 3]),
}

impl End {
    /// Returns the anchor of an end that now is at `at`; Rapier's ropes do not distinguish clamps.
    fn anchor(self, at: &Vector3<f64>) -> Option<Anchor> {
        match self {
            End::Free => None,
            End::Fixed | End::Clamped => Some(Anchor::World((*at).into())),
            End::On(body, point) | End::ClampedOn(body, point) => Some(Anchor::Body(body, point)),
        }
    }
}

/// A point of the world, or of a body, in m.
#[derive(Clone, Copy, Debug)]
enum Anchor {
    World([f64; 3]),
    Body(RigidBodyHandle, [f64; 3]),
}

impl Anchor {
    fn position(&self, world: &PhysicsWorld) -> Option<Vector3<f64>> {
        match self {
            Anchor::World(at) => Some(Vector3::from(*at)),
            Anchor::Body(body, point) => Some(from_rapier(*world.bodies.get(*body)?.position() * to_rapier(*point))),
        }
    }
}

/// With what a rope collides: with all but itself.
#[derive(Clone, Copy, Debug)]
pub struct Skin {
    /// Its radius in m.
    pub radius: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl Skin {
    fn groups() -> InteractionGroups {
        InteractionGroups::new(Group::GROUP_1, Group::ALL.difference(Group::GROUP_1), InteractionTestMode::And)
    }
}

/// The joints between capsules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joints {
    /// Impulse joints, Rapier's default.
    Impulse,
    /// Multibody joints: reduced coordinates.
    Multibody,
}

enum Parts {
    /// A soft body, and the mass between two of its particles in kg.
    Soft(SoftBodyHandle, f64),
    /// Capsules, and the half length of each in m.
    Capsules(Vec<(RigidBodyHandle, f64)>),
}

/// A rope that Rapier itself offers.
pub struct PeerRope {
    parts: Parts,
    /// Unstretched length in m.
    length: f64,
    anchors: [Option<Anchor>; 2],
}

fn nodes(cable: &Cable) -> Vec<Vector3<f64>> {
    (0..cable.nodes()).map(|k| cable.node_position(k)).collect()
}

fn velocity(cable: &Cable, node: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&cable.velocities()[6 * node..6 * node + 3])
}

impl PeerRope {
    /// Inserts a soft rope: particles at the nodes of a cable, edges as long as its elements.
    ///
    /// `frequency` is the natural frequency of the edges in Hz: 30 by default in Rapier, 1e6 in its
    /// joints.
    pub fn soft(world: &mut PhysicsWorld, cable: &Cable, ends: [End; 2], frequency: f64, skin: Option<Skin>) -> Self {
        let nodes = nodes(cable);
        let last = nodes.len() - 1;
        let mass: f64 = cable.elements().iter().map(|e| e.length * e.section.mass_per_length).sum();
        let part = mass / last as f64;
        let mut masses = vec![part as Real; last + 1];
        (masses[0], masses[last]) = (0.5 * part as Real, 0.5 * part as Real);
        let edge_softness = SpringCoefficients::new(frequency as Real, 1.0);
        let material = SoftBodyMaterial { edge_softness, ..SoftBodyMaterial::default() };
        // laid straight first, so that edges have their rest length, then moved to the nodes
        let length = cable.length();
        let along = |k: usize| to_rapier((nodes[0] + Vector3::x() * (length * k as f64 / last as f64)).into());
        let fixed = |end: &End| matches!(end, End::Fixed | End::Clamped);
        let pinned = [0, last].into_iter().zip(&ends).filter(|(_, end)| fixed(end));
        let rope = SoftBodyBuilder::rope(along(0), along(last), last + 1)
            .masses(masses)
            .material(material)
            .pinned_particles(pinned.map(|(k, _)| k as u32))
            .can_sleep(false);
        let rope = match skin {
            None => rope.no_surface_collider(),
            Some(Skin { radius, friction }) => {
                let collider = ColliderBuilder::ball(radius as Real).friction(friction as Real);
                rope.particle_radius(radius as Real).surface_collider(collider.collision_groups(Skin::groups()))
            }
        };
        let handle = world.insert_soft_body(rope);
        let rope = &mut world.soft_bodies[handle];
        for (k, at) in nodes.iter().enumerate() {
            rope.set_particle_position(k, to_rapier((*at).into()));
            rope.set_particle_velocity(k, to_rapier(velocity(cable, k).into()));
        }
        for (k, end) in [0, last].into_iter().zip(&ends) {
            if let End::On(body, _) | End::ClampedOn(body, _) = end {
                world.soft_bodies[handle].attach_particle(k as _, *body, &world.bodies);
            }
        }
        let anchors = [ends[0].anchor(&nodes[0]), ends[1].anchor(&nodes[last])];
        PeerRope { parts: Parts::Soft(handle, part), length, anchors }
    }

    /// Inserts a chain of capsules as long as the elements of a cable are drawn, and as thick as
    /// it.
    pub fn capsules(
        world: &mut PhysicsWorld,
        cable: &Cable,
        ends: [End; 2],
        joints: Joints,
        skin: Option<Skin>,
    ) -> Self {
        let nodes = nodes(cable);
        let last = nodes.len() - 1;
        let anchors = [ends[0].anchor(&nodes[0]), ends[1].anchor(&nodes[last])];
        let thickness = skin.map_or(cable.elements()[0].section.diameter.unwrap_or(0.01), |skin| 2.0 * skin.radius);
        let holder = |world: &mut PhysicsWorld, anchor: &Anchor| match anchor {
            Anchor::World(at) => {
                let body = RigidBodyBuilder::fixed().translation(to_rapier(*at));
                (world.insert_body(body), Pose::IDENTITY)
            }
            Anchor::Body(body, point) => (*body, Pose::from_translation(to_rapier(*point))),
        };
        let mut before = anchors[0].as_ref().map(|anchor| holder(world, anchor));
        let mut capsules = Vec::with_capacity(last);
        for k in 0..last {
            let (a, b) = (nodes[k], nodes[k + 1]);
            let half = 0.5 * (b - a).norm();
            let rotation = nalgebra::UnitQuaternion::rotation_between(&Vector3::y(), &(a - b))
                .unwrap_or_else(|| nalgebra::UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
            let (v, w) = (velocity(cable, k), velocity(cable, k + 1));
            let spin = (b - a).cross(&(w - v)) / (4.0 * half * half).max(1e-12);
            let body = RigidBodyBuilder::dynamic()
                .translation(to_rapier((0.5 * (a + b)).into()))
                .rotation(to_rapier(rotation.scaled_axis().into()))
                .linvel(to_rapier((0.5 * (v + w)).into()))
                .angvel(to_rapier(spin.into()))
                .can_sleep(false);
            let radius = (0.5 * thickness).min(0.45 * half);
            let element = &cable.elements()[k];
            let shape = ColliderBuilder::capsule_y((half - radius) as Real, radius as Real)
                .mass((element.length * element.section.mass_per_length) as Real)
                .friction(skin.map_or(0.5, |skin| skin.friction) as Real)
                .collision_groups(skin.map_or(InteractionGroups::none(), |_| Skin::groups()));
            let (capsule, _) = world.insert(body, shape);
            let top = Pose::from_translation(Vector::Y * half as Real);
            if let Some((body, frame)) = before {
                let frame = Pose { rotation: relative_rotation(world, body, capsule), ..frame };
                connect(world, joints, (body, frame), (capsule, top));
            }
            before = Some((capsule, Pose::from_translation(-Vector::Y * half as Real)));
            capsules.push((capsule, half));
        }
        if let (Some(capsule), Some(anchor)) = (before, &anchors[1]) {
            let (body, frame) = holder(world, anchor);
            let frame = Pose { rotation: relative_rotation(world, body, capsule.0), ..frame };
            connect(world, joints, capsule, (body, frame));
        }
        PeerRope { parts: Parts::Capsules(capsules), length: cable.length(), anchors }
    }

    /// Returns the positions in m of its particles, or of the ends of its capsules.
    pub fn points(&self, world: &PhysicsWorld) -> Vec<Vector3<f64>> {
        match &self.parts {
            Parts::Soft(handle, _) => {
                let rope = world.soft_bodies.get(*handle);
                rope.map_or(Vec::new(), |rope| rope.particle_positions().map(from_rapier).collect())
            }
            Parts::Capsules(capsules) => {
                let end = |(capsule, half): &(RigidBodyHandle, f64), side: f64| {
                    let body = world.bodies.get(*capsule)?;
                    Some(from_rapier(*body.position() * (Vector::Y * (side * half) as Real)))
                };
                let tops = capsules.iter().map(|c| end(c, 1.0));
                tops.chain([capsules.last().and_then(|c| end(c, -1.0))]).flatten().collect()
            }
        }
    }

    /// Returns its length over its unstretched length, minus 1, from anchor to anchor, so that gaps
    /// count.
    pub fn stretch(&self, world: &PhysicsWorld) -> f64 {
        let anchor = |k: usize| self.anchors[k].as_ref().and_then(|anchor| anchor.position(world));
        let mut all: Vec<Vector3<f64>> = anchor(0).into_iter().collect();
        all.extend(self.points(world));
        all.extend(anchor(1));
        all.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>() / self.length - 1.0
    }

    /// Returns the widest gap in m between an end and its anchor.
    pub fn gap(&self, world: &PhysicsWorld) -> f64 {
        let points = self.points(world);
        let distance = |anchor: &Option<Anchor>, end: Option<&Vector3<f64>>| {
            let anchor = anchor.as_ref().and_then(|anchor| anchor.position(world));
            anchor.zip(end).map_or(0.0, |(a, b)| (a - b).norm())
        };
        distance(&self.anchors[0], points.first()).max(distance(&self.anchors[1], points.last()))
    }

    /// Returns the sum of kinetic and gravity energy, and the kinetic energy, of the particles of a
    /// soft rope, in J.
    ///
    /// Capsules are bodies of the world; the strain energy of the edges is not known.
    pub fn energy(&self, world: &PhysicsWorld) -> (f64, f64) {
        let Parts::Soft(handle, part) = &self.parts else { return (0.0, 0.0) };
        let Some(rope) = world.soft_bodies.get(*handle) else { return (0.0, 0.0) };
        let gravity = from_rapier(world.gravity);
        let last = rope.num_particles() - 1;
        let mut sum = (0.0, 0.0);
        for (k, (x, v)) in rope.particle_positions().zip(rope.particle_velocities()).enumerate() {
            let mass = if k == 0 || k == last { 0.5 * part } else { *part };
            let kinetic = 0.5 * mass * from_rapier(v).norm_squared();
            sum = (sum.0 + kinetic - mass * gravity.dot(&from_rapier(x)), sum.1 + kinetic);
        }
        sum
    }

    /// Returns whether every coordinate is finite.
    pub fn is_finite(&self, world: &PhysicsWorld) -> bool {
        self.points(world).iter().all(|p| p.iter().all(|x| x.is_finite()))
    }
}

/// Returns the rotation of a capsule in the axes of a body: multibody joints begin without rotation
/// between their frames.
fn relative_rotation(world: &PhysicsWorld, body: RigidBodyHandle, capsule: RigidBodyHandle) -> Rotation {
    world.bodies[body].rotation().inverse() * *world.bodies[capsule].rotation()
}

fn connect(world: &mut PhysicsWorld, joints: Joints, a: (RigidBodyHandle, Pose), b: (RigidBodyHandle, Pose)) {
    let joint = SphericalJointBuilder::new().local_frame1(a.1).local_frame2(b.1).contacts_enabled(false);
    match joints {
        Joints::Impulse => drop(world.insert_impulse_joint(a.0, b.0, joint)),
        // a closed loop cannot be a multibody: it stays open
        Joints::Multibody => drop(world.insert_multibody_joint(a.0, b.0, joint)),
    }
}
