// What a screen reader meets: everything once, with what is open and where the rail is.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { begin, end } from "./harness.mjs";
import { lab } from "./on_page.mjs";

before(begin);
after(end);

/** The parts of the accessibility tree that are read: role, name, level and whether it is open. */
async function read(lab) {
  const session = await lab.context.newCDPSession(lab.page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  const property = (node, name) => node.properties?.find((p) => p.name === name)?.value.value;
  const told = nodes.filter((node) => !node.ignored && node.name?.value);
  return told.map((node) => ({ role: node.role.value, name: node.name.value, level: property(node, "level"), expanded: property(node, "expanded") }));
}

lab("what is heard is heard once: notices, names, the colour key and formulas", "/?tick=200&widget=anatomy", async (lab) => {
  const { page } = lab;
  await lab.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const times = async (text) => (await read(lab)).filter(({ role, name }) => role === "StaticText" && name === text).length;
  /** Reads until the words are there: a notice goes after six seconds, which a busy machine can spend on a read. */
  const heard = async (text) => {
    for (const end = Date.now() + 3000; ; ) {
      const count = await times(text);
      if (count !== 0 || Date.now() > end) return count;
    }
  };
  const { notice } = await lab.until((s) => s.notice);
  assert.equal(await heard(notice.text), 1, notice.text);
  await page.locator("#controls button", { hasText: "Copy as Rust" }).press("Enter");
  const copied = await lab.until((s) => /^copied/.test(s.notice?.text ?? ""));
  await page.waitForTimeout(1200);
  assert.equal(await page.textContent("#said"), "", "the status says no more than the notice does");
  assert.equal(await times(copied.notice.text), 1);
  const all = await read(lab);
  const named = (text) => all.filter(({ role, name }) => name === text && !["StaticText", "InlineTextBox"].includes(role)).map(({ role }) => role);
  assert.deepEqual(named("robot"), [], "the page's own key is for pointers");
  assert.deepEqual(named("colour key: robot"), ["button"], "the canvas's has twins");
  assert.equal(await times("The set that the robot covers at q meets the obstacles."), 0, "the formula itself is there");
  assert.equal(await page.locator("#formulas li[data-at]:visible math").count(), 1, "as such");
  assert.deepEqual([await times("th1"), await times("θ₁")], [0, 2], "a slider and its number by the sign on the screen, and no words besides");
  // keys still reach what lights a role
  await page.locator("#controls button", { hasText: "colour key: obstacle" }).focus();
  await lab.until((s) => s.lit === "obstacle");
});

lab("the words for a long load do not take the place of the lab's first", "/?tick=200", async (lab) => {
  const { notice } = await lab.until((s) => s.notice);
  const [loads, heard] = await lab.page.evaluate(() => [window.loads, document.getElementById("heard").textContent]);
  assert.deepEqual([loads, heard], ["loading", notice.text]);
}, {
  // the two seconds after which a long load is said end between the lab's first state and the frame that shows it
  before: (page) => page.addInitScript(() => {
    let late;
    const { setTimeout: later, requestAnimationFrame: frame } = window;
    window.setTimeout = (act, after, ...rest) => (after === 2000 ? ((late = act), 0) : later(act, after, ...rest));
    window.requestAnimationFrame = (act) =>
      frame((time) => {
        if (late && window.received.state) {
          window.loads = document.documentElement.dataset.lab;
          late();
          late = null;
        }
        act(time);
      });
  }),
});

lab("the rail is navigation, headings skip no level, and what opens says whether it is open", "/", async (lab) => {
  const { page } = lab;
  const rail = page.getByRole("navigation", { name: "Widgets" });
  assert.deepEqual(await rail.getByRole("button").allTextContents(), ["Drive", "Query", "Space", "Atlas", "Plan"]);
  assert.equal(await rail.locator("[aria-current=page]").textContent(), "Drive");
  assert.equal(await page.evaluate(() => document.querySelector("#controls > :first-child").localName), "nav", "first of all");
  const expanded = async (name) => page.locator("#controls button", { hasText: name }).getAttribute("aria-expanded");
  const until = async (name, wanted) => {
    for (let i = 0; i < 60 && (await expanded(name)) !== wanted; i++) await page.waitForTimeout(100);
    assert.equal(await expanded(name), wanted, `${name}`);
  };
  assert.equal(await page.locator("#controls button", { hasText: /^Menu$/ }).getAttribute("aria-haspopup"), "true");
  await until(/^Menu$/, "false");
  await lab.click("Menu");
  await until(/^Menu$/, "true");
  await lab.click("Menu");
  await until(/^Menu$/, "false");
  await lab.send({ do: "widget", id: "anatomy" });
  await lab.until((s) => s.widget === "anatomy");
  await until(/^Any robot, any world$/, "false");
  await lab.click("Any robot, any world");
  await until(/^Any robot, any world$/, "true");
  await until(/^Guess first$/, "false");
  for (const id of ["dashboard", "anatomy", "cspace", "atlas", "plan"]) {
    await lab.send({ do: "widget", id });
    await lab.until((s) => s.widget === id);
    await page.waitForTimeout(600);
    const levels = (await read(lab)).filter(({ role }) => role === "heading").map(({ level }) => level);
    assert.ok(levels[0] === 1 && levels.length > 1 && levels.every((level, i) => i === 0 || level <= levels[i - 1] + 1), `${id}: ${levels}`);
    const [current] = await rail.locator("[aria-current=page]").allTextContents();
    assert.ok(current, `${id} is on the rail`);
  }
});

lab("each formula is labelled, scrolls in its own box, and shows where it goes on", "/?tick=20", async (lab) => {
  const { page } = lab;
  const labels = await page.locator("#formulas li:not([data-at]) > span").allTextContents();
  assert.deepEqual(labels, ["Rusty:", "Reach:", "Reach, 3 joints:", "Hitch:", "Hitch, trailer:"]);
  const long = await page.locator("#formulas li:visible").evaluateAll((items) => items.map((item) => item.scrollWidth - item.clientWidth));
  const which = long.findIndex((more) => more > 20);
  assert.ok(which >= 0, `one is longer than a phone is wide: ${long}`);
  const item = page.locator("#formulas li:visible").nth(which);
  // the ink at the right edge, above and below the letters: a shadow while it goes on, paper at its end
  const edge = async () => {
    const shot = await item.screenshot();
    return page.evaluate(async (bytes) => {
      const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
      const copy = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const at = copy.getContext("2d", { willReadFrequently: true });
      at.drawImage(image, 0, 0);
      const [r] = at.getImageData(image.width - 4, 4, 1, 1).data;
      const [paper] = at.getImageData(Math.round(image.width / 2), 1, 1, 1).data;
      return paper - r;
    }, [...shot]);
  };
  const before = await edge();
  await item.evaluate((element) => element.scrollTo(9999, 0));
  await page.waitForTimeout(300);
  const after = await edge();
  assert.ok(before > 20 && after < 10, `the shadow is ${before} dark, and ${after} at the end`);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
}, { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });

lab("a seed that is none is refused once: its field is invalid, and says why until it is mended", "/", async (lab) => {
  const { page } = lab;
  await lab.send({ do: "pause" });
  await lab.until((s) => !s.playing);
  const field = page.locator("#controls label:has-text('seed') input");
  const why = "12.5: a seed is a whole number from 0 to 18446744073709551615";
  const enter = async (text) => {
    await field.focus();
    await field.fill(text);
    await field.press("Enter");
  };
  await enter("12.5");
  await page.waitForFunction((words) => document.getElementById("urgent").textContent === words, why, { timeout: 30000 });
  assert.equal(await field.getAttribute("aria-invalid"), "true");
  const description = await field.evaluate((input) => document.getElementById(input.getAttribute("aria-describedby")).textContent);
  assert.equal(description, why);
  const times = (await read(lab)).filter(({ role, name }) => role === "StaticText" && name === why).length;
  assert.equal(times, 1, "once");
  assert.equal((await lab.state()).seed, "2005");
  await enter("12");
  await lab.until((s) => s.seed === "12");
  await page.waitForFunction(() => document.getElementById("urgent").textContent === "");
  assert.deepEqual(await field.evaluate((input) => [input.getAttribute("aria-invalid"), input.getAttribute("aria-describedby")]), [null, null]);
});

lab("the way to the other elbow that is blocked is said with what blocks it, once", "/", async (lab) => {
  const { page } = lab;
  await lab.send({ do: "pause" });
  await lab.until((s) => !s.playing);
  // halfway the arm is straight and points across the post
  await lab.send({ do: "robot", robot: "Reach", teleport: [1.85, 1.4] });
  await lab.send({ do: "step" });
  await lab.until((s) => s.robots.some(({ name, coordinates }) => name === "Reach" && Math.abs(coordinates[0] - 1.85) < 0.02));
  await page.locator("#controls button", { hasText: /^Bring Reach/ }).press("Enter");
  await lab.find("the ghost has the same tip: send the arm there");
  await page.locator("#controls button", { hasText: "One tip, two elbows" }).last().press("Enter");
  const said = await lab.find(/^the straight way hits the post at s = 0\.\d+$/);
  await page.waitForFunction((words) => document.getElementById("heard").textContent === words, said.name, { timeout: 20000 });
  const times = (await read(lab)).filter(({ role, name }) => role === "StaticText" && name === said.name).length;
  assert.equal(times, 1, "once");
});
