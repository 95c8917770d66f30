// Stands for a bundler: one module with the text of every shader.
const fs = require('fs');
const folder = 'build/shaders/wgsl/materials';
const texts = Object.fromEntries(fs.readdirSync(folder).map(file => [file, fs.readFileSync(`${folder}/${file}`, 'utf8')]));
fs.writeFileSync('build/shaders.js', `export default ${JSON.stringify(texts)};\n`);
