// <motion-figure query="widget=anatomy&tab=witness" label="Distance and witness">: a figure that is the lab once its
// reader asks for it. Within it stands a link with a picture, which is there without script too. One frame serves
// whichever of a page's figures that were asked for is nearest to the reading line; the others keep their last picture,
// and are found as they were left. Query and the configuration space stand still: a frame of their own, which has the
// simulator alone, serves them, and is there sooner. docs/web.md has an example.

/** Where the lab is: beside this file. */
const LAB = new URL(".", import.meta.url);
/** Its pages' origin; those of a folder have none, which browsers write so. */
const ORIGIN = LAB.protocol === "file:" ? "null" : LAB.origin;
/** The widgets that stand still. */
const STILL = ["anatomy", "cspace"];

const figures = new Set(); // those in the page
const kept = new WeakMap(); // the address of each figure as its reader left it
const marks = new Map(); // the figure that a request is about
let front = null; // the figure that is served
let count = 0;

/** A frame that serves one figure at a time; it is made when the first one asks for it. */
class Frame {
  element = null;
  ready = false; // whether what is in it draws
  untaken = null; // the mark of an address that it has not taken yet: its states are still another figure's
  #page;

  constructor(page) {
    this.#page = page;
  }

  /** Makes it; it stays in its place in the page: a frame that is moved loads anew. */
  begin(query) {
    this.element = document.createElement("iframe");
    this.element.className = "motion-figure";
    this.element.allow = "clipboard-write";
    this.element.tabIndex = -1; // a figure's link is the one stop of Tab: Enter goes in
    this.element.src = new URL(`${this.#page}?${query}`, LAB);
    // pictures that come late move what is below them, and a body of the screen's height does not grow with them
    for (const part of document.body.children) sizes.observe(part);
    document.body.append(this.element);
    this.say("Loading the lab");
  }

  /** Labels the links of its figures. */
  say(text) {
    for (const figure of figures) if (figure.frame === this) figure.say(text);
  }

  ask(message) {
    this.element?.contentWindow.postMessage({ motionLab: message }, ORIGIN === "null" ? "*" : ORIGIN);
  }

  /** Asks with a mark for what comes of it. */
  askFor(figure, message) {
    const request = `figure ${++count}`;
    marks.set(request, figure);
    this.ask({ ...message, request });
    return request;
  }

  /** Shows an address in the figure in front. */
  open(query) {
    if (!this.element) this.begin(query);
    else if (this.ready) this.untaken = this.askFor(front, { do: "open", query });
    else kept.set(front, query); // it is opened once the lab is there
  }

  /** Whether nobody sees it from now on, nor hears of it. */
  wait(waits) {
    this.element.toggleAttribute("data-waits", waits);
    this.element.inert = waits;
  }
}
const lab = new Frame("embed.html");
const lens = new Frame("lens.html");

/** Tells the page what comes of a figure. */
const tell = (figure, detail) => figure.dispatchEvent(new CustomEvent("motionlab", { bubbles: true, detail }));

/** Lays the frame over its figure, wherever the page has put either. */
function place() {
  if (!front) return;
  const { element } = front.frame;
  const [over, at] = [front, element].map((shown) => shown.getBoundingClientRect());
  const lengths = { left: (parseFloat(element.style.left) || 0) + over.left - at.left, top: (parseFloat(element.style.top) || 0) + over.top - at.top, width: over.width, height: over.height };
  for (const [side, length] of Object.entries(lengths)) element.style.setProperty(side, `${length}px`);
}

/** A frame serves a figure from now on, as its reader left it. */
function serve(figure) {
  if (front === figure) return;
  if (front) leave(figure.frame);
  front = figure;
  figure.toggleAttribute("opened", true);
  figure.toggleAttribute("live", true);
  const { frame } = figure;
  frame.open(kept.get(figure) ?? figure.query);
  frame.element.title = figure.label;
  frame.wait(!frame.ready);
  sizes.observe(figure);
  place();
}

/** Keeps the picture and the state of the figure in front, which its frame leaves; another one may come. */
function leave(next) {
  const { frame } = front;
  front.removeAttribute("live");
  sizes.unobserve(front);
  if (frame.ready && !frame.untaken) for (const what of ["figure", "link"]) frame.askFor(front, { do: what });
  if (frame === next) return;
  if (frame === lab) lab.ask({ do: "pause" }); // what nobody sees need not move
  frame.wait(true);
}

/** How far a figure is from the reading line: infinitely, unless it is well in view. */
function off(figure) {
  const { top, bottom } = figure.getBoundingClientRect();
  return top > innerHeight - 120 || bottom < 120 ? Infinity : Math.abs((top + bottom) / 2 - innerHeight * 0.45);
}

/** Serves the figure that was asked for and is nearest to the reading line; who is within one in view keeps it. */
function follow() {
  if (!front?.frame.ready || (document.activeElement === front.frame.element && off(front) < Infinity)) return;
  const seen = [...figures].filter((figure) => figure.hasAttribute("opened") && off(figure) < Infinity);
  const [nearest = front] = seen.sort((a, b) => off(a) - off(b));
  serve(nearest);
}

