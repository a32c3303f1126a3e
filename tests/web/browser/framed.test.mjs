// The lab in a frame of another page: a teacher's course, a reader's phone.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { join } from "node:path";
import { after, before } from "node:test";
import { begin, end, native, origin, shots } from "./harness.mjs";
import { download, lab } from "./on_page.mjs";

let hosts = null;
let body = "";

before(async () => {
  await begin();
  hosts = createServer((_, response) => response.writeHead(200, { "content-type": "text/html" }).end(body));
  await new Promise((done) => hosts.listen(0, "127.0.0.1", done));
});
after(async () => {
  await end();
  hosts.close();
});

/** Opens a page of another origin around frames of the lab, text above and below; gives its frames. */
async function around(page, frames) {
  const frame = (query) => `<iframe src="${origin()}/embed.html${query}" style="width:100%;height:740px;border:0"></iframe>`;
  body = `<meta name="viewport" content="width=device-width"><p>Text</p>${frames.map(frame).join("")}<p style="height:2000px">Text</p>`;
  await page.goto(`http://localhost:${hosts.address().port}/`);
  const inner = page.frames().slice(1);
  for (const frame of inner) await frame.waitForFunction(() => window.received?.kinds.includes("ready") && window.received.state, null, { timeout: 60000 });
  return inner;
}

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const elsewhere = { wait: false };

lab("a page of another origin can't save a run: its reader is asked", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, [""]);
  await frame.waitForFunction(() => window.received.state.tick > 20);
  await page.evaluate(() => {
    window.heard = [];
    addEventListener("message", ({ data }) => window.heard.push(data.motionLab));
    frames[0].postMessage({ motionLab: { do: "save", name: "mine", request: 1 } }, "*");
  });
  await frame.waitForSelector("#asked:not([hidden])");
  assert.match(await frame.textContent("#urgent"), /asks to save this run/);
  await page.screenshot({ path: join(shots, "asked.png") });
  assert.equal(await page.evaluate(() => window.heard.some(({ kind }) => kind === "saved")), false);
  const file = await download(page, () => frame.click("#asked-save"));
  assert.equal(file.name, "mine.mcap");
  assert.match(native("verify", file.path), /bit-identical/);
  assert.equal(await frame.locator("#asked").isVisible(), false);
  await page.waitForFunction(() => window.heard.some(({ kind, saved, request }) => kind === "saved" && saved && request === 1));
}, elsewhere);

lab("a swipe on a frame scrolls the page around it; a drag on a slider or on a drawing in use does not", "/widgets.html", async ({ page, context }) => {
  const [frame] = await around(page, ["?widget=anatomy"]);
  const session = await context.newCDPSession(page);
  const touch = (type, at) => session.send("Input.dispatchTouchEvent", { type, touchPoints: at ? [{ x: at[0], y: at[1] }] : [] });
  const swipe = async ([x, y]) => {
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForTimeout(300);
    await touch("touchStart", [x, y]);
    for (let i = 1; i <= 10; i++) {
      await touch("touchMove", [x, y - 20 * i]);
      await page.waitForTimeout(30);
    }
    await touch("touchEnd");
    await page.waitForTimeout(600);
    return page.evaluate(() => scrollY);
  };
  const { width, height, x: left, y: top } = await (await frame.frameElement()).boundingBox();
  const place = (name) => frame.evaluate((n) => window.received.tree.find((w) => w.name.includes(n)).place, name);
  const middle = async (name) => {
    const [x, y, w, h] = await place(name);
    return [left + x + w / 2, top + y + h / 2];
  };
  const pose = () => frame.evaluate(() => window.received.tree.find((w) => w.kind === "handle").name);
  const drawing = await middle("Does the robot touch anything? Touching counts. intersects");
  const before = await pose();
  assert.ok((await swipe(drawing)) > 100, "over the drawing of a frame that nobody uses");
  assert.equal(await pose(), before, "which does not change");
  assert.ok((await swipe([left + width / 2, top + 20])) > 100, "over its words");
  const slider = await frame.evaluate(() => window.received.tree.find((w) => w.kind === "slider").place);
  assert.ok(slider[1] + slider[3] < height, "the slider is in sight");
  assert.equal(await swipe([left + slider[0] + slider[2] / 4, top + slider[1] + slider[3] / 2]), 0, "on a slider");
  await page.touchscreen.tap(...drawing);
  await page.waitForTimeout(400);
  assert.equal(await swipe(drawing), 0, "a drawing in use is dragged");
}, { ...elsewhere, options: PHONE });

