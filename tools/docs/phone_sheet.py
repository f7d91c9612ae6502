#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a picture of all sounds of a language: a column for each, from the front, from three quarters, and the mouth alone.

    tools/docs/phone_sheet.py finnish samples/talk/finnish_phones.png

Vowels are said for 0.35 s between pauses, consonants between two a. The picture is taken in the middle of the sound.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LANGUAGES = {
    "finnish": ["i y u e ø o æ ɑ".split(), "p m f ʋ t n l r s d k h j ŋ".split()],
    "english_vowels": ["i ɪ e ɛ æ ʌ ə ɝ u ʊ o ɔ ɑ".split(), []],
    "english_consonants": [[], "p m f v θ ð t d n l s z ʃ tʃ ɹ w j k ŋ h".split()],
}
CAMERAS = ["front", "three_quarter", "mouth"]
CELL_PX = 96


def utterance(vowels, consonants):
    """Phones with their lengths, and the middle of each sound of the sheet, s."""
    phones, middles, now = [], [], 0.0

    def add(symbol, seconds, shown=False):
        nonlocal now
        if shown:
            middles.append(now + seconds / 2)
        phones.append([symbol, seconds])
        now += seconds

    add("_", 0.4)
    for vowel in vowels:
        add(vowel, 0.35, True)
        add("_", 0.35)
    for consonant in consonants:
        add("ɑ", 0.2)
        # The closure and the friction of an affricate
        parts = list(consonant) if len(consonant) == 2 else [consonant]
        for part in parts:
            add(part, 0.14, part == parts[-1])
        add("ɑ", 0.2)
        add("_", 0.35)
    return phones, middles, now


def main():
    language, out = sys.argv[1:]
    phones, middles, length = utterance(*LANGUAGES[language])
    with tempfile.TemporaryDirectory() as folder:
        scripts = []
        for camera in CAMERAS:
            script = {
                "format": "risorius-script", "version": 1, "rig": str(ROOT / "rigs/adult/rig.json"),
                "duration_s": round(length + 0.5, 3), "view": {"camera": camera},
                "events": [{"say": {"phones": phones}, "start_s": 0.0, "sound": "none"}],
            }
            scripts.append(pathlib.Path(folder) / f"{camera}.json")
            scripts[-1].write_text(json.dumps(script, ensure_ascii=False))
        subprocess.run([ROOT / "build/risorius", "sheet", *scripts, "--times", ",".join(f"{t:.3f}" for t in middles),
                        "--size", f"{CELL_PX}x{CELL_PX}", "--quality", "preview", "--quiet", "-o", out], check=True)
    pathlib.Path(out + ".json").unlink()  # the record of the runs


if __name__ == "__main__":
    main()
