// SPDX-License-Identifier: MIT
/// \file
/// The stage: camera, pointer and keyboard on the head. A plain drag turns the camera; with Ctrl, or with the hand as tool, it pulls.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { cameras, frame, frameAll } from "./cameras.js";
import { byId, h } from "./dom.js";
import { Head } from "./head.js";
import { softwareGl } from "./lean.js";
import type { Sight } from "./head.js";
import type { Probed } from "./hover.js";
import type { HeldPull, Pose, Scene, Vec } from "./protocol.js";

export interface Pulls {
  begin(pull: number, vertex: number, point_m: Vec): void;
  move(pull: number, point_m: Vec): void;
  end(pull: number): void;
  pick(muscle: string): void;
}

const viewAngle_deg = 14;
const nearest_m = 0.05;
const closeBy_m = 0.4;
const beforeTheFace_m = 0.17;
const keyStep_m = 1e-3;
const keyPull = 900; ///< number of the pull that the keyboard holds
const longPress_ms = 300;

/// A camera on the head, with the element that the pointer moves it on.
interface View {
  element: HTMLElement;
  camera: THREE.PerspectiveCamera;
  controls: OrbitControls;
  named: number; ///< the named camera that it was put to last
  turned: boolean; ///< by the person since then
}

interface Grip {
  view: View;
  pointer: number;
  pull: number;
  vertex: number;
  hand: THREE.Vector3;
  plane: THREE.Plane;
  pinned: boolean;
}

export class Stage {
  head: Head | null = null;
  hand = false; ///< the tool
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly main: View;
  private readonly second: View; ///< beside the main one, when it is shown
  private active: View; ///< the one that was touched last
  private readonly arrows = new THREE.Group();
  private readonly canvas: HTMLCanvasElement;
  private grips: Grip[] = [];
  private nextPull = 1;
  private dirty = true;
  private pressing: { timer: number; id: number } | null = null;
  private lamps = new THREE.Group();
  drawn = 0; ///< pictures drawn, for measurements

  constructor(
    private readonly place: HTMLElement,
    private readonly pulls: Pulls,
  ) {
    this.renderer = new THREE.WebGLRenderer({ antialias: !softwareGl(), powerPreference: "high-performance" });
    this.renderer.outputColorSpace = THREE.SRGBColorSpace;
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.setClearColor(0x1b1e23);
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-label", "The face. Arrows turn it, Shift and arrows move it, plus and minus zoom.");
    place.prepend(this.canvas);
    this.light();
    this.scene.add(this.arrows);
    this.main = this.view(this.canvas);
    this.second = this.view(byId("second"));
    this.active = this.main;
    this.listen();
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
    const draw = () => {
      requestAnimationFrame(draw);
      if (this.dirty) this.draw();
    };
    draw();
  }

  private view(element: HTMLElement): View {
    const camera = new THREE.PerspectiveCamera(viewAngle_deg, 1, nearest_m, 20);
    const controls = new OrbitControls(camera, element);
    controls.enableDamping = false;
    controls.minDistance = 0.15;
    controls.maxDistance = 4;
    controls.addEventListener("change", () => (this.dirty = true));
    const view = { element, camera, controls, named: 0, turned: false };
    controls.addEventListener("start", () => (view.turned = true));
    return view;
  }

  private get views(): View[] {
    return this.second.element.hidden ? [this.main] : [this.main, this.second];
  }

  private viewOf(event: Event): View | null {
    return this.views.find((view) => view.element === event.target) ?? null;
  }

  /// Where a view is in the window.
  private boxOf(view: View): DOMRect {
    const box = view.element.getBoundingClientRect();
    const whole = view === this.second || this.views.length === 1;
    return whole ? box : new DOMRect(box.x, box.y, box.width / 2, box.height);
  }

  /// Shows a named camera beside the main view; null shows the main view alone.
  showSecond(index: number | null): void {
    this.second.element.hidden = index === null;
    if (index === null) this.active = this.main;
    else Object.assign(this.second, { named: index, turned: false });
    this.resize();
  }

