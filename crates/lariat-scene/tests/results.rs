//! Runs and statics against independent values: the converged beam, the independent solver, the catenary, the elastica.

use approx::assert_relative_eq;
use lariat_scene::run::{self, Options, World};
use lariat_scene::{Purpose, Scene};
use std::fs;
use std::path::{Path, PathBuf};

fn assets(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(path)
}

fn read(name: &str, overrides: &[&str], purpose: Purpose) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::read(&assets(&format!("scenes/{name}.toml")), &overrides, purpose).unwrap()
}

fn rows(file: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(file).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect()
}

#[test]
fn the_falling_pendulum_scene_follows_the_converged_beam() {
    let scene = read("falling_pendulum", &[], Purpose::Run);
    let folder = tempfile::tempdir().unwrap();
    let summary = run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    let (tip, beam) =
        (rows(&folder.path().join("probes/tip.csv")), rows(&assets("reference/pendulum_converged_tip.csv")));
    assert_eq!(tip.len(), 201);
    for (tip, beam) in tip.iter().zip(&beam) {
        assert_relative_eq!(tip[0], beam[0], epsilon = 1e-12);
        let distance = ((tip[1] - beam[4]).powi(2) + (tip[2] - beam[5]).powi(2) + (tip[3] - beam[6]).powi(2)).sqrt();
        assert!(distance < 1e-3, "{distance:.2e} m at t = {}", tip[0]);
    }
    assert!((summary.energy_end_j.unwrap() - summary.energy_start_j.unwrap()).abs() < 1e-3);
    for row in rows(&folder.path().join("probes/energy.csv")) {
        assert_relative_eq!(row[1..5].iter().sum::<f64>(), row[7], epsilon = 1e-12);
    }
}

/// The independent solver's G10-10 run with 10 elements: positions, energies and the reaction at the pin.
#[test]
fn the_same_scene_with_the_papers_reference_rule_matches_the_independent_solver_to_a_micrometre() {
    let overrides = [
        "cable.pendulum.elements=10",
        "cable.pendulum.rule=G10-10",
        "cable.pendulum.integrator={ method = \"rkn6\", stable = 0.5 }",
    ];
    let scene = read("falling_pendulum", &overrides, Purpose::Run);
    let folder = tempfile::tempdir().unwrap();
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    let probe = |name: &str| rows(&folder.path().join(format!("probes/{name}.csv")));
    let reference = rows(&assets("reference/pendulum_G10-10_10el.csv"));
    let (tip, energy, pin) = (probe("tip"), probe("energy"), probe("pin"));
    assert_eq!(reference.len(), tip.len());
    for (k, r) in reference.iter().enumerate() {
        for i in 1..4 {
            assert!((tip[k][i] - r[i]).abs() < 1e-6, "tip at t = {}: {} and {}", r[0], tip[k][i], r[i]);
            // the reaction's part along x rests on the acceleration at t = 0 alone in the first row
            assert!(
                (pin[k][i] + r[11 + i]).abs() < 1e-3,
                "force on the world at t = {}: {} and {}",
                r[0],
                pin[k][i],
                -r[11 + i]
            );
        }
        for i in 1..5 {
            assert!(
                (energy[k][i] - r[6 + i]).abs() < 2e-4,
                "energy {i} at t = {}: {} and {}",
                r[0],
                energy[k][i],
                r[6 + i]
            );
        }
    }
}

