// The learning platform, by SCORM 1.2's run-time environment: what a student did before, and what is told of it.

/** How many frames and windows around are asked for the platform. */
const LEVELS = 50;

/** The platform's API in a frame around `from`, or in the window that opened it; null where there is none. */
export function findApi(from) {
  const readable = (read) => {
    try {
      return read() ?? null;
    } catch {
      return null; // another origin's window
    }
  };
  const around = (start) => {
    const windows = [];
    for (let at = start; at && windows.length < LEVELS; at = at.parent === at ? null : at.parent) windows.push(at);
    return windows;
  };
  for (const start of [from, readable(() => from.opener), readable(() => from.top.opener)]) {
    for (const at of around(start)) {
      const api = readable(() => at.API);
      if (api) return api;
    }
  }
  return null;
}

const two = (number) => String(number).padStart(2, "0");

/** A length of time as CMITimespan, HHHH:MM:SS.SS. */
export function timespan(seconds) {
  const hundredths = Math.min(Math.round(seconds * 100), 9999 * 360000);
  const [hours, minutes, rest] = [Math.floor(hundredths / 360000), Math.floor(hundredths / 6000) % 60, hundredths % 6000];
  return `${String(hours).padStart(4, "0")}:${two(minutes)}:${two(Math.floor(rest / 100))}.${two(rest % 100)}`;
}

/** A time of day as CMITime, HH:MM:SS. */
export const timeOfDay = (date) => [date.getHours(), date.getMinutes(), date.getSeconds()].map(two).join(":");

/** Keeps what is done with a learning platform. Throws in plain words where that does not begin. */
export class Platform {
  #api;
  #begun = Date.now();
  #refusal = null;
  #records = true; // whether anything is recorded: not where a teacher looks at it
  #ended = false;

  constructor(api) {
    this.#api = api;
    if (this.#call("LMSInitialize", "") !== "true") throw new Error(this.#error());
    this.#records = !["browse", "review"].includes(this.#get("cmi.core.lesson_mode"));
    this.kept = this.#get("cmi.suspend_data").split(" ").filter(Boolean);
    this.counts = this.#get("cmi.launch_data").split(",").map((part) => part.trim()).filter(Boolean);
    if (["", "not attempted"].includes(this.#get("cmi.core.lesson_status"))) this.#set("cmi.core.lesson_status", "incomplete");
    // whoever leaves comes back to what was done, also after the end
    this.#set("cmi.core.exit", "suspend");
    this.#commit();
  }

  /** Where it is kept, or what the platform did not take. */
  get words() {
    if (!this.#records) return { text: "You look at it without a mark: nothing is recorded." };
    if (!this.#refusal) return { text: "Kept by your course." };
    return { text: `Your course did not take this: ${this.#refusal}. It is tried again with what you do next; tell your teacher if it stays.`, isRefused: true };
  }

  /** Keeps what is done: the names, the share of what counts in percent, and of each part. */
  keep({ done, percent, isComplete, parts }) {
    this.#refusal = null;
    this.#set("cmi.suspend_data", done.join(" "));
    this.#set("cmi.core.score.min", 0);
    this.#set("cmi.core.score.max", 100);
    this.#set("cmi.core.score.raw", percent);
    if (isComplete && this.#get("cmi.core.lesson_status") !== "passed") this.#set("cmi.core.lesson_status", "completed");
    if (this.#get("cmi.objectives._children")) parts.forEach((part, i) => this.#tellPart(`cmi.objectives.${i}`, part));
    this.#commit();
  }

  /** Tells one thing that was done or tried. Platforms may do without these: then nobody misses them. */
  tell({ id, type, given, wanted, isRight, seconds }) {
    if (!this.#get("cmi.interactions._children")) return;
    const at = `cmi.interactions.${Number(this.#get("cmi.interactions._count")) || 0}`;
    this.#set(`${at}.id`, id);
    this.#set(`${at}.time`, timeOfDay(new Date()));
    this.#set(`${at}.type`, type);
    if (wanted != null) this.#set(`${at}.correct_responses.0.pattern`, wanted);
    if (given != null) this.#set(`${at}.student_response`, String(given).slice(0, 255));
    this.#set(`${at}.result`, isRight ? "correct" : "wrong");
    if (seconds != null) this.#set(`${at}.latency`, timespan(seconds));
    this.#commit();
  }

  /** Has the platform write down what it was told so far: a phone may end a page that is out of sight. */
  rest() {
    if (!this.#ended) this.#commit();
  }

  /** Ends the session, once. */
  end() {
    if (this.#ended) return;
    this.#ended = true;
    this.#setTime();
    this.#call("LMSFinish", "");
  }

  #tellPart(at, { id, percent, isComplete }) {
    this.#set(`${at}.id`, id);
    this.#set(`${at}.score.min`, 0);
    this.#set(`${at}.score.max`, 100);
    this.#set(`${at}.score.raw`, percent);
    this.#set(`${at}.status`, isComplete ? "completed" : percent > 0 ? "incomplete" : "not attempted");
  }

  #setTime() {
    this.#set("cmi.core.session_time", timespan((Date.now() - this.#begun) / 1000));
  }

  #commit() {
    if (!this.#records) return;
    this.#setTime();
    if (this.#call("LMSCommit", "") !== "true") this.#refusal ??= this.#error();
  }

  #get(element) {
    return this.#call("LMSGetValue", element);
  }

  #set(element, value) {
    if (!this.#records) return;
    if (this.#call("LMSSetValue", element, String(value)) !== "true") this.#refusal ??= `${element}, ${this.#error()}`;
  }

  /** What was wrong with the last call, in the platform's words. */
  #error() {
    const code = this.#call("LMSGetLastError");
    return `${this.#call("LMSGetErrorString", code) || "it does not say why"} (error ${code || "without a number"})`;
  }

  /** Platforms answer with strings, and some with truths; one that throws has not answered. */
  #call(name, ...words) {
    try {
      return String(this.#api[name](...words) ?? "");
    } catch {
      return "";
    }
  }
}
