// The book's figures: a lens of the lab, a still of it for before, and the words around.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { ROOT } from "./facts.mjs";
import { escape } from "./markdown.mjs";
import { tasks } from "./tasks.js";

const FIELDS = ["id", "title", "query", "lesson", "task", "still", "alt", "question", "caption", "then"];

/** The fields of a figure's block: lines of `field: text`, each once. */
function fields(text) {
  const found = {};
  for (const line of text.split("\n").filter((line) => line.trim())) {
    const [, field, value] = line.match(/^([a-z]+): (.+)$/) ?? [];
    if (!FIELDS.includes(field)) throw new Error(`${JSON.stringify(line)} is no line of a figure; they are ${FIELDS.join(", ")}`);
    if (field in found) throw new Error(`a figure says ${field} twice`);
    found[field] = value;
  }
  for (const field of ["id", "title", "query", "still", "alt", "caption"]) if (!(field in found)) throw new Error(`a figure has no ${field}`);
  return found;
}

/** A world or a script as an address holds it: `{book/wall.ron}` in a figure's query stands for that file. */
function packed(path) {
  const text = readFileSync(join(ROOT, path), "utf8").replace(/("[^"]*")|\/\/.*|\s+/g, (_, quoted = "") => quoted);
  return encodeURIComponent(text);
}

/** The figures of a book, in their order, whose stills `native` draws into the folder `parts`, where there is one. */
export class Figures {
  made = [];
  #native;
  #parts;
  #facts;

  constructor(native, parts, facts) {
    this.#native = native;
    this.#parts = parts;
    this.#facts = facts;
  }

  /** The attributes of a figure's task: its name, and the numbers of the facts that stand behind it. */
  #task(text) {
    const [name, ...facts] = text.split(/[\s,]+/);
    if (!Object.hasOwn(tasks, name)) throw new Error(`${name} is no task; they are ${Object.keys(tasks).join(", ")}`);
    return ` data-task="${name}" data-given="${facts.flatMap((fact) => this.#facts.of(fact).values).join(",")}"`;
  }

  /** The figure of a block, as HTML. */
  make(text, inline) {
    const figure = fields(text);
    if (this.made.some(({ id }) => id === figure.id)) throw new Error(`two figures are called ${figure.id}`);
    figure.query = figure.query.replace(/\{([\w./-]+)\}/g, (_, path) => packed(path));
    this.made.push(figure);
    if (this.#parts) this.#draw(figure);
    const number = this.made.length;
    const query = figure.lesson ? `${figure.query}&lesson=${figure.lesson}` : figure.query;
    return [
      `<figure class="lab" id="${figure.id}"${figure.lesson ? ` data-lesson="${figure.lesson}"` : ""}${figure.task ? this.#task(figure.task) : ""}>`,
      `<motion-figure query="${escape(query)}" label="${escape(figure.title)}"><a href="index.html?${escape(query)}">`,
      `<img src="{{still.${figure.id}}}" loading="lazy" alt="${escape(figure.alt)}"><span class="try">Try it<span class="unseen">: Figure ${number}, ${escape(figure.title)}</span></span></a></motion-figure>`,
      `<figcaption><strong>Figure ${number}.</strong> ${figure.question ? `<em>${inline(figure.question)}</em> ` : ""}${inline(figure.caption)}`,
      figure.task ? `<span class="far"></span>` : "",
      figure.then ? `<span class="then" hidden><strong>Done.</strong> ${inline(figure.then)}</span>` : "",
      `</figcaption></figure>\n`,
    ].join("");
  }

  #draw({ id, still }) {
    for (const theme of ["light", "dark"]) {
      const out = join(this.#parts, `book-${id}-${theme}.svg`);
      execFileSync(this.#native, ["--quiet", "--force", ...still.split(/\s+/), "--theme", theme, still.startsWith("plan") ? "--svg" : "-o", out], { stdio: "ignore" });
    }
  }
}
