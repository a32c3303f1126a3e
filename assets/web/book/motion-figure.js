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
  failed = false; // whether it never will
  shows = null; // the figure whose address it was given last
  untaken = null; // the mark of an address that it has not taken: its states are still another figure's
  #gates = [gate(false), gate(true)];
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
    // a lens is given its first address as any other, so that it may refuse it
    this.element.src = new URL(this === lens ? `${this.#page}#shared` : `${this.#page}?${query}`, LAB);
    // pictures that come late move what is below them, and a body of the screen's height does not grow with them
    for (const part of document.body.children) sizes.observe(part);
    document.body.append(this.#gates[0], this.element, this.#gates[1]);
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

  /** Shows a figure as its reader left it; when it is not there yet, as soon as it is. */
  show(figure) {
    const query = kept.get(figure) ?? figure.query;
    if (!this.element) this.begin(query);
    else if (this.ready) this.untaken = this.askFor(figure, { do: "open", query });
    else return;
    this.shows = figure;
  }

  /** Whether nobody sees it from now on, nor hears of it. */
  wait(waits) {
    this.element.toggleAttribute("data-waits", waits);
    this.element.inert = waits;
  }

  /** Its gates are stops of Tab while the keys are in it. */
  open() {
    for (const element of this.#gates) element.tabIndex = this.hasFocus ? 0 : -1;
  }

  get hasFocus() {
    return this.element !== null && document.activeElement === this.element;
  }
}

/** What a reader can come to by Tab. */
const STOPS = "a[href], button, input, select, textarea, summary, [tabindex='0']:not(.motion-figure-gate)";

/** The first stop in the page behind a figure; the figure's link where there is none. */
function stopAfter(figure) {
  const isBehind = (stop) => figure.compareDocumentPosition(stop) & Node.DOCUMENT_POSITION_FOLLOWING && !figure.contains(stop);
  return [...document.querySelectorAll(STOPS)].find((stop) => isBehind(stop) && !stop.disabled && stop.checkVisibility()) ?? figure.link;
}

/** A stop before or behind a frame, which lies at the page's end: who leaves it by Tab goes on from where its figure is. */
function gate(isBehind) {
  const element = Object.assign(document.createElement("span"), { className: "motion-figure-gate", tabIndex: -1 });
  element.addEventListener("focus", () => (isBehind ? stopAfter(front) : front.link).focus());
  return element;
}
// a window loses the keys to a frame in it, and gets them back
const openGates = () => [lab, lens].forEach((frame) => frame.open());
// a browser may say so before it says which frame has them
for (const type of ["blur", "focus"]) addEventListener(type, () => (openGates(), setTimeout(openGates)));

const lab = new Frame("embed.html");
const lens = new Frame("lens.html");

/** Tells the page what comes of a figure. */
const tell = (figure, detail) => figure.dispatchEvent(new CustomEvent("motionlab", { bubbles: true, detail }));

/** Lays the frames over the figure in front, wherever the page has put either; the one that waits is not in the way. */
function place() {
  if (!front) return;
  for (const { element } of [lab, lens]) {
    if (!element) continue;
    const [over, at] = [front, element].map((shown) => shown.getBoundingClientRect());
    const lengths = { left: (parseFloat(element.style.left) || 0) + over.left - at.left, top: (parseFloat(element.style.top) || 0) + over.top - at.top, width: over.width, height: over.height };
    for (const [side, length] of Object.entries(lengths)) element.style.setProperty(side, `${length}px`);
  }
}

/** A frame serves a figure from now on, as its reader left it. */
function serve(figure) {
  if (front === figure) return;
  const before = front?.frame;
  const hadFocus = before?.hasFocus;
  if (front) leave();
  front = figure;
  figure.toggleAttribute("opened", true);
  figure.toggleAttribute("live", true);
  const { frame } = figure;
  if (frame.shows !== figure || !frame.ready) frame.show(figure);
  else frame.ask({ do: "state" }); // it is there as it was left
  if (before && before !== frame) {
    if (before === lab) lab.ask({ do: "pause" }); // what nobody sees need not move
    before.wait(true);
  }
  frame.element.title = figure.label;
  frame.wait(!frame.ready);
  // keys go to what is seen
  if (hadFocus && before !== frame) focus(figure);
  sizes.observe(figure);
  place();
}

/** The keys go to a figure: into its frame, or to its link until that is there. */
function focus({ frame, link }) {
  if (frame.ready) frame.element.contentWindow.focus();
  else link.focus({ preventScroll: true });
}

/** Keeps the picture and the state of the figure in front, which its frame leaves; another one may come. */
function leave() {
  const { frame } = front;
  front.removeAttribute("live");
  sizes.unobserve(front);
  if (!frame.ready) return;
  frame.ask({ do: "light", role: null });
  if (!frame.untaken) for (const what of ["figure", "link"]) frame.askFor(front, { do: what });
}

/** How far a figure is from the reading line: infinitely, unless it is well in view. */
function off(figure) {
  const { top, bottom } = figure.getBoundingClientRect();
  return top > innerHeight - 120 || bottom < 120 ? Infinity : Math.abs((top + bottom) / 2 - innerHeight * 0.45);
}

/** Serves the figure that was asked for and is nearest to the reading line; who is within one in view keeps it. */
function follow() {
  if (!front || (front.frame.hasFocus && off(front) < Infinity)) return;
  const seen = [...figures].filter((figure) => figure.hasAttribute("opened") && figure.frame.ready && off(figure) < Infinity);
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
    // the reader may have moved the lens meanwhile
    if (frame === lab && front.frame === lens && front.wantsAll) return lens.askFor(front, { do: "link" });
    if (front.frame !== frame) {
      // the reader has gone on meanwhile
      if (frame === lab) lab.ask({ do: "pause" });
      return follow();
    }
    frame.wait(false);
    if (front.contains(document.activeElement)) front.takeIn();
    if (frame === lens || frame.shows !== front || kept.has(front)) frame.show(front);
  },
  figure(_, { request, svg }) {
    const image = marks.get(request)?.querySelector("img");
    if (!image) return;
    if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  },
  // what does not fit in an address begins anew
  link(frame, { request, query }) {
    const figure = marks.get(request);
    if (!query || !figure) return;
    kept.set(figure, query);
    if (!figure.wantsAll || front !== figure) return;
    if (lab.ready) {
      lab.shows = null;
      figure.becomeWhole();
    } else if (!lab.element) {
      // the lens stays until the lab is there
      lab.begin(query);
      lab.wait(true);
      place();
    }
  },
  leave: (frame) => front.frame === frame && front.link.focus(),
  // its reader asks for all that the lab has
  whole(frame) {
    if (frame !== lens || front.frame !== lens) return;
    front.wantsAll = true;
    lens.askFor(front, { do: "link" });
  },
  height: (frame, { height }) => front.frame === frame && Number.isFinite(height) && front.link.style.setProperty("height", `${height}px`),
  error(frame, { request }) {
    // an address of something that moves after all
    if (frame === lens && request && request === lens.untaken) marks.get(request).becomeWhole();
  },
  failed(frame) {
    const figure = front;
    const serves = figure.frame === frame;
    frame.failed = true;
    if (frame === lens) {
      // the lab serves the figures of a lens that can't be loaded
      const hadFocus = lens.hasFocus;
      if (lab.ready) lab.say("Try it");
      if (!serves) return;
      lens.wait(true);
      front = null;
      serve(figure);
      if (hadFocus) focus(figure);
    } else if (serves) {
      figure.removeAttribute("live");
    } else if (figure.wantsAll) {
      figure.wantsAll = false;
      lens.show(figure); // which lets its reader ask again
    }
  },
};
addEventListener("message", ({ source, origin, data }) => {
  const said = data?.motionLab;
  const frame = [lab, lens].find(({ element }) => element && source === element.contentWindow);
  if (!said || !frame || origin !== ORIGIN) return;
  hear[said.kind]?.(frame, said);
  const isOurs = marks.delete(said.request);
  // who refuses an address still shows another figure
  if (isOurs && said.request === frame.untaken && said.kind !== "error") frame.untaken = null;
  // what comes before the lab has taken the address is another figure's
  if (!isOurs && !frame.untaken && front.frame === frame) tell(front, said);
});

