// The lab's pages for who opens them from a folder, without a server. A browser loads neither modules nor WebAssembly
// from files, but it does load plain scripts: here one of them holds the others, as text.
import { createHash } from "node:crypto";
import { gzipSync } from "node:zlib";

const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;

/** Replaces what has to be there. */
function swap(text, from, to) {
  const swapped = text.replace(from, to);
  if (swapped === text) throw new Error(`no ${from} in a page of the lab`);
  return swapped;
}

const HASHED = /[\w-]+\.[0-9a-f]{12}\.\w+/g;

/**
 * A page of the lab as one of a folder beside: its module is begun by `begin.js`, which makes addresses of what
 * `files.js` holds; the policy lets it.
 */
function page(html) {
  const module = html.match(/<script type="module" src="([^"]*)"><\/script>/)?.[1];
  if (!module) return html.replace(HASHED, "../lab/$&"); // frames alone
  let text = html.replace(/<link rel="(module)?preload"[^>]*>\n/g, "");
  text = swap(text, /<script type="module".*?<\/script>/, `<script defer src="files.js"></script>\n<script defer src="begin.js" data-module="MODULE"></script>`);
  text = swap(text, "script-src 'self'", "script-src 'self' blob:");
  text = swap(text, "connect-src 'self'", "connect-src 'self' blob:");
  const opening = text.match(/<script>([\s\S]*?)<\/script>/)?.[1];
  if (opening) {
    // what it would ask for early is no file here
    const without = swap(opening, /\n *document\.head\.append\(Object\.assign\(document\.createElement\("link"\), preload\)\);/, "");
    text = text.replace(opening, () => without).replace(hash(opening), hash(without));
  }
  return text.replace(HASHED, "../lab/$&").replace('"motion-figure.css"', '"../lab/motion-figure.css"').replace("MODULE", module);
}

/** The files of the folder, by their names, for the site's files by theirs; `begin` is the script that begins a page. */
export function folder(site, begin) {
  const held = {};
  for (const [name, contents] of site) {
    if (/\.wasm$|^saved\./.test(name)) held[name] = gzipSync(contents, { level: 9 }).toString("base64");
    // `light` is a plain script
    else if (/\.js$/.test(name) && !/^(light\.|offline\.js)/.test(name)) held[name] = contents.toString();
  }
  const pages = ["index.html", "embed.html", "book.html", "lens.html", "widgets.html"].map((name) => [name, page(site.get(name).toString())]);
  return new Map([...pages, ["files.js", `const FILES = ${JSON.stringify(held)};\n`], ["begin.js", begin]]);
}
