// The second visit without a network, on sites put together from the parts of the one under test.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";
import { Lab, begin, end, origin, shots, target } from "./harness.mjs";

before(begin);
after(end);

/** A site that browsers keep, whose lab and words are those of one version. */
function site(version) {
  const [parts, out] = ["parts", "site"].map((kind) => join(shots, `offline-${kind}-${version}`));
  rmSync(parts, { recursive: true, force: true });
  cpSync(join(target, "web-parts"), parts, { recursive: true });
  const words = JSON.parse(readFileSync(join(parts, "lab.json"), "utf8"));
  words.widgets[0].misconception = `Version ${version}.`;
  writeFileSync(join(parts, "lab.json"), JSON.stringify(words));
  // a section of its own, which WebAssembly passes over, gives the lab another name
  const wasm = join(parts, "lab_bg.wasm");
  writeFileSync(wasm, Buffer.concat([readFileSync(wasm), Buffer.from([0, 3, 1, 118, version])]));
  execFileSync("node", ["assets/web/site.mjs", parts, out, "--offline"]);
  return out;
}

const ready = (page) => page.waitForFunction(() => window.received?.kinds.includes("ready"), null, { timeout: 60000 });
const shown = (page) => page.evaluate(() => JSON.parse(document.getElementById("files").textContent).widgets.dashboard.misconception);
const caches = (page) => page.evaluate(() => window.caches.keys());

/** Waits until a function of the page, which may take its time, comes to what is wanted. */
async function until(page, body, wanted) {
  for (let i = 0; i < 300; i++) {
    if ((await page.evaluate(body)) === wanted) return;
    await page.waitForTimeout(200);
  }
  assert.fail(`it never comes to ${wanted}: ${body}`);
}

/** Waits until so many versions are kept and the page's worker is the newest. */
const kept = (page, count) =>
  until(
    page,
    async () => {
      const registration = await navigator.serviceWorker.getRegistration();
      const rests = registration?.active?.state === "activated" && !registration.installing && !registration.waiting;
      return rests ? (await window.caches.keys()).length : null;
    },
    count,
  );

test("a second visit needs no server; a new version replaces the old whole, and no mix of both is kept", { timeout: 400000 }, async () => {
  const [one, two, three] = [1, 2, 3].map(site);
  let server = await serve(one, 0);
  const { port } = server.address();
  const stop = () => new Promise((done) => (server.close(done), server.closeAllConnections()));
  const lab = await Lab.open(`http://localhost:${port}/`);
  const { page } = lab;
  await kept(page, 1);
  await stop();

  // without a server: the lab runs, another page of the site too, and what is loaded late is there
  await page.reload();
  await ready(page);
  await lab.until((s) => s.tick > 5);
  assert.equal(await shown(page), "Version 1.");
  await Promise.all([page.waitForEvent("download"), page.click("#save-page")]);
  await page.goto(`http://localhost:${port}/embed.html?widget=anatomy&seed=7`);
  await ready(page);
  assert.equal((await lab.state()).widget, "anatomy");

  // a page that is open while the site changes has its own version's late files
  await page.goto(`http://localhost:${port}/`);
  await ready(page);
  server = await serve(two, port);
  const second = await lab.context.newPage();
  await second.goto(`http://localhost:${port}/widgets.html`);
  assert.ok((await second.textContent("main")).includes("Version 2."), "the network's page, before its worker is there");
  await kept(second, 2);
  await second.close();
  await page.evaluate(() => window.motionLab.send({ do: "pause" }));
  await Promise.all([page.waitForEvent("download"), page.click("#save-page")]);
  assert.equal(await shown(page), "Version 1.");

  // the next visit shows the new version, all of it
  const whole = async (folder) => {
    const used = await page.evaluate(() => performance.getEntriesByType("resource").map((entry) => new URL(entry.name).pathname));
    assert.ok(used.some((name) => name.endsWith(".wasm")), "the lab is among them");
    for (const name of used) assert.ok(existsSync(join(folder, name)), `${name} is of another version`);
  };
  await page.reload();
  await ready(page);
  assert.equal(await shown(page), "Version 2.");
  await whole(two);
  await stop();
  await page.reload();
  await ready(page);
  assert.equal(await shown(page), "Version 2.");
  await whole(two);

  // half an upload: the third version's worker beside the second's pages is refused
  const half = join(shots, "offline-site-half");
  rmSync(half, { recursive: true, force: true });
  cpSync(three, half, { recursive: true });
  for (const name of ["index.html", "embed.html", "widgets.html"]) for (const copy of [name, `${name}.br`]) cpSync(join(two, copy), join(half, copy));
  const before = await caches(page);
  server = await serve(half, port);
  const failed = await page.evaluate(async () => {
    const { installing } = await (await navigator.serviceWorker.getRegistration()).update();
    return installing && new Promise((done) => installing.addEventListener("statechange", () => done(installing.state)));
  });
  assert.equal(failed, "redundant");
  assert.deepEqual(await caches(page), before);
  await stop();
  await page.reload();
  await ready(page);
  assert.equal(await shown(page), "Version 2.");

  // a host that wants it no more takes everything away
  server = await serve(join(target, "web"), port);
  await page.reload();
  await until(page, async () => (await window.caches.keys()).length + (await navigator.serviceWorker.getRegistrations()).length, 0);
  await stop();
  await assert.rejects(page.reload());
  await lab.close();
});

test("nothing is kept unless the host asks for it", { timeout: 60000 }, async () => {
  const lab = await Lab.open("/");
  await lab.page.waitForTimeout(1500);
  assert.equal(await lab.page.evaluate(() => navigator.serviceWorker.getRegistrations().then((all) => all.length)), 0);
  assert.deepEqual(await caches(lab.page), []);
  assert.match(await (await fetch(`${origin()}/offline.js`)).text(), /const SITE = null;/);
  assert.deepEqual(await lab.close(), []);
});
