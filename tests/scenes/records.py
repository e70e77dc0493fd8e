"""What a test chooses by name, as a Bake and a Simulation take it: what belongs to their options in records."""

from dataclasses import fields

from desire_path.bake.options import BakeOptions, BakeOutput
from desire_path.ground.options import SimulationOptions


def for_bake(**chosen):
    return _told(chosen, options=BakeOptions, output=BakeOutput)


def for_simulation(**chosen):
    return _told(chosen, options=SimulationOptions)


def _told(chosen, **records):
    for name, record in records.items():
        own = {each.name: chosen.pop(each.name) for each in fields(record) if each.name in chosen}
        chosen[name] = record(**own)
    return chosen
