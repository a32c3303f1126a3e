// scans.cjs NAME BUILD DIGESTS: times the scans of a WebAssembly build as benches/table does natively: in every round ours and parry's do
// every scan once, in alternating order. Prints for each a line of the work, the name and the times, nanoseconds, with `|` between
// them. Fails where a scan's bits are not those of the native program.
const { readFileSync } = require("fs");
const [, , name, build, digests] = process.argv;
const lab = require(require("path").resolve(build));
const native = readFileSync(digests, "utf8").trim().split("\n");

const ROUNDS = 31;
const CASES = 256;
const LEAD = 16; // scans before the clock starts, so that nobody begins with what another left in the caches

function contender(work) {
  const run = () => {
    work(CASES - LEAD, LEAD);
    const start = performance.now();
    work(0, CASES);
    return ((performance.now() - start) * 1e6) / CASES;
  };
  for (let warm = 0; warm < 5; warm++) run(); // until the engine has compiled it for good
  const rounds = [];
  return { rounds, turn: () => rounds.push(run()) };
}

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
    for (const turn of round % 2 ? [parry.turn, ours.turn] : [ours.turn, parry.turn]) turn();
  }
  const work = `${contest.work()} (${name})`;
  console.log(`${work}||${ours.rounds.join(" ")}`);
  console.log(`${work}|parry, deterministic|${parry.rounds.join(" ")}`);
}
