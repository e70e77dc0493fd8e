"""One output folder of a bake: who writes there, where a fresh bake grows, and how it takes the old one's place.

    frames/ maps/ maps_final.exr ..   the bake that is shown: NAMES
    bake.new/                         the one that is being made, under the same names
    bake.lock                         while one is made: its process, computer and time
    bake.old/ bake.shown              for a moment, while the new one takes the place of the old one

An Output holds one folder and knows nothing of what is baked; a bake of several grounds holds one for each:

    out = Output(folder, owner)
    out.open()                        # lock, put right what a killed bake left; DesirePathError when refused
    .. write below out.new ..
    out.ready(), out.publish()        # or out.publish_stopped()
    out.release()                     # always

Publishing. All names change at one moment, though no system can exchange several names at once: each name that is
shown is first made a link through the one link `bake.shown`, which leads to bake.old, where what it named went
(exchanged with it, so that no name is ever missing and none shows anything new); then `bake.shown` is turned to
bake.new, in one rename; then each name is exchanged for the real file or folder again, and the links go. A process
that is killed in between leaves names that show the old bake, all of it, or the new one. Every step looks at what
is there, so that whoever comes next (a bake, free(), read_index()) takes the same way from the beginning.
Where the disk cannot exchange names, a folder's own is missing for the time of one rename; where it has no links,
`bake.shown` is a list of what is new and names change one after the other, and whoever comes next ends that.

Files of others in these folders are left alone, and those in the old `frames` and `maps` move to the new ones.
"""

from __future__ import annotations

import contextlib
import fnmatch
import json
import os
import time
from pathlib import Path

from ..errors import DesirePathError
from ..files import atomic_file, disk

FRAMES = (
    "trail_*.exr",
    "trail_*.part",
    "lean_*.exr",
    "lean_*.part",
    "index.json",
    "index.json.*part",
    "trail_sums.txt",
    "trail_sums.txt.*part",
    "bake_*.state",
    "bake_*.state.*part",
    "plants.pc2.part",
)
MAPS = ("second_*.exr", "second_*.part", "pass_*.exr", "pass_*.part")
FILES = ("maps_start.exr", "maps_final.exr", "report.json", "plants.pc2", "plants.npz")
MAPS_ALWAYS = FILES[:3]  # every whole bake has these
NAMES = ("frames", "maps", *FILES)
NEW, OLD, SHOWN, LOCK = "bake.new", "bake.old", "bake.shown", "bake.lock"
PARTS = tuple(f"{name}*.part" for name in (*FILES, SHOWN))
INSIDE = {"frames": FRAMES, "maps": MAPS, "": FILES + PARTS}
EARLIER = {"frames.new": FRAMES, "frames.old": FRAMES, "maps.new": MAPS}  # of earlier versions: stopped bakes
OWNER = "bake_folder_owner"  # in index.json
MOST_JSON = 1 << 22  # bytes of an index.json


def told(frames):
    """What the index.json of a folder of frames says, a dict; empty where there is none that can be read."""
    return _said(os.path.join(frames, "index.json"))


def _said(path):
    """The dict in a JSON file of a bake; empty where there is none."""
    try:
        with atomic_file.reader(path) as file:
            text = file.read(MOST_JSON + 1)
        data = json.loads(text.decode("utf-8")) if len(text) <= MOST_JSON else {}
    except (OSError, ValueError, RecursionError, MemoryError):
        return {}
    return data if isinstance(data, dict) else {}


def holds_bake(folder):
    """Whether the files in a folder that are named as those of a bake are a bake's, or what is left of one."""
    there = (os.path.join(folder, *way, "frames") for way in ((), (NEW,)))
    return any(
        os.path.isfile(os.path.join(each, name)) for each in there for name in ("index.json", "trail_sums.txt")
    ) or {"parameters", "version"} <= set(_said(os.path.join(folder, "report.json")))


def is_whole(frames):
    """Whether a folder of frames holds a bake that came to its end."""
    return told(frames).get("complete") is True


def owner_of(folder):
    """Id of the ground whose bake, whole or not, lies in a folder; empty: nobody's, or there is none."""
    for name in ("frames", f"{NEW}/frames"):
        found = told(os.path.join(folder, name)).get(OWNER, "")
        if found and isinstance(found, str):
            return found
    return ""


