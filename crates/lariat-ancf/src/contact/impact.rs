//! Impact: what contacts that push when a step ends leave of the velocity across them.
//!
//! # Equation
//!
//! A step ends with a contact that pushes at the surface, so its mean velocity is the way that was
//! left: of a point that had the part s of the step to go, `v^ = s v0`, and the velocity at the end
//! is `v1 = v0 (1 - (1 - s)/b)`, between `v0` and `-7/9 v0` by chance. It is no rebound, but the
//! root of the one-leg formula. The contacts take it, all at once, by the impulses R on the cable
//! and -R on what it touches:
//!
//! ```text
//! (S + sum G) w = sum (G (v1 - u n) + l f_t/f_n)      v1 <- v1 - w,   D v <- D v - w
//! G = b h^2 (w p' n n^T + T)                          l = b h^2 w p' (n . (v1 - w) - u) <= h f_n
//! -R = G (v1 - w - u n) + l f_t/f_n                   the last term only where it slips
//! ```
//!
//! v1 is relative to the obstacle, `u = e max(0, -n . v0)` what Newton's coefficient of restitution
//! e leaves of the velocity v0 with which a contact came, until it comes again. Where a step does
//! not resolve the touch ([`rebound`](super::rebound)) an impact also gives what lacks of u until
//! it leaves, with the velocity at the beginning of the step if that is less; then it only takes
//! what is more, so that what lies stays. Without restitution u is what the law lets come up, where
//! the step resolves that, else 0. What G is too soft to give, or where u > 0 to take but for 1
//! cm/s, is added to R and solved for again (augmented Lagrangian), until it changes by 1e-3. T is
//! the tangent of friction, S the step matrix without contacts; the sum is the matrix that the last
//! iteration factored. So an impulse spreads through cable and bodies as those of the step did. On
//! bodies, normals and levers are those of the matrix, at three quarters of the step: with others
//! the impulse, a difference of large products, would spin a ball that has no friction. Where a
//! contact slips, the friction of the impulse that is taken back goes with it, with l of a first
//! solve. `G/m` is `b (h omega)^2` with the frequency omega of the contact: the velocity of
//! contacts that a step does not resolve is taken at once.
//!
//! The energy of motion and of the store change by
//!
//! ```text
//! D H = -s P + s^2 E,     P = w . M (v1 + a D v),   E = (1 + a)/2 w . M w,   W = sum R . v_o
//! ```
//!
//! where the share s is 1, or the largest for which `D H <= s W + lost`: an impact makes no energy
//! but the work W of obstacles that move, and what contacts lost in the step itself, since friction
//! of what is taken back did not act; one that gives velocity may also use what the step lost
//! numerically. So H does not rise over the step. Momentum is kept, since the impulses on cable and
//! body are opposite and on one line.
//!
//! # Validity
//!
//! Restitution up to `(1 - a)/(1 + a) = 15/17`: with more a mass that leaves has more of H than it
//! came with, for H holds the store of its jump of velocity, `a/2 m (1 + e)^2 v0^2`, too. Steps of
//! which the velocity across contacts has less energy than the tolerance of the law take none,
//! and do no work for it.
//!
//! # References
//!
//! Gear, Leimkuhler & Gupta, J. Comput. Appl. Math. 12 (1985) 77 (constraints of velocities beside
//! those of positions); Moreau, in Nonsmooth Mechanics and Applications, 1988 (inelastic impact as
//! a projection, Newton's law of restitution); Simo & Laursen, Comput. Struct. 42 (1992) 97
//! (augmented Lagrangian).
//!
//! # Alternatives considered
//!
//! The projection in the norm of the mass alone: it takes the velocity of an element of a bar that
//! lands on its end, and the bar throws it up again.

use super::impulse::Impact;
use super::point::ContactPoint;
use super::step::ContactStep;
use crate::element::assembly::add_force;
use crate::one_leg::OneLeg;
use crate::scales::contact::{GIVEN, RESOLVED, RISE, SLOW};
use nalgebra::Vector3;

