"""Documents of version 1: friction moves into a table of its own, and the numbers stay what they
were."""

from __future__ import annotations

from typing import Any

from refusals import refused
from study_cases import PROBLEM, plan

import asperity as asp
from asperity.run.build import build
from asperity.run.document import checked, dumps, loads

FILM = {"liquid": "PFPE", "thickness": "1 nm"}


def asked(**tables: Any) -> dict[str, Any]:
    return build(checked({**PROBLEM, "version": 1, **tables})).asks


def test_friction_of_stresses_has_its_own_table() -> None:
    old = {"friction": 0.3, "direction": "90 deg", "coupled": True, "depths": ["5 nm"]}
    document = checked({**PROBLEM, "version": 1, "stress": old})
    assert document.version == 2
    friction = document.friction
    assert (friction.coefficient, friction.direction.text, friction.coupled) == (0.3, "90 deg", True)
    assert loads(dumps(document)) == document
    request = build(document).asks["stress"]
    assert (request.friction, request.coupled, request.depths) == (0.3, True, (5e-9,))


def test_friction_of_a_film_has_it_too_and_does_not_shear_the_body() -> None:
    film = {**FILM, "friction": 0.2, "speed": "1 mm/s", "viscosity": "1 Pa*s"}
    found = asked(film=film)["film"].friction
    assert (found.coefficient, found.speed) == (0.2, 1e-3)
    beside = asked(film=film, stress={"depths": ["0 nm"]})
    assert (beside["film"].friction.coefficient, beside["stress"].friction) == (0.2, 0.0)
    same = asked(film=film, stress={"friction": 0.2})
    assert (same["film"].friction.coefficient, same["stress"].friction) == (0.2, 0.2)


def test_two_coefficients_in_one_contact_are_refused() -> None:
    with refused(asp.InputError, "stress.friction", "0.3", "0.2"):
        asked(film={**FILM, "friction": 0.2}, stress={"friction": 0.3})


def test_a_coefficient_that_is_no_number_is_refused() -> None:
    with refused(asp.InputError, "problem document: friction.coefficient"):
        asked(film={**FILM, "friction": [0.2]}, stress={"depths": ["0 nm"]})


def test_paths_of_studies_lead_to_the_new_key() -> None:
    made = plan(
        problem={**PROBLEM, "version": 1, "stress": {}}, axes=[{"path": "stress.friction", "values": [0.1, 0.2]}]
    )
    assert [edit.keys for point in made.axes[0].points for edit in point.edits] == [("friction", "coefficient")] * 2
    assert made.axes[0].name == "friction"
