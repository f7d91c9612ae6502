// SPDX-License-Identifier: MIT
// The page in Debian's Chromium, as a person uses it: load, pull and read the force, move sliders and keys, undo, save, lose the
// engine and find it again, a phone, the keyboard alone, and axe. Needs the built page.
//
//   node browser.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const [program, packages, source, shots] = process.argv.slice(2);
const { chromium } = await import(join(resolve(packages), "playwright-core/index.mjs"));
const folder = mkdtempSync(join(tmpdir(), "risorius studio "));
const script = {
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
function start(port = 0) {
  server = spawn(program, ["view", join(folder, "script.json"), "--no-browser", "--port", String(port)], { stdio: ["ignore", "pipe", "inherit"] });
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
function stop(signal = "SIGINT") {
  server.removeAllListeners("exit");
  const ended = new Promise((resolve) => server.once("exit", resolve));
  server.kill(signal);
  return ended;
}

let failed = 0;
let page = null;
async function test(name, body) {
  const begin = Date.now();
  try {
    await body();
    console.log(`ok    ${name} (${((Date.now() - begin) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.log(`FAIL  ${name}\n${error.stack}`);
    // What a test holds must not spoil the next one.
    await page.mouse.up().catch(() => {});
    await page.keyboard.up("Control").catch(() => {});
  }
}

const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"],
});
const errors = [];
async function open(url, viewport = { width: 900, height: 620 }) {
  const page = await browser.newPage({ viewport });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.step !== undefined, null, { timeout: 30000 });
  return page;
}
const state = (page) => page.evaluate(() => window.studio.state());
const scriptOf = (page) => page.evaluate(() => window.studio.script().script);
const until = (page, what, argument) => page.waitForFunction(what, argument, { timeout: 30000 });
/// Waits until the engine has answered all edits.
const settled = async (page) => {
  for (let last = -1, now = 0; last !== now; ) {
    last = now;
    await page.waitForTimeout(400);
    now = await page.evaluate(() => window.studio.script().revision);
  }
};
/// The mesh vertex that tissue moves nearest to a landmark.
const vertexAt = (page, landmark) =>
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
const shot = (page, name) => (shots ? page.screenshot({ path: join(shots, `${name}.png`) }) : null);

let url = await start();
page = await open(url);

await test("loads: the face, the channels and the script are there", async () => {
  assert.equal(await page.title(), "script.json – Risorius studio");
  assert.ok((await page.locator(".channel").count()) > 80);
  assert.equal(await page.locator(".key-dot").count(), 5);
  assert.equal(await page.locator(".block.blink").count(), 1);
  await shot(page, "desktop");
});

await test("a pull of 10 mm shows its force, and nothing is left of it", async () => {
  const at = await page.evaluate((v) => window.studio.screenOf(v), await vertexAt(page, "nl3_l"));
  await page.keyboard.down("Control");
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 8, at.y - 4, { steps: 4 });
  await until(page, () => window.studio.state().pulls.length === 1);
  // On until the skin has come 10 mm
  let x = at.x + 8;
  for (const begin = Date.now(); Date.now() - begin < 20000 && (await state(page)).pulls[0].moved_mm < 10; ) {
    await page.mouse.move((x += 2), at.y - 4);
    await page.waitForTimeout(60);
  }
  const [pull] = (await state(page)).pulls;
  assert.ok(pull.moved_mm > 9.9 && pull.moved_mm < 25, `moved ${pull.moved_mm} mm`);
  assert.ok(pull.force_n > 0.2 && pull.force_n < 3, `${pull.force_n} N`);
  const label = await page.locator(".pull-label").textContent();
  assert.match(label, /^\d+\.\d\d N {3}\d+\.\d mm$/);
  await shot(page, "pull");
  await page.mouse.up();
  await page.keyboard.up("Control");
  await until(page, () => window.studio.state().pulls.length === 0);
});

await test("a slider is an override, and K makes it a key that undo takes back", async () => {
  const before = await scriptOf(page);
  const row = page.locator('.row[data-name="AU4"]');
  await row.locator("input[type=number]").fill("0.6");
  await row.locator("input[type=number]").press("Enter");
  await until(page, () => window.studio.state().overrides.AU4 === 0.6);
  assert.ok(await row.evaluate((element) => element.classList.contains("overridden")));
  await row.locator("button.key").click();
  await until(page, () => window.studio.script().script.channels.AU4 !== undefined);
  assert.deepEqual((await scriptOf(page)).channels.AU4, { keys: [[0, 0.6]] });
  await page.locator("#undo").click();
  await until(page, () => window.studio.script().script.channels.AU4 === undefined);
  assert.deepEqual(await scriptOf(page), before);
});

await test("a key is dragged, saved, undone 50 times, and the file is what the page shows", async () => {
  const key = page.locator('[data-key="AU12 1"]');
  const box = await key.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 60, box.y - 6, { steps: 8 });
  await page.mouse.up();
  await until(page, () => window.studio.script().script.channels.AU12.keys[1][0] > 0.21);
  await settled(page);
  const dragged = await scriptOf(page);
  assert.ok(dragged.channels.AU12.keys[1][1] > 0.5);
  await page.keyboard.press("Control+s");
  await until(page, () => document.querySelector("#dirty").hidden);
  assert.deepEqual(JSON.parse(readFileSync(join(folder, "script.json"), "utf8")), dragged);
  const revision = await page.evaluate(() => window.studio.script().revision);
  await page.locator('[data-key="AU12 1"]').focus();
  for (let i = 0; i < 50; i++) await page.keyboard.press("ArrowUp");
  await until(page, (r) => window.studio.script().revision >= r + 30, revision);
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < 51; i++) await page.keyboard.press("Control+z");
  await until(page, (keys) => JSON.stringify(window.studio.script().script.channels.AU12.keys) === keys, JSON.stringify(script.channels.AU12.keys));
});

await test("it plays to the end, and seeks", async () => {
  await page.keyboard.press("Space");
  await until(page, () => window.studio.state().t_s > 0.49 && !window.studio.state().playing);
  assert.ok((await state(page)).computed_s > 0.49);
  await page.keyboard.press("Home");
  await until(page, () => window.studio.state().t_s === 0);
  await page.keyboard.press(".");
  await until(page, () => Math.abs(window.studio.state().t_s - 1 / 60) < 1e-6);
});

await test("it says a text at once, with its sound", async () => {
  const events = (await scriptOf(page)).events.length;
  await page.keyboard.press("Home");
  await until(page, () => window.studio.state().t_s === 0);
  await page.locator("#add").selectOption("say");
  await page.locator("#say-text").fill("Good morning.");
  await shot(page, "say");
  const begin = Date.now();
  await page.locator("#say-form button.primary").click();
  await page.waitForFunction(() => window.studio.state().playing || !document.querySelector("#message").hidden);
  if (!(await state(page)).playing) {
    // Here is no voice; the page says which package is missing.
    assert.match(await page.locator("#message").textContent(), /risorius-voice-espeak|setup/);
    return;
  }
  console.log(`      from the text to the first pose: ${Date.now() - begin} ms`);
  await until(page, () => window.studio.sounds());
  const said = (await scriptOf(page)).events[events];
  assert.equal(said.say, "Good morning.");
  assert.ok((await scriptOf(page)).duration_s > 1);
  await until(page, () => !window.studio.state().playing);
  assert.ok(!(await page.evaluate(() => window.studio.sounds())));
  await page.keyboard.press("Control+z");
  await until(page, (n) => window.studio.script().script.events.length === n, events);
});

await test("the sights show muscles and strain", async () => {
  for (const sight of ["muscles", "strain", "wire", "skin"]) {
    await page.locator("#sight").selectOption(sight);
    await page.waitForTimeout(500);
    await shot(page, `sight-${sight}`);
  }
});

await test("the keyboard alone pulls a landmark by millimetres", async () => {
  await page.locator("#landmark").focus();
  await page.locator("#landmark").selectOption("nl3_l");
  await until(page, () => window.studio.state().pulls.length === 1);
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowRight");
  await until(page, () => window.studio.state().pulls[0]?.moved_mm > 1);
  await page.keyboard.press("Escape");
  await until(page, () => window.studio.state().pulls.length === 0);
});

await test("what is wrong is said, and changes nothing", async () => {
  const before = await scriptOf(page);
  await page.locator("#duration").fill("-3");
  await page.locator("#duration").press("Enter");
  await page.locator("#message").waitFor({ state: "visible" });
  assert.match(await page.locator("#message").textContent(), /duration_s: expected \(0, 3600\], found -3/);
  assert.deepEqual(await scriptOf(page), before);
});

await test("axe finds nothing to complain of", async () => {
  await page.evaluate(readFileSync(join(packages, "axe-core/axe.min.js"), "utf8"));
  const found = await page.evaluate(async () => (await window.axe.run()).violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`));
  assert.deepEqual(found, []);
});

await test("the engine is killed: the page says so, keeps the script, and comes back", async () => {
  const port = Number(new URL(url).port);
  await stop("SIGKILL");
  await page.locator("#lost").waitFor({ state: "visible" });
  const download = page.waitForEvent("download");
  await page.locator("#copy").click();
  const kept = JSON.parse(readFileSync(await (await download).path(), "utf8"));
  assert.deepEqual(kept, await scriptOf(page));
  url = await start(port);
  await page.goto("about:blank");
  await page.goto(url);
  await until(page, () => document.body.dataset.step !== undefined);
});

await test("on a phone nothing is wider than the screen", async () => {
  await page.close();
  page = await open(url, { width: 390, height: 844 });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} px`);
  await page.locator(".tabs button", { hasText: "Timeline" }).click();
  assert.ok(await page.locator("#timeline").isVisible());
  await page.waitForTimeout(300);
  await shot(page, "phone");
});

assert.deepEqual(errors.filter((text) => !/WebSocket|ERR_CONNECTION_REFUSED|GL Driver Message/.test(text)), []);
await browser.close();
await stop();
rmSync(folder, { recursive: true });
process.exit(failed ? 1 : 0);
