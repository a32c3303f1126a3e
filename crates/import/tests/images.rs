//! Images of ROS maps, as another program wrote them.

use motion_lab_import::{OccupancyMap, RosMap, Unknown};

/// 4 x 2 pixels of eight bits: 254, 205, 0, 128 and 0, 255, 1, 50.
const GRAY: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x04\0\0\0\x02\x08\0\0\0\0Z\xc3\x22\xbf\0\0\0\
    \x12IDATx\xdac\xf8w\x96\xa1\x81\x81\xe1?\xa3\x11\0\x15\x91\x03~\xe9\xc2V\0\0\0\0\0IEND\xaeB`\x82";

/// 5 x 1 pixels of two bits: 0, 1, 2, 3, 3.
const TWO_BITS: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x05\0\0\0\x01\x02\0\0\0\0y%#\x8e\0\0\0\x0bIDAT\
    x\xdac\x90>\0\0\0\xf9\0\xdc\xe7\xb9\x93K\0\0\0\0IEND\xaeB`\x82";

/// 4 x 1 pixels of a palette: black, red, a gray of 205 that is transparent, white.
const PALETTE: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x04\0\0\0\x01\x02\x03\0\0\0\x84R\xe7^\0\0\0\
    \x0cPLTE\0\0\0\xff\0\0\xcd\xcd\xcd\xff\xff\xffD\xcc\x0a\x14\0\0\0\x03tRNS\xff\xff\0\xd7\xca\x0dA\0\0\0\x0aIDATx\
    \xdac\x90\x06\0\0\x1d\0\x1c#|\x8f\xac\0\0\0\0IEND\xaeB`\x82";

/// 3 x 1 pixels of gray and alpha: black, black that lets a 255th through, white.
const GRAY_ALPHA: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x01\x08\x04\0\0\0\xb1\xe9\xdc?\0\0\0\
    \x0fIDATx\xdac`\xf8\xcf\xf0\xef\xff\x7f\0\x0a\xf9\x03\xfcNa\x90F\0\0\0\0IEND\xaeB`\x82";

/// 2 x 1 pixels: green; dark gray, transparent.
const RGBA: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x02\0\0\0\x01\x08\x06\0\0\0\xf4\x22\x7f\x8a\0\
    \0\0\x11IDATx\xdac`\xf8\xcf\xf0\x9f\x93\x93\x93\x01\0\x0cN\x02\x1a/\xba\xef\xc1\0\0\0\0IEND\xaeB`\x82";

/// 3 x 1 pixels of 16 bits: 256, 257 and 65535.
const SIXTEEN: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x01\x10\0\0\0\0n\x1b\x97+\0\0\0\x0fI\
    DATx\xdac`d`d\xfc\xff\x1f\0\x03\x11\x02\x021a\xa8\xe1\0\0\0\0IEND\xaeB`\x82";

/// 5 x 5 pixels in seven passes, of which row y, column x has 10 y + x.
const INTERLACED: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\0\0\0\x0dIHDR\0\0\0\x05\0\0\0\x05\x08\0\0\0\x01\xdf\x03I\xaf\0\0\0\
    ,IDATx\xdac```a\xd0\xd0a`b\xd0b\x10\x11\x93``df\x10\x15g\xd0\xd4f\xe0\xe2\xe6\xe1\xe5c\x90\x93WPT\x02\0 \x85\x02\
    '\xc4\x87\xb1\x07\0\0\0\0IEND\xaeB`\x82";

fn map(more: &str) -> RosMap {
    RosMap::parse("m.yaml", &format!("image: m\nresolution: 1\norigin: [0, 0, 0]\n{more}")).unwrap()
}

fn cells(more: &str, image: &[u8], unknown: Unknown) -> OccupancyMap {
    map(more).cells("m", image, unknown).unwrap()
}

/// Whether each cell is occupied, in the order of the image's pixels.
fn occupied(map: &OccupancyMap) -> Vec<bool> {
    let (columns, rows) = (map.grid.columns(), map.grid.rows());
    (0..rows).rev().flat_map(|row| (0..columns).map(move |column| map.grid.is_occupied(column, row))).collect()
}

/// The same picture as a PGM.
fn pgm(columns: usize, shades: &[u8]) -> Vec<u8> {
    let mut image = format!("P5 {columns} {} 255\n", shades.len() / columns).into_bytes();
    image.extend(shades);
    image
}

