# SPDX-License-Identifier: MIT
"""As many frames as the clip's sidecar says."""
import contextlib
import json

last = None


@contextlib.contextmanager
def get_reader(file, _plugin):
    global last
    last = file
    with open(file.rsplit(".", 1)[0] + ".json", encoding="utf-8") as sidecar:
        yield range(json.load(sidecar)["frames"])
