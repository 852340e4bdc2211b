//! Warnings: each kind where it is due, none in the scenes of assets/scenes that are resolved.

use lariat_ancf::{Vector3, Warning as CableWarning};
use lariat_scene::run::{self, Options, Summary};
use lariat_scene::{Error, Purpose, Scene, Warning};
use nalgebra::Rotation3;
use std::path::Path;

/// The generator of Knuth's MMIX, in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Runs or settles a scene; returns its warnings as told while it ran.
fn warned(text: &str, purpose: Purpose) -> Vec<Warning> {
    let scene = Scene::parse("scene.toml", text, &[], purpose).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let folder = tempfile::tempdir().unwrap();
    let mut told = Vec::new();
    let mut warn = |warning: &Warning| told.push(warning.clone());
    let mut options = Options { warn: Some(&mut warn), ..Options::default() };
    let outcome: Result<Summary, Error> = match purpose {
        Purpose::Run => run::run(&scene, folder.path(), &mut options),
        Purpose::Static => run::statics(&scene, folder.path(), &mut options),
    };
    let json = std::fs::read_to_string(folder.path().join("summary.json")).unwrap();
    let summary: Summary = serde_json::from_str(&json).unwrap();
    // a run that fails tells and writes them, too
    assert_eq!(summary.warnings, told, "{:?}", outcome.err());
    let texts: serde_json::Value = serde_json::from_str(&json).unwrap();
    for (warning, written) in told.iter().zip(texts["warnings"].as_array().unwrap()) {
        assert_eq!(written["text"].as_str(), Some(warning.to_string().as_str()));
        assert!(written["kind"].is_string(), "{written}");
    }
    told
}

/// A pendulum of a wire and a bob, `angle` rad from the vertical: wire `[length m, diameter m, E Pa]`.
fn pendulum([length, diameter, modulus]: [f64; 3], mass: f64, angle: f64, end: &str) -> String {
    let (x, y) = (length * angle.sin(), -length * angle.cos());
    format!(
        "duration = 0.2\n[[body]]\nname = \"bob\"\nshape = {{ ball = 0.05 }}\nmass = {mass}\nposition = [{x:?}, {y:?}, 0.0]\n\
         [[cable]]\nname = \"wire\"\npoints = [[0.0, 0.0, 0.0], [{x:?}, {y:?}, 0.0]]\nsection = {{ round = {diameter:?} }}\n\
         density = 7850.0\nyoungs_modulus = {modulus:?}\n[[attachment]]\ncable = \"wire\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\ncable = \"wire\"\nat = \"end\"\nbody = \"{end}\"\n"
    )
}

#[test]
fn a_pendulum_in_si_units_has_no_warning() {
    for (wire, mass) in [([5.0, 0.004, 2.1e11], 20.0), ([1.0, 0.002, 1.0e11], 3.0), ([30.0, 0.02, 1.0e9], 100.0)] {
        assert_eq!(warned(&pendulum(wire, mass, 0.1, "bob"), Purpose::Run), [], "{wire:?}");
        assert_eq!(warned(&pendulum(wire, mass, 0.1, "bob"), Purpose::Static), [], "{wire:?}");
    }
}

#[test]
fn a_modulus_in_gpa_is_told() {
    for (modulus, mass) in [(210.0, 20.0), (70.0, 0.5), (3.5, 1.0)] {
        let warnings = warned(&pendulum([3.0, 0.004, modulus], mass, 0.1, "bob"), Purpose::Run);
        let soft = CableWarning::SoftMaterial { cable: "wire".to_string(), youngs_modulus_pa: modulus }.into();
        assert!(warnings.contains(&soft), "{warnings:?}");
        assert!(warnings[0].to_string().contains("in Pa"), "{}", warnings[0]);
    }
}

