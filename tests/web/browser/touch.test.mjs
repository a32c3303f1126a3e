// A phone: one swipe scrolls one thing, what is asked for comes into sight, and what is small is met all the same.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { begin, end } from "./harness.mjs";
import { lab } from "./on_page.mjs";

before(begin);
after(end);

const PHONE = { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } };

/** A finger that goes `by` pixels up from a point of the canvas; how far page and words went. */
async function swipe(lab, session, [x, y], by, word) {
  const { page } = lab;
  const { x: left, y: top } = await page.locator("#lab").boundingBox();
  const touch = (type, at) => session.send("Input.dispatchTouchEvent", { type, touchPoints: at ? [{ x: at[0], y: at[1] }] : [] });
  const where = async () => [await page.evaluate(() => scrollY), (await lab.find(word)).place[1]];
  const before = await where();
  await touch("touchStart", [left + x, top + y]);
  for (let i = 1; i <= 10; i++) {
    await touch("touchMove", [left + x, top + y - (by * i) / 10]);
    await page.waitForTimeout(90);
  }
  await touch("touchEnd");
  await page.waitForTimeout(1500);
  const after = await where();
  return [after[0] - before[0], before[1] - after[1]];
}

lab("one swipe scrolls one thing: the words as long as they go on, then the page", "/?widget=anatomy", async (lab) => {
  const session = await lab.context.newCDPSession(lab.page);
  const word = "Copy as Rust";
  const beside = [360, (await lab.find("intersects")).place[1] + 150];
  const moved = [];
  for (const by of [100, 100, 100, 100, 100, 100, 100, -60]) {
    const [page, words] = await swipe(lab, session, beside, by, word);
    assert.ok(Math.abs(page) < 2 || Math.abs(words) < 2, `the page went ${page} and the words ${words}`);
    moved.push([page, words]);
  }
  assert.ok(moved.some(([, words]) => words > 10), "words scroll");
  assert.ok(moved.some(([page]) => page > 10), "and at their end the page");
  // on words that do not scroll the page does at once
  await lab.page.evaluate(() => scrollTo(0, 0));
  const [page, words] = await swipe(lab, session, [200, 80], 70, word);
  assert.ok(page > 10 && Math.abs(words) < 2, `${page} ${words}`);
}, PHONE);

lab("a guess: the box covers no button, and the verdict is in sight and said", "/?widget=anatomy", async (lab) => {
  const { page } = lab;
  await page.waitForTimeout(1500);
  const guess = page.locator("#controls button", { hasText: /^Guess first$/ });
  if ((await guess.getAttribute("aria-expanded")) === "false") await guess.press("Enter");
  await lab.find("Check");
  await page.waitForTimeout(1000);
  const field = page.locator("#controls input[type=text]");
  await field.evaluate((input) => (input.parentElement.classList.add("typing"), input.focus({ preventScroll: true })));
  const box = (name) => lab.at(name, [0, 0]);
  await page.waitForTimeout(1500);
  const [check] = await box("Check");
  const typed = await field.boundingBox();
  assert.ok(typed.height >= 44 && typed.x + typed.width <= check, `the box ends at ${typed.x + typed.width}, Check begins at ${check}`);
  assert.ok(typed.y > 0 && typed.y + typed.height < 844, `the box is at ${typed.y}`);
  assert.equal(await page.evaluate(() => document.getElementById("controls").scrollTop), 0, "the twins stay in their places");
  await field.fill("0.05");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /0\.0\d/.test(document.getElementById("heard").textContent), null, { timeout: 10000 });
  const heard = await page.textContent("#heard");
  await page.waitForTimeout(1500);
  const { place } = await lab.find(heard);
  const { y, height } = await page.locator("#lab").boundingBox();
  assert.ok(place[1] + place[3] <= height && y + place[1] + place[3] <= 844, `the verdict is at ${y + place[1]}`);
  await lab.shot("guess-verdict");
}, PHONE);

