//! The matrices of an island and its linear equations: see [`island`](super).

use super::bordered::{Bordered, Lever};
use super::condense::Columns;
use super::cuts;
use super::hold::{Hold, direction_near, vector};
use super::layout::{Layout, Part};
use super::mass_key::MassKey;
use super::rotation::skew;
use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::error::StepFailure;
use crate::linalg::{Definiteness, Factorisation};
use crate::support::SlopeSupport;
use crate::system::{project_matrix, project_part, project_vector};
use nalgebra::{Matrix6, Vector3};

/// Which matrix of an island.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MatrixKind {
    /// The mass matrix.
    Mass,
    /// The step matrix of the last stage.
    Step,
}

/// Matrices and buffers of one cable.
#[derive(Clone, Debug, Default)]
struct CableBuffers {
    /// By hold, the direction of the slope when the mass matrix was factored, and the step matrix.
    directions: [Vec<Vector3<f64>>; 2],
    /// Factors of the mass matrix; those of the step matrix are the cable's own.
    mass_factorisation: Factorisation,
    /// Of these and the condensed mass matrix.
    mass_key: MassKey,
    /// Mass matrix times accelerations.
    product: Vec<f64>,
}

impl CableBuffers {
    /// Returns the factors of a matrix; `step` are those of the step matrix.
    fn factors<'a>(&'a self, kind: MatrixKind, step: &'a Factorisation) -> &'a Factorisation {
        match kind {
            MatrixKind::Mass => &self.mass_factorisation,
            MatrixKind::Step => step,
        }
    }
}

/// Factored matrices of an island. Of what a host step leaves here only the condensed mass matrices
/// serve the next one, and only if they are the same.
#[derive(Clone, Debug, Default)]
pub(super) struct Matrices {
    cables: Vec<CableBuffers>,
    mass: Bordered,
    step: Bordered,
    mass_is_factored: bool,
    /// Rows of the border, then its increments.
    rows: Vec<f64>,
    /// c2 of the stage whose step matrix is factored; 0 = none.
    pub factored: f64,
}

impl Matrices {
    /// Begins a host step.
    pub fn begin(&mut self, layout: &Layout) {
        self.cables.resize_with(layout.parts.len(), CableBuffers::default);
        self.mass.resize(layout.parts.len());
        self.step.resize(layout.parts.len());
        self.cables.iter_mut().zip(&layout.parts).for_each(|(buffers, part)| buffers.product.resize(part.size, 0.0));
        self.mass_is_factored = false;
        self.factored = 0.0;
    }

    fn of(&mut self, kind: MatrixKind) -> &mut Bordered {
        match kind {
            MatrixKind::Mass => &mut self.mass,
            MatrixKind::Step => &mut self.step,
        }
    }
}

/// The equations of an island during one host step.
pub(super) struct IslandEquations<'a, 'b> {
    pub cables: &'a mut [&'b mut Cable],
    pub layout: &'a Layout,
    pub matrices: &'a mut Matrices,
}

impl IslandEquations<'_, '_> {
    /// Returns the cables with their coordinates.
    pub fn parts(&self) -> impl Iterator<Item = (&Cable, &Part)> {
        self.cables.iter().map(|cable| &**cable).zip(&self.layout.parts)
    }

    /// Computes `out = M x` of the cables; entries of bodies are left as they are.
    pub fn multiply_mass(&self, x: &[f64], out: &mut [f64]) {
        for (cable, part) in self.parts() {
            cable.system.mass.multiply(cable.system.level, &x[part.range()], &mut out[part.range()]);
        }
    }

    /// Computes the rows `scale F - M z` of all cables; `z` holds accelerations times the scale.
    pub fn cable_rows(&mut self, at: &ForceInput<'_>, z: &[f64], rhs: &mut [f64]) {
        let layout = self.layout;
        for ((cable, part), buffers) in self.cables.iter_mut().zip(&layout.parts).zip(&mut self.matrices.cables) {
            let range = part.range();
            let rows = &mut rhs[range.clone()];
            let (mut equations, _) = cable.equations();
            equations.force(ForceInput { q: &at.q[range.clone()], v: &at.v[range.clone()], ..*at }, rows);
            equations.system.mass.multiply(equations.system.level, &z[range], &mut buffers.product);
            subtract(rows, &buffers.product);
        }
    }

