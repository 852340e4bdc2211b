//! The cost of a cable on a body: whole runs of boxes on cables of Lariat and on the ropes that
//! Rapier itself offers.
//!
//! `lariat coupling --out docs/coupling.md` writes the page, and all runs as CSV beside it. Times
//! are CPU time on one thread, the mean over a run of 2 s, the smallest of several runs; only the
//! steps of the world with its cables are timed.

mod assemblies;
pub mod hard;
mod measure;
mod model;
mod scene;
mod tables;
mod targets;
mod world;

use crate::error::Error;
use crate::machine;
use crate::numbers::short;
use crate::page::{self, Section};
use crate::single::peers::Joints;
use crate::table::{Column, Format, Table, shown};
use lariat_ancf::{Fidelity, Integrator, Method, Vector3};
use measure::Row;
use model::{CableModel, SPLITS, Split};
use scene::{SOFT, STEEL, Scene};
use world::{World, host_steps};

/// The command that makes the page.
const COMMAND: &str = "cargo run --release --bin lariat -- coupling --out docs/coupling.md";
/// Centre of the box of the soft pendulum at 0.5 s and 1 s in m, by a fine run of an independent
/// monolithic code, accurate to 2e-5 m.
const CENTRES: [[f64; 3]; 2] = [[1.70292, -1.21801, 0.0], [-0.82138, -1.91419, 0.0]];
/// CPU time in us that the game fidelity may take, the four steps of Rapier included.
const TARGET: f64 = 30.0;

const ERRORS: [Column; 3] = [
    shown("largest_stretch_percent", "stretch %", Format::Short),
    shown("error_at_half_second_m", "error at 0.5 s m", Format::Scientific(1)),
    shown("error_at_one_second_m", "error at 1 s m", Format::Scientific(1)),
];

