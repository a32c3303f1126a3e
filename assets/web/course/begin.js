// Begins a page that was opened from a folder: gives the modules and the WebAssembly in `FILES` addresses of their own.
(async () => {
  const { module } = document.currentScript.dataset;
  const addresses = new Map();
  const address = (name, blob) => addresses.set(name, URL.createObjectURL(blob)).get(name);

  /** The address of a module, whose imports have theirs first. */
  function moduleOf(name) {
    if (addresses.has(name)) return addresses.get(name);
    const text = FILES[name]
      .replace(/(from |import\()"\.\/([^"]*)"/g, (_, how, other) => `${how}"${moduleOf(other)}"`)
      .replaceAll("import.meta.url", "location.href");
    return address(name, new Blob([text], { type: "text/javascript" }));
  }

  /** The address of what is held packed. */
  async function packedOf(name, type) {
    const bytes = Uint8Array.from(atob(FILES[name]), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return address(name, new Blob([await new Response(stream).arrayBuffer()], { type }));
  }

  const element = document.getElementById("files");
  if (element) {
    const files = JSON.parse(element.textContent);
    const own = (path) => path.split("/").pop();
    for (const [name, type] of [["labWasm", "application/wasm"], ["lightWasm", "application/wasm"], ["saved", "text/html"]]) {
      if (name in files) files[name] = await packedOf(own(files[name]), type);
    }
    if ("lab" in files) files.lab = moduleOf(own(files.lab));
    element.textContent = JSON.stringify(files);
  }
  await import(moduleOf(module));
})().catch((error) => {
  console.error(error);
  delete document.documentElement.dataset.lab; // the pictures and words are there
});
