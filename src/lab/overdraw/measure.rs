//! The measurement: how many times each shader is drawn, in which order, and the readings. It draws through [`Draw`] and uses no
//! device itself.

use core::ops::Range;

use serde::{Deserialize, Serialize};

use super::plan::DrawingPlan;
use crate::physics::num::statistics::{median, quantile};

/// The number of readings by which the count of draws and the clock are chosen.
const TRIALS: usize = 3;
/// The number of readings of the heavy shader alone.
const ALONE: usize = 15;
/// Nanoseconds that the draws of a reading should take: some hundred times the resolution of a clock.
const LONG_ENOUGH: f64 = 4e6;
/// The time of a reading's draws should be this many times the variation of the heavy shader's time.
const ABOVE_NOISE: f64 = 20.0;
/// Nanoseconds that the draws of a reading may take at most to rise above that variation.
const TOO_LONG: f64 = 16e6;
/// The most draws in a reading.
const MOST_DRAWS: u32 = 4096;
/// Functions between two readings of the reference shaders.
const STRIDE: usize = 6;

/// Nanoseconds that a drawing took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    /// By the device's timestamps, where it has them.
    pub gpu: Option<f64>,
    /// By the processor time of the process that draws, where the system reports it. A software device computes there.
    pub cpu: Option<f64>,
    /// By the wall clock, from submission to completion.
    pub wall: f64,
}

/// How a time was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Clock {
    /// The device's timestamps.
    Gpu,
    /// The processor time of the process that draws.
    Cpu,
    /// The wall clock.
    Wall,
}

/// Why there is no reading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// This shader cannot be drawn.
    One(String),
    /// No shader can be drawn.
    All(String),
}

/// Something that draws a plan's drawings.
pub trait Draw {
    /// Draws the heavy shader, and a drawing so many times over it. [`DrawingPlan::HEAVY`] is drawn alone.
    ///
    /// # Errors
    /// It cannot be drawn, or not within its time limit.
    fn draw(&mut self, drawing: usize, draws: u32) -> Result<Reading, Stop>;
}

/// How much is measured, and by which clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawingEffort {
    /// The number of rounds.
    pub rounds: usize,
    /// The clock. If none is given: the processor time for a software device, otherwise the device's timestamps if they advance,
    /// otherwise the wall clock.
    pub clock: Option<Clock>,
    /// Whether the device is software, whose timestamps include the time of other programs.
    pub is_software: bool,
    /// Nanoseconds that a reading may take.
    pub limit: f64,
}

/// The readings of all drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredDrawings {
    /// The clock that is used.
    pub clock: Clock,
    /// Whether the device's timestamps advance.
    pub advances: bool,
    /// How many times each drawing is drawn in a reading.
    pub draws: Vec<u32>,
    /// Why each drawing was given up, if it was.
    pub failed: Vec<Option<String>>,
    /// All readings.
    pub rounds: Vec<Round>,
}

/// The readings of each drawing in a round. There is one each, but one of a reference shader after every few functions. NaN if
/// the drawing was given up.
pub type Round = Vec<Vec<Reading>>;

impl Reading {
    /// The reading of a drawing that was given up.
    const NONE: Reading = Reading {
        gpu: None,
        cpu: None,
        wall: f64::NAN,
    };
}

impl Clock {
    /// All clocks.
    pub const ALL: [Clock; 3] = [Clock::Gpu, Clock::Cpu, Clock::Wall];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Clock::Gpu => "gpu",
            Clock::Cpu => "cpu",
            Clock::Wall => "wall",
        }
    }

    /// The nanoseconds of a reading by this clock.
    pub fn nanoseconds(self, reading: &Reading) -> f64 {
        match self {
            Clock::Gpu => reading.gpu.unwrap_or(f64::NAN),
            Clock::Cpu => reading.cpu.unwrap_or(f64::NAN),
            Clock::Wall => reading.wall,
        }
    }
}

/// A measurement under way.
struct DrawingSession<'a> {
    plan: &'a DrawingPlan,
    artist: &'a mut dyn Draw,
    clock: Clock,
    draws: Vec<u32>,
    failed: Vec<Option<String>>,
}

