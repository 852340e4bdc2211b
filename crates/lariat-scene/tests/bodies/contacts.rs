//! Bodies that are in contact while cables pull them, in scenes: any mass, host step, fidelity, number of solver iterations.

use super::results::Results;

/// How a scene is run.
#[derive(Clone, Copy, Debug)]
struct Setting {
    rate: u32,
    iterations: u32,
    fidelity: &'static str,
}

const SETTINGS: [Setting; 4] = [
    Setting { rate: 30, iterations: 4, fidelity: "game" },
    Setting { rate: 60, iterations: 1, fidelity: "engineering" },
    Setting { rate: 120, iterations: 4, fidelity: "engineering" },
    Setting { rate: 240, iterations: 1, fidelity: "game" },
];

const GRAVITY: f64 = 9.81;

impl Setting {
    /// Returns a scene of a floor at y = 0 with the angle of friction of `friction`, and more tables.
    fn scene(&self, gravity: [f64; 3], friction: f64, rest: &str) -> String {
        let Setting { rate, iterations, .. } = self;
        format!(
            "duration = 4.5\ndt = {}\nsolver_iterations = {iterations}\ngravity = {gravity:?}\n[[body]]\nname = \"floor\"\n\
             kind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\nfriction = {friction:?}\n{rest}",
            1.0 / f64::from(*rate)
        )
    }

    /// Returns a light rope of six elements with internal damping, held at both ends: each a body and its anchor.
    fn rope(&self, name: &str, ends: [([f64; 3], &str, [f64; 3]); 2], stiffness: f64, mass: f64) -> String {
        let [(from, one, at), (to, two, there)] = ends;
        format!(
            "[[cable]]\nname = \"{name}\"\npoints = [{from:?}, {to:?}]\nelements = 6\naxial_stiffness = {stiffness:?}\n\
             bending_stiffness = 1e-3\nmass_per_length = {mass:?}\ngravity_scale = 0.0\n\
             integrator = {{ fidelity = \"{}\" }}\ndamping = {{ axial = 5e-3, bending = 0.02 }}\n\
             [[attachment]]\nname = \"{name}-start\"\ncable = \"{name}\"\nat = \"start\"\nbody = \"{one}\"\nanchor = {at:?}\n\
             [[attachment]]\nname = \"{name}-end\"\ncable = \"{name}\"\nat = \"end\"\nbody = \"{two}\"\nanchor = {there:?}\n\
             [[probe]]\nname = \"{name}\"\nattachment = \"{name}-start\"\n",
            self.fidelity
        )
    }
}

/// Returns a box that is 0.4 m long and 0.2 m high, on the floor.
fn block(name: &str, x: f64, mass: f64, friction: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nshape = {{ cuboid = [0.2, 0.1, 0.2] }}\nmass = {mass:?}\nposition = [{x:?}, 0.1, 0.0]\n\
         friction = {friction:?}\n"
    )
}

/// Returns a kinematic body that rests for 0.5 s, and then moves by `way` until 3.5 s.
fn winch(from: [f64; 3], way: [f64; 3]) -> String {
    let [x, y, z] = from;
    let to = [x + way[0], y + way[1], z + way[2]];
    format!(
        "[[body]]\nname = \"winch\"\nkind = \"kinematic\"\nshape = \"none\"\npath = [[0.0, {x:?}, {y:?}, {z:?}], \
         [0.5, {x:?}, {y:?}, {z:?}], [4.5, {:?}, {:?}, {:?}]]\n",
        to[0], to[1], to[2]
    )
}

/// Asserts that a component of the force of a probe in the last third of a run is on average within `within` of `expected`.
fn check(results: &Results, probe: &str, axis: usize, expected: f64, within: f64, case: &str) {
    let rows = results.rows(probe);
    let last: Vec<f64> = rows[rows.len() * 2 / 3..].iter().map(|row| row[1 + axis]).collect();
    let mean = last.iter().sum::<f64>() / last.len() as f64;
    assert!((mean / expected - 1.0).abs() < within, "{probe}: {mean} N of {expected}: {case}");
}

