// Makes the book of its chapter: node build.mjs NATIVE PARTS MODULES. NATIVE is the lab's program, which answers for every number and draws
// every still; PARTS the folder for book.json and the stills; MODULES where markdown-it and Temml are installed.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { Facts, ROOT } from "./facts.mjs";
import { Figures } from "./figures.mjs";
import { renderer } from "./markdown.mjs";

/** The lines of a source file from the comment `// WORDS` to the end of its paragraph or block, not indented. */
export function region(path, words) {
  const lines = readFileSync(join(ROOT, path), "utf8").split("\n");
  const begin = lines.findIndex((line) => line.trim() === `// ${words}`);
  if (begin < 0) throw new Error(`${path} has no comment "// ${words}"`);
  const indent = lines[begin].match(/^ */)[0];
  const length = lines.slice(begin).findIndex((line) => line.trim() === "" || !line.startsWith(indent));
  return lines.slice(begin, length < 0 ? undefined : begin + length).map((line) => line.slice(indent.length)).join("\n");
}

/** The address that opens the lab as a figure has it, or with other fields. */
const address = (figures) => (id, query) => {
  const figure = figures.made.find((made) => made.id === id);
  if (!figure) throw new Error(`no figure above is called ${id}`);
  const fields = new URLSearchParams(figure.query);
  new URLSearchParams(query).forEach((value, field) => fields.set(field, value));
  return `index.html?${fields.toString().replaceAll("%2C", ",")}`;
};

/**
 * The book of a chapter's text: its title, its body as HTML, its sections and the names of its figures.
 * Without `parts` no still is drawn.
 */
export function book(chapter, { native, parts, modules }) {
  const facts = new Facts(native);
  const figures = new Figures(native, parts, facts);
  const render = renderer({ modules, facts, figure: (text, inline) => figures.make(text, inline), region, address: address(figures) });
  const { body, sections } = render(chapter);
  return { title: chapter.match(/^# (.+)$/m)[1], body, sections, figures: figures.made.map(({ id }) => id) };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [native, parts, modules, chapter = join(ROOT, "book/chapter.md")] = process.argv.slice(2);
  try {
    writeFileSync(join(parts, "book.json"), JSON.stringify(book(readFileSync(chapter, "utf8"), { native, parts, modules })));
  } catch (error) {
    console.error(`${chapter}: ${error.message}`);
    process.exit(1);
  }
}
