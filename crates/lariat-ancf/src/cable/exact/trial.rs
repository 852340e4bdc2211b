//! What Newton's iteration would gain from the exact tangent: steps with it, by a dense L U, beside the steps as they are.

use super::super::equations::Equations;
use super::super::kernel_effects::Rates;
use super::super::projection::project_vector;
use super::add_elements;
use crate::integrate::Stage;
use crate::*;
use nalgebra::{DMatrix, DVector, Dyn, LU};
use std::cell::{Cell, RefCell};

thread_local! {
    static ON: Cell<bool> = const { Cell::new(false) };
    static FACTORS: RefCell<Option<LU<f64, Dyn, Dyn>>> = const { RefCell::new(None) };
}

/// Whether this thread steps with the exact tangent.
pub(in super::super) fn on() -> bool {
    ON.get()
}

/// The increment of a stage by the exact tangent, factored anew if `fresh`.
pub(in super::super) fn increment(
    equations: &mut Equations<'_>,
    stage: &Stage,
    q: &[f64],
    v: &[f64],
    rhs: &mut [f64],
    fresh: bool,
) {
    if fresh {
        let lu = step_matrix(equations, stage, q, v).lu();
        FACTORS.with(|factors| *factors.borrow_mut() = Some(lu));
    }
    project_vector(equations.model, rhs);
    FACTORS.with(|factors| match factors.borrow().as_ref().unwrap().solve(&DVector::from_row_slice(rhs)) {
        Some(x) => rhs.copy_from_slice(x.as_slice()),
        None => rhs.fill(f64::NAN),
    });
}

/// M + c2 (K + rate C), supports in place.
fn step_matrix(equations: &Equations<'_>, stage: &Stage, q: &[f64], v: &[f64]) -> DMatrix<f64> {
    let n = q.len();
    let still = vec![0.0; n];
    let Rates { v, rate } = Rates { v: if v.is_empty() { &still } else { v }, rate: stage.dv_dq };
    let mut a = DMatrix::zeros(n, n);
    add_elements(equations.system, equations.model, stage.time, q, v, [1.0, rate], &mut a);
    a *= stage.c2;
    let (mut unit, mut column) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        unit[i] = 1.0;
        equations.system.multiply_mass(&unit, &mut column);
        unit[i] = 0.0;
        a.column_mut(i).iter_mut().zip(&column).for_each(|(a, m)| *a += m);
    }
    let mut p = DMatrix::identity(n, n);
    for (node, support) in &equations.model.supports {
        let held = support.projector();
        for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
            p[(6 * node + r, 6 * node + c)] = held[c][r];
        }
    }
    &p * a * &p + (DMatrix::identity(n, n) - &p)
}

struct Scene {
    name: &'static str,
    builder: CableBuilder,
    /// Iterations that the exact tangent may save, as a share: from, to.
    game: [f64; 2],
    engineering: [f64; 2],
}

fn scenes() -> Vec<Scene> {
    let line = |diameter: f64, modulus: f64, density: f64, elements: usize, effects: Effects| {
        Cable::builder()
            .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
            .section(Section::round(diameter, modulus, density).unwrap())
            .elements(elements)
            .fix(At::Start)
            .effects(effects)
    };
    let water = |speed: f64| Effects {
        drag: Some(Drag::new(1000.0, 1.2, 0.02, Flow::uniform(Vector3::new(0.3, 0.2, 1.0) * speed))),
        buoyancy: Some(Buoyancy::new(1000.0, 1.0)),
        ..Effects::default()
    };
    let damped = |axial: f64, bending: f64| Effects { damping: Some(Damping { axial, bending }), ..Effects::default() };
    let scene = |name, builder, game, engineering| Scene { name, builder, game, engineering };
    let pendulum = |effects| line(0.01, 1e8, 4000.0, 10, effects);
    let thin = |effects| line(0.002, 1e9, 1500.0, 20, effects);
    let steel = |effects| line(0.01, 2.1e11, 7850.0, 20, effects);
    let rough = Effects { damping: damped(1e-2, 1e-2).damping, ..water(3.0) };
    vec![
        scene("rubber rod in water, 1 m/s", pendulum(water(1.0)), [-0.05, 0.1], [-0.05, 0.1]),
        scene("2 mm line in water, 5 m/s", thin(water(5.0)), [0.0, 0.15], [0.0, 0.05]),
        scene("2 mm line in water, 20 m/s", thin(water(20.0)), [0.2, 0.6], [0.0, 0.05]),
        scene("steel rope in water, 5 m/s", steel(water(5.0)), [0.0, 0.05], [0.0, 0.05]),
        scene("rubber rod, damping 1 ms", pendulum(damped(1e-3, 1e-3)), [0.0, 0.05], [0.0, 0.05]),
        scene("rubber rod, damping 10 ms", pendulum(damped(1e-2, 1e-2)), [-0.05, 0.05], [0.0, 0.1]),
        scene("rubber rod, axial damping 1 s", pendulum(damped(1.0, 0.0)), [0.1, 0.3], [0.1, 0.25]),
        scene("steel rope, damping 1 ms", steel(damped(1e-3, 1e-3)), [-0.05, 0.05], [0.0, 0.2]),
        scene("steel rope, axial damping 1 ms", steel(damped(1e-3, 0.0)), [-0.05, 0.05], [0.0, 0.1]),
        scene("5 mm line, damping 10 ms, 3 m/s", line(0.005, 1e9, 1500.0, 20, rough), [0.2, 0.6], [-0.05, 0.05]),
    ]
}

/// The exact tangent saves a share of Newton's iterations that an unsymmetric factorisation costs more than, but where drag or damping
/// rule the motion. Prints steps, rejected steps, iterations and factorisations in 1 s of each scene.
///
/// *Source.* The same scenes with the derivatives by dual numbers and a dense L U with pivoting.
#[test]
fn exact_tangents_save_few_iterations_of_common_scenes() {
    for scene in scenes() {
        for (fidelity, bounds) in [(Fidelity::Game, scene.game), (Fidelity::Engineering, scene.engineering)] {
            let run = |exact: bool| {
                ON.set(exact);
                let mut cable = scene.builder.clone().fidelity(fidelity).build().unwrap();
                (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
                ON.set(false);
                *cable.diagnostics()
            };
            let (as_is, exact) = (run(false), run(true));
            let show =
                |d: &Diagnostics| [d.steps, d.rejected_steps, d.newton_iterations, d.factorisations].map(|x| x as u32);
            let saved = 1.0 - exact.newton_iterations as f64 / as_is.newton_iterations as f64;
            println!(
                "{:32} {fidelity:?}: {:?}, exact {:?}, saved {:.0} %",
                scene.name,
                show(&as_is),
                show(&exact),
                100.0 * saved
            );
            assert!(saved >= bounds[0] && saved <= bounds[1], "{} {fidelity:?}: {saved}", scene.name);
        }
    }
}
