//! Axial laws: Hooke's, that of a rope which cannot push, and measured curves.

mod common;

use common::rule;
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{
    At, AxialLaw, Cable, CableBuilder, Damping, Effects, Error, Fidelity, Integrator, Method, PointLoad, Section,
    StepControl, Vector3,
};

fn with(law: AxialLaw) -> Effects {
    Effects { axial_law: Some(law), ..Effects::default() }
}

fn nylon() -> AxialLaw {
    AxialLaw::Curve(vec![[0.0, 0.0], [0.05, 400.0], [0.1, 1200.0], [0.2, 5000.0], [0.3, 11000.0]])
}

fn laws() -> Vec<AxialLaw> {
    vec![AxialLaw::Hooke, AxialLaw::Rope, nylon()]
}

/// A hanging rope of 2 m in 4 elements.
fn hanging(law: Option<AxialLaw>, axial: f64) -> CableBuilder {
    let effects = law.map_or_else(Effects::default, with);
    let points = [Vector3::zeros(), Vector3::new(0.0, -2.0, 0.0)];
    let section = Section::from_stiffness(axial, 0.1, 0.07).unwrap();
    Cable::builder().points(points).section(section).elements(4).effects(effects).fix(At::Start)
}

/// A load hangs at the strain that the law gives, by the reading and by the reaction.
///
/// *Source.* The law itself: N = EA e; a row of the table.
#[test]
fn a_hanging_load_strains_the_rope_by_the_law() {
    for (law, force, strain) in [
        (AxialLaw::Hooke, 5000.0, 0.05),
        (AxialLaw::Rope, 5000.0, 0.05),
        (nylon(), 1200.0, 0.1),
        (nylon(), 5000.0, 0.2),
    ] {
        for name in ["projected-3", "G5-3", "L2T2"] {
            let builder = hanging(Some(law.clone()), 1e5).rule(rule(name)).gravity(Vector3::zeros());
            let mut rope = builder.load(PointLoad::force(2.0, Vector3::new(0.0, -force, 0.0))).build().unwrap();
            rope.equilibrium().unwrap();
            let stretch = -common::tip(&rope).y / 2.0 - 1.0;
            assert!((stretch - strain).abs() < 1e-9, "{law:?} {name}: {stretch}");
            assert!((rope.sample(1.1).unwrap().tension / force - 1.0).abs() < 1e-8);
            assert!((rope.reactions().unwrap()[0].force.y / force - 1.0).abs() < 1e-8);
        }
    }
}

/// Heave of 50 t on 200 m of rope at 1 % strain: amplitude of the forced response and the own frequency are the linear ones.
///
/// *Source.* A linear spring EA/L without mass, the mass hanging on it: omega^2 = EA/(L m).
#[test]
fn heave_on_a_strained_rope_has_the_linear_frequency() {
    let (mass, length) = (50e3, 200.0);
    let axial = mass * 9.81 / 0.01;
    let omega = f64::sqrt(axial / (length * mass));
    let frequency = |law: Option<AxialLaw>| {
        // the load is a heavy last element; the rope has hardly any mass
        let light = Section::from_stiffness(axial, 0.0, 1e-3).unwrap();
        let effects = law.map_or_else(Effects::default, with);
        let builder =
            Cable::builder().points([Vector3::zeros(), Vector3::new(0.0, -length, 0.0)]).section(light).elements(4);
        let builder = builder
            .rule(rule("G5-none"))
            .allow_rank_deficient()
            .effects(effects)
            .fix(At::Start)
            .gravity(Vector3::zeros());
        let mut rope = builder.load(PointLoad::force(length, Vector3::new(0.0, -mass * 9.81, 0.0))).build().unwrap();
        rope.equilibrium().unwrap();
        // stiffness at the working point, by a little more load
        let before = common::tip(&rope).y;
        let more = 1e-4 * mass * 9.81;
        rope.add_load(PointLoad::force(length, Vector3::new(0.0, -more, 0.0))).unwrap();
        rope.equilibrium().unwrap();
        (more / (before - common::tip(&rope).y) / mass).sqrt()
    };
    let [green, hooke] = [frequency(None), frequency(Some(AxialLaw::Hooke))];
    println!("omega {omega:.6} rad/s, Hooke {:+.2e}, Green {:+.2e}", hooke / omega - 1.0, green / omega - 1.0);
    assert!((hooke / omega - 1.0).abs() < 1e-5);
    assert!((green / omega - 1.0).abs() > 5e-3, "the Green law is another");
}

