//! Sheaves along one cable of a scene.

use lariat_scene::run::{self, Options, Recording};
use lariat_scene::{Purpose, Scene};

const ROPE: &str = "elements = 12\naxial_stiffness = 1.0e5\nbending_stiffness = 1.0e-3\nmass_per_length = 0.02\n\
    damping = { axial = 0.005 }\n";

/// Two masses on a rope over a wheel, or an eye; `tables` are of the cable, `more` of the scene.
fn atwood(radius: f64, [left, right]: [f64; 2], tables: &str, more: &str) -> String {
    let x = if radius > 0.0 { radius } else { 0.0 };
    format!(
        "duration = 0.8\n\
        [[body]]\nname = \"left\"\nshape = \"none\"\nmass = {left:?}\nposition = [{:?}, -2.0, 0.0]\n\
        [[body]]\nname = \"right\"\nshape = \"none\"\nmass = {right:?}\nposition = [{x:?}, -2.0, 0.0]\n\
        [[cable]]\nname = \"rope\"\npoints = [[{:?}, -2.0, 0.0], [0.0, 0.0, 0.0], [{x:?}, -2.0, 0.0]]\n{ROPE}{tables}\n\
        [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"left\"\n\
        [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"right\"\n\
        [[sheave]]\nname = \"block\"\ncable = \"rope\"\nat = 2.0024\nbody = \"world\"\nanchor = [0.0, 0.0, 0.0]\nradius = {radius:?}\n\
        [[probe]]\nname = \"right\"\nbody = \"right\"\n[[probe]]\nname = \"sheave\"\nsheave = \"block\"\n{more}",
        -x, -x
    )
    .replace("at = 2.0024", if radius > 0.0 { "at = 2.0024" } else { "at = 2.0" })
}

fn record(text: &str) -> Recording {
    let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap();
    let recording = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(recording.failed.is_none(), "{:?}", recording.failed);
    recording
}

fn rows<'a>(recording: &'a Recording, name: &str) -> Vec<&'a [f64]> {
    let probe = recording.probes.iter().find(|probe| probe.name == name).unwrap();
    probe.rows.chunks(probe.columns.len()).collect()
}

fn refused(text: &str) -> String {
    Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap_err().to_string()
}

/// Two masses on one rope over an eye or a wheel gain the speed of Atwood's machine with the rope's mass; a point of the rope that runs
/// over the wheel goes on with its material on the other side, and energy and momentum count all of the rope.
///
/// *Source.* `M u'' = g (m_2 - m_1 + rho (l_b - l_a))`, so `u = (d + 2 rho e)/(2 rho) (cosh k t - 1)`, `k^2 = 2 rho g/M`, all of
/// the rope in M. Within 0.5 %, and the tensions of a wheel without friction differ by the inertia of the rope on it, within 0.1 %.
#[test]
fn a_rope_over_a_sheave_is_atwoods_machine_and_stays_one_cable() {
    for (radius, masses) in [(0.0, [2.0, 3.0]), (0.1, [2.0, 3.0]), (0.25, [1.0, 1.3]), (0.05, [3.0, 2.0])] {
        let from_left = masses[0] < masses[1];
        let on_wheel = std::f64::consts::PI * radius;
        let length = 4.0 + on_wheel;
        let mass = masses[0] + masses[1] + 0.02 * length;
        let difference = masses[1] - masses[0];
        let k = (2.0 * 0.02 * 9.81 / mass).sqrt();
        let u = difference / 0.04 * ((k * 0.8).cosh() - 1.0);
        let rate = difference / 0.04 * k * (k * 0.8).sinh();
        // 0.2 m behind the wheel at the end
        let at = if from_left { 2.0 + on_wheel + 0.2 - u } else { 1.8 - u };
        let probe = format!(
            "[[probe]]\nname = \"point\"\ncable = \"rope\"\nat = {at:?}\n[[probe]]\nname = \"energy\"\nenergy = \"rope\"\n\
            [[probe]]\nname = \"momentum\"\nmomentum = \"rope\"\n"
        );
        let recording = record(&atwood(radius, masses, "", &probe));
        assert_eq!(recording.world.cables().len(), 2);
        assert!((recording.world.scene().whole_length(0) - length).abs() < 1e-9);
        let (body, sheave) = (rows(&recording, "right"), rows(&recording, "sheave"));
        let (body, sheave) = (body.last().unwrap(), sheave.last().unwrap());
        println!("{radius}: {} of {rate} m/s, passed {} of {u} m, {:?}", -body[9], sheave[1], &sheave[3..5]);
        assert!((-body[9] / rate - 1.0).abs() < 5e-3 && (sheave[1] / u - 1.0).abs() < 5e-3, "{body:?} {sheave:?}");
        // what is on the wheel has mass
        let acceleration = difference * 9.81 / mass + k * k * u;
        let inertia = 0.02 * on_wheel * acceleration;
        assert!(((sheave[4] - sheave[3] - inertia) / sheave[3]).abs() < 1e-3, "{sheave:?}");
        // the point is behind the wheel by what passed less its way to it, in stretched rope
        let point = rows(&recording, "point");
        let point = point.last().unwrap();
        let before = if from_left { at < 2.0 + on_wheel } else { at > 2.0 };
        assert!(before && (-point[2] - 0.2).abs() < 2e-3, "{radius}: {} m, {at} m", -point[2]);
        assert!((point[5].abs() / rate.abs() - 1.0).abs() < 1e-2 && (point[10] / sheave[4] - 1.0).abs() < 0.03);
        let momentum = rows(&recording, "momentum");
        // 0.02 kg/m times the rate times the difference of the sides
        assert!((momentum.last().unwrap()[2] + 0.04 * u * rate).abs() < 2e-3, "{:?}", momentum.last());
        let balance = recording.summary.energy_balance.unwrap();
        assert!(balance.made() < 1e-3 && balance.lost() < 2e-2, "{balance:?}");
        assert!(
            recording.page().contains("\"sheaves\":[1]") && recording.page().matches("\"name\":\"rope\"").count() == 1
        );
    }
}

