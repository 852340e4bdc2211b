//! Reels of cables with axial laws and with forces per length of a program.

use super::common::{G, implicit, rope};
use super::laws::Hoist;
use lariat_ancf::{
    At, AxialLaw, Cable, CablePoint, Damping, Effects, Feed, ForceDensity, Integrator, Method, PointLoad, Reel,
    RestShape, Section, StepControl, Vector3,
};
use std::sync::{Arc, Mutex};

/// Laws for ropes of EA 1e4 N or more; the curve gives 30 N at 0.4 %.
fn laws() -> [AxialLaw; 3] {
    [AxialLaw::Hooke, AxialLaw::Rope, AxialLaw::Curve(vec![[0.0, 0.0], [4e-3, 30.0], [0.1, 900.0]])]
}

/// A force that depends on all that it may: a spring to a line that depends on the particle, and a
/// drag, both growing from zero.
#[derive(Debug)]
struct Medium;

impl ForceDensity for Medium {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        let away = Vector3::new(0.3 - at.position.x, 0.0, 0.1 * (3.0 * at.arc_length).sin() - at.position.z);
        at.time * (away * 2.0 - at.velocity * 0.5)
    }
    fn depends_on_velocity(&self) -> bool {
        true
    }
}

/// A load hangs by its reel under every axial law, after the reel has hoisted it over several
/// elements: the tension at the eye is the weight, and the length that of the law.
///
/// *Source.* Statics; the laws themselves: 30 N strain EA 1e4 N by 3e-3, and the curve by 4e-3, its
/// row.
#[test]
fn a_load_hangs_by_its_reel_as_the_law_says() {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    for (law, strain) in laws().into_iter().zip([3e-3, 3e-3, 4e-3]) {
        let mut cable = rope(1.5, 8, integrator);
        cable.set_gravity(Vector3::zeros()).unwrap();
        let damping = Some(Damping { axial: 5e-3, bending: 5e-3 });
        cable.set_effects(Effects { axial_law: Some(law.clone()), damping, ..Effects::default() }).unwrap();
        cable.add_load(PointLoad::force(0.0, [0.0, -30.0, 0.0])).unwrap();
        cable.equilibrium().unwrap();
        cable.add_reel(At::End, Reel::with_rate(-0.4)).unwrap();
        (0..120).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        cable.set_reel_rate(At::End, 0.0).unwrap();
        (0..30).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        cable.equilibrium().unwrap();
        let (reel, length) = (cable.reel(At::End).unwrap(), cable.length());
        let stretch = -cable.node_position(0).y / length - 1.0;
        println!("{law:?}: {stretch:e}, {reel:?}");
        assert!(reel.merges > 2 && length < 0.9, "{reel:?}");
        assert!((stretch - strain).abs() < 1e-9, "{law:?}: {stretch:e}");
        assert!((reel.tension - 30.0).abs() < 1e-5, "{law:?}: {reel:?}");
        assert!((cable.sample(0.0).unwrap().tension - 30.0).abs() < 1e-5);
    }
}

