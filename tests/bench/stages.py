"""Where the time of a bake goes: the add-on's own functions with a clock around them.

    with stages.clock() as spent:
        bpy.ops.object.desire_path_bake()
    print(stages.line(spent))

A stage's seconds are without the stages inside it; `rest` of a line is what no stage claims.
"""

import contextlib
import time

STAGES = {  # name -> module and function below desire_path
    "sample": ("blender.sample", "record"),
    "takes": ("blender.moves", "besides"),
    "ground": ("blender.ground", "read"),
    "create": ("ground.sim", "Simulation.__init__"),
    "loads": ("loads.walker", "Walker.loads"),
    "load": ("ground.sim", "Simulation.load"),
    "signature": ("bake.plan", "Plan.signature"),
    "step": ("ground.sim", "Simulation.run"),
    "frames": ("ground.sim", "Film.write_frame"),
    "flush": ("ground.sim", "Simulation.flush"),
    "maps": ("ground.sim", "Film.write_maps"),
    "start maps": ("bake.share", "Share.write_start"),
    "write": ("ground.maps", "write"),
    "read": ("ground.maps", "read"),
    "publish": ("bake.output", "Output.publish"),
    "attach": ("blender.playback", "attach"),
    "fill": ("blender.cover", "fill"),
    "points": ("blender.cover", "few_points"),
    "marks": ("blender.inputs", "marks"),
}


@contextlib.contextmanager
def clock():
    """Seconds by stage, filled while the block runs; `whole` is the block itself."""
    import importlib

    spent, inside, put_back = dict.fromkeys(STAGES, 0.0), [], []

    def timed(name, function):
        def around(*args, **words):
            begun = time.perf_counter()
            inside.append(0.0)
            try:
                return function(*args, **words)
            finally:
                took = time.perf_counter() - begun
                spent[name] += took - inside.pop()
                if inside:
                    inside[-1] += took

        return around

    for name, (module, path) in STAGES.items():
        owner = importlib.import_module("desire_path." + module)
        *outer, last = path.split(".")
        for each in outer:
            owner = getattr(owner, each)
        function = getattr(owner, last)
        put_back.append((owner, last, function))
        setattr(owner, last, timed(name, function))
    begun = time.perf_counter()
    try:
        yield spent
    finally:
        spent["whole"] = time.perf_counter() - begun
        for owner, last, function in put_back:
            setattr(owner, last, function)


def line(spent):
    """One line of text: milliseconds by stage, the largest first."""
    whole = spent["whole"]
    claimed = {name: each for name, each in spent.items() if name != "whole"}
    claimed["rest"] = whole - sum(claimed.values())
    parts = [
        f"{name} {1000 * each:.0f}" for name, each in sorted(claimed.items(), key=lambda i: -i[1]) if each >= 0.0005
    ]
    return f"{1000 * whole:.0f} ms: " + ", ".join(parts)
