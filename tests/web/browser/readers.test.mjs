// The page for a phone's keyboard, for keys alone, for screen readers, on paper, and where the lab does not draw.
import assert from "node:assert/strict";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, native, newBrowser, origin, shots } from "./harness.mjs";
import { digestOf, download, lab, wrong } from "./on_page.mjs";

before(begin);
after(end);

for (const scheme of ["light", "dark"]) {
  test(`axe finds nothing wrong: ${scheme}`, { timeout: 240000 }, async () => {
    const options = { colorScheme: scheme };
    const inner = await Lab.open("/?tick=200", { options });
    const found = {};
    for (const id of ["dashboard", "anatomy", "cspace", "atlas", "plan"]) {
      await inner.send({ do: "widget", id });
      await inner.until((s) => s.widget === id);
      await inner.page.waitForTimeout(500);
      found[id] = await wrong(inner.page);
    }
    await inner.page.click("#save-page").catch(() => {});
    await inner.close();
    const frame = await Lab.open("/embed.html?widget=anatomy", { options });
    found.embed = await wrong(frame.page);
    await frame.close();
    for (const [name, path, more] of [
      ["widgets", "/widgets.html", {}],
      ["book", "/book.html", {}],
      ["loading", "/", { before: (page) => page.route("**/lab.*.wasm", () => {}) }],
      ["not loaded", "/", { before: (page) => page.route("**/lab.*.wasm", (route) => route.fulfill({ status: 503 })) }],
    ]) {
      const still = await Lab.open(path, { wait: false, options, ...more });
      await still.page.waitForTimeout(1500);
      // frames are pages of their own, which are looked at as such
      found[name] = (await wrong(still.page)).filter((text) => !/ iframe/.test(text));
      await still.close();
    }
    assert.deepEqual(found, { dashboard: [], anatomy: [], cspace: [], atlas: [], plan: [], embed: [], widgets: [], book: [], loading: [], "not loaded": [] });
  });
}

lab("a tap on a number brings the phone's keyboard, and what is typed counts", "/?widget=anatomy", async (lab) => {
  const { page } = lab;
  const number = (await lab.tree()).find((w) => w.kind === "number");
  const box = await page.locator("#lab").boundingBox();
  await page.touchscreen.tap(box.x + number.place[0] + number.place[2] / 2, box.y + number.place[1] + number.place[3] / 2);
  await page.waitForFunction(() => document.activeElement.type === "number");
  assert.ok(await page.evaluate(() => Number(getComputedStyle(document.activeElement.parentElement).opacity) === 1), "what is typed is seen");
  const target = await page.evaluate(() => document.activeElement.getBoundingClientRect().height);
  assert.ok(target >= 44, `${target} points high`);
  await page.keyboard.press("ControlOrMeta+a");
  await page.keyboard.type("0.5");
  await page.keyboard.press("Enter");
  await lab.find(/th1: 0\.500/);
  assert.notEqual(await page.evaluate(() => document.activeElement.type), "number", "the keyboard goes again");
}, { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });

lab("there is one focus: where an arrow key moves the lab's, the page's goes along", "/?tick=100", async (lab) => {
  const { page } = lab;
  await page.locator("#controls button", { hasText: /^Step$/ }).focus();
  const focused = () => page.evaluate(() => document.activeElement.textContent);
  const own = async () => (await lab.tree()).find((w) => w.focus)?.name;
  await lab.page.waitForTimeout(600);
  assert.equal(await own(), "Step");
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => document.activeElement.textContent !== "Step", null, { timeout: 5000 });
  await page.waitForTimeout(500);
  assert.equal(await focused(), await own());
});

