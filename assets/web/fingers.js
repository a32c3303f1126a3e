// Fingers on the canvas: what scrolls, what is dragged, what a tap beside a small control means, and what is brought into sight.
import { TYPED } from "./twins.js";

/** Half of the width and height that a finger needs, and the distance at which the canvas itself takes a tap for one on a control. */
const REACH = 22;
const OWN_REACH = 6;

/** Way of a finger from which on it is known whether it goes up or down, pixels. */
const SURE = 3;

/** Room below a field that is typed into, for the buttons and words that belong to it, pixels. */
const BELOW = 110;

const TAPPED = ["button", "combo", "check", ...TYPED];
const bottomOf = ({ place: [, top, , height] }) => top + height;
const holds = ([left, top, width, height], [x, y]) => x >= left && x <= left + width && y >= top && y <= top + height;

/** The widgets that are drawings, those in the strip at the foot, its top, and the words that scroll between them. */
function layout(canvas, widgets) {
  const placed = widgets.filter((w) => w.place);
  const isLarge = ({ place: [, , width, height] }) => width * height > 0.08 * canvas.clientWidth * canvas.clientHeight;
  const drawings = placed.filter((w) => ["handle", "button", "image"].includes(w.kind) && isLarge(w));
  const [first, last] = [placed.indexOf(drawings[0]), placed.indexOf(drawings.at(-1))];
  const under = Math.max(...drawings.map(bottomOf));
  const leftmost = Math.min(...drawings.map((w) => w.place[0]));
  // the time line, and under the drawings the sentence with its links, which is told before them, as the rail beside them is
  const isSentence = ({ place: [left, top, width] }, i) => i < first && top >= under && left + width > leftmost;
  const isTime = ({ kind, name }) => (kind === "slider" && /^time line/.test(name ?? "")) || /^\d+ contacts? and /.test(name ?? "");
  const isStrip = (w, i) => isTime(w) || isSentence(w, i);
  const foot = Math.min(canvas.clientHeight, ...placed.filter(isStrip).map((w) => w.place[1]));
  // the canvas tells rail and strip first, and the words of a drawing after it; a dot on a drawing is a handle
  const isWords = (w, i) => !drawings.includes(w) && w.kind !== "handle" && !(i < first && w.place[1] >= foot);
  const after = placed.filter((w, i) => i > last && isWords(w, i));
  const left = Math.min(...after.map((w) => w.place[0]));
  const isBeside = drawings.length > 0 && left >= Math.max(...drawings.map((w) => w.place[0] + w.place[2]));
  const top = isBeside ? 0 : Math.max(0, ...drawings.map(bottomOf));
  const words = isBeside ? placed.filter((w, i) => w.place[0] >= left && isWords(w, i)) : after;
  return { placed, drawings, foot, words, top, left: isBeside ? left : 0 };
}

/** How far the words at a point go on below and above what is seen of them, pixels; nothing where none scroll. */
function hidden(canvas, widgets, [x, y]) {
  const { drawings, foot, words, top, left } = layout(canvas, widgets);
  if (y > foot || y < top || x < left || drawings.some((w) => holds(w.place, [x, y]))) return { below: 0, above: 0 };
  return { below: Math.max(0, ...words.map(bottomOf)) - foot, above: top - Math.min(top, ...words.map((w) => w.place[1])) };
}

/**
 * A swipe scrolls one thing: the lab's words where they go on that way, else the page and that around a frame; unless it begins on a
 * control that is dragged. In a frame a whole drawing is dragged only once the frame has been tapped. A tap on a number or a text brings
 * the phone's keyboard; one beside a control that is smaller than a finger is one on it. Gives the function that looks at each new tree.
 */
