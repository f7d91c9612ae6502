# SPDX-License-Identifier: MIT
"""What experiment.py uses of PsychoPy, on a screen of 60 Hz that nobody sees: time goes on by refreshes alone."""
