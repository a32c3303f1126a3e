//! Motions: proven free, or where they first hit.

pub(crate) mod bisection;
pub(crate) mod certificate;
pub(crate) mod closed_form;
pub(crate) mod conservative_advancement;
pub(crate) mod decide;
pub(crate) mod keeps;
pub(crate) mod lanes;
pub(crate) mod limits;
pub(crate) mod local_march;
pub(crate) mod local_scene;
pub(crate) mod place;
pub(crate) mod separation;
pub(crate) mod step;
pub(crate) mod swept;
pub(crate) mod verdict;
pub(crate) mod verifier;
