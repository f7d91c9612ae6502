// SPDX-License-Identifier: MIT
/// \file
/// Landmarks of a new head without drawing: where they are, undo, the partner on the other side, and where the next ones should be, told
/// from the standard head.

import { landmarkNamed, landmarkTable } from "./landmark_table.js";
import type { Vec } from "./protocol.js";

/// How a landmark came to its place.
/// "found": by the engine, surely. It need not be checked.
export type Found = "placed" | "found" | "mirrored" | "proposed";

export interface Place {
  at: Vec; ///< in units of the mesh
  found: Found;
}

export type Places = Record<string, Place>;

/// The landmarks without which there is no fit (docs/formats/landmarks.md), in an order in which one finds them.
export const required = ["prn", "n", "sn", "ls", "sto", "li", "pg", "me", "en_l", "en_r", "ex_l", "ex_r", "ps_l", "ps_r", "pi_l", "pi_r", "ch_l", "ch_r", "t_l", "t_r"];
const deepestUndo = 200;
const fewestForProposals = 4;
const surelyFound = 0.75; // confidence: 2 mm
const doubtful = 0.5; // 5 mm; below, only a landmark that a fit needs is shown
const isKnown = (place: Place) => place.found === "placed" || place.found === "found";

const plus = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a: Vec, s: number): Vec => [s * a[0], s * a[1], s * a[2]];
const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const norm = (a: Vec): number => Math.hypot(...a);
const mean = (list: Vec[]): Vec => times(list.reduce(plus, [0, 0, 0]), 1 / list.length);

export function partnerOf(id: string): string | null {
  return id.endsWith("_l") ? `${id.slice(0, -2)}_r` : id.endsWith("_r") ? `${id.slice(0, -2)}_l` : null;
}

/// x -> scale R x + shift, in the sense of least squares: Horn 1987, closed-form solution with unit quaternions. The quaternion is the
/// eigenvector of the largest eigenvalue of a symmetric matrix; its power iteration converges because the matrix is shifted.
export function similarity(from: Vec[], to: Vec[]): (p: Vec) => Vec {
  const [a, b] = [mean(from), mean(to)];
  const s = [0, 1, 2].map((i) => [0, 1, 2].map((j) => from.reduce((sum, p, k) => sum + (p[i] - a[i]) * (to[k][j] - b[j]), 0)));
  const n = [
    [s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]],
    [s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]],
    [s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]],
    [s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]],
  ];
  const shift = Math.max(...n.map((row) => row.reduce((sum, one) => sum + Math.abs(one), 0))) || 1;
  let q = [1, 0.01, 0.02, 0.03];
  for (let round = 0; round < 2000; round++) {
    const next = n.map((row, i) => row.reduce((sum, one, j) => sum + one * q[j], shift * q[i]));
    const length = Math.hypot(...next);
    q = next.map((one) => one / length);
  }
  const [w, x, y, z] = q;
  const r: Vec[] = [
    [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
  ];
  const turned = (p: Vec): Vec => [dot(r[0], p), dot(r[1], p), dot(r[2], p)];
  let [above, below] = [0, 0];
  from.forEach((p, k) => {
    above += dot(turned(minus(p, a)), minus(to[k], b));
    below += dot(minus(p, a), minus(p, a));
  });
  return (p) => plus(times(turned(minus(p, a)), above / below), b);
}

/// Solves a small linear system by elimination, for several right-hand sides.
function solved(matrix: number[][], right: number[][]): number[][] {
  const n = matrix.length;
  const m = matrix.map((row, i) => [...row, ...right[i]]);
  for (let c = 0; c < n; c++) {
    let best = c;
    for (let r = c + 1; r < n; r++) if (Math.abs(m[r][c]) > Math.abs(m[best][c])) best = r;
    [m[c], m[best]] = [m[best], m[c]];
    for (let r = 0; r < n; r++) {
      if (r === c || m[c][c] === 0) continue;
      const factor = m[r][c] / m[c][c];
      for (let k = c; k < m[r].length; k++) m[r][k] -= factor * m[c][k];
    }
  }
  return m.map((row, i) => row.slice(n).map((one) => (row[i] === 0 ? 0 : one / row[i])));
}

/// A map of the standard head onto the new one that takes the given landmarks to their places: a similarity, and a smoothing spline
/// with the kernel |r| for what is left.
export function mapOf(places: Record<string, Vec>): ((p_mm: Vec) => Vec) | null {
  const ids = Object.keys(places).filter((id) => landmarkNamed(id));
  if (ids.length < fewestForProposals) return null;
  const from = ids.map((id) => landmarkNamed(id)!.xyz_mm);
  const to = ids.map((id) => places[id]);
  const rough = similarity(from, to);
  const smoothing_mm = 8;
  const matrix = from.map((p, i) => from.map((q, j) => (i === j ? -smoothing_mm : norm(minus(p, q)))));
  const weights = solved(matrix, from.map((p, i) => minus(to[i], rough(p)))) as Vec[];
  return (p) => from.reduce((sum, q, i) => plus(sum, times(weights[i], norm(minus(p, q)))), rough(p));
}

