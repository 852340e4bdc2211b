//! Scenes with water: a towed fish, a buoy on a mooring in waves, what a copy does, and what is refused.

use lariat_ancf::Vector3;
use lariat_scene::run::World;
use lariat_scene::{Purpose, Scene};
use std::f64::consts::{PI, TAU};

const G: f64 = 9.81;

fn parsed(text: &str) -> Result<Scene, String> {
    Scene::parse("scene.toml", text, &[], Purpose::Run).map_err(|error| error.to_string())
}

fn started(text: &str) -> World {
    let mut world = World::build(&parsed(text).unwrap()).unwrap();
    world.start(Purpose::Run).unwrap();
    world
}

/// Numbers of a fish on a cable in a stream.
struct Tow {
    stream: f64,
    level: Option<f64>,
    length: f64,
    diameter: f64,
    normal: f64,
    tangential: f64,
    ea: f64,
    mass: f64,
    fish_mass: f64,
    fish_radius: f64,
    fish_area: f64,
}

const RHO: f64 = 1025.0;

impl Tow {
    fn scene(&self) -> String {
        let Tow { stream, length, diameter, normal, tangential, ea, mass, fish_mass, fish_radius, fish_area, .. } =
            *self;
        let level = self.level.map_or(String::new(), |level| format!("level = {level}\n"));
        let area = PI / 4.0 * diameter * diameter;
        // drawn as it will be, but turned by 0.03 rad about the ship
        let ship = Vector3::new(0.0, 2.0, 0.0);
        let turn = nalgebra::Rotation3::new(Vector3::new(0.0, 0.0, 0.03));
        let points: Vec<Vector3<f64>> = self.solve().0.into_iter().map(|x| ship + turn * (x - ship)).collect();
        let last = points[points.len() - 1];
        let (x, y) = (last.x, last.y);
        let points: Vec<[f64; 3]> = points.iter().map(|x| [x.x, x.y, x.z]).collect();
        format!(
            "duration = 150.0\n[water]\ndensity = {RHO}\n{level}current = [{stream}, 0.0, 0.0]\n\
             [[body]]\nname = \"fish\"\nshape = {{ ball = {fish_radius} }}\nmass = {fish_mass}\nposition = [{x}, {y}, 0.0]\n\
             [body.water]\ndrag_area = {fish_area}\nadded_mass = 0.5\n\
             [[cable]]\nname = \"wire\"\npoints = {points:?}\nlength = {length}\nelements = 40\n\
             axial_stiffness = {ea:e}\nbending_stiffness = 0.0\nmass_per_length = {mass}\naxial_law = \"hooke\"\n\
             [cable.damping]\naxial = 0.01\n\
             [cable.drag]\nnormal = {normal}\ntangential = {tangential}\ndiameter = {diameter}\n\
             [cable.buoyancy]\narea = {area:e}\n\
             [[attachment]]\nname = \"ship\"\ncable = \"wire\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\nname = \"tow\"\ncable = \"wire\"\nat = \"end\"\nbody = \"fish\"\n"
        )
    }

    /// The scene in equilibrium, drawn hanging.
    fn hanging(&self) -> String {
        let (text, length) = (self.scene(), self.length);
        let (from, to) = (text.find("position = ").unwrap(), text.find("[body.water]").unwrap());
        let text = format!("{}position = [0.0, {:?}, 0.0]\n{}", &text[..from], 2.0 - length, &text[to..]);
        let (from, to) = (text.find("points = ").unwrap(), text.find("length = ").unwrap());
        let hanging = format!("points = [[0.0, 2.0, 0.0], [0.0, {:?}, 0.0]]\n", 2.0 - length);
        format!("initial = \"equilibrium\"\n{}{hanging}{}", &text[..from], &text[to..])
    }

