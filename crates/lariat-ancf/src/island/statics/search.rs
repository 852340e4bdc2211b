//! The iteration to equilibrium: proximal steps, and the checks of their end.

use super::joint::{Joints, StaticJoint};
use super::krylov;
use super::load::Loads;
use super::twists::{self, Twists};
use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::error::{EquilibriumFailure, StepFailure};
use crate::island::body::RigidBody;
use crate::island::equations::{IslandEquations, Matrices, MatrixKind};
use crate::island::hold::vector;
use crate::island::layout::Layout;
use crate::island::pin::PinConstraint;
use crate::island::rotation::{exponential, jacobian_inverse};
use crate::model::{LoadScale, Model, largest_force};
use crate::scales::statics::{
    AT_REST, GROWTH, ISLAND_CONVERGED, ISLAND_STAGNATION, LEVER_ROUNDING, MAX_C2, MAX_ITERATIONS, MAX_SHAKES,
    MAX_SLOPE_CHANGE, MIN_C2, PRODUCT_DISPLACEMENT, REDUCTION, SHAKE, STABILITY_C2,
};
use crate::section::Element;
use crate::statics::{first_fold, move_with_supports, potential, straighten};
use crate::system::project_vector;
use nalgebra::Vector3;

/// The iteration.
pub(super) struct Search<'a> {
    pub layout: Layout,
    matrices: Matrices,
    time: f64,
    /// Coordinates, those of a trial, its displacement, and zero velocities.
    pub q: Vec<f64>,
    trial: Vec<f64>,
    z: Vec<f64>,
    v: Vec<f64>,
    rhs: Vec<f64>,
    /// Sum of the loads in N, and the largest residual that is small.
    force: f64,
    pub tolerance: f64,
    energy_rounding: f64,
    length: f64,
    /// First c2 in s^2.
    first: f64,
    has_potential: bool,
    /// Whether something drives the cables at rest, as a flow does.
    driven: bool,
    /// Whether the part of the tangent that is not symmetric is solved with the rest.
    pub exact: bool,
    /// Present where a cable has torsion.
    twists: Option<Twists>,
    /// Loads on bodies that depend on where they are.
    loads: Loads<'a>,
    pub steps: usize,
    pub residual: f64,
}

