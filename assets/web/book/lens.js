// A lens that stands still: the pictures, answers and hands of the lab's Query and configuration space, by the simulator alone. It speaks
// with the page around as the lab does, as far as it has what is asked for: docs/web/messages.md.
import { around } from "./around.js";

const $ = (id) => document.getElementById(id);
const root = document.documentElement;
/** Number of cells judged at a time. */
const CELLS = 1500;
/** The greatest width of a paper, pixels. */
const WIDEST = 460;
/** How far from what it drags a finger may begin, pixels: elsewhere it scrolls. */
const FINGER = 30;

let lens = null; // the simulator's
let papers = []; // those that it has: { space, box, still, over, size }
let lit = null; // the role that is lit
let began = 0; // when the lesson began
let isDone = false; // whether it is done
let asked = null; // the frame in which what has changed is painted
let refining = null; // the timer of the cells

// ---- painting ----

/** Puts an SVG element that the simulator wrote into a layer. */
const paint = (layer, svg) => (layer.innerHTML = svg);

/** Makes the lens's papers. */
function makePapers() {
  papers = [false, true].flatMap((space) => {
    const aspect = lens.aspect(space);
    if (aspect === undefined) return [];
    const box = Object.assign(document.createElement("div"), { className: "lens-paper", tabIndex: 0 });
    box.setAttribute("role", "application");
    const [still, over] = [0, 1].map(() => box.appendChild(document.createElement("div")));
    still.setAttribute("aria-hidden", "true");
    over.setAttribute("aria-hidden", "true");
    const paper = { space, box, still, over, aspect, size: [0, 0] };
    hold(paper);
    return [paper];
  });
  $("papers").replaceChildren(...papers.map(({ box }) => box));
  $("lens").toggleAttribute("data-two", papers.length > 1);
}

/** Sizes the papers to the frame: beside one another where there is room. */
function measure() {
  const { width } = $("papers").getBoundingClientRect();
  const each = papers.length > 1 && width >= 480 ? (width - 12) / papers.length : width;
  for (const paper of papers) {
    const side = Math.max(1, Math.min(each - 2, WIDEST));
    const size = [Math.floor(side), Math.floor(side * paper.aspect)];
    Object.assign(paper.box.style, { width: `${size[0] + 2}px`, height: `${size[1] + 2}px` });
    if (String(size) === String(paper.size)) continue;
    paper.size = size;
    paint(paper.still, lens.still(paper.space, ...size));
  }
}

/** Shows what is so now, and tells the page around. */
function show() {
  asked = null;
  measure();
  const words = JSON.parse(lens.words());
  for (const { space, box, over, size } of papers) {
    paint(over, lens.moving(space, ...size));
    box.setAttribute("aria-label", `${space ? "Configuration space" : "Workspace"}. ${words.described} Arrow keys move the robot.`);
  }
  $("question").textContent = words.question;
  $("answer").textContent = words.answer;
  $("answer").toggleAttribute("data-touches", words.touches);
  // a shorter answer does not pull the sliders from under a finger
  $("answer").style.minHeight = `${$("answer").offsetHeight}px`;
  $("details").textContent = words.details.join("\n");
  for (const button of $("tabs").children) button.setAttribute("aria-pressed", String(button.textContent === words.tab));
  slide([...words.sliders.map((slider, i) => ({ ...slider, set: (value) => lens.set_coordinate(i, value) })), ...words.steps.map((slider, i) => ({ ...slider, set: (value) => lens.set_step(i, value) }))]);
  choose(words);
  tellHeight();
  tellState();
  if (lens.take_done() && !isDone) {
    isDone = true;
    tell({ kind: "lesson", id: lens.lesson(), done: true, seconds: (performance.now() - began) / 1000 });
  }
}

const change = () => (asked ??= requestAnimationFrame(show));

/** Judges more cells while nobody waits for anything. */
function refine() {
  clearTimeout(refining);
  refining = setTimeout(() => {
    const more = lens.refine(CELLS);
    for (const { space, still, size } of papers) if (space && size[0] > 0) paint(still, lens.still(space, ...size));
    change();
    if (more) refine();
  }, 0);
}

// ---- controls ----

