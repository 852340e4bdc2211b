//! Reading a cable.

use super::Cable;
use crate::convert::{Array, Place, object, result, table, vector, vectors};
use crate::integrator::Integrator;
use crate::section::Section;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::warning::Interface;
use lariat_ancf::{Sample, Vector3};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Returns the first or the last three of every six numbers.
fn halves(values: &[f64], from: usize) -> Vec<f64> {
    values.chunks_exact(6).flat_map(|node| [node[from], node[from + 1], node[from + 2]]).collect()
}

type Rows<'py> = PyResult<Bound<'py, PyArray2<f64>>>;

#[pymethods]
impl Cable {
    /// Name in errors.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |cable| Ok(cable.name().to_string()))
    }

    /// Time of the state in s.
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

    /// Rule of the elastic forces.
    #[getter]
    fn rule(&self, py: Python<'_>) -> PyResult<String> {
        self.read(py, |cable| Ok(cable.rule().to_string()))
    }

    /// The time integrator.
    #[getter]
    fn integrator(&self, py: Python<'_>) -> PyResult<Integrator> {
        self.read(py, |cable| Ok(Integrator(cable.integrator())))
    }

    /// Gravity in m/s^2, shape (3,).
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

    /// Reads the cable at one arc length (m), or at an array of them.
    fn sample<'py>(&self, py: Python<'py>, s: Array) -> PyResult<Bound<'py, PyAny>> {
        let Array { values, shape } = &s;
        if shape.len() > 1 {
            return Err(s.wrong_shape("() or (n,)"));
        }
        let samples = self.read(py, |cable| values.iter().map(|&s| cable.sample(s)).collect::<Result<Vec<_>, _>>())?;
        if let ([], [at]) = (&shape[..], &samples[..]) {
            let [position, velocity, slope] = [at.position, at.velocity, at.slope].map(|v| vector(py, &v));
            let [curvature, moment] = [at.curvature, at.moment].map(|v| vector(py, &v));
            return result(
                py,
                "Sample",
                (
                    values[0],
                    position,
                    velocity,
                    slope,
                    at.tension,
                    curvature,
                    moment,
                    at.green_strain,
                    at.tension_uncertainty,
                ),
            );
        }
        let numbers = |read: fn(&Sample) -> f64| PyArray1::from_iter(py, samples.iter().map(read));
        let rows = |read: fn(&Sample) -> Vector3<f64>| vectors(py, &samples.iter().map(read).collect::<Vec<_>>());
        let values = (
            PyArray1::from_slice(py, values),
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

    /// Warnings about the cable.
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.read(py, |cable| Ok(cable.warnings().iter().map(|warning| Interface::Python.text(warning)).collect()))
    }

    /// Arc length in m of the largest tension, and that tension in N.
    fn peak_tension(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.read(py, |cable| Ok(cable.peak_tension()))
    }

    /// Forces and moments of the supports on the cable.
    fn reactions<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let reactions = self.copied(py)?.reactions().map_err(crate::error::raise)?;
        let one =
            |r: &lariat_ancf::Reaction| result(py, "Reaction", (r.node, vector(py, &r.force), vector(py, &r.moment)));
        reactions.iter().map(one).collect()
    }

    /// Energies in J.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let energy = self.read(py, |cable| Ok(cable.energy()))?;
        result(py, "Energy", (energy.kinetic, energy.axial, energy.bending, energy.gravity, energy.torsion))
    }

    /// Torque and twist between each two neighbouring clamps that hold the spin.
    fn torsion<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let readings = self.read(py, |cable| Ok(cable.torsion()))?;
        let nodes = |nodes: [usize; 2]| (nodes[0], nodes[1]);
        readings.iter().map(|r| result(py, "Twist", (nodes(r.nodes), r.twist, r.torque, r.twist_rate))).collect()
    }

    /// Linear momentum in kg m/s, and angular momentum about the origin in kg m^2/s.
    fn momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let momentum = self.read(py, |cable| Ok(cable.momentum()))?;
        result(py, "Momentum", (vector(py, &momentum.linear), vector(py, &momentum.angular)))
    }

    /// Estimate of the largest error of position by the mesh in m, and largest turn in rad of an element that no node judges.
    fn mesh_indicator<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let indicator = self.read(py, |cable| Ok(cable.mesh_indicator()))?;
        result(py, "MeshIndicator", (indicator.position, indicator.turn))
    }

    /// Angular frequencies in rad/s of small motions about the present state, ascending.
    fn natural_frequencies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut cable = self.copied(py)?;
        Ok(PyArray1::from_vec(py, py.detach(|| cable.natural_frequencies())))
    }

    /// Kelvin-Voigt times in s (axial, bending) that damp a mode by this ratio.
    fn damping_at_mode<'py>(&self, py: Python<'py>, ratio: f64, mode: usize) -> PyResult<Bound<'py, PyAny>> {
        let mut cable = self.copied(py)?;
        let damping = py.detach(|| cable.damping_at_mode(ratio, mode)).map_err(crate::error::raise)?;
        py.import("lariat.effects")?.getattr("Damping")?.call1((damping.axial, damping.bending))
    }

    /// Effects that are on, by key.
    #[getter]
    fn effects<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = self.read(py, |cable| Ok(serde_json::to_value(cable.effects())))?;
        let value = value.map_err(|e| crate::error::raise(crate::error::Raise::new("EffectsError", e.to_string())))?;
        py.import("lariat.effects")?.getattr("build")?.call1((object(py, &value)?,))
    }

    /// Counts of steps, iterations and evaluations.
    fn diagnostics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = self.read(py, |cable| Ok(serde_json::to_value(cable.diagnostics())))?;
        object(py, &value.unwrap_or_default())
    }

    /// Returns the number of the node at a point.
    fn node(&self, py: Python<'_>, at: Place) -> PyResult<usize> {
        self.read(py, |cable| cable.node(at.0))
    }

    /// Copies the nodal coordinates into an array of shape (nodes, 6) that is given: nothing is allocated.
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
