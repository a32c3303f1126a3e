// What a screen reader meets: everything once, with what is open and where the rail is.
import assert from "node:assert/strict";
import { after, before } from "node:test";
import { begin, end } from "./harness.mjs";
import { lab } from "./on_page.mjs";

before(begin);
after(end);

lab("each formula is labelled, scrolls in its own box, and shows where it goes on", "/?tick=20", async (lab) => {
  const { page } = lab;
  const labels = await page.locator("#formulas li:not([data-at]) > span").allTextContents();
  assert.deepEqual(labels, ["Rusty:", "Reach:", "Reach, 3 joints:", "Hitch:", "Hitch, trailer:"]);
  const long = await page.locator("#formulas li:visible").evaluateAll((items) => items.map((item) => item.scrollWidth - item.clientWidth));
  const which = long.findIndex((more) => more > 20);
  assert.ok(which >= 0, `one is longer than a phone is wide: ${long}`);
  const item = page.locator("#formulas li:visible").nth(which);
  // the ink at the right edge, above and below the letters: a shadow while it goes on, paper at its end
  const edge = async () => {
    const shot = await item.screenshot();
    return page.evaluate(async (bytes) => {
      const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
      const copy = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const at = copy.getContext("2d", { willReadFrequently: true });
      at.drawImage(image, 0, 0);
      const [r] = at.getImageData(image.width - 2, 1, 1, 1).data;
      const [paper] = at.getImageData(Math.round(image.width / 2), 1, 1, 1).data;
      return paper - r;
    }, [...shot]);
  };
  const before = await edge();
  await item.evaluate((element) => element.scrollTo(9999, 0));
  await page.waitForTimeout(300);
  const after = await edge();
  assert.ok(before > 20 && after < 10, `the shadow is ${before} dark, and ${after} at the end`);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
}, { options: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });
