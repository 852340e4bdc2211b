//! What is read of a set and its world.
//!
//! | file | what it returns |
//! |---|---|
//! | [`totals`] | momentum and energy |
//! | [`warnings`], [`inside`] | warnings about cables in their world |
//! | `draw` | lines for Rapier's debug renderer |

#[cfg(feature = "debug-render")]
pub(crate) mod draw;
pub(crate) mod inside;
pub(crate) mod totals;
pub(crate) mod warnings;
