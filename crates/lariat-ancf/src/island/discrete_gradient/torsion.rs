//! Torsion as a term of a step. Equations: [`effect::torsion`](crate::effect::torsion).
//!
//! # Equation
//!
//! With D Phi = sum c.D q + D theta_last - D theta_first over a step and O Phi that of the step
//! before,
//!
//! ```text
//! M^ = K (Phi0 + b D Phi - a O Phi + tau D Phi/h)        impulse -h M^ c on the coordinates
//! D theta = 2 atan(w.t/2) = sigma w.t      w = h w^, t = (t0 + t1)/2, of a body that turns by the Cayley map
//! M^ D Phi = D(K Phi^2/2) + a/2 K (D Phi^2 - O Phi^2) + a/2 K (D Phi - O Phi)^2 + K tau D Phi^2/h
//! ```
//!
//! so the angular impulse on the body of the last hold is -h M^ sigma t, on that of the first +h M^
//! sigma t, and the energy law of the step holds to rounding: the last line is energy, store,
//! numerical dissipation and damping. A motor does the work M^ D theta. To the step matrix belong
//!
//! ```text
//! b h^2/2 M^ Hess(Phi_e)(mean)  +  b h^2 K (b + tau/h) g g^T        g = c, and -+ sigma t of the bodies
//! ```
//!
//! of which the second part couples all coordinates of a segment:
//! [`rank`](crate::effect::torsion::rank).
//!
//! At an eye the length l of an element is a coordinate, too: D Phi has a part c_l D l, and K falls
//! as cable is paid out. With K_m, the mean of both ends of the step, in place of K above and O Phi
//! such that K O Phi^2 stays, the force on the length is, to rounding,
//!
//! ```text
//! dU/dl = M^ c_l - K0 K1/GJ (Phi0^2 + Phi1^2)/4
//! ```
//!
//! What moves ends between two host steps (Rapier turned a
//! body, a user a support) changes the twist by the same increments.
//!
//! # Validity
//!
//! That of the effect. The torque of a body turns with it: its geometric stiffness is
//! antisymmetric, and cancels that of the slope.

use super::twists::{End, SIGNS, SegmentStep, Torsions, turned_since};
use super::{IslandStep, StepBuffers};
use crate::cable::Cable;
use crate::effect::EndSpin;
use crate::effect::torsion::lengths::Lengths;
use crate::effect::torsion::segment::CurveChange;
use crate::error::StepFailure;
use crate::island::hold::vector;
use crate::one_leg::OneLeg;
use crate::term::{Account, Balance, StepStart, StepTerm};

/// Torsion of all cables.
pub(super) struct Torsion;

impl StepTerm<IslandStep<'_, '_>> for Torsion {
    fn name(names: &mut Vec<&'static str>) {
        names.push("torsion");
    }

    fn begin_host_step(island: &mut IslandStep<'_, '_>) {
        island.find_segments();
    }

    fn begin(island: &mut IslandStep<'_, '_>, _: &StepStart) {
        let torsions = &mut island.buffers.torsions;
        torsions.evaluated = false;
        for own in &mut torsions.list {
            let cable = &island.cables[own.cable];
            let memory = &cable.snapshot.state.memory;
            let twist = memory.torsion.as_ref().and_then(|twists| twists.get(own.number)).copied().unwrap_or_default();
            let (elements, q) = (cable.elements(), cable.positions());
            (own.material, own.start) = (twist.twist, own.segment.loaded(elements, q, twist.twist));
            own.remembered = if memory.differences.is_empty() { 0.0 } else { cable.step_buffers.kept * twist.change };
        }
    }

    fn evaluate(island: &mut IslandStep<'_, '_>) {
        if island.buffers.torsions.list.is_empty() {
            return;
        }
        island.evaluate_torsion();
        island.pass_torsion(|cable| &mut cable.step_buffers.term_impulses);
    }

    fn linearise(island: &mut IslandStep<'_, '_>) {
        if island.buffers.torsions.list.is_empty() {
            return;
        }
        if !island.buffers.torsions.evaluated {
            island.evaluate_torsion();
        }
        island.pass_torsion(|cable| &mut cable.step_buffers.rhs);
        for own in &island.buffers.torsions.list {
            let Cable { model, snapshot, step_buffers, system, .. } = &mut *island.cables[own.cable];
            let (q, change, h, leg) = (&snapshot.state.q, &step_buffers.change, step_buffers.h, step_buffers.leg);
            let mean = |i: usize| q[i] + 0.5 * change[i];
            let factor = 0.5 * leg.b * h * h * own.torque;
            let lengths = Lengths::with_eyes(&model.elements, system.feeds.lengths_over(snapshot.state.time, h));
            own.segment.add_hessian(&lengths, mean, factor, &mut system.step.matrix);
        }
    }