#[test]
fn the_catenary_scene_has_the_tensions_of_the_catenary() {
    let scene = read("catenary", &[], Purpose::Static);
    let mut world = World::build(&scene).unwrap();
    world.start(Purpose::Static).unwrap();
    // inextensible, without bending stiffness: sqrt(L^2 - v^2) = 2 a sinh(w/(2 a)), horizontal tension m g a
    let (w, v, length, weight) = (2.0f64, 0.5f64, 3.0f64, 0.5 * 9.81);
    let horizontal = weight * scale_of_catenary(w, v, length);
    let (left, ..) = world.attachment(0).unwrap();
    let (right, ..) = world.attachment(1).unwrap();
    assert_relative_eq!(left.x, horizontal, max_relative = 2e-3);
    assert_relative_eq!(right.x, -horizontal, max_relative = 2e-3);
    assert_relative_eq!(left.y + right.y, -weight * length, max_relative = 1e-9);
    // tension differs by the weight of the height between two points
    let cable = &world.cables()[0];
    let (start, middle, end) = (cable.sample(0.0).unwrap(), cable.sample(1.5).unwrap(), cable.sample(3.0).unwrap());
    assert_relative_eq!(end.tension - start.tension, weight * 0.5, max_relative = 2e-3);
    // where the cable bends most (element length over radius 0.1) tension is read less accurately
    assert_relative_eq!(middle.tension, horizontal.hypot(left.y + 1.5 * weight), max_relative = 1.5e-2);
}

/// The readings of `lariat static` on the catenary: reactions carry the weight, the peak tension is at the higher end, and the sag
/// is that of the analytic curve below the chord.
///
/// *Source.* y = a cosh(x/a) with sqrt(L^2 - v^2) = 2 a sinh(w/(2 a)).
#[test]
fn statics_of_the_catenary_report_reactions_peak_tension_and_sag() {
    let folder = tempfile::tempdir().unwrap();
    let summary =
        run::statics(&read("catenary", &[], Purpose::Static), folder.path(), &mut run::Options::default()).unwrap();
    let statics = &summary.statics.unwrap()[0];
    assert!(statics.stable && statics.residual_n < 1e-6 && statics.iterations > 0, "{statics:?}");
    let sum: f64 = statics.reactions.iter().map(|reaction| reaction.force_n[1]).sum();
    assert_relative_eq!(sum, -3.0 * 0.5 * 9.81, max_relative = 1e-9);
    assert_eq!(statics.reactions.iter().map(|reaction| reaction.at_m).collect::<Vec<_>>(), [0.0, 3.0]);
    let right = statics.reactions[1].force_n;
    assert_relative_eq!(statics.peak_tension_n, right[0].hypot(right[1]), max_relative = 2e-3);
    assert_eq!(statics.peak_tension_at_m, 3.0);
    let (w, v, length) = (2.0f64, 0.5f64, 3.0f64);
    let a = scale_of_catenary(w, v, length);
    // x of the lowest point from the left end
    let low = 0.5 * w - a * (v / (2.0 * a * (0.5 * w / a).sinh())).asinh();
    let below = |x: f64| v * x / w - a * (((x - low) / a).cosh() - (low / a).cosh());
    let sag = (0..=2000).map(|i| below(w * f64::from(i) / 2000.0)).fold(0.0, f64::max);
    assert_relative_eq!(statics.sag_m.unwrap(), sag, max_relative = 2e-3);
}

/// Returns a of the catenary of a length over a width and a height, by bisection.
fn scale_of_catenary(width: f64, height: f64, length: f64) -> f64 {
    let chord = (length * length - height * height).sqrt();
    let (mut low, mut high) = (0.05f64, 50.0f64);
    for _ in 0..200 {
        let a = 0.5 * (low + high);
        if 2.0 * a * (0.5 * width / a).sinh() > chord { low = a } else { high = a }
    }
    low
}

