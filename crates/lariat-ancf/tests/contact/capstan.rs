//! Ropes around drums.

use crate::bench::{GRAVITY, MASS, RADIUS, deepest, rope, run, steps, tension, with};
use lariat_ancf::contact::{Cylinder, Obstacle, RigidMotion};
use lariat_ancf::{At, Cable, Damping, Motion, PointLoad, Section, Support, Vector3, Warning};
use nalgebra::UnitQuaternion;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const DRUM: f64 = 0.1;

/// A drum about the z axis.
fn drum(friction: f64, spin: f64) -> Obstacle {
    let motion = RigidMotion {
        rotation: UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2),
        angular_velocity: Vector3::z() * spin,
        ..RigidMotion::default()
    };
    Obstacle::new(1, Cylinder { half_height: 2.0, radius: DRUM }, Vector3::zeros(), friction).moving(motion)
}

/// A rope around the drum by an angle, 12 elements a turn, with straight ends; and the directions in which its ends point.
fn wrapped(angle: f64, ei: f64) -> (Cable, [Vector3<f64>; 2]) {
    wrapped_around(DRUM, angle, ei, 12.0, 0.25)
}

/// The same around a drum of a radius (m), with a number of elements a turn and straight ends of a length (m).
fn wrapped_around(drum: f64, angle: f64, ei: f64, elements: f64, straight: f64) -> (Cable, [Vector3<f64>; 2]) {
    let middle = drum + RADIUS;
    let element = TAU * middle / elements;
    let pitch = if angle > 6.0 { 3.0 * RADIUS / TAU } else { 0.0 };
    let turn = middle.hypot(pitch);
    let around = (angle * turn / element).round() as usize;
    let straight = (straight / element).round();
    let total = angle * turn + 2.0 * straight * element;
    let at = |s: f64| {
        let phi = ((s - straight * element) / turn).clamp(0.0, angle);
        let out = Vector3::new(phi.cos(), phi.sin(), 0.0);
        let along = (Vector3::new(-phi.sin(), phi.cos(), 0.0) * middle + Vector3::z() * pitch) / turn;
        let beyond = s - straight * element - phi * turn;
        (out * middle + Vector3::z() * (pitch * phi) + along * beyond, along)
    };
    let n = around + 2 * straight as usize;
    let mut cable = rope(ei, &[Vector3::zeros(), Vector3::x() * total], n).gravity(Vector3::zeros()).build().unwrap();
    let q: Vec<f64> = cable
        .node_arc_lengths()
        .iter()
        .flat_map(|s| {
            let (x, t) = at(*s);
            [x.x, x.y, x.z, t.x, t.y, t.z]
        })
        .collect();
    cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
    (cable, [-at(0.0).1, at(total).1])
}

fn pulled(cable: &mut Cable, velocity: Vector3<f64>) {
    let end = cable.node_position(cable.nodes() - 1);
    let motion = Motion::uniform(0.0, end, velocity);
    cable.set_support(At::End, Support { position: Some(motion), ..Support::default() }).unwrap();
}

/// A rope that is dragged over a drum has the tensions of the capstan equation.
///
/// *Source.* T2/T1 = exp(mu phi), Euler-Eytelwein. EI = 1e-3: a stiff rope lifts off earlier, which is physics.
#[test]
fn tensions_around_a_drum_are_those_of_the_capstan_equation() {
    let mut table = Vec::new();
    for friction in [0.1, 0.3, 0.5] {
        for quarters in [1.0, 2.0, 4.0, 6.0] {
            let angle = quarters * FRAC_PI_2;
            let (mut cable, [back, forth]) = wrapped(angle, 1e-3);
            pulled(&mut cable, forth * 0.05);
            cable.add_load(PointLoad::force(0.0, back * 100.0)).unwrap();
            let mut cable = with(cable, vec![drum(friction, 0.0)]);
            let (length, mut ratios, mut host) = (cable.length(), Vec::new(), 0);
            let made = run(&mut cable, 90, |cable| {
                host += 1;
                if host > 45 {
                    ratios.push(tension(cable, length - 0.08) / tension(cable, 0.08));
                }
            });
            let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
            let error = mean / (friction * angle).exp() - 1.0;
            let d = cable.diagnostics();
            println!(
                "mu {friction}, {:.0} deg: {mean:.3}, {:+.2} %, deepest {:.1e}, made {made:.0e}, {:.1} sweeps/host, {} split",
                angle.to_degrees(),
                100.0 * error,
                deepest(&cable),
                d.newton_iterations as f64 / 90.0,
                d.split_steps
            );
            table.push((friction, angle, error));
        }
    }
    for (friction, angle, error) in table {
        assert!(error.abs() < 0.01, "mu {friction}, {angle}: {error}");
    }
}

