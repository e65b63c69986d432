//! Reading of the numbers of a checkpoint.

/// The whole number that a count of steps was.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a count; values that are no count saturate"
)]
pub(crate) fn count_of(count: f64) -> u64 {
    count as u64
}

/// The next N numbers.
pub(crate) fn take<T: Copy, const N: usize>(rest: &mut &[T]) -> Option<[T; N]> {
    let (first, others) = rest.split_first_chunk::<N>()?;
    *rest = others;
    Some(*first)
}
