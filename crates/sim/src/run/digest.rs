//! `Digest` of a frame, and of a whole run.

use xxhash_rust::xxh3::{Xxh3, xxh3_128};

use super::{DT, Frame, Recipe};

/// The xxh3-128 hash of the canonical encoding of a frame or of a whole run. Prints as 32 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest(pub u128);

impl std::fmt::Display for Digest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// A text that is no digest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a digest has 32 hexadecimal digits, as `record` prints it")]
pub struct DigestError;

impl std::str::FromStr for Digest {
    type Err = DigestError;

    /// Reads 32 hexadecimal digits, in small letters or capitals.
    fn from_str(text: &str) -> Result<Self, DigestError> {
        let is_one = text.len() == 32 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let number = if is_one { u128::from_str_radix(text, 16).ok() } else { None };
        number.map(Digest).ok_or(DigestError)
    }
}

impl Frame {
    /// The digest of the frame's [canonical encoding](Frame::encode).
    pub fn digest(&self) -> Digest {
        self.digest_in(&mut Vec::with_capacity(self.encoded_length()))
    }

    /// As [`digest`](Self::digest), with a buffer for the encoding.
    pub(super) fn digest_in(&self, room: &mut Vec<u8>) -> Digest {
        room.clear();
        self.encode(room);
        Digest(xxh3_128(room))
    }
}

/// The digest of a run up to its latest tick. Equal digests mean equal runs, in every bit of every frame.
///
/// The hash covers, in this order (words are 64 bits, little-endian):
/// 1. the 16 bytes `motion-lab run 1`;
/// 2. words: the seed, the bits of [`DT`], the configured number of ticks;
/// 3. words: 0 without a sensor; or 1, the number of rays, the bits of the range;
/// 4. a word: the number of worlds; for each, its content hash as 16 bytes, little-endian;
/// 5. a word: the length in bytes of the script's canonical text; the text;
/// 6. the encoding of the initial frame, then of each tick's frame, in order of ticks.
///
/// It does not depend on the container, the program's version or the machine.
#[derive(Clone)]
pub struct RunDigest {
    hasher: Xxh3,
    buffer: Vec<u8>,
}

impl RunDigest {
    /// The digest of a run before its first tick.
    pub fn new(recipe: &Recipe, initial: &Frame) -> Self {
        let Recipe { seed, config, script } = recipe;
        let mut bytes = b"motion-lab run 1".to_vec();
        let word = |bytes: &mut Vec<u8>, word: u64| bytes.extend_from_slice(&word.to_le_bytes());
        word(&mut bytes, seed.0);
        word(&mut bytes, DT.to_bits());
        word(&mut bytes, config.ticks);
        match &config.sensor {
            None => word(&mut bytes, 0),
            Some(sensor) => {
                word(&mut bytes, 1);
                word(&mut bytes, u64::from(sensor.n_rays));
                word(&mut bytes, sensor.max_range.to_bits());
            }
        }
        word(&mut bytes, config.worlds.len() as u64);
        for world in &config.worlds {
            bytes.extend_from_slice(&world.content_hash().to_le_bytes());
        }
        let script = script.to_ron();
        word(&mut bytes, script.len() as u64);
        bytes.extend_from_slice(script.as_bytes());
        initial.encode(&mut bytes);
        let mut hasher = Xxh3::new();
        hasher.update(&bytes);
        RunDigest { hasher, buffer: Vec::new() }
    }

    /// Adds the next tick's frame.
    pub fn tick(&mut self, frame: &Frame) {
        let RunDigest { hasher, buffer } = self;
        frame.encode_in_pieces(buffer, |piece| hasher.update(piece));
    }

    /// The digest of the run so far.
    pub fn digest(&self) -> Digest {
        Digest(self.hasher.digest128())
    }

    /// The lower half of the digest so far, of which a log of digests consists.
    pub fn lower_half(&self) -> u64 {
        self.digest().0 as u64
    }
}

impl std::fmt::Debug for RunDigest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("RunDigest").field(&self.digest()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Event, Log, RobotInput, fixture};
    use motion_lab_core::sensors::RangeSensor;

    #[test]
    fn everything_that_makes_a_run_is_in_its_digest() {
        let log = fixture::log();
        type Change = fn(&mut Log);
        let changes: [(&str, Change); 10] = [
            ("nothing", |_| {}),
            ("seed", |l| l.recipe.seed.0 ^= 1 << 63),
            ("ticks", |l| fixture::config_of(l).ticks += 1),
            ("rays", |l| fixture::config_of(l).sensor = Some(RangeSensor { n_rays: 4, max_range: 4.0 })),
            ("range", |l| {
                fixture::config_of(l).sensor = Some(RangeSensor { n_rays: 3, max_range: 4.000_000_000_000_001 })
            }),
            ("no sensor", |l| fixture::config_of(l).sensor = None),
            ("world", |l| fixture::config_of(l).worlds[0].bounds.max.x += 1.0),
            ("script", |l| {
                let event = Event { tick: 3, robot: "Arm".into(), input: RobotInput::Release };
                l.recipe.script.events.push(event);
            }),
            ("initial frame", |l| fixture::frames_of(l).0.robots[0].contacts += 1),
            ("the sign of a zero", |l| fixture::frames_of(l).1[2].robots[1].configuration[1] = -0.0),
        ];
        let mut digests: Vec<Digest> = Vec::new();
        for (what, change) in changes {
            let mut changed = log.clone();
            change(&mut changed);
            let digest = changed.digest().unwrap();
            assert!(!digests.contains(&digest), "{what} left the digest as it was");
            digests.push(digest);
        }
    }

    #[test]
    fn a_digest_is_read_as_it_prints_and_nothing_else_is() {
        let text = "00f745674b9949ddd86153036592511a";
        assert_eq!(text.parse(), Ok(Digest(0x00f7_4567_4b99_49dd_d861_5303_6592_511a)));
        assert_eq!(text.to_uppercase().parse::<Digest>().map(|digest| digest.to_string()), Ok(text.to_owned()));
        for wrong in ["", &text[1..], &format!("{text}0"), &text.replace("1a", "1g"), &text.replacen('0', "+", 1)] {
            assert_eq!(wrong.parse::<Digest>(), Err(DigestError), "{wrong}");
        }
    }

    #[test]
    fn a_run_is_hashed_as_documented_and_tick_by_tick() {
        let log = fixture::log();
        let mut bytes = b"motion-lab run 1".to_vec();
        for word in [log.recipe.seed.0, 0.05_f64.to_bits(), 3, 1, 3, 4.0_f64.to_bits(), 1] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(log.recipe.config.worlds[0].content_hash().to_le_bytes());
        bytes.extend((log.recipe.script.to_ron().len() as u64).to_le_bytes());
        bytes.extend(log.recipe.script.to_ron().bytes());
        let mut run = RunDigest::new(&log.recipe, log.initial().unwrap());
        log.initial().unwrap().encode(&mut bytes);
        assert_eq!(run.digest(), Digest(xxh3_128(&bytes)));
        for frame in log.frames() {
            frame.encode(&mut bytes);
            run.tick(frame);
            assert_eq!(run.digest(), Digest(xxh3_128(&bytes)), "after tick {}", frame.tick);
        }
        assert_eq!(Some(run.digest()), log.digest());
    }
}
