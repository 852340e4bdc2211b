//! Ropes over sharp edges and facets without friction: what is not as over the smooth body is told.

use lariat_ancf::Warning as OfCable;
use lariat_scene::run::{Options, Recording, collect};
use lariat_scene::{Purpose, Scene, Warning};
use std::f64::consts::{PI, TAU};
use std::path::Path;

const G: f64 = 9.81;

fn run(text: &str) -> Recording {
    let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let run = collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(run.failed.is_none(), "{:?}", run.failed);
    run
}

/// Returns the rows of a probe: times, and a column.
fn rows(run: &Recording, column: &str) -> Vec<[f64; 2]> {
    let probe = &run.probes[0];
    let at = |name: &str| probe.columns.iter().position(|c| *c == name).unwrap();
    let (t, x) = (at("t"), at(column));
    probe.rows.chunks(probe.columns.len()).map(|row| [row[t], row[x]]).collect()
}

/// Returns whether it says that its contact is not right.
fn is_told(run: &Recording) -> bool {
    run.summary.warnings.iter().any(|warning| {
        matches!(
            warning,
            Warning::EnergyLost { .. }
                | Warning::Cable(
                    OfCable::Facets { .. }
                        | OfCable::CutShort { .. }
                        | OfCable::CoarseContact { .. }
                        | OfCable::PassedThrough { .. }
                )
        )
    })
}

/// Returns the larger one; NaN if one is.
fn larger(most: f64, x: f64) -> f64 {
    if x <= most { most } else { x }
}

fn is_long() -> bool {
    std::env::var_os("LARIAT_LONG_TESTS").is_some()
}

/// A limp chain of 2 m and 1 kg/m that lies over the edge of a table, of which a length in m hangs.
fn chain(elements: usize, rate: f64, radius: f64, hangs: f64) -> String {
    let lies = 2.0 - hangs - 0.4 * radius;
    let round = 0.5f64.sqrt() * radius;
    format!(
        "duration = 0.4\n[[body]]\nname = \"table\"\nkind = \"fixed\"\nshape = {{ cuboid = [2.0, 0.5, 0.5] }}\nposition = [-2.0, -0.5, 0.0]\nfriction = 0.0\n\
         [[cable]]\nname = \"chain\"\npoints = [[{:?}, {radius:?}, 0.0], [0.0, {radius:?}, 0.0], [{round:?}, {round:?}, 0.0], [{radius:?}, 0.0, 0.0],\n\
         [{radius:?}, {:?}, 0.0]]\nelements = {elements}\naxial_stiffness = 1e5\nbending_stiffness = 1e-3\nmass_per_length = 1.0\n\
         integrator = {{ method = \"discrete-gradient\", max_step = {:?} }}\ncontact = {{ radius = {radius:?}, friction = 0.0 }}\n\
         [[probe]]\nname = \"tail\"\ncable = \"chain\"\nat = \"start\"\n",
        -lies,
        -hangs + 0.4 * radius,
        1.0 / rate
    )
}

/// A chain that slides off a table over its sharp edge does as the chain that nothing brakes, or tells.
///
/// *Source.* Newton's second law, `L x'' = g x` for the length x that hangs: it grows by `x_0 (cosh(t sqrt(g/L)) - 1)`, as long as the chain
/// presses on the edge, `2 x^2 - L x <= x_0^2`.
#[test]
fn a_chain_off_a_sharp_edge_falls_as_its_cosh_or_tells() {
    let cases = [
        (80, 240.0, 0.02, 0.5),
        (60, 240.0, 0.03, 0.4),
        (40, 240.0, 0.02, 0.5),
        (80, 240.0, 0.01, 0.7),
        (160, 480.0, 0.005, 0.5),
    ];
    for (elements, rate, radius, hangs) in cases.into_iter().take(if is_long() { 5 } else { 3 }) {
        let run = run(&chain(elements, rate, radius, hangs));
        let rows = rows(&run, "x");
        let way = |t: f64| hangs * ((t * (G / 2.0).sqrt()).cosh() - 1.0);
        let of = |row: &[f64; 2]| (row[1] - rows[0][1]) / way(row[0]) - 1.0;
        let worst = rows.iter().filter(|row| row[0] > 0.15).map(|row| of(row).abs()).fold(0.0, larger);
        println!("{elements} elements, {rate} Hz, {radius} m: off by {worst:.3}, {:?}", run.summary.told.len());
        assert!(worst < 0.02 || is_told(&run), "{worst}: {:?}", run.summary.told);
    }
}

