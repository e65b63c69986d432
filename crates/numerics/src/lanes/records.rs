//! Records of K numbers to lanes and back: a transposition, in registers where the machine has wide ones.
//!
//! The compiler makes of the plain loop a move for each number. In registers eight records of eight doubles take 24
//! shuffles: nine numbers a point take 0.7 ns a point instead of 1.6, each way.

use super::{Element, Lanes};

/// Numbers of doubles that are gathered in registers on this architecture.
pub(super) const DOUBLES_IN_REGISTERS: [usize; 2] = if cfg!(target_arch = "x86_64") { [4, 8] } else { [0, 0] };

impl<T: Element, const N: usize> Lanes<T, N> {
    /// Whether [`gather`](Self::gather) and [`scatter`](Self::scatter) use registers as wide as the lanes, where the
    /// machine has them.
    pub const IN_REGISTERS: bool = T::IN_REGISTERS[0] == N || T::IN_REGISTERS[1] == N;

    /// The K components of N records, a record a lane.
    ///
    /// A record is K numbers, or with `ROWS` other than 1 a matrix of so many rows that lies in memory by columns; the
    /// components are by rows always.
    ///
    /// Fastest in a kernel that runs with as many lanes as the registers of its [`Level`](crate::Level) hold.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn gather<const K: usize, const ROWS: usize>(records: [&[T; K]; N], components: &mut [Self; K]) {
        T::gather::<N, K, ROWS>(records, components);
    }

    /// The inverse of [`gather`](Self::gather): the components of each lane to its record.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn scatter<const K: usize, const ROWS: usize>(components: &[Self; K], records: [&mut [T; K]; N]) {
        T::scatter::<N, K, ROWS>(components, records);
    }
}

/// The component of number k of a record.
#[cfg_attr(not(debug_assertions), inline(always))]
const fn by_rows<const K: usize, const ROWS: usize>(k: usize) -> usize {
    k % ROWS * (K / ROWS) + k / ROWS
}

/// Number by number.
#[cfg_attr(not(debug_assertions), inline(always))]
fn gather_each<T: Element, const N: usize, const K: usize, const ROWS: usize>(
    records: [&[T; K]; N],
    components: &mut [Lanes<T, N>; K],
) {
    for (lane, record) in records.into_iter().enumerate() {
        let mut k = 0;
        while k < K {
            components[by_rows::<K, ROWS>(k)].0[lane] = record[k];
            k += 1;
        }
    }
}