export function fingers({ canvas, container, at, widgets, twin, embedded, announce }) {
  let tap = null;
  let scrolls = null; // what the finger scrolls: "page", "words", or "unknown" as yet; nothing where it drags or goes sideways
  let isHeld = !embedded;
  let verdict = null; // what the lab last said of a guess
  const point = ({ clientX, clientY }) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [clientX - left, clientY - top];
  };
  /** Whether a control is a drawing. */
  const isLarge = ({ place: [, , width, height] }) => width * height > 0.1 * canvas.clientWidth * canvas.clientHeight;
  /** What a finger drags that comes down there; `undefined` where it scrolls, `null` on a drawing not in use. */
  const dragged = ([x, y]) => {
    const own = at(x, y, ["handle", "slider"]);
    return own && isLarge(own.widget) && !isHeld ? null : own;
  };
  // a drawing that nobody uses yet does not move before it is known whether the finger scrolls; what is typed is typed into the twin
  const isOurs = (event) => dragged(point(event)) === null || at(...point(event), TYPED) || pressedNext(point(event));
  /** The control that a finger presses while a number or a text is typed: what was typed is entered before. */
  const pressedNext = (spot) => {
    if (!container.contains(document.activeElement) || !document.activeElement.matches("input")) return undefined;
    const own = at(...spot, TAPPED);
    // on a drawing it counts where the finger is
    return own && !isLarge(own.widget) ? own : undefined;
  };
  const withhold = (type, is) =>
    canvas.parentElement.addEventListener(type, (event) => event.pointerType === "touch" && event.target === canvas && is(event) && event.stopPropagation(), { capture: true });
  withhold("pointerdown", isOurs);
  // the canvas would scroll its words by the moves that come before the browser scrolls the page
  withhold("pointermove", () => scrolls === "page" || scrolls === "unknown");

  canvas.addEventListener(
    "touchstart",
    (event) => {
      tap = event.touches.length === 1 ? point(event.touches[0]) : null;
      scrolls = tap && !dragged(tap) ? "unknown" : null;
      if (tap && dragged(tap)) event.preventDefault();
    },
    { passive: false },
  );
  canvas.addEventListener(
    "touchmove",
    (event) => {
      const [x, y] = point(event.touches[0]);
      // a way to the side is the lab's: a swipe to the next world
      if (scrolls === "unknown" && Math.abs(x - tap[0]) > Math.max(SURE, 2 * Math.abs(y - tap[1]))) scrolls = null;
      if (scrolls === "unknown" && Math.abs(y - tap[1]) > SURE) {
        const { below, above } = hidden(canvas, widgets(), tap);
        scrolls = (y < tap[1] ? below : above) > 1 ? "words" : "page";
      }
      if (scrolls === "words") event.preventDefault();
    },
    { passive: false },
  );
  canvas.addEventListener("touchend", (event) => {
    scrolls = null;
    const [x, y] = point(event.changedTouches[0]);
    if (!tap || Math.hypot(x - tap[0], y - tap[1]) > 10) return;
    isHeld = true;
    const own = at(x, y, TYPED) ?? pressedNext([x, y]) ?? beside([x, y]);
    if (!own) return;
    event.preventDefault(); // what a mouse would do next would take the focus again
    if (!TYPED.includes(own.widget.kind)) {
      if (container.contains(document.activeElement)) document.activeElement.blur(); // enters what was typed
      return own.act("click");
    }
    own.element.classList.add("typing");
    own.control.focus({ preventScroll: true });
    own.control.select();
  });
  canvas.addEventListener("touchcancel", () => (scrolls = null));
  window.addEventListener("blur", () => (isHeld = !embedded));

  /** The control smaller than a finger that is nearest to a tap which is on none. */
  function beside([x, y]) {
    if (at(x, y, [...TAPPED, "handle", "slider"])) return undefined;
    const { placed, foot, words } = layout(canvas, widgets());
    const away = ({ place: [left, top, width, height] }) => {
      const [across, down] = [Math.max(left - x, x - left - width, 0), Math.max(top - y, y - top - height, 0)];
      const [reachX, reachY] = [width, height].map((size) => Math.max(0, REACH - size / 2));
      return across > reachX || down > reachY ? Infinity : Math.hypot(across, down);
    };
    const seen = placed.filter((w) => TAPPED.includes(w.kind) && !w.off_limits && !(words.includes(w) && w.place[1] > foot));
    const nearest = seen.sort((a, b) => away(a) - away(b))[0];
    return nearest && away(nearest) < Infinity && away(nearest) > OWN_REACH ? twin(nearest) : undefined;
  }

  /** Brings a widget and the room below it into sight: scrolls the lab's words, and then the page. */
  function reveal(widget, room) {
    const { foot, words, top } = layout(canvas, widgets());
    const box = canvas.getBoundingClientRect();
    const below = bottomOf(widget) + room - foot;
    const more = below > 0 ? below : Math.min(0, widget.place[1] - top);
    if (more !== 0 && words.includes(widget)) {
      const where = { clientX: box.left + widget.place[0] + 4, clientY: box.top + foot - 30, bubbles: true, cancelable: true };
      // as a mouse wheel: the canvas takes no other word for it
      const mouse = (type) => canvas.dispatchEvent(new PointerEvent(type, { ...where, pointerType: "mouse", pointerId: 1 }));
      mouse("pointermove");
      canvas.dispatchEvent(new WheelEvent("wheel", { ...where, deltaY: more }));
      setTimeout(() => mouse("pointerout"), 600);
    }
    scrollTo(widget, room);
  }

  /** Scrolls the page to a widget and the room below it, as far as the lab's words show it. */
  function scrollTo(widget, room) {
    const { foot, words, top } = layout(canvas, widgets());
    const [begin, end] = [widget.place[1], bottomOf(widget) + room];
    const [first, last] = words.includes(widget) ? [Math.max(begin, top), Math.min(end, foot)] : [begin, end];
    const box = canvas.getBoundingClientRect();
    const { offsetTop, height } = visualViewport;
    const over = box.top + last - (offsetTop + height);
    const above = box.top + first - offsetTop;
    if (over > 0) scrollBy(0, over);
    else if (above < 0) scrollBy(0, above);
  }

  let sought = ""; // the control that the page was scrolled to last, and its place
  /** Keeps the control that has the keys in sight: the lab scrolls its words to it, which takes a while. */
  function follow() {
    if (!container.contains(document.activeElement)) return;
    const own = widgets().map(twin).find((own) => own?.control === document.activeElement);
    if (!own?.widget.place || isLarge(own.widget) || TYPED.includes(own.widget.kind)) return;
    const at = `${own.widget.id} ${own.widget.place}`;
    if (at === sought) return;
    sought = at;
    scrollTo(own.widget, 6);
  }

  container.addEventListener("focusin", ({ target }) => {
    const own = widgets().map(twin).find((own) => own?.control === target);
    if (own?.widget.place && !isLarge(own.widget)) reveal(own.widget, TYPED.includes(own.widget.kind) ? BELOW : 6);
  });

  /** Says what the lab says of a guess, and brings it into sight: it stands below the button that asks for it, in line with the field. */
  return function look() {
    follow();
    const all = widgets();
    const check = all.findIndex(({ kind, name }) => kind === "button" && name === "Check");
    const said = all.slice(check + 1).find(({ name }) => !["Show", "Next question"].includes(name));
    const isVerdict = check > 0 && said?.kind === "text" && said.place?.[0] === all[check - 1].place?.[0];
    const before = verdict;
    verdict = isVerdict ? said.name : null;
    if (!verdict || verdict === before) return;
    announce(verdict);
    reveal(said, 12);
  };
}