/**
 * A figure of the lab. It gets events `motionlab`, which bubble, with what the lab tells in `detail`, and one of kind
 * `enter` once its reader is in, before which comes one of kind `loads` where the lab is not there yet.
 */
export class MotionFigure extends HTMLElement {
  get query() {
    return this.getAttribute("query") ?? "";
  }

  /** Whether its reader has asked for all that the lab has, and whether the lab has come. */
  wantsAll = false;
  #whole = false;
  #isByKeys = false; // whether its reader came in by Enter

  /** The frame that serves it. */
  get frame() {
    const fields = new URLSearchParams(this.query);
    const widget = fields.get("widget") ?? (fields.has("tab") ? "anatomy" : "dashboard");
    return STILL.includes(widget) && !this.#whole && !lens.failed ? lens : lab;
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
    this.link.querySelector(".try").firstChild.data = text; // behind it may stand which figure it is
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
    this.#isByKeys = event.detail === 0;
    this.enter();
  }

  /** The lab serves this figure, and has the keys. */
  enter() {
    serve(this);
    if (this.frame.ready) this.takeIn();
    else tell(this, { kind: "loads" });
  }

  /** Its reader is in it. */
  takeIn() {
    // pictures above it may have come meanwhile
    if (this.#isByKeys) this.scrollIntoView({ block: "nearest" });
    focus(this);
    tell(this, { kind: "enter" });
  }

  /** Shows other fields of the figure's address in it. */
  move(query) {
    const fields = new URLSearchParams(this.query);
    fields.delete("lesson");
    new URLSearchParams(query).forEach((value, field) => fields.set(field, value));
    kept.set(this, fields.toString());
    if (front === this) return this.frame.show(this);
    if (this.frame.shows === this) this.frame.shows = null;
    serve(this);
  }

  /** The lab serves this figure from now on, as it is. */
  becomeWhole() {
    if (this.#whole) return;
    const hadFocus = lens.hasFocus;
    this.#whole = true;
    this.wantsAll = false;
    this.link.style.removeProperty("height");
    if (lens.shows === this) [lens.shows, lens.untaken] = [null, null];
    if (front !== this) return;
    front = null;
    lens.wait(true);
    serve(this);
    if (hadFocus) focus(this);
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
