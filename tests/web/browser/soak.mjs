// The page plays for MINUTES of real time, and the memory of its script and of its WebAssembly is sampled every ten seconds: lines of
// seconds and kibibytes, in OUT/page.script.samples and OUT/page.wasm.samples. The script's memory is what is left after its collector has
// run. Usage: tests/web/browser/check --run tests/web/browser/soak.mjs MINUTES SITE OUT
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { newBrowser } from "./harness.mjs";

const [, , minutes, site, out] = process.argv;
const server = await serve(site, 0);
const browser = await newBrowser();
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const faults = [];
  page.on("pageerror", (error) => faults.push(error.message));
  await page.addInitScript(() => addEventListener("motionlab", ({ detail }) => detail.kind === "state" && (window.latest = detail)));
  await page.goto(`http://localhost:${server.address().port}/`);
  await page.waitForFunction(() => window.latest?.tick > 0, null, { timeout: 300000 });
  const inspector = await page.context().newCDPSession(page);
  const samples = { script: [], wasm: [] };
  const [begun, first] = [performance.now(), await page.evaluate(() => window.latest.tick)];
  while (performance.now() - begun < 60000 * minutes) {
    await new Promise((next) => setTimeout(next, 10000));
    await inspector.send("HeapProfiler.collectGarbage");
    const { usedSize } = await inspector.send("Runtime.getHeapUsage");
    const seconds = ((performance.now() - begun) / 1000).toFixed(1);
    samples.script.push(`${seconds} ${Math.round(usedSize / 1024)}`);
    samples.wasm.push(`${seconds} ${Math.round((await page.evaluate(() => window.motionLab.memory())) / 1024)}`);
    for (const part in samples) writeFileSync(join(out, `page.${part}.samples`), samples[part].join("\n") + "\n");
  }
  const last = await page.evaluate(() => window.latest.tick);
  console.log(`the page played from tick ${first} to ${last} in ${minutes} minutes`);
  if (last === first) throw new Error("it stood still");
  if (faults.length > 0) throw new Error(faults.join("; "));
} finally {
  await browser.close();
  server.close();
  server.closeAllConnections();
}
