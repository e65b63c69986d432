//! Ctrl-C and SIGTERM: the run stops after the present step and its results are written.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that signals raise.
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on. A second signal ends the program at once.
    pub(crate) fn listen() -> Self {
        let flag = Arc::new(AtomicBool::new(false));
        let raised = Arc::clone(&flag);
        let heard = ctrlc::set_handler(move || {
            if raised.swap(true, Ordering::Relaxed) {
                std::process::exit(1);
            }
        });
        // Without a handler a signal ends the program as it always did.
        drop(heard);
        Self(flag)
    }

    /// Whether a signal has come.
    pub(crate) fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
