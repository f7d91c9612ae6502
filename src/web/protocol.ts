// SPDX-License-Identifier: MIT
/// \file
/// What the engine and the page say to one another, and how binary messages are read (view/pose_frame.h, view/scene_frame.h).

export interface Channel {
  name: string;
  group: string;
  label: string;
  min: number;
  max: number;
  sided: boolean;
  unit: string;
}

export interface Expression {
  name: string;
  onset_s: number;
  hold_s: number;
  offset_s: number;
}

export interface Welcome {
  type: "welcome";
  kind?: "body"; ///< a soft body without channels and script; else a face
  start?: boolean; ///< nothing was named: the list of scripts is shown
  mesh?: string; ///< of which a rig is to be made first
  rig: string;
  file: string | null;
  folder: string;
  quality: string;
  steers: boolean;
  channels: Channel[];
  columns: string[];
  expressions: Expression[];
}

export type Key = [number, number];

export interface Track {
  keys: Key[];
  interpolation?: string;
  activation?: boolean;
}

/// An event as the script has it; one of the first four keys says which.
export interface ScriptEvent {
  expression?: string;
  blink?: Record<string, unknown>;
  idle?: unknown;
  say?: unknown;
  start_s?: number;
  [key: string]: unknown;
}

export interface PullTrack {
  vertex: number;
  stiffness_n_per_m?: number;
  keys_mm: [number, [number, number, number]][];
}

export interface Script {
  duration_s: number;
  fps?: number;
  channels?: Record<string, Track>;
  events?: ScriptEvent[];
  pulls?: PullTrack[];
  [key: string]: unknown;
}

export interface DocumentMessage {
  type: "document";
  script: Script;
  revision: number;
  dirty: boolean;
  undo: boolean;
  redo: boolean;
  duration_s: number;
  curves: Record<string, number[]>;
  recorded?: Record<string, number[]>; ///< muscle activity that was recorded (EMG), as excitation
}

export type Vec = [number, number, number];

export interface HeldPull {
  pull: number;
  vertex: number;
  point_m: Vec;
  hand_m: Vec;
  force_n: number;
  moved_mm: number;
  stiffness_n_per_m: number;
}

export interface State {
  type: "state";
  tick: number;
  t_s: number;
  playing: boolean;
  recording: boolean;
  computing: boolean;
  computed_s: number;
  resting: boolean;
  dirty: boolean;
  step_ms: number;
  overrides: Record<string, number>;
  pulls: HeldPull[];
  selected: { channel?: string; l?: { force_n: number; length_mm: number }; r?: { force_n: number; length_mm: number } };
}

export interface Surface {
  material: string;
  eye: number;
  texture: number;
  vertex: Uint32Array;
  triangles: Uint32Array;
  texcoords: Float32Array;
}

export interface Scene {
  unit_m: number;
  vertices: number;
  vertex: Int32Array;
  rest: Float32Array;
  soft: Uint8Array;
  surfaces: Surface[];
  landmarks: Record<string, Vec>;
  eyes: { centre: Vec; radius_m: number; iris_radius_m: number; pupil_radius_m: number; forward: Vec }[];
  skin_tone: Vec;
  lip_tone: Vec;
  hair_tone: Vec;
  iris_tone: Vec;
  strain_colours: Vec[];
}

export interface Picture {
  material: string; ///< or the number of a picture of the mesh
  width_px: number;
  height_px: number;
  rgba: Uint8Array;
}

export interface Muscles {
  parts: { muscle: string; side: string; column: number; triangles: Uint32Array }[];
  rest: Float32Array;
}

/// A mesh that landmarks are put on.
export interface MeshFrame {
  file: string;
  rig: string; ///< where its rig is written
  vertices: Float32Array;
  triangles: Uint32Array;
  groups: { name: string; from: number; count: number; role: string }[]; ///< ranges of triangles, and the role that the name says, or ""
  roles: string[]; ///< that a group may have
}

/// A rigid motion: a quaternion x, y, z, w, and a translation.
export interface Motion {
  turn: [number, number, number, number];
  at_m: Vec;
}

export interface Bone {
  vertices: Float32Array;
  triangles: Uint32Array;
}

export interface Skull {
  cranium: Bone;
  mandible: Bone;
}

