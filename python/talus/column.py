# SPDX-License-Identifier: Apache-2.0
"""Numbers that know their unit. Units are labels: arithmetic gives plain numbers, for which nobody has worked it out."""
import numpy as np


class Column(np.ndarray):
    """An array with `units` ("m/s", "1"; SI, angles in deg). Parts of it keep them; results of arithmetic are plain."""

    def __new__(cls, values, units):
        column = np.asarray(values).view(cls)
        column.units = units
        return column

    def __array_finalize__(self, source):
        self.units = getattr(source, "units", None)

    def __array_ufunc__(self, ufunc, method, *inputs, out=None, **options):
        plain = [np.asarray(value) if isinstance(value, Column) else value for value in inputs]
        if out is not None:
            options["out"] = tuple(np.asarray(value) if isinstance(value, Column) else value for value in out)
        return getattr(ufunc, method)(*plain, **options)

    def __reduce__(self):
        return Column, (np.asarray(self), self.units)


class Value(float):
    """A number with `units`."""

    def __new__(cls, value, units):
        number = super().__new__(cls, value)
        number.units = units
        return number

    def __repr__(self):
        return f"{float(self)!r}" + ("" if self.units == "1" else f" {self.units}")

    __str__ = __repr__

    def __reduce__(self):
        return Value, (float(self), self.units)