/// Loads that do not balance over a sheave have no equilibrium, and the error says what pulls; with friction enough they have one.
///
/// *Source.* Equilibrium of the wheel: the rope, 0.08 kg in all, makes up for no difference of the loads; the capstan equation, half a turn, e^(mu pi).
#[test]
fn statics_of_unequal_loads_over_a_sheave_name_their_pulls() {
    for (radius, [left, right]) in [(0.1, [2.0, 3.0]), (0.25, [30.0, 24.0]), (0.05, [2.0, 2.2])] {
        for friction in [0.0, 0.2] {
            let text = atwood(radius, [left, right], "", "")
                .replace("duration = 0.8", "duration = 0.8\ninitial = \"equilibrium\"");
            let text = text.replace("[[sheave]]\n", &format!("[[sheave]]\nfriction = {friction:?}\n"));
            let scene = Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap();
            let failed = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap().failed;
            let ratio = right.max(left) / right.min(left);
            if ratio < (friction * std::f64::consts::PI).exp() {
                assert!(failed.is_none(), "{radius} {friction}: {failed:?}");
                continue;
            }
            let error = failed.unwrap().to_string();
            assert!(error.contains("runs over a sheave: its parts pull"), "{radius} {friction}: {error}");
        }
    }
}

/// With friction the tensions at the sheave differ by exp(mu theta); loads that differ by less stay at rest.
///
/// *Source.* Euler's capstan of a running belt, `(T_b - rho v^2)/(T_a - rho v^2) = exp(mu pi)`, less the inertia of the rope on the wheel.
#[test]
fn friction_of_a_sheave_along_a_cable_is_that_of_a_capstan() {
    for (friction, masses, slips) in [(0.1, [2.0, 3.0], true), (0.1, [2.0, 2.6], false), (0.3, [1.0, 3.5], true)] {
        let text = atwood(0.1, masses, "", "").replace("radius = 0.1", &format!("radius = 0.1\nfriction = {friction}"));
        let recording = record(&text);
        let sheave = rows(&recording, "sheave");
        let last = sheave.last().unwrap();
        // the pressure is less by rho v^2, and what is on the wheel is accelerated
        let lift = 0.02 * last[2] * last[2];
        let inertia = 0.02 * 0.1 * std::f64::consts::PI * (9.81 - last[4] / masses[1]) * f64::from(slips);
        let bound = (friction * std::f64::consts::PI).exp();
        let ratio = (last[4] - inertia - lift) / (last[3] - lift);
        println!("{friction}: {ratio} of {bound}, {} m/s", last[2]);
        if slips {
            assert!((ratio / bound - 1.0).abs() < 1e-3, "{ratio} {bound}");
        } else {
            assert!(last[1].abs() < 2e-3 && last[2] == 0.0 && ratio < bound, "{last:?}");
        }
    }
}

