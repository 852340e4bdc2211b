//! Many cables on a body, many bodies on cables, nets and loops.

use super::super::world::test_world::Rope;
use super::prelude::*;

fn cord() -> Section {
    Section::from_stiffness(1e5, 0.0, 0.02).expect("a section")
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let hub = case(Family::Many, "64 cables meet at a body", 0.25, |w| {
        let body = w.ball(20.0, 0.2, [0.0; 3]);
        for k in 0..64 {
            let a = std::f64::consts::TAU * k as f64 / 64.0;
            let rope = straight([2.0 * a.cos(), 1.0, 2.0 * a.sin()], [0.2 * a.cos(), 0.0, 0.2 * a.sin()], cord());
            let rope = rope.elements(4).integrator(l_stable_integrator());
            w.rope(rope, End::Fixed, End::On(body, [0.2 * a.cos(), 0.0, 0.2 * a.sin()]))?;
        }
        Ok(Script::new().checks(move |w| {
            // 64 springs of EA/L = 4.9e4 N/m, half of it along y: 1.4e-4 m under 20 kg, twice that
            // when released from the unstretched length
            let y = w.position(body).y;
            let k = 64.0 * 1e5 / 2.06f64 * (1.0 / 2.06f64).powi(2);
            vec![Check::between("height, m", y, (-4.0 * 21.0 * G / k, 1e-4), "statics, twice that when released")]
        }))
    });
    // the integrator damps the vibration after the release
    cases.push(hub.energy(0.01, 0.15).budget(100));
    let net = case(Family::Many, "a net of 400 cables", 0.1, |w| {
        net(w, 14)?;
        Ok(Script::new().checks(|w| {
            let low = w.set.iter().map(|(_, c)| c.node_position(0).y).fold(0.0, f64::min);
            vec![Check::between("lowest knot, m", low, (-0.06, -1e-4), "free fall at most: g t^2/2 = 0.049 m")]
        }))
    });
    cases.push(net.budget(200).lariat_only().long().on(|h| h.rate <= 60 && h.iterations == 4));
    let chain = case(Family::Many, "a chain of 20 bodies", 0.5, |w| {
        let mut before = End::Fixed;
        for k in 0..20 {
            let x = 0.5 * k as f64;
            let ball = w.ball(1.0, 0.05, [x + 0.5, 0.0, 0.0]);
            let link = straight([x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], cord()).elements(2).fidelity(Fidelity::Game);
            w.rope(link, before, End::On(ball, [0.0; 3]))?;
            before = End::On(ball, [0.0; 3]);
        }
        Ok(Script::new())
    });
    cases.push(chain.budget(50));
    let ring = case(Family::Many, "a spinning ring of 8 bodies", 1.0, |w| {
        w.remove_gravity();
        let at = |k: usize| {
            let a = std::f64::consts::TAU / 8.0 * k as f64;
            Vector3::new(a.cos(), a.sin(), 0.0)
        };
        let balls: Vec<_> = (0..8)
            .map(|k| {
                let ball = w.ball(2.0, 0.05, at(k).into());
                let v = Vector3::z().cross(&at(k)) * 3.0;
                w.set_velocity(ball, v.into());
                w.physics.bodies[ball].set_angvel(to_rapier([0.0, 0.0, 3.0]), true);
                ball
            })
            .collect();
        for k in 0..8 {
            let (a, b) = (at(k), at((k + 1) % 8));
            let side = straight(a.into(), b.into(), polymer_rope()).elements(4).gravity(Vector3::zeros());
            let side = side.velocity(Vector3::z().cross(&a) * 3.0).angular_velocity(Vector3::z() * 3.0);
            w.rope(side, End::On(balls[k], [0.0; 3]), End::On(balls[(k + 1) % 8], [0.0; 3]))?;
        }
        let before = w.set.momentum(&w.physics)?;
        Ok(Script::new().checks(move |w| {
            let Ok(after) = w.set.momentum(&w.physics) else { return Vec::new() };
            let (dp, dl) = (after.linear - before.linear, after.angular - before.angular);
            vec![
                Check::at_most("linear momentum gained, kg m/s", dp.norm(), 1e-3, "conservation, in single precision"),
                Check::at_most("angular momentum lost", dl.norm() / before.angular.norm(), 1e-4, "conservation"),
            ]
        }))
    });
    cases.push(ring.energy(1e-3, 0.01).budget(50));
    cases
}

/// Adds a square net with `n` knots a side, held at its corners; its damped meshes are 0.5 m long.
fn net(w: &mut TestWorld, n: usize) -> Result<(), Fault> {
    let place = |i: usize, j: usize| [0.5 * i as f64, 0.0, 0.5 * j as f64];
    let corner = |i: usize, j: usize| (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
    let held = |i: usize, j: usize| if corner(i, j) { End::Fixed } else { End::Free };
    // for each knot, the first end that was placed there
    let mut knots = vec![None; n * n];
    let mut edges = Vec::new();
    for i in 0..n {
        for j in 0..n {
            edges.extend((i + 1 < n).then_some([(i, j), (i + 1, j)]));
            edges.extend((j + 1 < n).then_some([(i, j), (i, j + 1)]));
        }
    }
    // 14 knots a side have 364 edges; the rest of 400 hang down from knots
    let hung = 400usize.saturating_sub(edges.len());
    for [a, b] in edges {
        let mesh = straight(place(a.0, a.1), place(b.0, b.1), cord()).elements(2).integrator(l_stable_integrator());
        let mesh = mesh.damping(Damping { axial: 1e-4, bending: 0.0 });
        let rope = w.rope(mesh, held(a.0, a.1), held(b.0, b.1))?;
        let Rope::Cable(handle) = w.ropes[rope] else { continue };
        for (at, (i, j)) in [(At::Start, a), (At::End, b)] {
            if corner(i, j) {
                continue;
            }
            match knots[i * n + j] {
                None => knots[i * n + j] = Some((handle, at)),
                Some((first, end)) => {
                    w.set.join((first, end), (handle, at))?;
                }
            }
        }
    }
    for (k, knot) in knots.into_iter().flatten().take(hung).enumerate() {
        let (first, end) = knot;
        let at = w.set.get(first)?.sample(w.set.get(first)?.arc_length(end)?)?.position;
        let tassel =
            straight(at.into(), [at.x, at.y - 0.5, at.z], cord()).elements(2).integrator(l_stable_integrator());
        let rope = w.rope(tassel.damping(Damping { axial: 1e-4, bending: 0.0 }), End::Free, End::Free)?;
        debug_assert!(k < hung);
        if let Rope::Cable(handle) = w.ropes[rope] {
            w.set.join((first, end), (handle, At::Start))?;
        }
    }
    Ok(())
}