/// The force of a strained, bent cable is minus the gradient of its energy, and its matrix the derivative of the force.
///
/// *Source.* Central differences.
#[test]
fn force_and_tangent_are_derivatives_with_every_law() {
    for law in laws() {
        let mut cable = hanging(Some(law.clone()), 1e5).build().unwrap();
        let mut q = cable.positions().to_vec();
        q.iter_mut().enumerate().for_each(|(i, x)| *x = *x * 1.03 + 0.02 * (1.7 * i as f64).sin());
        let n = q.len();
        let zero = vec![0.0; n];
        let mut at = |i: usize, step: f64| {
            let mut moved = q.clone();
            moved[i] += step;
            cable.set_coordinates(&moved, &zero).unwrap();
            (
                cable.energy().total(),
                cable.force(),
                common::dense(&cable.stiffness_matrix()),
                cable.jacobians().stiffness,
            )
        };
        let (_, force, matrix, exact) = at(0, 0.0);
        let scale = matrix.amax();
        assert!((&matrix - &exact).iter().all(|x| x.abs() < 1e-12 * scale), "{law:?}: {:e}", (&matrix - &exact).amax());
        let d = 1e-5;
        for i in 0..n {
            let [(up, force_up, ..), (down, force_down, ..)] = [at(i, d), at(i, -d)];
            assert!((force[i] + (up - down) / (2.0 * d)).abs() < 1e-8 * scale, "{law:?} {i}");
            for j in 0..n {
                let slope = -(force_up[j] - force_down[j]) / (2.0 * d);
                assert!((matrix[(j, i)] - slope).abs() < 1e-6 * scale, "{law:?} {i} {j}: {} {slope}", matrix[(j, i)]);
            }
        }
    }
}

/// The energy law of a step of the discrete gradient closes for ropes that are thrown, snap taut and go slack, with every law.
#[test]
fn the_energy_law_closes_with_every_law() {
    for (k, law) in laws().into_iter().enumerate() {
        for h in [1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0] {
            let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };
            let velocity = Vector3::new(3.0, 4.0 + k as f64, 1.0);
            let builder = hanging(Some(law.clone()), 1e5).integrator(integrator).velocity(velocity);
            let mut rope = builder.load(PointLoad::force(2.0, Vector3::new(0.0, -30.0, 0.0))).build().unwrap();
            let total = |rope: &Cable| rope.energy().total() + rope.energy_in_store();
            let first = total(&rope) + rope.effect_work().dissipated().abs();
            let mut size = first.abs().max(10.0);
            let mut before = total(&rope);
            for _ in 0..(1.0 / h) as usize {
                let load = common::tip(&rope).y;
                rope.step(h).unwrap();
                let work = -30.0 * (common::tip(&rope).y - load);
                let now = total(&rope);
                // energy is lost alone
                assert!(now - before - work < 1e-9 * size, "{law:?} h {h}: {:e} J of {size}", now - before - work);
                size = size.max(now.abs());
                before = now;
            }
        }
    }
}

/// A straight rope that is shorter than its length pushes by Hooke's law, and not at all by the others.
///
/// *Source.* The laws: N = -0.1 EA, and 0.
#[test]
fn a_rope_does_not_push() {
    for law in laws() {
        let mut rope = hanging(Some(law.clone()), 1e5).gravity(Vector3::zeros()).build().unwrap();
        let q: Vec<f64> = rope.positions().iter().map(|x| 0.9 * x).collect();
        rope.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
        let tip = rope.force()[6 * 4 + 1];
        let expected = if law == AxialLaw::Hooke { -1e4 } else { 0.0 };
        assert!((tip - expected).abs() < 1e-8, "{law:?}: {tip}");
        assert!((rope.sample(0.7).unwrap().tension - expected).abs() < 1e-8);
    }
}

/// What makes no law is refused by name.
#[test]
fn a_bad_curve_is_refused() {
    let refused = |law: AxialLaw, name: &str| hanging(Some(law), 1e5).rule(rule(name)).build();
    for rows in [
        vec![[0.0, 0.0]],
        vec![[0.0, 1.0], [0.1, 2.0]],
        vec![[0.0, 0.0], [0.1, 2.0], [0.2, 1.0]],
        vec![[0.0, 0.0], [0.1, 2.0], [0.1, 3.0]],
        vec![[0.0, 0.0], [0.1, f64::NAN]],
        // steeper than EA
        vec![[0.0, 0.0], [0.1, 2e4]],
    ] {
        let error = refused(AxialLaw::Curve(rows.clone()), "projected-3");
        assert!(matches!(error, Err(Error::InvalidValue { .. })), "{rows:?} {error:?}");
    }
    assert!(matches!(refused(AxialLaw::Hooke, "G3-3"), Err(Error::MissingForEffect { .. })));
}

