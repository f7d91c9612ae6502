// SPDX-License-Identifier: MIT
// The hosted page from a plain server of files, in Debian's Chromium: its weight, the face moves, channels and pulls change it, saving
// downloads, what needs the program says so, and its poses are those of `risorius view`. Needs build/web/hosted.
//
//   node hosted.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

import { end, errors, folder, open, packages, script, scriptOf, shot, start, state, test, until, vertexAt } from "./harness.mjs";

const hosted = join(packages, "../hosted");

// A server that knows files and nothing else
const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml", ".txt": "text/plain" };
let sent = 0;
const files = createServer((request, answer) => {
  const path = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)).replace(/\/$/, "/index.html");
  try {
    const bytes = readFileSync(join(hosted, path.replace(/^\/some\/place/, "")));
    const kind = kinds[extname(path)];
    const packed = kind && request.headers["accept-encoding"]?.includes("gzip") ? gzipSync(bytes) : null;
    sent += (packed ?? bytes).length;
    answer.writeHead(200, { "Content-Type": kind ?? "application/octet-stream", ...(packed ? { "Content-Encoding": "gzip" } : {}) });
    answer.end(packed ?? bytes);
  } catch {
    answer.writeHead(404);
    answer.end();
  }
});
await new Promise((resolve) => files.listen(0, "127.0.0.1", resolve));
// Not at the root of the server: the page may lie anywhere.
const url = `http://127.0.0.1:${files.address().port}/some/place/`;

// Steps of this quality go on until an iteration moves the nodes by less than 0.0025 mm RMS.
const exact = "video";
const native = await open(await start(0, "--quality", exact));
const began = Date.now();
const page = await open(url);
console.log(`      from the address to the face: ${((Date.now() - began) / 1000).toFixed(1)} s, ${(sent / 1e6).toFixed(2)} MB so far`);

/// Puts the playhead somewhere, and returns the vertices in mm.
async function poseAt(of, t_s) {
  await of.evaluate((t) => window.studio.ask({ type: "seek", t_s: t }), t_s);
  await of.waitForFunction((t) => Math.abs(window.studio.state().t_s - t) < 1e-6 && !window.studio.state().computing && Math.abs(window.studio.pose().t_s - t) < 1e-6, t_s, {
    timeout: 90000,
  });
  return of.evaluate(() => Array.from(window.studio.pose().vertices, (x) => 1e3 * window.studio.scene().unit_m * x));
}
/// How far apart the vertices of two poses are, mm: mean and largest.
function apart(a, b) {
  assert.equal(a.length, b.length);
  let most = 0;
  let sum = 0;
  for (let v = 0; v < a.length; v += 3) {
    const far = Math.hypot(a[v] - b[v], a[v + 1] - b[v + 1], a[v + 2] - b[v + 2]);
    most = Math.max(most, far);
    sum += far;
  }
  return { most, mean: sum / (a.length / 3) };
}
async function openOwn(name, text, of = page) {
  const path = join(folder, name);
  writeFileSync(path, text);
  await of.locator("#open").click();
  const chooser = of.waitForEvent("filechooser");
  await of.locator("#scripts button").click();
  await (await chooser).setFiles(path);
}

await test("weighs what it may", async () => {
  const size = (...names) => names.reduce((sum, name) => sum + (name.endsWith(".gz") ? statSync(join(hosted, name)).size : gzipSync(readFileSync(join(hosted, name))).length), 0) / 1e6;
  const shell = size("index.html", "studio.js", "studio.css", "hosted.css", "icon.svg", "engine_worker.js", "engine.js", "pack.json");
  const engine = size("engine.wasm.gz");
  const mesh = size("data/models/adult/head.obj.gz");
  console.log(`      page ${shell.toFixed(2)} MB, engine ${engine.toFixed(2)} MB, mesh ${mesh.toFixed(2)} MB`);
  assert.ok(shell < 0.3 && engine < 1.0 && mesh < 0.68, `${shell} ${engine} ${mesh}`);
});

await test("opens with the adult and a sample, and plays it", async () => {
  assert.equal(await page.title(), "hello.json – Risorius studio");
  assert.ok((await page.locator(".channel").count()) > 80);
  assert.equal(await page.locator("#loading").count(), 0);
  const before = await poseAt(page, 0);
  await shot(page, "hosted");
  await page.keyboard.press("Space");
  await until(page, () => window.studio.state().t_s > 1.5);
  const ms = await page.evaluate(() => window.studio.state().step_ms);
  console.log(`      a step beside the picture: ${ms} ms, ${(1000 / ms).toFixed(0)} steps/s`);
  await page.keyboard.press("Space");
  await shot(page, "hosted-playing");
  assert.ok(apart(before, await poseAt(page, 1.5)).most > 2);
});

