//! What commands do with the files of others: nothing is lost.

mod interrupts;
mod loss;
mod many_logs;
mod names;
mod pipes;
