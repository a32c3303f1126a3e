// The chapter's page. A figure shows its still until the reader asks for it; then one frame with the lab serves whichever of the figures
// that were asked for is nearest to the reading line, and the others keep their last picture.
import { live } from "./live.js";
import { progress } from "./progress.js";
import { tasks } from "./tasks.js";

const $ = (id) => document.getElementById(id);
const figures = [...document.querySelectorAll("figure.lab")];
const main = document.querySelector("main");
const told = $("told");

let frame = null; // the element with the lab, once a figure was asked for
let ready = false; // whether the lab in it draws
let front = null; // the figure that it serves
const left = new Map(); // the address of each figure as its reader left it

const ask = (message) => frame?.contentWindow.postMessage({ motionLab: message }, location.origin);
const shown = live({ figures, light: (role) => ask({ do: "light", role }) });
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

/** Lays the frame over its figure. */
function place() {
  if (!front) return;
  const [box, origin] = [front.querySelector(".frame"), main].map((element) => element.getBoundingClientRect());
  for (const [side, length] of Object.entries({ left: box.left - origin.left, top: box.top - origin.top, width: box.width, height: box.height })) frame.style.setProperty(side, `${length}px`);
}

/** The frame serves a figure from now on, as its reader left it. */
function serve(figure) {
  if (front === figure) return;
  if (front) leave();
  front = figure;
  figure.dataset.opened = figure.dataset.live = "";
  const query = left.get(figure) ?? figure.dataset.query;
  if (frame) ask({ do: "open", query });
  else begin(query);
  frame.title = figure.dataset.title;
  frame.toggleAttribute("data-waits", !ready);
  place();
}

/** Makes the frame. */
function begin(query) {
  frame = document.createElement("iframe");
  frame.id = "frame";
  frame.allow = "clipboard-write";
  frame.tabIndex = -1; // a figure's link is the one stop of Tab: Enter goes in
  frame.src = `embed.html?${query}`;
  main.append(frame);
  figures.forEach((figure) => (figure.querySelector(".try").textContent = "Loading the lab"));
}

/** Keeps the picture and the state of the figure in front, which the frame leaves. */
function leave() {
  delete front.dataset.live;
  ask({ do: "figure", request: `still ${front.id}` });
  ask({ do: "link", request: `link ${front.id}` });
}

/** Goes into a figure: it is served, and has the keys. */
function enter(figure) {
  serve(figure);
  if (ready) frame.contentWindow.focus();
  told.textContent = `${figure.dataset.title}: Escape leaves the figure`;
}

/** The opened figure that is nearest to the reading line, if it is well in view. */
function nearest() {
  const line = innerHeight * 0.45;
  const off = (figure) => {
    const { top, bottom } = figure.querySelector(".frame").getBoundingClientRect();
    return top > innerHeight - 120 || bottom < 120 ? Infinity : Math.abs((top + bottom) / 2 - line);
  };
  return figures.filter((figure) => "opened" in figure.dataset && off(figure) < Infinity).sort((a, b) => off(a) - off(b))[0];
}

// ---- what the reader does ----

main.addEventListener("click", (event) => {
  if (event.metaKey || event.ctrlKey || event.shiftKey) return; // a new tab is the reader's wish
  const link = event.target.closest("a.frame, a[data-moves]");
  if (!link) return;
  event.preventDefault();
  const figure = $(link.dataset.figure ?? link.dataset.moves);
  if (link.dataset.figure) return enter(figure);
  const fields = new URLSearchParams(figure.dataset.query);
  fields.delete("lesson");
  new URLSearchParams(link.dataset.query).forEach((value, field) => fields.set(field, value));
  left.set(figure, fields.toString());
  if (front === figure) ask({ do: "open", query: left.get(figure) });
  else serve(figure);
  figure.scrollIntoView({ block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
});

let settled; // the timer of a scroll that has come to rest
addEventListener("scroll", () => {
  clearTimeout(settled);
  // who is within the figure keeps it
  settled = setTimeout(() => document.activeElement !== frame && ready && serve(nearest() ?? front), 150);
}, { passive: true });
new ResizeObserver(place).observe(main);

// ---- what the lab says ----

const hear = {
  ready() {
    ready = true;
    frame.removeAttribute("data-waits");
    figures.forEach((figure) => (figure.querySelector(".try").textContent = "Try it"));
    frame.contentWindow.addEventListener("keydown", leaves);
    if (document.activeElement === front.querySelector(".frame")) frame.contentWindow.focus();
    // the reader may have gone on meanwhile
    if (left.has(front)) ask({ do: "open", query: left.get(front) });
  },
  state(state) {
    if (!front) return;
    shown.state(front, state);
    const judged = judges.get(front)?.(state);
    if (!judged) return;
    front.querySelector(".far").textContent = judged.text;
    if (judged.done) done(front);
  },
  lesson({ id, done: isDone }) {
    const figure = figures.find((figure) => figure.dataset.lesson === id);
    if (isDone && figure) done(figure);
  },
  figure({ request, svg }) {
    const figure = $(request.replace("still ", ""));
    const image = figure.querySelector("img");
    if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  },
  // what does not fit in an address begins anew
  link: ({ request, query }) => query && left.set($(request.replace("link ", "")), query),
  failed: () => front?.removeAttribute("data-live"),
};
addEventListener("message", ({ source, origin, data }) => {
  const said = data?.motionLab;
  if (source === frame?.contentWindow && origin === location.origin) hear[said?.kind]?.(said);
});

/** Escape leaves the figure, unless it closes something in it. */
function leaves(event) {
  const { contentDocument } = frame;
  if (event.key !== "Escape" || contentDocument.querySelector("[aria-expanded=true], [role=dialog], [role=menu]")) return;
  front.querySelector(".frame").focus();
  told.textContent = "";
}
