//! Drums that are bodies: the reel has the rate of their spin, and they feel its pull.

use super::common::G;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Drum, Island, PinConstraint, RigidBody, Wheels};
use lariat_ancf::{
    At, AxialLaw, Cable, Damping, Effects, Error, Integrator, Method, Reel, Section, StepControl, Vector3,
};
use nalgebra::{Matrix3, UnitQuaternion};

const GAME: Integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };

/// A cable from a load, body 0, to an eye over a drum, body 1; the eye is fixed, or on body 2.
struct Winch {
    cable: Cable,
    at: At,
    bodies: Vec<RigidBody>,
    pins: Vec<PinConstraint>,
    drum: Drum,
    island: Island,
}

/// What a drum and its cable are made of.
#[derive(Clone, Copy)]
struct Data {
    /// kg/m, m, kg.
    density: f64,
    stock: f64,
    load: f64,
    /// Inertia of the drum in kg m^2, its radius in m, its torque in N m.
    inertia: f64,
    radius: f64,
    torque: f64,
}

impl Winch {
    fn new(at: At, data: Data, gravity: f64, holder: Option<RigidBody>) -> Self {
        let length = 1.2;
        let load = Vector3::new(0.0, -length, 0.0);
        let points = if at == At::End { [load, Vector3::zeros()] } else { [Vector3::zeros(), load] };
        let mut builder = Cable::builder()
            .points(points)
            .section(Section::from_stiffness(2.0e5, 1e-3, data.density).unwrap())
            .elements(6)
            .gravity(Vector3::new(0.0, -gravity, 0.0))
            .damping(Damping { axial: 2e-3, bending: 2e-3 })
            .integrator(GAME);
        if holder.is_none() {
            builder = builder.fix(at);
        }
        let mut cable = builder.build().unwrap();
        cable.add_reel(at, Reel { stock: Some(data.stock), ..Reel::on_drum() }).unwrap();
        let far = if at == At::End { At::Start } else { At::End };
        cable.attach(far).unwrap();
        let mut bodies = vec![RigidBody::new(data.load, Matrix3::identity() * 0.02 * data.load, load).unwrap()];
        bodies[0].force = Vector3::new(0.0, -gravity * data.load, 0.0);
        // the axis is x of the drum and z of the world
        let inertia = Matrix3::from_diagonal(&Vector3::new(1.0, 0.8, 0.8)) * data.inertia;
        let mut drum = RigidBody::new(5.0, inertia, Vector3::new(data.radius, 0.0, 0.0)).unwrap();
        drum.rotation = UnitQuaternion::from_euler_angles(0.0, -std::f64::consts::FRAC_PI_2, 0.0);
        drum.torque = Vector3::new(0.0, 0.0, data.torque);
        if holder.is_none() {
            drum.free = [false, false, false, false, false, true];
        }
        bodies.push(drum);
        let mut pins = vec![PinConstraint { cable: 0, node: 0, body: 0, anchor: Vector3::zeros(), direction: None }];
        if let Some(holder) = holder {
            cable.attach(at).unwrap();
            pins.push(PinConstraint { cable: 0, node: 0, body: 2, anchor: -holder.position, direction: None });
            bodies.push(holder);
        }
        let axis = bodies[1].rotation.inverse() * Vector3::z();
        let drum = Drum { cable: (0, at == At::Start), body: 1, axis, radius: data.radius };
        Winch { cable, at, bodies, pins, drum, island: Island::default() }
    }

    fn step(&mut self, dt: f64) -> Result<(), Error> {
        self.cable.remesh_reel().unwrap();
        let last = self.cable.nodes() - 1;
        let (load, eye) = if self.at == At::End { (0, last) } else { (last, 0) };
        self.pins[0].node = load;
        self.pins.iter_mut().skip(1).for_each(|pin| pin.node = eye);
        let Winch { cable, bodies, pins, drum, island, .. } = self;
        island.step_with_wheels(
            &mut [cable],
            bodies,
            pins,
            Wheels { drums: &[*drum], ..Wheels::default() },
            (&GAME).into(),
            dt,
        )
    }

