//! The inbox: what the page sent since the last frame.

use std::cell::RefCell;

use super::message::Message;

/// An item from the page.
pub enum Incoming {
    /// A message.
    Message(Message),
    /// A file to open.
    File {
        /// Its name.
        name: String,
        /// Its content.
        bytes: Vec<u8>,
    },
}

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

/// Puts something in.
pub fn put(incoming: Incoming) {
    INBOX.with_borrow_mut(|inbox| inbox.push(incoming));
    wake();
}

/// Asks for another frame: a paused lab sleeps.
pub fn wake() {
    WAKER.with_borrow(|waker| waker.iter().for_each(|wake| wake()));
}
