//! Contact, reels, sheaves and moving bodies on one rope: what cranes and grapples do.

use lariat_scene::run::{Options, Recording, collect};
use lariat_scene::{Purpose, Scene};

fn run(text: &str) -> Recording {
    let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let run = collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(run.failed.is_none(), "{:?}", run.failed);
    run
}

/// Returns a column of a probe.
fn column(run: &Recording, probe: &str, name: &str) -> Vec<f64> {
    let probe = run.probes.iter().find(|p| p.name == probe).unwrap();
    let at = probe.columns.iter().position(|c| *c == name).unwrap_or_else(|| panic!("{name} of {:?}", probe.columns));
    probe.rows.chunks(probe.columns.len()).map(|row| row[at]).collect()
}

/// Asserts that integration made no energy, and lost at most a share of what was exchanged.
fn assert_balanced(run: &Recording, most: f64) {
    let balance = run.summary.energy_balance.as_ref().unwrap();
    println!("made {:.1e}, lost {:.1e} of {:.3e} J", balance.made(), balance.lost(), balance.scale_j);
    assert!(balance.made() < 1e-6 && balance.lost() < most, "{balance:?}");
}

/// Returns where a probe's body or attachment is at the end.
fn last(run: &Recording, probe: &str, name: &str) -> f64 {
    *column(run, probe, name).last().unwrap()
}

/// Who swings on 10 m of rope round a square post winds round it while the rope is reeled in: the rope that is out is what was asked, no
/// energy is made, the rope stays outside, and it ends shorter on the far side of the post than a rope that touches nothing.
///
/// *Source.* Length and energy: conservation. A rope through the post would swing the player on.
#[test]
fn a_grapple_winds_round_a_post_and_reels_in() {
    for (half, mass, reeled, friction) in [(0.15, 80.0, 3.0, 0.3), (0.1, 60.0, 2.0, 0.0), (0.25, 95.0, 3.5, 0.5)] {
        let stop = 0.5 + reeled;
        let run = run(&format!(
            "duration = {:?}\n[[body]]\nname = \"post\"\nkind = \"fixed\"\nshape = {{ cuboid = [{half:?}, {half:?}, 2.0] }}\n\
             position = [0.4, -3.0, 0.0]\nfriction = {friction:?}\n[[body]]\nname = \"player\"\nshape = {{ ball = 0.2 }}\nmass = {mass:?}\n\
             position = [-8.0, -6.0, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [-8.0, -6.0, 0.0]]\nelements = 40\n\
             axial_stiffness = 1.0e5\nbending_stiffness = 0.02\nmass_per_length = 0.05\ndamping = {{ axial = 0.02, bending = 0.05 }}\n\
             integrator = {{ fidelity = \"game\" }}\ncontact = {{ radius = 0.01, friction = {friction:?} }}\n\
             reel = {{ end = \"start\", rate = [[0.0, 0.0], [0.5, -1.0], [{stop:?}, 0.0]], acceleration = 2.0, max_force = 6000.0 }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"player\"\n\
             [[probe]]\nname = \"reel\"\nreel = \"rope\"\n[[probe]]\nname = \"player\"\nbody = \"player\"\n",
            stop + 1.0
        ));
        let length = last(&run, "reel", "length_out");
        assert!((length - (10.0 - reeled)).abs() < 1e-3, "{length} m");
        assert_balanced(&run, 0.02);
        assert!(!run.summary.told.iter().any(|warning| warning.contains("passed through")), "{:?}", run.summary.told);
        let x = column(&run, "player", "x").into_iter().fold(f64::NEG_INFINITY, f64::max);
        let far = run.world.cables()[0].overlap();
        assert!(far.is_none_or(|overlap| !overlap.crosses), "{far:?}");
        println!("half {half}: {length} m out, the player came to x = {x}");
    }
}

/// The hook rope of a crane lies on its own jib, which is slewed and raised while the winch at its foot pays in: length, energy, and
/// the hook carries its load throughout.
///
/// *Source.* Length and energy: conservation; weight and centrifugal force of the load.
#[test]
fn the_rope_of_a_crane_lies_on_its_jib() {
    let run = run(
        "duration = 6.0\n[[body]]\nname = \"jib\"\nkind = \"kinematic\"\nshape = { cuboid = [3.0, 0.15, 0.3] }\nposition = [0.0, 0.0, 0.0]\n\
        friction = 0.2\npath = { rotation = [[0.0, 0, 0, 0], [1.0, 0, 0.0, 0], [2.0, 0, 0.1, 0], [4.0, 0, 0.4, 0], [6.0, 0, 0.6, 0]] }\n\
        [[body]]\nname = \"load\"\nshape = { cuboid = [0.2, 0.2, 0.2] }\nmass = 100.0\nposition = [3.02, -3.2, 0.0]\n\
        [[cable]]\nname = \"rope\"\npoints = [[-2.5, 0.17, 0.0], [3.0, 0.17, 0.0], [3.02, 0.15, 0.0], [3.02, -3.0, 0.0]]\nelements = 60\n\
        axial_stiffness = 1.0e6\nbending_stiffness = 0.1\nmass_per_length = 0.4\ndamping = { axial = 0.005, bending = 0.03 }\n\
        integrator = { fidelity = \"game\" }\ncontact = { radius = 0.02, friction = 0.2 }\n\
        reel = { end = \"start\", rate = [[0.0, 0.0], [1.0, -0.3], [5.0, 0.0]], acceleration = 0.5 }\n\
        [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"jib\"\n[[attachment]]\nname = \"hook\"\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\n\
        [[probe]]\nname = \"reel\"\nreel = \"rope\"\n[[probe]]\nname = \"load\"\nbody = \"load\"\n",
    );
    let out = column(&run, "reel", "length_out");
    let (first, end) = (out[0], *out.last().unwrap());
    assert!((first - end - 1.2).abs() < 1e-3, "{first} m, {end} m");
    assert_balanced(&run, 0.02);
    let height = column(&run, "load", "y");
    let (low, lifted) = (height[0], *height.last().unwrap());
    println!("load from {low} to {lifted} m");
    assert!((lifted - low - 1.2).abs() < 0.1, "{low} m, {lifted} m");
}

