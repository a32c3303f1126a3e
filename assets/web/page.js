// The page around the lab: loads it, mirrors its controls as elements of the page, and speaks with it by messages.
//
// `window.motionLab.send({ do: "seek", tick: 600 })` does what src/web/message.rs lists; the page gets events `motionlab` on `window` with
// what the lab tells in `detail`. docs/web/messages.md has what a page around a frame may ask.
import { around } from "./around.js";
import { beside } from "./beside.js";
import { captures } from "./captures.js";
import { fingers } from "./fingers.js";
import { savedPage, logOfSavedPage } from "./pages.js";
import { stick } from "./stick.js";
import { twins } from "./twins.js";

const $ = (id) => document.getElementById(id);
const root = document.documentElement;
const files = JSON.parse($("files").textContent);
const embedded = root.dataset.page === "embed";
const canvas = $("lab");
// the frames of one page share its storage
const here = location.pathname + location.search + location.hash;
const RESTART = `motion-lab/restart ${here}`;
const LOST = `motion-lab/lost ${here}`;
const SETTINGS = "motion-lab/settings";
const MOST_BYTES = 256 * 1024 * 1024;
const MOST_QUERY = 8000;
const BEFORE = "the run before";
const LOADS = `Loading the lab, ${document.getElementById("total").textContent} MB`;

let lab = null; // the lab's exports once it runs
let wasm = null; // the memory and functions under them
let state = null; // its last state
let parts = null; // the run's parts, with which the simulator alone can record it again
let failed = false;
let copies = false; // whether the reader asked for the link that the lab tells next
let noticed = -Infinity; // when the lab last told a notice
let toSeek = null; // the tick of the run before, while it is checked
const waiting = []; // files that were opened before the lab ran

/** Does something with the browser's storage; a page that may not use it does without. */
function store(act) {
  try {
    return act();
  } catch {
    return null;
  }
}

const say = (text) => ($("said").textContent = text);
const announce = (text) => ($("heard").textContent = text); // for who does not see it: the lab shows it too
const alarm = (text) => ($("urgent").textContent = text); // likewise
const warn = (text) => ($("alert").textContent = text);

/** Tells the lab something; see src/web/message.rs. */
function send(message) {
  if (!lab || failed) return;
  attempt(() => lab.lab_send(JSON.stringify(message)), message);
}

/** Calls the lab; says what it refuses. What it refuses to the page around has no words for the reader. */
function attempt(act, { around, request } = {}) {
  try {
    act();
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) stop(String(error));
    else {
      const text = error.message ?? String(error);
      if (!around) warn(text);
      tellAll({ kind: "error", text, request });
    }
  }
}

let toSave = {}; // the page's request to save the run
const tellAround = around({
  ask: send,
  isHeld: () => Boolean(state?.armed || state?.covered),
  save(wanted) {
    toSave = wanted;
    if (wanted.isOwn) return saveForPage(true);
    $("asked").hidden = false;
    alarm("The page around asks to save this run: Save run, or No");
  },
  refuse: (text, request) => tellAll({ kind: "error", text, request }),
});

/** Tells whoever listens on this page, and the page around it. */
function tellAll(message) {
  window.dispatchEvent(new CustomEvent("motionlab", { detail: message }));
  tellAround(message);
}

let nudged = null; // where arrow keys have sent Query's robot, until the lab tells it or a second has passed

/** Moves Query's robot, which is the configuration space's point, by an arrow key: its first two coordinates, with Shift a tenth as far. */
function nudge({ key, shiftKey, ctrlKey, metaKey, altKey }) {
  const by = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowDown: [1, -1], ArrowUp: [1, 1] }[key];
  if (!by || !state?.query || ctrlKey || metaKey || altKey) return false;
  const [kind] = state.query.configuration.split(" ");
  // the lab tells its state ten times a second: a key may come sooner
  const from = nudged?.kind === kind && performance.now() < nudged.until ? nudged : state.query;
  const coordinates = [...from.coordinates];
  coordinates[by[0]] += by[1] * (shiftKey ? 0.005 : 0.05);
  nudged = { kind, coordinates, until: performance.now() + 1000 };
  send({ do: "configuration", coordinates });
  return true;
}

