//! The energy balance of runs: closed with error control, and a warning where integration makes or takes energy.

use lariat_ancf::{Fidelity, Integrator, Method, StepControl};
use lariat_scene::run::{self, EnergyBalance, Options, Summary, World};
use lariat_scene::{Purpose, Scene, Warning};
use std::path::Path;

fn read(name: &str, overrides: &[&str]) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.toml"));
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::read(&file, &overrides, Purpose::Run).unwrap()
}

fn execute(scene: &Scene) -> (Summary, EnergyBalance) {
    let folder = tempfile::tempdir().unwrap();
    let summary = run::run(scene, folder.path(), &mut Options::default()).unwrap();
    let balance = summary.energy_balance.unwrap();
    println!("{}: {:.1e}, {balance:?}, {} steps", scene.name, share(&balance), summary.steps);
    (summary, balance)
}

fn with(mut scene: Scene, integrator: Integrator) -> Scene {
    scene.cables.iter_mut().for_each(|cable| cable.integrator = integrator.into());
    scene
}

fn share(balance: &EnergyBalance) -> f64 {
    balance.made().max(balance.lost())
}

/// *Source.* The work-energy theorem. Among the works are those of a ramped force (cantilever, elastica) and moment (elastica), of winch and
/// helicopter (hoist, slung load), of a flow (towed line), and of damping in a transient of milliseconds (bridge).
#[test]
fn the_balance_of_every_scene_closes_with_error_control() {
    for (name, tolerance, duration) in [
        ("falling_pendulum", 1e-6, 2.0),
        ("catenary", 1e-6, 1.0),
        ("cantilever", 1e-7, 2.0),
        ("elastica", 1e-6, 3.0),
        ("towed_line", 1e-6, 5.0),
        ("dumbbell", 1e-6, 3.0),
        ("payload_pendulum", 1e-6, 1.0),
        ("hoist", 1e-7, 14.0),
        ("slung_load", 1e-6, 10.0),
        ("tether_multibody", 1e-6, 6.0),
        ("cable_stayed", 1e-7, 2.0),
        ("bridge", 1e-7, 1.0),
    ] {
        let scene = with(
            read(name, &[&format!("duration={duration:?}")]),
            Integrator::tolerance(Method::Esdirk4, tolerance).unwrap(),
        );
        let (_, balance) = execute(&scene);
        assert!(share(&balance) < 1e-4, "{name}: {:.1e}", share(&balance));
    }
}

/// The discrete gradient has a law of its own: it makes no energy in any scene, and what it loses is its numerical dissipation.
///
/// *Source.* The law, `docs/theory.md`.
#[test]
fn the_discrete_gradient_makes_no_energy_and_knows_what_it_loses() {
    for name in ["falling_pendulum", "cantilever", "elastica", "towed_line", "dumbbell", "slung_load", "bridge"] {
        let mut scene = read(name, &["duration=1.0"]);
        scene.cables.iter_mut().for_each(|cable| cable.integrator = Fidelity::Game);
        let (summary, balance) = execute(&scene);
        let gained = summary.energy_end_j.unwrap() - summary.energy_start_j.unwrap();
        // the energy in store apart, which is the square of a step
        let by_work = gained + balance.dissipated_j - balance.work_j;
        assert!((by_work - balance.balance_j).abs() < 2e-2 * balance.scale_j, "{name}: {by_work:e}");
        assert!(balance.made() < 1e-6, "{name}: {:.1e}", balance.made());
    }
}

/// Steps of 0.01 s of a pendulum by the alpha method with the strongest damping take 8 % of its energy.
///
/// *Source.* The energy at the start and the end, of a system without work.
#[test]
fn energy_that_integration_takes_is_told() {
    let scene =
        with(read("falling_pendulum", &[]), Integrator::substeps(Method::GeneralisedAlpha { rho: 0.0 }, 1).unwrap());
    let (summary, balance) = execute(&scene);
    let lost = summary.energy_start_j.unwrap() - summary.energy_end_j.unwrap();
    assert!((balance.balance_j + lost).abs() < 1e-9 * balance.scale_j && lost > 0.0);
    let told = |w: &Warning| matches!(w, Warning::EnergyLost { lost_j, .. } if *lost_j >= lost);
    assert!(summary.warnings.iter().any(told), "{:?}", summary.warnings);
}

