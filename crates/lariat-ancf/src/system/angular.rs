//! Restoring the momenta that a step of the [discrete
//! gradient](crate::integrate::discrete_gradient) takes from what nothing holds, or one point.
//!
//! # Equation
//!
//! Over a step the method changes the angular momentum by more than the impulses `h F` about the
//! mean configuration,
//!
//! ```text
//! D L = q_m x h F - a D q x M (D v - O v)  (+ reels: means of l' G q and M)
//! ```
//!
//! most of which is a change of `a h v x M D v`, of the second order of the step. It keeps the
//! linear momentum of a cable, but that of an island only as far as the iteration converges,
//! because pinned nodes turn with their bodies. The step ends with velocities
//!
//! ```text
//! v + p + w x (r - c) - u (v - V - W x (r - c))            t' + w x t - u (t' - W x t)
//! m p = P_0 + h F - P_1                   + (what earlier steps owe)
//! I w = L_0 + q_m x h F - L_1 + (what earlier steps owe)      all about the centre of mass c
//! ```
//!
//! Of a system that turns freely about one point at rest, c is that point, and V and p are zero:
//! what holds it has no moment about it.
//!
//! V, W is the rigid motion with the momenta of all. The last term is orthogonal to rigid motions
//! in the norm of the kinetic energy, so momenta stay, and u is what keeps the kinetic energy: the
//! energy law is that of the step, exactly. Energy for p and w comes first from what the method
//! took of the rigid rotation, `a/2 z.I z` with z the rotation in D v - O v: a body that tumbles
//! alone loses angular momentum and energy together; never more than the law of the step leaves,
//! since a residual may have used it. The share that neither covers is owed to the next step.
//!
//! A step that would owe momenta p, L of more than a small share s of the motion is divided: s^2 of
//! the kinetic energy and of the weight times 1 mm, as `p.p/2m + L.I^-1 L/2`. In parts of a quarter
//! a sixteenth is missing, and the energy beside the rigid motion pays for it four times.
//!
//! # Validity
//!
//! Without supports but, of an island with bodies that move, one that holds a node, not its slope,
//! at rest, or one such hold of a driven body; without locked bodies, bodies that carry others,
//! contact with obstacles, stock outside of the system, or bodies without gyroscopic torque, whose
//! angular momentum is not constant: there nothing is restored. The memory O v is what the
//! equations of motion made, and stays: the law holds for any v at the beginning of a step.
//!
//! # References
//!
//! Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), IV.4: projection on invariants
//! keeps the order.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/elements.md.

use super::{Equations, System, dot, solve_semidefinite};
use crate::one_leg::OneLeg;
use crate::scales::system::LARGEST_SHARE;
use crate::state::State;
use crate::system::step_vectors::{Before, StepVectors};
use crate::term::Balance;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Sums over all cables and bodies.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Momenta {
    /// The one point that is held, at rest, if there is one.
    pivot: Option<Vector3<f64>>,
    mass: f64,
    /// Sum of mass times place.
    first: Vector3<f64>,
    /// Sum of mass times place times place, about the origin; the inertia of bodies about their
    /// centres.
    second: Matrix3<f64>,
    inertia: Matrix3<f64>,
    /// Momentum and angular momentum about the origin: of M v, and with what flows.
    own: [Vector3<f64>; 2],
    all: [Vector3<f64>; 2],
    /// `v.M v`, and v times the momentum with what flows.
    squares: [f64; 2],
    /// Momentum and angular momentum about the origin of the second difference of velocities.
    second_difference: [Vector3<f64>; 2],
}

/// What restores momenta after a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Restoration {
    pub turn: Turn,
    /// The momenta after it.
    pub after: Before,
    /// What is owed to the next step.
    pub owed: [f64; 6],
}

/// A change of velocities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    centre: Vector3<f64>,
    /// p.
    push: Vector3<f64>,
    /// w.
    pub spin: Vector3<f64>,
    /// u.
    pub share: f64,
    /// V and W.
    rigid: [Vector3<f64>; 2],
}

fn vector(x: &[f64]) -> Vector3<f64> {
    Vector3::new(x[0], x[1], x[2])
}

/// Adds the sum of impulses or momenta `p`, and of their moments about the origin.
fn add_sums(sums: &mut [Vector3<f64>; 2], q: &[f64], p: &[f64]) {
    for (q, p) in q.chunks_exact(6).zip(p.chunks_exact(6)) {
        sums[0] += vector(p);
        sums[1] += vector(q).cross(&vector(p)) + vector(&q[3..]).cross(&vector(&p[3..]));
    }
}

