//! What is taken of parry: the tree that finds the near pieces of large scenes, and the chapter's black box. The only
//! folder that imports it.

pub(crate) mod black_box;
pub(crate) mod box_tree;
pub(crate) mod pieces;