/// In MPa the modulus of steel is one of a soft rubber: the strain tells.
#[test]
fn a_tension_beyond_the_law_is_told_in_runs_and_in_statics() {
    let beyond = |text: &str, purpose| {
        let warnings = warned(text, purpose);
        let found = warnings.iter().any(|w| {
            matches!(w, Warning::Cable(CableWarning::LargeStrain { cable, tension_n, axial_stiffness_n, .. })
                if cable == "wire" && *tension_n > 0.05 * axial_stiffness_n)
        });
        assert!(found, "{purpose:?} {warnings:?}");
    };
    for (modulus, mass) in [(2.1e5, 2.0), (1.0e6, 10.0), (1.0e7, 5.0)] {
        beyond(&pendulum([2.0, 0.006, modulus], mass, 0.0, "bob"), Purpose::Run);
    }
    // T/EA = 0.08 to 0.4
    for (modulus, mass) in [(2.0e7, 4.0), (5.0e6, 2.0), (5.0e6, 5.0)] {
        beyond(&pendulum([2.0, 0.006, modulus], mass, 0.0, "bob"), Purpose::Static);
    }
    // T/EA = 0.04 at rest
    let area = std::f64::consts::FRAC_PI_4 * 0.006f64.powi(2);
    let below = pendulum([2.0, 0.006, 1.0 * 9.81 / 0.04 / area], 1.0 - 0.5 * 2.0 * 7850.0 * area, 0.0, "bob");
    assert_eq!(warned(&below, Purpose::Static), []);
}

#[test]
fn a_section_in_mm_is_told() {
    for (length, diameter) in [(5.0, 4.0), (0.3, 2.0), (2.0, 0.5)] {
        let warnings = warned(&pendulum([length, diameter, 2.1e11], 20.0, 0.1, "bob"), Purpose::Run);
        let stubby = |w: &Warning| matches!(w, Warning::Cable(CableWarning::Stubby { ratio, .. }) if (ratio * diameter / length - 1.0).abs() < 1e-12);
        assert!(warnings.iter().any(stubby), "{warnings:?}");
    }
    let long = warned(&pendulum([60.0, 4.0, 2.1e11], 20.0, 0.1, "bob"), Purpose::Run);
    assert!(long.contains(&CableWarning::Thick { cable: "wire".to_string(), diameter_m: 4.0 }.into()), "{long:?}");
    // by its stiffnesses, a round rod of 0.1 m
    let rod = "[[cable]]\nname = \"rod\"\npoints = [[0.0, 0.0, 9.0], [0.8, 0.0, 9.0]]\naxial_stiffness = 1.0e8\n\
               bending_stiffness = 6.25e4\nmass_per_length = 60.0\n[[attachment]]\ncable = \"rod\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n";
    let warnings = warned(&format!("duration = 0.02\n{rod}"), Purpose::Run);
    assert!(
        matches!(&warnings[..], [Warning::Cable(CableWarning::Stubby { ratio, .. })] if (ratio - 8.0).abs() < 1e-9),
        "{warnings:?}"
    );
}

#[test]
fn a_body_that_nothing_holds_is_told() {
    let wire = [5.0, 0.004, 2.1e11];
    let falls = |text: &str| {
        let warnings = warned(text, Purpose::Run);
        warnings.iter().any(|w| matches!(w, Warning::FallsFreely { body, .. } if body == "bob"))
    };
    for mass in [0.3, 20.0, 1000.0] {
        assert!(falls(&pendulum(wire, mass, 0.1, "world")));
    }
    let loose = pendulum(wire, 2.0, 0.5, "world");
    // a floor below, an upward force, a joint, or no gravity
    let floor = "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = { plane = [0.0, 1.0, 0.0] }\nposition = [0.0, -6.0, 0.0]\n";
    let table = "[[body]]\nname = \"table\"\nkind = \"fixed\"\nshape = { cuboid = [4.0, 0.1, 4.0] }\nposition = [0.0, -7.0, 0.0]\n";
    let lift = "[[load]]\nbody = \"bob\"\nforce = [0.0, 20.0, 0.0]\n";
    let hinge = "[[joint]]\nkind = \"ball\"\nbody = \"bob\"\nto = \"world\"\nat = [0.0, -3.0, 0.0]\n";
    for rest in [floor, table, lift, hinge] {
        assert!(!falls(&(loose.clone() + rest)), "{rest}");
    }
    assert!(!falls(&format!("gravity = [0.0, 0.0, 0.0]\n{loose}")));
    assert!(falls(&(loose.clone() + &table.replace("-7.0", "7.0"))), "a table above stops nothing");
    // two bodies tied to each other alone
    let pair = "[[body]]\nname = \"other\"\nshape = { ball = 0.05 }\nmass = 1.0\nposition = [9.0, 0.0, 0.0]\n\
                [[joint]]\nkind = \"ball\"\nbody = \"bob\"\nto = \"other\"\nat = [5.0, 0.0, 0.0]\n";
    assert!(falls(&(loose + pair)));
}

