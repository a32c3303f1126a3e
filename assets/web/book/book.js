// The chapter's page: its figures are the lab, and its words, numbers and dots follow what the lab in them tells.
import { live, printed } from "./live.js";
import { MotionFigure } from "./motion-figure.js";
import { progress } from "./progress.js";
import { tasks } from "./tasks.js";

const figures = [...document.querySelectorAll("figure.lab")];
const told = document.getElementById("told");
const labOf = (figure) => figure.querySelector("motion-figure");

const shown = live({ figures, light: (role) => MotionFigure.front?.send({ do: "light", role }) });
const judges = new Map(
  figures.filter(({ dataset }) => dataset.task).map((figure) => [figure, tasks[figure.dataset.task](figure.dataset.given.split(",").filter(Boolean).map(Number))]),
);
const dots = progress({ headings: [...document.querySelectorAll("h2")], figures });

/** A figure's task is done: its sentence stands from now on. */
function done(figure) {
  const then = figure.querySelector(".then");
  if (then?.hidden) {
    then.hidden = false;
    told.textContent = then.textContent; // for who does not see it
  }
  dots.done(figure.id);
}

// ---- what the reader does ----

let moved = null; // the figure that a sentence has moved, until its answer is said

document.querySelector("main").addEventListener("click", (event) => {
  if (event.metaKey || event.ctrlKey || event.shiftKey) return; // a new tab is the reader's wish
  const link = event.target.closest("a[data-moves]");
  if (!link) return;
  event.preventDefault();
  const figure = labOf(document.getElementById(link.dataset.moves));
  moved = figure.closest("figure.lab");
  figure.move(link.dataset.query);
  figure.scrollIntoView({ block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
});

// ---- what the lab says ----

const hear = {
  loads: (figure) => (told.textContent = `${labOf(figure).label}: loading the lab`),
  enter: (figure) => (told.textContent = `${labOf(figure).label}: Escape leaves the figure`),
  leave: () => (told.textContent = ""),
  state(figure, state) {
    shown.state(figure, state);
    if (moved === figure) {
      moved = null;
      const { intersects, distance } = state.query ?? {};
      // the reader is in the sentence: what the figure says of it is said here
      if (state.query) told.textContent = intersects ? "It touches." : `It is ${printed(distance, { unit: "m away", decimals: 4, scale: 1 })}.`;
    }
    const judged = judges.get(figure)?.(state);
    if (!judged) return;
    figure.querySelector(".far").textContent = judged.text;
    if (judged.done) done(figure);
  },
  // within a figure its reader may go on to another one's lesson
  lesson(_, { id, done: isDone }) {
    const figure = figures.find(({ dataset }) => dataset.lesson === id);
    if (isDone && figure) done(figure);
  },
};
document.addEventListener("motionlab", ({ target, detail }) => hear[detail.kind]?.(target.closest("figure.lab"), detail));
