// The page around a frame: what it may ask of the lab, and what it hears.

/** What a page around may ask. A control's own number, keys and text are the reader's. */
const ASKED = "light play pause step step_back reset reroll seek seed widget tab lesson configuration robot door theme figure state link save".split(" ");

/** What a page around hears. The run, the settings and what is copied are the reader's. */
const HEARD = "ready state lesson figure link error failed".split(" ");

const TABS = ["intersects", "distance", "witness", "swept"];
const THEMES = ["system", "light", "dark"];

/**
 * What is said of a message that names what the lab has not; nothing of one that the lab may have. The lab tells its reader what it
 * refuses, so that words of the page around would stand there as the lab's own: only the page around hears of these.
 */
function unknown(message, widgets, state) {
  const all = Object.values(widgets);
  const roles = ["robot", "obstacle", "goal", "path", "sensor", "witness", "free"];
  const [name, known, otherwise] = {
    widget: () => [message.id, Object.keys(widgets), "is no widget"],
    lesson: () => [message.id, [null, ...all.flatMap((w) => w.lessons)], "is no lesson: docs/web/course.md lists them"],
    tab: () => [message.id, TABS, "is no tab: it is one of intersects, distance, witness and swept"],
    light: () => [message.role, [null, ...roles, ...all.flatMap((w) => w.key.map(({ role }) => role))], "is no role"],
    theme: () => [THEMES.includes(String(message.name).toLowerCase()) ? null : message.name, [null], "is no theme"],
    robot: () => [message.robot, (state?.robots ?? []).map((r) => r.name), "is no robot of this run"],
    door: () => [`${message.world}: ${message.name}`, (state?.doors ?? []).map((d) => `${d.world}: ${d.name}`), "is no door of this run"],
    seed: () => [/^\d{1,20}$/.test(message.seed) ? null : message.seed, [null], "is not a seed"],
  }[message.do]?.() ?? [null, [null]];
  return known.includes(name ?? null) ? null : `${name} ${otherwise}`;
}

/**
 * Speaks with the page around, if there is one. `ask` carries out a message, `askReader` asks whether the run may be saved, `refuse` tells a
 * refusal, `widgets` are the site's and `state` gives the lab's. Returns the function that tells that page something.
 *
 * It speaks with one origin: the browser's word for the page around or, where the browser has none, that of the first message.
 */
export function around({ ask, askReader, refuse, widgets, state }) {
  const isFramed = parent !== window;
  let origin = !isFramed ? location.origin : (location.ancestorOrigins?.[0] ?? originOf(document.referrer));
  const missed = []; // what was said before the origin was known
  const tell = (message) => {
    if (!isFramed || !HEARD.includes(message.kind)) return;
    if (origin) parent.postMessage({ motionLab: message }, origin === "null" ? "*" : origin);
    else if (message.kind === "ready") missed.push(message);
  };
  window.addEventListener("message", (event) => {
    const message = event.data?.motionLab;
    if (event.source !== parent || !isFramed || typeof message?.do !== "string") return;
    origin ??= event.origin;
    if (event.origin !== origin) return;
    missed.splice(0).forEach(tell);
    if (!ASKED.includes(message.do)) return refuse(`${message.do.slice(0, 20)}: not for the page around`);
    const refusal = unknown(message, widgets, state());
    if (refusal) return refuse(refusal);
    // a file is saved for the reader, not for the page around: the reader is asked
    if (message.do === "save") askReader();
    else ask(message);
  });
  return tell;
}

function originOf(address) {
  try {
    return new URL(address).origin;
  } catch {
    return null;
  }
}
