#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a picture of the sounds of a language: a mouth with its caption for each.

    tools/docs/phone_sheet.py finnish_vowels docs/howto/speech/finnish_vowels.png

Vowels are said for 0.35 s between pauses, consonants between two a. The picture is taken in the middle of the sound.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Sounds, as said between pauses or between two a, and their captions
SHEETS = {
    "finnish_vowels": ("i y u e o ø æ ɑ", "i y u e o ö ä a", False),
    "finnish_consonants": ("p m f ʋ t n l r s d k h j ŋ", "p m f v t n l r s d k h j ng", True),
    "english_vowels": ("i ɪ e ɛ æ ʌ ə ɝ u ʊ o ɔ ɑ", "IY IH EY EH AE AH AH0 ER UW UH OW AO AA", False),
    "english_consonants_1": ("p m f v θ ð t d n l", "P M F V TH DH T D N L", True),
    "english_consonants_2": ("s z ʃ tʃ ɹ w j k ŋ h", "S Z SH CH R W Y K NG HH", True),
}
CELL_PX = 112


def utterance(sounds, consonants):
    """Phones with their lengths, and the middle of each sound of the sheet, s."""
    phones, middles, now = [], [], 0.0

    def add(symbol, seconds, shown=False):
        nonlocal now
        if shown:
            middles.append(now + seconds / 2)
        phones.append([symbol, seconds])
        now += seconds

    add("_", 0.4)
    for sound in sounds:
        if consonants:
            add("ɑ", 0.2)
            # The closure and the friction of an affricate
            for k, part in enumerate(sound):
                add(part, 0.14, k == len(sound) - 1)
            add("ɑ", 0.2)
        else:
            add(sound, 0.35, True)
        add("_", 0.35)
    return phones, middles, now


def main():
    name, out = sys.argv[1:]
    sounds, captions, consonants = SHEETS[name]
    phones, middles, length = utterance(sounds.split(), consonants)
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / "mouth.json"
        script.write_text(json.dumps({
            "format": "risorius-script", "version": 1, "rig": str(ROOT / "rigs/adult/rig.json"),
            "duration_s": round(length + 0.5, 3), "view": {"camera": "mouth"},
            "events": [{"say": {"phones": phones}, "start_s": 0.0, "sound": "none"}],
        }, ensure_ascii=False))
        subprocess.run([ROOT / "build/risorius", "sheet", script, "--times", ",".join(f"{t:.3f}" for t in middles),
                        "--captions", captions.replace(" ", ","),
                        "--size", f"{CELL_PX}x{CELL_PX}", "--quality", "preview", "--quiet", "-o", out], check=True)
    pathlib.Path(out + ".json").unlink()  # the record of the runs


if __name__ == "__main__":
    main()
