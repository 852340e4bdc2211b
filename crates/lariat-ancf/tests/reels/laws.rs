//! Reels whose rate is an unknown: clutch, brake, free spool.

use super::common::{G, rope};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::{At, Cable, Damping, Error, Feed, Fidelity, Integrator, Method, Reel, Section, StepControl, Vector3};
use nalgebra::Matrix3;

const GAME: Integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };

/// A load of a mass in kg on a rope of a density in kg/m, 1 m of which hang from a fixed eye.
pub struct Hoist {
    pub cable: Cable,
    bodies: Vec<RigidBody>,
    pins: Vec<PinConstraint>,
    island: Island,
    dt: f64,
    /// Largest pull and tension in N that [`fall`](Self::fall) read.
    pub most: f64,
}

impl Hoist {
    pub fn new(mass: f64, density: f64, dt: f64, reel: Reel) -> Self {
        Self::with_stiffness(1.0e5, mass, density, dt, reel)
    }

    fn with_stiffness(stiffness: f64, mass: f64, density: f64, dt: f64, reel: Reel) -> Self {
        Self::stretched(0.0, stiffness, mass, density, dt, reel)
    }

    /// The same with a strain.
    pub fn stretched(strain: f64, stiffness: f64, mass: f64, density: f64, dt: f64, reel: Reel) -> Self {
        let start = Vector3::new(0.0, -1.0 - strain, 0.0);
        let mut cable = Cable::builder()
            .points([start, Vector3::zeros()])
            .length(1.0)
            .section(Section::from_stiffness(stiffness, 1e-3, density).unwrap())
            .elements(5)
            .damping(Damping { axial: 2e-3, bending: 2e-3 })
            .integrator(GAME)
            .fix(At::End)
            .build()
            .unwrap();
        cable.add_reel(At::End, reel).unwrap();
        let (mut bodies, mut pins) = (Vec::new(), Vec::new());
        if mass > 0.0 {
            cable.attach(At::Start).unwrap();
            bodies.push(RigidBody::new(mass, Matrix3::identity() * 1e-3 * mass, start).unwrap());
            bodies[0].force = Vector3::new(0.0, -G * mass, 0.0);
            pins.push(PinConstraint { cable: 0, node: 0, body: 0, anchor: Vector3::zeros(), direction: None });
        }
        Hoist { cable, bodies, pins, island: Island::default(), dt, most: 0.0 }
    }

    pub fn step(&mut self) {
        self.try_step().unwrap();
    }

    fn try_step(&mut self) -> Result<(), Error> {
        self.cable.remesh_reel()?;
        if self.bodies.is_empty() {
            return self.cable.step(self.dt);
        }
        self.island.step(&mut [&mut self.cable], &mut self.bodies, &self.pins, GAME, self.dt)
    }

    /// Takes half a second of steps, in the first of which the force of the clutch falls to `limit` (N), and returns by how much the load gains speed downwards, and by how much
    /// it should, in m/s: `(m + rho L) v' = (m + rho L) g - T`. T is the tension of a rope that the winch pulls by the force F per unstretched length,
    /// `T f = F + u` with the stretch f and the strain energy u.
    pub fn fall(&mut self, limit: f64) -> Result<[f64; 2], Error> {
        let (body, section) = (&self.bodies[0], self.cable.elements()[0].section);
        let (mass, before, stiffness) = (body.mass, body.velocity.y, section.axial_stiffness);
        let reading = |cable: &Cable| cable.reel(At::End).unwrap();
        let mut out = self.cable.length();
        let mut force = 0.5 * (reading(&self.cable).force + limit);
        let mut expected = 0.0;
        for _ in 0..(0.5 / self.dt) as usize {
            self.try_step()?;
            let reel = reading(&self.cable);
            self.most = self.most.max(reel.force).max(reel.tension);
            let strain = ((1.0 + 6.0 * force / stiffness).sqrt() - 1.0) / 3.0;
            let tension = stiffness * strain * (1.0 + 2.0 * strain).sqrt();
            let carried = mass + 0.15 * 0.5 * (out + self.cable.length());
            expected += (G - tension / carried) * self.dt;
            (out, force) = (self.cable.length(), limit);
        }
        Ok([before - self.bodies[0].velocity.y, expected])
    }

    /// Returns how far in m the load is below the eye.
    pub fn below(&self) -> f64 {
        -self.bodies[0].position.y
    }

