//! Bad scenes: each is refused with the line, the key and what is accepted, before anything is written.

mod bench;
mod bodies;
mod cables;
mod joints;
mod junctions;
