"""The version. bl_info and blender_manifest.toml repeat it: tests/core/test_package.py compares."""

VERSION = "0.1.0"
