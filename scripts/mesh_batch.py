#!/usr/bin/env python3
# Built and installed as gaussmesh-batch, beside gaussmesh.
"""Meshes many molecules: folders or a list of PQR, XYZR, PDB or mmCIF files, plain or gzipped.

    %(prog)s molecules/ --output meshes --jobs 2 -- --preset ses-area

Each molecule becomes meshes/NAME.off and meshes/NAME.json, its report; they appear when both are whole. Options
behind `--` go to gaussmesh as they are. PDB and mmCIF files go through pdb2pqr, which adds hydrogens and radii
(--force-field), or get radii by name (--radii), from a file (--radii-file), or both. A molecule that fails does not
stop the others.

Of files that would become the same mesh, such as mol.pqr and the mol.pdb that it was made from, PQR is taken, else
XYZR, and the others are said to be skipped. Two of one kind, as mol.pqr in two folders, fail: nothing tells which.

A mesh that is there is kept, and said to be, if it was made from the same: what is in the molecule's file and in those
that options name (--radii-file, --config), the options, and the version of gaussmesh; and if its files have the sizes
they were written with. Times of files do not count. --again makes all anew. After Ctrl-C no further molecule is begun.
At the end, meshes/table.csv has a row for each molecule that there is a mesh of, and meshes/failures.tsv each that
failed, with its reason.

Exit code 0: all molecules have meshes. 1: some have not, or there is no table of them. 2: wrong use.
"""

import argparse
import concurrent.futures
import csv
import gzip
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

OWN_RADII = [".pqr", ".xyzr", ".xyzrn", ".xyzrq"]
NEED_RADII = {".pdb", ".ent", ".pdbqt", ".cif", ".mmcif"}
SUFFIXES = NEED_RADII.union(OWN_RADII)
# Options of gaussmesh that are given by this script, and what has them here.
OWN_OPTIONS = {"-o": "--extension", "--output": "--extension", "--report": "--output", "--threads": "--threads",
               "--radii": "--radii", "--radii-file": "--radii-file"}
COLUMNS = ["molecule", "atoms", "triangles", "vertices", "area_A2", "volume_A3", "components", "cavities", "genus",
           "min_angle_deg", "mean_min_angle_deg", "mean_edge_ratio", "time_s", "verdict"]


class WrongUse(Exception):
    """What is asked for makes no sense."""


class Failed(Exception):
    """Why a molecule has no mesh."""


def unpacked(path):
    """The name of the file without a .gz behind it."""
    return pathlib.Path(path.stem if path.suffix.lower() == ".gz" else path.name)


def kind(path):
    """The extension that tells the format."""
    return unpacked(path).suffix.lower()


def name_of(path):
    return unpacked(path).stem


def most_wanted(paths):
    """Of files that would share a mesh the one with radii in it, PQR before XYZR; where two are alike, both."""
    ranks = [OWN_RADII.index(kind(path)) if kind(path) in OWN_RADII else len(OWN_RADII) for path in paths]
    return [path for path, rank in zip(paths, ranks) if rank == min(ranks)]


def find_molecules(options):
    """All molecules by name, and what is left aside, by the same: files of a name would share a mesh. Where several are
    alike nothing tells which of them is meant, and all of them are there."""
    files = []
    for item in options.molecules:
        files += sorted(p for p in item.iterdir() if kind(p) in SUFFIXES) if item.is_dir() else [item]
    if options.list:
        lines = map(str.strip, options.list.read_text(encoding="utf-8").splitlines())
        files += [pathlib.Path(line) for line in lines if line and not line.startswith("#")]
    found = {}
    for path in files:
        found.setdefault(name_of(path), {}).setdefault(path.resolve(), path)
    molecules = {name: most_wanted(list(paths.values())) for name, paths in found.items()}
    aside = {name: [path for path in paths.values() if path not in molecules[name]] for name, paths in found.items()}
    return molecules, aside


def tell_of_those_aside(molecules, aside):
    for name, paths in aside.items():
        taken = " and ".join(map(str, molecules[name]))
        for path in paths:
            print(f"{name}: skipped {path}, which would become the mesh of {taken}", file=sys.stderr)


