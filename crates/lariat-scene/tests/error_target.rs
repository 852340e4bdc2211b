//! `lariat run --error` and `lariat static --error`: the true error is at most the claimed one.

use lariat_ancf::study::{Claim, Outcome};
use lariat_scene::run::{self, Options, Summary};
use lariat_scene::{Error, Purpose, Scene, Warning};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn assets(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(path)
}

fn read(name: &str, overrides: &[&str], purpose: Purpose) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::read(&assets(&format!("scenes/{name}.toml")), &overrides, purpose).unwrap()
}

fn parse(text: &str, purpose: Purpose) -> Scene {
    Scene::parse("scene.toml", text, &[], purpose).unwrap()
}

fn execute(scene: &Scene, error: Option<f64>, purpose: Purpose) -> (Summary, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let mut options = Options { error: error.map(Into::into), ..Options::default() };
    let summary = match purpose {
        Purpose::Run | Purpose::Resume => run::run(scene, folder.path(), &mut options),
        Purpose::Static => run::statics(scene, folder.path(), &mut options),
    };
    (summary.unwrap(), folder)
}

fn claim(summary: &Summary) -> &Claim {
    let claim = &summary.error.as_ref().unwrap().claim;
    println!("{}: {claim:?}", summary.name);
    claim
}

fn rows(folder: &Path, probe: &str) -> Vec<Vec<f64>> {
    csv(&folder.join(format!("probes/{probe}.csv")))
}

