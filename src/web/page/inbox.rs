//! The inbox: what the page sent since the last frame.

use std::cell::RefCell;

use super::super::message::PageRequest;

/// An item from the page.
pub enum Incoming {
    /// A request.
    Message(PageRequest),
    /// A file to open.
    File {
        /// Its name.
        name: String,
        /// Its content.
        bytes: Vec<u8>,
    },
    /// Panic.
    Fail,
}

/// Largest number of items that wait. A page sends a few in a frame, and a frame takes them all.
const MAX_WAITING: usize = 1000;

thread_local! {
    static INBOX: RefCell<Vec<Incoming>> = const { RefCell::new(Vec::new()) };
    static WAKER: RefCell<Option<Box<dyn Fn()>>> = const { RefCell::new(None) };
}

/// Sets the function that asks for a frame.
pub fn wake_by(waker: impl Fn() + 'static) {
    WAKER.set(Some(Box::new(waker)));
}

/// Takes everything that has come in.
pub fn take_all() -> Vec<Incoming> {
    INBOX.take()
}

/// Puts something in. Returns whether there was room. The first after a frame asks for one, which takes the others too:
/// the browser's event loop keeps whatever wakes it, and a page around may send without end.
pub fn put(incoming: Incoming) -> bool {
    let before = INBOX.with_borrow_mut(|inbox| {
        let before = inbox.len();
        inbox.extend((before < MAX_WAITING).then_some(incoming));
        before
    });
    if before == 0 {
        wake();
    }
    before < MAX_WAITING
}

/// Asks for another frame: a paused lab sleeps.
pub fn wake() {
    WAKER.with_borrow(|waker| waker.iter().for_each(|wake| wake()));
}
