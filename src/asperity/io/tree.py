"""Labelled trees: values with units in groups, as one NetCDF-4 file and as ``xarray.DataTree``."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FileFormatError, OutputError
from ..core.hdf5_files import SIGNATURE, require_own_dataset, require_sound_references
from ..core.quantity import Labelled, Quantity
from ..core.status import require_memory
from ..core.text import require_file
from .atomic import atomic_file

if TYPE_CHECKING:
    import h5netcdf
    import xarray

FORMAT_VERSION = 2
"""Version of the layout of result files; raised whenever an older asperity could misread a newer file."""

SPARSE = 0.5
"""Share of values that are not zero below which a variable is packed, which then costs little and saves much."""


@dataclass(frozen=True, eq=False)
class Node:
    """One group of a labelled tree.

    Attributes
    ----------
    values
        Numbers, text and arrays with what they are; the ``dims`` of the quantity name the axes of an array. An array named
        like its only axis is the coordinate of that axis.
    attributes
        Text and numbers that describe the whole.
    children
        Groups within, by name.
    rows
        Nodes of the same values that follow this one along the first axis of its arrays, written one after the other, so that
        they need not be in memory together.
    """

    values: tuple[Labelled, ...] = ()
    attributes: Mapping[str, Any] = field(default_factory=dict)
    children: Mapping[str, Node] = field(default_factory=dict)
    rows: Iterable[Node] = ()

    def __getitem__(self, name: str) -> Any:
        """Values by name.

        Raises
        ------
        KeyError
            If there are none.
        """
        for item in self.values:
            if item.quantity.name == name:
                return item.values
        raise KeyError(name)

    def get(self, name: str) -> Any:
        """Values by name, None if there are none."""
        return next((item.values for item in self.values if item.quantity.name == name), None)

    def __contains__(self, name: object) -> bool:
        return any(item.quantity.name == name for item in self.values)

    def dims(self) -> dict[str, int]:
        """Length of each axis by its name."""
        return {
            dim: n for item in self.values for dim, n in zip(item.quantity.dims, np.shape(item.values), strict=True)
        }


def coordinate(axis: str, values: Any) -> Labelled:
    """Positions in m along ``axis`` as a coordinate."""
    return Labelled(Quantity(axis, "m", f"position along {axis}", dims=(axis,)), np.asarray(values))


def write_tree(tree: Node, path: str | Path, *, overwrite: bool = False) -> None:
    """Write ``tree`` to the NetCDF-4 file ``path``.

    Raises
    ------
    OutputError
        If the file has another ending than .nc, exists and ``overwrite`` is false, or cannot be written.
    """
    if Path(path).suffix.lower() not in (".nc", ".nc4", ".h5"):
        raise OutputError(
            f"result file must end in .nc, but is {path}; scalars as CSV: export_csv, fields as VTK: export_vtk."
        )
    with atomic_file(path, overwrite=overwrite) as partial, _writable(partial) as (file, sink):
        file.attrs["asperity_format"] = FORMAT_VERSION
        _write(tree, file, sink)


def read_tree(path: str | Path, *, without: tuple[str, ...] = ()) -> Node:
    """The tree in the NetCDF-4 file ``path``, in memory; groups whose name is in ``without`` are left out.

    Raises
    ------
    FileFormatError
        If the file is missing, damaged, not NetCDF-4, not written by asperity, or of a newer format.
    """
    import h5netcdf
    import h5py

    require_file(path, "result file")
    with Path(path).open("rb") as start:
        if start.read(8) != SIGNATURE:
            raise FileFormatError(
                f"result file must be one that asperity has written (result.nc), but {path} is no NetCDF-4 file. "
                f"What a file with heights holds is shown by: asperity info {path}"
            )
    try:
        require_sound_heaps(path)
        with h5py.File(path, "r") as content:
            size = _size_of_own(content, set())
            require_memory(
                size, "result file", f"{size:.3g} bytes of {path}", "use a machine with more memory", FileFormatError
            )
            with h5netcdf.File(content, "r", decode_vlen_strings=True) as file:
                tree = _read(file, without)
    except (MemoryError, FileFormatError):
        raise
    except Exception as error:  # the library raises many types on foreign or damaged bytes
        raise FileFormatError(
            f"result file must be a whole NetCDF-4 file, but {path} is not ({error}). Was the copy interrupted?"
        ) from error
    version = tree.attributes.get("asperity_format")
    if isinstance(version, bool) or not isinstance(version, int):
        raise FileFormatError(f"result file must be written by asperity, but {path} is another NetCDF-4 file.")
    if version > FORMAT_VERSION:
        raise FileFormatError(
            f"result file must be of format {FORMAT_VERSION} or older, but {path} is of {version}; update asperity."
        )
    return tree


def require_sound_heaps(path: str | Path) -> None:
    """Refuse an HDF5 file with a heap of texts in which the library (2.0 and before) would read for ever.

    A collection ``GCOL`` is a chain of objects; a free one of size zero, as in a damaged file, leads to itself.

    Raises
    ------
    FileFormatError
        If there is any of this.
    """
    with Path(path).open("rb") as file, closing(mmap(file.fileno(), 0, access=ACCESS_READ)) as content:
        start = content.find(b"GCOL\x01\0\0\0")
        while start >= 0:
            end = start + int.from_bytes(content[start + 8 : start + 16], "little")
            place = start + 16
            while place + 16 <= min(end, len(content)):
                index = int.from_bytes(content[place : place + 2], "little")
                size = int.from_bytes(content[place + 8 : place + 16], "little")
                if index == 0 and size == 0:
                    raise FileFormatError(f"result file must be a whole NetCDF-4 file, but {path} is damaged.")
                place += size if index == 0 else 16 + -(-size // 8) * 8
            start = content.find(b"GCOL\x01\0\0\0", start + 8)


def _size_of_own(group: Any, seen: set[Any]) -> float:
    """Bytes of the data of a group; links out of the file, data kept in other files and groups within themselves are refused.

    Raises
    ------
    FileFormatError
        If there is any of this.
    """
    import h5py

    size = 0.0
    for name in group:
        link = group.get(name, getlink=True)
        if not isinstance(link, h5py.HardLink):
            raise FileFormatError(f"result file must hold its data itself, but {name!r} is a link to {link.path!r}.")
        item = group[name]
        place = h5py.h5o.get_info(item.id).addr
        if place in seen:
            raise FileFormatError(f"result file must hold its groups once, but {name!r} is there twice.")
        seen.add(place)
        if isinstance(item, h5py.Group):
            size += _size_of_own(item, seen)
        elif isinstance(item, h5py.Dataset):
            require_own_dataset(item, "result file", name)
            require_sound_references(item, "result file", name)
            size += item.size * item.dtype.itemsize if item.shape is not None else 0.0
    return size


def datatree(tree: Node) -> xarray.DataTree:
    """``tree`` as ``xarray.DataTree``: units and long names on every variable, coordinates in each group that has them."""
    import xarray

    return xarray.DataTree.from_dict({place: _dataset(node) for place, node in _walk(tree, "/")})


def node_of(data: xarray.Dataset) -> Node:
    """Group of the variables, coordinates and attributes of ``data``."""
    values = []
    for name, variable in data.variables.items():
        unit, label = (str(variable.attrs.get(key, "")) for key in ("units", "long_name"))
        quantity = Quantity(str(name), unit, label or str(name), dims=tuple(map(str, variable.dims)))
        values.append(Labelled(quantity, np.asarray(variable)))
    return Node(tuple(values), {str(name): value for name, value in data.attrs.items()})


def _walk(node: Node, place: str) -> Iterator[tuple[str, Node]]:
    yield place, node
    for name, child in node.children.items():
        yield from _walk(child, f"{place.rstrip('/')}/{name}")


def _dataset(node: Node) -> xarray.Dataset:
    import xarray

    parts = [node, *node.rows]
    variables = {}
    for number, item in enumerate(node.values):
        quantity = item.quantity
        arrays = [part.values[number].values for part in parts]
        joined = (
            arrays[0] if len(parts) == 1 or not quantity.dims or quantity.dims[0] != "plane" else np.concatenate(arrays)
        )
        variables[quantity.name] = (quantity.dims, joined, quantity.attributes)
    names = [name for name, (dims, _, _) in variables.items() if dims == (name,)]
    coordinates = {name: variables.pop(name) for name in names}
    return xarray.Dataset(variables, coordinates, dict(node.attributes))


def _write(node: Node, group: h5netcdf.Group, sink: _Sink) -> None:
    rows = iter(node.rows)
    following = next(rows, None)
    grows = following is not None
    group.dimensions = {dim: None if grows and dim == "plane" else n for dim, n in node.dims().items()}
    for item in node.values:
        _create(item, group, grows=grows)
    count = node.dims().get("plane", 0)
    if grows:
        group.resize_dimension("plane", count)
    for item in node.values:
        if item.quantity.dims:
            group.variables[item.quantity.name][...] = _stored(item.values)
        sink.check()
    while following is not None:
        more = following.dims()["plane"]
        group.resize_dimension("plane", count + more)
        for item in following.values:
            if "plane" in item.quantity.dims:
                group.variables[item.quantity.name][count : count + more] = _stored(item.values)
        sink.check()
        count, following = count + more, next(rows, None)
    for name, value in node.attributes.items():
        group.attrs[name] = value
    for name, child in node.children.items():
        _write(child, group.create_group(name), sink)


def _create(item: Labelled, group: h5netcdf.Group, *, grows: bool) -> None:
    """Declare the variable of ``item``; one without axes gets its value at once."""
    import h5py

    quantity, values = item.quantity, _stored(item.values)
    kind = h5py.string_dtype() if values.dtype.kind == "O" else values.dtype
    options: dict[str, Any] = {}
    if grows and "plane" in quantity.dims:
        options["chunks"] = (256,) if values.ndim == 1 else (1, *values.shape[1:])
    elif values.ndim > 1 and values.dtype.kind != "O" and np.count_nonzero(values) < SPARSE * values.size:
        options |= {"compression": "gzip", "compression_opts": 1, "shuffle": True}
        options |= {"chunks": (1, *values.shape[1:])} if values.ndim == 3 else {}
    elif not values.ndim:
        options["data"] = values[()]
    variable = group.create_variable(quantity.name, quantity.dims, dtype=kind, **options)
    variable.attrs.update(quantity.attributes)
    if np.asarray(item.values).dtype == bool:
        variable.attrs["dtype"] = "bool"  # as xarray writes it, and reads it back


def _stored(values: Any) -> np.ndarray[Any, Any]:
    """``values`` as an array of a type that NetCDF has."""
    array = np.asarray(values)
    if array.dtype == bool:
        return array.astype("i1")
    return array.astype(object) if array.dtype.kind in "US" else array


def _read(group: h5netcdf.Group, without: tuple[str, ...]) -> Node:
    values = []
    for name, variable in group.variables.items():
        array = variable[...]
        attributes = {key: _plain(value) for key, value in variable.attrs.items()}
        if attributes.get("dtype") == "bool":
            array = np.asarray(array).astype(bool)
        elif isinstance(array, bytes | str):
            array = np.asarray(array.decode() if isinstance(array, bytes) else array, dtype=object)
        unit, label = str(attributes.get("units", "1")), str(attributes.get("long_name", name))
        quantity = Quantity(name, unit, label, dims=tuple(variable.dimensions))
        values.append(Labelled(quantity, np.asarray(array) if quantity.dims else _plain(np.asarray(array))))
    children = {name: _read(child, without) for name, child in group.groups.items() if name not in without}
    return Node(tuple(values), {key: _plain(value) for key, value in group.attrs.items()}, children)


def _plain(value: Any) -> Any:
    """A number or text of Python for a single value of numpy; anything else as it is."""
    if isinstance(value, np.ndarray | np.generic) and value.ndim == 0:
        return value.item()
    return value


class _Sink(io.RawIOBase):
    """A file that keeps the first error of writing for ``check`` and goes on without raising it.

    A full disk under an open HDF5 file otherwise ends the whole process when the library closes it.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w+b", buffering=0)
        self._failed: OSError | None = None

    def check(self) -> None:
        """Raise the error that writing has met."""
        if self._failed is not None:
            raise self._failed

    def readable(self) -> bool:
        return True

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = 0, /) -> int:
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        return self._file.tell()

    def readinto(self, buffer: Any, /) -> int:
        return self._file.readinto(buffer) or 0

    def truncate(self, size: int | None = None, /) -> int:
        try:
            return self._file.truncate(size)
        except OSError as error:
            self._failed = self._failed or error
            return size or 0

    def write(self, data: Any, /) -> int:
        view = memoryview(data)
        done = 0
        while self._failed is None and done < len(view):
            try:
                done += self._file.write(view[done:])
            except OSError as error:
                self._failed = error
        return len(view)

    def close(self) -> None:
        self._file.close()
        super().close()


@contextmanager
def _writable(path: Path) -> Iterator[tuple[h5netcdf.File, _Sink]]:
    """A new file at ``path`` to be written; an error of the disk is raised only after the library has closed it."""
    import h5netcdf

    sink = _Sink(path)
    try:
        with h5netcdf.File(sink, "w") as file:
            yield file, sink
    except Exception:
        sink.check()  # an error of the disk comes before the errors that followed from it
        raise
    else:
        sink.check()
    finally:
        sink.close()
