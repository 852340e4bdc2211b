//! Ropes whose tension makes torque: the torque of a held hook, the length of a free one, statics,
//! motion, refusals.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, AxialLaw, Cable, CableBuilder, Damping, Effects, Error, Integrator, Method, PointLoad, Reel, RestShape,
    Section, SlopeSupport, StepControl, Strength, Support, Torsion, Vector3,
};
use std::f64::consts::TAU;

const AXIAL: f64 = 2e5;
const STIFFNESS: f64 = 0.5;
/// c d of a rope of 10 mm.
const FACTOR: f64 = 0.1 * 0.01;
const LOAD: f64 = 400.0;

fn torsion(turns: f64) -> Torsion {
    Torsion { initial_twist: turns, ..Torsion::stranded(STIFFNESS, 0.1, 0.01) }
}

/// A weightless rope of 2 m that hangs down from a clamp.
fn rope(effects: Effects) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
        .section(Section::from_stiffness(AXIAL, 0.5, 0.4).unwrap())
        .elements(5)
        .gravity(Vector3::zeros())
        .effects(effects)
        .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) })
        .clamp(At::Start)
}

/// Such a rope at rest with a load at its end, whose spin is held or not.
fn loaded(turns: f64, held: bool) -> Cable {
    loaded_with(turns, held, None)
}

/// That of a shape without stress.
fn loaded_with(turns: f64, held: bool, rest_shape: Option<RestShape>) -> Cable {
    let effects = Effects { torsion: Some(torsion(turns)), rest_shape, ..Effects::default() };
    let mut cable = rope(effects).build().unwrap();
    if held {
        let slope = SlopeSupport::Direction(-Vector3::y());
        cable.set_support(At::End, Support { slope, ..Support::default() }).unwrap();
    }
    cable
        .add_load(PointLoad { arc_length: 2.0, force: Vector3::new(0.0, -LOAD, 0.0), ..PointLoad::default() })
        .unwrap();
    cable.equilibrium().unwrap();
    cable
}

/// The stretch of a cable, and the tension over it in N.
fn pull(cable: &Cable) -> (f64, f64) {
    let stretch = -cable.node_position(5).y / 2.0;
    (stretch, LOAD / stretch)
}

/// A held hook under load gets the torque c d T, and its rope stretches by EA; a hook that is free
/// to spin gets none, and its rope stretches more, by EA GJ/(GJ + EA (c d)^2), as does one that is
/// held after it was turned back by k T L/GJ. The tension that is read is the load.
///
/// *Source.* By hand: T = EA (eps + k tau), M = k T + GJ tau, with the Green strain eps; the force is
/// T over the stretch.
#[test]
fn a_held_hook_gets_the_torque_of_its_load() {
    let held = loaded(0.0, true);
    let (stretch, over) = pull(&held);
    let strain = 0.5 * (stretch * stretch - 1.0);
    let reading = held.torsion()[0];
    println!("{reading:?}, {} of {over} N", AXIAL * strain);
    assert!((reading.torque / (FACTOR * over) - 1.0).abs() < 1e-6, "{reading:?}");
    assert!((AXIAL * strain / over - 1.0).abs() < 1e-6, "{strain}");
    let mut free = loaded(0.0, false);
    let (stretch, over) = pull(&free);
    let softer = AXIAL * STIFFNESS / (STIFFNESS + AXIAL * FACTOR * FACTOR);
    let strain = 0.5 * (stretch * stretch - 1.0);
    assert!((softer * strain / over - 1.0).abs() < 1e-6, "{strain}");
    // of a rope that does not turn the torque would be a third of this
    let back = -FACTOR * over * 2.0 / STIFFNESS;
    let mut turned = loaded(back / TAU, true);
    println!("{back} rad: {:?}", turned.torsion());
    assert!(turned.torsion()[0].torque.abs() < 1e-6 * FACTOR * over, "{:?}", turned.torsion());
    assert!((turned.torsion()[0].twist_rate - 0.5 * back).abs() < 1e-12);
    assert!((turned.node_position(5) - free.node_position(5)).norm() < 1e-9);
    let mut held = held;
    for cable in [&mut held, &mut free, &mut turned] {
        for s in [0.0, 0.7, 2.0] {
            let tension = cable.sample(s).unwrap().tension;
            assert!((tension / LOAD - 1.0).abs() < 1e-6, "{tension} N at {s} m");
        }
        let torque = cable.torsion().first().map_or(0.0, |reading| reading.torque);
        let reaction = cable.reactions().unwrap()[0];
        assert!((reaction.force.y / LOAD - 1.0).abs() < 1e-6, "{reaction:?}");
        // of the support on the rope, whose axis points down
        assert!((reaction.moment.y - torque).abs() < 1e-6 * FACTOR * LOAD, "{reaction:?} {torque}");
    }
}

