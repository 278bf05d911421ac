"""Checks of values, digests, citations."""

import numpy as np
import pytest

import asperity as asp
from asperity.core import require
from asperity.core.citations import REFERENCES, citation_keys, reference
from asperity.core.digest import array_digest


@pytest.mark.parametrize(
    ("check", "bad"),
    [
        (lambda v: require.positive(v, "length of rod"), [0, -1, np.nan, np.inf, "long", None]),
        (lambda v: require.non_negative(v, "length of rod"), [-1e-300, np.nan, "x"]),
        (lambda v: require.between(v, 0, 1, "length of rod"), [0, 1, 2, np.nan]),
        (lambda v: require.integer(v, 2, "length of rod"), [1, 2.5, np.inf, "two"]),
        (lambda v: require.one_of(v, ("a", "b"), "length of rod"), ["c", ""]),
        (lambda v: require.field(v, "length of rod"), [[1.0], np.zeros((2, 0)), [["a"]], np.zeros((2, 2, 2)), [[1j]]]),
    ],
)
def test_refusals_name_the_input_and_what_came(check, bad):
    for value in bad:
        with pytest.raises(asp.InputError, match=r"length of rod must be .*, but is "):
            check(value)


def test_accepted_values_come_back_in_their_type():
    assert require.positive(np.float32(2), "x") == 2.0
    assert require.integer(3.0, 1, "x") == 3
    assert require.field([[1, 2]], "x").dtype == np.float64
    assert require.field(np.ones((2, 2), np.float32), "x").dtype == np.float32


def test_digest_sees_content_shape_and_type_but_not_memory_order():
    a = np.arange(6.0).reshape(2, 3)
    assert array_digest(a) == array_digest(np.asfortranarray(a))
    assert array_digest(a) == array_digest(a.astype(">f8"))
    different = [a.T, a + 1e-16 + 1.0, a.astype(np.float32), a.reshape(3, 2)]
    assert len({array_digest(a), *(array_digest(b) for b in different)}) == 5


def test_every_key_that_is_used_has_a_reference():
    problem = asp.ContactProblem(asp.Surface(np.zeros((4, 4)), 1.0), asp.Elastic(1.0, 0.3), law=asp.Hardness(1.0))
    objects = [problem, asp.Periodic(), asp.Free(), asp.HardWall(), *(cls() for cls in asp.solvers.SOLVERS.values())]
    assert set(citation_keys(*objects)) <= set(REFERENCES)
    text = asp.cite(*objects)
    assert text.count("\n") == len(citation_keys(*objects)) - 1
    assert "Polonsky" in text
    with pytest.raises(asp.InputError, match="Nobody1900"):
        reference("Nobody1900")