/// A load carries a body if its upward part is at least the weight; drag in a fluid at rest carries nothing.
///
/// *Source.* Newton's second law: fall = (g - F/m) t^2/2.
#[test]
fn a_body_whose_loads_carry_less_than_its_weight_is_told() {
    let loose = pendulum([5.0, 0.004, 2.1e11], 2.0, 0.5, "world");
    for (force, share) in [([5.0, 0.0, 0.0], 1.0), ([0.0, 9.81, 3.0], 0.5), ([0.0, -19.62, 0.0], 2.0)] {
        let text = format!("{loose}[[load]]\nbody = \"bob\"\nforce = {force:?}\n");
        let warnings = warned(&text, Purpose::Run);
        let expected = 0.5 * 9.81 * 0.04 * share;
        let told =
            |w: &Warning| matches!(w, Warning::FallsFreely { fall_m, .. } if (fall_m / expected - 1.0).abs() < 1e-9);
        assert!(warnings.iter().any(told), "{force:?} {warnings:?}");
    }
    let hung = "duration = 0.1\n[[body]]\nname = \"bob\"\nshape = { ball = 0.05 }\nmass = 1.0\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, \
                0.0], [0.0, 1.0, 0.0]]\naxial_stiffness = 1e5\nbending_stiffness = 0.1\nmass_per_length = 0.1\nDRAG\n[[attachment]]\ncable = \
                \"line\"\nat = \"start\"\nbody = \"bob\"\n";
    let still = "drag = { fluid_density = 1.2, diameter = 0.01 }";
    for (drag, due) in
        [(still, true), ("drag = { fluid_density = 1.2, diameter = 0.01, flow = [0.0, 9.0, 0.0] }", false)]
    {
        let warnings = warned(&hung.replace("DRAG", drag), Purpose::Run);
        assert_eq!(warnings.iter().any(|w| matches!(w, Warning::FallsFreely { .. })), due, "{drag}");
    }
}

/// Densities in g/cm^3, of which some are slow enough; densities of real cables are not told.
#[test]
fn a_density_in_grams_per_cubic_centimetre_is_told() {
    let line = |density: f64, modulus: f64| {
        format!(
            "duration = 0.02\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]\nsection = {{ round = 0.01 }}\ndensity = {density:?}\n\
             youngs_modulus = {modulus:?}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n"
        )
    };
    for (density, modulus) in [(7.85, 2.1e11), (1.15, 3e9), (0.9, 1e9), (2.7, 7e10), (1.1, 5e6), (19.3, 4.1e11)] {
        let light = |text: &str| {
            let warnings = warned(text, Purpose::Run);
            warnings.iter().any(|w| matches!(w, Warning::Cable(CableWarning::LightMaterial { density_kg_m3, .. }) if (density_kg_m3 / density - 1.0).abs() < 1e-9))
        };
        assert!(light(&line(density, modulus)), "{density}");
        let heavy = warned(&line(1000.0 * density, modulus), Purpose::Run);
        let told = |w: &Warning| matches!(w, Warning::Cable(CableWarning::LightMaterial { .. }));
        assert!(!heavy.iter().any(told), "{density} {heavy:?}");
    }
}

