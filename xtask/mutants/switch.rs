//! The switch that stands in each crate of the mutated tree: which of its changes is on, and which were met.
//!
//! A test may be the first to ask, and may count its allocations: nothing here allocates, where the system shows the
//! environment as a file.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

const CHOSEN_BY: &str = "PIOLA_MUTANT";
const SEEN_IN: &str = "PIOLA_MUTANT_SEEN";

/// What no mutant is numbered.
const UNREAD: u32 = 0;
const RECORDING: u32 = 1;
const NONE: u32 = u32::MAX;

static CHOSEN: AtomicU32 = AtomicU32::new(UNREAD);
static FOLDER: OnceLock<([u8; LONGEST], usize)> = OnceLock::new();
static SEEN: [AtomicBool; 1 << 16] = [const { AtomicBool::new(false) }; 1 << 16];
const LONGEST: usize = 320;

/// Whether the mutant `number` is the chosen one.
#[inline]
pub(crate) fn is(number: u32) -> bool {
    let chosen = CHOSEN.load(Ordering::Relaxed);
    if chosen <= RECORDING { first(chosen, number) } else { chosen == number }
}

#[cold]
#[inline(never)]
fn first(chosen: u32, number: u32) -> bool {
    if chosen == RECORDING {
        record(number);
        return false;
    }
    if let Some(folder) = variable(SEEN_IN) {
        FOLDER.get_or_init(|| folder);
        CHOSEN.store(RECORDING, Ordering::Release);
        record(number);
        return false;
    }
    let digits = variable(CHOSEN_BY);
    let digits = digits.as_ref().and_then(|(text, length)| std::str::from_utf8(&text[..*length]).ok());
    let chosen = digits.and_then(|digits| digits.parse().ok()).unwrap_or(NONE);
    CHOSEN.store(chosen, Ordering::Relaxed);
    chosen == number
}

/// An empty file named by the number.
fn record(number: u32) {
    let seen = &SEEN[number as usize % SEEN.len()];
    // A load first: a swap each time would be much of the time of a loop.
    if seen.load(Ordering::Relaxed) {
        return;
    }
    // Stored before recording begins; a thread that does not see it yet records when it comes by again.
    let Some((folder, length)) = FOLDER.get() else { return };
    if seen.swap(true, Ordering::Relaxed) {
        return;
    }
    let mut path = [0; LONGEST + 12];
    path[..*length].copy_from_slice(&folder[..*length]);
    path[*length] = b'/';
    let mut end = length + 1;
    let mut power = 1_000_000_000;
    while 0 < power {
        if power <= number || power == 1 {
            path[end] = b"0123456789"[(number / power % 10) as usize];
            end += 1;
        }
        power /= 10;
    }
    if let Ok(path) = std::str::from_utf8(&path[..end]) {
        // A path this short is handed to the system without an allocation.
        let _ = File::create(Path::new(path));
    }
}

/// The value of an environment variable.
fn variable(name: &str) -> Option<([u8; LONGEST], usize)> {
    let mut value = [0; LONGEST];
    let Ok(mut file) = File::open("/proc/self/environ") else {
        let text = std::env::var(name).ok()?;
        value.get_mut(..text.len())?.copy_from_slice(text.as_bytes());
        return Some((value, text.len()));
    };
    let mut block = [0; 4096];
    // How much of `NAME=` has been matched; nothing once the entry is another's.
    let (mut matched, mut length) = (Some(0), 0);
    loop {
        let read = file.read(&mut block).ok()?;
        if read == 0 {
            return (matched == Some(name.len() + 1)).then_some((value, length));
        }
        for byte in &block[..read] {
            match (matched, *byte) {
                (Some(at), 0) if at == name.len() + 1 => return Some((value, length)),
                (_, 0) => matched = Some(0),
                (Some(at), byte) if at == name.len() + 1 => {
                    *value.get_mut(length)? = byte;
                    length += 1;
                }
                (Some(at), byte) => matched = (*name.as_bytes().get(at).unwrap_or(&b'=') == byte).then_some(at + 1),
                (None, _) => {}
            }
        }
    }
}
