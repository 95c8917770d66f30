//! Materials under films: what physics says of their colours, the tables of `docs/films.md`, and `--film` in every command.

use std::fs;
use std::path::Path;

use super::bless;
use super::cli::Place;
use super::fits::films;
use super::physics::films::filmed;
use super::readme::replaced;
use fresnel_gen::generator::emit::{Bounds, of_cosine};
use fresnel_gen::generator::fit::{known_film, model_error, thickness_error, values_for_material};
use fresnel_gen::generator::reference::{Derivation, MaterialInMedium};
use fresnel_gen::lab::chart::{ChartData, ChartView, FunctionOrigin, chart_data};
use fresnel_gen::lab::cost::{CostFigures, FunctionId, records};
use fresnel_gen::lab::verify::cosines;
use fresnel_gen::language::ir::{Value, evaluate};
use fresnel_gen::language::methods::{self, Method};
use fresnel_gen::physics::materials::{
    self, AtWavelength, Extrapolate, Material, Surface, ViewingConditions,
};
use fresnel_gen::physics::num::Precision;
use fresnel_gen::physics::num::statistics::quantile;
use fresnel_gen::physics::optics::cosine;
use fresnel_gen::physics::spectra::{Gamut, Space, Step, xyz_to_lab};
use fresnel_gen::pictures::frontier::chart_svg;
use glam::DVec3;

fn surface(material: &Material, step: Step) -> Surface {
    let mut viewing = ViewingConditions {
        gamut: Gamut::Keep,
        ..ViewingConditions::default()
    };
    viewing.integration.step = step;
    Surface::new(material, None, &viewing).unwrap()
}

fn stack(name: &str) -> Material {
    materials::find(name).unwrap().unwrap()
}

/// R at normal incidence, linear sRGB.
fn f0(material: &Material) -> [f64; 3] {
    surface(material, Step::default())
        .unpolarised(1.0)
        .to_array()
}

/// The hue in degrees of what a material reflects, in CIELAB.
fn hue(material: &Material) -> f64 {
    let to_xyz = Space::Srgb.rgb_to_xyz();
    let white = to_xyz * DVec3::ONE;
    let lab = xyz_to_lab(to_xyz * DVec3::from_array(f0(material)), white);
    lab.b.atan2(lab.a).to_degrees().rem_euclid(360.0)
}

/// Diamanti, Del Curto and Pedeferri 2008: gold, purple, blue as the oxide grows. In CIELAB yellow is about 90 degrees, purple 310
/// and blue 270.
#[test]
fn titanium_turns_gold_then_purple_then_blue() {
    let of = |nm: u32| hue(&filmed(&format!("titanium_dioxide:{nm}nm"), "titanium"));
    for nm in [15, 20, 25] {
        assert!((70.0..100.0).contains(&of(nm)), "{nm}: {}", of(nm));
    }
    assert!((295.0..330.0).contains(&of(40)), "{}", of(40));
    for nm in [50, 55, 60] {
        assert!((240.0..280.0).contains(&of(nm)), "{nm}: {}", of(nm));
    }
    for (name, from, to) in [
        ("gold", 70.0, 100.0),
        ("purple", 295.0, 330.0),
        ("blue", 240.0, 280.0),
    ] {
        let hue = hue(&stack(&format!("anodised_titanium_{name}")));
        assert!((from..to).contains(&hue), "{name}: {hue}");
    }
}

/// Pliskin and Conrad 1964: 300 nm of oxide on silicon are blue to violet-blue.
#[test]
fn silicon_is_blue_under_its_oxide() {
    let hue = hue(&stack("silica_on_silicon"));
    assert!((265.0..305.0).contains(&hue), "{hue}");
}

