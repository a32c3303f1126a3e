// Prints the lines of the runs whose parts come on standard input, as `determinism digests` does natively, from the site's simulator in
// FOLDER under Node. With `ticks` the digest of each tick. Usage: node node.cjs FOLDER [ticks]
const { readFileSync } = require("node:fs");
const { join } = require("node:path");
const { lines } = require("./lines.cjs");

const [, , folder, ticks] = process.argv;
const script = readFileSync(join(folder, "light.js"), "utf8");
const lab = new Function(`${script}; return wasm_bindgen;`)();
lab.initSync({ module: readFileSync(join(folder, "light_bg.wasm")) });
for (const run of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const [name, parts] = run.split("\t");
  console.log(lines(name, lab.tick_digests(parts), ticks));
}
