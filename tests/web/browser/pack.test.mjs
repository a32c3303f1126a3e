// The course pack, from the zip to the gradebook. What a platform holds is compared with SCORM 1.2's run-time environment
// (ADL, October 2001, section 3.4): the names of the data model, its words and its forms of time.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Lab, begin, end, native, shots, target } from "./harness.mjs";
import { seen, send } from "./on_book.mjs";
import { download, wrong } from "./on_page.mjs";
import { course, inner, pack, platform, readByPython, unpacked } from "./on_platform.mjs";
import { items } from "../../../assets/web/course/items.mjs";
import { judge } from "../../../assets/web/course/judge.js";
import { timespan, timeOfDay } from "../../../assets/web/course/scorm.js";
import { crc32 } from "../../../assets/web/course/zip.mjs";

const ROOT = join(import.meta.dirname, "../../..");
const ITEMS = 36; // the book's 16, the lab's 24 lessons, of which 7 are in the book, and 3 assignments

let folder = null;
before(async () => {
  folder = unpacked(pack());
  await begin();
});
after(end);

/** CMITimespan: two to four digits of hours, at most two behind the seconds. */
const TIMESPAN = /^\d{2,4}:\d{2}:\d{2}(\.\d{1,2})?$/;

/** A test on a platform of its own. */
function onPlatform(name, body, { query = "", ...options } = {}) {
  test(name, { timeout: 240000 }, async () => {
    const lms = await platform(folder, options);
    const lab = await Lab.open(`${lms.origin}/${query}`, { wait: false });
    try {
      await body(lab, lms);
    } catch (error) {
      await lab.shot(`failed-${name.replace(/\W+/g, "-").slice(0, 60)}`).catch(() => {});
      console.error(`# what happened on the page: ${lab.faults.join("; ") || "no fault"}`);
      throw error;
    } finally {
      lms.close();
    }
    assert.deepEqual(await lab.close(), [], "no errors, no policy violations, no foreign requests");
  });
}

const shareIs = async (page, text) => (await inner(page, /\/index\.html/)).waitForFunction((text) => document.getElementById("share").textContent === text, text, { timeout: 30000 });
const go = (page, hash) => course(page).evaluate((hash) => (location.hash = hash), hash);
async function answer(book, i, text) {
  const input = book.locator(".answer[data-task] input").nth(i); // once the book's script is there
  await input.fill(text);
  await input.press("Enter");
}

test("the zip is read by others, has what its manifest says, and is the same each time", { timeout: 120000 }, () => {
  // the check value of CRC-32 (Williams, 1993)
  assert.equal(crc32(Buffer.from("123456789")), 0xcbf43926);
  const zip = pack("book,lessons");
  const page = (name) => execFileSync("unzip", ["-p", zip, name], { encoding: "utf8" });
  assert.match(page("teacher.html"), /In this pack <em>The book<\/em> and <em>Lessons<\/em> count\. If only/);
  assert.match(page("index.html"), /"counts":\["book","lessons"\]/, "from a folder too");
  const first = readFileSync(zip);
  const found = readByPython(zip);
  assert.deepEqual(found.files, found.names.filter((name) => name !== "imsmanifest.xml"));
  assert.deepEqual(found.dates, ["(1980, 1, 1, 0, 0, 0)"]);
  assert.deepEqual([found.start, found.type, found.version, found.counts, found.mastery], ["index.html", "sco", "1.2", "book,lessons", false]);
  for (const name of ["index.html", "teacher.html", "lab/book.html", "folder/book.html", "assignments/back_in.ron"]) assert.ok(found.names.includes(name), name);
  execFileSync("unzip", ["-tq", zip]);
  pack("book,lessons");
  assert.ok(first.equals(readFileSync(zip)), "the same bytes");
  assert.throws(() => pack("exams"), /exams is no part/);
});

