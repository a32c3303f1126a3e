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

/** What the comment at the head of an assignment's file says: its title, and its words. */
function headOf(id, text) {
  const [, title, words] = text.match(/^\/\/ (.+)\n((?:\/\/ .+\n)+)/) ?? [];
  if (!words) throw new Error(`${id}.ron: it begins with no title and words`);
  return { title, words: words.replace(/^\/\/ /gm, "").trim().replace(/\n/g, " ") };
}

/** All that is to be done: of the book and the lab as their builds tell it, and the assignments, whose files are in the folder. */
export function items(book, lab, folder) {
  const inBook = ofBook(book.body);
  const lessons = lab.widgets.flatMap(({ id: widget, lessons, hints }) => lessons.map((id, i) => ({ id, lesson: id, widget, title: hints[i] })));
  const known = new Map(inBook.map((item) => [item.id, { parts: ["book"], ...item }]));
  for (const lesson of lessons) {
    const { parts = [], title = lesson.title, ...rest } = known.get(lesson.id) ?? {};
    known.set(lesson.id, { ...rest, ...lesson, parts: [...parts, "lessons"], title, task: lesson.title });
  }
  const files = readdirSync(folder).map((name) => basename(name, ".ron"));
  const unknown = files.find((file) => !lab.assignments.some(({ id }) => id === file));
  if (unknown) throw new Error(`${unknown}.ron came after the site: run assets/web/build again`);
  for (const { id, world, script, ...goal } of lab.assignments) {
    if (known.has(id)) throw new Error(`an assignment and something else are called ${id}`);
    const { title, words } = headOf(id, readFileSync(join(folder, `${id}.ron`), "utf8"));
    const query = `widget=dashboard&world=${world}&script=${encodeURIComponent(script)}`;
    known.set(id, { id, title, parts: ["assignments"], query, goal: { words, ...goal } });
  }
  return [...known.values()];
}
