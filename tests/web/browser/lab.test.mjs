// The lab in a browser, as readers use it.
import assert from "node:assert/strict";
import { request } from "node:http";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, native, newBrowser, origin, shots } from "./harness.mjs";
import { digestOf, download, lab } from "./on_page.mjs";

before(begin);
after(end);

const rusty = (s) => s.robots.find((r) => r.name === "Rusty");

lab("loads, plays, and its first frame is soon there", "/", async (lab) => {
  const first = await lab.page.evaluate(() => performance.getEntriesByName("first-frame")[0].startTime);
  console.log(`# first frame after ${Math.round(first)} ms`);
  assert.ok(first < 60000);
  const { tick } = await lab.state();
  await lab.until((s) => s.tick > tick + 10);
  assert.equal(await lab.page.locator("#loading").isVisible(), false);
  await lab.shot("light-desktop");
  const colours = await lab.page.evaluate(() => {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [200, 200];
    return new Promise((done) =>
      requestAnimationFrame(() => {
        const at = copy.getContext("2d");
        at.drawImage(document.getElementById("lab"), 0, 0, 200, 200);
        done(new Set(at.getImageData(0, 0, 200, 200).data).size);
      }),
    );
  });
  console.log(`# ${colours} different byte values in the canvas`);
});

lab("Rusty and Hitch are driven by keys, Reach by dragging", "/?seed=7", async (lab) => {
  await lab.send({ do: "pause" });
  await lab.send({ do: "seek", tick: 0 });
  await lab.click(/^Apartment\. Rusty/, [0.1, 0.2]);
  await lab.until((s) => s.armed === "Rusty");
  await lab.send({ do: "play" });
  await lab.page.keyboard.down("ArrowUp");
  await lab.until((s) => s.robots.some((r) => r.name === "Rusty" && r.driven) && s.tick > 30);
  await lab.page.keyboard.up("ArrowUp");
  await lab.page.keyboard.press("Escape");
  await lab.until((s) => s.armed === null);
  await lab.click(/^Bring Hitch/);
  await lab.click(/^Lot\. Hitch/, [0.1, 0.1]);
  await lab.until((s) => s.armed === "Hitch");
  await lab.page.keyboard.down("ArrowDown");
  await lab.until((s) => s.robots.some((r) => r.name === "Hitch" && r.driven));
  await lab.page.keyboard.up("ArrowDown");
  await lab.send({ do: "pause" });
  const before = (await lab.until((s) => !s.playing)).robots.find((r) => r.name === "Reach").configuration;
  await lab.click(/^Bring Reach/);
  const from = await lab.at("Reach: tip, θ₂ in radians");
  await lab.drag(from, [from[0] - 60, from[1] + 50]);
  await lab.send({ do: "step" });
  const after = (await lab.until((s) => s.robots.some((r) => r.name === "Reach" && r.driven))).robots.find((r) => r.name === "Reach").configuration;
  assert.notEqual(after, before);
});

lab("what is driven here is saved, and verifies natively to the same digest", "/", async (lab) => {
  await lab.click(/^Apartment\. Rusty/, [0.1, 0.2]);
  await lab.page.keyboard.down("ArrowUp");
  await lab.until((s) => s.tick > 60);
  await lab.page.keyboard.up("ArrowUp");
  await lab.page.keyboard.down("ArrowLeft");
  await lab.until((s) => s.tick > 90);
  await lab.page.keyboard.up("ArrowLeft");
  await lab.send({ do: "pause" });
  await lab.until((s) => !s.playing);
  // a door closed by hand is part of the run; the robot is let go first, so that its own links move no more
  await lab.page.keyboard.press("Escape");
  await lab.until((s) => s.armed === null);
  // a slow machine may draw no frame between press and release, and then there was no click
  for (let tries = 0; tries < 8 && !(await lab.tree()).some((w) => w.name === "open door B"); tries++) {
    await lab.page.mouse.move(...(await lab.at("close door B")));
    await lab.page.waitForTimeout(300);
    await lab.page.mouse.down();
    await lab.page.waitForTimeout(500);
    await lab.page.mouse.up();
    await lab.page.waitForTimeout(300);
    await lab.send({ do: "step" });
    await lab.page.waitForTimeout(700);
  }
  await lab.at("open door B");
  const { path } = await download(lab.page, () => lab.page.click("#save-run"));
  const { notice } = await lab.until((s) => s.notice);
  const log = join(shots, "driven.mcap");
  writeFileSync(log, readFileSync(path));
  const said = native("verify", log);
  console.log(`# ${notice.text}; natively: ${said.trim().split("\n").join(" / ")}`);
  assert.ok(/bit-identical/.test(said));
  assert.ok(native("info", log).includes(digestOf(notice.text)), "the same digest natively");
  assert.match(native("info", log), /, 1 change of worlds/);
  // and it is opened by dropping it
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate(async (text) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "dropped.mcap"));
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, bytes);
  const opened = await lab.until((s) => s.notice && s.notice.text.startsWith("dropped.mcap"));
  assert.match(opened.notice.text, /^dropped\.mcap: bit-identical, (\d+) of \1$/);
  assert.equal(opened.tick, 0);
  // bytes that are no log are refused in place and lose nothing
  await lab.page.evaluate(() => window.motionLab.open(new File([new Uint8Array(100)], "nonsense.mcap")));
  const refused = await lab.until((s) => s.notice && s.notice.error);
  assert.match(refused.notice.text, /^nonsense\.mcap: not opened/);
  assert.equal(refused.frontier, opened.frontier);
});

