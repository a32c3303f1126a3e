// A learning platform for tests: the public player scorm-again around the course pack, as a platform unpacks it.
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { shots } from "./harness.mjs";

const ROOT = join(import.meta.dirname, "../../..");
const PLAYER = readFileSync(process.env.MOTION_LAB_SCORM);

/** Makes a pack of the site under test, beside the one that is given out; gives its path. */
export function pack(...words) {
  const path = join(shots, "course.zip");
  execFileSync(join(ROOT, "assets/web/pack"), words, { stdio: "pipe", env: { ...process.env, MOTION_LAB_PACK: path } });
  return path;
}

/** What Python's own reader finds in a zip: names and sizes, after every byte was checked. */
export function readByPython(zip) {
  const program = `
import json, sys, zipfile
import xml.etree.ElementTree as xml
pack = zipfile.ZipFile(sys.argv[1])
assert pack.testzip() is None, pack.testzip()
manifest = xml.fromstring(pack.read("imsmanifest.xml"))
ims, adl = "{http://www.imsproject.org/xsd/imscp_rootv1p1p2}", "{http://www.adlnet.org/xsd/adlcp_rootv1p2}"
resource = manifest.find(f"{ims}resources/{ims}resource")
print(json.dumps({
    "names": pack.namelist(),
    "dates": sorted({str(info.date_time) for info in pack.infolist()}),
    "files": [file.get("href") for file in resource.iter(f"{ims}file")],
    "start": resource.get("href"), "type": resource.get(f"{adl}scormtype"),
    "version": manifest.find(f"{ims}metadata/{ims}schemaversion").text,
    "counts": manifest.find(f".//{adl}datafromlms").text,
    "mastery": manifest.find(f".//{adl}masteryscore") is not None,
}))`;
  return JSON.parse(execFileSync("python3", ["-c", program, zip], { encoding: "utf8" }));
}

/** Unpacks a zip by another's program; gives the folder. */
export function unpacked(zip) {
  const folder = join(shots, "course");
  rmSync(folder, { recursive: true, force: true });
  const made = spawnSync("unzip", ["-q", zip, "-d", folder]);
  if (made.error) execFileSync("python3", ["-m", "zipfile", "-e", zip, folder]);
  else if (made.status !== 0) throw new Error(`${made.stderr}`);
  return folder;
}

// a platform may know nothing of WebAssembly, and compresses nothing
const TYPES = { ".html": "text/html", ".js": "application/x-javascript", ".css": "text/css", ".svg": "image/svg+xml" };

/** The public player, which knows what was kept. */
const scormAgain = (kept) => `
  API = new Scorm12API({ autocommit: false, lmsCommitUrl: "/commit", logLevel: 4, enableOfflineSupport: false });
  API.loadFromJSON(${JSON.stringify(kept ?? {})}, "cmi");`;

/** The platform's page: its API, and the course in a frame or, after a click, in a window of its own. */
const player = (api, launch) => `<!doctype html><title>A course</title>
<button onclick="window.open('/content/index.html')">Open the course</button>
<script src="/player.js"></script>
<script>${api}</script>
${launch === "frame" ? `<iframe src="/content/index.html" style="width:100%;height:720px;border:0"></iframe>` : ""}`;

/**
 * Begins a platform of the course in a folder. `kept` is what it has of its student so far; null for a new one. `api`
 * is the script of another API than the public player's.
 */
export async function platform(folder, { kept = null, api = null } = {}) {
  const own = { kept, commits: 0 };
  const server = createServer(async (request, response) => {
    const [path, query] = request.url.split("?");
    const send = (type, body) => response.writeHead(200, { "content-type": type, "referrer-policy": "no-referrer" }).end(body);
    if (path === "/player.js") return send("text/javascript", PLAYER);
    if (path === "/") return send("text/html", player(api ?? scormAgain(own.kept), query === "window" ? "window" : "frame"));
    if (path === "/favicon.ico") return send("image/svg+xml", "<svg xmlns='http://www.w3.org/2000/svg'/>");
    if (path === "/commit") {
      const chunks = [];
      for await (const chunk of request) chunks.push(chunk);
      own.kept = JSON.parse(Buffer.concat(chunks)).cmi;
      own.commits += 1;
      return send("application/json", JSON.stringify({ result: "true", errorCode: 0 }));
    }
    const file = join(folder, path.slice("/content".length));
    if (!path.startsWith("/content/") || !statSync(file, { throwIfNoEntry: false })?.isFile()) return response.writeHead(404).end();
    send(TYPES[extname(file)] ?? "application/octet-stream", readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return Object.assign(own, { origin: `http://localhost:${server.address().port}`, close: () => (server.close(), server.closeAllConnections()) });
}

/** The course's page within the platform's. */
export const course = (page) => page.frames().find((frame) => /\/content\/index\.html/.test(frame.url()));

/** The frame of the lab or the book within the course's page, once there is one whose address matches. */
export async function inner(page, pattern) {
  for (let i = 0; i < 400; i++) {
    const found = page.frames().find((frame) => pattern.test(frame.url()));
    if (found) return found;
    await page.waitForTimeout(50);
  }
  throw new Error(`no frame is ${pattern}: ${page.frames().map((frame) => frame.url()).join(", ")}`);
}
