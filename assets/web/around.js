// The page around a frame: what it may ask of the lab, and what it hears.

/** What a page around may ask. A control's own number, keys and text are the reader's. */
const ASKED = "light open play pause step step_back reset reroll seek why way_out seed widget tab lesson configuration robot door theme figure state link save".split(" ");

/** What a page around hears. The run, the settings and what is copied are the reader's. */
const HEARD = "ready state lesson figure link saved leave whole height done error failed".split(" ");

/**
 * Speaks with the page around, if there is one. `ask` carries out a message, `save` saves the run under a name if the reader agrees or the
 * page around is one of the lab's own, `refuse` tells a refusal, `isHeld` says whether Escape lets go of something here. Returns the function
 * that tells that page something.
 *
 * It speaks with one origin: the browser's word for the page around or, where the browser has none, that of the first message.
 */
export function around({ ask, save, refuse, isHeld = () => false }) {
  const isFramed = parent !== window;
  let origin = isFramed ? originAround() : location.origin;
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
    if (!ASKED.includes(message.do)) return refuse(`${message.do.slice(0, 20)}: not for the page around`, message.request);
    // a file is saved for the reader, not for a stranger's page around: the reader is asked
    const isOwn = event.origin === self.origin && (event.origin !== "null" || location.protocol === "file:");
    if (message.do === "save") save({ request: message.request, name: message.name, isOwn });
    else ask({ ...message, around: true });
  });
  // Escape leaves the frame, unless it closes or lets go of something in it
  window.addEventListener("keydown", ({ key }) => {
    if (key === "Escape" && !isHeld() && !document.querySelector("[aria-expanded=true], [role=dialog], [role=menu]")) tell({ kind: "leave" });
  });
  return tell;
}

/** The origin of the page around a frame as far as the browser says it; null where it does not. */
export function originAround() {
  const said = location.ancestorOrigins?.[0] ?? originOf(document.referrer);
  if (said) return said;
  try {
    return parent.location.origin; // a page of this one's origin can be read
  } catch {
    return null;
  }
}

function originOf(address) {
  try {
    return new URL(address).origin;
  } catch {
    return null;
  }
}
