//! Cables and rigid bodies as one system, without an engine: against independent solutions,
//! conservation laws and statics.

#[path = "../common/mod.rs"]
mod common;

mod bench;
mod carried;
mod clamp;
mod driven;
mod momentum;
mod order;
mod payload;
mod pins;
mod reference;
mod shapes;
mod spin;
mod statics;
mod stretches;
mod thrown;
