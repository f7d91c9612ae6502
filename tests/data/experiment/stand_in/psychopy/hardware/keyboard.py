# SPDX-License-Identifier: MIT
"""A participant who presses the first key that is asked for, half a second after it is."""
from .. import core


class KeyPress:
    def __init__(self, name, rt):
        self.name, self.rt = name, rt


class Keyboard:
    def __init__(self, clock):
        self.clock = clock

    def clearEvents(self):
        pass

    def getKeys(self, keyList=None, waitRelease=True, clear=True):
        return []

    def waitKeys(self, maxWait=float("inf"), keyList=None, waitRelease=True, clear=True):
        core.wait(0.5)
        return [KeyPress((keyList or ["space"])[0], self.clock.getTime())]
