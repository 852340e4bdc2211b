//! Hard cases stay numerically stable: one file per family; the cases are those of `lariat stability`.

mod changes;
mod collapse;
mod compression;
mod faults;
mod jam;
mod limp;
mod long;
mod many;
mod mass_ratio;
mod mechanisms;
mod random;
mod scale;
mod snatch;
mod stiffness;
mod suite;
mod whip;
