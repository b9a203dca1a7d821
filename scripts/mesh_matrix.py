#!/usr/bin/env python3
"""Meshes a folder of molecules at many (d, c) and spacings and writes one table.

    scripts/mesh_matrix.py data --program build/release/bin/gaussmesh --topology data/reference_topology.tsv \\
        --levels 0.6,1.7 0.4,1.8 --spacings 0.3 0.5 --judge /path/to/judge --jobs 2 --output matrix.tsv

Each row is one run of the program: what it made, how long it took, and a verdict with its reason. With --judge, an
outside program says what the mesh is worth. It is called as

    JUDGE MESH.off MOLECULE.pqr D C TOPOLOGY_GRID LINE_GRID

and prints one JSON object: the counts of DEFECTS below, `components`, `chi`, `vertex_dist_max`,
`normals_against_gradient`, and with a topology grid > 0 `topo_ambiguous` and `topo_match`. Called with `-` for the
mesh it prints the topology of the surface itself (`components_a`, `chi6`): that settles whether there was nothing to
mesh. Without --judge only the program's own report is in the table.

The reference topology (--topology) is a tab-separated table with columns molecule, d, c, components, chi. Beyond it,
all spacings of one molecule and level must give the same components and Euler number.

Exit code 0: every row is ok. 1: some row is not, or the table could not be written. 2: wrong use.
"""

import argparse
import concurrent.futures
import csv
import gzip
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import zlib

# Counts of the judge that must be zero.
DEFECTS = ["nontri", "nm_edges", "boundary_edges", "bad_orient_edges", "nm_vertices", "isolated", "dup_vertices",
           "degenerate", "self_intersections"]
COLUMNS = ["molecule", "atoms", "d", "c", "spacing", "cells", "triangles", "seconds", "cpu_s", "memory_MB", "exit",
           "certified", "components", "chi", "ref_components", "ref_chi", *DEFECTS, "vertex_dist_max",
           "normals_against_gradient", "min_angle_deg", "mean_ratio", "under_30_deg", "verdict", "reason"]
KEY = ["molecule", "d", "c", "spacing"]
EXIT_CANNOT_MESH = 4


class WrongUse(Exception):
    """What is asked for makes no sense."""


def number(text):
    return f"{float(text):g}"


