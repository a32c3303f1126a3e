// Runs as pages: the program writes what the lab saves, and any browser opens it.
import assert from "node:assert/strict";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { after, before } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, native, shots, target } from "./harness.mjs";
import { digestOf, lab } from "./on_page.mjs";

before(begin);
after(end);

/** What the site's build made for the program. */
const template = join(target, "share", "motion-lab", "run-page.template");

/** A file of this name that is not there yet. */
const fresh = (name) => {
  const file = join(shots, name);
  rmSync(file, { force: true });
  return file;
};

/** The page that the program writes of a log. */
function exported(log, name) {
  const file = fresh(name);
  native("export", log, "--template", template, "-o", file);
  return file;
}

/** Opens a log in the lab and returns the page that the lab saves of all of it. */
async function savedBy(lab, log, ticks) {
  const name = log.split("/").at(-1);
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate(([text, name]) => window.motionLab.open(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name)), [bytes, name]);
  await lab.until((s) => s.notice?.text.startsWith(`${name}: bit-identical`), 60000);
  await lab.send({ do: "seek", tick: ticks });
  await lab.until((s) => s.tick === ticks, 60000);
  return lab.page.evaluate(() => window.motionLab.savedPage());
}

/** What a page on disk says of its run, how long it took, and how many scripts it has. */
async function read(file) {
  const begun = Date.now();
  const page = await Lab.open(`file://${file}`, { wait: false });
  await page.page.waitForFunction(() => document.documentElement.dataset.verdict, null, { timeout: 60000 });
  const said = await page.page.textContent("#verdict");
  const scripts = await page.page.evaluate(() => document.scripts.length);
  assert.deepEqual(await page.page.evaluate(() => window.violations), []);
  assert.deepEqual(await page.close(), []);
  return { said, scripts, ms: Date.now() - begun };
}

lab("the program writes the page of a run that the lab saves, to the last byte", "/?seed=3&tick=1200", async (lab) => {
  await lab.until((s) => s.tick === 1200);
  const saved = await lab.page.evaluate(() => window.motionLab.savedPage());
  const log = fresh("minute-of-page.mcap");
  native("record", "--seed", "3", "--seconds", "60", "-o", log);
  const file = exported(log, "minute-of-page.html");
  const own = readFileSync(file, "utf8");
  console.log(`# ${own.length} bytes`);
  assert.ok(own === saved, "a minute");
  const { said, scripts, ms } = await read(file);
  console.log(`# verified after ${ms} ms`);
  assert.equal(scripts, 3);
  assert.equal(said, `Verified: bit-identical, 1200 of 1200, digest ${digestOf(said)}.`);
  assert.match(native("info", log), new RegExp(digestOf(said)), "the digest that was recorded");
  // a page with one digit changed: of the log, which then is none, and of the seed in the log
  const forged = own.replace(/(id="bytes">.{2000})(.)/s, (_, before, sign) => before + (sign === "A" ? "B" : "A"));
  writeFileSync(join(shots, "forged-page.html"), forged);
  assert.match((await read(join(shots, "forged-page.html"))).said, /^Not verified: |^Another run: /);
  // a script, a range sensor and names that would end a script
  const name = "</script><!--\"'&%LOG%<script>alert(1)</script>";
  const world = join(shots, "named.ron");
  const quoted = JSON.stringify(name);
  writeFileSync(world, native("world", "show", "workbench").replace('"the post"', quoted).replace('"Workbench"', quoted));
  const driving = fresh("driving-of-page.mcap");
  // to its last input and beyond: the lab forgets those after the last tick, which makes it another run
  native("record", "--seed", "9", "--seconds", "60", "--script", "tests/scripts/driving.ron", "--rays", "90", "-o", driving);
  const named = fresh("named-of-page.mcap");
  native("record", "--world", world, "--seed", "18446744073709551615", "--seconds", "5", "-o", named);
  for (const [log, ticks] of [[driving, 1200], [named, 100]]) {
    const saved = await savedBy(lab, log, ticks);
    const file = exported(log, log.replace(/.*\/(.*)\.mcap/, "$1.html"));
    const own = readFileSync(file, "utf8");
    assert.ok(own === saved, log);
    const { said, scripts } = await read(file);
    assert.equal(scripts, 3, "no name of the run is read as markup");
    assert.equal(said, `Verified: bit-identical, ${ticks} of ${ticks}, digest ${digestOf(said)}.`);
    assert.match(native("info", log), new RegExp(digestOf(said)));
  }
  // the lab opens it; the page of a page is the same
  await lab.page.evaluate((text) => window.motionLab.open(new File([text], "own.html")), own);
  const { notice } = await lab.until((s) => s.seed === "3" && s.notice?.text.startsWith("own.html"), 60000);
  assert.equal(notice.text, "own.html: bit-identical, 1200 of 1200");
  assert.ok(readFileSync(exported(file, "again-of-page.html"), "utf8") === own);
  // and a page that the lab saved is a template
  const other = fresh("by-page.html");
  native("export", named, "--template", file, "-o", other);
  assert.ok(readFileSync(other, "utf8") === readFileSync(join(shots, "named-of-page.html"), "utf8"));
});
