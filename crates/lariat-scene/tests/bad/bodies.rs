//! Invalid bodies, and invalid references to them.

use super::cases::{Case, all_are_accepted, all_are_errors, changed, message};
use lariat_scene::{Purpose, Scene};
use std::fs;

/// A valid scene, with its lines numbered from 1; the tail of each case starts on line 50.
const GOOD: &str = r#"name = "test"
duration = 1.0
dt = 0.01
engine = "rapier"
solver_iterations = 4
[[body]]
name = "crate"
kind = "dynamic"
shape = { cuboid = [0.1, 0.1, 0.1] }
mass = 50.0
inertia = [0.33, 0.33, 0.33]
position = [2.0, -0.1, 0.0]
rotation = [0.0, 0.0, 0.0]
velocity = [0.0, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 0.0]
friction = 0.5
[[body]]
name = "floor"
kind = "fixed"
shape = { plane = [0.0, 1.0, 0.0] }
position = [0.0, -9.0, 0.0]
[[body]]
name = "winch"
kind = "kinematic"
shape = "none"
path = [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.5, 0.0]]
[[cable]]
name = "sling"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
[[attachment]]
name = "drum"
cable = "sling"
at = "start"
body = "winch"
[[attachment]]
name = "hook"
cable = "sling"
at = "end"
body = "crate"
anchor = [0.0, 0.1, 0.0]
kind = "ball"
[[load]]
body = "crate"
point = [0.1, 0.0, 0.0]
force = [1.0, 0.0, 0.0]
ramp = 0.5
"#;

const BOX: &str = "shape = { cuboid = [0.1, 0.1, 0.1] }";
const PATH: &str = "path = [[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.5, 0.0]]";

