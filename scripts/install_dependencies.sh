#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs by apt what is missing to build, test and plot. Does nothing where all is there.
set -euo pipefail

packages=(
  ca-certificates clang cmake g++ git libclang-rt-14-dev ninja-build pkg-config
  libbenchmark-dev libceres-dev libcli11-dev libeigen3-dev libfmt-dev libgtest-dev libhdf5-dev libmatio-dev
  libopenmpi-dev libssl-dev libtbb-dev libtomlplusplus-dev nlohmann-json3-dev openmpi-bin
  python3 python3-h5netcdf python3-h5py python3-matplotlib python3-netcdf4 python3-scipy python3-xarray
  netcdf-bin octave zlib1g-dev
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
    missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "installing: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "run as root, or install sudo: apt packages are missing" >&2; exit 2; }
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
