// SPDX-License-Identifier: MIT
/// \file
/// What is done with keys of channels: move, copy, paste, mirror. Scripts in, edits of the script out; nothing is drawn here.

import { clamp } from "./dom.js";
import type { Key, Script, Track } from "./protocol.js";

export interface Edit {
  path: string;
  value?: unknown;
}

/// A key by its channel and its place in the channel.
export interface KeyPlace {
  channel: string;
  index: number;
}

/// Keys that have been copied: times from the earliest of them.
export interface CopiedKeys {
  format: "risorius-keys";
  tracks: Record<string, Track>;
}

/// Edits, and the keys that they put, which may be selected then.
export interface KeyEdits {
  edits: Edit[];
  put: KeyPlace[];
  late: number; ///< keys after the end of the script, left out
}

/// Keys nearer to one another than this are one key, s. A channel must have later and later times.
export const sameTime_s = 1e-3;

const rounded = (t_s: number) => Math.round(t_s * 1e4) / 1e4;

/// The key that a name such as "AU12 3" stands for.
export function placeOf(name: string): KeyPlace {
  const at = name.lastIndexOf(" ");
  return { channel: name.slice(0, at), index: Number(name.slice(at + 1)) };
}

export const nameOf = ({ channel, index }: KeyPlace) => `${channel} ${index}`;

function grouped(places: KeyPlace[], script: Script): Map<string, number[]> {
  const out = new Map<string, number[]>();
  for (const { channel, index } of places) {
    if (!script.channels?.[channel]?.keys[index]) continue;
    const known = out.get(channel) ?? [];
    if (!known.includes(index)) out.set(channel, [...known, index].sort((a, b) => a - b));
  }
  return out;
}

export interface Move {
  by_s: number;
  byPart: number; ///< of the range of the channel
  snapped(t_s: number): number;
  range(channel: string): [number, number];
}

/// Moves keys, each within its neighbours that do not move and its range.
export function movedKeys(places: KeyPlace[], script: Script, move: Move): Edit[] {
  const edits: Edit[] = [];
  for (const [channel, indices] of grouped(places, script)) {
    const before = script.channels![channel].keys;
    const [min, max] = move.range(channel);
    const keys = before.map((key) => [...key] as Key);
    const order = move.by_s > 0 ? [...indices].reverse() : indices;
    for (const i of order) {
      const least = i > 0 ? keys[i - 1][0] + sameTime_s : 0;
      const most = i + 1 < keys.length ? keys[i + 1][0] - sameTime_s : script.duration_s;
      const t_s = move.by_s === 0 ? before[i][0] : clamp(move.snapped(before[i][0] + move.by_s), least, most);
      const value = move.byPart === 0 ? before[i][1] : Math.round(clamp(before[i][1] + move.byPart * (max - min), min, max) * 1000) / 1000;
      keys[i] = [rounded(t_s), value];
    }
    edits.push({ path: `/channels/${channel}/keys`, value: keys });
  }
  return edits;
}

export function removedKeys(places: KeyPlace[], script: Script): Edit[] {
  const edits: Edit[] = [];
  for (const [channel, indices] of grouped(places, script)) {
    const kept = script.channels![channel].keys.filter((_, index) => !indices.includes(index));
    edits.push(kept.length > 0 ? { path: `/channels/${channel}/keys`, value: kept } : { path: `/channels/${channel}` });
  }
  return edits;
}

export function copiedKeys(places: KeyPlace[], script: Script): CopiedKeys | null {
  const groups = grouped(places, script);
  if (groups.size === 0) return null;
  const all = [...groups].flatMap(([channel, indices]) => indices.map((i) => script.channels![channel].keys[i][0]));
  const first_s = Math.min(...all);
  const tracks: Record<string, Track> = {};
  for (const [channel, indices] of groups) {
    const { keys, ...rest } = script.channels![channel];
    tracks[channel] = { ...rest, keys: indices.map((i) => [rounded(keys[i][0] - first_s), keys[i][1]]) };
  }
  return { format: "risorius-keys", tracks };
}

