//! Static equilibrium of bodies on cables, against the statics of forces.
//!
//! *Physics.* In equilibrium force and moment of every body are zero; a hanging body is at a minimum of the
//! potential energy. *Source.* Hand values and Newton's method on two forces and a moment, written here.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Links, PinConstraint, RigidBody, equilibrium};
use lariat_ancf::{
    At, Cable, CableBuilder, EquilibriumFailure, EquilibriumOptions, Error, PointLoad, Section, Vector3,
};
use nalgebra::{Matrix3, UnitQuaternion};

const G: f64 = 9.81;

fn rope(from: [f64; 3], to: [f64; 3]) -> CableBuilder {
    let section = Section::from_stiffness(5e6, 1.0, 0.6).unwrap();
    Cable::builder().points([Vector3::from(from), Vector3::from(to)]).section(section).elements(5)
}

fn body(mass: f64, at: [f64; 3]) -> RigidBody {
    let mut body = RigidBody::new(mass, Matrix3::identity() * mass * 0.1, Vector3::from(at)).unwrap();
    body.force = Vector3::new(0.0, -G * mass, 0.0);
    body
}

fn pin(cable: usize, node: usize, body: usize, anchor: [f64; 3]) -> PinConstraint {
    PinConstraint { cable, node, body, anchor: Vector3::from(anchor), direction: None }
}

/// Attaches the ends that the pins name, solves, and checks force and moment balance of all bodies.
fn solve(cables: &mut [Cable], bodies: &mut [RigidBody], pins: &[PinConstraint]) -> bool {
    for pin in pins {
        let at = At::Node(pin.node);
        if pin.direction.is_some() {
            cables[pin.cable].attach_clamped(at, None).unwrap();
        } else {
            cables[pin.cable].attach(at).unwrap();
        }
    }
    let mut refs: Vec<&mut Cable> = cables.iter_mut().collect();
    let report =
        equilibrium(&mut refs, bodies, Links { pins, ..Links::default() }, EquilibriumOptions::default()).unwrap();
    let size: f64 = bodies.iter().map(|b| b.force.norm()).sum();
    for (i, body) in bodies.iter().enumerate() {
        let (mut force, mut moment) = (body.force, body.torque);
        for pin in pins.iter().filter(|pin| pin.body == i) {
            let (f, m) = cables[pin.cable].pull(pin.node);
            let arm = body.point(&pin.anchor) - body.position;
            assert!((body.point(&pin.anchor) - cables[pin.cable].node_position(pin.node)).norm() < 1e-12);
            (force, moment) = (force + f, moment + m + arm.cross(&f));
        }
        for x in 0..3 {
            assert!(!body.free[x] || force[x].abs() < 1e-6 * size, "{i}: {force:?} N, {report:?}");
            assert!(!body.free[3 + x] || moment[x].abs() < 1e-6 * size, "{i}: {moment:?} N m, {report:?}");
        }
        assert_eq!(body.velocity, Vector3::zeros());
    }
    println!("{report:?}");
    report.stable
}

/// Green's law: the stretch of a massless cable under a force.
fn stretch(force: f64) -> f64 {
    let mut f = 1.0;
    for _ in 0..50 {
        f -= (5e6 * 0.5 * (f * f - 1.0) * f - force) / (5e6 * (1.5 * f * f - 0.5));
    }
    f
}

/// A box that is drawn anywhere within reach of its rope hangs straight below it, its hook above its centre.
///
/// *Source.* The top carries box and rope, the hook the box; the stretch under the mean force (1e-9 m).
#[test]
fn a_box_hangs_below_its_rope_wherever_it_was_drawn() {
    for (at, tilt) in
        [([0.0, -2.1, 0.0], 0.0), ([1.5, -1.2, 0.4], 0.7), ([-1.8, 0.2, 0.0], -2.0), ([0.3, 1.9, 0.0], 0.1)]
    {
        let mut cables = [rope([0.0; 3], at).length(2.0).fix(At::Start).build().unwrap()];
        let mut bodies = [body(50.0, at)];
        bodies[0].rotation = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, tilt));
        assert!(solve(&mut cables, &mut bodies, &[pin(0, 5, 0, [0.0, 0.1, 0.0])]));
        let expected = -2.0 * stretch((50.0 + 0.6) * G) - 0.1;
        let r = bodies[0].position;
        assert!((r - Vector3::new(0.0, expected, 0.0)).norm() < 1e-7, "{at:?}: {r:?} {expected}");
        let top = cables[0].reactions().unwrap()[0].force.y;
        assert!(
            (top / (51.2 * G) - 1.0).abs() < 1e-8 && (cables[0].pull(5).0.y / (50.0 * G) - 1.0).abs() < 1e-8,
            "{top}"
        );
    }
}

