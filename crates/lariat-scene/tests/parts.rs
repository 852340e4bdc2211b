//! A world of a scene that a program steps itself goes where the run of the scene goes.

use lariat_scene::run::{Parts, World};
use lariat_scene::{Error, Purpose, Scene};
use std::path::Path;

const STEPS: usize = 12;

fn shipped() -> impl Iterator<Item = Scene> {
    let folders = ["scenes", "contact"].map(|folder| format!("{}/../../assets/{folder}", env!("CARGO_MANIFEST_DIR")));
    let files = folders.into_iter().flat_map(|folder| std::fs::read_dir(folder).expect("a folder"));
    let tomls =
        files.map(|file| file.expect("a file").path()).filter(|path| path.extension().is_some_and(|e| e == "toml"));
    tomls.map(|path: std::path::PathBuf| Scene::read(Path::new(&path), &[], Purpose::Run).expect("a scene"))
}

#[test]
fn a_program_that_steps_a_scene_goes_where_its_run_goes() {
    let mut stepped = 0;
    for mut scene in shipped() {
        // the length of a step as a program has it: a run makes up for its rounding
        scene.dt = f64::from(scene.dt as f32);
        let mut parts = Parts::of(&scene).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        let mut run = World::build(&scene).expect("builds");
        run.start(Purpose::Run).expect("starts");
        for k in 0..STEPS {
            let (from, to) = (k as f64 * scene.dt, (k + 1) as f64 * scene.dt);
            parts.script.set(&mut parts.world, from, to);
            parts.cables.step(&mut parts.world).expect("steps");
            run.advance(to).expect("advances");
        }
        let mut worst = 0.0_f64;
        for (own, (name, handle)) in run.cables().iter().zip(&parts.ropes) {
            let other = parts.cables.get(*handle).expect("is in the set");
            assert_eq!(own.name(), name);
            for s in own.node_arc_lengths() {
                let [a, b] = [own, &other].map(|cable| cable.sample(s.min(cable.length())).expect("samples").position);
                worst = worst.max((a - b).norm());
            }
        }
        for (i, (_, handle)) in parts.bodies.iter().enumerate() {
            let own = run.body(i).expect("a body").position;
            let other = lariat_rapier::convert::vector(parts.world.bodies[*handle].translation());
            worst = worst.max((own - other).norm());
        }
        assert!(worst == 0.0, "{}: {worst:e} m", scene.name);
        stepped += 1;
    }
    assert!(stepped > 30, "{stepped} scenes stepped");
}

#[test]
fn a_cut_at_a_time_is_refused_by_name() {
    let rope = r#"
        duration = 1.0
        [[cable]]
        name = "rope"
        points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
        section = { square = 0.01 }
        density = 4000.0
        youngs_modulus = 1.0e8
        break = { time = 0.5, at = 1.0 }
    "#;
    let scene = Scene::parse("rope.toml", rope, &[], Purpose::Run).expect("a scene");
    let Err(Error::TimedCut { cable }) = Parts::of(&scene) else { panic!("not refused") };
    assert_eq!(cable, "rope");
}
