// SPDX-License-Identifier: MIT
// Measures the studio in a browser without a graphics processor: the start, pictures and steps per second while a script plays, the way
// from the pointer to the moved skin, from an edit to the face, what the page weighs, and memory. Let the machine be idle.
//
//   node tools/web/measure_studio.mjs build/risorius build/web/node_modules [SCRIPT.json]

import { spawn } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";

const [program, packages, script = "samples/smile/script.json"] = process.argv.slice(2);
const { chromium } = await import(join(resolve(packages), "playwright-core/index.mjs"));
const middle = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const share = (values, part) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(part * values.length))];
const told = (name, text) => console.log(`${name.padEnd(44)} ${text}`);

const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1012, height: 1003 } });

// From the command to a face on the screen. The browser runs already, as on a desk.
const began = performance.now();
const server = spawn(program, ["view", script, "--no-browser", "--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
const url = await new Promise((done, fail) => {
  let text = "";
  server.stdout.on("data", (data) => {
    text += data;
    const found = text.match(/http:\S+/);
    if (found) done(found[0]);
  });
  server.on("exit", (code) => fail(new Error(`risorius view ended with ${code}`)));
});
await page.goto(url);
await page.waitForFunction(() => Number(document.querySelector("#stage").dataset.drawn) > 0 && document.body.dataset.step !== undefined);
told("start to the face", `${((performance.now() - began) / 1000).toFixed(2)} s`);
await page.waitForTimeout(8000); // the pictures of skin and eyes are painted meanwhile

// A stage of 640 x 640 pixels.
const size = await page.evaluate(() => [document.querySelector("#stage").clientWidth, document.querySelector("#stage").clientHeight]);
await page.setViewportSize({ width: 1012 + 640 - size[0], height: 1003 + Math.round((640 - size[1]) / 0.67) });
await page.waitForTimeout(500);
const stage = await page.evaluate(() => [document.querySelector("#stage").clientWidth, document.querySelector("#stage").clientHeight]);
const ask = (message) => page.evaluate((one) => window.studio.ask(one), message);

// Playing what has been computed, and computing while a channel is held.
const counts = () => page.evaluate(() => ({ drawn: Number(document.querySelector("#stage").dataset.drawn), step: Number(document.body.dataset.step), at: performance.now() }));
async function rates(name) {
  const before = await counts();
  await page.waitForTimeout(4000);
  const after = await counts();
  const s = (after.at - before.at) / 1000;
  told(name, `${((after.drawn - before.drawn) / s).toFixed(1)} pictures/s, ${((after.step - before.step) / s).toFixed(1)} steps/s at ${stage.join(" x ")} px`);
}
await ask({ type: "play", rate: 1, loop: true });
await page.waitForTimeout(3000);
await rates("playing, with a loop");
await ask({ type: "override", channel: "AU2", value: 0.7 });
await page.waitForTimeout(1000);
await rates("playing, simulated live");
const step_ms = await page.evaluate(() => window.studio.state().step_ms);
told("a step, running mean", `${step_ms} ms`);
await ask({ type: "release" });
await ask({ type: "pause" });
await ask({ type: "seek", t_s: 0 });
await page.waitForTimeout(3000);

// The pointer pulls: from its move to a pose with that hand, and to the picture of it.
const held = await page.evaluate(() => {
  const scene = window.studio.scene();
  const at = scene.landmarks.ch_l;
  let [best, least] = [-1, Infinity];
  for (let v = 0; v < scene.vertices; v++) {
    const far = Math.hypot(...at.map((one, k) => one - scene.rest[3 * v + k]));
    if (scene.soft[v] && far < least) [best, least] = [v, far];
  }
  return { row: best, vertex: scene.vertex[best] };
});
const place = await page.evaluate((v) => window.studio.screenOf(v), held.vertex);
await page.keyboard.down("Control");
await page.mouse.move(place.x, place.y);
await page.mouse.down();
await page.waitForTimeout(500);
const ways = await page.evaluate(
  async ([row, x, y]) => {
    const where = () => window.studio.pose().vertices[3 * row];
    const drawn = () => Number(document.querySelector("#stage").dataset.drawn);
    const canvas = document.querySelector("#stage > canvas");
    const frame = () => new Promise((next) => setTimeout(next));
    const out = [];
    for (let i = 0; i < 60; i++) {
      // At rest first: what moves next is moved by this pointer.
      for (let still = 0, last = where(); still < 25; ) {
        await new Promise((next) => setTimeout(next, 8));
        still = where() === last ? still + 1 : 0;
        last = where();
      }
      const [was, began] = [where(), performance.now()];
      canvas.dispatchEvent(new PointerEvent("pointermove", { bubbles: true, clientX: x + (i % 2 ? 4 : 8), clientY: y, pointerId: 1, buttons: 1, ctrlKey: true }));
      while (where() === was && performance.now() - began < 2000) await frame();
      const there = performance.now() - began;
      const count = drawn();
      while (drawn() === count && performance.now() - began < 2000) await frame();
      out.push([there, performance.now() - began]);
    }
    return out;
  },
  [held.row, place.x, place.y],
);
for (const [k, name] of ["moved skin in the page", "its picture"].entries()) {
  const way = ways.map((one) => one[k]);
  told(`pointer to ${name}, 60 moves`, `median ${middle(way).toFixed(0)} ms, 95 % ${share(way, 0.95).toFixed(0)} ms`);
}
await page.mouse.up();
await page.keyboard.up("Control");

const kB = (file) => gzipSync(readFileSync(file), { level: 9 }).length / 1000;
const built = join(resolve(packages), "../page");
told("page to the first picture, gzip", `${readdirSync(built).filter((one) => /\.(js|html|css|svg)$/.test(one)).reduce((sum, one) => sum + kB(join(built, one)), 0).toFixed(0)} kB`);
const memory = readFileSync(`/proc/${server.pid}/status`, "utf8").match(/VmHWM:\s+(\d+)/)[1] / 1000;
const heap = await page.evaluate(() => performance.memory.usedJSHeapSize / 1e6);
told("memory: server, most; page, heap", `${memory.toFixed(0)} MB; ${heap.toFixed(0)} MB`);
await browser.close();
server.removeAllListeners("exit");
server.kill("SIGINT");
