//! The pages of what a program steps itself; `lariat.record` has the arrays.

use crate::cable::Cable;
use crate::convert::Vector;
use crate::error::raise;
use crate::world::World;
use lariat_scene::view::{self, Series};
use pyo3::prelude::*;
use std::sync::{Mutex, MutexGuard};

/// Records frames, and gives the page.
#[pyclass(frozen, module = "lariat_cables._lariat")]
pub struct Film(Mutex<view::Film>);

impl Film {
    fn lock(&self) -> MutexGuard<'_, view::Film> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

#[pymethods]
impl Film {
    #[new]
    fn new(name: &str, gravity: Vector) -> Self {
        Film(Mutex::new(view::Film::new(name, gravity.0)))
    }

    /// Records the bodies and cables of a world.
    fn take_world(&self, py: Python<'_>, world: &World) -> PyResult<()> {
        let taken = world.0.compute(py, |contents| {
            let mut film = self.lock();
            for (body, name) in contents.body_names() {
                film.name_body(body, name);
            }
            film.take(contents.time, &contents.world, &contents.set)
        });
        taken.map_err(raise)
    }

    /// Records cables with their own obstacles.
    fn take_cables(&self, py: Python<'_>, cables: Vec<PyRef<'_, Cable>>) -> PyResult<()> {
        let copies = cables.iter().map(|cable| cable.copied(py)).collect::<PyResult<Vec<_>>>()?;
        let time = copies.first().map_or(0.0, lariat_ancf::Cable::time);
        let laid = cables.iter().flat_map(|cable| cable.obstacles(py));
        let obstacles: Vec<_> = laid.map(|laid| laid.look(time)).collect();
        py.detach(|| self.lock().take_cables(time, &copies, &obstacles)).map_err(raise)
    }

    /// The page that plays the motion, with series of (name, columns, rows) and lines of warnings.
    fn page(&self, py: Python<'_>, series: Vec<(String, Vec<String>, Vec<f64>)>, told: Vec<String>) -> String {
        let series: Vec<_> = series.into_iter().map(|(name, columns, rows)| Series { name, columns, rows }).collect();
        py.detach(|| self.lock().page(&series, &told))
    }

    /// The motion as an animated SVG.
    fn svg(&self, py: Python<'_>) -> String {
        py.detach(|| self.lock().svg())
    }
}
