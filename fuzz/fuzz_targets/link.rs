#![no_main]

use motion_lab_fuzz::targets::link::check;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    check(data);
});
