//! Time: the transport bar and the time line under the dashboard.

pub(crate) mod chance;
pub(crate) mod span;
pub(crate) mod time_line;
pub(crate) mod transport_bar;
mod way_out_sign;