    /// Returns the energy in J of cable and load less all work on them.
    pub fn account(&self) -> f64 {
        let reel = self.cable.reel(At::End).unwrap();
        let of_bodies: f64 =
            self.bodies.iter().map(|b| 0.5 * b.mass * b.velocity.norm_squared() + b.mass * G * b.position.y).sum();
        self.cable.energy().total() + of_bodies - reel.work - reel.remeshed - self.cable.effect_work().total()
            + self.cable.energy_law().numerical
            + self.cable.energy_law().rescaled
    }
}

/// Integrates u'' = f(u, u') from (u, 0) to a time by the classical Runge-Kutta method.
pub fn reference(mut u: f64, time: f64, f: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let (n, mut v) = (20_000, 0.0);
    let h = time / f64::from(n);
    for _ in 0..n {
        let a = (v, f(u, v));
        let b = (v + 0.5 * h * a.1, f(u + 0.5 * h * a.0, v + 0.5 * h * a.1));
        let c = (v + 0.5 * h * b.1, f(u + 0.5 * h * b.0, v + 0.5 * h * b.1));
        let d = (v + h * c.1, f(u + h * c.0, v + h * c.1));
        u += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
        v += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
    }
    (u, v)
}

/// A rope with a load, or without, runs off a free spool as fast as its equation says: from a drum with stock and wheel, from a coil,
/// from a bag, against a brake, with several masses and steps.
///
/// *Source.* Inextensible rope: `(m + rho u) u'' = (m + rho u) g - F`, `F = (J + rho (S - u)) u'' + brake` (drum); `d((m + rho u) u')/dt = (m +
/// rho u) g - brake` (coil, Cayley 1857); `(m + rho u) u'' + 1/2 rho u'^2 = (m + rho u) g - brake` (bag).
#[test]
fn a_free_spool_follows_its_equation() {
    for (feed, mass, density, brake, dt) in [
        (Feed::Drum, 1.0, 0.4, 0.0, 1.0 / 240.0),
        (Feed::Drum, 0.0, 0.7, 0.0, 1.0 / 960.0),
        (Feed::Drum, 7.0, 0.1, 20.0, 1.0 / 240.0),
        (Feed::Coil, 1.0, 0.4, 0.0, 1.0 / 240.0),
        (Feed::Coil, 0.3, 0.8, 2.0, 1.0 / 960.0),
        (Feed::Coil, 0.0, 0.4, 0.0, 1.0 / 480.0),
        (Feed::Coil, 0.5, 1.5, 1.0, 1.0 / 480.0),
        (Feed::Bag, 1.0, 0.4, 0.0, 1.0 / 240.0),
        (Feed::Bag, 3.0, 0.2, 11.0, 1.0 / 480.0),
        (Feed::Bag, 0.5, 0.9, 0.0, 1.0 / 240.0),
    ] {
        let (stock, inertia) = (8.0, if feed == Feed::Drum { 0.6 } else { 0.0 });
        let reel = Reel { feed, stock: Some(stock), inertia, acceleration: 1e4, ..Reel::brake(brake) };
        let mut hoist = Hoist::new(mass, density, dt, reel);
        let start = hoist.account();
        let time = 0.8;
        (0..(time / dt).round() as usize).for_each(|_| hoist.step());
        let out = |u: f64| mass + density * u;
        let (u, v) = reference(1.0, time, |u, v| match feed {
            Feed::Drum | Feed::Sheave | Feed::BodyDrum => {
                (out(u) * G - brake) / (out(u) + inertia + density * (stock - u))
            }
            Feed::Coil => (out(u) * G - brake - density * v * v) / out(u),
            Feed::Bag => (out(u) * G - brake - 0.5 * density * v * v) / out(u),
        });
        let reel = hoist.cable.reel(At::End).unwrap();
        let missing = hoist.account() - start;
        println!(
            "{feed:?} {mass} kg: {:.2e} of the rate, {:.2e} of the length, {missing:.1e} J of {:.1} J",
            reel.rate / v - 1.0,
            reel.length_out / u - 1.0,
            reel.work
        );
        assert!(
            (reel.rate / v - 1.0).abs() < 0.01 && (reel.length_out / u - 1.0).abs() < 0.01,
            "{feed:?} {u} {v} {reel:?}"
        );
    }
}

