//! Scenes of random kinds, sizes, meshes and steps: none is wrong without a warning, none that is right has one, and what `--error` claims
//! holds.
//!
//! *Source of all errors.* The same scene with more elements, and error control at a tight tolerance.

use lariat_ancf::study::Outcome;
use lariat_ancf::{Fidelity, Integrator, Method};
use lariat_scene::run::{self, Options, World};
use lariat_scene::{Purpose, Scene};

/// The generator of Knuth's MMIX, in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// A number whose logarithm is uniform.
    fn scale(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// A scene of one cable, with `elements`: a free rod or rope that swings, a slack cable that is let go, a clamped beam, a bob on a wire, or a
/// cable at rest that is kicked. Times are in shares of the period of a pendulum, stiffness is such that the strain stays small.
fn scene(random: &mut Random, kind: usize, elements: usize) -> Scene {
    let length = random.scale(0.3, 30.0);
    let period = 2.0 * std::f64::consts::PI * (length / 9.81).sqrt();
    let mass = random.scale(0.05, 2.0);
    let weight = mass * length * 9.81;
    let stiffness = weight * random.scale(200.0, 2e4);
    let bending = weight * length * length * random.scale(1e-4, 3e-2);
    let (x, y) = (length * random.between(0.6, 0.95), -length * random.between(0.0, 0.3));
    let mut text = format!("duration = {:?}\ndt = {:?}\n", 0.4 * period, period / random.between(100.0, 400.0));
    let line = |points: &str, bending: f64, rest: &str| {
        // no thicker than a twentieth of the length
        let bending = bending.min(stiffness * (length / 80.0).powi(2));
        format!(
            "[[cable]]\nname = \"line\"\nelements = {elements}\npoints = [[0.0, 0.0, 0.0], {points}]\naxial_stiffness = {stiffness:?}\n\
             bending_stiffness = {bending:?}\nmass_per_length = {mass:?}\n{rest}"
        )
    };
    let hold = |at: &str, kind: &str| {
        format!("[[attachment]]\ncable = \"line\"\nat = \"{at}\"\nbody = \"world\"\nkind = \"{kind}\"\n")
    };
    let far = format!("[{x:?}, {y:?}, 0.0]");
    text += &match kind % 5 {
        0 => line(&far, bending, "") + &hold("start", "ball"),
        1 => {
            line(&far, 0.03 * bending, &format!("length = {length:?}\n"))
                + &hold("start", "ball")
                + &hold("end", "ball")
        }
        2 => line(&far, 10.0 * bending, "") + &hold("start", "clamp"),
        3 => {
            line(&far, bending, "")
                + &hold("start", "ball")
                + &format!(
                    "[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"bob\"\n[[body]]\nname = \"bob\"\nmass = {:?}\n\
                     position = {far}\nshape = {{ ball = 0.02 }}\n",
                    mass * length * random.scale(0.3, 3.0)
                )
        }
        _ => {
            let force = weight * random.between(0.2, 1.0);
            line(&far, bending, &format!("length = {length:?}\ninitial = \"equilibrium\"\n"))
                + &hold("start", "ball")
                + &hold("end", "ball")
                + &format!(
                    "[[load]]\ncable = \"line\"\nat = {:?}\nforce = [0.0, 0.0, {force:?}]\nramp = {:?}\n",
                    0.37 * length,
                    0.1 * period
                )
        }
    };
    Scene::parse("random.toml", &text, &[], Purpose::Run).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Positions of 33 points of the cable at all host times.
fn trace(scene: &Scene) -> Vec<Vec<[f64; 3]>> {
    let mut world = World::build(scene).unwrap();
    world.start(Purpose::Run).unwrap();
    let points = |world: &World| {
        let cable = world.cables()[0];
        (0..33).map(|k| cable.sample(cable.length() * f64::from(k) / 32.0).unwrap().position.into()).collect()
    };
    let mut frames = vec![points(&world)];
    let steps = (scene.duration / scene.dt - 1e-9).ceil() as usize;
    for step in 1..=steps {
        world.advance((step as f64 * scene.dt).min(scene.duration)).unwrap();
        frames.push(points(&world));
    }
    frames
}

fn apart(a: &[Vec<[f64; 3]>], b: &[Vec<[f64; 3]>]) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()).fold(0.0, f64::max)
}

