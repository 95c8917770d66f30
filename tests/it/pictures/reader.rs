//! Reads pictures back: what an SVG's labels and lines say, and what colour a pixel has.

use super::PictureFile;
use roxmltree::{Document, Node};

/// Text where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    pub text: String,
    pub x: f64,
    pub y: f64,
    anchor: String,
    size: f64,
}

/// The size of a tick's label, and how far its baseline lies below the tick.
const TICK: f64 = 11.5;
const BASELINE: f64 = 0.35 * TICK;
/// The size of a name in the legend.
const LEGEND: f64 = 12.5;
/// How far a label may stand from its place, in pixels.
pub const NEAR: f64 = 0.6;

/// An axis as its labels tell it.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Place and value of the first and the last label.
    ends: [(f64, f64); 2],
    pub is_logarithmic: bool,
}

impl Scale {
    /// The axis through these labels: values rise along it, evenly or by powers.
    #[track_caller]
    pub fn through(ticks: &[(f64, f64)]) -> Scale {
        assert!(ticks.len() > 2, "an axis with too few labels: {ticks:?}");
        let ends = [ticks[0], ticks[ticks.len() - 1]];
        let all = [false, true].map(|is_logarithmic| Scale {
            ends,
            is_logarithmic,
        });
        let off = |scale: &Scale| {
            let off = ticks
                .iter()
                .map(|(at, value)| (scale.place(*value) - at).abs());
            off.fold(0.0, |most, one| {
                if one > most || one.is_nan() {
                    one
                } else {
                    most
                }
            })
        };
        let scale = all.into_iter().find(|scale| off(scale) < NEAR);
        scale.unwrap_or_else(|| panic!("labels neither even nor by powers: {ticks:?}"))
    }

    fn along(&self, value: f64) -> f64 {
        if self.is_logarithmic {
            value.log10()
        } else {
            value
        }
    }

    pub fn place(&self, value: f64) -> f64 {
        let [(from, low), (to, high)] = self.ends;
        let [low, high] = [low, high].map(|end| self.along(end));
        from + (to - from) * (self.along(value) - low) / (high - low)
    }

    pub fn value(&self, place: f64) -> f64 {
        let [(from, low), (to, high)] = self.ends;
        let [low, high] = [low, high].map(|end| self.along(end));
        let value = low + (high - low) * (place - from) / (to - from);
        if self.is_logarithmic {
            10f64.powf(value)
        } else {
            value
        }
    }

    /// Whether values rise to the right.
    pub fn rises_rightwards(&self) -> bool {
        let [(from, low), (to, high)] = self.ends;
        (to - from) * (high - low) > 0.0
    }
}

/// A number as people write it on axes.
fn number(text: &str) -> Option<f64> {
    text.trim_end_matches(['°', '%'])
        .replace('−', "-")
        .parse()
        .ok()
}

/// The labels along an axis: those that share a place across it, the most of all.
fn ticks(
    words: &[Word],
    anchor: &str,
    across: fn(&Word) -> f64,
    along: fn(&Word) -> f64,
) -> Vec<(f64, f64)> {
    let is_tick = |word: &&Word| word.anchor == anchor && word.size == TICK;
    let all: Vec<(f64, f64, f64)> = words
        .iter()
        .filter(is_tick)
        .filter_map(|word| Some((across(word), along(word), number(&word.text)?)))
        .collect();
    let line = |at: f64| {
        let mut line: Vec<(f64, f64)> = all
            .iter()
            .filter(|(other, _, _)| *other == at)
            .map(|(_, along, value)| (*along, *value))
            .collect();
        line.sort_by(|a, b| a.0.total_cmp(&b.0));
        line.dedup();
        line
    };
    let lines = all.iter().map(|(at, _, _)| line(*at));
    lines.max_by_key(Vec::len).unwrap_or_default()
}

/// The axis below a plot.
#[track_caller]
pub fn across(words: &[Word]) -> Scale {
    Scale::through(&ticks(words, "middle", |word| word.y, |word| word.x))
}

/// The axis at the left of a plot.
#[track_caller]
pub fn upwards(words: &[Word]) -> Scale {
    Scale::through(&ticks(
        words,
        "end",
        |word| word.x,
        |word| word.y - BASELINE,
    ))
}

/// The axis at the right of a colour bar.
#[track_caller]
pub fn beside(words: &[Word]) -> Scale {
    Scale::through(&ticks(
        words,
        "start",
        |word| word.x,
        |word| word.y - BASELINE,
    ))
}

/// The words that stand level, once each: what a picture says twice for a halo is said once.
pub fn words(node: Node) -> Vec<Word> {
    let mut all: Vec<Word> = Vec::new();
    for text in node.descendants().filter(|node| node.has_tag_name("text")) {
        if let Some(word) = word(text)
            && !all.contains(&word)
        {
            all.push(word);
        }
    }
    all
}

