#!/usr/bin/env bash
# Five hundred tiny patients through the whole workflow on a Slurm of one node with two cores, whose jobs and controller are killed
# at sixty random moments (hours): scripts/cohort_slurm_long.sh OSTIA [PATIENTS] [KILLS] [SEED]. For root; needs scripts/packages-slow.txt
# and scripts/packages-test.txt.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,4p "$0" >&2; exit 2; }
source=$(cd "$(dirname "$0")/.." && pwd)
exec python3 -B "$source/tests/cohort/slurm_test.py" "$1" "$source" "${2:-500}" "${3:-60}" "${4:-1}"
