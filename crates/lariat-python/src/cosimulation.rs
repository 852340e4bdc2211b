//! `CoSimulation`: a cable on bodies that another program moves.
//!
//! # Equation
//!
//! Per step the host prescribes poses and velocities of the bodies at its end. Each body follows the cubic between the velocities at
//! both ends of the step, and a node of the cable is held to it (`lariat_ancf::island`, driven bodies). What returns is the impulse J of
//! the cable on each body over the step, as the mean force J/h.
//!
//! The impedance is the matrix Z (6x6 for each pair of bodies, velocity before angular velocity, about the reference points) by which
//! the impulse on the bodies changes when their velocities at the end of a step differ by dv from the prescribed ones: dJ = -Z dv.
//!
//! ```text
//! A = M + h D + h^2 K        C = B A^-1 B^T        Z = P^T C^-1 P
//! ```
//!
//! B selects the coordinates of the cable that the bodies hold, and P are the velocities of these by those of the bodies.
//!
//! # Validity
//!
//! The exchange is explicit, once per step: stable if Z is small beside the mass matrix of the bodies. J is the impulse of the
//! loads less the change of momentum of the cable, to rounding (`lariat_ancf::island`, accounts of pins). A is one linearised implicit Euler
//! step; if compression makes it indefinite, D and K are halved until it is positive definite.
//!
//! # References
//!
//! Busch, Continuous approximation techniques for co-simulation methods, 2016.

use crate::cable::Cable;
use crate::convert::{Array, Place, Vector, result, table, vectors};
use crate::error::{Raise, raise};
use crate::shared::Shared;
use fearless_simd::Level;
use lariat_ancf::island::{Island, PinConstraint, RigidBody};
use lariat_ancf::linalg::{BlockTridiagonal, Definiteness, Factorisation};
use lariat_ancf::{self as ancf, At, Error, Vector3};
use nalgebra::{DMatrix, Matrix3, Quaternion, UnitQuaternion};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

const MAGIC: &str = concat!("lariat co-simulation ", env!("CARGO_PKG_VERSION"), "\n");
/// Largest number of times that D and K are halved.
const HALVINGS: i32 = 40;
/// Largest distance in m of a node from its body, as in a world.
const LARGEST_GAP: f64 = 1e-3;

/// Pose and velocity of the reference point of a body.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Motion {
    position: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
}

/// A node of the cable that a body of the host holds.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct End {
    node: usize,
    /// Whether that is the last node, and the nodes that a reel at the start had added: reels add and remove nodes.
    is_last: bool,
    from_start: i64,
    /// Point of the body in its axes, from the reference point, in m.
    anchor: Vector3<f64>,
    /// Direction of the tangent in the axes of the body, for a clamp.
    direction: Option<Vector3<f64>>,
    motion: Motion,
}

/// Force and moment of the cable on a body.
struct Wrench {
    force: Vector3<f64>,
    moment: Vector3<f64>,
    end_force: Vector3<f64>,
    work: f64,
}

#[derive(Default)]
struct Link {
    island: Island,
    ends: Vec<End>,
}

/// A cable on bodies that another program moves.
#[pyclass(frozen, module = "lariat")]
pub struct CoSimulation {
    /// Locked before the cable.
    link: Shared<Link>,
    cable: Shared<ancf::Cable>,
    object: Py<Cable>,
}

impl End {
    /// Returns the driven body of a step to `to`.
    fn body(&self, to: &Motion, h: f64) -> Result<RigidBody, Error> {
        let from = &self.motion;
        let mut body = RigidBody::new(1.0, Matrix3::identity(), from.position)?;
        body.rotation = from.rotation;
        body.velocity = (to.position - from.position) / h;
        body.angular_velocity = (to.rotation * from.rotation.inverse()).scaled_axis() / h;
        let mean = [body.velocity, body.angular_velocity];
        body.unsteadiness = [from, to].map(|end| [end.velocity - mean[0], end.spin - mean[1]]);
        body.free = [false; 6];
        Ok(body)
    }
}

impl Link {
    /// Splits and merges elements at reels, and finds the nodes of the ends anew.
    fn remesh(&mut self, cable: &mut ancf::Cable) -> Result<(), Error> {
        if !cable.has_reel() {
            return Ok(());
        }
        cable.remesh_reel()?;
        let [start, end] = [At::Start, At::End].map(|at| cable.reel_description(at).is_some());
        for own in &mut self.ends {
            own.node = match own.node {
                _ if own.is_last && end => cable.nodes() - 1,
                0 if start => 0,
                node => node.saturating_add_signed((cable.nodes_from_start() - own.from_start) as isize),
            };
            own.from_start = cable.nodes_from_start();
        }
        Ok(())
    }

