//! Attachments to bodies: clamps, points between nodes, forces at rest.

use super::results::Results;

/// Returns a cantilever along x from the body `wall`, with more tables after it.
fn beam(wall: &str, rest: &str) -> String {
    format!(
        r#"
duration = 1.2
dt = 0.01
gravity = [0.0, -1.0, 0.0]
[[cable]]
name = "beam"
points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
elements = 8
axial_stiffness = 1.0e5
bending_stiffness = 10.0
mass_per_length = 0.1
[[attachment]]
name = "wall"
cable = "beam"
at = "start"
body = "{wall}"
kind = "clamp"
[[probe]]
name = "wall"
attachment = "wall"
[[probe]]
name = "tip"
cable = "beam"
at = "end"
{rest}
"#
    )
}

const POST: &str = r#"
[[body]]
name = "post"
kind = "fixed"
shape = "none"
position = [-0.5, 0.0, 0.0]
rotation = [0.0, 0.0, 0.4]
"#;

/// *Source.* `w L^2/2` and `w L` at the root, `w L^4/8EI` at the tip, of a beam under its own weight.
#[test]
fn a_clamp_on_a_fixed_body_is_a_clamp_to_the_world() {
    for command in ["static", "run"] {
        let world = Results::of_text(command, &beam("world", POST)).done();
        let body = Results::of_text(command, &beam("post", POST)).done();
        let same = |probe: &str, columns: std::ops::Range<usize>, within: f64| {
            assert_eq!(world.rows(probe).len(), body.rows(probe).len());
            for (a, b) in world.rows(probe).iter().zip(body.rows(probe)) {
                let off = columns.clone().map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
                assert!(off < within, "{command}: {probe} off by {off:.1e} at {} s: {a:?} {b:?}", a[0]);
            }
        };
        same("tip", 1..4, 1e-5);
        if command == "static" {
            same("wall", 1..8, 1e-9);
            let wall = body.last("wall");
            assert!((wall[2] / -0.1 - 1.0).abs() < 1e-6 && (wall[6] / -0.05 - 1.0).abs() < 1e-3, "{wall:?}");
            assert!((body.last("tip")[2] / -0.00125 - 1.0).abs() < 1e-3);
        }
    }
}

/// A mass of 1 kg clamped to the tip of the beam and released: it oscillates to twice the static deflection, and rotates with the
/// tip.
///
/// *Source.* Beam theory: `P L^3/3EI + w L^4/8EI` and `P L^2/2EI + w L^3/6EI`, twice; `w^2 = 3EI/((m + 33/140 w L) L^3)`.
#[test]
fn a_body_clamped_to_a_beam_rotates_with_its_end() {
    let tip = r#"
[[body]]
name = "tip"
shape = "none"
mass = 1.0
inertia = [1e-3, 1e-3, 1e-3]
position = [1.0, 0.0, 0.0]
rotation = [0.3, 0.0, 0.0]
[[attachment]]
name = "joint"
cable = "beam"
at = "end"
body = "tip"
kind = "clamp"
[[probe]]
name = "body"
body = "tip"
[[probe]]
name = "joint"
attachment = "joint"
"#;
    let results = Results::of_text("run", &beam("world", tip)).done();
    let rows = results.rows("body");
    let lowest = rows.iter().min_by(|a, b| a[2].total_cmp(&b[2])).unwrap();
    let (deflection, angle) = (2.0 * (1.0 / 30.0 + 0.1 / 80.0), 2.0 * (1.0 / 20.0 + 0.1 / 60.0));
    assert!((-lowest[2] / deflection - 1.0).abs() < 2e-2, "{} m of {deflection}", -lowest[2]);
    // attitude: 0.3 rad about the body's x, then the turn about z
    let turned = -2.0 * lowest[6].atan2(lowest[7]);
    assert!((turned / angle - 1.0).abs() < 2e-2, "{turned} rad of {angle}");
    let half_period = std::f64::consts::PI / (30.0f64 / (1.0 + 0.1 * 33.0 / 140.0)).sqrt();
    assert!((lowest[0] / half_period - 1.0).abs() < 3e-2, "{} s of {half_period}", lowest[0]);
    // at the end of the beam the tangent is the body's x for ever
    for (body, tip) in rows.iter().zip(results.rows("tip")) {
        let turned = 2.0 * body[6].atan2(body[7]);
        let off = (turned - tip[8].atan2(tip[7])).abs();
        assert!(off < 1e-6, "{off:.1e} rad at {} s", body[0]);
        assert!((1..4).all(|i| (body[i] - tip[i]).abs() < 1e-6), "{body:?} {tip:?}");
    }
    // force and moment on the body: m (a - g), I alpha, by differences of its velocities over two samples
    let joint = results.rows("joint");
    for k in (10..100).step_by(10) {
        let rate = |i: usize| (rows[k + 1][i] - rows[k - 1][i]) / 0.02;
        let (force, moment) = (rate(9) + 1.0, 1e-3 * rate(13));
        assert!((joint[k][2] - force).abs() < 5e-2, "{} N of {force} at {} s", joint[k][2], rows[k][0]);
        assert!((joint[k][6] - moment).abs() < 5e-3, "{} N m of {moment} at {} s", joint[k][6], rows[k][0]);
    }
}

/// A weight attached between two nodes stays at the cable.
#[test]
fn a_body_can_be_attached_at_any_arc_length() {
    let middle = r#"
[[body]]
name = "bead"
shape = "none"
mass = 0.5
position = [0.43, 0.0, 0.0]
[[attachment]]
name = "bead"
cable = "beam"
at = 0.43
body = "bead"
[[probe]]
name = "bead"
body = "bead"
[[probe]]
name = "there"
cable = "beam"
at = 0.43
"#;
    let results = Results::of_text("run", &beam("world", middle)).done();
    for (bead, there) in results.rows("bead").iter().zip(results.rows("there")) {
        assert!((1..4).all(|i| (bead[i] - there[i]).abs() < 1e-7), "{bead:?} {there:?}");
    }
    assert!(results.last("bead")[2] < -1e-4 && results.summary().max_gap_m < 1e-7);
}
