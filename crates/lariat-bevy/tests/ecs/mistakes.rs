//! What newcomers write in Bevy, and the first line that they get: it says the cause, in the words of this interface.

use super::common::{cube, pin, steps, world};
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{Schedules, SingleThreadedExecutor};
use core::cell::RefCell;
use lariat_bevy::{
    At, Attachment, Bending, BreakForce, BreakStrain, BreakTension, Cable, CableStep, Contact, Damping, Drag, Drum,
    Gap, Junction, Physics, RapierStep, Reel, Rope, Section, Sheave, SpawnRope, Torsion, lariat_ancf,
};

thread_local! {
    /// The first line that was logged in this thread: other tests run in theirs.
    static FIRST: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Hears what a program hears that observes nothing: warnings, and all events of failures with their names.
struct Listener;

impl log::Log for Listener {
    fn enabled(&self, _: &log::Metadata) -> bool {
        true
    }
    fn log(&self, record: &log::Record) {
        FIRST.with_borrow_mut(|first| _ = first.get_or_insert_with(|| record.args().to_string()));
    }
    fn flush(&self) {}
}

/// Returns the first line of half a second, empty if there is none.
fn said(write: fn(&mut World)) -> String {
    let mut world = world();
    let mut schedules = world.resource_mut::<Schedules>();
    schedules.get_mut(CableStep).unwrap().set_executor(SingleThreadedExecutor::new());
    schedules.get_mut(RapierStep).unwrap().set_executor(SingleThreadedExecutor::new());
    FIRST.take();
    write(&mut world);
    steps(&mut world, 30);
    FIRST.take().unwrap_or_default()
}

fn steel() -> Cable {
    Cable::steel_rope(0.008).between([0.0; 3], [0.0, -2.0, 0.0])
}

fn round(diameter: f64, youngs_modulus: f64, density: f64) -> Cable {
    Cable::round(diameter, youngs_modulus, density).between([0.0; 3], [0.0, -2.0, 0.0])
}

/// A cable of 0.25 kg/m, of which no diameter is known.
fn measured(axial_stiffness: f64) -> Cable {
    Cable::new(Section::from_stiffness(axial_stiffness, 0.5, 0.25).unwrap()).between([0.0; 3], [0.0, -2.0, 0.0])
}

/// Spawns a rope that hangs from the origin, and a crate of 10 kg below it.
fn above(world: &mut World, rope: impl Bundle) -> [Entity; 2] {
    let rope = world.spawn((rope, Bending)).id();
    world.spawn(pin(rope));
    [rope, world.spawn(cube(0.1, 10.0, [0.0, -2.1, 0.0])).id()]
}

/// Hangs the crate on a rope with its effects.
fn hung(world: &mut World, rope: impl Bundle) {
    let [rope, load] = above(world, rope);
    world.spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 0.1, 0.0]));
}

/// Spawns what ties the rope to the crate.
fn tied<B: Bundle>(world: &mut World, tie: fn(Entity, Entity) -> B) {
    let [rope, load] = above(world, steel());
    world.spawn(tie(rope, load));
}

