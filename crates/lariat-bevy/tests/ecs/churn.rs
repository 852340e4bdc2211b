//! Cables and bodies that are spawned and despawned at random.

use super::common::{bodies, cable_of, cube, soft, steps, world};
use bevy_ecs::prelude::*;
use lariat_bevy::event::StepFailed;
use lariat_bevy::{At, Attachment, Bending, CableAttachments, Cables, Damping, Diagnostics, Drag, Physics};
use proptest::prelude::*;

/// 100 cables with loads; in 1000 steps 50 of them are despawned, bodies are despawned under
/// others, and effects change.
fn churn(seed: u64) {
    let mut random = seed;
    let mut next = |most: u64| {
        // xorshift64*
        random ^= random >> 12;
        random ^= random << 25;
        random ^= random >> 27;
        random.wrapping_mul(0x2545_F491_4F6C_DD1D) % most
    };
    let mut world = world();
    let mut cables = Vec::new();
    let mut loads = Vec::new();
    for k in 0..100 {
        let (x, z) = (f64::from(k % 10), f64::from(k / 10));
        let load = world.spawn(cube(0.1, 2.0, [x, -1.1, z])).id();
        let cable = soft([x, 0.0, z], [x, -1.0, z]).elements(2).fidelity(lariat_bevy::lariat_ancf::Fidelity::Game);
        let cable = world.spawn((cable, Bending)).id();
        world.spawn(Attachment::ball(cable, At::Start).to_world());
        world.spawn(Attachment::ball(cable, At::End).to(load).at([0.0, 0.1, 0.0]));
        cables.push(cable);
        loads.push(load);
    }
    let mut despawned = 0;
    for step in 0..1000 {
        steps(&mut world, 1);
        let failures: Vec<StepFailed> = world.resource_mut::<Messages<StepFailed>>().drain().collect();
        assert!(failures.is_empty(), "step {step}: {:?}", failures[0]);
        if step % 20 == 19 {
            let cable = cables.swap_remove(next(cables.len() as u64) as usize);
            world.despawn(cable);
            despawned += 1;
        }
        if step % 50 == 7 {
            let load = loads.swap_remove(next(loads.len() as u64) as usize);
            world.despawn(load);
        }
        let some = cables[next(cables.len() as u64) as usize];
        match next(40) {
            0 => {
                world.entity_mut(some).insert((Damping::time(1e-4), Drag::air()));
            }
            1 => {
                world.entity_mut(some).remove::<(Damping, Bending)>();
            }
            _ => {}
        }
    }
    assert_eq!(despawned, 50);
    steps(&mut world, 1);
    let alive = world.query::<&Attachment>().iter(&world).count();
    assert_eq!(alive, world.resource::<Cables>().attachments());
    let related: usize =
        cables.iter().filter_map(|c| world.get::<CableAttachments>(*c)).map(|a| a.iter().count()).sum();
    assert_eq!(alive, related);
    assert!(cables.iter().all(|c| cable_of(&world, *c).positions().iter().all(|x| x.is_finite())));
    // ledger bodies are removed with their attachments
    assert!(bodies(&world) <= loads.len() + 1 + alive, "{} bodies", bodies(&world));
    assert_eq!(world.resource::<Physics>().impulse_joints.len(), bodies(&world) - loads.len() - 1);
    let counted = world.resource::<Diagnostics>();
    assert_eq!(counted.host_steps, 1001);
    let by_rule: u64 = counted.elements_by_rule.iter().map(|(_, n)| n).sum();
    assert_eq!(by_rule, counted.cables.element_evaluations());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3, max_shrink_iters: 0, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn random_spawning_and_despawning_leaves_nothing_behind(seed in 1u64..u64::MAX) {
        churn(seed);
    }
}