lab("a page around presses nothing, hears nothing of the reader's, and one origin is spoken with", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, ["?seed=9"]);
  await page.evaluate(() => {
    window.heard = [];
    addEventListener("message", ({ data }) => data.motionLab && window.heard.push(data.motionLab));
  });
  const post = (message) => page.evaluate((m) => frames[0].postMessage({ motionLab: m }, "*"), message);
  const answer = (kind) => page.waitForFunction((k) => window.heard.find((m) => m.kind === k), kind).then((m) => m.jsonValue());
  const { id } = await frame.evaluate(() => window.received.tree.find((w) => w.name === "Pause" || w.name === "Play"));
  const playing = () => frame.evaluate(() => window.received.state.playing);
  const before = await playing();
  await post({ do: "act", id, action: "click" });
  assert.equal((await answer("error")).text, "act: not for the page around");
  await page.waitForTimeout(500);
  assert.equal(await playing(), before, "the button is not pressed");
  assert.equal(await frame.textContent("#alert"), "", "the reader is not told of the page's mistake");
  for (const message of [{ do: "key", key: "s", pressed: true }, { do: "paste", text: "x" }, { do: "system", dark: true, reduced_motion: true }]) {
    await page.evaluate(() => (window.heard = []));
    await post(message);
    assert.equal((await answer("error")).text, `${message.do}: not for the page around`);
  }
  // it is told a link, and the reader neither loses what was copied nor reads an address
  await post({ do: "link" });
  assert.match((await answer("link")).query, /^v=1&seed=/);
  await page.waitForTimeout(1500);
  assert.equal(await frame.evaluate(() => document.getElementById("said").textContent), "");
  await page.evaluate(() => (window.heard = window.heard.filter((m) => m.kind !== "link")));
  // what is the reader's stays in the frame
  await frame.evaluate(() => window.motionLab.send({ do: "theme", name: "dark" }));
  await frame.waitForFunction(() => window.received.state.theme === "dark" && window.received.kinds.includes("settings"));
  await post({ do: "seed", seed: "11" });
  await page.waitForFunction(() => window.heard.some((m) => m.kind === "state" && m.seed === "11"));
  const kinds = await page.evaluate(() => [...new Set(window.heard.map((m) => m.kind))]);
  assert.deepEqual(kinds.filter((k) => !["ready", "state", "error"].includes(k)), []);
  assert.ok(await frame.evaluate(() => window.received.kinds.includes("run")), "the frame itself has heard of the run");
  // a page that lies about who it is to the frame hears nothing: what is posted goes to the origin around only
  const targets = await frame.evaluate(() => {
    const seen = [];
    const real = parent.postMessage.bind(parent);
    try {
      window.dispatchEvent(new MessageEvent("message", { data: { motionLab: { do: "seed", seed: "12" } }, origin: "https://elsewhere.example", source: parent }));
    } catch (error) {
      seen.push(String(error));
    }
    return seen;
  });
  assert.deepEqual(targets, []);
  await page.waitForTimeout(500);
  assert.equal(await frame.evaluate(() => window.received.state.seed), "11", "another origin's message is not heard");
}, elsewhere);

