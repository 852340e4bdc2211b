//! Bodies that nothing holds, and loads that do nothing.

use crate::{pendulum, summary_of, warned};
use lariat_scene::{Purpose, Warning};

#[test]
fn a_body_that_nothing_holds_is_told() {
    let wire = [5.0, 0.004, 2.1e11];
    let falls = |text: &str| {
        let warnings = warned(text, Purpose::Run);
        warnings.iter().any(|w| matches!(w, Warning::FallsFreely { body, .. } if body == "bob"))
    };
    for mass in [0.3, 20.0, 1000.0] {
        assert!(falls(&pendulum(wire, mass, 0.1, "world")));
    }
    let loose = pendulum(wire, 2.0, 0.5, "world");
    // a floor below, an upward force, a joint, or no gravity
    let floor = "[[body]]\nname = \"floor\"\nkind = \"fixed\"\nshape = { plane = [0.0, 1.0, 0.0] }\nposition = [0.0, -6.0, 0.0]\n";
    let table = "[[body]]\nname = \"table\"\nkind = \"fixed\"\nshape = { cuboid = [4.0, 0.1, 4.0] }\nposition = [0.0, -7.0, 0.0]\n";
    let lift = "[[load]]\nbody = \"bob\"\nforce = [0.0, 20.0, 0.0]\n";
    let hinge = "[[joint]]\nkind = \"ball\"\nbody = \"bob\"\nto = \"world\"\nat = [0.0, -3.0, 0.0]\n";
    for rest in [floor, table, lift, hinge] {
        assert!(!falls(&(loose.clone() + rest)), "{rest}");
    }
    assert!(!falls(&format!("gravity = [0.0, 0.0, 0.0]\n{loose}")));
    assert!(falls(&(loose.clone() + &table.replace("-7.0", "7.0"))), "a table above stops nothing");
    // two bodies tied to each other alone
    let pair = "[[body]]\nname = \"other\"\nshape = { ball = 0.05 }\nmass = 1.0\nposition = [9.0, 0.0, 0.0]\n\
                [[joint]]\nkind = \"ball\"\nbody = \"bob\"\nto = \"other\"\nat = [5.0, 0.0, 0.0]\n";
    assert!(falls(&(loose + pair)));
}

/// A load carries a body if its upward part is at least the weight; drag in a fluid at rest carries nothing.
///
/// *Source.* Newton's second law: fall = (g - F/m) t^2/2.
#[test]
fn a_body_whose_loads_carry_less_than_its_weight_is_told() {
    let loose = pendulum([5.0, 0.004, 2.1e11], 2.0, 0.5, "world");
    for (force, share) in [([5.0, 0.0, 0.0], 1.0), ([0.0, 9.81, 3.0], 0.5), ([0.0, -19.62, 0.0], 2.0)] {
        let text = format!("{loose}[[load]]\nbody = \"bob\"\nforce = {force:?}\n");
        let warnings = warned(&text, Purpose::Run);
        let expected = 0.5 * 9.81 * 0.04 * share;
        let told =
            |w: &Warning| matches!(w, Warning::FallsFreely { fall_m, .. } if (fall_m / expected - 1.0).abs() < 1e-9);
        assert!(warnings.iter().any(told), "{force:?} {warnings:?}");
    }
    let hung = "duration = 0.1\n[[body]]\nname = \"bob\"\nshape = { ball = 0.05 }\nmass = 1.0\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, \
                0.0], [0.0, 1.0, 0.0]]\naxial_stiffness = 1e5\nbending_stiffness = 0.1\nmass_per_length = 0.1\nDRAG\n[[attachment]]\ncable = \
                \"line\"\nat = \"start\"\nbody = \"bob\"\n";
    let still = "drag = { fluid_density = 1.2, diameter = 0.01 }";
    for (drag, due) in
        [(still, true), ("drag = { fluid_density = 1.2, diameter = 0.01, flow = [0.0, 9.0, 0.0] }", false)]
    {
        let warnings = warned(&hung.replace("DRAG", drag), Purpose::Run);
        assert_eq!(warnings.iter().any(|w| matches!(w, Warning::FallsFreely { .. })), due, "{drag}");
    }
}

#[test]
fn loads_that_a_run_does_not_see_are_told() {
    let beam = |load: &str| {
        format!(
            "duration = 0.1\ngravity = [0.0, 0.0, 0.0]\n[[cable]]\nname = \"beam\"\npoints = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]]\naxial_stiffness = 1e6\n\
             bending_stiffness = 50.0\nmass_per_length = 0.5\n[[attachment]]\ncable = \"beam\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n\
             [[load]]\ncable = \"beam\"\nat = \"end\"\n{load}\n"
        )
    };
    let ramp = warned(&beam("force = [1.0, 0.0, 0.0]\nramp = 5.0"), Purpose::Run);
    assert!(matches!(&ramp[..], [Warning::UnfinishedRamp { on, ramp_s: 5.0, .. }] if on == "beam"), "{ramp:?}");
    assert!(ramp[0].to_string().contains("2 %"), "{}", ramp[0]);
    for well in ["force = [1.0, 0.0, 0.0]\nramp = 0.1", "moment = [0.0, -2.0, 0.5]"] {
        let told = |w: &Warning| matches!(w, Warning::UnfinishedRamp { .. });
        let warnings = warned(&beam(well), Purpose::Run);
        assert!(!warnings.iter().any(told), "{well} {warnings:?}");
    }
}

