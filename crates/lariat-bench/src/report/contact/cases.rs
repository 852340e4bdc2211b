//! What is measured in which scene.

use super::Case;
use super::run::Run;
use crate::error::Error;
use crate::numbers::largest;
use lariat_ancf::Vector3;

/// Gravity in m/s^2, as in scenes.
const G: f64 = 9.81;
/// Distance in m of the rope's centre line from the axis of the drum, and the mass of the rope in kg in the scenes with two loads.
const LEVER: f64 = 0.105;
const ROPE: f64 = 0.0153;
/// Long end in m of the rope that hangs over a drum.
const OVERHANG: f64 = 0.683424;

fn tension_over_weight(run: &mut Run) -> Result<f64, Error> {
    let (mut sum, mut count) = (0.0, 0.0);
    run.advance(3.0, |run| {
        if run.time() > 1.5 {
            sum += run.rope().sample(run.rope().length()).map_or(f64::NAN, |place| place.tension);
            count += 1.0;
        }
    })?;
    Ok(sum / count / (5.0 * G))
}

fn speed_of_rope(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.5, |_| ())?;
    Ok(run.velocity().x)
}

fn slide(run: &mut Run) -> Result<f64, Error> {
    run.advance(0.1, |_| ())?;
    let before = run.velocity().norm();
    run.advance(0.5, |_| ())?;
    Ok((run.velocity().norm() - before) / 0.4)
}

fn creep(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.0, |_| ())?;
    let before = run.rope().positions().to_vec();
    run.advance(61.0, |_| ())?;
    let moved = run.rope().positions().iter().zip(&before).map(|(now, before)| (now - before).abs());
    Ok(moved.fold(0.0, largest))
}

fn depth(run: &mut Run) -> Result<f64, Error> {
    run.advance(2.0, |_| ())?;
    let radius = run.rope().effects().contact.and_then(|contact| contact.radius).unwrap_or(f64::NAN);
    Ok(run.deepest / radius)
}

/// Returns the speed of the fastest node in m/s at a time in s.
fn speed_at(time: f64, run: &mut Run) -> Result<f64, Error> {
    run.advance(time, |_| ())?;
    Ok(run.fastest())
}

/// Returns the energy that was made up to a time in s, as a share of the first.
fn made_by(time: f64, run: &mut Run) -> Result<f64, Error> {
    run.advance(time, |_| ())?;
    Ok(run.made / run.start.abs())
}

/// The largest x that a place of the rope reached, beyond where it touches the wall.
fn beyond_the_wall(run: &mut Run) -> Result<f64, Error> {
    let mut farthest = f64::NEG_INFINITY;
    run.advance(0.5, |run| {
        let rope = run.rope();
        let places = (0..=200).filter_map(|k| rope.sample(rope.length() * f64::from(k) / 200.0).ok());
        farthest = places.map(|place| place.position.x).fold(farthest, largest);
    })?;
    Ok((farthest - (1.0 - 0.0005 - 0.005)) / 0.005)
}

/// How far the end of the rope comes down in 4 s, after one in which it settles.
fn slip(run: &mut Run) -> Result<f64, Error> {
    let end = |run: &Run| run.rope().node_position(run.rope().nodes() - 1).y;
    run.advance(1.0, |_| ())?;
    let before = end(run);
    run.advance(5.0, |_| ())?;
    Ok((before - end(run)).abs())
}

fn slides(run: &mut Run) -> Result<f64, Error> {
    Ok(f64::from(u8::from(slip(run)? > 0.01)))
}

/// What a swing of 3 J has lost: that of 1 kg and of a rope of 2 m above hanging straight down.
fn lost(run: &mut Run) -> Result<f64, Error> {
    run.advance(5.0, |_| ())?;
    let range = (1.0 * 2.0 + 0.14 * 2.0 * 1.0) * G * 0.2;
    Ok((run.start - run.world.energy(None).total()) / range)
}