lab("a run that is opened with its script and its range sensor is kept whole by the page", "/", async (lab) => {
  const script = "tests/scripts/driving.ron";
  const log = join(shots, "scripted.mcap");
  rmSync(log, { force: true });
  native("record", "--seed", "3", "--seconds", "20", "--script", script, "--rays", "90", "-o", log);
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate((text) => {
    const file = new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "scripted.mcap");
    return window.motionLab.open(file);
  }, bytes);
  await lab.until((s) => s.seed === "3" && s.notice?.text.startsWith("scripted.mcap"));
  await lab.send({ do: "seek", tick: 120 });
  await lab.until((s) => s.tick === 120);
  await lab.send({ do: "save" });
  const { notice } = await lab.until((s) => s.notice?.text.startsWith("run.mcap"));
  const page = await lab.page.evaluate(() => window.motionLab.savedPage());
  console.log(`# ${notice.text}`);
  assert.ok(page.includes(digestOf(notice.text)), "the page would record the same run");
  // as far as a link goes, and no further
  await lab.send({ do: "seek", tick: 72001 });
  const refused = await lab.until((s) => s.notice?.error);
  assert.equal(refused.notice.text, "tick 72001: at most 72000");
});

lab("a contact is explained as the program explains it, and its way out is a branch without it", "/", async (lab) => {
  const [script, log] = [join(shots, "crash.ron"), join(shots, "crash.mcap")];
  rmSync(log, { force: true });
  writeFileSync(script, 'Script(version: 1, events: [(tick: 1, robot: "Rusty", input: Drive(128, 0))])');
  native("record", "--script", script, "--seconds", "4", "-o", log);
  const expected = JSON.parse(native("why", log, "--robot", "Rusty", "--contact", "1", "--json"));
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate((text) => {
    const file = new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "crash.mcap");
    return window.motionLab.open(file);
  }, bytes);
  await lab.until((s) => s.frontier === 80 && s.notice?.text.startsWith("crash.mcap"));
  await lab.send({ do: "seek", tick: expected.tick });
  await lab.until((s) => s.tick === expected.tick);
  await lab.send({ do: "why" });
  const { why } = await lab.until((s) => s.why);
  assert.deepEqual([why.robot, why.contact, why.last_chance], ["Rusty", expected.tick, expected.going_on.last_chance]);
  assert.match(why.text, /^Rusty meets the wall between A and B at .* steer away until/);
  await lab.send({ do: "way_out" });
  const free = expected.going_on.free_until;
  const after = await lab.until((s) => s.tick >= free);
  assert.equal(after.robots.find((r) => r.name === "Rusty").contacts, 0);
  assert.equal(after.why, null);
});

lab("a robot is put by a click in the atlas, and refused where it would overlap", "/?widget=atlas", async (lab) => {
  const paper = await lab.find(/^World Apartment/);
  const refusals = [];
  for (let u = 0.05; u < 1; u += 0.1) {
    for (const v of [0.25, 0.5, 0.75]) {
      await lab.click(/^World Apartment/, [u, v]);
      await lab.page.waitForTimeout(60);
    }
    // the words are there from the second frame on, and frames are slow here
    await lab.page.waitForTimeout(400);
    const words = (await lab.tree()).map((w) => w.name).filter((n) => /^would overlap/.test(n));
    refusals.push(...words);
  }
  assert.ok(paper && refusals.length > 0, "somewhere something is in the way");
  console.log(`# ${refusals[0]}`);
  assert.match(refusals[0], /would overlap .+/);
});

lab("the time line goes back to any tick, and Continue drives on from there", "/", async (lab) => {
  await lab.until((s) => s.tick > 40);
  await lab.send({ do: "pause" });
  const { frontier } = await lab.until((s) => !s.playing);
  const line = await lab.at("time line, in ticks", [0.3, 0.5]);
  // the time line follows a button that is held: for a frame at least, and frames are slow here
  await lab.page.mouse.move(...line);
  await lab.page.mouse.down();
  await lab.until((s) => s.tick < s.frontier);
  await lab.page.mouse.up();
  await lab.page.waitForTimeout(500);
  const { tick } = await lab.state();
  assert.ok(tick > 0 && tick < frontier);
  await lab.click("Continue from here");
  await lab.until((s) => s.frontier === tick);
});

