//! The listener: the page's function that takes messages of the lab.

use std::cell::RefCell;

use serde_json::Value;
use wasm_bindgen::JsValue;

thread_local! {
    static LISTENER: RefCell<Option<js_sys::Function>> = const { RefCell::new(None) };
}

/// Sets the listener, in place of any before.
pub fn listen(listener: js_sys::Function) {
    LISTENER.set(Some(listener));
}

/// Sends the page a message.
pub fn tell(message: &Value) {
    tell_with(message, None);
}

/// Sends the page a message, with a file's bytes where there are any.
pub fn tell_with(message: &Value, bytes: Option<&[u8]>) {
    let Some(listener) = LISTENER.with_borrow(Clone::clone) else { return };
    let bytes = bytes.map_or(JsValue::UNDEFINED, |b| js_sys::Uint8Array::from(b).into());
    // a listener that throws is the page's fault and must not stop the lab
    let _ = listener.call2(&JsValue::NULL, &JsValue::from_str(&message.to_string()), &bytes);
}