#[test]
fn soap_turns_black_before_it_bursts() {
    let black = f0(&stack("soap_black"));
    assert!(black.iter().all(|r| *r < 0.01), "{black:?}");
    let thicker = f0(&stack("soap"));
    assert!(thicker.iter().any(|r| *r > 0.05), "{thicker:?}");
    // R falls as the square of the thickness.
    let at = |nm: f64| f0(&filmed(&format!("water:{nm}nm"), "air"))[1];
    assert!((at(2.0) / at(1.0) - 4.0).abs() < 0.01);
}

#[test]
fn a_quarter_wave_takes_reflections_away_and_many_make_a_mirror() {
    let (bare, coated) = (f0(&stack("bk7")), f0(&stack("magnesium_fluoride_on_glass")));
    assert!(coated[1] < 0.35 * bare[1], "{coated:?} {bare:?}");
    let mirror = f0(&stack("cold_mirror"));
    assert!(mirror.iter().all(|r| *r > 0.9), "{mirror:?}");
    // The least is where the thickness is a quarter of the wave in the film.
    let film = filmed("1.2329:111.5nm", "1.52");
    let surface = surface(&film, Step::default());
    let spectrum = surface.unpolarised_spectrum(1.0);
    let least = (0..spectrum.len()).min_by(|a, b| spectrum[*a].total_cmp(&spectrum[*b]));
    let nm = surface.integrator.wavelengths[least.unwrap()];
    assert!((nm - 4.0 * 1.2329 * 111.5).abs() <= 5.0, "{nm}");
}

#[test]
fn fringes_move_to_shorter_waves_with_the_angle() {
    let surface = surface(&filmed("1.2329:111.5nm", "1.52"), Step::default());
    let mut last = f64::INFINITY;
    for degrees in [0.0, 20.0, 30.0, 40.0] {
        let both = surface.unpolarised_spectrum(cosine(degrees));
        let least = (0..both.len())
            .min_by(|a, b| both[*a].total_cmp(&both[*b]))
            .unwrap();
        let nm = surface.integrator.wavelengths[least];
        assert!(nm < last, "{degrees}: {nm} nm");
        last = nm;
    }
}

#[test]
fn no_film_reflects_more_than_all() {
    for subject in films("sample").iter().chain(&films("outside")) {
        for degrees in [0.0, 30.0, 60.0, 85.0, 90.0] {
            let spectrum = subject
                .reference
                .surface
                .unpolarised_spectrum(cosine(degrees));
            assert!(
                spectrum.iter().all(|r| (0.0..=1.0).contains(r)),
                "{}",
                subject.name
            );
        }
    }
}

/// Steps of 1 nm follow the fringes of the thickest films that are allowed: beside the mean of eleven samples in each nanometre.
#[test]
fn wavelengths_are_close_enough_for_fringes() {
    for (film, base, bound) in [
        ("1.5:3000nm", "gold", 3e-3),
        ("diamond:2400nm", "air", 3e-3),
        ("titanium_dioxide:2000nm", "titanium", 3e-3),
        ("1.5:600nm", "gold", 3e-4),
    ] {
        let material = filmed(film, base);
        let own = surface(&material, Step::Nm5);
        assert_eq!(own.indices.len(), 401, "{film}");
        assert!(own.seen.contains("steps of 1 nm"), "{}", own.seen);
        for degrees in (0..90).step_by(3).chain([89]) {
            let c = cosine(f64::from(degrees));
            let mean = |nm: &f64| {
                let part = |i: i32| (nm + 0.1 * f64::from(i)).clamp(380.0, 780.0);
                let law = |i| {
                    let at = AtWavelength::new(&material, None, part(i), Extrapolate::Refuse);
                    at.unwrap().reflectance(c).unpolarised()
                };
                (-5..=5).map(law).sum::<f64>() / 11.0
            };
            let fine: Vec<f64> = own.integrator.wavelengths.iter().map(mean).collect();
            let apart = own.integrator.colour(&fine) - own.unpolarised(c);
            assert!(
                apart.abs().max_element() < bound,
                "{film} {degrees}: {apart}"
            );
        }
    }
    assert_eq!(
        surface(&filmed("1.5:0nm", "gold"), Step::Nm5).indices.len(),
        81
    );
}

