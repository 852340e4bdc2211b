//! Lamps that hang asleep until a wind rises.

use super::common::{cable, is_left_out_in_double};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::{At, Damping, Drag, Effects, Flow, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet};

/// A hundred lamps of 1 to 3 kg on lines of 1 to 2 m sleep; a wind rises at 6 s, all wake up, and hang at the angle by hand.
///
/// *Source.* The slope of a line at xi above the lamp is q xi/(W + w xi), with the drag q per length that the normal velocity makes,
/// v cos(angle), and the weights W of the lamp and w of the line per length. The way of the lamp is its integral,
/// q/w (L - W/w ln(1 + w L/W)).
#[test]
fn a_hundred_lamps_wake_in_a_wind_that_rises() {
    if is_left_out_in_double() {
        return;
    }
    let (mut world, mut set) = (PhysicsWorld::new(), CableSet::new());
    world.gravity = Vector::new(0.0, -9.81, 0.0);
    let speed = 8.0;
    let lamps: Vec<_> = (0..100)
        .map(|i| {
            let (x, mass, length) = (f64::from(i), 1.0 + 0.02 * f64::from(i), 1.0 + f64::from(i % 11) / 10.0);
            let lamp = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, -length as Real, 0.0));
            let (lamp, _) = world.insert(lamp, ColliderBuilder::ball(0.05).mass(mass as Real));
            let flow =
                Flow { velocity: Vector3::z() * speed, history: vec![[6.0, 0.0], [9.0, 1.0]], ..Flow::default() };
            let drag = Drag { diameter: Some(0.05), ..Drag::new(1.2, 1.2, 0.0, flow) };
            let line = cable([x, 0.0, 0.0], [x, -length, 0.0], Section::from_stiffness(1e4, 1e-3, 0.05).unwrap())
                .elements(3)
                .fix(At::Start)
                .effects(Effects {
                    drag: Some(drag),
                    damping: Some(Damping { axial: 0.02, bending: 0.2 }),
                    ..Effects::default()
                });
            let line = set.insert(line.build().unwrap());
            set.attach(&world, line, At::End, lamp, Vector3::zeros(), AttachmentKind::Ball).unwrap();
            (line, lamp, x, mass, length)
        })
        .collect();
    world.integration_parameters.dt = 1.0 / 60.0;
    (0..350).for_each(|_| set.step(&mut world).unwrap());
    let asleep = lamps.iter().filter(|lamp| set.is_asleep(lamp.0).unwrap() && world.bodies[lamp.1].is_sleeping());
    assert_eq!(asleep.count(), 100);
    (350..600).for_each(|_| set.step(&mut world).unwrap());
    // they swing about where they would hang
    let mut sums = vec![Vector3::zeros(); lamps.len()];
    for _ in 0..600 {
        set.step(&mut world).unwrap();
        lamps.iter().zip(&mut sums).for_each(|(lamp, sum)| *sum += vector(world.bodies[lamp.1].translation()));
    }
    for ((_, _, x, mass, length), sum) in lamps.into_iter().zip(sums) {
        let (heavy, own) = (mass * 9.81, 0.05 * 9.81);
        let way = |q: f64| q / own * (length - heavy / own * (own * length / heavy).ln_1p());
        let head_on = 0.5 * 1.2 * 1.2 * 0.05 * speed * speed;
        let mut by_hand = way(head_on);
        for _ in 0..9 {
            by_hand = way(head_on * (1.0 - (by_hand / length).powi(2)));
        }
        let at = sum / 600.0;
        assert!((at.x - x).abs() < 1e-4);
        assert!((at.z / by_hand - 1.0).abs() < 0.02, "{mass} kg on {length} m: {} m, by hand {by_hand} m", at.z);
    }
}
