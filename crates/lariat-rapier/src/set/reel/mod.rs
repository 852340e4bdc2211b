//! Sheaves between cables and along one, and drums.

mod passing;
mod wheels;