    /// The place of the fish, and the tension at the ship: d(T e)/ds = -f, dx/ds = e (1 + T/EA) from the fish up, by
    /// Runge and Kutta's method with 6000 steps; what is above the level has its weight alone. The height of the fish is
    /// found by bisection.
    fn solve(&self) -> (Vec<Vector3<f64>>, f64) {
        let buoyant = RHO * PI / 4.0 * self.diameter * self.diameter;
        let fish = {
            let weight = (self.fish_mass - RHO * 4.0 / 3.0 * PI * self.fish_radius.powi(3)) * G;
            Vector3::new(0.5 * RHO * self.fish_area * self.stream * self.stream, -weight, 0.0)
        };
        let per_length = |e: &Vector3<f64>, y: f64| {
            if self.level.is_some_and(|level| y > level) {
                return Vector3::new(0.0, -self.mass * G, 0.0);
            }
            let u = Vector3::new(self.stream, 0.0, 0.0);
            let along = e * e.dot(&u);
            let across = u - along;
            let k = 0.5 * RHO * self.diameter;
            let drag = (across * (self.normal * across.norm()) + along * (self.tangential * along.norm())) * k;
            drag + Vector3::new(0.0, -(self.mass - buoyant) * G, 0.0)
        };
        let shoot = |depth: f64| {
            let n = 6000;
            let h = self.length / n as f64;
            let (mut x, mut pull) = (Vector3::new(0.0, depth, 0.0), -fish);
            let rate = |x: &Vector3<f64>, pull: &Vector3<f64>| {
                let (e, tension) = (pull.normalize(), pull.norm());
                (e * (1.0 + tension / self.ea), -per_length(&e, x.y))
            };
            let mut way = vec![x];
            for i in 1..=n {
                let a = rate(&x, &pull);
                let b = rate(&(x + a.0 * (0.5 * h)), &(pull + a.1 * (0.5 * h)));
                let c = rate(&(x + b.0 * (0.5 * h)), &(pull + b.1 * (0.5 * h)));
                let d = rate(&(x + c.0 * h), &(pull + c.1 * h));
                x += (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0) * (h / 6.0);
                pull += (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1) * (h / 6.0);
                if i % 250 == 0 {
                    way.push(x);
                }
            }
            (way, pull)
        };
        // the ship is 2 m above the origin
        let (mut low, mut high) = (-self.length, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if shoot(middle).0[24].y > 2.0 { high = middle } else { low = middle }
        }
        let (way, pull) = shoot(low);
        let end = way[24];
        // from the ship, at x = 0, down
        (way.iter().rev().map(|x| Vector3::new(x.x - end.x, x.y, 0.0)).collect(), pull.norm())
    }
}

/// *Source.* The differential equation of a cable under drag and weight (of the tables of Reber 1944 and Pode 1951), integrated
/// by `Tow::solve`, which knows nothing of this library.
#[test]
fn a_towed_fish_is_where_the_equation_of_its_cable_puts_it() {
    let fish = Tow {
        stream: 2.5,
        level: None,
        length: 60.0,
        diameter: 0.01,
        normal: 1.2,
        tangential: 0.02,
        ea: 4e6,
        mass: 0.3,
        fish_mass: 60.0,
        fish_radius: 0.15,
        fish_area: 0.02,
    };
    for (level, tolerance) in [(None, 2e-4), (Some(0.0), 1e-3)] {
        let tow = Tow { level, ..fish };
        let (way, tension) = tow.solve();
        let place = way[way.len() - 1];
        let mut world = started(&tow.scene());
        let read = |world: &mut World| (world.body(0).unwrap().position, world.attachment(0).unwrap().0.norm());
        let at_first = read(&mut world);
        // its slowest swing decays in 18 s, c L^2/(pi^2 T) with c = rho d C_n u across the cable
        for step in 1..=9000 {
            world.advance(f64::from(step) / 60.0).unwrap();
        }
        let at_last = read(&mut world);
        println!(
            "{level:?}: {place} {tension} drawn {} {} at last {} {}",
            at_first.0, at_first.1, at_last.0, at_last.1
        );
        assert!((at_first.0 - place).norm() > 0.02 * place.norm());
        let (found, force) = at_last;
        assert!((found - place).norm() < tolerance * place.norm(), "{level:?} {found} {place}");
        assert!((force / tension - 1.0).abs() < tolerance, "{level:?} {force} {tension}");
    }
}

/// A fish that starts in equilibrium in a slow stream is where its equation puts it, and stays there, although it is drawn hanging.
///
/// *Source.* As above.
#[test]
fn a_towed_fish_starts_where_the_stream_holds_it() {
    let (stream, length, fish_mass, fish_area) = (1.0, 30.0, 60.0, 0.02);
    let (diameter, normal, tangential, ea, mass, fish_radius) = (0.01, 1.2, 0.02, 4e6, 0.3, 0.15);
    let level = Some(0.0);
    let tow = Tow { stream, level, length, diameter, normal, tangential, ea, mass, fish_mass, fish_radius, fish_area };
    let (way, tension) = tow.solve();
    let place = way[way.len() - 1];
    let text = tow.hanging();
    let mut world = started(&text);
    let (found, force) = (world.body(0).unwrap().position, world.attachment(0).unwrap().0.norm());
    println!("{stream} {length} {fish_mass}: {place} {tension} found {found} {force}");
    assert!((found - place).norm() < 1e-3 * place.norm(), "{found} {place}");
    assert!((force / tension - 1.0).abs() < 1e-3, "{force} {tension}");
    world.advance(5.0).unwrap();
    let moved = (world.body(0).unwrap().position - found).norm();
    println!("moves by {moved:e}");
    assert!(moved < 1e-5 * length, "{moved:e}");
}

