//! The mean of quadratic drag over a step.
//!
//! # Equation
//!
//! ```text
//! m w_i' = f_i - c_i |w| w_i,   with |w| that of the mean of the step:   l_i = c_i |w^|/m
//! w^_i = f_i/(m l_i) + (w_i - f_i/(m l_i)) (1 - exp(-l_i h))/(l_i h),    |w^| its length,    drag = -c_i |w^| w^_i
//! ```
//!
//! Where that would do work on the body over its actual motion in the step, of mean velocity
//! w + (f + drag) h/2m, drag is that of this mean velocity (implicit midpoint).
//!
//! w is the velocity relative to the water at the beginning of the step, f the other forces less m
//! u'. The equation in |w^| is solved by geometric means.
//!
//! # Validity
//!
//! Exact at a terminal velocity, whatever the step; of second order elsewhere. Without f the
//! velocity at the end has the sign of that at the beginning. The work is never positive.
//!
//! # References
//!
//! Exponential integrators: Hochbruck & Ostermann 2010.
//!
//! # Alternatives considered
//!
//! The force at the beginning: unstable beyond c |w| h/m = 2. The closed solution without f alone,
//! w/(1 + c |w| h/m): off by that share at a terminal velocity.

use crate::scales::water::{DRAG_ROUNDS, SERIES};
use ::nalgebra::Vector3;

/// Returns the mean drag (N, or N m) over a step of `h` (s): mass by axis, c by axis, velocity, and
/// other forces.
pub fn mean_drag(
    mass: &Vector3<f64>,
    coefficient: &Vector3<f64>,
    velocity: &Vector3<f64>,
    force: &Vector3<f64>,
    h: f64,
) -> Vector3<f64> {
    let gained = force.component_div(mass) * h;
    let mut speed = velocity.norm().max(0.5 * gained.norm());
    if speed == 0.0 || *coefficient == Vector3::zeros() {
        return Vector3::zeros();
    }
    let mut mean = Vector3::zeros();
    for _ in 0..DRAG_ROUNDS {
        mean = Vector3::from_fn(|i, _| {
            let z = coefficient[i] * speed * h / mass[i];
            let [once, twice] = means(z);
            velocity[i] * once + gained[i] * twice
        });
        let next = (speed * mean.norm()).sqrt();
        let settled = (next - speed).abs() <= 4.0 * f64::EPSILON * speed;
        speed = next;
        if settled || speed == 0.0 {
            break;
        }
    }
    let drag = -coefficient.component_mul(&mean) * speed;
    let actual = velocity + 0.5 * (gained + drag.component_div(mass) * h);
    if drag.dot(&actual) <= 0.0 { drag } else { midpoint(mass, coefficient, &(velocity + 0.5 * gained), h) }
}

/// Returns the drag (N, or N m) at the mean velocity of a step: `free` is that without drag.
pub fn midpoint(mass: &Vector3<f64>, coefficient: &Vector3<f64>, free: &Vector3<f64>, h: f64) -> Vector3<f64> {
    let (mut speed, mut mean) = (free.norm(), *free);
    for _ in 0..DRAG_ROUNDS {
        mean = Vector3::from_fn(|i, _| free[i] / (1.0 + 0.5 * coefficient[i] * speed * h / mass[i]));
        let next = (speed * mean.norm()).sqrt();
        let settled = (next - speed).abs() <= 4.0 * f64::EPSILON * speed;
        speed = next;
        if settled || speed == 0.0 {
            break;
        }
    }
    -coefficient.component_mul(&mean) * speed
}

/// Returns (1 - exp(-z))/z and (z - 1 + exp(-z))/z^2: the mean of what decays, and of what grows
/// from zero at rate 1.
fn means(z: f64) -> [f64; 2] {
    if z < SERIES {
        [1.0 - z * (0.5 - z * (1.0 / 6.0 - z / 24.0)), 0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z / 120.0))]
    } else {
        let decayed = -libm::expm1(-z);
        [decayed / z, (z - decayed) / (z * z)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: Vector3<f64> = Vector3::new(1.0, 1.0, 1.0);

    /// *Source.* The terminal velocity sqrt(f/c).
    #[test]
    fn drag_at_a_terminal_velocity_balances_the_force_at_any_step() {
        for h in [1e-3, 0.1, 10.0] {
            let force = Vector3::new(0.0, -8.0, 0.0);
            let drag = mean_drag(&(ONE * 0.3), &(ONE * 2.0), &Vector3::new(0.0, -2.0, 0.0), &force, h);
            assert!((drag + force).norm() < 1e-12, "{h} {drag}");
        }
    }

    /// *Source.* Drag alone cannot reverse a velocity, nor make energy.
    #[test]
    fn drag_reverses_no_velocity_and_makes_no_energy_at_any_step() {
        for mass in [1e-6, 1e-2, 1.0] {
            for c in [1e-3, 1.0, 1e5] {
                let (v, axes) = (Vector3::new(3.0, -0.2, 7.0), Vector3::new(c, 0.1 * c, 2.0 * c));
                let drag = mean_drag(&(ONE * mass), &axes, &v, &Vector3::zeros(), 0.1);
                let after = v + drag * 0.1 / mass;
                for i in 0..3 {
                    // but for the rounding of the sum above
                    let left = after[i] / v[i];
                    assert!((-2.0 * f64::EPSILON..=1.0).contains(&left), "{mass} {c} {after}");
                }
            }
        }
    }

    /// *Source.* The work of drag over the motion with its constant mean force.
    #[test]
    fn drag_does_no_work_on_a_body_that_a_force_turns_round() {
        for force in [1.0, 30.0, 1e3, 1e5] {
            for c in [0.01, 1.0, 100.0] {
                let (v, f) = (Vector3::new(-20.0, 1.0, 0.0), Vector3::new(force, 0.0, -0.1 * force));
                let drag = mean_drag(&(ONE * 0.25), &(ONE * c), &v, &f, 0.1);
                let mean = v + 0.5 * 0.1 / 0.25 * (f + drag);
                assert!(drag.dot(&mean) <= 1e-9 * drag.norm() * mean.norm(), "{force} {c} {drag} {mean}");
            }
        }
    }

    /// *Source.* v(t) = v_T tanh(g t/v_T), and v_0/(1 + c v_0 t/m) without a force.
    #[test]
    fn the_error_of_a_fall_is_of_second_order() {
        let fall = |steps: u32| {
            let (h, mut v) = (1.0 / f64::from(steps), Vector3::zeros());
            for _ in 0..steps {
                let force = Vector3::new(0.0, -9.81, 0.0);
                v += (force + mean_drag(&ONE, &(ONE * 0.7), &v, &force, h)) * h;
            }
            let terminal = (9.81f64 / 0.7).sqrt();
            (v.y + terminal * (9.81 / terminal).tanh()).abs()
        };
        let (coarse, fine) = (fall(20), fall(40));
        assert!(fine < 1e-3 && (coarse / fine).log2() > 1.8, "{coarse:e} {fine:e}");
    }
}
