"""A whole bake: frames, maps and a report in a folder that is good or not there."""

from .. import lazy

__getattr__, __dir__, __all__ = lazy.names(
    __name__,
    {
        "Bake": "bake",
        "BakeOptions": "options",
        "BakeOutput": "options",
        "FILMS": "options",
        "FORMAT": "folder",
        "FrameIndex": "folder",
        "LivePress": "press",
        "PressBody": "press",
        "free": "output",
        "read_index": "folder",
    },
)
