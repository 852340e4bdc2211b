//! Cables that run over sheaves.

use super::common::G;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::island::{Island, PinConstraint, RigidBody, Sheave, Wheels};
use lariat_ancf::{
    At, AxialLaw, Cable, Damping, Effects, Error, Integrator, Method, Reel, Section, StepControl, Vector3,
};
use nalgebra::Matrix3;

const GAME: Integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };

/// Ropes, bodies and sheaves.
#[derive(Clone)]
struct Tackle {
    cables: Vec<Cable>,
    bodies: Vec<RigidBody>,
    pins: Vec<PinConstraint>,
    sheaves: Vec<Sheave>,
    stiffness: f64,
    dt: f64,
}

impl Tackle {
    fn new(dt: f64) -> Self {
        Tackle { cables: Vec::new(), bodies: Vec::new(), pins: Vec::new(), sheaves: Vec::new(), stiffness: 1e5, dt }
    }

    /// Adds a body of a mass in kg, with its weight.
    fn body(&mut self, mass: f64, at: Vector3<f64>, gravity: f64) -> usize {
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.05, 0.06)) * mass;
        let mut body = RigidBody::new(mass, inertia, at).unwrap();
        body.force = Vector3::new(0.0, -gravity * mass, 0.0);
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Adds a straight rope between points, each the world's or on a body with an anchor. Ends in `over` are at sheaves.
    fn rope(&mut self, ends: [(Option<usize>, Vector3<f64>); 2], density: f64, gravity: f64, over: [bool; 2]) -> usize {
        let points = ends.map(|(body, anchor)| body.map_or(anchor, |b: usize| self.bodies[b].point(&anchor)));
        let mut builder = Cable::builder()
            .points(points)
            .section(Section::from_stiffness(self.stiffness, 1e-3, density).unwrap())
            .elements(6)
            .gravity([0.0, -gravity, 0.0])
            .damping(Damping { axial: 5e-3, bending: 5e-3 })
            .integrator(GAME);
        for (at, (body, _)) in [At::Start, At::End].into_iter().zip(ends) {
            if body.is_none() {
                builder = builder.fix(at);
            }
        }
        let mut cable = builder.build().unwrap();
        for (i, (at, (body, anchor))) in [At::Start, At::End].into_iter().zip(ends).enumerate() {
            if let Some(body) = body {
                cable.attach(at).unwrap();
                let node = if i == 0 { 0 } else { cable.nodes() - 1 };
                self.pins.push(PinConstraint { cable: self.cables.len(), node, body, anchor, direction: None });
            }
            if over[i] {
                cable.add_reel(at, Reel::over_sheave()).unwrap();
            }
        }
        self.cables.push(cable);
        self.cables.len() - 1
    }

    fn try_step(&mut self) -> Result<(), Error> {
        for cable in &mut self.cables {
            cable.remesh_reel()?;
        }
        for pin in &mut self.pins {
            pin.node = if pin.node == 0 { 0 } else { self.cables[pin.cable].nodes() - 1 };
        }
        let mut cables: Vec<&mut Cable> = self.cables.iter_mut().collect();
        let Tackle { bodies, pins, sheaves, dt, .. } = self;
        Island::default().step_with_wheels(
            &mut cables,
            bodies,
            pins,
            Wheels { sheaves, drums: &[] },
            (&GAME).into(),
            *dt,
        )
    }

    fn run(&mut self, time: f64) {
        (0..(time / self.dt).round() as usize).for_each(|_| self.try_step().unwrap());
    }

    /// Returns the energy of all in J, and what was lost of it.
    fn account(&self, gravity: f64) -> f64 {
        let of_bodies = |b: &RigidBody| b.kinetic_energy() + b.mass * gravity * b.position.y + b.energy_in_store();
        let of_cable = |cable: &Cable| {
            let law = cable.energy_law();
            let remeshed: f64 = cable.reels().map(|reel| reel.remeshed).sum();
            cable.energy().total() + cable.energy_in_store() + cable.effect_work().dissipated() + law.numerical
                - remeshed
                + law.rescaled
        };
        let of_sheave = |sheave: &Sheave| {
            let at = if sheave.to.1 { At::Start } else { At::End };
            0.5 * sheave.inertia * self.cables[sheave.to.0].reel(at).unwrap().rate.powi(2) + sheave.lost
        };
        self.cables.iter().map(of_cable).sum::<f64>()
            + self.bodies.iter().map(of_bodies).sum::<f64>()
            + self.sheaves.iter().map(of_sheave).sum::<f64>()
    }
}

