//! Meshes that are too coarse, and those that are not.

use crate::warned;
use lariat_ancf::Warning as CableWarning;
use lariat_scene::{Purpose, Warning};
use std::path::Path;

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
        let mut coarse = warned(&wire(n), Purpose::Run);
        // its load is inside an element, which bends the wire less than a node there would
        coarse.retain(|warning| !matches!(warning, Warning::Cable(CableWarning::CoarseMoment { .. })));
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