/// What is written, and words of the first line.
type Mistake = (&'static str, fn(&mut World), &'static [&'static str]);

const MISTAKES: &[Mistake] = &[
    // sizes and materials in another unit
    ("a diameter in mm", |world| hung(world, round(8.0, 2.1e11, 7850.0)), &["as long as thick", "in m"]),
    ("a modulus in GPa", |world| hung(world, round(0.008, 210.0, 7850.0)), &["was 210 GPa or MPa meant?"]),
    ("the modulus for EA", |world| hung(world, measured(2.1e11)), &["was the modulus given?"]),
    (
        "a slack in percent",
        |world| _ = world.spawn_rope([0.0; 3], [0.0, -2.0, 0.0], Rope::steel(0.008).slack(5.0)),
        &["500 % of slack", "was a share meant?"],
    ),
    (
        "a wind in km/h",
        |world| hung(world, (steel(), Drag::air().flowing([130.0, 0.0, 0.0]))),
        &["faster than any wind", "were knots or km/h meant?"],
    ),
    (
        "a friction in percent",
        |world| hung(world, (steel(), Contact::with_friction(30.0))),
        &["friction is 30", "no two materials have more than 2", "not in percent"],
    ),
    (
        "a breaking strain in percent",
        |world| hung(world, (steel(), BreakStrain(2.0))),
        &["a strain of 2, 200 % of its length", "not in percent"],
    ),
    (
        "a damping in percent",
        |world| hung(world, (steel(), Damping::critical_fraction(20.0))),
        &["critical_fraction", "is 20", "was a percentage meant?"],
    ),
    (
        "an app without a clock",
        |_| {
            let mut app = bevy_app::App::new();
            app.add_plugins(lariat_bevy::LariatPlugin::default());
            app.edit_schedule(bevy_app::Startup, |schedule| _ = schedule.set_executor(SingleThreadedExecutor::new()));
            app.update();
        },
        &["nothing moves", "add `TimePlugin`"],
    ),
    (
        "a frame in ms",
        |world| {
            hung(world, steel());
            lariat_bevy::advance(world, 16.67);
        },
        &["a frame of 16.67 s", "times of frames are in s"],
    ),
    (
        "a body without a collider",
        |world| {
            let rope = world.spawn((steel(), Bending)).id();
            world.spawn(pin(rope));
            let load = world.spawn(lariat_bevy::Body::dynamic().at([0.0, -2.0, 0.0])).id();
            world.spawn(Attachment::ball(rope, At::End).to(load));
        },
        &["has no mass", "give it a collider"],
    ),
    // numbers that nothing has
    (
        "no mass",
        |world| hung(world, round(0.008, 2.1e11, 0.0)),
        &["CableFailed", "density (kg/m^3) is 0", "must be finite and > 0"],
    ),
    (
        "one point",
        |world| hung(world, Cable::steel_rope(0.008).through([[0.0; 3]])),
        &["CableFailed", "needs at least 2 points, got 1"],
    ),
    (
        "one point twice",
        |world| hung(world, Cable::steel_rope(0.008).between([1.0; 3], [1.0; 3])),
        &["CableFailed", "points 0 and 1 coincide"],
    ),
    (
        "a length that is no number",
        |world| hung(world, steel().length(f64::NAN)),
        &["CableFailed", "unstretched length (m) is NaN"],
    ),
    (
        "a negative strength",
        |world| hung(world, (steel(), BreakTension(-1.0))),
        &["CableFailed", "breaking tension (N) is -1", "> 0"],
    ),
    (
        "a rate that is no number",
        |world| hung(world, (steel(), Reel::with_rate(f64::NAN))),
        &["CableFailed", "rate of a reel (m/s) is NaN"],
    ),
    (
        "a step back in time",
        |world| {
            hung(world, steel());
            world.resource_mut::<Physics>().integration_parameters.dt = -0.01;
        },
        &["StepFailed", "a time step of -0.0", "expected 0 or more"],
    ),
    // effects that need what the cable does not have
    (
        "contact without a diameter",
        |world| hung(world, (measured(1e6), Contact::with_friction(0.3))),
        &["CableFailed", "contact needs a radius", "diameter of the section"],
    ),
    (
        "one element that is to break",
        |world| hung(world, (steel().elements(1), BreakTension(1e4))),
        &["CableFailed", "has one element, and breaks at inner nodes"],
    ),
    (
        "torsion between balls",
        |world| hung(world, (steel(), Torsion(lariat_ancf::Torsion::new(0.01)))),
        &["its torsion does nothing", "clamp it at both ends"],
    ),
    (
        "damping in percent",
        |world| hung(world, (steel(), lariat_bevy::Damping::time(2.0))),
        &["its axial damping is 2 s", "`Damping::critical_fraction`"],
    ),
    (
        "a length unit of centimetres",
        |world| {
            world.resource_mut::<Physics>().integration_parameters.length_unit = 100.0;
            hung(world, steel());
        },
        &["`length_unit` is 100"],
    ),
    (
        "a drum of no axis",
        |world| {
            let drum = world.spawn(cube(0.2, 50.0, [1.0, 0.0, 0.0])).id();
            hung(world, (steel(), Drum::at_start(drum, [0.0; 3], 0.2)));
        },
        &["DrumFailed", "axis of a drum is 0: must be finite and > 0"],
    ),
    (
        "a force that nothing bears",
        |world| {
            let [rope, load] = above(world, steel());
            world.spawn((Attachment::ball(rope, At::End).to(load), BreakForce(f64::NAN)));
        },
        &["AttachmentFailed", "breaks is NaN N: must be > 0"],
    ),
    // places, and what is attached to what
    (
        "a crate that is set elsewhere",
        |world| {
            hung(world, steel());
            steps(world, 5);
            let mut crates = world.query::<&lariat_bevy::BodyHandle>();
            let crate_of = crates.iter(world).last().unwrap().handle();
            world.resource_mut::<Physics>().bodies[crate_of].set_translation([3.0, 0.0, 0.0].into(), true);
        },
        &["off the anchor of an attachment", "`Cables::move_bodies`"],
    ),
    (
        "an attachment behind the end",
        |world| tied(world, |rope, load| Attachment::ball(rope, 7.0).to(load)),
        &["AttachmentFailed", "arc length 7 is outside [0, 2]"],
    ),
    (
        "an anchor in the axes of the world",
        |world| {
            tied(world, |rope, load| Attachment::ball(rope, At::End).to(load).at([0.0, -2.0, 0.0]).gap(Gap::Close));
        },
        &["an anchor is in the axes of the body", "was the other meant?"],
    ),
    (
        "an entity without a body",
        |world| tied(world, |rope, _| Attachment::ball(rope, At::End).to(rope)),
        &["AttachmentFailed", "has no body"],
    ),
    (
        "the body for the cable",
        |world| tied(world, |rope, load| Attachment::ball(load, At::End).to(rope)),
        &["AttachmentFailed", "has no cable"],
    ),
    (
        "an attachment twice",
        |world| tied(world, |rope, _| pin(rope)),
        &["AttachmentFailed", "node 0 is attached already"],
    ),
    (
        "a clamp without a direction",
        |world| tied(world, |rope, load| Attachment::clamp(rope, At::End).along([0.0; 3]).to(load)),
        &["AttachmentFailed", "size of the direction of a clamp is 0"],
    ),
    (
        "a crate that is on its way already",
        |world| {
            let [rope, _] = above(world, steel());
            let load = world.spawn(cube(0.1, 10.0, [0.0, -2.1, 0.0]).velocity([0.0, -3.0, 0.0])).id();
            world.spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 0.1, 0.0]));
        },
        &["start with velocities 3.000e0 m/s apart", "give both the same velocity"],
    ),
    (
        "a junction of ends that are apart",
        |world| {
            let [rope, _] = above(world, steel());
            let other = world.spawn(Cable::steel_rope(0.008).between([1.0, -2.0, 0.0], [2.0, -2.0, 0.0])).id();
            world.spawn(Junction::between((rope, At::End), (other, At::Start)));
        },
        &["JunctionFailed", "1.000e0 m from what it is to be attached to", "(`Gap`)"],
    ),
    (
        "an attachment to a body that was despawned",
        |world| {
            let [rope, load] = above(world, steel());
            world.spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 0.1, 0.0]));
            world.despawn(load);
        },
        &["AttachmentFailed", "has no body", "despawned"],
    ),
    (
        "an anchor apart from the rope",
        |world| {
            let [rope, load] = above(world, steel());
            world.spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 1.0, 0.0]));
        },
        &["AttachmentFailed", "from what it is to be attached to", "`Gap`", "axes of their body"],
    ),
    (
        "a sheave between ends that nothing holds",
        |world| {
            let [rope, _] = above(world, steel());
            let other = world.spawn(Cable::steel_rope(0.008).between([0.0, -2.0, 0.0], [1.0, -1.5, 0.0])).id();
            world.spawn(Sheave::between((rope, At::End), (other, At::Start)));
        },
        &["SheaveFailed", "held by nothing", "attach both cables there"],
    ),
    (
        "a drum that is no body",
        |world| {
            let drum = world.spawn_empty().id();
            hung(world, (steel(), Drum::at_start(drum, [0.0, 0.0, 1.0], 0.2)));
        },
        &["DrumFailed", "has no body"],
    ),
];

/// What is called otherwise in Bevy, or is not there.
const FOREIGN: [&str; 5] = ["CableBuilder", "CableSet", "`Strength`", "equilibrium_among", "RigidBodyHandle"];

/// The first line names what is to be changed, and of what is right nothing is said.
#[test]
fn the_first_line_says_the_cause() {
    log::set_logger(&Listener).unwrap();
    log::set_max_level(log::LevelFilter::Warn);
    let mut wrong = Vec::new();
    for (what, write, words) in MISTAKES {
        let line = said(*write);
        println!("| {what} | {line} |");
        if !words.iter().all(|word| line.contains(word)) || FOREIGN.iter().any(|word| line.contains(word)) {
            wrong.push((what, words, line));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert_eq!(said(|world| hung(world, steel())), "");
}
