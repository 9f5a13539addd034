#!/usr/bin/env bash
# Runs a campaign on Slurm: an array of SHARDS jobs of one core each, and one job that joins them when all have ended.
#
#   verification/cluster/slurm.sh PROGRAMS FOLDER SHARDS CAMPAIGN [ARGUMENT...]
#   verification/cluster/slurm.sh /shared/programs /shared/exact 1000 exact_campaign 1_000_000_000_000 --seed 2026
#
# PROGRAMS is the folder of build.sh. States, logs and the joined state (merged.json) go to FOLDER. All machines must see both. The same
# command resumes a run that was stopped: finished shards end at once. Jobs that Slurm kills and requeues resume, too. Set further options
# of sbatch (partition, account, time, limit of the array) by its variables: SBATCH_PARTITION and so on.
set -euo pipefail
if [ $# -lt 4 ]; then
    echo "usage: slurm.sh PROGRAMS FOLDER SHARDS CAMPAIGN [ARGUMENT...]" >&2
    exit 2
fi
programs=$1 folder=$2 shards=$3 campaign=$4

if [ -n "${SLURM_ARRAY_TASK_ID:-}" ]; then
    # Array and shards both count from 1. The number of shards is an argument, since part of the array may be submitted again.
    exec "$programs/$campaign" "${@:5}" --threads 1 \
        --shard "$SLURM_ARRAY_TASK_ID/$shards" --state "$folder/$SLURM_ARRAY_TASK_ID.json"
elif [ -n "${SLURM_JOB_ID:-}" ]; then
    states=()
    for ((shard = 1; shard <= shards; shard++)); do
        states+=("$folder/$shard.json")
    done
    exec "$programs/merge" "${states[@]}" --state "$folder/merged.json"
fi
mkdir -p "$folder"
array=$(sbatch --parsable --job-name="$campaign" --array="1-$shards" --cpus-per-task=1 --requeue --open-mode=append \
    --output="$folder/%a.log" "$0" "$@")
# This runs even if some fail: `merge` names them, and how to resume. (On several clusters a name follows the number.)
sbatch --job-name="$campaign-merge" --dependency="afterany:${array%%;*}" --cpus-per-task=1 --open-mode=append \
    --output="$folder/merge.log" "$0" "$@"
