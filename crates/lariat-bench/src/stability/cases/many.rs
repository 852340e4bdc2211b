//! Many cables on a body, many bodies on cables, nets and loops.

use super::G;
use super::stage::{Case, End, Play, Stage, case, line, soft, to};
use crate::stability::Family::Many;
use crate::stability::outcome::Reading;
use lariat_ancf::{At, Damping, Fidelity, Integrator, Section, Vector3};

fn cord() -> Section {
    Section::from_stiffness(1e5, 0.0, 0.02).expect("a section")
}

fn rate_480() -> Integrator {
    super::stage::damping()
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let hub = case(Many, "64 cables meet at a body", 0.25, |s| {
        let body = s.ball(20.0, 0.2, [0.0; 3]);
        for k in 0..64 {
            let a = std::f64::consts::TAU * k as f64 / 64.0;
            let rope = line([2.0 * a.cos(), 1.0, 2.0 * a.sin()], [0.2 * a.cos(), 0.0, 0.2 * a.sin()], cord());
            let rope = rope.elements(4).integrator(rate_480());
            s.rope(rope, End::Fixed, End::On(body, [0.2 * a.cos(), 0.0, 0.2 * a.sin()]))?;
        }
        Ok(Play::idle().judging(move |s| {
            // 64 springs of EA/L = 4.9e4 N/m, half of it along y: 1.4e-4 m under 20 kg, twice that when hung in
            let y = s.place(body).y;
            let k = 64.0 * 1e5 / 2.06f64 * (1.0 / 2.06f64).powi(2);
            vec![Reading::between("height, m", y, (-4.0 * 21.0 * G / k, 1e-4), "statics, twice when hung in")]
        }))
    });
    cases.push(hub.energy(0.01, f64::INFINITY).budget(20.0));
    let net = case(Many, "a net of 400 cables", 0.1, |s| {
        net(s, 14)?;
        Ok(Play::idle().judging(|s| {
            let low = s.set.iter().map(|(_, c)| c.node_position(0).y).fold(0.0, f64::min);
            vec![Reading::between("lowest knot, m", low, (-0.06, -1e-4), "free fall at most: g t^2/2 = 0.049 m")]
        }))
    });
    cases.push(net.energy(0.01, f64::INFINITY).budget(40.0).ours().on(|h| h.rate <= 60 && h.iterations == 4));
    let chain = case(Many, "a chain of 20 bodies", 0.5, |s| {
        let mut before = End::Fixed;
        for k in 0..20 {
            let x = 0.5 * k as f64;
            let ball = s.ball(1.0, 0.05, [x + 0.5, 0.0, 0.0]);
            let link = line([x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], cord()).elements(2).fidelity(Fidelity::Game);
            s.rope(link, before, End::On(ball, [0.0; 3]))?;
            before = End::On(ball, [0.0; 3]);
        }
        Ok(Play::idle())
    });
    cases.push(chain.energy(0.01, 0.1).budget(10.0));
    let ring = case(Many, "a spinning ring of 8 bodies", 1.0, |s| {
        s.weightless();
        let at = |k: usize| {
            let a = std::f64::consts::TAU / 8.0 * k as f64;
            Vector3::new(a.cos(), a.sin(), 0.0)
        };
        let balls: Vec<_> = (0..8)
            .map(|k| {
                let ball = s.ball(2.0, 0.05, at(k).into());
                let v = Vector3::z().cross(&at(k)) * 3.0;
                s.drive(ball, v.into());
                s.world.bodies[ball].set_angvel(to([0.0, 0.0, 3.0]), true);
                ball
            })
            .collect();
        for k in 0..8 {
            let (a, b) = (at(k), at((k + 1) % 8));
            let side = line(a.into(), b.into(), soft()).elements(4).gravity(Vector3::zeros());
            let side = side.velocity(Vector3::z().cross(&a) * 3.0).angular_velocity(Vector3::z() * 3.0);
            s.rope(side, End::On(balls[k], [0.0; 3]), End::On(balls[(k + 1) % 8], [0.0; 3]))?;
        }
        let before = s.set.momentum(&s.world)?;
        Ok(Play::idle().judging(move |s| {
            let Ok(after) = s.set.momentum(&s.world) else { return Vec::new() };
            let (dp, dl) = (after.linear - before.linear, after.angular - before.angular);
            vec![
                Reading::at_most(
                    "linear momentum gained, kg m/s",
                    dp.norm(),
                    1e-3,
                    "conservation, in single precision",
                ),
                Reading::at_most("angular momentum lost", dl.norm() / before.angular.norm(), 1e-4, "conservation"),
            ]
        }))
    });
    cases.push(ring.energy(1e-3, 0.01).budget(10.0));
    cases
}

/// A square net with `n` knots a side, its corners held; its meshes of 0.5 m are damped.
fn net(s: &mut Stage, n: usize) -> Result<(), super::stage::Fault> {
    let place = |i: usize, j: usize| [0.5 * i as f64, 0.0, 0.5 * j as f64];
    let corner = |i: usize, j: usize| (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
    let held = |i: usize, j: usize| if corner(i, j) { End::Fixed } else { End::Free };
    // by knot, the first end that came there
    let mut knots = vec![None; n * n];
    let mut edges = Vec::new();
    for i in 0..n {
        for j in 0..n {
            edges.extend((i + 1 < n).then_some([(i, j), (i + 1, j)]));
            edges.extend((j + 1 < n).then_some([(i, j), (i, j + 1)]));
        }
    }
    // 14 knots a side have 364 edges; the rest of 400 hang from knots as tassels
    let hung = 400usize.saturating_sub(edges.len());
    for [a, b] in edges {
        let mesh = line(place(a.0, a.1), place(b.0, b.1), cord()).elements(2).integrator(rate_480());
        let mesh = mesh.damping(Damping { axial: 1e-4, bending: 0.0 });
        let rope = s.rope(mesh, held(a.0, a.1), held(b.0, b.1))?;
        let super::stage::Strand::Cable(handle) = s.strands[rope] else { continue };
        for (at, (i, j)) in [(At::Start, a), (At::End, b)] {
            if corner(i, j) {
                continue;
            }
            match knots[i * n + j] {
                None => knots[i * n + j] = Some((handle, at)),
                Some((first, end)) => {
                    s.set.join((first, end), (handle, at))?;
                }
            }
        }
    }
    for (k, knot) in knots.into_iter().flatten().take(hung).enumerate() {
        let (first, end) = knot;
        let at = s.set.get(first)?.sample(s.set.get(first)?.arc_length(end)?)?.position;
        let tassel = line(at.into(), [at.x, at.y - 0.5, at.z], cord()).elements(2).integrator(rate_480());
        let rope = s.rope(tassel.damping(Damping { axial: 1e-4, bending: 0.0 }), End::Free, End::Free)?;
        debug_assert!(k < hung);
        if let super::stage::Strand::Cable(handle) = s.strands[rope] {
            s.set.join((first, end), (handle, At::Start))?;
        }
    }
    Ok(())
}
