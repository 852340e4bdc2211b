//! Errors that are asked of tensions and moments, and kinks.
//!
//! # Scenes
//!
//! - A cable between level clamps, 20 m at 13.5 kN with EI 10 N m^2 and 50 m at 103 kN with EI 1000 N m^2: its clamp bends it within
//!   `sqrt(EI/T)`, 0.027 and 0.099 m. The moment there is that of the beam, `EI y'''' - T y'' = -w`.
//! - A cable of 11 m between pins 10 m apart with a force of 100 N at 4 m: five points of it, against two elastic catenaries without EI,
//!   and with it against 640 elements that are 2 mm long at the load. `T` is 120 N, about that beside the load; `h` an element of eight.

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Format, Table, shown};
use lariat_ancf::study::{Quantity, Target};
use lariat_scene::run::{self, World};
use lariat_scene::scene::{Purpose, Scene};

/// Title of the section.
pub const TITLE: &str = "Moments that are asked for, and kinks";

/// Length, tension, EA, EI and mass per length of the taut cables.
const TAUT: [[f64; 5]; 2] = [[20.0, 13.5e3, 1e8, 10.0, 2.0], [50.0, 103e3, 4e8, 1000.0, 8.0]];
/// Shares of the moment that are asked for.
const ASKED: [f64; 4] = [0.1, 0.05, 0.02, 0.005];
/// Elements of the loaded cable.
const ELEMENTS: [usize; 5] = [2, 4, 8, 16, 32];
/// sqrt(EI/T) over the length of an element of eight.
const SHARES: [f64; 7] = [0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
/// Its length, where the force is, the points that are compared, and the tension there in N.
const LENGTH: f64 = 11.0;
const LOADED: f64 = 4.0;
const POINTS: [f64; 5] = [1.0, 2.5, LOADED, 6.0, 9.0];
const TENSION: f64 = 120.0;

/// Returns the row of a taut cable whose moment is asked for.
fn taut([length, tension, ea, ei, mass]: [f64; 5], asked: f64) -> Result<Vec<Cell>, Error> {
    let own = length / (1.0 + tension / ea);
    let mut text = format!(
        "[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [{length:?}, 0.0, 0.0]]\nlength = {own:?}\naxial_stiffness = {ea:?}\n\
         bending_stiffness = {ei:?}\nmass_per_length = {mass:?}\n"
    );
    for at in ["start", "end"] {
        text += &format!("[[attachment]]\ncable = \"line\"\nat = \"{at}\"\nbody = \"world\"\nkind = \"clamp\"\n");
    }
    let scene = Scene::parse("taut", &text, &[], Purpose::Static)?;
    let target = Target::share(Quantity::Moment, asked);
    let run = run::collect(&scene, Purpose::Static, &mut run::Options { error: Some(target), ..Default::default() })?;
    let claim = run.summary.error.map(|error| error.claim);
    let world = run.world;
    let cable = world.cables()[0];
    let carried = cable.sample(0.5 * cable.length()).map_err(Error::from)?.tension;
    let k = (carried / ei).sqrt();
    let half = 0.5 * k * length;
    let expected = 9.81 * mass * length / (2.0 * k) * (1.0 / half.tanh() - 1.0 / half);
    let read = cable.sample(0.0).map_err(Error::from)?.moment.norm();
    Ok(vec![
        format!("{length} m at {} kN", tension / 1e3).into(),
        (100.0 * asked).into(),
        claim.as_ref().and_then(|claim| claim.forces.as_ref()?.claimed).map(|claimed| 100.0 * claimed).into(),
        (100.0 * (read / expected - 1.0).abs()).into(),
        cable.elements().len().into(),
        claim.map(|claim| claim.runs).into(),
    ])
}

/// Returns the five points of the loaded cable.
fn loaded(elements: &str, kinks: &str, bending: f64) -> Result<Vec<[f64; 3]>, Error> {
    let text = format!(
        "engine = \"rapier\"\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [3.6, -2.0, 0.0], [10.0, 0.0, 0.0]]\nlength = {LENGTH:?}\n\
         elements = {elements}\naxial_stiffness = 1e5\nbending_stiffness = {bending:?}\nmass_per_length = 1.0\n{kinks}\
         [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\nanchor = [0.0, 0.0, 0.0]\n\
         [[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\nanchor = [10.0, 0.0, 0.0]\n\
         [[load]]\ncable = \"line\"\nat = {LOADED:?}\nforce = [0.0, -100.0, 0.0]\n"
    );
    let scene = Scene::parse("loaded", &text, &[], Purpose::Static)?;
    let mut world = World::build(&scene)?;
    world.start(Purpose::Static)?;
    let place = |s: &f64| {
        let (part, s) = world.part(0, *s);
        Ok(world.cables()[part].sample(s).map_err(Error::from)?.position.into())
    };
    POINTS.iter().map(place).collect()
}

/// Returns the largest distance of points in m.
fn off(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    a.iter().zip(b).map(distance).fold(0.0, f64::max)
}

/// What is done about the corner at the load.
#[derive(Clone, Copy)]
enum Corner {
    /// A kink.
    Kink,
    /// What statics choose: elements of `2 sqrt(EI/T)` at the load, or a kink.
    Auto,
    /// Nothing.
    Even,
}

/// Returns the row of the loaded cable.
fn row(share: f64, corner: Corner) -> Result<Vec<Cell>, Error> {
    let layer = share * LENGTH / 8.0;
    let bending = TENSION * layer.powi(2);
    let kink = format!("kinks = [{LOADED:?}]\n");
    let exact = match share {
        0.0 => loaded("2048", &kink, 0.0)?,
        _ => loaded(&format!("{{ count = 640, finest = 0.002, at = [{LOADED:?}] }}"), "", bending)?,
    };
    let with = |n: &usize| {
        let (mesh, key) = match corner {
            Corner::Kink => (n.to_string(), &kink[..]),
            Corner::Auto => (format!("{{ count = {n}, finest = \"auto\" }}"), ""),
            Corner::Even => (n.to_string(), ""),
        };
        Ok(off(&loaded(&mesh, key, bending)?, &exact))
    };
    let errors: Vec<f64> = ELEMENTS.iter().map(with).collect::<Result<_, Error>>()?;
    let corner = match corner {
        Corner::Kink => "kink",
        Corner::Auto => "auto",
        Corner::Even => "even",
    };
    let mut cells: Vec<Cell> = vec![share.into(), corner.into()];
    cells.extend(errors.iter().map(|error| Cell::from(*error)));
    cells.push((0.5 * (errors[1] / errors[3]).log2()).into());
    Ok(cells)
}

/// Measures the section.
///
/// # Errors
/// [`Error::Scene`].
pub fn section(options: &Options) -> Result<Section, Error> {
    let (n, e1) = (Format::Plain, Format::Scientific(1));
    let mut section = Section::new(TITLE);
    let mut rows = Vec::new();
    for cable in TAUT {
        for asked in options.rungs(&ASKED) {
            rows.push(taut(cable, *asked)?);
        }
    }
    section.text(
        "`lariat static --error moment=5%` of a cable between level clamps: what is claimed about the moment there, what is true (against the \
         beam under tension), and the elements of the mesh, which is fine at the clamps.",
    );
    let columns = vec![
        shown("cable", "cable", n),
        shown("asked_percent", "asked %", Format::Fixed(1)),
        shown("claimed_percent", "claimed %", Format::Fixed(2)),
        shown("true_percent", "true %", Format::Fixed(2)),
        shown("elements", "elements", n),
        shown("runs", "runs", n),
    ];
    section.table(Table { name: "moments", columns, rows });
    let mut rows = Vec::new();
    for share in options.rungs(&SHARES) {
        for corner in [Corner::Kink, Corner::Auto, Corner::Even] {
            rows.push(row(*share, corner)?);
        }
    }
    section.text(
        "A cable with a point load, with a kink there (`kinks = [4.0]`), with the mesh that statics choose (`elements = { count = 8, finest = \
         \"auto\" }`), and with an even one: largest error of five points in m, by elements of the even mesh, and the order between 4 and 16. \
         Without EI (0) a kink gives the order of smooth cables, and is what is chosen; with EI it leaves out a moment, whose effect falls with \
         sqrt(EI/T), here over the length of an element of eight, and the mesh that is chosen has elements of 2 sqrt(EI/T) beside the load."
    );
    let columns = vec![
        shown("layer", "sqrt(EI/T)/h", Format::Fixed(2)),
        shown("corner", "at the load", n),
        shown("off_2_m", "2", e1),
        shown("off_4_m", "4", e1),
        shown("off_8_m", "8", e1),
        shown("off_16_m", "16", e1),
        shown("off_32_m", "32", e1),
        shown("order", "order", Format::Fixed(1)),
    ];
    section.table(Table { name: "kinks", columns, rows });
    Ok(section)
}
