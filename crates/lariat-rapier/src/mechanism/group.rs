//! The operational-space inertia of all bodies of a mechanism that cables act on.
//!
//! # Equation
//! ```text
//! L = (W + e S)^-1      L x'' = f + L a0
//! part of forces that moves the bodies:      f' = L W f
//! impulses implied by velocity residuals:    p = D W D dv,   D = (W + c S)^-1
//! ```
//! W is the mobility of the bodies in their mechanism, S that of each alone, a0 their accelerations
//! by the loads on the other bodies, less e S g; all with six rows per body. The term e S makes a
//! body as good as immovable along what its joints hold, without a singular matrix; g are the loads
//! on the bodies in the last step, their cables' included, so that along what joints hold only a
//! change of load moves them: L x'' = f gives (W + e S) f, less e S g.
//!
//! Without g the prediction yields by e S f h^2/2 in each step, joints take it back, and the cable
//! feels a jolt at each step: a rope of T = 50 ms on seven welded links read 2 % too little,
//! steadily, one on thirteen 13 %, with bodies that stood still. The reaction estimate is no part
//! of g: along what joints hold, nothing else takes back what it learnt.
//!
//! # Validity
//! With c = e, near a singular configuration (a straight arm with free elbows moves along itself
//! only by its bends; W is of the order of e there), an error of a joint of 1e-6 m reads as 1e3 N:
//! such an arm, once struck, blew up within ten steps. Therefore c is [`ISOLATED_COMPLIANCE`] for a
//! mechanism that touches nothing. 0.01 works as well; with 1e-3 one of six runs failed.
//!
//! # References
//! Khatib 1987, the operational space inertia; Chang & Khatib 2000, of several points.

use super::of_body::Mechanism;
use crate::body::spatial::stack_spatial;
use crate::scales::mechanism::{ISOLATED_COMPLIANCE, JOINT_COMPLIANCE};
use ::nalgebra::{DMatrix, DVector, Matrix6, UnitQuaternion, Vector6};
use lariat_ancf::island::{CoupledInertia, RigidBody};

/// The members of an island that are bodies of one mechanism.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// Indices of the members. The mechanism of the first holds the loads on the other bodies.
    pub members: Vec<usize>,
    /// Half of the step in s.
    half_step: f64,
    /// W.
    mobility: DMatrix<f64>,
    /// S.
    own: DMatrix<f64>,
    /// L.
    inertia: DMatrix<f64>,
    /// a0.
    pub acceleration: DVector<f64>,
}

/// A member that joints hold.
pub(crate) struct Jointed<'a> {
    /// Its index.
    pub member: usize,
    pub body: &'a RigidBody,
    pub mechanism: &'a Mechanism,
    /// g: force and torque on it in the last step, without its reaction estimate.
    pub load: Vector6<f64>,
}

/// Returns the inertia of a body alone, in world axes.
pub(crate) fn own_inertia(body: &RigidBody) -> Matrix6<f64> {
    inertia_in(body, 0.0)
}

/// Returns the inertia of a body alone after a time (s) of the present motion.
fn inertia_in(body: &RigidBody, time: f64) -> Matrix6<f64> {
    let mut inertia = Matrix6::identity() * body.mass;
    inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&body.world_inertia(&attitude_in(body, time)));
    inertia
}

/// Returns the attitude of a body after a time (s) of the present motion.
fn attitude_in(body: &RigidBody, time: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(body.angular_velocity * time) * body.rotation
}

