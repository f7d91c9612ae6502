// SPDX-License-Identifier: MIT
/// \file
/// What is seen on the stage, as a sentence for those who do not see it.

import type { Pose, State } from "./protocol.js";

export function sentenceOf(now: State, pose: Pose, columns: string[]): string {
  const strong = columns
    .map((name, column) => ({ name, value: pose.activation[column] / 127 }))
    .filter((one) => one.value > 0.1)
    .sort((a, b) => b.value - a.value)
    .slice(0, 3)
    .map((one) => `${one.name.replace(/\.l$/, " left").replace(/\.r$/, " right").replaceAll("_", " ")} ${one.value.toFixed(1)}`);
  const pulls = now.pulls.map((pull) => `pulled by ${pull.moved_mm.toFixed(1)} mm with ${pull.force_n.toFixed(2)} N`);
  return [...strong, ...pulls].join(", ");
}
