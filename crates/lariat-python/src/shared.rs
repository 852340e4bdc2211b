//! An object that several Python threads may use at once.

use pyo3::marker::Ungil;
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

/// A value behind a lock that is never held while Python runs.
pub struct Shared<T>(Arc<Mutex<T>>);

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Shared(Arc::clone(&self.0))
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

    /// Locks; only for a caller that has released the interpreter.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Returns the address, by which several are locked in one order.
    pub fn address(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }
}
