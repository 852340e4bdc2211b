//! How many iterations contacts take: the distribution over the host steps of scenes, and of random throws.
//!
//! # Measures
//!
//! Newton iterations and factorisations of a host step of 1/60 s, fidelity game, of the cable that has taken most: their mean, the 99th percentile and the
//! most. A count is the same on every machine. *Throws*: ropes of 0.1 kg/m at up to 30 m/s and 10 rad/s at a box, a post, a mesh of 12 facets
//! and a floor, friction 0 to 0.8, EA 1e3 to 1e6 N, radius 3 to 30 mm, 0.5 s each.

use super::run::Run;
use crate::error::Error;
use crate::page::Section;
use crate::stability::recipe::Recipe;
use crate::table::{Cell, Format, Table, shown};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};
use std::f64::consts::TAU;
use std::path::Path;

/// Scenes of assets/contact, and how long they run in s.
const SCENES: [(&str, f64); 12] = [
    ("heap", 5.0),
    ("net", 3.0),
    ("rod", 2.0),
    ("edge", 2.0),
    ("swing", 5.0),
    ("catch", 2.0),
    ("capstan", 3.0),
    ("spinning_drum", 3.0),
    ("atwood", 0.6),
    ("crossing", 3.0),
    ("lashed", 1.5),
    ("grapple", 4.5),
];
/// Facets of the drum that is a mesh.
const FACETS: [usize; 2] = [24, 96];
/// Random throws.
const THROWS: u64 = 200;

/// Iterations and factorisations by host step.
#[derive(Default)]
struct Counts(Vec<[u64; 2]>);

impl Counts {
    fn row(mut self, name: String) -> Vec<Cell> {
        let hosts = self.0.len().max(1);
        let mut row = vec![name.into()];
        for k in 0..2 {
            self.0.sort_unstable_by_key(|count| count[k]);
            let at = |share: f64| self.0.get(((hosts - 1) as f64 * share) as usize).map_or(0, |count| count[k]);
            let mean = self.0.iter().map(|count| count[k] as f64).sum::<f64>() / hosts as f64;
            row.extend([mean.into(), at(0.99).into(), at(1.0).into()]);
        }
        row
    }

    /// Adds what a world takes to a time in s.
    fn add(&mut self, world: &mut World, dt: f64, until: f64) -> Result<(), Error> {
        let taken = |world: &World| -> Vec<[u64; 2]> {
            let all = world.cables().into_iter().map(|cable| cable.diagnostics());
            all.map(|own| [own.newton_iterations, own.factorisations]).collect()
        };
        let mut before = taken(world);
        for step in 1..=(until / dt).round() as u32 {
            world.advance(f64::from(step) * dt)?;
            let now = taken(world);
            // the cables of an island share theirs
            let each = now.iter().zip(&before).map(|(now, before)| [0, 1].map(|k| now[k] - before[k]));
            self.0.push(each.fold([0; 2], |most, own| [0, 1].map(|k| most[k].max(own[k]))));
            before = now;
        }
        Ok(())
    }
}

/// Returns a cylinder of some sides along z as an OBJ file: radius and half length in m.
fn prism(sides: usize, radius: f64, half: f64) -> String {
    let point = |k: usize, z: f64| {
        let angle = TAU * k as f64 / sides as f64;
        format!("v {} {} {z}\n", radius * angle.cos(), radius * angle.sin())
    };
    let mut text: String = (0..sides).flat_map(|k| [point(k, -half), point(k, half)]).collect();
    for k in 0..sides {
        let (a, b) = (2 * k + 1, 2 * ((k + 1) % sides) + 1);
        text += &format!("f {a} {b} {}\nf {a} {} {}\n", b + 1, b + 1, a + 1);
    }
    text
}