let answers; // the timer of what is said of Query's robot once it stands
/** Says what is true of Query's robot where a key has put it. */
function tellAnswer() {
  clearTimeout(answers);
  answers = setTimeout(() => {
    const { query } = state;
    if (query) announce(query.intersects ? "It touches" : query.distance === null ? "It is free: nothing is there" : `It is free, ${query.distance.toFixed(4)} m away`);
  }, 400);
}

const { mirror, at, widgets, twin } = twins({
  container: $("controls"),
  send,
  titles: () => Object.values(files.widgets).map((widget) => widget.title),
  // the notice and the way that is blocked in #heard or #urgent, and the formulas, which a frame does not show
  said: () => [state?.notice?.text ?? "", state?.blocked ?? "", ...(embedded ? [] : [...document.querySelectorAll("#formulas li:not([hidden])")].map((item) => item.title))],
  leave: () => canvas.focus({ preventScroll: true }),
  nudge,
  alarm,
});
const look = fingers({ canvas, container: $("controls"), at, widgets, twin, embedded, announce });

/** Opens a run, also one saved as a page, or a world in the lab. */
async function open(file) {
  if (file.size > MOST_BYTES) return warn(`${file.name}: ${file.size} bytes; the page opens at most ${MOST_BYTES}`);
  let bytes;
  try {
    bytes = /\.html?$/i.test(file.name) ? await logOfSavedPage(await file.text()) : new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    return warn(`${file.name}: not opened: ${error.message ?? error}`);
  }
  if (failed || !("lab" in root.dataset)) return warn(`${file.name}: not opened: the lab is not running`);
  if (root.dataset.lab === "running") return attempt(() => lab.lab_open(file.name, bytes));
  waiting.push([file.name, bytes]);
  say(`${file.name} is opened as soon as the lab is there`);
}

/** Saves the run for the page around, or not, and tells it. */
function saveForPage(saved) {
  $("asked").hidden = true;
  runName = typeof toSave.name === "string" && /^[\w-]{1,40}$/.test(toSave.name) ? toSave.name : "run";
  if (saved) send({ do: "save" });
  tellAll({ kind: "saved", saved, request: toSave.request });
}

let runName = "run"; // what the next saved run is called

function save(name, bytes, type = "application/octet-stream") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes], { type }));
  link.download = name === "run.mcap" ? `${runName}.mcap` : name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// ---- the simulator alone: it outlives the lab ----

let simulator = null;
function alone() {
  simulator ??= new Promise((done, fail) => {
    const script = document.createElement("script");
    script.src = files.light;
    script.onload = () => wasm_bindgen({ module_or_path: files.lightWasm }).then(() => done(wasm_bindgen), fail);
    script.onerror = () => fail(new Error("the simulator could not be loaded; try again"));
    document.head.append(script);
  });
  simulator.catch(() => (simulator = null)); // the next one who asks tries again
  return simulator;
}

/** The parts of the run as far as it has come, as JSON. */
function runParts() {
  if (!parts || !state?.frontier) throw new Error("nothing has been run yet; press Play first");
  return JSON.stringify({ ...parts, ticks: state.frontier });
}

/** The log of the run as far as it has come. */
const runLog = async () => (await alone()).record_log(runParts());

/** A page that holds the run as far as it has come. */
async function runPage() {
  const run = runParts();
  return savedPage(await alone(), run, files);
}

// ---- what the lab tells ----

const shown = beside({ element: $("beside"), key: $("key"), widgets: files.widgets, send });
const drawn = captures({ say, warn, save, tell: tellAll });

