"""A part written here appears in documents, options, studies, files and reports with no other
change, and so does one that an installed package adds."""

from __future__ import annotations

import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest
from cli.conftest import BODY, LOAD, SCALE, Runner
from refusals import subject_of
from study_cases import PROBLEM, InProcess, plan

import asperity as asp
from asperity.cli.main import BAD_INPUT
from asperity.core.quantity import Quantity
from asperity.core.registry import PARTS, home
from asperity.core.settings import Settings, setting
from asperity.core.values import Pressure
from asperity.parts import registry
from asperity.parts.part import Found, Part, Solved, Table, Words
from asperity.plots.picture import Figure, png
from asperity.run import document as documents
from asperity.run.stored import save_outcome
from asperity.studies.collect import dataset
from asperity.studies.run import carry_out


class HotSettings(Settings):
    """Where the pressure is high."""

    level: Pressure = setting("100 MPa", help="Pressure from which a point counts")


class Hot(Part):
    """Share of the contact under a high pressure."""

    name = table = "hot"
    title = "Hot points"
    settings = HotSettings
    quantities = (Quantity("hot_share", "1", "share of the contact under a high pressure"),)

    def compute(self, ask: HotSettings, solved: Solved) -> Found:
        pressure = solved.result.pressure
        if ask.level > 1e12:
            raise ValueError("nothing is that hard")
        return Found({"hot_share": float((pressure >= ask.level).sum() / max((pressure > 0.0).sum(), 1))})

    def figures(self, found: Found, solved: Solved) -> tuple[Figure, ...]:
        picture = png(lambda ax: ax.hist(solved.result.pressure.ravel()), (3.0, 2.0), dpi=50)
        return (Figure("hot_map", "Hot points", "Where it is hot.", picture),)

    def words(self, found: Found, solved: Solved) -> Words:
        share = found.values["hot_share"]
        return Words(
            f"Hot: {share:.3g} of the contact.", tables=(("", Table(("Hot", "Value"), (("a", f"{share:.3g}"),))),)
        )


