//! The matrix of pairs: every pair of features on a small scene, for half a second.
//!
//! | module | what it holds |
//! |---|---|
//! | [`feature`] | the features, and their pairs |
//! | [`draft`], [`scene`] | the drawing of a scene, and the world that it becomes |
//! | [`laws`] | what must hold: energy, momentum, snapshots, a finer run, parts that do not interact |
//! | [`limits`] | why a scene differs from its finer run |
//! | [`sleep`], [`given`] | the features beside sleep, and beside a given error |
//! | [`run`] | runs a pair, and judges it |
//! | [`reasons`] | why pairs are refused |
//! | [`misses`] | pairs that are known to be wrong, which the tests compare with |
//! | [`page`] | the matrix as a page and as CSV |

pub mod draft;
pub mod feature;
pub mod given;
pub mod laws;
pub mod limits;
pub mod misses;
pub mod page;
pub mod reasons;
pub mod run;
pub mod scene;
pub mod sleep;