lab("a link opens to the same bits", "/?seed=11&world=lot", async (lab) => {
  await lab.until((s) => s.tick > 30);
  await lab.click(/^Lot\. Hitch/, [0.1, 0.1]);
  await lab.until((s) => s.armed === "Hitch");
  await lab.page.keyboard.down("ArrowUp");
  await lab.until((s) => s.tick > 60 && s.robots[0].driven);
  await lab.page.keyboard.up("ArrowUp");
  await lab.send({ do: "pause" });
  const here = await lab.until((s) => !s.playing);
  await lab.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await lab.page.click("#copy-link");
  await lab.page.waitForFunction(() => /digest/.test(document.getElementById("said").textContent));
  const address = await lab.page.evaluate(() => navigator.clipboard.readText());
  const digest = digestOf(await lab.page.textContent("#said"));
  console.log(`# ${address.length} characters: ${address.slice(0, 160)}`);
  const there = await Lab.open(address);
  const opened = await there.until((s) => s.notice);
  assert.equal(opened.notice.text, `the same run to the last bit: tick ${here.tick}, digest ${digest}`);
  assert.equal(opened.robots[0].configuration, here.robots[0].configuration);
  assert.deepEqual(await there.close(), []);
  const other = await Lab.open(address.replace(digest, "0".repeat(32)));
  assert.match((await other.until((s) => s.notice && s.notice.error)).notice.text, /^this run differs from the link's/);
  await other.close();
});

lab("hostile links are refused by name, and the lab starts all the same", "/?seed=1e9&tick=3", async (lab) => {
  // what plays takes the processor from the pages after it
  await lab.send({ do: "pause" });
  const { notice, seed } = await lab.until((s) => s.notice && s.notice.error);
  assert.match(notice.text, /^the link: seed: it must be a whole number up to \d+, not "1e9"$/);
  assert.equal(seed, "2005");
  for (const [query, said] of [
    ["?tick=99999999", /tick: it must be .* not "99999999"/],
    ["?world=%3Cimg%20src=x%3E", /world: it must be one of .* not "<img src=x>"/],
    ["?script=Script(version:1,events:[(tick:1,robot:%22Rusty%22,input:Drive(999,0))])", /channel 999/],
    ["?script=Script(version:1,events:[(tick:1,robot:%22Nobody%22,input:Release)])&tick=2", /Nobody/],
    ["?script=Script(version:1,events:[(tick:1,robot:%22Your%20session%20has%20expired%22,input:Release)])&tick=2", /^the link: (?!.*expired).*Your session/],
    ["?v=9", /v: this lab reads links of versions 1 to 3, not "9"/],
  ]) {
    const page = await Lab.open(`/${query}`);
    assert.match((await page.until((s) => s.notice && s.notice.error)).notice.text, said);
    assert.deepEqual(await page.close(), []);
  }
});

for (const [name, scheme, viewport] of [
  ["desktop", "dark", { width: 1280, height: 800 }],
  ["wide", "light", { width: 1920, height: 1080 }],
  ["phone", "light", { width: 390, height: 844 }],
  ["phone", "dark", { width: 390, height: 844 }],
]) {
  lab(
    `every widget is looked at: ${name}, ${scheme}`,
    "/?tick=300",
    async (lab) => {
      assert.equal((await lab.state()).theme, scheme);
      for (const id of ["dashboard", "anatomy", "cspace", "atlas", "plan"]) {
        await lab.send({ do: "widget", id });
        await lab.until((s) => s.widget === id);
        await lab.page.waitForTimeout(700);
        await lab.shot(`${name}-${scheme}-${id}`);
      }
      const wider = await lab.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wider <= 0, `nothing is cut off at the right: ${wider}`);
    },
    { options: { viewport, colorScheme: scheme } },
  );
}

lab(
  "fingers drive it on a phone",
  "/",
  async (lab) => {
    await lab.page.touchscreen.tap(...(await lab.at(/^Apartment\. Rusty/, [0.15, 0.2])));
    await lab.until((s) => s.armed === "Rusty");
    const [x, y] = await lab.at("Rusty: pad, up drives forward", [0.5, 0.1]);
    // a finger that stays down
    const session = await lab.context.newCDPSession(lab.page);
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
    await lab.until((s) => s.robots.some((r) => r.name === "Rusty" && r.driven));
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await lab.shot("phone-driving");
  },
  { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } },
);

lab("everything is done by keyboard alone, and Tab is not trapped", "/", async (lab) => {
  const { keyboard } = lab.page;
  await lab.page.focus("#lab");
  const focused = () => lab.page.evaluate(() => document.activeElement.id || document.activeElement.textContent || document.activeElement.tagName);
  const reached = [];
  for (let i = 0; i < 80; i++) {
    await keyboard.press("Tab");
    reached.push(await focused());
    if (/^(BODY|The book|copy-link)/.test(reached.at(-1))) break;
  }
  console.log(`# Tab goes over ${reached.length} stops`);
  assert.ok(reached.some((n) => /Play|Pause/.test(n)) && reached.some((n) => /Re-roll/.test(n)), reached.join(" | "));
  assert.ok(reached.length < 80, `Tab leaves the lab: ${reached.join(" | ")}`);
  // pause by the element that stands for the canvas's button
  const press = async (name) => {
    await lab.page.locator("#controls button", { hasText: name }).first().focus();
    await keyboard.press("Enter");
  };
  await press(/^Pause$/);
  await lab.until((s) => !s.playing);
  await press(/^Re-roll$/);
  await lab.until((s) => s.seed !== "2005");
  const seed = lab.page.getByLabel("seed", { exact: true });
  await seed.focus();
  await seed.fill("2005");
  await keyboard.press("Enter");
  await lab.until((s) => s.seed === "2005");
  await press(/^Apartment\. Rusty/);
  await lab.until((s) => s.armed === "Rusty");
  await lab.send({ do: "play" });
  await keyboard.down("ArrowUp");
  await lab.until((s) => s.robots.some((r) => r.name === "Rusty" && r.driven));
  await keyboard.up("ArrowUp");
  await keyboard.press("Escape");
  await lab.until((s) => s.armed === null);
  await press(/^Bring Reach/);
  const theta = lab.page.getByLabel("Reach: θ₁");
  await theta.focus();
  await theta.fill("0.5");
  await lab.until((s) => s.robots.some((r) => r.name === "Reach" && /th1: 0.500/.test(r.configuration)));
});

