// Where there is no learning platform, the browser keeps what is done.

const KEPT = "motion-lab/course";

/** Keeps what is done in the browser, for this visit alone where that keeps nothing. */
export class Browser {
  kept = [];
  #keeps = true;
  #why;

  /** `counts` are the parts that count; `why` says why there is no platform, where one was expected. */
  constructor(counts, why = "") {
    [this.counts, this.#why] = [counts, why];
    try {
      this.kept = JSON.parse(localStorage.getItem(KEPT)) ?? [];
    } catch {
      this.#keeps = false;
    }
  }

  get words() {
    const where = this.#keeps ? "Kept in this browser alone." : "Kept until you leave this page: the browser keeps nothing.";
    return this.#why ? { text: `${this.#why} ${where}`, isRefused: true } : { text: where };
  }

  keep({ done }) {
    try {
      localStorage.setItem(KEPT, JSON.stringify(done));
    } catch {
      this.#keeps = false;
    }
  }

  tell() {}
  rest() {}
  end() {}
}
