//! Several cables in one call: stepped on all threads or in one system, and read as arrays.

use super::{Cable, tell};
use crate::convert::{Count, result};
use crate::error::{Raise, raise};
use crate::shared::{Shared, repeat_for_a_while};
use lariat_ancf as ancf;
use lariat_ancf::coupling::Coupling;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// Cables that are stepped in one call, each with its place in the call, in one order for all threads, so that none waits for one that
/// waits for it.
fn apart(cables: &[Bound<'_, Cable>]) -> PyResult<Vec<(Shared<ancf::Cable>, usize)>> {
    let mut own = Vec::new();
    for (index, cable) in cables.iter().enumerate() {
        own.push((cable.get().own("step by itself")?.clone(), index));
    }
    own.sort_by_key(|(cable, _)| cable.address());
    if own.windows(2).any(|pair| pair[0].0.address() == pair[1].0.address()) {
        return Err(raise(Raise::new("DuplicateCableError", "the same cable is given twice")));
    }
    Ok(own)
}

/// Returns the states of cables as arrays, without a step; cables of worlds, too. Raises
/// NoCableError.
#[pyfunction]
pub fn states<'py>(py: Python<'py>, cables: Vec<Bound<'py, Cable>>) -> PyResult<Bound<'py, PyAny>> {
    let (mut times, mut nodes, mut read) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new()]);
    for cable in &cables {
        let one = |cable: &ancf::Cable| Ok((cable.time(), cable.positions().to_vec(), cable.velocities().to_vec()));
        let (time, coordinates, rates) = cable.get().read(py, one)?;
        times.push(time);
        nodes.push((coordinates.len() / 6) as i64);
        read[0].push(coordinates);
        read[1].push(rates);
    }
    let most = nodes.iter().max().map_or(0, |most| *most as usize);
    let fill = |of: &[Vec<f64>]| {
        let mut all = vec![f64::NAN; of.len() * most * 6];
        for (row, values) in all.chunks_exact_mut((most * 6).max(1)).zip(of) {
            row[..values.len()].copy_from_slice(values);
        }
        PyArray1::from_vec(py, all).reshape([of.len(), most, 6])
    };
    let [coordinates, rates] = &read;
    let (coordinates, rates) = (fill(coordinates)?, fill(rates)?);
    result(py, "States", (coordinates, rates, PyArray1::from_vec(py, times), PyArray1::from_vec(py, nodes)))
}

/// Advances cables that nothing connects by ``steps`` steps of ``dt`` (s), on all threads, and
/// returns their states as arrays. Warns as ``Cable.step`` does, once for all. Raises
/// StepFailedError, that of the first cable that cannot step, after all others have made that step;
/// DuplicateCableError, InWorldError.
#[pyfunction]
#[pyo3(signature = (cables, dt, *, steps=Count(1)), text_signature = "(cables, dt, *, steps=1)")]
pub fn step_all<'py>(
    py: Python<'py>,
    cables: Vec<Bound<'py, Cable>>,
    dt: f64,
    steps: Count,
) -> PyResult<Bound<'py, PyAny>> {
    let own = apart(&cables)?;
    let mut left = steps.0;
    while left > 0 {
        let outcome = py.detach(|| {
            let mut guards: Vec<_> = own.iter().map(|(cable, _)| cable.lock()).collect();
            let mut cables: Vec<&mut ancf::Cable> = guards.iter_mut().map(|guard| &mut **guard).collect();
            repeat_for_a_while(&mut left, || ancf::step_all(&mut cables, dt))
        });
        outcome.map_err(|error| {
            let mut failures: Vec<_> = error.failures.into_iter().map(|(i, error)| (own[i].1, error)).collect();
            failures.sort_by_key(|(index, _)| *index);
            raise(failures.swap_remove(0).1)
        })?;
        py.check_signals()?;
    }
    tell(py, cables.iter().map(Bound::get))?;
    states(py, cables)
}

/// Advances cables that may touch each other (``Contact(cables=True)``) by ``steps`` steps of
/// ``dt`` (s), in one system, with the integrator of the first. Warns as ``Cable.step`` does, once
/// for all. Raises DuplicateCableError, EmptyIslandError, TimeMismatchError, StepFailedError; the
/// steps before a failed one are made.
#[pyfunction]
#[pyo3(signature = (cables, dt, *, steps=Count(1)), text_signature = "(cables, dt, *, steps=1)")]
pub fn step_together(py: Python<'_>, cables: Vec<Bound<'_, Cable>>, dt: f64, steps: Count) -> PyResult<()> {
    let own = apart(&cables)?;
    let (mut left, mut island) = (steps.0, ancf::island::Island::default());
    while left > 0 {
        let outcome = py.detach(|| {
            let mut guards: Vec<_> = own.iter().map(|(cable, place)| (cable.lock(), *place)).collect();
            guards.sort_by_key(|(_, place)| *place);
            let mut cables: Vec<&mut ancf::Cable> = guards.iter_mut().map(|(guard, _)| &mut **guard).collect();
            let integrator = cables.first().ok_or(ancf::Error::EmptyIsland)?.integrator();
            repeat_for_a_while(&mut left, || {
                cables.iter_mut().try_for_each(|cable| cable.remesh_reel())?;
                island.step(&mut cables, &mut [], &[], integrator, dt)?;
                cables.iter_mut().for_each(|cable| cable.note_host_step(false, |_| ()));
                Ok::<_, ancf::Error>(())
            })
        });
        outcome.map_err(raise)?;
        py.check_signals()?;
    }
    tell(py, cables.iter().map(Bound::get))
}