/// Friction that holds 100 to 300 times the slack tension settles on the normal forces of its own step, with more elements a turn than are advised and steps of up to 1/60 s; where it
/// holds 1000 times that, it does not, and that is told.
///
/// *Source.* exp(mu phi), Euler-Eytelwein, to 2 %, at every host step to 10 %. With the friction of the step before the ratio was between -10 and 2 times that.
#[test]
fn strong_friction_settles_on_its_own_normal_forces() {
    for (friction, degrees, elements, rate, settles) in [
        (0.7, 450.0f64, 24.0, 240.0, true),
        (0.4, 720.0, 24.0, 240.0, true),
        (0.7, 450.0, 24.0, 120.0, true),
        (0.7, 450.0, 24.0, 60.0, true),
        (0.8, 500.0, 24.0, 240.0, false),
    ] {
        let (angle, radius) = (degrees.to_radians(), 0.06);
        let (mut cable, [back, forth]) = wrapped_around(radius, angle, 1e-4, elements, 0.15);
        cable.set_integrator(steps(rate)).unwrap();
        pulled(&mut cable, forth * 0.05);
        cable.add_load(PointLoad::force(0.0, back * 30.0)).unwrap();
        let mut drum = drum(friction, 0.0);
        drum.surface = std::sync::Arc::new(Cylinder { half_height: 2.0, radius });
        let mut cable = with(cable, vec![drum]);
        cable.set_watched(true);
        let (length, mut ratios) = (cable.length(), Vec::new());
        run(&mut cable, 90, |cable| ratios.push(tension(cable, length - 0.05) / tension(cable, 0.05)));
        let exact = (friction * angle).exp();
        let errors: Vec<f64> = ratios[45..].iter().map(|ratio| ratio / exact - 1.0).collect();
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let worst = errors.iter().fold(0.0f64, |most, error| most.max(error.abs()));
        let told = cable.warnings().iter().any(|warning| matches!(warning, Warning::FrictionLags { .. }));
        println!(
            "mu {friction}, {degrees} deg, 1/{rate} s: {mean:+.4}, at most {worst:.3}, told {told}, {:?}",
            cable.diagnostics()
        );
        assert_eq!(told, !settles, "{friction} {degrees} {rate}");
        assert!(!settles || mean.abs() < 0.02 && worst < 0.1, "{friction} {degrees}: {mean} {worst}");
    }
}

/// An element that turns by an eighth of a turn about a drum is told of, with the number that would do; one that turns by a twelfth is not.
///
/// *Source.* The shape: `turn/(2 pi/12)` times as many elements.
#[test]
fn elements_that_are_long_beside_a_drum_are_told_of() {
    for (elements, coarse) in [(8.0, true), (12.0, false)] {
        let (mut cable, [back, forth]) = wrapped_around(DRUM, PI, 1e-3, elements, 0.25);
        for (at, pull) in [(0.0, back), (cable.length(), forth)] {
            cable.add_load(PointLoad::force(at, pull * 100.0)).unwrap();
        }
        let mut cable = with(cable, vec![drum(0.3, 0.0)]);
        cable.set_watched(true);
        run(&mut cable, 30, |_| {});
        let told = cable.warnings().into_iter().find_map(|warning| match warning {
            Warning::CoarseContact { enough, .. } => Some(enough as f64 / cable.elements().len() as f64),
            _ => None,
        });
        println!("{elements} per turn: {told:?}");
        assert_eq!(told.is_some(), coarse, "{elements}");
        assert!(told.is_none_or(|factor| (factor / 1.5 - 1.0).abs() < 0.15), "{told:?}");
    }
}

/// A drum that turns under a rope which is held drags it either way with the same ratio, and friction heats as much as the drum works.
///
/// *Source.* Euler-Eytelwein.
#[test]
fn a_turning_drum_drags_a_rope_that_is_held() {
    for spin in [5.0, -5.0] {
        let (mut cable, [back, _]) = wrapped(PI, 1e-3);
        pulled(&mut cable, Vector3::zeros());
        cable.add_load(PointLoad::force(0.0, back * 100.0)).unwrap();
        let mut cable = with(cable, vec![drum(0.3, spin)]);
        let made = run(&mut cable, 60, |_| {});
        let ratio = tension(&cable, cable.length() - 0.08) / tension(&cable, 0.08);
        let exact = (-0.3 * PI * spin.signum()).exp();
        let before = *cable.energy_law();
        run(&mut cable, 30, |_| {});
        let (work, heat) = {
            let law = cable.energy_law();
            (law.obstacles - before.obstacles, law.contacts - before.contacts)
        };
        // the difference of the tensions acts on the centre line
        let power = 100.0 * (exact - 1.0f64).abs() * 5.0 * (DRUM + RADIUS) * 0.5;
        println!("{spin}: {ratio:.4} for {exact:.4}, made {made:.1e}, work {work:.4}, heat {heat:.4}, {power:.4} J");
        assert!((ratio / exact - 1.0).abs() < 0.01, "{ratio} for {exact}");
        assert!((work / power - 1.0).abs() < 0.02 && (heat / work - 1.0).abs() < 1e-3, "{work} {heat} {power}");
    }
}