  private light(): void {
    this.scene.add(new THREE.HemisphereLight(0xdfe8f5, 0x4a3f38, 1.5));
    const lamp = (x: number, y: number, z: number, strength: number, colour: number) => {
      const light = new THREE.DirectionalLight(colour, strength);
      light.position.set(x, y, z);
      this.lamps.add(light);
    };
    lamp(-0.7, 0.8, 1, 2.7, 0xfff4ea);
    lamp(1, 0.2, 0.7, 1.1, 0xdfeaff);
    lamp(0.5, 0.7, -1, 1.6, 0xe6eeff);
    this.scene.add(this.lamps);
  }

  private setPixels(ratio: number): void {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(Math.max(1, this.place.clientWidth), Math.max(1, this.place.clientHeight), false);
  }

  private draw(): void {
    this.dirty = false;
    const [width, height] = [this.place.clientWidth, this.place.clientHeight];
    const each = width / this.views.length;
    this.renderer.setScissorTest(true);
    this.views.forEach((view, index) => {
      this.clip(view);
      this.renderer.setViewport(index * each, 0, each, height);
      this.renderer.setScissor(index * each, 0, each, height);
      // The light moves with the camera, as in videos.
      this.lamps.quaternion.copy(view.camera.quaternion);
      this.renderer.render(this.scene, view.camera);
    });
    this.placeLabels();
    this.drawn++;
    this.place.dataset.drawn = String(this.drawn);
  }

  /// From near by, what stands in the way to the face, a shoulder, is left out.
  private clip({ camera, controls }: View): void {
    const distance_m = camera.position.distanceTo(controls.target);
    const kept_m = beforeTheFace_m + 2 * Math.max(0, distance_m - closeBy_m);
    const near_m = Math.max(nearest_m, distance_m - kept_m);
    if (Math.abs(near_m - camera.near) < 1e-4) return;
    camera.near = near_m;
    camera.updateProjectionMatrix();
  }

  private resize(): void {
    const width = Math.max(1, this.place.clientWidth);
    const height = Math.max(1, this.place.clientHeight);
    this.setPixels(Math.min(window.devicePixelRatio, 2));
    for (const view of this.views) {
      view.camera.aspect = width / this.views.length / height;
      view.camera.updateProjectionMatrix();
      // What the person looks at stays.
      if (!view.turned) this.put(view, view.named);
    }
    this.dirty = true;
  }

  use(scene: Scene): void {
    if (this.head) this.scene.remove(this.head.group);
    this.head = new Head(scene, softwareGl());
    this.scene.add(this.head.group);
    this.grips = [];
    for (const view of this.views) this.put(view, view.named);
  }

  take(pose: Pose): void {
    this.head?.take(pose);
    this.dirty = true;
  }

  changed(): void {
    this.dirty = true;
  }

  show(sight: Sight): void {
    this.head?.show(sight);
    this.dirty = true;
  }

  /// Puts the main view to a named camera.
  look(index: number): void {
    this.put(this.main, index);
  }

  private put(view: View, index: number): void {
    Object.assign(view, { named: index, turned: false });
    if (!this.head) return;
    const { camera, controls } = view;
    const { landmarks, rest } = this.head.scene;
    const framed = landmarks.v ? frame(cameras[index], landmarks, camera.aspect) : frameAll(cameras[index], rest, camera.aspect);
    const distance = framed.height_m / 2 / Math.tan((viewAngle_deg * Math.PI) / 360);
    controls.target.copy(framed.target);
    camera.position.copy(framed.target).addScaledVector(framed.direction, distance);
    camera.lookAt(framed.target);
    controls.update();
    this.dirty = true;
  }

  // Pulling

