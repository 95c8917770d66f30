//! Two axes around an area: grid, ticks with their labels, titles.

use crate::pictures::plot::palette::{EDGE, GRID};
use crate::pictures::plot::scale::Scale;
use crate::pictures::plot::text::{AXIS, TICK};

/// From a vertical axis to the labels of its ticks, and a little more than from a horizontal one to its.
pub const TICK_GAP: f64 = 7.0;
/// The length of a tick that stands outside.
const TICK_LENGTH: f64 = 4.0;

/// A rectangle of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Its left edge.
    pub left: f64,
    /// Its upper edge.
    pub top: f64,
    /// Its right edge.
    pub right: f64,
    /// Its lower edge.
    pub bottom: f64,
}

/// A value with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// What stands there.
    pub label: String,
}

/// An area, and where values lie in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The area.
    pub area: Area,
    /// From left to right.
    pub x: Scale,
    /// From the bottom up, or however its ends say.
    pub y: Scale,
}

impl Area {
    /// Whether two areas share a point inside.
    pub fn meets(&self, other: &Area) -> bool {
        let across = self.left < other.right && other.left < self.right;
        across && self.top < other.bottom && other.top < self.bottom
    }

    /// Whether all of it lies in another.
    pub fn lies_in(&self, other: &Area) -> bool {
        let across = self.left >= other.left && self.right <= other.right;
        across && self.top >= other.top && self.bottom <= other.bottom
    }

    /// The middle between left and right.
    pub fn centre(&self) -> f64 {
        f64::midpoint(self.left, self.right)
    }

    /// The middle between top and bottom.
    pub fn middle(&self) -> f64 {
        f64::midpoint(self.top, self.bottom)
    }

    /// Its outline.
    pub fn outline(&self) -> String {
        format!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"none\" stroke=\"{EDGE}\"/>",
            self.left,
            self.top,
            self.right - self.left,
            self.bottom - self.top
        )
    }
}

impl Axes {
    /// Lines across the area at the ticks, and the two axes.
    pub fn grid(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.area;
        let upright = |tick: &Tick| format!("M{:.2} {top:.2}V{bottom:.2}", self.x.at(tick.value));
        let level = |tick: &Tick| format!("M{left:.2} {:.2}H{right:.2}", self.y.at(tick.value));
        let lines: String = x.iter().map(upright).chain(y.iter().map(level)).collect();
        let axes = format!("M{left:.2} {top:.2}V{bottom:.2}H{right:.2}");
        vec![
            format!("<path fill=\"none\" stroke=\"{GRID}\" d=\"{lines}\"/>"),
            format!("<path fill=\"none\" stroke=\"{EDGE}\" d=\"{axes}\"/>"),
        ]
    }

    /// The outline of the area, and a short line outwards at each tick.
    pub fn outer_ticks(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let below = x.iter().map(|tick| {
            let (at, bottom) = (self.x.at(tick.value), self.area.bottom);
            outer_tick(at, bottom, [0.0, TICK_LENGTH])
        });
        let beside = y.iter().map(|tick| {
            let left = self.area.left - TICK_LENGTH;
            outer_tick(left, self.y.at(tick.value), [TICK_LENGTH, 0.0])
        });
        let outline = [self.area.outline()].into_iter();
        outline.chain(below).chain(beside).collect()
    }

    /// Ticks with their labels on the right of the area, as a colour bar has them.
    pub fn right_ticks(&self, ticks: &[Tick]) -> Vec<String> {
        let right = self.area.right;
        let draw = |tick: &Tick| {
            let y = self.y.at(tick.value);
            let line = outer_tick(right, y, [TICK_LENGTH, 0.0]);
            let top = y - TICK.leading / 2.0;
            let label = TICK.draw(
                std::slice::from_ref(&tick.label),
                right + TICK_GAP,
                top,
                "start",
            );
            [line].into_iter().chain(label).collect::<Vec<_>>()
        };
        ticks.iter().flat_map(draw).collect()
    }

    /// The labels of the ticks, below the area and on its left.
    pub fn tick_labels(&self, x: &[Tick], y: &[Tick]) -> Vec<String> {
        let below = x.iter().flat_map(|tick| {
            let top = self.area.bottom + TICK_GAP - 2.0;
            let label = std::slice::from_ref(&tick.label);
            TICK.draw(label, self.x.at(tick.value), top, "middle")
        });
        let beside = y.iter().flat_map(|tick| {
            let top = self.y.at(tick.value) - TICK.leading / 2.0;
            let label = std::slice::from_ref(&tick.label);
            TICK.draw(label, self.area.left - TICK_GAP, top, "end")
        });
        below.chain(beside).collect()
    }

    /// The titles of both axes: one whose text begins so far below the area, one that reads upwards from `left` on.
    pub fn titles(&self, x: &[String], below: f64, y: &[String], left: f64) -> Vec<String> {
        let area = &self.area;
        let mut elements = AXIS.draw(x, area.centre(), area.bottom + below, "middle");
        elements.extend(AXIS.draw_upwards(y, left, area.middle()));
        elements
    }
}

fn outer_tick(x: f64, y: f64, [right, down]: [f64; 2]) -> String {
    format!("<path stroke=\"{EDGE}\" d=\"M{x:.2} {y:.2}l{right} {down}\"/>")
}
