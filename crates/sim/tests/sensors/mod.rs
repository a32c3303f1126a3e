//! Sensors in a run.

mod coded_sensors;
pub mod noise_streams;
pub mod own_sensors;
pub mod sensor_noise;
mod sightings;