def needs_pdb2pqr(path, options):
    return kind(path) in NEED_RADII and not options.radii and not options.radii_file


def require_programs(molecules, options):
    """What is missing is told once, and not for each molecule; returns the version of gaussmesh."""
    wanted = {options.program}
    if any(needs_pdb2pqr(path, options) for paths in molecules.values() for path in paths if len(paths) == 1):
        wanted.add(options.pdb2pqr)
    for program in sorted(wanted):
        if not shutil.which(program):
            raise WrongUse(f"expected a program to run, got '{program}'; --program and --pdb2pqr tell where they are")
    try:
        return run([options.program, "--version"], options).strip()
    except Failed as error:
        raise WrongUse(f"--program: expected gaussmesh, got '{options.program}': {error}") from None


def require_files(options):
    """What cannot be read or written is found out before the work begins."""
    for option, path in [("--radii-file", options.radii_file), *(("--config", path) for path in options.configs)]:
        if path and not path.is_file():
            raise WrongUse(f"{option}: expected a file, got '{path}'")
    options.output.mkdir(parents=True, exist_ok=True)
    folder_to_work_in(options).cleanup()
    for table in tables_of(options):
        if table.exists():
            open(table, "r+", encoding="utf-8").close()


def reason_in(lines):
    """The line that says why. Behind its own errors pdb2pqr raises one without a text, which stands last."""
    for pattern in [r"gaussmesh: (?!warning)", r"\w*(Error|Exception): .", r"(CRITICAL|ERROR):."]:
        said = [line for line in lines if re.match(pattern, line)]
        if said:
            return said[-1]
    return lines[-1]


def run(command, options):
    """Runs a program; returns what it said."""
    name = pathlib.Path(command[0]).name
    try:
        result = subprocess.run(list(map(str, command)), capture_output=True, text=True, errors="replace",
                                stdin=subprocess.DEVNULL, timeout=options.timeout, check=False)
    except subprocess.TimeoutExpired:
        raise Failed(f"{name}: more than {options.timeout:g} s") from None
    if result.returncode == 0:
        return result.stdout
    lines = (result.stderr.strip() or result.stdout.strip() or "no message").splitlines()
    raise Failed(f"{name}: exit {result.returncode}: {reason_in(lines).removeprefix('gaussmesh: ')}")


