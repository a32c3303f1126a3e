// Films the page over a slow line: 1.6 Mbit/s, 150 ms there and back, the processor slowed down four times, as Lighthouse's slow 4G. Writes a
// picture each half second, and says when what came. Usage: tests/web/browser/check --run tests/web/browser/film.mjs [a page, "/" by
// default] [a site's folder] [a folder for the pictures]
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { ARGS, chromium, shots, target } from "./harness.mjs";

const [path = "/", site = join(target, "web"), folder = join(shots, "film")] = process.argv.slice(2);
const server = await serve(site, 0);
const browser = await chromium.launch({ executablePath: process.env.MOTION_LAB_CHROMIUM, args: ARGS });
const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
await page.addInitScript(() => {
  window.came = {};
  window.shifts = 0;
  new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.came[entry.name] = entry.startTime))).observe({ type: "paint", buffered: true });
  new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.came["largest picture or text"] = entry.startTime))).observe({ type: "largest-contentful-paint", buffered: true });
  new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.shifts += entry.value))).observe({ type: "layout-shift", buffered: true });
  addEventListener("motionlab", ({ detail }) => detail.kind === "ready" && (window.came["the lab's first frame"] = performance.now()));
});
const session = await page.context().newCDPSession(page);
await session.send("Network.enable");
const bytesPerSecond = 1.6e6 / 8;
await session.send("Network.emulateNetworkConditions", { offline: false, latency: 150, downloadThroughput: bytesPerSecond, uploadThroughput: bytesPerSecond / 2 });
await session.send("Emulation.setCPUThrottlingRate", { rate: 4 });
mkdirSync(folder, { recursive: true });

const began = performance.now();
let saved = -1;
session.on("Page.screencastFrame", ({ data, sessionId }) => {
  session.send("Page.screencastFrameAck", { sessionId }).catch(() => {});
  const half = Math.floor((performance.now() - began) / 500);
  if (half > saved) writeFileSync(join(folder, `${(half / 2).toFixed(1).padStart(4, "0")}.jpg`), Buffer.from(data, "base64"));
  saved = half;
});
await session.send("Page.startScreencast", { format: "jpeg", quality: 70, maxWidth: 640, maxHeight: 400 });
await page.goto(`http://localhost:${server.address().port}${path}`, { waitUntil: "commit" });
// a page without a lab is there when nothing more comes
if (await page.locator("#lab, #lens").count()) await page.waitForFunction(() => window.came["the lab's first frame"], null, { timeout: 180000 });
else await page.waitForLoadState("networkidle");
await page.waitForTimeout(1500);
const { came, shifts } = await page.evaluate(() => ({ came: window.came, shifts: window.shifts }));
for (const [what, at] of Object.entries(came)) console.log(`${(at / 1000).toFixed(2).padStart(7)} s  ${what}`);
console.log(`${shifts.toFixed(4).padStart(9)}  layout shift`);
await browser.close();
server.close();
server.closeAllConnections();