lab("the accessibility tree tells what the canvas shows", "/?tick=200", async (lab) => {
  await lab.find("Play");
  await lab.click(/^Bring Reach/);
  await lab.find("Reach: θ₁");
  const session = await lab.context.newCDPSession(lab.page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  const named = (role) => nodes.filter((n) => n.role?.value === role && !n.ignored).map((n) => n.name?.value);
  const buttons = named("button");
  assert.ok(named("popUpButton").concat(named("combobox")).concat(buttons).includes("speed: 1 x"), `${buttons}`);
  for (const name of ["Play", "Step", "Reset", "Re-roll", "Copy link", "Save run", "Drive", "Atlas"]) assert.ok(buttons.includes(name), `${name} among ${buttons}`);
  assert.ok(named("textbox").includes("seed"), named("textbox").join());
  assert.ok(named("spinbutton").includes("Reach: θ₁"), named("spinbutton").join());
  const rusty = nodes.find((n) => n.role?.value === "button" && n.name?.value === "Bring Rusty · Apartment to the front (1). Apartment. Rusty");
  assert.match(rusty.description.value, /^Pose2 \{ x: /, "the readouts are beside the names");
  assert.ok(nodes.some((n) => n.role?.value === "status"), "a live region");
  assert.ok(nodes.some((n) => n.role?.value === "alert"), "and one for what went wrong");
});

lab("a gamepad's stick drives the robot in hand, and lets it rest", "/", async (lab) => {
  const axes = (...values) => lab.page.evaluate((v) => (window.pad.axes = v), values);
  await lab.page.evaluate(() => {
    window.pad = { connected: true, axes: [0, 0, 0, 0] };
    navigator.getGamepads = () => [null, window.pad];
    window.dispatchEvent(new Event("gamepadconnected"));
  });
  const rusty = (s) => s.robots.find((r) => r.name === "Rusty");
  await axes(0, -1);
  await lab.page.waitForTimeout(500);
  assert.ok(!rusty(await lab.state()).driven, "no robot is in hand");
  await axes(0, 0.1);
  await lab.click(/^Apartment/, [0.3, 0.2]);
  await lab.until((s) => s.armed === "Rusty");
  await axes(0, -1);
  const { tick, robots } = await lab.until((s) => rusty(s).driven);
  const [x, y] = robots.find((r) => r.name === "Rusty").coordinates;
  await lab.until((s) => s.tick > tick + 10);
  const on = rusty(await lab.state()).coordinates;
  assert.ok(Math.hypot(on[0] - x, on[1] - y) > 0.05 || rusty(await lab.state()).touching, "it drives");
  // a stick that is let go wanders a little about its middle
  await axes(0.1, -0.1);
  await lab.page.waitForTimeout(1500);
  const [rest, later] = [rusty(await lab.state()).coordinates, (await lab.page.waitForTimeout(700), rusty(await lab.state()).coordinates)];
  assert.deepEqual(later, rest);
});

lab("a tap after a rest is a click", "/?widget=anatomy", async (lab) => {
  await lab.until((s) => s.query?.tab === "intersects");
  for (const name of ["swept", "distance"]) {
    const at = await lab.at(name);
    // the lab is paused: nothing moves for three seconds
    await lab.page.waitForTimeout(3000);
    const session = await lab.context.newCDPSession(lab.page);
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x: at[0], y: at[1] }] });
    await lab.page.waitForTimeout(80);
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await lab.until((s) => s.query?.tab === name, 5000);
  }
}, { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });

lab("a role lights in page and canvas alike", "/", async (lab) => {
  await lab.page.locator("#key button", { hasText: "obstacle" }).focus();
  await lab.until((s) => s.lit === "obstacle");
  assert.equal(await lab.page.evaluate(() => document.documentElement.dataset.lit), "obstacle");
  await lab.page.focus("#copy-link");
  await lab.until((s) => s.lit === null);
  const [x, y] = await lab.at("colour key: scan");
  await lab.page.mouse.move(x, y);
  await lab.until((s) => s.lit === "sensor");
});

