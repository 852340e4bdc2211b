//! Invalid cables, and invalid keys of the scene itself.

use super::cases::{Case, all_are_accepted, all_are_errors, message};
use lariat_scene::{Purpose, Scene};

/// A valid scene, with its lines numbered from 1: [`GOOD`] plus the tail of each case, which starts on line 19.
const GOOD: &str = r#"name = "test"
duration = 1.0
dt = 0.01
gravity = [0.0, -9.81, 0.0]
engine = "none"
[[cable]]
name = "sling"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
length = 2.0
elements = 10
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
rule = "G5-3"
integrator = { tolerance = 1e-6 }
velocity = [0.0, 0.0, 0.0]
initial = "straight"
angular_velocity = [0.0, 0.0, 0.0]
"#;

const CASES: &[Case] = &[
    ("duration = 1.0", "duration = -1.0", 2, &["duration: -1 ", "> 0, in s"]),
    ("duration = 1.0", "duration = nan", 2, &["duration: NaN "]),
    ("duration = 1.0", "duration = \"long\"", 2, &["duration", "found the text \"long\"", "> 0, in s"]),
    ("duration = 1.0", "", 1, &["duration: missing key"]),
    ("dt = 0.01", "dt = 0.0", 3, &["dt: 0 "]),
    ("dt = 0.01", "dt = inf", 3, &["dt: inf "]),
    ("dt = 0.01", "dt = 1e-12", 3, &["dt: ", "steps", "at most 1e8"]),
    ("dt = 0.01", "dr = 0.01", 3, &["dr", "unknown key", "duration", "gravity", "Did you mean \"dt\"?"]),
    ("gravity = [0.0, -9.81, 0.0]", "gravity = [0.0, -9.81]", 4, &["gravity", "three finite numbers"]),
    ("gravity = [0.0, -9.81, 0.0]", "gravity = [0.0, nan, 0.0]", 4, &["gravity", "not finite"]),
    ("engine = \"none\"", "engine = \"box2d\"", 5, &["engine: unknown value \"box2d\"", "\"rapier\" | \"none\""]),
    ("engine = \"none\"", "solver_iterations = 4", 5, &["solver_iterations", "engine = \"rapier\""]),
    ("name = \"sling\"", "", 6, &["cable", "missing key `name`"]),
    ("name = \"sling\"", "name = \"\"", 7, &["name", "not empty"]),
    ("name = \"sling\"", "name = \"all\"", 7, &["cable.all.name", "not \"all\""]),
    (
        "points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]",
        "points = [[0.0, 0.0, 0.0]]",
        8,
        &["cable.sling.points: too few rows: 1", "at least 2"],
    ),
    ("points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]", "points = [[0, 0, 0], [0, 0, 0]]", 8, &["points 0 and 1 coincide"]),
    ("points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]", "points = [[0, 0, 0], [inf, 0, 0]]", 8, &["points", "not finite"]),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { tolerance = 1e-20 }",
        15,
        &["cable.sling.integrator.tolerance: 1e-20 m is below the rounding", "at least 2.0e-14 m"],
    ),
    ("length = 2.0", "length = 0.0", 9, &["cable.sling.length: 0 ", "> 0, in m"]),
    ("length = 2.0", "lenght = 2.0", 9, &["cable.sling.lenght", "unknown key `lenght`", "Did you mean \"length\"?"]),
    ("elements = 10", "elements = 0", 10, &["cable.sling.elements: 0 is out of range", "whole number from 1"]),
    ("elements = 10", "elements = -3", 10, &["cable.sling.elements", "-3", "whole number from 1"]),
    ("elements = 10", "elements = 10.5", 10, &["cable.sling.elements", "10.5", "whole number from 1"]),
    ("elements = 10", "elements = { count = 30 }", 10, &["cable.sling.elements", "missing key `finest`"]),
    ("elements = 10", "elements = { finest = 0.01 }", 10, &["cable.sling.elements", "missing key `count`"]),
    ("elements = 10", "elements = { count = 30, finest = 0.0 }", 10, &["cable.sling.elements.finest: 0 ", "> 0, in m"]),
    ("elements = 10", "elements = { count = 30, fine = 0.1 }", 10, &["unknown key `fine`", "count, finest, at"]),
    (
        "elements = 10",
        "elements = { count = 30, finest = 0.01, at = [] }",
        10,
        &["cable.sling.elements.at", "one or more"],
    ),
    (
        "elements = 10",
        "elements = { count = 30, finest = 0.01, at = [\"ende\"] }",
        10,
        &["cable.sling.elements.at", "\"ende\"", "Did you mean \"end\"?"],
    ),
    (
        "elements = 10",
        "elements = { count = 30, finest = 0.01, at = [3.0] }",
        10,
        &["cable.sling.elements.at", "3 m is not on the cable"],
    ),
    ("elements = 10", "elements = { count = 30, finest = 0.5 }", 6, &["finest elements", "below the mean length"]),
    ("elements = 10", "elements = { count = 4, finest = 1e-3 }", 6, &["number of elements", "20 are needed"]),
    ("section = { square = 0.01 }", "", 6, &["cable.sling.section: missing key", "square = number"]),
    ("section = { square = 0.01 }", "section = { square = -0.01 }", 11, &["cable.sling.section.square: -0.01"]),
    (
        "section = { square = 0.01 }",
        "section = { hexagon = 0.01 }",
        11,
        &["unknown key `hexagon`", "square", "round", "tube"],
    ),
    (
        "section = { square = 0.01 }",
        "section = { square = 0.01, round = 0.01 }",
        11,
        &["`square`, `round` are given together", "exactly one of square, round, tube"],
    ),
    (
        "section = { square = 0.01 }",
        "section = { tube = [0.01, 0.02] }",
        11,
        &["section.tube: ", "0.02", "outer > inner"],
    ),
    ("section = { square = 0.01 }", "axial_stiffness = 1.0e4", 12, &["density has no meaning without section"]),
    ("density = 4000.0", "density = -4000.0", 12, &["cable.sling.density: -4000 ", "kg/m^3"]),
    ("density = 4000.0", "", 6, &["cable.sling.density: missing key"]),
    ("density = 4000.0", "density = 4000.0\naxial_stiffness = 1.0e4", 13, &["both section and axial_stiffness"]),
    ("youngs_modulus = 1.0e8", "youngs_modulus = 0", 13, &["cable.sling.youngs_modulus: 0 ", "Pa"]),
    ("rule = \"G5-3\"", "rule = \"G99-3\"", 14, &["cable.sling.rule: unknown rule \"G99-3\"", "GL-T"]),
    ("rule = \"G5-3\"", "rule = { axial = \"exact\" }", 14, &["cable.sling.rule", "missing key `bending`"]),
    (
        "rule = \"G5-3\"",
        "rule = { axial = \"exact\", bending = \"t3\" }",
        14,
        &["cable.sling.rule.bending", "t3", "none"],
    ),
    ("rule = \"G5-3\"", "rule = \"G2-2\"", 14, &["G2-2 is rank deficient", "allow_rank_deficient"]),
    ("integrator = { tolerance = 1e-6 }", "integrator = { tolerance = 0 }", 15, &["integrator.tolerance", "> 0"]),
    ("integrator = { tolerance = 1e-6 }", "integrator = {}", 15, &["cable.sling.integrator: none of `tolerance`"]),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { method = \"euler\", substeps = 4 }",
        15,
        &["integrator.method", "euler", "esdirk3"],
    ),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { method = \"verlet\", tolerance = 1e-6 }",
        15,
        &["verlet", "does not estimate its error"],
    ),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { method = \"esdirk3\", stable = 0.5 }",
        15,
        &["integrator.stable", "explicit"],
    ),
    ("integrator = { tolerance = 1e-6 }", "integrator = { substeps = 4 }", 15, &["integrator.method: missing key"]),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { method = \"rkn4\", substeps = 0 }",
        15,
        &["integrator.substeps", ">= 1"],
    ),
    (
        "integrator = { tolerance = 1e-6 }",
        "integrator = { fidelity = \"fast\" }",
        15,
        &["integrator.fidelity", "fast", "game"],
    ),
    ("velocity = [0.0, 0.0, 0.0]\ninitial", "velocity = [nan, 0.0, 0.0]\ninitial", 16, &["cable.sling.velocity"]),
    (
        "initial = \"straight\"",
        "initial = \"bent\"",
        17,
        &["cable.sling.initial: unknown value \"bent\"", "equilibrium"],
    ),
    ("", "[cable.damping]\naxial = -1e-3", 20, &["cable.sling.damping.axial", ">= 0"]),
    ("", "[cable.damping]", 19, &["cable.sling.damping: none of `axial`, `bending`, `rope` is given", "at least one"]),
    ("", "[cable.drag]\nfluid_density = 0.0", 20, &["cable.sling.drag.fluid_density", "> 0"]),
    ("", "[cable.drag]\nnormal = 1.0", 19, &["cable.sling.drag", "fluid_density"]),
    (
        "",
        "[cable.buoyancy]\nfluid_density = 1000.0\nadded_mass = nan",
        21,
        &["cable.sling.buoyancy.added_mass", ">= 0"],
    ),
    ("", "[cable.contact]\nradius = 0.01", 15, &["cable.sling.integrator", "cannot step contact", "game"]),
    ("", "[cable.contact]\nfriction = -0.1", 20, &["cable.sling.contact.friction", ">= 0"]),
    ("", "[cable.break]\ntension = -10.0", 20, &["cable.sling.break.tension", "> 0"]),
    ("", "[cable.break]\nstrain = nan", 20, &["cable.sling.break.strain", "> 0"]),
    ("", "[cable.break]", 19, &["cable.sling.break", "at least one"]),
    ("", "[cable.break]\ntime = 1.0", 19, &["cable.sling.break.at"]),
    ("", "[cable.break]\ntime = 1.0\nat = \"end\"", 21, &["cable.sling.break.at", "is an end of the cable"]),
    ("", "[cable.reel]\nend = \"middle\"\nrate = [[0.0, 0.0]]", 20, &["cable.sling.reel.end", "end"]),
    ("", "[cable.reel]\nrate = [[0.0, nan]]", 20, &["cable.sling.reel.rate", "not finite"]),
    ("", "[cable.reel]\nrate = [[1.0, 0.1], [0.5, 0.0]]", 20, &["cable.sling.reel.rate", "ascend"]),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]\nmax_force = 10.0", 15, &["cable.sling.integrator", "clutch", "game"]),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]\nmax_force = -1.0", 21, &["cable.sling.reel.max_force", ">= 0"]),
    (
        "",
        "[cable.reel]\nrate = [[0.0, 0.1]]\n[[load]]\ncable = \"sling\"\nat = 1.9\nforce = [0.0, -1.0, 0.0]",
        23,
        &["load.0.at", "element at the eye", "sling"],
    ),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]\nfeed = \"box\"", 21, &["cable.sling.reel.feed", "coil"]),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]", 19, &["cable.sling.reel", "nothing holds the end", "attachment"]),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]\nstock = 1.9", 6, &["stock of a reel", "length that is out"]),
    ("", "[cable.reel]\nrate = [[0.0, 0.1]]\nacceleration = 0.0", 21, &["cable.sling.reel.acceleration", "> 0"]),
    (
        "",
        "[cable.reel]\nrate = [[0.0, 0.1]]\n[cable.buoyancy]\nfluid_density = 1.2\nadded_mass = 1.0",
        6,
        &["added mass", "reel"],
    ),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\nflow = [1.0, 2.0]",
        21,
        &["cable.sling.drag.flow", "three finite numbers"],
    ),
    ("", "[cable.drag]\nfluid_density = 1.2\nflow = [1.0, nan, 2.0]", 21, &["cable.sling.drag.flow", "not finite"]),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\n[cable.drag.flow]\nprofile = { rows = [[0.0, 1.0]] }",
        21,
        &["cable.sling.drag.flow.velocity: missing key"],
    ),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\n[cable.drag.flow]\nvelocity = [1, 0, 0]\nprofile = { rows = [] }",
        23,
        &["cable.sling.drag.flow.profile.rows: too few rows: 0", "ascending"],
    ),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\n[cable.drag.flow]\nvelocity = [1, 0, 0]\nhistory = [[1.0, 0.0], [1.0, 2.0]]",
        23,
        &["cable.sling.drag.flow.history: t = 1 follows t = 1", "t ascending"],
    ),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\n[cable.drag.flow]\nvelocity = [1, 0, 0]\npower_law = { reference = 0.0, exponent = 0.1, top = 9 }",
        23,
        &["cable.sling.drag.flow.power_law.reference: 0 ", "> 0, in m"],
    ),
    (
        "",
        "[cable.drag]\nfluid_density = 1.2\n[cable.drag.flow]\nvelocity = [1, 0, 0]\npower_law = { reference = 1e-9, exponent = 99, top = 9 }",
        23,
        &["power_law.exponent: 99 makes factors that are not finite"],
    ),
    ("", "[cable.rest_shape]", 19, &["cable.sling.rest_shape: none of `stretch`, `curvature`, `piece` is given"]),
    ("", "[cable.rest_shape]\nstretch = 0.0", 20, &["cable.sling.rest_shape.stretch: 0 ", "> 0"]),
    ("", "[cable.rest_shape]\ncurvature = -1.0", 20, &["cable.sling.rest_shape.curvature: -1 ", "no direction"]),
    ("", "[cable.rest_shape]\naxis = [0, 0, 1]", 20, &["unknown key `axis`", "stretch, curvature, piece"]),
    (
        "",
        "[[cable.rest_shape.piece]]\nfrom = 0.5",
        19,
        &["cable.sling.rest_shape.piece.0: none of `stretch`, `curvature` is given"],
    ),
    (
        "",
        "[[cable.rest_shape.piece]]\nfrom = 2.0\ncurvature = 1.0",
        20,
        &["cable.sling.rest_shape.piece.0.from: 2 ", "of the unstretched cable"],
    ),
    (
        "rule = \"G5-3\"",
        "rule = \"G5-none\"\nrest_shape = { curvature = 1.0 }",
        15,
        &["cable.sling.rest_shape.curvature: rule G5-none has no bending to curve"],
    ),
    ("", "[[cable.line_load]]\nfrom = 0.1", 19, &["cable.sling.line_load.0.force: missing key", "N/m"]),
    ("", "[[cable.line_load]]\nforce = [0, 1, 0]\nfrom = 2.0", 21, &["cable.sling.line_load.0.from: 2 ", "below"]),
    ("", "[[cable.line_load]]\nforce = [0, 1, 0]\nto = 2.1", 21, &["cable.sling.line_load.0.to: 2.1 ", "at most"]),
    ("initial = \"straight\"", "gravity_scale = nan", 17, &["cable.sling.gravity_scale: NaN ", "a finite number"]),
    (
        "",
        "[cable.drag]\nfluid_densty = 1.2",
        20,
        &["cable.sling.drag.fluid_densty", "unknown key", "Did you mean \"fluid_density\"?"],
    ),
    (
        "",
        "[[cable]]\nname = \"sling\"\npoints = [[0,0,0],[1,0,0]]\nsection = { round = 0.01 }\ndensity = 1.0\nyoungs_modulus = 1.0",
        20,
        &["\"sling\" is taken"],
    ),
    (
        "",
        "[[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"",
        20,
        &["attachment.0.cable: no cable is named \"rope\"", "sling"],
    ),
    (
        "",
        "[[attachment]]\nname = \"hook\"\ncable = \"sling\"\nat = \"middle\"\nbody = \"world\"",
        22,
        &["attachment.hook.at", "\"middle\"", "\"start\""],
    ),
    (
        "",
        "[[attachment]]\ncable = \"sling\"\nat = 2.5\nbody = \"world\"",
        21,
        &["attachment.0.at: 2.5 m is not on the cable"],
    ),
    (
        "",
        "[[attachment]]\ncable = \"sling\"\nat = \"end\"\nbody = \"crate\"",
        22,
        &["no body is named \"crate\"", "world"],
    ),
    (
        "",
        "[[attachment]]\ncable = \"sling\"\nat = \"end\"\nbody = \"world\"\nkind = \"weld\"",
        23,
        &["unknown value \"weld\"", "clamp"],
    ),
    (
        "",
        "[[attachment]]\ncable = \"sling\"\nat = \"end\"\nbody = \"world\"\nanchor = [2.0, 0.5, 0.0]",
        23,
        &["anchor", "5.000e-1 m from the cable point", "equilibrium"],
    ),
    (
        "",
        "[[attachment]]\ncable = \"sling\"\nat = 0.0\nbody = \"world\"\n[[attachment]]\ncable = \"sling\"\nat = \"start\"\nbody = \"world\"",
        25,
        &["already holds the cable there"],
    ),
    ("", "[[load]]\ncable = \"sling\"\nat = \"end\"", 19, &["load.0: none of `force`, `moment` is given"]),
    ("", "[[load]]\ncable = \"sling\"\nat = \"end\"\nforce = [0, inf, 0]", 22, &["load.0.force", "not finite"]),
    ("", "[[load]]\ncable = \"sling\"\nat = -0.1\nforce = [0, 1, 0]", 21, &["load.0.at: -0.1 m"]),
    ("", "[[load]]\ncable = \"sling\"\nat = \"end\"\nforce = [0, 1, 0]\nramp = -1.0", 23, &["load.0.ramp: -1 "]),
    ("", "[[load]]\nat = \"end\"\nforce = [0, 1, 0]", 19, &["load.0.cable: missing key"]),
    (
        "",
        "[[probe]]\nname = \"tip\"\ncable = \"rope\"\nat = \"end\"",
        21,
        &["probe.tip.cable: no cable is named \"rope\""],
    ),
    ("", "[[probe]]\nname = \"tip\"\ncable = \"sling\"\nat = 3", 22, &["probe.tip.at: 3 m"]),
    ("", "[[probe]]\nname = \"tip\"\ncable = \"sling\"", 19, &["probe.tip.at: missing key"]),
    ("", "[[probe]]\nname = \"tip\"", 19, &["probe.tip: none of `cable`, `body`", "exactly one"]),
    (
        "",
        "[[probe]]\nname = \"tip\"\nenergy = \"all\"\nmomentum = \"all\"",
        19,
        &["probe.tip: `energy`, `momentum` are given together"],
    ),
    ("", "[[probe]]\nname = \"../tip\"\nenergy = \"all\"", 20, &["cannot name a file"]),
    ("", "[[probe]]\nname = \"e\"\nenergy = \"all\"\nevery = 0.0", 22, &["probe.e.every: 0 "]),
    ("", "[[probe]]\nname = \"e\"\nattachment = \"hook\"", 21, &["no attachment is named \"hook\""]),
    (
        "",
        "[[probe]]\nname = \"e\"\nenergy = \"all\"\n[[probe]]\nname = \"E\"\nenergy = \"all\"",
        23,
        &["\"E\" is taken"],
    ),
    ("", "[[probe]\nname = 3", 19, &["not TOML"]),
    (
        "",
        "[[probe]]\nname = \"e\"\nbody = \"crate\"",
        21,
        &["probe.e.body", "no body is named \"crate\"", "the scene has no body"],
    ),
];

