#![no_main]

use motion_lab_fuzz::targets::path::check;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    check(data);
});
