// SPDX-License-Identifier: MIT
/// \file
/// The panel of channels: search, sliders, exact numbers, meters of drive and activation. A slider is a live override, orange, until
/// it is made a key or let go.

import { clamp, h, shown } from "./dom.js";
import { everydayWords } from "./everyday_words.js";
import type { Channel, DocumentMessage, Pose, State, Welcome } from "./protocol.js";

export interface ChannelActions {
  override(channel: string, value: number): void;
  release(channel?: string): void;
  key(channel: string): void;
  select(channel: string): void;
}

const groups: [string, string, boolean][] = [
  ["units", "Action units", true],
  ["muscles", "Muscles", false],
  ["jaw", "Jaw", true],
  ["gaze", "Gaze", false],
  ["head", "Head", false],
  ["mouth", "Mouth and tongue", false],
  ["shapes", "ARKit shapes", false],
];

interface Row {
  channel: Channel;
  name: string; ///< with its side
  element: HTMLElement;
  slider: HTMLInputElement;
  number: HTMLInputElement;
  key: HTMLButtonElement;
  release: HTMLButtonElement;
  drive: HTMLElement | null;
  activation: HTMLElement | null;
  columns: number[];
  last: string; ///< what the row shows
}

function scale(bar: HTMLElement, part: number): void {
  const text = `scaleX(${part.toFixed(2)})`;
  if (bar.style.transform !== text) bar.style.transform = text;
}

const favouritesKey = "risorius favourites";

export class Channels {
  private rows: Row[] = [];
  private welcome: Welcome | null = null;
  private document: DocumentMessage | null = null;
  private overrides: Record<string, number> = {};
  private t_s = 0;
  private apart = new Set<string>(); ///< channels whose sides are driven apart
  private favourites = new Set<string>(JSON.parse(localStorage.getItem(favouritesKey) ?? "[]"));
  private onlyFavourites = false;
  private pending = new Map<string, number>();
  private readonly list = h("div", { class: "channel-list" });
  private readonly search = h("input", {
    type: "search",
    placeholder: "Search",
    "aria-label": "Search channels",
    oninput: () => this.filter(),
  });
  private readonly releaseAll = h(
    "button",
    { class: "quiet", onclick: () => this.actions.release(), title: "Let go of all overrides", disabled: true },
    "Release all",
  );
  private readonly starred = h(
    "button",
    { class: "quiet icon", "aria-pressed": "false", "aria-label": "Favourites only", title: "Favourites only" },
    "★",
  );
  private readonly force = h("p", { class: "force", "aria-live": "off" });

  constructor(
    place: HTMLElement,
    private readonly actions: ChannelActions,
  ) {
    this.starred.addEventListener("click", () => {
      this.onlyFavourites = !this.onlyFavourites;
      this.starred.setAttribute("aria-pressed", String(this.onlyFavourites));
      this.filter();
    });
    place.append(h("div", { class: "panel-head" }, this.search, this.starred, this.releaseAll), this.list, this.force);
  }

  use(welcome: Welcome): void {
    this.welcome = welcome;
    this.build();
  }

  focusSearch(): void {
    this.search.focus();
    this.search.select();
  }

  private build(): void {
    this.rows = [];
    this.list.replaceChildren();
    for (const [id, title, open] of groups) {
      const channels = this.welcome!.channels.filter((c) => c.group === id);
      if (channels.length === 0) continue;
      const body = h("div", { class: "group" });
      for (const channel of channels) body.append(this.block(channel));
      const details = h("details", { open }, h("summary", {}, title, h("span", { class: "count" }, String(channels.length))));
      details.append(body);
      this.list.append(details);
    }
    this.filter();
    this.show();
  }

