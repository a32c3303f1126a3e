// The book's figures: a lens of the lab, a still of it for before, and the words around.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { escape } from "./markdown.mjs";

const FIELDS = ["id", "title", "query", "lesson", "still", "alt", "question", "caption", "then"];

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

/** The figures of a book, in their order, whose stills `native` draws into the folder `parts`, where there is one. */
export class Figures {
  made = [];
  #native;
  #parts;

  constructor(native, parts) {
    this.#native = native;
    this.#parts = parts;
  }

  /** The figure of a block, as HTML. */
  make(text, inline) {
    const figure = fields(text);
    if (this.made.some(({ id }) => id === figure.id)) throw new Error(`two figures are called ${figure.id}`);
    this.made.push(figure);
    if (this.#parts) this.#draw(figure);
    const number = this.made.length;
    const query = figure.lesson ? `${figure.query}&lesson=${figure.lesson}` : figure.query;
    return [
      `<figure class="lab" id="${figure.id}" data-query="${escape(query)}" data-title="${escape(figure.title)}"${figure.lesson ? ` data-lesson="${figure.lesson}"` : ""}>`,
      `<a class="frame" href="index.html?${escape(query)}" data-figure="${figure.id}"><img src="{{still.${figure.id}}}" loading="lazy" alt="${escape(figure.alt)}"><span class="try">Try it</span></a>`,
      `<figcaption><strong>Figure ${number}.</strong> ${figure.question ? `<em>${inline(figure.question)}</em> ` : ""}${inline(figure.caption)}`,
      figure.then ? `<span class="then" hidden>${inline(figure.then)}</span>` : "",
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
