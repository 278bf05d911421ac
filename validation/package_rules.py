"""The rules by which other packages compute what deviates from ours, written here from their
documentation: applied to the same heights they must give the numbers of those packages.

Heights are arrays in m: z (n,) of a profile, h [x, y] of a map, y upwards.
"""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from asperity.core.arrays import RealArray
from asperity.surfaces import Surface
from asperity.surfaces.characterise.correlation import autocovariance

CLASSES = 10_000
"""Classes of surfalize's material ratio curve."""


def centred_again(z: RealArray) -> dict[str, float]:
    """a, q, sk, ku of ``z`` about a new mean, as surfalize takes them."""
    z = z - z.mean()
    q = float(np.sqrt(np.mean(z**2)))
    return {
        "a": float(np.abs(z).mean()),
        "q": q,
        "sk": float(np.mean(z**3)) / q**3,
        "ku": float(np.mean(z**4)) / q**4,
    }


def sections_about_a_new_mean(z: RealArray, sections: int) -> dict[str, float]:
    """p and v of equal ``sections``, from the mean of the whole."""
    parts = np.array_split(z - z.mean(), sections)
    return {"p": float(np.mean([one.max() for one in parts])), "v": float(np.mean([-one.min() for one in parts]))}


class CurveOfClasses:
    """Surfalize's material ratio curve of the heights ``z``: quantiles at 10 000 equal classes from
    the highest point (0 %) to the lowest (100 %), where ours has a step at every point; areas by
    trapezia that end at the class nearest to the bound."""

    def __init__(self, z: RealArray) -> None:
        self.ratios = np.linspace(0.0, 100.0, CLASSES)
        self.heights = np.quantile(z.ravel(), 1.0 - self.ratios / 100.0)
        width = 40.0
        starts = np.flatnonzero(self.ratios <= 100.0 - width)
        ends = np.interp(self.ratios[starts] + width, self.ratios, self.heights)
        first = int(starts[np.argmax((ends - self.heights[starts]) / width)])
        last = int(np.searchsorted(self.ratios, self.ratios[first] + width, side="right"))
        slope, self.top = np.polyfit(self.ratios[first:last], self.heights[first:last], 1)
        self.bottom = self.top + 100.0 * slope

    def height(self, ratio: float) -> float:
        """Height in m at the ``ratio`` in %."""
        return float(np.interp(ratio, self.ratios, self.heights))

    def ratio(self, height: float) -> float:
        """Ratio in % at the ``height`` in m."""
        order = np.argsort(self.heights)
        return float(np.interp(height, self.heights[order], self.ratios[order]))

    def _above(self, height: float) -> float:
        """Area above a height in m %."""
        end = int(np.argmin(np.abs(self.heights - height)))
        return abs(float(np.trapezoid(self.ratios[:end], x=self.heights[:end])))

    def _below(self, height: float) -> float:
        end = int(np.argmin(np.abs(self.heights - height)))
        return abs(float(np.trapezoid(100.0 - self.ratios[end:], x=self.heights[end:])))

    def core(self) -> dict[str, float]:
        """k, pk, vk in m and mr1, mr2 in %."""
        first, second = self.ratio(self.top), self.ratio(self.bottom)
        peak, valley = self._above(self.top), self._below(self.bottom)
        return {
            "k": float(self.top - self.bottom),
            "pk": 2.0 * peak / first if peak > 0.0 else 0.0,
            "vk": 2.0 * valley / (100.0 - second) if valley > 0.0 else 0.0,
            "mr1": first,
            "mr2": second,
        }

    def volumes(self) -> dict[str, float]:
        """Vmp, Vmc, Vvc, Vvv per area in m, and the differences of height Sxp and Sdc."""
        material = [self._above(self.height(ratio)) / 100.0 for ratio in (10.0, 80.0)]
        void = [self._below(self.height(ratio)) / 100.0 for ratio in (10.0, 80.0)]
        return {
            "Vmp": material[0],
            "Vmc": material[1] - material[0],
            "Vvc": void[0] - void[1],
            "Vvv": void[1],
            "xp": self.height(2.5) - self.height(50.0),
            "dc": self.height(10.0) - self.height(80.0),
        }


def cut_gaussian(z: RealArray, spacing: float, cutoff: float) -> RealArray:
    """Gaussian mean line of ``z`` with its kernel cut at four standard deviations and the ends
    mirrored, as SciPy does for surfalize; ours reaches to the cut-off and divides by the weights
    that are there."""
    sigma = cutoff / spacing / np.pi * np.sqrt(0.5 * np.log(2.0))
    reach = int(4.0 * sigma + 0.5)
    places = np.arange(-reach, reach + 1)
    kernel = np.exp(-0.5 * (places / sigma) ** 2)
    padded = np.pad(z, reach, mode="symmetric")
    return np.convolve(padded, kernel / kernel.sum(), mode="valid")


def texture_by_pixels(surface: Surface) -> dict[str, float]:
    """Sal in m and Str by surfalize: rays to every pixel beside the region of correlation above
    0.2, the crossing by cubic splines at a thousandth of the ray; ours has one ray a degree and
    bilinear interpolation."""
    half = autocovariance(surface).values
    whole = np.concatenate([half[:0:-1, ::-1], half])
    centre = np.array(whole.shape) // 2
    level = 0.2 * whole[tuple(centre)]
    labels, _ = ndimage.label(whole > level)
    region = labels == labels[tuple(centre)]
    border = np.argwhere(region ^ ndimage.binary_dilation(region))
    share = np.linspace(0.0, 1.0, 1000)
    places = [(centre[k] + (border[:, k] - centre[k])[:, None] * share).ravel() for k in (0, 1)]
    along = ndimage.map_coordinates(whole, places, order=3).reshape(len(border), -1)
    lengths = np.linalg.norm((border - centre) * np.array([surface.dx, surface.dy]), axis=1)[:, None] * share
    found = lengths[np.arange(len(border)), np.argmin(np.abs(along - level), axis=1)]
    inside = not (region[0].any() or region[-1].any() or region[:, 0].any() or region[:, -1].any())
    return {"Sal": float(found.min()), "Str": float(found.min() / found.max()) if inside else np.nan}


def gradient_on_common_nodes(h: RealArray, spacing: tuple[float, float]) -> float:
    """Rms gradient of SurfaceTopography: forward differences at the nodes that have both; ours
    averages each direction over all of its pairs."""
    along_x = np.diff(h, axis=0)[:, :-1] / spacing[0]
    along_y = np.diff(h, axis=1)[:-1] / spacing[1]
    return float(np.sqrt(np.mean(along_x**2 + along_y**2)))


def share_of_line_above(z: RealArray, height: float) -> float:
    """Share of the polygon through ``z`` above ``height``, as SurfaceTopography takes it; ours is
    the share of the points."""
    low, high = np.minimum(z[:-1], z[1:]), np.maximum(z[:-1], z[1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(high > low, (high - height) / (high - low), (low >= height) * 1.0)
    return float(np.clip(share, 0.0, 1.0).mean())


def derivative_of_lines(h: RealArray, spacing: float, order: int, step: int = 1) -> float:
    """Rms derivative along x of SurfaceTopography, over stencils of ``step`` pixels: only where the
    one along y exists, too; ours takes all lines."""
    along = h[step:] - h[:-step] if order == 1 else h[2 * step :] - 2.0 * h[step:-step] + h[: -2 * step]
    lines = slice(None, -step) if order == 1 else slice(step, -step)
    return float(np.sqrt(np.mean((along[:, lines] / (step * spacing) ** order) ** 2)))
