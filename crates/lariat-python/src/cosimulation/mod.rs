//! `CoSimulation`: a cable on bodies that another program moves.
//!
//! # Equation
//!
//! Per step the host prescribes poses and velocities of the bodies at its end ([`link`]). What returns is the impulse J of the cable on
//! each body over the step, as the mean force J/h, and on request the matrix by which J changes with the velocities ([`impedance`]).
//!
//! # Validity
//!
//! Once per step with the last forces, the exchange is explicit: stable if Z is small beside the mass matrix of the bodies. The module
//! `lariat.exchange` repeats steps from a snapshot until forces and poses agree, which is stable for any. J is the impulse of the loads
//! less the change of momentum of the cable, to rounding (`lariat_ancf::island`, accounts of pins).
//!
//! # References
//!
//! Busch, Continuous approximation techniques for co-simulation methods, 2016.

mod impedance;
mod link;

use crate::cable::{Cable, Laid};
use crate::convert::{Array, Place, Vector, result, table, vectors};
use crate::error::raise;
use crate::quaternion;
use crate::saved;
use crate::shared::Shared;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{self as ancf, At, Error, Vector3};
use link::{End, Link, Motion, Wrench};
use nalgebra::UnitQuaternion;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::borrow::Cow;

/// A cable on bodies that another program moves: per step it takes their poses, and returns forces,
/// moments and the impedance.
///
/// A body is known by a reference point, by convention its centre of mass. Rotations are
/// quaternions x, y, z, w. ``step`` once per step, with the last forces on the bodies, is an
/// explicit exchange: stable where the impedance is small beside the mass matrix of the bodies.
/// ``lariat.Exchange`` repeats it until forces and poses agree, and is stable for any.
///
/// A co-simulation of this cable, which is from now on stepped by it. Raises InWorldError.
#[pyclass(frozen, module = "lariat_cables")]
pub struct CoSimulation {
    /// Locked before the cable.
    link: Shared<Link>,
    cable: Shared<ancf::Cable>,
    object: Py<Cable>,
}

fn finite(what: &str, values: &[f64]) -> PyResult<()> {
    match values.iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(&value) => {
            let (cable, what, expected) = (None, what.to_string(), "a number");
            Err(raise(Error::InvalidValue { cable, what, value, expected }))
        }
    }
}

/// Returns the rows of an optional array of shape (ends, columns).
fn rows(array: Option<Array>, ends: usize, columns: usize, what: &str) -> PyResult<Option<Vec<Vec<f64>>>> {
    let Some(array) = array else { return Ok(None) };
    if array.shape != [ends, columns] {
        return Err(array.wrong_shape(&format!("({ends}, {columns})")));
    }
    finite(what, &array.values)?;
    Ok(Some(array.values.chunks_exact(columns).map(<[f64]>::to_vec).collect()))
}

/// What the bytes of `snapshot` hold.
const STATE: &str = "state of a co-simulation";

impl CoSimulation {
    fn of_parts(py: Python<'_>, cable: Cable, ends: Vec<End>) -> PyResult<Self> {
        let object = Bound::new(py, cable)?;
        let cable = object.get().own("be part of a co-simulation")?.clone();
        Ok(CoSimulation { link: Shared::new(Link::new(ends)), cable, object: object.unbind() })
    }
}

#[pymethods]
impl CoSimulation {
    #[new]
    fn new(cable: Bound<'_, Cable>) -> PyResult<Self> {
        let own = cable.get().own("be part of a co-simulation")?.clone();
        Ok(CoSimulation { link: Shared::new(Link::default()), cable: own, object: cable.unbind() })
    }

    /// The cable, to read it.
    #[getter]
    fn cable(&self, py: Python<'_>) -> Py<Cable> {
        self.object.clone_ref(py)
    }