/// A rope that is held at its length with a stress-free stretch below 1 is under the tension of
/// the rest, and its torque is that of this tension; under its load it is shorter by it. Its motion
/// keeps the energy law, and its statics are those of motion.
///
/// *Source.* By hand: T = EA (eps - eps0 + k tau) over the stretch, eps0 = (f0^2 - 1)/2.
#[test]
fn a_rest_stretch_pulls_and_turns() {
    let rest = 0.999;
    let shape = Some(RestShape::stretched(rest));
    let built = |turns: f64| {
        let effects = Effects { torsion: Some(torsion(turns)), rest_shape: shape.clone(), ..Effects::default() };
        rope(effects).clamp(At::End).build().unwrap()
    };
    let tension = -AXIAL * 0.5 * (rest * rest - 1.0);
    for turns in [0.0, 0.1] {
        let of_twist = turns * TAU / 2.0;
        let mut held = built(turns);
        held.equilibrium().unwrap();
        let (reading, sample) = (held.torsion()[0], held.sample(0.9).unwrap());
        let pull = tension + AXIAL * FACTOR * of_twist;
        println!("{reading:?} {sample:?}");
        assert!((sample.tension / pull - 1.0).abs() < 1e-9, "{} {pull}", sample.tension);
        let torque = FACTOR * pull + STIFFNESS * of_twist;
        assert!((reading.torque / torque - 1.0).abs() < 1e-9, "{reading:?} {torque}");
        let energy = 2.0 * (0.5 * pull * pull / AXIAL + 0.5 * STIFFNESS * of_twist * of_twist);
        assert!((held.energy().total() / energy - 1.0).abs() < 1e-9, "{:?} {energy}", held.energy());
        assert!((held.reactions().unwrap()[0].force.y / pull - 1.0).abs() < 1e-9);
    }
    let mut cable = loaded_with(0.0, true, shape.clone());
    let (stretch, over) = pull(&cable);
    let strain = 0.5 * (stretch * stretch - rest * rest);
    assert!((AXIAL * strain / over - 1.0).abs() < 1e-6, "{strain}");
    assert!((cable.torsion()[0].torque / (FACTOR * over) - 1.0).abs() < 1e-6);
    // let go, it swings
    cable.clear_loads();
    let total = |cable: &Cable| cable.energy().total() + cable.energy_in_store();
    let (first, law) = (total(&cable), *cable.energy_law());
    for _ in 0..20 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let now = *cable.energy_law();
    let right = |law: &lariat_ancf::integrate::EnergyLaw| law.supports - law.numerical - law.rescaled + law.residual;
    let off = total(&cable) - first - (right(&now) - right(&law));
    assert!(off.abs() < 1e-9 * first && first > 1e-3, "{off:e} of {first}");
}

