//! `--error tension=1%`, `--error moment=5%`: the true error is at most the claimed one.

use lariat_ancf::study::{Claim, ForceClaim, Outcome, Quantity, Target};
use lariat_scene::run::{Options, Recording, collect};
use lariat_scene::scene::elements::{Fine, Grading};
use lariat_scene::{Error, Purpose, Scene, Warning};
use std::path::Path;

fn shipped(name: &str, overrides: &[&str], purpose: Purpose) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.toml"));
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::read(&file, &overrides, purpose).unwrap()
}

fn parse(text: &str, purpose: Purpose) -> Scene {
    Scene::parse("scene.toml", text, &[], purpose).unwrap()
}

fn run(scene: &Scene, purpose: Purpose, error: Option<Target>) -> Recording {
    let run = collect(scene, purpose, &mut Options { error, ..Options::default() }).unwrap();
    assert!(run.failed.is_none(), "{:?}", run.failed);
    run
}

fn asked(text: &str) -> Target {
    text.parse().unwrap()
}

fn claim(run: &Recording) -> (&Claim, &ForceClaim) {
    let claim = &run.summary.error.as_ref().unwrap().claim;
    (claim, claim.forces.as_ref().unwrap())
}

/// Magnitudes of a column of a probe.
fn column(run: &Recording, probe: &str, name: &str) -> Vec<f64> {
    let probe = run.probes.iter().find(|p| p.name == probe).unwrap();
    let k = probe.columns.iter().position(|column| *column == name).unwrap();
    probe.rows.chunks(probe.columns.len()).map(|row| row[k].abs()).collect()
}

/// Prints and checks one claim against a true error, and returns the ratio of both.
fn check(what: &str, (claim, forces): (&Claim, &ForceClaim), off: f64) -> f64 {
    let claimed = forces.claimed.unwrap_or_else(|| panic!("{what}: {claim:?}"));
    println!(
        "{what}: asked {:.1e}, claimed {claimed:.1e}, true {off:.1e}, {} elements, {} runs, cost {:.1}",
        forces.asked, claim.elements, claim.runs, claim.cost
    );
    assert!(claim.outcome == Outcome::Proven && claimed <= forces.asked);
    assert!(off <= 3.0 * claimed, "{what}: {off} {claim:?}");
    claimed / off
}

/// The scene of a claim on a mesh that is finer everywhere, with a tolerance that is tighter.
fn finer(scene: &Scene, run: &Recording, times: usize, tighter: f64, coupled: bool) -> Scene {
    let (claim, _) = claim(run);
    let mut scene = scene.clone();
    for cable in &mut scene.cables {
        let there = run.world.cables();
        let own = there.iter().find(|own| own.name() == cable.name).unwrap();
        let lengths = own.elements().iter().map(|element| element.length);
        let (least, most) = lengths.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        cable.elements = times * own.elements().len();
        cable.nodes_at_loads = true;
        if most > 1.5 * least {
            let mut points = vec![0.0, own.length()];
            points.extend(scene.loads.iter().map(|load| load.load.arc_length));
            points.extend(scene.attachments.iter().map(|attachment| attachment.arc_length));
            cable.fine = Fine::At(Grading { finest: least / times as f64, points });
        }
        if let Some(tolerance) = claim.tolerance_m {
            let resolution =
                lariat_ancf::study::Resolution { tolerance: Some(tolerance / tighter), coupled, ..Default::default() };
            cable.integrator = resolution.integrator().into();
        }
    }
    scene
}

fn taut(length: f64, tension: f64, (axial, bending, mass): (f64, f64, f64)) -> String {
    let own = length / (1.0 + tension / axial);
    let mut text = format!(
        "[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [{length:?}, 0.0, 0.0]]\nlength = {own:?}\naxial_stiffness = {axial:?}\n\
         bending_stiffness = {bending:?}\nmass_per_length = {mass:?}\n"
    );
    for at in ["start", "end"] {
        text += &format!("[[attachment]]\ncable = \"line\"\nat = \"{at}\"\nbody = \"world\"\nkind = \"clamp\"\n");
        text += &format!("[[probe]]\nname = \"{at}\"\ncable = \"line\"\nat = \"{at}\"\n");
    }
    text + "[[probe]]\nname = \"middle\"\ncable = \"line\"\nat = \"50 %\"\n"
}

