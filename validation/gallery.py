"""A gallery of measured surfaces: every file of a folder characterised, with a page for each and
one for all.

Usage: python validation/gallery.py [FOLDER] [--out gallery] [--level plane]; the folder is
../shared/data if none is named.

The pages hold pictures of the data and are not part of this repository.
"""

from __future__ import annotations

import argparse
import base64
from dataclasses import dataclass
from html import escape
from operator import attrgetter
from pathlib import Path

import asperity as asp
from asperity.core.units import show
from asperity.plots.picture import render
from asperity.plots.surface import SURFACE_PLOTS

SHOWN = ("heights", "spectrum", "autocorrelation")
"""Pictures of each file on the page of all."""

COLUMNS = (
    "heights.Sq",
    "heights.Sz",
    "heights.Ssk",
    "heights.Sku",
    "hybrid.Sdq",
    "spatial.Sal",
    "spatial.Str",
    "spectrum.hurst",
)
"""Numbers of each file in the table."""

STYLE = (
    "body{font:16px/1.5 system-ui,sans-serif;max-width:72rem;margin:0 auto;padding:1.5rem;color:#1b1f24}"
    "table{border-collapse:collapse;width:100%;font-size:.9rem}"
    "th,td{text-align:left;padding:.3rem .8rem .3rem 0;border-bottom:1px solid #d5dae0}"
    ".pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(18rem,1fr));gap:1rem}"
    "img{max-width:100%;max-height:18rem}"
    "h2{border-bottom:2px solid #d5dae0;overflow-wrap:anywhere}p{color:#55606c}"
)


@dataclass(frozen=True)
class Entry:
    """One file: its ``name``, what was ``found``, or the sentence why it cannot be read."""

    name: str
    found: asp.roughness.Characterisation | None
    fault: str = ""


def entries(folder: Path, level: str = "plane") -> list[Entry]:
    """Every file of ``folder`` but notes, levelled and characterised."""
    files = sorted(path for path in folder.iterdir() if path.is_file() and path.suffix.lower() not in (".md", ".txt"))
    return [_entry(path, level) for path in files]


def write_gallery(folder: Path, out: Path, level: str = "plane") -> list[Entry]:
    """Write ``index.html`` and a page for each file of ``folder`` into ``out`` (made if
    missing)."""
    out.mkdir(parents=True, exist_ok=True)
    made = entries(folder, level)
    for entry in made:
        if entry.found is not None:
            asp.report.write_roughness_report(entry.found, out / f"{entry.name}.html", overwrite=True)
    (out / "index.html").write_text(_index(made, level), encoding="utf-8")
    return made


def _entry(path: Path, level: str) -> Entry:
    try:
        return Entry(path.name, asp.characterise(asp.levelled(asp.read(path), level)))
    except asp.InputError as error:
        return Entry(path.name, None, str(error))


def _index(made: list[Entry], level: str) -> str:
    named = {quantity.name: quantity for quantity in asp.roughness.QUANTITIES}
    head = "".join(f"<th>{escape(named[path].label)}</th>" for path in COLUMNS)
    rows, sections = [], []
    for entry in made:
        if entry.found is None:
            rows.append(
                f'<tr><td>{escape(entry.name)}</td><td colspan="{len(COLUMNS)}">{escape(entry.fault)}</td></tr>'
            )
            continue
        cells = "".join(f"<td>{_text(named[path], entry.found)}</td>" for path in COLUMNS)
        link = f'<a href="{escape(entry.name)}.html">{escape(entry.name)}</a>'
        rows.append(f"<tr><td>{link}</td>{cells}</tr>")
        sections.append(_section(entry.name, entry.found))
    return (
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Measured surfaces</title>'
        f"<style>{STYLE}</style></head><body>"
        f"<h1>Measured surfaces</h1><p>After {escape(level)} levelling.</p>"
        f"<table><thead><tr><th>file</th>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>{''.join(sections)}</body></html>\n"
    )


def _text(quantity: asp.roughness.Quantity, found: asp.roughness.Characterisation) -> str:
    value = float(attrgetter(quantity.name)(found))
    return "–" if value != value else show(value, quantity.unit, 3)


def _section(name: str, found: asp.roughness.Characterisation) -> str:
    pictures = [plot for plot in SURFACE_PLOTS if plot.name in SHOWN]
    shown = "".join(
        f'<figure><img alt="{escape(plot.title)}" '
        f'src="data:image/png;base64,{base64.b64encode(render(plot, found)).decode("ascii")}">'
        f"<figcaption>{escape(plot.title)}</figcaption></figure>"
        for plot in pictures
    )
    remarks = "".join(f"<p>{escape(remark)}</p>" for remark in found.remarks)
    return f'<h2><a href="{escape(name)}.html">{escape(name)}</a></h2>{remarks}<div class="pictures">{shown}</div>'


def main() -> None:
    """Read the command line and write the gallery."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="?", default=Path(__file__).parents[2] / "shared" / "data")
    parser.add_argument("--out", type=Path, default=Path("gallery"))
    parser.add_argument("--level", default="plane")
    options = parser.parse_args()
    if not options.folder.is_dir():
        parser.exit(0, f"no gallery: {options.folder} is no folder\n")
    for entry in write_gallery(options.folder, options.out, options.level):
        print(f"{entry.name}: {'characterised' if entry.found is not None else entry.fault}")


if __name__ == "__main__":
    main()
