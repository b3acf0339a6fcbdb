#!/bin/bash
# A batch of heads as an array of a hundred tasks. Submit it with the batch and the folder of its heads, both on a disk that every node
# has; with --requeue a preempted task goes on where it stopped:
#
#     sbatch validation/cluster/slurm.sh people.toml /shared/heads
#
#SBATCH --job-name=heads
#SBATCH --array=1-100
#SBATCH --cpus-per-task=8
#SBATCH --mem=8G
#SBATCH --time=04:00:00
#SBATCH --requeue
set -euo pipefail

if [ "$#" != 2 ]; then
    echo 'the arguments are the batch (TOML) and the folder of its heads' >&2
    exit 2
fi
exec srun frisure batch "$1" -o "$2" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads "$SLURM_CPUS_PER_TASK" --quiet