    /// Attaches a node to a body whose reference point is at ``position`` (m) with ``rotation``:
    /// where the node is now. A clamp holds the direction of the tangent, too. Returns the index of
    /// the end. Raises OutOfRangeError, NoNodeError, AlreadyAttachedError (by this or another
    /// co-simulation).
    #[pyo3(signature = (at, position, rotation=None, *, clamp=false))]
    fn attach(
        &self,
        py: Python<'_>,
        at: Place,
        position: Vector,
        rotation: Option<Array>,
        clamp: bool,
    ) -> PyResult<usize> {
        finite("position (m)", position.0.as_slice())?;
        let rotation = match rotation {
            None => UnitQuaternion::identity(),
            Some(q) => match q.values[..] {
                [x, y, z, w] if q.shape.len() == 1 => quaternion::rotation(py, [x, y, z, w])?,
                _ => return Err(q.wrong_shape("(4,)")),
            },
        };
        let (position, cable) = (position.0, self.cable.clone());
        let attached = self.link.compute(py, move |link| {
            let mut cable = cable.lock();
            let node = cable.node(at.0)?;
            if cable.support(At::Node(node))?.attached || link.ends.iter().any(|end| end.node == node) {
                return Err(lariat_rapier::Error::AlreadyAttached { cable: cable.name().to_string(), node });
            }
            if clamp {
                cable.attach_clamped(At::Node(node), None)?;
            } else {
                cable.attach(At::Node(node))?;
            }
            let coordinates = Vector3::from_column_slice(&cable.positions()[6 * node + 3..6 * node + 6]);
            let velocity = Vector3::from_column_slice(&cable.velocities()[6 * node..6 * node + 3]);
            let direction = clamp.then(|| rotation.inverse() * coordinates.normalize());
            let anchor = rotation.inverse() * (cable.node_position(node) - position);
            let motion = Motion { position, rotation, velocity, spin: Vector3::zeros() };
            let (is_last, from_start) = (node + 1 == cable.nodes(), cable.nodes_from_start());
            link.ends.push(End { node, is_last, from_start, anchor, direction, motion });
            Ok(link.ends.len() - 1)
        });
        attached.map_err(raise)
    }

