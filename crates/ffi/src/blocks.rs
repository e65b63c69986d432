//! Copies between points, whose numbers stand one after the other, and blocks, in which each number stands for eight points.

use piola::numerics::{LaneKernel, Lanes, dispatch_lanes};

use crate::stages::{Number, WIDTH};

/// Points that VUMAT takes together.
pub(crate) const BLOCK: usize = 64;

/// F of points to blocks; places of the last block that hold no point get F = 1.
pub(crate) fn to_blocks(points: &[[f64; 9]], blocks: &mut [[Number; 9]]) {
    if let Some(last) = blocks.last_mut() {
        for (k, number) in last.iter_mut().enumerate() {
            *number = [if k % 4 == 0 { 1.0 } else { 0.0 }; WIDTH];
        }
    }
    dispatch_lanes::<_, 2, 4, 8>(Gather { points, blocks });
}

struct Gather<'a> {
    points: &'a [[f64; 9]],
    blocks: &'a mut [[Number; 9]],
}

impl LaneKernel for Gather<'_> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let parts = WIDTH / N;
        let (groups, rest) = self.points.as_chunks::<N>();
        for (part, group) in groups.iter().enumerate() {
            let block = &mut self.blocks[part / parts];
            let mut lanes = [Lanes([0.0; N]); 9];
            Lanes::gather::<9, 1>(group.each_ref(), &mut lanes);
            let mut k = 0;
            while k < 9 {
                block[k].as_chunks_mut().0[part % parts] = lanes[k].0;
                k += 1;
            }
        }
        let first = self.points.len() - rest.len();
        for (point, numbers) in rest.iter().enumerate() {
            let index = first + point;
            for (number, of_block) in numbers.iter().zip(&mut self.blocks[index / WIDTH]) {
                of_block[index % WIDTH] = *number;
            }
        }
    }
}

/// K numbers of each point from blocks of `stride` numbers: number k of a point is number `places[k]` of its block.
pub(crate) fn to_points<const K: usize>(
    blocks: &[Number],
    stride: usize,
    places: &[usize; K],
    points: &mut [[f64; K]],
) {
    dispatch_lanes::<_, 2, 4, 8>(Scatter { blocks, stride, places, points });
}

struct Scatter<'a, const K: usize> {
    blocks: &'a [Number],
    stride: usize,
    places: &'a [usize; K],
    points: &'a mut [[f64; K]],
}

impl<const K: usize> LaneKernel for Scatter<'_, K> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<const N: usize>(self) {
        let parts = WIDTH / N;
        let count = self.points.len();
        let (groups, rest) = self.points.as_chunks_mut::<N>();
        for (part, group) in groups.iter_mut().enumerate() {
            let block = &self.blocks[part / parts * self.stride..][..self.stride];
            let mut lanes = [Lanes([0.0; N]); K];
            for (lanes, place) in lanes.iter_mut().zip(self.places) {
                *lanes = Lanes(block[*place].as_chunks().0[part % parts]);
            }
            Lanes::scatter::<K, 1>(&lanes, group.each_mut());
        }
        let first = count - rest.len();
        for (point, numbers) in rest.iter_mut().enumerate() {
            let index = first + point;
            let block = &self.blocks[index / WIDTH * self.stride..][..self.stride];
            for (number, place) in numbers.iter_mut().zip(self.places) {
                *number = block[*place][index % WIDTH];
            }
        }
    }
}
