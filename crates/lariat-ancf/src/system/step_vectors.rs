//! The buffers of a step of the [discrete gradient](crate::integrate::discrete_gradient).

use crate::contact::ContactStep;
use crate::one_leg::OneLeg;
use crate::state::State;
use nalgebra::Vector3;

/// Linear momentum, angular momentum about the centre of mass or the point that is held, and this.
pub(crate) type Before = [Vector3<f64>; 3];

/// Vectors of a step, with as many numbers as there are coordinates; empty until the method is
/// used.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepVectors {
    /// Length of the step in s.
    pub h: f64,
    /// Formula of the step.
    pub leg: OneLeg,
    /// Change of velocities in the step before, O v.
    pub velocity_before: Vec<f64>,
    /// Change of coordinates in the step before.
    pub change_before: Vec<f64>,
    /// Share of it that counts.
    pub kept: f64,
    /// Whether it is a part of a step that was divided.
    pub divided: bool,
    /// Change of velocities D v of the present iterate.
    pub velocity_change: Vec<f64>,
    /// Change of coordinates D q of the present iterate.
    pub change: Vec<f64>,
    /// D q of the iterate about which the last linear solve was made; empty before the first.
    pub linearised: Vec<f64>,
    /// What is taken from the velocities at the end, if the step makes energy; else empty.
    pub taken: Vec<f64>,
    /// What contacts take from the velocities at the end, and from their changes; else empty.
    pub landed: Vec<f64>,
    /// Minus the residual.
    pub rhs: Vec<f64>,
    /// Forces without potential.
    pub external: Vec<f64>,
    /// Mean coordinates and velocities of the present iterate, and of the one about which it was
    /// linearised.
    pub means: [Vec<f64>; 4],
    /// Energy in J that contacts with obstacles lose.
    pub lost: f64,
    /// Energy in J that damping takes.
    pub damped: f64,
    /// Work of point loads in the present iterate in J.
    pub load_work: f64,
    /// Any product.
    pub product: Vec<f64>,
    /// Contacts.
    pub contact: ContactStep,
    /// Impulses of contacts with cables; empty without any.
    pub pair_impulses: Vec<f64>,
    /// Impulses of terms that have evaluated them before; empty without any.
    pub term_impulses: Vec<f64>,
    /// Where nothing holds the cable, or one point, the momenta when the step begins.
    pub before: Option<Before>,
    /// The one point at rest that is held, in the first cable.
    pub pivot: Option<Vector3<f64>>,
    /// Those of the end of the step before, if it was in the same host step.
    pub after: Option<Before>,
    /// Impulse and angular impulse about the origin of the forces without potential, if they are
    /// asked for.
    pub outside: Option<[Vector3<f64>; 2]>,
}

impl StepVectors {
    /// Takes up the memory of `state` for a step of length `h` (s) with a formula, and
    /// predicts its changes by a constant acceleration.
    ///
    /// After a longer step the changes are scaled down to the length of this one, which only loses
    /// energy of the store; after a shorter one they stay.
    pub fn recall(&mut self, state: &State, h: f64, leg: OneLeg) {
        let differences = &state.memory.differences;
        let size = state.q.len();
        (self.h, self.leg) = (h, leg);
        self.kept = leg.share_kept((differences.dissipation, differences.step), h);
        self.velocity_before.clear();
        self.velocity_before.extend(differences.velocity.iter().map(|x| self.kept * x));
        self.velocity_before.resize(size, 0.0);
        self.change_before.clone_from(&differences.displacement);
        self.change_before.resize(size, 0.0);
        for own in [&mut self.rhs, &mut self.external, &mut self.product] {
            own.resize(size, 0.0);
        }
        self.linearised.clear();
        self.pair_impulses.clear();
        self.term_impulses.clear();
        self.taken.clear();
        self.landed.clear();
        self.velocity_change.clone_from(&self.velocity_before);
        self.change.clear();
        self.change.extend(state.v.iter().zip(&self.velocity_before).map(|(v, before)| h * (v + 0.5 * before)));
    }

    /// Computes the mean coordinates and velocities.
    pub fn find_means(&mut self, q: &[f64]) {
        let rate = 1.0 / self.h;
        let [middle, velocity, middle_before, velocity_before] = &mut self.means;
        let about = if self.linearised.is_empty() { &self.change } else { &self.linearised };
        for (middle, velocity, change) in [(middle, velocity, &self.change), (middle_before, velocity_before, about)] {
            middle.clear();
            middle.extend(q.iter().zip(change).map(|(q, d)| q + 0.5 * d));
            velocity.clear();
            velocity.extend(change.iter().map(|d| rate * d));
        }
    }
}