fn csv(file: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(file).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Largest distance of the points of all point probes of two runs.
fn apart(scene: &Scene, a: &Path, b: &Path) -> f64 {
    let mut largest: f64 = 0.0;
    for probe in &scene.probes {
        let (a, b) = (rows(a, &probe.name), rows(b, &probe.name));
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().zip(&b) {
            largest = largest.max(distance(&a[1..4], &b[1..4]));
        }
    }
    largest
}

/// *Source.* The tip of the falling pendulum by an independent solver with Richardson extrapolation, `pendulum_converged_tip.csv`.
#[test]
fn the_claim_for_the_pendulum_holds_against_the_independent_solver() {
    let scene = read("falling_pendulum", &[], Purpose::Run);
    let beam = csv(&assets("reference/pendulum_converged_tip.csv"));
    for error in [1e-1, 1e-2, 1e-3, 1e-4] {
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let tip = rows(folder.path(), "tip");
        assert_eq!(tip.len(), 201);
        let error_of_tip =
            tip.iter().zip(&beam).map(|(tip, beam)| distance(&tip[1..4], &beam[4..7])).fold(0.0, f64::max);
        let claimed = claim.claimed_m.unwrap();
        println!("asked {error:.0e}, claimed {claimed:.1e}, true {error_of_tip:.1e}, cost {:.1}", claim.cost);
        assert!(claim.outcome == Outcome::Proven && claimed <= error && error_of_tip <= claimed && claim.cost < 4.0);
        let coarse = |w: &Warning| matches!(w, Warning::Cable(lariat_ancf::Warning::CoarseMesh { .. }));
        assert!(summary.warnings.iter().all(coarse), "{:?}", summary.warnings);
    }
}

/// *Source.* Mattiasson 1981, elliptic integrals: P L^2/EI = 10 gives u/L = 0.55500, w/L = 0.81061 for the inextensible elastica; the strain
/// of the axis, at most P/EA = 1e-5, moves the tip by less than 1e-5 m. An end moment of EI pi/2 bends the cantilever to a quarter of a
/// circle with the tip at 2/pi, 2/pi.
#[test]
fn the_claim_for_the_elastica_holds_against_elliptic_integrals() {
    let scene = read("elastica", &[], Purpose::Static);
    for error in [1e-2, 1e-3, 1e-4] {
        let (summary, folder) = execute(&scene, Some(error), Purpose::Static);
        let claim = claim(&summary);
        assert_eq!((claim.tolerance_m, claim.time_m, claim.horizon_s), (None, Some(0.0), None));
        let two_over_pi = std::f64::consts::FRAC_2_PI;
        for (probe, tip) in [
            ("force", [1.0 - 0.5549955977537551, -0.8106090248802974, 0.0]),
            ("moment", [two_over_pi, -two_over_pi, 0.5]),
        ] {
            let off = distance(&rows(folder.path(), probe)[0][1..4], &tip);
            println!("{probe}: asked {error:.0e}, off {off:.1e}");
            assert!(off <= claim.claimed_m.unwrap() + 1e-5, "{probe}: {off:.1e} m");
        }
    }
}

/// A slack cable that hangs from both ends and gets a jump of a force in its middle: waves accumulate errors of the mesh.
fn kicked(mass: f64, force: f64, tension: f64) -> String {
    format!(
        "duration = 1.0\ndt = 0.01\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nlength = 2.2\ninitial = \
         \"equilibrium\"\naxial_stiffness = {tension:?}\nbending_stiffness = 0.01\nmass_per_length = {mass:?}\n[[attachment]]\ncable = \"line\"\nat = \
         \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n[[load]]\ncable = \"line\"\nat = 0.8\n\
         force = [0.0, 0.0, {force:?}]\nramp = 0.05\n[[probe]]\nname = \"a\"\ncable = \"line\"\nat = 0.5\n[[probe]]\nname = \"b\"\ncable = \"line\"\n\
         at = 1.37\n"
    )
}

/// *Source.* The same scene with twice as many elements and a tolerance ten times tighter.
#[test]
fn the_claim_holds_where_waves_accumulate_errors() {
    for (mass, force, stiffness, error) in [(0.5, 6.0, 1e4, 3e-3), (0.5, 6.0, 1e4, 3e-4), (0.2, 3.0, 1e5, 1e-3)] {
        let text = kicked(mass, force, stiffness);
        let scene = parse(&text, Purpose::Run);
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let (n, tolerance) = (2 * claim.elements, claim.tolerance_m.unwrap() / 10.0);
        let finer = format!("name = \"line\"\nelements = {n}\nintegrator = {{ tolerance = {tolerance:?} }}");
        let (_, finer) = execute(&parse(&text.replace("name = \"line\"", &finer), Purpose::Run), None, Purpose::Run);
        let off = apart(&scene, folder.path(), finer.path());
        println!("asked {error:.0e}, claimed {:.1e}, off {off:.1e}", claim.claimed_m.unwrap());
        assert!(off <= claim.claimed_m.unwrap());
    }
}

/// A rope that falls on a floor, one that lands on its end and bounces, and one that swings against a post: up to the time to which the error is
/// proven, which may be that of an impact, it is.
///
/// *Source.* The same scene with twice as many elements and host steps of a sixty-fourth.
#[test]
fn the_claim_holds_across_impacts() {
    let scene = |body: &str, points: &str, held: &str, [mass, stiffness, restitution]: [f64; 3], finer: &str| {
        format!(
            "{finer}duration = 0.5\n[[body]]\nname = \"thing\"\nkind = \"fixed\"\n{body}\nfriction = 0.3\nrestitution = {restitution:?}\n\
             [[cable]]\nname = \"line\"\npoints = {points}\naxial_stiffness = 1e4\nbending_stiffness = {stiffness:?}\nmass_per_length = {mass:?}\n\
             damping = {{ axial = 0.01, bending = 0.02 }}\ncontact = {{ radius = 0.02, friction = 0.3, restitution = {restitution:?} }}\n{held}\
             [[probe]]\nname = \"tip\"\ncable = \"line\"\nat = \"end\"\n"
        )
    };
    let plane = "shape = { plane = [0.0, 1.0, 0.0] }";
    let post =
        "shape = { cylinder = [1.0, 0.1] }\nrotation = [1.5707963267948966, 0.0, 0.0]\nposition = [0.3, -0.8, 0.0]";
    let held = "[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n";
    for (name, body, points, held, numbers) in [
        ("flat", plane, "[[0.0, 0.5, 0.0], [1.0, 0.5, 0.0]]", "", [0.2, 0.01, 0.0]),
        ("bounces", plane, "[[0.0, 0.4, 0.0], [0.5, 0.55, 0.0]]", "", [0.5, 1.0, 0.6]),
        ("swings", post, "[[0.0, 0.0, 0.0], [1.5, 0.0, 0.0]]", held, [0.1, 0.01, 0.0]),
    ] {
        let asked = 0.02;
        let (summary, folder) =
            execute(&parse(&scene(body, points, held, numbers, ""), Purpose::Run), Some(asked), Purpose::Run);
        let claim = claim(&summary);
        let until = claim.horizon_s.unwrap_or(f64::INFINITY);
        let finer = scene(body, points, held, numbers, &format!("dt = {:?}\n", 1.0 / 3840.0));
        let finer = finer
            .replace("name = \"line\"\npoints", &format!("name = \"line\"\nelements = {}\npoints", 2 * claim.elements));
        let (_, fine) = execute(&parse(&finer, Purpose::Run), None, Purpose::Run);
        let (coarse, fine) = (rows(folder.path(), "tip"), rows(fine.path(), "tip"));
        let every = (fine.len() - 1) / (coarse.len() - 1);
        let pairs = coarse.iter().zip(fine.iter().step_by(every));
        let off = pairs.filter(|(a, _)| a[0] < until).map(|(a, b)| {
            assert!((a[0] - b[0]).abs() < 1e-6, "{} and {} s", a[0], b[0]);
            distance(&a[1..4], &b[1..4])
        });
        let off = off.fold(0.0, f64::max);
        println!("{name}: off {off:.1e} m before {until} s");
        assert!(off <= claim.claimed_m.unwrap_or(asked), "{name}: {off}");
        assert!(until > 0.25, "{name}: {until}");
    }
}

/// After 3.5 s the pendulum is chaotic: independent runs of 8 to 64 elements agree to 3e-4 m at 3 s, and differ by 5e-2 m at 4 s whatever
/// the mesh.
#[test]
fn a_chaotic_motion_is_proven_up_to_its_horizon() {
    let scene = read("falling_pendulum", &["duration=5.0"], Purpose::Run);
    let (summary, _) = execute(&scene, Some(1e-2), Purpose::Run);
    let claim = claim(&summary);
    let horizon = claim.horizon_s.unwrap();
    assert!(claim.outcome == Outcome::NoConvergence && claim.claimed_m.is_none() && 3.0 < horizon && horizon < 4.0);
    let told = |w: &Warning| matches!(w, Warning::NoConvergence { horizon_s: Some(t), .. } if *t == horizon);
    assert!(summary.warnings.iter().any(told), "{:?}", summary.warnings);
}

/// Whips, whose coarse meshes do not come closer to each other before they resolve the motion: that no mesh does is claimed only where
/// one twice as fine is as far away, and a claimed error holds.
///
/// *Source.* The same run with twice the elements and a tenth of the tolerance.
#[test]
fn meshes_that_come_closer_later_are_not_given_up() {
    for (speed, bending, mass) in [(12.0, 1e-3, 0.05), (9.0, 1e-3, 0.05), (12.0, 1e-2, 0.1)] {
        let text = format!(
            "duration = 0.4\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"c\"\npoints = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\n\
             axial_stiffness = 2e4\nbending_stiffness = {bending:?}\nmass_per_length = {mass:?}\nangular_velocity = [0.0, 0.0, {speed:?}]\n\
             [[attachment]]\ncable = \"c\"\nat = \"start\"\nbody = \"world\"\n[[probe]]\nname = \"p\"\ncable = \"c\"\nat = \"end\"\n"
        );
        let scene = parse(&text, Purpose::Run);
        let (summary, folder) = execute(&scene, Some(1e-3), Purpose::Run);
        let claim = claim(&summary);
        let (n, tolerance) = (2 * claim.elements, claim.tolerance_m.unwrap() / 10.0);
        let finer = format!("name = \"c\"\nelements = {n}\nintegrator = {{ tolerance = {tolerance:?} }}");
        let (_, finer) = execute(
            &parse(&text.replace("name = \"c\"\npoints", &(finer + "\npoints")), Purpose::Run),
            None,
            Purpose::Run,
        );
        let off = apart(&scene, folder.path(), finer.path());
        match claim.outcome {
            Outcome::Proven => assert!(off <= claim.claimed_m.unwrap(), "{speed} rad/s: {off:.1e} m, {claim:?}"),
            _ => assert!(off > 1e-3, "{speed} rad/s: {off:.1e} m, {claim:?}"),
        }
    }
}

/// With a host step so short that one step per host step passes both tolerances, their difference is zero: the error in time is not.
#[test]
fn a_tolerance_that_the_host_step_hides_is_flagged() {
    let scene = read("falling_pendulum", &["duration=0.5"], Purpose::Run);
    let (summary, _) = execute(&scene, Some(5e-2), Purpose::Run);
    let claim = claim(&summary);
    assert!(claim.host_step_limits && claim.time_m > claim.tolerance_m);
    let (summary, _) = execute(&scene, Some(1e-4), Purpose::Run);
    let claim = self::claim(&summary);
    assert!(!claim.host_step_limits && claim.time_m > Some(0.0));
}

/// What is on disk is the run that the claim is about, whatever runs came after it.
///
/// *Source.* The same scene with the elements and the tolerance of the claim: the same numbers, bit for bit.
#[test]
fn the_files_are_those_of_the_run_that_is_claimed() {
    let scene = read("falling_pendulum", &["duration=0.5"], Purpose::Run);
    for error in [5e-2, 1e-3] {
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let mut same = scene.clone();
        same.cables[0].elements = claim.elements;
        let resolution = lariat_ancf::study::Resolution { tolerance: claim.tolerance_m, ..Default::default() };
        same.cables[0].integrator = resolution.integrator().into();
        let (_, there) = execute(&same, None, Purpose::Run);
        let file = |folder: &TempDir| fs::read_to_string(folder.path().join("probes/tip.csv")).unwrap();
        assert_eq!(file(&folder), file(&there), "{error}");
    }
}

/// Bars that swing, bounce or spin in long host steps: their steps pass two tolerances, and the errors per step add up to more than the tolerances.
///
/// *Source.* The same scene with twice as many elements and a tolerance a thousand times tighter. Before, claims were down to 0.4 of the true error.
#[test]
fn the_claim_holds_where_a_motion_amplifies_the_errors_of_steps() {
    let bar = |dt: f64| {
        format!(
            "duration = 2.0\ndt = {dt:?}\n[[cable]]\nname = \"rod\"\npoints = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\naxial_stiffness = 1.0e6\n\
             bending_stiffness = 300.0\nmass_per_length = 0.5\n[[attachment]]\ncable = \"rod\"\nat = \"start\"\nbody = \"world\"\n\
             [[probe]]\nname = \"tip\"\ncable = \"rod\"\nat = \"end\"\n"
        )
    };
    for (dt, error) in [(0.05, 1e-2), (1.0 / 30.0, 3e-3), (0.05, 3e-4)] {
        let text = bar(dt);
        let scene = parse(&text, Purpose::Run);
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let Some(claimed) = claim.claimed_m else { continue };
        let (n, tolerance) = (2 * claim.elements, claim.tolerance_m.unwrap() / 1000.0);
        let finer = format!("name = \"rod\"\nelements = {n}\nintegrator = {{ tolerance = {tolerance:?} }}");
        let (_, finer) = execute(&parse(&text.replace("name = \"rod\"", &finer), Purpose::Run), None, Purpose::Run);
        let off = apart(&scene, folder.path(), finer.path());
        println!("dt {dt}, asked {error:.0e}, claimed {claimed:.1e}, off {off:.1e}, cost {:.1}", claim.cost);
        assert!(off <= claimed);
    }
}

/// Long host steps, of which each is one integration step: two tolerances give the same motion, which is not the true one.
///
/// *Source.* The same scene with twice as many elements and a tolerance a hundred times tighter.
#[test]
fn the_claim_holds_where_the_host_step_limits_the_steps() {
    for (dt, bending, error) in [(0.05, 0.3, 0.3), (0.05, 2.0, 0.1), (0.02, 0.3, 0.03)] {
        let text = format!(
            "duration = 1.5\ndt = {dt:?}\n[[cable]]\nname = \"rod\"\npoints = [[0.0, 0.0, 0.0], [1.5, 0.4, 0.0]]\naxial_stiffness = 3.0e4\n\
             bending_stiffness = {bending:?}\nmass_per_length = 0.4\n[[attachment]]\ncable = \"rod\"\nat = \"start\"\nbody = \"world\"\n\
             [[probe]]\nname = \"tip\"\ncable = \"rod\"\nat = \"end\"\n"
        );
        let scene = parse(&text, Purpose::Run);
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let (n, tolerance) = (2 * claim.elements, claim.tolerance_m.unwrap() / 100.0);
        let finer = format!("name = \"rod\"\nelements = {n}\nintegrator = {{ tolerance = {tolerance:?} }}");
        let (_, finer) = execute(&parse(&text.replace("name = \"rod\"", &finer), Purpose::Run), None, Purpose::Run);
        let off = apart(&scene, folder.path(), finer.path());
        println!("dt {dt}, asked {error:.0e}, claimed {:.1e}, off {off:.1e}", claim.claimed_m.unwrap());
        assert!(off <= claim.claimed_m.unwrap());
    }
}

/// A cable held at so many points that four and eight elements are the same mesh between them: that they agree proves nothing.
///
/// *Source.* The same scene with three times as many elements.
#[test]
fn meshes_that_are_not_refined_prove_nothing() {
    for (spans, error) in [(6, 1e-3), (8, 1e-3), (12, 1e-2)] {
        let h = 6.0 / f64::from(spans);
        let mut text = "gravity = [0.0, -9.81, 0.0]\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]]\nlength = 6.6\n\
                        axial_stiffness = 1.0e5\nbending_stiffness = 1.0e-2\nmass_per_length = 0.5\n"
            .to_string();
        for k in 0..=spans {
            let (x, s) = (h * f64::from(k), 1.1 * h * f64::from(k));
            let at = if k < spans { format!("{s:?}") } else { "\"end\"".to_string() };
            text +=
                &format!("[[attachment]]\ncable = \"line\"\nat = {at}\nbody = \"world\"\nanchor = [{x:?}, 0.0, 0.0]\n");
            if k < spans {
                text += &format!("[[probe]]\nname = \"p{k}\"\ncable = \"line\"\nat = {:?}\n", s + 0.4 * h);
            }
        }
        let scene = parse(&text, Purpose::Static);
        let (summary, folder) = execute(&scene, Some(error), Purpose::Static);
        let claim = claim(&summary);
        assert!(claim.elements > spans as usize && claim.outcome == Outcome::Proven);
        let finer = text.replace("name = \"line\"", &format!("name = \"line\"\nelements = {}", 3 * claim.elements));
        let (_, finer) = execute(&parse(&finer, Purpose::Static), None, Purpose::Static);
        let off = apart(&scene, folder.path(), finer.path());
        println!("off {off:.1e}");
        assert!(off <= claim.claimed_m.unwrap());
    }
}

/// Bodies in single precision: a body 2 m away is known to 1e-7 m, one 2 km away to 1e-4 m.
#[test]
fn an_error_below_the_precision_is_refused_before_anything_is_written() {
    let scene = read("payload_pendulum", &["duration=0.1"], Purpose::Run);
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let refused = |scene: &Scene, error: f64| {
        let options = &mut Options { error: Some(error.into()), ..Options::default() };
        match run::run(scene, &out, options) {
            Err(Error::ErrorTooSmall { least, .. }) => least,
            other => panic!("{other:?}"),
        }
    };
    assert!((refused(&scene, 1e-6) - 2e-5).abs() < 1e-6);
    for error in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(&scene, error);
    }
    let mut far = scene.clone();
    far.bodies[0].course.position.x += 2000.0;
    assert!(refused(&far, 1e-3) > 1e-2);
    refused(&read("falling_pendulum", &[], Purpose::Run), 1e-9);
    assert!(!out.exists());
}

