//! Timing by overdraw, apart from any device: what is drawn is valid, and what is read becomes the figures that it should.

use fresnel_gen::generator::emit::validate_wgsl;
use fresnel_gen::generator::request::Materials;
use fresnel_gen::lab::overdraw::{
    Clock, Draw, DrawingEffort, DrawingPlan, DrawnChain, MeasuredDrawings, Reading, Stop,
    TimeRequest, TimedFunctions, measure,
};
use fresnel_gen::language::methods::{ALL, find};
use fresnel_gen::physics::num::Precision;

/// Pixels of the target that is made up here.
const PIXELS: u64 = 1000;

/// Nanoseconds of the draw itself, which a card does while it computes, and of what leads from one evaluation to the next.
const DRAW: f64 = 1e3;
const LINK: f64 = 10.0;

fn planned(methods: &[&str]) -> DrawingPlan {
    timed_functions(methods).plan(2000)
}

fn timed_functions(methods: &[&str]) -> TimedFunctions {
    let named = methods.iter().filter_map(|name| find(name));
    let request = TimeRequest {
        methods: match methods {
            [] => ALL.to_vec(),
            _ => named.collect(),
        },
        materials: Materials::Default,
        precisions: Precision::ALL.to_vec(),
    };
    request.timed_functions().unwrap()
}

#[test]
fn uniforms_are_no_longer_than_opengl_takes() {
    let timed = timed_functions(&[]);
    for operations in [100, 2000, 20_000] {
        for drawing in timed.plan(operations).drawings {
            let bytes = drawing.uniforms.len();
            assert!(bytes <= 16_384, "{}, {operations}: {bytes}", drawing.name);
        }
    }
}

/// Nanoseconds of an evaluation that are made up: more for a function that comes later.
fn cost(chain: DrawnChain) -> f64 {
    100.0 * chain.short as f64
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
    /// A draw takes as long as its evaluations, but no less than a draw without any.
    fn new(plan: &DrawingPlan) -> MadeUp {
        let mut costs = vec![DRAW; plan.drawings.len()];
        costs[DrawingPlan::HEAVY] = 1e6;
        for [own, empty] in &plan.chains {
            let chains = [(own, cost(*own)), (empty, 0.0)];
            for (chain, evaluation) in chains
                .into_iter()
                .chain([(&plan.reference, cost(plan.reference)), (&plan.empty, 0.0)])
            {
                for (place, times) in [(chain.short, 1.0), (chain.long(), 2.0)] {
                    let computed = times * chain.evaluations as f64 * (LINK + evaluation);
                    costs[place] = computed.max(DRAW);
                }
            }
        }
        MadeUp {
            costs,
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
    let plan = timed.plan(2000);
    for drawing in &plan.drawings {
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
    assert_eq!(plan.chains.len(), timed.functions.len());
}

#[test]
fn shares_are_found_again_through_noise() {
    let plan = &planned(&["schlick", "dielectric_exact", "table"]);
    for clock in Clock::ALL {
        let measured = measured(plan, &mut MadeUp::new(plan), Some(clock)).unwrap();
        assert_eq!(measured.clock, clock);
        let figures = measured.figures(plan, PIXELS);
        for ([own, _], figure) in plan.chains.iter().zip(figures) {
            let figure = figure.unwrap();
            let share = cost(*own) / cost(plan.reference);
            assert!(
                (figure.share / share - 1.0).abs() < 1e-9,
                "{own:?}: {figure:?}"
            );
            let longer = if clock == Clock::Cpu { 1.5 } else { 1.0 };
            let net = longer * cost(*own) / PIXELS as f64;
            assert!(
                (figure.net_ns_per_pixel - net).abs() < 1e-9,
                "{own:?}: {figure:?}"
            );
            assert!(
                (figure.empty_ns_per_pixel - longer).abs() < 1e-9,
                "{own:?}: {figure:?}"
            );
            let (low, high) = figure.interval.unwrap();
            assert!(low <= figure.share && figure.share <= high, "{figure:?}");
        }
    }
}

/// A card rasterises and blends while it computes: what is computed in less time takes none.
#[test]
fn a_draw_that_hides_its_evaluations_gives_no_figure() {
    let plan = &timed_functions(&["schlick", "conductor_from_f0_f82"]).plan(100);
    let measured = measured(plan, &mut MadeUp::new(plan), None).unwrap();
    let figures = measured.figures(plan, PIXELS);
    assert!(!figures.is_empty());
    for figure in figures {
        assert!(figure.unwrap_err().contains("take more --operations"));
    }
}

#[test]
fn a_clock_that_stands_still_is_not_taken() {
    let plan = &planned(&["schlick"]);
    let mut device = MadeUp::new(plan);
    device.has_clock = false;
    let found = measured(plan, &mut device, None).unwrap();
    assert!(found.clock == Clock::Wall && !found.advances);
    assert!(found.figures(plan, PIXELS)[0].is_ok());
    let refused = measured(plan, &mut device, Some(Clock::Gpu));
    assert!(matches!(refused, Err(Stop::All(why)) if why.contains("do not advance")));
}

#[test]
fn a_shader_that_hangs_takes_only_what_needs_it_along() {
    let plan = &planned(&["schlick", "schlick_ior"]);
    let failing = |hangs: usize| {
        let mut device = MadeUp::new(plan);
        device.hangs = Some(hangs);
        let measured = measured(plan, &mut device, None).unwrap();
        let figures = measured.figures(plan, PIXELS).into_iter();
        let failed: Vec<String> = figures.filter_map(Result::err).collect();
        assert!(failed.iter().all(|why| why.contains("it never ends")));
        failed.len()
    };
    assert_eq!(failing(plan.chains[0][0].long()), 1);
    assert_eq!(failing(plan.reference.short), plan.chains.len());
    assert_eq!(failing(DrawingPlan::HEAVY), plan.chains.len());
}
