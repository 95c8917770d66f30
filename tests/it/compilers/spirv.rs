//! The interfaces that SPIR-V's templates and the manifest promise, read back from the disassembly.

use std::collections::BTreeSet;
use std::fs;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::Judgement;
use super::Tool;
use super::accepted;
use super::files;
use fresnel_gen::generator::emit::Artifact;

const DISASSEMBLER: Tool = Tool {
    command: "spirv-dis",
    package: "spirv-tools",
};

#[test]
fn interfaces_are_as_documented() {
    if !DISASSEMBLER.is_here("the interfaces of spirv") {
        return;
    }
    accepted(&files("spirv"), |file| {
        let text = on_file(&file.bytes, |path| DISASSEMBLER.run(["--no-color", path]))?;
        let (found, promised) = (interface(&text), promise(file));
        if found == promised {
            return Ok(text);
        }
        Err(format!(
            "{}: {found:#} but {promised:#} was promised",
            file.path
        ))
    });
}

fn on_file(bytes: &[u8], judge: impl Fn(&str) -> Judgement) -> Judgement {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.spv");
    fs::write(&path, bytes).unwrap();
    judge(path.to_str().unwrap())
}

/// What the manifest and the template's head say of a module.
fn promise(file: &Artifact) -> Value {
    let detail = json!(file.detail);
    let functions = detail["functions"].as_array().unwrap();
    // The functions of an effect have their arguments in a buffer, and none in a block.
    let block = |f: &Value| f["uniforms"].as_array().cloned().unwrap_or_default();
    let uniforms = block(&functions[0]);
    // Entry points of a module share its block.
    let is_shared = |f: &Value| block(f) == uniforms;
    assert!(functions.iter().all(is_shared), "{}", file.path);
    let (model, mode, variables, mut resources) = if file.path.ends_with(".frag.spv") {
        let variables = json!(["Input Location 0", "Input Location 1", "Output Location 0"]);
        ("Fragment", "OriginUpperLeft", variables, vec![])
    } else {
        let buffers = vec!["StorageBuffer 0 1", "StorageBuffer 0 2"];
        let variables = json!(["Input BuiltIn GlobalInvocationId"]);
        ("GLCompute", "LocalSize 64 1 1", variables, buffers)
    };
    if !uniforms.is_empty() {
        resources.push("Uniform 0 0");
    }
    if functions.iter().any(|f| f["fetches"] != 0) {
        resources.extend(["UniformConstant 0 3", "UniformConstant 0 4"]);
    }
    resources.sort_unstable();
    let entry = |f: &Value| json!([model, f["entry_point"], mode, variables]);
    json!({
        "entries": functions.iter().map(entry).collect::<Vec<_>>(),
        "resources": resources,
        "uniforms": uniforms,
    })
}

/// The same, read from the disassembly.
fn interface(text: &str) -> Value {
    let text = Disassembly::new(text);
    let resources: BTreeSet<String> = text
        .with("OpVariable")
        .filter_map(|line| text.resource(line))
        .collect();
    json!({
        "entries": text.with("OpEntryPoint").map(|line| text.entry(line)).collect::<Vec<_>>(),
        "resources": resources,
        "uniforms": text.uniforms(),
    })
}

/// Instructions as words: the name, then the operands, the result last where there is one.
struct Disassembly<'a>(Vec<Vec<&'a str>>);

impl<'a> Disassembly<'a> {
    fn new(text: &'a str) -> Disassembly<'a> {
        let words = |line: &'a str| match line.split_once(" = ") {
            Some((result, rest)) => rest.split_whitespace().chain([result.trim()]).collect(),
            None => line.split_whitespace().collect(),
        };
        Disassembly(text.lines().map(words).collect())
    }

    fn with(&self, operation: &'a str) -> impl Iterator<Item = &Vec<&'a str>> {
        self.0
            .iter()
            .filter(move |line| line.first() == Some(&operation))
    }

    /// The value of a decoration, as in `OpDecorate %normal Location 0`.
    fn decoration(&self, id: &str, name: &str) -> Option<&'a str> {
        let mut lines = self.with("OpDecorate");
        lines
            .find(|line| line[1] == id && line[2] == name)
            .map(|line| line[3])
    }

    fn variable(&self, id: &str) -> String {
        let variable = self
            .with("OpVariable")
            .find(|line| line.last() == Some(&id));
        let class = variable.unwrap()[2];
        let place = ["Location", "BuiltIn"].into_iter().find_map(|kind| {
            let value = self.decoration(id, kind)?;
            Some(format!("{class} {kind} {value}"))
        });
        place.unwrap()
    }

    fn entry(&self, line: &[&str]) -> Value {
        let mut variables: Vec<_> = line[4..].iter().map(|id| self.variable(id)).collect();
        variables.sort();
        let mode = self.with("OpExecutionMode").find(|mode| mode[1] == line[2]);
        json!([
            line[1],
            line[3].trim_matches('"'),
            mode.unwrap()[2..].join(" "),
            variables
        ])
    }

    /// Storage class, set and binding of a variable that has them.
    fn resource(&self, line: &[&str]) -> Option<String> {
        let id = line.last()?;
        let (set, binding) = (
            self.decoration(id, "DescriptorSet")?,
            self.decoration(id, "Binding")?,
        );
        Some(format!("{} {set} {binding}", line[2]))
    }

    /// Name, type and offset of each member of the uniform block.
    fn uniforms(&self) -> Vec<Value> {
        let block = "%Parameters";
        let members = self.with("OpMemberName").filter(|line| line[1] == block);
        let types = self
            .with("OpTypeStruct")
            .find(|line| line.last() == Some(&block));
        let offset = |index: &str| {
            let mut all = self.with("OpMemberDecorate");
            let found = all.find(|line| line[1..4] == [block, index, "Offset"]);
            found.unwrap()[4].parse::<u64>().unwrap()
        };
        let member = |(line, ty): (&Vec<&str>, &&str)| {
            let ty = if *ty == "%v3float" {
                "vec3"
            } else {
                ty.trim_matches('%')
            };
            json!({ "name": line[3].trim_matches('"'), "type": ty, "offset": offset(line[2]) })
        };
        let types = types.map_or(&[][..], |line| &line[1..line.len() - 1]);
        members.zip(types).map(member).collect()
    }
}