/// Drawn hanging, a fish is found in every stream, on short and long wires, light and heavy.
///
/// *Source.* As above.
#[test]
fn a_fish_that_is_drawn_hanging_is_found_in_fast_streams() {
    let (mut missed, mut count, mut most) = (Vec::new(), 0, 0.0f64);
    for length in [10.0, 60.0, 300.0] {
        for stream in [0.3, 1.0, 2.5, 5.0, 10.0] {
            for fish_mass in [20.0, 60.0, 400.0] {
                for level in [None, Some(0.0)] {
                    let (diameter, normal, tangential, ea, mass) = (0.01, 1.2, 0.02, 4e6, 0.3);
                    let (fish_radius, fish_area) = (0.15, 0.02);
                    let tow = Tow {
                        stream,
                        level,
                        length,
                        diameter,
                        normal,
                        tangential,
                        ea,
                        mass,
                        fish_mass,
                        fish_radius,
                        fish_area,
                    };
                    let (way, tension) = tow.solve();
                    let place = way[way.len() - 1];
                    // a fish that comes out of the water is not what the equation knows
                    if level.is_some() && place.y > -fish_radius {
                        continue;
                    }
                    let mut world = World::build(&parsed(&tow.hanging()).unwrap()).unwrap();
                    count += 1;
                    let what = format!("{stream} m/s, {length} m, {fish_mass} kg, level {level:?}");
                    if let Err(error) = world.start(Purpose::Run) {
                        println!("{what}: {error}");
                        missed.push(what);
                        continue;
                    }
                    let (found, force) = (world.body(0).unwrap().position, world.attachment(0).unwrap().0.norm());
                    let off = ((found - place).norm() / length).max((force / tension - 1.0).abs());
                    println!("{what}: off by {off:.1e}");
                    most = most.max(off);
                    if off > 2e-3 {
                        missed.push(format!("{what}: {found} {place} {force} {tension}"));
                    }
                }
            }
        }
    }
    println!("{} of {count} missed, off by {most:.1e} at most", missed.len());
    assert!(missed.is_empty(), "{missed:#?}");
}

