"""Colours of a page as the browser tells them."""

from __future__ import annotations

import re

import numpy as np


def contrast(first: str, second: str) -> float:
    """Ratio of the luminances of two colours "rgb(r, g, b)" (WCAG 2)."""

    def luminance(colour: str) -> float:
        parts = np.array([float(part) for part in re.findall(r"[\d.]+", colour)[:3]]) / 255.0
        linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
        return float(linear @ [0.2126, 0.7152, 0.0722])

    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)
