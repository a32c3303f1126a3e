// Makes the course pack of a site: node pack.mjs PARTS SITE OUT MODULES [book,lessons,assignments]. PARTS has what the
// builds of book and lab tell of themselves, SITE the site, MODULES where markdown-it is installed. The last word says
// which parts count for the score: all of them, where it is left out.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { folder } from "./folder.mjs";
import { PARTS, items } from "./items.mjs";
import { manifest } from "./manifest.mjs";
import { zip } from "./zip.mjs";
import { policy } from "../policy.mjs";

const [parts, site, out, modules, counting = Object.keys(PARTS).join(",")] = process.argv.slice(2);
const counts = counting.split(",");
for (const part of counts) if (!(part in PARTS)) throw new Error(`${part} is no part; they are ${Object.keys(PARTS).join(", ")}`);
const root = fileURLToPath(new URL("../../..", import.meta.url));
const source = (name) => readFileSync(new URL(name, import.meta.url), "utf8");
const part = (name) => JSON.parse(readFileSync(join(parts, name), "utf8"));
const escape = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;
const fill = (template, values) => template.replace(/\{\{(\w+)\}\}/g, (_, name) => values[name]);

const lab = part("lab.json");
const TITLE = "Robot motion: a course with the Motion Lab";
const DESCRIPTION = "A chapter with the lab as its figures, lessons in the lab, and assignments. What is done is told to the platform.";
const assignments = join(root, "book/assignments");
const all = items(part("book.json"), lab, assignments);

// a platform keeps 4,096 characters of what was done (SCORM 1.2, cmi.suspend_data)
const longest = all.map(({ id }) => id).join(" ").length;
if (longest > 4096) throw new Error(`${longest} characters of names: a platform keeps 4,096`);

/** The theme's colours and a style of the pack's own. */
const colours = (theme) => Object.entries(lab.colours[theme]).map(([role, colour]) => `--${role}:${colour};`).join("");
const style =
  `:root{color-scheme:light;${colours("light")}}\n` +
  `@media screen{@media (prefers-color-scheme:dark){:root{color-scheme:dark;${colours("dark")}}}}\n${source("start.css").replace(/\/\*.*?\*\/\n?/gs, "")}`;

// one script in the page itself: a browser loads no modules from a folder, and there too the page says what to do
const script = `(() => {\n${["scorm.js", "browser.js", "record.js", "judge.js", "start.js"]
  .map((name) => source(name).replace(/^import .*\n/gm, "").replace(/^export /gm, ""))
  .join("\n")}})();\n`;

const INTRODUCTIONS = {
  book: "A chapter to read. Its figures are the lab: each asks something, and knows when it is done. Answers are compared where they stand.",
  lessons: "The lab alone, with one task each: a minute or two. Those that are in the book too are done once.",
  assignments: "A run to hand in. The page says when it is there; save it then, and hand in the file as your course says. It is marked by running it again.",
};

/** The list of a part's items. */
function list(name) {
  const entry = ({ id, title, task, goal }) =>
    `<li data-item="${id}"><span class="dot"></span><span><span class="unseen"></span><a href="#${name}/${id}">${escape(name === "lessons" ? task : title)}</a>` +
    `${goal ? `<span class="words">${escape(goal.words)}</span>` : ""}</span></li>`;
  const own = all.filter((item) => item.parts.includes(name));
  const grouped =
    name === "lessons"
      ? lab.widgets.map(({ id, title, lessons }) => `<h3>${escape(title)}</h3>\n<ul>${lessons.map((lesson) => entry(own.find((item) => item.id === lesson))).join("\n")}</ul>`).join("\n")
      : `<ul>${own.map(entry).join("\n")}</ul>`;
  const first = name === "book" ? ` <a href="#book">Read the book from its beginning</a>.` : "";
  return `<section><h2>${PARTS[name]}<small id="share-${name}"></small></h2>\n<p>${INTRODUCTIONS[name]}${first}</p>\n${grouped}</section>`;
}

/** The teacher's page, of the page in docs but its last section: links to pages that are not in the pack are words. */
function teacher() {
  const require = createRequire(`${modules}/`);
  const markdown = require("markdown-it")({ html: false });
  // on a phone these scroll, by keys too
  markdown.renderer.rules.table_open = () => `<table tabindex="0">\n`;
  markdown.renderer.rules.fence = (tokens, i) => `<pre tabindex="0"><code>${escape(tokens[i].content)}</code></pre>\n`;
  const [page] = readFileSync(join(root, "docs/web/pack.md"), "utf8").split("\n## Make the pack\n");
  const whole = `All ${all.length} things count.`;
  if (!page.includes(whole)) throw new Error(`docs/web/pack.md does not say: ${whole}`);
  const isWhole = counts.length === Object.keys(PARTS).length;
  const counted = isWhole ? page : page.replace(whole, `In this pack ${counts.map((name) => `*${PARTS[name]}*`).join(" and ")} count.`);
  const text = counted.replace(/\[([^\]]*)\]\((?!https?:|#)[^)]*\)/g, "$1");
  return fill(source("teacher.html"), { style, policy: policy(hash(""), hash(style)), body: markdown.render(text), title: escape(text.match(/^# (.+)$/m)[1]), icon });
}

const pages = new Map(readdirSync(site).filter((name) => extname(name) !== ".br").map((name) => [name, readFileSync(join(site, name))]));
const files = new Map();
for (const [name, contents] of pages) files.set(`lab/${name}`, contents);
for (const [name, contents] of folder(pages, source("begin.js"))) files.set(`folder/${name}`, contents);
for (const name of readdirSync(assignments)) files.set(`assignments/${name}`, readFileSync(join(assignments, name)));
const icon = [...files.keys()].find((name) => /^lab\/icon\./.test(name));
const bookKept = /const KEPT = "([^"]+)"/.exec(readFileSync(new URL("../book/progress.js", import.meta.url), "utf8"))[1];
const course = JSON.stringify({ title: TITLE, parts: Object.keys(PARTS), counts, bookKept, items: all }).replace(/</g, "\\u003c");
files.set("index.html", fill(source("start.html"), { title: TITLE, style, script, course, icon, count: all.length, policy: policy(hash(script), hash(style)), lists: Object.keys(PARTS).map(list).join("\n") }));
files.set("teacher.html", teacher());
files.set("LICENSE.txt", readFileSync(join(root, "LICENSE")));
files.set("imsmanifest.xml", manifest({ title: TITLE, description: DESCRIPTION, start: "index.html", counts, files: [...files.keys()] }));

const bytes = zip(files);
writeFileSync(out, bytes);
console.log(`${out}: ${files.size} files, ${(bytes.length / 1e6).toFixed(1)} MB`);
