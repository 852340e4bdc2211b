//! Ends pushed together, rods that buckle under their own weight, a loop folded on itself.

use super::G;
use super::stage::{Case, End, Play, case, line, soft, wire};
use crate::stability::Family::Compression;
use crate::stability::outcome::Reading;
use lariat_ancf::{Cable, Damping, Section, Vector3};

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, section) in [("soft bar", soft()), ("steel wire", wire())] {
        // 2 m between two heads that meet halfway in a second
        let pushed = case(Compression, format!("ends pushed together, {name}"), 1.3, move |s| {
            s.weightless();
            let head = s.winch([2.0, 0.0, 0.0]);
            let rope = line([0.0; 3], [2.0, 0.0, 0.0], section).gravity(Vector3::zeros());
            let rope = rope.damping(Damping { axial: 1e-4, bending: 5e-3 });
            let rope = rope.integrator(lariat_ancf::Integrator::tolerance(lariat_ancf::Method::Esdirk3, 1e-4)?);
            s.rope(rope, End::Fixed, End::On(head, [0.0; 3]))?;
            Ok(Play::idle()
                .acting(move |s| {
                    // 1 m in a second, smoothly: 6 t (1 - t), exact over each step
                    let way = |t: f64| t.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * t.clamp(0.0, 1.0));
                    let speed = (way(s.time) - way(s.time + s.dt())) / s.dt();
                    s.drive(head, [speed, 0.0, 0.0]);
                    if s.time < 1.0 - 1e-9 {
                        s.pause();
                    } else if s.time < 1.0 + s.dt() {
                        s.rebase();
                    }
                    // a nudge aside: nature's imperfection
                    if s.k == 0
                        && let Ok(cable) = s.cable_mut(0)
                    {
                        let mut q = cable.positions().to_vec();
                        q[6 * 5 + 1] += 1e-4;
                        let v = cable.velocities().to_vec();
                        cable.set_coordinates(&q, &v)?;
                    }
                    Ok(())
                })
                .judging(move |s| {
                    let end = s.cable(0).map_or(f64::NAN, |c| c.node_position(c.nodes() - 1).x);
                    vec![
                        Reading::near("end, m", end, 1.0, 0.05, "where the head was driven"),
                        Reading::at_most("stretch", s.stretch(0).abs(), 0.05, "buckled: bent, not squeezed"),
                    ]
                }))
        });
        cases.push(pushed.energy(0.05, f64::INFINITY));
    }
    for share in [0.9, 1.5] {
        // Greenhill's height: (7.837 EI/mu g)^(1/3)
        let standing = case(Compression, format!("standing rod, {share} of its critical height"), 8.0, move |s| {
            let section = Section::round(0.004, 2e9, 1200.0)?;
            let critical = (7.837 * section.bending_stiffness / (section.mass_per_length * G)).cbrt();
            let height = share * critical;
            let lean = 1e-2 * height;
            let rod = line([0.0; 3], [lean, height, 0.0], section).damping(Damping { axial: 1e-4, bending: 0.02 });
            s.rope(rod, End::Clamped, End::Free)?;
            Ok(Play::idle().judging(move |s| {
                let Some(c) = s.cable(0) else { return Vec::new() };
                let tip = c.node_position(c.nodes() - 1);
                let bounds = if share < 1.0 { (0.0, 0.1) } else { (0.3, 2.0) };
                let aside = (tip.x / height).abs();
                vec![Reading::between(
                    "tip aside, shares of the height",
                    aside,
                    bounds,
                    "Greenhill 1881: stands or falls",
                )]
            }))
        });
        cases.push(standing.energy(0.01, f64::INFINITY));
    }
    let folded = case(Compression, "loop folded on itself", 0.5, |s| {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -0.02, 0.0]].map(Vector3::from);
        let loop_ = Cable::builder().points(points).section(soft()).elements(20);
        s.rope(loop_.damping(Damping { axial: 1e-4, bending: 1e-2 }), End::Fixed, End::Free)?;
        Ok(Play::idle())
    });
    cases.push(folded.energy(0.01, f64::INFINITY).may_refuse().ours());
    cases
}
