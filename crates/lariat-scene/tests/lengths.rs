//! Cables by tension or sag instead of a length, sections by name, and graded elements.

use lariat_ancf::Section;
use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

fn scene(rest: &str) -> String {
    format!(
        "name = \"line\"\nduration = 1.0\nengine = \"none\"\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]\n\
         elements = 20\n{rest}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n"
    )
}

fn parsed(rest: &str) -> Result<Scene, String> {
    Scene::parse("scene.toml", &scene(rest), &[], Purpose::Run).map_err(|error| error.to_string())
}

/// A line with a sag or a pretension has the length with which it hangs so.
///
/// *Source.* A shallow parabola: H = w L^2/(8 d), L = span (1 + 8/3 (d/span)^2)/(1 + H/EA), within
/// (d/span)^4 and the strain squared.
#[test]
fn a_sag_or_a_pretension_gives_the_length() {
    let section = "axial_stiffness = 2.0e6\nbending_stiffness = 0.0\nmass_per_length = 1.5\n";
    let (span, weight, sag) = (40.0f64, 1.5 * 9.81, 0.5f64);
    let force = weight * span * span / (8.0 * sag);
    let length = span * (1.0 + 8.0 / 3.0 * (sag / span).powi(2)) / (1.0 + force / 2e6);
    for rest in [format!("sag = {sag}\n"), format!("pretension = {force}\n")] {
        let found = parsed(&format!("{rest}{section}")).unwrap().cables[0].length;
        assert!((found / length - 1.0).abs() < 2e-5, "{rest}: {found} for {length}");
    }
    for (rest, name) in
        [("sag = 0.5\nlength = 41.0\n", "sag"), ("sag = 0.5\npretension = 9.0\n", "sag"), ("sag = 0.0\n", "sag")]
    {
        let error = parsed(&format!("{rest}{section}")).unwrap_err();
        assert!(error.contains(name), "{error}");
    }
}

/// A section by name has the numbers of its material, and no other.
///
/// *Source.* `RopeMaterial`, whose table has the sources.
#[test]
fn a_section_may_be_a_rope_or_a_chain_by_name() {
    for (name, mass) in
        [("chain", 200.1), ("nylon", 5.8515), ("polyester", 6.7875), ("hmpe", 4.9572), ("wire_rope", 40.9)]
    {
        let section = *parsed(&format!("section = {{ {name} = 0.1 }}\n")).unwrap().cables[0].sections.first();
        assert!((section.mass_per_length / mass - 1.0).abs() < 1e-9, "{name}: {section:?}");
    }
    for wrong in [
        "section = { chain = 0.1 }\ndensity = 7850.0\n",
        "section = { nylon = -0.1 }\n",
        "section = { chain = 20.0 }\n",
        "section = { chain = 0.1, nylon = 0.1 }\n",
        "section = { chian = 0.1 }\n",
    ] {
        assert!(parsed(wrong).is_err(), "{wrong}");
    }
}

/// A chain behind a rope hangs by its own weight and lengthens by its own stiffness, with kinks or
/// without; where it begins may be a share of the length.
///
/// *Source.* Statics and Hooke's law of both pieces; `RopeMaterial`.
#[test]
fn pieces_of_a_cable_have_their_own_sections() {
    let text = |from: &str, rest: &str| {
        format!(
            "name = \"line\"\nduration = 1.0\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [0.0, -100.0, 0.0]]\n\
             elements = 20\nsection = {{ polyester = 0.05 }}\n{rest}\n[[cable.piece]]\nfrom = {from}\nsection = {{ chain = 0.02 }}\n\
             [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n"
        )
    };
    let read = |from: &str, rest: &str| Scene::parse("scene.toml", &text(from, rest), &[], Purpose::Run).unwrap();
    let scene = read("70.0", "");
    assert_eq!(read("\"70 %\"", ""), scene);
    let mut cable = scene.build_cable(0).unwrap();
    assert!(cable.node_arc_lengths().contains(&70.0));
    cable.equilibrium().unwrap();
    let [rope, chain] = [10.0, 90.0].map(|s| *scene.cables[0].sections.at(s));
    let weight = |section: &Section, length: f64| 9.81 * section.mass_per_length * length;
    let (of_rope, of_chain) = (weight(&rope, 70.0), weight(&chain, 30.0));
    let tension = cable.sample(0.0).unwrap().tension;
    assert!((tension / (of_rope + of_chain) - 1.0).abs() < 1e-6, "{tension}");
    let longer =
        (of_chain + 0.5 * of_rope) * 70.0 / rope.axial_stiffness + 0.5 * of_chain * 30.0 / chain.axial_stiffness;
    let end = cable.node_position(cable.nodes() - 1);
    assert!((end.y + 100.0 + longer).abs() < 1e-4 * longer, "{end:?} {longer}");
    assert!((scene.cables[0].mass() * 9.81 / (of_rope + of_chain) - 1.0).abs() < 1e-12);

    let kinked = read("70.0", "kinks = [50.0, 80.0]");
    let starts = |part: usize| -> Vec<(f64, bool)> {
        kinked.cables[part].sections.iter().map(|(from, section)| (*from, *section == chain)).collect()
    };
    assert_eq!([0, 1, 2].map(starts), [vec![(0.0, false)], vec![(0.0, false), (20.0, true)], vec![(0.0, true)]]);
}

