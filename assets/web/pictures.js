// Pixels out of the lab's own SVG, by the browser's letters: PNG, and GIF of a row of sheets.

/** The notes of a sheet, each a keyword and its text: seed, digest, tick. */
function notesOf(svg) {
  const named = { lt: "<", gt: ">", quot: '"', amp: "&" };
  const text = (/<metadata>([^<]*)</.exec(svg)?.[1] ?? "").replace(/&(\w+);/g, (_, name) => named[name]);
  return text.split("; ").map((note) => /^([\w ]+): (.*)$/s.exec(note)?.slice(1)).filter(Boolean);
}

/** Paints a sheet, `scale` dots for each of its pixels, on a canvas that is as large unless one is given. */
async function paint(svg, scale, canvas) {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await image.decode();
  const [width, height] = [image.naturalWidth, image.naturalHeight].map((size) => Math.ceil(size * scale));
  canvas ??= Object.assign(document.createElement("canvas"), { width, height });
  const at = canvas.getContext("2d", { willReadFrequently: true });
  // a lower sheet than the canvas goes on as bare paper
  if (canvas.height > height || canvas.width > width) at.drawImage(image, 0, 0, 1, 1, 0, 0, canvas.width, canvas.height);
  at.drawImage(image, 0, 0, width, height);
  return at;
}

const latin = (text) => Uint8Array.from(text, (c) => (c.charCodeAt(0) < 256 ? c.charCodeAt(0) : 63));

/** A chunk of a PNG. */
function chunk(kind, data) {
  const bytes = new Uint8Array(data.length + 12);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  bytes.set(latin(kind), 4);
  bytes.set(data, 8);
  let crc = ~0;
  for (const byte of bytes.subarray(4, -4)) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  view.setUint32(bytes.length - 4, ~crc);
  return bytes;
}

/** A sheet as a PNG, its notes among the chunks. */
export async function png(svg, scale) {
  const { canvas } = await paint(svg, scale);
  const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  if (!blob) throw new Error(`the browser paints no picture of ${canvas.width} x ${canvas.height} pixels`);
  const head = 33; // the signature and the first chunk
  const notes = notesOf(svg).map(([key, text]) => chunk("tEXt", latin(`${key}\0${text}`)));
  return new Blob([blob.slice(0, head), ...notes, blob.slice(head)], { type: "image/png" });
}

/** The code of what does not change from one picture to the next. */
const SAME = 255;
const bin = (c) => ((c >> 3) & 31) | ((c >> 6) & 0x3e0) | ((c >> 9) & 0x7c00);

/** At most 255 colours: those that the sheets name, then the most frequent of some of them; and the nearest for each colour of 15 bits. */
async function fewColours(sheets, scale) {
  const named = (sheets[0].match(/#[0-9a-f]{6}\b/g) ?? []).map((text) => parseInt(text.slice(5) + text.slice(3, 5) + text.slice(1, 3), 16));
  const [count, colour] = [new Uint32Array(32768), new Uint32Array(32768)];
  for (const part of [0, 0.5, 1]) {
    const at = await paint(sheets[Math.round(part * (sheets.length - 1))], scale);
    const { data } = at.getImageData(0, 0, at.canvas.width, at.canvas.height);
    for (const pixel of new Uint32Array(data.buffer)) {
      const b = bin(pixel);
      if (!count[b]++) colour[b] = pixel & 0xffffff;
    }
  }
  const frequent = [...count.keys()].filter((b) => count[b]).sort((a, b) => count[b] - count[a]);
  const taken = new Map(named.map((c) => [bin(c), c]));
  for (const b of frequent) if (taken.size < SAME && !taken.has(b)) taken.set(b, colour[b]);
  const colours = [...taken.values()].slice(0, SAME);
  const nearest = Uint8Array.from(count, (_, b) => {
    let [best, least] = [0, Infinity];
    colours.forEach((c, i) => {
      const off = [0, 8, 16].reduce((sum, s) => sum + (((c >> s) & 255) - (((b >> (s * 0.625)) & 31) << 3) - 4) ** 2, 0);
      if (off < least) [best, least] = [i, off];
    });
    return best;
  });
  [...taken.keys()].slice(0, SAME).forEach((b, i) => (nearest[b] = i));
  return { colours, nearest };
}

/** A picture's codes, packed by the method of Lempel, Ziv and Welch and cut into blocks of 255 bytes. */
function packed(codes) {
  const out = [8];
  let [block, bits, held, width, next] = [[], 0, 0, 9, 258];
  const table = new Uint16Array(4096 * 256);
  const byte = (value) => {
    block.push(value);
    if (block.length === 255) out.push(255, ...block.splice(0));
  };
  const put = (code) => {
    held |= code << bits;
    for (bits += width; bits >= 8; bits -= 8, held >>>= 8) byte(held & 255);
  };
  put(256);
  let before = codes[0];
  for (let i = 1; i < codes.length; i++) {
    const key = before * 256 + codes[i];
    if (table[key]) {
      before = table[key];
      continue;
    }
    put(before);
    if (next < 4096) {
      if (next >> width) width++;
      table[key] = next++;
    } else {
      put(256);
      table.fill(0);
      [width, next] = [9, 258];
    }
    before = codes[i];
  }
  put(before);
  put(257);
  if (bits) byte(held & 255);
  if (block.length) out.push(block.length, ...block);
  out.push(0);
  return Uint8Array.from(out);
}

const word = (value) => [value & 255, value >> 8];

/** Sheets as a GIF that plays in a loop, each shown so many hundredths of a second; its comment has the notes. `tell` hears how many are done. */
export async function gif(sheets, scale, hundredths, tell) {
  const sizes = sheets.map((svg) => /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(svg).slice(1).map((size) => Math.ceil(size * scale)));
  const [width, height] = [0, 1].map((axis) => Math.max(...sizes.map((size) => size[axis])));
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const { colours, nearest } = await fewColours(sheets, scale);
  const table = new Uint8Array(768);
  colours.forEach((c, i) => table.set([c, c >> 8, c >> 16].map((v) => v & 255), 3 * i));
  const comment = latin(notesOf(sheets.at(-1)).map((note) => note.join(": ")).join("; ")).subarray(0, 255);
  const out = [latin("GIF89a"), Uint8Array.from([...word(width), ...word(height), 0xf7, 0, 0]), table];
  out.push(Uint8Array.from([0x21, 0xff, 11, ...latin("NETSCAPE2.0"), 3, 1, 0, 0, 0, 0x21, 0xfe, comment.length, ...comment, 0]));
  let last = null;
  for (const [i, svg] of sheets.entries()) {
    tell(i);
    const at = await paint(svg, scale, canvas);
    const pixels = new Uint32Array(at.getImageData(0, 0, width, height).data.buffer);
    const [codes, shown] = [new Uint8Array(pixels.length), new Uint8Array(pixels.length)];
    for (let k = 0; k < pixels.length; k++) {
      codes[k] = nearest[bin(pixels[k])];
      shown[k] = last && codes[k] === last[k] ? SAME : codes[k];
    }
    out.push(Uint8Array.from([0x21, 0xf9, 4, 5, ...word(hundredths), SAME, 0, 0x2c, 0, 0, 0, 0, ...word(width), ...word(height), 0]));
    out.push(packed(shown));
    last = codes;
  }
  out.push(Uint8Array.of(0x3b));
  return new Blob(out, { type: "image/gif" });
}
