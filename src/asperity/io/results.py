"""Results as one labelled file: contacts with all their physics, and load paths, written whole,
read back exactly.

The physics of a problem are described, and what their couplings found and remember is stored by the
codec, from what its fields say of themselves; nothing here knows one of them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias

from ..contact.history import HistoryResult
from ..contact.result import ContactResult
from ..contact.state import InterfaceState
from ..core.errors import FileFormatError, InputError
from ..core.registry import RESULTS
from ..core.text import require_file
from ..surfaces.profile import Profile
from ..surfaces.profile_netcdf import is_own, read_netcdf
from ..surfaces.surface import Surface
from .contacts import contact_from, contact_node
from .description import provenance, software
from .kept import contact_beside, group_name, kept_from, kept_node
from .paths import path_from, path_node
from .surface_files import require_ending, save_surface
from .tree import FORMAT_VERSION, Node, datatree, read_tree, require_sound_heaps, write_tree

if TYPE_CHECKING:
    import xarray
    from _typeshed import DataclassInstance

Steps: TypeAlias = Iterator[ContactResult]
"""Steps of a path that are still being solved, as they come from ``contact.solve.steps``."""

Result: TypeAlias = "ContactResult | HistoryResult | DataclassInstance"
"""What result files hold: contacts, load paths, and the types of ``core.registry.RESULTS``."""

Heights: TypeAlias = Surface | Profile
"""Maps and line scans, which have files of their own."""


def save(
    result: Result | Steps | Heights,
    path: str | Path,
    *,
    document: str | None = None,
    overwrite: bool = False,
    start: InterfaceState | None = None,
) -> None:
    """Write ``result``, and the text of the problem ``document`` it came from, to the NetCDF-4 file
    ``path``.

    The file has one group for each part of the result, units and long names on every variable;
    ``load`` gives an equal result.

    Of a path that is longer than the memory give the steps as they are solved,
    ``save(asperity.contact.steps(problem, history), "path.nc")``, and the interface that they
    ``start`` from: they are written and forgotten. Such a file is that of the ``HistoryResult``
    without the energies, which ``load`` computes when they are read.

    A surface or a line scan is written as by ``files.save_surface``, and comes back from ``load``
    and ``read``.

    Raises
    ------
    OutputError
        If the file does not end in .nc, exists and ``overwrite`` is false, or cannot be written.
    InputError
        If the problem holds a type that files cannot hold, or a document or start is given for a
        surface.
    """
    if isinstance(result, Surface | Profile):
        if document is not None or start is not None:
            raise InputError(
                "document and start must be left out where a surface or line scan is saved, but are given: its file "
                "holds heights alone.",
                subject="document and start",
            )
        require_ending(Path(path), (".nc",))
        save_surface(result, path, overwrite=overwrite)
        return
    if isinstance(result, Iterator):
        tree = _tree_of_steps(result, start, document)
    else:
        tree = result_tree(result, document=document, streamed=True)
    write_tree(tree, path, overwrite=overwrite)


def _tree_of_steps(steps: Steps, start: InterfaceState | None, document: str | None) -> Node:
    """Tree of a path whose steps are solved as they are written; the last of them follows as the
    contact."""
    last = list[ContactResult]()

    def passed() -> Steps:
        for step in steps:
            last[:] = [step]
            yield step

    def contact() -> Iterator[Node]:
        yield Node((), root_attributes(last[0], document), {"contact": contact_node(last[0])})

    path = path_node(passed(), start, streamed=True)
    if not path.rows:  # all steps are solved
        return Node((), root_attributes(last[0], document), {"path": path, "contact": contact_node(last[0])})
    return Node((), {}, {"path": path}, contact())


def load(path: str | Path) -> Any:
    """The result in the file ``path``, equal to the one that was saved: same fields to the bit,
    same problem.

    Displacement and gap of the steps of a load path come back by one transform of the pressures
    when they are first read, to a ``rounding`` that the file states of each step
    (``open_tree(path)["path/rounding"]``); the states of all steps are those that were saved, to
    the bit.

    A ``ContactResult``, ``HistoryResult``, ``RollingContact``, ``StressField`` or
    ``dynamics.Motion``, or a state of finite elements from which a history goes on; of the outcome
    of a document the contact. A ``Surface`` or ``Profile`` of a file that ``save`` wrote.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, not a result of asperity, or of a newer
        format.
    """
    file = require_file(path, "result file")
    if is_own(file):
        return read_netcdf(file)
    return result_in(read_tree(file, without=("planes", "stress")), path)


def open_tree(path: str | Path) -> xarray.DataTree:
    """The result file ``path`` as ``xarray.DataTree`` in memory, for analysis; the same as
    ``to_xarray`` of what it holds.

    Raises
    ------
    FileFormatError
        As for ``load``.
    """
    return datatree(read_tree(path))


def to_xarray(result: Result, *, document: str | None = None) -> xarray.DataTree:
    """``result`` as ``xarray.DataTree``: one group for each part, units and long names on every
    variable.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    return datatree(result_tree(result, document=document))


