//! Layouts of numbers that have no type of their own.

use crate::BatchError;

/// Nine numbers by columns for each point.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_batch::{ColumnMajor, Gradients};
/// let numbers = [1.0, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]; // F₂₁ = 2: simple shear
/// let mut c = [[0.0; 6]];
/// let f = Gradients(ColumnMajor(batch::points_of::<9, _>(&numbers)?));
/// batch::evaluate(f, batch::right_cauchy_green(&mut c[..]))?;
/// assert_eq!(c[0], [5.0, 1.0, 1.0, 2.0, 0.0, 0.0]);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ColumnMajor<A>(
    /// Nine numbers for each point: see [`points_of`].
    pub A,
);

/// Symmetric tensors given by all nine numbers, which must agree.
///
/// Where a symmetric tensor is asked for, this reads any layout of nine. A point whose opposite entries differ by more
/// than 32 ulp of its largest is a bad point, [`TensorError::NotSymmetric`](piola_tensor::TensorError::NotSymmetric); of the others the symmetric part is
/// taken.
///
/// # Example
/// ```
/// use nalgebra::Matrix3;
/// use piola_batch::BatchError;
/// use piola_batch as batch;
/// use piola_batch::{AllEntries, Undeformed};
/// use piola_continuum::ContinuumError;
/// use piola_tensor::TensorError;
/// let mut stress = [Matrix3::from_diagonal(&[250.0, 0.0, 0.0].into()); 100];
/// let mut equivalent = [0.0; 100];
/// batch::evaluate(Undeformed(100), batch::von_mises(AllEntries(&stress[..]), &mut equivalent[..]))?;
/// assert_eq!(equivalent[7], 250.0);
/// stress[7][(0, 1)] = 0.5; // and (1, 0) = 0
/// let bad = batch::evaluate(Undeformed(100), batch::von_mises(AllEntries(&stress[..]), &mut equivalent[..]));
/// let Err(BatchError::BadPoints { points, .. }) = bad else { unreachable!() };
/// assert_eq!(points[0].index, 7);
/// let BatchError::Continuum(ContinuumError::Tensor(why)) = &points[0].error else { unreachable!() };
/// assert!(matches!(why, TensorError::NotSymmetric { row: 0, column: 1, .. }));
/// # Ok::<(), BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AllEntries<A>(
    /// Nine numbers for each point.
    pub A,
);

/// A structure of arrays: an array for each component, in the order of the components.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_batch::{Components, Gradients};
/// let (o, l, k) = ([0.0; 100], [1.0; 100], [2.0; 100]);
/// let f = Components::new([&l[..], &o, &o, &k, &l, &o, &o, &o, &l])?; // F₂₁ = 2 at a hundred points
/// let mut j = [0.0; 100];
/// batch::evaluate(Gradients(f), batch::jacobian(&mut j[..]))?;
/// assert_eq!(j, [1.0; 100]);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Components<A, const K: usize>(pub(super) [A; K]);

/// Blocks of B points, in a block an array of B numbers for each component: the layout of the lanes themselves.
///
/// ```text
/// component k of point i at blocks[i / B][k][i mod B]
/// ```
/// It is read and written without moving a number to another lane, and as one stream of memory however many
/// components there are: the fastest layout in cache and in memory. B = 8 is the best for `f64` on every machine, 16 for
/// `f32`; it must be a power of two up to 64. What the last block holds beyond the last point is neither read nor
/// written.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_batch::{Gradients, LaneBlocks};
/// let (o, l, k) = ([0.0; 8], [1.0; 8], [2.0; 8]);
/// let f = [[l, o, o, k, l, o, o, o, l]; 13]; // F₂₁ = 2 at a hundred points
/// let mut c = [[[0.0; 8]; 6]; 13];
/// let f = Gradients(LaneBlocks::new(&f, 100)?);
/// batch::evaluate(f, batch::right_cauchy_green(LaneBlocks::new_mut(&mut c, 100)?))?;
/// assert_eq!([c[12][0][3], c[12][1][3], c[12][3][3]], [5.0, 1.0, 2.0]);
/// assert_eq!(c[12][0][4], 0.0); // beyond the last point
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LaneBlocks<A> {
    pub(super) blocks: A,
    pub(super) count: usize,
}