#[test]
fn loads_that_a_run_does_not_see_are_told() {
    let beam = |load: &str| {
        format!(
            "duration = 0.1\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"beam\"\npoints = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]]\naxial_stiffness = 1e6\n\
             bending_stiffness = 50.0\nmass_per_length = 0.5\n[[attachment]]\ncable = \"beam\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n\
             [[load]]\ncable = \"beam\"\nat = \"end\"\n{load}\n"
        )
    };
    let ramp = warned(&beam("force = [1.0, 0.0, 0.0]\nramp = 5.0"), Purpose::Run);
    assert!(matches!(&ramp[..], [Warning::UnfinishedRamp { on, ramp_s: 5.0, .. }] if on == "beam"), "{ramp:?}");
    assert!(ramp[0].to_string().contains("2 %"), "{}", ramp[0]);
    let along = warned(&beam("moment = [0.0, -2.0, 0.5]"), Purpose::Run);
    assert!(along.iter().any(|w| matches!(w, Warning::MomentAlong { part_nm: 2.0, at_m: 2.0, .. })), "{along:?}");
    for well in ["force = [1.0, 0.0, 0.0]\nramp = 0.1", "moment = [0.5, 0.0, 0.5]"] {
        let told = |w: &Warning| matches!(w, Warning::UnfinishedRamp { .. } | Warning::MomentAlong { .. });
        let warnings = warned(&beam(well), Purpose::Run);
        assert!(!warnings.iter().any(told), "{well} {warnings:?}");
    }
}

/// A cable that statics let hang through a body that it is not attached to.
#[test]
fn statics_through_a_body_are_told() {
    let text = |height: f64| {
        format!(
            "[[body]]\nname = \"beam\"\nkind = \"fixed\"\nshape = {{ cuboid = [3.0, 0.3, 0.3] }}\nposition = [1.0, {height:?}, 0.0]\n[[cable]]\nname = \
             \"line\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nlength = 3.0\naxial_stiffness = 1e6\nbending_stiffness = 0.1\nmass_per_length = 0.5\n\
             [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n"
        )
    };
    let through = warned(&text(-1.0), Purpose::Static);
    assert!(matches!(&through[..], [Warning::PassesThrough { body, .. }] if body == "beam"), "{through:?}");
    assert_eq!(warned(&text(-2.0), Purpose::Static), []);
}

#[test]
fn a_cable_through_a_body_is_told() {
    let text = pendulum([5.0, 0.004, 2.1e11], 20.0, 0.0, "bob");
    let block = |x: f64| {
        format!(
            "{text}[[body]]\nname = \"block\"\nkind = \"fixed\"\nshape = {{ cuboid = [0.3, 0.3, 0.3] }}\nposition = [{x:?}, -2.5, 0.0]\n"
        )
    };
    let warnings = warned(&block(0.1), Purpose::Run);
    assert!(
        matches!(&warnings[..], [Warning::StartsInside { body, at_m, depth_m, .. }]
            if body == "block" && (at_m - 2.5).abs() < 1e-9 && (depth_m - 0.2).abs() < 1e-5),
        "{warnings:?}"
    );
    assert_eq!(warned(&block(0.4), Purpose::Run), []);
}

/// Depth in m of a point in a shape of the kinds of scene files, in the axes of the shape; negative outside, and then no distance.
///
/// *Source.* The definitions of the shapes.
fn depth(kind: usize, [a, b, c]: [f64; 3], x: Vector3<f64>) -> f64 {
    let across = x.x.hypot(x.z);
    match kind {
        0 | 4 => (a - x.x.abs()).min(b - x.y.abs()).min(c - x.z.abs()),
        1 => a - x.norm(),
        2 => (a - x.y.abs()).min(b - across),
        3 => b - across.hypot((x.y.abs() - a).max(0.0)),
        _ => -x.y,
    }
}