/// A crate of 50 kg on a sling; the claim is the same in two runs, and is in summary.json.
///
/// *Source.* The same scene with twice as many elements and a tolerance ten times tighter.
#[test]
fn the_claim_for_a_body_on_a_cable_holds_and_is_deterministic() {
    let scene = read("payload_pendulum", &["duration=0.5", "cable.sling.damping={ axial = 1e-3 }"], Purpose::Run);
    let (first, folder) = execute(&scene, Some(1e-2), Purpose::Run);
    let (second, _) = execute(&scene, Some(1e-2), Purpose::Run);
    assert_eq!(first.error, second.error);
    let text = fs::read_to_string(folder.path().join("summary.json")).unwrap();
    assert_eq!(serde_json::from_str::<Summary>(&text).unwrap().error, first.error);
    let claim = claim(&first);
    let error = first.error.as_ref().unwrap();
    assert_eq!(error.elements_of["sling"], claim.elements);
    assert!(error.not_covered.iter().any(|text| text.contains("single precision")));
    let mut finer = scene.clone();
    finer.cables[0].elements = 2 * claim.elements;
    let resolution =
        lariat_ancf::study::Resolution { tolerance: claim.tolerance_m.map(|x| x / 10.0), ..Default::default() };
    finer.cables[0].integrator = resolution.integrator().into();
    let (_, there) = execute(&finer, None, Purpose::Run);
    let (a, b) = (rows(folder.path(), "crate"), rows(there.path(), "crate"));
    let off = a.iter().zip(&b).map(|(a, b)| distance(&a[1..4], &b[1..4])).fold(0.0, f64::max);
    println!("off {off:.1e}");
    assert!(off <= claim.claimed_m.unwrap());
}

