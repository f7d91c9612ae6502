// SPDX-License-Identifier: MIT
// The text of experiment.py: what it draws with, listens to and writes. What follows is in psychopy_course.cpp.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

const char* const kDevices = R"py(#!/usr/bin/env python3
"""An experiment with a set of clips, for PsychoPy: an example to start from.

    python experiment.py --participant 7

Every clip is decoded before its fixation cross is shown, and its frames are flipped one by one, each for a whole number of
refreshes of the screen, so that no player decides when a frame is seen. A picture is a clip of one frame. ../triggers.tsv says
which codes go out with which frame. A code stays on the line for whole refreshes, pulse_ms of settings.json at least, and is
then taken off. A square in the lower left corner is white exactly while a code is on the line, and black at all other times,
for a photodiode.

It reads settings.json and conditions.csv beside it. Every run writes new files, row by row, and never an old one:
data/sub-P_task-T_run-R_TIME.csv, and ..._events.tsv with ..._events.json as BIDS has them. Onsets count from the key, or from
the pulse of the scanner, that began the run.
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
CATCH_KEY, CATCH_S, CATCH_WAIT_S = "space", 0.2, 1.0
FEEDBACK_S = 0.8

# Codes that belong to no clip. 1 to 5 and 10 to 250 are those of ../triggers.tsv.
RESPONSE, BLOCK, PRACTICE, CATCH, PAUSE, SCANNER = (
    (6, "response"), (251, "block"), (252, "practice"), (253, "catch"), (254, "pause"), (255, "scanner"),
)


class Triggers:
    """Codes to a serial port, a parallel port (an address like 0x0378), or nowhere, and markers to the Lab Streaming Layer if
    a name is given for the stream. They are kept for the data in any case."""

    def __init__(self, port, stream):
        self.serial, self.parallel, self.outlet = None, None, None
        self.sent, self.trial = [], {}
        if port and port.lower().startswith("0x"):
            from psychopy import parallel

            self.parallel = parallel.ParallelPort(address=int(port, 16))
            self.parallel.setData(0)
        elif port:
            import serial

            self.serial = serial.Serial(port, 115200)
        if stream:
            import pylsl

            self.now = pylsl.local_clock
            self.outlet = pylsl.StreamOutlet(pylsl.StreamInfo(stream, "Markers", 1, 0, "string", f"risorius-{stream}"))

    def send(self, code, event, clock):
        if self.parallel:
            self.parallel.setData(code)
        elif self.serial:
            self.serial.write(bytes([code]))
        if self.outlet and code:
            self.outlet.push_sample([json.dumps({"code": code, "event": event, **self.trial})], self.now())
        self.sent.append((code, clock.getTime()))


class Screen:
    """Flips with the square of the photodiode, and takes every code off the line after its pulse."""

    def __init__(self, window, rate_hz, triggers, clock, pulse_ms):
        self.window, self.rate_hz, self.triggers, self.clock = window, rate_hz, triggers, clock
        self.pulse = max(1, math.ceil(pulse_ms * rate_hz / 1000 - 1e-3))
        self.left = 0
        self.square = visual.Rect(
            window, width=SIDE_PX, height=SIDE_PX, lineWidth=0, fillColor="black",
            pos=((SIDE_PX - window.size[0]) / 2, (SIDE_PX - window.size[1]) / 2),
        )

    def flip(self, drawn, marker=None):
        """Shows what is drawn for one refresh. A marker, a code and what it stands for, goes out with it."""
        for one in drawn:
            one.draw()
        was_on = self.left > 0
        self.left = self.pulse if marker else max(0, self.left - 1)
        if marker:
            self.window.callOnFlip(self.triggers.send, *marker, self.clock)
        elif was_on and self.left == 0:
            self.window.callOnFlip(self.triggers.send, 0, "", self.clock)
        self.square.fillColor = "white" if self.left else "black"
        self.square.draw()
        self.window.flip()

    def mark(self, drawn, marker):
        """Shows what is drawn for as long as the code is on the line."""
        self.flip(drawn, marker)
        while self.left:
            self.flip(drawn)

    def stay(self, drawn, seconds):
        for _ in range(round(seconds * self.rate_hz)):
            self.flip(drawn)


class Keys:
    """The keyboard, and the time of the run. Pulses of a scanner come as a key too: they are put aside, with their times."""

    def __init__(self, pulse):
        self.board = keyboard.Keyboard(clock=core.Clock())
        self.pulse, self.pulses_s = [pulse] if pulse else [], []
        self.seen = set()
        self.run_clock, self.zero_s = core.Clock(), 0.0

    def run_s(self):
        return self.run_clock.getTime() - self.zero_s

    def begin_run(self):
        self.zero_s = self.run_clock.getTime()
        self.pulses_s = []

    def wait_for_scanner(self, dummies):
        """The run begins with the pulse after the dummies."""
        while len(self.pulses_s) <= dummies:
            self.read([])
            core.wait(0.001)
        first_s = self.pulses_s[dummies]
        self.zero_s += first_s
        self.pulses_s = [at - first_s for at in self.pulses_s[dummies:]]

    def restart(self):
        """Counts the times of keys from now on, and forgets what was pressed before."""
        self.read(None)
        self.board.clock.reset()

    def read(self, names):
        """The keys of these names, or all, that were pressed since they were read. A key that is still down and one that is up
        again are both pressed; PsychoPy tells of them apart, and of some of them twice."""
        asked = None if names is None else [*names, *self.pulse]
        if asked == []:
            return []
        found = [key for up in (False, True) for key in self.board.getKeys(asked, waitRelease=up)]
        new = [key for key in found if (key.name, key.tDown) not in self.seen]
        self.seen.update((key.name, key.tDown) for key in new)
        since_s = self.run_s() - self.board.clock.getTime()
        self.pulses_s += [since_s + key.rt for key in new if key.name in self.pulse]
        return [key for key in new if key.name not in self.pulse]

    def wait(self, names=None, limit_s=float("inf")):
        """Waits for one of these keys, or for any. Returns none after the limit."""
        self.read(None)
        begin_s = self.board.clock.getTime()
        while self.board.clock.getTime() - begin_s < limit_s:
            if found := self.read(names):
                return found
            core.wait(0.001)
        return []


def read_conditions():
    with open(HERE / "conditions.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["frames"], row["fps"] = int(row["frames"]), int(row["fps"])
    return rows


def read_codes():
    """The markers of every clip: stim_id -> frame -> (code, event). Moments that share a frame have one code."""
    codes = {}
    with open(HERE / "../triggers.tsv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file, delimiter="\t"):
            if row.get("merged_into", "n/a") == "n/a":
                codes.setdefault(row["stim_id"], {})[int(row["frame"])] = (int(row["code"]), row["event"])
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


class Answers:
    """The file of answers and the events of BIDS. Both are new files, and each row is on the disk before the next trial."""

    def __init__(self, options, settings, columns, software):
        task = "".join(letter for letter in settings["name"] if letter.isascii() and letter.isalnum()) or "clips"
        time = datetime.datetime.now().strftime("%Y%m%dT%H%M%S%f")
        participant = "".join(letter for letter in options.participant if letter.isascii() and letter.isalnum()) or "0"
        folder = HERE / "data"
        folder.mkdir(exist_ok=True)
        self.stem = str(folder / f"sub-{participant}_task-{task}_run-{options.run}_{time}")
        self.file = open(f"{self.stem}.csv", "x", newline="", encoding="utf-8")
        self.events = open(f"{self.stem}_events.tsv", "x", newline="", encoding="utf-8")
        self.out = csv.DictWriter(self.file, columns)
        self.out.writeheader()
        names = {
            "onset": "First frame of the clip, from the key or the pulse that began the run, s",
            "duration": "Of the clip, s",
            "trial_type": "Set, and control if it is one; pulse: of the scanner",
            "response_time": "From the first frame of the clip, s",
            "stimulus_id": "The clip in stimuli.tsv",
            "stim_file": "Its file in stimuli/",
            "trial": "Number of the trial, from 0",
            "block": "Number of the block, from 1; 0: practice",
            "kind": "trial, practice or catch",
            "answer": "Answer that the key stands for",
            "correct": "1 if it is the right one; in a catch trial, if the red dot was answered",
            "false_alarm": "1 if the key for the red dot was pressed without one",
            "dropped": "Refreshes that the screen missed during the clip",
        }
        self.bids = csv.DictWriter(self.events, list(names), delimiter="\t", restval="n/a")
        self.bids.writeheader()
        about = {name: {"Description": text} for name, text in names.items()}
        about["StimulusPresentation"] = software
        with open(f"{self.stem}_events.json", "x", encoding="utf-8") as file:
            file.write(json.dumps(about, indent=2))
        self.keep()

    def keep(self):
        for file in (self.file, self.events):
            file.flush()
            os.fsync(file.fileno())

    def add(self, row, event, pulses_s):
        """One trial, and the pulses of the scanner that came meanwhile, in the order of time."""
        self.out.writerow(row)
        events = [{"onset": f"{at:.4f}", "duration": "0", "trial_type": "pulse"} for at in pulses_s]
        events.append({name: "n/a" if value == "" else value for name, value in event.items()})
        self.bids.writerows(sorted(events, key=lambda one: float(one["onset"])))
        self.keep()

    def table(self, name, rows):
        """A table of results beside the data."""
        if rows:
            with open(f"{self.stem}_{name}.csv", "x", newline="", encoding="utf-8") as file:
                out = csv.DictWriter(file, list(rows[0]))
                out.writeheader()
                out.writerows(rows)
)py";

}  // namespace

const std::string& psychopy_program() {
    static const std::string text = std::string(kDevices) + psychopy_course();
    return text;
}

}  // namespace risorius::stimuli
