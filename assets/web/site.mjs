// Puts the site together: node site.mjs PARTS OUT [--budget] [--offline]. Every file but the pages and the worker that
// keeps them for a visit without a network carries a hash of its contents in its name.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";
import { policy } from "./policy.mjs";
import { runPage } from "./run_page.mjs";

/** The most that the whole site may weigh, compressed. */
const BUDGET = 4.2 * 1000 * 1000;

const [parts, out, ...options] = process.argv.slice(2);
const budget = options.includes("--budget");
const offline = options.includes("--offline");
const here = dirname(fileURLToPath(import.meta.url));
const lab = JSON.parse(readFileSync(join(parts, "lab.json"), "utf8"));
const escape = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const source = (name) => readFileSync(join(here, name), "utf8");
const fill = (template, values) =>
  template.replace(/\{\{([\w.-]+)\}\}/g, (_, name) => {
    if (!(name in values)) throw new Error(`nothing fills {{${name}}}`);
    return values[name];
  });

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const weights = [];

/** Writes a file and its compressed copy. */
function write(name, contents, part) {
  const bytes = Buffer.from(contents);
  const quality = budget ? 11 : 5;
  const compressed = brotliCompressSync(bytes, {
    params: { [constants.BROTLI_PARAM_QUALITY]: quality, [constants.BROTLI_PARAM_LGWIN]: 24, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length },
  });
  writeFileSync(join(out, name), bytes);
  writeFileSync(join(out, `${name}.br`), compressed);
  weights.push({ part, name, raw: bytes.length, compressed: compressed.length });
  return name;
}

/** Writes a file under a name that tells its contents. */
function hashed(name, contents, part) {
  const hash = createHash("sha256").update(contents).digest("hex").slice(0, 12);
  return write(`${name.slice(0, -extname(name).length)}.${hash}${extname(name)}`, contents, part);
}

const colours = (theme) => Object.entries(lab.colours[theme]).map(([role, colour]) => `--${role}:${colour};`).join("");
const roles = Object.keys(lab.colours.light).map((role) => `.role-${role},svg .${role}{--own:var(--${role})}.role-${role}{color:var(--${role})}`).join("\n");
/** Until its first frame the lab shows the picture of the widget that the address opens. */
const opened = lab.widgets.map(({ id }) => `html[data-lab=loading]:not([data-opens=${id}]) #${id}`).join();
// paper is light
const style =
  `:root{color-scheme:light;${colours("light")}}\n` +
  `@media screen{@media (prefers-color-scheme:dark){:root:not([data-theme=light]){color-scheme:dark;${colours("dark")}}}\n` +
  `:root[data-theme=dark]{color-scheme:dark;${colours("dark")}}}\n${roles}\n` +
  `${source("style.css").replace(/\/\*.*?\*\/\n?/gs, "")}\n${opened}{display:none}`;

