//! What commands do with the files of others: nothing is lost.

mod interrupts;
mod loss;
mod names;
mod pipes;
