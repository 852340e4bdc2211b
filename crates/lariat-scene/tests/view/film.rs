//! What a program steps itself, on a page.

use super::browser::Browser;
use super::page::Data;
use lariat_ancf::{At, Cable, Section};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use lariat_scene::view::{FRAMES, Film, Series};
use nalgebra::Vector3;

const DT: f64 = 1.0 / 60.0;

/// A crane: a post, a hook of two colliders on a rope, a ball that comes later, and a second rope that goes.
struct Crane {
    world: PhysicsWorld,
    cables: CableSet,
    film: Film,
    rope: CableHandle,
    hook: RigidBodyHandle,
}

impl Crane {
    fn new() -> Self {
        let (mut world, mut cables) = (PhysicsWorld::new(), CableSet::new());
        let (hook, _) = world.insert(
            RigidBodyBuilder::dynamic().translation(Vector::new(1.0, 2.0, 0.0)).rotation(Vector::new(0.0, 0.0, 0.3)),
            ColliderBuilder::cuboid(0.1, 0.2, 0.1).density(500.0),
        );
        let tip = ColliderBuilder::capsule_x(0.1, 0.02).translation(Vector::new(0.0, -0.25, 0.0));
        world.insert_collider(tip, Some(hook));
        world.colliders.insert(ColliderBuilder::cylinder(1.0, 0.1).translation(Vector::new(-0.5, 1.0, 0.0)));
        let section = Section::round(0.01, 1e8, 1000.0).unwrap();
        let rope = |name: &str, from: [f64; 3]| {
            let points = [Vector3::from(from), Vector3::new(1.0, 2.2, 0.0)];
            Cable::builder().points(points).section(section).name(name).elements(6).fix(At::Start).build().unwrap()
        };
        let main = cables.insert(rope("main", [0.0, 3.0, 0.0]));
        cables.insert(rope("tail", [2.0, 3.0, 0.0]));
        cables.attach_here(&world, main, At::End, hook, AttachmentKind::Ball).unwrap();
        let mut film = Film::new("crane", [0.0, -9.81, 0.0]);
        film.name_body(hook, "hook");
        Crane { world, cables, film, rope: main, hook }
    }

    fn run(&mut self, steps: u32) {
        for step in 0..steps {
            if step == 20 {
                self.world.insert(
                    RigidBodyBuilder::dynamic().translation(Vector::new(3.0, 3.0, 0.0)),
                    ColliderBuilder::ball(0.1),
                );
            }
            if step == 30 {
                let tail = self.cables.iter().find(|(_, cable)| cable.name() == "tail").unwrap().0;
                self.cables.remove(&mut self.world, tail).unwrap();
            }
            self.film.take(f64::from(step) * DT, &self.world, &self.cables).unwrap();
            self.cables.step(&mut self.world).unwrap();
        }
    }
}

/// A frame has what the world had: nodes of the rope, poses of all colliders; a body that comes later stands where it first appears,
/// and a cable that goes is in no later frame.
#[test]
fn a_film_has_what_the_world_had() {
    let mut crane = Crane::new();
    crane.run(50);
    let last = crane.cables.get(crane.rope).unwrap().clone();
    let at = crane.world.bodies[crane.hook].translation();
    crane.film.take(50.0 * DT, &crane.world, &crane.cables).unwrap();
    let read = Series { name: "height".into(), columns: vec!["t".into(), "y".into()], rows: vec![0.0, 1.0, 0.5, 2.0] };
    let data = Data::of(&crane.film.page(&[read], &["a line".into()]));
    assert_eq!(data.times().len(), 51);
    let bodies = data.0["bodies"].as_array().unwrap();
    let names: Vec<&str> = bodies.iter().map(|body| body["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["hook", "", "", ""]);
    assert_eq!((&bodies[2]["kind"], bodies[3]["shape"]["ball"].as_f64().unwrap() > 0.09), (&"fixed".into(), true));
    let (numbers, rope) = (data.frames(), 2 + 7 * 9);
    let [both, one] = [1 + 2 * rope + 4 * 7, 1 + rope + 4 * 7];
    assert_eq!(numbers.len(), 30 * both + 21 * one);
    let ball = &numbers[both - 7..both - 4];
    assert_eq!(ball, [3.0, 3.0, 0.0], "before it is there");
    let end = &numbers[30 * both + 20 * one..];
    for (node, s) in last.node_arc_lengths().into_iter().enumerate() {
        let (x, shown) = (last.sample(s).unwrap().position, &end[3 + 9 * node + 1..][..3]);
        assert!((0..3).all(|i| x[i] as f32 == shown[i]), "{x} {shown:?}");
    }
    assert_eq!(end[1 + rope..][..3], [at.x, at.y, at.z]);
    // the tip hangs 0.25 m below the hook, in its axes
    let tip = &end[1 + rope + 7..][..3];
    assert!(((tip[0] - at.x).hypot(tip[1] - at.y) - 0.25).abs() < 1e-6, "{tip:?} {at}");
    assert_eq!(Data::doubles(&data.0["probes"][0]["rows"]), [0.0, 1.0, 0.5, 2.0]);
    assert_eq!(data.0["summary"]["told"][0], "a line");
    assert!(crane.film.svg().contains("<animate"));
}

#[test]
fn a_long_film_keeps_to_its_number_of_frames() {
    let (world, cables) = (PhysicsWorld::new(), CableSet::new());
    let mut film = Film::new("nothing", [0.0, -9.81, 0.0]);
    (0..5000).for_each(|step| film.take(f64::from(step), &world, &cables).unwrap());
    let times = Data::of(&film.page(&[], &[])).times();
    assert!(times.len() > FRAMES / 2 && times.len() <= FRAMES, "{}", times.len());
    let mut alone = Film::new("rope", [0.0, 0.0, -9.81]);
    let section = Section::round(0.01, 1e8, 1000.0).unwrap();
    let rope = Cable::builder().points([Vector3::zeros(), Vector3::x()]).section(section).elements(4).build().unwrap();
    alone.take_cables(0.0, [&rope], &[]).unwrap();
    assert_eq!(Data::of(&alone.page(&[], &[])).frames().len(), 3 + 5 * 9);
}

/// The page of a film draws with names, from its first to its last frame, without an error of the page.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn the_page_of_a_film_draws() {
    let mut crane = Crane::new();
    crane.run(50);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.html");
    let read = Series { name: "height".into(), columns: vec!["t".into(), "y".into()], rows: vec![0.0, 1.0, 0.5, 2.0] };
    std::fs::write(&path, crane.film.page(&[read], &[])).unwrap();
    let mut page = Browser::start(1000, 700);
    page.open(&path);
    page.ask("(document.getElementById('names').checked = true, show())");
    assert_eq!(page.ask("document.documentElement.dataset.frames"), "50");
    page.ask("goTo(49)");
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}