/// The sling of assets/scenes/chain_and_rope.toml carries at its hook what its page says, and stays
/// at rest.
///
/// *Source.* The weights of 6 m of rope and 4 m of chain, by `RopeMaterial`.
#[test]
fn the_sling_of_its_scene_carries_rope_and_chain() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/chain_and_rope.toml");
    let scene = Scene::read(&path, &[], Purpose::Run).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let summary = run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    let (of_rope, of_chain) = (9.81 * 6.0 * 6.7875 * 0.0256, 9.81 * 4.0 * 200.1 * 0.04);
    for (probe, tension) in [("hook", of_rope + of_chain), ("shackle", of_chain)] {
        let rows = std::fs::read_to_string(folder.path().join(format!("probes/{probe}.csv"))).unwrap();
        let column = rows.lines().next().unwrap().split(',').position(|name| name == "tension").unwrap();
        for row in rows.lines().skip(1) {
            let read: f64 = row.split(',').nth(column).unwrap().parse().unwrap();
            assert!((read / tension - 1.0).abs() < 2e-5, "{row} {tension}");
        }
    }
}

/// What a piece cannot be is refused by name: out of order, off the cable, with a sag, and with
/// numbers that follow from one section.
#[test]
fn pieces_without_a_meaning_are_refused() {
    let stiffness = "axial_stiffness = 2.0e6\nbending_stiffness = 0.1\nmass_per_length = 1.5\n";
    let piece = |from: &str| format!("[[cable.piece]]\nfrom = {from}\n{stiffness}");
    let own = "section = { round = 0.02 }\ndensity = 1000.0\nyoungs_modulus = 1e9\n";
    assert!(parsed(&format!("{own}{}{}", piece("10.0"), piece("20.0"))).is_ok());
    for (rest, says) in [
        (format!("{own}{}{}", piece("20.0"), piece("20.0")), "cable.line.piece.1.from"),
        (format!("{own}{}", piece("0.0")), "cable.line.piece.0.from"),
        (format!("{own}{}", piece("40.0")), "cable.line.piece.0.from"),
        (format!("{own}{}", piece("41.0")), "is not on the cable"),
        (format!("sag = 0.5\n{own}{}", piece("10.0")), "give the length"),
        (format!("{own}damping = {{ rope = \"wire-rope\" }}\n{}", piece("10.0")), "has several"),
        (format!("{own}torsion = {{ poisson = 0.3 }}\n{}", piece("10.0")), "has several"),
        (format!("{own}drag = {{ fluid_density = 1000.0 }}\n{}", piece("10.0")), "drag.diameter: missing"),
        (format!("{own}contact = {{}}\n{}", piece("10.0")), "contact.radius: missing"),
        (format!("{own}[[cable.piece]]\nfrom = 10.0\n"), "piece.0.section: missing"),
        (format!("{own}[[cable.piece]]\n{stiffness}"), "piece.0.from: missing"),
    ] {
        let error = parsed(&rest).unwrap_err();
        assert!(error.contains(says), "{rest}: {error}");
    }
    let sheave = format!(
        "{own}{}[[sheave]]\ncable = \"line\"\nat = 10.0\nbody = \"world\"\nanchor = [10.0, 0.0, 0.0]\n",
        piece("10.0")
    );
    let text = scene(&sheave).replace("engine = \"none\"\n", "");
    let error = Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap_err().to_string();
    assert!(error.contains("would run over it"), "{error}");
}

