//! Bytes in the form of gzip, the same on every machine.

use miniz_oxide::deflate::{CompressionLevel, compress_to_vec};

/// The bytes, compressed; a browser's `DecompressionStream` unpacks them.
///
/// The compressor is named here: flate2 takes another where some crate of a build asks for it, and browsers have their
/// own, of which each writes other bytes.
pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    // deflate, no flags, no time, the best compression, no system
    let mut packed = vec![0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 2, 255];
    packed.extend(compress_to_vec(bytes, CompressionLevel::BestCompression as u8));
    packed.extend(crc32(bytes).to_le_bytes());
    // by the format the lower 32 bits
    packed.extend((bytes.len() as u32).to_le_bytes());
    packed
}

/// The checksum of gzip, four bits at a time: a table of 16 numbers in place of the 4,096 of faster ones, which would
/// be a fiftieth of the simulator.
fn crc32(bytes: &[u8]) -> u32 {
    const HALVES: [u32; 16] = remainders();
    let half = |crc: u32| (crc >> 4) ^ HALVES[(crc & 15) as usize];
    !bytes.iter().fold(!0, |crc, byte| half(half(crc ^ u32::from(*byte))))
}

const fn remainders() -> [u32; 16] {
    let mut table = [0; 16];
    let mut at = 0;
    while at < 16 {
        let (mut crc, mut bit) = (at as u32, 0);
        while bit < 4 {
            crc = if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
            bit += 1;
        }
        table[at] = crc;
        at += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    #[test]
    fn what_is_packed_is_unpacked_by_another_library_which_checks_the_sum() {
        let noise: Vec<u8> = (0..100_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        for bytes in [Vec::new(), b"motion".repeat(5000), noise] {
            let packed = gzip(&bytes);
            let mut unpacked = Vec::new();
            flate2::read::GzDecoder::new(&packed[..]).read_to_end(&mut unpacked).unwrap();
            assert!(unpacked == bytes, "{} bytes", bytes.len());
            assert_eq!(crc32(&bytes), crc32fast::hash(&bytes));
        }
        assert!(gzip(&b"motion".repeat(5000)).len() < 200);
    }
}
