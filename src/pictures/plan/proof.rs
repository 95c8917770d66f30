//! The proof: runs the text that a plan writes on this machine's graphics stack, and checks the picture that it makes.
//!
//! In the frame where a function is worst, its emitted text computes the reflectance of every pixel. The picture made of these
//! numbers is compared with the budget in the plan's metric, once as it is and once in 8-bit codes. The numbers themselves are
//! compared with the function's exact meaning in f64; the limit is its promised code bound. These are two different errors.

use glam::DVec3;

use super::candidate::Candidate;
use super::curve::{Curve, PixelPlace, RoughRule, step_cosines};
use super::metric::{Metric, ScenePixel, Screen, error_of, radiance};
use super::planned::JudgedMaterial;
use super::request::PlanRequest;
use super::row::Proof;
use crate::generator::emit::{
    self, Bounds, CodeBound, EmittedFunction, HeaderForm, Heading, Naming, library_functions,
    specialised_function,
};
use crate::generator::fit::Measured;
use crate::lab::fault::Fault;
use crate::lab::gpu::Wanted;
use crate::lab::verify::run::{Devices, ExecutionPath, ShippedFunction};
use crate::lab::verify::{Status, Trial, material_trial};
use crate::language::targets::{GLES, Target, WGSL};
use crate::physics::spectra::{srgb_byte, srgb_linear};

/// The targets whose text is run.
const TARGETS: [&Target; 2] = [&WGSL, &GLES];

/// The function of a material and the pixels that it is held to.
pub struct ProofCase<'a> {
    /// What was found for the material.
    pub judged: &'a JudgedMaterial,
    /// Its pixels in the frame where the chosen function is worst.
    pub pixels: &'a [ScenePixel],
}

/// Runs the chosen functions of these materials.
///
/// # Errors
/// A function cannot be written: a bug.
pub fn prove(
    request: &PlanRequest,
    cases: &[ProofCase],
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Option<String>, Vec<Proof>), emit::Error> {
    let devices = Devices::new(Wanted::default());
    let mut proofs = Vec::new();
    let whole = cases.len() * TARGETS.len();
    for case in cases {
        let written = Written::new(request, case.judged)?;
        for target in TARGETS {
            proofs.push(written.proof(request, case, target, &devices)?);
            progress(proofs.len() as u64, whole as u64);
        }
    }
    let device = devices
        .compute()
        .ok()
        .map(|device| device.adapter.to_string());
    Ok((device, proofs))
}

/// The chosen function as it is written to a file.
struct Written {
    functions: Vec<EmittedFunction>,
    /// The index of the function that is called.
    called: usize,
    naming: Naming,
    trial: Trial,
}

impl Written {
    fn new(request: &PlanRequest, judged: &JudgedMaterial) -> Result<Written, emit::Error> {
        let Candidate { method, form, .. } = judged.chosen().candidate;
        let subject = &judged.material.subject;
        let naming = Naming {
            precision: request.precision,
            ..Naming::default()
        };
        let functions = if judged.chosen().candidate.is_specialised() {
            let bounds = Bounds::recorded();
            vec![specialised_function(method, subject, &naming, &bounds)?]
        } else {
            library_functions(method, &naming)?
        };
        let called = functions.iter().position(|one| one.form == form);
        let called = called.expect("a candidate's form is one of its method's");
        let mut trial = material_trial(subject, &functions[called]);
        if judged.chosen().candidate.channels() == 1 {
            // The green channel stands for all three.
            trial.values = trial.values.iter().map(|value| [value[1]; 3]).collect();
        }
        Ok(Written {
            functions,
            called,
            naming,
            trial,
        })
    }

    /// The text of the file that holds the function.
    fn bytes(
        &self,
        judged: &JudgedMaterial,
        target: &'static Target,
    ) -> Result<Vec<u8>, emit::Error> {
        let heading = Heading {
            form: HeaderForm::Short,
            command: "fresnel-gen --plan plan.json",
        };
        let subject = &judged.material.subject;
        let files = if judged.chosen().candidate.is_specialised() {
            emit::material(target, subject, &self.functions, &self.naming, heading)?
        } else {
            let method = judged.chosen().candidate.method;
            emit::library(target, method, &self.functions, heading)?
        };
        Ok(files
            .into_iter()
            .next()
            .map(|file| file.bytes)
            .unwrap_or_default())
    }

