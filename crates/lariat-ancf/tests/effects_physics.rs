//! Each effect against an outside value, named with its source.

mod common;

use common::beam::{cantilever, first_mode, only};
use common::rule;
use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{At, Buoyancy, Cable, Damping, Drag, Effects, Flow, Integrator, Method, Section, Vector3};

const G: f64 = 9.81;

/// Extrema of the tip of a vibrating cantilever.
fn extrema(cable: &mut Cable, dt: f64, steps: usize) -> Vec<f64> {
    let y: Vec<f64> = (0..steps)
        .map(|_| {
            cable.step(dt).unwrap();
            cable.node_position(cable.nodes() - 1).y
        })
        .collect();
    y.windows(3)
        .filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0)
        .map(|w| {
            // vertex of the parabola through three samples
            let (a, b) = (0.5 * (w[0] - 2.0 * w[1] + w[2]), 0.5 * (w[2] - w[0]));
            w[1] - 0.25 * b * b / a
        })
        .collect()
}

/// The first bending mode of a cantilever decays by the logarithmic decrement of its damping ratio, and the energy it loses is the
/// work's.
///
/// *Source.* delta = 2 pi zeta/sqrt(1 - zeta^2), zeta = tau omega/2 (Clough & Penzien 1993, section 2-6; omega = 3.5160 for unit EI,
/// rhoA, L: Blevins 1979, table 8-1). Amplitude 2 % of the length: the large-rotation change of frequency is below 0.1 %; and 1e-5 of the
/// length, where elements turn by 1e-6 rad.
#[test]
fn a_damped_mode_decays_by_its_logarithmic_decrement() {
    for (zeta, size) in [(0.01f64, 0.02), (0.03, 0.02), (0.03, 1e-5)] {
        let integrator = Integrator::tolerance(Method::Esdirk4, 5e-7 * size).unwrap();
        let mut cable = cantilever(10).integrator(integrator).build().unwrap();
        let (omega, mode) = first_mode(&mut cable);
        assert!((omega / 3.5160 - 1.0).abs() < 2e-3, "{omega}");
        let damping = cable.damping_at_mode(zeta, 1).unwrap();
        cable.set_damping(damping).unwrap();
        let n = mode.len();
        let (x, y): (Vec<f64>, Vec<f64>) = (cable.positions().to_vec(), mode.clone());
        // the eigenvector may lie in any plane: turn it into y
        let tip = Vector3::from_column_slice(&y[n - 6..n - 3]);
        let amplitude = size / tip.norm();
        let mut q = x.clone();
        for i in 0..n / 3 {
            let part = Vector3::from_column_slice(&y[3 * i..3 * i + 3]).dot(&tip) / tip.norm();
            q[3 * i + 1] += amplitude * part;
        }
        cable.set_coordinates(&q, &vec![0.0; n]).unwrap();
        let start = cable.energy().total();
        let peaks = extrema(&mut cable, 0.01, 1100);
        let swings = peaks.len() - 1;
        let decrement = 2.0 * (peaks[0] / peaks[swings]).abs().ln() / swings as f64;
        let expected = 2.0 * std::f64::consts::PI * zeta / (1.0 - zeta * zeta).sqrt();
        println!("zeta {zeta}, {size} m: decrement {decrement:.6}, expected {expected:.6}, {swings} half swings");
        assert!((decrement / expected - 1.0).abs() < 0.005, "{decrement} {expected}");
        let lost = start - cable.energy().total();
        let dissipated = cable.effect_work().dissipated();
        println!("lost {lost:e}, dissipated {dissipated:e}");
        assert!((lost - dissipated).abs() < 1e-3 * lost, "{lost} {dissipated}");
    }
}

