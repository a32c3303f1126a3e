//! The black box: parry by the contract of the trait, where it errs, and what that does to a path.

mod contract;
mod crossing;
mod figures;
mod grazing;
mod turning;