    fn balance(island: &mut IslandStep<'_, '_>, balance: &mut Balance) {
        for own in &island.buffers.torsions.list {
            let cable = &mut *island.cables[own.cable];
            let (leg, h) = (cable.step_buffers.leg, cable.step_buffers.h);
            let (stiffness, second) = (own.mean_stiffness(), own.change - own.before);
            let lost = own.damping * stiffness * own.change * own.change / h;
            cable.system.meter.work_of_step.torsion -= lost;
            balance.to(Account::Elements).loss += lost;
            balance.numerical += 0.5 * leg.a * stiffness * second * second;
            balance.held += 0.5 * own.stiffness[0] * own.start * own.start;
            let driven = own.ends[1].driven - own.ends[0].driven;
            balance.to(Account::Supports).work += own.torque * driven;
        }
    }

    fn accept(island: &mut IslandStep<'_, '_>) {
        for own in &island.buffers.torsions.list {
            let cable = &mut *island.cables[own.cable];
            cable.diagnostics_mut().twist_slips += own.slips;
            let Some(twist) = cable.snapshot.state.memory.torsion.as_mut().and_then(|all| all.get_mut(own.number))
            else {
                continue;
            };
            // as it counts at the end of the step
            let kept = own.change * (own.mean_stiffness() / own.stiffness[1]).sqrt();
            (twist.twist, twist.change) = (own.material + (own.change - own.stretch), kept);
        }
        island.note_attitudes();
    }
}

impl IslandStep<'_, '_> {
    /// Finds the segments when a host step begins, and lets their twists follow what changed since
    /// the last one.
    fn find_segments(&mut self) {
        let (cables, layout) = (&mut *self.cables, self.layout);
        let StepBuffers { torsions: Torsions { list, found, .. }, bodies, cables: buffers, .. } = &mut *self.buffers;
        let mut count = 0;
        for (c, cable) in cables.iter_mut().enumerate().filter(|(_, cable)| cable.model.effects.torsion.is_some()) {
            let Cable { model, snapshot, system, diagnostics, .. } = &mut **cable;
            system.feeds.list.iter_mut().for_each(|feed| feed.of_twist = 0.0);
            model.find_segments(found);
            let state = &mut snapshot.state;
            model.follow_holds(found, &mut state.memory.torsion);
            let before = &buffers[c].start.q;
            for (number, segment) in found.iter().enumerate() {
                if count == list.len() {
                    list.push(SegmentStep::new(*segment));
                }
                let own = &mut list[count];
                count += 1;
                (own.cable, own.number, own.segment) = (c, number, *segment);
                own.damping = model.effects.torsion.as_ref().map_or(0.0, |torsion| torsion.damping);
                own.ends = segment.nodes.map(|node| End::of(&buffers[c].holds, node));
                let Some(twist) = state.memory.torsion.as_mut().and_then(|all| all.get_mut(number)) else { continue };
                own.secant.clear();
                if state.q[segment.range()] != before[segment.range()] {
                    let (angle, slips) = segment.follow(&model.elements, [before, &state.q]);
                    twist.twist += angle;
                    diagnostics.twist_slips += slips;
                }
                for (side, end) in own.ends.iter().enumerate() {
                    let (Some(body), Some(then)) = (end.body, twist.attitudes[side]) else { continue };
                    let hold = &buffers[c].holds[end.hold];
                    twist.twist += SIGNS[side] * turned_since(then, &bodies[body], hold, layout, state.time);
                }
            }
        }
        list.truncate(count);
    }

    /// Notes the attitudes of the bodies that hold segments.
    fn note_attitudes(&mut self) {
        let StepBuffers { torsions, bodies, .. } = &mut *self.buffers;
        for own in &torsions.list {
            let memory = &mut self.cables[own.cable].snapshot.state.memory;
            let Some(twist) = memory.torsion.as_mut().and_then(|all| all.get_mut(own.number)) else { continue };
            for (attitude, end) in twist.attitudes.iter_mut().zip(&own.ends) {
                let of_body = |body: usize| <[f64; 4]>::from(bodies[body].rotation.coords);
                *attitude = end.body.map(of_body).map(|[x, y, z, w]| [w, x, y, z]);
            }
        }
    }

