# SPDX-License-Identifier: MIT
import os

from . import core

REFRESH_S = 1 / float(os.environ.get("STAND_IN_HZ", "60"))


class Window:
    size = (800, 600)

    def __init__(self, **_):
        self.calls, self.drawn, self.seen = [], [], []
        self.frameIntervals, self.recordFrameIntervals, self.mouseVisible = [], False, True

    def getActualFrameRate(self, nIdentical=10, nMaxFrames=100, nWarmUpFrames=10, threshold=1):
        return 1 / REFRESH_S

    def getFutureFlipTime(self, clock):
        return core.now_s + REFRESH_S

    def callOnFlip(self, function, *arguments):
        self.calls.append((function, arguments))

    def flip(self):
        core.now_s += REFRESH_S
        if self.recordFrameIntervals:
            self.frameIntervals.append(REFRESH_S)
        for function, arguments in self.calls:
            function(*arguments)
        self.calls = []

    def close(self):
        pass


class Stimulus:
    def __init__(self, window, **known):
        self.window = window
        for name in known:
            if name not in ("image", "width", "height", "radius", "lineWidth", "fillColor", "pos", "text", "units",
                            "interpolate"):
                raise TypeError(name)

    def draw(self):
        pass


ImageStim = Rect = Circle = Stimulus


class TextStim(Stimulus):
    def __init__(self, window, text, height=20):
        super().__init__(window, text=text)