/** A row for each slider. What it passes through is no task: a task is done when the hand lets go. */
function slide(sliders) {
  const rows = $("sliders").children;
  if (rows.length !== sliders.length) {
    $("sliders").replaceChildren(
      ...sliders.map(() => {
        const row = document.createElement("label");
        const input = Object.assign(document.createElement("input"), { type: "range", step: "any" });
        row.append(document.createElement("span"), input, document.createElement("output"));
        row.lastChild.setAttribute("aria-live", "off"); // the slider itself says its value
        return row;
      }),
    );
  }
  sliders.forEach(({ name, value, least, most, set }, i) => {
    const [label, input, output] = rows[i].children;
    label.textContent = name;
    input.setAttribute("aria-label", name);
    const step = (most - least) / 1000;
    Object.assign(input, { min: least, max: most, step });
    // a slider stands on a step: being shown does not move it
    if (Math.abs(input.value - value) > step) input.value = value;
    input.oninput = () => (set(Number(input.value)), change());
    input.onchange = () => (lens.let_go(), change(), sayAnswer());
    output.textContent = value.toFixed(4).replace("-", "\u2212");
  });
}

/** The check boxes that the lens has. */
function choose({ thick, annulus }) {
  const wanted = [
    thick && [`${(thick[0] * 100).toFixed(1).replace(/\.0$/, "")} cm capsule links`, thick[1], (on) => (lens.set_thick(on), refine())],
    annulus !== null && ["the tip's reach", annulus, (on) => lens.show_annulus(on)],
  ].filter(Boolean);
  const boxes = $("choices");
  if (boxes.children.length !== wanted.length) {
    boxes.replaceChildren(
      ...wanted.map(([name]) => {
        const row = document.createElement("label");
        row.append(Object.assign(document.createElement("input"), { type: "checkbox" }), name);
        return row;
      }),
    );
  }
  wanted.forEach(([, on, set], i) => {
    const input = boxes.children[i].firstElementChild;
    input.checked = on;
    input.onchange = () => (set(input.checked), change(), sayAnswer());
  });
}

let saying; // the timer of the answer that is said
/** Says the answer once what was moved stands. */
function sayAnswer() {
  clearTimeout(saying);
  saying = setTimeout(() => ($("told").textContent = $("answer").textContent), 400);
}

/** A hand on a paper: a mouse takes the robot to where it presses, a finger takes hold of it, arrow keys move it. */
function hold({ space, box }) {
  const sizeOf = () => papers.find((own) => own.box === box).size;
  const at = ({ clientX, clientY }) => {
    const { left, top } = box.getBoundingClientRect();
    return [clientX - left - 1, clientY - top - 1];
  };
  const drag = (event) => (lens.drag(space, ...sizeOf(), ...at(event)), change());
  const isNear = (event) => {
    const [[x, y], [handleX, handleY]] = [at(event), lens.handle(space, ...sizeOf())];
    return Math.hypot(x - handleX, y - handleY) <= FINGER;
  };
  let held = null; // the pointer that holds
  box.addEventListener("touchstart", (event) => event.touches.length === 1 && isNear(event.touches[0]) && event.preventDefault(), { passive: false });
  box.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !lens.takes(space, ...sizeOf(), ...at(event)) || (event.pointerType === "touch" && !isNear(event))) return;
    held = event.pointerId;
    box.setPointerCapture(held);
    if (event.pointerType !== "touch") drag(event);
  });
  box.addEventListener("pointermove", (event) => event.pointerId === held && drag(event));
  const letGo = ({ pointerId }) => {
    if (pointerId !== held) return;
    held = null;
    lens.let_go();
    change();
  };
  box.addEventListener("pointerup", letGo);
  box.addEventListener("pointercancel", letGo);
  box.addEventListener("keydown", (event) => {
    if (["Home", "End", "PageUp", "PageDown"].includes(event.key)) event.preventDefault(); // they would scroll the page around
    const by = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowDown: [1, -1], ArrowUp: [1, 1] }[event.key];
    if (!by || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    lens.nudge(by[0], by[1] * (event.shiftKey ? 0.005 : 0.05));
    change();
  });
  box.addEventListener("keyup", ({ key }) => {
    if (!key.startsWith("Arrow")) return;
    lens.let_go();
    change();
    sayAnswer();
  });
  // what is pointed at lights here and in the words around
  box.addEventListener("pointerover", ({ target, buttons }) => {
    if (buttons === 0) light(lens.roles().find((role) => target.closest?.("svg > g")?.classList.contains(role)) ?? null);
  });
  box.addEventListener("pointerleave", () => light(null));
}

function light(role) {
  if (role === lit || !lens) return;
  lit = role;
  if (role) root.dataset.lit = role;
  else delete root.dataset.lit;
  tellState();
}

// ---- what is asked and told ----

/** Tells whoever listens on this page, and the page around it. */
function tell(message) {
  window.dispatchEvent(new CustomEvent("motionlab", { detail: message }));
  tellAround(message);
}

