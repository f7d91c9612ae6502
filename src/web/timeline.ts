// SPDX-License-Identifier: MIT
/// \file
/// The timeline: a row per channel with its curve and its keys, events as blocks, recorded pulls, and the playhead. Keys are buttons,
/// so that keyboard and screen reader reach them; curves are drawn from samples of the simulation's own curves.

import { clamp, h, shown } from "./dom.js";
import { copiedKeys, mirroredCopy, mirroredKeys, movedKeys, nameOf, pastedKeys, placeOf, readCopiedKeys, removedKeys } from "./key_edits.js";
import type { CopiedKeys, Edit, KeyEdits } from "./key_edits.js";
import { drawCurve, drawRuler, drawSpeech } from "./timeline_canvas.js";
import type { Speech } from "./timeline_canvas.js";
import type { Channel, DocumentMessage, Key, Script, ScriptEvent, State } from "./protocol.js";

export interface TimelineActions {
  edit(edits: Edit[], gesture?: string): void;
  seek(t_s: number): void;
  say(text: string): void;
  tell(text: string): void; ///< so that it is not overlooked
}

interface KeyView {
  channel: string;
  index: number;
  element: HTMLButtonElement;
}

const rowHeight = 44;
const margin = 12; ///< px beside the first and the last moment
const held_ms = 600; ///< presses that follow one another within this are one step of undo
const inset = 7; ///< px between a curve and the border of its row

export class Timeline {
  private document: DocumentMessage | null = null;
  private channels = new Map<string, Channel>();
  private keys: KeyView[] = [];
  private selected = new Set<string>(); ///< "AU12 3"
  private span_s = 4; ///< what the width shows
  private from_s = 0;
  private t_s = 0;
  private computed_s = 0;
  private gestures = 0;
  private speech: Speech | null = null;
  snapKeys = true;
  private readonly ruler = h("canvas", { class: "ruler", "aria-hidden": true });
  private readonly lanes = h("div", { class: "lanes" });
  private readonly names = h("div", { class: "lane-names", "aria-hidden": true });
  private readonly playhead = h("div", { class: "playhead", "aria-hidden": true });
  private readonly scroller = h("div", { class: "lane-scroller" });
  private readonly empty = h("p", { class: "empty" }, "No keys yet. Move a slider, then press K to make a key at the playhead.");
  private readonly inspector = h("div", { class: "inspector", role: "group", "aria-label": "Selected key" });
  private readonly time = h("input", { type: "number", step: "any", min: 0, "aria-label": "Time of the key, s" });
  private readonly value = h("input", { type: "number", step: "any", "aria-label": "Value of the key" });
  private readonly box = h("div", { class: "box", hidden: true });

  constructor(
    place: HTMLElement,
    private readonly actions: TimelineActions,
  ) {
    this.inspector.append(
      h("label", {}, "Key at ", this.time, " s"),
      h("label", {}, "Value ", this.value),
      h("button", { class: "quiet", title: "The other side does the same (M)", onclick: () => this.mirror() }, "Mirror"),
      h("button", { class: "quiet", title: "Copy (Ctrl+C); paste at the playhead with Ctrl+V, mirrored with Ctrl+Shift+V", onclick: () => this.copy() }, "Copy"),
      h("button", { class: "quiet", title: "Paste at the playhead (Ctrl+V)", onclick: () => this.paste(null, false) }, "Paste"),
      h("button", { class: "quiet", title: "Delete", onclick: () => this.remove() }, "Delete"),
    );
    this.inspector.hidden = true;
    this.time.addEventListener("change", () => this.put(Number(this.time.value), null));
    this.value.addEventListener("change", () => this.put(null, Number(this.value.value)));
    this.lanes.append(this.box, this.playhead);
    this.scroller.append(this.names, this.lanes, this.empty);
    place.append(h("div", { class: "ruler-line" }, h("div", { class: "corner busy", id: "busy", role: "status" }), this.ruler), this.scroller);
    place.querySelector(".transport")!.append(this.inspector);
    this.listen();
    new ResizeObserver(() => this.layout()).observe(this.scroller);
  }

  useChannels(channels: Channel[]): void {
    this.channels = new Map(channels.map((c) => [c.name, c]));
  }

