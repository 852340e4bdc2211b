//! What Lariat costs and how accurate it is, measured: the report, the hard cases, the paper's Table 1.
//!
//! | module | what it holds |
//! |---|---|
//! | [`report`] | accuracy against cost: `lariat report` |
//! | [`stability`] | hard cases: `lariat stability` |
//! | [`table1`] | the paper's Table 1, measured: `lariat table1` |

mod error;
pub mod machine;
pub mod report;
pub mod stability;
pub mod table1;

pub use error::Error;