/// All reactions of a net together carry its weight and its load: each cable pulls once at a knot, however many cables meet there
/// and whichever of them the junctions name.
///
/// *Source.* Balance of forces; what the cables of a knot do there to each other adds up to nothing.
#[test]
fn reactions_of_a_net_carry_its_weight_and_its_load() {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut random = move |low: f64, high: f64| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        low + (high - low) * (state >> 11) as f64 / (1u64 << 53) as f64
    };
    for count in 2..6 {
        let (knot, load) =
            ([random(-1.0, 1.0), -3.0, random(-1.0, 1.0)], [random(-50.0, 50.0), -500.0, random(-50.0, 50.0)]);
        let (mut text, mut mass) = ("duration = 1.0\n".to_string(), 0.0);
        for k in 0..=count {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count) + random(-0.2, 0.2);
            let pendant = k == count;
            let far = if pendant {
                [knot[0], knot[1] - 3.0, knot[2]]
            } else {
                [knot[0] + 3.0 * angle.cos(), random(-0.5, 0.5), knot[2] + 3.0 * angle.sin()]
            };
            let chord = far.iter().zip(&knot).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            let (length, heavy) = (chord * random(1.01, 1.05), random(0.1, 0.4));
            mass += length * heavy;
            text += &format!(
                "[[cable]]\nname = \"c{k}\"\npoints = [{far:?}, {knot:?}]\nlength = {length:?}\nelements = 6\n\
                 axial_stiffness = 2e5\nbending_stiffness = 0.0\nmass_per_length = {heavy:?}\n"
            );
            if !pendant {
                text +=
                    &format!("[[attachment]]\ncable = \"c{k}\"\nat = \"start\"\nbody = \"world\"\nkind = \"ball\"\n");
            }
        }
        for k in 0..count {
            // to the first, or to the one before: one knot either way
            let other = if random(0.0, 1.0) < 0.5 { 0 } else { k };
            text += &format!(
                "[[junction]]\ncable = \"c{other}\"\nat = \"end\"\nother = \"c{}\"\nother_at = \"end\"\n",
                k + 1
            );
        }
        text += &format!("[[load]]\ncable = \"c{count}\"\nat = \"start\"\nforce = {load:?}\n");
        let scene = Scene::parse("net.toml", &text, &[], Purpose::Static).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let statics = run::statics(&scene, folder.path(), &mut Options::default()).unwrap().statics.unwrap();
        let mut sum = load;
        sum[1] -= mass * 9.81;
        for reaction in statics.iter().flat_map(|cable| &cable.reactions) {
            (0..3).for_each(|i| sum[i] -= reaction.force_n[i]);
        }
        assert!(sum.iter().all(|x| x.abs() < 1e-4), "{count} cables: {sum:?} N left; {statics:#?}");
    }
}

#[test]
fn statics_of_a_cable_with_one_support_have_no_sag() {
    let folder = tempfile::tempdir().unwrap();
    let summary =
        run::statics(&read("cantilever", &[], Purpose::Static), folder.path(), &mut run::Options::default()).unwrap();
    let statics = &summary.statics.unwrap()[0];
    assert_eq!((statics.sag_m, statics.reactions.len(), statics.reactions[0].name.as_str()), (None, 1, "wall"));
}

#[test]
fn a_run_from_equilibrium_stays_at_rest() {
    let scene = read("catenary", &[], Purpose::Run);
    let folder = tempfile::tempdir().unwrap();
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    let middle = rows(&folder.path().join("probes/middle.csv"));
    assert_eq!(middle.len(), 21);
    for row in &middle {
        assert!((1..4).all(|i| (row[i] - middle[0][i]).abs() < 1e-8), "{row:?}");
    }
}

/// Inextensible elastica with P L^2/EI = 2 (Mattiasson 1981).
#[test]
fn the_cantilever_scene_bends_as_the_elastica() {
    let scene = read("cantilever", &[], Purpose::Static);
    let folder = tempfile::tempdir().unwrap();
    run::statics(&scene, folder.path(), &mut run::Options::default()).unwrap();
    let probe = |name: &str| rows(&folder.path().join(format!("probes/{name}.csv")));
    let (tip, wall) = (&probe("tip")[0], &probe("wall")[0]);
    assert!((tip[1] - (1.0 - 0.160_64)).abs() < 1e-4 && (tip[2] + 0.493_46).abs() < 1e-4, "{tip:?}");
    // the wall carries the load and its moment about the root
    assert_relative_eq!(wall[2], -2.0, max_relative = 1e-9);
    assert_relative_eq!(wall[6], -2.0 * tip[1], max_relative = 1e-3);
}

