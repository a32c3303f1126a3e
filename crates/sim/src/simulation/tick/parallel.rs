//! Work on many robots, on all threads where there are enough of them.

/// From this number of robots on the work is divided among threads. Below it that costs more than it saves.
#[cfg(not(target_family = "wasm"))]
const MANY: usize = 256;

/// The least number of robots that a thread takes at once.
#[cfg(not(target_family = "wasm"))]
const SHARE: usize = 32;

/// Does the work for every item, each with working memory that `room` makes for a thread. No item's work may depend on
/// another's, so the order and the number of threads change nothing.
pub(crate) fn each<T: Send, S>(
    items: impl ExactSizeIterator<Item = T>,
    room: impl Fn() -> S + Send + Sync,
    work: impl Fn(&mut S, T) + Send + Sync,
) {
    #[cfg(not(target_family = "wasm"))]
    if items.len() >= MANY && rayon::current_num_threads() > 1 {
        use rayon::prelude::*;
        let items: Vec<T> = items.collect();
        items.into_par_iter().with_min_len(SHARE).for_each_init(room, work);
        return;
    }
    let mut own = room();
    items.for_each(|item| work(&mut own, item));
}
