#!/usr/bin/env bash
# Everything that must hold before a change goes in; 14 to 27 minutes on two cores.
#
#   1. g++ builds all of it without a warning, and ctest passes: units, properties, whole molecules, the program's
#      exit codes and messages, the installed package, the direction of includes.
#   2. clang builds all of it without a warning under AddressSanitizer and UndefinedBehaviorSanitizer, and the
#      fast tests pass there.
#   3. Each fuzz target runs for a while on the test inputs and finds nothing.
#   Where there is clang-format 14, of which other versions differ, the code is as .clang-format says.
#
# A step that fails does not keep the next from running. The last line counts the tests and steps.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

fuzz_seconds=${FUZZ_SECONDS:-20}
# Whole molecules, and a surface of a thousand A; what they are made by is tested in smaller pieces there.
slow_under_sanitizers='crease between spheres|triangles of molecules are nearly equilateral|exact signs everywhere'
passed=0
failed=0
failures=()

note_pass() { passed=$((passed + 1)); }
note_fail() { failed=$((failed + 1)); failures+=("$1"); }

# step NAME COMMAND...: one thing that works or not; its output is shown only where it does not.
step() {
  local name=$1 log
  shift
  log=$(mktemp)
  printf '== %s\n' "$name"
  if "$@" >"$log" 2>&1 </dev/null; then
    rm -f "$log"
    note_pass
    return 0
  fi
  tail -n 200 "$log"
  rm -f "$log"
  note_fail "$name"
  return 1
}

# run_ctest NAME FOLDER [OPTION...]: adds the tests of a build folder to the count.
run_ctest() {
  local name=$1 folder=$2 log summary
  shift 2
  log=$(mktemp)
  printf '== %s\n' "$name"
  ctest --test-dir "$folder" -j2 --output-on-failure --no-tests=error "$@" </dev/null 2>&1 | tee "$log" |
    grep -vE '^ *(Start +[0-9]+:|[0-9]+/[0-9]+ Test +#.* Passed )'
  summary=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1 \2/p' "$log" | tail -n 1)
  rm -f "$log"
  if [ -z "$summary" ]; then
    note_fail "$name"
    return 1
  fi
  local bad=${summary% *} all=${summary#* }
  passed=$((passed + all - bad))
  failed=$((failed + bad))
  [ "$bad" -eq 0 ] || failures+=("$name")
}

build() { cmake --preset "$1" && cmake --build --preset "$1" -j "$(nproc)"; }

# fuzz TARGET: starts from the test inputs, a small mesh in all formats and a file of radii; new inputs go to a folder of
# the build.
fuzz() {
  local target=$1 corpus=build/fuzz/corpus/$1 seeds=build/fuzz/seeds
  mkdir -p "$corpus" "$seeds"
  (cd "$seeds" && ../bin/gaussmesh ../../../data/methanol.pqr --spacing 1.2 -o m.off -o m.vert -o m.ply -o m.obj \
    -o m.stl -o m.msh -o m.smesh -o m.vtp && ../bin/gaussmesh convert m.ply m41.msh --format gmsh41 &&
    ../bin/gaussmesh convert m.ply ascii.ply --format ply-ascii &&
    gmsh -v 1 m.msh -save -save_all -bin -format msh22 -o binary22.msh &&
    gmsh -v 1 m.msh -save -save_all -bin -format msh41 -o binary41.msh &&
    printf 'HEM FE 1.5 # residue and name\nCA\t2.3D+00\nC 1.7\n' >my.radii) || return 1
  "build/fuzz/fuzz/$target" -max_total_time="$fuzz_seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 \
    -artifact_prefix="build/fuzz/$target-" "$corpus" "$seeds" tests/data
}

finish() {
  local name
  for name in ${failures[@]+"${failures[@]}"}; do printf 'FAILED: %s\n' "$name"; done
  printf '%d passed, %d failed\n' "$passed" "$failed"
  [ "$failed" -eq 0 ]
}

step "install what is missing" scripts/setup.sh build test || { finish; exit 1; }

is_formatted() { find apps include src tests -name '*.h' -o -name '*.cpp' | xargs clang-format-14 --dry-run --Werror; }
! command -v clang-format-14 >/dev/null || step "code is formatted" is_formatted

step "g++ build, warnings are errors" build dev &&
  run_ctest "all tests" build/dev

if step "clang build with sanitizers, warnings are errors" build fuzz; then
  run_ctest "fast tests under the sanitizers" build/fuzz -L '^(unit|cli)$' -E "$slow_under_sanitizers"
  for source in tests/fuzz/*_fuzz.cpp; do
    target=$(basename "$source" .cpp)
    step "fuzz $target for $fuzz_seconds s" fuzz "$target"
  done
fi

finish