  useDocument(message: DocumentMessage): void {
    const first = this.document === null || this.document.duration_s !== message.duration_s;
    this.document = message;
    if (first) {
      this.from_s = 0;
      this.span_s = message.duration_s;
    }
    if (!this.dragging) this.build();
    else this.layout();
  }

  /// What the script says; null: nothing.
  useSpeech(speech: Speech | null): void {
    this.speech = speech;
    if (this.document && !this.dragging) this.build();
  }

  useState(state: State): void {
    this.t_s = state.t_s;
    if (state.computed_s !== this.computed_s) {
      this.computed_s = state.computed_s;
      this.drawRuler();
    }
    this.placePlayhead();
  }

  private dragging = false;

  private range(channel: string): [number, number] {
    const known = this.channels.get(channel) ?? this.channels.get(channel.replace(/\.[lr]$/, ""));
    return known ? [known.min, known.max] : [0, 1];
  }

  private label(channel: string): string {
    const known = this.channels.get(channel) ?? this.channels.get(channel.replace(/\.[lr]$/, ""));
    const side = channel.endsWith(".l") ? ", left" : channel.endsWith(".r") ? ", right" : "";
    return (known ? known.label : channel) + side;
  }

  private x(t_s: number): number {
    return margin + ((t_s - this.from_s) / this.span_s) * this.width;
  }
  private t(x: number): number {
    return this.from_s + ((x - margin) / this.width) * this.span_s;
  }
  private get width(): number {
    return Math.max(1, this.lanes.clientWidth - 2 * margin);
  }

  private get script(): Script {
    return this.document!.script;
  }

  // Building

  private build(): void {
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.key : undefined;
    this.keys = [];
    this.names.replaceChildren();
    this.lanes.replaceChildren(this.box, this.playhead);
    const tracks = Object.entries(this.script.channels ?? {});
    if (this.speech) this.addRow("Sound", "", "sound", {}, `Sound: ${this.speech.words.map((word) => word[0]).join(" ")}`);
    for (const [channel, track] of tracks) {
      this.names.append(
        h(
          "div",
          { class: "lane-name", title: channel },
          h("span", {}, this.label(channel).replace(/, (left|right)$/, "")),
          h("b", {}, channel.endsWith(".l") ? "L" : channel.endsWith(".r") ? "R" : ""),
          h("button", { class: "remove", title: "Remove the channel from the script", "aria-label": `Remove ${this.label(channel)}`, onclick: () => this.actions.edit([{ path: `/channels/${channel}` }]) }, "×"),
        ),
      );
      const lane = h("div", { class: "lane", role: "group", "aria-label": this.label(channel), "data-channel": channel });
      lane.append(h("canvas", { "aria-hidden": true }));
      track.keys.forEach((key, index) => lane.append(this.keyButton(channel, index, key)));
      this.lanes.append(lane);
    }
    const recorded = Object.keys(this.document!.recorded ?? {});
    for (const muscle of recorded)
      this.addRow(`EMG ${this.label(muscle).replace(/, (left|right)$/, "").toLowerCase()}`, muscle, "recorded", { "data-recorded": muscle }, `Recorded activity of ${this.label(muscle)}`);
    const events = this.script.events ?? [];
    if (events.length > 0) {
      this.names.append(h("div", { class: "lane-name" }, h("span", {}, "Events")));
      const lane = h("div", { class: "lane events", role: "group", "aria-label": "Events" });
      events.forEach((event, index) => lane.append(this.eventButton(event, index)));
      this.lanes.append(lane);
    }
    const pulls = this.script.pulls ?? [];
    if (pulls.length > 0) {
      this.names.append(h("div", { class: "lane-name" }, h("span", {}, "Pulls")));
      const lane = h("div", { class: "lane events", role: "group", "aria-label": "Pulls" });
      pulls.forEach((pull, index) => {
        const [from, to] = [pull.keys_mm[0][0], pull.keys_mm[pull.keys_mm.length - 1][0]];
        const text = `vertex ${pull.vertex}`;
        lane.append(this.block(text, `Pull of ${text}, ${shown(from)} to ${shown(to)} s. Delete removes it.`, from, to, "pull", `/pulls/${index}`, null));
      });
      this.lanes.append(lane);
    }
    this.empty.hidden = tracks.length + events.length + pulls.length + recorded.length > 0 || this.speech !== null;
    this.layout();
    this.showSelection();
    if (focused) this.lanes.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }

  /// A row that is only looked at.
  private addRow(name: string, channel: string, kind: string, attributes: Record<string, string>, label: string): void {
    const side = channel.endsWith(".l") ? "L" : channel.endsWith(".r") ? "R" : "";
    this.names.append(h("div", { class: `lane-name ${kind}`, title: label }, h("span", {}, name), h("b", {}, side)));
    this.lanes.append(h("div", { class: `lane ${kind}`, role: "img", "aria-label": label, ...attributes }, h("canvas", { "aria-hidden": true })));
  }

  private keyButton(channel: string, index: number, key: Key): HTMLButtonElement {
    const element = h("button", {
      class: "key-dot",
      "data-key": `${channel} ${index}`,
      "aria-label": `${this.label(channel)}, key at ${shown(key[0], 3)} s, value ${shown(key[1], 3)}`,
    });
    this.keys.push({ channel, index, element });
    element.addEventListener("pointerdown", (event) => this.dragKey(event, channel, index));
    element.addEventListener("keydown", (event) => this.keyKey(event, channel, index));
    element.addEventListener("focus", () => this.select([`${channel} ${index}`], false));
    return element;
  }

  private eventButton(event: ScriptEvent, index: number): HTMLElement {
    const from = Number(event.start_s ?? 0);
    const kind = event.expression !== undefined ? "expression" : event.blink !== undefined ? "blink" : event.say !== undefined ? "say" : "idle";
    const text = kind === "expression" ? String(event.expression).replaceAll("_", " ") : kind;
    const seconds = (key: string, otherwise: number) => (typeof event[key] === "number" ? (event[key] as number) : otherwise);
    const length = kind === "expression" ? seconds("onset_s", 0.5) + seconds("hold_s", 1) + seconds("offset_s", 0.8) : kind === "blink" ? 0.22 : this.document!.duration_s - from;
    return this.block(text, `${text}, from ${shown(from)} s. Arrows move it, Delete removes it.`, from, from + length, kind, `/events/${index}`, event);
  }

  private block(text: string, label: string, from_s: number, to_s: number, kind: string, path: string, event: ScriptEvent | null): HTMLElement {
    const element = h("button", { class: `block ${kind}`, "data-from": from_s, "data-to": to_s, "data-key": path, "aria-label": label, title: text }, text);
    const move = (start: number, gesture?: string) => {
      if (event) this.actions.edit([{ path: `${path}/start_s`, value: this.snapped(clamp(start, 0, this.document!.duration_s)) }], gesture);
    };
    element.addEventListener("keydown", (e) => {
      const step = e.key === "ArrowLeft" ? -1 : e.key === "ArrowRight" ? 1 : 0;
      if (e.key === "Delete" || e.key === "Backspace") this.actions.edit([{ path }]);
      else if (step !== 0) move(from_s + step / this.rate);
      else return;
      e.preventDefault();
      e.stopPropagation();
    });
    element.addEventListener("pointerdown", (down) => {
      if (!event || down.button !== 0) return;
      element.setPointerCapture(down.pointerId);
      const gesture = `event ${++this.gestures}`;
      this.dragging = true;
      const slide = (e: PointerEvent) => {
        const start = this.snapped(clamp(from_s + (e.clientX - down.clientX) * (this.span_s / this.width), 0, this.document!.duration_s));
        element.style.left = `${this.x(start)}px`;
        move(start, gesture);
      };
      element.addEventListener("pointermove", slide);
      element.addEventListener("pointerup", () => {
        element.removeEventListener("pointermove", slide);
        this.dragging = false;
        this.build();
      }, { once: true });
    });
    return element;
  }

  // Where things are

