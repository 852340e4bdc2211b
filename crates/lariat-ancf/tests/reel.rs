//! A reel at the end of a cable.

use approx::assert_relative_eq;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{
    At, Cable, Damping, Drag, Error, ErrorNorm, Integrator, Method, PointLoad, Reel, Section, StepControl, Vector3,
};
use nalgebra::Matrix3;

const G: f64 = 9.81;

/// A rope that hangs from its last node, the eye, in the plane or not: EA 1e4 N, EI 0.02 N m^2, 0.4 kg/m.
fn rope(length: f64, elements: usize, integrator: Integrator) -> Cable {
    let mut cable = Cable::builder()
        .points([Vector3::new(0.0, -length, 0.0), Vector3::zeros()])
        .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
        .elements(elements)
        .integrator(integrator)
        .fix(At::End)
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    cable
}

fn implicit() -> Vec<Integrator> {
    let fine = |method| Integrator { method, control: StepControl::MaxStep(1.0 / 960.0) };
    vec![
        Integrator::tolerance(Method::Esdirk4, 1e-7).unwrap(),
        Integrator::tolerance(Method::TrBdf2, 1e-6).unwrap(),
        fine(Method::Midpoint),
        fine(Method::DiscreteGradient),
    ]
}

/// Energy of a cable less the work of its reel and what remeshing added, in J.
fn account(cable: &mut Cable) -> f64 {
    let reel = cable.reel().unwrap();
    cable.energy().total() - reel.work - reel.remeshed
}

/// A swinging rope is paid out and taken in, in space, over many splits and merges. The account of energy closes: what it changes by
/// is the work of the winch.
///
/// *Source.* Conservation of energy; the methods that dissipate by themselves may only lose.
#[test]
fn the_energy_of_a_swinging_rope_changes_by_the_work_of_its_winch() {
    for integrator in implicit() {
        let mut cable = rope(1.5, 8, integrator);
        cable.add_reel(At::End, Reel { acceleration: 4.0, ..Reel::default() }).unwrap();
        cable.set_rigid_motion(Vector3::zeros(), Vector3::zeros()).unwrap();
        let n = cable.nodes();
        let mut v = cable.velocities().to_vec();
        for node in 0..n {
            // a swing about the eye, and out of its plane
            let depth = -cable.node_position(node).y;
            v[6 * node] = 1.2 * depth;
            v[6 * node + 2] = -0.5 * depth;
            v[6 * node + 3] = -1.2;
            v[6 * node + 5] = 0.5;
        }
        let q = cable.positions().to_vec();
        cable.set_coordinates(&q, &v).unwrap();
        let start = account(&mut cable);
        let mut worst: f64 = 0.0;
        for step in 0..240 {
            let t = f64::from(step) / 120.0;
            cable.set_reel_rate(1.0 * (3.0 * t).sin()).unwrap();
            cable.step(1.0 / 120.0).unwrap();
            worst = worst.max((account(&mut cable) - start).abs());
        }
        let reel = cable.reel().unwrap();
        println!("{:?}: {worst:.2e} J, {reel:?}", integrator.method);
        assert!(reel.splits > 2 && reel.merges > 2);
        let allowed = match integrator.method {
            Method::Esdirk4 => 2e-4,
            Method::TrBdf2 => 2e-2,
            _ => 1e-2,
        };
        assert!(worst < allowed, "{:?}: {worst:e} J of {reel:?}", integrator.method);
    }
}

