// <motion-figure> in a page of another origin, which is its own policy's.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { after, before } from "node:test";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { begin, end, origin } from "./harness.mjs";
import { seen, send } from "./on_book.mjs";
import { lab } from "./on_page.mjs";

let server = null;
const folder = mkdtempSync(join(tmpdir(), "figures-"));
const elsewhere = () => `http://localhost:${server.address().port}/`;

const figure = (id, query, within = "") => `<motion-figure id="${id}" query="${query}" label="Figure ${id}">${within}</motion-figure><p style="height:1200px">Words.</p>`;
const PICTURE = "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 4'/%3E";

before(async () => {
  await begin();
  const from = origin();
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><title>A book of others</title>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src ${from}; style-src ${from} 'unsafe-inline'; frame-src ${from}; img-src data: blob:">
<link rel="icon" href="data:,"><link rel="stylesheet" href="${from}/motion-figure.css">
<script type="module" src="${from}/motion-figure.js"></script>
<body style="margin:40px"><h1>A book of others</h1><div style="width:620px">
${figure("a", "widget=anatomy&amp;tab=witness&amp;q=0.5,1.25", `<a href="${from}/index.html?tab=witness"><img src="${PICTURE}" alt="An arm"></a>`)}
${figure("b", "widget=cspace&amp;q=1,1")}
${figure("c", "widget=dashboard&amp;world=lot")}
${figure("d", "widget=anatomy&amp;lesson=held")}
${figure("e", "widget=anatomy&amp;tab=distance&amp;q=0.75,1.25")}
</div></body></html>`,
  );
  server = await serve(folder, 0);
});
after(async () => {
  server.close();
  server.closeAllConnections();
  rmSync(folder, { recursive: true });
  await end();
});

lab("a page of another origin has figures that share one lab, hears and moves them", "/embed.html", async ({ page }) => {
  await page.addInitScript(() => {
    window.heard = [];
    document.addEventListener("motionlab", ({ target, detail }) => window.heard.push({ id: target.id, ...detail }));
  });
  await page.goto(elsewhere());
  assert.equal(page.frames().length, 1, "no lab before a figure is touched");
  assert.equal(await page.locator("#b a").getAttribute("href"), `${origin()}/index.html?widget=cspace&q=1,1`, "without a link of its own it opens the lab");
  await page.focus("#a a");
  await page.keyboard.press("Enter");
  await page.waitForSelector("iframe:not([data-waits])", { timeout: 90000 });
  const [, frame] = page.frames();
  assert.equal(new URL(frame.url()).origin, origin());
  const heard = (id, key, value) => page.waitForFunction(([id, key, value]) => window.heard.some((said) => said.id === id && said.kind === "state" && String(key.split(".").reduce((inner, name) => inner?.[name], said)) === value), [id, key, value], { timeout: 20000 });
  await heard("a", "query.coordinates", "0.5,1.25");
  await page.evaluate(() => document.getElementById("a").move("q=0.5,1.5"));
  await heard("a", "query.coordinates", "0.5,1.5");
  await page.evaluate(() => document.getElementById("a").send({ do: "configuration", coordinates: [0.25, 1.5] }));
  await heard("a", "query.coordinates", "0.25,1.5");
  // Escape comes out of the frame of another origin, too
  await page.waitForFunction(() => document.activeElement.matches("iframe"));
  // the keys come to the frame a moment after the page says so
  await seen(frame, () => document.hasFocus());
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement.matches("#a a"));

  // a state that the lab told before it took the other figure's address comes late
  await page.evaluate((origin) => {
    document.getElementById("b").scrollIntoView({ block: "center" }); // out of view a frame of another origin sleeps
    document.getElementById("b").enter();
    const late = { motionLab: { kind: "state", widget: "anatomy" } };
    dispatchEvent(new MessageEvent("message", { source: document.querySelector("iframe").contentWindow, origin, data: late }));
  }, origin());
  await heard("b", "widget", "cspace");
  const { x, y, width, height } = await page.locator("#b").boundingBox();
  const over = await page.locator("iframe").boundingBox();
  assert.ok([over.x - x, over.y - y, over.width - width, over.height - height].every((off) => Math.abs(off) < 1), "the frame lies over its figure");
  await page.waitForFunction(() => document.querySelector("#a img").src.startsWith("blob:"));
  assert.equal(await page.locator("iframe").count(), 1);
  // and nothing that is told of one figure comes as the other's
  const mixed = await page.evaluate(() => window.heard.filter(({ kind, id, widget }) => kind === "state" && widget !== { a: "anatomy", b: "cspace" }[id]).length);
  assert.equal(mixed, 0);
  // who was within a figure and scrolls on to another has that one, though the frame still has the keys
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "IFRAME");
  await page.evaluate(() => document.getElementById("a").scrollIntoView({ block: "center" }));
  await seen(frame, () => window.received.state.query?.coordinates[0] === 0.25);
  await send(frame, { do: "configuration", coordinates: [0.5, 1] });
  await heard("a", "query.coordinates", "0.5,1");

  // what moves has the lab, in a frame of its own; only one of the two is seen
  await page.evaluate(() => {
    document.getElementById("c").scrollIntoView({ block: "center" });
    document.getElementById("c").enter();
  });
  await heard("c", "widget", "dashboard");
  const waits = () => page.evaluate(() => [...document.querySelectorAll("iframe")].map((frame) => [new URL(frame.src).pathname, frame.hasAttribute("data-waits")]));
  await page.waitForFunction(() => document.querySelectorAll("iframe:not([data-waits])").length === 1);
  assert.deepEqual(await waits(), [["/lens.html", true], ["/embed.html", false]]);
  await page.evaluate(() => document.activeElement.blur());
  await page.evaluate(() => document.getElementById("a").scrollIntoView({ block: "center" }));
  await page.waitForFunction(() => document.querySelector('iframe[src*="embed"]').hasAttribute("data-waits"));
  assert.deepEqual(await waits(), [["/lens.html", false], ["/embed.html", true]]);

  // what moves after all is the lab's, and costs no other figure its own frame
  const enter = (id) => page.evaluate((id) => {
    document.getElementById(id).scrollIntoView({ block: "center" });
    document.getElementById(id).enter();
  }, id);
  await enter("d");
  await heard("d", "widget", "dashboard");
  assert.equal(await page.evaluate(() => window.heard.filter(({ id, kind, query }) => id === "d" && kind === "state" && query).length), 0, "no other figure's state");
  await enter("e");
  await heard("e", "query.coordinates", "0.75,1.25");
  assert.deepEqual(await waits(), [["/lens.html", false], ["/embed.html", true]]);
  // a narrower page is not scrolled sideways by the frame that waits
  await page.setViewportSize({ width: 400, height: 700 });
  await page.evaluate(() => (document.querySelector("body > div").style.width = "300px"));
  await page.waitForFunction(() => document.documentElement.scrollWidth <= 400);
}, { wait: false, timeout: 240000 });
