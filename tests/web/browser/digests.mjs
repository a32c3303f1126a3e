// Prints the lines of the runs whose parts come on standard input, as `determinism digests` does natively, from the site's simulator in
// FOLDER in Chromium. With `ticks` the digest of each tick. Usage: tests/web/browser/check --run tests/web/browser/digests.mjs FOLDER [ticks]
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { newBrowser } from "./harness.mjs";
import { lines } from "../../determinism/lines.cjs";

const [, , folder, ticks] = process.argv;
const browser = await newBrowser();
try {
  const page = await browser.newPage();
  // no element holds the script: it would look for its own address, and this page has none
  await page.evaluate(`${readFileSync(join(folder, "light.js"), "utf8")}; window.lab = wasm_bindgen; null`);
  await page.evaluate(async (wasm) => {
    const bytes = Uint8Array.from(atob(wasm), (c) => c.charCodeAt(0));
    await window.lab({ module_or_path: bytes });
  }, readFileSync(join(folder, "light_bg.wasm")).toString("base64"));
  for (const run of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
    const [name, parts] = run.split("\t");
    console.log(lines(name, await page.evaluate((parts) => window.lab.tick_digests(parts), parts), ticks));
  }
} finally {
  await browser.close();
}
