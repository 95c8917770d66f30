//! Timing by overdraw, apart from any device: what is drawn is valid, and what is read becomes the figures that it should.

use fresnel_gen::app::Materials;
use fresnel_gen::app::time_request::TimeRequest;
use fresnel_gen::emit::validate_wgsl;
use fresnel_gen::methods::{ALL, find};
use fresnel_gen::num::Precision;
use fresnel_gen::overdraw::{
    Clock, Draw, DrawingEffort, DrawingPlan, MeasuredDrawings, Reading, Stop, TimedFunctions,
    measure,
};

/// Pixels of the target that is made up here.
const PIXELS: u64 = 1000;

fn timed_functions(methods: &[&str]) -> TimedFunctions {
    let named = methods.iter().filter_map(|name| find(name));
    let request = TimeRequest {
        methods: match methods {
            [] => ALL.to_vec(),
            _ => named.collect(),
        },
        materials: Materials::Default,
        precisions: Precision::ALL.to_vec(),
        evaluations: 4,
    };
    request.timed_functions().unwrap()
}

/// A device whose every draw takes what it should, but for a machine that is at times busy with something else.
struct MadeUp {
    /// Nanoseconds of a draw.
    costs: Vec<f64>,
    has_clock: bool,
    /// A drawing that never ends.
    hangs: Option<usize>,
    calls: u64,
}

impl MadeUp {
    /// An evaluation takes a hundred nanoseconds times the drawing's number, an empty draw a thousand.
    fn new(plan: &DrawingPlan) -> MadeUp {
        let cost = |i: usize| match i {
            DrawingPlan::HEAVY => 1e6,
            i if plan.drawings[i].name == "the empty shader" => 1e3,
            i => 1e3 + 100.0 * i as f64 * plan.evaluations as f64,
        };
        MadeUp {
            costs: (0..plan.drawings.len()).map(cost).collect(),
            has_clock: true,
            hangs: None,
            calls: 0,
        }
    }
}

impl Draw for MadeUp {
    fn draw(&mut self, drawing: usize, draws: u32) -> Result<Reading, Stop> {
        if self.hangs == Some(drawing) {
            return Err(Stop::One("it never ends".to_owned()));
        }
        self.calls += 1;
        let over = if drawing == DrawingPlan::HEAVY {
            0.0
        } else {
            self.costs[drawing]
        };
        let time = self.costs[DrawingPlan::HEAVY] + over * f64::from(draws);
        // One reading in seven is anything.
        let busy = if self.calls.is_multiple_of(7) {
            3.0
        } else {
            1.0
        };
        Ok(Reading {
            gpu: self.has_clock.then_some(time * busy),
            cpu: Some(1.5 * time * busy),
            wall: (time + 5e4) * busy,
        })
    }
}

fn effort(clock: Option<Clock>) -> DrawingEffort {
    DrawingEffort {
        rounds: 29,
        clock,
        is_software: false,
        limit: 1e10,
    }
}

fn measured(
    plan: &DrawingPlan,
    device: &mut MadeUp,
    clock: Option<Clock>,
) -> Result<MeasuredDrawings, Stop> {
    measure(plan, &effort(clock), device, &mut |_, _, _| {})
}

#[test]
fn everything_that_is_drawn_is_valid() {
    let timed = timed_functions(&[]);
    for drawing in &timed.plan.drawings {
        validate_wgsl(&drawing.text)
            .unwrap_or_else(|fault| panic!("{}: {fault}\n{}", drawing.name, drawing.text));
        let blocks = drawing.text.contains("var<uniform>");
        assert_eq!(blocks, !drawing.uniforms.is_empty(), "{}", drawing.name);
        assert_eq!(
            drawing.text.contains("texture_2d"),
            drawing.table.is_some(),
            "{}",
            drawing.name
        );
    }
    assert_eq!(timed.plan.places().len(), timed.functions.len());
}

#[test]
fn shares_are_found_again_through_noise() {
    let timed = timed_functions(&["schlick", "dielectric_exact", "table"]);
    let plan = &timed.plan;
    for clock in Clock::ALL {
        let measured = measured(plan, &mut MadeUp::new(plan), Some(clock)).unwrap();
        assert_eq!(measured.clock, clock);
        let figures = measured.figures(plan, PIXELS);
        for ((own, _), figure) in plan.places().iter().zip(figures) {
            let figure = figure.unwrap();
            let share = *own as f64 / DrawingPlan::REFERENCE as f64;
            assert!(
                (figure.share / share - 1.0).abs() < 1e-9,
                "{own}: {figure:?}"
            );
            let longer = if clock == Clock::Cpu { 1.5 } else { 1.0 };
            let net = 0.1 * longer * *own as f64;
            assert!(
                (figure.net_ns_per_pixel - net).abs() < 1e-9,
                "{own}: {figure:?}"
            );
            assert!(
                (figure.empty_ns_per_pixel - longer).abs() < 1e-9,
                "{own}: {figure:?}"
            );
            let (low, high) = figure.interval.unwrap();
            assert!(low <= figure.share && figure.share <= high, "{figure:?}");
        }
    }
}

#[test]
fn a_clock_that_stands_still_is_not_taken() {
    let timed = timed_functions(&["schlick"]);
    let mut device = MadeUp::new(&timed.plan);
    device.has_clock = false;
    let found = measured(&timed.plan, &mut device, None).unwrap();
    assert!(found.clock == Clock::Wall && !found.advances);
    assert!(found.figures(&timed.plan, PIXELS)[0].is_ok());
    let refused = measured(&timed.plan, &mut device, Some(Clock::Gpu));
    assert!(matches!(refused, Err(Stop::All(why)) if why.contains("do not advance")));
}

#[test]
fn a_shader_that_hangs_takes_only_what_needs_it_along() {
    let timed = timed_functions(&["schlick", "schlick_ior"]);
    let plan = &timed.plan;
    let failing = |hangs: usize| {
        let mut device = MadeUp::new(plan);
        device.hangs = Some(hangs);
        let measured = measured(plan, &mut device, None).unwrap();
        let figures = measured.figures(plan, PIXELS).into_iter();
        let failed: Vec<String> = figures.filter_map(Result::err).collect();
        assert!(failed.iter().all(|why| why.contains("it never ends")));
        failed.len()
    };
    assert_eq!(failing(plan.places()[0].0), 1);
    assert_eq!(failing(DrawingPlan::REFERENCE), plan.places().len());
    assert_eq!(failing(DrawingPlan::HEAVY), plan.places().len());
}