lab("names stay while they are read, numbers are valid, lists and headings are such, in the order of the screen", "/?widget=anatomy", async (lab) => {
  const { page } = lab;
  const numbers = await page.evaluate(() => [...document.querySelectorAll("#controls input[type=number], #controls input[type=range]")].map((i) => i.validity.valid));
  assert.ok(numbers.length >= 4 && numbers.every(Boolean), `${numbers}`);
  const { range } = (await lab.tree()).find((w) => w.kind === "number");
  const theta = page.locator("#controls input[type=number]").first();
  await theta.focus();
  await theta.press("ArrowUp");
  await lab.find(new RegExp(`th1: ${(Math.PI / 4 + range[2]).toFixed(3)}`.replace(".", "\\.")));
  assert.equal(await page.locator("#controls h2").textContent(), "Query anatomy");
  assert.equal(await page.locator("h1:visible").count(), 1);
  await lab.send({ do: "widget", id: "dashboard" });
  await lab.until((s) => s.widget === "dashboard");
  await page.waitForTimeout(400);
  const words = await page.evaluate(() => [...document.querySelectorAll("#controls h2, #controls button")].map((e) => e.textContent));
  const at = (name) => words.findIndex((w) => w.startsWith(name));
  assert.ok(at("Drive") < at("Dashboard") && at("Dashboard") < at("Undo") && at("Undo") < at("Menu") && at("Menu") < at("Play"), words.join(" | "));
  assert.equal(await page.locator("#controls button", { hasText: /^Reset$/ }).getAttribute("aria-pressed"), null, "Reset is no toggle");
  assert.equal(await page.locator("#controls button", { hasText: /^speed/ }).getAttribute("aria-haspopup"), "listbox");
  // the paper's name is the same while the robot moves
  const paper = page.locator("#controls button", { hasText: /Apartment\. Rusty$/ });
  const [name, said] = [await paper.textContent(), await paper.getAttribute("aria-description")];
  await lab.send({ do: "seek", tick: 200 });
  await lab.until((s) => s.tick === 200);
  await page.waitForTimeout(400);
  assert.equal(await paper.textContent(), name);
  assert.notEqual(await paper.getAttribute("aria-description"), said, "and what changes is beside it");
});

lab("what a button opens follows it: a list has options, arrows move in it, Escape returns", "/?tick=100", async (lab) => {
  const { page } = lab;
  const focused = () => page.evaluate(() => document.activeElement.textContent);
  const becomes = (text) => page.waitForFunction((t) => document.activeElement.textContent === t, text, { timeout: 5000 });
  const speed = page.locator("#controls button", { hasText: /^speed/ });
  assert.equal(await speed.textContent(), "speed: 1 x");
  await speed.focus();
  await speed.press("Enter");
  const list = page.getByRole("listbox", { name: /^speed/ });
  const options = list.getByRole("option");
  await options.first().waitFor();
  const names = await options.allTextContents();
  assert.ok(names.length >= 4 && names.includes("1 x") && names.includes("2 x"), `${names}`);
  assert.equal(await list.locator("[aria-selected=true]").textContent(), "1 x", "what is chosen");
  assert.match(await list.evaluate((e) => e.previousElementSibling.textContent), /^speed/, "it stands behind its button");
  await becomes("1 x");
  await page.keyboard.press("ArrowDown");
  await becomes(names[names.indexOf("1 x") + 1]);
  await page.keyboard.press("Home");
  await becomes(names[0]);
  await page.keyboard.press("ArrowUp");
  await becomes(names.at(-1));
  await page.keyboard.press("Escape");
  await list.waitFor({ state: "detached" });
  assert.equal(await focused(), "speed: 1 x", "back at the button, and nothing chosen");
  await speed.press("Enter");
  await becomes("1 x");
  await page.keyboard.press("ArrowDown");
  const [chosen] = [names[names.indexOf("1 x") + 1]];
  await becomes(chosen);
  await page.keyboard.press("Enter");
  await page.waitForFunction((t) => document.activeElement.textContent === t, `speed: ${chosen}`, { timeout: 5000 });
  // the menu is the next stop of Tab, not the last
  const menu = page.locator("#controls button", { hasText: /^Menu$/ });
  await menu.focus();
  await menu.press("Enter");
  const group = page.getByRole("group", { name: "Menu" });
  await group.waitFor({ state: "attached" });
  await page.waitForTimeout(300);
  await page.keyboard.press("Tab");
  assert.ok(await page.evaluate(() => document.activeElement.closest("[role=group]")?.ariaLabel === "Menu"), await focused());
  await page.keyboard.press("Escape");
  await group.waitFor({ state: "detached" });
  assert.equal(await focused(), "Menu");
});

