//! Pictures of several panels that speak for themselves: a heading, a title above each panel, words below it, and a bar of colours with
//! its unit.
//!
//! Panels keep their pixels. The words around them are larger where panels are. The PNG says in its text `Panels` where each panel is,
//! as `left top width height`, so that programs find them too.

use crate::pictures::plot::{
    FOOT, Font, LEGEND, Layout, PANEL, PanelFrame, SHADES, SUBTITLE, TICK, shade,
};
use crate::pictures::png::{encoded_sheet, rasterised};

/// A panel.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What it shows. Empty where the panel above says it.
    pub title: String,
    /// Its pixels in sRGB, row by row.
    pub pixels: Vec<[u8; 3]>,
    /// What is to be read below it; empty for nothing.
    pub words: String,
}

impl Panel {
    /// A panel with a title, its pixels, and what is to be read below it.
    pub fn new(title: &str, pixels: Vec<[u8; 3]>, words: String) -> Panel {
        Panel {
            title: title.to_owned(),
            pixels,
            words,
        }
    }
}

/// Panels side by side.
#[derive(Clone, Debug)]
pub struct PanelRow {
    /// What they have in common; empty for nothing.
    pub name: String,
    /// The panels.
    pub panels: Vec<Panel>,
}

/// The colours of a map, from 0 on.
#[derive(Clone, Debug)]
pub struct ColourBar {
    /// What they mean, with the unit.
    pub title: String,
    /// The value of the brightest colour.
    pub most: f64,
}

impl ColourBar {
    /// The end of a bar that shows values up to this one: 1, 2 or 5 times a power of ten.
    pub fn end_for(value: f64) -> f64 {
        let all = (-6..6).flat_map(|power| [1.0, 2.0, 5.0].map(|one| (one, power)));
        let mut ends = all.map(|(one, power)| {
            // So that .2 is .2 to the last digit.
            if power < 0 {
                one / libm::pow(10.0, f64::from(-power))
            } else {
                one * libm::pow(10.0, f64::from(power))
            }
        });
        ends.find(|end| value <= *end).unwrap_or(value)
    }
}

/// A picture of panels.
#[derive(Clone, Debug)]
pub struct PanelSheet {
    /// The heading.
    pub heading: String,
    /// The lines below the heading.
    pub about: String,
    /// Pixels across and down of each panel.
    pub size: [u32; 2],
    /// The rows of panels.
    pub rows: Vec<PanelRow>,
    /// The bar of colours of panels that are maps.
    pub bar: Option<ColourBar>,
    /// The command that draws it again.
    pub foot: String,
}

/// The panel side at which words have their usual size, in pixels. Words grow with larger panels.
const USUAL_SIDE: f64 = 256.0;
/// The least width of a column in units, so that its title can be read.
const LEAST_COLUMN: f64 = 110.0;
const MARGIN: f64 = 18.0;
const GAP: f64 = 10.0;
/// The least width of a picture in units, so that its heading can be read.
const LEAST_WIDTH: f64 = 420.0;
const BAR: [f64; 2] = [220.0, 12.0];

/// Panels with the pixels of their upper left corners.
type Placed<'a> = Vec<([u32; 2], &'a Panel)>;

impl PanelSheet {
    /// The picture as PNG. `about` is ASCII.
    ///
    /// # Errors
    /// The picture is too large.
    pub fn png(&self, about: String) -> Result<Vec<u8>, String> {
        let least = f64::from(self.size[0].min(self.size[1]));
        let scale = (least / USUAL_SIDE).max(1.0);
        let (svg, placed) = self.laid_out(scale);
        let (mut pixels, [width, height]) = rasterised(&svg, scale as f32)?;
        let [across, down] = self.size.map(|side| side as usize);
        let mut places = Vec::new();
        for ([left, top], panel) in placed {
            for y in 0..down {
                let row = panel.pixels[y * across..][..across].as_flattened();
                let from = 3 * ((top as usize + y) * width as usize + left as usize);
                pixels[from..][..row.len()].copy_from_slice(row);
            }
            places.push(format!("{left} {top} {across} {down}"));
        }
        encoded_sheet(&pixels, [width, height], about, places.join("; "))
    }