/// Two loads on one rope over a sheave at the origin.
fn atwood(loads: [f64; 2], lengths: [f64; 2], density: f64, dt: f64) -> Tackle {
    let mut tackle = Tackle::new(dt);
    let [a, b] = [0, 1].map(|i| tackle.body(loads[i], Vector3::new(0.0, -lengths[i], 0.0), G));
    let top = (None, Vector3::zeros());
    tackle.rope([(Some(a), Vector3::zeros()), top], density, G, [false, true]);
    tackle.rope([top, (Some(b), Vector3::zeros())], density, G, [true, false]);
    tackle.sheaves.push(Sheave::new((0, At::End), (1, At::Start)));
    tackle
}

/// Atwood's machine with friction under every axial law: the speed is that under Green's law but
/// for the strain, and the account of energy closes.
///
/// *Source.* Conservation of energy; the laws differ by 3/2 of the strain, 2e-4 here.
#[test]
fn an_atwood_machine_moves_under_every_axial_law() {
    let curve = AxialLaw::Curve(vec![[0.0, 0.0], [1e-3, 80.0], [0.1, 8e3]]);
    let run = |law: Option<AxialLaw>| {
        let mut tackle = atwood([1.0, 2.0], [3.0, 1.0], 0.05, 1.0 / 240.0);
        for cable in &mut tackle.cables {
            cable.set_effects(Effects { axial_law: law.clone(), ..cable.effects().clone() }).unwrap();
        }
        tackle.sheaves[0].friction = 0.1;
        tackle.run(0.3);
        let start = tackle.account(G);
        tackle.run(0.4);
        let reel = tackle.cables[1].reel(At::Start).unwrap();
        (reel, (tackle.account(G) - start) / (0.5 * 3.2 * reel.rate * reel.rate))
    };
    let (green, _) = run(None);
    for law in [AxialLaw::Hooke, AxialLaw::Rope, curve] {
        let (reel, missed) = run(Some(law.clone()));
        println!("{law:?}: {:e} of the rate, {missed:e} of the energy", reel.rate / green.rate - 1.0);
        assert!((reel.rate / green.rate - 1.0).abs() < 1e-3, "{law:?}: {reel:?} {green:?}");
        assert!(missed.abs() < 4e-3 && reel.splits > 0, "{law:?}: {missed} {reel:?}");
    }
}

