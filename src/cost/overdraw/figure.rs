//! From readings to figures.

use crate::cost::statistics::{interval, median, quantile, spread};

use super::measure::{Clock, Measured, Seen};
use super::plan::Plan;

/// What a function costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Nanoseconds a pixel of a draw that evaluates it once: the empty draw, and one evaluation.
    pub ns_per_pixel: f64,
    /// Nanoseconds a pixel of one evaluation.
    pub net_ns_per_pixel: f64,
    /// Nanoseconds a pixel of the empty draw that belongs to it.
    pub empty_ns_per_pixel: f64,
    /// As `ns_per_pixel`, by the device's timestamps; NaN where it has none.
    pub gpu_ns_per_pixel: f64,
    /// As `ns_per_pixel`, by the wall clock.
    pub wall_ns_per_pixel: f64,
    /// Its net cost over that of `dielectric_exact`: the median over rounds.
    pub share: f64,
    /// How far the middle half of the rounds' shares reaches, over the median.
    pub spread: f64,
    /// 95 % confidence interval of the median share, where there are rounds enough.
    pub interval: Option<(f64, f64)>,
    /// Draws in a reading.
    pub draws: u32,
}

/// How much a machine disturbs: what the same shader takes each time.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Half of all readings lie within this share of the median.
    pub spread: f64,
    /// The slowest of twenty, over the median.
    pub slowest: f64,
    /// How many readings that is.
    pub readings: usize,
}

impl Noise {
    /// The noise of these readings.
    pub fn of(readings: &[f64]) -> Noise {
        Noise {
            spread: spread(readings),
            slowest: quantile(readings, 0.95) / median(readings),
            readings: readings.len(),
        }
    }
}

/// Nanoseconds a pixel in one round: one evaluation, one of `dielectric_exact`, and the empty draw.
struct Costs {
    net: f64,
    reference: f64,
    empty: f64,
}

impl Measured {
    /// What the plan's function of this number costs on a target of so many pixels.
    ///
    /// # Errors
    /// It was given up, or what it is held against was; in words.
    pub fn figure(&self, plan: &Plan, function: usize, pixels: u64) -> Result<Figure, String> {
        let (own, empty) = plan.places()[function];
        for needed in [Plan::HEAVY, own, empty, Plan::REFERENCE, Plan::EMPTY] {
            if let Some(why) = &self.failed[needed] {
                return Err(why.clone());
            }
        }
        let of = |clock| self.costs(plan, clock, (own, empty), pixels);
        let costs = of(self.clock);
        let [gpu, wall] = [Clock::Gpu, Clock::Wall].map(of);
        let shares: Vec<f64> = costs.iter().map(|c| c.net / c.reference).collect();
        let over = |costs: &[Costs], one: fn(&Costs) -> f64| {
            median(&costs.iter().map(one).collect::<Vec<f64>>())
        };
        let (net, empty) = (over(&costs, |c| c.net), over(&costs, |c| c.empty));
        let share = median(&shares);
        if !share.is_finite() || over(&costs, |c| c.reference) <= 0.0 {
            let why = "dielectric_exact is not told apart from the empty shader: noise; take more --rounds or a larger --size";
            return Err(why.to_owned());
        }
        Ok(Figure {
            ns_per_pixel: empty + net,
            net_ns_per_pixel: net,
            empty_ns_per_pixel: empty,
            gpu_ns_per_pixel: over(&gpu, |c| c.net + c.empty),
            wall_ns_per_pixel: over(&wall, |c| c.net + c.empty),
            share,
            spread: spread(&shares),
            interval: interval(&shares),
            draws: self.draws[own],
        })
    }

    /// The noise of the heavy shader alone, and of the empty one over it.
    pub fn noise(&self) -> [Noise; 2] {
        [&self.noise[0], &self.noise[1]].map(|readings| Noise::of(readings))
    }

    fn costs(
        &self,
        plan: &Plan,
        clock: Clock,
        (own, empty): (usize, usize),
        pixels: u64,
    ) -> Vec<Costs> {
        let round = |round: &Vec<Seen>| {
            let seen = &round[own];
            let heavy = clock.of(&seen.fixed[Plan::HEAVY]);
            let draw = |drawing: usize, reading| {
                let draws = f64::from(self.draws[drawing]) * pixels as f64;
                (clock.of(reading) - heavy) / draws
            };
            let fixed = |drawing: usize| draw(drawing, &seen.fixed[drawing]);
            let net = |draw: f64, empty: f64| (draw - empty) / plan.evaluations as f64;
            let empty = fixed(empty);
            Costs {
                net: net(draw(own, &seen.own), empty),
                reference: net(fixed(Plan::REFERENCE), fixed(Plan::EMPTY)),
                empty,
            }
        };
        self.rounds.iter().map(round).collect()
    }
}
