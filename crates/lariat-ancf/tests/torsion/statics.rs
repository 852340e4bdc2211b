//! Statics of twisted rods against closed forms, and against the continuum solved by shooting.

use lariat_ancf::{At, Cable, Effects, Motion, Section, SlopeSupport, Support, Torsion, Vector3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A weightless rod of 1 m through given positions and slopes at equal arc lengths, both ends
/// clamped.
fn rod(elements: usize, axial: f64, torsion: Torsion, at: impl Fn(f64) -> [Vector3<f64>; 2]) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(axial, 1.0, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
        .build()
        .unwrap();
    let q: Vec<f64> = (0..=elements).flat_map(|i| at(i as f64 / elements as f64)).flat_map(<[f64; 3]>::from).collect();
    cable.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
    for (node, x) in [(At::Start, 0.0), (At::End, 1.0)] {
        let [position, slope] = at(x);
        let slope = SlopeSupport::Direction(slope.normalize());
        cable
            .set_support(node, Support { position: Some(Motion::fixed(position)), slope, ..Support::default() })
            .unwrap();
    }
    cable
}

/// Spins the end of a cable whose twist is known by an angle in rad.
fn twist(cable: &mut Cable, angle: f64) {
    let mut snapshot = serde_json::to_value(cable.snapshot()).unwrap();
    let twist = &mut snapshot["state"]["memory"]["torsion"][0]["twist"];
    *twist = serde_json::json!(twist.as_f64().unwrap() + angle);
    cable.restore(serde_json::from_value(snapshot).unwrap()).unwrap();
}

fn straight(x: f64) -> [Vector3<f64>; 2] {
    [Vector3::new(x, 0.0, 0.0), Vector3::x()]
}

/// Energy, torque, and force of the first support on the cable of the clamped arc.
fn arc(elements: usize) -> (f64, f64, Vector3<f64>) {
    let radius = 1.0 / FRAC_PI_2;
    let mut cable = rod(elements, 1e5, Torsion::new(2.0 / 3.0), |x| {
        let (sin, cos) = (FRAC_PI_2 * x).sin_cos();
        [Vector3::new(radius * sin, radius * (1.0 - cos), 0.0), Vector3::new(cos, sin, 0.0)]
    });
    // as built it is not twisted: the state knows that from here
    cable.equilibrium().unwrap();
    twist(&mut cable, 3.0);
    let steps = 15;
    for k in 1..=steps {
        let share = f64::from(k) / f64::from(steps);
        let end = Vector3::new(radius, radius, 0.0) * (1.0 - share) + Vector3::new(0.45, 0.5, 0.2) * share;
        let support = cable.support(At::End).unwrap();
        cable.set_support(At::End, Support { position: Some(Motion::fixed(end)), ..support }).unwrap();
        let report = cable.equilibrium().unwrap();
        assert!(k < steps || report.stable, "{report:?}");
    }
    let energy = cable.energy();
    (energy.total(), cable.torsion()[0].torque, cable.reactions().unwrap()[0].force)
}

/// An arc between clamps, moved and twisted into space, is right to fourth order in the length of
/// its elements: energy, torque and force.
///
/// *Source.* The extensible continuum (Green strain, EI kappa^2 and GJ tau^2 per material length)
/// by shooting, residual 5e-16: L = EI = 1, EA 1e5, GJ 2/3; an untwisted quarter circle whose end
/// clamp moves to (0.45, 0.5, 0.2) and spins by 3 rad.
#[test]
fn a_twisted_arc_converges_to_the_continuum_in_fourth_order() {
    let force = Vector3::new(17.1032129, 18.3847675, -0.8394107);
    let errors: Vec<[f64; 3]> = [8, 16]
        .map(|elements| {
            let (energy, torque, own) = arc(elements);
            let off = [energy / 8.5788439508 - 1.0, torque / 2.3464509 - 1.0, (own - force).norm() / force.norm()];
            println!("{elements}: U {energy:.9} M {torque:.7} F {own:?}: {off:?}");
            off.map(f64::abs)
        })
        .into();
    for (k, most) in [1e-5, 1e-5, 2e-5].into_iter().enumerate() {
        assert!(errors[1][k] < most, "{k}: {errors:?}");
        assert!((errors[0][k] / errors[1][k]).log2() > 3.7, "{k}: {errors:?}");
    }
}

/// Whether the straight rod under a torque (N m) and a tension (N) between clamps is stable; the
/// end clamp slides along the rod.
fn is_straight_rod_stable(elements: usize, torque: f64, tension: f64) -> bool {
    let stiffness = 0.7;
    let torsion = Torsion { initial_twist: torque / (TAU * stiffness), ..Torsion::new(stiffness) };
    let stretch = tension / 1e7;
    let mut cable = rod(elements, 1e7, torsion, |x| {
        let [position, slope] = straight(x);
        [position * (1.0 + stretch), slope * (1.0 + stretch)]
    });
    cable.equilibrium().unwrap().stable && cable.positions().chunks(6).all(|q| q[1].hypot(q[2]) < 1e-6)
}

/// Critical torque by bisection.
fn critical(elements: usize, tension: f64, about: f64) -> f64 {
    let (mut low, mut high) = (0.9 * about, 1.2 * about);
    while high - low > 1e-6 * about {
        let middle = 0.5 * (low + high);
        if is_straight_rod_stable(elements, middle, tension) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// A clamped rod under torque and tension buckles at Greenhill's torque, to fourth order in the
/// length of its elements.
///
/// *Source.* The characteristic equation of the clamped rod (Greenhill 1883), L = EI = 1: 8.98682
/// without tension (the root of tan(M/2) = M/2), 9.1347301 at T = 1, 10.4288564 at 10, 13.1134998
/// at 30.
#[test]
fn a_twisted_rod_buckles_at_the_torque_of_greenhill() {
    for (tension, exact) in [(0.0, 8.98682), (1.0, 9.1347301), (10.0, 10.4288564), (30.0, 13.1134998)] {
        let errors = [8, 16].map(|elements| critical(elements, tension, exact) / exact - 1.0);
        println!("T = {tension}: {errors:?}");
        assert!(errors[1].abs() < 1e-3, "{errors:?}");
        assert!((errors[0] / errors[1]).log2() > 3.7, "{errors:?}");
    }
}

/// A clamped ring of a twisted rod is unstable beyond Michell's twist, whatever GJ/EI: two modes
/// besides the turn about the clamp, which has no stiffness, cross zero there.
///
/// *Source.* Michell 1889; Zajac 1962: M R/EI = sqrt 3, a twist of 2 pi sqrt 3 EI/GJ.
#[test]
fn a_twisted_ring_leaves_its_plane_at_the_torque_of_michell() {
    for stiffness in [0.77, 1.5] {
        for (share, stable) in [(0.999, true), (1.001, false)] {
            // EI = 1 at R = 1/(2 pi) is a moment of 2 pi
            let axial = 1e4 * TAU * TAU;
            let mut cable = rod(32, axial, Torsion::new(stiffness), |x| {
                let (sin, cos) = (TAU * x).sin_cos();
                [Vector3::new(sin, 1.0 - cos, 0.0) / TAU, Vector3::new(cos, sin, 0.0)]
            });
            cable.equilibrium().unwrap();
            twist(&mut cable, share * TAU * 3.0_f64.sqrt() / stiffness);
            let frequencies = cable.natural_frequencies();
            println!("GJ {stiffness} at {share}: {:?}", &frequencies[..6]);
            let soft = frequencies.iter().filter(|omega| **omega < 1e-3 * frequencies[5]).count();
            assert_eq!(soft, if stable { 1 } else { 3 }, "GJ {stiffness} at {share}: {frequencies:?}");
        }
    }
}

/// A rod of L = EI = 1, GJ 2/3 along a helix of a pitch angle and a number of turns, with the twist
/// of a torque; its radius.
fn helix(alpha: f64, turns: f64, torque: f64) -> (Cable, f64) {
    let (sin, cos) = alpha.sin_cos();
    let radius = cos / (TAU * turns);
    let torsion = Torsion { initial_twist: torque / (TAU * 2.0 / 3.0), ..Torsion::new(2.0 / 3.0) };
    let cable = rod(48, 1e7, torsion, |x| {
        let p = cos / radius * x;
        let [s, c] = [p.sin(), p.cos()];
        [Vector3::new(radius * c, radius * s, sin * x), Vector3::new(-cos * s, cos * c, sin)]
    });
    (cable, radius)
}

/// A helix under the force and torque that hold it stays what it is, where that is stable: 0.75
/// turns under M = 5. One of 1.5 turns, alpha 0.5 and M = 10 solves the same equations, and is left
/// for another shape: it cannot be compared.
///
/// *Source.* Kirchhoff: F = (M - EI tau) kappa/cos(alpha) along the axis, moment about it EI kappa
/// cos(alpha) + M sin(alpha), with the pitch angle alpha, kappa = cos(alpha)^2/R and tau =
/// sin(alpha) cos(alpha)/R. An equilibrium that is not the least of the energy nearby is none that
/// a search of it keeps.
#[test]
fn a_helix_is_held_by_the_wrench_of_kirchhoff() {
    let (alpha, torque): (f64, f64) = (0.8, 5.0);
    let (sin, cos) = alpha.sin_cos();
    let (mut cable, radius) = helix(alpha, 0.75, torque);
    let report = cable.equilibrium().unwrap();
    let reaction = cable.reactions().unwrap()[1];
    let position = cable.node_position(48);
    let moment = reaction.moment + position.cross(&reaction.force);
    let (curvature, pitch) = (cos * cos / radius, sin * cos / radius);
    let exact = [(torque - pitch) * curvature / cos, curvature * cos + torque * sin];
    println!("{report:?} {reaction:?} {moment:?} of {exact:?}");
    assert!(report.stable);
    assert!((reaction.force.z / exact[0] - 1.0).abs() < 1e-4, "{reaction:?} {exact:?}");
    assert!((moment.z / exact[1] - 1.0).abs() < 1e-4, "{moment} {exact:?}");
    let (mut other, _) = helix(0.5, 1.5, 10.0);
    let found = other.equilibrium().map(|report| (report.stable, other.torsion()[0].torque));
    println!("{found:?}");
    assert!(found.is_err() || found.is_ok_and(|(_, torque)| (torque / 10.0 - 1.0).abs() > 0.1));
}
