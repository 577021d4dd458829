"""The belief of a person's place: a Bayes filter over cells, standing or walking."""
import numpy as np
from scipy.sparse import csr_matrix, diags, identity

from angen_apps.seek.home import CELL, Home, Pir

STEP = 1.0  # s
SPEED = 0.8  # m/s
SETS_OUT, SETTLES = 1 / 50, 1 / 10  # 1/s: a standing person starts to walk; a walking one stops
LIFT = 0.01  # share of those who walk beside the elevator that come out on another floor, per STEP
UNKNOWN_DOOR = 0.3  # the share that passes a door of unknown state
LEAST = 1e-7  # least probability of a cell: any observation may be wrong

# Probabilities of `motion` within a STEP:
SEEN, GLIMPSED, AFTER, FALSE = 0.6, 0.25, 0.03, 0.005
# Probability ratios of an observation elsewhere, to one at its place:
DEVICE, LIGHT, ARC, LOOK = 0.003, 0.02, 0.02, 0.25


class Belief:
    """`p` (2, n): the probability of each cell, standing (row 0) and walking (row 1)."""

    def __init__(self, home: Home) -> None:
        self._home = home
        count = len(home.at)
        self.p = np.full((2, count), 0.5 / count)
        self._passed: frozenset[str] | None = frozenset({'?'})
        self._walk = self._walks(None)

    @property
    def cells(self) -> np.ndarray:
        """(n,) the probability of each cell."""
        return np.asarray(self.p.sum(axis=0))

    def _walks(self, opened: frozenset[str] | None) -> csr_matrix:
        """The matrix of a STEP of walking; `opened`: the open doors, None if it is not known."""
        if opened == self._passed:
            return self._walk
        self._passed = opened
        edges = self._home.edges
        if opened is None:
            weight = np.array([UNKNOWN_DOOR if door else 1.0 for door in self._home.edge_door])
        else:
            weight = np.array([float(not door or door in opened) for door in self._home.edge_door])
        count = len(self._home.at)
        half = csr_matrix((weight, (edges[:, 0], edges[:, 1])), shape=(count, count))
        beside = half + half.T
        degree = np.asarray(beside.sum(axis=1)).ravel()
        most = max(degree.max(), 1.0)
        once = beside / most + diags(1 - degree / most)
        # one of `most` ways is taken; a step is CELL long: SPEED is the root mean square per s
        rounds = max(1, round(most / 4 * 2 * (SPEED * STEP / CELL) ** 2))
        matrix = identity(count, format='csr')
        for _ in range(rounds):
            matrix = matrix @ once
        return self._with_lift(csr_matrix(matrix))

    def _with_lift(self, matrix: csr_matrix) -> csr_matrix:
        near = self._home.by_lift
        if not near.any():
            return matrix
        share = np.where(near, LIFT, 0.0)
        ride = csr_matrix(share[:, None]) @ csr_matrix(near[None] / near.sum())
        return csr_matrix(diags(1 - share) @ matrix + ride)

    def step(self, opened: frozenset[str] | None) -> None:
        """Advances the belief by STEP. `opened`: the open doors, None if it is not known."""
        self._walk = self._walks(opened)
        stand, walk = self.p
        walk = self._walk.T @ walk
        out, settled = SETS_OUT * STEP * stand, SETTLES * STEP * walk
        self.p = np.stack([stand - out + settled, walk - settled + out])
        self._normalize()

    def weigh(self, likelihood: np.ndarray) -> None:
        """The likelihood of an observation in each cell: (n,), or (2, n) for standing, walking."""
        self.p = self.p * likelihood
        self._normalize()

    def _normalize(self) -> None:
        self.p = np.maximum(self.p, LEAST)
        self.p /= self.p.sum()

    def pir(self, pir: Pir, motion: bool) -> None:
        """A STEP of a PIR. It detects a standing person only for a while after motion."""
        walk = np.where(pir.sees, SEEN, np.where(pir.through_doors, GLIMPSED, FALSE))
        stand = np.where(pir.sees, AFTER, FALSE)
        both = np.stack([stand, walk])
        self.weigh(both if motion else 1 - both)

    def near(self, cells: np.ndarray, ratio: float) -> None:
        """A person is at one of these cells (n,); elsewhere that would be `ratio` as likely."""
        if cells.any():
            self.weigh(np.where(cells, 1.0, ratio))

    def looked(self, cells: np.ndarray) -> None:
        """The robot's own sensors see these cells (n,), and no person there."""
        self.weigh(np.where(cells, LOOK, 1.0))

    def rooms(self) -> dict[str, float]:
        """The probability of each room."""
        return self._home.room_sums(self.cells)
