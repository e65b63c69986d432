//! Two destinations of one request.

/// Two destinations of one request, for quantities that share work: the numbers of the first quantity, then those of the second.
///
/// Made by functions of other crates, such as `piola_solids::batch::first_piola_and_tangent`.
///
/// # Example
/// ```
/// let pair = piola_batch::Together([0.0; 3], [0.0; 3]);
/// assert_eq!(pair.0, pair.1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Together<V, W>(
    /// Of the first numbers.
    pub V,
    /// Of the rest.
    pub W,
);

/// Of the numbers of a quantity the first go to the first destination, the rest to the second; the parameters of a generic output in
/// brackets first. For Piola's crates only.
#[doc(hidden)]
#[macro_export]
macro_rules! together {
    ([$($generics:tt)*] $output:ty, $whole:literal = $first_output:ty, $first:literal + $second_output:ty, $second:literal) => {
        impl<$($generics)* T, V, W> $crate::Destination<$output, T, $whole> for $crate::Together<V, W>
        where
            T: $crate::BatchScalar,
            V: $crate::Destination<$first_output, T, $first>,
            W: $crate::Destination<$second_output, T, $second>,
        {
            const IN_LANES: bool = V::IN_LANES && W::IN_LANES;
            const RECORDS: bool = V::RECORDS && W::RECORDS;
            fn count(&self) -> usize {
                // Both are checked: no batch is as long as a pair of unlike lengths.
                let (first, second) = (self.0.count(), self.1.count());
                if first == second { first } else { usize::MAX }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn split(self, middle: usize) -> (Self, Self) {
                let ((a, b), (c, d)) = (self.0.split(middle), self.1.split(middle));
                (Self(a, c), Self(b, d))
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn put(&mut self, index: usize, components: [T; $whole]) {
                let (mut first, mut second) = ([components[0]; $first], [components[0]; $second]);
                let mut k = 0;
                while k < $first {
                    first[k] = components[k];
                    k += 1;
                }
                while k < $whole {
                    second[k - $first] = components[k];
                    k += 1;
                }
                self.0.put(index, first);
                self.1.put(index, second);
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn store<const N: usize>(&mut self, first: usize, count: usize, values: &[piola_numerics::Lanes<T, N>; $whole]) {
                if let (Some(head), Some(tail)) = (values.first_chunk(), values.last_chunk()) {
                    self.0.store(first, count, head);
                    self.1.store(first, count, tail);
                }
            }
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn scatter<const N: usize>(&mut self, first: usize, count: usize, values: &[piola_numerics::Lanes<T, N>; $whole]) {
                if let (Some(head), Some(tail)) = (values.first_chunk(), values.last_chunk()) {
                    self.0.scatter(first, count, head);
                    self.1.scatter(first, count, tail);
                }
            }
        }
    };
    ($output:ty, $whole:literal = $first_output:ty, $first:literal + $second_output:ty, $second:literal) => {
        $crate::together!([] $output, $whole = $first_output, $first + $second_output, $second);
    };
}
