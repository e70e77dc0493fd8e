"""One output folder of a bake: who writes there, where a fresh bake grows, and how it takes the old one's place.

An Output holds one folder and knows nothing of what is baked; a bake of several grounds holds one for each:

    out = Output(folder, owner)
    out.open()                        # lock, put right what a killed bake left; DesirePathError when refused
    .. write below out.new ..
    out.ready(), out.publish()        # or out.publish_stopped()
    out.release()                     # always

Files of others in these folders are left alone, and those in the old `frames` and `maps` move to the new ones.
"""

from __future__ import annotations

import contextlib
import fnmatch
import os
import time
from collections.abc import Container

from ..errors import DesirePathError
from ..files import atomic_file, disk
from .contents import (
    EARLIER,
    FILES,
    INSIDE,
    LOCK,
    NAMES,
    NEW,
    OLD,
    PARTS,
    SHOWN,
    delete,
    holds_bake,
    is_complete,
    is_link,
    owner_of,
)
from .exchange import clear, exchange


class Output:
    """One folder that a bake writes to. owner: id of the ground it belongs to, empty = anybody's."""

    def __init__(self, folder: str | os.PathLike[str], owner: str = "") -> None:
        self.folder, self.owner = os.path.abspath(os.fspath(folder)), str(owner)
        self.new = os.path.join(self.folder, NEW)
        self._lock: int | None = None
        self._created: list[str] = []

    def path(self, *names: str) -> str:
        """Of something that is made, below bake.new."""
        return os.path.join(self.new, *names)

    def open(self, wait: float = 0.0) -> None:
        """Take the folder for this bake, and put right what a killed one left there.

        wait: so long another program may go on baking there before this one is refused [s]
        """
        place = self.folder
        while not os.path.lexists(place):
            self._created.append(place)
            place = os.path.dirname(place)
        if os.path.lexists(self.folder) and not os.path.isdir(self.folder):
            raise DesirePathError(
                f"{self.folder} is a {atomic_file.kind_of(self.folder)}, in which no bake can lie: choose a folder."
            )
        try:
            os.makedirs(self.folder, exist_ok=True)
        except (OSError, ValueError) as problem:
            raise DesirePathError(
                f"The folder {self.folder} cannot be made "
                f"({getattr(problem, 'strerror', None) or problem}): choose another one."
            ) from None
        try:
            self._take(time.monotonic() + wait)
            self._check_places()
            check_owner(self.folder, self.owner)
            self._check_files()
            self.settle()
        except OSError as problem:
            self.release()
            raise DesirePathError(
                f"The folder {self.folder} cannot be written ({problem.strerror}): choose another one."
            ) from None
        except BaseException:
            self.release()
            raise

    def _take(self, until: float) -> None:
        path = os.path.join(self.folder, LOCK)
        if atomic_file.kind_of(path) not in ("", "file"):
            raise DesirePathError(f"{path} stands where the bake keeps a file: move it or choose another folder.")
        while self._lock is None:
            try:
                self._lock = disk.lock(path, time.strftime("%Y-%m-%dT%H:%M:%S"))
            except disk.Held as held:
                process, host, since = (*str(held).split(), "?", "?", "?")[:3]
                if process == str(os.getpid()) or time.monotonic() > until:
                    raise DesirePathError(
                        f"Another bake into {self.folder} is running (process {process} on {host}, since {since}): "
                        "wait for it, stop it, or choose another folder."
                    ) from None
                time.sleep(0.1)

    def release(self) -> None:
        """Let others bake here; folders that open() made and nothing came into go."""
        if self._lock is not None:
            with contextlib.suppress(OSError):
                disk.unlock(self._lock, os.path.join(self.folder, LOCK))
            self._lock = None
        for place in self._created:
            with contextlib.suppress(OSError):
                os.rmdir(place)
        self._created = []

    def _check_places(self) -> None:
        """Refuse a folder in which something else stands where files of the bake would."""
        for name in (*NAMES, NEW, OLD, f"{NEW}/frames", f"{NEW}/maps"):
            path = os.path.join(self.folder, name)
            kind = "file" if name in FILES else "folder"
            if atomic_file.kind_of(path) not in ("", kind) and not is_link(path, os.path.basename(name)):
                raise DesirePathError(f"{path} stands where the bake keeps a {kind}: move it or choose another folder.")
        shown = os.path.join(self.folder, SHOWN)
        kind = atomic_file.kind_of(shown)
        if kind not in ("", "file") and not (kind == "link" and os.readlink(shown) in (OLD, NEW)):
            raise DesirePathError(f"{shown} stands where the bake keeps a link: move it or choose another folder.")

    def _check_files(self) -> None:
        """Refuse a folder without a bake in which a file has the name of one: it is somebody else's."""
        if holds_bake(self.folder):
            return
        for inside in ("frames", "maps", ""):
            place = os.path.join(self.folder, inside)
            if not os.path.isdir(place) or os.path.islink(place):
                continue
            for name in sorted(os.listdir(place)):
                ours = FILES if not inside else INSIDE[inside]
                if not name.endswith("part") and any(fnmatch.fnmatchcase(name, pattern) for pattern in ours):
                    raise DesirePathError(
                        f"{os.path.join(place, name)} is named as a file of a bake, of which there is nothing else: "
                        "move it, or choose another folder."
                    )

    # ---- what was left ----------------------------------------------------------------------------------

    def settle(self) -> None:
        """End a publication that was cut off, and clear away what is left of one or of earlier versions."""
        if os.path.lexists(os.path.join(self.folder, SHOWN)):
            exchange(self.folder)
        clear(self.folder, OLD)
        if os.path.islink(self.path(SHOWN)) or not os.path.exists(self.path("frames", "index.json")):
            clear(self.folder, NEW)  # nothing there to go on with, or what is shown already
        for name, patterns in EARLIER.items():
            delete(os.path.join(self.folder, name), patterns)
        delete(os.path.join(self.folder, ""), PARTS, itself=False)

    def fresh(self, keep: Container[str] = ()) -> None:
        """Make bake.new with its folders; what is in it goes, but the frames and maps in `keep`."""
        for name, patterns in INSIDE.items():
            delete(self.path(name), patterns, keep if name else ())
        for name in ("frames", "maps"):
            os.makedirs(self.path(name), exist_ok=True)

    def drop(self) -> None:
        """Delete what is in bake.new."""
        clear(self.folder, NEW)

    # ---- the new for the old ------------------------------------------------------------------------------

    def ready(self) -> None:
        """Bake.new is whole, and on the disk: from here on publish() or whoever comes next lets it be shown.

        A bake of several folders makes all of them ready before it publishes the first.
        """
        with contextlib.suppress(OSError):
            os.rmdir(self.path("maps"))  # no maps were asked for
        disk.sync(self.new)
        clear(self.folder, OLD)
        os.makedirs(os.path.join(self.folder, OLD), exist_ok=True)
        shown = os.path.join(self.folder, SHOWN)
        try:
            disk.link(OLD, shown)
        except (OSError, NotImplementedError):  # a disk without links
            atomic_file.write_json(shown, [n for n in NAMES if os.path.lexists(self.path(n))], "The list of files")

    def withdraw(self) -> None:
        """Take ready() back, before publish()."""
        with contextlib.suppress(OSError):
            os.unlink(os.path.join(self.folder, SHOWN))

    def publish(self) -> None:
        """Let everything in bake.new, which is ready, take the place of what is shown, at once."""
        exchange(self.folder)

    def publish_stopped(self) -> None:
        """Let the frames and maps that a stopped bake came to be shown, unless a whole bake is."""
        if is_complete(os.path.join(self.folder, "frames")):
            return
        delete(self.new, INSIDE[""], itself=False)
        self.ready()
        self.publish()


