#!/usr/bin/env python3
"""What whole runs of gaussmesh cost: CPU time and memory for each triangle, two threads against one.

    scripts/benchmark.py data/fas2.pqr ache.pqr --program build/release/bin/gaussmesh --output tests/bench/results \\
        --reference ./other_mesher --reference-name "what it is"

Every molecule is meshed at every spacing as traced (--raw) and by default, on one thread and on two, and by the
reference program where there is one: any that is called `PROGRAM IN.pqr OUT.off -s SPACING -d D -c C` and uses one
thread. Runs take turns, so that what else the machine does meets all alike. CPU time is user and system time of the
whole process, reading and writing included; ratios and speed-ups are taken within each turn, and the median over the
turns is given. Peak memory is the largest resident set, of one more run on one thread.

The output folder gets benchmark.tsv, benchmark.md and, where Matplotlib is there, benchmark.svg; they grow with each
molecule and spacing that is done.

Exit code 0: done. 1: a program failed. 2: wrong use.
"""

import argparse
import csv
import datetime
import gzip
import os
import pathlib
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

COLUMNS = ["molecule", "spacing_A", "mesh", "triangles", "cpu_s", "cpu_us_per_triangle", "times_reference",
           "peak_bytes_per_triangle", "peak_MB", "two_thread_speed_up"]
REFERENCE, RAW, DEFAULT = "reference", "raw", "default"


def run(command, threads):
    """Runs a program to its end. @return CPU time and wall time (s)"""
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads)}
    begin = time.perf_counter()
    with subprocess.Popen(list(map(str, command)), env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE) as process:
        message = process.stderr.read().decode(errors="replace").strip()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    wall_s = time.perf_counter() - begin
    if process.returncode != 0:
        sys.exit(f"benchmark.py: {' '.join(map(str, command))}: exit {process.returncode}: {message}")
    return usage.ru_utime + usage.ru_stime, wall_s


def peak_memory(command):
    """Largest resident set (bytes), asked for while the program runs: what is told of a process that has ended counts
    this script as well, which it was before it became the program."""
    peak = 0
    with subprocess.Popen(list(map(str, command)), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL) as process:
        while process.poll() is None:
            status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii", errors="replace")
            sizes = [line.split()[1] for line in status.splitlines() if line.startswith("VmHWM:")]
            peak = max([peak, *(int(size) * 1024 for size in sizes)])
            time.sleep(0.0005)
    return peak


def count_triangles(path):
    """From the head of an OFF file."""
    with open(path, encoding="ascii") as file:
        words = " ".join(file.readline() for _ in range(2)).split()
    return int(words[2])


def commands(molecule, spacing, mesh, options):
    """By kind of mesh: the command for a number of threads."""
    surface = ["-d", options.decay, "-c", options.isovalue]
    own = [options.program, molecule, "-o", mesh, "--spacing", spacing, "--d", options.decay, "--c", options.isovalue,
           "--quiet", "--threads"]
    kinds = {RAW: lambda threads: [*own, threads, "--raw"], DEFAULT: lambda threads: [*own, threads]}
    if options.reference:
        kinds = {REFERENCE: lambda _: [options.reference, molecule, mesh, "-s", spacing, *surface], **kinds}
    return kinds


def take_turns(molecule, spacing, folder, options):
    """All runs on one molecule at one spacing.

    @return by kind and threads: a list of (triangles, cpu, wall); and by kind: peak memory
    """
    mesh = folder / "mesh.off"
    results = {}
    for turn in range(options.runs):
        for kind, command in commands(molecule, spacing, mesh, options).items():
            for threads in (1,) if kind == REFERENCE or turn >= options.two_thread_runs else (1, 2):
                cpu_s, wall_s = run(command(threads), threads)
                results.setdefault((kind, threads), []).append((count_triangles(mesh), cpu_s, wall_s))
        print(f"  turn {turn + 1} of {options.runs} done", file=sys.stderr)
    peaks = {kind: peak_memory(command(1)) for kind, command in commands(molecule, spacing, mesh, options).items()}
    return results, peaks


def rows_of(molecule, spacing, results, peaks):
    """A row for each kind of mesh."""
    reference = [cpu / triangles for triangles, cpu, _ in results.get((REFERENCE, 1), [])]
    for kind in (REFERENCE, RAW, DEFAULT):
        turns = results.get((kind, 1))
        if not turns:
            continue
        triangles = turns[0][0]
        each = [cpu / count for count, cpu, _ in turns]
        ratios = [own / other for own, other in zip(each, reference)]
        speed_ups = [one[2] / two[2] for one, two in zip(turns, results.get((kind, 2), []))]
        yield {"molecule": molecule, "spacing_A": spacing, "mesh": kind, "triangles": triangles,
               "cpu_s": f"{statistics.median(cpu for _, cpu, _ in turns):.3f}",
               "cpu_us_per_triangle": f"{statistics.median(each) * 1e6:.3f}",
               "times_reference": f"{statistics.median(ratios):.2f}" if ratios else "",
               "peak_bytes_per_triangle": f"{peaks[kind] / triangles:.0f}", "peak_MB": f"{peaks[kind] / 1e6:.1f}",
               "two_thread_speed_up": f"{statistics.median(speed_ups):.2f}" if speed_ups else ""}


