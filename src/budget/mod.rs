//! The budget: the one cheapest function of each material that errs no more than it may, on the recorded costs of a family of GPUs.
//! Pure: nothing is measured here.

mod choice;
mod spread;
mod text;

use std::collections::BTreeMap;

use crate::cost::{Compiler, Family, Record, function_cost, library_cost, records};
use crate::emit::{Bounds, specialised_graph};
use crate::fit::single_error;
use crate::ir::Checked;
use crate::materials::{self, Material};
use crate::methods::{self, Contract, Light, Method};
use crate::num::{Precision, in_parallel};
use crate::reference::Subject;

use crate::app::error::Error;
use crate::app::request::{DEFAULT_MATERIALS, Materials, Request, Source};
use choice::{Candidate, cheapest, nearest};
use spread::spread;
use text::Measured;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// The largest error of reflectance, over angles and channels; above 0.
    pub most: f64,
    /// Whose costs decide.
    pub family: &'static Family,
}

/// The request with one method for each material, and what is said of each choice.
///
/// # Errors
/// The budget is no error, no costs are recorded, or a material has no function within it.
pub fn within(request: Request, budget: Budget) -> Result<(Request, Vec<String>), Error> {
    check(&request, budget)?;
    let mut request = request;
    if request.materials == Materials::Default {
        let named = DEFAULT_MATERIALS.map(|name| Source::Named(name.to_owned()));
        request.materials = Materials::These(named.to_vec());
    }
    let subjects: Vec<Subject> = request
        .subjects()?
        .ready
        .into_iter()
        .map(|(s, _)| s)
        .collect();
    let search = Search {
        methods: candidates(&request)?,
        catalogue: materials::list()?,
        record: records(budget.family.name),
        bounds: Bounds::recorded(),
        request: &request,
        budget,
    };
    let of = |i: usize| search.of(&subjects[i]);
    let found = in_parallel(subjects.len(), &of, &mut |_, _| {});
    let (mut chosen, mut lines, mut faults) = (BTreeMap::new(), Vec::new(), Vec::new());
    for (subject, found) in subjects.iter().zip(found) {
        match found? {
            Ok((method, said)) => {
                chosen.insert(subject.name.clone(), method);
                lines.extend(said);
            }
            Err(why) => faults.push(why),
        }
    }
    if !faults.is_empty() {
        return Err(refused(budget, &faults));
    }
    request.chosen = chosen;
    Ok((request, lines))
}

/// How many materials without a function an error names.
const NAMED: usize = 3;

fn refused(budget: Budget, faults: &[String]) -> Error {
    let more = match faults.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    let named: Vec<&str> = faults.iter().take(NAMED).map(String::as_str).collect();
    let what = format!(
        "nothing is within --budget {}; {}{more}",
        budget.most,
        named.join("; ")
    );
    Error::Usage { what }
}

fn check(request: &Request, budget: Budget) -> Result<(), Error> {
    let most = budget.most;
    let family = budget.family;
    let what = if !(most > 0.0 && most.is_finite()) {
        format!("--budget is {most}; it is an error of reflectance, above 0, such as 0.001")
    } else if request.precision.is_half() {
        "--budget is of functions in single precision; leave --precision f16 out".to_owned()
    } else if request.materials == Materials::None {
        "--budget chooses for materials; `none` leaves none to choose for".to_owned()
    } else if let Compiler::None(why) = family.compiler {
        format!(
            "no costs are recorded of {}: {why}; name another --gpu",
            family.name
        )
    } else {
        return Ok(());
    };
    Err(Error::Usage { what })
}

/// The methods among which a budget chooses: those named, or all, for unpolarised light, that keep the contract.
fn candidates(request: &Request) -> Result<Vec<&'static Method>, Error> {
    let named = request.resolved_methods()?;
    let mut methods = named.unwrap_or_else(|| methods::ALL.to_vec());
    methods
        .retain(|method| method.light == Light::Unpolarised && method.contract == Contract::Kept);
    if methods.is_empty() {
        let what = "--budget chooses among methods for unpolarised light that keep the contract; none of --method is one".to_owned();
        return Err(Error::Usage { what });
    }
    Ok(methods)
}

/// What is the same for all materials.
struct Search<'a> {
    request: &'a Request,
    budget: Budget,
    methods: Vec<&'static Method>,
    catalogue: Vec<Material>,
    record: Record,
    bounds: Bounds,
}

/// A material's method with what is said of it, or why it has none.
type Found = Result<(&'static str, Vec<String>), String>;

impl Search<'_> {
    fn of(&self, subject: &Subject) -> Result<Found, Error> {
        let (candidates, form) = self.candidates(subject)?;
        let family = self.budget.family;
        let Some(choice) = cheapest(&candidates, self.budget.most) else {
            let best = nearest(candidates.iter());
            return Ok(Err(text::nothing(&subject.name, best.as_ref(), family)));
        };
        let spread = spread(subject, &self.catalogue, &self.request.sight);
        let measured = Measured { family, form };
        let lines = text::lines(&subject.name, &choice, spread, self.budget.most, measured);
        Ok(Ok((choice.chosen.method, lines)))
    }

    /// The functions that could be taken, and the form whose costs are theirs: the specialised one's where all are recorded, else
    /// the library's, since costs of two forms cannot be compared.
    fn candidates(&self, subject: &Subject) -> Result<(Vec<Candidate>, &'static str), Error> {
        let methods = self.methods.iter().copied();
        let functions = methods
            .filter(|method| subject.is_described_by(method))
            .map(|method| Ok((method, self.function(method, subject)?)))
            .collect::<Result<Vec<(&'static Method, Checked)>, Error>>()?;
        let own = |(_, function): &(_, Checked)| {
            function_cost(function, self.budget.family, &self.record)
        };
        let specialised: Option<Vec<f64>> = functions.iter().map(own).collect();
        let library = |method| library_cost(method, self.budget.family, &self.record);
        let (costs, form): (Vec<Option<f64>>, _) = match specialised {
            Some(costs) => (costs.into_iter().map(Some).collect(), "specialised"),
            None => (
                functions
                    .iter()
                    .map(|(method, _)| library(method))
                    .collect(),
                "library",
            ),
        };
        let candidate = |((method, function), cost): (&(&'static Method, Checked), Option<f64>)| {
            let error = single_error(function, &subject.truth_for(method));
            Some(Candidate {
                method: method.name,
                error: error.max_abs,
                cost: cost.filter(|_| error.undefined == 0)?,
                is_textured: method.is_textured(),
            })
        };
        Ok((
            functions.iter().zip(costs).filter_map(candidate).collect(),
            form,
        ))
    }

    fn function(&self, method: &Method, subject: &Subject) -> Result<Checked, Error> {
        let made = specialised_graph(method, subject, Precision::F32, &self.bounds)?;
        Ok(made.function)
    }
}
