//! A draw by a generator of its own, so that a seed means the same everywhere.

/// `items` in the order in which the seed draws them.
pub(crate) fn shuffle<T>(mut items: Vec<T>, seed: u64) -> Vec<T> {
    let mut state = seed;
    for last in (1..items.len()).rev() {
        let at = usize::try_from(split_mix(&mut state) % (last as u64 + 1)).unwrap_or(0);
        items.swap(at, last);
    }
    items.reverse();
    items
}

/// The next number of `SplitMix64`.
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Fowler, Noll and Vo's hash of 64 bits: whether the sources are those of an earlier run.
pub(crate) fn hash(state: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(state, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Where the hash begins.
pub(crate) const HASH_OF_NOTHING: u64 = 0xcbf2_9ce4_8422_2325;

#[cfg(test)]
mod tests {
    use super::{HASH_OF_NOTHING, hash, shuffle, split_mix};

    #[test]
    fn a_seed_means_one_order_of_all_items() {
        let drawn = shuffle((0..100).collect(), 7);
        assert_eq!(drawn, shuffle((0..100).collect(), 7));
        assert_ne!(drawn, shuffle((0..100).collect(), 8));
        let mut sorted = drawn;
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..100));
    }

    #[test]
    fn the_generators_are_the_published_ones() {
        // Vigna's splitmix64.c from the state 1234567; the FNV-1a of "a".
        assert_eq!(split_mix(&mut 1_234_567), 6_457_827_717_110_365_317);
        assert_eq!(hash(HASH_OF_NOTHING, b"a"), 0xaf63_dc4c_8601_ec8c);
    }
}
