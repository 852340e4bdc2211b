//! Statics of cables that touch cables, and bodies that they move, beside each other.

use super::statics::{row, solve};

fn held(cable: &str) -> String {
    ["start", "end"]
        .map(|at| format!("[[attachment]]\ncable = \"{cable}\"\nat = \"{at}\"\nbody = \"world\"\n"))
        .concat()
}

/// A taut rope along x, and a limp one across it at an angle, drawn `above` it (m).
fn crossed(above: f64, turn: f64, mass: f64, contact: &str) -> String {
    let rope = |name: &str, from: [f64; 3], to: [f64; 3], length: f64, stiffness: f64, mass: f64| {
        format!(
            "[[cable]]\nname = {name:?}\npoints = [{from:?}, {to:?}]\nlength = {length}\nelements = 20\naxial_stiffness = {stiffness}\n\
             bending_stiffness = 0.01\nmass_per_length = {mass}\ncontact = {{ {contact} }}\n{}",
            held(name)
        )
    };
    // an engine, in which cables can touch
    let engine = "engine = \"rapier\"\n";
    let (y, [s, c]) = (-0.25 + above, [turn.sin(), turn.cos()]);
    engine.to_string()
        + &rope("low", [-1.0, -0.25, 0.0], [1.0, -0.25, 0.0], 1.998, 2.0e5, 0.3)
        + &rope("high", [0.02 - s, y, -c], [0.02 + s, y, c], 2.0, 200.0, mass)
        + "[[probe]]\nname = \"low\"\ncable = \"low\"\nat = 1.02\n[[probe]]\nname = \"high\"\ncable = \"high\"\nat = 1.0\n"
}

/// A limp rope that is drawn above a taut one would hang through it by its forces alone, and rests on it, whatever it weighs, and at whatever
/// angle, span and radius; drawn below, out of its way, or without contact of cables it hangs where the catenary has it.
///
/// *Source.* The limp rope alone sags `y = (3 m g L/(64 EA))^(1/3) L`, 0.15 m and more, below the taut one.
#[test]
fn a_limp_rope_rests_on_a_taut_one() {
    // a contact that carries 40 N and more
    let hard = "radius = 0.01, stiffness = 1.0e6";
    let cases = [
        (0.05, 0.0, 0.5, "radius = 0.01"),
        (0.05, 0.7, 0.3, "radius = 0.01"),
        (0.03, -0.4, 1.0, hard),
        (0.1, 0.2, 2.0, hard),
        (0.06, 1.1, 0.8, "radius = 0.02, stiffness = 5.0e5"),
        (0.04, 0.3, 0.15, "radius = 0.006"),
    ];
    for (above, turn, mass, contact) in cases {
        let (_, probes) = solve(&crossed(above, turn, mass, &format!("{contact}, cables = true"))).unwrap();
        let [low, high] = [&probes[0], &probes[1]].map(|probe| row(probe)[2]);
        println!("{mass} kg/m, {turn} rad: {low} m, {high} m");
        assert!(high > low && high > -0.4, "{low} m, {high} m");
        solve(&crossed(-above, turn, mass, &format!("{contact}, cables = true"))).unwrap();
        solve(&crossed(above + 2.0, turn, mass, &format!("{contact}, cables = true"))).unwrap();
        solve(&crossed(above, turn, mass, contact)).unwrap();
    }
}

/// A contact that carries less than lies on it lets a rope through, in motion, too: that is refused with its cause.
///
/// *Source.* The contact of ropes of 200 N and r = 1 cm carries `1.3 r k 2r` = 13 N at most (k = EA/(40 r^2)), and half of the limp rope's weight is 10 and 20 N, which
/// fall on it.
#[test]
fn what_is_too_heavy_for_its_contact_is_told() {
    for (above, turn, mass) in [(0.03, -0.4, 1.0), (0.1, 0.2, 2.0)] {
        let problem = solve(&crossed(above, turn, mass, "radius = 0.01, cables = true")).unwrap_err().to_string();
        let words = ["\"low\"", "\"high\"", "pass through", "too soft for what it carries"];
        assert!(words.iter().all(|word| problem.contains(word)), "{problem}");
    }
}

/// A beam of 40 kg on two ropes, and a limp rope across it that is drawn `above` its middle (m).
fn over_beam(above: f64, at: f64, half: f64, contact: &str) -> String {
    let hanger = |name: &str, x: f64| {
        format!(
            "[[cable]]\nname = {name:?}\npoints = [[{x}, 0.0, 0.0], [{x}, -1.0, 0.0]]\nelements = 6\naxial_stiffness = 2.0e5\nbending_stiffness = 0.01\n\
             mass_per_length = 0.1\n[[attachment]]\ncable = {name:?}\nat = \"start\"\nbody = \"world\"\n[[attachment]]\ncable = {name:?}\nat = \"end\"\n\
             body = \"beam\"\n"
        )
    };
    let y = -1.0 - half + above;
    format!(
        "[[body]]\nname = \"beam\"\nshape = {{ cuboid = [1.0, {half}, 0.3] }}\nmass = 40.0\nposition = [0.0, {}, 0.0]\n{}{}[[cable]]\nname = \"lies\"\n\
         points = [[{at}, {y}, -0.6], [{at}, {y}, 0.6]]\nelements = 40\naxial_stiffness = 20.0\nbending_stiffness = 0.01\nmass_per_length = 0.5\n{contact}{}",
        -1.0 - half,
        hanger("a", -0.9),
        hanger("b", 0.9),
        held("lies"),
    )
}

/// A limp rope that is drawn above a beam on two other ropes would hang through it or in it by its forces alone, and rests on it: its middle lies on the
/// top face. Below the beam, or without contact, it hangs free.
///
/// *Source.* The rope alone sags by more than 0.2 m between its ends.
#[test]
fn a_limp_rope_rests_on_a_beam_that_cables_carry() {
    let contact = "contact = { radius = 0.01 }\n";
    for (at, half) in [(-0.5, 0.05), (0.3, 0.05), (0.0, 0.2), (0.6, 0.01)] {
        let scene = over_beam(half + 0.05, at, half, contact);
        let probe =
            "[[probe]]\nname = \"lies\"\ncable = \"lies\"\nat = 0.6\n[[probe]]\nname = \"beam\"\nbody = \"beam\"\n";
        let (_, probes) = solve(&(scene + probe)).unwrap();
        let [rope, beam] = [&probes[0], &probes[1]].map(|probe| row(probe)[2]);
        println!("{half} m at {at} m: {rope} m over {beam} m");
        let gap = rope - beam - half;
        assert!((0.0..0.011).contains(&gap), "{gap} m over the top");
        solve(&over_beam(-half - 0.05, at, half, contact)).unwrap();
        solve(&over_beam(half + 0.05, at, half, "")).unwrap();
    }
}