const CASES: &[Case] = &[
    (
        "engine = \"rapier\"",
        "engine = \"none\"",
        6,
        &["body.crate", "engine = \"none\" computes no body", "engine = \"rapier\""],
    ),
    ("engine = \"rapier\"", "engine = \"bullet\"", 4, &["engine: unknown value \"bullet\"", "\"rapier\""]),
    (
        "solver_iterations = 4",
        "solver_iterations = 0",
        5,
        &["solver_iterations: 0 is out of range", "whole number >= 1"],
    ),
    ("solver_iterations = 4", "solver_iterations = -1", 5, &["solver_iterations", "-1", "whole number >= 1"]),
    ("solver_iterations = 4", "solver_iterations = 1.5", 5, &["solver_iterations", "1.5", "whole number >= 1"]),
    ("dt = 0.01", "dt = 0.01\ngravity = [0.0, -1e60, 0.0]", 4, &["gravity: -1e60 is beyond the single precision"]),
    ("name = \"crate\"\nkind", "kind", 6, &["body", "missing key `name`"]),
    ("name = \"crate\"\nkind", "name = \"\"\nkind", 7, &["name", "not empty"]),
    ("name = \"crate\"\nkind", "name = \"world\"\nkind", 7, &["body.world.name", "not \"world\""]),
    ("name = \"floor\"", "name = \"crate\"", 18, &["body.crate.name: \"crate\" is taken"]),
    ("kind = \"dynamic\"", "kind = \"static\"", 8, &["body.crate.kind: unknown value \"static\"", "\"fixed\""]),
    ("kind = \"dynamic\"", "colour = \"red\"", 8, &["body.crate.colour", "unknown key `colour`", "friction"]),
    (BOX, "", 6, &["body.crate.shape: missing key", "\"none\""]),
    (BOX, "shape = \"cube\"", 9, &["body.crate.shape: unknown value \"cube\"", "cuboid"]),
    (BOX, "shape = { cone = [0.1, 0.1] }", 9, &["unknown key `cone`", "capsule"]),
    (
        BOX,
        "shape = { ball = 0.1, cuboid = [0.1, 0.1, 0.1] }",
        9,
        &["body.crate.shape: `cuboid`, `ball` are given together", "exactly one of"],
    ),
    (BOX, "shape = {}", 9, &["body.crate.shape: none of `cuboid`", "exactly one of"]),
    (BOX, "shape = { cuboid = [0.1, 0.0, 0.1] }", 9, &["body.crate.shape.cuboid: 0 ", "Half extents"]),
    (BOX, "shape = { cuboid = [0.1, 0.1] }", 9, &["body.crate.shape", "Half extents"]),
    (BOX, "shape = { ball = -0.1 }", 9, &["body.crate.shape.ball: -0.1 ", "Radius"]),
    (BOX, "shape = { ball = 1e-60 }", 9, &["body.crate.shape.ball: 1e-60 is beyond the single precision"]),
    (BOX, "shape = { ball = 1e-15 }\n", 9, &["body.crate.shape", "beyond single precision"]),
    (
        BOX,
        "shape = { cylinder = [0.1, nan] }",
        9,
        &["body.crate.shape.cylinder: [0.1, NaN] is not finite", "[half height, radius]"],
    ),
    (BOX, "shape = { capsule = [inf, 0.1] }", 9, &["body.crate.shape.capsule: [inf, 0.1] is not finite"]),
    (BOX, "shape = { plane = [0.0, 1.0, 0.0] }", 9, &["shape.plane: a half space has no mass", "fixed or kinematic"]),
    ("plane = [0.0, 1.0, 0.0]", "plane = [0.0, 0.0, 0.0]", 20, &["body.floor.shape.plane", "no direction"]),
    (BOX, "shape = { mesh = \"no_such.obj\" }", 9, &["body.crate.shape.mesh", "cannot read", "no_such.obj", "OBJ"]),
    ("mass = 50.0", "mass = -50.0", 10, &["body.crate.mass: -50 ", "in kg"]),
    ("mass = 50.0", "mass = 0.0", 10, &["body.crate.mass: 0 "]),
    ("mass = 50.0", "mass = 1e60", 10, &["body.crate.mass: 1e60 is beyond the single precision"]),
    ("mass = 50.0", "mass = \"heavy\"", 10, &["body.crate.mass", "\"heavy\"", "in kg"]),
    ("mass = 50.0", "", 6, &["body.crate.mass: missing key", "density"]),
    ("mass = 50.0", "mass = 50.0\ndensity = 100.0", 11, &["body.crate.density: both mass and density"]),
    ("mass = 50.0", "density = nan", 10, &["body.crate.density: NaN "]),
    (BOX, "shape = \"none\"", 16, &["body.crate.friction", "touches nothing"]),
    ("inertia = [0.33, 0.33, 0.33]", "inertia = [0.33, 0.33]", 11, &["body.crate.inertia", "three finite numbers"]),
    ("inertia = [0.33, 0.33, 0.33]", "inertia = [0.33, 0.0, 0.33]", 11, &["body.crate.inertia: 0 "]),
    ("inertia = [0.33, 0.33, 0.33]", "inertia = [0.1, 0.1, 0.33]", 11, &["body.crate.inertia", "no distribution"]),
    ("position = [2.0, -0.1, 0.0]", "position = [2.0, nan, 0.0]", 12, &["body.crate.position", "not finite"]),
    ("rotation = [0.0, 0.0, 0.0]", "rotation = [0.0, inf, 0.0]", 13, &["body.crate.rotation", "Axis times angle"]),
    ("\nvelocity = [0.0, 0.0, 0.0]", "\nvelocity = 3.0", 14, &["body.crate.velocity", "m/s"]),
    ("friction = 0.5", "friction = -0.5", 16, &["body.crate.friction: -0.5 ", ">= 0"]),
    ("friction = 0.5", "path = [[0.0, 0.0, 0.0, 0.0]]", 16, &["a dynamic body has no path", "kinematic"]),
    ("kind = \"fixed\"", "kind = \"fixed\"\nmass = 3.0", 20, &["body.floor.mass: a fixed body has no mass"]),
    ("kind = \"fixed\"", "kind = \"fixed\"\nvelocity = [0, 0, 0]", 20, &["a fixed body has no velocity"]),
    (PATH, "inertia = [1.0, 1.0, 1.0]", 26, &["body.winch.inertia: a kinematic body has no inertia"]),
    (PATH, "path = []", 26, &["body.winch.path: too few rows: 0", "[t, x, y, z]"]),
    (PATH, "path = [[0.0, 0.0, 0.0]]", 26, &["body.winch.path", "[t, x, y, z]"]),
    (PATH, "path = [[0.0, 0, 0, 0], [0.0, 0, 1, 0]]", 26, &["body.winch.path: t = 0 follows t = 0", "ascending"]),
    (PATH, "path = {}", 26, &["body.winch.path", "rows", "rotation", "csv"]),
    (PATH, "path = { csv = \"no_such.csv\" }", 26, &["body.winch.path.csv", "no_such.csv"]),
    (PATH, "path = { csv = \"a.csv\", rows = [[0.0, 0, 0, 0]] }", 26, &["body.winch.path.rows: both csv and rows"]),
    (
        PATH,
        "path = { rotation = [[0.0, 0, 0, 0], [2.0, 0, 6.3, 0]] }",
        26,
        &["body.winch.path.rotation: it turns by 6.30 rad between 0 s and 2 s", "add rows"],
    ),
    (
        PATH,
        "angular_velocity = [0, 1, 0]\npath = { rotation = [[0.0, 0, 0, 0]] }",
        26,
        &["body.winch.angular_velocity: the path determines the angular velocity"],
    ),
    (PATH, "path = [[0.0, 0, nan, 0]]", 26, &["body.winch.path", "not finite"]),
    (
        PATH,
        "position = [0.0, 1.0, 0.0]\npath = [[0.0, 0.0, 0.0, 0.0]]",
        26,
        &["body.winch.position", "not where the path is"],
    ),
    (PATH, "velocity = [0, 1, 0]\npath = [[0.0, 0.0, 0.0, 0.0]]", 26, &["body.winch.velocity: the path determines"]),
    (
        "body = \"crate\"\nanchor",
        "body = \"box\"\nanchor",
        42,
        &["no body is named \"box\"", "world | crate | floor | winch"],
    ),
    ("at = \"end\"", "at = 2.5", 41, &["attachment.hook.at: 2.5 m is not on the cable"]),
    ("cable = \"sling\"\nat = \"end\"", "cable = \"rope\"\nat = \"end\"", 40, &["no cable is named \"rope\""]),
    ("name = \"hook\"", "name = \"drum\"", 39, &["attachment.drum.name: \"drum\" is taken"]),
    ("at = \"end\"", "at = \"start\"", 41, &["already holds the cable there"]),
    ("kind = \"ball\"", "kind = \"weld\"", 44, &["attachment.hook.kind: unknown value \"weld\"", "\"clamp\""]),
    (
        "anchor = [0.0, 0.1, 0.0]",
        "anchor = [0.0, 0.2, 0.0]",
        43,
        &["attachment.hook.anchor", "1.000e-1 m from the cable point", "axes of the body"],
    ),
    (
        "rotation = [0.0, 0.0, 0.0]",
        "rotation = [0.0, 0.0, 1.0]",
        43,
        &["attachment.hook.anchor", "from the cable point"],
    ),
    ("body = \"crate\"\npoint", "body = \"box\"\npoint", 46, &["load.0.body: no body is named \"box\"", "crate"]),
    ("body = \"crate\"\npoint", "body = \"winch\"\npoint", 46, &["load.0.body", "not dynamic", "dynamic body"]),
    ("point = [0.1, 0.0, 0.0]", "point = [0.1, inf, 0.0]", 47, &["load.0.point", "not finite"]),
    ("point = [0.1, 0.0, 0.0]", "at = \"end\"", 47, &["load.0.at: at is for a load on a cable"]),
    ("point = [0.1, 0.0, 0.0]", "cable = \"sling\"", 47, &["load.0.cable: cable is for a load on a cable"]),
    ("force = [1.0, 0.0, 0.0]", "force = [1e60, 0.0, 0.0]", 48, &["load.0.force: 1e60 is beyond the single precision"]),
    ("ramp = 0.5", "history = [[1.0, 0.0], [1.0, 1.0]]", 49, &["load.0.history: t = 1 follows t = 1"]),
    ("ramp = 0.5", "ramp = nan", 49, &["load.0.ramp: NaN "]),
    ("", "[[probe]]\nname = \"b\"\nbody = \"box\"", 52, &["probe.b.body: no body is named \"box\"", "crate | floor"]),
    ("", "[[probe]]\nname = \"b\"\nbody = \"crate\"\nat = \"end\"", 53, &["probe.b.at", "at beside cable"]),
    ("", "[[probe]]\nname = \"b\"\nenergy = \"crate\"", 52, &["probe.b.energy: no cable is named \"crate\""]),
    ("", "[[probe]]\nname = \"b\"\nattachment = \"crate\"", 52, &["no attachment is named \"crate\"", "drum | hook"]),
];