lab("a page that floods a playing frame is refused what has no room, and the lab lives", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, [""]);
  await page.evaluate(() => {
    window.refused = 0;
    window.heard = [];
    addEventListener("message", ({ data }) => {
      if (data.motionLab?.kind === "error") window.refused += /has not read what came before/.test(data.motionLab.text);
      else if (data.motionLab) window.heard.push(data.motionLab);
    });
  });
  const playing = await frame.evaluate(() => window.received.state);
  assert.ok(playing.playing, "it plays by itself");
  await page.evaluate(() => {
    for (let i = 0; i < 100000; i++) frames[0].postMessage({ motionLab: { do: "light", role: i % 2 ? "robot" : "obstacle" } }, "*");
  });
  await page.waitForFunction(() => window.refused > 1000, null, { timeout: 60000 });
  // what comes when there is room is done
  await page.waitForFunction(() => {
    frames[0].postMessage({ motionLab: { do: "seed", seed: "11" } }, "*");
    return window.heard.some((m) => m.kind === "state" && m.seed === "11" && m.tick > 5);
  }, null, { timeout: 120000, polling: 1000 });
  assert.ok(await frame.isHidden("#overlay"), "it has not stopped");
}, elsewhere);

lab("a page around asks Query, drives, puts and lets go robots, and closes doors", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, [""]);
  await page.evaluate(() => {
    window.heard = [];
    addEventListener("message", ({ data }) => data.motionLab && window.heard.push(data.motionLab));
  });
  const post = (message) => page.evaluate((m) => frames[0].postMessage({ motionLab: m }, "*"), message);
  const until = (body, value) => page.waitForFunction(`window.heard.findLast((m) => m.kind === "state" && (${body})(m, ${JSON.stringify(value ?? null)}))`, null, { timeout: 30000 }).then((m) => m.jsonValue());
  const refused = (text) => page.waitForFunction((t) => window.heard.some((m) => m.kind === "error" && m.text.includes(t)), text, { timeout: 20000 });
  await until("(m) => m.tick > 2");
  await post({ do: "robot", robot: "Rusty", drive: [0, 0] });
  const driven = await until('(m) => m.robots.find((r) => r.name === "Rusty").driven');
  assert.equal(driven.robots.find((r) => r.name === "Rusty").coordinates.length, 3);
  await post({ do: "robot", robot: "Rusty", release: true });
  await until('(m) => !m.robots.find((r) => r.name === "Rusty").driven');
  await post({ do: "robot", robot: "Hitch", trailer: true });
  await until('(m) => m.robots.find((r) => r.name === "Hitch").trailer === true');
  await post({ do: "pause" });
  await until("(m) => !m.playing");
  await post({ do: "robot", robot: "Reach", move_to: [0.5, 0.25] });
  await post({ do: "step" });
  await until('(m) => m.robots.find((r) => r.name === "Reach").coordinates[1] !== 0 && m.robots.find((r) => r.name === "Reach").driven');
  await post({ do: "door", world: "Apartment", name: "door B", open: false });
  await post({ do: "step" });
  const { doors } = await until('(m) => m.doors.some((d) => d.name === "door B" && !d.open)');
  assert.deepEqual(doors.filter((d) => !d.open), [{ world: "Apartment", name: "door B", open: false }]);
  // what no robot takes is refused by name
  await post({ do: "robot", robot: "Nobody", drive: [0, 0] });
  await refused("Nobody");
  await post({ do: "robot", robot: "Reach", drive: [0, 0] });
  await refused('"Reach" is a reach and takes no Drive');
  await post({ do: "robot", robot: "Rusty", drive: [500, 0] });
  await refused("channel 500");
  await post({ do: "robot", robot: "Rusty", teleport: [1e300, 0, 0] });
  await refused('"Rusty": a coordinate is beyond');
  await post({ do: "widget", id: "anatomy" });
  await post({ do: "tab", id: "distance" });
  // theta1 = 0 and theta2 = pi/2: the chapter's arm, whose second link touches the square
  await post({ do: "configuration", coordinates: [0, Math.PI / 2] });
  const { query } = await until('(m) => m.query && m.query.tab === "distance" && /th1:\\s+0.000/.test(m.query.configuration)');
  assert.deepEqual([query.intersects, query.distance], [true, 0]);
  await post({ do: "configuration", coordinates: [1] });
  await refused("configuration: it has 2 coordinates");
  await post({ do: "tab", id: "nonsense" });
  await refused('"nonsense" is no tab');
  await post({ do: "figure" });
  const figure = await page.waitForFunction(() => window.heard.find((m) => m.kind === "figure"), null, { timeout: 60000 }).then((m) => m.jsonValue());
  assert.match(figure.svg, /^<svg[^>]*>[^]*<\/svg>\s*$/);
}, elsewhere);

