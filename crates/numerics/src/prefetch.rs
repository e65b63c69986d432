//! Asking for memory before it is needed.

/// Bytes of a line of the cache.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// Asks for the element of an index to be brought near the processor, all lines of it; nothing where there is none, or
/// where the machine has no such instruction.
///
/// Processors guess what will be read next. A long computation that reads the lines of an element in an order of its
/// own leaves them guessing wrong.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn prefetch<T>(elements: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    ask::<T, { core::arch::x86_64::_MM_HINT_T0 }>(elements, index);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (elements, index);
}

/// As [`prefetch`], of an element that will be written: a line that is only read must be asked for again to be written.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn prefetch_for_writing<T>(elements: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    ask::<T, { core::arch::x86_64::_MM_HINT_ET0 }>(elements, index);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (elements, index);
}

#[cfg(target_arch = "x86_64")]
#[cfg_attr(not(debug_assertions), inline(always))]
fn ask<T, const HINT: i32>(elements: &[T], index: usize) {
    if let Some(element) = elements.get(index) {
        let address = core::ptr::from_ref(element).cast::<i8>();
        let mut offset = 0;
        while offset < size_of::<T>() {
            #[expect(unsafe_code, reason = "the address lies in the element; every x86-64 has the instruction")]
            // SAFETY: the offset is less than the size of the element that is borrowed.
            unsafe {
                core::arch::x86_64::_mm_prefetch::<HINT>(address.add(offset));
            }
            offset += LINE;
        }
    }
}
