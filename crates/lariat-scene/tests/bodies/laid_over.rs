//! Statics of ropes that were drawn over something that stays where it is: they stay on that side.

use super::statics::{row, solve};
use lariat_scene::Warning;

/// Radius of the ropes in m.
const RADIUS: f64 = 0.006;

/// What a rope is drawn over, and what is at its ends.
#[derive(Clone, Copy, Debug)]
struct Laid {
    /// Radius of the drum in m; of a beam with sharp edges half its height.
    radius: f64,
    is_sharp: bool,
    section: &'static str,
    elements: usize,
    /// Mass in kg of the load at the end that hangs; without one the world holds it.
    load: Option<f64>,
    /// Shorter than it is drawn by a share.
    short: f64,
    winch: &'static str,
}

const DRUM: Laid = Laid {
    radius: 0.2,
    is_sharp: false,
    section: "wire_rope = 0.012",
    elements: 40,
    load: None,
    short: 1e-3,
    winch: "fixed",
};

impl Laid {
    /// The scene: from a winch 3 m beside the drum over its top, and 4 m down behind it.
    fn scene(&self) -> String {
        let Laid { radius, is_sharp, section, elements, load, short, winch } = *self;
        let over = radius + RADIUS;
        let arc: Vec<[f64; 2]> = if is_sharp {
            vec![[over - 1e-3, over], [over, over - 1e-3]]
        } else {
            let at = |k: usize| (k as f64 * std::f64::consts::FRAC_PI_2 / 16.0).sin_cos();
            (0..=16).map(|k| [over * at(k).0, over * at(k).1]).collect()
        };
        let points: Vec<[f64; 2]> = [[-3.0, over]].into_iter().chain(arc).chain([[over, -4.0]]).collect();
        let drawn: f64 = points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
        let points = points.iter().map(|p| format!("[{}, {}, 0.0]", p[0], p[1])).collect::<Vec<_>>().join(", ");
        let shape = if is_sharp {
            format!("cuboid = [{radius}, {radius}, 0.5]")
        } else {
            format!("cylinder = [0.5, {radius}]")
        };
        let turned = if is_sharp { "" } else { "rotation = [1.5707963267948966, 0.0, 0.0]\n" };
        let (body, end) = match load {
            Some(mass) => (
                format!(
                    "[[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = {mass}\nposition = [{over}, -4.1, 0.0]\n"
                ),
                "body = \"load\"\nanchor = [0.0, 0.1, 0.0]\n",
            ),
            None => (String::new(), "body = \"world\"\n"),
        };
        let material = if section.starts_with("round") { "youngs_modulus = 1.0e9\ndensity = 1100.0\n" } else { "" };
        format!(
            "[[body]]\nname = \"drum\"\nkind = \"fixed\"\nshape = {{ {shape} }}\n{turned}friction = 0.2\n[[body]]\nname = \"winch\"\nkind = {winch:?}\n\
             shape = \"none\"\nposition = [-3.0, {over}, 0.0]\n{body}[[cable]]\nname = \"rope\"\npoints = [{points}]\nlength = {}\nelements = {elements}\n\
             section = {{ {section} }}\n{material}contact = {{ friction = 0.2, radius = {RADIUS} }}\n[[attachment]]\nname = \"pull\"\ncable = \"rope\"\nat = \"start\"\n\
             body = \"winch\"\n[[attachment]]\nname = \"hook\"\ncable = \"rope\"\nat = \"end\"\n{end}[[probe]]\nname = \"pull\"\nattachment = \"pull\"\n\
             [[probe]]\nname = \"hook\"\nattachment = \"hook\"\n[[probe]]\nname = \"middle\"\ncable = \"rope\"\nat = 3.0\n",
            drawn * (1.0 - short)
        )
    }

