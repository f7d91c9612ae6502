// SPDX-License-Identifier: MIT
/// \file
/// The smile test of a new rig: AU12 goes to 1, and when the face is at rest the page says how far the corners of the mouth went.

import { nearestVertex } from "./mouth_light.js";
import type { Pose, Scene, State } from "./protocol.js";

const unit = "AU12";
const corners = { left: "ch_l", right: "ch_r" };

export interface SmileActions {
  override(channel: string, value: number): void;
  say(text: string): void;
  reveal(channel: string): void;
}

export class SmileTest {
  private wanted = false; ///< when the next scene comes
  private scene: Scene | null = null; ///< while the test runs
  private rests = false;

  constructor(private readonly actions: SmileActions) {}

  /// Before a rig is opened.
  want(): void {
    this.wanted = true;
  }

  useScene(scene: Scene): void {
    this.scene = this.wanted ? scene : null;
    this.rests = false;
    if (this.wanted) {
      this.actions.reveal(unit);
      this.actions.override(unit, 1);
    }
    this.wanted = false;
  }

  /// Comes before the pose of the same moment.
  useState(state: State): void {
    this.rests = state.resting && state.overrides[unit] === 1;
  }

  usePose(pose: Pose): void {
    if (!this.scene || !this.rests) return;
    const way = Object.entries(corners).map(([side, id]) => `${side} ${movedBy_mm(this.scene!, pose, id).toFixed(1)} mm`);
    this.actions.say(`Smile test: with ${unit} at 1 the corners of the mouth move, ${way.join(", ")}. “Release all” ends it.`);
    this.scene = null;
  }
}

/// How far the vertex at a landmark is from where it is at rest, mm.
function movedBy_mm(scene: Scene, pose: Pose, landmark: string): number {
  const nearest = nearestVertex(scene, landmark);
  if (nearest < 0) return 0;
  return 1e3 * Math.hypot(...[0, 1, 2].map((k) => scene.unit_m * pose.vertices[3 * nearest + k] - scene.rest[3 * nearest + k]));
}