test("an assignment that the site's build has not told of is refused by name", () => {
  const [book, lab] = ["book.json", "lab.json"].map((name) => JSON.parse(readFileSync(join(target, "web-parts", name), "utf8")));
  assert.ok(items(book, lab, "book/assignments").some(({ id }) => id === "back_in"));
  const before = { ...lab, assignments: lab.assignments.filter(({ id }) => id !== "back_in") };
  assert.throws(() => items(book, before, "book/assignments"), /^Error: back_in\.ron came after the site: run assets\/web\/build again$/);
});

test("times have the forms of the run-time environment", () => {
  assert.equal(timespan(0), "0000:00:00.00");
  assert.equal(timespan(3723.456), "0001:02:03.46");
  assert.equal(timespan(59.999), "0000:01:00.00");
  assert.equal(timespan(4e9), "9999:00:00.00");
  assert.equal(timeOfDay(new Date(2026, 0, 1, 3, 4, 5)), "03:04:05");
});

test("a run is judged by where it is, how long, and what it touched", () => {
  const car = { robot: "Hitch", names: ["x", "y", "θ"], at: [6.75, 8.875, -Math.PI / 2], within: [0.2, 0.2, 0.1], is_angle: [false, false, true], hold: 20, ticks: 2400, seconds: 120, contacts: 0 };
  const at = (tick, coordinates, contacts = 0) => ({ tick, robots: [{ name: "Hitch", coordinates, contacts }] });
  const parked = [6.7, 8.9, (3 * Math.PI) / 2];
  const says = judge(car);
  assert.equal(says(at(1, [6.75, 7.875, 0])).text, "Off by y 1.00 m, θ 90°; 120 s are left.");
  assert.equal(says(at(0, [6.75, 7.875, 0])).text, "Press Play to begin: you have 120 s.");
  assert.equal(says(at(100, parked)).text, "It is there: let it stand for a second.");
  assert.equal(says(at(119, parked)).isDone, false);
  assert.equal(says(at(120, parked)).isDone, true);
  assert.equal(says(at(110, parked)).isDone, false);
  assert.equal(says(at(125, parked)).isDone, false, "who goes back begins to wait anew");
  assert.equal(says(at(131, parked)).isDone, true);
  assert.match(says(at(140, parked, 1)).text, /touched something \(1 contact\)/);
  assert.match(says(at(2401, parked)).text, /120 s are over/);
  assert.equal(says({ tick: 1, robots: [{ name: "Rusty", coordinates: [6.75, 8.875, 0], contacts: 0 }] }), null);
});

