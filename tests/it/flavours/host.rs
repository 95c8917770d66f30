//! Hosts that run in a browser: their packages of npm, pages of proof, and the pages of adapters' READMEs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use image::RgbImage;
use serde_json::Value;

use super::block;
use crate::browser::{self, CHROMIUM};
use crate::cli::{OUT, PROGRAM, Place};
use crate::not_checked;

/// A host in a browser.
pub struct Host {
    /// Its flavour.
    pub flavour: &'static str,
    /// The folder below `target` that its packages were installed in.
    pub folder: &'static str,
    /// Its package of npm.
    pub package: &'static str,
    /// The name that modules import, where an older version was installed under another.
    pub stands_for: Option<&'static str>,
    /// The version that the adapter was made for, as `tests/run` installs it.
    pub version: &'static str,
    /// The page of the proof.
    pub page: &'static str,
    /// The scripts beside it, by name.
    pub scripts: &'static [(&'static str, &'static str)],
    /// What stands in the place of the page's end.
    pub hands: &'static str,
    /// The module that a bundler makes one script of, where the page takes one.
    pub bundled: Option<&'static str>,
    /// The materials of the proof.
    pub materials: &'static str,
}

/// Pages take their modules from files.
const FROM_FILES: &[&str] = &["--allow-file-access-from-files"];

/// What the browser is started with for pages of hosts.
pub fn flags() -> Vec<&'static str> {
    [&browser::SOFTWARE[..], FROM_FILES].concat()
}

/// The packages of npm in a folder below `target`, where this one has this version there, and a browser is here.
#[track_caller]
pub fn packages(what: &str, folder: &str, package: &str, version: &str) -> Option<PathBuf> {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("target");
    let packages = target.join(folder).join("node_modules");
    let manifest = fs::read_to_string(packages.join(package).join("package.json"));
    let manifest: Value = serde_json::from_str(&manifest.unwrap_or_default()).unwrap_or_default();
    if manifest["version"] != version {
        let remark =
            format!("{what}: no {package} {version} in target/{folder}; tests/run installs it");
        assert!(std::env::var_os("CI").is_none(), "not checked: {remark}");
        not_checked(&remark);
        return None;
    }
    CHROMIUM.is_here(what).then_some(packages)
}

/// Whether `tests/run` installs what runs here.
#[track_caller]
pub fn is_installed_by_the_script(package: &str, version: &str) {
    let run = include_str!("../../run");
    assert!(
        run.contains(&format!("{package}@{version}")),
        "{package}@{version}"
    );
}

impl Host {
    #[track_caller]
    fn packages(&self) -> Option<PathBuf> {
        let what = format!("the flavour {} in its host", self.flavour);
        packages(&what, self.folder, self.package, self.version)
    }

    /// What the page of the proof tells; nothing where the host is not here.
    #[track_caller]
    pub fn proof(&self, query: &str) -> Option<Value> {
        let packages = self.packages()?;
        let place = Place::new();
        place.done(&format!(
            "--flavour {} --material {} --out-dir .",
            self.flavour, self.materials
        ));
        for (name, text) in self.scripts {
            place.put(name, text);
        }
        link(&packages, &place.path("node_modules"));
        if let Some(entry) = self.bundled {
            place.put("entry.js", entry);
            for name in ["fresnel.js", "materials.js"] {
                let module = place.read(&format!("{}/{name}", self.flavour));
                place.put(name, module);
            }
            let bundler = packages.join(".bin/esbuild");
            let mut command = Command::new(bundler);
            command.args([
                "entry.js",
                "--bundle",
                "--format=iife",
                "--outfile=bundle.js",
            ]);
            let aliases = self
                .stands_for
                .map(|name| format!("--alias:{name}={}", self.package));
            command
                .args(aliases)
                .args(["--log-level=error", "--external:node:*"])
                .current_dir(place.path("."));
            assert!(command.status().unwrap().success(), "{}", self.flavour);
        }
        let page = match self.stands_for {
            Some(name) => {
                let [usual, own] = [name, self.package].map(|one| format!("/node_modules/{one}/"));
                self.page.replace(&usual, &own)
            }
            None => self.page.to_owned(),
        };
        Some(browser::told(&place, &page, self.hands, query, &flags()))
    }

