// SPDX-License-Identifier: MIT
/// \file
/// The words that people look for when they mean an action unit, beside its name.

const words: Record<string, string> = {
  AU1: "worry sad eyebrow raise",
  AU2: "surprise eyebrow raise",
  AU4: "frown angry eyebrow knit scowl",
  AU5: "surprise fear stare wide eyes",
  AU6: "smile joy happy squint crow's feet",
  AU7: "squint narrow eyes",
  AU9: "disgust sniff",
  AU10: "disgust snarl sneer",
  AU11: "sad nasolabial furrow",
  AU12: "smile grin joy happy mouth corner",
  AU13: "smile smug puff",
  AU14: "contempt smirk dimple",
  AU15: "frown sad mouth corner down",
  AU16: "teeth lower lip down",
  AU17: "pout chin boss",
  AU18: "pucker kiss whistle",
  AU20: "fear stretch grimace",
  AU22: "funnel sh shout",
  AU23: "angry tight lips",
  AU24: "angry press lips",
  AU25: "open mouth lips apart",
  AU26: "open mouth jaw",
  AU27: "open mouth yawn scream jaw",
  AU28: "suck lips roll in",
  AU34: "puff cheeks blow",
  AU43: "shut eyes sleep",
  AU45: "shut eyes",
  AU46: "one eye",
};

export function everydayWords(channel: string): string {
  return words[channel] ?? "";
}
