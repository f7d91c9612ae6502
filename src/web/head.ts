// SPDX-License-Identifier: MIT
/// \file
/// The head as three.js draws it: surfaces over shared vertices, muscles, and the sights skin, wire, muscles and strain.

import * as THREE from "three";

import { lean } from "./lean.js";
import { isInMouth, MouthLight } from "./mouth_light.js";
import type { Motion, Muscles, Picture, Pose, Scene, Skull } from "./protocol.js";

export type Sight = "skin" | "wire" | "muscles" | "strain" | "skull";

interface Part {
  material: string;
  texture: number; ///< of the pictures of the mesh, or -1
  vertex: Uint32Array;
  position: THREE.BufferAttribute;
  normal: THREE.BufferAttribute;
  colour: THREE.BufferAttribute | null; ///< of strains on the skin; of light in the mouth
  mesh: THREE.Mesh;
  skin: boolean;
}

/// The colour of an activation, as `--show muscles` has it: CIE L*C*h from dark red to light yellow.
export function activationColour(activation: number): THREE.Color {
  const a = Math.min(1, Math.max(0, activation));
  const L = 24 + a * 64;
  const hue = ((32 + a ** 1.2 * 58) * Math.PI) / 180;
  const C = 34 + 42 * Math.sin(0.62 * Math.PI * a);
  const fy = (L + 16) / 116;
  const fx = fy + (C * Math.cos(hue)) / 500;
  const fz = fy - (C * Math.sin(hue)) / 200;
  const inverse = (f: number) => (f > 6 / 29 ? f ** 3 : 3 * (6 / 29) ** 2 * (f - 4 / 29));
  const [x, y, z] = [0.95047 * inverse(fx), inverse(fy), 1.08883 * inverse(fz)];
  const clip = (v: number) => Math.min(1, Math.max(0, v));
  return new THREE.Color(
    clip(3.2406 * x - 1.5372 * y - 0.4986 * z),
    clip(-0.9689 * x + 1.8758 * y + 0.0415 * z),
    clip(0.0557 * x - 0.204 * y + 1.057 * z),
  );
}

/// Strands from the lid (v = 0.5) up to the tips of the upper lashes and down to those of the lower ones, where the heads of the
/// toolkit have them (headmodel/detail/part_layout.cpp).
function lashes(): THREE.Texture {
  const [width, height] = [1024, 128];
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#000";
  context.fillRect(0, 0, width, height);
  context.fillStyle = "#fff";
  for (const [strands, out, half] of [[95, -1, 3.6], [60, 1, 2.8]])
    for (let i = 0; i < strands; i++) {
      // Evenly spread, and still not regular: the golden ratio
      const at = ((i + 0.5 * ((i * 0.618) % 1)) / strands) * width;
      const length = (height / 2) * (0.55 + 0.45 * ((i * 0.381) % 1));
      context.beginPath();
      context.moveTo(at - half, height / 2);
      context.lineTo(at + half, height / 2);
      context.lineTo(at, height / 2 + out * length);
      context.fill();
    }
  return new THREE.CanvasTexture(canvas);
}

const noValue = [0.45, 0.45, 0.45];

export class Head {
  readonly group = new THREE.Group();
  readonly positions: Float32Array; ///< of the last pose, m
  private readonly normals: Float32Array;
  private readonly triangles: Uint32Array; ///< of all surfaces, over the shared vertices
  private parts: Part[] = [];
  private muscleMeshes: { mesh: THREE.Mesh; column: number; name: string }[] = [];
  private bones: { cranium: THREE.Mesh; mandible: THREE.Mesh } | null = null;
  private musclePosition: THREE.BufferAttribute | null = null;
  private sight: Sight = "skin";
  private readonly plain: Record<string, THREE.Material>;
  private readonly pictured = new Map<string, THREE.Material>(); ///< "eye 0": of the parts with a picture of the mesh
  private readonly strainColours: THREE.Color[];
  private readonly mouthLight: MouthLight;

