//! Every f32 from 0 to 1, for functions specialised to materials, in WGSL: not a sample.

use std::time::Instant;

use serde_json::Value;

use crate::app::error::Error;
use crate::verify::run::{Devices, Fault, Shown, Way};
use crate::verify::{ALL, cosines, sweep};

use super::file::specialised;
use super::plan::Plan;
use super::row::{Row, Run};

/// The rows of all numbers, and how many points a second each took.
///
/// # Errors
/// There is no device, or nothing that can be swept.
pub fn rows(
    plan: &Plan,
    devices: &Devices,
    progress: &mut dyn FnMut(u64, u64, &str),
) -> Result<(Vec<Value>, Vec<String>), Error> {
    let files = plan.files.iter().filter(|file| file.target.name == "wgsl");
    let mut rows = Vec::new();
    let mut remarks = Vec::new();
    for file in files {
        let Some(subject) = file.subject.map(|index| &plan.subjects[index]) else {
            continue;
        };
        for emitted in plan.asked_for(file) {
            let case = specialised(subject, emitted);
            let page = file.run_page();
            let shown = Shown {
                target: "wgsl",
                bytes: &page.bytes,
                function: emitted,
                entry: "",
            };
            let start = Instant::now();
            let told = &mut |done| progress(done / 1024, ALL / 1024, &emitted.name);
            let swept = match case.trial.table {
                Some(_) => Err(Fault::Absent(
                    "a texture is filtered by steps: a sample tells all".to_owned(),
                )),
                None => sweep(devices, &shown, &case.trial, told),
            };
            let seconds = start.elapsed().as_secs_f64();
            remarks.push(format!(
                "{}: {:.1} million points a second",
                emitted.name,
                ALL as f64 / seconds / 1e6
            ));
            let run = swept.and_then(|outcome| {
                Ok(Run {
                    points: ALL as usize,
                    bound: case.trial.expected(&cosines(20_000)).bound,
                    outcome,
                    model_error: emitted.model_error,
                    device: devices.of("wgsl", Way::Own)?.adapter.to_string(),
                })
            });
            let runs = [(Way::Own, run)];
            rows.push(
                Row {
                    file,
                    emitted,
                    material: &subject.argument,
                    accepts: &[],
                    runs: &runs,
                }
                .json(),
            );
        }
    }
    if rows.is_empty() {
        return Err(Error::Usage {
            what: "--exhaustive runs functions specialised to a material in WGSL: name both, and leave --target out or name wgsl".to_owned(),
        });
    }
    Ok((rows, remarks))
}
