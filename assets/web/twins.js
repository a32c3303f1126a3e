// The controls of the canvas as elements of the page, their twins: in the same places, for keyboard, screen reader and a
// phone's own keyboard. What fingers do on the canvas is in fingers.js.

/** What a name says besides: a robot's configuration and what follows it, which changes while the run plays. */
const CHANGING = /(?:: | at )?\b(?:Pose2|HitchCfg|T\d|R2) \{/;

/** Keys that a twin needs itself; a kind that is not here keeps all. */
const OWN_KEYS = { button: "Enter Space Tab", combo: "Enter Space Tab", check: "Enter Space Tab", handle: "Tab" };

/** Keys that only change others. */
const MODIFIERS = ["Shift", "Control", "Alt", "AltGraph", "Meta", "CapsLock"];

/** Kinds that are typed into the twin, which is seen meanwhile. */
export const TYPED = ["number", "field"];

/** Kinds that are drawn as one button. */
const PRESSED = ["button", "combo", "handle"];

/** Kinds that hold a value: their name is drawn beside them as words, too. */
const HOLDING = ["check", "slider", "number", "field"];

/** Whether words say why a field's text is refused. */
const refuses = (field, words) => words.startsWith(`${field.value}: `);

/**
 * The twins in `container` of the canvas's controls. `send` sends the lab a message, `titles` gives the titles of its widgets, `said` what
 * the page says in its own elements, `leave` takes the focus when the twin that has it goes, `nudge` may take a key on a drawing: it
 * returns whether it has, and `alarm` says in #urgent why what was typed is refused.
 */
export function twins({ container, send, titles, said, leave, nudge, alarm }) {
  let all = []; // the twins, in the order of the screen
  let told = []; // the canvas's widgets, as it tells them
  const rail = document.createElement("nav"); // the buttons that choose a widget
  rail.setAttribute("aria-label", "Widgets");
  rail.hidden = true;
  container.append(rail);
  let opener = null; // the twin of a menu's or a list's button that was pressed last
  let others = null; // the layers that there were before it was, and until when another one is its
  let opened = null; // the layer of its menu or list, while it is open
  let isEntered = false; // whether the focus has gone into the list
  const above = document.createElement("div"); // what is in there, behind the button
  let asked = null; // the twin whose focus the lab has yet to take over
  let refusal = ""; // why what a field holds is refused
  let follows = false; // whether the focus moves because the lab's has

  function make(widget) {
    const tag = { text: "div", image: "div" }[widget.kind] ?? (PRESSED.includes(widget.kind) ? "div" : "label");
    const element = document.createElement(tag);
    let control = element;
    if (PRESSED.includes(widget.kind)) {
      element.append((control = document.createElement("button")));
      control.type = "button";
      if (widget.kind === "combo") control.setAttribute("aria-haspopup", "listbox");
      if (widget.kind === "button" && widget.name === "Menu") control.setAttribute("aria-haspopup", "true");
    } else if (widget.kind === "image") {
      element.setAttribute("role", "img");
    } else if (widget.kind !== "text") {
      control = document.createElement("input");
      control.type = { check: "checkbox", slider: "range", number: "number", field: "text" }[widget.kind];
      control.autocomplete = "off";
      element.append(document.createElement("span"), control);
      element.classList.toggle("typed", TYPED.includes(widget.kind));
    }
    element.classList.add("twin");
    const own = { element, control, widget };
    if (control !== element) listen(own);
    return own;
  }

  function listen(own) {
    const { control, element, widget } = own;
    const act = (action, value) => {
      const { id } = own.widget;
      if (action === "set") own.wanted = { id, value, until: performance.now() + 2000 };
      send({ do: "act", id, action, value });
    };
    own.act = act;
    control.addEventListener("focus", () => {
      // in the lab a number that has the focus becomes a text to type: here the twin is that, and is seen
      if (follows || TYPED.includes(widget.kind)) return;
      asked = { id: own.widget.id, until: performance.now() + 1000 };
      act("focus");
    });
    control.addEventListener("blur", () => {
      element.classList.remove("typing");
      setTimeout(() => update(own, own.widget)); // what waited for the end of reading
    });
    if (PRESSED.includes(widget.kind)) {
      control.addEventListener("click", () => {
        const { kind, open, layer } = own.widget;
        if (layer === undefined && (kind === "combo" || open === false)) {
          opener = own;
          others = { layers: new Set(told.map((widget) => widget.layer)), until: performance.now() + 1000 };
        }
        act("click");
        // egui closes a list for a pointer that chooses, and not for a reader who does
        if (control.role === "option") setTimeout(() => opened === layer && ["keydown", "keyup"].forEach(escape), 200);
      });
    }
    if (widget.kind === "check") control.addEventListener("change", () => act("click"));
    else if (widget.kind === "field") {
      const commit = () => control.value !== own.widget.value && act("type", control.value);
      control.addEventListener("blur", commit);
      control.addEventListener("keydown", ({ key }) => key === "Enter" && commit());
    } else if (["slider", "number"].includes(widget.kind)) {
      control.addEventListener("input", () => control.value !== "" && act("set", control.value));
      if (widget.kind === "number") control.addEventListener("keydown", (event) => step(event, own, act));
    }
    // the lab's keys work here too, where the control does not need them itself
    const needed = OWN_KEYS[widget.kind];
    if (widget.kind === "handle") control.addEventListener("keydown", (event) => nudge(event) && (event.preventDefault(), event.stopImmediatePropagation()));
    if (needed !== undefined) for (const type of ["keydown", "keyup"]) control.addEventListener(type, (event) => forward(event, needed));
  }

  /** A number's arrow keys go in the lab's steps: those of an element would call every other number invalid. */
  function step(event, { control, element, widget }, act) {
    if (event.key === "Enter" && element.classList.contains("typing")) control.blur();
    const by = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!by || !widget.range) return;
    event.preventDefault();
    const [least, most, size] = widget.range;
    const to = Math.min(most, Math.max(least, Number(control.value) + by * (size || 0.01)));
    control.value = Number(to.toPrecision(12));
    act("set", control.value);
  }

  const escape = (type) => send({ do: "key", key: "Escape", pressed: type === "keydown", shift: false });

  function forward(event, needed) {
    const name = event.key === " " ? "Space" : event.key;
    if (event.ctrlKey || event.metaKey || event.altKey || MODIFIERS.includes(event.key) || needed.split(" ").includes(name) || event.isComposing) return;
    event.preventDefault();
    if (!event.repeat) send({ do: "key", key: event.key, pressed: event.type === "keydown", shift: event.shiftKey });
  }

  function update(own, widget) {
    own.widget = widget;
    const { control, element } = own;
    if (widget.place && String(widget.place) !== own.place) {
      own.place = String(widget.place);
      const [left, top, width, height] = widget.place;
      // what the lab has scrolled away is not beyond its edge: the browser would scroll the page there
      const within = Math.max(0, Math.min(top, container.clientHeight - height));
      Object.assign(element.style, { left: `${left}px`, top: `${within}px`, width: `${width}px`, height: `${height}px` });
    }
    const name = widget.name ?? "";
    if (widget.kind === "text") return words(element, name);
    if (widget.kind === "image") return element.setAttribute("aria-label", name);
    // what was set under a number that the lab no longer uses is set again under the new one
    const { wanted } = own;
    if (wanted && (performance.now() > wanted.until || Number(wanted.value) === Number(widget.value))) own.wanted = null;
    else if (wanted && wanted.id !== widget.id) own.act("set", wanted.value);
    // a name does not change while it is read
    const isRead = control === document.activeElement;
    if (PRESSED.includes(widget.kind)) {
      const at = name.search(CHANGING);
      const label = [at > 0 ? name.slice(0, at) : name, widget.value].filter((part) => part !== undefined).join(": ");
      if (control.textContent !== label && !(isRead && widget.kind === "handle")) control.textContent = label;
      if (at > 0 && !isRead) control.setAttribute("aria-description", name.slice(at).replace(/^(: | at )/, ""));
    } else if (element.firstChild.textContent !== name) element.firstChild.textContent = name;
    // who has the focus would lose it, and the keys with it
    const off = widget.off_limits ?? false;
    control.disabled = off && !isRead;
    control.ariaDisabled = off ? "true" : null;
    if (widget.kind === "check") control.checked = widget.on;
    else if (widget.kind === "field") {
      const isRefused = refuses(widget, refusal);
      control.ariaInvalid = isRefused ? "true" : null;
      isRefused ? control.setAttribute("aria-describedby", "urgent") : control.removeAttribute("aria-describedby");
    } else if (own.element.parentNode === rail) control.ariaCurrent = widget.on ? "page" : null;
    else if (widget.kind === "button" && widget.on !== undefined) control.setAttribute("aria-pressed", widget.on);
    if (widget.open !== undefined) control.ariaExpanded = String(widget.open);
    // what stays is not set again: that would take half a number from under the reader's fingers
    if (widget.range && own.range !== String(widget.range) && !isRead) {
      own.range = String(widget.range);
      [control.min, control.max] = widget.range;
      control.step = "any";
    }
    if (widget.value !== undefined && !isRead && control.type !== "checkbox" && control.localName === "input") control.value = widget.value;
  }

  /** Words; the widget's title, which its description follows, is a heading. */
  function words(element, text) {
    if (element.dataset.words === text) return;
    element.dataset.words = text;
    const title = titles().find((title) => text.startsWith(`${title}. `));
    if (!title) return (element.textContent = text);
    const heading = document.createElement("h2");
    heading.textContent = title;
    element.replaceChildren(heading, text.slice(title.length + 2));
  }

  /** The widgets in the order of the screen: what lies at its foot is made first, and what keeps to the right comes from there. */
  function inOrder(widgets) {
    const foot = widgets.findIndex((w) => w.kind === "slider" && /^time line/.test(w.name ?? ""));
    const head = widgets.findIndex((w) => w.kind === "text" && titles().some((title) => w.name.startsWith(`${title}. `)));
    const ordered = foot >= 0 && foot < head ? [...widgets.slice(0, foot), ...widgets.slice(head), ...widgets.slice(foot, head)] : [...widgets];
    for (let from = 0; from < ordered.length; ) {
      let to = from + 1;
      const row = (w) => w.place && `${w.place[1]} ${w.place[3]}`;
      while (to < ordered.length && row(ordered[to]) && row(ordered[to]) === row(ordered[from])) to++;
      ordered.splice(from, to - from, ...ordered.slice(from, to).sort((a, b) => (a.place?.[0] ?? 0) - (b.place?.[0] ?? 0)));
      from = to;
    }
    return ordered;
  }

  /** A widget's kind and name, and which of those that share them it is. */
  function keys(widgets) {
    const count = new Map();
    return widgets.map(({ kind, name }) => {
      const key = `${kind} ${kind === "text" ? "" : name}`;
      count.set(key, (count.get(key) ?? 0) + 1);
      return `${key} ${count.get(key)}`;
    });
  }

  /**
   * The twin that each widget had before. The lab's numbers move on when words come or go above, and a twin that went with its number
   * would take the focus along; so a name counts first, and a number where the name is new, as Pause's is that was Play.
   */
  function known(widgets) {
    const found = new Map();
    const free = new Set(all);
    const match = (is) => {
      for (const own of free) {
        const widget = widgets.find((w, i) => !found.has(w) && is(own, w, i));
        if (widget) found.set(widget, own) && free.delete(own);
      }
    };
    const named = keys(widgets);
    match((own, w, i) => own.widget.id === w.id && own.key === named[i]);
    match((own, w, i) => own.key === named[i]);
    match((own, w) => own.widget.id === w.id && own.widget.kind === w.kind);
    for (const own of free) {
      const isRead = own.element.contains(document.activeElement);
      const wasInside = own.element.parentNode === above && opener.element.isConnected;
      own.element.remove();
      // out of a menu or a list that closes, the reader comes back to its button
      if (isRead) wasInside ? opener.control.focus({ preventScroll: true }) : leave();
    }
    return found;
  }

  /** The widgets without the words that are heard elsewhere: as the name of the control beside them, or from the page. */
  function once(widgets) {
    const names = new Set([...widgets.filter(({ kind }) => HOLDING.includes(kind)).map(({ name }) => name), refusal, ...said()]);
    return widgets.filter(({ kind, name }) => kind !== "text" || !names.has(name));
  }

  /** How many of the widgets are on the rail: it comes first, and is toggles. */
  function railed(widgets) {
    const count = widgets.findIndex(({ kind, on }) => kind !== "button" || on === undefined);
    return count > 2 ? count : 0;
  }

  /** Whether what is open is a list to choose from. */
  const isList = () => opener.widget.kind === "combo";

  /** Puts what is open behind its button, in the order of Tab too, and says what it is. */
  function open(items) {
    if (items.length === 0) {
      isEntered = false;
      return above.remove();
    }
    const place = opener.element.parentNode === container ? opener.element.nextSibling : null;
    if (!above.isConnected) container.insertBefore(above, place);
    const name = opener.control.textContent;
    above.setAttribute("role", isList() ? "listbox" : "group");
    above.setAttribute("aria-label", name);
    for (const { control, element, widget } of items) {
      if (control === element) continue;
      const isOption = isList() && PRESSED.includes(widget.kind);
      element.setAttribute("role", isOption ? "presentation" : "none");
      if (isOption) {
        control.setAttribute("role", "option");
        control.setAttribute("aria-selected", name.endsWith(`: ${control.textContent}`));
      }
    }
    // a list is entered where it is opened by key, once it can be: in its first frame egui only measures it
    const options = [...above.querySelectorAll("[role=option]:enabled")];
    if (isEntered || !isList() || options.length === 0) return;
    isEntered = true;
    const chosen = options.find((option) => option.ariaSelected === "true") ?? options[0];
    if (opener.control === document.activeElement) chosen.focus({ preventScroll: true });
  }

  above.addEventListener("keydown", (event) => {
    const by = { ArrowDown: 1, ArrowUp: -1, Home: -Infinity, End: Infinity }[event.key];
    if (by === undefined || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey || ["range", "number", "text"].includes(event.target.type)) return;
    const items = [...above.querySelectorAll("button, input")].filter((item) => !item.disabled);
    const at = items.indexOf(event.target) + by;
    event.preventDefault();
    event.stopImmediatePropagation();
    items[Number.isFinite(at) ? (at + items.length) % items.length : by < 0 ? 0 : items.length - 1]?.focus({ preventScroll: true });
  }, { capture: true });

  /** Says once why what a field holds is refused: words above the rest that begin with it. */
  function hearRefusal(tree) {
    const fields = tree.filter(({ kind }) => kind === "field");
    const words = tree.find(({ kind, layer, name }) => kind === "text" && layer !== undefined && fields.some((field) => refuses(field, name)))?.name ?? "";
    if (words !== refusal) alarm(words);
    refusal = words;
  }

  /** Makes the twins those of the canvas's widgets. */
  function mirror(tree) {
    told = tree;
    hearRefusal(tree);
    const widgets = once(tree);
    const layers = widgets.map((widget) => widget.layer).filter((layer) => layer !== undefined);
    if (!layers.includes(opened)) opened = (others && layers.find((layer) => !others.layers.has(layer))) ?? null;
    // what comes later is a notice, or a dialog
    if (opened || performance.now() > others?.until) others = null;
    const isInside = (widget) => opened !== null && widget.layer === opened;
    const ordered = [...inOrder(widgets.filter((widget) => !isInside(widget))), ...widgets.filter(isInside)];
    const onRail = new Set(widgets.slice(0, railed(widgets)));
    rail.hidden = onRail.size === 0;
    const found = known(ordered);
    all = ordered.map((widget) => found.get(widget) ?? make(widget));
    keys(ordered).forEach((key, i) => (all[i].key = key));
    // where the next twin goes: the rail is the container's first
    const next = new Map([[rail, rail.firstChild], [container, rail.nextSibling], [above, above.firstChild]]);
    for (const [i, own] of all.entries()) {
      const parent = onRail.has(ordered[i]) ? rail : isInside(ordered[i]) ? above : container;
      if (next.get(parent) === above) next.set(parent, above.nextSibling);
      // moving an element would take its focus away
      if (own.element !== next.get(parent) && !own.element.contains(document.activeElement)) parent.insertBefore(own.element, next.get(parent));
      if (own.element.parentNode === parent) next.set(parent, own.element.nextSibling);
      if (parent !== above && own.control.role === "option") ["role", "aria-selected"].forEach((name) => own.control.removeAttribute(name));
      update(own, ordered[i]);
    }
    open(all.filter((own) => isInside(own.widget)));
    follow(widgets.find((w) => w.focus)?.id);
  }

  /** There is one focus: where the lab moves its own, by an arrow key say, the page's goes along. */
  function follow(id) {
    if (asked && (id === asked.id || performance.now() > asked.until)) asked = null;
    const own = all.find((own) => own.widget.id === id);
    if (asked || !own || own.control === own.element || !container.contains(document.activeElement)) return;
    if (own.control === document.activeElement || document.activeElement.closest(".typed")) return;
    follows = true;
    own.control.focus({ preventScroll: true });
    follows = false;
  }

  /** The twin of a control that is at a point of the canvas; the smallest where they overlap. */
  function at(x, y, kinds) {
    const holds = ({ widget: { kind, place, off_limits } }) =>
      kinds.includes(kind) && !off_limits && place && x >= place[0] && y >= place[1] && x <= place[0] + place[2] && y <= place[1] + place[3];
    const area = ({ widget: { place } }) => place[2] * place[3];
    return all.filter(holds).sort((a, b) => area(a) - area(b))[0];
  }

  return { mirror, at, widgets: () => told, twin: (widget) => all.find((own) => own.widget === widget) };
}
