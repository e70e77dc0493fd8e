"""pip install . - one wheel for CPython 3.11 and every later one: CMake builds desire_path._native
against the stable ABI. Needs a C compiler and make."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, find_packages, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    """The module is whatever native/CMakeLists.txt makes of it."""

    def build_extension(self, extension):
        folder = Path(self.build_temp).resolve() / "native"
        folder.mkdir(parents=True, exist_ok=True)
        cmake = shutil.which("cmake")
        if not cmake:
            raise RuntimeError("cmake is missing: install it and try again")
        subprocess.run(
            [
                cmake,
                "-S",
                str(HERE / "native"),
                "-B",
                str(folder),
                "-DDP_TESTS=OFF",
                f"-DPython3_EXECUTABLE={sys.executable}",
            ],
            check=True,
        )
        subprocess.run(
            [cmake, "--build", str(folder), "--target", "_native", "--parallel", str(os.cpu_count() or 1)], check=True
        )
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(folder / "_native.abi3.so", target)


class WithCore(sdist):
    """A source archive holds the core too."""

    def add_defaults(self):
        super().add_defaults()
        self.filelist.extend(
            str(path.relative_to(HERE)) for path in sorted((HERE / "native").rglob("*")) if path.is_file()
        )


def version():
    text = (HERE / "addon/desire_path/version.py").read_text(encoding="utf-8")
    return re.search(r'^VERSION = "([^"]+)"', text, re.MULTILINE).group(1)


setup(
    version=version(),
    package_dir={"": "addon"},
    packages=find_packages("addon"),
    package_data={
        "desire_path": [
            "blender_manifest.toml",
            "CHANGELOG.md",
            "THIRD-PARTY.md",
            "farm/flamenco/*.js",
            "walks/*",
            "blender/pictures/*.png",
            "py.typed",
            "*.pyi",
        ]
    },
    ext_modules=[Extension("desire_path._native", [], py_limited_api=True)],
    cmdclass={"build_ext": CMakeBuild, "sdist": WithCore},
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
)
