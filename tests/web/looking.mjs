// SPDX-License-Identifier: MIT
// Looking in Debian's Chromium: the second view, the waveform with its phones, and recorded muscle activity beside the curves.
//
//   node looking.mjs RISORIUS PLAYWRIGHT_FOLDER SOURCE_FOLDER [SCREENSHOT_FOLDER]

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

import { end, folder, open, script, shot, source, start, state, test, until, vertexAt } from "./harness.mjs";

writeFileSync(
  join(folder, "script.json"),
  JSON.stringify({
    ...script,
    duration_s: 4,
    events: [{ say: { utterance: join(source, "samples/talk/english.utterance.json") }, face: false, start_s: 0.4 }],
    emg: { file: join(source, "samples/emg/emg.tsv"), time_column: "time_s", maximum: { ZYG_L: 210 }, channels: { "zygomaticus_major.l": "ZYG_L", corrugator_supercilii: "CORR" } },
  }),
);
const page = await open(await start(), { width: 1000, height: 760 });

/// The pixels of the canvas of a row whose green is above `least`, in a range of times of the script.
const pixels = (row, from_s, to_s) =>
  page.evaluate(
    ([selector, from, to]) => {
      const canvas = document.querySelector(`${selector} canvas`);
      const inner = canvas.clientWidth - 24;
      const x = (t) => Math.round((12 + (t / window.studio.script().duration_s) * inner) * (canvas.width / canvas.clientWidth));
      const [begin, width] = [x(from), Math.max(1, x(to) - x(from))];
      // Without the words above and the phones below
      const [top, height] = [Math.round(canvas.height * 0.22), Math.round(canvas.height * 0.54)];
      const { data } = canvas.getContext("2d").getImageData(begin, top, width, height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200) count++;
      return count / width;
    },
    [row, from_s, to_s],
  );

await test("the timeline shows what is said: words, waveform, phones", async () => {
  await until(page, () => window.studio.said()?.samples && document.querySelector(".lane.sound canvas"));
  const said = await page.evaluate(() => {
    const { phones, words, start_s, samples, rate_hz } = window.studio.said();
    const rms = (from, to) => {
      const part = samples.slice(Math.round((from - start_s) * rate_hz), Math.round((to - start_s) * rate_hz));
      return Math.sqrt(part.reduce((sum, one) => sum + one * one, 0) / part.length);
    };
    const loud = phones.map(([, from, to]) => rms(from, to));
    const loudest = phones[loud.indexOf(Math.max(...loud))];
    return { phones: phones.length, words: words.map((word) => word[0]).join(" "), start_s, loudest, before: phones[0][1] };
  });
  assert.equal(said.start_s, 0.4);
  assert.ok(said.phones > 8 && said.words.split(" ").length > 2, JSON.stringify(said));
  assert.match(await page.locator(".lane.sound").getAttribute("aria-label"), new RegExp(`^Sound: ${said.words.slice(0, 5)}`));
  const [loud, silent] = [await pixels(".lane.sound", said.loudest[1], said.loudest[2]), await pixels(".lane.sound", 0.02, 0.38)];
  assert.ok(loud > 8 && silent === 0, `${loud} pixels high where it is loudest, ${silent} before it begins`);
});

await test("recorded muscles have rows, which are as high as they are active", async () => {
  assert.deepEqual(await page.evaluate(() => Object.keys(window.studio.script().recorded)), ["zygomaticus_major.l", "corrugator_supercilii"]);
  assert.equal(await page.locator(".lane.recorded").count(), 2);
  assert.equal(await page.locator(".lane-name.recorded").first().innerText(), "EMG zygomaticus major\nL");
  const samples = await page.evaluate(() => window.studio.script().recorded["zygomaticus_major.l"]);
  const most = samples.indexOf(Math.max(...samples));
  assert.ok(samples[most] > 0.4 && samples[most] <= 1, `${samples[most]}`);
  await shot(page, "recorded");
});

await test("drawing the playhead lets the sound be heard there", async () => {
  const ruler = await page.locator(".ruler").boundingBox();
  const before = await page.evaluate(() => window.studio.scrubbed());
  await page.mouse.move(ruler.x + 0.3 * ruler.width, ruler.y + 8);
  await page.mouse.down();
  await page.mouse.move(ruler.x + 0.4 * ruler.width, ruler.y + 8, { steps: 4 });
  await page.mouse.up();
  await until(page, (n) => window.studio.scrubbed() > n, before);
});

