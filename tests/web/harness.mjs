// SPDX-License-Identifier: MIT
// What the browser tests of the studio share: a folder with a script, the program, Debian's Chromium, and waiting for the engine.
//
//   node TEST.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

export const [program, packages, source, shots] = process.argv.slice(2).map((path) => resolve(path));
const { chromium } = await import(join(resolve(packages), "playwright-core/index.mjs"));
export const folder = mkdtempSync(join(tmpdir(), "risorius studio "));
export const script = {
  format: "risorius-script",
  version: 1,
  rig: join(source, "rigs/adult/rig.json"),
  duration_s: 0.5,
  channels: { AU12: { keys: [[0, 0], [0.2, 0.5], [0.4, 0]] }, jaw_open: { keys: [[0, 0], [0.3, 0.2]] } },
  events: [{ blink: {}, start_s: 0.1 }],
};
writeFileSync(join(folder, "script.json"), JSON.stringify(script));
if (shots) mkdirSync(shots, { recursive: true });

let server = null;
export function start(port = 0, ...options) {
  return startWith([join(folder, "script.json"), "--port", String(port), ...options]);
}
/// Starts `risorius view` with these arguments, in the folder.
export function startWith(args) {
  server = spawn(program, ["view", "--no-browser", ...args], { stdio: ["ignore", "pipe", "inherit"], cwd: folder });
  return new Promise((resolve, reject) => {
    let text = "";
    server.stdout.on("data", (data) => {
      text += data;
      const found = text.match(/http:\S+/);
      if (found) resolve(found[0]);
    });
    server.on("exit", (code) => reject(new Error(`risorius view ended with ${code}`)));
  });
}
export function stop(signal = "SIGINT") {
  server.removeAllListeners("exit");
  const ended = new Promise((resolve) => server.once("exit", resolve));
  server.kill(signal);
  return ended;
}

let failed = 0;
export async function test(name, body) {
  const begin = Date.now();
  try {
    await body();
    console.log(`ok    ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.log(`FAIL  ${name}\n${error.stack}`);
    // What a test holds must not spoil the next one.
    for (const page of browser.contexts().flatMap((context) => context.pages())) {
      await page.mouse.up().catch(() => {});
      await page.keyboard.up("Control").catch(() => {});
    }
  }
}

export const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--no-sandbox",
    // A test may write this file before the page asks for a camera.
    "--use-fake-ui-for-media-stream",
    "--use-fake-device-for-media-stream",
    `--use-file-for-fake-video-capture=${join(folder, "camera.mjpeg")}`,
  ],
});
// One browser of one person: what it keeps, later pages find.
const context = await browser.newContext();
export const errors = [];
export async function open(url, viewport = { width: 900, height: 620 }) {
  const page = await context.newPage();
  await page.setViewportSize(viewport);
  // "Leave the page?"
  page.on("dialog", (dialog) => dialog.accept());
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.step !== undefined, null, { timeout: 30000 });
  return page;
}
export const state = (page) => page.evaluate(() => window.studio.state());
export const scriptOf = (page) => page.evaluate(() => window.studio.script().script);
export const until = (page, what, argument) => page.waitForFunction(what, argument, { timeout: 90000 });
/// Waits until the engine has answered all edits.
export const settled = async (page) => {
  for (let last = -1, now = 0; last !== now; ) {
    last = now;
    await page.waitForTimeout(400);
    now = await page.evaluate(() => window.studio.script().revision);
  }
};
/// The mesh vertex that tissue moves nearest to a landmark.
export const vertexAt = (page, landmark) =>
  page.evaluate((id) => {
    const scene = window.studio.scene();
    const [x, y, z] = scene.landmarks[id];
    let best = -1;
    let least = Infinity;
    for (let v = 0; v < scene.vertices; v++) {
      const far = Math.hypot(scene.rest[3 * v] - x, scene.rest[3 * v + 1] - y, scene.rest[3 * v + 2] - z);
      if (scene.soft[v] && far < least) [best, least] = [v, far];
    }
    return scene.vertex[best];
  }, landmark);
export const shot = (page, name) => (shots ? page.screenshot({ path: join(shots, `${name}.png`) }) : null);

/// Ends the program, the browser and the test.
export async function end() {
  assert.deepEqual(errors.filter((text) => !/WebSocket|ERR_CONNECTION_REFUSED|GL Driver Message/.test(text)), []);
  await browser.close();
  await stop();
  rmSync(folder, { recursive: true });
  process.exit(failed ? 1 : 0);
}