/// How far the axis of the rope is from where its contact says that it is: at the sum of its radius and that of the rod, or of the edge of the box,
/// less the depth.
fn off_its_place(run: &mut Run) -> Result<f64, Error> {
    run.advance(2.0, |_| ())?;
    let rope = run.rope();
    let at = Vector3::new(0.03, if run.body(0).y < -0.1 { -0.005 } else { -0.007 }, 0.0);
    let reach = if run.body(0).y < -0.1 { 0.005 } else { 0.007 };
    let places = (0..=4000).filter_map(|k| rope.sample(rope.length() * f64::from(k) / 4000.0).ok());
    let nearest = places.map(|place| (place.position - at).xy().norm()).fold(f64::INFINITY, f64::min);
    let depth = rope.contacts().map(|touch| touch.depth).fold(0.0, largest);
    Ok((nearest - (reach - depth)).abs())
}

/// The force of two ropes that cross over that of beams under their tension.
fn force_of_beams(run: &mut Run) -> Result<f64, Error> {
    run.advance(5.0, |_| ())?;
    let (rope, half, stiffness) = (run.rope(), 0.5, 0.5);
    let touches = || rope.cable_contacts();
    let force = touches().map(|touch| (touch.normal * touch.normal_force + touch.friction).y).sum::<f64>().abs();
    let depth = touches().map(|touch| touch.depth).fold(0.0, largest);
    let tension = rope.sample(0.25 * rope.length())?.tension;
    let u = half * (tension / stiffness).sqrt();
    let exact = (0.02 + 0.005 - 0.5 * depth) * 4.0 * tension / (2.0 * half) / (1.0 - u.tanh() / u);
    Ok(force / exact)
}

/// How far the ball has gone from the middle of the net in 3 s.
fn way_of_the_ball(run: &mut Run) -> Result<f64, Error> {
    let mut farthest = 0.0;
    run.advance(3.0, |run| farthest = largest(farthest, if run.time() > 0.5 { run.body(0).norm() } else { 0.0 }))?;
    Ok(farthest)
}

fn way_on_the_truck(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.5, |_| ())?;
    Ok((run.body(1) - run.body(0)).xz().norm())
}

/// Returns the friction with which the overhang of 0.6834 m beside 0.2 m is a share of the longest that holds, `(0.2 + c) exp(mu pi) + c`,
/// `c = 2 mu R/(1 + mu^2)` (Euler-Eytelwein, with the weight of the rope on the drum).
fn friction_for(share: f64) -> f64 {
    let longest = |mu: f64| {
        let c = 2.0 * mu * LEVER / (1.0 + mu * mu);
        (0.2 + c) * (mu * std::f64::consts::PI).exp() + c
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if share * longest(middle) < OVERHANG { low = middle } else { high = middle }
    }
    low
}

fn rope_out(run: &mut Run) -> Result<f64, Error> {
    run.advance(4.5, |_| ())?;
    Ok(run.rope().length())
}

