"""Files that appear whole or not at all."""

import contextlib
import os
import tempfile

from .errors import DesirePathError


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


@contextlib.contextmanager
def file(path, what, mode="wb", **more):
    """Open a temporary file beside `path` that takes its place when the block ends well.

    what: "The recording", for the sentence that says why it could not be written. An earlier file stays as
    it was when anything goes wrong. `more` goes to open().
    """
    path = os.fspath(path)
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(suffix=".part", dir=os.path.dirname(os.path.abspath(path)))
        with os.fdopen(handle, mode, **more) as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise DesirePathError(f"{what} cannot be written to {path} ({error.strerror or error}): choose "
                              "another folder or make room.") from None
    finally:
        if temporary is not None:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