    /// Returns the pulls in N at the winch and at the load, the height in m of the rope above the drum, and whether its bend is told to need
    /// more elements.
    fn rest(&self) -> Result<([f64; 3], bool), lariat_scene::Error> {
        let (summary, probes) = solve(&self.scene())?;

        let pull = |k: usize| row(&probes[k])[1..4].iter().map(|x| x * x).sum::<f64>().sqrt();
        let coarse = |w: &Warning| matches!(w, Warning::Cable(lariat_ancf::Warning::CoarseContact { .. }));
        Ok(([pull(0), pull(1), row(&probes[2])[2]], summary.warnings.iter().any(coarse)))
    }
}

/// Largest ratio of the pulls that friction holds over a right angle.
fn capstan() -> f64 {
    (0.2 * std::f64::consts::FRAC_PI_2).exp()
}

/// Over a drum the rope lies where it was drawn. Where elements are shorter than the radius it pulls with the same force at both ends but for its
/// weight: held or loaded, whatever its stiffness, mesh and drum. Others end with what friction may hold, or are refused by name.
///
/// *Source.* Contact without friction takes no force along the rope; a rope that hangs pulls with its weight more above; Euler and Eytelwein.
#[test]
fn a_rope_stays_on_the_side_on_which_it_was_drawn() {
    let sections = ["wire_rope = 0.012", "round = 0.012"];
    let mut failed = Vec::new();
    for (radius, elements) in [(0.05, 80), (0.2, 20), (0.2, 40), (0.2, 160), (0.5, 40), (1.0, 30)] {
        for section in sections {
            for load in [None, Some(50.0), Some(500.0)] {
                for winch in ["fixed", "kinematic"] {
                    let laid = Laid { radius, elements, section, load, winch, ..DRUM };
                    let is_fine = 7.4 / elements as f64 <= radius;
                    let ([pull, hook, middle], _) = match laid.rest() {
                        Ok(found) => found,
                        Err(error) if is_fine => panic!("{laid:?}: {error}"),
                        Err(error) => {
                            println!("{laid:?}: {error}");
                            continue;
                        }
                    };
                    println!("{laid:?}: {pull:.1} and {hook:.1} N, {middle:.3} m");
                    let weight = 9.81 * 0.6 * (4.0 + radius) / hook;
                    let ratio = (pull / hook).max(hook / pull);
                    let most = weight + if is_fine { 1.02 } else { 1.1 * capstan() };
                    // what friction holds leaves the load where it is
                    let known = load.is_none_or(|mass| (hook / (9.81 * mass) - 1.0).abs() < 1e-4);
                    if !(ratio < most && known && middle > 0.5 * radius) {
                        failed.push(format!("{laid:?}: {pull} and {hook} N, {middle} m"));
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Over a sharp edge statics without friction have no law along the rope: what they find is refused, and it comes to rest by its motion, with a
/// force within the friction of a bend by a right angle, or it is told that the bend needs more elements. It never ends beyond the edge.
///
/// *Source.* Euler and Eytelwein: exp(mu pi/2).
#[test]
fn a_rope_over_a_sharp_edge_holds_no_more_than_friction() {
    for (radius, elements, mass) in [(0.2, 20, 500.0), (0.2, 40, 50.0), (0.1, 60, 500.0), (0.2, 120, 200.0)] {
        let laid = Laid { radius, elements, load: Some(mass), is_sharp: true, ..DRUM };
        match laid.rest() {
            Ok(([pull, hook, middle], is_coarse)) => {
                println!("{laid:?}: {pull:.1} and {hook:.1} N, {middle:.3} m");
                let ratio = (pull / hook).max(hook / pull);
                assert!(middle > 0.9 * radius, "{laid:?}: {middle} m");
                assert!(ratio < 1.1 * capstan() || is_coarse, "{laid:?}: {pull} and {hook} N");
            }
            Err(error) => {
                println!("{laid:?}: {error}");
                let words = ["sharp edge", "run through"];
                assert!(words.iter().any(|word| error.to_string().contains(word)), "{error}");
            }
        }
    }
}