/// Measures all scenes, and returns the page and the table of all runs; `progress` is called with a
/// line for each run.
///
/// # Errors
/// [`Error::Mechanics`] or [`Error::Coupling`] if a run of Lariat fails.
pub fn measure(progress: &mut dyn FnMut(&str)) -> Result<(String, Table), Error> {
    let machine = machine::line();
    let soft = Scene { name: "payload", material: SOFT, count: 1, mass: 50.0, swings: true };
    let steel = Scene { name: "payload, steel", material: STEEL, ..soft };
    let rest = Scene { name: "load at rest", mass: 10.0, swings: false, ..soft };
    let twenty = Scene { name: "twenty payloads", count: 20, ..soft };
    let all = models();
    let mut table = tables::empty();
    let mut run = |scene: &Scene, models: &[(CableModel, Vec<Split>)], centres: Option<&[Vector3<f64>; 2]>| {
        let (runs, bare) = rows(scene, models, progress)?;
        tables::add(&mut table, scene, &runs, &bare, centres);
        Ok::<Vec<Row>, Error>(runs)
    };
    let (centres, soft_fine, steel_fine) = (CENTRES.map(Vector3::from), fine(&soft)?, fine(&steel)?);
    let runs = run(&soft, &all, Some(&centres))?;
    run(&steel, &all, Some(&steel_fine))?;
    run(&rest, &all, None)?;
    run(&twenty, &quick(&all), None)?;

    let mut targets = Section::new("What the coupling must show");
    targets.text(
        "Bodies of 1 kg that a winch draws by a steel wire of 3 mm, a cube of 20 kg that it drags, the payload and a dumbbell; each with Rapier's \
         defaults and in host steps of 1/60 s. *Version 0.1* is what that version was measured with. Costs, the bridge and the pile are below, and so \
         are the scenes that version 0.1 got wrong. Lines of physics are those of the files that move or hold a body or a cable.",
    );
    targets.excerpt(targets::table(&soft, &centres[1], progress)?);
    let mut payload = Section::new("A payload swings");
    let [a, b] = [0, 1].map(|k| (soft_fine[k] - centres[k]).norm());
    payload.text(format!(
        "50 kg on the soft cable of 0.8 kg, released from horizontal. *Error* is the distance of the centre of the box from that of an \
         independent monolithic code (one fine run, accurate to 2e-5 m). For comparison: Lariat with a tolerance of 1e-9 m per host step, \
         coupled 960 times per second, is {a:.1e} and {b:.1e} m from it."
    ));
    payload.excerpt(tables::view(&table, &soft, &ERRORS));
    payload.text(target(&runs));
    payload.text(
        "The time of a host step by stage, in us (wall time, the stages called one by one). *Cable alone* is `Cable::step` of the same cable \
         without its box, which moves differently. Called one by one, each step of Rapier has the whole tolerance of a host step, so that \
         *engineering* takes less in four of them than above.",
    );
    payload.excerpt(stages(&soft)?);
    let mut in_steel = Section::new("A payload swings on steel");
    in_steel.text(
        "50 kg on a steel cable of 1.57 kg. *Error* is the distance from Lariat's own run with 1e-9 m, coupled 960 times per second, which is \
         no independent reference.",
    );
    in_steel.excerpt(tables::view(&table, &steel, &ERRORS));
    let mut at_rest = Section::new("A load at rest");
    at_rest.text(format!(
        "10 kg hang on the soft cable. The box has a linear damping of 5 /s and comes to rest for 4 s before the 2 s that are measured; \
         nothing sleeps. The static stretch is {:.4} %.",
        100.0 * rest.static_stretch()
    ));
    let last = shown("last_stretch_percent", "stretch at the end %", Format::Fixed(4));
    at_rest.excerpt(tables::view(&table, &rest, &[last]));
    let mut many = Section::new("Twenty payloads");
    many.text(
        "Twenty payload pendulums (50 kg, soft) side by side in one world. *Per cable* is the time without that of Rapier alone, divided by \
         twenty. The slower presets are left out, and multibody joints are run once.",
    );
    many.excerpt(tables::view(&table, &twenty, &ERRORS[..1]));
    let mut assemblies = Section::new("Assemblies");
    assemblies.text(
        "*Bridge*: two ropes of 20 elements carry ten planks, each on 2 or 4 pins; a box of 60 kg falls on it from 2 m. *Boxes*: a pile of \
         500 awake boxes of 10 kg that has settled; slack cables of 10 elements lead from fixed points to boxes on its top. The times are \
         the mean and the largest of host steps, CPU time of all threads, and the mean of wall time; of the pile, the run of three with the \
         smallest mean. Rapier collects all contacts anew in a step for which the host took any body to change it, as a cable must: the row \
         *one box changed* is that cost without a cable. Rows without a number of threads are of as many as the machine has; work that is too \
         little to share stays on one. Counts are per host step, of all cables.",
    );
    assemblies.excerpt(assemblies::table(progress)?);
    let mut wrong = Section::new("Scenes that version 0.1 got wrong");
    wrong.text(
        "The scenes of `assets/hard`, each as its file says; with version 0.1 nearly all ended with exit code 0 and no warning. *Version 0.1* is \
         what that version gave. A *fine run* is the same scene (of the booms that with the impulse joint) with 960 host steps per second and \
         ESDIRK4 at 1e-7 m; paths are compared by the largest distance, divided by the way. A dash under *now* is a scene that is refused, or has \
         nothing to compare but its warning.",
    );
    wrong.excerpt(hard::table(progress)?);
    let introduction = introduction(&machine);
    let sections = [targets, payload, in_steel, at_rest, many, assemblies, wrong];
    Ok((page::markdown("The cost of a cable on a body", &introduction, &sections), table))
}

fn introduction(machine: &str) -> String {
    format!(
        "Made by `{COMMAND}`; do not edit. {machine}\n\n\
         Boxes of rapier3d (`f32`, 0.2 m wide) hang by their top faces on cables of 2 m with a square section of 1 cm; *soft* is \
         E = 1e9 Pa, 4000 kg/m^3, *steel* E = 2e11 Pa, 7850 kg/m^3. A host step is 1/60 s. *Time* is CPU time per host step on one \
         thread: the mean over 2 s, the smallest of 2 to 25 runs. *Rapier alone* is the time of the same world without cables, *per cable* \
         the difference. *Split* is the number of Rapier steps per host step, and of solver iterations in each: `1 x 4` is the default of \
         Rapier and of Lariat. *Stretch* is the largest of the polyline from the fixed point through nodes, particles or joints \
         to the point of the box. A dash marks a run that flew apart. All columns, with counts of steps, Newton iterations, \
         factorisations and element evaluations: [coupling.csv](coupling.csv).\n\n\
         - **Lariat**: 10 elements, `CableSet`, one `AttachmentKind::Ball`.\n\
         - **soft rope**: `SoftBodyBuilder::rope`, 11 particles with the mass of the cable, the first pinned, the last attached with \
         `attach_particle`, no collider; once with the default material, once with edges of 1e6 Hz as in Rapier's joints.\n\
         - **capsules**: 10 rigid links as thick and heavy as the cable, without contacts, on spherical impulse or multibody joints. They have \
         no stiffness: what they stretch is the error of the solver, and that they do not stretch as the soft cable does is part of their \
         error there.\n\n\
         World settings are the defaults of Rapier except the split."
    )
}