/// Bodies of all shapes, turned and beside a straight cable or on it, thin and thick: those that the cable runs through are told, those
/// that it passes by are not.
#[test]
fn bodies_of_all_shapes_that_a_cable_runs_through_are_told_and_only_those() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(3);
    let (mut through, mut by) = ([0; 6], [0; 6]);
    for case in 0..240 {
        let kind = case % 6;
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * (2.0 * random.next() - 1.0));
        let (turn, way) = (vector(3.0), vector(1.0).normalize());
        let [a, b, c] = [(); 3].map(|()| 0.02 * 30f64.powf(random.next()));
        // plates from a tenth of a millimetre
        let a = if kind == 0 && case % 4 == 0 { 1e-4 * 50f64.powf(random.next()) } else { a };
        let along = way * (4.0 * random.next());
        let beside = way.cross(&turn).normalize() * (random.next() * 1.5 * a.max(b).max(c));
        let rotation = Rotation3::from_scaled_axis(turn);
        // half of the planes below the cable
        let below = if kind == 5 && case % 4 == 1 { rotation * Vector3::y() * -4.5 } else { Vector3::zeros() };
        let center = along + beside + below;
        let shape = match kind {
            0 => format!("cuboid = [{a:?}, {b:?}, {c:?}]"),
            1 => format!("ball = {a:?}"),
            2 => format!("cylinder = [{a:?}, {b:?}]"),
            3 => format!("capsule = [{a:?}, {b:?}]"),
            4 => {
                let corner =
                    |k: u32| [a, b, c].iter().zip(0..3).map(|(x, i)| if k >> i & 1 == 1 { *x } else { -x }).collect();
                let corners: Vec<Vec<f64>> = (0..8).map(corner).collect();
                let mut obj: String = corners.iter().map(|x| format!("v {:?} {:?} {:?}\n", x[0], x[1], x[2])).collect();
                obj += "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
                std::fs::write(folder.path().join("block.obj"), obj).unwrap();
                "mesh = \"block.obj\"".to_string()
            }
            _ => "plane = [0.0, 1.0, 0.0]".to_string(),
        };
        let end = way * 4.0;
        let text = format!(
            "duration = 0.01\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"block\"\nkind = \"fixed\"\nshape = {{ {shape} }}\n\
             position = {:?}\nrotation = {:?}\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], {:?}]\nsection = {{ round = 0.004 }}\n\
             density = 7850.0\nyoungs_modulus = 2.1e11\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n",
            <[f64; 3]>::from(center),
            <[f64; 3]>::from(turn),
            <[f64; 3]>::from(end)
        );
        let scene = Scene::parse(&folder.path().join("scene.toml").display().to_string(), &text, &[], Purpose::Run);
        let summary = run::collect(
            &scene.unwrap_or_else(|error| panic!("{error}\n{text}")),
            Purpose::Run,
            &mut Options::default(),
        );
        let told = summary.unwrap().summary.warnings;
        let is_told = told.iter().any(|w| matches!(w, Warning::StartsInside { body, .. } if body == "block"));
        let deepest = (0..=40_000)
            .map(|k| depth(kind, [a, b, c], rotation.inverse() * (end * (f64::from(k) / 40_000.0) - center)))
            .fold(f64::NEG_INFINITY, f64::max);
        // a plate that it enters by one face and leaves by the other
        let (from, along) = (rotation.inverse() * -center, rotation.inverse() * end);
        let crosses = |x: f64| {
            let share = (x - from.x) / along.x;
            let there = from + along * share;
            (0.0..1.0).contains(&share) && there.y.abs() < b && there.z.abs() < c
        };
        if deepest > 0.01 || kind == 0 && crosses(a) && crosses(-a) {
            through[kind] += 1;
            assert!(is_told, "{case}: {deepest} m in\n{text}");
        } else if deepest < 0.0 {
            by[kind] += 1;
            assert_eq!(told, [], "{case}: {deepest} m\n{text}");
        }
    }
    println!("through {through:?}, by {by:?}");
    assert!(through.iter().chain(&by).all(|count| *count >= 3), "{through:?} {by:?}");
}

fn asset(name: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.toml"));
    std::fs::read_to_string(file).unwrap()
}