/// Elements grow from the points that are named, by default both ends; `--set` changes one number of them, and what
/// cannot be graded is refused.
#[test]
fn elements_may_be_fine_at_some_points() {
    let section = "axial_stiffness = 2.0e6\nbending_stiffness = 1.0\nmass_per_length = 1.5\n";
    let graded = |elements: &str, set: &[&str]| {
        let text = scene(section).replace("elements = 20", elements);
        let set: Vec<String> = set.iter().map(|x| x.to_string()).collect();
        Scene::parse("scene.toml", &text, &set, Purpose::Run).map_err(|error| error.to_string())
    };
    let lengths = |scene: &Scene| -> Vec<f64> {
        scene.build_cable(0).unwrap().elements().iter().map(|element| element.length).collect()
    };
    let both = lengths(&graded("elements = { count = 30, finest = 0.02 }", &[]).unwrap());
    assert_eq!(both.len(), 30);
    assert!((both[0] - 0.02).abs() < 1e-9 && (both[29] - 0.02).abs() < 1e-9, "{both:?}");
    let set = ["cable.line.elements.finest=0.05"];
    let coarser = lengths(&graded("elements = { count = 30, finest = 0.02 }", &set).unwrap());
    assert!((coarser[0] - 0.05).abs() < 1e-9, "{coarser:?}");
    let one = lengths(&graded("elements = { count = 30, finest = 0.02, at = [\"50 %\"] }", &[]).unwrap());
    let (first, middle) = (one[0], one[one.len() / 2]);
    assert!(middle < 0.021 && first > 3.0, "{one:?}");
    let reel = "elements = { count = 30, finest = 0.02 }\nreel = { end = \"end\", rate = [[0.0, 0.0]] }";
    let error = graded(reel, &[]).unwrap_err();
    assert!(error.contains("cable.line.elements.at") && error.contains("material runs"), "{error}");
    let start =
        "elements = { count = 30, finest = 0.02, at = [\"start\"] }\nreel = { end = \"end\", rate = [[0.0, 0.0]] }";
    assert!(graded(start, &[]).is_ok());
}

/// Whatever takes an arc length takes one that rounding put beyond an end, as that end, and none further away.
#[test]
fn a_point_that_rounding_put_beyond_the_end_is_the_end() {
    let text = |at: f64| {
        format!(
            "duration = 0.02\n[[cable]]\nname = \"a\"\npoints = [[0.0, 0.0, 0.0], [3.7, 0.0, 0.0]]\nelements = 4\n\
             axial_stiffness = 1e4\nbending_stiffness = 0.0\nmass_per_length = 0.1\n\
             [[cable]]\nname = \"b\"\npoints = [[0.0, 0.0, 2.0], [3.7, 0.0, 0.0]]\nlength = 4.5\nelements = 4\n\
             axial_stiffness = 1e4\nbending_stiffness = 0.0\nmass_per_length = 0.1\n\
             [[attachment]]\ncable = \"a\"\nat = 0.0\nbody = \"world\"\n\
             [[attachment]]\ncable = \"b\"\nat = 0.0\nbody = \"world\"\n\
             [[junction]]\ncable = \"a\"\nat = {at:?}\nother = \"b\"\nother_at = \"end\"\n\
             [[load]]\ncable = \"a\"\nat = {at:?}\nforce = [0.0, -1.0, 0.0]\n\
             [[probe]]\nname = \"p\"\ncable = \"a\"\nat = {at:?}\n"
        )
    };
    let run = |at: f64| {
        let scene = Scene::parse("ends.toml", &text(at), &[], Purpose::Run).map_err(|error| error.to_string())?;
        let recording =
            run::collect(&scene, Purpose::Run, &mut Options::default()).map_err(|error| error.to_string())?;
        assert!(recording.failed.is_none());
        Ok::<_, String>(recording.probes[0].rows.clone())
    };
    let at_end = run(3.7).unwrap();
    for share in [1e-15, 1e-12, 0.9e-9] {
        assert_eq!(run(3.7 * (1.0 + share)).unwrap(), at_end, "{share}");
        assert!(parsed_attachment(40.0 * (1.0 + share)).is_ok() && parsed_attachment(-40.0 * share).is_ok(), "{share}");
    }
    assert!(run(3.7 * (1.0 + 1e-8)).is_err() && parsed_attachment(40.0 * (1.0 + 1e-8)).is_err());
    assert!(parsed_attachment(-4e-7).is_err());
}

fn parsed_attachment(at: f64) -> Result<(), String> {
    let text = scene("axial_stiffness = 2.0e6\nbending_stiffness = 0.0\nmass_per_length = 1.5\n");
    let (before, _) = text.split_once("[[attachment]]").unwrap();
    let text = format!("{before}[[attachment]]\ncable = \"line\"\nat = {at:?}\nbody = \"world\"\n");
    let scene = Scene::parse("scene.toml", &text, &[], Purpose::Run).map_err(|error| error.to_string())?;
    assert!([0.0, 40.0].contains(&scene.attachments[0].arc_length));
    Ok(())
}

