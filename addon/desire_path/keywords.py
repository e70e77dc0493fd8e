"""Options that belong together are one record: a frozen dataclass. Its fields may still be given one by one.

@fields_of(options=SimulationOptions)
def grind(ground, *, cell_size=0.01, options=SimulationOptions()): ..

grind(ground, options=SimulationOptions(law="uniform"))
grind(ground, law="uniform")          the same, with a DeprecationWarning that says how it is written
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import warnings
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def fields_of(*order: str, **records: type) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Let a function take the fields of its records as keywords of their own, too.

    records: of each parameter that is a record its dataclass, all of whose fields have a default where it may be left
    out; the parameter's own default is an instance, or None for one of defaults.
    order: fields that may be given without a name after the function's own parameters, in this order.
    TypeError for a field that is given twice: alone and by its record, or with and without its name.
    """
    home = {each.name: name for name, record in records.items() for each in dataclasses.fields(record)}

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        own = inspect.signature(function).parameters
        places = sum(each.kind in (each.POSITIONAL_ONLY, each.POSITIONAL_OR_KEYWORD) for each in own.values())
        called = function.__qualname__.removesuffix(".__init__").rpartition("<locals>.")[2]

        @functools.wraps(function)
        def taken(*args: Any, **words: Any) -> R:
            single = {name: words.pop(name) for name in [*words] if name in home and name not in own}
            for name, value in zip(order, args[places:]):
                if name in single:
                    raise TypeError(f"{called}() got {name} twice: give it by its name.")
                single[name] = value
            if single:
                _warn(called, single)
            for name, record in records.items():
                given = {field: value for field, value in single.items() if home[field] == name}
                if not given:
                    continue
                if name in words:
                    raise TypeError(f"{called}() got {' and '.join(given)} and {name}: give them in {name} alone.")
                default: Any = own[name].default
                has_one = isinstance(default, record)
                words[name] = dataclasses.replace(default, **given) if has_one else record(**given)
            return function(*args[: places + max(0, len(args) - places - len(order))], **words)

        return taken

    def _warn(called: str, single: dict[str, Any]) -> None:
        variants = []
        for name, record in records.items():
            inside = ", ".join(f"{field}=.." for field in single if home[field] == name)
            if inside:
                variants.append(f"{name}={record.__name__}({inside})")
        warnings.warn(
            f"{called}({', '.join(f'{field}=..' for field in single)}) is written {called}({', '.join(variants)}).",
            DeprecationWarning,
            stacklevel=3,
        )

    return decorate
