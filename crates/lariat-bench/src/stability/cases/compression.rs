//! Ends pushed together, rods that buckle under their own weight, a loop folded on itself.

use super::prelude::*;

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, section) in [("polymer rope", polymer_rope()), ("steel wire", steel_wire())] {
        // 2 m of cable; one end is driven by 1 m towards the other
        let pushed = case(Family::Compression, format!("ends pushed together, {name}"), 1.3, move |w| {
            w.remove_gravity();
            let head = w.winch([2.0, 0.0, 0.0]);
            let rope = straight([0.0; 3], [2.0, 0.0, 0.0], section).gravity(Vector3::zeros());
            let rope = rope.damping(Damping { axial: 1e-4, bending: 5e-3 });
            let rope = rope.integrator(lariat_ancf::Integrator::tolerance(lariat_ancf::Method::Esdirk3, 1e-4)?);
            w.rope(rope, End::Fixed, End::On(head, [0.0; 3]))?;
            Ok(Script::new()
                .before_step(move |w| {
                    // 1 m in a second, smoothly: 6 t (1 - t), exact over each step
                    let path = |t: f64| t.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * t.clamp(0.0, 1.0));
                    let speed = (path(w.time) - path(w.time + w.dt())) / w.dt();
                    w.set_velocity(head, [speed, 0.0, 0.0]);
                    if w.time < 1.0 - 1e-9 {
                        w.suspend_checks();
                    } else if w.time < 1.0 + w.dt() {
                        w.restart_balance();
                    }
                    // a small imperfection
                    if w.steps_done == 0
                        && let Ok(cable) = w.cable_mut(0)
                    {
                        let mut q = cable.positions().to_vec();
                        q[6 * 5 + 1] += 1e-4;
                        let v = cable.velocities().to_vec();
                        cable.set_coordinates(&q, &v)?;
                    }
                    Ok(())
                })
                .checks(move |w| {
                    let end = w.cable(0).map_or(f64::NAN, |c| c.node_position(c.nodes() - 1).x);
                    vec![
                        Check::near("position of the end, m", end, 1.0, 0.05, "where the head was driven"),
                        Check::at_most("stretch", w.stretch(0).abs(), 0.05, "buckled: bent, not compressed"),
                    ]
                }))
        });
        cases.push(pushed.energy(0.05, 0.01));
    }
    for share in [0.9, 1.5] {
        // Greenhill's height: (7.837 EI/mu g)^(1/3)
        let standing =
            case(Family::Compression, format!("standing rod, {share} of its critical height"), 8.0, move |w| {
                let section = Section::round(0.004, 2e9, 1200.0)?;
                let critical = (7.837 * section.bending_stiffness / (section.mass_per_length * G)).cbrt();
                let height = share * critical;
                let lean = 1e-2 * height;
                let rod =
                    straight([0.0; 3], [lean, height, 0.0], section).damping(Damping { axial: 1e-4, bending: 0.02 });
                w.rope(rod, End::Clamped, End::Free)?;
                Ok(Script::new().checks(move |w| {
                    let Some(c) = w.cable(0) else { return Vec::new() };
                    let tip = c.node_position(c.nodes() - 1);
                    let bounds = if share < 1.0 { (0.0, 0.1) } else { (0.3, 2.0) };
                    let lateral = (tip.x / height).abs();
                    vec![Check::between(
                        "lateral position of the tip over the height",
                        lateral,
                        bounds,
                        "Greenhill 1881: stands or falls",
                    )]
                }))
            });
        cases.push(standing);
    }
    let folded = case(Family::Compression, "loop folded on itself", 0.5, |w| {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -0.02, 0.0]].map(Vector3::from);
        let loop_ =
            Cable::builder().points(points).section(polymer_rope()).elements(20).fidelity(Fidelity::Engineering);
        w.rope(loop_.damping(Damping { axial: 1e-4, bending: 1e-2 }), End::Fixed, End::Free)?;
        Ok(Script::new())
    });
    cases.push(folded.may_fail().lariat_only());
    cases
}
