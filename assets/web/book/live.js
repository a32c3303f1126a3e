// Words and figure are one: numbers that follow the figure's state, and terms that light with its parts.

/** The value at a path of the lab's state, such as `query.coordinates.1`. */
const at = (state, path) => path.split(".").reduce((inner, key) => inner?.[key], state);

/** A number in the unit and the digits that the build says for its place. */
export function printed(value, { unit, decimals, scale }) {
  if (typeof value !== "number") return "nothing near";
  const digits = (value / scale).toFixed(decimals).replace(/^-(?=0(\.0*)?$)/, "").replace("-", "−");
  return unit === "°" ? `${digits}°` : `${digits} ${unit}`.trim();
}

/** Binds numbers and terms to the figures. `light` lights a role in the figure that is served. */
export function live({ figures, light }) {
  const numbers = [...document.querySelectorAll(".live")];
  const terms = [...document.querySelectorAll(".term")];
  for (const term of terms) {
    const { role } = term.dataset;
    for (const type of ["pointerenter", "focus"]) term.addEventListener(type, () => (light(role), lit(role)));
    for (const type of ["pointerleave", "blur"]) term.addEventListener(type, () => (light(null), lit(null)));
  }

  /** Lights the words of a role, or none. */
  function lit(role) {
    document.documentElement.toggleAttribute("data-lit", Boolean(role));
    for (const term of terms) term.toggleAttribute("data-lit", term.dataset.role === role);
  }

  // a number belongs to the figure that it stands in, else to the last one before it in its section, else to the next one
  const order = [...document.querySelectorAll("h2, figure.lab")];
  const own = (number) => {
    const within = number.closest("figure.lab");
    const before = order.filter((element) => element.compareDocumentPosition(number) & Node.DOCUMENT_POSITION_FOLLOWING).at(-1);
    return within ?? (before?.matches("figure") ? before : order.slice(order.indexOf(before) + 1).find((element) => element.matches("figure")));
  };
  const owners = new Map(numbers.map((number) => [number, own(number)]));
  numbers.forEach((number) => (number.title = `In the book: ${number.textContent}`));

  return {
    /** The figure that is served tells its state. */
    state(figure, state) {
      lit(state.lit);
      for (const [number, owner] of owners) {
        if (owner !== figure) continue;
        const text = printed(at(state, number.dataset.live), number.dataset);
        if (number.textContent === text) continue;
        number.textContent = text;
        number.toggleAttribute("data-moved", number.title !== `In the book: ${text}`);
      }
    },
  };
}
