// SPDX-License-Identifier: MIT
// The page in Debian's Chromium, as a person uses it: load, pull and read the force, move sliders and keys, undo, save, lose the
// engine and find it again, a phone, the keyboard alone, and axe. Needs the built page.
//
//   node browser.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";

import { end, folder, open, packages, script, scriptOf, settled, shot, start, state, stop, test, until, vertexAt } from "./harness.mjs";

let url = await start();
let page = await open(url);

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
  // Two values and K within one picture: the key has the last.
  await page.evaluate(() => {
    const row = document.querySelector('[data-channel="AU4"]');
    const number = row.querySelector('input[type="number"]');
    for (const value of ["0.99", "1"]) {
      number.value = value;
      number.dispatchEvent(new Event("input", { bubbles: true }));
      number.dispatchEvent(new Event("change", { bubbles: true }));
    }
    row.querySelector("button.key").click();
  });
  await until(page, () => window.studio.script().script.channels.AU4 !== undefined);
  assert.deepEqual((await scriptOf(page)).channels.AU4, { keys: [[0, 1]] });
  await page.locator("#undo").click();
  await until(page, () => window.studio.script().script.channels.AU4 === undefined);
  // K is no number: in a field of numbers it makes the key of what is typed.
  await row.locator("input[type=number]").fill("0.3");
  await row.locator("input[type=number]").press("k");
  await until(page, () => window.studio.script().script.channels.AU4 !== undefined);
  assert.deepEqual((await scriptOf(page)).channels.AU4, { keys: [[0, 0.3]] });
  await row.locator("input[type=number]").blur();
  await page.locator("#undo").click();
  await until(page, () => window.studio.script().script.channels.AU4 === undefined);
  // Where nothing was moved, it makes a key of what is shown.
  await row.locator("input[type=number]").press("k");
  await until(page, () => window.studio.script().script.channels.AU4 !== undefined);
  assert.deepEqual((await scriptOf(page)).channels.AU4, { keys: [[0, 0]] });
  await row.locator("input[type=number]").blur();
  await page.locator("#undo").click();
  await until(page, () => window.studio.script().script.channels.AU4 === undefined);
  assert.deepEqual(await scriptOf(page), before);
});

await test("a smile is found by its word, and the tools stay where they are under any name", async () => {
  await page.keyboard.press("/");
  await page.keyboard.type("smile");
  assert.ok(await page.locator('#channels [data-channel="AU12"]').isVisible());
  assert.ok(!(await page.locator('#channels [data-channel="AU4"]').isVisible()));
  await page.locator("#channels input[type=search]").fill("");
  const before = await page.locator("#save").boundingBox();
  const was = await page.locator("#file-name").textContent();
  await page.evaluate(() => (document.querySelector("#file-name").textContent = "a long name of a folder/and of a script in it.json"));
  assert.deepEqual(await page.locator("#save").boundingBox(), before);
  await page.evaluate((name) => (document.querySelector("#file-name").textContent = name), was);
});

await test("the sentence below the face is that of the pose", async () => {
  const number = page.locator('.row[data-name="AU2"] input[type=number]');
  for (const value of ["1", "0"]) {
    await number.fill(value);
    await number.press("Enter");
    await until(page, (v) => window.studio.state().overrides.AU2 === v && window.studio.state().resting, Number(value));
    await until(page, (v) => document.querySelector("#twin").textContent.includes("frontalis") === (v === 1), Number(value));
  }
  await page.locator('.row[data-name="AU2"] button.release').click();
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

await test("an edited key is shown", async () => {
  await page.evaluate(() => window.studio.ask({ type: "seek", t_s: 0.2 }));
  await until(page, () => Math.abs(window.studio.state().t_s - 0.2) < 1e-6 && !window.studio.state().computing && Math.abs(window.studio.pose().t_s - 0.2) < 1e-6);
  await page.locator('[data-key="AU12 1"]').focus();
  const first = [];
  const exact = [];
  const edits = 11;
  for (let i = 0; i < edits; i++) {
    await page.evaluate(() => {
      const vertices = () => Float64Array.from(window.studio.pose().vertices, (x) => 1e3 * window.studio.scene().unit_m * x);
      const before = vertices();
      const revision = window.studio.script().revision;
      window.edited = null;
      const began = { ms: 0 };
      document.activeElement.addEventListener("keydown", () => (began.ms = performance.now()), { once: true, capture: true });
      let shown = 0;
      // A frame of the page after a pose in which some vertex has moved by a hundredth of a millimetre
      const look = (now) => {
        if (began.ms && !shown) {
          const there = vertices();
          if (there.some((x, k) => Math.abs(x - before[k]) > 0.01)) shown = now;
        }
        const state = window.studio.state();
        if (shown && window.studio.script().revision > revision && !state.computing && Math.abs(window.studio.pose().t_s - 0.2) < 1e-6) window.edited = { shown: shown - began.ms, exact: now - began.ms };
        else requestAnimationFrame(look);
      };
      requestAnimationFrame(look);
    });
    await page.keyboard.press(i % 2 ? "Shift+ArrowDown" : "Shift+ArrowUp");
    await until(page, () => window.edited);
    const took = await page.evaluate(() => window.edited);
    first.push(took.shown);
    exact.push(took.exact);
    await page.waitForTimeout(300);
  }
  const middle = (all) => all.sort((a, b) => a - b)[(edits - 1) / 2].toFixed(0);
  console.log(`      from the edit to a face that has moved: median ${middle(first)} ms, largest ${Math.max(...first).toFixed(0)} ms; to the face of that moment: ${middle(exact)} and ${Math.max(...exact).toFixed(0)} ms`);
  await page.evaluate(() => document.activeElement.blur());
  for (let i = 0; i < edits; i++) await page.keyboard.press("Control+z");
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
  // What the tests before were told may still be there.
  await page.evaluate(() => (document.querySelector("#message").hidden = true));
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
  await page.locator("#pull-options").focus();
  await page.keyboard.press("Enter");
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
  // A browser ignores a pattern that it cannot read, and then takes every name.
  const fits = (name) =>
    page.evaluate((value) => {
      const field = document.querySelector("#save-name");
      field.value = value;
      return field.validity.valid;
    }, name);
  assert.ok(await fits("mine/wink.json"));
  for (const name of ["/wink.json", "wink.txt"]) assert.ok(!(await fits(name)), name);
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

await end();
