//! The energy law of single steps, from any state and with anything that acts, read from the outside.

use crate::common::{Random, rule};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, Cable, Damping, Drag, Effects, Flow, Integrator, LineLoad, LineLoads, Method, Motion, PointLoad, RestPiece,
    RestShape, Section, StepControl, Support, Vector3,
};

const RULES: [&str; 7] = ["projected-3", "projected-T1", "projected-none", "ST2", "L2T2", "G5-3", "exact-2"];

fn steps(longest: f64) -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(longest) }
}

fn cable(name: &str, effects: Effects, longest: f64) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.8, 0.3, 0.0), Vector3::new(1.5, 0.0, 0.4)])
        .section(Section::round(0.01, 1e8, 1500.0).unwrap())
        .elements(9)
        .rule(rule(name))
        .effects(effects)
        .integrator(steps(longest))
        .build()
        .unwrap()
}

/// A state far from a smooth one: nodes off by 0.03 m, slopes by 0.3, velocities of 3 m/s.
fn shake(cable: &mut Cable, random: &mut Random) {
    let by = |x: &[f64], size: [f64; 2], random: &mut Random| -> Vec<f64> {
        x.iter().enumerate().map(|(i, x)| x + size[usize::from(i % 6 >= 3)] * random.next()).collect()
    };
    let q = by(cable.positions(), [0.03, 0.3], random);
    let v = by(cable.velocities(), [3.0, 30.0], random);
    cable.set_coordinates(&q, &v).unwrap();
}

/// Height in m by which the weight of what hardly moves is measured.
pub const HEIGHT: f64 = 1e-3;

/// Mechanical energy and store, and kinetic and strain energy with the weight times 1 mm.
pub fn energies(cable: &Cable) -> [f64; 2] {
    let energy = cable.energy();
    let mass: f64 = cable.elements().iter().map(|e| e.length * e.section.mass_per_length).sum();
    let weight = 9.81 * HEIGHT * mass;
    [energy.total() + cable.energy_in_store(), energy.kinetic + energy.axial + energy.bending + weight]
}

/// Work of everything without potential that can give energy, as the cable accounts for it: all but internal damping.
pub fn work(cable: &Cable) -> f64 {
    let effects = cable.effect_work();
    cable.energy_law().supports + cable.energy_law().loads + effects.total() - effects.damping
}

/// Takes host steps, and returns the largest growth of energy beyond the work, as a share of the largest kinetic and strain energy.
fn broken(cable: &mut Cable, dt: f64, count: usize) -> f64 {
    let (mut largest, mut worst) = (0.0f64, 0.0f64);
    for i in 0..count {
        let ([before, scale], work_before) = (energies(cable), work(cable));
        largest = largest.max(scale);
        cable.step(dt).unwrap();
        let [after, scale] = energies(cable);
        largest = largest.max(scale);
        // the first step puts supports in place
        if i > 0 {
            worst = worst.max(after - before - (work(cable) - work_before));
        }
    }
    worst / largest
}

fn effects(name: &str) -> Vec<(&'static str, Effects)> {
    let bends = !name.ends_with("none");
    let none = Effects::default();
    let damping = Damping { axial: 2e-3, bending: if bends { 2e-3 } else { 0.0 } };
    let wind = Flow::power_law(Vector3::new(12.0, 0.0, 5.0), Vector3::y(), 1.0, 0.2, 10.0);
    let rest = RestShape {
        pieces: vec![
            RestPiece { from: 0.0, stretch: 1.01, curvature: 0.0 },
            RestPiece { from: 0.7, stretch: 0.99, curvature: if bends { 1.5 } else { 0.0 } },
        ],
    };
    let lines = LineLoads(vec![LineLoad::uniform(Vector3::new(0.0, 0.0, 3.0))]);
    vec![
        ("none", none.clone()),
        ("damping", Effects { damping: Some(damping), ..none.clone() }),
        ("still air", Effects { drag: Some(Drag::new(1.2, 1.2, 0.05, Flow::default())), ..none.clone() }),
        ("wind", Effects { drag: Some(Drag::new(1.2, 1.2, 0.05, wind.clone())), ..none.clone() }),
        ("rest shape", Effects { rest_shape: Some(rest.clone()), ..none.clone() }),
        (
            "all",
            Effects {
                damping: Some(damping),
                drag: Some(Drag::new(1.2, 1.2, 0.05, wind)),
                rest_shape: Some(rest),
                line_loads: Some(lines),
                ..none
            },
        ),
    ]
}