onPlatform("what is done comes to the platform: a wrong answer, a right one, a lesson, and the dots are there next time", async ({ page }, lms) => {
  await shareIs(page, `0 of ${ITEMS} done: 0 %`);
  assert.equal(await course(page).textContent("#kept"), "Kept by your course.");
  assert.deepEqual([lms.kept.core.lesson_status, lms.kept.core.exit, lms.kept.suspend_data], ["incomplete", "suspend", ""]);
  await go(page, "#book/answer-1");
  const book = await inner(page, /book\.html/);
  await answer(book, 0, "0.5");
  await answer(book, 0, "0.0307");
  await shareIs(page, `1 of ${ITEMS} done: 2 %`);
  const { interactions, objectives, core, suspend_data } = lms.kept;
  const [wrong, right] = Object.values(interactions.childArray ?? interactions).filter((one) => one?.id);
  assert.deepEqual([wrong.id, wrong.type, wrong.student_response, wrong.result], ["book.answer-1", "numeric", "0.5", "wrong"]);
  assert.deepEqual([right.id, right.type, right.student_response, right.result], ["book.answer-1", "numeric", "0.0307", "correct"]);
  assert.match(right.time, /^\d{2}:\d{2}:\d{2}$/);
  assert.deepEqual([core.score.raw, core.score.min, core.score.max], ["2", "0", "100"].map((text) => (typeof core.score.raw === "number" ? Number(text) : text)));
  assert.equal(suspend_data, "answer-1");
  assert.match(core.session_time, TIMESPAN);
  const parts = Object.values(objectives.childArray ?? objectives).filter((one) => one?.id).map((one) => [one.id, String(one.score.raw), one.status]);
  assert.deepEqual(parts, [["book", "6", "incomplete"], ["lessons", "0", "not attempted"], ["assignments", "0", "not attempted"]]);

  // a lesson that the book has too: the arm touches below 1.4009, at 1.42 it is 7 mm off
  await go(page, "#lessons/near");
  const lab = await inner(page, /embed\.html/);
  await seen(lab, () => window.received?.state?.query?.tab === "witness" && window.received.tree.length > 0);
  await lab.evaluate(() => {
    const slider = window.received.tree.find((w) => w.kind === "slider" && w.name === "θ₂");
    window.motionLab.send({ do: "act", id: slider.id, action: "set", value: "1.42" });
  });
  await shareIs(page, `2 of ${ITEMS} done: 5 %`);
  await page.screenshot({ path: join(shots, "course-lesson.png") });
  const lesson = Object.values(lms.kept.interactions.childArray ?? lms.kept.interactions).filter((one) => one?.id)[2];
  assert.deepEqual([lesson.id, lesson.type, lesson.result], ["book.near", "performance", "correct"]);
  assert.match(lesson.latency, TIMESPAN);
  assert.match(lesson.latency, /[1-9]/);
  assert.equal(lms.kept.suspend_data, "near answer-1");

  // who leaves has ended the session, and finds all of it again: in the list, and as dots of the book
  const commits = lms.commits;
  await page.goto("about:blank");
  assert.ok(lms.commits > commits, "LMSFinish has written it down");
  await page.goto(`${lms.origin}/`);
  await shareIs(page, `2 of ${ITEMS} done: 5 %`);
  assert.deepEqual(await course(page).locator("#list [data-done]").evaluateAll((all) => [...new Set(all.map(({ dataset }) => dataset.item))]), ["near", "answer-1"]);
  await go(page, "#book");
  await (await inner(page, /book\.html/)).waitForSelector("#witness .then:visible", { timeout: 20000 });
  await shareIs(page, `2 of ${ITEMS} done: 5 %`);

  // somebody else at the same computer begins with nothing
  await page.goto("about:blank");
  lms.kept = null;
  await page.goto(`${lms.origin}/#`);
  await go(page, "#book");
  await (await inner(page, /book\.html/)).waitForSelector("#dots li", { timeout: 20000 });
  await page.waitForTimeout(1000);
  await shareIs(page, `0 of ${ITEMS} done: 0 %`);
  assert.equal(lms.kept.suspend_data, "");
});

/** The names of all that is to be done. */
const names = () => JSON.parse(/id="course">(.*?)</.exec(readFileSync(join(folder, "index.html"), "utf8"))[1]).items;

test("the last thing that counts completes the course; the others are for practice", { timeout: 240000 }, async () => {
  const book = names().filter(({ parts }) => parts.includes("book")).map(({ id }) => id);
  assert.deepEqual([names().length, book.length], [ITEMS, 16]);
  const kept = { core: { lesson_status: "incomplete", entry: "resume" }, suspend_data: book.filter((id) => id !== "answer-2").join(" "), launch_data: "book" };
  const lms = await platform(folder, { kept });
  try {
    const { page, context } = await Lab.open(`${lms.origin}/`, { wait: false });
    await shareIs(page, "15 of 16 done: 93 %");
    assert.equal(await course(page).textContent("#share-lessons"), "7 of 24 done, for practice");
    await go(page, "#book");
    await answer(await inner(page, /book\.html/), 1, "0.5");
    await shareIs(page, "All 16 done: 100 %");
    assert.deepEqual([lms.kept.core.lesson_status, Number(lms.kept.core.score.raw)], ["completed", 100]);
    await context.close();
  } finally {
    lms.close();
  }
});

