//! What newcomers write in Rust, and the first line that they get: it says the cause.

use super::common::{add_cube, run};
use lariat_rapier::lariat_ancf::warning::Interface;
use lariat_rapier::lariat_ancf::{
    At, AxialLaw, Cable, CableBuilder, Contact, Damping, Drag, Effects, Flow, Integrator, Method, PointLoad, Reel,
    Rule, Section, StepControl, Vector3,
};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, Rope};

/// A crate of 10 kg, 2 m below the origin.
struct Yard {
    world: PhysicsWorld,
    set: CableSet,
    load: RigidBodyHandle,
}

impl Yard {
    fn new() -> Self {
        let mut world = PhysicsWorld::new();
        let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
        Yard { world, set: CableSet::new(), load }
    }

    /// What is said of a cable from the origin to the crate: why it cannot be, or the first warning, also after some steps.
    fn hung(mut self, cable: CableBuilder) -> String {
        let cable = match cable.fix(At::Start).build() {
            Ok(cable) => cable,
            Err(error) => return error.to_string(),
        };
        let cable = self.set.insert(cable);
        let anchor = Vector::new(0.0, 0.1, 0.0);
        if let Err(error) = self.set.attach(&self.world, cable, At::End, self.load, anchor, AttachmentKind::Ball) {
            return error.to_string();
        }
        self.said(1)
    }

    fn said(mut self, steps: usize) -> String {
        let mut first = self.set.warnings(&self.world);
        for _ in 0..steps {
            if let (true, Err(error)) = (first.is_empty(), self.set.step(&mut self.world)) {
                return error.to_string();
            }
        }
        if first.is_empty() {
            first = self.set.warnings(&self.world);
        }
        first.first().map_or(String::new(), ToString::to_string)
    }
}

fn steel() -> Section {
    Section::wire_rope(0.008).unwrap()
}

fn line(section: Section) -> CableBuilder {
    Cable::builder().points([Vector3::zeros(), -2.0 * Vector3::y()]).section(section)
}

fn with(effects: Effects) -> CableBuilder {
    line(steel()).effects(effects)
}

