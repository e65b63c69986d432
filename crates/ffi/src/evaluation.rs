//! The loop over the points of a batch.

use piola::continuum::DeformationGradient;
use piola::solids::{AnySolid, Hyperelastic, SolidsError};

use crate::FfiError;
use crate::blocks::{to_blocks, to_points};
use crate::conversions::{
    ALL_NINE, BY_ROWS, CauchyOfFirstPiola, JaumannOfFirstPiola, MaterialOfFirstPiola, SQUARE, SecondPiolaOfFirstPiola,
    TruesdellOfFirstPiola,
};
use crate::measures::{StressMeasure, TangentMeasure, VoigtNumbering};
use crate::stages::{Kind, MOST, Number, WIDTH, run};

/// Points from which on, with feature `rayon`, a batch runs on all threads.
#[cfg(feature = "rayon")]
const PARALLEL: usize = 1 << 13;

/// What a call asks for: a measure of stress, a measure of the tangent, or both.
#[derive(Clone, Copy)]
pub(crate) struct Wanted {
    pub(crate) stress: Option<StressMeasure>,
    pub(crate) tangent: Option<(TangentMeasure, VoigtNumbering)>,
}

/// Some of the points of a batch, from number `first` on; an array is empty where its numbers are not wanted.
pub(crate) struct Part<'a> {
    pub(crate) first: usize,
    pub(crate) f: &'a [[f64; 9]],
    pub(crate) stresses: &'a mut [[f64; 9]],
    pub(crate) tangents: &'a mut [f64],
}

impl Part<'_> {
    /// The first `middle` points, and the others.
    fn split(&mut self, middle: usize, numbers: usize) -> (Part<'_>, Part<'_>) {
        let (f, other_f) = self.f.split_at(middle);
        let (stresses, other_stresses) = self.stresses.split_at_mut(middle.min(self.stresses.len()));
        let (tangents, other_tangents) = self.tangents.split_at_mut((middle * numbers).min(self.tangents.len()));
        let head = Part { first: self.first, f, stresses, tangents };
        (head, Part { first: self.first + middle, f: other_f, stresses: other_stresses, tangents: other_tangents })
    }
}

/// Points that were refused.
pub(crate) type Bad = crate::error::Bad<SolidsError>;

/// The error of a batch of `count` points.
pub(crate) fn finished(bad: Bad, count: usize) -> Result<(), FfiError> {
    bad.finish(|bad, index, error| FfiError::BadPoints { bad, count, index, error })
}

/// F of a point, if it is one and the law has an answer there.
pub(crate) fn deformation(law: &AnySolid, f: &[f64; 9]) -> Result<DeformationGradient, SolidsError> {
    let [a, b, c, d, e, g, h, i, j] = *f;
    let deformation = DeformationGradient::from_rows([[a, b, c], [d, e, g], [h, i, j]])?;
    law.check(&deformation)?;
    Ok(deformation)
}

/// One call: the law, and the measures that it is asked for.
pub(crate) struct Evaluation<'a> {
    law: &'a AnySolid,
    kind: Kind<'a>,
    wanted: Wanted,
}

/// Memory for the blocks that pass through the stages together.
struct Memory<'a> {
    deformations: &'a mut [[Number; 9]],
    first: &'a mut [Number],
    second: &'a mut [Number],
    answers: &'a mut [Number],
    converted: &'a mut [Number],
}

/// Runs `$body` with memory for `$blocks` blocks of deformations and of the numbers that each buffer holds a block.
macro_rules! with_memory {
    ($blocks:expr, [$first:literal, $second:literal, $answers:literal, $converted:literal], |$memory:ident| $body:expr) => {{
        let zero = [0.0; WIDTH];
        let $memory = Memory {
            deformations: &mut [[zero; 9]; $blocks],
            first: &mut [zero; $first * $blocks],
            second: &mut [zero; $second * $blocks],
            answers: &mut [zero; $answers * $blocks],
            converted: &mut [zero; $converted * $blocks],
        };
        $body
    }};
}

impl<'a> Evaluation<'a> {
    pub(crate) fn new(law: &'a AnySolid, wanted: Wanted) -> Result<Self, FfiError> {
        let Some(kind) = Kind::of(law) else {
            // A law that was added to the enum and has no kind yet: no numbers rather than wrong ones.
            let message = "it is not offered to other languages".to_owned();
            return Err(FfiError::Unreadable { what: "law of a solid", message });
        };
        Ok(Self { law, kind, wanted })
    }