/// One minute of paying out and taking in 5 m at 0.5 m/s: the length returns to rounding, and so does the state of a damped rope.
///
/// *Source.* The integral of the rate.
#[test]
fn a_minute_of_cycles_returns_to_the_length() {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    let mut cable = rope(4.0, 20, integrator);
    let mut effects = cable.effects().clone();
    effects.damping = Some(Damping { axial: 2e-3, bending: 2e-3 });
    cable.set_effects(effects).unwrap();
    cable.add_reel(At::End, Reel::default()).unwrap();
    let (start, mut moved, mut before) = (cable.energy(), 0.0, 0.0);
    for step in 0..3600 {
        // half a ramp first and last, so that the length returns
        let t = f64::from(step) / 60.0 + 5.0;
        cable.set_reel_rate(if ((t / 10.0) as u32).is_multiple_of(2) { 0.5 } else { -0.5 }).unwrap();
        cable.step(1.0 / 60.0).unwrap();
        let work = cable.reel().unwrap().work;
        moved += (work - before).abs();
        before = work;
    }
    cable.set_reel_rate(0.0).unwrap();
    (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let reel = cable.reel().unwrap();
    // from rest to 0.5 m/s at 2 m/s^2 at the beginning, and back at the end: 0.0625 m less out, and 0.0625 m more
    println!("{:e} m, {reel:?}", reel.length_out - 4.0);
    assert!((reel.length_out - 4.0).abs() < 1e-9 && reel.rate == 0.0, "{reel:?}");
    assert!(reel.splits > 50 && reel.merges == reel.splits, "{reel:?}");
    let change = cable.energy().total() - start.total();
    let lost = cable.effect_work().dissipated() + cable.energy_law().numerical + cable.energy_law().rescaled;
    let missing = change - reel.work - reel.remeshed + lost;
    println!("{missing:e} J of {moved} J, lost {lost} J");
    assert!(missing.abs() < 1e-3 * moved, "{missing:e} J of {moved} J");
}

/// The momentum of a rope changes by its weight and the force on the eye: with a reel that pays out at a constant rate, a rope that
/// hangs at rest moves down as a whole, and its tension at the eye is its weight.
///
/// *Source.* Newton's second law of the rope that is out: d(m v)/dt = m g - T with v constant and mass m = rho A l entering with v.
#[test]
fn a_rope_paid_out_at_a_constant_rate_hangs_by_its_weight() {
    for integrator in implicit() {
        let mut cable = rope(1.0, 6, integrator);
        let mut effects = cable.effects().clone();
        effects.damping = Some(Damping { axial: 5e-3, bending: 0.0 });
        cable.set_effects(effects).unwrap();
        cable.add_reel(At::End, Reel { rate: vec![[0.0, 0.4]], acceleration: 1.0, stock: Some(4.0) }).unwrap();
        (0..180).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let reel = cable.reel().unwrap();
        let weight = 0.4 * G * reel.length_out;
        assert_relative_eq!(reel.length_out, 1.0 + 0.4 * 3.0 - 0.5 * 0.4 * 0.4, epsilon = 1e-6);
        assert!((reel.tension / weight - 1.0).abs() < 0.01, "{:?}: {reel:?} {weight} N", integrator.method);
        // the free end moves with the rate
        let speed = cable.sample(0.0).unwrap().velocity;
        assert!((speed.y + 0.4).abs() < 5e-3, "{:?}: {speed:?}", integrator.method);
        // the configurational force: T f less the strain energy per length
        let f = 1.0 + weight / 1.0e4;
        assert!((reel.force - reel.tension * f).abs() < 0.02 * weight, "{:?}: {reel:?}", integrator.method);
        (0..600).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        let reel = cable.reel().unwrap();
        assert!(
            reel.stopped && reel.rate == 0.0 && reel.length_out <= 4.0 + 1e-9 && reel.length_out > 3.99,
            "{reel:?}"
        );
    }
}

/// A mass on a light, stiff rope whose length changes, against its own equation: l = 1.5 + 0.1 t and a wave.
///
/// *Source.* `(l^2 theta')' = -g l sin theta`, by the classical Runge-Kutta method here, with the length that the reel has out.
#[test]
fn a_pendulum_of_variable_length_follows_its_equation() {
    for method in [Method::Esdirk4, Method::DiscreteGradient] {
        let control = match method {
            Method::Esdirk4 => StepControl::ToleranceOf(1e-7, ErrorNorm::Bodies),
            _ => StepControl::MaxStep(1.0 / 480.0),
        };
        let integrator = Integrator { method, control };
        let (mut theta, mut omega) = (0.6f64, 0.0f64);
        let start = 1.5 * Vector3::new(theta.sin(), -theta.cos(), 0.0);
        let mut cable = Cable::builder()
            .points([start, Vector3::zeros()])
            .section(Section::from_stiffness(1.0e6, 1e-4, 2e-4).unwrap())
            .elements(8)
            .integrator(integrator)
            .fix(At::End)
            .build()
            .unwrap();
        cable.attach(At::Start).unwrap();
        cable.add_reel(At::End, Reel { acceleration: 50.0, ..Reel::default() }).unwrap();
        let mut bodies = [RigidBody::new(1.0, Matrix3::identity() * 1e-3, start).unwrap()];
        bodies[0].force = Vector3::new(0.0, -G, 0.0);
        let pin = PinConstraint { cable: 0, node: 0, body: 0, anchor: Vector3::zeros(), direction: None };
        let mut island = Island::default();
        let dt = 1.0 / 240.0;
        let mut worst: f64 = 0.0;
        let mut rate_before = 0.0;
        for step in 0..2400 {
            let t = f64::from(step) * dt;
            let rate = if t < 4.0 { 0.1 } else { 0.6 * (2.0 * (t - 4.0)).sin() };
            cable.set_reel_rate(rate).unwrap();
            cable.remesh_reel().unwrap();
            let l0 = cable.length();
            island.step(&mut [&mut cable], &mut bodies, &[pin], integrator, dt).unwrap();
            let acceleration = (cable.reel().unwrap().rate - rate_before) / dt;
            let (r0, n) = (rate_before, 20);
            rate_before = cable.reel().unwrap().rate;
            let slope = |s: f64, th: f64, om: f64| {
                let (l, r) = (l0 + s * (r0 + 0.5 * s * acceleration), r0 + s * acceleration);
                (om, (-G * th.sin() - 2.0 * r * om) / l)
            };
            for k in 0..n {
                let (h, s) = (dt / f64::from(n), dt * f64::from(k) / f64::from(n));
                let a = slope(s, theta, omega);
                let b = slope(s + 0.5 * h, theta + 0.5 * h * a.0, omega + 0.5 * h * a.1);
                let c = slope(s + 0.5 * h, theta + 0.5 * h * b.0, omega + 0.5 * h * b.1);
                let d = slope(s + h, theta + h * c.0, omega + h * c.1);
                theta += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
                omega += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
            }
            let expected = cable.length() * Vector3::new(theta.sin(), -theta.cos(), 0.0);
            worst = worst.max((bodies[0].position - expected).norm() / cable.length());
        }
        let reel = cable.reel().unwrap();
        println!("{method:?}: {worst:.2e} of the length, {reel:?}");
        assert!(reel.splits >= 4 && reel.merges >= 1);
        // the discrete gradient has no control of its error
        let allowed = if method == Method::Esdirk4 { 1e-3 } else { 1e-2 };
        assert!(worst < allowed, "{method:?}: {worst:e}");
    }
}

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
        let (expected, reel) = (bits(&cable), cable.reel().unwrap());
        assert!(reel.splits > 0 && reel.merges > 0);
        cable.restore(snapshot).unwrap();
        run(&mut cable);
        run(&mut cable);
        assert_eq!(bits(&cable), expected);
        assert_eq!(cable.reel().unwrap(), reel);
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
            let (was, is) = (before.reel().unwrap(), cable.reel().unwrap());
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
        println!("{seen} changes, {:?}", cable.reel().unwrap());
        assert!(seen >= 3);
    }
}

