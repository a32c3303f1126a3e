// What a student has done of a course, and how much of what counts that is.

/**
 * The record of `items`, each of which belongs to `parts`. `keeper` has what was done before, and keeps what is done;
 * where it names parts that count, the others are for practice.
 */
export class Record {
  #done;
  #items;
  #parts;
  #keeper;
  #changed;

  constructor({ items, parts, keeper, changed }) {
    [this.#items, this.#parts, this.#keeper, this.#changed] = [items, parts, keeper, changed];
    const known = new Set(items.map(({ id }) => id));
    this.#done = new Set(keeper.kept.filter((id) => known.has(id)));
    const counting = keeper.counts.filter((part) => parts.includes(part));
    this.counting = counting.length > 0 ? counting : parts;
  }

  has(id) {
    return this.#done.has(id);
  }

  /** Names, in the order of the items. */
  get done() {
    return this.#items.map(({ id }) => id).filter((id) => this.#done.has(id));
  }

  /** How many are done of those in any of some parts. */
  share(parts) {
    const own = this.#items.filter((item) => item.parts.some((part) => parts.includes(part)));
    const done = own.filter(({ id }) => this.#done.has(id)).length;
    return { done, of: own.length, percent: own.length ? Math.floor((100 * done) / own.length) : 0, isComplete: own.length > 0 && done === own.length };
  }

  /** Something is done. What is done again changes nothing. */
  add(id, how = {}) {
    const item = this.#items.find((item) => item.id === id);
    if (!item || this.#done.has(id)) return;
    this.#done.add(id);
    this.#keeper.tell({ id: nameOf(item), type: item.type ?? "performance", isRight: true, ...how });
    const { percent, isComplete } = this.share(this.counting);
    this.#keeper.keep({ done: this.done, percent, isComplete, parts: this.#parts.map((id) => ({ id, ...this.share([id]) })) });
    this.#changed(item);
  }

  /** Something was tried and is not done. */
  missed(id, how) {
    const item = this.#items.find((item) => item.id === id);
    if (item && !this.#done.has(id)) this.#keeper.tell({ id: nameOf(item), type: item.type ?? "performance", isRight: false, ...how });
  }
}

/** What a platform's report calls an item: its first part stands before. */
const nameOf = ({ id, parts }) => `${parts[0]}.${id}`;
