"""Everything that a study leaves for people and programs, in its folder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..io.atomic import atomic_file
from ..plots.picture import save_pictures
from ..studies.campaign import Campaign
from .study import write_study_report
from .study_figures import study_figures

if TYPE_CHECKING:
    import xarray

RESULTS, CASES, FINDINGS, REPORT, PLOTS = "results.nc", "cases.csv", "findings.csv", "report.html", "plots"
"""Names in the folder."""


def write_study_files(campaign: Campaign, folder: Path) -> tuple[Path, ...]:
    """Write dataset, tables, figures and page of ``campaign`` into ``folder``, over those of an earlier time.

    Raises
    ------
    OutputError
        If one of them cannot be written.
    """
    data, derived = campaign.dataset(), campaign.analysis()
    _save(data, folder / RESULTS)
    _table(data, folder / CASES)
    written = [folder / RESULTS, folder / CASES]
    if derived is not None:
        _table(derived, folder / FINDINGS)
        written.append(folder / FINDINGS)
    figures = study_figures(campaign, data, derived)
    save_pictures({figure.name: lambda f=figure: f.picture for figure in figures}, folder / PLOTS, overwrite=True)  # type: ignore[misc]
    write_study_report(campaign, folder / REPORT, figures=figures, overwrite=True)
    return (*written, folder / PLOTS, folder / REPORT)


def _save(data: xarray.Dataset, path: Path) -> None:
    with atomic_file(path, overwrite=True) as partial:
        data.to_netcdf(partial, engine="h5netcdf")


def _table(data: xarray.Dataset, path: Path) -> None:
    """All variables of ``data`` by case, SI, exact."""
    with atomic_file(path, overwrite=True) as partial:
        frame = data.to_dataframe() if data.sizes else data.expand_dims("all").to_dataframe()
        frame.to_csv(partial, index=bool(data.sizes))