/// A box exactly above its pin, on a rope in compression, falls down from there.
///
/// *Source.* Only the hanging box is at a minimum of the energy.
#[test]
fn a_box_that_stands_on_its_rope_ends_below_it() {
    let mut cables = [rope([0.0; 3], [0.0, 2.0, 0.0]).fix(At::Start).build().unwrap()];
    let mut bodies = [body(50.0, [0.0, 2.1, 0.0])];
    assert!(solve(&mut cables, &mut bodies, &[pin(0, 5, 0, [0.0, -0.1, 0.0])]));
    assert!((bodies[0].position.y + 2.1).abs() < 1e-3, "{:?}", bodies[0].position);
}

/// 1000 kg on two slings at 60 degrees.
///
/// *Source.* T = W/(2 sin 60), half of the rope's weight at each end; a symmetric load does not tilt.
#[test]
fn two_slings_carry_a_load_by_the_triangle_of_forces() {
    let (h, drop) = (1.0, 3f64.sqrt());
    let mut cables = [-1.0, 1.0].map(|side| rope([0.0; 3], [side * h, -drop, 0.0]).fix(At::Start).build().unwrap());
    let mut bodies = [body(1000.0, [0.0, -drop - 0.3, 0.0])];
    let pins = [pin(0, 5, 0, [-h, 0.3, 0.0]), pin(1, 5, 0, [h, 0.3, 0.0])];
    assert!(solve(&mut cables, &mut bodies, &pins));
    let expected = (1000.0 + 0.6 * 2.0) * G / (2.0 * 60f64.to_radians().sin());
    for cable in &cables {
        let tension = cable.sample(1.0).unwrap().tension;
        assert!((tension / expected - 1.0).abs() < 2e-3, "{tension} N of {expected}");
    }
    assert!(bodies[0].rotation.angle() < 1e-9 && bodies[0].position.x.abs() < 1e-9, "{:?}", bodies[0]);
}

/// A load with its centre away from the middle of the hooks, on ropes of unequal length.
///
/// *Source.* Two springs of Green's law with half of their weight at the lower end, in a plane: two forces and a
/// moment made zero by Newton's method with differences.
#[test]
fn an_off_centre_load_tilts_as_two_forces_and_a_moment_demand() {
    let (tops, hooks) = ([-1.0, 0.8], [[-0.5, 0.1], [0.2, 0.2]]);
    let lengths = [1.1, 1.4];
    let forces = |u: &Vector3<f64>| {
        let (s, c) = u.z.sin_cos();
        let mut out = Vector3::new(0.0, -G * 50.0, 0.0);
        for k in 0..2 {
            let [a, b] = hooks[k];
            let lever = nalgebra::Vector2::new(c * a - s * b, s * a + c * b);
            let line = nalgebra::Vector2::new(tops[k], 0.0) - u.xy() - lever;
            let f = line.norm() / lengths[k];
            let pull =
                line.normalize() * (5e6 * 0.5 * (f * f - 1.0) * f) - nalgebra::Vector2::y() * (0.3 * lengths[k] * G);
            out += Vector3::new(pull.x, pull.y, lever.x * pull.y - lever.y * pull.x);
        }
        out
    };
    let mut u = Vector3::new(0.0, -1.2, 0.0);
    for _ in 0..400 {
        let now = forces(&u);
        let jacobian = Matrix3::from_columns(&[0, 1, 2].map(|k| {
            let mut moved = u;
            moved[k] += 1e-8;
            (forces(&moved) - now) / 1e-8
        }));
        let step = jacobian.lu().solve(&now).unwrap();
        u -= step * (0.02 / step.norm()).min(1.0);
    }
    let mut cables: Vec<Cable> = (0..2)
        .map(|k| {
            let hook = [hooks[k][0], -1.0 + hooks[k][1], 0.0];
            rope([tops[k], 0.0, 0.0], hook).length(lengths[k]).fix(At::Start).build().unwrap()
        })
        .collect();
    let mut bodies = [body(50.0, [0.0, -1.0, 0.0])];
    let pins = [pin(0, 5, 0, [-0.5, 0.1, 0.0]), pin(1, 5, 0, [0.2, 0.2, 0.0])];
    assert!(solve(&mut cables, &mut bodies, &pins));
    let (r, angle) = (bodies[0].position, bodies[0].rotation.scaled_axis());
    assert!((r.xy() - u.xy()).norm() < 1e-4 && (angle - Vector3::z() * u.z).norm() < 1e-4, "{r:?} {angle:?} of {u:?}");
}

