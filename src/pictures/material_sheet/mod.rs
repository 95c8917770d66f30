//! The picture of a material, and of several beside each other: one sheet with its index, its reflectance and its colours, as self-contained SVG text.
//!
//! Four panels: n and k against wavelength, reflectance against angle per channel, reflectance against wavelength at a few
//! angles, and swatches. All reflectance is by the exact law. Colours outside [0, 1] are kept, except in the swatches, which show
//! what a screen shows. A comparison of several materials is a sheet of its own, of the same parts.

mod axis;
mod comparison;
mod index;
mod spectrum;
mod swatches;

pub use comparison::{ShownReflectance, comparison_sheet};

use crate::physics::materials::{Material, Surface, ViewingConditions};
use crate::physics::spectra::Gamut;
use crate::pictures::plot::{FOOT, HEADING, Layout, PanelFrame, SUBTITLE, capital};

/// The sheet.
const PICTURE: PanelFrame = PanelFrame {
    width: 1200.0,
    height: 900.0,
    margin: 28.0,
    upper: 22.0,
    lower: 16.0,
};
/// The size of each of the four panels.
const PANEL: PanelFrame = PanelFrame {
    width: 586.0,
    height: 392.0,
    margin: 14.0,
    upper: 12.0,
    lower: 8.0,
};
/// The panels' left edge, which aligns their text with the sheet's.
const LEFT: f64 = PICTURE.margin - PANEL.margin;

/// A material that is drawn, and its viewing conditions.
struct DrawnMaterial<'a> {
    material: &'a Material,
    medium: Option<&'a Material>,
    viewing: ViewingConditions,
    surface: Surface,
}

/// The picture of a material in air or in a medium, as SVG text. `command` makes it again and stands at the foot of the sheet.
///
/// # Errors
/// The material or the medium was not measured at a wavelength of these conditions.
pub fn material_sheet(
    material: &Material,
    medium: Option<&Material>,
    viewing: &ViewingConditions,
    command: &str,
) -> Result<String, String> {
    let viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..viewing.clone()
    };
    let surface = Surface::new(material, medium, &viewing).map_err(|unseen| unseen.to_string())?;
    let drawn = DrawnMaterial {
        material,
        medium,
        viewing,
        surface,
    };
    Ok(drawn.draw(command))
}