/// An attachment that is drawn together with 10 m/s at most does not meet within a run that is too short.
#[test]
fn an_attachment_that_never_meets_is_told() {
    let text = |below: f64, duration: f64| {
        format!(
            "duration = {duration}\n[[body]]\nname = \"bob\"\nshape = \"none\"\nmass = 1.0\nposition = [0.0, {:?}, 0.0]\n[[cable]]\nname = \"wire\"\n\
             points = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\naxial_stiffness = 1e4\nbending_stiffness = 0.01\nmass_per_length = 0.1\n\
             damping = {{ axial = 1e-2 }}\n[[attachment]]\ncable = \"wire\"\nat = \"start\"\nbody = \"world\"\n[[attachment]]\nname = \"hook\"\n\
             cable = \"wire\"\nat = \"end\"\nbody = \"bob\"\nanchor = [0.0, 0.0, 0.0]\ngap = \"close\"\n",
            -2.0 - below
        )
    };
    let open = |below, duration| {
        let warnings = warned(&text(below, duration), Purpose::Run);
        warnings.into_iter().find_map(|w| match w {
            Warning::OpenGap { attachment, gap_m, closed, .. } => Some((attachment, gap_m, closed)),
            _ => None,
        })
    };
    let (attachment, gap_m, closed) = open(3.0, 0.1).expect("a gap");
    assert!(attachment == "hook" && !closed && gap_m > 1.5, "{attachment} {gap_m} {closed}");
    assert_eq!(open(0.01, 0.3), None);
}

/// A slider without `multibody` on a hinge with it, and a rope on the slider: the hinge is off by a third of its way, silently but for this.
#[test]
fn joints_with_and_without_multibody_are_told() {
    let text = |reduced: [bool; 2]| {
        let body = |name: &str, mass: f64, x: f64| {
            format!(
                "[[body]]\nname = \"{name}\"\nshape = {{ ball = 0.05 }}\nmass = {mass:?}\nposition = [{x:?}, 0.0, 0.0]\n"
            )
        };
        let joint = |kind: &str, body: &str, to: &str, x: f64, multibody: bool| {
            format!(
                "[[joint]]\nkind = \"{kind}\"\nbody = \"{body}\"\nto = \"{to}\"\nat = [{x:?}, 0.0, 0.0]\naxis = [0, 0, 1]\nmultibody = {multibody}\n"
            )
        };
        let rope = "[[cable]]\nname = \"rope\"\npoints = [[2.0, 0.0, 0.0], [2.0, 1.5, 0.0]]\nelements = 4\nsection = { round = 0.004 }\n\
                    density = 1000.0\nyoungs_modulus = 1e9\n\
                    [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"cart\"\n[[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"world\"\n";
        let [arm, cart] = reduced;
        let bodies = body("arm", 263.0, 1.0) + &body("cart", 1.0, 2.0);
        "duration = 0.02\n".to_string()
            + &bodies
            + &joint("hinge", "arm", "world", 0.0, arm)
            + &joint("slider", "cart", "arm", 1.5, cart)
            + rope
    };
    let told = |reduced| {
        let warnings = warned(&text(reduced), Purpose::Run);
        warnings
            .iter()
            .any(|w| matches!(w, Warning::MixedJoints { body, cable, .. } if body == "cart" && cable == "rope"))
    };
    assert!(told([true, false]));
    assert!(!told([true, true]) && !told([false, false]));
}

/// A gap that closes is told first, and the energy that its pull makes is explained by it; where an anchor is in the axes of the world, that is told
/// before.
#[test]
fn what_a_closing_gap_makes_is_told_as_that() {
    let told_from = |initial: &str, y: f64, anchor: [f64; 3]| {
        let text = format!(
            "initial = \"{initial}\"\nduration = 1.0\n[[body]]\nname = \"load\"\nmass = 10.0\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nposition = [0.0, {y:?}, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, -2.0, 0.0]]\nelements = 10\naxial_stiffness = 1e5\n\
             bending_stiffness = 0.01\nmass_per_length = 0.1\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\nname = \"hook\"\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = {anchor:?}\ngap = \"close\"\n"
        );
        summary_of(&text, Purpose::Run, None).told
    };
    let told = |y, anchor| told_from("drawn", y, anchor);
    for y in [-2.3, -2.6] {
        let lines = told(y, [0.0, 0.1, 0.0]);
        assert!(lines[0].contains("it starts") && lines[0].contains("in no balance of energy"), "{lines:?}");
        assert!(!lines.iter().any(|line| line.contains("makes energy")), "{lines:?}");
    }
    let lines = told(-2.1, [0.0, -2.0, 0.0]);
    assert!(lines[0].contains("in the axes of the body"), "{lines:?}");
    assert!(!told(-2.1, [0.0, 0.1, 0.0]).iter().any(|line| line.contains("it starts")));
    // statics close the gap before the run
    assert_eq!(told_from("equilibrium", -2.6, [0.0, 0.1, 0.0]), Vec::<String>::new());
}
