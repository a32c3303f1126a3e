//! Sensors in a run.

mod coded_sensors;
mod fans;
pub mod noise_streams;
pub mod own_sensors;
pub mod sensor_noise;
mod sightings;