#[test]
fn errors_in_a_body_name_line_key_and_accepted_values() {
    all_are_errors(GOOD, CASES);
}

#[test]
fn every_form_of_a_value_is_accepted() {
    let changes = [
        ("engine = \"rapier\"\nsolver_iterations = 4\n", ""),
        ("kind = \"dynamic\"\n", ""),
        ("mass = 50.0\ninertia = [0.33, 0.33, 0.33]", "density = 6000.0"),
        (BOX, "shape = { ball = 0.1 }"),
        (BOX, "shape = { cylinder = [0.1, 0.1] }"),
        (BOX, "shape = { capsule = [0.1, 0.1] }"),
        (PATH, "velocity = [0.0, 0.0, 0.1]\nangular_velocity = [0.0, 1.0, 0.0]"),
        (PATH, "position = [0.0, 0.0, 0.0]\npath = [[-1.0, 0.0, -1.0, 0.0], [1.0, 0.0, 1.0, 0.0]]"),
        ("body = \"winch\"", "body = \"world\""),
        ("kind = \"ball\"", "kind = \"clamp\""),
        ("at = \"end\"\nbody = \"crate\"\nanchor = [0.0, 0.1, 0.0]", "at = 1.23\nbody = \"crate\""),
        ("body = \"crate\"\npoint = [0.1, 0.0, 0.0]", "body = \"crate\""),
    ];
    all_are_accepted(GOOD, &changes);
    // no shape, and no friction then
    let point = |text: &str| text.replacen(BOX, "shape = \"none\"", 1).replacen("friction = 0.5\n", "", 1);
    Scene::parse("scene.toml", &point(GOOD), &[], Purpose::Run).unwrap();
    let message = message(&changed(&point(GOOD), "mass = 50.0", "density = 3.0"));
    assert!(message.contains("scene.toml:10: body.crate.density: a body without shape has no volume"), "{message}");
    // Rapier without bodies
    let bare = GOOD.find("[[body]]").zip(GOOD.find("[[cable]]")).zip(GOOD.find("[[attachment]]"));
    let ((body, cable), attachment) = bare.unwrap();
    let text = format!("{}{}", &GOOD[..body], &GOOD[cable..attachment]);
    Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap();
}

