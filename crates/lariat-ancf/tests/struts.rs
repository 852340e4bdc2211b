//! A straight cable under compression does not stand, and what need not fall is left alone.

mod common;

use lariat_ancf::{At, Cable, CableBuilder, Damping, Fidelity, PointLoad, Section, SlopeSupport, Support, Vector3};

/// A rope of 2 m that stands on its eye, with a force (N) along it at the top.
fn standing(elements: usize, force: f64, bending: f64) -> CableBuilder {
    let section = Section::from_stiffness(1.6e6, bending, 0.14).unwrap();
    let builder = Cable::builder().points([Vector3::zeros(), 2.0 * Vector3::y()]).section(section).elements(elements);
    builder.fix(At::Start).load(PointLoad::force(2.0, Vector3::new(0.0, force, 0.0)))
}

/// Returns whether the top comes down by half a metre within some host steps.
fn falls(rope: &mut Cable, host_steps: usize) -> bool {
    (0..host_steps).any(|_| {
        rope.step(1.0 / 60.0).unwrap();
        common::tip(rope).y < 1.5
    })
}

/// A rope of 6 mm that is pushed by 196 N falls within a second, of any mesh, in game and in engineering, and when gravity turns.
///
/// Each run ends when the rope has fallen: what a light rope does below a dead load of 700 times its weight is another matter.
///
/// *Source.* Euler's load of the free span, 1.2 N; what grows is faster than sqrt(N/(m L^2)) = 19 /s.
#[test]
fn a_straight_rope_under_compression_falls() {
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        for elements in [1, 10, 40, 100] {
            let mut rope = standing(elements, -196.0, 0.5).integrator(fidelity).build().unwrap();
            assert!(falls(&mut rope, 60), "{fidelity:?} {elements}: {:?}", common::tip(&rope));
        }
        // hanging first, turned upside down afterwards
        let mut rope = standing(10, 0.0, 0.05).gravity([0.0, 9.81, 0.0]).integrator(fidelity).build().unwrap();
        (0..30).for_each(|_| rope.step(1.0 / 60.0).unwrap());
        assert!(common::tip(&rope).y > 1.999);
        rope.set_gravity(Vector3::new(0.0, -9.81, 0.0)).unwrap();
        assert!(falls(&mut rope, 120), "{fidelity:?}: {:?}", common::tip(&rope));
    }
}

/// Cables that are pulled, or pushed by less than they bear, move as they did, to the bit; and a step that falls is the same twice.
#[test]
fn a_cable_that_stands_by_itself_is_left_alone() {
    for (force, bending) in [(100.0, 0.5), (-0.02, 0.5)] {
        let rod = standing(8, force, bending).clamp(At::Start).gravity(Vector3::zeros());
        let mut rod = rod.integrator(Fidelity::Game).build().unwrap();
        (0..30).for_each(|_| rod.step(1.0 / 60.0).unwrap());
        assert!(rod.positions().chunks_exact(3).all(|r| r[0] == 0.0 && r[2] == 0.0));
    }
    let fall = || {
        let mut rope = standing(8, -196.0, 0.5).integrator(Fidelity::Game).build().unwrap();
        (0..30).for_each(|_| rope.step(1.0 / 60.0).unwrap());
        rope.positions().to_vec()
    };
    assert_eq!(fall(), fall());
}

/// A strut that its supports hold up is bent once: what is left of the bend dies out and stays away. One beyond the load of its supports falls, also if
/// it stood under a smaller load before.
///
/// *Source.* Euler: a rod that is clamped below and guided above bears pi^2 EI/L^2 = 49 N, the free span for which it is bent a quarter of it. A bend
/// that is made again would be at least 1e-8 m.
#[test]
fn a_strut_that_stands_is_bent_once() {
    let build = |load: f64| {
        let section = Section::from_stiffness(1e5, 5.0, 0.2).unwrap();
        let builder = Cable::builder().points([Vector3::zeros(), Vector3::y()]).section(section).elements(8);
        let builder = builder.damping(Damping { axial: 1e-3, bending: 0.02 }).gravity(Vector3::zeros());
        let load = PointLoad::force(1.0, Vector3::new(0.0, -load, 0.0));
        let mut rod = builder.fidelity(Fidelity::Game).clamp(At::Start).load(load).build().unwrap();
        let guide = SlopeSupport::Direction(Vector3::y());
        rod.set_support(At::End, Support { slope: guide, ..Support::default() }).unwrap();
        rod
    };
    let aside = |rod: &Cable| rod.positions().chunks(6).map(|q| q[0].abs().max(q[2].abs())).fold(0.0, f64::max);
    let run = |rod: &mut Cable, steps: usize| (0..steps).for_each(|_| rod.step(1.0 / 60.0).unwrap());
    let mut rod = build(30.0);
    run(&mut rod, 240);
    assert!(aside(&rod) < 1e-10, "{:e}", aside(&rod));
    rod.add_load(PointLoad::force(1.0, Vector3::new(0.0, -60.0, 0.0))).unwrap();
    run(&mut rod, 240);
    assert!(aside(&rod) > 0.1, "{:e}", aside(&rod));
    let mut rod = build(90.0);
    run(&mut rod, 240);
    assert!(aside(&rod) > 0.1, "{:e}", aside(&rod));
}

