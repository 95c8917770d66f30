//! The proof: runs the text that a plan writes on this machine's graphics stack, and checks the picture that it makes.
//!
//! In the frame where a function is worst, its emitted text computes the reflectance of every pixel. The picture made of these
//! numbers is compared with the budget in the plan's metric, once as it is and once in 8-bit codes. The numbers themselves are
//! compared with the function's exact meaning in f64; the limit is its promised code bound. These are two different errors.

use serde::Serialize;

use super::curve::{Curve, PixelPlace, RoughRule, step_cosines};
use super::frame::{FramePixels, ScenePixel};
use super::metric::{JudgedPixels, Metric, Screen, largest, percentile};
use super::planned::{JudgedMaterial, PlanFault};
use super::request::PlanRequest;
use crate::generator::emit::{
    self, Bounds, CodeBound, EmittedFunction, HeaderForm, Heading, Naming, library_functions,
    specialised_function,
};
use crate::generator::fit::Measured;
use crate::lab::fault::Fault;
use crate::lab::gpu::Wanted;
use crate::lab::verify::run::{Devices, ExecutionPath, ShippedFunction};
use crate::lab::verify::{Status, Trial, material_trial};
use crate::language::methods::Gpu;
use crate::language::targets::{GLES, Target, WGSL};

/// The targets whose text is run.
const TARGETS: [&Target; 2] = [&WGSL, &GLES];

/// The result of running a function's text.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Proof {
    /// The material, as a user names it.
    pub material: String,
    /// The target language.
    pub target: &'static str,
    /// The function that was called.
    pub function: String,
    /// The frame, from 0.
    pub frame: usize,
    /// At how many cosines the function was run.
    pub points: usize,
    /// The error of the picture, in the plan's metric.
    pub error: Option<f64>,
    /// The error between both pictures in 8-bit codes; `None` for screens of high dynamic range.
    pub error_8bit: Option<f64>,
    /// The largest difference in 8-bit codes.
    pub codes: Option<u8>,
    /// The largest absolute difference from the function's exact meaning in f64.
    pub code_abs: Option<f64>,
    /// Whether that is within the function's promised bound.
    pub is_within_code_bound: Option<bool>,
    /// Whether the picture is within the budget and the numbers within the bound.
    pub status: Status,
    /// Why it was not checked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Runs the chosen functions of these materials, each in the frame where it is worst. Also returns the name of the device, if
/// there is one.
///
/// # Errors
/// A frame cannot be read or drawn. Or a function cannot be written: a bug.
pub fn prove<E>(
    request: &PlanRequest,
    judged: &[JudgedMaterial],
    frame: &mut dyn FnMut(usize) -> Result<FramePixels, E>,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<(Option<String>, Vec<Proof>), PlanFault<E>> {
    let devices = Devices::new(Wanted::default());
    let mut proofs = Vec::new();
    let whole = judged.len() * TARGETS.len();
    for (i, judged) in judged.iter().enumerate() {
        let frame = frame(judged.chosen().worst_frame).map_err(PlanFault::Frame)?;
        let written = Written::new(request, judged).map_err(PlanFault::Function)?;
        for target in TARGETS {
            let proof = written.proof(target, &frame.of_material[i], &devices);
            proofs.push(proof.map_err(PlanFault::Function)?);
            progress(proofs.len() as u64, whole as u64);
        }
    }
    let device = devices.compute().ok();
    Ok((device.map(|device| device.adapter.to_string()), proofs))
}

/// The chosen function as it is written to a file.
struct Written<'a> {
    request: &'a PlanRequest,
    judged: &'a JudgedMaterial,
    functions: Vec<EmittedFunction>,
    /// The index of the function that is called.
    called: usize,
    naming: Naming,
    trial: Trial,
}

