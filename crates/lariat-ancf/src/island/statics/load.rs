//! Loads on bodies that depend on where these are, in statics: as those of water.
//!
//! # Equation
//!
//! A load at the place of a body is a force through its centre of mass and a moment about it. It
//! enters the rows of the body, the symmetric part of its negative derivative the matrix A0; where
//! it has a potential, that is part of the energy that the search lowers. With N the rest of the
//! derivative of those that have none, as drag, and E the rows of the bodies,
//!
//! ```text
//! (A0 + E N E^T) x = r        x = x0 - Y (1 + N E^T Y)^-1 N E^T x0,   x0 = A0^-1 r,   Y = A0^-1 E
//! ```
//!
//! # Validity
//!
//! Loads that are continuous.
//!
//! # References
//!
//! Woodbury 1950.
//!
//! # Alternatives considered
//!
//! The symmetric part alone: a plate on an arm in 2 m/s of water was not found in 400 iterations.

use crate::island::body::RigidBody;
use crate::island::layout::Layout;
use nalgebra::{DMatrix, DVector, Matrix6, UnitQuaternion, Vector3};

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

    /// Returns the load with a share of what drives it, as the velocity of a current: statics that
    /// do not find a shape at once follow it from none of it to all. Default: `None`, nothing
    /// drives it, or no share of it is known.
    fn driven_by(&self, _share: f64) -> Option<Box<dyn PlacedLoad>> {
        None
    }
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

    /// Sets the stiffness at coordinates `q` in the layout, and returns what of it is not
    /// symmetric.
    pub fn linearise(&self, layout: &mut Layout, q: &[f64]) -> Skew {
        let mut stiffness = core::mem::take(&mut layout.stiffness);
        stiffness.clear();
        let mut skew = Skew::default();
        self.for_each(layout, q, |body, load, position, rotation| {
            let own = load.stiffness(position, rotation);
            stiffness.push((body, (own + own.transpose()) * 0.5));
            if load.at(position, rotation).energy.is_none() {
                skew.bodies.push((layout.body_at(body), (own - own.transpose()) * 0.5));
            }
        });
        layout.stiffness = stiffness;
        skew
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

/// The part of the stiffness of loads that is not symmetric.
#[derive(Default)]
pub(super) struct Skew {
    /// By load, where the rows of its body begin, and N.
    bodies: Vec<(usize, Matrix6<f64>)>,
    /// Y, by column.
    columns: Vec<Vec<f64>>,
    /// 1 + N E^T Y.
    small: DMatrix<f64>,
}

impl Skew {
    /// Solves for the columns with the symmetric matrix, of `size` rows, in which the stiffness has
    /// a factor `scale`.
    pub fn border(&mut self, size: usize, scale: f64, mut solve: impl FnMut(&mut [f64])) {
        let count = 6 * self.bodies.len();
        self.bodies.iter_mut().for_each(|(_, own)| *own *= scale);
        for k in 0..count {
            let mut column = vec![0.0; size];
            column[self.bodies[k / 6].0 + k % 6] = 1.0;
            solve(&mut column);
            self.columns.push(column);
        }
        let columns: Vec<DVector<f64>> = self.columns.iter().map(|column| self.product(column)).collect();
        self.small = DMatrix::from_fn(count, count, |i, k| columns[k][i] + if i == k { 1.0 } else { 0.0 });
    }

    /// Returns N E^T x.
    fn product(&self, x: &[f64]) -> DVector<f64> {
        let of = |(at, own): &(usize, Matrix6<f64>)| own * nalgebra::Vector6::from_column_slice(&x[*at..at + 6]);
        DVector::from_iterator(6 * self.bodies.len(), self.bodies.iter().flat_map(|body| <[f64; 6]>::from(of(body))))
    }

    /// Completes a solution with the symmetric matrix; one of a singular matrix stays.
    pub fn complete(&self, x: &mut [f64]) {
        if self.bodies.is_empty() {
            return;
        }
        let Some(forces) = self.small.clone().lu().solve(&self.product(x)) else { return };
        for (force, column) in forces.iter().zip(&self.columns) {
            x.iter_mut().zip(column).for_each(|(x, y)| *x -= force * y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* The equation itself.
    #[test]
    fn a_part_that_is_not_symmetric_is_solved_with_the_rest() {
        let symmetric = DMatrix::from_fn(9, 9, |i, j| if i == j { 5.0 + i as f64 } else { 0.3 });
        let skew = Matrix6::from_fn(|i, j| (i as f64 - j as f64) * (1.0 + (i * j) as f64));
        let mut full = symmetric.clone();
        (0..36).for_each(|k| full[(3 + k / 6, 3 + k % 6)] += 0.7 * skew[(k / 6, k % 6)]);
        let right = DVector::from_fn(9, |i, _| 1.0 + (i * i) as f64);
        let solve = |x: &mut [f64]| {
            let solved = symmetric.clone().lu().solve(&DVector::from_column_slice(x)).unwrap();
            x.copy_from_slice(solved.as_slice());
        };
        let mut own = Skew { bodies: vec![(3, skew)], ..Skew::default() };
        own.border(9, 0.7, solve);
        let mut x = right.as_slice().to_vec();
        solve(&mut x);
        own.complete(&mut x);
        assert!((full * DVector::from_vec(x) - right).norm() < 1e-10);
    }
}