def level(text):
    try:
        decay, isovalue = (number(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected D,C such as 0.6,1.7; got '{text}'") from None
    return decay, isovalue


def molecule_name(path):
    return path.name.removesuffix(".gz").removesuffix(".pqr").removesuffix(".xyzr")


def plain_copy(path, folder):
    """The molecule as the judge can read it: itself, or what is in the gzip file."""
    if path.suffix != ".gz":
        return path
    copy = folder / path.name.removesuffix(".gz")
    with gzip.open(path, "rb") as source, open(copy, "wb") as target:
        shutil.copyfileobj(source, target)
    return copy


def count_atoms(path):
    with gzip.open(path, "rb") if path.suffix == ".gz" else open(path, "rb") as file:
        return sum(line[:6].upper().startswith((b"ATOM", b"HETATM")) for line in file)


def measured_run(command, timeout_s):
    """Runs to the end or the time limit: exit code, standard error, wall and CPU seconds, peak memory in MB."""
    start = time.monotonic()
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - start > timeout_s:
                process.kill()
            time.sleep(0.005)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        text = errors.read().decode("utf-8", "replace").strip()
    wall = time.monotonic() - start
    return process.returncode, text, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6


def ask_judge(options, mesh, molecule, run):
    command = [options.judge, str(mesh), str(molecule), run["d"], run["c"]]
    command += [str(options.topo_h or 0.1)] if mesh == "-" else [str(options.topo_h), str(options.line_h)]
    result = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    try:
        return json.loads(result.stdout)
    except json.JSONDecodeError:
        return {"error": f"judge: exit {result.returncode}, {result.stderr.strip()[-200:] or 'no JSON'}"}


def find_key(value, names):
    """The first of `names` anywhere in a JSON value, outer levels first; '' where there is none."""
    layer = [value]
    while layer:
        for item in layer:
            for name in names:
                if isinstance(item, dict) and name in item and not isinstance(item[name], (dict, list)):
                    return item[name]
        layer = [child for item in layer if isinstance(item, (dict, list))
                 for child in (item.values() if isinstance(item, dict) else item)]
    return ""


def read_report(row, path):
    if not path.is_file():
        return
    report = json.loads(path.read_text(encoding="utf-8"))
    components = report.get("components")
    row["components"] = len(components) if isinstance(components, list) else components
    for column, names in {"certified": ["certified"], "cells": ["cells", "surface_cells"], "chi": ["chi"],
                          "triangles": ["triangles"]}.items():
        row[column] = find_key(report, names)


def wanted_normals(options, run):
    return (run["d"], run["c"]) in options.normals and float(run["spacing"]) <= options.normals_spacing


def judge_mesh(options, row, verdict, reasons):
    """Takes the judge's word into the row, and what is wrong into `reasons`."""
    if "error" in verdict:
        reasons.append(verdict["error"])
        return
    for column in DEFECTS:
        row[column] = verdict.get(column, "")
        if verdict.get(column, 0) != 0:
            reasons.append(f"{column}={verdict[column]}")
    for column in ["components", "chi"]:
        if row[column] not in ("", None) and row[column] != verdict[column]:
            reasons.append(f"report says {column}={row[column]}, judge {verdict[column]}")
        row[column] = verdict[column]
    row["triangles"] = verdict.get("F", row["triangles"])
    row.update(vertex_dist_max=verdict["vertex_dist_max"], min_angle_deg=verdict.get("min_angle", ""),
               normals_against_gradient=verdict["normals_against_gradient"],
               mean_ratio=verdict.get("mean_ratio", ""), under_30_deg=verdict.get("tri_lt30", ""))
    if not verdict["vertex_dist_max"] < options.max_distance:
        reasons.append(f"vertex_dist_max={verdict['vertex_dist_max']:g}")
    if wanted_normals(options, row) and verdict["normals_against_gradient"] != 0:
        reasons.append(f"normals_against_gradient={verdict['normals_against_gradient']}")
    if verdict.get("topo_match") is False and verdict.get("topo_ambiguous") is False and row["ref_chi"] == "":
        reasons.append(f"components or chi unlike the digital picture at {options.topo_h:g} A")


def is_empty_surface(options, molecule, run):
    truth = ask_judge(options, "-", molecule, run)
    return truth.get("components_a") == 0


def run_one(options, reference, path, run):
    row = dict.fromkeys(COLUMNS, "")
    row.update(run, atoms=count_atoms(path))
    row["ref_components"], row["ref_chi"] = reference.get((run["molecule"], run["d"], run["c"]), ("", ""))
    reasons = []
    with tempfile.TemporaryDirectory(prefix="mesh_matrix_", dir=options.scratch) as scratch:
        folder = pathlib.Path(scratch)
        mesh, report = folder / "mesh.off", folder / "report.json"
        code, errors, wall, cpu, memory = measured_run(
            [options.program, str(path), "--d", run["d"], "--c", run["c"], "--spacing", run["spacing"],
             "--threads", str(options.threads), "--report", str(report), "-o", str(mesh)], options.timeout)
        row.update(exit=code, seconds=f"{wall:.2f}", cpu_s=f"{cpu:.2f}", memory_MB=f"{memory:.0f}")
        read_report(row, report)
        if code == EXIT_CANNOT_MESH and options.judge and is_empty_surface(options, plain_copy(path, folder), run):
            row.update(components=0, chi=0)
        elif code != 0 or not mesh.is_file():
            reasons.append(f"exit {code}: {' '.join(errors.split())[-300:]}")
        elif options.judge:
            judge_mesh(options, row, ask_judge(options, mesh, plain_copy(path, folder), run), reasons)
        if code == 0 and mesh.is_file() and row["certified"] is not True:
            reasons.append("not certified")
        if code == 0 and options.keep:
            shutil.copyfile(mesh, options.keep / f"{'_'.join(run[k] for k in KEY)}.off")
    for column in ["components", "chi"]:
        expected = row[f"ref_{column}"]
        if row[column] not in ("", None) and expected != "" and str(row[column]) != expected:
            reasons.append(f"{column}={row[column]}, expected {expected}")
    row.update(verdict="FAIL" if reasons else "ok", reason="; ".join(reasons))
    return {column: str(value) for column, value in row.items()}


def compare_spacings(rows):
    """The exact topology does not know the spacing: rows of one molecule and level that differ are wrong."""
    groups = {}
    for row in rows:
        if row["components"] not in ("", "None"):
            groups.setdefault(tuple(row[k] for k in KEY[:3]), []).append(row)
    for group in groups.values():
        found = {(row["components"], row["chi"]) for row in group}
        if len(found) > 1:
            for row in group:
                row["verdict"] = "FAIL"
                note = f"spacings differ: {len(found)} different (components, chi)"
                if note not in row["reason"]:
                    row["reason"] = "; ".join(filter(None, [row["reason"], note]))


def read_table(path, columns):
    """The rows of a tab-separated table that has these columns."""
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file, delimiter="\t")
        missing = [column for column in columns if column not in (reader.fieldnames or [])]
        if missing:
            raise WrongUse(f"{path}: expected a table with the columns {', '.join(columns)}; {missing[0]} is missing")
        return list(reader)


def read_reference(path):
    if path is None:
        return {}
    return {(r["molecule"], number(r["d"]), number(r["c"])): (r["components"], r["chi"])
            for r in read_table(path, ["molecule", "d", "c", "components", "chi"]) if r.get("agree", "yes") == "yes"}


def write_table(path, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, delimiter="\t", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def parse_options():
    parser = argparse.ArgumentParser(description="Meshes a folder of molecules at many (d, c) and spacings.",
                                     epilog="See the head of this file for the judge and the table.")
    parser.add_argument("molecules", nargs="+", type=pathlib.Path, help="PQR files (also .gz), or folders of them")
    parser.add_argument("--program", required=True, help="the gaussmesh program")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("matrix.tsv"), help="the table to write")
    parser.add_argument("--levels", nargs="+", type=level, metavar="D,C", help="pairs of decay and isovalue",
                        default=[level(t) for t in ["0.6,1.7", "0.4,1.8", "0.4,1.2", "1,1", "2,1"]])
    parser.add_argument("--spacings", nargs="+", type=number, default=["0.5"], metavar="A")
    parser.add_argument("--topology", type=pathlib.Path, help="reference topology table")
    parser.add_argument("--judge", help="outside program that judges each mesh")
    parser.add_argument("--topo-h", type=float, default=0.0, help="grid of the judge's digital picture (0: none)")
    parser.add_argument("--line-h", type=float, default=0.0, help="distance of the judge's test lines (0: none)")
    parser.add_argument("--max-distance", type=float, default=1e-6, help="of a vertex from the surface, A")
    parser.add_argument("--normals", nargs="*", type=level, metavar="D,C", help="levels where no face may turn "
                        "against the gradient", default=[level(t) for t in ["0.6,1.7", "0.4,1.8", "0.4,1.2"]])
    parser.add_argument("--normals-spacing", type=float, default=0.5, help="and the largest spacing for that")
    parser.add_argument("--max-atoms", type=int, help="leave out larger molecules")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--threads", type=int, default=1, help="threads of each run")
    parser.add_argument("--timeout", type=float, default=3600.0, help="seconds for one run")
    parser.add_argument("--resume", action="store_true", help="keep the rows that the table already has")
    parser.add_argument("--keep", type=pathlib.Path, help="folder to keep the meshes in")
    parser.add_argument("--scratch", help="folder for temporary files")
    options = parser.parse_args()
    if options.jobs < 1 or options.threads < 0 or not options.timeout > 0:
        parser.error("--jobs: expected 1 or more, --threads: 0 or more, --timeout: more than 0")
    for option in ["program", "judge"]:
        program = getattr(options, option)
        if program and not shutil.which(program):
            parser.error(f"--{option}: expected a program to run, got '{program}'")
    return options


def find_molecules(options):
    files = []
    for path in options.molecules:
        files += sorted([*path.glob("*.pqr"), *path.glob("*.pqr.gz")]) if path.is_dir() else [path]
    for path in files:
        if not path.is_file():
            raise WrongUse(f"expected a file or a folder, got '{path}'")
    if not files:
        raise WrongUse("expected molecules, got none")
    sized = sorted((count_atoms(path), path) for path in files)
    return [path for atoms, path in sized if options.max_atoms is None or atoms <= options.max_atoms]


def plan_runs(options, rows):
    """What is to be run beyond the rows that there are."""
    done = {tuple(row[k] for k in KEY) for row in rows}
    plan = []
    for path in find_molecules(options):
        for decay, isovalue in options.levels:
            for spacing in options.spacings:
                run = {"molecule": molecule_name(path), "d": decay, "c": isovalue, "spacing": spacing}
                if tuple(run[k] for k in KEY) not in done:
                    plan.append((path, run))
    return plan


def prepare(options):
    """The reference, the rows that the table keeps, and the runs to come. What is wrong is told before they begin."""
    rows = []
    if options.resume and options.output.is_file():
        rows = read_table(options.output, COLUMNS)
    reference, plan = read_reference(options.topology), plan_runs(options, rows)
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    tempfile.TemporaryDirectory(dir=options.scratch).cleanup()
    write_table(options.output, rows)
    return reference, rows, plan


def make_table(options, reference, rows, plan):
    """Runs all, and writes the table anew after each; returns how many rows are not ok."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=options.jobs) as pool:
        futures = [pool.submit(run_one, options, reference, path, run) for path, run in plan]
        for future in concurrent.futures.as_completed(futures):
            row = future.result()
            rows.append(row)
            write_table(options.output, rows)
            print(*(row[k] for k in [*KEY, "triangles", "seconds", "memory_MB", "verdict", "reason"]), sep="\t",
                  flush=True)
    compare_spacings(rows)
    rows.sort(key=lambda r: (int(r["atoms"]), r["molecule"], *(float(r[k]) for k in KEY[1:])))
    write_table(options.output, rows)
    bad = sum(row["verdict"] != "ok" for row in rows)
    print(f"{len(rows) - bad} ok, {bad} FAIL; table in {options.output}")
    return bad


def main():
    options = parse_options()
    try:
        prepared = prepare(options)
    except (WrongUse, OSError, EOFError, zlib.error, ValueError) as error:
        print(f"mesh_matrix.py: {error}", file=sys.stderr)
        return 2
    try:
        return 1 if make_table(options, *prepared) else 0
    except OSError as error:
        print(f"mesh_matrix.py: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
