// Tests on pages of their own.
import assert from "node:assert/strict";
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
