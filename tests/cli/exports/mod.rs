//! What runs are exported to, read back.

pub mod export;
pub mod format_list;
pub mod library_exports;
pub mod messages;
pub mod pages;
pub mod rerun;
pub mod stills;
pub mod viewer;
pub mod viewer_files;
