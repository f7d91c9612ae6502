// SPDX-License-Identifier: MIT
// What `risorius view` opens besides a script, in Debian's Chromium: a soft body of the thesis, a mesh, nothing, and what is dropped.
//
//   node opening.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { copyFileSync, existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

import { end, folder, open, packages, scriptOf, shot, source, startWith, stop, test, until } from "./harness.mjs";

const mesh = join(source, "models/adult/head.obj");
copyFileSync(mesh, join(folder, "anna.obj"));
const anyPort = ["--port", "0"];
const axe = async (page, where) => {
  await page.evaluate(readFileSync(join(packages, "axe-core/axe.min.js"), "utf8"));
  assert.deepEqual(await page.evaluate(async (one) => (await window.axe.run(one)).violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`), where), []);
};

let page = await open(await startWith([join(source, "samples/figures/8e"), ...anyPort]));

await test("the cube of figure 8e hangs and is pulled", async () => {
  assert.match(await page.locator("#file-name").textContent(), /^Incompressible cube/);
  for (const id of ["channels", "save", "record-take"]) assert.ok(!(await page.locator(`#${id}`).isVisible()), id);
  const lowest = () => page.evaluate(() => Math.min(...window.studio.pose().vertices.filter((_, i) => i % 3 === 1)) * window.studio.scene().unit_m);
  await until(page, () => window.studio.state().t_s > 0.4);
  assert.ok((await lowest()) < -0.08, `${await lowest()} m, at rest -0.075`);
  const box = await page.locator("#stage").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2 + 20];
  await page.mouse.move(x, y);
  await page.keyboard.down("Control");
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 20, { steps: 6 });
  await until(page, () => (window.studio.state().pulls[0]?.moved_mm ?? 0) > 100);
  const [pull] = await page.evaluate(() => window.studio.state().pulls);
  assert.ok(pull.force_n > 1, `${pull.force_n} N`);
  assert.match(await page.locator(".pull-label").textContent(), /^\d+\.\d\d N {3}\d+\.\d mm$/);
  await shot(page, "body");
  await page.mouse.up();
  await page.keyboard.up("Control");
  await until(page, () => window.studio.state().pulls.length === 0);
});

await test("it pauses, begins again, and says what it cannot do", async () => {
  await page.locator("#play").click();
  await until(page, () => !window.studio.state().playing);
  await page.locator("#to-start").click();
  await until(page, () => window.studio.state().t_s === 0);
  await page.locator("#play").click();
  await until(page, () => window.studio.state().t_s > 0.1);
  assert.match(await page.evaluate(() => window.studio.ask({ type: "override", channel: "AU12", value: 1 })), /what can be done with a soft body/);
  await axe(page, "body");
});

await test("on a phone the body has the whole width", async () => {
  await page.setViewportSize({ width: 390, height: 780 });
  const stage = await page.locator("#stage").boundingBox();
  assert.ok(stage.width > 380 && stage.height > 500, `${stage.width} x ${stage.height}`);
  assert.ok(await page.locator("#play").isVisible());
  assert.deepEqual(await page.locator("#sight option:not([hidden])").allTextContents(), ["skin", "wire"]);
  await page.setViewportSize({ width: 900, height: 620 });
});

await test("of a mesh, the page for a new head is shown", async () => {
  await page.close();
  await stop();
  page = await open(await startWith([join(folder, "anna.obj"), ...anyPort]));
  await until(page, () => window.studio.newHead().vertices?.length > 1000);
  assert.ok(await page.locator("#newhead").isVisible());
  assert.equal(await page.locator("#newhead-mesh").inputValue(), "anna.obj");
});

await test("without a file, the samples are shown, and one is opened", async () => {
  await page.close();
  await stop();
  page = await open(await startWith(anyPort));
  await page.locator("#open-dialog").waitFor({ state: "visible" });
  await axe(page, "#open-dialog");
  await page.locator("#open-dialog button", { hasText: "Cancel" }).click();
  await page.keyboard.press("Control+s");
  await page.locator("#save-name").fill("mine.json");
  await page.keyboard.press("Enter");
  await until(page, () => document.querySelector("#file-name").textContent === "mine.json");
  assert.equal(JSON.parse(readFileSync(join(folder, "mine.json"), "utf8")).format, "risorius-script");
  await page.locator("#open").click();
  await page.locator("#open-dialog").waitFor({ state: "visible" });
  await page.locator("#samples button", { hasText: "smile" }).click();
  await until(page, () => window.studio.script().script.events?.[0]?.expression === "happiness");
  assert.ok(!(await page.locator("#open-dialog").isVisible()));
});