/// Returns the cases.
pub fn cases() -> Vec<Case> {
    let atwood = |inertia: f64| G / (5.0 + ROPE + inertia / (LEVER * LEVER));
    let case = |scene, quantity, exact, bound, measure| {
        let (changed, overrides) = (String::new(), Vec::new());
        Case { scene, quantity, changed, overrides, exact, bound, measure }
    };
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let mut cases = Vec::new();
    for mu in [0.1, 0.3, 0.5] {
        let exact = Some((mu * std::f64::consts::PI).exp());
        let capstan = case("capstan", "tension over the weight", exact, 0.05, tension_over_weight);
        let overrides = vec![format!("body.drum.friction={mu}"), format!("cable.rope.contact.friction={mu}")];
        cases.push(Case { changed: format!(", friction {mu}"), overrides, ..capstan });
    }
    cases.push(case("atwood", "acceleration, m/s^2", Some(atwood(0.0)), 0.01, |run| run.fall(1)));
    cases.push(case("free_drum", "acceleration, m/s^2", Some(atwood(0.02)), 0.02, |run| run.fall(1)));
    cases.push(case("conveyor", "speed of the rope, m/s", Some(1.0), 0.01, speed_of_rope));
    cases.push(case("slide", "acceleration, m/s^2", Some(G * (sin - 0.3 * cos)), 0.01, slide));
    cases.push(case("stick", "creep in 60 s, m", None, 1e-6, creep));
    cases.push(case("cylinder", "depth, share of the radius", None, 0.05, depth));
    cases.push(case("cylinder", "speed after 2 s, m/s", None, 1e-3, |run| speed_at(2.0, run)));
    cases.push(case("drop", "energy made, share of the first", None, 1e-6, |run| made_by(1.25, run)));
    cases.push(case("drop", "speed a second after it lands, m/s", None, 1e-3, |run| speed_at(1.25, run)));
    for speed in [10.0, 100.0, 200.0] {
        let wall = case("wall", "way into the wall, share of the radius", None, 1.0, beyond_the_wall);
        let overrides = vec![format!("cable.rope.velocity=[{speed:?}, 0.0, 0.0]")];
        cases.push(Case { changed: format!(" at {speed} m/s"), overrides, ..wall });
    }
    cases.push(case("catch", "depth, share of the radius", None, 0.1, depth));
    cases.push(case("catch", "energy made, share of the first", None, 1e-6, |run| made_by(1.25, run)));
    for (share, stays) in [(0.5, true), (0.95, true), (1.05, false), (2.0, false)] {
        let mu = friction_for(share);
        let overrides = vec![format!("body.drum.friction={mu}"), format!("cable.rope.contact.friction={mu}")];
        let overhang = if stays {
            case("overhang", "slip in 4 s, m", None, 1e-4, slip)
        } else {
            case("overhang", "slides (1)", Some(1.0), 0.0, slides)
        };
        cases.push(Case { changed: format!(", {share} of the longest"), overrides, ..overhang });
    }
    for mu in [0.1, 0.3, 0.5] {
        let exact = Some((mu * std::f64::consts::PI).exp());
        let drum = case("spinning_drum", "tension over the weight", exact, 0.05, tension_over_weight);
        let overrides = vec![format!("body.drum.friction={mu}"), format!("cable.rope.contact.friction={mu}")];
        cases.push(Case { changed: format!(", friction {mu}"), overrides, ..drum });
    }
    cases.push(case("swing", "loses in 5 s, share of 4.5 J", None, 0.02, lost));
    for (scene, elements) in ["rod", "edge"].into_iter().flat_map(|scene| [11, 20, 34].map(|n| (scene, n))) {
        let over = case(scene, "axis off its place, m", None, 1e-4, off_its_place);
        let overrides = vec![format!("cable.rope.elements={elements}")];
        cases.push(Case { changed: format!(", {elements} elements"), overrides, ..over });
    }
    for mass in [0.05, 1.0, 50.0, 500.0] {
        let ball = case("on_a_rope", "energy made, share of the first", None, 1e-6, |run| made_by(2.0, run));
        cases.push(Case {
            changed: format!(", {mass} kg"),
            overrides: vec![format!("body.ball.mass={mass:?}")],
            ..ball
        });
    }
    cases.push(case("crossing", "force over that of beams", Some(1.0), 0.02, force_of_beams));
    cases.push(case("heap", "speed after 5 s, m/s", None, 1e-3, |run| speed_at(5.0, run)));
    cases.push(case("heap", "energy made, share of the first", None, 1e-6, |run| made_by(2.0, run)));
    let limp = [
        "cable.rope.points=[[0, 0.02, 0], [0.05, 5.02, 0.01]]",
        "cable.rope.elements=60",
        "cable.rope.axial_stiffness=1e4",
        "cable.rope.bending_stiffness=2e-4",
        "cable.rope.mass_per_length=0.05",
    ];
    cases.push(Case {
        changed: ", limp, 5 m".to_string(),
        overrides: limp.map(String::from).to_vec(),
        ..case("heap", "energy made, share of the first", None, 1e-6, |run| made_by(2.5, run))
    });
    // a ball that falls through is 20 m away
    cases.push(case("net", "way of the ball from the middle, m", None, 1.5, way_of_the_ball));
    cases.push(case("net", "energy made, share of the first", None, 1e-6, |run| made_by(2.0, run)));
    cases.push(case("grapple", "rope out after 3 m are reeled in, m", Some(7.0), 1.5e-4, rope_out));
    cases.push(case("lashed", "way of the crate on the truck, m", None, 5e-3, way_on_the_truck));
    cases
}
