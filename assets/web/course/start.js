// The course's start page: shows what there is to do, opens it in a frame, and hears what was done there.
import { Browser } from "./browser.js";
import { judge } from "./judge.js";
import { Record } from "./record.js";
import { Platform, findApi } from "./scorm.js";

const $ = (id) => document.getElementById(id);
const root = document.documentElement;
/** Pages of a folder are of no origin: each may speak with any. */
const ORIGIN = self.origin === "null" ? "*" : self.origin;
/** Where the lab's pages are that work here. */
const LAB = location.protocol === "file:" ? "folder" : "lab";
const { title, items, parts, counts, bookKept } = JSON.parse($("course").textContent);

/** Who keeps what is done: the platform if there is one, else the browser. */
function keeperOf() {
  const api = findApi(window);
  if (!api) return new Browser(counts);
  try {
    return new Platform(api);
  } catch (error) {
    return new Browser(counts, `Your course's platform does not begin: ${error.message}. Nothing comes to its gradebook.`);
  }
}

const keeper = keeperOf();
const record = new Record({ items, parts, keeper, changed: show });
let open = null; // the item in the frame, if it is one
let judged = null; // of an assignment: the function that judges its run

/** Says how much is done, and where it is kept. */
function show() {
  for (const entry of document.querySelectorAll("[data-item]")) {
    const isDone = record.has(entry.dataset.item);
    entry.toggleAttribute("data-done", isDone);
    entry.querySelector(".unseen").textContent = isDone ? "done: " : "to do: ";
  }
  for (const part of parts) {
    const { done, of } = record.share([part]);
    $(`share-${part}`).textContent = `${done} of ${of} done${record.counting.includes(part) ? "" : ", for practice"}`;
  }
  const { done, of, percent } = record.share(record.counting);
  $("bar").value = percent;
  $("share").textContent = done === of ? `All ${of} done: 100 %` : `${done} of ${of} done: ${percent} %`;
  const { text, isRefused } = keeper.words;
  if ($("kept").textContent !== text) $("kept").textContent = text; // said again only when it changes
  $("kept").toggleAttribute("data-refused", Boolean(isRefused));
  if (open) $("task").toggleAttribute("data-done", record.has(open.id));
}

/** The book remembers what the record has, and nothing that somebody else did in this browser. */
function remindBook() {
  const names = items.filter(({ id, inBook }) => inBook && record.has(id)).map(({ inBook }) => inBook);
  try {
    localStorage.setItem(bookKept, JSON.stringify(names));
  } catch {
    // then its dots begin empty, and the record keeps what it has
  }
}

// ---- what is open ----

/** What an address behind # opens: a page of the lab, what to call it, and the item that it is about. */
function asked() {
  const [kind, id] = decodeURIComponent(location.hash.slice(1)).split("/");
  const item = items.find((item) => item.id === id);
  if (kind === "book") return { page: `book.html${item?.at ? `#${item.at}` : ""}`, name: "The book" };
  if (kind === "lab") return { page: "index.html", name: "The whole lab" };
  if (kind === "lessons" && item?.lesson) return { page: `embed.html?widget=${item.widget}&lesson=${item.lesson}#${item.widget}`, name: "Lesson", words: item.task, item };
  if (kind === "assignments" && item?.goal) return { page: `embed.html?${item.query}`, name: item.title, words: item.goal.words, item };
  return null;
}

/** Shows the list or what the address asks for. The frame is made anew: what it was about before is over. */
function go() {
  const wanted = asked();
  const was = open;
  open = wanted?.item ?? null;
  [judged, far, warned] = [open?.goal ? judge(open.goal) : null, null, ""];
  $("list").hidden = Boolean(wanted);
  $("work").hidden = !wanted;
  root.dataset.opens = wanted ? location.hash.slice(1).split("/")[0] : "list";
  $("place").replaceChildren();
  document.title = wanted ? `${open?.title ?? wanted.name}: ${title}` : title;
  if (!wanted) {
    show();
    const entry = was && document.querySelector(`[data-item="${was.id}"] a`);
    entry?.focus(); // where the reader was
    return;
  }
  remindBook();
  $("task-title").textContent = wanted.name;
  $("task-words").textContent = wanted.words ?? "";
  tell(open && record.has(open.id) ? "Done." : "");
  $("task-tools").hidden = !open?.goal;
  const frame = document.createElement("iframe");
  frame.allow = "clipboard-write";
  frame.title = open?.title ?? wanted.name;
  frame.src = `${LAB}/${wanted.page}`;
  $("place").append(frame);
  show();
}

// ---- what the frame tells ----

/** Shows how far the task is. Who listens hears what changed, and not each centimetre. */
function tell(text, heard = text) {
  for (const [id, words] of [["task-far", text], ["task-said", heard]]) if ($(id).textContent !== words) $(id).textContent = words;
}

const byBook = new Map(items.filter(({ inBook }) => inBook).map((item) => [item.inBook, item.id]));
const ask = (message) => $("place").querySelector("iframe").contentWindow.postMessage({ motionLab: message }, ORIGIN);
let far = null; // what the run in the frame was last judged to be
let warned = ""; // what is said of a run that was saved too early, until it is there
const hear = {
  // an assignment's time runs once its reader has read it
  ready() {
    if (open?.goal) for (const message of [{ do: "pause" }, { do: "seek", tick: 0 }]) ask(message);
  },
  progress: ({ done }) => done.forEach((name) => record.add(byBook.get(name))),
  answer({ name, given, wanted, right }) {
    const how = { given, wanted };
    if (right) record.add(byBook.get(name), how);
    else record.missed(byBook.get(name), how);
  },
  lesson({ id, done, seconds }) {
    if (!done) return;
    record.add(id, { seconds });
    if (open?.lesson === id) tell("Done.");
  },
  state(state) {
    const found = judged?.(state);
    if (!found) return;
    far = found;
    if (found.isDone) warned = "";
    tell(warned + found.text, found.isUnderWay ? warned : found.text);
    if (found.isDone) record.add(open.id, { given: `tick ${state.tick}` });
  },
};
addEventListener("message", ({ source, origin, data }) => {
  const said = data?.motionLab;
  if (!said || source !== $("place").querySelector("iframe")?.contentWindow || origin !== self.origin) return;
  hear[said.kind]?.(said);
});

$("save").addEventListener("click", () => {
  ask({ do: "save", name: open.id });
  const isThere = far?.isDone || record.has(open.id);
  warned = isThere ? "" : `Saved as ${open.id}.mcap, but it is not there yet and would not pass. `;
  tell(warned + (far?.text ?? ""), warned);
});
$("anew").addEventListener("click", go);
addEventListener("hashchange", go);

// ---- the end ----

document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && keeper.rest());
addEventListener("pagehide", () => keeper.end());
// a page that comes back from the browser's memory has ended its session
addEventListener("pageshow", ({ persisted }) => persisted && location.reload());

$("folder").hidden = location.protocol !== "file:";
go();
