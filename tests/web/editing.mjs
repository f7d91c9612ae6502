// SPDX-License-Identifier: MIT
// Editing in Debian's Chromium: the bar of the stage at every width, names under the pointer, keys copied and mirrored, and nothing lost
// when engine and page are gone.
//
//   node editing.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";

import { end, open, script, scriptOf, settled, shot, start, state, stop, test, until, vertexAt } from "./harness.mjs";

let url = await start();
let page = await open(url, { width: 900, height: 620 });
const keysOf = async (channel) => (await scriptOf(page)).channels?.[channel]?.keys;
const untilKeys = (channel, keys) => until(page, ([c, k]) => JSON.stringify(window.studio.script().script.channels?.[c]?.keys) === k, [channel, JSON.stringify(keys)]);

await test("the bar of the stage is one line at every width, and nothing hangs over", async () => {
  for (const width of [1600, 1280, 1100, 1000, 900, 780, 700, 390]) {
    await page.setViewportSize({ width, height: 760 });
    const found = await page.evaluate(() => {
      const stage = document.querySelector("#stage").getBoundingClientRect();
      const shown = [...document.querySelectorAll(".stage-bar > *, .pull-options > button, #pull-fields > *")].filter((one) => one.matches(":not(.space, .pull-options)") && one.offsetParent !== null);
      const boxes = shown.map((one) => one.getBoundingClientRect());
      const overlaps = boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => a.left < b.right - 0.5 && b.left < a.right - 0.5));
      return { lines: new Set(boxes.map((box) => Math.round((box.top + box.bottom) / 2))).size, overlaps: overlaps.length, over: Math.max(...boxes.map((box) => box.right)) - stage.right, count: boxes.length };
    });
    assert.deepEqual({ ...found, over: found.over < 0 }, { lines: 1, overlaps: 0, over: true, count: found.count }, `${width} px`);
    assert.ok(found.count >= 4, `${width} px: ${found.count} controls`);
    if ([1280, 900, 390].includes(width)) await shot(page, `bar-${width}`);
  }
  await page.setViewportSize({ width: 900, height: 620 });
  assert.ok(!(await page.locator("#stiffness").isVisible()));
  await page.locator("#pull-options").click();
  assert.ok(await page.locator("#stiffness").isVisible());
  await shot(page, "bar-open");
  await page.mouse.click(300, 300);
  assert.ok(!(await page.locator("#stiffness").isVisible()));
  await page.setViewportSize({ width: 900, height: 620 });
});

await test("the pointer names the skin, and says how far it has moved without the head's own motion", async () => {
  const label = page.locator(".hover-label");
  const corner = await vertexAt(page, "ch_l");
  const rest = async () => {
    const at = await page.evaluate((v) => window.studio.screenOf(v), corner);
    await page.mouse.move(at.x + 1, at.y + 1);
    await page.mouse.move(at.x, at.y);
    await until(page, () => /cheilion, left \(ch_l\)/.test(document.querySelector(".hover-label").textContent));
    await page.waitForTimeout(700);
    return Number((await label.textContent()).match(/moved (\d+\.\d) mm/)[1]);
  };
  assert.ok((await rest()) < 0.2);
  for (const [channel, value] of [["head_yaw_deg", 12], ["head_up_mm", 20]]) {
    await page.locator(`.row[data-name="${channel}"] input[type=number]`).evaluate((input, v) => ((input.value = v), input.dispatchEvent(new Event("change"))), value);
    await until(page, ([c, v]) => window.studio.state().overrides[c] === v, [channel, value]);
  }
  await until(page, () => window.studio.state().resting);
  const turned = await rest();
  assert.ok(turned < 1.5, `the head turned by 12 degrees and up by 20 mm: the skin moved ${turned} mm`);
  await page.locator('.row[data-name="AU12"] input[type=number]').fill("1");
  await page.locator('.row[data-name="AU12"] input[type=number]').press("Enter");
  await until(page, () => window.studio.state().overrides.AU12 === 1);
  await page.waitForTimeout(600);
  const smiled = await rest();
  assert.ok(smiled > 4, `a full smile moves its corner by ${smiled} mm`);
  await shot(page, "hover-skin");
  await page.getByText("Release all").click();
  await until(page, () => window.studio.state().resting && Object.keys(window.studio.state().overrides).length === 0);
});

await test("the pointer names muscles, with what they do", async () => {
  await page.locator("#sight").selectOption("muscles");
  const found = await page.waitForFunction(() => {
    const box = document.querySelector("#stage canvas").getBoundingClientRect();
    for (let y = box.top + 60; y < box.bottom; y += 8)
      for (let x = box.left + box.width / 2; x < box.right; x += 8) {
        const found = window.studio.probe({ clientX: x, clientY: y });
        if (found?.muscle === "zygomaticus_major.l") return { x, y };
      }
    return null;
  }, null, { timeout: 60000, polling: 500 });
  const at = await found.jsonValue();
  assert.match(await page.locator("#legend").innerText(), /Point at a muscle: its name, force and length/);
  await page.mouse.move(at.x, at.y);
  await until(page, () => /long$/.test(document.querySelector(".hover-label").textContent));
  const text = await page.locator(".hover-label").innerText();
  assert.match(text, /^zygomaticus major, left\nactivation \d\.\d\d, drive \d\.\d\d\n-?\d+\.\d\d N, \d+\.\d mm long$/);
  const length = Number(text.match(/([\d.]+) mm/)[1]);
  assert.ok(length > 30 && length < 90, `${length} mm`);
  assert.equal(await page.locator('.channel.pointed[data-channel="zygomaticus_major"]').count(), 1);
  await shot(page, "hover-muscle");
  await page.mouse.move(at.x, 4);
  await until(page, () => document.querySelector(".hover-label").hidden && !window.studio.state().selected.channel);
  assert.equal(await page.locator(".channel.pointed").count(), 0);
  await page.locator("#sight").selectOption("skin");
});

