// What a reader has done: a dot for each section, the answers to its questions, kept for the next visit and told to a page around.
import { originAround } from "./around.js";
import { printed } from "./live.js";

const KEPT = "motion-lab/book";

/** The names of what was done before; none where the browser keeps nothing. */
function kept() {
  try {
    return new Set(JSON.parse(localStorage.getItem(KEPT)) ?? []);
  } catch {
    return new Set();
  }
}

/** Tells a page around, if there is one that the browser names. Pages of a folder are of no origin. */
function tellAround(message) {
  const origin = parent === window ? null : originAround();
  if (origin) parent.postMessage({ motionLab: message }, origin === "null" ? "*" : origin);
}

/** Makes the dots of the sections under `headings`, whose tasks are figures with lessons or tasks, and questions. */
export function progress({ headings, figures }) {
  const done = kept();
  const answers = [...document.querySelectorAll(".answer")];
  answers.forEach((answer, i) => (answer.dataset.task = `answer-${i + 1}`));
  const titles = [...document.querySelectorAll("h2, h3")];
  const titleOf = (answer) => titles.filter((title) => title.compareDocumentPosition(answer) & Node.DOCUMENT_POSITION_FOLLOWING).at(-1);
  for (const answer of answers) {
    const title = titleOf(answer);
    const same = answers.filter((other) => titleOf(other) === title);
    const number = same.length > 1 ? ` ${same.indexOf(answer) + 1}` : "";
    answer.querySelector("input").setAttribute("aria-label", `Your answer${number}: ${title.textContent}`);
  }
  const tasks = [...figures.filter(({ dataset }) => dataset.lesson || dataset.task).map((figure) => [figure.id, figure]), ...answers.map((answer) => [answer.dataset.task, answer])];
  const sections = headings.map((heading, i) => {
    const next = headings[i + 1];
    const within = (element) => heading.compareDocumentPosition(element) & Node.DOCUMENT_POSITION_FOLLOWING && !(next && next.compareDocumentPosition(element) & Node.DOCUMENT_POSITION_FOLLOWING);
    return { heading, dot: document.querySelector(`#dots a[href="#${heading.id}"]`).parentElement, own: tasks.filter(([, element]) => within(element)).map(([name]) => name) };
  });

  function show() {
    for (const { dot, heading, own } of sections) {
      const count = own.filter((name) => done.has(name)).length;
      dot.toggleAttribute("data-done", own.length > 0 && count === own.length);
      dot.toggleAttribute("data-part", count > 0 && count < own.length);
      dot.firstElementChild.title = own.length ? `${heading.textContent}: ${count} of ${own.length} done` : heading.textContent;
    }
    const known = tasks.map(([name]) => name);
    tellAround({ kind: "progress", done: known.filter((name) => done.has(name)), of: known });
  }

  const add = (name) => {
    if (done.has(name)) return;
    done.add(name);
    try {
      localStorage.setItem(KEPT, JSON.stringify([...done]));
    } catch {
      // it is kept for this visit
    }
    show();
  };
  for (const answer of answers) ask(answer, () => add(answer.dataset.task));
  document.querySelectorAll(".then").forEach((then) => (then.hidden = !done.has(then.closest("figure").id)));
  show();
  return { done: add };
}

/** Compares an answer with what is right: as many digits as the book shows. */
function ask(answer, done) {
  const input = answer.querySelector("input");
  const output = answer.querySelector("output");
  const { answer: wanted, decimals, unit } = input.dataset;
  input.addEventListener("change", () => {
    const { given, places } = read(input.value, unit);
    if (Number.isNaN(given)) return (output.textContent = `Give a number${unit ? `, in ${unit}` : ""}.`);
    const right = printed(Number(wanted), input.dataset);
    const near = Math.abs(given - parseFloat(right.replace("−", "-"))) <= 0.5 * 10 ** -Math.min(decimals, places);
    input.setAttribute("aria-invalid", String(!near));
    output.textContent = near ? `Right: ${right}.` : "Not yet.";
    tellAround({ kind: "answer", name: answer.dataset.task, given, wanted: parseFloat(right.replace("−", "-")), right: near });
    if (near) done();
  });
}

/** Units that stand for others, with how many decimal places they shift. */
const UNITS = { m: { cm: 2, mm: 3 }, "°": { deg: 0, degrees: 0 } };

/** The number that a text gives, in the unit that is asked for, and how many decimal places it has there; NaN where it is none. */
function read(text, unit) {
  const [, number, decimals = "", own] = text.trim().replace("−", "-").replace(",", ".").match(/^([+-]?(?:\d+\.?|\.(?=\d))(\d*))\s*(\S*)$/) ?? [];
  const shift = own === "" || own === unit ? 0 : UNITS[unit]?.[own];
  return number === undefined || shift === undefined ? { given: NaN, places: 0 } : { given: Number(`${number}e-${shift}`), places: decimals.length + shift };
}
