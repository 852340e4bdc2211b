//! Slack ropes that are drawn beside the bodies that they are tied to.

use super::common::{is_left_out_in_double, run};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet, Rope, Warning};

/// A body on which a rope of this length is tied, its other end 2 m away at the same height; the
/// rope's contact is given before or after.
fn tied(
    shape: SharedShape,
    mass: Real,
    anchor: [Real; 3],
    length: f64,
    elements: usize,
    late: bool,
) -> (PhysicsWorld, CableSet, CableHandle) {
    let mut world = PhysicsWorld::new();
    let at = Vector::new(2.0 - anchor[0], -anchor[1], -anchor[2]);
    let collider = ColliderBuilder::new(shape).mass(mass).friction(0.5);
    let (body, _) = world.insert(RigidBodyBuilder::dynamic().translation(at), collider);
    let rope = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .length(length)
        .section(Section::from_stiffness(2e5, 0.05, 0.1).unwrap())
        .elements(elements)
        .damping(Damping { axial: 5e-3, bending: 0.03 })
        .fidelity(Fidelity::Game)
        .fix(At::Start);
    let mut set = CableSet::new();
    let rope = set.insert(rope.build().unwrap());
    let contact = Contact::with_friction(0.4).with_radius(0.01);
    if !late {
        set.set_contact(rope, contact).unwrap();
    }
    set.attach(&world, rope, At::End, body, Vector::from(anchor), AttachmentKind::Ball).unwrap();
    if late {
        set.set_contact(rope, contact).unwrap();
    }
    (world, set, rope)
}

/// A slack rope on a body begins beside it, whatever its shape, mass and mesh, and what
/// falls with it gains no energy.
///
/// *Source.* Conservation of energy: body and rope fall from rest, so the total does not rise above
/// that of the start.
#[test]
fn a_slack_rope_begins_beside_the_body_that_it_is_tied_to() {
    let shapes = [
        (SharedShape::cuboid(0.1, 0.1, 0.1), [0.0, 0.1, 0.0]),
        (SharedShape::ball(0.15), [0.0, 0.15, 0.0]),
        (SharedShape::cuboid(0.2, 0.1, 0.3), [0.1, 0.1, 0.05]),
        (SharedShape::cylinder(0.1, 0.2), [0.0, 0.1, 0.0]),
        // a side face, towards the other end
        (SharedShape::cuboid(0.1, 0.1, 0.1), [-0.1, 0.0, 0.0]),
        (SharedShape::cuboid(0.3, 0.5, 0.7), [-0.3, 0.1, -0.2]),
        (SharedShape::ball(0.3), [-0.3, 0.0, 0.0]),
    ];
    for (k, (shape, anchor)) in shapes.into_iter().enumerate() {
        for (mass, length, elements) in [(10.0, 3.4, 16), (1.0, 2.6, 12), (40.0, 3.0, 30), (5.0, 4.5, 24)] {
            for late in [false, true] {
                let case = format!("shape {k}, {mass} kg, {length} m in {elements}, late: {late}");
                let (mut world, mut set, rope) = tied(shape.clone(), mass, anchor, length, elements, late);
                if late {
                    run(&mut world, &mut set, 1);
                } else {
                    let inside: Vec<_> =
                        set.warnings(&world).into_iter().filter(|w| matches!(w, Warning::InCollider { .. })).collect();
                    assert!(inside.is_empty(), "{case}: {inside:?}");
                    let ends = set.get(rope).unwrap();
                    assert!(ends.node_position(0).norm() < 1e-9);
                    assert!((ends.node_position(elements) - Vector3::new(2.0, 0.0, 0.0)).norm() < 1e-6);
                }
                let start = set.energy(&world).unwrap().total();
                let fall = f64::from(mass) * 9.81;
                let mut most = 0.0f64;
                for _ in 0..90 {
                    set.step(&mut world).unwrap();
                    most = most.max(set.energy(&world).unwrap().total() - start);
                }
                println!("{case}: {most:.2e} J gained");
                // by the rounding of Rapier's positions
                assert!(most < 1e-3 * fall, "{case}: {most} J");
            }
        }
    }
}