def document_in(path: str | Path) -> str | None:
    """Text of the problem document in the result file ``path``, None if it was saved without one.

    Raises
    ------
    FileFormatError
        If the file is missing or no NetCDF-4 file.
    """
    import h5py

    try:
        require_sound_heaps(require_file(path, "result file"))
        with h5py.File(path, "r") as file:
            text = file.attrs.get("document")
    except FileFormatError:
        raise
    except Exception as error:  # the library raises many types on foreign or damaged bytes
        raise FileFormatError(f"result file must be a whole NetCDF-4 file, but {path} is not ({error}).") from error
    return None if text is None else str(text)


def contact_of(result: Any) -> ContactResult:
    """The contact of a ``result``: of a load path that at its end, of a rolling contact the normal
    one.

    Raises
    ------
    InputError
        If there is none in it, as in a stress field.
    """
    found = result.last if isinstance(result, HistoryResult) else result
    found = contact_beside(found) or found
    if not isinstance(found, ContactResult):
        raise InputError(f"result file must hold a contact for this, but holds a {type(result).__name__}.")
    return found


def result_in(tree: Node, path: str | Path) -> Any:
    """The result that the ``tree`` of the file ``path`` holds.

    Raises
    ------
    FileFormatError
        If it holds none, or not the whole of one.
    """
    groups = tree.children
    with whole(path):
        if "tractions" in groups:
            raise FileFormatError(
                f"result file must hold a contact or a stress field, but {path} holds stresses under "
                "prescribed tractions; read it with open_tree."
            )
        name = next((name for name in RESULTS if name in groups), "")
        if "contact" not in groups and name:
            return kept_from(groups[name], name)
        result = contact_in(tree)
        if "of_outcome" in tree.attributes:
            return result
        if "path" in groups:
            return path_in(tree, result)
        return kept_from(groups[name], name, result) if name else result


def old_format(tree: Node) -> bool:
    """Whether the ``tree`` is one of format 2."""
    return bool(tree.attributes.get("asperity_format", FORMAT_VERSION) == 2)


def contact_in(tree: Node) -> ContactResult:
    """The contact that the ``tree`` of a file holds."""
    if old_format(tree):
        from .format2 import contact_in as older

        return older(tree.children)
    return contact_from(tree.children["contact"])


def path_in(tree: Node, last: ContactResult) -> HistoryResult:
    """The load path that the ``tree`` of a file holds, whose ``last`` step is the contact of the
    file."""
    if old_format(tree):
        from .format2 import path_from as older

        return older(tree.children["path"], last)
    return path_from(tree.children["path"], last)


@contextmanager
def whole(path: str | Path) -> Iterator[None]:
    """Within it, whatever is missing or wrong in what the file ``path`` holds is a
    ``FileFormatError``."""
    try:
        yield
    except FileFormatError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, AssertionError, RuntimeError) as error:
        reason = " ".join(f"{type(error).__name__} {error}".split())[:200]
        raise FileFormatError(
            f"result file must hold a whole result, but {path} lacks or garbles something ({reason})."
        ) from error


def result_tree(result: Result, *, document: str | None = None, streamed: bool = False) -> Node:
    """Tree of ``result``: what files hold and ``to_xarray`` gives; where it is ``streamed`` the
    steps of a load path are made as they are written.

    Raises
    ------
    InputError
        If the problem holds a type that files do not know.
    """
    if isinstance(result, HistoryResult):
        groups = result_tree(result.last).children
        path = path_node(result, streamed=streamed)
        return Node((), root_attributes(result.last, document), {**groups, "path": path})
    if isinstance(result, ContactResult):
        return Node((), root_attributes(result, document), {"contact": contact_node(result)})
    name = group_name(result)
    if not name:
        raise InputError(
            "result to save must be a result of solve or roll, a load path, a stress field, a motion, a state of "
            f"finite elements, a surface or a line scan, but is {type(result).__name__}."
        )
    own = {name: kept_node(result, name)}
    contact = contact_beside(result)
    if contact is not None:
        return Node((), root_attributes(contact, document), {**result_tree(contact).children, **own})
    described = {"created": datetime.now(UTC).isoformat(timespec="seconds"), "software": software()}
    return Node((), {"title": RESULTS[name].title, "provenance": json.dumps(described)}, own)


def root_attributes(
    result: ContactResult, document: str | None, packages: Mapping[str, str] = MappingProxyType({})
) -> dict[str, Any]:
    """What describes a whole file: title, provenance (with ``packages``), citation keys, and the
    text of the ``document``."""
    attributes = {
        "title": "contact of rough surfaces",
        "provenance": json.dumps(provenance(result, packages)),
        "citation_keys": " ".join(result.citation_keys),
    }
    return attributes if document is None else attributes | {"document": document}
