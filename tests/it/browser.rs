//! Pages in a real browser without a window: what a script that is put into the page saw there.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;

use crate::cli::Place;
use crate::compilers::Tool;

pub const CHROMIUM: Tool = Tool {
    command: "chromium",
    package: "chromium",
};

/// What each start of the browser takes: no window, no profile of anybody, no talk with hosts.
pub const USUAL: [&str; 7] = [
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--disable-quic",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
];

/// WebGL 2 and WebGPU on the processor.
pub const SOFTWARE: [&str; 6] = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader",
    "--enable-features=Vulkan",
    "--use-vulkan=swiftshader",
];

/// Stands in the page before anything of it runs, and hears what goes wrong.
const EARS: &str = r#"<script>
const faults = [];
addEventListener("error", event => faults.push(event.message));
addEventListener("unhandledrejection", event => faults.push(String(event.reason)));
addEventListener("securitypolicyviolation", event => faults.push("it asks for " + event.blockedURI));
for (const kind of ["error", "warn"]) console[kind] = (...words) => faults.push(words.join(" "));
</script><title>"#;

/// What a script behind the page saw: it leaves JSON in base 64 in an element of the id `told`. `query` stands behind the page's
/// address, `flags` are for what draws.
pub fn told(place: &Place, page: &str, hands: &str, query: &str, flags: &[&str]) -> Value {
    let page = page.replacen("<title>", EARS, 1);
    place.put("tried.html", page.replace("</html>", hands));
    let profile = format!("--user-data-dir={}", place.path("profile").display());
    let page = format!("file://{}{query}", place.path("tried.html").display());
    let last = [profile.as_str(), "--dump-dom", page.as_str()];
    let dom = CHROMIUM.run([&USUAL[..], flags, &last[..]].concat());
    let dom = dom.expect("the page is rendered");
    let told = dom
        .split("<pre id=\"told\">")
        .nth(1)
        .expect("the script came to its end");
    let told = told.split('<').next().unwrap();
    serde_json::from_slice(&BASE64_STANDARD.decode(told).unwrap()).unwrap()
}