    /// Follows the README as a newcomer does, and draws its page. Its commands are run by a shell, but for npm, whose packages are there,
    /// and the server, since the browser reads files.
    #[track_caller]
    pub fn readme_page(&self) -> Option<RgbImage> {
        let packages = self.packages()?;
        let place = Place::new();
        place.done(&format!("--flavour {} --material gold", self.flavour));
        let readme = place.read(&format!("{OUT}/{}/README.md", self.flavour));
        let commands = block(&readme, "sh");
        self.is_short_and_pinned(&commands);
        let script = format!(
            "set -e\nnpm() {{ ln -s '{}' node_modules; }}\nnpx() {{ local tool=\"$1\"; shift; \"node_modules/.bin/$tool\" \"$@\"; }}\npython3() {{ :; }}\nfresnel-gen() {{ '{PROGRAM}' \"$@\"; }}\n{commands}\npwd >'{}'\n",
            packages.display(),
            place.path("where").display()
        );
        place.put("script.sh", script);
        fs::create_dir(place.path("try")).unwrap();
        let mut shell = Command::new("bash");
        shell
            .arg(place.path("script.sh"))
            .current_dir(place.path("try"));
        let output = shell.output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {said}", self.flavour);
        let folder = PathBuf::from(place.read("where").trim());
        if readme.contains("```html\n") {
            fs::write(folder.join("index.html"), block(&readme, "html")).unwrap();
        }
        Some(screenshot(&place, &folder))
    }

    /// Commands, texts of files in them left out: fewer than ten, and with the version of the engine that is tried here.
    #[track_caller]
    fn is_short_and_pinned(&self, commands: &str) {
        let (mut count, mut inside) = (0, false);
        for line in commands.lines().filter(|line| !line.starts_with('#')) {
            count += usize::from(!inside);
            inside = (inside || line.contains("<<'END'")) && line != "END";
        }
        assert!(count < 10, "{count} commands: {commands}");
        assert!(commands.contains(&format!("fresnel-gen --flavour {}", self.flavour)));
        let wanted = format!("npm install {}@{}", self.package, self.version);
        assert!(commands.contains(&wanted), "{commands}");
        is_installed_by_the_script(self.package, self.version);
    }
}

/// The page `index.html` of a folder, drawn.
#[track_caller]
pub fn screenshot(place: &Place, folder: &Path) -> RgbImage {
    let picture = place.path("page.png");
    let profile = format!("--user-data-dir={}", place.path("profile").display());
    let screenshot = format!("--screenshot={}", picture.display());
    let page = format!("file://{}", folder.join("index.html").display());
    let own = [
        profile.as_str(),
        screenshot.as_str(),
        "--window-size=400,400",
        "--timeout=20000",
        page.as_str(),
    ];
    let arguments = [&browser::USUAL[..], &flags(), &own].concat();
    CHROMIUM.run(arguments).expect("the page is drawn");
    image::open(&picture).expect("a picture").to_rgb8()
}

/// The packages where modules look for them.
pub fn link(packages: &Path, place: &Path) {
    std::os::unix::fs::symlink(packages, place).unwrap();
}

/// A tenth of the picture and more is of gold, more red than green and more green than blue; the corner is not.
#[track_caller]
pub fn shows_a_gold_sphere(picture: &RgbImage) {
    let is_gold = |pixel: &image::Rgb<u8>| {
        let [r, g, b] = pixel.0;
        r > g && g > b && r >= b.saturating_add(20)
    };
    let (all, gold) = (
        picture.pixels().len(),
        picture.pixels().filter(|pixel| is_gold(pixel)).count(),
    );
    assert!(10 * gold > all, "{gold} of {all} pixels are of gold");
    assert!(
        !is_gold(picture.get_pixel(1, 1)),
        "the corner is of gold too"
    );
}

/// A number of a report.
#[track_caller]
pub fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Each number of an object of numbers is at most this.
#[track_caller]
pub fn at_most(told: &Value, most: f64) {
    let all = told
        .as_object()
        .unwrap_or_else(|| panic!("{told} is no object"));
    assert!(!all.is_empty());
    for (name, value) in all {
        assert!(number(value) <= most, "{name}: {value} is more than {most}");
    }
}