lab("the page shows the chapter's formulas of what is in front, and their terms light its parts", "/?widget=anatomy", async (lab) => {
  const shown = lab.page.locator("#formulas li[data-at]:visible");
  const texts = async () => (await shown.locator("math").allTextContents()).map((text) => text.replace(/\s/g, ""));
  await lab.click("distance");
  await lab.until((s) => s.query?.tab === "distance");
  assert.deepEqual(await texts(), ["dist(R(q),O)=min|a−b|"]);
  await shown.locator(".role-obstacle").first().hover();
  await lab.until((s) => s.lit === "obstacle");
  // one a robot: the car's and its trailer's are of who has them
  await lab.send({ do: "widget", id: "dashboard" });
  await lab.until((s) => s.widget === "dashboard");
  const names = await shown.evaluateAll((items) => items.flatMap((item) => item.dataset.at.split(" ")));
  assert.ok(names.includes("rusty.3") && names.includes("reach.2") && names.includes("hitch.3") && !names.includes("distance"), names.join(" "));
  assert.ok((await shown.first().locator("math").boundingBox()).height > 8);
  // on a phone a long one is scrolled, not the page
  await lab.page.setViewportSize({ width: 390, height: 844 });
  await lab.page.waitForTimeout(300);
  assert.ok(await shown.evaluateAll((items) => items.some((item) => item.scrollWidth > item.clientWidth)));
  assert.ok(await lab.page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  await lab.shot("formulas-phone");
});

lab("a saved page verifies from disk, without a server, and tells a forged run", "/?seed=42", async (lab) => {
  await lab.until((s) => s.tick > 60);
  await lab.send({ do: "pause" });
  await lab.until((s) => !s.playing);
  const { path } = await download(lab.page, () => lab.page.click("#save-page"));
  const html = readFileSync(path, "utf8");
  console.log(`# the page has ${html.length} bytes`);
  const file = join(shots, "run.html");
  writeFileSync(file, html);
  // the program reads it as it reads a log
  assert.match(native("verify", file), new RegExp(/Its digest was ([0-9a-f]{32})/.exec(html)[1]));
  const read = async (address) => {
    const page = await Lab.open(`file://${address}`, { wait: false });
    await page.page.waitForFunction(() => document.documentElement.dataset.verdict, null, { timeout: 30000 });
    const said = await page.page.textContent("#verdict");
    await page.shot(`saved-${said.slice(0, 8)}`);
    if (/^Verified/.test(said)) assert.match(await page.page.getAttribute("#log", "href"), /^blob:/, "a link that keys reach");
    assert.deepEqual(await page.close(), []);
    return said;
  };
  const said = await read(file);
  assert.match(said, /^Verified: bit-identical, (\d+) of \1, digest [0-9a-f]{32}\.$/);
  // the run of another seed under this one's name
  const forged = html.replace(/(id="bytes">)([^<]*)/, (_, tag, text) => {
    const bytes = Buffer.from(text, "base64");
    bytes[Math.floor(bytes.length / 2)] ^= 1;
    return tag + bytes.toString("base64");
  });
  writeFileSync(join(shots, "forged.html"), forged);
  const refused = await read(join(shots, "forged.html"));
  assert.match(refused, /^Not verified: |^Another run: /);
});

lab("a page embeds one widget, sized to its frame, and speaks with it", "/widgets.html", async (lab) => {
  const frame = await (await lab.page.waitForSelector('iframe[title="Dashboard"]')).contentFrame();
  await frame.waitForFunction(() => window.motionLab?.state, null, { timeout: 60000 });
  const names = await frame.evaluate(() => [...document.querySelectorAll("#controls button")].map((b) => b.textContent));
  assert.ok(names.includes("Step") && !names.includes("Atlas"), "no rail: one widget");
  const heard = await lab.page.evaluate(
    () =>
      new Promise((done) => {
        const view = document.querySelector('iframe[title="Dashboard"]').contentWindow;
        addEventListener("message", ({ data }) => data.motionLab?.kind === "state" && data.motionLab.lit === "robot" && done(data.motionLab));
        view.postMessage({ motionLab: { do: "light", role: "robot" } }, "*");
      }),
  );
  assert.equal(heard.widget, "dashboard");
  // what is no role is said to be none
  const error = await lab.page.evaluate(
    () =>
      new Promise((done) => {
        const view = document.querySelector('iframe[title="Dashboard"]').contentWindow;
        addEventListener("message", ({ data }) => data.motionLab?.kind === "error" && done(data.motionLab.text));
        view.postMessage({ motionLab: { do: "light", role: "banana" } }, "*");
      }),
  );
  assert.equal(error, '"banana" is no role');
  await lab.shot("widgets");
}, { wait: false });

lab(
  "who asks for less motion presses Play first",
  "/",
  async (lab) => {
    const { tick } = await lab.until((s) => !s.playing);
    await lab.page.waitForTimeout(500);
    assert.equal((await lab.state()).tick, tick);
    await lab.click("Play");
    await lab.until((s) => s.tick > tick + 5);
    // what the system asks for is not kept as the reader's own wish
    await lab.send({ do: "theme", name: "light" });
    const kept = () => JSON.parse(localStorage.getItem("motion-lab/settings") ?? "{}");
    await lab.page.waitForFunction(() => JSON.parse(localStorage.getItem("motion-lab/settings") ?? "{}").theme === "Light");
    assert.equal((await lab.page.evaluate(kept)).reduced_motion, false);
  },
  { options: { reducedMotion: "reduce" } },
);

lab(
  "a low screen scrolls the page instead of shrinking the pictures",
  "/",
  async (lab) => {
    const [, , , height] = (await lab.find(/^Apartment\. Rusty/)).place;
    await lab.shot("low");
    assert.ok(height > 150, `the paper is ${height} high`);
    const before = await lab.page.evaluate(() => scrollY);
    await lab.page.mouse.move(300, 200);
    await lab.page.mouse.wheel(0, 300);
    await lab.page.waitForFunction((y) => scrollY > y + 100, before);
  },
  { options: { viewport: { width: 853, height: 480 } } },
);

const failNow = () => import(new URL(JSON.parse(document.getElementById("files").textContent).lab, location.href)).then((lab) => lab.lab_fail());
const loseContext = () => document.getElementById("lab").getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();

test("a failure is shown with its reason, keeps the run, and starts again", { timeout: 120000 }, async () => {
  const lab = await Lab.open("/?seed=5");
  await lab.until((s) => s.tick > 30);
  await lab.send({ do: "pause" });
  const { frontier } = await lab.until((s) => !s.playing);
  await lab.page.waitForTimeout(300);
  await lab.page.evaluate(failNow);
  await lab.page.waitForSelector("#overlay:not([hidden])");
  console.log(`# ${await lab.page.textContent("#overlay-text")}`);
  await lab.shot("overlay-a-failure");
  const { path } = await download(lab.page, () => lab.page.click("#overlay-save"));
  const log = join(shots, "kept.mcap");
  writeFileSync(log, readFileSync(path));
  assert.ok(new RegExp(`${frontier} of ${frontier}`).test(native("verify", log)));
  await lab.page.click("#overlay-restart");
  await lab.page.waitForFunction(() => window.received.kinds.includes("ready"), null, { timeout: 60000 });
  const again = await lab.until((s) => s.notice && s.notice.text.startsWith("the run before"));
  assert.equal(again.frontier, frontier);
  await lab.close();
});

test("after a lost graphics context the run is back, paused at its tick; one lost again at once says so", { timeout: 120000 }, async () => {
  const lab = await Lab.open("/?seed=5");
  await lab.until((s) => s.tick > 40);
  await lab.send({ do: "pause" });
  const { frontier } = await lab.until((s) => !s.playing);
  await lab.send({ do: "seek", tick: 17 });
  await lab.until((s) => s.tick === 17);
  await lab.page.waitForTimeout(300);
  await Promise.all([lab.page.waitForEvent("load"), lab.page.evaluate(loseContext)]);
  await lab.page.waitForFunction(() => window.received.kinds.includes("ready"), null, { timeout: 60000 });
  const again = await lab.until((s) => s.frontier === frontier && s.tick === 17);
  assert.equal(again.playing, false);
  // as if it had happened a moment ago
  await lab.page.evaluate(() => sessionStorage.setItem(`motion-lab/lost ${location.pathname}${location.search}${location.hash}`, Date.now()));
  await lab.page.evaluate(loseContext);
  await lab.page.waitForSelector("#overlay:not([hidden])");
  assert.match(await lab.page.textContent("#overlay-text"), /context/);
  await lab.close();
});

lab("no message makes the lab fail, and what is no message loses nothing", "/", async (lab) => {
  await lab.send({ do: "fail" });
  await lab.page.waitForFunction(() => /there is no .fail/.test(document.getElementById("alert").textContent));
  await lab.send({ do: "paste", text: "x".repeat(70000) });
  await lab.page.waitForFunction(() => /takes up to 65536/.test(document.getElementById("alert").textContent));
  // more than the lab reads in a frame is refused aloud, and it goes on
  await lab.page.evaluate(() => {
    for (let i = 0; i < 3000; i++) window.motionLab.send({ do: "light", role: null });
  });
  assert.match(await lab.page.textContent("#alert"), /has not read what came before/);
  const { tick } = await lab.state();
  await lab.until((s) => s.tick > tick + 5);
});

lab("frames below the fold take neither the focus nor the page's place; one of the lab's own pages saves a run by its name", "/widgets.html", async ({ page }) => {
  await page.route(`${origin()}/host.html`, (route) =>
    route.fulfill({
      contentType: "text/html",
      body: '<p style="height:2500px">Text</p><iframe src="embed.html?widget=anatomy" width="600" height="640"></iframe><iframe src="embed.html" width="600" height="640"></iframe>',
    }),
  );
  await page.goto(`${origin()}/host.html`);
  for (const frame of page.frames().slice(1)) {
    await frame.waitForFunction(() => window.received?.kinds.includes("ready"), null, { timeout: 60000 });
  }
  await page.waitForTimeout(500);
  assert.deepEqual(await page.evaluate(() => [scrollY, document.activeElement.tagName]), [0, "BODY"]);
  const dashboard = page.frames()[2];
  await dashboard.waitForFunction(() => window.received.state?.tick > 20);
  for (const [name, called] of [["back_in", "back_in.mcap"], ["../back_in", "run.mcap"], [undefined, "run.mcap"]]) {
    const file = await download(page, () => page.evaluate((name) => frames[1].postMessage({ motionLab: { do: "save", name } }, "*"), name));
    assert.equal(file.name, called);
    assert.match(native("verify", file.path), /bit-identical/);
    assert.equal(await dashboard.locator("#asked").isVisible(), false);
  }
}, { wait: false });

lab("a refused link names its field and says nothing in the link's words; a link's paper is not kept", "/?v=Your%20session%20has%20expired&theme=dark", async (lab) => {
  const { notice } = await lab.until((s) => s.notice);
  assert.equal(notice.text, 'the link: v: this lab reads links of versions 1 to 3, not "Your session..."');
  const kept = () => lab.page.evaluate(() => JSON.parse(localStorage.getItem("motion-lab/settings") ?? "{}").theme);
  await lab.page.goto(`${origin()}/?theme=dark`);
  await lab.until((s) => s.theme === "dark");
  await lab.page.waitForTimeout(500);
  assert.notEqual(await kept(), "Dark");
  await lab.send({ do: "theme", name: "light" });
  await lab.until((s) => s.theme === "light");
  await lab.page.waitForFunction(() => JSON.parse(localStorage.getItem("motion-lab/settings")).theme === "Light");
  await lab.page.goto(`${origin()}/`);
  await lab.until((s) => s.theme === "light");
});

lab("a link carries a thousand inputs", "/", async (lab) => {
  const drives = Array.from({ length: 1100 }, (_, i) => `(tick: ${i + 1}, robot: "Rusty", input: Drive(${((i * 37) % 257) - 128}, ${128 - ((i * 11) % 257)})),`);
  const script = join(shots, "thousand.ron");
  writeFileSync(script, `Script(version: 1, events: [${drives.join("\n")}])`);
  const log = join(shots, "thousand.mcap");
  rmSync(log, { force: true });
  native("record", "--seconds", "55", "--script", script, "-o", log);
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate((text) => window.motionLab.open(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "thousand.mcap")), bytes);
  await lab.until((s) => s.notice?.text.startsWith("thousand.mcap"));
  await lab.send({ do: "seek", tick: 1100 });
  await lab.until((s) => s.tick === 1100);
  await lab.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await lab.page.click("#copy-link");
  await lab.page.waitForFunction(() => /digest/.test(document.getElementById("said").textContent));
  const address = await lab.page.evaluate(() => navigator.clipboard.readText());
  console.log(`# ${address.length} characters`);
  assert.match(address, /\?v=2&/, "in the query as long as servers take it");
  assert.match(native("info", log), new RegExp(digestOf(await lab.page.textContent("#said"))));
  await lab.page.goto("about:blank");
  await lab.page.goto(address);
  const { notice } = await lab.until((s) => s.notice, 60000);
  assert.match(notice.text, /^the same run to the last bit: tick 1100/);
  // behind a #, where longer ones go
  await lab.page.goto("about:blank");
  await lab.page.goto(address.replace("?", "#"));
  assert.equal((await lab.until((s) => s.notice, 60000)).notice.text, notice.text);
});