    /// Returns the share of the impulses that rows, `scale F - M z`, leave unbalanced; 0 if no
    /// force on a cable depends on velocities.
    pub fn imbalance(&mut self, scale: f64, rows: &[f64]) -> f64 {
        let layout = self.layout;
        if !self.cables.iter().any(|cable| cable.model.depends_on_velocity()) {
            return 0.0;
        }
        let (mut unbalanced, mut impulse) = (0.0, 0.0);
        for ((cable, part), buffers) in self.cables.iter_mut().zip(&layout.parts).zip(&self.matrices.cables) {
            let own = cable.equations().0.unbalanced(scale, &rows[part.range()], &buffers.product);
            unbalanced += own[0];
            impulse += own[1];
        }
        for (i, body) in layout.bodies.iter().enumerate() {
            let at = layout.body_at(i);
            unbalanced += vector(&rows[at..]).norm();
            impulse += scale * body.force.norm();
        }
        unbalanced / impulse
    }

    /// Computes the rows as [`cable_rows`](Self::cable_rows), and factors and condenses the step
    /// matrices of all cables.
    pub fn cable_rows_and_matrices(
        &mut self,
        at: &ForceInput<'_>,
        z: &[f64],
        rhs: &mut [f64],
    ) -> Result<(), StepFailure> {
        let layout = self.layout;
        let Matrices { cables: buffers, step, .. } = &mut *self.matrices;
        for (c, ((cable, part), buffers)) in self.cables.iter_mut().zip(&layout.parts).zip(buffers).enumerate() {
            let range = part.range();
            let rows = &mut rhs[range.clone()];
            let CableBuffers { directions, product, .. } = buffers;
            update_clamp_directions(cable, &part.holds, at.q, &mut directions[MatrixKind::Step as usize]);
            let (mut equations, _) = cable.equations();
            let input = ForceInput { q: &at.q[range.clone()], v: &at.v[range.clone()], ..*at };
            equations.force_and_matrix(input, 1.0, rows);
            step.cable(c).read(&equations.system.step.matrix, &part.held, &[]);
            cuts::cut(&part.cuts, &mut equations.system.step.matrix);
            equations.factor_to_solve()?;
            let (level, model) = (equations.system.level, equations.model);
            let factorisation = &equations.system.step.factorisation;
            let columns = Columns { held: &part.held, cuts: &part.cuts, ..Columns::default() };
            step.cable(c).complete(level, factorisation, columns, |first, x| project_part(model, first, x));
            equations.system.mass.multiply(equations.system.level, &z[range], product);
            subtract(rows, product);
        }
        Ok(())
    }

    /// Factors and condenses the mass matrices of all cables, and the bodies' matrix at this
    /// configuration.
    pub fn factor_mass(&mut self, q: &[f64], v: &[f64]) -> Result<(), StepFailure> {
        let layout = self.layout;
        let clamped = layout.clamps.iter().any(Option::is_some);
        if !self.matrices.mass_is_factored || clamped {
            let Matrices { cables: buffers, mass, .. } = &mut *self.matrices;
            for (c, ((cable, part), buffers)) in self.cables.iter_mut().zip(&layout.parts).zip(buffers).enumerate() {
                let CableBuffers { directions, mass_factorisation, mass_key, .. } = buffers;
                update_clamp_directions(cable, &part.holds, q, &mut directions[MatrixKind::Mass as usize]);
                if mass_key.fits(cable, part) {
                    continue;
                }
                mass_key.clear();
                let Cable { model, system, .. } = &mut **cable;
                let matrix = &mut system.step.matrix;
                matrix.clear();
                system.mass.add_to(matrix, 1.0);
                mass.cable(c).read(matrix, &part.held, &[]);
                cuts::cut(&part.cuts, matrix);
                project_matrix(model, matrix);
                mass_factorisation.factor(system.level, matrix)?;
                let columns = Columns { held: &part.held, cuts: &part.cuts, ..Columns::default() };
                let project = |first: usize, x: &mut [f64]| project_part(model, first, x);
                mass.cable(c).complete(system.level, mass_factorisation, columns, project);
                mass_key.set(cable, part);
            }
            self.matrices.mass_is_factored = true;
        }
        self.factor_bodies(MatrixKind::Mass, 0.0, q, v, &[])
    }

