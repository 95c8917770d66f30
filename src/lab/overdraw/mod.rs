//! The cost of a function, measured by overdraw. A heavy full-screen shader is drawn alone, then with the measured shader over it N
//! times. The difference divided by N is the cost of a draw. The heavy shader keeps the device busy, so that both times contain the
//! fixed cost of a frame.
//!
//! The measured shader is blended, so that the device cannot skip a draw. A graphics card rasterises and blends while it
//! computes, and a draw takes as long as the slower of both. A few evaluations of a cheap function take no time at all there. So
//! a cost is a slope. Each draw evaluates the function many times, each from the result before
//! ([`Probe`](crate::lab::cost::Probe)), in a chain that takes longer than the rest of the draw, and in one twice as long. The
//! slope of the empty shader, which evaluates nothing, is subtracted:
//!
//! `draw = (T(heavy + N draws) - T(heavy)) / N`,
//! `net = (draw(2 n evaluations) - draw(n evaluations)) / n - the same of the empty shader`.
//!
//! Every round draws all shaders once, in an order that changes. The reference shaders are drawn again after every few functions,
//! so that other load on the machine affects both. Interference only lengthens a reading, so a shader's time is the
//! 10th percentile of its readings over all rounds. The share of `dielectric_exact` is a bootstrap estimate: rounds are drawn
//! with replacement, the share is the median of the results, and the limits contain 95 % of them.
//!
//! A software device shares the processor with all other programs. There the clock is the processor time of the process,
//! which does not include other programs: with four busy programs on two cores, shares by timestamps are wrong by half.

mod clock;
mod drawing_device;
mod drawing_worker;
mod figure;
mod functions;
mod measure;
mod plan;
mod record;
mod row;
pub use drawing_device::DeviceFacts;
pub use drawing_worker::{DrawingWorker, Error, serve};
pub use figure::Noise;
pub use functions::{TimeRequest, TimedFunctions};
pub use measure::{Clock, Draw, DrawingEffort, MeasuredDrawings, Reading, Stop, measure};
pub use plan::{DrawingPlan, DrawnChain, usual_operations};
pub use record::{LibraryTime, library_times};
pub use row::{TimeRow, time_rows};