@pytest.fixture
def entry(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Sets the entry points that are installed, and forgets what was found before."""

    real = registry.metadata.entry_points

    def installed(**objects: Any) -> None:
        dist = SimpleNamespace(name="hot-spots", version="1.2")
        found = [
            SimpleNamespace(name=k, load=lambda v=v: v, dist=dist, module=Hot.__module__) for k, v in objects.items()
        ]
        monkeypatch.setattr(
            registry.metadata, "entry_points", lambda group="": found if group == registry.GROUP else real(group=group)
        )
        registry.parts.cache_clear()
        documents.document_model.cache_clear()

    yield installed
    monkeypatch.undo()
    registry.parts.cache_clear()
    documents.document_model.cache_clear()


def test_it_appears_everywhere(run: Runner, matrix: Path, tmp_path: Path, entry: Any) -> None:
    entry(hot=Hot)
    assert "HotSettings" in documents.json_schema()["$defs"]
    assert "--hot-level" in run("contact", "--help").stdout
    done = run("contact", matrix, *SCALE, *BODY, *LOAD, "--hot-level", "200MPa", "--out", tmp_path / "run")
    assert done.exit_code == 0, done.stderr
    outcome = asp.run(tmp_path / "run" / "problem.toml")
    assert outcome.case is not None
    assert outcome.case.asks["hot"].level == 2e8
    share = outcome.values["hot_share"]
    assert 0.0 < share < 1.0
    assert f"Hot: {share:.3g} of the contact." in (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    with h5py.File(tmp_path / "run" / "result.nc") as file:
        assert file["hot/hot_share"][()] == share
        assert json.loads(file.attrs["provenance"])["software"]["hot-spots"] == "1.2"
    assert f"hot_share,{share!r},1," in (tmp_path / "run" / "scalars.csv").read_text(encoding="utf-8")
    assert "hot-spots" in (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert run("plot", tmp_path / "run" / "result.nc", "--kind", "hot_map", "--out", tmp_path).exit_code == 0
    assert (tmp_path / "hot_map.png").read_bytes() == (tmp_path / "run" / "plots" / "hot_map.png").read_bytes()
    assert run("export", tmp_path / "run" / "result.nc", "--csv", tmp_path / "again.csv").exit_code == 0
    assert f"hot_share,{share!r},1," in (tmp_path / "again.csv").read_text(encoding="utf-8")
    refused = run("contact", matrix, *SCALE, *BODY, *LOAD, "--hot-level", "200nm")
    assert subject_of(refused) == "--hot-level"

    made = plan(
        problem={**PROBLEM, "hot": {}},
        axes=[{"path": "hot.level", "values": ["1 MPa", "1 GPa", "2 TPa"]}],
        quantities=["hot_share"],
    )
    carry_out(made, tmp_path / "r.log", InProcess())
    data = dataset(made, tmp_path / "r.log")
    assert data["hot_share"].attrs["long_name"] == "share of the contact under a high pressure"
    assert float(data["hot_share"][0]) > float(data["hot_share"][1])
    assert np.isnan(data["hot_share"][2]), "the part failed, the solve survived"


def test_the_part_of_the_guide_works(entry: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = Path(__file__).parents[2] / "docs/how-to/own-part.md"
    code = page.read_text(encoding="utf-8").partition("```python\n")[2].partition("```")[0]
    (tmp_path / "hot_spots.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    entry(hot=importlib.import_module("hot_spots").Hot)
    outcome = asp.run({**PROBLEM, "hot": {}})
    assert 0.0 < outcome.values["hot_share"] < 1.0
    assert any("under a high pressure" in words.sentence for _, words in outcome.sections)


def test_a_part_that_fails_is_a_finding(entry: Any) -> None:
    entry(hot=Hot())
    outcome = asp.run({**PROBLEM, "hot": {"level": "2 TPa"}})
    assert outcome.converged
    assert "Hot points could not be computed: ValueError: nothing is that hard" in [f.message for f in outcome.findings]


def test_parts_that_cannot_be_used_are_left_out(entry: Any) -> None:
    class Taken(Hot):
        quantities = (Quantity("approach", "m", "taken"),)

    entry(hot=Hot, other=object(), taken=Taken)
    with pytest.warns(UserWarning, match="other|taken") as told:
        found = registry.parts()
    assert [part.name for part in found] == [*(home(place).name for place in PARTS), "hot"]
    assert [name for name in ("other", "taken") for warning in told if repr(name) in str(warning.message)] == [
        "other",
        "taken",
    ]


def test_an_installed_package_adds_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A real entry point, as pip leaves it."""
    folder = tmp_path / "cold_spots-0.3.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: cold-spots\nVersion: 0.3\n", encoding="utf-8")
    (folder / "entry_points.txt").write_text("[asperity.parts]\ncold = cold_spots:Cold\n", encoding="utf-8")
    (tmp_path / "cold_spots.py").write_text(
        "from asperity.core.quantity import Quantity\n"
        "from asperity.parts.part import Found, Part\n\n"
        "class Cold(Part):\n"
        "    name = title = 'cold'\n"
        "    quantities = (Quantity('least_pressure', 'Pa', 'least pressure'),)\n\n"
        "    def compute(self, ask, solved):\n"
        "        return Found({'least_pressure': float(solved.result.pressure.min())})\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(tmp_path)
    registry.parts.cache_clear()
    try:
        assert asp.run(PROBLEM).values["least_pressure"] == 0.0
        assert registry.versions() == {"cold-spots": "0.3"}
        assert plan(axes=[{"path": "surface.seed", "values": [1]}], quantities=["least_pressure"])
    finally:
        registry.parts.cache_clear()
        sys.modules.pop("cold_spots", None)


def test_run_takes_parts_that_no_package_adds(tmp_path: Path) -> None:
    document = {**PROBLEM, "hot": {"level": "200 MPa"}}
    with pytest.raises(asp.InputError):
        asp.run(document)
    found = asp.run(document, parts=[Hot])
    pressure = found.result.pressure
    assert found.values["hot_share"] == (pressure >= 2e8).sum() / (pressure > 0.0).sum()
    assert [part.name for part, _ in found.sections][-1] == "hot"
    assert [figure.name for figure in found.figures["hot"]] == ["hot_map"]
    save_outcome(found, tmp_path / "result.nc")
    assert float(asp.files.open_tree(tmp_path / "result.nc")["hot/hot_share"]) == found.values["hot_share"]
    assert "hot_share" not in asp.run(PROBLEM, parts=[Hot]).values  # known, not asked for
    twice = asp.run({**PROBLEM, "hot": {}}, parts=[Hot()]).values["hot_share"]
    assert twice >= found.values["hot_share"]


@pytest.mark.parametrize("own", [object(), [Hot, Hot], type("Taken", (Hot,), {"name": "stress", "table": "stress"})])
def test_run_refuses_parts_that_cannot_be_used(own: object) -> None:
    with pytest.raises(asp.InputError) as caught:
        asp.run(PROBLEM, parts=own if isinstance(own, list) else [own])
    assert caught.value.subject == "part of one's own"


def test_the_physics_of_the_guide_is_installed(matrix: Path, tmp_path: Path) -> None:
    """Commands without it go on, what its table must have is asked for by the name of the option,
    and another process reads its files without an import."""
    page = (Path(__file__).parents[2] / "docs/develop/own-physics.md").read_text(encoding="utf-8")
    pieces = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    site = tmp_path / "site"
    info = site / "voltage-1.0.dist-info"
    info.mkdir(parents=True)
    code = "\n".join(piece for piece in pieces if "asp.solve(" not in piece)
    (site / "voltage.py").write_text(code, encoding="utf-8")
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: voltage\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[asperity.parts]\nvoltage = voltage:VoltagePart\n", encoding="utf-8")
    paths = os.pathsep.join([str(site), *filter(None, sys.path)])

    def program(*arguments: object) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "asperity", *map(str, arguments)]
        environment = {**os.environ, "PYTHONPATH": paths}
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=240, check=False)

    contact = ("contact", matrix, *SCALE, *BODY, *LOAD)
    assert program(*contact).returncode == 0
    lacking = program(*contact, "--electrostatic-volts", "10V")
    assert (lacking.returncode, lacking.stderr.count("--electrostatic-thickness")) == (BAD_INPUT, 1)
    done = program(
        *contact, "--electrostatic-volts", "10V", "--electrostatic-thickness", "5nm", "--out", tmp_path / "run"
    )
    assert done.returncode == 0, done.stderr
    read = program("export", tmp_path / "run" / "result.nc", "--csv", tmp_path / "again.csv")
    assert read.returncode == 0, read.stderr
    assert "electric_force," in (tmp_path / "again.csv").read_text(encoding="utf-8")
