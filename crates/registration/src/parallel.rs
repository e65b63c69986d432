//! Loops over samples, on all cores with the feature `rayon`: a tree of halves, the same for any number of threads.

use std::ops::Range;

/// Samples of one leaf of the tree.
const LEAF: usize = 2048;

/// Samples from which on halves run on two threads.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 16_384;

/// What a loop runs over: ranges, slices that it writes, and pairs of these.
pub(crate) trait Span: Sized + Send {
    fn count(&self) -> usize;
    fn halves(self, at: usize) -> (Self, Self);
}

impl Span for Range<usize> {
    fn count(&self) -> usize {
        self.len()
    }
    fn halves(self, at: usize) -> (Self, Self) {
        (self.start..self.start + at, self.start + at..self.end)
    }
}

impl<A: Send> Span for &mut [A] {
    fn count(&self) -> usize {
        self.len()
    }
    fn halves(self, at: usize) -> (Self, Self) {
        self.split_at_mut(at)
    }
}

impl<X: Span, Y: Span> Span for (X, Y) {
    fn count(&self) -> usize {
        self.0.count()
    }
    fn halves(self, at: usize) -> (Self, Self) {
        let (x, y) = (self.0.halves(at), self.1.halves(at));
        ((x.0, y.0), (x.1, y.1))
    }
}

/// Runs `leaf(first position, part)` over all parts of `span`. The results are merged in an order that does not depend on the
/// number of threads.
pub(crate) fn fold<P: Span, S: Send>(
    span: P,
    leaf: &(impl Fn(usize, P) -> S + Sync),
    merge: &(impl Fn(S, S) -> S + Sync),
) -> S {
    part(0, span, LEAF, leaf, merge)
}

/// Runs `leaf(first position, part)` over all parts of `span`.
pub(crate) fn each<P: Span>(span: P, leaf: &(impl Fn(usize, P) + Sync)) {
    part(0, span, LEAF, leaf, &|(), ()| ());
}

/// The sum of `leaf` over all parts of `span`.
pub(crate) fn sum<P: Span>(span: P, leaf: &(impl Fn(usize, P) -> f64 + Sync)) -> f64 {
    part(0, span, LEAF, leaf, &|a, b| a + b)
}

fn part<P: Span, S: Send>(
    start: usize,
    span: P,
    smallest: usize,
    leaf: &(impl Fn(usize, P) -> S + Sync),
    merge: &(impl Fn(S, S) -> S + Sync),
) -> S {
    let count = span.count();
    if count <= smallest {
        return leaf(start, span);
    }
    let half = count / 2;
    let (head, tail) = span.halves(half);
    let (head, tail) =
        join(count, || part(start, head, smallest, leaf, merge), || part(start + half, tail, smallest, leaf, merge));
    merge(head, tail)
}

#[cfg(feature = "rayon")]
fn join<A: Send, B: Send>(count: usize, a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    if PARALLEL <= count { rayon::join(a, b) } else { (a(), b()) }
}

#[cfg(not(feature = "rayon"))]
fn join<A: Send, B: Send>(_count: usize, a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    (a(), b())
}
