// Planning in the page: the same path as natively, played as a run; a parked trailer's log, to the last bit.
import assert from "node:assert/strict";
import { readFileSync, rmSync } from "node:fs";
import { after, before } from "node:test";
import { join } from "node:path";
import { Lab, begin, end, native, shots } from "./harness.mjs";
import { lab } from "./on_page.mjs";

before(begin);
after(end);

lab("a planner in the page finds the path that it finds natively, and the arm drives it", "/?widget=plan", async (lab) => {
  const planned = JSON.parse(native("plan", "--robot", "reach", "--from", "2.0,0", "--to", "3.1,0", "--json"));
  await lab.until((s) => s.widget === "plan");
  await lab.click("Step");
  await lab.find(/^ *1 iterations/);
  await lab.click("Play");
  const path = await lab.find(/^path: /);
  assert.equal(path.name.replace(/\s+/g, " "), `path: ${planned.legs} legs, ${planned.length.toFixed(3)} rad`);
  const { iterations, samples, edges } = planned.effort;
  await lab.find(new RegExp(`^ *${iterations} iterations +${samples} samples`));
  await lab.find(new RegExp(`^ *${edges} edges asked`));
  await lab.shot("plan");
  await lab.click("Play it");
  const arrived = await lab.until((s) => {
    const [arm] = s.robots;
    return s.widget === "dashboard" && arm.coordinates && Math.abs(arm.coordinates[0] - 3.1) < 1e-4;
  }, 60000);
  assert.equal(arrived.robots.length, 1);
  await lab.shot("plan-played");
  // its robot alone in its world, which sees nothing, fits in an address
  await lab.send({ do: "pause" });
  const { tick } = await lab.until((s) => !s.playing);
  await lab.page.evaluate(() => void (window.told = new Promise((done) => addEventListener("motionlab", ({ detail }) => detail.kind === "link" && done(detail)))));
  await lab.send({ do: "link" });
  const { query, digest, error } = await lab.page.evaluate(() => window.told);
  assert.match(query, /^v=3&seed=\d+&world=workbench&sensor=none&inputs=/, error);
  const other = await Lab.open(`/?${query}`);
  const { notice } = await other.until((s) => s.notice);
  assert.equal(notice.text, `the same run to the last bit: tick ${tick}, digest ${digest}`);
  assert.deepEqual(await other.close(), []);
});

lab("a trailer parked by a planner is the same run in the page, to the last bit", "/", async (lab) => {
  const log = join(shots, "parked.mcap");
  rmSync(log, { force: true });
  const ends = ["--from", "6.5,2.5,0,0", "--to", "6.75,7,-1.5707963,-1.5707963"];
  const said = native("plan", "--robot", "hitch", ...ends, "--record", log);
  assert.match(said, /recorded +0 contacts/);
  const bytes = readFileSync(log).toString("base64");
  await lab.page.evaluate((text) => {
    const file = new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "parked.mcap");
    return window.motionLab.open(file);
  }, bytes);
  const { notice } = await lab.until((s) => s.notice?.text.startsWith("parked.mcap"));
  const [, ticks] = /played +(\d+) ticks/.exec(said);
  // and the second that the run goes on for
  assert.equal(notice.text, `parked.mcap: bit-identical, ${Number(ticks) + 20} of ${Number(ticks) + 20}`);
});
