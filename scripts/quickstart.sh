#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh clone to the main study: installs what is missing, builds, runs, draws.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/scripts/install_dependencies.sh"

echo "building"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cd "$root"
{ cmake --preset release && cmake --build --preset release --target millstudy_cli; } >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }

results="$root/results"
mkdir -p "$results"
compute() { build/release/millstudy run studies/ggg70_slot.toml -o "$results/ggg70_slot.h5" "$@"; }
status=0
compute || status=$?
if [ "$status" -eq 2 ] && [ -f "$results/ggg70_slot.h5" ]; then  # the study has changed since
  status=0
  compute --fresh || status=$?
fi
[ "$status" -eq 0 ] || [ "$status" -eq 3 ] || exit "$status"

echo "picture: $(/usr/bin/python3 scripts/plot_study.py "$results/ggg70_slot.h5" \
  --variable force_resultant_max -o "$results/ggg70_slot.png" | tail -n 1)"
exit "$status"
