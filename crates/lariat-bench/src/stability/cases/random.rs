//! Scenes drawn by chance from all of the families: bodies strung on ropes of any stiffness, slack or taut, flying and spinning, over a
//! floor or in space, and in the middle of the run something that a user does.

use super::G;
use super::engine::rapier::prelude::*;
use super::stage::{Case, End, Fault, Play, Stage, case, damping, line, to};
use crate::stability::Family::Random;
use crate::stability::outcome::Reading;
use crate::stability::recipe::{Recipe, SCENES};
use lariat_ancf::{Fidelity, Section, Vector3};

/// The scenes of the full run.
pub fn cases() -> Vec<Case> {
    (0..SCENES).map(|seed| scene(format!("scene {seed}"), Recipe::from_seed(seed as u64))).collect()
}

/// What happens in the middle of a run.
fn disturb(s: &mut Stage, recipe: &Recipe, body: RigidBodyHandle) {
    let Some(b) = s.world.bodies.get_mut(body) else { return };
    match recipe.choose(24, 7) {
        0 => b.set_translation(b.translation() + to([0.2 * recipe.signed(25), 0.1, 0.0]), true),
        1 => drop(s.world.remove_body(body)),
        2 => s.world.gravity = -s.world.gravity,
        3 => b.set_body_type(RigidBodyType::Fixed, true),
        4 => b.set_linvel(to([10.0 * recipe.signed(25), 10.0 * recipe.signed(26), 0.0]), true),
        5 => b.set_angvel(to([0.0, 20.0 * recipe.signed(25), 20.0 * recipe.signed(26)]), true),
        _ => {}
    }
}

/// The scene of a recipe.
pub fn scene(name: String, recipe: Recipe) -> Case {
    let host = recipe.host();
    let built = case(Random, name, 0.4, move |s| build(s, recipe));
    let drawn = Case { hosts: Box::new(move |h| *h == host), ..built };
    // a refused step is an answer; gaps of a wide stretch of parameters: 1 cm
    drawn.energy(0.02, f64::INFINITY).gap(1e-2).may_refuse().ours().budget(2.0)
}

fn build(s: &mut Stage, recipe: Recipe) -> Result<Play, Fault> {
    let weightless = recipe.choose(4, 3) == 0;
    if weightless {
        s.weightless();
    }
    let floor = recipe.choose(5, 3) == 0;
    if floor {
        s.post([0.0, -2.5, 0.0], [20.0, 0.5, 20.0]);
    }
    let held = recipe.choose(6, 3) > 0;
    let bodies = 1 + recipe.choose(7, 4);
    let mut at = Vector3::zeros();
    let mut before = if held { End::Fixed } else { End::Free };
    let mut loads = Vec::new();
    for k in 0..bodies {
        let mass = recipe.power(8 + k, -2.0, 3.0);
        let angle = std::f64::consts::PI * recipe.signed(12 + k);
        let next = at + Vector3::new(angle.cos(), 0.4 * angle.sin(), 0.5 * angle.sin()) * 0.8;
        let ball = s.ball(mass, 0.06, next.into());
        let speed = if recipe.choose(16, 2) == 0 { 0.0 } else { 5.0 };
        s.drive(ball, [speed * recipe.signed(17), speed * recipe.signed(18), speed * recipe.signed(19)]);
        let ei = if recipe.choose(20, 4) == 0 { 0.0 } else { recipe.power(20, -6.0, 1.0) };
        let section = Section::from_stiffness(recipe.power(21, 3.0, 7.0), ei, recipe.power(22, -2.0, 0.5))?;
        let drawn = (next - at).norm();
        let rope = line(at.into(), next.into(), section)
            .length(drawn * (0.95 + 0.35 * recipe.0[23]))
            .elements(2 + recipe.choose(27, 4));
        let rope = if weightless { rope.gravity(Vector3::zeros()) } else { rope };
        let rope = match recipe.choose(28, 6) {
            0 | 1 => rope.integrator(damping()),
            2 => rope.fidelity(Fidelity::Engineering),
            _ => rope.fidelity(Fidelity::Game),
        };
        let end = if recipe.choose(29, 4) == 0 { End::ClampedOn(ball, [0.0; 3]) } else { End::On(ball, [0.0; 3]) };
        s.rope(rope, before, end)?;
        before = End::On(ball, [0.0; 3]);
        loads.push(ball);
        at = next;
    }
    let (mut done, mut settled) = (false, false);
    let target = loads[recipe.choose(30, loads.len())];
    let lonely = weightless && !held && !floor && !s.host.effects;
    let momentum = std::rc::Rc::new(std::cell::Cell::new(None));
    let start = momentum.clone();
    Ok(Play::idle()
        .acting(move |s| {
            if !done && s.time >= 0.15 {
                done = true;
                disturb(s, &recipe, target);
                // what a user does is work; ends close at 10 m/s
                s.pause();
            }
            if !settled && s.time >= 0.22 {
                settled = true;
                s.rebase();
                let whole = s.world.bodies.get(target).is_some_and(|b| b.is_dynamic());
                start.set(if whole { s.set.momentum(&s.world).ok() } else { None });
            }
            Ok(())
        })
        .judging(move |s| {
            let (Some(before), Ok(after)) = (momentum.get(), s.set.momentum(&s.world)) else { return Vec::new() };
            if !lonely {
                return Vec::new();
            }
            let scale = s.mass() * (1.0 + G * 0.1);
            let gained = (after.linear - before.linear).norm() / scale;
            vec![Reading::at_most("momentum gained per mass, m/s", gained, 1e-3, "conservation, in single precision")]
        }))
}