lab("a page around begins a lesson by an address or a message, and hears when it is done", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, ["?lesson=free_ends"]);
  const heard = await page.evaluateHandle(() => {
    const heard = [];
    addEventListener("message", ({ data }) => data.motionLab?.kind === "lesson" && heard.push(data.motionLab));
    return heard;
  });
  const post = (message) => page.evaluate((m) => frames[0].postMessage({ motionLab: m }, "*"), message);
  const last = (id, done) => page.waitForFunction(([all, i, d]) => all.at(-1)?.id === i && all.at(-1)?.done === d && all.at(-1), [heard, id, done], { timeout: 30000 }).then((m) => m.jsonValue());
  // the address has begun its own
  await frame.waitForFunction(() => window.received.state.widget === "anatomy" && window.received.state.query?.tab === "swept");
  assert.ok(await frame.evaluate(() => window.received.tree.some((w) => w.name?.startsWith("Two free ends: find a motion"))), "its task stands there");
  await post({ do: "lesson", id: "near" });
  const begun = await last("near", false);
  assert.equal(begun.seconds, null);
  await frame.waitForFunction(() => window.received.state.query?.tab === "witness");
  // the arm touches below 1.4009: at 1.42 it is 7 mm off, at pi/2 61 mm
  await post({ do: "configuration", coordinates: [Math.PI / 4, 1.5] });
  await page.waitForTimeout(700);
  assert.equal(await page.evaluate((all) => all.at(-1).done, heard), false);
  await frame.evaluate(() => {
    const slider = window.received.tree.find((w) => w.kind === "slider" && w.name === "θ₂");
    window.motionLab.send({ do: "act", id: slider.id, action: "set", value: "1.42" });
  });
  const { seconds } = await last("near", true);
  assert.ok(seconds > 0 && seconds < 60, `${seconds}`);
  await page.screenshot({ path: join(shots, "lesson-done.png") });
  // who listens late asks for what was told
  await page.evaluate(() => {
    window.late = [];
    addEventListener("message", ({ data }) => data.motionLab && window.late.push(data.motionLab));
  });
  await post({ do: "state" });
  await page.waitForFunction(() => window.late.some((m) => m.kind === "lesson" && m.done) && window.late.some((m) => m.kind === "state"), null, { timeout: 20000 });
  await post({ do: "lesson", id: null });
  await last(null, undefined);
  // what is asked behind an address with a lesson holds when the lesson begins, a frame later
  await page.evaluate(() => {
    for (const message of [{ do: "open", query: "lesson=near&q=0.5,1.25" }, { do: "configuration", coordinates: [0.25, 1.5] }]) frames[0].postMessage({ motionLab: message }, "*");
  });
  await last("near", false);
  await page.waitForTimeout(700);
  assert.deepEqual(await frame.evaluate(() => window.received.state.query.coordinates), [0.25, 1.5]);
  await post({ do: "lesson", id: null });
  await last(null, undefined);
  const refused = page.waitForFunction(() => window.refused?.text, null, { timeout: 20000 });
  await page.evaluate(() => addEventListener("message", ({ data }) => data.motionLab?.kind === "error" && (window.refused = data.motionLab)));
  await post({ do: "lesson", id: "Near" });
  assert.match(await (await refused).jsonValue(), /^"Near" is no lesson/);
}, elsewhere);