    /// Refuses a cable whose ends are not where their bodies are: somebody else has moved it.
    fn check(&self, cable: &ancf::Cable) -> Result<(), lariat_rapier::Error> {
        for end in self.ends.iter().filter(|end| end.node < cable.nodes()) {
            let place = end.motion.position + end.motion.rotation * end.anchor;
            let gap = (cable.node_position(end.node) - place).norm();
            if gap > LARGEST_GAP {
                let cable = cable.name().to_string();
                return Err(lariat_rapier::Error::GapTooLong { cable, gap, limit: LARGEST_GAP });
            }
        }
        Ok(())
    }

    fn step(&mut self, cable: &mut ancf::Cable, to: &[Motion], h: f64) -> Result<Vec<Wrench>, lariat_rapier::Error> {
        self.remesh(cable)?;
        self.check(cable)?;
        let mut bodies = self.ends.iter().zip(to).map(|(end, to)| end.body(to, h)).collect::<Result<Vec<_>, _>>()?;
        let pins: Vec<PinConstraint> = self
            .ends
            .iter()
            .enumerate()
            .map(|(body, end)| PinConstraint {
                cable: 0,
                node: end.node,
                body,
                anchor: end.anchor,
                direction: end.direction,
            })
            .collect();
        let integrator = cable.integrator();
        self.island.step(&mut [cable], &mut bodies, &pins, integrator, h)?;
        let wrenches = self.ends.iter_mut().zip(to).zip(self.island.accounts());
        Ok(wrenches
            .map(|((end, to), account)| {
                let levers = [&end.motion, to].map(|motion| motion.rotation * end.anchor);
                let force = account.impulse / h;
                let moment = account.angular_impulse / h + (0.5 * (levers[0] + levers[1])).cross(&force);
                end.motion = *to;
                Wrench { force, moment, end_force: account.force, work: account.work }
            })
            .collect())
    }

    /// Returns Z; see the page of this module.
    fn impedance(&self, cable: &ancf::Cable, h: f64) -> Result<DMatrix<f64>, Raise> {
        let mut cable = cable.clone();
        for end in &self.ends {
            cable.detach(At::Node(end.node))?;
        }
        let (mass, stiffness, damping) = (cable.mass_matrix(), cable.stiffness_matrix(), cable.damping_matrix());
        let level = Level::new();
        let mut factorisation = Factorisation::default();
        let is_positive_definite = (0..=HALVINGS).any(|halving| {
            let share = 0.5f64.powi(halving);
            let mut a = combine(&mass, &damping, share * h, &stiffness, share * h * h);
            cable.apply_supports(&mut a);
            matches!(factorisation.factor(level, &a), Ok(Definiteness::PositiveDefinite))
        });
        let none = || {
            let message =
                format!("cable {:?}: no impedance at t = {} s for a step of {h} s", cable.name(), cable.time());
            Raise::new("ImpedanceError", message)
                .with("cable", cable.name())
                .with("time", cable.time())
                .with("value", h)
        };
        if !is_positive_definite {
            return Err(none());
        }
        let size = cable.positions().len();
        let (mut rows, mut maps) = (Vec::new(), Vec::new());
        for (i, end) in self.ends.iter().enumerate() {
            let lever = end.motion.rotation * end.anchor;
            for axis in 0..3 {
                let mut row = vec![0.0; size];
                row[6 * end.node + axis] = 1.0;
                rows.push(row);
                let unit = Vector3::ith(axis, 1.0);
                // (omega x lever) . unit = omega . (lever x unit)
                maps.push((i, unit, lever.cross(&unit)));
            }
            if end.direction.is_some() {
                let at = 6 * end.node + 3;
                let slope = Vector3::from_column_slice(&cable.positions()[at..at + 3]);
                let tangent = slope.normalize();
                let across = if tangent.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
                let first = tangent.cross(&across).normalize();
                for unit in [first, tangent.cross(&first)] {
                    let mut row = vec![0.0; size];
                    // omega . unit = unit . (t x t')/|t|^2
                    row[at..at + 3].copy_from_slice((unit.cross(&slope) / slope.norm_squared()).as_slice());
                    rows.push(row);
                    maps.push((i, Vector3::zeros(), unit));
                }
            }
        }
        let count = rows.len();
        let b = DMatrix::from_fn(count, size, |r, c| rows[r][c]);
        let mut columns = rows.concat();
        factorisation.solve_many(level, &mut columns, count);
        let compliance = &b * DMatrix::from_column_slice(size, count, &columns);
        let p = DMatrix::from_fn(count, 6 * self.ends.len(), |r, c| {
            let (end, linear, angular) = &maps[r];
            match c / 6 == *end {
                true if c % 6 < 3 => linear[c % 6],
                true => angular[c % 6 - 3],
                false => 0.0,
            }
        });
        let z = p.transpose() * compliance.try_inverse().ok_or_else(none)? * p;
        if z.iter().all(|x| x.is_finite()) { Ok(z) } else { Err(none()) }
    }
}

