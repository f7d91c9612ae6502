// SPDX-License-Identifier: MIT
/// \file
/// How much light comes through the lips to what is behind them, as the renderer of videos has it (render/detail/shader_lighting.cpp):
/// the gap is seen as a disc at the distance of the nearest point of the line between the corners.

import type { Scene } from "./protocol.js";

const shut_m = 1.2e-3; ///< of light that passes between shut lips
const deep = [1.9, 1.45, 1.4]; ///< light deep in the mouth comes from its red walls
const darkest = 0.05;
const inMouth = new Set(["teeth", "gums", "tongue", "mouth"]);

export function isInMouth(material: string): boolean {
  return inMouth.has(material);
}

type Point = [number, number, number];

export class MouthLight {
  private readonly marks: Record<string, number> = {}; ///< landmark -> vertex
  private readonly lipsAtRest_m: number = 0;

  constructor(private readonly scene: Scene) {
    for (const id of ["ch_l", "ch_r", "ls", "li"]) this.marks[id] = nearestVertex(scene, id);
    if (this.known) this.lipsAtRest_m = this.distance(scene.rest, "ls", "li");
  }

  private get known(): boolean {
    return Object.values(this.marks).every((vertex) => vertex >= 0);
  }

  private distance(positions: Float32Array, a: string, b: string): number {
    const [i, j] = [3 * this.marks[a], 3 * this.marks[b]];
    return Math.hypot(positions[i] - positions[j], positions[i + 1] - positions[j + 1], positions[i + 2] - positions[j + 2]);
  }

  /// Writes the share of the light for vertices of a surface, 3 numbers each: r, g, b.
  write(positions: Float32Array, vertex: Uint32Array, out: Float32Array): void {
    if (!this.known) return void out.fill(1);
    const at = (id: string) => [0, 1, 2].map((k) => positions[3 * this.marks[id] + k]) as Point;
    const [l, r, upper, lower] = [at("ch_l"), at("ch_r"), at("ls"), at("li")];
    const gap_m = Math.max(0, this.distance(positions, "ls", "li") - this.lipsAtRest_m) + shut_m;
    const area_m2 = (Math.PI / 4) * this.distance(positions, "ch_l", "ch_r") * gap_m;
    const [cx, cy, cz] = [0, 1, 2].map((k) => 0.25 * (l[k] + r[k] + upper[k] + lower[k]));
    const [ax, ay, az] = [0, 1, 2].map((k) => 0.5 * (l[k] - r[k]));
    const long = ax * ax + ay * ay + az * az + 1e-12;
    for (let i = 0; i < vertex.length; i++) {
      const v = 3 * vertex[i];
      const [x, y, z] = [positions[v] - cx, positions[v + 1] - cy, positions[v + 2] - cz];
      const along = Math.min(0.75, Math.max(-0.75, (x * ax + y * ay + z * az) / long));
      const far2 = (x - along * ax) ** 2 + (y - along * ay) ** 2 + (z - along * az) ** 2;
      const share = area_m2 / (area_m2 + Math.PI * far2);
      for (let c = 0; c < 3; c++) out[3 * i + c] = Math.max(darkest, share * (deep[c] + (1 - deep[c]) * share));
    }
  }
}

/// The vertex that tissue moves nearest to a landmark, or -1.
export function nearestVertex(scene: Scene, landmark: string): number {
  const at = scene.landmarks[landmark];
  let [nearest, least] = [-1, Infinity];
  for (let v = 0; at && v < scene.vertices; v++) {
    const far = Math.hypot(at[0] - scene.rest[3 * v], at[1] - scene.rest[3 * v + 1], at[2] - scene.rest[3 * v + 2]);
    if (scene.soft[v] && far < least) [nearest, least] = [v, far];
  }
  return nearest;
}
