"""
A campaign on a Dask cluster
============================

Many contacts at once: a study varies scalars of a problem document, on the cores of this machine or
on the workers of a Dask cluster. It can be interrupted and goes on where it stopped.
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt

import asperity as asp

# %%
# The study as a dictionary; a TOML file with the same keys serves ``asperity run``.
spectrum = {"kind": "gaussian", "rms_height": "3 nm", "correlation_length": "0.5 um"}
study = {
    "version": 1,
    "title": "Area of a coated surface against load and thickness",
    "quantities": ["area_fraction_corrected", "max_pressure"],
    "axes": [
        {"name": "pressure", "path": "control.mean_pressure", "values": ["10 MPa", "20 MPa", "50 MPa", "100 MPa"]},
        {"name": "thickness", "path": "body.layers.0.thickness", "values": ["0 nm", "30 nm", "100 nm", "300 nm"]},
    ],
    "problem": {
        "version": 1,
        "surface": {"kind": "rough", "points": [64, 64], "size": "4 um", "seed": 1, "spectrum": spectrum},
        "body": "TiN:100nm/steel",
        "control": {"mean_pressure": "10 MPa"},
    },
}

# %%
# A cluster of threads in this process stands for a real one, of which only the address is needed:
# ``tcp://10.0.0.1:8786``.
folder = Path(mkdtemp()) / "results"
try:
    from dask.distributed import LocalCluster
except ImportError:
    print(
        "dask is not installed (pip install 'asperity[dask]'): a worker process of this machine does the work instead."
    )
    campaign = asp.studies.run_study(study, folder, workers=1)
else:
    own = {"dashboard_address": "127.0.0.1:0", "worker_dashboard_address": "127.0.0.1:0"}  # pages for this machine only
    with LocalCluster(n_workers=1, processes=False, **own) as cluster:
        campaign = asp.studies.run_study(study, folder, dask=cluster.scheduler_address)

# %%
# One labelled dataset in SI units. A stiff coating carries the load on less area, the more the
# thicker it is.
data = campaign.dataset()
axes = plt.subplots(figsize=(6, 4), layout="constrained")[1]
for thickness in data.thickness.values:
    at = data.sel(thickness=thickness)
    axes.plot(at.pressure / 1e6, 100 * at.area_fraction_corrected, "o-", label=f"{1e9 * thickness:.0f} nm")
axes.set(xlabel="mean pressure (MPa)", ylabel="real area (% of nominal)", ylim=(0, None))
axes.legend(title="titanium nitride")
plt.show()
