//! A warm step of the coupling does not allocate.

#[path = "../../lariat-ancf/tests/counting/mod.rs"]
mod counting;

use counting::allocations;
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// Returns the allocations of a host step beside those of Rapier's steps, and the number of these.
fn host_step(set: &mut CableSet, world: &mut PhysicsWorld) -> (u64, u64) {
    let (mut own, mut steps) = (0, 0);
    let mut host = None;
    own += allocations(|| host = Some(set.begin(world).unwrap()));
    let mut host = host.unwrap();
    while host.is_unfinished() {
        own += allocations(|| set.predict_next(world, &mut host).unwrap());
        world.step();
        steps += 1;
        own += allocations(|| set.reconcile(world));
    }
    own += allocations(|| set.finish(world, host).unwrap());
    (own, steps)
}

const TOP: Vector = Vector::new(0.0, 0.2, 0.0);

fn boxed(world: &mut PhysicsWorld, body: RigidBodyBuilder, x: Real, y: Real) -> RigidBodyHandle {
    let body = body.translation(Vector::new(x, y, 0.0)).can_sleep(false);
    world.insert(body, ColliderBuilder::cuboid(0.2, 0.2, 0.2).mass(10.0)).0
}

fn rope(from: Vector3<f64>, to: Vector3<f64>) -> lariat_rapier::lariat_ancf::CableBuilder {
    Cable::builder()
        .points([from, to])
        .length(1.05 * (to - from).norm())
        .elements(10)
        .section(Section::from_stiffness(1e5, 0.1, 0.4).unwrap())
        .damping(Damping { axial: 1e-3, bending: 1e-2 })
}

/// Boxes in the air, on the floor, moved by a velocity or to poses, two on one rope, and one on two ropes: none allocates once warm,
/// except that Rapier's list of the bodies that the host took to change them begins anew in each of its steps.
///
/// *Source.* The contract; of the exception, Rapier alone, one of whose bodies is taken after each step.
#[test]
fn a_warm_host_step_does_not_allocate() {
    let mut alone = PhysicsWorld::new();
    let body = boxed(&mut alone, RigidBodyBuilder::dynamic(), 0.0, 3.0);
    let taken = |world: &mut PhysicsWorld| {
        world.step();
        allocations(|| assert!(world.bodies.get_mut(body).is_some()))
    };
    let of_rapier = (0..20).map(|_| taken(&mut alone)).last().unwrap();
    assert!(of_rapier <= 1);
    for case in ["free", "in contact", "by velocity", "to poses", "two bodies", "two ropes"] {
        for fidelity in [Fidelity::Game, Fidelity::Engineering] {
            let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
            let floor = ColliderBuilder::cuboid(20.0, 0.5, 20.0).translation(Vector::new(0.0, -0.5, 0.0));
            world.insert_collider(floor, None);
            let y = if case == "in contact" { 0.2 } else { 3.0 };
            let kind = match case {
                "by velocity" => RigidBodyBuilder::kinematic_velocity_based().linvel(Vector::new(0.1, 0.0, 0.0)),
                "to poses" => RigidBodyBuilder::kinematic_position_based(),
                _ => RigidBodyBuilder::dynamic(),
            };
            let load = boxed(&mut world, kind, 0.0, y as Real);
            let top = Vector3::new(0.0, y + 0.2, 0.0);
            for side in if case == "two ropes" { vec![-0.5, 0.5] } else { vec![0.0] } {
                let from = top + Vector3::new(side, 1.9, 0.0);
                let rope = rope(from, top).integrator(fidelity).fix(At::Start).build().unwrap();
                let rope = set.insert(rope);
                set.attach(&world, rope, At::End, load, TOP, AttachmentKind::Ball).unwrap();
            }
            if case == "two bodies" {
                let other = boxed(&mut world, RigidBodyBuilder::dynamic(), 1.5, y as Real);
                let across = rope(top, top + Vector3::new(1.5, 0.0, 0.0)).integrator(fidelity).build().unwrap();
                let across = set.insert(across);
                set.attach(&world, across, At::Start, load, TOP, AttachmentKind::Ball).unwrap();
                set.attach(&world, across, At::End, other, TOP, AttachmentKind::Ball).unwrap();
            }
            let mut found = Vec::new();
            for k in 0..150 {
                if case == "to poses" {
                    let x = 0.001 * k as Real;
                    world.bodies[load].set_next_kinematic_translation(Vector::new(x, y as Real, 0.0));
                }
                found.push(host_step(&mut set, &mut world));
            }
            let of_rapier = |steps: u64| of_rapier * steps;
            let late = found[90..].iter().find(|(own, steps)| *own > of_rapier(*steps));
            assert_eq!(late, None, "{case}, {fidelity:?}: {found:?}");
        }
    }
}
