// The page around the lab: loads it, mirrors its controls as elements of the page, and speaks with it by messages.
//
// For who embeds it: `window.motionLab.send({ do: "seek", tick: 600 })` does what src/web/message.rs lists; the page gets events
// `motionlab` on `window` with what the lab tells in `detail`. An embedding page posts the same as
// `frame.contentWindow.postMessage({ motionLab: { do: "light", role: "robot" } }, origin)` and hears `{ motionLab: ... }`.
const $ = (id) => document.getElementById(id);
const root = document.documentElement;
const files = JSON.parse($("files").textContent);
const embedded = root.dataset.page === "embed";
const canvas = $("lab");
const RESTART = "motion-lab/restart";
const LOST = "motion-lab/lost";
const SETTINGS = "motion-lab/settings";
const MOST_BYTES = 256 * 1024 * 1024;
const MOST_QUERY = 8000;

let lab = null; // the lab's exports once it runs
let wasm = null; // the memory and functions under them
let state = null; // its last state
let parts = null; // the run's parts, with which the simulator alone can record it again
let failed = false;
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
  attempt(() => lab.lab_send(JSON.stringify(message)));
}

/** Calls the lab; says what it refuses. */
function attempt(act) {
  try {
    act();
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) stop(String(error));
    else {
      warn(error.message ?? String(error));
      tellAll({ kind: "error", text: error.message ?? String(error) });
    }
  }
}

/** Tells whoever listens on this page, and the page around it. */
function tellAll(message) {
  window.dispatchEvent(new CustomEvent("motionlab", { detail: message }));
  if (parent !== window && message.kind !== "tree") parent.postMessage({ motionLab: message }, "*");
}

/** Opens a run or a world in the lab. */
async function open(file) {
  if (file.size > MOST_BYTES) return warn(`${file.name}: ${file.size} bytes; the page opens at most ${MOST_BYTES}`);
  let bytes;
  try {
    bytes = new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    return warn(`${file.name}: not opened: ${error.message ?? error}`);
  }
  if (failed || !("lab" in root.dataset)) return warn(`${file.name}: not opened: the lab is not running`);
  if (root.dataset.lab === "running") return attempt(() => lab.lab_open(file.name, bytes));
  waiting.push([file.name, bytes]);
  say(`${file.name} is opened as soon as the lab is there`);
}

function save(name, bytes, type = "application/octet-stream") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes], { type }));
  link.download = name;
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

/** The log of the run as far as it has come. */
async function runLog() {
  if (!parts || !state?.frontier) throw new Error("nothing has been run yet; press Play first");
  return (await alone()).record_log(JSON.stringify({ ...parts, ticks: state.frontier }));
}

const base64 = (bytes) => {
  let text = "";
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
};