onPlatform("in a window of its own the course finds the platform that opened it", async ({ page, context }, lms) => {
  const [opened] = await Promise.all([context.waitForEvent("page"), page.click("button")]);
  await opened.waitForFunction(() => document.getElementById("kept")?.textContent === "Kept by your course.");
  assert.equal(lms.kept.core.lesson_status, "incomplete");
  await opened.close();
}, { query: "?window" });

const STUB = { LMSInitialize: "true", LMSGetValue: "", LMSSetValue: "false", LMSCommit: "true", LMSFinish: "true", LMSGetLastError: "405", LMSGetErrorString: "Incorrect Data Type" };
const stub = (answers) => `API = {${Object.entries({ ...STUB, ...answers }).map(([name, answer]) => `${name}: () => ${JSON.stringify(answer)}`).join()}};`;

onPlatform("a platform that takes nothing is told of in words, and the course goes on", async ({ page }) => {
  await go(page, "#book");
  await answer(await inner(page, /book\.html/), 0, "0.0307");
  await shareIs(page, `1 of ${ITEMS} done: 2 %`);
  const told = await course(page).textContent("#kept");
  assert.equal(told, "Your course did not take this: cmi.suspend_data, Incorrect Data Type (error 405). It is tried again with what you do next; tell your teacher if it stays.");
}, { api: stub({}) });

onPlatform("a platform that does not begin is told of, and the browser keeps what is done", async ({ page }) => {
  await shareIs(page, `0 of ${ITEMS} done: 0 %`);
  const told = await course(page).textContent("#kept");
  assert.equal(told, "Your course's platform does not begin: General Exception (error 101). Nothing comes to its gradebook. Kept in this browser alone.");
}, { api: stub({ LMSInitialize: "false", LMSGetLastError: "101", LMSGetErrorString: "General Exception" }) });

onPlatform("a teacher who looks at it leaves no mark", async ({ page }) => {
  await go(page, "#book");
  await answer(await inner(page, /book\.html/), 0, "0.0307");
  await shareIs(page, `1 of ${ITEMS} done: 2 %`);
  assert.equal(await course(page).textContent("#kept"), "You look at it without a mark: nothing is recorded.");
  assert.deepEqual(await page.evaluate(() => window.sets), 0);
}, { api: `sets = 0; ${stub({})} API.LMSSetValue = () => (sets++, "true"); API.LMSGetValue = (name) => name === "cmi.core.lesson_mode" ? "browse" : "";` });

/** The script of a way that the lab itself has planned. */
function planned(robot, world, to) {
  const path = join(shots, `planned-${robot}.ron`);
  native("--quiet", "--force", "plan", "--robot", robot, "--world", world, "--to", to, "--script", path);
  return readFileSync(path, "utf8").replace(/\s+/g, "");
}