/// Measures all drawings of a plan.
///
/// # Errors
/// Nothing can be drawn, or the clock that was asked for does not advance.
pub fn measure(
    plan: &DrawingPlan,
    effort: &DrawingEffort,
    artist: &mut dyn Draw,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<MeasuredDrawings, Stop> {
    let count = plan.drawings.len();
    let mut session = DrawingSession {
        plan,
        artist,
        clock: Clock::Wall,
        draws: vec![0; count],
        failed: vec![None; count],
    };
    let whole = (count * (1 + effort.rounds)) as u64;
    let advances = session.choose_clock(effort)?;
    let heavy = session.times(DrawingPlan::HEAVY, 0, ALONE)?;
    for drawing in 1..count {
        progress(drawing as u64, whole, "how often to draw");
        session.calibrate(drawing, &heavy, effort.limit)?;
    }
    let mut rounds = Vec::new();
    for round in 0..effort.rounds {
        let before = (count * (1 + round)) as u64;
        let what = format!("round {} of {}", round + 1, effort.rounds);
        let mut report = |done: usize| progress(before + done as u64, whole, &what);
        rounds.push(session.round(round, &mut report)?);
    }
    Ok(MeasuredDrawings {
        clock: session.clock,
        advances,
        draws: session.draws,
        failed: session.failed,
        rounds,
    })
}

impl DrawingSession<'_> {
    /// A reading, which is NaN where the drawing is given up.
    fn read(&mut self, drawing: usize) -> Result<Reading, Stop> {
        let reading = self.read_draws(drawing, self.draws[drawing])?;
        Ok(reading.unwrap_or(Reading::NONE))
    }

    /// A reading of so many draws. None where the drawing is given up, now or before.
    fn read_draws(&mut self, drawing: usize, draws: u32) -> Result<Option<Reading>, Stop> {
        if self.failed[drawing].is_some() {
            return Ok(None);
        }
        match self.artist.draw(drawing, draws) {
            Ok(reading) => Ok(Some(reading)),
            Err(Stop::One(why)) => {
                self.give_up(drawing, &why);
                Ok(None)
            }
            Err(all) => Err(all),
        }
    }

    /// Gives a drawing up. Without the heavy shader there is nothing to draw over.
    fn give_up(&mut self, drawing: usize, why: &str) {
        let name = &self.plan.drawings[drawing].name;
        self.failed[drawing] = Some(format!("{name}: {why}"));
        if drawing == DrawingPlan::HEAVY {
            let why = format!("the heavy shader below it, {name}: {why}");
            self.failed.fill(Some(why));
        }
    }

    /// Chooses the requested clock, or the best one. Returns whether the device's timestamps advance.
    fn choose_clock(&mut self, effort: &DrawingEffort) -> Result<bool, Stop> {
        let mut advances = Clock::ALL.map(|_| true);
        for _ in 0..TRIALS {
            let Some(reading) = self.read_draws(DrawingPlan::HEAVY, 0)? else {
                break;
            };
            for (advances, clock) in advances.iter_mut().zip(Clock::ALL) {
                *advances &= clock.nanoseconds(&reading) > 0.0;
            }
        }
        let [gpu, cpu, _] = advances;
        self.clock = match effort.clock {
            Some(Clock::Gpu) if !gpu => {
                let why =
                    "the device's timestamps do not advance, or it has none; take --clock wall";
                return Err(Stop::All(why.to_owned()));
            }
            Some(Clock::Cpu) if !cpu => {
                let why = "this system does not tell the processor's time; take --clock wall";
                return Err(Stop::All(why.to_owned()));
            }
            Some(clock) => clock,
            None if effort.is_software && cpu => Clock::Cpu,
            None if gpu => Clock::Gpu,
            None => Clock::Wall,
        };
        Ok(gpu)
    }

    /// The times of several readings of so many draws. None where the drawing is given up.
    fn times(&mut self, drawing: usize, draws: u32, readings: usize) -> Result<Vec<f64>, Stop> {
        let mut times = Vec::new();
        for _ in 0..readings {
            let reading = self.read_draws(drawing, draws)?;
            times.extend(reading.map(|reading| self.clock.nanoseconds(&reading)));
        }
        Ok(times)
    }

    /// Finds how many times a shader is drawn, so that the draws take long enough and well above the variation of the heavy
    /// shader alone. The first reading warms the shader up.
    fn calibrate(&mut self, drawing: usize, heavy: &[f64], limit: f64) -> Result<(), Stop> {
        let alone = median(heavy);
        let scatter = quantile(heavy, 0.75) - quantile(heavy, 0.25);
        let wanted = (ABOVE_NOISE * scatter).clamp(LONG_ENOUGH, TOO_LONG);
        let wanted = wanted.min(limit / 4.0);
        let mut draws = 1;
        loop {
            let times = self.times(drawing, draws, TRIALS)?;
            let time = median(&times) - alone;
            if times.is_empty() || draws >= MOST_DRAWS || time >= wanted / 4.0 {
                let each = (time / f64::from(draws)).max(1.0);
                self.draws[drawing] = ((wanted / each) as u32).clamp(1, MOST_DRAWS);
                return Ok(());
            }
            draws *= 2;
        }
    }

    /// A round: every drawing once. Reference shaders are drawn again after every few functions, so that a machine that is busy
    /// for a while slows both.
    fn round(&mut self, round: usize, report: &mut dyn FnMut(usize)) -> Result<Round, Stop> {
        let (count, fixed) = (self.plan.drawings.len(), self.plan.fixed.clone());
        let mut all: Round = vec![Vec::new(); count];
        // Each function has two drawings, one after the other.
        let functions = (count - fixed.end) / 2;
        for (done, place) in order(functions, round).enumerate() {
            if done % STRIDE == 0 {
                self.read_into(&mut all, fixed.clone())?;
            }
            let short = fixed.end + 2 * place;
            self.read_into(&mut all, short..short + 2)?;
            report(2 * done);
        }
        if functions == 0 {
            self.read_into(&mut all, fixed)?;
        }
        Ok(all)
    }

    fn read_into(&mut self, all: &mut Round, drawings: Range<usize>) -> Result<(), Stop> {
        for drawing in drawings {
            all[drawing].push(self.read(drawing)?);
        }
        Ok(())
    }
}

/// All functions once, each turn in another order. The stride and the count are coprime, so that none is left out, and neighbours
/// change from turn to turn.
fn order(count: usize, turn: usize) -> impl Iterator<Item = usize> {
    let is_prime_to = |step: &usize| {
        let (mut a, mut b) = (*step, count);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let steps: Vec<usize> = (1..count.max(2)).filter(is_prime_to).collect();
    let step = steps[(7 * turn) % steps.len()];
    (0..count).map(move |i| (i * step + 11 * turn) % count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_has_all_and_neighbours_change() {
        for count in [0, 1, 2, 9, 30, 117] {
            for turn in 0..20 {
                let mut all: Vec<usize> = order(count, turn).collect();
                all.sort_unstable();
                assert_eq!(all, (0..count).collect::<Vec<_>>(), "{count} {turn}");
            }
        }
        let first: Vec<usize> = order(30, 0).collect();
        let second: Vec<usize> = order(30, 1).collect();
        assert_ne!(first, second);
    }
}
