// SPDX-License-Identifier: MIT
/// \file
/// Edits of a script without the engine: while it is gone, and to bring back what was not saved. Scripts in, scripts or edits out.

import type { Edit } from "./key_edits.js";
import type { Script, Track } from "./protocol.js";

const parts = (path: string) => path.split("/").slice(1).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
const escaped = (key: string) => key.replaceAll("~", "~0").replaceAll("/", "~1");

/// The script after edits with JSON pointers, as the engine makes them (view/document.h). An edit that cannot be made throws.
export function appliedEdits(script: Script, edits: Edit[]): Script {
  const out = structuredClone(script);
  for (const { path, value } of edits) {
    const keys = parts(path);
    const last = keys.pop();
    if (last === undefined) throw new Error(`edit ${path}: expected a place in the script`);
    let parent: any = out;
    for (const key of keys) parent = parent?.[key];
    if (typeof parent !== "object" || parent === null) throw new Error(`edit ${path}: expected a place in the script, found none`);
    if (Array.isArray(parent)) {
      const index = Number(last);
      if (!Number.isInteger(index) || index < 0 || index > parent.length) throw new Error(`edit ${path}: expected an index in [0, ${parent.length}]`);
      if (value === undefined) parent.splice(index, 1);
      else parent[index] = structuredClone(value);
    } else if (value === undefined) {
      delete parent[last];
    } else {
      parent[last] = structuredClone(value);
    }
  }
  return out;
}

export const sameJson = (a: unknown, b: unknown): boolean => {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null || Array.isArray(a) !== Array.isArray(b)) return false;
  const [keys, others] = [Object.keys(a), Object.keys(b)];
  return keys.length === others.length && keys.every((key) => key in b && sameJson((a as any)[key], (b as any)[key]));
};

/// What stays with the file: another rig needs another face.
const ofTheFile = ["format", "version", "rig", "$schema"];

/// The edits that make one script of another. Channels are set one by one, so that what is equal stays as it is.
export function editsBetween(from: Script, to: Script): Edit[] {
  const edits: Edit[] = [];
  const compare = (a: Record<string, unknown>, b: Record<string, unknown>, path: string, left: string[]) => {
    for (const key of Object.keys(a)) if (!(key in b) && !left.includes(key)) edits.push({ path: `${path}/${escaped(key)}` });
    for (const [key, value] of Object.entries(b)) {
      if (left.includes(key) || sameJson(a[key], value)) continue;
      if (path === "" && key === "channels" && a.channels) compare(a.channels as Record<string, unknown>, value as Record<string, unknown>, "/channels", []);
      else edits.push({ path: `${path}/${escaped(key)}`, value });
    }
  };
  compare(from, to, "", ofTheFile);
  return edits;
}

/// Samples of a curve for the eye, while the engine is gone: straight from key to key.
export function straightSamples(track: Track, duration_s: number, count: number): number[] {
  const { keys } = track;
  return Array.from({ length: count }, (_, i) => {
    const t_s = (duration_s * i) / (count - 1);
    const next = keys.findIndex((key) => key[0] > t_s);
    if (next < 0) return keys[keys.length - 1][1];
    if (next === 0) return keys[0][1];
    const [a, b] = [keys[next - 1], keys[next]];
    return track.interpolation === "step" ? a[1] : a[1] + ((t_s - a[0]) / (b[0] - a[0])) * (b[1] - a[1]);
  });
}