/// A stiff tether on an arm of a multibody: four steps per host step pass the looser tolerance, so that it is kept by more than asked, and the
/// error falls by less than the tolerance.
///
/// *Source.* The same scene with twice as many elements and a tolerance sixteen times tighter.
#[test]
fn the_claim_holds_where_the_host_step_limits_the_looser_run() {
    let scene = read("tether_multibody", &["duration=0.5"], Purpose::Run);
    for error in [2e-4, 1e-4, 5e-5] {
        let (summary, folder) = execute(&scene, Some(error), Purpose::Run);
        let claim = claim(&summary);
        let mut finer = scene.clone();
        finer.cables[0].elements = 2 * claim.elements;
        let tolerance = claim.tolerance_m.map(|tolerance| tolerance / 16.0);
        finer.cables[0].integrator =
            lariat_ancf::study::Resolution { tolerance, ..Default::default() }.integrator().into();
        let (_, there) = execute(&finer, None, Purpose::Run);
        let (a, b) = (rows(folder.path(), "hand"), rows(there.path(), "hand"));
        let off = a.iter().zip(&b).map(|(a, b)| distance(&a[1..4], &b[1..4])).fold(0.0, f64::max);
        println!("asked {error:.0e}, off {off:.1e}");
        assert!(off <= claim.claimed_m.unwrap());
    }
}