/// The alpha method with the strongest damping overshoots displacements in the first step of a stiff, damped cable that is let go out of
/// balance: it makes hundreds of joules, which damping takes, where 12 J are moved. The discrete gradient and error control do not.
///
/// *Source.* Bounds of the true motion: the same scene with error control, [above](the_balance_of_every_scene_closes_with_error_control).
#[test]
fn energy_that_integration_makes_is_told() {
    let control = StepControl::MaxStep(1.0 / 240.0);
    let integrator = Integrator { method: Method::GeneralisedAlpha { rho: 0.0 }, control };
    let (summary, balance) = execute(&with(read("bridge", &["duration=0.1"]), integrator));
    assert!(balance.made_j > 100.0 && balance.dissipated_j > 100.0);
    assert!(summary.warnings.iter().any(|w| matches!(w, Warning::EnergyMade { .. })), "{:?}", summary.warnings);
    let (summary, _) = execute(&read("bridge", &["duration=0.1"]));
    assert!(!summary.warnings.iter().any(|w| matches!(w, Warning::EnergyMade { .. })), "{:?}", summary.warnings);
}

/// A kinematic body that starts at once, with a velocity that no cable had, pulls a cable with a body: the impact and the pull do work.
///
/// *Source.* The work-energy theorem.
#[test]
fn the_work_of_a_kinematic_body_that_starts_at_once_is_known() {
    for (speed, mass, stiffness) in [(3.0, 5.0, 1e5), (0.5, 0.2, 1e4), (6.0, 40.0, 1e6)] {
        let text = format!(
            "duration = 1.0\n[[body]]\nname = \"top\"\nkind = \"kinematic\"\nshape = \"none\"\npath = [[0.2, 0.0, 0.0, 0.0], [3.2, {:?}, 0.0, 0.0]]\n\
             [[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = {mass:?}\nposition = [0.0, -3.0, 0.0]\n[[cable]]\nname = \"line\"\n\
             points = [[0.0, 0.0, 0.0], [0.0, -3.0, 0.0]]\naxial_stiffness = {stiffness:?}\nbending_stiffness = 0.1\nmass_per_length = 0.5\n\
             integrator = {{ tolerance = 1e-7 }}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"top\"\n[[attachment]]\n\
             cable = \"line\"\nat = \"end\"\nbody = \"load\"\n",
            3.0 * speed
        );
        let (_, balance) = execute(&Scene::parse("pulled.toml", &text, &[], Purpose::Run).unwrap());
        assert!(share(&balance) < 1e-4 && balance.work_j > 0.0, "{speed} m/s, {mass} kg: {:.1e}", share(&balance));
    }
}

/// A crane turns at half a radian per second with a load of 200 kg: all that the load gains is the work of the kinematic body, in
/// the balance with error control as in that of the discrete gradient.
///
/// *Source.* The work-energy theorem; the two methods know the work by different quadratures.
#[test]
fn the_work_of_a_body_that_rotates_is_in_the_balance() {
    for (radius, rate) in [(20.0, 0.5), (2.0, 3.0)] {
        let speed: f64 = -radius * rate;
        let text = format!(
            r#"
            duration = 2.0
            [[body]]
            name = "crane"
            kind = "kinematic"
            shape = "none"
            angular_velocity = [0.0, {rate:?}, 0.0]
            [[body]]
            name = "load"
            shape = {{ cuboid = [0.3, 0.3, 0.3] }}
            mass = 200.0
            position = [{radius:?}, -10.3, 0.0]
            velocity = [0.0, 0.0, {speed:?}]
            [[cable]]
            name = "fall"
            points = [[{radius:?}, 0.0, 0.0], [{radius:?}, -10.0, 0.0]]
            elements = 10
            axial_stiffness = 2e6
            bending_stiffness = 5.0
            mass_per_length = 0.5
            velocity = [0.0, 0.0, {speed:?}]
            [cable.damping]
            axial = 1e-3
            bending = 1e-3
            [[attachment]]
            name = "tip"
            cable = "fall"
            at = "start"
            body = "crane"
            anchor = [{radius:?}, 0.0, 0.0]
            [[attachment]]
            name = "hook"
            cable = "fall"
            at = "end"
            body = "load"
            anchor = [0.0, 0.3, 0.0]
            "#
        );
        let works = [Fidelity::Engineering, Fidelity::Game].map(|fidelity| {
            let mut scene = Scene::parse("crane.toml", &text, &[], Purpose::Run).unwrap();
            scene.cables[0].integrator = fidelity;
            let (_, balance) = execute(&scene);
            assert!(share(&balance) < 1e-4, "{radius}, {fidelity:?}: {:.1e}", share(&balance));
            balance.work_j
        });
        assert!((works[0] - works[1]).abs() < 1e-2 * works[0].abs(), "{radius}: {works:?}");
    }
}

