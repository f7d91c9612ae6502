// SPDX-License-Identifier: MIT
/// \file
/// The mesh of a new head with its landmarks: a click puts one, a drag turns the head, a drag of a landmark moves it on the surface.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { Found, Places } from "./landmark_model.js";
import { lean, softwareGl } from "./lean.js";
import type { MeshFrame, Vec } from "./protocol.js";

const viewAngle_deg = 20;
const usualAspect = 0.95; ///< a head and its shoulders
const click_px = 4;
const near_px = 11;
const colours: Record<Found, number> = { placed: 0x57c785, found: 0x57c785, mirrored: 0xffb454, proposed: 0x7fb6f5 };

export interface HeadActions {
  put(at: Vec): void;
  choose(id: string): void;
  key(event: KeyboardEvent): boolean;
}

export class NewHeadStage {
  private readonly renderer = new THREE.WebGLRenderer({ antialias: !softwareGl() });
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(viewAngle_deg, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly lamps = new THREE.Group();
  private readonly markers = new THREE.Group();
  private frame: MeshFrame | null = null;
  private mesh: THREE.Mesh | null = null;
  private pointed: THREE.Mesh | null = null; ///< the group that the list of parts points at
  private skin: THREE.Mesh | null = null; ///< the group that landmarks are put on
  size = 0.25; ///< height of the mesh, in its units
  private chosen = "";
  private places: Places = {};
  private dirty = true;
  private down: { x: number; y: number; moves: boolean } | null = null;

  constructor(
    private readonly place: HTMLElement,
    private readonly actions: HeadActions,
  ) {
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-label", "The mesh. Click puts the landmark, drag turns, arrows move the landmark by half a millimetre, Enter accepts it.");
    place.prepend(canvas);
    this.renderer.setClearColor(0x1b1e23);
    this.scene.add(new THREE.HemisphereLight(0xdfe8f5, 0x4a3f38, 1.4), this.lamps, this.markers);
    for (const [x, y, z, strength] of [[-0.7, 0.8, 1, 2.2], [1, 0.2, 0.7, 1]]) {
      const lamp = new THREE.DirectionalLight(0xffffff, strength);
      lamp.position.set(x, y, z);
      this.lamps.add(lamp);
    }
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => (this.dirty = true));
    new ResizeObserver(() => this.resize()).observe(place);
    this.listen(canvas);
    const draw = () => {
      requestAnimationFrame(draw);
      if (this.dirty && place.clientWidth > 0) this.draw();
    };
    draw();
  }

  /// `roles`: of each group of the mesh.
  use(frame: MeshFrame, roles: string[]): void {
    this.frame = frame;
    this.useRoles(roles);
    const geometry = this.mesh!.geometry;
    geometry.computeBoundingBox();
    const box = geometry.boundingBox!;
    this.size = box.max.y - box.min.y;
    const centre = box.getCenter(new THREE.Vector3());
    this.camera.near = this.size / 100;
    this.camera.far = this.size * 100;
    this.look(centre, new THREE.Vector3(0, 0, 1), 1.15 * this.size);
  }

  /// The triangles of some groups.
  private trianglesOf(groups: { from: number; count: number }[]): THREE.BufferAttribute {
    const parts = groups.map(({ from, count }) => this.frame!.triangles.subarray(3 * from, 3 * (from + count)));
    const triangles = new Uint32Array(parts.reduce((sum, one) => sum + one.length, 0));
    parts.reduce((at, one) => (triangles.set(one, at), at + one.length), 0);
    return new THREE.BufferAttribute(triangles, 1);
  }