/** What came of a plan, for who does not see it; nothing while it grows. */
function outcome({ stage, why, clearance }) {
  if (stage === "solved") return `A path is found, and proven${clearance === null ? "" : `: ${clearance.toFixed(4)} m clear`}`;
  return why ? `No path: ${why}` : "";
}

const hear = {
  ready() {
    if (!embedded) canvas.focus({ preventScroll: true });
    scrollTo(0, 0);
    performance.mark("first-frame");
    if (calm.matches) send({ do: "pause" }); // what moves by itself waits until it is asked to
    // where the host wants it; after the first picture, so that it takes nothing from the load
    if ("offline" in root.dataset) store(() => navigator.serviceWorker?.register("offline.js").catch(() => {}));
    const kept = store(() => sessionStorage.getItem(RESTART));
    if (kept) {
      const { at, ...run } = JSON.parse(kept);
      alone()
        .then((light) => {
          lab.lab_open(BEFORE, light.record_log(JSON.stringify(run)));
          store(() => sessionStorage.removeItem(RESTART));
          toSeek = at; // once it is checked: going to a tick would end the check
        })
        .catch((error) => warn(`The run before could not be restored: ${error.message ?? error}`));
    }
  },
  state(message) {
    const before = state;
    state = message;
    if (!before) requestAnimationFrame(uncover);
    root.dataset.theme = message.theme;
    if (toSeek !== null && message.notice?.text.startsWith(`${BEFORE}:`)) {
      send({ do: "seek", tick: toSeek });
      toSeek = null;
    }
    if (message.notice?.text !== before?.notice?.text) {
      noticed = performance.now();
      if (message.notice) warn(""); // what the page said of something before
      alarm(message.notice?.error ? message.notice.text : "");
      announce(message.notice?.error ? "" : (message.notice?.text ?? ""));
    }
    if (before && message.playing !== before.playing) announce(message.playing ? "Playing" : `Paused at tick ${message.tick}`);
    if (message.blocked && message.blocked !== before?.blocked) announce(message.blocked);
    if (before && message.armed !== before.armed) announce(message.armed ? `${message.armed} is in your hand: arrow keys drive, Escape lets go` : "No robot is in your hand");
    for (const robot of message.robots) {
      const earlier = before?.robots.find((r) => r.name === robot.name);
      // of a robot on tour nobody asked
      if (earlier && robot.contacts > earlier.contacts && (robot.driven || message.armed === robot.name)) announce(`${robot.name}: contact ${robot.contacts}`);
    }
    if (message.plan && before?.plan && message.plan.stage !== before.plan.stage) announce(outcome(message.plan));
    if (nudged && String(message.query?.coordinates) !== String(before?.query?.coordinates)) tellAnswer();
    if (String(message.query?.coordinates) === String(nudged?.coordinates)) nudged = null;
    if (message.widget !== before?.widget) shown.key(message.widget);
    if (String(message.formulas) !== String(before?.formulas)) shown.formulas(message.formulas);
    shown.light(message.lit);
  },
  tree(message) {
    mirror(message.widgets);
    look();
  },
  lesson({ done, seconds }) {
    if (done) announce(`The lesson is done, in ${Math.round(seconds)} s`);
  },
  settings({ settings }) {
    store(() => localStorage.setItem(SETTINGS, JSON.stringify(settings)));
  },
  run(message) {
    parts = message.parts;
  },
  async link({ query, digest, error }) {
    warn(error ?? "");
    if (error) return;
    // what is behind a # is not sent, so servers need not take a long one
    const address = `${location.origin}${location.pathname}${query.length > MOST_QUERY ? "#" : "?"}${query}`;
    // the reader's clipboard is the reader's: the page around is told the address
    if (!copies) return;
    copies = false;
    try {
      const late = new Promise((_, fail) => setTimeout(fail, 1000));
      await Promise.race([navigator.clipboard.writeText(address), late]);
      say(`Link copied${digest ? `; digest ${digest}` : ""}`);
    } catch {
      say(address);
    }
  },
  async copy({ text }) {
    try {
      const at = performance.now();
      await navigator.clipboard.writeText(text);
      // where the lab says so itself, in a notice, it is not said again
      setTimeout(() => noticed < at && say(`Copied: ${text.length} characters`), 500);
    } catch {
      send({ do: "not_copied" }); // in place of what the lab has said
    }
  },
  file: drawn.file,
  sheet: drawn.sheet,
  film: drawn.film,
  ask({ accept }) {
    $("file").accept = accept;
    $("file").click();
  },
  figure: ({ svg, png, request }) => (png ? drawn.asked(svg, png, request) : print(svg)),
  failed: ({ text }) => stop(text),
};