/// A deck on four ropes, drawn tilted and turned: it comes level, and each rope carries a quarter.
///
/// *Source.* Symmetry.
#[test]
fn a_deck_on_four_ropes_hangs_level() {
    let corners = [[-1.0, 0.0, -0.5], [1.0, 0.0, -0.5], [1.0, 0.0, 0.5], [-1.0, 0.0, 0.5]];
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, 0.3, -0.2));
    let mut bodies = [body(200.0, [0.1, -2.0, 0.05])];
    bodies[0].rotation = turn;
    let mut cables: Vec<Cable> = corners
        .iter()
        .map(|&c| {
            let end = bodies[0].point(&Vector3::from(c));
            rope(c, end.into()).length(2.0).fix(At::Start).build().unwrap()
        })
        .collect();
    let pins: Vec<_> = corners.iter().enumerate().map(|(k, &c)| pin(k, 5, 0, c)).collect();
    assert!(solve(&mut cables, &mut bodies, &pins));
    assert!(bodies[0].rotation.angle() < 1e-6 && bodies[0].position.xz().norm() < 1e-6, "{:?}", bodies[0]);
    for cable in &mut cables {
        let pull = cable.pull(5).0;
        assert!((pull - Vector3::y() * 50.0 * G).norm() < 1e-3, "{pull:?}");
    }
}

/// A body hung from a body, a cable that joins two others at a massless point with a load, a clamped end, and a
/// body that may only move vertically.
///
/// *Source.* The sum of the weights below each rope.
#[test]
fn bodies_hang_from_bodies_and_junctions() {
    let mut cables = [
        rope([0.0; 3], [0.3, -1.0, 0.0]).fix(At::Start).build().unwrap(),
        rope([0.3, -1.2, 0.0], [0.2, -2.2, 0.1])
            .load(PointLoad::force(0.5, Vector3::new(0.0, -20.0, 0.0)))
            .build()
            .unwrap(),
        rope([0.2, -2.2, 0.1], [0.5, -3.0, 0.0]).build().unwrap(),
    ];
    let mut bodies = [
        body(10.0, [0.3, -1.1, 0.0]),
        RigidBody::junction(Vector3::new(0.2, -2.2, 0.1)).unwrap(),
        body(5.0, [0.5, -3.1, 0.0]),
    ];
    let pins = [
        pin(0, 5, 0, [0.0, 0.1, 0.0]),
        pin(1, 0, 0, [0.0, -0.1, 0.0]),
        pin(1, 6, 1, [0.0; 3]),
        pin(2, 0, 1, [0.0; 3]),
        pin(2, 5, 2, [0.0, 0.1, 0.0]),
    ];
    let last = cables[1].nodes() - 1;
    let pins = pins.map(|p| if p.cable == 1 && p.node == 6 { PinConstraint { node: last, ..p } } else { p });
    assert!(solve(&mut cables, &mut bodies, &pins));
    let rope_weight: f64 = cables.iter().map(|c| 0.6 * c.length() * G).sum();
    let top = cables[0].reactions().unwrap()[0].force;
    assert!((top.y / (15.0 * G + 20.0 + rope_weight) - 1.0).abs() < 1e-7, "{top:?}");
    assert!(bodies.iter().all(|b| b.position.xz().norm() < 1e-6), "{bodies:?}");
    // clamped to a rod that stands out sideways, and free to move up and down only
    let mut rod = [rope([0.0; 3], [0.5, 0.0, 0.0])
        .section(Section::from_stiffness(1e5, 50.0, 0.1).unwrap())
        .clamp(At::Start)
        .build()
        .unwrap()];
    let mut slider = [body(2.0, [0.6, 0.0, 0.0])];
    slider[0].free = [false, true, false, false, false, false];
    let clamped = PinConstraint { direction: Some(Vector3::x()), ..pin(0, 5, 0, [-0.1, 0.0, 0.0]) };
    assert!(solve(&mut rod, &mut slider, &[clamped]));
    // a beam with both ends clamped that one of them sinks by: F L^3/(12 EI), with half of its own weight
    let sinks = (2.0 + 0.025) * G * 0.5f64.powi(3) / (12.0 * 50.0);
    assert!((slider[0].position.y / -sinks - 1.0).abs() < 0.02, "{:?} of {sinks}", slider[0].position);
    assert_eq!((slider[0].position.x, slider[0].rotation.angle()), (0.6, 0.0));
}

