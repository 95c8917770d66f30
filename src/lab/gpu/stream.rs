//! A program run over all numbers of a range, none of which is uploaded.
//!
//! The program makes its own point, `bitcast<f32>(first + index)`, from the uniform `first` in binding 1. Two blocks are
//! in flight: the device computes one while the other is read where it lies.

use super::adapter::DeviceFault;
use super::kernel::Kernel;
use super::program::Uniform;
use super::slot::{BLOCK, Block, Texture};

/// A compute program ready to run over consecutive bit patterns.
pub struct Stream(pub(super) Kernel);

impl Stream {
    /// Runs over `count` numbers from that with the bits `first` on. Block by block and in order, `take` gets the bits of
    /// the block's first number and the results, in the device's own memory: they last as long as the call.
    /// After 2³² numbers the bits begin anew.
    ///
    /// # Errors
    /// Arguments or texture do not fit the program or the device, or the device is lost.
    pub fn run(
        &self,
        first: u32,
        count: u64,
        uniforms: &[Uniform],
        texture: Option<&Texture>,
        mut take: impl FnMut(u32, &[[f32; 4]]),
    ) -> Result<(), DeviceFault> {
        let at = |done: u64| first.wrapping_add(done as u32);
        let blocks = (0..count).step_by(BLOCK).map(|done| Block::Bits {
            first: at(done),
            count: (count - done).min(BLOCK as u64) as usize,
        });
        let mut next = first;
        self.0.pump(blocks, uniforms, texture, |results| {
            take(next, results);
            next = next.wrapping_add(results.len() as u32);
        })
    }
}