/// A damped rope that is slack carries nothing, whether it is drawn together or apart; a taut one carries what Hooke's law with damping does, but
/// never pushes.
///
/// *Source.* Kelvin and Voigt, N = EA (e + tau f^2 e'), where that is tension.
#[test]
fn a_damped_rope_neither_pushes_nor_pulls_where_it_is_slack() {
    let time = 0.01;
    for (name, stretch, speed) in [0.7, 0.95, 1.001, 1.03]
        .into_iter()
        .flat_map(|x| [-3.0, -0.2, 0.0, 0.2, 3.0].map(move |v| ("projected-3", x, v)))
        .chain([("L2T2", 0.9, -3.0), ("G5-3", 0.9, -3.0), ("G5-3", 1.02, 1.0)])
    {
        let of = |law: AxialLaw| {
            let effects = Effects { damping: Some(Damping { axial: time, bending: 0.0 }), ..with(law) };
            let builder = hanging(None, 1e5).effects(effects).rule(rule(name)).gravity(Vector3::zeros());
            let mut rope = builder.build().unwrap();
            let q: Vec<f64> = rope.positions().iter().map(|x| stretch * x).collect();
            let v: Vec<f64> = rope.positions().iter().map(|x| 0.5 * speed * x).collect();
            rope.set_coordinates(&q, &v).unwrap();
            (-rope.force()[6 * 4 + 1], rope.sample(0.7).unwrap().tension)
        };
        let (pulled, read) = of(AxialLaw::Rope);
        let (strain, rate) = (stretch - 1.0, 0.5 * speed);
        let expected = if strain > 0.0 { (1e5 * (strain + time * stretch * stretch * rate)).max(0.0) } else { 0.0 };
        let room = 1e-7 + 1e-9 * expected;
        let case = format!("{name} {stretch} {speed}: {pulled} {read} for {expected}");
        assert!((pulled + expected).abs() < room || (pulled - expected).abs() < room, "{case}");
        assert!((read - expected).abs() < room, "{case}");
        if expected > 0.0 {
            let (hooke, hooke_read) = of(AxialLaw::Hooke);
            assert!((pulled - hooke).abs() < 1e-7 + 1e-9 * expected && (read - hooke_read).abs() < room, "{case}");
        }
        let (pulled, read) = of(nylon());
        assert!(
            strain > 0.0 || (pulled.abs() < 1e-7 && read.abs() < 1e-7),
            "{name} {stretch} {speed}: {pulled} {read}"
        );
    }
}

/// The derivatives of the force of a damped rope by positions and velocities.
///
/// *Source.* Central differences.
#[test]
fn a_damped_rope_has_the_derivatives_of_its_force() {
    for law in [AxialLaw::Rope, nylon()] {
        let effects = Effects { damping: Some(Damping { axial: 2e-3, bending: 1e-3 }), ..with(law.clone()) };
        let mut cable = hanging(None, 1e5).effects(effects).build().unwrap();
        let mut q = cable.positions().to_vec();
        q.iter_mut().enumerate().for_each(|(i, x)| *x = *x * 1.03 + 0.02 * (1.7 * i as f64).sin());
        let v: Vec<f64> = (0..q.len()).map(|i| 2.0 * (0.9 * i as f64).cos()).collect();
        let n = q.len();
        cable.set_coordinates(&q, &v).unwrap();
        let exact = cable.jacobians();
        let d = 1e-6;
        for (matrix, of_velocity) in [(&exact.stiffness, false), (&exact.damping, true)] {
            let scale = matrix.amax();
            for i in 0..n {
                let mut at = |step: f64| {
                    let (mut q, mut v) = (q.clone(), v.clone());
                    if of_velocity {
                        v[i] += step
                    } else {
                        q[i] += step
                    }
                    cable.set_coordinates(&q, &v).unwrap();
                    cable.force()
                };
                let (up, down) = (at(d), at(-d));
                for j in 0..n {
                    let slope = -(up[j] - down[j]) / (2.0 * d);
                    assert!(
                        (matrix[(j, i)] - slope).abs() < 1e-5 * scale,
                        "{law:?} {of_velocity} {i} {j}: {} {slope}",
                        matrix[(j, i)]
                    );
                }
            }
        }
    }
}

