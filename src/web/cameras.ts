// SPDX-License-Identifier: MIT
/// \file
/// The named cameras of `risorius render`, framed by the landmarks of the head in the same way (render/detail/camera.cpp).

import { Box3, Vector3 } from "three";

import type { Vec } from "./protocol.js";

export interface NamedCamera {
  name: string;
  azimuth_deg: number;
  elevation_deg?: number;
  middle?: [string, string];
  height_mm?: number;
}

/// In the order of the keys 1 to 8.
export const cameras: NamedCamera[] = [
  { name: "front", azimuth_deg: 0 },
  { name: "three quarter", azimuth_deg: 38 },
  { name: "three quarter right", azimuth_deg: -38 },
  { name: "profile", azimuth_deg: 90 },
  { name: "profile right", azimuth_deg: -90 },
  { name: "eye", azimuth_deg: 14, middle: ["en_l", "ex_l"], height_mm: 62 },
  { name: "nose", azimuth_deg: 30, elevation_deg: -12, middle: ["prn", "sn"], height_mm: 80 },
  { name: "mouth", azimuth_deg: 16, middle: ["sto", "sto"], height_mm: 74 },
];

const headHeight_mm = 227.5;
const marginAbove = 0.1;
const marginBelow = 0.22;
const marginBeside = 0.1;

export interface View {
  target: Vector3;
  direction: Vector3; ///< from the target to the camera
  height_m: number; ///< of the frame at the target
}

/// A whole object, with half of its size to all sides: it may be pulled.
export function frameAll(camera: NamedCamera, positions: Float32Array, aspect: number): View {
  const box = new Box3().setFromArray(positions);
  const size = box.getSize(new Vector3());
  const height_m = (2 * Math.max(size.x, size.y, size.z)) / Math.min(aspect, 1);
  return { target: box.getCenter(new Vector3()), direction: directionOf(camera), height_m };
}

export function frame(camera: NamedCamera, landmarks: Record<string, Vec>, aspect: number): View {
  const of = (id: string) => new Vector3(...(landmarks[id] ?? [0, 0, 0]));
  const crown = of("v");
  const chin = of("me");
  const height = Math.max(crown.y - chin.y, 0.05);
  const bottom = chin.y - marginBelow * height;
  const top = crown.y + marginAbove * height;
  const azimuth = (camera.azimuth_deg * Math.PI) / 180;
  const half = { x: 0.4 * height, z: 0.46 * height };
  let target = new Vector3((crown.x + chin.x) / 2, (bottom + top) / 2, of("prn").z - half.z);
  const halfWidth = Math.abs(Math.cos(azimuth)) * half.x + Math.abs(Math.sin(azimuth)) * half.z;
  let height_m = Math.max(top - bottom, (2 * halfWidth * (1 + marginBeside)) / aspect);
  if (camera.middle && camera.height_mm) {
    target = of(camera.middle[0]).add(of(camera.middle[1])).multiplyScalar(0.5);
    height_m = ((camera.height_mm / headHeight_mm) * height) / Math.min(aspect, 1);
  }
  return { target, direction: directionOf(camera), height_m };
}

function directionOf(camera: NamedCamera): Vector3 {
  const azimuth = (camera.azimuth_deg * Math.PI) / 180;
  const elevation = ((camera.elevation_deg ?? 0) * Math.PI) / 180;
  return new Vector3(Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation), Math.cos(azimuth) * Math.cos(elevation));
}
