//! One spatial two-node ANCF cable element with 12 nodal coordinates (r_i, t_i, r_j, t_j), t =
//! dr/dx.
//!
//! - [`gram`]: control vectors, Gram numbers, and how a scalar function of them becomes force and
//!   tangent
//! - [`kernel`]: energy, force and tangent of an element for any pair of rules, over any
//!   [`Real`](crate::Real)
//! - [`shape`]: shape functions and their derivatives
//! - [`mass`]: the consistent mass matrix in closed form
//! - `assembly`: forces at points, added to the coordinates of the nodes
//! - [`axial`], [`bending`]: one file per rule of the elastic forces
//! - `variable_length`: the element of 13 coordinates, into which material flows
//! - `side`: the end of the cable at which it is

pub(crate) mod assembly;
pub mod axial;
pub mod bending;
pub mod gram;
pub mod kernel;
pub mod mass;
pub mod shape;
pub(crate) mod side;
pub mod step;
pub(crate) mod variable_length;
