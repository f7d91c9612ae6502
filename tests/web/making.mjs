// SPDX-License-Identifier: MIT
// What is made in the page: a recording by hand, a video and a picture by the renderer, blend shapes; progress, cancelling, refusals.
//
//   node making.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { end, folder, open, program, script, scriptOf, settled, shot, source, start, state, test, until, vertexAt } from "./harness.mjs";

const url = await start();
let page = await open(url, { width: 1200, height: 800 });
const hash = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const below = (...names) => join(folder, ...names);
const files = () => readdirSync(folder).sort();
const told = () => page.locator("#export-told").textContent();
const ask = (message) => page.evaluate((m) => window.studio.ask(m), message);
const slide = async (channel, value) => {
  await page.locator(`.row[data-name="${channel}"] input[type=number]`).fill(String(value));
  await page.locator(`.row[data-name="${channel}"] input[type=number]`).press("Enter");
};
const show = async (what) => {
  if (!(await page.locator("#export-dialog").isVisible())) await page.locator("#export").click();
  await page.locator(`#export-${what}`).click();
};
const ended = (pattern) => until(page, (p) => new RegExp(p).test(document.querySelector("#export-told").textContent), pattern);

await test("what is moved while it plays becomes keys, undone as one", async () => {
  await ask({ type: "edit", edits: [{ path: "/duration_s", value: 60 }] });
  const before = await scriptOf(page);
  await page.locator("#rate").selectOption("0.5");
  await page.locator("#record-take").click();
  await until(page, () => window.studio.state().recording && window.studio.state().t_s > 0.1);
  for (const value of [0.2, 0.5, 0.8, 0.4]) {
    await slide("AU4", value);
    const from = (await state(page)).t_s;
    await until(page, ([v, t]) => window.studio.state().overrides.AU4 === v && window.studio.state().t_s > t + 0.1, [value, from]);
  }
  const vertex = await vertexAt(page, "ch_l");
  await page.keyboard.down("Control");
  const at = await page.evaluate((v) => window.studio.screenOf(v), vertex);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  for (let i = 1; i <= 10; i++) {
    await page.mouse.move(at.x + 4 * i, at.y);
    await page.waitForTimeout(40);
  }
  await shot(page, "making-recording");
  await page.mouse.up();
  await page.keyboard.up("Control");
  assert.deepEqual(await scriptOf(page), before, "nothing is written while it records");
  await page.locator("#record-take").click();
  await until(page, () => !window.studio.state().recording && window.studio.script().script.channels.AU4);
  const { channels, pulls } = await scriptOf(page);
  assert.deepEqual(Object.keys(channels), ["AU12", "jaw_open", "AU4"]);
  assert.equal(channels.AU4.interpolation, "linear");
  const values = channels.AU4.keys.map((key) => key[1]);
  for (const value of [0.2, 0.5, 0.8, 0.4]) assert.ok(values.includes(value), `${values}`);
  assert.ok(channels.AU4.keys.length <= 14, `${JSON.stringify(channels.AU4.keys)}`);
  assert.equal(pulls.length, 1);
  assert.equal(pulls[0].vertex, vertex);
  assert.match(await page.locator("#message").textContent(), /^Recorded AU4, one pull\. Undo takes it back\.$/);
  assert.deepEqual((await state(page)).overrides, {});
  await shot(page, "making-recorded");
  await page.keyboard.press("Control+z");
  await settled(page);
  assert.deepEqual(await scriptOf(page), before);
});

await test("an empty recording says so", async () => {
  await page.keyboard.press("Home");
  await page.keyboard.press("r");
  await until(page, () => window.studio.state().recording);
  await page.keyboard.press("r");
  await until(page, () => !window.studio.state().recording);
  assert.match(await page.locator("#message").textContent(), /nothing was recorded/);
  await page.keyboard.press("Control+z"); // the length of the script
  await until(page, () => !window.studio.script().undo);
  await settled(page);
  assert.deepEqual(await scriptOf(page), script);
});