/// Five kN at once on both ends press a rope on a drum: it is nowhere deeper than 5 % of its radius, and at rest in 2 s.
///
/// *Source.* 40 (r/R) (T/EA) = 1 % of the radius in the mean; 3 % between the samples.
#[test]
fn five_kilonewtons_at_once_press_a_rope_by_a_few_percent_of_its_radius() {
    let (mut cable, [back, forth]) = wrapped(PI, 0.5);
    cable.add_load(PointLoad::force(0.0, back * 5000.0)).unwrap();
    cable.add_load(PointLoad::force(cable.length(), forth * 5000.0)).unwrap();
    let mut cable = with(cable, vec![drum(0.2, 0.0)]);
    let mut line: f64 = 0.0;
    for _ in 0..120 {
        cable.step(1.0 / 60.0).unwrap();
        for i in 0..=400 {
            let x = cable.sample(cable.length() * f64::from(i) / 400.0).unwrap().position;
            line = line.max(DRUM + RADIUS - x.x.hypot(x.y));
        }
    }
    println!("line {line:.2e} m deep, kinetic {:.1e} J, {:?}", cable.energy().kinetic, cable.diagnostics());
    assert!(line < 0.05 * RADIUS, "{line}");
    assert!(cable.energy().kinetic < 1e-6);
}

/// Two weights on a rope over a drum without friction accelerate as Atwood's.
///
/// *Source.* a = g (m2 - m1)/(m1 + m2), with the rope's own mass on both sides. The weights are the last elements of the rope, 5 and 10 kg.
#[test]
fn weights_over_a_drum_without_friction_fall_as_atwoods() {
    let (straight, _) = wrapped(PI, 1e-3);
    let (length, element) = (straight.length(), straight.elements()[0].length);
    let heavy = |mass: f64| Section::from_stiffness(1e6, 1e-3, mass / element).unwrap();
    let mut cable = rope(1e-3, &[Vector3::zeros(), Vector3::x() * length], straight.elements().len())
        .section_from(0.0, heavy(5.0))
        .section_from(element, Section::from_stiffness(1e6, 1e-3, MASS).unwrap())
        .section_from(length - element, heavy(10.0))
        .build()
        .unwrap();
    cable.set_coordinates(straight.positions(), straight.velocities()).unwrap();
    let mut cable = with(cable, vec![drum(0.0, 0.0)]);
    let speed = |cable: &Cable| cable.velocities()[6 * (cable.nodes() - 1) + 1];
    let mut speeds = Vec::new();
    let made = run(&mut cable, 12, |cable| speeds.push(speed(cable)));
    let (a, exact) =
        ((speeds[2] - speeds[10]) / (8.0 / 60.0), GRAVITY * 5.0 / (15.0 + MASS * (length - 2.0 * element)));
    println!("{a:.4} m/s^2 for {exact:.4}, made {made:.1e}");
    assert!((a / exact - 1.0).abs() < 0.01, "{a} for {exact}");
}

/// A heavy rope that hangs over a fixed drum holds with 0.95 of the longest overhang that friction can carry, and creeps less than 0.1 mm in 4 s; with 1.05 it
/// slides off. It is let go at once, and friction begins a step late: a short end must be long beside the 0.2 mm that it falls by then.
///
/// *Source.* `T' = w R cos f + mu (T + w R sin f)` over half a turn, T = w l at both ends: `l1 = (l2 + c) exp(mu pi) + c`, `c = 2 mu R/(1 + mu^2)`
/// (Euler-Eytelwein with the weight of the rope on the drum).
#[test]
fn a_heavy_rope_holds_up_to_its_critical_overhang() {
    for (mu, radius, short) in [(0.3, 0.1, 0.2), (0.15, 0.15, 0.4)] {
        let reach = radius + RADIUS;
        let c = 2.0 * mu * reach / (1.0 + mu * mu);
        let critical = (short + c) * f64::exp(mu * PI) + c;
        let slid = [0.95, 1.05].map(|share| {
            let long = share * critical;
            let mut points = vec![Vector3::new(-reach, -short, 0.0)];
            points.extend((0..=24).map(|i| {
                let a = PI * (1.0 - f64::from(i) / 24.0);
                Vector3::new(reach * a.cos(), reach * a.sin(), 0.0)
            }));
            points.push(Vector3::new(reach, -long, 0.0));
            let length = short + long + PI * reach;
            let elements = (length / (PI * reach / 12.0)).ceil() as usize;
            let builder = rope(1e-6, &points, elements).damping(Damping { axial: 1e-3, bending: 0.1 });
            let mut drum = Obstacle::new(1, Cylinder { half_height: 0.5, radius }, Vector3::zeros(), mu);
            drum.motion.rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
            let mut cable = with(builder.build().unwrap(), vec![drum]);
            let end = |cable: &Cable| cable.node_position(cable.nodes() - 1).y;
            (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
            let before = end(&cable);
            (0..240).for_each(|_| cable.step(1.0 / 60.0).unwrap());
            before - end(&cable)
        });
        println!("mu {mu}, l1 {critical:.3} m: {:.2e} m with 0.95, {:.2e} m with 1.05", slid[0], slid[1]);
        assert!(slid[0].abs() < 1e-4 && slid[1] > 0.01, "{slid:?}");
    }
}
