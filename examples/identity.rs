//! Prints the digests of K seeds in the three worlds, for comparison between builds and platforms.
//!
//! `cargo run --example identity -- 8`; `tests/web/identity` compares native and WebAssembly.
#![allow(clippy::print_stdout)]

use std::error::Error;

use motion_lab::random::Seed;
use motion_lab::recording::identity_line;
use motion_lab::worlds::World;

fn main() -> Result<(), Box<dyn Error>> {
    let k: u64 = std::env::args().nth(1).map_or(Ok(8), |k| k.parse())?;
    for seed in 0..k {
        for name in World::built_in_names() {
            let world = World::built_in(name).ok_or("a built-in name names a world")?;
            println!("{}", identity_line(&world, Seed(seed))?);
        }
    }
    Ok(())
}