/// A pendulum of two to four elements, a cantilever of one and of two, a catenary of three: after the advice has been followed at most twice
/// there is no warning, and no more elements than the scenes have.
///
/// *Source.* Independent measurement of errors on the coarse meshes: 0.11 L to 0.02 L, 0.21 L, 0.01 L and 0.02 L.
#[test]
fn coarse_meshes_are_told_and_the_advice_leads_to_one_that_does() {
    for (name, own, elements, purpose) in [
        ("falling_pendulum", 20, 2, Purpose::Run),
        ("falling_pendulum", 20, 3, Purpose::Run),
        ("falling_pendulum", 20, 4, Purpose::Run),
        ("cantilever", 10, 1, Purpose::Static),
        ("cantilever", 10, 2, Purpose::Static),
        ("catenary", 40, 3, Purpose::Static),
    ] {
        // the cantilever with P L^2/EI = 5
        let scene = asset(name).replace("force = [0.0, -2.0, 0.0]", "force = [0.0, -5.0, 0.0]");
        let text = |n: usize| scene.replace(&format!("elements = {own}"), &format!("elements = {n}"));
        let advice = |n: usize| match &warned(&text(n), purpose)[..] {
            [] => None,
            [Warning::Cable(CableWarning::CoarseMesh { enough, .. } | CableWarning::CoarseElement { enough, .. })] => {
                Some(*enough)
            }
            others => panic!("{name}, {n} elements: {others:?}"),
        };
        let first = advice(elements).unwrap_or_else(|| panic!("{name}, {elements} elements: no warning"));
        let second = advice(first).unwrap_or(first);
        println!("{name}: {elements} -> {first} -> {second}");
        assert!(elements < first && first <= second && second <= own, "{name}: {elements} -> {first} -> {second}");
        assert!(second == first || advice(second).is_none(), "{name} with {second} elements");
    }
}

/// A wire at rest on its clamps, plucked by less than a thousandth of its length: the error is a large share of the motion alone.
#[test]
fn a_small_motion_on_a_coarse_mesh_is_told() {
    let wire = |elements: usize| {
        format!(
            "duration = 0.05\ngravity = [0.0, 0.0, 0.0]\ndt = 0.0005\n[[cable]]\nname = \"wire\"\npoints = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\n\
             length = 0.999\nelements = {elements}\nsection = {{ round = 0.001 }}\ndensity = 7850.0\nyoungs_modulus = 2.0e11\n\
             [[attachment]]\ncable = \"wire\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"wire\"\nat = \"end\"\n\
             body = \"world\"\n[[load]]\ncable = \"wire\"\nat = 0.2\nforce = [0.0, 0.8, 0.0]\n"
        )
    };
    for n in [2, 4] {
        let coarse = warned(&wire(n), Purpose::Run);
        assert!(
            matches!(&coarse[..], [Warning::Cable(CableWarning::CoarseMotion { elements, .. })] if *elements == n),
            "{coarse:?}"
        );
    }
    assert_eq!(warned(&wire(30), Purpose::Run), []);
}

/// Of the scenes of assets/scenes, only the payload pendulum is too coarse.
///
/// *Source.* Independent measurement: after 2 s its box is 0.1 m elsewhere with 20 elements; in the other scenes the estimate is below 4e-4 of
/// the length.
#[test]
fn scenes_that_are_resolved_have_no_warning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let names: Vec<String> = files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_string()).collect();
    assert!(names.len() >= 16, "{names:?}");
    for name in names.iter().filter(|name| *name != "payload_pendulum") {
        assert_eq!(warned(&asset(name), Purpose::Run), [], "{name}");
    }
    for name in ["catenary", "cantilever", "bridge", "cable_stayed", "payload_pendulum"] {
        assert_eq!(warned(&asset(name), Purpose::Static), [], "{name}");
    }
    let payload = warned(&asset("payload_pendulum"), Purpose::Run);
    assert!(matches!(&payload[..], [Warning::Cable(CableWarning::CoarseMesh { elements: 10, .. })]), "{payload:?}");
}