/// Line loads, pieces of a rest shape and sheaves stand at shares of the length, as attachments do.
///
/// *Source.* The same scene with the places in metres.
#[test]
fn places_may_be_shares_of_the_length() {
    let rest = |from: &str, middle: &str, to: &str| {
        format!(
            "length = 44.0\naxial_stiffness = 2.0e6\nbending_stiffness = 1.0\nmass_per_length = 1.5\n\
             [[cable.line_load]]\nfrom = {from}\nto = {to}\nforce = [0.0, 0.0, 1.0]\n\
             [[cable.rest_shape.piece]]\nfrom = 0.0\ncurvature = 0.0\n[[cable.rest_shape.piece]]\nfrom = {middle}\ncurvature = 0.1\n"
        )
    };
    let by_share = parsed(&rest("\"25 %\"", "\"50 %\"", "\"100 %\"")).unwrap();
    let by_length = parsed(&rest("11.0", "22.0", "44.0")).unwrap();
    assert_eq!(by_share.cables[0].effects, by_length.cables[0].effects);
    for (from, middle, to, named) in [
        ("\"-1 %\"", "22.0", "44.0", "from"),
        ("11.0", "\"100 %\"", "44.0", "from"),
        ("11.0", "22.0", "\"20 %\"", "to"),
    ] {
        let error = parsed(&rest(from, middle, to)).unwrap_err();
        assert!(error.contains(named), "{error}");
    }
    let over = |at: &str| {
        let points = "[[0.0, -2.0, 0.0], [0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]";
        let text = format!(
            "duration = 0.1\n[[cable]]\nname = \"rope\"\npoints = {points}\nelements = 12\naxial_stiffness = 1.0e5\nbending_stiffness = 0.0\n\
             mass_per_length = 0.02\n[[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\nanchor = [0.0, -2.0, 0.0]\n\
             [[sheave]]\ncable = \"rope\"\nat = {at}\nbody = \"world\"\nanchor = [0.0, 0.0, 0.0]\n"
        );
        Scene::parse("scene.toml", &text, &[], Purpose::Run).map_err(|error| error.to_string())
    };
    let lengths = |scene: Scene| scene.cables.iter().map(|cable| cable.length).collect::<Vec<_>>();
    assert_eq!(lengths(over("\"50 %\"").unwrap()), lengths(over("2.0").unwrap()));
    for wrong in ["0.0", "\"start\"", "\"100 %\"", "4.1"] {
        let error = over(wrong).unwrap_err();
        assert!(error.contains("sheave.0.at"), "{wrong}: {error}");
    }
}

/// Numbers with units are the numbers in SI units, in cables, bodies, loads and at the top, and from `--set`.
///
/// *Source.* The same scene in SI units.
#[test]
fn numbers_may_have_units() {
    let scene = |si: bool, sets: &[&str]| {
        let one = |number: f64, text: &str| if si { format!("{number:?}") } else { format!("{text:?}") };
        let text = format!(
            "duration = {}\ndt = {}\nengine = \"rapier\"\n[[body]]\nname = \"crate\"\nshape = {{ ball = {} }}\nmass = {}\nposition = [3.0, 0.0, 0.0]\n\
             [[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]\nlength = {}\nsection = {{ round = {} }}\ndensity = {}\n\
             youngs_modulus = {}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"line\"\nat = \"end\"\n\
             body = \"crate\"\n[[load]]\ncable = \"line\"\nat = {}\nforce = [0.0, -10.0, 0.0]\n",
            one(120.0, "2 min"),
            one(0.005, "5 ms"),
            one(0.25, "25 cm"),
            one(2000.0, "2 t"),
            one(3.1, "3100 mm"),
            one(0.012, "12 mm"),
            one(7850.0, "7.85 g/cm^3"),
            one(1e11, "100 GPa"),
            one(1.5, "1.5 m"),
        );
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        Scene::parse("scene.toml", &text, &sets, Purpose::Run)
    };
    let (si, units) = (scene(true, &[]).unwrap(), scene(false, &[]).unwrap());
    assert_eq!((si.duration, si.dt), (units.duration, units.dt));
    assert_eq!(format!("{:?}", si.bodies), format!("{:?}", units.bodies));
    let [a, b] = [&si, &units].map(|scene| (scene.cables[0].length, *scene.cables[0].sections.first()));
    assert!(
        (a.0 - b.0).abs() < 1e-14 && (a.1.axial_stiffness / b.1.axial_stiffness - 1.0).abs() < 1e-14,
        "{a:?} {b:?}"
    );
    assert!((a.1.mass_per_length / b.1.mass_per_length - 1.0).abs() < 1e-14);
    let set = scene(true, &["cable.line.length=\"320 cm\""]).unwrap();
    assert!((set.cables[0].length - 3.2).abs() < 1e-14);
    for (wrong, says) in [
        ("cable.line.length=\"3 kg\"", "\"3 kg\" is no number with one of the units m, µm, mm"),
        ("cable.line.length=\"-3 m\"", "-3 is out of range"),
        ("dt=\"5\"", "\"5\" is no number with one of the units s, ms"),
    ] {
        let error = scene(true, &[wrong]).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}