/// Friction and impacts only take energy, whatever the bodies do that a cable touches: fixed, driven or moved by it.
///
/// *Source.* The second law of thermodynamics; none of the scenes has a flow that could drive a cable.
#[test]
fn contacts_never_give_back_what_they_dissipated() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/contact");
    let mut scenes = 0;
    for file in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let scene = Scene::read(&file, &[], Purpose::Run).unwrap();
        let mut world = World::build(&scene).unwrap();
        world.start(Purpose::Run).unwrap();
        let scale = world.energy(None).total().abs();
        let mut before = 0.0;
        for step in 1..=(scene.duration / scene.dt).round().min(120.0) as u32 {
            world.advance(f64::from(step) * scene.dt).unwrap();
            let now = world.dissipated(None);
            assert!(now >= before - 1e-9 * scale, "{}: {before} {now} J, step {step}", scene.name);
            before = now;
        }
        println!("{}: {before:.3} J", scene.name);
        assert!(before > 0.0, "{}: nothing was dissipated", scene.name);
        scenes += 1;
    }
    assert!(scenes >= 10, "{scenes}");
}

/// A kinematic body that starts, turns corners and stops at once, or rotates at once, with balls and clamps, one end or both, with damping or without.
///
/// *Source.* The work-energy theorem. Before, the reactions at both ends of a step gave the work, which missed it by more than the energy of the run where a jump of
/// velocity leaves transients; that of clamps was counted twice, and that of stops not at all.
#[test]
fn the_work_of_jumps_of_velocity_is_known() {
    let path = "path = [[0.05, 0.0, 0.0, 0.0], [0.15, 0.15, 0.05, 0.0], [0.25, 0.1, 0.1, 0.1]]";
    let both = "[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"mover\"\nkind = \"ball\"\n";
    let damped = "damping = { axial = 1e-3, bending = 1e-2 }";
    for (motion, kind, far, damping) in [
        (path, "ball", "", ""),
        (path, "ball", "", damped),
        (path, "clamp", "", ""),
        (path, "clamp", "", damped),
        (path, "clamp", both, damped),
        (path, "ball", both, ""),
        (path, "ball", &both.replace("mover", "world"), damped),
        ("angular_velocity = [0.0, 1.0, 3.0]", "clamp", "", damped),
        ("angular_velocity = [0.0, 1.0, 3.0]", "ball", both, damped),
        (
            "velocity = [0.5, 2.0, 0.3]\nangular_velocity = [1.0, 0.0, -2.0]",
            "clamp",
            &both.replace("mover", "world"),
            damped,
        ),
    ] {
        for (stiffness, bending, mass) in [(6.4e5, 32.0, 0.14), (1e4, 0.02, 0.5)] {
            let text = format!(
                "duration = 0.4\ndt = 0.01\n[[body]]\nname = \"mover\"\nkind = \"kinematic\"\nshape = \"none\"\n{motion}\n[[cable]]\nname = \"line\"\npoints = \
                 [[0.3, 0.0, 0.0], [1.0, -2.0, 0.0], [2.0, -2.5, 0.0]]\nelements = 12\naxial_stiffness = {stiffness:?}\nbending_stiffness = {bending:?}\n\
                 mass_per_length = {mass:?}\n{damping}\nintegrator = {{ tolerance = 1e-8 }}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \
                 \"mover\"\nkind = {kind:?}\n{far}"
            );
            let (_, balance) = execute(&Scene::parse("jump.toml", &text, &[], Purpose::Run).unwrap());
            assert!(
                share(&balance) < 1e-4 && balance.work_j != 0.0,
                "{motion} {kind} {far} {damping}: {:.1e}",
                share(&balance)
            );
        }
    }
}

