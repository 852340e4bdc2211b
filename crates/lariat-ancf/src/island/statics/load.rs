//! Loads on bodies that depend on where these are, in statics: as those of water.
//!
//! # Equation
//!
//! A load at the place of a body is a force through its centre of mass and a moment about it. It
//! enters the rows of the body, its negative derivative, made symmetric, the matrix; where it has a
//! potential, that is part of the energy that the search lowers.
//!
//! # Validity
//!
//! Loads that are continuous. One without a potential, as drag, is solved as a flow is: the part of
//! its derivative that is not symmetric makes the iteration linear.

use crate::island::body::RigidBody;
use crate::island::layout::Layout;
use nalgebra::{Matrix6, UnitQuaternion, Vector3};

/// A load on a body at a place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadThere {
    /// Force in N through the centre of mass, world axes.
    pub force: Vector3<f64>,
    /// Moment in N m about it.
    pub moment: Vector3<f64>,
    /// Potential energy in J, whose negative derivative it is; `None` if it has none.
    pub energy: Option<f64>,
}

/// A load on a body that depends on where it is, in statics.
pub trait PlacedLoad: core::fmt::Debug {
    /// Returns it with the centre of mass of the body at `position` (m), and the body at
    /// `rotation`.
    fn at(&self, position: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> LoadThere;

    /// Returns its negative derivative by displacements (m) and rotations (rad) in world axes, in
    /// N/m, N and N m.
    fn stiffness(&self, position: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> Matrix6<f64>;
}

/// The loads on the bodies of an island, with the numbers of these.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Loads<'a>(pub &'a [(usize, &'a dyn PlacedLoad)]);

impl Loads<'_> {
    /// Calls `f` with each load, its body, and the place of that at coordinates `q`.
    fn for_each(
        &self,
        layout: &Layout,
        q: &[f64],
        mut f: impl FnMut(usize, &dyn PlacedLoad, &Vector3<f64>, &UnitQuaternion<f64>),
    ) {
        for &(body, load) in self.0 {
            let own = &q[layout.body_at(body)..];
            f(body, load, &Vector3::from_column_slice(&own[..3]), &layout.attitude(body, own));
        }
    }

    /// Returns whether all have a potential at the places of bodies.
    pub fn have_potential(&self, bodies: &[RigidBody]) -> bool {
        self.0.iter().all(|(body, load)| load.at(&bodies[*body].position, &bodies[*body].rotation).energy.is_some())
    }

    /// Adds them at coordinates `q`, times `scale`, to the rows of the bodies.
    pub fn add(&self, layout: &Layout, q: &[f64], scale: f64, rhs: &mut [f64]) {
        self.for_each(layout, q, |body, load, position, rotation| {
            let LoadThere { force, moment, .. } = load.at(position, rotation);
            let row = &mut rhs[layout.body_at(body)..];
            row.iter_mut().zip(force.iter().chain(&moment)).for_each(|(row, x)| *row += scale * x);
        });
    }

    /// Sets the stiffness at coordinates `q` in the layout.
    pub fn linearise(&self, layout: &mut Layout, q: &[f64]) {
        let mut stiffness = core::mem::take(&mut layout.stiffness);
        stiffness.clear();
        self.for_each(layout, q, |body, load, position, rotation| {
            let own = load.stiffness(position, rotation);
            stiffness.push((body, (own + own.transpose()) * 0.5));
        });
        layout.stiffness = stiffness;
    }

    /// Returns the potential energy in J at coordinates `q`, of those that have one.
    pub fn energy(&self, layout: &Layout, q: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.for_each(layout, q, |_, load, position, rotation| {
            sum += load.at(position, rotation).energy.unwrap_or(0.0);
        });
        sum
    }

    /// Returns the rounding of their energies in J.
    pub fn rounding(&self, bodies: &[RigidBody]) -> f64 {
        let of = |(body, load): &(usize, &dyn PlacedLoad)| {
            let (body, place) = (&bodies[*body], load.at(&bodies[*body].position, &bodies[*body].rotation));
            place.energy.unwrap_or(0.0).abs() + (place.force.norm() + body.force.norm()) * body.position.norm()
        };
        8.0 * f64::EPSILON * self.0.iter().map(of).sum::<f64>()
    }
}
