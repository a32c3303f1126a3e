//! Covers an image of cells with few rectangles, for drawing.

use std::collections::BTreeMap;

/// A rectangle of an image's cells: columns `left..right`, rows `low..high`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rect {
    /// The first column.
    pub left: u32,
    /// The column after the last.
    pub right: u32,
    /// The first row.
    pub low: u32,
    /// The row after the last.
    pub high: u32,
}

/// Covers the cells for which `wanted` holds with rectangles that do not overlap: runs of a row, joined with equal runs
/// of the rows above. `columns` is the width of the image.
pub fn rectangles<T>(image: &[T], columns: u32, wanted: impl Fn(&T) -> bool) -> Vec<Rect> {
    let mut done = Vec::new();
    let mut open: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let close =
        |open: &BTreeMap<(u32, u32), u32>, keep: &BTreeMap<(u32, u32), u32>, high: u32, done: &mut Vec<Rect>| {
            for (&(left, right), &low) in open {
                if !keep.contains_key(&(left, right)) {
                    done.push(Rect { left, right, low, high });
                }
            }
        };
    let mut rows = 0;
    for (row, cells) in (0_u32..).zip(image.chunks(columns as usize)) {
        let mut now = BTreeMap::new();
        let mut start = None;
        for column in 0..=columns {
            let here = cells.get(column as usize).is_some_and(&wanted);
            match (start, here) {
                (None, true) => start = Some(column),
                (Some(left), false) => {
                    let low = open.get(&(left, column)).copied().unwrap_or(row);
                    now.insert((left, column), low);
                    start = None;
                }
                _ => {}
            }
        }
        close(&open, &now, row, &mut done);
        open = now;
        rows = row + 1;
    }
    close(&open, &BTreeMap::new(), rows, &mut done);
    done
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Seed, Stream};

    #[test]
    fn rectangles_cover_what_is_wanted_once_and_nothing_else() {
        let mut s = Stream::new(Seed(8), "rectangles");
        for _ in 0..100 {
            let (columns, rows) = (1 + s.below(12) as u32, 1 + s.below(12) as u32);
            let image: Vec<bool> = (0..columns * rows).map(|_| s.below(3) > 0).collect();
            let mut covered = vec![0; image.len()];
            for r in rectangles(&image, columns, |wanted| *wanted) {
                for row in r.low..r.high {
                    for column in r.left..r.right {
                        covered[(row * columns + column) as usize] += 1;
                    }
                }
            }
            assert!(image.iter().zip(&covered).all(|(wanted, n)| u32::from(*wanted) == *n), "{image:?}");
        }
        let full = rectangles(&[true; 20], 5, |x| *x);
        assert_eq!(full, [Rect { left: 0, right: 5, low: 0, high: 4 }], "what is whole is one");
    }
}
