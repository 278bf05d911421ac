"""Sphinx extension: formulas as MathML, which browsers draw without script and without network;
every displayed one numbered."""

from __future__ import annotations

import html
import shutil
from importlib.resources import as_file, files
from pathlib import Path
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform

FONT = "STIXTwoMath-Regular.ttf"


class Numbered(SphinxTransform):
    """Gives displayed formulas without a label a number, as those with one have."""

    default_priority = 100

    def apply(self, **kwargs: Any) -> None:
        """Label every formula of the page that has none."""
        domain = self.env.get_domain("math")
        for place, node in enumerate(self.document.findall(nodes.math_block), start=1):
            if not node.get("label"):
                node["docname"], node["label"] = self.env.docname, f"{self.env.docname}:{place}"
                node["ids"] = [nodes.make_id(f"equation-{node['label']}")]
                domain.note_equation(self.env.docname, node["label"], location=node)
                node["number"] = domain.get_equation_number_for(node["label"])


def inline(translator: Any, node: nodes.math) -> None:
    """Write a formula within a line."""
    translator.body.append(f'<span class="formula">{convert(html.unescape(node.astext()))}</span>')
    raise nodes.SkipNode


def displayed(translator: Any, node: nodes.math_block) -> None:
    """Write a formula on lines of its own, with its number."""
    made = convert(node.astext().strip(), display="block")
    label = f'<a class="eqno" href="#{node["ids"][0]}">({node["number"]})</a>' if node.get("number") else ""
    place = f' id="{node["ids"][0]}"' if node["ids"] else ""
    translator.body.append(f'<div class="formula"{place}><div class="formula-itself">{made}</div>{label}</div>\n')
    raise nodes.SkipNode


def font(app: Sphinx, failure: Exception | None) -> None:
    """Put the font of the formulas beside the pages."""
    if failure is None and app.builder.format == "html":
        with as_file(files("ziamath") / "fonts" / FONT) as path:
            shutil.copy(path, Path(app.outdir) / "_static" / FONT)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer, the numbers and the font."""
    app.add_html_math_renderer("mathml", (inline, None), (displayed, None))
    app.add_transform(Numbered)
    app.connect("build-finished", font)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
