//! Ropes that cannot push: what a lift carries goes on when it stops, and what stands on a rope comes down.

use lariat_scene::run::World;
use lariat_scene::{Purpose, Scene};

/// A lift that runs up and stops at once, with a load below it on a rope of which the middle is drawn aside.
struct Lift {
    speed: f64,
    mass: f64,
    length: f64,
    stiffness: f64,
    damping: f64,
    aside: f64,
    elements: usize,
    fidelity: &'static str,
    law: &'static str,
}

impl Lift {
    const STOPS: f64 = 8.0;

    fn scene(&self) -> Scene {
        let Lift { speed, mass, length, stiffness, damping, aside, elements, fidelity, law } = *self;
        let runs = 1.0;
        // runs up with constant acceleration, then at its speed
        let mut path: Vec<[f64; 4]> = (0..=30)
            .map(|k| {
                let t = f64::from(k) / 30.0 * runs;
                [t, 0.0, 0.5 * speed / runs * t * t, 0.0]
            })
            .collect();
        let top = 0.5 * speed * runs + speed * (Self::STOPS - runs);
        path.extend([[Self::STOPS, 0.0, top, 0.0], [20.0, 0.0, top, 0.0]]);
        let text = format!(
            "duration = {:?}\n[[body]]\nname = \"lift\"\nkind = \"kinematic\"\nshape = \"none\"\npath = {path:?}\n\
             [[body]]\nname = \"load\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = {mass:?}\nposition = [0.0, {:?}, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [{aside:?}, {:?}, 0.0], [0.0, {:?}, 0.0]]\nelements = {elements}\n\
             axial_stiffness = {stiffness:?}\nbending_stiffness = 0.05\nmass_per_length = 0.1\n{law}\n\
             damping = {{ axial = {damping:?}, bending = 0.02 }}\nintegrator = {{ fidelity = {fidelity:?} }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"lift\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\n",
            Self::STOPS + 2.0,
            -length - 0.1,
            -0.5 * length,
            -length,
        );
        Scene::parse("lift.toml", &text, &[], Purpose::Run).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }

    /// How far the load rises after the stop, in m, and the highest place in the 2 s after it.
    fn hop(&self) -> f64 {
        let mut world = World::build(&self.scene()).unwrap();
        world.start(Purpose::Run).unwrap();
        let (mut at_stop, mut top) = (0.0, f64::NEG_INFINITY);
        let stops = (60.0 * Self::STOPS) as u32;
        for step in 1..=stops + 60 {
            world.advance(f64::from(step) / 60.0).unwrap();
            let height = world.body(1).unwrap().position.y;
            if step == stops {
                at_stop = height;
            }
            top = top.max(height);
        }
        top - at_stop
    }

    /// The same of a point mass on a spring and a damper that do not push, at rest on it at the stop.
    fn by_hand(&self) -> f64 {
        let (weight, k) = (self.mass * 9.81, self.stiffness / self.length);
        let (mut stretch, mut rate) = (weight / k, -self.speed);
        let (h, mut rise, mut top) = (1e-6, 0.0, 0.0f64);
        for _ in 0..1_000_000 {
            let pull = if stretch > 0.0 { (k * (stretch + self.damping * rate)).max(0.0) } else { 0.0 };
            rate += h * (9.81 - pull / self.mass);
            stretch += h * rate;
            rise -= h * rate;
            top = top.max(rise);
        }
        top
    }
}

/// With the axial law of a rope the hop is that of the load on a string, on every mesh, at every offset of the rope, in game and
/// engineering. By a law that pushes a straight rope first stands, for as long as its bend takes to grow: the hop is less then, and no
/// number of the offset (`docs/decisions/elements.md`).
///
/// *Source.* `Lift::by_hand`: a point mass on a spring and a damper of Kelvin and Voigt that do not push.
#[test]
fn a_load_goes_on_when_its_lift_stops() {
    let case = |speed, mass, length, stiffness| {
        let (damping, aside, elements, fidelity, law) = (1e-3, 0.0, 10, "game", "axial_law = \"rope\"");
        Lift { speed, mass, length, stiffness, damping, aside, elements, fidelity, law }
    };
    for (lift, fidelity) in [
        (case(2.0, 50.0, 3.0, 2e5), "game"),
        (case(2.0, 50.0, 3.0, 2e5), "engineering"),
        (Lift { damping: 3e-3, ..case(1.3, 200.0, 6.0, 1e6) }, "game"),
        (case(2.7, 15.0, 2.0, 1e5), "game"),
    ] {
        for (aside, elements) in [(0.0, 10), (1e-4, 40), (1e-3, 20), (1e-2, 10)] {
            let lift = Lift { aside, elements, fidelity, ..lift };
            let (hop, hand) = (lift.hop(), lift.by_hand());
            println!(
                "{fidelity} {} m/s, {} kg, {aside} m, {elements}: {hop:.4} m for {hand:.4} m",
                lift.speed, lift.mass
            );
            assert!((hop / hand - 1.0).abs() < 0.02, "{hop} {hand}");
        }
    }
    let pushes = Lift { law: "", ..case(2.0, 50.0, 3.0, 2e5) };
    for aside in [0.0, 1e-2] {
        let hop = Lift { aside, ..pushes }.hop();
        println!("by a law that pushes, {aside} m: {hop:.4} m");
        assert!((0.13..0.2).contains(&hop), "{hop}");
    }
}

/// A load that stands on a straight rope comes down within a second, on every mesh.
///
/// *Source.* Euler's load of the rope, 1.2 N, which bears no 196 N.
#[test]
fn a_load_does_not_stand_on_a_rope() {
    for (elements, fidelity) in [(10, "game"), (40, "game"), (100, "game"), (10, "engineering")] {
        let text = format!(
            "duration = 1.0\n[[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = 20.0\nposition = [0.0, 2.1, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]]\nelements = {elements}\n\
             axial_stiffness = 1.6e6\nbending_stiffness = 0.5\nmass_per_length = 0.14\n\
             damping = {{ axial = 2e-4, bending = 0.01 }}\nintegrator = {{ fidelity = {fidelity:?} }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, -0.1, 0.0]\n"
        );
        let scene = Scene::parse("load.toml", &text, &[], Purpose::Run).unwrap();
        let mut world = World::build(&scene).unwrap();
        world.start(Purpose::Run).unwrap();
        for step in 1..=60 {
            world.advance(f64::from(step) / 60.0).unwrap();
        }
        let height = world.body(0).unwrap().position.y;
        println!("{fidelity} {elements}: {height} m");
        assert!(height < 1.0, "{elements}: {height}");
    }
}
