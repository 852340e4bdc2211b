//! Cables with torsion, in statics and in motion.

mod motion;
mod statics;