/// A rope that is held between its ends falls where it stands, whatever holds it below; a stiff one that is pinned at its foot alone falls over.
///
/// *Source.* Greenhill: a column bears its weight up to w l^3/EI = 7.84 above a clamp, less above a pin, so that each of these falls. One that
/// turns about its foot bears nothing.
#[test]
fn each_free_span_falls_by_itself() {
    let mut random = common::Random::new(45);
    let mut between = |low: f64, high: f64| low * (high / low).powf(0.5 + 0.5 * random.next());
    for case in 0..24 {
        let length = between(2.0, 6.0);
        let top = length * between(0.3, 0.7);
        let section = Section::from_stiffness(1.6e6, 1.4 * top.powi(3) / 7.84 / between(3.0, 300.0), 0.14).unwrap();
        let points = [Vector3::zeros(), length * Vector3::y()];
        let builder = Cable::builder().points(points).section(section).elements([10, 25, 40][case % 3]);
        let builder = builder.damping(Damping { axial: 2e-4, bending: 0.01 });
        let builder = builder.integrator([Fidelity::Game, Fidelity::Engineering][usize::from(case % 6 == 5)]);
        let highest = length - top;
        let builder = match case % 4 {
            0 => builder.fix(At::ArcLength(highest)),
            1 => builder.clamp(At::ArcLength(highest)),
            2 => builder.fix(At::Start).fix(At::ArcLength(highest)),
            _ => builder.fix(At::ArcLength(0.4 * highest)).clamp(At::Start).fix(At::ArcLength(highest)),
        };
        let mut rope = builder.build().unwrap();
        let host_steps = (60.0 * 30.0 * (top / 9.81).sqrt()) as usize;
        let falls = (0..host_steps).any(|_| {
            rope.step(1.0 / 60.0).unwrap();
            common::tip(&rope).y < length - 0.3 * top
        });
        assert!(falls, "case {case}: {length} m, {top} m above, {section:?}: {:?}", common::tip(&rope));
    }
    let mut rod = standing(8, 0.0, 50.0).integrator(Fidelity::Game).build().unwrap();
    assert!(falls(&mut rod, 900), "{:?}", common::tip(&rod));
}

/// Between supports, too: a load amid a line that is drawn straight down pushes its lower half, which buckles, and pulls the upper one, which does not.
///
/// *Source.* Each half carries half of the load, 50 N, and bears pi^2 EI/l^2 = 0.11 N. What is off the line is of the size l sqrt(strain), 0.01 m.
#[test]
fn the_pushed_half_of_a_line_between_supports_buckles() {
    let section = Section::from_stiffness(1e5, 0.1, 0.1).unwrap();
    for elements in [8, 20, 100] {
        let builder =
            Cable::builder().points([Vector3::zeros(), -6.0 * Vector3::y()]).section(section).elements(elements);
        let load = PointLoad::force(3.0, Vector3::new(0.0, -100.0, 0.0));
        let builder =
            builder.fix(At::Start).fix(At::ArcLength(3.0)).fix(At::End).load(PointLoad::force(4.5, load.force));
        let builder = builder.damping(Damping { axial: 1e-3, bending: 0.02 }).node_at(4.5).gravity(Vector3::zeros());
        let mut line = builder.integrator(Fidelity::Game).build().unwrap();
        (0..60).for_each(|_| line.step(1.0 / 60.0).unwrap());
        let aside = |s: f64| line.sample(s).unwrap().position.x.hypot(line.sample(s).unwrap().position.z);
        let lower = (30..60).map(|k| aside(0.1 * f64::from(k))).fold(0.0, f64::max);
        assert!(lower > 2e-3, "{elements}: {lower:e}");
    }
}