#[test]
fn errors_in_a_cable_name_line_key_and_accepted_values() {
    all_are_errors(GOOD, CASES);
}

#[test]
fn an_empty_file_and_a_scene_without_cable_are_errors() {
    assert!(message("").contains("cable: missing key"));
    assert!(message("duration = 1.0").contains("cable: missing key"));
}

#[test]
fn overrides_are_applied_before_the_checks_and_named_in_errors() {
    let parse = |sets: &[&str]| {
        let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
        Scene::parse("scene.toml", GOOD, &sets, Purpose::Run)
    };
    let scene = parse(&[
        "cable.sling.elements=20",
        "cable.sling.rule=ST2",
        "dt=0.02",
        "cable.sling.integrator.method=esdirk4",
        "cable.0.section={ tube = [0.02, 0.01] }",
    ])
    .unwrap();
    let cable = &scene.cables[0];
    assert_eq!((cable.elements, cable.rule.to_string().as_str(), scene.dt), (20, "ST2", 0.02));
    assert_eq!(cable.integrator.integrator(f64::INFINITY).method.to_string(), "esdirk4");
    assert_eq!(cable.sections.first().diameter, Some(0.02));
    for (set, fragments) in [
        ("cable.sling.elements=0", &["--set cable.sling.elements=0: cable.sling.elements: 0 is out of range"][..]),
        ("cable.sling.elements=many", &["--set cable.sling.elements=many: cable.sling.elements", "\"many\""]),
        ("cable.sling.colour=red", &["--set cable.sling.colour=red: cable.sling.colour: unknown key `colour`"]),
        ("cable.rope.elements=3", &["no cable is named \"rope\"", "sling"]),
        ("cable.slng.elements=3", &["no cable is named \"slng\"", "Did you mean \"sling\"?"]),
        ("cable.elements=3", &["cable is an array", "cable.NAME.KEY", "sling"]),
        ("cable.sling", &["no value", "KEY=VALUE"]),
        ("dt.x=1", &["dt is a single value"]),
        ("a b=1", &["not a dotted key"]),
    ] {
        let message = parse(&[set]).unwrap_err().to_string();
        fragments.iter().for_each(|f| assert!(message.contains(f), "{set}: {message}"));
    }
}