/** A page that holds the run and simulates it again in whatever browser opens it. */
async function savedPage() {
  const log = await runLog();
  const light = await alone();
  const found = JSON.parse(light.verify_log(log));
  const fetched = async (name) => {
    const response = await fetch(name);
    if (!response.ok) throw new Error(`${name}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
  };
  const template = new TextDecoder().decode(await fetched(files.saved));
  const wasm = new Uint8Array(await fetched(files.lightWasm));
  const figure = (dark) => base64(new TextEncoder().encode(light.figure_of_log(log, dark)));
  const values = { SEED: found.seed, TICKS: found.ticks, DIGEST: found.digest, FIGURE: figure(false), DARK: figure(true), WASM: base64(wasm), LOG: base64(log) };
  return template.replace(/%(SEED|TICKS|DIGEST|FIGURE|DARK|WASM|LOG)%/g, (_, name) => values[name]);
}

// ---- what the lab tells ----

const hear = {
  ready() {
    $("loading").hidden = true;
    if (!embedded) canvas.focus({ preventScroll: true });
    scrollTo(0, 0);
    performance.mark("first-frame");
    if (calm.matches) send({ do: "pause" }); // what moves by itself waits until it is asked to
    const kept = store(() => sessionStorage.getItem(RESTART));
    if (kept) {
      const { at, ...run } = JSON.parse(kept);
      alone()
        .then((light) => {
          lab.lab_open("the run before", light.record_log(JSON.stringify(run)));
          store(() => sessionStorage.removeItem(RESTART));
          send({ do: "seek", tick: at });
        })
        .catch((error) => warn(`The run before could not be restored: ${error.message ?? error}`));
    }
  },
  state(message) {
    const before = state;
    state = message;
    root.dataset.theme = message.theme;
    if (message.notice?.text !== before?.notice?.text) {
      alarm(message.notice?.error ? message.notice.text : "");
      announce(message.notice?.error ? "" : (message.notice?.text ?? ""));
    }
    if (before && message.playing !== before.playing) announce(message.playing ? "Playing" : `Paused at tick ${message.tick}`);
    if (before && message.armed !== before.armed) announce(message.armed ? `${message.armed} is in your hand: arrow keys drive, Escape lets go` : "No robot is in your hand");
    for (const robot of message.robots) {
      const earlier = before?.robots.find((r) => r.name === robot.name);
      if (earlier && robot.contacts > earlier.contacts) announce(`${robot.name}: contact ${robot.contacts}`);
    }
    if (message.widget !== before?.widget) showKey(message.widget);
    light(message.lit);
  },
  tree: ({ widgets }) => mirror(widgets),
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
      await navigator.clipboard.writeText(text);
    } catch {
      warn("The browser does not let the page copy.");
    }
  },
  file: ({ name }, bytes) => save(name, bytes),
  ask({ accept }) {
    $("file").accept = accept;
    $("file").click();
  },
  failed: ({ text }) => stop(text),
};

function listen(json, bytes) {
  const message = JSON.parse(json);
  hear[message.kind]?.(message, bytes);
  tellAll(message);
}

/** Shows why the lab stopped. The run is kept: the simulator alone can record it again. */
function stop(reason) {
  if (failed) return;
  failed = true;
  $("overlay-text").textContent = reason;
  $("overlay-tools").hidden = !parts;
  $("loading").hidden = true;
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
  $("loading").hidden = true;
  $("unloaded-text").textContent = `The lab could not be loaded (${reason}). Below are its widgets as pictures.`;
  $("unloaded").hidden = false;
}

// ---- the controls of the canvas as elements of the page ----

const elements = new Map();
const OWN_KEYS = { text: "", button: "Enter Space Tab", check: "Enter Space Tab", handle: "Tab" };

function make(widget) {
  const element = document.createElement({ text: "p", button: "div", handle: "div" }[widget.kind] ?? "label");
  let control = element;
  if (widget.kind === "button" || widget.kind === "handle") {
    element.append((control = document.createElement("button")));
    control.type = "button";
  } else if (widget.kind !== "text") {
    control = document.createElement("input");
    control.type = { check: "checkbox", slider: "range", number: "number", field: "text" }[widget.kind];
    element.append(document.createElement("span"), control);
  }
  const own = { element, control, widget };
  if (control !== element) {
    control.addEventListener("focus", () => send({ do: "act", id: own.widget.id, action: "focus" }));
    const click = () => send({ do: "act", id: own.widget.id, action: "click" });
    if (widget.kind === "button" || widget.kind === "handle") control.addEventListener("click", click);
    else if (widget.kind === "check") control.addEventListener("change", click);
    else if (widget.kind === "field") {
      const commit = () => {
        if (control.value !== own.widget.value) send({ do: "act", id: own.widget.id, action: "type", value: control.value });
      };
      control.addEventListener("blur", commit);
      control.addEventListener("keydown", ({ key }) => key === "Enter" && commit());
    } else {
      control.addEventListener("input", () => {
        if (control.value !== "") send({ do: "act", id: own.widget.id, action: "set", value: control.value });
      });
    }
    // the lab's keys work here too, where the control does not need them itself
    const needed = OWN_KEYS[widget.kind];
    if (needed !== undefined) for (const type of ["keydown", "keyup"]) control.addEventListener(type, (event) => forward(event, needed));
  }
  return own;
}

function forward(event, needed) {
  const name = event.key === " " ? "Space" : event.key;
  if (event.ctrlKey || event.metaKey || event.altKey || needed.split(" ").includes(name) || event.isComposing) return;
  event.preventDefault();
  if (!event.repeat) send({ do: "key", key: event.key, pressed: event.type === "keydown", shift: event.shiftKey });
}

function update(own, widget) {
  const before = own.widget;
  own.widget = widget;
  const { control, element } = own;
  if (widget.place && String(widget.place) !== own.place) {
    own.place = String(widget.place);
    const [left, top, width, height] = widget.place;
    Object.assign(element.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
  }
  if (widget.kind === "text") {
    if (element.textContent !== widget.name) element.textContent = widget.name;
    return;
  }
  const both = widget.value !== undefined && (widget.kind === "button" || widget.kind === "handle");
  const label = both ? `${widget.name ?? ""}: ${widget.value}` : (widget.name ?? "");
  const words = widget.kind === "button" || widget.kind === "handle" ? control : element.firstChild;
  if (words.textContent !== label) words.textContent = label;
  control.disabled = widget.off_limits ?? false;
  if (widget.kind === "check") control.checked = widget.on;
  else if (widget.kind === "button" && widget.on !== undefined) control.setAttribute("aria-pressed", widget.on);
  if (widget.range && (before !== widget || !control.step)) {
    [control.min, control.max] = widget.range;
    control.step = widget.range[2] || "any";
  }
  if (widget.value !== undefined && control !== document.activeElement && "value" in control && control.type !== "checkbox") control.value = widget.value;
}

function mirror(widgets) {
  const seen = new Set();
  let last = null;
  for (const widget of widgets) {
    seen.add(widget.id);
    let own = elements.get(widget.id);
    if (own && own.widget.kind !== widget.kind) {
      own.element.remove();
      own = null;
    }
    if (!own) elements.set(widget.id, (own = make(widget)));
    update(own, widget);
    const place = last ? last.nextSibling : $("controls").firstChild;
    // moving an element would take its focus away
    if (own.element !== place && !own.element.contains(document.activeElement)) $("controls").insertBefore(own.element, place);
    last = own.element;
  }
  for (const [id, own] of elements) {
    if (!seen.has(id)) {
      if (own.element.contains(document.activeElement)) canvas.focus({ preventScroll: true });
      own.element.remove();
      elements.delete(id);
    }
  }
}

// ---- roles: lit in the page and in the canvas alike ----

function light(role) {
  if (role) root.dataset.lit = role;
  else delete root.dataset.lit;
  for (const element of document.querySelectorAll("#beside [data-role]")) element.toggleAttribute("data-lit", element.dataset.role === role);
}

function showKey(widget) {
  const entry = ({ role, text }) => {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.className = `role-${role}`;
    button.dataset.role = role;
    button.textContent = text;
    item.append(button);
    return item;
  };
  $("key").replaceChildren(...(files.widgets[widget]?.key ?? []).map(entry));
}

for (const [type, on] of [["pointerover", true], ["focusin", true], ["pointerout", false], ["focusout", false]]) {
  $("beside").addEventListener(type, ({ target }) => {
    const role = target.closest("[data-role]")?.dataset.role;
    if (role) send({ do: "light", role: on ? role : null });
  });
}

// ---- the page's own controls ----

// what an earlier one said is no more
document.querySelector("header").addEventListener("click", () => (say(""), warn("")), { capture: true });
$("copy-link").addEventListener("click", () => send({ do: "link" }));
$("save-run").addEventListener("click", () => send({ do: "save" }));
$("open-file").addEventListener("click", () => hear.ask({ accept: ".mcap,.ron" }));
$("save-page").addEventListener("click", async () => {
  try {
    save("run.html", await savedPage(), "text/html");
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
$("asked-save").addEventListener("click", () => {
  $("asked").hidden = true;
  send({ do: "save" });
});
$("asked-no").addEventListener("click", () => ($("asked").hidden = true));

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
canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("webglcontextlost", lost);
// a long link is behind the #: put into the address of this very page, it loads nothing by itself
window.addEventListener("hashchange", () => location.reload());
document.addEventListener("visibilitychange", () => send({ do: "visible", visible: !document.hidden }));

const dark = matchMedia("(prefers-color-scheme: dark)");
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const tellSystem = () => send({ do: "system", dark: dark.matches, reduced_motion: calm.matches });
dark.addEventListener("change", tellSystem);
calm.addEventListener("change", tellSystem);

window.addEventListener("message", ({ data, source }) => {
  if (source !== parent || !data?.motionLab?.do) return;
  // a file is saved for the reader, not for the page around: the reader is asked
  if (source !== window && data.motionLab.do === "save") $("asked").hidden = false;
  else send(data.motionLab);
});
window.motionLab = { send, open, savedPage, memory: () => wasm?.memory.buffer.byteLength, get state() { return state; } };

// ---- loading ----

/** The response with its bytes counted as they come. */
function counted(response) {
  const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
  $("total").textContent = megabytes(files.labBytes);
  let loaded = 0;
  const count = new TransformStream({
    transform(chunk, out) {
      loaded += chunk.byteLength;
      $("loaded").textContent = megabytes(loaded);
      $("progress").value = loaded / files.labBytes;
      out.enqueue(chunk);
    },
  });
  return new Response(response.body.pipeThrough(count), { headers: { "content-type": "application/wasm" } });
}

async function start() {
  // asked for first: a browser takes a while to say whether it has WebGL 2
  const unwanted = new AbortController();
  const pieces = Promise.all([import(new URL(files.lab, location.href)), fetch(files.labWasm, { signal: unwanted.signal })]);
  if (!document.createElement("canvas").getContext("webgl2")) {
    pieces.catch(() => {});
    unwanted.abort();
    return warn("This browser has no WebGL 2, which the lab draws with. Below are its widgets as pictures; a browser with hardware acceleration switched on shows the lab.");
  }
  root.dataset.lab = "loading";
  $("loading").hidden = false;
  try {
    const [module, response] = await pieces;
    if (!response.ok) throw new Error(`${files.labWasm}: ${response.status} ${response.statusText}`);
    wasm = await module.default({ module_or_path: counted(response) });
    lab = module;
  } catch (error) {
    return notLoaded(error.message ?? String(error));
  }
  try {
    lab.lab_start(location.search || location.hash, embedded, store(() => localStorage.getItem(SETTINGS)) ?? "", listen);
    root.dataset.lab = "running";
    tellSystem();
    for (const [name, bytes] of waiting.splice(0)) attempt(() => lab.lab_open(name, bytes));
  } catch (error) {
    stop(error.message ?? String(error));
  }
}

start();