/// An end of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum When {
    Begin,
    End,
}

impl ContactPoint {
    /// Returns whether it pushes at the end of the step, and did when the last matrix was made.
    pub fn may_leave(&self) -> bool {
        self.now.normal_force > 0.0 && self.linear.slope > 0.0
    }

    /// Forgets the impact of the last step.
    pub fn clear_impact(&mut self) {
        self.impact.gain = 0.0;
    }

    /// Finds its impact along a normal, at a velocity beside an obstacle with a velocity of its own
    /// (m/s), and returns the energy in J of what it opposes: 0 if it does not leave. `came` is the
    /// speed across it when the step began, 0 without restitution; `h` is the length of the step,
    /// `mass` that per length.
    pub fn find_impact(
        &mut self,
        normal: Vector3<f64>,
        [beside, obstacle]: [Vector3<f64>; 2],
        came: f64,
        (h, leg, mass): (f64, OneLeg, f64),
    ) -> f64 {
        let (linear, weight) = (&self.linear, self.weight);
        let across = normal.dot(&beside);
        let (mut rebound, mut gives) = (0.0, false);
        if self.restitution > 0.0 {
            self.came = if self.touched { self.came } else { came };
            // one that presses on gives no more than what it comes with in this step
            let least = self.restitution * came.min(self.came);
            gives = across < least && !self.is_resolved(h, self.came.abs());
            rebound = if gives { least } else { self.restitution * self.came.abs() };
            self.came = if across > 0.0 { -self.came.abs() } else { self.came.max(0.0) };
        } else if self.rebound.is_bound() {
            // what a step resolves comes up by itself
            let depth = self.now.depth + self.offset - self.closing;
            let speed = if self.speed > 0.0 { self.speed_after(h) } else { 0.0 };
            let returns = self.returns(depth, speed);
            rebound = if h * returns < RESOLVED * depth { RISE * returns } else { 0.0 };
        }
        let over = across - rebound;
        if over <= 0.0 && !gives {
            return 0.0;
        }
        let scale = leg.b * h * h;
        let (gain, friction) = (scale * weight * linear.slope, linear.tangents.friction * scale);
        let mut impact =
            Impact { obstacle, beside, normal, rebound, gives, given: 0.0, gain, friction, row: Vector3::zeros() };
        impact.row = impact.gained(&beside) - normal * (gain * rebound);
        self.impact = impact;
        0.5 * mass * weight * over * over
    }

    /// Sets its impulse to that of the velocity that is left if `taken` is taken (m/s), by the
    /// `first` solve or another one; returns whether one more sees more of it: what G is too soft
    /// for, the friction of what is taken back, or that a contact does not pull.
    pub fn settle_impact(&mut self, taken: &Vector3<f64>, h: f64, first: bool) -> bool {
        let (now, impact) = (&self.now, &mut self.impact);
        let left = impact.beside - taken;
        let over = impact.normal.dot(&left) - impact.rebound;
        let (wanted, most) = (impact.gain * over, h * now.normal_force);
        let is_bound = self.restitution > 0.0 || impact.rebound > 0.0;
        let takes_more = is_bound && over > SLOW && impact.given + wanted < most;
        if impact.gives || takes_more {
            let given = impact.given;
            impact.given = (given + wanted).min(most);
            let mut row = impact.normal * (impact.given - impact.gain * impact.rebound);
            if now.slides.is_some() {
                row += now.friction * (impact.given / now.normal_force);
            }
            impact.row = row + impact.gained(&impact.beside);
            return (impact.given - given).abs() > GIVEN * impact.given.abs();
        }
        if !first {
            return false;
        }
        let normal = wanted.clamp(0.0, most);
        let mut impulse = impact.normal * normal + impact.friction * left;
        if now.slides.is_some() {
            impulse += now.friction * (normal / now.normal_force);
        }
        impact.row = impulse + impact.gained(taken);
        now.slides.is_some() || wanted != normal
    }
}

