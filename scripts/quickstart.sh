#!/usr/bin/env bash
# From a fresh checkout to a mesh: installs what is missing, builds, and meshes data/fas2.pqr to fas2.off.
# Beyond the packages that scripts/setup.sh names, nothing outside the checkout is touched.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh build

build=build/quickstart
echo "Building in $build"
mkdir -p "$build"
log=$build/build.log
{
  cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DGAUSSMESH_BUILD_TESTS=OFF &&
    cmake --build "$build" -j "$(nproc)"
} >"$log" 2>&1 || { cat "$log" >&2; echo "quickstart.sh: the build failed; its log is $log" >&2; exit 1; }

echo "$build/bin/gaussmesh data/fas2.pqr --d 0.6 --c 1.7 -o fas2.off"
"$build/bin/gaussmesh" data/fas2.pqr --d 0.6 --c 1.7 -o fas2.off