/// A winch lifts what its clutch can hold, without ever pulling more; what is heavier runs out against the force of the clutch; and once the
/// clutch is strong enough, it takes it to the rate that is asked for.
///
/// *Source.* `m a = m g - F` for the load; `max_force` is the largest pull.
#[test]
fn a_clutch_slips_at_its_force() {
    for (mass, dt) in [(50.0, 1.0 / 240.0), (8.0, 1.0 / 60.0), (20.0, 1.0 / 960.0)] {
        let weight = (mass + 0.15) * G;
        let strong = Reel { max_force: Some(1.15 * weight), acceleration: 50.0, ..Reel::with_rate(-0.4) };
        let mut hoist = Hoist::new(mass, 0.15, dt, strong.clone());
        let (mut most, mut slips) = (0.0f64, 0);
        let start = hoist.account();
        let steps = (0.9 / dt) as usize;
        for _ in 0..steps {
            hoist.step();
            let reel = hoist.cable.reel(At::End).unwrap();
            most = most.max(reel.force.max(reel.tension));
            slips += usize::from((reel.force / (1.15 * weight) - 1.0).abs() < 1e-3);
        }
        let reel = hoist.cable.reel(At::End).unwrap();
        let missing = hoist.account() - start;
        println!(
            "{mass} kg: peak {:.6}, slipped {slips} of {steps}, missing {missing:.1e} J, {reel:?}",
            most / weight / 1.15
        );
        assert!(most < 1.15 * 1.02 * weight, "{most} N of {weight} N");
        assert!(slips > 0 && (reel.rate + 0.4).abs() < 1e-9, "{slips} {reel:?}");
        assert!(hoist.bodies[0].velocity.y > 0.38);
        // too weak: the load runs out
        hoist.cable.set_reel(At::End, Reel { max_force: Some(0.8 * weight), ..strong.clone() }).unwrap();
        let out = hoist.cable.length();
        let [fell, expected] = hoist.fall(0.8 * weight).unwrap();
        assert!((fell / expected - 1.0).abs() < 0.01, "{fell} m/s of {expected} m/s");
        let reel = hoist.cable.reel(At::End).unwrap();
        assert!(reel.rate > 0.0 && hoist.cable.length() > out && (reel.force / (0.8 * weight) - 1.0).abs() < 0.02);
        // a brake, whose shaft stands after 8 ms, stops it within v^2/(2 (F/m - g)) and holds it
        let (brake, speed) = (1.5 * weight, reel.rate);
        hoist.cable.set_reel(At::End, Reel { acceleration: 50.0, ..Reel::brake(brake) }).unwrap();
        let from = hoist.cable.length();
        (0..(1.5 / dt) as usize).for_each(|_| hoist.step());
        let reel = hoist.cable.reel(At::End).unwrap();
        let way = speed * speed / (2.0 * 0.5 * G);
        println!("braked within {} m of {way} m, {reel:?}", reel.length_out - from);
        assert!(reel.rate.abs() < 1e-9 && reel.force < brake && (reel.force / weight - 1.0).abs() < 0.1, "{reel:?}");
        assert!(((reel.length_out - from) / way - 1.0).abs() < 0.05, "{} m of {way} m", reel.length_out - from);
    }
}

/// A swinging rope runs through the clutches of two reels, in space: no energy is made, and no clutch pulls more than it can.
#[test]
fn two_clutches_on_a_swinging_rope_keep_the_account() {
    for dt in [1.0 / 240.0, 1.0 / 60.0] {
        let mut cable = Cable::builder()
            .points([Vector3::zeros(), Vector3::new(1.5, 0.0, 0.0)])
            .length(2.2)
            .section(Section::from_stiffness(2.0e4, 0.02, 0.4).unwrap())
            .elements(12)
            .damping(Damping { axial: 1e-3, bending: 1e-3 })
            .integrator(GAME)
            .fix(At::Start)
            .fix(At::End)
            .build()
            .unwrap();
        cable.equilibrium().unwrap();
        for (at, rate, force) in [(At::Start, -0.4, 6.0), (At::End, 0.3, 8.0)] {
            let reel = Reel { max_force: Some(force), acceleration: 20.0, inertia: 0.05, ..Reel::with_rate(rate) };
            cable.add_reel(at, reel).unwrap();
        }
        let mut v = cable.velocities().to_vec();
        v.chunks_exact_mut(6)
            .enumerate()
            .for_each(|(i, v)| v[2] = 0.5 * (std::f64::consts::PI * i as f64 / 12.0).sin());
        let q = cable.positions().to_vec();
        cable.set_coordinates(&q, &v).unwrap();
        let total = |cable: &Cable| {
            let reels: f64 = cable.reels().map(|reel| reel.work + reel.remeshed).sum();
            cable.energy().total() - reels + cable.effect_work().dissipated()
        };
        let (start, mut worst, mut pulled) = (total(&cable), f64::NEG_INFINITY, [0.0f64; 2]);
        for _ in 0..(1.5 / dt) as usize {
            cable.step(dt).unwrap();
            worst = worst.max(total(&cable) - start);
            for (most, reel) in pulled.iter_mut().zip(cable.reels()) {
                *most = most.max(reel.force.abs());
            }
        }
        println!("{worst:.1e} J, {pulled:?} N, {:?}", cable.reels().collect::<Vec<_>>());
        // of the second order of the step, as the kinetic energy of what flows is
        let moved: f64 = cable.reels().map(|reel| reel.work.abs()).sum();
        assert!(worst < 0.02 * (240.0 * dt).powi(2) / 16.0 * moved + 2e-3 * moved, "{worst} J of {moved} J");
        // the wheel takes 0.05 kg times its acceleration beside the clutch
        assert!(pulled[0] < 6.0 * 1.02 + 0.05 * 20.0 && pulled[1] < 8.0 * 1.02 + 0.05 * 20.0, "{pulled:?}");
    }
}