#[test]
fn a_film_of_no_thickness_changes_no_bit() {
    let (bare, none) = (stack("gold"), filmed("1.38:0nm", "gold"));
    let [bare, none] = [bare, none].map(|material| surface(&material, Step::default()));
    for degrees in [0.0, 45.0, 89.0, 90.0] {
        let c = cosine(degrees);
        assert_eq!(bare.unpolarised(c), none.unpolarised(c));
    }
}

/// Air on both sides of nothing reflects nothing, also by methods of a few wavelengths, and their functions can be written.
#[test]
fn a_free_film_of_no_thickness_reflects_nothing() {
    let place = Place::new();
    for name in ["film_spectral_three", "film_spectral_six"] {
        let method = methods::find(name).unwrap();
        let viewing = ViewingConditions::default();
        let typed = ("air".to_owned(), filmed("water:0nm", "air"));
        let none = MaterialInMedium::new(typed, None, &viewing, Derivation::default()).unwrap();
        let function = of_cosine(method, &none, Precision::F32, &Bounds::default()).unwrap();
        for c in [1.0, 0.5, 0.1, 0.01] {
            let r = evaluate::<f64>(&function, &[Value::scalar(c)]).at(0);
            assert!(r.iter().all(|r| r.abs() < 1e-6), "{name} {c}: {r:?}");
        }
        place.done(&format!(
            "--material air --film water:0nm --method {name} --target gles -o -"
        ));
    }
}

