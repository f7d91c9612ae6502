# SPDX-License-Identifier: MIT
def fromarray(frame):
    return frame
