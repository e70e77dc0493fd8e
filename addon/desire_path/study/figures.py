"""The papers' experiments, made again: what they state, and what is seen here. python -m desire_path study figures

Each presses, drops, walks or treads, and gives a Figure. Nothing here draws: see figure_page.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from .figure import Figure
from .figures_soil import push, repose, sinking, soils, sphere
from .figures_walk import cover, forces, hill, impact, roots, walkers

FIGURES: Mapping[str, Callable[[], Figure]] = MappingProxyType(
    {
        each.__name__: each
        for each in (forces, impact, sphere, sinking, soils, push, repose, walkers, hill, roots, cover)
    }
)
