// Prints the digests of K seeds in the three worlds from the site's simulator in Chromium, as examples/identity.rs does natively.
import { Lab, begin, end, origin } from "./harness.mjs";

await begin();
try {
  const lab = await Lab.open("/widgets.html", { wait: false });
  const files = JSON.parse(await (await fetch(`${origin()}/index.html`)).text().then((t) => /id="files">(.*?)<\/script>/s.exec(t)[1]));
  await lab.page.addScriptTag({ url: `/${files.light}` });
  const lines = await lab.page.evaluate(
    async ([wasm, k]) => {
      await wasm_bindgen({ module_or_path: wasm });
      const found = [];
      for (let seed = 0n; seed < BigInt(k); seed++) {
        for (const world of wasm_bindgen.identity_worlds()) found.push(wasm_bindgen.identity_line(seed, world));
      }
      return found;
    },
    [`/${files.lightWasm}`, process.argv[2]],
  );
  console.log(lines.join("\n"));
} finally {
  await end();
}