/// Returns impulse and angular impulse about the origin of the forces without potential of an
/// iterate.
pub(crate) fn outside_impulses(q: &[f64], b: &StepVectors) -> [Vector3<f64>; 2] {
    let mut sums = [Vector3::zeros(); 2];
    for ((q, d), f) in q.chunks_exact(3).zip(b.change.chunks_exact(3)).zip(b.external.chunks_exact(3)) {
        sums[1] += (vector(q) + 0.5 * vector(d)).cross(&vector(f));
    }
    b.external.chunks_exact(6).for_each(|f| sums[0] += vector(f));
    sums.map(|sum| sum * b.h)
}

impl Momenta {
    /// Those of a system that nothing holds, or that turns freely about a point at rest.
    pub fn about(pivot: Option<Vector3<f64>>) -> Self {
        Momenta { pivot, ..Momenta::default() }
    }

    /// Adds the second difference of the velocities of a cable in a step that ends at `q`.
    pub fn add_second_difference(&mut self, system: &System, q: &[f64], b: &mut StepVectors) {
        let StepVectors { velocity_change, velocity_before, external, product, .. } = b;
        external.clear();
        external.extend(velocity_change.iter().zip(&*velocity_before).map(|(d, o)| d - o));
        system.mass.multiply(system.level, external, product);
        add_sums(&mut self.second_difference, q, product);
    }

    /// Adds that of a body.
    pub fn add_second_difference_of_body(&mut self, place: &Vector3<f64>, [p, l]: [Vector3<f64>; 2]) {
        self.second_difference[0] += p;
        self.second_difference[1] += place.cross(&p) + l;
    }

    /// Adds a cable at a time, with its coordinates and velocities.
    pub fn add_cable(
        &mut self,
        equations: &mut Equations<'_>,
        (time, [at, velocities]): (f64, [&[f64]; 2]),
        b: &mut StepVectors,
    ) {
        let (model, system) = (equations.model, &mut *equations.system);
        let StepVectors { product: p, external: full, .. } = b;
        p.resize(at.len(), 0.0);
        full.resize(at.len(), 0.0);
        if !system.feeds.is_empty() {
            system.set_feeds(model, time);
        }
        system.mass.multiply(system.level, at, p);
        for (q, p) in at.chunks_exact(6).zip(p.chunks_exact(6)) {
            self.first += vector(p);
            self.second += vector(q) * vector(p).transpose() + vector(&q[3..]) * vector(&p[3..]).transpose();
        }
        self.mass += system.mass.total();
        self.squares[0] += system.mass_square(velocities, p);
        full.copy_from_slice(p);
        if !system.feeds.is_empty() {
            system.add_feed_momentum(model, time, at, full);
        }
        self.squares[1] += dot(velocities, full);
        add_sums(&mut self.own, at, p);
        add_sums(&mut self.all, at, full);
    }

    /// Adds a body of this mass and inertia in world axes.
    pub fn add_body(&mut self, mass: f64, inertia: &Matrix3<f64>, place: &Vector3<f64>, [v, spin]: [Vector3<f64>; 2]) {
        self.mass += mass;
        self.first += place * mass;
        self.second += place * place.transpose() * mass;
        self.inertia += inertia;
        let (p, own) = (v * mass, inertia * spin);
        for sums in [&mut self.own, &mut self.all] {
            sums[0] += p;
            sums[1] += place.cross(&p) + own;
        }
        self.squares.iter_mut().for_each(|x| *x += v.dot(&p) + spin.dot(&own));
    }

    /// Returns the point about which moments are taken: the one that is held, else the centre of
    /// mass.
    fn centre(&self) -> Vector3<f64> {
        self.pivot.unwrap_or(self.first / self.mass)
    }

    /// Returns the linear momentum, the angular momentum about the [centre](Self::centre), and
    /// this.
    pub fn before(&self) -> Before {
        [self.all[0], self.angular()[1], self.centre()]
    }

    /// Returns the angular momentum about the [centre](Self::centre), of M v and with what flows.
    fn angular(&self) -> [Vector3<f64>; 2] {
        [self.own, self.all].map(|[p, l]| l - self.centre().cross(&p))
    }

    /// Returns the angular velocity with an angular momentum about the [centre](Self::centre).
    fn spin_of(&self, angular: &Vector3<f64>) -> Vector3<f64> {
        let of = |second: &Matrix3<f64>| Matrix3::identity() * second.trace() - second;
        let c = self.centre();
        let shifted = self.first * c.transpose() + c * self.first.transpose() - c * c.transpose() * self.mass;
        let inertia = of(&self.second) - of(&shifted) + self.inertia;
        let mut all = Matrix6::zeros();
        all.fixed_view_mut::<3, 3>(0, 0).copy_from(&(0.5 * (inertia + inertia.transpose())));
        let mut rhs = Vector6::zeros();
        rhs.fixed_rows_mut::<3>(0).copy_from(angular);
        solve_semidefinite(&mut all, rhs).fixed_rows::<3>(0).into_owned()
    }

