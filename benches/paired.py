"""Two builds of one group of benches, in turn: prints the ratio of their times.

    python3 benches/paired.py OLD NEW [--filter NAME] [--rounds 3] [--core 1] [--json FILE]

OLD and NEW are programs that `cargo bench --no-run` has built, or folders with one for each of several groups. A round runs
a whole group in both programs, on one core; the order changes from round to round. The least time of all rounds counts. A
bench that seems slower by more than a twentieth then runs again by itself, in turn in both programs, up to three times as many
rounds: neighbours and the clock of a shared machine change within minutes. Benches that only one program has are counted and
left out.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile


def programs(path):
    """The program of each group; the newest where a folder has several."""
    path = pathlib.Path(path)
    files = sorted(path.iterdir(), key=lambda file: file.stat().st_mtime) if path.is_dir() else [path]
    named = [(re.sub(r"-[0-9a-f]{16}$", "", file.name), file) for file in files if os.access(file, os.X_OK)]
    return {name: file for name, file in named if file.is_file() and file.suffix == ""}


def nanoseconds(program, core, arguments):
    """The median of one iteration of each bench that runs."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["taskset", "--cpu-list", str(core), program, "--bench", "--noplot", *arguments],
                       check=True, capture_output=True,
                       env={**os.environ, "CRITERION_HOME": folder, "PIOLA_BENCH_NOTES": folder + "/notes"})
        found = {}
        for file in pathlib.Path(folder).rglob("new/estimates.json"):
            bench = json.loads(file.with_name("benchmark.json").read_text())["full_id"]
            found[bench] = json.loads(file.read_text())["median"]["point_estimate"]
        return found


def rounds(rows, both, arguments, options):
    for turn in range(options.rounds):
        for side in ("old", "new") if turn % 2 == 0 else ("new", "old"):
            for bench, time in nanoseconds(both[side], options.core, arguments).items():
                rows.setdefault(bench, {"old": [], "new": []})[side].append(time)


def ratio(times):
    return min(times["new"]) / min(times["old"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--filter", default="", help="a regular expression for `group/name`")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--core", type=int, default=(os.cpu_count() or 1) - 1)
    parser.add_argument("--json", type=pathlib.Path, help="also write all times here")
    options = parser.parse_args()
    old, new = programs(options.old), programs(options.new)
    print("| group | benches | least | median | largest | above 1.05 |\n|---|---|---|---|---|---|")
    written = {}
    for group in sorted(set(old) & set(new)):
        both, rows = {"old": old[group], "new": new[group]}, {}
        rounds(rows, both, [options.filter], options)
        alone = [bench for bench, times in rows.items() if not (times["old"] and times["new"])]
        for bench in alone:
            del rows[bench]
        for bench, times in rows.items():
            for _ in range(3):
                if 1.05 < ratio(times):
                    rounds(rows, both, ["--exact", bench], options)
        ratios = sorted(map(ratio, rows.values()))
        if ratios:
            slower = [bench for bench in rows if 1.05 < ratio(rows[bench])]
            print(f"| {group} | {len(ratios)} | {ratios[0]:.2f} | {ratios[len(ratios) // 2]:.2f} | {ratios[-1]:.2f} "
                  f"| {len(slower)} |", flush=True)
            for bench in slower:
                print(f"    {ratio(rows[bench]):.3f} {bench}", flush=True)
        if alone:
            print(f"    in one program only: {len(alone)}", flush=True)
        written |= rows
        if options.json:
            options.json.write_text(json.dumps(written, indent=1) + "\n")


if __name__ == "__main__":
    main()
