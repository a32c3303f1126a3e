// <motion-figure query="widget=anatomy&tab=witness" label="Distance and witness">: a figure that is the lab once its
// reader asks for it. Within it stands a link with a picture, which is there without script too. One frame with the lab
// serves whichever of a page's figures that were asked for is nearest to the reading line; the others keep their last
// picture, and are found as they were left. docs/web.md has an example.

/** Where the lab is: beside this file. */
const LAB = new URL(".", import.meta.url);
/** Its pages' origin; those of a folder have none, which browsers write so. */
const ORIGIN = LAB.protocol === "file:" ? "null" : LAB.origin;

const figures = new Set(); // those in the page
const kept = new WeakMap(); // the address of each figure as its reader left it
const marks = new Map(); // the figure that a request to the lab is about
let frame = null; // the element with the lab, once a figure was asked for
let ready = false; // whether the lab in it draws
let front = null; // the figure that it serves
let untaken = null; // the mark of an address that the lab has not taken yet: its states are still another figure's
let count = 0;

const ask = (message) => frame?.contentWindow.postMessage({ motionLab: message }, ORIGIN === "null" ? "*" : ORIGIN);

/** Asks with a mark for what comes of it. */
function askFor(figure, message) {
  const request = `figure ${++count}`;
  marks.set(request, figure);
  ask({ ...message, request });
  return request;
}

/** Makes the frame, which stays in its place in the page: a frame that is moved loads anew. */
function begin(query) {
  frame = document.createElement("iframe");
  frame.className = "motion-figure";
  frame.allow = "clipboard-write";
  frame.tabIndex = -1; // a figure's link is the one stop of Tab: Enter goes in
  frame.src = new URL(`embed.html?${query}`, LAB);
  document.body.append(frame);
  for (const figure of figures) figure.say("Loading the lab");
}

/** Tells the page what comes of a figure. */
const tell = (figure, detail) => figure.dispatchEvent(new CustomEvent("motionlab", { bubbles: true, detail }));

/** Lays the frame over its figure, wherever the page has put either. */
function place() {
  if (!front) return;
  const [over, at] = [front, frame].map((element) => element.getBoundingClientRect());
  const lengths = { left: (parseFloat(frame.style.left) || 0) + over.left - at.left, top: (parseFloat(frame.style.top) || 0) + over.top - at.top, width: over.width, height: over.height };
  for (const [side, length] of Object.entries(lengths)) frame.style.setProperty(side, `${length}px`);
}

/** Shows an address in the figure in front. */
function open(query) {
  if (!frame) begin(query);
  else if (ready) untaken = askFor(front, { do: "open", query });
  else kept.set(front, query); // it is opened once the lab is there
}

/** The frame serves a figure from now on, as its reader left it. */
function serve(figure) {
  if (front === figure) return;
  if (front) leave();
  front = figure;
  figure.toggleAttribute("opened", true);
  figure.toggleAttribute("live", true);
  open(kept.get(figure) ?? figure.query);
  frame.title = figure.label;
  frame.toggleAttribute("data-waits", !ready);
  sizes.observe(figure);
  place();
}

/** Keeps the picture and the state of the figure in front, which the frame leaves. */
function leave() {
  front.removeAttribute("live");
  sizes.unobserve(front);
  if (ready && !untaken) for (const what of ["figure", "link"]) askFor(front, { do: what });
}

/** How far a figure is from the reading line: infinitely, unless it is well in view. */
function off(figure) {
  const { top, bottom } = figure.getBoundingClientRect();
  return top > innerHeight - 120 || bottom < 120 ? Infinity : Math.abs((top + bottom) / 2 - innerHeight * 0.45);
}

/** Serves the figure that was asked for and is nearest to the reading line; who is within one in view keeps it. */
function follow() {
  if (!ready || (document.activeElement === frame && off(front) < Infinity)) return;
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
  ready() {
    ready = true;
    frame.removeAttribute("data-waits");
    for (const figure of figures) figure.say("Try it");
    if (front.contains(document.activeElement)) frame.contentWindow.focus();
    // the reader may have gone on meanwhile
    if (kept.has(front)) open(kept.get(front));
  },
  figure({ request, svg }) {
    const image = marks.get(request)?.querySelector("img");
    if (!image) return;
    if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
    image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  },
  // what does not fit in an address begins anew
  link: ({ request, query }) => query && marks.has(request) && kept.set(marks.get(request), query),
  leave: () => front.link.focus(),
  failed: () => front.removeAttribute("live"),
};
addEventListener("message", ({ source, origin, data }) => {
  const said = data?.motionLab;
  if (!said || !frame || source !== frame.contentWindow || origin !== ORIGIN) return;
  hear[said.kind]?.(said);
  const isOurs = marks.delete(said.request);
  if (isOurs && said.request === untaken) untaken = null;
  // what comes before the lab has taken the address is another figure's
  if (!isOurs && !untaken) tell(front, said);
});

/**
 * A figure of the lab. It gets events `motionlab`, which bubble, with what the lab tells in `detail`, and one of kind
 * `enter` when its reader goes in.
 */
export class MotionFigure extends HTMLElement {
  get query() {
    return this.getAttribute("query") ?? "";
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
    if (front === this) frame.toggleAttribute("data-waits", true);
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
    if (ready) frame.contentWindow.focus();
    tell(this, { kind: "enter" });
  }

  /** Shows other fields of the figure's address in it. */
  move(query) {
    const fields = new URLSearchParams(this.query);
    fields.delete("lesson");
    new URLSearchParams(query).forEach((value, field) => fields.set(field, value));
    kept.set(this, fields.toString());
    if (front === this) open(kept.get(this));
    else serve(this);
  }

  /** Asks the lab for something, if it serves this figure; docs/web/messages.md has what there is. */
  send(message) {
    if (front === this) ask(message);
  }

  /** The figure that is served. */
  static get front() {
    return front;
  }
}
customElements.define("motion-figure", MotionFigure);