/// Under a force the elastica with P L^2/EI = 10 (Mattiasson 1981, table 1: w/L = 0.81061, u/L = 0.55500), under an end moment of
/// pi/2 EI/L a quarter of a circle.
#[test]
fn the_elastica_scene_bends_as_the_elastica_and_the_circle() {
    let folder = tempfile::tempdir().unwrap();
    run::statics(&read("elastica", &[], Purpose::Static), folder.path(), &mut run::Options::default()).unwrap();
    let last = |probe: &str| rows(&folder.path().join(format!("probes/{probe}.csv"))).pop().unwrap();
    let two_over_pi = std::f64::consts::FRAC_2_PI;
    for (probe, x, y, within) in [("force", 1.0 - 0.55500, -0.81061, 2e-5), ("moment", two_over_pi, -two_over_pi, 1e-5)]
    {
        let tip = last(probe);
        assert!((tip[1] - x).hypot(tip[2] - y) < within, "{probe}: {tip:?}");
    }
    // forces and moments on the walls: what was put on at the tips, with the arm of the force
    let (force, moment) = (last("wall_force"), last("wall_moment"));
    assert!((force[2] + 10.0).abs() < 1e-6 && (force[6] + 10.0 * 0.44500).abs() < 1e-3, "{force:?}");
    assert!((moment[6] + std::f64::consts::FRAC_PI_2).abs() < 1e-3, "{moment:?}");
}

#[test]
fn a_load_with_a_ramp_is_zero_at_the_start_and_full_in_statics() {
    let scene = read("cantilever", &["cable.beam.initial=equilibrium"], Purpose::Run);
    let mut world = World::build(&scene).unwrap();
    world.start(Purpose::Run).unwrap();
    assert!(world.cables()[0].sample(1.0).unwrap().position.y.abs() < 1e-9);
    world.start(Purpose::Static).unwrap();
    assert!(world.cables()[0].sample(1.0).unwrap().position.y < -0.4);
}

#[test]
fn an_anchor_elsewhere_is_reached_through_equilibrium() {
    let scene = read("catenary", &["attachment.right.anchor=[2.5, 0.0, 0.0]"], Purpose::Run);
    let mut world = World::build(&scene).unwrap();
    world.start(Purpose::Run).unwrap();
    assert_relative_eq!(world.cables()[0].sample(3.0).unwrap().position.x, 2.5, epsilon = 1e-12);
}

#[test]
fn a_rigid_start_has_the_energy_and_momentum_of_a_rigid_body() {
    let overrides = ["gravity=[0,0,0]", "cable.pendulum.angular_velocity=[0,0,3]", "duration=0.1"];
    let scene = read("falling_pendulum", &overrides, Purpose::Run);
    let mut world = World::build(&scene).unwrap();
    world.start(Purpose::Run).unwrap();
    // a rod of 0.8 kg and 2 m about its end; the model has no rotational inertia of sections
    let inertia = 0.8 * 4.0 / 3.0;
    assert_relative_eq!(world.energy(None).kinetic, 0.5 * inertia * 9.0, max_relative = 1e-9);
    assert_relative_eq!(world.momentum(None).angular.z, inertia * 3.0, max_relative = 1e-9);
}

#[test]
fn numbers_read_back_to_the_same_f64() {
    let scene = read("falling_pendulum", &["duration=0.3", "cable.pendulum.elements=4"], Purpose::Run);
    let folder = tempfile::tempdir().unwrap();
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    let mut world = World::build(&scene).unwrap();
    world.start(Purpose::Run).unwrap();
    for row in rows(&folder.path().join("probes/middle.csv")) {
        world.advance(row[0]).unwrap();
        let sample = world.cables()[0].sample(1.0).unwrap();
        let (p, v, s) = (sample.position, sample.velocity, sample.slope);
        let expected = [p.x, p.y, p.z, v.x, v.y, v.z, s.x, s.y, s.z, sample.tension];
        // the run also reads reactions, which must not disturb it
        assert_eq!(row[1..11], expected, "t = {}", row[0]);
    }
}
