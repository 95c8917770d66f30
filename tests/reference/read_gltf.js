// Validates glTF assets with Khronos's validator, and prints its messages as JSON.
//
//     node read_gltf.js FOLDER_OF_PACKAGES FILE...
const fs = require("fs");
const path = require("path");
const [folder, ...files] = process.argv.slice(2);
const validator = require(path.resolve(folder, "node_modules/gltf-validator"));

const told = {};
const validated = files.map(async (file) => {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: path.basename(file) });
    told[file] = report.issues;
});
Promise.all(validated).then(() => console.log(JSON.stringify(told)));
