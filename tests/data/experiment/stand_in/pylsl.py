# SPDX-License-Identifier: MIT
"""What experiment.py uses of the Lab Streaming Layer: samples go to the file STAND_IN_LSL, one on a line."""
import os

from psychopy import core


def local_clock():
    return core.now_s


class StreamInfo:
    def __init__(self, name, kind, channels, rate_hz, values, source):
        self.text = f"{name} {kind} {channels} {rate_hz} {values} {source}"


class StreamOutlet:
    def __init__(self, info):
        self.file = open(os.environ["STAND_IN_LSL"], "w", encoding="utf-8")
        print(info.text, file=self.file, flush=True)

    def push_sample(self, values, timestamp):
        print(f"{timestamp:.4f}", *values, file=self.file, flush=True)