/** The lines of a picture's style that say its colours. */
const coloured = /^\.[\w-]+\.f\{fill:.*$\n/gm;

/** A picture in both themes: it asks the reader's system itself. */
function inBoth(id) {
  const [light, dark] = ["light", "dark"].map((theme) => readFileSync(join(parts, `${id}-${theme}.svg`), "utf8"));
  const plain = (svg) => svg.replace(coloured, "").replace(/#[0-9a-f]{6}/g, "");
  if (plain(light) !== plain(dark)) throw new Error(`${id} in light and in dark are two pictures`);
  const media = `@media (prefers-color-scheme:dark){\n${dark.match(coloured).join("")}}\n</style>`;
  return light.replace("</style>", media);
}

/** A picture as a part of the page, in the page's colours: without a style and names of its own, to a tenth of a pixel. */
const within = (svg, words) =>
  svg
    .replace(/<(style|metadata|title|desc)\b.*?<\/\1>\n?/gs, "")
    .replace(/ (xmlns|id|aria-labelledby)="[^"]*"/g, "")
    .replace(/ d="[^"]*"/g, (line) => line.replace(/\d+\.\d+/g, (number) => String(Number(Number(number).toFixed(1)))))
    .replace("<svg", `<svg preserveAspectRatio="xMinYMin slice" aria-label="${escape(words)}"`);

// the first of all is painted with the page itself
const [front, ...others] = lab.widgets;
const pictures = Object.fromEntries(others.map((w) => [w.id, hashed(`${w.id}.svg`, inBoth(w.id), "pictures for readers without script")]));
const files = {
  lab: hashed("lab.js", readFileSync(join(parts, "lab.js")), "the lab"),
  labWasm: hashed("lab.wasm", readFileSync(join(parts, "lab_bg.wasm")), "the lab"),
  light: hashed("light.js", readFileSync(join(parts, "light.js")), "the simulator alone"),
  lightWasm: hashed("light.wasm", readFileSync(join(parts, "light_bg.wasm")), "the simulator alone"),
};
const weight = weights.find((w) => w.name === files.labWasm);
Object.assign(files, { labBytes: weight.raw, labSent: weight.compressed });

// the page that a run is saved in
files.saved = hashed("saved.html", runPage(parts).text, "the simulator alone");
files.widgets = Object.fromEntries(lab.widgets.map((w) => [w.id, { title: w.title, key: w.key, description: w.description, misconception: w.misconception, lessons: w.lessons }]));

const picture = (w) => (w === front ? within(inBoth(w.id), w.description) : `<img src="${pictures[w.id]}" loading="lazy" alt="${escape(w.description)}">`);
const opening = source("opening.js");
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
// the modules that a script imports have hashes in their names, too
const modules = {};
const linked = (name) => source(name).replace(/(from |import\()"\.\/([\w-]+\.js)"/g, (_, how, other) => `${how}"./${modules[other]}"`);
for (const name of ["pictures.js", "around.js", "beside.js", "pages.js", "twins.js", "fingers.js", "captures.js", "stick.js"]) modules[name] = hashed(name, linked(name), "the page");
const page = linked("page.js");
// painting is loaded when it is asked for
const { "pictures.js": _, ...first } = modules;
const preloads = [
  ...Object.values(first).map((name) => `<link rel="modulepreload" href="${name}">`),
  `<link rel="modulepreload" href="${files.lab}">`,
].join("\n");

/** The name of the robot that a formula's configuration is of. */
const robotOf = ({ robot, trailer }) => `${robot[0].toUpperCase()}${robot.slice(1).replace(/\d$/, ", $& joints")}${trailer ? ", trailer" : ""}:`;

const values = {
  preloads,
  offline: offline ? " data-offline" : "",
  policy: policy(hash(opening), hash(style)),
  style,
  opening,
  megabytes: (files.labSent / 1e6).toFixed(1),
  "page.js": hashed("page.js", page, "the page"),
  "icon.svg": hashed("icon.svg", source("icon.svg"), "the page"),
  files: JSON.stringify(files).replace(/</g, "\\u003c"),
  formulas: [
    ...lab.formulas.map((f) => `<li title="${escape(f.spoken)}" tabindex="0"><span>${escape(robotOf(f))}</span> ${f.mathml}</li>`),
    // a long one is scrolled on a phone, by keys too
    ...lab.chapter.map(
      (f) =>
        `<li data-at="${f.at.join(" ")}" title="${escape(f.spoken)}" tabindex="0" hidden>${f.mathml}` +
        `<details><summary>code</summary><code>${escape(f.code)}</code></details></li>`,
    ),
  ].join("\n"),
  widgets: lab.widgets
    .map(
      (w) =>
        // the words come before the picture that they stand over: what is painted first does not move
        `<figure id="${w.id}"><h3>${escape(w.title)}</h3>` +
        `<figcaption><p><strong>${escape(w.misconception)}</strong></p><p>${escape(w.description)}</p></figcaption>${picture(w)}</figure>`,
    )
    .join("\n"),
  frames: lab.widgets
    .map(
      (w) =>
        `<figure class="frame"><h2>${escape(w.title)}</h2><iframe src="embed.html?widget=${w.id}#${w.id}" allow="clipboard-write" title="${escape(w.title)}" loading="lazy"></iframe>` +
        `<figcaption>${escape(w.misconception)}</figcaption></figure>`,
    )
    .join("\n"),
};
// these have plain names: other people's pages link them
const named = Object.fromEntries(["motion-figure.js", "motion-figure.css"].map((name) => [name, source(join("book", name))]));
for (const [name, text] of Object.entries(named)) modules[name] = write(name, text, "the book");
for (const name of ["live.js", "progress.js", "tasks.js", "lens.js"]) modules[name] = hashed(name, linked(join("book", name)), "the book");
const book = JSON.parse(readFileSync(join(parts, "book.json"), "utf8"));
const stills = Object.fromEntries(book.figures.map((id) => [`still.${id}`, hashed(`book-${id}.svg`, inBoth(`book-${id}`), "the book")]));
const chapter = {
  title: escape(book.title),
  body: fill(book.body, stills),
  sections: book.sections.map(({ id, title }) => `<li><a href="#${id}"><span>${escape(title)}</span></a></li>`).join("\n"),
  "book.css": hashed("book.css", source("book/book.css"), "the book"),
  "book.js": hashed("book.js", linked("book/book.js"), "the book"),
  "lens.css": hashed("lens.css", source("book/lens.css"), "the book"),
  "lens.js": modules["lens.js"],
  "light.js": files.light,
  "light.wasm": files.lightWasm,
  "lens.files": JSON.stringify({ lightWasm: files.lightWasm }),
};
const pages = Object.fromEntries(Object.entries(named).map(([name, text]) => [name, hash(text)]));
for (const [name, template, page] of [
  ["index.html", "index.html", "lab"],
  ["embed.html", "index.html", "embed"],
  ["widgets.html", "widgets.html", "widgets"],
  ["book.html", "book/book.html", "book"],
  ["lens.html", "book/lens.html", "lens"],
]) {
  // a frame shows no formulas
  const text = fill(source(template), { ...values, ...chapter, page, ...(page === "embed" && { formulas: "" }) });
  pages[name] = hash(text);
  write(name, text, template.startsWith("book/") ? "the book" : "the page");
}
const kept = { pages, files: weights.map((w) => w.name).filter((name) => !(name in pages)) };
const version = createHash("sha256").update(JSON.stringify(kept)).digest("hex").slice(0, 12);
write("offline.js", fill(source("offline.js"), { site: JSON.stringify(offline ? { version, ...kept } : null) }), "the page");

const kb = (bytes) => (bytes / 1000).toFixed(0).padStart(7);
const total = { raw: 0, compressed: 0 };
console.log("  raw kB  brotli kB");
for (const part of new Set(weights.map((w) => w.part))) {
  const own = weights.filter((w) => w.part === part);
  const sum = (field) => own.reduce((s, w) => s + w[field], 0);
  console.log(`${kb(sum("raw"))}  ${kb(sum("compressed"))}  ${part} (${own.length} files)`);
  total.raw += sum("raw");
  total.compressed += sum("compressed");
}
console.log(`${kb(total.raw)}  ${kb(total.compressed)}  in all`);
if (budget && total.compressed > BUDGET) {
  console.error(`The site weighs ${total.compressed} bytes compressed, and at most ${BUDGET} are allowed.`);
  process.exit(1);
}
