//! Where names stand beside points, so that none lies over another or over a point.

use crate::pictures::plot::Area;

/// A name's place: its left and its middle, and whether it stands so far off that a line leads to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelPlace {
    /// The left end.
    pub left: f64,
    /// The middle of its height.
    pub middle: f64,
    /// Whether a line leads to it.
    pub is_led: bool,
}

/// Half of a point's width.
pub const DOT: f64 = 4.5;
/// From a point to its name.
const GAP: f64 = 3.0;

/// The area of this width and height around a point.
fn around((x, y): (f64, f64), half_width: f64, half_height: f64) -> Area {
    Area {
        left: x - half_width,
        top: y - half_height,
        right: x + half_width,
        bottom: y + half_height,
    }
}

/// A place for the name of each of these points, of this width and height, in their order, over none of all points; none where
/// there is no room.
pub fn place_names(
    points: &[(f64, f64)],
    widths: &[f64],
    height: f64,
    all: &[(f64, f64)],
    page: Area,
) -> Vec<Option<LabelPlace>> {
    let dot = |point: &(f64, f64)| around(*point, DOT, DOT);
    let mut taken: Vec<Area> = all.iter().map(dot).collect();
    let mut places = Vec::new();
    for (point, width) in points.iter().zip(widths) {
        let free = candidates(*point, *width, height)
            .find(|(area, _)| area.lies_in(&page) && !taken.iter().any(|other| area.meets(other)));
        taken.extend(free.map(|(area, _)| area));
        places.push(free.map(|(_, place)| place));
    }
    places
}

/// The area of a name by its left end and the middle of its height.
fn beside(left: f64, middle: f64, width: f64, height: f64) -> Area {
    around((left + width / 2.0, middle), width / 2.0, height / 2.0)
}

/// Right, left, above and below, then the same further off.
fn candidates(
    (x, y): (f64, f64),
    width: f64,
    height: f64,
) -> impl Iterator<Item = (Area, LabelPlace)> {
    let near = DOT + GAP;
    let sides = [
        (near, 0.0),
        (-near - width, 0.0),
        (-width / 2.0, -near - height / 2.0),
        (-width / 2.0, near + height / 2.0),
        (near, -height),
        (near, height),
        (-near - width, -height),
        (-near - width, height),
    ];
    (0..6).flat_map(move |ring| {
        let further = 1.0 + 0.9 * f64::from(ring);
        sides.into_iter().map(move |(dx, dy)| {
            let shift = f64::from(ring) * height;
            let dx = if dx > 0.0 {
                dx + shift
            } else if dx <= -near - width {
                dx - shift
            } else {
                dx
            };
            let (left, middle) = (x + dx, y + dy * further);
            let area = beside(left, middle, width, height);
            let is_led = ring > 0;
            (
                area,
                LabelPlace {
                    left,
                    middle,
                    is_led,
                },
            )
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lie_over_nothing() {
        let points: Vec<(f64, f64)> = (0..12)
            .map(|i| {
                (
                    200.0 + 6.0 * f64::from(i % 3),
                    100.0 + 5.0 * f64::from(i / 3),
                )
            })
            .collect();
        let page = beside(0.0, 200.0, 600.0, 400.0);
        let widths = vec![60.0; points.len()];
        let places = place_names(&points, &widths, 12.0, &points, page);
        let areas: Vec<Area> = places
            .iter()
            .flatten()
            .map(|place| beside(place.left, place.middle, 60.0, 12.0))
            .collect();
        assert!(areas.len() > 6, "{}", areas.len());
        for (i, one) in areas.iter().enumerate() {
            assert!(one.lies_in(&page));
            assert!(!areas[..i].iter().any(|other| other.meets(one)));
        }
    }

    #[test]
    fn where_there_is_no_room_there_is_no_name() {
        let page = beside(0.0, 10.0, 20.0, 20.0);
        assert_eq!(
            place_names(&[(10.0, 10.0)], &[100.0], 12.0, &[(10.0, 10.0)], page),
            [None]
        );
    }
}