#[test]
fn a_png_says_the_same_as_a_pgm() {
    let gray = pgm(4, &[254, 205, 0, 128, 0, 255, 1, 50]);
    let interlaced: Vec<u8> = (0..5).flat_map(|y| (0..5).map(move |x| 10 * y + x)).collect();
    for (png, pgm) in [
        (GRAY, &gray),
        (TWO_BITS, &pgm(5, &[0, 85, 170, 255, 255])),
        // 256 is below a 255th of 65535, 257 is one
        (SIXTEEN, &pgm(3, &[0, 1, 255])),
        (INTERLACED, &pgm(5, &interlaced)),
    ] {
        for (more, unknown) in [
            ("", Unknown::Free),
            ("", Unknown::Occupied),
            ("mode: raw", Unknown::Free),
            ("occupied_thresh: 0.999\nfree_thresh: 0.998", Unknown::Free),
            ("occupied_thresh: 0.995\nfree_thresh: 0.9", Unknown::Free),
            ("negate: 1\noccupied_thresh: 0.1\nfree_thresh: 0.05", Unknown::Free),
        ] {
            assert_eq!(cells(more, png, unknown), cells(more, pgm, unknown), "{more}");
        }
    }
    assert_eq!(occupied(&cells("", GRAY, Unknown::Free)), [false, false, true, false, true, false, true, true]);
    // of a shade s the degree is 1 - s / 255: 230 / 255 is 0.902, 231 / 255 is 0.906
    let sharp = cells("occupied_thresh: 0.904\nfree_thresh: 0.903", INTERLACED, Unknown::Free);
    assert_eq!(occupied(&sharp), interlaced.iter().map(|shade| *shade <= 24).collect::<Vec<_>>());
}

/// 4 x 2 pixels of eight bits as a BMP with this palette, its rows from the bottom: 254, 205, 0, 128 and 0, 255, 1, 50.
fn bmp(palette: impl Fn(u8) -> [u8; 4]) -> Vec<u8> {
    let mut image = b"BM\0\0\0\0\0\0\0\0\x36\x04\0\0\x28\0\0\0\x04\0\0\0\x02\0\0\0\x01\0\x08\0".to_vec();
    image.extend([0; 24]);
    image.extend((0..=255).flat_map(palette));
    image.extend([0, 255, 1, 50, 254, 205, 0, 128]);
    image
}

#[test]
fn a_bmp_says_the_same_as_a_pgm() {
    let shades = [254, 205, 0, 128, 0, 255, 1, 50];
    for more in ["", "mode: scale", "mode: raw", "negate: true", "free_thresh: 0.25"] {
        let gray = cells(more, &bmp(|shade| [shade, shade, shade, 0]), Unknown::ByThresholds);
        assert_eq!(gray, cells(more, &pgm(4, &shades), Unknown::ByThresholds), "{more}");
        // a palette of red: of each shade 306 parts of 1024, as GraphicsMagick weighs it for Nav2
        let red = cells(more, &bmp(|shade| [0, 0, shade, 0]), Unknown::ByThresholds);
        let weighed = shades.map(|shade| (u32::from(shade) * 257 * 306 / 1024 / 257) as u8);
        assert_eq!(red, cells(more, &pgm(4, &weighed), Unknown::ByThresholds), "{more}");
    }
    assert_eq!(occupied(&cells("", &bmp(|s| [s, s, s, 0]), Unknown::Free))[..4], [false, false, true, false]);
}

#[test]
fn colours_count_as_shades_and_what_is_transparent_is_unknown() {
    // red has the shade 76 of 255, a degree of 0.70; the transparent gray is unknown whatever its shade
    assert_eq!(occupied(&cells("", PALETTE, Unknown::Free)), [true, true, false, false]);
    let unknown = cells("free_thresh: 0.25", PALETTE, Unknown::ByThresholds);
    assert_eq!(occupied(&unknown), [true, true, true, false]);
    assert_eq!(unknown.notes, ["unknown cells, taken as occupied: 1"]);
    assert_eq!(occupied(&cells("mode: scale", GRAY_ALPHA, Unknown::Free)), [true, false, false]);
    assert_eq!(occupied(&cells("mode: scale", GRAY_ALPHA, Unknown::Occupied)), [true, true, false]);
    // green has the shade 149, a degree of 0.416: in raw it is no cost, and what is transparent has a shade
    assert_eq!(cells("", RGBA, Unknown::Free).notes, ["unknown cells, taken as free: 2"]);
    let raw = cells("mode: raw", RGBA, Unknown::Free);
    assert_eq!(raw.notes[..1], ["unknown cells, taken as free: 1"]);
    assert_eq!(raw.notes[1..], ["1 cell with a cost of 1 to 99 is free: a cell is an obstacle at 100"]);
}

#[test]
fn a_png_that_is_cut_or_absurd_is_refused() {
    for length in 4..GRAY.len() - 16 {
        let error = map("").cells("m.png", &GRAY[..length], Unknown::Free).unwrap_err().to_string();
        assert!(error.starts_with("m.png: this is no whole PNG image: "), "{length}: {error}");
    }
    // 2^31 - 1 columns and rows, with the check sum that belongs to them
    let mut large = GRAY.to_vec();
    large[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    large[29..33].copy_from_slice(&[0x31, 0xa2, 0x54, 0xba]);
    let error = map("").cells("m.png", &large, Unknown::Free).unwrap_err().to_string();
    assert_eq!(error, "m.png: 2147483647 x 2147483647 cells: at most 16777216 in all");
}