/// Methods of films promise an absolute error of single precision, over films of up to 1000 nm: a phase of 30 is not known better.
/// It is neither exceeded nor slack.
#[test]
fn code_errors_of_films_are_what_methods_promise() {
    let all = [films("sample"), films("outside")].concat();
    let mut faults = Vec::new();
    for method in methods::ALL {
        let promised = method.claims.code_abs;
        if !method.class.is_of_films() || promised == 0.0 {
            continue;
        }
        let function = method.function(false).unwrap();
        let mut most = 0.0_f64;
        for subject in all.iter().filter(|subject| subject.is_described_by(method)) {
            let mut values = values_for_material(subject, method);
            for nm in (0..=1000).step_by(25) {
                values.insert("thickness_nm".to_owned(), [f64::from(nm); 3]);
                for value in values.values_mut().flatten() {
                    *value = f64::from(*value as f32);
                }
                let mut at = cosines(400);
                at.retain(|c| *c >= 0.05);
                let numbers = |c: &f32| f64::from(*c);
                let wide = [Value::each(at.iter().map(numbers).collect())].into_iter();
                let wide: Vec<Value<f64>> = wide.chain(method.arguments(&values, None)).collect();
                let narrow = [Value::each(at.clone())].into_iter();
                let narrow: Vec<Value<f32>> =
                    narrow.chain(method.arguments(&values, None)).collect();
                let (want, got) = (evaluate(&function, &wide), evaluate(&function, &narrow));
                for point in 0..at.len() {
                    let (want, got) = (want.at(point), got.at(point));
                    for (want, got) in want.into_iter().zip(got) {
                        most = most.max((want - f64::from(got)).abs());
                    }
                }
            }
        }
        if !(0.4 * promised..=promised).contains(&most) {
            let name = method.name;
            faults.push(format!(
                "{name}: measured {most:e}, `code_abs` is {promised:e}"
            ));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The methods of the first table, with the words for their inputs.
const SHOWN: [(&str, bool, &str); 14] = [
    (
        "iridescence_khr",
        false,
        "KHR_materials_iridescence, as in three.js",
    ),
    (
        "airy_materialx",
        false,
        "Airy's series with n and k, as in MaterialX",
    ),
    ("schlick", false, "Schlick's, of the film's F0"),
    ("schlick", true, "the same with its best F0"),
    ("f82_tint", false, "`f82_tint`, of the film's F0 and F82"),
    (
        "conductor_exact",
        false,
        "the exact law of one index a channel",
    ),
    (
        "belcour_decomposition",
        true,
        "`belcour_decomposition`, its best inputs",
    ),
    ("fitted", false, "`fitted`"),
    ("fitted_five", false, "`fitted_five`"),
    ("fitted_film", false, "**`fitted_film`**"),
    ("fitted_film_eight", false, "**`fitted_film_eight`**"),
    ("table", false, "`table`, one fetch"),
    (
        "film_spectral_three",
        false,
        "**`film_spectral_three`**, thickness at run time",
    ),
    (
        "film_spectral_six",
        false,
        "**`film_spectral_six`**, thickness at run time",
    ),
];

/// What is asked of functions on the films of the sample: median, 90th percentile and worst.
const GOALS: [(&str, [f64; 3]); 4] = [
    ("fitted_film", [0.0015, 0.015, 0.04]),
    ("fitted_film_eight", [0.001, 0.01, 0.03]),
    ("film_spectral_three", [0.023, 0.1, 0.3]),
    ("film_spectral_six", [0.0096, 0.04, 0.1]),
];

/// The errors of an entry for each film that its method describes, by the sets of single materials.
fn errors_of_films(data: &ChartData, subjects: &[MaterialInMedium], entry: usize) -> Vec<f64> {
    let of = |subject: &MaterialInMedium| {
        let mut sets = data.sets.iter();
        let own = sets.find(|set| set.count == 1 && set.name == subject.label());
        own.unwrap().errors[entry].max_abs
    };
    subjects.iter().filter_map(of).collect()
}

/// What a function costs on RDNA 2. Methods that keep the thickness as an argument: as a function of anodised titanium, and with
/// all numbers as arguments.
fn cost(method: &'static Method) -> String {
    let record = records("rdna2");
    let shown = |figures: Option<CostFigures>| {
        figures.map_or("not recorded".to_owned(), |figures| {
            figures.cost().to_string()
        })
    };
    let library = shown(record.library(method));
    if !method.keeps_inputs() {
        return library;
    }
    let viewing = ViewingConditions::default();
    let name = "anodised_titanium_purple";
    let typed = (name.to_owned(), stack(name));
    let subject = MaterialInMedium::new(typed, None, &viewing, Derivation::default()).unwrap();
    let id = FunctionId::specialised(method, &subject, Precision::F32);
    format!(
        "{}; {library} with all numbers as arguments",
        shown(record.of(&id))
    )
}

/// The films of the sample and those outside, each with its chart.
fn charted() -> [(Vec<MaterialInMedium>, ChartData); 2] {
    ["sample", "outside"].map(|set| {
        let subjects = films(set);
        let (command, mut quiet) = (String::new(), |_: u64, _: u64, _: &str| ());
        let data = chart_data(&subjects, Space::Srgb, None, command, &mut quiet);
        (subjects, data)
    })
}

/// The largest error of a method over all thicknesses from 0 to that of each film, up to 85 degrees.
fn at_any_thickness(method: &'static Method, subjects: &[MaterialInMedium]) -> Vec<f64> {
    let described = subjects.iter().filter(|one| one.is_described_by(method));
    described
        .map(|one| thickness_error(one, &known_film(one, method.wavelengths)))
        .collect()
}

fn films_table(both: &[(Vec<MaterialInMedium>, ChartData); 2]) -> String {
    let mut table = "| function | cost on RDNA 2 | films | median | 90th percentile | worst | films that had no part in a choice: number, median, 90th |\n\
                     |---|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for (name, is_best, words) in SHOWN {
        let method = methods::find(name).unwrap();
        let [own, outside] = both.each_ref().map(|(subjects, data)| {
            let entry = data.entries.iter().position(|entry| {
                matches!(&entry.function, FunctionOrigin::Method(one) if one.name == name)
                    && entry.is_best == is_best
            });
            errors_of_films(data, subjects, entry.unwrap())
        });
        if let Some((_, most)) = GOALS.iter().find(|(goal, _)| *goal == name) {
            let kept = |(share, most): (f64, &f64)| quantile(&own, share) <= *most;
            let all = [0.5, 0.9, 1.0].into_iter().zip(most).all(kept);
            assert!(all, "{name}: {own:?}");
        }
        table += &films_line(words, &cost(method), &own, &outside);
        if method.keeps_inputs() && method.wavelengths > 0 {
            let all = both
                .each_ref()
                .map(|(subjects, _)| at_any_thickness(method, subjects));
            let words = "the same, at any thickness from 0 to the film's";
            table += &films_line(words, "as above", &all[0], &all[1]);
        }
    }
    table
}

fn films_line(words: &str, cost: &str, own: &[f64], outside: &[f64]) -> String {
    let shown = |errors: &[f64], share| format!("{:.4}", quantile(errors, share));
    format!(
        "| {words} | {cost} | {} | {} | {} | {} | {}, {}, {} |\n",
        own.len(),
        shown(own, 0.5),
        shown(own, 0.9),
        shown(own, 1.0),
        outside.len(),
        shown(outside, 0.5),
        shown(outside, 0.9),
    )
}

/// A stack in the wrong file, or with a material's name, could not be asked for.
#[test]
fn stacks_are_called_as_their_files_and_not_as_materials() {
    for name in materials::stacks() {
        let stack = stack(name);
        assert_eq!(stack.name, *name, "data/films/{name}.toml: its `name`");
        let is_material = materials::names().contains(&name);
        assert!(
            !is_material,
            "data/films/{name}.toml: a material has this name"
        );
        for (field, value) in [
            ("summary", &stack.summary),
            ("link", &stack.link),
            ("licence", &stack.licence),
        ] {
            assert!(
                !value.is_empty(),
                "data/films/{name}.toml: `{field}` is empty"
            );
        }
        let is_sourced = !stack.reference.starts_with(';');
        assert!(is_sourced, "data/films/{name}.toml: `reference` is empty");
        for film in &stack.films {
            assert!(
                film.thickness_nm > 0.0,
                "data/films/{name}.toml: a film of 0 nm"
            );
        }
    }
}

fn stacks_table() -> String {
    let mut table =
        "| name | what it is | films | R at 0 degrees |\n|---|---|---|---|\n".to_owned();
    for name in materials::stacks() {
        let stack = stack(name);
        let films = match stack.films.len() {
            count @ 4.. => format!("{count} layers"),
            _ => stack.films_in_words().unwrap(),
        };
        let f0 = f0(&stack).map(|r| format!("{r:.3}")).join(", ");
        table += &format!("| `{name}` | {} | {films} | {f0} |\n", stack.summary);
    }
    table
}

/// The chart that the page begins with: the median of the films against the cost on RDNA 2.
fn films_chart(data: &ChartData) -> String {
    let set = data.sets.iter().find(|set| set.name == "films-median");
    let cost = data.costs.iter().find(|cost| cost.name == "rdna2");
    let view = ChartView {
        data,
        set: set.unwrap(),
        cost: cost.unwrap(),
        error: 0,
    };
    chart_svg(&view).unwrap()
}

#[test]
fn the_page_says_what_is_measured() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/films.md"));
    let text = fs::read_to_string(path).unwrap();
    let both = charted();
    let chart = path.with_extension("svg");
    bless::check(&chart, films_chart(&both[0].1).as_bytes());
    let text = replaced(&text, "films", &films_table(&both));
    let text = replaced(&text, "stacks", &stacks_table());
    bless::check(path, text.as_bytes());
}

/// Every command that takes a material takes its films.
#[test]
fn commands_take_films() {
    let place = Place::new();
    let on = "--material titanium --film titanium_dioxide:60nm";
    let name = "titanium_film_titanium_dioxide_60nm";
    let shown = place.done(&format!("{on} --target gles -o -")).out;
    assert!(shown.contains(&format!("fresnel_{name}(")), "{shown}");
    assert!(shown.contains(on), "the command repeats it: {shown}");
    place.done(&format!("{on} --target wgsl --quiet"));
    let file = place.read(&format!("shaders-generated/wgsl/materials/{name}.wgsl"));
    for method in ["", "_fitted", "_table"] {
        assert!(
            file.contains(&format!("fn fresnel_{name}{method}(")),
            "{method}"
        );
    }
    for line in [
        format!("fit {on} --json -"),
        format!("chart {on} --json -"),
        format!("stability {on} --method fitted_film --json -"),
        format!("cost {on} --method fitted_film --json -"),
        format!("bake {on} --out-dir tables --json -"),
        "materials params titanium --film titanium_dioxide:60nm --json -".to_owned(),
        "materials params titanium --film titanium_dioxide:60nm --as openpbr".to_owned(),
        "materials show titanium --film titanium_dioxide:60nm --json -".to_owned(),
        format!("--flavour three {on} -o -"),
    ] {
        let ran = place.run(&line);
        let is_done = ran.code == Some(0) || line.starts_with("cost") && ran.code == Some(3);
        assert!(is_done || line.contains("flavour"), "{ran:?}");
    }
    assert!(place.path(&format!("tables/lut/{name}.exr")).is_file());
}

/// A function of a material keeps the thickness, and says its errors.
#[test]
fn a_function_takes_the_thickness() {
    let place = Place::new();
    let on = "--material titanium --film titanium_dioxide:130nm --method film_spectral_three,film_spectral_six";
    let shown = place.done(&format!("{on} --target gles -o -")).out;
    assert_eq!(
        shown.matches("highp float thickness_nm\n").count(),
        2,
        "{shown}"
    );
    assert_eq!(
        shown.matches("up to 85 degrees: at most 0.0").count(),
        2,
        "{shown}"
    );
    place.refused(
        "--material silver --film zinc_sulfide:100nm --method film_spectral_three -o -",
        &["k below 0.05"],
    );
    place.refused(
        "--material cold_mirror --method iridescence_khr -o -",
        &["one film in air only"],
    );
}

/// A sum of a few wavelengths follows the film at every thickness up to the one it was chosen for, and the bare base at none.
#[test]
fn wavelengths_follow_all_thicknesses() {
    let subject = |nm: u32| {
        let material = filmed(&format!("titanium_dioxide:{nm}nm"), "titanium");
        let typed = ("titanium".to_owned(), material);
        MaterialInMedium::new(
            typed,
            None,
            &ViewingConditions::default(),
            Derivation::default(),
        )
        .unwrap()
    };
    for (name, most) in [("film_spectral_three", 0.05), ("film_spectral_six", 0.008)] {
        let method = methods::find(name).unwrap();
        let mut values = values_for_material(&subject(130), method);
        for nm in [0, 20, 45, 75, 110, 130] {
            values.insert("thickness_nm".to_owned(), [f64::from(nm); 3]);
            let function = method.at(&values).unwrap();
            let error = model_error(&function, &subject(nm).reference).max_abs;
            assert!(error < most, "{name} of {nm} nm: {error}");
        }
        // A thousand nanometres more are still a reflectance.
        values.insert("thickness_nm".to_owned(), [3000.0; 3]);
        let function = method.at(&values).unwrap();
        for cosine in cosines(200) {
            let f = evaluate::<f64>(&function, &[Value::scalar(f64::from(cosine))]).at(0);
            assert!(f.iter().all(|f| (0.0..=1.0).contains(f)), "{f:?}");
        }
    }
}

/// One table by cosine and thickness, with the function that reads it.
#[test]
fn a_table_by_thickness_is_baked() {
    let place = Place::new();
    let line = "bake --material titanium --film titanium_dioxide:60nm --film-thickness 0..0.13um --target gles --json -";
    let told: serde_json::Value = serde_json::from_str(&place.done(line).out).unwrap();
    for row in told["rows"].as_array().unwrap() {
        assert!(row["max_abs"].as_f64().unwrap() < 0.002, "{row}");
        assert_eq!(row["film_thickness_nm"], serde_json::json!([0.0, 130.0]));
    }
    let name = "titanium_film_titanium_dioxide_60nm_0_to_130nm";
    let text = place.read(&format!("shaders-generated/lut/gles/{name}.glsl"));
    assert!(text.contains("highp float thickness_nm"), "{text}");
    for (flag, says) in [
        ("0..800", "nm or um"),
        ("800..0nm", "larger than the first"),
        ("0..1m", "nm or um"),
        ("0-800nm", "0..800nm"),
        ("0...130nm", "0..800nm"),
        ("0..130nm --size 16384", "at most 8192"),
    ] {
        place.refused(
            &format!("bake --material soap --film-thickness {flag}"),
            &[says],
        );
    }
    place.refused(
        "bake --material gold --film-thickness 0..300nm",
        &["with a film"],
    );
}

/// Formats that have a film get the film, and say what their model errs by.
#[test]
fn formats_with_a_film_take_it() {
    let place = Place::new();
    let of = |name: &str, format: &str| {
        place
            .done(&format!("materials params {name} --as {format}"))
            .out
    };
    let asset: serde_json::Value =
        serde_json::from_str(&of("anodised_titanium_purple", "gltf")).unwrap();
    let film = &asset["materials"][1]["extensions"]["KHR_materials_iridescence"];
    assert_eq!(film["iridescenceThicknessMaximum"], 39.0, "{asset}");
    assert!((film["iridescenceIor"].as_f64().unwrap() - 2.4358).abs() < 1e-3);
    let glass: serde_json::Value =
        serde_json::from_str(&of("magnesium_fluoride_on_glass", "gltf")).unwrap();
    let extensions = glass["materials"][0]["extensions"].as_object().unwrap();
    assert!(
        extensions.contains_key("KHR_materials_ior")
            && extensions.contains_key("KHR_materials_iridescence")
    );
    let openpbr = of("anodised_titanium_purple", "openpbr");
    assert!(openpbr.contains("thin_film_thickness = 0.039"), "{openpbr}");
    assert!(of("soap", "openpbr").contains("thin_film_ior"));
    // In a medium the index is relative to it, and the thickness counts in its waves.
    let wet = of("anodised_titanium_purple --medium 1.5", "openpbr");
    assert!(wet.contains("thin_film_thickness = 0.0585"), "{wet}");
    assert!(wet.contains("thin_film_ior = 1.6239"), "{wet}");
    let materialx = of("anodised_titanium_purple", "materialx");
    assert!(
        materialx.contains("name=\"thinfilm_thickness\" type=\"float\" value=\"39.0\""),
        "{materialx}"
    );
}

/// A stack with a name of its own, in a file.
#[test]
fn a_stack_of_ones_own_is_a_file() {
    let place = Place::new();
    let text = materials::source("oil_on_water")
        .unwrap()
        .replace("oil_on_water", "my_oil");
    place.put("my_oil.toml", &text);
    let shown = place.done("--material my_oil.toml --target wgsl -o -").out;
    assert!(shown.contains("fn fresnel_my_oil("), "{shown}");
    let more = place
        .done("--material my_oil.toml --film 1.33:20nm --target wgsl -o -")
        .out;
    assert!(
        more.contains("fn fresnel_my_oil_film_index_1_33_20nm("),
        "{more}"
    );
    place.put("my_oil.toml", text.replace("1.47:400nm", "1.47:400"));
    place.refused(
        "--material my_oil.toml -o -",
        &["my_oil.toml:4:", "nm or um"],
    );
    place.put("my_oil.toml", text.replace("\"water\"", "\"soap\""));
    place.refused(
        "--material my_oil.toml -o -",
        &["my_oil.toml:3:", "has films itself"],
    );
    place.put("my_oil.toml", text.replace("\"water\"", "\"watr\""));
    place.refused("--material my_oil.toml -o -", &["my_oil.toml:3:", "water"]);
}

/// An answer or a clear error.
#[test]
fn wrong_films_are_refused() {
    let place = Place::new();
    let refused = |film: &str, says: &[&str]| {
        place.refused_with(&["--material", "gold", "--film", film, "-o", "-"], says);
    };
    refused(
        "1.38",
        &["a material and its thickness", "titanium_dioxide:60nm"],
    );
    refused("1.38:100", &["nm or um"]);
    refused("1.38:-1nm", &["0 to 3000 nm"]);
    refused("1.38:NaNnm", &["0 to 3000 nm"]);
    refused("1.38:1000000um", &["0 to 3000 nm", "--medium"]);
    refused("0.5:10nm", &["from 1 to 10"]);
    refused("titanum_dioxide:10nm", &["titanium_dioxide"]);
    refused("oil_on_water:10nm", &["has films", "one layer"]);
    refused("diamond:3000nm", &["n times thickness", "6000 nm"]);
    // Not known over the spectrum.
    refused("pmma:100nm", &["pmma", "--extrapolate hold"]);
    let hundred = ["--film", "1.38:10nm"].repeat(100);
    let line = [&["--material", "gold", "-o", "-"][..], &hundred].concat();
    place.refused_with(&line, &["a file with a name of its own"]);
    place.refused("--film 1.38:10nm -o -", &["--material"]);
    place.refused(
        "--material gold --medium oil_on_water -o -",
        &["has films", "medium"],
    );
    place.refused("render water --material soap -o x.png", &["under films"]);
    place.refused(
        "--material none --film 1.38:10nm --target gles",
        &["--material none"],
    );
    place.refused("--material soap --effect dispersion -o -", &["bare media"]);
    place.refused(
        "materials params soap --as usd",
        &["dielectric under films", "gltf"],
    );
    place.refused(
        "--material soap --method dielectric_exact -o -",
        &["films lie on this"],
    );
    place.refused(
        "--material soap --precision f16 --method fitted_film -o -",
        &["cancel"],
    );
    for line in [
        "--material gold --film 1.38:0nm --target gles -o -",
        "--material bk7 --film gold:20nm --target gles -o -",
        "--material water --film 1.45:.3um --medium 1.2 --target gles -o -",
    ] {
        place.done(line);
    }
}

/// A report takes no place of a map of the same run, and a page of several materials says whose error it tells.
#[test]
fn maps_of_films_keep_their_places_and_names() {
    let place = Place::new();
    let on = "--material titanium --film titanium_dioxide:60nm --method iridescence_khr";
    let map = "iridescence_khr_thickness_nm_titanium_film_titanium_dioxide_60nm.png";
    place.refused(
        &format!("stability {on} --out-dir maps --json maps/{map}"),
        &["two outputs of this run"],
    );
    place.refused(
        "stability --material gold --out-dir maps",
        &["over the thickness of its film", "--film"],
    );
    place.done("stability --material titanium,gold --film titanium_dioxide:60nm --method iridescence_khr --out-dir maps");
    let page = place.read("maps/index.html");
    assert_eq!(page.matches("<h2 id=\"iridescence_khr\">").count(), 1);
    assert!(
        page.contains("gold_film_titanium_dioxide_60nm, red: "),
        "{page}"
    );
    assert!(
        fs::read(place.path(&format!("maps/{map}")))
            .unwrap()
            .starts_with(b"\x89PNG")
    );
    // A page has no two materials of one name.
    place.put("mine.toml", "name = \"air_film_water_800nm\"\nsummary = \"oil\"\nbase = \"water\"\nfilms = [\"1.47:400nm\"]\nlicence = \"CC0-1.0\"\nreference = \"a test\"\nlink = \"https://example.org\"\n");
    place.refused(
        "gallery --material mine.toml --out-dir g",
        &["air_film_water_800nm", "another name"],
    );
}