await test("gives the poses of risorius view", async () => {
  const here = await open(`${url}?quality=${exact}`);
  const times = [0, 0.1, 0.2, 0.3, 0.4, 0.5];
  const known = [];
  for (const t_s of times) known.push(await poseAt(native, t_s));
  const compare = async (name, played) => {
    await openOwn(name, JSON.stringify(played), here);
    await until(here, (title) => document.title.startsWith(title), name);
    const out = { mean: 0, most: 0 };
    for (const [i, t_s] of times.entries()) {
      const { most, mean } = apart(await poseAt(here, t_s), known[i]);
      console.log(`      ${name} ${t_s} s: mean ${mean.toFixed(5)} mm, largest ${most.toFixed(4)} mm`);
      out.mean = Math.max(out.mean, mean);
      out.most = Math.max(out.most, most);
    }
    return out;
  };
  // Builds that round differently make other numbers of iterations, and places are sent in steps of 0.01 mm. A smile that is 1 % stronger
  // is beyond both limits: the test tells whether the engine computes something else.
  const limits = { mean: 0.002, most: 0.06 };
  const same = await compare("mine.json", script);
  assert.ok(same.mean < limits.mean && same.most < limits.most, JSON.stringify(same));
  const other = structuredClone(script);
  for (const key of other.channels.AU12.keys) key[1] *= 1.01;
  const more = await compare("more.json", other);
  assert.ok(more.mean > limits.mean && more.most > limits.most, JSON.stringify(more));
  await here.close();
});

await test("a channel changes the shape, and undo takes its key back", async () => {
  await openOwn("mine.json", JSON.stringify(script));
  await until(page, () => document.title.startsWith("mine.json"));
  const before = await poseAt(page, 0);
  const row = page.locator('.row[data-name="AU4"]');
  await row.locator("input[type=number]").fill("0.8");
  await row.locator("input[type=number]").press("Enter");
  await until(page, () => window.studio.state().overrides.AU4 === 0.8);
  await until(page, () => window.studio.state().resting);
  const after = await page.evaluate(() => Array.from(window.studio.pose().vertices, (x) => 1e3 * window.studio.scene().unit_m * x));
  assert.ok(apart(before, after).most > 1);
  await row.locator("button.key").click();
  await until(page, () => window.studio.script().script.channels.AU4 !== undefined);
  await page.locator("#undo").click();
  await until(page, () => window.studio.script().script.channels.AU4 === undefined);
});

await test("the skin is pulled, and springs back", async () => {
  const at = await page.evaluate((v) => window.studio.screenOf(v), await vertexAt(page, "nl3_l"));
  await page.keyboard.down("Control");
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  await page.mouse.move(at.x + 25, at.y - 6, { steps: 5 });
  await until(page, () => window.studio.state().pulls[0]?.moved_mm > 3);
  await shot(page, "hosted-pull");
  await page.mouse.up();
  await page.keyboard.up("Control");
  await until(page, () => window.studio.state().pulls.length === 0);
});

await test("the sights are there", async () => {
  for (const sight of ["muscles", "skull", "strain", "skin"]) {
    await page.locator("#sight").selectOption(sight);
    await page.waitForTimeout(1500);
    await shot(page, `hosted-${sight}`);
  }
});

await test("save downloads the script that the program reads", async () => {
  const download = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  const file = await download;
  assert.equal(file.suggestedFilename(), "mine.json");
  assert.deepEqual(JSON.parse(readFileSync(await file.path(), "utf8")), await scriptOf(page));
  await until(page, () => document.querySelector("#dirty").hidden);
});

await test("what is wrong is said, and the open script stays", async () => {
  await openOwn("other.json", JSON.stringify({ ...script, rig: "somebody/rig.json" }));
  await until(page, () => /rig: expected one that this page has \(adult\), found "somebody\/rig.json"/.test(document.querySelector("#message").textContent));
  await openOwn("broken.json", JSON.stringify({ ...script, channels: { zygomaticus_mayor: { keys: [[0, 1]] } } }));
  await until(page, () => /^broken.json:.*zygomaticus_major/.test(document.querySelector("#message").textContent));
  assert.equal(await page.title(), "mine.json – Risorius studio");
  await poseAt(page, 0.2);
});

await test("what needs the program says so", async () => {
  await page.locator("#new-head").click();
  assert.match(await page.locator("#needs-program").textContent(), /need a program on your computer/);
  await shot(page, "hosted-needs-program");
  await page.keyboard.press("Escape");
  assert.match(await page.evaluate(() => window.studio.ask({ type: "render" })), /Videos are made by a program on your computer/);
  await page.locator("#about-page").click();
  assert.match(await page.locator("#about").textContent(), /Nothing that you do leaves your computer/);
  await page.keyboard.press("Escape");
});

await test("samples open, and the address names one", async () => {
  await page.locator("#open").click();
  assert.deepEqual(await page.locator("#samples button").allTextContents(), ["hello", "smile", "emotions", "jaw", "emg"]);
  await shot(page, "hosted-open");
  await page.locator("#samples button", { hasText: "emg" }).click();
  await until(page, () => document.title.startsWith("emg.json"));
  assert.ok(Object.keys(await page.evaluate(() => window.studio.script().recorded)).length > 0);
});

await test("axe finds nothing to complain of", async () => {
  // The page forbids scripts of others; the browser's own inspector may.
  const session = await page.context().newCDPSession(page);
  await session.send("Runtime.evaluate", { expression: readFileSync(join(packages, "axe-core/axe.min.js"), "utf8") });
  const found = await page.evaluate(async () => (await window.axe.run()).violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`));
  assert.deepEqual(found, []);
});

await test("on a phone nothing is wider than the screen", async () => {
  await page.close();
  const phone = await open(`${url}#smile`, { width: 390, height: 844 });
  assert.equal(await phone.title(), "smile.json – Risorius studio");
  const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} px`);
  await phone.waitForTimeout(2500);
  await shot(phone, "hosted-phone");
});

assert.deepEqual(errors.filter((text) => /Content Security Policy/.test(text)), []);
files.close();
await end();