/// What is written, and words of the first line.
type Mistake = (&'static str, fn() -> String, &'static [&'static str]);

const MISTAKES: &[Mistake] = &[
    // sizes and materials in another unit
    (
        "a diameter in mm",
        || Yard::new().hung(line(Section::round(8.0, 2.1e11, 7850.0).unwrap())),
        &["as long as thick", "in m"],
    ),
    ("a modulus in GPa", || Yard::new().hung(line(Section::round(0.008, 210.0, 7850.0).unwrap())), &["GPa"]),
    ("a density in g/cm^3", || Yard::new().hung(line(Section::round(0.008, 2.1e11, 7.85).unwrap())), &["g/cm^3 meant"]),
    (
        "the modulus for EA",
        || Yard::new().hung(line(Section::from_stiffness(2.1e11, 0.5, 0.25).unwrap())),
        &["was the modulus given?"],
    ),
    ("a slack in percent", || Yard::new().hung(line(steel()).length(2.0 * 5.0)), &["% of slack", "a share meant"]),
    (
        "damping as a share of critical",
        || {
            Yard::new()
                .hung(with(Effects { damping: Some(Damping { axial: 2.0, bending: 0.0 }), ..Effects::default() }))
        },
        &["2 s", "damped_as"],
    ),
    (
        "a diameter of drag in mm",
        || {
            let drag = Drag { diameter: Some(8.0), ..Drag::new(1.2, 1.2, 0.0, Flow::uniform([1.0, 0.0, 0.0])) };
            Yard::new().hung(with(Effects { drag: Some(drag), ..Effects::default() }))
        },
        &["8 mm meant"],
    ),
    (
        "a curve in percent",
        || {
            let curve = AxialLaw::Curve(vec![[0.0, 0.0], [1.0, 1e4], [2.0, 4e4]]);
            Yard::new().hung(with(Effects { axial_law: Some(curve), ..Effects::default() }))
        },
        &["shares of the length"],
    ),
    // numbers that nothing has
    ("one point", || Yard::new().hung(line(steel()).points([Vector3::zeros()])), &["2", "point"]),
    ("one point twice", || Yard::new().hung(line(steel()).points([Vector3::zeros(); 2])), &["point"]),
    ("no number", || Yard::new().hung(line(steel()).length(f64::NAN)), &["length"]),
    ("no element", || Yard::new().hung(line(steel()).elements(0)), &["element"]),
    ("no section", || Yard::new().hung(Cable::builder().points([Vector3::zeros(), Vector3::x()])), &["section"]),
    (
        "a breaking load of 0",
        || {
            let mut yard = Yard::new();
            let rope = yard.set.insert(line(steel()).build().unwrap());
            yard.set.set_strength(rope, 0.0).unwrap_err().to_string()
        },
        &["breaking tension (N)", "> 0"],
    ),
    // places
    (
        "a load behind the end",
        || Yard::new().hung(line(steel()).load(PointLoad::force(2.5, [1.0, 0.0, 0.0]))),
        &["2.5"],
    ),
    (
        "an anchor in the axes of the world",
        || {
            let mut yard = Yard::new();
            let rope = yard.set.insert(line(steel()).fix(At::Start).build().unwrap());
            let anchor = Vector::new(0.0, -2.0, 0.0);
            yard.set
                .attach(&yard.world, rope, At::End, yard.load, anchor, AttachmentKind::Ball)
                .unwrap_err()
                .to_string()
        },
        &["from what it is to be attached to"],
    ),
    (
        "an attachment twice",
        || {
            let mut yard = Yard::new();
            let rope = yard.set.insert(line(steel()).fix(At::Start).build().unwrap());
            let mut attach = |at| {
                let anchor = Vector::new(0.0, 0.1, 0.0);
                yard.set.attach(&yard.world, rope, at, yard.load, anchor, AttachmentKind::Ball)
            };
            attach(At::End).unwrap();
            attach(At::ArcLength(2.0)).unwrap_err().to_string()
        },
        &["attached already"],
    ),
    (
        "a cable that was removed",
        || {
            let mut yard = Yard::new();
            let rope = yard.set.insert(line(steel()).build().unwrap());
            yard.set.remove(&mut yard.world, rope).unwrap();
            yard.set.get(rope).unwrap_err().to_string()
        },
        &["cable"],
    ),
    (
        "both ends at one place",
        || {
            let mut yard = Yard::new();
            yard.set
                .add_rope(&yard.world, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0], Rope::steel(0.008))
                .unwrap_err()
                .to_string()
        },
        &["point"],
    ),
    (
        "a rope drawn through the floor",
        || {
            let mut yard = Yard::new();
            let floor = ColliderBuilder::cuboid(5.0, 0.5, 5.0).translation(Vector::new(0.0, -0.5, 0.0));
            yard.world.insert_collider(floor, None);
            let contact = Effects { contact: Some(Contact::default()), ..Effects::default() };
            let rope = Cable::builder().points([Vector3::new(1.0, 0.1, 0.0), Vector3::new(4.0, 0.1, 0.0)]).length(3.3);
            let rope = rope.section(steel()).effects(contact).fix(At::Start).fix(At::End).build().unwrap();
            yard.set.insert(rope);
            yard.said(0)
        },
        &["inside", "contact does not push it out"],
    ),
    // what does not go together, and steps
    (
        "an explicit method on steel",
        || {
            Yard::new().hung(
                line(steel()).integrator(Integrator { method: Method::Verlet, control: StepControl::MaxStep(1e-3) }),
            )
        },
        &["step"],
    ),
    ("a rule with spare modes", || Yard::new().hung(line(steel()).rule("G2-2".parse::<Rule>().unwrap())), &["rank"]),
    (
        "contact by a method without it",
        || {
            let contact = Effects { contact: Some(Contact::default()), ..Effects::default() };
            let method = Integrator::tolerance(Method::Esdirk4, 1e-6).unwrap();
            Yard::new().hung(with(contact).integrator(method))
        },
        &["contact", "discrete-gradient"],
    ),
    (
        "a reel that cannot start",
        || {
            let mut rope = line(steel()).fix(At::Start).build().unwrap();
            rope.add_reel(At::Start, Reel { acceleration: 0.0, ..Reel::with_rate(1.0) }).unwrap_err().to_string()
        },
        &["acceleration", "> 0"],
    ),
];

/// The first line names what is to be changed.
#[test]
fn the_first_line_says_the_cause() {
    let mut wrong = Vec::new();
    for (what, said, words) in MISTAKES {
        let line = said();
        println!("| {what} | {line} |");
        if !words.iter().all(|word| line.contains(word)) {
            wrong.push((what, words, line));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    // and of what is right nothing is said
    let mut yard = Yard::new();
    let rope = yard.set.add_rope(&yard.world, [0.0, 0.0, 0.0], (yard.load, [0.0, -2.0, 0.0]), Rope::steel(0.008));
    assert!(rope.is_ok());
    run(&mut yard.world, &mut yard.set, 60);
    assert!(yard.set.warnings(&yard.world).is_empty(), "{:?}", yard.set.warnings(&yard.world));
}

/// What a warning or an error names in backticks has its words in scenes and in Python.
///
/// *Source.* The contract of `Interface::text`; a world of Rapier has its `length_unit` in every interface.
#[test]
fn names_in_warnings_are_those_of_each_interface() {
    let source = [include_str!("../../src/read/warnings.rs"), include_str!("../../src/error.rs")].concat();
    let code = source.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let names: Vec<String> = code.split('`').skip(1).step_by(2).map(|name| format!("`{name}`")).collect();
    assert!(names.len() > 2, "{names:?}");
    for name in names.iter().filter(|name| *name != "`length_unit`") {
        for interface in [Interface::Scene, Interface::Python] {
            assert_ne!(interface.text(name), *name, "{interface:?}");
        }
    }
}
