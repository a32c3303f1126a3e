// Captures in pixels, and the formulas beside the canvas.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before } from "node:test";
import { begin, end } from "./harness.mjs";
import { download, lab } from "./on_page.mjs";

before(begin);
after(end);

/** The chunks of a PNG, each with its kind and bytes. */
function chunks(bytes) {
  assert.deepEqual([...bytes.subarray(0, 8)], [137, 80, 78, 71, 13, 10, 26, 10]);
  const found = [];
  for (let at = 8; at < bytes.length; ) {
    const length = bytes.readUInt32BE(at);
    found.push({ kind: bytes.toString("latin1", at + 4, at + 8), data: bytes.subarray(at + 8, at + 8 + length) });
    at += length + 12;
  }
  return found;
}

/** What a browser sees in a picture of this type: its size, and for each picture its time and the number of its colours. */
const seen = (page, bytes, type) =>
  page.evaluate(
    async ([text, kind]) => {
      const decoder = new ImageDecoder({ type: kind, data: Uint8Array.from(atob(text), (c) => c.charCodeAt(0)) });
      await decoder.tracks.ready;
      await decoder.completed;
      const pictures = [];
      for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; frameIndex++) {
        const { image } = await decoder.decode({ frameIndex });
        const { displayWidth: width, displayHeight: height, duration } = image;
        const canvas = new OffscreenCanvas(width, height);
        const at = canvas.getContext("2d");
        at.drawImage(image, 0, 0);
        const pixels = new Uint32Array(at.getImageData(0, 0, width, height).data.buffer);
        const sum = pixels.reduce((hash, pixel) => (Math.imul(hash, 31) + pixel) | 0, 0);
        pictures.push({ width, height, milliseconds: (duration ?? 0) / 1000, colours: new Set(pixels).size, paper: pixels[0] & 0xffffff, sum });
      }
      return pictures;
    },
    [Buffer.from(bytes).toString("base64"), type],
  );

/** Captures the widget in front in this form, after these presses. */
async function captured(lab, form, ...presses) {
  await lab.page.focus("#lab");
  await lab.page.keyboard.press("i", { delay: 120 });
  for (const name of [form, ...presses]) {
    // the form takes its place in some frames, and frames are slow here
    await lab.find(name);
    await lab.page.waitForTimeout(700);
    await lab.click(name);
  }
  await lab.page.waitForTimeout(700);
  const { name, path } = await download(lab.page, () => lab.click("Save"));
  return { name, bytes: readFileSync(path) };
}

lab("a PNG is the sheet in pixels, with seed, digest and tick among its chunks", "/?seed=7&tick=40", async (lab) => {
  await lab.until((s) => s.tick === 40);
  const svg = await captured(lab, "SVG");
  const [, width, height] = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(svg.bytes.toString());
  const png = await captured(lab, "PNG", "2\u00d7");
  assert.equal(png.name, "dashboard.png");
  const all = chunks(png.bytes);
  const [size] = await seen(lab.page, png.bytes, "image/png");
  assert.deepEqual([size.width, size.height], [width, height].map((side) => Math.ceil(2 * side)));
  assert.ok(size.colours > 30, `${size.colours} colours: letters and lines are smooth`);
  assert.equal(size.paper, 0xf7fafb, "on the light paper, fbfaf7");
  const notes = Object.fromEntries(all.filter(({ kind }) => kind === "tEXt").map(({ data }) => data.toString("latin1").split("\0")));
  const digest = /Digest: ([0-9a-f]{32})/.exec(svg.bytes.toString())[1];
  assert.deepEqual([notes.Seed, notes.Tick, notes.Digest], ["7", "40", digest]);
  console.log(`# ${size.width} x ${size.height}, ${size.colours} colours, ${png.bytes.length} bytes`);
});

lab("a GIF plays the run over its span of ticks", "/?seed=7&tick=40&world=workbench", async (lab) => {
  await lab.until((s) => s.tick === 40);
  const gif = await captured(lab, "GIF", "column, 640", "1\u00d7");
  assert.equal(gif.name, "dashboard.gif");
  const pictures = await seen(lab.page, gif.bytes, "image/gif");
  console.log(`# ${pictures.length} pictures of ${pictures[0].width} x ${pictures[0].height}, ${gif.bytes.length} bytes`);
  // from tick 0 to tick 40, every fourth
  assert.equal(pictures.length, 11);
  assert.ok(pictures.every((picture) => picture.milliseconds === 200 && picture.colours > 10 && picture.paper === 0xf7fafb), JSON.stringify(pictures));
  assert.equal(new Set(pictures.map((picture) => picture.sum)).size, 11, "the arm moves from each to the next");
  assert.match(gif.bytes.toString("latin1"), /Seed: 7; Digest: [0-9a-f]{32}; Tick: 0 to 40/);
});

lab("a page is told the widget in front in pixels when it asks for them", "/?widget=anatomy", async (lab) => {
  const heard = await lab.page.evaluate(
    () =>
      new Promise((done) => {
        addEventListener("motionlab", ({ detail }) => detail.kind === "figure" && done(detail));
        window.motionLab.send({ do: "figure", png: 1 });
      }),
  );
  assert.match(heard.png, /^data:image\/png;base64,/);
  const bytes = Buffer.from(heard.png.split(",")[1], "base64");
  const [size] = await seen(lab.page, bytes, "image/png");
  assert.ok(size.width > 300 && size.colours > 30, JSON.stringify(size));
  assert.ok(chunks(bytes).some(({ kind, data }) => kind === "tEXt" && data.toString("latin1").startsWith("Configuration\0T2(")));
});

lab("an angle has one spelling, the annulus's formula stands beside the space, and code is shown on demand", "/?widget=cspace", async (lab) => {
  const { page } = lab;
  const shown = page.locator("#formulas li[data-at]:visible");
  const texts = async () => (await shown.locator("math").allTextContents()).map((text) => text.replace(/\s/g, ""));
  await lab.until((s) => s.formulas.includes("annulus"));
  assert.deepEqual(await texts(), ["|L1\u2212L2|\u2264|x|\u2264L1+L2"]);
  const code = shown.locator("code");
  assert.equal(await code.isVisible(), false);
  await shown.locator("summary").focus();
  await page.keyboard.press("Enter");
  assert.equal(await code.textContent(), "AnyRobot::annulus");
  assert.ok(await code.isVisible());
  await lab.shot("annulus");
  assert.equal(await page.locator("#formulas li[data-at]:not(:has(code))").count(), 0);
  // in all formulas of the page: the letter alone, or with a subscript
  const angles = await page.evaluate(() =>
    [...document.querySelectorAll("#formulas mi")]
      .filter((letter) => /[\u03b8\u03d1]/.test(letter.textContent))
      .map((letter) => {
        const index = letter.parentElement.tagName === "msub" ? letter.nextElementSibling.textContent : "";
        const after = letter.parentElement.tagName === "msub" ? null : letter.nextElementSibling;
        return `${letter.textContent}${index}${after?.tagName === "mn" ? ` ${after.textContent}` : ""}`;
      }),
  );
  assert.deepEqual([...new Set(angles)].sort(), ["\u03b8", "\u03b81", "\u03b82", "\u03b83", "\u03b8i", "\u03b8k"]);
  // and on the canvas
  const names = (await lab.tree()).map((w) => w.name);
  assert.ok(names.some((name) => name.startsWith("\u03b8\u2081 and \u03b8\u2082")), names.join(" | "));
  assert.ok(!names.some((name) => /\u03b8\d|\u03d1/.test(name)));
});
