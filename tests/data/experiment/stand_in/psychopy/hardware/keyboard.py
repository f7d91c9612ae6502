# SPDX-License-Identifier: MIT
"""A participant who presses the first key that is asked for, half a second after it is.

    STAND_IN_OBSERVER=X     answers rightly with the chance of a Weibull function with 82 % at level X of conditions.csv
    STAND_IN_TR=S           a scanner that presses 5 each S seconds
    STAND_IN_ALARMS=N       presses the space bar once in each Nth trial, although there is no red dot
"""
import csv
import math
import os
import pathlib
import random
import sys

import imageio

from .. import core

CHANCE = random.Random(5)
TR_S = float(os.environ.get("STAND_IN_TR", "0"))


class KeyPress:
    def __init__(self, name, t_down, clock):
        self.name, self.tDown, self.rt, self.duration = name, t_down, t_down - clock.begin_s, None


def right_key_of(file):
    """What an observer with a threshold answers to the clip that was read last."""
    experiment = pathlib.Path(sys.argv[0]).parent
    with open(experiment / "conditions.csv", newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    shown = next(row for row in rows if row["stim_file"] == pathlib.Path(file).name)
    keys = sorted({row["correct_key"] for row in rows})
    level = float(shown["level"]) / float(os.environ["STAND_IN_OBSERVER"])
    guess = 1 / len(keys)
    miss = (1 - (0.82 - 0.01 * guess) / 0.99) / (1 - guess)
    right = 0.99 * (1 - (1 - guess) * miss ** (level**3.5)) + 0.01 * guess
    if CHANCE.random() < right:
        return shown["correct_key"]
    return CHANCE.choice([key for key in keys if key != shown["correct_key"]])


class Keyboard:
    def __init__(self, clock):
        self.clock = clock
        self.asked, self.since_s, self.polled_s = None, 0.0, -1.0
        self.pulses = 0
        self.checked = 0

    def clearEvents(self):
        pass

    def getKeys(self, keyList=None, waitRelease=True, clear=True):
        out = []
        while TR_S and self.pulses * TR_S <= core.now_s:
            if keyList is None or "5" in keyList:
                out.append(KeyPress("5", self.pulses * TR_S, self.clock))
            self.pulses += 1
        if waitRelease:
            return out
        if "space" in (keyList or []) and "escape" not in keyList and "STAND_IN_ALARMS" in os.environ:
            self.checked += 1
            if self.checked % int(os.environ["STAND_IN_ALARMS"]) == 0:
                out.append(KeyPress("space", core.now_s, self.clock))
            return out
        names = [name for name in keyList or ["space"] if name not in ("escape", "5")]
        if names != self.asked or core.now_s - self.polled_s > 0.1:
            self.asked, self.since_s = names, core.now_s
        self.polled_s = core.now_s
        if names and core.now_s - self.since_s >= 0.5:
            name = names[0]
            if "STAND_IN_OBSERVER" in os.environ and imageio.last and name != "space":
                name = right_key_of(imageio.last)
            out.append(KeyPress(name, core.now_s, self.clock))
            self.asked = None
        return out