lab(
  "a file that is opened while the lab loads is opened when it is there",
  "/",
  async (lab) => {
    const log = join(shots, "early.mcap");
    rmSync(log, { force: true });
    native("record", "--seconds", "1", "-o", log);
    const bytes = readFileSync(log).toString("base64");
    await lab.page.evaluate((text) => window.motionLab.open(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "early.mcap")), bytes);
    assert.match(await lab.page.textContent("#said"), /as soon as the lab is there/);
    const { notice } = await lab.until((s) => s.notice?.text.startsWith("early.mcap"), 60000);
    assert.match(notice.text, /bit-identical/);
  },
  { wait: false, before: (page) => page.route("**/lab.*.wasm", async (route) => (await new Promise((done) => setTimeout(done, 4000)), route.continue())) },
);

test("a page that could not load the lab says why, keeps the pictures and tries again", { timeout: 120000 }, async () => {
  let fails = true;
  const lab = await Lab.open("/", { wait: false, before: (page) => page.route("**/lab.*.wasm", (route) => (fails ? route.fulfill({ status: 503 }) : route.continue())) });
  await lab.page.waitForSelector("#unloaded:not([hidden])");
  assert.match(await lab.page.textContent("#unloaded-text"), /503/);
  assert.ok(await lab.page.locator("#still img").first().isVisible());
  await lab.shot("unloaded");
  fails = false;
  await lab.page.click("#retry");
  await lab.page.waitForFunction(() => window.received.kinds.includes("ready"), null, { timeout: 60000 });
  await lab.close();
});