await test("a second view shows the face from the side, and can be pulled", async () => {
  const corner = await vertexAt(page, "ch_l");
  const before = await page.evaluate((v) => window.studio.screenOf(v), corner);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("v");
  await page.waitForTimeout(600);
  const [first, second, box] = await page.evaluate((v) => [window.studio.screenOf(v), window.studio.screenOf(v, true), document.querySelector("#stage").getBoundingClientRect().toJSON()], corner);
  const middle = box.x + box.width / 2;
  assert.ok(first.x < middle && second.x > middle, `${first.x}, ${second.x}`);
  assert.ok(Math.abs(first.x - before.x) > box.width / 8, "the first view has moved to the left half");
  await shot(page, "second-view");
  // From the left side the front of the face is at the left of its view.
  assert.ok(second.x < middle + box.width / 4);
  await page.mouse.move(second.x + 6, second.y + 2);
  await until(page, () => /\(|left/.test(document.querySelector(".hover-label").textContent));
  await page.keyboard.down("Control");
  await page.mouse.move(second.x, second.y);
  await page.mouse.down();
  await until(page, () => window.studio.state().pulls.length === 1);
  const from = (await state(page)).pulls[0].hand_m;
  await page.mouse.move(second.x - 12, second.y, { steps: 4 });
  await until(page, (z) => window.studio.state().pulls[0].hand_m[2] > z + 2e-3 && window.studio.state().pulls[0].moved_mm > 1, from[2]);
  // To the left in the view from the left is forwards, +z; the hand stays in the plane of that view.
  const by_mm = (await state(page)).pulls[0].hand_m.map((one, k) => 1e3 * (one - from[k]));
  assert.ok(by_mm[2] > 2 && Math.abs(by_mm[0]) < 0.05 && Math.abs(by_mm[1]) < 1, `${by_mm}`);
  await shot(page, "second-pull");
  await page.mouse.up();
  await page.keyboard.up("Control");
  await page.keyboard.press("v");
  await until(page, () => document.querySelector("#second").hidden);
});

await test("the skull shows through the skin, and its mandible opens with the jaw", async () => {
  await page.keyboard.press("Home");
  await page.evaluate(() => window.studio.ask({ type: "override", channel: "jaw_open", value: 0 }));
  await page.locator("#sight").selectOption("skull");
  // On a busy machine the bones take their time.
  await page.waitForFunction(() => window.studio.mandible([0, -0.1, 0.08]) !== null, null, { timeout: 120000 });
  // The chin, and a point near the joints, as the head has them at rest
  const points = () => page.evaluate(() => ["me", "t_l"].map((id) => window.studio.mandible(window.studio.scene().landmarks[id])));
  await until(page, () => window.studio.state().resting);
  await page.waitForTimeout(300);
  const closed = await points();
  await page.evaluate(() => window.studio.ask({ type: "override", channel: "jaw_open", value: 0.8 }));
  await until(page, () => window.studio.state().resting && window.studio.state().overrides.jaw_open === 0.8);
  await page.waitForTimeout(300);
  const open = await points();
  const down_mm = [0, 1].map((i) => 1e3 * (closed[i][1] - open[i][1]));
  assert.ok(down_mm[0] > 12 && down_mm[0] < 60, `the chin goes down by ${down_mm[0]} mm`);
  assert.ok(Math.abs(down_mm[1]) < down_mm[0] / 2, `at the ear it is ${down_mm[1]} mm`);
  await page.waitForTimeout(1500);
  await shot(page, "skull");
  await page.locator("#sight").selectOption("skin");
});

await test("the list of scripts has small pictures, made when it is shown", async () => {
  await page.locator("#open").click();
  // The script of this test and the samples are of one rig, the adult: the first picture takes longest.
  await until(page, () => [...document.querySelectorAll("#scripts img, #samples img")].some((one) => one.naturalWidth === 128));
  await until(page, () => [...document.querySelectorAll("#scripts img")].every((one) => one.naturalWidth === 128));
  await page.waitForFunction(() => document.querySelectorAll("#samples img[src]").length >= 3, null, { timeout: 120000 });
  await shot(page, "thumbnails");
  const pictures = await page.evaluate(() => [...document.querySelectorAll("#samples img[src]")].map((one) => one.src));
  assert.ok(new Set(pictures).size >= 2, "samples look different");
  // Shown again, the pictures are there at once.
  await page.locator("#open-dialog button", { hasText: "Cancel" }).click();
  await page.locator("#open").click();
  await until(page, () => document.querySelectorAll("#scripts img[src], #samples img[src]").length >= 4);
  await page.locator("#open-dialog button", { hasText: "Cancel" }).click();
});

await end();
