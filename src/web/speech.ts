// SPDX-License-Identifier: MIT
/// \file
/// The sound of what the face says: it begins with its moment of the script, and follows the playhead.

/// Sound that is off by more than this is moved, s. Less is not heard as a fault of the lips.
const allowed_s = 0.08;
const moment_s = 0.09;

export class SpeechSound {
  private context: AudioContext | null = null;
  private buffer: AudioBuffer | null = null;
  private source: AudioBufferSourceNode | null = null;
  private start_s = 0;
  private moment: AudioBufferSourceNode | null = null;
  scrubbed = 0; ///< moments that have sounded, for tests
  private begun_s = 0; // of the context's clock, less the offset in the sound

  get sounds(): boolean {
    return this.source !== null;
  }

  /// Called in a gesture of a person, without which browsers stay silent.
  allow(): void {
    this.context ??= new AudioContext();
    void this.context.resume();
  }

  /// The sound that comes next begins at this time of the script.
  expect(start_s: number): void {
    this.stop();
    this.buffer = null;
    this.start_s = start_s;
  }

  /// Returns the samples, which may be seen before they may be heard.
  async use(bytes: ArrayBuffer): Promise<{ samples: Float32Array; rate_hz: number }> {
    this.buffer = await new OfflineAudioContext(1, 1, 48000).decodeAudioData(bytes);
    return { samples: this.buffer.getChannelData(0), rate_hz: this.buffer.sampleRate };
  }

  /// Sounds for a moment at a time of the script, while the playhead is drawn.
  scrub(t_s: number): void {
    const { context, buffer } = this;
    const offset_s = t_s - this.start_s;
    if (!context || !buffer || offset_s < 0 || offset_s >= buffer.duration) return;
    this.moment?.stop();
    this.moment = new AudioBufferSourceNode(context, { buffer });
    this.moment.connect(context.destination);
    this.moment.start(0, offset_s, moment_s);
    this.scrubbed++;
  }

  /// Called with each state of the engine.
  follow(t_s: number, playing: boolean): void {
    const { context, buffer } = this;
    if (!context || !buffer) return;
    const offset_s = t_s - this.start_s;
    if (!playing || offset_s < 0 || offset_s >= buffer.duration) return this.stop();
    if (this.source && Math.abs(context.currentTime - this.begun_s - offset_s) < allowed_s) return;
    this.stop();
    this.source = new AudioBufferSourceNode(context, { buffer });
    this.source.connect(context.destination);
    this.source.start(0, offset_s);
    this.begun_s = context.currentTime - offset_s;
  }

  private stop(): void {
    this.source?.stop();
    this.source = null;
  }
}