/// Energy and store grow by no more than the work, for every rule and effect, and steps from 1 ms to 1 s.
///
/// *Source.* The energy law; the energies by their own formulas. The tolerance of a step is 1e-9 of the energy.
#[test]
fn the_energy_law_holds_from_any_state_with_every_rule_and_effect() {
    let mut random = Random::new(11);
    for name in RULES {
        for (what, effects) in effects(name) {
            for h in [1e-3, 1.0 / 240.0, 1.0 / 30.0, 1.0] {
                let mut cable = cable(name, effects.clone(), h);
                shake(&mut cable, &mut random);
                let worst = broken(&mut cable, h, 12);
                assert!(worst < 1e-8, "{name}, {what}, h = {h}: {worst:e}");
            }
        }
    }
}

/// The same with supports that move, loads that ramp up, and moments, whose work is counted.
///
/// *Source.* As above.
#[test]
fn the_work_of_moving_supports_and_of_loads_is_counted() {
    let mut random = Random::new(12);
    for name in RULES {
        for h in [1e-3, 1.0 / 240.0, 1.0 / 30.0] {
            let mut cable = cable(name, Effects::default(), h);
            shake(&mut cable, &mut random);
            let end = (random.vector(), random.vector() * 3.0);
            let motion = Motion::hermite(0.0, 12.0 * h, (Vector3::zeros(), Vector3::zeros()), end);
            cable.set_support(At::Start, Support { position: Some(motion), ..Support::default() }).unwrap();
            let force = PointLoad { ramp: 6.0 * h, ..PointLoad::force(0.9, Vector3::new(3.0, 5.0, -2.0)) };
            cable.add_load(force).unwrap();
            cable.add_load(PointLoad::moment(1.2, Vector3::new(0.0, 0.02, 0.03))).unwrap();
            let gust = PointLoad::force(0.4, Vector3::new(-2.0, 1.0, 4.0));
            cable.add_load(gust.with_history([[2.0 * h, 1.0], [4.0 * h, -1.0], [9.0 * h, 0.5]])).unwrap();
            let before = (energies(&cable)[0], work(&cable));
            let worst = broken(&mut cable, h, 12);
            let done = work(&cable) - before.1;
            println!("{name}, h = {h}: energy {:.3e} J, work {done:.3e} J", energies(&cable)[0] - before.0);
            assert!(worst < 1e-8, "{name}, h = {h}: {worst:e}");
            assert!(done != 0.0);
        }
    }
}

/// A cable at rest in equilibrium stays there, and no step of it is iterated, rescaled or divided.
///
/// *Source.* Statics.
#[test]
fn a_cable_at_rest_stays_at_rest() {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .length(1.2)
        .section(Section::round(0.01, 1e9, 1500.0).unwrap())
        .fix(At::Start)
        .fix(At::End)
        .integrator(steps(1.0 / 240.0))
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    let start = cable.positions().to_vec();
    for _ in 0..60 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let moved = crate::common::largest_difference(cable.positions(), &start);
    let d = cable.diagnostics();
    println!("moved by {moved:.1e}, {d:?}");
    assert!(moved < 1e-6, "{moved:e}");
    assert_eq!((d.newton_iterations, d.rescaled_steps, d.split_steps), (d.steps, 0, 0));
}
