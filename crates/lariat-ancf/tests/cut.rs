//! A cable that is cut in two.

use approx::assert_relative_eq;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Effects, LineLoad, PointLoad, RestPiece, RestShape, Section, Vector3};

/// A cable that swings and bends, with a load at either end and a held start.
fn swinging() -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.4, 0.0), Vector3::new(2.0, 0.0, 0.3)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
        .fix(At::Start)
        .load(PointLoad::force(0.5, Vector3::new(0.0, 1.0, 0.0)))
        .load(PointLoad::force(1.9, Vector3::new(0.0, 2.0, 0.0)))
        .build()
        .unwrap();
    let rest = RestShape { pieces: vec![RestPiece { from: 0.3, stretch: 1.0, curvature: 0.1 }] };
    let loads = Some(LineLoad { from: 1.5, to: 1.8, force: Vector3::z() }.into());
    cable.set_effects(Effects { rest_shape: Some(rest), line_loads: loads, ..Effects::default() }).unwrap();
    for _ in 0..10 {
        cable.step(1.0 / 60.0).unwrap();
    }
    cable
}

/// *Source.* Conservation: nothing passes in a cut.
#[test]
fn the_parts_have_the_mass_momentum_and_kinetic_energy_of_the_whole() {
    let whole = swinging();
    // at a node, and inside an element
    for s in [whole.node_arc_lengths()[4], 1.03] {
        let mut head = whole.clone();
        let tail = head.cut(s).unwrap();
        assert_relative_eq!(head.length(), s, epsilon = 1e-12);
        assert_relative_eq!(head.length() + tail.length(), whole.length(), epsilon = 1e-12);
        let (a, b, all) = (head.momentum(), tail.momentum(), whole.momentum());
        assert_relative_eq!(a.linear + b.linear, all.linear, epsilon = 1e-12);
        assert_relative_eq!(a.angular + b.angular, all.angular, epsilon = 1e-12);
        assert_relative_eq!(
            head.energy().kinetic + tail.energy().kinetic,
            whole.energy().kinetic,
            max_relative = 1e-12
        );
        for k in 0..10 {
            let at = whole.length() * f64::from(k) / 9.0;
            let sample = if at < s { head.sample(at) } else { tail.sample((at - s).min(tail.length())) }.unwrap();
            assert_relative_eq!(sample.position, whole.sample(at).unwrap().position, epsilon = 1e-12);
            assert_relative_eq!(sample.velocity, whole.sample(at).unwrap().velocity, epsilon = 1e-11);
        }
        assert_eq!((head.loads().len(), tail.loads().len()), (1, 1));
        assert_relative_eq!(tail.loads()[0].arc_length, 1.9 - s, epsilon = 1e-12);
        let load = &tail.effects().line_loads.as_ref().unwrap().0[0];
        assert_relative_eq!(load.from, 1.5 - s, epsilon = 1e-12);
        assert_relative_eq!(load.to, 1.8 - s, epsilon = 1e-12);
        assert_eq!(tail.effects().rest_shape.as_ref().unwrap().pieces[0].from, 0.0);
        assert!(head.support(At::Start).unwrap().position.is_some() && tail.support(At::Start).unwrap().is_free());
    }
}

/// *Source.* Newton's second law: nothing but weight and loads acts on the part that was cut off.
#[test]
fn the_part_that_was_cut_off_falls_freely() {
    let mut whole = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
        .fix(At::Start)
        .build()
        .unwrap();
    whole.equilibrium().unwrap();
    let mut tail = whole.cut(0.8).unwrap();
    let mass = 0.4 * 1.2;
    for _ in 0..30 {
        tail.step(1.0 / 60.0).unwrap();
        whole.step(1.0 / 60.0).unwrap();
    }
    assert_relative_eq!(tail.momentum().linear.y, -mass * 9.81 * 0.5, max_relative = 1e-6);
    assert_relative_eq!(whole.node_position(0).y, 0.0);
}

/// *Source.* The weight below: rho A g L at the top of a hanging cable.
#[test]
fn the_tension_of_a_hanging_cable_is_largest_at_the_top() {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)])
        .section(Section::square(0.01, 1.0e8, 4000.0).unwrap())
        .fix(At::Start)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    let (s, tension) = cable.peak_tension();
    assert_eq!(s, 0.0);
    assert_relative_eq!(tension, 0.4 * 9.81 * 2.0, max_relative = 1e-2);
}

#[test]
fn a_cut_at_an_end_or_beyond_is_refused_and_the_cable_is_whole() {
    let mut cable = swinging();
    let before = cable.positions().to_vec();
    for s in [0.0, cable.length(), 5.0, -1.0, f64::NAN] {
        assert!(cable.cut(s).is_err(), "{s}");
    }
    assert_eq!(cable.positions(), before);
}

/// A cut at a node keeps the elastic energy, to rounding. Between two nodes the difference is recorded, whatever the rule; it is
/// zero where the rule is exact, and with the projected rule between 0 and the strain energy that the projection did not see.
///
/// *Source.* Conservation; the bound of `edit/refine.rs`, with the energy of the exact rule on the same shape.
#[test]
fn a_cut_accounts_for_the_elastic_energy() {
    let strain = |cable: &Cable| cable.energy().axial + cable.energy().bending;
    for name in ["projected-none", "exact-none", "G5-none", "projected-3", "exact-3", "G3-3", "L2T2", "ST2"] {
        let mut whole = swinging();
        whole.set_effects(Effects::default()).unwrap();
        whole.set_rule(name.parse().unwrap()).unwrap();
        for s in [whole.node_arc_lengths()[4], 0.11, 0.77, 1.03, 1.9] {
            let mut head = whole.clone();
            let tail = head.cut(s).unwrap();
            let jump = strain(&head) + strain(&tail) - strain(&whole);
            let size = strain(&whole);
            assert!((head.inserted_energy() - jump).abs() < 1e-12 * size, "{name} {s}: {jump} J of {size}");
            let exact = s == whole.node_arc_lengths()[4] || ["exact-none", "G5-none"].contains(&name);
            assert!(!exact || jump.abs() < 1e-11 * size, "{name} {s}: {jump:e} J of {size}");
            if name == "projected-none" {
                let mut unprojected = whole.clone();
                unprojected.set_rule("exact-none".parse().unwrap()).unwrap();
                let hidden = strain(&unprojected) - strain(&whole);
                println!("{s}: {jump:e} of at most {hidden:e} J, {size:e} J");
                assert!(jump >= -1e-12 * size && jump <= hidden, "{s}: {jump} J of at most {hidden}");
            }
        }
    }
}
