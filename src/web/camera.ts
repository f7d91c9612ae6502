// SPDX-License-Identifier: MIT
/// \file
/// Performs with a camera or a video file: small pictures go to the engine on this computer, one at a time, and what it sees of the
/// face moves the channels. Pictures that come while one is looked at are left out.

import { byId, h } from "./dom.js";

interface CameraChannel {
  name: string;
  reliable: boolean;
  error: number;
}

export interface CameraActions {
  /// Returns what is wrong with the message, or null.
  ask(message: Record<string, unknown>): Promise<string | null>;
  send(message: Record<string, unknown>): void;
  picture(bytes: ArrayBuffer): void;
}

/// What a person can calibrate, and what to do for it.
const poses: Record<string, { name: string; hold: string }> = {
  rest: { name: "Rest", hold: "Look at the camera for two seconds, with a calm face and a closed mouth." },
  brows: { name: "Brows up", hold: "Raise both brows as far as you can, for two seconds." },
  smile: { name: "Smile", hold: "Smile as broadly as you can with a closed mouth, for two seconds." },
  open: { name: "Mouth open", hold: "Open your mouth as far as you can, for two seconds." },
  shut: { name: "Eyes shut", hold: "Shut both eyes for two seconds, without pressing them together." },
};

const longest_px = 480;
const header_bytes = 24;
const pictureKind = 1;
const patience_ms = 4000; ///< an answer that was lost must not stop the camera for ever

export class Camera {
  private readonly panel = byId("camera-panel");
  private readonly video = byId<HTMLVideoElement>("camera-video");
  private readonly canvas = h("canvas");
  private stream: MediaStream | null = null;
  private url = "";
  private on = false; ///< there are pictures, and the engine is ready for them
  private askedAt_ms = -Infinity; ///< when the picture that is looked at was sent
  private calibrated = false;
  private posed = ""; ///< the pose that is being calibrated
  private begun = false; ///< the engine has begun with it
  private ranges: Record<string, string> = {};
  private values: Record<string, number> = {};

  constructor(private readonly actions: CameraActions) {
    const click = (id: string, does: () => void) => byId(id).addEventListener("click", does);
    click("camera-open", () => this.open(this.panel.hidden === true));
    click("camera-close", () => this.open(false));
    click("camera-start", () => void this.useCamera());
    for (const button of this.poseButtons()) button.addEventListener("click", () => this.calibrate(button.dataset.pose!));
    byId("camera-file").addEventListener("change", () => {
      const file = byId<HTMLInputElement>("camera-file").files?.[0];
      if (file) void this.useFile(file);
    });
  }

  private open(yes: boolean): void {
    this.panel.hidden = !yes;
    byId("camera-open").setAttribute("aria-expanded", String(yes));
    if (!yes) this.stop();
    else this.tell("");
  }

  private async useCamera(): Promise<void> {
    this.stop();
    try {
      this.stream = await navigator.mediaDevices.getUserMedia({ video: { width: 640, height: 480, facingMode: "user" } });
    } catch (error) {
      const why = (error as Error).name === "NotAllowedError" ? "The browser was not allowed to use the camera." : "There is no camera that could be used.";
      return this.tell(`${why} A video file does as well.`, true);
    }
    this.video.srcObject = this.stream;
    this.video.classList.add("mirrored");
    await this.begin();
  }

  private async useFile(file: File): Promise<void> {
    this.stop();
    this.url = URL.createObjectURL(file);
    this.video.src = this.url;
    this.video.loop = true;
    this.video.classList.remove("mirrored");
    await this.begin();
  }

  private async begin(): Promise<void> {
    try {
      await this.video.play();
    } catch {
      return this.tell("The browser cannot play this video.", true);
    }
    this.video.hidden = false;
    this.tell("Learning how this face looks to the network…");
    const wrong = await this.actions.ask({ type: "camera", do: "start" });
    if (wrong) this.stop(), this.tell(wrong, true);
  }

  private stop(): void {
    const ran = this.stream !== null || this.url !== "";
    this.on = false;
    for (const track of this.stream?.getTracks() ?? []) track.stop();
    this.stream = null;
    this.video.pause();
    this.video.srcObject = null;
    this.video.removeAttribute("src");
    if (this.url) URL.revokeObjectURL(this.url);
    this.url = "";
    this.video.hidden = true;
    this.values = {};
    byId<HTMLInputElement>("camera-file").value = "";
    byId<HTMLFieldSetElement>("camera-ranges").disabled = true;
    byId("camera-progress").hidden = true;
    byId("camera-values").replaceChildren();
    if (ran) this.actions.send({ type: "camera", do: "stop" });
  }

  private poseButtons(): HTMLButtonElement[] {
    return [...byId("camera-ranges").querySelectorAll<HTMLButtonElement>("button")];
  }

