// Prints how long the page takes to load, in a browser's profile of its own: the first visit, then visits of the same reader. Medians of
// N readers. Usage: tests/web/browser/check --run tests/web/browser/load.mjs [N, 3 by default] [a site's folder]
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { ARGS, chromium, target } from "./harness.mjs";

const readers = Number(process.argv[2] ?? 3);
const server = await serve(process.argv[3] ?? join(target, "web"), 0);
const visits = ["first", "second", "third"];
const found = visits.map(() => []);
for (let reader = 0; reader < readers; reader++) {
  const profile = mkdtempSync(join(tmpdir(), "motion-lab-load-"));
  for (const visit of found) {
    // a browser that has just started, as a reader's who comes back
    const context = await chromium.launchPersistentContext(profile, { executablePath: process.env.MOTION_LAB_CHROMIUM, args: ARGS, viewport: { width: 1280, height: 800 } });
    const page = await context.newPage();
    await page.addInitScript(() => {
      window.first = {};
      addEventListener("motionlab", ({ detail }) => {
        if (detail.kind === "ready") window.first.canvas = performance.now();
        if (detail.kind === "state" && detail.tick > 0) window.first.tick ??= performance.now();
      });
    });
    await page.goto(`http://localhost:${server.address().port}/`);
    await page.waitForFunction(() => window.first.tick, null, { timeout: 120000 });
    visit.push(
      await page.evaluate(() => {
        const loads = performance.getEntriesByType("resource");
        const picture = performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? NaN;
        return { picture, ...window.first, bytes: loads.reduce((sum, load) => sum + load.transferSize, 0) };
      }),
    );
    // what the browser keeps of compiled code it writes after a while
    await page.waitForTimeout(4000);
    await context.close();
  }
  rmSync(profile, { recursive: true, force: true });
}
const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
console.log("| visit | first picture | canvas | first tick | loaded |\n|---|---|---|---|---|");
for (const [i, visit] of found.entries()) {
  const seconds = (name) => `${(median(visit.map((load) => load[name])) / 1000).toFixed(2)} s`;
  console.log(`| ${visits[i]} | ${seconds("picture")} | ${seconds("canvas")} | ${seconds("tick")} | ${(median(visit.map((load) => load.bytes)) / 1e6).toFixed(2)} MB |`);
}
server.close();
server.closeAllConnections();