impl DrawnMaterial<'_> {
    fn draw(&self, command: &str) -> String {
        let (index, angle) = (index::index_chart(self), spectrum::angle_chart(self));
        let spectrum = spectrum::spectrum_chart(self);
        let (swatches, colours) = swatches::swatch_panel(self, PANEL);
        let mut layout = Layout::new(PICTURE);
        layout.paragraph(&HEADING, &self.title());
        for line in self.sources() {
            layout.paragraph(&SUBTITLE, &line);
        }
        let (index_panel, angle_panel) = (index.panel(PANEL, "index"), angle.panel(PANEL, "angle"));
        layout.side_by_side(LEFT, vec![index_panel, angle_panel]);
        layout.side_by_side(LEFT, vec![spectrum.panel(PANEL, "spectrum"), swatches]);
        for line in [self.seen(), command.to_owned()] {
            layout.paragraph(&FOOT, &line);
        }
        let charts = [&index, &angle, &spectrum].map(|chart| chart.description());
        let mut parts = self.sources();
        parts.extend(charts);
        parts.extend([colours, self.seen()]);
        layout.document(&self.title(), &parts.join(" "))
    }

    fn title(&self) -> String {
        let Material { name, summary, .. } = self.material;
        match self.medium {
            Some(medium) => format!("{name} in {}: {summary}", medium.name),
            None => format!("{name}: {summary}"),
        }
    }

    /// The sources, in lines: who measured the material, where that is published, under which conditions.
    fn sources(&self) -> Vec<String> {
        let material = self.material;
        let labelled = |what: &str, text: &str| match text.trim() {
            "" => String::new(),
            text => format!("{what}: {text}. "),
        };
        let medium = self.medium.map(|medium| {
            let Material { name, summary, .. } = medium;
            let source = medium.source_words(" ").unwrap_or_default();
            format!("Medium: {name}, {summary}. {source}")
                .trim_end()
                .to_owned()
        });
        let licence = material.licence_words();
        let licence = licence.map(|licence| format!(" Licence of the numbers: {licence}."));
        let known = format!(
            "{}{}{}, known {}.{}",
            labelled("Page", &material.page),
            labelled("Conditions", &material.conditions),
            capital(material.class_name()),
            axis::words(material.range_nm()),
            licence.unwrap_or_default()
        );
        let source = material.source_words(" ");
        source.into_iter().chain([known]).chain(medium).collect()
    }

    /// The viewing conditions, in a sentence.
    fn seen(&self) -> String {
        let held = self.surface.extrapolation();
        let held = held.map_or(String::new(), |held| format!(" Extrapolated: {held}."));
        format!("Seen: {}.{held}", self.surface.seen)
    }

    /// The wavelengths of red, green and blue, where material or medium is known only at these.
    fn three_nm(&self) -> Option<[f64; 3]> {
        let medium = self.medium.and_then(|medium| medium.rgb_nm);
        let known = self.material.rgb_nm.or(medium);
        known.map(|rgb| self.viewing.wavelengths_nm.unwrap_or(rgb))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::materials::{DispersionCurve, Extrapolate, MaterialKind, find};

    fn table(points: impl IntoIterator<Item = (f64, f64)>) -> DispersionCurve {
        DispersionCurve::table(points.into_iter().collect()).expect("they ascend")
    }

    /// A yellow metal, known at each of these wavelengths.
    fn brass(nm: impl IntoIterator<Item = u16>) -> Material {
        let nm: Vec<f64> = nm.into_iter().map(f64::from).collect();
        let red = |nm: f64| 1.0 / (1.0 + libm::exp((520.0 - nm) / 15.0));
        let n = |nm: &f64| (*nm, 1.4 - 1.3 * red(*nm));
        let k = |nm: &f64| (*nm, 1.8 + 3.0 * red(*nm));
        Material {
            name: "brass".to_owned(),
            summary: "Brass <polished> & \"bright\"".to_owned(),
            kind: MaterialKind::Metal,
            substance: "brass".to_owned(),
            licence: "CC0-1.0".to_owned(),
            reference: "Ångström & Šimon <1900>".to_owned(),
            link: "https://example.org/?a=1&b=2".to_owned(),
            page: String::new(),
            conditions: "at 300 K".to_owned(),
            note: String::new(),
            rgb_nm: None,
            n: table(nm.iter().map(n)),
            k: Some(table(nm.iter().map(k))),
            films: Vec::new(),
        }
    }

    fn catalogued(name: &str) -> Material {
        find(name).unwrap().unwrap()
    }

    fn drawn(material: &Material, viewing: &ViewingConditions) -> Result<String, String> {
        material_sheet(material, None, viewing, "fresnel-gen materials show it")
    }

    fn hold() -> ViewingConditions {
        ViewingConditions {
            beyond: Extrapolate::Hold,
            ..ViewingConditions::default()
        }
    }

    /// Checks that any viewer can read a sheet: no number is missing, no markup escapes, and equal input gives equal text.
    /// An independent reader draws it too, and there is ink on it.
    #[track_caller]
    fn check(material: &Material, viewing: &ViewingConditions) -> String {
        let svg = drawn(material, viewing).unwrap();
        assert_eq!(Ok(&svg), drawn(material, viewing).as_ref());
        assert!(!svg.contains("NaN"), "{svg}");
        for clip in ["index", "angle", "spectrum"] {
            assert_eq!(svg.matches(&format!("<clipPath id=\"{clip}\">")).count(), 1);
        }
        let png = crate::pictures::png::png(&svg, 0.5).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(png[16..20], 600u32.to_be_bytes(), "the width");
        assert!(png.len() > 10_000, "a blank sheet is smaller");
        svg
    }

    #[test]
    fn a_full_spectrum_has_dots_and_escapes_its_names() {
        let svg = check(
            &brass((380..=780).step_by(10)),
            &ViewingConditions::default(),
        );
        assert!(svg.contains("Brass &lt;polished&gt; &amp; &quot;bright&quot;"));
        assert!(svg.contains("41 measured points"));
        assert!(svg.contains("red clipped"), "yellow is outside sRGB");
        // The legend has one more dot.
        assert_eq!(svg.matches("<circle").count(), 2 * (41 + 1));
    }

    #[test]
    fn three_wavelengths_are_three_dots() {
        for (name, curves) in [
            ("gold_thesis", 2),
            ("platinum_thesis", 2),
            ("water_thesis", 1),
        ] {
            let svg = check(&catalogued(name), &ViewingConditions::default());
            assert!(svg.contains("685, 535 and 475 nm"), "{name}");
            let dots = svg.matches("<circle").count();
            assert_eq!(dots, (curves + 4) * (3 + 1), "{name}");
        }
    }

    #[test]
    fn a_medium_is_named() {
        let (diamond, water) = (catalogued("diamond_thesis"), catalogued("water_thesis"));
        let svg =
            material_sheet(&diamond, Some(&water), &ViewingConditions::default(), "").unwrap();
        assert!(svg.contains("diamond_thesis in water_thesis"));
        assert!(svg.contains("Medium: water_thesis"));
    }

    #[test]
    fn what_was_not_measured_is_refused_or_held() {
        for (nm, words) in [
            (vec![589], "known at 589 nm"),
            (vec![400, 700], "known from 400 to 700 nm"),
            (vec![1000, 2000], "Not measured in visible light."),
        ] {
            let material = brass(nm);
            let why = drawn(&material, &ViewingConditions::default()).unwrap_err();
            assert!(why.contains("--extrapolate hold"), "{why}");
            let svg = check(&material, &hold());
            assert!(svg.contains(words) && svg.contains("is held"), "{words}");
        }
    }

    #[test]
    fn odd_values_are_drawn_or_refused() {
        let mut material = brass((380..=780).step_by(10));
        material.k = None;
        let svg = check(&material, &ViewingConditions::default());
        assert!(svg.contains("k is 0."));
        material.k = Some(table([(500.0, 2.0)]));
        assert!(drawn(&material, &ViewingConditions::default()).is_err());
        check(&material, &hold());
        for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300] {
            material.k = Some(table([(380.0, value), (780.0, value)]));
            assert_eq!(drawn(&material, &hold()).is_ok(), value == 0.0, "{value}");
        }
    }
}
