//! Invalid joints.

use super::cases::{Case, all_are_accepted, all_are_errors};

/// Two links on the world; lines are numbered from 1.
const GOOD: &str = r#"duration = 1.0
[[cable]]
name = "tether"
points = [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0]]
axial_stiffness = 1e5
bending_stiffness = 0.0
mass_per_length = 0.1
[[body]]
name = "upper"
shape = "none"
mass = 1.0
inertia = [0.1, 0.1, 0.1]
[[body]]
name = "lower"
shape = "none"
mass = 1.0
inertia = [0.1, 0.1, 0.1]
[[body]]
name = "base"
kind = "fixed"
shape = "none"
[[joint]]
name = "shoulder"
kind = "hinge"
body = "upper"
to = "world"
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
multibody = true
[[joint]]
name = "elbow"
kind = "ball"
body = "lower"
to = "upper"
at = [0.5, 0.0, 0.0]
multibody = true
"#;

const CASES: &[Case] = &[
    ("kind = \"hinge\"", "kind = \"screw\"", 24, &["joint.shoulder.kind: unknown value \"screw\"", "\"slider\""]),
    ("kind = \"hinge\"\n", "", 22, &["missing key `kind`", "\"hinge\""]),
    ("body = \"upper\"", "body = \"arm\"", 25, &["joint.shoulder.body: no body is named \"arm\"", "upper | lower"]),
    ("body = \"upper\"", "body = \"base\"", 25, &["joint.shoulder.body", "not dynamic"]),
    ("to = \"world\"", "to = \"wall\"", 26, &["joint.shoulder.to: no body is named \"wall\""]),
    ("to = \"world\"", "to = \"upper\"", 26, &["joint.shoulder.to: the body would be joined to itself"]),
    ("at = [0.0, 0.0, 0.0]", "at = [0.0, inf, 0.0]", 27, &["joint.shoulder.at", "not finite"]),
    ("at = [0.0, 0.0, 0.0]", "at = \"end\"", 27, &["joint.shoulder.at", "in the world at t = 0"]),
    ("axis = [0.0, 0.0, 1.0]", "axis = [0.0, 0.0, 0.0]", 28, &["joint.shoulder.axis", "has no direction"]),
    ("axis = [0.0, 0.0, 1.0]\n", "", 22, &["joint.shoulder.axis: missing key", "for a hinge or a slider"]),
    ("kind = \"ball\"", "kind = \"ball\"\naxis = [0.0, 0.0, 1.0]", 33, &["joint.elbow.axis: a ball joint has no axis"]),
    ("name = \"elbow\"", "name = \"shoulder\"", 31, &["\"shoulder\" is taken"]),
    ("to = \"world\"", "to = \"lower\"", 34, &["joint.elbow.to: the links close a ring", "multibody = false"]),
    (
        "body = \"lower\"\nto = \"upper\"",
        "body = \"upper\"\nto = \"lower\"",
        33,
        &["joint.elbow.body: it is already a link after joint \"shoulder\""],
    ),
    ("inertia = [0.1, 0.1, 0.1]", "inertia = [0.1, 0.1, 0.1]\nvelocity = [1.0, 0.0, 0.0]", 26, &["start at rest"]),
    ("multibody = true", "multibody = 1", 29, &["joint.shoulder.multibody", "true | false"]),
    ("multibody = true", "stiffness = 1.0", 29, &["unknown key `stiffness`", "axis"]),
];

#[test]
fn errors_in_a_joint_name_line_key_and_accepted_values() {
    all_are_errors(GOOD, CASES);
}

#[test]
fn joints_may_be_of_every_kind() {
    all_are_accepted(
        GOOD,
        &[
            ("kind = \"hinge\"", "kind = \"slider\""),
            ("kind = \"ball\"", "kind = \"fixed\""),
            ("to = \"world\"", "to = \"base\""),
            ("multibody = true", ""),
            ("name = \"elbow\"\n", ""),
        ],
    );
}