lab("what a key does to Query's robot is said once it stands", "/?widget=anatomy", async (lab) => {
  const { page } = lab;
  const drawing = page.locator("#controls button", { hasText: /^Reach/ }).first();
  await drawing.focus();
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => /^It is free, \d\.\d{4} m away$/.test(document.getElementById("heard").textContent), null, { timeout: 5000 });
  const { query } = await lab.state();
  assert.equal(await page.textContent("#heard"), `It is free, ${query.distance.toFixed(4)} m away`);
});

lab("the configuration space's point moves by arrow keys", "/?widget=cspace", async (lab) => {
  const point = lab.page.locator("#controls button", { hasText: /^configuration space/ });
  const { coordinates } = (await lab.until((s) => s.query)).query;
  await point.focus();
  await point.press("ArrowRight");
  await lab.find(/th1: 0\.835, th2: 1\.571/);
  await point.press("Shift+ArrowDown");
  await lab.find(/th1: 0\.835, th2: 1\.566/);
  // there and back again: nothing is rounded on the way
  await point.press("Shift+ArrowUp");
  await point.press("ArrowLeft");
  await lab.until((s) => s.query.coordinates.every((x, i) => Math.abs(x - coordinates[i]) < 1e-9));
  assert.match(await lab.page.evaluate(() => document.activeElement.textContent), /^configuration space/);
  assert.equal(await lab.page.textContent("#alert"), "", "Shift alone is no key of the lab's");
});

lab("the atlas's robot, the point that it measures and what is selected move by arrow keys", "/?widget=atlas", async (lab) => {
  const paper = lab.page.locator("#controls button", { hasText: /^World Apartment/ });
  const press = async (...keys) => {
    await paper.focus();
    for (const key of keys) await paper.press(key, { delay: 120 });
  };
  // Rusty starts at 2.25, 6.25; a step is 5 cm, a turn a 24th of a whole one
  await press("ArrowRight", "ArrowDown", "Shift+ArrowLeft");
  await lab.find(/x: {2}2\.300, y: {2}6\.200, theta: {2}0\.262/);
  await lab.click("Measure");
  await press("ArrowLeft", "ArrowLeft");
  await lab.find(/^At x 5\.90, y 4\.00 m: exact 0\.\d+ m/);
  await lab.click("Edit");
  await lab.page.locator("#controls button", { hasText: "Add disc" }).press("Enter");
  await lab.find("disc: radius");
  await press("ArrowUp");
  // from the middle of 8 m, where a key adds it
  for (let i = 0; i < 100 && Number((await lab.find("disc: y")).value) !== 4.05; i++) await lab.page.waitForTimeout(50);
  assert.equal(Number((await lab.find("disc: y")).value), 4.05);
  await lab.find(/disc is selected/);
  await press("Delete");
  await lab.find("name of the world");
  assert.equal(await lab.page.textContent("#alert"), "");
});

lab("paper gets a figure instead of a canvas", "/?tick=200", async (lab) => {
  const { page } = lab;
  await page.evaluate(() => {
    // the frame before the lab is shown: it is there, and may be asked for its figure
    document.documentElement.dataset.lab = "loading";
    window.print = () => {
      document.documentElement.dataset.lab = "running";
      window.dispatchEvent(new Event("beforeprint"));
      window.printed = true;
    };
  });
  await page.keyboard.press("Control+p");
  await page.waitForFunction(() => window.printed, null, { timeout: 20000 });
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator("canvas").isVisible(), false);
  const [width, height] = await page.evaluate(() => [document.getElementById("figure").naturalWidth, document.getElementById("figure").getBoundingClientRect().height]);
  assert.ok(width > 300 && height > 200, `${width} ${height}`);
  assert.match(await page.textContent("#caption"), /^Dashboard: seed 2005, tick 200\./);
  await page.screenshot({ path: join(shots, "paper.png"), fullPage: true });
  // from the browser's menu there is no time to draw: the still picture of the same widget
  await page.evaluate(() => (window.dispatchEvent(new Event("afterprint")), window.dispatchEvent(new Event("beforeprint"))));
  assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("#still figure")].filter((f) => f.checkVisibility()).map((f) => f.id)), ["dashboard"]);
});