/** Plays a way in an assignment's lab, saves it there and has it marked. */
async function handIn(page, id, robot, world, to) {
  const outer = await inner(page, /\/index\.html/);
  await outer.evaluate((id) => (location.hash = `#assignments/${id}`), id);
  const lab = await inner(page, /embed\.html/);
  const says = (words) => outer.waitForFunction((words) => new RegExp(words).test(document.getElementById("task-far").textContent), words, { timeout: 60000 });
  // its time does not run while it is read
  await says("^Press Play to begin: you have 120 s\\.$");
  await lab.waitForTimeout(700);
  assert.equal(await lab.evaluate(() => window.received.state.tick), 0);
  await send(lab, { do: "play" });
  await says("^Off by .*; 1\\d\\d s are left\\.$");
  assert.equal(await outer.textContent("#task-said"), "", "who listens does not hear each second");
  assert.equal((await lab.evaluate(() => window.received.state.robots))[0].driven, true, "it stands until somebody drives it");
  // who saves too early is told so, while the run goes on too
  await download(page, () => outer.click("#save"));
  await says(`^Saved as ${id}\\.mcap, but it is not there yet and would not pass\\. Off by .*; 1\\d\\d s are left\\.$`);
  assert.match(await outer.textContent("#task-said"), /would not pass/);
  await send(lab, { do: "open", query: `widget=dashboard&world=${world}&script=${encodeURIComponent(planned(robot, world, to))}&tick=30` });
  await seen(lab, () => window.received.state.tick === 30);
  await says("Off by");
  await send(lab, { do: "seek", tick: 160 });
  await send(lab, { do: "play" });
  await says("^It is there, and stays");
  assert.match(await outer.textContent("#task-said"), /^It is there/);
  await send(lab, { do: "pause" });
  await page.screenshot({ path: join(shots, `course-${id}.png`) });
  // a page of the lab's own does not have to ask
  const { path, name } = await download(page, () => outer.click("#save"));
  assert.equal(name, `${id}.mcap`);
  const log = join(shots, `${id}.mcap`);
  writeFileSync(log, readFileSync(path));
  const { passed, points } = JSON.parse(native("grade", "--json", join(folder, "assignments", `${id}.ron`), log).split("\n")[0]);
  assert.deepEqual([passed, points], [true, 10]);
}

onPlatform("an assignment, from the page to the mark", async ({ page }, lms) => {
  await handIn(page, "back_in", "Hitch", "lot", "6.75,8.875,-1.5707963267948966");
  assert.equal(lms.kept.suspend_data, "back_in");
});

test("from a folder, without any server, book and lab run, and the browser keeps what is done", { timeout: 240000 }, async () => {
  const lab = await Lab.open(pathToFileURL(join(folder, "index.html")).href, { wait: false });
  const { page } = lab;
  await shareIs(page, `0 of ${ITEMS} done: 0 %`);
  assert.match(await page.textContent("#folder"), /You opened this page from a folder/);
  await handIn(page, "past_the_post", "Reach", "workbench", "3.1,0");
  await page.evaluate(() => (location.hash = "#book/near"));
  const book = await inner(page, /folder\/book\.html/);
  await answer(book, 0, "0.0307");
  await shareIs(page, `2 of ${ITEMS} done: 5 %`);
  await book.click("#witness motion-figure");
  await book.waitForSelector("iframe:not([data-waits])", { timeout: 90000 });
  const figure = await inner(page, /folder\/lens\.html/);
  await figure.locator("#sliders label").nth(1).locator("input").evaluate((input) => {
    input.value = 1.42;
    for (const type of ["input", "change"]) input.dispatchEvent(new Event(type));
  });
  await shareIs(page, `3 of ${ITEMS} done: 8 %`);
  await page.screenshot({ path: join(shots, "course-folder.png") });
  await page.reload();
  await shareIs(page, `3 of ${ITEMS} done: 8 %`);
  assert.deepEqual(await lab.close(), []);
});

for (const colorScheme of ["light", "dark"]) {
  test(`axe finds nothing wrong with the course's pages: ${colorScheme}`, { timeout: 120000 }, async () => {
    const found = {};
    for (const path of ["index.html", "index.html#assignments/back_in", "teacher.html"]) {
      const lab = await Lab.open(pathToFileURL(join(folder, "index.html")).href.replace("index.html", path), { wait: false, options: { colorScheme } });
      await lab.page.waitForTimeout(1000);
      // frames are pages of their own, which are looked at as such
      found[path] = (await wrong(lab.page)).filter((text) => !/ iframe/.test(text));
      for (const width of [1280, 390, 280]) {
        await lab.page.setViewportSize({ width, height: 800 });
        assert.equal(await lab.page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0, `${path} at ${width}`);
      }
      await lab.close();
    }
    assert.deepEqual(found, Object.fromEntries(Object.keys(found).map((path) => [path, []])));
  });
}
