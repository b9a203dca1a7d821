#!/usr/bin/env python3
"""Meshes many molecules: folders or a list of PQR, XYZR, PDB or mmCIF files, plain or gzipped.

    scripts/mesh_batch.py molecules/ --output meshes --program build/release/bin/gaussmesh --jobs 2 -- --preset ses-area

Each molecule becomes meshes/NAME.off and meshes/NAME.json, its report; both appear together or not at all. Options
behind `--` go to gaussmesh as they are. PDB and mmCIF files go through pdb2pqr, which adds hydrogens and radii
(--force-field), or get radii by name (--radii), from a file (--radii-file), or both. A molecule that fails does not
stop the others.

A second run makes only what is missing, older than its molecule or the file of radii, or was made with other options;
--again makes all anew. After Ctrl-C no further molecule is begun. At the end, meshes/table.csv has a row for each
molecule that there is a mesh of, and meshes/failures.tsv each that failed, with its reason.

Exit code 0: all molecules have meshes. 1: some have not. 2: wrong use.
"""

import argparse
import concurrent.futures
import csv
import gzip
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

SUFFIXES = {".pqr", ".xyzr", ".pdb", ".ent", ".cif", ".mmcif"}
NEED_RADII = {".pdb", ".ent", ".cif", ".mmcif"}
# Options of gaussmesh that are given by this script, and what has them here.
OWN_OPTIONS = {"-o": "--extension", "--output": "--extension", "--report": "--output", "--threads": "--threads",
               "--radii": "--radii", "--radii-file": "--radii-file"}
COLUMNS = ["molecule", "atoms", "triangles", "vertices", "area_A2", "volume_A3", "components", "cavities", "genus",
           "min_angle_deg", "mean_min_angle_deg", "mean_edge_ratio", "time_s", "verdict"]


class WrongUse(Exception):
    """What is asked for makes no sense."""


def unpacked(path):
    """The name of the file without a .gz behind it."""
    return pathlib.Path(path.stem if path.suffix.lower() == ".gz" else path.name)


def kind(path):
    """The extension that tells the format."""
    return unpacked(path).suffix.lower()


def name_of(path):
    return unpacked(path).stem


def find_molecules(options):
    """All molecules by name; two of one name are an error, since they would share a mesh."""
    files = []
    for item in options.molecules:
        files += sorted(p for p in item.iterdir() if kind(p) in SUFFIXES) if item.is_dir() else [item]
    if options.list:
        lines = map(str.strip, options.list.read_text(encoding="utf-8").splitlines())
        files += [pathlib.Path(line) for line in lines if line and not line.startswith("#")]
    molecules = {}
    for path in files:
        other = molecules.setdefault(name_of(path), path)
        if other.resolve() != path.resolve():
            raise WrongUse(f"expected different names, got {other} and {path}")
    return molecules


def needs_pdb2pqr(path, options):
    return kind(path) in NEED_RADII and not options.radii and not options.radii_file


def require_programs(molecules, options):
    """What is missing is told once, and not for each molecule."""
    wanted = {options.program}
    if any(needs_pdb2pqr(path, options) for path in molecules.values()):
        wanted.add(options.pdb2pqr)
    for program in sorted(wanted):
        if not shutil.which(program):
            raise WrongUse(f"expected a program to run, got '{program}'; --program and --pdb2pqr tell where they are")
    if options.radii_file and not options.radii_file.is_file():
        raise WrongUse(f"--radii-file: expected a file, got '{options.radii_file}'")


def reason_in(lines):
    """The line that says why. Behind its own errors pdb2pqr raises one without a text, which stands last."""
    for pattern in [r"gaussmesh: (?!warning)", r"\w*(Error|Exception): .", r"(CRITICAL|ERROR):."]:
        said = [line for line in lines if re.match(pattern, line)]
        if said:
            return said[-1]
    return lines[-1]


def run(command, options):
    """Runs a program; returns why it failed, or nothing."""
    try:
        result = subprocess.run(list(map(str, command)), capture_output=True, text=True, stdin=subprocess.DEVNULL,
                                timeout=options.timeout, check=False)
    except subprocess.TimeoutExpired:
        return f"{pathlib.Path(command[0]).name}: more than {options.timeout:g} s"
    except OSError as error:
        return str(error)
    if result.returncode == 0:
        return ""
    lines = (result.stderr.strip() or result.stdout.strip() or "no message").splitlines()
    said = reason_in(lines).removeprefix("gaussmesh: ")
    return f"{pathlib.Path(command[0]).name}: exit {result.returncode}: {said}"


def meshes_of(name, options):
    """The files that tell whether a molecule has its mesh; of separate surfaces, the first one."""
    stem = f"{name}_1" if "separate" in options.rest or "--cavities=separate" in options.rest else name
    pair, packed = {".vert", ".face"}, ".gz" if options.extension.endswith(".gz") else ""
    extension = options.extension.removesuffix(packed)
    return [options.output / f"{stem}{end}{packed}" for end in (pair if extension in pair else {extension})]


def is_done(path, meshes, report, stamp, options):
    """Whether the mesh is there, newer than what it was made from, and made with the same options."""
    sources = [path, *([options.radii_file] if options.radii_file else [])]
    try:
        return (all(mesh.exists() for mesh in meshes) and stamp.read_text(encoding="utf-8") == stamp_of(options) and
                report.stat().st_mtime >= max(source.stat().st_mtime for source in sources))
    except OSError:
        return False


def stamp_of(options):
    """What tells meshes apart that were made with other options."""
    return json.dumps([options.radii, str(options.radii_file or ""), options.force_field, options.rest])