lab("a saved minute is small, plays, and opens in the lab", "/?seed=3&tick=1200", async (lab) => {
  const { frontier } = await lab.until((s) => s.tick === 1200);
  const saved = await download(lab.page, () => lab.page.click("#save-page"));
  const html = readFileSync(saved.path, "utf8");
  console.log(`# ${html.length} bytes`);
  assert.ok(html.length < 3e6, `${html.length} bytes`);
  const file = join(shots, "minute.html");
  writeFileSync(file, html);
  const page = await Lab.open(`file://${file}`, { wait: false });
  await page.page.waitForFunction(() => document.documentElement.dataset.verdict, null, { timeout: 60000 });
  assert.match(await page.page.textContent("#verdict"), /^Verified: bit-identical, 1200 of 1200/);
  const picture = () => page.page.getAttribute("#picture img", "src");
  const last = await picture();
  await page.page.click("#play");
  await page.page.waitForFunction(() => Number(document.documentElement.dataset.tick) > 6);
  await page.page.click("#play");
  assert.notEqual(await picture(), last);
  // its figure at the end is that of the whole run
  await page.page.evaluate(() => {
    const line = document.getElementById("line");
    line.value = 1200;
    line.dispatchEvent(new Event("input"));
  });
  const log = join(shots, "minute.mcap");
  rmSync(log, { force: true });
  native("record", "--seed", "3", "--seconds", "60", "-o", log);
  assert.ok(decodeURIComponent(await picture()).includes(digestOf(await page.page.textContent("#verdict"))), "with the run's digest");
  assert.match(native("info", log), new RegExp(digestOf(await page.page.textContent("#verdict"))));
  assert.deepEqual(await page.close(), []);
  // in a frame without an address of its own, as a notebook shows it
  const notebook = await lab.page.context().newPage();
  await notebook.setContent("<iframe></iframe>");
  await notebook.locator("iframe").evaluate((frame, text) => void (frame.srcdoc = text), html);
  await notebook.frameLocator("iframe").locator("html[data-verdict=verified]").waitFor({ state: "attached", timeout: 60000 });
  await notebook.close();
  await lab.send({ do: "seed", seed: "4" });
  await lab.until((s) => s.seed === "4");
  await lab.page.evaluate((text) => window.motionLab.open(new File([text], "minute.html")), html);
  const { notice } = await lab.until((s) => s.seed === "3" && s.notice?.text.startsWith("minute.html"), 60000);
  assert.match(notice.text, /bit-identical, 1200 of 1200/);
  assert.equal(frontier, 1200);
});

test("without WebGL 2 a frame shows its own widget, says why, and checks the link's run by the simulator", { timeout: 120000 }, async () => {
  const bare = await newBrowser(["--disable-3d-apis"]);
  const log = join(shots, "linked.mcap");
  rmSync(log, { force: true });
  native("record", "--seed", "7", "--seconds", "5", "-o", log);
  const digest = /[0-9a-f]{32}/.exec(native("verify", log))?.[0] ?? digestOf(native("info", log));
  for (const [given, verdict] of [[digest, "verified"], ["0".repeat(32), "differs"]]) {
    const lab = await Lab.open(`${origin()}/embed.html?seed=7&tick=100&widget=atlas&digest=${given}`, { wait: false, from: bare });
    await lab.page.waitForFunction(() => document.documentElement.dataset.verdict, null, { timeout: 60000 });
    assert.equal(await lab.page.evaluate(() => document.documentElement.dataset.verdict), verdict);
    assert.ok((await lab.page.textContent("#run-text")).includes(`tick 100, digest ${digest}`));
    assert.ok(await lab.page.locator("#alert").isVisible());
    assert.match(await lab.page.textContent("#alert"), /no WebGL 2/);
    assert.deepEqual(await lab.page.evaluate(() => [...document.querySelectorAll("#still figure")].filter((f) => f.checkVisibility()).map((f) => f.id)), ["atlas"]);
    assert.ok(await lab.page.evaluate(() => document.getElementById("run-figure").decode().then(() => document.getElementById("run-figure").naturalWidth > 300)));
    await lab.shot(`bare-${verdict}`);
    await lab.close();
  }
  await bare.close();
});

