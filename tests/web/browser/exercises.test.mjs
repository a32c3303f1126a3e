// The book's exercises: what is to be done is judged where it is done.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { begin, end } from "./harness.mjs";
import { seen, send, within } from "./on_book.mjs";
import { lab } from "./on_page.mjs";
import { tasks } from "../../../assets/web/book/tasks.js";

before(begin);
after(end);

const ROOT = join(import.meta.dirname, "../../..");

test("a task is judged by what the lab tells, and by nothing that is not about it", () => {
  const car = tasks.trailer_at([2, 4.5, 3.5, 0]);
  const at = (...coordinates) => ({ robots: [{ name: "Hitch", coordinates }] });
  assert.match(car(at(6.5, 2.5, 0, 0)).text, /go 1\.00 m to the left, 0\.00 m ahead, and to turn by 0°/);
  // by hand: heading a quarter turn to the left, the axle is 2 m behind, at (4.5, 3.5 - 2)
  assert.match(car(at(4.5, 3.5, 1, Math.PI / 2)).text, /go 2\.00 m to the left, 0\.00 m ahead, and to turn by 90°/);
  assert.match(car(at(7.7, 3.8, 0, 0)).text, /go 0\.30 m to the right, 1\.20 m back/);
  for (const [coordinates, done] of [[[6.5, 3.5, 1, 0], true], [[6.54, 3.5, 1, 0.01], true], [[6.56, 3.5, 0, 0], false], [[6.5, 3.62, 1, 0.06], false], [[6.5, 3.5, 1, 2 * Math.PI], true]]) {
    assert.equal(car(at(...coordinates)).done, done, coordinates);
  }
  assert.equal(car(at(6.5, 3.5, 0)), null, "without a trailer");

  const arm = tasks.tip_rests([0.6, 0.5, 0.4, 0.3, 0.9, 0.8]);
  // what the redundancy walk prints: these have one tip
  const walked = [...readFileSync(join(ROOT, "tests/pinned/redundancy_walk.txt"), "utf8").matchAll(/th1: ([-\d.]+), th2: ([-\d.]+), th3: ([-\d.]+)/g)];
  assert.equal(walked.length, 6);
  for (const [, ...angles] of walked) {
    const judged = arm({ robots: [{ name: "Reach", coordinates: angles.map(Number) }] });
    assert.match(judged.text, /the tip is 0\.00 m from/);
    assert.equal(judged.done, Math.abs(angles[0] - 0.3) >= 0.5, angles);
  }
  assert.equal(arm({ robots: [{ name: "Reach", coordinates: [0.9, 0.9, 0.8] }] }).done, false, "its tip went along");
  assert.equal(arm({ robots: [{ name: "Reach", coordinates: [0.3, 0.9] }] }), null, "an arm of two links");

  const bug = tasks.sensor_misleads();
  const plan = (seed, stage, why, planner = "bug1-sensor") => ({ plan: { planner, seed, stage, why } });
  assert.equal(bug({ plan: null }), null);
  assert.equal(bug(plan("1", "ended", "the robot gave up: it has made 20 rounds", "bug2")), null);
  assert.equal(bug(plan("1", "growing", null)), null);
  assert.equal(bug(plan("1", "solved", null)).text, "Seeds walked: 1. It gave up at 0 of them.");
  const lost = bug(plan("2", "ended", "the robot gave up: it has made 20 rounds"));
  assert.equal(lost.text, "Seeds walked: 2. It gave up at 1 of them; at 2, because it has made 20 rounds.");
  assert.ok(lost.done);
  assert.equal(bug(plan("3", "ended", "the goal is enclosed")).done, false);
});

const farOf = (page, id) => page.locator(`#${id} .far`);
const saysOf = (page, id, words) => page.waitForFunction(([id, words]) => new RegExp(words).test(document.querySelector(`#${id} .far`).textContent), [id, words], { timeout: 20000 });

lab("the trailer's way to the left is judged while it is driven", "/", async ({ page }) => {
  const frame = await within(page, "left");
  await saysOf(page, "left", "go 1\\.00 m to the left, 0\\.00 m ahead, and to turn by 0°");
  assert.equal(await page.locator("#left .then").isVisible(), false);
  // the solution that the book names, up to where it reverses and to its end
  const script = readFileSync(join(ROOT, "examples/exercises/one_metre_left.ron"), "utf8").replace(/\/\/.*/g, "").replace(/\s+/g, "");
  await send(frame, { do: "open", query: `widget=dashboard&world=lot&script=${script}&tick=60` });
  await seen(frame, () => window.received.state.tick === 60);
  await saysOf(page, "left", "to turn by [1-9]");
  assert.equal(await page.locator("#left .then").isVisible(), false);
  await send(frame, { do: "seek", tick: 138 });
  await page.waitForSelector("#left .then:visible", { timeout: 20000 });
  assert.match(await farOf(page, "left").textContent(), /go 0\.0\d m/);
  assert.equal(await page.locator('#dots a[href="#exercises"]').locator("..").getAttribute("data-part"), "");
  assert.match(await page.locator("#told").textContent(), /It is there/, "who does not see it hears it");
  // from the beginning
  await page.click("#left figcaption >> text=Begin anew");
  await saysOf(page, "left", "go 1\\.00 m to the left");
}, { wait: false, timeout: 240000 });

lab("an arm of three links is another arm with the same tip", "/", async ({ page }) => {
  const frame = await within(page, "rest");
  await saysOf(page, "rest", "turned by 0°, and the tip is 0\\.00 m from");
  const go = (...angles) => send(frame, { do: "robot", robot: "Reach", move_to: angles });
  await go(1.136, 0.9, 0.8);
  await saysOf(page, "rest", "turned by 48°, and the tip is 0\\.[1-9]");
  assert.equal(await page.locator("#rest .then").isVisible(), false);
  await go(1.136, -0.946, 1.781);
  await page.waitForSelector("#rest .then:visible", { timeout: 20000 });
}, { wait: false, timeout: 240000 });

lab("the seed at which Bug1's sensor misleads it is found by walking", "/", async ({ page }) => {
  const frame = await within(page, "bug");
  await seen(frame, () => window.received.state.widget === "plan");
  const act = async (kind, name, action = "click", value) => {
    const widget = await seen(frame, ([kind, name]) => window.received.tree.find((widget) => widget.kind === kind && new RegExp(name).test(widget.name)), [kind, name]);
    const { id } = await widget.jsonValue();
    await send(frame, { do: "act", id, action, value });
    await page.waitForTimeout(300); // a list opens
  };
  // the figure's address has robot, planner and ends
  await seen(frame, () => window.received.state.plan.planner === "bug1-sensor" && window.received.state.plan.robot === "Rusty" && String(window.received.state.plan.goal) === "9.75,6.25,0");
  await act("combo", "a second");
  await act("button", "^as fast as possible$");
  await act("check", "^the sensor lies$");
  for (const [seed, says] of [["2021", "^Seeds walked: 1\\. It gave up at 0 of them\\.$"], ["2022", "^Seeds walked: 2\\. It gave up at 1 of them; at 2022, because it never came back to "]]) {
    assert.equal(await page.locator("#bug .then").isVisible(), false);
    await act("number", "^seed$", "set", seed);
    await seen(frame, (seed) => window.received.state.plan.seed === seed, seed);
    await act("button", "^Play$");
    await saysOf(page, "bug", says);
  }
  await page.waitForSelector("#bug .then:visible");
}, { wait: false, timeout: 240000 });