/// A load runs down on a rope over a sheave whose other part lies on a floor with friction: energy, and the same motion by steps of a
/// quarter.
///
/// *Source.* Conservation; the same scene at dt/4.
#[test]
fn the_free_part_of_a_rope_over_a_sheave_lies_on_the_floor() {
    let fall = |dt: f64| {
        let run = run(&format!(
            "duration = 1.0\ndt = {dt:?}\n[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = {{ plane = [0.0, 1.0, 0.0] }}\nfriction = 0.4\n\
             [[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = 3.0\nposition = [0.0, 2.0, 0.0]\n[[cable]]\nname = \"rope\"\n\
             points = [[0.0, 2.1, 0.0], [0.0, 3.0, 0.0], [0.5, 0.3, 0.0], [0.8, 0.02, 0.0], [3.0, 0.02, 0.0]]\nelements = 40\naxial_stiffness = 1.0e5\n\
             bending_stiffness = 0.02\nmass_per_length = 0.3\ndamping = {{ axial = 0.005, bending = 0.03 }}\nintegrator = {{ fidelity = \"game\" }}\n\
             contact = {{ radius = 0.02, friction = 0.4 }}\n[[sheave]]\ncable = \"rope\"\nat = 0.9\nbody = \"world\"\nanchor = [0.0, 3.0, 0.0]\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"load\"\n[[probe]]\nname = \"load\"\nbody = \"load\"\n"
        ));
        assert_balanced(&run, 0.03);
        last(&run, "load", "y")
    };
    let (coarse, fine) = (fall(1.0 / 60.0), fall(1.0 / 240.0));
    println!("{coarse} m, {fine} m");
    assert!(fine < 1.9 && (coarse - fine).abs() < 0.02 * (2.0 - fine), "{coarse} m, {fine} m");
}

/// The world bears a rope that it holds and the rope that hangs on it beside an end, within the last element, whichever of both has which name:
/// one of them keeps their contacts.
///
/// *Source.* Balance of forces; the couple of friction between both, which is not in it, is at most mu N r over an element.
#[test]
fn the_world_bears_what_hangs_on_a_rope_that_it_holds() {
    for (held, hung) in [("a", "b"), ("b", "a"), ("held", "hung")] {
        let contact = "contact = { radius = 0.005, friction = 0.3, cables = true }\ndamping = { axial = 0.01, bending = 0.03 }\n\
                       integrator = { fidelity = \"game\" }\naxial_stiffness = 1e6\nbending_stiffness = 0.01\nmass_per_length = 0.14\n";
        let end = |name: &str, at: &str| {
            format!(
                "[[attachment]]\nname = \"{name}\"\ncable = \"{held}\"\nat = \"{at}\"\nbody = \"world\"\n[[probe]]\nname = \"{name}\"\nattachment = \"{name}\"\n"
            )
        };
        let run = run(&format!(
            "duration = 25.0\n[[body]]\nname = \"far\"\nkind = \"fixed\"\nshape = {{ ball = 0.1 }}\nposition = [9.0, 0.0, 0.0]\n\
             [[cable]]\nname = \"{held}\"\npoints = [[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]]\nelements = 4\n{contact}\
             [[cable]]\nname = \"{hung}\"\npoints = [[0.42, -0.4, -0.035], [0.42, 0.03, -0.035], [0.42, 0.06, 0.0], [0.42, 0.03, 0.035], [0.42, -0.4, 0.035]]\n\
             elements = 24\n{contact}{}{}",
            end("left", "start"),
            end("right", "end")
        ));
        let weight = 0.14 * 9.81 * run.world.cables().iter().map(|cable| cable.length()).sum::<f64>();
        let mean = |probe: &str| {
            let forces = column(&run, probe, "fy");
            forces[forces.len() - 60..].iter().sum::<f64>() / 60.0
        };
        let (left, right) = (mean("left"), mean("right"));
        println!("{held}, {hung}: {left:.4} and {right:.4} N of {weight:.4} N");
        assert!((left + right + weight).abs() < 0.3 * 1.31 * 0.005 / 0.25 + 1e-3 * weight, "{left} {right} {weight}");
    }
}
