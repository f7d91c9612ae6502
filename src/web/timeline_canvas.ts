// SPDX-License-Identifier: MIT
/// \file
/// What the rows of the timeline draw: curves, the ruler, and the sound with its phones.

import { clamp, shown } from "./dom.js";

/// What is said: times of the script, s.
export interface Speech {
  start_s: number;
  phones: [string, number, number][];
  words: [string, number, number][];
  samples: Float32Array | null; ///< of the sound, 1 = full scale
  rate_hz: number;
}

/// A canvas of the size that it is shown at, empty.
export function sized(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  // Small pictures that are drawn anew all the time: the processor is quicker than the way to the graphics processor.
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.scale(ratio, ratio);
  return context;
}

type Of = (value: number) => number;

/// A curve of samples from 0 to the duration, with its area down to `zero`.
export function drawCurve(canvas: HTMLCanvasElement, samples: number[] | undefined, duration_s: number, x: Of, y: Of, zero: number, rgb: string): void {
  const context = sized(canvas);
  if (!samples) return;
  context.beginPath();
  samples.forEach((value, i) => context[i === 0 ? "moveTo" : "lineTo"](x((duration_s * i) / (samples.length - 1)), y(value)));
  context.lineWidth = 1.5;
  context.strokeStyle = `rgb(${rgb})`;
  context.stroke();
  context.lineTo(x(duration_s), y(zero));
  context.lineTo(x(0), y(zero));
  context.fillStyle = `rgba(${rgb}, 0.13)`;
  context.fill();
}

export function drawRuler(canvas: HTMLCanvasElement, x: Of, pxPer_s: number, duration_s: number, computed_s: number): void {
  const context = sized(canvas);
  const height = canvas.clientHeight;
  context.fillStyle = "#3d4450";
  context.fillRect(x(0), height - 4, x(duration_s) - x(0), 3);
  context.fillStyle = "#57c785";
  context.fillRect(x(0), height - 4, x(computed_s) - x(0), 3);
  const steps = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60];
  const step = steps.find((s) => s * pxPer_s > 58) ?? 60;
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "top";
  for (let i = 0; i * step <= duration_s + 1e-9; i++) {
    const at = x(i * step);
    context.fillStyle = "#5a6270";
    context.fillRect(at, height - 10, 1, 6);
    context.fillStyle = "#b3bac4";
    const text = `${shown(i * step)} s`;
    const wide = context.measureText(text).width;
    context.fillText(text, clamp(at + 4, 0, canvas.clientWidth - wide - 2), 4);
  }
}

const wordsHeight = 16;
const phonesHeight = 17;

/// The least and the greatest sample of each pixel, the loudest of all at full height.
function drawWave(context: CanvasRenderingContext2D, speech: Speech, width: number, t: Of, top: number, height: number): void {
  const { samples, rate_hz, start_s } = speech;
  if (!samples) return;
  let peak = 1e-4;
  for (const sample of samples) peak = Math.max(peak, Math.abs(sample));
  context.fillStyle = "#5f9f83";
  const middle = top + height / 2;
  const index = (px: number) => Math.round((t(px) - start_s) * rate_hz);
  for (let px = 0; px < width; px++) {
    const [from, to] = [Math.max(0, index(px)), Math.min(samples.length, Math.max(index(px + 1), index(px) + 1))];
    let [least, most] = [0, 0];
    for (let i = from; i < to; i++) {
      if (samples[i] < least) least = samples[i];
      else if (samples[i] > most) most = samples[i];
    }
    if (from < to) context.fillRect(px, middle - (most / peak) * (height / 2), 1, Math.max(1, ((most - least) / peak) * (height / 2)));
  }
}

/// Words above, the waveform, phones below it with their borders. Names that have no room are left out.
export function drawSpeech(canvas: HTMLCanvasElement, speech: Speech, x: Of, t: Of): void {
  const context = sized(canvas);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  drawWave(context, speech, width, t, wordsHeight, height - wordsHeight - phonesHeight);
  const spans = (list: Speech["phones"], top: number, font: string, colour: string, line: (from: number) => void) => {
    context.font = font;
    context.textBaseline = "top";
    for (const [text, from_s, to_s] of list) {
      const [from, to] = [x(from_s), x(to_s)];
      if (to < 0 || from > width) continue;
      line(from);
      const wide = context.measureText(text).width;
      if (wide > to - from - 2) continue;
      context.fillStyle = colour;
      context.fillText(text, (from + to - wide) / 2, top);
    }
  };
  spans(speech.words, 2, "12px system-ui, sans-serif", "#d4dae2", () => {});
  spans(speech.phones, height - phonesHeight + 2, "12px system-ui, sans-serif", "#9fd3ba", (from) => {
    context.fillStyle = "rgba(159, 211, 186, 0.28)";
    context.fillRect(from, wordsHeight, 1, height - wordsHeight);
  });
}
