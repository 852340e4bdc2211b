//! `lariat import`: models of MuJoCo beside MuJoCo's own motion, and its whole schema.

mod kinds;
mod models;
mod schema;