    /// Returns the energy of all in J with what was lost.
    fn energy(&self, data: &Data, gravity: f64) -> f64 {
        let reel = self.cable.reel(self.at).unwrap();
        let law = self.cable.energy_law();
        let spun = 0.5 * data.density * (data.stock - reel.length_out) * reel.rate * reel.rate;
        let of_bodies: f64 =
            self.bodies.iter().map(|body| body.kinetic_energy() + gravity * body.mass * body.position.y).sum();
        self.cable.energy().total() + of_bodies + spun - reel.remeshed
            + self.cable.effect_work().dissipated()
            + law.numerical
            + law.rescaled
    }

    fn spin(&self) -> f64 {
        self.bodies[1].angular_velocity.z
    }
}

/// A load on a rope with mass turns a drum that is free, held by a brake's torque, or driven so that it hoists: speed and length are those of the
/// equation, the rate is the spin, and the torque of the drum does the work.
///
/// *Source.* `(J/R^2 + rho S + m) L'' = g (rho L + m) + M/R`, S the whole rope, integrated in closed form: with k^2 = rho g over the mass,
/// `L + b = (L_0 + b) cosh(k t)`, `b = m/rho + M/(R rho g)`.
#[test]
fn a_load_turns_a_drum_and_a_drum_hoists_a_load() {
    let cases = [
        (At::End, Data { density: 0.3, stock: 6.0, load: 2.0, inertia: 0.05, radius: 0.15, torque: 0.0 }, 1.0 / 240.0),
        (At::Start, Data { density: 1.2, stock: 4.0, load: 0.5, inertia: 0.4, radius: 0.3, torque: 0.0 }, 1.0 / 120.0),
        (
            At::End,
            Data { density: 0.1, stock: 8.0, load: 30.0, inertia: 3.0, radius: 0.25, torque: -90.0 },
            1.0 / 240.0,
        ),
        (
            At::Start,
            Data { density: 0.2, stock: 8.0, load: 20.0, inertia: 1.5, radius: 0.1, torque: -14.0 },
            1.0 / 480.0,
        ),
    ];
    for (at, data, dt) in cases {
        let mut winch = Winch::new(at, data, G, None);
        let Data { density, stock, load, inertia, radius, torque } = data;
        let mass = inertia / (radius * radius) + density * stock + load;
        let k = (density * G / mass).sqrt();
        let b = load / density + torque / (radius * density * G);
        let at_time = |t: f64| ((1.2 + b) * (k * t).cosh() - b, (1.2 + b) * k * (k * t).sinh());
        let start = winch.energy(&data, G);
        let mut worked = 0.0;
        for _ in 0..(0.5 / dt) as usize {
            let before = winch.spin();
            winch.step(dt).unwrap();
            worked += 0.5 * (before + winch.spin()) * torque * dt;
        }
        let (wanted, reel) = (at_time(0.5), winch.cable.reel(at).unwrap());
        let moved = load * G * (wanted.0 - 1.2).abs();
        let missed = winch.energy(&data, G) - start - worked;
        println!("{at:?}: {reel:?} of {wanted:?}, spin {}, energy {missed:.2e} of {moved:.2} J", winch.spin());
        assert!((reel.length_out - wanted.0).abs() < 5e-3 * (wanted.0 - 1.2).abs(), "{reel:?} of {wanted:?}");
        assert!((winch.spin() * radius - wanted.1).abs() < 0.01 * wanted.1.abs(), "{} of {wanted:?}", winch.spin());
        assert!((winch.spin() * radius - reel.rate).abs() < 0.01 * wanted.1.abs(), "{} and {reel:?}", winch.spin());
        assert!(missed.abs() < 0.01 * moved, "{missed} J of {moved} J");
    }
}