await test("keys are copied, pasted at the playhead, and cut", async () => {
  await page.locator('[data-key="AU12 1"]').focus();
  await page.locator('[data-key="AU12 1"]').press("Control+c");
  await page.keyboard.press("Home");
  await until(page, () => window.studio.state().t_s === 0);
  for (let i = 0; i < 6; i++) await page.keyboard.press(".");
  await until(page, () => Math.abs(window.studio.state().t_s - 0.1) < 1e-6);
  await page.keyboard.press("Control+v");
  await untilKeys("AU12", [[0, 0], [0.1, 0.5], [0.2, 0.5], [0.4, 0]]);
  assert.equal(await page.locator('.key-dot[aria-pressed="true"]').getAttribute("data-key"), "AU12 1");
  await page.keyboard.press("Control+x");
  await untilKeys("AU12", script.channels.AU12.keys);
  await page.keyboard.press("Control+z");
  await untilKeys("AU12", [[0, 0], [0.1, 0.5], [0.2, 0.5], [0.4, 0]]);
  await page.keyboard.press("Control+z");
  await untilKeys("AU12", script.channels.AU12.keys);
});

await test("M lets the other side do the same", async () => {
  await page.keyboard.press("Home");
  const left = page.locator('.channel[data-channel="AU2"]');
  await left.locator(".chain").click();
  await page.locator('.row[data-name="AU2.l"] input[type=number]').fill("0.7");
  await page.locator('.row[data-name="AU2.l"] input[type=number]').press("Enter");
  await until(page, () => window.studio.state().overrides["AU2.l"] === 0.7);
  await page.locator('.row[data-name="AU2.l"] button.key').click();
  await untilKeys("AU2.l", [[0, 0.7]]);
  await page.locator('[data-key="AU2.l 0"]').click();
  await page.keyboard.press("m");
  await untilKeys("AU2.r", [[0, 0.7]]);
  await shot(page, "mirrored");
  await page.locator('[data-key="AU12 1"]').click();
  await page.keyboard.press("m");
  await page.locator("#message").waitFor({ state: "visible" });
  assert.match(await page.locator("#message").textContent(), /both sides alike/);
});

await test("a page that is loaded anew shows the script as it was, and asks nothing", async () => {
  const before = await scriptOf(page);
  await page.reload();
  await until(page, () => document.body.dataset.step !== undefined);
  await page.waitForTimeout(500);
  assert.deepEqual(await scriptOf(page), before);
  assert.ok(!(await page.locator("#found").isVisible()));
});

await test("a connection that is cut comes back, with the edits that were made meanwhile", async () => {
  await page.evaluate(() => window.studio.cut(8000));
  await page.locator("#lost").waitFor({ state: "visible" });
  await page.locator('[data-key="jaw_open 1"]').focus();
  await page.keyboard.press("ArrowUp");
  assert.deepEqual(await keysOf("jaw_open"), [[0, 0], [0.3, 0.212]]);
  await page.locator("#lost").waitFor({ state: "hidden" });
  await settled(page);
  assert.deepEqual(await keysOf("jaw_open"), [[0, 0], [0.3, 0.212]]);
  assert.match(await page.locator("#message").textContent(), /has your edits/);
});

await test("engine killed, edits made, page closed: the next page gives everything back", async () => {
  const port = Number(new URL(url).port);
  await stop("SIGKILL");
  await page.locator("#lost").waitFor({ state: "visible" });
  await page.locator('[data-key="AU12 1"]').focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowUp");
  await page.waitForTimeout(700);
  await page.keyboard.press("ArrowUp");
  assert.deepEqual((await keysOf("AU12"))[1], [0.2, 0.56]);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("Control+z");
  const kept = await scriptOf(page);
  assert.deepEqual(kept.channels.AU12.keys[1], [0.2, 0.55]);
  await shot(page, "engine-gone");
  await page.waitForTimeout(400);
  await page.close();
  url = await start(port);
  page = await open(url, { width: 900, height: 620 });
  await page.locator("#found").waitFor({ state: "visible" });
  assert.deepEqual(await scriptOf(page), script);
  await shot(page, "found");
  await page.locator("#restore").click();
  await until(page, (keys) => JSON.stringify(window.studio.script().script.channels.AU12.keys) === keys, JSON.stringify(kept.channels.AU12.keys));
  assert.deepEqual(await scriptOf(page), kept);
  await until(page, () => document.querySelector("#found").hidden);
  await page.keyboard.press("Control+z");
  await settled(page);
  assert.deepEqual(await scriptOf(page), script);
});

await test("saved is saved: then there is nothing to restore", async () => {
  await page.keyboard.press("Control+Shift+z");
  await settled(page);
  await page.keyboard.press("Control+s");
  await until(page, () => document.querySelector("#dirty").hidden);
  await page.waitForTimeout(400);
  await page.close();
  page = await open(url, { width: 900, height: 620 });
  await page.waitForTimeout(600);
  assert.ok(!(await page.locator("#found").isVisible()));
});

await end();