#[test]
fn every_form_of_a_value_is_accepted() {
    let changes = [
        ("rule = \"G5-3\"", "rule = { axial = \"gauss-5\", bending = \"t2\" }"),
        ("rule = \"G5-3\"", "rule = \"G2-2\"\nallow_rank_deficient = true"),
        ("rule = \"G5-3\"", ""),
        ("integrator = { tolerance = 1e-6 }", "integrator = { method = \"esdirk4\", tolerance = 1e-6 }"),
        ("integrator = { tolerance = 1e-6 }", "integrator = { method = \"midpoint\", substeps = 4 }"),
        ("integrator = { tolerance = 1e-6 }", "integrator = { method = \"rkn6\", stable = 0.5 }"),
        ("integrator = { tolerance = 1e-6 }", "integrator = { method = \"generalised-alpha-0.8\", max_step = 1e-3 }"),
        ("integrator = { tolerance = 1e-6 }", "integrator = { fidelity = \"game\" }"),
        ("engine = \"none\"", ""),
        (
            "section = { square = 0.01 }\ndensity = 4000.0\nyoungs_modulus = 1.0e8",
            "axial_stiffness = 1.0e4\nbending_stiffness = 0\nmass_per_length = 0.4",
        ),
    ];
    all_are_accepted(GOOD, &changes);
}
