//! Computes the figures of functions from readings: costs, shares with confidence intervals, and noise.

use serde::Serialize;

use super::measure::{Clock, MeasuredDrawings};
use super::plan::{DrawingPlan, DrawnChain};
use crate::physics::num::statistics::{interval, median, quantile, resamples, spread};

/// The quantile of readings that is taken. Interference only lengthens a reading, but the very shortest one is a matter of luck.
const QUICK: f64 = 0.1;
/// A chain must take at least this many times as long as an empty draw, since a device may do both at once.
const CLEAR: f64 = 1.2;
/// The fewest rounds that are resampled. With 29 rounds the chance that one of them is among the quickest tenth is 95 %, 1 -
/// 0.9^29.
const FEWEST: usize = 29;

/// The cost of a function by overdraw.
#[derive(Clone, Debug, PartialEq)]
pub struct OverdrawFigure {
    /// Nanoseconds per pixel of a draw that evaluates it once: the empty draw plus one evaluation.
    pub ns_per_pixel: f64,
    /// Nanoseconds per pixel of one evaluation, net of the chain.
    pub net_ns_per_pixel: f64,
    /// Nanoseconds per pixel of a draw that evaluates nothing.
    pub empty_ns_per_pixel: f64,
    /// As `ns_per_pixel`, by the device's timestamps. NaN where it has none.
    pub gpu_ns_per_pixel: f64,
    /// As `ns_per_pixel`, by the wall clock.
    pub wall_ns_per_pixel: f64,
    /// Its net cost divided by that of `dielectric_exact`: the median over resampled rounds.
    pub share: f64,
    /// The interquartile range of single rounds' shares, divided by their median. NaN for a single round.
    pub spread: f64,
    /// 95 % confidence interval of the share, where there are enough rounds.
    pub interval: Option<(f64, f64)>,
    /// Draws of its long chain in a reading.
    pub draws: u32,
    /// Evaluations in that chain.
    pub evaluations: usize,
}

/// How much the time of one shader varies between readings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// The interquartile range of the readings, divided by their median.
    pub spread: f64,
    /// The 95th percentile of the readings, divided by their median.
    pub slowest: f64,
    /// The number of readings.
    pub readings: usize,
}

impl Noise {
    /// The noise of these readings.
    pub fn from_readings(readings: &[f64]) -> Noise {
        Noise {
            spread: spread(readings),
            slowest: quantile(readings, 0.95) / median(readings),
            readings: readings.len(),
        }
    }
}

/// Nanoseconds per pixel in some rounds: one evaluation, one of `dielectric_exact`, and the empty draw.
#[derive(Clone, Copy)]
struct Costs {
    net: f64,
    reference: f64,
    empty: f64,
    /// The time of the shorter of its chains, divided by that of the empty draw.
    room: f64,
}

impl Costs {
    fn share(&self) -> f64 {
        self.net / self.reference
    }
}

/// The time of each drawing: in all rounds by two clocks, in single rounds, and in resampled rounds.
struct Times {
    gpu: Vec<f64>,
    wall: Vec<f64>,
    singly: Vec<Vec<f64>>,
    anew: Vec<Vec<f64>>,
}

impl MeasuredDrawings {
    /// The cost of each of the plan's functions on a target of so many pixels, or why it is not known: the function, or a shader
    /// that it is compared with, was given up.
    pub fn figures(&self, plan: &DrawingPlan, pixels: u64) -> Vec<Result<OverdrawFigure, String>> {
        let rounds: Vec<usize> = (0..self.rounds.len()).collect();
        let anew = if rounds.len() < FEWEST {
            vec![rounds.clone()]
        } else {
            resamples(rounds.len()).collect()
        };
        let times = Times {
            gpu: self.times(Clock::Gpu, &rounds),
            wall: self.times(Clock::Wall, &rounds),
            singly: rounds
                .iter()
                .map(|r| self.times(self.clock, &[*r]))
                .collect(),
            anew: anew.iter().map(|r| self.times(self.clock, r)).collect(),
        };
        let functions = 0..plan.chains.len();
        functions
            .map(|function| self.figure(plan, function, pixels, &times))
            .collect()
    }

