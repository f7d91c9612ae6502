# SPDX-License-Identifier: MIT
import pathlib

import imageio


def fromarray(frame):
    return frame


def open(file):  # noqa: A001, as the package names it
    data = pathlib.Path(file).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{file}: not a PNG file")
    imageio.last = str(file)
    return data
