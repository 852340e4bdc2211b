//! Cables through bodies.

use crate::{pendulum, summary_of, warned};
use lariat_ancf::Vector3;
use lariat_ancf::warning::{Passage, Through};
use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene, Warning};
use nalgebra::Rotation3;

/// The generator of Knuth's MMIX, in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A cable that statics let hang through a body that it is not attached to.
#[test]
fn statics_through_a_body_are_told() {
    let text = |height: f64| {
        format!(
            "[[body]]\nname = \"beam\"\nkind = \"fixed\"\nshape = {{ cuboid = [3.0, 0.3, 0.3] }}\nposition = [1.0, {height:?}, 0.0]\n[[cable]]\nname = \
             \"line\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nlength = 3.0\naxial_stiffness = 1e6\nbending_stiffness = 0.1\nmass_per_length = 0.5\n\
             [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\n"
        )
    };
    let through = warned(&text(-1.0), Purpose::Static);
    assert!(matches!(&through[..], [Warning::PassesThrough { body, .. }] if body == "beam"), "{through:?}");
    assert_eq!(warned(&text(-2.0), Purpose::Static), []);
}

#[test]
fn a_cable_through_a_body_is_told() {
    let text = pendulum([5.0, 0.004, 2.1e11], 20.0, 0.0, "bob");
    let block = |x: f64| {
        format!(
            "{text}[[body]]\nname = \"block\"\nkind = \"fixed\"\nshape = {{ cuboid = [0.3, 0.3, 0.3] }}\nposition = [{x:?}, -2.5, 0.0]\n"
        )
    };
    let warnings = warned(&block(0.1), Purpose::Run);
    assert!(
        matches!(&warnings[..], [Warning::StartsInside { body, at_m, depth_m, .. }]
            if body == "block" && (at_m - 2.5).abs() < 1e-9 && (depth_m - 0.2).abs() < 1e-5),
        "{warnings:?}"
    );
    assert_eq!(warned(&block(0.4), Purpose::Run), []);
}

/// Depth in m of a point in a shape of the kinds of scene files, in the axes of the shape; negative outside, and then no distance.
///
/// *Source.* The definitions of the shapes.
fn depth(kind: usize, [a, b, c]: [f64; 3], x: Vector3<f64>) -> f64 {
    let across = x.x.hypot(x.z);
    match kind {
        0 | 4 => (a - x.x.abs()).min(b - x.y.abs()).min(c - x.z.abs()),
        1 => a - x.norm(),
        2 => (a - x.y.abs()).min(b - across),
        3 => b - across.hypot((x.y.abs() - a).max(0.0)),
        _ => -x.y,
    }
}

