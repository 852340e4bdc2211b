//! Attachments on a face, beside which a stiff cable lies its radius above the face.

use super::warned;
use lariat_ancf::Warning as OfCable;
use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene, Warning};

/// Grounds with their top at -2.5 m.
const GROUNDS: [&str; 2] = [
    "shape = { plane = [0.0, 1.0, 0.0] }\nposition = [0.0, -2.5, 0.0]",
    "shape = { cuboid = [20.0, 0.5, 20.0] }\nposition = [0.0, -3.0, 0.0]",
];

/// A crate on a ground with a rope from above to a hook on its top, whose slack lies beside it: radius in m, bending stiffness in N m^2, height
/// of the anchor above the face in m, friction.
fn crate_on(
    ground: &str,
    [radius, stiffness, above, friction]: [f64; 4],
    elements: usize,
    duration: f64,
    hook: &str,
) -> String {
    let top = -2.3 + above;
    format!(
        "duration = {duration:?}\n[[body]]\nname = \"ground\"\nkind = \"fixed\"\n{ground}\nfriction = 0.5\n\
         [[body]]\nname = \"load\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = 10.0\nposition = [1.5, -2.4, 0.0]\nfriction = 0.5\n\
         [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [1.5, {top:?}, 0.0]]\nlength = 3.446\nelements = {elements}\naxial_stiffness = 2e5\n\
         bending_stiffness = {stiffness:?}\nmass_per_length = 0.1\nintegrator = {{ fidelity = \"game\" }}\ndamping = {{ axial = 0.005, bending = 0.03 }}\n\
         contact = {{ radius = {radius:?}, friction = {friction:?} }}\n[[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\nname = \"hook\"\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, {anchor:?}, 0.0]\n{hook}\
         [[probe]]\nname = \"hook\"\nattachment = \"hook\"\n",
        anchor = 0.1 + above
    )
}

fn crate_below(rope: [f64; 4], elements: usize, duration: f64) -> String {
    crate_on(GROUNDS[0], rope, elements, duration, "")
}

/// Runs a scene; returns by how much the rope pulls the hook upwards in the last fifth, on the mean, in N, and by how much it is told to pry.
fn pull(text: &str) -> (f64, Option<f64>) {
    pull_for(text, Purpose::Run)
}

/// As [`pull`], of the equilibrium of a scene where the purpose is that.
fn pull_for(text: &str, purpose: Purpose) -> (f64, Option<f64>) {
    let scene = Scene::parse("scene.toml", text, &[], purpose).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let solve = if purpose == Purpose::Static { run::statics } else { run::run };
    let summary = solve(&scene, folder.path(), &mut Options::default()).unwrap();
    let rows = std::fs::read_to_string(folder.path().join("probes/hook.csv")).unwrap();
    let force = |row: &str| -> f64 { row.split(',').nth(2).unwrap().parse().unwrap() };
    let forces: Vec<f64> = rows.lines().skip(1).map(force).collect();
    let last = &forces[forces.len() * 4 / 5..];
    let pried = summary.warnings.iter().find_map(|warning| match warning {
        Warning::Cable(OfCable::PriedAttachment { force_n, .. }) => Some(*force_n),
        _ => None,
    });
    (last.iter().sum::<f64>() / last.len() as f64, pried)
}

/// A hook on a face pries a stiff rope up over its radius, the more the finer the mesh, and says by how much; a radius above the face it reads the
/// same on every mesh, and says nothing, as does a limp rope on the face. Without friction, which would leave the forces undetermined.
///
/// *Source.* The same scene on other meshes, and with the anchor where the rope lies.
#[test]
fn a_hook_on_a_face_says_that_it_pries() {
    for [radius, stiffness] in [[0.01, 0.05], [0.008, 0.1]] {
        let above = [16, 48].map(|elements| pull(&crate_below([radius, stiffness, radius, 0.0], elements, 10.0)));
        let on = [16, 48].map(|elements| pull(&crate_below([radius, stiffness, 0.0, 0.0], elements, 10.0)));
        println!("{radius} m, {stiffness} N m^2: above {above:?}, on {on:?}");
        let right = 0.5 * (above[0].0 + above[1].0);
        for (force, pried) in above {
            assert!((force - right).abs() < 0.07 * right && pried.is_none(), "{force} N for {right}, {pried:?}");
        }
        for (force, pried) in on {
            assert!(pried.is_some_and(|pried| (force - right).abs() < 1.5 * pried), "{force} N for {right}, {pried:?}");
        }
    }
    let (_, pried) = pull(&crate_below([0.01, 2e-4, 0.0, 0.0], 48, 10.0));
    assert_eq!(pried, None);
}

/// The equilibrium of a crate on the ground, whose slack lies beside it, is on each ground and mesh the one in which a run stays, and bears the
/// hook as one that came to rest: the rope is laid outside of the crate first, as in a run. Without friction the slack lies elsewhere each
/// time, and the force is 7 % another.
///
/// *Source.* Newton's first law; the run, after 10 s.
#[test]
fn a_crate_with_slack_beside_it_is_in_equilibrium() {
    for [radius, stiffness] in [[0.01, 0.05], [0.008, 0.1], [0.006, 0.02]] {
        let rope = [radius, stiffness, radius, 0.0];
        for (ground, elements) in [(GROUNDS[0], 16), (GROUNDS[1], 16), (GROUNDS[0], 48), (GROUNDS[1], 30)] {
            let scene = |duration: f64| crate_on(ground, rope, elements, duration, "");
            let (run, (found, pried)) = (pull(&scene(10.0)).0, pull_for(&scene(1.0), Purpose::Static));
            let stays = pull(&format!("initial = \"equilibrium\"\n{}", scene(5.0))).0;
            println!("{radius} m, {elements} elements: {found} N, stays {stays} N, comes to rest {run} N");
            assert!((found - stays).abs() < 2e-3 * found.abs() && pried.is_none(), "{found} and {stays} N, {pried:?}");
            assert!((found - run).abs() < 0.1 * run.abs(), "{found} N for {run}");
        }
    }
}

/// An equilibrium that lies inside the crate to which it is attached is told: it is clamped into the face.
///
/// *Source.* The direction of the clamp.
#[test]
fn a_rope_within_its_crate_in_equilibrium_is_told() {
    for elements in [16, 48] {
        let into = "kind = \"clamp\"\ndirection = [0.0, 1.0, 0.0]\n";
        let scene = crate_on(GROUNDS[0], [0.01, 0.05, 0.0, 0.4], elements, 1.0, into);
        let told = warned(&scene, Purpose::Static);
        let inside = told.iter().any(|w| matches!(w, Warning::StartsInside { body, own: true, .. } if body == "load"));
        assert!(inside, "{told:?}");
    }
}
