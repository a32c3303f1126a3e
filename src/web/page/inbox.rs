//! The inbox: what the page sent since the last frame.

use std::cell::RefCell;

use super::message::PageRequest;

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

/// Puts something in. Returns whether there was room.
pub fn put(incoming: Incoming) -> bool {
    let has_room = INBOX.with_borrow_mut(|inbox| {
        let has_room = inbox.len() < MAX_WAITING;
        inbox.extend(has_room.then_some(incoming));
        has_room
    });
    wake();
    has_room
}

/// Asks for another frame: a paused lab sleeps.
pub fn wake() {
    WAKER.with_borrow(|waker| waker.iter().for_each(|wake| wake()));
}
