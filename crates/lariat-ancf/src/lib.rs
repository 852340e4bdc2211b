//! Cable mechanics after the absolute nodal coordinate formulation (ANCF).

pub mod linalg;
