#!/usr/bin/env bash
# Installs with apt-get what is missing of the packages that gaussmesh needs; what is there is left alone.
#
#   scripts/setup.sh build         what it takes to build the program and the library
#   scripts/setup.sh build test    and what it takes to run scripts/test.sh
#
# For Debian 12; later Debian and Ubuntu releases have the same names. Runs as root or through sudo.
set -euo pipefail

build_packages=(g++ cmake make libeigen3-dev libcli11-dev zlib1g-dev nlohmann-json3-dev gemmi-dev tao-pegtl-dev)
test_packages=(catch2 clang clang-format-14 libomp-dev libclang-rt-dev python3 tetgen gmsh python3-meshio python3-vtk9
  python3-jsonschema python3-matplotlib pdb2pqr libbenchmark-dev)

wanted=()
for set_name in "$@"; do
  case "$set_name" in
    build) wanted+=("${build_packages[@]}") ;;
    test) wanted+=("${test_packages[@]}") ;;
    *) echo "setup.sh: expected 'build' or 'test', got '$set_name'" >&2; exit 2 ;;
  esac
done
if [ ${#wanted[@]} -eq 0 ]; then
  echo "usage: scripts/setup.sh build [test]" >&2
  exit 2
fi

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "setup.sh: no apt-get here; going on in the hope that these are there: ${wanted[*]}" >&2
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup.sh: run this as root, or install sudo: these packages are missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt_get() {
  # Quiet where all is well; the whole story where it is not.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300 "$@" \
    >"$log" 2>&1 </dev/null || { cat "$log" >&2; return 1; }
}
apt_get update
apt_get install --yes --no-install-recommends "${missing[@]}"
