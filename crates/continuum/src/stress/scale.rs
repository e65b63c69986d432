//! Scaling by powers of two: see [`tensor::scale`](crate::tensor::scale).

pub(super) use crate::tensor::scale::{largest, norm, power_of_two_scale, square_root};
