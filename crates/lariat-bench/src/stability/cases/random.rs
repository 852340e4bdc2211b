//! Random combinations of all families: bodies on ropes of any stiffness, slack or taut, flying and
//! spinning, over a floor or in space; in the middle of the run a user changes something.

use super::prelude::*;
use crate::stability::recipe::{Recipe, SCENES};
use std::cell::Cell;
use std::rc::Rc;

/// Returns the scenes of the full run.
pub fn cases() -> Vec<Case> {
    (0..SCENES).map(|seed| scene(format!("scene {seed}"), Recipe::from_seed(seed as u64))).collect()
}

/// Changes the world, as a user may in the middle of a run.
fn change(w: &mut TestWorld, recipe: &Recipe, body: RigidBodyHandle) {
    let Some(b) = w.physics.bodies.get_mut(body) else { return };
    match recipe.choose(24, 7) {
        0 => b.set_translation(b.translation() + to_rapier([0.2 * recipe.signed(25), 0.1, 0.0]), true),
        1 => drop(w.physics.remove_body(body)),
        2 => w.physics.gravity = -w.physics.gravity,
        3 => b.set_body_type(RigidBodyType::Fixed, true),
        4 => b.set_linvel(to_rapier([10.0 * recipe.signed(25), 10.0 * recipe.signed(26), 0.0]), true),
        5 => b.set_angvel(to_rapier([0.0, 20.0 * recipe.signed(25), 20.0 * recipe.signed(26)]), true),
        _ => {}
    }
}

/// Returns the scene of a recipe.
pub fn scene(name: String, recipe: Recipe) -> Case {
    let host = recipe.host();
    let built = case(Family::Random, name, 0.4, move |w| build(w, recipe));
    let scene = Case { hosts: Box::new(move |h| *h == host), ..built };
    // Parameters vary over many powers of ten: an error is an answer, and gaps may reach 1 cm.
    // Contacts with the floor and the damping of the integrators may take all energy of the start,
    // and as much again that gravity supplies.
    scene.energy(0.02, 2.0).gap(1e-2).may_fail().lariat_only().budget(10)
}

fn build(w: &mut TestWorld, recipe: Recipe) -> Result<Script, Fault> {
    let weightless = recipe.choose(4, 3) == 0;
    if weightless {
        w.remove_gravity();
    }
    let floor = recipe.choose(5, 3) == 0;
    if floor {
        w.post([0.0, -2.5, 0.0], [20.0, 0.5, 20.0]);
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
        let ball = w.ball(mass, 0.06, next.into());
        let speed = if recipe.choose(16, 2) == 0 { 0.0 } else { 5.0 };
        w.set_velocity(ball, [speed * recipe.signed(17), speed * recipe.signed(18), speed * recipe.signed(19)]);
        let ei = if recipe.choose(20, 4) == 0 { 0.0 } else { recipe.power(20, -6.0, 1.0) };
        let section = Section::from_stiffness(recipe.power(21, 3.0, 7.0), ei, recipe.power(22, -2.0, 0.5))?;
        let drawn = (next - at).norm();
        let rope = straight(at.into(), next.into(), section)
            .length(drawn * (0.95 + 0.35 * recipe.0[23]))
            .elements(2 + recipe.choose(27, 4));
        let rope = if weightless { rope.gravity(Vector3::zeros()) } else { rope };
        let rope = match recipe.choose(28, 6) {
            0 | 1 => rope.integrator(l_stable_integrator()),
            2 => rope.fidelity(Fidelity::Engineering),
            _ => rope.fidelity(Fidelity::Game),
        };
        let clamps = recipe.choose(29, 4) == 0;
        let end = if clamps { End::ClampedOn(ball, [0.0; 3]) } else { End::On(ball, [0.0; 3]) };
        // with effects, clamps at both ends hold the twist of a rope that has torsion
        let start = match before {
            End::Fixed if clamps && w.host.effects => End::Clamped,
            End::On(body, anchor) if clamps && w.host.effects => End::ClampedOn(body, anchor),
            other => other,
        };
        w.rope(rope, start, end)?;
        before = End::On(ball, [0.0; 3]);
        loads.push(ball);
        at = next;
    }
    let (mut done, mut settled) = (false, false);
    let target = loads[recipe.choose(30, loads.len())];
    let isolated = weightless && !held && !floor && !w.host.effects;
    let momentum = Rc::new(Cell::new(None));
    let start = momentum.clone();
    Ok(Script::new()
        .before_step(move |w| {
            if !done && w.time >= 0.15 {
                done = true;
                change(w, &recipe, target);
                // the change does work; gaps close at 10 m/s
                w.suspend_checks();
            }
            if !settled && w.time >= 0.22 {
                settled = true;
                w.restart_balance();
                let whole = w.physics.bodies.get(target).is_some_and(|b| b.is_dynamic());
                start.set(if whole { w.set.momentum(&w.physics).ok() } else { None });
            }
            Ok(())
        })
        .checks(move |w| {
            let (Some(before), Ok(after)) = (momentum.get(), w.set.momentum(&w.physics)) else { return Vec::new() };
            if !isolated {
                return Vec::new();
            }
            let scale = w.mass() * (1.0 + G * 0.1);
            let gained = (after.linear - before.linear).norm() / scale;
            vec![Check::at_most("momentum gained per mass, m/s", gained, 1e-3, "conservation, in single precision")]
        }))
}