/// Damping of a rope takes energy in every step, exactly, and the energy law closes with it to what a step may make: thrown, snapping taut and going
/// slack, at any step.
///
/// *Source.* The law: energy now is energy before less what damping and the step itself took.
#[test]
fn damping_of_a_rope_takes_energy_in_every_step() {
    for law in laws() {
        for (time, h) in [1e-4, 1e-2].into_iter().flat_map(|t| [1.0 / 60.0, 1.0 / 240.0, 1e-3].map(|h| (t, h))) {
            let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::Substeps(1) };
            let effects = Effects { damping: Some(Damping { axial: time, bending: 0.0 }), ..with(law.clone()) };
            let builder = hanging(None, 1e5).effects(effects).integrator(integrator).velocity([3.0, 5.0, 1.0]);
            let mut rope = builder.load(PointLoad::force(2.0, Vector3::new(0.0, -30.0, 0.0))).build().unwrap();
            let total = |rope: &Cable| rope.energy().total() + rope.energy_in_store();
            let (mut size, mut before, mut taken) = (total(&rope).abs().max(10.0), total(&rope), 0.0);
            let mut most = 0.0f64;
            for _ in 0..(1.0 / h) as usize {
                let load = common::tip(&rope).y;
                rope.step(h).unwrap();
                let work = -30.0 * (common::tip(&rope).y - load);
                let (now, damping) = (total(&rope), rope.effect_work().damping);
                assert!(damping <= taken, "{law:?} {time} {h}: {:e} J", damping - taken);
                let made = now - before - work - (damping - taken);
                // a step is accepted that makes a hundredth of what damping takes in it
                most = most.max((made - 0.01 * (taken - damping)) / size);
                size = size.max(now.abs());
                (before, taken) = (now, damping);
            }
            assert!(most < 1e-9, "{law:?} {time} {h}: made {most:e}");
        }
    }
}

/// With damping, too, nothing is made.
#[test]
fn damping_beside_a_law_dissipates() {
    for law in laws() {
        let effects = Effects { damping: Some(Damping { axial: 1e-3, bending: 1e-3 }), ..with(law.clone()) };
        let mut rope =
            hanging(None, 1e5).effects(effects).integrator(Fidelity::Game).velocity([1.0, 5.0, 0.0]).build().unwrap();
        let total = |rope: &Cable| rope.energy().total() + rope.energy_in_store();
        let mut before = total(&rope);
        for _ in 0..60 {
            rope.step(1.0 / 60.0).unwrap();
            let now = total(&rope);
            assert!(now < before + 1e-9, "{law:?}");
            before = now;
        }
    }
}

/// A rope that leaves a clamp at a right angle is bent within a thousandth of an element: one half of the element is slack, and the
/// tension is that of the other, on every mesh, by every law.
///
/// *Source.* The load at the end and the weight below; two points share what one of them carries alone, extended to an end by
/// (1 + 1/sqrt 3)/2 / (1/sqrt 3) = 1.37.
#[test]
fn tension_at_a_sharp_turn_is_that_of_the_load() {
    for law in laws() {
        for elements in [5, 10, 20, 40] {
            let mut rope = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(4.0, 0.0, 0.0)])
                .section(Section::from_stiffness(2.0e5, 0.01, 0.05).unwrap())
                .elements(elements)
                .effects(with(law.clone()))
                .clamp(At::Start)
                .build()
                .unwrap();
            rope.add_load(PointLoad::force(4.0, [0.0, -30.0, 0.0])).unwrap();
            rope.equilibrium().unwrap();
            let samples = (0..=400).map(|i| rope.sample(0.01 * f64::from(i)).unwrap().tension);
            let most = samples.fold(0.0, f64::max);
            println!("{law:?} {elements}: {most:.1} N");
            assert!(most < 2.0 * 1.37 * 32.0, "{law:?}, {elements} elements: {most} N");
        }
    }
}

/// A slack rope finds one shape on every mesh and by every law that agrees in tension: elements that are half slack, which cost
/// nothing under a law that cannot push, do not crumple on the way.
///
/// *Source.* Hooke's law on the same mesh, which pulls alike; the catenary differs from both by its stiffness.
#[test]
fn slack_ropes_that_cannot_push_find_the_shape_of_those_that_can() {
    let lines: [&[[f64; 3]]; 2] = [&[[0.0; 3], [1.6, -2.5, 0.9], [2.3, -4.1, 0.8]], &[[0.0; 3], [3.0, 0.5, 0.0]]];
    for points in lines {
        let straight: f64 = points.windows(2).map(|p| (Vector3::from(p[1]) - Vector3::from(p[0])).norm()).sum();
        for slack in [1.05, 1.2, 1.6] {
            for elements in [6, 10, 16, 30] {
                let middle = |law: AxialLaw| {
                    let mut rope = Cable::builder()
                        .points(points.iter().map(|&p| Vector3::from(p)))
                        .length(slack * straight)
                        .section(Section::from_stiffness(5.0e4, 2.0, 1.2).unwrap())
                        .elements(elements)
                        .effects(with(law))
                        .fix(At::Start)
                        .fix(At::End)
                        .build()
                        .unwrap();
                    rope.equilibrium().unwrap();
                    rope.sample(0.5 * rope.length()).unwrap().position
                };
                let (own, hooke) = (middle(AxialLaw::Rope), middle(AxialLaw::Hooke));
                assert!((own - hooke).norm() < 2e-3, "{slack}, {elements} elements: {own} {hooke}");
            }
        }
    }
}
