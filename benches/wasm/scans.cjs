// scans.cjs NAME BUILD DIGESTS: times the scans of a WebAssembly build as benches/table does natively, a millisecond of ours and one of parry's
// by turns, and prints the rows. Fails where a scan's bits are not those of the native program.
const { readFileSync } = require("fs");
const [, , name, build, digests] = process.argv;
const lab = require(require("path").resolve(build));
const native = readFileSync(digests, "utf8").trim().split("\n");

const ROUNDS = 101;
const SLICE = 1; // milliseconds

const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.round((values.length - 1) * share)];

function contender(work) {
  let done = 0;
  let calls = 1;
  const run = () => {
    const start = performance.now();
    work(done, calls);
    done += calls;
    return performance.now() - start;
  };
  for (let warm = 0; warm < 20; warm++) run(); // until the engine has compiled it for good
  for (let took = 0; took < SLICE / 2; calls *= 2) took = run();
  calls /= 2;
  calls = Math.max(1, Math.round((calls * SLICE) / run()));
  return { rounds: [], turn() { this.rounds.push((run() * 1e3) / calls); } };
}

const summary = (times) => {
  const median = quantile(times, 0.5);
  const spread = (quantile(times, 0.75) - quantile(times, 0.25)) / 2 / median;
  return [`${median.toPrecision(3)} us`, `${Math.round(100 * spread)} %`];
};

for (let k = 0; k < lab.worlds(); k++) {
  const contest = new lab.Contest(k);
  const line = `${contest.digest()} ${contest.work()}`;
  if (!native.includes(line) || native.some((other) => other.slice(17) === contest.work() && other !== line)) {
    console.error(`${name}: not the bits of the native program: ${line}`);
    process.exit(1);
  }
  const ours = contender((from, calls) => contest.ours(from, calls));
  const parry = contender((from, calls) => contest.parry(from, calls));
  for (let round = 0; round < ROUNDS; round++) {
    ours.turn();
    parry.turn();
  }
  const ratio = quantile(ours.rounds.map((t, i) => parry.rounds[i] / t), 0.5).toFixed(1);
  const [[time, spread], [theirs, spreads]] = [summary(ours.rounds), summary(parry.rounds)];
  const must = contest.marked() && name.includes("simd") ? ">= 15x" : "";
  console.log(`| ${contest.work()} (${name}) | ${time} | parry ${theirs} | ${ratio}x | ${must} | ${spread}, ${spreads} |`);
}