lab("what a page around asks with a mark is answered with it, and the reader reads nothing of what is refused", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, ["?tab=witness&q=0,1.5"]);
  await page.evaluate(() => {
    window.heard = [];
    addEventListener("message", ({ data }) => data.motionLab && window.heard.push(data.motionLab));
  });
  const post = (message) => page.evaluate((m) => frames[0].postMessage({ motionLab: m }, "*"), message);
  const answer = (request) => page.waitForFunction((r) => window.heard.find((m) => m.request === r), request, { timeout: 60000 }).then((m) => m.jsonValue());
  // the address asks Query's question, at its place
  const { query, widget } = await frame.evaluate(() => window.received.state);
  assert.deepEqual([widget, query.tab, query.coordinates], ["anatomy", "witness", [0, 1.5]]);
  await post({ do: "configuration", coordinates: [1, 1], request: "there" });
  assert.deepEqual(await answer("there"), { kind: "done", request: "there" });
  await post({ do: "configuration", coordinates: [1, 1, 1], request: "nowhere" });
  assert.deepEqual(await answer("nowhere"), { kind: "error", text: "configuration: it has 2 coordinates", request: "nowhere" });
  await post({ do: "theme", name: "Your session has expired: sign in", request: "words" });
  const { text } = await answer("words");
  assert.match(text, /^"Your session.*" is no theme$/);
  assert.ok(text.length < 40, "cut short");
  assert.equal(await frame.evaluate(() => window.received.state.notice?.text.includes("theme") ?? false), false, "the reader's lab does not say it");
  await post({ do: "link", request: "address" });
  const { kind, query: fields } = await answer("address");
  assert.equal(kind, "link");
  assert.match(fields, /&tab=witness&q=1,1(&|$)/);
  await post({ do: "figure", png: 1, request: "picture" });
  assert.match((await answer("picture")).png, /^data:image.png;base64,/);
  await post({ do: "save", request: "file" });
  await frame.locator("#asked-no").click();
  assert.deepEqual(await answer("file"), { kind: "saved", saved: false, request: "file" });
  await post({ do: "tab", id: "swept", request: "x".repeat(101) });
  await page.waitForFunction(() => window.heard.some((m) => m.kind === "error" && m.text.startsWith("request: a mark has")), null, { timeout: 20000 });
  // what comes of Plan and of the atlas is in the state
  const state = (wanted) => page.waitForFunction((w) => window.heard.filter((m) => m.kind === "state").find((m) => eval(w)(m)), wanted, { timeout: 60000 }).then((m) => m.jsonValue());
  await post({ do: "widget", id: "plan" });
  const { plan } = await state("(m) => m.plan");
  assert.deepEqual([plan.robot, plan.world, plan.planner, plan.stage, plan.start, plan.goal, plan.length], ["Reach", "Workbench", "rrt-connect", "growing", [2, 0], [3.1, 0], null]);
  await post({ do: "widget", id: "atlas" });
  const { atlas } = await state("(m) => m.atlas");
  assert.deepEqual([atlas.world, atlas.robots, atlas.refused], ["Apartment", [{ name: "Rusty", coordinates: [2.25, 6.25, 0] }], null]);
}, elsewhere);

