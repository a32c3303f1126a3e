// What is printed of a run, by what `tick_digests` returns: name, ticks, digest of the run, digest of all ticks; or the digest of each tick.
exports.lines = (name, digests, ticks) => {
  const all = digests.split("\n");
  const [run, whole] = all.splice(-2);
  return ticks ? all.join("\n") : `${name} ${all.length - 1} ${run} ${whole}`;
};
