// What there is to do in a course: the book's figures and questions, the lab's lessons, the assignments.
import { readFileSync, readdirSync } from "node:fs";
import { basename, join } from "node:path";

/** The parts of a course, in the order in which they stand. */
export const PARTS = { book: "The book", lessons: "Lessons", assignments: "Assignments" };

const plain = (html) => html.replace(/<[^>]*>/g, "").replace(/&#(\d+);/g, (_, code) => String.fromCharCode(code));

/** The figures and questions of the book's body, in its order. A figure's lesson is the lab's, wherever it is done. */
function ofBook(body) {
  const found = [];
  let heading = null;
  const pattern = /<h[23] id="([^"]*)">(.*?)<\/h[23]>|<figure class="lab"(.*?)>\n?<motion-figure[^>]* label="([^"]*)"|data-answer="([^"]*)"/gs;
  for (const [, id, title, figure, label, answer] of body.matchAll(pattern)) {
    if (id) heading = { id, title: plain(title), answers: 0 };
    else if (figure) {
      const { id: name, "data-lesson": lesson, "data-task": task } = Object.fromEntries([...figure.matchAll(/ ([\w-]+)="([^"]*)"/g)].map(([, key, value]) => [key, value]));
      if (lesson || task) found.push({ id: lesson ?? name, inBook: name, at: name, title: plain(label), ...(lesson && { lesson }) });
    } else if (answer) {
      const inBook = `answer-${found.filter(({ type }) => type === "numeric").length + 1}`;
      heading.answers += 1;
      found.push({ id: inBook, inBook, at: heading.id, title: `${/^\d/.test(heading.title) ? "Exercise " : ""}${heading.title}: answer ${heading.answers}`, type: "numeric" });
    }
  }
  return found;
}

/** An assignment for `motion-lab grade`, as far as a page looks at it. The comment at its head is its title and words. */
function assignment(id, text) {
  const [, title, words] = text.match(/^\/\/ (.+)\n((?:\/\/ .+\n)+)/) ?? [];
  const one = (pattern) => text.match(pattern)?.[1];
  const numbers = (name) =>
    one(new RegExp(`${name}: \\[([^\\]]*)\\]`))?.split(",").map((part) => (part.includes("deg") ? (parseFloat(part.trim().slice(1)) * Math.PI) / 180 : Number(part)));
  const found = {
    id,
    title,
    words: words?.replace(/^\/\/ /gm, "").trim().replace(/\n/g, " "),
    world: one(/world: "(\w+)"/),
    robot: one(/robot: "(\w+)"/),
    at: numbers("at"),
    within: numbers("within"),
    hold: Number(one(/hold: (\d+)/) ?? 1),
    ticks: Number(one(/ticks: (\d+)/)),
    contacts: Number(one(/limits: .*contacts: (\d+)/) ?? Infinity),
  };
  for (const [field, value] of Object.entries(found)) if (value == null || Number.isNaN(value)) throw new Error(`${id}.ron: its ${field} can't be read`);
  return found;
}

/**
 * The address of the lab in which an assignment begins. Its robot stands from the first tick on, as it does when it is
 * graded: nobody drives it, and it tours in no assignment.
 */
function address({ world, robot, at }, worlds) {
  const text = readFileSync(join(worlds, `${world}.ron`), "utf8");
  const start = text.match(new RegExp(`name: "${robot}",.*start: \\[([^\\]]*)\\]`))[1].split(",").map(Number);
  // an arm's coordinates are in units of 2^-20 rad
  const stands = at.length === 2 ? `MoveTo([${start.map((angle) => Math.round(angle * 2 ** 20))}])` : "Drive(0,0)";
  return `widget=dashboard&world=${world}&script=${encodeURIComponent(`Script(version:1,events:[(tick:1,robot:"${robot}",input:${stands})])`)}`;
}

/**
 * All that is to be done: of the book and the lab as their builds tell it, and the assignments in the folder
 * `assignments`, whose worlds are in the folder `worlds`.
 */
export function items(book, lab, { assignments: folder, worlds }) {
  const inBook = ofBook(book.body);
  const lessons = lab.widgets.flatMap(({ id: widget, lessons, hints }) => lessons.map((id, i) => ({ id, lesson: id, widget, title: hints[i] })));
  const known = new Map(inBook.map((item) => [item.id, { parts: ["book"], ...item }]));
  for (const lesson of lessons) {
    const { parts = [], title = lesson.title, ...rest } = known.get(lesson.id) ?? {};
    known.set(lesson.id, { ...rest, ...lesson, parts: [...parts, "lessons"], title, task: lesson.title });
  }
  const files = readdirSync(folder).filter((name) => name.endsWith(".ron")).sort();
  const assignments = files.map((name) => assignment(basename(name, ".ron"), readFileSync(join(folder, name), "utf8")));
  for (const { id, title, ...goal } of assignments) {
    if (known.has(id)) throw new Error(`an assignment and something else are called ${id}`);
    known.set(id, { id, title, parts: ["assignments"], query: address(goal, worlds), goal });
  }
  return [...known.values()];
}