/// A rod that whirls, its section turning with it: the curvature turns about the axis and keeps its size. Bent it loses nothing, for the element
/// knows no twist; nearly straight it loses at most what the head of `effect/damping.rs` allows.
///
/// *Source.* Objectivity; the bound 0.42 e EI tau omega^2/l per element, e = 1e-7.
#[test]
fn a_spin_about_the_axis_is_not_damped_but_for_a_bounded_rest() {
    let (ei, tau, spin, elements) = (1.0, 1e-3, 10.0, 8);
    let power = |sag: f64| {
        let points = (0..=40).map(|i| {
            let x = f64::from(i) / 40.0;
            Vector3::new(x, 4.0 * sag * x * (1.0 - x), 0.0)
        });
        let mut cable = Cable::builder()
            .points(points)
            .section(Section::from_stiffness(1e4, ei, 1.0).unwrap())
            .elements(elements)
            .damping(Damping { axial: 0.0, bending: tau })
            .build()
            .unwrap();
        cable.set_rigid_motion(Vector3::zeros(), Vector3::new(spin, 0.0, 0.0)).unwrap();
        let damped = cable.force();
        cable.set_damping(Damping::default()).unwrap();
        let bare = cable.force();
        cable.velocities().iter().zip(bare.iter().zip(&damped)).map(|(v, (b, d))| v * (b - d)).sum::<f64>()
    };
    let most = 0.42 * 1e-7 * ei * tau * spin * spin * (elements * elements) as f64;
    // half a turn of an element is 4 sag/elements
    let worst = [1e-5, 3e-5, 1e-4, 3e-4, 6e-4].map(power).into_iter().fold(0.0, f64::max);
    assert!(worst <= most && worst > 0.1 * most, "{worst:e} W, at most {most:e}");
    for sag in [0.0, 0.002, 0.1] {
        let bent = power(sag);
        assert!(bent <= 1e-12 * most.max(1.0), "{sag}: {bent:e} W");
    }
}

/// A long stiff rope of many short elements, let go from horizontal in a breeze, takes about a step for a host step: the damped curvature, at first a
/// millionth of a radian per element and of any direction, is no obstacle.
///
/// *Source.* Counts; with the scalar rate alone 4111 steps for the first host step (`effect/damping.rs`).
#[test]
fn damped_steel_in_a_breeze_takes_few_steps() {
    let mut drag = Drag::new(1.2, 1.2, 0.02, Flow::uniform(Vector3::new(0.5, 0.0, 1.0)));
    drag.diameter = Some(0.01);
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::round(0.01, 2.1e11, 7850.0).unwrap())
        .elements(200)
        .fix(At::Start)
        .effects(Effects {
            damping: Some(Damping { axial: 1e-4, bending: 1e-3 }),
            drag: Some(drag),
            ..Effects::default()
        })
        .build()
        .unwrap();
    (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let d = cable.diagnostics();
    println!("{} steps, {} rejected, {} iterations", d.steps, d.rejected_steps, d.newton_iterations);
    assert!(d.steps < 60 && d.rejected_steps < 6, "{} steps, {} rejected", d.steps, d.rejected_steps);
}

/// A straight rod under axial vibration loses energy by the same law: exp(-2 zeta omega t), read after ten periods.
///
/// *Source.* omega = (pi/2) sqrt(EA/rhoA)/L for fixed-free (Blevins 1979, table 8-16); zeta = tau omega/2.
#[test]
fn a_damped_axial_mode_loses_energy_by_its_damping_ratio() {
    let (omega, zeta) = (std::f64::consts::FRAC_PI_2 * 100.0, 0.02f64);
    let damping = Damping { bending: 0.0, ..Damping::from_ratio(zeta, omega).unwrap() };
    let integrator = Integrator::substeps(Method::Esdirk4, 4).unwrap();
    let builder = cantilever(8).rule(rule("G5-3")).effects(only(|e| e.damping = Some(damping)));
    let mut cable = builder.integrator(integrator).build().unwrap();
    let mut q = cable.positions().to_vec();
    for (node, s) in cable.node_arc_lengths().into_iter().enumerate() {
        let phase = std::f64::consts::FRAC_PI_2 * s;
        q[6 * node] += 1e-6 * phase.sin();
        q[6 * node + 3] += 1e-6 * std::f64::consts::FRAC_PI_2 * phase.cos();
    }
    let v = vec![0.0; q.len()];
    cable.set_coordinates(&q, &v).unwrap();
    let start = cable.energy().total();
    let period = 2.0 * std::f64::consts::PI / (omega * (1.0 - zeta * zeta).sqrt());
    (0..400).for_each(|_| cable.step(period / 40.0).unwrap());
    let decay = (start / cable.energy().total()).ln();
    let expected = 2.0 * zeta * omega * 10.0 * period;
    assert!((decay / expected - 1.0).abs() < 2e-3, "{decay} {expected}");
    let lost = start - cable.energy().total();
    assert!((lost + cable.effect_work().damping).abs() < 1e-4 * lost, "{lost} {:?}", cable.effect_work());
}