/// Atwood's machine with a heavy rope, without and with friction and inertia, in both directions: it moves as its equation says, to 0.5 % of
/// the speed, with the ratio of tensions of the capstan, to 0.1 %; over splits and merges. The account of energy closes.
///
/// *Source.* Inextensible rope with the lengths L: `m u'' = F_b - F_a - P`, `F_a = (M_a + rho L_a)(g + u'')`, `F_b = (M_b + rho L_b)(g - u'')`,
/// `P = (exp(mu pi) - 1)(F_low - rho u'^2) + brake`.
#[test]
fn an_atwood_machine_moves_as_its_equation_says() {
    for (loads, lengths, density, friction, inertia, brake, dt) in [
        ([1.0, 1.5], [3.0, 1.0], 0.01, 0.0, 0.0, 0.0, 1.0 / 240.0),
        ([1.0, 1.5], [3.0, 1.0], 0.2, 0.0, 0.4, 0.0, 1.0 / 480.0),
        ([1.0, 2.0], [3.0, 1.0], 0.01, 0.1, 0.0, 0.0, 1.0 / 240.0),
        ([40.0, 13.0], [1.0, 3.0], 0.3, 0.2, 1.0, 2.0, 1.0 / 240.0),
        ([2.0, 7.0], [3.0, 1.5], 0.1, 0.3, 0.0, 1.0, 1.0 / 480.0),
        ([1.0, 5.0], [3.0, 1.0], 0.02, 0.4, 0.0, 0.0, 1.0 / 480.0),
        ([10.0, 3.0], [1.0, 3.0], 0.1, 0.15, 0.0, 0.0, 1.0 / 240.0),
    ] {
        let mut tackle = atwood(loads, lengths, density, dt);
        let wheel = &mut tackle.sheaves[0];
        (wheel.friction, wheel.inertia, wheel.brake) = (friction, inertia, brake);
        // the ropes are stretched first
        tackle.run(0.3);
        let rate = |tackle: &Tackle| tackle.cables[1].reel(At::Start).unwrap().rate;
        let (start, mut v, mut u) = (tackle.account(G), rate(&tackle), tackle.sheaves[0].passed);
        let v0 = v;
        let mut worst = 0.0f64;
        let grip = (friction * std::f64::consts::PI).exp() - 1.0;
        let forward = v0 > 0.0;
        let mut ratios = (0.0, 0);
        for _ in 0..(0.4 / dt).round() as usize {
            tackle.try_step().unwrap();
            for _ in 0..50 {
                let [a, b] = [loads[0] + density * (lengths[0] - u), loads[1] + density * (lengths[1] + u)];
                let lift = density * v * v;
                let e = 1.0 + grip;
                let acceleration = if forward {
                    (b * G - e * a * G + grip * lift - brake) / (inertia + b + e * a)
                } else {
                    (e * b * G - a * G - grip * lift + brake) / (inertia + e * b + a)
                };
                let h = dt / 50.0;
                u += h * (v + 0.5 * h * acceleration);
                v += h * acceleration;
            }
            worst = worst.max((tackle.account(G) - start).abs());
            let tensions = [(0, At::End), (1, At::Start)].map(|(c, at)| tackle.cables[c].reel(at).unwrap().force);
            let lift = density * rate(&tackle).powi(2);
            let [low, high] = if forward { tensions } else { [tensions[1], tensions[0]] };
            ratios.0 += (high - lift) / (low - lift);
            ratios.1 += 1;
        }
        let gained = (rate(&tackle) - v0) / (v - v0);
        let ratio = ratios.0 / f64::from(ratios.1);
        let [a, b] = [0, 1].map(|c| tackle.cables[c].reels().next().unwrap());
        println!(
            "{loads:?} kg, {density} kg/m, mu {friction}: {gained} of the speed gained, ratio {ratio} of {}, {worst:e} J, {} {} {} {}",
            1.0 + grip,
            a.splits,
            a.merges,
            b.splits,
            b.merges
        );
        assert!((gained - 1.0).abs() < 5e-3, "{gained}");
        if brake == 0.0 && inertia == 0.0 {
            assert!((ratio / (1.0 + grip) - 1.0).abs() < 1e-3, "{ratio}");
        }
        let moved = tackle.bodies.iter().map(RigidBody::kinetic_energy).sum::<f64>();
        assert!(worst < 5e-3 * moved, "{worst:e} J of {moved} J");
        assert!((tackle.sheaves[0].passed - u).abs() < 5e-3 * u.abs());
    }
}

/// Friction holds loads that differ by less than it carries, without creep, by the capstan or by a brake; the tensions differ by the loads.
///
/// *Source.* `exp(0.1 pi) = 1.369 > 1.2`.
#[test]
fn a_sheave_sticks_where_friction_holds_the_loads() {
    for (friction, brake, dt) in [(0.1, 0.0, 1.0 / 240.0), (0.0, 2.5, 1.0 / 60.0), (0.05, 1.5, 1.0 / 480.0)] {
        let mut tackle = atwood([1.0, 1.2], [2.0, 2.0], 0.01, dt);
        (tackle.sheaves[0].friction, tackle.sheaves[0].brake) = (friction, brake);
        tackle.run(1.0);
        let settled = tackle.sheaves[0].passed;
        tackle.run(2.0);
        let pulls = [(0, At::End), (1, At::Start)].map(|(c, at)| tackle.cables[c].reel(at).unwrap().force);
        println!("{settled:e} m, then {:e} m, {pulls:?}", tackle.sheaves[0].passed - settled);
        assert!(settled.abs() < 2e-3 && (tackle.sheaves[0].passed - settled).abs() < 1e-12);
        assert!((pulls[1] / pulls[0] - 1.22 / 1.02).abs() < 1e-3, "{pulls:?}");
    }
}