/// A body sets the end of a damped rope in water in motion at once. A tolerance of 1e-4 m finds its motion, but no step resolves its axial waves: what
/// damping takes of them is uncertain, and no energy is said to be made. A tolerance that resolves them leaves no doubt.
///
/// *Source.* The run with the small tolerance, whose balance closes.
#[test]
fn no_energy_is_made_where_only_what_damping_takes_is_uncertain() {
    let text = |tolerance: f64| {
        format!(
            "duration = 0.675\ndt = 0.02\n[[body]]\nname = \"k\"\nkind = \"kinematic\"\nshape = \"none\"\npath = [[0.153, 0.0, 0.0, 0.0], [0.3212, 0.0, \
             0.2425, 0.1209]]\n[[cable]]\nname = \"c\"\npoints = [[0.0, 0.0, 0.0], [1.157, 0.0, 0.0]]\nelements = 8\nsection = {{ round = 0.00717 }}\n\
             density = 992.0\nyoungs_modulus = 1.855e9\ndamping = {{ axial = 0.00466, bending = 0.0011 }}\ndrag = {{ fluid_density = 1000.0 }}\n\
             integrator = {{ tolerance = {tolerance:?} }}\n[[attachment]]\ncable = \"c\"\nat = \"start\"\nbody = \"k\"\n"
        )
    };
    for (tolerance, least, most) in [(1e-4, 1e-3, 0.1), (1e-6, 0.0, 1e-3)] {
        let (summary, balance) = execute(&Scene::parse("jolt.toml", &text(tolerance), &[], Purpose::Run).unwrap());
        let uncertain = balance.rounding_j / balance.scale_j;
        assert!((least..most).contains(&uncertain), "{tolerance}: {uncertain:e}");
        let told = |w: &Warning| matches!(w, Warning::EnergyMade { .. } | Warning::EnergyLost { .. });
        assert!(!summary.warnings.iter().any(told), "{tolerance}: {:?}", summary.warnings);
    }
}

/// A crate that a reel lets down onto the ground, and its rope that falls on it: contact and a reel on one cable, judged by the law.
///
/// *Source.* The energy law of the discrete gradient: no energy is made, and the weight of the crate does the work.
#[test]
fn a_cable_with_contact_and_a_reel_is_judged() {
    for (mass, rate) in [(10.0, 0.6), (40.0, 0.45)] {
        let text = format!(
            "duration = 3.0\n[[body]]\nname = \"ground\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\nposition = [0.0, -3.0, 0.0]\n\
             [[body]]\nname = \"load\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = {mass:?}\nposition = [0.0, -2.15, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\nelements = 20\naxial_stiffness = 2.0e5\n\
             bending_stiffness = 0.05\nmass_per_length = 0.1\nintegrator = {{ fidelity = \"game\" }}\ndamping = {{ axial = 0.005, bending = 0.03 }}\n\
             contact = {{ radius = 0.01, friction = 0.4 }}\nreel = {{ end = \"start\", rate = [[0.0, {rate:?}], [3.0, 0.0]] }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, 0.15, 0.0]\n"
        );
        let (_, balance) = execute(&Scene::parse("let_down.toml", &text, &[], Purpose::Run).unwrap());
        let fallen = mass * 9.81 * 0.75;
        assert!(balance.scale_j > 0.9 * fallen && balance.scale_j < 3.0 * fallen, "{balance:?}");
        assert!(balance.made() < 1e-3, "{balance:?}");
    }
}