/// A load turns a drum under every axial law: the speed is that under Green's law but for the
/// strain, and the account of energy closes.
///
/// *Source.* Conservation of energy; the laws differ by 3/2 of the strain, 1e-4 here.
#[test]
fn a_drum_turns_under_every_axial_law() {
    let data = Data { density: 0.3, stock: 6.0, load: 2.0, inertia: 0.05, radius: 0.15, torque: 0.0 };
    let curve = AxialLaw::Curve(vec![[0.0, 0.0], [1e-3, 150.0], [0.1, 1.5e4]]);
    for at in [At::Start, At::End] {
        let run = |law: Option<AxialLaw>| {
            let mut winch = Winch::new(at, data, G, None);
            let effects = Effects { axial_law: law, ..winch.cable.effects().clone() };
            winch.cable.set_effects(effects).unwrap();
            let start = winch.energy(&data, G);
            (0..120).for_each(|_| winch.step(1.0 / 240.0).unwrap());
            let reel = winch.cable.reel(at).unwrap();
            let moved = data.load * G * (reel.length_out - 1.2);
            (reel, (winch.energy(&data, G) - start) / moved)
        };
        let (green, _) = run(None);
        for law in [AxialLaw::Hooke, AxialLaw::Rope, curve.clone()] {
            let (reel, missed) = run(Some(law.clone()));
            println!("{law:?}: {:e} of the rate, {missed:e} of the energy", reel.rate / green.rate - 1.0);
            assert!((reel.rate / green.rate - 1.0).abs() < 1e-3, "{law:?}: {reel:?} {green:?}");
            assert!(missed.abs() < 0.01 && reel.splits > 0, "{law:?}: {missed} {reel:?}");
        }
    }
}

/// A drum turns in a frame that tumbles, by opposite torques on both, and draws in a cable with a load, all free: linear momentum stays to 1e-8, angular momentum to
/// 1e-5 and what merging changes, and the energy closes to less than 1 % of the work.
///
/// *Source.* Conservation of momentum, angular momentum and energy.
#[test]
fn a_drum_in_a_free_frame_keeps_momentum_and_energy() {
    let data = Data { density: 0.4, stock: 4.0, load: 3.0, inertia: 0.05, radius: 0.2, torque: -1.0 };
    let other = Data { density: 0.3, stock: 5.0, load: 2.0, inertia: 0.08, radius: 0.15, torque: -0.8 };
    let cases = [(At::End, data), (At::Start, data), (At::Start, other)];
    for (at, data) in cases {
        let mut missing = Vec::new();
        for dt in [1.0 / 240.0, 1.0 / 480.0, 1.0 / 960.0] {
            let inertia = Matrix3::from_diagonal(&Vector3::new(5.0, 3.0, 4.0));
            let mut holder = RigidBody::new(6.0, inertia, Vector3::new(0.1, 0.2, -0.1)).unwrap();
            holder.angular_velocity = Vector3::new(0.2, -0.3, 0.1);
            let mut winch = Winch::new(at, data, 0.0, Some(holder));
            winch.bodies[2].torque = -winch.bodies[1].torque;
            winch.bodies[0].velocity = Vector3::new(0.1, 0.0, 0.05);
            let momentum = |winch: &Winch| {
                let own = winch.cable.momentum();
                winch.bodies.iter().fold([own.linear, own.angular], |[p, l], body| {
                    let (linear, angular) = body.momentum();
                    [p + linear, l + angular]
                })
            };
            winch.step(dt).unwrap();
            let ([p0, l0], start) = (momentum(&winch), winch.energy(&data, 0.0));
            let (mut worst, mut first, mut quiet) = ([0.0f64; 3], [0.0f64; 3], true);
            let relative = |winch: &Winch| (winch.bodies[1].angular_velocity - winch.bodies[2].angular_velocity).z;
            let mut worked = 0.0;
            for _ in 0..(1.0 / dt) as usize {
                let before = relative(&winch);
                winch.step(dt).unwrap();
                worked += 0.5 * (before + relative(&winch)) * data.torque * dt;
                let [p, l] = momentum(&winch);
                let missed = winch.energy(&data, 0.0) - start - worked;
                let now = [(p - p0).norm() / p0.norm(), (l - l0).norm() / l0.norm(), missed.abs()];
                (0..3).for_each(|i| worst[i] = worst[i].max(now[i]));
                let reel = winch.cable.reel(at).unwrap();
                quiet &= reel.splits + reel.merges == 0;
                if quiet {
                    first = worst;
                }
            }
            let reel = winch.cable.reel(at).unwrap();
            println!("{at:?} at 1/{:.0} s: {worst:?}, before remeshing {first:?}, {reel:?}", 1.0 / dt);
            assert!(reel.splits + reel.merges > 0, "{reel:?}");
            assert!(worst[0] < 1e-8 && first[1] < 1e-5 && worst[1] < 1e-3, "{worst:?} {first:?}");
            missing.push(worst[2] / worked);
        }
        println!("{missing:?}");
        assert!(missing[0] < 0.01 && missing[2] < 2e-3, "{missing:?}");
    }
}

