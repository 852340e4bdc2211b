//! Invalid junctions.

use super::cases::{Case, all_are_accepted, all_are_errors};

/// Two stays and a hanger that meet in a point; lines are numbered from 1.
const GOOD: &str = r#"duration = 1.0
[[cable]]
name = "left"
points = [[-1.0, 1.0, 0.0], [0.0, 0.0, 0.0]]
axial_stiffness = 1e5
bending_stiffness = 0.0
mass_per_length = 0.1
[[cable]]
name = "right"
points = [[1.0, 1.0, 0.0], [0.0, 0.0, 0.0]]
axial_stiffness = 1e5
bending_stiffness = 0.0
mass_per_length = 0.1
[[cable]]
name = "hanger"
points = [[0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]
axial_stiffness = 1e5
bending_stiffness = 0.0
mass_per_length = 0.1
[[attachment]]
name = "top"
cable = "left"
at = "start"
body = "world"
[[junction]]
name = "knot"
cable = "left"
at = "end"
other = "right"
other_at = "end"
[[junction]]
cable = "left"
at = "end"
other = "hanger"
other_at = "start"
"#;

const CASES: &[Case] = &[
    (
        "duration = 1.0",
        "duration = 1.0\nengine = \"none\"",
        26,
        &["junction.knot", "engine = \"none\" computes no junction"],
    ),
    (
        "cable = \"left\"\nat = \"end\"",
        "cable = \"middle\"\nat = \"end\"",
        27,
        &["no cable is named \"middle\"", "left | right"],
    ),
    ("other = \"right\"", "other = \"middle\"", 29, &["junction.knot.other: no cable is named \"middle\""]),
    ("other = \"right\"\n", "", 25, &["junction.knot.other: missing key `other`", "Name of the cable"]),
    ("other_at = \"end\"\n", "", 25, &["junction.knot.other_at: missing key `other_at`", "\"start\""]),
    ("other_at = \"end\"", "other_at = 9.0", 30, &["junction.knot.other_at: 9 m is not on the cable"]),
    ("other_at = \"end\"", "other_at = nan", 30, &["junction.knot.other_at: NaN is not finite"]),
    ("other_at = \"end\"", "other_at = \"top\"", 30, &["junction.knot.other_at", "unknown value \"top\""]),
    ("other_at = \"end\"", "other_at = 0.5", 30, &["the points start", "m apart", "within 1e-6 m"]),
    (
        "at = \"end\"\nother = \"right\"",
        "at = \"start\"\nother = \"right\"",
        28,
        &["attachment \"top\" already holds the cable there"],
    ),
    (
        "other = \"right\"\nother_at = \"end\"",
        "other = \"left\"\nother_at = \"end\"",
        30,
        &["the point would be tied to itself"],
    ),
    ("name = \"knot\"", "name = \"junction-1\"", 31, &["name: \"junction-1\" is taken"]),
    ("name = \"knot\"", "kind = \"ball\"", 26, &["unknown key `kind`", "other_at"]),
    (
        "",
        "[[junction]]\ncable = \"right\"\nat = \"end\"\nother = \"hanger\"\nother_at = \"start\"",
        36,
        &["already tie both points", "junction \"junction-1\""],
    ),
];

#[test]
fn errors_in_a_junction_name_line_key_and_accepted_values() {
    all_are_errors(GOOD, CASES);
}

#[test]
fn junctions_may_be_anywhere_on_a_cable_and_need_rapier() {
    all_are_accepted(GOOD, &[("duration = 1.0", "duration = 1.0\nengine = \"rapier\""), ("name = \"knot\"\n", "")]);
}