/// A winch that sets a crate down on the ground, and goes on, by a rope without contact: no energy is made, at any speed, host step and fidelity.
///
/// *Source.* The energy law of the discrete gradient.
#[test]
fn a_winch_that_sets_a_load_down_makes_no_energy() {
    for (mass, rate, dt, fidelity) in [
        (10.0, 0.6, 1.0 / 60.0, "game"),
        (10.0, 2.0, 1.0 / 30.0, "game"),
        (3.0, 1.1, 1.0 / 120.0, "game"),
        (75.0, 1.4, 1.0 / 60.0, "game"),
        (10.0, 2.0, 1.0 / 60.0, "engineering"),
    ] {
        let end = 2.2 / rate;
        let text = format!(
            "duration = {:?}\ndt = {dt:?}\n[[body]]\nname = \"ground\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\n\
             position = [0.0, -3.0, 0.0]\n[[body]]\nname = \"load\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = {mass:?}\n\
             position = [0.0, -2.1, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\nelements = 20\n\
             axial_stiffness = 2.0e5\nbending_stiffness = 0.05\nmass_per_length = 0.1\nintegrator = {{ fidelity = \"{fidelity}\" }}\n\
             damping = {{ axial = 0.005, bending = 0.03 }}\nreel = {{ end = \"start\", rate = [[0.0, {rate:?}], [{end:?}, 0.0]], acceleration = 4.0 }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, 0.1, 0.0]\n",
            end + 0.3
        );
        let (_, balance) = execute(&Scene::parse("set_down.toml", &text, &[], Purpose::Run).unwrap());
        let fallen = mass * 9.81 * 0.8;
        assert!(balance.scale_j > 0.8 * fallen && balance.scale_j < 4.0 * fallen, "{mass} {rate} {balance:?}");
        assert!(balance.made() < 1e-3, "{mass} kg, {rate} m/s, {dt} s, {fidelity}: {balance:?}");
    }
}

/// A winch on a kinematic body that moves: body and winch do work, and what is wound up takes momentum along. The strain rate of the element at the
/// eye depends on the time. The load is let go at once and swings on the rope, so that the quadrature of the force at the eye shows: an eighth of the
/// host step errs by a fiftieth.
///
/// *Source.* The work-energy theorem.
#[test]
fn the_work_of_a_winch_on_a_moving_body_is_known() {
    for (speed, rate, mass, stiffness, density) in [
        (0.5, -0.5, 6.0, 3e5, 0.15),
        (1.0, -0.5, 6.0, 3e5, 1.5),
        (-0.3, 0.2, 0.5, 1e4, 0.15),
        (1.0, -0.8, 200.0, 4e6, 0.4),
    ] {
        for (dt, bound) in [(1.0 / 60.0, 1e-3), (1.0 / 480.0, 2e-5)] {
            let text = format!(
                "duration = 1.0\ndt = {dt:?}\n[[body]]\nname = \"top\"\nkind = \"kinematic\"\nshape = \"none\"\nvelocity = [0.0, {speed:?}, 0.0]\n\
                 [[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = {mass:?}\nposition = [0.0, -2.1, 0.0]\n\
                 velocity = [0.0, {speed:?}, 0.0]\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\n\
                 velocity = [0.0, {speed:?}, 0.0]\naxial_stiffness = {stiffness:?}\nbending_stiffness = 1e-3\n\
                 mass_per_length = {density:?}\nelements = 6\ndamping = {{ axial = 4e-3 }}\n\
                 reel = {{ end = \"start\", rate = [[0.0, {rate:?}]] }}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"top\"\n\
                 [[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, 0.1, 0.0]\n"
            );
            let (_, balance) = execute(&Scene::parse("winch.toml", &text, &[], Purpose::Run).unwrap());
            assert!(share(&balance) < bound, "{speed} m/s, {rate} m/s, {mass} kg, {dt} s: {:.1e}", share(&balance));
        }
    }
}