const sizes = new ResizeObserver(place);
sizes.observe(document.body);
let settled; // the timer of a scroll that has come to rest
addEventListener("scroll", ({ target }) => {
  if (target !== document) place(); // something within the page scrolls
  clearTimeout(settled);
  settled = setTimeout(follow, 150);
}, { passive: true, capture: true });

// ---- what the lab says ----

const hear = {
  ready(frame) {
    frame.ready = true;
    frame.say("Try it");
    // the reader may have gone on meanwhile
    if (front.frame !== frame) return;
    frame.wait(false);
    if (front.contains(document.activeElement)) frame.element.contentWindow.focus();
    if (kept.has(front)) frame.open(kept.get(front));
  },
  figure(_, { request, svg }) {
    const image = marks.get(request)?.querySelector("img");
    if (!image) return;
    if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  },
  // what does not fit in an address begins anew
  link(_, { request, query }) {
    const figure = marks.get(request);
    if (!query || !figure) return;
    kept.set(figure, query);
    figure.goesOn?.();
  },
  leave: () => front.link.focus(),
  // its reader asks for all that the lab has
  whole(frame) {
    const figure = front;
    figure.goesOn = () => {
      delete figure.goesOn;
      figure.becomeWhole();
    };
    frame.askFor(figure, { do: "link" });
  },
  height: (frame, { height }) => front.frame === frame && Number.isFinite(height) && front.link.style.setProperty("height", `${height}px`),
  failed(frame) {
    if (frame === lens) front.becomeWhole();
    else front.removeAttribute("live");
  },
};
addEventListener("message", ({ source, origin, data }) => {
  const said = data?.motionLab;
  const frame = [lab, lens].find(({ element }) => element && source === element.contentWindow);
  if (!said || !frame || origin !== ORIGIN) return;
  hear[said.kind]?.(frame, said);
  const isOurs = marks.delete(said.request);
  if (isOurs && said.request === frame.untaken) frame.untaken = null;
  // what comes before the lab has taken the address is another figure's
  if (!isOurs && !frame.untaken && front.frame === frame) tell(front, said);
});

/**
 * A figure of the lab. It gets events `motionlab`, which bubble, with what the lab tells in `detail`, and one of kind
 * `enter` when its reader goes in.
 */
export class MotionFigure extends HTMLElement {
  get query() {
    return this.getAttribute("query") ?? "";
  }

  /** Whether its reader has asked for all that the lab has. */
  #whole = false;

  /** The frame that serves it. */
  get frame() {
    const fields = new URLSearchParams(this.query);
    const widget = fields.get("widget") ?? (fields.has("tab") ? "anatomy" : "dashboard");
    return STILL.includes(widget) && !this.#whole ? lens : lab;
  }

  get label() {
    return this.getAttribute("label") ?? "The lab";
  }

  /** The link in it, which a page without script follows. */
  get link() {
    return this.querySelector("a");
  }

  /** The label of the link. */
  say(text) {
    this.link.querySelector(".try").textContent = text;
  }

  connectedCallback() {
    if (!this.link) this.append(Object.assign(document.createElement("a"), { href: new URL(`index.html?${this.query}`, LAB) }));
    if (!this.link.querySelector(".try")) this.link.append(Object.assign(document.createElement("span"), { className: "try", textContent: "Try it" }));
    figures.add(this);
    this.addEventListener("click", this);
  }

  disconnectedCallback() {
    figures.delete(this);
    if (front === this) this.frame.wait(true);
  }

  /** A click goes in. */
  handleEvent(event) {
    if (event.metaKey || event.ctrlKey || event.shiftKey || !event.target.closest("a")) return; // a new tab is the reader's wish
    event.preventDefault();
    this.enter();
  }

  /** The lab serves this figure, and has the keys. */
  enter() {
    serve(this);
    if (this.frame.ready) this.frame.element.contentWindow.focus();
    tell(this, { kind: "enter" });
  }

  /** Shows other fields of the figure's address in it. */
  move(query) {
    const fields = new URLSearchParams(this.query);
    fields.delete("lesson");
    new URLSearchParams(query).forEach((value, field) => fields.set(field, value));
    kept.set(this, fields.toString());
    if (front === this) this.frame.open(kept.get(this));
    else serve(this);
  }

  /** All that the lab has serves this figure from now on, as it is. */
  becomeWhole() {
    if (front !== this || this.#whole) return;
    front = null;
    this.frame.wait(true);
    this.#whole = true;
    this.link.style.removeProperty("height");
    serve(this);
    if (lab.ready) lab.element.contentWindow.focus();
    else this.link.focus();
  }

  /** Asks the lab for something, if it serves this figure; docs/web/messages.md has what there is. */
  send(message) {
    if (front === this) this.frame.ask(message);
  }

  /** The figure that is served. */
  static get front() {
    return front;
  }
}
customElements.define("motion-figure", MotionFigure);