/// Bodies of all shapes, turned and beside a straight cable or on it, thin and thick: those that the cable runs through are told, those
/// that it passes by are not.
#[test]
fn bodies_of_all_shapes_that_a_cable_runs_through_are_told_and_only_those() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(3);
    let (mut through, mut by) = ([0; 6], [0; 6]);
    for case in 0..240 {
        let kind = case % 6;
        let mut vector = |size: f64| Vector3::from_fn(|_, _| size * (2.0 * random.next() - 1.0));
        let (turn, way) = (vector(3.0), vector(1.0).normalize());
        let [a, b, c] = [(); 3].map(|()| 0.02 * 30f64.powf(random.next()));
        // plates from a tenth of a millimetre
        let a = if kind == 0 && case % 4 == 0 { 1e-4 * 50f64.powf(random.next()) } else { a };
        let along = way * (4.0 * random.next());
        let beside = way.cross(&turn).normalize() * (random.next() * 1.5 * a.max(b).max(c));
        let rotation = Rotation3::from_scaled_axis(turn);
        // half of the planes below the cable
        let below = if kind == 5 && case % 4 == 1 { rotation * Vector3::y() * -4.5 } else { Vector3::zeros() };
        let center = along + beside + below;
        let shape = match kind {
            0 => format!("cuboid = [{a:?}, {b:?}, {c:?}]"),
            1 => format!("ball = {a:?}"),
            2 => format!("cylinder = [{a:?}, {b:?}]"),
            3 => format!("capsule = [{a:?}, {b:?}]"),
            4 => {
                let corner =
                    |k: u32| [a, b, c].iter().zip(0..3).map(|(x, i)| if k >> i & 1 == 1 { *x } else { -x }).collect();
                let corners: Vec<Vec<f64>> = (0..8).map(corner).collect();
                let mut obj: String = corners.iter().map(|x| format!("v {:?} {:?} {:?}\n", x[0], x[1], x[2])).collect();
                obj += "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
                std::fs::write(folder.path().join("block.obj"), obj).unwrap();
                "mesh = \"block.obj\"".to_string()
            }
            _ => "plane = [0.0, 1.0, 0.0]".to_string(),
        };
        let end = way * 4.0;
        let text = format!(
            "duration = 0.01\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"block\"\nkind = \"fixed\"\nshape = {{ {shape} }}\n\
             position = {:?}\nrotation = {:?}\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], {:?}]\nsection = {{ round = 0.004 }}\n\
             density = 7850.0\nyoungs_modulus = 2.1e11\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n",
            <[f64; 3]>::from(center),
            <[f64; 3]>::from(turn),
            <[f64; 3]>::from(end)
        );
        let scene = Scene::parse(&folder.path().join("scene.toml").display().to_string(), &text, &[], Purpose::Run);
        let summary = run::collect(
            &scene.unwrap_or_else(|error| panic!("{error}\n{text}")),
            Purpose::Run,
            &mut Options::default(),
        );
        let told = summary.unwrap().summary.warnings;
        let is_told = told.iter().any(|w| matches!(w, Warning::StartsInside { body, .. } if body == "block"));
        let deepest = (0..=40_000)
            .map(|k| depth(kind, [a, b, c], rotation.inverse() * (end * (f64::from(k) / 40_000.0) - center)))
            .fold(f64::NEG_INFINITY, f64::max);
        // a plate that it enters by one face and leaves by the other
        let (from, along) = (rotation.inverse() * -center, rotation.inverse() * end);
        let crosses = |x: f64| {
            let share = (x - from.x) / along.x;
            let there = from + along * share;
            (0.0..1.0).contains(&share) && there.y.abs() < b && there.z.abs() < c
        };
        if deepest > 0.01 || kind == 0 && crosses(a) && crosses(-a) {
            through[kind] += 1;
            assert!(is_told, "{case}: {deepest} m in\n{text}");
        } else if deepest < 0.0 {
            by[kind] += 1;
            assert_eq!(told, [], "{case}: {deepest} m\n{text}");
        }
    }
    println!("through {through:?}, by {by:?}");
    assert!(through.iter().chain(&by).all(|count| *count >= 3), "{through:?} {by:?}");
}

/// A rope with contact that is drawn through the body that it is tied to, in every plane, is told by name; not one whose slack
/// can be drawn beside it, nor one that lies outside, nor one without contact, nor one whose eye is inside.
#[test]
fn a_rope_that_starts_in_its_own_body_is_told() {
    let text = |half: f64, place: [f64; 2], anchor: [f64; 2], length: f64, contact: &str| {
        let end = [place[0] + anchor[0], place[1] + anchor[1]];
        format!(
            "duration = 0.02\n[[body]]\nname = \"load\"\nshape = {{ cuboid = [{half:?}, {half:?}, {half:?}] }}\nmass = 10.0\n\
             position = [{:?}, {:?}, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [{:?}, {:?}, 0.0]]\nlength = {length:?}\n\
             elements = 16\naxial_stiffness = 200000.0\nbending_stiffness = 0.05\nmass_per_length = 0.1\nintegrator = {{ fidelity = \"game\" }}\n{contact}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [{:?}, {:?}, 0.0]\n",
            place[0], place[1], end[0], end[1], anchor[0], anchor[1]
        )
    };
    let contact = "contact = { radius = 0.01, friction = 0.4 }";
    for (half, place, anchor, length, contact, told) in [
        // from above through the body to an eye below it
        (0.1, [0.0, -2.1], [0.0, -0.1], 2.25, contact, true),
        (0.3, [0.0, -2.0], [0.0, -0.3], 2.4, contact, true),
        // to an eye on top, with slack that hangs through the body in the plane of gravity
        (0.1, [2.0, -0.1], [0.0, 0.1], 3.4, contact, false),
        (0.3, [3.0, -0.3], [0.0, 0.3], 5.0, contact, false),
        (0.1, [2.0, -0.1], [0.0, 0.1], 3.4, "", false),
        // straight down from above, with the eye on the face, above it and inside
        (0.1, [0.0, -2.1], [0.0, 0.1], 2.0, contact, false),
        (0.1, [0.0, -2.15], [0.0, 0.15], 2.0, contact, false),
        (0.1, [0.0, -2.0], [0.0, 0.0], 2.0, contact, false),
    ] {
        let warnings = warned(&text(half, place, anchor, length, contact), Purpose::Run);
        let inside = warnings.iter().find_map(|warning| match warning {
            Warning::StartsInside { body, depth_m, own, .. } => Some((body.clone(), *depth_m, *own)),
            _ => None,
        });
        let expected = told.then(|| ("load".to_string(), true));
        assert_eq!(inside.clone().map(|(body, _, own)| (body, own)), expected, "{half} {anchor:?}: {warnings:?}");
        assert!(inside.is_none_or(|(_, depth, _)| depth > 0.3 * half && depth <= half), "{warnings:?}");
    }
}

