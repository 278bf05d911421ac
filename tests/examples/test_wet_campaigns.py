"""The ready studies of wet contacts, on fewer pixels, samples and values: they run, and say what
they should."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
from ready_studies import FOLDER, PIXEL, axis, results


def solved(name: str, *, points: int = 64, samples: int = 2, **values: list[Any]):
    """Results of the study ``name`` on small surfaces, with the ``values`` of some of its axes,
    averaged over them."""
    table = tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    surface = table["problem"]["surface"]
    assert surface["points"] == [128, 128]
    assert surface["size"] == "10 um"
    surface["points"], surface["size"] = [points, points], f"{points * PIXEL!r} m"
    table["monte_carlo"]["samples"] = samples
    for key, given in values.items():
        axis(table, key)["values"] = given
    data = results(table)
    assert np.all(data["outcome"] == 0)
    return data.mean("sample")


def test_menisci_pull_more_in_thicker_films_and_on_smoother_surfaces():
    data = solved("film_and_roughness", roughness=["2 nm", "3 nm"], film=["1 nm", "3 nm"])
    force = data["relative_meniscus_force"].transpose("roughness", "film")
    assert np.all(np.diff(force, axis=1) > 0.0)
    assert np.all(np.diff(force, axis=0) < 0.0)
    np.testing.assert_allclose(data["static_friction"], 0.3 * (1.0 + data["relative_meniscus_force"]), rtol=1e-12)
    # the theory of summits beside it: within a factor of three
    ratio = data["statistical_meniscus_force"] / data["meniscus_force"]
    assert np.all((ratio > 1.0 / 3.0) & (ratio < 3.0))


def test_surfaces_stick_in_humid_air_and_less_under_load():
    data = solved("humidity", samples=3, humidity=["50 %", "80 %", "90 %"])
    force = data["relative_meniscus_force"].transpose("humidity", "load")
    assert np.all(np.diff(force, axis=0) > 0.0)
    assert np.all(force[1:, 1] < force[1:, 0])
    assert force[2, 0] > 5.0 * force[0, 0]


def test_few_high_peaks_touch_and_stick_least():
    data = solved("skewness_and_kurtosis", samples=3, skewness=[-0.5, 0.0], film=["2 nm"]).squeeze("film")
    for name in ("area_fraction", "relative_meniscus_force"):
        found = data[name].transpose("skewness", "kurtosis", "load")
        assert np.all(np.diff(found, axis=1) < 0.0)
        assert np.all(np.diff(found, axis=0) < 0.0)
