//! A user's function as a point of charts, read from its rows.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{Own, User};

/// Errors leave out cosines at which it gives no number. Above this share they are no longer those of the function.
const MOST_UNDEFINED: f64 = 0.01;

/// The point, from the rows of all materials; none where there are no rows.
pub fn own(rows: &[Value]) -> Option<Own> {
    let text = |row: &Value, key: &str| row[key].as_str().unwrap_or_default().to_owned();
    let first = rows.first()?;
    let about = match first["device"].as_str() {
        Some(device) => format!("From {}, run on {device}", text(first, "file")),
        None => format!("From {}", text(first, "file")),
    };
    let failing = rows.iter().find(|row| row["status"] == "fail");
    Some(Own {
        user: User {
            name: text(first, "function"),
            about,
            fails: failing.map(|row| text(row, "reason").replace('\n', "; ")),
        },
        errors: rows.iter().map(errors).collect(),
        costs: costs(rows),
    })
}

/// Its error on each axis; none where it was not run, or gives no number too often.
fn errors(row: &Value) -> [Option<f64>; 4] {
    let (error, seen) = (&row["model_error"], &row["perceived"]);
    let number = |value: &Value| value.as_f64().unwrap_or(0.0);
    if number(&error["undefined"]) > MOST_UNDEFINED * number(&row["points"]) {
        return [None; 4];
    }
    [
        error["max_abs"].as_f64(),
        error["mean_rel"].as_f64(),
        seen["luminance"].as_f64(),
        seen["de2000"].as_f64(),
    ]
}

/// The cost on each family where it is known: of materials, the most. A function of single numbers is called once where channels
/// are the same.
fn costs(rows: &[Value]) -> BTreeMap<String, f64> {
    let mut costs = BTreeMap::new();
    let all = rows.iter().filter_map(|row| row["cost"].as_array());
    for cost in all.flatten() {
        let (Some(gpu), Some(net)) = (cost["gpu"].as_str(), cost["net"].as_f64()) else {
            continue;
        };
        let most = costs.entry(gpu.to_owned()).or_insert(net);
        *most = net.max(*most);
    }
    costs
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_point_is_read_from_rows() {
        let row = |undefined: usize, net: Option<f64>, status: &str| {
            json!({
                "function": "f", "file": "f.wgsl", "device": "a device", "points": 2000, "status": status, "reason": "one\ntwo",
                "model_error": { "max_abs": 0.1, "mean_rel": null, "undefined": undefined },
                "perceived": { "luminance": 0.05, "de2000": 3.0 },
                "cost": [{ "gpu": "rdna2", "net": net }, { "gpu": "gcn4", "net": null }],
            })
        };
        let known = [Some(0.1), None, Some(0.05), Some(3.0)];
        let rows = [
            row(0, Some(20.0), "pass"),
            row(1, Some(22.0), "fail"),
            row(1000, None, "pass"),
        ];
        let own = own(&rows).unwrap();
        assert_eq!(own.errors, [known, known, [None; 4]]);
        assert_eq!(own.costs, BTreeMap::from([("rdna2".to_owned(), 22.0)]));
        assert_eq!(own.user.fails.as_deref(), Some("one; two"));
        assert!(super::own(&[]).is_none());
    }
}
