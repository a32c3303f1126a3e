// The page that a run is put into, and the file of it that the program looks for:
//   node run_page.mjs PARTS FOLDER [--budget] writes FOLDER/run-page.template
// It is the page's text with the bytes of the simulator behind it. crates/sim/src/run_page reads it and knows the places in the text.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";

/** The most that the program's file may weigh, compressed. */
const BUDGET = 0.8 * 1000 * 1000;

const here = dirname(fileURLToPath(import.meta.url));
const source = (name) => readFileSync(join(here, name), "utf8");

/** The text of the page, with what it says of its simulator, and the simulator's module; from a folder of parts. */
export function runPage(parts) {
  const [loader, module] = [readFileSync(join(parts, "light.js"), "utf8"), readFileSync(join(parts, "light_bg.wasm"))];
  // a frame without an address, in which a notebook shows the page, is none that another can be relative to; a script's own never is
  const light = loader.replace("new URL(document.currentScript.src, location.href).toString()", "document.currentScript.src");
  if (light === loader) throw new Error("wasm-bindgen's script is not what it was: see here");
  // the simulator itself says which one it is
  const simulator = new Function(`${light}; return wasm_bindgen;`)();
  simulator.initSync({ module });
  const [script, style] = [`${light}\n${source("saved.js")}`, source("saved.css")];
  if (script.includes("</script")) throw new Error("the script would end itself");
  // script and style are fixed, so their hashes are too
  const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
  const values = { simulator: simulator.simulator_print(), script, style, "script-hash": hash(script), "style-hash": hash(style) };
  const text = source("saved.html").replace(/\{\{([\w-]+)\}\}/g, (_, name) => {
    if (!(name in values)) throw new Error(`nothing fills {{${name}}}`);
    return values[name];
  });
  return { text, module };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [, , parts, folder, ...options] = process.argv;
  const { text, module } = runPage(parts);
  const bytes = Buffer.concat([Buffer.from(text), module]);
  mkdirSync(folder, { recursive: true });
  const file = join(folder, "run-page.template");
  writeFileSync(file, bytes);
  console.log(`${file}: ${bytes.length} bytes`);
  if (options.includes("--budget")) {
    const { length } = brotliCompressSync(bytes, {
      params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length },
    });
    console.log(`  ${length} bytes compressed`);
    if (length > BUDGET) {
      console.error(`The template of a run's page weighs ${length} bytes compressed, and at most ${BUDGET} are allowed.`);
      process.exit(1);
    }
  }
}