    /// Whether the law is linear elasticity, which knows no difference between the measures: each stress is σ, each tangent of 36
    /// numbers ∂σ/∂ε.
    const fn is_linear(&self) -> bool {
        matches!(self.kind, Kind::Linear(_))
    }

    /// Numbers of a tangent.
    fn numbers(&self) -> usize {
        self.wanted.tangent.map_or(0, |(measure, _)| measure.numbers())
    }

    /// Computes the numbers of all points.
    pub(crate) fn run(&self, part: Part<'_>) -> Result<(), FfiError> {
        let count = part.f.len();
        finished(self.divided(part), count)
    }

    #[cfg(feature = "rayon")]
    fn divided(&self, mut part: Part<'_>) -> Bad {
        if part.f.len() < PARALLEL || rayon::current_num_threads() < 2 {
            return self.part(part);
        }
        let half = (part.f.len() / 2).next_multiple_of(MOST * WIDTH);
        let (head, tail) = part.split(half, self.numbers());
        let (head, tail) = rayon::join(|| self.divided(head), || self.divided(tail));
        head.and(tail)
    }

    #[cfg(not(feature = "rayon"))]
    fn divided(&self, part: Part<'_>) -> Bad {
        self.part(part)
    }

    /// Evaluates the points on this thread. The memory on the stack fits the request: it has no room for tangents that nobody asked for,
    /// and one block for a few points, because all of it is cleared first.
    #[expect(clippy::large_stack_arrays, reason = "66 kB, and nothing is allocated")]
    fn part(&self, part: Part<'_>) -> Bad {
        match (self.wanted.tangent.is_some(), part.f.len() <= WIDTH) {
            (false, false) => with_memory!(MOST, [7, 5, 10, 6], |memory| self.blocks(part, memory)),
            (false, true) => with_memory!(1, [7, 5, 10, 6], |memory| self.blocks(part, memory)),
            (true, false) => with_memory!(MOST, [10, 34, 55, 21], |memory| self.blocks(part, memory)),
            (true, true) => with_memory!(1, [10, 34, 55, 21], |memory| self.blocks(part, memory)),
        }
    }

    /// As many blocks at a time as there is memory for.
    fn blocks(&self, mut part: Part<'_>, mut memory: Memory<'_>) -> Bad {
        let mut bad = Bad::default();
        let most = memory.deformations.len() * WIDTH;
        let places = self.wanted.tangent.map(|(_, numbering)| numbering.places());
        let mut rest = part.f.len();
        while 0 < rest {
            let count = most.min(rest);
            let done = part.f.len() - rest;
            let (_, mut from_here) = part.split(done, self.numbers());
            let (mut here, _) = from_here.split(count, self.numbers());
            self.chunk(&mut here, &mut memory, places.as_ref(), &mut bad);
            rest -= count;
        }
        bad
    }

    /// Points for which there is memory.
    fn chunk(&self, part: &mut Part<'_>, memory: &mut Memory<'_>, places: Option<&[usize; 36]>, bad: &mut Bad) {
        let points = part.f.len();
        let blocks = points.div_ceil(WIDTH);
        let f = &mut memory.deformations[..blocks];
        to_blocks(part.f, f);
        let stride = if self.wanted.tangent.is_some() {
            self.kind.both(points, f, [memory.first, memory.second, memory.answers]);
            55
        } else {
            self.kind.stress(points, f, [memory.first, memory.second, memory.answers]);
            10
        };
        // Of whole blocks, before conversions of linear elasticity overwrite P.
        let mut doubts = [[0.0; WIDTH]; MOST];
        for (doubt, answer) in doubts.iter_mut().zip(memory.answers.chunks(stride)).take(blocks) {
            add(doubt, &answer[0]);
            add(doubt, &answer[stride - 1]);
        }
        if let Some(measure) = self.wanted.stress {
            let numbers = self.stress(measure, points, stride, memory, part.stresses);
            add_all(&mut doubts[..blocks], numbers);
        }
        if let (Some((measure, _)), Some(places)) = (self.wanted.tangent, places) {
            let numbers = self.tangent(measure, places, points, memory, part.tangents);
            add_all(&mut doubts[..blocks], numbers);
        }
        let numbers = self.numbers();
        for index in (0..points).filter(|index| !doubts[index / WIDTH][index % WIDTH].is_finite()) {
            let stress = part.stresses.get_mut(index).map_or(&mut [][..], |stress| &mut stress[..]);
            let tangent = &mut part.tangents[numbers * index..][..numbers];
            if let Err(error) = self.check(&part.f[index], stress, tangent) {
                bad.note(part.first + index, error);
                stress.fill(f64::NAN);
                tangent.fill(f64::NAN);
            }
        }
    }