/// A load falls on a rope with every axial law from a motor, against a brake, off a free spool, a
/// coil and a bag: the account of energy closes, the rate is that under Green's law but for the
/// strain, and that of steps of an eighth but for the first host step, within which the load gains
/// g dt at most.
///
/// *Source.* Conservation of energy; the laws differ by 3/2 of the strain, 1e-3 at most.
#[test]
fn loads_fall_on_reels_under_every_axial_law() {
    // slower than the load falls, so that no rope is slack
    let motor = Reel { max_force: Some(15.0), ..Reel::with_rate(0.8) };
    let from = |feed| Reel { feed, stock: Some(8.0), ..Reel::free_spool() };
    let reels = [motor, Reel::brake(6.0), from(Feed::Drum), from(Feed::Coil), from(Feed::Bag)];
    for reel in reels {
        let run = |law: Option<AxialLaw>, dt: f64| {
            let mut hoist = Hoist::new(1.5, 0.3, dt, reel.clone());
            let effects = Effects { axial_law: law, ..hoist.cable.effects().clone() };
            hoist.cable.set_effects(effects).unwrap();
            let start = hoist.account();
            (0..(0.6 / dt).round() as usize).for_each(|_| hoist.step());
            let now = hoist.cable.reel(At::End).unwrap();
            let moved = 1.5 * G * (now.length_out - 1.0);
            (now, (hoist.account() - start).abs() / moved)
        };
        let (green, _) = run(None, 1.0 / 240.0);
        for law in [AxialLaw::Hooke, AxialLaw::Rope, AxialLaw::Curve(vec![[0.0, 0.0], [4e-4, 30.0], [0.1, 9e3]])] {
            let [(coarse, missed), (fine, less)] = [240.0, 1920.0].map(|rate| run(Some(law.clone()), 1.0 / rate));
            println!(
                "{:?} {:?} {law:?}: {missed:.1e}, {less:.1e} of the energy, rate {} {} {}",
                reel.feed, reel.max_force, green.rate, coarse.rate, fine.rate
            );
            assert!(missed < 1e-3 && less < 1e-4, "{law:?}: {missed:e} {less:e}");
            assert!((coarse.rate / green.rate - 1.0).abs() < 2e-3, "{law:?}: {coarse:?} {green:?}");
            assert!((coarse.rate - fine.rate).abs() < G / 240.0, "{law:?}: {coarse:?} {fine:?}");
            assert!(coarse.splits > 0, "{coarse:?}");
        }
    }
}

/// A damped rope swings in space while reels pay it out and take it in at either end, with each
/// axial law, with a natural curvature, and under a force per length of place, velocity, time and
/// particle: whatever the method, the energy changes by the work of the reel and of the effects,
/// and all methods agree.
///
/// *Source.* Conservation of energy; the methods have nothing in common but the forces.
#[test]
fn the_account_of_a_swinging_rope_closes_with_laws_and_densities() {
    let of_laws = laws().map(|law| (Some(law), false, 0.0)).into_iter();
    let cases = of_laws.chain([(None, true, 0.0), (Some(AxialLaw::Hooke), true, 0.0), (None, false, 0.3)]);
    for ((law, dense, curvature), at) in cases.flat_map(|case| [At::Start, At::End].map(|at| (case.clone(), at))) {
        let mut ends: Vec<Vector3<f64>> = Vec::new();
        for mut integrator in implicit() {
            if curvature > 0.0 && integrator.method == Method::DiscreteGradient {
                // a rope that is straighter than its rest shape needs finer steps
                integrator.control = StepControl::MaxStep(1.0 / 3840.0);
            }
            let (top, bottom) = (Vector3::zeros(), Vector3::new(0.0, -1.5, 0.0));
            let mut cable = Cable::builder()
                .points(if at == At::Start { [top, bottom] } else { [bottom, top] })
                .section(Section::from_stiffness(1.0e4, 0.02, 0.4).unwrap())
                .elements(8)
                .effects(Effects {
                    axial_law: law.clone(),
                    rest_shape: (curvature > 0.0).then(|| RestShape::curved(curvature)),
                    ..Effects::default()
                })
                .damping(Damping { axial: 2e-3, bending: 2e-3 })
                .integrator(integrator)
                .fix(at)
                .build()
                .unwrap();
            cable.equilibrium().unwrap();
            if dense {
                cable.add_force_density(Arc::new(Medium)).unwrap();
            }
            let mut v = cable.velocities().to_vec();
            for node in 0..cable.nodes() {
                v[6 * node] = 0.6 * cable.node_position(node).y;
                v[6 * node + 3] = if at == At::Start { -0.6 } else { 0.6 };
            }
            let q = cable.positions().to_vec();
            cable.set_coordinates(&q, &v).unwrap();
            cable.add_reel(at, Reel { acceleration: 4.0, ..Reel::default() }).unwrap();
            let total = |cable: &Cable| {
                let (reel, law) = (cable.reel(at).unwrap(), cable.energy_law());
                cable.energy().total() - reel.work - reel.remeshed - cable.effect_work().total() + law.numerical
            };
            let before = total(&cable);
            let mut worst = 0.0f64;
            for step in 0..150 {
                let t = f64::from(step) / 120.0;
                cable.set_reel_rate(at, (3.0 * t).sin()).unwrap();
                cable.step(1.0 / 120.0).unwrap();
                worst = worst.max((total(&cable) - before).abs());
            }
            let (reel, work) = (cable.reel(at).unwrap(), cable.effect_work().force_densities);
            let free = cable.node_position(if at == At::Start { cable.nodes() - 1 } else { 0 });
            println!(
                "{law:?} {curvature} {at:?} {:?}: {worst:.1e} J, {free:?}, {work} J, {:.3} J",
                integrator.method, reel.work
            );
            assert!(reel.splits > 2 && (work != 0.0) == dense, "{reel:?}");
            let allowed = if integrator.method == Method::DiscreteGradient { 1e-4 } else { 1e-3 };
            let moved = work.abs() + reel.work.abs();
            assert!(worst < allowed * moved, "{:?}: {worst:e} J of {moved} J", integrator.method);
            ends.push(free);
        }
        for end in &ends {
            assert!((end - ends[0]).norm() < 2e-5, "{law:?} {at:?}: {ends:?}");
        }
    }
}