/// A tackle of four parts: a load of W on a block with two sheaves, two sheaves above, and a load P on the hauling part. It moves as its
/// equation says, and with friction the tension grows from part to part by the capstan.
///
/// *Source.* Massless rope: with k = exp(mu pi), T the tension of the dead part and v = 4 V, `P (g - v') = k^4 T` and `T (1 + k + k^2 + k^3) = W (g + v'/4)`.
#[test]
fn a_tackle_of_four_multiplies_force_and_divides_speed() {
    for (load, haul, friction, dt) in
        [(12.0, 5.0, 0.0, 1.0 / 240.0), (12.0, 8.0, 0.05, 1.0 / 240.0), (200.0, 120.0, 0.1, 1.0 / 480.0)]
    {
        let mut tackle = Tackle::new(dt);
        let block = tackle.body(load, Vector3::new(0.0, -3.0, 0.0), G);
        let hauled = tackle.body(haul, Vector3::new(0.0, -1.0, 0.0), G);
        let (above, below) = ((None, Vector3::zeros()), (Some(block), Vector3::zeros()));
        let density = 5e-5 * load;
        tackle.stiffness = 1e4 * load;
        let parts = [(above, below), (below, above), (above, below), (below, above)];
        for (i, (from, to)) in parts.into_iter().enumerate() {
            tackle.rope([from, to], density, G, [i > 0, true]);
        }
        tackle.rope([above, (Some(hauled), Vector3::zeros())], density, G, [true, false]);
        for i in 0..4 {
            let mut sheave = Sheave::new((i, At::End), (i + 1, At::Start));
            sheave.friction = friction;
            tackle.sheaves.push(sheave);
        }
        tackle.run(0.2);
        let speeds = |tackle: &Tackle| [block, hauled].map(|b| tackle.bodies[b].velocity.y);
        let (before, start) = (speeds(&tackle), tackle.account(G));
        tackle.run(0.4);
        let after = speeds(&tackle);
        let k = (friction * std::f64::consts::PI).exp();
        let sum = 1.0 + k + k * k + k * k * k;
        // the rope weighs less than a thousandth
        let acceleration = (haul * G * sum / k.powi(4) - load * G) / (haul * sum / k.powi(4) + load / 4.0);
        let gained = (before[1] - after[1]) / (0.4 * acceleration);
        let pulls: Vec<f64> = (1..5).map(|c| tackle.cables[c].reel(At::Start).unwrap().force).collect();
        let ends: Vec<f64> = (0..4).map(|c| tackle.cables[c].reel(At::End).unwrap().force).collect();
        let missing = (tackle.account(G) - start).abs();
        println!("{gained} of the acceleration, {after:?} m/s, {pulls:?} {ends:?}, {missing:e} J");
        let moved: f64 = tackle.bodies.iter().map(RigidBody::kinetic_energy).sum();
        assert!(missing < 2e-3 * moved, "{missing:e} J of {moved} J");
        assert!((gained - 1.0).abs() < 5e-3, "{gained}");
        assert!((after[1] / after[0] + 4.0).abs() < 0.01, "{after:?}");
        for (out, into) in pulls.iter().zip(&ends) {
            assert!((out / into / k - 1.0).abs() < 2e-3, "{out} N over {into} N");
        }
    }
}

/// A rope over a sheave on a body that floats freely, with loads at both ends that fly in space: momentum stays to 1e-8, and the account of
/// energy closes but for what the impacts after a merge take.
///
/// *Source.* Conservation of momentum and energy.
#[test]
fn a_sheave_on_a_free_body_keeps_momentum_and_energy() {
    for friction in [0.0, 0.15] {
        let mut missing = Vec::new();
        for dt in [1.0 / 240.0, 1.0 / 480.0] {
            let mut tackle = Tackle::new(dt);
            let hub = tackle.body(3.0, Vector3::new(0.1, 0.2, 0.0), 0.0);
            let loads = [(1.0, -1.5), (2.0, 1.5)].map(|(mass, x)| tackle.body(mass, Vector3::new(x, -1.0, 0.0), 0.0));
            let eye = (Some(hub), Vector3::new(-0.1, -0.2, 0.0));
            tackle.rope([(Some(loads[0]), Vector3::zeros()), eye], 0.3, 0.0, [false, true]);
            tackle.rope([eye, (Some(loads[1]), Vector3::zeros())], 0.3, 0.0, [true, false]);
            let mut sheave = Sheave::new((0, At::End), (1, At::Start));
            (sheave.friction, sheave.inertia) = (friction, 0.2);
            tackle.sheaves.push(sheave);
            tackle.bodies[loads[0]].velocity = Vector3::new(-0.5, -1.0, 0.4);
            tackle.bodies[loads[1]].velocity = Vector3::new(1.5, -1.0, 0.0);
            tackle.bodies[hub].velocity = Vector3::new(0.0, 0.5, 0.0);
            let momentum = |tackle: &Tackle| {
                let of_cables = tackle.cables.iter().map(|cable| cable.momentum().linear).sum::<Vector3<f64>>();
                of_cables + tackle.bodies.iter().map(|body| body.momentum().0).sum::<Vector3<f64>>()
            };
            tackle.try_step().unwrap();
            let (p, start, mut worst) = (momentum(&tackle), tackle.account(0.0), [0.0f64; 2]);
            for _ in 0..(1.0 / dt) as usize {
                tackle.try_step().unwrap();
                worst[0] = worst[0].max((momentum(&tackle) - p).norm() / p.norm());
                worst[1] = worst[1].max((tackle.account(0.0) - start).abs());
            }
            println!("mu {friction}, 1/{:.0} s: {worst:?}, {:?}", 1.0 / dt, tackle.sheaves[0]);
            assert!(tackle.sheaves[0].passed.abs() > 0.01 && worst[0] < 1e-8, "{worst:?}");
            missing.push(worst[1]);
        }
        assert!(missing.iter().all(|missing| *missing < 1e-3), "{missing:?} J of 5 J");
    }
}