/// *Source.* Analytic: EI y'''' - T y'' = -w between level clamps. Wanted: 2 % with at most 30 elements.
#[test]
fn the_moment_of_a_taut_cable_is_that_of_the_beam() {
    let spans = [(20.0, 13.5e3, (1e8, 10.0, 2.0)), (50.0, 103e3, (4e8, 1000.0, 8.0))];
    for (length, tension, section) in spans {
        let scene = parse(&taut(length, tension, section), Purpose::Static);
        for target in ["moment=10%", "moment=5%", "moment=2%", "moment=0.5%"] {
            let run = run(&scene, Purpose::Static, Some(asked(target)));
            let carried = column(&run, "middle", "tension")[0];
            let k = (carried / section.1).sqrt();
            let half = 0.5 * k * length;
            let expected = 9.81 * section.2 * length / (2.0 * k) * (1.0 / half.tanh() - 1.0 / half);
            let read = column(&run, "start", "moment")[0];
            check(&format!("{length} m {target}"), claim(&run), (read / expected - 1.0).abs());
        }
    }
}

/// A pinned cable with a force amid it.
///
/// *Source.* Analytic: M = P sqrt(EI/T)/2 tanh(L sqrt(T/EI)/2).
#[test]
fn the_moment_at_a_load_is_that_of_the_beam() {
    let (length, force) = (20.0, 200.0);
    let text = taut(length, 13.5e3, (1e8, 10.0, 1e-6)).replace("kind = \"clamp\"\n", "")
        + &format!(
            "[[load]]\ncable = \"line\"\nat = {:?}\nforce = [0.0, {:?}, 0.0]\n",
            0.5 * length / (1.0 + 13.5e-5),
            -force
        );
    let scene = parse(&text, Purpose::Static);
    for target in ["moment=10%", "moment=2%", "moment=0.05Nm"] {
        let run = run(&scene, Purpose::Static, Some(asked(target)));
        let tension = column(&run, "start", "tension")[0];
        let k = (tension / 10.0).sqrt();
        let expected = force / (2.0 * k) * (0.5 * k * length).tanh();
        let off = (column(&run, "middle", "moment")[0] - expected).abs();
        let off = if asked(target).relative { off / expected } else { off };
        check(target, claim(&run), off);
    }
}

/// *Source.* Mattiasson 1981: P L^2/EI = 10, the tip is at x = 0.4450044622462449 of the length, which is the lever of the force.
#[test]
fn the_moment_of_the_elastica_is_that_of_elliptic_integrals() {
    let scene = shipped("elastica", &[], Purpose::Static);
    let probes = "[[probe]]\nname = \"wall\"\ncable = \"force\"\nat = \"start\"\n";
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/elastica.toml"))
        .unwrap();
    let scene = Scene { probes: parse(&(text + probes), Purpose::Static).probes, ..scene };
    for target in ["moment=5%", "moment=1%", "moment=0.1%", "tension=1%"] {
        let run = run(&scene, Purpose::Static, Some(asked(target)));
        let off = match asked(target).quantity {
            Quantity::Moment => (column(&run, "wall", "moment")[0] / 4.450044622462449 - 1.0).abs(),
            // the force is across the cable at the wall, and the largest tension is near the tip
            _ => column(&run, "wall", "tension")[0] / 10.0,
        };
        check(target, claim(&run), off);
    }
}

/// A slack cable with a little stiffness between level clamps, drawn in an arc.
///
/// *Source.* The same scene with three times as many elements, everywhere.
#[test]
fn the_claims_for_a_catenary_with_stiffness_near_its_clamps_hold() {
    for (bending, target) in
        [(10.0, "moment=5%"), (10.0, "moment=1%"), (0.3, "moment=5%"), (10.0, "tension=1%"), (10.0, "tension=0.1%")]
    {
        let text = taut(10.0, 0.0, (1e7, bending, 2.0)).replace("length = 10.0", "length = 11.0");
        // what the strain of an element shows between its nodes needs finer meshes than what nodes carry
        let text = &text[..text.rfind("[[probe]]").unwrap()];
        let scene = parse(text, Purpose::Static);
        let run = run(&scene, Purpose::Static, Some(asked(target)));
        let there = self::run(&finer(&scene, &run, 3, 1.0, false), Purpose::Static, None);
        let name = if asked(target).quantity == Quantity::Moment { "moment" } else { "tension" };
        let largest = there.world.cables()[0].peak_tension().1;
        let off = ["start", "end"].map(|probe| {
            let [a, b] = [&run, &there].map(|run| column(run, probe, name)[0]);
            (a - b).abs() / if name == "moment" { b } else { largest }
        });
        check(&format!("EI {bending} {target}"), claim(&run), off[0].max(off[1]));
    }
}

