"""The pages can be read where they lie, in a checkout or on the page of the repository: no link
leads to what only the site has."""

from __future__ import annotations

import re
from pathlib import Path

import assemble
from doc_pages import BLOCK, DOCS, ROOT, links

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]


def anchors(page: Path) -> set[str]:
    """Anchors of the headings of ``page``, as the site and common viewers make them."""
    titles = re.findall(r"^#+ (.+)$", BLOCK.sub("", page.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def test_every_link_leads_to_a_file_of_the_checkout_and_to_a_heading_there():
    lost = []
    for page in PAGES:
        for target in links(page):
            if re.match(r"\w+:", target):
                continue
            path, _, anchor = target.partition("#")
            aim = (page.parent / path).resolve() if path else page
            if not aim.exists() or (anchor and aim.suffix == ".md" and anchor not in anchors(aim)):
                lost.append(f"{page.relative_to(ROOT)}: {target}")
    assert lost == []


def test_a_page_that_the_site_makes_has_the_same_title_in_the_checkout():
    made, known = assemble.made(), assemble.homes()
    in_checkout = {home: ROOT / path for path, home in known.items() if home in made}
    assert in_checkout
    for home, path in in_checkout.items():
        assert path.read_text(encoding="utf-8").splitlines()[0] == made[home].splitlines()[0]