def first_line(command):
    """Of what a command says; nothing if there is no such command."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        return ""


def compiler_of(program):
    """From the cache of the build folder that the program lies in."""
    for folder in program.resolve().parents:
        cache = folder / "CMakeCache.txt"
        if cache.exists():
            entries = dict(line.split("=", 1) for line in cache.read_text(encoding="utf-8").splitlines() if "=" in line)
            values = {name.split(":")[0]: value for name, value in entries.items()}
            version = first_line([values.get("CMAKE_CXX_COMPILER", "c++"), "--version"])
            return f"{version}, {values.get('CMAKE_BUILD_TYPE', '')}"
    return "unknown"


def describe_run(options):
    """What the figures were taken on: pairs of a name and a value."""
    models = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
              if line.startswith("model name")] or [platform.machine()]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"processor": f"{models[0]}, {os.cpu_count()} cores", "memory": f"{memory / 2**30:.1f} GiB",
            "system": platform.platform(), "compiler": compiler_of(options.program),
            "program": first_line([str(options.program), "--version"]), "date": datetime.date.today().isoformat(),
            "surface": f"d = {options.decay:g}, c = {options.isovalue:g}", "turns": str(options.runs),
            **({"reference": options.reference_name or options.reference.name} if options.reference else {})}


def write_table(rows, facts, folder):
    with open(folder / "benchmark.tsv", "w", newline="", encoding="utf-8") as file:
        for name, value in facts.items():
            file.write(f"# {name}: {value}\n")
        writer = csv.DictWriter(file, COLUMNS, delimiter="\t", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    heads = [name.replace("_", " ") for name in COLUMNS]
    lines = [f"- {name}: {value}" for name, value in facts.items()]
    lines += ["", "| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join(str(row[name]) for name in COLUMNS) + " |" for row in rows]
    (folder / "benchmark.md").write_text("# Whole runs of gaussmesh\n\nMade by `scripts/benchmark.py`.\n\n" +
                                         "\n".join(lines) + "\n", encoding="utf-8")


def draw(rows, path):
    """Bars of time and memory for each triangle, by molecule and spacing."""
    import matplotlib  # here, since the table does without
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "gaussmesh"})
    from matplotlib import pyplot
    places = list(dict.fromkeys((row["molecule"], row["spacing_A"]) for row in rows))
    kinds = [kind for kind in (REFERENCE, RAW, DEFAULT) if any(row["mesh"] == kind for row in rows)]
    figure, panels = pyplot.subplots(1, 2, figsize=(10, 3.6))
    for panel, column, title in zip(panels, ("cpu_us_per_triangle", "peak_bytes_per_triangle"),
                                    ("CPU time for each triangle (us)", "peak memory for each triangle (bytes)")):
        for number, kind in enumerate(kinds):
            values = {(row["molecule"], row["spacing_A"]): float(row[column]) for row in rows if row["mesh"] == kind}
            at = [i + (number - (len(kinds) - 1) / 2) * 0.8 / len(kinds) for i in range(len(places))]
            panel.bar(at, [values[place] for place in places], 0.8 / len(kinds), label=kind)
        panel.set_xticks(range(len(places)), [f"{name}\n{spacing:g} A" for name, spacing in places])
        panel.set_title(title, fontsize="medium")
        panel.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})


def parse_arguments():
    parser = argparse.ArgumentParser(description="Measures whole runs of gaussmesh; see the head of this file.")
    parser.add_argument("molecules", nargs="+", type=pathlib.Path, help="PQR files, plain or gzipped")
    parser.add_argument("--program", type=pathlib.Path, default=pathlib.Path("build/release/bin/gaussmesh"))
    parser.add_argument("--reference", type=pathlib.Path, help="program to compare with")
    parser.add_argument("--reference-name", help="what it is, for the table (default: its file name)")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder for the table and the plot")
    parser.add_argument("--spacings", type=float, nargs="+", default=[0.5, 0.3], help="A (default: 0.5 0.3)")
    parser.add_argument("--runs", type=int, default=5, help="turns (default: 5)")
    parser.add_argument("--two-thread-runs", type=int, help="turns in which two threads run too (default: all)")
    parser.add_argument("--decay", type=float, default=0.6, help="1/A^2 (default: 0.6)")
    parser.add_argument("--isovalue", type=float, default=1.7, help="default: 1.7")
    options = parser.parse_args()
    if options.runs < 1:
        parser.error(f"--runs: expected at least 1, got {options.runs}")
    for path in (*options.molecules, options.program, *([options.reference] if options.reference else [])):
        if not path.is_file():
            parser.error(f"{path}: no such file")
    if options.two_thread_runs is None:
        options.two_thread_runs = options.runs
    options.program = options.program.resolve()
    options.reference = options.reference and options.reference.resolve()
    return options


def plain_copy(molecule, folder):
    """The molecule as a plain file, which every program reads."""
    if molecule.suffix != ".gz":
        return molecule.resolve()
    path = folder / molecule.stem
    with gzip.open(molecule) as source, open(path, "wb") as target:
        shutil.copyfileobj(source, target)
    return path


def main():
    options = parse_arguments()
    options.output.mkdir(parents=True, exist_ok=True)
    rows, facts = [], describe_run(options)
    with tempfile.TemporaryDirectory(prefix="gaussmesh_benchmark_") as name:
        folder = pathlib.Path(name)
        for path in options.molecules:
            molecule = plain_copy(path, folder)
            for spacing in options.spacings:
                print(f"{molecule.stem} at {spacing:g} A", file=sys.stderr)
                rows += rows_of(molecule.stem, spacing, *take_turns(molecule, spacing, folder, options))
                write_table(rows, facts, options.output)
    try:
        draw(rows, options.output / "benchmark.svg")
    except ImportError:
        print("benchmark.py: Matplotlib not found: no plot", file=sys.stderr)
    print((options.output / "benchmark.md").read_text(encoding="utf-8"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