/// What a text of the clipboard says, if it is keys.
export function readCopiedKeys(text: string): CopiedKeys | null {
  try {
    const read = JSON.parse(text);
    const number = (value: unknown) => typeof value === "number" && Number.isFinite(value);
    const isTrack = (one: any) => Array.isArray(one?.keys) && one.keys.length > 0 && one.keys.every((key: unknown) => Array.isArray(key) && key.length === 2 && key.every(number));
    return read?.format === "risorius-keys" && typeof read.tracks === "object" && Object.values(read.tracks).every(isTrack) ? read : null;
  } catch {
    return null;
  }
}

/// Keys put into a script: those that are at the same time are replaced, others stay.
function putKeys(tracks: Record<string, Track>, script: Script): KeyEdits {
  const out: KeyEdits = { edits: [], put: [], late: 0 };
  if (!script.channels) out.edits.push({ path: "/channels", value: {} });
  for (const [channel, track] of Object.entries(tracks)) {
    const added = track.keys.filter(([t_s]) => t_s <= script.duration_s + 1e-9);
    out.late += track.keys.length - added.length;
    if (added.length === 0) continue;
    const before = script.channels?.[channel];
    const kept = (before?.keys ?? []).filter(([t_s]) => !added.some((key) => Math.abs(key[0] - t_s) < sameTime_s));
    const keys = [...kept, ...added].sort((a, b) => a[0] - b[0]);
    out.edits.push(before ? { path: `/channels/${channel}/keys`, value: keys } : { path: `/channels/${channel}`, value: { ...track, keys } });
    keys.forEach((key, index) => added.includes(key) && out.put.push({ channel, index }));
  }
  if (out.put.length === 0) out.edits = [];
  return out;
}

/// The earliest copied key goes to `at_s`.
export function pastedKeys(copied: CopiedKeys, script: Script, at_s: number): KeyEdits {
  const tracks: Record<string, Track> = {};
  for (const [channel, track] of Object.entries(copied.tracks))
    tracks[channel] = { ...track, keys: track.keys.map(([t_s, value]) => [rounded(at_s + t_s), value]) };
  return putKeys(tracks, script);
}

/// Channels whose values change their sign in a mirror.
const turning = /^(head_yaw_deg|head_roll_deg|head_side_mm|gaze_yaw_deg|jaw_side)(\.[lr])?$/;

/// The channel that does the same on the other side, and whether its values change their sign. Null: it moves both sides alike.
export function mirroredChannel(channel: string, known: (name: string) => boolean): { channel: string; sign: number } | null {
  const sign = turning.test(channel) ? -1 : 1;
  const side = channel.match(/\.([lr])$/);
  if (side) return { channel: channel.slice(0, -1) + (side[1] === "l" ? "r" : "l"), sign };
  if (sign < 0) return { channel, sign };
  // Shapes of ARKit have their side in their name.
  const shape = channel.match(/^([a-z]\w*)(Left|Right)$/);
  const other = shape && shape[1] + (shape[2] === "Left" ? "Right" : "Left");
  return other && known(other) ? { channel: other, sign } : null;
}

export function mirroredCopy(copied: CopiedKeys, known: (name: string) => boolean): CopiedKeys {
  const tracks: Record<string, Track> = {};
  for (const [channel, track] of Object.entries(copied.tracks)) {
    const other = mirroredChannel(channel, known) ?? { channel, sign: 1 };
    tracks[other.channel] = { ...track, keys: track.keys.map(([t_s, value]) => [t_s, other.sign * value || 0]) };
  }
  return { ...copied, tracks };
}

/// The other side does what the selected keys do, at the same times. Keys of channels that move both sides alike change nothing.
export function mirroredKeys(places: KeyPlace[], script: Script, known: (name: string) => boolean): KeyEdits {
  const tracks: Record<string, Track> = {};
  for (const [channel, indices] of grouped(places, script)) {
    const other = mirroredChannel(channel, known);
    if (!other) continue;
    const { keys, ...rest } = script.channels![channel];
    tracks[other.channel] = { ...rest, keys: indices.map((i) => [keys[i][0], other.sign * keys[i][1] || 0]) };
  }
  return putKeys(tracks, script);
}