  private block(channel: Channel): HTMLElement {
    const names = channel.sided && this.apart.has(channel.name) ? [`${channel.name}.l`, `${channel.name}.r`] : [channel.name];
    const block = h("div", { class: "channel", "data-channel": channel.name });
    const star = h(
      "button",
      {
        class: "star",
        "aria-pressed": String(this.favourites.has(channel.name)),
        "aria-label": `${channel.label}: favourite`,
        onclick: () => {
          if (!this.favourites.delete(channel.name)) this.favourites.add(channel.name);
          star.setAttribute("aria-pressed", String(this.favourites.has(channel.name)));
          localStorage.setItem(favouritesKey, JSON.stringify([...this.favourites]));
        },
      },
      "★",
    );
    const chain = channel.sided
      ? h(
          "button",
          {
            class: "chain",
            "aria-pressed": String(names.length === 1),
            "aria-label": `${names.length === 1 ? "L=R" : "L R"}, ${channel.label}: left and right together`,
            title: "Left and right together",
            onclick: () => {
              if (!this.apart.delete(channel.name)) this.apart.add(channel.name);
              this.rows = this.rows.filter((row) => row.channel !== channel);
              block.replaceWith(this.block(channel));
              this.show();
            },
          },
          names.length === 1 ? "L=R" : "L R",
        )
      : null;
    const code = channel.group === "units" ? channel.name : "";
    block.append(
      h(
        "div",
        { class: "channel-name" },
        h("button", { class: "label", onclick: () => this.actions.select(channel.name) }, channel.label),
        h("span", { class: "code" }, code),
        chain,
        star,
      ),
    );
    for (const name of names) block.append(this.row(channel, name));
    return block;
  }

  private row(channel: Channel, name: string): HTMLElement {
    const range = channel.max - channel.min;
    const step = range <= 2.5 ? 0.01 : range <= 200 ? 0.5 : 10;
    const side = name === channel.name ? "" : name.endsWith(".l") ? ", left" : ", right";
    const common = { min: channel.min, max: channel.max, step };
    const label = channel.label + side;
    const slider = h("input", { type: "range", ...common, "aria-label": label, oninput: () => this.set(name, Number(slider.value)) });
    const number = h("input", {
      type: "number",
      ...common,
      step: "any",
      "aria-label": `${label}, exact value`,
      onchange: () => this.set(name, clamp(Number(number.value), channel.min, channel.max)),
    });
    const key = h("button", { class: "key", title: "Make a key at the playhead (K)", "aria-label": `K: make a key of ${label}`, onclick: () => this.makeKey(name) }, "K");
    const release = h("button", { class: "release", title: "Let go", "aria-label": `${label}: let go`, onclick: () => this.actions.release(name) }, "×");
    const columns = channel.group === "muscles" ? this.columnsOf(channel, name) : [];
    const meter = (kind: string) => h("span", { class: `bar ${kind}` });
    const drive = columns.length > 0 ? meter("drive") : null;
    const activation = columns.length > 0 ? meter("activation") : null;
    const meters = drive && activation ? h("div", { class: "meters", "aria-hidden": true, title: "Drive above, activation below" }, drive, activation) : null;
    const element = h(
      "div",
      { class: "row", "data-name": name },
      side ? h("span", { class: "side" }, name.endsWith(".l") ? "L" : "R") : null,
      h("div", { class: "track" }, slider, meters),
      number,
      h("span", { class: "unit" }, channel.unit),
      key,
      release,
    );
    element.addEventListener("focusin", () => (this.lastName = name));
    this.rows.push({ channel, name, element, slider, number, key, release, drive, activation, columns, last: "" });
    return element;
  }

  /// The channel that K makes a key of: the one that was touched last.
  lastName: string | null = null;

  private columnsOf(channel: Channel, name: string): number[] {
    const names = name !== channel.name ? [name] : channel.sided ? [`${name}.l`, `${name}.r`] : [name];
    return names.map((one) => this.welcome!.columns.indexOf(one)).filter((column) => column >= 0);
  }

  private set(name: string, value: number): void {
    if (!Number.isFinite(value)) return;
    this.lastName = name;
    this.overrides[name] = value;
    // One message a picture is enough.
    if (this.pending.size === 0) requestAnimationFrame(() => this.sendPending());
    this.pending.set(name, value);
    this.show();
  }

  private sendPending(): void {
    for (const [channel, latest] of this.pending) this.actions.override(channel, latest);
    this.pending.clear();
  }

