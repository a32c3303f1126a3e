//! Edges, arcs and sweeps: whether motions are free, and their proofs.

mod angles;
mod any_robot;
mod arcs;
mod certificates;
mod edges;
mod jackknife;
mod proofs;
mod rates;
mod sweeps;
mod tangents;
mod trailer;
mod verdicts;