/// Damping does not change the static shape, and a damped cable comes to rest in it.
///
/// *Source.* The equilibrium of the undamped cable.
#[test]
fn damping_leaves_the_static_shape_alone() {
    let build = |effects: Effects| {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.8, 0.0, 0.0)])
            .length(1.0)
            .section(Section::from_stiffness(400.0, 0.01, 0.5).unwrap())
            .elements(8)
            .fix(At::Start)
            .fix(At::End)
            .effects(effects)
            .build()
            .unwrap()
    };
    let (mut bare, mut damped) =
        (build(Effects::default()), build(only(|e| e.damping = Some(Damping { axial: 0.05, bending: 0.3 }))));
    bare.equilibrium().unwrap();
    damped.equilibrium().unwrap();
    assert_eq!(bare.positions(), damped.positions());
    // a cantilever let go from straight comes to rest in its static shape
    let build =
        |effects: Effects| cantilever(5).gravity(Vector3::new(0.0, -0.8, 0.0)).effects(effects).build().unwrap();
    let mut still = build(Effects::default());
    still.equilibrium().unwrap();
    let mut moving = build(only(|e| e.damping = Some(Damping { axial: 0.2, bending: 0.2 })));
    for _ in 0..600 {
        moving.step(1.0 / 30.0).unwrap();
    }
    let left = common::largest_difference(still.positions(), moving.positions());
    assert!(left < 1e-5, "{left:e}");
}

/// A horizontal cable that falls in a fluid reaches the speed at which drag carries its weight.
///
/// *Source.* w = 1/2 rho d C_n v^2 per length, v(t) = v_T tanh(g t/v_T) (free fall with quadratic drag).
#[test]
fn a_falling_cable_follows_the_law_of_quadratic_drag() {
    let section = Section::round(0.01, 1e8, 4000.0).unwrap();
    let (rho, cn) = (1.2, 1.1);
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(section)
        .elements(4)
        .effects(only(|e| e.drag = Some(Drag::new(rho, cn, 0.05, Flow::default()))))
        .integrator(Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap())
        .build()
        .unwrap();
    let terminal = (2.0 * section.mass_per_length * G / (rho * 0.01 * cn)).sqrt();
    for i in 1..=30 {
        let t = 0.5 * f64::from(i);
        cable.step(0.5).unwrap();
        let v = -cable.sample(1.3).unwrap().velocity.y;
        let expected = terminal * (G * t / terminal).tanh();
        assert!((v - expected).abs() < 1e-6 * terminal, "{t}: {v} {expected}");
    }
    // potential energy lost = kinetic + given to the fluid
    let e = cable.energy();
    let work = cable.effect_work();
    assert!((e.total() - work.drag).abs() < -1e-6 * work.drag, "{e:?} {work:?}");
}

/// Explicit methods take drag, with order 2.
///
/// *Source.* The same law; the error of Verlet falls by four when the step is halved.
#[test]
fn explicit_methods_take_drag_with_order_two() {
    let section = Section::round(0.01, 1e7, 1000.0).unwrap();
    let terminal = (2.0 * section.mass_per_length * G / (1000.0 * 0.01)).sqrt();
    for method in [Method::Verlet, Method::Rkn4, Method::Rkn6] {
        let error = |substeps: u32| {
            let mut cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
                .section(section)
                .elements(2)
                .effects(only(|e| e.drag = Some(Drag::new(1000.0, 1.0, 0.0, Flow::default()))))
                .integrator(Integrator::substeps(method, substeps).unwrap())
                .build()
                .unwrap();
            cable.step(0.05).unwrap();
            let v = -cable.sample(1.3).unwrap().velocity.y;
            (v - terminal * (G * 0.05 / terminal).tanh()).abs()
        };
        let (coarse, fine) = (error(100), error(200));
        let order = (coarse / fine).log2();
        println!("{method}: {coarse:e} {fine:e} order {order}");
        assert!(order > 1.8 && fine < 1e-5, "{method}: {coarse:e} {fine:e}");
    }
}

