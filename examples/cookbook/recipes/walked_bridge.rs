//! A rope bridge of twenty planks that someone walks over.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

const SPAN: f64 = 12.0; // m
const LENGTH: f64 = 12.4; // m
const PLANKS: u32 = 20;
const PLANK: f64 = 8.0; // kg
const WALKER: f64 = 80.0; // kg
const PACE: f64 = 1.4; // m/s

/// Twenty planks, each on two anchors of each of two ropes; a capsule walks from bank to bank.
pub struct WalkedBridge {
    world: PhysicsWorld,
    cables: CableSet,
    ends: Vec<AttachmentHandle>,
    walker: RigidBodyHandle,
    /// Sum of the lift of the ends over the host steps in which the walker is on the planks, in N.
    lift: f64,
    walked: u32,
}

impl WalkedBridge {
    pub fn new() -> Outcome<Self> {
        let (mut world, mut cables, mut ends) = (PhysicsWorld::new(), CableSet::new(), Vec::new());
        let bank = world.insert_body(RigidBodyBuilder::fixed());
        for x in [-0.5 * SPAN - 1.5, 0.5 * SPAN + 1.5] {
            let ground = ColliderBuilder::cuboid(1.4, 0.5, 1.5).translation(Vector::new(x as Real, -0.5, 0.0));
            world.insert_collider(ground, Some(bank));
        }
        // planks do not collide with each other: bodies near others cost more
        let apart = InteractionGroups::new(Group::GROUP_1, !Group::GROUP_1, InteractionTestMode::And);
        let mut planks = Vec::new();
        for z in [-0.5, 0.5] {
            let rope = Cable::builder()
                .name(format!("rope at z = {z} m"))
                .points([Vector3::new(-0.5 * SPAN, 0.0, z), Vector3::new(0.5 * SPAN, 0.0, z)]) // m
                .length(LENGTH)
                .section(Section::wire_rope(0.012)?)
                .elements(2) // each anchor adds a node
                .damping(Damping { axial: 0.005, bending: 0.05 }) // s
                .fidelity(Fidelity::Game)
                .fix(At::Start)
                .fix(At::End)
                .build()?;
            let rope = cables.insert(rope);
            for plank in 0..PLANKS {
                let at = LENGTH * f64::from(plank + 1) / f64::from(PLANKS + 1);
                if planks.len() < PLANKS as usize {
                    let middle = cables.get(rope)?.sample(at)?;
                    let (p, slope) = (middle.position, middle.slope.y.atan2(middle.slope.x));
                    let body = RigidBodyBuilder::dynamic()
                        .translation(Vector::new(p.x as Real, p.y as Real, 0.0))
                        .rotation(Vector::new(0.0, 0.0, slope as Real));
                    let shape = ColliderBuilder::cuboid(0.28, 0.02, 0.6).mass(PLANK as Real).collision_groups(apart);
                    planks.push(world.insert(body.can_sleep(false), shape).0);
                }
                // two anchors per rope: on one, a plank turns over under whoever steps on its edge
                for x in [-0.2, 0.2] {
                    cables.attach_here(&world, rope, at + x, planks[plank as usize], AttachmentKind::Ball)?;
                }
            }
            for end in [At::Start, At::End] {
                ends.push(cables.attach_here(&world, rope, end, bank, AttachmentKind::Ball)?);
            }
        }
        cables.equilibrium(&mut world)?;
        // without friction, as usual for characters: it pushes planks down, and not along the stiff ropes
        let capsule = ColliderBuilder::capsule_y(0.6, 0.3).mass(WALKER as Real);
        let capsule = capsule.friction(0.0).friction_combine_rule(CoefficientCombineRule::Min);
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(-0.5 * SPAN as Real - 1.0, 0.92, 0.0));
        let (walker, _) = world.insert(body.lock_rotations().can_sleep(false), capsule);
        Ok(WalkedBridge { world, cables, ends, walker, lift: 0.0, walked: 0 })
    }

    /// Gives the walker its pace, and leaves its fall to the world.
    fn walk(&mut self) {
        let body = &mut self.world.bodies[self.walker];
        let fall = body.linvel().y;
        body.set_linvel(Vector::new(PACE as Real, fall, 0.0), true);
    }
}

impl Stage for WalkedBridge {
    fn step(&mut self) -> Outcome<()> {
        self.walk();
        self.cables.step(&mut self.world)?;
        let place = self.world.bodies[self.walker].translation();
        if (f64::from(place.x)).abs() < 0.25 * SPAN {
            for &end in &self.ends {
                self.lift -= self.cables.attachment(end)?.force().y;
            }
            self.walked += 1;
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        let ropes: f64 =
            self.cables.iter().map(|(_, rope)| rope.length() * rope.elements()[0].section.mass_per_length).sum();
        let weight = (f64::from(PLANKS) * PLANK + WALKER + ropes) * 9.81;
        let (lift, x) = (self.lift / f64::from(self.walked), f64::from(self.world.bodies[self.walker].translation().x));
        let line = format!("the walker is at {x:.2} m; on the way the ends carry {lift:.0} N of {weight:.0} N");
        if (lift / weight - 1.0).abs() < 0.05 && x > 0.5 * SPAN { Ok(line) } else { Err(line.into()) }
    }
}
