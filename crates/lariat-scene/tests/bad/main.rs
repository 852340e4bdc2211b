//! Invalid scenes: each is an error with the line, the key and what is accepted, before anything is written.

mod bodies;
mod cables;
mod cases;
mod joints;
mod junctions;
