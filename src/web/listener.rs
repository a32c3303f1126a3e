//! The listener: what the page gave to be told by.

use std::cell::RefCell;

use serde_json::Value;
use wasm_bindgen::JsValue;

thread_local! {
    static LISTENER: RefCell<Option<js_sys::Function>> = const { RefCell::new(None) };
}

/// From now on this is told.
pub fn listen(listener: js_sys::Function) {
    LISTENER.set(Some(listener));
}

/// Tells the page something.
pub fn tell(message: &Value) {
    tell_with(message, None);
}

/// Tells the page something, and gives it a file.
pub fn tell_with(message: &Value, bytes: Option<&[u8]>) {
    let Some(listener) = LISTENER.with_borrow(Clone::clone) else { return };
    let bytes = bytes.map_or(JsValue::UNDEFINED, |b| js_sys::Uint8Array::from(b).into());
    // a listener that throws is the page's fault and must not stop the lab
    let _ = listener.call2(&JsValue::NULL, &JsValue::from_str(&message.to_string()), &bytes);
}