  private calibrate(pose: string): void {
    this.posed = pose;
    this.begun = false;
    this.actions.send({ type: "camera", do: "calibrate", pose });
    this.tell(poses[pose].hold);
  }

  /// What the engine says about the camera.
  useState(message: Record<string, any>): void {
    const progress = byId<HTMLProgressElement>("camera-progress");
    progress.hidden = message.state !== "learning";
    if (message.state === "learning") progress.value = message.fraction;
    if (message.state === "failed") {
      this.stop();
      this.tell(String(message.text), true);
    }
    if (message.state !== "ready" || this.panel.hidden) return;
    const names = (reliable: boolean) => (message.channels as CameraChannel[]).filter((one) => one.reliable === reliable).map((one) => one.name);
    byId("camera-seen").textContent = `Seen: ${names(true).join(", ")}, head.`;
    const unseen = names(false);
    byId("camera-unseen").textContent = unseen.length > 0 ? `Not seen reliably: ${unseen.join(", ")}. They stay with the script.` : "";
    byId<HTMLFieldSetElement>("camera-ranges").disabled = false;
    this.on = true;
    this.calibrated = false;
    this.calibrate("rest");
    this.next();
  }

  /// The engine has looked at a picture.
  usePerformed(message: Record<string, any>): void {
    this.askedAt_ms = -Infinity;
    if (!this.on) return;
    this.values = message.values;
    if (message.score < 0.3) this.tell("There is no face in the picture.", true);
    else if (message.calibrating) {
      this.begun = true;
      this.tell(poses[this.posed || "rest"].hold);
    } else if (message.calibrated) this.tellCalibrated(message.ranges);
    this.calibrated = message.calibrated;
    const list = byId("camera-values");
    const strong = Object.entries(this.values).filter(([name, value]) => Math.abs(value) >= (name.endsWith("_deg") ? 2 : 0.1));
    list.textContent = strong.map(([name, value]) => `${name} ${name.endsWith("_deg") ? `${value.toFixed(0)}°` : value.toFixed(2)}`).join("   ");
    this.next();
  }

  /// A calibration may have ended with this picture.
  private tellCalibrated(ranges: Record<string, string>): void {
    const pose = this.posed;
    this.ranges = ranges;
    for (const button of this.poseButtons()) button.classList.toggle("known", ranges[button.dataset.pose!] === "known");
    if (pose !== "" && !this.begun) return;
    this.posed = "";
    if (pose === "rest") this.tell("The face follows. Show your brows up, a smile, an open mouth and shut eyes, and it follows more exactly. Record (R) makes keys of it.");
    else if (ranges[pose] === "small") this.tell(`${poses[pose].name} was hardly seen, and is not used. Show it with all strength.`, true);
    else if (pose !== "") this.tell(`${poses[pose].name} is calibrated.`);
  }

  /// Sends the picture that is there now, once the engine is free.
  private next(): void {
    if (!this.on) return;
    const again = () => (performance.now() - this.askedAt_ms > patience_ms ? this.sendPicture() : undefined);
    if ("requestVideoFrameCallback" in this.video) this.video.requestVideoFrameCallback(again);
    else requestAnimationFrame(again);
  }

  private sendPicture(): void {
    const { videoWidth, videoHeight } = this.video;
    if (!this.on || videoWidth === 0) return this.next();
    const scale = Math.min(1, longest_px / Math.max(videoWidth, videoHeight));
    const [width, height] = [Math.round(scale * videoWidth), Math.round(scale * videoHeight)];
    this.canvas.width = width;
    this.canvas.height = height;
    const context = this.canvas.getContext("2d", { willReadFrequently: true })!;
    context.drawImage(this.video, 0, 0, width, height);
    const bytes = new Uint8Array(header_bytes + 4 * width * height);
    const head = new DataView(bytes.buffer);
    [pictureKind, width, height, 0].forEach((value, i) => head.setUint32(4 * i, value, true));
    this.askedAt_ms = performance.now();
    head.setFloat64(16, this.askedAt_ms, true);
    bytes.set(context.getImageData(0, 0, width, height).data, header_bytes);
    this.actions.picture(bytes.buffer);
    setTimeout(() => this.on && performance.now() - this.askedAt_ms > patience_ms && this.next(), patience_ms + 100);
  }

  private tell(text: string, bad = false): void {
    const place = byId("camera-told");
    if (place.textContent !== text) place.textContent = text;
    place.classList.toggle("bad", bad);
  }

  /// For tests.
  get debug(): { values: Record<string, number>; calibrated: boolean; on: boolean; ranges: Record<string, string> } {
    return { values: this.values, calibrated: this.calibrated, on: this.on, ranges: this.ranges };
  }
}
