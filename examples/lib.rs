//! The examples of Lariat that need more than the mechanics are the example targets of this package; the code of the README and of the
//! guides is compiled and run as its documentation tests.

/// Runs the code of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
