#![no_main]

use motion_lab_fuzz::targets::script::check;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    check(data);
});
