"""Findings on wet contacts: each appears where its criterion is met, with its numbers."""

from __future__ import annotations

import numpy as np
import pytest
from contact_cases import wetted

import asperity as asp


def bump(pixels: int) -> asp.ContactProblem:
    """Sphere of 1 µm radius on 400 nm x 400 nm of so many pixels."""
    x = (np.arange(pixels) + 0.5) / pixels * 400e-9 - 200e-9
    heights = -np.add.outer(x**2, x**2) / 2e-6
    return asp.ContactProblem(asp.Surface(heights, 400e-9 / pixels), asp.Elastic(100e9, 0.3), boundary=asp.Free())


def film(height: float) -> asp.LiquidFilm:
    return asp.LiquidFilm(surface_tension=0.07, thickness=1e-9, meniscus_height=height)


@pytest.mark.parametrize(("pixels", "few"), [(24, True), (96, False)])
def test_menisci_of_few_pixels(pixels, few):
    """Radius sqrt(2 R h_m) = 63 nm at a height of 2 nm: 3.8 pixels of 17 nm, 15 of 4 nm, and a
    little more under load."""
    found = asp.contact.review(wetted(bump(pixels), asp.Force(1e-8), film(2e-9)))
    said = [item for item in found if item.criterion == "meniscus pixels"]
    assert bool(said) == few
    if few:
        assert "radius of 4." in said[0].message
        assert said[0].level == "warning"


@pytest.mark.parametrize(("height", "small"), [(1.5e-9, True), (3e-9, False)])
def test_menisci_of_few_molecules(height, small):
    found = asp.contact.review(wetted(bump(96), asp.Force(1e-8), film(height)))
    assert any(item.criterion == "molecules" for item in found) == small


def test_nothing_is_said_of_a_dry_contact():
    dry = asp.LiquidFilm(surface_tension=0.07, thickness=1e-12)
    found = asp.contact.review(wetted(bump(24), asp.Force(1e-8), dry))
    wet = [item.criterion for item in found if item.criterion in ("meniscus pixels", "molecules")]
    assert wet == ["molecules"], "the film is thinner than a molecule"