    fn proof(
        &self,
        request: &PlanRequest,
        case: &ProofCase,
        target: &'static Target,
        devices: &Devices,
    ) -> Result<Proof, emit::Error> {
        let bytes = self.bytes(case.judged, target)?;
        let called = &self.functions[self.called];
        let mut cosines: Vec<f32> = step_cosines().iter().map(|c| *c as f32).collect();
        let steps = cosines.len();
        cosines.extend(case.pixels.iter().map(|pixel| pixel.cos_theta));
        let mut proof = Proof {
            material: case.judged.material.argument.clone(),
            target: target.name,
            function: called.name.clone(),
            frame: case.judged.chosen().worst_frame,
            points: cosines.len(),
            error: None,
            error_8bit: None,
            codes: None,
            code_abs: None,
            is_within_code_bound: None,
            status: Status::NotChecked,
            reason: None,
        };
        let shipped = ShippedFunction {
            target,
            bytes: &bytes,
            function: called,
            entry: "main",
        };
        let ran = devices
            .prepare(&shipped, ExecutionPath::Own, &self.trial)
            .and_then(|runnable| runnable.run(&self.trial, &cosines));
        match ran {
            Ok(got) => {
                let picture = Picture::new(request, case, &got[..steps], &got[steps..]);
                let error = picture.error();
                let (code_abs, is_within) = self.code_error(&cosines, &got);
                let holds = is_within && error <= request.budget + SLACK;
                proof.error = Some(error);
                proof.error_8bit = (request.metric != Metric::Itp).then(|| picture.error_8bit());
                proof.codes = Some(picture.codes());
                proof.code_abs = Some(code_abs);
                proof.is_within_code_bound = Some(is_within);
                proof.status = if holds { Status::Pass } else { Status::Fail };
            }
            Err(Fault::Absent(why)) => proof.reason = Some(why),
            Err(Fault::Failed(why)) => {
                (proof.status, proof.reason) = (Status::Fail, Some(why));
            }
        }
        Ok(proof)
    }

    /// The largest absolute difference from the function's exact meaning in f64, and whether the promised bound is kept.
    fn code_error(&self, cosines: &[f32], got: &[[f32; 3]]) -> (f64, bool) {
        let called = &self.functions[self.called];
        let want = self.trial.run::<f64>(cosines);
        let off = |i: usize| {
            let (got, want) = (got[i], want.at(i));
            (0..3).map(move |c| (f64::from(got[c]) - want[c]).abs())
        };
        let most = (0..got.len()).flat_map(off).fold(0.0, f64::max);
        let is_within = match &called.code {
            Measured::Yes(CodeBound::Absolute(bound)) => most <= *bound,
            _ => self.trial.expected(cosines).judge(got).miss.is_none(),
        };
        (most, is_within)
    }
}

/// The last digit of an error that is printed with four.
const SLACK: f64 = 5e-5;

/// Both pictures of a material.
struct Picture<'a> {
    pixels: &'a [ScenePixel],
    screen: Screen,
    exposures: Vec<f64>,
    places: Vec<PixelPlace>,
    truth: Curve<'a>,
    /// The reflectance of every pixel, as the device computed it.
    got: Vec<[f64; 3]>,
}

impl<'a> Picture<'a> {
    fn new(
        request: &PlanRequest,
        case: &ProofCase<'a>,
        steps: &[[f32; 3]],
        pixels: &[[f32; 3]],
    ) -> Picture<'a> {
        let places: Vec<PixelPlace> = case.pixels.iter().map(PixelPlace::of).collect();
        let rule = RoughRule::new();
        let wide = |value: &[f32; 3]| value.map(f64::from);
        let steps: Vec<[f64; 3]> = steps.iter().map(wide).collect();
        let curve = Curve::new(&steps, &places, &rule);
        // A mirror takes the value at its own cosine. A rough surface takes the mean over half vectors.
        let value = |(i, place): (usize, &PixelPlace)| {
            if case.pixels[i].roughness > 0.0 {
                curve.at(place)
            } else {
                wide(&pixels[i])
            }
        };
        Picture {
            pixels: case.pixels,
            screen: Screen::new(request.metric, request.display, request.space),
            exposures: request.exposures(),
            got: places.iter().enumerate().map(value).collect(),
            truth: Curve::new(&case.judged.truth, &places, &rule),
            places,
        }
    }

    /// The pixels as the screen shows them at this many stops of exposure: from the device, and by the exact law.
    fn shown(&self, stops: f64) -> impl Iterator<Item = [DVec3; 2]> {
        (0..self.pixels.len()).map(move |i| {
            let truth = self.truth.at(&self.places[i]);
            let shown = |value| self.screen.shown(radiance(&self.pixels[i], value), stops);
            [self.got[i], truth].map(shown)
        })
    }

    fn error(&self) -> f64 {
        self.error_of(&|shown| shown)
    }

    fn error_8bit(&self) -> f64 {
        let linear = |x: f64| srgb_linear(f64::from(srgb_byte(x)) / 255.0);
        self.error_of(&|shown: DVec3| DVec3::from_array(shown.to_array().map(linear)))
    }

    /// The error at the exposure where it is worst.
    fn error_of(&self, coded: &dyn Fn(DVec3) -> DVec3) -> f64 {
        let of_exposure = |stops: &f64| {
            let differences = self.shown(*stops).zip(self.pixels);
            let differences = differences.map(|(pair, pixel)| {
                let [got, truth] = pair.map(|shown| self.screen.place(coded(shown)));
                let difference = self.screen.difference(got, truth);
                (difference, f64::from(pixel.coverage))
            });
            error_of(differences.collect())
        };
        self.exposures.iter().map(of_exposure).fold(0.0, f64::max)
    }

    fn codes(&self) -> u8 {
        let apart = |[got, truth]: [DVec3; 2]| {
            let [got, truth] = [got, truth].map(|shown| shown.to_array().map(srgb_byte));
            (0..3).map(|c| got[c].abs_diff(truth[c])).fold(0, u8::max)
        };
        self.shown(0.0).map(apart).fold(0, u8::max)
    }
}
