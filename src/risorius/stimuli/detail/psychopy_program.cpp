// SPDX-License-Identifier: MIT
// The text of experiment.py.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

const char* const kProgram = R"py(#!/usr/bin/env python3
"""An experiment with a set of clips, for PsychoPy: an example to start from.

    python experiment.py --participant 7

Every clip is decoded before its fixation cross is shown, and its frames are flipped one by one, each for a whole number of
refreshes of the screen, so that no player decides when a frame is seen. A picture is a clip of one frame. ../triggers.tsv says which codes go out with which
frame. A code stays on the line for whole refreshes, pulse_ms of settings.json at least, and is then taken off. A square in
the lower left corner is white exactly while a code is on the line, and black at all other times, for a photodiode.

It reads settings.json and conditions.csv beside it. Every run writes new files, row by row, and never an old one:
data/sub-P_task-T_run-R_TIME.csv, and ..._events.tsv with ..._events.json as BIDS has them, onsets from the first key on.
"""
import argparse
import csv
import datetime
import json
import math
import os
import random
from pathlib import Path

import imageio
from PIL import Image
from psychopy import core, visual
from psychopy.hardware import keyboard

HERE = Path(__file__).resolve().parent
SIDE_PX = 64


class Triggers:
    """Codes to a serial port, a parallel port (an address like 0x0378), or nowhere; kept for the data in any case."""

    def __init__(self, port):
        self.serial, self.parallel = None, None
        self.sent = []
        if port and port.lower().startswith("0x"):
            from psychopy import parallel

            self.parallel = parallel.ParallelPort(address=int(port, 16))
            self.parallel.setData(0)
        elif port:
            import serial

            self.serial = serial.Serial(port, 115200)

    def send(self, code, clock):
        if self.parallel:
            self.parallel.setData(code)
        elif self.serial:
            self.serial.write(bytes([code]))
        self.sent.append((code, clock.getTime()))


class Screen:
    """Flips with the square of the photodiode, and takes every code off the line after its pulse."""

    def __init__(self, window, rate_hz, triggers, clock, pulse_ms):
        self.window, self.triggers, self.clock = window, triggers, clock
        self.pulse = max(1, math.ceil(pulse_ms * rate_hz / 1000 - 1e-3))
        self.left = 0
        self.square = visual.Rect(
            window, width=SIDE_PX, height=SIDE_PX, lineWidth=0, fillColor="black",
            pos=((SIDE_PX - window.size[0]) / 2, (SIDE_PX - window.size[1]) / 2),
        )

    def flip(self, drawn, code=0):
        """Shows what is drawn for one refresh. A code goes out with it."""
        for one in drawn:
            one.draw()
        was_on = self.left > 0
        self.left = self.pulse if code else max(0, self.left - 1)
        if code:
            self.window.callOnFlip(self.triggers.send, code, self.clock)
        elif was_on and self.left == 0:
            self.window.callOnFlip(self.triggers.send, 0, self.clock)
        self.square.fillColor = "white" if self.left else "black"
        self.square.draw()
        self.window.flip()


