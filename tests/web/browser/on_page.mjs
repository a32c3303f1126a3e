// Tests on pages of their own.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Lab } from "./harness.mjs";

/** A test on a page of its own, at the end of which nothing that must not happen may have happened. */
export function lab(name, path, body, options = {}) {
  test(name, { timeout: options.timeout ?? 180000 }, async () => {
    const page = await Lab.open(path, options);
    try {
      await body(page);
    } catch (error) {
      await page.shot(`failed-${name.replace(/\W+/g, "-")}`).catch(() => {});
      console.error(`# what happened on the page: ${page.faults.join("; ") || "no fault"}`);
      throw error;
    }
    assert.deepEqual(await page.close(), [], "no errors, no policy violations, no foreign requests");
  });
}

export const digestOf = (text) => /digest ([0-9a-f]{32})/.exec(text)[1];

export async function download(page, act) {
  const [file] = await Promise.all([page.waitForEvent("download"), act()]);
  return { name: file.suggestedFilename(), path: await file.path() };
}

const AXE = readFileSync(process.env.MOTION_LAB_AXE, "utf8");
const RULES = { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] };

/** What axe-core finds wrong with a page; its rules for contrast look at what is not canvas. */
export async function wrong(page) {
  await page.evaluate(AXE);
  const { violations, passes } = await page.evaluate((rules) => window.axe.run(document, rules), RULES);
  assert.ok(passes.length > 10, "axe has looked");
  return violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target.join(" ")).slice(0, 4).join(", ")}`);
}