fn word(text: Node) -> Option<Word> {
    Some(Word {
        text: text.text()?.to_owned(),
        x: attribute(text, "x")?,
        y: attribute(text, "y")?,
        anchor: text.attribute("text-anchor")?.to_owned(),
        size: attribute(text, "font-size")?,
    })
}

pub fn attribute(node: Node, name: &str) -> Option<f64> {
    node.attribute(name)?.parse().ok()
}

/// The numbers of a path that is written with absolute places.
pub fn numbers(path: &str) -> Vec<f64> {
    path.split(|c: char| c.is_ascii_alphabetic() || c == ' ')
        .filter_map(|part| part.parse().ok())
        .collect()
}

/// A plot of curves.
pub struct Plot {
    pub title: String,
    pub x: Scale,
    pub y: Scale,
    /// The curves by their names in the legend, in what the axes say.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
    /// The guide lines by their labels, where they point on the axis.
    pub guides: Vec<(String, f64)>,
    /// The colours of the curves, and where they lie on the sheet.
    pub drawn: Vec<(String, Vec<(f64, f64)>)>,
    /// Where the plot's own sheet lies on the whole.
    pub corner: (f64, f64),
}

/// The plots of a sheet: of its panels where it has some.
pub fn plots(document: &Document) -> Vec<Plot> {
    let panels: Vec<Node> = panels(document);
    if panels.is_empty() {
        return vec![plot(document.root_element())];
    }
    let has_curves = |panel: &Node| {
        panel
            .descendants()
            .any(|node| node.attribute("clip-path").is_some())
    };
    panels.into_iter().filter(has_curves).map(plot).collect()
}

/// The panels of a sheet.
pub fn panels<'a>(document: &'a Document) -> Vec<Node<'a, 'a>> {
    let root = document.root_element();
    let is_panel = |node: &Node| node.attribute("transform").is_some() && node.has_tag_name("g");
    root.children().filter(is_panel).collect()
}

/// Where a panel's corner lies.
pub fn corner(panel: Node) -> (f64, f64) {
    let place = panel.attribute("transform").unwrap_or_default();
    let inside = place.trim_start_matches("translate(").trim_end_matches(')');
    let [x, y] = numbers(inside)[..] else {
        return (0.0, 0.0);
    };
    (x, y)
}

fn plot(panel: Node) -> Plot {
    let words = words(panel);
    let (x, y) = (across(&words), upwards(&words));
    let names = legend(panel);
    let mut curves = Vec::new();
    let mut drawn = Vec::new();
    let clipped = panel
        .descendants()
        .filter(|node| node.attribute("clip-path").is_some());
    for path in clipped
        .flat_map(|group| group.children())
        .filter(Node::is_element)
    {
        let look = look(path);
        let name = names.iter().find(|(of, _)| *of == look);
        let (_, name) =
            name.unwrap_or_else(|| panic!("a curve that the legend does not name: {look:?}"));
        let places = numbers(path.attribute("d").unwrap());
        let places: Vec<(f64, f64)> = places.chunks(2).map(|at| (at[0], at[1])).collect();
        let read = places.iter().map(|at| (x.value(at.0), y.value(at.1)));
        curves.push((name.clone(), read.collect()));
        drawn.push((look[0].clone(), places));
    }
    Plot {
        title: words[0].text.clone(),
        guides: guides(panel, &x),
        x,
        y,
        curves,
        drawn,
        corner: corner(panel),
    }
}

/// What tells a curve from others.
fn look(path: Node) -> [String; 3] {
    ["stroke", "stroke-dasharray", "stroke-width"]
        .map(|name| path.attribute(name).unwrap_or_default().to_owned())
}

/// Each sample of a line that a name stands behind.
fn legend(panel: Node) -> Vec<([String; 3], String)> {
    let mut named = Vec::new();
    let mut sample = None;
    for node in panel.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "path" => sample = Some(look(node)),
            "text" if attribute(node, "font-size") == Some(LEGEND) => {
                if let (Some(sample), Some(text)) = (sample.take(), node.text()) {
                    named.push((sample, text.to_owned()));
                }
            }
            "circle" => {}
            _ => sample = None,
        }
    }
    named
}

/// Each guide line with the label before whose text it is drawn.
fn guides(panel: Node, x: &Scale) -> Vec<(String, f64)> {
    let mut found: Vec<(String, f64)> = Vec::new();
    let mut at = None;
    for node in panel.children().filter(Node::is_element) {
        if node.attribute("stroke") == Some("#8b95a3") {
            // M centre, top L place, top V bottom.
            at = numbers(node.attribute("d").unwrap()).get(2).copied();
        } else if let (Some(place), Some(text)) = (at.take(), node.text())
            && node.has_tag_name("text")
        {
            found.push((text.to_owned(), x.value(place)));
        }
    }
    found
}

