// The book and the lab by keys alone: into a figure, out of it on either side, and what is said on the way.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { begin, end, origin } from "./harness.mjs";
import { seen, within } from "./on_book.mjs";
import { lab } from "./on_page.mjs";

before(begin);
after(end);

lab("who leaves a figure by Tab goes on in the text behind it, and backwards to its link", "/", async ({ page }) => {
  const frame = await within(page, "witness");
  await seen(frame, () => window.received.state?.query);
  // the first stop behind the figure is the first word of its caption that lights a part of it
  await frame.focus("#whole");
  await page.waitForSelector(".motion-figure-gate[tabindex='0']", { state: "attached" });
  await page.keyboard.press("Tab");
  await page.waitForFunction(() => document.activeElement.matches("#witness figcaption .role-robot"));
  // and from there the order goes on, past the frame at the page's end
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "obstacles");
  await frame.focus(".lens-paper");
  await page.waitForSelector(".motion-figure-gate[tabindex='0']", { state: "attached" });
  await page.keyboard.press("Shift+Tab");
  await page.waitForFunction(() => document.activeElement.closest("#witness motion-figure a"));
  // no stops are left at the page's end
  await page.waitForFunction(() => document.querySelectorAll(".motion-figure-gate").length === 2 && !document.querySelector(".motion-figure-gate[tabindex='0']"));
}, { wait: false, timeout: 240000 });

lab("Enter on a figure of the lab gives its canvas the keys; Escape lets go of a robot first, and leaves next", "/", async ({ page }) => {
  const frame = await within(page, "tour");
  await seen(frame, () => window.received.state?.robots.length === 3);
  await page.focus("#tour motion-figure a");
  await page.keyboard.press("Enter");
  await frame.waitForFunction(() => document.activeElement.id === "lab");
  await page.keyboard.press("1");
  await seen(frame, () => window.received.state.armed !== null);
  await page.keyboard.press("Escape");
  await seen(frame, () => window.received.state.armed === null);
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => document.activeElement.localName), "iframe", "it stays in the figure");
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement.closest("#tour motion-figure a"));
  // which is under the frame: the figure shows it, and says which one it is
  assert.equal(await page.$eval("#tour motion-figure", (figure) => getComputedStyle(figure).outlineStyle), "solid");
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  const name = nodes.find((node) => node.role?.value === "link" && node.properties?.some((p) => p.name === "focused" && p.value.value)).name.value;
  assert.match(name, /Try it ?: Figure 7, /);
}, { wait: false, timeout: 240000 });

lab("a sentence that moves a figure says what the figure says, and a stage keeps Home and End", "/", async ({ page }) => {
  const frame = await within(page, "witness");
  await seen(frame, () => window.received.state?.query);
  const says = (words) => page.waitForFunction((words) => document.getElementById("told").textContent === words, words, { timeout: 20000 });
  // by hand, as in book.test.mjs: at 1.48 the second link passes the corner at 0.0284 m
  await page.focus("text=stretch the elbow");
  await page.keyboard.press("Enter");
  await says("It is 0.0284 m away.");
  await page.focus("text=until it touches");
  await page.keyboard.press("Enter");
  await says("It touches.");
  await frame.focus(".lens-paper");
  const before = await page.evaluate(() => scrollY);
  for (const key of ["End", "Home", "PageUp", "PageDown"]) await page.keyboard.press(key);
  await page.waitForTimeout(400);
  assert.equal(await page.evaluate(() => scrollY), before);
}, { wait: false, timeout: 240000 });

lab("what has the keys is in sight, on a page that is zoomed to 400 %", "/", async (lab) => {
  const { page } = lab;
  await page.setViewportSize({ width: 320, height: 256 });
  await page.waitForTimeout(1500);
  await page.focus("#lab");
  let looked = 0;
  for (let stop = 0; stop < 25; stop++) {
    await page.keyboard.press("Tab");
    // until the lab has the focus where the page has it, and has scrolled there, which takes some frames
    const found = await page.waitForFunction(() => {
      const { textContent } = document.activeElement;
      if (!document.activeElement.closest("#controls")) return "none";
      const own = window.received.tree.find((w) => w.focus && w.place && (textContent === "" || textContent.startsWith(w.name.slice(0, 8))));
      if (!own) return null;
      if (own.place[2] * own.place[3] > 17000) return "a picture";
      const top = document.getElementById("lab").getBoundingClientRect().top + own.place[1];
      return top > -2 && top + own.place[3] < 258 ? "in sight" : null;
    }, null, { timeout: 5000 }).catch(() => null);
    assert.ok(found, `out of sight: ${await page.evaluate(() => `${document.activeElement.textContent}, of ${JSON.stringify(window.received.tree.filter((w) => w.focus))}, canvas at ${document.getElementById("lab").getBoundingClientRect().top}`)}`);
    looked += (await found.jsonValue()) === "in sight" ? 1 : 0;
  }
  assert.ok(looked > 10, `${looked} stops were looked at`);
}, { timeout: 120000 });

lab("what came of a plan is said, and a contact on tour is not", "/?widget=plan", async (lab) => {
  await lab.until((s) => s.plan);
  await lab.click("Play");
  await lab.until((s) => s.plan.stage === "solved");
  assert.match(await lab.page.textContent("#heard"), /^A path is found, and proven: 0\.0\d\d\d m clear$/);
  // the tour's arm touches the post within its first seconds
  const other = await lab.context.newPage();
  await other.addInitScript(() => {
    window.said = [];
    addEventListener("DOMContentLoaded", () => new MutationObserver(() => window.said.push(document.getElementById("heard").textContent)).observe(document.getElementById("heard"), { childList: true, characterData: true, subtree: true }));
  });
  await other.goto(`${origin()}/`);
  await other.waitForFunction(() => window.motionLab?.state?.robots.some((robot) => robot.contacts > 0), null, { timeout: 90000 });
  await other.waitForTimeout(500);
  assert.deepEqual(await other.evaluate(() => window.said.filter((text) => /contact/.test(text))), []);
}, { timeout: 240000 });