    /// The words and lines as SVG, and where the panels go.
    fn laid_out(&self, scale: f64) -> (String, Placed<'_>) {
        let [across, down] = self.size.map(|side| f64::from(side) / scale);
        let column = across.max(LEAST_COLUMN);
        let columns = self.rows.iter().map(|row| row.panels.len()).max();
        let columns = columns.unwrap_or(1) as f64;
        let is_named = self.rows.iter().any(|row| !row.name.is_empty());
        let names = if is_named { LEAST_COLUMN + GAP } else { 0.0 };
        let width = 2.0 * MARGIN + names + columns * (column + GAP) - GAP;
        let mut layout = Layout::new(PanelFrame {
            width: width.max(LEAST_WIDTH).ceil(),
            height: 0.0,
            margin: MARGIN,
            upper: 12.0,
            lower: 10.0,
        });
        layout.paragraph(&PANEL, &self.heading);
        layout.paragraph(&SUBTITLE, &self.about);
        let mut placed = Vec::new();
        for row in &self.rows {
            let lefts: Vec<f64> = (0..row.panels.len())
                .map(|i| MARGIN + names + i as f64 * (column + GAP))
                .collect();
            let each = || row.panels.iter().zip(&lefts);
            let top = layout.bottom + 6.0;
            let titles = each().map(|(panel, left)| (panel.title.as_str(), *left));
            let top = set(&mut layout, &LEGEND, titles.collect(), column, top) + 3.0;
            let pixel = |units: f64| (units * scale).round() as u32;
            placed.extend(each().map(|(panel, left)| ([pixel(*left), pixel(top)], panel)));
            let name = vec![(row.name.as_str(), MARGIN)];
            set(&mut layout, &LEGEND, name, LEAST_COLUMN, top);
            let words = each().map(|(panel, left)| (panel.words.as_str(), *left));
            let bottom = set(
                &mut layout,
                &TICK,
                words.collect(),
                column,
                top + down + 3.0,
            );
            layout.bottom = bottom + 4.0;
        }
        if let Some(bar) = &self.bar {
            draw_bar(&mut layout, bar);
        }
        layout.paragraph(&FOOT, &self.foot);
        (layout.document(&self.heading, &self.about), placed)
    }
}

/// Sets texts at their left edges from `top` on, and returns the lower edge of the longest.
fn set(layout: &mut Layout, font: &Font, texts: Vec<(&str, f64)>, room: f64, top: f64) -> f64 {
    let mut bottom = top;
    for (text, left) in texts {
        let lines = font.wrap(text, room);
        let elements = font.draw(&lines, left, top, "start");
        bottom = bottom.max(top + font.height(&lines));
        layout.extend(elements, bottom);
    }
    bottom
}

/// The bar with its ends and its middle, and its title to the right of it.
fn draw_bar(layout: &mut Layout, bar: &ColourBar) {
    let [width, height] = BAR;
    let top = layout.bottom + 4.0;
    let step = width / SHADES as f64;
    let mut elements: Vec<String> = (0..SHADES)
        .map(|i| {
            let left = MARGIN + i as f64 * step;
            // A little wider than a step, so that no seam shows.
            format!(
                "<rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{:.2}\" height=\"{height}\" fill=\"{}\"/>",
                step + 0.3,
                shade(i)
            )
        })
        .collect();
    let below = top + height + 1.0;
    for (share, anchor) in [(0.0, "start"), (0.5, "middle"), (1.0, "end")] {
        let value = crate::pictures::plot::plain_label(share * bar.most);
        elements.push(TICK.draw_line(&value, MARGIN + share * width, below, anchor));
    }
    let left = MARGIN + width + 14.0;
    let lines = LEGEND.wrap(&bar.title, layout.frame.right() - left);
    elements.extend(LEGEND.draw(&lines, left, top - 3.0, "start"));
    let bottom = (below + TICK.leading).max(top + LEGEND.height(&lines));
    layout.extend(elements, bottom + 2.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_ends_at_a_round_number() {
        for (value, end) in [
            (0.0, 1e-6),
            (0.173, 0.2),
            (0.2, 0.2),
            (1.0, 1.0),
            (11.3, 20.0),
        ] {
            assert_eq!(ColourBar::end_for(value), end, "{value}");
        }
    }

    #[test]
    fn panels_keep_their_pixels_where_the_file_says_they_are() {
        for side in [16_u32, 200, 512] {
            let count = (side * side) as usize;
            let of = |colour| Panel {
                title: "a title of several words that may need more than one line".to_owned(),
                pixels: vec![colour; count],
                words: "mean 1.00".to_owned(),
            };
            let colours = [[255, 0, 0], [0, 200, 0]];
            let sheet = PanelSheet {
                heading: "Heading".to_owned(),
                about: String::new(),
                size: [side; 2],
                rows: vec![PanelRow {
                    name: "gold".to_owned(),
                    panels: colours.map(of).to_vec(),
                }],
                bar: Some(ColourBar {
                    title: "difference, ΔE₀₀".to_owned(),
                    most: 20.0,
                }),
                foot: "fresnel-gen".to_owned(),
            };
            let bytes = sheet.png("about".to_owned()).unwrap();
            let mut reader = png::Decoder::new(std::io::Cursor::new(bytes.as_slice()))
                .read_info()
                .unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let info = reader.next_frame(&mut pixels).unwrap();
            let texts = &reader.info().uncompressed_latin1_text;
            let places = texts.iter().find(|text| text.keyword == "Panels").unwrap();
            let mut held = 0;
            for (place, colour) in places.text.split("; ").zip(colours) {
                let numbers: Vec<usize> = place.split(' ').map(|n| n.parse().unwrap()).collect();
                let [left, top, across, down] = numbers.try_into().unwrap();
                for y in top..top + down {
                    for x in left..left + across {
                        let at = 3 * (y * info.width as usize + x);
                        held += usize::from(pixels[at..at + 3] == colour);
                    }
                }
            }
            assert_eq!(held, 2 * count);
        }
    }
}
