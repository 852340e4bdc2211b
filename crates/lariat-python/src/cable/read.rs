//! Reading a cable.

use super::Cable;
use crate::convert::{Array, Count, Place, Places, node, object, result, table, vector, vectors};
use crate::integrator::Integrator;
use crate::section::Section;
use crate::told::unexplained;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::warning::Interface;
use lariat_ancf::{At, Sample, TorsionReading, Vector3};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Returns the first or the last three of every six numbers.
fn halves(values: &[f64], from: usize) -> Vec<f64> {
    values.chunks_exact(6).flat_map(|node| [node[from], node[from + 1], node[from + 2]]).collect()
}

/// Returns the points of an array or a sequence; None for a single point.
fn places(at: &Bound<'_, PyAny>) -> PyResult<Option<Vec<At>>> {
    if at.is_instance_of::<PyString>() || at.len().is_err() {
        return Ok(None);
    }
    if at.hasattr("dtype")? {
        let array: Array = at.extract()?;
        if array.shape.len() > 1 {
            return Err(array.wrong_shape("() or (n,)"));
        }
        let kind: String = at.getattr("dtype")?.getattr("kind")?.extract()?;
        if kind == "f" {
            return Ok(Some(array.values.into_iter().map(At::ArcLength).collect()));
        }
    }
    Ok(Some(at.extract::<Places>()?.0))
}

type Rows<'py> = PyResult<Bound<'py, PyArray2<f64>>>;

