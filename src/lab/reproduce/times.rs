//! Table 7: absolute times. Its column heads are misprinted. Table 6, which gives the same runs in per cent, shows the right ones.
//!
//! Each of Table 7's seven columns, divided by the first, must be one of Table 6's. It is identified as the column whose largest
//! deviation over the five devices is smallest.

use super::comparison::{
    self, ComparisonRow, ComparisonVerdict, Figure, RELATIVE_TIMES, ThesisSection,
};

const ABSOLUTE: &str = "table7_absolute_ms";

/// Table 7 divided by its first column, beside Table 6.
pub fn section() -> ThesisSection {
    let order = order();
    let devices = comparison::devices(ABSOLUTE);
    let worst = |places: &[usize]| {
        let pairs = places.iter().enumerate();
        let all = pairs.map(|(column, place)| deviation(column, *place));
        all.fold(0.0, f64::max)
    };
    let printed: Vec<usize> = (0..order.len()).collect();
    ThesisSection {
        title: format!(
            "Table 7: each device's times over dielectric_exact, against Table 6. Under the printed head they are up to \
             {:.0} percentage points off; with the columns in the order below, up to {:.2}",
            worst(&printed),
            worst(&order)
        ),
        rows: devices
            .into_iter()
            .flat_map(|device| device_rows(device, &order))
            .collect(),
    }
}

/// For each column of Table 7 as printed, the matching column of Table 6.
pub fn order() -> Vec<usize> {
    let columns = comparison::names(&[RELATIVE_TIMES, "columns"]).len();
    let nearest = |column| {
        (0..columns).min_by(|a, b| deviation(column, *a).total_cmp(&deviation(column, *b)))
    };
    (0..columns).filter_map(nearest).collect()
}

/// The largest difference of two columns over the devices, in percentage points.
fn deviation(column: usize, place: usize) -> f64 {
    let devices = comparison::devices(ABSOLUTE).into_iter();
    let differences = devices.map(|device| {
        (share(device, column) - comparison::numbers(&[RELATIVE_TIMES, device])[place]).abs()
    });
    differences.fold(0.0, f64::max)
}

/// A time divided by the device's first one, in per cent.
fn share(device: &str, column: usize) -> f64 {
    let times = comparison::numbers(&[ABSOLUTE, device]);
    100.0 * times[column] / times[0]
}

fn device_rows(device: &'static str, order: &[usize]) -> Vec<ComparisonRow> {
    let names = comparison::names(&[RELATIVE_TIMES, "columns"]);
    let printed = comparison::numbers(&[RELATIVE_TIMES, device]);
    let row = |(column, place): (usize, &usize)| {
        let ours = share(device, column);
        let row = ComparisonRow::new("table7", device, names[*place])
            .thesis(Figure::Number(printed[*place], 0, " %"))
            .ours(Figure::Number(ours, 0, " %"))
            .verdict(ComparisonVerdict::of_digits(printed[*place], ours, 0));
        if *place == column {
            return row;
        }
        row.remark(format!("printed under the head of {}", names[column]))
    };
    order.iter().enumerate().map(row).collect()
}
