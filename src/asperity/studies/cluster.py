"""Workers of a Dask cluster."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any

from ..core.errors import InputError
from .executors import Lost, Task, call


@dataclass(frozen=True)
class DaskCluster:
    """Workers of the Dask scheduler at ``address``, such as ``"tcp://10.0.0.1:8786"``.

    They need the same version of asperity and the files of the study under the same path. A worker
    that dies loses nothing: Dask gives its tasks to others. Tasks and answers are pickles, so the
    address must be that of a trusted cluster; ``tls://`` with the certificates of Dask's
    configuration proves that it is.
    """

    address: str

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any | Lost]]:
        """Every task with its answer, as they are done; two tasks for each thread are under way."""
        with self.kept() as workers:
            yield from workers.run(function, tasks)

    @contextmanager
    def kept(self) -> Iterator[KeptCluster]:
        """Connection that stays from one run to the next, and ends with the context."""
        try:
            distributed: Any = importlib.import_module("distributed")
        except ImportError:
            raise InputError(
                'a Dask cluster needs the package distributed, which is missing: pip install "asperity[dask]".',
                subject="package distributed",
            ) from None
        try:
            client = distributed.Client(self.address, set_as_default=False, timeout=10)
        except (OSError, ValueError, TimeoutError) as error:
            raise InputError(
                f"Dask scheduler must answer at {self.address!r}, but does not ({error}); check address and firewall."
            ) from None
        with client:
            yield KeptCluster(distributed, client)


@dataclass(frozen=True)
class KeptCluster:
    """Workers of the scheduler of a ``client`` of the package ``distributed``."""

    distributed: Any
    client: Any

    def run(self, function: str, tasks: Iterator[Task]) -> Iterator[tuple[Task, Any | Lost]]:
        """Every task with its answer, as they are done; two tasks for each thread are under way."""
        under_way: dict[Any, Task] = {}

        def submitted() -> Iterator[Any]:
            for task in tasks:
                future = self.client.submit(call, function, task, pure=False)
                under_way[future] = task
                yield future

        stream = submitted()
        ahead = 2 * max(1, sum(self.client.nthreads().values()))
        completed = self.distributed.as_completed(islice(stream, ahead), loop=self.client.loop)
        try:
            for future in completed:
                try:
                    answer = future.result()
                except self.distributed.KilledWorker as error:
                    answer = Lost(" ".join(str(error).split()))
                yield under_way.pop(future), answer
                completed.update(islice(stream, 1))
        finally:
            self.client.cancel(list(under_way))
