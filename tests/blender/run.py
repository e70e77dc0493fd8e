"""run.py - the Blender tests, in whatever Blender runs this file.

    env PATH=/usr/bin:/bin blender -b --python-exit-code 1 --python tests/blender/run.py
    python tests/blender/run.py              (with the bpy module)
    .. -- playback sampling                  only the files whose name contains a word
Each test is a plain function `test_*` of a file test_*.py here; it starts from an empty file.
"""

import importlib.util
import pathlib
import sys
import tempfile
import time
import traceback

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
for folder in (HERE, ROOT / "tests", ROOT / "addon"):
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))


class Skip(Exception):
    """Raised by a test that cannot run here, with the reason."""


def wanted():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if "--" not in sys.argv and sys.argv and sys.argv[0].endswith("run.py"):
        words = sys.argv[1:]
    for path in sorted(HERE.glob("test_*.py")):
        if not words or any(word in path.stem for word in words):
            yield path


def run(test):
    """Run one test in an empty file; returns None, or what went wrong."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        with tempfile.TemporaryDirectory(prefix="desire_path_") as folder:
            if test.__code__.co_argcount:
                test(pathlib.Path(folder))
            else:
                test()
            bpy.ops.wm.read_factory_settings(use_empty=True)
    except Skip as reason:
        return f"SKIP {reason}"
    except Exception:
        return traceback.format_exc()
    return None


def main():
    import bpy

    import desire_path

    sys.modules.setdefault("run", sys.modules["__main__"])
    desire_path.register()
    passed = skipped = 0
    failures = []
    for path in wanted():
        spec = importlib.util.spec_from_file_location(path.stem, path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        for name, test in list(vars(module).items()):
            if not name.startswith("test_") or not callable(test):
                continue
            start = time.perf_counter()
            wrong = run(test)
            took = time.perf_counter() - start
            label = f"{path.stem}.{name[5:]}"
            if wrong is None:
                passed += 1
                print(f"  ok    {label} ({took:.2f} s)")
            elif wrong.startswith("SKIP"):
                skipped += 1
                print(f"  skip  {label}: {wrong[5:]}")
            else:
                failures.append(f"  FAIL  {label}\n{wrong}")
                print(failures[-1])
            sys.stdout.flush()
    desire_path.unregister()
    if failures:  # once more, for those who see the end of a long log
        print("\nWhat went wrong:", *failures, sep="\n")
    failed = len(failures)
    version = ".".join(map(str, bpy.app.version))
    print(f"Blender {version}: {passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    sys.stdout.flush()
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
