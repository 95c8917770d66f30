//! Which methods have no point on a chart, or one without some of the materials, and why.

use std::collections::BTreeMap;

use super::{ChartEntry, ChartView};

/// A sentence for each reason, with the functions that it keeps from the chart.
pub fn without_point(view: &ChartView) -> Vec<String> {
    let entries = view.data.entries.iter().enumerate();
    let functions = entries.filter(|(_, entry)| !entry.is_best);
    let mut reasons: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (place, entry) in functions {
        if let Some(why) = reason(view, place, entry) {
            reasons.entry(why).or_default().push(entry.name());
        }
    }
    let sentence = |(why, names): (String, Vec<&str>)| format!("{}: {why}.", names.join(", "));
    reasons.into_iter().map(sentence).collect()
}

fn reason(view: &ChartView, place: usize, entry: &ChartEntry) -> Option<String> {
    let (undescribed, count) = (&view.set.undescribed[place], view.set.count);
    let has_error = view.error_of(place).is_some();
    let Some(method) = entry.method() else {
        // A user's function without a point says why itself.
        let is_part = has_error && !undescribed.is_empty();
        return is_part.then(|| {
            format!(
                "shown without {}: it gives no number there",
                undescribed.join(", ")
            )
        });
    };
    let described = method.class.described();
    if !undescribed.is_empty() {
        let of = match (undescribed.len(), count) {
            (_, 1) => "this is none".to_owned(),
            (some, all) if some == all => "none of these is one".to_owned(),
            (some, all) if !has_error => format!("{some} of these {all} are none"),
            _ => {
                return Some(format!(
                    "shown without {}, of {described} only",
                    undescribed.join(", ")
                ));
            }
        };
        return Some(format!("only for {described}, and {of}"));
    }
    if !has_error {
        return Some("this error is not measured of what reads a texture".to_owned());
    }
    let unknown = view.cost.costs[place].is_none();
    unknown.then(|| format!("costs nothing or is not recorded on {}", view.cost.name))
}
