//! The plan: the candidates of every material judged in every frame, and the choice among them.

use super::candidate::{Candidate, Prices, candidates};
use super::choice::{Choosable, choose};
use super::curve::step_cosines;
use super::frame::{FramePixels, ScenePixel};
use super::judge::{Judge, rounded_error};
use super::metric::{PERCENTILE_FROM, largest, percentile};
use super::request::{PlanRequest, PlannedMaterial};
use crate::generator::emit;

/// The stride in steps of angle where a material is judged at every angle: .7 degrees.
const EVERY: usize = 64;
/// How many pixels are sampled for the light there.
const SAMPLED: usize = 256;
/// The degrees of a right angle.
pub(super) const DEGREES: usize = 90;

/// How a material's error was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// As the difference that 99.9 % of its coverage does not exceed.
    Percentile,
    /// As the largest difference of its few pixels.
    Largest,
    /// As the largest difference at all angles, under the light of its pixels, since too few pixels show it.
    EveryAngle,
}

/// What was found for a material.
#[derive(Clone, Debug)]
pub struct JudgedMaterial {
    /// The material.
    pub material: PlannedMaterial,
    /// Its candidates.
    pub candidates: Vec<Candidate>,
    /// The index of the chosen candidate.
    pub chosen: usize,
    /// How errors were found.
    pub judgement: Judgement,
    /// How many frames show it.
    pub frames: usize,
    /// How many pixels show it, in all frames.
    pub pixels: u64,
    /// How much of its coverage is seen at each degree from 0 to 90.
    pub angles: Vec<f64>,
    /// What its exact law costs.
    pub cost_exact: Option<f64>,
    /// The reference that functions are compared with, at `step_cosines`.
    pub truth: Vec<[f64; 3]>,
}

impl JudgedMaterial {
    /// The chosen candidate.
    pub fn chosen(&self) -> &Candidate {
        &self.candidates[self.chosen]
    }

    /// The candidates that cost less than the chosen one, the most accurate first.
    pub(super) fn cheaper(&self) -> Vec<&Candidate> {
        let most = self.chosen().cost;
        let all = self.candidates.iter();
        let mut cheaper: Vec<_> = all.filter(|one| one.cost < most).collect();
        cheaper.sort_by(|a, b| {
            let by_name = || a.name().cmp(&b.name());
            a.error.total_cmp(&b.error).then_with(by_name)
        });
        cheaper
    }
}

impl Candidate {
    /// The candidate for the choice, if so many pixels of a frame show its material.
    pub(super) fn choosable(&self, pixels: f64) -> Choosable {
        Choosable {
            cost: self.cost * pixels,
            error: self.error,
            name: self.name(),
            is_own: self.is_specialised(),
        }
    }
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanFault<E> {
    /// A frame cannot be read or drawn.
    #[error(transparent)]
    Frame(E),
    /// A function cannot be made.
    #[error(transparent)]
    Function(emit::Error),
    /// A material has no function whose cost is known.
    #[error(
        "{}: no function that describes it has a known cost on {gpu}; name another --gpu",
        crate::physics::foreign::Foreign(material)
    )]
    NoCost {
        /// The material.
        material: String,
        /// The GPU family.
        gpu: &'static str,
    },
}

