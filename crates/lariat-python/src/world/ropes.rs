//! Ropes of a world in one call, what ties cables to each other, what they withstand, and what a step may cost.

use super::bodies::{Handle, invalid};
use super::{Contents, World, numbered};
use crate::cable::Cable;
use crate::convert::{Count, Place, Vector, result};
use crate::error::{Raise, raise};
use crate::integrator::fidelity;
use crate::section::Section;
use lariat_ancf::{Fidelity, Strength};
use lariat_rapier::{Budget, Gap, JunctionHandle, Rope, RopeEnd, Settings};
use pyo3::prelude::*;

/// Returns the largest work of a host step.
pub(super) fn budget(max_iterations: Option<u64>, max_time: Option<f64>) -> PyResult<Option<Budget>> {
    match (max_iterations, max_time) {
        (Some(_), Some(time)) => Err(invalid("max_time (s) beside max_iterations", time, "one of them, not both")),
        (Some(iterations), None) => Ok(Some(Budget::NewtonIterations(iterations))),
        (None, None) => Ok(Settings::default().budget),
        (None, Some(f64::INFINITY)) => Ok(None),
        (None, Some(time)) if !(time.is_finite() && time > 0.0) => Err(invalid("max_time (s)", time, "> 0")),
        (None, Some(time)) => Ok(Some(Budget::Time(time))),
    }
}

impl Contents {
    fn junction(&self, number: usize) -> Result<JunctionHandle, Raise> {
        numbered(&self.junctions, number, "junction", "NoJunctionError")
    }

    /// Returns the number of a junction, a new one if it has none.
    fn number_of_junction(&mut self, handle: JunctionHandle) -> usize {
        self.junctions.iter().position(|own| *own == handle).unwrap_or_else(|| {
            self.junctions.push(handle);
            self.junctions.len() - 1
        })
    }
}

#[pymethods]
impl World {
    /// Adds the usual rope between two points (m), each held by a body or by the world, damped by
    /// 0.2 of critical at its lowest axial mode. ``slack``: unstretched length beyond the distance,
    /// as a share of it; ``length``: unstretched length in m, in place of a slack; ``strength``:
    /// tension in N above which it breaks; ``elements``: default that of fidelity game. Raises
    /// NoBodyError, CoincidentPointsError, InvalidValueError, ElementCountError.
    #[pyo3(signature = (start, end, section, *, start_body=None, end_body=None, slack=0.0, length=None, strength=None, elements=None, fidelity=None, name="rope"))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn add_rope<'py>(
        &self,
        py: Python<'py>,
        start: Vector,
        end: Vector,
        section: &Section,
        start_body: Option<Handle>,
        end_body: Option<Handle>,
        slack: f64,
        length: Option<f64>,
        strength: Option<f64>,
        elements: Option<Count>,
        fidelity: Option<&str>,
        name: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let fidelity = fidelity.map(self::fidelity).transpose()?;
        let elements = elements.map_or(Fidelity::Game.elements(), |count| count.0);
        let rope =
            Rope { slack, unstretched_length: length, strength, elements, fidelity, ..Rope::new(section.0).name(name) };
        let ends = [(start, start_body), (end, end_body)]
            .map(|(point, body)| RopeEnd { point: point.0, body: body.map(|b| b.0) });
        let added = self.0.compute(py, |contents| {
            let rope = contents.set.add_rope(&contents.world, ends[0], ends[1], rope)?;
            Ok::<_, lariat_rapier::Error>((
                rope.cable,
                [rope.start, rope.end].map(|end| end.map(|e| contents.add_attachment(e))),
            ))
        });
        let (cable, [start, end]) = added.map_err(raise)?;
        result(py, "Rope", (self.cable(cable), start, end))
    }

    /// Ties a point of a cable to a point of another, like a massless shackle; ``gap``: the largest
    /// distance in m that is closed, None: any. Returns the number of the junction; that of one of
    /// the points, if it is tied already. Raises GapTooLongError, AlreadyAttachedError,
    /// NoCableError, OutOfRangeError.
    #[pyo3(signature = (first, at, second, second_at, *, gap=1e-3))]
    fn join(
        &self,
        py: Python<'_>,
        first: &Cable,
        at: Place,
        second: &Cable,
        second_at: Place,
        gap: Option<f64>,
    ) -> PyResult<usize> {
        let ends = ((first.handle_in(&self.0)?, at.0), (second.handle_in(&self.0)?, second_at.0));
        let gap = gap.map_or(Gap::Close, Gap::Refuse);
        let joined = self.0.compute(py, |contents| {
            let handle = contents.set.join_with_gap(ends.0, ends.1, gap)?;
            Ok::<_, lariat_rapier::Error>(contents.number_of_junction(handle))
        });
        joined.map_err(raise)
    }

    /// Frees the slope of a cable at a point between its ends, on both sides, as a hinge does:
    /// where a point load or a junction bends a cable that is limp, sqrt(EI/T) far below an
    /// element. The cable becomes two that share the point; ``cable`` keeps the part before it.
    /// Returns the other part and the number of the junction of both. No moment and no torque goes
    /// through it. Raises NoCableError, AlreadyAttachedError, OutOfRangeError, NotWithReelError.
    fn add_kink(&self, py: Python<'_>, cable: &Cable, at: Place) -> PyResult<(Cable, usize)> {
        let handle = cable.handle_in(&self.0)?;
        let added = self.0.compute(py, |contents| {
            let (behind, junction) = contents.set.add_kink(handle, at.0)?;
            Ok::<_, lariat_rapier::Error>((behind, contents.number_of_junction(junction)))
        });
        let (behind, junction) = added.map_err(raise)?;
        Ok((self.cable(behind), junction))
    }

    /// Unties a cable from a junction; one with a single point left ends. Raises NoJunctionError,
    /// NoCableError.
    fn leave(&self, py: Python<'_>, junction: usize, cable: &Cable) -> PyResult<()> {
        let cable = cable.handle_in(&self.0)?;
        let outcome = self.0.compute(py, |contents| {
            let handle = contents.junction(junction)?;
            contents.set.leave(handle, cable).map_err(Raise::from)
        });
        outcome.map_err(raise)
    }

    /// Returns the cables of a junction, each with the arc length of its point in m. Raises
    /// NoJunctionError.
    fn junction(&self, py: Python<'_>, junction: usize) -> PyResult<Vec<(Cable, f64)>> {
        let points = self.0.with(py, |contents| {
            let handle = contents.junction(junction)?;
            contents.set.junction(handle).map(|found| found.points().collect::<Vec<_>>()).map_err(Raise::from)
        });
        Ok(points.map_err(raise)?.into_iter().map(|(cable, s)| (self.cable(cable), s)).collect())
    }

    /// Sets the tension in N and the strain above which a cable breaks; None: no limit. Raises
    /// InvalidValueError, OneElementError, NoCableError.
    #[pyo3(signature = (cable, tension=None, *, strain=None))]
    fn set_strength(&self, py: Python<'_>, cable: &Cable, tension: Option<f64>, strain: Option<f64>) -> PyResult<()> {
        let handle = cable.handle_in(&self.0)?;
        self.0.with(py, |contents| contents.set.set_strength(handle, Strength { tension, strain })).map_err(raise)
    }
}
