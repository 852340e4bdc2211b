#![no_main]

#[path = "../../crates/lariat-scene/tests/fuzz/targets.rs"]
mod targets;

libfuzzer_sys::fuzz_target!(|data: &[u8]| targets::mesh(data));
