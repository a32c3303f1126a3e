//! What both WebAssembly builds tell a page of Query.

use serde_json::{Value, json};

use motion_lab_core::configuration::Configuration;
use motion_lab_core::picture::readout;
use motion_lab_sim::anatomy::Anatomy;

/// Query's question, robot and answer, as a page hears them.
pub fn query_value(query: &Anatomy) -> Value {
    let q = query.q();
    json!({
        "tab": query.tab.name(), "configuration": readout(&q.to_string()), "coordinates": &q.coordinates()[..],
        "intersects": query.intersects(), "distance": query.distance(),
    })
}
