"""Parameters of a contact by name, and what a change of each does to its compliance."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple, Protocol

import numpy as np

from ...contact.boundary import Free, Periodic
from ...contact.law import Hardness
from ...contact.operators import Operator
from ...contact.operators.convolution import spectral_kernel
from ...contact.problem import ContactProblem
from ...core.arrays import ComplexArray, RealArray
from ...core.errors import InputError
from ...core.grid import Grid
from ...core.interpolation import panels
from ...core.spectral import PaddedTransform, RealTransform, multiplicity, thread_count, wrapped
from ...solids.compliance.halfspace import Compliance
from ...solids.compliance.patch_sums import PatchSums
from ...solids.compliance.rates import UNITS, ComplianceRate, Constant, compliance_rates, normal_rates
from ...solids.elastic import Elastic, Rigid
from ...solids.layers import Body, Layer, Layered

HEIGHTS, HARDNESS, LOAD, APPROACH = "heights", "hardness", "force", "approach"
"""Parameters that are not constants of the bodies; of the last two, that which is held."""


PANEL = 0.25
"""Width in ln q of the panels of derivatives of a compliance: ten terms leave 1e-9 of them where
the nearest singularity is 0.5 away (see ``interpolation``)."""


class Parameter(NamedTuple):
    """A constant of one of the bodies: its ``name``, whose ``body`` it is, which ``constant``, and
    the derivative of the compliance to it, ``factor`` times ``rate``."""

    name: str
    body: str
    constant: Constant
    rate: Compliance
    factor: float

    @property
    def value(self) -> float:
        """Value in SI units."""
        return self.constant.value

    @property
    def unit(self) -> str:
        """SI unit."""
        return UNITS[self.constant.kind]


def parameters(problem: ContactProblem) -> tuple[Parameter, ...]:
    """All constants of both bodies that take part, such as ``body.layers[0].thickness``,
    ``body.base.youngs_modulus`` or, of a homogeneous one, ``counter_body.poisson_ratio``."""
    found = []
    for which, body in (("body", problem.body), ("counter_body", problem.counter_body)):
        if isinstance(body, Rigid):
            continue
        for rate in compliance_rates(body):
            name = f"{which}.{place_in(body, rate.constant.layer)}{rate.constant.kind}"
            found.append(Parameter(name, which, rate.constant, rate.compliance, rate.factor))
    return tuple(found)


def kept_layers(body: Layered) -> list[int]:
    """Numbers in ``body`` of the layers of the reduced body, that of the base last."""
    there = [k for k, layer in enumerate(body.layers) if layer.thickness > 0.0]
    return [*there, len(body.layers)]


def place_in(body: Elastic | Layered, layer: int) -> str:
    """Beginning of the names of constants of the ``layer`` of this number in the reduced ``body``:
    ``layers[0].``, ``base.``, or nothing of a homogeneous one."""
    if isinstance(body, Elastic):
        return ""
    number = kept_layers(body)[layer]
    return f"layers[{number}]." if number < len(body.layers) else "base."


def changed(problem: ContactProblem, name: str, value: float | RealArray) -> ContactProblem:
    """``problem`` with another ``value`` of the parameter of that ``name``; of the heights what is
    added to them."""
    if name == HEIGHTS:
        surface = problem.surface
        return replace(problem, surface=surface.with_heights(surface.heights + value, "heights changed"))
    if name == HARDNESS:
        return replace(problem, law=Hardness(value))
    parameter = {each.name: each for each in parameters(problem)}[name]
    body = getattr(problem, parameter.body)
    other = changed_body(body, parameter.constant, float(value))
    return replace(problem, body=other) if parameter.body == "body" else replace(problem, counter_body=other)


def changed_body(body: Body, constant: Constant, value: float) -> Elastic | Layered:
    """``body`` with another ``value`` of one of its constants."""
    if isinstance(body, Elastic):
        return _changed_material(body, constant.kind, value)
    assert isinstance(body, Layered)
    number, layers, base = kept_layers(body)[constant.layer], list(body.layers), body.base
    if number == len(layers):
        assert isinstance(base, Elastic)
        base = _changed_material(base, constant.kind, value)
    elif constant.kind == "thickness":
        layers[number] = replace(layers[number], thickness=value)
    else:
        layer = layers[number]
        material = _changed_material(layer.material, constant.kind, value)
        layers[number] = Layer(material, layer.thickness, layer.interface)
    return Layered(layers, base, body.name)


def _changed_material(material: Elastic, kind: str, value: float) -> Elastic:
    given = {"youngs_modulus": material.youngs_modulus, "poisson_ratio": material.poisson_ratio, kind: value}
    return replace(material, youngs_modulus=given["youngs_modulus"], poisson_ratio=given["poisson_ratio"])


def chosen(to: str | Iterable[str], known: Iterable[str]) -> tuple[str, ...]:
    """Names of ``to`` among those ``known``; ``"all"`` takes all of them, ``"body.layers"`` all
    that begin so.

    Raises
    ------
    InputError
        If a name is none of them.
    """
    names = tuple(known)
    if to == "all":
        return names
    asked = (to,) if isinstance(to, str) else tuple(to)
    found: list[str] = []
    for name in asked:
        fit = [each for each in names if each == name] or [
            each for each in names if isinstance(name, str) and each.startswith((f"{name}.", f"{name}["))
        ]
        if not fit:
            raise InputError(f"parameter of a sensitivity must be one of {', '.join(names)}, but is {name!r}.")
        found += [each for each in fit if each not in found]
    return tuple(found)


class Rated(Protocol):
    """A constant of a ``name`` to which the derivative of a compliance is ``factor`` times
    ``rate``."""

    @property
    def name(self) -> str:
        """Of the constant."""

    @property
    def rate(self) -> Compliance:
        """A compliance per unit of it."""

    @property
    def factor(self) -> float:
        """Of the rate."""


def responses(
    operator: Operator, rates: Iterable[Rated], weight: RealArray, pressure: RealArray
) -> Mapping[str, float]:
    """weight · (dK/dθ) pressure by the name of each of the parameters θ ``rates``, from one
    transform of each of the two arrays (nx, ny): in Fourier space dK/dθ is diagonal."""
    grid = Grid(operator.padded, operator.grid.spacing)
    transform = PaddedTransform(operator.grid.shape, grid.shape, thread_count())
    spectra = [transform.forward(field, np.empty(transform.spectrum_shape, complex)) for field in (weight, pressure)]
    product = np.conj(spectra[0], out=spectra[0])
    product *= spectra[1]
    shares = multiplicity(grid) / grid.n_points
    known: dict[int, float] = {}
    asked = list(rates)
    layered = [each.rate for each in asked if isinstance(each.rate, ComplianceRate)]
    if isinstance(operator.boundary, Free):
        known = _by_distance(operator, layered, transform, product)
    elif isinstance(operator.boundary, Periodic):
        known = _by_wavenumber(operator, layered, product.real * shares)
    found: dict[str, float] = {}
    for parameter in asked:
        rate = parameter.rate
        if id(rate) not in known:
            kernel, density = _kernel(operator, rate), product.real * shares
            # the datum is that of the compliance: the mean, where a half-space is part of it
            known[id(rate)] = float((kernel * density).sum())
            if operator.zero_mean_mode:
                known[id(rate)] -= float(kernel[0, 0] * density[0, 0])
        found[parameter.name] = parameter.factor * known[id(rate)]
    return found


def _by_wavenumber(operator: Operator, rates: Iterable[ComplianceRate], density: RealArray) -> dict[int, float]:
    """The same of layered bodies on a periodic grid by the ``id`` of each rate, by the ``density``
    over the half spectrum: gathered in panels first, and before in the quarter of both signs."""
    found: dict[int, float] = {}
    bodies, grid = _by_body(rates), operator.grid
    if not bodies:
        return found
    half = grid.shape[0] // 2 + 1
    quarter, mean = density[:half].copy(), float(density.flat[0])
    quarter[1 : density.shape[0] - half + 1] += density[: half - 1 : -1]
    across, along = (
        2.0 * np.pi / (n * d) * np.arange(n // 2 + 1) for n, d in zip(grid.shape, grid.spacing, strict=True)
    )
    q = np.hypot(across[:, None], along).ravel()[1:]
    within = panels(grid, PANEL)
    moments = within.moments(q, quarter.ravel()[1:] / q)
    for of_body in bodies:
        fitted = within.fitted(_times_wavenumber(of_body[0].rates.stack, within.points))
        for rate in of_body:
            found[id(rate)] = float((moments * fitted[:, rate.number].T).sum())
            if not operator.zero_mean_mode:
                found[id(rate)] += rate.mean_mode() * mean
    return found


def _by_distance(
    operator: Operator, rates: Iterable[ComplianceRate], transform: PaddedTransform, product: ComplexArray
) -> dict[int, float]:
    """The same of layered bodies on a free boundary by the ``id`` of each rate, from the
    correlation of the arrays, whose spectrum is ``product``: no rate needs influence coefficients
    of its own."""
    bodies = _by_body(rates)
    if not bodies:
        return {}
    # offsets of all signs together: even in both directions
    even = product.real.copy()
    even[1:] += product.real[:0:-1]
    even[0] *= 2.0
    weights = transform.backward(2.0 * even + 0j, np.empty(operator.grid.shape))
    weights[0] *= 0.5
    weights[:, 0] *= 0.5
    found: dict[int, float] = {}
    for of_body in bodies:
        own = of_body[0].rates
        sums = PatchSums.of(operator.grid, weights, own.stack.thickness).sums(
            partial(_times_wavenumber, own.stack),
            [own.limits(number) for number in range(len(own.constants))],
            min(layer.thickness for layer in own.stack.layers),
            PANEL,
        )
        found |= {id(rate): float(sums[rate.number]) for rate in of_body}
    return found


def _times_wavenumber(stack: Layered, q: RealArray) -> RealArray:
    """q times the derivatives of the compliance to all constants, (constants, n), at ``q`` (n,)."""
    return np.asarray(normal_rates(stack, q) * q)


def _by_body(rates: Iterable[ComplianceRate]) -> list[list[ComplianceRate]]:
    """The ``rates`` of each body, each once."""
    found: dict[int, dict[int, ComplianceRate]] = {}
    for rate in rates:
        found.setdefault(id(rate.rates), {})[id(rate)] = rate
    return [list(each.values()) for each in found.values()]


def _kernel(operator: Operator, rate: Compliance) -> RealArray:
    """``rate`` on the half spectrum of the operator."""
    grid, boundary = operator.grid, operator.boundary
    if isinstance(boundary, Periodic):
        return np.asarray(spectral_kernel(rate, grid))
    influence = boundary.influence(rate, grid)
    transform = RealTransform(operator.padded, thread_count())
    return np.asarray(transform.forward(wrapped(influence, operator.padded)).real)
