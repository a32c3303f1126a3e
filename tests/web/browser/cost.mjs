// Prints what the book takes once six of its figures were asked for: contexts of WebGL, memory above a blank page, and
// the longest tasks while the page is scrolled from end to end and back. Usage:
// tests/web/browser/check --run tests/web/browser/cost.mjs [a site's folder]
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { ARGS, chromium, target } from "./harness.mjs";

const FIGURES = ["three", "torus", "witness", "swept", "worlds", "annulus"];
const server = await serve(process.argv[2] ?? join(target, "web"), 0);
const browser = await chromium.launch({ executablePath: process.env.MOTION_LAB_CHROMIUM, args: ARGS });
const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
const session = await browser.newBrowserCDPSession();

/** Megabytes of the browser's processes by kind: what is theirs alone or shared by them, without what lies in files. */
async function memory() {
  await (await page.context().newCDPSession(page)).send("HeapProfiler.collectGarbage");
  await page.waitForTimeout(2000);
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const found = { all: 0 };
  for (const { id, type } of processInfo) {
    const parts = readFileSync(`/proc/${id}/smaps_rollup`, "utf8").matchAll(/^(?:Pss_Anon|Pss_Shmem|SwapPss): +(\d+)/gm);
    const kilobytes = [...parts].reduce((sum, [, part]) => sum + Number(part), 0);
    for (const kind of [type, "all"]) found[kind] = (found[kind] ?? 0) + kilobytes / 1000;
  }
  return found;
}
const above = (now, before) => Object.keys(now).map((kind) => `${kind} ${(now[kind] - (before[kind] ?? 0)).toFixed(0)} MB`).join(", ");

await page.goto("about:blank");
const blank = await memory();
await page.addInitScript(() => {
  const get = HTMLCanvasElement.prototype.getContext;
  const contexts = (window.contexts = new Set());
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = get.call(this, kind, ...rest);
    if (context && kind.startsWith("webgl")) contexts.add(context);
    return context;
  };
  window.tasks = [];
  if (parent === window) new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map(({ startTime, duration }) => ({ startTime, duration })))).observe({ type: "longtask" });
});
await page.goto(`http://localhost:${server.address().port}/book.html`, { waitUntil: "networkidle" });
console.log(`the book before a figure is touched, above a blank page: ${above(await memory(), blank)}`);

for (const id of FIGURES) {
  await page.locator(`#${id} motion-figure`).scrollIntoViewIfNeeded();
  await page.evaluate((id) => {
    window.shown = false;
    document.getElementById(id).addEventListener("motionlab", ({ detail }) => detail.kind === "state" && (window.shown = true));
    document.querySelector(`#${id} motion-figure`).enter();
  }, id);
  await page.waitForFunction(() => window.shown, null, { timeout: 120000 });
  await page.evaluate(() => document.querySelector("h1").scrollIntoView() || document.activeElement.blur());
  await page.waitForTimeout(1000);
  if (id === FIGURES[0]) console.log(`one figure, above a blank page: ${above(await memory(), blank)}`);
}
const from = await page.evaluate(() => performance.now());
const height = await page.evaluate(() => document.documentElement.scrollHeight);
await page.evaluate(() => {
  window.served = 0;
  const count = (records) => (window.served += records.filter(({ target }) => target.hasAttribute("live")).length);
  new MutationObserver(count).observe(document.querySelector("main"), { subtree: true, attributeFilter: ["live"] });
});
await page.mouse.move(20, 400); // beside the figures, whose frame takes the wheel
for (const way of [1, -1]) {
  for (let y = 0; y < height; y += 200) {
    await page.mouse.wheel(0, way * 200);
    await page.waitForTimeout(y % 1000 ? 60 : 600); // who reads rests
  }
}
await page.waitForTimeout(2000);
const tasks = await page.evaluate((from) => window.tasks.filter(({ startTime }) => startTime > from).map(({ duration }) => duration), from);
const contexts = await Promise.all(page.frames().map((frame) => frame.evaluate(() => [...window.contexts].filter((context) => !context.isContextLost()).length)));
console.log(`six figures: ${contexts.reduce((sum, count) => sum + count)} contexts of WebGL, ${page.frames().length - 1} frames`);
console.log(`six figures, above a blank page: ${above(await memory(), blank)}`);
console.log(`longest tasks while scrolling: ${tasks.sort((a, b) => b - a).slice(0, 8).map((duration) => `${duration.toFixed(0)} ms`).join(", ") || "none of 50 ms"}; ${tasks.length} above 50 ms; ${await page.evaluate(() => window.served)} times another figure was served`);
await browser.close();
server.close();
server.closeAllConnections();