test("saving as a page works after the simulator could not be fetched", { timeout: 120000 }, async () => {
  let fails = true;
  const lab = await Lab.open("/", { before: (page) => page.route("**/light.*", (route) => (fails ? route.abort() : route.continue())) });
  await lab.until((s) => s.tick > 10);
  await lab.page.click("#save-page");
  await lab.page.waitForFunction(() => /^Not saved/.test(document.getElementById("alert").textContent));
  fails = false;
  const file = await download(lab.page, () => lab.page.click("#save-page"));
  assert.equal(file.name, "run.html");
  await lab.close();
});

test("the server answers what makes no sense, and sends the policy", async () => {
  const { port } = new URL(origin());
  const asked = (path) =>
    new Promise((done, failed) => request({ host: "127.0.0.1", port, path, agent: false }, (response) => (response.resume(), done(response))).on("error", failed).end());
  for (const path of ["/%ff", "/%00", "/..%2f..%2fpasswd", "/no-such-page", "http://[/"]) assert.equal((await asked(path)).statusCode, 404, path);
  for (const path of ["//", "/", "/index.html", "/?q=%ff"]) {
    const { statusCode, headers } = await asked(path);
    assert.equal(statusCode, 200, path);
    assert.match(headers["content-security-policy"], /^default-src 'none'; script-src 'self'/);
  }
});

lab("a hidden page stands still, and goes on without a burst", "/", async (lab) => {
  await lab.until((s) => s.tick > 10);
  const hide = (hidden) =>
    lab.page.evaluate((h) => {
      Object.defineProperty(document, "hidden", { configurable: true, get: () => h });
      document.dispatchEvent(new Event("visibilitychange"));
    }, hidden);
  await hide(true);
  await lab.page.waitForTimeout(400);
  const { tick } = await lab.state();
  await lab.page.waitForTimeout(3000);
  assert.equal((await lab.state()).tick, tick, "no tick while it is hidden");
  await hide(false);
  await lab.page.waitForTimeout(250);
  const after = (await lab.state()).tick;
  assert.ok(after - tick <= 8, `${after - tick} ticks in a quarter of a second`);
  await lab.until((s) => s.tick > tick);
});