    /// Factors the matrix of the bodies: masses, condensed cables, and, of the step matrix, the
    /// geometric stiffness of the levers under the rows `rhs` of the held coordinates, and `scale`
    /// times that of forces at points.
    pub fn factor_bodies(
        &mut self,
        kind: MatrixKind,
        scale: f64,
        q: &[f64],
        v: &[f64],
        rhs: &[f64],
    ) -> Result<(), StepFailure> {
        let layout = self.layout;
        let matrix = self.matrices.of(kind);
        matrix.begin(layout.bodies.len(), layout.parts.iter().map(|part| part.cuts.len()), 0);
        for (i, body) in layout.bodies.iter().enumerate() {
            let at = layout.body_at(i);
            let motion = layout.motion(i, &q[at..at + 6], &v[at..at + 6]);
            let mut inertia = body.carried.unwrap_or_else(Matrix6::zeros);
            for x in 0..3 {
                inertia[(x, x)] += body.mass;
            }
            let mut rotational = inertia.fixed_view_mut::<3, 3>(3, 3);
            rotational += body.world_inertia(&motion.rotation);
            matrix.add_inertia(i, &inertia);
            if let (Some(points), MatrixKind::Step) = (&body.at_points, kind) {
                matrix.add_rotational(i, &(points.stiffness(&motion.rotation) * scale));
            }
        }
        layout.coupled.iter().for_each(|coupled| matrix.add_coupled(coupled));
        if kind == MatrixKind::Step {
            layout.joints.add_stiffness(scale, &layout.bodies, layout.pose(q), matrix);
            layout.stiffness.iter().for_each(|(body, own)| matrix.add_inertia(*body, &(own * scale)));
        }
        for (c, part) in layout.parts.iter().enumerate() {
            if kind == MatrixKind::Step {
                for hold in &part.holds {
                    let geometric = -skew(&vector(&rhs[hold.at..])) * skew(&layout.rotating_vector(hold, q));
                    matrix.add_rotational(layout.pins[hold.pin].body, &((geometric + geometric.transpose()) * 0.5));
                }
            }
            set_levers(matrix.levers(c), layout, part, q);
            matrix.add_cable(c);
        }
        for (i, body) in layout.bodies.iter().enumerate() {
            matrix.lock(i, &body.free);
        }
        matrix.factor()
    }

    /// Returns the number of negative eigenvalues of the step matrix at `at`, of the cables,
    /// condensed, and of the bodies; `None` where rounding leaves it uncertain.
    pub fn negative_eigenvalues(&mut self, at: &ForceInput<'_>, rhs: &mut [f64]) -> Result<Option<usize>, StepFailure> {
        let layout = self.layout;
        let none = vec![0.0; layout.size()];
        let mut sum = Some(0);
        for (cable, part) in self.cables.iter_mut().zip(&layout.parts) {
            let range = part.range();
            let (mut equations, _) = cable.equations();
            let input = ForceInput { q: &at.q[range.clone()], v: &at.v[range.clone()], ..*at };
            equations.force_and_matrix(input, 1.0, &mut rhs[range]);
            let own = match equations.factor()? {
                Definiteness::PositiveDefinite => Some(0),
                Definiteness::Indefinite { negative } => negative,
            };
            sum = sum.zip(own).map(|(sum, own)| sum + own);
        }
        self.cable_rows_and_matrices(at, &none, rhs)?;
        self.factor_bodies(MatrixKind::Step, at.scale, at.q, at.v, rhs)?;
        Ok(sum.map(|sum| sum + self.matrices.step.negative()))
    }