  private layout(): void {
    if (!this.document) return;
    for (const { channel, index, element } of this.keys) {
      const key = this.script.channels?.[channel]?.keys[index];
      if (!key) continue;
      element.style.left = `${this.x(key[0])}px`;
      element.style.top = `${this.y(channel, key[1])}px`;
    }
    for (const block of this.lanes.querySelectorAll<HTMLElement>(".block")) {
      const from = Number(block.dataset.from);
      block.style.left = `${this.x(from)}px`;
      block.style.width = `${Math.max(10, this.x(Number(block.dataset.to)) - this.x(from))}px`;
    }
    for (const lane of this.lanes.querySelectorAll<HTMLElement>(".lane:has(canvas)")) this.drawRow(lane);
    this.drawRuler();
    this.placePlayhead();
  }

  private y(channel: string, value: number): number {
    const [min, max] = this.range(channel);
    return inset + (1 - (value - min) / (max - min)) * (rowHeight - 2 * inset);
  }

  private drawRow(lane: HTMLElement): void {
    const canvas = lane.querySelector("canvas")!;
    const { duration_s, curves, recorded } = this.document!;
    const x = (t_s: number) => this.x(t_s);
    if (lane.dataset.channel !== undefined) {
      const channel = lane.dataset.channel;
      const [min, max] = this.range(channel);
      drawCurve(canvas, curves[channel], duration_s, x, (value) => this.y(channel, value), clamp(0, min, max), "127, 182, 245");
    } else if (lane.dataset.recorded !== undefined) {
      const samples = recorded?.[lane.dataset.recorded];
      const height = lane.clientHeight - 6;
      drawCurve(canvas, samples, duration_s, x, (value) => 3 + (1 - clamp(value, 0, 1)) * height, 0, "87, 199, 133");
    } else if (this.speech) {
      drawSpeech(canvas, this.speech, x, (px) => this.t(px));
    }
  }

  private drawRuler(): void {
    if (!this.document) return;
    drawRuler(this.ruler, (t_s) => this.x(t_s), this.width / this.span_s, this.document.duration_s, this.computed_s);
  }

  private placePlayhead(): void {
    this.playhead.style.transform = `translateX(${this.x(this.t_s)}px)`;
  }

  // Editing

  private get rate(): number {
    return this.script.fps ?? 60;
  }

  private snapped(t_s: number): number {
    const t = this.snapKeys ? Math.round(t_s * this.rate) / this.rate : t_s;
    return Math.round(t * 1e4) / 1e4;
  }

  private select(names: string[], add: boolean): void {
    if (!add) this.selected.clear();
    for (const name of names) this.selected.add(name);
    this.showSelection();
  }

  private showSelection(): void {
    for (const { channel, index, element } of this.keys)
      element.setAttribute("aria-pressed", String(this.selected.has(`${channel} ${index}`)));
    const one = this.selected.size === 1 ? this.keyNamed([...this.selected][0]) : null;
    this.inspector.hidden = this.selected.size === 0;
    this.time.disabled = this.value.disabled = one === null;
    if (one && document.activeElement !== this.time) this.time.value = shown(one.key[0], 4);
    if (one && document.activeElement !== this.value) this.value.value = shown(one.key[1], 4);
  }

  private keyNamed(name: string): { channel: string; index: number; key: Key } | null {
    const place = placeOf(name);
    const key = this.script.channels?.[place.channel]?.keys[place.index];
    return key ? { ...place, key } : null;
  }

  /// Moves keys by a time and a part of their range.
  private moved(names: string[], by_s: number, byPart: number, from: Script): Edit[] {
    const move = { by_s, byPart, snapped: (t_s: number) => this.snapped(t_s), range: (channel: string) => this.range(channel) };
    return movedKeys(names.map(placeOf), from, move);
  }

