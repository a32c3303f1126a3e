// Tests on a figure of the book.
import { origin } from "./harness.mjs";

/** Opens the book and goes into a figure; gives the lab's frame once it draws. */
export async function within(page, id) {
  await page.goto(`${origin()}/book.html`);
  await page.click(`#${id} motion-figure`);
  await page.waitForSelector("iframe:not([data-waits])", { timeout: 90000 });
  return page.frames()[1];
}

/** Waits until something is so in the frame, which has what the lab told last in `window.received`. */
export const seen = (frame, wanted, ...given) => frame.waitForFunction(wanted, ...(given.length ? given : [null]), { timeout: 20000 });

/** Asks the lab in the frame for something. */
export const send = (frame, message) => frame.evaluate((m) => window.motionLab.send(m), message);