impl Group {
    /// Returns the group of members of one mechanism; `None` if a matrix is singular or not finite.
    pub fn new(members: &[Jointed], half_step: f64) -> Option<Self> {
        let n = 6 * members.len();
        let (mut mobility, mut own) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        let mut acceleration = DVector::zeros(n);
        for (a, Jointed { body, mechanism, load, .. }) in members.iter().enumerate() {
            let alone = inertia_in(body, half_step).try_inverse()?;
            own.fixed_view_mut::<6, 6>(6 * a, 6 * a).copy_from(&alone);
            let yields = alone * load * JOINT_COMPLIANCE;
            acceleration.fixed_rows_mut::<6>(6 * a).copy_from(&(mechanism.loads.of_body - yields));
            for (b, other) in members.iter().enumerate() {
                let mobility_of = mechanism.mobility_of(other.mechanism.handle)?;
                mobility.fixed_view_mut::<6, 6>(6 * b, 6 * a).copy_from(&mobility_of);
            }
        }
        let mobility = (&mobility + mobility.transpose()) * 0.5;
        let inertia = (&mobility + &own * JOINT_COMPLIANCE).try_inverse()?;
        let inertia = (&inertia + inertia.transpose()) * 0.5;
        let load = &inertia * &acceleration;
        let finite = inertia.iter().chain(load.iter()).all(|x| x.is_finite());
        let members = members.iter().map(|jointed| jointed.member).collect();
        finite.then_some(Group { members, half_step, mobility, own, inertia, acceleration })
    }

    /// Returns the number of a member in the group.
    pub fn place(&self, member: usize) -> Option<usize> {
        self.members.iter().position(|m| *m == member)
    }

    /// Returns the block of a matrix for two members, by their numbers in the group.
    fn block(matrix: &DMatrix<f64>, a: usize, b: usize) -> Matrix6<f64> {
        matrix.fixed_view::<6, 6>(6 * a, 6 * b).into_owned()
    }

    /// Gives the bodies of all members the inertia and the loads of what they carry, and adds what
    /// couples them.
    pub fn load(&self, bodies: &mut [RigidBody], coupled: &mut Vec<CoupledInertia>) {
        let loads = &self.inertia * &self.acceleration;
        for (a, &m) in self.members.iter().enumerate() {
            let body = &mut bodies[m];
            body.carried = Some(Self::block(&self.inertia, a, a) - inertia_in(body, self.half_step));
            body.carried_at = Some(attitude_in(body, self.half_step));
            for x in 0..3 {
                body.force[x] += loads[6 * a + x];
                body.torque[x] += loads[6 * a + 3 + x];
                body.turning_torque[x] += loads[6 * a + 3 + x];
            }
            for (b, &other) in self.members.iter().enumerate().skip(a + 1) {
                coupled.push(CoupledInertia { bodies: [m, other], matrix: Self::block(&self.inertia, a, b) });
            }
        }
    }

    /// Stacks a vector of each member, in their order.
    pub fn stack_of(&self, vectors: impl Iterator<Item = Vector6<f64>>) -> DVector<f64> {
        let mut stacked = DVector::zeros(6 * self.members.len());
        vectors.enumerate().for_each(|(a, vector)| stacked.fixed_rows_mut::<6>(6 * a).copy_from(&vector));
        stacked
    }

    /// Returns L times changes of velocity: the impulses that cause them.
    pub fn impulses(&self, changes: &DVector<f64>) -> DVector<f64> {
        &self.inertia * changes
    }

    /// Returns the part of forces and torques that moves the bodies; joints hold against the rest.
    pub fn unconstrained_part(&self, loads: &DVector<f64>) -> DVector<f64> {
        &self.inertia * (&self.mobility * loads)
    }

    /// Returns twice the energy in J that impulses give the bodies.
    pub fn square(&self, impulses: &DVector<f64>) -> f64 {
        impulses.dot(&(&self.mobility * impulses)) + JOINT_COMPLIANCE * impulses.dot(&(&self.own * impulses))
    }

    /// Returns the impulses implied by velocity residuals. `isolated`: the mechanism touches no
    /// other body.
    pub fn implied_impulses(&self, residuals: &DVector<f64>, isolated: bool) -> DVector<f64> {
        let compliance = if isolated { ISOLATED_COMPLIANCE } else { JOINT_COMPLIANCE };
        match (&self.mobility + &self.own * compliance).try_inverse() {
            Some(inertia) => &inertia * (&self.mobility * (&inertia * residuals)),
            None => DVector::zeros(residuals.len()),
        }
    }
}

/// Returns the velocity and the angular velocity of a body as one vector.
pub(crate) fn velocity_of(body: &RigidBody) -> Vector6<f64> {
    stack_spatial(&body.velocity, &body.angular_velocity)
}