/// A run continues bitwise from copies of cables, bodies and sheaves; and what makes no sheave is refused by name and changes nothing.
#[test]
fn sheaves_are_plain_state_and_refused_by_name() {
    let mut tackle = atwood([1.0, 2.0], [3.0, 1.0], 0.1, 1.0 / 240.0);
    tackle.sheaves[0].friction = 0.1;
    tackle.run(0.3);
    let mut other = tackle.clone();
    for (cable, from) in other.cables.iter_mut().zip(&tackle.cables) {
        cable.restore(from.snapshot().clone()).unwrap();
    }
    [&mut tackle, &mut other].into_iter().for_each(|tackle| tackle.run(0.2));
    let bits = |tackle: &Tackle| {
        let of_cables = tackle.cables.iter().flat_map(|cable| cable.positions()).map(|x| x.to_bits());
        (of_cables.collect::<Vec<_>>(), tackle.sheaves[0])
    };
    assert!(bits(&tackle) == bits(&other));

    let refused = |change: &dyn Fn(&mut Tackle), words: &str| {
        let mut tackle = atwood([1.0, 2.0], [3.0, 1.0], 0.1, 1.0 / 240.0);
        change(&mut tackle);
        let before = tackle.cables[0].snapshot().clone();
        let error = tackle.try_step().unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
        assert!(&before == tackle.cables[0].snapshot());
    };
    refused(&|tackle| tackle.sheaves.clear(), "which this island does not have");
    refused(&|tackle| tackle.sheaves[0].friction = -0.1, "friction of a sheave");
    refused(&|tackle| tackle.sheaves[0].inertia = f64::NAN, "inertia of a sheave");
    refused(&|tackle| tackle.sheaves[0].to = (7, true), "7");
    refused(&|tackle| tackle.sheaves[0].to = (1, false), "no Reel::over_sheave");
    refused(&|tackle| tackle.sheaves[0].to = tackle.sheaves[0].from, "at one sheave");
    // what passes would take the section of the other side
    for (axial, bending, mass) in [(2.0, 1.0, 1.0), (1.0, 2.0, 1.0), (1.0, 1.0, 2.0)] {
        let other = |tackle: &mut Tackle| {
            let from = tackle.cables[1].elements()[0].section;
            let [ea, ei, rho] =
                [from.axial_stiffness * axial, from.bending_stiffness.max(1e-3) * bending, from.mass_per_length];
            let section = Section::from_stiffness(ea, ei, rho * mass).unwrap();
            let points =
                [tackle.cables[1].node_position(0), tackle.cables[1].node_position(tackle.cables[1].nodes() - 1)];
            let builder = Cable::builder().points(points).section(section).elements(6).integrator(GAME);
            let mut cable = builder.fix(At::Start).build().unwrap();
            cable.attach(At::End).unwrap();
            cable.add_reel(At::Start, Reel::over_sheave()).unwrap();
            tackle.cables[1] = cable;
        };
        refused(&other, "one mass per length, EA and EI");
    }
    let mut alone = atwood([1.0, 2.0], [3.0, 1.0], 0.1, 1.0 / 240.0).cables.remove(1);
    alone.release(At::End).unwrap();
    assert!(alone.step(0.01).unwrap_err().to_string().contains("only an island with that sheave"));
}