def check_owner(folder: str, owner: str) -> None:
    """Refuse a folder with the bake of another ground; who says no owner may have any."""
    other = owner_of(folder)
    if owner and other and owner != other:
        raise DesirePathError(f"The folder {folder} holds the bake of another ground ({other}): choose another folder.")


def check_idle(folder: str | os.PathLike[str]) -> None:
    """Refuse a folder that is being baked into now, before work is put into a bake of one's own."""
    if os.path.lexists(os.path.join(folder, LOCK)):
        out = Output(folder)
        with contextlib.suppress(OSError):  # open() will say what is wrong
            out._take(time.monotonic())
        out.release()


def settle(folder: str | os.PathLike[str]) -> None:
    """End a publication in a folder that a killed bake cut off; nothing to do in any other, or while one runs."""
    if not os.path.lexists(os.path.join(folder, SHOWN)):
        return
    out = Output(folder)
    with contextlib.suppress(DesirePathError):  # another bake is at it, or the folder is not ours to write
        out.open()
        out.release()


def free(folder: str | os.PathLike[str], owner: str = "", aside: str = "") -> None:
    """Delete the files a bake wrote, and the folders they leave empty; nothing else is touched.

    owner: id of the ground that frees; another one's bake is refused, and so is a folder that is being baked into
    aside: a folder beside it that takes the bake in, for bring_back()
    """
    folder = os.path.abspath(os.fspath(folder))
    if not os.path.isdir(folder):
        return
    out = Output(folder, owner)
    try:
        out.open()
        if aside:
            with contextlib.suppress(OSError):  # no room for it there
                _shift(folder, aside)
        for name, patterns in INSIDE.items():
            delete(os.path.join(folder, name), patterns, itself=bool(name))
        out.drop()
    except OSError as problem:
        raise DesirePathError(
            f"{problem.filename} cannot be deleted ({problem.strerror}): delete the folder {folder} by hand."
        ) from None
    finally:
        out.release()
    with contextlib.suppress(OSError):  # not there, or holds somebody else's files
        os.rmdir(folder)


def bring_back(aside: str, folder: str, owner: str = "") -> bool:
    """Undo free(): the bake that was put aside lies in its folder again, if no other one does; returns whether."""
    if owner_of(aside) != owner or owner_of(folder):
        return False
    out = Output(folder, owner)
    try:
        out.open()
        _shift(aside, folder)
    except OSError as problem:
        raise DesirePathError(
            f"The bake in {aside} cannot be moved ({problem.strerror}): move it to {folder} by hand."
        ) from None
    finally:
        out.release()
    with contextlib.suppress(OSError):
        os.rmdir(aside)
    return True


def _shift(folder: str, into: str) -> None:
    """Move the files of a bake to another folder of the same disk."""
    for name, patterns in INSIDE.items():
        source = os.path.join(folder, name)
        if os.path.isdir(source) and not os.path.islink(source):
            os.makedirs(os.path.join(into, name), exist_ok=True)
            for each in os.listdir(source):
                if any(fnmatch.fnmatchcase(each, pattern) for pattern in patterns):
                    disk.replace(os.path.join(source, each), os.path.join(into, name, each))
            with contextlib.suppress(OSError):  # holds somebody else's files
                os.rmdir(source)
