// A lens that stands still: its hands, its answers, and what it refuses.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { begin, end } from "./harness.mjs";
import { lab, wrong } from "./on_page.mjs";

before(begin);
after(end);

const NEAR = "/lens.html?widget=anatomy&tab=witness&q=0.7853981633974483,1.5707963267948966&lesson=near";
const shown = (page) => page.waitForFunction(() => window.received.kinds.includes("ready") && window.received.state);
const coordinates = (page) => page.evaluate(() => window.received.state.query.coordinates);
const until = (page, wanted, ...given) => page.waitForFunction(wanted, ...(given.length ? given : [null]), { timeout: 20000 });

/** Where a part of a paper is on the screen. */
async function middleOf(page, selector) {
  const { x, y, width, height } = await page.locator(selector).first().boundingBox();
  return [x + width / 2, y + height / 2];
}
/** The tip of the book's arm, whose links are a metre long. */
const tip = ([th1, th2]) => [Math.cos(th1) + Math.cos(th1 + th2), Math.sin(th1) + Math.sin(th1 + th2)];

lab("a figure that stands still is there without the lab, and its arm follows mouse, finger, keys and sliders", NEAR, async ({ page }) => {
  const loaded = [];
  page.on("request", (request) => loaded.push(request.url()));
  await page.reload();
  await shown(page);
  assert.ok(loaded.some((url) => /\/light\..*\.wasm/.test(url)) && !loaded.some((url) => /\/lab\./.test(url)), loaded.join("\n"));
  assert.match(await page.textContent("#answer"), /= 0\.0607 m$/); // the chapter's

  // the tip goes with the mouse: as far on the screen as in the plane, whose scale the block tells, 0.5 m wide
  const before = tip(await coordinates(page));
  const block = await page.evaluate(() => [...document.querySelectorAll(".lens-paper svg > g")].find((g) => g.querySelector("title").textContent === "the block").querySelector("path").getBBox().width);
  const [x, y] = await middleOf(page, '.lens-paper g:has(> title:text-is("drag it"))');
  const scale = block / 0.5;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 0.2 * scale, y + 0.1 * scale, { steps: 4 });
  await until(page, (was) => String(window.received.state.query.coordinates) !== was, String([Math.PI / 4, Math.PI / 2]));
  await page.waitForTimeout(100);
  const now = tip(await coordinates(page));
  assert.ok(Math.abs(now[0] - before[0] + 0.2) < 0.02 && Math.abs(now[1] - before[1] + 0.1) < 0.02, `${before} to ${now}`);
  await page.mouse.up();

  // a task is done when the hand lets go, not when it passes by: at 1.42 rad the arm is 7 mm from the block
  const lesson = () => page.evaluate(() => window.told.filter(({ kind, done }) => kind === "lesson" && done).length);
  await page.evaluate(() => {
    window.told = [];
    addEventListener("motionlab", ({ detail }) => window.told.push(detail));
    window.motionLab.send({ do: "configuration", coordinates: [Math.PI / 4, Math.PI / 2] });
  });
  const slider = page.locator("#sliders input").nth(1);
  await slider.evaluate((input) => {
    input.value = 1.42;
    input.dispatchEvent(new Event("input"));
  });
  await until(page, () => Math.abs(window.received.state.query.coordinates[1] - 1.42) < 0.005);
  assert.equal(await lesson(), 0);
  // nor by a page that puts it there
  await page.evaluate(() => window.motionLab.send({ do: "configuration", coordinates: [Math.PI / 4, 1.42] }));
  await page.waitForTimeout(200);
  assert.equal(await lesson(), 0);
  await slider.evaluate((input) => {
    input.value = 1.43;
    input.dispatchEvent(new Event("input"));
  });
  await slider.evaluate((input) => input.dispatchEvent(new Event("change")));
  await until(page, () => window.told.some(({ kind, done, id }) => kind === "lesson" && done && id === "near"));
  assert.equal(await lesson(), 1);

  // arrow keys on the paper: the second joint by 0.05 rad, with Shift by a tenth
  await page.focus(".lens-paper");
  const [, th2] = await coordinates(page);
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Shift+ArrowDown");
  await until(page, (wanted) => Math.abs(window.received.state.query.coordinates[1] - wanted) < 1e-9, th2 + 0.045);
}, { wait: false });