/// A cable with contact that hangs from the face of a body that swings, on the axis of that, passes through nothing, whatever the length of
/// its elements.
#[test]
fn a_cable_tied_to_the_face_of_a_body_passes_through_nothing() {
    for elements in [8, 40] {
        let text = format!(
            "duration = 2.0\ndt = 0.01\n[[body]]\nname = \"buoy\"\nshape = {{ cylinder = [1.0, 0.3] }}\nmass = 200.0\nposition = [0.0, 0.0, 0.0]\n\
             angular_velocity = [0.3, 0.1, 0.5]\n[[joint]]\nkind = \"ball\"\nbody = \"buoy\"\nto = \"world\"\nat = [0.0, 1.0, 0.0]\n\
             [[cable]]\nname = \"chain\"\npoints = [[0.0, -1.0, 0.0], [0.0, -9.0, 0.0]]\nsection = {{ chain = \"30 mm\" }}\nelements = {elements}\n\
             damping = {{ axial = 0.02 }}\ncontact = {{ friction = 0.3 }}\n[[attachment]]\ncable = \"chain\"\nat = \"start\"\nbody = \"buoy\"\n\
             anchor = [0.0, -1.0, 0.0]\n"
        );
        let summary = summary_of(&text, Purpose::Run, None);
        let passed = |w: &&Warning| matches!(w, Warning::Cable(lariat_ancf::Warning::PassedThrough { .. }));
        assert!(!summary.warnings.iter().any(|w| passed(&w)), "{elements}: {:?}", summary.warnings);
        assert_eq!(summary.divisions_for.iter().find(|(reason, _)| reason.contains("passes")), None, "{elements}");
    }
}

/// A rope that a load draws through a thin body, because its contact is soft, names the body, and where it passed.
#[test]
fn a_rope_drawn_through_a_thin_body_names_it() {
    let text = "duration = 0.5\ndt = 0.01\n[[body]]\nname = \"rod\"\nkind = \"fixed\"\nshape = { capsule = [0.5, 0.002] }\n\
                rotation = [1.5707963, 0.0, 0.0]\nposition = [1.02, -0.05, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\n\
                axial_stiffness = 1e6\nbending_stiffness = 0.01\nmass_per_length = 0.14\ndamping = { axial = 1e-3, bending = 1e-3 }\n\
                contact = { radius = 0.005, stiffness = 1.0 }\nelements = 10\n[[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
                [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n[[load]]\ncable = \"rope\"\nat = 1.0\nforce = [0.0, -5e3, 0.0]\n";
    let warnings = warned(text, Purpose::Run);
    let first = warnings.iter().find_map(|w| match w {
        Warning::Cable(lariat_ancf::Warning::PassedThrough { first, .. }) => first.clone(),
        _ => None,
    });
    let Passage { time_s, arc_length_m, through } = first.expect("it is told");
    assert_eq!(through, Through::Body("rod".into()), "{warnings:?}");
    assert!((arc_length_m - 1.02).abs() < 0.01 && time_s < 0.5, "{time_s} {arc_length_m}");
}
