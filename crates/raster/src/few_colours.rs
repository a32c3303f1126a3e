//! `FewColours`, a picture reduced to the 256 colours of a GIF.

use std::collections::BTreeMap;

use motion_lab_core::picture::{Palette, Role};

const MAX_COLOURS: usize = 256;

/// A picture as a palette and an index per pixel.
pub struct FewColours {
    /// Red, green and blue of every colour.
    pub palette: Vec<u8>,
    /// The number of every pixel's colour in the palette.
    pub pixels: Vec<u8>,
}

impl FewColours {
    /// Reduces a picture of three bytes per pixel. The colours of the roles are kept, however rare (a red cross is a
    /// few pixels), then the most frequent others. Any other pixel gets the nearest of these.
    pub fn of(rgb: &[u8], roles: &Palette) -> Self {
        let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
        let pixels = || rgb.as_chunks::<3>().0.iter().copied();
        for colour in pixels() {
            *counts.entry(colour).or_default() += 1;
        }
        let roles = Role::ALL.map(|role| roles.colour(role).0);
        let mut colours: Vec<[u8; 3]> = roles.into_iter().filter(|c| counts.remove(c).is_some()).collect();
        let mut others: Vec<([u8; 3], usize)> = counts.into_iter().collect();
        // stable: colours of one frequency stay in their own order
        others.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let room = MAX_COLOURS - colours.len();
        colours.extend(others.iter().take(room).map(|(colour, _)| *colour));
        let mut numbers: BTreeMap<[u8; 3], u8> = (0..=u8::MAX).zip(&colours).map(|(n, c)| (*c, n)).collect();
        let number = |colour| *numbers.entry(colour).or_insert_with(|| nearest(&colours, colour));
        FewColours { pixels: pixels().map(number).collect(), palette: colours.concat() }
    }
}

/// The number of the colour nearest to `colour`.
fn nearest(colours: &[[u8; 3]], colour: [u8; 3]) -> u8 {
    let apart = |other: &[u8; 3]| -> u32 { (0..3).map(|i| u32::from(colour[i].abs_diff(other[i])).pow(2)).sum() };
    (0..=u8::MAX).zip(colours).min_by_key(|(_, other)| apart(other)).map_or(0, |(number, _)| number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::picture::Rgb;

    /// A palette in which everything is red.
    const REDS: Palette = Palette::new([Rgb([200, 30, 40]); Role::ALL.len()]);

    #[test]
    fn rare_colours_of_roles_stay_and_others_get_the_nearest() {
        let red = REDS.colour(Role::Goal).0;
        // 400 colours, two pixels each and every fifth three, and a single red pixel among them
        let mut pixels: Vec<[u8; 3]> = Vec::new();
        for i in 0..400_u32 {
            let colour = [(i / 2) as u8, (i % 2) as u8, 0];
            pixels.extend(std::iter::repeat_n(colour, if i % 5 == 0 { 3 } else { 2 }));
        }
        pixels.push(red);
        let few = FewColours::of(&pixels.concat(), &REDS);
        assert_eq!((few.palette.len(), few.pixels.len()), (3 * MAX_COLOURS, pixels.len()));
        let colour = |pixel: usize| &few.palette[3 * usize::from(few.pixels[pixel])..][..3];
        assert_eq!(colour(pixels.len() - 1), red);
        assert_eq!(colour(0), [0, 0, 0], "a frequent one is itself");
        for (i, pixel) in pixels.iter().enumerate() {
            let off: u32 = colour(i).iter().zip(pixel).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
            // 255 of the 400 neighbours remain, the frequent and the first: the last lie at the end, 100 steps away
            assert!(off <= 100, "pixel {i} is {:?}, not {pixel:?}", colour(i));
        }
    }

    #[test]
    fn a_picture_of_few_colours_is_itself() {
        let rgb = [[9, 8, 7], [1, 2, 3], [9, 8, 7]].concat();
        let few = FewColours::of(&rgb, &REDS);
        let back: Vec<u8> = few.pixels.iter().flat_map(|n| few.palette[3 * usize::from(*n)..][..3].to_vec()).collect();
        assert_eq!(back, rgb);
    }
}