#[pymethods]
impl Cable {
    /// Name in errors.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |cable| Ok(cable.name().to_string()))
    }

    /// Time of the state in s. Set: prescribed motions and ramps keep their distance from it;
    /// raises InWorldError, InvalidValueError.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        self.read(py, |cable| Ok(cable.time()))
    }

    /// Unstretched length in m.
    #[getter]
    fn length(&self, py: Python<'_>) -> PyResult<f64> {
        self.read(py, |cable| Ok(cable.length()))
    }

    /// Number of elements.
    #[getter]
    fn elements(&self, py: Python<'_>) -> PyResult<usize> {
        self.read(py, |cable| Ok(cable.elements().len()))
    }

    /// Number of nodes: one more than elements.
    #[getter]
    fn nodes(&self, py: Python<'_>) -> PyResult<usize> {
        self.read(py, |cable| Ok(cable.nodes()))
    }

    /// Sections by element.
    #[getter]
    fn sections(&self, py: Python<'_>) -> PyResult<Vec<Section>> {
        self.read(py, |cable| Ok(cable.elements().iter().map(|element| Section(element.section)).collect()))
    }

    /// Arc lengths of the nodes in m, shape (nodes,).
    #[getter]
    fn arc_lengths<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_vec(py, self.read(py, |cable| Ok(cable.node_arc_lengths()))?))
    }

    /// Rule of the elastic forces. Set: raises UnknownRuleError, RankDeficientError,
    /// MissingForEffectError.
    #[getter]
    fn rule(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |cable| Ok(cable.rule().to_string()))
    }

    /// The time integrator. Set to an Integrator or the name of a fidelity: raises
    /// ExplicitDampingError.
    #[getter]
    fn integrator(&self, py: Python<'_>) -> PyResult<Integrator> {
        self.read(py, |cable| Ok(Integrator(cable.integrator())))
    }

    /// Gravity in m/s^2, shape (3,). Set: raises ShapeError, InvalidValueError.
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(vector(py, &self.read(py, |cable| Ok(cable.gravity()))?))
    }

    /// Positions of the nodes in m, shape (nodes, 3).
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> Rows<'py> {
        table(py, self.read(py, |cable| Ok(halves(cable.positions(), 0)))?, 3)
    }

    /// Slope vectors dr/ds of the nodes, shape (nodes, 3).
    #[getter]
    fn slopes<'py>(&self, py: Python<'py>) -> Rows<'py> {
        table(py, self.read(py, |cable| Ok(halves(cable.positions(), 3)))?, 3)
    }

    /// Velocities of the nodes in m/s, shape (nodes, 3).
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> Rows<'py> {
        table(py, self.read(py, |cable| Ok(halves(cable.velocities(), 0)))?, 3)
    }

    /// Nodal coordinates, shape (nodes, 6): position in m and slope.
    #[getter]
    fn coordinates<'py>(&self, py: Python<'py>) -> Rows<'py> {
        table(py, self.read(py, |cable| Ok(cable.positions().to_vec()))?, 6)
    }

    /// Rates of the nodal coordinates, shape (nodes, 6): m/s and 1/s.
    #[getter]
    fn rates<'py>(&self, py: Python<'py>) -> Rows<'py> {
        table(py, self.read(py, |cable| Ok(cable.velocities().to_vec()))?, 6)
    }

    /// Reads the cable at one point, or at several: a sequence of points, or an array of arc
    /// lengths in m of shape (n,). Raises OutOfRangeError, ShapeError, AmbiguousPlaceError.
    fn sample<'py>(&self, py: Python<'py>, at: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let read = |places: &[At]| {
            self.read(py, |cable| {
                let one = |at: &At| cable.arc_length(*at).and_then(|s| Ok((s, cable.sample(s)?)));
                places.iter().map(one).collect::<Result<Vec<(f64, Sample)>, _>>()
            })
        };
        let Some(places) = places(at)? else {
            let Place(at) = at.extract()?;
            let Some((s, at)) = read(&[at])?.pop() else { return Ok(py.None().into_bound(py)) };
            let [position, velocity, slope] = [at.position, at.velocity, at.slope].map(|v| vector(py, &v));
            let [curvature, moment] = [at.curvature, at.moment].map(|v| vector(py, &v));
            let values =
                (s, position, velocity, slope, at.tension, curvature, moment, at.green_strain, at.tension_uncertainty);
            return result(py, "Sample", values);
        };
        let (values, samples): (Vec<f64>, Vec<Sample>) = read(&places)?.into_iter().unzip();
        let numbers = |read: fn(&Sample) -> f64| PyArray1::from_iter(py, samples.iter().map(read));
        let rows = |read: fn(&Sample) -> Vector3<f64>| vectors(py, &samples.iter().map(read).collect::<Vec<_>>());
        let values = (
            PyArray1::from_vec(py, values),
            rows(|at| at.position)?,
            rows(|at| at.velocity)?,
            rows(|at| at.slope)?,
            numbers(|at| at.tension),
            rows(|at| at.curvature)?,
            rows(|at| at.moment)?,
            numbers(|at| at.green_strain),
            numbers(|at| at.tension_uncertainty),
        );
        result(py, "Samples", values)
    }

    /// Returns what the cable says about its mesh, steps, energy, law and sizes, in all its steps;
    /// what is beyond the ``warn_level`` of its world, of its present shape.
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.read(py, |cable| Ok(unexplained(cable).iter().map(|warning| Interface::Python.text(warning)).collect()))
    }

    /// Returns the arc length in m of the largest tension, and that tension in N.
    fn peak_tension(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.read(py, |cable| Ok(cable.peak_tension()))
    }

    /// Returns forces and moments of the supports on the cable, by ascending node. Raises
    /// StepFailedError.
    fn reactions<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let reactions = self.copied(py)?.reactions().map_err(crate::error::raise)?;
        let one = |r: &lariat_ancf::Reaction| {
            result(py, "Reaction", (node(py, r.node)?, vector(py, &r.force), vector(py, &r.moment)))
        };
        reactions.iter().map(one).collect()
    }

    /// Returns kinetic, axial, bending, gravity and torsion energy in J.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let energy = self.read(py, |cable| Ok(cable.energy()))?;
        result(py, "Energy", (energy.kinetic, energy.axial, energy.bending, energy.gravity, energy.torsion))
    }

    /// Returns torque and twist between each two neighbouring clamps that hold the spin.
    fn torsion<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let readings = self.read(py, |cable| Ok(cable.torsion()))?;
        let one = |r: &TorsionReading| {
            let nodes = (node(py, r.nodes[0])?, node(py, r.nodes[1])?);
            result(py, "Twist", (nodes, r.twist, r.torque, r.twist_rate))
        };
        readings.iter().map(one).collect()
    }

    /// Returns linear momentum in kg m/s, and angular momentum about the origin in kg m^2/s.
    fn momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let momentum = self.read(py, |cable| Ok(cable.momentum()))?;
        result(py, "Momentum", (vector(py, &momentum.linear), vector(py, &momentum.angular)))
    }

    /// Returns what the shape says about the error of the mesh.
    fn mesh_indicator<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let indicator = self.read(py, |cable| Ok(cable.mesh_indicator()))?;
        result(py, "MeshIndicator", (indicator.position, indicator.turn))
    }

    /// Returns the angular frequencies in rad/s of small motions about the present state,
    /// ascending. Dense: for hundreds of nodes.
    fn natural_frequencies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut cable = self.copied(py)?;
        Ok(PyArray1::from_vec(py, py.detach(|| cable.natural_frequencies())))
    }

    /// Returns the damping that damps the ``mode``-th frequency, from 1, by this ratio of critical.
    /// Raises OutOfRangeError.
    fn damping_at_mode<'py>(&self, py: Python<'py>, ratio: f64, mode: Count) -> PyResult<Bound<'py, PyAny>> {
        let mut cable = self.copied(py)?;
        let damping = py.detach(|| cable.damping_at_mode(ratio, mode.0)).map_err(crate::error::raise)?;
        py.import("lariat_cables.effects")?.getattr("Damping")?.call1((damping.axial, damping.bending))
    }

    /// Effects that are on, by key. Set to an effect, a list of them or a dict: replaces all;
    /// raises EffectsError, MissingForEffectError, ExplicitDampingError.
    #[getter]
    fn effects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = self.read(py, |cable| Ok(serde_json::to_value(cable.effects())))?;
        let value = value.map_err(|e| crate::error::raise(crate::error::Raise::new("EffectsError", e.to_string())))?;
        py.import("lariat_cables.effects")?.getattr("build")?.call1((object(py, &value)?,))
    }

    /// Returns counts of steps, iterations and evaluations.
    fn diagnostics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = self.read(py, |cable| Ok(serde_json::to_value(cable.diagnostics())))?;
        object(py, &value.unwrap_or_default())
    }

    /// Returns the node at a point. Raises OutOfRangeError, NoNodeError.
    fn node<'py>(&self, py: Python<'py>, at: Place) -> PyResult<Bound<'py, PyAny>> {
        node(py, self.read(py, |cable| cable.node(at.0))?)
    }

    /// Copies the nodal coordinates into a contiguous array of shape (nodes, 6). Raises ShapeError.
    fn read_into(&self, py: Python<'_>, coordinates: &Bound<'_, PyArray2<f64>>) -> PyResult<()> {
        let mut writable = coordinates.try_readwrite().map_err(PyErr::from)?;
        let nodes = self.nodes(py)?;
        let shape = coordinates.shape().to_vec();
        // in Fortran's order the numbers lie otherwise
        let fits = shape == [nodes, 6] && coordinates.is_c_contiguous();
        let Some(target) = writable.as_slice_mut().ok().filter(|_| fits) else {
            let array = Array { values: Vec::new(), shape };
            return Err(array.wrong_shape(&format!("({nodes}, 6), contiguous")));
        };
        self.read(py, |cable| {
            // the number of nodes may have changed since
            let n = target.len().min(cable.positions().len());
            target[..n].copy_from_slice(&cable.positions()[..n]);
            Ok(())
        })
    }
}
