//! Only what is asked for is computed, and what several outputs share is computed once.

use std::sync::atomic::{AtomicUsize, Ordering};

use piola_batch as batch;
use piola_batch::{BatchError, Deformations, Requests};
use piola_continuum::{Deformation, Symmetric};
use piola_numerics::{Lanes, Real};
use piola_tensor::internal::rows::{Rows, identity};

/// How often F, ∇u, det F and det F − 1 were asked of the points.
static ASKED: [AtomicUsize; 4] = [const { AtomicUsize::new(0) }; 4];

/// A body at rest that counts what is asked of it.
#[derive(Clone, Copy)]
struct Counting;

fn count(which: usize) {
    ASKED[which].fetch_add(1, Ordering::Relaxed);
}

impl<T: Real> Deformation<T> for Counting {
    fn lifted<S: Real>(&self, _lift: impl Fn(usize, usize, T) -> S) -> impl Deformation<S> {
        *self
    }
    fn gradient_rows(&self) -> Rows<T> {
        count(0);
        identity()
    }
    fn displacement_rows(&self) -> Rows<T> {
        count(1);
        [[T::zero(); 3]; 3]
    }
    fn jacobian(&self) -> T {
        count(2);
        T::one()
    }
    fn volume_change(&self) -> T {
        count(3);
        T::zero()
    }
}

/// Two such points: one block of lanes, however many lanes there are.
#[derive(Clone, Copy)]
struct Block;

impl Deformations<f64> for Block {
    type Point<S: Real> = Counting;
    const TRUSTED: bool = true;
    fn count(&self) -> usize {
        2
    }
    fn load<const N: usize>(&self, _first: usize, _count: usize) -> Counting {
        let _: Lanes<f64, N>;
        Counting
    }
    fn check(&self, _index: usize) -> Result<(), BatchError> {
        Ok(())
    }
}

fn asked(requests: impl Requests<f64>) -> [usize; 4] {
    for counter in &ASKED {
        counter.store(0, Ordering::Relaxed);
    }
    batch::evaluate(Block, requests).expect("at rest");
    ASKED.each_ref().map(|counter| counter.load(Ordering::Relaxed))
}

/// One test: the counters are shared.
#[test]
fn only_what_is_requested_is_asked_of_the_deformation() {
    let (mut j, mut k) = ([0.0; 2], [0.0; 2]);
    let (mut a, mut b, mut c) = ([Symmetric::zero(); 2], [Symmetric::zero(); 2], [Symmetric::zero(); 2]);
    let t = [Symmetric::<f64>::zero(); 2];
    let mut p = [[[0.0; 3]; 3]; 2];
    assert_eq!(asked(batch::jacobian(&mut j[..])), [0, 0, 1, 0]);
    assert_eq!(asked(batch::right_cauchy_green(&mut a[..])), [1, 0, 0, 0]);
    assert_eq!(asked(batch::green_strain(&mut a[..])), [0, 1, 0, 0]);
    assert_eq!(asked(batch::von_mises(&t[..], &mut k[..])), [0, 0, 0, 0]);
    assert_eq!(asked(batch::cauchy_to_first_piola(&t[..], &mut p[..])), [1, 0, 0, 0]);
    // The analysis of the stretches once, for one output or for all.
    let one = asked(batch::right_stretch(&mut a[..]));
    let all = (
        batch::right_stretch(&mut a[..]),
        batch::left_stretch(&mut b[..]),
        batch::hencky(&mut c[..]),
        batch::rotation(&mut p[..]),
    );
    assert_eq!(asked(all), one);
    assert_eq!(one, [1, 1, 0, 0]);
}

#[test]
fn the_need_of_the_stretches_is_known_when_the_program_is_compiled() {
    fn needs<R: Requests<f64>>(_: &R) -> bool {
        R::NEEDS_STRETCH
    }
    let (mut j, mut a) = ([0.0; 1], [Symmetric::zero(); 1]);
    assert!(!needs(&batch::jacobian(&mut j[..])));
    assert!(needs(&(batch::jacobian(&mut j[..]), batch::right_stretch(&mut a[..]))));
}