  /// Makes a key of what the panel shows, also where the picture of the last change is still to come, or where nothing was changed.
  makeKey(name: string): void {
    if (!(name in this.overrides)) this.pending.set(name, this.scripted(name));
    this.sendPending();
    this.actions.key(name);
  }

  private filter(): void {
    const words = this.search.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    for (const details of this.list.querySelectorAll("details")) {
      let any = false;
      for (const block of details.querySelectorAll<HTMLElement>(".channel")) {
        const name = block.dataset.channel!;
        const text = `${name} ${block.querySelector(".label")!.textContent} ${everydayWords(name)}`.toLowerCase();
        const found = words.every((word) => text.includes(word)) && (!this.onlyFavourites || this.favourites.has(name));
        block.hidden = !found;
        any ||= found;
      }
      details.hidden = !any;
      if (words.length > 0 || this.onlyFavourites) details.open = any;
    }
  }

  useDocument(message: DocumentMessage): void {
    this.document = message;
    this.show();
  }

  useState(state: State): void {
    this.t_s = state.t_s;
    this.overrides = { ...state.overrides, ...Object.fromEntries(this.pending) };
    this.releaseAll.disabled = Object.keys(state.overrides).length === 0;
    const { channel, l, r } = state.selected;
    const sides = [l ? `left ${l.force_n.toFixed(2)} N, ${l.length_mm.toFixed(1)} mm` : "", r ? `right ${r.force_n.toFixed(2)} N, ${r.length_mm.toFixed(1)} mm` : ""];
    const words = channel ? channel.replaceAll("_", " ") : "";
    this.force.textContent = channel && (l || r) ? `${words}: ${sides.filter(Boolean).join("; ")}` : "";
    this.show();
  }

  private scripted(name: string): number {
    const samples = this.document?.curves[name];
    if (!samples || !this.document) return 0;
    const at = clamp(this.t_s / this.document.duration_s, 0, 1) * (samples.length - 1);
    const i = Math.min(Math.floor(at), samples.length - 2);
    return samples[i] + (at - i) * (samples[i + 1] - samples[i]);
  }

  private show(): void {
    for (const row of this.rows) {
      const overridden = row.name in this.overrides;
      const value = overridden ? this.overrides[row.name] : this.scripted(row.name);
      const scripted = this.document !== null && row.name in this.document.curves;
      // What has not changed need not be painted again.
      const now = `${value} ${overridden} ${scripted}`;
      if (now === row.last) continue;
      row.last = now;
      row.element.classList.toggle("overridden", overridden);
      row.element.classList.toggle("scripted", scripted);
      row.key.disabled = row.release.disabled = !overridden;
      if (document.activeElement !== row.slider || !overridden) row.slider.value = String(value);
      if (document.activeElement !== row.number) row.number.value = shown(value);
      const part = (clamp(value, row.channel.min, row.channel.max) - row.channel.min) / (row.channel.max - row.channel.min);
      row.slider.style.setProperty("--part", String(part));
    }
  }

  meters(pose: Pose): void {
    const mean = (values: Int8Array, columns: number[]) =>
      columns.reduce((sum, column) => sum + Math.max(0, values[column]) / 127, 0) / columns.length;
    for (const row of this.rows) {
      if (!row.drive || !row.activation) continue;
      scale(row.drive, mean(pose.drive, row.columns));
      scale(row.activation, mean(pose.activation, row.columns));
    }
  }

  /// Marks the row of a muscle that the pointer is on.
  highlight(name: string | null): void {
    const base = name?.replace(/\.[lr]$/, "");
    for (const block of this.list.querySelectorAll<HTMLElement>(".channel")) block.classList.toggle("pointed", block.dataset.channel === base);
  }

  /// Opens and shows the row of a muscle that was picked on the stage.
  reveal(name: string): void {
    const base = name.replace(/\.[lr]$/, "");
    const block = this.list.querySelector<HTMLElement>(`[data-channel="${CSS.escape(base)}"]`);
    if (!block) return;
    this.search.value = "";
    this.filter();
    block.closest("details")!.open = true;
    block.scrollIntoView({ block: "center" });
    block.querySelector<HTMLInputElement>("input[type=range]")!.focus();
    this.actions.select(base);
  }
}
