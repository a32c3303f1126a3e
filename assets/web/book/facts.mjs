// The numbers of the book: each is what the lab answers to a command or what follows from such answers, and the prose may not differ
// from it by a digit.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

/** Where the files lie that commands name. */
export const ROOT = fileURLToPath(new URL("../../..", import.meta.url));

/** What a unit is in metres, radians or seconds, as the lab answers. */
const UNITS = { m: 1, cm: 0.01, mm: 0.001, km: 1000, rad: 1, "°": Math.PI / 180, s: 1, ms: 0.001, min: 60, "%": 0.01 };
const NUMERAL = /[-−]?\d[\d,]*(?:\.\d+)?/g;

/** A number and a unit, in prose. */
const MEASURE = new RegExp(
  `(?<![\\w.])\\d[\\d.,]*(?:\\s|\\u00a0)?(?:${Object.keys(UNITS).join("|")}|Hz|rev|metres?|centimetres?|millimetres?|seconds?|minutes?|degrees?|radians?|ticks?)(?![\\w²])`,
);

/** What was answered to each command: the program is asked once. */
const answers = new Map();

/** The first number with a unit in `text` that nothing stands behind; `null` without one. */
export const unbound = (text) => text.match(MEASURE)?.[0] ?? null;

/**
 * The facts that lines such as `name: query distance --robot reach 45deg,90deg -> distance` and `name = half * 2` tell.
 *
 * What stands behind `->` is a path into the answer's JSON or, between slashes, a pattern whose groups are the numbers.
 * `native` is the program that answers. In place of a command may stand a file of `tests/pinned`, what a test sees an
 * example print.
 */
export class Facts {
  #lines = new Map();
  #known = new Map();
  #native;

  constructor(native) {
    this.#native = native;
  }

  /** Takes in the lines of a block. */
  read(lines) {
    for (const line of lines.split("\n").filter((line) => line.trim())) {
      const [, name, command, path, formula] = line.trim().match(/^(\w+)(?:: (.+?) -> (.+)| = (.+))$/) ?? [];
      if (!name) throw new Error(`${JSON.stringify(line)} is no fact: NAME: COMMAND -> PATH, or NAME = FORMULA`);
      if (this.#lines.has(name)) throw new Error(`two facts are called ${name}`);
      this.#lines.set(name, { command, path, formula, from: command ?? formula });
    }
  }

  /** The numbers of a fact, and where they come from. */
  of(name) {
    const line = this.#lines.get(name);
    if (!line) throw new Error(`no fact is called ${name}`);
    if (!this.#known.has(name)) {
      this.#known.set(name, []); // a fact that needs itself has no numbers
      this.#known.set(name, line.command ? pick(this.#answer(line.command), line.path) : this.#evaluate(line.formula));
    }
    return { values: this.#known.get(name), from: line.from };
  }

  #answer(command) {
    if (!answers.has(command)) {
      const pinned = command.startsWith("tests/pinned/") && join(ROOT, command);
      const told = pinned && existsSync(pinned) ? readFileSync(pinned, "utf8") : execFileSync(this.#native, ["--quiet", ...command.split(/\s+/)], { cwd: ROOT, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });
      answers.set(command, told);
    }
    return answers.get(command);
  }

  #evaluate(formula) {
    const { sqrt, cos, sin, atan2, PI: pi } = Math;
    const given = { sqrt, cos, sin, atan2, pi };
    for (const [name] of formula.matchAll(/[a-z]\w*/g)) if (!(name in given)) given[name] = single(this.of(name).values);
    return new Function(...Object.keys(given), `return [${formula}];`)(...Object.values(given)).map(Number);
  }

  /** Refuses `text` unless its numerals are those of the fact, each rounded to the decimals that it shows. */
  check(text, name) {
    const { values, from } = this.of(name);
    const numerals = text.match(NUMERAL) ?? [];
    if (numerals.length !== values.length) throw new Error(`${text} has ${numerals.length} numbers, and ${name} has ${values.length} (${from})`);
    const unit = unitOf(text);
    numerals.forEach((numeral, i) => {
      const shown = shownLike(values[i], numeral, unit);
      if (shown !== numeral.replace("−", "-").replaceAll(",", "")) throw new Error(`${text} is ${shown} by ${name} (${from})`);
    });
  }
}

/** The one number of a fact that has one, else all. */
const single = (values) => (values.length === 1 ? values[0] : values);

/** What a unit is in metres, radians or seconds; 1 for what is none of these. */
export const scaleOf = (unit) => UNITS[unit] ?? 1;

/** The unit behind the last numeral of a text. */
export const unitOf = (text) => text.match(/([a-z°%]+)\)?$/i)?.[1] ?? "";

/** How many decimals a numeral shows. */
export const decimalsOf = (text) => text.match(/\.(\d+)/)?.[1].length ?? 0;

/** A value in a unit, with as many decimals as a numeral has. */
function shownLike(value, numeral, unit) {
  if (unit && !(unit in UNITS) && !["Hz", "ticks", "tick"].includes(unit)) throw new Error(`${unit} is no unit that the book knows`);
  return (value / scaleOf(unit)).toFixed(decimalsOf(numeral)).replace(/^-(0(?:\.0*)?)$/, "$1");
}

/** The numbers at a path of an answer's JSON, or of a pattern's groups in its text. */
function pick(answer, path) {
  const found = path.startsWith("/") ? answer.match(new RegExp(path.slice(1, -1), "s"))?.slice(1) : at(JSON.parse(answer), path);
  const values = [found].flat(Infinity).map(Number);
  if (found == null || values.some((value) => !Number.isFinite(value))) throw new Error(`${path} names no numbers in ${answer.slice(0, 200)}`);
  return values;
}

const at = (value, path) => path.split(/[.[\]]+/).filter(Boolean).reduce((inner, key) => inner?.[key], value);