/// Returns `m + a c + b k`.
fn combine(m: &BlockTridiagonal, c: &BlockTridiagonal, a: f64, k: &BlockTridiagonal, b: f64) -> BlockTridiagonal {
    let mut sum = m.clone();
    let pairs = [(c, a), (k, b)];
    for (matrix, factor) in pairs {
        let blocks = matrix.diag.iter().chain(&matrix.lower);
        for (target, block) in sum.diag.iter_mut().chain(&mut sum.lower).zip(blocks) {
            target.0.iter_mut().flatten().zip(block.0.iter().flatten()).for_each(|(t, x)| *t += factor * x);
        }
    }
    sum
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

/// Returns the rotation of a quaternion x, y, z, w.
fn rotation(q: &[f64]) -> PyResult<UnitQuaternion<f64>> {
    finite("rotation (quaternion)", q)?;
    let q = Quaternion::new(q[3], q[0], q[1], q[2]);
    let norm = q.norm();
    if (norm - 1.0).abs() > 1e-3 {
        let (cable, what) = (None, "length of the quaternion".to_string());
        return Err(raise(Error::InvalidValue { cable, what, value: norm, expected: "1" }));
    }
    Ok(UnitQuaternion::from_quaternion(q))
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

#[pymethods]
impl CoSimulation {
    /// A co-simulation of this cable, which is from now on stepped by it.
    #[new]
    fn new(cable: Bound<'_, Cable>) -> PyResult<Self> {
        let own = cable.get().own("be part of a co-simulation")?.clone();
        Ok(CoSimulation { link: Shared::new(Link::default()), cable: own, object: cable.unbind() })
    }

    /// The cable.
    #[getter]
    fn cable(&self, py: Python<'_>) -> Py<Cable> {
        self.object.clone_ref(py)
    }

    /// Attaches a node to a body whose reference point is at `position` (m) with `rotation` (quaternion x, y, z, w), where the node is now;
    /// a clamp holds the direction of the tangent, too. Returns the index of the end.
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
            Some(q) if q.shape == [4] => self::rotation(&q.values)?,
            Some(q) => return Err(q.wrong_shape("(4,)")),
        };
        let (position, cable) = (position.0, self.cable.clone());
        let attached = self.link.compute(py, move |link| {
            let mut cable = cable.lock();
            let node = cable.node(at.0)?;
            if cable.support(At::Node(node))?.attached || link.ends.iter().any(|end| end.node == node) {
                return Err(lariat_rapier::Error::AlreadyAttached { cable: cable.name().to_string(), node });
            }
            let coordinates = Vector3::from_column_slice(&cable.positions()[6 * node + 3..6 * node + 6]);
            if clamp {
                cable.attach_clamped(At::Node(node))?;
            } else {
                cable.attach(At::Node(node))?;
            }
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

    /// Advances the cable by `dt` (s) while the bodies move to these poses: `positions` (ends, 3) in m, `rotations` (ends, 4) as x, y, z, w
    /// (default: as they are), `velocities` (ends, 3) in m/s and `angular_velocities` (ends, 3) in rad/s at the end of the step (default:
    /// uniform motion). Returns what the cable did to the bodies.
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
            let rotation = rotations.as_ref().map_or(Ok(end.motion.rotation), |q| rotation(&q[i]))?;
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
        let of = |read: fn(&Wrench) -> Vector3<f64>| vectors(py, &wrenches.iter().map(read).collect::<Vec<_>>());
        let work: Vec<f64> = wrenches.iter().map(|wrench| wrench.work).collect();
        let values = (of(|w| w.force)?, of(|w| w.moment)?, of(|w| w.end_force)?, numpy::PyArray1::from_vec(py, work));
        result(py, "EndForces", values)
    }

    /// Returns the impedance Z in kg, kg m and kg m^2 for a step of `dt` (s), shape (6 ends, 6 ends).
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

    /// Returns cable and ends as bytes; `from_bytes` continues the run bitwise.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let cable = self.cable.clone();
        let bytes = self.link.compute(py, move |link| rmp_serde::to_vec_named(&(&*cable.lock(), &link.ends)));
        let bytes = bytes.map_err(|error| raise(Raise::new("FormatError", error.to_string())))?;
        Ok(PyBytes::new(py, &[MAGIC.as_bytes(), &bytes].concat()))
    }

    /// Returns a co-simulation from the bytes of `to_bytes`, of the same version.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: Cow<'_, [u8]>) -> PyResult<Self> {
        let wrong = |problem: String| raise(Raise::new("FormatError", format!("not a saved co-simulation: {problem}")));
        let Some(body) = bytes.strip_prefix(MAGIC.as_bytes()) else {
            return Err(wrong(format!("it does not begin with {MAGIC:?}")));
        };
        let (cable, ends): (ancf::Cable, Vec<End>) =
            rmp_serde::from_slice(body).map_err(|error| wrong(error.to_string()))?;
        let object = Bound::new(py, Cable::new(cable))?;
        let cable = object.get().own("be part of a co-simulation")?.clone();
        Ok(CoSimulation { link: Shared::new(Link { ends, ..Link::default() }), cable, object: object.unbind() })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let restore = slf.get_type().getattr("from_bytes")?;
        Ok((restore, (slf.get().to_bytes(slf.py())?,)))
    }
}