/// A cylinder of some sides along z as an OBJ file.
fn prism(folder: &Path, sides: usize, radius: f64) -> String {
    let point = |k: usize, z: f64| {
        let angle = TAU * k as f64 / sides as f64;
        format!("v {} {} {z}\n", radius * angle.cos(), radius * angle.sin())
    };
    let mut text: String = (0..sides).flat_map(|k| [point(k, -0.3), point(k, 0.3)]).collect();
    for k in 0..sides {
        let (a, b) = (2 * k + 1, 2 * ((k + 1) % sides) + 1);
        text += &format!("f {a} {b} {}\nf {a} {} {}\n", b + 1, b + 1, a + 1);
    }
    let path = folder.join(format!("prism_{sides}.obj"));
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// Two loads over a drum that does not turn, of a shape.
fn atwood(shape: &str, turned: bool, [heavy, light]: [f64; 2], elements: usize, mass: f64) -> String {
    let (lever, count) = (0.105, 24);
    let at = |k: usize| (PI * (1.0 - k as f64 / count as f64)).sin_cos();
    let arc: Vec<[f64; 3]> = (0..=count).map(|k| [lever * at(k).1, lever * at(k).0, 0.0]).collect();
    let points: Vec<[f64; 3]> = [[-lever, -0.6, 0.0]].into_iter().chain(arc).chain([[lever, -0.6, 0.0]]).collect();
    let rotation = if turned { "rotation = [1.5707963267948966, 0.0, 0.0]\n" } else { "" };
    let load = |name: &str, mass: f64, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ cuboid = [0.05, 0.05, 0.05] }}\nmass = {mass:?}\nposition = [{x:?}, -0.65, 0.0]\n"
        )
    };
    let end = |at: &str, body: &str| {
        format!("[[attachment]]\ncable = \"rope\"\nat = \"{at}\"\nbody = \"{body}\"\nanchor = [0.0, 0.05, 0.0]\n")
    };
    format!(
        "duration = 0.6\n[[body]]\nname = \"drum\"\nkind = \"fixed\"\nshape = {shape}\n{rotation}friction = 0.0\n{}{}[[cable]]\nname = \"rope\"\n\
         points = {points:?}\nelements = {elements}\naxial_stiffness = 1e5\nbending_stiffness = 1e-3\nmass_per_length = {mass:?}\n\
         damping = {{ axial = 1e-3, bending = 1e-3 }}\nintegrator = {{ fidelity = \"game\" }}\ncontact = {{ radius = 0.005, friction = 0.0 }}\n{}{}\
         [[probe]]\nname = \"heavy\"\nbody = \"heavy\"\n",
        load("heavy", heavy, -lever),
        load("light", light, lever),
        end("start", "heavy"),
        end("end", "light")
    )
}

/// Loads over a drum that is a mesh of facets fall as over the cylinder, or tell.
///
/// *Source.* `(m_1 - m_2) g/(m_1 + m_2 + m_rope)` (Atwood).
#[test]
fn loads_over_facets_fall_as_over_the_cylinder_or_tell() {
    let folder = tempfile::tempdir().unwrap();
    let round = ("{ cylinder = [0.3, 0.1] }".to_string(), true);
    let mesh = |sides: usize| (format!("{{ mesh = {:?} }}", prism(folder.path(), sides, 0.1)), false);
    let shapes = [round, mesh(6), mesh(12), mesh(24), mesh(48), mesh(96)];
    for (loads, elements, mass) in
        [([3.0, 2.0], 40, 0.01), ([10.0, 5.0], 60, 0.02)].into_iter().take(if is_long() { 2 } else { 1 })
    {
        for (shape, turned) in &shapes {
            let run = run(&atwood(shape, *turned, loads, elements, mass));
            let rows = rows(&run, "y");
            let exact = (loads[0] - loads[1]) * G / (loads[0] + loads[1] + mass * (1.2 + PI * 0.105));
            // before the light one comes up to the drum
            let last = rows.iter().rev().find(|row| 0.5 * exact * row[0].powi(2) < 0.4).unwrap();
            let fall = 2.0 * (rows[0][1] - last[1]) / last[0].powi(2);
            let off = fall / exact - 1.0;
            println!("{loads:?} kg over {shape}: {fall:.3} of {exact:.3} m/s^2, told {}", is_told(&run));
            let may = *turned || !is_told(&run);
            assert!(off.abs() < 0.02 || !may, "{shape}: {off}: {:?}", run.summary.told);
        }
    }
}