    /// Advances the cable by ``dt`` (s) while the bodies move to ``positions`` (m, shape (ends,
    /// 3)), ``rotations`` (shape (ends, 4); default: unchanged) with ``velocities`` (m/s) and
    /// ``angular_velocities`` (rad/s) at the end of the step (shape (ends, 3); default: uniform
    /// motion over the step). Warns as ``Cable.step`` does. Raises ShapeError, InvalidValueError,
    /// GapTooLongError (something else moved an end by more than 1e-3 m), and StepFailedError,
    /// after which all is as before.
    #[pyo3(signature = (dt, positions, rotations=None, velocities=None, angular_velocities=None))]
    fn step<'py>(
        &self,
        py: Python<'py>,
        dt: f64,
        positions: Array,
        rotations: Option<Array>,
        velocities: Option<Array>,
        angular_velocities: Option<Array>,
    ) -> PyResult<Bound<'py, PyAny>> {
        if !(dt.is_finite() && dt >= 1e-100) {
            let (cable, what, expected) = (None, "dt (s)".to_string(), ">= 1e-100");
            return Err(raise(Error::InvalidValue { cable, what, value: dt, expected }));
        }
        let before = self.link.with(py, |link| link.ends.clone());
        let ends = before.len();
        let positions = rows(Some(positions), ends, 3, "position (m)")?.unwrap_or_default();
        let rotations = rows(rotations, ends, 4, "rotation (quaternion)")?;
        let velocities = rows(velocities, ends, 3, "velocity (m/s)")?;
        let spins = rows(angular_velocities, ends, 3, "angular velocity (rad/s)")?;
        let mut to = Vec::new();
        for (i, end) in before.iter().enumerate() {
            let position = Vector3::from_column_slice(&positions[i]);
            let rotation = match rotations.as_ref().map(|rows| &rows[i][..]) {
                Some(&[x, y, z, w]) => quaternion::rotation(py, [x, y, z, w])?,
                _ => end.motion.rotation,
            };
            let of = |rows: &Option<Vec<Vec<f64>>>| rows.as_ref().map(|rows| Vector3::from_column_slice(&rows[i]));
            let uniform = (position - end.motion.position) / dt;
            let turning = (rotation * end.motion.rotation.inverse()).scaled_axis() / dt;
            let (velocity, spin) = (of(&velocities).unwrap_or(uniform), of(&spins).unwrap_or(turning));
            to.push(Motion { position, rotation, velocity, spin });
        }
        let cable = self.cable.clone();
        let wrenches = self.link.compute(py, move |link| {
            if link.ends.len() != to.len() {
                return Err(Error::EmptyIsland.into());
            }
            link.step(&mut cable.lock(), &to, dt)
        });
        let wrenches = wrenches.map_err(raise)?;
        self.object.get().tell(py)?;
        let of = |read: fn(&Wrench) -> Vector3<f64>| vectors(py, &wrenches.iter().map(read).collect::<Vec<_>>());
        let work: Vec<f64> = wrenches.iter().map(|wrench| wrench.work).collect();
        let values = (of(|w| w.force)?, of(|w| w.moment)?, of(|w| w.end_force)?, numpy::PyArray1::from_vec(py, work));
        result(py, "EndForces", values)
    }

    /// Returns Z, shape (6 ends, 6 ends), velocity before angular velocity of each end, about the
    /// reference points, in kg, kg m and kg m^2: if the velocities at the end of a step of ``dt``
    /// (s) differ by dv from the prescribed ones, the impulse on the bodies differs by -Z dv.
    /// Raises InvalidValueError.
    fn impedance<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyArray2<f64>>> {
        if !(dt.is_finite() && dt > 0.0) {
            let (cable, what, expected) = (None, "dt (s)".to_string(), "> 0");
            return Err(raise(Error::InvalidValue { cable, what, value: dt, expected }));
        }
        let cable = self.cable.clone();
        let z = self.link.compute(py, move |link| link.impedance(&cable.lock(), dt)).map_err(raise)?;
        // symmetric, so that the order of the numbers does not matter
        table(py, z.as_slice().to_vec(), z.ncols())
    }

    /// Returns the state of cable and ends, for ``restore``.
    fn snapshot<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let cable = self.cable.clone();
        let written = self.link.compute(py, move |link| saved::write(&(cable.lock().snapshot(), &link.ends)));
        saved::to_bytes(py, STATE, written)
    }

    /// Restores a state of this co-simulation; the run continues bitwise from there. Raises
    /// FormatError, WrongCountError.
    fn restore(&self, py: Python<'_>, snapshot: Cow<'_, [u8]>) -> PyResult<()> {
        let (state, ends): (ancf::Snapshot, Vec<End>) = saved::from_bytes(STATE, &snapshot)?;
        let cable = self.cable.clone();
        let restored = self.link.compute(py, move |link| {
            let mut cable = cable.lock();
            if ends.len() != link.ends.len() {
                let (what, count, expected) = ("ends of the co-simulation", ends.len(), link.ends.len());
                return Err(Error::WrongCount { cable: cable.name().to_string(), what, count, expected });
            }
            cable.restore(state)?;
            link.ends = ends;
            Ok(())
        });
        restored.map_err(raise)
    }

    /// Returns a copy with a cable of its own, obstacles included. ``copy.copy`` and
    /// ``copy.deepcopy`` use it.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let ends = self.link.with(py, |link| link.ends.clone());
        Self::of_parts(py, self.object.get().copy(py)?, ends)
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyDict>) -> PyResult<Self> {
        self.copy(py)
    }

    /// Returns cable, obstacles and ends; ``from_bytes`` continues the run bitwise. Pickle uses it.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let (cable, obstacles) = (self.cable.clone(), self.object.get().obstacles(py));
        let written = self.link.compute(py, move |link| saved::write(&(&*cable.lock(), &obstacles, &link.ends)));
        saved::to_bytes(py, "co-simulation", written)
    }

    /// Returns a saved co-simulation of the same version. Raises FormatError.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: Cow<'_, [u8]>) -> PyResult<Self> {
        let (cable, obstacles, ends): (ancf::Cable, Vec<Laid>, Vec<End>) = saved::from_bytes("co-simulation", &bytes)?;
        Self::of_parts(py, Cable::with_obstacles(cable, obstacles)?, ends)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.get_type().getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }
}
