//! Edges and thin rods: the closest points of elements.

use crate::bench::steps;
use crate::bench::{RADIUS, rope, run, tension, with};
use lariat_ancf::contact::{Capsule, Cuboid, Obstacle};
use lariat_ancf::{At, Cable, Contact, Damping, Motion, PointLoad, Support, Vector3};

/// Least distance of the centre line from a point in the plane z = 0.
fn least(cable: &Cable, x: f64, y: f64) -> f64 {
    (0..=2000).fold(f64::INFINITY, |least, i| {
        let p = cable.sample(cable.length() * f64::from(i) / 2000.0).unwrap().position;
        least.min((p.x - x).hypot(p.y - y))
    })
}

/// A slack rope that falls on a rod of 6 mm between its samples stays on it, at three meshes.
///
/// *Source.* Geometry: at rest the centre line is the sum of the radii away, to 1e-4 m; in the impact it is deeper by 5 % of the radius at most.
#[test]
fn a_thin_rod_carries_a_rope_at_any_mesh() {
    for elements in [10, 20, 40] {
        for at in [1.0, 1.013, 0.95] {
            let tent = [Vector3::zeros(), Vector3::new(1.0, 0.4, 0.0), Vector3::new(2.0, 0.0, 0.0)];
            let cable = rope(0.01, &tent, elements).fix(At::Start).fix(At::End).build().unwrap();
            let top = 0.1;
            let rod = Capsule { ends: [Vector3::new(at, top, -1.0), Vector3::new(at, top, 1.0)], radius: 0.003 };
            let mut cable = with(cable, vec![Obstacle::new(3, rod, Vector3::zeros(), 0.3)]);
            let mut lowest = f64::INFINITY;
            let made = run(&mut cable, 480, |cable| lowest = lowest.min(least(cable, at, top) - 0.003 - RADIUS));
            let (gap, above) = (least(&cable, at, top) - 0.003 - RADIUS, cable.contacts().count());
            println!(
                "{elements} elements, rod at {at}: gap {gap:.2e} m, least {lowest:.1e}, {above} contacts, made {made:.1e}"
            );
            assert!(gap.abs() < 1e-4 && lowest > -0.05 * RADIUS, "{elements}, {at}: {gap} {lowest}");
            assert!(made < 1e-8, "{made:e}");
            assert!(above > 0);
        }
    }
}

/// A rope over the edge of a box, held at the far end, bends about the edge without cutting it, at three meshes; also with a node on it.
///
/// *Source.* Geometry, to 1e-4 m.
#[test]
fn the_edge_of_a_box_is_not_cut_at_any_mesh() {
    for elements in [20, 40, 80] {
        for shift in [0.0, 0.013] {
            let from = Vector3::new(-1.0 + shift, RADIUS, 0.0);
            let cable =
                rope(0.01, &[from, from + Vector3::new(2.0, 0.0, 0.0)], elements).fix(At::Start).build().unwrap();
            let block = Cuboid { half_extents: Vector3::new(1.0, 1.5, 1.0) };
            let block = Obstacle::new(3, block, Vector3::new(-1.0, -1.5, 0.0), 0.3);
            let mut cable = with(cable, vec![block]);
            let mut inside = 0.0f64;
            let made = run(&mut cable, 180, |cable| inside = inside.max(RADIUS - least(cable, 0.0, 0.0)));
            let gap = least(&cable, 0.0, 0.0) - RADIUS;
            let d = cable.diagnostics();
            println!(
                "{elements} elements, shift {shift}: gap {gap:.2e} m, deepest ever {inside:.1e}, made {made:.1e}, {:.0} sweeps/host, {} split",
                d.newton_iterations as f64 / 180.0,
                d.split_steps
            );
            assert!(gap.abs() < 1e-4, "{elements}, {shift}: {gap}");
            assert!(made < 1e-8, "{made:e}");
        }
    }
}

/// A rope that is thrown at a thin rod stays on its side of it, at three meshes, although it passes many times the rod in a step.
///
/// *Source.* Geometry: the nearest point of the centre line stays at the sum of the radii, but for a tenth of the rope's, and no energy is made.
#[test]
fn a_thrown_rope_does_not_pass_a_thin_rod() {
    for speed in [2.0, 5.0, 10.0, 15.0] {
        for (elements, slant) in [(10, 0.0), (20, 0.3), (40, -0.2), (20, 0.0), (40, 0.0)] {
            let half = Vector3::new(0.5, 0.5 * slant, 0.0);
            let cable = rope(0.01, &[-half, half], elements).gravity(Vector3::zeros());
            let cable = cable.velocity(Vector3::new(0.0, -speed, 0.0)).build().unwrap();
            let (at, top) = (0.03, -0.5);
            let rod = Capsule { ends: [Vector3::new(at, top, -1.0), Vector3::new(at, top, 1.0)], radius: 0.002 };
            let mut cable = with(cable, vec![Obstacle::new(3, rod, Vector3::zeros(), 0.3)]);
            let mut nearest = f64::INFINITY;
            let made = run(&mut cable, (0.55 / speed * 60.0) as usize + 4, |cable| {
                nearest = nearest.min(least(cable, at, top))
            });
            println!("{speed} m/s, {elements} elements, slant {slant}: nearest {nearest:.4} m, made {made:.1e}");
            assert!(nearest > 0.002 + 0.9 * RADIUS, "{speed}, {elements}, {slant}: {nearest}");
            assert!(made < 1e-8, "{made:e}");
        }
    }
}