def read_conditions():
    with open(HERE / "conditions.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["frames"], row["fps"] = int(row["frames"]), int(row["fps"])
    return rows


def read_codes():
    """The codes of every clip: stim_id -> frame -> code. Moments that share a frame have one code."""
    codes = {}
    with open(HERE / "../triggers.tsv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            if row.get("merged_into", "n/a") == "n/a":
                codes.setdefault(row["stim_id"], {})[int(row["frame"])] = int(row["code"])
    return codes


def load_frames(window, clip):
    """All pictures of a clip as textures; fails when they are not as many as the conditions say."""
    if clip["file"].endswith(".png"):
        return [visual.ImageStim(window, image=Image.open(clip["file"]), units="pix", interpolate=False)]
    with imageio.get_reader(clip["file"], "ffmpeg") as reader:
        frames = [
            visual.ImageStim(window, image=Image.fromarray(frame), units="pix", interpolate=False) for frame in reader
        ]
    if len(frames) != clip["frames"]:
        raise RuntimeError(f"{clip['file']}: expected {clip['frames']} frames, found {len(frames)}")
    return frames


def load_sound(clip):
    if not clip.get("audio_file"):
        return None
    from psychopy import sound

    return sound.Sound(str(HERE / clip["audio_file"]))


def refreshes_of(clip, rate_hz):
    """How many refreshes of the screen every frame lasts."""
    if "shown_s" in clip:
        return max(1, round(rate_hz * float(clip["shown_s"])))
    count = round(rate_hz / clip["fps"])
    if count < 1 or abs(count * clip["fps"] / rate_hz - 1) > 0.02:
        raise RuntimeError(
            f"{clip['stim_id']}: {clip['fps']} frames per second do not divide the screen's {rate_hz:.1f} Hz"
        )
    return count


def duration_s(clip):
    return float(clip["shown_s"]) if "shown_s" in clip else clip["frames"] / clip["fps"]


def show(screen, frames, codes, refreshes, heard, began, keys):
    """Shows a clip, and the blank screen after it while the last code is on the line. Returns a key pressed meanwhile."""
    window = screen.window
    for number, picture in enumerate(frames):
        for refresh in range(refreshes):
            if number == 0 and refresh == 0:
                window.callOnFlip(screen.clock.reset)
                window.callOnFlip(began)
                if heard:
                    heard.play(when=window.getFutureFlipTime(clock="ptb"))
            screen.flip([picture], codes.get(number, 0) if refresh == 0 else 0)
    screen.flip([], codes.get(len(frames), 0))
    while screen.left:
        screen.flip([])
    if heard:
        heard.stop()
    return keys()


class Answers:
    """The file of answers and the events of BIDS. Both are new files, and each row is on the disk before the next trial."""

    def __init__(self, options, settings, columns, software):
        task = "".join(letter for letter in settings["name"] if letter.isascii() and letter.isalnum()) or "clips"
        time = datetime.datetime.now().strftime("%Y%m%dT%H%M%S%f")
        participant = "".join(letter for letter in options.participant if letter.isascii() and letter.isalnum()) or "0"
        folder = HERE / "data"
        folder.mkdir(exist_ok=True)
        stem = f"sub-{participant}_task-{task}_run-{options.run}_{time}"
        self.file = open(folder / f"{stem}.csv", "x", newline="", encoding="utf-8")
        self.events = open(folder / f"{stem}_events.tsv", "x", newline="", encoding="utf-8")
        self.out = csv.DictWriter(self.file, columns)
        self.out.writeheader()
        names = {
            "onset": "First frame of the clip, from the key that began the run, s",
            "duration": "Of the clip, s",
            "trial_type": "Set, and control if it is one",
            "response_time": "From the first frame of the clip, s",
            "stimulus_id": "The clip in stimuli.tsv",
            "trial": "Number of the trial, from 0",
            "answer": "Answer that the key stands for",
            "correct": "1 if it is the right one",
            "dropped": "Refreshes that the screen missed during the clip",
        }
        self.bids = csv.DictWriter(self.events, list(names), delimiter="\t")
        self.bids.writeheader()
        about = {name: {"Description": text} for name, text in names.items()}
        about["StimulusPresentation"] = software
        with open(folder / f"{stem}_events.json", "x", encoding="utf-8") as file:
            file.write(json.dumps(about, indent=2))
        self.keep()

    def keep(self):
        for file in (self.file, self.events):
            file.flush()
            os.fsync(file.fileno())

    def add(self, row, event):
        self.out.writerow(row)
        self.bids.writerow({name: "n/a" if value == "" else value for name, value in event.items()})
        self.keep()


def run_trial(screen, settings, clip, codes, refreshes, board, texts, run_clock):
    """One trial. Returns what it adds to the row; none when the participant presses escape."""
    window, triggers = screen.window, screen.triggers
    screen.flip([])
    frames, heard = load_frames(window, clip), load_sound(clip)
    if board.getKeys(["escape"], waitRelease=False):
        return None
    fixation_clock, began = core.Clock(), {}
    for refresh in range(round(settings["fixation_s"] * screen.rate_hz)):
        if refresh == 0:
            window.callOnFlip(fixation_clock.reset)
        screen.flip([texts["fixation"]])
    triggers.sent.clear()
    answer_keys = [one["key"] for one in settings["answers"]]
    window.frameIntervals = []
    window.recordFrameIntervals = True

    def begin():
        began["fixation_s"], began["onset_s"] = fixation_clock.getTime(), run_clock.getTime()
        board.clock.reset()
        board.clearEvents()

    def keys_meanwhile():
        window.recordFrameIntervals = False
        asked = answer_keys if settings.get("answer_during") else []
        return board.getKeys([*asked, "escape"], waitRelease=False)

    pressed = show(screen, frames, codes, refreshes, heard, begin, keys_meanwhile)
    intervals = window.frameIntervals
    if not pressed:
        question_s = {}
        window.callOnFlip(lambda: question_s.update(at=board.clock.getTime()))
        board.clearEvents()
        screen.flip([texts["question"]])
        pressed = board.waitKeys(keyList=[*answer_keys, "escape"], waitRelease=False)
        since_question = pressed[0].rt - question_s["at"]
    else:
        since_question = None
    key = pressed[0].name
    if key == "escape":
        return None
    period = 1 / screen.rate_hz
    late = max([interval - period for interval in intervals], default=0)
    return {
        "key": key,
        "answer": next(one["answer"] for one in settings["answers"] if one["key"] == key),
        "correct": int(key == clip["correct_key"]) if clip["correct_key"] else "",
        "reaction_s": "" if since_question is None else f"{since_question:.4f}",
        "response_time": f"{pressed[0].rt:.4f}",
        "onset_s": f"{began['onset_s']:.4f}",
        "fixation_s": f"{began['fixation_s']:.4f}" if settings["fixation_s"] else "0",
        "codes": " ".join(f"{code}@{time:.4f}" for code, time in triggers.sent),
        "dropped_refreshes": sum(interval > 1.5 * period for interval in intervals),
        "late_ms_max": f"{1000 * late:.2f}",
    }


ADDED = ["key", "answer", "correct", "reaction_s", "response_time", "onset_s", "fixation_s", "codes", "dropped_refreshes",
         "late_ms_max"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--participant', default="0")
    parser.add_argument('--run', type=int, default=1, help="its number, for the names of the files")
    parser.add_argument('--seed', type=int, help="of the order; by default the participant's name")
    parser.add_argument('--trigger-port', default="", help="a serial port, or the address of a parallel port as 0x0378")
    parser.add_argument('--window', action="store_true", help="not the whole screen")
    options = parser.parse_args()

    settings = json.loads((HERE / "settings.json").read_text(encoding="utf-8"))
    codes = read_codes()
    trials = [dict(row) for _ in range(settings["repetitions"]) for row in read_conditions()]
    random.Random(options.participant if options.seed is None else options.seed).shuffle(trials)

    # All checks come before the first file is opened.
    window = visual.Window(fullscr=not options.window, units="pix", color=settings["background"], colorSpace="hex")
    window.mouseVisible = False
    rate_hz = window.getActualFrameRate(nIdentical=10, nMaxFrames=100, nWarmUpFrames=10, threshold=1)
    if rate_hz is None:
        raise RuntimeError("the screen's refresh rate cannot be measured")
    refreshes = {clip["stim_id"]: refreshes_of(clip, rate_hz) for clip in trials}
    triggers, run_clock = Triggers(options.trigger_port), core.Clock()
    screen = Screen(window, rate_hz, triggers, core.Clock(), settings["pulse_ms"])
    screen.rate_hz = rate_hz
    for name, its in codes.items():
        frames = sorted(its)
        if name in refreshes and any((b - a) * refreshes[name] <= screen.pulse for a, b in zip(frames, frames[1:])):
            print(f"note: {name}: two of its codes follow one another without a zero between them")

    choices = "    ".join(f"{one['key']} = {one['answer']}" for one in settings["answers"])
    texts = {
        "question": visual.TextStim(window, text=f"{settings['question']}\n\n{choices}"),
        "fixation": visual.TextStim(window, text="+", height=48),
    }
    board = keyboard.Keyboard(clock=core.Clock())
    screen.flip([visual.TextStim(window, text=f"{settings['question']}\n\n{choices}\n\nPress any key to begin.")])
    board.waitKeys(waitRelease=False)
    run_clock.reset()

    software = {"SoftwareName": "PsychoPy, with a program by Risorius", "OperatingSystem": os.sys.platform,
                "RefreshRate": rate_hz}
    answers = Answers(options, settings, ["participant", "trial", *trials[0], *ADDED], software)
    for number, row in enumerate(trials):
        clip = {**row, "file": str(HERE / settings["clips"] / row["stim_file"])}
        added = run_trial(
            screen, settings, clip, codes[clip["stim_id"]], refreshes[clip["stim_id"]], board, texts, run_clock
        )
        if added is None:
            break
        kind = " ".join(text for text in (clip["set"], clip["control"]) if text)
        answers.add(
            {**row, "participant": options.participant, "trial": number, **added},
            {
                "onset": added["onset_s"], "duration": f"{duration_s(clip):.4f}", "trial_type": kind,
                "response_time": added["response_time"], "stimulus_id": f"stim-{clip['stim_id']}", "trial": number,
                "answer": added["answer"], "correct": added["correct"], "dropped": added["dropped_refreshes"],
            },
        )
    window.close()
    core.quit()


if __name__ == "__main__":
    main()
)py";

}  // namespace

const std::string& psychopy_program() {
    static const std::string text = kProgram;
    return text;
}

}  // namespace risorius::stimuli
