//! Vectors of the freedoms by components, eight freedoms side by side, and which freedoms lie on one way to the ground.
//!
//! Columns of large matrices are written eight rows at a time, with zeros for freedoms on other branches.

use core::iter;

use piola_numerics::Real;

use crate::link::{Link, Pair};

pub(crate) const EIGHT: usize = 8;

/// Columns of a product that are summed at once.
pub(crate) const FOUR: usize = 4;

/// Freedoms up to which M⁻¹ multiplies columns, up to n³ operations. Beyond, each column is solved along the tree: n × links, but
/// in longer passes.
pub(crate) const DENSE: usize = 128;

/// Freedoms up to which trees know which freedoms lie on one way to the ground: links × freedoms/4 bytes.
const MOST: usize = 4096;

/// R numbers for each of eight freedoms.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Eight<T, const R: usize>(pub(crate) [[T; EIGHT]; R]);

impl<T: Real, const R: usize> Eight<T, R> {
    pub(crate) fn zeros(freedoms: usize) -> Vec<Self> {
        vec![Self([[T::zero(); EIGHT]; R]); freedoms.div_ceil(EIGHT)]
    }
}

/// Writes some of the numbers of a freedom, from row `from` on.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn put<T: Real, const R: usize, const K: usize>(
    eights: &mut [Eight<T, R>],
    freedom: usize,
    from: usize,
    values: [T; K],
) {
    let (eight, k) = (&mut eights[freedom / EIGHT].0, freedom % EIGHT);
    let mut c = 0;
    while c < K {
        eight[from + c][k] = values[c];
        c += 1;
    }
}

/// The six components of a pair.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn six<T: Real>((a, b): Pair<T>) -> [T; 6] {
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}

/// Whether a scalar takes at most eight bytes, so that eight of them fit a register of 512 bits.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) const fn is_plain<T>() -> bool {
    size_of::<T>() <= size_of::<f64>()
}

/// Whether entries are computed one after the other: for few freedoms, as what was just written cannot be read in eights without
/// waiting, and for scalars of which eight do not fit a register.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) const fn is_paired<T>(freedoms: usize, most: usize) -> bool {
    !is_plain::<T>() || freedoms <= most || MOST < freedoms
}

/// Σ a_c x_c in triples of components.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn product<T: Real, const R: usize>(a: &[T; R], x: &[T; R]) -> T {
    let mut sum = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
    let mut c = 3;
    while c < R {
        sum += a[c] * x[c] + a[c + 1] * x[c + 1] + a[c + 2] * x[c + 2];
        c += 3;
    }
    sum
}

/// [`product`] for one of eight freedoms.
#[cfg_attr(not(debug_assertions), inline(always))]
fn product_of<T: Real, const R: usize>(k: usize, a: &[[T; EIGHT]], x: &[T; R]) -> T {
    let mut at = *x;
    for c in 0..R {
        at[c] = a[c][k];
    }
    product(&at, x)
}

static MASKS: [Eight<f64, 1>; 256] = masks();

const fn masks() -> [Eight<f64, 1>; 256] {
    let mut out = [const { Eight([[0.0; EIGHT]; 1]) }; 256];
    let mut bits = 0;
    while bits < 256 {
        let mut k = 0;
        while k < EIGHT {
            out[bits].0[0][k] = (bits >> k & 1) as f64;
            k += 1;
        }
        bits += 1;
    }
    out
}

/// Σ a_c x_c, x in triples of components, for those of eight freedoms whose bit is set; zero for the others.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn products<T: Real, const R: usize>(bits: u8, a: &[[T; EIGHT]], x: &[T; R]) -> [T; EIGHT] {
    let mut sums = [T::zero(); EIGHT];
    for k in 0..EIGHT {
        sums[k] = product_of(k, a, x);
    }
    if bits != u8::MAX {
        // A product takes less time than a choice: its mask comes from memory as it is.
        let mask = &MASKS[usize::from(bits)].0[0];
        for k in 0..EIGHT {
            sums[k] *= T::lit(mask[k]);
        }
    }
    sums
}

