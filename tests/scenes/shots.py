"""shots.py - the pictures of a script: one after another, by the names and the size that its command line asks for."""

import argparse
import pathlib
import sys

import bpy


def take(doc, option, names, make, size):
    """Render FOLDER/NAME.png of every name that is asked for.

    doc: of the script; option: the names on its command line; make: lays out the scene of a name, with its camera;
    size: (width, height, samples) where none is asked for
    """
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("folder", help="for the pictures")
    for name, usual in zip(("width", "height", "samples"), size):
        parser.add_argument(f"--{name}", type=int, default=usual)
    parser.add_argument(option, default=",".join(names), dest="names", help="which of them, with commas between")
    chosen = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:])
    import desire_path

    desire_path.register()
    for name in chosen.names.split(","):
        make(name)
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = chosen.width, chosen.height
        scene.cycles.samples = chosen.samples
        scene.render.image_settings.file_format = "PNG"
        scene.render.filepath = str(pathlib.Path(chosen.folder).resolve() / f"{name}.png")
        bpy.ops.render.render(write_still=True)