/// A falling load stops, without a jerk of the rope beyond its stop, when all of the stock is out, and the drum with it.
///
/// *Source.* The constraint: the rate is the spin at any time.
#[test]
fn a_drum_stops_with_its_rope_at_the_end_of_the_stock() {
    let data = Data { density: 0.3, stock: 2.0, load: 2.0, inertia: 0.05, radius: 0.15, torque: 0.0 };
    let mut winch = Winch::new(At::End, data, G, None);
    let mut fastest = 0.0f64;
    for _ in 0..480 {
        winch.step(1.0 / 240.0).unwrap();
        let reel = winch.cable.reel(At::End).unwrap();
        assert!(reel.length_out < data.stock + 1e-3, "{reel:?}");
        assert!((winch.spin() * data.radius - reel.rate).abs() < 0.1, "{reel:?}, spin {}", winch.spin());
        fastest = fastest.max(reel.rate);
    }
    let reel = winch.cable.reel(At::End).unwrap();
    println!("{reel:?}, fastest {fastest} m/s");
    assert!(
        fastest > 1.0 && (data.stock - reel.length_out).abs() < 1e-3 && reel.rate.abs() < 1e-6 && reel.stopped,
        "{reel:?}"
    );
    assert!(winch.spin().abs() < 1e-4, "{}", winch.spin());
}

/// What makes no drum is refused by name, and nothing changes.
#[test]
fn what_makes_no_drum_is_refused_by_name() {
    let data = Data { density: 0.3, stock: 6.0, load: 2.0, inertia: 0.05, radius: 0.15, torque: 0.0 };
    let refused = |change: &dyn Fn(&mut Winch)| {
        let mut winch = Winch::new(At::End, data, G, None);
        change(&mut winch);
        let before = (winch.cable.snapshot().clone(), winch.bodies.clone());
        let error = winch.step(0.01).unwrap_err();
        assert!(before == (winch.cable.snapshot().clone(), winch.bodies.clone()));
        println!("{error}");
        error
    };
    for radius in [0.0, -1.0, f64::NAN] {
        assert!(matches!(refused(&|winch| winch.drum.radius = radius), Error::InvalidValue { .. }));
    }
    assert!(matches!(refused(&|winch| winch.drum.axis = Vector3::zeros()), Error::InvalidValue { .. }));
    assert!(matches!(refused(&|winch| winch.drum.body = 2), Error::NotInIsland { what: "bodies", .. }));
    assert!(matches!(refused(&|winch| winch.drum.cable.0 = 1), Error::NotInIsland { what: "cables", .. }));
    assert!(matches!(refused(&|winch| winch.drum.cable.1 = true), Error::ReelPlace { .. }));
    let mut holder = RigidBody::new(1.0, Matrix3::identity(), Vector3::zeros()).unwrap();
    holder.free = [false; 6];
    let mut winch = Winch::new(At::End, data, G, Some(holder));
    winch.drum.body = 2;
    assert!(matches!(winch.step(0.01), Err(Error::ReelPlace { reason, .. }) if reason.contains("holds its eye")));
    // without its island
    assert!(matches!(winch.cable.step(0.01), Err(Error::ReelPlace { .. })));
    assert!(matches!(winch.cable.set_reel_rate(At::End, 1.0), Err(Error::InvalidValue { .. })));
    let mut other = winch.cable.clone();
    other.remove_reel(At::End).unwrap();
    let reel = Reel { max_force: Some(5.0), ..Reel::on_drum() };
    assert!(matches!(other.add_reel(At::End, reel), Err(Error::InvalidValue { .. })));
}
