"""Checks of HDF5 files of unknown origin before a library reads their contents."""

from __future__ import annotations

from typing import Any

from .errors import FileFormatError

SIGNATURE = b"\x89HDF\r\n\x1a\n"
"""First bytes of the superblock, which stands at byte 0, 512, 1024 and so on, doubling (HDF5 file
format specification, II.A)."""


def require_own_data(group: Any, what: str) -> None:
    """Refuse an open h5py ``group`` that takes anything, at any depth, from another file; ``what``
    names the file in the message.

    Raises
    ------
    FileFormatError
        If it holds a link to another file, a dataset with external storage or of a virtual kind, or
        damaged references.
    """
    import h5py

    waiting, seen = [group], set[int]()
    while waiting:
        parent = waiting.pop()
        for name in parent:
            link = parent.get(name, getlink=True)
            if isinstance(link, h5py.ExternalLink):
                raise FileFormatError(f"{what} must hold its data itself, but {name!r} is a link to {link.filename!r}.")
            if not isinstance(link, h5py.HardLink):
                # a soft link leads to an object of this file, which its hard link shows, or across
                # an external link
                continue
            item = parent[name]
            place = h5py.h5o.get_info(item.id).addr
            if place in seen:
                continue
            seen.add(place)
            if isinstance(item, h5py.Group):
                waiting.append(item)
            elif isinstance(item, h5py.Dataset):
                require_own_dataset(item, what, name)
                require_sound_references(item, what, name)


def require_own_dataset(dataset: Any, what: str, name: str) -> None:
    """Refuse an h5py ``dataset`` called ``name`` whose values lie in another file.

    Raises
    ------
    FileFormatError
        If it has external storage or is virtual.
    """
    if dataset.external or dataset.is_virtual:
        raise FileFormatError(f"{what} must hold its data itself, but {name!r} lies in another file.")


def require_sound_references(dataset: Any, what: str, name: str) -> None:
    """Refuse an h5py ``dataset`` called ``name`` whose attributes of dimension scales have another
    type or size than they must.

    The library takes ``DIMENSION_LIST`` for one list of references for each axis and
    ``REFERENCE_LIST`` for pairs of reference and axis (HDF5 Dimension Scale Specification, 4.2)
    without looking, and writes beyond its memory where they are not.

    Raises
    ------
    FileFormatError
        If one is not.
    """
    import h5py

    def sound(attribute: Any) -> bool:
        kind, shape = attribute.get_type(), attribute.shape
        if attribute.name == b"DIMENSION_LIST":
            one_each = shape == (len(dataset.shape or ()),)
            return one_each and isinstance(kind, h5py.h5t.TypeVlenID) and kind.get_super() == h5py.h5t.STD_REF_OBJ
        return (
            len(shape) == 1
            and isinstance(kind, h5py.h5t.TypeCompoundID)
            and kind.get_nmembers() == 2
            and kind.get_member_type(0) == h5py.h5t.STD_REF_OBJ
            and isinstance(kind.get_member_type(1), h5py.h5t.TypeIntegerID)
        )

    for text in (b"DIMENSION_LIST", b"REFERENCE_LIST"):
        if h5py.h5a.exists(dataset.id, text) and not sound(h5py.h5a.open(dataset.id, text)):
            raise FileFormatError(
                f"{what} must be a whole NetCDF-4 file, but attribute {text.decode()} of {name!r} is damaged."
            )