/// The limit of a rope is compared with the tension that it carries, that of its torque included.
///
/// *Source.* The load.
#[test]
fn a_held_rope_breaks_at_its_tension() {
    for (limit, breaks) in [(1.01 * LOAD, false), (0.99 * LOAD, true)] {
        let mut cable = loaded(0.0, true);
        cable.set_strength(Strength::tension(limit)).unwrap();
        cable.step(1.0 / 60.0).unwrap();
        assert_eq!(cable.overloaded_at().is_some(), breaks, "{limit} N: {:?}", cable.overloaded_at());
    }
}

/// The equilibrium of a sagging rope whose tension makes torque is where its damped motion ends.
///
/// *Source.* Statics and dynamics have one energy.
#[test]
fn statics_are_the_end_of_damped_motion() {
    let effects = Effects {
        torsion: Some(Torsion { damping: 0.2, initial_twist: 0.4, ..Torsion::stranded(0.02, 0.5, 0.02) }),
        damping: Some(Damping { axial: 2e-2, bending: 0.2 }),
        ..Effects::default()
    };
    let built = || {
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::x()])
            .section(Section::from_stiffness(200.0, 0.02, 0.3).unwrap())
            .elements(8)
            .effects(effects.clone())
            .integrator(Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) })
            .clamp(At::Start)
            .clamp(At::End)
            .build()
            .unwrap();
        // the plane of the sag turns: a push out of it
        cable.add_load(PointLoad::force(0.4, Vector3::new(0.0, 0.0, 0.2))).unwrap();
        cable
    };
    let (mut still, mut moved) = (built(), built());
    still.equilibrium().unwrap();
    // the sway of the sag is hardly damped: it is stopped where it is fastest
    let mut kinetic = 0.0;
    for _ in 0..2400 {
        moved.step(1.0 / 60.0).unwrap();
        let before = core::mem::replace(&mut kinetic, moved.energy().kinetic);
        if kinetic < before {
            let q = moved.positions().to_vec();
            moved.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
            kinetic = 0.0;
        }
    }
    let off = still.positions().iter().zip(moved.positions()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let [a, b] = [&still, &moved].map(|cable| cable.torsion()[0]);
    println!("{off:e}, {a:?} {b:?}");
    assert!(off < 1e-6, "{off:e}");
    assert!((a.torque / b.torque - 1.0).abs() < 1e-6 && (a.twist / b.twist - 1.0).abs() < 1e-6, "{a:?} {b:?}");
    // the elongation is most of the torque
    let of_twist = 0.02 * a.twist;
    assert!((a.torque - of_twist).abs() > 0.2 * a.torque.abs(), "{a:?}");
}

/// What has no derivation with a torque per tension is refused by name, in either order.
///
/// *Source.* The contract.
#[test]
fn what_tension_that_makes_torque_does_not_go_with_is_refused() {
    let stranded = torsion(0.0);
    let torsion = || Some(stranded.clone());
    let told = |error: Error| {
        assert!(matches!(error, Error::TorsionPlace { .. }), "{error}");
        assert!(error.to_string().contains("torque_per_tension"), "{error}");
    };
    told(rope(Effects { torsion: torsion(), axial_law: Some(AxialLaw::Rope), ..Effects::default() }).build().unwrap_err());
    let curved = Some(RestShape::curved(0.5));
    rope(Effects { torsion: torsion(), rest_shape: curved, ..Effects::default() }).build().unwrap();
    let mut cable = rope(Effects { torsion: torsion(), ..Effects::default() }).build().unwrap();
    told(cable.add_reel(At::End, Reel::default()).unwrap_err());
    let mut cable = rope(Effects::default()).build().unwrap();
    cable.add_reel(At::End, Reel::default()).unwrap();
    told(cable.set_effects(Effects { torsion: torsion(), ..Effects::default() }).unwrap_err());
    let broken = Torsion { torque_per_tension: f64::NAN, ..stranded.clone() };
    assert!(rope(Effects { torsion: Some(broken), ..Effects::default() }).build().is_err());
}
