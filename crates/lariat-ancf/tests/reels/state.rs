//! Snapshots, splits and merges, and what is refused.

use super::common::{implicit, rope};
use approx::assert_relative_eq;
use lariat_ancf::island::Island;
use lariat_ancf::{
    At, Buoyancy, Cable, Damping, Drag, Error, Integrator, LineLoad, Method, PointLoad, Reel, StepControl, Vector3,
};

/// A run continues bitwise from its snapshot, across splits and merges, and from its description.
///
/// *Source.* Bitwise equality.
#[test]
fn a_snapshot_in_the_middle_continues_bitwise() {
    for integrator in implicit() {
        let mut cable = rope(1.2, 6, integrator);
        cable.add_reel(At::End, Reel { rate: vec![[0.0, 0.8], [1.0, -1.2]], ..Reel::default() }).unwrap();
        let bits = |cable: &Cable| {
            let numbers = cable.positions().iter().chain(cable.velocities());
            numbers.map(|x| x.to_bits()).chain([cable.length().to_bits()]).collect::<Vec<_>>()
        };
        let run = |cable: &mut Cable| (0..50).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        run(&mut cable);
        let (snapshot, saved) = (cable.snapshot().clone(), serde_json::to_string(&cable).unwrap());
        run(&mut cable);
        run(&mut cable);
        let (expected, reel) = (bits(&cable), cable.reel(At::End).unwrap());
        assert!(reel.splits > 0 && reel.merges > 0);
        cable.restore(snapshot).unwrap();
        run(&mut cable);
        run(&mut cable);
        assert_eq!(bits(&cable), expected);
        assert_eq!(cable.reel(At::End).unwrap(), reel);
        let mut read: Cable = serde_json::from_str(&saved).unwrap();
        run(&mut read);
        run(&mut read);
        assert_eq!(bits(&read), expected);
    }
}

/// A split of a swinging, damped rope keeps shape, momentum and kinetic energy. A merge keeps the outer nodes and so the slope at the eye,
/// changes kinetic energy and momentum (by its impulse on the eye) by less than 1e-4; readings of the tension hardly move.
///
/// *Source.* A cubic is its own interpolant; a projection in the norm of the mass.
#[test]
fn splits_are_exact_and_merges_keep_tension_and_momentum() {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 480.0) };
    let mut island = Island::default();
    for rate in [0.5, -0.5] {
        let mut cable = rope(2.0, 8, integrator);
        let mut effects = cable.effects().clone();
        effects.damping = Some(Damping { axial: 1e-3, bending: 1e-3 });
        cable.set_effects(effects).unwrap();
        cable.add_reel(At::End, Reel { rate: vec![[0.0, rate]], ..Reel::default() }).unwrap();
        let mut v = cable.velocities().to_vec();
        v.chunks_exact_mut(6).enumerate().for_each(|(i, v)| v[0] = 0.1 * (8.0 - i as f64));
        let q = cable.positions().to_vec();
        cable.set_coordinates(&q, &v).unwrap();
        let mut seen = 0;
        for _ in 0..960 {
            island.step(&mut [&mut cable], &mut [], &[], integrator, 1.0 / 480.0).unwrap();
            let before = cable.clone();
            cable.remesh_reel().unwrap();
            let (was, is) = (before.reel(At::End).unwrap(), cable.reel(At::End).unwrap());
            if was.splits + was.merges == is.splits + is.merges {
                continue;
            }
            seen += 1;
            let (p, kinetic) = (before.momentum(), before.energy().kinetic);
            let (moved, made) = (cable.momentum().linear - p.linear, cable.energy().kinetic - kinetic);
            assert_eq!(cable.length(), before.length());
            if is.splits > was.splits {
                assert!(moved.norm() < 1e-12 && made.abs() < 1e-12 * kinetic, "{moved} {made:e}");
                for k in 0..=50 {
                    let s = cable.length() * f64::from(k) / 50.0;
                    let [a, b] = [&before, &cable].map(|cable| cable.sample(s).unwrap());
                    assert_relative_eq!(a.position, b.position, epsilon = 1e-12);
                    assert_relative_eq!(a.velocity, b.velocity, epsilon = 1e-11);
                }
            } else {
                assert!(
                    made.abs() < 1e-4 * kinetic && moved.norm() < 1e-4 * p.linear.norm(),
                    "{moved} {made:e} J of {kinetic}"
                );
                let n = cable.positions().len();
                assert_eq!(cable.positions()[n - 6..], before.positions()[n + 6 - 6..]);
            }
            // the finer mesh sees more of the strain: 3.5 % here, of a coarse mesh that swings
            assert!(
                (is.tension / was.tension - 1.0).abs() < 0.05 && (is.force / was.force - 1.0).abs() < 0.05,
                "{was:?} {is:?}"
            );
        }
        println!("{seen} changes, {:?}", cable.reel(At::End).unwrap());
        assert!(seen >= 3);
    }
}