impl Plot {
    #[track_caller]
    pub fn curve(&self, name: &str) -> &[(f64, f64)] {
        let found = self.curves.iter().find(|(of, _)| of.starts_with(name));
        &found
            .unwrap_or_else(|| panic!("no curve {name} in {:?}", self.title))
            .1
    }

    /// What a curve says at a place on the axis.
    #[track_caller]
    pub fn at(&self, name: &str, x: f64) -> f64 {
        let points = self.curve(name);
        let next = points.iter().position(|point| point.0 >= x - 1e-3);
        let next = next.unwrap_or_else(|| panic!("{name} ends before {x}"));
        let (b, a) = (points[next], points[next.saturating_sub(1)]);
        if b.0 - a.0 < 1e-9 {
            return b.1;
        }
        a.1 + (b.1 - a.1) * ((x - a.0) / (b.0 - a.0)).clamp(0.0, 1.0)
    }

    /// Where a curve is lowest.
    #[track_caller]
    pub fn lowest(&self, name: &str) -> (f64, f64) {
        let points = self.curve(name).iter().copied();
        points.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }
}

/// The pixels of a PNG that the program draws.
pub struct Pixels {
    pub width: usize,
    pub height: usize,
    samples: Vec<u8>,
}

impl Pixels {
    pub fn new(bytes: &[u8]) -> Pixels {
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut samples = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut samples).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Pixels {
            width: info.width as usize,
            height: info.height as usize,
            samples,
        }
    }

    /// The colour at a place.
    #[track_caller]
    pub fn at(&self, x: f64, y: f64) -> [u8; 3] {
        let first = 3 * (y as usize * self.width + x as usize);
        self.samples[first..first + 3].try_into().unwrap()
    }
}

/// From left, to right, from top and to bottom of a panel, in 256ths.
pub type Part = [usize; 4];

/// The panels of a picture, in the order in which its text `Panels` lists them.
pub struct Panels {
    pixels: Pixels,
    /// Left, top, width and height of each.
    places: Vec<[usize; 4]>,
}

impl Panels {
    pub(super) fn new(shown: &PictureFile) -> Panels {
        let bytes = shown.bytes();
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes.as_slice()));
        let reader = decoder.read_info().unwrap();
        let texts = &reader.info().uncompressed_latin1_text;
        let text = texts.iter().find(|text| text.keyword == "Panels");
        let text = &text.expect("the picture says where its panels are").text;
        let place = |place: &str| {
            let numbers: Vec<usize> = place.split(' ').map(|n| n.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        };
        Panels {
            pixels: Pixels::new(&bytes),
            places: text.split("; ").map(place).collect(),
        }
    }

    pub fn colours(&self, panel: usize, [left, right, top, bottom]: Part) -> Vec<[f64; 3]> {
        let [x0, y0, width, height] = self.places[panel];
        let rows = top * height / 256..bottom * height / 256;
        let colours = rows.flat_map(|y| {
            let columns = left * width / 256..right * width / 256;
            columns.map(move |x| {
                let (x, y) = ((x0 + x) as f64, (y0 + y) as f64);
                self.pixels.at(x, y).map(f64::from)
            })
        });
        colours.collect()
    }

    pub fn mean(&self, panel: usize, part: Part) -> [f64; 3] {
        let colours = self.colours(panel, part);
        [0, 1, 2]
            .map(|i| colours.iter().map(|colour| colour[i]).sum::<f64>() / colours.len() as f64)
    }

    pub fn blueness(&self, panel: usize, part: Part) -> f64 {
        let [red, _, blue] = self.mean(panel, part);
        blue - red
    }

    /// The mean distance of the largest channel from the smallest.
    pub fn chroma(&self, panel: usize, part: Part) -> f64 {
        let colours = self.colours(panel, part);
        let spread =
            |[red, green, blue]: &[f64; 3]| red.max(*green).max(*blue) - red.min(*green).min(*blue);
        colours.iter().map(spread).sum::<f64>() / colours.len() as f64
    }

    pub fn brightest(&self, panel: usize) -> f64 {
        let all = self.colours(panel, [0, 256, 0, 256]);
        all.iter().map(|colour| colour[1]).fold(0.0, f64::max)
    }
}

/// A colour as SVG writes it.
pub fn colour(text: &str) -> [u8; 3] {
    [1, 3, 5].map(|at| u8::from_str_radix(&text[at..at + 2], 16).unwrap())
}
