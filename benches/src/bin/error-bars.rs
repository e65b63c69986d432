//! Estimates of the global error beside the true errors, as Markdown: see [`piola_benches::error_bars`].
#![expect(clippy::print_stdout, reason = "it prints its tables")]

use piola_benches::error_bars::{all, table};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("{}", table(&all()?));
    Ok(())
}
