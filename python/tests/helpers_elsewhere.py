"""Functions that traced functions take from another module."""

from math import cos, sin

import numpy as np
from numpy import array, zeros


def rotation(angle):
    """Turns the plane."""
    return array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])


def filled(x):
    """Writes into an array of its own."""
    y = zeros(3)
    y[0] = x[1]
    y[1:] = x[:2] * 2
    return y


class Aircraft:
    """A thing with methods that call each other."""

    def __init__(self, mass):
        self.mass = mass
        self.table = np.array([1.0, 2.0, 4.0])

    def lift(self, x):
        y = np.zeros(3)
        y[0] = np.sin(x[1]) / self.mass
        y[2] = np.interp(x[2], [0.0, 1.0, 2.0], self.table)
        return y

    @property
    def weight(self):
        return self.mass * 9.81

    @staticmethod
    def drag(speed):
        return 0.5 * speed * abs(speed)

    def drift(self, t, x):
        return self.lift(x) - np.array([0, self.weight, self.drag(x[0])])

    def __call__(self, t, x):
        return self.drift(t, x) * 2