/// The rule of fidelity `game` goes with its integrator, which an error that is asked for replaces: the same runs with and without the
/// key, and a rule that the scene asks for stays.
#[test]
fn a_fidelity_says_nothing_about_the_runs_to_an_error() {
    let plain = read("falling_pendulum", &["duration=0.3"], Purpose::Run);
    let game = read("falling_pendulum", &["duration=0.3", "cable.0.integrator={ fidelity = \"game\" }"], Purpose::Run);
    let [one, other] = [&plain, &game].map(|scene| execute(scene, Some(1e-3), Purpose::Run));
    assert_eq!(claim(&one.0), claim(&other.0));
    assert_eq!(apart(&plain, one.1.path(), other.1.path()), 0.0);
    let asked = "cable.0.rule=\"projected-T1\"";
    let own =
        read("falling_pendulum", &["duration=0.3", "cable.0.integrator={ fidelity = \"game\" }", asked], Purpose::Run);
    let own = execute(&own, Some(1e-3), Purpose::Run);
    assert!(apart(&plain, one.1.path(), own.1.path()) > 0.0);
}

/// What no cable has is not studied.
#[test]
fn moments_of_cables_without_bending_stiffness_are_refused() {
    let text = "duration = 1.0\n[[cable]]\nname = \"c\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nlength = 3.0\nsection = { chain = 0.006 }\n\
                [[attachment]]\ncable = \"c\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"c\"\nat = \"end\"\nbody = \"world\"\n";
    let scene = parse(text, Purpose::Static);
    let folder = tempfile::tempdir().unwrap();
    let mut options = Options { error: Some("moment=5%".parse().unwrap()), ..Options::default() };
    let refused = run::statics(&scene, folder.path(), &mut options).unwrap_err();
    assert!(
        matches!(refused, Error::NoMoment { .. }) && refused.to_string().contains("bending stiffness"),
        "{refused}"
    );
}