export interface Pose {
  step: number;
  t_s: number;
  head: Motion; ///< from rest, in the world
  mandible: Motion; ///< from rest, in the head
  vertices: Int16Array;
  drive: Int8Array;
  activation: Int8Array;
  strain: Int8Array | null;
  muscles: Int16Array | null;
}

const enum Kind {
  scene = 2,
  picture = 3,
  muscles = 4,
  mesh = 5,
  skull = 6,
  file = 7,
  sound = 0x46464952, // "RIFF": a WAV file as it is
}

export type Binary =
  | { kind: "pose"; pose: Pose }
  | { kind: "scene"; scene: Scene }
  | { kind: "picture"; picture: Picture }
  | { kind: "muscles"; muscles: Muscles }
  | { kind: "mesh"; mesh: MeshFrame }
  | { kind: "skull"; skull: Skull }
  | { kind: "file"; name: string; type: string; bytes: Uint8Array }
  | { kind: "sound"; bytes: ArrayBuffer };

interface Place {
  at: number;
  count: number;
}

function decodePose(data: ArrayBuffer): Pose {
  const view = new DataView(data);
  const flags = view.getUint8(1);
  const columns = view.getUint16(2, true);
  const count = view.getUint32(72, true);
  let at = 76;
  const vertices = new Int16Array(data, at, 3 * count);
  at += 6 * count;
  const drive = new Int8Array(data, at, columns);
  at += columns;
  const activation = new Int8Array(data, at, columns);
  at += columns;
  let strain: Int8Array | null = null;
  if (flags & 1) {
    strain = new Int8Array(data, at, count);
    at += count;
  }
  let muscles: Int16Array | null = null;
  if (flags & 2) {
    const rows = view.getUint32(at, true);
    muscles = new Int16Array(data.slice(at + 4, at + 4 + 6 * rows));
  }
  const motion = (from: number): Motion => {
    const [x, y, z, w, ...at_m] = Array.from({ length: 7 }, (_, i) => view.getFloat32(from + 4 * i, true));
    return { turn: [x, y, z, w], at_m: at_m as Vec };
  };
  return { step: view.getUint32(4, true), t_s: view.getFloat64(8, true), head: motion(16), mandible: motion(44), vertices, drive, activation, strain, muscles };
}

export function decode(data: ArrayBuffer): Binary {
  const view = new DataView(data);
  if (view.getUint8(0) === 1) return { kind: "pose", pose: decodePose(data) };
  const kind = view.getUint32(0, true);
  if (kind === Kind.sound) return { kind: "sound", bytes: data };
  const length = view.getUint32(4, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 8, length)));
  const begin = 8 + length;
  const u32 = (p: Place) => new Uint32Array(data, begin + p.at, p.count);
  const f32 = (p: Place) => new Float32Array(data, begin + p.at, p.count);
  const u8 = (p: Place) => new Uint8Array(data, begin + p.at, p.count);
  if (kind === Kind.scene) {
    const surfaces = head.surfaces.map((s: Record<string, any>) => ({
      ...s,
      vertex: u32(s.vertex),
      triangles: u32(s.triangles),
      texcoords: f32(s.texcoords),
    }));
    const vertex = new Int32Array(data, begin + head.vertex.at, head.vertex.count);
    return { kind: "scene", scene: { ...head, vertex, rest: f32(head.rest), soft: u8(head.soft), surfaces } };
  }
  if (kind === Kind.picture) return { kind: "picture", picture: { ...head, rgba: u8(head.rgba) } };
  if (kind === Kind.muscles) {
    const parts = head.parts.map((p: Record<string, any>) => ({ ...p, triangles: u32(p.triangles) }));
    return { kind: "muscles", muscles: { parts, rest: f32(head.rest) } };
  }
  if (kind === Kind.skull) {
    const bone = (one: Record<string, Place>): Bone => ({ vertices: f32(one.vertices), triangles: u32(one.triangles) });
    return { kind: "skull", skull: { cranium: bone(head.cranium), mandible: bone(head.mandible) } };
  }
  if (kind === Kind.file) return { kind: "file", name: head.name, type: head.type, bytes: u8(head.bytes) };
  if (kind === Kind.mesh) return { kind: "mesh", mesh: { ...head, vertices: f32(head.vertices), triangles: u32(head.triangles) } };
  throw new Error(`a message of an unknown kind ${kind}`);
}