  constructor(
    readonly scene: Scene,
    private readonly isLean: boolean,
  ) {
    this.positions = scene.rest.slice();
    this.normals = new Float32Array(scene.rest.length);
    this.plain = this.materials();
    this.mouthLight = new MouthLight(scene);
    this.strainColours = scene.strain_colours.map((c) => new THREE.Color().setRGB(...c, THREE.SRGBColorSpace));
    let count = 0;
    for (const s of scene.surfaces) count += s.triangles.length;
    this.triangles = new Uint32Array(count);
    let at = 0;
    for (const s of scene.surfaces) {
      for (const corner of s.triangles) this.triangles[at++] = s.vertex[corner];
      this.parts.push(this.part(s));
    }
    for (const part of this.parts) this.group.add(part.mesh);
    this.show("skin");
    this.refresh(null);
  }

  get skinMeshes(): THREE.Mesh[] {
    return this.parts.filter((p) => p.skin).map((p) => p.mesh);
  }

  /// The vertex of the pose that a corner of a skin mesh stands for.
  sharedVertex(mesh: THREE.Object3D, corner: number): number {
    const part = this.parts.find((p) => p.mesh === mesh);
    return part ? part.vertex[corner] : -1;
  }

  point(vertex: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.positions, 3 * vertex);
  }

  private materials(): Record<string, THREE.Material> {
    const s = this.scene;
    const hasFace = s.landmarks.v !== undefined; // else a soft body, which may be a sheet
    const colour = (rgb: [number, number, number]) => new THREE.Color().setRGB(...rgb, THREE.SRGBColorSpace);
    const lit = (c: THREE.Color | number, roughness: number) =>
      new THREE.MeshStandardMaterial({ color: c, roughness, metalness: 0 });
    // The light that comes through the lips is the colour of its vertices.
    const behindLips = (c: number, roughness: number) => new THREE.MeshStandardMaterial({ color: c, roughness, vertexColors: true });
    return {
      skin: new THREE.MeshStandardMaterial({ color: colour(s.skin_tone), roughness: 0.55, side: hasFace ? THREE.FrontSide : THREE.DoubleSide }),
      eye: lit(0xe9e6e1, 0.18),
      cornea: new THREE.MeshPhongMaterial({
        color: 0x000000,
        specular: 0xffffff,
        shininess: 400,
        transparent: true,
        blending: THREE.AdditiveBlending,
        depthWrite: false,
      }),
      teeth: behindLips(0xd8cdb8, 0.3),
      gums: behindLips(0xa35b57, 0.4),
      tongue: behindLips(0xa8605f, 0.5),
      mouth: behindLips(0x7a3d3b, 0.5),
      lashes: new THREE.MeshStandardMaterial({
        color: colour(s.hair_tone).multiplyScalar(0.4),
        alphaMap: lashes(),
        roughness: 0.9,
        transparent: true,
        side: THREE.DoubleSide,
        depthWrite: false,
      }),
      matte: lit(0x777777, 1),
    };
  }

  private part(s: Scene["surfaces"][number]): Part {
    const geometry = new THREE.BufferGeometry();
    const position = new THREE.BufferAttribute(new Float32Array(3 * s.vertex.length), 3);
    const normal = new THREE.BufferAttribute(new Float32Array(3 * s.vertex.length), 3);
    position.setUsage(THREE.DynamicDrawUsage);
    normal.setUsage(THREE.DynamicDrawUsage);
    geometry.setAttribute("position", position);
    geometry.setAttribute("normal", normal);
    if (s.texcoords.length > 0) geometry.setAttribute("uv", new THREE.BufferAttribute(s.texcoords, 2));
    geometry.setIndex(new THREE.BufferAttribute(s.triangles, 1));
    // The head moves within this; it need not be measured for every pose.
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1);
    const mesh = new THREE.Mesh(geometry, this.plain[s.material] ?? this.plain.matte);
    mesh.frustumCulled = false;
    const light = isInMouth(s.material) ? new THREE.BufferAttribute(new Float32Array(3 * s.vertex.length), 3) : null;
    if (light) geometry.setAttribute("color", light.setUsage(THREE.DynamicDrawUsage));
    mesh.renderOrder = s.material === "cornea" ? 2 : s.material === "lashes" ? 1 : 0;
    return { material: s.material, texture: s.texture, vertex: s.vertex, position, normal, colour: light, mesh, skin: s.material === "skin" };
  }

  /// A picture of a material, or of the mesh by its number.
  usePicture(picture: Picture): void {
    const texture = new THREE.DataTexture(picture.rgba.slice(), picture.width_px, picture.height_px, THREE.RGBAFormat);
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.flipY = false;
    // Rows come from the top, and texture coordinates begin at the lower left corner.
    texture.repeat.set(1, -1);
    texture.offset.set(0, 1);
    const ofMesh = /^\d+$/.test(picture.material);
    texture.wrapS = texture.wrapT = ofMesh ? THREE.RepeatWrapping : THREE.ClampToEdgeWrapping;
    texture.generateMipmaps = true;
    texture.minFilter = this.isLean ? THREE.LinearMipmapNearestFilter : THREE.LinearMipmapLinearFilter;
    texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    const parts = this.parts.filter((part) => ofMesh && part.texture === Number(picture.material));
    for (const { material } of parts) this.pictured.set(`${material} ${picture.material}`, (this.plain[material] ?? this.plain.matte).clone());
    const materials = ofMesh ? parts.map((part) => this.materialOf(part)) : [this.plain[picture.material]];
    for (const material of materials) this.paint(material as THREE.MeshStandardMaterial | undefined, texture);
    this.show(this.sight);
  }

  private materialOf({ material, texture }: Part): THREE.Material {
    return this.pictured.get(`${material} ${texture}`) ?? this.plain[material] ?? this.plain.matte;
  }

  private paint(material: THREE.MeshStandardMaterial | undefined, texture: THREE.Texture): void {
    if (!material || !("map" in material)) return;
    material.map = texture;
    material.color.set(0xffffff);
    material.needsUpdate = true;
  }

  useMuscles(muscles: Muscles): void {
    for (const { mesh } of this.muscleMeshes) this.group.remove(mesh);
    this.musclePosition = new THREE.BufferAttribute(muscles.rest.slice(), 3);
    const normal = new THREE.BufferAttribute(new Float32Array(muscles.rest.length), 3);
    this.muscleMeshes = muscles.parts.map((part) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", this.musclePosition!);
      geometry.setAttribute("normal", normal);
      geometry.setIndex(new THREE.BufferAttribute(part.triangles.slice(), 1));
      geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 1);
      const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ roughness: 0.6, flatShading: true }));
      mesh.frustumCulled = false;
      this.group.add(mesh);
      const name = part.muscle + (part.side ? `.${part.side}` : "");
      return { mesh, column: part.column, name };
    });
    this.show(this.sight);
  }

  useSkull(skull: Skull): void {
    const bone = ({ vertices, triangles }: Skull["cranium"]) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
      geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
      geometry.computeVertexNormals();
      const material = new THREE.MeshStandardMaterial({ color: 0xe4d9c3, roughness: 0.8 });
      const mesh = new THREE.Mesh(geometry, this.isLean ? lean(material) : material);
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    };
    if (this.bones) this.group.remove(this.bones.cranium, this.bones.mandible);
    this.bones = { cranium: bone(skull.cranium), mandible: bone(skull.mandible) };
    this.show(this.sight);
  }

  get hasSkull(): boolean {
    return this.bones !== null;
  }

  /// Where a point of the mandible at rest is now: for tests.
  mandiblePoint(at: [number, number, number]): THREE.Vector3 | null {
    return this.bones && new THREE.Vector3(...at).applyMatrix4(this.bones.mandible.matrix);
  }

  /// Lets a muscle shine that the pointer is on.
  highlight(name: string | null): void {
    for (const one of this.muscleMeshes)
      (one.mesh.material as THREE.MeshStandardMaterial).emissive.set(one.name === name ? 0x2a4a78 : 0x000000);
  }

  get muscles(): { mesh: THREE.Mesh; name: string; column: number }[] {
    return this.sight === "muscles" ? this.muscleMeshes : [];
  }

  show(sight: Sight): void {
    this.sight = sight;
    for (const part of this.parts) {
      const skin = part.material === "skin";
      let material = this.materialOf(part);
      if (skin && sight === "wire")
        material = new THREE.MeshBasicMaterial({ color: 0x9fc7f0, wireframe: true, transparent: true, opacity: 0.5 });
      if (skin && sight === "strain") {
        part.colour ??= new THREE.BufferAttribute(new Float32Array(3 * part.vertex.length).fill(0.45), 3);
        part.mesh.geometry.setAttribute("color", part.colour);
        material = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.8 });
      }
      if (skin && (sight === "muscles" || sight === "skull"))
        material = new THREE.MeshStandardMaterial({
          color: 0xbfa89a,
          roughness: 0.5,
          transparent: true,
          opacity: 0.22,
          depthWrite: false,
        });
      part.mesh.material = this.isLean && !(material instanceof THREE.MeshBasicMaterial) ? lean(material) : material;
      const hidden = (part.material === "lashes" && sight !== "skin") || (part.material === "cornea" && this.isLean);
      part.mesh.visible = !hidden;
    }
    for (const { mesh } of this.muscleMeshes) mesh.visible = sight === "muscles";
    for (const mesh of this.bones ? Object.values(this.bones) : []) mesh.visible = sight === "skull";
  }

  take(pose: Pose): void {
    const unit = this.scene.unit_m;
    for (let i = 0; i < this.positions.length; i++) this.positions[i] = unit * pose.vertices[i];
    if (pose.muscles && this.musclePosition) {
      const array = this.musclePosition.array as Float32Array;
      for (let i = 0; i < array.length; i++) array[i] = unit * pose.muscles[i];
      this.musclePosition.needsUpdate = true;
    }
    if (this.sight === "muscles")
      for (const { mesh, column } of this.muscleMeshes)
        (mesh.material as THREE.MeshStandardMaterial).color.copy(
          activationColour(column < 0 ? 0 : pose.activation[column] / 127),
        );
    if (this.bones) {
      const matrix = ({ turn, at_m }: Motion) => new THREE.Matrix4().compose(new THREE.Vector3(...at_m), new THREE.Quaternion(...turn), new THREE.Vector3(1, 1, 1));
      this.bones.cranium.matrix.copy(matrix(pose.head));
      this.bones.mandible.matrix.copy(matrix(pose.head).multiply(matrix(pose.mandible)));
    }
    this.refresh(this.sight === "strain" ? pose.strain : null);
  }

  private refresh(strain: Int8Array | null): void {
    const { positions: p, normals: n, triangles: t } = this;
    n.fill(0);
    for (let i = 0; i < t.length; i += 3) {
      const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
      const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      n[a] += x; n[a + 1] += y; n[a + 2] += z;
      n[b] += x; n[b + 1] += y; n[b + 2] += z;
      n[c] += x; n[c + 1] += y; n[c + 2] += z;
    }
    for (const part of this.parts) {
      const position = part.position.array as Float32Array;
      const normal = part.normal.array as Float32Array;
      for (let i = 0; i < part.vertex.length; i++) {
        const from = 3 * part.vertex[i];
        const to = 3 * i;
        position[to] = p[from]; position[to + 1] = p[from + 1]; position[to + 2] = p[from + 2];
        normal[to] = n[from]; normal[to + 1] = n[from + 1]; normal[to + 2] = n[from + 2];
        const length = Math.hypot(normal[to], normal[to + 1], normal[to + 2]) || 1;
        normal[to] /= length; normal[to + 1] /= length; normal[to + 2] /= length;
      }
      part.position.needsUpdate = true;
      part.normal.needsUpdate = true;
      if (part.colour && isInMouth(part.material)) {
        this.mouthLight.write(p, part.vertex, part.colour.array as Float32Array);
        part.colour.needsUpdate = true;
      }
      if (strain && part.skin && part.colour) {
        const colour = part.colour.array as Float32Array;
        for (let i = 0; i < part.vertex.length; i++) {
          const value = strain[part.vertex[i]];
          const c = value === -128 ? null : this.strainColours[Math.round(((value + 127) / 254) * 255)];
          colour[3 * i] = c ? c.r : noValue[0];
          colour[3 * i + 1] = c ? c.g : noValue[1];
          colour[3 * i + 2] = c ? c.b : noValue[2];
        }
        part.colour.needsUpdate = true;
      }
    }
  }
}
