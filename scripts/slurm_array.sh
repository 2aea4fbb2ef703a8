#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Submits a study to Slurm as an array of parts, and a job that merges them.
set -euo pipefail

usage() {
  cat <<'END'
usage: slurm_array.sh STUDY.toml PARTS [-o R.h5] [-p PROGRAM] [-- SBATCH OPTIONS]

Every task of the array computes one part (millstudy run --shard k/PARTS) into R.shard-k-of-PARTS.h5. A task that
the cluster stops or loses is queued again and goes on with its journal, up to 20 times. When all have ended, one more
job merges the parts into R.h5. The same command again submits the parts that are still missing, and the merge.

  -o R.h5       the result (default: the name of the study file, with .h5), on a disk that all nodes see
  -p PROGRAM    millstudy (default: the one in PATH)
  --            what follows is for sbatch: -- --cpus-per-task=16 --time=12:00:00
END
}

refuse() {
  echo "slurm_array.sh: $1; see slurm_array.sh --help" >&2
  exit 2
}

# What a task does; $1 is the program, $2 the study, $3 the number of parts, $4 the result without .h5.
task() {
  local program=$1 study=$2 parts=$3 stem=$4 k=$SLURM_ARRAY_TASK_ID code=0
  # Slurm tells the shell; millstudy must hear it, and the shell must outlive it.
  "$program" run "$study" -o "$stem.shard-$k-of-$parts.h5" --shard "$k/$parts" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" &
  local child=$!
  trap 'kill -TERM "$child" 2>/dev/null' TERM
  while :; do
    code=0
    wait "$child" || code=$?
    kill -0 "$child" 2>/dev/null || break # else it was the trap that ended the wait
  done
  case $code in
    0 | 2 | 3) exit "$code" ;; # done, bad input, done but for failed points: once more would not help
  esac
  local state
  state=$(squeue --noheader --jobs="${SLURM_ARRAY_JOB_ID}_$k" --format=%T || true)
  [ "$state" = RUNNING ] || exit "$code" # scancel: somebody does not want it
  if [ "${SLURM_RESTART_COUNT:-0}" -lt 20 ]; then
    echo "part $k ended with code $code after ${SLURM_RESTART_COUNT:-0} restarts: it is queued again"
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$k"
    sleep 60 # until Slurm takes the task away
  fi
  exit "$code"
}

merge() {
  local program=$1 parts=$2 stem=$3
  exec "$program" merge "$stem.h5" "$stem".shard-*-of-"$parts".h5
}

case ${1:-} in
  --task) shift && task "$@" ;;
  --merge) shift && merge "$@" ;;
  -h | --help) usage && exit 0 ;;
esac

[ $# -ge 2 ] || refuse "give a study and the number of parts"
study=$1 parts=$2
shift 2
output="" program=""
while [ $# -gt 0 ]; do
  case $1 in
    -o) [ $# -ge 2 ] || refuse "-o needs a file" && output=$2 && shift 2 ;;
    -p) [ $# -ge 2 ] || refuse "-p needs a program" && program=$2 && shift 2 ;;
    --) shift && break ;;
    *) refuse "$1 is not known" ;;
  esac
done
[ -f "$study" ] || refuse "$study is no file"
[[ $parts =~ ^[1-9][0-9]{0,4}$ ]] || refuse "the number of parts must be 1 to 99999, not $parts"
program=${program:-$(command -v millstudy || true)}
[ -n "$program" ] || refuse "millstudy is not in PATH: give -p PROGRAM"
program=$(realpath "$program") study=$(realpath "$study")
[ -x "$program" ] || refuse "$program is no program"
command -v sbatch >/dev/null || refuse "there is no sbatch here"
output=$(realpath -m "${output:-$(basename "$study" .toml).h5}")
stem=${output%.h5}
"$program" plan "$study" --json >/dev/null # its faults are told now, not by every task

missing=()
for ((k = 1; k <= parts; ++k)); do
  part=$stem.shard-$k-of-$parts.h5
  [ -f "$part" ] && [ ! -f "$part.journal" ] || missing+=("$k")
done

self=$(realpath "${BASH_SOURCE[0]}")
name=$(basename "$stem")
after=()
if [ ${#missing[@]} -gt 0 ]; then
  list=$(IFS=,; echo "${missing[*]}")
  job=$(sbatch --parsable --job-name="$name" --array="$list" --requeue --open-mode=append --signal=B:TERM@60 \
    --output="$stem.shard-%a-of-$parts.log" "$@" "$self" --task "$program" "$study" "$parts" "$stem")
  after=(--dependency="afterany:${job%%;*}")
  echo "${#missing[@]} of $parts parts: job ${job%%;*}, logs in $stem.shard-*.log"
fi
merging=$(sbatch --parsable --job-name="$name-merge" "${after[@]}" --output="$stem.merge.log" \
  "$self" --merge "$program" "$parts" "$stem")
echo "merge: job ${merging%%;*}, then the result is $output"
