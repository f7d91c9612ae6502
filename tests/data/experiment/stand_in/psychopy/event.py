# SPDX-License-Identifier: MIT
from . import core


def waitKeys(keyList=None, timeStamped=None):
    core.wait(0.5)
    key = (keyList or ["space"])[0]
    return [(key, timeStamped.getTime())] if timeStamped else [key]