/// Corners and faces of a tetrahedron, and of a square without volume.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

#[test]
fn meshes_are_read_from_the_folder_of_the_scene_and_are_errors_where_they_make_no_body() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("tetrahedron", TETRAHEDRON),
        ("square", SQUARE),
        ("points", "v 0 0 0\nv 1 0 0\n"),
        ("text", "this is not a mesh\n"),
        ("outside", "v 0 0 0\nv 1 0 0\nf 1 2 7\n"),
        ("nan", "v 0 0 0\nv 1 0 0\nv 0 nan 1\nf 1 2 3\n"),
        ("broken", "v 0 0\nf 1 2 3\n"),
        ("line", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"),
        ("huge", "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nv 0 0 1e300\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
    ] {
        fs::write(folder.path().join(name).with_extension("obj"), text).unwrap();
    }
    let check = |from: &str, mesh: &str| {
        assert!(GOOD.contains(from));
        let file = folder.path().join("scene.toml");
        fs::write(&file, GOOD.replacen(from, &format!("shape = {{ mesh = \"{mesh}.obj\" }}"), 1)).unwrap();
        match Scene::read(&file, &[], Purpose::Run) {
            Ok(_) => "accepted".to_string(),
            Err(error) => error.to_string(),
        }
    };
    let floor = "shape = { plane = [0.0, 1.0, 0.0] }";
    assert_eq!(check(BOX, "tetrahedron"), "accepted");
    assert_eq!(check(floor, "tetrahedron"), "accepted");
    assert_eq!(check(floor, "square"), "accepted");
    for (mesh, fragment) in [
        ("square", "volume"),
        ("points", "no triangles"),
        ("text", "no triangles"),
        ("outside", "cannot read"),
        ("nan", ""),
        ("broken", "cannot read"),
        ("line", "without area"),
        ("huge", ""),
    ] {
        let message = check(BOX, mesh);
        assert!(message.contains("scene.toml:9: body.crate.shape") && message.contains(fragment), "{mesh}: {message}");
    }
}