class Output:
    """One folder that a bake writes to. owner: id of the ground it belongs to, empty = anybody's."""

    def __init__(self, folder, owner=""):
        self.folder, self.owner = os.path.abspath(os.fspath(folder)), str(owner)
        self.new = os.path.join(self.folder, NEW)
        self._lock, self._made = None, []

    def path(self, *names):
        """Of something that is made, below bake.new."""
        return os.path.join(self.new, *names)

    def open(self, wait=0.0):
        """Take the folder for this bake, and put right what a killed one left there.

        wait: so long another program may go on baking there before this one is refused [s]
        """
        place = self.folder
        while not os.path.lexists(place):
            self._made.append(place)
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

    def _take(self, until):
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

    def release(self):
        """Let others bake here; folders that open() made and nothing came into go."""
        if self._lock is not None:
            with contextlib.suppress(OSError):
                disk.unlock(self._lock, os.path.join(self.folder, LOCK))
            self._lock = None
        for place in self._made:
            with contextlib.suppress(OSError):
                os.rmdir(place)
        self._made = []

    def _check_places(self):
        """Refuse a folder in which something else stands where files of the bake would."""
        for name in (*NAMES, NEW, OLD, f"{NEW}/frames", f"{NEW}/maps"):
            path = os.path.join(self.folder, name)
            kind = "file" if name in FILES else "folder"
            if atomic_file.kind_of(path) not in ("", kind) and not _is_link(path, os.path.basename(name)):
                raise DesirePathError(f"{path} stands where the bake keeps a {kind}: move it or choose another folder.")
        shown = os.path.join(self.folder, SHOWN)
        kind = atomic_file.kind_of(shown)
        if kind not in ("", "file") and not (kind == "link" and os.readlink(shown) in (OLD, NEW)):
            raise DesirePathError(f"{shown} stands where the bake keeps a link: move it or choose another folder.")

    def _check_files(self):
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

    def settle(self):
        """End a publication that was cut off, and clear away what is left of one or of earlier versions."""
        if os.path.lexists(os.path.join(self.folder, SHOWN)):
            self._exchange()
        self._clear(OLD)
        if not os.path.exists(self.path("frames", "index.json")):
            self._clear(NEW)  # nothing there to go on with
        for name, patterns in EARLIER.items():
            delete(os.path.join(self.folder, name), patterns)
        delete(os.path.join(self.folder, ""), PARTS, itself=False)

    def fresh(self, keep=()):
        """Make bake.new with its folders; what is in it goes, but the frames and maps in `keep`."""
        for name, patterns in INSIDE.items():
            delete(self.path(name), patterns, keep if name else ())
        for name in ("frames", "maps"):
            os.makedirs(self.path(name), exist_ok=True)

    def drop(self):
        """Delete what is in bake.new."""
        self._clear(NEW)

    def _clear(self, name):
        """Delete our files of bake.old or bake.new; others' files in its folders move to those that are shown."""
        top = os.path.join(self.folder, name)
        for inside in ("frames", "maps"):
            way = os.path.join(top, inside)
            if os.path.islink(way):
                os.unlink(way)
            delete(way, INSIDE[inside])
            if os.path.isdir(way):
                move(way, os.path.join(self.folder, inside))
        delete(top, INSIDE[""])

    # ---- the new for the old ------------------------------------------------------------------------------

    def ready(self):
        """Bake.new is whole, and on the disk: from here on publish() or whoever comes next lets it be shown.

        A bake of several folders makes all of them ready before it publishes the first.
        """
        with contextlib.suppress(OSError):
            os.rmdir(self.path("maps"))  # no maps were asked for
        disk.sync(self.new)
        self._clear(OLD)
        os.makedirs(os.path.join(self.folder, OLD), exist_ok=True)
        shown = os.path.join(self.folder, SHOWN)
        try:
            os.symlink(OLD, shown)
        except (OSError, NotImplementedError):  # a disk without links
            atomic_file.write_json(shown, [n for n in NAMES if os.path.lexists(self.path(n))], "The list of files")

    def withdraw(self):
        """Take ready() back, before publish()."""
        with contextlib.suppress(OSError):
            os.unlink(os.path.join(self.folder, SHOWN))

    def publish(self):
        """Let everything in bake.new, which is ready, take the place of what is shown, at once."""
        self._exchange()

    def publish_stopped(self):
        """Let the frames and maps that a stopped bake came to be shown, unless a whole bake is."""
        if is_whole(os.path.join(self.folder, "frames")):
            return
        delete(self.new, INSIDE[""], itself=False)
        self.ready()
        self.publish()

    def _exchange(self):
        """From wherever a publication is to its end."""
        shown = os.path.join(self.folder, SHOWN)
        if os.path.islink(shown):
            if os.readlink(shown) == OLD:
                for name in NAMES:
                    self._lead(name)
                turned = f"{shown}.new"
                with contextlib.suppress(FileNotFoundError):
                    os.unlink(turned)
                os.symlink(NEW, turned)
                os.replace(turned, shown)  # this is the moment
            for name in NAMES:
                self._settle_name(name)
        else:
            self._one_by_one(shown)
        os.unlink(shown)
        disk.sync_one(self.folder)
        self._clear(OLD)
        self._clear(NEW)

    def _lead(self, name):
        """Make a name that is shown a link through bake.shown to the same file or folder, in bake.old from now on."""
        here, old = (os.path.join(self.folder, *way) for way in ((name,), (OLD, name)))
        if _is_link(here, name):
            return
        link = f"{SHOWN}/{name}"
        if not os.path.lexists(here):
            if os.path.lexists(self.path(name)) or os.path.lexists(old):
                os.symlink(link, here)
            return
        if _is_link(old, name):
            os.unlink(old)  # of a try that was cut off
        os.symlink(link, old)
        if not disk.swap(here, old):
            os.unlink(old)
            os.rename(here, old)
            os.symlink(link, here)

    def _settle_name(self, name):
        """Make a name that is shown the file or folder of bake.new itself again."""
        here, new = os.path.join(self.folder, name), self.path(name)
        ours, there = _is_link(here, name), os.path.lexists(new) and not _is_link(new, name)
        if ours and there and disk.swap(here, new):
            os.unlink(new)
        elif there and (ours or not os.path.lexists(here)):
            if os.path.isdir(new) and ours:
                os.unlink(here)  # a folder cannot be renamed to a link's name
            os.replace(new, here)
        elif ours:
            os.unlink(here)

    def _one_by_one(self, shown):
        """The same without links: each name in turn. `shown` lists those of the new bake."""
        try:
            with open(shown, encoding="utf-8") as file:
                fresh = list(json.load(file))
        except (ValueError, TypeError, RecursionError):
            raise DesirePathError(f"{shown} is damaged: delete it, and bake again.") from None
        for name in NAMES:
            here, old, new = (os.path.join(self.folder, *way) for way in ((name,), (OLD, name), (NEW, name)))
            waits = os.path.lexists(new)
            if os.path.lexists(here) and not os.path.lexists(old) and (waits or name not in fresh):
                os.rename(here, old)
            if waits:
                os.rename(new, here)