/// An anchor that is drawn deep under the seabed that its chain touches: a shape that is found through it is told, by name.
#[test]
fn an_equilibrium_inside_a_body_is_told() {
    let text = |depth: f64| {
        format!(
            "duration = 1.0\n[[body]]\nname = \"seabed\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\nposition = [0.0, -100.0, 0.0]\n[[cable]]\nname = \"chain\"\n\
             points = [[0.0, {:?}, 0.0], [375.0, 0.0, 0.0]]\nlength = 400.0\nsection = {{ chain = 0.076 }}\nelements = 40\n[cable.contact]\n[[attachment]]\ncable = \"chain\"\n\
             at = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"chain\"\nat = \"end\"\nbody = \"world\"\n",
            -100.0 - depth
        )
    };
    for (depth, due) in [(-0.07, false), (1.0, true), (2.0, true)] {
        let folder = tempfile::tempdir().unwrap();
        let scene = parse(&text(depth), Purpose::Static);
        let found = run::statics(&scene, folder.path(), &mut Options::default());
        let told = match &found {
            Ok(summary) => summary.told.iter().any(|line| line.contains("inside body \"seabed\"")),
            // what is refused is no silent answer
            Err(_) => due,
        };
        assert_eq!(told, due, "{depth} m: {found:?}");
    }
}