/// Floats that heave, drift and leave the water, with a cable of the default method in the scene: loose, and moored. Buoyancy, drag, wave, the added
/// mass that comes and goes, and the substeps of Rapier are in the balance.
///
/// *Source.* The work-energy theorem; single precision of bodies.
#[test]
fn the_work_of_water_is_known() {
    let loose = "[[cable]]\nname = \"c\"\npoints = [[50.0, 5.0, 0.0], [50.0, 4.0, 0.0]]\n";
    let moored = "[[cable]]\nname = \"c\"\npoints = [[0.0, -6.0, 0.0], [0.0, 0.2, 0.0]]\nlength = 6.6\n";
    let moor = "[[attachment]]\ncable = \"c\"\nat = \"end\"\nbody = \"float\"\n";
    let still = ("", "");
    let sea = (
        "current = [0.4, 0.0, 0.0]\nwave = { amplitude = 0.2, period = 4.0, direction = [1.0, 0.0, 0.0] }\n",
        "drag_area = 0.3, ",
    );
    for (mass, half, added) in [
        (0.3, 0.3, "0.8"),
        (40.0, 0.3, "0.8"),
        (180.0, 0.4, "0.8"),
        (40.0, 0.3, "[0.2, 1.1, 0.7]"),
        (180.0, 0.4, "[1.3, 0.4, 0.0]"),
    ] {
        for (cable, attachment) in [(loose, ""), (moored, moor)] {
            for (water, drag) in [still, sea] {
                for dt in [1.0 / 60.0, 1.0 / 480.0] {
                    let text = format!(
                        "duration = 6.0\ndt = {dt:?}\n[water]\ndensity = 1025.0\nlevel = 0.0\n{water}[[body]]\nname = \"float\"\n\
                         shape = {{ cuboid = [{half:?}, {half:?}, {half:?}] }}\nmass = {mass:?}\nposition = [0.0, 0.2, 0.0]\n\
                         water = {{ {drag}added_mass = {added} }}\n{cable}axial_stiffness = 5e4\nbending_stiffness = 0.1\n\
                         mass_per_length = 0.5\nelements = 6\ndamping = {{ axial = 0.005 }}\n\
                         [[attachment]]\ncable = \"c\"\nat = \"start\"\nbody = \"world\"\n{attachment}"
                    );
                    let (_, balance) = execute(&Scene::parse("float.toml", &text, &[], Purpose::Run).unwrap());
                    assert!(share(&balance) < 5e-4, "{mass} kg, {added}, {water:?}, {dt}: {:.1e}", share(&balance));
                }
            }
        }
    }
}

/// A winch with its stock on an arm that swings on a hinge off its centre: the forces by which the hinge takes part in the prediction do work on
/// the arm there, hundreds of times what is exchanged, which is no work on the rope. The account of rope and winch closes with the work of the rope on the arm.
///
/// *Source.* The work-energy theorem. What is exchanged is at most what arm, load and stock can fall, and the work of the winch.
#[test]
fn a_winch_on_a_hinged_arm_has_a_closed_account() {
    for (hinge, rate, mass, stock) in [
        (-0.5, 0.5, 20.0, 10.0),
        (-0.5, -0.4, 20.0, 10.0),
        (-0.5, 0.0, 5.0, 4.0),
        (-0.2, 0.3, 50.0, 2.5),
        (0.3, 0.5, 8.0, 6.0),
    ] {
        let at = 0.5 + hinge;
        let text = format!(
            "duration = 1.5\ndt = 0.004\n[[body]]\nname = \"arm\"\nshape = {{ cuboid = [0.5, 0.05, 0.05] }}\nmass = {mass:?}\nposition = [0.5, 0.0, 0.0]\n\
             [[body]]\nname = \"load\"\nshape = {{ ball = 0.05 }}\nmass = 2.0\nposition = [1.0, -2.05, 0.0]\n\
             [[joint]]\nkind = \"hinge\"\nbody = \"arm\"\nto = \"world\"\nat = [{at:?}, 0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[1.0, 0.0, 0.0], [1.0, -2.0, 0.0]]\nelements = 8\naxial_stiffness = 2.0e4\nbending_stiffness = 0.001\n\
             mass_per_length = 0.2\ndamping = {{ axial = 0.005, bending = 0.03 }}\nintegrator = {{ fidelity = \"game\" }}\n\
             reel = {{ end = \"start\", rate = [[0.0, {rate:?}]], stock = {stock:?} }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"arm\"\nanchor = [0.5, 0.0, 0.0]\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, 0.05, 0.0]\n"
        );
        let (summary, balance) = execute(&Scene::parse("arm.toml", &text, &[], Purpose::Run).unwrap());
        let falls = 9.81 * (mass + 2.0 + 0.2 * stock) * 4.0;
        println!("{hinge} m, {rate} m/s, {mass} kg: {balance:?}");
        assert!(balance.scale_j < 2.0 * falls, "{hinge} m, {rate} m/s: {balance:?}");
        assert!(balance.made() < 1e-3 && balance.lost() < 5e-3, "{hinge} m, {rate} m/s: {balance:?}");
        assert!(!summary.warnings.iter().any(|w| matches!(w, Warning::EnergyMade { .. })), "{:?}", summary.warnings);
    }
}