let told = ""; // the last state
function tellState(again = false) {
  const state = { kind: "state", theme: isDark() ? "dark" : "light", lit, ...JSON.parse(lens.state()) };
  if (!again && JSON.stringify(state) === told) return;
  told = JSON.stringify(state);
  tell(state);
}

let height = 0; // of the lens at its width, which the page around makes room for
function tellHeight() {
  const now = Math.ceil($("lens").getBoundingClientRect().height) + 20;
  if (now === height) return;
  height = now;
  tell({ kind: "height", height });
}

const isDark = () => (root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches);

const doing = {
  open: ({ query }) => open(String(query)),
  state: () => tellState(true),
  light({ role }) {
    if (role !== null && !lens.roles().includes(role)) throw new Error(`light: ${String(role).slice(0, 20)} is no role`);
    light(role);
  },
  configuration({ coordinates }) {
    if (!Array.isArray(coordinates) || !coordinates.every(Number.isFinite)) throw new Error("configuration: coordinates are numbers");
    lens.put(Float64Array.from(coordinates));
    change();
  },
  tab({ id }) {
    lens.ask(String(id));
    change();
  },
  theme({ name }) {
    if (!["system", "light", "dark"].includes(name)) throw new Error("theme: it is system, light or dark");
    if (name === "system") delete root.dataset.theme;
    else root.dataset.theme = name;
    tellState();
  },
  figure: ({ request }) => tell({ kind: "figure", svg: lens.figure(isDark()), request }),
  link: ({ request }) => tell({ kind: "link", query: address(), digest: null, request }),
};
const ANSWERED = ["figure", "link"];

function ask(message) {
  const act = Object.hasOwn(doing, message.do) ? doing[message.do] : null;
  try {
    if (!lens && message.do !== "open") throw new Error("the figure is not there yet");
    if (!act) throw new Error(`${String(message.do).slice(0, 20)}: this figure stands still; the whole lab does that`);
    act(message);
    if (message.request !== undefined && !ANSWERED.includes(message.do)) tell({ kind: "done", request: message.request });
  } catch (error) {
    tell({ kind: "error", text: error.message ?? String(error), request: message.request });
  }
}

const refuse = (text, request) => tell({ kind: "error", text, request });
const tellAround = around({ ask, save: ({ request }) => refuse("save: this figure has no run", request), refuse });

/** The address of what is shown. */
const address = () => lens.link() + (root.dataset.theme ? `&theme=${root.dataset.theme}` : "");

/** Shows the lens of an address. */
function open(query) {
  const other = new wasm_bindgen.PageLens(query);
  const theme = new URLSearchParams(query).get("theme");
  if (["light", "dark"].includes(theme)) root.dataset.theme = theme;
  else delete root.dataset.theme;
  light(null);
  lens?.free();
  lens = other;
  [began, isDone, height] = [performance.now(), false, 0];
  $("lens").hidden = false;
  Object.assign($("whole"), { disabled: false, textContent: "The whole lab" });
  makePapers();
  $("tabs").replaceChildren(
    ...JSON.parse(lens.words()).tabs.map((id) => {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: id });
      button.addEventListener("click", () => (ask({ do: "tab", id }), sayAnswer()));
      return button;
    }),
  );
  for (const id of ["sliders", "choices"]) $(id).replaceChildren();
  $("answer").style.minHeight = "";
  if (lens.lesson()) tell({ kind: "lesson", id: lens.lesson(), done: false });
  refine();
  change();
  takeKeys();
}

/** Who comes in from the page around, by Enter, has the first paper in hand. */
function takeKeys() {
  if (isShared && document.hasFocus() && document.activeElement === document.body) papers[0]?.box.focus({ preventScroll: true });
}

/** Whether the page around has figures that share this frame, and the lab's. */
const isShared = location.hash === "#shared";

$("whole").addEventListener("click", () => {
  if (!isShared) return (location.href = `${parent === window ? "index" : "embed"}.html?${address()}`);
  Object.assign($("whole"), { disabled: true, textContent: "Loading the lab" });
  tell({ kind: "whole" });
});

try {
  await wasm_bindgen({ module_or_path: JSON.parse($("files").textContent).lightWasm });
  if (!isShared) open((location.search || location.hash).replace(/^[?#]/, ""));
  addEventListener("focus", takeKeys);
  new ResizeObserver(() => lens && change()).observe($("papers"));
  window.motionLab = { send: ask };
  tell({ kind: "ready" });
} catch (error) {
  $("lens").hidden = true;
  $("alert").textContent = `This figure could not be shown: ${error.message ?? error}`;
  tell({ kind: "failed", text: error.message ?? String(error) });
}
