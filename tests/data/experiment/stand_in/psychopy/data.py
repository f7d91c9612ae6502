# SPDX-License-Identifier: MIT
"""The two methods of PsychoPy that experiment.py uses, with the same arguments, for an observer who is simulated."""
import math


class StairHandler:
    def __init__(self, startVal, nReversals, stepSizes, nTrials, nUp, nDown, stepType, minVal, maxVal):
        if stepType != "log":
            raise ValueError(stepType)
        self.level, self.steps, self.trials, self.up, self.down = startVal, stepSizes, nTrials, nUp, nDown
        self.least, self.most = minVal, maxVal
        self.data, self.intensities, self.reversalIntensities = [], [], []
        self.run, self.direction = 0, 0

    def __next__(self):
        if len(self.data) >= self.trials:
            raise StopIteration
        self.intensities.append(self.level)
        return self.level

    def addResponse(self, result, intensity=None):
        if intensity is not None:
            self.intensities[-1] = intensity
        self.data.append(result)
        first = not self.reversalIntensities
        self.run = max(self.run, 0) + 1 if result else min(self.run, 0) - 1
        direction = -1 if self.run >= (1 if first else self.down) else 1 if -self.run >= self.up else 0
        if not direction:
            return
        self.run = 0
        if self.direction and direction != self.direction:
            self.reversalIntensities.append(self.intensities[-1])
        self.direction = direction
        step = self.steps[min(len(self.reversalIntensities), len(self.steps) - 1)]
        self.level = min(max(self.level * 10 ** (direction * step), self.least), self.most)


class QuestHandler:
    """Watson, Pelli 1983, Perception & Psychophysics 33(2), 113-120, on a grid."""

    def __init__(self, startVal, startValSd, pThreshold, nTrials, beta, delta, gamma, grain, minVal, maxVal):
        self.trials, self.beta, self.delta, self.gamma = nTrials, beta, delta, gamma
        self.least, self.most = minVal, maxVal
        self.grid = [startVal + grain * step for step in range(-300, 301)]
        self.log_p = [-0.5 * ((t - startVal) / startValSd) ** 2 for t in self.grid]
        miss = (1 - (pThreshold - delta * gamma) / (1 - delta)) / (1 - gamma)
        self.shift = math.log10(-math.log(miss)) / beta
        self.data, self.intensities = [], []

    def chances(self):
        top = max(self.log_p)
        weights = [math.exp(one - top) for one in self.log_p]
        return [one / sum(weights) for one in weights]

    def mean(self):
        return sum(t * p for t, p in zip(self.grid, self.chances()))

    def sd(self):
        middle = self.mean()
        return math.sqrt(sum((t - middle) ** 2 * p for t, p in zip(self.grid, self.chances())))

    def __next__(self):
        if len(self.data) >= self.trials:
            raise StopIteration
        self.intensities.append(min(max(self.mean(), self.least), self.most))
        return self.intensities[-1]

    def addResponse(self, result, intensity=None):
        if intensity is not None:
            self.intensities[-1] = intensity
        self.data.append(result)
        for at, threshold in enumerate(self.grid):
            rise = math.exp(-(10 ** (self.beta * (self.intensities[-1] - threshold + self.shift))))
            right = self.delta * self.gamma + (1 - self.delta) * (1 - (1 - self.gamma) * rise)
            self.log_p[at] += math.log(right if result else 1 - right)