    fn figure(
        &self,
        plan: &DrawingPlan,
        function: usize,
        pixels: u64,
        times: &Times,
    ) -> Result<OverdrawFigure, String> {
        let held = plan.held(function);
        let [own, ..] = held;
        let chains = held.map(|chain| [chain.short, chain.long()]);
        let fixed = [DrawingPlan::HEAVY, DrawingPlan::BARE];
        for needed in fixed.iter().chain(chains.iter().flatten()) {
            if let Some(why) = &self.failed[*needed] {
                return Err(why.clone());
            }
        }
        let costs = |times: &Vec<f64>| self.costs(times, held, pixels);
        let [gpu, wall] = [&times.gpu, &times.wall].map(costs);
        let anew: Vec<Costs> = times.anew.iter().map(costs).collect();
        let middle = |one: fn(&Costs) -> f64| median(&anew.iter().map(one).collect::<Vec<f64>>());
        let shares = |all: &[Vec<f64>]| -> Vec<f64> {
            all.iter().map(|times| costs(times).share()).collect()
        };
        let (net, empty, share) = (middle(|c| c.net), middle(|c| c.empty), middle(Costs::share));
        if middle(|c| c.room) < CLEAR {
            let why = "the cost of the draw itself hides the function's: take more --operations";
            return Err(why.to_owned());
        }
        if !share.is_finite() || middle(|c| c.reference) <= 0.0 {
            let why = "dielectric_exact is not told apart from the empty shader: noise; take more --rounds or a larger --size";
            return Err(why.to_owned());
        }
        Ok(OverdrawFigure {
            ns_per_pixel: empty + net,
            net_ns_per_pixel: net,
            empty_ns_per_pixel: empty,
            gpu_ns_per_pixel: gpu.net + gpu.empty,
            wall_ns_per_pixel: wall.net + wall.empty,
            share,
            spread: if self.rounds.len() > 1 {
                spread(&shares(&times.singly))
            } else {
                f64::NAN
            },
            interval: (self.rounds.len() >= FEWEST).then(|| interval(&shares(&times.anew))),
            draws: self.draws[own.long()],
            evaluations: 2 * own.evaluations,
        })
    }

    /// The noise of the heavy shader alone, and of the empty shader over it.
    pub fn noise(&self) -> [Noise; 2] {
        let rounds: Vec<usize> = (0..self.rounds.len()).collect();
        [DrawingPlan::HEAVY, DrawingPlan::BARE].map(|drawing| {
            let readings = self.readings(self.clock, drawing, &rounds);
            Noise::from_readings(&readings)
        })
    }

    /// The readings of a drawing in these rounds.
    fn readings(&self, clock: Clock, drawing: usize, rounds: &[usize]) -> Vec<f64> {
        let readings = rounds
            .iter()
            .flat_map(|round| &self.rounds[*round][drawing]);
        readings.map(|reading| clock.nanoseconds(reading)).collect()
    }

    /// The time of each drawing in these rounds.
    fn times(&self, clock: Clock, rounds: &[usize]) -> Vec<f64> {
        let time = |drawing| quantile(&self.readings(clock, drawing, rounds), QUICK);
        (0..self.draws.len()).map(time).collect()
    }

    fn costs(&self, times: &[f64], held: [DrawnChain; 4], pixels: u64) -> Costs {
        let draw = |drawing: usize| {
            let draws = f64::from(self.draws[drawing]) * pixels as f64;
            (times[drawing] - times[DrawingPlan::HEAVY]) / draws
        };
        let each =
            |chain: DrawnChain| (draw(chain.long()) - draw(chain.short)) / chain.evaluations as f64;
        let [own, empty, reference, reference_empty] = held;
        let shortest = held
            .map(|chain| draw(chain.short))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        Costs {
            net: each(own) - each(empty),
            reference: each(reference) - each(reference_empty),
            empty: draw(DrawingPlan::BARE),
            room: shortest / draw(DrawingPlan::BARE),
        }
    }
}