lab("a tap beside a link among words is one on it, and the page's own links are as large as a finger", "/?tick=20", async (lab) => {
  const { page } = lab;
  const { place, on } = await lab.find("scan");
  assert.equal(on, false);
  const { x, y } = await page.locator("#lab").boundingBox();
  assert.ok(place[3] < 30, "it is small");
  await page.touchscreen.tap(x + place[0] + place[2] / 2, y + place[1] - 8);
  for (let i = 0; i < 100 && !(await lab.find("scan")).on; i++) await page.waitForTimeout(50);
  assert.equal((await lab.find("scan")).on, true, "it is drawn");
  // the doors' letters stand so far apart that a finger meets the one it means
  const letters = [];
  for (const door of ["A", "B"]) letters.push((await lab.find(`close door ${door}`)).place);
  assert.ok(letters[1][0] - letters[0][0] >= 36, `${letters[0]} and ${letters[1]}`);
  for (const element of await page.locator("main a:visible, summary:visible, header button:visible").all()) {
    const { width, height } = await element.boundingBox();
    assert.ok(width >= 44 && height >= 44, `${await element.textContent()}: ${width} x ${height}`);
  }
}, PHONE);

lab("a tap on Check enters what was typed before", "/?widget=anatomy", async (lab) => {
  const { page } = lab;
  await page.waitForTimeout(1500);
  const guess = page.locator("#controls button", { hasText: /^Guess first$/ });
  if ((await guess.getAttribute("aria-expanded")) === "false") await guess.press("Enter");
  await lab.find("Check");
  await page.waitForTimeout(1500);
  // as a tap on it does, which brings it into sight
  await page.locator("#controls input[type=text]").evaluate((input) => (input.parentElement.classList.add("typing"), input.focus({ preventScroll: true })));
  await page.waitForTimeout(2500);
  await page.keyboard.type("0.05");
  await page.touchscreen.tap(...(await lab.at("Check")));
  await page.waitForFunction(() => /0\.0\d/.test(document.getElementById("heard").textContent), null, { timeout: 10000 });
  assert.ok(!(await page.textContent("#heard")).includes("no number"));
}, PHONE);

lab("a swipe to the side brings the next world to the front, and takes no robot in hand", "/", async (lab) => {
  const session = await lab.context.newCDPSession(lab.page);
  const touch = (type, at) => session.send("Input.dispatchTouchEvent", { type, touchPoints: at ? [{ x: at[0], y: at[1] }] : [] });
  for (const [from, world] of [[/^Apartment\. Rusty/, "Workbench"], [/^Workbench\. Reach/, "Lot"]]) {
    const [[right, y], [left]] = [await lab.at(from, [0.8, 0.9]), await lab.at(from, [0.2, 0.9])];
    await touch("touchStart", [right, y]);
    for (let i = 1; i <= 10; i++) {
      await touch("touchMove", [right + ((left - right) * i) / 10, y]);
      await lab.page.waitForTimeout(60);
    }
    await touch("touchEnd");
    await lab.page.waitForFunction((name) => window.received.tree.some((w) => w.place && w.name?.startsWith(`${name}. `)), world, { timeout: 10000 });
  }
  assert.equal((await lab.until(() => true)).armed, null);
}, PHONE);

lab("a lab at rest is laid out anew when the phone is turned", "/?widget=anatomy", async (lab) => {
  await lab.until((s) => s.query);
  const right = () => lab.page.evaluate(() => Math.max(...window.received.tree.filter((w) => w.place).map((w) => w.place[0] + w.place[2])));
  // four frames, a second apart, and it sleeps
  await lab.page.waitForTimeout(7000);
  assert.ok((await right()) <= 390);
  await lab.page.setViewportSize({ width: 844, height: 390 });
  await lab.page.waitForTimeout(3000);
  assert.ok((await right()) > 600, `what is farthest to the right ends at ${await right()}`);
}, PHONE);
