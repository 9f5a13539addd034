#!/usr/bin/env bash
# Runs exact_campaign on Slurm: an array of SEEDS jobs of one core each, seeds 1 to SEEDS, and one job that adds their counts.
#
#   verification/cluster/slurm.sh PROGRAM FOLDER SEEDS PAIRS [ARGUMENT...]
#   verification/cluster/slurm.sh target/release/examples/exact_campaign /shared/exact 1000 1_000_000_000
#
# All machines must see PROGRAM and FOLDER, which receives counts and logs. A seed whose counts are there is not run again, so the
# same command completes a run that was stopped. Set further options of sbatch (partition, account, time) by its variables:
# SBATCH_PARTITION …
set -euo pipefail
if [ $# -lt 4 ]; then
    echo "usage: slurm.sh PROGRAM FOLDER SEEDS PAIRS [ARGUMENT...]" >&2
    exit 2
fi
program=$1 folder=$2 seeds=$3

if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
    seed=$SLURM_ARRAY_TASK_ID
    [ -e "$folder/$seed.json" ] || exec "$program" "${@:4}" --threads 1 --seed "$seed" --json "$folder/$seed.json"
elif [ -n "${SLURM_JOB_ID:-}" ]; then
    # A file that is missing is an error, which names it.
    seq --format "$folder/%.0f.json" "$seeds" | xargs "$program" --sum
else
    mkdir -p "$folder"
    array=$(sbatch --parsable --array="1-$seeds" --cpus-per-task=1 --requeue --open-mode=append --output="$folder/%a.log" "$0" "$@")
    # On several clusters a name follows the number.
    sbatch --dependency="afterany:${array%%;*}" --cpus-per-task=1 --output="$folder/sum.log" "$0" "$@"
fi