  useRoles(roles: string[]): void {
    const frame = this.frame!;
    for (const old of [this.mesh, this.skin])
      if (old) {
        this.scene.remove(old);
        old.geometry.dispose();
      }
    this.point(null);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(frame.vertices, 3));
    // Lashes and hair would hide the lids and the brow. A part whose name says nothing is shown: it may be the skin.
    const drawn = frame.groups.filter((group, index) => !/lash|hair/i.test(group.name) && !roles[index].startsWith("lashes") && (roles[index] !== "hidden" || !group.role));
    geometry.setIndex(this.trianglesOf(drawn.length > 0 ? drawn : frame.groups));
    geometry.computeVertexNormals();
    const material = new THREE.MeshStandardMaterial({ color: 0xc9a48e, roughness: 0.7, side: THREE.DoubleSide });
    this.mesh = new THREE.Mesh(geometry, softwareGl() ? lean(material) : material);
    // Eyes, teeth and lashes have no landmarks. Where no group is known to be skin, the largest is taken.
    const skin = frame.groups.filter((_, index) => roles[index] === "skin");
    const part = new THREE.BufferGeometry();
    part.setAttribute("position", geometry.getAttribute("position"));
    part.setIndex(this.trianglesOf(skin.length > 0 ? skin : [...frame.groups].sort((a, b) => b.count - a.count).slice(0, 1)));
    this.skin = new THREE.Mesh(part, new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }));
    this.skin.visible = false;
    this.scene.add(this.mesh, this.skin);
    this.dirty = true;
  }

  /// Marks a group through everything that is in front of it; null: none.
  point(group: number | null): void {
    if (this.pointed) {
      this.scene.remove(this.pointed);
      this.pointed.geometry.dispose();
      this.pointed = null;
    }
    if (group !== null && this.frame) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", this.mesh!.geometry.getAttribute("position"));
      geometry.setIndex(this.trianglesOf([this.frame.groups[group]]));
      this.pointed = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: 0x7fb6f5, transparent: true, opacity: 0.45, depthTest: false, side: THREE.DoubleSide }));
      this.scene.add(this.pointed);
    }
    this.dirty = true;
  }

  focus(): void {
    this.renderer.domElement.focus({ preventScroll: true });
  }

  private look(target: THREE.Vector3, direction: THREE.Vector3, height: number): void {
    // On an upright screen, the width of the head decides.
    const distance = height / 2 / Math.tan((viewAngle_deg * Math.PI) / 360) / Math.min(1, this.camera.aspect / usualAspect);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction.normalize(), distance);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    // A click may come before the next picture.
    this.camera.updateMatrixWorld();
    this.dirty = true;
  }

  /// Flies to a place: seen from `direction`, `height` high.
  fly(target: Vec, direction: Vec, height: number): void {
    this.look(new THREE.Vector3(...target), new THREE.Vector3(...direction), height);
  }

  show(places: Places, chosen: string): void {
    this.places = places;
    this.chosen = chosen;
    this.markers.clear();
    for (const [id, place] of Object.entries(places)) {
      const marker = new THREE.Mesh(new THREE.SphereGeometry(1, 14, 10), new THREE.MeshBasicMaterial({ color: id === chosen ? 0xffffff : colours[place.found] }));
      marker.position.set(...place.at);
      marker.name = id;
      this.markers.add(marker);
    }
    this.dirty = true;
  }

  private resize(): void {
    const [width, height] = [Math.max(1, this.place.clientWidth), Math.max(1, this.place.clientHeight)];
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  private draw(): void {
    this.dirty = false;
    this.lamps.quaternion.copy(this.camera.quaternion);
    const px = (2 * Math.tan((viewAngle_deg * Math.PI) / 360)) / Math.max(1, this.place.clientHeight);
    for (const marker of this.markers.children) marker.scale.setScalar((marker.name === this.chosen ? 5.5 : 4) * px * marker.position.distanceTo(this.camera.position));
    this.renderer.render(this.scene, this.camera);
  }

  // Places

  private pick(event: { clientX: number; clientY: number }): Vec | null {
    if (!this.skin) return null;
    const box = this.renderer.domElement.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height), this.camera);
    // The raycaster leaves out what is not visible by its layers, not by `visible`.
    const hit = ray.intersectObject(this.skin, false)[0];
    return hit ? (hit.point.toArray() as Vec) : null;
  }

  screenOf(at: Vec): { x: number; y: number } {
    const box = this.renderer.domElement.getBoundingClientRect();
    const p = new THREE.Vector3(...at).project(this.camera);
    return { x: box.left + ((p.x + 1) / 2) * box.width, y: box.top + ((1 - p.y) / 2) * box.height };
  }

  private markerAt(event: PointerEvent): string | null {
    let [best, least] = [null as string | null, near_px];
    for (const [id, place] of Object.entries(this.places)) {
      const at = this.screenOf(place.at);
      const far = Math.hypot(at.x - event.clientX, at.y - event.clientY);
      if (far < least) [best, least] = [id, far];
    }
    return best;
  }

  /// The nearest point of the surface: on the triangles around the nearest vertex.
  snap(p: Vec): Vec {
    if (!this.skin) return p;
    const position = this.skin.geometry.getAttribute("position") as THREE.BufferAttribute;
    const index = this.skin.geometry.getIndex()!.array;
    const array = position.array as Float32Array;
    let [nearest, least] = [-1, Infinity];
    for (let i = 0; i < index.length; i++) {
      const v = 3 * index[i];
      const far = (array[v] - p[0]) ** 2 + (array[v + 1] - p[1]) ** 2 + (array[v + 2] - p[2]) ** 2;
      if (far < least) [nearest, least] = [index[i], far];
    }
    const point = new THREE.Vector3(...p);
    const best = new THREE.Vector3().fromBufferAttribute(position, nearest);
    const triangle = new THREE.Triangle();
    const on = new THREE.Vector3();
    for (let i = 0; i < index.length; i += 3) {
      if (index[i] !== nearest && index[i + 1] !== nearest && index[i + 2] !== nearest) continue;
      triangle.setFromAttributeAndIndices(position, index[i], index[i + 1], index[i + 2]);
      triangle.closestPointToPoint(point, on);
      if (on.distanceToSquared(point) < best.distanceToSquared(point)) best.copy(on);
    }
    return best.toArray() as Vec;
  }

  /// A place moved to the right and up on the screen, on the surface.
  nudged(at: Vec, right: number, up: number): Vec {
    const by = new THREE.Vector3(right, up, 0).applyQuaternion(this.camera.quaternion);
    return this.snap([at[0] + by.x, at[1] + by.y, at[2] + by.z]);
  }

  private listen(canvas: HTMLCanvasElement): void {
    // Before the controls of the camera, which listen on the same element.
    this.place.addEventListener(
      "pointerdown",
      (event) => {
        if (event.target !== canvas || event.button !== 0) return;
        canvas.focus({ preventScroll: true });
        const moves = this.chosen !== "" && this.markerAt(event) === this.chosen;
        this.down = { x: event.clientX, y: event.clientY, moves };
        this.controls.enabled = !moves;
      },
      true,
    );
    canvas.addEventListener("pointermove", (event) => {
      if (!this.down?.moves) return;
      const at = this.pick(event);
      const marker = this.markers.getObjectByName(this.chosen);
      if (at && marker) marker.position.set(...at);
      this.dirty = true;
    });
    canvas.addEventListener("pointerup", (event) => {
      const { down } = this;
      this.down = null;
      this.controls.enabled = true;
      if (!down) return;
      const still = Math.hypot(event.clientX - down.x, event.clientY - down.y) < click_px;
      const marker = still ? this.markerAt(event) : null;
      if (marker && marker !== this.chosen) return this.actions.choose(marker);
      if (!still && !down.moves) return;
      const at = this.pick(event);
      if (at) this.actions.put(at);
      else this.show(this.places, this.chosen);
    });
    canvas.addEventListener("keydown", (event) => {
      if (!this.actions.key(event)) return;
      event.preventDefault();
      event.stopPropagation();
    });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }
}
