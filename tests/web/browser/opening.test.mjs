// What a page shows before the lab is there: a picture and a sentence at once, in the lab's place, and how much of the lab has come.
import assert from "node:assert/strict";
import { readdirSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, target } from "./harness.mjs";

before(begin);
after(end);

const SENTENCES = {
  dashboard: "A position is not a configuration: three robots, three spaces, three types.",
  anatomy: "Two free end points do not make a free motion, and a distance is a pair of points.",
  plan: "A path is no list of free points: every leg between them carries its proof.",
};
/** The darkest and the lightest paper, as the native lab's pictures have them. */
const PAPERS = { light: "rgb(251, 250, 247)", dark: "rgb(21, 24, 28)" };

/** A page whose lab never comes. */
const waiting = (path, options = {}) =>
  Lab.open(path, { wait: false, options, before: (page) => page.route("**/lab.*.wasm", () => {}) });

/** What the reader sees: the figures with their pictures' boxes, the words, the paper. */
const seen = (page) =>
  page.evaluate(() => {
    const box = (element) => (({ x, y, width, height }) => [x, y, width, height].map(Math.round))(element.getBoundingClientRect());
    const isSeen = (element) => element.checkVisibility() && element.getBoundingClientRect().height > 0;
    const pictures = [...document.querySelectorAll("#still figure > :is(img, svg)")].filter(isSeen);
    return {
      pictures: pictures.map((picture) => [picture.parentNode.id, box(picture)]),
      sentences: [...document.querySelectorAll("#still strong")].filter(isSeen).map((words) => words.textContent),
      place: box(document.getElementById("still")),
      canvas: box(document.getElementById("lab")),
      bar: box(document.getElementById("progress")),
      paper: getComputedStyle(document.getElementById("still")).backgroundColor,
      wide: document.documentElement.scrollWidth,
    };
  });

test("over a slow line picture and sentence come first, in the lab's place, and the bar counts what is sent", { timeout: 300000 }, async () => {
  const lab = await Lab.open("/", {
    wait: false,
    before: async (page) => {
      await page.addInitScript(() => {
        window.shifts = [];
        window.told = [];
        const watch = (type, act) => new PerformanceObserver((list) => list.getEntries().forEach(act)).observe({ type, buffered: true });
        const where = ({ node, previousRect, currentRect }) => `${node?.nodeName} ${node?.id}: ${JSON.stringify(previousRect)} to ${JSON.stringify(currentRect)}`;
        watch("layout-shift", ({ value, startTime, sources }) => window.shifts.push([value, startTime, ...sources.map(where)]));
        watch("paint", ({ name, startTime }) => (window[name] = startTime));
        watch("resource", ({ name, responseEnd }) => /lab\.\w+\.wasm$/.test(name) && (window.labCame = responseEnd));
        addEventListener("DOMContentLoaded", () => {
          const [loaded, progress] = ["loaded", "progress"].map((id) => document.getElementById(id));
          new MutationObserver(() => window.told.push([Number(loaded.textContent), progress.value])).observe(loaded, { childList: true });
        });
      });
      const session = await page.context().newCDPSession(page);
      await session.send("Network.enable");
      await session.send("Network.emulateNetworkConditions", { offline: false, latency: 150, downloadThroughput: 200000, uploadThroughput: 100000 });
      await session.send("Emulation.setCPUThrottlingRate", { rate: 4 });
      page.wire = { sent: 0, wrong: [] };
      let asked;
      session.on("Network.requestWillBeSent", ({ requestId, request }) => /lab\.\w+\.wasm$/.test(request.url) && (asked = requestId));
      session.on("Network.dataReceived", ({ requestId, encodedDataLength }) => requestId === asked && (page.wire.sent += encodedDataLength));
    },
  });
  const { page } = lab;
  await page.waitForFunction(() => window["first-contentful-paint"], null, { timeout: 60000 });
  const first = await seen(page);
  assert.equal(await page.evaluate(() => window.labCame), undefined, "the lab is on its way");
  assert.deepEqual([first.sentences, first.pictures.map(([id]) => id)], [[SENTENCES.dashboard], ["dashboard"]]);
  const [, [, , width, height]] = first.pictures[0];
  assert.ok(width > 1200 && height > 400, `${width} x ${height}`);
  assert.deepEqual(first.place, first.canvas, "in the lab's place");
  // what the bar says is what the wire has brought, on the way too
  const off = [];
  while (!(await page.evaluate(() => window.labCame))) {
    const said = await page.evaluate(() => document.getElementById("loaded")?.textContent);
    if (said) off.push(Math.abs(page.wire.sent / 1e6 - Number(said)));
    await page.waitForTimeout(500);
  }
  off.sort((a, b) => a - b);
  assert.ok(off.length > 3 && off[off.length >> 1] < 0.3, `MB off, in order: ${off.map((mb) => mb.toFixed(2))}`);
  await page.waitForFunction(() => document.documentElement.dataset.lab === "running", null, { timeout: 120000 });
  await page.waitForTimeout(1000);
  const packed = readdirSync(join(target, "web")).find((name) => /^lab\.\w+\.wasm\.br$/.test(name));
  const megabytes = (statSync(join(target, "web", packed)).size / 1e6).toFixed(1);
  const { told, shifts, total } = await page.evaluate(() => ({ told: window.told, shifts: window.shifts, total: document.getElementById("total")?.textContent }));
  assert.ok(told.length > 10, `${told.length} times`);
  for (const column of [0, 1]) assert.ok(told.every((now, i) => i === 0 || now[column] >= told[i - 1][column]), "never less than before");
  assert.deepEqual(told.at(-1), [Number(megabytes), 1], "in the end all of it");
  assert.deepEqual(shifts, [], "nothing moves");
  const last = await seen(page);
  assert.deepEqual([last.canvas, last.pictures], [first.canvas, []], "the lab is where its picture was");
  assert.equal(total, undefined);
  assert.deepEqual(await lab.close(), []);
});

