# SPDX-License-Identifier: MIT
now_s = 0.0


class Clock:
    def __init__(self):
        self.begin_s = now_s

    def reset(self):
        self.begin_s = now_s

    def getTime(self):
        return now_s - self.begin_s


def wait(seconds):
    global now_s
    now_s += seconds


def quit():
    pass