/// Drops files as a desktop does.
const drop = async (files) => {
  const data = await page.evaluateHandle((all) => {
    const transfer = new DataTransfer();
    for (const { name, text } of all) transfer.items.add(new File([text], name));
    return transfer;
  }, files);
  for (const type of ["dragenter", "dragover"]) await page.dispatchEvent("body", type, { dataTransfer: data });
  assert.ok(await page.locator("#drop").isVisible());
  await page.dispatchEvent("body", "drop", { dataTransfer: data });
  assert.ok(!(await page.locator("#drop").isVisible()));
};
const dropped = { format: "risorius-script", version: 1, rig: join(source, "rigs/adult/rig.json"), duration_s: 0.7, channels: { AU2: { keys: [[0, 0], [0.3, 0.4]] } } };

await test("a script that is dropped is opened, and replaced only after a question", async () => {
  await drop([{ name: "dropped.json", text: JSON.stringify(dropped) }]);
  await until(page, () => document.querySelector("#file-name").textContent === "dropped.json" && window.studio.script().duration_s === 0.7);
  assert.deepEqual(await scriptOf(page), dropped);
  const longer = { ...dropped, duration_s: 0.9 };
  let asked = "";
  page.once("dialog", (dialog) => (asked = dialog.message()));
  await drop([{ name: "dropped.json", text: JSON.stringify(longer) }]);
  await until(page, () => window.studio.script().duration_s === 0.9);
  assert.equal(asked, "dropped.json exists already. Replace it?");
  assert.deepEqual(JSON.parse(readFileSync(join(folder, "dropped.json"), "utf8")), longer);
});

await test("what cannot be read is said, and the open script stays", async () => {
  await drop([{ name: "wrong.json", text: '{"format": "risorius-script", "version": 1, "rig": "nobody.json", "duration_s": 1}' }]);
  await until(page, () => /nobody\.json/.test(document.querySelector("#message").textContent));
  await drop([{ name: "notes.txt", text: "hello" }]);
  await until(page, () => /expected a script, a rig, a mesh or a picture, without folders, found "notes\.txt"/.test(document.querySelector("#message").textContent));
  assert.ok(!existsSync(join(folder, "notes.txt")));
  assert.equal(await page.locator("#file-name").textContent(), "dropped.json");
  for (const [message, wrong] of [
    [{ name: "../over.json", bytes: 3 }, /without folders/],
    [{ name: ".hidden.json", bytes: 3 }, /without folders/],
    [{ name: "huge.obj", bytes: 2e9 }, /\/bytes: expected an integer in \[1, 200000000\]/],
  ])
    assert.match(await page.evaluate((one) => window.studio.ask({ type: "drop", ...one }), message), wrong);
  // A piece that nobody announced
  await page.evaluate(() => window.studio.sendBytes(new Uint8Array([2, 0, 0, 0, 0, 0, 0, 0, 65]).buffer));
  await until(page, () => /piece of a file: expected a file that has begun/.test(document.querySelector("#message").textContent));
});

await test("a mesh that is dropped becomes a new head", async () => {
  await drop([{ name: "bella.obj", text: readFileSync(mesh, "utf8") }]);
  await until(page, () => window.studio.newHead().vertices?.length > 1000);
  assert.equal(await page.locator("#newhead-mesh").inputValue(), "bella.obj");
  assert.equal(readFileSync(join(folder, "bella.obj"), "utf8"), readFileSync(mesh, "utf8"));
  // It has been read; the person may still replace it.
  const smaller = "# smaller\n" + readFileSync(mesh, "utf8");
  await drop([{ name: "bella.obj", text: smaller }]);
  for (let left = 40; left > 0 && readFileSync(join(folder, "bella.obj"), "utf8") !== smaller; left--) await page.waitForTimeout(200);
  assert.equal(readFileSync(join(folder, "bella.obj"), "utf8"), smaller);
  assert.deepEqual(readdirSync(folder).filter((name) => name.startsWith(".")), []);
});

await end();
