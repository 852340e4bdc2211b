//! What newcomers write, and the first line that they get: it says the cause, by the key that is to be changed.

use super::cases::{Case, all_are_errors};

/// A load on a rope, as a first scene has it. Lines are counted from 1.
const GOOD: &str = r#"duration = 0.05
dt = 0.01
[[cable]]
name = "rope"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
elements = 10
section = { round = 0.01 }
density = 1100.0
youngs_modulus = 1e8
[[body]]
name = "load"
mass = 10.0
shape = { cuboid = [0.1, 0.1, 0.1] }
position = [2.0, -0.1, 0.0]
[[attachment]]
name = "hook"
cable = "rope"
at = "end"
body = "load"
anchor = [0.0, 0.1, 0.0]
"#;

const MISTAKES: &[Case] = &[
    // a name that another program, or another one, gives it
    ("youngs_modulus = 1e8", "stiffness = 1e8", 9, &["unknown key `stiffness`", "Did you mean \"youngs_modulus\"?"]),
    ("section = { round = 0.01 }", "diameter = 0.01", 7, &["unknown key `diameter`", "Did you mean \"section\"?"]),
    ("{ round = 0.01 }", "{ radius = 0.005 }", 7, &["unknown key `radius`", "Did you mean \"round\"?"]),
    ("elements = 10", "segments = 10", 6, &["Did you mean \"elements\"?"]),
    ("{ cuboid =", "{ box =", 13, &["Did you mean \"cuboid\"?"]),
    ("mass = 10.0", "mass = 10.0\ntype = \"dynamic\"", 13, &["Did you mean \"kind\"?"]),
    ("mass = 10.0", "mass = 10.0\nkind = \"static\"", 13, &["Did you mean \"fixed\"?"]),
    ("dt = 0.01", "timestep = 0.01", 2, &["Did you mean \"dt\"?"]),
    ("elements = 10", "elements = 10\nfidelity = \"game\"", 7, &["Did you mean \"integrator\"?"]),
    // a value of another form
    ("section = { round = 0.01 }", "section = 0.01", 7, &["found the number 0.01", "{ round = number }"]),
    ("elements = 10", "elements = 10.0", 6, &["found the number 10.0", "a whole number"]),
    (
        "youngs_modulus = 1e8",
        "youngs_modulus = \"1e8\"",
        9,
        &["\"1e8\" is no number with one of the units Pa", "in Pa"],
    ),
    ("dt = 0.01", "dt = 0.01\ngravity = -9.81", 3, &["gravity: found the number -9.81", "[x, y, z]"]),
    ("[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]", "[[0.0, 0.0], [2.0, 0.0]]", 5, &["an array of 2 values", "rows [x, y, z]"]),
    (
        "shape = { cuboid = [0.1, 0.1, 0.1] }",
        "shape = \"box\"",
        13,
        &["unknown value \"box\"", "{ cuboid = [x, y, z] }"],
    ),
    ("[[cable]]", "[cable]", 3, &["found a table", "[[cable]]"]),
    ("density = 1100.0", "density = 1100,0", 8, &["not TOML"]),
    ("name = \"rope\"", "name = rope", 4, &["string values must be quoted"]),
    // something else than what is meant
    ("body = \"load\"", "body = \"laod\"", 19, &["no body is named \"laod\"", "Did you mean \"load\"?"]),
    ("at = \"end\"", "at = 2.5", 18, &["2.5 m is not on the cable, which is 2 m long"]),
    ("anchor = [0.0, 0.1, 0.0]", "anchor = [2.0, 0.0, 0.0]", 20, &["was one of the world meant?"]),
    ("mass = 10.0", "mass = 10.0\nrotation = [0, 0, 90]", 21, &["rotated by 90 rad; were degrees meant?"]),
    ("mass = 10.0\n", "", 10, &["missing key `mass`"]),
    ("mass = 10.0", "mass = -10.0", 12, &["mass: -10 is out of range", "> 0, in kg"]),
];

#[test]
fn the_first_line_says_the_cause() {
    all_are_errors(GOOD, MISTAKES);
}