/// What nothing holds is an error that names the resultant, and changes nothing.
#[test]
fn an_island_that_nothing_holds_is_an_error() {
    let mut cable = rope([0.0; 3], [0.0, -1.0, 0.0]).build().unwrap();
    cable.attach(At::End).unwrap();
    let before = cable.snapshot().clone();
    let mut bodies = [body(5.0, [0.0, -1.0, 0.0])];
    let error = equilibrium(
        &mut [&mut cable],
        &mut bodies,
        Links { pins: &[pin(0, 5, 0, [0.0; 3])], ..Links::default() },
        EquilibriumOptions::default(),
    )
    .unwrap_err();
    let Error::NoEquilibrium { failure, residual, .. } = error else { panic!("{error}") };
    assert_eq!(failure, EquilibriumFailure::NotHeld);
    assert!((residual - 5.6 * G).abs() < 1e-9 && *cable.snapshot() == before, "{residual}");
    assert_eq!(bodies[0], body(5.0, [0.0, -1.0, 0.0]));
}

/// A torque turns a deck on four ropes about the vertical, until the ropes, which then slant, turn it back.
///
/// *Source.* Bifilar suspension: each rope's horizontal pull T sin(slant) along the chord of its hook; torque = 4 (W/4) r^2 sin(phi)/h,
/// h the remaining height (Timoshenko & Young, Vibration Problems), without the weight of the ropes and their stretch.
#[test]
fn a_torque_turns_a_deck_until_its_ropes_hold_it() {
    let corners = [[-1.0, 0.0, -0.5], [1.0, 0.0, -0.5], [1.0, 0.0, 0.5], [-1.0, 0.0, 0.5]];
    let mut bodies = [body(200.0, [0.0, -2.0, 0.0])];
    bodies[0].torque = Vector3::new(0.0, 150.0, 0.0);
    let build = |c: [f64; 3]| rope(c, [c[0], -2.0, c[2]]).fix(At::Start).build().unwrap();
    let mut cables: Vec<Cable> = corners.into_iter().map(build).collect();
    let pins: Vec<_> = corners.iter().enumerate().map(|(k, &c)| pin(k, 5, 0, c)).collect();
    assert!(solve(&mut cables, &mut bodies, &pins));
    let turned = bodies[0].rotation.scaled_axis();
    let height = -bodies[0].position.y;
    // half of each rope hangs on its hook
    let expected = (150.0 * height / ((200.0 + 4.0 * 0.6) * G * 1.25)).asin();
    assert!(turned.xz().norm() < 1e-6 && (turned.y / expected - 1.0).abs() < 5e-3, "{turned:?} of {expected}");
}
