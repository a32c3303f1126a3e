// Simulates the page's run again and says whether every frame came out the same. `wasm_bindgen` stands above.
(async () => {
  const verdict = document.getElementById("verdict");
  const bytes = (id) => Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
  try {
    verdict.textContent = "Simulating the run again in this browser\u2026";
    const log = bytes("bytes");
    const save = document.getElementById("log");
    save.addEventListener("click", () => {
      save.href = URL.createObjectURL(new Blob([log]));
    });
    await wasm_bindgen({ module_or_path: bytes("wasm") });
    const found = JSON.parse(wasm_bindgen.verify_log(log));
    verdict.textContent = found.verified
      ? `Verified: ${found.text}, digest ${found.digest}.`
      : `Another run: ${found.text}.`;
    document.documentElement.dataset.verdict = found.verified ? "verified" : "differs";
  } catch (error) {
    verdict.textContent = `Not verified: ${error.message ?? error}`;
    document.documentElement.dataset.verdict = "failed";
  }
})();