    /// Solves in place: rows in, increments out, those of pinned coordinates included. The
    /// increments of bodies are displacements and rotations in world axes.
    pub fn solve(&mut self, kind: MatrixKind, q: &[f64], rhs: &mut [f64]) {
        let layout = self.layout;
        let Matrices { cables: buffers, mass, step, rows, .. } = &mut *self.matrices;
        let matrix = if kind == MatrixKind::Mass { mass } else { step };
        let (own, of_bodies) = rhs.split_at_mut(layout.bodies_at);
        rows.clear();
        rows.extend_from_slice(of_bodies);
        rows.resize(matrix.rows(), 0.0);
        for (c, ((cable, part), buffers)) in self.cables.iter_mut().zip(&layout.parts).zip(&*buffers).enumerate() {
            let cable = &mut **cable;
            let directions = &buffers.directions[kind as usize];
            for (hold, factored) in part.holds.iter().zip(directions).filter(|(h, _)| h.slope) {
                // the matrix was factored with this direction
                let along = direction_near(&q[hold.at..], factored).dot(&vector(&own[hold.at..]));
                own[hold.at..hold.at + 3].copy_from_slice((factored * along).as_slice());
                if let Some((_, support)) = cable.model.supports.iter_mut().find(|(n, _)| *n == hold.node) {
                    support.slope = SlopeSupport::Attached(*factored);
                }
            }
            let own = &mut own[part.range()];
            cuts::take(&part.cuts, own, &mut rows[6 * (layout.bodies.len() + part.cut_at)..]);
            project_vector(&cable.model, own);
            let factors = (cable.system.level, buffers.factors(kind, &cable.system.step.factorisation));
            set_levers(matrix.levers(c), layout, part, q);
            matrix.reduce(c, factors, own, rows);
            cable.diagnostics_mut().solves += 1;
        }
        for (body, six) in layout.bodies.iter().zip(rows.chunks_exact_mut(6)) {
            for x in (0..6).filter(|&x| !body.free[x]) {
                six[x] = 0.0;
            }
        }
        matrix.solve(rows);
        of_bodies.copy_from_slice(&rows[..of_bodies.len()]);
        for (c, ((cable, part), buffers)) in self.cables.iter().zip(&layout.parts).zip(&*buffers).enumerate() {
            let factors = (cable.system.level, buffers.factors(kind, &cable.system.step.factorisation));
            let moved = matrix.expand(c, factors, &mut own[part.range()], rows);
            cuts::give(&part.cuts, &moved[3 * part.holds.len()..], &mut own[part.range()]);
            let moved = moved.chunks_exact(3).map(vector);
            for ((hold, factored), mut held) in part.holds.iter().zip(&buffers.directions[kind as usize]).zip(moved) {
                if hold.slope {
                    let along = factored.dot(&vector(&own[hold.at..]));
                    held += direction_near(&q[hold.at..], factored) * along;
                }
                own[hold.at..hold.at + 3].copy_from_slice(held.as_slice());
            }
        }
    }

    /// Returns the size in m of a vector of increments, with rotations multiplied by the lever they
    /// displace.
    pub fn norm(&self, x: &[f64]) -> f64 {
        let mut worst = 0.0f64;
        let mut take = |size: f64| worst = if size > worst || size.is_nan() { size } else { worst };
        for (cable, part) in self.parts() {
            take(cable.system.scales.extent(&x[part.range()]).0);
        }
        for (i, lever) in self.layout.levers.iter().enumerate() {
            let at = self.layout.body_at(i);
            take(vector(&x[at..]).norm());
            take(vector(&x[at + 3..]).norm() * lever);
        }
        worst
    }

    /// Returns the largest displacement in m that `x` makes of the free bodies and their anchors;
    /// `None` if there is none.
    pub fn norm_of_bodies(&self, x: &[f64]) -> Option<f64> {
        let layout = self.layout;
        let free = (0..layout.bodies.len()).filter(|&i| !layout.bodies[i].is_driven());
        let sizes = free.map(|i| {
            let at = layout.body_at(i);
            let rotation = vector(&x[at + 3..]).norm() * layout.levers[i];
            vector(&x[at..]).norm().max(rotation) + 0.0 * rotation
        });
        sizes.reduce(|worst, size| if size > worst || size.is_nan() { size } else { worst })
    }
}

/// Sets what the coordinates of a cable in the border follow at coordinates `q`: those that are
/// held, and slopes of cuts.
fn set_levers(levers: &mut Vec<Lever>, layout: &Layout, part: &Part, q: &[f64]) {
    let lever = |hold: &Hold| Lever::held(layout.pins[hold.pin].body, &layout.rotating_vector(hold, q), hold.slope);
    let first = layout.bodies.len() + part.cut_at;
    levers.clear();
    levers.extend(part.holds.iter().map(lever));
    levers.extend((0..part.cuts.len()).map(|cut| Lever::of_own(first, cut)));
}

/// Sets the directions of a cable's clamps at coordinates `q` of the island in its supports, and
/// records them by hold as those of the matrix to be factored.
fn update_clamp_directions(cable: &mut Cable, holds: &[Hold], q: &[f64], directions: &mut Vec<Vector3<f64>>) {
    let supports = &mut cable.model.supports;
    directions.clear();
    for hold in holds {
        let mut d = Vector3::zeros();
        if hold.slope
            && let Some(SlopeSupport::Attached(held)) =
                supports.iter_mut().find(|(n, _)| *n == hold.node).map(|(_, s)| &mut s.slope)
        {
            *held = direction_near(&q[hold.at..], held);
            d = *held;
        }
        directions.push(d);
    }
}

fn subtract(x: &mut [f64], y: &[f64]) {
    for (x, y) in x.iter_mut().zip(y) {
        *x -= y;
    }
}