fn exact(scene: &Scene, elements: usize, tolerance: f64) -> Vec<Vec<[f64; 3]>> {
    let mut fine = scene.clone();
    fine.cables[0].elements = elements;
    fine.cables[0].integrator = Integrator::tolerance(Method::Esdirk4, tolerance).unwrap().into();
    trace(&fine)
}

#[test]
fn no_random_scene_is_wrong_without_a_warning_and_none_that_is_right_has_one() {
    let mut random = Random(11);
    let (mut silent, mut false_alarms, mut wrong) = (Vec::new(), Vec::new(), 0);
    for case in 0..80 {
        let elements = [2, 3, 4, 6, 8, 12, 20, 30][(8.0 * random.next()) as usize];
        let mut scene = scene(&mut random, case, elements);
        if case % 2 == 1 {
            scene.cables[0].integrator = Fidelity::Game;
        }
        let length = scene.cables[0].length;
        let summary = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap().summary;
        let truth = exact(&scene, 60.max(3 * elements), 1e-7 * length);
        let off = apart(&trace(&scene), &truth) / length;
        wrong += usize::from(off > 0.01);
        let texts: Vec<String> = summary.warnings.iter().map(ToString::to_string).collect();
        println!(
            "{case} (kind {}), {length:.2} m, {elements} elements, game {}: off by {off:.1e} L; {texts:?}",
            case % 5,
            case % 2 == 1
        );
        if off > 0.01 && texts.is_empty() {
            silent.push((case, off));
        }
        if off < 2e-4 && !texts.is_empty() {
            false_alarms.push((case, off, texts));
        }
    }
    assert!(wrong >= 8, "{wrong} scenes are wrong");
    assert!(silent.is_empty(), "{silent:?}");
    assert!(false_alarms.is_empty(), "{false_alarms:?}");
}

#[test]
fn what_is_claimed_for_random_scenes_holds_and_is_not_far_from_the_truth() {
    let mut random = Random(5);
    let (mut ratios, mut costs) = (Vec::new(), Vec::new());
    for case in 0..12 {
        let scene = scene(&mut random, case, 10);
        let length = scene.cables[0].length;
        let error = length * random.scale(3e-4, 1e-2);
        let mut options = Options { error: Some(error.into()), ..Options::default() };
        let recording = run::collect(&scene, Purpose::Run, &mut options).unwrap();
        let claim = recording.summary.error.unwrap().claim;
        let finer = exact(&scene, 2 * claim.elements, 0.1 * claim.tolerance_m.unwrap());
        let off = apart(&exact(&scene, claim.elements, claim.tolerance_m.unwrap()), &finer);
        println!("{case} (kind {}), asked {:.1e} L, off {:.1e} L: {claim:?}", case % 5, error / length, off / length);
        costs.push(claim.cost);
        match claim.claimed_m {
            Some(claimed) => {
                assert!(off <= claimed && claimed <= error, "{case}: {off:e} m, claimed {claimed:e} m");
                ratios.push(claimed / off);
            }
            None => assert_ne!(claim.outcome, Outcome::Proven),
        }
    }
    ratios.sort_by(f64::total_cmp);
    costs.sort_by(f64::total_cmp);
    println!("claimed over true: {ratios:.2?}; all runs over the last: {costs:.2?}");
    assert!(costs[costs.len() - 1] <= 4.0);
    assert!(ratios.len() >= 10 && ratios[ratios.len() / 2] < 10.0);
}
