"""What the site is made of is sound: links resolve, contents reach every page, and what is declared
is on a page."""

from __future__ import annotations

import os
import re
from collections import Counter
from fnmatch import fnmatch
from pathlib import PurePosixPath

import assemble
import commands
import formulas
import numpy as np
import pytest
import thumbnails
from matplotlib.figure import Figure
from PIL import Image

import asperity
from asperity.core.citations import reference
from asperity.run.document import json_schema
from asperity.theories.catalogue import FAMILIES

THEORIES = [kind for kinds in FAMILIES.values() for kind in kinds]


@pytest.fixture(scope="module")
def pages() -> dict[str, str]:
    """Every page of the site; a link that leads nowhere in the repository is an error already
    here."""
    found = assemble.pages()
    if assemble.examples():
        found[assemble.gallery()] = assemble.examples()["GALLERY_HEADER.rst"]  # the gallery makes its own page
    return found


def entries(page: str, text: str) -> list[str]:
    """Pages, or patterns of them, in the tables of contents of a page; without ending."""
    folder = PurePosixPath(page).parent
    lines = [
        line.strip()
        for block in re.findall(r"```\{toctree\}\n(.*?)```", text, re.DOTALL)
        for line in block.splitlines()
    ]
    aims = [re.sub(r".*<(.+)>", r"\1", line) for line in lines if line and not line.startswith(":")]
    return [os.path.normpath(folder / aim) for aim in aims]


def meant(entry: str, names: set[str]) -> set[str]:
    """Pages that an entry stands for; an asterisk means those in one folder."""
    return {name for name in names if fnmatch(name, entry) and name.count("/") == entry.count("/")}


def test_contents_reach_every_page_and_name_no_other(pages):
    listed = {page.rpartition(".")[0]: entries(page, text) for page, text in pages.items()}
    names = set(listed)
    assert [f"{page}: {entry}" for page in listed for entry in listed[page] if not meant(entry, names)] == []
    reached: set[str] = set()
    front = {"index"}
    while front:
        reached |= front
        front = {name for page in front for entry in listed[page] for name in meant(entry, names)} - reached
    assert sorted(names - reached) == []


def test_every_page_has_a_title_of_its_own(pages):
    """Search, contents and browser tabs show nothing but titles."""
    titles = Counter()
    for text in pages.values():
        prose = re.sub(r"^[ ]*```.*?^[ ]*```", "", text, flags=re.DOTALL | re.MULTILINE)
        titles.update(title.strip().casefold() for title in re.findall(r"^# (.+)$", prose, re.MULTILINE)[:1])
    assert [title for title, count in titles.items() if count > 1] == []


def test_links_between_pages_resolve(pages):
    lost = []
    for page, text in pages.items():
        prose = re.sub(r"^[ ]*```.*?^[ ]*```", "", text, flags=re.DOTALL | re.MULTILINE)
        titles = re.findall(r"^#+ (.+)$", prose, re.MULTILINE)
        anchors = {title.lower().replace(" ", "-") for title in titles} | set(
            re.findall(r"^\(([\w-]+)\)=", prose, re.MULTILINE)
        )
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", prose)):
            path, _, anchor = target.partition("#")
            if re.match(r"\w+:", target):
                continue
            aim = os.path.normpath(PurePosixPath(page).parent / path) if path else page
            picture = (assemble.ROOT / "docs" / aim).exists() and not aim.endswith(".md")
            if not (aim in pages or picture) or (not path and anchor not in anchors):
                lost.append(f"{page}: {target}")
    assert lost == []