def hash_of(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def origin_of(path, options):
    """All that decides what the mesh of a molecule is, as far as it is known before there is one."""
    files = [path, *filter(None, [options.radii_file]), *options.configs]
    return {"version": options.version, "format": kind(path), "files": [hash_of(file) for file in files],
            "options": [options.extension, options.radii, str(options.radii_file or ""), options.force_field,
                        options.rest]}


def write_stamp(stamp, origin, report, files):
    """What a later run needs to know whether the mesh may be kept."""
    radii_file = json.loads(report.read_text(encoding="utf-8"))["input"]["radii_file"]  # perhaps named in --config
    stamp.write_text(json.dumps({"origin": origin, "read": {radii_file: hash_of(radii_file)} if radii_file else {},
                                 "written": {file.name: file.stat().st_size for file in files}}), encoding="utf-8")


def kept_row(name, stamp, origin, options):
    """The row of the mesh that is there, if it is as it was written and would be made from the same; else nothing."""
    try:
        known = json.loads(stamp.read_text(encoding="utf-8"))
        if (known["origin"] == origin and all(hash_of(file) == value for file, value in known["read"].items()) and
                all((options.output / file).stat().st_size == size for file, size in known["written"].items())):
            return row_of(name, options.output / f"{name}.json")
    except (OSError, ValueError, LookupError, TypeError):
        pass  # whatever is missing or not readable is made again
    return None


def add_radii(path, folder, options):
    """A file that has hydrogens and radii, by pdb2pqr."""
    source, made = path, folder / f"{name_of(path)}.pqr"
    if unpacked(path).name != path.name:  # pdb2pqr reads nothing gzipped
        source = folder / unpacked(path)
        try:
            source.write_bytes(gzip.decompress(path.read_bytes()))
        except (OSError, EOFError, zlib.error) as error:
            raise Failed(f"{path}: {error}") from None
    run([options.pdb2pqr, "--ff", options.force_field, "--drop-water", source, made], options)
    return made


def folder_to_work_in(options):
    """On the disk of the meshes, so that they can be moved to their place at once."""
    return tempfile.TemporaryDirectory(prefix=".mesh_batch_", dir=options.output)


def make_mesh(paths, options):
    """Makes the mesh of one molecule, or keeps the one that is there; returns its row and which of the two."""
    path, *others = paths
    name = name_of(path)
    if others:
        raise Failed(f"expected one molecule for a mesh, got {' and '.join(map(str, paths))}")
    if not path.is_file():
        raise Failed("no such file")
    stamp, origin = options.output / f".{name}.stamp", origin_of(path, options)
    row = None if options.again else kept_row(name, stamp, origin, options)
    if row:
        return row, "kept"
    with tempfile.TemporaryDirectory(prefix="mesh_batch_") as folder, folder_to_work_in(options) as new:
        source, radii, new = path, [], pathlib.Path(new)
        if needs_pdb2pqr(path, options):
            source = add_radii(path, pathlib.Path(folder), options)
        elif kind(path) in NEED_RADII:
            given = {"--radii": options.radii, "--radii-file": options.radii_file}
            radii = [word for option, value in given.items() if value for word in (option, value)]
        report = new / f"{name}.json"
        try:
            run([options.program, source, *radii, *options.rest, "--threads", options.threads, "--quiet",
                 "-o", new / f"{name}{options.extension}", "--report", report], options)
        except Failed as error:  # nobody else knows the folder
            raise Failed(str(error).replace(str(new), str(options.output))) from None
        files = sorted(new.iterdir())  # of a mesh there may be several, by its format and --cavities
        if report not in files or len(files) < 2:
            raise Failed(f"{options.program}: exit 0, but it wrote no mesh with a report")
        try:
            row = row_of(name, report)
            write_stamp(new / stamp.name, origin, report, files)
        except (ValueError, LookupError, TypeError):
            raise Failed(f"{options.program}: exit 0, but its report is not one of gaussmesh") from None
        stamp.unlink(missing_ok=True)
        for file in [*files, new / stamp.name]:
            file.replace(options.output / file.name)
    return row, "made"


def row_of(name, report):
    said = json.loads(report.read_text(encoding="utf-8"))
    components = said["components"]
    return {"molecule": name, "atoms": said["atoms"], "triangles": said["triangles"], "vertices": said["vertices"],
            "area_A2": said["area_A2"], "volume_A3": said["volume_A3"],
            "components": sum(c["kind"] == "outside" for c in components),
            "cavities": sum(c["kind"] == "cavity" for c in components), "genus": sum(c["genus"] for c in components),
            **{key: said["quality"][key] for key in ("min_angle_deg", "mean_min_angle_deg", "mean_edge_ratio")},
            "time_s": round(sum(stage["time_s"] for stage in said["stages"]), 3),
            "verdict": "certified" if said["certified"] else "not certified"}


def tables_of(options):
    return options.output / "table.csv", options.output / "failures.tsv"


def write_tables(molecules, rows, failures, options):
    table, reasons = tables_of(options)
    with open(table, "w", newline="", encoding="utf-8", errors="surrogateescape") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows[name] for name in molecules if name in rows)
    lines = [f"{molecules[name][0]}\t{reason}\n" for name, reason in failures.items()]
    reasons.write_text("".join(lines), encoding="utf-8", errors="surrogateescape")


def default_program():
    """The one that this script is installed with, or that in the PATH."""
    beside = pathlib.Path(__file__).resolve().parent / "gaussmesh"
    return str(beside) if beside.is_file() else "gaussmesh"


def configs_in(words):
    """The files that --config names, as one word or two."""
    return [pathlib.Path(following if word == "--config" else word.removeprefix("--config="))
            for word, following in zip(words, [*words[1:], ""]) if re.match("--config(=|$)", word)]


