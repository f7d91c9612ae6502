// SPDX-License-Identifier: MIT
/// \file
/// The timeline: a row per channel with its curve and its keys, events as blocks, recorded pulls, and the playhead. Keys are buttons,
/// so that keyboard and screen reader reach them; curves are drawn from samples of the simulation's own curves.

import { clamp, h, shown } from "./dom.js";
import type { Channel, DocumentMessage, Key, Script, ScriptEvent, State } from "./protocol.js";

export interface Edit {
  path: string;
  value?: unknown;
}

export interface TimelineActions {
  edit(edits: Edit[], gesture?: string): void;
  seek(t_s: number): void;
  say(text: string): void;
}

interface KeyView {
  channel: string;
  index: number;
  element: HTMLButtonElement;
}

const rowHeight = 44;
const margin = 12; ///< px beside the first and the last moment
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
      h("button", { class: "quiet", onclick: () => this.remove() }, "Delete"),
    );
    this.inspector.hidden = true;
    this.time.addEventListener("change", () => this.put(Number(this.time.value), null));
    this.value.addEventListener("change", () => this.put(null, Number(this.value.value)));
    this.lanes.append(this.box, this.playhead);
    this.scroller.append(this.names, this.lanes, this.empty);
    place.append(h("div", { class: "ruler-line" }, h("div", { class: "corner" }), this.ruler), this.scroller);
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
    for (const [channel, track] of tracks) {
      this.names.append(
        h(
          "div",
          { class: "lane-name", title: channel },
          h("span", {}, this.label(channel)),
          h("button", { class: "remove", title: "Remove the channel from the script", "aria-label": `Remove ${this.label(channel)}`, onclick: () => this.actions.edit([{ path: `/channels/${channel}` }]) }, "×"),
        ),
      );
      const lane = h("div", { class: "lane", role: "group", "aria-label": this.label(channel), "data-channel": channel });
      lane.append(h("canvas", { "aria-hidden": true }));
      track.keys.forEach((key, index) => lane.append(this.keyButton(channel, index, key)));
      this.lanes.append(lane);
    }
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
    this.empty.hidden = tracks.length + events.length + pulls.length > 0;
    this.layout();
    this.showSelection();
    if (focused) this.lanes.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
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
    for (const lane of this.lanes.querySelectorAll<HTMLElement>(".lane[data-channel]")) this.drawCurve(lane);
    this.drawRuler();
    this.placePlayhead();
  }

  private y(channel: string, value: number): number {
    const [min, max] = this.range(channel);
    return inset + (1 - (value - min) / (max - min)) * (rowHeight - 2 * inset);
  }

  private sized(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    // Small pictures that are drawn anew all the time: the processor is quicker than the way to the graphics processor.
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    context.scale(ratio, ratio);
    return context;
  }

  private drawCurve(lane: HTMLElement): void {
    const channel = lane.dataset.channel!;
    const samples = this.document!.curves[channel];
    const context = this.sized(lane.querySelector("canvas")!);
    if (!samples) return;
    const [min, max] = this.range(channel);
    context.beginPath();
    samples.forEach((value, i) => {
      const t_s = (this.document!.duration_s * i) / (samples.length - 1);
      context[i === 0 ? "moveTo" : "lineTo"](this.x(t_s), this.y(channel, value));
    });
    context.lineWidth = 1.5;
    context.strokeStyle = "#7fb6f5";
    context.stroke();
    const zero = this.y(channel, clamp(0, min, max));
    context.lineTo(this.x(this.document!.duration_s), zero);
    context.lineTo(this.x(0), zero);
    context.fillStyle = "rgba(111, 177, 255, 0.13)";
    context.fill();
  }

  private drawRuler(): void {
    if (!this.document) return;
    const context = this.sized(this.ruler);
    const height = this.ruler.clientHeight;
    const end = this.x(this.document.duration_s);
    context.fillStyle = "#3d4450";
    context.fillRect(this.x(0), height - 4, end - this.x(0), 3);
    context.fillStyle = "#57c785";
    context.fillRect(this.x(0), height - 4, this.x(this.computed_s) - this.x(0), 3);
    const steps = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60];
    const step = steps.find((s) => (s / this.span_s) * this.width > 58) ?? 60;
    context.font = "11px system-ui, sans-serif";
    context.textBaseline = "top";
    for (let i = 0; i * step <= this.document.duration_s + 1e-9; i++) {
      const x = this.x(i * step);
      context.fillStyle = "#5a6270";
      context.fillRect(x, height - 10, 1, 6);
      context.fillStyle = "#b3bac4";
      const text = `${shown(i * step)} s`;
      const wide = context.measureText(text).width;
      context.fillText(text, clamp(x + 4, 0, this.ruler.clientWidth - wide - 2), 4);
    }
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
    const at = name.lastIndexOf(" ");
    const channel = name.slice(0, at);
    const index = Number(name.slice(at + 1));
    const key = this.script.channels?.[channel]?.keys[index];
    return key ? { channel, index, key } : null;
  }

  /// Moves keys by a time and a value, each within its neighbours that do not move and its range.
  private moved(names: string[], by_s: number, byPart: number, from: Script): Edit[] {
    const edits: Edit[] = [];
    const byChannel = new Map<string, Set<number>>();
    for (const name of names) {
      const one = this.keyNamed(name);
      if (!one) continue;
      if (!byChannel.has(one.channel)) byChannel.set(one.channel, new Set());
      byChannel.get(one.channel)!.add(one.index);
    }
    for (const [channel, indices] of byChannel) {
      const before = from.channels?.[channel]?.keys;
      if (!before) continue;
      const [min, max] = this.range(channel);
      const keys = before.map((key) => [...key] as Key);
      const order = [...indices].sort((a, b) => (by_s > 0 ? b - a : a - b));
      for (const i of order) {
        const least = i > 0 ? keys[i - 1][0] + 1e-3 : 0;
        const most = i + 1 < keys.length ? keys[i + 1][0] - 1e-3 : this.document!.duration_s;
        const t_s = by_s === 0 ? before[i][0] : clamp(this.snapped(before[i][0] + by_s), least, most);
        const value = byPart === 0 ? before[i][1] : Math.round(clamp(before[i][1] + byPart * (max - min), min, max) * 1000) / 1000;
        keys[i] = [Math.round(t_s * 1e4) / 1e4, value];
      }
      edits.push({ path: `/channels/${channel}/keys`, value: keys });
    }
    return edits;
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

  private keyKey(event: KeyboardEvent, channel: string, index: number): void {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 0.01], ArrowDown: [0, -0.01] };
    const step = steps[event.key];
    if (step) {
      const scale = event.shiftKey ? 10 : 1;
      const edits = this.moved([...this.selected, `${channel} ${index}`], (scale * step[0]) / this.rate, scale * step[1], this.script);
      this.actions.edit(edits);
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
    const edits: Edit[] = [];
    for (const [channel, track] of Object.entries(this.script.channels ?? {})) {
      const kept = track.keys.filter((_, index) => !this.selected.has(`${channel} ${index}`));
      if (kept.length === track.keys.length) continue;
      edits.push(kept.length > 0 ? { path: `/channels/${channel}/keys`, value: kept } : { path: `/channels/${channel}` });
    }
    this.selected.clear();
    if (edits.length > 0) this.actions.edit(edits);
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