/// Four sheaves along one rope are the tackle of five ropes.
///
/// *Source.* The scene `tackle.toml`, with `from` and `to`.
#[test]
fn a_tackle_of_one_rope_is_that_of_five() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/scenes/tackle.toml");
    let duration = ["duration=0.3".to_string()];
    let five = Scene::read(&path, &duration, Purpose::Run).unwrap();
    let five = run::collect(&five, Purpose::Run, &mut Options::default()).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let bodies = &text[text.find("[[body]]").unwrap()..text.find("[[cable]]").unwrap()];
    let sheave = |at: f64, body: &str, y: f64| {
        format!(
            "[[sheave]]\ncable = \"rope\"\nat = {at:?}\nbody = \"{body}\"\nanchor = [0.0, {y:?}, 0.0]\nfriction = 0.05\n"
        )
    };
    let one = format!(
        "duration = 0.3\n{bodies}[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, -4.0, 0.0], [0.0, 0.0, 0.0], [0.0, -4.0, 0.0], \
        [0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]\nelements = 34\naxial_stiffness = 2.0e5\nbending_stiffness = 0.001\nmass_per_length = 0.005\n\
        damping = {{ axial = 0.005 }}\n{}{}{}{}[[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
        [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, 0.1, 0.0]\n",
        sheave(12.0, "block", 0.1),
        sheave(4.0, "block", 0.1),
        sheave(16.0, "world", 0.0),
        sheave(8.0, "world", 0.0)
    );
    let one = record(&one);
    assert_eq!(one.world.cables().len(), 5);
    for i in 0..2 {
        let [a, b] = [&one, &five].map(|run| run.world.body(i).unwrap());
        println!("{} m/s, {} m/s", a.velocity.y, b.velocity.y);
        assert!((a.velocity.y / b.velocity.y - 1.0).abs() < 2e-3, "{a:?} {b:?}");
    }
}

/// A cut counts arc lengths along all of the rope, on both sides of the wheel, and what it reports is all that it changes.
#[test]
fn a_cut_beside_a_sheave_is_where_it_is_asked_for() {
    for at in [1.0, 3.2] {
        let probes = "[[probe]]\nname = \"near\"\ncable = \"rope\"\nat = 0.1\n[[probe]]\nname = \"far\"\ncable = \"rope\"\nat = 4.2\n";
        let text = atwood(0.1, [2.0, 3.0], &format!("[cable.break]\ntime = 0.2\nat = {at}\n"), probes);
        let text = text.replace("duration = 0.8", "duration = 0.3");
        let recording = record(&text);
        let parted = &recording.summary.breaks;
        assert_eq!(parted.len(), 1);
        assert!((parted[0].arc_length_m - at).abs() < 1e-9 && parted[0].cable == "rope", "{parted:?}");
        assert_eq!(recording.world.cables().len(), 3);
        let [near, far] = ["near", "far"].map(|name| rows(&recording, name).last().unwrap()[2]);
        // each still beside its body
        let [left, right] = [0, 1].map(|i| recording.world.body(i).unwrap().position.y);
        assert!((near - left - 0.1).abs() < 0.01 && (far - right).abs() < 0.2, "{near} {left}, {far} {right}");
    }
}

/// A part that turns at a wheel is told, with what it is off by; so is a load before which the cable stops.
#[test]
fn what_a_wheel_does_not_follow_is_warned_of() {
    let kind = |text: &str| {
        let warnings = record(text).summary.warnings;
        warnings.into_iter().map(|warning| warning.to_string()).collect::<Vec<_>>()
    };
    let plain = atwood(0.1, [2.0, 3.0], "", "").replace("duration = 0.8", "duration = 0.4");
    assert!(kind(&plain).iter().all(|text| !text.contains("sheave")), "{:?}", kind(&plain));
    let push = "[[load]]\nbody = \"right\"\nforce = [5.0, 0.0, 0.0]\n";
    assert!(kind(&(plain.clone() + push)).iter().any(|text| text.contains("a part of its cable turned")));
}

