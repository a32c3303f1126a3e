//! Readings drawn from a [`BeamModel`], the noise of a real range finder.

use crate::num::{exp, ln};
use crate::random::{DRAWS_PER_INDEX, Stream};
use crate::worlds::{BeamModel, RangeSensor};

/// How many draws a reading takes: one for its kind, one for its place, two for a normal number.
const DRAWS: u64 = 4;

impl BeamModel {
    /// The noisy readings for the exact `ranges` of `sensor` at tick `tick`, drawn from `stream`.
    ///
    /// Every ray draws from its own place in the stream, so a reading depends on the seed, the stream's name, the tick
    /// and the ray only. Hits are kept in [0, R]. A ray whose exact range is infinite has neither a hit nor a short
    /// return: it reads infinity, R or a random range. A reading is never negative.
    pub fn apply(&self, sensor: &RangeSensor, ranges: &[f64], stream: &Stream, tick: u64) -> Vec<f64> {
        let mut readings = ranges.to_vec();
        self.apply_to(sensor, &mut readings, stream, tick);
        readings
    }

    /// As [`apply`](Self::apply), in place of the exact ranges.
    pub fn apply_to(&self, sensor: &RangeSensor, ranges: &mut [f64], stream: &Stream, tick: u64) {
        // ray k's draws begin at index tick n + k; the indices follow one another, so the stream is walked, not sought
        let mut draws = stream.at(tick * u64::from(sensor.n_rays));
        for range in ranges {
            *range = self.reading(*range, sensor.max_range, &mut draws);
            (DRAWS..DRAWS_PER_INDEX).for_each(|_| _ = draws.bits());
        }
    }

    fn reading(&self, exact: f64, max_range: f64, draws: &mut Stream) -> f64 {
        // every ray makes the same DRAWS draws, whatever becomes of them
        let (mut choice, u, noise) = (draws.unit(), draws.unit(), draws.normal());
        let mut falls_to = |probability: f64| {
            let chosen = choice < probability;
            choice -= probability;
            chosen
        };
        if falls_to(self.z_miss) {
            return f64::INFINITY;
        }
        if falls_to(self.z_max) {
            return max_range;
        }
        if falls_to(self.z_rand) {
            return u * max_range;
        }
        if exact.is_infinite() {
            return exact;
        }
        if falls_to(self.z_short) {
            // the inverse of the exponential distribution's function, cut off at the exact range
            let mass = 1.0 - exp(-self.lambda_short * exact);
            return -ln(1.0 - u * mass) / self.lambda_short + 0.0;
        }
        (exact + self.sigma_hit * noise).clamp(0.0, max_range)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Seed;

    const SENSOR: RangeSensor = RangeSensor { n_rays: 50_000, max_range: 4.0 };

    fn readings(model: BeamModel, exact: f64) -> Vec<f64> {
        let stream = Stream::new(Seed(2005), "rusty/beam");
        model.try_new().unwrap().apply(&SENSOR, &vec![exact; 50_000], &stream, 3)
    }

    #[test]
    fn an_exact_model_changes_nothing() {
        assert_eq!(readings(BeamModel::EXACT, 2.5), vec![2.5; 50_000]);
    }

    #[test]
    fn each_kind_of_reading_comes_as_often_as_its_probability() {
        let model =
            BeamModel { sigma_hit: 0.05, z_short: 0.1, lambda_short: 1.0, z_miss: 0.03, z_max: 0.02, z_rand: 0.0 };
        let all = readings(model, 2.0);
        let share = |f: &dyn Fn(f64) -> bool| all.iter().filter(|r| f(**r)).count() as f64 / 50_000.0;
        // five standard deviations of a share p of 50,000 draws: 5 sqrt(p (1 - p) / 50,000)
        assert!((share(&|r| r.is_infinite()) - 0.03).abs() < 0.004);
        assert!((share(&|r| r == 4.0) - 0.02).abs() < 0.0032);
        // short returns below 1.5 m (ten sigma from the hits): their share times (1 - e^-1.5) / (1 - e^-2)
        let (e_1_5, e_2) = (0.223_130_160_148_429_8, 0.135_335_283_236_612_7); // e^-1.5, e^-2
        let below = 0.1 * (1.0 - e_1_5) / (1.0 - e_2);
        assert!((share(&|r| r < 1.5) - below).abs() < 0.007, "{} {below}", share(&|r| r < 1.5));
        let hits: Vec<f64> = all.iter().copied().filter(|r| (1.5..3.9).contains(r)).collect();
        assert!(hits.len() > 40_000);
    }

    #[test]
    fn hits_are_normal_about_the_exact_range() {
        let all = readings(BeamModel { sigma_hit: 0.1, ..BeamModel::EXACT }, 2.0);
        let mean = all.iter().sum::<f64>() / 50_000.0;
        let variance = all.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / 50_000.0;
        assert!(
            (mean - 2.0).abs() < 5.0 * 0.1 / 223.6 && (variance - 0.01).abs() < 5.0 * 0.01 * 0.0064,
            "{mean} {variance}"
        );
    }

    #[test]
    fn a_ray_draws_from_its_own_place_in_the_stream() {
        let model = BeamModel { sigma_hit: 0.1, z_rand: 0.5, ..BeamModel::EXACT };
        let stream = Stream::new(Seed(7), "a");
        let sensor = RangeSensor { n_rays: 9, max_range: 4.0 };
        let scan = model.apply(&sensor, &[1.0; 9], &stream, 5);
        for k in 0..9 {
            let alone = model.reading(1.0, 4.0, &mut stream.at(5 * 9 + k));
            assert_eq!(scan[k as usize], alone, "ray {k}");
        }
    }

    #[test]
    fn nothing_in_range_stays_infinite_and_every_tick_draws_anew() {
        let model = BeamModel { sigma_hit: 0.1, z_short: 0.5, ..BeamModel::EXACT };
        assert!(readings(model, f64::INFINITY).iter().all(|r| r.is_infinite()));
        let stream = Stream::new(Seed(1), "a");
        let at = |tick| model.apply(&RangeSensor { n_rays: 8, max_range: 4.0 }, &[1.0; 8], &stream, tick);
        assert_ne!(at(1), at(2));
        assert_eq!(at(1), at(1));
    }
}