/// Returns a random throw; `mesh` is the file of a prism.
fn throw(seed: u64, mesh: &Path) -> String {
    let random = Recipe::from_seed(seed);
    let [radius, stiffness] = [random.power(0, -2.52, -1.52), random.power(1, 3.0, 6.0)];
    let at = |k: usize, scale: f64| scale * random.signed(k);
    let kind = random.choose(2, 4);
    let shape = match kind {
        0 => "{ cuboid = [0.2, 0.2, 0.2] }".to_string(),
        1 => "{ cylinder = [1.0, 0.1] }".to_string(),
        2 => format!("{{ mesh = {:?} }}", mesh.display().to_string()),
        _ => "{ plane = [0.0, 1.0, 0.0] }".to_string(),
    };
    let speed = 30.0 * random.0[3];
    let velocity = [at(4, 0.3) * speed, -speed, at(5, 0.3) * speed];
    let friction = 0.8 * random.0[6];
    format!(
        "duration = 0.5\n[[body]]\nname = \"thing\"\nkind = \"fixed\"\nshape = {shape}\nfriction = {friction:?}\nrotation = [{:?}, {:?}, 0.0]\n\
         [[cable]]\nname = \"rope\"\npoints = [[-0.6, 0.9, {:?}], [0.6, 0.9, {:?}]]\nelements = {}\naxial_stiffness = {stiffness:?}\n\
         bending_stiffness = {:?}\nmass_per_length = 0.1\ndamping = {{ axial = 1e-3, bending = 1e-3 }}\nintegrator = {{ fidelity = \"game\" }}\n\
         contact = {{ radius = {radius:?}, friction = {friction:?} }}\nvelocity = {velocity:?}\nangular_velocity = [0.0, {:?}, {:?}]\n",
        if kind == 3 { 0.0 } else { at(7, 0.5) },
        if kind == 3 { 0.0 } else { at(8, 0.5) },
        at(9, 0.1),
        at(10, 0.1),
        12 + random.choose(11, 28),
        stiffness * radius * radius / 4.0 * random.0[12].max(1e-3),
        at(13, 10.0),
        at(14, 10.0),
    )
}

/// Adds the table and what it is.
///
/// # Errors
/// As [`Run::start`].
pub(super) fn add(section: &mut Section) -> Result<(), Error> {
    let columns = vec![
        shown("scene", "scene", Format::Plain),
        shown("iterations", "iterations per host step", Format::Short),
        shown("iterations_99", "99 %", Format::Plain),
        shown("most_iterations", "most", Format::Plain),
        shown("factorisations", "factorisations per host step", Format::Short),
        shown("factorisations_99", "99 %", Format::Plain),
        shown("most_factorisations", "most", Format::Plain),
    ];
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    let of = |name: &str, overrides: &[String], until: f64| -> Result<Counts, Error> {
        let Run { mut world, dt, .. } = Run::start(name, overrides)?;
        let mut counts = Counts::default();
        counts.add(&mut world, dt, until)?;
        Ok(counts)
    };
    for (name, until) in SCENES {
        rows.push(of(name, &[], until)?.row(name.to_string()));
    }
    let output = |path: &Path, source| Error::Output { path: path.to_path_buf(), source };
    let folder = std::env::temp_dir().join(format!("lariat-prisms-{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|source| output(&folder, source))?;
    let file = |sides: usize, radius: f64, half: f64| {
        let path = folder.join(format!("prism_{sides}.obj"));
        std::fs::write(&path, prism(sides, radius, half)).map_err(|source| output(&path, source)).map(|()| path)
    };
    for sides in FACETS {
        let shape = format!("body.drum.shape={{mesh={:?}}}", file(sides, 0.1, 0.5)?.display().to_string());
        let changed = [shape, "body.drum.rotation=[0.0, 0.0, 0.0]".to_string()];
        rows.push(of("atwood", &changed, 0.6)?.row(format!("atwood over a mesh of {sides} facets")));
    }
    let mesh = file(12, 0.1, 1.0)?;
    let mut counts = Counts::default();
    for seed in 0..THROWS {
        let scene = Scene::parse("throw", &throw(seed, &mesh), &[], Purpose::Run)?;
        let mut world = World::build(&scene)?;
        world.start(Purpose::Run)?;
        counts.add(&mut world, scene.dt, 0.5)?;
    }
    rows.push(counts.row(format!("{THROWS} random throws")));
    std::fs::remove_dir_all(&folder).map_err(|source| output(&folder, source))?;
    section.text(
        "Iterations in fidelity game, by host step of 1/60 s, which is four integration steps, of the cable that took most: those of an island share them. \
         *Random throws*: ropes of 3 to 30 mm radius and EA 1e3 to 1e6 N at a box, a post, a mesh of 12 facets and a floor, with up to 30 m/s and friction 0 to 0.8.",
    );
    section.table(Table { name: "contact_iterations", columns, rows });
    Ok(())
}