impl<'a> Written<'a> {
    fn new(
        request: &'a PlanRequest,
        judged: &'a JudgedMaterial,
    ) -> Result<Written<'a>, emit::Error> {
        let chosen = judged.chosen();
        let subject = &judged.material.subject;
        let naming = Naming {
            precision: request.precision,
            gpu: Gpu::find(request.family.name),
            ..Naming::default()
        };
        let functions = if chosen.is_specialised() {
            let bounds = Bounds::recorded();
            vec![specialised_function(
                chosen.method,
                subject,
                &naming,
                &bounds,
            )?]
        } else {
            library_functions(chosen.method, &naming)?
        };
        let called = functions.iter().position(|one| one.form == chosen.form);
        let called = called.expect("a candidate's form is one of its method's");
        let mut trial = material_trial(subject, &functions[called]);
        if chosen.channels() == 1 {
            // The green channel stands for all three.
            trial.values = trial.values.iter().map(|value| [value[1]; 3]).collect();
        }
        Ok(Written {
            request,
            judged,
            functions,
            called,
            naming,
            trial,
        })
    }

    /// The text of the file that holds the function.
    fn bytes(&self, target: &'static Target) -> Result<Vec<u8>, emit::Error> {
        let heading = Heading {
            form: HeaderForm::Short,
            command: "fresnel-gen --plan plan.json",
            gpu: self.naming.gpu,
        };
        let (subject, chosen) = (&self.judged.material.subject, self.judged.chosen());
        let files = if chosen.is_specialised() {
            emit::material(target, subject, &self.functions, &self.naming, heading)?
        } else {
            emit::library(target, chosen.method, &self.functions, heading)?
        };
        let first = files.into_iter().next();
        Ok(first.map(|file| file.bytes).unwrap_or_default())
    }

    fn proof(
        &self,
        target: &'static Target,
        pixels: &[ScenePixel],
        devices: &Devices,
    ) -> Result<Proof, emit::Error> {
        let bytes = self.bytes(target)?;
        let called = &self.functions[self.called];
        let mut cosines: Vec<f32> = step_cosines().iter().map(|c| *c as f32).collect();
        let steps = cosines.len();
        cosines.extend(pixels.iter().map(|pixel| pixel.cos_theta));
        let mut proof = Proof {
            material: self.judged.material.argument.clone(),
            target: target.name,
            function: called.name.clone(),
            frame: self.judged.chosen().worst_frame,
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
                let got_parts = got.split_at(steps).into();
                let picture = picture_errors(self.request, &self.judged.truth, pixels, got_parts);
                let (code_abs, is_within) = self.code_error(&cosines, &got);
                let holds = is_within && picture.error <= self.request.budget + SLACK;
                proof.error = Some(picture.error);
                proof.error_8bit = picture.error_8bit;
                proof.codes = Some(picture.codes);
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

/// Errors of a picture, in the plan's metric.
struct PictureErrors {
    error: f64,
    /// The error where both pictures are in 8-bit codes.
    error_8bit: Option<f64>,
    /// The largest difference in 8-bit codes.
    codes: u8,
}

/// The errors of a material's picture, from what the device computed at each step of a table, and at each pixel.
fn picture_errors(
    request: &PlanRequest,
    truth: &[[f64; 3]],
    pixels: &[ScenePixel],
    [steps, got]: [&[[f32; 3]]; 2],
) -> PictureErrors {
    let places: Vec<PixelPlace> = pixels.iter().map(PixelPlace::of).collect();
    let rule = RoughRule::new();
    let wide = |value: &[f32; 3]| value.map(f64::from);
    let steps: Vec<[f64; 3]> = steps.iter().map(wide).collect();
    let curve = Curve::new(&steps, &places, &rule);
    let truth = Curve::new(truth, &places, &rule);
    // A mirror takes the value at its own cosine. A rough surface takes the mean over half vectors.
    let value = |i: usize| {
        if pixels[i].roughness > 0.0 {
            curve.at(&places[i])
        } else {
            wide(&got[i])
        }
    };
    let error = |screen: &Screen, exposures: &[f64], error_of| {
        let exact = |i: usize| truth.at(&places[i]);
        JudgedPixels::new(pixels, screen, exposures, exact).error(error_of, value)
    };
    let (screen, exposures) = (request.screen(), request.exposures());
    let codes = Screen::new(Metric::Code8, request.display, request.space);
    PictureErrors {
        error: error(&screen, &exposures, percentile),
        error_8bit: (request.metric != Metric::Itp)
            .then(|| error(&screen.coded(), &exposures, percentile)),
        codes: error(&codes, &[0.0], largest) as u8,
    }
}
