//! The examples of Lariat that need more than the mechanics are the example targets of this package.
