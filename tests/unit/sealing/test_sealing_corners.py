"""Fluid that passes corners between spots of contact: joined crosswise there, and nowhere else."""

from __future__ import annotations

import numpy as np
import pytest

from asperity.physics.sealing.network import clusters
from asperity.physics.sealing.threshold import _through_corners

ROUND, FLAT = (True, True), (False, False)


def test_a_chessboard_is_one_cluster_through_its_corners() -> None:
    chess = np.add.outer(np.arange(8), np.arange(8)) % 2 == 1
    assert clusters(chess, ROUND).labels.max() == 32
    joined = clusters(_through_corners(chess, ROUND), ROUND)
    assert joined.labels.max() == 1
    assert joined.winds[:, 1].all()
    assert clusters(_through_corners(chess, FLAT), FLAT).spans[:, 1].all()


@pytest.mark.parametrize("falls", [False, True])
def test_a_diagonal_of_cells_leads_through(falls: bool) -> None:
    diagonal = np.eye(9, dtype=bool)[:, :: -1 if falls else 1]
    assert not clusters(diagonal, FLAT).spans.any()
    joined = clusters(_through_corners(diagonal, FLAT), FLAT)
    assert joined.labels.max() == 1
    assert joined.spans[:, 1].all()


def test_across_a_seam_only_where_the_grid_repeats() -> None:
    opened = np.zeros((6, 6), bool)
    opened[5, 2] = opened[0, 3] = True
    assert clusters(_through_corners(opened, (True, False)), (True, False)).labels.max() == 1
    assert clusters(_through_corners(opened, FLAT), FLAT).labels.max() == 2


def test_nothing_else_is_joined() -> None:
    rng = np.random.default_rng(1)
    opened = rng.random((40, 30)) < 0.4
    fine = _through_corners(opened, ROUND)
    labels = clusters(fine, ROUND).labels[::2, ::2]  # of quarters of the cells, closed ones among them
    # by flooding: eight neighbours of every cell
    reached = np.where(opened, np.arange(opened.size).reshape(opened.shape), -1)
    for _ in range(opened.size):
        before = reached
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                reached = np.where(opened, np.maximum(reached, np.roll(reached, (i, j), (0, 1))), -1)
        if np.array_equal(before, reached):
            break
    pairs = {(int(a), int(b)) for a, b in zip(labels[opened], reached[opened], strict=True)}
    assert len(pairs) == len({a for a, _ in pairs}) == len({b for _, b in pairs})