fn models() -> Vec<(CableModel, Vec<Split>)> {
    let presets = Fidelity::ALL.map(|fidelity| (CableModel::Lariat(fidelity), vec![SPLITS[0], SPLITS[2]]));
    let peers = [
        CableModel::SoftRope(30.0),
        CableModel::SoftRope(1e6),
        CableModel::Capsules(Joints::Impulse),
        CableModel::Capsules(Joints::Multibody),
    ];
    presets.into_iter().chain(peers.map(|model| (model, SPLITS.to_vec()))).collect()
}

/// Returns the models whose runs with many boxes take less than some seconds.
fn quick(models: &[(CableModel, Vec<Split>)]) -> Vec<(CableModel, Vec<Split>)> {
    let slow = [Fidelity::Engineering, Fidelity::Reference].map(CableModel::Lariat);
    let mut quick: Vec<_> = models.iter().filter(|(model, _)| !slow.contains(model)).cloned().collect();
    for (_, splits) in quick.iter_mut().filter(|(model, _)| *model == CableModel::Capsules(Joints::Multibody)) {
        splits.truncate(1);
    }
    quick
}

/// Runs a scene with some models, and without cables.
fn rows(
    scene: &Scene,
    models: &[(CableModel, Vec<Split>)],
    progress: &mut dyn FnMut(&str),
) -> Result<(Vec<Row>, Vec<Row>), Error> {
    let mut runs = Vec::new();
    for (model, split) in models.iter().flat_map(|(model, splits)| splits.iter().map(|split| (*model, *split))) {
        let row = measure::row(scene, model, split)?;
        progress(&format!("{}: {}, {}: {} us", scene.name, model.name(), split.name(), short(row.micros)));
        runs.push(row);
    }
    let bare = SPLITS.map(|split| measure::row(scene, CableModel::None, split));
    Ok((runs, bare.into_iter().collect::<Result<_, _>>()?))
}

/// Returns the centre of the box in m by Lariat with 1e-9 m per host step, coupled 960 times per
/// second.
fn fine(scene: &Scene) -> Result<[Vector3<f64>; 2], Error> {
    let model = CableModel::Exact(Integrator::tolerance(Method::Esdirk4, 1e-9)?);
    let mut world = World::new(scene, model, Split { steps: 16, iterations: 4 })?;
    let mut out = [Vector3::zeros(); 2];
    for k in 1..=host_steps(1.0) {
        world.step()?;
        for (centre, t) in out.iter_mut().zip(measure::READ) {
            if k == host_steps(t) {
                *centre = world.centre();
            }
        }
    }
    Ok(out)
}

/// Says whether the game fidelity with the default split is as fast as wanted.
fn target(rows: &[Row]) -> String {
    let game = rows.iter().find(|r| r.model == CableModel::Lariat(Fidelity::Game) && r.split == SPLITS[0]);
    let time = game.map_or(f64::NAN, |r| r.micros);
    let verdict = if time <= TARGET { "met" } else { "missed" };
    format!(
        "Target for the game fidelity with the default split: {TARGET:.0} us, Rapier included. Measured {time:.1} us: {verdict}."
    )
}

/// Returns the time of a host step by stage.
fn stages(scene: &Scene) -> Result<Table, Error> {
    let one = Format::Fixed(1);
    let columns = vec![
        shown("cable", "cable", Format::Plain),
        shown("split", "split", Format::Plain),
        shown("predict_us", "predict", one),
        shown("rapier_us", "Rapier", one),
        shown("reconcile_us", "reconcile", one),
        shown("alone_us", "cable alone", one),
    ];
    let mut rows = Vec::new();
    for fidelity in [Fidelity::Game, Fidelity::Engineering] {
        let model = CableModel::Lariat(fidelity);
        let alone = measure::alone(scene, model)?;
        for split in [SPLITS[0], SPLITS[2]] {
            let times = measure::stages(scene, model, split)?;
            let words = [model.name().into(), split.name().into()];
            rows.push(words.into_iter().chain(times.map(Into::into)).chain([alone.into()]).collect());
        }
    }
    Ok(Table { name: "coupling_stages", columns, rows })
}