    /// The error of a point: its gradient is no deformation, the law refuses it, or a number of the answer is not finite.
    #[cold]
    fn check(&self, f: &[f64; 9], stress: &[f64], tangent: &[f64]) -> Result<(), SolidsError> {
        deformation(self.law, f)?;
        for (answer, numbers) in [("stress", stress), ("tangent", tangent)] {
            if !numbers.iter().all(|x| x.is_finite()) {
                return Err(SolidsError::Overflow { answer });
            }
        }
        Ok(())
    }

    /// Writes the stresses; returns the blocks of numbers that they were taken from.
    fn stress<'m>(
        &self,
        measure: StressMeasure,
        points: usize,
        stride: usize,
        memory: &'m mut Memory<'_>,
        out: &mut [[f64; 9]],
    ) -> &'m [Number] {
        let blocks = points.div_ceil(WIDTH);
        if measure == StressMeasure::FirstPiola || self.is_linear() {
            let answers = &memory.answers[..stride * blocks];
            to_points(answers, stride, &BY_ROWS, out);
            return answers;
        }
        // P alone, as conversions take it.
        let stress = if stride == 10 {
            &*memory.answers
        } else {
            let of_blocks = memory.answers.chunks(stride).zip(memory.first.chunks_mut(10)).take(blocks);
            of_blocks.for_each(|(from, to)| to[..9].copy_from_slice(&from[..9]));
            &*memory.first
        };
        let (f, converted) = (&memory.deformations[..blocks], &mut *memory.converted);
        if measure == StressMeasure::Cauchy {
            run::<_, 10, 6>(&CauchyOfFirstPiola, points, f, stress, converted);
        } else {
            run::<_, 10, 6>(&SecondPiolaOfFirstPiola, points, f, stress, converted);
        }
        to_points(converted, 6, &ALL_NINE, out);
        &memory.converted[..6 * blocks]
    }

    /// Writes the tangents; returns the blocks of numbers that they were taken from.
    fn tangent<'m>(
        &self,
        measure: TangentMeasure,
        places: &[usize; 36],
        points: usize,
        memory: &'m mut Memory<'_>,
        out: &mut [f64],
    ) -> &'m [Number] {
        let blocks = points.div_ceil(WIDTH);
        if measure == TangentMeasure::FirstPiola {
            let answers = &memory.answers[..55 * blocks];
            to_points(answers, 55, &SQUARE, out.as_chunks_mut().0);
            return answers;
        }
        let f = &mut memory.deformations[..blocks];
        if self.is_linear() {
            // ∂σ/∂ε is ∂P/∂F itself: the conversion is that of F = 1 without a stress.
            for block in &mut *f {
                *block = core::array::from_fn(|k| [if k % 4 == 0 { 1.0 } else { 0.0 }; WIDTH]);
            }
            for answers in memory.answers.chunks_mut(55) {
                answers[..9].fill([0.0; WIDTH]);
            }
        }
        let (answers, converted) = (&*memory.answers, &mut *memory.converted);
        match measure {
            TangentMeasure::Truesdell => run::<_, 55, 21>(&TruesdellOfFirstPiola, points, f, answers, converted),
            TangentMeasure::Jaumann => run::<_, 55, 21>(&JaumannOfFirstPiola, points, f, answers, converted),
            TangentMeasure::Material | TangentMeasure::FirstPiola => {
                run::<_, 55, 21>(&MaterialOfFirstPiola, points, f, answers, converted);
            }
        }
        to_points(converted, 21, places, out.as_chunks_mut().0);
        &memory.converted[..21 * blocks]
    }
}

/// Adds the numbers of each block to its sums: a sum is not finite where a number of its point is not.
fn add_all(sums: &mut [Number], numbers: &[Number]) {
    let stride = numbers.len() / sums.len();
    for (sum, numbers) in sums.iter_mut().zip(numbers.chunks_exact(stride)) {
        let mut total = *sum;
        for number in numbers {
            add(&mut total, number);
        }
        *sum = total;
    }
}

fn add(sum: &mut Number, number: &Number) {
    for (sum, number) in sum.iter_mut().zip(number) {
        *sum += number;
    }
}