  private ray(event: { clientX: number; clientY: number }, view: View): THREE.Raycaster {
    const box = this.boxOf(view);
    const x = (2 * (event.clientX - box.left)) / box.width - 1;
    const y = 1 - (2 * (event.clientY - box.top)) / box.height;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(x, y), view.camera);
    ray.near = view.camera.near;
    return ray;
  }

  private vertexAt(event: { clientX: number; clientY: number }, view: View): number {
    if (!this.head) return -1;
    const hit = this.ray(event, view).intersectObjects(this.head.skinMeshes, false)[0];
    if (!hit || !hit.face) return -1;
    let nearest = -1;
    let least = Infinity;
    for (const corner of [hit.face.a, hit.face.b, hit.face.c]) {
      const vertex = this.head.sharedVertex(hit.object, corner);
      const far = this.head.point(vertex).distanceToSquared(hit.point);
      if (far < least && this.head.scene.soft[vertex]) [nearest, least] = [vertex, far];
    }
    return nearest;
  }

  private grab(view: View, vertex: number, pointer: number, pull: number): Grip {
    const hand = this.head!.point(vertex);
    const normal = view.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, hand);
    const grip = { view, pointer, pull, vertex, hand, plane, pinned: false };
    this.grips.push(grip);
    this.pulls.begin(pull, this.head!.scene.vertex[vertex], hand.toArray() as Vec);
    return grip;
  }

  private start(event: PointerEvent, view: View): boolean {
    const vertex = this.vertexAt(event, view);
    if (vertex < 0) return false;
    this.steerable(false);
    view.element.setPointerCapture(event.pointerId);
    this.grab(view, vertex, event.pointerId, this.nextPull++);
    this.place.classList.add("pulling");
    return true;
  }

  /// Whether the pointer moves the cameras.
  private steerable(yes: boolean): void {
    for (const view of [this.main, this.second]) view.controls.enabled = yes;
  }

  private letGo(grip: Grip): void {
    this.pulls.end(grip.pull);
    this.grips = this.grips.filter((one) => one !== grip);
  }

  private listen(): void {
    const place = this.place;
    // Before the controls of the camera, which listen on the elements of the views.
    place.addEventListener(
      "pointerdown",
      (event) => {
        const view = this.viewOf(event);
        if (!view || event.button !== 0) return;
        this.active = view;
        view.element.focus({ preventScroll: true });
        this.pickMuscle(event, view);
        if ((event.ctrlKey || event.metaKey || this.hand) && this.start(event, view)) {
          event.stopPropagation();
          return;
        }
        if (event.pointerType !== "touch") return;
        const timer = window.setTimeout(() => {
          this.pressing = null;
          if (this.start(event, view)) navigator.vibrate?.(10);
        }, longPress_ms);
        this.pressing = { timer, id: event.pointerId };
      },
      true,
    );
    place.addEventListener("pointermove", (event) => {
      const grip = this.grips.find((one) => one.pointer === event.pointerId && !one.pinned);
      if (grip) {
        const to = this.ray(event, grip.view).ray.intersectPlane(grip.plane, new THREE.Vector3());
        if (!to) return;
        grip.hand.copy(to);
        this.pulls.move(grip.pull, to.toArray() as Vec);
      } else if (this.pressing && Math.hypot(event.movementX, event.movementY) > 3) {
        clearTimeout(this.pressing.timer);
        this.pressing = null;
      }
    });
    const up = (event: PointerEvent) => {
      if (this.pressing) clearTimeout(this.pressing.timer);
      this.pressing = null;
      for (const grip of this.grips.filter((one) => one.pointer === event.pointerId && !one.pinned)) this.letGo(grip);
      if (!this.grips.some((one) => !one.pinned)) {
        this.steerable(true);
        this.place.classList.remove("pulling");
      }
    };
    place.addEventListener("pointerup", up);
    place.addEventListener("pointercancel", up);
    place.addEventListener(
      "wheel",
      (event) => {
        const grip = this.grips.find((one) => !one.pinned && one.pointer >= 0);
        if (!grip) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        this.deeper(grip, -Math.sign(event.deltaY) * keyStep_m);
      },
      { capture: true, passive: false },
    );
    for (const { element } of [this.main, this.second]) {
      element.addEventListener("keydown", (event) => this.key(event));
      element.addEventListener("focus", () => (this.active = this.viewOf({ target: element } as unknown as Event) ?? this.main));
      element.addEventListener("contextmenu", (event) => event.preventDefault());
    }
    const canvas = this.canvas;
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => (this.dirty = true));
  }

  /// What is under the pointer, for its label.
  probe(event: { clientX: number; clientY: number; target?: EventTarget | null }): Probed | null {
    const view = this.views.find((one) => one.element === event.target) ?? this.main;
    if (!this.head || this.grips.some((one) => !one.pinned)) return null;
    const muscles = this.head.muscles;
    const hit = this.ray(event, view).intersectObjects(muscles.map((m) => m.mesh), false)[0];
    const found = hit && muscles.find((m) => m.mesh === hit.object);
    if (found) return { muscle: found.name, column: found.column };
    const vertex = this.vertexAt(event, view);
    return vertex < 0 ? null : { vertex };
  }

  highlight(muscle: string | null): void {
    this.head?.highlight(muscle);
    this.dirty = true;
  }

  private pickMuscle(event: PointerEvent, view: View): void {
    if (!this.head || event.ctrlKey || this.hand) return;
    const muscles = this.head.muscles;
    const hit = this.ray(event, view).intersectObjects(muscles.map((m) => m.mesh), false)[0];
    const found = hit && muscles.find((m) => m.mesh === hit.object);
    if (found) this.pulls.pick(found.name);
  }

  private deeper(grip: Grip, by_m: number): void {
    const towards = grip.view.camera.getWorldDirection(new THREE.Vector3()).multiplyScalar(-by_m);
    grip.hand.add(towards);
    grip.plane.setFromNormalAndCoplanarPoint(grip.plane.normal, grip.hand);
    this.pulls.move(grip.pull, grip.hand.toArray() as Vec);
  }

  /// Takes the skin at a landmark, for the keyboard. False when tissue does not move it.
  grabLandmark(id: string): boolean {
    if (!this.head) return false;
    const at = this.head.scene.landmarks[id];
    let nearest = -1;
    let least = Infinity;
    for (let v = 0; at && v < this.head.scene.vertices; v++) {
      if (!this.head.scene.soft[v]) continue;
      const rest = this.head.scene.rest;
      const far = Math.hypot(rest[3 * v] - at[0], rest[3 * v + 1] - at[1], rest[3 * v + 2] - at[2]);
      if (far < least) [nearest, least] = [v, far];
    }
    if (nearest < 0 || least > 5e-3) return false;
    this.letGoOfAll();
    this.grab(this.main, nearest, -1, keyPull);
    this.canvas.focus();
    return true;
  }

  letGoOfAll(): void {
    for (const grip of [...this.grips]) this.letGo(grip);
    this.steerable(true);
    this.place.classList.remove("pulling");
  }

  private key(event: KeyboardEvent): void {
    const grip = this.grips.find((one) => !one.pinned);
    const arrows: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const arrow = arrows[event.key];
    if (event.key === "Escape") {
      this.letGoOfAll();
    } else if (grip && (event.key === "p" || event.key === "P")) {
      grip.pinned = true;
      this.steerable(true);
    } else if (grip && arrow && grip.pointer < 0) {
      const right = new THREE.Vector3(1, 0, 0).applyQuaternion(grip.view.camera.quaternion);
      const up = new THREE.Vector3(0, 1, 0).applyQuaternion(grip.view.camera.quaternion);
      grip.hand.addScaledVector(right, arrow[0] * keyStep_m).addScaledVector(up, arrow[1] * keyStep_m);
      this.pulls.move(grip.pull, grip.hand.toArray() as Vec);
    } else if (grip && (event.key === "PageUp" || event.key === "PageDown")) {
      this.deeper(grip, event.key === "PageUp" ? keyStep_m : -keyStep_m);
    } else if (arrow && event.shiftKey) {
      this.pan(arrow[0], arrow[1]);
    } else if (arrow) {
      this.turn(arrow[0], arrow[1]);
    } else if (event.key === "+" || event.key === "=" || event.key === "-") {
      this.zoom(event.key === "-" ? 1.1 : 1 / 1.1);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  private turn(x: number, y: number): void {
    const { camera, controls } = this.active;
    const sphere = new THREE.Spherical().setFromVector3(camera.position.clone().sub(controls.target));
    sphere.theta += (x * 5 * Math.PI) / 180;
    sphere.phi = Math.min(Math.PI - 0.05, Math.max(0.05, sphere.phi - (y * 5 * Math.PI) / 180));
    camera.position.setFromSpherical(sphere).add(controls.target);
    this.moved();
  }

  private pan(x: number, y: number): void {
    const { camera, controls } = this.active;
    const by = new THREE.Vector3(x, y, 0).multiplyScalar(0.01).applyQuaternion(camera.quaternion);
    camera.position.add(by);
    controls.target.add(by);
    this.moved();
  }

  zoom(factor: number): void {
    const { camera, controls } = this.active;
    camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
    this.moved();
  }

  private moved(): void {
    this.active.turned = true;
    this.active.controls.update();
    this.dirty = true;
  }

  // The arrows of the pulls, with their numbers

  private labels: { element: HTMLElement; at: THREE.Vector3 }[] = [];

  showPulls(held: HeldPull[]): void {
    if (held.length === 0 && this.labels.length === 0) return;
    this.arrows.clear();
    for (const { element } of this.labels) element.remove();
    this.labels = [];
    for (const pull of held) {
      const point = new THREE.Vector3(...pull.point_m);
      const hand = new THREE.Vector3(...pull.hand_m);
      const line = new THREE.Line(
        new THREE.BufferGeometry().setFromPoints([point, hand]),
        new THREE.LineBasicMaterial({ color: 0xffb454, depthTest: false }),
      );
      const ball = (at: THREE.Vector3, radius: number, colour: number) => {
        const mesh = new THREE.Mesh(
          new THREE.SphereGeometry(radius, 12, 8),
          new THREE.MeshBasicMaterial({ color: colour, depthTest: false }),
        );
        mesh.position.copy(at);
        mesh.renderOrder = 10;
        return mesh;
      };
      line.renderOrder = 9;
      this.arrows.add(line, ball(point, 1.2e-3, 0xffffff), ball(hand, 1.8e-3, 0xffb454));
      const text = `${pull.force_n.toFixed(2)} N   ${pull.moved_mm.toFixed(1)} mm`;
      const element = h("div", { class: "pull-label", "data-pull": pull.pull }, text);
      byId("labels").append(element);
      this.labels.push({ element, at: hand });
    }
    this.dirty = true;
  }

  private placeLabels(): void {
    for (const { element, at } of this.labels) {
      const p = at.clone().project(this.main.camera);
      const x = ((p.x + 1) / 2) * (this.place.clientWidth / this.views.length);
      const y = ((1 - p.y) / 2) * this.place.clientHeight;
      element.style.transform = `translate(${Math.round(x + 14)}px, ${Math.round(y - 12)}px)`;
    }
  }

  /// Where a vertex of the mesh is on the screen, px in the window: for tests and the keyboard.
  screenOf(meshVertex: number, inSecond = false): { x: number; y: number } | null {
    if (!this.head) return null;
    const v = this.head.scene.vertex.indexOf(meshVertex);
    if (v < 0) return null;
    const view = inSecond ? this.second : this.main;
    const p = this.head.point(v).project(view.camera);
    const box = this.boxOf(view);
    return { x: box.left + ((p.x + 1) / 2) * box.width, y: box.top + ((1 - p.y) / 2) * box.height };
  }
}
