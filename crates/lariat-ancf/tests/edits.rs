//! What a program changes between two steps acts in every method: the discrete gradient, which
//! carries the changes of the last step on, comes to the run of a method that carries nothing.

use lariat_ancf::{
    At, AxialLaw, Buoyancy, Cable, Damping, Drag, Effects, Flow, GravityScale, Integrator, Method, Motion, PointLoad,
    RestShape, Section, SlopeSupport, StepControl, Support, Torsion, Vector3,
};
use nalgebra::Rotation3;

/// A change, by its name.
type Edit = (&'static str, fn(&mut Cable));

const EDITS: &[Edit] = &[
    ("clamp to pin", |cable| hold_end(cable, |held| Support { slope: SlopeSupport::Free, ..held })),
    ("pin amid", |cable| cable.fix(At::Node(4)).unwrap()),
    ("clamp amid", |cable| cable.clamp(At::Node(4)).unwrap()),
    ("release", |cable| hold_end(cable, |_| Support::default())),
    ("move a clamp", |cable| {
        let place = cable.node_position(cable.nodes() - 1) + Vector3::new(0.02, 0.01, -0.01);
        hold_end(cable, |held| Support { position: Some(Motion::fixed(place)), ..held });
    }),
    ("turn a clamp", |cable| {
        let turn = Rotation3::new(Vector3::new(0.05, -0.1, 0.15));
        hold_end(cable, |held| match held.slope {
            SlopeSupport::Direction(along) => Support { slope: SlopeSupport::Direction(turn * along), ..held },
            _ => held,
        });
    }),
    ("lead a clamp", |cable| {
        let place = cable.node_position(cable.nodes() - 1);
        let motion = Motion::uniform(cable.time(), place, Vector3::new(0.5, 0.2, 0.1));
        cable.set_motion(cable.nodes() - 1, motion).unwrap();
    }),
    ("lead a slope", |cable| {
        let slope = cable.sample(cable.length()).unwrap().slope;
        let motion = Motion::uniform(cable.time(), slope, Vector3::new(0.3, -0.4, 0.2));
        hold_end(cable, |held| Support { slope: SlopeSupport::Prescribed(motion), ..held });
    }),
    ("load", |cable| cable.add_load(PointLoad::force(0.5, Vector3::new(0.0, -3.0, 1.0))).unwrap()),
    ("drag", |cable| {
        let mut drag = Drag::new(100.0, 1.2, 0.02, Flow::uniform(Vector3::new(0.5, 0.0, 1.0)));
        drag.diameter = Some(0.02);
        change(cable, |effects| effects.drag = Some(drag));
    }),
    ("damping", |cable| change(cable, |effects| effects.damping = Some(Damping { axial: 1e-3, bending: 1e-2 }))),
    ("Hooke's law", |cable| change(cable, |effects| effects.axial_law = Some(AxialLaw::Hooke))),
    ("gravity", |cable| cable.set_gravity_scale(Some(GravityScale(-1.0))).unwrap()),
    ("buoyancy", |cable| {
        let mut buoyancy = Buoyancy::new(300.0, 1.0);
        buoyancy.area = Some(4e-4);
        cable.set_buoyancy(Some(buoyancy)).unwrap();
    }),
    ("rest shape", |cable| cable.set_rest_shape(Some(RestShape::curved(2.0))).unwrap()),
    ("velocities", |cable| {
        let (q, v) = (cable.positions().to_vec(), cable.velocities().iter().map(|v| -0.7 * v).collect::<Vec<_>>());
        cable.set_coordinates(&q, &v).unwrap();
    }),
    ("node", |cable| assert!(cable.insert_node(0.9).is_ok())),
    ("cut", |cable| drop(cable.cut(At::Node(5)).unwrap())),
];

fn hold_end(cable: &mut Cable, change: impl FnOnce(Support) -> Support) {
    let end = At::Node(cable.nodes() - 1);
    let support = change(cable.support(end).unwrap());
    cable.set_support(end, support).unwrap();
}

fn change(cable: &mut Cable, change: impl FnOnce(&mut Effects)) {
    let mut effects = cable.effects().clone();
    change(&mut effects);
    cable.set_effects(effects).unwrap();
}

/// Runs a slack cable between clamps, changes it twice on the way, and returns places along it, and
/// its twist if it has one.
fn run(edit: fn(&mut Cable), twisted: bool, (method, control): (Method, StepControl)) -> Vec<f64> {
    let torsion = twisted.then(|| Torsion { initial_twist: 0.3, ..Torsion::new(0.02) });
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.5, -0.25, 0.1), Vector3::x()])
        .section(Section::from_stiffness(300.0, 0.03, 0.1).unwrap())
        .elements(8)
        .effects(Effects { torsion, ..Effects::default() })
        .integrator(Integrator { method, control })
        .clamp(At::Start)
        .clamp(At::End)
        .build()
        .unwrap();
    for frame in 0..6 {
        if frame == 3 {
            edit(&mut cable);
        }
        cable.step(1.0 / 60.0).unwrap();
    }
    let place = |k: u32| cable.sample(cable.length() * f64::from(k) / 8.0).unwrap().position;
    let places = (0..=8).flat_map(|k| place(k).iter().copied().collect::<Vec<_>>());
    places.chain(cable.torsion().iter().map(|own| own.twist)).collect()
}

/// With steps a quarter as long the discrete gradient is four times nearer, or more, to the run of
/// a Runge-Kutta method whose error is far smaller, whatever is changed: what it carried on across
/// the change would leave a difference that does not fall.
///
/// *Source.* A method that remembers nothing of the last step.
#[test]
fn what_is_changed_between_steps_acts_in_every_method() {
    for twisted in [false, true] {
        for (name, edit) in EDITS {
            let fine = run(*edit, twisted, (Method::Esdirk4, StepControl::Tolerance(1e-9)));
            let off = |parts| {
                let coarse = run(*edit, twisted, (Method::DiscreteGradient, StepControl::Substeps(parts)));
                assert_eq!(coarse.len(), fine.len(), "{name}");
                coarse.iter().zip(&fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let [coarse, finer] = [64, 256].map(off);
            println!("{name}, twisted {twisted}: {coarse:.1e}, {finer:.1e}");
            assert!(finer < 3e-3 && coarse / finer > 4.0, "{name}, twisted {twisted}: {coarse:e}, {finer:e}");
        }
    }
}