/** The largest of the drawings that the lab shows, as left, top, width and height on the canvas. */
const largest = () => {
  const drawn = (w) => w.place && (w.kind === "handle" || (w.kind === "button" && / \{ /.test(w.name ?? "")));
  const places = window.received.tree.filter(drawn).map((w) => w.place);
  return places.sort((a, b) => b[2] * b[3] - a[2] * a[3])[0];
};

for (const [path, width, height, more] of [
  ["/embed.html", 600, 400, {}],
  ["/embed.html", 480, 300, {}],
  ["/embed.html?widget=anatomy", 480, 300, {}],
  ["/embed.html?widget=cspace", 600, 400, {}],
  ["/embed.html?widget=atlas", 480, 300, {}],
  ["/", 844, 390, { hasTouch: true, isMobile: true, deviceScaleFactor: 3 }],
  ["/", 640, 400, { deviceScaleFactor: 2 }],
  ["/", 360, 640, { hasTouch: true, isMobile: true, deviceScaleFactor: 3 }],
]) {
  lab(`the picture has its share: ${path} at ${width} x ${height}`, path, async (lab) => {
    await lab.page.waitForTimeout(1200);
    const [, , wide, high] = await lab.page.evaluate(largest);
    console.log(`# ${wide} x ${high}`);
    // half the height, or all of the width
    assert.ok(high >= 0.5 * height || wide >= 0.85 * width, `${wide} x ${high}`);
    assert.equal(await lab.page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, "nothing is cut off");
    await lab.shot(`share-${path.replace(/\W+/g, "-")}-${width}`);
  }, { options: { viewport: { width, height }, ...more } });
}

for (const [path, width] of [["/", 320], ["/", 280], ["/embed.html", 320], ["/embed.html", 280]]) {
  lab(`a narrow page does not scroll sideways: ${path} at ${width}`, path, async (lab) => {
    for (const id of ["dashboard", "anatomy", "cspace", "atlas", "plan"]) {
      await lab.send({ do: "widget", id });
      await lab.until((s) => s.widget === id);
      await lab.page.waitForTimeout(1200);
      const [drawn, wide, whole, room] = await lab.page.evaluate(() => {
        const controls = window.received.tree.filter((w) => w.place && w.kind !== "text");
        const right = Math.max(...controls.map((w) => w.place[0] + w.place[2]));
        return [right, document.getElementById("lab").clientWidth, document.documentElement.scrollWidth, innerWidth];
      });
      assert.ok(whole <= room && wide <= room, `${id}: the page has ${whole}, the canvas ${wide} of ${room}`);
      // 320 is a window of 1280 at 400 %: each control is in sight there
      if (width >= 320) assert.ok(drawn <= wide, `${id}: a control reaches ${drawn} of ${wide}`);
    }
    await lab.shot(`narrow-${path.replace(/\W+/g, "-")}-${width}`);
  }, { options: { viewport: { width, height: 256 } } });
}

lab("the reader does not read words of the page around as the lab's own", "/widgets.html", async ({ page }) => {
  const [frame] = await around(page, [""]);
  await frame.waitForFunction(() => window.received.state?.robots.length > 0);
  const heard = await page.evaluateHandle(() => {
    const heard = [];
    addEventListener("message", ({ data }) => data.motionLab?.kind === "error" && heard.push(data.motionLab.text));
    return heard;
  });
  const lie = "Your session has expired";
  const cut = lie.slice(0, 12); // of what is cited there are twelve characters at most
  const messages = [
    { do: "widget", id: lie },
    { do: "lesson", id: lie },
    { do: "tab", id: lie },
    { do: "light", role: lie },
    { do: "theme", name: lie },
    { do: "seed", seed: lie },
    { do: "robot", robot: lie, release: true },
    { do: "door", world: "Apartment", name: lie, open: true },
    { do: "robot", robot: "Rusty", drive: lie },
  ];
  for (const message of messages) await page.evaluate((m) => frames[0].postMessage({ motionLab: m }, "*"), message);
  await page.waitForFunction(([all, n]) => all.length >= n, [heard, messages.length], { timeout: 20000 });
  await page.waitForTimeout(1500);
  assert.ok((await page.evaluate((all) => all, heard)).every((text) => text.includes(cut)), "the page around hears why");
  const shown = await frame.evaluate(() => [document.body.innerText, document.getElementById("controls").textContent, window.received.state.notice?.text ?? ""].join(" "));
  assert.ok(!shown.includes(cut), shown.slice(Math.max(0, shown.indexOf(cut) - 80)));
  assert.equal(await frame.textContent("#alert"), "");
  // what it has is done
  await page.evaluate(() => frames[0].postMessage({ motionLab: { do: "widget", id: "atlas" } }, "*"));
  await frame.waitForFunction(() => window.received.state.widget === "atlas");
}, elsewhere);
