//! Loops of ropes that hang in each other, and how deep they press into each other.

use crate::bench::steps;
use crate::bodies::World;
use lariat_ancf::{At, Cable, Contact, Damping, PointLoad, Section, Vector3};
use std::f64::consts::PI;

/// Modulus of the ropes in Pa.
const MODULUS: f64 = 1e7;

/// A loop of a rope without weight, 160 radii long, that opens along an axis.
fn open_loop(r: f64, elements: usize, towards: f64, along: Vector3<f64>) -> Cable {
    let points = (-20..=20).map(|i| {
        let y = f64::from(i) / 20.0;
        (Vector3::x() * (towards * (10.0 - 70.0 * y * y)) + along * (30.0 * y)) * r
    });
    let area = PI * r * r;
    let section = Section::from_stiffness(MODULUS * area, 0.25 * MODULUS * area * r * r, 1000.0 * area).unwrap();
    let builder = Cable::builder()
        .points(points)
        .section(section)
        .elements(elements)
        .gravity(Vector3::zeros())
        .damping(Damping { axial: 0.02, bending: 0.02 });
    let builder = if towards > 0.0 { builder.fix(At::Start).fix(At::End) } else { builder };
    let mut cable = builder.build().unwrap();
    cable.set_contact(Contact::with_friction(0.0).with_radius(r).with_cables()).unwrap();
    cable
}

/// Depth in m at a normal force by the law of two ropes in series, of chords of an element of a
/// length (m).
fn depth_of(force: f64, r: f64, length: f64) -> f64 {
    let weight = length / (length / (1.3 * r)).ceil();
    let (stiffness, ramp) = (0.5 * MODULUS * PI / 40.0, 0.02 * r);
    let pressure = force / weight;
    if pressure < 0.5 * stiffness * ramp {
        (2.0 * ramp * pressure / stiffness).sqrt()
    } else {
        0.5 * ramp + pressure / stiffness
    }
}

/// Two loops that are pulled apart within seconds press into each other by the depth of the law at
/// their force, at every mesh, radius and step, while they tighten and slide to the middle of each
/// other; their centre lines are apart by what is left of the radii. What opens after they came
/// together pushes less.
///
/// *Source.* The law of the normal force, for what closes.
#[test]
fn hooked_loops_are_as_deep_as_the_law_says() {
    let cases = [(5e-3, 4, 240.0, 0.006), (5e-3, 8, 240.0, 0.006), (5e-3, 16, 240.0, 0.006)];
    let more = [(5e-3, 40, 240.0, 0.006), (0.02, 16, 240.0, 0.02), (5e-3, 16, 960.0, 0.02)];
    for (r, elements, rate, most) in cases.into_iter().chain(more) {
        let cables = [(1.0, Vector3::y()), (-1.0, Vector3::z())].map(|(x, along)| open_loop(r, elements, x, along));
        let mut world = World::new(cables.into(), vec![]);
        world.integrator = steps(rate);
        let (stiffness, length) = (MODULUS * PI * r * r, world.cables[0].length());
        let hosts = (most * 9600.0) as usize;
        let (mut worst, mut judged, mut before) = (0.0f64, 0, 0.0f64);
        for i in 0..hosts {
            let pull = Vector3::x() * (0.5 * most * stiffness * i as f64 / hosts as f64);
            let loads = [0.0, length].map(|at| PointLoad::force(at, pull));
            world.cables[1].set_loads(&loads).unwrap();
            // one step of the integrator each, in which a contact either closes or opens, unless it is divided
            for _ in 0..(rate / 60.0) as usize {
                let divided = world.cables[0].diagnostics().split_steps;
                world.part(1.0 / rate);
                let whole = world.cables[0].diagnostics().split_steps == divided;
                let touches: Vec<_> = world.cables[0].cable_contacts().collect();
                for touch in touches {
                    let at = |k: usize, s: f64| world.cables[k].sample(s).unwrap().position;
                    let apart = (at(0, touch.arc_length) - at(1, touch.other_arc_length)).norm();
                    let law = depth_of(touch.normal_force, r, length / elements as f64);
                    if whole && touch.depth >= before {
                        (worst, judged) = (worst.max((touch.depth - law) / r), judged + 1);
                    }
                    before = touch.depth;
                    assert!((touch.depth - 2.0 * r + apart).abs() < 0.1 * r, "{apart} {}", touch.depth);
                }
            }
        }
        let [count, crossed] =
            [world.cables[0].cable_contacts().count() as u64, world.cables[0].diagnostics().crossed_steps];
        println!("r {r}, {elements} elements, {rate} Hz: {worst:.4} r deeper than the law, {count} contacts");
        assert!(judged > hosts, "{judged} in {hosts} host steps");
        assert!(worst < 0.01 && crossed == 0 && count > 0, "r {r}, {elements}, {rate} Hz: {worst} {count} {crossed}");
    }
}