def test_thumbnails_of_wide_figures_show_their_first_panel(tmp_path):
    """Three panels in a row and one on its own, as the gallery stores them."""
    for name, (columns, size) in {"wide": (3, (13.0, 3.8)), "plain": (1, (7.0, 4.5))}.items():
        figure = Figure(size, layout="constrained", dpi=100)
        for number, ax in enumerate(np.atleast_1d(figure.subplots(1, columns))):
            ax.plot([0.0, 1.0], [0.0, number + 1.0])
            ax.set(xlabel="pressure (GPa)", ylabel="area (%)")
        images = tmp_path / "beginner" / "images"
        (images / "thumb").mkdir(parents=True, exist_ok=True)
        figure.savefig(images / f"sphx_glr_{name}_001.png")
        Image.new("RGB", thumbnails.SIZE, "red").save(images / "thumb" / f"sphx_glr_{name}_thumb.png")
    thumbnails.make_legible(tmp_path)
    with Image.open(images / "sphx_glr_wide_001.png") as whole:
        part = thumbnails.first_panel(whole)
        assert part.width == pytest.approx(whole.width / 3.0, abs=0.02 * whole.width)
    with Image.open(images / "thumb" / "sphx_glr_wide_thumb.png") as shown:
        assert shown.size == thumbnails.SIZE
        ink = np.asarray(shown.convert("L")) < 200
        assert np.ptp(np.flatnonzero(ink.any(axis=1))) > 0.8 * thumbnails.SIZE[1]
    with Image.open(images / "thumb" / "sphx_glr_plain_thumb.png") as left_alone:
        assert left_alone.getpixel((0, 0)) == (255, 0, 0)


def test_every_theory_has_formulas_limits_and_sources_on_its_page(pages):
    text = pages["reference/theories.md"]
    for kind in THEORIES:
        section = text.split(f"### {kind.title}\n")[1].split("\n### ")[0].split("\n## ")[0]
        assert f"`{kind.name}`" in section
        made = formulas.formulas(kind.__doc__)
        assert made, f"the docstring of {kind.__name__} needs its formulas on lines of their own"
        for formula in made:
            assert f"$$\n{formula}\n$$" in section
            assert formula.count("{") == formula.count("}")
        for bound in kind.limits:
            assert f"[{bound.citation}]" in section
        for key in kind.citation_keys:
            assert f"[{key}]" in section
            assert reference(key) in text


@pytest.mark.parametrize(
    ("plain", "made"),
    [
        ("a³ = 3 P R/(4 E*)", r"a^{3} = 3 P R/(4 E^{*})"),
        ("p = (4/3) η E* R^(1/2),  n = σ_s", r"p = \tfrac{4}{3} \eta  E^{*} R^{1/2}, \quad n = \sigma _s"),
        ("A = erf[sqrt(2) p̄/h'_rms]", r"A = \operatorname{erf}[\sqrt{2} \bar{p}/h'_{\mathrm{rms}}]"),
        ("F = ∫_(D_0)^∞ f(s) ds", r"F = \int _{D_0}^\infty  f(s) \,ds"),
    ],
)
def test_formulas_of_docstrings_become_tex(plain, made):
    assert formulas.tex(plain) == made
    assert formulas.is_formula(f"    {plain}.")


@pytest.mark.parametrize(
    "line", ["    >>> x = 3", "where a = 3 holds", "    load = body.load(3)", "* n = 3 points", "A_r/A_a is the area"]
)
def test_other_lines_are_no_formulas(line):
    assert not formulas.is_formula(line)


def test_every_public_name_stands_on_one_page(pages):
    shown = re.findall(
        r"^\.\. auto(?:class|function|exception):: asperity\.([\w.]+)$", "\n".join(pages.values()), re.MULTILINE
    )
    modules = {name: getattr(asperity, name) for name in asperity.__all__}
    wanted = [
        f"{name}.{one}" for name, module in modules.items() for one in module.__all__ if callable(getattr(module, one))
    ]
    assert sorted(shown) == sorted([*wanted, "cite"])
    index = pages["reference/api/index.md"]
    assert set(re.findall(r"^\| `(\w+)` \|", index, re.MULTILINE)) == {
        n for n in dir(asperity) if asperity._HOME.get(n)
    }


def test_every_command_and_every_key_of_the_document_is_listed(pages):
    text = pages["reference/commands.md"]
    assert {"contact", "theory", "run", "info"} <= set(commands.names())
    assert re.findall(r"^## asperity (\S+)$", text, re.MULTILINE) == commands.names()
    schema = json_schema()
    rows = set(re.findall(r"^\| `(\w+)` \|", pages["reference/document.md"], re.MULTILINE))
    keys = {key for table in (schema, *schema["$defs"].values()) for key in table.get("properties", {})}
    assert keys <= rows
