// Runs before the page is painted, within it: chooses paper and picture of what the address opens, and gives the lab its place.
(() => {
  const root = document.documentElement;
  // a browser that knows no modules keeps the pictures and words
  if (!("noModule" in HTMLScriptElement.prototype)) return;
  const { widgets, labWasm } = JSON.parse(document.getElementById("files").textContent);
  const fields = new URLSearchParams((location.search || location.hash).replace(/^[?#]/, ""));
  const begins = Object.keys(widgets).find((id) => widgets[id].lessons.includes(fields.get("lesson")));
  const asked = begins ?? fields.get("widget") ?? (fields.get("tab") && "anatomy");
  root.dataset.opens = Object.hasOwn(widgets, asked) ? asked : "dashboard";
  let own = null;
  try {
    own = JSON.parse(localStorage.getItem("motion-lab/settings"))?.theme;
  } catch {
    // a page that may not use the storage does without
  }
  const theme = (fields.get("theme") ?? own ?? "").toLowerCase();
  if (["light", "dark"].includes(theme)) root.dataset.theme = theme;
  root.dataset.lab = "loading";
  // the lab comes behind what shows how much of it is there
  const preload = { rel: "preload", as: "fetch", type: "application/wasm", crossOrigin: "", fetchPriority: "low", href: labWasm };
  document.head.append(Object.assign(document.createElement("link"), preload));
  // a script that does not come leaves them, too
  addEventListener("error", ({ target }) => target.type === "module" && delete root.dataset.lab, true);
})();