impl ContactStep {
    /// Finds the velocities beside contacts that push, at the end of the step, and returns the
    /// energy in J of those that they oppose. `mass` is that of an element per length, `velocity`
    /// that of a point of an element, `body` that of a body at an arm about its centre, each when
    /// the step begins or ends.
    pub fn find_impacts(
        &mut self,
        mass: impl Fn(usize) -> f64,
        velocity: impl Fn(When, usize, &[f64; 4]) -> Vector3<f64>,
        body: impl Fn(When, usize, &Vector3<f64>) -> Vector3<f64>,
    ) -> f64 {
        let mut energy = 0.0;
        for point in &mut self.points {
            point.clear_impact();
            if point.may_leave() {
                let (element, step, now) = (point.key.0 as usize, &self.obstacles[point.obstacle], &point.now);
                let linear = &point.linear;
                let of_obstacle = |when: When| match step.body {
                    Some(index) => body(when, index, &linear.lever),
                    None => step.velocity_at(&(now.arm + 0.5 * now.slip)),
                };
                let normal = if step.body.is_some() { linear.tangents.across } else { now.normal };
                let (shape, obstacle) = (&point.shape, of_obstacle(When::End));
                let came = if point.restitution > 0.0 {
                    let before = velocity(When::Begin, element, shape) - of_obstacle(When::Begin);
                    (-normal.dot(&before)).max(0.0)
                } else {
                    0.0
                };
                let beside = velocity(When::End, element, shape) - obstacle;
                energy += point.find_impact(normal, [beside, obstacle], came, (self.h, self.leg, mass(element)));
            }
        }
        energy
    }

    /// Returns whether any gives velocity by its restitution.
    pub fn gives_velocity(&self) -> bool {
        self.points.iter().any(|point| point.impact.acts() && point.impact.gives)
    }

    /// Adds what the linear solve sees of them to the rows of the cable, and its opposite to those
    /// of bodies.
    pub fn pass_impacts(&self, rhs: &mut [f64], rows: &mut [f64]) {
        for point in self.points.iter().filter(|point| point.impact.acts()) {
            add_force(rhs, point.key.0 as usize, &point.shape, &point.impact.row);
            if let Some(body) = self.obstacles[point.obstacle].body {
                let angular = point.linear.lever.cross(&point.impact.row);
                for x in 0..3 {
                    rows[6 * body + x] -= point.impact.row[x];
                    rows[6 * body + 3 + x] -= angular[x];
                }
            }
        }
    }

    /// Sets the impulses to those of the velocities that are left; `taken` and `of_body` are the
    /// changes of velocities by the linear solve. Returns whether another solve sees more of them.
    pub fn settle_impacts(
        &mut self,
        taken: impl Fn(usize, &[f64; 4]) -> Vector3<f64>,
        of_body: impl Fn(usize, &Vector3<f64>) -> Vector3<f64>,
        first: bool,
    ) -> bool {
        let mut changed = false;
        for point in self.points.iter_mut().filter(|point| point.impact.acts()) {
            let body = self.obstacles[point.obstacle].body;
            let of_obstacle = body.map_or_else(Vector3::zeros, |index| of_body(index, &point.linear.lever));
            let taken = taken(point.key.0 as usize, &point.shape) - of_obstacle;
            changed |= point.settle_impact(&taken, self.h, first);
        }
        changed
    }

    /// Returns the work W in J of obstacles that move as prescribed; `taken` are the changes of
    /// velocities by the last solve.
    pub fn work_of_impacts(&self, taken: impl Fn(usize, &[f64; 4]) -> Vector3<f64>) -> f64 {
        let pushing = self.points.iter().filter(|point| point.impact.acts());
        let prescribed = pushing.filter(|point| self.obstacles[point.obstacle].driven);
        let work = prescribed.map(|point| {
            let (impact, taken) = (&point.impact, taken(point.key.0 as usize, &point.shape));
            (impact.gained(&taken) - impact.row).dot(&impact.obstacle)
        });
        work.sum()
    }
}
