"""results.py - timings of this machine: kept, and compared with those that were kept.

    python tests/bench/results.py keep ROWS...      write results/<machine>.csv
    python tests/bench/results.py compare ROWS...   each timing against it; code 1 if one is more than 5 % slower

ROWS are files that the benchmarks wrote (`bench,what,seconds`); of several runs the least counts. scripts/bench --keep
and --compare call this. results/README.md tells what the columns are.
"""

import argparse
import csv
import pathlib
import platform
import re
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
SLOWER = 1.05  # what is slower than this by what was kept is told
COLUMNS = ("bench", "what", "microseconds")


def machine():
    """This processor's name and number of cores as a file name: amd-epyc-2."""
    name, cores = platform.processor() or platform.machine(), 0
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                name, cores = line.split(":", 1)[1], cores + 1
    except OSError:
        pass
    slug = re.sub(r"\((r|tm)\)|\bcpu\b|@.*", " ", name.lower())
    return "-".join(re.findall(r"[a-z0-9.]+", slug) + ([str(cores)] if cores else []))


def least(files):
    """{(bench, what): seconds} of files of rows, the least of each."""
    found = {}
    for file in files:
        for bench, what, seconds in csv.reader(pathlib.Path(file).read_text(encoding="utf-8").splitlines()):
            found[bench, what] = min(float(seconds), found.get((bench, what), float("inf")))
    return found


def kept(path):
    with open(path, encoding="utf-8", newline="") as file:
        return {(row["bench"], row["what"]): 1e-6 * float(row["microseconds"]) for row in csv.DictReader(file)}


def keep(path, timings):
    """Write timings; those of benchmarks that were not run stay as they were."""
    ran = {bench for bench, _ in timings}
    old = {name: each for name, each in kept(path).items() if name[0] not in ran} if path.exists() else {}
    path.parent.mkdir(exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(COLUMNS)
        rows.writerows((*name, f"{float(f'{1e6 * each:.4g}'):g}") for name, each in sorted({**old, **timings}.items()))


def compare(path, timings):
    """Print a ratio for each timing; the number that is more than SLOWER."""
    known, slow, ratios = kept(path), 0, {}
    for name, each in sorted(timings.items()):
        if name not in known:
            continue
        ratio = each / known[name]
        ratios.setdefault(name[0], []).append(ratio)
        slow += ratio > SLOWER
        print(
            f"{name[0]:8s} {name[1]:48s} {1e6 * known[name]:12.4g} us {1e6 * each:12.4g} us  {ratio:5.2f}"
            f"{'  slower' if ratio > SLOWER else ''}"
        )
    for bench, each in ratios.items():
        print(f"{bench}: median {statistics.median(each):.3f} of what was kept")
    return slow


def main():
    parser = argparse.ArgumentParser(prog="results.py", description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("keep", "compare"))
    parser.add_argument("rows", nargs="+")
    parser.add_argument(
        "--to",
        type=pathlib.Path,
        default=HERE / "results" / f"{machine()}.csv",
        help="the kept file; default: that of this machine",
    )
    chosen = parser.parse_args()
    timings = least(chosen.rows)
    if chosen.what == "keep":
        keep(chosen.to, timings)
        print(f"{len(timings)} timings are kept in {chosen.to.name}")
        return 0
    if not chosen.to.exists():
        print(
            f"No timings of this machine are kept ({chosen.to.name}): run scripts/bench --keep first.", file=sys.stderr
        )
        return 2
    slow = compare(chosen.to, timings)
    print(f"{slow} of {len(timings)} timings are more than {100 * SLOWER - 100:.0f} % slower than those kept")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main())