/// Number by number.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scatter_each<T: Element, const N: usize, const K: usize, const ROWS: usize>(
    components: &[Lanes<T, N>; K],
    records: [&mut [T; K]; N],
) {
    for (lane, record) in records.into_iter().enumerate() {
        let mut k = 0;
        while k < K {
            record[k] = components[by_rows::<K, ROWS>(k)].0[lane];
            k += 1;
        }
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gather_singles<const N: usize, const K: usize, const ROWS: usize>(
    records: [&[f32; K]; N],
    components: &mut [Lanes<f32, N>; K],
) {
    gather_each::<_, N, K, ROWS>(records, components);
}

#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn scatter_singles<const N: usize, const K: usize, const ROWS: usize>(
    components: &[Lanes<f32, N>; K],
    records: [&mut [f32; K]; N],
) {
    scatter_each::<_, N, K, ROWS>(components, records);
}

#[cfg_attr(not(debug_assertions), inline(always))]
#[cfg(not(target_arch = "x86_64"))]
pub(super) fn gather_doubles<const N: usize, const K: usize, const ROWS: usize>(
    records: [&[f64; K]; N],
    components: &mut [Lanes<f64, N>; K],
) {
    gather_each::<_, N, K, ROWS>(records, components);
}

#[cfg_attr(not(debug_assertions), inline(always))]
#[cfg(not(target_arch = "x86_64"))]
pub(super) fn scatter_doubles<const N: usize, const K: usize, const ROWS: usize>(
    components: &[Lanes<f64, N>; K],
    records: [&mut [f64; K]; N],
) {
    scatter_each::<_, N, K, ROWS>(components, records);
}

#[cfg(target_arch = "x86_64")]
pub(super) use x86::{gather_doubles, scatter_doubles};

#[cfg(target_arch = "x86_64")]
#[expect(unsafe_code, reason = "the compiler does not make shuffles of the plain loops")]
mod x86 {
    use core::arch::x86_64::{
        __m256d, __m512d, __mmask8, _mm_load_sd, _mm_loadh_pd, _mm_storeh_pd, _mm_storel_pd, _mm256_castpd128_pd256,
        _mm256_castpd256_pd128, _mm256_extractf128_pd, _mm256_insertf128_pd, _mm256_loadu_pd, _mm256_permute2f128_pd,
        _mm256_setzero_pd, _mm256_storeu_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd, _mm512_castpd256_pd512,
        _mm512_castpd512_pd256, _mm512_extractf64x4_pd, _mm512_insertf64x4, _mm512_loadu_pd, _mm512_mask_storeu_pd,
        _mm512_maskz_loadu_pd, _mm512_setzero_pd, _mm512_shuffle_f64x2, _mm512_storeu_pd, _mm512_unpackhi_pd,
        _mm512_unpacklo_pd,
    };

    use super::{Lanes, by_rows, gather_each, scatter_each};
    use crate::Level;

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(in super::super) fn gather_doubles<const N: usize, const K: usize, const ROWS: usize>(
        records: [&[f64; K]; N],
        components: &mut [Lanes<f64, N>; K],
    ) {
        if N == 8 && Level::Avx512 <= Level::best() {
            // SAFETY: the machine has the features.
            unsafe { gather_8::<N, K, ROWS>(&records, components) };
        } else if N == 4 && Level::Avx2 <= Level::best() {
            // SAFETY: the machine has the features.
            unsafe { gather_4::<N, K, ROWS>(&records, components) };
        } else {
            gather_each::<_, N, K, ROWS>(records, components);
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(in super::super) fn scatter_doubles<const N: usize, const K: usize, const ROWS: usize>(
        components: &[Lanes<f64, N>; K],
        mut records: [&mut [f64; K]; N],
    ) {
        if N == 8 && Level::Avx512 <= Level::best() {
            // SAFETY: the machine has the features.
            unsafe { scatter_8::<N, K, ROWS>(components, &mut records) };
        } else if N == 4 && Level::Avx2 <= Level::best() {
            // SAFETY: the machine has the features.
            unsafe { scatter_4::<N, K, ROWS>(components, &mut records) };
        } else {
            scatter_each::<_, N, K, ROWS>(components, records);
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn gather_8<const N: usize, const K: usize, const ROWS: usize>(
        records: &[&[f64; K]; N],
        components: &mut [Lanes<f64, N>; K],
    ) {
        let Some(records) = records.first_chunk::<8>() else { return };
        let mut k = 0;
        while k + 8 <= K {
            let mut rows = [_mm512_setzero_pd(); 8];
            let mut row = 0;
            while row < 8 {
                // SAFETY: eight numbers are there.
                rows[row] = unsafe { _mm512_loadu_pd(records[row][k..k + 8].as_ptr()) };
                row += 1;
            }
            let columns = transposed_8(rows);
            let mut column = 0;
            while column < 8 {
                put_8(columns[column], &mut components[by_rows::<K, ROWS>(k + column)].0);
                column += 1;
            }
            k += 8;
        }
        if K % 8 <= FEW {
            while k < K {
                let [a, b, c, d, e, f, g, h] = records;
                let head = column_of_4([&a[k], &b[k], &c[k], &d[k]]);
                let tail = column_of_4([&e[k], &f[k], &g[k], &h[k]]);
                put_8(
                    _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(head), tail),
                    &mut components[by_rows::<K, ROWS>(k)].0,
                );
                k += 1;
            }
            return;
        }
        let mut rows = [_mm512_setzero_pd(); 8];
        let mut row = 0;
        while row < 8 {
            // SAFETY: only the lanes of the mask are read, which are there.
            rows[row] = unsafe { _mm512_maskz_loadu_pd(const { lowest(K % 8) }, records[row][k..].as_ptr()) };
            row += 1;
        }
        let columns = transposed_8(rows);
        let mut column = 0;
        while column < K % 8 {
            put_8(columns[column], &mut components[by_rows::<K, ROWS>(k + column)].0);
            column += 1;
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn scatter_8<const N: usize, const K: usize, const ROWS: usize>(
        components: &[Lanes<f64, N>; K],
        records: &mut [&mut [f64; K]; N],
    ) {
        let Some(records) = records.first_chunk_mut::<8>() else { return };
        let mut k = 0;
        while k + 8 <= K {
            let mut columns = [_mm512_setzero_pd(); 8];
            let mut column = 0;
            while column < 8 {
                columns[column] = take_8(&components[by_rows::<K, ROWS>(k + column)].0);
                column += 1;
            }
            let rows = transposed_8(columns);
            let mut row = 0;
            while row < 8 {
                // SAFETY: there is room for eight numbers.
                unsafe { _mm512_storeu_pd(records[row][k..k + 8].as_mut_ptr(), rows[row]) };
                row += 1;
            }
            k += 8;
        }
        if K % 8 <= FEW {
            while k < K {
                let column = take_8(&components[by_rows::<K, ROWS>(k)].0);
                let [a, b, c, d, e, f, g, h] = &mut *records;
                scatter_column_of_4(_mm512_castpd512_pd256(column), [&mut a[k], &mut b[k], &mut c[k], &mut d[k]]);
                let tail = _mm512_extractf64x4_pd::<1>(column);
                scatter_column_of_4(tail, [&mut e[k], &mut f[k], &mut g[k], &mut h[k]]);
                k += 1;
            }
            return;
        }
        let mut columns = [_mm512_setzero_pd(); 8];
        let mut column = 0;
        while column < K % 8 {
            columns[column] = take_8(&components[by_rows::<K, ROWS>(k + column)].0);
            column += 1;
        }
        let rows = transposed_8(columns);
        let mut row = 0;
        while row < 8 {
            // SAFETY: only the lanes of the mask are written, for which there is room.
            unsafe { _mm512_mask_storeu_pd(records[row][k..].as_mut_ptr(), const { lowest(K % 8) }, rows[row]) };
            row += 1;
        }
    }

    /// Columns of the last ones, fewer than eight, that are moved number by number.
    const FEW: usize = 2;

    /// The lowest `count` of eight lanes.
    const fn lowest(count: usize) -> __mmask8 {
        (1 << count) - 1
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn put_8<const N: usize>(numbers: __m512d, to: &mut [f64; N]) {
        if let Some(to) = to.first_chunk_mut::<8>() {
            // SAFETY: there is room for eight numbers.
            unsafe { _mm512_storeu_pd(to.as_mut_ptr(), numbers) };
        }
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn take_8<const N: usize>(from: &[f64; N]) -> __m512d {
        match from.first_chunk::<8>() {
            // SAFETY: eight numbers are there.
            Some(from) => unsafe { _mm512_loadu_pd(from.as_ptr()) },
            None => _mm512_setzero_pd(),
        }
    }

    /// The transpose of eight rows: pairs of neighbours, then halves and quarters of the columns.
    #[inline]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn transposed_8([a, b, c, d, e, f, g, h]: [__m512d; 8]) -> [__m512d; 8] {
        const EVEN: i32 = 0x88;
        const ODD: i32 = 0xdd;
        // Columns 0, 2, 4, 6 and 1, 3, 5, 7 of two rows.
        let (ab_even, ab_odd) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (cd_even, cd_odd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        let (ef_even, ef_odd) = (_mm512_unpacklo_pd(e, f), _mm512_unpackhi_pd(e, f));
        let (gh_even, gh_odd) = (_mm512_unpacklo_pd(g, h), _mm512_unpackhi_pd(g, h));
        // Columns k and k + 4 of four rows.
        let head = [
            _mm512_shuffle_f64x2::<EVEN>(ab_even, cd_even),
            _mm512_shuffle_f64x2::<EVEN>(ab_odd, cd_odd),
            _mm512_shuffle_f64x2::<ODD>(ab_even, cd_even),
            _mm512_shuffle_f64x2::<ODD>(ab_odd, cd_odd),
        ];
        let tail = [
            _mm512_shuffle_f64x2::<EVEN>(ef_even, gh_even),
            _mm512_shuffle_f64x2::<EVEN>(ef_odd, gh_odd),
            _mm512_shuffle_f64x2::<ODD>(ef_even, gh_even),
            _mm512_shuffle_f64x2::<ODD>(ef_odd, gh_odd),
        ];
        [
            _mm512_shuffle_f64x2::<EVEN>(head[0], tail[0]),
            _mm512_shuffle_f64x2::<EVEN>(head[1], tail[1]),
            _mm512_shuffle_f64x2::<EVEN>(head[2], tail[2]),
            _mm512_shuffle_f64x2::<EVEN>(head[3], tail[3]),
            _mm512_shuffle_f64x2::<ODD>(head[0], tail[0]),
            _mm512_shuffle_f64x2::<ODD>(head[1], tail[1]),
            _mm512_shuffle_f64x2::<ODD>(head[2], tail[2]),
            _mm512_shuffle_f64x2::<ODD>(head[3], tail[3]),
        ]
    }

    #[inline(never)]
    #[target_feature(enable = "avx2,fma")]
    fn gather_4<const N: usize, const K: usize, const ROWS: usize>(
        records: &[&[f64; K]; N],
        components: &mut [Lanes<f64, N>; K],
    ) {
        let Some(records) = records.first_chunk::<4>() else { return };
        let mut k = 0;
        while k + 4 <= K {
            let mut rows = [_mm256_setzero_pd(); 4];
            let mut row = 0;
            while row < 4 {
                // SAFETY: four numbers are there.
                rows[row] = unsafe { _mm256_loadu_pd(records[row][k..k + 4].as_ptr()) };
                row += 1;
            }
            let columns = transposed_4(rows);
            let mut column = 0;
            while column < 4 {
                put_4(columns[column], &mut components[by_rows::<K, ROWS>(k + column)].0);
                column += 1;
            }
            k += 4;
        }
        while k < K {
            let [a, b, c, d] = records;
            put_4(column_of_4([&a[k], &b[k], &c[k], &d[k]]), &mut components[by_rows::<K, ROWS>(k)].0);
            k += 1;
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx2,fma")]
    fn scatter_4<const N: usize, const K: usize, const ROWS: usize>(
        components: &[Lanes<f64, N>; K],
        records: &mut [&mut [f64; K]; N],
    ) {
        let Some(records) = records.first_chunk_mut::<4>() else { return };
        let mut k = 0;
        while k + 4 <= K {
            let mut columns = [_mm256_setzero_pd(); 4];
            let mut column = 0;
            while column < 4 {
                columns[column] = take_4(&components[by_rows::<K, ROWS>(k + column)].0);
                column += 1;
            }
            let rows = transposed_4(columns);
            let mut row = 0;
            while row < 4 {
                // SAFETY: there is room for four numbers.
                unsafe { _mm256_storeu_pd(records[row][k..k + 4].as_mut_ptr(), rows[row]) };
                row += 1;
            }
            k += 4;
        }
        while k < K {
            let [a, b, c, d] = &mut *records;
            scatter_column_of_4(
                take_4(&components[by_rows::<K, ROWS>(k)].0),
                [&mut a[k], &mut b[k], &mut c[k], &mut d[k]],
            );
            k += 1;
        }
    }

    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn put_4<const N: usize>(numbers: __m256d, to: &mut [f64; N]) {
        if let Some(to) = to.first_chunk_mut::<4>() {
            // SAFETY: there is room for four numbers.
            unsafe { _mm256_storeu_pd(to.as_mut_ptr(), numbers) };
        }
    }

    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn take_4<const N: usize>(from: &[f64; N]) -> __m256d {
        match from.first_chunk::<4>() {
            // SAFETY: four numbers are there.
            Some(from) => unsafe { _mm256_loadu_pd(from.as_ptr()) },
            None => _mm256_setzero_pd(),
        }
    }

    /// Four numbers, wherever they lie. A plain loop would become an instruction that gathers, which is slow.
    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn column_of_4([a, b, c, d]: [&f64; 4]) -> __m256d {
        // SAFETY: each of them is read from its reference.
        let (head, tail) = unsafe { (_mm_loadh_pd(_mm_load_sd(a), b), _mm_loadh_pd(_mm_load_sd(c), d)) };
        _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(head), tail)
    }

    /// The inverse of [`column_of_4`].
    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn scatter_column_of_4(column: __m256d, [a, b, c, d]: [&mut f64; 4]) {
        let (head, tail) = (_mm256_castpd256_pd128(column), _mm256_extractf128_pd::<1>(column));
        // SAFETY: each of them is written to its reference.
        unsafe {
            _mm_storel_pd(a, head);
            _mm_storeh_pd(b, head);
            _mm_storel_pd(c, tail);
            _mm_storeh_pd(d, tail);
        }
    }

    /// The transpose of four rows.
    #[inline]
    #[target_feature(enable = "avx2,fma")]
    fn transposed_4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
        let (ab_even, ab_odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_even, cd_odd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd),
            _mm256_permute2f128_pd::<0x31>(ab_even, cd_even),
            _mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd),
        ]
    }
}
