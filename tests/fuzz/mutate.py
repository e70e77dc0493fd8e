"""Files damaged on purpose: bytes, numbers and structure of a good one, changed a little or a lot.

Everything comes from the random.Random that is given, so that a run can be made again.
"""

import io
import json
import zipfile

NUMBERS = (
    b"0",
    b"-1",
    b"1e999",
    b"-1e999",
    b"nan",
    b"NaN",
    b"Infinity",
    b"1e-320",
    b"2147483648",
    b"4294967295",
    b"-9223372036854775809",
    b"1" * 40,
    b"9" * 5000,
    b"0x10",
    b"1_000",
    b"1.",
    b".",
    b"-",
    b"",
)
SPEECH = (
    b"null",
    b"true",
    b'""',
    b"[]",
    b"{}",
    b'"\\ud800"',
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"\0",
    b"\r",
    b'"',
    b",",
    b"[" * 3000,
    b'{"a":' * 3000,
    b"\n",
    b"\xc3\xa4",
    b"//",
    b"/../x",
)
VALUES = (
    0,
    -1,
    1,
    2,
    1e999,
    -1e999,
    float("nan"),
    1e-320,
    1e308,
    10**400,
    -(2**63) - 1,
    2**31,
    2**32 - 1,
    None,
    True,
    False,
    "",
    "1",
    "nan",
    "\ud800",
    "x" * 5000,
    [],
    {},
    [0],
    {"a": 0},
    [[[[[]]]]],
    [1e999] * 9,
)
INTEGERS = (0, 1, 2, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFFFFFFFFFF, 1 << 40)


def any_bytes(chance, data, other):
    """One change of a file of bytes; other: another good file, to take pieces of."""
    data = bytearray(data)
    at, end = sorted(chance.randrange(len(data) + 1) for _ in range(2))
    end = min(end, at + chance.choice((1, 4, 16, 256)))
    how = chance.randrange(9)
    if how == 0 and data:
        data[at - 1] ^= 1 << chance.randrange(8)
    elif how == 1 and data:
        data[at - 1] = chance.choice((0, 1, 0x20, 0x7F, 0x80, 0xFF, chance.randrange(256)))
    elif how == 2:
        width = chance.choice((2, 4, 8))
        value = chance.choice(INTEGERS) & ((1 << 8 * width) - 1)
        data[at : at + width] = value.to_bytes(width, chance.choice(("little", "big")))
    elif how == 3:
        del data[at:end]
    elif how == 4:
        data[at:at] = data[at:end] * chance.choice((1, 2, 50))
    elif how == 5:
        del data[at:]
    elif how == 6:
        data[at:end] = chance.choice(SPEECH + NUMBERS)
    elif how == 7 and other:
        start = chance.randrange(len(other))
        data[at:end] = other[start : start + chance.choice((4, 64, 1024))]
    else:
        data[at:at] = chance.randbytes(chance.choice((1, 8, 100)))
    return bytes(data)


def text(chance, data, other):
    """One change of a text of numbers, such as a table: a cell, a line, or bytes."""
    how = chance.randrange(4)
    if how == 0:
        return any_bytes(chance, data, other)
    separator = b"\n" if how == 1 else b","
    parts = data.split(separator)
    at = chance.randrange(len(parts))
    if how == 1:
        parts[at : at + 1] = chance.choice(
            ([], parts[at : at + 1] * 2, [b""], [chance.choice(NUMBERS)], [b"," * 40], list(reversed(parts)))
        )
    else:
        parts[at] = chance.choice(NUMBERS + SPEECH)
    return separator.join(parts)


def _places(value):
    """Every (container, key) inside a JSON value."""
    pairs = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in list(pairs):
        yield value, key
        yield from _places(inner)


def tree(chance, data, other):
    """One change of a JSON text: a value, a key, or bytes."""
    if chance.random() < 0.4:
        return any_bytes(chance, data, other)
    try:
        told = json.loads(data)
        places = list(_places(told))
    except (ValueError, RecursionError):
        places = []
    if not places:
        return any_bytes(chance, data, other)
    holder, key = chance.choice(places)
    how = chance.randrange(4)
    if how == 0:
        del holder[key]
    elif how == 1 and isinstance(holder, dict):
        holder[chance.choice(("", "cell", "nx", "\ud800", key + "_"))] = holder.pop(key)
    else:
        holder[key] = chance.choice(VALUES)
    return json.dumps(told).encode("utf-8", "surrogatepass")


def archive(chance, data, other):
    """One change of a zip of arrays: of a member's bytes, of its header, of the members, or of the whole."""
    if chance.random() < 0.3:
        return any_bytes(chance, data, other)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as file:
            members = {name: file.read(name) for name in file.namelist()}
    except Exception:  # damaged before: only bytes can be changed any more
        return any_bytes(chance, data, other)
    if not members:
        return any_bytes(chance, data, other)
    name = chance.choice(sorted(members))
    how = chance.randrange(8)
    if how == 0:
        del members[name]
    elif how == 1:
        members[name] = members[chance.choice(sorted(members))]
    elif how == 2:
        members[chance.choice(("version.npy", "extra.npy", "../x.npy", "time"))] = members[name]
    elif how < 6:  # the header's text: shape, order, type
        member = members[name]
        said = chance.choice((b"(", b")", b"'", b"<f8", b"True", b"False", b"0", b"1", b",", b"shape"))
        instead = chance.choice(
            (
                b"(2147483648, 1000,",
                b"(-1,",
                b"|O",
                b"<U900000000",
                b">f2",
                b"True",
                b"0",
                b"9" * 12,
                b"(" * 200,
                b"",
                b"<M8[s]",
                b"<c16",
            )
        )
        members[name] = member[:128].replace(said, instead, 1)[:128].ljust(128) + member[128:]
    else:
        members[name] = any_bytes(chance, members[name], other)
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED if chance.random() < 0.1 else zipfile.ZIP_STORED) as file:
        for each, content in members.items():
            file.writestr(each, content)
    return out.getvalue()