  private dragKey(down: PointerEvent, channel: string, index: number): void {
    if (down.button !== 0) return;
    const name = `${channel} ${index}`;
    const element = down.currentTarget as HTMLElement;
    if (!this.selected.has(name)) this.select([name], down.shiftKey);
    const names = [...this.selected];
    const from: Script = JSON.parse(JSON.stringify(this.script));
    const gesture = `key ${++this.gestures}`;
    element.setPointerCapture(down.pointerId);
    this.dragging = true;
    const slide = (event: PointerEvent) => {
      const x = event.clientX - down.clientX;
      const y = event.clientY - down.clientY;
      if (Math.hypot(x, y) < 3) return;
      // With Shift, the larger direction alone
      const alone = event.shiftKey ? (Math.abs(x) > Math.abs(y) ? "x" : "y") : "";
      const edits = this.moved(
        names,
        alone === "y" ? 0 : (x / this.width) * this.span_s,
        alone === "x" || Math.abs(y) < 3 ? 0 : -y / (rowHeight - 2 * inset),
        from,
      );
      if (edits.length > 0) this.actions.edit(edits, gesture);
    };
    element.addEventListener("pointermove", slide);
    const end = () => {
      element.removeEventListener("pointermove", slide);
      this.dragging = false;
      this.build();
    };
    element.addEventListener("pointerup", end, { once: true });
  }

  private pressed: { names: string[]; from: Script; by_s: number; byPart: number; until_ms: number; gesture: string } | null = null;