#[test]
fn what_makes_no_reel_is_a_typed_error_and_changes_nothing() {
    let integrator = Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap();
    let mut cable = rope(1.0, 4, integrator);
    let (positions, bad) = (cable.positions().to_vec(), f64::NAN);
    for reel in [
        Reel { rate: vec![[0.0, bad]], ..Reel::default() },
        Reel { rate: vec![[1.0, 0.1], [0.5, 0.2]], ..Reel::default() },
        Reel { acceleration: 0.0, ..Reel::default() },
        Reel { stock: Some(-1.0), ..Reel::default() },
    ] {
        assert!(matches!(cable.add_reel(At::End, reel), Err(Error::InvalidValue { .. })));
    }
    assert!(matches!(cable.add_reel(0.5, Reel::default()), Err(Error::ReelPlace { .. })));
    assert!(matches!(cable.set_reel_rate(At::End, 1.0), Err(Error::ReelPlace { .. })));
    assert!(cable.reel(At::End).is_none() && cable.positions() == positions);
    let mut loaded = cable.clone();
    let mut effects = loaded.effects().clone();
    effects.line_loads = Some(LineLoad { from: 0.3, ..LineLoad::uniform(Vector3::x()) }.into());
    loaded.set_effects(effects.clone()).unwrap();
    assert!(matches!(loaded.add_reel(At::End, Reel::default()), Err(Error::NotWithReel { .. })));
    cable.set_drag(Drag { diameter: Some(0.01), ..Drag::new(1.2, 1.2, 0.01, Default::default()) }).unwrap();
    cable.add_reel(At::End, Reel::default()).unwrap();
    assert!(matches!(cable.sample_flow(|r| r), Err(Error::NotWithReel { what: "a sampled flow", .. })));
    let water = Buoyancy { area: Some(1e-4), ..Buoyancy::new(1000.0, 1.0) };
    assert!(matches!(cable.set_buoyancy(water), Err(Error::NotWithReel { what: "added mass", .. })));
    cable.set_drag(None).unwrap();
    assert!(matches!(cable.add_reel(At::End, Reel::default()), Err(Error::ReelPlace { .. })));
    assert!(matches!(cable.set_effects(effects), Err(Error::NotWithReel { .. })));
    let explicit = Integrator { method: Method::Rkn4, control: StepControl::Stable(0.5) };
    assert!(matches!(cable.set_integrator(explicit), Err(Error::ExplicitReel { .. })));
    assert!(matches!(cable.insert_node(0.9), Err(Error::NotWithReel { .. })));
    assert!(matches!(cable.cut(0.9), Err(Error::NotWithReel { .. })));
    cable.set_reel_rate(At::End, 1e9).unwrap();
    cable.set_reel(At::End, Reel { rate: vec![[0.0, 1e9]], acceleration: 1e12, ..Reel::default() }).unwrap();
    assert!(cable.step(1.0 / 60.0).is_err());
    assert_eq!(cable.length(), 1.0);
}

/// Taken in, the rope stops before a load and before a held node, softly; a part that is cut off keeps no reel.
#[test]
fn a_reel_stops_before_what_it_cannot_swallow_and_stays_with_its_part() {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    for held in [true, false] {
        let mut cable = rope(2.0, 10, integrator);
        if held {
            cable.fix(0.6).unwrap();
        } else {
            cable.add_load(PointLoad::force(0.6, [0.0, -5.0, 0.0])).unwrap();
        }
        cable.add_reel(At::End, Reel::with_rate(-0.5)).unwrap();
        (0..240).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let reel = cable.reel(At::End).unwrap();
        assert!(reel.stopped && reel.rate == 0.0, "{reel:?}");
        assert_relative_eq!(reel.length_out, 0.6 + 0.4 * 0.2, epsilon = 1e-3);
        let mut rest = cable.cut(0.2).unwrap();
        assert!(cable.reel(At::End).is_none() && rest.reel(At::End).is_some());
        cable.step(1.0 / 60.0).unwrap();
        rest.set_reel_rate(At::End, 0.5).unwrap();
        (0..60).for_each(|_| rest.step(1.0 / 60.0).unwrap());
        assert!(rest.reel(At::End).unwrap().length_out > 0.8);
    }
}
