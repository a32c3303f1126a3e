// Prints the digests of K seeds in the three worlds from the WebAssembly build, as examples/identity.rs does natively.
const [, , build, k] = process.argv;
const lab = require(require("path").resolve(build));
for (let seed = 0n; seed < BigInt(k); seed++) {
  for (const world of lab.identity_worlds()) {
    console.log(lab.identity_line(seed, world));
  }
}
