// The book: its numbers are the lab's, and its figures are the lab.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, origin } from "./harness.mjs";
import { seen, within } from "./on_book.mjs";
import { lab } from "./on_page.mjs";
import { book, region } from "../../../assets/web/book/build.mjs";

before(begin);
after(end);

const ROOT = join(import.meta.dirname, "../../..");
const CHAPTER = readFileSync(join(ROOT, "book/chapter.md"), "utf8");

const modules = execFileSync(join(ROOT, "assets/web/book/modules"), { encoding: "utf8" }).trim();

/** What the build says of a chapter's text; nothing where it is right. */
function built(text) {
  try {
    book(text, { native: process.env.MOTION_LAB_NATIVE, modules });
    return "";
  } catch (error) {
    return error.message;
  }
}

/** The chapter with one part of it in other words. */
function changed(from, to) {
  assert.ok(CHAPTER.includes(from), from);
  return CHAPTER.replace(from, to);
}

test("a digit that is not the lab's is named by its sentence, and so is a number that nothing stands behind", { timeout: 120000 }, () => {
  assert.equal(built(CHAPTER), "");
  const digit = built(changed("{0.0607 m: reading live query.distance} to the", "{0.0617 m: reading live query.distance} to the"));
  assert.match(digit, /0\.0617 m is 0\.0607 by reading/);
  assert.match(digit, /in: For the \[arm\].* to the \[block\]\(role:obstacle\)\.$/);
  assert.match(built(changed("{(0.5, 1.0): corner}", "{(1.0, 0.5): corner}")), /\(1\.0, 0\.5\) is 0\.5 by corner/);
  assert.match(built(changed("\\bind{0.0607}{byhand}", "\\bind{0.0608}{byhand}")), /0\.0608 is 0\.0607 by byhand/);
  assert.match(built(changed("\\bind{0.0607}{byhand}", "0.0607")), /0\.0607 in a formula is bound to nothing/);
  assert.match(built(changed("one metre before it.", "1 m before it.")), /1 m is bound to nothing\n {2}in: A wall stands at \$x = 3\$;/);
  assert.match(built(changed("{18: armcontacts}", "{17: armcontacts}")), /17 is 18 by armcontacts \(record/);
  assert.match(built(changed("{?: thick 0.0307 m}", "{?: thick 0.0306 m}")), /0\.0306 m is 0\.0307/);
  assert.match(built(changed("{3 cm: thickness}", "{3 mm: thickness}")), /3 mm is 30 by thickness/);
  assert.match(built(changed("task: trailer_at", "task: trailer_in")), /trailer_in is no task; they are trailer_at, /);
  assert.match(built(changed("trailer_at hitch, beside", "trailer_at hitch, nearby")), /no fact is called nearby/);
  assert.match(built(changed("{89: rounds}", "{88: rounds}")), /88 is 89 by rounds \(tests\/pinned\/bug1\.txt\)/);
  assert.match(built(changed("(role:robot) of a robot", "(move:nowhere) of a robot")), /no figure above is called nowhere/);
});

test("a digit that changes in a world is named by the sentence that tells it", { timeout: 120000 }, () => {
  const folder = mkdtempSync(join(tmpdir(), "world-"));
  const moved = join(folder, "wall.ron");
  writeFileSync(moved, readFileSync(join(ROOT, "book/one_wall.ron"), "utf8").replace("(3, 0), (3, 3)", "(3.01, 0), (3.01, 3)"));
  // three facts follow from that wall: Rusty's radius, told first, its distance and the witness
  const told = built(CHAPTER.replaceAll("book/one_wall.ron", moved));
  rmSync(folder, { recursive: true });
  assert.match(told, /0\.11 m is 0\.10 by radius/);
  assert.match(told, /in: It is held one radius before, \{0\.11 m: radius\} for Rusty/);
});

test("a part of a program ends with its paragraph or its block", () => {
  const walk = region("examples/redundancy_walk.rs", "the start's solution among [elbow-down, elbow-up]").split("\n");
  assert.equal(walk.at(-1), "walk", "without the brace of the function around");
  assert.ok(walk.every((line) => !line.startsWith(" ") || line.startsWith("    ")) && walk[1].startsWith("let side"), walk.join("\n"));
  const scene = region("examples/lab_tour.rs", "a scratch scene with the worked example's square, which is also the Workbench's block");
  assert.ok(scene.includes("let w = ") && !scene.includes("\n\n"));
});

lab("nothing of the lab is loaded before a figure is touched, and the first view weighs at most 100 kB", "/", async ({ page }) => {
  // the page that was open may still be loading the lab
  await page.goto("about:blank");
  const loaded = [];
  page.on("response", async (response) => loaded.push({ url: response.url(), bytes: Number(response.headers()["content-length"]) }));
  await page.goto(`${origin()}/book.html`);
  await page.waitForSelector("#dots a[title]"); // the page's script has run
  await page.waitForTimeout(500);
  assert.ok(loaded.length > 5);
  assert.deepEqual(loaded.filter(({ url }) => /wasm|\/lab\.|\/light\./.test(url)), []);
  const bytes = loaded.reduce((sum, { bytes }) => sum + bytes, 0);
  assert.ok(bytes < 100_000, `${bytes} bytes`);
}, { wait: false });

lab("a figure's numbers, words and links are one with it", "/", async ({ page }) => {
  const frame = await within(page, "witness");
  const number = page.locator('.live[data-live="query.distance"]').last();
  await seen(frame, () => window.received.state?.query?.tab === "witness");
  assert.equal(await number.textContent(), "0.0607 m");
  assert.equal(await number.getAttribute("data-moved"), null);

  // by hand: the second link turns about the elbow, and its line passes the block's corner at |(corner - elbow) x direction|
  const reads = (text) => page.waitForFunction((text) => [...document.querySelectorAll('.live[data-live="query.distance"]')].at(-1).textContent === text, text);
  const byHand = (elbow) => {
    const [dx, dy, heading] = [0.5 - Math.SQRT1_2, 1 - Math.SQRT1_2, Math.PI / 4 + elbow];
    return `${Math.abs(dx * Math.sin(heading) - dy * Math.cos(heading)).toFixed(4)} m`;
  };
  await page.click("text=stretch the elbow");
  await reads(byHand(1.48));
  // it touches below 1.4009 rad
  await page.click("text=until it touches");
  await reads("0.0000 m");
  await page.click("text=stretch the elbow");
  await reads(byHand(1.48));
  assert.equal(await number.getAttribute("data-moved"), "");
  assert.match(await number.getAttribute("title"), /0\.0607 m/);

  await page.hover("#witness figcaption .role-witness");
  await seen(frame, () => window.received.state.lit === "witness");
  assert.equal(await page.locator("#witness figcaption .role-witness").getAttribute("data-lit"), "");
  await page.mouse.move(5, 500);
  await seen(frame, () => window.received.state.lit === null);
  await frame.evaluate(() => window.motionLab.send({ do: "light", role: "obstacle" }));
  await page.waitForSelector(".term.role-obstacle[data-lit]");
}, { wait: false, timeout: 240000 });

// a figure that stands still has a frame with the simulator alone, the others have the lab's
for (const { first, second, moved, isMoved, other } of [
  { first: "witness", second: "torus", moved: { do: "configuration", coordinates: [0.5, 1.25] }, isMoved: () => window.received.state.query?.coordinates[0] === 0.5, other: "cspace" },
  { first: "tour", second: "worlds", moved: { do: "seek", tick: 300 }, isMoved: () => window.received.state.widget === "dashboard" && window.received.state.tick === 300, other: "atlas" },
]) {
  lab(`one frame serves the figure that is read; the others keep their last picture and are found as they were left: ${first}`, "/", async ({ page }) => {
    const frame = await within(page, first);
    await frame.waitForFunction(() => window.received.state);
    await frame.evaluate((message) => window.motionLab.send(message), moved);
    await seen(frame, isMoved);
    const still = await page.getAttribute(`#${first} img`, "src");
    await page.click(`#${second} motion-figure`);
    await seen(frame, (widget) => window.received.state.widget === widget, other);
    await page.waitForFunction((id) => document.querySelector(`#${id} img`).src.startsWith("blob:"), first);
    assert.notEqual(await page.getAttribute(`#${first} img`, "src"), still);
    assert.equal(await page.locator("iframe").count(), 1);
    // once the page's own pictures are there and nothing moves any more
    const liesOver = (id) =>
      page.waitForFunction((id) => {
        const [outer, inner] = [`#${id} motion-figure`, "iframe"].map((selector) => document.querySelector(selector).getBoundingClientRect());
        return ["left", "top", "width", "height"].every((side) => Math.abs(outer[side] - inner[side]) < 1);
      }, id, { timeout: 5000 });
    await liesOver(second);
    // who scrolls back finds the first figure at work again
    await page.evaluate(() => document.activeElement.blur());
    await page.locator(`#${first}`).scrollIntoViewIfNeeded();
    await page.evaluate((id) => document.querySelector(`#${id} motion-figure`).scrollIntoView({ block: "center" }), first);
    await seen(frame, isMoved);
    await liesOver(first);
    assert.equal(page.frames().length, 2, "no second frame was made");
  }, { wait: false, timeout: 240000 });
}

lab("the lab rests while a figure that stands still is read, and takes that figure over when it is asked to", "/", async ({ page }) => {
  const whole = await within(page, "tour");
  await seen(whole, () => window.received.state?.widget === "dashboard");
  await whole.evaluate(() => window.motionLab.send({ do: "play" }));
  await seen(whole, () => window.received.state.playing);
  await page.click("#witness motion-figure");
  await page.waitForSelector('iframe[src*="lens.html"]:not([data-waits])', { timeout: 20000 });
  await seen(whole, () => !window.received.state.playing);
  const inertness = () => page.evaluate(() => [...document.querySelectorAll("iframe")].map((frame) => [frame.src.includes("lens.html"), frame.inert]));
  assert.deepEqual(await inertness(), [[false, true], [true, false]]);

  const frame = page.frames().find((other) => other.url().includes("lens.html"));
  await frame.evaluate(() => window.motionLab.send({ do: "configuration", coordinates: [0.5, 1.25] }));
  await seen(frame, () => window.received.state.query.coordinates[0] === 0.5);
  await frame.click("#whole");
  await seen(whole, () => window.received.state.widget === "anatomy" && String(window.received.state.query?.coordinates) === "0.5,1.25");
  await page.waitForSelector('iframe[src*="embed.html"]:not([data-waits])');
  assert.deepEqual(await inertness(), [[false, false], [true, true]]);
  // it stays the lab's, and its numbers follow the lab
  await whole.evaluate(() => window.motionLab.send({ do: "configuration", coordinates: [0.7853981633974483, 2] }));
  // the corner is 0.2963 m along the second link and 0.2023 m off it; where the arm stood before, it touched
  await page.waitForFunction(() => [...document.querySelectorAll('.live[data-live="query.distance"]')].at(-1).textContent === "0.2023 m");
}, { wait: false, timeout: 240000 });

lab("a lab that is left before it is there rests; a lens that can't be loaded is the lab's", "/", async (open) => {
  const { page } = open;
  await page.goto(`${origin()}/book.html`);
  await page.click("#three motion-figure");
  await page.waitForSelector('iframe[src*="embed.html"]', { state: "attached" });
  await page.click("#witness motion-figure");
  await page.waitForSelector('iframe[src*="lens.html"]:not([data-waits])', { timeout: 20000 });
  const whole = page.frames().find((other) => other.url().includes("embed.html"));
  await seen(whole, () => window.received.kinds.includes("ready") && window.received.state && !window.received.state.playing);
  // both figures are as high as what is in them
  const lens = page.frames().find((other) => other.url().includes("lens.html"));
  const fits = async (id) => {
    await page.click(`#${id} motion-figure`);
    await lens.waitForFunction((id) => window.received.state?.widget === (id === "witness" || id === "swept" ? "anatomy" : "cspace"), id);
    await page.waitForFunction((id) => Math.abs(document.querySelector(`#${id} motion-figure`).getBoundingClientRect().height - frames[[...document.querySelectorAll("iframe")].findIndex((frame) => frame.src.includes("lens.html"))].document.documentElement.querySelector("#lens").getBoundingClientRect().height - 22) < 4, id, { timeout: 10000 });
  };
  for (const id of ["torus", "annulus"]) await fits(id);

  await page.route(/\/light\..*\.wasm/, (route) => route.abort());
  await page.goto(`${origin()}/book.html?again`);
  await page.click("#witness motion-figure");
  await page.waitForSelector('iframe[src*="embed.html"]:not([data-waits])', { timeout: 60000 });
  await page.click("#torus motion-figure");
  await seen(page.frames().find((other) => other.url().includes("embed.html")), () => window.received.state?.widget === "cspace");
  const refused = open.faults.splice(0);
  assert.ok(refused.length > 0 && refused.every((fault) => fault.includes("ERR_FAILED")), refused.join("; "));
}, { wait: false, timeout: 240000 });

lab("a figure is one stop of Tab: Enter goes in, Escape out", "/", async ({ page }) => {
  await page.goto(`${origin()}/book.html`);
  const stops = await page.evaluate(() => [...document.querySelectorAll("figure.lab a, figure.lab button:not(.term), figure.lab [tabindex]")].filter((e) => e.tabIndex >= 0 && !e.closest("figcaption")).length);
  assert.equal(stops, await page.locator("figure.lab").count());
  await page.focus("#witness motion-figure a");
  await page.keyboard.press("Enter");
  await page.waitForSelector("iframe:not([data-waits])", { timeout: 90000 });
  await page.waitForFunction(() => document.activeElement.matches("iframe"));
  // the keys come to the frame a moment after the page says so
  await seen(page.frames()[1], () => document.hasFocus() && document.activeElement.classList.contains("lens-paper"));
  await page.keyboard.press("Escape");
  await page.waitForFunction(() => document.activeElement.matches("#witness motion-figure a"));
  await page.keyboard.press("Tab");
  assert.ok(!(await page.evaluate(() => document.activeElement.matches("iframe"))), "Tab goes on in the text");
}, { wait: false, timeout: 240000 });

lab("answers are judged where they stand and kept; the dots tell, to a page around too", "/book.html", async ({ page }) => {
  const answer = page.locator(".answer").first();
  const give = async (text) => {
    await answer.locator("input").fill(text);
    await answer.locator("input").press("Tab");
    return answer.locator("output").textContent();
  };
  assert.match(await give("0.0607"), /Not yet/);
  assert.equal(await answer.locator("input").getAttribute("aria-invalid"), "true");
  assert.equal(await answer.locator("input").getAttribute("aria-label"), "Your answer: The example by hand");
  for (const text of ["three", "", "3 apples", "0.03 rad", "m"]) assert.equal(await give(text), "Give a number, in m.", text);
  // 3 cm would be 0.030 m, if as many digits count as are given
  for (const text of ["3.07 cm", "30.7mm", "0.0307 m", ".0307", "0.031"]) assert.match(await give(text), /Right: 0\.0307 m/, text);
  for (const text of ["3.07", "3.07 mm", "-0.0307 m", "2 cm"]) assert.match(await give(text), /Not yet/, text);
  assert.match(await give("0,0307"), /Right: 0\.0307 m/, "a comma is a point");
  const dot = page.locator('#dots a[href="#the-example-by-hand"]').locator("..");
  assert.equal(await dot.getAttribute("data-done"), "");
  await page.reload();
  await dot.and(page.locator("[data-done]")).waitFor({ timeout: 10000 }); // kept
  await page.evaluate(() => {
    addEventListener("message", ({ data }) => (window.heardProgress = data.motionLab ?? window.heardProgress));
    const frame = document.createElement("iframe");
    frame.src = "book.html";
    document.body.append(frame);
  });
  const told = await page.waitForFunction(() => window.heardProgress).then((handle) => handle.jsonValue());
  assert.equal(told.kind, "progress");
  assert.deepEqual(told.done, ["answer-1"]);
  assert.ok(told.of.includes("witness") && told.of.includes("answer-5"));
}, { wait: false });

lab("the book fits a phone of 320 points, and its long formulas and code scroll in their own boxes", "/book.html", async ({ page }) => {
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  const cut = await page.evaluate(() => [...document.querySelectorAll("main *")].filter((e) => e.getBoundingClientRect().right > 321 && !e.closest("pre, table, .formula")).map((e) => e.outerHTML.slice(0, 80)));
  assert.deepEqual(cut, []);
  // and keys reach them
  const scrolled = await page.evaluate(() => [...document.querySelectorAll("pre, table, .formula")].filter((e) => e.scrollWidth > e.clientWidth).map((e) => [e.tagName, e.tabIndex]));
  assert.ok(scrolled.length > 5);
  assert.deepEqual(scrolled.filter(([, tabIndex]) => tabIndex < 0), []);
}, { wait: false, options: { viewport: { width: 320, height: 640 } } });

lab("on paper no code is cut off, no figure keeps room for a button, and answers are open", "/book.html", async ({ page }) => {
  const blocks = () => page.evaluate(() => [...document.querySelectorAll("pre")].filter((pre) => pre.scrollWidth > pre.clientWidth).length);
  assert.ok((await blocks()) > 1, "on this screen some scroll");
  await page.emulateMedia({ media: "print" });
  assert.equal(await blocks(), 0);
  for (const what of ["nav", ".try", ".then"]) assert.ok(!(await page.locator(what).first().isVisible()), what);
  for (const answer of await page.locator("details > p").all()) assert.ok((await answer.boundingBox()).height > 20);
  const rooms = await page.evaluate(() => [...document.querySelectorAll("motion-figure")].map((figure) => figure.getBoundingClientRect().bottom - figure.querySelector("img").getBoundingClientRect().bottom));
  assert.ok(rooms.length === 10 && rooms.every((room) => room < 4), String(rooms));
}, { wait: false, options: { viewport: { width: 680, height: 900 } } });

test("without script the book is whole: pictures, formulas, numbers, and links that open the lab", { timeout: 120000 }, async () => {
  const open = await Lab.open("/book.html", { wait: false, options: { javaScriptEnabled: false } });
  const { page } = open;
  const figures = page.locator("figure.lab");
  for (let i = 0; i < (await figures.count()); i++) {
    const frame = figures.nth(i).locator("motion-figure > a");
    await frame.scrollIntoViewIfNeeded();
    assert.match(await frame.getAttribute("href"), /^index\.html\?widget=\w+/);
    assert.ok((await frame.locator("img").boundingBox()).height > 150, "its still has a height");
  }
  assert.ok((await page.locator("math").count()) > 40);
  assert.equal(await page.locator('a[data-moves="witness"]').first().getAttribute("href"), "index.html?widget=anatomy&tab=witness&q=0.7853981633974483,1.48");
  for (const link of await page.locator("#dots a").all()) {
    const section = await link.getAttribute("href");
    assert.equal(await page.locator(section).count(), 1, section);
  }
  assert.deepEqual(await open.close(), []);
});
