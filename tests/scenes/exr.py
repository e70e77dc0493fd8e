"""exr.py - a plain OpenEXR writer for tests: flat, scan lines, 32-bit float, uncompressed."""

import struct

import numpy as np


def write(path, rgba):
    """rgba: float32 (ny, nx, 4), row 0 = lowest y, as the playback frames have it."""
    ny, nx, _ = rgba.shape

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(c.encode() + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in "ABGR") + b"\0"
    window = struct.pack("<iiii", 0, 0, nx - 1, ny - 1)
    head = struct.pack("<ii", 20000630, 2)
    head += attribute("channels", "chlist", channels)
    head += attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0.0, 0.0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)) + b"\0"
    line = 4 * 4 * nx
    first = len(head) + 8 * ny
    with open(path, "wb") as out:
        out.write(head)
        out.write(struct.pack(f"<{ny}Q", *(first + y * (8 + line) for y in range(ny))))
        for y in range(ny):
            row = np.ascontiguousarray(rgba[ny - 1 - y, :, ::-1].T, "<f4")
            out.write(struct.pack("<ii", y, line) + row.tobytes())
