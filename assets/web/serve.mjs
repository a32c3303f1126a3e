// A small static server for the site: types, the compressed copies, and the policy as a header too. For trying and for tests.
import { createServer } from "node:http";
import { createReadStream, existsSync, readFileSync, statSync } from "node:fs";
import { basename, join, normalize, extname, sep } from "node:path";
import { fileURLToPath } from "node:url";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".txt": "text/plain; charset=utf-8",
};

/** The file in `folder` that an address names; nothing for one that names none, leaves the folder or makes no sense. */
function fileOf(folder, address) {
  let path;
  try {
    path = decodeURIComponent(address.replace(/[?#].*$/s, ""));
  } catch {
    return null;
  }
  if (path.includes("\0")) return null;
  const file = join(folder, normalize(path));
  if (file !== join(folder) && !file.startsWith(join(folder, sep))) return null;
  const named = existsSync(file) && statSync(file).isDirectory() ? join(file, "index.html") : file;
  return existsSync(named) && statSync(named).isFile() ? named : null;
}

/** The policy that a page brings in itself. */
const policyOf = (page) => /http-equiv="Content-Security-Policy" content="([^"]*)"/.exec(readFileSync(page, "utf8"))?.[1] ?? "default-src 'none'";

/** Serves `folder` on `port` (0: any that is free) of the loopback interface; gives the server once it listens. */
export function serve(folder, port) {
  const server = createServer((request, response) => {
    let file = fileOf(folder, request.url);
    if (!file) {
      response.writeHead(404, { "content-type": "text/plain" }).end("There is no such page.\n");
      return;
    }
    const headers = {
      "content-type": TYPES[extname(file)] ?? "application/octet-stream",
      "cache-control": /\.[0-9a-f]{12}\./.test(file) ? "public, max-age=31536000, immutable" : "no-cache",
      "x-content-type-options": "nosniff",
      ...(extname(file) === ".html" && { "content-security-policy": policyOf(file) }),
      "referrer-policy": "no-referrer",
      // a module that pages of other origins may take
      ...(basename(file) === "motion-figure.js" && { "access-control-allow-origin": "*" }),
    };
    const compressed = `${file}.br`;
    if (existsSync(compressed) && /\bbr\b/.test(request.headers["accept-encoding"] ?? "")) {
      file = compressed;
      headers["content-encoding"] = "br";
    }
    response.writeHead(200, { ...headers, "content-length": statSync(file).size });
    if (request.method === "HEAD") response.end();
    else createReadStream(file).on("error", () => response.destroy()).pipe(response);
  });
  return new Promise((done, failed) => {
    server.on("error", failed);
    server.listen(port, "127.0.0.1", () => done(server));
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder, port] = process.argv.slice(2);
  if (!existsSync(join(folder, "index.html"))) {
    console.error("There is no site yet: run assets/web/build first.");
    process.exit(1);
  }
  if (!/^\d{1,5}$/.test(port) || Number(port) > 65535) {
    console.error(`${port}: not a port. Usage: assets/web/serve [PORT, 8000 by default]`);
    process.exit(2);
  }
  try {
    const server = await serve(folder, Number(port));
    console.log(`The lab is at http://localhost:${server.address().port}/ (Ctrl-C ends it).`);
  } catch (error) {
    const why = error.code === "EADDRINUSE" ? `port ${port} is in use; another one: assets/web/serve ${Number(port) + 1}` : error.message;
    console.error(why);
    process.exit(1);
  }
}