/** Shows the lab in place of its picture: its first frames find out what fits where. */
function uncover() {
  root.dataset.lab = "running";
  for (const [name, bytes] of waiting.splice(0)) attempt(() => lab.lab_open(name, bytes));
  if ($("heard").textContent === LOADS) announce("The lab is there");
}

function listen(json, bytes) {
  const message = JSON.parse(json);
  hear[message.kind]?.(message, bytes);
  // a sheet that is asked for in pixels is told when it is painted
  if (!message.png) tellAll(message);
}

/** Shows why the lab stopped. The run is kept: the simulator alone can record it again. */
function stop(reason) {
  if (failed) return;
  failed = true;
  $("overlay-text").textContent = reason;
  $("overlay-tools").hidden = !parts;
  $("overlay").hidden = false;
  $("overlay-restart").focus();
}

/** Starts again with the run as far as it has come, at the tick that is shown. */
function restart() {
  if (parts && state?.frontier) {
    const run = JSON.stringify({ ...parts, ticks: state.frontier, at: state.tick });
    const kept = store(() => (sessionStorage.setItem(RESTART, run), true));
    // who has been told so starts without it
    if (!kept && !$("overlay").dataset.told) {
      stop("The graphics were lost.");
      $("overlay").dataset.told = "yes";
      $("overlay-text").textContent += " The run is too large to be kept over a new start: save it first.";
      return;
    }
  }
  location.reload();
}

/** The browser took the graphics away: the lab starts again, paused at its tick. One that fails at once is not tried again. */
function lost() {
  if (failed) return;
  const before = Number(store(() => sessionStorage.getItem(LOST)) ?? 0);
  store(() => sessionStorage.setItem(LOST, Date.now()));
  if (Date.now() - before < 10000) return stop("The browser took the graphics context away (WebGL context lost).");
  restart();
}

/** Shows why the lab could not be loaded, above the pictures of its widgets, which stay. */
function notLoaded(reason) {
  failed = true;
  delete root.dataset.lab;
  $("unloaded-text").textContent = `The lab could not be loaded (${reason}). Below are its widgets as pictures.`;
  $("unloaded").hidden = false;
}

// ---- on paper: a figure of the widget in front instead of its canvas ----

let prints = false; // whether the figure to come is for the printer

async function print(svg) {
  if (!prints) return;
  prints = false;
  $("figure").src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await $("figure").decode().catch(() => {});
  window.print();
}

document.addEventListener("keydown", (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "p" || !state || failed) return;
  event.preventDefault();
  prints = true;
  send({ do: "figure" });
});
addEventListener("beforeprint", () => {
  const front = files.widgets[state?.widget];
  root.dataset.paper = $("figure").src ? "figure" : "still";
  for (const figure of document.querySelectorAll("#still figure")) figure.toggleAttribute("data-front", figure.id === state?.widget);
  $("caption").textContent = state && front ? `${front.title}: seed ${state.seed}, tick ${state.tick}. ${front.misconception}` : "";
});
addEventListener("afterprint", () => $("figure").removeAttribute("src"));

// ---- the page's own controls ----