/// A cable hung in a cross flow takes the angle at which normal drag and weight balance, everywhere the same; statics and a run agree.
///
/// *Source.* Towed cable at its critical angle: 1/2 rho d C_n U^2 cos^2 a = w sin a, a from the vertical (Berteaux 1976, section 6;
/// Pode 1951). Tangential drag zero; EA large, EI zero.
#[test]
fn a_towed_cable_takes_its_critical_angle() {
    let section = Section::round(0.01, 2e9, 3000.0).unwrap();
    let (rho, cn, u) = (1000.0, 1.2, 0.6);
    let flow = Flow::uniform(Vector3::new(u, 0.0, 0.0));
    let effects = Effects {
        drag: Some(Drag::new(rho, cn, 0.0, flow)),
        buoyancy: Some(Buoyancy::new(rho, 1.0)),
        ..Effects::default()
    };
    let weight = (section.mass_per_length - rho * std::f64::consts::FRAC_PI_4 * 1e-4) * G;
    let f = 0.5 * rho * 0.01 * cn * u * u;
    // f cos^2 a = w sin a
    let sine = (-weight + (weight * weight + 4.0 * f * f).sqrt()) / (2.0 * f);
    let build = || {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(0.0, -10.0, 0.0)])
            .section(section)
            .rule(rule("G5-none"))
            .elements(10)
            .fix(At::Start)
            .effects(effects.clone())
    };
    let mut still = build().build().unwrap();
    let report = still.equilibrium().unwrap();
    let angle = |cable: &Cable, s: f64| {
        let t = cable.sample(s).unwrap().slope;
        t.x / t.norm()
    };
    println!("sin a expected {sine:.6}: statics {:.6} after {} iterations", angle(&still, 5.0), report.iterations);
    for s in [0.5, 5.0, 9.5] {
        assert!((angle(&still, s) - sine).abs() < 1e-4, "{s}: {} {sine}", angle(&still, s));
    }
    let mut run = build().integrator(Integrator::tolerance(Method::Esdirk3, 1e-4).unwrap()).build().unwrap();
    for _ in 0..300 {
        run.step(0.2).unwrap();
    }
    for s in [0.5, 5.0, 9.5] {
        assert!((angle(&run, s) - sine).abs() < 2e-3, "{s}: {} {sine}", angle(&run, s));
    }
}

/// A cable of the fluid's density is at rest wherever it is put, and its weight returns with the effect off.
///
/// *Source.* Archimedes.
#[test]
fn a_neutrally_buoyant_cable_stays_where_it_is() {
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.5, 0.0), Vector3::new(2.0, 0.0, 0.3)])
        .section(Section::round(0.02, 1e7, 1000.0).unwrap())
        .rule(rule("G5-none"))
        .elements(8)
        .effects(only(|e| e.buoyancy = Some(Buoyancy::new(1000.0, 1.0))))
        .build()
        .unwrap();
    let weight = 1000.0 * std::f64::consts::FRAC_PI_4 * 4e-4 * G * cable.length();
    let force = cable.force();
    let resultant: Vector3<f64> = force.chunks_exact(6).map(|f| Vector3::new(f[0], f[1], f[2])).sum();
    assert!(resultant.norm() < 1e-12 * weight, "{resultant}");
    let straight = [Vector3::zeros(), Vector3::new(1.2, -0.9, 0.7)];
    let mut cable2 = Cable::builder()
        .points(straight)
        .section(Section::round(0.02, 1e7, 1000.0).unwrap())
        .elements(8)
        .effects(only(|e| e.buoyancy = Some(Buoyancy::new(1000.0, 1.0))))
        .build()
        .unwrap();
    let start = cable2.positions().to_vec();
    (0..60).for_each(|_| cable2.step(1.0 / 60.0).unwrap());
    let moved = common::largest_difference(&start, cable2.positions());
    assert!(moved < 1e-9, "{moved:e}");
    cable2.set_buoyancy(None).unwrap();
    cable2.set_rigid_motion(Vector3::zeros(), Vector3::zeros()).unwrap();
    (0..60).for_each(|_| cable2.step(1.0 / 60.0).unwrap());
    let fallen = start[1] - cable2.positions()[1];
    assert!((fallen - 0.5 * G).abs() < 1e-6, "{fallen}");
}

/// Added mass lowers the frequencies of a submerged rod by sqrt(m/(m + C_a rho_f A)).
///
/// *Source.* Blevins 1979, section 14 (beams in still fluid); 3.5160 for unit EI, L.
#[test]
fn added_mass_lowers_the_eigenfrequency_as_the_mass_ratio_says() {
    let buoyancy = Buoyancy { area: Some(1.5e-3), ..Buoyancy::new(1000.0, 0.8) };
    let mut cable = cantilever(10).effects(only(|e| e.buoyancy = Some(buoyancy))).build().unwrap();
    let omega = first_mode(&mut cable).0;
    let expected = 3.5160 / (1.0f64 + 0.8 * 1.5).sqrt();
    assert!((omega / expected - 1.0).abs() < 2e-3, "{omega} {expected}");
    // and a free cable falls with g (rhoA - rho_f A)/(rhoA + C_a rho_f A)
    let mut free = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e4, 1.0, 2.0).unwrap())
        .effects(only(|e| e.buoyancy = Some(buoyancy)))
        .build()
        .unwrap();
    (0..10).for_each(|_| free.step(0.1).unwrap());
    let fallen = -free.node_position(3).y;
    let expected = 0.5 * G * (2.0 - 1.5) / (2.0 + 1.2);
    assert!((fallen - expected).abs() < 1e-9, "{fallen} {expected}");
}
