//! The measurements of accuracy: the report and the paper's Table 1.

mod report;
mod table1;