test("without script a frame shows the one widget that its address names", { timeout: 60000 }, async () => {
  const lab = await Lab.open("/embed.html?widget=cspace#cspace", { wait: false, options: { javaScriptEnabled: false } });
  const shown = [];
  for (const figure of await lab.page.locator("#still figure").all()) if (await figure.isVisible()) shown.push(await figure.getAttribute("id"));
  assert.deepEqual(shown, ["cspace"]);
  await lab.close();
});

test("a run that starts again is checked to its end before it goes to its tick", { timeout: 180000 }, async () => {
  const lab = await Lab.open("/?seed=5&tick=3000");
  await lab.until((s) => s.tick === 3000, 60000);
  await lab.send({ do: "seek", tick: 17 });
  await lab.until((s) => s.tick === 17);
  await lab.page.waitForTimeout(300);
  await Promise.all([lab.page.waitForEvent("load"), lab.page.evaluate(() => document.getElementById("lab").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext())]);
  const { notice } = await lab.until((s) => s.tick === 17 && s.frontier === 3000 && s.notice, 90000);
  assert.match(notice.text, /^the run before: bit-identical, 3000 of 3000/);
  await lab.close();
});

lab("a paused lab takes at most a hundredth of a core", "/?tick=200", async (lab) => {
  await lab.page.waitForTimeout(9000);
  const frames = await lab.page.evaluate(
    () =>
      new Promise((done) => {
        let frames = 0;
        const context = document.getElementById("lab").getContext("webgl2");
        const real = context.drawElements.bind(context);
        context.drawElements = (...words) => (frames++, real(...words));
        setTimeout(() => done(frames), 12000);
      }),
  );
  assert.equal(frames, 0, "it draws nothing while nothing happens");
  const session = await lab.context.newCDPSession(lab.page);
  await session.send("Performance.enable");
  const busy = async () => (await session.send("Performance.getMetrics")).metrics.find((m) => m.name === "TaskDuration").value;
  // up to three times: what else the machine does lengthens what is measured
  let share = 1;
  for (let i = 0; i < 3 && share > 0.01; i++) {
    const before = await busy();
    await lab.page.waitForTimeout(5000);
    share = Math.min(share, ((await busy()) - before) / 5);
  }
  console.log(`# ${(100 * share).toFixed(2)} % of a core`);
  assert.ok(share <= 0.01, `${100 * share} %`);
  // and it wakes at once
  await lab.send({ do: "play" });
  await lab.until((s) => s.tick > 205);
});

test("nothing is loaded twice, and the lab is asked for by the page itself, before its script has run", { timeout: 120000 }, async () => {
  const asked = [];
  const lab = await Lab.open("/", { before: async (page) => page.on("request", (r) => asked.push(r.url())) });
  const twice = asked.filter((url, i) => asked.indexOf(url) !== i && !/favicon/.test(url));
  assert.deepEqual(twice, []);
  const started = (name) => lab.page.evaluate((n) => performance.getEntriesByType("resource").find((e) => e.name.includes(n)), name);
  const [wasm, script] = [await started("/lab.") && (await started(".wasm")), await started("/page.")];
  assert.equal(wasm.initiatorType, "link");
  assert.ok(wasm.startTime < script.responseEnd, `${wasm.startTime} ${script.responseEnd}`);
  assert.deepEqual(await lab.close(), []);
});