const LOADS = Number(process.env.MOTION_LAB_LOADS ?? 500);
lab("memory stays flat while worlds are opened", "/?widget=atlas", async (lab) => {
  const world = native("world", "show", "apartment");
  const load = (times) =>
    lab.page.evaluate(
      async ([text, n]) => {
        const file = new File([text], "again.ron");
        for (let i = 0; i < n; i++) {
          await window.motionLab.open(file);
          if (i % 50 === 49) await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
        }
        await new Promise((next) => setTimeout(next, 1500));
        return window.motionLab.memory();
      },
      [world, times],
    );
  const warm = await load(Math.min(LOADS, 500));
  const end = await load(LOADS);
  console.log(`# WebAssembly memory: ${warm} bytes, after ${LOADS} more worlds ${end}`);
  assert.ok(end <= 1.02 * warm + 131072, `${end} after ${warm}`);
}, { timeout: 180000 + 200 * LOADS });

test("without WebGL 2 the page says so and shows its pictures", { timeout: 60000 }, async () => {
  const bare = await newBrowser(["--disable-3d-apis"]);
  const lab = await Lab.open(`${origin()}/`, { wait: false, from: bare });
  await lab.page.waitForFunction(() => /WebGL 2/.test(document.getElementById("alert").textContent));
  await lab.page.locator("#still figure img").first().waitFor({ state: "visible", timeout: 10000 });
  await lab.shot("without-webgl");
  await lab.close();
  await bare.close();
});

test("without script the page shows its pictures and words", { timeout: 60000 }, async () => {
  const lab = await Lab.open("/", { wait: false, options: { javaScriptEnabled: false } });
  const text = await lab.page.locator("#still").innerText();
  for (const title of ["Dashboard", "Query anatomy", "Configuration space", "World atlas", "Plan"]) assert.ok(text.includes(title), title);
  assert.deepEqual([await lab.page.locator("#still figure img").count(), await lab.page.locator("#still figure > svg").count()], [4, 1]);
  // each picture has the light paper and the dark one, that for who asks for it
  for (const image of await lab.page.locator("#still figure img").all()) {
    const svg = await (await lab.page.request.get(new URL(await image.getAttribute("src"), lab.page.url()).href)).text();
    const [light, dark] = svg.split("@media (prefers-color-scheme:dark){");
    assert.ok(light.includes(".paper.f{fill:#fbfaf7}") && dark?.includes(".paper.f{fill:#15181c}"));
  }
  await lab.shot("without-script");
  assert.deepEqual(await lab.close(), []);
});

lab("a wrong field of what to show costs no run, and what a page lights goes out with its widget", "/?seed=11&tick=40&widget=moon&theme=dark", async (lab) => {
  const { notice } = await lab.until((s) => s.notice && s.tick === 40);
  assert.match(notice.text, /^the link: widget: it must be one of dashboard/);
  const { seed, theme } = await lab.state();
  assert.deepEqual([seed, theme], ["11", "dark"]);
  await lab.send({ do: "light", role: "obstacle" });
  await lab.until((s) => s.lit === "obstacle");
  await lab.send({ do: "widget", id: "atlas" });
  await lab.until((s) => s.widget === "atlas" && s.lit === null);
});

lab("the link of a log that was opened is its run, with the inputs to come", "/", async (lab) => {
  const [log, script] = [join(shots, "driven.mcap"), join(shots, "driven.ron")];
  rmSync(log, { force: true });
  writeFileSync(script, 'Script(version: 1, events: [(tick: 20, robot: "Rusty", input: Drive(128, 9))])');
  const { digest } = JSON.parse(native("record", "--seed", "11", "--ticks", "60", "--script", script, "--json", "-o", log));
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate((text) => {
    const file = new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "driven.mcap");
    return window.motionLab.open(file);
  }, bytes);
  await lab.until((s) => s.notice?.text.startsWith("driven.mcap"));
  const link = () =>
    lab.page.evaluate(() => new Promise((done) => {
      addEventListener("motionlab", ({ detail }) => detail.kind === "link" && done(detail));
      window.motionLab.send({ do: "link" });
    }));
  assert.equal((await lab.state()).tick, 0, "it is shown at its start");
  const { query } = await link();
  assert.match(query, /^v=1&seed=11&script=Script\(/);
  // whoever plays it from there has the same run
  const other = await Lab.open(`/?${query}`);
  await other.send({ do: "pause" });
  await other.until((s) => !s.playing);
  await other.send({ do: "seek", tick: 60 });
  await other.until((s) => s.tick === 60);
  await other.page.evaluate(() => void (window.told = new Promise((done) => addEventListener("motionlab", ({ detail }) => detail.kind === "link" && done(detail)))));
  await other.send({ do: "link" });
  assert.equal((await other.page.evaluate(() => window.told)).digest, digest);
  assert.deepEqual(await other.close(), []);
});

lab("what the browser does not copy is said once, and not to be copied", "/?widget=anatomy", async (lab) => {
  await lab.page.evaluate(() => (navigator.clipboard.writeText = () => Promise.reject(new Error("no"))));
  await lab.page.locator("#controls button", { hasText: "Copy as Rust" }).press("Enter");
  const { notice } = await lab.until((s) => s.notice?.error);
  assert.equal(notice.text, "not copied: the browser does not let the page copy");
  await lab.page.waitForTimeout(800);
  assert.deepEqual([await lab.page.textContent("#alert"), await lab.page.textContent("#said")], ["", ""]);
});