/// Violent starts against a clutch, of stiff ropes at the steps of games: a load falls into a rope that is slack or thrown upwards first; a
/// rope of EA 1e6 N with 5 kN on it runs out. No step fails, and no clutch pulls more than it holds.
///
/// *Source.* `max_force` is the largest pull.
#[test]
fn clutches_hold_their_force_when_ropes_snatch() {
    for (stiffness, mass, force, upwards) in
        [(1e6, 20.0, 300.0, 2.0), (1e6, 500.0, 6e3, 1.0), (1e5, 5.0, 60.0, 3.0), (1e6, 510.0, 4.5e3, 0.0)]
    {
        for dt in [1.0 / 60.0, 1.0 / 240.0] {
            let reel = Reel { max_force: Some(force), acceleration: 100.0, ..Reel::default() };
            let mut hoist = Hoist::with_stiffness(stiffness, mass, 0.3, dt, reel);
            hoist.bodies[0].velocity.y = upwards;
            let (mut most, mut slips, mut before) = (0.0f64, 0, 0.0);
            for step in 0..(1.2 / dt).round() as usize {
                if step == (0.2 / dt).round() as usize {
                    // the rope is stretched by now
                    before = hoist.bodies[0].velocity.y;
                }
                hoist.step();
                let reel = hoist.cable.reel(At::End).unwrap();
                most = most.max(reel.force);
                slips += usize::from(reel.rate > 0.0);
            }
            let reel = hoist.cable.reel(At::End).unwrap();
            let speed = hoist.bodies[0].velocity.y;
            println!(
                "{mass} kg at 1/{:.0} s: peak {:.5}, slipped in {slips}, {speed} m/s, {reel:?}",
                1.0 / dt,
                most / force
            );
            assert!(most < 1.02 * force, "{most} N of {force} N");
            if mass * G > force {
                // with the rope that is out in the mean
                let expected = force / (mass + 0.3 * 1.4) - G;
                let gained = speed - before;
                assert!((gained / expected - 1.0).abs() < 0.02, "{gained} m/s of {expected} m/s");
                assert!(slips > 0);
            }
        }
    }
}

/// What is not built, and what makes no sense, is a typed error that changes nothing.
#[test]
fn bad_motors_are_refused_by_name() {
    let mut cable = rope(1.0, 4, GAME);
    for reel in [
        Reel { max_force: Some(-1.0), ..Reel::default() },
        Reel { max_force: Some(f64::NAN), ..Reel::default() },
        Reel { inertia: -0.1, ..Reel::free_spool() },
    ] {
        assert!(matches!(cable.add_reel(At::End, reel), Err(Error::InvalidValue { .. })));
    }
    let esdirk = Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap();
    let mut other = rope(1.0, 4, esdirk);
    assert!(matches!(other.add_reel(At::End, Reel::free_spool()), Err(Error::ReelMethod { .. })));
    assert!(!other.has_reel());
    other.add_reel(At::End, Reel::with_rate(0.1)).unwrap();
    assert!(matches!(other.set_reel(At::End, Reel::brake(3.0)), Err(Error::ReelMethod { .. })));
    assert_eq!(other.reel_description(At::End), Some(&Reel::with_rate(0.1)));
    cable.add_reel(At::End, Reel::free_spool()).unwrap();
    assert!(matches!(cable.step_with(0.01, &esdirk), Err(Error::ReelMethod { .. })));
    assert!(matches!(cable.set_integrator(esdirk), Err(Error::ReelMethod { .. })));
}