await test("only files below the folder are written, with words that are no options", async () => {
  const wrong = async (message) => ask({ type: "render", out: "x.mp4", ...message });
  for (const out of ["../x.mp4", "/etc/x.mp4", "", "x.json", "script.json", "anna/../../x.mp4"]) assert.match(await wrong({ out }), /out: expected a video/, out);
  assert.match(await wrong({ out: "nowhere/x.mp4" }), /expected a folder that exists, found "nowhere"/);
  assert.match(await wrong({ size: "--out=/etc/x" }), /size: expected a size in pixels/);
  assert.match(await wrong({ camera: "--rig" }), /camera: expected a camera/);
  assert.match(await wrong({ quality: "best" }), /quality/);
  assert.match(await ask({ type: "shapes", out: "shapes", set: "--only" }), /set: expected a set of shapes/);
  assert.match(await ask({ type: "shapes", out: "../shapes" }), /out: expected a folder/);
  assert.match(await ask({ type: "result" }), /expected a video or a picture that has been made, found none/);
  assert.deepEqual(files(), ["script.json"]);
});

// The file has what is played.
await ask({ type: "open", path: "script.json" });
await until(page, () => !window.studio.script().dirty && window.studio.script().duration_s === 0.5);

await test("a picture of the moment is what render makes", async () => {
  await page.locator("#clock").waitFor();
  await page.keyboard.press("Home");
  for (let i = 0; i < 12; i++) await page.keyboard.press(".");
  await until(page, () => Math.abs(window.studio.state().t_s - 0.2) < 1e-6);
  await show("picture");
  assert.match(await page.locator("#export-about").textContent(), /0\.20 s/);
  assert.equal(await page.locator("#export-out").inputValue(), "script.png");
  await page.locator("#export-size").fill("160x200");
  await page.locator("#export-camera").selectOption("three_quarter");
  await page.locator("#export-start").click();
  await ended("is ready");
  const shown = page.locator("#export-result img");
  await shown.waitFor();
  assert.deepEqual(await shown.evaluate((img) => img.decode().then(() => [img.naturalWidth, img.naturalHeight])), [160, 200]);
  await shot(page, "making-picture");
  const other = below("other.png");
  execFileSync(program, ["render", below("script.json"), "--still", "0.2", "--size", "160x200", "--camera", "three_quarter", "--quality", "preview", "--quiet", "-o", other]);
  assert.equal(hash(below("script.png")), hash(other));
  assert.ok(!existsSync(below("script.png.script.json")), "a script that is saved needs no draft");
});

await test("what exists is replaced only after a question", async () => {
  const before = hash(below("script.png"));
  await page.locator("#export-camera").selectOption("front");
  await page.locator("#export-start").click();
  await ended("exists already");
  assert.equal(hash(below("script.png")), before);
  await page.locator("#export-replace").click();
  await ended("is ready");
  assert.notEqual(hash(below("script.png")), before);
  await page.locator("#export-close").click();
});

await test("a video of edits that are not saved is that of the script with them", async () => {
  await ask({ type: "edit", edits: [{ path: "/channels/AU12/keys/1", value: [0.2, 0.9] }] });
  await settled(page);
  await show("video");
  await page.locator("#export-size").fill("96x96");
  await page.locator("#export-camera").selectOption("");
  await page.locator("#export-start").click();
  await until(page, () => /%/.test(document.querySelector("#export").textContent));
  assert.match(await ask({ type: "render", out: "two.mp4" }), /expected one render at a time, found another that runs/);
  await ended("is ready");
  assert.match(await told(), /script\.mp4 is ready\. The script as it was rendered is beside it, as script\.mp4\.script\.json\./);
  const video = page.locator("#export-result video");
  await video.waitFor();
  await until(page, () => document.querySelector("#export-result video").readyState >= 1);
  assert.equal(await video.evaluate((one) => `${one.videoWidth}x${one.videoHeight}`), "96x96");
  assert.ok(Math.abs((await video.evaluate((one) => one.duration)) - 0.5) < 0.06);
  await shot(page, "making-video");
  const draft = JSON.parse(readFileSync(below("script.mp4.script.json"), "utf8"));
  assert.deepEqual(draft, await scriptOf(page));
  await page.locator("#export-close").click();
  await page.keyboard.press("Control+s");
  await until(page, () => !window.studio.script().dirty);
  execFileSync(program, ["render", below("script.json"), "--size", "96x96", "--quality", "preview", "--quiet", "-o", below("saved.mp4")]);
  assert.equal(hash(below("script.mp4")), hash(below("saved.mp4")));
});

