//! The table's rivals in a program of their own, which does what `benches/table/process.rs` asks for on its standard
//! input.
#![allow(clippy::print_stdout)]

#[cfg(feature = "box2d")]
mod box2d;
#[allow(dead_code, unused_imports)]
#[path = "../table/rivals/mod.rs"]
mod rivals;

use std::error::Error;
use std::hint::black_box;
use std::io::BufRead;

use rivals::{Contender, Task, lap};

/// Everybody's ways to do a task.
fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    #[allow(unused_mut)]
    let mut all = rivals::contenders(task);
    #[cfg(feature = "box2d")]
    all.extend(box2d::contenders(task));
    all
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut ways, mut cases) = (Vec::new(), 0);
    let mut input = std::io::stdin().lock();
    let mut line = String::new();
    while input.read_line(&mut line)? > 0 {
        match line.trim_end().split_once(' ') {
            Some(("task", head)) => {
                let task = Task::read(head, &mut input)?;
                (ways, cases) = (contenders(&task), task.cases.len());
                println!("{}", ways.iter().map(|way| way.name()).collect::<Vec<_>>().join("|"));
            }
            Some(("answers", way)) => {
                let way = &mut ways[way.parse::<usize>()?];
                for case in 0..cases {
                    let words: Vec<String> = way.answers(case).iter().map(f64::to_string).collect();
                    println!("{}", words.join(" "));
                }
            }
            Some(("round", way)) => {
                let way = &mut ways[way.parse::<usize>()?];
                println!("{}", lap(cases, |case| _ = black_box(way.work(case))));
            }
            _ => return Err(format!("not understood: {line}").into()),
        }
        line.clear();
    }
    Ok(())
}