test("the picture gives way to a drawn lab: no frame between them is bare", { timeout: 120000 }, async () => {
  const lab = await Lab.open("/", { wait: false });
  const session = await lab.context.newCDPSession(lab.page);
  const frames = [];
  session.on("Page.screencastFrame", ({ data, sessionId }) => (frames.push(data), session.send("Page.screencastFrameAck", { sessionId }).catch(() => {})));
  await session.send("Page.startScreencast", { format: "png", maxWidth: 640, maxHeight: 400 });
  await lab.until((s) => s.tick > 20, 60000);
  await session.send("Page.stopScreencast");
  // how much of each frame, below the header, is not paper
  const ink = await lab.page.evaluate(async (all) => {
    const shares = [];
    for (const data of all) {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: "image/png" }));
      const at = new OffscreenCanvas(image.width, image.height).getContext("2d");
      at.drawImage(image, 0, 0);
      const { data: pixels } = at.getImageData(0, 30, image.width, image.height - 30);
      let dark = 0;
      for (let i = 0; i < pixels.length; i += 4) dark += pixels[i] < 200;
      shares.push(dark / (pixels.length / 4));
    }
    return shares;
  }, frames);
  assert.ok(ink.length > 3, `${ink.length} frames`);
  // the browser may send its empty window first
  const painted = ink.slice(ink.findIndex((share) => share > 0.02));
  assert.ok(painted.length > 3 && painted.every((share) => share > 0.02), `${ink.map((share) => share.toFixed(3))}`);
  await lab.close();
});

