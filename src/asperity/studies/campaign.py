"""A study in its folder: run, inspected, collected."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import FileFormatError, InputError, OutputError
from ..core.words import printable

if TYPE_CHECKING:
    import xarray

    from .collect import CampaignState, Cause
    from .documents import LoadedStudy
    from .plan import Plan
    from .run import RunSummary, Watch

STUDY, RECORDS = "study.toml", "records.log"
"""Files in the folder of a study."""


@dataclass(frozen=True, repr=False)
class Campaign:
    """A ``study`` whose results lie in ``folder``.

    Made by ``run_study`` or ``open_study``.
    """

    folder: Path
    study: LoadedStudy

    def __repr__(self) -> str:
        document, state = self.study.document, self.state()
        rows = {
            "kind": document.kind.replace("_", " "),
            "folder": str(self.folder),
            "axes": " × ".join(f"{len(axis)} {axis.name}" for axis in self.plan.axes),
            "quantities": ", ".join(document.quantities),
            "cases": f"{state.done} done, {state.failed} failed, {state.missing} missing",
        }
        return "\n".join(
            [printable(f"Study {self.title}"), *(f"  {label:<10}  {printable(text)}" for label, text in rows.items())]
        )

    @cached_property
    def plan(self) -> Plan:
        """Axes and cases."""
        from .plan import make_plan

        return make_plan(self.study)

    @property
    def records(self) -> Path:
        """File of the finished cases."""
        return self.folder / RECORDS

    @property
    def title(self) -> str:
        """Title of the study, or the name of its folder."""
        return self.study.document.title or self.folder.name

    def run(
        self, *, workers: int | None = None, dask: str | None = None, retry: bool = False, watch: Watch | None = None
    ) -> RunSummary:
        """Compute what is missing; see ``run_study``."""
        from .cluster import DaskCluster
        from .local import LocalProcesses, available_cores
        from .run import NoWatch, carry_out

        threads = self.study.problem.solver.threads or 1
        local = LocalProcesses(max(1, available_cores() // threads) if workers is None else workers, threads)
        executor = local if dask is None else DaskCluster(dask)
        return carry_out(self.plan, self.records, executor, watch=watch or NoWatch(), retry=retry)

    def state(self) -> CampaignState:
        """How many cases are done, have failed, are missing; why, and what was found of them."""
        from .collect import state

        return state(self.plan, self.records)

    def dataset(self) -> xarray.Dataset:
        """Results on the axes of the study, labelled, SI; NaN where a case failed or is missing."""
        from .collect import dataset
        from .documents import study_text

        return dataset(self.plan, self.records, study=study_text(self.study, self.folder))

    def analysis(self) -> xarray.Dataset | None:
        """Derived numbers of the kind of study: means, orders, critical thicknesses, sensitivities;
        None for a sweep."""
        from .analysis import analysis

        return analysis(self.dataset(), self.study.document, self.plan.columns)

    def findings(self) -> tuple[Cause, ...]:
        """Warnings and notes of the cases, counted by their criterion; each with its first case."""
        return self.state().findings

    def causes(self) -> tuple[Cause, ...]:
        """Failed cases grouped by cause."""
        return self.state().causes


def run_study(
    study: str | Path | Mapping[str, Any],
    folder: str | Path | None = None,
    *,
    workers: int | None = None,
    dask: str | None = None,
    retry: bool = False,
    watch: Watch | None = None,
) -> Campaign:
    """Run or resume a study: only cases that its folder does not hold are computed.

    One that does not fit into memory or disk is refused. One that fits is run however long it
    takes: the command ``asperity run`` asks before hours of work, this function does not.

    Parameters
    ----------
    study
        Study document (TOML or JSON file), or its content as nested dictionaries.
    folder
        Where results go; by default beside the document, named after it.
    workers
        Number of worker processes on this machine, each with one thread; as many as there are cores
        by default.
    dask
        Address of a Dask scheduler whose workers are used instead.
    retry
        Whether cases that failed are tried again.
    watch
        Receives the progress.

    Raises
    ------
    InputError
        If the document has problems; the message has one line for each.
    FileFormatError
        If a file is missing or unreadable.
    OutputError
        If the folder cannot be written.
    """
    campaign = prepare_study(study, folder)
    campaign.run(workers=workers, dask=dask, retry=retry, watch=watch)
    return campaign


def prepare_study(
    study: str | Path | Mapping[str, Any],
    folder: str | Path | None = None,
    *,
    start: Path = Path(),
    confirm: Callable[[str], object] | None = None,
) -> Campaign:
    """The campaign of ``study`` with its folder made, before anything is computed; arguments and
    errors of ``run_study``.

    Relative paths in a dictionary begin at ``start``. A new study that takes much of time, memory
    or disk is told to ``confirm``, in words, before its folder is made.
    """
    from .documents import load_study, study_from_table
    from .plan import BYTES_OF_A_RECORD, large_study

    if isinstance(study, Mapping):
        loaded, target = study_from_table(study, start), Path("study" if folder is None else folder)
    else:
        beside = Path(study).with_name(f"{Path(study).stem}-results")
        loaded, target = load_study(study), beside if folder is None else Path(folder)
    _require_cases(loaded)
    campaign = Campaign(target, loaded)
    if refused := campaign.plan.refused():  # all mistakes are found before anything is written
        raise InputError(f"every case of the study would fail: {refused}", subject="study")
    require_own(target)
    there = next(place for place in (target.absolute(), *target.absolute().parents) if place.exists())
    free = shutil.disk_usage(there).free
    if confirm is not None and not (target / STUDY).is_file():  # one that goes on was confirmed when it began
        confirm(large_study(campaign.plan, free))
    make(target)
    if (needed := BYTES_OF_A_RECORD * campaign.plan.n_cases) > free:
        raise OutputError(
            f"results of {campaign.plan.n_cases} cases need about {needed / 2**30:.3g} GiB, but "
            f"{free / 2**30:.3g} GiB are free at {target}; give fewer points or samples, or {{folder}}.",
            subject=f"results of {campaign.plan.n_cases} cases",
        )
    write_study(loaded, target)
    return campaign


def require_own(folder: Path) -> None:
    """Refuse a ``folder`` that holds something else than the results of a study with an
    OutputError."""
    if folder.is_dir() and any(folder.iterdir()) and not (folder / STUDY).is_file():
        raise OutputError(
            f"folder of a study must be new, empty, or hold its results, but {folder} holds something else; "
            "choose {folder}."
        )


def make(folder: Path) -> None:
    """Make the ``folder`` of a study; an OutputError if that cannot be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"folder {folder} cannot be made: {error.strerror}; choose another.", subject="folder of a study"
        ) from error


def write_study(study: LoadedStudy, folder: Path) -> None:
    """Write the document of ``study`` into its ``folder``."""
    from ..io.atomic import atomic_file
    from .documents import study_text

    with atomic_file(folder / STUDY, overwrite=True) as partial:
        partial.write_text(study_text(study, folder), encoding="utf-8", newline="\n")


def open_study(folder: str | Path) -> Campaign:
    """The study whose results lie in ``folder``, or beside the study document ``folder``; nothing
    is computed.

    Raises
    ------
    FileFormatError
        If there is none.
    """
    from .documents import load_study

    place = Path(folder)
    if place.is_file():
        place = place.with_name(f"{place.stem}-results")
    if not (place / STUDY).is_file():
        raise FileFormatError(
            f"results of a study must lie in a folder with {STUDY}, but {place} has none; run it first: asperity run."
        )
    loaded = load_study(place / STUDY)
    _require_cases(loaded)
    return Campaign(place, loaded)


def _require_cases(study: LoadedStudy) -> None:
    kind, command = study.document.kind, {"design": "design", "calibration": "calibrate"}
    if kind in command:
        raise InputError(
            f"study must not be a {kind} to be run or collected as cases, but has the table [{kind}]; run "
            f"asperity {command[kind]}."
        )
