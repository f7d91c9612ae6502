// SPDX-License-Identifier: MIT
/// \file
/// Says what is under the pointer: a muscle with its drive, activation, force and length, or a place of the skin with how far it has
/// moved and how it is stretched.

import { byId, h } from "./dom.js";
import { landmarkLabel, landmarkNamed } from "./landmark_table.js";
import type { Pose, Scene, State } from "./protocol.js";

/// What is under a point of the stage.
export interface Probed {
  muscle?: string; ///< "zygomaticus_major.l"
  column?: number;
  vertex?: number; ///< of the pose
}

export interface HoverActions {
  probe(event: { clientX: number; clientY: number; target?: EventTarget | null }): Probed | null;
  highlight(muscle: string | null): void;
  /// Asks for force and length of a muscle; null asks for what was asked for before.
  ask(muscle: string | null): void;
}

const every_ms = 60; ///< a ray through the head takes some milliseconds
const still_ms = 150; ///< before force and length are asked for
const near_m = 12e-3; ///< farther from a landmark, only the region is named

export class Hover {
  private readonly label = h("div", { class: "hover-label", hidden: true });
  private at: PointerEvent | null = null;
  private waiting = 0;
  private asking = 0;
  private found: Probed | null = null;
  private scene: Scene | null = null;
  private pose: Pose | null = null;
  private state: State | null = null;

  constructor(
    private readonly place: HTMLElement,
    private readonly actions: HoverActions,
  ) {
    byId("labels").append(this.label);
    place.addEventListener("pointermove", (event) => {
      const over = event.target instanceof HTMLCanvasElement || (event.target as HTMLElement).id === "second";
      if (event.buttons !== 0 || event.pointerType === "touch" || !over) return this.leave();
      this.at = event;
      if (!this.waiting) this.waiting = window.setTimeout(() => this.look(), every_ms);
    });
    for (const type of ["pointerleave", "pointerdown", "wheel"]) place.addEventListener(type, () => this.leave(), { passive: true });
  }

  useScene(scene: Scene): void {
    this.scene = scene;
    this.leave();
  }

  usePose(pose: Pose): void {
    this.pose = pose;
    if (this.found) this.write();
  }

  useState(state: State): void {
    this.state = state;
    if (this.found?.muscle) this.write();
  }

  private leave(): void {
    clearTimeout(this.waiting);
    clearTimeout(this.asking);
    this.waiting = 0;
    this.at = null;
    this.show(null);
  }

  private look(): void {
    this.waiting = 0;
    if (this.at) this.show(this.actions.probe(this.at));
    if (!this.at || !this.found) return;
    const box = this.place.getBoundingClientRect();
    const x = this.at.clientX - box.left;
    const y = this.at.clientY - box.top;
    const left = x > box.width - 260;
    this.label.style.transform = `translate(${Math.round(left ? x - 14 : x + 16)}px, ${Math.round(y + 14)}px) translateX(${left ? "-100%" : "0"})`;
  }

  private show(found: Probed | null): void {
    if (found?.muscle !== this.found?.muscle) {
      clearTimeout(this.asking);
      this.actions.highlight(found?.muscle ?? null);
      const muscle = found?.muscle ?? null;
      // Moving across the face must not ask for each muscle on the way.
      if (muscle || this.found?.muscle) this.asking = window.setTimeout(() => this.actions.ask(muscle), muscle ? still_ms : 0);
    }
    this.found = found;
    this.label.hidden = found === null;
    if (found) this.write();
  }

  private write(): void {
    const lines = this.found!.muscle ? this.muscleLines(this.found!.muscle, this.found!.column!) : this.skinLines(this.found!.vertex!);
    const text = lines.join("\n");
    if (this.label.textContent !== text) this.label.replaceChildren(h("b", {}, lines[0]), ...lines.slice(1).map((line) => `\n${line}`));
    if (this.label.textContent === "") this.label.hidden = true;
  }

  private muscleLines(name: string, column: number): string[] {
    const [base, side] = [name.replace(/\.[lr]$/, ""), name.match(/\.([lr])$/)?.[1] as "l" | "r" | undefined];
    const words = base.replaceAll("_", " ") + (side === "l" ? ", left" : side === "r" ? ", right" : "");
    if (column < 0 || !this.pose) return [words];
    const part = (value: number) => (Math.max(-127, value) / 127).toFixed(2);
    const lines = [words, `activation ${part(this.pose.activation[column])}, drive ${part(this.pose.drive[column])}`];
    const selected = this.state?.selected;
    const one = selected?.channel === base ? selected[side ?? "l"] : undefined;
    if (one) lines.push(`${one.force_n.toFixed(2)} N, ${one.length_mm.toFixed(1)} mm long`);
    return lines;
  }

  private skinLines(vertex: number): string[] {
    const { scene, pose } = this;
    if (!scene || !pose) return [];
    const r = 3 * vertex;
    const rest = [scene.rest[r], scene.rest[r + 1], scene.rest[r + 2]];
    let nearest = "";
    let least = Infinity;
    for (const [id, p] of Object.entries(scene.landmarks)) {
      const far = Math.hypot(p[0] - rest[0], p[1] - rest[1], p[2] - rest[2]);
      if (far < least) [nearest, least] = [id, far];
    }
    const landmark = landmarkNamed(nearest);
    const side = Math.abs(rest[0]) < 2e-3 ? "" : rest[0] > 0 ? ", left" : ", right";
    const name = least <= near_m ? `${landmarkLabel(nearest)} (${nearest})` : (landmark?.region ?? "skin") + side;
    const strain = pose.strain && pose.strain[vertex] !== -128 ? `, strain ${((0.4 * pose.strain[vertex]) / 127).toFixed(2)}` : "";
    return [name, `moved ${(1e3 * this.moved(vertex)).toFixed(1)} mm${strain}`];
  }

  /// How far the skin is from where it is at rest, without the motion of the head, m.
  private moved(vertex: number): number {
    const { scene, pose } = this;
    const [x, y, z, w] = pose!.head.turn;
    const p = [0, 1, 2].map((k) => scene!.unit_m * pose!.vertices[3 * vertex + k] - pose!.head.at_m[k]);
    // The inverse turn: v + 2 w (p x v) + 2 q x (q x v) with -q
    const q = [-x, -y, -z];
    const cross = (a: number[], b: number[]) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const once = cross(q, p);
    const twice = cross(q, once);
    return Math.hypot(...[0, 1, 2].map((k) => p[k] + 2 * (w * once[k] + twice[k]) - scene!.rest[3 * vertex + k]));
  }
}