impl<'a> Search<'a> {
    pub fn new(
        cables: &mut [&mut Cable],
        bodies: &[RigidBody],
        (pins, joints, loads): (&[PinConstraint], &[StaticJoint], Loads<'a>),
        tolerance: f64,
    ) -> Self {
        let mut layout = Layout::default();
        layout.begin(cables, bodies, pins, 1.0);
        layout.close();
        let scales: Vec<LoadScale> = cables.iter().map(|c| LoadScale::new(&c.model, c.positions())).collect();
        let of_bodies: f64 = bodies.iter().filter(|b| b.free[..3] != [false; 3]).map(|b| total_force(b).norm()).sum();
        let mass: f64 = scales.iter().map(|s| s.mass).sum::<f64>() + bodies.iter().map(|b| b.mass).sum::<f64>();
        let length = scales.iter().map(|s| s.length).fold(0.0, f64::max);
        let force = scales.iter().map(|s| s.force).sum::<f64>() + of_bodies + twists::force(cables, length);
        if !joints.is_empty() {
            let of_element = |e: &Element| e.section.axial_stiffness / e.length;
            let elastic = cables.iter().flat_map(|c| &c.model.elements).map(of_element).fold(0.0, f64::max);
            layout.joints = Joints::new(joints, elastic.max(force / length), length);
            layout.joints.lengthen(&mut layout.levers);
        }
        // a body that is held at its centre turns about nothing
        layout.levers.iter_mut().filter(|lever| **lever < LEVER_ROUNDING * length).for_each(|lever| *lever = 0.0);
        twists::begin(cables, &layout);
        let twisted = |c: &&mut Cable| c.system.torsion_forces.as_ref().is_some_and(|torsion| torsion.count() > 0);
        let twists = cables.iter().any(twisted).then(Twists::default);
        let driven = cables.iter().any(|c| c.system.forces.drive()) || !loads.have_potential(bodies);
        let moments = cables.iter().flat_map(|c| &c.model.loads).any(|load| load.moment != Vector3::zeros());
        let has_potential = !driven && !moments;
        let mut q: Vec<f64> = cables.iter().flat_map(|cable| cable.positions().iter().copied()).collect();
        bodies.iter().for_each(|body| q.extend(body.position.iter().chain(&[0.0; 3])));
        let zeros = || vec![0.0; layout.size()];
        let (trial, z, v, rhs) = (zeros(), zeros(), zeros(), zeros());
        let mut matrices = Matrices::default();
        matrices.begin(&layout);
        Search {
            time: cables[0].time(),
            tolerance: tolerance * force + scales.iter().map(|s| s.rounding).fold(0.0, f64::max),
            energy_rounding: scales.iter().map(|s| s.energy_rounding).sum::<f64>() + loads.rounding(bodies),
            first: 0.1 * mass * length / force,
            steps: 0,
            residual: f64::NAN,
            layout,
            matrices,
            q,
            trial,
            z,
            v,
            rhs,
            force,
            length,
            has_potential,
            driven,
            exact: false,
            twists,
            loads,
        }
    }

    /// Iterates to rest, and returns whether the shape is stable. If no other is found beside one
    /// that is not, that one is it.
    pub fn run(&mut self, cables: &mut [&mut Cable], most: usize) -> Result<bool, EquilibriumFailure> {
        if let Some(resultant) = self.unheld(cables) {
            self.residual = resultant;
            return Err(EquilibriumFailure::NotHeld);
        }
        loop {
            let mut left = None;
            let outcome = self.descend(cables, most, &mut left);
            let stable = match left {
                Some((q, layout, residual)) if outcome.is_err() => {
                    (self.q, self.layout, self.residual) = (q, layout, residual);
                    false
                }
                _ => outcome?,
            };
            let Search { layout, q, length, .. } = self;
            let pose = layout.pose(q);
            if layout.joints.renew(*length, &layout.bodies, pose) {
                return Ok(stable);
            }
        }
    }

    /// Iterates to rest; the first unstable shape that is left goes into `left`.
    fn descend(
        &mut self,
        cables: &mut [&mut Cable],
        most: usize,
        left: &mut Option<(Vec<f64>, Layout, f64)>,
    ) -> Result<bool, EquilibriumFailure> {
        self.place(cables);
        let (mut shakes, mut straightened, mut lowest) = (0, false, f64::INFINITY);
        let mut c2 = self.first;
        let mut energy = energy_of(&self.layout, cables, &self.q, self.loads);
        let mut cause = None;
        while self.steps < most {
            self.steps += 1;
            let outcome = self.step(cables, c2);
            let there = &self.trial;
            let after = if outcome.is_ok() { energy_of(&self.layout, cables, there, self.loads) } else { f64::NAN };
            // NaN fails too
            let falls = after.is_finite() && (!self.has_potential || after <= energy + self.energy_rounding);
            let moved = match outcome {
                Ok(moved) if falls && !self.passes(cables) => moved,
                outcome => {
                    cause = outcome.err();
                    c2 *= REDUCTION;
                    if c2 < MIN_C2 * self.first {
                        break;
                    }
                    continue;
                }
            };
            core::mem::swap(&mut self.q, &mut self.trial);
            self.turn();
            energy = energy_of(&self.layout, cables, &self.q, self.loads);
            c2 = (GROWTH * c2).min(MAX_C2 * self.first);
            self.residual = self.balance(cables);
            if !(self.residual <= self.tolerance && moved <= AT_REST * self.length) {
                continue;
            }
            if let Some(element) = self.fold(cables) {
                if straightened {
                    return Err(EquilibriumFailure::Folded { element });
                }
                straightened = true;
                for (cable, part) in cables.iter().zip(&self.layout.parts) {
                    straighten(cable, &mut self.q[part.range()]);
                }
            } else if self.driven {
                // the tangent of a flow is not symmetric: its symmetric part is judged, and nothing
                // is done about it
                return Ok(self.is_stable(cables));
            } else if self.is_stable(cables) {
                return Ok(true);
            } else {
                let lower = energy < lowest - self.energy_rounding;
                lowest = lowest.min(energy);
                if shakes == MAX_SHAKES || !self.has_potential || shakes > 0 && !lower {
                    return Ok(false);
                }
                shakes += 1;
                left.get_or_insert_with(|| (self.q.clone(), self.layout.clone(), self.residual));
                self.shake();
            }
            self.place(cables);
            energy = energy_of(&self.layout, cables, &self.q, self.loads);
            c2 = self.first;
        }
        Err(cause.map_or(EquilibriumFailure::NotConverged, EquilibriumFailure::Step))
    }

    /// Returns whether a cable goes through what it touches on the way to the trial.
    fn passes(&self, cables: &[&mut Cable]) -> bool {
        cables.iter().zip(&self.layout.parts).any(|(cable, part)| {
            let (from, to) = (&self.q[part.range()], &self.trial[part.range()]);
            cable.system.static_contact.passes(&cable.model, from, to)
        })
    }

    /// Returns the resultant of the loads in N if nothing holds the island.
    fn unheld(&self, cables: &[&mut Cable]) -> Option<f64> {
        let is_held = |model: &Model| {
            !model.potentials.list.is_empty() || model.supports.iter().any(|(_, s)| s.position.is_some())
        };
        let held = cables.iter().any(|c| is_held(&c.model))
            || self.layout.bodies.iter().any(|b| b.free[..3] != [true; 3])
            || self.layout.joints.hold();
        let of_cable =
            |c: &&mut Cable| c.model.loads.iter().fold(c.model.dead_resultant().0, |sum, load| sum + load.force);
        let sum = cables.iter().map(of_cable).chain(self.layout.bodies.iter().map(total_force)).sum::<Vector3<f64>>();
        (!held && sum.norm() > 1e-12 * self.force).then_some(sum.norm())
    }

    /// Moves held nodes to their supports and bodies, and the cables with them.
    fn place(&mut self, cables: &[&mut Cable]) {
        let before = self.q.clone();
        for (cable, part) in cables.iter().zip(&self.layout.parts) {
            for (node, support) in &cable.model.supports {
                let range = part.at + 6 * node..part.at + 6 * node + 6;
                support.prescribe(self.time, &mut self.q[range.clone()], &mut self.v[range]);
            }
        }
        self.layout.follow(self.time, &mut self.q, &mut self.v);
        self.v.fill(0.0);
        for (cable, part) in cables.iter().zip(&self.layout.parts) {
            move_with_supports(&cable.model, &before[part.range()], &mut self.q[part.range()]);
        }
    }

    /// Solves the step of `c2` (s^2) into the trial, and returns its largest displacement in m.
    fn step(&mut self, cables: &mut [&mut Cable], c2: f64) -> Result<f64, StepFailure> {
        let Search { layout, matrices, q, trial, z, v, rhs, time, length, driven, exact, twists, loads, .. } = self;
        trial.copy_from_slice(q);
        z.fill(0.0);
        let mut before = f64::INFINITY;
        for iteration in 1..=MAX_ITERATIONS {
            let mut skew = loads.linearise(layout, trial);
            let mut equations = IslandEquations { cables: &mut *cables, layout, matrices };
            let at = ForceInput { time: *time, scale: c2, q: trial, v, dv_dq: 0.0 };
            twists::follow(equations.cables, layout, trial);
            equations.cable_rows_and_matrices(&at, z, rhs)?;
            equations.factor_bodies(MatrixKind::Step, c2, trial, v, rhs)?;
            layout.body_rows(c2, trial, v, z, rhs);
            loads.add(layout, trial, c2, rhs);
            if let Some(twists) = twists {
                twists::add_torques(equations.cables, layout, c2, rhs);
                twists.border(&mut equations, trial)?;
            }
            let solve = |equations: &mut IslandEquations<'_, '_>, twists: &mut Option<Twists>, x: &mut [f64]| {
                equations.solve(MatrixKind::Step, trial, x);
                if let Some(twists) = twists {
                    twists.complete(equations, x);
                }
            };
            let rows = (*exact && *driven).then(|| rhs.clone());
            skew.border(rhs.len(), c2, |x: &mut [f64]| solve(&mut equations, twists, x));
            solve(&mut equations, twists, rhs);
            skew.complete(rhs);
            if let Some(rows) = rows {
                let (mut there, mut way) = (trial.clone(), z.clone());
                krylov::solve(rhs, |x, out| {
                    let share = PRODUCT_DISPLACEMENT * *length / equations.norm(x);
                    way.copy_from_slice(z);
                    displace(layout, trial, x, share, &mut way);
                    there.iter_mut().zip(q.iter()).zip(&way).for_each(|((y, q), z)| *y = q + z);
                    layout.follow(*time, &mut there, v);
                    layout.follow_acceleration(*time, c2, &there, v, &mut way);
                    v.fill(0.0);
                    twists::follow(equations.cables, layout, &there);
                    let at = ForceInput { time: *time, scale: c2, q: &there, v, dv_dq: 0.0 };
                    equations.cable_rows(&at, &way, out);
                    layout.body_rows(c2, &there, v, &way, out);
                    loads.add(layout, &there, c2, out);
                    if twists.is_some() {
                        twists::add_torques(equations.cables, layout, c2, out);
                    }
                    out.iter_mut().zip(&rows).for_each(|(out, row)| *out = (row - *out) / share);
                    solve(&mut equations, twists, out);
                    skew.complete(out);
                });
                twists::follow(equations.cables, layout, trial);
            }
            let size = equations.norm(rhs);
            let slopes = equations.parts().map(|(c, part)| c.system.scales.extent(&rhs[part.range()]).1);
            let rotations = (0..layout.bodies.len()).map(|i| vector(&rhs[layout.body_at(i) + 3..]).norm());
            let rotation = slopes.chain(rotations).fold(0.0, f64::max);
            let damp = (MAX_SLOPE_CHANGE / rotation.max(MAX_SLOPE_CHANGE)).min(*length / size.max(*length));
            if !(size * damp).is_finite() {
                return Err(StepFailure::NotFinite { what: "increment of statics", node: 0 });
            }
            displace(layout, trial, rhs, damp, z);
            trial.iter_mut().zip(q.iter()).zip(z.iter()).for_each(|((y, q), z)| *y = q + z);
            layout.follow(*time, trial, v);
            layout.follow_acceleration(*time, c2, trial, v, z);
            v.fill(0.0);
            let rounding = damp == 1.0 && before <= ISLAND_STAGNATION * *length && size > 0.5 * before;
            // without a symmetric tangent the iteration is linear; what it leaves falls from step
            // to step
            let close = *driven && size <= ISLAND_STAGNATION * *length;
            if size <= ISLAND_CONVERGED * *length || rounding || close {
                z.iter_mut().zip(trial.iter()).zip(q.iter()).for_each(|((z, y), q)| *z = y - q);
                return Ok(equations.norm(z));
            }
            if damp == 1.0 && iteration > 4 && size > before {
                return Err(StepFailure::NotConverged { iterations: iteration, increment: size });
            }
            before = damp * size;
        }
        if before <= ISLAND_STAGNATION * *length {
            // a proximal step need not be exact, and energy and residual judge it
            z.iter_mut().zip(trial.iter()).zip(q.iter()).for_each(|((z, y), q)| *z = y - q);
            return Ok(IslandEquations { cables, layout, matrices }.norm(z));
        }
        Err(StepFailure::NotConverged { iterations: MAX_ITERATIONS, increment: before })
    }

    /// Counts rotations from the present attitudes.
    fn turn(&mut self) {
        for i in 0..self.layout.bodies.len() {
            let at = self.layout.body_at(i);
            let mut rotation = exponential(&vector(&self.q[at + 3..])) * self.layout.bodies[i].rotation;
            rotation.renormalize();
            self.layout.bodies[i].rotation = rotation;
            self.q[at + 3..at + 6].fill(0.0);
        }
    }

    /// Returns the largest residual in N, of nodes and of bodies; moments are divided by the lever
    /// of the body or by the length of an element.
    fn balance(&mut self, cables: &mut [&mut Cable]) -> f64 {
        let Search { layout, matrices, q, z, v, rhs, time, length, loads, .. } = self;
        let mut equations = IslandEquations { cables, layout, matrices };
        z.fill(0.0);
        twists::follow(equations.cables, layout, q);
        equations.cable_rows(&ForceInput { time: *time, scale: 1.0, q, v, dv_dq: 0.0 }, z, rhs);
        layout.body_rows(1.0, q, v, z, rhs);
        loads.add(layout, q, 1.0, rhs);
        twists::add_torques(equations.cables, layout, 1.0, rhs);
        let mut worst = 0.0f64;
        for (cable, part) in equations.cables.iter().zip(&layout.parts) {
            let shortest = cable.model.elements.iter().map(|e| e.length).fold(f64::INFINITY, f64::min);
            project_vector(&cable.model, &mut rhs[part.range()]);
            worst = worst.max(largest_force(&rhs[part.range()], shortest));
        }
        for (i, body) in layout.bodies.iter().enumerate() {
            let row = &mut rhs[layout.body_at(i)..layout.body_at(i) + 6];
            row.iter_mut().zip(&body.free).filter(|(_, free)| !**free).for_each(|(x, _)| *x = 0.0);
            let lever = if layout.levers[i] > 0.0 { layout.levers[i] } else { *length };
            worst = worst.max(largest_force(row, lever));
        }
        if rhs.iter().all(|x| x.is_finite()) { worst } else { f64::NAN }
    }

    /// Returns the first folded element of a cable.
    fn fold(&self, cables: &[&mut Cable]) -> Option<usize> {
        cables.iter().zip(&self.layout.parts).find_map(|(cable, part)| first_fold(cable, &self.q[part.range()]))
    }

    /// Returns whether the stiffness is positive definite, but for modes softer than any that
    /// matters; of a matrix that is singular to rounding, but for modes that are softer than those.
    fn is_stable(&mut self, cables: &mut [&mut Cable]) -> bool {
        let Search { layout, matrices, q, v, rhs, time, first, twists, loads, .. } = self;
        loads.linearise(layout, q);
        let mut equations = IslandEquations { cables, layout, matrices };
        let mut c2 = STABILITY_C2 * *first;
        while c2 > *first {
            let at = ForceInput { time: *time, scale: c2, q, v, dv_dq: 0.0 };
            twists::follow(equations.cables, layout, q);
            let negative = equations.negative_eigenvalues(&at, rhs);
            let removed = match twists {
                None => Ok(0),
                Some(twists) => twists.border(&mut equations, q).map(|()| twists.negative()),
            };
            if let (Ok(negative), Ok(removed)) = (negative, removed) {
                return negative == Some(removed);
            }
            c2 *= REDUCTION;
        }
        false
    }

    /// Displaces everything a little, the same in every run.
    fn shake(&mut self) {
        let mut seed = 1u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            2.0 * SHAKE * ((seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5)
        };
        for part in &self.layout.parts {
            for x in self.q[part.range()].chunks_exact_mut(6) {
                // a position less than a slope, which it turns over the length of an element
                x[..3].iter_mut().for_each(|x| *x += self.length * 1e-2 * random());
                x[3..].iter_mut().for_each(|x| *x += random());
            }
        }
        for (i, body) in self.layout.bodies.iter().enumerate() {
            let at = self.layout.body_at(i);
            for x in (0..6).filter(|&x| body.free[x]) {
                self.q[at + x] += if x < 3 { self.length * random() } else { random() };
            }
        }
        self.turn();
    }
}

/// Adds a share of increments `x`, which solve the equations at coordinates `trial`, to
/// displacements.
fn displace(layout: &Layout, trial: &[f64], x: &[f64], share: f64, z: &mut [f64]) {
    for i in 0..layout.bodies_at {
        z[i] += share * x[i];
    }
    for body in 0..layout.bodies.len() {
        let at = layout.body_at(body);
        let turn = jacobian_inverse(&vector(&trial[at + 3..])) * vector(&x[at + 3..]);
        for i in 0..3 {
            z[at + i] += share * x[at + i];
            z[at + 3 + i] += share * turn[i];
        }
    }
}

/// Returns the sum of the forces on a body in N.
fn total_force(body: &RigidBody) -> Vector3<f64> {
    body.force + body.at_points.map_or(Vector3::zeros(), |points| points.force)
}

/// Returns the potential energy in J at coordinates `q`, less the work of torques over the
/// rotations from the attitudes that these are counted from.
fn energy_of(layout: &Layout, cables: &mut [&mut Cable], q: &[f64], loads: Loads<'_>) -> f64 {
    let mut sum = 0.0;
    twists::follow(cables, layout, q);
    for (cable, part) in cables.iter_mut().zip(&layout.parts) {
        sum += potential(&cable.equations().0, 1.0, &q[part.range()]);
    }
    let bodies = layout.bodies.iter().enumerate();
    let work = bodies.map(|(i, body)| {
        let at = layout.body_at(i);
        let turn = vector(&q[at + 3..]);
        let points = body.at_points.as_ref().map_or(0.0, |points| {
            points.force.dot(&vector(&q[at..])) + points.work(&(exponential(&turn) * body.rotation))
        });
        body.force.dot(&vector(&q[at..])) + body.torque.dot(&turn) + points
    });
    sum - work.sum::<f64>() + layout.joints.energy(&layout.bodies, layout.pose(q)) + loads.energy(layout, q)
}