test("picture and sentence are those of what the address opens, on the paper that it and the reader choose", { timeout: 120000 }, async () => {
  for (const [path, id, paper, colorScheme] of [
    ["/", "dashboard", "light", "light"],
    ["/", "dashboard", "dark", "dark"],
    ["/embed.html?widget=plan", "plan", "light", "light"],
    ["/embed.html?lesson=near&widget=plan", "anatomy", "light", "light"],
    ["/?theme=dark#", "dashboard", "dark", "light"],
    ["/embed.html#tab=swept&theme=light", "anatomy", "light", "dark"],
    ["/?widget=moon", "dashboard", "light", "light"],
  ]) {
    const lab = await waiting(path, { colorScheme });
    await lab.page.waitForFunction(() => [...document.querySelectorAll("#still img")].every((image) => !image.checkVisibility() || image.complete));
    const found = await seen(lab.page);
    assert.deepEqual([found.pictures.map(([id]) => id), found.sentences, found.paper], [[id], [SENTENCES[id]], PAPERS[paper]], path);
    assert.deepEqual(await lab.close(), [], path);
  }
});

test("on a phone and in a low frame the words, the bar and the picture are in sight", { timeout: 120000 }, async () => {
  const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
  for (const [path, options] of [["/", phone], ["/embed.html", phone], ["/embed.html", { viewport: { width: 600, height: 400 } }], ["/", { viewport: { width: 1280, height: 500 } }]]) {
    const { viewport } = options;
    const lab = await waiting(path, options);
    const { wide, bar, pictures: [[, [left, top, width, height]]] } = await seen(lab.page);
    const what = `${path} at ${viewport.width} x ${viewport.height}`;
    assert.equal(wide, viewport.width, what);
    assert.ok(bar[1] + bar[3] < viewport.height, `${what}: the bar is at ${bar}`);
    assert.ok(left >= 0 && left + width <= viewport.width && top > bar[1] + bar[3] && top + Math.min(height, 200) < viewport.height, `${what}: ${[left, top, width, height]}`);
    // letters of 12 px in the picture are at least 8 high where it shows one world alone
    if (viewport.width === 390) assert.ok(width / 470 > 0.7 && Math.abs(width / height - 470 / 457) < 0.02, `${width} x ${height}`);
    await lab.shot(`opening-${viewport.width}-${path.includes("embed") ? "frame" : "page"}`);
    assert.deepEqual(await lab.close(), [], what);
  }
});

test("without script picture and sentence are there, on paper too, and no more than they need is fetched", { timeout: 60000 }, async () => {
  const fetched = [];
  const options = { javaScriptEnabled: false, colorScheme: "dark" };
  const before = (page) => page.on("request", (request) => fetched.push(new URL(request.url()).pathname.replace(/\.[0-9a-f]{12}/, "")));
  const lab = await Lab.open("/", { wait: false, options, before });
  const { page } = lab;
  const picture = page.locator("#dashboard > svg");
  const ink = () => page.locator("#dashboard > svg rect.paper").evaluate((paper) => getComputedStyle(paper).fill);
  assert.ok(await picture.isVisible());
  assert.equal(await ink(), PAPERS.dark);
  assert.ok((await page.locator("#still").innerText()).includes(SENTENCES.dashboard));
  assert.match(await page.locator("#still").innerText(), /natively: cargo run/);
  await page.emulateMedia({ media: "print", colorScheme: "dark" });
  assert.ok(await picture.isVisible());
  assert.equal(await ink(), PAPERS.light, "paper is light");
  assert.match(await page.locator("#still").innerText(), /natively: cargo run/);
  assert.equal(await page.locator("#loading").isVisible(), false);
  assert.deepEqual(fetched.filter((path) => /\.wasm$/.test(path)), []);
  assert.deepEqual(await lab.close(), []);
});

test("a page whose script does not come keeps its pictures and words", { timeout: 60000 }, async () => {
  const lab = await Lab.open("/", { wait: false, before: (page) => page.route("**/twins.*.js", (route) => route.abort()) });
  await lab.page.waitForFunction(() => !("lab" in document.documentElement.dataset));
  const { pictures, sentences } = await seen(lab.page);
  assert.equal(sentences.length, 5);
  assert.ok(pictures.some(([id]) => id === "dashboard"));
  assert.equal(await lab.page.locator("#loading").isVisible(), false);
  await lab.close();
});
