"""Hardness numbers of Vickers, Brinell and Rockwell as the pressure that this package calls hardness: force over *projected* area.

Vickers and Brinell numbers are forces over the curved or inclined area of the imprint itself, in kgf/mm².

HV, HV10        HV 9.80665 MPa / sin 68°: the faces of the pyramid stand at 68° to its axis, so that HV is 0.927 of the pressure.
HB, HBW         HB 9.80665 MPa / (1 - t/D): the ball of diameter D leaves a cap of depth t, of area π D t and projected area π t (D - t);
                from HB = F/(π D t) is t/D = (F/D²)/(π HB). A number like HBW10/3000 gives D in mm and F in kgf, else F/D² is 30 kgf/mm²
                as for steel and cast iron, below 95.5 HB 10 kgf/mm² as for softer metals. Valid for imprints of 0.24 D to 0.6 D (ISO 6506-1).
HRC             by the Vickers numbers of non-austenitic steels in ASTM E140, table 1, from 20 to 68 HRC; other materials differ.
"""

from __future__ import annotations

import math
import re

from .errors import UnitError

KILOPOND = 9.80665e6
"""1 kgf/mm² in Pa."""

VICKERS_OF_ROCKWELL_C = (
    *(238, 248, 260, 272, 286, 302, 318, 336, 354, 372, 392, 412, 434),
    *(458, 484, 513, 544, 577, 613, 653, 697, 746, 800, 865, 940),
)
"""HV at 20, 22, … 68 HRC (ASTM E140, table 1); what lies between is within 0.3 % of the table."""

_STEEL, _SOFTER = 30.0, 10.0
"""F/D² in kgf/mm² of the usual test of steel, and of that below ``_LEAST_OF_STEEL``."""

_LEAST_OF_STEEL, _HARDEST_BRINELL = 95.5, 650.0
_SHALLOWEST, _DEEPEST = (0.5 * (1.0 - math.sqrt(1.0 - ratio**2)) for ratio in (0.24, 0.6))

_NUMBER = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+))\s*(?:(?P<vickers>HV)(?:\s?\d+(?:\.\d+)?)?"
    r"|(?P<brinell>HBW?)(?:\s?(?P<ball>\d+(?:\.\d+)?)/(?P<force>\d+(?:\.\d+)?))?|(?P<rockwell>HRC))\s*",
    re.IGNORECASE,
)


def hardness_of(text: str, what: str) -> float | None:
    """Hardness in Pa that a number such as ``"700 HV"``, ``"200 HB"``, ``"187 HBW10/3000"`` or ``"60 HRC"`` stands for; None for any other text.

    Raises
    ------
    UnitError
        If the number lies outside the range of its scale; ``what`` names the input.

    Examples
    --------
    >>> [f"{hardness_of(text, '') / 1e9:.2f}" for text in ("700 HV", "200 HB", "60 HRC")]
    ['7.40', '2.06', '7.37']
    """
    match = _NUMBER.fullmatch(text)
    if match is None:
        return None
    number = float(match["number"])
    if match["vickers"]:
        return _vickers(number, text, what)
    if match["rockwell"]:
        last = 20 + 2 * (len(VICKERS_OF_ROCKWELL_C) - 1)
        if not 20.0 <= number <= last:
            raise UnitError(
                f"{what} must be from 20 to {last} HRC, the range of the table of steels, but is {text!r}. Give HV, HB or a pressure."
            )
        row = min(int((number - 20.0) / 2.0), len(VICKERS_OF_ROCKWELL_C) - 2)
        low, high = VICKERS_OF_ROCKWELL_C[row : row + 2]
        return _vickers(low + (high - low) * (number - 20.0 - 2 * row) / 2.0, text, what)
    given = match["ball"] is not None
    index = _STEEL if number >= _LEAST_OF_STEEL else _SOFTER
    if given:
        index = float(match["force"]) / float(match["ball"]) ** 2 if float(match["ball"]) else 0.0
    depth = index / (math.pi * number) if number > 0.0 else math.inf  # over the diameter of the ball
    if not 0.99 * _SHALLOWEST <= depth <= 1.01 * _DEEPEST or number > _HARDEST_BRINELL:
        least, most = (index / (math.pi * end) for end in (_DEEPEST, _SHALLOWEST))
        if not given:
            least, most = _SOFTER / (math.pi * _DEEPEST), _HARDEST_BRINELL
        raise UnitError(
            f"{what} must be from {least:.3g} to {min(most, _HARDEST_BRINELL):.3g} HB, for imprints of 0.24 to 0.6 of the ball, but is {text!r}. "
            "Give the ball and the force, such as HBW10/500, HV or a pressure."
        )
    return number * KILOPOND / (1.0 - depth)


def _vickers(number: float, text: str, what: str) -> float:
    if not number > 0.0:
        raise UnitError(f"{what} must be greater than zero, but is {text!r}.")
    return number * KILOPOND / math.sin(math.radians(68.0))