/// Hard reels: out and in at 5 m/s (by the discrete gradient), a stiff rope (EA 1e6), the least length under 5 kN, all damped and in space, at the steps of games and
/// with error control. No step fails, and the energy stays what winch, load and damping leave: the account never rises by more than
/// 2 % of the energy that was moved.
///
/// *Source.* Conservation of energy; damping and numerical dissipation only lose.
#[test]
fn hard_reels_hold_and_make_no_energy() {
    let game = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    for integrator in [game, Integrator::tolerance(Method::TrBdf2, 1e-4).unwrap()] {
        for (name, stiffness, rate, pull) in
            [("fast", 1e4, 5.0, 0.0), ("stiff", 1e6, 0.8, 0.0), ("loaded", 1e6, -0.8, 5e3)]
        {
            if name == "fast" && integrator.method != Method::DiscreteGradient {
                // faster than the rope falls it crumples at the eye, at up to 0.7 of the speed of waves: beyond the validity
                continue;
            }
            let mut cable = Cable::builder()
                .points([Vector3::new(0.0, -4.0, 0.0), Vector3::zeros()])
                .section(Section::from_stiffness(stiffness, 0.05, 0.4).unwrap())
                .elements(10)
                .damping(Damping { axial: 5e-3, bending: 5e-3 })
                .integrator(integrator)
                .fix(At::End)
                .load(PointLoad::force(0.0, [0.0, -pull, 0.0]))
                .build()
                .unwrap();
            cable.equilibrium().unwrap();
            let mut v = cable.velocities().to_vec();
            v.chunks_exact_mut(6).enumerate().for_each(|(i, v)| v[2] = 0.2 * (10.0 - i as f64));
            let q = cable.positions().to_vec();
            cable.set_coordinates(&q, &v).unwrap();
            cable.add_reel(At::End, Reel { acceleration: 20.0, ..Reel::default() }).unwrap();
            let total = |cable: &Cable| {
                let reel = cable.reel().unwrap();
                let height = cable.node_position(0).y;
                cable.energy().total() + pull * height - reel.work - reel.remeshed + cable.effect_work().dissipated()
            };
            let (start, mut moved, mut before, mut most) = (total(&cable), cable.energy().kinetic, 0.0, 0.0f64);
            for step in 0..330 {
                let outwards = name == "loaded" || (step / 40) % 2 == 0;
                cable.set_reel_rate(if outwards { rate } else { -rate }).unwrap();
                cable.step(1.0 / 60.0).unwrap();
                let work = cable.reel().unwrap().work;
                moved += (work - before).abs();
                before = work;
                most = most.max(total(&cable) - start);
            }
            let reel = cable.reel().unwrap();
            println!("{name} {:?}: {most:.2e} J of {moved:.1} J, {reel:?}", integrator.method);
            assert!(most < 0.02 * moved, "{name} {:?}: {most} J of {moved} J", integrator.method);
            assert!(name != "loaded" || reel.stopped && reel.length_out < 0.2, "{reel:?}");
        }
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
    assert!(matches!(cable.add_reel(At::Start, Reel::default()), Err(Error::ReelPlace { .. })));
    assert!(matches!(cable.set_reel_rate(1.0), Err(Error::ReelPlace { .. })));
    assert!(cable.reel().is_none() && cable.positions() == positions);
    let mut dragged = cable.clone();
    let mut effects = dragged.effects().clone();
    effects.drag = Some(Drag { diameter: Some(0.01), ..Drag::new(1.2, 1.2, 0.01, Default::default()) });
    dragged.set_effects(effects.clone()).unwrap();
    assert!(matches!(dragged.add_reel(At::End, Reel::default()), Err(Error::NotWithReel { what: "drag", .. })));
    cable.add_reel(At::End, Reel::default()).unwrap();
    assert!(matches!(cable.add_reel(At::End, Reel::default()), Err(Error::ReelPlace { .. })));
    assert!(matches!(cable.set_effects(effects), Err(Error::NotWithReel { .. })));
    let explicit = Integrator { method: Method::Rkn4, control: StepControl::Stable(0.5) };
    assert!(matches!(cable.set_integrator(explicit), Err(Error::ExplicitReel { .. })));
    assert!(matches!(cable.insert_node(0.9), Err(Error::NotWithReel { .. })));
    assert!(matches!(cable.cut(0.9), Err(Error::NotWithReel { .. })));
    cable.set_reel_rate(1e9).unwrap();
    cable.set_reel(Reel { rate: vec![[0.0, 1e9]], acceleration: 1e12, stock: None }).unwrap();
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
        let reel = cable.reel().unwrap();
        assert!(reel.stopped && reel.rate == 0.0, "{reel:?}");
        assert_relative_eq!(reel.length_out, 0.6 + 0.4 * 0.2, epsilon = 1e-3);
        let mut rest = cable.cut(0.2).unwrap();
        assert!(cable.reel().is_none() && rest.reel().is_some());
        cable.step(1.0 / 60.0).unwrap();
        rest.set_reel_rate(0.5).unwrap();
        (0..60).for_each(|_| rest.step(1.0 / 60.0).unwrap());
        assert!(rest.reel().unwrap().length_out > 0.8);
    }
}