await test("a render that is cancelled leaves nothing behind", async () => {
  await ask({ type: "edit", edits: [{ path: "/duration_s", value: 20 }] });
  const before = files();
  await show("video");
  await page.locator("#export-out").fill("long.mp4");
  await page.locator("#export-start").click();
  await until(page, () => document.querySelector("#export-progress").value > 0 && /rendering/.test(document.querySelector("#export-left").textContent));
  assert.ok(files().includes("long.mp4.script.json"), "the draft is what runs");
  await shot(page, "making-progress");
  await page.locator("#export-cancel").click();
  await ended("Cancelled");
  assert.equal(await page.locator("#export").textContent(), "Render");
  assert.deepEqual(files(), before);
});

await test("what cannot be rendered is said, and the program goes on", async () => {
  await page.locator("#export-out").fill("small.mp4");
  await page.locator("#export-size").fill("1x1");
  await page.locator("#export-start").click();
  await ended("expected");
  assert.match(await told(), /size.*expected/);
  assert.ok(!existsSync(below("small.mp4")) && !existsSync(below("small.mp4.script.json")));
  await page.keyboard.press("Escape");
  await ask({ type: "undo" });
});

await test("blend shapes are made with progress, and cancelled", async () => {
  mkdirSync(below("old"));
  writeFileSync(below("old/kept.txt"), "mine");
  const before = files();
  await show("shapes");
  assert.equal(await page.locator("#export-out").inputValue(), "shapes");
  assert.ok(!(await page.locator("#export-size").isVisible()));
  await page.locator("#export-set").selectOption("visemes");
  await page.locator("#export-start").click();
  await until(page, () => document.querySelector("#export-progress").value > 0.02);
  await shot(page, "making-shapes");
  await page.locator("#export-cancel").click();
  await ended("Cancelled");
  assert.deepEqual(files(), before);
  await page.locator("#export-out").fill("old");
  await page.locator("#export-start").click();
  await ended("exists already");
  assert.equal(readFileSync(below("old/kept.txt"), "utf8"), "mine");
});

await test("axe finds nothing to complain of, and it works on a phone", async () => {
  const axe = readFileSync(join(process.argv[3], "axe-core/axe.min.js"), "utf8");
  await page.evaluate(axe);
  const found = await page.evaluate(async () => (await window.axe.run("#export-dialog")).violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`));
  assert.deepEqual(found, []);
  await page.setViewportSize({ width: 390, height: 780 });
  await show("video");
  await shot(page, "making-phone");
  const wide = await page.evaluate(() => [document.querySelector("#export-dialog").scrollWidth, document.documentElement.scrollWidth]);
  assert.ok(wide.every((one) => one <= 390), `${wide}`);
  await page.keyboard.press("Escape");
  await shot(page, "making-phone-header");
});

// The program is killed, which it cannot notice: what it has started must not go on.
await test("a render ends with the program", async () => {
  await page.setViewportSize({ width: 1200, height: 800 });
  await ask({ type: "edit", edits: [{ path: "/duration_s", value: 30 }] });
  await page.evaluate(() => void window.studio.ask({ type: "render", out: "late.mp4" }));
  await until(page, () => /%/.test(document.querySelector("#export").textContent));
  const children = () => execFileSync("sh", ["-c", `pgrep -f -- '--out ${folder}/late[.]mp4' || true`], { encoding: "utf8" }).trim();
  assert.match(children(), /^\d+$/);
  const { stop } = await import("./harness.mjs");
  await stop("SIGKILL");
  for (let i = 0; i < 100 && children() !== ""; i++) await new Promise((resolve) => setTimeout(resolve, 100));
  assert.equal(children(), "");
  assert.ok(!existsSync(below("late.mp4")));
  await page.close();
  await start();
});

await end();