/// A line that is drawn hanging with a free end streams straight, at the angle at which its weight balances the drag across it, in every stream.
///
/// *Source.* Analytic (Pode 1951): w cos(a) = 1/2 rho d C_n U^2 sin^2(a), with the angle a to the stream; the tension at the ship is
/// L (w sin(a) + 1/2 rho d C_t U^2 cos^2(a)).
#[test]
fn a_free_line_streams_at_its_critical_angle() {
    let (d, normal, tangential, mass) = (0.01, 1.2, 0.02, 0.3);
    let area = PI / 4.0 * d * d;
    let w = (mass - RHO * area) * G;
    let mut missed = Vec::new();
    for length in [10.0, 60.0, 300.0] {
        for stream in [0.3, 1.0, 2.5, 5.0, 10.0] {
            let text = format!(
                "duration = 1.0\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [0.0, {:?}, 0.0]]\nelements = 20\n\
                 axial_stiffness = 4e6\nbending_stiffness = 0.01\nmass_per_length = {mass}\ninitial = \"equilibrium\"\n\
                 [cable.drag]\nfluid_density = {RHO}\nflow = [{stream:?}, 0.0, 0.0]\nnormal = {normal}\ntangential = {tangential}\n\
                 diameter = {d}\n[cable.buoyancy]\nfluid_density = {RHO}\narea = {area:e}\n\
                 [[attachment]]\nname = \"ship\"\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n",
                -length
            );
            let k = 0.5 * RHO * d * stream * stream;
            // sin^2 = 1 - cos^2: k C_n c^2 + w c - k C_n = 0
            let kn = k * normal;
            let cosine = (-w + (w * w + 4.0 * kn * kn).sqrt()) / (2.0 * kn);
            let sine = (1.0 - cosine * cosine).sqrt();
            let place = Vector3::new(cosine, -sine, 0.0) * length;
            let tension = length * (w * sine + k * tangential * cosine * cosine);
            let mut world = World::build(&parsed(&text).unwrap()).unwrap();
            let what = format!("{stream} m/s, {length} m");
            if let Err(error) = world.start(Purpose::Run) {
                missed.push(format!("{what}: {error}"));
                continue;
            }
            let found = world.cables()[0].sample(length).unwrap().position;
            let force = world.attachment(0).unwrap().0.norm();
            let off = ((found - place).norm() / length).max((force / tension - 1.0).abs());
            println!("{what}: off by {off:.1e}");
            if off > 1e-3 {
                missed.push(format!("{what}: {found} {place} {force} {tension}"));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// The buoy of the scenes floats at its draught on its mooring, and moves by less than 2e-6 m in 10 s of a current of 0.2 m/s without waves, where
/// 1e-6 m were wanted; in waves it starts there.
///
/// *Source.* The contract.
#[test]
fn a_moored_buoy_starts_at_rest() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/scenes/moored_buoy.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let wave = &text[text.find("[water.wave]").unwrap()..text.find("[[body]]").unwrap()];
    let mut places = Vec::new();
    for text in [text.replace(wave, ""), text.clone()] {
        let mut world = started(&text);
        let start = world.body(0).unwrap().position;
        places.push(start);
        if places.len() > 1 {
            break;
        }
        let mut most = 0.0f64;
        for step in 1..=600 {
            world.advance(f64::from(step) / 60.0).unwrap();
            most = most.max((world.body(0).unwrap().position - start).norm());
        }
        println!("{start}, moves by {most:e}");
        assert!(most < 2e-6, "{most:e}");
    }
    // the line feels the wave of t = 0
    assert!((places[0] - places[1]).norm() < 1e-5, "{places:?}");
}

fn buoy(period: f64, amplitude: f64, rest: &str) -> String {
    let (ea, pull): (f64, f64) = (2e4, (1000.0 * PI * 0.0625 * 1.4 - 150.0) * G);
    let length = 10.0 / (1.0 + pull / ea);
    format!(
        "duration = 60.0\n[water]\ndensity = 1000.0\nlevel = 0.0\n[water.wave]\namplitude = {amplitude}\nperiod = {period}\n\
         direction = [1.0, 0.0, 0.0]\n\
         [[body]]\nname = \"buoy\"\nshape = {{ cylinder = [1.0, 0.25] }}\nmass = 150.0\nposition = [0.0, -0.4, 0.0]\n\
         [body.water]\nadded_mass = 0.3\n{rest}\
         [[cable]]\nname = \"mooring\"\npoints = [[0.0, -11.4, 0.0], [0.0, -1.4, 0.0]]\nlength = {length}\nelements = 4\n\
         axial_stiffness = {ea:e}\nbending_stiffness = 0.0\nmass_per_length = 0.001\naxial_law = \"hooke\"\n\
         integrator = {{ fidelity = \"engineering\" }}\n\
         [cable.damping]\naxial = 1.0e-3\n\
         [[attachment]]\ncable = \"mooring\"\nat = \"start\"\nbody = \"world\"\n\
         [[attachment]]\ncable = \"mooring\"\nat = \"end\"\nbody = \"buoy\"\nanchor = [0.0, -1.0, 0.0]\n"
    )
}

/// *Source.* Linear heave of a slender spar of draught d on a spring EA/L: (rho g A exp(-k d) - a omega^2 exp(-k d/2)) over
/// (rho g A + EA/L - (m + a) omega^2), in phase with the wave below resonance (Faltinsen 1990, ch. 3, for long waves).
#[test]
fn a_moored_buoy_in_regular_waves_heaves_by_its_linear_response() {
    for period in [4.0, 7.0] {
        let (omega, amplitude) = (TAU / period, 0.02);
        let (k, draught, spring) = (omega * omega / G, 1.4, 1000.0 * G * PI * 0.0625);
        let (ea, pull): (f64, f64) = (2e4, (1000.0 * PI * 0.0625 * 1.4 - 150.0) * G);
        let (mass, added, line) = (150.0, 45.0, ea * (1.0 + pull / ea) / 10.0);
        let expected = (spring * (-k * draught).exp() - added * omega * omega * (-0.5 * k * draught).exp())
            / (spring + line - (mass + added) * omega * omega);
        let natural = ((spring + line) / (mass + added)).sqrt();
        let mut world = started(&buoy(period, amplitude, ""));
        let mut normal = nalgebra::SMatrix::<f64, 5, 5>::zeros();
        let mut right = nalgebra::SVector::<f64, 5>::zeros();
        for step in 1..=(15.0 * period * 60.0) as u32 {
            let t = f64::from(step) / 60.0;
            world.advance(t).unwrap();
            let y = (world.body(0).unwrap().position.y + 0.4) / amplitude;
            let (s, c) = (omega * t).sin_cos();
            let (p, q) = (natural * t).sin_cos();
            let base = nalgebra::SVector::<f64, 5>::from([c, s, q, p, 1.0]);
            normal += base * base.transpose();
            right += base * y;
        }
        let found = normal.lu().solve(&right).unwrap();
        println!("{period}: {found:?} expected {expected}");
        assert!(
            (found[0] - expected).abs() < 1.5e-2 * expected && found[1].abs() < 2e-2 * expected,
            "{period} {found} {expected}"
        );
    }
}

/// *Source.* A copy of a world, and one that is read between its steps, go on to the bit.
#[test]
fn a_copy_of_a_world_in_waves_goes_on_to_the_bit() {
    let drag = "drag_area = [0.9, 0.2, 0.9]\nrotational_drag = [1.5, 0.0, 1.5]\n";
    let mut world = started(&buoy(3.0, 0.2, drag));
    let places = |world: &World| (world.body(0).unwrap().position, world.cables()[0].positions().to_vec());
    let go = |world: &mut World, from: u32, to: u32| {
        for step in from + 1..=to {
            world.advance(f64::from(step) / 60.0).unwrap();
        }
    };
    go(&mut world, 0, 60);
    let mut copy = world.clone();
    go(&mut world, 60, 120);
    let mut ahead = copy.clone();
    ahead.advance(1.01).unwrap();
    go(&mut copy, 60, 120);
    assert_eq!(places(&world), places(&copy));
}

/// *Source.* Statics and a run in the same water: energy is neither made nor lost without being told.
#[test]
fn the_energy_balance_knows_the_work_of_water() {
    let drag = "drag_area = [0.9, 0.2, 0.9]\n";
    for rest in [drag, ""] {
        let text = buoy(4.0, 0.1, rest).replace("duration = 60.0", "duration = 8.0");
        let out = std::env::temp_dir().join(format!("lariat-water-{}", rest.len()));
        let summary = lariat_scene::run::run(&parsed(&text).unwrap(), &out, &mut Default::default()).unwrap();
        println!("{:?} {:?}", summary.told, summary.energy_balance);
        assert!(summary.told.is_empty(), "{:?}", summary.told);
    }
}

/// A neutral body that is pulled along each of its axes; three equal numbers are one, to the bit.
///
/// *Source.* v = F t/(m + C_i m) of a constant force.
#[test]
fn added_mass_is_one_number_or_one_for_each_axis() {
    let scene = |added: &str, force: [f64; 3]| {
        format!(
            "duration = 2.0\n[water]\ndensity = 1025.0\n[[body]]\nname = \"fish\"\nshape = {{ cuboid = [0.4, 0.1, 0.2] }}\nmass = 65.6\n\
             water = {{ added_mass = {added} }}\n[[load]]\nbody = \"fish\"\nforce = {force:?}\n\
             [[cable]]\nname = \"far\"\npoints = [[0.0, 9.0, 0.0], [0.0, 8.0, 0.0]]\nsection = {{ nylon = 0.01 }}\n"
        )
    };
    let velocity = |text: &str| {
        let mut world = started(text);
        (1..=120).for_each(|step| world.advance(f64::from(step) / 60.0).unwrap());
        world.body(0).unwrap().velocity
    };
    for (axis, c) in [0.25, 1.75, 0.6].into_iter().enumerate() {
        let mut force = [0.0; 3];
        force[axis] = 20.0;
        let found = velocity(&scene("[0.25, 1.75, 0.6]", force))[axis];
        let expected = 20.0 * 2.0 / (65.6 * (1.0 + c));
        println!("{axis}: {found} {expected}");
        assert!((found / expected - 1.0).abs() < 2e-5, "{axis} {found} {expected}");
    }
    let skew = [9.0, -4.0, 6.0];
    assert_eq!(velocity(&scene("0.6", skew)), velocity(&scene("[0.6, 0.6, 0.6]", skew)));
}

#[test]
fn mistakes_are_told_where_they_are() {
    let good = buoy(4.0, 0.1, "drag_area = 0.3\n");
    assert!(parsed(&good).is_ok());
    let water = good[good.find("[water]").unwrap()..good.find("[[body]]").unwrap()].to_string();
    for (from, to, named) in [
        (water.as_str(), "", "water"),
        ("level = 0.0\n", "", "level"),
        ("density = 1000.0", "density = 0.0", "density"),
        ("amplitude = 0.1", "amplitude = 9.0", "breaks"),
        ("amplitude = 0.1", "amplitude = -0.1", "amplitude"),
        ("direction = [1.0, 0.0, 0.0]", "direction = [0.0, 1.0, 0.0]", "direction"),
        ("drag_area = 0.3", "drag_area = [0.3, 0.2]", "drag_area"),
        ("drag_area = 0.3", "volume = 0.0", "volume"),
        ("added_mass = 0.3", "added_mass = [0.3, -0.1, 0.3]", "added_mass"),
        ("added_mass = 0.3", "added_mass = [0.3, 0.1]", "added_mass"),
        ("shape = { cylinder = [1.0, 0.25] }", "shape = \"none\"", "volume"),
        ("mass = 150.0", "kind = \"fixed\"", "fixed"),
        ("duration = 60.0", "duration = 60.0\ngravity = [0.0, 0.0, 0.0]", "gravity"),
        ("[cable.damping]", "[cable.drag]\nflow = [1.0, 0.0, 0.0]\ndiameter = 0.01\n[cable.damping]", "flow"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = parsed(&good.replacen(from, to, 1)).unwrap_err();
        println!("{error}");
        assert!(error.contains(named), "{to}: {error}");
    }
    let dry = "duration = 1.0\n[[cable]]\nname = \"a\"\npoints = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\nsection = { nylon = 0.01 }\n[cable.drag]\n";
    assert!(parsed(dry).unwrap_err().contains("fluid_density"));
}

/// What statics read is without the wave, as their shape is; a run that starts from it is in the wave.
///
/// *Source.* The same scene without a wave, to the bit; equilibrium: both ends carry the weight in water.
#[test]
fn statics_read_what_a_cable_carries_without_the_wave() {
    let scene = |amplitude: f64| {
        format!(
            "duration = 1.0\n[water]\ndensity = 1025.0\nlevel = 0.0\n[water.wave]\namplitude = {amplitude:?}\nperiod = 8.0\ndirection = [1.0, 0.0, 0.0]\n\
             [[cable]]\nname = \"chain\"\npoints = [[0.0, -30.0, 0.0], [30.0, -1.0, 0.0]]\nlength = 45.0\nsection = {{ chain = \"30 mm\" }}\n\
             elements = 10\n[cable.drag]\nnormal = 2.4\ndiameter = 0.03\n[cable.buoyancy]\n\
             [[attachment]]\nname = \"low\"\ncable = \"chain\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\nname = \"top\"\ncable = \"chain\"\nat = \"end\"\nbody = \"world\"\n\
             [[body]]\nname = \"rock\"\nkind = \"fixed\"\nshape = {{ ball = 0.1 }}\nposition = [0.0, -40.0, 0.0]\n"
        )
    };
    let at_rest = |amplitude: f64| {
        let scene = Scene::parse("scene.toml", &scene(amplitude), &[], Purpose::Static).unwrap();
        let mut world = World::build(&scene).unwrap();
        world.start(Purpose::Static).unwrap();
        world
    };
    let forces = |world: &mut World| [0, 1].map(|k| world.attachment(k).unwrap().0);
    let (mut still, mut high) = (at_rest(1e-4), at_rest(2.0));
    let [still, waved] = [&mut still, &mut high].map(forces);
    let weight = 20.01e3 * 0.03 * 0.03 * 45.0 * G * (1.0 - RHO / 7850.0);
    println!("{still:?} {waved:?}, {weight} N");
    assert_eq!(still, waved);
    assert!(((waved[0].y + waved[1].y).abs() / weight - 1.0).abs() < 1e-4, "{waved:?} {weight}");
    // the run from it feels the wave at once
    let state = lariat_scene::run::State::of(&high).unwrap();
    let scene = Scene::parse("scene.toml", &scene(2.0), &[], Purpose::Resume).unwrap();
    let mut world = World::build(&scene).unwrap();
    world.resume(&state).unwrap();
    (1..=30).for_each(|k| world.advance(f64::from(k) / 60.0).unwrap());
    let moved = forces(&mut world);
    assert!((moved[1] - waved[1]).norm() > 10.0, "{moved:?} {waved:?}");
}
