#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds with warnings as errors, runs every test.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/scripts/install_dependencies.sh"
cd "$root"
cmake --preset ci
cmake --build --preset ci
ctest --preset ci --parallel "$(nproc)" "$@"