/// A load on the rope stops it before the wheel: it stands there, which a warning tells, and costs what other steps cost.
///
/// *Source.* The load is at 1.6 m, in the element before the one from 5/3 to 2 m, of which 0.4 stay: 0.2 m pass. A step of a stop that
/// pulls on a wheel without friction was divided into 4096, each with 20 iterations.
#[test]
fn a_load_stops_a_rope_before_the_wheel_at_no_cost() {
    let load = "[[load]]\ncable = \"rope\"\nat = 1.6\nforce = [0.0, -0.5, 0.0]\n";
    let recording = record(&atwood(0.1, [2.0, 3.0], "", load).replace("duration = 0.8", "duration = 3.0"));
    let sheave = rows(&recording, "sheave");
    let last = sheave.last().unwrap();
    println!("{last:?}, {} iterations", recording.summary.newton_iterations);
    assert!((last[1] - 0.2).abs() < 1e-9 && last[2] == 0.0, "{last:?}");
    // 2 kg hang on one side, 3 kg on the other, and the stop takes the difference
    assert!((last[4] - last[3]).abs() > 5.0, "{last:?}");
    assert!(recording.summary.newton_iterations < 20 * recording.summary.steps, "{:?}", recording.summary);
    // counting: what asked for iterations and divisions are laws of the sheave and those of all
    let s = &recording.summary;
    let [asked, divided] = [&s.iterations_for, &s.divisions_for].map(|counts| counts.values().sum::<u64>());
    let at_once = s.divisions_for.get("like_the_last").unwrap_or(&0);
    assert_eq!((s.divided_steps, s.newton_iterations), (divided, s.steps + 4 * divided - at_once + asked));
    assert!(s.iterations_for.contains_key("reel_laws") && !s.iterations_for.contains_key("contact_forces"), "{s:?}");
    let told = recording.summary.warnings.iter().any(|warning| warning.to_string().contains("it stopped at"));
    assert!(told, "{:?}", recording.summary.warnings);
}

/// Tables that make no sheave are refused with the key that is wrong.
#[test]
fn sheaves_along_a_cable_that_do_not_fit_are_refused() {
    let plain = atwood(0.1, [2.0, 3.0], "", "");
    for (from, to, words) in [
        ("anchor = [0.0, 0.0, 0.0]", "anchor = [0.0, 0.5, 0.0]", "from the cable as drawn"),
        ("anchor = [0.0, 0.0, 0.0]\n", "", "anchor"),
        ("at = 2.0024\n", "", "at"),
        ("at = 2.0024", "at = 7.0", "not on the cable"),
        ("radius = 0.1", "radius = -0.1", "radius"),
        ("radius = 0.1", "radius = 3.0", "within the wheel"),
        ("radius = 0.1", "radius = 0.1\nto = \"rope\"", "between two cables"),
        ("radius = 0.1", "radius = 0.1\nfrom = \"rope\"", "from"),
        ("cable = \"rope\"\nat = 2.0024", "cable = \"rop\"\nat = 2.0024", "rop"),
        ("damping = { axial = 0.005 }", "integrator = { tolerance = 1e-5 }", "a cable over a sheave"),
        (
            "points = [[-0.1, -2.0, 0.0], [0.0, 0.0, 0.0], [0.1, -2.0, 0.0]]",
            "points = [[-0.1, -2.0, 0.0], [0.1, 2.0, 0.0]]",
            "does not turn",
        ),
    ] {
        assert!(plain.contains(from), "{from}");
        let error = refused(&plain.replace(from, to));
        assert!(error.contains(words), "{from} -> {to}: {error}");
    }
    // contact goes with a sheave
    record(&plain.replace("damping = { axial = 0.005 }", "contact = { radius = 0.01 }"));
    let eye = atwood(0.0, [2.0, 3.0], "", "[[load]]\ncable = \"rope\"\nat = 2.0\nforce = [0.0, 1.0, 0.0]\n");
    assert!(refused(&eye).contains("at a sheave"));
}