/// What a force per length is told of the particles, and what it does to them.
#[derive(Debug, Default)]
struct Marks(Mutex<Vec<[f64; 2]>>);

impl ForceDensity for Marks {
    fn force(&self, at: &CablePoint) -> Vector3<f64> {
        self.0.lock().unwrap().push([at.arc_length, at.position.x]);
        Vector3::zeros()
    }
    fn depends_on_velocity(&self) -> bool {
        false
    }
}

/// A particle keeps its arc length whatever a reel at the start takes in and pays out, over splits
/// and merges, through a saved state, and when the reel is taken away.
///
/// *Source.* A straight cable that slides through its eye: the place of a particle is its arc
/// length and what came out.
#[test]
fn particles_keep_their_arc_length_at_a_reel() {
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e6, 0.02, 0.1).unwrap())
        .elements(8)
        .gravity(Vector3::zeros())
        .damping(Damping { axial: 1e-3, bending: 1e-3 })
        .integrator(integrator)
        .fix(At::Start)
        .build()
        .unwrap();
    let marks = Arc::new(Marks::default());
    cable.add_force_density(marks.clone()).unwrap();
    cable.add_reel(At::Start, Reel::default()).unwrap();
    let check = |cable: &mut Cable| {
        marks.0.lock().unwrap().clear();
        cable.step(1e-4).unwrap();
        let passed = cable.length() - 2.0;
        let read = marks.0.lock().unwrap().clone();
        assert!(read.iter().any(|[s, _]| *s > 1.8) && read.len() > 6);
        for [s, x] in read {
            assert!((x - (s + passed)).abs() < 2e-4, "{s} {x} {passed}");
        }
    };
    for (rate, steps) in [(-0.5, 120), (0.5, 240), (0.0, 60)] {
        cable.set_reel_rate(At::Start, rate).unwrap();
        (0..steps).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        check(&mut cable);
        let snapshot = cable.snapshot().clone();
        cable.restore(snapshot).unwrap();
        check(&mut cable);
    }
    let reel = cable.reel(At::Start).unwrap();
    assert!(reel.merges > 2 && reel.splits > 4 && cable.length() > 2.5, "{reel:?}");
    cable.remove_reel(At::Start).unwrap();
    check(&mut cable);
}
