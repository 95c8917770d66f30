//! Which methods have no point on a chart, and why.

use std::collections::BTreeMap;

use super::{ChartEntry, ChartView};

/// A sentence for each reason, with the methods that it keeps from the chart.
pub fn without_point(view: &ChartView) -> Vec<String> {
    let entries = view.data.entries.iter().enumerate();
    let methods = entries.filter(|(_, entry)| entry.method().is_some() && !entry.is_best);
    let mut reasons: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (place, entry) in methods {
        if let Some(why) = reason(view, place, entry) {
            reasons.entry(why).or_default().push(entry.name());
        }
    }
    let sentence = |(why, names): (String, Vec<&str>)| format!("{}: {why}.", names.join(", "));
    reasons.into_iter().map(sentence).collect()
}

fn reason(view: &ChartView, place: usize, entry: &ChartEntry) -> Option<String> {
    let class = entry.method()?.class;
    let (undescribed, count) = (view.set.undescribed[place], view.set.count);
    if undescribed > 0 {
        let of = match (undescribed, count) {
            (_, 1) => "this is none".to_owned(),
            (some, all) if some == all => "none of these is one".to_owned(),
            (some, all) => format!("{some} of these {all} are none"),
        };
        return Some(format!("only for {}, and {of}", class.described()));
    }
    if view.error_of(place).is_none() {
        return Some("this error is not measured of what reads a texture".to_owned());
    }
    let unknown = view.cost.costs[place].is_none();
    unknown.then(|| format!("costs nothing or is not recorded on {}", view.cost.name))
}