/// Judges the candidates and chooses. `frame` returns one frame after another; `progress` gets the number done and the total.
///
/// # Errors
/// A frame cannot be read or drawn, or a material has no function whose cost is known.
pub fn plan<E>(
    request: &PlanRequest,
    materials: Vec<PlannedMaterial>,
    frames: usize,
    frame: &mut dyn FnMut(usize) -> Result<FramePixels, E>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<JudgedMaterial>, PlanFault<E>> {
    let judge = Judge::new(request);
    let prices = Prices::of(request);
    let mut so_far = materials
        .into_iter()
        .map(|material| JudgedSoFar::new(request, &prices, material).map_err(PlanFault::Function))
        .collect::<Result<Vec<_>, _>>()?;
    let mut all = so_far.iter().map(|one| &one.judged);
    if let Some(without) = all.find(|judged| judged.candidates.is_empty()) {
        return Err(PlanFault::NoCost {
            material: without.material.subject.name.clone(),
            gpu: request.family.name,
        });
    }
    for index in 0..frames {
        let pixels = frame(index).map_err(PlanFault::Frame)?;
        for (material, pixels) in so_far.iter_mut().zip(&pixels.of_material) {
            material.enter(request, [index, frames], pixels, &judge);
        }
        progress(index as u64 + 1, frames as u64);
    }
    let mut judged: Vec<JudgedMaterial> = so_far
        .into_iter()
        .map(|material| material.judged(request, &judge))
        .collect();
    let functions = judged.iter().map(|material| {
        let pixels = material.pixels.max(1) as f64 / frames.max(1) as f64;
        let all = material.candidates.iter();
        all.map(|one| one.choosable(pixels)).collect()
    });
    let choice = choose(
        &functions.collect::<Vec<_>>(),
        request.budget,
        request.price,
    );
    for (material, chosen) in judged.iter_mut().zip(choice) {
        material.chosen = chosen;
    }
    Ok(judged)
}

/// A material while frames are judged.
struct JudgedSoFar {
    judged: JudgedMaterial,
    /// The most pixels that any frame shows.
    most: usize,
    /// Some of its pixels.
    sample: Sample,
}

impl JudgedSoFar {
    fn new(
        request: &PlanRequest,
        prices: &Prices,
        material: PlannedMaterial,
    ) -> Result<JudgedSoFar, emit::Error> {
        let subject = &material.subject;
        Ok(JudgedSoFar {
            judged: JudgedMaterial {
                candidates: candidates(&material, prices)?,
                chosen: 0,
                judgement: Judgement::Percentile,
                frames: 0,
                pixels: 0,
                angles: vec![0.0; DEGREES],
                cost_exact: prices.cost_exact(subject)?,
                truth: request.truth.values(subject),
                material,
            },
            most: 0,
            sample: Sample::default(),
        })
    }

    /// Adds the material's pixels of one frame, given its index and the number of frames.
    fn enter(
        &mut self,
        request: &PlanRequest,
        [index, frames]: [usize; 2],
        pixels: &[ScenePixel],
        judge: &Judge,
    ) {
        if pixels.is_empty() {
            return;
        }
        self.judged.frames += 1;
        self.judged.pixels += pixels.len() as u64;
        self.most = self.most.max(pixels.len());
        for pixel in pixels {
            self.judged.angles[degree_of(pixel)] += f64::from(pixel.coverage);
            self.sample.enter(pixel);
        }
        let is_by_angles = self.most < request.min_pixels;
        // Errors at every angle will replace these, which then only serve to find the worst of several frames.
        if is_by_angles && frames == 1 {
            return;
        }
        let JudgedMaterial {
            candidates, truth, ..
        } = &mut self.judged;
        let is_last = index + 1 == frames && !is_by_angles;
        let errors = judge.errors(candidates, truth, pixels, is_last, percentile);
        for (candidate, error) in candidates.iter_mut().zip(errors) {
            if error > candidate.error {
                (candidate.error, candidate.worst_frame) = (error, index);
            }
        }
    }

    /// The final result, when all frames have been judged.
    fn judged(mut self, request: &PlanRequest, judge: &Judge) -> JudgedMaterial {
        let JudgedMaterial {
            candidates,
            truth,
            judgement,
            ..
        } = &mut self.judged;
        *judgement = match self.most {
            most if most < request.min_pixels => Judgement::EveryAngle,
            most if most < PERCENTILE_FROM => Judgement::Largest,
            _ => Judgement::Percentile,
        };
        if *judgement == Judgement::EveryAngle {
            candidates.iter_mut().for_each(|one| one.error = 0.0);
            let pixels = every_angle(&self.sample.pixels);
            let errors = judge.errors(candidates, truth, &pixels, true, largest);
            for (candidate, error) in candidates.iter_mut().zip(errors) {
                candidate.error = error;
            }
        }
        for candidate in candidates {
            candidate.error = rounded_error(candidate.error);
        }
        self.judged
    }
}

/// The degree of a pixel's angle, from 0 to 89.
pub(super) fn degree_of(pixel: &ScenePixel) -> usize {
    let angle = libm::acos(f64::from(pixel.cos_theta).clamp(0.0, 1.0));
    (angle.to_degrees() as usize).min(DEGREES - 1)
}

/// An even sample of many pixels: every `2^halvings`th.
#[derive(Default)]
struct Sample {
    pixels: Vec<ScenePixel>,
    /// How many were seen. Every `2^halvings`th of them is kept.
    seen: usize,
    halvings: u32,
}

impl Sample {
    fn enter(&mut self, pixel: &ScenePixel) {
        if self.seen.is_multiple_of(1 << self.halvings) {
            self.pixels.push(*pixel);
        }
        self.seen += 1;
        if self.pixels.len() > SAMPLED {
            let mut place = 0;
            self.pixels.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.halvings += 1;
        }
    }
}

/// Each of these pixels at each angle; a mirror in white light where there are none.
fn every_angle(pixels: &[ScenePixel]) -> Vec<ScenePixel> {
    let pixels = match pixels {
        [] => &[ScenePixel::MIRROR_IN_WHITE],
        some => some,
    };
    let cosines: Vec<f64> = step_cosines().into_iter().step_by(EVERY).collect();
    let at = |pixel: &ScenePixel, cosine: f64| ScenePixel {
        cos_theta: cosine as f32,
        ..*pixel
    };
    let all = pixels.iter();
    all.flat_map(|pixel| cosines.iter().map(|cosine| at(pixel, *cosine)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::judge::distinct_functions;
    use super::super::metric::Metric;
    use super::super::request::PlanTruth;
    use super::*;
    use crate::generator::reference::{Derivation, MaterialInMedium};
    use crate::lab::cost;
    use crate::language::methods;
    use crate::physics::materials::{self, ViewingConditions};
    use crate::physics::num::Precision;
    use crate::physics::spectra::Space;
    use crate::pictures::scene::{Display, TONE_CURVES};

    fn request(budget: f64) -> PlanRequest {
        PlanRequest {
            budget,
            metric: Metric::De2000,
            display: Display {
                exposure: 0.0,
                curve: TONE_CURVES[0],
            },
            space: Space::Srgb,
            exposure_range: 0.0,
            min_pixels: 100,
            truth: PlanTruth::Spectrum,
            family: cost::find("rdna2").unwrap(),
            precision: Precision::F32,
            channels: vec![3],
            methods: methods::ALL.to_vec(),
            fetch: None,
            price: 0.0,
        }
    }

    fn gold() -> PlannedMaterial {
        let material = materials::find("gold").unwrap().unwrap();
        let typed = ("gold".to_owned(), material);
        let seen = ViewingConditions::default();
        let subject = MaterialInMedium::new(typed, None, &seen, Derivation::default()).unwrap();
        PlannedMaterial {
            argument: "gold".to_owned(),
            names: Vec::new(),
            subject,
            is_library_only: false,
        }
    }

    /// A sphere that fills a square picture, seen from far away.
    fn sphere(side: u32, light: [f32; 3]) -> FramePixels {
        let mut frame = FramePixels::new([side, side], 1);
        let at = |place: u32| (f64::from(place) + 0.5) * 2.0 / f64::from(side) - 1.0;
        for place in 0..side * side {
            let (x, y) = (at(place % side), at(place / side));
            let square = 1.0 - x * x - y * y;
            if square > 0.0 {
                frame.of_material[0].push(ScenePixel {
                    place,
                    cos_theta: square.sqrt() as f32,
                    roughness: 0.0,
                    coverage: 1.0,
                    light,
                    other: [0.0; 3],
                });
            }
        }
        frame
    }

    fn judged(request: &PlanRequest, frame: FramePixels) -> JudgedMaterial {
        let mut frames = |_| Ok::<_, std::convert::Infallible>(frame.clone());
        let all = plan(request, vec![gold()], 1, &mut frames, &mut |_, _| {});
        all.unwrap().remove(0)
    }

    fn error(judged: &JudgedMaterial, method: &str) -> f64 {
        let is_it = |one: &&Candidate| one.name() == method;
        judged.candidates.iter().find(is_it).unwrap().error
    }

    /// A sphere seen from afar shows angles with the density sin 2θ.
    #[test]
    fn a_sphere_shows_each_degree_as_often_as_its_ring_is_wide() {
        let seen = judged(&request(1.0), sphere(512, [1.0; 3]));
        let whole: f64 = seen.angles.iter().sum();
        let inside = |degree: usize| libm::sin((degree as f64).to_radians()).powi(2);
        for (degree, covered) in seen.angles.iter().enumerate() {
            let ring = inside(degree + 1) - inside(degree);
            assert!((covered / whole - ring).abs() < 1e-3, "{degree}");
        }
    }

    /// The forms of a method have the same values, except those of one channel. So gold's candidates are judged by fewer curves.
    #[test]
    fn what_has_the_same_values_is_judged_once() {
        let request = request(1.0);
        let candidates = candidates(&gold(), &Prices::of(&request)).unwrap();
        let distinct = distinct_functions(&candidates);
        for function in &distinct {
            for place in &function.candidates {
                assert_eq!(*candidates[*place].values, *function.values);
            }
        }
        let methods = candidates.iter().map(|one| one.method.name);
        let methods: std::collections::BTreeSet<&str> = methods.collect();
        assert!(candidates.len() > distinct.len());
        assert!(distinct.len() <= methods.len(), "{}", distinct.len());
    }

    /// Figures from an independent prototype.
    #[test]
    fn gold_in_white_light_takes_the_fitted_method_and_in_dim_light_the_gaussian() {
        let white = judged(&request(1.0), sphere(512, [1.0; 3]));
        assert!((error(&white, "schlick_spherical_gaussian") - 1.82).abs() < 0.02);
        assert!((error(&white, "schlick") - 1.78).abs() < 0.02);
        assert!((error(&white, "fitted") - 0.14).abs() < 0.007);
        assert_eq!(white.chosen().name(), "fitted");
        let dim = judged(&request(1.0), sphere(512, [0.05, 0.04, 0.0275]));
        assert!((error(&dim, "schlick_spherical_gaussian") - 0.61).abs() < 0.01);
        assert_eq!(dim.chosen().name(), "schlick_spherical_gaussian");
    }

    /// Candidates that cost more than the cheapest within the budget are not judged, and the report stays the same. With a price
    /// too small to change any sum, all of them are judged.
    #[test]
    fn what_cannot_be_chosen_is_not_judged() {
        let few = || {
            let mut frame = FramePixels::new([64, 64], 1);
            let all = sphere(64, [1.0; 3]).of_material.remove(0);
            let some = all.into_iter().step_by(60).enumerate();
            frame.of_material[0] = some
                .map(|(i, pixel)| ScenePixel {
                    roughness: i as f32 / 60.0,
                    ..pixel
                })
                .collect();
            frame
        };
        for frame in [few(), sphere(128, [1.0; 3])] {
            for budget in [0.05, 1.0, 1e-9] {
                let quick = judged(&request(budget), frame.clone());
                let all = PlanRequest {
                    price: f64::MIN_POSITIVE,
                    ..request(budget)
                };
                let whole = judged(&all, frame.clone());
                let count = |judged: &JudgedMaterial| {
                    let all = judged.candidates.iter();
                    all.filter(|one| one.error.is_finite()).count()
                };
                assert_eq!(count(&whole), whole.candidates.len());
                assert!(budget != 1.0 || count(&quick) < count(&whole));
                assert_eq!(quick.row(&all, 1), whole.row(&all, 1), "{budget}");
            }
        }
    }
}