/// The plane of symmetry: through the middles between partners and the points of the midline. Null: too little is known.
export function symmetryPlane(places: Record<string, Vec>): { point: Vec; normal: Vec } | null {
  const pairs = Object.keys(places).filter((id) => id.endsWith("_l") && partnerOf(id)! in places);
  if (pairs.length > 0) {
    const normal = pairs.map((id) => minus(places[id], places[partnerOf(id)!])).reduce(plus, [0, 0, 0] as Vec);
    const middles = pairs.map((id) => times(plus(places[id], places[partnerOf(id)!]), 0.5));
    return { point: mean(middles), normal: times(normal, 1 / norm(normal)) };
  }
  const map = mapOf(places);
  if (!map) return null;
  // Where the standard head's own plane comes to be
  const [o, x] = [map([0, 0, 60]), map([10, 0, 60])];
  const normal = minus(x, o);
  return { point: o, normal: times(normal, 1 / norm(normal)) };
}

export class LandmarkModel {
  places: Places = {};
  private past: Places[] = [];
  private future: Places[] = [];

  /// `snap` takes a point onto the surface.
  constructor(private readonly snap: (p: Vec) => Vec) {}

  private change(next: Places): void {
    this.past.push(this.places);
    if (this.past.length > deepestUndo) this.past.shift();
    this.future = [];
    this.places = next;
  }

  private positions(places: Places, which: (place: Place) => boolean): Record<string, Vec> {
    return Object.fromEntries(Object.entries(places).filter(([, place]) => which(place)).map(([id, place]) => [id, place.at]));
  }

  /// Places a landmark, and its partner where nobody has placed that one.
  put(id: string, at: Vec, mirror: boolean): void {
    const next: Places = { ...this.places, [id]: { at, found: "placed" } };
    const partner = partnerOf(id);
    if (mirror && partner && next[partner]?.found !== "placed") {
      const known = this.positions(next, isKnown);
      delete known[id];
      const plane = symmetryPlane(known) ?? symmetryPlane({ ...known, [id]: at });
      if (plane) {
        const away = dot(minus(at, plane.point), plane.normal);
        next[partner] = { at: this.snap(minus(at, times(plane.normal, 2 * away))), found: "mirrored" };
      }
    }
    this.change(next);
  }

  /// Takes a place that was mirrored or proposed as right.
  accept(id: string): void {
    const place = this.places[id];
    if (place && place.found !== "placed") this.change({ ...this.places, [id]: { ...place, found: "placed" } });
  }

  remove(id: string): void {
    const { [id]: gone, ...rest } = this.places;
    if (gone) this.change(rest);
  }

  /// Proposes all landmarks of a list that nobody has placed. Returns how many.
  propose(ids: string[]): number {
    const map = mapOf(this.positions(this.places, isKnown));
    if (!map) return 0;
    const next = { ...this.places };
    let count = 0;
    for (const id of ids)
      if (!next[id] || next[id].found === "proposed") {
        next[id] = { at: this.snap(map(landmarkNamed(id)!.xyz_mm)), found: "proposed" };
        count++;
      }
    if (count > 0) this.change(next);
    return count;
  }

  /// Takes what the engine has found, where nobody has placed a landmark. Of those that a fit needs, the ones that are not sure are proposed,
  /// so that they are checked; of the others, the ones that are unsure are left to the fit. Returns how many, and how many are to be checked.
  useFound(found: Record<string, { at: Vec; confidence: number }>): { count: number; toCheck: number } {
    const next = { ...this.places };
    let [count, toCheck] = [0, 0];
    for (const [id, { at, confidence }] of Object.entries(found)) {
      if (!landmarkNamed(id) || next[id]?.found === "placed") continue;
      const needed = required.includes(id);
      if (confidence < doubtful && !needed) continue;
      const check = needed && confidence < surelyFound;
      next[id] = { at, found: check ? "proposed" : "found" };
      count++;
      if (check) toCheck++;
    }
    if (count > 0) this.change(next);
    return { count, toCheck };
  }

  /// Where a landmark is, or should be; null: not enough is known.
  guess(id: string): Vec | null {
    if (this.places[id]) return this.places[id].at;
    const map = mapOf(this.positions(this.places, (place) => place.found !== "proposed"));
    return map ? map(landmarkNamed(id)!.xyz_mm) : null;
  }

  /// Units of the mesh in a millimetre of a head of the standard size.
  unitsPerMm(height: number): number {
    const map = mapOf(this.positions(this.places, () => true));
    return map ? norm(minus(map([0, 50, 0]), map([0, -50, 0]))) / 100 : height / 400;
  }

  undo(): boolean {
    const last = this.past.pop();
    if (!last) return false;
    this.future.push(this.places);
    this.places = last;
    return true;
  }

  redo(): boolean {
    const next = this.future.pop();
    if (!next) return false;
    this.past.push(this.places);
    this.places = next;
    return true;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  get missing(): string[] {
    return required.filter((id) => !this.places[id]);
  }

  get unchecked(): string[] {
    return landmarkTable.map((one) => one.id).filter((id) => this.places[id] && !isKnown(this.places[id]));
  }
}