/// A taut rope that is drawn along itself over a thin rod without friction has the same tension on both sides, at several speeds and meshes.
///
/// *Source.* Equilibrium of the rope on the rod. A force at the closest point of the end of a step would brake it, by 10 % of the tension at 0.5 m/s.
#[test]
fn a_rope_that_slides_over_a_thin_rod_without_friction_is_not_braked() {
    for (speed, elements) in [(0.5, 20), (0.5, 41), (1.0, 20), (1.0, 41), (2.0, 20), (2.0, 41)] {
        let [down, rise] = [Vector3::new(1.0, -0.25, 0.0).normalize(), Vector3::new(1.0, 0.25, 0.0).normalize()];
        let top = 0.002 + RADIUS;
        let apex = Vector3::new(0.0, top, 0.0);
        let points = [apex - 1.2 * rise, apex, apex + 0.8 * down];
        let cable = rope(0.05, &points, elements).gravity(Vector3::zeros()).velocity(Vector3::new(speed, 0.0, 0.0));
        let rod = Capsule { ends: [Vector3::new(0.0, 0.0, -1.0), Vector3::new(0.0, 0.0, 1.0)], radius: 0.002 };
        let mut cable = with(cable.build().unwrap(), vec![Obstacle::new(3, rod, Vector3::zeros(), 0.0)]);
        cable.set_contact(Contact::with_friction(0.0).with_radius(RADIUS)).unwrap();
        // drawn tight by 1 mm
        let ends = [(At::Start, points[0], rise), (At::End, points[2] + 1e-3 * down, down)];
        for (at, from, along) in ends {
            let position = Some(Motion::uniform(0.0, from, speed * along));
            cable.set_support(at, Support { position, ..Support::default() }).unwrap();
        }
        let (mut difference, mut mean) = (0.0, 0.0);
        // the first host step puts the supports in place
        cable.step(1.0 / 60.0).unwrap();
        let made = run(&mut cable, (30.0 / speed) as usize, |cable| {
            if cable.time() > 0.1 / speed {
                let [before, behind] = [0.1, 1.9].map(|s| tension(cable, s));
                difference += behind - before;
                mean += 0.5 * (before + behind);
            }
        });
        let share = difference / mean;
        println!("{speed} m/s, {elements} elements: {:.2} % of the tension, made {made:.1e}", 100.0 * share);
        assert!(share.abs() < 0.005, "{speed}, {elements}: {share}");
        assert!(made < 1e-8, "{made:e}");
    }
}

/// A taut rope that is drawn along itself over the edge of a box without friction has the same
/// tension on both sides, at three meshes and steps; with friction that of the capstan.
///
/// *Source.* T2/T1 = exp(mu pi/2), Euler-Eytelwein, over a way of many elements, at which the
/// tension swings. The end-point derivative of the law of depth for samples that slide over the
/// edge would brake the rope by 3 to 5 %, closest points alone on meshes as fine as the rope by 40
/// to 80 %.
#[test]
fn a_rope_that_slides_over_an_edge_is_braked_by_its_friction_alone() {
    for (elements, rate, friction) in [
        (72, 240.0, 0.0),
        (102, 240.0, 0.0),
        (153, 240.0, 0.0),
        (102, 480.0, 0.0),
        (102, 960.0, 0.0),
        (102, 240.0, 0.3),
    ] {
        let r = RADIUS;
        let points = [
            Vector3::new(-r, -0.3, 0.0),
            Vector3::new(-r, -0.1 * r, 0.0),
            Vector3::new(-0.7 * r, 0.7 * r, 0.0),
            Vector3::new(0.1 * r, r, 0.0),
            Vector3::new(0.3, r, 0.0),
        ];
        let cable = rope(1e-4, &points, elements).gravity(Vector3::zeros()).integrator(steps(rate));
        let mut cable = cable.damping(Damping { axial: 1e-3, bending: 0.0 }).build().unwrap();
        let position = Some(Motion::uniform(0.0, points[4], Vector3::x() * 0.05));
        cable.set_support(At::End, Support { position, ..Support::default() }).unwrap();
        cable.add_load(PointLoad::force(0.0, Vector3::y() * -100.0)).unwrap();
        let block = Cuboid { half_extents: Vector3::new(1.0, 1.0, 0.5) };
        let mut cable = with(cable, vec![Obstacle::new(3, block, Vector3::new(1.0, -1.0, 0.0), friction)]);
        cable.set_contact(Contact::with_friction(friction).with_radius(RADIUS)).unwrap();
        let (length, mut ratios) = (cable.length(), Vec::new());
        let made = run(&mut cable, 120, |cable| {
            if cable.time() > 0.5 {
                ratios.push(tension(cable, length - 0.05) / tension(cable, 0.05));
            }
        });
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let error = mean / (friction * std::f64::consts::FRAC_PI_2).exp() - 1.0;
        println!("{elements} elements, 1/{rate} s, mu {friction}: {mean:.4}, {:+.2} %, made {made:.1e}", 100.0 * error);
        assert!(error.abs() < 0.01, "{elements}, {rate}, {friction}: {error}");
        assert!(made < 1e-8, "{made:e}");
    }
}