/// Largest difference of a column of two runs over the largest value.
fn apart(a: &Recording, b: &Recording, probes: &[&str], name: &str) -> f64 {
    let (mut off, mut largest): (f64, f64) = (0.0, 0.0);
    for probe in probes {
        let [a, b] = [a, b].map(|run| column(run, probe, name));
        assert_eq!(a.len(), b.len());
        off = a.iter().zip(&b).fold(off, |off, (a, b)| off.max((a - b).abs()));
        largest = b.iter().fold(largest, |largest, b| largest.max(*b));
    }
    off / largest
}

/// *Source.* The same scene with twice as many elements and a tolerance of a tenth.
#[test]
fn the_claims_for_motions_hold() {
    let probe = |at: &str| format!("[[probe]]\nname = \"{at}\"\ncable = \"line\"\nat = \"{at}\"\n");
    let hung = |rest: &str| {
        format!("duration = 1.0\ndt = 0.01\n[[cable]]\nname = \"line\"\n{rest}{}{}", probe("start"), probe("end"))
    };
    let pin = |at: &str| format!("[[attachment]]\ncable = \"line\"\nat = \"{at}\"\nbody = \"world\"\n");
    let pendulum = hung(&format!(
        "points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nsection = {{ square = 0.01 }}\ndensity = 4000.0\nyoungs_modulus = 1e7\n{}",
        pin("start")
    ));
    let plucked = hung(&format!(
        "points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\npretension = 200.0\naxial_stiffness = 1e5\nbending_stiffness = 0.01\nmass_per_length = 0.1\n{}{}\
         [[load]]\ncable = \"line\"\nat = 0.7\nforce = [0.0, 0.0, 20.0]\nramp = 0.2\n",
        pin("start"),
        pin("end")
    ));
    let rod = hung(
        "points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\naxial_stiffness = 1e5\nbending_stiffness = 3.0\nmass_per_length = 0.5\n\
         [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n",
    );
    let cases = [
        ("pendulum", &pendulum, "tension=5%"),
        ("pendulum", &pendulum, "tension=1%"),
        ("plucked string", &plucked, "tension=1%"),
        ("plucked string", &plucked, "tension=2N"),
        ("clamped rod", &rod, "moment=5%"),
        ("clamped rod", &rod, "moment=1%"),
        ("clamped rod", &rod, "tension=2%"),
    ];
    let mut ratios = Vec::new();
    for (what, text, target) in cases {
        let scene = parse(text, Purpose::Run);
        let run = run(&scene, Purpose::Run, Some(asked(target)));
        let there = self::run(&finer(&scene, &run, 2, 10.0, false), Purpose::Run, None);
        let name = if asked(target).quantity == Quantity::Moment { "moment" } else { "tension" };
        let off = apart(&run, &there, &["start", "end"], name);
        let largest = column(&there, "start", name).into_iter().fold(0.0, f64::max);
        let off = if asked(target).relative { off } else { off * largest };
        ratios.push(check(&format!("{what} {target}"), claim(&run), off));
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 2] < 10.0, "{ratios:?}");
}

/// *Source.* The same scene with twice as many elements and a tolerance of a tenth.
#[test]
fn the_claim_for_the_tension_of_a_swinging_payload_holds() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/payload_pendulum.toml");
    let text = std::fs::read_to_string(file).unwrap().replace("duration = 2.0", "duration = 0.6")
        + "[[probe]]\nname = \"start\"\ncable = \"sling\"\nat = \"start\"\n[[probe]]\nname = \"end\"\ncable = \"sling\"\nat = \"end\"\n";
    let scene = parse(&text, Purpose::Run);
    for target in ["tension=5%", "tension=1%"] {
        let run = run(&scene, Purpose::Run, Some(asked(target)));
        let there = self::run(&finer(&scene, &run, 2, 10.0, false), Purpose::Run, None);
        check(target, claim(&run), apart(&run, &there, &["start", "end"], "tension"));
    }
}