    /// Evaluates the twists of the present iterate.
    fn evaluate_torsion(&mut self) {
        let StepBuffers { torsions, bodies, cables: buffers, .. } = &mut *self.buffers;
        for own in &mut torsions.list {
            let cable = &mut *self.cables[own.cable];
            let Cable { model, snapshot, step_buffers: b, system, diagnostics, .. } = cable;
            let (torsion, at_eyes) =
                (model.effects.torsion.as_ref(), system.feeds.lengths_over(snapshot.state.time, b.h));
            let lengths = Lengths::with_eyes(&model.elements, at_eyes);
            let CurveChange { angle, stretch, slips, by_lengths } =
                own.segment.change(&lengths, &snapshot.state.q, &b.change, &mut own.secant);
            diagnostics.effects.torsion += own.segment.count();
            (own.slips, own.change, own.stretch) = (slips, angle, stretch);
            own.stiffness = own.segment.stiffnesses(torsion, &lengths);
            let stiffness = own.mean_stiffness();
            own.before = own.remembered * (own.stiffness[0] / stiffness).sqrt();
            for (side, node) in own.segment.nodes.into_iter().enumerate() {
                let time = snapshot.state.time;
                let spin = torsion.map_or(&EndSpin::Held, |torsion| model.end_spin(torsion, node));
                let end = &mut own.ends[side];
                end.driven = spin.angle(time + b.h) - spin.angle(time);
                end.angle = end.driven;
                if let Some(body) = end.body {
                    let hold = &buffers[own.cable].holds[end.hold];
                    end.follow(&bodies[body], hold, self.layout, [time, time + b.h]);
                }
                own.change += SIGNS[side] * end.angle;
            }
            if own.segment.strands.is_some() {
                own.change += stretch;
            }
            own.torque = stiffness * (own.start + b.leg.b * own.change - b.leg.a * own.before)
                + own.damping * stiffness * own.change / b.h;
            let of_dilution = torsion.map_or(0.0, |torsion| own.force_of_dilution(torsion.stiffness));
            for feed in system.feeds.list.iter_mut().filter(|feed| own.segment.contains(feed.element(model))) {
                feed.of_twist = own.torque * by_lengths[feed.side as usize] + of_dilution;
            }
            for (side, end) in own.ends.iter().enumerate().filter(|(_, end)| end.body.is_some()) {
                // of two segments at one body, each adds its own
                let twist = &mut buffers[own.cable].holds[end.hold].twists[side];
                *twist = end.lever * (-SIGNS[side] * b.h * own.torque);
            }
        }
        torsions.evaluated = true;
    }

    /// Adds the impulses of the present iterate to vectors of the cables, and to the rows of the
    /// bodies.
    fn pass_torsion(&mut self, vector: impl Fn(&mut Cable) -> &mut Vec<f64>) {
        let StepBuffers { torsions, rows, cables: buffers, .. } = &mut *self.buffers;
        for own in torsions.list.iter().filter(|own| own.number == 0) {
            let size = self.cables[own.cable].positions().len();
            let cable = &mut *self.cables[own.cable];
            let impulses = &mut cable.step_buffers.term_impulses;
            impulses.clear();
            impulses.resize(size, 0.0);
        }
        for own in &torsions.list {
            let cable = &mut *self.cables[own.cable];
            let factor = cable.step_buffers.h * own.torque;
            let out = &mut vector(cable)[own.segment.range()];
            out.iter_mut().zip(&own.secant).for_each(|(out, c)| *out -= factor * c);
            for (side, end) in own.ends.iter().enumerate() {
                let Some(body) = end.body else { continue };
                let twist = buffers[own.cable].holds[end.hold].twists[side];
                rows[6 * body + 3..6 * body + 6].iter_mut().zip(&twist).for_each(|(row, x)| *row += x);
            }
        }
    }

    /// Solves for the columns that torsion adds to the matrix, for steps of length `h` (s).
    pub(super) fn border_torsion(&mut self, (h, leg): (f64, OneLeg)) -> Result<(), StepFailure> {
        let mut torsions = core::mem::take(&mut self.buffers.torsions);
        let count = torsions.list.len();
        torsions.columns.resize_with(count.max(torsions.columns.len()), Default::default);
        for (own, (columns, rows)) in torsions.list.iter().zip(&mut torsions.columns) {
            columns.resize_with(self.cables.len(), Vec::new);
            self.solve_columns(columns, rows, |island, columns, rows| {
                columns[own.cable][own.segment.range()].copy_from_slice(&own.secant);
                for hold in &island.buffers.cables[own.cable].holds {
                    hold.pass(&vector(&columns[own.cable][hold.at..]), rows);
                }
                for (side, end) in own.ends.iter().enumerate() {
                    let Some(body) = end.body else { continue };
                    let lever = end.lever * SIGNS[side];
                    rows[6 * body + 3..6 * body + 6].iter_mut().zip(&lever).for_each(|(row, x)| *row += x);
                }
            });
        }
        let Torsions { list, columns, rank, .. } = &mut torsions;
        let stiffness = |s: usize| {
            let stiffness = list[s].mean_stiffness();
            leg.b * h * (leg.b * h * stiffness + list[s].damping * stiffness)
        };
        let product = |s: usize, t: usize| list[s].along(&columns[t].0[list[s].cable], &columns[t].1);
        let outcome = if count > 0 { rank.factor(count, stiffness, product) } else { Ok(()) };
        self.buffers.torsions = torsions;
        Ok(outcome?)
    }

    /// Completes a solution of the linear equations by what torsion adds to the matrix.
    pub(super) fn complete_by_torsion(&mut self) {
        let StepBuffers { torsions: Torsions { list, columns, rank, .. }, rows, .. } = &mut *self.buffers;
        if list.is_empty() {
            return;
        }
        let cables = &mut *self.cables;
        let forces = rank.forces(list.len(), |s| list[s].along(&cables[list[s].cable].step_buffers.rhs, rows));
        for (force, (columns, own_rows)) in forces.iter().zip(&*columns) {
            let of_cables = cables.iter_mut().map(|cable| &mut cable.step_buffers.rhs).zip(columns);
            for (x, y) in of_cables.chain(core::iter::once((&mut *rows, own_rows))) {
                x.iter_mut().zip(y).for_each(|(x, y)| *x -= force * y);
            }
        }
    }
}