def add_radii(path, folder, options):
    """A file that has hydrogens and radii, by pdb2pqr; returns it, and why there is none, or nothing."""
    source, made = path, folder / f"{name_of(path)}.pqr"
    if unpacked(path).name != path.name:  # pdb2pqr reads nothing gzipped
        source = folder / unpacked(path)
        try:
            source.write_bytes(gzip.decompress(path.read_bytes()))
        except (OSError, EOFError, zlib.error) as error:
            return made, f"{path}: {error}"
    return made, run([options.pdb2pqr, "--ff", options.force_field, "--drop-water", source, made], options)


def make_mesh(path, options):
    """Makes the mesh of one molecule if it is not there; returns why it failed, or nothing."""
    name = name_of(path)
    mesh, report = options.output / f"{name}{options.extension}", options.output / f"{name}.json"
    stamp = options.output / f".{name}.options"
    if not path.is_file():
        return "no such file"
    if not options.again and is_done(path, meshes_of(name, options), report, stamp, options):
        return ""
    with tempfile.TemporaryDirectory(prefix="mesh_batch_") as folder:
        source, radii = path, []
        if needs_pdb2pqr(path, options):
            source, reason = add_radii(path, pathlib.Path(folder), options)
            if reason:
                return reason
        elif kind(path) in NEED_RADII:
            given = {"--radii": options.radii, "--radii-file": options.radii_file}
            radii = [word for option, value in given.items() if value for word in (option, value)]
        stamp.unlink(missing_ok=True)
        reason = run([options.program, source, *radii, *options.rest, "--threads", options.threads, "--quiet",
                      "-o", mesh, "--report", report], options)
    if not reason:
        stamp.write_text(stamp_of(options), encoding="utf-8")
    return reason


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


def write_tables(molecules, failures, options):
    with open(options.output / "table.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        for name in molecules:
            if name not in failures:
                writer.writerow(row_of(name, options.output / f"{name}.json"))
    lines = [f"{molecules[name]}\t{reason}\n" for name, reason in failures.items()]
    (options.output / "failures.tsv").write_text("".join(lines), encoding="utf-8")


def parse_arguments(arguments):
    own, rest = (arguments[:arguments.index("--")], arguments[arguments.index("--") + 1:]) if "--" in arguments \
        else (arguments, [])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     usage="%(prog)s [options] MOLECULES... --output FOLDER [-- OPTIONS OF gaussmesh]")
    parser.add_argument("molecules", nargs="*", type=pathlib.Path, help="files, or folders of them")
    parser.add_argument("--list", type=pathlib.Path, help="file with the path of a molecule on each line")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder for the meshes")
    parser.add_argument("--extension", default=".off", help="of the meshes, which means their format (default: .off)")
    parser.add_argument("--program", default="gaussmesh", help="where gaussmesh is (default: in the PATH)")
    parser.add_argument("--pdb2pqr", default="pdb2pqr", help="the program of that name")
    parser.add_argument("--force-field", default="AMBER", help="for pdb2pqr (default: AMBER)")
    parser.add_argument("--radii", default="", help="bondi, amber or charmm: instead of pdb2pqr")
    parser.add_argument("--radii-file", type=pathlib.Path, help="radii of your own, with --radii or instead of pdb2pqr")
    parser.add_argument("--jobs", type=int, default=1, help="molecules at a time (default: 1)")
    parser.add_argument("--threads", type=int, default=1, help="threads for each of them (default: 1)")
    parser.add_argument("--timeout", type=float, default=3600.0, help="seconds for each program (default: 3600)")
    parser.add_argument("--again", action="store_true", help="make all meshes anew")
    options = parser.parse_args(own)
    if options.jobs < 1 or options.threads < 0 or not options.timeout > 0:
        parser.error("--jobs: expected 1 or more, --threads: 0 or more, --timeout: more than 0")
    for word in rest:
        own = OWN_OPTIONS.get("-o" if re.match("-o.", word) else word.split("=", 1)[0])
        if own:
            parser.error(f"expected {own} before --, got '{word}' behind it")
    options.extension = "." + options.extension.removeprefix(".")
    options.rest = rest
    return options


def make_all(molecules, options):
    """Makes all meshes; returns why molecules have none, by name. Those not begun when told to stop are among them."""
    failures = {name: "not reached" for name in molecules}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        pending = {pool.submit(make_mesh, path, options): name for name, path in molecules.items()}
        try:
            for number, future in enumerate(concurrent.futures.as_completed(pending), start=1):
                name, reason = pending[future], future.result()
                failures[name] = reason
                print(f"[{number}/{len(molecules)}] {name}: {reason or 'good'}", file=sys.stderr)
        except KeyboardInterrupt:
            print("stopped; what is under way comes to its end", file=sys.stderr)
            pool.shutdown(wait=False, cancel_futures=True)
    return {name: reason for name, reason in sorted(failures.items()) if reason}


def main():
    options = parse_arguments(sys.argv[1:])
    try:
        molecules = find_molecules(options)
        if not molecules:
            raise WrongUse("expected molecules, got none")
        require_programs(molecules, options)
        options.output.mkdir(parents=True, exist_ok=True)
    except (WrongUse, OSError, UnicodeDecodeError) as error:
        print(f"mesh_batch.py: {error}", file=sys.stderr)
        return 2
    failures = make_all(molecules, options)
    write_tables(molecules, failures, options)
    print(f"{len(molecules) - len(failures)} of {len(molecules)} molecules meshed; {options.output / 'table.csv'}"
          + (f", {options.output / 'failures.tsv'}" if failures else ""))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