/// Three bodies that nothing holds, one with a sheave on which the rope is snatched: the momentum stays within a hundredth, also where
/// steps are cut short and rescaled, and with a point mass, which does not turn (a third of it was lost).
///
/// *Source.* Conservation; a step that is cut short leaves impulses unbalanced.
#[test]
fn a_snatched_rope_over_a_free_block_keeps_the_momentum() {
    for (shape, friction, inertia) in
        [("\"none\"", 0.1, 0.5), ("\"none\"", 0.02, 0.5), ("{ ball = 0.1 }", 0.1, 0.5), ("\"none\"", 0.3, 2.0)]
    {
        let text = format!(
            "duration = 1.0\ngravity = [0, 0, 0]\n\
            [[body]]\nname = \"block\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = 5.0\nposition = [0, 0.1, 0]\nvelocity = [0, 3.0, 0.2]\n\
            [[body]]\nname = \"left\"\nshape = {{ ball = 0.1 }}\nmass = 2.0\nposition = [-0.5, -2, 0]\nvelocity = [0.3, -1.0, 0]\n\
            [[body]]\nname = \"right\"\nshape = {shape}\nmass = 3.0\nposition = [0.6, -2.2, 0]\nvelocity = [0, -1.0, 0.4]\n\
            [[cable]]\nname = \"rope\"\npoints = [[-0.5, -2, 0], [0, 0, 0], [0.6, -2.2, 0]]\nlength = 4.6\nelements = 12\n\
            axial_stiffness = 20000.0\nbending_stiffness = 0.005\nmass_per_length = 0.2\ndamping = {{ axial = 0.003 }}\n\
            integrator = {{ fidelity = \"game\" }}\n\
            [[sheave]]\nname = \"wheel\"\ncable = \"rope\"\nat = 2.08\nbody = \"block\"\nanchor = [0, -0.1, 0]\nfriction = {friction}\n\
            inertia = {inertia}\n\
            [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"left\"\n\
            [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"right\"\n\
            [[probe]]\nname = \"momentum\"\nmomentum = \"all\"\n[[probe]]\nname = \"wheel\"\nsheave = \"wheel\"\n"
        );
        let scene = Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap();
        // some end with an error of the sheave; until then they keep the law
        let recording = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
        let momenta = rows(&recording, "momentum");
        let off = momenta.iter().map(|row| (1..4).map(|k| (row[k] - momenta[0][k]).abs()).fold(0.0, f64::max));
        let off = off.fold(0.0, f64::max);
        println!("{shape} {friction} {inertia}: {off:.1e} of 10 kg m/s");
        assert!(off < 1e-2 * 10.0, "{shape}, friction {friction}: {off} kg m/s");
    }
}

/// A block swings on a rope that runs over its wheel, with friction and inertia: friction takes energy in every host step, and with it
/// and the wheel that of all never grows; no step is cut short. The lesser of both tensions presses, which inertia may make that
/// towards which the rope runs: friction had the other one, pushed, and made up to 500 J.
///
/// *Source.* Conservation of energy; the wheel has `m u'^2/2`.
#[test]
fn friction_of_a_wheel_with_inertia_takes_energy() {
    for (friction, inertia, speed, mass) in [
        (0.1, 0.5, 0.0, 2.0),
        (0.3, 2.0, 3.0, 2.0),
        (0.2, 0.5, 6.0, 20.0),
        (0.3, 1.0, -4.0, 5.0),
        (0.5, 0.2, 5.0, 1.0),
        (0.2, 3.0, 8.0, 10.0),
    ] {
        let recording = record(&format!(
            "duration = 1.0\n\
            [[body]]\nname = \"block\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nmass = {mass}\nposition = [0.4, -1.5, 0]\nvelocity = [{speed}, 0, 0]\n\
            [[cable]]\nname = \"rope\"\npoints = [[-1, 0, 0], [0.4, -1.4, 0], [1, 0, 0]]\nelements = 16\n\
            axial_stiffness = 20000.0\nbending_stiffness = 0.001\nmass_per_length = 0.02\n\
            [[sheave]]\nname = \"wheel\"\ncable = \"rope\"\nat = 1.9798989873\nbody = \"block\"\nanchor = [0, 0.1, 0]\nfriction = {friction}\n\
            inertia = {inertia}\n\
            [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\nanchor = [-1, 0, 0]\n\
            [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\nanchor = [1, 0, 0]\n\
            [[probe]]\nname = \"energy\"\nenergy = \"all\"\n[[probe]]\nname = \"wheel\"\nsheave = \"wheel\"\n"
        ));
        let (energy, wheel) = (rows(&recording, "energy"), rows(&recording, "wheel"));
        // t, ..., total; t, passed, rate, from_tension, to_tension, friction, lost
        let total: Vec<_> = energy
            .iter()
            .zip(&wheel)
            .map(|(row, wheel)| row[row.len() - 1] + 0.5 * inertia * wheel[2].powi(2))
            .collect();
        let size = 0.5 * mass * speed * speed + mass * 9.81 * 1.5;
        let case = format!("friction {friction}, inertia {inertia}, {speed} m/s, {mass} kg");
        let pushed: f64 = wheel.windows(2).map(|pair| (pair[0][6] - pair[1][6]).max(0.0)).sum();
        println!("{case}: {pushed:e} J of {size} J");
        assert!(pushed < 1e-5 * size, "{case}: friction pushes by {pushed} J");
        let most = total.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(most < 1e-6 * size, "{case}: {most} J");
        let with_friction = total.iter().zip(&wheel).map(|(total, wheel)| total + wheel[6]);
        assert!(with_friction.skip(1).all(|sum| sum < total[0] + 1e-6 * size), "{case}");
        assert!(!format!("{:?}", recording.summary.warnings).contains("CutShort"), "{case}");
    }
}

