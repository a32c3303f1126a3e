// A browser on the site, which keeps account of all that must not happen.
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { serve } from "../../../assets/web/serve.mjs";

const require = createRequire(import.meta.url);
export const { chromium } = require(process.env.MOTION_LAB_PLAYWRIGHT);
export const target = process.env.CARGO_TARGET_DIR;
export const shots = process.env.MOTION_LAB_SHOTS;

/** The lab natively, for checking what the browser saved. */
export const native = (...words) =>
  execFileSync(process.env.MOTION_LAB_NATIVE, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

export const ARGS = [
  "--no-sandbox",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

// Without a graphics card a frame takes as long as it has pixels: half as many each way are drawn, but for tests that choose
// a screen and look at what stands on it. For pictures to look at, MOTION_LAB_PIXELS=1.
const pixels = Number(process.env.MOTION_LAB_PIXELS ?? 0.5);

let browser = null;
let server = null;

export async function begin() {
  server = await serve(join(target, "web"), 0);
  browser = await chromium.launch({ executablePath: process.env.MOTION_LAB_CHROMIUM, args: ARGS });
}

export async function end() {
  await browser?.close();
  server?.close();
}

export const origin = () => `http://localhost:${server.address().port}`;
export const newBrowser = (more = []) => chromium.launch({ executablePath: process.env.MOTION_LAB_CHROMIUM, args: [...ARGS, ...more] });

/** A page on the lab, once its first frame is drawn. */
export class Lab {
  faults = [];
  received = { tree: [], states: 0 };

  static async open(path = "/", { options = {}, wait = true, before = async () => {}, from = browser } = {}) {
    const lab = new Lab();
    lab.context = await from.newContext({ viewport: { width: 1280, height: 800 }, deviceScaleFactor: options.viewport ? 1 : pixels, acceptDownloads: true, ...options });
    lab.page = await lab.context.newPage();
    const { page } = lab;
    page.on("console", (m) => ["error", "warning"].includes(m.type()) && !/GPU stall due to ReadPixels|Automatic fallback to software WebGL/.test(m.text()) && lab.faults.push(`console: ${m.text()}`));
    page.on("pageerror", (e) => lab.faults.push(`error: ${e.message}`));
    page.on("request", (r) => /^(http:\/\/localhost:|data:|blob:|file:)/.test(r.url()) || lab.faults.push(`request: ${r.url()}`));
    page.on("response", (r) => r.status() >= 400 && lab.faults.push(`${r.status()}: ${r.url()}`));
    await page.addInitScript(() => {
      window.received = { tree: [], state: null, kinds: [] };
      window.addEventListener("motionlab", ({ detail }) => {
        window.received.kinds.push(detail.kind);
        if (detail.kind === "tree") window.received.tree = detail.widgets;
        if (detail.kind === "state") window.received.state = detail;
      });
      window.violations = [];
      document.addEventListener("securitypolicyviolation", (e) => window.violations.push(`${e.violatedDirective} ${e.blockedURI}`));
    });
    await before(page);
    await page.goto(path.startsWith("http") || path.startsWith("file:") ? path : origin() + path);
    if (wait) {
      const shown = () => window.received.kinds.includes("ready") && window.received.tree.length > 0 && window.received.state && document.documentElement.dataset.lab !== "loading";
      await page.waitForFunction(shown, null, { timeout: 60000 });
    }
    return lab;
  }

  state = () => this.page.evaluate(() => window.received.state);
  tree = () => this.page.evaluate(() => window.received.tree);
  send = (message) => this.page.evaluate((m) => window.motionLab.send(m), message);

  /** Waits until the lab's state is as wanted. */
  async until(wanted, timeout = 20000) {
    const end = Date.now() + timeout;
    for (;;) {
      const state = await this.state();
      if (state && wanted(state)) return state;
      if (Date.now() > end) throw new Error(`${wanted} does not come true: ${JSON.stringify(state)}`);
      await this.page.waitForTimeout(40);
    }
  }

  /** The widget of the canvas whose name matches, once there is one. */
  async find(name) {
    const matches = (w) => (name instanceof RegExp ? name.test(w.name) : w.name === name);
    for (let i = 0; i < 200; i++) {
      const found = (await this.tree()).find(matches);
      if (found) return found;
      await this.page.waitForTimeout(50);
    }
    throw new Error(`nothing is called ${name}: ${(await this.tree()).map((w) => w.name).join(" | ")}`);
  }

  /** Where a widget's middle is on the page, or the point so many parts of its width and height in. */
  async at(name, [u, v] = [0.5, 0.5]) {
    const { place } = await this.find(name);
    const box = await this.page.locator("#lab").boundingBox();
    return [box.x + place[0] + u * place[2], box.y + place[1] + v * place[3]];
  }

  async click(name, where) {
    // a hand holds a button for a while: press and release may not fall into one frame
    await this.page.mouse.click(...(await this.at(name, where)), { delay: 120 });
  }

  async drag(from, to) {
    const { mouse } = this.page;
    await mouse.move(...from);
    await mouse.down();
    for (let i = 1; i <= 8; i++) {
      await mouse.move(from[0] + ((to[0] - from[0]) * i) / 8, from[1] + ((to[1] - from[1]) * i) / 8);
      await this.page.waitForTimeout(30);
    }
    await this.page.waitForTimeout(120);
    await mouse.up();
    await this.page.waitForTimeout(120);
  }

  shot = (name) => this.page.screenshot({ path: join(shots, `${name}.png`) });

  /** What must not have happened. */
  async close() {
    const violations = await this.page.evaluate(() => window.violations ?? []).catch(() => []);
    await this.context.close();
    return [...this.faults, ...violations.map((v) => `policy: ${v}`)];
  }
}
