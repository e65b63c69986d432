//! Counting the allocations of a closure, on the thread that runs it.
//!
//! Tests run in parallel threads, so the counter is the thread's own: what other tests allocate is not
//! seen, and neither is what a closure allocates on threads it starts.

#![expect(unsafe_code, reason = "a global allocator can only be written as an unsafe implementation of `GlobalAlloc`")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    // Const-initialised and without a destructor, so that reading it never allocates itself.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator with a counter for each thread.
///
/// # Example
/// ```
/// use piola_testkit::{CountingAllocator, allocations_in};
/// #[global_allocator]
/// static ALLOCATOR: CountingAllocator = CountingAllocator;
///
/// let (count, vector) = allocations_in(|| vec![1.0, 2.0]);
/// assert_eq!((count, vector.len()), (1, 2));
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CountingAllocator;

fn count() {
    // A thread that is ending has no counter any more, and no test that reads it.
    let _ = COUNT.try_with(|count| count.set(count.get() + 1));
}

// SAFETY: every call is handed to `System` unchanged, whose contract is the one asked for here.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `GlobalAlloc::alloc`.
        unsafe { System.alloc(layout) }
    }
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `GlobalAlloc::alloc_zeroed`.
        unsafe { System.alloc_zeroed(layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller keeps the contract of `GlobalAlloc::realloc`.
        unsafe { System.realloc(pointer, layout, new_size) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract of `GlobalAlloc::dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// Runs `f` and counts its allocations and reallocations on this thread.
///
/// The counter moves only where [`CountingAllocator`] is the global allocator; a test that relies on it
/// should see a nonzero count once, or it proves nothing. This function sees to that itself.
///
/// # Panics
/// When [`CountingAllocator`] is not installed.
pub fn allocations_in<R>(f: impl FnOnce() -> R) -> (usize, R) {
    let before_probe = COUNT.get();
    drop(std::hint::black_box(Box::new(0_u8)));
    assert!(
        before_probe < COUNT.get(),
        "nothing is counted: put `#[global_allocator] static ALLOCATOR: CountingAllocator = CountingAllocator;` \
         into tests/it/main.rs"
    );
    let before = COUNT.get();
    let result = f();
    (COUNT.get() - before, result)
}