def check_owner(folder, owner):
    """Refuse a folder with the bake of another ground; who says no owner may have any."""
    other = owner_of(folder)
    if owner and other and owner != other:
        raise DesirePathError(f"The folder {folder} holds the bake of another ground ({other}): choose another folder.")


def check_idle(folder):
    """Refuse a folder that is being baked into now, before work is put into a bake of one's own."""
    if os.path.lexists(os.path.join(folder, LOCK)):
        out = Output(folder)
        with contextlib.suppress(OSError):  # open() will say what is wrong
            out._take(time.monotonic())
        out.release()


def settle(folder):
    """End a publication in a folder that a killed bake cut off; nothing to do in any other, or while one runs."""
    if not os.path.lexists(os.path.join(folder, SHOWN)):
        return
    out = Output(folder)
    with contextlib.suppress(DesirePathError):  # another bake is at it, or the folder is not ours to write
        out.open()
        out.release()


def free(folder, owner="", aside=""):
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


def bring_back(aside, folder, owner=""):
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


def _shift(folder, into):
    """Move the files of a bake to another folder of the same disk."""
    for name, patterns in INSIDE.items():
        source = os.path.join(folder, name)
        if os.path.isdir(source) and not os.path.islink(source):
            os.makedirs(os.path.join(into, name), exist_ok=True)
            for each in os.listdir(source):
                if any(fnmatch.fnmatchcase(each, pattern) for pattern in patterns):
                    os.rename(os.path.join(source, each), os.path.join(into, name, each))
            with contextlib.suppress(OSError):  # holds somebody else's files
                os.rmdir(source)


def delete(folder, patterns, keep=(), itself=True):
    """Delete our files from a folder but those named in `keep`, and `itself` if that leaves it empty."""
    if os.path.islink(folder) or not os.path.isdir(folder):
        return
    for name in os.listdir(folder):
        path = Path(folder, name)
        ours = name not in keep and any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)
        if ours and (path.is_symlink() or not path.is_dir()):
            path.unlink()
    if itself:
        with contextlib.suppress(OSError):  # not there, or holds somebody else's files
            os.rmdir(folder)


def move(folder, into):
    """Move what a folder holds into another one, under a free name, and remove it."""
    os.makedirs(into, exist_ok=True)
    for name in os.listdir(folder):
        path, number = Path(folder, name), 1
        while os.path.lexists(os.path.join(into, name)):
            number += 1
            name = f"{path.stem} {number}{path.suffix}"
        os.rename(path, os.path.join(into, name))
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def _is_link(path, name):
    """Whether a path is our link for `name` while a bake takes its place."""
    try:
        return os.readlink(path) == f"{SHOWN}/{name}"
    except (OSError, ValueError):
        return False