/// Boxes in a row that ropes tow over a floor: each rope carries the friction of all boxes behind it.
///
/// Reference: Coulomb's law, `mu g` times the sum of their masses.
#[test]
fn ropes_of_a_towed_row_carry_the_friction_behind_them() {
    let rows = [
        (&[17.0, 0.6][..], 0.45, 0.06),
        (&[2.0, 38.0], 0.36, 0.2),
        (&[12.5, 5.6, 6.6], 0.23, 0.3),
        (&[1.0, 14.0, 48.0], 0.53, 0.15),
    ];
    for (setting, (masses, friction, speed)) in SETTINGS.into_iter().zip(rows) {
        let case = format!("{setting:?}, {masses:?} kg, friction {friction}");
        let drag = friction * GRAVITY * masses.iter().sum::<f64>();
        let mut tables = String::new();
        for (k, &mass) in masses.iter().enumerate() {
            let x = 1.2 * k as f64;
            tables += &block(&format!("box{k}"), x, mass, friction);
            let next = format!("box{}", k + 1);
            let other = if k + 1 < masses.len() { (&next[..], [-0.2, 0.0, 0.0]) } else { ("winch", [0.0; 3]) };
            let ends = [
                ([x + 0.2, 0.1, 0.0], &format!("box{k}")[..], [0.2, 0.0, 0.0]),
                ([x + 1.0, 0.1, 0.0], other.0, other.1),
            ];
            tables += &setting.rope(
                &format!("rope{k}"),
                ends,
                300.0 * drag,
                2e-3 * masses.iter().copied().fold(f64::MAX, f64::min),
            );
        }
        tables += &winch([1.2 * masses.len() as f64 - 0.2, 0.1, 0.0], [4.0 * speed, 0.0, 0.0]);
        let results = Results::of_text("run", &setting.scene([0.0, -GRAVITY, 0.0], friction, &tables)).done();
        for k in 0..masses.len() {
            let expected = friction * GRAVITY * masses[..=k].iter().sum::<f64>();
            check(&results, &format!("rope{k}"), 0, expected, 0.01, &case);
        }
    }
}

/// A box that a rope pulls up a slope at constant speed.
///
/// Reference: `m g (sin a + mu cos a)`.
#[test]
fn a_rope_pulls_a_box_up_a_slope() {
    let cases = [(0.6, 0.22, 0.3, 0.06), (17.0, 0.57, 0.22, 0.13), (1.3, 0.19, 0.52, 0.19), (90.0, 0.4, 0.1, 0.3)];
    for (setting, (mass, friction, angle, speed)) in SETTINGS.into_iter().zip(cases) {
        let angle: f64 = angle;
        let expected = mass * GRAVITY * (angle.sin() + friction * angle.cos());
        let ends = [([0.2, 0.1, 0.0], "box", [0.2, 0.0, 0.0]), ([1.5, 0.1, 0.0], "winch", [0.0; 3])];
        let tables = block("box", 0.0, mass, friction)
            + &setting.rope("rope", ends, 2000.0 * expected, 1e-3 * mass)
            + &winch([1.5, 0.1, 0.0], [4.0 * speed, 0.0, 0.0]);
        let gravity = [-GRAVITY * angle.sin(), -GRAVITY * angle.cos(), 0.0];
        let results = Results::of_text("run", &setting.scene(gravity, friction, &tables)).done();
        check(
            &results,
            "rope",
            0,
            expected,
            0.01,
            &format!("{setting:?}, {mass} kg, friction {friction}, {angle} rad"),
        );
    }
}

/// A rope lifts one edge of a box, which tilts about the other by little.
///
/// Reference: moments about that edge: `m g (a cos f - b sin f)/(2 a cos f - 2 b sin f)`, half of the weight for every tilt f.
#[test]
fn a_rope_lifts_the_edge_of_a_box_with_half_its_weight() {
    for (setting, mass) in SETTINGS.into_iter().zip([14.0, 3.6, 0.6, 120.0]) {
        let ends = [([0.2, 0.2, 0.0], "box", [0.2, 0.1, 0.0]), ([0.2, 1.4, 0.0], "winch", [0.0; 3])];
        let tables = block("box", 0.0, mass, 1.0)
            + &setting.rope("rope", ends, 5000.0 * mass, 1e-3 * mass)
            + &winch([0.2, 1.4, 0.0], [0.0, 0.02, 0.0]);
        let results = Results::of_text("run", &setting.scene([0.0, -GRAVITY, 0.0], 1.0, &tables)).done();
        check(&results, "rope", 1, 0.5 * mass * GRAVITY, 0.01, &format!("{setting:?}, {mass} kg"));
    }
}