  private keyKey(event: KeyboardEvent, channel: string, index: number): void {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 0.01], ArrowDown: [0, -0.01] };
    const step = steps[event.key];
    if (step) {
      const scale = event.shiftKey ? 10 : 1;
      const names = [...new Set([...this.selected, `${channel} ${index}`])];
      const now = performance.now();
      // A key that is held: moved on from where the keys were at its first press, because the engine has not answered yet.
      if (!this.pressed || now > this.pressed.until_ms || this.pressed.names.join() !== names.join())
        this.pressed = { names, from: this.script, by_s: 0, byPart: 0, until_ms: 0, gesture: `press ${++this.gestures}` };
      this.pressed.until_ms = now + held_ms;
      this.pressed.by_s += (scale * step[0]) / this.rate;
      this.pressed.byPart += scale * step[1];
      this.actions.edit(this.moved(names, this.pressed.by_s, this.pressed.byPart, this.pressed.from), this.pressed.gesture);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      this.remove();
    } else if (event.key === "Enter") {
      this.value.focus();
      this.value.select();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  private put(t_s: number | null, value: number | null): void {
    const one = this.selected.size === 1 ? this.keyNamed([...this.selected][0]) : null;
    if (!one) return;
    const keys = this.script.channels![one.channel].keys.map((key) => [...key] as Key);
    keys[one.index] = [t_s ?? one.key[0], value ?? one.key[1]];
    this.actions.edit([{ path: `/channels/${one.channel}/keys`, value: keys }]);
  }

  remove(): void {
    const edits = removedKeys(this.places, this.script);
    this.selected.clear();
    if (edits.length > 0) this.actions.edit(edits);
  }

  // Copies

  private copied: CopiedKeys | null = null;

  private get places() {
    return [...this.selected].map(placeOf);
  }

  /// The selected keys as a text for the clipboard, or null.
  copy(): string | null {
    const copied = this.document && copiedKeys(this.places, this.script);
    if (!copied) return null;
    this.copied = copied;
    this.actions.say(`${this.selected.size === 1 ? "1 key" : `${this.selected.size} keys`} copied`);
    return JSON.stringify(copied);
  }

  /// Puts keys at the playhead; `text` is what the clipboard has. False: those are no keys.
  paste(text: string | null, mirrored: boolean): boolean {
    const copied = text === null ? this.copied : readCopiedKeys(text);
    if (!copied || !this.document) return false;
    const known = (name: string) => this.channels.has(name);
    this.putAll(pastedKeys(mirrored ? mirroredCopy(copied, known) : copied, this.script, this.snapped(this.t_s)), "pasted");
    return true;
  }

  /// Lets the other side do what the selected keys do.
  mirror(): void {
    if (this.selected.size === 0) return;
    const made = mirroredKeys(this.places, this.script, (name) => this.channels.has(name));
    if (made.put.length === 0) this.actions.tell("These channels move both sides alike: there is no other side to put the keys on.");
    else this.putAll(made, "put on the other side");
  }

  private putAll(made: KeyEdits, done: string): void {
    if (made.late > 0) this.actions.tell(`${made.late === 1 ? "One key lies" : `${made.late} keys lie`} after the end of the script and ${made.late === 1 ? "was" : "were"} left out.`);
    if (made.put.length === 0) return;
    this.selected = new Set(made.put.map(nameOf));
    this.actions.edit(made.edits);
    this.actions.say(`${made.put.length === 1 ? "1 key" : `${made.put.length} keys`} ${done}`);
  }

  selectAll(): void {
    this.select(this.keys.map(nameOf), false);
  }

  get hasSelection(): boolean {
    return this.selected.size > 0;
  }

  private listen(): void {
    let seeking = false;
    const seekTo = (event: PointerEvent) => {
      const x = event.clientX - this.lanes.getBoundingClientRect().left;
      this.actions.seek(clamp(Math.round(this.t(x) * 60) / 60, 0, this.document?.duration_s ?? 0));
    };
    this.ruler.addEventListener("pointerdown", (event) => {
      seeking = true;
      this.ruler.setPointerCapture(event.pointerId);
      seekTo(event);
    });
    this.ruler.addEventListener("pointermove", (event) => seeking && seekTo(event));
    this.ruler.addEventListener("pointerup", () => (seeking = false));
    this.lanes.addEventListener("dblclick", (event) => this.addKey(event));
    this.lanes.addEventListener("pointerdown", (event) => this.drawBox(event));
    this.scroller.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey || !this.document) return;
        event.preventDefault();
        const at = this.t(event.clientX - this.lanes.getBoundingClientRect().left);
        const whole = this.document.duration_s;
        const span = clamp(this.span_s * (event.deltaY > 0 ? 1.2 : 1 / 1.2), 0.1, whole);
        this.from_s = clamp(at - ((at - this.from_s) * span) / this.span_s, 0, whole - span);
        this.span_s = span;
        this.layout();
      },
      { passive: false },
    );
  }

  private addKey(event: MouseEvent): void {
    const lane = (event.target as HTMLElement).closest<HTMLElement>(".lane[data-channel]");
    if (!lane || (event.target as HTMLElement).closest("button")) return;
    const channel = lane.dataset.channel!;
    const box = lane.getBoundingClientRect();
    const [min, max] = this.range(channel);
    const part = 1 - (event.clientY - box.top - inset) / (rowHeight - 2 * inset);
    const key: Key = [this.snapped(this.t(event.clientX - box.left)), Math.round((min + clamp(part, 0, 1) * (max - min)) * 1000) / 1000];
    const keys = this.script.channels![channel].keys.filter((one) => Math.abs(one[0] - key[0]) > 1e-3);
    keys.push(key);
    keys.sort((a, b) => a[0] - b[0]);
    this.actions.edit([{ path: `/channels/${channel}/keys`, value: keys }]);
  }

  private drawBox(down: PointerEvent): void {
    if (down.button !== 0 || (down.target as HTMLElement).closest("button")) return;
    const origin = this.lanes.getBoundingClientRect();
    this.lanes.setPointerCapture(down.pointerId);
    const move = (event: PointerEvent) => {
      const [left, right] = [Math.min(down.clientX, event.clientX), Math.max(down.clientX, event.clientX)];
      const [top, bottom] = [Math.min(down.clientY, event.clientY), Math.max(down.clientY, event.clientY)];
      this.box.hidden = right - left + bottom - top < 6;
      Object.assign(this.box.style, { left: `${left - origin.left}px`, top: `${top - origin.top}px`, width: `${right - left}px`, height: `${bottom - top}px` });
      if (this.box.hidden) return;
      const inside = this.keys.filter(({ element }) => {
        const dot = element.getBoundingClientRect();
        const [x, y] = [dot.left + dot.width / 2, dot.top + dot.height / 2];
        return x >= left && x <= right && y >= top && y <= bottom;
      });
      this.select(inside.map(({ channel, index }) => `${channel} ${index}`), event.shiftKey);
    };
    this.lanes.addEventListener("pointermove", move);
    const end = () => {
      this.lanes.removeEventListener("pointermove", move);
      if (this.box.hidden) this.select([], false);
      this.box.hidden = true;
      if (this.selected.size > 1) this.actions.say(`${this.selected.size} keys selected`);
    };
    this.lanes.addEventListener("pointerup", end, { once: true });
  }
}
