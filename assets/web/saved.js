// Simulates the page's run again, says whether every second came out the same, and plays it. `wasm_bindgen` stands above.
// Whoever holds the page in a frame, as a notebook's widget does, hears of each change { motionLab: { tick, playing, verdict } }, and may
// ask by { motionLab: { tick, playing } } for another tick, and to play or not.
(async () => {
  const $ = (id) => document.getElementById(id);
  const root = document.documentElement;
  const verdict = $("verdict");
  const held = async (id) => {
    const bytes = Uint8Array.from(atob($(id).textContent), (c) => c.charCodeAt(0));
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
  };
  try {
    verdict.textContent = "Simulating the run again in this browser\u2026";
    const log = await held("bytes");
    $("log").href = URL.createObjectURL(new Blob([log]));
    await wasm_bindgen({ module_or_path: await held("wasm") });
    const found = JSON.parse(wasm_bindgen.verify_log(log));
    verdict.textContent = found.verified ? `Verified: ${found.text}, digest ${found.digest}.` : `Another run: ${found.text}.`;
    root.dataset.verdict = found.verified ? "verified" : "differs";
    replay(new wasm_bindgen.Replay(log), found.ticks);
  } catch (error) {
    verdict.textContent = `Not verified: ${error.message ?? error}`;
    root.dataset.verdict = "failed";
    tell(null, false);
  }

  function tell(tick, playing) {
    if (parent !== window) parent.postMessage({ motionLab: { tick, playing, verdict: root.dataset.verdict } }, "*");
  }

  function replay(run, ticks) {
    const [line, play, shown, picture] = ["line", "play", "shown", "picture"].map($);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    let timer = null;
    const show = (tick) => {
      line.value = tick;
      picture.querySelector("source")?.remove();
      picture.querySelector("img").src = `data:image/svg+xml,${encodeURIComponent(run.at(BigInt(tick), dark.matches))}`;
      shown.textContent = `tick ${tick}, ${(tick * 0.05).toFixed(2)} s`;
      root.dataset.tick = tick;
      tell(tick, timer !== null);
    };
    const pause = () => {
      if (timer === null) return;
      clearInterval(timer);
      timer = null;
      play.textContent = "Play";
      tell(Number(line.value), false);
    };
    const start = () => {
      if (timer !== null) return;
      if (Number(line.value) >= ticks) show(0);
      play.textContent = "Pause";
      // two ticks of 50 ms each tenth of a second
      timer = setInterval(() => {
        show(Math.min(ticks, Number(line.value) + 2));
        if (Number(line.value) >= ticks) pause();
      }, 100);
      tell(Number(line.value), true);
    };
    line.max = ticks;
    line.value = ticks;
    line.addEventListener("input", () => (pause(), show(Number(line.value))));
    play.addEventListener("click", () => (timer === null ? start() : pause()));
    dark.addEventListener("change", () => show(Number(line.value)));
    addEventListener("message", ({ source, data }) => {
      if (source !== parent || !data?.motionLab) return;
      const { tick, playing } = data.motionLab;
      if (Number.isInteger(tick) && tick >= 0 && tick <= ticks && tick !== Number(line.value)) show(tick);
      if (playing === true) start();
      if (playing === false) pause();
    });
    $("replay").hidden = false;
    tell(ticks, false);
  }
})();
