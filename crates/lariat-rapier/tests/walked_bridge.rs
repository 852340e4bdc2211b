//! A rope bridge that someone walks over: what it carries, and what it costs by counts.

use lariat_rapier::lariat_ancf::{At, Cable, Damping, Diagnostics, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableHandle, CableSet};

const PLANK: f64 = 8.0; // kg
const WALKER: f64 = 80.0; // kg
const PACE: f64 = 1.4; // m/s

/// Planks on two ropes with two anchors each, 0.6 m from the next one, and a capsule at one bank.
struct Bridge {
    world: PhysicsWorld,
    cables: CableSet,
    ropes: Vec<CableHandle>,
    ends: Vec<AttachmentHandle>,
    walker: RigidBodyHandle,
    span: f64,
}

impl Bridge {
    fn new(count: u32) -> Self {
        let (span, length) = (0.6 * f64::from(count), 0.62 * f64::from(count));
        let (mut world, mut cables, mut ends) = (PhysicsWorld::new(), CableSet::new(), Vec::new());
        let bank = world.insert_body(RigidBodyBuilder::fixed());
        for x in [-0.5 * span - 1.5, 0.5 * span + 1.5] {
            let ground = ColliderBuilder::cuboid(1.4, 0.5, 1.5).translation(Vector::new(x as Real, -0.5, 0.0));
            world.insert_collider(ground, Some(bank));
        }
        let apart = InteractionGroups::new(Group::GROUP_1, !Group::GROUP_1, InteractionTestMode::And);
        let (mut planks, mut ropes) = (Vec::new(), Vec::new());
        for z in [-0.5, 0.5] {
            let rope = Cable::builder()
                .name(format!("rope at z = {z} m"))
                .points([Vector3::new(-0.5 * span, 0.0, z), Vector3::new(0.5 * span, 0.0, z)])
                .length(length)
                .section(Section::wire_rope(0.012).unwrap())
                .elements(2)
                .damping(Damping { axial: 0.005, bending: 0.05 })
                .fidelity(Fidelity::Game)
                .fix(At::Start)
                .fix(At::End)
                .build()
                .unwrap();
            let rope = cables.insert(rope);
            ropes.push(rope);
            for plank in 0..count {
                let at = length * f64::from(plank + 1) / f64::from(count + 1);
                if planks.len() < count as usize {
                    let middle = cables.get(rope).unwrap().sample(at).unwrap();
                    let (p, slope) = (middle.position, middle.slope.y.atan2(middle.slope.x));
                    let body = RigidBodyBuilder::dynamic()
                        .translation(Vector::new(p.x as Real, p.y as Real, 0.0))
                        .rotation(Vector::new(0.0, 0.0, slope as Real));
                    let shape = ColliderBuilder::cuboid(0.28, 0.02, 0.6).mass(PLANK as Real).collision_groups(apart);
                    planks.push(world.insert(body.can_sleep(false), shape).0);
                }
                for x in [-0.2, 0.2] {
                    let plank = planks[plank as usize];
                    cables.attach_here(&world, rope, at + x, plank, AttachmentKind::Ball).unwrap();
                }
            }
            for end in [At::Start, At::End] {
                ends.push(cables.attach_here(&world, rope, end, bank, AttachmentKind::Ball).unwrap());
            }
        }
        cables.equilibrium(&mut world).unwrap();
        let capsule = ColliderBuilder::capsule_y(0.6, 0.3).mass(WALKER as Real);
        let capsule = capsule.friction(0.0).friction_combine_rule(CoefficientCombineRule::Min);
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(-0.5 * span as Real - 1.0, 0.92, 0.0));
        let (walker, _) = world.insert(body.lock_rotations().can_sleep(false), capsule);
        Bridge { world, cables, ropes, ends, walker, span }
    }

    fn step(&mut self) {
        let body = &mut self.world.bodies[self.walker];
        let fall = body.linvel().y;
        body.set_linvel(Vector::new(PACE as Real, fall, 0.0), true);
        self.cables.step(&mut self.world).unwrap();
    }

    fn place(&self) -> f64 {
        f64::from(self.world.bodies[self.walker].translation().x)
    }

    fn counts(&self) -> Diagnostics {
        *self.cables.get(self.ropes[0]).unwrap().diagnostics()
    }
}

/// While the walker is on the middle of the bridge its ends carry the weight of all, and each host
/// step takes a bounded number of iterations. Prints the mean and the slowest 1 % of host steps.
///
/// *Source.* Statics.
#[test]
fn the_ends_carry_the_walker() {
    let mut bridge = Bridge::new(20);
    let ropes: f64 = bridge
        .ropes
        .iter()
        .map(|rope| {
            let rope = bridge.cables.get(*rope).unwrap();
            rope.length() * rope.elements()[0].section.mass_per_length
        })
        .sum();
    let weight = (20.0 * PLANK + WALKER + ropes) * 9.81;
    let (mut lift, mut walked, mut costs) = (0.0, 0, Vec::new());
    let start = bridge.counts();
    for _ in 0..570 {
        let (clock, before) = (std::time::Instant::now(), bridge.counts());
        bridge.step();
        let after = bridge.counts();
        costs.push((
            clock.elapsed().as_secs_f64() * 1e3,
            after.newton_iterations - before.newton_iterations,
            after.host_steps - before.host_steps,
        ));
        if bridge.place().abs() < 0.25 * bridge.span {
            lift -= bridge.ends.iter().map(|end| bridge.cables.attachment(*end).unwrap().force().y).sum::<f64>();
            walked += 1;
        }
    }
    let total = bridge.counts();
    println!(
        "iterations {}, factorisations {}, indefinite {}, solves {}, steps {}, Rapier steps {}",
        total.newton_iterations - start.newton_iterations,
        total.factorisations - start.factorisations,
        total.indefinite_factorisations - start.indefinite_factorisations,
        total.solves - start.solves,
        total.steps - start.steps,
        total.host_steps - start.host_steps,
    );
    let mean = costs.iter().map(|cost| cost.0).sum::<f64>() / costs.len() as f64;
    let most = |of: fn(&(f64, u64, u64)) -> u64| costs.iter().map(of).max().unwrap_or(0);
    let (iterations, rapier_steps) = (most(|cost| cost.1), most(|cost| cost.2));
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!(
        "mean {mean:.2} ms, slowest 1 % {:.2} ms, at most {iterations} iterations in {rapier_steps} Rapier steps",
        costs[costs.len() - 6].0
    );
    let lift = lift / f64::from(walked);
    println!("the ends carry {lift:.0} N of {weight:.0} N; the walker is at {:.2} m", bridge.place());
    assert!((lift / weight - 1.0).abs() < 0.05, "{lift} N of {weight} N");
    assert!(bridge.place() > 0.5 * bridge.span, "{} m", bridge.place());
}