/// A block of a mass (kg) on a rope that runs from a reel down around its wheel and up to a dead end.
fn block_on_reel(mass: f64, radius: f64, height: f64, reel: &str) -> String {
    format!(
        "duration = 6.0\ninitial = \"equilibrium\"\n\
        [[body]]\nname = \"block\"\nshape = {{ cuboid = [0.2, 0.2, 0.2] }}\nmass = {mass:?}\nposition = [0.0, {:?}, 0.0]\n\
        [[cable]]\nname = \"rope\"\npoints = [[{:?}, 0.0, 0.0], [{:?}, {:?}, 0.0], [{radius:?}, {:?}, 0.0], [{radius:?}, 0.0, 0.0]]\n{ROPE}\
        [cable.reel]\nend = \"start\"\n{reel}\n\
        [[sheave]]\nname = \"wheel\"\ncable = \"rope\"\nat = \"50 %\"\nbody = \"block\"\nanchor = [0.0, 0.0, 0.0]\nradius = {radius:?}\n\
        [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n\
        [[probe]]\nname = \"block\"\nbody = \"block\"\n[[probe]]\nname = \"reel\"\nreel = \"rope\"\n",
        -height, -radius, -radius, -height, -height
    )
}

/// A reel counts all of its cable, on both sides of a sheave along it: the length that it comes to, its stock, and what is read. The block on
/// two falls rises by half of what is taken in, and sinks by half of what is paid out, to the end of the stock.
///
/// *Source.* The contract of `to_length`, `stock` and `length_out`; the geometry of two falls.
#[test]
fn a_reel_counts_the_cable_beyond_a_sheave() {
    for (mass, radius, height) in [(20.0, 0.1, 5.0), (3.0, 0.2, 8.0), (50.0, 0.05, 3.0)] {
        for change in [-1.5, 0.8] {
            let length = 2.0 * height + std::f64::consts::PI * radius;
            let to = length + change;
            for reel in [
                format!("rate = [[0.2, 0.6]]\nto_length = {to}\nacceleration = 1.0"),
                format!("rate = [[0.2, 0.6]]\nstock = {to}\nacceleration = 1.0"),
            ] {
                let text = block_on_reel(mass, radius, height, &reel);
                if reel.contains("stock") && change < 0.0 {
                    let problem = refused(&text);
                    assert!(problem.contains("stock") && problem.contains("length that is out"), "{problem}");
                    continue;
                }
                let recording = record(&text);
                let [reel, block] = ["reel", "block"].map(|name| rows(&recording, name));
                let (first, last) = (reel[0][1], reel[reel.len() - 1][1]);
                let rise = block[block.len() - 1][2] - block[0][2];
                println!("{mass} kg, {radius} m, {change} m: {first:.4} to {last:.4} of {to:.4} m, rises {rise:.4} m");
                assert!((first - length).abs() < 1e-3 && (last - to).abs() < 2e-3, "{first} m, {last} m of {to}");
                assert!((rise + 0.5 * (last - first)).abs() < 5e-3, "{rise} m");
            }
        }
    }
}