lab("what is pointed at lights, and what is asked of a lens in vain is said", NEAR, async ({ page }) => {
  await shown(page);
  const [x, y] = await middleOf(page, ".lens-paper g.obstacle path");
  await page.mouse.move(x, y);
  await until(page, () => window.received.state.lit === "obstacle");
  await until(page, () => {
    const strength = (role) => Number(getComputedStyle(document.querySelector(`.lens-paper svg > g.${role}`)).opacity);
    return strength("robot") < 0.5 && strength("obstacle") === 1;
  });
  await page.mouse.move(1, 1);
  await until(page, () => window.received.state.lit === null);
  const answers = await page.evaluate(() => {
    const told = [];
    addEventListener("motionlab", ({ detail }) => told.push(detail));
    for (const message of [{ do: "play" }, { do: "open", query: "widget=atlas" }, { do: "open", query: "widget=anatomy&tab=nope" }, { do: "configuration", coordinates: [] }, { do: "configuration", coordinates: [1, 2, 3] }, { do: "configuration", coordinates: "x" }, { do: "tab", id: "none" }, { do: "light", role: "moon" }, { do: "constructor" }])
      window.motionLab.send({ ...message, request: message.do });
    return told.filter(({ kind }) => kind !== "state").map(({ kind, text }) => `${kind}: ${text}`);
  });
  assert.deepEqual(answers, [
    "error: play: this figure stands still; the whole lab does that",
    "error: atlas does not stand still",
    'error: tab: it must be one of intersects, distance, witness, swept, not "nope"',
    "error: the robot has 2 coordinates",
    "error: the robot has 2 coordinates",
    "error: configuration: coordinates are numbers",
    "error: none: no question of Query",
    "error: light: moon is no role",
    "error: constructor: this figure stands still; the whole lab does that",
  ]);
  assert.deepEqual(await coordinates(page), [Math.PI / 4, Math.PI / 2], "nothing of it was done");
}, { wait: false });

lab("the point of a torus goes over its edge, with a finger too", "/lens.html?widget=cspace&q=3.0,0.4&lesson=over_edge", async ({ page }) => {
  await shown(page);
  await until(page, () => /proven free 7\d\.\d %/.test(document.getElementById("details").textContent));
  const [x, y] = await middleOf(page, ".lens-paper:nth-child(2) > div:nth-child(2) svg > g:last-child");
  const { width } = await page.locator(".lens-paper").nth(1).boundingBox();
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
  // a finger elsewhere scrolls, and moves nothing
  await touch("touchStart", [[x - 0.5 * width, y]]);
  await touch("touchMove", [[x - 0.4 * width, y]]);
  await touch("touchCancel", []);
  await page.waitForTimeout(200);
  assert.deepEqual(await coordinates(page), [3, 0.4]);
  await touch("touchStart", [[x, y]]);
  for (const part of [0.02, 0.05, 0.08]) await touch("touchMove", [[x + part * width, y]]);
  await touch("touchEnd", []);
  await until(page, () => window.received.state.query.coordinates[0] < -2);
  await until(page, () => window.received.kinds.filter((kind) => kind === "lesson").length === 2);

  // who presses among the figures at the axes means no point; keys go over the edge as well
  await page.goto(page.url());
  await shown(page);
  const [left, top] = await page.locator(".lens-paper").nth(1).boundingBox().then(({ x, y }) => [x, y]);
  await page.mouse.click(left + 4, top + 150);
  await page.waitForTimeout(200);
  assert.deepEqual(await coordinates(page), [3, 0.4]);
  assert.equal(await page.evaluate(() => window.received.kinds.filter((kind) => kind === "lesson").length), 1);
  await page.focus(".lens-paper");
  for (let i = 0; i < 4; i++) await page.keyboard.press("ArrowRight");
  await until(page, () => window.received.state.query.coordinates[0] < -3);
  await until(page, () => window.received.kinds.filter((kind) => kind === "lesson").length === 2);
}, { wait: false, options: { viewport: { width: 700, height: 700 }, hasTouch: true } });

for (const colorScheme of ["light", "dark"]) {
  for (const [name, path] of [["witness", NEAR], ["swept", "/lens.html?widget=anatomy&tab=swept"], ["space", "/lens.html?widget=cspace"]]) {
    lab(`axe finds nothing wrong with a lens, and it fits a phone: ${name}, ${colorScheme}`, path, async (open) => {
      const { page } = open;
      await shown(page);
      await page.waitForTimeout(600);
      await open.shot(`lens-${name}-${colorScheme}-wide`);
      assert.deepEqual(await wrong(page), []);
      await page.setViewportSize({ width: 320, height: 640 });
      await page.waitForTimeout(300);
      await open.shot(`lens-${name}-${colorScheme}-phone`);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 320);
      assert.deepEqual(await wrong(page), []);
    }, { wait: false, options: { viewport: { width: 720, height: 760 }, colorScheme } });
  }
}