// what an earlier one said is no more
document.querySelector("header").addEventListener("click", () => (say(""), warn("")), { capture: true });
$("copy-link").addEventListener("click", () => {
  copies = true;
  send({ do: "link" });
});
$("save-run").addEventListener("click", () => {
  runName = "run";
  send({ do: "save" });
});
$("open-file").addEventListener("click", () => hear.ask({ accept: ".mcap,.ron,.json,.html" }));
$("save-page").addEventListener("click", async () => {
  try {
    save("run.html", await runPage(), "text/html");
    say("The page is saved: it holds the run and simulates it again wherever it is opened");
  } catch (error) {
    warn(`Not saved: ${error.message ?? error}`);
  }
});
$("file").addEventListener("change", ({ target }) => {
  for (const file of target.files) open(file);
  target.value = "";
});
document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  event.preventDefault();
  for (const file of event.dataTransfer?.files ?? []) open(file);
});
$("overlay-save").addEventListener("click", async () => {
  try {
    save("run.mcap", await runLog());
  } catch (error) {
    $("overlay-text").textContent = `Not saved: ${error.message ?? error}`;
  }
});
$("overlay-restart").addEventListener("click", restart);
$("retry").addEventListener("click", () => location.reload());
for (const [id, saved] of [["asked-save", true], ["asked-no", false]]) {
  $(id).addEventListener("click", () => saveForPage(saved));
}

// keys that the lab uses do not scroll the page; Tab and the browser's own stay
canvas.addEventListener("keydown", (event) => {
  const shortcut = (event.ctrlKey || event.metaKey) && "asozy".includes(event.key.toLowerCase());
  const plain = !event.ctrlKey && !event.metaKey && !event.altKey && event.key !== "Tab" && !/^F\d/.test(event.key);
  if (shortcut || plain) event.preventDefault();
});
document.addEventListener("paste", (event) => {
  if (document.activeElement === canvas) send({ do: "paste", text: event.clipboardData.getData("text/plain") });
});
canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
// who comes into a frame by Enter has the lab in hand
if (embedded) addEventListener("focus", () => setTimeout(() => document.activeElement === document.body && canvas.focus({ preventScroll: true })));
canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("webglcontextlost", lost);
// a long link is behind the #: put into the address of this very page, it loads nothing by itself
window.addEventListener("hashchange", () => location.reload());
stick(send);
document.addEventListener("visibilitychange", () => send({ do: "visible", visible: !document.hidden }));

const dark = matchMedia("(prefers-color-scheme: dark)");
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const finger = matchMedia("(pointer: coarse)");
const tellSystem = () => send({ do: "system", dark: dark.matches, reduced_motion: calm.matches, touch: finger.matches });
dark.addEventListener("change", tellSystem);
calm.addEventListener("change", tellSystem);

window.motionLab = { send, open, savedPage: runPage, memory: () => wasm?.memory.buffer.byteLength, get state() { return state; } };

// ---- loading ----

/**
 * The response with the bytes that are sent counted as they come. A browser unpacks them first and does not say how many they were; their
 * share of all is nearly that of the unpacked ones.
 */
function counted(response) {
  const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
  const isPacked = response.headers.has("content-encoding");
  const total = isPacked ? Number(response.headers.get("content-length")) || files.labSent : files.labBytes;
  $("total").textContent = megabytes(total);
  let unpacked = 0;
  const count = new TransformStream({
    transform(chunk, out) {
      unpacked += chunk.byteLength;
      const share = unpacked / files.labBytes;
      $("loaded").textContent = megabytes(share * total);
      $("progress").value = share;
      out.enqueue(chunk);
    },
    flush: () => void ($("loading").firstElementChild.textContent = "The lab starts"),
  });
  return new Response(response.body.pipeThrough(count), { headers: { "content-type": "application/wasm" } });
}

/** What comes with a frame, or nothing: a hidden page has none. */
const inTime = (promise, milliseconds) => Promise.race([promise, new Promise((done) => setTimeout(done, milliseconds))]);

