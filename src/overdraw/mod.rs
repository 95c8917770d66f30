//! What a function costs by overdraw: a heavy full-screen shader is drawn alone, then with the measured shader over it N
//! times; the difference over N is a draw's cost. The heavy one keeps the device at work, so that what a frame costs anyway
//! is in both.
//!
//! The measured shader is blended, so that no draw can be left out. A draw's own price, blending above all, would hide a
//! cheap function on any large device; so each draw evaluates the function several times, each from the result
//! before ([`Probe`](crate::cost::Probe)), and the shader that evaluates nothing, the empty one, is taken off:
//!
//! `net = ((T(heavy + N draws) - T(heavy)) / N - the same of the empty shader) / evaluations`.
//!
//! All shaders are drawn in turn in every round, in an order that changes, and beside each few of them what they are held
//! against, so that a machine that is busy for a while is busy for both. Interference only lengthens a reading, so a
//! shader's time is the 10th percentile of its readings over all rounds. How sure a share of `dielectric_exact` is, rounds drawn anew from the rounds
//! tell (the bootstrap): it is the median of what they give, between the limits within which 95 % of them lie.
//!
//! A software device shares the processor with everything else that runs. There the processor's own count of what it
//! worked for the process is taken, in which other programs are not: with four of them on two cores shares by timestamps
//! are off by half.

#[cfg(feature = "gpu")]
mod clock;
#[cfg(feature = "gpu")]
mod drawing_device;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod drawing_worker;
mod error;
mod figure;
mod functions;
mod measure;
mod plan;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod protocol;
#[cfg(feature = "gpu")]
mod row;
#[cfg(all(feature = "cli", feature = "gpu"))]
mod serve;
mod times;

#[cfg(feature = "gpu")]
pub use drawing_device::{DeviceFacts, DrawingDevice};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use drawing_worker::DrawingWorker;
pub use error::Error;
pub use figure::{Noise, OverdrawFigure};
pub use functions::{LibraryMaterials, TimedFunctions};
pub use measure::{Clock, Draw, DrawingEffort, MeasuredDrawings, Reading, Round, Stop, measure};
pub use plan::{Drawing, DrawingPlan, TimedFunction};
#[cfg(feature = "gpu")]
pub use row::{TimeRow, time_rows};
#[cfg(all(feature = "cli", feature = "gpu"))]
pub use serve::serve;
pub use times::{Time, times};