/// a + b.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum<T: Real>(a: [T; EIGHT], b: [T; EIGHT]) -> [T; EIGHT] {
    let mut out = a;
    for k in 0..EIGHT {
        out[k] += b[k];
    }
    out
}

/// Writes eight rows of a column that begin at `at` and end before `end`. Where `out` has columns behind this one, what goes beyond it
/// is written over later.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn write<T: Real>(out: &mut [T], at: usize, end: usize, values: &[T; EIGHT]) {
    if let Some(to) = out.get_mut(at..at + EIGHT) {
        to.copy_from_slice(values);
        return;
    }
    for (to, &value) in out[at..end.min(at + EIGHT)].iter_mut().zip(values) {
        *to = value;
    }
}

/// For each link, in bits for eight freedoms each: the freedoms between it and the ground, and those beyond it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Relatives {
    bits: Vec<[u8; 2]>,
    /// For each four freedoms: those between the ground and one of the four, these among them; then the same with those beyond.
    /// Empty beyond [`DENSE`].
    lists: Vec<[Vec<usize>; 2]>,
    pub(crate) eights: usize,
    /// Whether each link but the last has one link beyond it.
    pub(crate) is_chain: bool,
}

impl Relatives {
    pub(crate) fn of_links(links: &[Link], freedoms: usize) -> Self {
        let eights = freedoms.div_ceil(EIGHT);
        let is_chain = links.iter().enumerate().all(|(i, link)| link.parent == i);
        if MOST < freedoms {
            return Self { bits: Vec::new(), lists: Vec::new(), eights, is_chain };
        }
        let mut bits = vec![[0; 2]; links.len() * eights];
        for (i, link) in links.iter().enumerate().filter(|(_, link)| link.parent != 0) {
            let parent = link.parent - 1;
            for k in 0..eights {
                bits[i * eights + k][0] = bits[parent * eights + k][0] | links[parent].bits(k);
            }
        }
        for (i, link) in links.iter().enumerate().rev().filter(|(_, link)| link.parent != 0) {
            for k in 0..eights {
                bits[(link.parent - 1) * eights + k][1] |= bits[i * eights + k][1] | link.bits(k);
            }
        }
        let owners: Vec<usize> =
            links.iter().enumerate().flat_map(|(i, link)| iter::repeat_n(i, link.kind.freedoms())).collect();
        let has = |link: usize, side: usize, k: usize| bits[link * eights + k / EIGHT][side] >> (k % EIGHT) & 1 == 1;
        let list = |four: &[usize], is_both: bool| {
            let is_there = |&link: &usize, k: usize| owners[k] == link || has(link, 0, k) || is_both && has(link, 1, k);
            (0..freedoms).filter(|&k| four.iter().any(|link| is_there(link, k))).collect()
        };
        let fours = if freedoms <= DENSE { owners.chunks(FOUR) } else { [].chunks(FOUR) };
        let lists = fours.map(|four| [list(four, false), list(four, true)]).collect();
        Self { bits, lists, eights, is_chain }
    }

    /// The lists of four freedoms from one on.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn lists(&self, first: usize) -> &[Vec<usize>; 2] {
        &self.lists[first / FOUR]
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn of(&self, link: usize) -> &[[u8; 2]] {
        &self.bits[link * self.eights..(link + 1) * self.eights]
    }
}

/// The bits below each.
const BELOW: [u8; EIGHT + 1] = [0, 1, 3, 7, 15, 31, 63, 127, 255];

impl Link {
    /// The bits of its own freedoms among the eight of an index.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn bits(&self, eight: usize) -> u8 {
        let start = eight * EIGHT;
        let end = (self.v + self.kind.freedoms()).saturating_sub(start).min(EIGHT);
        BELOW[end] & !BELOW[self.v.saturating_sub(start).min(EIGHT)]
    }
}
