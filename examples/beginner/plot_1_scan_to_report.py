"""
From a scan to the real contact area and a report
=================================================

Read a measured map, prepare it, press it against a rigid flat, and write a page that can be sent to
a colleague.
"""

from pathlib import Path
from tempfile import mkdtemp

import matplotlib.pyplot as plt
import numpy as np

import asperity as asp

folder = Path(mkdtemp())
rng = np.random.default_rng(1)

# %%
# **A stand-in for an instrument.** These lines write what an instrument leaves behind: a rough map
# that is tilted, with a random offset of every scan line, in an SDF file (ISO 25178-71). With a
# file of your own begin at the next cell.
grid = asp.Grid((128, 128), (50e-9, 50e-9))  # points and pixel, m
spectrum = asp.generate.SelfAffine(
    amplitude=asp.generate.RmsHeight(5e-9), hurst=0.8, rolloff_wavelength=2e-6, shortest_wavelength=400e-9
)
rough = asp.generate.gaussian(grid, spectrum, seed=1).heights
x, y = grid.coordinates()
measured = rough + 0.01 * x + rng.normal(0.0, 2e-9, y.shape)  # 0.6 degrees of tilt, 2 nm from line to line
header = "aISO-1.0\nNumPoints = 128\nNumProfiles = 128\nXscale = 50e-9\nYscale = 50e-9\nZscale = 1e-12"
rows = "\n".join(" ".join(f"{height:.0f}" for height in line) for line in measured.T[::-1] / 1e-12)
(folder / "scan.sdf").write_text(f"{header}\nCompression = 0\nDataType = 6\nCheckType = 0\n*\n{rows}\n*\n")

# %%
# **Prepare.** Every step returns a new surface and is written into its history. The solver repeats
# the map in both directions; ``periodised`` removes the cliffs that would stand where its borders
# meet.
scan = asp.read(folder / "scan.sdf")
ready = asp.periodised(asp.levelled(asp.surfaces.line_corrected(scan, "x")))
print(*ready.origin.history, sep="\n")

# %%
# **Press.** Diamond-like carbon, 50 MPa of nominal pressure. The real contact is a few percent of
# the nominal area, and the certificate bounds the error of the solution.
problem = asp.ContactProblem(ready, asp.material("DLC"))
result = asp.solve(problem, asp.MeanPressure(50e6))
print(result)

figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
scan.plot("heights", axes[0]).set_title("as measured")
ready.plot("heights", axes[1]).set_title("prepared")
result.plot("contact", axes[2])

# %%
# **Report.** One HTML page with figures, numbers, warnings and the papers behind them.
asp.write_report(result, folder / "report.html")
print("report:", folder / "report.html")
plt.show()
