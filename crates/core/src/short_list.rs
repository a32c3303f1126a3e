//! `ShortList`, a list that takes no heap while it is short.

use std::fmt;
use std::ops::{Deref, DerefMut};

use smallvec::SmallVec;

/// A list that keeps up to `N` items inline and goes to the heap beyond them. It reads like a slice.
///
/// Configurations, footprints and motion bounds are of this type, so that planners neither allocate for the lab's
/// robots nor depend on the crate that keeps the items.
///
/// ```
/// use motion_lab_core::short_list::ShortList;
/// let mut joints: ShortList<f64, 4> = ShortList::from([0.5, 1.0]);
/// joints.push(1.5);
/// assert_eq!(joints[..], [0.5, 1.0, 1.5]);
/// assert_eq!(joints.iter().sum::<f64>(), 3.0);
/// ```
#[derive(PartialEq)]
pub struct ShortList<T: Copy, const N: usize>(SmallVec<[T; N]>);

impl<T: Copy, const N: usize> ShortList<T, N> {
    /// The empty list.
    #[inline]
    pub fn new() -> Self {
        ShortList(SmallVec::new())
    }

    /// A copy of these items.
    #[inline]
    pub fn from_slice(items: &[T]) -> Self {
        ShortList(SmallVec::from_slice(items))
    }

    /// Appends an item.
    #[inline]
    pub fn push(&mut self, item: T) {
        self.0.push(item);
    }

    /// Appends copies of these items.
    #[inline]
    pub fn extend_from_slice(&mut self, items: &[T]) {
        self.0.extend_from_slice(items);
    }

    /// Sets the length to `len`: items beyond it are dropped, missing ones are copies of `item`.
    pub fn resize(&mut self, len: usize, item: T) {
        self.0.resize(len, item);
    }

    /// Removes every item.
    #[inline]
    pub fn clear(&mut self) {
        self.0.clear();
    }
}

/// As a slice is copied, not item by item.
impl<T: Copy, const N: usize> Clone for ShortList<T, N> {
    #[inline]
    fn clone(&self) -> Self {
        Self::from_slice(&self.0)
    }
}

impl<T: Copy, const N: usize> Default for ShortList<T, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Copy, const N: usize> Deref for ShortList<T, N> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T: Copy, const N: usize> DerefMut for ShortList<T, N> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<T: Copy, const N: usize, const M: usize> From<[T; M]> for ShortList<T, N> {
    #[inline]
    fn from(items: [T; M]) -> Self {
        Self::from_slice(&items)
    }
}

impl<T: Copy, const N: usize> From<Vec<T>> for ShortList<T, N> {
    #[inline]
    fn from(items: Vec<T>) -> Self {
        Self::from_slice(&items)
    }
}

impl<T: Copy, const N: usize> FromIterator<T> for ShortList<T, N> {
    #[inline]
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        ShortList(items.into_iter().collect())
    }
}

impl<T: Copy, const N: usize> Extend<T> for ShortList<T, N> {
    #[inline]
    fn extend<I: IntoIterator<Item = T>>(&mut self, items: I) {
        self.0.extend(items);
    }
}

impl<'a, T: Copy, const N: usize> IntoIterator for &'a ShortList<T, N> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<'a, T: Copy, const N: usize> IntoIterator for &'a mut ShortList<T, N> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter_mut()
    }
}

impl<T: Copy, const N: usize> IntoIterator for ShortList<T, N> {
    type Item = T;
    type IntoIter = IntoIter<T, N>;

    #[inline]
    fn into_iter(self) -> IntoIter<T, N> {
        IntoIter(self.0.into_iter())
    }
}

impl<T: Copy + fmt::Debug, const N: usize> fmt::Debug for ShortList<T, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.0).finish()
    }
}

/// The items of a [`ShortList`], by value and in order.
pub struct IntoIter<T: Copy, const N: usize>(smallvec::IntoIter<[T; N]>);

impl<T: Copy, const N: usize> Iterator for IntoIter<T, N> {
    type Item = T;

    #[inline]
    fn next(&mut self) -> Option<T> {
        self.0.next()
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.size_hint()
    }
}

impl<T: Copy, const N: usize> DoubleEndedIterator for IntoIter<T, N> {
    #[inline]
    fn next_back(&mut self) -> Option<T> {
        self.0.next_back()
    }
}

impl<T: Copy, const N: usize> ExactSizeIterator for IntoIter<T, N> {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_vector_of_the_same_items_inline_and_on_the_heap() {
        for n in 0..7 {
            let all: Vec<u32> = (0..n).collect();
            let mut list: ShortList<u32, 3> = all.iter().copied().collect();
            assert_eq!(list[..], all[..]);
            assert_eq!(list, ShortList::from_slice(&all));
            assert_eq!(format!("{list:?}"), format!("{all:?}"));
            assert_eq!(list.clone().into_iter().len(), all.len());
            assert!(list.clone().into_iter().rev().eq(all.iter().rev().copied()));
            for item in &mut list {
                *item += 10;
            }
            list.push(99);
            list.extend_from_slice(&[98, 97]);
            let more: Vec<u32> = (10..10 + n).chain([99, 98, 97]).collect();
            assert_eq!(list[..], more[..]);
            assert_ne!(list[..more.len() - 1], more[..]);
            list.resize(2, 0);
            assert_eq!(list[..], more[..2]);
            list.resize(5, 7);
            assert_eq!(list[..], [more[0], more[1], 7, 7, 7]);
            assert_eq!(list, ShortList::from(vec![more[0], more[1], 7, 7, 7]));
            list.clear();
            assert_eq!(list, ShortList::new());
        }
    }
}
