//! An object that several Python threads may use at once.

use pyo3::marker::Ungil;
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::time::{Duration, Instant};

/// A value behind a lock that is never held while Python runs.
pub struct Shared<T>(Arc<Mutex<T>>);

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Shared(Arc::clone(&self.0))
    }
}

impl<T: Default + Send> Default for Shared<T> {
    fn default() -> Self {
        Shared::new(T::default())
    }
}

/// Longest time between two looks for signals.
const UNHEARD: Duration = Duration::from_millis(50);

/// Calls `f` as often as is left, until it fails or that time is over.
pub fn repeat_for_a_while<E>(left: &mut usize, mut f: impl FnMut() -> Result<(), E>) -> Result<(), E> {
    let begin = Instant::now();
    loop {
        f()?;
        *left -= 1;
        if *left == 0 || begin.elapsed() > UNHEARD {
            return Ok(());
        }
    }
}

impl<T: Send> Shared<T> {
    /// Makes a value shared.
    pub fn new(value: T) -> Self {
        Shared(Arc::new(Mutex::new(value)))
    }

    /// Reads or changes the value at once; `f` is short, and uses no Python.
    pub fn with<R: Ungil + Send>(&self, py: Python<'_>, f: impl FnOnce(&mut T) -> R + Ungil + Send) -> R {
        match self.0.try_lock() {
            Ok(mut guard) => f(&mut guard),
            Err(TryLockError::Poisoned(poisoned)) => f(&mut poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => self.compute(py, f),
        }
    }

    /// Computes with the value while other threads run Python.
    pub fn compute<R: Ungil + Send>(&self, py: Python<'_>, f: impl FnOnce(&mut T) -> R + Ungil + Send) -> R {
        py.detach(|| f(&mut self.lock()))
    }

    /// Calls `f` this many times, until it fails, and looks for signals of the process (Ctrl-C) in between.
    pub fn repeat<E: Ungil + Send>(
        &self,
        py: Python<'_>,
        times: usize,
        mut f: impl FnMut(&mut T) -> Result<(), E> + Ungil + Send,
    ) -> PyResult<Result<(), E>> {
        let mut left = times;
        while left > 0 {
            let outcome = self.compute(py, |value| repeat_for_a_while(&mut left, || f(value)));
            if outcome.is_err() {
                return Ok(outcome);
            }
            py.check_signals()?;
        }
        Ok(Ok(()))
    }

    /// Locks; only for a caller that has released the interpreter.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Returns the address, by which several are locked in one order.
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }
}
