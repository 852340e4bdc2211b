//! Torsion in the statics of an island: the torques on bodies, and the stiffness of whole segments.
//!
//! # Equation
//!
//! ```text
//! dU = M (g_q dq + sum +- t.dtheta)        K_s g_s g_s^T of all coordinates and bodies of a segment
//! ```
//!
//! with t the direction of the clamp on a body. A solution of the island without the second part is
//! completed by [`rank`](crate::effect::torsion::rank), which also says how many negative
//! eigenvalues it takes away. The torque of a body turns with it: its geometric stiffness is
//! antisymmetric, and cancels that of the slope.
//!
//! # Validity
//!
//! Bodies that turn by less than pi from one evaluation to the next.

use crate::cable::Cable;
use crate::effect::torsion::rank::RankUpdate;
use crate::error::StepFailure;
use crate::island::equations::{IslandEquations, MatrixKind};
use crate::island::layout::Layout;
use crate::system::BodyEnd;
use nalgebra::Vector3;

/// Buffers of the solution with torsion.
#[derive(Default)]
pub(super) struct Twists {
    /// By segment, the solution for g.
    columns: Vec<Vec<f64>>,
    rank: RankUpdate,
}

/// Begins with the bodies that hold segments.
pub(super) fn begin(cables: &mut [&mut Cable], layout: &Layout) {
    for (c, cable) in cables.iter_mut().enumerate() {
        let Cable { system, snapshot, .. } = &mut **cable;
        let Some(torsion) = &mut system.torsion_forces else { continue };
        torsion.join_island(&snapshot.state, |node| {
            let pin = layout.pins.iter().find(|pin| (pin.cable, pin.node) == (c, node))?;
            let attitude = layout.bodies[pin.body].rotation;
            Some(BodyEnd { body: pin.body, direction: pin.direction?, attitude: [attitude; 2] })
        });
    }
}

/// Returns the torques of the segments over a length (m), in N: the load of a cable that is twisted
/// alone.
pub(super) fn force(cables: &[&mut Cable], length: f64) -> f64 {
    let of = |cable: &&mut Cable| cable.system.torsion_forces.as_ref().map_or(0.0, |own| own.torque(&cable.model));
    cables.iter().map(of).sum::<f64>() / length
}

/// Sets the attitudes of bodies at coordinates that are evaluated next.
pub(super) fn follow(cables: &mut [&mut Cable], layout: &Layout, q: &[f64]) {
    for torsion in cables.iter_mut().filter_map(|cable| cable.system.torsion_forces.as_mut()) {
        torsion.turn_bodies(|body| layout.attitude(body, &q[layout.body_at(body)..]));
    }
}

/// Adds the torques at the coordinates that were evaluated last, times `scale`, to the rows of the
/// bodies.
pub(super) fn add_torques(cables: &[&mut Cable], layout: &Layout, scale: f64, rhs: &mut [f64]) {
    for cable in cables {
        let Some(torsion) = &cable.system.torsion_forces else { continue };
        for (body, torque) in torsion.torques(&cable.model) {
            add(layout, (body, torque * scale), rhs);
        }
    }
}

/// Adds a torque to the rows of a body.
fn add(layout: &Layout, (body, torque): (usize, Vector3<f64>), rhs: &mut [f64]) {
    let at = layout.body_at(body) + 3;
    rhs[at..at + 3].iter_mut().zip(&torque).for_each(|(row, x)| *row += x);
}

/// Returns the segments: cable and number.
fn segments(cables: &[&mut Cable]) -> Vec<(usize, usize)> {
    let count = |cable: &Cable| cable.system.torsion_forces.as_ref().map_or(0, |torsion| torsion.count());
    cables.iter().enumerate().flat_map(|(c, cable)| (0..count(cable)).map(move |s| (c, s))).collect()
}

/// Returns g.x of a segment.
fn along(cables: &[&mut Cable], layout: &Layout, (cable, segment): (usize, usize), x: &[f64]) -> f64 {
    let Some(torsion) = &cables[cable].system.torsion_forces else { return 0.0 };
    let (range, gradient, levers) = torsion.gradient(segment);
    let own = &x[layout.parts[cable].range()][range];
    let of_bodies = levers.map(|(body, lever)| {
        let at = layout.body_at(body) + 3;
        lever.dot(&Vector3::from_column_slice(&x[at..at + 3]))
    });
    gradient.iter().zip(own).map(|(g, x)| g * x).sum::<f64>() + of_bodies.sum::<f64>()
}

impl Twists {
    /// Solves for the columns at coordinates `q`, with the factors that the equations have.
    pub fn border(&mut self, equations: &mut IslandEquations<'_, '_>, q: &[f64]) -> Result<(), StepFailure> {
        let (layout, list) = (equations.layout, segments(equations.cables));
        self.columns.resize_with(list.len(), Vec::new);
        for (&(cable, segment), column) in list.iter().zip(&mut self.columns) {
            column.clear();
            column.resize(layout.size(), 0.0);
            let Some(torsion) = &equations.cables[cable].system.torsion_forces else { continue };
            let (range, gradient, levers) = torsion.gradient(segment);
            column[layout.parts[cable].range()][range].copy_from_slice(gradient);
            layout.pass_pinned_rows(q, column);
            levers.for_each(|lever| add(layout, lever, column));
            equations.solve(MatrixKind::Step, q, column);
        }
        let cables = &*equations.cables;
        let stiffness = |s: usize| {
            let (cable, segment) = list[s];
            cables[cable].system.torsion_forces.as_ref().map_or(0.0, |torsion| torsion.stiffness(segment))
        };
        let product = |s: usize, t: usize| along(cables, layout, list[s], &self.columns[t]);
        Ok(self.rank.factor(list.len(), stiffness, product)?)
    }

    /// Completes a solution of the equations.
    pub fn complete(&mut self, equations: &IslandEquations<'_, '_>, x: &mut [f64]) {
        let list = segments(equations.cables);
        let forces = self.rank.forces(list.len(), |s| along(equations.cables, equations.layout, list[s], x));
        for (force, column) in forces.iter().zip(&self.columns) {
            x.iter_mut().zip(column).for_each(|(x, y)| *x -= force * y);
        }
    }

    /// Returns how many negative eigenvalues of the matrix without torsion's columns are none with
    /// them.
    pub fn negative(&self) -> usize {
        self.rank.negative()
    }
}