/// Mooring lines that lie on the seabed for a part: length, way out and up in m, mass per length in kg/m, EA in N. Two coarse meshes of one agree about
/// its tension by chance: no claim rests on them.
///
/// *Source.* The elastic catenary on a seabed without friction: `x = L - s + H L/EA + a asinh(s/a)`, `h = a (sqrt(1 + s^2/a^2) - 1) +
/// w s^2/(2 EA)`, a = H/w, s the length that hangs.
#[test]
fn the_claims_for_mooring_lines_on_a_seabed_hold() {
    for [length, out, up, mass, ea] in [
        [850.0, 780.0, 186.0, 113.35, 7.536e8],
        [130.0, 104.3, 48.9, 15.66, 7.6e7],
        [130.0, 110.0, 48.9, 15.66, 7.6e7],
        [300.0, 262.0, 80.0, 20.0, 1e8],
        [60.0, 47.0, 21.0, 5.0, 3e7],
    ] {
        let text = format!(
            "[[body]]\nname = \"bed\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\n[[cable]]\nname = \"line\"\npoints = \
             [[0.0, 0.05, 0.0], [{:?}, 0.05, 0.0], [{out:?}, {:?}, 0.0]]\nlength = {length:?}\naxial_stiffness = {ea:?}\nbending_stiffness = \
             0.0\nmass_per_length = {mass:?}\n[cable.contact]\nradius = 0.05\nfriction = 0.0\n[[attachment]]\ncable = \"line\"\nat = \
             \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n[[probe]]\nname = \"end\"\n\
             cable = \"line\"\nat = \"end\"\n",
            0.6 * out,
            up + 0.05
        );
        let w = mass * 9.81;
        let hanging = |h: f64| {
            let a = h / w;
            bisect(|s| a * ((1.0 + (s / a).powi(2)).sqrt() - 1.0) + w * s * s / (2.0 * ea) - up, [0.0, length])
        };
        let reach = |h: f64| {
            let (s, a) = (hanging(h), h / w);
            length - s + length * h / ea + a * (s / a).asinh() - out
        };
        let h = bisect(reach, [1.0, 1e7]);
        let expected = h.hypot(w * hanging(h));
        for target in ["tension=5%", "tension=1%", "tension=0.2%", "tension=0.1%", "tension=500N"] {
            let run = run(&parse(&text, Purpose::Static), Purpose::Static, Some(asked(target)));
            let off = (column(&run, "end", "tension")[0] - expected).abs();
            let off = if asked(target).relative { off / expected } else { off };
            let ratio = check(&format!("{length} m, {target}"), claim(&run), off);
            assert!(ratio >= 1.0, "{length} m, {target}: {ratio}");
        }
    }
}

/// Returns where a function that grows is zero.
fn bisect(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// What is beyond the numbers is refused before anything runs, by its own unit; what no mesh reaches is a warning.
#[test]
fn what_cannot_be_reached_is_told() {
    let scene = shipped("payload_pendulum", &["duration=0.1"], Purpose::Run);
    let options = &mut Options { error: Some(asked("tension=1e-7%")), ..Options::default() };
    match collect(&scene, Purpose::Run, options) {
        Err(error @ Error::ErrorTooSmall { .. }) => {
            assert!(error.to_string().contains("of the largest") && error.exit_code() == 2, "{error}");
        }
        other => panic!("{:?}", other.err()),
    }
    for text in ["tension", "tension=", "tension=1", "moment=2N", "moment=%", "strain=1%"] {
        assert!(text.parse::<Target>().is_err(), "{text}");
    }
    assert_eq!(asked("tension = 50 N"), Target::absolute(Quantity::Tension, 50.0));
    let chaos = shipped("falling_pendulum", &["duration=5.0"], Purpose::Run);
    let run = run(&chaos, Purpose::Run, Some(asked("tension=1%")));
    let (claim, forces) = claim(&run);
    assert!(claim.outcome != Outcome::Proven && forces.claimed.is_none() && claim.horizon_s.is_some(), "{claim:?}");
    assert!(run.summary.warnings.iter().any(|warning| matches!(warning, Warning::ForcesNotProven { .. })));
}