/** Comes once there is something to see. */
const painted = () =>
  new Promise((done) => {
    const observer = new PerformanceObserver((list) => list.getEntriesByName("first-contentful-paint").length && (observer.disconnect(), done()));
    observer.observe({ type: "paint", buffered: true });
  });

/**
 * Where a pixel ratio is emulated, by developer tools say, Chromium gives elements' sizes in the screen's own pixels, and the lab would draw
 * at a fraction of its size. Without that way to ask it multiplies by the ratio.
 */
async function measurePixels() {
  const measured = new Promise((done) => {
    const observer = new ResizeObserver(([entry]) => (observer.disconnect(), done(entry)));
    observer.observe($("stage"));
  });
  const entry = await inTime(measured, 300);
  const said = entry?.devicePixelContentBoxSize?.[0].inlineSize;
  if (said && Math.abs(said - entry.contentRect.width * devicePixelRatio) > 2) delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
}

/** What there is without WebGL 2: the pictures, in a frame that of its own widget; and a link's run, which the simulator alone plays. */
async function withoutGraphics() {
  delete root.dataset.lab;
  warn("This browser has no WebGL 2, which the lab draws with. Below are its widgets as pictures; a browser with hardware acceleration switched on shows the lab.");
  const query = location.search || location.hash;
  const fields = new URLSearchParams(query.replace(/^[?#]/, ""));
  if (embedded) for (const figure of document.querySelectorAll("#still figure")) figure.hidden = figure.id !== root.dataset.opens;
  if (!Number(fields.get("tick"))) return;
  try {
    const light = await alone();
    const log = light.record_link(query);
    const found = JSON.parse(light.verify_log(log));
    const theme = root.dataset.theme ?? (dark.matches ? "dark" : "light");
    $("run-figure").src = `data:image/svg+xml,${encodeURIComponent(new light.Replay(log).at(BigInt(found.ticks), theme === "dark"))}`;
    const expected = fields.get("digest")?.toLowerCase();
    const verdict = !expected ? "" : found.digest === expected ? ": the same run to the last bit" : `, but the link's is ${expected.slice(0, 32)}: another run`;
    $("run-text").textContent = `The link's run, simulated by this browser: seed ${found.seed}, tick ${found.ticks}, digest ${found.digest}${verdict}.`;
    root.dataset.verdict = !expected ? "run" : found.digest === expected ? "verified" : "differs";
    $("linked-run").hidden = false;
  } catch (error) {
    warn(`The link's run could not be simulated: ${error.message ?? error}`);
  }
}

async function start() {
  const unwanted = new AbortController();
  const pieces = Promise.all([import(new URL(files.lab, location.href)), fetch(files.labWasm, { signal: unwanted.signal })]);
  // a browser takes a while to say whether it has WebGL 2, and paints nothing meanwhile: the picture comes first
  await inTime(painted(), document.hidden ? 0 : 3000);
  const graphics = document.createElement("canvas").getContext("webgl2");
  graphics?.getExtension("WEBGL_lose_context")?.loseContext(); // the lab has its own
  if (!graphics) {
    pieces.catch(() => {});
    unwanted.abort();
    return withoutGraphics();
  }
  // who does not see the bar hears of a long load, and not in place of the lab's first words
  setTimeout(() => root.dataset.lab === "loading" && !state && !failed && announce(LOADS), 2000);
  try {
    const [[module, response]] = await Promise.all([pieces, measurePixels()]);
    if (!response.ok) throw new Error(`${files.labWasm}: ${response.status} ${response.statusText}`);
    wasm = await module.default({ module_or_path: counted(response) });
    lab = module;
  } catch (error) {
    return notLoaded(error.message ?? String(error));
  }
  try {
    lab.lab_start(location.search || location.hash, embedded, store(() => localStorage.getItem(SETTINGS)) ?? "", listen);
    tellSystem();
  } catch (error) {
    stop(error.message ?? String(error));
  }
}

start();