/// Whether so many blocks of B hold so many points and no more blocks than that.
fn check_blocks<const B: usize>(found: usize, count: usize) -> Result<(), BatchError> {
    // Parts of a batch are divided at multiples of 64.
    const { assert!(0 < B && 64 % B == 0, "a block has 1, 2, 4, … or 64 points") };
    let expected = count.div_ceil(B);
    if found == expected {
        return Ok(());
    }
    Err(BatchError::WrongLength { quantity: "blocks of points", found, expected })
}

impl<'a, T, const K: usize, const B: usize> LaneBlocks<&'a [[[T; B]; K]]> {
    /// From blocks and the number of points.
    ///
    /// # Errors
    /// [`BatchError::WrongLength`] when there are not just as many blocks as the points fill.
    pub fn new(blocks: &'a [[[T; B]; K]], count: usize) -> Result<Self, BatchError> {
        check_blocks::<B>(blocks.len(), count).map(|()| Self { blocks, count })
    }
}

impl<'a, T, const K: usize, const B: usize> LaneBlocks<&'a mut [[[T; B]; K]]> {
    /// As [`new`](LaneBlocks::new), to be written.
    ///
    /// # Errors
    /// As [`new`](LaneBlocks::new).
    pub fn new_mut(blocks: &'a mut [[[T; B]; K]], count: usize) -> Result<Self, BatchError> {
        check_blocks::<B>(blocks.len(), count).map(|()| Self { blocks, count })
    }
}

/// Component k of point i at `data[i stride + places[k]]`.
///
/// # Example
/// ```
/// use piola_batch as batch;
/// use piola_batch::{Gradients, Strided};
/// // Two points, the matrix by rows after a number that is something else.
/// let numbers = [7.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 7.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let f = Strided::new(&numbers[..], 10, [1, 2, 3, 4, 5, 6, 7, 8, 9])?;
/// let mut j = [0.0; 2];
/// batch::evaluate(Gradients(f), batch::jacobian(&mut j[..]))?;
/// assert_eq!(j, [2.0, 3.0]);
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Strided<A, const K: usize> {
    pub(super) data: A,
    pub(super) stride: usize,
    pub(super) places: [usize; K],
    pub(super) count: usize,
}

impl<A, const K: usize> Strided<A, K> {
    /// From numbers, the distance from point to point and the places of the components in a point.
    ///
    /// The last point may end with its last component.
    ///
    /// # Errors
    /// [`BatchError::WrongLength`] when a component's place is not below the stride, or when the numbers end
    /// within a point.
    pub fn new<T>(data: A, stride: usize, places: [usize; K]) -> Result<Self, BatchError>
    where
        A: AsRef<[T]>,
    {
        let (found, span) = (data.as_ref().len(), places.into_iter().max().map_or(0, |place| place + 1));
        if stride < span {
            return Err(BatchError::WrongLength { quantity: "stride of a point", found: stride, expected: span });
        }
        let (whole, rest) = (found / stride.max(1), found % stride.max(1));
        if rest != 0 && rest < span {
            let expected = whole * stride + span;
            return Err(BatchError::WrongLength { quantity: "numbers at a stride", found, expected });
        }
        Ok(Self { data, stride, places, count: whole + usize::from(rest != 0) })
    }
}

/// Numbers as points of K components each, without a copy.
///
/// # Errors
/// [`BatchError::WrongLength`] when the numbers end within a point.
///
/// # Example
/// ```
/// use piola_batch::points_of;
/// assert_eq!(points_of::<2, _>(&[1.0, 2.0, 3.0, 4.0])?, &[[1.0, 2.0], [3.0, 4.0]]);
/// assert!(points_of::<2, _>(&[1.0, 2.0, 3.0]).is_err());
/// # Ok::<(), piola_batch::BatchError>(())
/// ```
pub fn points_of<const K: usize, T>(numbers: &[T]) -> Result<&[[T; K]], BatchError> {
    match numbers.as_chunks() {
        (points, []) => Ok(points),
        (points, _) => Err(incomplete(numbers.len(), points.len() * K + K)),
    }
}

/// As [`points_of`], to be written.
///
/// # Errors
/// [`BatchError::WrongLength`] when the numbers end within a point.
pub fn points_of_mut<const K: usize, T>(numbers: &mut [T]) -> Result<&mut [[T; K]], BatchError> {
    let found = numbers.len();
    match numbers.as_chunks_mut() {
        (points, []) => Ok(points),
        (points, _) => Err(incomplete(found, points.len() * K + K)),
    }
}

fn incomplete(found: usize, expected: usize) -> BatchError {
    BatchError::WrongLength { quantity: "numbers of points", found, expected }
}