/// A slack rope that is clear of its body hangs along gravity as before, and two of the same are
/// the same.
#[test]
fn a_slack_rope_that_is_clear_hangs_along_gravity() {
    let (_, set, rope) = tied(SharedShape::cuboid(0.1, 0.1, 0.1), 10.0, [0.0, -0.1, 0.0], 2.6, 12, false);
    assert!(set.get(rope).unwrap().positions().chunks(6).all(|q| q[2].abs() < 1e-12 && q[1] <= 1e-12));
    let turned = || {
        let (_, set, rope) = tied(SharedShape::ball(0.15), 1.0, [0.0, 0.15, 0.0], 3.4, 16, false);
        set.get(rope).unwrap().positions().to_vec()
    };
    assert_eq!(turned(), turned());
    assert!(turned().chunks(6).any(|q| q[1] > 0.01 || q[2].abs() > 0.01));
}

/// A crate that falls to the ground with slack beside it holds no tension against its own faces and
/// edges: once it rests, its hook carries no more than the rope's weight and friction can hold, unless
/// it lies on it.
///
/// *Source.* Balance of the rope: what hangs between two points on more length than their distance
/// pulls less at its lower end than at its upper one, and at both together its weight; over an edge
/// of the crate friction holds exp(mu pi/2) times as much (Euler-Eytelwein). A crate that lies on its
/// rope puts at most its weight on it.
#[test]
fn a_rope_at_rest_beside_its_crate_has_no_tension_against_it() {
    if is_left_out_in_double() {
        return;
    }
    let hooks = [[-0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [-0.1, 0.1, 0.0], [0.0, 0.0, 0.1], [-0.1, -0.05, 0.1]];
    let (mut clear, mut all, mut wrong) = (0, 0, Vec::new());
    for (k, anchor) in hooks.into_iter().enumerate() {
        for (length, elements, rate) in
            [(3.4, 6, 60), (3.4, 12, 60), (3.8, 16, 30), (3.4, 24, 60), (3.6, 24, 240), (3.8, 48, 120)]
        {
            let cube = SharedShape::cuboid(0.1, 0.1, 0.1);
            let (mut world, mut set, rope) = tied(cube, 10.0, anchor, length, elements, false);
            world.integration_parameters.dt = 1.0 / rate as Real;
            let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Y)).friction(0.5);
            let (ground, _) = world.insert(RigidBodyBuilder::fixed().translation(Vector::new(0.0, -2.5, 0.0)), ground);
            run(&mut world, &mut set, 7 * rate);
            let (mut hook, mut under) = (Vector3::zeros(), 0.0f64);
            for _ in 0..rate {
                set.step(&mut world).unwrap();
                let (_, attachment) = set.attachments().next().unwrap();
                hook += attachment.reading().force / rate as f64;
                let touches = set.contacts(rope).unwrap();
                let on_ground = touches.filter(|(collider, _)| world.colliders[*collider].parent() == Some(ground));
                under = under.max(on_ground.map(|(_, touch)| touch.normal_force).sum());
            }
            let (hook, weight) = (hook.norm(), 0.1 * 9.81 * length);
            let case = format!(
                "hook {k}, {length} m in {elements}, 1/{rate} s: {hook:.2} N of {weight:.2}, {under:.2} on the ground"
            );
            println!("{case}");
            let lies_on_it = under >= weight;
            let most = if lies_on_it { 98.1 + weight } else { weight * (0.4 * core::f64::consts::FRAC_PI_2).exp() };
            (all, clear) = (all + 1, clear + u32::from(!lies_on_it));
            if hook >= most {
                wrong.push(case);
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(2 * clear > all, "{clear} of {all} crates do not lie on their rope");
}

/// A crate that comes down on its own slack rope makes no energy, however long the host step: what
/// is pinched between it and the ground stores no more than was given to it.
///
/// *Source.* Conservation of energy: nothing but gravity works on crate and rope, so their total never
/// rises; by a thousandth of what the fall gives, for the pushes by which Rapier takes bodies out of
/// each other.
#[test]
fn a_crate_that_comes_down_on_its_rope_makes_no_energy() {
    let hooks = [[-0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [-0.1, 0.1, 0.0], [0.0, 0.0, 0.1], [-0.1, -0.05, 0.1]];
    let mut wrong = Vec::new();
    for (k, anchor) in hooks.into_iter().enumerate() {
        for (length, elements, rate) in [(3.4, 12, 30), (3.8, 16, 30), (3.8, 24, 30), (3.6, 24, 20), (3.8, 48, 15)] {
            let cube = SharedShape::cuboid(0.1, 0.1, 0.1);
            let (mut world, mut set, _) = tied(cube, 10.0, anchor, length, elements, false);
            world.integration_parameters.dt = 1.0 / rate as Real;
            let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Y)).friction(0.5);
            world.insert(RigidBodyBuilder::fixed().translation(Vector::new(0.0, -2.5, 0.0)), ground);
            let (mut least, mut most) = (f64::INFINITY, 0.0f64);
            for _ in 0..3 * rate {
                set.step(&mut world).unwrap();
                let now = set.energy(&world).unwrap().total();
                (least, most) = (least.min(now), most.max(now - least));
            }
            let case = format!("hook {k}, {length} m in {elements}, 1/{rate} s: {most:.2e} J made");
            println!("{case}");
            if most > 1e-3 * 98.1 * 2.4 {
                wrong.push(case);
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A hook that moves at 0.5 m/s draws slack, kinked ropes of many lengths taut, 4 mm beyond, and stops: it reads at most two and a half times
/// the force of that stretch, in host steps of 1/60 and 1/240 s, and what it reads beyond that force the next element has, too.
///
/// *Source.* Hooke's law; a stretch that is given at once swings to twice its force, and the rope swings up. A wave is longer than an element.
/// Steps whose iteration was cut off read up to five times that force at the hook, beside an element with a tenth of it.
#[test]
fn a_hook_that_draws_a_rope_taut_reads_its_stretch() {
    let (speed, beyond) = (0.5, 4e-3);
    for (k, rate) in (0..60u32).flat_map(|k| [(k, 60u32), (k, 240)]) {
        let slack = 0.2 + 0.0137 * f64::from(k);
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 1.0 / rate as Real;
        let hook = RigidBodyBuilder::kinematic_position_based().translation(Vector::new(0.0, 3.8, 0.0));
        let hook = world.insert_body(hook);
        let mut cables = CableSet::new();
        let rope = Rope::steel(0.008).unstretched_length(3.0 + slack);
        let rope = cables.add_rope(&world, (hook, [0.0, 3.8, 0.0]), [0.0, 0.8, 0.0], rope).unwrap();
        let (from, ends) = (2 * rate, 2.0 + (slack + beyond) / speed);
        let section = Section::wire_rope(0.008).unwrap();
        let stretch = section.axial_stiffness * beyond / (3.0 + slack);
        let (mut most, mut alone) = (0.0f64, 0.0f64);
        for step in 1..=(f64::from(rate) * (ends + 0.5)) as u32 {
            let moved = (speed * f64::from(step.max(from) - from) / f64::from(rate)).min(slack + beyond);
            world.bodies[hook].set_next_kinematic_translation(Vector::new(0.0, (3.8 + moved) as Real, 0.0));
            cables.step(&mut world).unwrap();
            let force = cables.attachment(rope.start.unwrap()).unwrap().force().norm();
            let cable = cables.get(rope.cable).unwrap();
            let next = 1.5 * cable.length() / cable.elements().len() as f64;
            most = most.max(force);
            if force > stretch {
                alone = alone.max(force / cable.sample(next).unwrap().tension.max(0.1 * stretch));
            }
        }
        println!(
            "1/{rate} s, slack {slack:.2} m: {:.2} of {stretch:.0} N, {alone:.2} of the next element",
            most / stretch
        );
        assert!((1.0..2.5).contains(&(most / stretch)), "1/{rate} s, slack {slack:.2} m: {most:.0} of {stretch:.0} N");
        assert!(alone < 2.0, "1/{rate} s, slack {slack:.2} m: {alone:.2}");
    }
}
