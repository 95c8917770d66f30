//! Where names stand beside points, so that none lies over another or over a point.

/// A rectangle, as its left, top, right and bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area(pub [f64; 4]);

/// A name's place: its left and its middle, and whether it stands so far off that a line leads to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
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

impl Area {
    fn meets(&self, other: &Area) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        a < g && e < c && b < h && f < d
    }

    fn lies_in(&self, other: &Area) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        a >= e && b >= f && c <= g && d <= h
    }
}

/// A place for the name of each of these points, of this width and height, in their order, over none of all points; none where
/// there is no room.
pub fn places(
    points: &[(f64, f64)],
    widths: &[f64],
    height: f64,
    all: &[(f64, f64)],
    page: Area,
) -> Vec<Option<Place>> {
    let dot = |(x, y): &(f64, f64)| Area([x - DOT, y - DOT, x + DOT, y + DOT]);
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

/// Right, left, above and below, then the same further off.
fn candidates((x, y): (f64, f64), width: f64, height: f64) -> impl Iterator<Item = (Area, Place)> {
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
            let half = height / 2.0;
            let area = Area([left, middle - half, left + width, middle + half]);
            let is_led = ring > 0;
            (
                area,
                Place {
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
        let page = Area([0.0, 0.0, 600.0, 400.0]);
        let widths = vec![60.0; points.len()];
        let places = places(&points, &widths, 12.0, &points, page);
        let areas: Vec<Area> = places
            .iter()
            .flatten()
            .map(|place| {
                Area([
                    place.left,
                    place.middle - 6.0,
                    place.left + 60.0,
                    place.middle + 6.0,
                ])
            })
            .collect();
        assert!(areas.len() > 6, "{}", areas.len());
        for (i, one) in areas.iter().enumerate() {
            assert!(one.lies_in(&page));
            assert!(!areas[..i].iter().any(|other| other.meets(one)));
        }
    }

    #[test]
    fn where_there_is_no_room_there_is_no_name() {
        let page = Area([0.0, 0.0, 20.0, 20.0]);
        assert_eq!(
            places(&[(10.0, 10.0)], &[100.0], 12.0, &[(10.0, 10.0)], page),
            [None]
        );
    }
}
