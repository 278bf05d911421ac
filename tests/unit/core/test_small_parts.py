"""Checks of values, digests, citations, errors."""

from pathlib import Path

import numpy as np
import pytest
from refusals import refused

import asperity as asp
from asperity.core import require
from asperity.core.arrays import array_digest
from asperity.core.citations import REFERENCES, citation_keys, reference


@pytest.mark.parametrize(
    ("check", "bad"),
    [
        (lambda v: require.positive(v, "length of rod"), [0, -1, np.nan, np.inf, "long", None]),
        (lambda v: require.at_most(v, 0.5, "length of rod"), [0, -1e-300, 0.501, np.nan, "x"]),
        (lambda v: require.between(v, 0, 1, "length of rod"), [0, 1, 2, np.nan]),
        (lambda v: require.two(v, "length of rod"), [5, (), (1, 2, 3)]),
        (lambda v: require.instance(v, asp.Strength, "length of rod"), [5e9, None]),
        (lambda v: require.integer(v, 2, "length of rod"), [1, 2.5, np.inf, "two"]),
        (lambda v: require.one_of(v, ("a", "b"), "length of rod"), ["c", ""]),
        (lambda v: require.field(v, "length of rod"), [[1.0], np.zeros((2, 0)), [["a"]], np.zeros((2, 2, 2)), [[1j]]]),
    ],
)
def test_refusals_name_the_input_and_what_came(check, bad):
    for value in bad:
        with refused(asp.InputError, "length of rod"):
            check(value)


def test_accepted_values_come_back_in_their_type():
    assert require.positive(np.float32(2), "x") == 2.0
    assert require.integer(3.0, 1, "x") == 3
    assert require.at_most(0.5, 0.5, "x") == 0.5
    assert require.field([[1, 2]], "x").dtype == np.float64
    assert require.field(np.ones((2, 2), np.float32), "x").dtype == np.float32


def test_digest_sees_content_shape_and_type_but_not_memory_order():
    a = np.arange(6.0).reshape(2, 3)
    assert array_digest(a) == array_digest(np.asfortranarray(a))
    assert array_digest(a) == array_digest(a.astype(">f8"))
    different = [a.T, a + 1e-16 + 1.0, a.astype(np.float32), a.reshape(3, 2)]
    assert len({array_digest(a), *(array_digest(b) for b in different)}) == 5


GRID = asp.Grid((32, 32), (1.0, 1.0))
EXPONENTIAL = asp.generate.ExponentialAutocorrelation(1.0, 5.0)
SELF_AFFINE = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(1.0), hurst=0.8, rolloff_wavelength=16.0, shortest_wavelength=4.0
)


def test_every_key_that_is_used_has_a_reference():
    surface = asp.generate.gaussian(GRID, EXPONENTIAL, seed=1)
    problem = asp.ContactProblem(surface, asp.Elastic(1.0, 0.3), law=asp.Hardness(1.0))
    objects = [surface, problem, asp.solve(problem, asp.MeanPressure(0.1))]
    objects += [asp.Periodic(), asp.Free(), asp.plasticity.HardWall(), *(cls() for cls in asp.solvers.SOLVERS.values())]
    assert set(citation_keys(*objects)) <= set(REFERENCES)
    text = asp.cite(*objects)
    assert text.count("\n") == len(citation_keys(*objects)) - 1
    assert "Polonsky" in text
    with refused(asp.InputError, "citation key"):
        reference("Nobody1900")


def test_a_surface_cites_its_generator_and_its_preparation():
    by_correlation = asp.generate.gaussian(GRID, EXPONENTIAL, seed=1)
    by_spectrum = asp.generate.gaussian(GRID, SELF_AFFINE, seed=1)
    assert by_correlation.citation_keys == ("Dietrich1997", "PengBhushan2001")
    assert by_spectrum.citation_keys == ("Jacobs2017",)
    part = asp.surfaces.cropped(by_spectrum, x=(0.0, 16.0))
    steps = asp.levelled(asp.surfaces.resampled(asp.periodised(asp.levelled(part)), (20, 20)))
    assert steps.citation_keys == ("Jacobs2017", "Moisan2011")
    assert asp.periodised(asp.Surface(steps.heights, 1.0, origin=steps.origin)).citation_keys == steps.citation_keys
    pair = asp.surfaces.composite(by_correlation, by_spectrum)
    assert pair.citation_keys == ("Dietrich1997", "PengBhushan2001", "Jacobs2017", "Peng2001")
    assert "circulant embedding" in asp.cite(pair)


def test_every_reference_is_named_by_the_code():
    """A reference that nothing names would never be cited."""
    root = Path(asp.__file__).parent
    text = "".join(path.read_text(encoding="utf-8") for path in root.rglob("*.py") if path.name != "citations.py")
    unnamed = {key for key in REFERENCES if f'"{key}"' not in text}
    assert unnamed == set()


@pytest.mark.parametrize(
    ("error", "also"),
    [
        (asp.InputError, ValueError),
        (asp.errors.UnitError, asp.InputError),
        (asp.errors.FileFormatError, asp.InputError),
        (asp.errors.NoSolutionError, asp.InputError),
        (asp.errors.OutputError, OSError),
        (asp.ConvergenceError, RuntimeError),
    ],
)
def test_every_error_can_be_caught_as_what_it_is(error, also):
    assert issubclass(error, asp.errors.AsperityError)
    assert issubclass(error, also)
