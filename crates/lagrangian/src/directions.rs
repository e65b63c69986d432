//! Choosing, at run time, how many directions of differentiation are compiled in.

/// Runs `$body` with the constant `$N` set to the smallest compiled number of directions that is at least
/// `$n`, or `$beyond` when `$n` is larger than all of them.
macro_rules! with_directions {
    ($n:expr, $N:ident => $body:expr, beyond => $beyond:expr) => {
        match $n {
            0..=2 => {
                const $N: usize = 2;
                $body
            }
            3 => {
                const $N: usize = 3;
                $body
            }
            4 => {
                const $N: usize = 4;
                $body
            }
            5..=8 => {
                const $N: usize = 8;
                $body
            }
            _ => $beyond,
        }
    };
}
pub(super) use with_directions;

/// The same with a number of directions for each small number of coordinates, one too, so that nothing is left
/// of the loops over them: for what is called most.
macro_rules! with_exact_directions {
    ($n:expr, $N:ident => $body:expr, beyond => $beyond:expr) => {
        match $n {
            1 => {
                const $N: usize = 1;
                $body
            }
            2 => {
                const $N: usize = 2;
                $body
            }
            3 => {
                const $N: usize = 3;
                $body
            }
            4 => {
                const $N: usize = 4;
                $body
            }
            0 | 5..=8 => {
                const $N: usize = 8;
                $body
            }
            _ => $beyond,
        }
    };
}
pub(super) use with_exact_directions;

/// Directions of one pass when the system has more coordinates than the largest compiled number.
pub(super) const CHUNK: usize = 8;
/// The largest number of coordinates that one pass serves.
pub(super) const LARGEST: usize = 8;
/// Directions of each of two nested sets: few, because every operation then costs the square of them, in time
/// and in compiled code.
pub(super) const HESSIAN_CHUNK: usize = 2;