    /// Returns the change of velocities that restores the momenta: with those when the step began,
    /// impulse and angular impulse about the origin of the forces since then, and what earlier
    /// steps owe.
    pub fn restore(
        &self,
        mut owed: [f64; 6],
        ([momentum, before, centre], [force, moment]): (Before, [Vector3<f64>; 2]),
        (leg, balance): (OneLeg, &mut Balance),
    ) -> Restoration {
        let [own, all] = self.angular();
        let middle = 0.5 * (centre + self.centre());
        let missing = before + moment - middle.cross(&force) - all + vector(&owed[3..]);
        // what holds a point gives and takes momentum, but no angular momentum about it
        let held = self.pivot.is_some();
        let lost = if held { Vector3::zeros() } else { momentum + force - self.all[0] + vector(&owed) };
        let [p, l] = self.second_difference;
        let second = l - self.centre().cross(&p);
        let ([p, _], [with_feed, _]) = (self.own, self.all);
        let (velocity, spin) = (if held { Vector3::zeros() } else { p / self.mass }, self.spin_of(&own));
        let mut turn = Turn {
            centre: self.centre(),
            push: lost / self.mass,
            spin: self.spin_of(&missing),
            share: 0.0,
            rigid: [velocity, spin],
        };
        // kinetic energy beside the rigid motion, and its velocities times all momenta
        let energy = (0.5 * (self.squares[0] - velocity.dot(&p) - spin.dot(&own))).max(0.0);
        let product = self.squares[1] - velocity.dot(&with_feed) - spin.dot(&all);
        let taken = 0.5 * leg.a * second.dot(&self.spin_of(&second));
        let wanted = turn.spin.dot(&(all + 0.5 * missing)) + turn.push.dot(&(with_feed + 0.5 * lost));
        let given = wanted.clamp(0.0, taken.min(balance.numerical).min(-balance.excess()).max(0.0));
        let most = LARGEST_SHARE * (product - LARGEST_SHARE * energy);
        let available = given + most.max(0.0);
        if wanted > available {
            let part = available / wanted;
            turn.push *= part;
            turn.spin *= part;
            for (owed, own) in owed.iter_mut().zip(lost.iter().chain(&missing)) {
                *owed = own * (1.0 - part);
            }
        } else {
            owed = [0.0; 6];
        }
        let left = wanted.min(available) - given;
        let root = (product * product - 4.0 * energy * left).max(0.0).sqrt();
        if product > 0.0 {
            turn.share = (2.0 * left / (product + root)).clamp(-LARGEST_SHARE, LARGEST_SHARE);
        }
        balance.numerical -= given;
        let covered = turn.share * (product - turn.share * energy);
        balance.rescaled += (covered - left).max(0.0);
        let after = [with_feed + lost - vector(&owed), all + missing - vector(&owed[3..]), self.centre()];
        Restoration { turn, after, owed }
    }

    /// Returns the share of all motion that momenta are: the root of the kinetic energy of the
    /// rigid motion with them, over that of the system and `least` (J).
    pub fn share_of(&self, momenta: &[f64; 6], least: f64) -> f64 {
        let (p, l) = (vector(momenta), vector(&momenta[3..]));
        let energy = 0.5 * (p.norm_squared() / self.mass + l.dot(&self.spin_of(&l)));
        (energy / (0.5 * self.squares[0] + least)).max(0.0).sqrt()
    }
}

impl Turn {
    /// Changes the velocities of a cable at its present state.
    pub fn turn_cable(&self, state: &mut State) {
        let [velocity, spin] = self.rigid;
        let change = self.spin + self.share * spin;
        for (q, v) in state.q.chunks_exact(6).zip(state.v.chunks_exact_mut(6)) {
            let position = self.push + self.share * velocity + change.cross(&(vector(q) - self.centre));
            let slope = change.cross(&vector(&q[3..]));
            for x in 0..3 {
                v[x] += position[x] - self.share * v[x];
                v[3 + x] += slope[x] - self.share * v[3 + x];
            }
        }
    }

    /// Returns the velocity and spin of a body.
    pub fn of_body(&self, place: &Vector3<f64>, [v, w]: [Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
        let [velocity, spin] = self.rigid;
        let change = self.spin + self.share * spin;
        [
            v + self.push + self.share * (velocity - v) + change.cross(&(place - self.centre)),
            w + change - self.share * w,
        ]
    }
}