def parse_arguments(arguments):
    words, rest = (arguments[:arguments.index("--")], arguments[arguments.index("--") + 1:]) if "--" in arguments \
        else (arguments, [])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     usage="%(prog)s [options] MOLECULES... --output FOLDER [-- OPTIONS OF gaussmesh]")
    parser.add_argument("molecules", nargs="*", type=pathlib.Path, help="files, or folders of them")
    parser.add_argument("--list", type=pathlib.Path, help="file with the path of a molecule on each line")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder for the meshes")
    parser.add_argument("--extension", default=".off", help="of the meshes, which means their format (default: .off)")
    parser.add_argument("--program", default=default_program(),
                        help="where gaussmesh is (default: beside this script, or in the PATH)")
    parser.add_argument("--pdb2pqr", default="pdb2pqr", help="the program of that name")
    parser.add_argument("--force-field", default="AMBER", help="for pdb2pqr (default: AMBER)")
    parser.add_argument("--radii", default="", help="bondi, amber or charmm: instead of pdb2pqr")
    parser.add_argument("--radii-file", type=pathlib.Path, help="radii of your own, with --radii or instead of pdb2pqr")
    parser.add_argument("--jobs", type=int, default=1, help="molecules at a time (default: 1)")
    parser.add_argument("--threads", type=int, default=1, help="threads for each of them (default: 1)")
    parser.add_argument("--timeout", type=float, default=3600.0, help="seconds for each program (default: 3600)")
    parser.add_argument("--again", action="store_true", help="make all meshes anew")
    options = parser.parse_args(words)
    if options.jobs < 1 or options.threads < 0 or not options.timeout > 0:
        parser.error("--jobs: expected 1 or more, --threads: 0 or more, --timeout: more than 0")
    for word in rest:
        here = OWN_OPTIONS.get("-o" if re.match("-o.", word) else word.split("=", 1)[0])
        if here:
            parser.error(f"expected {here} before --, got '{word}' behind it")
    options.extension = "." + options.extension.removeprefix(".")
    options.rest, options.configs = rest, configs_in(rest)
    return options


def make_all(molecules, options):
    """All rows, why molecules have no mesh, and how many were kept. Those not begun when told to stop have failed."""
    failures, rows, kept = {name: "not reached" for name in molecules}, {}, 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        pending = {pool.submit(make_mesh, paths, options): name for name, paths in molecules.items()}
        try:
            for number, future in enumerate(concurrent.futures.as_completed(pending), start=1):
                name = pending[future]
                try:
                    rows[name], said = future.result()
                    del failures[name]
                    kept += said == "kept"
                except (Failed, OSError) as error:
                    failures[name] = said = str(error)
                print(f"[{number}/{len(molecules)}] {name}: {said}", file=sys.stderr)
        except KeyboardInterrupt:
            print("stopped; what is under way comes to its end", file=sys.stderr)
            pool.shutdown(wait=False, cancel_futures=True)
    return rows, dict(sorted(failures.items())), kept


def main():
    options = parse_arguments(sys.argv[1:])
    script = pathlib.Path(sys.argv[0]).name
    try:
        molecules, aside = find_molecules(options)
        if not molecules:
            raise WrongUse("expected molecules, got none")
        options.version = require_programs(molecules, options)
        require_files(options)
    except (WrongUse, OSError, UnicodeDecodeError) as error:
        print(f"{script}: {error}", file=sys.stderr)
        return 2
    tell_of_those_aside(molecules, aside)
    rows, failures, kept = make_all(molecules, options)
    said = f"{len(rows)} of {len(molecules)} molecules meshed, {len(rows) - kept} now and {kept} before"
    try:
        write_tables(molecules, rows, failures, options)
    except OSError as error:
        print(f"{said}\n{script}: {error}", file=sys.stderr)
        return 1
    table, reasons = tables_of(options)
    print(f"{said}; {table}" + (f", {reasons}" if failures else ""))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