/// A cable whose fidelity is chosen takes a reel with a motor as it takes contact: engineering then
/// steps by the discrete gradient to a tolerance, whatever comes first; an integrator that is chosen
/// by itself stays, and a reel by rate changes none.
///
/// *Source.* `Integrator::COUPLED`; the contract of contact.
#[test]
fn a_chosen_fidelity_takes_reels_with_a_motor() {
    let engineering = || {
        Cable::builder()
            .points([[0.0; 3], [1.0, 0.0, 0.0]])
            .section(Section::from_stiffness(1e4, 1e-3, 0.1).unwrap())
            .fix(At::Start)
            .fix(At::End)
    };
    let mut cable = engineering().fidelity(Fidelity::Engineering).build().unwrap();
    cable.add_reel(At::End, Reel::with_rate(0.1)).unwrap();
    assert_eq!(cable.integrator(), Integrator::default());
    cable.set_reel(At::End, Reel::brake(3.0)).unwrap();
    assert_eq!(cable.integrator(), Integrator::COUPLED);
    cable.step(1.0 / 60.0).unwrap();
    let mut nobody = engineering().build().unwrap();
    nobody.add_reel(At::End, Reel::free_spool()).unwrap();
    assert_eq!(nobody.integrator(), Fidelity::Game.integrator(f64::INFINITY));
    nobody.step(1.0 / 60.0).unwrap();
}

/// A run that slips continues bitwise from its snapshot.
#[test]
fn a_snapshot_inside_a_slip_continues_bitwise() {
    let mut cable =
        rope(1.5, 8, Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) });
    cable.add_reel(At::End, Reel { max_force: Some(4.0), ..Reel::with_rate(0.2) }).unwrap();
    let run = |cable: &mut Cable| (0..20).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    run(&mut cable);
    let snapshot = cable.snapshot().clone();
    run(&mut cable);
    let (q, reel) = (cable.positions().to_vec(), cable.reel(At::End));
    assert!(reel.is_some_and(|reel| (reel.force - 4.0).abs() < 1e-2 && reel.rate > 0.5), "{reel:?}");
    cable.restore(snapshot).unwrap();
    run(&mut cable);
    let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(cable.positions()), bits(&q));
    assert_eq!(cable.reel(At::End), reel);
}

/// A reel evaluates no element of its cable once more: an iteration has one evaluation with and one without tangent, one factorisation, and one
/// solution, and a second one where a motor may slip.
///
/// *Source.* Counters, beside those of the cable without a reel.
#[test]
fn a_reel_adds_no_evaluation_of_its_cable() {
    for (name, reel, most_solutions) in [
        ("none", None, 1),
        ("standing", Some(Reel::default()), 1),
        ("turning", Some(Reel::with_rate(0.3)), 1),
        ("clutch", Some(Reel { max_force: Some(40.0), ..Reel::with_rate(0.3) }), 2),
        ("slipping", Some(Reel { max_force: Some(4.0), ..Reel::with_rate(0.3) }), 2),
    ] {
        let mut cable = rope(1.5, 8, GAME);
        reel.into_iter().for_each(|reel| cable.add_reel(At::End, reel).unwrap());
        cable.step(1.0 / 240.0).unwrap();
        cable.diagnostics_mut().reset();
        let (mut evaluations, mut before) = ([0; 2], 0);
        for _ in 0..60 {
            let elements = cable.elements().len() as u64;
            cable.step(1.0 / 240.0).unwrap();
            let iterations = cable.diagnostics().newton_iterations;
            evaluations[0] += elements * (iterations - before);
            before = iterations;
        }
        let d = cable.diagnostics();
        evaluations[1] = d.newton_iterations * most_solutions;
        println!("{name}: {} iterations, {} factorisations, {} solutions", before, d.factorisations, d.solves);
        assert_eq!(d.force_evaluations, evaluations[0], "{name}");
        assert!(d.tangent_evaluations <= evaluations[0] && d.factorisations <= d.newton_iterations, "{name}");
        assert!(d.solves <= evaluations[1], "{name}: {} solutions", d.solves);
    }
}
